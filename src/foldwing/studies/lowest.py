"""Where the lowest onset over a parameter changes from one curve to another, located exactly.

The curves of flutter onsets are cut where they turn back. Between two neighbouring samples of any
of them the lowest curve is known; where it changes, either a curve has turned back, and the lowest
airspeed jumps, or two curves cross, and the motion and its frequency change at one airspeed.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from foldwing.maths.arrays import Real
from foldwing.stability.continuation import point_between
from foldwing.stability.crossings import divergence_speeds
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_crossings
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.status import FlutterPoint
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.trace import TracedCurve

Family = Callable[[float], AeroelasticProblem]
Point = tuple[float, float]
"""Airspeed and frequency (0 for divergence)."""

BESIDE = (1e-6, 1e-4)
"""Relative distances in the parameter at which a change is confirmed by a search of its own: the
second where two points that have just come into being are too close to be told apart."""

NARROW = 4.0
"""Factor around the airspeeds of a change within which it is sought where a search of the whole
range passes over two points close to each other."""

SAME = 1e-9
"""Relative difference in the parameter below which two changes are one, found twice."""

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

    def slope(self, window: tuple[float, float]) -> float:
        """Return how steep the airspeed is within a window of the parameter, on average."""
        low, high = np.clip(window, self.parameter[0], self.parameter[-1])
        speeds = np.log([self.near(low)[0], self.near(high)[0]])
        return float(abs(np.diff(speeds)[0]) / (high - low)) if high > low else 0.0

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


def divergence_onsets(
    family: Family, points: Sequence[tuple[float, FlutterPoint]], ratios: Real, around: Point
) -> list[Onsets]:
    """Return the lowest onsets of divergence in stretches of neighbouring cases.

    Parameters
    ----------
    family : callable
        The system at a value of the parameter.
    points : sequence of (float, FlutterPoint)
        What was found, with the value of the parameter.
    ratios : array, shape (m,)
        The values looked at, ascending.
    around : (float, float)
        Values beyond both ends up to which the first and the last stretch are continued.
    """
    lowest: dict[float, float] = {}
    for at, point in points:
        if (point.kind, point.event) == ("divergence", "onset"):
            lowest[at] = min(point.speed, lowest.get(at, np.inf))
    stretches, run = [], [around[0]] if float(ratios[0]) in lowest else []
    for at in [*ratios.tolist(), np.inf]:
        if at in lowest:
            run.append(at)
        elif run:
            run += [around[1]] if run[-1] == float(ratios[-1]) else []
            stretches.append(run)
            run = []
    speeds = [
        [lowest[at] if at in lowest else float(divergence_speeds(family(at))[0]) for at in run]
        for run in stretches
    ]
    return [
        Onsets(np.array(run), np.array(speed), np.zeros(len(run)), (False, False))
        for run, speed in zip(stretches, speeds, strict=True)
        if len(run) > 1
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
    found: list[Change] = []
    for cell, (old, new) in enumerate(pairwise(lowest)):
        if old is new:
            continue
        change = _turn(family, old, new, float(grid[cell + 1]), threshold)
        if change is None and old is not None and new is not None:
            window = grid[max(cell + 1 - WIDEST, 0)], grid[min(cell + 1 + WIDEST, len(grid) - 1)]
            change = _crossing(family, (old, new), window, threshold)
        known = (abs(change.parameter / other.parameter - 1.0) < SAME for other in found if change)
        if change is not None and not any(known):
            found.append(_confirmed(family, change, speed_range, threshold))
    return found


def _lowest(stretches: Sequence[Onsets], at: float) -> Onsets | None:
    here = [one for one in stretches if one.parameter[0] <= at <= one.parameter[-1]]
    return min(here, key=lambda one: one.near(at)[0], default=None)


def _turn(
    family: Family, old: Onsets | None, new: Onsets | None, at: float, threshold: float
) -> Change | None:
    """Return the jump where one of two stretches ends because its curve turns back.

    None when it turns back above the other one: then they cross beside that point.
    """
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
    if (ends and below[0] > above[0]) or (begins and above[0] > below[0]):
        return None
    return Change(at, "jump", (below[0], above[0]), (below[1], above[1]), False)


def _crossing(
    family: Family, pair: tuple[Onsets, Onsets], window: tuple[float, float], threshold: float
) -> Change | None:
    """Return where two stretches have the same airspeed; None when they do not cross there.

    The point moves along the steeper of them and is compared with the other one above or below it.
    """
    steep, other = sorted(pair, key=lambda one: one.slope(window), reverse=True)
    if steep.diverges:
        steep, other = other, steep
    low = max(window[0], float(other.parameter[0]))
    high = min(window[1], float(other.parameter[-1]))
    inside = np.flatnonzero((steep.parameter >= low) & (steep.parameter <= high))
    above = [
        float(steep.speed[i]) - other.exact(family, float(steep.parameter[i]), threshold)[0]
        for i in inside
    ]
    signs = np.flatnonzero(np.diff(np.sign(above)))
    if steep.diverges or not len(signs):
        return None
    first = int(inside[signs[0]])
    found = _meeting(family, steep, other, first, threshold)
    if found is None:
        return None
    at, one = found
    two = other.exact(family, at, threshold)
    below, beyond = (one, two) if above[signs[0]] < 0.0 else (two, one)
    return Change(at, "crossing", (below[0], beyond[0]), (below[1], beyond[1]), False)


def _meeting(
    family: Family, steep: Onsets, other: Onsets, first: int, threshold: float
) -> tuple[float, Point] | None:
    """Return parameter and point where a stretch meets another between two of its samples."""
    per_k = 2.0 * np.pi * family(float(steep.parameter[first])).half_chord
    rows = zip(steep.parameter, steep.frequency * per_k / steep.speed, steep.speed, strict=True)
    samples = [(float(s), float(k), float(U)) for s, k, U in rows]
    ends = (samples[first], samples[first + 1])

    def point(share: float) -> tuple[float, float, float]:
        found = point_between(family, ends, share, threshold)
        if found is None:
            raise ArithmeticError("the curve is lost between two of its points")
        return found

    def above(share: float) -> float:
        s, _, U = point(share)
        return U - other.exact(family, s, threshold)[0]

    try:
        s, k, U = point(float(brentq(above, 0.0, 1.0, xtol=1e-14)))
    except NUMERICAL_FAILURES:
        return None
    return s, (U, k * U / per_k)


def _confirmed(
    family: Family, change: Change, speed_range: tuple[float, float], threshold: float
) -> Change:
    """Return the change with the verdict of a search on either side."""
    expected = list(zip(change.speed, change.frequency, strict=True))

    narrow = (
        max(speed_range[0], float(np.nanmin(change.speed)) / NARROW),
        min(speed_range[1], float(np.nanmax(change.speed)) * NARROW),
    )

    def same(distance: float, speeds: tuple[float, float]) -> bool:
        sides = (change.parameter * (1.0 - distance), change.parameter * (1.0 + distance))
        try:
            return all(
                _found(family(at), point, speeds, threshold)
                for at, point in zip(sides, expected, strict=True)
            )
        except NUMERICAL_FAILURES:
            return False

    searches = ((distance, speeds) for speeds in (speed_range, narrow) for distance in BESIDE)
    return replace(change, confirmed=any(same(*search) for search in searches))


def _found(
    problem: AeroelasticProblem,
    expected: Point,
    speed_range: tuple[float, float],
    threshold: float,
) -> bool:
    points = find_flutter(problem, speed_range, threshold).points
    point = next((point for point in points if point.event == "onset"), None)
    if point is None:
        return bool(np.isnan(expected[0]))
    speed, frequency = expected
    alike = abs(point.speed - speed) <= ALIKE * speed
    return bool(alike and abs(point.frequency - frequency) <= ALIKE * frequency)
