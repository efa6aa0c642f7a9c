"""Roots followed in airspeed: from still air, through close approaches, on to the real axis.

Evidence: singular values of T, certified spectra of a region of p at single airspeeds, sections
whose roots are known one by one, and sign changes of the real determinant.
"""

import numpy as np
import pytest
import scipy.linalg
from scipy.optimize import linear_sum_assignment

from foldwing.stability.domains import Rectangle
from foldwing.stability.flutter import find_flutter
from foldwing.stability.loci import root_loci
from foldwing.stability.newton import polish_roots
from foldwing.stability.problem import evaluate
from foldwing.stability.real_axis import births, mergers, real_axis_path, real_roots
from foldwing.stability.spectrum import spectrum_at_speed
from foldwing.stability.status import Status
from foldwing.stability.still_air import still_air_roots
from foldwing.stability.tracking import (
    Branches,
    _collapsed,
    branches_at,
    record,
    track,
)
from support.stability import determinant, exact_root, example
from support.typical_section import ManySections, TypicalSection

SECTION = TypicalSection()
WING = ("three-segment", 30, -60)
TOPS = {"three-segment": 93.0, "goland": 760.0, "hale": 120.0}
EXAMPLES = [WING, ("three-segment", 85, -85), ("goland",), ("hale",)]


def reduced(loci, problem):
    """Return p = lambda b / U, shape (u, r)."""
    return loci.eigenvalue * problem.half_chord / loci.speed[:, None]


def sharpness(problem, p, speed):
    """Smallest over largest singular value of T, and how much larger it is a little aside."""
    at, beside = (
        np.linalg.svd(evaluate(problem, np.array([z]), np.array([speed]))[0], compute_uv=False)
        for z in (p, p * (1 + 1e-5))
    )
    return at[-1] / at[0], at[-1] / beside[-1]


@pytest.mark.parametrize("case", EXAMPLES)
def test_tracked_roots_make_t_singular(case):
    problem = example(*case)
    loci = track(problem, np.linspace(0.0, TOPS[case[0]], 24)[1:])
    p = reduced(loci, problem)
    rows, columns = np.nonzero(loci.status == Status.OK)
    assert len(rows) > 200
    for i, j in zip(rows, columns, strict=True):
        size, contrast = sharpness(problem, p[i, j], loci.speed[i])
        assert size < 1e-13
        assert contrast < 1e-3
    assert np.all(loci.residual[rows, columns] < 1e-12)
    assert np.all(np.isnan(loci.eigenvalue[loci.status != Status.OK]))


def test_branches_start_at_the_roots_in_still_air():
    loci = track(SECTION, np.array([0.0, 1e-3, 1e-2]))
    mass = SECTION.mass + SECTION.apparent_mass
    omega = np.sqrt(scipy.linalg.eigvalsh(SECTION.stiffness, mass))
    np.testing.assert_allclose(loci.eigenvalue[0], 1j * omega, rtol=1e-12)
    approach = np.abs(loci.eigenvalue[1:] - 1j * omega)
    assert np.all(approach < 0.2 * loci.speed[1:, None])
    assert loci.mode.tolist() == [0, 1]
    assert still_air_roots(SECTION).mode.tolist() == [0, 1]


def test_branches_are_named_after_the_modes_they_start_from():
    """Uncoupled modes in any order: each branch carries the number of its coordinate."""
    problem = example("hale")
    start = still_air_roots(problem)
    assert sorted(start.mode.tolist()) == list(range(12))
    np.testing.assert_array_equal(np.abs(start.vectors).argmax(axis=1), start.mode)


REGION = Rectangle((-0.3, 0.4), (0.004, 0.8))


@pytest.mark.parametrize(
    ("problem", "speeds"),
    [
        (SECTION, [1.5, 4.0, 5.46, 7.0, 10.0, 18.0]),
        (TypicalSection(damping_ratio=0.02), [1.5, 5.0, 12.0]),
        (example(*WING), [9.0, 20.0, 28.5, 31.0, 45.0, 60.0, 85.0]),
        (example("goland"), [90.0, 140.0, 460.0]),
    ],
)
def test_loci_are_all_the_roots_of_a_region(problem, speeds):
    top = speeds[-1]
    sweep = find_flutter(problem, (top / 50, top)).sweep
    loci = root_loci(problem, np.union1d(np.linspace(0.0, top, 40)[1:], speeds), sweep)
    for speed in speeds:
        spectrum = spectrum_at_speed(problem, speed, REGION)
        assert spectrum.certified
        own = loci.eigenvalue[np.flatnonzero(loci.speed == speed)[0]]
        own = own[np.isfinite(own) & REGION.contains(own * problem.half_chord / speed)]
        assert len(own) == spectrum.count
        distance = np.abs(own[:, None] - spectrum.eigenvalues) / np.abs(own)[:, None]
        assert distance[linear_sum_assignment(distance)].max(initial=0.0) < 1e-9


