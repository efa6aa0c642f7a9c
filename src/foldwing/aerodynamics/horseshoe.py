"""Velocity induced by horseshoe vortices whose legs run along the stream to infinity.

A horseshoe comes from infinity along x to its inboard end A, runs to its outboard end B and back
downstream. With unit circulation, r_a = P - A and r_b = P - B (law of Biot and Savart):

    bound vortex    (r_a x r_b) (|r_a| + |r_b|) / (|r_a| |r_b| (|r_a| |r_b| + r_a . r_b)) / 4 pi
    leg from B      (e_x x r_b) / (|r_b| (|r_b| - e_x . r_b)) / 4 pi, leg to A with opposite sign

Two forms: any horseshoe in space, all components; and bound vortices at right angles to the stream,
normal component, at many streamwise distances at once. (I. Wang, PhD dissertation, Duke University,
2013, eqs. (3.5) and (3.13), without its rotations and arc tangents.)
"""

from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Indices, Real

FOUR_PI = 4.0 * np.pi

CHUNK = 12_000
"""Kernel values computed at a time: small enough for arrays whose memory is kept and used again."""

SINGULAR = 1e-24
"""Square of the distance from a vortex, relative to its length, within which it induces nothing."""


def induced_velocity(points: Real, inner: Real, outer: Real) -> Real:
    """Return the velocity that horseshoes of unit circulation induce.

    Parameters
    ----------
    points : array, shape (m, 3)
        Where, in metres.
    inner, outer : array, shape (s, 3)
        Ends A and B of the bound vortices, which may be swept.

    Returns
    -------
    array, shape (m, s, 3)
        In m/s per m^2/s. A vortex induces nothing at points on itself.
    """
    r_a, r_b = points[:, None] - inner, points[:, None] - outer
    size_a, size_b = np.linalg.norm(r_a, axis=2), np.linalg.norm(r_b, axis=2)
    length2 = ((outer - inner) ** 2).sum(axis=1)
    cross = np.cross(r_a, r_b)
    cross2 = (cross**2).sum(axis=2)
    product, along = size_a * size_b, (r_a * r_b).sum(axis=2)
    outside = along > 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        # Beside the vortex the sum cancels: |r_a|^2 |r_b|^2 = (r_a . r_b)^2 + |r_a x r_b|^2.
        denominator = np.where(outside, product + along, cross2 / (product - along))
        bound = (size_a + size_b) / (product * denominator)
    bound = np.where(cross2 > SINGULAR * length2**2, bound, 0.0)
    legs = _leg(r_b, size_b, length2) - _leg(r_a, size_a, length2)
    return np.asarray((cross * bound[:, :, None] + legs) / FOUR_PI)


def _leg(r: Real, size: Real, length2: Real) -> Real:
    """Velocity of a vortex from r = 0 along x, times 4 pi, shape (m, s, 3)."""
    x, y, z = np.moveaxis(r, 2, 0)
    distance2 = y**2 + z**2
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.where(x < 0.0, 1.0 / (size * (size - x)), (size + x) / (size * distance2))
    factor = np.where(distance2 > SINGULAR * length2, factor, 0.0)
    return np.stack([np.zeros_like(x), -z * factor, y * factor], axis=2)


class Edges(NamedTuple):
    """Straight lines across the stream, as horseshoes and receivers see them: y and z only.

    Attributes
    ----------
    inner, outer : array, shape (s, 2)
        Ends A and B of the bound vortices.
    """

    inner: Real
    outer: Real


