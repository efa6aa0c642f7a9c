"""Argyris triangles and triangulations: what must hold exactly, on any outline."""

import sys
from itertools import pairwise

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.maths.triangles import Triangles
from foldwing.structure.plate_elements import (
    Argyris,
    held_along,
    monomials,
    stiffness_and_mass,
)
from foldwing.structure.plate_mesh import triangulation
from support.plates import ARROW, DELTA, L_SHAPE, OUTLINES, SQUARE, TRAPEZOID, sheet

SIDES = ((0, 1), (1, 2), (0, 2))


def distorted(planform=SQUARE, cells=4):
    """Elements of a square whose inner vertices are moved at random by up to a third of a cell."""
    size = planform.size / cells
    triangles = triangulation(planform, size)
    points = triangles.points.copy()
    centre = planform.array.mean(axis=0)
    inner = np.abs(points - centre).max(axis=1) < 0.499 * planform.size
    points[inner] += np.random.default_rng(3).uniform(-0.17, 0.17, (inner.sum(), 2)) * size
    return Argyris(Triangles(points, triangles.corners), size)


def area_moments(corners):
    """Integrals of products of 1, x and y over a polygon, by Green's theorem, shape (3, 3)."""
    J = np.zeros((3, 3))
    for a, b in pairwise([*corners, corners[0]]):
        triangle = np.cross([*a, 0.0], [*b, 0.0])[2] / 2.0
        first = triangle * (a + b) / 3.0
        second = triangle / 12.0 * (np.outer(a, a) + np.outer(b, b) + np.outer(a + b, a + b))
        J += np.block([[np.array([[triangle]]), first[None]], [first[:, None], second]])
    return J * np.sign(J[0, 0])


def interpolated(elements, coefficients):
    """Degrees of freedom of a polynomial sum c x^i y^j, and how well elements can hold it."""
    points = elements.middles[:, None] + elements.sizes[:, None, None] * SCATTERED
    wanted = sum(c * points[..., 0] ** i * points[..., 1] ** j for (i, j), c in coefficients)
    local = np.linalg.lstsq(monomials(SCATTERED, (0, 0)), wanted.T, rcond=None)[0].T
    rows = np.zeros((local.size, elements.size))
    index = np.arange(local.size).reshape(local.shape)
    for functions, at, row in zip(elements.functions, elements.of_element, index, strict=True):
        rows[np.ix_(row, at)] = functions
    values, *_ = np.linalg.lstsq(rows, local.ravel(), rcond=None)
    return values, np.abs(rows @ values - local.ravel()).max() / np.abs(local).max()


SCATTERED = np.random.default_rng(5).uniform(-0.6, 0.6, (40, 2))


@pytest.mark.parametrize("name", OUTLINES)
def test_rigid_motions_strain_nothing_and_have_the_moments_of_the_area(name):
    """To round-off, on meshes of cells, of similar triangles and of netgen."""
    planform, material = OUTLINES[name], sheet()
    elements = Argyris(triangulation(planform, planform.size / 6.0), planform.size / 6.0)
    K, M = stiffness_and_mass(elements, planform, material)
    size = np.abs(elements.rigid).max(axis=0)
    assert np.abs(K @ elements.rigid / size).max() < 1e-11 * np.abs(K).max()
    moments = elements.rigid.T @ (M @ elements.rigid)
    expected = 2700.0 * 0.001 * area_moments(planform.array)
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    np.testing.assert_allclose(moments / scale, expected / scale, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("coefficients", "curvature"),
    [
        ([((2, 0), 1.0)], (2.0, 0.0, 0.0)),
        ([((1, 1), 1.0)], (0.0, 0.0, 2.0)),
        ([((2, 0), 1.0), ((0, 2), -0.7), ((1, 1), 0.4), ((0, 1), 3.0)], (2.0, -1.4, 0.8)),
    ],
)
def test_constant_curvature_has_its_exact_energy_on_a_distorted_mesh(coefficients, curvature):
    """Patch test: 1/2 A k^T D k."""
    elements, material = distorted(), sheet()
    values, error = interpolated(elements, coefficients)
    assert error < 1e-11
    K, _ = stiffness_and_mass(elements, SQUARE, material)
    k = np.array(curvature)
    exact = 0.01 * k @ (0.001**3 / 12.0 * material.stiffness) @ k
    assert values @ (K @ values) == pytest.approx(exact, rel=1e-9)


def test_quintics_are_held_exactly():
    """The elements are complete to degree five."""
    elements = distorted()
    assert interpolated(elements, [((3, 2), 1e4), ((0, 5), -3e4), ((4, 0), 5e2)])[1] < 1e-9


