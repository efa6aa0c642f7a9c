"""Flutter and divergence of published wings by strip theory.

Every value of a figure or a sentence is met with the tolerance that its print allows; beside them
stand values of this theory to four digits, found independently of this implementation, with a
tolerance of some 0.1 %.
"""

from functools import cache

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.problem import evaluate
from foldwing.studies.case import solve_case


@cache
def three_segment():
    """The wing, its parts shared by all fold angles."""
    return AeroelasticWing(read_model("three-segment"))


@cache
def solved(psi2, psi3, highest=70.0):
    """The certified case of the three-segment wing up to an airspeed."""
    case = solve_case(three_segment(), (psi2, psi3), (3.0, highest))
    assert case.analysis.certified
    return case.analysis.points


def flutter(points):
    """Points with a frequency."""
    return [point for point in points if point.kind == "flutter"]


def diverging(points):
    """Airspeeds at which a real root becomes unstable."""
    return [p.speed for p in points if (p.kind, p.event) == ("divergence", "onset")]


# --- cantilever wings ---------------------------------------------------------------------------


def straight(name, highest):
    """First flutter point (speed in m/s, rad/s) and divergence speed of a straight wing."""
    points = solve_case(AeroelasticWing(read_model(name)), (), (highest / 20, highest)).analysis
    assert points.certified
    (divergence,) = diverging(points.points)
    first = flutter(points.points)[0]
    assert first.event == "onset"
    return first.speed, 2 * np.pi * first.frequency, divergence


def test_goland_wing_in_four_digits():
    """137.26 m/s at 70.07 rad/s, divergence 252.66 m/s."""
    assert straight("goland", 400.0) == pytest.approx((137.26, 70.07, 252.66), rel=5e-4)


def test_goland_wing_as_published():
    """137.2 m/s and 70.7 rad/s are quoted as exact for strip theory (M. Goland, Journal of Applied
    Mechanics 12, 1945; M. Goland, Y. L. Luke, ibid. 15, 1948): speed 0.2 %, frequency 1 %."""
    speed, frequency, _ = straight("goland", 400.0)
    assert speed == pytest.approx(137.2, rel=2e-3)
    assert frequency == pytest.approx(70.7, rel=1e-2)


def test_high_altitude_wing_in_four_digits():
    """32.51 m/s at 22.37 rad/s, divergence 37.15 m/s."""
    assert straight("hale", 60.0) == pytest.approx((32.51, 22.37, 37.15), rel=1e-3)


def test_high_altitude_wing_as_published():
    """32.21 m/s at 22.61 rad/s, divergence 37.29 m/s, with finite elements and a finite-state
    inflow (M. J. Patil, D. H. Hodges, C. E. S. Cesnik, Journal of Aircraft 38, 2001): 1.2 %."""
    assert straight("hale", 60.0) == pytest.approx((32.21, 22.61, 37.29), rel=1.2e-2)


# --- the three-segment wing: I. Wang, PhD dissertation, Duke University, 2013, chapter 4 ----------


@pytest.mark.parametrize("psi3", [-90.0, -75.0, -60.0, -45.0, -40.0, -35.0])
def test_hump_and_coalescence_below_minus_35_degrees(psi3):
    """Text to figure 4.3: a first mode near 20 m/s that becomes stable again, then another one
    that flutters at a yet higher speed. "Near 20": half of the figure's 5 m/s grid, 2.5 m/s."""
    points = solved(30.0, psi3, 45.0)
    hump, recovery, second = flutter(points)
    assert (hump.classification, recovery.event) == ("hump", "recovery")
    assert (second.event, second.classification) == ("onset", "coalescence")
    assert hump.branch == recovery.branch
    assert hump.speed == pytest.approx(20.0, abs=2.5)
    assert abs(hump.strength) < abs(second.strength) / 5


@pytest.mark.parametrize("psi3", [-30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0])
def test_one_smooth_boundary_above_minus_35_degrees(psi3):
    """Text to figure 4.3: no hump, 20 to 33 m/s. The figure steps by 5 degrees: the hump that is
    there at -35 is gone at -30."""
    points = solved(30.0, psi3, 45.0)
    (onset,) = flutter(points)
    assert onset.classification == "coalescence"
    assert 20.0 <= onset.speed <= 33.0


def determinant(system, root, speed):
    """det T at the root lambda in 1/s."""
    p = np.array([root * system.half_chord / speed])
    return np.linalg.det(evaluate(system, p, np.array([speed]))[0])


def followed(system, root, speeds):
    """A root carried along by secants on the determinant, extrapolated from step to step."""
    before = None
    for speed in speeds:
        guess = root if before is None else 2 * root - before
        points = [guess, guess * (1 + 1e-6)]
        values = [determinant(system, z, speed) for z in points]
        while abs(points[-1] - points[-2]) > 1e-10 * abs(points[-1]):
            slope = (values[-1] - values[-2]) / (points[-1] - points[-2])
            points.append(points[-1] - values[-1] / slope)
            values.append(determinant(system, points[-1], speed))
        before, root = root, points[-1]
    return root


@pytest.mark.parametrize(("psi3", "same"), [(-45.0, True), (-60.0, False), (-75.0, False)])
def test_second_onset_belongs_to_the_branch_that_leads_there(psi3, same):
    """Text to figure 4.3: another eigenvalue. The hump's own root, followed in small steps, is at
    the second onset for -45 degrees, where both are one branch, and elsewhere for -60 and -75."""
    system = solve_case(three_segment(), (30.0, psi3), (3.0, 45.0)).system
    hump, _, second = flutter(solved(30.0, psi3, 45.0))
    speeds = np.linspace(hump.speed, second.speed, 400)
    root = followed(system, 2j * np.pi * hump.frequency, speeds)
    assert bool(abs(root - 2j * np.pi * second.frequency) < 1e-3) is same
    assert (hump.branch == second.branch) is same


