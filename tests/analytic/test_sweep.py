"""All flutter points of all airspeeds from one sweep, and the certificate that none is missing.

Evidence: the printed flutter speed of a typical section, problems whose roots are those of scalar
polynomials, roots of det T by the secant method, and a plain argument principle at each airspeed.
"""

import numpy as np
import pytest

from foldwing.stability import sweep as sweep_module
from foldwing.stability.certificate import count_unstable
from foldwing.stability.crossings import divergence_speeds
from foldwing.stability.domains import Rectangle
from foldwing.stability.flutter import find_flutter
from foldwing.stability.path import follow_path
from foldwing.stability.problem import evaluate
from foldwing.stability.region import Region
from foldwing.stability.rootfinding import count_roots
from foldwing.stability.spectrum import at_speed
from foldwing.stability.sweep import sweep, sweep_region
from support.stability import (
    Polynomials,
    UnstableRoots,
    determinant,
    exact_root,
    example,
    of_kind,
    unstable_by,
    with_other_hinges,
)
from support.typical_section import TypicalSection

SIGMA = 0.4  # plunge over pitch frequency: printed speeds are multiples of b omega_theta
SECTION = TypicalSection()
DAMPED = TypicalSection(damping_ratio=0.02)
RANGE = (0.3, 20.0)
WINGS = [("three-segment", 30, -60), ("three-segment", 85, -85), ("goland",), ("hale",)]
TOP = {"three-segment": 93.0, "goland": 760.0, "hale": 120.0}


def wing(name, *folds):
    """System of a shipped wing and the airspeeds in which it is searched."""
    return example(name, *folds), (TOP[name] / 150, TOP[name])


def events(analysis):
    return [(point.kind, point.event) for point in analysis.points]


def fitted_speeds(speed_range, points, count):
    """Airspeeds over a range that keep clear of the points, where a count is not defined."""
    speeds = np.geomspace(*speed_range, count)
    known = np.array([point.speed for point in points])
    return [U for U in speeds if np.abs(known / U - 1.0).min(initial=1.0) > 1e-3]


def test_printed_flutter_and_divergence_of_the_typical_section():
    analysis = find_flutter(SECTION, RANGE)
    assert events(analysis) == [("flutter", "onset"), ("divergence", "onset")]
    flutter, divergence = analysis.points
    assert flutter.speed * SIGMA == pytest.approx(2.183915, abs=5e-7)
    assert flutter.p.imag * flutter.speed * SIGMA == pytest.approx(0.648984, abs=5e-7)
    assert 2 * np.pi * flutter.frequency * SIGMA == pytest.approx(0.648984, abs=5e-7)
    assert divergence.speed * SIGMA == pytest.approx(2.828427, abs=5e-7)
    assert (divergence.p, divergence.frequency) == (0, 0)
    assert analysis.critical is flutter
    assert analysis.certified


@pytest.mark.parametrize(
    ("section", "threshold", "expected"),
    [
        (SECTION, 0.0, ["onset"]),
        (SECTION, 0.02, ["recovery", "recovery", "onset"]),  # at rest both modes have no damping
        (SECTION, -0.02, ["onset"]),
        (DAMPED, 0.0, ["onset"]),
        (DAMPED, 0.05, ["recovery", "recovery", "onset"]),
        (DAMPED, -0.02, ["onset"]),
    ],
)
def test_each_point_is_a_root_that_crosses_the_threshold(section, threshold, expected):
    analysis = find_flutter(section, RANGE, threshold)
    points = of_kind(analysis, "flutter")
    assert [point.event for point in points] == expected
    assert analysis.certified
    for point in points:
        root = exact_root(section, point.p, point.speed)
        assert root == pytest.approx(point.p, rel=1e-10)
        assert -point.p.real / point.p.imag == pytest.approx(threshold, abs=1e-14)
        slow, fast = (
            exact_root(section, point.p, point.speed * factor) for factor in (1 - 1e-4, 1 + 1e-4)
        )
        slope = (fast.real / fast.imag - slow.real / slow.imag) / (2e-4 * point.speed)
        assert point.strength == pytest.approx(slope, rel=1e-5)
        assert (point.strength > 0) == (point.event == "onset")


