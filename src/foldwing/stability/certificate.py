"""The certificate: unstable roots counted by the argument principle, beside those found."""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Indices, Real
from foldwing.stability.crossings import SAME_POINT, Crossings, seeds_on_ray
from foldwing.stability.path import EigenvaluePath, refined, winding
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.region import Region

REFINEMENTS = 14
"""Most rounds of halving doubtful steps before a case is left uncertified."""

EDGE = 0.03
"""Relative distance from an end of the range within which crossings are not matched."""

MOST_POINTS = 5_000
"""Points of a path beyond which a count that is still in doubt is given up."""

NEAR_SEED = 0.3
"""Difference of log U within which a flutter point belongs to a crossing of a branch."""


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
    matched : bool
        Whether each crossing of the real axis by a branch along the ray has its flutter point.
    """

    speeds: Real
    counted: Indices
    expected: Indices
    matched: bool

    @property
    def certified(self) -> bool:
        """Whether every count is settled and as expected, and no crossing is missing."""
        agree = (self.counted >= 0) & (self.counted == self.expected)
        return self.matched and bool(np.all(agree))


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
    counted, path = _counted(problem, path, region, speeds)
    matched = _matched(path, region, crossings, speed_range)
    return Certificate(speeds, counted, counted[0] + jumps, matched)


def _matched(
    path: EigenvaluePath, region: Region, crossings: Crossings, speed_range: tuple[float, float]
) -> bool:
    """Return whether each crossing of the real axis by a branch has a flutter point in its step.

    Not near the ends of the range, where interpolation may put a crossing on the wrong side.
    """
    slow, fast = speed_range[0] * (1.0 + EDGE), speed_range[1] * (1.0 - EDGE)
    seeds = seeds_on_ray(path, region, speed_range)
    inside = (seeds.speed > slow) & (seeds.speed < fast)
    step = seeds.step[inside]
    found = crossings.roots.take(np.flatnonzero(~crossings.divergence))
    log_k = np.log(found.p.imag)
    low, high = path.parameter[step] - SAME_POINT, path.parameter[step + 1] + SAME_POINT
    here = (log_k >= low[:, None]) & (log_k <= high[:, None])
    here &= np.abs(np.log(found.speed / seeds.speed[inside, None])) < NEAR_SEED
    return bool(here.any(axis=1).all())


def count_unstable(
    problem: AeroelasticProblem, path: EigenvaluePath, region: Region, speeds: Real
) -> Indices:
    """Return the number of roots in the region at each airspeed; -1 where it did not settle."""
    return _counted(problem, path, region, speeds)[0]


def _counted(
    problem: AeroelasticProblem, path: EigenvaluePath, region: Region, speeds: Real
) -> tuple[Indices, EigenvaluePath]:
    """Count, and return the path as far as it had to be refined."""
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
        if len(path.p) + len(steps) > MOST_POINTS:
            break
        middle = (path.parameter[steps] + path.parameter[steps + 1]) / 2.0
        path = refined(problem, path, region.point, middle)
    return count, path


def _whole(count: Real) -> Indices:
    """Return counts as integers; -1 for those that are not near to one."""
    nearest = np.rint(count)
    return np.where(np.abs(count - nearest) < 0.05, nearest, -1).astype(int)
