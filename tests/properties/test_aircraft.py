"""What holds for any aircraft: counts of unstable roots, flutter points, motions of the whole.

Random aircraft are drawn as widely as random wings: some fly only far beyond their flutter speed.
"""

from functools import cache

import numpy as np
import pytest

from foldwing.aeroelastic.flight_modes import flight_modes
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import example_text, parse_model
from foldwing.stability.flutter import find_flutter
from foldwing.stability.loci import Further, root_loci
from foldwing.stability.newton import polish_roots
from foldwing.stability.problem import evaluate
from foldwing.stability.still_air import still_air_roots
from foldwing.stability.tracking import Beginning, track
from support.random_aircraft import random_aircraft, with_aircraft
from support.stability import UnstableRoots, example_wing, unstable_by

NAME = "three-segment-aircraft"
TOP = 60.0

AIRCRAFT = (0, 1, 2, 3, 9, 22, 24, 27)
"""Of the last three the part of det T that no airspeed changes turns by more than 2 pi per step."""


@cache
def solved(name, aerodynamics="strip"):
    """System, slowest airspeed and flutter analysis of a random aircraft or of the example."""
    if isinstance(name, int):
        wing = random_aircraft(np.random.default_rng(name))
    else:
        wing = example_wing(NAME).wing.folded(*name)
    if aerodynamics == "lattice":
        wing = wing.with_lattice(chordwise=4, spanwise=12, wake=10.0)
    model = AeroelasticWing(wing, aerodynamics)
    modes = model.modes()
    system, slowest = model.system(modes), model.trim(modes).slowest
    top = 4 * slowest if isinstance(name, int) else TOP
    return system, slowest, find_flutter(system, (slowest, top))


CASES = [(name, "strip") for name in (*AIRCRAFT, (30, -60), (90, -90))]
CASES += [(name, "lattice") for name in (0, (30, -60))]
CASES += [(name, "quasi-steady") for name in (1, (30, 60))]
EVERY = pytest.mark.parametrize(("name", "aerodynamics"), CASES, ids=str)


@EVERY
def test_an_independent_count_of_unstable_roots_agrees_with_certificate_and_points(
    name, aerodynamics
):
    system, _, found = solved(name, aerodynamics)
    certificate = found.certificate
    assert found.certified
    plain = UnstableRoots(system, found.sweep.region.highest)
    some = np.unique(np.linspace(0, len(certificate.speeds) - 1, 3).astype(int))
    for index in some:
        speed, counted = certificate.speeds[index], certificate.counted[index]
        assert plain.at(speed) == counted
        assert unstable_by(found.points, speed, certificate.counted[0]) == counted


def least(system, p, speed):
    """Least singular value of T."""
    T = evaluate(system, np.array([p], complex), np.array([speed]))[0]
    return np.linalg.svd(T, compute_uv=False)[-1]


@EVERY
def test_every_point_is_a_root(name, aerodynamics):
    """T is far more singular there than at an airspeed that is one per cent higher."""
    system, _, found = solved(name, aerodynamics)
    for point in found.points:
        p = point.p if point.p != 0 else 1e-9
        assert least(system, p, point.speed) < 2e-3 * least(system, p, 1.01 * point.speed)


@EVERY
def test_mergers_are_where_an_unstable_pair_turns_real(name, aerodynamics):
    system, _, found = solved(name, aerodynamics)
    for point in found.points:
        if point.event != "merger":
            continue
        below, above = (point.speed * (1 + d) for d in (-1e-6, 1e-6))
        beside = 1e-3 * point.p.real
        pair = polish_roots(system, np.array([point.p + 1j * beside]), np.array([below]))
        apart = polish_roots(system, point.p + np.array([-1, 1]) * beside, np.full(2, above))
        assert pair.p[0].imag > 0 < pair.p[0].real
        np.testing.assert_allclose(apart.p.imag, 0.0, atol=1e-9 * point.p.real)


def test_two_roots_are_neutral_at_every_airspeed():
    """x and z do not matter: the equation of motion has p^2 as a factor at any airspeed."""
    system, slowest, _ = solved((30, -60))
    for U in (slowest, 20.0, TOP):
        force = system.aerodynamics.forces(np.array([1e-7j]))[0] * U**2
        force += system.trim_forces.forces(np.array([1e-7j]))[0]
        np.testing.assert_allclose(force[:, :2] / np.abs(force).max(), 0.0, atol=1e-6)


@pytest.mark.parametrize("folds", [(0, 0), (30, -60), (30, 60)], ids=str)
def test_the_phugoid_slows_as_the_airspeed_grows(folds):
    """Near sqrt(2) g/U at first; the elastic wing and the growing instability hold it up later."""
    system, slowest, _ = solved(folds)
    motions = flight_modes(system, (slowest, TOP), 9.80665)
    assert motions.names[0] == "phugoid"
    speeds = slowest * np.array([1.0, 1.2, 1.5])
    value = motions.eigenvalues(system, speeds)[:, 0]
    times_speed = value.imag * speeds
    assert np.ptp(times_speed) < 0.12 * times_speed.mean()
    assert times_speed[0] == pytest.approx(np.sqrt(2) * 9.81, rel=0.2)
    assert (0 < value.real).all() and (value.real < 0.5 * value.imag).all()


