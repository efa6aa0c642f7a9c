"""Spanwise functions against extended precision, exact polynomials and their own definitions."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from foldwing.structure.spanwise import (
    BeamBending,
    BeamTorsion,
    JacobiFunctions,
    Joined,
    Monomials,
    Root,
    beam_wave_numbers,
    bending_functions,
    torsion_functions,
)

# Roots number 1, 2, 3, 10 and 30 of cos x cosh x = -1 and +1, found with 90 digits.
NUMBERS = (1, 2, 3, 10, 30)
CLAMPED_ROOTS = (
    1.8751040687119612,
    4.6940911329741746,
    7.8547574382376126,
    29.845130209102817,
    92.676983280898901,
)
FREE_ROOTS = (
    4.730040744862704,
    7.8532046240958376,
    10.995607838001671,
    32.98672286269282,
    95.818575934488694,
)

# Clamped, number, y, f, f', f'' of a beam of length 1: the textbook's differences of hyperbolic
# functions evaluated with 90 digits.
NINETY_DIGITS = [
    (True, 1, 0.05, 0.0085883811100376755, 0.33950221488672089, 6.5480714339266603),
    (True, 1, 0.37, 0.39991271133437712, 1.9438782029149853, 3.5115474985513806),
    (True, 1, 0.9, 1.7247990866913805, 2.7490319827702052, 0.11795176286436519),
    (True, 1, 1.0, 2.0, 2.7530109693450696, 0.0),
    (True, 2, 0.05, 0.050697426487670188, 1.9401476023670937, 33.540086559402187),
    (True, 2, 0.37, 1.2949864069217718, 2.7591712413433739, -23.014002249374188),
    (True, 2, 1.0, -2.0, -9.561556820423268, 0.0),
    (True, 10, 0.05, 1.143322911140289, 25.383634111899171, -617.80584256244575),
    (True, 10, 0.9, 1.0935586844133482, 23.29978737085265, -1064.1456334490912),
    (True, 10, 1.0, -2.0, -59.690260418218677, 0.0),
    (True, 30, 0.05, -0.9087409544000061, -100.56321190404935, 7972.1211166750323),
    (True, 30, 0.37, 1.2284304684231723, -64.937313503959813, -10551.017829785368),
    (True, 30, 0.9, 1.1440283800347032, 77.029350447170363, -9827.7083793075163),
    (True, 30, 1.0, -2.0, -185.3539665617978, 0.0),
    (False, 1, 0.05, 1.5355210442231507, -9.2749057019599713, 1.154492836866939),
    (False, 1, 0.37, -0.92252151169154011, -4.4018167436188155, 30.599796814673538),
    (False, 1, 1.0, 2.0, 9.2945510137268907, 0.0),
    (False, 2, 0.37, -1.1585805873569743, 5.3205253504958055, 77.327735541347037),
    (False, 2, 0.9, -0.45485869368446226, -14.699364400623632, -28.106656455340968),
    (False, 10, 0.05, -0.88319898486178837, -36.636231463493146, 1379.2556461681489),
    (False, 10, 0.9, 0.79432170534234893, 36.52259064685288, -944.69397321436949),
    (False, 10, 1.0, -2.0, -65.973445725386262, 0.0),
    (False, 30, 0.05, 1.0836811698440241, 87.209612023956297, -9796.9980519449205),
    (False, 30, 0.37, 0.15518775100262496, 134.68959119071584, -1424.8097009978855),
    (False, 30, 1.0, -2.0, -191.63715186897739, 0.0),
]

MOST = 30
LENGTH = 0.14
FAMILIES = [
    pytest.param(BeamBending(LENGTH, MOST, clamped=True), id="bending-clamped"),
    pytest.param(BeamBending(LENGTH, MOST, clamped=False), id="bending-free"),
    pytest.param(BeamTorsion(LENGTH, MOST, clamped=True), id="torsion-clamped"),
    pytest.param(BeamTorsion(LENGTH, MOST, clamped=False), id="torsion-free"),
    pytest.param(Monomials(LENGTH, 2), id="rigid"),
    pytest.param(JacobiFunctions(LENGTH, MOST, 0), id="jacobi-0"),
    pytest.param(JacobiFunctions(LENGTH, MOST, 1), id="jacobi-1"),
    pytest.param(JacobiFunctions(LENGTH, MOST, 2), id="jacobi-2"),
]


def gauss(length, points=160):
    """Nodes and weights on [0, length] that integrate products of all functions here exactly."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return (nodes + 1) * length / 2, weights * length / 2


def gram(f, g, weights):
    """Integrals of all products of the columns of f and g."""
    return np.einsum("yi,y,yj->ij", f, weights, g)


