"""Triangles in a plane: in which of them points lie."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.maths.arrays import Indices, Real


@dataclass(frozen=True)
class Triangles:
    """A triangulation, and a grid of bins over it that makes looking up points fast.

    Parameters
    ----------
    points : array, shape (v, 2)
    corners : array of int, shape (e, 3)
        Positions among the points of the corners of every triangle, in any sense.
    """

    points: Real
    corners: Indices

    @cached_property
    def _to_barycentric(self) -> tuple[Real, Real]:
        """Third corners (e, 2), and what turns the way from there into coordinates (e, 2, 2)."""
        a, b, c = (self.points[self.corners[:, k]] for k in range(3))
        return c, np.linalg.inv(np.stack([a - c, b - c], axis=2))

    @cached_property
    def _bins(self) -> tuple[Real, Real, Indices]:
        """Low corner and width of the bins, and which triangles reach into each, padded with -1.

        About one bin per triangle; boxes are a little larger than the triangles in them, so that
        points on a border are not lost to round-off.
        """
        box = self.points[self.corners]
        low, extent = self.points.min(axis=0), np.ptp(self.points, axis=0)
        count = np.maximum(1, np.sqrt(len(box) * extent / extent[::-1])).astype(int)
        width = extent / count
        room = 1e-6 * width
        first = np.clip((box.min(axis=1) - room - low) // width, 0, count - 1).astype(int)
        last = np.clip((box.max(axis=1) + room - low) // width, 0, count - 1).astype(int)
        inside: list[list[list[int]]] = [[[] for _ in range(count[1])] for _ in range(count[0])]
        for triangle, ((i, j), (k, m)) in enumerate(zip(first, last + 1, strict=True)):
            for column in inside[i:k]:
                for held in column[j:m]:
                    held.append(triangle)
        most = max(len(held) for column in inside for held in column)
        table = np.full((*count, most), -1)
        for i, column in enumerate(inside):
            for j, held in enumerate(column):
                table[i, j, : len(held)] = held
        return low, width, table

    def holding(self, points: Real) -> Indices:
        """Return the triangle that holds each point, shape (m,).

        Of a point on a border, one of its neighbours; of a point outside, a triangle that is near.

        Parameters
        ----------
        points : array, shape (m, 2)
        """
        low, width, table = self._bins
        bin = np.clip((points - low) // width, 0, np.array(table.shape[:2]) - 1).astype(int)
        found = _best(table[bin[:, 0], bin[:, 1]], self._depth(points, table[tuple(bin.T)]))
        stray = np.flatnonzero(found < 0)
        if len(stray):
            every = np.broadcast_to(np.arange(len(self.corners)), (len(stray), len(self.corners)))
            found[stray] = _best(every, self._depth(points[stray], every))
        return found

    def _depth(self, points: Real, candidates: Indices) -> Real:
        """Return the least barycentric coordinate of points in their candidates, both (m, k)."""
        origin, inverse = self._to_barycentric
        away = points[:, None, :] - origin[candidates]
        M = inverse[candidates]
        first = M[..., 0, 0] * away[..., 0] + M[..., 0, 1] * away[..., 1]
        second = M[..., 1, 0] * away[..., 0] + M[..., 1, 1] * away[..., 1]
        depth = np.minimum(np.minimum(first, second), 1.0 - first - second)
        return np.asarray(np.where(candidates < 0, -np.inf, depth))


def _best(candidates: Indices, depth: Real) -> Indices:
    rows = np.arange(len(candidates))
    return np.asarray(candidates[rows, np.argmax(depth, axis=1)])
