"""Flutter points followed through a parameter, around the places where curves turn back.

Evidence: a closed curve that is known in closed form, and direct searches at single values of the
parameter, which know nothing of their neighbours.
"""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from foldwing.stability.continuation import Limits, follow_boundary
from foldwing.stability.flutter import find_flutter
from support.stability import Polynomials, example_wing, of_kind
from support.typical_section import TypicalSection

SPEEDS = (0.3, 20.0)
WING_SPEEDS = (0.62, 93.0)


def section(pitch_frequency):
    return TypicalSection(pitch_frequency=pitch_frequency)


def flutter(problem, speeds, threshold=0.0):
    return of_kind(find_flutter(problem, speeds, threshold), "flutter")


@pytest.mark.parametrize("threshold", [0.0, 0.02, -0.02])
@pytest.mark.parametrize("step", [0.05, -0.05])
def test_curve_against_a_search_at_every_point(step, threshold):
    onset = flutter(section(2.5), SPEEDS, threshold)[-1]
    limits = Limits((1.8, 3.5), SPEEDS)
    start = (2.5, onset.p.imag, onset.speed)
    curve = follow_boundary(section, start, step, limits, threshold)
    assert curve.end == "parameter"
    assert curve.turning == ()
    edge = 3.5 if step > 0 else 1.8
    assert 0.0 <= (edge - curve.parameter[-1]) / step < 0.05  # up to the limit, not beyond
    assert np.all(np.diff(curve.parameter) * step > 0)
    assert len(curve.parameter) > 5
    for s, k, U, strength in zip(
        curve.parameter, curve.reduced_frequency, curve.speed, curve.strength, strict=True
    ):
        point = flutter(section(s), SPEEDS, threshold)[-1]
        assert (point.speed, point.p.imag) == pytest.approx((U, k), rel=1e-7)
        assert point.strength == pytest.approx(strength, rel=1e-6)


RADIUS, CENTRE = 0.03, 0.12


def ring(s):
    """Damping ((k^2 - a)^2 + s^2 - r^2) / 2: flutter where it vanishes, at U^-2 = k^2 + 0.02."""
    damping = np.array([CENTRE**2 - RADIUS**2 + s**2, 0.0, 2 * CENTRE, 0.0, 1.0]) / 2
    q = np.array([-0.02, 0, 1, 0, 0, 0]) + np.append(0.0, damping)
    return Polynomials((tuple(q), (0.5, 0.3, 1.0)))  # beside an oscillator that is always stable


@pytest.mark.parametrize("step", [0.004, -0.004])
def test_closed_curve_in_closed_form(step):
    k = (CENTRE + RADIUS) ** 0.5
    start = (0.0, k, (k**2 + 0.02) ** -0.5)
    curve = follow_boundary(ring, start, step, Limits((-1.0, 1.0), (0.1, 50.0)))
    assert curve.end == "closed"
    s, k2 = curve.parameter, curve.reduced_frequency**2
    np.testing.assert_allclose(np.hypot(s, k2 - CENTRE), RADIUS, rtol=1e-6)
    np.testing.assert_allclose(curve.speed, (k2 + 0.02) ** -0.5, rtol=1e-7)
    np.testing.assert_allclose(curve.turning, np.sign(step) * RADIUS * np.array([1, -1]), rtol=1e-6)
    turned = np.unwrap(np.arctan2(s, k2 - CENTRE))
    assert np.all(np.diff(turned) * step > 0)
    assert abs(turned[-1]) > 2 * np.pi * 0.98
    # damping is negative inside the ring: entered with the airspeed at high k, left at low k
    clear = np.abs(k2 - CENTRE) > 1e-3
    assert np.all((curve.strength > 0)[clear] == (k2 > CENTRE)[clear])


@cache
def folded(kind, angle):
    wing = example_wing("three-segment")
    folds = (30.0, angle) if kind == "third" else (angle, -angle)
    return wing.system(wing.modes(tuple(np.radians(folds))))


CURVES = {
    # family, start, step, range; where the curve turns; speed and frequency range of the hump
    "third": (-60.0, 2.0, (-75.0, 0.0), -31.40835),
    "level": (85.0, 1.0, (75.0, 120.0), 89.70933),
}


@cache
def hump_curve(kind):
    start, step, angles, _ = CURVES[kind]
    onset = flutter(folded(kind, start), WING_SPEEDS)[0]
    at = (start, onset.p.imag, onset.speed)
    return follow_boundary(lambda s: folded(kind, s), at, step, Limits(angles, WING_SPEEDS))


@pytest.mark.parametrize("kind", CURVES)
def test_onset_turns_into_recovery(kind):
    start, _, angles, turning = CURVES[kind]
    curve = hump_curve(kind)
    assert curve.turning == pytest.approx((turning,), abs=2e-5)
    assert curve.end == "parameter"
    top = int(np.argmax(curve.parameter))
    assert curve.parameter[top] <= curve.turning[0] + 1e-9
    assert np.all(np.diff(curve.parameter[: top + 1]) > 0)
    assert np.all(np.diff(curve.parameter[top:]) < 0)
    assert curve.parameter[0] == start
    assert 0.0 <= curve.parameter[-1] - angles[0] < 0.1
    assert np.all(np.diff(curve.speed) > 0) or kind == "third"
    before, after = curve.strength[: top - 1], curve.strength[top + 2 :]
    assert np.all(before > 0)
    assert np.all(after < 0)


