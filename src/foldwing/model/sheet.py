"""A sheet of isotropic material whose thickness may vary along chord and span."""

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.model.listed import Thickness
from foldwing.model.quantities import Density, Modulus, PoissonsRatio
from foldwing.model.record import Record


class Sheet(Record):
    """What a plate is made of.

    Attributes
    ----------
    youngs_modulus : float
        E, Pa.
    poissons_ratio : float
        nu.
    density : float
        Mass per volume, kg/m^3.
    thickness : tuple of tuple of float
        t in m at evenly spaced fractions: one row for each span fraction from the inboard to the
        outboard end, each from the leading to the trailing edge; linear between them.
    """

    youngs_modulus: Modulus
    poissons_ratio: PoissonsRatio
    density: Density
    thickness: Thickness

    @property
    def stiffness(self) -> Real:
        """Plane-stress stiffness Q in Pa, strains xx, yy and xy (engineering), shape (3, 3)."""
        E, nu = self.youngs_modulus, self.poissons_ratio
        Q = np.array([[1.0, nu, 0.0], [nu, 1.0, 0.0], [0.0, 0.0, (1.0 - nu) / 2.0]])
        return E / (1.0 - nu**2) * Q

    @property
    def is_uniform(self) -> bool:
        """Whether the thickness is the same everywhere."""
        return len({t for row in self.thickness for t in row}) == 1

    def thickness_at(self, chordwise: Real, spanwise: Real) -> Real:
        """Return the thickness in m at fractions of chord and span, each of shape (m,)."""
        table = np.array(self.thickness)
        below, share = _between(np.asarray(spanwise, float), len(table))
        rows = table[below], table[np.minimum(below + 1, len(table) - 1)]
        ahead, part = _between(np.asarray(chordwise, float), table.shape[1])
        behind = np.minimum(ahead + 1, table.shape[1] - 1)
        index = np.arange(len(ahead))
        inner, outer = (
            (1.0 - part) * row[index, ahead] + part * row[index, behind] for row in rows
        )
        return np.asarray((1.0 - share) * inner + share * outer)


def _between(fraction: Real, count: int) -> tuple[Real, Real]:
    """Return the place below a fraction among ``count`` even ones, and the share of the next."""
    at = np.clip(fraction, 0.0, 1.0) * (count - 1)
    below = np.minimum(at.astype(int), max(count - 2, 0))
    return below, at - below
