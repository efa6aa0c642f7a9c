"""Phugoid and short period of a flexible aircraft: found, followed, and told from other roots.

Neither leads to a natural mode at rest. They are sought with a quasi-steady approximation

    Qhat(p) = Q0 + p Q1 + p^2 Q2,    Q1 = Im Qhat(i k)/k at a low k,

whose roots all come from one matrix: the phugoid where it stands furthest apart, the short period
at the slowest level flight, where it is furthest below the elastic modes. Then they are converged
on the full problem and followed.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg

from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.stability.flutter import FlutterAnalysis
from foldwing.stability.newton import Roots, polish_roots
from foldwing.stability.status import BODY_FREEDOM, PHUGOID, SHORT_PERIOD, FlutterPoint
from foldwing.stability.tracking import branches_at, record
from foldwing.structure.modes import AIRCRAFT_MOTIONS

_Guess = tuple[float, complex]
"""Airspeed in m/s and where a root may be there, in rad/s."""

WHOLE = slice(0, len(AIRCRAFT_MOTIONS))
"""Modes x, z and pitch, which come first; the flapping of a free hinge is rigid too."""

LOW = 0.02
"""Reduced frequency at which the forces in phase with the rate are taken."""

TRIALS = 16
"""Airspeeds at which the two are looked for."""

AS_A_WHOLE = 0.3
"""Share of the kinetic energy in x, z and pitch from which on a root may be one of the two."""

FASTEST_PHUGOID = 3.0
"""Multiple of sqrt(2) g / U beyond which an oscillation is no phugoid."""

NEAR = 0.5
"""Relative distance from where it was expected at which a converged root is another one."""

FASTEST_SHORT_PERIOD = 2.0
"""Multiple of the lowest elastic frequency beyond which the short period is not looked for."""

SAME_ROOT = 1e-4
"""Relative difference below which a flutter point lies on a followed branch."""

RIGID = 0.9
"""Share of the kinetic energy in rigid motions from which on the aircraft moves as a whole."""

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
    gravity : float
        m/s^2.
    """

    names: tuple[str, ...]
    roots: Roots
    gravity: float

    def fastest_phugoid(self, speed: float) -> float:
        """Return how fast a phugoid can be in rad/s at an airspeed in m/s."""
        return _fastest_phugoid(speed, self.gravity)

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


def flight_modes(
    system: AeroelasticSystem, speed_range: tuple[float, float], gravity: float
) -> FlightModes:
    """Return phugoid and short period of an aircraft.

    Parameters
    ----------
    system : AeroelasticSystem
    speed_range : (float, float)
        Airspeeds in m/s between which they are looked for.
    gravity : float
        m/s^2; with the airspeed it tells how fast a phugoid can be.
    """
    trials = [_trial(system, float(U), gravity) for U in np.geomspace(*speed_range, TRIALS)]
    apart = np.array([trial.separation for trial in trials])
    found = {
        PHUGOID: _converged(system, _in_turn([(t.speed, t.phugoid) for t in trials], apart)),
        SHORT_PERIOD: _converged(
            system, [(t.speed, t.short_period) for t in trials if t.short_period]
        ),
    }
    roots = [root for root in found.values() if root is not None]
    names = tuple(name for name, root in found.items() if root is not None)
    if not roots:
        nothing = polish_roots(system, np.zeros(0, np.complex128), np.zeros(0))
        return FlightModes((), nothing, gravity)
    together = Roots(*(np.concatenate(part) for part in zip(*roots, strict=True)))
    return FlightModes(names, together, gravity)


def _fastest_phugoid(speed: float, gravity: float) -> float:
    """Return a multiple of Lanchester's sqrt(2) g / U in rad/s."""
    return FASTEST_PHUGOID * float(np.sqrt(2.0)) * gravity / speed


def _in_turn(guesses: Sequence[_Guess], apart: Real) -> list[_Guess]:
    """Return guesses at ascending airspeeds in the order in which they are tried; none are 0.

    Those below the airspeed at which the motion is lost come first: one that is born again beyond
    does not lead back to it. Among them the one with the largest ``apart``.
    """
    there = np.array([guess != 0.0 for _, guess in guesses])
    lost = np.cumsum(~there & (np.cumsum(there) > 0)) > 0
    order = np.lexsort((-apart, lost))
    return [guesses[index] for index in order if there[index]]