@pytest.mark.parametrize("case", EXAMPLES)
def test_no_two_branches_fall_together(case):
    problem = example(*case)
    loci = track(problem, np.linspace(0.0, TOPS[case[0]], 60)[1:])
    assert set(np.unique(loci.status)) <= {Status.OK, Status.LEFT_DOMAIN}
    for values in loci.eigenvalue:
        own = values[np.isfinite(values)]
        apart = np.abs(own[:, None] - own) + np.eye(len(own)) * 1e9
        assert apart.min() > 1e-3


def neighbours(apart):
    """Two sections side by side whose roots differ by little at every airspeed."""
    return SECTION, TypicalSection(pitch_frequency=SECTION.pitch_frequency * (1 + apart))


# a light and a heavy section whose pitch branches cross in frequency and nearly in growth
CROSSING = (
    TypicalSection(pitch_frequency=2.5),
    TypicalSection(pitch_frequency=2.42, inverse_mass_ratio=1 / 60, e=0.02),
)


@pytest.mark.parametrize("sections", [neighbours(1e-2), neighbours(1e-4), CROSSING])
def test_close_roots_keep_to_their_own_section(sections):
    """Uncoupled in hidden coordinates: the loci are those of each section by itself."""
    speeds = np.linspace(0.0, 12.0, 49)[1:]
    loci = track(ManySections(sections), speeds)
    alone = np.hstack([track(section, speeds).eigenvalue for section in sections])
    assert np.all(loci.status == Status.OK)
    distance = np.abs(loci.eigenvalue[:, :, None] - alone[:, None, :]).max(axis=0)
    rows, columns = linear_sum_assignment(distance)
    assert distance[rows, columns].max() < 1e-9
    closest = np.abs(alone[:, 0] - alone[:, 2]).min(), np.abs(alone[:, 1] - alone[:, 3]).min()
    assert min(closest) < 0.1


@pytest.mark.parametrize(
    ("problem", "top"),
    [
        *((example(*case), TOPS[case[0]]) for case in EXAMPLES),
        (ManySections(neighbours(1e-4)), 12.0),
        (ManySections(CROSSING), 12.0),
    ],
)
def test_steps_are_as_small_as_they_need_to_be(problem, top):
    """Asked for the highest airspeed only, the branches are those of many small steps."""
    once = track(problem, np.array([top]))
    often = track(problem, np.linspace(0.0, top, 200)[1:])
    np.testing.assert_array_equal(once.status[0], often.status[-1])
    np.testing.assert_allclose(once.eigenvalue[0], often.eigenvalue[-1], rtol=1e-8)


def test_two_branches_on_one_root_are_noticed():
    """Identical sections have double roots; the second branch is not one of its own."""
    root = polish_roots(SECTION, np.array([0.3j]), np.array([5.0]))
    one = branches_at(SECTION, root)
    two = Branches(**{name: np.concatenate([v, v]) for name, v in vars(one).items()})
    assert _collapsed(two).tolist() == [0, 1]
    loci = record(SECTION, two, np.array([5.2, 5.4]))
    assert np.all(loci.status == Status.COLLAPSED)


@pytest.mark.parametrize(
    ("case", "branch", "before", "after"), [(WING, 1, 53.5, 53.53), (("hale",), 2, 76.5, 77.0)]
)
def test_a_branch_ends_where_its_root_becomes_real(case, branch, before, after):
    """The pair splits into two real roots: T has one oscillating root less, two real ones more."""
    problem, top = example(*case), TOPS[case[0]]
    speeds = np.union1d(np.linspace(0.0, top, 60)[1:], [before, after])
    loci = track(problem, speeds)
    assert speeds[loci.status[:, branch] == Status.LEFT_DOMAIN].tolist() == [
        U for U in speeds if U >= after
    ]
    assert np.all(np.delete(loci.status, branch, axis=1) == Status.OK)
    last = loci.eigenvalue[speeds == before, branch][0] * problem.half_chord / before
    assert abs(last.imag) < 0.2 * abs(last)
    around = Rectangle((0.7 * last.real, 1.3 * last.real), (last.imag / 3, 3 * last.imag))
    spectra = [spectrum_at_speed(problem, U, around) for U in (before, after)]
    assert [spectrum.count for spectrum in spectra] == [1, 0]
    assert all(spectrum.certified for spectrum in spectra)
    assert real_sign_changes(problem, after) == real_sign_changes(problem, before) + 2


def real_sign_changes(problem, speed):
    """Number of real positive roots, as sign changes of the real determinant."""
    p = np.geomspace(1e-7, 1.5, 20000)
    T = evaluate(problem, p + 0j, np.full(len(p), speed)).real
    return int(np.count_nonzero(np.diff(np.linalg.slogdet(T)[0])))


@pytest.mark.parametrize("case", EXAMPLES)
def test_loci_of_the_examples_are_certified(case):
    problem, top = example(*case), TOPS[case[0]]
    analysis = find_flutter(problem, (top / 150, top))
    loci = root_loci(problem, np.linspace(0.0, top, 61), analysis.sweep)
    assert loci.certified.shape == (61,)
    assert loci.certified.all()
    unstable = np.sum((loci.eigenvalue.real > 0) * np.where(loci.eigenvalue.imag == 0, 1, 2), 1)
    assert unstable.max() >= 3


