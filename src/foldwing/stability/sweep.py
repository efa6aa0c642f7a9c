"""All flutter points of all airspeeds from one sweep of the reduced frequency.

At fixed p the stability problem is a pencil in U, so that sweeping p along the stability boundary
and watching for real positive U finds flutter at *every* airspeed without an airspeed loop. The
same eigenvalues, continued around the unstable region, count its roots at any airspeed by the
argument principle and so certify that nothing was missed.
"""

from dataclasses import dataclass, replace

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.certificate import Certificate, certify, count_unstable
from foldwing.stability.crossings import (
    Crossings,
    directed,
    divergence_roots,
    flutter_roots,
    in_range,
    on_ray,
)
from foldwing.stability.path import EigenvaluePath, bend, crowded, follow_path, refined
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.region import Region

FINEST = 2e-5
"""Steps of log k below which the ray is not refined in search of crossings."""

RESOLUTIONS = 14
"""Most rounds of refining the ray where a branch bends or comes near to the real axis."""

STRAYS = 2.0
"""How many times farther than estimated a branch may stray from a chord near the real axis."""

WIDENINGS, WIDTH_SPEEDS = 10, 12
"""Most times that a region is doubled, and airspeeds at which its roots are compared."""

ATTEMPTS = 3
"""Sweeps after which a case is left uncertified, each twice as dense and wide as the one before."""


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
    highest is 1.2 times that of the highest mode at the lowest speed, plus 0.2, but never beyond
    what the problem holds for.
    """
    slow, fast = speed_range
    omega = still_air_frequencies(problem)
    b = problem.half_chord
    lowest = min(0.004, 0.5 * b * float(omega[0]) / fast)
    top = 1.2 * float(omega[-1]) * b / slow + 0.2 if highest is None else highest
    return Region(threshold, lowest, min(top, resolved_frequency(problem, threshold)))


def resolved_frequency(problem: AeroelasticProblem, threshold: float) -> float:
    """Return the reduced frequency up to which T holds on the ray p = k (i - threshold)."""
    decay = problem.largest_decay / threshold if threshold > 0.0 else np.inf
    return float(min(problem.highest_frequency, decay))


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
    if not problem.still_air().apparent_mass:
        region = _wide_enough(problem, speed_range, region)
    for _ in range(ATTEMPTS):
        result = _sweep_once(problem, speed_range, region)
        if result.certificate.certified:
            break
        region = replace(
            region,
            lowest=region.lowest / 4.0,
            density=region.density * 2.0,
            edge=region.edge * 2.0,
        )
    return result


def _wide_enough(
    problem: AeroelasticProblem, speed_range: tuple[float, float], region: Region
) -> Region:
    """Widen the region until four times its size holds no more roots.

    Without apparent mass nothing else bounds how fast a root grows.
    """
    speeds = np.geomspace(*speed_range, WIDTH_SPEEDS)
    limit = resolved_frequency(problem, region.threshold)
    counts = []
    for _ in range(WIDENINGS):
        counts.append(_count(problem, region, speeds))
        if len(counts) > 2 and np.array_equal(counts[-1], counts[-3]) and counts[-1].min() >= 0:
            break
        highest = min(2.0 * region.highest, limit)
        region = replace(region, edge=2.0 * region.edge, highest=highest)
    return region


def _count(problem: AeroelasticProblem, region: Region, speeds: Real) -> Indices:
    path = follow_path(problem, region.point, region.parameter(), float(speeds[-1]))
    return count_unstable(problem, path, region, speeds)


def _sweep_once(
    problem: AeroelasticProblem, speed_range: tuple[float, float], region: Region
) -> Sweep:
    path = follow_path(problem, region.point, region.parameter(), speed_range[1])
    path = _resolved(problem, path, region, speed_range)
    flutter, path = flutter_roots(problem, path, region, speed_range)
    divergence = divergence_roots(problem, path, speed_range)
    crossings = directed(flutter, divergence, region)
    certificate = certify(problem, path, region, crossings, speed_range)
    return Sweep(crossings, certificate, path, region)


def _resolved(
    problem: AeroelasticProblem,
    path: EigenvaluePath,
    region: Region,
    speed_range: tuple[float, float],
) -> EigenvaluePath:
    """Refine the ray where a branch bends sharply, or may reach the real axis and turn back."""
    for _ in range(RESOLUTIONS):
        ray = on_ray(path, region)
        t, s = path.parameter[ray], path.inverse[ray]
        wanted = in_range(path, s, speed_range)
        stray = bend(path)[ray][: len(t) - 1]
        doubtful = (stray > 0.1) | crowded(s) | _grazing(s, stray)
        unclear = (doubtful & wanted[:-1] & wanted[1:]).any(axis=1)
        steps = np.flatnonzero(unclear)
        steps = steps[t[steps + 1] - t[steps] > FINEST]
        if len(steps) == 0:
            break
        path = refined(problem, path, region.point, (t[steps] + t[steps + 1]) / 2.0)
    return path


def _grazing(s: Complex, stray: Real) -> Mask:
    """Return the steps in which a branch may reach the real axis and turn back, (m - 1, r).

    Its chord ends on one side of the axis, nearer to it than the branch may stray from the chord.
    """
    angle = np.angle(s)
    one_side = angle[:-1] * angle[1:] > 0.0
    nearest = np.minimum(np.abs(angle[:-1]), np.abs(angle[1:]))
    return np.asarray(one_side & (nearest <= STRAYS * stray))
