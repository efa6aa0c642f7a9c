"""Newton's method on T(p, U) x = 0, for many roots at once.

A root is found through the bordered system

    [ T    u ] [ x ]   [ 0 ]
    [ v^H  0 ] [ g ] = [ 1 ],

whose scalar g(p, U) vanishes exactly where T is singular. With the left solution y of the
transposed system, dg = -y^T dT x, so that one factorization gives the function and its derivatives.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.problem import AeroelasticProblem, Evaluation, evaluate_with_derivatives

TOLERANCE = 1e-8
"""Relative size of the last Newton step at which a root counts as converged: convergence is
quadratic, so that the root itself is then good to round-off."""

ROUND_OFF = 1e-13
"""Residual below which a root counts as converged although its steps still dither."""


class Roots(NamedTuple):
    """Roots of T(p, U) x = 0 with the derivative of each along the airspeed.

    Attributes
    ----------
    p, speed : array, shape (m,)
    right, left : array, shape (m, n)
        Null vectors, T right = 0 and left^T T = 0, unit 2-norm.
    p_by_speed : array, shape (m,)
        dp/dU of the root.
    residual : array, shape (m,)
        2-norm of T x over the 1-norm of T.
    converged : array of bool, shape (m,)
    iterations : array of int, shape (m,)
    """

    p: Complex
    speed: Real
    right: Complex
    left: Complex
    p_by_speed: Complex
    residual: Real
    converged: Mask
    iterations: Indices

    def take(self, index: Indices) -> "Roots":
        """Return the roots at the positions ``index``, in that order."""
        return Roots._make(field[index] for field in self)


class _Bordered(NamedTuple):
    right: Complex
    left: Complex
    value: Complex
    by_p: Complex
    by_speed: Complex


def normalized(vectors: Complex) -> Complex:
    """Return the vectors scaled to unit 2-norm along the last axis; nan where T was not defined."""
    with np.errstate(invalid="ignore"):
        return np.asarray(vectors / np.sqrt((np.abs(vectors) ** 2).sum(axis=-1, keepdims=True)))


def null_vectors(matrices: Complex) -> tuple[Complex, Complex]:
    """Return right and left vectors of the smallest singular value, each of shape (m, n)."""
    W, _, Vh = np.linalg.svd(matrices)
    return Vh[:, -1, :].conj(), W[:, :, -1].conj()


def _bordered(T: Evaluation, right: Complex, left: Complex) -> _Bordered:
    """Solve the bordered system and its transpose with the present null vectors as borders."""
    m, n, _ = T.value.shape
    A = np.zeros((m, n + 1, n + 1), dtype=complex)
    scale = np.abs(T.value).max(axis=(1, 2))[:, None]
    scale = np.where(scale > 0.0, scale, 1.0)
    A[:, :n, :n] = T.value
    A[:, :n, n] = left.conj() * scale
    A[:, n, :n] = right.conj() * scale
    inverse = np.asarray(np.linalg.inv(A), complex)
    x, g, y = inverse[:, :n, n], inverse[:, n, n], inverse[:, n, :n]
    slopes = np.stack([T.by_p, T.by_speed]) @ x[:, :, None]
    g_p, g_U = -(y[:, None, :] @ slopes)[..., 0, 0]
    return _Bordered(normalized(x), normalized(y), g, g_p, g_U)


def _residual(T: Complex, x: Complex) -> Real:
    Tx = np.linalg.norm((T @ x[:, :, None])[..., 0], axis=1)
    size = np.maximum(np.abs(T).sum(axis=1).max(axis=1), np.finfo(float).tiny)
    return np.asarray(Tx / size)


def polish_roots(
    problem: AeroelasticProblem,
    p: Complex,
    speed: Real,
    borders: tuple[Complex, Complex] | None = None,
    iterations: int = 12,
    tolerance: Real | float = TOLERANCE,
) -> Roots:
    """Converge roots p of T(p, U) x = 0, each at its own fixed airspeed.

    Parameters
    ----------
    problem : AeroelasticProblem
    p : array of complex, shape (m,)
        Starting values.
    speed : array, shape (m,)
        Airspeeds in m/s.
    borders : pair of arrays, shape (m, n), optional
        Starting right and left null vectors; by default those of the smallest singular value.
    iterations : int
        Most Newton steps.
    tolerance : float or array, shape (m,)
        Relative size of the last step.

    Returns
    -------
    Roots
        Roots that did not converge are marked so; their values are those of the last step.
    """

    def step(border: _Bordered, p: Complex, _: Real) -> tuple[Complex, Real]:
        return -border.value / border.by_p, np.zeros(len(p))

    return _newton(problem, p, speed, borders, step, (iterations, tolerance))


def roots_at(problem: AeroelasticProblem, p: Complex, speed: Real) -> Roots:
    """Return vectors, residual and dp/dU at given (p, U), without moving them."""
    return polish_roots(problem, p, speed, iterations=0)


def polish_crossings(
    problem: AeroelasticProblem,
    reduced_frequency: Real,
    speed: Real,
    threshold: float = 0.0,
    iterations: int = 15,
) -> Roots:
    """Converge flutter points: real (k, U) with T(k (i - threshold), U) x = 0.

    Parameters
    ----------
    problem : AeroelasticProblem
    reduced_frequency, speed : array, shape (m,)
        Starting values of k and of U in m/s.
    threshold : float
        Damping ratio of the boundary, positive stable; 0 is the stability boundary.
    iterations : int
        Most Newton steps.
    """
    ray = 1j - threshold

    def step(border: _Bordered, p: Complex, speed: Real) -> tuple[Complex, Real]:
        g, g_k, g_U = border.value, border.by_p * ray, border.by_speed
        jacobian = g_k.real * g_U.imag - g_k.imag * g_U.real
        dk = -(g.real * g_U.imag - g.imag * g_U.real) / jacobian
        dU = -(g_k.real * g.imag - g_k.imag * g.real) / jacobian
        limit = 0.3
        k = p.imag
        shrink = np.minimum(1.0, limit / np.maximum(np.abs(dk / k), np.abs(dU / speed)))
        return dk * shrink * ray, dU * shrink

    p = np.asarray(reduced_frequency) * ray
    return _newton(problem, p, np.asarray(speed, float), None, step, (iterations, TOLERANCE))


def _newton(
    problem: AeroelasticProblem,
    p: Complex,
    speed: Real,
    borders: tuple[Complex, Complex] | None,
    step: Callable[[_Bordered, Complex, Real], tuple[Complex, Real]],
    limits: tuple[int, Real | float],
) -> Roots:
    iterations, tolerance = limits
    p, speed = np.array(p, complex), np.array(speed, float)
    T = evaluate_with_derivatives(problem, p, speed)
    border = _bordered(T, *(null_vectors(T.value) if borders is None else borders))
    active = np.ones(len(p), bool)
    converged = np.zeros(len(p), bool)
    counts = np.zeros(len(p), int)
    for _ in range(iterations):
        with np.errstate(all="ignore"):
            dp, dU = step(border, p, speed)
        active &= np.isfinite(dp) & np.isfinite(dU)
        p = np.where(active, p + dp, p)
        speed = np.where(active, speed + dU, speed)
        counts += active
        T = evaluate_with_derivatives(problem, p, speed)
        border = _bordered(T, border.right, border.left)
        small = (np.abs(dp) <= tolerance * np.abs(p)) & (np.abs(dU) <= tolerance * speed)
        converged |= active & small
        active &= ~small
        if not active.any():
            break
    with np.errstate(divide="ignore", invalid="ignore"):
        p_by_speed = -border.by_speed / border.by_p
    residual = _residual(T.value, border.right)
    converged |= active & (residual < ROUND_OFF)
    return Roots(p, speed, border.right, border.left, p_by_speed, residual, converged, counts)
