"""What the stability solvers see: a matrix function T(p; U), never a wing.

An aeroelastic problem of size n is, at reduced Laplace variable p = lambda b / U and airspeed U,

    T(p, U) = T0(p) + U T1(p) + U^2 T2(p),        T(p, U) x = 0,

so that at fixed p it is a quadratic pencil in U (linear in U^2 without structural damping). All
solvers are written against this one form.
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from foldwing.maths.arrays import Complex, Indices, Real


class Pencil(NamedTuple):
    """Coefficients of T(p, U) in powers of U at m values of p.

    Attributes
    ----------
    constant : array, shape (n, n) or (m, n, n)
        T0. Two-dimensional when it does not depend on p.
    linear : array, shape (m, n, n), or None
        T1; None without structural damping.
    quadratic : array, shape (m, n, n)
        T2.
    """

    constant: Complex
    linear: Complex | None
    quadratic: Complex


@dataclass(frozen=True)
class StillAir:
    """The problem at rest: (lambda^2 mass + lambda damping + stiffness) x = 0.

    Attributes
    ----------
    mass, damping, stiffness : array, shape (m, m)
        Over the modes that have stiffness (neutral and rigid modes left out).
    columns : array of int, shape (m,)
        Which columns of T these modes are.
    apparent_mass : bool
        Whether ``mass`` holds the apparent mass of the air (else in vacuo).
    """

    mass: Real
    damping: Real
    stiffness: Real
    columns: Indices
    apparent_mass: bool


class AeroelasticProblem(Protocol):
    """The port between the physics and the stability solvers."""

    @property
    def size(self) -> int:
        """Number n of generalized coordinates."""

    @property
    def half_chord(self) -> float:
        """Reference length b of p = lambda b / U in metres."""

    @property
    def highest_frequency(self) -> float:
        """Reduced frequency Im p up to which T is meaningful; infinite without a limit."""

    @property
    def largest_decay(self) -> float:
        """Decay -Re p up to which T is meaningful; infinite without a limit."""

    def pencil(self, p: Complex) -> Pencil:
        """Return the coefficients of T at the values ``p``, shape (m,)."""

    def pencil_with_derivative(self, p: Complex) -> tuple[Pencil, Pencil]:
        """Return the coefficients of T and their derivatives with respect to p.

        In the derivative ``constant`` has shape (m, n, n) or is all zero with shape (n, n).
        """

    def still_air(self) -> StillAir:
        """Return the problem at U = 0."""


class Evaluation(NamedTuple):
    """T and its partial derivatives at m pairs (p, U), each of shape (m, n, n)."""

    value: Complex
    by_p: Complex
    by_speed: Complex


def _column(speed: Real) -> Real:
    return speed[:, None, None]


def evaluate(problem: AeroelasticProblem, p: Complex, speed: Real) -> Complex:
    """Return T(p, U) for m pairs, shape (m, n, n)."""
    T0, T1, T2 = problem.pencil(p)
    U = _column(speed)
    T = T0 + U**2 * T2
    return T if T1 is None else T + U * T1


def evaluate_with_derivatives(problem: AeroelasticProblem, p: Complex, speed: Real) -> Evaluation:
    """Return T, dT/dp at fixed U and dT/dU at fixed p for m pairs (p, U)."""
    (T0, T1, T2), (dT0, dT1, dT2) = problem.pencil_with_derivative(p)
    U = _column(speed)
    T = T0 + U**2 * T2
    T_p = dT0 + U**2 * dT2
    T_U = 2 * U * T2
    if T1 is not None and dT1 is not None:
        T, T_p, T_U = T + U * T1, T_p + U * dT1, T_U + T1
    return Evaluation(T, T_p, T_U)
