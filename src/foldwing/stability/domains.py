"""Domains of the complex plane whose boundaries can be walked, integrated along and subdivided."""

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Mask, Real

_SPLIT = 0.47
"""Where a side is divided. Not in the middle: the roots of real problems lie on lines of symmetry,
and a root on the dividing line would have to be counted for neither half."""


class Quadrature(NamedTuple):
    """Nodes and complex weights (m,) of a contour integral, counter-clockwise."""

    nodes: Complex
    weights: Complex


class Domain(Protocol):
    """A bounded region, walked counter-clockwise along its boundary."""

    @property
    def center(self) -> complex:
        """A point about which the region is scaled."""

    @property
    def radius(self) -> float:
        """A length comparable to the size of the region."""

    def points(self, t: Real) -> Complex:
        """Return the boundary points at 0 <= t <= 1, counter-clockwise."""

    def quadrature(self, count: int) -> Quadrature:
        """Return about ``count`` nodes and weights of an integral along the boundary."""

    def contains(self, z: Complex) -> Mask:
        """Return which points lie strictly inside."""

    def split(self) -> tuple["Domain", ...]:
        """Return disjoint smaller regions that cover this one."""


Interval = tuple[float, float]


def _checked_interval(name: str, interval: Interval) -> None:
    if not interval[0] < interval[1]:
        limit = "the first number must be less than the second"
        raise InputError(name, interval, limit, "Exchange the two numbers.")


def _divided(interval: Interval) -> tuple[Interval, Interval]:
    low, high = interval
    middle = low + _SPLIT * (high - low)
    return (low, middle), (middle, high)


class _Walk(NamedTuple):
    """Positions (u, v) and their rates of change with t along the sides of a box, each (m,)."""

    u: Real
    v: Real
    u_rate: Real
    v_rate: Real


def _walk(t: Real, u: Interval, v: Interval) -> _Walk:
    """Walk counter-clockwise around the box u x v as t goes from 0 to 1."""
    corners = np.linspace(0.0, 1.0, 5)
    side = np.minimum((4 * t).astype(np.intp), 3)
    width, height = 4 * (u[1] - u[0]), 4 * (v[1] - v[0])
    return _Walk(
        np.interp(t, corners, [u[0], u[1], u[1], u[0], u[0]]),
        np.interp(t, corners, [v[0], v[0], v[1], v[1], v[0]]),
        np.array([width, 0.0, -width, 0.0])[side],
        np.array([0.0, height, 0.0, -height])[side],
    )


def _gauss_on_four_sides(count: int) -> tuple[Real, Real]:
    """Return Gauss-Legendre abscissas t in (0, 1) and weights for four smooth sides."""
    x, w = np.polynomial.legendre.leggauss(max(2, math.ceil(count / 4)))
    t = (np.arange(4)[:, None] + (x + 1) / 2).ravel() / 4
    return t, np.tile(w / 8, 4)


@dataclass(frozen=True)
class Rectangle:
    """A rectangle with sides along the axes.

    Attributes
    ----------
    real, imaginary : tuple of two float
        Lower and upper limits of Re z and Im z.
    """

    real: Interval
    imaginary: Interval

    def __post_init__(self) -> None:
        _checked_interval("rectangle.real", self.real)
        _checked_interval("rectangle.imaginary", self.imaginary)

    @property
    def center(self) -> complex:
        """The middle of the rectangle."""
        return complex(sum(self.real), sum(self.imaginary)) / 2

    @property
    def radius(self) -> float:
        """Half the diagonal."""
        return math.hypot(self.real[1] - self.real[0], self.imaginary[1] - self.imaginary[0]) / 2

    def points(self, t: Real) -> Complex:
        """Return the boundary points at 0 <= t <= 1, from the lower left corner."""
        walk = _walk(t, self.real, self.imaginary)
        return walk.u + 1j * walk.v

    def quadrature(self, count: int) -> Quadrature:
        """Return Gauss-Legendre nodes and weights on the four sides."""
        t, weights = _gauss_on_four_sides(count)
        walk = _walk(t, self.real, self.imaginary)
        rate = np.asarray(walk.u_rate + 1j * walk.v_rate, dtype=np.complex128)
        return Quadrature(walk.u + 1j * walk.v, weights * rate)

    def contains(self, z: Complex) -> Mask:
        """Return which points lie strictly inside."""
        x, y = np.real(z), np.imag(z)
        (x0, x1), (y0, y1) = self.real, self.imaginary
        inside: Mask = (x0 < x) & (x < x1) & (y0 < y) & (y < y1)
        return inside

    def split(self) -> tuple[Domain, ...]:
        """Return two rectangles, divided across the longer side."""
        (x0, x1), (y0, y1) = self.real, self.imaginary
        if x1 - x0 > y1 - y0:
            return tuple(Rectangle(part, self.imaginary) for part in _divided(self.real))
        return tuple(Rectangle(self.real, part) for part in _divided(self.imaginary))


