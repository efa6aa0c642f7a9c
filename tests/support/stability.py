"""Wings as stability problems, problems with exact roots, a plain count of unstable roots."""

import math
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import scipy.optimize
from numpy.polynomial import polynomial

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Hinge, read_model
from foldwing.stability.problem import Pencil, StillAir, evaluate


@cache
def example_wing(name):
    """Shipped model with what all its fold angles share."""
    return AeroelasticWing(read_model(name))


@cache
def example_modes(name, *folds):
    """Natural modes of a shipped model at fold angles in degrees."""
    return example_wing(name).modes(tuple(np.radians(folds)))


@cache
def example(name, *folds):
    """Aeroelastic system of a shipped model at fold angles in degrees."""
    return example_wing(name).system(example_modes(name, *folds))


@cache
def with_other_hinges(name, hinges, *folds):
    """Aeroelastic system of a shipped model with other hinge stiffnesses, None for a free hinge."""
    wing = example_wing(name).wing
    new = tuple(
        old if k == "same" else Hinge(kind="free") if k is None else Hinge(stiffness=k)
        for old, k in zip(wing.hinges, hinges, strict=True)
    )
    model = AeroelasticWing(wing.model_copy(update={"hinges": new}))
    return model.system(model.modes(tuple(np.radians(folds))))


def determinant(problem, p, speed):
    """Return det T at one pair (p, U)."""
    return complex(np.linalg.det(evaluate(problem, np.array([p], complex), np.array([speed])))[0])


def exact_root(problem, p, speed):
    """Return the root of det T near p by the secant method, which uses no derivative of T."""
    size = determinant(problem, p * 1.1, speed)
    return scipy.optimize.newton(
        lambda z: determinant(problem, z, speed) / size, p, x1=p * (1 + 1e-4), tol=1e-14
    )


@dataclass(frozen=True)
class Polynomials:
    """1 + U g_j p + U^2 q_j(p) = 0 for each j, in turned coordinates that hide which is which.

    The roots at every airspeed are those of scalar polynomials in p.

    Attributes
    ----------
    quadratic : tuple of tuple of float
        Coefficients of each q_j, of 1 first.
    linear : tuple of float
        g_j; empty when there is no term in U.
    """

    quadratic: tuple
    linear: tuple = ()
    half_chord: float = 1.0
    highest_frequency: float = math.inf
    largest_decay: float = math.inf

    @property
    def size(self):
        """One coordinate for each polynomial."""
        return len(self.quadratic)

    @cached_property
    def _turn(self):
        return np.linalg.qr(np.random.default_rng(3).standard_normal((self.size, self.size)))[0]

    def _mixed(self, diagonals):
        return np.einsum("ji,mj,jk->mik", self._turn, diagonals, self._turn).astype(complex)

    def pencil(self, p):
        """Return T0, T1 and T2."""
        return self.pencil_with_derivative(p)[0]

    def pencil_with_derivative(self, p):
        """Return the pencil and its derivative with respect to p."""
        T2 = [polynomial.polyval(p, q) for q in self.quadratic]
        dT2 = [polynomial.polyval(p, polynomial.polyder(q)) for q in self.quadratic]
        T1 = dT1 = None
        if self.linear:
            T1, dT1 = (self._mixed(np.outer(z, self.linear)) for z in (p, np.ones_like(p)))
        one = np.eye(self.size, dtype=complex)
        value = Pencil(one, T1, self._mixed(np.stack(T2, axis=1)))
        return value, Pencil(0 * one, dT1, self._mixed(np.stack(dT2, axis=1)))

    def still_air(self):
        """Return the inertia p^2 and the unit stiffness."""
        mass = self._mixed(np.array([[q[2] for q in self.quadratic]]))[0].real
        every = np.arange(self.size)
        return StillAir(mass, 0 * mass, np.eye(self.size), every, apparent_mass=True)

    def roots(self, speed):
        """Return every exact root p at one airspeed."""
        found = []
        for j, q in enumerate(self.quadratic):
            whole = speed**2 * np.array(q, float)
            whole[:2] += 1.0, speed * self.linear[j] if self.linear else 0.0
            found.append(polynomial.polyroots(whole))
        return np.concatenate(found)


class UnstableRoots:
    """Roots beyond the damping threshold, by the plain argument principle on det T.

    The contour is half of a D, the other half being its mirror image: up the ray p = k (i - zeta)
    and back to the real axis along an ellipse. A step is bisected while its phase turns by 0.8 rad
    or the logarithmic derivative tr(T^-1 dT/dp) at either end lets it turn by 0.8 rad: a root
    beside the contour is felt before the contour has stepped past it.
    """

    def __init__(self, problem, highest, threshold=0.0, points=250):
        self.problem, self.ray, self.highest = problem, 1j - threshold, highest
        self.right = 4.0 + abs(threshold) * highest
        self.t = np.linspace(0.0, 2.0, points)
        self.base = self._pencils(self.t)

    def contour(self, t):
        """Return p, from nearly 0 at t = 0 by the end of the ray at 1 to the real axis at 2."""
        along = 1e-7 * (self.highest / 1e-7) ** np.minimum(t, 1.0) * self.ray
        angle = np.pi / 2 * np.sin(np.pi / 2 * np.maximum(t - 1.0, 0.0))
        end = self.highest * self.ray
        arc = self.right * np.sin(angle) + end.real * np.cos(angle)
        p = np.where(t <= 1.0, along, arc + 1j * self.highest * np.cos(angle))
        return np.where(t == 0.0, 1e-7, np.where(t == 2.0, self.right, p))

    def _pencils(self, t):
        p = self.contour(t)
        return p, *self.problem.pencil_with_derivative(p)

    def _values(self, pencils, speed):
        """Return p, the phase of det T and d(log det T)/dp."""
        p, value, slope = pencils
        T, dT = (A + speed * (0.0 if B is None else B) + speed**2 * C for A, B, C in (value, slope))
        rate = np.trace(np.linalg.solve(T, np.broadcast_to(dT, T.shape)), axis1=1, axis2=2)
        return p, np.linalg.slogdet(T)[0], rate

    def at(self, speed):
        """Return the count at one airspeed; an AssertionError when it does not settle."""
        t, (p, phase, rate) = self.t, self._values(self.base, speed)
        for _ in range(25):
            turn = np.angle(phase[1:] / phase[:-1])
            change = np.abs(np.diff(p)) * np.maximum(np.abs(rate[1:]), np.abs(rate[:-1]))
            wide = np.flatnonzero(np.maximum(np.abs(turn), change) > 0.8)
            if not len(wide):
                halves = -turn.sum() / np.pi
                assert abs(halves - round(halves)) < 1e-6
                return round(halves)
            middle = (t[wide] + t[wide + 1]) / 2
            added = self._values(self._pencils(middle), speed)
            t = np.insert(t, wide + 1, middle)
            p, phase, rate = (
                np.insert(old, wide + 1, new)
                for old, new in zip((p, phase, rate), added, strict=True)
            )
        raise AssertionError("the phase does not settle")


def unstable_by(points, speed, at_first):
    """Return the number of unstable roots that a list of flutter points implies at a speed."""
    size = {"flutter": 2, "divergence": 1}
    sign = {"onset": 1, "recovery": -1, "merger": 0}
    below = [point for point in points if point.speed < speed]
    return at_first + sum(size[point.kind] * sign[point.event] for point in below)


def of_kind(analysis, kind):
    """Return the flutter points of one kind."""
    return [point for point in analysis.points if point.kind == kind]
