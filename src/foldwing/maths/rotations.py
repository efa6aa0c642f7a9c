"""Rotations in space."""

import numpy as np

from foldwing.maths.arrays import Real


def rotation_about_x(angle: float) -> Real:
    """Return the 3 x 3 matrix that turns a vector about +x by ``angle`` radians (y towards z)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def rotation_about(axis: Real, angle: float) -> Real:
    """Return the 3 x 3 matrix that turns a vector about a unit vector (O. Rodrigues).

    About +x it is `rotation_about_x` to the last digit.
    """
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = axis
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    along = np.outer(axis, axis)
    return np.asarray(along + c * (np.eye(3) - along) + s * across)
