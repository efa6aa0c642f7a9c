"""Flutter of folded wings by the vortex lattice.

Speeds and frequencies to four digits were found by an independent implementation of the same
equations, with the default mesh; a tolerance of 0.3 % is that of its last printed digits and of
other choices of quadrature.
"""

from functools import cache

import numpy as np
import pytest

from foldwing.aerodynamics import wake
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import read_model
from foldwing.stability.loci import root_loci
from foldwing.stability.status import Status
from foldwing.stability.still_air import still_air_roots
from foldwing.stability.tracking import track
from foldwing.studies.case import solve_case
from foldwing.studies.speeds import speed_range

FOUR_DIGITS = 3e-3


@cache
def wing(damping=0.0, gap=0.0, dropped=(), **lattice):
    """The three-segment wing; everything that does not depend on the fold is shared."""
    model = read_model("three-segment").with_analysis(damping=damping)
    return AeroelasticWing(model.with_gaps(gap).with_lattice(**lattice), "lattice", dropped)


@cache
def solved(folds, highest=70.0, **options):
    """The certified case up to an airspeed."""
    case = solve_case(wing(**options), folds, (1.0, highest))
    assert case.analysis.certified
    return case


def crossings(folds, highest=70.0, **options):
    """Speed, frequency and event of each flutter point below an airspeed."""
    points = solved(folds, highest, **options).analysis.points
    return [(p.speed, p.frequency, p.event) for p in points if p.kind == "flutter"]


def first_onset(folds, **options):
    """Lowest onset of flutter in m/s; infinite when there is none below 70 m/s."""
    return min(
        (U for U, _, event in crossings(folds, **options) if event == "onset"), default=np.inf
    )


def divergence(folds, **options):
    """Lowest divergence speed in m/s."""
    points = solved(folds, **options).analysis.points
    return min(p.speed for p in points if (p.kind, p.event) == ("divergence", "onset"))


UNDAMPED = [
    ((30.0, -75.0), [(18.81, 27.3), (37.50, 17.5), (41.00, 23.4)], 43.38),
    ((30.0, -60.0), [(17.81, 26.1), (35.36, 17.8), (37.17, 22.4)], 41.47),
    ((30.0, 60.0), [(28.24, 14.3)], 48.75),
    ((0.0, 0.0), [(29.55, 35.8)], 36.96),
    ((90.0, -90.0), [(25.68, 11.8)], 61.33),
    ((120.0, -120.0), [(11.98, 14.4)], 65.76),
]

DAMPED = [
    ((30.0, -75.0), [(22.22, 26.5), (37.87, 17.2), (38.98, 23.6)]),
    ((60.0, -60.0), [(24.57, 13.2)]),
    ((75.0, -75.0), [(26.16, 12.0)]),
    ((90.0, -90.0), [(32.70, 11.2)]),
    ((120.0, -120.0), [(21.98, 13.9)]),
]


def check_points(found, expected):
    for (speed, frequency, _), (U, f) in zip(found, expected, strict=True):
        assert speed == pytest.approx(U, rel=FOUR_DIGITS)
        assert frequency == pytest.approx(f, abs=0.06)


@pytest.mark.parametrize(("folds", "expected", "diverging"), UNDAMPED)
def test_undamped_flutter_in_four_digits(folds, expected, diverging):
    check_points([point for point in crossings(folds) if point[0] < 45.0], expected)
    assert divergence(folds) == pytest.approx(diverging, rel=FOUR_DIGITS)


@pytest.mark.parametrize(("folds", "expected"), DAMPED)
def test_damped_flutter_in_four_digits(folds, expected):
    """Structural damping ratio 0.01 of every mode."""
    check_points([p for p in crossings(folds, damping=0.01) if p[0] < 45.0], expected)


def test_hump_ends_after_the_next_mode_has_begun():
    """At (30, -75) the first root recovers at 41 m/s, where a second one is unstable already."""
    points = solved((30.0, -75.0)).analysis.points[:4]
    assert [p.event for p in points] == ["onset", "onset", "recovery", "onset"]
    assert [p.kind for p in points] == ["flutter", "flutter", "flutter", "divergence"]
    assert points[0].branch == points[2].branch != points[1].branch
    assert points[0].classification == "hump"


# ---------------------------------------------- outboard segment level: a mode that comes and goes


