"""Phugoid and short period of a flexible aircraft: found, followed, and told from other roots.

Neither leads to a natural mode at rest. They are sought where they stand well apart, the phugoid
far below the short period and that far below the elastic modes, from a quasi-steady approximation

    Qhat(p) = Q0 + p Q1 + p^2 Q2,    Q1 = Im Qhat(i k)/k at a low k,

whose roots all come from one matrix, and then converged on the full problem and followed.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg

from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.stability.flutter import FlutterAnalysis
from foldwing.stability.newton import Roots, polish_roots
from foldwing.stability.status import FlutterPoint
from foldwing.stability.tracking import branches_at, record

PHUGOID, SHORT_PERIOD = "phugoid", "short period"

LOW = 0.02
"""Reduced frequency at which the forces in phase with the rate are taken."""

TRIALS = 24
"""Airspeeds at which the two are looked for."""

AS_A_WHOLE = 0.5
"""Share of the kinetic energy in rigid motions from which on a root may be the short period."""

NEAR = 0.5
"""Relative distance from where it was expected at which a converged root is another one."""

SAME_ROOT = 1e-4
"""Relative difference below which a flutter point lies on a followed branch."""

BESIDE, BESIDE_MERGER = 1e-3, 0.3
"""How far below a merger the pair is compared with it, and how much they may differ there."""


@dataclass(frozen=True)
class FlightModes:
    """Oscillating motions of an aircraft as a whole; one that is overdamped is absent.

    Attributes
    ----------
    names : tuple of str
    roots : Roots
        Each at an airspeed at which it is beyond doubt.
    """

    names: tuple[str, ...]
    roots: Roots

    def eigenvalues(self, system: AeroelasticSystem, speeds: Real) -> Complex:
        """Return them at ascending airspeeds in m/s, shape (u, modes); nan where one is lost."""
        values = np.full((len(speeds), len(self.names)), complex(np.nan, np.nan))
        for column in range(len(self.names)):
            start = branches_at(system, self.roots.take(np.array([column])))
            above = np.flatnonzero(speeds >= start.speed[0])
            below = np.flatnonzero(speeds < start.speed[0])[::-1]
            for where in (above, below):
                values[where, column] = record(system, start, speeds[where]).eigenvalue[:, 0]
        return values


def flight_modes(system: AeroelasticSystem, speed_range: tuple[float, float]) -> FlightModes:
    """Return phugoid and short period of an aircraft.

    Parameters
    ----------
    system : AeroelasticSystem
    speed_range : (float, float)
        Airspeeds in m/s between which they are looked for.
    """
    trials = [_candidates(system, float(U)) for U in np.geomspace(*speed_range, TRIALS)]
    names: list[str] = []
    guesses: list[complex] = []
    both = [trial for trial in trials if trial.phugoid and trial.short_period]
    chosen = max(both, key=lambda trial: trial.separation, default=None)
    if chosen is not None:
        names, guesses = [PHUGOID, SHORT_PERIOD], [chosen.phugoid, chosen.short_period]
    elif any(trial.phugoid for trial in trials):
        chosen = max((t for t in trials if t.phugoid), key=lambda trial: -abs(trial.phugoid))
        names, guesses = [PHUGOID], [chosen.phugoid]
    if chosen is None:
        return FlightModes((), polish_roots(system, np.zeros(0, np.complex128), np.zeros(0)))
    p = np.asarray(guesses, np.complex128) * (system.half_chord / chosen.speed)
    roots = polish_roots(system, p, np.full(len(p), chosen.speed))
    found = roots.converged & (np.abs(roots.p / p - 1.0) < NEAR) & (roots.p.imag > 0.0)
    kept = np.flatnonzero(found)
    return FlightModes(tuple(names[index] for index in kept), roots.take(kept))


@dataclass(frozen=True)
class _Trial:
    """Guesses at one airspeed in rad/s, 0 where there is none; the lowest elastic frequency."""

    speed: float
    phugoid: complex
    short_period: complex
    elastic: float

    @property
    def separation(self) -> float:
        slow, fast = abs(self.phugoid), abs(self.short_period)
        return min(fast / slow, self.elastic / fast)


def _candidates(system: AeroelasticSystem, speed: float) -> _Trial:
    values, share = _oscillations(system, speed)
    elastic = system.omega[~system.rigid]
    lowest = float(elastic[0]) if len(elastic) else np.inf
    whole = values[share > AS_A_WHOLE]
    phugoid = complex(whole[0]) if len(whole) else 0j
    short = complex(whole[1]) if len(whole) > 1 else 0j
    return _Trial(speed, phugoid, short, lowest)


def _oscillations(system: AeroelasticSystem, speed: float) -> tuple[Complex, Real]:
    """Return oscillating roots in rad/s, the slowest first, and the share of rigid motion."""
    values, vectors = _quasi_steady(system, speed)
    size = np.abs(values).max()
    kept = np.flatnonzero(values.imag > 1e-9 * size)
    kept = kept[np.argsort(np.abs(values[kept]))]
    energy = np.abs(vectors[: system.size, kept]) ** 2
    return values[kept], energy[system.rigid].sum(axis=0) / energy.sum(axis=0)


def quasi_steady_roots(system: AeroelasticSystem, speed: float) -> Complex:
    """Return all roots in rad/s with quasi-steady forces, neutral ones near zero, shape (2 n,)."""
    return _quasi_steady(system, speed)[0]


def _quasi_steady(system: AeroelasticSystem, speed: float) -> tuple[Complex, Complex]:
    """Return eigenvalues and vectors (displacements over velocities) of one matrix."""
    n, b, k = system.size, system.half_chord, np.array([1j * LOW])
    air, omega = system.aerodynamics, system.omega
    rate = speed * b * air.forces(k)[0].imag / LOW
    if system.trim_forces is not None:
        rate = rate + b / speed * system.trim_forces.forces(k)[0].imag / LOW
    damping = np.diag(2.0 * system.damping * omega) - rate
    stiffness = np.diag(omega**2) - speed**2 * air.steady_forces()
    mass = np.eye(n) + air.apparent_mass()
    lower = np.linalg.solve(mass, np.hstack([stiffness, damping]))
    values, vectors = scipy.linalg.eig(np.vstack([np.eye(n, 2 * n, n), -lower]))
    return np.asarray(values, complex), np.asarray(vectors, complex)


def with_motions(
    analysis: FlutterAnalysis, system: AeroelasticSystem, modes: FlightModes
) -> FlutterAnalysis:
    """Return the analysis with each point of phugoid or short period named after it.

    A merger belongs to the pair that turns real there.
    """
    doubtful = [index for index, point in enumerate(analysis.points) if _is_doubtful(point)]
    if not modes.names or not doubtful:
        return analysis
    points = list(analysis.points)
    at = np.array([_compared_at(points[index]) for index in doubtful])
    order: Indices = np.argsort(at)
    values = np.empty((len(at), len(modes.names)), complex)
    values[order] = modes.eigenvalues(system, at[order])
    for index, row in zip(doubtful, values, strict=True):
        motion = _motion(points[index], row, system.half_chord, modes.names)
        points[index] = replace(points[index], motion=motion)
    return replace(analysis, points=tuple(points))


def _is_doubtful(point: FlutterPoint) -> bool:
    """Return whether a point was not followed down to a natural mode at rest."""
    if point.kind == "flutter":
        return point.mode_confidence < 1.0
    return point.event == "merger"


def _compared_at(point: FlutterPoint) -> float:
    return point.speed * (1.0 - BESIDE) if point.event == "merger" else point.speed


def _motion(point: FlutterPoint, values: Complex, b: float, names: tuple[str, ...]) -> str:
    """Return the name of the branch that a point lies on, else what it is called already."""
    distance = np.abs(values * b / (point.speed * point.p) - 1.0)
    limit = BESIDE_MERGER if point.event == "merger" else SAME_ROOT
    distance = np.where(np.isfinite(distance), distance, np.inf)
    nearest = int(distance.argmin())
    return names[nearest] if distance[nearest] < limit else point.motion