def test_structural_damping_and_lower_thresholds_delay_flutter():
    def onset(section, threshold=0.0):
        points = of_kind(find_flutter(section, RANGE, threshold), "flutter")
        return points[-1].speed

    assert onset(SECTION, 0.02) < onset(SECTION) < onset(SECTION, -0.02)
    assert onset(SECTION) < onset(DAMPED) < onset(TypicalSection(damping_ratio=0.04))


@pytest.mark.parametrize("case", WINGS)
def test_points_are_exact(case):
    """At every point T is singular to round-off, and nowhere near it is it."""
    problem, speed_range = wing(*case)
    for point in find_flutter(problem, speed_range).points:
        p, U = np.array([point.p or 1e-10]), np.array([point.speed])
        s = np.linalg.svd(evaluate(problem, p, U)[0], compute_uv=False)
        beside = np.linalg.svd(evaluate(problem, p, U * (1 + 1e-6))[0], compute_uv=False)
        assert s[-1] < 1e-13 * s[0]
        assert point.event == "merger" or s[-1] < 1e-5 * beside[-1]
        Tx = evaluate(problem, p, U)[0] @ point.vector
        assert np.linalg.norm(Tx) < 1e-13 * s[0]
        assert point.residual < 1e-14


@pytest.mark.parametrize("threshold", [0.0, 0.02, -0.02])
@pytest.mark.parametrize("case", [(SECTION,), (DAMPED,), *WINGS])
def test_counts_against_a_plain_argument_principle(case, threshold):
    problem, speed_range = (
        (case[0], RANGE) if len(case) == 1 and not isinstance(case[0], str) else wing(*case)
    )
    analysis = find_flutter(problem, speed_range, threshold)
    speeds = fitted_speeds(speed_range, analysis.points, 24)
    plain = UnstableRoots(problem, analysis.sweep.region.highest * 1.3, threshold)
    exact = [plain.at(U) for U in speeds]
    counted = count_unstable(problem, analysis.sweep.path, analysis.sweep.region, np.array(speeds))
    assert counted.tolist() == exact
    assert [unstable_by(analysis.points, U, exact[0]) for U in speeds] == exact
    assert max(exact) >= 3
    certificate = analysis.certificate
    assert certificate.counted.tolist() == [plain.at(U) for U in certificate.speeds]
    assert certificate.certified


def test_counts_of_right_half_plane_of_the_section():
    """The same counts once more around a closed rectangle, both halves of it."""
    region = Rectangle((1e-6, 3.0), (-4.0, 4.0))
    analysis = find_flutter(SECTION, RANGE)
    for speed, expected in ((1.0, 0), (6.0, 2), (8.0, 3), (19.0, 3)):
        assert count_roots(at_speed(SECTION, speed), region) == expected
        assert unstable_by(analysis.points, speed, 0) == expected


def test_counts_lie_between_all_crossings_and_at_both_ends():
    problem, speed_range = wing("three-segment", 30, -60)
    result = sweep(problem, speed_range)
    edges = result.crossings.speed
    speeds = result.certificate.speeds
    assert (speeds[0], speeds[-1]) == speed_range
    assert np.searchsorted(edges, speeds[1:-1]).tolist() == list(range(len(edges) + 1))


OSCILLATORS = Polynomials(
    # onset at 5/4; recovery at 4; no crossing; divergence at 5
    ((0.1, -0.04, 1.0), (0.3, 0.02, 0.5), (0.2, 0.01, 0.3), (-0.04, 0.5, 1.0)),
    (0.05, -0.08, 0.02, 0.1),
)


