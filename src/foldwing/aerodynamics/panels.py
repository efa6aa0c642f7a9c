"""Panels of a steady vortex lattice: bound vortices and collocation points anywhere in space.

They come from the strips of a folded wing, or from a flat swept and tapered wing. Legs run along
the stream in every case.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.horseshoe import CHUNK, induced_velocity
from foldwing.aerodynamics.lattice import COLLOCATION, VORTEX, Strips
from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Real
from foldwing.maths.rotations import rotation_about_x

MIRROR = np.array([1.0, -1.0, 1.0])
"""Turns a vector into its image in the plane y = 0."""

STREAM = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class Panels:
    """Panels numbered along the span first: the first s of them are the leading ones of s strips.

    Attributes
    ----------
    inner, outer : array, shape (n, 3)
        Ends A and B of the bound vortices in metres.
    points, normals : array, shape (n, 3)
        Collocation points, and unit normals there: up for an unfolded wing.
    chord : array, shape (s,)
        Mean chord of each strip.
    segment : array of int, shape (s,)
        Segment that each strip belongs to, from 0.
    """

    inner: Real
    outer: Real
    points: Real
    normals: Real
    chord: Real
    segment: Indices

    @property
    def strips(self) -> int:
        """Number s of strips."""
        return len(self.chord)

    @property
    def rows(self) -> int:
        """Number of panels along the chord."""
        return len(self.points) // self.strips

    @cached_property
    def edges(self) -> tuple[Real, Real]:
        """Where the legs of each strip run: y and z of inboard and outboard edge, (s, 2) each."""
        return self.inner[: self.strips, 1:], self.outer[: self.strips, 1:]

    @cached_property
    def width(self) -> Real:
        """Width of each strip across the stream, shape (s,)."""
        inner, outer = self.edges
        return np.asarray(np.linalg.norm(outer - inner, axis=1))

    @property
    def area(self) -> float:
        """Developed area in m^2."""
        return float(self.width @ self.chord)

    @property
    def projected_area(self) -> float:
        """Area seen from above in m^2; parts above each other both count."""
        return float((self.width * self.chord) @ np.abs(self.normals[: self.strips, 2]))

    def by_strip(self, values: Real) -> Real:
        """Return the sums along the chord of values of the panels, shape (s, ...)."""
        return np.asarray(values.reshape(self.rows, self.strips, *values.shape[1:]).sum(axis=0))

    def mirrored(self) -> "Panels":
        """Return the panels on the other side of the plane y = 0, in the same order."""
        return replace(
            self,
            inner=self.outer * MIRROR,
            outer=self.inner * MIRROR,
            points=self.points * MIRROR,
            normals=self.normals * MIRROR,
        )

    def turned(self, angle: float) -> "Panels":
        """Return the panels turned about the stream axis by ``angle`` in radians, y towards z."""
        turn = rotation_about_x(angle).T
        vectors = ("inner", "outer", "points", "normals")
        return replace(self, **{name: getattr(self, name) @ turn for name in vectors})

    def joined(self, other: "Panels") -> "Panels":
        """Return these panels with those of other strips, as many along the chord, outboard."""
        rows = self.rows

        def both(a: Real, b: Real) -> Real:
            parts = [part.reshape(rows, -1, 3) for part in (a, b)]
            return np.concatenate(parts, axis=1).reshape(-1, 3)

        return Panels(
            both(self.inner, other.inner),
            both(self.outer, other.outer),
            both(self.points, other.points),
            both(self.normals, other.normals),
            np.concatenate([self.chord, other.chord]),
            np.concatenate([self.segment, other.segment]),
        )

    def influence(self, image: bool = False) -> Real:
        """Return the normal velocity at each collocation point per unit circulation, (n, n).

        Parameters
        ----------
        image : bool
            Whether the plane y = 0 mirrors the flow.
        """
        sources = (self, self.mirrored()) if image else (self,)
        wash = np.empty((len(self.points), len(self.points)))
        step = max(1, CHUNK // len(self.points))  # all components at once would fill the memory
        for first in range(0, len(self.points), step):
            here = slice(first, first + step)
            velocity = sum(induced_velocity(self.points[here], s.inner, s.outer) for s in sources)
            wash[here] = np.einsum("msk,mk->ms", velocity, self.normals[here])
        return wash

    def force_per_circulation(self) -> Real:
        """Return the force of Kutta and Joukowski per density, airspeed and circulation, (n, 3)."""
        return np.cross(STREAM, self.outer - self.inner)


def strip_panels(strips: Strips, chordwise: int) -> Panels:
    """Return the panels of the strips of a folded wing.

    Parameters
    ----------
    strips : Strips
        Of any chord.
    chordwise : int
        Panels along the chord.
    """
    lines = np.arange(chordwise)[:, None]

    def placed(fraction: float, place: Real) -> Real:
        x = strips.leading + (lines + fraction) * strips.chord / chordwise
        across = np.broadcast_to(place, (*x.shape, 2))
        return np.concatenate([x[:, :, None], across], axis=2).reshape(-1, 3)

    normal = np.concatenate([np.zeros((strips.count, 1)), strips.normal], axis=1)
    return Panels(
        placed(VORTEX, strips.inner),
        placed(VORTEX, strips.outer),
        placed(COLLOCATION, strips.middle),
        np.tile(normal, (chordwise, 1)),
        strips.chord,
        strips.segment,
    )


@dataclass(frozen=True)
class Trapezoid:
    """Starboard half of a flat wing with straight edges; x is measured aft from its root's nose.

    Parameters
    ----------
    semispan, root_chord, tip_chord : float
        In metres.
    sweep : float
        Of the line at ``sweep_line`` in radians, positive aft, below a right angle.
    sweep_line : float
        Fraction of the chord: 0.25 for the quarter-chord line, 0 for the leading edge.

    Raises
    ------
    InputError
        When a length is not positive, or the sweep is a right angle or more.
    """

    semispan: float
    root_chord: float
    tip_chord: float
    sweep: float = 0.0
    sweep_line: float = 0.25

    def __post_init__(self) -> None:
        """Refuse what is no wing."""
        for name in ("semispan", "root_chord", "tip_chord"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(name, value, "must be greater than 0 m", "Give a length.")
        if not abs(self.sweep) < math.pi / 2.0:
            remedy = "Give the sweep in radians, such as 0.8."
            raise InputError("sweep", self.sweep, "must be less than a right angle", remedy)

    def chord(self, y: Real) -> Real:
        """Return the chord at the span position ``y``."""
        return np.asarray(self.root_chord + (self.tip_chord - self.root_chord) * y / self.semispan)

    def leading(self, y: Real) -> Real:
        """Return x of the leading edge at the span position ``y``."""
        narrower = self.root_chord - self.chord(y)
        return np.asarray(np.tan(self.sweep) * y + self.sweep_line * narrower)


def swept_panels(
    wing: Trapezoid, chordwise: int, spanwise: int, *, both_halves: bool = True
) -> Panels:
    """Return the panels of a flat swept and tapered wing, equal along chord and span.

    Parameters
    ----------
    wing : Trapezoid
    chordwise, spanwise : int
        Panels along the chord and strips along the semispan.
    both_halves : bool
        Whether to add the port half; without it solve with the image.
    """
    edge = np.linspace(0.0, wing.semispan, spanwise + 1)
    middle = (edge[1:] + edge[:-1]) / 2.0
    lines = np.arange(chordwise)[:, None]

    def placed(fraction: float, y: Real) -> Real:
        x = wing.leading(y) + (lines + fraction) * wing.chord(y) / chordwise
        return np.stack([x, np.broadcast_to(y, x.shape), np.zeros_like(x)], axis=2).reshape(-1, 3)

    half = Panels(
        placed(VORTEX, edge[:-1]),
        placed(VORTEX, edge[1:]),
        placed(COLLOCATION, middle),
        np.tile([0.0, 0.0, 1.0], (chordwise * spanwise, 1)),
        wing.chord(middle),
        np.zeros(spanwise, np.intp),
    )
    return half.mirrored().joined(half) if both_halves else half
