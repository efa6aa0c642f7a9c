"""The fast lattice has the roots of the reference, which marches everything and condenses nothing.

Evidence: the reference builds its equations row by row in time, with every vortex of the wake as a
state; the fast form sums the wake in closed form and solves a nonlinear problem of the size of the
modes. They share the influence of a vortex and the motion of the wing, nothing else.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from foldwing.aeroelastic.reference import Reference
from foldwing.aeroelastic.reference_flutter import GROWING, RealRoots, real_roots
from foldwing.aeroelastic.reference_loci import advance, follow
from foldwing.aeroelastic.reference_roots import roots_near
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import parse_model, read_model
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_roots
from foldwing.stability.status import Status
from foldwing.stability.tracking import track
from foldwing.studies.reference import solve_reference

FOLDS = tuple(np.radians([30.0, -75.0]))
SMALL = {"chordwise": 2, "spanwise": 6, "wake": 5.0, "scheme": "average"}
SPEED = 20.0
ACCURACY = 1e-11


@cache
def wing_of(damping=0.0, **lattice):
    wing = read_model("three-segment").with_lattice(**(SMALL | lattice))
    return AeroelasticWing(wing.with_analysis(damping=damping), "lattice")


@cache
def modes_of(damping=0.0):
    return wing_of(damping).modes(FOLDS)


def both(damping=0.0, **lattice):
    """The fast problem and the equations of the reference of one wing."""
    model, modes = wing_of(damping, **lattice), modes_of(damping)
    return model.system(modes), Reference(model, modes).at(SPEED)


def growing_slowly(problem, spectrum):
    """Oscillating roots of the wing, as p: those of the cut-off wake decay faster."""
    p = spectrum.eigenvalues * problem.half_chord / SPEED
    return p[(p.imag > 0.01) & (p.real > -0.1)]


def followed(reference, speeds):
    """The modes at the last airspeed."""
    return list(follow(reference, speeds))[-1]


@pytest.mark.parametrize(
    "case",
    [
        {"scheme": "average"},
        {"scheme": "literal"},
        {"scheme": "printed"},
        {"scheme": "average", "damping": 0.03},
        {"scheme": "literal", "damping": 0.03},
        {"scheme": "average", "relaxation": 0.7},
        {"scheme": "average", "relaxation": 0.7, "wake": 0.5},  # a wake of one row
        {"scheme": "average", "image": True, "spacing": "cosine"},
        {"scheme": "literal", "chordwise": 5, "wake": 7.3},
    ],
    ids=str,
)
def test_the_fast_form_has_the_roots_of_the_reference(case):
    problem, marching = both(**case)
    p = growing_slowly(problem, roots_near(marching, 150.0j, 10))
    assert len(p) >= 4
    fast = polish_roots(problem, p, np.full(len(p), SPEED))
    assert fast.converged.all()
    np.testing.assert_allclose(fast.p, p, rtol=ACCURACY)


def test_the_fast_form_has_the_roots_of_the_reference_on_the_default_mesh():
    model = AeroelasticWing(read_model("three-segment").with_lattice(scheme="average"), "lattice")
    marching = Reference(model, modes_of()).at(SPEED)
    assert marching.states == 8 * 30 + 160 * 30 + 2 * 12
    problem = model.system(modes_of())
    p = growing_slowly(problem, roots_near(marching, 170.0j, 4))
    assert len(p) >= 2
    fast = polish_roots(problem, p, np.full(len(p), SPEED))
    np.testing.assert_allclose(fast.p, p, rtol=ACCURACY)


def test_segments_with_other_leading_edges():
    text = """[material.sheet]
