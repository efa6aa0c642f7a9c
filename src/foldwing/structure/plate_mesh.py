"""Triangulations of the outline of a segment.

Convex outlines of four corners and triangles are cut into cells by lines between their sides, the
same from either end, so that a symmetric plate has symmetric modes. Others are left to netgen.
"""

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Real
from foldwing.maths.triangles import Triangles
from foldwing.model import Planform

SHARPEST, BLUNTEST = np.radians(10.0), np.radians(170.0)
"""Angles between which the corners of an outline must lie to be cut by lines between sides."""


def triangulation(planform: Planform, size: float) -> Triangles:
    """Return triangles that fill an outline.

    Parameters
    ----------
    planform : Planform
    size : float
        Wanted length of their sides, in m.

    Raises
    ------
    InputError
        When the outline needs netgen and it is not installed.
    """
    corners = planform.array
    if len(corners) == 3:
        return _of_triangle(corners, size)
    if len(corners) == 4 and _is_convex(corners):
        return _of_quadrilateral(corners, size)
    return _by_netgen(corners, size)


def _is_convex(corners: Real) -> bool:
    """Whether every corner turns the same way by an angle neither sharp nor blunt."""
    ahead, behind = np.roll(corners, -1, axis=0) - corners, np.roll(corners, 1, axis=0) - corners
    cross = behind[:, 0] * ahead[:, 1] - behind[:, 1] * ahead[:, 0]
    angles = np.arctan2(cross, (ahead * behind).sum(axis=1))
    return bool(np.all((angles > SHARPEST) & (angles < BLUNTEST)))


def _of_quadrilateral(corners: Real, size: float) -> Triangles:
    """Return cells of four triangles that meet in the middle of the cell."""
    a, b, c, d = corners
    sides = (
        np.linalg.norm(np.stack([b - a, c - d, d - a, c - b]), axis=1).reshape(2, 2).mean(axis=1)
    )
    m, n = np.maximum(1, np.ceil(sides / size - 1e-6)).astype(int)

    def place(u: Real, v: Real) -> Real:
        u, v = np.repeat(u, len(v))[:, None], np.tile(v, len(u))[:, None]
        return np.asarray((1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * c))

    along, over = np.linspace(0.0, 1.0, m + 1), np.linspace(0.0, 1.0, n + 1)
    middles = place((along[1:] + along[:-1]) / 2.0, (over[1:] + over[:-1]) / 2.0)
    vertex = np.arange((m + 1) * (n + 1)).reshape(m + 1, n + 1)
    ring = [vertex[:-1, :-1], vertex[1:, :-1], vertex[1:, 1:], vertex[:-1, 1:]]
    middle = vertex.size + np.arange(m * n).reshape(m, n)
    triangles = [[p, q, middle] for p, q in zip(ring, ring[1:] + ring[:1], strict=True)]
    return Triangles(
        np.vstack([place(along, over), middles]),
        np.asarray(np.moveaxis(np.array(triangles), 1, -1).reshape(-1, 3)),
    )


def _of_triangle(corners: Real, size: float) -> Triangles:
    """Return triangles similar to the outline, about as large as equilateral ones of that size."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    n = int(np.ceil(max(sides.min(), sides.max() / 2.0) / size - 1e-6))
    i, j = (index.ravel() for index in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
    inside = i + j <= n
    i, j = i[inside], j[inside]
    number = np.full((n + 2, n + 2), -1)
    number[i, j] = np.arange(len(i))
    a, b, c = corners
    points = a + (i[:, None] * (b - a) + j[:, None] * (c - a)) / n
    upright = np.stack([number[i, j], number[i + 1, j], number[i, j + 1]], axis=1)
    turned = np.stack([number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]], axis=1)
    triangles = np.vstack([upright, turned])
    return Triangles(points, triangles[(triangles >= 0).all(axis=1)])


def _by_netgen(corners: Real, size: float) -> Triangles:
    """Return the triangles that netgen finds; it wants the outline counter-clockwise."""
    try:
        from netgen.geom2d import SplineGeometry
    except ImportError:
        limit = "an outline that is neither a triangle nor convex with four corners needs netgen"
        remedy = 'Install it: pip install "foldwing[mesh]".'
        raise InputError("corners", len(corners), limit, remedy) from None
    outline = SplineGeometry()
    counter_clockwise = corners[::-1] / size  # it rounds lengths as if they were of order one
    numbers = [outline.AppendPoint(*map(float, point)) for point in counter_clockwise]
    for number, following in zip(numbers, numbers[1:] + numbers[:1], strict=True):
        outline.Append(["line", number, following])
    mesh = outline.GenerateMesh(maxh=1.0)
    points = size * np.array([tuple(point.p)[:2] for point in mesh.Points()])
    triangles = [[v.nr - 1 for v in element.vertices] for element in mesh.Elements2D()]
    return _without_strays(points, np.array(triangles, int))


def _without_strays(points: Real, triangles: Indices) -> Triangles:
    used, corners = np.unique(triangles, return_inverse=True)
    return Triangles(points[used], corners.reshape(-1, 3))
