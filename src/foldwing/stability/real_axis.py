"""Real positive roots: divergence after it has set in, and complex pairs that become real.

On the positive real axis T is real, and its pencil gives the airspeeds U(p) at which a real p is a
root. A minimum of U(p) is a double root: below it the two real roots are a complex pair, above it
they are real. That is a *merger*, found without following any pair.
"""

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Complex, Real
from foldwing.stability.newton import Roots, polish_roots, roots_at
from foldwing.stability.path import EigenvaluePath, follow_path, inverse_speeds
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.region import RIGHT_EDGE

POINTS = 60
"""Points along the real axis."""

ZOOMS = 4
"""Most times that the path is refined around a minimum of U(p)."""


def real_axis_path(problem: AeroelasticProblem, fastest: float) -> EigenvaluePath:
    """Return the inverse speeds along 1e-6 <= p <= 1.5 on the real axis, parameter ln p."""
    parameter = np.linspace(np.log(1e-6), np.log(RIGHT_EDGE), POINTS)
    return follow_path(problem, _point, parameter, fastest)


def _real_inverse(path: EigenvaluePath) -> Real:
    """Return the real inverse speeds, nan where an eigenvalue is complex or negative."""
    s = path.inverse
    real = (np.abs(s.imag) < 1e-8 * np.abs(s)) & (s.real > 0.0)
    return np.where(real, s.real, np.nan)


def real_roots(problem: AeroelasticProblem, path: EigenvaluePath, speeds: Real) -> list[Roots]:
    """Return the real positive roots at each airspeed, the fastest growing first."""
    s, t = _real_inverse(path), path.parameter
    excess = speeds[:, None, None] ** path.power * s - 1.0
    with np.errstate(invalid="ignore"):
        changes = excess[:, :-1] * excess[:, 1:] < 0.0
    case, row, column = np.nonzero(changes)
    before, after = excess[case, row, column], excess[case, row + 1, column]
    seed = np.exp(t[row] + before / (before - after) * (t[row + 1] - t[row])) + 0j
    roots = polish_roots(problem, seed, speeds[case])
    good = roots.converged & (np.abs(roots.p.imag) < 1e-9) & (roots.p.real > 0.0)
    result = []
    for index in range(len(speeds)):
        found = np.flatnonzero(good & (case == index))
        result.append(roots.take(found[np.argsort(-roots.p.real[found])]))
    return result


def mergers(
    problem: AeroelasticProblem, path: EigenvaluePath, speed_range: tuple[float, float]
) -> Roots:
    """Return the double roots at which an unstable complex pair becomes real, ascending in U."""
    slow, fast = speed_range
    found = [(p, U) for p, U in _minima(problem, path, 2.0 * fast, ZOOMS) if slow <= U <= fast]
    p = np.array([root[0] for root in found], complex)
    at = np.array([root[1] for root in found], float)
    order = np.argsort(at)
    return roots_at(problem, p[order], at[order])


def _minima(
    problem: AeroelasticProblem, path: EigenvaluePath, fastest: float, zooms: int
) -> list[tuple[float, float]]:
    """Return p and U of every minimum of U(p) along the branches of a path.

    Where two branches come too near to tell them apart between two points, the path is refined.
    """
    t, speed = path.parameter, _real_inverse(path) ** (-1.0 / path.power)
    slope = _slopes(problem, path.p, np.where(speed < fastest, speed, np.nan))
    with np.errstate(invalid="ignore"):
        minimum = (slope[:-1] < 0.0) & (slope[1:] > 0.0)
    found = []
    for row, column in zip(*np.nonzero(minimum), strict=True):
        ends, near = t[row : row + 2], speed[row : row + 2, column]
        merger = _merger(problem, ends, near)
        if merger is not None:
            found.append(merger)
        elif zooms > 0:
            closer = np.linspace(ends[0], ends[1], 9)
            finer = follow_path(problem, _point, closer, fastest)
            found += _minima(problem, finer, fastest, zooms - 1)
    return found


def _slopes(problem: AeroelasticProblem, p: Complex, speed: Real) -> Real:
    """Return dU/dp of the real roots (p, U), nan where the airspeed is."""
    rows, columns = np.nonzero(np.isfinite(speed))
    slope = np.full(speed.shape, np.nan)
    if len(rows):
        roots = roots_at(problem, p[rows], speed[rows, columns])
        slope[rows, columns] = 1.0 / roots.p_by_speed.real
    return slope


def _merger(problem: AeroelasticProblem, t: Real, near: Real) -> tuple[float, float] | None:
    """Solve dU/dp = 0 between two values of ln p with airspeeds ``near``; None when it fails."""

    def state(at: float) -> tuple[float, float]:
        p = _point(np.array([at]))
        speed = _speed(problem, p, float(np.interp(at, t, near)))
        return float(_slopes(problem, p, np.array([[speed]]))[0, 0]), speed

    if not state(t[0])[0] < 0.0 < state(t[1])[0]:
        return None
    try:
        at = brentq(lambda value: state(value)[0], t[0], t[1], xtol=1e-6)
    except (RuntimeError, ValueError):
        return None
    return float(np.exp(at)), state(at)[1]


def _speed(problem: AeroelasticProblem, p: Complex, near: float) -> float:
    """Return the airspeed nearest to ``near`` at which the real ``p`` is a root."""
    inverse, power = inverse_speeds(problem.pencil(p))
    nearest = inverse[0][np.argmin(np.abs(inverse[0] * near**power - 1.0))]
    return float(nearest.real ** (-1.0 / power))


def _point(parameter: Real) -> Complex:
    return np.exp(parameter) + 0j
