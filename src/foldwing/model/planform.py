"""The outline of a segment in its own plane, and the two edges at which hinges lie.

Local axes are those of the flat wing, x aft and y outboard; their origin is the point of the
inboard edge at which the segment hangs on its neighbour.
"""

from functools import lru_cache
from typing import Self

import numpy as np
from pydantic import model_validator

from foldwing.maths.arrays import Indices, Mask, Real
from foldwing.model.faults import fault
from foldwing.model.listed import Point
from foldwing.model.record import Record

ROUND_OFF = 1e-9
"""Share of the size of an outline within which points or directions are the same."""

FEWEST, MOST = 3, 200
"""Corners of an outline."""

_ORDER = (
    "Start with the inboard leading corner, go along the leading edge and back along the trailing "
    "edge to the inboard trailing corner."
)


class Planform(Record):
    """A simple polygon, from the inboard leading corner around to the inboard trailing one.

    Attributes
    ----------
    corners : tuple of (float, float)
        x and y in m: along the leading edge outboard, along the tip, and back along the trailing
        edge. The first and the last are the ends of the inboard edge.
    tip : (int, int)
        Positions among the corners, from 0, of the leading and the trailing end of the outboard
        edge; equal where the segment ends in a point.
    end : (float, float), optional
        Point of the outboard edge on which the next segment hangs; its middle unless given.
    """

    corners: tuple[Point, ...]
    tip: tuple[int, int]
    end: Point | None = None

    @model_validator(mode="after")
    def _is_an_outline(self) -> Self:
        count, (lead, trail) = len(self.corners), self.tip
        if not FEWEST <= count <= MOST:
            limit = f"an outline has {FEWEST} to {MOST} corners"
            raise fault(("corners",), count, limit, _ORDER)
        if not (0 < lead < count - 1 and trail in (lead, lead + 1) and trail < count - 1):
            limit = f"must be one corner, or two that follow each other, of 2 to {count - 1}"
            remedy = "Count the corners from 1; the outboard edge lies between the other two."
            raise fault(("tip",), f"{lead + 1}, {trail + 1}", limit, remedy)
        self._check_distinct()
        self._check_simple()
        if self._signed_area >= 0.0:
            limit = "must go around along the leading edge first"
            raise fault(("corners",), "the other way around", limit, _ORDER)
        return self

    def _check_distinct(self) -> None:
        sides = np.linalg.norm(np.roll(self.array, -1, axis=0) - self.array, axis=1)
        if sides.min() <= ROUND_OFF * self.size:
            first = int(np.argmin(sides))
            pair = f"corners {first + 1} and {(first + 1) % len(sides) + 1}"
            limit = f"must all be different, and {pair} are the same"
            raise fault(("corners", first), _shown(self.corners[first]), limit, "Leave one out.")

    def _check_simple(self) -> None:
        crossing = _crossing_sides(self.array)
        if crossing is not None:
            first, other = (f"{i + 1}-{(i + 1) % len(self.corners) + 1}" for i in crossing)
            limit = f"the outline must not cross itself, and its sides {first} and {other} meet"
            raise fault(("corners",), f"a list of {len(self.corners)}", limit, _ORDER)

    @property
    def array(self) -> Real:
        """Corners, shape (k, 2)."""
        return np.array(self.corners, float)

    @property
    def size(self) -> float:
        """Largest extent along x or y in m."""
        return float(np.ptp(self.array, axis=0).max())

    @property
    def _signed_area(self) -> float:
        return float(_cross(self.array, np.roll(self.array, -1, axis=0)).sum() / 2.0)

    @property
    def area(self) -> float:
        """Area in m^2."""
        return abs(self._signed_area)

    @property
    def leading_edge(self) -> Real:
        """Corners of the leading edge from inboard to outboard, shape (l, 2)."""
        return self.array[: self.tip[0] + 1]

    @property
    def trailing_edge(self) -> Real:
        """Corners of the trailing edge from inboard to outboard, shape (t, 2)."""
        return self.array[self.tip[1] :][::-1]

    @property
    def inboard_edge(self) -> Real:
        """Leading and trailing end of the inboard edge, shape (2, 2)."""
        return self.array[[0, -1]]

    @property
    def outboard_edge(self) -> Real:
        """Leading and trailing end of the outboard edge, shape (2, 2); the same for a point."""
        return self.array[list(self.tip)]

    @property
    def is_pointed(self) -> bool:
        """Whether the segment ends in a point instead of an edge."""
        return self.tip[0] == self.tip[1]

    @property
    def outboard_point(self) -> Real:
        """Point of the outboard edge on which the next segment hangs, shape (2,)."""
        return self.outboard_edge.mean(axis=0) if self.end is None else np.array(self.end)

    @property
    def centroid(self) -> tuple[float, float]:
        """X and y of the centroid of the area in m."""
        a, b = self.array, np.roll(self.array, -1, axis=0)
        x, y = ((a + b) * _cross(a, b)[:, None]).sum(axis=0) / (6.0 * self._signed_area)
        return float(x), float(y)

    @property
    def is_rectangle(self) -> bool:
        """Whether the outline is a rectangle along the stream that starts at y = 0."""
        if len(self.corners) != 4 or self.tip != (1, 2):
            return False
        (a, b), (c, d) = self.leading_edge, self.trailing_edge
        gaps = (a[0] - b[0], c[0] - d[0], a[1], c[1], b[1] - d[1])
        return all(abs(gap) <= ROUND_OFF * self.size for gap in gaps)

    @property
    def extent(self) -> tuple[float, float]:
        """Smallest and largest y in m."""
        return float(self.breaks[0]), float(self.breaks[-1])

    @property
    def breaks(self) -> Real:
        """The y of all corners, ascending, each once: chords are linear in y between them."""
        y = np.sort(self.array[:, 1])
        return np.asarray(y[np.append(True, np.diff(y) > ROUND_OFF * self.size)])

    @property
    def has_one_chord(self) -> bool:
        """Whether every line along the stream crosses the outline once in and once out."""
        middle = (self.breaks[1:] + self.breaks[:-1]) / 2.0
        y = np.stack([self.array[:, 1], np.roll(self.array[:, 1], -1)])
        crossed = (y.min(axis=0) < middle[:, None]) & (middle[:, None] < y.max(axis=0))
        return bool(np.all(crossed.sum(axis=1) == 2))

    def chord_ends(self, y: Real) -> tuple[Real, Real]:
        """Return x of the foremost and the rearmost point of the outline at ``y``, (m,) each.

        Where a hinge line cuts a chord short, its end lies on the hinge line; nan outside.
        """
        y = np.asarray(y, float)[:, None]
        start, end = self.array, np.roll(self.array, -1, axis=0)
        low, high = (pick(start[:, 1], end[:, 1]) for pick in (np.minimum, np.maximum))
        rise = np.where(high > low, end[:, 1] - start[:, 1], 1.0)
        share = np.where(high > low, (y - start[:, 1]) / rise, 0.0)
        x = start[:, 0] + share * (end[:, 0] - start[:, 0])
        room = ROUND_OFF * self.size
        outside = (y < low - room) | (y > high + room)
        with np.errstate(invalid="ignore"):
            x = np.where(outside, np.nan, x)
            front = np.where(outside, np.inf, x).min(axis=1)
            back = np.where(outside, -np.inf, x).max(axis=1)
        inside = front <= back
        return np.where(inside, front, np.nan), np.where(inside, back, np.nan)

    def point(self, chordwise: Real, spanwise: Real) -> Real:
        """Return the point at fractions of chord and span, shape (m, 2).

        Fraction 0 of the chord is the leading edge, 0 of the span the inboard edge; the line of one
        span fraction joins points at the same share of the way outboard on both edges.
        """
        s = np.asarray(chordwise, float)[:, None]
        leading, trailing = (
            _along(edge, np.asarray(spanwise, float))
            for edge in (self.leading_edge, self.trailing_edge)
        )
        return np.asarray((1.0 - s) * leading + s * trailing)

    def fractions(self, x: Real, y: Real) -> tuple[Real, Real]:
        """Return fractions of chord and span of points along the stream, each of shape (m,).

        The chord is that along the stream at y, the span the extent in y.
        """
        low, high = self.breaks[0], self.breaks[-1]
        inside = np.clip(np.asarray(y, float), low, high)
        front, back = self.chord_ends(inside)
        chord = np.where(back > front, back - front, 1.0)
        return np.clip((x - front) / chord, 0.0, 1.0), (inside - low) / (high - low)


