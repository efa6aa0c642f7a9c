"""Where the lowest onset over a parameter changes from one curve to another, located exactly.

The curves of flutter onsets are cut where they turn back. Between two neighbouring samples of any
of them the lowest curve is known; where it changes, either a curve has turned back, and the lowest
airspeed jumps, or two curves cross, and the motion and its frequency change at one airspeed.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Real
from foldwing.stability.crossings import divergence_speeds
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_crossings
from foldwing.stability.problem import AeroelasticProblem
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.trace import TracedCurve

Family = Callable[[float], AeroelasticProblem]
Point = tuple[float, float]
"""Airspeed and frequency (0 for divergence)."""

BESIDE = 1e-6
"""Relative distance in the parameter at which a change is confirmed by a search of its own."""

ALIKE = 0.05
"""Relative difference in airspeed and frequency below which that search finds the same point: a
curve that turns back leaves with the square root of the distance."""

WIDEST = 4
"""Intervals between samples over which the crossing of two curves is sought."""


@dataclass(frozen=True)
class Onsets:
    """A stretch of onsets along which the parameter ascends.

    Attributes
    ----------
    parameter, speed, frequency : array, shape (m,)
        Frequency 0 for divergence.
    turns : (bool, bool)
        Whether the curve turns back at its lower and at its upper end.
    """

    parameter: Real
    speed: Real
    frequency: Real
    turns: tuple[bool, bool]

    @property
    def diverges(self) -> bool:
        """Whether these are onsets of divergence."""
        return not self.frequency.any()

    def near(self, at: float) -> Point:
        """Return airspeed and frequency between the samples."""
        return (
            float(np.interp(at, self.parameter, self.speed)),
            float(np.interp(at, self.parameter, self.frequency)),
        )

    def exact(self, family: Family, at: float, threshold: float) -> Point:
        """Return airspeed and frequency at a value of the parameter, converged."""
        problem, (speed, frequency) = family(at), self.near(at)
        if self.diverges:
            return float(divergence_speeds(problem)[0]), 0.0
        per_k = 2.0 * np.pi * problem.half_chord
        k = np.array([frequency * per_k / speed])
        root = polish_crossings(problem, k, np.array([speed]), threshold)
        if not root.converged[0]:
            return speed, frequency
        return float(root.speed[0]), float(root.p[0].imag * root.speed[0] / per_k)


@dataclass(frozen=True)
class Change:
    """The lowest onset goes over from one curve to another.

    Attributes
    ----------
    parameter : float
    kind : str
        ``jump``: a curve turns back, and the lowest airspeed is not continuous; ``crossing``: two
        curves have the same airspeed.
    speed, frequency : (float, float)
        Just below and just above that parameter; nan where nothing becomes unstable, frequency 0
        for divergence.
    confirmed : bool
        Whether searches on both sides, which know nothing of curves, find these points.
    """

    parameter: float
    kind: Literal["jump", "crossing"]
    speed: Point
    frequency: Point
    confirmed: bool


def onsets(curve: TracedCurve) -> list[Onsets]:
    """Return the stretches of onsets of a curve, each with the points where it turns back."""
    points = _with_turns(curve)
    cuts = [0, *np.flatnonzero(points[:, 3]).tolist(), len(points) - 1]
    stretches = []
    for first, last in pairwise(cuts):
        part = points[first : last + 1]
        if len(part) < 2 or np.median(part[:, 4]) <= 0.0:
            continue
        turns = (bool(part[0, 3]), bool(part[-1, 3]))
        if part[-1, 0] < part[0, 0]:
            part, turns = part[::-1], turns[::-1]
        stretches.append(Onsets(part[:, 0], part[:, 1], part[:, 2], turns))
    return stretches


def _with_turns(curve: TracedCurve) -> Real:
    """Return the curve with its turning points among its samples.

    Columns: parameter, speed, frequency, whether it is a turn, strength (0 at a turn).
    """
    samples = np.column_stack(
        [curve.fold, curve.speed, curve.frequency, np.zeros(len(curve.fold)), curve.strength]
    )
    steps = np.diff(curve.fold)
    after = 1 + np.flatnonzero(curve.strength[:-1] * curve.strength[1:] < 0.0)
    if len(after) != len(curve.turns) or not steps.size:
        return samples
    rows = [[*turn, 1.0, 0.0] for turn in curve.turns]
    return np.insert(samples, after, np.array(rows).reshape(-1, 5), axis=0)


def divergence_onsets(family: Family, values: Real, highest: float) -> list[Onsets]:
    """Return the lowest divergence speeds at values of the parameter, where there are any."""
    found = [divergence_speeds(family(float(value))) for value in values]
    speed = np.array([speeds[0] if len(speeds) else np.inf for speeds in found])
    runs = np.split(np.arange(len(values)), np.flatnonzero(np.diff(speed <= highest)) + 1)
    return [
        Onsets(values[run], speed[run], np.zeros(len(run)), (False, False))
        for run in runs
        if len(run) > 1 and speed[run[0]] <= highest
    ]


def changes(
    family: Family,
    stretches: Sequence[Onsets],
    speed_range: tuple[float, float],
    threshold: float,
) -> list[Change]:
    """Return where the lowest onset goes over from one stretch to another, by parameter.

    Parameters
    ----------
    family : callable
        The system at a value of the parameter.
    stretches : sequence of Onsets
    speed_range : (float, float)
        Of the searches that confirm a change, in m/s.
    threshold : float
        Damping ratio of the boundary, positive stable.
    """
    if not stretches:
        return []
    grid = np.unique(np.concatenate([stretch.parameter for stretch in stretches]))
    middles = (grid[1:] + grid[:-1]) / 2.0
    lowest = [_lowest(stretches, float(at)) for at in middles]
    found = []
    for cell, (old, new) in enumerate(pairwise(lowest)):
        if old is new:
            continue
        change = _turn(family, old, new, float(grid[cell + 1]), threshold)
        if change is None and old is not None and new is not None:
            window = grid[max(cell + 1 - WIDEST, 0)], grid[min(cell + 1 + WIDEST, len(grid) - 1)]
            change = _crossing(family, (old, new), window, threshold)
        if change is not None:
            found.append(_confirmed(family, change, speed_range, threshold))
    return found


def _lowest(stretches: Sequence[Onsets], at: float) -> Onsets | None:
    here = [one for one in stretches if one.parameter[0] <= at <= one.parameter[-1]]
    return min(here, key=lambda one: one.near(at)[0], default=None)


def _turn(
    family: Family, old: Onsets | None, new: Onsets | None, at: float, threshold: float
) -> Change | None:
    """Return the jump where one of two stretches ends because its curve turns back."""
    ends = old is not None and old.turns[1] and old.parameter[-1] == at
    begins = new is not None and new.turns[0] and new.parameter[0] == at
    if not ends and not begins:
        return None

    def value(stretch: Onsets | None, turning: bool, end: int) -> Point:
        if stretch is None:
            return np.nan, np.nan
        if turning:
            return float(stretch.speed[end]), float(stretch.frequency[end])
        return stretch.exact(family, at, threshold)

    below, above = value(old, ends, -1), value(new, begins, 0)
    return Change(at, "jump", (below[0], above[0]), (below[1], above[1]), False)


def _crossing(
    family: Family, pair: tuple[Onsets, Onsets], window: tuple[float, float], threshold: float
) -> Change | None:
    """Return where two stretches have the same airspeed; None when they do not cross there."""
    old, new = pair
    low = max(window[0], float(old.parameter[0]), float(new.parameter[0]))
    high = min(window[1], float(old.parameter[-1]), float(new.parameter[-1]))

    def difference(at: float) -> float:
        return old.exact(family, at, threshold)[0] - new.exact(family, at, threshold)[0]

    if high <= low or difference(low) * difference(high) >= 0.0:
        return None
    at = float(brentq(difference, low, high, xtol=1e-12))
    below, above = (stretch.exact(family, at, threshold) for stretch in pair)
    return Change(at, "crossing", (below[0], above[0]), (below[1], above[1]), False)


def _confirmed(
    family: Family, change: Change, speed_range: tuple[float, float], threshold: float
) -> Change:
    """Return the change with the verdict of a search on either side."""
    sides = (change.parameter * (1.0 - BESIDE), change.parameter * (1.0 + BESIDE))
    expected = zip(change.speed, change.frequency, strict=True)
    try:
        same = [
            _found(family(at), point, speed_range, threshold)
            for at, point in zip(sides, expected, strict=True)
        ]
    except NUMERICAL_FAILURES:
        same = [False]
    return Change(change.parameter, change.kind, change.speed, change.frequency, all(same))


def _found(
    problem: AeroelasticProblem,
    expected: Point,
    speed_range: tuple[float, float],
    threshold: float,
) -> bool:
    point = find_flutter(problem, speed_range, threshold).critical
    if point is None:
        return bool(np.isnan(expected[0]))
    speed, frequency = expected
    alike = abs(point.speed - speed) <= ALIKE * speed
    return bool(alike and abs(point.frequency - frequency) <= ALIKE * frequency)
