"""Damping and frequency of the motions in a response, by eigensystem realization.

Free vibrations are sums of exp(lambda t). Samples of many outputs in a Hankel matrix have the rank
of the number of such terms; its singular vectors give the matrix that advances the motion by one
sample, whose eigenvalues are exp(lambda dt) (J.-N. Juang and R. S. Pappa, Journal of Guidance,
Control, and Dynamics 8, 1985).
"""

from dataclasses import dataclass

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Indices, Real

MOST_COLUMNS, MOST_ROWS = 600, 600
"""Size of the Hankel matrix, whose samples are taken evenly from the record."""

LONGEST_GROWTH = 300.0
"""A factor that would grow by more than exp of this over the record is no motion but noise."""

RANK_TOLERANCE = 1e-9
"""Singular values below this fraction of the largest are round-off."""


@dataclass(frozen=True)
class Identified:
    """Motions found in a response, the strongest at the end of it first.

    Attributes
    ----------
    eigenvalues : array of complex, shape (r,)
        lambda in rad/s, Im lambda >= 0: each oscillating motion once.
    shapes : array of complex, shape (r, m)
        Of the m outputs at the first sample used: with t from there on, the response is the sum of
        Re(shape exp(lambda t)).
    residual : float
        What the motions do not explain, as a fraction of the response, both as 2-norms over the
        samples used.
    order : int
        Rank of the Hankel matrix.
    """

    eigenvalues: Complex
    shapes: Complex
    residual: float
    order: int

    @property
    def frequencies(self) -> Real:
        """Frequencies in Hz, shape (r,)."""
        return np.asarray(self.eigenvalues.imag / (2.0 * np.pi))

    @property
    def dampings(self) -> Real:
        """Damping ratios -Re/|Im|, positive when stable, nan for motions that do not oscillate."""
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = -self.eigenvalues.real / np.abs(self.eigenvalues.imag)
        return np.where(self.eigenvalues.imag == 0.0, np.nan, ratio)

    def nearest(self, eigenvalue: complex) -> int:
        """Return the index of the motion nearest to an eigenvalue."""
        return int(np.argmin(np.abs(self.eigenvalues - eigenvalue)))


def identify(
    samples: Real, step: float, skip: int = 0, tolerance: float = RANK_TOLERANCE
) -> Identified:
    """Find the motions in a free response.

    Parameters
    ----------
    samples : array, shape (t, m)
        m outputs at equal steps in time.
    step : float
        Time between samples in seconds.
    skip : int
        Samples at the beginning to leave out, while motions that decay at once are in them.
    tolerance : float
        Singular values below this fraction of the largest are noise.

    Raises
    ------
    InputError
        When there are too few samples.
    """
    used = np.asarray(samples, float)[skip:]
    if len(used) < 8:
        limit = f"{len(used)} are left to identify motions, at least 8 are needed"
        raise InputError("samples", len(samples), limit, "March longer, or skip less.")
    z, order = _factors(used, tolerance)
    z = z[(z.imag >= 0.0) & (np.abs(z) > 0.0)]
    z = z[np.log(np.abs(z)) * len(used) < LONGEST_GROWTH]
    shapes, residual = _fitted(used, z)
    eigenvalues = np.asarray(np.log(z) / step, complex)
    at_end = np.linalg.norm(shapes, axis=1) * np.abs(z) ** (len(used) - 1)
    first = np.argsort(-at_end)
    return Identified(eigenvalues[first], shapes[first], residual, order)


def _factors(used: Real, tolerance: float) -> tuple[Complex, int]:
    """Return z = exp(lambda dt) of all motions, and the rank of the Hankel matrix."""
    rows, columns = _sampled(len(used), used.shape[1])
    index = rows[:, None] + columns
    now, next_ = (
        np.moveaxis(used[index + shift], 2, 1).reshape(-1, len(columns)) for shift in (0, 1)
    )
    U, s, Vh = np.linalg.svd(now, full_matrices=False)
    order = int((s > tolerance * s[0]).sum())
    root = np.sqrt(s[:order])
    advance = (U[:, :order] / root).T @ next_ @ (Vh[:order].T / root)
    return np.linalg.eigvals(advance).astype(complex), order


def _sampled(count: int, outputs: int) -> tuple[Indices, Indices]:
    """Return which samples begin the rows and the columns: both reach over half of the record."""
    half = (count - 1) // 2
    rows = np.unique(np.linspace(0, half - 1, min(half, max(2, MOST_ROWS // outputs))).astype(int))
    columns = np.unique(np.linspace(0, half - 1, min(half, MOST_COLUMNS)).astype(int))
    return rows, columns


def _fitted(used: Real, z: Complex) -> tuple[Complex, float]:
    """Return the shapes (r, m) that fit the samples best, and the share left unexplained."""
    powers = np.exp(np.multiply.outer(np.arange(len(used)), np.log(z)))
    oscillating = z.imag > 0.0
    basis = np.hstack([powers.real, -powers.imag[:, oscillating]])
    scale = np.linalg.norm(basis, axis=0)
    parts, *_ = np.linalg.lstsq(basis / scale, used, rcond=None)
    parts = parts / scale[:, None]
    missing = np.linalg.norm(basis @ parts - used) / np.linalg.norm(used)
    shapes = parts[: len(z)].astype(complex)
    shapes[oscillating] += 1j * parts[len(z) :]
    return shapes, float(missing)