@pytest.mark.parametrize("kind", CURVES)
def test_hump_curve_against_searches(kind):
    """The search at that angle has the same point, with the event that its side must have."""
    curve = hump_curve(kind)
    apart = np.flatnonzero(curve.turning[0] - curve.parameter > 0.01)
    for i in apart[::4]:
        points = flutter(folded(kind, float(curve.parameter[i])), WING_SPEEDS)
        near = min(points, key=lambda point: abs(point.speed - curve.speed[i]))
        assert near.speed == pytest.approx(curve.speed[i], rel=1e-6)
        assert near.p.imag == pytest.approx(curve.reduced_frequency[i], rel=1e-6)
        assert (near.event == "onset") == (curve.strength[i] > 0)


@pytest.mark.parametrize("kind", CURVES)
def test_turning_point_by_bisection_of_searches(kind):
    """The hump is there on one side of the turning angle and has gone on the other."""
    curve = hump_curve(kind)
    turning = curve.turning[0]
    near = float(curve.speed[np.argmax(curve.parameter)])

    def is_there(angle):
        points = flutter(folded(kind, angle), WING_SPEEDS)
        return any(point.event == "recovery" and abs(point.speed - near) < 6 for point in points)

    there, gone = turning - 0.5, turning + 0.5
    assert is_there(there)
    assert not is_there(gone)
    while gone - there > 1e-3:
        middle = (there + gone) / 2
        there, gone = (middle, gone) if is_there(middle) else (there, middle)
    assert there - 1e-3 < turning < gone + 1e-3


@pytest.mark.parametrize("kind", CURVES)
def test_the_strength_vanishes_with_the_root_of_the_distance(kind):
    """Near a turning point the two branches part like a square root, and so does the strength."""
    curve = hump_curve(kind)
    distance = curve.turning[0] - curve.parameter
    near = (distance > 1e-5) & (distance < 0.02)
    assert near.sum() >= 6
    for side in (curve.strength > 0, curve.strength < 0):
        use = near & side
        slope = np.polyfit(np.log(distance[use]), np.log(np.abs(curve.strength[use])), 1)[0]
        assert slope == pytest.approx(0.5, abs=0.06)


def test_a_curve_ends_where_the_speed_leaves_its_range():
    onset = flutter(section(2.5), SPEEDS)[0]
    limits = Limits((0.5, 9.0), (0.3, 7.0))
    curve = follow_boundary(section, (2.5, onset.p.imag, onset.speed), 0.05, limits)
    assert curve.end == "speed"
    assert 6.99 < curve.speed[-1] <= 7.0
    assert np.all(np.diff(curve.speed) > 0)


def test_a_curve_ends_after_so_many_points():
    onset = flutter(section(2.5), SPEEDS)[0]
    limits = Limits((0.5, 9.0), SPEEDS, points=6)
    curve = follow_boundary(section, (2.5, onset.p.imag, onset.speed), 0.05, limits)
    assert (curve.end, len(curve.parameter)) == ("length", 6)


def test_a_curve_ends_at_divergence():
    """1 + U g p + U^2 (s + c p + p^2) = 0 flutters at U = -g/c with k^2 = s + U^-2, until k = 0."""

    def family(s):
        return Polynomials(((s, -0.02, 1.0), (0.5, 0.3, 1.0)), (0.1, 0.1))

    curve = follow_boundary(family, (0.1, 0.14**0.5, 5.0), -0.01, Limits((-1.0, 1.0), (1.0, 9.0)))
    assert curve.end == "zero frequency"
    np.testing.assert_allclose(curve.speed, 5.0, rtol=1e-6)
    k2 = curve.parameter + 0.04
    np.testing.assert_allclose(curve.reduced_frequency**2, k2, rtol=1e-4, atol=1e-9)


def test_a_curve_that_breaks_off_is_lost():
    """Beyond s = 2.6 another section, of other speed, takes the place of the first."""

    def family(s):
        return section(s) if s < 2.6 else TypicalSection(pitch_frequency=9.0, e=0.3)

    onset = flutter(section(2.5), SPEEDS)[0]
    curve = follow_boundary(
        family, (2.5, onset.p.imag, onset.speed), 0.05, Limits((0.5, 9.0), SPEEDS)
    )
    assert curve.end == "lost"
    assert 2.55 < curve.parameter[-1] < 2.61


def test_no_flutter_to_start_from():
    """Positive damping everywhere: there is nothing to converge to."""
    stable = Polynomials(((0.1, 0.3, 1.0), (0.2, 0.1, 1.0)), (0.1, 0.2))
    with pytest.raises(ValueError, match=r"no flutter point near k = 0\.4, U = 3 m/s at s = 1"):
        follow_boundary(lambda s: stable, (1.0, 0.4, 3.0), 0.1, Limits((0, 9), SPEEDS))


def test_steps_grow_on_a_straight_curve():
    curve = hump_curve("third")
    steps = np.hypot(np.diff(np.log(curve.speed)), np.diff(np.log(curve.reduced_frequency)))
    assert len(curve.parameter) < 80
    assert steps.max() < 0.5
    tangents = np.diff(
        np.stack([np.log(curve.speed), np.log(curve.reduced_frequency), curve.parameter / 2.0]).T,
        axis=0,
    )
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    assert min(a @ b for a, b in pairwise(tangents)) > 0.85