youngs_modulus = "2.8 GPa"
shear_modulus = "1.2 GPa"
density = "1145 kg/m^3"
[wing]
chord = "5 cm"
thickness = "1.6 mm"
material = "sheet"
[[wing.segment]]
span = "14 cm"
[[wing.segment]]
span = "10 cm"
elastic_axis = 0.4
hinge = { stiffness = "0.2 N*m/rad", fold = 40 }
"""
    model = AeroelasticWing(parse_model(text).with_lattice(**SMALL), "lattice")
    modes = model.modes()
    assert len(model.influence(modes).groups) == 2
    problem, marching = model.system(modes), Reference(model, modes).at(SPEED)
    p = growing_slowly(problem, roots_near(marching, 200.0j, 10))
    assert len(p) >= 3
    fast = polish_roots(problem, p, np.full(len(p), SPEED))
    np.testing.assert_allclose(fast.p, p, rtol=ACCURACY)


def test_without_air_the_modes_stand_alone():
    thin = AeroelasticWing(wing_of().wing.with_air(1e-9), "lattice")
    modes = thin.modes(FOLDS)
    marching = Reference(thin, modes).at(SPEED)
    alone = marching.in_vacuo()
    turned = np.tan(alone.imag * marching.step / 2) * 2 / marching.step  # the trapezoidal rule
    np.testing.assert_allclose(turned, modes.omega, rtol=1e-9)
    np.testing.assert_allclose(alone.real, 0.0, atol=1e-9 * modes.omega[0])


def test_modes_are_followed_to_the_same_roots_as_by_the_fast_form():
    model, modes = wing_of(), modes_of()
    speeds = np.linspace(3.0, 30.0, 10)
    states = list(follow(Reference(model, modes), speeds))
    loci = track(model.system(modes), speeds)
    compared = 0
    for row, state in enumerate(states):
        shared = [(i, m) for i, m in enumerate(loci.mode) if state.found[m]]
        shared = [(i, m) for i, m in shared if loci.status[row, i] == Status.OK]
        for column, mode in shared:
            assert state.eigenvalue[mode] == pytest.approx(loci.eigenvalue[row, column], rel=1e-9)
            compared += 1
    assert compared >= 50


@pytest.mark.parametrize("speeds", [[30.0], [12.0, 30.0]])
def test_modes_keep_their_vectors_over_long_steps(speeds):
    reference = Reference(wing_of(), modes_of())
    far = followed(reference, np.array(speeds))
    near = followed(reference, np.linspace(1.0, 30.0, 30))
    assert far.found.sum() >= 7
    np.testing.assert_allclose(far.eigenvalue[far.found], near.eigenvalue[far.found], rtol=1e-9)


def test_a_lost_mode_is_sought_from_half_way():
    reference = Reference(wing_of(), modes_of())
    start = followed(reference, np.array([4.0, 7.0, 10.0]))
    assert not advance(reference, start, 30.0, halvings=0).found[:9].all()
    assert advance(reference, start, 30.0).found[:9].all()


def test_a_mode_goes_on_with_the_like_vector_not_the_nearest_root():
    reference = Reference(wing_of(), modes_of())
    start = followed(reference, np.linspace(2.0, 20.0, 10))
    right = advance(reference, start, 20.5)
    astray = 0.8 * (start.eigenvalue[2] - start.eigenvalue[1]) * (np.arange(12) == 1)
    found = advance(reference, replace(start, drift=start.drift + astray), 20.5)
    assert found.eigenvalue[1] == pytest.approx(right.eigenvalue[1], rel=1e-9)


def test_a_mode_too_fast_for_the_steps_begins_when_they_are_short_enough():
    model, modes = wing_of(), modes_of()
    speeds = np.array([6.0, 14.0, 26.0])
    states = list(follow(Reference(model, modes), speeds))
    for speed, state in zip(speeds, states, strict=True):
        step = 0.05 / 2 / speed
        expected = np.where(modes.omega * step < np.pi / 2, Status.OK, Status.UNRESOLVED)
        np.testing.assert_array_equal(state.status, expected)
        assert np.isfinite(state.eigenvalue[state.found]).all()
        assert np.isnan(state.eigenvalue[~state.found]).all()


def test_the_growth_changes_sign_at_the_flutter_point_of_the_fast_form():
    model, modes = wing_of(), modes_of()
    onset = find_flutter(model.system(modes), (1.0, 30.0)).critical
    reference = Reference(model, modes)
    growth = []
    for speed in onset.speed * np.array([1.0 - 1e-6, 1.0, 1.0 + 1e-6]):
        guess = onset.p * speed / model.half_chord
        spectrum = roots_near(reference.at(speed), guess * 1.001, 4)
        growth.append(spectrum.eigenvalues[np.argmin(np.abs(spectrum.eigenvalues - guess))].real)
    assert growth[0] < 0.0 < growth[2]
    assert abs(growth[1]) < 1e-3 * growth[2]


@pytest.mark.parametrize(
    ("name", "folds", "top"), [("three-segment", FOLDS, 60), ("hale", (), 130)]
)
def test_every_crossing_of_the_sweep_but_mergers_is_found(name, folds, top):
    model = AeroelasticWing(read_model(name).with_lattice(**SMALL), "lattice")
    modes = model.modes(folds)
    swept = find_flutter(model.system(modes), (3.0, top)).points
    swept = [point for point in swept if point.event != "merger"]
    assert {point.kind for point in swept} == {"flutter", "divergence"}
    found = solve_reference(Reference(model, modes), np.linspace(3.0, top, 24)).points
    for point, other in zip(found, swept, strict=True):
        assert (point.kind, point.event) == (other.kind, other.event)
        assert point.speed == pytest.approx(other.speed, rel=1e-7)
        assert point.frequency == pytest.approx(other.frequency, rel=1e-8)
        if point.kind == "flutter":
            assert point.strength == pytest.approx(other.strength, rel=1e-3)
            assert point.mode == other.mode
            assert (point.classification == "hump") == (other.classification == "hump")


def test_an_onset_whose_branch_is_still_unstable_at_the_end_has_no_class():
    model, modes = wing_of(), modes_of()
    swept = find_flutter(model.system(modes), (3.0, 80.0)).points
    recovers = next(p for p in swept if p.event == "recovery" and p.kind == "flutter")
    onset = next(p for p in swept if p.branch == recovers.branch and p.event == "onset")
    for end, name in ((onset.speed + 2.0, ""), (recovers.speed + 2.0, "hump")):
        found = solve_reference(Reference(model, modes), np.linspace(3.0, end, 10))
        same = next(p for p in found.points if p.speed == pytest.approx(onset.speed, rel=1e-6))
        assert same.classification == name


@pytest.mark.parametrize(
    ("speed", "threshold"), [(14.0, 0.0), (24.0, 0.0), (14.0, 0.02), (24.0, -0.02)]
)
def test_roots_beyond_the_boundary_at_the_lowest_airspeed_are_counted_as_by_the_sweep(
    speed, threshold
):
    model, modes = wing_of(), modes_of()
    swept = find_flutter(model.system(modes), (speed, speed + 4.0), threshold)
    found = solve_reference(Reference(model, modes), np.array([speed]), threshold)
    assert found.unstable_from_start == swept.unstable_from_start


def without_neutral_roots(monkeypatch, below):
    """Make the search for real roots around zero blind below an airspeed."""

    def blind(reference, airspeed, shift=GROWING):
        found = real_roots(reference, airspeed, shift)
        kept = slice(0, 0) if shift != GROWING and airspeed < below else slice(None)
        parts = (found.eigenvalue, found.residual, found.vectors)
        return RealRoots(airspeed, *(part[kept] for part in parts))

    monkeypatch.setattr("foldwing.aeroelastic.reference_flutter.real_roots", blind)


@pytest.mark.parametrize("blind_until", [0.3, np.inf])
def test_a_divergence_that_is_counted_but_not_found_is_named(monkeypatch, blind_until):
    model, modes = wing_of(), modes_of()
    swept = find_flutter(model.system(modes), (20.0, 80.0)).points
    onset = next(p.speed for p in swept if p.kind == "divergence" and p.event == "onset")
    ends = np.array([onset - 1.0, onset + 1.0])
    reference = Reference(model, modes)
    seen = solve_reference(reference, ends)
    assert [p.speed for p in seen.points if p.kind == "divergence"] == pytest.approx([onset])
    assert seen.missed == ()
    without_neutral_roots(monkeypatch, onset + blind_until)
    lost = solve_reference(reference, ends)
    assert not [p for p in lost.points if p.kind == "divergence"]
    assert lost.missed == (tuple(ends),)


@pytest.mark.parametrize("threshold", [0.02, -0.02])
def test_crossings_of_a_damping_ratio(threshold):
    model, modes = wing_of(), modes_of()
    swept = find_flutter(model.system(modes), (3.0, 35.0), threshold).points
    reference = Reference(model, modes)
    found = solve_reference(reference, np.linspace(3.0, 35.0, 12), threshold).points
    swept = [point for point in swept if reference.modes.omega[point.mode] < 500.0]
    found = [point for point in found if reference.modes.omega[point.mode] < 500.0]
    assert swept
    for point, other in zip(found, swept, strict=True):
        assert point.speed == pytest.approx(other.speed, rel=1e-7)


@pytest.mark.parametrize(
    ("speed", "step", "panels"),
    [
        (10.0, 1e-3, 5),
        (20.0, 1e-3, 2),
        (20.0, 0.9e-3, 3),
        (22.0, 1e-3, 2),
        (90.0, 1e-3, 1),
        (5.0, 2.4e-3, 4),
    ],
)
def test_a_fixed_step_takes_the_panels_that_fit_the_chord(speed, step, panels):
    marching = Reference(wing_of(), modes_of(), step).at(speed)
    assert marching.sizes[0] == panels * marching.sizes[1]
    assert panels * marching.step * speed == pytest.approx(0.05)


def test_a_fixed_step_has_the_roots_of_the_mesh_that_it_asks_for():
    stepped = Reference(wing_of(), modes_of(), 0.05 / 5 / SPEED).at(SPEED)
    meshed = Reference(wing_of(chordwise=5), modes_of()).at(SPEED)
    found = [roots_near(marching, 150.0j, 4).eigenvalues for marching in (stepped, meshed)]
    np.testing.assert_allclose(*found, rtol=1e-12)


@pytest.mark.parametrize("step", [0.0, -1.0, np.nan, np.inf])
def test_a_step_must_be_a_time(step):
    with pytest.raises(InputError, match="--time-step"):
        Reference(wing_of(), modes_of(), step)


def test_a_step_too_short_for_the_airspeed_is_refused():
    with pytest.raises(InputError, match="500 panels along the chord at 1 m/s"):
        Reference(wing_of(), modes_of(), 1e-4).at(1.0)


def test_continuous_time_has_no_reference():
    with pytest.raises(InputError, match=r"lattice\.scheme.*discrete time"):
        Reference(wing_of(scheme="exact"), modes_of())


def test_unequal_chords_have_no_reference():
    text = read_model("three-segment")
    narrow = text.segments[0].model_copy(update={"chord": 0.04})
    wing = text._with(segments=(narrow, *text.segments[1:])).with_lattice(scheme="exact")
    model = AeroelasticWing(wing, "lattice")
    with pytest.raises(InputError, match=r"wing\.chord.*equal chord"):
        Reference(model, modes_of())
