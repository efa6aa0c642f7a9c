"""The equations of the four states without dimensions."""

from dataclasses import dataclass

import numpy as np

from foldwing.flight.derivatives import arms, slopes
from foldwing.flight.trim import trimmed
from foldwing.maths.arrays import Real
from foldwing.model import Airframe


@dataclass(frozen=True)
class DimensionlessEquations:
    """Equations in the time t U / c and the states (u/U, w/U, q c/(2 U), theta).

    Attributes
    ----------
    mass_ratio : float
        mu = m / (rho S c), aircraft over air.
    gyration_squared : float
        Inertia over m c^2.
    left, right : array, shape (4, 4)
        Of left d/dtau x = right x. Coefficients stand in the right side alone.
    """

    mass_ratio: float
    gyration_squared: float
    left: Real
    right: Real

    @property
    def matrix(self) -> Real:
        """Matrix of the states, shape (4, 4); its eigenvalues times U / c are in 1/s."""
        matrix: Real = np.linalg.solve(self.left, self.right)
        return matrix


def dimensionless(airframe: Airframe, length: float | None = None) -> DimensionlessEquations:
    """Return the equations of the four states without dimensions.

    Parameters
    ----------
    airframe : Airframe
    length : float, optional
        Reference length c in m, by default the chord of the wing; the eigenvalues in 1/s do not
        depend on it.
    """
    c = airframe.wing.chord if length is None else length
    trim, slope = trimmed(airframe), slopes(airframe)
    mu = airframe.mass / (airframe.density * airframe.wing.area * c)
    r2 = airframe.pitch_inertia / (airframe.mass * c * c)
    weight = mu * airframe.gravity * c / airframe.speed**2
    lift_q, moment_w, moment_q = _pitch_slopes(airframe, c)
    right = np.array(
        [
            [-trim.drag, -0.5 * (slope.drag - trim.lift), 0.0, -weight],
            [-trim.lift, -0.5 * (slope.lift + trim.drag), 2.0 * mu - 0.5 * lift_q, 0.0],
            [0.0, 0.5 * moment_w, 0.5 * moment_q, 0.0],
            [0.0, 0.0, 2.0 * mu, 0.0],
        ]
    )
    return DimensionlessEquations(mu, r2, mu * np.diag([1.0, 1.0, 2.0 * r2, 1.0]), right)


def _pitch_slopes(airframe: Airframe, c: float) -> tuple[float, float, float]:
    """Return dC_L/dq, dC_M/dalpha and dC_M/dq with the dimensionless pitch rate q c/(2 U)."""
    d = np.array(arms(airframe)) * 2.0 / c
    l = np.array([0.0, airframe.tail_arm]) - airframe.centre_of_gravity
    parts = (airframe.wing, airframe.tail)
    a = np.array([part.area * part.slope / airframe.wing.area for part in parts])
    return float(a @ d), float(-a @ l / c), float(-(a * l) @ d / c)
