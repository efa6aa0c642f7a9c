"""Rotations about the stream axis."""

import numpy as np

from foldwing.maths.arrays import Real


def rotation_about_x(angle: float) -> Real:
    """Return the 3 x 3 matrix that turns a vector about +x by ``angle`` radians (y towards z)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
