"""Which airspeeds to look at when the user names none."""

import math
from dataclasses import replace

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.stability.crossings import divergence_speeds
from foldwing.stability.flutter import FlutterAnalysis
from foldwing.stability.problem import AeroelasticProblem

LOWEST_FRACTION = 1.0 / 150.0
"""Lowest airspeed of the search as a fraction of its end, at most of the end that is automatic."""

TIMES_DIVERGENCE = 3.0
"""The search ends at this multiple of the divergence speed of the flat wing."""

LEAST_SPEED, MOST_SPEED = 1e-3, 1e5
"""Airspeeds in m/s beyond which an end of the search is no airspeed of a wing."""

TIMES_SLOWEST = 5.0
"""A divergence speed beyond this multiple of what follows from `SLOW_MODES` is not waited for."""

SLOW_MODES = 0.02
"""Without divergence it ends where the lowest torsion mode has this reduced frequency."""


def speed_range(model: AeroelasticWing, highest: float | None = None) -> tuple[float, float]:
    """Return the lowest and highest airspeed in m/s between which flutter is sought.

    Parameters
    ----------
    model : AeroelasticWing
    highest : float, optional
        By default three times the lowest divergence speed of the flat wing with its root clamped,
        rounded up to two digits, the same for all fold angles.

    Raises
    ------
    InputError
        When ``highest`` is no airspeed.
    """
    check_highest(highest)
    automatic = _automatic(replace(model, wing=model.wing.clamped, dropped=()))
    top = automatic if highest is None else highest
    return min(top, automatic) * LOWEST_FRACTION, top


def check_highest(highest: float | None, unit: str = "m/s") -> None:
    """Raise `InputError` unless the end of the search is left open or is an airspeed."""
    if highest is not None and not LEAST_SPEED <= highest <= MOST_SPEED:
        remedy = f"Give the highest airspeed of the search in {unit}, such as 60."
        limit = f"must be {LEAST_SPEED:g} to {MOST_SPEED:g} {unit}"
        raise InputError("--max-speed", highest, limit, remedy)


def _automatic(model: AeroelasticWing) -> float:
    modes = model.modes((0.0,) * len(model.wing.hinges))
    torsion = [omega for omega, name in zip(modes.omega, modes.names, strict=True) if name == "T1"]
    omega = torsion[0] if torsion else float(modes.omega[-1])
    if omega == 0.0:
        limit = "the modes kept must include one that is not a rigid motion"
        remedy = "Keep more modes, or give --max-speed."
        raise InputError("analysis.system_modes", modes.count, limit, remedy)
    return automatic_end(model.system(modes), omega)


def automatic_end(problem: AeroelasticProblem, torsion_frequency: float) -> float:
    """Return the highest airspeed of a search in m/s when the user names none.

    Parameters
    ----------
    problem : AeroelasticProblem
    torsion_frequency : float
        Of the lowest torsion mode in rad/s.
    """
    slowest = _rounded_up(torsion_frequency * problem.half_chord / SLOW_MODES)
    divergence = divergence_speeds(problem)
    divergence = divergence[TIMES_DIVERGENCE * divergence < TIMES_SLOWEST * slowest]
    if len(divergence):
        return _rounded_up(TIMES_DIVERGENCE * float(divergence[0]))
    return slowest


def _rounded_up(value: float) -> float:
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return round(math.ceil(value / unit - 1e-9) * unit, 12)


def picture_speeds(analysis: FlutterAnalysis) -> Real:
    """Return 61 speeds from 0 to 1.5 times the lowest onset, divergence or merger."""
    critical = analysis.critical
    top = analysis.speed_range[1]
    last = top if critical is None else min(1.5 * critical.speed, top)
    return np.linspace(0.0, last, 61)
