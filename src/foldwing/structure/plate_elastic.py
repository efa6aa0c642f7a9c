"""Elastic modes of a plate by finite elements: what of a plate segment is costly to compute.

They depend on nothing but the arguments of `elastic_modes`, so that they can be kept.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import eigsh

from foldwing.errors import ComputationError
from foldwing.maths.arrays import Indices, Real
from foldwing.model import Planform, Sheet
from foldwing.structure.plate_elements import Argyris, held_along, stiffness_and_mass
from foldwing.structure.plate_mesh import triangulation

RIGID = 3
"""Rigid motions of a free plate out of its plane."""

NEGLIGIBLE = 1e-6
"""Share of the first elastic omega^2 below which another is that of a rigid motion."""

SPARE = 4
"""Modes computed beyond those wanted, so that the last of them are not an equal pair's half."""


@dataclass(frozen=True)
class ElasticModes:
    """Elastic modes of a plate, their root mean square over its mass is one.

    The coefficients are those of the monomials of `plate_elements` in the coordinates of each
    element, measured from its middle in units of its size.

    Attributes
    ----------
    points : array, shape (v, 2)
        Vertices of the elements in m.
    corners : array of int, shape (e, 3)
    middles : array, shape (e, 2)
        m.
    sizes : array, shape (e,)
        m.
    coefficients : array, shape (e, 21, n)
    omega2 : array, shape (n,)
        Squares of the angular natural frequencies in rad^2/s^2, ascending.
    moments : array, shape (3, 3)
        Integral of the mass times products of 1, x and y: kg, kg m, kg m^2.
    coupling : array, shape (3, n)
        Integral of the mass times the modes times 1, x and y; zero for a free plate.
    """

    points: Real
    corners: Indices
    middles: Real
    sizes: Real
    coefficients: Real
    omega2: Real
    moments: Real
    coupling: Real


def elastic_modes(
    planform: Planform, sheet: Sheet, count: int, clamped: bool, size: float
) -> ElasticModes:
    """Return the lowest elastic modes of a plate that is clamped at its inboard edge, or free.

    Parameters
    ----------
    planform : Planform
    sheet : Sheet
    count : int
        Number of elastic modes.
    clamped : bool
    size : float
        Of the elements, in m.

    Raises
    ------
    InputError
        When the outline needs netgen and it is not installed.
    ComputationError
        When a free plate has not exactly three rigid motions, or the elements are too few.
    """
    elements = Argyris(triangulation(planform, size), size)
    K, M = stiffness_and_mass(elements, planform, sheet)
    if clamped:
        basis = held_along(elements, planform.inboard_edge)
        omega2, vectors = _lowest(basis.T @ K @ basis, basis.T @ M @ basis, count, 0.0)
        values = basis @ vectors
    else:
        omega2, values = _free(elements.rigid, K, M, count, _below_zero(planform, sheet))
    moments = elements.rigid.T @ (M @ elements.rigid)
    values = _signed(values * np.sqrt(moments[0, 0]), values[elements.of_vertex[:, 0]])
    return ElasticModes(
        elements.triangles.points,
        elements.triangles.corners,
        elements.middles,
        elements.sizes,
        elements.polynomials(values),
        omega2,
        moments,
        elements.rigid.T @ (M @ values) if clamped else np.zeros((RIGID, count)),
    )


def _lowest(K: csr_matrix, M: csr_matrix, count: int, shift: float) -> tuple[Real, Real]:
    """Return omega^2 nearest above a shift, ascending, and vectors of unit modal mass."""
    size = K.shape[0]
    if count + SPARE >= size:
        limit = f"{size} degrees of freedom are too few for {count} modes; choose smaller elements"
        raise ComputationError(f"modes of a plate: {limit}.")
    start = np.random.default_rng(0).normal(size=size)
    omega2, vectors = eigsh(K.tocsc(), count + SPARE, M.tocsc(), sigma=shift, v0=start)
    order = np.argsort(omega2)[:count]
    return omega2[order], vectors[:, order]


def _free(rigid: Real, K: csr_matrix, M: csr_matrix, count: int, shift: float) -> tuple[Real, Real]:
    """Return omega^2 and elastic modes of a free plate, at right angles to its rigid motions."""
    omega2, vectors = _lowest(K, M, count + RIGID, shift)
    zeros = np.count_nonzero(np.abs(omega2) < NEGLIGIBLE * omega2[RIGID])
    if zeros != RIGID:
        raise ComputationError(f"modes of a free plate: {zeros} of them are rigid, not {RIGID}.")
    elastic = vectors[:, RIGID:]
    elastic = elastic - rigid @ np.linalg.solve(rigid.T @ (M @ rigid), rigid.T @ (M @ elastic))
    return omega2[RIGID:], elastic / np.sqrt((elastic * (M @ elastic)).sum(axis=0))


def _below_zero(planform: Planform, sheet: Sheet) -> float:
    """Return a shift of omega^2 below zero, about as far as the first elastic mode is above."""
    t = float(np.mean(sheet.thickness))
    return float(-100.0 * sheet.stiffness[0, 0] * t**2 / 12.0 / sheet.density / planform.size**4)


def _signed(modes: Real, at_vertices: Real) -> Real:
    """Fix the sign: positive at the first of the vertices that move farthest but for round-off."""
    size = np.abs(at_vertices)
    first = np.argmax(size > (1.0 - 1e-6) * size.max(axis=0), axis=0)
    return np.asarray(modes * np.sign(at_vertices[first, np.arange(modes.shape[1])]))
