"""Argyris triangles: quintic, continuous with their slopes across every border.

Each element keeps its functions as polynomials in coordinates of its own, measured from its
middle in units of its size: so their coefficients keep their digits wherever the element lies.

J. H. Argyris, I. Fried and D. W. Scharpf, "The TUBA family of plate elements for the matrix
displacement method", Aeronautical Journal 72, 1968.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from foldwing.maths.arrays import Indices, Real
from foldwing.maths.triangles import Triangles
from foldwing.model import Planform, Sheet

DEGREE = 5
_POWERS = np.array([(i, k - i) for k in range(DEGREE + 1) for i in range(k, -1, -1)])
"""Exponents of the 21 monomials."""

QUADRATURE_DEGREE = 12
"""The mass of a uniform sheet has degree 10; two more for a thickness that varies."""

_VALUE, _SLOPES, _CURVATURES = (0, 0), ((1, 0), (0, 1)), ((2, 0), (1, 1), (0, 2))
_VERTEX = (_VALUE, *_SLOPES, *_CURVATURES)


def monomials(points: Real, derivative: tuple[int, int]) -> Real:
    """Return a derivative of the 21 monomials at points (..., 2), shape (..., 21)."""
    along = [_power(points[..., axis], _POWERS[:, axis], derivative[axis]) for axis in (0, 1)]
    return np.asarray(along[0] * along[1])


def _power(x: Real, exponents: Indices, order: int) -> Real:
    factor = np.prod([exponents - k for k in range(order)], axis=0) if order else 1.0
    table = np.stack([np.ones_like(x), *(x**k for k in range(1, DEGREE + 1))], axis=-1)
    return np.asarray(factor * table[..., np.maximum(exponents - order, 0)])


@dataclass(frozen=True)
class Argyris:
    """The functions of a triangulation; degrees of freedom are numbered by scikit-fem.

    Those of a vertex are w, its slopes and its second derivatives; that of a side is the slope
    across its middle. Slopes and second derivatives are times the unit of length and its square.

    Parameters
    ----------
    triangles : Triangles
    unit : float
        About the size of an element, in m.
    """

    triangles: Triangles
    unit: float

    @cached_property
    def corners(self) -> Indices:
        """Vertices of the elements in ascending order, shape (e, 3): neighbours agree on sides."""
        return np.sort(self.triangles.corners, axis=1)

    @cached_property
    def middles(self) -> Real:
        """Origins of the coordinates of the elements, shape (e, 2), in m."""
        return np.asarray(self.triangles.points[self.corners].mean(axis=1))

    @cached_property
    def sizes(self) -> Real:
        """Units of the coordinates of the elements, shape (e,), in m."""
        away = self.triangles.points[self.corners] - self.middles[:, None]
        return np.asarray(np.linalg.norm(away, axis=2).max(axis=1))

    @cached_property
    def _numbering(self) -> Any:
        from skfem import Dofs, ElementTriArgyris, MeshTri

        points, corners = self.triangles.points.T, self.corners.T
        mesh = MeshTri(np.ascontiguousarray(points), np.ascontiguousarray(corners))
        return mesh, Dofs(mesh, ElementTriArgyris())

    @property
    def size(self) -> int:
        """Number of degrees of freedom."""
        return int(self._numbering[1].N)

    @cached_property
    def of_element(self) -> Indices:
        """Degrees of freedom of every element, shape (e, 21)."""
        return np.asarray(self._numbering[1].element_dofs.T)

    @property
    def of_vertex(self) -> Indices:
        """Degrees of freedom w, w_x, w_y, w_xx, w_xy, w_yy of every vertex, shape (v, 6)."""
        return np.asarray(self._numbering[1].nodal_dofs.T)

    def sides_between(self, vertices: Indices) -> Indices:
        """Return the degrees of freedom of the sides with both ends among vertices."""
        mesh, dofs = self._numbering
        held = np.isin(mesh.facets, vertices).all(axis=0)
        return np.asarray(dofs.facet_dofs[0, held])

    @cached_property
    def functions(self) -> Real:
        """Coefficients of the 21 functions of every element, shape (e, 21 monomials, 21)."""
        p = (self.triangles.points[self.corners] - self.middles[:, None]) / self.sizes[
            :, None, None
        ]
        rows, orders = [], []
        for vertex in range(3):
            rows += [monomials(p[:, vertex], d) for d in _VERTEX]
            orders += [sum(d) for d in _VERTEX]
        for a, b in ((0, 1), (1, 2), (0, 2)):
            way = p[:, b] - p[:, a]
            normal = np.stack([way[:, 1], -way[:, 0]], axis=1)
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            middle = (p[:, a] + p[:, b]) / 2.0
            slopes = [monomials(middle, d) for d in _SLOPES]
            rows.append(normal[:, :1] * slopes[0] + normal[:, 1:] * slopes[1])
            orders.append(1)
        scale = (self.sizes[:, None] / self.unit) ** np.array(orders)
        return np.asarray(np.linalg.inv(np.stack(rows, axis=1)) * scale[:, None, :])

    def polynomials(self, values: Real) -> Real:
        """Return the coefficients (e, 21, n) of functions by their degrees of freedom (N, n)."""
        return np.asarray(self.functions @ values[self.of_element])

    @cached_property
    def rigid(self) -> Real:
        """Degrees of freedom (N, 3) of the functions 1, x and y."""
        values = np.zeros((self.size, 3))
        vertices, unit = self.triangles.points, self.unit
        values[self.of_vertex[:, 0]] = np.column_stack([np.ones(len(vertices)), vertices])
        values[self.of_vertex[:, 1], 1] = values[self.of_vertex[:, 2], 2] = unit
        mesh, dofs = self._numbering
        way = np.diff(vertices[mesh.facets.T], axis=1)[:, 0]
        way /= np.linalg.norm(way, axis=1)[:, None]
        values[dofs.facet_dofs[0], 1:] = unit * np.column_stack([way[:, 1], -way[:, 0]])
        return values


def stiffness_and_mass(
    elements: Argyris, planform: Planform, sheet: Sheet
) -> tuple[csr_matrix, csr_matrix]:
    """Return the matrices (N, N) of a Kirchhoff plate without rotary inertia.

    The stiffness is that of the energy 1/2 integral of k^T (t^3/12) Q k, k = (w_xx, w_yy, 2 w_xy),
    the mass that of 1/2 integral of rho t w^2. The thickness is that at the quadrature points.
    """
    points, areas = _quadrature(elements)
    t = sheet.thickness_at(*planform.fractions(*points.reshape(-1, 2).T)).reshape(areas.shape)
    local = (points - elements.middles[:, None]) / elements.sizes[:, None, None]
    w = monomials(local, _VALUE)
    xx, xy, yy = (monomials(local, d) for d in _CURVATURES)
    k = np.stack([xx, yy, 2.0 * xy], axis=3) / elements.sizes[:, None, None, None] ** 2
    moments = (areas * t**3 / 12.0)[..., None, None] * (k @ sheet.stiffness)
    flat = (len(areas), -1, w.shape[-1])
    stiffness = _transposed(k).reshape(flat).transpose(0, 2, 1) @ _transposed(moments).reshape(flat)
    mass = w.transpose(0, 2, 1) @ ((sheet.density * areas * t)[..., None] * w)
    return _gathered(elements, stiffness), _gathered(elements, mass)


def _transposed(array: Real) -> Real:
    return np.swapaxes(array, -1, -2)


def _quadrature(elements: Argyris) -> tuple[Real, Real]:
    """Return points (e, q, 2) of the quadrature over every element and their areas (e, q)."""
    from skfem.quadrature import get_quadrature
    from skfem.refdom import RefTri

    nodes, weights = get_quadrature(RefTri, QUADRATURE_DEGREE)
    corners = elements.triangles.points[elements.corners]
    ways = corners[:, 1:] - corners[:, :1]
    areas = np.abs(np.linalg.det(ways))[:, None] * weights
    return np.asarray(corners[:, :1] + nodes.T @ ways), np.asarray(areas)


def _gathered(elements: Argyris, of_monomials: Real) -> csr_matrix:
    """Return the matrix (N, N) of forms on the monomials of every element (e, 21, 21)."""
    C, at = elements.functions, elements.of_element
    local = _transposed(C) @ of_monomials @ C
    local = (local + _transposed(local)) / 2.0
    rows = np.broadcast_to(at[:, :, None], local.shape)
    columns = np.broadcast_to(at[:, None, :], local.shape)
    entries = (local.ravel(), (rows.ravel(), columns.ravel()))
    return csr_matrix(entries, shape=(elements.size, elements.size))


def held_along(elements: Argyris, edge: Real) -> csr_matrix:
    """Return a basis (N, n) of the functions that are zero with their slopes along a line.

    Of the second derivatives at a vertex on the line only that across it may differ from zero.

    Parameters
    ----------
    elements : Argyris
    edge : array, shape (2, 2)
        Two points of the line, with a side of the outline between them.
    """
    vertices = _on_line(elements.triangles.points, edge, elements.unit)
    along = (edge[1] - edge[0]) / np.linalg.norm(edge[1] - edge[0])
    across = np.array([along[1], -along[0]])
    held = elements.of_vertex[vertices]
    free = np.setdiff1d(
        np.arange(elements.size), np.append(held.ravel(), elements.sides_between(vertices))
    )
    second = np.array([across[0] ** 2, across[0] * across[1], across[1] ** 2])
    count, n = len(vertices), len(free)
    rows = np.append(free, held[:, 3:].ravel())
    columns = np.append(np.arange(n), np.repeat(n + np.arange(count), 3))
    values = np.append(np.ones(n), np.tile(second, count))
    return csr_matrix((values, (rows, columns)), shape=(elements.size, n + count))


def _on_line(points: Real, edge: Real, unit: float) -> Indices:
    way = edge[1] - edge[0]
    length = np.linalg.norm(way)
    along = (points - edge[0]) @ way / length
    across = (points - edge[0]) @ np.array([way[1], -way[0]]) / length
    room = 1e-6 * unit
    near = (np.abs(across) < room) & (along > -room) & (along < length + room)
    return np.flatnonzero(near)
