"""Smooth surfaces through scattered points of a plane.

The infinite-plate spline of R. L. Harder and R. N. Desmarais, "Interpolation using surface
splines", J. Aircraft 9 (1972) 189-191, is the deflection of an unbounded thin plate held at the
points:

    w(x, y) = a0 + a1 x + a2 y + sum_i F_i r_i^2 ln r_i^2,
    sum F_i = sum F_i x_i = sum F_i y_i = 0.

Points on one line carry no information across it; through them goes a cubic spline along the line.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from foldwing.maths.arrays import Real

LINE = 1e-3
"""Points are on one line when their spread across it is below this share of that along it."""

_BLOCK = 4_000_000
"""Pairs of points that are treated at once."""


class Surface(Protocol):
    """Functions w_1 .. w_n of x and y that are continuous with their slopes everywhere."""

    def evaluate(self, points: Real) -> Real:
        """Return the values at points (m, 2), shape (m, n)."""

    def slopes(self, points: Real) -> Real:
        """Return dw/dx and dw/dy at points (m, 2), shape (m, 2, n)."""

    @property
    def left_out(self) -> Real:
        """Value given at each point less that of a surface made without the point, (k, n)."""


@dataclass(frozen=True)
class PlateSpline:
    """Infinite-plate splines through the same points.

    Attributes
    ----------
    nodes : array, shape (k, 2)
        The points, moved by ``centre`` and divided by ``scale``.
    centre : array, shape (2,)
    scale : float
    forces, plane : array, shapes (k, n) and (3, n)
        F_i, and a0, a1, a2, in scaled coordinates.
    compliance : array, shape (k,)
        Diagonal of the inverse of the matrix whose solution the forces are.
    """

    nodes: Real
    centre: Real
    scale: float
    forces: Real
    plane: Real
    compliance: Real

    def evaluate(self, points: Real) -> Real:
        """Return the values at points (m, 2), shape (m, n)."""
        from scipy.special import xlogy

        values = []
        for z in self._blocks(points):
            r2 = _squared_distances(z, self.nodes)
            values.append(xlogy(r2, r2) @ self.forces + _linear(z) @ self.plane)
        return np.concatenate(values)

    def slopes(self, points: Real) -> Real:
        """Return dw/dx and dw/dy at points (m, 2), shape (m, 2, n)."""
        slopes = []
        for z in self._blocks(points):
            r2 = _squared_distances(z, self.nodes)
            rate = 2.0 * (np.log(np.where(r2 > 0.0, r2, 1.0)) + 1.0)
            apart = (z[:, None, axis] - self.nodes[:, axis] for axis in (0, 1))
            bent = [(rate * d) @ self.forces for d in apart]
            slopes.append((np.stack(bent, axis=1) + self.plane[1:]) / self.scale)
        return np.concatenate(slopes)

    def _blocks(self, points: Real) -> list[Real]:
        z = (np.asarray(points, float).reshape(-1, 2) - self.centre) / self.scale
        return np.array_split(z, max(1, -(-len(z) * len(self.nodes) // _BLOCK)))

    @property
    def left_out(self) -> Real:
        """Value given at each point less that of a spline made without the point, (k, n).

        Replacing the value by that of the other points' spline leaves no force at the point, and a
        force answers to the value of its own point by the compliance: e_i = F_i / (A^-1)_ii.
        """
        return np.asarray(self.forces / self.compliance[:, None])


def plate_spline(points: Real, values: Real, smoothing: float = 0.0) -> PlateSpline:
    """Return the infinite-plate splines of n sets of values at k points.

    Parameters
    ----------
    points : array, shape (k, 2)
        At least three, not on one line, all different.
    values : array, shape (k, n)
    smoothing : float
        Length l, in the unit of the points; 0 goes through every value. With N points per unit
        area the plate is bent by springs instead of held: sum (w - value)^2 + N l^4 times the
        integral of w_xx^2 + 2 w_xy^2 + w_yy^2 is least. A wave of length 2 pi l is halved,
        1/(1 + (2 pi l / wavelength)^4) of others is left; planes are kept.
    """
    springs = 0.0
    if smoothing > 0.0:
        springs = 16.0 * np.pi * len(points) / _hull_area(points) * smoothing**4
    return sprung_plate_spline(points, values, springs)


def sprung_plate_spline(points: Real, values: Real, springs: float) -> PlateSpline:
    """Return the splines whose springs give way by ``springs`` (length^2) per F_i."""
    from scipy.linalg import lu_factor, lu_solve
    from scipy.special import xlogy

    centre = points.mean(axis=0)
    scale = float(np.linalg.norm(points - centre, axis=1).max())
    nodes, k = (points - centre) / scale, len(points)
    A = np.zeros((k + 3, k + 3))
    r2 = _squared_distances(nodes, nodes)
    A[:k, :k] = xlogy(r2, r2) + springs / scale**2 * np.eye(k)
    A[:k, k:] = _linear(nodes)
    A[k:, :k] = A[:k, k:].T
    right = np.zeros((k + 3, values.shape[1] + k))
    right[:k] = np.hstack([values, np.eye(k)])
    solution = lu_solve(lu_factor(A), right)
    n = values.shape[1]
    compliance = np.diagonal(solution[:k, n:]).copy()
    return PlateSpline(nodes, centre, scale, solution[:k, :n], solution[k:, :n], compliance)


@dataclass(frozen=True)
class LineSpline:
    """Cubic splines along a line; constant across it and straight beyond its ends.

    Attributes
    ----------
    origin, direction : array, shape (2,)
        A point on the line and the unit vector along it.
    stations : array, shape (k,)
        Distances of the points from the origin along the line, ascending.
    values : array, shape (k, n)
        At the stations.
    order : array of int, shape (k,)
        Where each station stands among the points as they were given.
    """

    origin: Real
    direction: Real
    stations: Real
    values: Real
    order: Any

    @cached_property
    def _cubic(self) -> Any:
        return _cubic(self.stations, self.values)

    def evaluate(self, points: Real) -> Real:
        """Return the values at points (m, 2), shape (m, n)."""
        return _extended(self._cubic, self._along(points))

    def slopes(self, points: Real) -> Real:
        """Return dw/dx and dw/dy at points (m, 2), shape (m, 2, n)."""
        s = np.clip(self._along(points), self.stations[0], self.stations[-1])
        return np.asarray(self._cubic(s, 1)[:, None, :] * self.direction[:, None])

    def _along(self, points: Real) -> Real:
        return (np.asarray(points, float).reshape(-1, 2) - self.origin) @ self.direction

    @cached_property
    def left_out(self) -> Real:
        """Value given at each point less that of a spline made without the point, (k, n)."""
        errors = np.full_like(self.values, np.nan)
        if len(self.stations) > 2:
            for i, s in enumerate(self.stations):
                others = np.arange(len(self.stations)) != i
                spline = _cubic(self.stations[others], self.values[others])
                errors[self.order[i]] = self.values[i] - _extended(spline, np.array([s]))[0]
        return errors


def line_spline(points: Real, values: Real) -> LineSpline:
    """Return the cubic splines of n sets of values (k, n) at k points (k, 2) of a line."""
    origin = points.mean(axis=0)
    direction = np.linalg.svd(points - origin, full_matrices=False)[2][0]
    s = (points - origin) @ direction
    order = np.argsort(s)
    return LineSpline(origin, direction, s[order], values[order], order)


def on_one_line(points: Real) -> bool:
    """Tell whether points (k, 2) lie on one line."""
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return len(points) < 3 or bool(spread[1] <= LINE * spread[0])


def _cubic(stations: Real, values: Real) -> Any:
    from scipy.interpolate import CubicSpline

    return CubicSpline(stations, values)


def _extended(spline: Any, s: Real) -> Real:
    inside = np.clip(s, spline.x[0], spline.x[-1])
    return np.asarray(spline(inside) + spline(inside, 1) * (s - inside)[:, None])


def _squared_distances(a: Real, b: Real) -> Real:
    return np.asarray(sum((a[:, None, axis] - b[:, axis]) ** 2 for axis in (0, 1)))


def _linear(z: Real) -> Real:
    return np.column_stack([np.ones(len(z)), z])


def _hull_area(points: Real) -> float:
    from scipy.spatial import ConvexHull

    return float(ConvexHull(points).volume)  # of a hull in a plane, its area