def test_level_tip_mode_leaves_near_105_degrees_and_returns_by_120():
    """With one per cent of damping none flutters at 110; what is left at 105 is a trace."""
    onsets = [first_onset((psi, -psi), damping=0.01) for psi in (90.0, 100.0, 110.0, 120.0)]
    assert onsets[0] < onsets[1] < 50.0
    assert onsets[2] == np.inf
    assert onsets[3] < onsets[0]
    (onset, recovery) = crossings((105.0, -105.0), damping=0.01)
    assert 0.0 < recovery[0] - onset[0] < 1.0


def boundary(**options):
    """First onsets of the level tip, from 20 to 145 degrees."""
    angles = np.arange(20.0, 146.0, 5.0)
    return np.array([first_onset((psi, -psi), damping=0.01, **options) for psi in angles])


@pytest.mark.slow
def test_without_the_second_bending_mode_the_boundary_is_smooth():
    """With it the boundary jumps by a half or more from one angle to the next, and is interrupted;
    without it the largest step between neighbours is below 12 %."""
    with_it, without = boundary(), boundary(dropped=("B2",))
    step = np.abs(np.diff(np.log(np.minimum(with_it, 1e6))))
    assert step.max() > np.log(1.5)
    assert np.isinf(with_it).any()
    assert np.isfinite(without).all()
    assert np.abs(np.diff(np.log(without))).max() < np.log(1.12)


def test_left_out_mode_is_gone_and_the_others_keep_their_names():
    case = solved((30.0, -30.0), dropped=("B2", "T3"))
    whole = solved((30.0, -30.0))
    names = [name for name in whole.modes.names if name not in ("B2", "T3")]
    assert list(case.modes.names) == names
    kept = [whole.modes.names.index(name) for name in names]
    np.testing.assert_array_equal(case.modes.omega, whole.modes.omega[kept])


# -------------------------------------------------------------------------------------------- gaps


@pytest.mark.parametrize("psi", [0.0, 30.0, 60.0, 75.0, 90.0, 100.0])
def test_gaps_raise_flutter_and_divergence_speeds(psi):
    folds = (psi, -psi)
    plain, gaps = {"damping": 0.01}, {"damping": 0.01, "gap": 0.001}
    assert first_onset(folds, **gaps) > 1.02 * first_onset(folds, **plain)
    assert divergence(folds, **gaps) > 1.02 * divergence(folds, **plain)


def test_wider_gaps_raise_divergence_speeds_further():
    speeds = [divergence((30.0, -30.0), gap=gap) for gap in (0.0, 1e-4, 1e-3, 5e-3)]
    assert (np.diff(speeds) > 0.0).all()


# ------------------------------------------------------------- what the lattice does not resolve


def test_highest_frequency_is_half_of_where_steps_alias():
    """Motions whose frequencies differ by that of the steps have the same wake: at four times the
    highest frequency it is that of rest, which carries no circulation."""
    model = wing(chordwise=4, spanwise=6, wake=2.0)
    lattice = model.lattice(model.modes((0.0, 0.0)))
    k = lattice.highest_frequency
    shed = [abs(wake.shed(np.array([1j * n * k * lattice.steps[0]]), 8, 0.0)).max() for n in (1, 4)]
    assert shed[0] > 1.0
    assert shed[1] < 1e-12


def test_every_mode_comes_in_at_the_lowest_airspeed_of_validity():
    """Just above it all branches are there; just below the fastest one is not."""
    case = solved((30.0, -30.0), chordwise=4, spanwise=12)
    above, below = 1.02 * case.analysis.valid_from, 0.98 * case.analysis.valid_from
    loci = track(case.system, np.array([below, above]))
    assert np.isnan(loci.eigenvalue[0].real).sum() == 1
    assert np.isfinite(loci.eigenvalue[1].real).all()
    assert set(case.uncertified_modes) == set(case.modes.names) - {"B1"}


def test_finer_panels_resolve_more():
    coarse = solved((30.0, -30.0), chordwise=4, spanwise=12)
    fine = solved((30.0, -30.0), chordwise=12, spanwise=12)
    assert fine.analysis.valid_from < 0.4 * coarse.analysis.valid_from
    assert set(fine.uncertified_modes) < set(coarse.uncertified_modes)