@lru_cache(maxsize=256)
def rectangle(span: float, chord: float, elastic_axis: float) -> Planform:
    """Return a rectangle whose elastic axis, a fraction of the chord, is the y axis."""
    return trapezoid((chord, chord), span, elastic_axis)


def trapezoid(
    chords: tuple[float, float],
    span: float,
    elastic_axis: float,
    sweep: float = 0.0,
    flares: tuple[float, float] = (0.0, 0.0),
) -> Planform:
    """Return a tapered, swept segment between two hinge lines.

    Parameters
    ----------
    chords : (float, float)
        Along the stream where the elastic axis starts and ends, in m.
    span : float
        Of the elastic axis, across the stream, in m.
    elastic_axis : float
        Fraction of the chord from the leading edge; it starts at the origin.
    sweep : float
        Of the elastic axis in rad, positive aft.
    flares : (float, float)
        Of inboard and outboard edge in rad: positive edges lean outboard at their leading end.
    """
    root, tip = chords
    aft = span * np.tan(sweep)
    lines = [((-e * root, 0.0), (aft - e * tip, span)) for e in (elastic_axis, elastic_axis - 1.0)]
    edges = [((0.0, 0.0), flares[0]), ((aft, span), flares[1])]
    inboard, outboard = (
        [_meeting(line, through, hinge_direction(flare)) for line in lines]
        for through, flare in edges
    )
    corners = (inboard[0], outboard[0], outboard[1], inboard[1])
    return Planform(corners=corners, tip=(1, 2), end=(aft, span))


