"""Strip theory: Theodorsen's section forces, integrated along every segment.

Per unit span, about the elastic axis, with plunge h up and twist phi nose up (Theodorsen 1935,
NACA Report 496, whose h is positive down), C = C(p) and the lift slope c:

    w34 = U phi - h' + b (1/2 - a) phi'
    L = pi rho b^2 (-h'' + U phi' - b a phi'') + c rho U b C w34
    M = pi rho b^3 (-a h'' - U (1/2 - a) phi' - b (1/8 + a^2) phi'') + c rho U b^2 (a + 1/2) C w34

where ' is d/dt. A segment whose half chord b_i is not the reference b sees its own p b_i / b.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from foldwing.aerodynamics.schemes import EXACT, TimeScheme
from foldwing.maths.arrays import Complex, Real
from foldwing.maths.bessel import theodorsen, theodorsen_with_derivative


@dataclass(frozen=True)
class StripForces:
    """F = (lambda^2 acceleration + lambda U rate + C(p_i) (lambda U lag_rate + U^2 lag)) q.

    Attributes
    ----------
    half_chord : float
        Of the segment, in metres.
    acceleration, rate, lag_rate, lag : array, shape (n, n)
    lags : bool
        Whether C is Theodorsen's function; quasi-steady forces have C = 1.
    """

    half_chord: float
    acceleration: Real
    rate: Real
    lag_rate: Real
    lag: Real
    lags: bool = True

    def projected(self, q: Real) -> "StripForces":
        """Return the forces of the motions ``q`` (n, m), a matrix of column vectors."""
        parts = (self.acceleration, self.rate, self.lag_rate, self.lag)
        acceleration, rate, lag_rate, lag = (q.T @ A @ q for A in parts)
        return StripForces(self.half_chord, acceleration, rate, lag_rate, lag, self.lags)

    @property
    def quasi_steady(self) -> "StripForces":
        """The same without apparent mass terms and without lag."""
        zero = np.zeros_like(self.rate)
        return StripForces(self.half_chord, zero, zero, self.lag_rate, self.lag, lags=False)


class Section(Protocol):
    """What strip theory asks of a segment or a tail."""

    @property
    def half_chord(self) -> float:
        """Half chord b in metres."""

    @property
    def axis_offset(self) -> float:
        """Distance a of the elastic axis aft of mid-chord, in half chords."""

    @property
    def lift_slope(self) -> float:
        """Slope of the lift coefficient, 1/rad."""


def strip_forces(
    section: Section, density: float, weights: Real, plunge: Real, twist: Real
) -> StripForces:
    """Integrate the section forces over the span of one segment.

    Parameters
    ----------
    section : Section
    density : float
        Of the air in kg/m^3.
    weights : array, shape (m,)
        Quadrature weights along the span in metres.
    plunge, twist : array, shape (m, n)
        Motion of the sections per coordinate: up in metres, nose up in radians.
    """
    b, a, rho = section.half_chord, section.axis_offset, density
    h, phi, weight = plunge, twist, weights[:, None]
    lift_arm = h + b * (a + 0.5) * phi
    downwash = -h + b * (0.5 - a) * phi
    noncirculatory = np.pi * rho * b**2
    circulatory = section.lift_slope * rho * b
    plunge_load = -h - b * a * phi
    twist_load = -b * a * h - b**2 * (0.125 + a**2) * phi
    return StripForces(
        half_chord=b,
        acceleration=noncirculatory
        * (h.T @ (weight * plunge_load) + phi.T @ (weight * twist_load)),
        rate=noncirculatory * (h - b * (0.5 - a) * phi).T @ (weight * phi),
        lag_rate=circulatory * lift_arm.T @ (weight * downwash),
        lag=circulatory * lift_arm.T @ (weight * phi),
    )


def trim_strip_forces(
    section: Section, load: float, weights: Real, motion: tuple[Real, Real, Real], lags: bool
) -> StripForces:
    """Integrate what a steady lift adds to the forces on a moving segment, divided by U^2.

    Linearised about the steady lift l per span, with h' up and u' aft, so that -u' is an increase
    of the airspeed: the lift grows by 2 C l (-u')/U at the quarter chord, and turns aft by h'/U.

    Parameters
    ----------
    section : Section
    load : float
        l in N/m, normal to the segment.
    weights : array, shape (m,)
        Quadrature weights along the span in metres.
    motion : tuple of array, shape (m, n)
        Plunge, twist and displacement aft of the sections per coordinate.
    lags : bool
        Whether the change of the lift lags by Theodorsen's function.
    """
    b, a = section.half_chord, section.axis_offset
    h, phi, u = motion
    weight = load * weights[:, None]
    zero = np.zeros((h.shape[1],) * 2)
    lag_rate = -2.0 * (h + b * (a + 0.5) * phi).T @ (weight * u)
    return StripForces(b, zero, u.T @ (weight * h), lag_rate, zero, lags)


@dataclass(frozen=True)
class StripModel:
    """Strip theory for the modes of a wing; obeys the port of aerodynamic models.

    Parameters
    ----------
    half_chord : float
        Reference length b of p in metres.
    segments : tuple of StripForces
        Forces on each segment for the same n modes.
    """

    half_chord: float
    segments: tuple[StripForces, ...]

    @property
    def size(self) -> int:
        """Number n of modes."""
        return len(self.segments[0].lag)

    @property
    def highest_frequency(self) -> float:
        """No limit: Theodorsen's function holds at any reduced frequency."""
        return math.inf

    @property
    def largest_decay(self) -> float:
        """No limit: Theodorsen's function is continued to decaying motions."""
        return math.inf

    @property
    def scheme(self) -> TimeScheme:
        """Continuous time."""
        return EXACT

    @cached_property
    def _lags(self) -> tuple[tuple[float, bool], ...]:
        """Half chords, with and without lag: each has a C of its own."""
        return tuple(sorted({(s.half_chord, s.lags) for s in self.segments}))

    @cached_property
    def _terms(self) -> Complex:
        """Coefficients of 1, p, p^2 and, per chord, of C and p C; shape (terms, n^2)."""
        b, n = self.half_chord, self.size
        rows = [
            np.zeros((n, n)),
            sum(s.rate for s in self.segments) / b,
            sum(s.acceleration for s in self.segments) / b**2,
        ]
        for lag in self._lags:
            alike = [s for s in self.segments if (s.half_chord, s.lags) == lag]
            rows += [sum(s.lag for s in alike), sum(s.lag_rate for s in alike) / b]
        return np.array(rows, dtype=complex).reshape(len(rows), n * n)

    def _factors(self, p: Complex) -> Complex:
        """Return what the terms are multiplied by, shape (m, terms)."""
        value = np.empty((len(p), len(self._terms)), complex)
        value[:, 0], value[:, 1], value[:, 2] = 1.0, p, p * p
        for number, (chord, lags) in enumerate(self._lags):
            C = theodorsen(p * (chord / self.half_chord)) if lags else np.ones_like(p)
            value[:, 3 + 2 * number], value[:, 4 + 2 * number] = C, p * C
        return value

    def _factors_and_slopes(self, p: Complex) -> tuple[Complex, Complex]:
        """Return the factors of the terms and their derivatives, each (m, terms)."""
        value, slope = np.zeros((2, len(p), len(self._terms)), complex)
        value[:, 0], value[:, 1], value[:, 2] = 1.0, p, p * p
        slope[:, 1], slope[:, 2] = 1.0, 2.0 * p
        for number, lag in enumerate(self._lags):
            column = 3 + 2 * number
            with np.errstate(invalid="ignore"):  # at p = 0 dC/dp is infinite
                C, dC = self._lag(p, *lag)
                slope[:, column], slope[:, column + 1] = dC, C + p * dC
            value[:, column], value[:, column + 1] = C, p * C
        return value, slope

    def _lag(self, p: Complex, chord: float, lags: bool) -> tuple[Complex, Complex]:
        if not lags:
            return np.ones_like(p), np.zeros_like(p)
        ratio = chord / self.half_chord
        C, dC = theodorsen_with_derivative(p * ratio)
        return C, ratio * dC

    def forces(self, p: Complex) -> Complex:
        """Return Qhat at the values ``p`` of shape (m,), as an array (m, n, n)."""
        p = np.asarray(p, complex)
        return (self._factors(p) @ self._terms).reshape(len(p), self.size, self.size)

    def forces_by_segment(self, p: Complex) -> Complex:
        """Return the part of Qhat from each segment, shape (m, segments, n, n)."""
        alone = (replace(self, segments=(segment,)) for segment in self.segments)
        return np.stack([model.forces(p) for model in alone], axis=1)

    def forces_with_derivative(self, p: Complex) -> tuple[Complex, Complex]:
        """Return Qhat and dQhat/dp, each of shape (m, n, n); the latter is not finite at p = 0."""
        p = np.asarray(p, complex)
        value, slope = self._factors_and_slopes(p)
        shape = (len(p), self.size, self.size)
        with np.errstate(invalid="ignore"):
            return (value @ self._terms).reshape(shape), (slope @ self._terms).reshape(shape)

    def steady_forces(self) -> Real:
        """Return Qhat(0), shape (n, n)."""
        return np.asarray(sum(s.lag for s in self.segments))

    @property
    def has_apparent_mass(self) -> bool:
        """Whether no segment is quasi-steady."""
        return all(s.lags for s in self.segments)

    def apparent_mass(self) -> Real:
        """Return the apparent mass of still air (n, n); that of quasi-steady segments is zero."""
        return np.asarray(-sum(s.acceleration for s in self.segments))


def strip_model(
    forces: Sequence[StripForces], motions: Sequence[Real], half_chord: float, lag: bool
) -> StripModel:
    """Return strip theory for the modes given by each segment's coordinates ``motions``."""
    base = forces if lag else [f.quasi_steady for f in forces]
    projected = tuple(f.projected(q) for f, q in zip(base, motions, strict=True))
    return StripModel(half_chord, projected)
