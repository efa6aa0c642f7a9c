"""Loads of the air on a vibrating wing, and the work that it does.

All quantities vary as Re[(.) exp(i omega t)]. A force F on a displacement w does the work
pi Im(conj(w) F) over one cycle; positive work feeds the motion. In a motion that neither grows nor
decays, the air does as much work on the whole wing as the structure dissipates: without structural
damping none, and what it feeds in at one place it takes away at another. Not so where the motion
itself decays or grows (a damping threshold other than zero), or where a discrete-time scheme of the
lattice adds damping of its own (literal and printed).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from foldwing.aerodynamics.lattice import Strips
from foldwing.aerodynamics.panel_loads import PanelLoads, panel_corners, panel_loads
from foldwing.aeroelastic.aircraft import tail_forces_alone, trim_forces_by_surface
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.structure.modes import StructuralModes


class Motions(NamedTuple):
    """Motions of a wing in an airstream.

    Attributes
    ----------
    p : array, shape (m,)
        Reduced Laplace variable lambda b / U.
    speed : array, shape (m,)
        Airspeed in m/s.
    q : array, shape (m, n)
        Amplitude of each natural mode of unit modal mass.
    """

    p: Complex
    speed: Real
    q: Complex


@dataclass(frozen=True)
class Loads:
    """Loads of m motions of n natural modes.

    Parameters
    ----------
    motions : Motions
    half_chord : float
        Reference length b of p in metres.
    forces : array, shape (m, segments, n, n)
        Qhat from the air on each segment; the tail of an aircraft comes last.
    panels : PanelLoads, optional
        Of unit motions; only a vortex lattice has panels.
    """

    motions: Motions
    half_chord: float
    forces: Complex
    panels: PanelLoads | None = None

    @cached_property
    def _work(self) -> Real:
        """Work in J on mode i from the force caused by mode j, shape (m, segments, n, n)."""
        p, speed, q = self.motions
        on_modes = speed[:, None, None, None] ** 2 * self.forces * q[:, None, None, :]
        work = np.pi * (np.conj(q)[:, None, :, None] * on_modes).imag
        work[np.asarray(p).imag == 0.0] = np.nan
        return np.asarray(work)

    @property
    def work_by_segment(self) -> Real:
        """Work in J on each segment over a cycle, (m, segments); nan without oscillation."""
        return np.asarray(self._work.sum(axis=(2, 3)))

    @property
    def work_between_modes(self) -> Real:
        """Work in J over a cycle on mode i (second axis) from the force that mode j causes."""
        return np.asarray(self._work.sum(axis=1))

    @property
    def kinetic_energy(self) -> Real:
        """Kinetic energy of all modes at full amplitude in J, (m,); nan without oscillation."""
        p, speed, q = self.motions
        omega = np.asarray(p).imag * speed / self.half_chord
        energy = 0.5 * omega**2 * (np.abs(q) ** 2).sum(axis=1)
        return np.where(omega == 0.0, np.nan, energy)

    @property
    def mode_shares(self) -> Real:
        """Share of each mode in the kinetic energy, shape (m, n)."""
        energy = np.abs(self.motions.q) ** 2
        return np.asarray(energy / energy.sum(axis=1, keepdims=True))

    def circulation(self) -> Complex:
        """Return the circulation of every panel in m^2/s, shape (m, panels); positive lifts."""
        _, speed, q = self.motions
        return np.asarray((self._panels.circulation @ q[:, :, None])[..., 0] * speed[:, None])

    def pressure(self) -> Complex:
        """Return pressure below less pressure above every panel in Pa, shape (m, panels)."""
        _, speed, q = self.motions
        return np.asarray((self._panels.pressure @ q[:, :, None])[..., 0] * speed[:, None] ** 2)

    def pressure_of_modes(self, index: int) -> Complex:
        """Return what each mode adds to the pressure of one motion in Pa, shape (n, panels)."""
        _, speed, q = self.motions
        return np.asarray((self._panels.pressure[index] * q[index]).T * speed[index] ** 2)

    @property
    def _panels(self) -> PanelLoads:
        if self.panels is None:
            raise ValueError("panels: only a vortex lattice has them")
        return self.panels


def loads_of(model: AeroelasticWing, modes: StructuralModes, motions: Motions) -> Loads:
    """Return the loads of motions of a wing.

    Parameters
    ----------
    model : AeroelasticWing
    modes : StructuralModes
        The n natural modes of the folded wing.
    motions : Motions
    """
    if model.aerodynamics != "lattice":
        forces = model.strip_theory(modes).forces_by_segment(motions.p)
        return Loads(motions, model.half_chord, forces + _of_steady_lift(model, modes, motions))
    panels = panel_loads(
        model.influence(modes),
        model.panel_motion(modes),
        model.load_lengths,
        (model.wing.air.density, model.half_chord),
        model.wing.lattice,
        motions.p,
    )
    forces = panels.forces_by_segment()
    if model.wing.aircraft is not None:
        tail = tail_forces_alone(model, modes, motions.p)[:, None]
        forces = np.concatenate([forces, tail], axis=1)
        forces = forces + _of_steady_lift(model, modes, motions)
    return Loads(motions, model.half_chord, forces, panels)


def _of_steady_lift(
    model: AeroelasticWing, modes: StructuralModes, motions: Motions
) -> Complex | float:
    """Return what the steady lift of an aircraft adds, divided by U^2, (m, segments, n, n)."""
    if model.wing.aircraft is None:
        return 0.0
    forces = trim_forces_by_surface(model, modes, model.trim(modes), motions.p)
    return np.asarray(forces / motions.speed[:, None, None, None] ** 2)


@dataclass(frozen=True)
class PanelGrid:
    """Where the panels of a folded wing lie; they are numbered along the span first.

    Attributes
    ----------
    segment : array of int, shape (panels,)
        From 0.
    chordwise, spanwise : array of int, shape (panels,)
        Row from the leading edge and strip from the root, over all segments.
    corners : array, shape (panels, 4, 3)
        In metres, around each panel from the inboard corner of its leading edge.
    span : array, shape (panels,)
        Way from the root to the middle of the panel along the folded wing in metres.
    """

    segment: Indices
    chordwise: Indices
    spanwise: Indices
    corners: Real
    span: Real


def panel_grid(model: AeroelasticWing, modes: StructuralModes) -> PanelGrid:
    """Return the panels of the vortex lattice on the folded wing."""
    strips: Strips = model.strips(modes)
    rows = model.wing.lattice.chordwise
    starts = np.cumsum([0.0, *(segment.span for segment in model.wing.segments)])
    span = np.concatenate(
        [start + mesh.middle for start, mesh in zip(starts[:-1], model.meshes, strict=True)]
    )
    return PanelGrid(
        np.tile(strips.segment, rows),
        np.repeat(np.arange(rows), strips.count),
        np.tile(np.arange(strips.count), rows),
        panel_corners(strips, rows),
        np.tile(span, rows),
    )
