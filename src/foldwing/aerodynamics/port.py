"""The port that every aerodynamic model obeys."""

from typing import Protocol

from foldwing.aerodynamics.schemes import TimeScheme
from foldwing.maths.arrays import Complex, Real


class AerodynamicModel(Protocol):
    """Generalized aerodynamic forces F = U^2 Qhat(p) q of n modes.

    Qhat depends on the reduced Laplace variable p = lambda b / U only, so that one model serves
    every airspeed. The density of the air is part of it.
    """

    @property
    def size(self) -> int:
        """Number n of modes."""

    @property
    def half_chord(self) -> float:
        """Reference length b of p in metres."""

    @property
    def highest_frequency(self) -> float:
        """Reduced frequency Im p up to which the model holds; infinite without a limit."""

    @property
    def largest_decay(self) -> float:
        """Decay -Re p up to which the model holds; infinite without a limit."""

    @property
    def scheme(self) -> TimeScheme:
        """How time derivatives are taken, by the structure too: exact in continuous time."""

    def forces(self, p: Complex) -> Complex:
        """Return Qhat at the values ``p`` of shape (m,), as an array (m, n, n)."""

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n)."""

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""

    @property
    def has_apparent_mass(self) -> bool:
        """Whether all forces include those of apparent mass."""

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n), to be added to the mass."""
