"""Spanwise functions from which the component modes of a beam segment are made.

Two bases are offered for each motion. ``free-free`` is the classic one, the natural modes of a
uniform beam (clamped-free for the root segment, free-free for the others), orthogonal in mass and
stiffness but with no moment at their ends, so that a hinge converges slowly. ``converged`` is made
of Jacobi polynomials that satisfy only the clamp: complete at the ends as well, so that the natural
frequencies converge exponentially with their number.
"""

from dataclasses import dataclass
from functools import cache
from typing import Protocol

import numpy as np
from numpy.polynomial import Polynomial
from scipy.special import eval_jacobi

from foldwing.maths.arrays import Indices, Real
from foldwing.structure.component import Root


class SpanwiseFunctions(Protocol):
    """Functions f_j(y) on [0, length] with their first two derivatives."""

    @property
    def count(self) -> int:
        """Number n of functions."""

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""


@cache
def beam_wave_numbers(count: int, clamped: bool) -> tuple[float, ...]:
    """Return the first roots of cos(x) cosh(x) = -1 (clamped) or +1 (free-free, x > 0)."""
    sign = 1.0 if clamped else -1.0
    j = np.arange(1, count + 1)
    x = (j - 0.5) * np.pi if clamped else (j + 0.5) * np.pi
    for _ in range(8):
        sech = 1.0 / np.cosh(x)
        x = x + (np.cos(x) + sign * sech) / (np.sin(x) + sign * sech * np.tanh(x))
    return tuple(float(value) for value in x)


@dataclass(frozen=True)
class BeamBending:
    """Elastic bending modes of a uniform beam, integral of f^2 equal to its length.

    f = cosh + s cos - sigma (sinh + s sin) of beta y, with s = 1 free-free and s = -1 clamped-free.
    The hyperbolic part is written with decaying exponentials: the naive difference loses three
    digits by the tenth mode.
    """

    length: float
    count: int
    clamped: bool

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""
        L, s = self.length, (-1.0 if self.clamped else 1.0)
        X = np.array(beam_wave_numbers(self.count, self.clamped))
        beta = X / L
        decay = np.exp(-X)
        cos, sin = np.cos(X), np.sin(X)
        denominator = 1.0 - decay**2 - 2.0 * s * sin * decay
        sigma_short = 2.0 * decay * (s * (cos - sin) - decay) / denominator
        sigma = 1.0 - sigma_short
        z = np.multiply.outer(np.asarray(y, float), beta)
        growing = (s * (cos - sin) - decay) / denominator * np.exp(z - X)
        decaying = (1.0 + sigma) / 2.0 * np.exp(-z)
        # Each derivative turns the circular part a quarter and flips the sign of the decaying one.
        turned = z + 0.5 * np.pi * derivative
        circular = s * (np.cos(turned) - sigma * np.sin(turned))
        decaying = decaying * (-1.0) ** derivative
        return np.asarray(beta**derivative * (growing + decaying + circular))


@dataclass(frozen=True)
class BeamTorsion:
    """Elastic torsion modes of a uniform bar: sines (clamped-free) or cosines (free-free)."""

    length: float
    count: int
    clamped: bool

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""
        k = np.arange(1, self.count + 1)
        kappa = ((k - 0.5) if self.clamped else k) * np.pi / self.length
        phase = 0.5 * np.pi * derivative - (0.5 * np.pi if self.clamped else 0.0)
        argument = np.multiply.outer(np.asarray(y, float), kappa) + phase
        return np.asarray(kappa**derivative * np.cos(argument))


@dataclass(frozen=True)
class Monomials:
    """Rigid motions of a free segment: powers of y up to ``count - 1`` (translation, rotation)."""

    length: float
    count: int

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""
        s = np.asarray(y, float) / self.length
        rows = [Polynomial.basis(j).deriv(derivative)(s) for j in range(self.count)]
        return np.stack(rows, axis=-1) / self.length**derivative


@dataclass(frozen=True)
class JacobiFunctions:
    """s^root P_j^(0, 2 root)(2 s - 1) with s = y / length: orthogonal, zero to order ``root`` at 0.

    ``root`` = 0 gives Legendre polynomials (free segment), 1 a clamped twist, 2 a clamped bending.
    """

    length: float
    count: int
    root: int

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""
        r, L = self.root, self.length
        s = np.asarray(y, float)[:, None] / L
        j = np.arange(self.count)
        total = np.zeros((len(s), self.count))
        for order in range(derivative + 1):
            power = derivative - order
            if power > r:
                continue
            factor = np.prod([r - i for i in range(power)]) * s ** (r - power)
            binomial = (1, derivative, 1)[order] if derivative == 2 else 1
            total += binomial * factor * _jacobi_derivative(s, j, 2 * r, order)
        return total / L**derivative


def _jacobi_derivative(s: Real, j: Indices, b: int, order: int) -> Real:
    """d^order/ds^order of P_j^(0, b)(2 s - 1)."""
    rising = np.ones(len(j))
    for i in range(1, order + 1):
        rising = rising * (j + b + i)
    lower = np.maximum(j - order, 0)
    value = rising * eval_jacobi(lower, order, b + order, 2.0 * s - 1.0)
    return np.where(j >= order, value, 0.0)


@dataclass(frozen=True)
class Joined:
    """Several families of functions side by side."""

    families: tuple[SpanwiseFunctions, ...]

    @property
    def count(self) -> int:
        """Number of functions of all families."""
        return sum(family.count for family in self.families)

    def evaluate(self, y: Real, derivative: int) -> Real:
        """Return the derivative of order 0, 1 or 2 at ``y`` (m,) as an array (m, n)."""
        return np.hstack([family.evaluate(y, derivative) for family in self.families])


def bending_functions(length: float, count: int, root: Root, basis: str) -> SpanwiseFunctions:
    """Return the plunge functions of a segment.

    A clamped segment has ``count`` elastic functions; one on a carriage has its translation on top
    of them, a free one its translation on top of ``count`` others (the rotation about the hinge and
    ``count - 1`` elastic ones).
    """
    if root is Root.FREE:
        if basis == "converged":
            return JacobiFunctions(length, count + 1, 0)
        return Joined((Monomials(length, 2), BeamBending(length, count - 1, clamped=False)))
    elastic: SpanwiseFunctions = BeamBending(length, count, clamped=True)
    if basis == "converged":
        elastic = JacobiFunctions(length, count, 2)
    return elastic if root is Root.CLAMPED else Joined((Monomials(length, 1), elastic))


def torsion_functions(length: float, count: int, root: Root, basis: str) -> SpanwiseFunctions:
    """Return the twist functions of a segment: ``count``, one of them rigid unless clamped."""
    clamped = root is Root.CLAMPED
    if basis == "converged":
        return JacobiFunctions(length, count, 1 if clamped else 0)
    if clamped:
        return BeamTorsion(length, count, clamped=True)
    return Joined((Monomials(length, 1), BeamTorsion(length, count - 1, clamped=False)))
