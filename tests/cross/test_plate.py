"""Plates by finite elements against polynomials over the whole plate, and another assembly."""

import numpy as np
import pytest
import scipy.linalg

from foldwing.model import rectangle
from foldwing.structure.plate_elastic import elastic_modes
from foldwing.structure.plate_elements import Argyris, stiffness_and_mass
from foldwing.structure.plate_mesh import triangulation
from support.plates import SQUARE, TRAPEZOID, parameters, ritz, sheet


@pytest.mark.parametrize("length", [0.1, 0.2])
def test_cantilevers_agree_with_the_ritz_method(length):
    """Both lie above the exact value, by what their functions leave of the corners: 0.02 %."""
    found = elastic_modes(rectangle(length, 0.1, 0.5), sheet(), 6, True, 0.1 / 14.0).omega2
    other = np.sqrt(ritz(length / 0.1, 1.0, 0.3, True, 18)[:6]) * (length / 0.1) ** 2
    np.testing.assert_allclose(parameters(found, length, sheet()), other, rtol=2e-4)


@pytest.mark.parametrize(("nu", "width"), [(0.3, 0.1), (0.45, 0.05), (0.0, 0.08)])
def test_free_rectangles_agree_with_the_ritz_method(nu, width):
    """Six digits, for there are no such corners; the rigid motions are none of the modes."""
    material = sheet(poissons_ratio=nu)
    found = elastic_modes(rectangle(0.1, width, 0.5), material, 6, False, 0.008).omega2
    other = np.sqrt(ritz(1.0, width / 0.1, nu, False, 18)[3:9])
    np.testing.assert_allclose(parameters(found, 0.1, material), other, rtol=1e-6)


@pytest.mark.parametrize("planform", [SQUARE, TRAPEZOID], ids=["square", "trapezoid"])
def test_matrices_have_the_eigenvalues_of_scikit_fems_own_argyris_element(planform):
    """Its element in absolute coordinates, assembled by its own forms, lengths of order one."""
    from skfem import Basis, BilinearForm, ElementTriArgyris, MeshTri
    from skfem.helpers import dd, ddot, eye, trace

    size = planform.size / 3.0
    elements = Argyris(triangulation(planform, size), size)
    mine = [matrix.toarray() for matrix in stiffness_and_mass(elements, planform, sheet())]
    t, nu, D = 0.001, 0.3, 70e9 * 0.001**3 / 12.0 / 0.91

    @BilinearForm
    def energy(u, v, _):
        C = dd(u)
        return ddot((1.0 - nu) * C + nu * eye(trace(C), 2), dd(v))

    @BilinearForm
    def square(u, v, _):
        return u * v

    points = np.ascontiguousarray(elements.triangles.points.T / size)
    mesh = MeshTri(points, np.ascontiguousarray(elements.triangles.corners.T))
    basis = Basis(mesh, ElementTriArgyris(), intorder=12)
    K, M = (form.assemble(basis).toarray() for form in (energy, square))
    theirs = scipy.linalg.eigh(K * D / size**2, M * 2700.0 * t * size**2, eigvals_only=True)
    ours = scipy.linalg.eigh(*mine, eigvals_only=True)
    np.testing.assert_allclose(ours[3:40], theirs[3:40], rtol=1e-8)
