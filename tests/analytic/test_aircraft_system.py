"""Forces on an aircraft in level flight and its matrix T.

Evidence: a rigid aircraft without any linearization, a lattice solved again in another airstream,
the equation of motion written with lambda, and finite differences.
"""

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Hinge, read_model
from foldwing.stability.newton import polish_roots
from foldwing.stability.problem import evaluate, evaluate_with_derivatives
from support import level_flight
from support.lattices import direct_forces
from support.random_aircraft import random_aircraft, rigid_system, with_aircraft

NAME = "three-segment-aircraft"
TAIL_TOO = {"trim": "force-and-moment"}
WINGS = {
    "flat": read_model(NAME).folded(0, 0),
    "folded": read_model(NAME).folded(40, -100),
    "tail lifts": with_aircraft(read_model(NAME).folded(40, 30), **TAIL_TOO),
    "random 3": with_aircraft(random_aircraft(np.random.default_rng(3)), **TAIL_TOO),
    "random 6": random_aircraft(np.random.default_rng(6)),
}
EVERY_WING = pytest.mark.parametrize("wing", WINGS.values(), ids=WINGS)


def quasi_steady(wing):
    return with_aircraft(wing, tail_aerodynamics="quasi-steady")


def by_rate(model, speed):
    """Forces per displacement and per rate at an airspeed, of forces linear in the rate."""
    at_rest, moving = (
        sum(
            U2 * part.forces(np.array([p], complex))[0].real
            for U2, part in ((speed**2, model.aerodynamics), (1.0, model.trim_forces))
        )
        for p in (0.0, 1.0)
    )
    return at_rest, (moving - at_rest) * model.half_chord / speed


# --- forces ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("speed", [11.0, 40.0])
@EVERY_WING
def test_forces_without_lag_are_those_of_a_rigid_aircraft_that_flies_into_its_wind(wing, speed):
    wing = quasi_steady(wing)
    _, _, system = rigid_system(wing, "quasi-steady")
    at_rest, moving = by_rate(system, speed)
    body = level_flight.rigid_body(wing)
    size = np.sqrt([body.mass, body.mass, body.inertia])
    at_rest, moving = (F * np.outer(size, size) for F in (at_rest, moving))

    def forces(motion):
        return level_flight.quasi_steady_forces(wing, speed, motion)

    parts = ((moving, 0, "aft"), (moving, 1, "up"), (moving, 2, "rate"), (at_rest, 2, "angle"))
    for matrix, column, name in parts:
        wanted = level_flight.differenced(forces, name, 1e-4 * (speed if name != "angle" else 1.0))
        np.testing.assert_allclose(
            matrix[:, column], wanted, rtol=2e-6, atol=2e-7 * np.abs(wanted).max()
        )
    np.testing.assert_allclose(at_rest[:, :2], 0.0, atol=1e-9 * np.abs(at_rest).max())


def test_the_signs_of_the_forces_of_level_flight():
    """Surging aft loses lift, climbing turns it aft and lifts less, nose up lifts more."""
    _, _, system = rigid_system(WINGS["folded"], "quasi-steady")
    at_rest, moving = by_rate(system, 20.0)
    x, z, pitch = range(3)
    assert moving[z, x] < 0 < moving[x, z]
    assert moving[z, x] == pytest.approx(-2 * moving[x, z])
    assert moving[z, z] < 0 and moving[pitch, pitch] < 0
    assert at_rest[z, pitch] > 0 > at_rest[pitch, pitch]


@EVERY_WING
def test_lift_felt_in_surge_and_climb_is_the_weight(wing):
    """m x'' = W z'/U and m z'' = -2 W x'/U: the phugoid of an aircraft that never pitches."""
    _, _, system = rigid_system(wing)
    Q0 = system.trim_forces.forces(np.array([1e-9j]))[0] / (1e-9j / system.half_chord)
    weight_over_mass = wing.aircraft.gravity
    assert Q0[0, 1] == pytest.approx(weight_over_mass, rel=1e-6)
    assert Q0[1, 0] == pytest.approx(-2 * weight_over_mass, rel=1e-6)
    assert abs(Q0[0, 0]) < 1e-12 and abs(Q0[1, 1]) < 1e-12


def lattice_wing(wing, **lattice):
    return wing.with_lattice(**({"chordwise": 3, "spanwise": 8, "wake": 4.0} | lattice))


AIRSPEED = 17.0


