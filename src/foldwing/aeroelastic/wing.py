"""From a wing to its aeroelastic system: what depends on the fold angles and what does not."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.combined import CombinedModel
from foldwing.aerodynamics.doubts import (
    check_equal_chords,
    check_plain,
    gap_warning,
    have_equal_chords,
    strips_warning,
    unused_warning,
)
from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import (
    COLLOCATION,
    VORTEX,
    SegmentMesh,
    Strips,
    folded_strips,
    mesh_segments,
)
from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.strip import StripForces, StripModel, strip_forces, strip_model
from foldwing.aerodynamics.unsteady import LatticeModel, PanelMotion, lattice_model, load_length
from foldwing.aeroelastic.aircraft import (
    aircraft_trim,
    free_hinge_warning,
    tail_forces,
    trim_forces,
)
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.trim import Trim
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Wing
from foldwing.structure.assembly import Assembly, assemble
from foldwing.structure.component import ComponentModes
from foldwing.structure.modes import StructuralModes, natural_modes

AERODYNAMIC_MODELS = ("strip", "quasi-steady", "lattice")
"""Names of the aerodynamic models, the default first."""


def default_aerodynamics(wing: Wing) -> str:
    """Return the aerodynamic model that a wing is studied with unless another is asked for."""
    if wing.aircraft is None or wing.aircraft.wing_aerodynamics == "theodorsen":
        return AERODYNAMIC_MODELS[0]
    return wing.aircraft.wing_aerodynamics


def check_clamped(wing: Wing, field: str, value: object, remedy: str) -> None:
    """Refuse what only a wing with a clamped root can do."""
    if wing.aircraft is not None:
        raise InputError(field, value, "is for wings with a clamped root only", remedy)


@dataclass(frozen=True)
class AeroelasticWing:
    """A wing with everything computed once that a sweep of fold angles shares.

    Parameters
    ----------
    wing : Wing
    aerodynamics : str
        One of ``AERODYNAMIC_MODELS``; by default what the wing's aircraft says, else the first.
    dropped : tuple of str
        Names of natural modes to leave out, such as ``B2``.

    Raises
    ------
    InputError
        When there is no such aerodynamic model, or a discrete-time lattice has unequal chords.
    """

    wing: Wing
    aerodynamics: str = ""
    dropped: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Fill in the aerodynamics; refuse unknown ones, and time steps that fit no chord."""
        if not self.aerodynamics:
            object.__setattr__(self, "aerodynamics", default_aerodynamics(self.wing))
        if self.aerodynamics not in AERODYNAMIC_MODELS:
            limit = f"must be one of: {', '.join(AERODYNAMIC_MODELS)}"
            remedy = f"The default is {AERODYNAMIC_MODELS[0]}."
            raise InputError("aerodynamics", self.aerodynamics, limit, remedy)
        check_plain(self.wing)
        scheme = self.wing.lattice.scheme
        if self.aerodynamics == "lattice" and scheme != "exact":
            check_equal_chords(self.wing, "lattice.scheme", scheme, 'Take scheme = "exact".')
            check_clamped(self.wing, "lattice.scheme", scheme, 'Take scheme = "exact".')

    @property
    def equal_chords(self) -> bool:
        """Whether all segments have the same chord."""
        return have_equal_chords(self.wing)

    @cached_property
    def assembly(self) -> Assembly:
        """Segments joined, without fold angles."""
        return assemble(self.wing)

    @property
    def half_chord(self) -> float:
        """Reference length b of p in metres: the half chord of segment 1."""
        return self.wing.segments[0].half_chord

    @cached_property
    def _strips(self) -> tuple[StripForces, ...]:
        density = self.wing.air.density
        forces = []
        for segment, component in zip(self.wing.segments, self.assembly.components, strict=True):
            y, weights = gauss_rule(segment.span, component.count + 24)
            forces.append(strip_forces(segment, density, weights, *component.section_motion(y)))
        return tuple(forces)

    @cached_property
    def meshes(self) -> tuple[SegmentMesh, ...]:
        """Panels of every segment in its own plane."""
        return mesh_segments(self.wing)

    @cached_property
    def _load_lengths(self) -> tuple[Real, ...]:
        return tuple(load_length(mesh, self.wing.lattice.scheme) for mesh in self.meshes)

    @cached_property
    def _panel_motions(self) -> tuple[PanelMotion, ...]:
        """Motion of the panels of each segment in the segment's own coordinates."""
        parts = zip(self.assembly.components, self.meshes, self._load_lengths, strict=True)
        return tuple(_panel_motion(*part) for part in parts)

    def modes(self, fold_angles: tuple[float, ...] | None = None) -> StructuralModes:
        """Return the natural modes at the fold angles psi_2 .. psi_N in radians.

        Raises
        ------
        InputError
            When a mode to leave out does not exist, or none would remain.
        """
        modes = natural_modes(self.assembly, fold_angles)
        return modes.without(self.dropped) if self.dropped else modes

    def strips(self, modes: StructuralModes) -> Strips:
        """Return the strips of the vortex lattice on the folded wing."""
        return folded_strips(self.meshes, modes.origins, modes.rotations)

    def warning(self, modes: StructuralModes) -> str:
        """Return what makes the aerodynamics doubtful in words, empty when nothing does.

        Raises
        ------
        InputError
            When segments of a vortex lattice lie on each other, or reach through the wall.
        """
        imported = self.assembly.warnings
        if self.aerodynamics != "lattice":
            return " ".join(filter(None, (*imported, free_hinge_warning(self.wing))))
        image = self.wing.lattice.image
        doubts = strips_warning(self.strips(modes), modes.fold_angles, image)
        others = gap_warning(self.wing), unused_warning(self.wing), free_hinge_warning(self.wing)
        return " ".join(filter(None, (*imported, doubts, *others)))

    def influence(self, modes: StructuralModes) -> Influence:
        """Return the influence of the vortices of the folded wing and its wake."""
        lattice = self.wing.lattice
        rows = max(1, round(lattice.wake * lattice.chordwise))
        return Influence(self.strips(modes), lattice.chordwise, rows, lattice.image)

    def panel_motion(self, modes: StructuralModes) -> PanelMotion:
        """Return the motion of all panels per unit modal coordinate."""
        count = modes.count
        parts = [
            [part.reshape(self.wing.lattice.chordwise, -1, count) for part in motion.projected(q)]
            for motion, q in zip(self._panel_motions, modes.by_segment, strict=True)
        ]
        joined = (
            np.concatenate(part, axis=1).reshape(-1, count) for part in zip(*parts, strict=True)
        )
        return PanelMotion(*joined)

    @cached_property
    def load_lengths(self) -> Real:
        """Length behind each bound vortex that its growing circulation loads, shape (panels,)."""
        columns = [
            np.repeat(length[:, None], len(mesh.middle), axis=1)
            for length, mesh in zip(self._load_lengths, self.meshes, strict=True)
        ]
        return np.concatenate(columns, axis=1).ravel()

    def lattice(self, modes: StructuralModes) -> LatticeModel:
        """Return the vortex lattice for the modes."""
        return lattice_model(
            self.influence(modes),
            self.panel_motion(modes),
            self.load_lengths,
            self.wing.air.density,
            self.half_chord,
            self.wing.lattice,
        )

    def strip_theory(self, modes: StructuralModes) -> StripModel:
        """Return strip theory for the modes, quasi-steady unless its forces are to lag.

        The tail of an aircraft comes last.
        """
        lag = self.aerodynamics == "strip"
        model = strip_model(self._strips, modes.by_segment, self.half_chord, lag)
        return replace(model, segments=(*model.segments, *self._tail(modes)))

    def _tail(self, modes: StructuralModes) -> tuple[StripForces, ...]:
        if self.wing.aircraft is None:
            return ()
        forces = tail_forces(self.wing, self.assembly.components[0])
        return (forces.projected(modes.by_segment[0]),)

    def aerodynamic_model(self, modes: StructuralModes) -> AerodynamicModel:
        """Return the aerodynamic forces of the modes, those of a tail included."""
        if self.aerodynamics != "lattice":
            return self.strip_theory(modes)
        return self._with_tail(self.lattice(modes), modes)

    def _with_tail(self, lattice: LatticeModel, modes: StructuralModes) -> AerodynamicModel:
        if self.wing.aircraft is None:
            return lattice
        return CombinedModel((lattice, StripModel(self.half_chord, self._tail(modes))))

    def trim(self, modes: StructuralModes) -> Trim:
        """Return level flight of the aircraft at the fold angles of its modes.

        Raises
        ------
        InputError
            When no angle of attack lifts the weight.
        """
        return aircraft_trim(self, modes)

    def system(self, modes: StructuralModes) -> AeroelasticSystem:
        """Return the aeroelastic problem of the modes in the airstream.

        Raises
        ------
        InputError
            When an aircraft cannot fly level.
        """
        lattice = self.lattice(modes) if self.aerodynamics == "lattice" else None
        forces = self.strip_theory(modes) if lattice is None else self._with_tail(lattice, modes)
        steady = None
        if self.wing.aircraft is not None:
            steady = trim_forces(self, modes, self.trim(modes), lattice)
        return AeroelasticSystem(modes.omega, forces, modes.damping, steady)


def _panel_motion(component: ComponentModes, mesh: SegmentMesh, length: Real) -> PanelMotion:
    """Return the motion of the panels of one segment, normal to it, in its coordinates."""
    collocation, vortex = mesh.station(COLLOCATION), mesh.station(VORTEX)
    return PanelMotion(
        component.slopes(*mesh.points(collocation))[:, 0],
        *(
            component.displacement(*mesh.points(station))[:, 2]
            for station in (collocation, vortex, vortex + length / 2.0)
        ),
    )
