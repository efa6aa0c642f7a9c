"""Strip theory against Theodorsen's own convention, the typical section and closed forms."""

import numpy as np
import pytest
import scipy.linalg
from scipy.special import hankel2, kv

from foldwing.aerodynamics.strip import StripModel, strip_forces, strip_model
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Hinge, Segment, Wing, read_model
from foldwing.stability.flutter import find_flutter
from foldwing.stability.problem import evaluate
from foldwing.studies.case import solve_case
from support.typical_section import TypicalSection

RHO = 1.2
SECTIONS = [(0.0, 2 * np.pi), (-0.34, 2 * np.pi), (0.4, 4.4), (-0.5, 5.5)]
FREQUENCIES = [0.003, 0.05, 0.3, 1.0, 4.0]
GENERAL = np.array([0.02 + 0.3j, -0.05 + 0.4j, 0.1 + 0.01j, 0.6 + 1.5j, -0.2 + 0.9j])


def section_segment(a, lift_slope, *, span=1.0, chord=0.3):
    """A segment with its elastic axis a half chords aft of mid-chord."""
    return Segment(
        span=span,
        chord=chord,
        bending_stiffness=1.0,
        torsion_stiffness=1.0,
        mass_per_span=1.0,
        inertia_per_span=0.1,
        elastic_axis=(1 + a) / 2,
        mass_centre=(1 + a) / 2,
        lift_slope=lift_slope,
    )


def lag_of_hankel(k):
    """Theodorsen's C(k) as he writes it, with Hankel functions of the second kind."""
    return hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))


def theodorsen_1935(section, C, motion, v):
    """Force P (positive down) and moment (nose up) per span of NACA Report 496, (XVIII) and (XX).

    ``section`` is (b, a, lift slope); ``motion`` the plunge, positive down, and its rates, then
    incidence and its rates. Where the report has 2 pi for the slope of the lift, the slope stands.
    """
    b, a, slope = section
    _h, dh, ddh, alpha, dalpha, ddalpha = motion
    Q = v * alpha + dh + b * (0.5 - a) * dalpha
    P = -RHO * b**2 * np.pi * (v * dalpha + ddh - b * a * ddalpha) - slope * RHO * v * b * C * Q
    inertia = (0.5 - a) * v * b * dalpha + b**2 * (0.125 + a**2) * ddalpha - a * b * ddh
    M = -RHO * b**2 * np.pi * inertia + slope * RHO * v * b**2 * (a + 0.5) * C * Q
    return P, M


def harmonic(h, alpha, rate):
    """Plunge down and incidence with two rates each, for exp(rate t)."""
    return h, rate * h, rate**2 * h, alpha, rate * alpha, rate**2 * alpha


def direct_forces(section, C, p, plunge, twist, weights):
    """Qhat(p) (n, n) at speed 1: work of the loads of motion j on motion i, station by station.

    ``plunge`` is positive up as everywhere in foldwing; Theodorsen's h is its negative.
    """
    n = plunge.shape[1]
    Q = np.zeros((n, n), complex)
    for j in range(n):
        motion = harmonic(-plunge[:, j], twist[:, j], p / section[0])
        P, M = theodorsen_1935(section, C, motion, 1.0)
        for i in range(n):
            Q[i, j] = np.sum(weights * (P * -plunge[:, i] + M * twist[:, i]))
    return Q


def single_section(segment, lag=True, span=1.0):
    """Strip theory of a rigid piece of wing; coordinates plunge up and twist."""
    plunge, twist = np.array([[1.0, 0.0]]), np.array([[0.0, 1.0]])
    forces = strip_forces(segment, RHO, np.array([span]), plunge, twist)
    return strip_model([forces], [np.eye(2)], segment.half_chord, lag)


@pytest.mark.parametrize(("a", "slope"), SECTIONS)
@pytest.mark.parametrize("k", FREQUENCIES)
def test_rigid_section_feels_theodorsens_loads(a, slope, k):
    """Lift and moment of harmonic plunge and pitch, in the report's own signs, to 1e-12."""
    segment = section_segment(a, slope)
    section = segment.half_chord, a, slope
    stations = np.array([[1.0, 0.0]]), np.array([[0.0, 1.0]]), np.ones(1)
    exact = direct_forces(section, lag_of_hankel(k), 1j * k, *stations)
    found = single_section(segment).forces(np.array([1j * k]))[0]
    np.testing.assert_allclose(found, exact, atol=1e-12 * np.abs(exact).max())


