"""An aircraft of wing and tail by its forces, without derivatives: nonlinear equations of motion.

Independent of `foldwing.flight`: written from forces, and differenced by the tests.
"""

import math
from dataclasses import dataclass

import numpy as np

from foldwing.model import Airframe, Surface

CESSNA = {
    "mass": 1020.0,
    "pitch_inertia": 838.0,
    "speed": 54.0,
    "gravity": 9.81,
    "density": 1.2,
    "centre_of_gravity": 0.0,
    "tail_arm": 4.572,
    "zero_lift_drag": 0.035,
    "wing": Surface(span=10.9728, chord=1.524, span_efficiency=0.93),
    "tail": Surface(span=3.048, chord=0.9144, span_efficiency=0.93),
}


def airframe(**changes):
    """Return the Cessna of the dissertation's table with some of its values changed."""
    return Airframe(**{**CESSNA, **changes})


@dataclass(frozen=True)
class Nonlinear:
    """Forces on an aircraft at (u, w, q, theta), in trim at its airspeed."""

    craft: Airframe

    def _slope(self, part):
        given = part.lift_slope
        if given is not None:
            return given
        return 2 * math.pi / (1 + 2 / (part.span_efficiency * part.span / part.chord))

    def trim_lift(self):
        """Lift coefficients of wing and tail: no net force down, no moment."""
        c = self.craft
        q = 0.5 * c.density * c.speed**2
        areas = [part.span * part.chord for part in (c.wing, c.tail)]
        forces = [q * area for area in areas]
        behind = [c.centre_of_gravity, -(c.tail_arm - c.centre_of_gravity)]
        moments = [force * arm for force, arm in zip(forces, behind, strict=True)]
        return np.linalg.solve([forces, moments], [c.mass * c.gravity, 0.0])

    def _drag(self, part, lift):
        aspect = part.span / part.chord
        return lift**2 / (math.pi * part.span_efficiency * aspect) if self.craft.drag else 0.0

    def forces(self, u, w, q):
        """Aerodynamic X and Z and the moment M about the centre of gravity."""
        c = self.craft
        speed, alpha = math.hypot(u, w), math.atan2(w, u)
        pressure = 0.5 * c.density * speed**2
        lift, moment = 0.0, 0.0
        drag = pressure * c.wing.area * (c.zero_lift_drag if c.drag else 0.0)
        for part, behind, start in zip(
            (c.wing, c.tail),
            (-c.centre_of_gravity, c.tail_arm - c.centre_of_gravity),
            self.trim_lift(),
            strict=True,
        ):
            still = start + self._slope(part) * alpha
            turning = still + self._slope(part) * q * (behind + part.chord / 2) / speed
            force = pressure * part.span * part.chord * turning
            drag += pressure * part.span * part.chord * self._drag(part, still)
            lift, moment = lift + force, moment - behind * force
        X = lift * math.sin(alpha) - drag * math.cos(alpha)
        Z = -lift * math.cos(alpha) - drag * math.sin(alpha)
        return X, Z, moment

    def rates(self, state):
        """Rates of (u, w, q, theta) under a constant thrust along x that balances the drag."""
        c = self.craft
        u, w, q, theta = state
        X, Z, M = self.forces(u, w, q)
        thrust = -self.forces(c.speed, 0.0, 0.0)[0]
        weight = c.mass * c.gravity
        return np.array(
            [
                (X + thrust - weight * math.sin(theta)) / c.mass - q * w,
                (Z + weight * math.cos(theta)) / c.mass + q * u,
                M / c.pitch_inertia,
                q,
            ]
        )

    def jacobian(self):
        """Rates differenced at level flight, shape (4, 4)."""
        level = np.array([self.craft.speed, 0.0, 0.0, 0.0])
        columns = []
        for index in range(4):
            step = np.zeros(4)
            step[index] = 1e-5 * (self.craft.speed if index < 2 else 1.0)
            difference = self.rates(level + step) - self.rates(level - step)
            columns.append(difference / (2 * step[index]))
        return np.array(columns).T
