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
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy.linalg

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import VORTEX, SegmentMesh
from foldwing.aerodynamics.schemes import EXACT, TimeScheme
from foldwing.aerodynamics.wake import shed, shed_with_derivative
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.model import Lattice

WAKE_END = 0.25
"""Length of a panel, from its trailing edge forward, that the growing circulation does not load:
the lattice sees circulation up to there."""

WAKE_DECAY = 0.5
"""The wake that ends has roots of its own at decays from 0.6 or 0.7 over the square root of its
length in chords on, found for 5 to 80 chords; a model is trusted up to this."""

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
    response : array, shape (strips + 2 n, panels)
        Y.
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
    response: Real
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
    def largest_decay(self) -> float:
        """Decay -Re p up to which no root of the wake's end is met, by experience."""
        chords = min(h * len(X) for h, X in zip(self.steps, self.weights, strict=True)) / 2.0
        return float(WAKE_DECAY / np.sqrt(chords))

    def driven(self, slope: Real, collocation: Real) -> "LatticeModel":
        """Return the forces on the same modes of another wash dw/dx and w, each (panels, n)."""
        return replace(self, wash=(self.response @ slope, self.response @ collocation))

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

    @property
    def has_apparent_mass(self) -> bool:
        """Growing circulation loads all panels."""
        return True

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
        response=Y,
        wash=(Y @ motion.slope, Y @ motion.collocation),
        relaxation=lattice.relaxation,
        scheme=TimeScheme(lattice.scheme, influence.step(0)),
    )
