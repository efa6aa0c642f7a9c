"""How a discrete-time lattice takes time derivatives.

Motions vary as z^n with z = exp(r dx) per step dt = dx / U, r = p / b = lambda / U. A scheme
replaces r where it stands for a derivative: in the normal wash and the unsteady load by ``rate``,
in the inertia of the structure by ``inertia``; the aerodynamic forces are divided by ``gain``. With
d = 2 (z - 1)/(z + 1)/dx and e = (1 - 1/z)/dx:

    exact     r, r^2, 1
    average   trapezoidal rule: d, d^2, 1
    literal   velocity at the end of the step, stiffness averaged: e, e^2/m, m = (1 + 1/z)/2

The literal scheme is that of I. Wang, PhD dissertation, Duke University, 2013, eqs. (A.19) and
(A.20); it adds artificial damping of omega dt / 4.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Complex


class Rates(NamedTuple):
    """What replaces r, r^2 and 1, each of shape (m,)."""

    rate: Complex
    inertia: Complex
    gain: Complex


@dataclass(frozen=True)
class TimeScheme:
    """A scheme with its step.

    Parameters
    ----------
    name : str
        ``exact``, ``average``, ``literal`` or ``printed`` (which takes derivatives as ``literal``).
    step : float
        dx, the way of the stream in one time step in metres.
    """

    name: str = "exact"
    step: float = 0.0

    def rates(self, r: Complex) -> Rates:
        """Return what replaces r = p / b in 1/m, r^2 and 1."""
        return self.rates_with_derivative(r)[0]

    def rates_with_derivative(self, r: Complex) -> tuple[Rates, Rates]:
        """Return what replaces r, r^2 and 1, and the derivatives with respect to r."""
        one, zero = np.ones_like(r), np.zeros_like(r)
        if self.name == "exact":
            return Rates(r, r**2, one), Rates(one, 2.0 * r, zero)
        z = np.exp(-r * self.step)  # the inverse of one step
        if self.name == "average":
            rate = 2.0 / self.step * (1.0 - z) / (1.0 + z)
            slope = 4.0 * z / (1.0 + z) ** 2
            return Rates(rate, rate**2, one), Rates(slope, 2.0 * rate * slope, zero)
        rate, mean = (1.0 - z) / self.step, (1.0 + z) / 2.0
        slope, mean_slope = z, -self.step / 2.0 * z
        inertia = rate**2 / mean
        inertia_slope = (2.0 * rate * slope - inertia * mean_slope) / mean
        return Rates(rate, inertia, mean), Rates(slope, inertia_slope, mean_slope)


EXACT = TimeScheme()