@pytest.mark.parametrize(("a", "slope"), SECTIONS)
def test_speed_and_density_scale_the_loads(a, slope):
    """Physical loads at 37 m/s are U^2 Qhat: the reduced variable holds all of the speed."""
    segment, k, U = section_segment(a, slope), 0.4, 37.0
    b = segment.half_chord
    rate = 1j * k * U / b
    P, M = theodorsen_1935(
        (b, a, slope), lag_of_hankel(k), harmonic(-0.01 + 0.002j, 0.03j, rate), U
    )
    q = np.array([0.01 - 0.002j, 0.03j])
    loads = U**2 * single_section(segment).forces(np.array([1j * k]))[0] @ q
    np.testing.assert_allclose(loads, [-P, M], rtol=1e-12)


@pytest.mark.parametrize("model", ["three-segment", "goland", "hale"])
def test_generalized_forces_are_the_work_of_section_loads(model):
    """Qhat of a folded wing from its modes' motion at 400 stations per segment."""
    wing = AeroelasticWing(read_model(model))
    modes = wing.modes()
    nodes, weights = np.polynomial.legendre.leggauss(400)
    found = wing.aerodynamic_model(modes).forces(GENERAL)
    exact = np.zeros_like(found)
    rho = wing.wing.air.density / RHO
    for index, s in enumerate(wing.wing.segments):
        y, weight = (nodes + 1) * s.span / 2, weights * s.span / 2
        plunge, twist = modes.section_motion(index, y)
        section = s.half_chord, s.axis_offset, s.lift_slope
        for number, p in enumerate(GENERAL):
            C = kv(1, p) / (kv(0, p) + kv(1, p))
            exact[number] += rho * direct_forces(section, C, p, plunge, twist, weight)
    np.testing.assert_allclose(found, exact, atol=1e-9 * np.abs(exact).max())


def unlike_chords():
    """A wing of two segments, the outboard one 0.4 as wide."""
    inner = section_segment(0.0, 2 * np.pi, span=0.2, chord=0.1)
    outer = section_segment(0.2, 4.4, span=0.1, chord=0.04)
    return Wing(segments=(inner, outer), hinges=(Hinge(stiffness=0.5),))


def test_segments_of_other_chord_see_their_own_reduced_frequency():
    """Where only the outer segment moves, the loads lag by C(p b_2 / b_1), not by C(p)."""
    wing = AeroelasticWing(unlike_chords())
    modes = wing.modes((0.4,))
    model = wing.aerodynamic_model(modes)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    b = wing.wing.segments[0].half_chord
    found = model.forces(GENERAL)
    wrong, exact = np.zeros((2, *found.shape), complex)
    rho = wing.wing.air.density / RHO
    for index, s in enumerate(wing.wing.segments):
        motion = modes.section_motion(index, (nodes + 1) * s.span / 2)
        section = s.half_chord, s.axis_offset, s.lift_slope
        for number, p in enumerate(GENERAL):
            own = p * s.half_chord / b
            for total, z in ((exact, own), (wrong, p)):
                C = kv(1, z) / (kv(0, z) + kv(1, z))
                weight = rho * weights * s.span / 2
                total[number] += direct_forces(section, C, own, *motion, weight)
    size = np.abs(exact).max()
    assert model.half_chord == b
    np.testing.assert_allclose(found, exact, atol=1e-11 * size)
    assert np.abs(wrong - exact).max() > 1e-3 * size


@pytest.mark.parametrize("lag", [True, False], ids=["strip", "quasi-steady"])
@pytest.mark.parametrize("direction", [1.0, 1j])
def test_derivative_equals_finite_differences(lag, direction):
    """dQ/dp by sixth-order differences along both axes: right, and analytic in p."""
    name = "strip" if lag else "quasi-steady"
    wing = AeroelasticWing(unlike_chords(), name)
    model = wing.aerodynamic_model(wing.modes((0.4,)))
    step = 2e-4 * direction
    difference = sum(
        weight * (model.forces(GENERAL + n * step) - model.forces(GENERAL - n * step))
        for n, weight in ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60))
    )
    value, derivative = model.forces_with_derivative(GENERAL)
    np.testing.assert_array_equal(value, model.forces(GENERAL))
    size = np.abs(derivative).max()
    np.testing.assert_allclose(difference / step, derivative, atol=1e-8 * size)


