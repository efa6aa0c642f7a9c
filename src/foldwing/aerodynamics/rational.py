"""Rational approximation of generalized forces: one fit that stands for any aerodynamic model.

Qhat is sampled on p = ik and interpolated in barycentric form with support points z_s that all
entries share,

    R(p) = sum_s w_s F_s / (p - z_s)  /  sum_s w_s / (p - z_s).

Support points are taken one by one where the error is largest, weights from least squares over all
other samples (Y. Nakatsukasa, O. Sete and L. N. Trefethen, SIAM Journal on Scientific Computing 40,
2018; for many functions at once P. Lietaert, K. Meerbergen, J. Perez and B. Vandereycken, IMA
Journal of Numerical Analysis 42, 2022, here of a few random combinations of the entries). Samples
come with their conjugates, so that R is real on the real axis.

The approximation holds in the range of its samples and near it. A lattice whose wake is L long
rings like exp(-p L / b), which takes more samples the longer the wake and the wider the range.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.schemes import TimeScheme
from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Indices, Real

FEWEST = 8
"""Samples below which there is nothing to fit."""

COMBINATIONS = 8
"""Random combinations of the entries that choose the support points and weights."""

MARGIN = 0.1
"""Share of the tolerance that the combinations must meet, so that single entries meet it too."""

NEAR = 1e-9
"""Distance from a support point, relative to the range, within which R counts as its value."""


@dataclass(frozen=True)
class RationalModel:
    """Rational forces for the modes of a wing; obeys the port of aerodynamic models.

    Attributes
    ----------
    half_chord : float
        Reference length b of p in metres.
    highest_frequency : float
        Reduced frequency up to which samples were taken.
    largest_decay : float
        Decay -Re p up to which the model approximated holds.
    scheme : TimeScheme
        That of the model approximated.
    support, weights : array, shape (s,)
        z_s and w_s, with their conjugates.
    values : array, shape (s, n, n)
        F_s.
    steady : array, shape (n, n)
        Qhat(0) of the model approximated.
    apparent : array, shape (n, n)
        Its apparent mass of still air.
    has_apparent_mass : bool
        Whether all of its forces include those of apparent mass.
    error : float
        Largest error half way between samples, relative to the largest entry there.
    tolerance : float
        Error asked for.
    """

    half_chord: float
    highest_frequency: float
    largest_decay: float
    scheme: TimeScheme
    support: Complex
    weights: Complex
    values: Complex
    steady: Real
    apparent: Real
    has_apparent_mass: bool
    error: float
    tolerance: float

    @property
    def size(self) -> int:
        """Number n of modes."""
        return len(self.steady)

    @property
    def reached(self) -> bool:
        """Whether the error is within the tolerance; if not, more samples or a lower range help."""
        return self.error <= self.tolerance

    def forces(self, p: Complex) -> Complex:
        """Return Qhat at the values ``p`` of shape (m,), as an array (m, n, n)."""
        return self.forces_with_derivative(p)[0]

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n); the derivative is that of R."""
        p = np.asarray(p, complex)
        flat = self.values.reshape(len(self.values), -1)
        offset = p[:, None] - self.support
        row, own = np.nonzero(np.abs(offset) < NEAR * self.highest_frequency)
        offset[row, own] = np.inf
        share = self.weights / offset
        total = share.sum(axis=1)[:, None]
        value, slope = share / total, share / offset / total
        # On a support point both sums are infinite: R is its value there.
        value[row], slope[row] = 0.0, -share[row] / self.weights[own, None]
        value[row, own] = 1.0
        Q = value @ flat
        dQ = slope.sum(axis=1)[:, None] * Q - slope @ flat
        shape = (len(p), self.size, self.size)
        return Q.reshape(shape), dQ.reshape(shape)

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""
        return self.steady

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n) of the model approximated."""
        return self.apparent


def rational_model(
    model: AerodynamicModel, highest: float, count: int = 48, tolerance: float = 1e-8
) -> RationalModel:
    """Return the rational approximation of an aerodynamic model.

    Parameters
    ----------
    model : AerodynamicModel
    highest : float
        Reduced frequency up to which it is to hold; never beyond what the model itself holds for.
    count : int
        Number of samples.
    tolerance : float
        Error aimed at, relative to the largest entry. The result says whether it is reached.

    Raises
    ------
    InputError
        When there is no range, or there are too few samples or no positive tolerance.
    """
    _check(highest, count, tolerance)
    top = min(highest, model.highest_frequency)
    k = _frequencies(top, count)
    F = np.concatenate([[model.steady_forces().astype(complex)], model.forces(1j * k[1:])])
    chosen, w = _fit(1j * k, _combined(F), MARGIN * tolerance)
    pair = chosen[k[chosen] > 0.0]
    fitted = RationalModel(
        half_chord=model.half_chord,
        highest_frequency=top,
        largest_decay=model.largest_decay,
        scheme=model.scheme,
        support=1j * np.concatenate([k[chosen], -k[pair]]),
        weights=np.concatenate([w, w[k[chosen] > 0.0].conj()]),
        values=np.concatenate([F[chosen], F[pair].conj()]),
        steady=model.steady_forces(),
        apparent=model.apparent_mass(),
        has_apparent_mass=model.has_apparent_mass,
        error=np.inf,
        tolerance=tolerance,
    )
    between = 0.5j * (k[1:] + k[:-1])
    return replace(fitted, error=_largest_error(fitted, model, between))


def _check(highest: float, count: int, tolerance: float) -> None:
    if not 0.0 < highest < np.inf:
        remedy = "Take the highest reduced frequency that will be asked for."
        raise InputError("highest", highest, "must be positive and finite", remedy)
    if count < FEWEST:
        raise InputError("count", count, f"must be at least {FEWEST}", "The default is 48.")
    if not tolerance > 0.0:
        raise InputError("tolerance", tolerance, "must be positive", "The default is 1e-8.")


def _largest_error(fitted: RationalModel, model: AerodynamicModel, p: Complex) -> float:
    exact = model.forces(p)
    error = np.abs(fitted.forces(p) - exact).max(axis=(1, 2))
    return float((error / np.abs(exact).max(axis=(1, 2))).max())


def _frequencies(highest: float, count: int) -> Real:
    """Return reduced frequencies from 0 up, denser at both ends: forces with lag go like k ln k."""
    low = 2 * count // 5
    rest = np.sin(np.pi / 2.0 * np.arange(1, count - low) / (count - low - 1))
    return np.concatenate([[0.0], highest * np.sort([*np.geomspace(1e-6, 0.3, low), *rest])])


def _combined(F: Complex) -> Complex:
    """Return random combinations of the entries, all made equally large, (count, combinations)."""
    size = np.abs(F).max(axis=0)
    scale = np.sqrt(np.outer(size.max(axis=1), size.max(axis=0)))
    flat = (F / np.where(scale > 0.0, scale, 1.0)).reshape(len(F), -1)
    H = flat @ np.random.default_rng(0).standard_normal((flat.shape[1], COMBINATIONS))
    return np.asarray(H / np.abs(H).max(axis=0))


class _Fit(NamedTuple):
    chosen: Indices
    weights: Complex


def _fit(z: Complex, H: Complex, tolerance: float) -> _Fit:
    """Return which samples of H become support points in the upper half plane, and weights."""
    chosen: list[int] = []
    rest = np.arange(len(z))
    error = np.abs(H - H.mean(axis=0).real).max(axis=1)
    while True:
        chosen.append(int(rest[np.argmax(error)]))
        rest = np.delete(rest, np.argmax(error))
        w, approximate = _weights(z, H, np.array(chosen), rest)
        error = np.abs(H[rest] - approximate).max(axis=1)
        if error.max() < tolerance or 2 * len(chosen) >= len(z) - 1:
            return _Fit(np.array(chosen), w)


def _weights(z: Complex, H: Complex, chosen: Indices, rest: Indices) -> tuple[Complex, Complex]:
    """Return the weights of support points that fit the other samples best, and the fit there.

    Weights of conjugate points are conjugate, w = a + ib, so that a and b are real unknowns.
    """
    paired = z[chosen].imag > 0.0
    above = 1.0 / (z[rest, None] - z[chosen])
    below = paired / (z[rest, None] - z[chosen].conj())
    up = (H[rest, None] - H[chosen]) * above[:, :, None]
    down = (H[rest, None] - H[chosen].conj()) * below[:, :, None]
    A = np.concatenate([up + down, 1j * (up - down)[:, paired]], axis=1)
    A = np.moveaxis(A, 1, 2).reshape(-1, A.shape[1])
    unknown = np.linalg.svd(np.linalg.qr(np.vstack([A.real, A.imag]), mode="r"))[2][-1]
    w = unknown[: len(chosen)].astype(complex)
    w[paired] += 1j * unknown[len(chosen) :]
    above, below = above * w, below * w.conj()
    total = (above + below).sum(axis=1)[:, None]
    return w, (above @ H[chosen] + below @ H[chosen].conj()) / total
