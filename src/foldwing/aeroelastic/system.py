"""The aeroelastic problem of a wing: structural modes in an airstream, T(p; U) x = 0.

With unit modal mass, natural frequencies omega and structural damping ratio zeta,

    T(p, U) = diag(omega^2) + U (p/b) diag(2 zeta omega) - U^2 B(p),    B = Qhat(p) - (p/b)^2 I.

A discrete-time aerodynamic model replaces p and (p/b)^2 where they stand for time derivatives
(`foldwing.aerodynamics.schemes`). Rows and columns are divided by omega, so that all entries are of
order one. A mode without stiffness has no constant term: its column is divided by U^2. A *neutral*
motion, without stiffness and without steady aerodynamic force (a free flap), is an exact zero root
at every airspeed: it is rotated to stand apart and its column is divided by p as well, so that T
keeps only the other roots.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.maths.arrays import Complex, Mask, Real
from foldwing.stability.problem import Pencil, StillAir

NEUTRAL_TOLERANCE = 1e-9
"""Steady force of a rigid motion, relative to forces at p = i, below which it is neutral."""


@dataclass(frozen=True)
class AeroelasticSystem:
    """Structural modes and one aerodynamic model; obeys the port of the stability solvers.

    Parameters
    ----------
    omega : array, shape (n,)
        Natural frequencies in rad/s; zero for rigid motions.
    aerodynamics : AerodynamicModel
        For the same n modes, of unit modal mass.
    damping : float
        Structural damping ratio zeta.
    """

    omega: Real
    aerodynamics: AerodynamicModel
    damping: float = 0.0

    @property
    def size(self) -> int:
        """Number n of modes."""
        return len(self.omega)

    @property
    def half_chord(self) -> float:
        """Reference length b of p = lambda b / U in metres."""
        return self.aerodynamics.half_chord

    @property
    def highest_frequency(self) -> float:
        """Reduced frequency up to which the aerodynamic model holds."""
        return self.aerodynamics.highest_frequency

    @property
    def largest_decay(self) -> float:
        """Decay -Re p up to which the aerodynamic model holds."""
        return self.aerodynamics.largest_decay

    @cached_property
    def rigid(self) -> Mask:
        """Which modes have no stiffness."""
        return np.asarray(self.omega == 0.0)

    @cached_property
    def rotation(self) -> Real:
        """Orthogonal (n, n) matrix whose columns are the coordinates of T in modal coordinates.

        It mixes rigid motions only, with the neutral ones last among them.
        """
        V = np.eye(self.size)
        if self.rigid.any():
            steady = self.aerodynamics.steady_forces()[:, self.rigid]
            _, _, Vh = np.linalg.svd(steady)
            V[np.ix_(self.rigid, self.rigid)] = Vh.T
        return V

    @cached_property
    def neutral(self) -> Mask:
        """Which columns of T are neutral motions: exact zero roots at every airspeed."""
        steady = self.aerodynamics.steady_forces()
        size = np.linalg.norm(steady @ self.rotation, axis=0)
        typical = float(np.linalg.norm(self.aerodynamics.forces(np.array([1j]))[0], 2))
        return np.asarray(self.rigid & (size < NEUTRAL_TOLERANCE * typical))

    @cached_property
    def scale(self) -> Real:
        """Factor 1/omega of rows and columns; that of the lowest elastic mode for rigid ones."""
        elastic = self.omega[~self.rigid]
        lowest = elastic[0] if len(elastic) else 1.0
        return np.asarray(1.0 / np.where(self.rigid, lowest, self.omega))

    @cached_property
    def mass(self) -> Real:
        """Structural mass in the coordinates of T, shape (n, n)."""
        return np.diag(self.scale**2)

    @cached_property
    def _scaling(self) -> Real:
        return np.outer(self.scale, self.scale)

    @cached_property
    def _stiffness(self) -> Complex:
        return np.diag(np.where(self.rigid, 0.0, 1.0)).astype(complex)

    @cached_property
    def _damping(self) -> Real | None:
        if self.damping == 0.0:
            return None
        return np.diag(np.where(self.rigid, 0.0, 2.0 * self.damping * self.scale))

    def pencil(self, p: Complex) -> Pencil:
        """Return the coefficients of T at the values ``p``, shape (m,)."""
        p = np.asarray(p, complex)
        rates = self.aerodynamics.scheme.rates(p / self.half_chord)
        minus_B = self._in_coordinates(self.aerodynamics.forces(p), _stacked(rates.inertia))
        damping = None if self._damping is None else _stacked(rates.rate) * self._damping
        if not self.rigid.any():
            return Pencil(self._stiffness, damping, minus_B)
        constant = np.where(self.rigid, minus_B, self._stiffness)
        constant[:, :, self.neutral] /= p[:, None, None]
        return Pencil(constant, damping, np.where(self.rigid, 0.0, minus_B))

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the coefficients of T and their derivatives with respect to p."""
        p = np.asarray(p, complex)
        b = self.half_chord
        rates, slopes = self.aerodynamics.scheme.rates_with_derivative(p / b)
        Q, dQ = self.aerodynamics.forces_with_derivative(p)
        minus_B = self._in_coordinates(Q, _stacked(rates.inertia))
        slope = self._in_coordinates(dQ, _stacked(slopes.inertia) / b)
        damping, damping_slope = None, None
        if self._damping is not None:
            damping = _stacked(rates.rate) * self._damping
            damping_slope = _stacked(slopes.rate) / b * self._damping
        if self.rigid.any():
            return self._with_rigid_columns(p, (minus_B, slope), (damping, damping_slope))
        zero = np.zeros_like(self._stiffness)
        return Pencil(self._stiffness, damping, minus_B), Pencil(zero, damping_slope, slope)

    def _in_coordinates(self, forces: Complex, inertia: Complex) -> Complex:
        """Return ``inertia`` times the mass less the forces, in the coordinates of T."""
        if self.rigid.any():
            forces = self.rotation.T @ forces @ self.rotation
        return np.asarray(inertia * self.mass - self._scaling * forces)

    def _with_rigid_columns(
        self,
        p: Complex,
        inertia_less_forces: tuple[Complex, Complex],
        damping: tuple[Complex | None, Complex | None],
    ) -> tuple[Pencil, Pencil]:
        """Move the columns of rigid motions to the constant term, divided by p if neutral."""
        rigid, neutral = self.rigid, self.neutral
        minus_B, slope = inertia_less_forces
        constant = np.where(rigid, minus_B, self._stiffness)
        constant_slope = np.where(rigid, slope, 0.0)
        divided = constant[:, :, neutral] / p[:, None, None]
        constant[:, :, neutral] = divided
        constant_slope[:, :, neutral] = (constant_slope[:, :, neutral] - divided) / p[:, None, None]
        return (
            Pencil(constant, damping[0], np.where(rigid, 0.0, minus_B)),
            Pencil(constant_slope, damping[1], np.where(rigid, 0.0, slope)),
        )

    def modal_vectors(self, p: Complex, speed: Real, x: Complex) -> Complex:
        """Return null vectors x of T (m, n) as modal coordinates q of unit 2-norm, shape (m, n)."""
        factor = np.where(self.rigid, 1.0 / speed[:, None] ** 2, 1.0)
        factor = factor * np.where(self.neutral, 1.0 / p[:, None], 1.0)
        q = (x * factor * self.scale) @ self.rotation.T
        return np.asarray(q / np.linalg.norm(q, axis=1, keepdims=True))

    def still_air(self) -> StillAir:
        """Return the problem at U = 0 over the elastic modes, with apparent mass if it exists."""
        elastic = np.flatnonzero(~self.rigid)
        block, s = np.ix_(elastic, elastic), self.scale[elastic]
        apparent = self.aerodynamics.apparent_mass()
        mass = np.eye(self.size) + (0.0 if apparent is None else apparent)
        return StillAir(
            mass=mass[block] * np.outer(s, s),
            damping=np.diag(2.0 * self.damping * s),
            stiffness=np.eye(len(elastic)),
            columns=elastic,
            apparent_mass=apparent is not None,
        )


def _stacked(values: Complex) -> Complex:
    """Return m numbers as factors of m matrices."""
    return values[:, None, None]
