"""Eigenvalues of the pencil along a path of reduced Laplace variables, followed as branches.

At fixed p the problem T0 + U T1 + U^2 T2 is singular at a few airspeeds. With V = U^2 (undamped) or
V = U (with structural damping), det T(p, U) is a constant times the product of 1 - V s_j(p), where
the s_j are the eigenvalues 1/V of the pencil. One set of s_j(p) along a path therefore gives the
determinant on that path *for every airspeed at once*.

T0 may depend on p and become singular: then the airspeeds are counted from a negative one. With
V = shift + U^2 (or shift + U) everything holds as before, and T at V = 0, which is no airspeed,
stands in place of T0.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import linear_sum_assignment

from foldwing.maths.arrays import Complex, Mask, Real
from foldwing.stability.problem import AeroelasticProblem, Pencil

CERTAIN_TURN = 0.8
"""Radians: the argument of a factor that turns by less between two points is beyond doubt."""

TINY = 1e-300
"""Keeps the logarithm of an inverse speed of zero finite."""

SHIFT = 0.05
"""Airspeed from which airspeeds are counted, as a fraction of the fastest, where T0 varies."""


@dataclass(frozen=True)
class EigenvaluePath:
    """Inverse speeds s_j along a path, in matched columns.

    Attributes
    ----------
    parameter : array, shape (m,)
        Position along the path, ascending.
    p : array of complex, shape (m,)
    inverse : array of complex, shape (m, r)
        s_j(p): T(p, U) is singular where V = 1/s_j.
    constant : array of complex, shape (m,)
        det T at V = 0, scaled to unit size: the part of det T that no airspeed changes.
    growth : array of complex, shape (m,)
        d log(det T)/d log p at V = 0; zero where T0 does not depend on p.
    power : int
        2 without structural damping, else 1.
    shift : float
        V = shift + U^power.
    floor : float
        Inverse speeds below this belong to airspeeds of no interest and are matched loosely.
    """

    parameter: Real
    p: Complex
    inverse: Complex
    constant: Complex
    growth: Complex
    power: int
    shift: float
    floor: float

    def measure(self, speed: Real | float) -> Real:
        """Return V of airspeeds in m/s."""
        return np.asarray(self.shift + speed**self.power)

    def speed(self, inverse: Real) -> Real:
        """Return the airspeeds in m/s of real inverse speeds, nan where there is none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            V = np.asarray(1.0 / inverse - self.shift)
            return np.asarray(np.where(V > 0.0, V, np.nan) ** (1.0 / self.power))


class Factors(NamedTuple):
    """The determinant of m pencils, det T = constant x product of 1 - V s_j up to its size.

    Attributes
    ----------
    inverse : array of complex, shape (m, r)
        Inverse speeds s_j.
    constant : array of complex, shape (m,)
        det T at V = 0, scaled to unit size.
    power : int
        2 without structural damping, else 1.
    """

    inverse: Complex
    constant: Complex
    power: int


def factors_of(pencil: Pencil, shift: float = 0.0) -> Factors:
    """Return the factors of the determinant.

    Undamped, the s_j are the n eigenvalues of -T(V = 0)^-1 T2; damped, the 2 n of a companion
    matrix.
    """
    E, F, power = _linear(_real_if_possible(pencil))
    if shift:
        E = E + shift * F
    if E.ndim == 3:
        inverse, constant = np.linalg.eigvals(np.linalg.solve(E, F)), np.linalg.slogdet(E)[0]
        return Factors(inverse.astype(complex), constant.astype(complex), power)
    unit = np.array_equal(E, np.eye(len(E)))
    inverse = np.linalg.eigvals(F if unit else np.linalg.inv(E) @ F)
    return Factors(inverse.astype(complex), np.ones(len(F), complex), power)


