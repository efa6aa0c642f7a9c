"""Rigid motions and natural modes of an aircraft at rest.

Evidence: the kinetic energy of a rigid body, a beam whose other end is heavy, and rates of
convergence. The same matrices with bodies apart are in tests/cross/test_aircraft.py.
"""

import numpy as np
import pytest

from foldwing.model import Hinge, PointMass, read_model
from foldwing.structure.assembly import assemble
from foldwing.structure.modes import natural_modes
from support import level_flight
from support.random_aircraft import heavier, random_aircraft, with_aircraft

NAME = "three-segment-aircraft"


def aircraft(*folds):
    return read_model(NAME).folded(*folds)


def rigid_body(wing):
    """Total mass, centre of gravity (x, z), and inertia in pitch about it."""
    body = level_flight.rigid_body(wing)
    return body.mass, body.centre, body.inertia


WINGS = {
    "flat": aircraft(0, 0),
    "folded": aircraft(30, -75),
    "upright": aircraft(90, 0),
    "with masses": aircraft(50, 20).with_point_masses(
        PointMass(segment=3, mass=0.004, x=0.02, y=0.05)
    ),
    "random 2": random_aircraft(np.random.default_rng(2)),
    "random 9": random_aircraft(np.random.default_rng(9)),
}
EVERY = pytest.mark.parametrize("wing", WINGS.values(), ids=WINGS)


@EVERY
def test_three_motions_have_no_frequency_and_all_others_one(wing):
    modes = natural_modes(assemble(wing))
    assert modes.names[:3] == ("x", "z", "pitch")
    assert (modes.omega[:3] == 0.0).all()
    assert (modes.omega[3:] > 1.0).all()
    assert not any(name.startswith("R") for name in modes.names)


@EVERY
def test_all_modes_have_unit_mass_and_are_orthogonal(wing):
    assembly = assemble(wing)
    q = natural_modes(assembly).coordinates
    np.testing.assert_allclose(q.T @ assembly.mass @ q, np.eye(q.shape[1]), atol=2e-9)
    np.testing.assert_allclose(assembly.stiffness @ q[:, :3], 0.0, atol=1e-6)


@EVERY
def test_rigid_motions_move_all_points_as_one_body_about_the_centre_of_gravity(wing):
    """Their sizes are those of unit kinetic energy: 1/sqrt(m), 1/sqrt(I)."""
    modes, (m, (x_cg, z_cg), inertia) = natural_modes(assemble(wing)), rigid_body(wing)
    for index, segment in enumerate(wing.segments):
        x = segment.chord * np.array([-0.5, 0.0, 0.3, 0.6])
        y = segment.span * np.array([0.0, 0.3, 0.7, 1.0])
        at, u = modes.position(index, x, y), modes.displacement(index, x, y)
        zero, one = np.zeros(4), np.ones(4)
        pitch = np.stack([at[:, 2] - z_cg, zero, x_cg - at[:, 0]], axis=1)
        wanted = [np.stack([one, zero, zero], axis=1), np.stack([zero, zero, one], axis=1), pitch]
        for column, (shape, size) in enumerate(zip(wanted, (m, m, inertia), strict=True)):
            np.testing.assert_allclose(
                u[:, :, column],
                shape / np.sqrt(size),
                rtol=1e-6,
                atol=1e-6 * abs(shape).max() / np.sqrt(size),
            )


@EVERY
def test_kinetic_energy_of_a_rigid_motion_is_that_of_one_body(wing):
    """Forward speed, climb and nose-up rate at once, in the coordinates of the root."""
    modes, assembly = natural_modes(assemble(wing)), assemble(wing)
    m, (x_cg, z_cg), inertia = rigid_body(wing)
    rates = np.array([1.3, -0.4, 0.7])
    # The root moves so when the aircraft turns about it.
    own = rates * np.sqrt([m, m, inertia])
    own[:2] += np.array([z_cg, -x_cg]) * rates[2] * np.sqrt(m)
    v = modes.coordinates[:, :3] @ own
    at_centre = rates[:2] + rates[2] * np.array([z_cg, -x_cg])
    wanted = m * (at_centre**2).sum() / 2 + inertia * rates[2] ** 2 / 2
    assert v @ assembly.mass @ v / 2 == pytest.approx(wanted, rel=1e-6)
    root = modes.displacement(0, np.zeros(1), np.zeros(1))[0, :, :3] @ own
    np.testing.assert_allclose(root, [rates[0], 0.0, rates[1]], atol=1e-6)


