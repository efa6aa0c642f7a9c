"""The flutter boundary as continuous curves, followed through the fold angle around its turns."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.results.schema import build_dataset
from foldwing.stability.continuation import BoundaryCurve, Limits, follow_boundary
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.status import FlutterPoint
from foldwing.studies.boundary import Boundary
from foldwing.studies.case import Case
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.grid import radians, swept_hinge

ON_CURVE = 0.03
"""Distance from a curve, as relative speed and frequency, below which a point lies on it."""

LARGEST_STEP = 2.5
"""First step of a curve in degrees, also where the sweep is coarser."""

SPLINE_POINTS = 8
"""Points of the spline for each sample of a curve."""


@dataclass(frozen=True)
class TracedCurve:
    """One branch of the flutter boundary.

    Attributes
    ----------
    fold : array, shape (m,)
        Angle of the swept hinge in degrees along the curve, or another parameter; not always
        ascending.
    speed, frequency, strength : array, shape (m,)
        In m/s, Hz and s/m.
    turns : tuple of (float, float, float)
        Angle, speed and frequency where the curve turns back: there an onset and a recovery meet.
    """

    fold: Real
    speed: Real
    frequency: Real
    strength: Real
    turns: tuple[tuple[float, float, float], ...]

    def passes(self, fold: float, speed: float, frequency: float, step: float) -> bool:
        """Return whether the curve passes a flutter point.

        Its samples are joined by a spline; ``step`` in degrees counts as much as a factor e of
        airspeed or frequency.
        """
        samples = np.column_stack([self.fold / step, np.log(self.speed), np.log(self.frequency)])
        target = np.array([fold / step, np.log(speed), np.log(frequency)])
        width = np.linalg.norm(np.diff(samples, axis=0), axis=1)
        samples = samples[np.concatenate([[True], width > 0.0])]
        if len(samples) < 2:
            return bool(np.linalg.norm(samples[0] - target) < ON_CURVE)
        length = np.concatenate([[0.0], width[width > 0.0].cumsum()])
        fine = np.linspace(0.0, length[-1], SPLINE_POINTS * len(length))
        start = CubicSpline(length, samples)(fine)
        chord = np.diff(start, axis=0)
        start = start[:-1]
        along = ((target - start) * chord).sum(axis=1) / (chord**2).sum(axis=1)
        nearest = start + np.clip(along, 0.0, 1.0)[:, None] * chord
        return bool(np.linalg.norm(nearest - target, axis=1).min() < ON_CURVE)

    def repeats(self, others: "Sequence[TracedCurve]", step: float) -> bool:
        """Return whether one of the other curves passes the ends and the middle of this one."""
        at = (0, len(self.fold) // 2, len(self.fold) - 1)
        samples = [(self.fold[i], self.speed[i], self.frequency[i], step) for i in at]
        return any(all(other.passes(*sample) for sample in samples) for other in others)


def trace_boundary(
    model: AeroelasticWing,
    cases: Sequence[Case],
    hinge: int,
    progress: Callable[[int], None] = lambda finished: None,
) -> list[TracedCurve]:
    """Follow every flutter point of a sweep of one fold angle, each curve once.

    A point that cannot be followed stays without a curve.

    Parameters
    ----------
    model : AeroelasticWing
    cases : sequence of Case
        Of ascending angle of the swept hinge; the other angles may depend on it linearly.
    hinge : int
        The swept hinge, from 2.
    progress : callable
        Called with the number of flutter points that lie on a curve already.
    """
    angles = [case.folds[hinge - 2] for case in cases]
    points = [
        (angle, point)
        for angle, case in zip(angles, cases, strict=True)
        for point in case.analysis.points
    ]
    tracing = Tracing(
        _family(model, cases, hinge),
        Limits((min(angles), max(angles)), cases[0].analysis.speed_range),
        min(float(np.median(np.diff(angles))), LARGEST_STEP),
        cases[0].analysis.threshold,
    )
    return tracing.curves(points, progress)


@dataclass(frozen=True)
class Tracing:
    """Flutter points of a family of systems joined into curves.

    Attributes
    ----------
    family : callable
        The system at a value of the parameter.
    limits : Limits
        Of the parameter and of the airspeed.
    step : float
        First change of the parameter.
    threshold : float
        Damping ratio of the boundary, positive stable.
    """

    family: Callable[[float], AeroelasticProblem]
    limits: Limits
    step: float
    threshold: float = 0.0

    def curves(
        self,
        points: Sequence[tuple[float, FlutterPoint]],
        progress: Callable[[int], None] = lambda finished: None,
    ) -> list[TracedCurve]:
        """Follow every flutter point, each curve once; one that cannot be followed has none.

        Parameters
        ----------
        points : sequence of (float, FlutterPoint)
            With the value of the parameter; others than flutter are passed over.
        progress : callable
            Called with the number of flutter points that lie on a curve already.
        """
        left = [(at, point) for at, point in points if point.kind == "flutter"]
        total = len(left)
        curves: list[TracedCurve] = []
        while left:
            at, point = left.pop(len(left) // 2)
            try:
                curve = self._both_ways(at, point)
            except NUMERICAL_FAILURES:
                continue
            if not curve.repeats(curves, self.step):
                curves.append(curve)
            left = [
                (other, point)
                for other, point in left
                if not curve.passes(other, point.speed, point.frequency, self.step)
            ]
            progress(total - len(left))
        return curves

    def _both_ways(self, at: float, point: FlutterPoint) -> TracedCurve:
        start = (at, point.p.imag, point.speed)
        ahead = follow_boundary(self.family, start, self.step, self.limits, self.threshold)
        samples, turns = _samples(ahead), ahead.turns
        if ahead.end != "closed":
            behind = follow_boundary(self.family, start, -self.step, self.limits, self.threshold)
            samples = np.hstack([_samples(behind)[:, :0:-1], samples])
            turns = (*behind.turns[::-1], *turns)
        parameter, k, speed, strength = samples
        per_k = 1.0 / (2.0 * np.pi * self.family(at).half_chord)
        return TracedCurve(
            parameter,
            speed,
            k * speed * per_k,
            strength,
            tuple((s, U, k * U * per_k) for s, k, U in turns),
        )


def _family(
    model: AeroelasticWing, cases: Sequence[Case], hinge: int
) -> Callable[[float], AeroelasticSystem]:
    first, last = np.array(cases[0].folds), np.array(cases[-1].folds)
    swept = hinge - 2

    @lru_cache(maxsize=8)
    def system(angle: float) -> AeroelasticSystem:
        share = (angle - first[swept]) / (last[swept] - first[swept])
        return model.system(model.modes(radians(first + share * (last - first))))

    return system


def _samples(curve: BoundaryCurve) -> Real:
    """Return fold, k, U and strength along a curve, shape (4, m)."""
    return np.array([curve.parameter, curve.reduced_frequency, curve.speed, curve.strength])


def with_curves(
    boundary: Boundary,
    model: AeroelasticWing,
    progress: Callable[[int], None] = lambda finished: None,
) -> Boundary:
    """Return a boundary with its flutter points joined into curves.

    Parameters
    ----------
    boundary : Boundary
        Over the angle of one hinge, as `check_traceable` asks for.
    model : AeroelasticWing
    progress : callable
        Called with the number of flutter points that lie on a curve already.
    """
    cases = [outcome.case for outcome in boundary.outcomes if outcome.case is not None]
    hinge = swept_hinge([case.folds for case in cases])
    if hinge is None:
        return boundary
    cases = sorted(cases, key=lambda case: case.folds[hinge - 2])
    curves = trace_boundary(model, cases, hinge, progress)
    if not curves:
        return boundary
    turning = sorted(angle for curve in curves for angle, _, _ in curve.turns)
    attrs = boundary.dataset.attrs | {"turning": ", ".join(f"{angle:.2f}" for angle in turning)}
    drawn = build_dataset(*_curve_variables(curves), attrs)
    return replace(boundary, dataset=boundary.dataset.merge(drawn).assign_attrs(attrs))


def check_traceable(cases: Sequence[tuple[float, ...]]) -> None:
    """Raise `InputError` unless the cases lie on one line of fold angles."""
    hinge = swept_hinge(cases)
    angles = np.array(cases)
    if hinge is not None:
        line = np.polyfit(angles[:, hinge - 2], angles, 1)
        straight = np.abs(np.outer(angles[:, hinge - 2], line[0]) + line[1] - angles).max() < 1e-6
        if straight and len(set(angles[:, hinge - 2])) == len(cases):
            return
    remedy = "Give one range, such as --fold2 0:150:2.5, and numbers or level for the others."
    raise InputError("--trace", "a grid", "curves follow a single swept fold angle", remedy)


def _curve_variables(curves: Sequence[TracedCurve]) -> tuple[dict[str, Any], dict[str, Any]]:
    dims = ("curve_sample",)
    sizes = [len(curve.fold) for curve in curves]
    variables = {
        f"curve_{name}": (dims, np.concatenate([getattr(curve, name) for curve in curves]))
        for name in ("fold", "speed", "frequency", "strength")
    }
    variables["curve_id"] = (dims, np.repeat(np.arange(len(curves)), sizes))
    variables["curve_kind"] = (dims, np.full(sum(sizes), "flutter"))
    return variables, {"curve_sample": (dims, np.arange(sum(sizes)))}
