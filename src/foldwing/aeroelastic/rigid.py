"""The rigid aircraft within the flexible one: its three rigid motions alone."""

import numpy as np

from foldwing.aeroelastic.flight_modes import quasi_steady_roots
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Complex
from foldwing.stability.newton import polish_roots
from foldwing.structure.modes import AIRCRAFT_MOTIONS, StructuralModes

MOVED = 0.5
"""Relative distance from where it was expected at which a converged root is another one."""


def rigid_modes(modes: StructuralModes) -> StructuralModes:
    """Return x, z and pitch of an aircraft alone.

    Raises
    ------
    ValueError
        When the root is clamped, so that there are none.
    """
    rigid = [column for column, name in enumerate(modes.names) if name in AIRCRAFT_MOTIONS]
    if len(rigid) < len(AIRCRAFT_MOTIONS):
        raise ValueError("modes: got those of a wing with a clamped root; it has no rigid motions")
    return modes.only(np.array(rigid))


def rigid_system(model: AeroelasticWing, modes: StructuralModes) -> AeroelasticSystem:
    """Return the flight of the aircraft with all elastic modes left out."""
    return model.system(rigid_modes(modes))


def rigid_roots(system: AeroelasticSystem, speed: float) -> Complex:
    """Return the roots of a rigid aircraft at an airspeed in m/s that are not neutral.

    Four for quasi-steady aerodynamics, the slowest first; with a lag that of a decaying real one is
    left out. In rad/s, both of a pair.
    """
    guesses = quasi_steady_roots(system, speed)
    moving = guesses[np.argsort(np.abs(guesses))][2:]
    upper = moving[moving.imag >= 0.0]
    if system.aerodynamics.has_apparent_mass:
        upper = upper[(upper.imag > 0.0) | (upper.real > 0.0)]
    p = upper * (system.half_chord / speed)
    roots = polish_roots(system, p, np.full(len(p), speed))
    found = roots.p[roots.converged & (np.abs(roots.p / p - 1.0) < MOVED)]
    values = found * (speed / system.half_chord)
    values = np.where(np.abs(values.imag) < 1e-12 * np.abs(values), values.real, values)
    both = np.concatenate([values, values[values.imag > 0.0].conj()])
    return np.asarray(both[np.lexsort((both.imag, np.abs(both).round(12)))])
