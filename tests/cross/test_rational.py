"""The rational approximation against the aerodynamic models it stands for."""

from functools import cache

import numpy as np
import pytest

from foldwing.aerodynamics.rational import rational_model
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import read_model
from foldwing.stability.flutter import find_flutter

KINDS = ("lattice", "strip")
FINE = 1j * np.linspace(1e-3, 1.0, 300)


@cache
def parts(kind):
    """The three-segment wing at 30, -75 degrees, its modes and its exact forces."""
    wing = AeroelasticWing(read_model("three-segment"), kind)
    modes = wing.modes(tuple(np.radians((30.0, -75.0))))
    return wing, modes, wing.aerodynamic_model(modes)


@cache
def fitted(kind, highest=1.0, count=64):
    return rational_model(parts(kind)[2], highest, count)


def worst(approximate, exact):
    """Largest error of any matrix relative to its largest entry."""
    return (np.abs(approximate - exact).max(axis=(1, 2)) / np.abs(exact).max(axis=(1, 2))).max()


@pytest.mark.parametrize("kind", [*KINDS, "quasi-steady"])
@pytest.mark.parametrize("growth", [0.0, 0.02, 0.1])
def test_forces_between_samples_and_of_growing_motions(kind, growth):
    p = FINE + growth
    assert worst(fitted(kind).forces(p), parts(kind)[2].forces(p)) < 1e-7
    assert fitted(kind).reached


@pytest.mark.parametrize("kind", KINDS)
def test_forty_eight_samples_reach_1e_7(kind):
    model = fitted(kind, count=48)
    assert worst(model.forces(FINE), parts(kind)[2].forces(FINE)) < 1e-7


@pytest.mark.parametrize("kind", KINDS)
def test_every_entry_is_met_on_the_scale_of_its_row_and_column(kind):
    Q, exact = fitted(kind).forces(FINE), parts(kind)[2].forces(FINE)
    size = np.abs(exact).max(axis=0)
    scale = np.sqrt(np.outer(size.max(axis=1), size.max(axis=0)))
    assert (np.abs(Q - exact) / scale).max() < 1e-7


@pytest.mark.parametrize("kind", KINDS)
def test_derivative_is_the_slope(kind):
    p, h = FINE[10::20] + 0.03, 1e-4
    model = fitted(kind)
    Q, dQ = model.forces_with_derivative(p)
    sides = [(model.forces(p + s * h) - model.forces(p - s * h)) / (2 * s * h) for s in (1, 2)]
    slope = (4 * sides[0] - sides[1]) / 3
    assert worst(dQ, slope) < 1e-8
    assert worst(dQ, parts(kind)[2].forces_with_derivative(p)[1]) < 1e-6
    assert not np.any(Q - model.forces(p))


@pytest.mark.parametrize("kind", KINDS)
def test_support_points_are_no_gaps(kind):
    """On a support point, within a hair of it, and next to it, value and slope are those around."""
    model, exact = fitted(kind), parts(kind)[2]
    support = model.support[model.support.imag > 0.05]
    assert len(support) > 3
    for distance in (0.0, 1e-13, 0.9e-9, 1.1e-9, 1e-7):
        p = support + distance * (1 + 0.5j)
        Q, dQ = model.forces_with_derivative(p)
        value, slope = exact.forces_with_derivative(p)
        assert worst(Q, value) < 2e-8
        assert worst(dQ, slope) < 2e-5


@pytest.mark.parametrize("kind", KINDS)
def test_forces_are_conjugate_at_conjugate_p_and_real_on_the_real_axis(kind):
    model, p = fitted(kind), FINE[::50] + 0.01
    np.testing.assert_allclose(model.forces(p.conj()), model.forces(p).conj(), rtol=1e-9)
    Q = model.forces(np.array([0.05, 0.4], complex))
    assert np.abs(Q.imag).max() < 1e-12 * np.abs(Q).max()


@pytest.mark.parametrize("kind", KINDS)
def test_flutter_points_are_those_of_the_exact_forces(kind):
    _, modes, exact = parts(kind)
    systems = (AeroelasticSystem(modes.omega, air, modes.damping) for air in (exact, fitted(kind)))
    found = [find_flutter(system, (10.0, 70.0)) for system in systems]
    assert all(analysis.certified for analysis in found)
    points = [[(p.speed, p.frequency) for p in analysis.points] for analysis in found]
    assert len(points[0]) >= 4
    np.testing.assert_allclose(points[1], points[0], rtol=1e-6)


def test_too_few_samples_are_said_to_be_too_few():
    model = fitted("lattice", highest=4.0, count=48)
    p = 1j * np.linspace(1e-3, 4.0, 500)
    error = worst(model.forces(p), parts("lattice")[2].forces(p))
    assert not model.reached
    assert 1e-5 < error < 10 * model.error
    assert worst(fitted("lattice", 4.0, 160).forces(p), parts("lattice")[2].forces(p)) < 1e-7


def test_what_is_not_approximated_is_taken_over():
    exact = parts("lattice")[2]
    model = fitted("lattice", highest=2.0)
    assert (model.size, model.half_chord) == (exact.size, exact.half_chord)
    assert model.scheme == exact.scheme
    assert model.highest_frequency == 2.0
    np.testing.assert_array_equal(model.steady_forces(), exact.steady_forces())
    np.testing.assert_array_equal(model.apparent_mass(), exact.apparent_mass())


def test_range_ends_where_the_model_does():
    exact = parts("lattice")[2]
    assert fitted("lattice", highest=99.0, count=20).highest_frequency == exact.highest_frequency


def test_forces_of_no_values_are_none():
    assert fitted("strip").forces(np.array([], complex)).shape == (0, 12, 12)


@pytest.mark.parametrize(
    ("field", "change"),
    [
        ("highest", {"highest": 0.0}),
        ("highest", {"highest": np.inf}),
        ("highest", {"highest": np.nan}),
        ("count", {"count": 4}),
        ("tolerance", {"tolerance": 0.0}),
    ],
)
def test_bad_input_is_refused(field, change):
    with pytest.raises(InputError, match=field):
        rational_model(parts("strip")[2], **{"highest": 1.0} | change)
