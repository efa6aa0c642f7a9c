"""The flutter boundary of a section as curves over its torsion frequency ratio."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.stability.continuation import Limits
from foldwing.stability.status import FlutterPoint
from foldwing.studies.lowest import Change, Family, Onsets, changes, divergence_onsets, onsets
from foldwing.studies.trace import TracedCurve, Tracing

Variables = dict[str, Any]

STEP, LARGEST_STEP = 0.3, 0.02
"""First step of a curve as a fraction of the sweep's step, and at most of its range: a curve may be
steep between two cases."""

BEYOND = 0.05
"""Part of a first step by which curves are followed beyond the range: they end short of a limit."""


def traced(
    family: Family,
    ratios: Real,
    points: Sequence[tuple[float, FlutterPoint]],
    speeds: tuple[float, float],
    threshold: float,
) -> tuple[list[TracedCurve], list[Onsets], list[Change]]:
    """Return curves through all flutter points, divergence, and where the lowest onset changes.

    Parameters
    ----------
    family : callable
        The system at a torsion frequency ratio.
    ratios : array, shape (m,)
        Ascending, at least two.
    points : sequence of (float, FlutterPoint)
        Flutter points with their torsion frequency ratio.
    speeds : (float, float)
        Airspeeds between which they were sought.
    threshold : float
        Damping ratio of the boundary, positive stable.
    """
    low, high = float(ratios[0]), float(ratios[-1])
    step = min(STEP * float(np.median(np.diff(ratios))), LARGEST_STEP * (high - low))
    around = (max(low - BEYOND * step, 0.5 * low), high + BEYOND * step)
    curves = Tracing(family, Limits(around, speeds), step, threshold).curves(points)
    diverging = divergence_onsets(family, points, ratios, around)
    stretches = [stretch for curve in curves for stretch in onsets(curve)]
    found = changes(family, [*stretches, *diverging], speeds, threshold)
    return curves, diverging, [change for change in found if low <= change.parameter <= high]


def curve_variables(
    curves: Sequence[TracedCurve], diverging: Sequence[Onsets], unit: float
) -> tuple[Variables, Variables]:
    """Return the curves as variables and coordinates; frequencies are multiplied by ``unit``."""
    dims = ("curve_sample",)
    flutter = [
        (curve.fold, curve.speed, curve.frequency * unit, curve.strength) for curve in curves
    ]
    divergence = [
        (one.parameter, one.speed, one.frequency, np.full(len(one.speed), np.nan))
        for one in diverging
    ]
    every = flutter + divergence
    if not every:
        return {}, {}
    sizes = [len(samples[0]) for samples in every]
    names = ("torsion_ratio", "speed", "frequency", "strength")
    columns = (np.concatenate(column) for column in zip(*every, strict=True))
    variables: Variables = {
        f"curve_{name}": (dims, column) for name, column in zip(names, columns, strict=True)
    }
    kinds = ["flutter"] * len(flutter) + ["divergence"] * len(divergence)
    variables["curve_id"] = (dims, np.repeat(np.arange(len(every)), sizes))
    variables["curve_kind"] = (dims, np.repeat(np.array(kinds), sizes))
    return variables, {"curve_sample": (dims, np.arange(sum(sizes)))}
