"""Flutter points followed through a parameter of the system, such as a fold angle.

A flutter point is a real solution (k, U) of T(k ray, U; s) x = 0. As the parameter s varies it
draws a curve, which may turn back (a hump that appears or vanishes). The curve is followed by arc
length, so that turning points are passed like any other.

The equation solved is r(k, U, s) = 1 / trace(T^-1 dT/dp) = 0, which does not depend on the signs
or the order of the modes in which T is written, and so stays smooth while the modes change with s.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Complex, Real
from foldwing.stability.newton import null_vectors, polish_crossings
from foldwing.stability.problem import AeroelasticProblem, Evaluation, evaluate_with_derivatives

Family = Callable[[float], AeroelasticProblem]
"""A system for every value of a parameter."""

DIFFERENCE = 1e-4
"""Step of the parameter's derivative, as a fraction of the first step."""

TOLERANCE = 1e-7
"""Size of the last correction, relative to k, U and the first step."""

SMALLEST_STEP = 1e-4
"""Fraction of the first step below which the curve is given up."""

LAST_STEP = 0.01
"""Step at which a curve that leaves its limits is ended: its last point is so near to them."""

LONGEST_STEP = 2.0
"""Most arc length of a step, in first steps."""

LEAST_COSINE, EASY_COSINE = 0.9, 0.998
"""Consecutive tangents must be this alike; when they are very alike the step grows."""

SAME_POINT = 0.02
"""A curve is closed when a step passes its start within this fraction of its length."""

LEAST_FREQUENCY = 1e-4
"""Reduced frequency at which a curve has reached divergence."""


@dataclass(frozen=True)
class BoundaryCurve:
    """A branch of the flutter boundary.

    Attributes
    ----------
    parameter : array, shape (m,)
        Values of s along the curve, not always ascending.
    reduced_frequency, speed : array, shape (m,)
        k and U in m/s.
    strength : array, shape (m,)
        d(Re lambda / Im lambda)/dU in s/m; passes zero where the curve turns back.
    turns : tuple of (float, float, float)
        s, k and U where the curve turns back, in the order of the curve.
    end : str
        Why it ended: ``parameter`` or ``speed`` left its range, ``zero frequency``, ``closed``,
        ``lost``, or ``length`` (as many points as allowed).
    """

    parameter: Real
    reduced_frequency: Real
    speed: Real
    strength: Real
    turns: tuple[tuple[float, float, float], ...]
    end: str

    @property
    def turning(self) -> tuple[float, ...]:
        """Values of s at which the curve turns back."""
        return tuple(s for s, _, _ in self.turns)


@dataclass(frozen=True)
class Limits:
    """Where a curve ends.

    Attributes
    ----------
    parameter, speed : (float, float)
        Ranges of s and of U in m/s.
    points : int
        Most points of a curve.
    """

    parameter: tuple[float, float]
    speed: tuple[float, float]
    points: int = 400


def follow_boundary(
    family: Family,
    start: tuple[float, float, float],
    first_step: float,
    limits: Limits,
    threshold: float = 0.0,
) -> BoundaryCurve:
    """Follow a flutter point through the parameter of a family of systems.

    Parameters
    ----------
    family : callable
        Returns the system at a value of s.
    start : (float, float, float)
        s, k and U of a flutter point.
    first_step : float
        First change of s; its sign is the direction.
    limits : Limits
    threshold : float
        Damping ratio of the boundary, positive stable.

    Raises
    ------
    ValueError
        When there is no flutter point near the start.
    """
    s, k, U = start
    roots = polish_crossings(family(s), np.array([k]), np.array([U]), threshold)
    if not roots.converged[0]:
        raise ValueError(f"no flutter point near k = {k:g}, U = {U:g} m/s at s = {s:g}")
    equation = _Equation(family, abs(first_step), 1j - threshold)
    at = np.array([np.log(roots.p[0].imag), np.log(roots.speed[0]), s / abs(first_step)])
    ahead = np.array([0.0, 0.0, np.sign(first_step)])
    points, tangents, end = _followed(equation, at, ahead, limits)
    return _curve(equation, np.array(points), np.array(tangents), end)


def point_between(
    family: Family,
    ends: tuple[tuple[float, float, float], tuple[float, float, float]],
    share: float,
    threshold: float = 0.0,
) -> tuple[float, float, float] | None:
    """Return s, k and U of the curve between two of its points, across their chord.

    Well conditioned also where the curve is steep in s, or turns back.

    Parameters
    ----------
    family : callable
        Returns the system at a value of s.
    ends : pair of (float, float, float)
        s, k and U of two points of the curve, close to each other.
    share : float
        Part of the way along the chord, 0 to 1.
    threshold : float
        Damping ratio of the boundary, positive stable.

    Returns
    -------
    tuple of float, or None
        None when the iteration does not converge.
    """
    equation = _Equation(family, abs(ends[1][0] - ends[0][0]), 1j - threshold)
    start, end = (np.array([np.log(k), np.log(U), s / equation.scale]) for s, k, U in ends)
    chord = end - start
    found = equation.corrected(start + share * chord, chord / np.linalg.norm(chord))
    if found is None:
        return None
    return float(found[2] * equation.scale), float(np.exp(found[0])), float(np.exp(found[1]))


