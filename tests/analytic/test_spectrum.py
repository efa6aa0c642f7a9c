"""All roots in a region: found, counted, and the certificate that can say no."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

from foldwing.errors import InputError
from foldwing.stability.domains import Ellipse, Rectangle
from foldwing.stability.rootfinding import count_roots
from foldwing.stability.spectrum import all_roots, at_speed, spectrum_at_speed, verified
from foldwing.stability.status import Status
from support.typical_section import ExponentialProblem, ManySections, TypicalSection

EXPONENTIAL = ExponentialProblem()
FLUTTER = 2.183915 / 0.4  # Hodges and Pierce; speed over sigma
DIVERGENCE = 2.828427 / 0.4
UPPER = Rectangle((-0.6, 1.0), (0.005, 3.0))


class Polynomial:
    """Matrix polynomial sum A_j z^j."""

    def __init__(self, *coefficients):
        self.coefficients = [np.array(A, dtype=complex) for A in coefficients]

    def value(self, z):
        return sum(z[:, None, None] ** j * A for j, A in enumerate(self.coefficients))

    def derivative(self, z):
        terms = enumerate(self.coefficients[1:], start=1)
        return sum(j * z[:, None, None] ** (j - 1) * A for j, A in terms)


def matched(found, exact):
    """Largest distance between two sets of roots of equal number, paired at best."""
    assert found.shape == exact.shape
    distance = np.abs(found[:, None] - exact)
    rows, columns = scipy.optimize.linear_sum_assignment(distance)
    return distance[rows, columns].max(initial=0.0)


@pytest.mark.parametrize(
    ("region", "number"),
    [
        (Ellipse(0, (5, 5)), 1),
        (Ellipse(0, (8, 8)), 3),
        (Rectangle((-2.5, 5), (-5, 5)), 0),
        (Rectangle((-4, 5), (-20, 7)), 4),
        (Ellipse(2, (40, 40)), 7),
        (Rectangle((-5, 5), (-100, 100)), 17),
        (Ellipse(2, (9, 200)), 33),
    ],
)
def test_all_roots_of_the_exponential_problem(region, number):
    exact = EXPONENTIAL.exact_roots(40)
    exact = exact[region.contains(exact)]
    spectrum = all_roots(EXPONENTIAL, region)
    assert spectrum.count == exact.size == number
    assert spectrum.certified
    assert matched(spectrum.eigenvalues, exact) < 1e-12 * region.radius
    assert np.all(spectrum.residuals < 1e-14)
    assert spectrum.status == (Status.OK,) * number
    np.testing.assert_allclose(np.linalg.norm(spectrum.vectors, axis=0), 1)


def test_more_roots_than_rows_without_subdivision():
    spectrum = all_roots(EXPONENTIAL, Ellipse(0, (20, 20)), subdivisions=0)
    assert spectrum.certified
    assert spectrum.count == 5


def test_polish_converges_quadratically():
    spectrum = all_roots(EXPONENTIAL, Ellipse(0, (8, 8)), nodes=16)
    assert spectrum.certified
    assert 1 < max(spectrum.iterations) <= 6


def test_vectors_are_null_vectors():
    spectrum = all_roots(EXPONENTIAL, Ellipse(0, (8, 8)))
    T = EXPONENTIAL.value(spectrum.eigenvalues)
    assert np.abs(np.einsum("mij,jm->mi", T, spectrum.vectors)).max() < 1e-13


@pytest.mark.parametrize("seed", range(5))
def test_more_roots_than_rows_of_a_quadratic_problem(seed):
    rng = np.random.default_rng(seed)
    A0, A1 = rng.standard_normal((2, 5, 5))
    companion = np.block([[np.zeros((5, 5)), np.eye(5)], [-A0, -A1]])
    exact = scipy.linalg.eigvals(companion)
    spectrum = all_roots(Polynomial(A0, A1, np.eye(5)), Ellipse(0.1, (12, 11)))
    assert spectrum.certified
    assert spectrum.count == 10
    assert matched(spectrum.eigenvalues, exact) < 1e-10


@pytest.mark.parametrize("region", [Ellipse(0.1, (1, 1.2)), Rectangle((-1, 1.1), (-1, 1.3))])
@pytest.mark.parametrize(
    ("function", "exact"),
    [
        (Polynomial([[0.3]], [[0]], [[1]]), [1j * np.sqrt(0.3), -1j * np.sqrt(0.3)]),
        (Polynomial(np.zeros((2, 2)), np.eye(2)), [0, 0]),
        (Polynomial([[-0.3, 1], [0, -0.3]], np.eye(2)), [0.3, 0.3]),
        (Polynomial(np.diag([-0.3, -0.09]), np.diag([1, 0]), np.diag([0, 1])), [0.3, 0.3, -0.3]),
        (Polynomial([[-0.3, 1], [0, -0.3001]], np.eye(2)), [0.3, 0.3001]),
    ],
    ids=["scalar", "vanishing", "defective", "semi-simple", "close"],
)
def test_multiple_and_close_roots_are_counted_and_listed(function, exact, region):
    spectrum = all_roots(function, region)
    assert spectrum.certified
    assert spectrum.count == len(exact)
    assert matched(spectrum.eigenvalues, np.array(exact, dtype=complex)) < 1e-7


def test_semi_simple_root_has_independent_vectors():
    spectrum = all_roots(Polynomial(-0.3 * np.eye(2), np.eye(2)), Ellipse(0, (1, 1)))
    assert np.linalg.matrix_rank(spectrum.vectors) == 2


def test_count_does_not_settle_with_a_root_on_the_contour():
    assert count_roots(EXPONENTIAL, Ellipse(0, (3, 3))) is None


def test_count_sees_turns_between_the_first_points():
    # arg det T turns by nearly a full turn from one of the first contour points to the next.
    power = Polynomial(*[[[0.0]]] * 63, [[1.0]])
    assert count_roots(power, Ellipse(0, (1, 1))) == 63


def with_roots(spectrum, index):
    return replace(
        spectrum, eigenvalues=spectrum.eigenvalues[index], vectors=spectrum.vectors[:, index]
    )


def test_certificate_is_refused_when_a_root_is_withheld_doubled_or_invented():
    region = Ellipse(2, (40, 40))
    spectrum = all_roots(EXPONENTIAL, region)
    assert verified(EXPONENTIAL, spectrum, region).certified
    withheld = verified(EXPONENTIAL, with_roots(spectrum, np.arange(1, 7)), region)
    assert not withheld.certified
    assert withheld.count == 7
    doubled = with_roots(spectrum, np.array([1, 1, 2, 3, 4, 5, 6]))
    assert not verified(EXPONENTIAL, doubled, region).certified
    moved = np.where(np.arange(7) == 3, 1e-3, 0.0)
    invented = replace(spectrum, eigenvalues=spectrum.eigenvalues + moved)
    assert not verified(EXPONENTIAL, invented, region).certified


def test_certificate_ignores_roots_outside_the_region():
    spectrum = all_roots(EXPONENTIAL, Ellipse(2, (40, 40)))
    inner = verified(EXPONENTIAL, spectrum, Ellipse(0, (8, 8)))
    assert inner.certified
    assert inner.count == 3


def test_search_that_misses_roots_is_not_certified():
    region = Rectangle((-5, 5), (-100, 100))
    spectrum = all_roots(EXPONENTIAL, region, nodes=8, subdivisions=0)
    assert spectrum.count == 17
    assert spectrum.eigenvalues.size < 17
    assert not spectrum.certified


def test_typical_section_is_neutral_at_the_published_flutter_point():
    spectrum = spectrum_at_speed(TypicalSection(), FLUTTER, UPPER)
    assert spectrum.certified
    neutral = spectrum.eigenvalues[np.abs(spectrum.eigenvalues.real).argmin()]
    assert abs(neutral.real) < 1e-6
    assert neutral.imag * 0.4 == pytest.approx(0.648984, abs=1e-6)


@pytest.mark.parametrize(
    ("speed", "unstable"), [(0.99 * FLUTTER, 0), (1.01 * FLUTTER, 2), (1.05 * DIVERGENCE, 3)]
)
def test_flutter_adds_a_pair_and_divergence_a_real_root(speed, unstable):
    right_half = Rectangle((1e-3, 2), (-3, 3))
    spectrum = spectrum_at_speed(TypicalSection(), speed, right_half)
    assert spectrum.certified
    assert spectrum.count == unstable
    assert np.count_nonzero(np.abs(spectrum.eigenvalues.imag) < 1e-9) == unstable % 2


def test_eigenvalues_do_not_depend_on_the_unit_of_length():
    section = TypicalSection(damping_ratio=0.02)
    reference = spectrum_at_speed(section, 4.0, UPPER).eigenvalues
    scaled = spectrum_at_speed(replace(section, half_chord=0.25), 1.0, UPPER).eigenvalues
    np.testing.assert_allclose(scaled, reference, rtol=1e-12)


def test_sections_together_have_the_roots_of_each():
    sections = tuple(
        TypicalSection(e=0.1 + 0.02 * i, pitch_frequency=2 + 0.3 * i) for i in range(6)
    )
    alone = [spectrum_at_speed(section, 4.0, UPPER).eigenvalues for section in sections]
    together = spectrum_at_speed(ManySections(sections), 4.0, UPPER)
    assert together.certified
    assert matched(together.eigenvalues, np.concatenate(alone)) < 1e-10


def test_derivative_of_the_typical_section_is_that_of_its_value():
    function = at_speed(TypicalSection(damping_ratio=0.05), 3.0)
    p, h = np.array([0.1 + 0.4j, -0.2 + 0.7j, 0.3 + 0j]), 1e-5
    difference = (function.value(p + h) - function.value(p - h)) / (2 * h)
    np.testing.assert_allclose(function.derivative(p), difference, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize(
    "region", [Rectangle((-0.5, 1), (-1, 1)), Rectangle((-0.5, 1), (0, 1)), Ellipse(0.1, (0.2, 1))]
)
def test_refuses_regions_on_the_branch_cut(region):
    with pytest.raises(InputError, match="negative real axis"):
        spectrum_at_speed(TypicalSection(), FLUTTER, region)


def test_refuses_speed_zero():
    with pytest.raises(InputError, match="speed"):
        at_speed(TypicalSection(), 0.0)


class TwoRootsBeside:
    """A scalar function whose roots lie just below the edge of a rectangle."""

    def value(self, z):
        return ((z - 0.0301) * (z - 0.0307))[:, None, None]

    def derivative(self, z):
        return (2 * z - 0.0608)[:, None, None]


def test_roots_beside_the_contour_do_not_turn_it_unseen():
    """Stepping past two close roots outside the contour may look like no turn at all."""
    assert count_roots(TwoRootsBeside(), Rectangle((0.0, 1.2), (0.0002, 1.0))) == 0
