"""The mesh of the vortex lattice: strips along the stream, cut into panels of equal length.

Each panel has a bound vortex at its quarter chord and a collocation point at three quarters, half
way between the legs. Panels are numbered along the span first: all leading-edge panels, then the
next row downstream.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from foldwing.aerodynamics.horseshoe import Edges
from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Real
from foldwing.model import Lattice, Wing

VORTEX, COLLOCATION = 0.25, 0.75
"""Where bound vortex and collocation point lie on a panel, as fractions of its length."""

INSET = 0.25
"""Widths of a strip by which an inset lattice ends before a free edge."""


@dataclass(frozen=True)
class Strips:
    """Rectangular strips of the folded wing, at right angles to the stream.

    Attributes
    ----------
    inner, outer : array, shape (s, 2)
        y and z of the inboard and the outboard edge in metres.
    leading : array, shape (s,)
        x of the leading edge, aft of the elastic axis.
    chord : array, shape (s,)
    segment : array of int, shape (s,)
        Segment that each strip belongs to, from 0.

    Raises
    ------
    InputError
        When a strip has no width or no chord.
    """

    inner: Real
    outer: Real
    leading: Real
    chord: Real
    segment: Indices

    def __post_init__(self) -> None:
        """Refuse panels without width or length."""
        for name, size in (("width", self.width), ("chord", self.chord)):
            if not np.all(size > 0.0):
                bad = int(np.argmin(size > 0.0))
                limit = f"the {name} of strip {bad + 1} must be greater than 0 m"
                remedy = "Move its edges apart, or leave it out."
                raise InputError("strips", float(size[bad]), limit, remedy)

    @property
    def count(self) -> int:
        """Number s of strips."""
        return len(self.chord)

    @cached_property
    def width(self) -> Real:
        """Distance between the edges of each strip, shape (s,)."""
        return np.asarray(np.linalg.norm(self.outer - self.inner, axis=1))

    @cached_property
    def middle(self) -> Real:
        """Middle of each strip, shape (s, 2)."""
        return (self.inner + self.outer) / 2.0

    @cached_property
    def normal(self) -> Real:
        """Unit normal of each strip in y and z, up for an unfolded wing, shape (s, 2)."""
        along = (self.outer - self.inner) / self.width[:, None]
        return np.stack([-along[:, 1], along[:, 0]], axis=1)

    @property
    def edges(self) -> Edges:
        """The edges between which vortices are bound."""
        return Edges(self.inner, self.outer)

    @property
    def area(self) -> float:
        """Developed area in m^2."""
        return float(self.width @ self.chord)

    def mirrored(self) -> "Strips":
        """Return the strips on the other side of the plane y = 0, in the same order."""
        mirror = np.array([-1.0, 1.0])
        return Strips(
            self.outer * mirror, self.inner * mirror, self.leading, self.chord, self.segment
        )

    def turned(self, angle: float) -> "Strips":
        """Return the strips turned about the stream axis by ``angle`` in radians, y towards z."""
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, s], [-s, c]])
        return Strips(self.inner @ turn, self.outer @ turn, self.leading, self.chord, self.segment)

    def joined(self, other: "Strips") -> "Strips":
        """Return these strips followed by others."""
        pairs = (
            (getattr(self, name), getattr(other, name))
            for name in ("inner", "outer", "leading", "chord", "segment")
        )
        return Strips(*(np.concatenate(pair) for pair in pairs))


@dataclass(frozen=True)
class SegmentMesh:
    """Strips and panels of one segment in its own plane.

    Attributes
    ----------
    edges : array, shape (s + 1,)
        y of the edges of the strips, outboard of the segment's inboard edge, in metres.
    leading, chord : float
        x of the leading edge, aft of the elastic axis, and the chord in metres.
    chordwise : int
        Panels along the chord.
    """

    edges: Real
    leading: float
    chord: float
    chordwise: int

    @property
    def middle(self) -> Real:
        """Y of the middle of the strips, shape (s,)."""
        return (self.edges[1:] + self.edges[:-1]) / 2.0

    def station(self, fraction: float) -> Real:
        """Return x at a fraction of each panel's length, shape (chordwise,)."""
        return self.leading + (np.arange(self.chordwise) + fraction) * self.chord / self.chordwise

    def points(self, station: Real) -> tuple[Real, Real]:
        """Return x and y of the points of all strips at ``station``, rows first, (c s,) each."""
        x, y = np.meshgrid(station, self.middle, indexing="ij")
        return x.ravel(), y.ravel()


class Closeness(NamedTuple):
    """The two segments whose panels come nearest to each other's collocation points.

    Attributes
    ----------
    segment, other : int
        From 0; -1 when there is only one segment.
    distance : float
        From the middle of a strip of ``segment`` to a strip of ``other``, in metres.
    ratio : float
        The distance in widths of the strip of ``segment``.
    """

    segment: int
    other: int
    distance: float
    ratio: float


