"""Real positive roots: divergence after it has set in, and complex pairs that become real.

On the positive real axis T is real, and its pencil gives the airspeeds U(p) at which a real p is a
root. A minimum of U(p) is a double root: below it the two real roots are a complex pair, above it
they are real. That is a *merger*, found without following any pair. At a maximum two real roots
become a complex pair.
"""

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.stability.newton import Roots, polish_roots, roots_at
from foldwing.stability.path import EigenvaluePath, follow_path
from foldwing.stability.problem import AeroelasticProblem, evaluate_with_derivatives
from foldwing.stability.region import RIGHT_EDGE

LEAST = 1e-9
"""The smallest p that is sought."""

POINTS = 80
"""Points along the real axis."""

SAME_ROOT = 1e-7
"""Relative difference below which two real roots are one."""

ZOOMS = 4
"""Most times that the path is refined around a minimum of U(p)."""


def real_axis_path(
    problem: AeroelasticProblem, fastest: float, edge: float = RIGHT_EDGE
) -> EigenvaluePath:
    """Return the inverse speeds along 1e-9 <= p <= ``edge`` on the real axis, parameter ln p."""
    parameter = np.linspace(np.log(LEAST), np.log(edge), POINTS)
    return follow_path(problem, _point, parameter, fastest)


def _real_inverse(path: EigenvaluePath) -> Real:
    """Return the real inverse speeds, nan where an eigenvalue is complex or negative."""
    s = path.inverse
    real = (np.abs(s.imag) < 1e-8 * np.abs(s)) & (s.real > 0.0)
    return np.where(real, s.real, np.nan)


def real_roots(problem: AeroelasticProblem, path: EigenvaluePath, speeds: Real) -> list[Roots]:
    """Return the real positive roots at each airspeed, the fastest growing first.

    Sought where a factor 1 - V s of the determinant changes sign along the axis, and where all of
    them together do: two real eigenvalues may meet between two points and turn complex.
    """
    real = _real_inverse(path)[None]
    V = path.measure(speeds)[:, None, None]
    factors = 1.0 - V * real
    whole = np.prod(1.0 - V * path.inverse, axis=2).real[:, :, None]
    case, seed = _sign_changes(np.concatenate([factors, whole], axis=2), path.parameter)
    roots = polish_roots(problem, seed, speeds[case])
    good = roots.converged & (np.abs(roots.p.imag) < 1e-9) & (roots.p.real > 0.0)
    result = []
    for index in range(len(speeds)):
        found = np.flatnonzero(good & (case == index))
        found = found[np.argsort(-roots.p.real[found])]
        p = roots.p.real[found]
        new = np.concatenate([[True], np.abs(np.diff(p)) > SAME_ROOT * p[1:]])[: len(p)]
        result.append(roots.take(found[new]))
    return result


def _sign_changes(values: Real, t: Real) -> tuple[Indices, Complex]:
    """Return the case and the interpolated p of every sign change along axis 1."""
    before, after = values[:, :-1], values[:, 1:]
    with np.errstate(invalid="ignore"):
        case, row, column = np.nonzero(before * after < 0.0)
    start, end = before[case, row, column], after[case, row, column]
    return case, _point(t[row] + start / (start - end) * (t[row + 1] - t[row]))


def mergers(
    problem: AeroelasticProblem, path: EigenvaluePath, speed_range: tuple[float, float]
) -> Roots:
    """Return the double roots at which an unstable complex pair becomes real, ascending in U."""
    return _double_roots(problem, path, speed_range, 1.0)


def births(
    problem: AeroelasticProblem, path: EigenvaluePath, speed_range: tuple[float, float]
) -> Roots:
    """Return the double roots at which two real roots become a complex pair, ascending in U."""
    return _double_roots(problem, path, speed_range, -1.0)


