"""Rigid bodies joined to the root of the wing: fuselage and tail of an aircraft.

A body whose centre of mass lies x aft of the elastic axis moves as the root takes it along, by u
and w - x theta, theta nose up: its coordinates are gone before they appear, and its mass and
inertia are terms of the mass matrix of segment 1.
"""

from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.model import Aircraft
from foldwing.structure.component import ComponentModes


class RigidBody(NamedTuple):
    """A body fixed to the root, on the plane of symmetry.

    Attributes
    ----------
    name : str
    mass : float
        kg.
    inertia : float
        About its centre of mass in pitch, kg m^2.
    x : float
        Of its centre of mass aft of the elastic axis of segment 1, in metres.
    """

    name: str
    mass: float
    inertia: float
    x: float

    def displacement(self, root: ComponentModes) -> Real:
        """Return the displacement of its centre per coordinate of segment 1, shape (3, n)."""
        return np.asarray(root.displacement(np.array([self.x]), np.zeros(1))[0])

    def mass_matrix(self, root: ComponentModes) -> Real:
        """Return its mass and inertia in the coordinates of segment 1, shape (n, n)."""
        u = self.displacement(root)
        theta = root.section_motion(np.zeros(1)).twist[0]
        return np.asarray(self.mass * u.T @ u + self.inertia * np.outer(theta, theta))


def rigid_bodies(aircraft: Aircraft | None) -> tuple[RigidBody, ...]:
    """Return fuselage and tail; none when the root is clamped."""
    if aircraft is None:
        return ()
    parts = (("fuselage", aircraft.fuselage), ("tail", aircraft.tail))
    return tuple(RigidBody(name, body.mass, body.pitch_inertia, body.x) for name, body in parts)
