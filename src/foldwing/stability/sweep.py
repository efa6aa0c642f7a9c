"""All flutter points of all airspeeds from one sweep of the reduced frequency.

At fixed p the stability problem is a pencil in U, so that sweeping p along the stability boundary
and watching for real positive U finds flutter at *every* airspeed without an airspeed loop. The
same eigenvalues, continued around the unstable region, count its roots at any airspeed by the
argument principle and so certify that nothing was missed.
"""

from dataclasses import dataclass, replace

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.newton import Roots, polish_crossings, roots_at
from foldwing.stability.path import (
    EigenvaluePath,
    bend,
    crowded,
    follow_path,
    inverse_speeds,
    refined,
    winding,
)
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.region import SMALLEST, Region

REFINEMENTS = 14
"""Most rounds of halving doubtful steps before a case is left uncertified."""

FINEST = 1e-3
"""Steps of log k below which the ray is not refined in search of crossings."""

RESOLUTIONS = 6
"""Most rounds of refining the ray where a branch bends or comes near to the real axis."""

ATTEMPTS = 3
"""Sweeps, each twice as dense as the one before, after which a case is left uncertified."""

SAME_POINT = 1e-7
"""Relative difference in U and k below which two flutter points are one."""

LEAST_FREQUENCY = 1e-6
"""Reduced frequency below which a crossing is divergence, found at p = 0 instead."""

BESIDE_ZERO = LEAST_FREQUENCY
"""Real p at which the direction of a divergence root is taken: it may change its sign at smaller p,
where an oscillating root crosses whose frequency is below the least."""


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


@dataclass(frozen=True)
class Certificate:
    """Numbers of unstable roots by the argument principle beside those from the crossings.

    Attributes
    ----------
    speeds : array, shape (u,)
        The lowest airspeed, one between each two crossings, and the highest, where the roots were
        counted. Without the highest, a crossing lost near the end of the range would go unnoticed.
    counted : array of int, shape (u,)
        -1 where the count did not settle.
    expected : array of int, shape (u,)
        The count at the lowest airspeed plus all jumps below.
    """

    speeds: Real
    counted: Indices
    expected: Indices

    @property
    def certified(self) -> bool:
        """Whether every count is settled and as expected."""
        return bool(np.all((self.counted >= 0) & (self.counted == self.expected)))


@dataclass(frozen=True)
class Sweep:
    """Result of one sweep."""

    crossings: Crossings
    certificate: Certificate
    path: EigenvaluePath
    region: Region


def sweep_region(
    problem: AeroelasticProblem,
    speed_range: tuple[float, float],
    threshold: float = 0.0,
    highest: float | None = None,
) -> Region:
    """Return the region that holds every unstable root between two airspeeds.

    The lowest reduced frequency is that of the lowest mode at the top speed, at most 0.004; the
    highest is 1.2 times that of the highest mode at the lowest speed, plus 0.2.
    """
    slow, fast = speed_range
    omega = still_air_frequencies(problem)
    b = problem.half_chord
    lowest = min(0.004, 0.5 * b * float(omega[0]) / fast)
    top = 1.2 * float(omega[-1]) * b / slow + 0.2 if highest is None else highest
    return Region(threshold, lowest, top)


def still_air_frequencies(problem: AeroelasticProblem) -> Real:
    """Return the undamped angular frequencies at rest in rad/s, ascending."""
    air = problem.still_air()
    values = np.linalg.eigvals(np.linalg.solve(air.stiffness, air.mass))
    return np.sort(1.0 / np.sqrt(np.abs(values)))


def sweep(
    problem: AeroelasticProblem,
    speed_range: tuple[float, float],
    threshold: float = 0.0,
    highest: float | None = None,
) -> Sweep:
    """Find and certify every crossing of the stability boundary in a range of airspeeds.

    Parameters
    ----------
    problem : AeroelasticProblem
    speed_range : (float, float)
        Lowest and highest airspeed in m/s, both positive.
    threshold : float
        Damping ratio of the boundary, positive stable.
    highest : float, optional
        Highest reduced frequency swept; by default that of the highest mode at the lowest speed.
    """
    region = sweep_region(problem, speed_range, threshold, highest)
    for _ in range(ATTEMPTS):
        result = _sweep_once(problem, speed_range, region)
        if result.certificate.certified:
            break
        region = replace(region, lowest=region.lowest / 4.0, density=region.density * 2.0)
    return result


