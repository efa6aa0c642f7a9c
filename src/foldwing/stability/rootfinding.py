"""Roots of an analytic matrix function: counted, approximated by contour integrals, polished.

Problem: T(z) x = 0 with T of size n. The steps are independent of each other and know no physics;
``spectrum`` puts them together.
"""

from typing import NamedTuple, Protocol

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.domains import Domain, Ellipse

_LARGEST_TURN = 0.8
"""Largest change of arg det T in rad between neighbouring contour points."""

_FIRST_POINTS = 64
_MAX_BISECTIONS = 24

_MAX_NEWTON_STEPS = 30
_SETTLED = 1e-13
"""A Newton step this small, relative to the root, ends the iteration."""

_ACCEPTED_STEP = 1e-6
"""A root counts as found when its last step, relative to the region, is below this. It is lenient
because a multiple root is only known to a root of round-off."""

ACCEPTED_RESIDUAL = 1e-10
"""Largest residual, as ``residuals`` gives it for the size of the region, of a root."""

SAME = 1e-5
"""Roots closer than this, relative to the size of the region, are one multiple root."""


class MatrixFunction(Protocol):
    """An analytic matrix function T(z) of size n with its derivative."""

    def value(self, z: Complex) -> Complex:
        """Return T at the points ``z``, shape (m,), as an array of shape (m, n, n)."""

    def derivative(self, z: Complex) -> Complex:
        """Return dT/dz at the points ``z``, shape (m,), as an array of shape (m, n, n)."""


class RootList(NamedTuple):
    """Polished roots.

    Attributes
    ----------
    z : array of complex, shape (m,)
    x : array of complex, shape (n, m)
        Unit vectors.
    iterations : array of int, shape (m,)
        Newton steps.
    multiplicity : array of int, shape (m,)
    """

    z: Complex
    x: Complex
    iterations: Indices
    multiplicity: Indices

    def only(self, keep: Mask | Indices) -> "RootList":
        """Return the selected roots."""
        z, x, iterations, multiplicity = self
        return RootList(z[keep], x[:, keep], iterations[keep], multiplicity[keep])

    def joined(self, other: "RootList") -> "RootList":
        """Return the roots of both."""
        return RootList(*(np.concatenate(pair, axis=-1) for pair in zip(self, other, strict=True)))

    def distinct(self, distance: float) -> "RootList":
        """Keep the first of all roots that lie closer to each other than ``distance``."""
        close = np.abs(self.z[:, None] - self.z) < distance
        return self.only(~np.any(np.tril(close, -1), axis=1))

    def number_inside(self, region: Domain) -> int:
        """Return the number of roots inside, with multiplicities."""
        return int(self.multiplicity[region.contains(self.z)].sum())


def no_roots(n: int) -> RootList:
    """Return an empty list of roots of an n by n function."""
    z, x = np.empty(0, dtype=np.complex128), np.empty((n, 0), dtype=np.complex128)
    return RootList(z, x, np.empty(0, dtype=np.intp), np.empty(0, dtype=np.intp))


def count_roots(function: MatrixFunction, contour: Domain) -> int | None:
    """Count the zeros of det T inside a contour by the argument principle.

    The contour is bisected until arg det T changes by less than 0.8 rad from point to point, by
    the angle itself and by its rate tr(T^-1 T') at both ends: roots beside the contour are felt
    before it has stepped past them. Once more all along it as a confirmation.

    Parameters
    ----------
    function : MatrixFunction
        Must be analytic inside and on the contour (a pole would count as -1).
    contour : Domain

    Returns
    -------
    int or None
        Number of zeros with their multiplicities; None when the bisection does not settle,
        because a root lies on the contour or the contour crosses a branch cut.
    """
    t = np.linspace(0.0, 1.0, _FIRST_POINTS + 1)
    z = contour.points(t)
    phase, rate = _phase_and_rate(function, z)
    confirmed = False
    for _ in range(_MAX_BISECTIONS):
        if not np.all(np.abs(phase) > 0.5):
            return None
        turn = np.angle(phase[1:] * phase[:-1].conj())
        change = np.abs(np.diff(z)) * np.maximum(rate[1:], rate[:-1])
        wide = np.maximum(np.abs(turn), change) > _LARGEST_TURN
        if not wide.any():
            if confirmed:
                return round(float(turn.sum()) / (2 * np.pi))
            wide = np.ones_like(wide)
        confirmed = bool(wide.all())
        middle = (t[:-1][wide] + t[1:][wide]) / 2
        place = np.flatnonzero(wide) + 1
        added = contour.points(middle)
        t, z = np.insert(t, place, middle), np.insert(z, place, added)
        new_phase, new_rate = _phase_and_rate(function, added)
        phase, rate = np.insert(phase, place, new_phase), np.insert(rate, place, new_rate)
    return None