@pytest.mark.parametrize(("a", "slope"), SECTIONS)
def test_steady_forces_are_those_of_an_inclined_plate(a, slope):
    """Lift c rho U^2 b alpha at the quarter chord, none from plunge; the limit of Qhat at p = 0."""
    segment = section_segment(a, slope)
    model = single_section(segment)
    b = segment.half_chord
    lift = slope * RHO * b
    exact = np.array([[0.0, lift], [0.0, lift * b * (0.5 + a)]])
    np.testing.assert_allclose(model.steady_forces(), exact, atol=1e-15)
    slow = model.forces(np.array([1e-9 + 0j]))[0]
    np.testing.assert_allclose(slow, exact, atol=1e-7 * lift)


@pytest.mark.parametrize(("a", "slope"), SECTIONS)
def test_quasi_steady_forces_follow_the_three_quarter_chord_incidence(a, slope):
    """Without lag and apparent mass: lift of the incidence at 3/4 chord, at the quarter chord."""
    segment = section_segment(a, slope)
    b = segment.half_chord
    p = np.array([0.3 + 0.7j])
    rate = p[0] / b
    incidence = np.array([-rate, 1 + b * (0.5 - a) * rate])
    lift = slope * RHO * b * incidence
    exact = np.stack([lift, lift * b * (0.5 + a)])
    found = single_section(segment, lag=False)
    np.testing.assert_allclose(found.forces(p)[0], exact, rtol=1e-13)
    assert not found.has_apparent_mass
    assert np.all(found.apparent_mass() == 0.0)


def test_lag_and_apparent_mass_vanish_at_low_frequency():
    """Strip and quasi-steady forces of plunge and pitch agree to first order in p log p."""
    segment = section_segment(-0.2, 2 * np.pi)
    unsteady, quasi = single_section(segment), single_section(segment, lag=False)
    for k in (1e-3, 1e-5):
        p = np.array([1j * k])
        difference = np.abs(unsteady.forces(p) - quasi.forces(p)).max()
        assert difference < 3 * k * abs(np.log(k)) * np.abs(quasi.forces(p)).max()


@pytest.mark.parametrize("a", [-0.5, 0.0, 0.3])
def test_apparent_mass_is_that_of_a_plate_in_still_air(a):
    """pi rho b^2 at mid-chord and pi rho b^4 / 8 about it, moved to the elastic axis."""
    segment = section_segment(a, 2 * np.pi)
    b = segment.half_chord
    mid_chord = np.pi * RHO * b**2 * np.diag([1.0, b**2 / 8])
    to_axis = np.array([[1.0, a * b], [0.0, 1.0]])  # mid-chord is a b ahead: w = h + a b phi
    model = single_section(segment)
    np.testing.assert_allclose(model.apparent_mass(), to_axis.T @ mid_chord @ to_axis, rtol=1e-13)
    p = np.array([1e6j])
    inertial = -model.forces(p)[0] * b**2 / p[0] ** 2
    np.testing.assert_allclose(inertial, model.apparent_mass(), atol=1e-4 * np.pi * RHO * b**2)


@pytest.mark.parametrize("model", ["three-segment", "goland"])
def test_apparent_mass_of_a_wing_is_symmetric_and_positive(model):
    """Moving air has kinetic energy: symmetric, all eigenvalues above zero, none lost to modes."""
    wing = AeroelasticWing(read_model(model))
    apparent = wing.aerodynamic_model(wing.modes()).apparent_mass()
    np.testing.assert_allclose(apparent, apparent.T, atol=1e-12 * np.abs(apparent).max())
    assert np.linalg.eigvalsh(apparent).min() > 0


def typical_section_system(section, half_chord):
    """The section's two structural modes in foldwing's strip theory; frequencies in omega_1.

    Of one metre of span with m b^2 = 1. The section measures plunge in half chords, down.
    """
    b = half_chord
    from_up = np.diag([-1 / b, 1.0])
    M, K = (from_up.T @ A @ from_up for A in (section.mass, section.stiffness))
    values, shapes = scipy.linalg.eigh(K, M)
    segment = section_segment(section.a, 2 * np.pi, chord=2 * b)
    density = section.inverse_mass_ratio / (np.pi * b**4)
    plunge, twist = np.array([[1.0, 0.0]]), np.array([[0.0, 1.0]])
    forces = strip_forces(segment, density, np.ones(1), plunge, twist)
    return AeroelasticSystem(np.sqrt(values), strip_model([forces], [shapes], b, True))