def _double_roots(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    speed_range: tuple[float, float],
    sign: float,
) -> Roots:
    """Return the minima (sign 1) or maxima (sign -1) of U(p) in a range of airspeeds."""
    slow, fast = speed_range
    extrema = _extrema(problem, path, 2.0 * fast, sign, ZOOMS)
    found = [(p, U) for p, U in extrema if slow <= U <= fast]
    p = np.array([root[0] for root in found], complex)
    at = np.array([root[1] for root in found], float)
    order = np.argsort(at)
    return roots_at(problem, p[order], at[order])


def _extrema(
    problem: AeroelasticProblem, path: EigenvaluePath, fastest: float, sign: float, zooms: int
) -> list[tuple[float, float]]:
    """Return p and U of every minimum or maximum of U(p) along the branches of a path.

    Where two branches come too near to tell them apart between two points, the path is refined.
    """
    t, speed = path.parameter, path.speed(_real_inverse(path))
    slope = sign * _slopes(problem, path.p, np.where(speed < fastest, speed, np.nan))
    with np.errstate(invalid="ignore"):
        turning = (slope[:-1] < 0.0) & (slope[1:] > 0.0)
    found = []
    for row, column in zip(*np.nonzero(turning), strict=True):
        ends, near = t[row : row + 2], speed[row : row + 2, column]
        extremum = _extremum(problem, ends, near, sign)
        if extremum is not None:
            found.append(extremum)
        elif zooms > 0:
            closer = np.linspace(ends[0], ends[1], 9)
            finer = follow_path(problem, _point, closer, fastest)
            found += _extrema(problem, finer, fastest, sign, zooms - 1)
    return found


def _slopes(problem: AeroelasticProblem, p: Complex, speed: Real) -> Real:
    """Return dU/dp of the real roots (p, U), nan where the airspeed is."""
    rows, columns = np.nonzero(np.isfinite(speed))
    slope = np.full(speed.shape, np.nan)
    if len(rows):
        T = evaluate_with_derivatives(problem, p[rows], speed[rows, columns])
        x, y = _real_null_vectors(T.value.real)
        by_p, by_speed = (y @ part.real @ x for part in (T.by_p, T.by_speed))
        slope[rows, columns] = -(by_p / by_speed)[:, 0, 0]
    return slope


def _real_null_vectors(T: Real) -> tuple[Real, Real]:
    """Return right (m, n, 1) and left (m, 1, n) null vectors by one step of inverse iteration.

    T is singular but for round-off, which is what makes one step enough; where there is not even
    round-off, singular vectors are taken.
    """
    start = np.cos(np.arange(T.shape[1]))[:, None]
    try:
        return np.linalg.solve(T, start), np.linalg.solve(T.mT, start).mT
    except np.linalg.LinAlgError:
        W, _, Vh = np.linalg.svd(T)
        return Vh[:, -1:, :].mT, W[:, :, -1:].mT


def _extremum(
    problem: AeroelasticProblem, t: Real, near: Real, sign: float
) -> tuple[float, float] | None:
    """Solve dU/dp = 0 between two values of ln p with airspeeds ``near``; None when it fails."""

    def state(at: float) -> tuple[float, float]:
        p = _point(np.array([at]))
        speed = _speed(problem, p, float(np.interp(at, t, near)))
        return sign * float(_slopes(problem, p, np.array([[speed]]))[0, 0]), speed

    if not state(t[0])[0] < 0.0 < state(t[1])[0]:
        return None
    try:
        at = brentq(lambda value: state(value)[0], t[0], t[1], xtol=1e-6)
    except (RuntimeError, ValueError):
        return None
    return float(np.exp(at)), state(at)[1]


def _speed(problem: AeroelasticProblem, p: Complex, near: float) -> float:
    """Return the airspeed nearest to ``near`` at which the real ``p`` is a root."""
    path = follow_path(problem, lambda _: p, np.zeros(1), near)
    inverse = path.inverse[0]
    nearest = inverse[np.argmin(np.abs(inverse * path.measure(near) - 1.0))]
    return float(path.speed(nearest.real))


def _point(parameter: Real) -> Complex:
    return np.exp(parameter) + 0j
