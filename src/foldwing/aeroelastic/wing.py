"""From a wing to its aeroelastic system: what depends on the fold angles and what does not."""

from dataclasses import dataclass
from functools import cached_property

from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.strip import StripForces, strip_forces, strip_model
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.errors import InputError
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Wing
from foldwing.structure.assembly import Assembly, assemble
from foldwing.structure.modes import StructuralModes, natural_modes

AERODYNAMIC_MODELS = ("strip", "quasi-steady")
"""Names of the aerodynamic models, the default first."""


@dataclass(frozen=True)
class AeroelasticWing:
    """A wing with everything computed once that a sweep of fold angles shares.

    Parameters
    ----------
    wing : Wing
    aerodynamics : str
        One of ``AERODYNAMIC_MODELS``.

    Raises
    ------
    InputError
        When there is no such aerodynamic model.
    """

    wing: Wing
    aerodynamics: str = "strip"

    def __post_init__(self) -> None:
        """Refuse unknown aerodynamics."""
        if self.aerodynamics not in AERODYNAMIC_MODELS:
            limit = f"must be one of: {', '.join(AERODYNAMIC_MODELS)}"
            remedy = f"The default is {AERODYNAMIC_MODELS[0]}."
            raise InputError("aerodynamics", self.aerodynamics, limit, remedy)

    @cached_property
    def assembly(self) -> Assembly:
        """Segments joined, without fold angles."""
        return assemble(self.wing)

    @cached_property
    def _strips(self) -> tuple[StripForces, ...]:
        density = self.wing.air.density
        forces = []
        for segment, component in zip(self.wing.segments, self.assembly.components, strict=True):
            y, weights = gauss_rule(segment.span, component.count + 24)
            forces.append(strip_forces(segment, density, weights, *component.section_motion(y)))
        return tuple(forces)

    def modes(self, fold_angles: tuple[float, ...] | None = None) -> StructuralModes:
        """Return the natural modes at the fold angles psi_2 .. psi_N in radians."""
        return natural_modes(self.assembly, fold_angles)

    def aerodynamic_model(self, modes: StructuralModes) -> AerodynamicModel:
        """Return the aerodynamic forces of the modes."""
        half_chord = self.wing.segments[0].half_chord
        lag = self.aerodynamics == "strip"
        return strip_model(self._strips, modes.by_segment, half_chord, lag)

    def system(self, modes: StructuralModes) -> AeroelasticSystem:
        """Return the aeroelastic problem of the modes in the airstream."""
        return AeroelasticSystem(modes.omega, self.aerodynamic_model(modes), modes.damping)
