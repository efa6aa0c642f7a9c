"""Several aerodynamic models that act on the same modes: a wing of one kind, a tail of another."""

from dataclasses import dataclass

import numpy as np

from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.schemes import TimeScheme
from foldwing.maths.arrays import Complex, Real


@dataclass(frozen=True)
class CombinedModel:
    """The sum of the forces of several models; obeys the port of aerodynamic models.

    Parameters
    ----------
    parts : tuple of AerodynamicModel
        One or more, for the same modes and with the same reference length; time derivatives are
        taken as the first one takes them.
    """

    parts: tuple[AerodynamicModel, ...]

    @property
    def size(self) -> int:
        """Number n of modes."""
        return self.parts[0].size

    @property
    def half_chord(self) -> float:
        """Reference length b of p in metres."""
        return self.parts[0].half_chord

    @property
    def highest_frequency(self) -> float:
        """Reduced frequency up to which every part holds."""
        return min(part.highest_frequency for part in self.parts)

    @property
    def largest_decay(self) -> float:
        """Decay -Re p up to which every part holds."""
        return min(part.largest_decay for part in self.parts)

    @property
    def scheme(self) -> TimeScheme:
        """How the first part takes time derivatives."""
        return self.parts[0].scheme

    def forces(self, p: Complex) -> Complex:
        """Return Qhat at the values ``p`` of shape (m,), as an array (m, n, n)."""
        return np.asarray(sum(part.forces(p) for part in self.parts))

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n)."""
        pairs = [part.forces_with_derivative(p) for part in self.parts]
        return np.asarray(sum(Q for Q, _ in pairs)), np.asarray(sum(dQ for _, dQ in pairs))

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""
        return np.asarray(sum(part.steady_forces() for part in self.parts))

    @property
    def has_apparent_mass(self) -> bool:
        """Whether the forces of every part include those of apparent mass."""
        return all(part.has_apparent_mass for part in self.parts)

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n)."""
        return np.asarray(sum(part.apparent_mass() for part in self.parts))