@pytest.mark.parametrize("planform", [SQUARE, L_SHAPE], ids=["square", "L"])
def test_value_and_slopes_continue_across_every_border(planform):
    """And the curvature along it; of any function, random degrees of freedom."""
    size = planform.size / 4.0
    elements = distorted() if planform is SQUARE else Argyris(triangulation(planform, size), size)
    values = np.random.default_rng(2).normal(size=(elements.size, 3))
    polynomials = elements.polynomials(values)
    seen, borders = {}, 0
    for element, corners in enumerate(elements.corners):
        for a, b in SIDES:
            ends = corners[a], corners[b]
            p, q = elements.triangles.points[list(ends)]
            at = p + np.linspace(0.0, 1.0, 7)[:, None] * (q - p)
            s = elements.sizes[element]
            local = (at - elements.middles[element]) / s
            field = np.array(
                [
                    monomials(local, d) @ polynomials[element] * (size / s) ** sum(d)
                    for d in ((0, 0), (1, 0), (0, 1))
                ]
            )
            if ends in seen:
                borders += 1
                np.testing.assert_allclose(field, seen[ends], rtol=0, atol=1e-11)
            seen[ends] = field
    assert borders == 3 * len(elements.corners) - len(seen)


def test_a_held_edge_does_not_move_wherever_it_points():
    """Displacement and both slopes vanish along the slanting inboard edge; the rest is free."""
    size = 0.02
    elements = Argyris(triangulation(TRAPEZOID, size), size)
    basis = held_along(elements, TRAPEZOID.inboard_edge).toarray()
    assert np.linalg.matrix_rank(basis) == basis.shape[1]
    polynomials = elements.polynomials(basis)
    first, last = TRAPEZOID.inboard_edge
    at = first + np.linspace(0.0, 1.0, 40)[:, None] * (last - first)
    element = elements.triangles.holding(at)
    local = (at - elements.middles[element]) / elements.sizes[element][:, None]
    for d in ((0, 0), (1, 0), (0, 1)):
        field = np.einsum("mk,mkn->mn", monomials(local, d), polynomials[element])
        assert np.abs(field).max() < 1e-10
    cells = elements.sides_between(np.arange(len(elements.triangles.points)))
    assert len(cells) == elements.size - 6 * len(elements.triangles.points)


@pytest.mark.parametrize("name", OUTLINES)
def test_triangles_fill_the_outline_once(name):
    """Their areas add up to that of the outline, none is flat, and none is far too large."""
    planform = OUTLINES[name]
    triangles = triangulation(planform, planform.size / 10.0)
    corners = triangles.points[triangles.corners]
    areas = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 2.0
    assert areas.sum() == pytest.approx(planform.area, rel=1e-12)
    sides = np.linalg.norm(np.roll(corners, 1, axis=1) - corners, axis=2).max(axis=1)
    assert np.all(areas / sides**2 > 0.08)
    assert sides.max() < 2.5 * planform.size / 10.0
    assert len(np.unique(triangles.corners)) == len(triangles.points)


def test_cells_are_the_same_from_either_end():
    """A rectangle turned over about its middle lines has the same vertices and triangles."""
    triangles = triangulation(SQUARE, 0.1 / 3.0)

    def middles(points):
        places = points[triangles.corners].mean(axis=1)
        return sorted(map(tuple, np.round(places, 12) + 0.0))

    original = middles(triangles.points)
    for turned in ((-1.0, 1.0, 0.0), (1.0, -1.0, 0.1)):
        flipped = triangles.points * turned[:2] + [0.0, turned[2]]
        np.testing.assert_allclose(middles(flipped), original, atol=1e-12)


def test_an_outline_that_needs_netgen_says_how_to_install_it(monkeypatch):
    """Triangles and convex outlines of four corners do without."""
    monkeypatch.setitem(sys.modules, "netgen.geom2d", None)
    triangulation(DELTA, 0.02), triangulation(TRAPEZOID, 0.02)
    for planform in (L_SHAPE, ARROW):
        with pytest.raises(InputError, match=r'pip install "foldwing\[mesh\]"'):
            triangulation(planform, 0.02)


@pytest.mark.parametrize("name", ["square", "arrow", "L"])
def test_points_are_found_in_the_triangle_that_holds_them(name):
    """Inside, at corners, and outside by round-off; far outside, in one that is near."""
    triangles = triangulation(OUTLINES[name], 0.015)
    corners = triangles.points[triangles.corners]
    rng = np.random.default_rng(1)
    share = rng.dirichlet(np.ones(3), 500)
    held = rng.integers(len(corners), size=500)
    points = np.einsum("mk,mka->ma", share, corners[held])
    np.testing.assert_array_equal(triangles.holding(points), held)
    for shift in (0.0, 1e-12, -1e-12):
        found = triangles.holding(triangles.points + shift)
        near = np.abs(corners[found] - triangles.points[:, None]).max(axis=2).min(axis=1)
        assert near.max() < 1e-15
    away = triangles.holding(np.array([[10.0, 10.0], [-10.0, 0.05]]))
    assert np.all((away >= 0) & (away < len(corners)))
