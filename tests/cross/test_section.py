"""A typical section against other routes to the same numbers.

A rigid strip of a wing made of particles, in metres and seconds; the section of the solvers' own
tests; the eigenvalues of a state space; a section with dimensions against the same in ratios.
"""

import numpy as np
import pytest

from foldwing.airfoil.system import SectionSystem
from foldwing.model import Analysis, TypicalSection, parse_section, read_section
from foldwing.stability.flutter import find_flutter
from foldwing.stability.loci import root_loci
from foldwing.stability.problem import evaluate
from foldwing.stability.region import RIGHT_EDGE
from foldwing.stability.still_air import still_air_roots
from support.sections import RigidStrip
from support.stability import of_kind, unstable_by
from support.typical_section import TypicalSection as Reference

GENERAL = TypicalSection(
    mass_ratio=13.0,
    inertia_ratio=0.4,
    axis_offset=-0.31,
    mass_offset=0.23,
    torsion_frequency_ratio=1.7,
    second_mass_ratio=0.6,
    second_frequency_ratio=1.9,
)
TWO = GENERAL.model_copy(update={"second_mass_ratio": None, "second_frequency_ratio": None})
SECTIONS = {
    "hodges-pierce": read_section("hodges-pierce"),
    "airfoil-3dof": read_section("airfoil-3dof").with_torsion(4.5),
    "two": TWO,
    "three": GENERAL,
}


@pytest.mark.parametrize("name", SECTIONS)
def test_flutter_points_are_those_of_a_rigid_strip(name):
    """det T of the strip vanishes at every flutter point, and not beside it."""
    strip = RigidStrip(SECTIONS[name])
    points = of_kind(find_flutter(SectionSystem(strip.section), (0.1, 40.0)), "flutter")
    assert points
    for point in points:
        omega = 2 * np.pi * point.frequency
        there, beside = (strip.determinant(omega, f * point.speed) for f in (1.0, 1.01))
        assert abs(there) < 1e-9 < 1e-4 < abs(beside)


@pytest.mark.parametrize("name", SECTIONS)
def test_frequencies_at_rest_are_those_of_a_rigid_strip(name):
    """Air at rest is the limit of a slow stream."""
    strip = RigidStrip(SECTIONS[name])
    for ratio in SectionSystem(strip.section).frequency_ratios:
        assert (
            abs(strip.determinant(ratio, 1e-9)) < 1e-7 < abs(strip.determinant(1.01 * ratio, 1e-9))
        )


def test_flutter_points_are_those_of_the_reference_section():
    ours = find_flutter(SectionSystem(TWO), (0.1, 30.0)).points
    reference = Reference(
        a=TWO.axis_offset,
        e=TWO.mass_offset,
        inverse_mass_ratio=1 / TWO.mass_ratio,
        inverse_inertia=1 / TWO.inertia_ratio,
        pitch_frequency=TWO.torsion_frequency_ratio,
    )
    theirs = find_flutter(reference, (0.1, 30.0)).points
    assert len(ours) == len(theirs) > 1
    for one, other in zip(ours, theirs, strict=True):
        assert (one.kind, one.event) == (other.kind, other.event)
        assert one.speed == pytest.approx(other.speed, rel=1e-9)
        assert one.p == pytest.approx(other.p, abs=1e-9)