@pytest.mark.parametrize(("clamped", "roots"), [(True, CLAMPED_ROOTS), (False, FREE_ROOTS)])
def test_wave_numbers_have_the_digits_of_extended_precision(clamped, roots):
    """The roots of the frequency equation to round-off, first and thirtieth alike."""
    found = np.array(beam_wave_numbers(MOST, clamped))[np.array(NUMBERS) - 1]
    np.testing.assert_allclose(found, roots, rtol=4e-16)


@pytest.mark.parametrize(("clamped", "number", "y", "f", "slope", "curvature"), NINETY_DIGITS)
def test_beam_functions_have_the_digits_of_extended_precision(
    clamped, number, y, f, slope, curvature
):
    """No digit is lost to hyperbolic functions: the naive form fails from mode 10 on."""
    beam = BeamBending(1.0, number, clamped)
    root = beam_wave_numbers(number, clamped)[-1]
    for order, exact in enumerate((f, slope, curvature)):
        value = beam.evaluate(np.array([y]), order)[0, -1]
        assert abs(value - exact) < 5e-14 * root**order


@pytest.mark.parametrize("clamped", [True, False])
def test_thirty_beam_functions_are_orthogonal_in_mass_and_stiffness(clamped):
    """Integrals of f_i f_j are L or zero, those of f_i'' f_j'' are beta^4 L or zero, to 1e-12."""
    y, weights = gauss(LENGTH)
    beam = BeamBending(LENGTH, MOST, clamped)
    f, curvature = beam.evaluate(y, 0), beam.evaluate(y, 2)
    np.testing.assert_allclose(gram(f, f, weights) / LENGTH, np.eye(MOST), atol=1e-12)
    beta2 = (np.array(beam_wave_numbers(MOST, clamped)) / LENGTH) ** 2
    stiffness = gram(curvature, curvature, weights) / np.outer(beta2, beta2) / LENGTH
    np.testing.assert_allclose(stiffness, np.eye(MOST), atol=1e-12)


@pytest.mark.parametrize("kind", ["bending", "torsion"])
def test_elastic_free_functions_move_no_mass_centre_and_do_not_turn(kind):
    """Free elastic modes are orthogonal to the rigid motions of their segment."""
    functions = bending_functions if kind == "bending" else torsion_functions
    y, weights = gauss(LENGTH)
    rigid = 2 if kind == "bending" else 1
    f = functions(LENGTH, MOST, Root.FREE, "free-free").evaluate(y, 0)
    overlap = gram(f[:, :rigid], f[:, rigid:], weights) / LENGTH
    np.testing.assert_allclose(overlap, 0.0, atol=1e-13)


@pytest.mark.parametrize("clamped", [True, False])
def test_torsion_functions_are_orthogonal(clamped):
    """Integrals of products of sines or cosines, and of their derivatives, are diagonal."""
    y, weights = gauss(LENGTH)
    bar = BeamTorsion(LENGTH, MOST, clamped)
    number = np.arange(1, MOST + 1) - (0.5 if clamped else 0.0)
    mass = gram(bar.evaluate(y, 0), bar.evaluate(y, 0), weights)
    strain = gram(bar.evaluate(y, 1), bar.evaluate(y, 1), weights)
    scale = number * np.pi / LENGTH
    np.testing.assert_allclose(mass / (LENGTH / 2), np.eye(MOST), atol=1e-12)
    np.testing.assert_allclose(
        strain / np.outer(scale, scale) / (LENGTH / 2), np.eye(MOST), atol=1e-12
    )


def third_derivative(beam, end, beta, inward):
    """f''' at an end by one-sided differences of f'', second order, one step per function."""
    steps = inward * 1e-4 / beta
    f = [
        np.array([beam.evaluate(np.array([end + n * h]), 2)[0, j] for j, h in enumerate(steps)])
        for n in range(3)
    ]
    return (-3 * f[0] + 4 * f[1] - f[2]) / (2 * steps)


@pytest.mark.parametrize(
    ("clamped", "end"), [(True, LENGTH), (False, LENGTH), (False, 0.0)], ids=["c-L", "f-L", "f-0"]
)
def test_free_ends_carry_neither_moment_nor_shear(clamped, end):
    """At a free end f'' is zero, and so is f''' by finite differences, for 30 modes."""
    beam = BeamBending(LENGTH, MOST, clamped)
    beta = np.array(beam_wave_numbers(MOST, clamped)) / LENGTH
    moment = beam.evaluate(np.array([end]), 2)[0] / beta**2
    shear = third_derivative(beam, end, beta, 1 if end == 0.0 else -1) / beta**3
    np.testing.assert_allclose(moment, 0.0, atol=1e-13)
    np.testing.assert_allclose(shear, 0.0, atol=1e-7)


