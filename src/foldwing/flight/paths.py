"""Where an aircraft flies in one of its motions, and how it pitches."""

import math
from dataclasses import dataclass

import numpy as np

from foldwing.flight.modes import Motion
from foldwing.maths.arrays import Complex, Real

INTERVALS = 12
"""Equal intervals of time between which the pitch angle is shown."""

SAMPLES = 16 * INTERVALS + 1

AMPLITUDE = 0.1
"""Largest of u / V, w / V and theta over the time shown: where linear equations still hold."""

_CYCLES, _DECAYS, _FOREVER = 2.0, 3.0, 30.0
"""What is shown: two cycles, or until e^-3 of a motion is left; 30 s of one that only stays."""


@dataclass(frozen=True)
class FlightPath:
    """A flight path in the plane of symmetry; every array has the shape (samples,).

    Attributes
    ----------
    time : array
        s.
    ahead : array
        Distance ahead of the point that flies on steadily, m.
    altitude : array
        Height above that point, m.
    pitch : array
        rad, nose up.
    speed : float
        Of the steady point, m/s.
    """

    time: Real
    ahead: Real
    altitude: Real
    pitch: Real
    speed: float

    @property
    def distance(self) -> Real:
        """Distance flown over the ground, m."""
        return self.speed * self.time + self.ahead


def flight_path(motion: Motion, speed: float) -> FlightPath:
    """Return the path flown in one motion, of an amplitude of `AMPLITUDE`.

    Parameters
    ----------
    motion : Motion
        With its shape.
    speed : float
        Airspeed of level flight, m/s.

    Returns
    -------
    FlightPath
        Linear in the amplitude. An oscillation goes on around the steady point; an aperiodic motion
        starts there.
    """
    value = motion.eigenvalue
    time = np.linspace(0.0, _duration(motion), SAMPLES)
    u, w, _, theta = (part * np.exp(value * time) for part in motion.shape)
    largest = max(np.abs(u).max() / speed, np.abs(w).max() / speed, np.abs(theta).max())
    scale = AMPLITUDE / largest
    travel = _integral(motion, time)
    along, down, pitch = motion.shape[0], motion.shape[1], motion.shape[3]
    return FlightPath(
        time,
        scale * (along * travel).real,
        scale * ((speed * pitch - down) * travel).real,
        scale * theta.real,
        speed,
    )


def _duration(motion: Motion) -> float:
    """Return the time shown, s."""
    longest = _CYCLES * motion.period if motion.oscillates else math.inf
    if not motion.growth:
        return longest if motion.oscillates else _FOREVER
    return min(longest, _DECAYS / abs(motion.growth))


def _integral(motion: Motion, time: Real) -> Complex:
    """Return the integral of exp(lambda t): without a constant in an oscillation, else from 0."""
    value = motion.eigenvalue
    if motion.oscillates:
        oscillation: Complex = np.exp(value * time) / value
        return oscillation
    if value == 0.0:
        return time.astype(complex)
    aperiodic: Complex = (np.expm1(value.real * time) / value.real).astype(complex)
    return aperiodic