def test_oscillators_with_exact_crossings():
    """1 + U g p + U^2 (d + c p + m p^2) = 0: at U = -g/c, k^2 = (d + 1/U^2)/m; at U^2 = -1/d."""
    analysis = find_flutter(OSCILLATORS, (0.5, 20.0))
    expected = [("flutter", "onset"), ("flutter", "recovery"), ("divergence", "onset")]
    assert events(analysis) == expected
    speeds = [point.speed for point in analysis.points]
    np.testing.assert_allclose(speeds[:2], [1.25, 4.0], rtol=1e-12)
    assert speeds[2] == pytest.approx(5.0, rel=1e-8)
    k = [point.p.imag for point in analysis.points]
    np.testing.assert_allclose(k, [(0.1 + 0.64) ** 0.5, (0.725) ** 0.5, 0.0], rtol=1e-12)
    assert analysis.certified
    counts = count_unstable(
        OSCILLATORS, analysis.sweep.path, analysis.sweep.region, np.array([0.6, 1.2, 2.0, 4.5, 9.0])
    )
    assert counts.tolist() == [2, 2, 4, 2, 3]


@pytest.mark.parametrize("threshold", [0.0, 0.03, -0.05])
def test_path_runs_around_the_region(threshold):
    region = Region(threshold, 0.004, 30.0)
    t = region.parameter()
    p = region.point(t)
    assert np.all(np.diff(t) > 0)
    assert (p[0].imag, p[-1].imag) == (0.0, 0.0)
    assert 0 < p[0].real < 1e-9 < 1.5 <= p[-1].real
    damping = -p.real / np.maximum(p.imag, 1e-300)
    assert np.all((damping[1:-1] < threshold + 1e-12) & (p.imag[1:-1] > 0))
    along = np.abs(damping - threshold) < 1e-12
    np.testing.assert_allclose(p[along].imag.max(), 30.0)
    assert np.all(np.abs(np.diff(p[along])) < 0.7 * np.abs(p[along][1:]) + 1e-2)
    fine = region.point(np.linspace(t[0], t[-1], 20001))
    assert np.abs(np.diff(fine)).max() < 0.05  # without a gap


@pytest.mark.parametrize("threshold", [0.0, 0.05, -0.05])
def test_region_counts_a_function_with_known_roots(threshold):
    """A path alone, refined from coarse: the count is that of the polynomial's roots inside."""
    problem = Polynomials(((0.2, -0.3, 1.1, -0.4, 0.7), (-0.1, 0.02, 1.0), (0.4, -0.01, 0.8)))
    region = Region(threshold, 0.01, 20.0, density=2.0)
    path = follow_path(problem, region.point, region.parameter(), 20.0)
    speeds = np.array([0.6, 1.0, 2.0, 5.0, 15.0])
    exact = []
    for U in speeds:
        z = problem.roots(U)
        beyond = z.real + threshold * np.abs(z.imag) > 0
        exact.append(int(np.count_nonzero(beyond & (np.abs(z.imag) < 20) & (z.real < 1.5))))
    assert count_unstable(problem, path, region, speeds).tolist() == exact
    assert len(set(exact)) > 1


def test_root_on_the_contour_is_not_counted():
    """At a flutter speed a root lies on the contour: the count must not settle."""
    analysis = find_flutter(SECTION, RANGE)
    at = np.array([point.speed for point in of_kind(analysis, "flutter")])
    counted = count_unstable(SECTION, analysis.sweep.path, analysis.sweep.region, at)
    assert counted.tolist() == [-1]


@pytest.mark.parametrize("threshold", [0.0, 0.02])
@pytest.mark.parametrize("case", WINGS)
def test_swept_frequencies_hold_every_root(case, threshold):
    problem, (slow, fast) = wing(*case)
    region = sweep_region(problem, (slow, fast), threshold)
    b, omega = problem.half_chord, problem.omega
    assert region.highest > omega[-1] * b / slow
    assert region.lowest <= min(0.004, omega[0] * b / fast)
    for point in of_kind(find_flutter(problem, (slow, fast), threshold), "flutter"):
        assert region.lowest < point.p.imag < region.highest


