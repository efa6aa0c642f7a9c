"""Where the lowest onset over the torsion frequency changes its curve.

Against routes that know no curves: the equations of both motions at once, on a rigid strip of a
wing made of particles; searches and counts of unstable roots a millionth beside the change.
"""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import scipy.optimize

from foldwing.airfoil.system import SectionSystem
from foldwing.model import Analysis, TypicalSection, read_section
from foldwing.stability.flutter import find_flutter
from foldwing.studies.lowest import divergence_onsets
from foldwing.studies.section import section_family, section_study, section_sweep
from support.sections import RigidStrip
from support.stability import UnstableRoots, of_kind

BESIDE = 1e-6
JUMPING = TypicalSection(
    mass_ratio=20.0,
    inertia_ratio=0.21,
    axis_offset=0.21,
    mass_offset=0.3,
    torsion_frequency_ratio=1.2,
    second_mass_ratio=1.01,
    second_frequency_ratio=1.89,
)
"""Two flutter points come into being together below the divergence speed."""


@cache
def three_dof():
    """The airfoil with a second mass around the torsion frequency where its flutter changes."""
    return section_sweep(read_section("airfoil-3dof"), np.arange(36, 41) / 10)


@cache
def jumping():
    return section_sweep(JUMPING, np.arange(8, 24) / 10)


def system(section, torsion):
    return SectionSystem(section.with_torsion(float(torsion)))


def test_flutter_changes_between_the_printed_torsion_frequencies():
    """I. Wang, PhD dissertation, Duke University, 2013, Appendix B: between 3.7 and 3.8."""
    (change,) = three_dof().changes
    assert change.kind == "crossing"
    assert change.confirmed
    assert 3.7 < change.parameter < 3.8
    assert change.speed[0] == pytest.approx(change.speed[1], rel=1e-9)
    assert change.frequency[1] > 1.5 * change.frequency[0]


def test_crossing_solves_the_equations_of_both_motions_at_once():
    """det T(i omega_1; U) = det T(i omega_2; U) = 0: four real equations for the torsion frequency,
    the airspeed and two frequencies, from a start that is read off the printed grid."""
    (change,) = three_dof().changes
    section = read_section("airfoil-3dof")

    def equations(unknown):
        torsion, speed, *frequencies = unknown
        strip = RigidStrip(section.with_torsion(float(torsion)))
        values = [strip.determinant(omega, speed) for omega in frequencies]
        return [part for value in values for part in (value.real, value.imag)]

    found, _, status, _ = scipy.optimize.fsolve(
        equations, (3.77, 11.5, 2.0, 3.7), xtol=1e-13, full_output=True
    )
    assert status == 1
    ours = (change.parameter, change.speed[0], *change.frequency)
    np.testing.assert_allclose(ours, found, rtol=1e-8)


def test_the_motion_of_the_lowest_onset_changes_within_a_millionth():
    (change,) = three_dof().changes
    section = read_section("airfoil-3dof")
    for factor, frequency in zip((1 - BESIDE, 1 + BESIDE), change.frequency, strict=True):
        analysis = find_flutter(system(section, change.parameter * factor), (0.2, 30.0))
        flutter = of_kind(analysis, "flutter")
        assert len(flutter) == 2
        assert 2 * np.pi * flutter[0].frequency == pytest.approx(frequency, rel=1e-4)


def test_jump_where_two_flutter_points_come_into_being():
    jump = next(change for change in jumping().changes if change.kind == "jump")
    assert jump.confirmed
    assert jump.frequency[0] == 0.0  # divergence is the lowest below
    assert jump.speed[1] < 0.9 * jump.speed[0]
    counts, roots = [], []
    for factor in (1 - BESIDE, 1 + BESIDE):
        problem = system(JUMPING, jump.parameter * factor)
        points = of_kind(find_flutter(problem, (0.1, 2.1)), "flutter")
        counts.append(sorted(point.event for point in points))
        roots.append(UnstableRoots(problem, 40.0).at(jump.speed[1]))
    assert counts == [[], ["onset", "recovery"]]
    assert roots == [0, 2]


def test_jump_ends_at_the_divergence_speed():
    jump = next(change for change in jumping().changes if change.kind == "jump")
    (divergence, *_) = of_kind(
        find_flutter(system(JUMPING, jump.parameter), (0.1, 10.0)), "divergence"
    )
    assert jump.speed[0] == pytest.approx(divergence.speed, rel=1e-7)


