"""Circulation that a strip sheds into the rows of its wake, per unit of its own.

With z = exp(step), step = p dx / b, row j = 0 .. rows - 1 carries omega_j = z^-(j+1) - z^-j. A
relaxation alpha lets the last row keep that share of its circulation: omega times z / (z - alpha).
"""

import numpy as np

from foldwing.maths.arrays import Complex

LARGEST_DECAY = 300.0
"""Logarithm of the ratio of the wake's ends beyond which a decaying motion is not evaluated."""


def shed(step: Complex, rows: int, relaxation: float) -> Complex:
    """Return omega_j for steps of shape (m,), (m, rows); nan beyond the largest decay."""
    powers = _powers(step, rows)
    omega = np.diff(powers, axis=1)
    if relaxation > 0.0:
        omega[:, -1] /= 1.0 - relaxation * powers[:, 1]
    return omega


def shed_with_derivative(step: Complex, rows: int, relaxation: float) -> tuple[Complex, Complex]:
    """Return omega_j and its derivative with respect to the step, each of shape (m, rows)."""
    powers = _powers(step, rows)
    omega = np.diff(powers, axis=1)
    slope = np.diff(-np.arange(rows + 1) * powers, axis=1)
    if relaxation > 0.0:
        fade = 1.0 / (1.0 - relaxation * powers[:, 1])
        slope[:, -1] = slope[:, -1] * fade - omega[:, -1] * relaxation * powers[:, 1] * fade**2
        omega[:, -1] *= fade
    return omega, slope


def _powers(step: Complex, rows: int) -> Complex:
    step = np.where(-step.real * rows > LARGEST_DECAY, np.nan, step)
    return np.asarray(np.exp(-np.multiply.outer(step, np.arange(rows + 1))))