def test_highest_frequency_can_be_chosen():
    """The second flutter point of the Goland wing has k = 0.65, the first 0.47."""
    problem, speed_range = wing("goland")
    flutter = sweep(problem, speed_range, highest=0.6)
    k = flutter.crossings.roots.p.imag[~flutter.crossings.divergence]
    assert len(k) == 1
    assert k[0] == pytest.approx(0.4668, abs=1e-4)
    assert flutter.region.highest == 0.6


@pytest.mark.parametrize("case", [(SECTION, RANGE), (DAMPED, RANGE), wing("goland"), wing("hale")])
def test_divergence_lets_a_real_root_appear(case):
    """Real positive roots are sign changes of the real det T(p)."""
    problem, speed_range = case
    p = np.geomspace(1e-8, 1.5, 3000)

    def real_roots(U):
        phase = np.linalg.slogdet(evaluate(problem, p + 0j, np.full(len(p), U)).real)[0]
        return np.count_nonzero(phase[1:] != phase[:-1])

    analysis = find_flutter(problem, speed_range)
    divergence = of_kind(analysis, "divergence")
    assert any(point.event != "merger" for point in divergence)
    for point in divergence:
        below, above = (real_roots(point.speed * factor) for factor in (0.997, 1.003))
        assert above - below == {"onset": 1, "recovery": -1, "merger": 2}[point.event]


def test_divergence_speeds_are_roots_of_the_static_problem():
    """Without motion det(K - U^2 Qhat(0)) vanishes, in modal coordinates without any scaling."""
    problem, _ = wing("goland")
    K, Q = np.diag(problem.omega**2), problem.aerodynamics.steady_forces()
    values = 1.0 / np.linalg.eigvals(np.linalg.solve(K, Q))
    real = values.real[(np.abs(values.imag) < 1e-8 * np.abs(values)) & (values.real > 0)]
    speeds = divergence_speeds(problem)
    np.testing.assert_allclose(speeds[speeds < 2e3], np.sort(real[real < 4e6]) ** 0.5, rtol=1e-8)


def nearly_touching(apart):
    """A damping that is negative between two reduced frequencies this far apart, and no more."""
    k1, k2 = 0.3, 0.3 * (1 + apart)
    c = 0.5 * np.polynomial.polynomial.polymul([k1**2, 0, 1], [k2**2, 0, 1])
    q = np.array([-0.02, 0, 1, 0, 0, 0]) + np.append(0.0, c)
    return (
        Polynomials((tuple(q), (0.01, 0.05, 1.0))),
        (k1**2 + 0.02) ** -0.5,
        (k2**2 + 0.02) ** -0.5,
    )


@pytest.mark.parametrize("apart", [0.3, 0.1, 0.05, 0.03])
def test_two_nearly_touching_crossings(apart):
    problem, recovery, onset = nearly_touching(apart)
    analysis = find_flutter(problem, (0.5, 30.0))
    flutter = of_kind(analysis, "flutter")
    assert [point.event for point in flutter] == ["onset", "recovery"]
    np.testing.assert_allclose([point.speed for point in flutter], [onset, recovery], rtol=1e-12)
    assert analysis.certified


@pytest.mark.parametrize("apart", [0.01, 0.003, 0.001])
def test_closer_crossings_are_found_or_the_case_is_not_certified(apart):
    problem, recovery, onset = nearly_touching(apart)
    analysis = find_flutter(problem, (0.5, 30.0))
    speeds = np.array([point.speed for point in of_kind(analysis, "flutter")])
    found = [np.abs(speeds / U - 1).min(initial=1.0) < 1e-9 for U in (onset, recovery)]
    assert all(found) or not analysis.certified