@pytest.mark.parametrize("study", [three_dof, jumping])
def test_between_changes_the_lowest_onset_is_continuous(study):
    """Searches at every torsion frequency of the sweep and at its middles: large steps of speed or
    frequency only where a change is reported."""
    study = study()
    ratios = np.array([outcome.ratio for outcome in study.outcomes])
    section = study.outcomes[0].case.section
    grid = np.sort(np.concatenate([ratios, (ratios[1:] + ratios[:-1]) / 2]))
    lowest = [find_flutter(system(section, ratio), (0.1, 60.0)).critical for ratio in grid]
    reported = [change.parameter for change in study.changes]
    for i, (left, right) in enumerate(pairwise(lowest)):
        alike = abs(left.frequency - right.frequency) < 0.05 * max(left.frequency, 1e-9)
        alike |= left.frequency == right.frequency == 0.0
        assert alike != any(grid[i] < at < grid[i + 1] for at in reported)


def test_points_lie_on_the_curves():
    dataset = jumping().dataset
    x, y = dataset["curve_torsion_ratio"].values, dataset["curve_speed"].values
    ratios = dataset["torsion_frequency_ratio"].values
    for case, speed in zip(dataset["case"].values, dataset["flutter_speed"].values, strict=True):
        near = np.abs(x - ratios[case]) < 0.06
        assert np.log(y[near] / speed).min() < 0.05
        assert np.log(y[near] / speed).max() > -0.05


def test_a_threshold_moves_the_change():
    section = read_section("airfoil-3dof").with_analysis(damping_threshold=0.01)
    study = section_sweep(section, np.arange(36, 41) / 10)
    (change,) = study.changes
    assert change.confirmed
    assert change.speed[0] < three_dof().changes[0].speed[0]


def test_no_change_is_made_up_at_the_ends_of_the_sweep():
    """Flutter is lowest to the right of the only change, divergence to its left."""
    section = TypicalSection(
        mass_ratio=11.1,
        inertia_ratio=0.29,
        axis_offset=-0.34,
        mass_offset=0.2,
        torsion_frequency_ratio=1.8,
        second_mass_ratio=0.14,
        second_frequency_ratio=1.56,
    )
    (change,) = section_sweep(section, np.arange(3, 12, 2) / 10).changes
    assert change.confirmed
    assert change.frequency[0] == 0.0 < change.frequency[1]


def test_no_change_without_a_second_motion():
    study = section_sweep(read_section("hodges-pierce"), np.arange(20, 31) / 10)
    assert study.changes == ()
    assert "change_kind" not in study.dataset


def test_divergence_is_continued_to_the_ends_and_not_beyond_the_search():
    """For this section it is sqrt(10) times the torsion frequency ratio."""
    family, ratios = section_family(read_section("airfoil-2dof")), np.array([1.0, 2.0, 3.0, 4.0])
    for highest, wanted in ((10.0, [0.9, 1.0, 2.0, 3.0]), (20.0, [0.9, 1.0, 2.0, 3.0, 4.0, 4.1])):
        points = [(at, p) for at in ratios for p in find_flutter(family(at), (0.2, highest)).points]
        (stretch,) = divergence_onsets(family, points, ratios, (0.9, 4.1))
        np.testing.assert_array_equal(stretch.parameter, wanted)
        np.testing.assert_allclose(stretch.speed, np.sqrt(10.0) * stretch.parameter, rtol=1e-7)


def test_structural_damping_raises_the_onset():
    section = read_section("hodges-pierce")
    damped = section.model_copy(update={"analysis": Analysis(damping=0.02)})
    plain, stiff = (section_study(one).outcomes[0].case.analysis for one in (section, damped))
    assert stiff.critical.speed > plain.critical.speed


def test_a_failed_case_is_named_and_the_others_stand(monkeypatch):
    from foldwing.studies import section as studies

    def fails_at_two(problem, *arguments):
        if problem.section.torsion_frequency_ratio == 2.0:
            raise np.linalg.LinAlgError("singular")
        return find_flutter(problem, *arguments)

    monkeypatch.setattr(studies, "find_flutter", fails_at_two)
    study = section_sweep(read_section("hodges-pierce"), [1.9, 2.0, 2.1])
    assert [outcome.case is None for outcome in study.outcomes] == [False, True, False]
    assert "singular" in study.outcomes[1].message
    assert not bool(study.dataset["certified"][1])
