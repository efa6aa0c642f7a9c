"""Motions of a segment in its own plane, which is rigid: x and y translation, and yaw."""

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.structure.component import Root

IN_PLANE: dict[Root, list[int]] = {Root.CLAMPED: [], Root.CARRIAGE: [0], Root.FREE: [0, 1, 2]}
"""In-plane rigid motions of a segment, of x and y translation and yaw about its origin."""

TWISTING = (0, 2)
"""In-plane motions that the twist of a folded wing drives."""


def in_plane_displacement(x: Real, y: Real, root: Root) -> Real:
    """Return displacements aft and outboard of points (m,) per in-plane motion, shape (m, 2, k)."""
    one, zero = np.ones_like(y), np.zeros_like(y)
    u = np.stack([np.stack([one, zero, -y], axis=1), np.stack([zero, one, x], axis=1)], axis=1)
    return np.asarray(u[:, :, IN_PLANE[root]])


def in_plane_mass(mass: float, by_x: float, by_y: float, polar: float) -> Real:
    """Return the mass matrix of translation along x and y and of yaw about the origin, (3, 3).

    Parameters
    ----------
    mass : float
        kg.
    by_x, by_y : float
        Integrals of x and y over the mass in kg m.
    polar : float
        Integral of x^2 + y^2 over the mass in kg m^2.
    """
    return np.array([[mass, 0.0, -by_y], [0.0, mass, by_x], [-by_y, by_x, polar]])


def with_twisting(torsion: Real, mass: Real, root: Root) -> Real:
    """Return a torsion mass with that of the in-plane motions that the twist drives.

    Parameters
    ----------
    torsion : array, shape (n, n)
        Of the motions out of the plane.
    mass : array, shape (n, n)
        Of all motions; those in the plane stand last.
    root : Root
    """
    first = len(mass) - len(IN_PLANE[root])
    driven = [first + i for i, motion in enumerate(IN_PLANE[root]) if motion in TWISTING]
    M = torsion.copy()
    M[np.ix_(driven, driven)] = mass[np.ix_(driven, driven)]
    return M