@pytest.mark.parametrize(
    ("functions", "highest"),
    [
        (BeamBending(LENGTH, MOST, clamped=True), 1),
        (JacobiFunctions(LENGTH, MOST, 2), 1),
        (BeamTorsion(LENGTH, MOST, clamped=True), 0),
        (JacobiFunctions(LENGTH, MOST, 1), 0),
    ],
)
def test_clamped_functions_vanish_at_the_clamp_and_no_further(functions, highest):
    """Value (and slope of bending) are zero at the root; the next derivative is not."""
    root = np.zeros(1)
    for order in range(highest + 1):
        scale = np.abs(functions.evaluate(np.linspace(0, LENGTH, 200), order)).max(axis=0)
        assert np.all(np.abs(functions.evaluate(root, order)[0]) < 1e-13 * scale)
    assert np.all(np.abs(functions.evaluate(root, highest + 1)) * LENGTH > 0.5)


@pytest.mark.parametrize("functions", FAMILIES)
@pytest.mark.parametrize("order", [1, 2])
def test_derivatives_equal_finite_differences(functions, order):
    """First and second derivative against eighth-order differences of the one before."""
    y, h = np.linspace(0.1, 0.9, 17) * LENGTH, 2e-3 * LENGTH
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    lower = functions.evaluate
    difference = sum(
        w * (lower(y + n * h, order - 1) - lower(y - n * h, order - 1)) for n, w in weights.items()
    )
    exact = functions.evaluate(y, order)
    everywhere = functions.evaluate(np.linspace(0, LENGTH, 300), order)
    scale = np.maximum(np.abs(everywhere).max(axis=0), 1.0 / LENGTH**order)
    assert np.all(np.abs(difference / h - exact) < 1e-8 * scale)


@pytest.mark.parametrize("root", [0, 1, 2])
def test_jacobi_functions_are_orthogonal_and_one_at_the_tip(root):
    """Integral of f_i f_j is L / (2 j + 2 root + 1) or zero: the norm of Jacobi polynomials."""
    y, weights = gauss(LENGTH)
    functions = JacobiFunctions(LENGTH, MOST, root)
    f = functions.evaluate(y, 0)
    norms = LENGTH / (2 * np.arange(MOST) + 2 * root + 1)
    scale = np.sqrt(np.outer(norms, norms))
    np.testing.assert_allclose(gram(f, f, weights) / scale, np.eye(MOST), atol=1e-12)
    np.testing.assert_allclose(functions.evaluate(np.array([LENGTH]), 0)[0], 1.0, rtol=1e-13)


@pytest.mark.parametrize("root", [0, 1, 2])
@pytest.mark.parametrize("order", [0, 1, 2])
def test_jacobi_functions_contain_every_polynomial_that_obeys_the_clamp(root, order):
    """s^root times any polynomial of degree n - 1 is met exactly, with its derivatives."""
    count = 9
    functions = JacobiFunctions(LENGTH, count, root)
    free = Polynomial(np.random.default_rng(3).standard_normal(count))
    wanted = Polynomial.basis(root) * free
    nodes = np.linspace(0.03, 1.0, 40)
    system = functions.evaluate(nodes * LENGTH, 0)
    coefficients, *_ = np.linalg.lstsq(system, wanted(nodes), rcond=None)
    s = np.linspace(0, 1, 23)
    found = functions.evaluate(s * LENGTH, order) @ coefficients * LENGTH**order
    exact = wanted.deriv(order)(s)
    np.testing.assert_allclose(found, exact, atol=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("root", [0, 1, 2])
def test_jacobi_function_number_j_has_degree_j_plus_root(root):
    """Each function is orthogonal to all polynomials of lower degree under its own weight."""
    y, weights = gauss(1.0)
    f = JacobiFunctions(1.0, 12, root).evaluate(y, 0)
    lower = np.stack([y ** (root + k) for k in range(12)], axis=1)
    products = gram(lower, f, weights)
    np.testing.assert_allclose(np.triu(products, 1), 0.0, atol=1e-14)
    assert np.all(np.diag(products) > 1e-9)


@pytest.mark.parametrize("basis", ["free-free", "converged"])
@pytest.mark.parametrize("root", Root)
def test_counts_are_those_promised(basis, root):
    """Unless clamped, a segment has one bending function more, its translation."""
    y = np.linspace(0, LENGTH, 50)
    bending = bending_functions(LENGTH, 7, root, basis)
    torsion = torsion_functions(LENGTH, 5, root, basis)
    wanted = 7 if root is Root.CLAMPED else 8
    assert bending.count == wanted == np.linalg.matrix_rank(bending.evaluate(y, 0))
    assert torsion.count == 5 == np.linalg.matrix_rank(torsion.evaluate(y, 0))


def test_joined_families_stand_side_by_side():
    """Columns keep their order: rigid motions first, then elastic modes."""
    parts = (Monomials(2.0, 2), BeamBending(2.0, 3, clamped=False))
    y = np.array([0.0, 0.5, 2.0])
    joined = Joined(parts).evaluate(y, 1)
    np.testing.assert_array_equal(joined[:, 2:], parts[1].evaluate(y, 1))
    np.testing.assert_array_equal(joined[:, :2], [[0.0, 0.5]] * 3)
