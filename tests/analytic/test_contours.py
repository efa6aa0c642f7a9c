"""Determinant contours against certified roots and functions with known zeros."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.stability.contours import contour_roots, determinant_map
from foldwing.stability.domains import Rectangle
from foldwing.stability.problem import Pencil
from foldwing.stability.spectrum import spectrum_at_speed
from support.typical_section import ManySections, TypicalSection

FLUTTER = 2.183915 / 0.4
SECTIONS = ManySections(
    tuple(TypicalSection(e=0.1 + 0.02 * i, pitch_frequency=2 + 0.3 * i) for i in range(6))
)


@dataclass(frozen=True)
class Scalar:
    """One equation f(lambda) = 0: half chord and speed are 1."""

    f: object
    size: int = 1
    half_chord: float = 1.0
    highest_frequency: float = math.inf
    largest_decay: float = math.inf

    def pencil(self, p):
        return Pencil(np.zeros((1, 1), complex), None, self.f(p)[:, None, None])


def grid_roots(problem, speed, cells, shift=0.0):
    growth = np.linspace(-1.0, 0.5, cells + 1) + shift * 1.5 / cells
    frequency = np.linspace(0.1, 3.1, cells + 1) + shift * 3.0 / cells
    return contour_roots(determinant_map(problem, speed, growth, frequency))


def test_roots_converge_with_the_square_of_the_grid():
    region = Rectangle((-0.3, 0.2), (0.01, 1.0))
    exact = spectrum_at_speed(TypicalSection(), FLUTTER, region).eigenvalues
    assert exact.size == 2
    cells = np.array([25, 50, 100, 200])
    shifts = np.linspace(0.0, 1.0, 8, endpoint=False)  # the error depends on the place in the cell
    errors = [
        np.mean([np.abs(grid_roots(TypicalSection(), FLUTTER, n, s) - exact) for s in shifts])
        for n in cells
    ]
    order = -np.polyfit(np.log(cells), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.2)
    assert errors[-1] < 1e-4


def test_many_roots_on_a_grid():
    region = Rectangle((-0.25, 0.12), (0.025, 0.76))
    exact = spectrum_at_speed(SECTIONS, 4.0, region).eigenvalues
    found = grid_roots(SECTIONS, 4.0, 300)
    found = found[region.contains(found / 4.0)]
    distance = np.abs(found[:, None] - exact)
    assert found.size == exact.size == 10
    assert distance.min(axis=0).max() < 5e-3  # half a cell
    assert distance.min(axis=1).max() < 5e-3  # half a cell


@pytest.mark.parametrize("root", [0.25 + 0.5j, 0.25 + 0.53j, 0.27 + 0.5j, 0.27 + 0.53j])
def test_root_on_a_node_or_an_edge_is_found_once(root):
    grid = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    contours = determinant_map(Scalar(lambda p: (p - root) * (2 - 1j)), 1.0, grid, grid + 0.25)
    np.testing.assert_allclose(contour_roots(contours), [root], atol=1e-14)


def test_pole_is_not_a_root():
    grid = np.linspace(0.1, 1.0, 10)
    pole = 0.43 + 0.57j
    contours = determinant_map(Scalar(lambda p: 1 / (p - pole)), 1.0, grid, grid)
    assert contour_roots(contours).size == 0


def test_huge_determinants_do_not_overflow():
    growth, frequency = np.linspace(-1, 0.5, 61), np.linspace(0.1, 3.1, 61)
    plain = determinant_map(SECTIONS, 4.0, growth, frequency)

    class Huge:
        size, half_chord = SECTIONS.size, SECTIONS.half_chord

        def pencil(self, p):
            T0, _, T2 = SECTIONS.pencil(p)
            return Pencil(1e40 * T0, None, 1e40 * T2)

    huge = determinant_map(Huge(), 4.0, growth, frequency)
    assert np.all(np.isfinite(huge.log_magnitude))
    np.testing.assert_allclose(contour_roots(huge), contour_roots(plain), rtol=1e-9)
    np.testing.assert_allclose(huge.determinant, plain.determinant, atol=1e-12)


def test_map_has_the_phase_of_the_determinant():
    zeros = [0.3 + 0.4j, -0.2 + 0.9j]
    growth, frequency = np.linspace(-1, 1, 7), np.linspace(0.05, 2, 5)
    contours = determinant_map(
        Scalar(lambda p: (p - zeros[0]) * (p - zeros[1])), 1.0, growth, frequency
    )
    z = growth[:, None] + 1j * frequency
    expected = (z - zeros[0]) * (z - zeros[1])
    np.testing.assert_allclose(contours.determinant, expected / np.abs(expected).max(), rtol=1e-12)


@pytest.mark.parametrize(
    ("speed", "growth", "frequency", "field"),
    [
        (0.0, [0, 1], [1, 2], "speed"),
        (1.0, [1, 0], [1, 2], "growth"),
        (1.0, [0, 1], [0, 2], "angular_frequency"),
        (1.0, [0, 1], [1], "angular_frequency"),
    ],
)
def test_refuses_unsuitable_grids(speed, growth, frequency, field):
    with pytest.raises(InputError) as caught:
        determinant_map(TypicalSection(), speed, np.array(growth), np.array(frequency))
    assert caught.value.field == field
