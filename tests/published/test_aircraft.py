"""Printed natural frequencies and eigenvalues of aircraft.

I. Wang, Aeroelastic and Flight Dynamics Analysis of Folding Wing Systems, dissertation, Duke
University, 2013, chapters 6 and 7. Our own figures, which an independent program gave as well,
stand beside the printed ones and are met to their last digit.
"""

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_roots
from foldwing.stability.status import is_critical
from support.random_aircraft import cessna, rigid_system
from support.stability import example_modes, example_wing

NAME = "three-segment-aircraft"


def test_natural_frequencies_of_figure_6_7():
    modes = example_modes(NAME, 30.0, -30.0)
    np.testing.assert_allclose(modes.frequencies[:3], 0.0)
    found = modes.frequencies[3:6]
    np.testing.assert_allclose(found, [4.61635, 21.8701, 26.1606], rtol=1e-3)
    np.testing.assert_allclose(found, [4.6132, 21.8667, 26.1572], rtol=1e-4)


def test_elastic_modes_are_faster_than_those_of_the_clamped_wing():
    """Section 6.3.2: bending a little, torsion more."""
    clamped = example_modes("three-segment", 30.0, -30.0).frequencies[:3]
    ratio = example_modes(NAME, 30.0, -30.0).frequencies[3:6] / clamped
    assert (ratio > 1.02).all()
    assert ratio[2] == ratio.max()


@pytest.fixture(scope="module")
def rigid_cessna():
    """Phugoid and short period at an airspeed, in rad/s."""

    def roots(inertia, gravity, speed=54.0):
        _, _, system = rigid_system(cessna(inertia, gravity))
        guess = np.array([1j * np.sqrt(2) * gravity / speed, (-0.122 + 0.171j) * speed])
        found = polish_roots(system, guess * system.half_chord / speed, np.full(2, speed))
        assert found.converged.all()
        return found.p * speed / system.half_chord

    return roots


def test_phugoid_and_short_period_of_the_multi_body_cessna(rigid_cessna):
    """Table 7.1. The printed inertia and gravity do not give the printed digits exactly."""
    printed = np.array([0.0004 + 0.2265j, -6.6602 + 9.3619j])
    phugoid, short = rigid_cessna(420.0, 9.81)
    assert abs(phugoid - printed[0]) < 0.02 * abs(printed[0])
    assert abs(short - printed[1]) < 0.02 * abs(printed[1])
    assert short == pytest.approx(-6.5585 + 9.2255j, abs=1.5e-4)
    phugoid, short = rigid_cessna(419.2, 9.8)
    assert phugoid == pytest.approx(0.0004 + 0.2283j, abs=7e-5)
    assert short == pytest.approx(-6.5675 + 9.2324j, abs=1e-4)


def test_the_phugoid_of_the_cessna_is_near_lanchester_s_and_slows_with_the_airspeed(rigid_cessna):
    """Its frequency is sqrt(2) g/U for a motion at constant incidence (F. W. Lanchester 1908)."""
    speeds = np.array([25.0, 35.0, 45.0, 60.0])
    found = np.array([rigid_cessna(420.0, 9.81, U)[0] for U in speeds])
    times_speed = found.imag * speeds
    assert np.ptp(times_speed) < 0.005 * times_speed.mean()
    assert times_speed.mean() == pytest.approx(np.sqrt(2) * 9.81, rel=0.15)
    assert (found.real > 0).all()


BOUNDARIES = {
    # folds: (event, m/s, Hz) of everything up to 45 m/s
    (30.0, -60.0): [
        ("onset", 25.54, 25.6),
        ("recovery", 30.21, None),
        ("merger", 33.1, 0.0),
        ("onset", 35.89, 19.0),
        ("onset", 39.54, 12.8),
        ("recovery", 40.40, None),
    ],
    (30.0, 60.0): [("merger", 41.3, 0.0), ("onset", 42.33, 10.0)],
}


@pytest.mark.parametrize("folds", BOUNDARIES, ids=str)
def test_boundaries_of_the_aircraft_agree_with_an_independent_program(folds):
    model = example_wing(NAME)
    modes = model.modes(tuple(np.radians(folds)))
    found = find_flutter(model.system(modes), (model.trim(modes).slowest, 45.0))
    assert found.certified
    assert [point.event for point in found.points] == [row[0] for row in BOUNDARIES[folds]]
    for point, (_, speed, frequency) in zip(found.points, BOUNDARIES[folds], strict=True):
        assert point.speed == pytest.approx(speed, abs=0.1 if point.event == "merger" else 0.01)
        if frequency is not None:
            assert point.frequency == pytest.approx(frequency, abs=0.06)


def first_of_each_kind(wing, folds, speed_range):
    """Lowest airspeed of elastic flutter and of divergence or merger; nan without."""
    model = AeroelasticWing(wing)
    found = find_flutter(model.system(model.modes(tuple(np.radians(folds)))), speed_range)
    assert found.certified
    starts = [point for point in found.points if is_critical(point)]
    return [
        next((point.speed for point in starts if point.kind == kind), np.nan)
        for kind in ("flutter", "divergence")
    ]


@pytest.mark.parametrize("folds", [(30, -60), (30, 60), (30, -30)], ids=str)
def test_flutter_comes_later_and_divergence_earlier_than_with_a_clamped_root(folds):
    """Section 7.5.1: the printed divergence is "about 10 %" lower, read from the figures."""
    wing = example_wing(NAME).wing
    flutter, divergence = first_of_each_kind(wing, folds, (12.6, 60.0))
    clamped_flutter, clamped_divergence = first_of_each_kind(wing.clamped, folds, (12.6, 60.0))
    assert flutter > 1.1 * clamped_flutter
    assert 0.9 * clamped_divergence < divergence < clamped_divergence


def test_the_aircraft_of_figure_7_6_diverges_without_flutter_at_ninety_degrees():
    """Section 7.5.2."""
    flutter, divergence = first_of_each_kind(example_wing(NAME).wing, (90, -90), (12.6, 66.0))
    assert np.isnan(flutter)
    assert divergence == pytest.approx(36.0, abs=0.05)
