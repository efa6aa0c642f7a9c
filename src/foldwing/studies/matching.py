"""The same flutter points in two computations of one case."""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linear_sum_assignment

from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.results.flutter_table import FlutterRow

LIKENESS = 0.8
"""Motions less alike (MAC) than this are not the same flutter point."""

NEAR = 0.35
"""Largest change of the airspeed, plus that of the frequency, both relative, of the same point."""

_FORBIDDEN = 1e3


def likeness(motions: Complex, others: Complex) -> Real:
    """Return the likeness (MAC), 0..1, of all pairs of motions.

    Parameters
    ----------
    motions : array, shape (m, k)
        Displacements at k places.
    others : array, shape (n, k)

    Returns
    -------
    array, shape (m, n)
    """
    product = np.abs(motions.conj() @ others.T) ** 2
    norms = [(np.abs(both) ** 2).sum(axis=1) for both in (motions, others)]
    return np.asarray(product / np.outer(*norms))


def match_points(rows: Sequence[FlutterRow], others: Sequence[FlutterRow], alike: Real) -> Indices:
    """Return for each flutter point its counterpart among others, -1 when it has none.

    Only points of one kind and event with like motions and near airspeeds and frequencies are
    the same; among these the pairs with the smallest changes in all are taken.

    Parameters
    ----------
    rows, others : sequence of FlutterRow
        Of lengths m and n.
    alike : array, shape (m, n)
        Likeness of the motions, as `likeness` gives it.

    Returns
    -------
    array of int, shape (m,)
    """
    found = np.full(len(rows), -1)
    if not rows or not others:
        return found
    change = np.array([[_change(row, other) for other in others] for row in rows])
    possible = (change <= NEAR) & (alike >= LIKENESS)
    for row, other in zip(
        *linear_sum_assignment(np.where(possible, change, _FORBIDDEN)), strict=True
    ):
        if possible[row, other]:
            found[row] = other
    return found


def _change(row: FlutterRow, other: FlutterRow) -> float:
    """Return the relative change of airspeed and frequency; infinite for other kinds of points."""
    if (row.kind, row.event) != (other.kind, other.event):
        return _FORBIDDEN
    highest = max(row.frequency, other.frequency)
    frequency = abs(row.frequency - other.frequency) / highest if highest > 0.0 else 0.0
    return abs(float(np.log(other.speed / row.speed))) + frequency
