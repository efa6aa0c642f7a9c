"""Isotropic materials, and the section properties of a strip of sheet made of one."""

from typing import Self

from pydantic import model_validator

from foldwing.model.faults import fault
from foldwing.model.quantities import Density, Modulus, PoissonsRatio
from foldwing.model.record import Record


class Material(Record):
    """An isotropic material; exactly one of shear modulus and Poisson's ratio is given.

    Attributes
    ----------
    youngs_modulus : float
        E, Pa.
    density : float
        Mass per volume, kg/m^3.
    shear_modulus : float, optional
        G, Pa.
    poissons_ratio : float, optional
        nu, in (-1, 0.5].
    name : str
        For reports.
    """

    youngs_modulus: Modulus
    density: Density
    shear_modulus: Modulus | None = None
    poissons_ratio: PoissonsRatio | None = None
    name: str = ""

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        limit = "exactly one of shear_modulus and poissons_ratio must be given"
        if self.shear_modulus is None and self.poissons_ratio is None:
            remedy = 'Add poissons_ratio = 0.3 or shear_modulus = "1.2 GPa".'
            raise fault(("shear_modulus",), None, limit, remedy)
        if self.shear_modulus is not None and self.poissons_ratio is not None:
            remedy = "Remove one of them."
            raise fault(("poissons_ratio",), self.poissons_ratio, limit, remedy)
        return self

    @property
    def shear(self) -> float:
        """Shear modulus G in Pa, as given or E / (2 (1 + nu))."""
        if self.shear_modulus is not None:
            return self.shear_modulus
        assert self.poissons_ratio is not None
        return self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))


def strip_properties(material: Material, chord: float, thickness: float) -> dict[str, float]:
    """Return stiffnesses and mass of a thin uniform strip of sheet.

    Parameters
    ----------
    material : Material
        What the sheet is made of.
    chord, thickness : float
        m.

    Returns
    -------
    dict
        ``bending_stiffness`` EI and ``torsion_stiffness`` GJ in N*m^2, ``mass_per_span`` in kg/m.
    """
    c, t = chord, thickness
    cube = t * t * t  # t**3 raises OverflowError where the product gives inf, which is validated
    return {
        "bending_stiffness": material.youngs_modulus * c * cube / 12.0,
        "torsion_stiffness": material.shear * c * cube / 3.0,
        "mass_per_span": material.density * c * t,
    }


def strip_inertia(mass_per_span: float, chord: float, mass_offset: float) -> float:
    """Return the inertia per span in kg*m of a uniform strip about an axis off its mass centre.

    Parameters
    ----------
    mass_per_span : float
        kg/m.
    chord : float
        m.
    mass_offset : float
        Distance from the axis to the mass centre, m.
    """
    return mass_per_span * (chord * chord / 12.0 + mass_offset * mass_offset)