def _sweep_once(
    problem: AeroelasticProblem, speed_range: tuple[float, float], region: Region
) -> Sweep:
    path = follow_path(problem, region.point, region.parameter(), speed_range[1])
    path = _resolved(problem, path, region, speed_range)
    crossings = _crossings(problem, path, region, speed_range)
    certificate = certify(problem, path, region, crossings, speed_range)
    return Sweep(crossings, certificate, path, region)


def _on_ray(path: EigenvaluePath, region: Region) -> slice:
    """Return the points of the path on the threshold ray (all but the real starting point)."""
    end = int(np.searchsorted(path.parameter, np.log(region.highest) + 1e-9))
    return slice(1, end)


def _in_range(path: EigenvaluePath, inverse: Complex, speed_range: tuple[float, float]) -> Mask:
    """Return which inverse speeds may belong to an airspeed of the range, with a margin."""
    slow, fast = speed_range
    size = np.abs(inverse)
    margin = 2.0**path.power
    wide = (size > fast**-path.power / margin) & (size < slow**-path.power * margin)
    return np.asarray(wide & (inverse.real > 0.0))


def _resolved(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    speed_range: tuple[float, float],
) -> EigenvaluePath:
    """Refine the ray where a branch bends sharply or comes near to the real axis and turns back."""
    for _ in range(RESOLUTIONS):
        ray = _on_ray(path, region)
        t, s = path.parameter[ray], path.inverse[ray]
        wanted = _in_range(path, s, speed_range)
        steep = bend(path)[ray][: len(t) - 1] > 0.1
        unclear = ((steep | crowded(s)) & wanted[:-1] & wanted[1:]).any(axis=1)
        steps = np.flatnonzero(unclear | _touching(t, s.imag, wanted))
        steps = steps[t[steps + 1] - t[steps] > FINEST]
        if len(steps) == 0:
            break
        path = refined(problem, path, region.point, (t[steps] + t[steps + 1]) / 2.0)
    return path


def _touching(t: Real, f: Real, wanted: Mask) -> Mask:
    """Return the steps within which a branch of ``f`` (m, r) may reach zero and turn back.

    The branch comes nearer to zero before the step and leaves it after; going on as it came, or
    coming as it leaves, it would reach zero within the step.
    """
    slope = np.diff(f, axis=0) / np.diff(t)[:, None]
    start, end = np.abs(f[1:-2]), np.abs(f[2:-1])
    sign = np.sign(f[1:-2])
    before, after = sign * slope[:-2], sign * slope[2:]
    width = (t[2:-1] - t[1:-2])[:, None]
    dip = (np.sign(f[2:-1]) == sign) & (before < 0.0) & (after > 0.0)
    near = (start + before * width < 0.0) | (end - after * width < 0.0)
    inner = (dip & near & wanted[1:-2] & wanted[2:-1]).any(axis=1)
    return np.concatenate([[False], inner, [False]])


def _crossings(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    speed_range: tuple[float, float],
) -> Crossings:
    flutter = _flutter_roots(problem, path, region, speed_range)
    divergence = _divergence_roots(problem, path, speed_range)
    outward = flutter.p_by_speed.real + region.threshold * flutter.p_by_speed.imag
    growing = np.concatenate([outward > 0.0, divergence.p_by_speed.real > 0.0])
    kind = np.repeat([False, True], [len(flutter.p), len(divergence.p)])
    roots = Roots(*(np.concatenate(pair) for pair in zip(flutter, divergence, strict=True)))
    order = np.argsort(roots.speed)
    return Crossings(roots.take(order), kind[order], growing[order])


def _flutter_roots(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    speed_range: tuple[float, float],
) -> Roots:
    """Seed from the sign changes of Im s along the ray and converge."""
    ray = _on_ray(path, region)
    t, s = path.parameter[ray], path.inverse[ray]
    before, after = s[:-1].imag, s[1:].imag
    changes = before * after < 0.0
    rows, columns = np.nonzero(changes)
    fraction = before[rows, columns] / (before - after)[rows, columns]
    seed = s[rows, columns] + fraction * (s[rows + 1, columns] - s[rows, columns])
    usable = _in_range(path, seed, speed_range)
    k = np.exp(t[rows] + fraction * (t[rows + 1] - t[rows]))[usable]
    speed = seed.real[usable] ** (-1.0 / path.power)
    roots = polish_crossings(problem, k, speed, region.threshold)
    slow, fast = speed_range
    kept = roots.converged & (roots.p.imag > LEAST_FREQUENCY) & (roots.p.imag <= region.highest)
    kept &= (roots.speed >= slow) & (roots.speed <= fast)
    return _distinct(roots.take(np.flatnonzero(kept)))