def closeness(strips: Strips) -> Closeness:
    """Return how near segments come to each other, in widths of the strips."""
    apart = strips.segment[:, None] != strips.segment
    if not apart.any():
        return Closeness(-1, -1, np.inf, np.inf)
    along = strips.outer - strips.inner
    offset = strips.middle[:, None] - strips.inner
    share = np.clip((offset * along).sum(axis=2) / strips.width**2, 0.0, 1.0)
    distance = np.linalg.norm(offset - share[:, :, None] * along, axis=2)
    ratio = np.where(apart, distance / strips.width[:, None], np.inf)
    i, j = np.unravel_index(np.argmin(ratio), ratio.shape)
    nearest = (int(strips.segment[i]), int(strips.segment[j]))
    return Closeness(*nearest, float(distance[i, j]), float(ratio[i, j]))


def mesh_segments(wing: Wing) -> tuple[SegmentMesh, ...]:
    """Return the panels of every segment, without fold angles."""
    lattice = wing.lattice
    gaps = [0.0, *(hinge.gap for hinge in wing.hinges), 0.0]
    free = [not lattice.image, *(gap > 0.0 for gap in gaps[1:-1]), True]
    ends = pairwise(zip(gaps, free, strict=True))
    counts = strips_by_segment(wing)
    return tuple(
        SegmentMesh(
            _edges(lattice, count, segment.span, (inboard, outboard)),
            -segment.half_chord * (1.0 + segment.axis_offset),
            segment.chord,
            lattice.chordwise,
        )
        for segment, count, (inboard, outboard) in zip(wing.segments, counts, ends, strict=True)
    )


def strips_by_segment(wing: Wing) -> tuple[int, ...]:
    """Return the number of strips of each segment, shared out by span unless given."""
    wanted = wing.lattice.spanwise
    if isinstance(wanted, tuple):
        return wanted
    spans = np.array([segment.span for segment in wing.segments])
    share = (wanted - len(spans)) * spans / spans.sum()
    counts = np.floor(share + 1e-9).astype(int) + 1
    while counts.sum() < wanted:
        counts[np.argmax(spans / counts)] += 1
    return tuple(int(count) for count in counts)


def _edges(
    lattice: Lattice, count: int, span: float, ends: tuple[tuple[float, bool], tuple[float, bool]]
) -> Real:
    """Return the edges of the strips of a segment; each end has a gap and may be free."""
    (inner_gap, inner_free), (outer_gap, outer_free) = ends
    first, last = inner_gap / 2.0, span - outer_gap / 2.0
    share = np.linspace(0.0, 1.0, count + 1)
    if lattice.spacing == "cosine":
        share = (1.0 - np.cos(np.pi * share)) / 2.0
    if lattice.spacing == "inset":
        # A quarter of the strip that the gap will have beside it.
        beside = INSET * 0.5**lattice.gap_refinement
        start = beside if inner_gap > 0.0 else INSET * inner_free
        end = beside if outer_gap > 0.0 else INSET * outer_free
        share = (start + count * share) / (count + start + end)
    edges: Real = first + (last - first) * share
    for _ in range(lattice.gap_refinement):
        edges = _halved(edges, inner_gap > 0.0, outer_gap > 0.0)
    return edges


def _halved(edges: Real, first: bool, last: bool) -> Real:
    """Return the edges with the first and the last strip cut in two where asked for."""
    middle = (edges[1:] + edges[:-1]) / 2.0
    extra = np.unique(np.concatenate([middle[:1][: int(first)], middle[-1:][: int(last)]]))
    return np.sort(np.concatenate([edges, extra]))


def folded_strips(
    meshes: Sequence[SegmentMesh], origins: Sequence[Real], rotations: Sequence[Real]
) -> Strips:
    """Return the strips of the folded wing.

    Parameters
    ----------
    meshes : sequence of SegmentMesh
    origins : sequence of array, shape (3,)
        Where the middle of each segment's inboard edge lies, in metres.
    rotations : sequence of array, shape (3, 3)
        From the axes of each segment to global axes.
    """
    parts = []
    for index, (mesh, origin, A) in enumerate(zip(meshes, origins, rotations, strict=True)):
        line = origin[1:] + mesh.edges[:, None] * A[1:, 1]
        count = len(line) - 1
        parts.append(
            Strips(
                line[:-1],
                line[1:],
                np.full(count, mesh.leading),
                np.full(count, mesh.chord),
                np.full(count, index),
            )
        )
    strips = parts[0]
    for part in parts[1:]:
        strips = strips.joined(part)
    return strips