def steady_lattice_forces(model, modes, rates, angle):
    """Forces on rigid modes from vortices in steady flow with all parts of the wing moving.

    Each strip has the airspeed and the normal velocity of its own; ``angle`` is the wing's.
    """
    strips, nc = model.strips(modes), model.wing.lattice.chordwise
    motion = model.panel_motion(modes)
    count = strips.count
    surge = np.empty((count, modes.count))
    for index in range(len(model.wing.segments)):
        here = np.flatnonzero(strips.segment == index)
        y = model.meshes[index].middle
        surge[here] = modes.displacement(index, np.zeros_like(y), y)[:, 0]
    surge = np.tile(surge, (nc, 1))
    upward = np.tile(strips.normal[:, 1], nc)
    airspeed = AIRSPEED - surge @ rates
    wash = -angle * upward * airspeed + motion.collocation @ rates
    circulation = np.linalg.solve(model.influence(modes).wing, wash)
    load = model.wing.air.density * circulation * np.tile(strips.width, nc)
    return motion.vortex.T @ (load * airspeed) + surge.T @ (load * (motion.vortex @ rates))


@pytest.mark.parametrize("image", [False, True])
@pytest.mark.parametrize("name", ["flat", "folded", "random 6"])
def test_a_lattice_in_a_faster_stream_gives_the_slow_limit_of_the_forces_of_trim(name, image):
    model = AeroelasticWing(
        lattice_wing(with_aircraft(WINGS[name], trim="force"), image=image), "lattice"
    )
    modes = model.modes()
    system, level = model.system(modes), model.trim(modes)
    angle, tiny = level.angle_of_attack(AIRSPEED), 1e-8
    Q0 = system.trim_forces.forces(np.array([tiny + 0j]))[0].real
    found = Q0[:, :3] * model.half_chord / (tiny * AIRSPEED)
    wanted = []
    for rates in 1e-4 * np.eye(modes.count)[:3]:
        lifting, flat = (
            steady_lattice_forces(model, modes, rates, alpha)
            - steady_lattice_forces(model, modes, -rates, alpha)
            for alpha in (angle, 0.0)
        )
        wanted.append((lifting - flat) / 2e-4)
    wanted = np.transpose(wanted)
    np.testing.assert_allclose(found, wanted, rtol=1e-5, atol=1e-6 * np.abs(wanted).max())


@pytest.mark.parametrize("name", ["folded", "random 6"])
@pytest.mark.parametrize("p", [0.03 + 0.2j, -0.05 + 0.9j])
def test_circulation_in_a_faster_stream_builds_up_as_the_equations_of_the_lattice_say(name, p):
    """All else is in proportion to p; the tail lifts nothing."""
    model = AeroelasticWing(lattice_wing(WINGS[name]), "lattice")
    modes, b = model.modes(), model.half_chord
    system, level = model.system(modes), model.trim(modes)
    strips, nc = model.strips(modes), model.wing.lattice.chordwise
    surge = np.concatenate(
        [
            modes.displacement(i, np.zeros_like(mesh.middle), mesh.middle)[:, 0]
            for i, mesh in enumerate(model.meshes)
        ]
    )
    upward = level.incidence * np.tile(strips.normal[:, 1], nc)[:, None]
    wash = p / b * upward * np.tile(surge, (nc, 1))
    tiny = 1e-9
    slow_wash = tiny / b * upward * np.tile(surge, (nc, 1))
    Q0, slow = (system.trim_forces.forces(np.array([z + 0j]))[0] for z in (p, tiny))
    rest = slow / tiny - direct_forces(model, modes, tiny, slow_wash) / tiny
    wanted = direct_forces(model, modes, p, wash) + p * rest
    np.testing.assert_allclose(Q0, wanted, rtol=1e-6, atol=1e-8 * np.abs(wanted).max())


def test_a_lattice_with_a_tail_holds_as_far_as_the_lattice_does():
    model = AeroelasticWing(lattice_wing(WINGS["folded"]), "lattice")
    modes = model.modes()
    system, lattice = model.system(modes), model.lattice(modes)
    assert system.highest_frequency == lattice.highest_frequency < np.inf
    assert system.largest_decay == lattice.largest_decay < np.inf


# --- T --------------------------------------------------------------------------------------------


def system_of(wing, aerodynamics="strip", **analysis):
    model = AeroelasticWing(wing.with_analysis(**analysis) if analysis else wing, aerodynamics)
    return model.system(model.modes())


def with_free_tip(wing):
    hinges = (*wing.hinges[:-1], Hinge(kind="free", fold=wing.hinges[-1].fold))
    return wing.model_copy(update={"hinges": hinges})