def test_strip_theory_resolves_everything():
    case = solve_case(AeroelasticWing(read_model("three-segment")), (30.0, -30.0), (1.0, 50.0))
    assert case.uncertified_modes == ()
    assert case.analysis.valid_from == 1.0


@pytest.mark.parametrize("length", [10.0, 20.0, 40.0])
@pytest.mark.parametrize("threshold", [0.01, 0.02, 0.05])
def test_damping_threshold_meets_no_root_of_the_wake_s_end(length, threshold):
    """Every point is a structural motion, whatever the length of the wake, and certified."""
    wing_of = read_model("three-segment").with_lattice(wake=length, chordwise=4, spanwise=15)
    damped = wing_of.with_analysis(damping_threshold=threshold, system_modes=6)
    case = solve_case(AeroelasticWing(damped, "lattice"), (30.0, -75.0), (1.0, 60.0))
    assert case.analysis.certified
    assert case.uncertified_modes == ()
    points = [p for p in case.analysis.points if p.kind == "flutter"]
    assert all(p.mode_confidence == 1.0 for p in points)
    assert any(p.event == "onset" and abs(p.speed / 37.0 - 1) < 0.06 for p in points)


def test_threshold_that_no_airspeed_resolves_is_refused():
    damped = read_model("three-segment").with_analysis(damping_threshold=0.2)
    with pytest.raises(
        InputError, match=r"resolves all modes at this threshold only from 1\d\d m/s"
    ):
        solve_case(AeroelasticWing(damped, "lattice"), (30.0, -75.0), (1.0, 60.0))


def test_mode_of_one_fold_may_be_left_out_where_the_flat_wing_has_none():
    """T6 exists at (30, -75) among twelve modes; flat it is B7."""
    model = wing(dropped=("T6",))
    assert speed_range(model) == speed_range(wing())
    assert "T6" not in solve_case(model, (30.0, -75.0), (3.0, 50.0)).modes.names


def test_loci_are_left_out_where_they_are_not_resolved():
    """Each branch begins at its own airspeed; below it there is a status and no number."""
    case = solved((30.0, -75.0))
    speeds = np.array([0.0, 1.0, 5.0, 10.0, 20.0])
    loci = track(case.system, speeds)
    rest = still_air_roots(case.system)
    limit = rest.eigenvalue.imag * 0.025 / case.system.highest_frequency
    for row, speed in enumerate(speeds[1:], start=1):
        shown = np.isfinite(loci.eigenvalue[row].real)
        np.testing.assert_array_equal(shown, speed >= limit)
        assert (loci.status[row, ~shown] == Status.UNRESOLVED).all()
        k = loci.eigenvalue[row, shown].imag * 0.025 / speed
        assert k.max() <= case.system.highest_frequency
    assert np.isfinite(loci.eigenvalue[[0, -1]].real).all()


def test_loci_begin_as_the_motions_at_rest():
    """Where a branch comes in, its root is within 6 % of that in still air."""
    case = solved((30.0, -75.0))
    rest = still_air_roots(case.system)
    limit = np.sort(rest.eigenvalue.imag) * 0.025 / case.system.highest_frequency
    loci = track(case.system, limit * 1.001)
    for branch, value in enumerate(rest.eigenvalue):
        row = int(np.flatnonzero(np.isfinite(loci.eigenvalue[:, branch].real))[0])
        assert abs(loci.eigenvalue[row, branch] / value - 1) < 0.06


def test_loci_pass_through_the_flutter_points():
    case = solved((30.0, -75.0))
    flutter = [p for p in case.analysis.points if p.kind == "flutter" and p.speed < 45.0]
    speeds = np.array([p.speed for p in flutter])
    loci = root_loci(case.system, speeds, case.analysis.sweep)
    assert loci.certified.all()
    for row, point in enumerate(flutter):
        value = point.p * point.speed / case.system.half_chord
        assert np.nanmin(np.abs(loci.eigenvalue[row] / value - 1)) < 1e-8


def test_flutter_points_are_named_by_the_motion_at_rest_they_come_from():
    names = [
        (p.event, solved((30.0, -75.0)).modes.names[p.mode], p.mode_confidence)
        for p in solved((30.0, -75.0)).analysis.points[:3]
    ]
    assert names == [("onset", "T1", 1.0), ("onset", "B2", 1.0), ("recovery", "T1", 1.0)]
