"""Determinant contours: the brute-force picture of all roots at one airspeed.

The lines Re det T = 0 and Im det T = 0 are drawn over the plane of lambda; the roots lie where
they cross. No root can be lost to a bad starting value, but the cost is one determinant for each
grid point and the accuracy is that of the grid. It serves pictures and independent checks.
"""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Mask, Real
from foldwing.stability.problem import AeroelasticProblem, evaluate

Array = TypeVar("Array", Complex, Real)

_CHUNK_ENTRIES = 150_000
"""Matrix entries of T evaluated at once (2.4 MB): large enough to amortise the calls of numpy,
small enough to stay in the cache."""

_EDGE = 1e-9
"""Roots this far outside a cell, in cell sizes, still count: a root on an edge must not be lost
to round-off in both cells."""

_SAME = 1e-6
"""Roots of neighbouring cells closer than this, in cell sizes, are one root on their edge."""


@dataclass(frozen=True)
class DeterminantMap:
    """Determinant of T over a grid of lambda = growth + i angular_frequency at one airspeed.

    The determinant is kept as phase and logarithm, which cannot overflow. Multiplying it by a
    positive number moves none of its zero lines.

    Attributes
    ----------
    speed : float
        Airspeed in m/s.
    growth : array, shape (g,)
        Re lambda in 1/s, increasing.
    angular_frequency : array, shape (w,)
        Im lambda in rad/s, increasing and positive.
    phase : array of complex, shape (g, w)
        det T / |det T|; 0 where the determinant is exactly 0.
    log_magnitude : array, shape (g, w)
        Natural logarithm of |det T|.
    """

    speed: float
    growth: Real
    angular_frequency: Real
    phase: Complex
    log_magnitude: Real

    @property
    def determinant(self) -> Complex:
        """The determinant over its largest magnitude on the grid, shape (g, w)."""
        log = self.log_magnitude
        return self.phase * np.exp(log - np.max(log, initial=-np.inf, where=np.isfinite(log)))


def _checked_axis(name: str, values: Real) -> Real:
    axis = np.array(values, dtype=np.float64)
    if axis.ndim != 1 or axis.size < 2 or not np.all(np.diff(axis) > 0):
        limit = "must be at least two increasing numbers"
        raise InputError(name, axis.shape, limit, "Give a one-dimensional, increasing grid.")
    return axis


