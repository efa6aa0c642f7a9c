"""Null space of redundant linear constraints."""

from typing import NamedTuple

import numpy as np
import scipy.linalg

from foldwing.maths.arrays import Real

TOLERANCE = 1e-9
"""Relative size of a pivot below which a constraint counts as redundant."""


class NullSpace(NamedTuple):
    """An orthonormal basis of {q : C q = 0} and how clearly its dimension was decided.

    Attributes
    ----------
    basis : array, shape (n, n - rank)
    rank : int
        Number of independent constraints.
    gap : float
        Ratio of the largest rejected to the smallest accepted pivot: far below 1 when the rank is
        beyond doubt, 0 when no constraint is redundant.
    """

    basis: Real
    rank: int
    gap: float


def null_space(constraints: Real, scaled: bool = True) -> NullSpace:
    """Return an orthonormal basis of the null space by rank-revealing QR.

    Parameters
    ----------
    constraints : array, shape (m, n)
        Redundant rows and zero rows are allowed.
    scaled : bool
        Whether rows are scaled to unit norm first, so that their units do not matter.
    """
    n = constraints.shape[1]
    norms = np.linalg.norm(constraints, axis=1)
    C = constraints[norms > 0.0]
    if scaled:
        C = C / norms[norms > 0.0, None]
    if len(C) == 0:
        return NullSpace(np.eye(n), 0, 0.0)
    Q, R, _ = scipy.linalg.qr(C.T, mode="full", pivoting=True, check_finite=False)
    pivots = np.abs(np.diagonal(R))
    rank = int(np.count_nonzero(pivots > TOLERANCE * pivots[0]))
    gap = float(pivots[rank] / pivots[rank - 1]) if rank < len(pivots) else 0.0
    return NullSpace(Q[:, rank:], rank, gap)
