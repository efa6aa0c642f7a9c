"""What the industry's flutter methods, V-g and p-k, have in common.

Both know the aerodynamics on the imaginary axis p = i k only. Where a root crosses that axis their
equations become the exact one, so the flutter points agree with T(i k, U) x = 0; elsewhere their
damping is an approximation. They are here for comparison.
"""

from typing import NamedTuple

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Real


class Crossing(NamedTuple):
    """A neutrally stable point of one mode.

    Attributes
    ----------
    event : str
        ``onset`` or ``recovery`` with increasing airspeed.
    speed : float
        Airspeed in m/s.
    frequency : float
        Frequency in Hz.
    reduced_frequency : float
        k = omega b / U.
    mode : int
        Column of the mode in the arrays of the method.
    accuracy : float
        Estimated error of ``speed`` in m/s.
    """

    event: str
    speed: float
    frequency: float
    reduced_frequency: float
    mode: int
    accuracy: float


def increasing(name: str, values: Real) -> Real:
    """Return the values as an array; raise an InputError unless positive and increasing."""
    array = np.array(values, dtype=np.float64)
    if array.ndim != 1 or not array.size or not array[0] > 0 or np.any(np.diff(array) <= 0):
        limit = "must be increasing numbers greater than 0"
        raise InputError(name, array.tolist(), limit, "Sort them and leave out zero.")
    return array


def on_axis(k: Real) -> Complex:
    """Return p = i k."""
    return np.asarray(1j * k, dtype=np.complex128)


def linearized(constant: Complex, linear: Complex | None, quadratic: Complex) -> Complex:
    """Return companion matrices (m, 2n, 2n) of constant + nu linear + nu^2 quadratic = 0."""
    m, n, _ = quadratic.shape
    companion = np.zeros((m, 2 * n, 2 * n), dtype=np.complex128)
    companion[:, :n, n:] = np.eye(n)
    companion[:, n:, :n] = -np.linalg.solve(quadratic, np.broadcast_to(constant, quadratic.shape))
    if linear is not None:
        companion[:, n:, n:] = -np.linalg.solve(quadratic, linear)
    return companion
