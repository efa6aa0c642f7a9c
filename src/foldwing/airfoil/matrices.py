"""The equations of motion of a typical section, in ratios.

Coordinates are the plunge h1 of the elastic axis in half chords, positive **down**, the plunge h2
of the second mass if there is one, also positive down, and the pitch alpha, positive nose up; time
is in 1/omega_1. A particle x half chords aft of the elastic axis goes down by h1 + x alpha in the
airfoil and by h2 + x alpha in the second mass, which hangs on a spring from the airfoil's plunge
but pitches with the airfoil, its mass centre at the same offset e. Per m b^2 omega_1^2,

    2 T = h1'^2 + 2 e h1' alpha' + m2 (h2'^2 + 2 e h2' alpha') + r^2 alpha'^2
    2 V = h1^2 + m2 w2^2 (h2 - h1)^2 + r^2 wa^2 alpha^2

with the ratios m2, w2 and wa of masses and frequencies. Lagrange's equations give M q'' + K q = Q.
The air does the virtual work -L dh1 + M dalpha, with the lift up and the moment about the elastic
axis nose up (T. Theodorsen, NACA Report 496, 1935), where mu = m / (pi rho b^2), U is in b omega_1
and C is Theodorsen's function:

    w34 = h1' + (1/2 - a) alpha' + U alpha
    mu L = h1'' + U alpha' - a alpha'' + 2 U C w34
    mu M = a h1'' - U (1/2 - a) alpha' - (1/8 + a^2) alpha'' + 2 U C (1/2 + a) w34
"""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.model import TypicalSection


@dataclass(frozen=True)
class SectionMatrices:
    """M q'' + K q = Q; symmetric M and K.

    -Q = apparent_mass q'' + U rate q' + C (U lag_rate q' + U^2 lag q).

    Attributes
    ----------
    mass, stiffness, apparent_mass, rate, lag_rate, lag : array, shape (n, n)
        n = 2 for (h1, alpha), n = 3 for (h1, h2, alpha).
    """

    mass: Real
    stiffness: Real
    apparent_mass: Real
    rate: Real
    lag_rate: Real
    lag: Real

    @property
    def quasi_steady(self) -> "SectionMatrices":
        """The same without apparent mass terms; C is then taken as 1."""
        zero = np.zeros_like(self.rate)
        return SectionMatrices(self.mass, self.stiffness, zero, zero, self.lag_rate, self.lag)


def section_matrices(section: TypicalSection) -> SectionMatrices:
    """Return the matrices of a section of two or three degrees of freedom."""
    e, r2, wa = section.mass_offset, section.inertia_ratio, section.torsion_frequency_ratio
    m2, w2 = section.second_mass_ratio or 0.0, section.second_frequency_ratio or 0.0
    k2 = m2 * w2**2
    mass = np.array([[1.0, 0.0, e], [0.0, m2, m2 * e], [e, m2 * e, r2]])
    stiffness = np.array([[1.0 + k2, -k2, 0.0], [-k2, k2, 0.0], [0.0, 0.0, r2 * wa**2]])
    present = [0, 1, 2] if section.second_mass_ratio else [0, 2]
    kept = np.ix_(present, present)
    return SectionMatrices(mass[kept], stiffness[kept], *(A[kept] for A in _air(section)))


def _air(section: TypicalSection) -> tuple[Real, Real, Real, Real]:
    """Return apparent mass, rate, lag rate and lag, shape (3, 3) each."""
    a = section.axis_offset
    plunge, pitch = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    downwash = plunge + (0.5 - a) * pitch
    lift_arm = plunge - (0.5 + a) * pitch
    apparent = (
        np.outer(plunge, plunge)
        - a * (np.outer(plunge, pitch) + np.outer(pitch, plunge))
        + (0.125 + a**2) * np.outer(pitch, pitch)
    )
    terms = (
        apparent,
        np.outer(downwash, pitch),
        2.0 * np.outer(lift_arm, downwash),
        2.0 * np.outer(lift_arm, pitch),
    )
    apparent, rate, lag_rate, lag = (term / section.mass_ratio for term in terms)
    return apparent, rate, lag_rate, lag
