"""Small problems with known answers, offered through the port of the stability solvers."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from foldwing.maths.arrays import Complex, Real
from foldwing.maths.bessel import theodorsen, theodorsen_with_derivative
from foldwing.stability.problem import Pencil, StillAir


def _stacked(coefficients: Complex, matrix: Real) -> Complex:
    return coefficients[:, None, None] * matrix


@dataclass(frozen=True)
class TypicalSection:
    """Airfoil with plunge and pitch springs in Theodorsen's flow; coordinates (h, alpha).

    Rates are in units of the plunge frequency omega_1; with the half chord 1 the speed is
    U/(b omega_1). Plunge h is positive down, alpha nose up. The pitch equation is
    divided by mu_i so that the structural matrices are symmetric. The defaults are the section of
    Hodges and Pierce, Introduction to Structural Dynamics and Aeroelasticity, chapter 4 (mass
    ratio 20, a = -1/5, mass centre 1/10 aft of the elastic axis, r^2 = 6/25, sigma = 2/5), for
    which U/(b omega_theta) is sigma times the speed used here.

    Attributes
    ----------
    a : float
        Elastic axis aft of mid-chord.
    e : float
        Mass centre aft of the elastic axis.
    inverse_mass_ratio : float
        pi rho b^2 / m.
    inverse_inertia : float
        m b^2 / i about the elastic axis.
    pitch_frequency : float
        omega_alpha / omega_1.
    damping_ratio : float
        Structural damping of the uncoupled plunge and pitch.
    half_chord : float
        Unit in which the speed is measured; it scales all speeds and changes no eigenvalue.
    """

    a: float = -1 / 5
    e: float = 1 / 10
    inverse_mass_ratio: float = 1 / 20
    inverse_inertia: float = 25 / 6
    pitch_frequency: float = 5 / 2
    damping_ratio: float = 0.0
    half_chord: float = 1.0
    highest_frequency: float = math.inf
    largest_decay: float = math.inf

    @property
    def size(self) -> int:
        """Two degrees of freedom."""
        return 2

    @property
    def mass(self) -> Real:
        """Structural mass without air."""
        return np.array([[1.0, self.e], [self.e, 1 / self.inverse_inertia]])

    @property
    def stiffness(self) -> Real:
        """Structural stiffness."""
        return np.diag([1.0, self.pitch_frequency**2 / self.inverse_inertia])

    @property
    def damping(self) -> Real:
        """Structural damping."""
        pitch = self.pitch_frequency / self.inverse_inertia
        return 2 * self.damping_ratio * np.diag([1.0, pitch])

    @property
    def apparent_mass(self) -> Real:
        """Mass of the air that moves with the section."""
        a = self.a
        return self.inverse_mass_ratio * np.array([[1.0, -a], [-a, 1 / 8 + a**2]])

    def _air(self) -> tuple[Real, Real, Real]:
        """Return the coefficients of p, p C and C in T2."""
        a, mu = self.a, self.inverse_mass_ratio
        A_d = mu * np.array([[0.0, 1.0], [0.0, 1 / 2 - a]])
        A_dD = 2 * mu * np.array([[1.0, 1 / 2 - a], [-(1 / 2 + a), -(1 / 4 - a**2)]])
        A_D = 2 * mu * np.array([[0.0, 1.0], [0.0, -(1 / 2 + a)]])
        return A_d, A_dD, A_D

    def pencil(self, p: Complex) -> Pencil:
        """Return T0, T1 and T2."""
        C, b = theodorsen(p), self.half_chord
        A_d, A_dD, A_D = self._air()
        T2 = _stacked(p**2, self.mass + self.apparent_mass) + _stacked(p, A_d)
        T2 += _stacked(p * C, A_dD) + _stacked(C, A_D)
        T1 = _stacked(p / b, self.damping) if self.damping_ratio else None
        return Pencil(self.stiffness.astype(np.complex128), T1, T2 / b**2)

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the pencil and its derivative with respect to p."""
        (C, dC), b = theodorsen_with_derivative(p), self.half_chord
        A_d, A_dD, A_D = self._air()
        dT2 = _stacked(2 * p, self.mass + self.apparent_mass) + A_d
        dT2 += _stacked(C + p * dC, A_dD) + _stacked(dC, A_D)
        dT1 = _stacked(np.ones_like(p) / b, self.damping) if self.damping_ratio else None
        return self.pencil(p), Pencil(np.zeros((2, 2), np.complex128), dT1, dT2 / b**2)

    def still_air(self) -> StillAir:
        """Return the section at rest, with apparent mass."""
        mass = self.mass + self.apparent_mass
        return StillAir(mass, self.damping, self.stiffness, np.arange(2), True)