def test_mass_and_inertia_of_the_assembly_are_those_of_its_pieces():
    for wing in WINGS.values():
        m, _, inertia = rigid_body(wing)
        modes = natural_modes(assemble(wing))
        root = modes.displacement(0, np.zeros(1), np.zeros(1))[0]
        assert root[0, 0] ** -2 == pytest.approx(m, rel=1e-9)
        assert root[2, 1] ** -2 == pytest.approx(m, rel=1e-9)
        nose_up = modes.section_motion(0, np.zeros(1)).twist[0, 2]
        assert nose_up**-2 == pytest.approx(inertia, rel=1e-6)


@pytest.mark.parametrize("folds", [(30, -30), (0, 0), (100, -120)], ids=str)
def test_a_heavy_fuselage_clamps_the_root_with_an_error_as_one_over_its_mass(folds):
    """In a basis that is complete at the root; one degree more of twist makes up for the pitch."""
    wing = aircraft(*folds).with_analysis(basis="converged", bending_modes=12, torsion_modes=12)
    clamped = natural_modes(assemble(wing.clamped)).omega[:6]
    factors = np.array([10.0, 100.0, 1e4, 1e6])
    errors = []
    for factor in factors:
        omega = natural_modes(assemble(heavier(wing, factor))).omega[3:9]
        errors.append(np.abs(omega / clamped - 1))
    errors = np.array(errors)
    assert errors[-1].max() < 1e-5
    first = errors[2] > 1e-6
    rate = np.log(errors[3][first] / errors[2][first]) / np.log(factors[3] / factors[2])
    assert first.sum() >= 4
    np.testing.assert_allclose(rate, -1.0, atol=0.01)


def test_cosines_twist_a_heavy_aircraft_a_little_more_stiffly_than_sines_a_clamped_wing():
    """The basis free-free has no moment at its ends, at the root of an aircraft neither.

    Bending, whose functions are those of a clamped wing, has nothing to lose.
    """
    gaps = {}
    for count in (10, 20, 40):
        wing = aircraft(30, -30).with_analysis(torsion_modes=count)
        clamped = natural_modes(assemble(wing.clamped))
        heavy = natural_modes(assemble(heavier(wing, 1e8)))
        assert clamped.names[:4] == heavy.names[3:7] == ("B1", "B2", "T1", "B3")
        gaps[count] = heavy.omega[3:7] / clamped.omega[:4] - 1
        np.testing.assert_allclose(gaps[count][[0, 1, 3]], 0.0, atol=1e-6)
    torsion = np.array([gap[2] for gap in gaps.values()])
    assert 0.005 < torsion[0] < 0.015
    np.testing.assert_allclose(torsion[1:] / torsion[:-1], 0.5, atol=0.05)


def test_a_free_hinge_gives_one_more_rigid_motion():
    wing = aircraft(30, -60)
    free = wing.model_copy(
        update={"hinges": (wing.hinges[0], Hinge(kind="free", fold=wing.hinges[1].fold))}
    )
    modes = natural_modes(assemble(free))
    assert modes.names[:4] == ("x", "z", "pitch", "R1")
    assert (modes.omega[:4] == 0.0).all() and modes.omega[4] > 1.0
    tip = modes.displacement(2, np.zeros(1), np.array([0.06]))[0, :, 3]
    assert np.linalg.norm(tip) > 1.0


def test_both_bodies_may_trade_their_mass_on_the_same_spot():
    """Only mass, moment and inertia of what the root carries matter."""
    wing = aircraft(30, -60)
    plane = wing.aircraft
    f, t = plane.fuselage, plane.tail
    m = f.mass + t.mass
    x = (f.mass * f.x + t.mass * t.x) / m
    inertia = f.pitch_inertia + t.pitch_inertia
    inertia += f.mass * (f.x - x) ** 2 + t.mass * (t.x - x) ** 2
    one = f.model_copy(update={"mass": m - 1e-9, "x": x, "pitch_inertia": inertia})
    none = t.model_copy(update={"mass": 1e-9, "pitch_inertia": 1e-12})
    other = with_aircraft(wing, fuselage=one, tail=none)
    before, after = (natural_modes(assemble(w)).omega for w in (wing, other))
    np.testing.assert_allclose(after, before, rtol=1e-6)
