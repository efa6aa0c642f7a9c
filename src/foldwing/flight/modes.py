"""The motions of an aircraft by name: phugoid and short period, each with what a pilot feels."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from foldwing.maths.arrays import Complex, Real

Mode = Literal["phugoid", "short period", "third oscillation"]

PHUGOID: Mode = "phugoid"
SHORT_PERIOD: Mode = "short period"
THIRD: Mode = "third oscillation"

ROUND_OFF = 1e-12
"""A growth rate below this fraction of the fastest eigenvalue is none."""


@dataclass(frozen=True)
class Motion:
    """One eigenvalue: an oscillation, which stands for its conjugate too, or an aperiodic motion.

    Attributes
    ----------
    mode : str
        ``phugoid``, ``short period`` or ``third oscillation``.
    eigenvalue : complex
        1/s, with an imaginary part that is not negative.
    shape : tuple of complex
        (u, w, q, theta) in m/s, m/s, rad/s, rad, scaled by theta = 1; empty when not known.
    """

    mode: Mode
    eigenvalue: complex
    shape: tuple[complex, ...] = ()

    @property
    def oscillates(self) -> bool:
        """Whether it is an oscillation."""
        return self.eigenvalue.imag != 0.0

    @property
    def growth(self) -> float:
        """Growth rate in 1/s, negative when stable."""
        return self.eigenvalue.real

    @property
    def period(self) -> float:
        """Time of one cycle in s; nan for an aperiodic motion."""
        return 2.0 * math.pi / abs(self.eigenvalue.imag) if self.oscillates else math.nan

    @property
    def damping_ratio(self) -> float:
        """Damping as -Re / |lambda|, 1 when critical; nan for an aperiodic motion."""
        return -self.growth / abs(self.eigenvalue) if self.oscillates else math.nan

    @property
    def time_to_half(self) -> float:
        """Time in s in which the amplitude halves; nan unless it decays."""
        return math.log(2.0) / -self.growth if self.growth < 0.0 else math.nan

    @property
    def time_to_double(self) -> float:
        """Time in s in which the amplitude doubles; nan unless it grows."""
        return math.log(2.0) / self.growth if self.growth > 0.0 else math.nan

    @property
    def cycles(self) -> float:
        """Cycles in which the amplitude halves or doubles; nan where there are none."""
        return math.log(2.0) / abs(self.growth) / self.period if self.growth else math.nan


def flight_modes(matrix: Real) -> tuple[Motion, ...]:
    """Return the motions of four states, the phugoid first.

    Parameters
    ----------
    matrix : array, shape (4, 4)
        Of the states u, w, q, theta.

    Returns
    -------
    tuple of Motion
        One for each pair and each real eigenvalue. The two slower eigenvalues are the phugoid, the
        two faster ones the short period. A pair between two real ones is neither: it is the third
        oscillation, and the slow and the fast real one are what is left of the two modes.
    """
    values, vectors = np.linalg.eig(np.asarray(matrix, float))
    whole = _rounded(values)
    kept = [i for i in range(len(whole)) if whole[i].imag >= 0.0]
    kept.sort(key=lambda i: (abs(whole[i]), whole[i].real))
    modes = _named([complex(whole[i]) for i in kept])
    return tuple(
        Motion(mode, complex(whole[i]), _scaled(vectors[:, i]))
        for mode, i in zip(modes, kept, strict=True)
    )


def _rounded(values: Complex) -> Complex:
    """Return eigenvalues of which growth that is only round-off is zero."""
    noise = ROUND_OFF * np.abs(values).max()
    growth = np.where(np.abs(values.real) <= noise, 0.0, values.real)
    whole: Complex = growth + 1j * values.imag
    return whole


def _scaled(vector: Complex) -> tuple[complex, ...]:
    """Return a shape in which theta is 1, or the largest entry where the pitch angle stays."""
    largest = vector[np.abs(vector).argmax()]
    turns = abs(vector[3]) > ROUND_OFF * abs(largest)
    return tuple(complex(entry) for entry in vector / (vector[3] if turns else largest))


def _named(values: list[complex]) -> tuple[Mode, ...]:
    """Return the modes of eigenvalues that go from slow to fast; a pair is given once."""
    if len(values) == 2:
        return PHUGOID, SHORT_PERIOD
    if len(values) == 4:
        return PHUGOID, PHUGOID, SHORT_PERIOD, SHORT_PERIOD
    pair = next(place for place, value in enumerate(values) if value.imag)
    middle: tuple[Mode, ...] = (SHORT_PERIOD, THIRD, PHUGOID)
    return PHUGOID, middle[pair], SHORT_PERIOD
