"""All flutter and divergence points of a problem in a range of airspeeds, certified and named."""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Mask, Real
from foldwing.stability.branches import energy_modes, trace_origins
from foldwing.stability.certificate import Certificate
from foldwing.stability.newton import Roots
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.real_axis import mergers, real_axis_path
from foldwing.stability.status import FlutterPoint, is_critical
from foldwing.stability.still_air import still_air_roots
from foldwing.stability.sweep import Sweep, resolved_frequency, sweep
from foldwing.stability.tracking import resolved_speed


@dataclass(frozen=True)
class FlutterAnalysis:
    """The stability boundary of one case.

    Attributes
    ----------
    points : tuple of FlutterPoint
        Ascending in airspeed.
    certificate : Certificate
        Counts of unstable roots between the points.
    speed_range : (float, float)
        Airspeeds in m/s between which all points were sought.
    threshold : float
        Damping ratio of the boundary, positive stable.
    sweep : Sweep
    lowest_resolved : array, shape (n,)
        Airspeed in m/s below which the model cannot resolve a column of T; 0 without a limit, and
        for columns without stiffness.
    """

    points: tuple[FlutterPoint, ...]
    certificate: Certificate
    speed_range: tuple[float, float]
    threshold: float
    sweep: Sweep
    lowest_resolved: Real

    @property
    def unresolved(self) -> tuple[int, ...]:
        """Columns of T too fast for the model at the lowest airspeed, the fastest first."""
        order = np.argsort(-self.lowest_resolved, kind="stable")
        return tuple(order[self.lowest_resolved[order] > self.speed_range[0]].tolist())

    @property
    def valid_from(self) -> float:
        """Airspeed in m/s from which on every mode is resolved and sought."""
        return max(self.speed_range[0], float(self.lowest_resolved.max(initial=0.0)))

    @property
    def certified(self) -> bool:
        """Whether the unstable roots listed are all there are at every airspeed of the range."""
        return self.certificate.certified

    @property
    def unstable_from_start(self) -> int:
        """Number of roots beyond the boundary at the lowest airspeed; -1 when it is not known."""
        return int(self.certificate.counted[0])

    @property
    def critical(self) -> FlutterPoint | None:
        """The lowest onset or merger; None when nothing becomes unstable in the range.

        Oscillations of a whole aircraft (phugoid, short period) do not count.
        """
        return next(filter(is_critical, self.points), None)


def find_flutter(
    problem: AeroelasticProblem, speed_range: tuple[float, float], threshold: float = 0.0
) -> FlutterAnalysis:
    """Find every crossing of the stability boundary, without an airspeed loop.

    Parameters
    ----------
    problem : AeroelasticProblem
    speed_range : (float, float)
        Lowest and highest airspeed in m/s, both positive.
    threshold : float
        Damping ratio of the boundary, positive stable; 0 is the stability boundary.
    """
    result = sweep(problem, speed_range, threshold)
    crossings = result.crossings
    oscillating = np.flatnonzero(~crossings.divergence)
    real = np.flatnonzero(crossings.divergence)
    flutter = _flutter_points(
        problem, crossings.roots.take(oscillating), crossings.onset[oscillating], speed_range[0]
    )
    divergence = _real_points(
        problem,
        crossings.roots.take(real),
        ["onset" if grows else "recovery" for grows in crossings.onset[real]],
    )
    double = mergers(
        problem, real_axis_path(problem, speed_range[1], result.region.edge), speed_range
    )
    merged = _real_points(problem, double, ["merger"] * len(double.p))
    points = sorted([*flutter, *divergence, *merged], key=lambda point: point.speed)
    return FlutterAnalysis(
        tuple(points),
        result.certificate,
        speed_range,
        threshold,
        result,
        lowest_resolved(problem, threshold),
    )


def lowest_resolved(problem: AeroelasticProblem, threshold: float) -> Real:
    """Return the airspeed in m/s below which each column of T is beyond what the problem holds for.

    Parameters
    ----------
    problem : AeroelasticProblem
    threshold : float
        Damping ratio of the boundary; a positive one may narrow what the problem holds for.

    Returns
    -------
    array, shape (n,)
        0 without a limit, and for columns without stiffness.
    """
    rest = still_air_roots(problem)
    lowest = np.zeros(problem.size)
    highest = resolved_frequency(problem, threshold)
    lowest[rest.mode] = resolved_speed(problem, rest.eigenvalue, highest)
    return lowest


def _flutter_points(
    problem: AeroelasticProblem, roots: Roots, onset: Mask, lowest: float
) -> list[FlutterPoint]:
    origin = trace_origins(problem, roots, lowest)
    strength = (
        roots.p_by_speed.real * roots.p.imag - roots.p.real * roots.p_by_speed.imag
    ) / roots.p.imag**2
    points = []
    for i in range(len(roots.p)):
        later = (origin.branch == origin.branch[i]) & (roots.speed > roots.speed[i])
        hump = bool((later & ~onset).any())
        points.append(
            FlutterPoint(
                kind="flutter",
                event="onset" if onset[i] else "recovery",
                speed=float(roots.speed[i]),
                p=complex(roots.p[i]),
                frequency=float(
                    roots.p[i].imag * roots.speed[i] / (2.0 * np.pi * problem.half_chord)
                ),
                strength=float(strength[i]),
                vector=roots.right[i],
                residual=float(roots.residual[i]),
                branch=int(origin.branch[i]),
                classification=("hump" if hump else "coalescence") if onset[i] else "",
                mode=int(origin.mode[i]),
                mode_confidence=float(origin.confidence[i]),
            )
        )
    return points


def _real_points(
    problem: AeroelasticProblem, roots: Roots, events: list[str]
) -> list[FlutterPoint]:
    mode, share = energy_modes(problem, roots.right)
    return [
        FlutterPoint(
            kind="divergence",
            event=event,
            speed=float(roots.speed[i]),
            p=complex(roots.p[i]),
            frequency=0.0,
            strength=float("nan"),
            vector=roots.right[i],
            residual=float(roots.residual[i]),
            mode=int(mode[i]),
            mode_confidence=float(share[i]),
        )
        for i, event in enumerate(events)
    ]