@pytest.mark.parametrize("half_chord", [1.0, 0.25])
@pytest.mark.parametrize(
    "section",
    [
        TypicalSection(),
        TypicalSection(a=0.0, e=0.0, inverse_mass_ratio=0.1, inverse_inertia=1.0),
        TypicalSection(a=-0.3, e=0.25, pitch_frequency=1.7),
    ],
    ids=["hodges-pierce", "uncoupled", "other"],
)
def test_rigid_wing_on_springs_is_the_typical_section(section, half_chord):
    """Same roots as the section written in Theodorsen's signs: det T of both vanish together,
    and flutter and divergence agree to 1e-9."""
    system = typical_section_system(section, half_chord)
    reference = find_flutter(section, (0.2, 12.0)).points
    found = find_flutter(system, (0.2 * half_chord, 12.0 * half_chord)).points
    assert len(found) == len(reference) > 0
    for ours, theirs in zip(found, reference, strict=True):
        assert (ours.kind, ours.event) == (theirs.kind, theirs.event)
        assert ours.speed / half_chord == pytest.approx(theirs.speed, rel=1e-9)
        assert ours.p == pytest.approx(theirs.p, abs=1e-9)


def test_rigid_wing_on_springs_has_its_closed_form_divergence():
    """U / (b omega_theta) = sqrt(m r^2 / (2 pi rho b^2 (1/2 + a))), 2.828427 for Hodges and
    Pierce's section, by the forces of a wing."""
    section = TypicalSection()
    points = find_flutter(typical_section_system(section, 0.5), (0.1, 6.0)).points
    (divergence,) = (point for point in points if point.kind == "divergence")
    speed = divergence.speed / 0.5 / section.pitch_frequency
    assert speed == pytest.approx(np.sqrt(20 * 0.24 / (2 * 0.3)), rel=1e-8)
    assert speed == pytest.approx(2.828427, abs=1e-6)


def test_singular_at_flutter_only():
    """T built from this strip theory is singular at the flutter point and nowhere near it."""
    system = typical_section_system(TypicalSection(), 1.0)
    point = find_flutter(system, (0.2, 12.0)).critical
    at = evaluate(system, np.array([point.p] * 2), np.array([1.0, 1.05]) * point.speed)
    smallest = np.linalg.svd(at, compute_uv=False)[:, -1]
    assert smallest[0] < 1e-11 < 1e-3 < smallest[1]


@pytest.mark.parametrize(("model", "highest"), [("goland", 400.0), ("hale", 60.0)])
@pytest.mark.parametrize("theory", ["strip", "quasi-steady"])
def test_straight_wing_diverges_at_the_closed_form(model, highest, theory):
    """q_D = (pi / 2 L)^2 GJ / (c e a0), e from the quarter chord to the elastic axis (R. L.
    Bisplinghoff, H. Ashley, R. L. Halfman, Aeroelasticity, 1955, section 8-3), to 1e-7."""
    wing = read_model(model)
    s = wing.segments[0]
    e = (s.elastic_axis - 0.25) * s.chord
    q = (np.pi / (2 * s.span)) ** 2 * s.torsion_stiffness / (s.chord * e * s.lift_slope)
    speed = np.sqrt(2 * q / wing.air.density)
    full = wing.with_analysis(system_modes=20)
    case = solve_case(AeroelasticWing(full, theory), (), (0.1 * highest, highest))
    points = [p for p in case.analysis.points if (p.kind, p.event) == ("divergence", "onset")]
    assert [point.speed for point in points] == [pytest.approx(speed, rel=1e-7)]


def test_halves_of_a_section_act_as_the_whole():
    """Forces add over segments: two halves of the span, kept apart, give those of the whole."""
    segment = section_segment(0.1, 2 * np.pi)
    (half,) = single_section(segment, span=0.5).segments
    halves = StripModel(segment.half_chord, (half, half))
    whole = single_section(segment)
    np.testing.assert_allclose(halves.forces(GENERAL), whole.forces(GENERAL), rtol=1e-13)
