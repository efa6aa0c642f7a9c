"""Circulation and pressure of every panel of the vortex lattice, solved directly.

With g = circulation / U of unit motions, r = p / b and S the sums along the chord,

    [A0 + sum_j omega_j A_j S] g = W,
    dp_i / (rho U^2) = g_i / dx + r (sum of g_j ahead of it + g_i / 2).

The first part of the pressure dp is the load of Kutta and Joukowski: the circulation of a panel
over its length. The second is that of growing circulation. It is the unsteady load of
`foldwing.aerodynamics.unsteady`, cut into lengths of one panel centred on the vortices: a vortex
loads the length behind it evenly, thus half of its own length and all of those downstream, the last
of which ends where the lattice sees circulation last, a quarter of a panel before the trailing
edge. Pressure times area of a panel is therefore exactly its load, and dp is the pressure at the
vortex. Only the half of its own length that a vortex loads acts elsewhere, a quarter of a panel
downstream: loads put on the vortices give Qhat to second order in the length of a panel.
`PanelLoads.forces_by_segment` puts every load in its place and gives it to round-off. (The printed
scheme loads three quarters of the own length, and the whole of the last one.)
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import VORTEX, Strips
from foldwing.aerodynamics.schemes import Rates, TimeScheme
from foldwing.aerodynamics.unsteady import PRINTED_END, WAKE_END, PanelMotion
from foldwing.aerodynamics.wake import shed
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.model import Lattice


@dataclass(frozen=True)
class PanelLoads:
    """Circulation and loads of all panels for unit motions of n coordinates at m values of p.

    Everything is divided by a power of the airspeed, so that one result serves any.

    Parameters
    ----------
    strips : Strips
    motion : PanelMotion
        n coordinates.
    length : array, shape (panels,)
        Length behind each vortex that its circulation loads, in metres.
    density : float
        Of the air in kg/m^3.
    scheme : TimeScheme
    rates : Rates
        How the scheme takes derivatives at the m values of p / b.
    circulation : array, shape (m, panels, n)
        Over the airspeed, in metres per unit of each coordinate; positive lifts.
    """

    strips: Strips
    motion: PanelMotion
    length: Real
    density: float
    scheme: TimeScheme
    rates: Rates
    circulation: Complex

    @property
    def chordwise(self) -> int:
        """Number of panels along the chord."""
        return len(self.length) // self.strips.count

    @property
    def segment(self) -> Indices:
        """Segment of each panel, from 0, shape (panels,)."""
        return np.tile(self.strips.segment, self.chordwise)

    @property
    def _on_vortices(self) -> Complex:
        """Density times circulation as the structure feels it in the scheme, (m, panels, n)."""
        return np.asarray(self.density * self.circulation / self.rates.gain[:, None, None])

    @cached_property
    def pressure(self) -> Complex:
        """Pressure below less pressure above over U^2, at the vortices, shape (m, panels, n)."""
        loads = self._on_vortices
        m, _, n = loads.shape
        rows = loads.reshape(m, self.chordwise, self.strips.count, n)
        behind = VORTEX + (PRINTED_END if self.scheme.name == "printed" else WAKE_END)
        ahead = np.cumsum(rows, axis=1) - behind * rows
        bound = rows * (self.chordwise / self.strips.chord)[:, None]
        growing = self.rates.rate[:, None, None, None] * ahead
        return np.asarray((bound + growing).reshape(loads.shape))

    def forces_by_segment(self) -> Complex:
        """Return the part of Qhat from each segment, shape (m, segments, n, n)."""
        width = np.tile(self.strips.width, self.chordwise)
        bound = self._on_vortices * width[:, None]
        growing = bound * self.length[:, None] * self.rates.rate[:, None, None]
        parts = []
        for number in range(int(self.strips.segment.max()) + 1):
            own = self.segment == number
            on_vortex, behind = self.motion.vortex[own].T, self.motion.load[own].T
            parts.append(on_vortex @ bound[:, own] + behind @ growing[:, own])
        return np.stack(parts, axis=1)


def panel_loads(
    influence: Influence,
    motion: PanelMotion,
    length: Real,
    air: tuple[float, float],
    lattice: Lattice,
    p: Complex,
) -> PanelLoads:
    """Solve for the circulation of every panel.

    Parameters
    ----------
    influence : Influence
    motion : PanelMotion
        n coordinates.
    length : array, shape (panels,)
        Length behind each vortex that its circulation loads, in metres.
    air : (float, float)
        Density in kg/m^3, and the reference length b of p in metres.
    lattice : Lattice
        Its relaxation and scheme.
    p : array, shape (m,)
        Reduced Laplace variable.
    """
    density, half_chord = air
    r = p / half_chord
    scheme = TimeScheme(lattice.scheme, influence.step(0))
    rates = scheme.rates(r)
    wash = motion.slope + rates.rate[:, None, None] * motion.collocation
    A0, wake = influence.wing, _wake_influence(influence, r, lattice.relaxation)
    g = np.empty(wash.shape, complex)
    for index, behind in enumerate(wake):
        g[index] = np.linalg.solve(A0 + np.tile(behind, influence.chordwise), wash[index])
    return PanelLoads(influence.strips, motion, length, density, scheme, rates, g)


def _wake_influence(influence: Influence, r: Complex, relaxation: float) -> Complex:
    """Return the wash of the wake of each strip per unit circulation, (m, panels, strips)."""
    wake = np.zeros((len(r), influence.count, influence.strips.count), complex)
    for group, strips in enumerate(influence.groups):
        omega = shed(r * influence.step(group), influence.rows, relaxation)
        own = np.zeros((len(r), influence.count, len(strips)), complex)
        for factor, A in zip(omega.T, influence.wake_rows(group), strict=True):
            own.real += factor.real[:, None, None] * A
            own.imag += factor.imag[:, None, None] * A
        wake[:, :, strips] = own
    return wake


def panel_corners(strips: Strips, chordwise: int) -> Real:
    """Return the corners of every panel on the folded wing in metres, shape (panels, 4, 3).

    They go around: inboard leading, outboard leading, outboard trailing, inboard trailing.
    """
    x = strips.leading + np.arange(chordwise + 1)[:, None] * strips.chord / chordwise
    front, back = x[:-1].ravel(), x[1:].ravel()
    inner, outer = (np.tile(edge, (chordwise, 1)) for edge in (strips.inner, strips.outer))
    corners = ((front, inner), (front, outer), (back, outer), (back, inner))
    return np.stack([np.column_stack([along, edge]) for along, edge in corners], axis=1)
