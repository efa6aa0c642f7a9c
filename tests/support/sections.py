"""A typical section by another route: masses of particles, forces of a strip of a wing.

In metres and seconds, from quantities that the program never forms.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import sqrtm
from scipy.special import hankel2

from foldwing.aerodynamics.strip import strip_forces
from foldwing.model import Segment, TypicalSection


@dataclass(frozen=True)
class RigidStrip:
    """One metre of span of a rigid wing on springs; coordinates (h1, h2, alpha), h down in m.

    Attributes
    ----------
    section : TypicalSection
        Its ratios; half chord, density and plunge frequency are chosen here.
    """

    section: TypicalSection
    b: float = 0.7
    rho: float = 1.3
    omega1: float = 3.0

    @property
    def masses(self):
        """Mass of the airfoil and of the second body in kg."""
        m = self.section.mass_ratio * np.pi * self.rho * self.b**2
        return m, m * (self.section.second_mass_ratio or 0.0)

    @property
    def mass(self):
        """Of two particles in either body, which go down with its plunge and with the pitch."""
        s, b, (m1, m2) = self.section, self.b, self.masses
        centre = s.mass_offset * b
        spread = np.sqrt(s.inertia_ratio * m1 * b**2 / (m1 + m2) - centre**2)
        x = centre + np.array([spread, -spread, spread, -spread])
        bodies = np.array([[1, 0], [1, 0], [0, 1], [0, 1]])
        motion = np.column_stack([bodies, x])
        return motion.T @ np.diag([m1 / 2, m1 / 2, m2 / 2, m2 / 2]) @ motion

    @property
    def stiffness(self):
        """Of springs to the ground, between the bodies, and in pitch: sum of k d d^T."""
        s, (m1, m2) = self.section, self.masses
        inertia = s.inertia_ratio * m1 * self.b**2
        springs = (
            (m1 * self.omega1**2, [1, 0, 0]),
            (m2 * ((s.second_frequency_ratio or 0.0) * self.omega1) ** 2, [-1, 1, 0]),
            (inertia * (s.torsion_frequency_ratio * self.omega1) ** 2, [0, 0, 1]),
        )
        return sum(k * np.outer(d, d) for k, d in springs)

    @property
    def kept(self):
        """Coordinates that have a mass."""
        return [0, 1, 2] if self.section.second_mass_ratio else [0, 2]

    @property
    def air(self):
        """Forces of the strip theory of wings, whose plunge is up."""
        segment = Segment(
            span=1.0,
            chord=2 * self.b,
            bending_stiffness=1.0,
            torsion_stiffness=1.0,
            mass_per_span=1.0,
            inertia_per_span=1.0,
            elastic_axis=(1 + self.section.axis_offset) / 2,
            mass_centre=(1 + self.section.axis_offset) / 2,
        )
        up, twist = np.array([[-1.0, 0.0, 0.0]]), np.array([[0.0, 0.0, 1.0]])
        return strip_forces(segment, self.rho, np.ones(1), up, twist)

    def matrix(self, omega, speed):
        """Return T(i omega; U)."""
        air = self.air
        k, lam = omega * self.b / speed, 1j * omega
        C = hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))
        forces = lam**2 * air.acceleration + lam * speed * air.rate
        forces = forces + C * (lam * speed * air.lag_rate + speed**2 * air.lag)
        T = lam**2 * self.mass + self.stiffness - forces
        return T[np.ix_(self.kept, self.kept)]

    def quasi_steady_roots(self, speed_ratio):
        """Return the eigenvalues over omega_1 of the state space with C = 1, no apparent mass.

        Structural damping is 2 zeta omega in every mode at rest, 2 zeta M (M^-1 K)^(1/2).
        """
        U, kept = speed_ratio * self.b * self.omega1, np.ix_(self.kept, self.kept)
        M, K, D = (
            A[kept]
            for A in (self.mass, self.stiffness - U**2 * self.air.lag, -U * self.air.lag_rate)
        )
        still = sqrtm(np.linalg.solve(M, self.stiffness[kept])).real
        D = D + 2.0 * self.section.analysis.damping * M @ still
        zero, one = np.zeros_like(M), np.eye(len(M))
        A = np.block([[zero, one], [-np.linalg.solve(M, K), -np.linalg.solve(M, D)]])
        return np.linalg.eigvals(A) / self.omega1

    def determinant(self, omega_ratio, speed_ratio):
        """Return det T over the product of its stiffnesses, at omega/omega_1 and U/(b omega_1)."""
        T = self.matrix(omega_ratio * self.omega1, speed_ratio * self.b * self.omega1)
        scale = np.diag(self.stiffness)[self.kept] ** -0.5
        return complex(np.linalg.det(T * np.outer(scale, scale)))
