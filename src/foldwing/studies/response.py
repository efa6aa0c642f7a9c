"""The response of a wing in an airstream to a tap on its tip, and what can be identified in it."""

from typing import Any

import numpy as np

from foldwing.aeroelastic.reference import Reference
from foldwing.aeroelastic.reference_roots import roots_near
from foldwing.maths.arrays import Real
from foldwing.simulation import Identified, Response, identify, march
from foldwing.studies.shapes import surface_grid

PERIODS, LEAST_STEPS, MOST_STEPS = 12, 400, 4000
"""Periods of the motion of interest that are marched, and limits of the number of steps."""

SKIPPED = 0.2
"""Share of the record left to motions that decay at once, before the identification begins."""


def tip_response(
    reference: Reference, airspeed: float, expected: complex
) -> tuple[dict[str, Any], Real]:
    """Return the response to a tap as dataset variables, and the times.

    Parameters
    ----------
    reference : Reference
    airspeed : float
        In m/s.
    expected : complex
        lambda of the motion of interest in rad/s, roughly.
    """
    marching = reference.at(airspeed)
    nearest = roots_near(marching, expected * (1.0 + 1e-3) + 1e-3, 4).eigenvalues
    root = complex(nearest[np.argmin(np.abs(nearest - expected))])
    wanted = PERIODS * 2.0 * np.pi / max(abs(root.imag), 1e-9) / marching.step
    steps = int(np.clip(wanted, LEAST_STEPS, MOST_STEPS))
    response = march(marching, steps, velocity=_tap(reference))
    skip = int(SKIPPED * steps)
    found = identify(response.coordinates, response.step, skip)
    motion = found.nearest(root)
    largest = float(np.abs(response.coordinates).max())
    dims = ("time", "mode")
    attrs = _identified(found, motion, airspeed, root)
    return {
        "response": (dims, response.coordinates / largest, attrs),
        "response_envelope": (dims, _envelope(response, found, motion, skip) / largest),
    }, response.time


def _tap(reference: Reference) -> Real:
    """Return the modal velocities after an impulse on the middle of the tip, normal to it."""
    wing, modes = reference.model.wing, reference.modes
    grid = surface_grid(wing)
    tip = np.flatnonzero((grid.segment == wing.count) & (grid.spanwise == grid.spanwise.max()))
    middle = tip[len(tip) // 2 : len(tip) // 2 + 1]
    normal = modes.rotations[-1][:, 2]
    return np.asarray(normal @ grid.displacement(modes)[middle[0]])


def _envelope(response: Response, found: Identified, motion: int, skip: int) -> Real:
    """Return the amplitude of one motion in every mode, nan before the identification begins."""
    later = response.time[skip:] - response.time[skip]
    growth = found.eigenvalues[motion].real
    envelope = np.full(response.coordinates.shape, np.nan)
    envelope[skip:] = np.exp(growth * later)[:, None] * np.abs(found.shapes[motion])
    return envelope


def _identified(found: Identified, motion: int, airspeed: float, root: complex) -> dict[str, float]:
    return {
        "speed": airspeed,
        "frequency": float(found.frequencies[motion]),
        "damping_ratio": float(found.dampings[motion]),
        "growth": float(found.eigenvalues[motion].real),
        "misfit": found.residual,
        "eigenvalue_frequency": abs(root.imag) / (2.0 * np.pi),
        "eigenvalue_growth": root.real,
    }