@dataclass(frozen=True)
class ManySections:
    """Typical sections side by side, in generalized coordinates that hide which is which.

    Its eigenvalues are those of all sections together. They share the half chord, and either all
    or none of them have structural damping.
    """

    sections: tuple[TypicalSection, ...]

    @property
    def size(self) -> int:
        """Two degrees of freedom each."""
        return 2 * len(self.sections)

    @property
    def half_chord(self) -> float:
        """Half chord of all sections."""
        return self.sections[0].half_chord

    @property
    def highest_frequency(self) -> float:
        """No limit."""
        return math.inf

    @property
    def largest_decay(self) -> float:
        """No limit."""
        return math.inf

    @property
    def mass(self) -> Real:
        """Structural mass without air."""
        return self._mixed([section.mass for section in self.sections])

    def _mixed(self, blocks: list[Any]) -> Any:
        """Return blocks (..., 2, 2) on the diagonal, seen in turned coordinates."""
        n = self.size
        whole = np.zeros((*np.shape(blocks[0])[:-2], n, n), dtype=np.asarray(blocks[0]).dtype)
        for i, block in enumerate(blocks):
            whole[..., 2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = block
        turn = np.linalg.qr(np.random.default_rng(1).standard_normal((n, n)))[0]
        return turn.T @ whole @ turn

    def _pencil(self, parts: list[Pencil]) -> Pencil:
        T0, T1, T2 = zip(*parts, strict=True)
        linear = None if T1[0] is None else self._mixed(list(T1))
        return Pencil(self._mixed(list(T0)), linear, self._mixed(list(T2)))

    def pencil(self, p: Complex) -> Pencil:
        """Return T0, T1 and T2."""
        return self._pencil([section.pencil(p) for section in self.sections])

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the pencil and its derivative with respect to p."""
        both = [section.pencil_with_derivative(p) for section in self.sections]
        return self._pencil([v for v, _ in both]), self._pencil([d for _, d in both])

    def still_air(self) -> StillAir:
        """Return the sections at rest, with apparent mass."""
        parts = [section.still_air() for section in self.sections]
        mass, damping, stiffness = (
            self._mixed([getattr(part, name) for part in parts])
            for name in ("mass", "damping", "stiffness")
        )
        return StillAir(mass, damping, stiffness, np.arange(self.size), True)


@dataclass(frozen=True)
class ExponentialProblem:
    """[[3 + E, 2 + 2 x + E], [3 + E, -1 + x + E]] with E = exp(x/2).

    The determinant is -(3 + E)(3 + x): the roots are -3 and 2 ln 3 + 2 pi i (2 k + 1) for every
    integer k.
    """

    def value(self, z: Complex) -> Complex:
        """Return T at the points z."""
        E = np.exp(z / 2)
        return _two_by_two(3 + E, 2 + 2 * z + E, 3 + E, -1 + z + E)

    def derivative(self, z: Complex) -> Complex:
        """Return dT/dz at the points z."""
        e = np.exp(z / 2) / 2
        return _two_by_two(e, 2 + e, e, 1 + e)

    def exact_roots(self, highest: int) -> Complex:
        """Return -3 and the roots of |k| up to ``highest``."""
        odd = 2 * np.arange(-highest - 1, highest + 1) + 1
        return np.concatenate([[-3.0 + 0j], 2 * np.log(3.0) + 2j * np.pi * odd])


def _two_by_two(a: Complex, b: Complex, c: Complex, d: Complex) -> Complex:
    return np.moveaxis(np.array([[a, b], [c, d]]), -1, 0)