@dataclass(frozen=True)
class _Equation:
    """r = 0 in the variables v = (log k, log U, s / first step)."""

    family: Family
    scale: float
    ray: complex

    def value(self, v: Real) -> complex:
        """Return r / p."""
        p, T = self._evaluated(v, v[2])
        try:
            step = np.trace(np.linalg.solve(T.value[0], T.by_p[0]))
        except np.linalg.LinAlgError:
            return 0j
        return complex(1.0 / (step * p[0]))

    def jacobian(self, v: Real) -> Real:
        """Return the derivatives of Re and Im of r / p at a solution, shape (2, 3)."""
        p, T = self._evaluated(v, v[2])
        x, y = null_vectors(T.value)
        by_p = y[0] @ T.by_p[0] @ x[0]
        by_speed = y[0] @ T.by_speed[0] @ x[0]
        beside = self.value(v + np.array([0.0, 0.0, DIFFERENCE]))
        before = self.value(v - np.array([0.0, 0.0, DIFFERENCE]))
        columns = [
            1.0 + 0j,
            complex(by_speed / by_p * np.exp(v[1]) / p[0]),
            (beside - before) / (2.0 * DIFFERENCE),
        ]
        return np.array([np.real(columns), np.imag(columns)], float)

    def tangent(self, v: Real, ahead: Real) -> Real:
        """Return the unit tangent of the curve that points as ``ahead`` does."""
        J = self.jacobian(v)
        t = np.cross(J[0], J[1])
        t = t / np.linalg.norm(t)
        return np.asarray(t if t @ ahead > 0.0 else -t)

    def corrected(self, v: Real, tangent: Real) -> Real | None:
        """Return the solution in the plane through ``v`` across the tangent; None without one."""
        start = v
        for _ in range(8):
            r = self.value(v)
            A = np.vstack([self.jacobian(v), tangent])
            step = np.linalg.solve(A, np.array([-r.real, -r.imag, -(v - start) @ tangent]))
            if not np.all(np.isfinite(step)) or np.abs(step).max() > 0.5:
                return None
            v = v + step
            if np.abs(step).max() < TOLERANCE:
                return v
        return None

    def strength(self, v: Real) -> float:
        """Return d(Re lambda / Im lambda)/dU in s/m."""
        p, T = self._evaluated(v, v[2])
        x, y = null_vectors(T.value)
        p_U = -(y[0] @ T.by_speed[0] @ x[0]) / (y[0] @ T.by_p[0] @ x[0])
        return float((p_U.real * p[0].imag - p[0].real * p_U.imag) / p[0].imag ** 2)

    def _evaluated(self, v: Real, parameter: float) -> tuple[Complex, Evaluation]:
        p = np.array([np.exp(v[0]) * self.ray])
        problem = self.family(float(parameter * self.scale))
        return p, evaluate_with_derivatives(problem, p, np.array([np.exp(v[1])]))


def _followed(
    equation: _Equation, at: Real, ahead: Real, limits: Limits
) -> tuple[list[Real], list[Real], str]:
    """Step along the curve until it ends; at a limit, with ever smaller steps up to it."""
    points, tangents, step = [at], [equation.tangent(at, ahead)], 1.0
    longest = LONGEST_STEP
    while len(points) < limits.points:
        new = equation.corrected(points[-1] + step * tangents[-1], tangents[-1])
        tangent = None if new is None else equation.tangent(new, tangents[-1])
        if new is None or tangent is None or tangent @ tangents[-1] < LEAST_COSINE:
            step /= 2.0
            if step < SMALLEST_STEP:
                return points, tangents, "lost"
            continue
        end = _end([*points, new], limits, equation.scale)
        if end and end != "closed":
            longest = step = step / 2.0
            if step < LAST_STEP:
                return points, tangents, end
            continue
        points.append(new)
        tangents.append(tangent)
        if end:
            return points, tangents, end
        smooth = tangent @ tangents[-2] > EASY_COSINE
        step = min(2.0 * step, longest) if smooth else step
    return points, tangents, "length"


def _end(points: list[Real], limits: Limits, scale: float) -> str:
    log_k, log_U, s = points[-1]
    low, high = limits.parameter
    if not low <= s * scale <= high:
        return "parameter"
    if not limits.speed[0] <= np.exp(log_U) <= limits.speed[1]:
        return "speed"
    if np.exp(log_k) < LEAST_FREQUENCY:
        return "zero frequency"
    return "closed" if len(points) > 4 and _passes(points[-2], points[-1], points[0]) else ""


def _passes(before: Real, after: Real, start: Real) -> bool:
    """Return whether the chord of the last step passes through the start of the curve."""
    chord = after - before
    along = (start - before) @ chord / (chord @ chord)
    distance = np.linalg.norm(before + along * chord - start)
    return bool(0.0 < along <= 1.0 and distance < SAME_POINT * np.linalg.norm(chord))


def _curve(equation: _Equation, points: Real, tangents: Real, end: str) -> BoundaryCurve:
    along = tangents[:, 2]
    turns = np.flatnonzero(along[:-1] * along[1:] < 0.0)
    return BoundaryCurve(
        parameter=points[:, 2] * equation.scale,
        reduced_frequency=np.exp(points[:, 0]),
        speed=np.exp(points[:, 1]),
        strength=np.array([equation.strength(v) for v in points]),
        turns=tuple(_turning_point(equation, points[i : i + 2], tangents[i]) for i in turns),
        end=end,
    )


def _turning_point(equation: _Equation, ends: Real, tangent: Real) -> tuple[float, float, float]:
    """Return s, k and U where the curve turns back between two of its points."""
    start, length = ends[0], float((ends[1] - ends[0]) @ tangent)

    def at(length: float) -> Real:
        new = equation.corrected(start + length * tangent, tangent)
        return start if new is None else new

    def direction(length: float) -> float:
        return float(equation.tangent(at(length), tangent)[2])

    top = brentq(direction, 0.0, length, xtol=1e-6 * length)
    log_k, log_U, s = at(top)
    return float(s * equation.scale), float(np.exp(log_k)), float(np.exp(log_U))
