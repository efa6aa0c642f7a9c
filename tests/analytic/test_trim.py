"""Level flight: lifts of segments and tail against balances written out part by part."""

import numpy as np
import pytest

from foldwing.aerodynamics.panels import strip_panels
from foldwing.aerodynamics.steady import at_unit_angle
from foldwing.aeroelastic.trim import LiftingSurfaces, trim
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import PointMass, read_model
from support.random_aircraft import random_aircraft, with_aircraft

NAME = "three-segment-aircraft"
SPANS = np.array([0.14, 0.10, 0.06])
MOMENT = {"trim": "force-and-moment"}


def level(wing, aerodynamics="strip"):
    model = AeroelasticWing(wing, aerodynamics)
    return model.trim(model.modes())


def weights(wing):
    """Weight in N and place aft of the elastic axis of every part."""
    g, aircraft = wing.aircraft.gravity, wing.aircraft
    parts = [
        (s.mass_per_span * s.span, (s.mass_centre - s.elastic_axis) * s.chord)
        for s in wing.segments
    ]
    parts += [(point.mass, point.x) for point in wing.point_masses]
    parts += [(aircraft.fuselage.mass, aircraft.fuselage.x), (aircraft.tail.mass, aircraft.tail.x)]
    return [(m * g, x) for m, x in parts]


@pytest.mark.parametrize("folds", [(0, 0), (30, -60), (30, 60), (90, -90), (70, 80)], ids=str)
def test_segments_carry_the_weight_by_span_and_squared_cosine(folds):
    found = level(read_model(NAME).folded(*folds))
    lifted = SPANS * np.cos(np.radians(np.cumsum([0, *folds]))) ** 2
    np.testing.assert_allclose(found.share[:3], lifted / lifted.sum(), atol=1e-12)
    assert found.share[3] == 0.0
    assert found.lift.sum() == pytest.approx(found.weight, rel=1e-12)


def test_the_weight_is_that_of_all_parts():
    wing = read_model(NAME).with_point_masses(PointMass(segment=2, mass=0.01, x=0.01, y=0.05))
    assert level(wing).weight == pytest.approx(sum(W for W, _ in weights(wing)), rel=1e-12)
    # Half of the printed aircraft: four wing masses and a quarter.
    assert level(read_model(NAME)).weight == pytest.approx(4.25 * 0.027265 * 9.81, rel=1e-3)


WINGS = {
    "example": with_aircraft(read_model(NAME).folded(30, -60), **MOMENT),
    "with masses": with_aircraft(
        read_model(NAME)
        .folded(50, 20)
        .with_point_masses(PointMass(segment=3, mass=0.004, x=-0.02, y=0.05)),
        **MOMENT,
    ),
    **{
        f"random {i}": with_aircraft(random_aircraft(np.random.default_rng(i)), **MOMENT)
        for i in (2, 5, 8)
    },
}


@pytest.mark.parametrize("wing", WINGS.values(), ids=WINGS)
def test_forces_and_moments_of_all_parts_balance(wing):
    """About a point far ahead; the lift is that of sections in two-dimensional flow."""
    found, U, rho = level(wing), 23.0, wing.air.density
    tail, about = wing.aircraft.tail, wing.aircraft.tail.x - 7.0
    angle, turned, forces = found.angle_of_attack(U), 0.0, [(-W, x) for W, x in weights(wing)]
    for index, segment in enumerate(wing.segments):
        turned += wing.hinges[index - 1].fold if index else 0.0
        pressure = rho * U**2 / 2 * segment.area
        normal = pressure * segment.lift_slope * angle * np.cos(turned)
        forces.append((normal * np.cos(turned), (0.25 - segment.elastic_axis) * segment.chord))
    on_tail = rho * U**2 / 2 * tail.area * tail.lift_slope * found.tail_angle(U)
    forces.append((on_tail, tail.x + (0.25 - tail.elastic_axis) * tail.chord))
    assert abs(sum(F for F, _ in forces)) < 1e-11 * found.weight
    assert abs(sum(F * (x - about) for F, x in forces)) < 1e-10 * found.weight * 7.0
    np.testing.assert_allclose(found.lift[-1], on_tail, rtol=1e-12)


@pytest.mark.parametrize("trimmed", ["force", "force-and-moment"])
def test_the_tail_lifts_nothing_with_the_centre_of_gravity_at_the_quarter_chord(trimmed):
    wing = read_model(NAME).folded(30, -60)
    parts = weights(wing)
    total, fuselage = sum(W for W, _ in parts), wing.aircraft.fuselage
    moved = (-0.25 * 0.05 * total - sum(W * x for W, x in parts)) / (fuselage.mass * 9.81)
    balanced = fuselage.model_copy(update={"x": fuselage.x + moved})
    found = level(with_aircraft(wing, trim=trimmed, fuselage=balanced))
    assert found.share[-1] == pytest.approx(0.0, abs=1e-12)