def _converged(system: AeroelasticSystem, guesses: Sequence[_Guess]) -> Roots | None:
    """Return the root of the first guess that leads to one near it."""
    for speed, guess in guesses:
        p = np.array([guess * (system.half_chord / speed)])
        root = polish_roots(system, p, np.array([speed]))
        near = abs(root.p[0] / p[0] - 1.0) < NEAR and root.p[0].imag > 0.0
        if root.converged[0] and near:
            return root
    return None


@dataclass(frozen=True)
class _Trial:
    """Guesses at one airspeed in rad/s, 0 where there is none; the lowest elastic frequency."""

    speed: float
    phugoid: complex
    short_period: complex
    elastic: float

    @property
    def separation(self) -> float:
        """How far the short period is from its neighbours, as a ratio; 0 where one is missing."""
        if not self.phugoid or not self.short_period:
            return 0.0
        fast = abs(self.short_period)
        return min(fast / abs(self.phugoid), self.elastic / fast)


def _trial(system: AeroelasticSystem, speed: float, gravity: float) -> _Trial:
    """Look for both at one airspeed; the phugoid is near Lanchester's sqrt(2) g / U or slower."""
    values, share = _oscillations(system, speed)
    elastic = system.omega[~system.rigid]
    lowest = float(elastic[0]) if len(elastic) else np.inf
    values = values[share > AS_A_WHOLE]
    highest = _fastest_phugoid(speed, gravity)
    size = np.abs(values)
    slow = np.flatnonzero(size <= highest)
    fast = np.flatnonzero((size > highest) & (size < FASTEST_SHORT_PERIOD * lowest))
    return _Trial(
        speed,
        complex(values[slow[0]]) if len(slow) else 0j,
        complex(values[fast[0]]) if len(fast) else 0j,
        lowest,
    )


def _oscillations(system: AeroelasticSystem, speed: float) -> tuple[Complex, Real]:
    """Return oscillating roots in rad/s, the slowest first, and the share of x, z and pitch."""
    values, vectors = _quasi_steady(system, speed)
    size = np.abs(values).max()
    kept = np.flatnonzero(values.imag > 1e-9 * size)
    kept = kept[np.argsort(np.abs(values[kept]))]
    energy = np.abs(vectors[: system.size, kept]) ** 2
    return values[kept], energy[WHOLE].sum(axis=0) / energy.sum(axis=0)


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
    if not doubtful:
        return analysis
    points = list(analysis.points)
    at = np.array([_compared_at(points[index]) for index in doubtful])
    order: Indices = np.argsort(at)
    values = np.empty((len(at), len(modes.names)), complex)
    values[order] = modes.eigenvalues(system, at[order])
    for index, row in zip(doubtful, values, strict=True):
        origin = _branch(points[index], row, system.half_chord, modes.names)
        motion = _motion(points[index], origin, system, modes)
        points[index] = replace(points[index], motion=motion, origin=origin)
    return replace(analysis, points=tuple(points))


def _is_doubtful(point: FlutterPoint) -> bool:
    """Return whether a point was not followed down to a natural mode at rest."""
    if point.kind == "flutter":
        return point.mode_confidence < 1.0
    return point.event == "merger"


def _motion(point: FlutterPoint, origin: str, system: AeroelasticSystem, modes: FlightModes) -> str:
    """Return what moves at a point: the aircraft as a whole, its wing, or both.

    One that moves as a whole but lies on no branch is named by how fast it is: beyond its merger
    the phugoid may be born again.
    """
    if point.kind != "flutter":
        return origin or point.motion
    at = np.array([point.p]), np.array([point.speed]), point.vector[None]
    energy = np.abs(system.modal_vectors(*at)[0]) ** 2
    if float(energy[WHOLE].sum() / energy.sum()) < RIGID:
        return BODY_FREEDOM if origin else point.motion
    omega = abs(point.p) * point.speed / system.half_chord
    slow = omega <= modes.fastest_phugoid(point.speed)
    return origin or (PHUGOID if slow else SHORT_PERIOD)


def _compared_at(point: FlutterPoint) -> float:
    return point.speed * (1.0 - BESIDE) if point.event == "merger" else point.speed


def _branch(point: FlutterPoint, values: Complex, b: float, names: tuple[str, ...]) -> str:
    """Return the name of the branch that a point lies on, empty when it lies on none."""
    distance = np.abs(values * b / (point.speed * point.p) - 1.0)
    limit = BESIDE_MERGER if point.event == "merger" else SAME_ROOT
    distance = np.where(np.isfinite(distance), distance, np.inf)
    if not names or distance.min() >= limit:
        return ""
    return names[int(distance.argmin())]