def _linear(pencil: Pencil) -> tuple[Complex, Complex, int]:
    """Return E, F and the power of U in the linear form E x = V F x of the pencil.

    E is two-dimensional when it does not depend on p.
    """
    T0, T1, T2 = pencil
    if T1 is None:
        return T0, -T2, 2
    m, n, _ = T2.shape
    F = np.zeros((m, 2 * n, 2 * n), T2.dtype)
    F[:, :n, :n], F[:, :n, n:], F[:, n:, :n] = -T1, -T2, np.eye(n)
    E = np.zeros((*T0.shape[:-2], 2 * n, 2 * n), T0.dtype)
    E[..., :n, :n], E[..., n:, n:] = T0, np.eye(n)
    return E, F, 1


def _real_if_possible(pencil: Pencil) -> Pencil:
    """Return a real pencil (on the real axis) as real arrays: four times faster to solve."""
    if pencil.constant.imag.any() or pencil.quadratic.imag.any():
        return pencil
    real = (None if part is None else part.real for part in pencil)
    return Pencil._make(real)


def follow_path(
    problem: AeroelasticProblem,
    point: Callable[[Real], Complex],
    parameter: Real,
    fastest: float,
) -> EigenvaluePath:
    """Compute the inverse speeds along a path and match them from point to point.

    Parameters
    ----------
    problem : AeroelasticProblem
    point : callable
        p as a function of the path parameter.
    parameter : array, shape (m,)
        Ascending.
    fastest : float
        Highest airspeed of interest in m/s.
    """
    p = point(parameter)
    pencil = problem.pencil(p)
    power = 2 if pencil.linear is None else 1
    shift = 0.0 if pencil.constant.ndim == 2 else (SHIFT * fastest) ** power
    inverse, constant, _ = factors_of(pencil, shift)
    floor = 1.0 / (shift + fastest**power)
    inverse = _matched(inverse, floor)
    growth = _growth(problem, p, shift)
    return EigenvaluePath(parameter, p, inverse, constant, growth, power, shift, floor)


def _growth(problem: AeroelasticProblem, p: Complex, shift: float) -> Complex:
    """Return d log(det T)/d log p at V = 0, which no airspeed changes."""
    if shift == 0.0:
        return np.zeros(len(p), complex)
    T, dT = (_at_rest(part, shift) for part in problem.pencil_with_derivative(p))
    return np.asarray(p * np.trace(np.linalg.solve(T, dT), axis1=1, axis2=2))


def _at_rest(pencil: Pencil, shift: float) -> Complex:
    """Return the value of a pencil at V = 0: U^2 = -shift, or U = -shift."""
    T0, T1, T2 = pencil
    return T0 - shift * T2 if T1 is None else T0 - shift * T1 + shift**2 * T2


def refined(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    point: Callable[[Real], Complex],
    extra: Real,
) -> EigenvaluePath:
    """Return the path with the parameters ``extra`` inserted."""
    p = point(extra)
    inverse, constant, _ = factors_of(problem.pencil(p), path.shift)
    parameter = np.concatenate([path.parameter, extra])
    order = np.argsort(parameter, kind="stable")
    return replace(
        path,
        parameter=parameter[order],
        p=np.concatenate([path.p, p])[order],
        inverse=_matched(np.vstack([path.inverse, inverse])[order], path.floor),
        constant=np.concatenate([path.constant, constant])[order],
        growth=np.concatenate([path.growth, _growth(problem, p, path.shift)])[order],
    )


def _matched(inverse: Complex, floor: float) -> Complex:
    """Reorder each row so that its eigenvalues continue those of the row before."""
    before, after = inverse[:-1, :, None], inverse[1:, None, :]
    cost = np.abs(before - after) / (np.abs(before) + np.abs(after) + floor)
    nearest = cost.argmin(axis=2)
    ambiguous = (np.diff(np.sort(nearest, axis=1), axis=1) == 0).any(axis=1)
    for step in np.flatnonzero(ambiguous):
        nearest[step] = linear_sum_assignment(cost[step])[1]
    order = np.arange(inverse.shape[1])
    result = np.empty_like(inverse)
    result[0] = inverse[0]
    for row, following in enumerate(nearest, start=1):
        order = following[order]
        result[row] = inverse[row, order]
    return result