def _phase_and_rate(function: MatrixFunction, z: Complex) -> tuple[Complex, Real]:
    """Return det T/|det T|, 0 or NaN where it is undefined, and |d(log det T)/dz|."""
    T, slope = function.value(z), function.derivative(z)
    phase: Complex = np.linalg.slogdet(T)[0]
    singular = ~(np.abs(phase) > 0.5)
    T = np.where(singular[:, None, None], np.eye(T.shape[1]), T)
    rate = np.abs(np.trace(np.linalg.solve(T, slope), axis1=1, axis2=2))
    return phase, rate


def multiplicity(function: MatrixFunction, z: complex, others: Complex, size: float) -> int:
    """Count the root at ``z`` in a circle that is as small as ``SAME`` and the ``others`` demand.

    ``size`` is the size of the region, to which ``SAME`` refers. An unsettled count is taken as 1.
    """
    distances = np.abs(others - z)
    gaps = distances[distances > SAME * size]
    radius = min(2 * SAME * size, float(gaps.min(initial=np.inf)) / 3)
    return count_roots(function, Ellipse(z, (radius, radius))) or 1


def _solve(matrices: Complex, right: Complex) -> Complex:
    """Solve batched linear systems; a singular one gets its least-squares solution."""
    try:
        solution: Complex = np.asarray(np.linalg.solve(matrices, right), dtype=np.complex128)
    except np.linalg.LinAlgError:
        finite = np.isfinite(matrices).all(axis=(1, 2), keepdims=True)
        solution = np.linalg.pinv(np.where(finite, matrices, 0)) @ right
    return solution


def approximate_roots(
    function: MatrixFunction, region: Domain, rank: int, nodes: int
) -> tuple[Complex, Complex]:
    """Return approximate roots in a region from contour integrals.

    The method is that of W.-J. Beyn, Linear Algebra and its Applications 436 (2012), algorithm 2:
    the moments A_k = 1/(2 pi i) times the integral of s^k T^-1 V form block Hankel matrices with
    as many blocks as it takes to hold more roots than the matrix has rows.

    Parameters
    ----------
    function : MatrixFunction
    region : Domain
    rank : int
        Expected number of roots.
    nodes : int
        Quadrature nodes.

    Returns
    -------
    z : array of complex, shape (r,)
        More than ``rank`` when roots just outside show through the quadrature; none when T is
        not finite on the contour.
    x : array of complex, shape (n, r)
    """
    z, weights = region.quadrature(nodes)
    T = function.value(z)
    n = T.shape[-1]
    V = np.random.default_rng(0).standard_normal((n, n))
    blocks = rank // n + 2
    s = (z - region.center) / region.radius
    powers = s ** np.arange(2 * blocks)[:, None] * weights / (2j * np.pi)
    A = np.tensordot(powers, _solve(T, np.broadcast_to(V, T.shape)), axes=1)
    if not np.all(np.isfinite(A)):
        return no_roots(n)[:2]
    H0 = np.block([[A[i + j] for j in range(blocks)] for i in range(blocks)])
    H1 = np.block([[A[i + j + 1] for j in range(blocks)] for i in range(blocks)])
    U, S, Wh = np.linalg.svd(H0)
    r = min(max(rank, int(np.sum(S > 1e-8 * S[0]))), int(np.sum(S > 1e-15 * S[0])))
    B = U[:, :r].conj().T @ H1 @ Wh[:r].conj().T / S[:r]
    s, y = np.linalg.eig(B)
    return region.center + region.radius * s, U[:n, :r] @ y