def determinant_map(
    problem: AeroelasticProblem, speed: float, growth: Real, angular_frequency: Real
) -> DeterminantMap:
    """Return the determinant of T at one airspeed over a grid of lambda.

    Parameters
    ----------
    problem : AeroelasticProblem
    speed : float
        Airspeed U in m/s, positive.
    growth : array, shape (g,)
        Re lambda in 1/s, increasing.
    angular_frequency : array, shape (w,)
        Im lambda in rad/s, increasing. It must be positive: the aerodynamics have a branch cut
        along the negative real axis.

    Returns
    -------
    DeterminantMap

    Raises
    ------
    InputError
        For a speed that is not positive or an unsuitable grid.
    """
    growth = _checked_axis("growth", growth)
    frequency = _checked_axis("angular_frequency", angular_frequency)
    if frequency[0] <= 0:
        limit = "must be greater than 0 rad/s"
        remedy = "Leave out the real axis, along which the aerodynamics have a branch cut."
        raise InputError("angular_frequency", float(frequency[0]), limit, remedy)
    if not speed > 0:
        raise InputError("speed", speed, "must be greater than 0 m/s", "Raise the airspeed.")
    eigenvalues = np.asarray(growth[:, None] + 1j * frequency, dtype=np.complex128)
    p = eigenvalues.ravel() * (problem.half_chord / speed)
    phase = np.empty(p.shape, dtype=np.complex128)
    log_magnitude = np.empty(p.shape)
    step = max(1, _CHUNK_ENTRIES // problem.size**2)
    for start in range(0, p.size, step):
        part = slice(start, start + step)
        T = evaluate(problem, p[part], np.full(p[part].shape, speed))
        phase[part], log_magnitude[part] = np.linalg.slogdet(T)
    grid = (growth.size, frequency.size)
    return DeterminantMap(
        speed, growth, frequency, phase.reshape(grid), log_magnitude.reshape(grid)
    )


def _corners(values: Array) -> Array:
    """Return the values at the corners 00, 10, 01, 11 of all cells, shape (4, g - 1, w - 1)."""
    v = values
    return np.stack([v[:-1, :-1], v[1:, :-1], v[:-1, 1:], v[1:, 1:]])


def _crosses_zero(values: Real) -> Mask:
    crosses: Mask = (values.min(axis=0) <= 0) & (values.max(axis=0) >= 0)
    return crosses


def _corner_values(phase: Complex, log_magnitude: Real) -> Complex:
    """Return the determinant at the corners (4, m) of m cells, each cell with its own scale."""
    highest = log_magnitude.max(axis=0)
    scaled = np.exp(log_magnitude - np.where(np.isfinite(highest), highest, 0.0))
    values: Complex = phase * scaled
    return values


def _bilinear_roots(f: Complex) -> tuple[Real, Real]:
    """Return both zeros (s, t) of a + b s + c t + d s t in each of m cells, shape (2, m).

    ``f`` holds the corner values (4, m) at (s, t) = 00, 10, 01, 11. Re and Im vanish together;
    elimination of t leaves Im((a + b s) conj(c + d s)) = 0, a real quadratic in s. Zeros that do
    not exist or at which the map reverses its orientation (the sign of a pole or of a grid too
    coarse, since det T is analytic) are NaN.
    """
    a, b, c, d = f[0], f[1] - f[0], f[2] - f[0], f[3] - f[2] - f[1] + f[0]
    q0, q2 = (a * c.conj()).imag, (b * d.conj()).imag
    q1 = (a * d.conj() + b * c.conj()).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        # The form without cancellation: it also covers q2 = 0, the usual case on a fine grid.
        q = -(q1 + np.copysign(np.sqrt(q1**2 - 4 * q0 * q2), q1)) / 2
        s = np.stack([q0 / q, q / q2])
        slope = c + d * s
        t = -((a + b * s) * slope.conj()).real / np.abs(slope) ** 2
        positive = ((b + d * t).conj() * slope).imag > 0
    return np.where(positive, s, np.nan), np.where(positive, t, np.nan)


def _distinct(positions: Complex) -> Complex:
    """Drop the roots that two cells found on their common edge; in units of cells."""
    close = np.abs(positions[:, None] - positions) < _SAME
    first: Mask = ~np.any(np.tril(close, -1), axis=1)
    return positions[first]


def contour_roots(contours: DeterminantMap) -> Complex:
    """Return the approximate eigenvalues where the zero lines of a determinant map cross.

    In every cell the determinant is interpolated bilinearly; the error of a simple root falls
    with the square of the cell size. Two roots inside one cell cannot be told apart.

    Parameters
    ----------
    contours : DeterminantMap

    Returns
    -------
    array of complex, shape (m,)
        Eigenvalues lambda (1/s and rad/s), by increasing Im lambda.
    """
    corners = _corners(contours.phase)
    i, j = np.nonzero(_crosses_zero(corners.real) & _crosses_zero(corners.imag))
    logs = _corners(contours.log_magnitude)
    s, t = _bilinear_roots(_corner_values(corners[:, i, j], logs[:, i, j]))
    with np.errstate(invalid="ignore"):
        inside = (np.abs(s - 0.5) <= 0.5 + _EDGE) & (np.abs(t - 0.5) <= 0.5 + _EDGE)
    position = _distinct((i + s)[inside] + 1j * (j + t)[inside])
    growth, frequency = contours.growth, contours.angular_frequency
    roots = np.interp(position.real, np.arange(growth.size), growth) + 1j * np.interp(
        position.imag, np.arange(frequency.size), frequency
    )
    ordered: Complex = roots[np.argsort(roots.imag)]
    return ordered