@pytest.mark.parametrize("name", SECTIONS)
def test_quasi_steady_eigenvalues_are_those_of_a_state_space(name):
    strip = RigidStrip(SECTIONS[name])
    system, speeds = SectionSystem(strip.section, "quasi-steady"), np.linspace(0.0, 2.0, 5)
    loci = root_loci(system, speeds, find_flutter(system, (0.05, 2.0)).sweep)
    for speed, found in zip(speeds, loci.eigenvalue, strict=True):
        oscillating = found[np.isfinite(found) & (found.imag > 0)]
        wanted = strip.quasi_steady_roots(speed)
        wanted = wanted[wanted.imag > 1e-9]
        assert len(oscillating) == len(wanted) == system.size
        oscillating, wanted = (values[np.argsort(values.imag)] for values in (oscillating, wanted))
        np.testing.assert_allclose(oscillating, wanted, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady"])
def test_derivative_of_the_pencil(aerodynamics):
    damped = GENERAL.model_copy(update={"analysis": Analysis(damping=0.03)})
    system = SectionSystem(damped, aerodynamics)
    p, h = np.array([0.2 + 0.4j, -0.05 + 1.1j]), 1e-5
    _, slope = system.pencil_with_derivative(p)
    ahead, behind = system.pencil(p + h), system.pencil(p - h)
    for part in ("linear", "quadratic"):
        wanted = (getattr(ahead, part) - getattr(behind, part)) / (2 * h)
        np.testing.assert_allclose(getattr(slope, part), wanted, rtol=1e-7, atol=1e-9)


def test_a_vanishing_second_mass_changes_nothing():
    tiny = {"second_mass_ratio": 1e-9, "second_frequency_ratio": 30.0}
    with_mass = find_flutter(SectionSystem(TWO.model_copy(update=tiny)), (0.1, 30.0)).points
    without = find_flutter(SectionSystem(TWO), (0.1, 30.0)).points
    assert len(with_mass) == len(without) > 1
    for one, other in zip(with_mass, without, strict=True):
        assert one.speed == pytest.approx(other.speed, rel=1e-6)
        assert one.frequency == pytest.approx(other.frequency, rel=1e-6)


@pytest.mark.parametrize("scales", [{}, {"half_chord": 0.5, "plunge_frequency": 3.0}])
def test_structural_damping_is_that_of_every_mode_at_rest(scales):
    damped = GENERAL.model_copy(update={"analysis": Analysis(damping=0.02), **scales})
    roots = still_air_roots(SectionSystem(damped)).eigenvalue
    np.testing.assert_allclose(-roots.real / np.abs(roots), 0.02, rtol=1e-10)
    rate = 2 * np.pi * scales.get("plunge_frequency", 1 / (2 * np.pi))
    wanted = rate * SectionSystem(GENERAL).frequency_ratios
    np.testing.assert_allclose(np.abs(roots), wanted, rtol=1e-10)


def test_a_slow_stream_is_nearly_rest():
    """Damping and scales of the equations at rest are those of the equations in a stream."""
    scales = {"half_chord": 0.5, "plunge_frequency": 3.0, "analysis": Analysis(damping=0.02)}
    system = SectionSystem(GENERAL.model_copy(update=scales))
    rest = still_air_roots(system).eigenvalue
    slow = np.full(len(rest), 1e-7)
    for root, T in zip(rest, evaluate(system, rest * 0.5 / slow, slow), strict=True):
        assert np.linalg.svd(T, compute_uv=False)[-1] < 1e-6, root


B, RHO, OMEGA1 = 0.9144, 1.1, 50.0
MASS = GENERAL.mass_ratio * np.pi * RHO * B**2
INERTIA = GENERAL.inertia_ratio * MASS * B**2
TORSION = GENERAL.torsion_frequency_ratio * OMEGA1
SECOND = GENERAL.second_frequency_ratio * OMEGA1
COMMON = f"""[air]
density = {RHO}
[section]
elastic_axis = {(1 + GENERAL.axis_offset) / 2!r}
mass_centre = {(1 + GENERAL.axis_offset + GENERAL.mass_offset) / 2!r}
mass_per_span = {MASS!r}
inertia_per_span = {INERTIA!r}
second_mass_per_span = {GENERAL.second_mass_ratio * MASS!r}
"""
BY_FREQUENCY = f"""half_chord = {B!r}
plunge_frequency = {OMEGA1 / (2 * np.pi)!r}
torsion_frequency = "{TORSION!r} rad/s"
second_frequency = "{SECOND / (2 * np.pi)!r} Hz"
"""
BY_STIFFNESS = f"""chord = "{200 * B!r} cm"
plunge_stiffness = {MASS * OMEGA1**2!r}
torsion_stiffness = "{INERTIA * TORSION**2!r} N*m/rad/m"
second_stiffness = "{GENERAL.second_mass_ratio * MASS * SECOND**2 / 1e3!r} kN/m^2"
"""


@pytest.mark.parametrize("springs", [BY_FREQUENCY, BY_STIFFNESS], ids=["frequency", "stiffness"])
def test_dimensions_change_the_units_alone(springs):
    scaled = parse_section(COMMON + springs)
    unit = B * OMEGA1
    assert scaled.speed_unit == pytest.approx(unit, rel=1e-14)
    ratios = find_flutter(SectionSystem(GENERAL), (0.2, 20.0))
    metres = find_flutter(SectionSystem(scaled), (0.2 * unit, 20.0 * unit))
    assert metres.certified and ratios.certified
    assert len(metres.points) == len(ratios.points) > 1
    for one, other in zip(metres.points, ratios.points, strict=True):
        assert (one.kind, one.event, one.mode) == (other.kind, other.event, other.mode)
        assert one.speed / unit == pytest.approx(other.speed, rel=1e-11)
        assert one.frequency / OMEGA1 == pytest.approx(other.frequency, rel=1e-11)


def test_divergence_in_closed_form():
    """Stiffness in pitch against 2 pi rho U^2 b^2 (1/2 + a), whatever the plunge springs."""
    (found,) = of_kind(find_flutter(SectionSystem(GENERAL), (0.2, 20.0)), "divergence")[:1]
    stiffness = INERTIA * TORSION**2
    speed = np.sqrt(stiffness / (2 * np.pi * RHO * B**2 * (0.5 + GENERAL.axis_offset)))
    assert found.speed == pytest.approx(speed / (B * OMEGA1), rel=1e-7)


def test_an_axis_ahead_of_the_quarter_chord_does_not_diverge():
    forward = GENERAL.model_copy(update={"axis_offset": -0.6})
    assert not of_kind(find_flutter(SectionSystem(forward), (0.2, 20.0)), "divergence")


def test_modes_are_named_by_where_they_move():
    low, high = (SectionSystem(GENERAL.with_torsion(ratio)) for ratio in (0.2, 9.0))
    assert low.mode_names == ("pitch", "plunge 1", "plunge 2")
    assert high.mode_names == ("plunge 1", "plunge 2", "pitch")
    assert SectionSystem(TWO.with_torsion(9.0)).mode_names == ("plunge", "pitch")


def test_in_tune_where_two_modes_at_rest_have_one_frequency():
    """Without coupling (a = e = 0) the natural frequencies themselves cross there."""
    section = read_section("airfoil-3dof")
    crossings = SectionSystem(section).uncoupled_crossings()
    assert len(crossings) == 2
    for ratio in crossings:
        frequencies = SectionSystem(section.with_torsion(float(ratio))).frequency_ratios
        assert np.diff(frequencies).min() < 1e-9 < np.diff(frequencies).max()


@pytest.mark.parametrize("beyond", [1e-2, 3e-3, 1e-3, 3e-4, 1e-4])
def test_a_hump_between_two_points_of_the_sweep_is_found(beyond):
    """A branch that grazes the real axis with the bend of another one that it nearly meets."""
    section = TypicalSection(
        mass_ratio=30.600040285,
        inertia_ratio=0.120678549,
        axis_offset=0.411889593,
        mass_offset=0.022866877,
        torsion_frequency_ratio=0.782351742 * (1.0 + beyond),
        second_mass_ratio=0.921086593,
        second_frequency_ratio=1.320417233,
        analysis=Analysis(damping=0.01),
    )
    analysis = find_flutter(SectionSystem(section, "quasi-steady"), (0.0087, 17.0))
    assert analysis.certified
    strip, speeds = RigidStrip(section), np.geomspace(0.3, 3.0, 400)
    listed = [unstable_by(analysis.points, speed, 0) for speed in speeds]
    counted = [np.count_nonzero(strip.quasi_steady_roots(speed).real > 0.0) for speed in speeds]
    assert listed == counted
    assert counted.count(2) > 1


def test_a_light_section_is_certified_though_a_root_grows_beyond_the_region_at_first():
    section = TypicalSection(
        mass_ratio=6.310449869,
        inertia_ratio=0.075316667,
        axis_offset=0.412105612,
        mass_offset=-0.194933131,
        torsion_frequency_ratio=2.203427518,
        second_mass_ratio=0.968934204,
        second_frequency_ratio=4.899862120,
        analysis=Analysis(damping=0.01),
    )
    system = SectionSystem(section)
    p, speed = np.array([RIGHT_EDGE, 3.0], complex), np.full(2, 20.0)
    below, above = np.linalg.det(evaluate(system, p, speed)).real
    assert below < 0.0 < above
    analysis = find_flutter(system, (0.1, 30.0))
    assert analysis.certified
    assert analysis.certificate.counted.tolist() == [0, 0, 1, 3, 1, 1]