def _norms(T: Complex) -> Real:
    """Return the 1-norms of matrices (m, n, n)."""
    norms: Real = np.abs(T).sum(axis=-2).max(axis=-1)
    return norms


def null_vectors(function: MatrixFunction, z: complex, count: int, size: float) -> Complex:
    """Return ``count`` unit null vectors (n, count) of T(z); missing ones repeat the last.

    ``size`` is the size of the region.
    """
    at = np.array([z])
    scale = (_norms(function.value(at)) + size * _norms(function.derivative(at)))[0]
    _, S, Vh = np.linalg.svd(function.value(at)[0])
    known = max(1, min(count, int(np.sum(ACCEPTED_RESIDUAL * scale >= S))))
    vectors: Complex = Vh[-1 - np.minimum(np.arange(count), known - 1)].conj().T
    return vectors


def residuals(function: MatrixFunction, z: Complex, x: Complex, size: float) -> Real:
    """Return the 2-norms of T x relative to T, shape (m,), for unit vectors x (n, m).

    The scale is the 1-norm of T plus ``size``, the size of the region, times that of dT/dz: so it
    remains meaningful where T vanishes altogether, as it does at the root of a single equation.
    """
    T = function.value(z)
    scale = _norms(T) + size * _norms(function.derivative(z))
    Tx = np.linalg.norm((T @ x.T[:, :, None])[:, :, 0], axis=1)
    relative: Real = np.divide(Tx, scale, out=np.zeros_like(Tx), where=scale != 0)
    return relative


def _newton_step(function: MatrixFunction, z: Complex, x: Complex) -> tuple[Complex, Complex]:
    """Return the steps of z (m,) and x (m, n) from the linearised T x = 0, x^H x = 1."""
    T, dT = function.value(z), function.derivative(z)
    scale = (_norms(T) + _norms(dT))[:, None, None]
    scale = np.where(scale > 0, scale, 1.0)
    T, dT = T / scale, dT / scale
    m, n = x.shape
    bordered = np.zeros((m, n + 1, n + 1), dtype=np.complex128)
    bordered[:, :n, :n] = T
    bordered[:, :n, n:] = dT @ x[:, :, None]
    bordered[:, n, :n] = x.conj()
    right = np.zeros((m, n + 1, 1), dtype=np.complex128)
    right[:, :n] = -T @ x[:, :, None]
    step = _solve(bordered, right)[:, :, 0]
    return step[:, n], step[:, :n]


def _normalized(x: Complex) -> Complex:
    unit: Complex = x / np.linalg.norm(x, axis=1, keepdims=True)
    return unit


def polished(function: MatrixFunction, z: Complex, x: Complex, size: float) -> RootList:
    """Polish approximate roots by Newton's method on (z, x), all at once.

    Parameters
    ----------
    function : MatrixFunction
    z : array of complex, shape (m,)
    x : array of complex, shape (n, m)
    size : float
        Size of the region: roots that move by more than twice this are given up.

    Returns
    -------
    RootList
        Those that converged, each with multiplicity 1. Several may be the same root.
    """
    z, x = z.copy(), _normalized(x.T)
    iterations = np.zeros(z.size, dtype=np.intp)
    last_step = np.full(z.size, np.inf)
    active = np.arange(z.size)
    for _ in range(_MAX_NEWTON_STEPS):
        dz, dx = _newton_step(function, z[active], x[active])
        near = np.isfinite(dz) & (np.abs(dz) < 2 * size)
        last_step[active[~near]] = np.inf
        active, dz, dx = active[near], dz[near], dx[near]
        z[active] += dz
        x[active] = _normalized(x[active] + dx)
        iterations[active] += 1
        last_step[active] = np.abs(dz)
        active = active[np.abs(dz) > _SETTLED * np.maximum(np.abs(z[active]), 1e-6 * size)]
        if not active.size:
            break
    settled = np.flatnonzero(last_step < _ACCEPTED_STEP * size)
    roots = RootList(z, x.T, iterations, np.ones(z.size, dtype=np.intp)).only(settled)
    return roots.only(residuals(function, roots.z, roots.x, size) < ACCEPTED_RESIDUAL)
