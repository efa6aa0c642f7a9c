"""From a wing to its aeroelastic system: what depends on the fold angles and what does not."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import (
    COLLOCATION,
    VORTEX,
    SegmentMesh,
    Strips,
    closeness,
    folded_strips,
    mesh_segments,
)
from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.strip import StripForces, StripModel, strip_forces, strip_model
from foldwing.aerodynamics.unsteady import LatticeModel, PanelMotion, lattice_model, load_length
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Segment, Wing
from foldwing.structure.assembly import Assembly, assemble
from foldwing.structure.component import ComponentModes
from foldwing.structure.modes import StructuralModes, natural_modes

DEFAULT_LIFT_SLOPE = float(Segment.model_fields["lift_slope"].default)

WIDE = 0.1
"""Width of a gap in chords above which it is named."""

TOUCHING, CLOSE = 1e-3, 0.1
"""Distance of segments, in widths of a strip, below which a lattice is refused or doubtful."""

AERODYNAMIC_MODELS = ("strip", "quasi-steady", "lattice")
"""Names of the aerodynamic models, the default first."""


@dataclass(frozen=True)
class AeroelasticWing:
    """A wing with everything computed once that a sweep of fold angles shares.

    Parameters
    ----------
    wing : Wing
    aerodynamics : str
        One of ``AERODYNAMIC_MODELS``.
    dropped : tuple of str
        Names of natural modes to leave out, such as ``B2``.

    Raises
    ------
    InputError
        When there is no such aerodynamic model, or a discrete-time lattice has unequal chords.
    """

    wing: Wing
    aerodynamics: str = "strip"
    dropped: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse unknown aerodynamics, and time steps that fit no chord."""
        if self.aerodynamics not in AERODYNAMIC_MODELS:
            limit = f"must be one of: {', '.join(AERODYNAMIC_MODELS)}"
            remedy = f"The default is {AERODYNAMIC_MODELS[0]}."
            raise InputError("aerodynamics", self.aerodynamics, limit, remedy)
        scheme = self.wing.lattice.scheme
        if self.aerodynamics == "lattice" and scheme != "exact":
            check_equal_chords(self.wing, "lattice.scheme", scheme, 'Take scheme = "exact".')

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
        if self.aerodynamics != "lattice":
            return ""
        image = self.wing.lattice.image
        doubts = strips_warning(self.strips(modes), modes.fold_angles, image)
        slopes = {segment.lift_slope for segment in self.wing.segments} - {DEFAULT_LIFT_SLOPE}
        unused = "The lattice does not use the model's lift_slope." if slopes else ""
        return " ".join(filter(None, (doubts, gap_warning(self.wing), unused)))

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
        """Return strip theory for the modes, quasi-steady unless its forces are to lag."""
        lag = self.aerodynamics == "strip"
        return strip_model(self._strips, modes.by_segment, self.half_chord, lag)

    def aerodynamic_model(self, modes: StructuralModes) -> AerodynamicModel:
        """Return the aerodynamic forces of the modes."""
        lattice = self.aerodynamics == "lattice"
        return self.lattice(modes) if lattice else self.strip_theory(modes)

    def system(self, modes: StructuralModes) -> AeroelasticSystem:
        """Return the aeroelastic problem of the modes in the airstream."""
        return AeroelasticSystem(modes.omega, self.aerodynamic_model(modes), modes.damping)


def gap_warning(wing: Wing) -> str:
    """Return in words that the lattice is too coarse for narrow gaps, or gaps are very wide."""
    meshes = mesh_segments(wing)
    narrow, wide = [], []
    for number, hinge in enumerate(wing.hinges, start=2):
        beside = [np.diff(meshes[number - 2].edges)[-1], np.diff(meshes[number - 1].edges)[0]]
        if 0.0 < hinge.gap < max(beside) and wing.lattice.spacing != "inset":
            narrow.append(str(number))
        if hinge.gap > WIDE * min(wing.segments[i].chord for i in (number - 2, number - 1)):
            wide.append(str(number))
    texts = (
        (
            narrow,
            "narrower than the strips beside: forces may be 10 % off, less with inset spacing",
        ),
        (wide, f"wider than {WIDE:g} chords"),
    )
    return " ".join(f"Gaps of hinges {', '.join(who)} are {text}." for who, text in texts if who)


def _in_degrees(fold_angles: Sequence[float]) -> str:
    return ", ".join(f"{math.degrees(angle):g}" for angle in fold_angles)


def strips_warning(strips: Strips, fold_angles: Sequence[float], image: bool) -> str:
    """Return in words that segments come too close for a lattice, empty when they do not.

    Parameters
    ----------
    strips : Strips
    fold_angles : sequence of float
        psi_2 .. psi_N in radians, for the message.
    image : bool
        Whether there is a wall at y = 0.

    Raises
    ------
    InputError
        When segments lie on each other, or reach through the wall.
    """
    if image and strips.middle[:, 0].min() <= 0.0:
        limit = "the folded wing must stay on its side of the wall at the root"
        remedy = "Take the wall away (image), or change the angles."
        raise InputError("fold", _in_degrees(fold_angles), limit, remedy)
    near = closeness(strips)
    pair = f"segments {near.segment + 1} and {near.other + 1}"
    if near.ratio < TOUCHING:
        limit = f"{pair} lie on each other, {round(1e3 * near.distance, 6):g} mm apart"
        remedy = "A vortex lattice cannot be folded flat: change the angle by some degrees."
        raise InputError("fold", _in_degrees(fold_angles), limit, remedy)
    if near.ratio < CLOSE:
        return (
            f"{pair.capitalize()} come within {1e3 * near.distance:.2g} mm of each other, "
            f"{near.ratio:.2g} widths of a strip: the lattice is inaccurate there."
        )
    return ""


def have_equal_chords(wing: Wing) -> bool:
    """Return whether all segments have the same chord."""
    return len({segment.chord for segment in wing.segments}) == 1


def check_equal_chords(wing: Wing, field: str, value: str, remedy: str) -> None:
    """Raise `InputError` unless one step in time fits all chords.

    Parameters
    ----------
    wing : Wing
    field, value, remedy : str
        What asks for discrete time, and what to do instead, for the message.
    """
    if not have_equal_chords(wing):
        limit = "a discrete-time scheme needs segments of equal chord"
        raise InputError(field, value, limit, remedy)


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
