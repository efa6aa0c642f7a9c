"""Order of convergence, limit and error bar of a sequence of ever finer computations.

Richardson's extrapolation from the three finest values, with the safety factors of the grid
convergence index (Roache, Annual Review of Fluid Mechanics 29, 1997; Eça and Hoekstra, Journal of
Computational Physics 262, 2014).
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Real

SAFETY, DOUBTFUL_SAFETY = 1.25, 3.0
"""Factors on a difference that is well understood, and on one that is not."""

LOWEST_ORDER, HIGHEST_ORDER = 0.5, 4.0
"""Below the one a limit is guesswork; above the other an order is chance and not built upon."""

SETTLED = 1e-8
"""Relative change of the finest values below which nothing is left to converge."""

_STEEPEST = 40.0
"""Largest order that is looked for."""

_NO_ORDER = 1e-6
"""Order up to which differences count as growing: that of equal ones is 0 but for rounding."""


@dataclass(frozen=True)
class Convergence:
    """How a sequence converges, and how far one of its values is from the limit.

    Attributes
    ----------
    verdict : str
        ``monotone``: an order was found and the limit is extrapolated; ``settled``: the finest
        values agree; ``oscillating``, ``slow`` (an order below 0.5), ``steep`` (above 4) and
        ``scattered`` (no power law is expected): the limit is the finest value and the error bar
        follows from the spread; ``diverging``: differences do not become smaller, limit and error
        bar are unknown; ``few``: fewer than three values.
    order : float
        Observed order, nan where none was found.
    limit : float
        Best estimate of the limit, in the unit of the values; nan where there is none.
    error : float
        Error bar of the value in question, positive, in the unit of the values; nan where it is
        not known.
    """

    verdict: str
    order: float
    limit: float
    error: float


def assess(size: Real, values: Real, own: float, *, power_law: bool = True) -> Convergence:
    """Return order, limit and the error bar of one value of a sequence.

    Parameters
    ----------
    size : array, shape (m,)
        Positive size of a step, descending: the finest value is the last.
    values : array, shape (m,)
    own : float
        The value whose error is wanted, at any level.
    power_law : bool
        Whether the error is expected to fall with a power of ``size``.
    """
    if len(values) == 0:
        return Convergence("few", np.nan, np.nan, np.nan)
    finest = float(values[-1])
    spread = float(np.ptp([*values[-3:], own]))
    if len(values) < 3:
        error = DOUBTFUL_SAFETY * spread if len(values) == 2 else np.nan
        return Convergence("few", np.nan, finest, error)
    if spread <= SETTLED * abs(finest):
        return Convergence("settled", np.nan, finest, SAFETY * spread)
    if not power_law:
        return Convergence("scattered", np.nan, finest, SAFETY * spread)
    order = observed_order(size[-3:], values[-3:])
    if np.isnan(order):
        return Convergence("oscillating", np.nan, finest, SAFETY * spread)
    if order <= _NO_ORDER:
        return Convergence("diverging", order, np.nan, np.nan)
    if not LOWEST_ORDER <= order <= HIGHEST_ORDER:
        verdict = "slow" if order < LOWEST_ORDER else "steep"
        return Convergence(verdict, order, finest, DOUBTFUL_SAFETY * spread)
    limit = extrapolated(size[-2:], values[-2:], order)
    return Convergence("monotone", order, limit, SAFETY * abs(limit - own))


def observed_order(size: Real, values: Real) -> float:
    """Return the order p of f = limit + c size^p through three values; nan unless monotone.

    Parameters
    ----------
    size, values : array, shape (3,)
        From coarse to fine. The sizes need no common ratio.
    """
    first, second = np.diff(values)
    if first * second <= 0.0:
        return float("nan")
    coarse, fine = np.log(size[[0, 2]] / size[1])
    wanted = np.log(first / second)

    def excess(p: float) -> float:
        if abs(p) < 1e-9:
            return float(np.log(-coarse / fine) - wanted)
        return float(np.log(np.expm1(p * coarse) / -np.expm1(p * fine)) - wanted)

    ends = -_STEEPEST, _STEEPEST
    for end, sign in zip(ends, (-1.0, 1.0), strict=True):
        if sign * excess(end) <= 0.0:
            return end
    return float(brentq(excess, *ends, xtol=1e-10))


def extrapolated(size: Real, values: Real, order: float) -> float:
    """Return the limit of f = limit + c size^order through two values, the finer one last."""
    ratio = float(size[0] / size[1]) ** order
    return float(values[1] + (values[1] - values[0]) / (ratio - 1.0))