def test_a_withheld_crossing_is_noticed(monkeypatch):
    problem, speed_range = wing("three-segment", 30, -60)
    whole = sweep_module.flutter_roots
    assert sweep(problem, speed_range).certificate.certified
    for missing in range(5):

        def without(*arguments, index=missing):
            roots, path = whole(*arguments)
            return roots.take(np.delete(np.arange(len(roots.p)), index)), path

        monkeypatch.setattr(sweep_module, "flutter_roots", without)
        certificate = sweep(problem, speed_range).certificate
        assert not certificate.certified
        assert np.any(certificate.counted != certificate.expected)


def test_a_withheld_pair_is_noticed(monkeypatch):
    """An onset and its recovery cancel in the count between other points; they are missed too."""
    problem, speed_range = wing("three-segment", 30, -60)
    whole = sweep_module.flutter_roots
    for pair in ((0, 1), (1, 2), (2, 4), (3, 4)):

        def without(*arguments, index=pair):
            roots, path = whole(*arguments)
            return roots.take(np.delete(np.arange(len(roots.p)), index)), path

        monkeypatch.setattr(sweep_module, "flutter_roots", without)
        assert not sweep(problem, speed_range).certificate.certified


@pytest.mark.parametrize("beyond", [0.3, 1e-2, 1e-3, 1e-4, 2e-5])
def test_a_hump_is_found_however_narrow(beyond):
    """Just beyond the fold of the boundary onset and recovery are a hair apart, and still two."""
    problem, speed_range = wing("three-segment", 30, -31.4083547 - beyond)
    points = of_kind(find_flutter(problem, speed_range), "flutter")
    assert [point.event for point in points[:2]] == ["onset", "recovery"]
    assert points[0].classification == "hump"
    assert 19.0 < points[0].speed < points[1].speed < 20.8
    assert points[1].speed - points[0].speed == pytest.approx(2.15 * beyond**0.5, rel=0.5)


FREE = [("same", None), (None, "same"), (None, None)]


@pytest.mark.parametrize("hinges", FREE)
def test_a_free_hinge_is_a_neutral_motion_that_stands_apart(hinges):
    system = with_other_hinges("three-segment", hinges, 30, -60)
    free = hinges.count(None)
    assert system.neutral.tolist() == [True] * free + [False] * (system.size - free)
    Q = system.aerodynamics.forces(np.array([1e-9 + 0j]))[0]
    assert np.abs(Q @ system.rotation[:, :free]).max() < 1e-7 * np.abs(Q).max()  # no force at rest
    # T does not vanish with p: the exact zero roots are no longer in it
    small, smaller = (determinant(system, p, 10.0) for p in (1e-6, 1e-7))
    assert smaller / small == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("hinges", FREE)
def test_points_of_a_free_hinge_are_certified(hinges):
    system = with_other_hinges("three-segment", hinges, 30, -60)
    analysis = find_flutter(system, (0.62, 93.0))
    assert analysis.certified
    speeds = fitted_speeds((0.62, 93.0), analysis.points, 14)
    plain = UnstableRoots(system, 2 * analysis.sweep.region.highest)
    exact = [plain.at(U) for U in speeds]
    assert exact[0] == 0
    assert exact == [unstable_by(analysis.points, U, 0) for U in speeds]
    assert max(exact) >= 3


@pytest.mark.parametrize("hinges", FREE)
def test_a_free_hinge_is_the_limit_of_a_soft_one(hinges):
    """The flutter points converge in proportion to the stiffness."""

    def flutter(stiffness):
        new = tuple(stiffness if k is None else k for k in hinges)
        system = with_other_hinges("three-segment", new, 30, -60)
        points = of_kind(find_flutter(system, (0.62, 93.0)), "flutter")
        return np.array([(p.speed, p.frequency) for p in points if p.frequency > 0.5])

    limit = flutter(None)
    assert len(limit) >= 3
    far, near = (np.abs(flutter(k) - limit).max() for k in (1e-5, 1e-6))
    assert near < 1e-3
    assert far / near == pytest.approx(10.0, rel=0.1)
