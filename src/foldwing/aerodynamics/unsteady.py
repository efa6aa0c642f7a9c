"""Unsteady vortex lattice: generalized forces as a function of p, at the cost of a few vectors.

With g = circulation / U, the wash W = dw/dx + p w/b at the collocation points and z = exp(p dx/b),

    [A0 + sum_j omega_j A_j S] g = W,    omega_j = z^-(j+1) - z^-j,    Qhat = (L1 + (p/b) L2) g.

A0 and A_j are the influence of the wing and of row j of the wake, S sums along the chord. Wake rows
carry the change of the circulation of their strip, convected in steps of one panel (K. C. Hall,
AIAA Journal 32, 1994, of which this is the transfer function). L1 is the load of Kutta and
Joukowski, L2 that of the growing circulation between a vortex and the end of the lattice.

Only strip sums act on the wake. With R = [S; L1; L2] and Y = R A0^-1, from one factorization, the
rows P_j = Y A_j hold everything of the wake; for any p there remain G = sum_j omega_j P_j and a
system of the size of the strips (H. W. Woodbury's identity). Few rows of the wake stand for all of
them to round-off, A_j = sum_k X_jk A_k, so that only these are projected and summed.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy.linalg

from foldwing.aerodynamics.horseshoe import Edges, streamwise_wash
from foldwing.aerodynamics.lattice import COLLOCATION, VORTEX, SegmentMesh, Strips
from foldwing.aerodynamics.schemes import EXACT, TimeScheme
from foldwing.aerodynamics.wake import shed, shed_with_derivative
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.maths.skeleton import Skeleton, skeleton
from foldwing.model import Lattice

WAKE_END = 0.25
"""Length of a panel, from its trailing edge forward, that the growing circulation does not load:
the lattice sees circulation up to there."""

BLOCK = 25_000
"""Entries of G computed at a time: what fits into the cache of a core."""

PRINTED_END = 0.0
"""The same as the dissertation prints it, eq. (A.16): first order in the length of a panel."""


class PanelMotion(NamedTuple):
    """Motion of all panels per coordinate, each of shape (panels, n); w is along the normal.

    Attributes
    ----------
    slope : array
        dw/dx at the collocation points.
    collocation, vortex, load : array
        w at the collocation points, on the bound vortices, and where the unsteady load acts.
    """

    slope: Real
    collocation: Real
    vortex: Real
    load: Real

    def projected(self, q: Real) -> "PanelMotion":
        """Return the motion of the combinations ``q`` (n, m) of the coordinates."""
        return PanelMotion(*(part @ q for part in self))


def load_length(mesh: SegmentMesh, scheme: str) -> Real:
    """Return the length behind each bound vortex that its circulation loads, (chordwise,)."""
    end = PRINTED_END if scheme == "printed" else WAKE_END
    panels = np.arange(mesh.chordwise)
    return np.asarray((mesh.chordwise - panels - VORTEX - end) * mesh.chord / mesh.chordwise)


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


@dataclass(frozen=True)
class LatticeModel:
    """The vortex lattice for the modes of a wing; obeys the port of aerodynamic models.

    Parameters
    ----------
    half_chord : float
        Reference length b of p in metres.
    wake : tuple of array, shape (k, strips + 2 n, strips of the group)
        P_j of the skeleton of each group of strips.
    weights : tuple of array, shape (rows, k)
        How all rows of the wake follow from those of the skeleton.
    steps : tuple of float
        dx / b of each group.
    order : array of int, shape (strips,)
        Strips in the order of the groups.
    wash : tuple of array, shape (strips + 2 n, n)
        Y times dw/dx and Y times w.
    relaxation : float
        How the circulation in the last row of the wake fades.
    scheme : TimeScheme
    """

    half_chord: float
    wake: tuple[Real, ...]
    weights: tuple[Real, ...]
    steps: tuple[float, ...]
    order: Indices
    wash: tuple[Real, Real]
    relaxation: float = 0.0
    scheme: TimeScheme = EXACT

    @property
    def size(self) -> int:
        """Number n of modes."""
        return int(self.wash[0].shape[1])

    @property
    def highest_frequency(self) -> float:
        """Reduced frequency up to which the lattice holds: half of where its steps alias."""
        return np.pi / (2.0 * max(self.steps))

    @property
    def _strips(self) -> int:
        return len(self.order)

    def forces(self, p: Complex) -> Complex:
        """Return Qhat at the values ``p`` of shape (m,), as an array (m, n, n)."""
        p = np.asarray(p, complex)
        Q = np.empty((len(p), self.size, self.size), complex)
        for part in self._blocks(len(p)):
            Q[part] = self._forces(p[part])
        return Q

    def _forces(self, p: Complex) -> Complex:
        strips = self._strips
        rate, _, gain = self.scheme.rates(p / self.half_chord)
        G = self._wake_sum([shed(p * h, rows, self.relaxation) for h, rows in self._wakes])
        Y = self._drive(rate)
        s = np.linalg.solve(np.eye(strips) + G[:, :strips], Y[:, :strips])
        return self._combined(Y[:, strips:] - G[:, strips:] @ s, rate) / gain[:, None, None]

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n)."""
        p = np.asarray(p, complex)
        Q, dQ = np.empty((2, len(p), self.size, self.size), complex)
        for part in self._blocks(len(p)):
            Q[part], dQ[part] = self._forces_with_derivative(p[part])
        return Q, dQ

    def _forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        n, strips = self.size, self._strips
        rates, slopes = self.scheme.rates_with_derivative(p / self.half_chord)
        (rate, _, gain), (slope, _, gain_slope) = rates, (s / self.half_chord for s in slopes)
        omega = [shed_with_derivative(p * h, r, self.relaxation) for h, r in self._wakes]
        both = [np.concatenate([o, d * h]) for (o, d), h in zip(omega, self.steps, strict=True)]
        G, dG = np.split(self._wake_sum(both), 2)
        Y, drive = self._drive(rate), slope[:, None, None] * self.wash[1]
        inverse = np.linalg.inv(np.eye(strips) + G[:, :strips])
        s = inverse @ Y[:, :strips]
        ds = inverse @ (drive[:, :strips] - dG[:, :strips] @ s)
        q = Y[:, strips:] - G[:, strips:] @ s
        dq = drive[:, strips:] - dG[:, strips:] @ s - G[:, strips:] @ ds
        Q = self._combined(q, rate) / gain[:, None, None]
        dQ = self._combined(dq, rate) + slope[:, None, None] * q[:, n:]
        return Q, (dQ - gain_slope[:, None, None] * Q) / gain[:, None, None]

    def _blocks(self, count: int) -> Iterator[slice]:
        length = max(8, BLOCK // (self._strips * len(self.wash[0])))
        return (slice(first, first + length) for first in range(0, count, length))

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""
        return self.wash[0][self._strips : self._strips + self.size]

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n).

        The limit of growing motions, Re p to infinity: the first row of the wake then takes the
        whole circulation of its strip and all others are empty.
        """
        G = self._wake_sum([np.eye(1, rows) * (-1.0 + 0j) for _, rows in self._wakes])[0].real
        strips, n = self._strips, self.size
        Y = self.wash[1]
        s = np.linalg.solve(np.eye(strips) + G[:strips], Y[:strips])
        return np.asarray(-(Y[strips + n :] - G[strips + n :] @ s))

    @property
    def _wakes(self) -> list[tuple[float, int]]:
        return [(step, len(X)) for step, X in zip(self.steps, self.weights, strict=True)]

    def _wake_sum(self, circulation: list[Complex]) -> Complex:
        """Return G = sum of omega_j P_j, shape (m, strips + 2 n, strips)."""
        parts = []
        for omega, X, P in zip(circulation, self.weights, self.wake, strict=True):
            # One real product for both parts: P is read once.
            sums = np.concatenate([omega.real, omega.imag]) @ X @ P.reshape(len(P), -1)
            G = np.empty((len(omega), *P.shape[1:]), complex)
            G.real, G.imag = sums.reshape(2, *G.shape)
            parts.append(G)
        if len(parts) == 1:
            return parts[0]
        return np.concatenate(parts, axis=2)[:, :, np.argsort(self.order)]

    def _drive(self, rate: Complex) -> Complex:
        """Return Y W, shape (m, strips + 2 n, n)."""
        return np.asarray(self.wash[0] + rate[:, None, None] * self.wash[1])

    def _combined(self, q: Complex, rate: Complex) -> Complex:
        n = self.size
        return np.asarray(q[:, :n] + rate[:, None, None] * q[:, n:])


def lattice_model(
    influence: Influence,
    motion: PanelMotion,
    length: Real,
    density: float,
    half_chord: float,
    lattice: Lattice,
) -> LatticeModel:
    """Return the lattice for the coordinates of a panel motion.

    Parameters
    ----------
    influence : Influence
    motion : PanelMotion
        n coordinates.
    length : array, shape (panels,)
        Length behind each bound vortex that its circulation loads, in metres.
    density : float
        Of the air in kg/m^3.
    half_chord : float
        Reference length b in metres.
    lattice : Lattice
        Its relaxation and scheme.
    """
    strips, rows = influence.strips, influence.chordwise
    steps = tuple(influence.step(g) / half_chord for g in range(len(influence.groups)))
    load = density * np.tile(strips.width, rows)
    R = np.vstack(
        [
            np.tile(np.eye(strips.count), rows),
            load * motion.vortex.T,
            load * length * motion.load.T,
        ]
    )
    factors = scipy.linalg.lu_factor(influence.wing, check_finite=False)
    Y = scipy.linalg.lu_solve(factors, R.T, trans=1, check_finite=False).T
    wakes = [influence.wake_skeleton(group) for group in range(len(influence.groups))]
    return LatticeModel(
        half_chord=half_chord,
        wake=tuple(influence.projected_wake(Y, g, wake.rows) for g, wake in enumerate(wakes)),
        weights=tuple(wake.weights for wake in wakes),
        steps=steps,
        order=np.concatenate(influence.groups),
        wash=(Y @ motion.slope, Y @ motion.collocation),
        relaxation=lattice.relaxation,
        scheme=TimeScheme(lattice.scheme, influence.step(0)),
    )