SYSTEMS = {
    "strip": system_of(WINGS["folded"]),
    "damped": system_of(WINGS["folded"], damping=0.03),
    "quasi-steady": system_of(quasi_steady(WINGS["tail lifts"]), "quasi-steady"),
    "lattice": system_of(lattice_wing(WINGS["tail lifts"]), "lattice"),
    "lattice, damped, slow tail": system_of(
        lattice_wing(quasi_steady(WINGS["folded"])), "lattice", damping=0.01
    ),
    "section chords differ": system_of(WINGS["random 6"]),
    "free tip": system_of(with_free_tip(WINGS["folded"])),
    "partly carried": system_of(WINGS["folded"]).partly_carried(12.0),
}
EVERY = pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
PLACES = ((0.1 + 0.3j, 9.0), (-0.02 + 0.07j, 14.0), (0.5 + 0j, 30.0), (1e-3 + 1e-3j, 22.0))


def equation_of_motion(system, p, speed):
    """Modal inertia, damping and stiffness minus air forces at lambda = p U / b."""
    rate, p = p * speed / system.half_chord, np.array([p], complex)
    own = rate**2 + 2 * system.damping * system.omega * rate + system.omega**2
    steady = 0.0 if system.trim_forces is None else system.trim_forces.forces(p)[0]
    return np.diag(own) - speed**2 * system.aerodynamics.forces(p)[0] - steady


@EVERY
def test_t_is_the_equation_of_motion_in_turned_and_scaled_coordinates(system):
    divided = np.where(system.neutral, 1.0, 0.0)
    for p, U in PLACES:
        T = evaluate(system, np.array([p]), np.array([U]))[0]
        by_speed = 1.0 if system.trim_forces is not None else np.where(system.rigid, U**-2.0, 1.0)
        turned = system.rotation.T @ equation_of_motion(system, p, U) @ system.rotation
        wanted = np.outer(system.scale, system.scale) * turned * p**-divided * by_speed
        np.testing.assert_allclose(T, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


@EVERY
def test_surge_and_plunge_of_the_whole_are_neutral_but_not_pitch(system):
    """So is a free tip, whose turn about the stream changes no incidence."""
    rigid = int(system.rigid.sum())
    assert system.neutral.sum() == rigid - 1
    neutral = system.rotation[:, system.neutral]
    np.testing.assert_allclose(neutral[rigid:], 0.0, atol=1e-12)
    for column in (0, 1):
        assert np.linalg.norm(neutral[column]) == pytest.approx(1.0)
    if rigid == 3:
        np.testing.assert_allclose(neutral[2], 0.0, atol=1e-9)


@EVERY
def test_the_zero_roots_of_neutral_motions_are_all_that_is_left_out(system):
    """det T has no zero at p = 0, where the equation of motion has one for each."""
    U, neutral = np.array([20.0]), int(system.neutral.sum())
    near = [np.linalg.slogdet(evaluate(system, np.array([p]), U)[0])[1] for p in (1e-6, 1e-7)]
    assert abs(near[0] - near[1]) < 1e-2
    whole = [np.linalg.slogdet(equation_of_motion(system, p, 20.0))[1] for p in (1e-5, 1e-6)]
    assert (whole[0] - whole[1]) / np.log(10) == pytest.approx(neutral, abs=0.02)


@EVERY
def test_derivatives_of_t_are_those_of_finite_differences(system):
    for p, U in PLACES:
        exact = evaluate_with_derivatives(system, np.array([p]), np.array([U]))
        for which, step in (("p", 1e-5 * abs(p)), ("speed", 1e-4)):
            dp, dU = (step, 0.0) if which == "p" else (0.0, step)
            ahead, behind = (
                evaluate(system, np.array([p + s * dp]), np.array([U + s * dU]))[0] for s in (1, -1)
            )
            wanted = (ahead - behind) / (2 * step)
            found = exact.by_p[0] if which == "p" else exact.by_speed[0]
            np.testing.assert_allclose(found, wanted, atol=1e-6 * np.abs(wanted).max())
        T = evaluate(system, np.array([p]), np.array([U]))
        np.testing.assert_allclose(exact.value, T, rtol=1e-12, atol=1e-12 * np.abs(T).max())


@EVERY
def test_null_vectors_obey_the_equation_of_motion_as_modal_coordinates(system):
    U = 20.0
    guess = system.omega[~system.rigid][:4] * (-0.05 + 1j) * system.half_chord / U
    roots = polish_roots(system, guess, np.full(4, U), iterations=40)
    assert roots.converged.any()
    kept = np.flatnonzero(roots.converged)
    q = system.modal_vectors(roots.p[kept], roots.speed[kept], roots.right[kept])
    for p, x in zip(roots.p[kept], q, strict=True):
        A = equation_of_motion(system, p, U)
        assert np.linalg.norm(A @ x) < 1e-9 * np.linalg.norm(A)