def _distinct(roots: Roots) -> Roots:
    order = np.lexsort((roots.p.imag, roots.speed))
    roots = roots.take(order)
    same_speed = np.abs(roots.speed[:, None] / roots.speed - 1.0) < SAME_POINT
    same_k = np.abs(roots.p.imag[:, None] / roots.p.imag - 1.0) < SAME_POINT
    repeated = np.triu(same_speed & same_k, 1).any(axis=0)
    return roots.take(np.flatnonzero(~repeated))


def _divergence_roots(
    problem: AeroelasticProblem, path: EigenvaluePath, speed_range: tuple[float, float]
) -> Roots:
    """Real positive airspeeds of the pencil at p = 0, with the direction of the root there.

    The direction is taken a little to the right of p = 0, where Theodorsen's function is smooth.
    """
    speed = _positive_speeds(path.inverse[0], path.power)
    slow, fast = speed_range
    speed = speed[(speed >= slow) & (speed <= fast)]
    at_zero = roots_at(problem, np.full(len(speed), SMALLEST, complex), speed)
    beside = roots_at(problem, np.full(len(speed), BESIDE_ZERO, complex), speed)
    everywhere = np.ones(len(speed), bool)
    return at_zero._replace(
        p=np.zeros(len(speed), complex), p_by_speed=beside.p_by_speed, converged=everywhere
    )


def _positive_speeds(inverse: Complex, power: int) -> Real:
    real = (np.abs(inverse.imag) < 1e-7 * np.abs(inverse)) & (inverse.real > 0.0)
    return np.asarray(np.sort(inverse.real[real] ** (-1.0 / power)))


def divergence_speeds(problem: AeroelasticProblem) -> Real:
    """Return every airspeed in m/s at which a root stands at p = 0, ascending."""
    inverse, power = inverse_speeds(problem.pencil(np.array([SMALLEST + 0j])))
    return _positive_speeds(inverse[0], power)


def certify(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    crossings: Crossings,
    speed_range: tuple[float, float],
) -> Certificate:
    """Count unstable roots between all crossings and at both ends by the argument principle.

    Parameters
    ----------
    problem : AeroelasticProblem
    path : EigenvaluePath
        Around ``region``; refined here until every count is beyond doubt.
    region : Region
    crossings : Crossings
        Their jumps, summed from the count at the lowest airspeed, are what is expected.
    speed_range : (float, float)
        Lowest and highest airspeed in m/s.
    """
    slow, fast = speed_range
    edges = np.concatenate([[slow], crossings.speed, [fast]])
    gaps = edges[1:] > edges[:-1] * (1.0 + SAME_POINT)
    total = np.concatenate([[0], np.cumsum(crossings.jump)])
    middle = np.sqrt(edges[1:] * edges[:-1])
    speeds = np.concatenate([[slow], middle[gaps], edges[-1:][gaps[-1:]]])
    jumps = np.concatenate([[0], total[gaps], total[-1:][gaps[-1:]]])
    counted = count_unstable(problem, path, region, speeds)
    return Certificate(speeds, counted, counted[0] + jumps)


def count_unstable(
    problem: AeroelasticProblem, path: EigenvaluePath, region: Region, speeds: Real
) -> Indices:
    """Return the number of roots in the region at each airspeed; -1 where it did not settle."""
    count = np.full(len(speeds), -1)
    pending = np.arange(len(speeds))
    for _ in range(REFINEMENTS):
        turns, doubtful = winding(path, speeds[pending])
        beyond_doubt = ~doubtful.any(axis=1)
        count[pending[beyond_doubt]] = _whole(-turns[beyond_doubt] / np.pi)
        pending = pending[~beyond_doubt]
        if len(pending) == 0:
            break
        steps = np.flatnonzero(doubtful.any(axis=0))
        middle = (path.parameter[steps] + path.parameter[steps + 1]) / 2.0
        path = refined(problem, path, region.point, middle)
    return count


def _whole(count: Real) -> Indices:
    """Return counts as integers; -1 for those that are not near to one."""
    nearest = np.rint(count)
    return np.where(np.abs(count - nearest) < 0.05, nearest, -1).astype(int)
