"""Theodorsen's function against printed tables, another representation and Cauchy's integral."""

import numpy as np
import pytest
from scipy.special import hankel2

from foldwing.maths.bessel import theodorsen, theodorsen_with_derivative

# p, C(p) and C'(p) evaluated with 40 digits; the derivative by differences, not in closed form.
FORTY_DIGITS = [
    (
        0.02 + 0.3j,
        0.6671996364200874 - 0.1695938559423121j,
        0.09070739471330976 + 0.4805873547548257j,
    ),
    (
        -0.3 + 0.4j,
        0.5315938129041797 - 0.2306401971727488j,
        0.4025059332935229 + 0.03972270388578004j,
    ),
    (
        -1 + 0.01j,
        0.31386354007320816 - 0.09633115710921121j,
        -0.14730389182916553 - 0.2262741050680986j,
    ),
    (1e-8j, 0.9999999842920027 - 1.8536611677265288e-07j, -17.53661112633519 + 1.5708027788340349j),
    (
        -7 + 16j,
        0.49727990268613254 - 0.006703686038135794j,
        0.0003002850216029388 - 0.00029148564303807723j,
    ),
    (
        -8 + 16.5j,
        0.4971498950104211 - 0.006277183366029486j,
        0.00025024542695174687 - 0.00028602511486607j,
    ),
    (
        -40 + 1j,
        0.4968370810287385 - 8.009391508913348e-05j,
        -7.999122109517888e-05 - 4.054328670749764e-06j,
    ),
    (
        300j,
        0.5000006944352821 - 0.00041666464126116767j,
        1.3888686352169624e-06 + 4.6295074680761456e-09j,
    ),
    (5 + 0j, 0.5228495529232773 + 0j, -0.004196473739686705 + 0j),
]


def cut_plane(count=200):
    """Points at all distances from the origin and all sides of the cut."""
    rng = np.random.default_rng(7)
    return 10 ** rng.uniform(-4, 2.5, count) * np.exp(1j * rng.uniform(-3.0, 3.0, count))


@pytest.mark.parametrize(
    ("k", "F", "G"), [(0.1, 0.8319, -0.1723), (0.5, 0.5979, -0.1507), (1.0, 0.5394, -0.1003)]
)
def test_reproduces_the_printed_table(k, F, G):
    assert np.round(theodorsen(1j * k), 4) == F + 1j * G


def test_equals_the_ratio_of_hankel_functions_on_the_imaginary_axis():
    k = np.geomspace(1e-4, 60, 300)
    H0, H1 = hankel2(0, k), hankel2(1, k)
    np.testing.assert_allclose(theodorsen(1j * k), H1 / (H1 + 1j * H0), rtol=1e-13)


@pytest.mark.parametrize(("p", "value", "derivative"), FORTY_DIGITS)
def test_has_the_digits_of_extended_precision(p, value, derivative):
    C, dC = theodorsen_with_derivative(p)
    assert abs(C - value) < 3e-15 * abs(value)
    assert abs(dC - derivative) < 1e-11 * abs(derivative)


def test_derivative_equals_cauchys_integral():
    p = cut_plane()
    distance = np.where(p.real < 0, np.abs(p.imag), np.abs(p))
    turn = np.exp(2j * np.pi * np.arange(64) / 64)
    circle = theodorsen(p[:, None] + 0.5 * distance[:, None] * turn)
    by_cauchy = (circle / turn).mean(axis=1) / (0.5 * distance)
    derivative = theodorsen_with_derivative(p)[1]
    # The integral loses the digits of C over r C'.
    lost = 1e-14 / (distance * np.abs(derivative))
    assert np.all(np.abs(by_cauchy / derivative - 1) < 1e-11 + lost)


def test_is_real_on_conjugate_pairs():
    p = cut_plane()
    np.testing.assert_allclose(theodorsen(p.conj()), theodorsen(p).conj(), rtol=1e-14)


def test_tends_to_one_at_the_origin_and_to_one_half_far_away():
    assert theodorsen(0) == 1
    assert abs(theodorsen(1e-12j) - 1) < 1e-10
    far = 10.0 ** np.array([3, 6, 12, 300])
    assert np.all(np.abs(theodorsen(1j * far) - 0.5) < 0.13 / far + 1e-16)
    assert theodorsen(np.inf) == 0.5


def test_derivative_at_the_origin_is_minus_infinity():
    C, dC = theodorsen_with_derivative(np.zeros(2))
    assert np.array_equal(C, [1, 1])
    assert np.all(dC.real == -np.inf)


def test_keeps_shapes_and_passes_nan_on():
    C, dC = theodorsen_with_derivative(np.full((2, 3), 0.1j))
    assert C.shape == dC.shape == (2, 3)
    assert theodorsen(0.1j).shape == ()
    assert np.isnan(theodorsen(complex(np.nan, 1.0)))
