"""The p-k method: damped roots with the aerodynamics of undamped motion.

Source: H. J. Hassig, Journal of Aircraft 8 (1971), pages 885-889.
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from foldwing.conventions import hertz
from foldwing.maths.arrays import Complex, Indices, Real
from foldwing.stability.classical import Crossing, increasing, linearized, on_axis
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.status import Status

_MAX_ITERATIONS = 100
_LINED_UP = 1e-11
"""Relative difference between k and Im p at which the p-k iteration ends."""

_OVERDAMPED = 1e-9
"""Im p below which a p-k root counts as real."""


class InertialProblem(AeroelasticProblem, Protocol):
    """An aeroelastic problem that also tells the mass of the structure.

    Its coefficient T1 has to be proportional to p, as that of viscous damping is, and T0 - U^2 T2
    less the inertia must be stiffness and forces alone: no column may be divided by p or U.
    """

    @property
    def mass(self) -> Real:
        """Structural mass matrix without air, shape (n, n), in the coordinates of T."""


@dataclass(frozen=True)
class PkResult:
    """Eigenvalues of the p-k method, one column per elastic mode.

    Attributes
    ----------
    speed : array, shape (s,)
        Airspeeds in m/s, increasing.
    eigenvalues : array of complex, shape (s, r)
        lambda in 1/s and rad/s; NaN where the status is not ``OK``.
    vectors : array of complex, shape (s, n, r)
        Unit eigenvectors; NaN likewise.
    status : array of int, shape (s, r)
        Values of ``Status``: ``NOT_CONVERGED``, ``COLLAPSED`` (two modes found one root) or
        ``LEFT_DOMAIN`` (overdamped; the mode is not followed any further).
    """

    speed: Real
    eigenvalues: Complex
    vectors: Complex
    status: NDArray[np.int_]


class _Modes(NamedTuple):
    """Roots lambda (r,) and unit vectors (n, r)."""

    roots: Complex
    vectors: Complex

    def only(self, keep: Indices) -> "_Modes":
        """Return the selected modes."""
        return _Modes(self.roots[keep], self.vectors[:, keep])


def _eigenpairs(companion: Complex) -> tuple[Complex, Complex]:
    """Return the eigenvalues (m, 2n) and the upper halves (m, n, 2n) of the vectors, unit."""
    values, vectors = np.linalg.eig(companion)
    upper = vectors[:, : companion.shape[-1] // 2]
    return values, upper / np.linalg.norm(upper, axis=1, keepdims=True)


@dataclass(frozen=True)
class _Pk:
    """The p-k equations lambda^2 M + lambda C + T0(i k) - U^2 Q(i k) = 0."""

    problem: InertialProblem

    def eigenpairs(self, k: Real, speed: float) -> tuple[Complex, Complex]:
        """Return the 2n eigenvalues (m, 2n) and unit vectors (m, n, 2n) for each k."""
        b, M = self.problem.half_chord, self.problem.mass
        T0, _, T2 = self.problem.pencil(on_axis(k))
        # U^2 T2 = lambda^2 M - U^2 Q at p = i k: without the inertia, the aerodynamics remain.
        minus_Q: Complex = T2 + (k[:, None, None] / b) ** 2 * M
        mass = np.broadcast_to(M.astype(np.complex128), minus_Q.shape)
        stiffness = np.asarray(T0 + speed**2 * minus_Q, dtype=np.complex128)
        companion = linearized(stiffness, self._damping(mass.shape), mass)
        return _eigenpairs(companion)

    def _damping(self, shape: tuple[int, ...]) -> Complex | None:
        """Return C from T1 = (p/b) C, for all k the same."""
        T1 = self.problem.pencil(np.ones(1, dtype=np.complex128)).linear
        return None if T1 is None else np.broadcast_to(self.problem.half_chord * T1, shape)

    def lined_up(self, guess: _Modes, speed: float) -> tuple[_Modes, NDArray[np.int_]]:
        """Iterate until k = Im p for each guess; return the modes and their status (r,)."""
        roots, vectors = guess.roots.copy(), guess.vectors.copy()
        status = np.full(roots.size, Status.NOT_CONVERGED, dtype=np.int_)
        per_k = speed / self.problem.half_chord
        open_ = np.arange(roots.size)
        for _ in range(_MAX_ITERATIONS):
            k = np.maximum(roots[open_].imag / per_k, 0.0)
            choices, shapes = self.eigenpairs(k, speed)
            best = _most_alike(roots[open_], vectors[:, open_], choices, shapes)
            row = np.arange(open_.size)
            roots[open_], vectors[:, open_] = choices[row, best], shapes[row, :, best].T
            reached = roots[open_].imag / per_k
            done = np.abs(reached - k) <= _LINED_UP * np.maximum(k, _OVERDAMPED)
            real = (reached <= _OVERDAMPED) & (k <= _OVERDAMPED)
            status[open_[done]] = Status.OK
            status[open_[real]] = Status.LEFT_DOMAIN
            open_ = open_[~(done | real)]
            if not open_.size:
                break
        return _Modes(roots, vectors), _with_collapsed(roots, status)


def _most_alike(old: Complex, old_vectors: Complex, new: Complex, vectors: Complex) -> Indices:
    """Return which of the new pairs (m, 2n), (m, n, 2n) continue the old (m,), (n, m)."""
    distance = np.abs(new - old[:, None]) / np.abs(old)[:, None]
    likeness = np.abs(np.einsum("im,mij->mj", old_vectors.conj(), vectors))
    best: Indices = np.argmin(distance - likeness, axis=1)
    return best


def _with_collapsed(roots: Complex, status: NDArray[np.int_]) -> NDArray[np.int_]:
    """Mark the converged modes that ended on one root."""
    close = np.abs(roots[:, None] - roots) < 1e-8 * np.abs(roots)
    valid = status == Status.OK
    same = (close & valid[:, None] & valid).sum(axis=1) > 1
    return np.where(same, Status.COLLAPSED, status)


def _still_air_modes(problem: InertialProblem) -> _Modes:
    """Return the oscillating modes at rest, by increasing frequency."""
    still = problem.still_air()
    matrices = np.stack([still.mass, still.damping, still.stiffness]).astype(np.complex128)
    M, C, K = matrices[:, None]
    values, vectors = _eigenpairs(linearized(K, C, M))
    chosen = np.argsort(values[0].imag)[np.count_nonzero(values[0].imag <= 0) :]
    whole = np.zeros((problem.size, chosen.size), dtype=np.complex128)
    whole[still.columns] = vectors[0][:, chosen]
    return _Modes(values[0, chosen], whole)


def pk(problem: InertialProblem, speeds: Real) -> PkResult:
    """Follow the elastic modes over airspeed with the p-k method.

    At each airspeed and for each mode

        [lambda^2 M + lambda C + T0(i k) - U^2 Q(i k)] x = 0

    is solved with the complex aerodynamics Q at p = i k only, k iterated until k = Im p. Modes
    start from still air and are followed by linear extrapolation over airspeed.

    Parameters
    ----------
    problem : InertialProblem
    speeds : array, shape (s,)
        Airspeeds in m/s, increasing, positive, close enough to follow the modes.

    Returns
    -------
    PkResult

    Raises
    ------
    InputError
        For airspeeds that are not increasing and positive.
    """
    U = increasing("speeds", speeds)
    method = _Pk(problem)
    roots, vectors = _still_air_modes(problem)
    shape = (U.size, roots.size)
    eigenvalues = np.full(shape, np.nan, dtype=np.complex128)
    shapes = np.full((U.size, *vectors.shape), np.nan, dtype=np.complex128)
    status = np.full(shape, Status.LEFT_DOMAIN, dtype=np.int_)
    active = np.arange(roots.size)
    last_speed, slope = 0.0, np.zeros_like(roots)
    for i, speed in enumerate(U.tolist()):
        # A mode that fails goes on from where it was expected.
        guess = roots + slope * (speed - last_speed)
        modes, status[i, active] = method.lined_up(_Modes(guess, vectors).only(active), speed)
        found = status[i, active] == Status.OK
        guess[active[found]] = modes.roots[found]
        vectors[:, active[found]] = modes.vectors[:, found]
        slope, roots, last_speed = (guess - roots) / (speed - last_speed), guess, speed
        done = active[found]
        eigenvalues[i, done], shapes[i][:, done] = roots[done], vectors[:, done]
        active = active[status[i, active] != Status.LEFT_DOMAIN]
    return PkResult(U, eigenvalues, shapes, status)


def pk_flutter(
    problem: InertialProblem, result: PkResult, *, accuracy: float = 1e-9
) -> tuple[Crossing, ...]:
    """Return the airspeeds at which Re lambda of a p-k mode is zero, by increasing airspeed.

    Each sign change between neighbouring airspeeds is closed in on by solving the p-k equations
    again, not by interpolation.

    Parameters
    ----------
    problem : InertialProblem
    result : PkResult
        Of the same problem.
    accuracy : float
        Relative accuracy of the airspeed.

    Returns
    -------
    tuple of Crossing
        Oscillating crossings only: divergence is not among them.
    """
    method = _Pk(problem)
    growth = result.eigenvalues.real
    known = np.isfinite(growth[:-1]) & np.isfinite(growth[1:])
    rows, modes = np.nonzero(known & ((growth[:-1] < 0) != (growth[1:] < 0)))
    points = [
        _closed_in(method, result, i, mode, accuracy)
        for i, mode in zip(rows.tolist(), modes.tolist(), strict=True)
    ]
    return tuple(sorted(points, key=lambda point: point.speed))


def _closed_in(method: _Pk, result: PkResult, i: int, mode: int, accuracy: float) -> Crossing:
    """Return the crossing of one mode between the airspeeds i and i + 1."""
    (U0, U1), (z0, z1) = result.speed[i : i + 2], result.eigenvalues[i : i + 2, mode]
    x0 = result.vectors[i, :, mode : mode + 1]

    def root(speed: float) -> complex:
        if speed in (U0, U1):
            # The bracket is the known one: solved again, a zero could change its sign.
            return complex(z0 if speed == U0 else z1)
        guess = np.array([z0 + (z1 - z0) * (speed - U0) / (U1 - U0)])
        return complex(method.lined_up(_Modes(guess, x0), speed)[0].roots[0])

    tolerance = accuracy * U1
    speed = float(brentq(lambda U: root(U).real, U0, U1, xtol=tolerance, rtol=1e-14))
    z = root(speed)
    omega = z.imag
    # What is left of Re lambda counts too, should the iteration have failed inside the bracket.
    missed = abs(z.real) * (U1 - U0) / abs(z1.real - z0.real)
    event = "onset" if z1.real > z0.real else "recovery"
    k = omega * method.problem.half_chord / speed
    return Crossing(event, speed, hertz(omega), k, mode, float(tolerance + missed))
