"""Few rows that stand for many: the interpolative decomposition of a matrix of smooth rows.

A row of the wake far downstream acts nearly as its neighbours do. A few rows, the skeleton, hold
all others to round-off as combinations of themselves (H. Cheng, Z. Gimbutas, P. G. Martinsson and
V. Rokhlin, SIAM Journal on Scientific Computing 26, 2005). Which ones, a sketch tells: the rows
times a few random columns (N. Halko, P. G. Martinsson and J. A. Tropp, SIAM Review 53, 2011).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.linalg

from foldwing.maths.arrays import Indices, Real

ROUND_OFF = 3e-14
"""What the skeleton leaves of any row, relative to that row."""

COLUMNS, SPARE = 48, 8
"""Columns of the first sketch, and how many of them must be more than it needs."""


class Skeleton(NamedTuple):
    """Rows of a matrix, and how all rows follow from them: ``all = weights @ all[rows]``.

    Attributes
    ----------
    rows : array of int, shape (k,)
    weights : array, shape (m, k)
        One or zero for the rows of the skeleton themselves.
    """

    rows: Indices
    weights: Real


def skeleton(sketch: Callable[[int], Real], count: int) -> Skeleton:
    """Return the skeleton of ``count`` rows.

    Parameters
    ----------
    sketch : callable
        Takes a number of random columns and returns the rows times that many, (count, columns).
    count : int
        Number m of rows.
    """
    columns = COLUMNS
    while columns < count:
        found = _skeleton(sketch(columns))
        if len(found.rows) + SPARE <= columns:
            return found
        columns *= 2
    return Skeleton(np.arange(count), np.eye(count))


def _skeleton(sketch: Real) -> Skeleton:
    size = np.linalg.norm(sketch, axis=1)
    R, order = scipy.linalg.qr((sketch / size[:, None]).T, mode="r", pivoting=True)
    diagonal = np.abs(R.diagonal())
    k = int(np.count_nonzero(diagonal > ROUND_OFF * diagonal[0]))
    rows, others = order[:k], order[k:]
    weights = np.zeros((len(sketch), k))
    weights[rows] = np.eye(k)
    weights[others] = scipy.linalg.solve_triangular(R[:k, :k], R[:k, k:]).T
    return Skeleton(rows, weights * (size[:, None] / size[rows]))