def test_hump_mode_is_weak():
    """Figure 4.3c: flutter strengths of coalescence up to about 0.05 s/m, of humps far below."""
    hump, _, second = flutter(solved(30.0, -75.0, 45.0))
    assert hump.strength < 0.005
    assert second.strength == pytest.approx(0.05, abs=0.01)


def test_fold_30_minus_60_in_four_digits():
    """Onset 20.37 m/s (25.1 Hz), recovery 28.18 (23.0), onset 31.73 (18.5), divergence 35.45."""
    points = solved(30.0, -60.0, 45.0)
    speeds = [p.speed for p in flutter(points)]
    frequencies = [p.frequency for p in flutter(points)]
    assert [p.event for p in flutter(points)] == ["onset", "recovery", "onset"]
    assert speeds == pytest.approx([20.37, 28.18, 31.73], rel=1e-3)
    assert frequencies == pytest.approx([25.1, 23.0, 18.5], abs=0.06)
    assert diverging(points) == pytest.approx([35.45], rel=1e-3)


def test_fold_30_60_in_four_digits():
    """One onset, 28.40 m/s at 13.7 Hz."""
    (onset,) = flutter(solved(30.0, 60.0, 45.0))
    assert (onset.speed, onset.frequency) == pytest.approx((28.40, 13.7), rel=2e-3)


# --- outboard segment level, psi3 = -psi2: figures 4.6 to 4.8 -------------------------------------


def test_level_tip_flutters_earlier_up_to_30_degrees():
    """First region of figure 4.6: speed and frequency both gradually decrease. Here so up to 27.5
    degrees; at 30 the first onset has become a hump and vanished, and the next is at 25 m/s."""
    first = [flutter(solved(psi, -psi))[0] for psi in (0.0, 10.0, 20.0, 27.5)]
    assert all(np.diff([point.speed for point in first]) < 0)
    assert all(np.diff([point.frequency for point in first]) < 0)


@pytest.mark.parametrize("psi", [35.0, 45.0, 60.0, 75.0, 85.0])
def test_level_tip_recovers_between_30_and_90_degrees(psi):
    """Second region of figure 4.6: the flutter mode becomes stable again at a higher speed."""
    points = solved(psi, -psi, 100.0)
    first = flutter(points)[0]
    recoveries = [p for p in points if p.event == "recovery" and p.branch == first.branch]
    assert first.classification == "hump" and len(recoveries) == 1


def test_recovery_of_another_branch_makes_no_hump():
    """At 31 degrees the first mode flutters at 24.9 m/s and becomes two real roots at 53.6 m/s;
    the recovery at 78 m/s is not its own."""
    points = solved(31.0, -31.0, 100.0)
    first = flutter(points)[0]
    assert [p.branch == first.branch for p in points if p.event == "recovery"] == [False]
    assert first.classification == "coalescence"
    assert any(p.event == "merger" and first.speed < p.speed < 60.0 for p in points)


def test_level_tip_hump_disappears_at_90_degrees():
    """Figures 4.6 and 4.7: unstable at 85 degrees, 30.3 to 53.8 m/s; a narrower range nearer to
    90; from 90 to 105 no flutter below 70 m/s, only divergence."""
    hump, recovery = flutter(solved(85.0, -85.0))
    assert (hump.speed, recovery.speed) == pytest.approx((30.3, 53.8), rel=2e-3)
    nearer, recovered = flutter(solved(88.0, -88.0))
    assert hump.speed < nearer.speed < recovered.speed < recovery.speed
    for psi in (90.0, 95.0, 105.0):
        assert flutter(solved(psi, -psi)) == []
        assert len(diverging(solved(psi, -psi))) == 1


@pytest.mark.parametrize("psi", [95.0, 100.0, 105.0])
def test_level_tip_jumps_to_a_higher_mode_after_90_degrees(psi):
    """Third region of figure 4.6: near 90 m/s and 37 Hz. Here 80 to 86 m/s at 41 Hz: 13 %."""
    first = flutter(solved(psi, -psi, 100.0))[0]
    assert (first.speed, first.frequency) == pytest.approx((90.0, 37.0), rel=0.13)


def test_level_tip_flutters_very_early_at_120_degrees():
    """Figures 4.6 and 4.8: near 10 m/s and 15 Hz, half of the grids of 10 m/s and 5 Hz; 8.64 m/s
    at 14.36 Hz here."""
    (onset,) = flutter(solved(120.0, -120.0))
    assert (onset.speed, onset.frequency) == pytest.approx((8.64, 14.36), rel=2e-3)
    assert onset.speed == pytest.approx(10.0, abs=5.0)
    assert onset.frequency == pytest.approx(15.0, abs=2.5)


def test_level_tip_drop_lies_between_105_and_120_degrees():
    """Figure 4.6: after the jump the speed drops drastically to near 10 m/s, then grows again."""
    speeds = [flutter(solved(psi, -psi, 100.0))[0].speed for psi in (105.0, 110.0, 120.0, 150.0)]
    assert speeds[0] > 80 and speeds[1] < speeds[2] < speeds[3] < 20
