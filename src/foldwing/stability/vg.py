"""The V-g method: artificial damping over airspeed.

Source: R. L. Bisplinghoff, H. Ashley, R. L. Halfman, Aeroelasticity (1955), section 9-5.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from foldwing.maths.arrays import Complex, Real
from foldwing.stability.classical import Crossing, increasing, linearized, on_axis
from foldwing.stability.problem import AeroelasticProblem


@dataclass(frozen=True)
class VgResult:
    """Curves of the V-g method, one column per mode; NaN where no airspeed belongs to k.

    Attributes
    ----------
    reduced_frequency : array, shape (m,)
        Decreasing.
    speed : array, shape (m, n)
        Airspeed in m/s.
    damping : array, shape (m, n)
        Artificial structural damping g that would keep the motion harmonic: negative where the
        motion is stable.
    frequency : array, shape (m, n)
        Frequency in Hz.
    """

    reduced_frequency: Real
    speed: Real
    damping: Real
    frequency: Real


def _vg_eigenvalues(problem: AeroelasticProblem, k: Real) -> tuple[Complex, Complex]:
    """Return nu = U / sqrt(1 + i g), shape (m, n), and eigenvectors (m, n, n) at p = i k."""
    T0, T1, T2 = problem.pencil(on_axis(k))
    n = problem.size
    if T1 is None:
        pencil = -np.linalg.solve(T2, np.broadcast_to(T0, T2.shape))
        squares, vectors = np.linalg.eig(pencil)
        return np.sqrt(squares), vectors
    nu, vectors = np.linalg.eig(linearized(T0, T1, T2))
    best = np.argsort(-nu.real, axis=1)[:, :n]
    nu = np.take_along_axis(nu, best, axis=1)
    return nu, np.take_along_axis(vectors[:, :n], best[:, None, :], axis=2)


def _in_tracked_order(values: Complex, vectors: Complex) -> Complex:
    """Sort the columns of ``values`` (m, n) so that each follows one mode from row to row."""
    unit = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    tracked = values.copy()
    order = np.argsort(np.abs(values[0]))
    tracked[0] = values[0, order]
    previous = unit[0][:, order]
    for row in range(1, len(values)):
        old, new = tracked[row - 1][:, None], values[row]
        distance = np.abs(new - old) / (np.abs(new) + np.abs(old) + np.finfo(float).tiny)
        likeness = np.abs(previous.conj().T @ unit[row])
        order = linear_sum_assignment(distance - likeness)[1]
        tracked[row] = values[row, order]
        previous = unit[row][:, order]
    return tracked


def vg(problem: AeroelasticProblem, reduced_frequencies: Real) -> VgResult:
    """Return the curves of the V-g method.

    At p = i k the stiffness is given an artificial hysteretic damping g that makes the motion
    harmonic,

        (1 + i g) T0 + U T1 + U^2 T2(i k) = 0.

    With nu = U / sqrt(1 + i g) it becomes the eigenvalue problem T0 + nu T1 + nu^2 T2 = 0, from
    which 1/U^2 = Re(nu^-2) and g = Im(nu^-2) U^2. Viscous damping T1 is thereby multiplied by
    sqrt(1 + i g) too: an approximation for g different from zero, exact where g = 0.

    Parameters
    ----------
    problem : AeroelasticProblem
    reduced_frequencies : array, shape (m,)
        Values of k = omega b / U, increasing and positive; close enough to each other that the
        modes can be followed.

    Returns
    -------
    VgResult

    Raises
    ------
    InputError
        For reduced frequencies that are not increasing and positive.
    """
    k = increasing("reduced_frequencies", reduced_frequencies)[::-1]
    nu = _in_tracked_order(*_vg_eigenvalues(problem, k))
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse_square = nu**-2.0
        real = np.where(inverse_square.real > 0, inverse_square.real, np.nan)
        speed = 1 / np.sqrt(real)
        damping = inverse_square.imag / real
    frequency = k[:, None] * speed / (2 * np.pi * problem.half_chord)
    return VgResult(k, speed, damping, frequency)


def vg_flutter(result: VgResult) -> tuple[Crossing, ...]:
    """Return the points at which g crosses zero, by increasing airspeed.

    They come from quadratic interpolation in k through three neighbouring points. ``accuracy`` is
    the distance to the linear interpolation through two: a cautious estimate of the error.
    """
    g = result.damping
    with np.errstate(invalid="ignore"):
        rows, modes = np.nonzero((g[:-1] < 0) != (g[1:] < 0))
    points = []
    for i, mode in zip(rows.tolist(), modes.tolist(), strict=True):
        if np.all(np.isfinite(g[i : i + 2, mode])):
            points.append(_interpolated(result, i, mode))
    return tuple(sorted(points, key=lambda point: point.speed))


def _interpolated(result: VgResult, i: int, mode: int) -> Crossing:
    """Return the crossing between the rows i and i + 1 of one mode."""
    k, g, U = result.reduced_frequency, result.damping[:, mode], result.speed[:, mode]
    share = g[i] / (g[i] - g[i + 1])
    k_star = k[i] + share * (k[i + 1] - k[i])
    linear = speed = U[i] + share * (U[i + 1] - U[i])
    third = [j for j in (i - 1, i + 2) if 0 <= j < k.size and np.isfinite(g[j])]
    if third:
        rows = [i, i + 1, third[0]]
        quadratic = np.polynomial.Polynomial.fit(k[rows], g[rows], 2)
        candidates = quadratic.roots()
        k_star = candidates[np.abs(candidates - k_star).argmin()].real
        speed = np.polynomial.Polynomial.fit(k[rows], U[rows], 2)(k_star)
    event = "onset" if (g[i + 1] - g[i]) * (U[i + 1] - U[i]) > 0 else "recovery"
    frequency = k_star / k[i] * speed / U[i] * result.frequency[i, mode]
    accuracy = abs(speed - linear) if third else abs(U[i + 1] - U[i])
    return Crossing(event, float(speed), float(frequency), float(k_star), mode, float(accuracy))
