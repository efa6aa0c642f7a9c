"""The aeroelastic problem of a wing: structural modes in an airstream, T(p; U) x = 0.

With unit modal mass, natural frequencies omega and structural damping ratio zeta,

    T(p, U) = diag(omega^2) + U (p/b) diag(2 zeta omega) - U^2 B(p),    B = Qhat(p) - (p/b)^2 I.

The steady lift that carries an aircraft adds forces Qhat_0(p) that do not depend on the airspeed
(the lift is the weight at every U): T gains -Qhat_0(p).

A discrete-time aerodynamic model replaces p and (p/b)^2 where they stand for time derivatives
(`foldwing.aerodynamics.schemes`). Rows and columns are divided by omega, so that all entries are of
order one. Without Qhat_0 a mode without stiffness has no constant term: its column is divided by
U^2. A *neutral* motion, without stiffness and without steady aerodynamic force (a free flap, the
translations of an aircraft), is an exact zero root at every airspeed: it is rotated to stand apart
and its column is divided by p as well, so that T keeps only the other roots.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.combined import CombinedModel
from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.schemes import Rates
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
    trim_forces : AerodynamicModel, optional
        Gives Qhat_0 in place of Qhat.
    divided : bool
        Whether columns of motions without stiffness are divided as said above. The p-k method wants
        them whole.
    """

    omega: Real
    aerodynamics: AerodynamicModel
    damping: float = 0.0
    trim_forces: AerodynamicModel | None = None
    divided: bool = True

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

        It mixes rigid motions only, with the neutral ones last among them, and only where more than
        one of them feels a steady force.
        """
        V = np.eye(self.size)
        steady = self.aerodynamics.steady_forces()[:, self.rigid]
        if self._is_felt(steady).sum() > 1:
            _, _, Vh = np.linalg.svd(steady)
            V[np.ix_(self.rigid, self.rigid)] = Vh.T
        return V

    def _is_felt(self, steady: Real) -> Mask:
        """Return which columns of steady forces are more than round-off."""
        typical = float(np.linalg.norm(self.aerodynamics.forces(np.array([1j]))[0], 2))
        return np.asarray(np.linalg.norm(steady, axis=0) >= NEUTRAL_TOLERANCE * typical)

    @cached_property
    def _is_rotated(self) -> bool:
        return not np.array_equal(self.rotation, np.eye(self.size))

    @cached_property
    def neutral(self) -> Mask:
        """Which columns of T are neutral motions: exact zero roots at every airspeed."""
        steady = self.aerodynamics.steady_forces() @ self.rotation
        return np.asarray(self.rigid & ~self._is_felt(steady))

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
        minus_B = self._inertia_less(self.aerodynamics.forces(p), rates)
        damping = None if self._damping is None else _stacked(rates.rate) * self._damping
        if not self.rigid.any() or (self.trim_forces is None and not self.divided):
            return Pencil(self._stiffness, damping, minus_B)
        if self.trim_forces is not None:
            constant = self._stiffness + self._in_coordinates(self.trim_forces.forces(p), 0.0)
            for part in (constant, minus_B) if self.divided else ():
                part[:, :, self.neutral] /= p[:, None, None]
            return Pencil(constant, damping, minus_B)
        constant = np.where(self.rigid, minus_B, self._stiffness)
        constant[:, :, self.neutral] /= p[:, None, None]
        return Pencil(constant, damping, np.where(self.rigid, 0.0, minus_B))

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the coefficients of T and their derivatives with respect to p."""
        p = np.asarray(p, complex)
        b = self.half_chord
        rates, slopes = self.aerodynamics.scheme.rates_with_derivative(p / b)
        Q, dQ = self.aerodynamics.forces_with_derivative(p)
        minus_B = self._inertia_less(Q, rates)
        slope = self._in_coordinates(dQ, _stacked(slopes.inertia) / b)
        damping, damping_slope = None, None
        if self._damping is not None:
            damping = _stacked(rates.rate) * self._damping
            damping_slope = _stacked(slopes.rate) / b * self._damping
        if not self.rigid.any() or (self.trim_forces is None and not self.divided):
            zero = np.zeros_like(self._stiffness)
            return Pencil(self._stiffness, damping, minus_B), Pencil(zero, damping_slope, slope)
        if self.trim_forces is None:
            return self._with_rigid_columns(p, (minus_B, slope), (damping, damping_slope))
        Q, dQ = self.trim_forces.forces_with_derivative(p)
        constant = self._stiffness + self._in_coordinates(Q, 0.0)
        constant_slope = self._in_coordinates(dQ, 0.0)
        if self.divided:
            self._divide_neutral(p, constant, constant_slope)
            self._divide_neutral(p, minus_B, slope)
        return Pencil(constant, damping, minus_B), Pencil(constant_slope, damping_slope, slope)

    def _divide_neutral(self, p: Complex, part: Complex, slope: Complex) -> None:
        """Divide the columns of neutral motions by p, in a matrix and its derivative."""
        neutral = self.neutral
        part[:, :, neutral] /= p[:, None, None]
        slope[:, :, neutral] = (slope[:, :, neutral] - part[:, :, neutral]) / p[:, None, None]

    def _inertia_less(self, forces: Complex, rates: Rates) -> Complex:
        """Return inertia less forces, those on neutral motions at p = 0 exactly zero.

        What round-off leaves of them would be magnified when their columns are divided by p.
        """
        result = self._in_coordinates(forces, _stacked(rates.inertia))
        if self.neutral.any():
            result[:, :, self.neutral] += self._round_off
        return result

    @cached_property
    def _round_off(self) -> Real:
        """Steady forces of neutral motions in the coordinates of T, shape (n, neutral)."""
        steady = self.rotation.T @ self.aerodynamics.steady_forces() @ self.rotation
        return np.asarray((self._scaling * steady)[:, self.neutral])

    def _in_coordinates(self, forces: Complex, inertia: Complex | float) -> Complex:
        """Return ``inertia`` times the mass less the forces, in the coordinates of T."""
        if self._is_rotated:
            forces = self.rotation.T @ forces @ self.rotation
        return np.asarray(inertia * self.mass - self._scaling * forces)

    def _with_rigid_columns(
        self,
        p: Complex,
        inertia_less_forces: tuple[Complex, Complex],
        damping: tuple[Complex | None, Complex | None],
    ) -> tuple[Pencil, Pencil]:
        """Move the columns of rigid motions to the constant term, divided by p if neutral."""
        rigid = self.rigid
        minus_B, slope = inertia_less_forces
        constant = np.where(rigid, minus_B, self._stiffness)
        constant_slope = np.where(rigid, slope, 0.0)
        self._divide_neutral(p, constant, constant_slope)
        return (
            Pencil(constant, damping[0], np.where(rigid, 0.0, minus_B)),
            Pencil(constant_slope, damping[1], np.where(rigid, 0.0, slope)),
        )

    @property
    def whole(self) -> "AeroelasticSystem":
        """The same problem with no column divided, as the p-k method wants it."""
        return replace(self, divided=False)

    def partly_carried(self, speed: float) -> "AeroelasticSystem":
        """Return the problem of an aircraft too slow to carry its weight, below ``speed`` in m/s.

        Its steady lift grows with U^2 and is the weight at ``speed``, where the problem passes into
        this one; at rest it is that of still air.
        """
        if self.trim_forces is None:
            return self
        lifted = CombinedModel((self.aerodynamics, self.trim_forces), (1.0, speed**-2))
        return replace(self, aerodynamics=lifted, trim_forces=None)

    def modal_vectors(self, p: Complex, speed: Real, x: Complex) -> Complex:
        """Return null vectors x of T (m, n) as modal coordinates q of unit 2-norm, shape (m, n)."""
        moved = self.rigid & (self.divided and self.trim_forces is None)
        factor = np.where(moved, 1.0 / speed[:, None] ** 2, 1.0)
        factor = factor * np.where(self.neutral & self.divided, 1.0 / p[:, None], 1.0)
        q = (x * factor * self.scale) @ self.rotation.T
        return np.asarray(q / np.linalg.norm(q, axis=1, keepdims=True))

    def still_air(self) -> StillAir:
        """Return the problem at U = 0 over the elastic modes, with apparent mass if it exists."""
        elastic = np.flatnonzero(~self.rigid)
        block, s = np.ix_(elastic, elastic), self.scale[elastic]
        mass = np.eye(self.size) + self.aerodynamics.apparent_mass()
        return StillAir(
            mass=mass[block] * np.outer(s, s),
            damping=np.diag(2.0 * self.damping * s),
            stiffness=np.eye(len(elastic)),
            columns=elastic,
            apparent_mass=self.aerodynamics.has_apparent_mass,
        )


def _stacked(values: Complex) -> Complex:
    """Return m numbers as factors of m matrices."""
    return values[:, None, None]
