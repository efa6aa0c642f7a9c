"""Longitudinal flight of a rigid aircraft: trim, derivatives, phugoid and short period.

Axes of the body: ``x`` forward, ``z`` down, moments nose up. The states are the changes of the
velocities ``u`` along x and ``w`` along z (m/s), of the pitch rate ``q`` (rad/s) and of the pitch
angle ``theta`` (rad) from level flight.

================  ============================================================================
`trim`            lift and drag in level flight, neutral point and static margin
`derivatives`     stability derivatives and the matrix of the four states
`dimensionless`   the same equations without dimensions
`phugoid`         the simple phugoid: energy exchanged at constant angle of attack
`modes`           eigenvalues named phugoid and short period; period, damping, time to half
`paths`           the flight path and the pitch angle in each mode
`rows`            the modes of several models beside each other
================  ============================================================================
"""

from foldwing.flight.derivatives import StabilityDerivatives, stability_derivatives, state_matrix
from foldwing.flight.dimensionless import DimensionlessEquations, dimensionless
from foldwing.flight.modes import Mode, Motion, flight_modes
from foldwing.flight.paths import FlightPath, flight_path
from foldwing.flight.phugoid import simple_phugoid
from foldwing.flight.rows import ModeRow, mode_row
from foldwing.flight.trim import Trim, neutral_point, static_margin, trimmed

__all__ = [
    "DimensionlessEquations",
    "FlightPath",
    "Mode",
    "ModeRow",
    "Motion",
    "StabilityDerivatives",
    "Trim",
    "dimensionless",
    "flight_modes",
    "flight_path",
    "mode_row",
    "neutral_point",
    "simple_phugoid",
    "stability_derivatives",
    "state_matrix",
    "static_margin",
    "trimmed",
]
