"""Influence of every vortex of the wing and its wake on every collocation point.

Between strips of equal panels the influence depends on the distance along the stream alone: one
table of distances holds it, in which the blocks of neighbouring rows overlap. The matrix of the
wake is never formed.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from foldwing.aerodynamics.horseshoe import Edges, streamwise_wash
from foldwing.aerodynamics.lattice import COLLOCATION, VORTEX, Strips
from foldwing.maths.arrays import Indices, Real
from foldwing.maths.skeleton import Skeleton, skeleton


@dataclass(frozen=True)
class Influence:
    """Normal wash of all vortices of the wing and its wake at the collocation points.

    Strips of one chord and leading edge form a group; between groups of equal panels the influence
    depends on the distance along the stream alone and is computed once for each distance.

    Parameters
    ----------
    strips : Strips
    chordwise : int
        Panels along the chord.
    rows : int
        Rows of the wake behind each strip, each as long as its panels.
    image : bool
        Whether the plane y = 0 mirrors the flow.
    """

    strips: Strips
    chordwise: int
    rows: int
    image: bool = False

    @property
    def count(self) -> int:
        """Number of panels."""
        return self.chordwise * self.strips.count

    @cached_property
    def groups(self) -> tuple[Indices, ...]:
        """Strips of equal chord and leading edge."""
        shape = np.stack([self.strips.leading, self.strips.chord], axis=1)
        _, group = np.unique(shape, axis=0, return_inverse=True)
        group = group.reshape(-1)
        return tuple(np.flatnonzero(group == index) for index in range(group.max() + 1))

    def step(self, group: int) -> float:
        """Return the length of the panels of a group in metres."""
        return float(self.strips.chord[self.groups[group][0]]) / self.chordwise

    @cached_property
    def _tables(self) -> dict[tuple[int, int], "_Table"]:
        pairs = np.ndindex(len(self.groups), len(self.groups))
        return {(r, s): self._table(r, s) for r, s in pairs}

    def _table(self, receiver: int, source: int) -> "_Table":
        strips, (here, there) = self.strips, (self.groups[receiver], self.groups[source])
        ahead = strips.leading[here[0]] - strips.leading[there[0]]
        dx, dx_source = self.step(receiver), self.step(source)
        total = self.chordwise + self.rows
        if dx == dx_source:
            offsets = np.arange(-(total - 1), self.chordwise)
            xi = ahead + (offsets + COLLOCATION - VORTEX) * dx
            return _Table(self._wash(xi, here, there), self.chordwise, True)
        points = (np.arange(self.chordwise) + COLLOCATION) * dx
        vortices = (np.arange(total) + VORTEX) * dx_source
        xi = (ahead + points[None, :] - vortices[:, None]).ravel()
        order = np.argsort(xi)
        wash = np.empty((len(xi), len(here), len(there)))
        wash[order] = self._wash(xi[order], here, there)
        return _Table(wash, self.chordwise, False)

    def _wash(self, xi: Real, here: Indices, there: Indices) -> Real:
        strips = self.strips
        receivers = strips.middle[here], strips.normal[here]
        edges = Edges(strips.inner[there], strips.outer[there])
        wash = streamwise_wash(xi, *receivers, edges)
        if self.image:
            mirror = np.array([-1.0, 1.0])
            image = Edges(edges.outer * mirror, edges.inner * mirror)
            wash += streamwise_wash(xi, *receivers, image)
        return wash

    def panels(self, group: int) -> Indices:
        """Return the panels of a group, rows first."""
        rows = np.arange(self.chordwise)[:, None] * self.strips.count
        return np.asarray((rows + self.groups[group]).ravel())

    @cached_property
    def wing(self) -> Real:
        """Influence A0 of the bound vortices, shape (panels, panels)."""
        A0 = np.empty((self.count, self.count))
        for (r, s), table in self._tables.items():
            rows = self.panels(r)
            for j in range(self.chordwise):
                columns = j * self.strips.count + self.groups[s]
                A0[_block(rows, columns, self.count)] = table.column(j)
        return A0

    def wake_rows(self, source: int) -> Iterator[Real]:
        """Yield the influence of each wake row of a group on all panels, (panels, strips)."""
        for row in range(self.rows):
            A = np.empty((self.count, len(self.groups[source])))
            for r in range(len(self.groups)):
                A[self.panels(r)] = self._tables[r, source].column(self.chordwise + row)
            yield A

    def projected_wake(self, Y: Real, source: int, rows: Indices | None = None) -> Real:
        """Return Y A_j of wake rows j of a group, of all by default, (rows, len(Y), strips)."""
        rows = np.arange(self.rows) if rows is None else rows
        P = np.zeros((len(rows), len(Y), len(self.groups[source])))
        for r in range(len(self.groups)):
            table, own = self._tables[r, source], np.ascontiguousarray(Y[:, self.panels(r)])
            for P_j, row in zip(P, rows, strict=True):
                P_j += own @ table.column(self.chordwise + row)
        return P

    def wake_skeleton(self, source: int) -> Skeleton:
        """Return the wake rows of a group that stand for all of them."""
        columns = self.chordwise + np.arange(self.rows)

        def sketch(count: int) -> Real:
            random = np.random.default_rng(0)
            tables = (self._tables[r, source] for r in range(len(self.groups)))
            return np.asarray(sum(table.sketch(columns, count, random) for table in tables))

        return skeleton(sketch, self.rows)


def _block(rows: Indices, columns: Indices, count: int) -> tuple[slice | Indices, ...]:
    """Return an index of rows and columns: slices, which cost nothing, where all rows are meant."""
    if len(rows) == count:
        return slice(None), slice(int(columns[0]), int(columns[-1]) + 1)
    return np.ix_(rows, columns)


class _Table(NamedTuple):
    """Influence between two groups: by distance (q, r, s), or by pairs of rows if not uniform."""

    wash: Real
    chordwise: int
    uniform: bool

    def column(self, j: int) -> Real:
        """Return the influence of row j of the vortices on all rows, (chordwise r, s), no copy."""
        first = self._first(j)
        block = self.wash[first : first + self.chordwise]
        return block.reshape(-1, block.shape[2])

    def _first(self, j: int | Indices) -> int | Indices:
        return len(self.wash) - self.chordwise - j if self.uniform else j * self.chordwise

    def sketch(self, columns: Indices, count: int, random: np.random.Generator) -> Real:
        """Return the influence of rows ``columns`` times random vectors, (len(columns), count)."""
        flat = self.wash.reshape(len(self.wash), -1)
        each = flat @ (random.random((flat.shape[1], count)) - 0.5)
        signs = random.random((self.chordwise, count)) - 0.5
        first = self._first(columns)
        return np.asarray(sum(each[first + i] * sign for i, sign in enumerate(signs)))
