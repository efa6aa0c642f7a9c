"""Points on the wing at which mode shapes are drawn, and displacements there."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from foldwing.maths.arrays import Indices, Mask, Real
from foldwing.model import Wing
from foldwing.structure.modes import StructuralModes

SPANWISE_POINTS = 11
CHORDWISE_POINTS = 3


@dataclass(frozen=True)
class SurfaceGrid:
    """A structured grid of points on every segment.

    Attributes
    ----------
    segment, chordwise, spanwise : array of int, shape (m,)
        Segment (from 1) and indices within its grid.
    x, y : array, shape (m,)
        Local position: aft of the elastic axis, outboard of the inboard edge, in metres.
    """

    segment: Indices
    chordwise: Indices
    spanwise: Indices
    x: Real
    y: Real

    def position(self, modes: StructuralModes) -> Real:
        """Return the global position of the points on the undeformed wing, shape (m, 3)."""
        parts = [
            modes.position(index, self.x[mine], self.y[mine]) for index, mine in self._parts(modes)
        ]
        return np.concatenate(parts)

    def displacement(self, modes: StructuralModes) -> Real:
        """Return the global displacement per unit modal coordinate, shape (m, 3, n)."""
        parts = [
            modes.displacement(index, self.x[mine], self.y[mine])
            for index, mine in self._parts(modes)
        ]
        return np.concatenate(parts)

    def _parts(self, modes: StructuralModes) -> list[tuple[int, Mask]]:
        return [(i, self.segment == i + 1) for i in range(len(modes.rotations))]

    def coordinates(self) -> dict[str, Any]:
        """Return the dataset coordinates of the points."""
        points = ("point",)
        return {
            "point": (points, np.arange(len(self.x))),
            "segment": (points, self.segment),
            "chordwise": (points, self.chordwise),
            "spanwise": (points, self.spanwise),
            "axis": (("axis",), ["x", "y", "z"]),
        }


def surface_grid(wing: Wing) -> SurfaceGrid:
    """Return the grid of points of a wing, from root to tip."""
    along, across = np.meshgrid(
        np.arange(SPANWISE_POINTS), np.arange(CHORDWISE_POINTS), indexing="ij"
    )
    spanwise, chordwise = along.ravel(), across.ravel()
    fraction_y = spanwise / (SPANWISE_POINTS - 1)
    fraction_x = chordwise / (CHORDWISE_POINTS - 1)
    segments = wing.segments
    points = np.concatenate([s.outline.point(fraction_x, fraction_y) for s in segments])
    return SurfaceGrid(
        segment=np.repeat(np.arange(1, len(segments) + 1), len(spanwise)),
        chordwise=np.tile(chordwise, len(segments)),
        spanwise=np.tile(spanwise, len(segments)),
        x=points[:, 0],
        y=points[:, 1],
    )
