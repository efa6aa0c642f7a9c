"""Several aerodynamic models that act on the same modes: a wing of one kind, a tail of another."""

from collections.abc import Iterator
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
    weights : tuple of float
        What each part is multiplied by; one by default.
    """

    parts: tuple[AerodynamicModel, ...]
    weights: tuple[float, ...] = ()

    @property
    def _weighted(self) -> Iterator[tuple[float, AerodynamicModel]]:
        return zip(self.weights or (1.0,) * len(self.parts), self.parts, strict=True)

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
        return np.asarray(sum(w * part.forces(p) for w, part in self._weighted))

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n)."""
        pairs = [(w, *part.forces_with_derivative(p)) for w, part in self._weighted]
        return (
            np.asarray(sum(w * Q for w, Q, _ in pairs)),
            np.asarray(sum(w * dQ for w, _, dQ in pairs)),
        )

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""
        return np.asarray(sum(w * part.steady_forces() for w, part in self._weighted))

    @property
    def has_apparent_mass(self) -> bool:
        """Whether the forces of every part include those of apparent mass."""
        return all(part.has_apparent_mass for part in self.parts)

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n)."""
        return np.asarray(sum(w * part.apparent_mass() for w, part in self._weighted))