@dataclass(frozen=True)
class Ellipse:
    """An ellipse with axes along the real and imaginary directions; equal axes make a circle.

    Attributes
    ----------
    center : complex
    semi_axes : tuple of two float
        Half axes along Re z and Im z.
    """

    center: complex
    semi_axes: tuple[float, float]

    def __post_init__(self) -> None:
        if not min(self.semi_axes) > 0:
            limit = "must be greater than 0"
            raise InputError("ellipse.semi_axes", self.semi_axes, limit, "Give two half axes.")

    @property
    def radius(self) -> float:
        """The larger half axis."""
        return max(self.semi_axes)

    def points(self, t: Real) -> Complex:
        """Return the boundary points at 0 <= t <= 1, from the end of the real axis."""
        a, b = self.semi_axes
        theta = 2 * np.pi * t
        z: Complex = self.center + a * np.cos(theta) + 1j * b * np.sin(theta)
        return z

    def quadrature(self, count: int) -> Quadrature:
        """Return equidistant nodes: the trapezoidal rule converges exponentially here."""
        a, b = self.semi_axes
        t = np.arange(count) / count
        theta = 2 * np.pi * t
        rate = 2 * np.pi * (-a * np.sin(theta) + 1j * b * np.cos(theta))
        return Quadrature(self.points(t), rate / count)

    def contains(self, z: Complex) -> Mask:
        """Return which points lie strictly inside."""
        inside: Mask = np.abs(_on_unit_circle(self, z)) < 1
        return inside

    def split(self) -> tuple[Domain, ...]:
        """Return an inner ellipse and four sectors around it."""
        a, b = self.semi_axes
        # Turned for the same reason that _SPLIT is not one half.
        edges = _SPLIT + np.arange(5) * (np.pi / 2)
        sectors = [Sector(self, (0.5, 1.0), (edges[i], edges[i + 1])) for i in range(4)]
        return (Ellipse(self.center, (a / 2, b / 2)), *sectors)


def _on_unit_circle(ellipse: Ellipse, z: Complex) -> Complex:
    """Map the ellipse on the unit circle."""
    a, b = ellipse.semi_axes
    offset = np.asarray(z, dtype=np.complex128) - ellipse.center
    mapped: Complex = offset.real / a + 1j * offset.imag / b
    return mapped


@dataclass(frozen=True)
class Sector:
    """Part of an ellipse between two fractions of its radius and two parametric angles.

    Attributes
    ----------
    ellipse : Ellipse
    fraction : tuple of two float
        Limits between 0 and 1.
    angle : tuple of two float
        Limits in radians, less than a full turn apart.
    """

    ellipse: Ellipse
    fraction: Interval
    angle: Interval

    @property
    def center(self) -> complex:
        """The middle of the sector."""
        middle, _, _ = self._map(np.array(sum(self.fraction) / 2), np.array(sum(self.angle) / 2))
        return complex(middle)

    @property
    def radius(self) -> float:
        """Half the larger of its extents."""
        return max(self._extents()) / 2

    def _extents(self) -> tuple[float, float]:
        (r0, r1), (theta0, theta1) = self.fraction, self.angle
        scale = self.ellipse.radius
        return scale * (r1 - r0), scale * (r0 + r1) / 2 * (theta1 - theta0)

    def _map(self, r: Real, theta: Real) -> tuple[Complex, Complex, Complex]:
        """Return the point at (r, theta) and its derivatives with respect to both."""
        a, b = self.ellipse.semi_axes
        outward = a * np.cos(theta) + 1j * b * np.sin(theta)
        along = -a * np.sin(theta) + 1j * b * np.cos(theta)
        return self.ellipse.center + r * outward, outward, r * along

    def points(self, t: Real) -> Complex:
        """Return the boundary points at 0 <= t <= 1, counter-clockwise."""
        walk = _walk(t, self.fraction, self.angle)
        return self._map(walk.u, walk.v)[0]

    def quadrature(self, count: int) -> Quadrature:
        """Return Gauss-Legendre nodes and weights on the four sides."""
        t, weights = _gauss_on_four_sides(count)
        walk = _walk(t, self.fraction, self.angle)
        z, by_r, by_theta = self._map(walk.u, walk.v)
        rate: Complex = by_r * walk.u_rate + by_theta * walk.v_rate
        return Quadrature(z, rate * weights)

    def contains(self, z: Complex) -> Mask:
        """Return which points lie strictly inside."""
        mapped = _on_unit_circle(self.ellipse, z)
        r = np.abs(mapped)
        turned = np.mod(np.angle(mapped) - self.angle[0], 2 * np.pi)
        inside: Mask = (
            (self.fraction[0] < r)
            & (r < self.fraction[1])
            & (0 < turned)
            & (turned < self.angle[1] - self.angle[0])
        )
        return inside

    def split(self) -> tuple[Domain, ...]:
        """Return two sectors, divided across the longer extent."""
        across, along = self._extents()
        if across > along:
            return tuple(Sector(self.ellipse, r, self.angle) for r in _divided(self.fraction))
        return tuple(Sector(self.ellipse, self.fraction, turn) for turn in _divided(self.angle))
