"""Where eigenvalues cross the stability boundary, from a path of inverse speeds along it."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.newton import Roots, polish_crossings, roots_at
from foldwing.stability.path import EigenvaluePath, follow_path, refined
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.region import SMALLEST, Region

ROUND_OFF = 1e-10
"""Square of the ratio of airspeeds beyond which an inverse speed is round-off of the largest."""

SAME_POINT = 1e-7
"""Relative difference in U and k below which two flutter points are one."""

LEAST_FREQUENCY = 1e-9
"""Reduced frequency below which a crossing is divergence, found at p = 0 instead."""

BESIDE_ZERO = LEAST_FREQUENCY
"""Real p at which the direction of a divergence root is taken: it may change its sign at smaller p,
where an oscillating root crosses whose frequency is below the least."""

HALVINGS = 30
"""Most times that a step is halved in search of the crossing that it holds."""


@dataclass(frozen=True)
class Crossings:
    """Where eigenvalues cross the stability boundary, ascending in airspeed.

    Attributes
    ----------
    roots : Roots
        Converged points; ``p_by_speed`` tells their direction.
    divergence : array of bool, shape (m,)
        Whether the root crosses at p = 0.
    onset : array of bool, shape (m,)
        Whether it becomes unstable as the airspeed grows.
    """

    roots: Roots
    divergence: Mask
    onset: Mask

    @property
    def speed(self) -> Real:
        """Airspeeds in m/s, shape (m,)."""
        return self.roots.speed

    @property
    def jump(self) -> Indices:
        """Change of the number of unstable roots: +-2 for flutter, +-1 for divergence."""
        size = np.where(self.divergence, 1, 2)
        return np.where(self.onset, size, -size)


def directed(flutter: Roots, divergence: Roots, region: Region) -> Crossings:
    """Join flutter and divergence roots and tell onsets from recoveries."""
    outward = flutter.p_by_speed.real + region.threshold * flutter.p_by_speed.imag
    growing = np.concatenate([outward > 0.0, divergence.p_by_speed.real > 0.0])
    kind = np.repeat([False, True], [len(flutter.p), len(divergence.p)])
    roots = Roots(*(np.concatenate(pair) for pair in zip(flutter, divergence, strict=True)))
    order = np.argsort(roots.speed)
    return Crossings(roots.take(order), kind[order], growing[order])


def on_ray(path: EigenvaluePath, region: Region) -> slice:
    """Return the points of the path on the threshold ray (all but the real starting point)."""
    end = int(np.searchsorted(path.parameter, np.log(region.highest) + 1e-9))
    return slice(1, end)


def in_range(path: EigenvaluePath, inverse: Complex, speed_range: tuple[float, float]) -> Mask:
    """Return which inverse speeds may belong to an airspeed of the range, with a margin."""
    slow, fast = speed_range
    size = np.abs(inverse)
    wide = (size > 1.0 / path.measure(2.0 * fast)) & (size < 1.0 / path.measure(slow / 2.0))
    return np.asarray(wide & (inverse.real > 0.0))


class Seeds(NamedTuple):
    """Sign changes of Im s along the ray: step of the path, k and U by interpolation."""

    step: Indices
    k: Real
    speed: Real


def seeds_on_ray(path: EigenvaluePath, region: Region, speed_range: tuple[float, float]) -> Seeds:
    """Return where branches of the path cross the real axis at airspeeds of the range."""
    ray = on_ray(path, region)
    t, s = path.parameter[ray], path.inverse[ray]
    before, after = s[:-1].imag, s[1:].imag
    rows, columns = np.nonzero(before * after < 0.0)
    fraction = before[rows, columns] / (before - after)[rows, columns]
    crossing = s[rows, columns] + fraction * (s[rows + 1, columns] - s[rows, columns])
    k = np.exp(t[rows] + fraction * (t[rows + 1] - t[rows]))
    usable = in_range(path, crossing, speed_range) & (k > LEAST_FREQUENCY)
    speed = path.speed(crossing.real)
    usable &= np.isfinite(speed)
    return Seeds(rows[usable] + ray.start, k[usable], speed[usable])


def flutter_roots(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    speed_range: tuple[float, float],
) -> tuple[Roots, EigenvaluePath]:
    """Converge a root in every step of the ray in which a branch crosses the real axis.

    A step whose root is found elsewhere is halved until it is found where it belongs.
    """
    for _ in range(HALVINGS):
        seeds = seeds_on_ray(path, region, speed_range)
        roots = polish_crossings(problem, seeds.k, seeds.speed, region.threshold)
        t = path.parameter
        with np.errstate(invalid="ignore", divide="ignore"):
            log_k = np.log(roots.p.imag)
        home = (log_k >= t[seeds.step] - SAME_POINT) & (log_k <= t[seeds.step + 1] + SAME_POINT)
        lost = np.unique(seeds.step[~(roots.converged & home)])
        lost = lost[t[lost + 1] - t[lost] > SAME_POINT]
        if len(lost) == 0:
            break
        path = refined(problem, path, region.point, (t[lost] + t[lost + 1]) / 2.0)
    slow, fast = speed_range
    kept = roots.converged & (roots.p.imag > LEAST_FREQUENCY) & (roots.p.imag <= region.highest)
    kept &= (roots.speed >= slow) & (roots.speed <= fast)
    return _distinct(roots.take(np.flatnonzero(kept))), path


def _distinct(roots: Roots) -> Roots:
    order = np.lexsort((roots.p.imag, roots.speed))
    roots = roots.take(order)
    same_speed = np.abs(roots.speed[:, None] / roots.speed - 1.0) < SAME_POINT
    same_k = np.abs(roots.p.imag[:, None] / roots.p.imag - 1.0) < SAME_POINT
    repeated = np.triu(same_speed & same_k, 1).any(axis=0)
    return roots.take(np.flatnonzero(~repeated))


def divergence_roots(
    problem: AeroelasticProblem, path: EigenvaluePath, speed_range: tuple[float, float]
) -> Roots:
    """Real positive airspeeds of the pencil at p = 0, with the direction of the root there.

    The direction is taken a little to the right of p = 0, where Theodorsen's function is smooth.
    """
    speed = _positive_speeds(path, path.inverse[0])
    slow, fast = speed_range
    speed = speed[(speed >= slow) & (speed <= fast)]
    at_zero = roots_at(problem, np.full(len(speed), SMALLEST, complex), speed)
    beside = roots_at(problem, np.full(len(speed), BESIDE_ZERO, complex), speed)
    everywhere = np.ones(len(speed), bool)
    return at_zero._replace(
        p=np.zeros(len(speed), complex), p_by_speed=beside.p_by_speed, converged=everywhere
    )


def _positive_speeds(path: EigenvaluePath, inverse: Complex) -> Real:
    """Return the airspeeds of real positive inverse speeds that are not round-off of the others."""
    size = np.abs(inverse)
    real = (np.abs(inverse.imag) < 1e-7 * size) & (inverse.real > 0.0)
    real &= size > ROUND_OFF ** (path.power / 2.0) * size.max(initial=0.0)
    speed = path.speed(inverse.real[real])
    least = (ROUND_OFF * path.shift) ** (1.0 / path.power)
    return np.asarray(np.sort(speed[speed > least]))


def divergence_speeds(problem: AeroelasticProblem, fastest: float = 100.0) -> Real:
    """Return every airspeed in m/s at which a root stands at p = 0, ascending.

    Parameters
    ----------
    problem : AeroelasticProblem
    fastest : float
        The order of the airspeeds of interest, where the stiffness depends on p.
    """
    path = follow_path(problem, lambda t: t * (SMALLEST + 0j), np.ones(1), fastest)
    return _positive_speeds(path, path.inverse[0])