# --- too slow to carry the weight -----------------------------------------------------------------


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady", "lattice"])
def test_a_partly_carried_aircraft_becomes_the_flying_one_at_its_airspeed(aerodynamics):
    system, slowest, _ = solved((30, -60), aerodynamics)
    partly = system.partly_carried(slowest)
    guess = system.omega[3:8] * (-0.1 + 1j) * system.half_chord / slowest
    guess = np.append(guess, (0.2 + 1.4j) * system.half_chord / slowest)
    U = np.full(len(guess), slowest)
    flying = polish_roots(system, guess, U, iterations=40)
    assert flying.converged.sum() >= 5
    p = flying.p[flying.converged]
    found = polish_roots(partly, p * (1 + 1e-5j), U[: len(p)])
    np.testing.assert_allclose(found.p, p, rtol=1e-9)


def test_below_its_airspeed_the_carried_weight_falls_with_the_square_of_the_airspeed():
    """Half the airspeed is flown as if gravity were a quarter."""
    wing = example_wing(NAME).wing.folded(30, -60)
    light = with_aircraft(wing, gravity=9.81 / 4)
    full, quarter = (AeroelasticWing(w) for w in (wing, light))
    partly = full.system(full.modes()).partly_carried(12.0)
    lighter = quarter.system(quarter.modes())
    guess = np.append(partly.omega[3:8] * (-0.1 + 1j), 0.1 + 1.4j) * partly.half_chord / 6.0
    slow = np.full(6, 6.0)
    one, other = (polish_roots(s, guess, slow, iterations=40) for s in (partly, lighter))
    kept = one.converged & other.converged
    assert kept.sum() >= 4
    np.testing.assert_allclose(one.p[kept], other.p[kept], rtol=1e-9)


def test_at_rest_a_partly_carried_aircraft_has_the_roots_of_still_air():
    system, slowest, _ = solved((30, -60))
    partly, own = (still_air_roots(s).eigenvalue for s in (system.partly_carried(slowest), system))
    np.testing.assert_allclose(partly, own, rtol=1e-12)
    # Followed from a crawl, the roots come from there.
    crawl = track(system.partly_carried(slowest), np.array([0.0, 0.05]))
    np.testing.assert_allclose(crawl.eigenvalue[1].imag, crawl.eigenvalue[0].imag, rtol=0.01)


@pytest.mark.parametrize("aerodynamics", ["strip", "lattice"])
def test_loci_pass_the_slowest_airspeed_without_a_jump_and_are_certified(aerodynamics):
    system, slowest, found = solved((30, -60), aerodynamics)
    beginning = Beginning(system.partly_carried(slowest), slowest)
    motions = flight_modes(system, (slowest, TOP), 9.80665)
    speeds = np.concatenate([[0.0], slowest + np.array([-1e-3, 0.0, 1e-3]), [25.0, 30.0, 38.0]])
    loci = root_loci(system, speeds, found.sweep, Further(motions.roots, beginning))
    assert loci.certified[speeds >= slowest].all()
    elastic = loci.eigenvalue[1:4][:, loci.mode >= 0]
    followed = np.isfinite(elastic).all(axis=0)
    assert followed.sum() >= 6
    np.testing.assert_allclose(elastic[0, followed], elastic[1, followed], rtol=1e-3)
    np.testing.assert_allclose(elastic[2, followed], elastic[1, followed], rtol=1e-3)


def test_a_motion_is_followed_down_from_beyond_the_airspeeds_of_the_curves():
    system, slowest, found = solved((30, -60))
    beginning = Beginning(system.partly_carried(slowest), slowest)
    motions = flight_modes(system, (slowest, TOP), 9.80665)
    speeds = np.array([14.0, 16.0, 18.0])
    at_top = motions.eigenvalues(system, np.array([25.0]))[0] * system.half_chord / 25.0
    high = polish_roots(system, at_top, np.full(len(at_top), 25.0))
    for roots in (motions.roots, high):
        loci = root_loci(system, speeds, found.sweep, Further(roots, beginning))
        own = loci.eigenvalue[:, loci.mode < -1]
        np.testing.assert_allclose(own, motions.eigenvalues(system, speeds), rtol=1e-9)
        assert loci.certified.all()


def test_a_phugoid_that_merges_and_is_born_again_is_followed_where_it_is_first():
    """With a heavy tip it is real from about 30 to 70 m/s; beyond, it stands apart best."""
    tip = '\n[[point_mass]]\nsegment = 3\nmass = "20 g"\nx = "1 cm"\ny = "6 cm"\n'
    model = AeroelasticWing(parse_model(example_text(NAME) + tip))
    modes = model.modes()
    system, slowest = model.system(modes), model.trim(modes).slowest
    motions = flight_modes(system, (slowest, 93.0), 9.80665)
    speeds = np.linspace(slowest, 25.0, 6)
    phugoid = motions.eigenvalues(system, speeds)[:, motions.names.index("phugoid")]
    assert (np.abs(phugoid) * speeds < 3 * np.sqrt(2) * 9.80665).all()  # nan where it is lost
    further = Further(motions.roots, Beginning(system.partly_carried(slowest), slowest))
    found = find_flutter(system, (slowest, 93.0))
    assert root_loci(system, speeds, found.sweep, further).certified.all()


# --- mixed models ---------------------------------------------------------------------------------


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady", "lattice"])
def test_wing_and_tail_may_have_theories_of_their_own(aerodynamics):
    """The tail's lag changes the short period a little, and the count is certified either way."""
    wing = example_wing(NAME).wing.folded(30, -60).with_lattice(chordwise=4, spanwise=12)
    found = {}
    for theory in ("theodorsen", "quasi-steady"):
        model = AeroelasticWing(with_aircraft(wing, tail_aerodynamics=theory), aerodynamics)
        system = model.system(model.modes())
        analysis = find_flutter(system, (12.0, 45.0))
        assert analysis.certified
        found[theory] = analysis.critical.speed
    first, second = found.values()
    assert first != second
    assert first == pytest.approx(second, rel=0.05)