def streamwise_wash(xi: Real, points: Real, normals: Real, edges: Edges) -> Real:
    """Return the normal velocity that horseshoes across the stream induce.

    Parameters
    ----------
    xi : array, shape (q,), ascending
        Distances of the points downstream of the bound vortices in metres.
    points, normals : array, shape (r, 2)
        y and z of the points, and of the unit normals there.
    edges : Edges
        s bound vortices.

    Returns
    -------
    array, shape (q, r, s)
        In m/s per m^2/s; a vortex induces nothing at points on its bound part.
    """
    chain = _Chain.of(points, normals, edges)
    wash = np.empty((len(xi), len(points), len(edges.inner)))
    rows = max(1, CHUNK // max(1, wash[0].size))
    upstream = int(np.searchsorted(xi, 0.0))
    for start, end, ahead in ((0, upstream, True), (upstream, len(xi), False)):
        for first in range(start, end, rows):
            last = min(first + rows, end)
            wash[first:last] = chain.wash(xi[first:last, None, None], ahead)
    return wash


class _Chain(NamedTuple):
    """What depends on y and z alone, divided by 4 pi where it counts.

    Neighbouring vortices share an end: legs and distances are computed once for each end.

    Attributes
    ----------
    inner, outer : slice or array of int
        Which ends A and B are.
    distance2, leg : array, shape (r, ends)
        Square of the distance of the points in y and z, and strength of the leg.
    turn, cross2, length2, along, turn_a, turn_b : array, shape (r, s)
        Of the bound vortices; a and b stand for r_a and r_b.
    """

    inner: slice | Indices
    outer: slice | Indices
    distance2: Real
    leg: Real
    turn: Real
    cross2: Real
    length2: Real
    along: Real
    turn_a: Real
    turn_b: Real

    @classmethod
    def of(cls, points: Real, normals: Real, edges: Edges) -> "_Chain":
        ends, inner, outer = _shared_ends(edges)
        r = points[:, None] - ends
        n_y, n_z = normals[:, None, 0], normals[:, None, 1]
        a, b = r[:, inner], r[:, outer]
        l = edges.outer - edges.inner
        turn = (l[:, 1] * n_y - l[:, 0] * n_z) / FOUR_PI
        return cls(
            inner=inner,
            outer=outer,
            distance2=(r**2).sum(axis=2),
            leg=(r[..., 1] * n_y - r[..., 0] * n_z) / FOUR_PI,
            turn=turn,
            cross2=(a[..., 1] * b[..., 0] - a[..., 0] * b[..., 1]) ** 2,
            length2=np.broadcast_to((l**2).sum(axis=1), a.shape[:2]),
            along=(a * b).sum(axis=2),
            turn_a=turn * (l * a).sum(axis=2),
            turn_b=turn * (l * b).sum(axis=2),
        )

    def wash(self, xi: Real, ahead: bool) -> Real:
        """Return the wash at distances of one sign: ``ahead`` of the bound vortices or behind."""
        R = np.sqrt(xi * xi + self.distance2)
        if ahead:
            share = 1.0 / (R * (R - xi))
            inverse, legs = share * (R - xi), self.leg * share
        else:
            inverse = 1.0 / R
            legs = self.leg / self.distance2 * (1.0 + xi * inverse)
        wash = legs[..., self.inner] - legs[..., self.outer]
        across = self.cross2 + xi * xi * self.length2
        if across.min() < 1e-6 * float(self.length2.min()) ** 2:
            wash += self._bound_anywhere(xi, R, across)
        else:
            turn = self.turn_a * inverse[..., self.inner] - self.turn_b * inverse[..., self.outer]
            wash += xi / across * turn
        return wash

    def _bound_anywhere(self, xi: Real, R: Real, across: Real) -> Real:
        """Return the part of the bound vortex, exact to round-off beside its line as well."""
        R_a, R_b = R[..., self.inner], R[..., self.outer]
        product, along = R_a * R_b, self.along + xi * xi
        touching = across <= SINGULAR * self.length2**2
        with np.errstate(divide="ignore", invalid="ignore"):
            denominator = np.where(along > 0.0, product + along, across / (product - along))
            value = xi * self.turn * (R_a + R_b) / (product * denominator)
        return np.where(touching, 0.0, value)


def _shared_ends(edges: Edges) -> tuple[Real, slice | Indices, slice | Indices]:
    """Return the ends of all vortices (ends, 2), neighbours' once, and which A and B are."""
    gap2 = ((edges.inner[1:] - edges.outer[:-1]) ** 2).sum(axis=1)
    alone = gap2 > SINGULAR * ((edges.outer - edges.inner) ** 2).sum(axis=1).min(initial=np.inf)
    if not alone.any():
        return np.vstack([edges.inner, edges.outer[-1:]]), slice(None, -1), slice(1, None)
    last = np.append(alone, True)
    outer = np.arange(1, len(last) + 1) + np.cumsum(last) - last
    ends = np.empty((outer[-1] + 1, 2))
    ends[outer - 1], ends[outer] = edges.inner, edges.outer
    return ends, outer - 1, outer