def test_the_tail_lifts_what_the_lever_says_behind_the_quarter_chord():
    """Centre of gravity 1.25 cm behind the quarter chord of the wing, the tail's 25 cm."""
    found = level(with_aircraft(read_model(NAME), **MOMENT))
    assert found.share[-1] == pytest.approx(0.05, rel=1e-3)


def test_lift_coefficients_fall_with_the_square_of_the_airspeed_and_reach_the_largest_one():
    wing = with_aircraft(read_model(NAME).folded(30, -75), largest_lift_coefficient=0.9)
    found = level(wing)
    np.testing.assert_allclose(found.lift_coefficient(40.0) * 4, found.lift_coefficient(20.0))
    assert np.abs(found.lift_coefficient(found.slowest)).max() == pytest.approx(0.9)
    # The horizontal segment 1 has the largest angle, that of the aircraft.
    assert found.lift_coefficient(20.0)[0] == pytest.approx(2 * np.pi * found.angle_of_attack(20.0))
    ratio = found.lift_coefficient(20.0)[:3] / found.lift_coefficient(20.0)[0]
    np.testing.assert_allclose(ratio, np.cos(np.radians([0, 30, -45])))


def test_a_tail_may_be_what_stalls_first():
    """Far forward weight makes it push down hard."""
    wing = with_aircraft(read_model(NAME), **MOMENT)
    fuselage = wing.aircraft.fuselage
    nose_heavy = with_aircraft(wing, fuselage=fuselage.model_copy(update={"x": -0.3}))
    found = level(nose_heavy)
    assert found.lift[-1] < 0.0
    coefficients = np.abs(found.lift_coefficient(found.slowest))
    assert coefficients.argmax() == 3
    assert coefficients[3] == pytest.approx(1.2)


def test_a_segment_on_edge_has_no_lift_coefficient():
    found = level(read_model(NAME).folded(90, 0))
    coefficients = found.lift_coefficient(20.0)
    assert np.isfinite(coefficients).all()
    np.testing.assert_allclose(coefficients[1:], 0.0, atol=1e-12)
    np.testing.assert_allclose(found.share[:3], [1.0, 0.0, 0.0], atol=1e-12)


def test_lifts_are_those_of_any_airspeed_and_density():
    """Only the incidence adapts: alpha rho U^2 stays."""
    wing = read_model(NAME).folded(30, -60)
    thin = level(wing.with_air(0.4))
    np.testing.assert_allclose(thin.lift, level(wing).lift, rtol=1e-12)
    assert thin.incidence == pytest.approx(level(wing).incidence * 1.2 / 0.4)


def surfaces(cosines, place=0.0):
    cosines = np.array([*cosines, 1.0])
    flat = np.ones(len(cosines))
    places = np.append(np.zeros(len(cosines) - 1), place)
    return LiftingSurfaces(flat * cosines**2, flat, places, flat, cosines)


@pytest.mark.parametrize("moment", [False, True])
@pytest.mark.parametrize("cosines", [(0.0,), (0.0, 0.0), (6e-17, 1e-17)], ids=str)
def test_a_wing_that_is_upright_everywhere_cannot_fly_level(cosines, moment):
    with pytest.raises(InputError, match="all segments upright") as caught:
        trim(surfaces(cosines, 1.0), 10.0, 0.2, (1.2, 1.2), moment)
    assert "Fold less" in str(caught.value)


def test_a_tail_at_the_wing_s_own_place_cannot_balance_a_moment():
    with pytest.raises(InputError, match="at the wing"):
        trim(surfaces((1.0,), 0.0), 10.0, 0.2, (1.2, 1.2), True)
    assert trim(surfaces((1.0,), 0.0), 10.0, 0.2, (1.2, 1.2), False).incidence == 10.0


@pytest.mark.parametrize("trimmed", ["force", "force-and-moment"])
@pytest.mark.parametrize("image", [False, True])
def test_a_lattice_lifts_as_the_steady_lattice_does(image, trimmed):
    """Vertical force and moment of each segment at the angle of attack that carries the weight."""
    wing = with_aircraft(read_model(NAME).folded(30, -75), trim=trimmed)
    wing = wing.with_lattice(chordwise=4, spanwise=12, image=image)
    model, U = AeroelasticWing(wing, "lattice"), 19.0
    found = level(wing, "lattice")
    panels = strip_panels(model.strips(model.modes()), 4)
    unit = at_unit_angle(panels, image)
    lift = unit.forces[:, 2] * wing.air.density * U**2 * found.angle_of_attack(U)
    segment = np.tile(panels.segment, 4)
    by_segment = [lift[segment == index].sum() for index in range(3)]
    np.testing.assert_allclose(found.lift[:3], by_segment, rtol=1e-9)
    assert found.lift.sum() == pytest.approx(found.weight, rel=1e-12)
    if trimmed == "force":
        assert found.share[-1] == 0.0
        return
    tail = wing.aircraft.tail
    moment = (lift * unit.places[:, 0]).sum()
    moment += found.lift[-1] * (tail.x + (0.25 - tail.elastic_axis) * tail.chord)
    moment -= sum(W * x for W, x in weights(wing))
    assert abs(moment) < 1e-9 * found.weight