def winding(path: EigenvaluePath, speeds: Real) -> tuple[Real, Mask]:
    """Change of arg det T along the path at each airspeed.

    Each factor 1 - V s of the determinant vanishes where L = log(V s) does. The branches are nearly
    straight in L, whatever the scale of k, so that the chord in L tells on which side the factor
    passes zero; the factor itself gives the exact angle.

    Parameters
    ----------
    path : EigenvaluePath
    speeds : array, shape (u,)

    Returns
    -------
    turns : array, shape (u,)
        Change of the argument in radians.
    doubtful : array of bool, shape (u, m - 1)
        Steps of the path on which the argument is not beyond doubt: L turns about zero by more than
        0.8 rad and its chord passes nearer to zero than twice the estimated bend of the branch.
        Refine the path there.
    """
    V = path.measure(speeds)[:, None, None]
    factors = 1.0 - V * path.inverse
    step = _logarithmic_steps(path)
    start = np.log(path.inverse[:-1] + TINY) + np.log(V)
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.angle(factors[:, 1:] / factors[:, :-1])
        turn = np.angle((start + step) / start)
    near = _distance_from_zero(start, step) <= 2.0 * bend(path)
    doubtful = (near & ~(np.abs(turn) <= CERTAIN_TURN)).any(axis=2)
    angle += 2.0 * np.pi * np.rint((turn - angle) / (2.0 * np.pi))
    constant, unsettled = _constant_turns(path)
    return angle.sum(axis=(1, 2)) + constant.sum(), doubtful | unsettled


def _constant_turns(path: EigenvaluePath) -> tuple[Real, Mask]:
    """Change of the argument of det T at V = 0 in each step, and where it is in doubt.

    It may turn by several radians while p runs around the far end of the region, in proportion to
    the argument of p, and by as much where a root of T at V = 0 stands beside the path. The growth
    at both ends tells which: where it is the same, the argument of p says how far it turned.
    """
    ahead, behind = path.growth[1:], path.growth[:-1]
    step = np.log(path.p[1:] / path.p[:-1])
    expected = ((ahead + behind) / 2.0 * step).imag
    turn = np.angle(path.constant[1:] / path.constant[:-1])
    turn += 2.0 * np.pi * np.rint((expected - turn) / (2.0 * np.pi))
    return np.asarray(turn), np.abs((ahead - behind) * step) > CERTAIN_TURN


def _logarithmic_steps(path: EigenvaluePath) -> Complex:
    return np.log((path.inverse[1:] + TINY) / (path.inverse[:-1] + TINY))


def _distance_from_zero(start: Complex, step: Complex) -> Real:
    """Distance of the origin from the chord start .. start + step."""
    length2 = np.maximum(np.abs(step) ** 2, TINY)
    along = np.clip(-(start * step.conj()).real / length2, 0.0, 1.0)
    return np.asarray(np.abs(start + along * step))


def bend(path: EigenvaluePath) -> Real:
    """Estimate how far log s strays from the chord of each step, shape (m - 1, r).

    From divided second differences at both ends of the step; at least a thousandth of the chord.
    """
    t, steps = path.parameter, _logarithmic_steps(path)
    width = np.diff(t)[:, None]
    second = np.abs(np.diff(steps / width, axis=0)) / (t[2:] - t[:-2])[:, None]
    ends = np.vstack([second[:1], second, second[-1:]])
    curvature = np.maximum(ends[:-1], ends[1:])
    return np.asarray(np.maximum(curvature * width**2 / 4.0, 0.001 * np.abs(steps)))


def crowded(inverse: Complex) -> Mask:
    """Return where two branches of opposite sign of Im s may be confused in a step, (m - 1, r).

    One of them moves more than half the way to the other.
    """
    s = inverse[:-1]
    apart = np.abs(s[:, :, None] - s[:, None, :])
    opposite = s.imag[:, :, None] * s.imag[:, None, :] < 0.0
    nearest = np.where(opposite, apart, np.inf).min(axis=2)
    return np.asarray(np.abs(np.diff(inverse, axis=0)) > 0.5 * nearest)