def hinge_direction(flare: float) -> Real:
    """Return the unit vector h along a hinge, aft; positive flare moves its front end outboard."""
    return np.array([np.cos(flare), -np.sin(flare)])


def flare_of(edge: Real) -> float:
    """Return the flare in rad of an edge given by its leading and trailing end, (2, 2)."""
    x, y = edge[1] - edge[0]
    return float(np.arctan2(-y, x))


def _meeting(
    line: tuple[tuple[float, float], tuple[float, float]],
    through: tuple[float, float],
    direction: Real,
) -> tuple[float, float]:
    """Return where a line between two points meets another through a point; none is parallel."""
    start, way = np.array(line[0]), np.subtract(line[1], line[0])
    share = _cross(np.array(through) - start, direction) / _cross(way, direction)
    x, y = start + share * way
    return float(x), float(y)


def _cross(a: Real, b: Real) -> Real:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _along(edge: Real, share: Real) -> Real:
    """Return points at a share of the way outboard of an edge, shape (m, 2)."""
    way = np.abs(np.diff(edge[:, 1]))
    if way.sum() == 0.0:
        way = np.linalg.norm(np.diff(edge, axis=0), axis=1)
    at = np.append(0.0, np.cumsum(way)) / way.sum()
    return np.stack([np.interp(share, at, edge[:, axis]) for axis in (0, 1)], axis=1)


def _crossing_sides(corners: Real) -> tuple[int, int] | None:
    """Return two sides, from 0, that are no neighbours and have a point in common."""
    count = len(corners)
    start, end = corners, np.roll(corners, -1, axis=0)
    i, j = np.triu_indices(count, 2)
    apart = ~((i == 0) & (j == count - 1))
    i, j = i[apart], j[apart]

    def side(a: Indices, point: Real) -> Real:
        return np.sign(np.round(_cross(end[a] - start[a], point - start[a]) / _scale(corners), 12))

    first = side(i, start[j]) * side(i, end[j])
    second = side(j, start[i]) * side(j, end[i])
    meet = (first <= 0.0) & (second <= 0.0) & _boxes_meet(start, end, i, j)
    if not meet.any():
        return None
    at = int(np.argmax(meet))
    return int(i[at]), int(j[at])


def _scale(corners: Real) -> float:
    return float(np.ptp(corners, axis=0).max() ** 2)


def _boxes_meet(start: Real, end: Real, i: Indices, j: Indices) -> Mask:
    low, high = np.minimum(start, end), np.maximum(start, end)
    return np.asarray(np.all((low[i] <= high[j]) & (low[j] <= high[i]), axis=1))


def _shown(corner: tuple[float, float]) -> str:
    return f"{corner[0]:g}, {corner[1]:g}"
