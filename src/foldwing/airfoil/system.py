"""A typical section as a stability problem: T(p; U) x = 0 in its natural modes at rest."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg

from foldwing.airfoil.matrices import SectionMatrices, section_matrices
from foldwing.maths.arrays import Complex, Real
from foldwing.maths.bessel import theodorsen_with_derivative
from foldwing.model import TypicalSection
from foldwing.stability.problem import Pencil, StillAir

AERODYNAMIC_MODELS = ("strip", "quasi-steady")
"""Names of the aerodynamic models, the default first."""


@dataclass(frozen=True)
class SectionSystem:
    """A section in its flow; obeys the port of the stability solvers.

    Speeds are in m/s and eigenvalues in rad/s when the section has scales. Without them the half
    chord is 1, speeds are U / (b omega_1) and eigenvalues lambda / omega_1.

    Parameters
    ----------
    section : TypicalSection
    aerodynamics : str
        ``strip``, Theodorsen's theory, or ``quasi-steady``: C = 1 and no apparent mass.
    """

    section: TypicalSection
    aerodynamics: str = "strip"

    @property
    def lag(self) -> bool:
        """Whether the circulatory forces lag by Theodorsen's C(p)."""
        return self.aerodynamics != "quasi-steady"

    @cached_property
    def matrices(self) -> SectionMatrices:
        """The equations of motion in physical coordinates and ratios."""
        matrices = section_matrices(self.section)
        return matrices if self.lag else matrices.quasi_steady

    @property
    def size(self) -> int:
        """Number n of degrees of freedom, 2 or 3."""
        return len(self.matrices.mass)

    @property
    def half_chord(self) -> float:
        """Reference length b of p = lambda b / U in metres; 1 without scales."""
        return self.section.half_chord or 1.0

    @property
    def highest_frequency(self) -> float:
        """No limit: Theodorsen's function holds at any reduced frequency."""
        return math.inf

    @property
    def largest_decay(self) -> float:
        """No limit: Theodorsen's function is continued to decaying motions."""
        return math.inf

    @cached_property
    def _modes(self) -> tuple[Real, Real]:
        """Frequencies over omega_1 and mass-normalized modes at rest, with apparent mass."""
        mass = self.matrices.mass + self.matrices.apparent_mass
        squared, shapes = scipy.linalg.eigh(self.matrices.stiffness, mass)
        return np.sqrt(squared), shapes

    @property
    def frequency_ratios(self) -> Real:
        """Natural frequencies at rest over omega_1, ascending, shape (n,)."""
        return self._modes[0]

    @property
    def mode_shapes(self) -> Real:
        """Natural modes at rest in the columns: (h1, alpha) or (h1, h2, alpha), shape (n, n)."""
        return self._modes[1]

    @cached_property
    def mode_names(self) -> tuple[str, ...]:
        """``pitch`` for the mode with most of its kinetic energy there, else ``plunge`` 1, 2."""
        mass = self.matrices.mass + self.matrices.apparent_mass
        share = self.mode_shapes[-1] ** 2 * mass[-1, -1]
        pitch = int(share.argmax())
        if self.size == 2:
            return ("pitch", "plunge") if pitch == 0 else ("plunge", "pitch")
        numbers = iter((1, 2))
        return tuple(
            "pitch" if mode == pitch else f"plunge {next(numbers)}" for mode in range(self.size)
        )

    @cached_property
    def _scaled(self) -> SectionMatrices:
        """The matrices in natural modes divided by their frequencies: unit stiffness."""
        omega, shapes = self._modes
        x = shapes / omega
        A = self.matrices
        return SectionMatrices(
            *(
                x.T @ matrix @ x
                for matrix in (
                    A.mass, A.stiffness, A.apparent_mass, A.rate, A.lag_rate, A.lag
                )
            )
        )  # fmt: skip

    @cached_property
    def _damping(self) -> Real | None:
        """Structural damping of the natural modes, over omega_1."""
        ratio = self.section.analysis.damping
        return np.diag(2.0 * ratio / self.frequency_ratios) if ratio else None

    def pencil(self, p: Complex) -> Pencil:
        """Return the coefficients of T at the values ``p``, shape (m,)."""
        return self.pencil_with_derivative(p)[0]

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the coefficients of T and their derivatives with respect to p."""
        p = np.asarray(p, complex)
        A, unit = self._scaled, self.section.speed_unit
        C, dC = theodorsen_with_derivative(p) if self.lag else (np.ones_like(p), np.zeros_like(p))
        p, C, dC = (values[:, None, None] for values in (p, C, dC))
        inertia = A.mass + A.apparent_mass
        with np.errstate(invalid="ignore"):  # at p = 0 dC/dp is infinite
            lagging = p * A.lag_rate + A.lag
            T2: Complex = p**2 * inertia + p * A.rate + C * lagging
            dT2: Complex = 2.0 * p * inertia + A.rate + C * A.lag_rate + dC * lagging
        T1 = dT1 = None
        if self._damping is not None:
            T1, dT1 = p * self._damping / unit, np.ones_like(p) * self._damping / unit
        one: Complex = np.eye(self.size, dtype=np.complex128)
        zero = np.zeros_like(one)
        return Pencil(one, T1, T2 / unit**2), Pencil(zero, dT1, dT2 / unit**2)

    def still_air(self) -> StillAir:
        """Return the problem at U = 0, with apparent mass unless quasi-steady."""
        rate, omega = self.section.rate_unit, self.frequency_ratios
        damping = np.zeros((self.size, self.size)) if self._damping is None else self._damping
        return StillAir(
            mass=np.diag((omega * rate) ** -2.0),
            damping=damping / rate,
            stiffness=np.eye(self.size),
            columns=np.arange(self.size),
            apparent_mass=self.lag,
        )

    def uncoupled_crossings(self) -> Real:
        """Return the torsion frequency ratios at which pitch has the frequency of a plunge mode.

        Of pitch alone and plunge alone, each with its own apparent mass.
        """
        A = self.matrices
        inertia = A.mass + A.apparent_mass
        plunge = scipy.linalg.eigh(A.stiffness[:-1, :-1], inertia[:-1, :-1], eigvals_only=True)
        return np.asarray(np.sqrt(plunge * inertia[-1, -1] / A.mass[-1, -1]))
