"""Identification finds the exponentials that a signal was made of."""

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.simulation import identify

STEP = 0.002
EIGENVALUES = np.array([-0.4 + 61.0j, 0.3 + 92.0j, -8.0 + 310.0j, -15.0 + 0.0j])
SHAPES = np.array([[1.0, 0.5j, 2.0], [0.3, 0.3, -0.2], [0.1j, 0.4, 0.1], [0.6, -0.2, 0.1]])


def signal(count, step=STEP):
    t = np.arange(count) * step
    return np.real(np.exp(np.multiply.outer(t, EIGENVALUES)) @ SHAPES)


@pytest.mark.parametrize("skip", [0, 40])
def test_the_motions_of_a_clean_signal(skip):
    found = identify(signal(600), STEP, skip)
    assert found.order == 7
    assert found.residual < 1e-8
    for value, shape in zip(EIGENVALUES, SHAPES, strict=True):
        index = found.nearest(value)
        assert found.eigenvalues[index] == pytest.approx(value, rel=1e-6)
        at_start = shape * np.exp(value * skip * STEP)
        np.testing.assert_allclose(found.shapes[index], at_start, atol=1e-6)


def test_damping_and_frequency_of_each_motion():
    found = identify(signal(600), STEP)
    strongest = found.nearest(EIGENVALUES[1])
    assert found.frequencies[strongest] == pytest.approx(92.0 / (2 * np.pi), rel=1e-6)
    assert found.dampings[strongest] == pytest.approx(-0.3 / 92.0, rel=1e-5)
    assert np.isnan(found.dampings[found.nearest(-15.0)])


def test_the_strongest_motion_at_the_end_comes_first():
    found = identify(signal(3000), STEP)
    assert found.eigenvalues[0] == pytest.approx(EIGENVALUES[1], rel=1e-6)


def test_noise_shows_in_the_residual():
    clean = signal(1500)
    noise = 1e-3 * np.random.default_rng(1).standard_normal(clean.shape)
    found = identify(clean + noise, STEP, tolerance=0.005)
    share = np.linalg.norm(noise) / np.linalg.norm(clean)
    assert 0.5 * share < found.residual < 3.0 * share
    assert found.eigenvalues[found.nearest(EIGENVALUES[1])] == pytest.approx(
        EIGENVALUES[1], rel=1e-3
    )


def test_too_short_a_record():
    with pytest.raises(InputError, match="at least 8"):
        identify(signal(20), STEP, skip=15)