def test_loci_that_lack_a_root_are_not_certified(monkeypatch):
    problem = example("goland")
    analysis = find_flutter(problem, (5.0, 300.0))
    speeds = np.array([100.0, 200.0, 290.0])  # 0, 2 and 3 unstable roots
    assert root_loci(problem, speeds, analysis.sweep).certified.all()
    none = [
        roots.take(np.array([], int))
        for roots in real_roots(problem, real_axis_path(problem, 300.0), speeds)
    ]
    monkeypatch.setattr("foldwing.stability.loci.real_roots", lambda *_: none)
    assert root_loci(problem, speeds, analysis.sweep).certified.tolist() == [True, True, False]


@pytest.mark.parametrize("case", [(SECTION, 7.0710678, 20.0), (example("goland"), 252.66, 500.0)])
def test_real_roots_grow_out_of_divergence(case):
    problem, divergence, top = case
    exact = find_flutter(problem, (top / 100, top))
    at = next(point.speed for point in exact.points if point.kind == "divergence")
    assert at == pytest.approx(divergence, rel=1e-4)
    speeds = at * np.concatenate([[0.5, 0.999], 1 + np.geomspace(1e-4, 0.5, 40)])
    found = real_roots(problem, real_axis_path(problem, top), speeds)
    assert [len(roots.p) for roots in found] == [0, 0] + [1] * 40
    p = np.array([roots.p[0].real for roots in found[2:]])
    assert np.all(np.diff(p) > 0)
    assert p[0] < 2e-3
    # continuous: no step is larger than what the step in airspeed makes of it
    assert np.all(p[1:] / p[:-1] < 1.8 * (speeds[3:] - at) / (speeds[2:-1] - at))
    for z, U in zip(p[::8], speeds[2::8], strict=True):
        below, above = (determinant(problem, z * f, U).real for f in (1 - 1e-6, 1 + 1e-6))
        assert below * above < 0


def double_roots():
    """Every merger and birth of the examples below their highest airspeeds."""
    for case in EXAMPLES:
        problem, top = example(*case), TOPS[case[0]]
        path, limits = real_axis_path(problem, top), (top / 150, top)
        for event, roots in (("merger", mergers), ("birth", births)):
            double = roots(problem, path, limits)
            for i in range(len(double.p)):
                yield pytest.param(problem, event, double.take(np.array([i])), id=f"{event} {case}")


@pytest.mark.parametrize(("problem", "event", "double"), list(double_roots()))
def test_double_real_roots(problem, event, double):
    """T x = 0 and y^T dT/dp x = 0: on one side in airspeed two real roots, a pair on the other."""
    p, U, h = double.p[0].real, double.speed[0], 1e-6
    x, y = double.right[0], double.left[0]

    def T(z):
        return evaluate(problem, np.array([z], complex), np.array([U]))[0]

    T_p = (T(p + h) - T(p - h)) / (2 * h)
    assert np.linalg.norm(T(p) @ x) < 1e-12 * np.linalg.norm(T(p))
    assert np.linalg.norm(y @ T(p)) < 1e-12 * np.linalg.norm(T(p))
    assert abs(y @ T_p @ x) < 1e-5 * np.linalg.norm(y @ T_p)
    lower, higher = U * (1 - 1e-5), U * (1 + 1e-5)
    change = real_count_near(problem, p, higher) - real_count_near(problem, p, lower)
    assert change == {"merger": 2, "birth": -2}[event]
    pair = exact_root(problem, p * (1 + 5e-3j), lower if event == "merger" else higher)
    assert abs(pair / p - 1) < 0.1
    assert abs(pair.imag) > 1e-4 * p
    assert sharpness(problem, pair, lower if event == "merger" else higher)[0] < 1e-12


def real_count_near(problem, p, speed):
    z = p * np.linspace(0.9, 1.1, 4001)
    phase = np.linalg.slogdet(evaluate(problem, z + 0j, np.full(len(z), speed)).real)[0]
    return int(np.count_nonzero(np.diff(phase)))


def test_double_roots_occur():
    kinds = [case.values[1] for case in double_roots()]
    assert kinds.count("merger") == 2
    assert kinds.count("birth") == 2


def test_a_pair_born_of_real_roots_is_followed():
    """The three-segment wing recovers at 79.95 m/s on a pair that does not come from rest."""
    problem = example(*WING)
    analysis = find_flutter(problem, (0.62, 93.0))
    loci = root_loci(problem, np.linspace(0.0, 93.0, 94), analysis.sweep)
    born = next(
        j
        for j in np.flatnonzero(loci.mode < 0)
        if np.nanmax(np.abs(loci.eigenvalue[:, j].imag)) > 0
    )
    values = loci.eigenvalue[:, born]
    alive = np.flatnonzero(np.isfinite(values))
    assert 53.553 < loci.speed[alive[0]] < 55.0
    assert alive.tolist() == list(range(alive[0], 94))
    crossing = np.flatnonzero(np.diff(np.sign(values[alive].real)))
    assert loci.speed[alive[crossing]].tolist() == [79.0]
