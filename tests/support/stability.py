"""Shipped wings as stability problems, and a plain count of their unstable roots."""

from functools import cache

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.problem import Pencil


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


class UnstableRoots:
    """Roots beyond the damping threshold, by the plain argument principle on det T.

    The contour is half of a D, the other half being its mirror image: up the ray p = k (i - zeta)
    and back to the real axis along an ellipse. A step is bisected while its phase turns by 0.8 rad
    or the logarithmic derivative tr(T^-1 dT/dp) at either end lets it turn by 0.8 rad: a root
    beside the contour is felt before the contour has stepped past it.
    """

    def __init__(self, problem, highest, threshold=0.0, points=200):
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
