"""Which crossings belong to one root, and the still-air mode that the root starts from.

Evidence: loci followed upwards from rest, which the naming does not use (it goes down from each
crossing), and the wings whose humps are known.
"""

from itertools import pairwise

import numpy as np
import pytest

from foldwing.stability.branches import energy_modes, trace_origins
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import polish_crossings
from foldwing.stability.tracking import track
from support.stability import example, example_modes, of_kind
from support.typical_section import ManySections, TypicalSection

TOP = 93.0
RANGE = (0.62, TOP)


def analysed(*folds):
    analysis = find_flutter(example("three-segment", *folds), RANGE)
    names = example_modes("three-segment", *folds).names
    return of_kind(analysis, "flutter"), names


def summary(points, names):
    return [
        (point.event, point.branch, point.classification, names[point.mode]) for point in points
    ]


def test_hump_below_a_coalescence():
    points, names = analysed(30, -60)
    assert summary(points[:3], names) == [
        ("onset", 0, "hump", "T1"),
        ("recovery", 0, "", "T1"),
        ("onset", 1, "coalescence", "B2"),
    ]
    speeds = [point.speed for point in points[:3]]
    assert speeds == pytest.approx([20.37, 28.18, 31.73], abs=0.005)
    assert [point.mode_confidence for point in points[:3]] == [1.0] * 3


def test_hump_of_the_level_tip():
    points, names = analysed(85, -85)
    hump = [point for point in points if point.branch == 0]
    assert summary(hump, names) == [("onset", 0, "hump", "T1"), ("recovery", 0, "", "T1")]
    assert [point.speed for point in hump] == pytest.approx([30.3, 53.8], abs=0.05)
    later = [point for point in points if point.branch != 0]
    assert [point.classification for point in later] == ["coalescence"] * 2


def test_a_hump_ends_within_the_range():
    """Searched to 28 m/s only, the recovery at 28.18 m/s is not known."""
    analysis = find_flutter(example("three-segment", 30, -60), (0.62, 28.0))
    assert [point.classification for point in analysis.points] == ["coalescence"]


CASES = [
    ("three-segment", 30, -60),
    ("three-segment", 85, -85),
    ("three-segment", 0, 0),
    ("three-segment-table-2-1", 60, -60),
    ("goland",),
    ("hale",),
]
TOPS = {"goland": 760.0, "hale": 120.0}


@pytest.mark.parametrize("case", CASES)
def test_branches_and_modes_are_those_of_loci_from_rest(case):
    problem, top = example(*case), TOPS.get(case[0], TOP)
    points = of_kind(find_flutter(problem, (top / 150, top)), "flutter")
    at = np.array([point.speed for point in points])
    loci = track(problem, np.union1d(np.linspace(0.0, top, 80)[1:], at))
    column = []
    for point in points:
        values = loci.eigenvalue[np.flatnonzero(loci.speed == point.speed)[0]]
        distance = np.abs(values / (point.p * point.speed / problem.half_chord) - 1)
        column.append(int(np.nanargmin(distance)) if np.nanmin(distance) < 1e-6 else None)
    for point, j in zip(points, column, strict=True):
        if j is None:  # the pair of this point was real at a lower airspeed
            assert point.mode_confidence < 1.0
        else:
            assert (point.mode, point.mode_confidence) == (loci.mode[j], 1.0)
    for i, j in np.ndindex(len(points), len(points)):
        if column[i] is not None and column[j] is not None:
            assert (points[i].branch == points[j].branch) == (column[i] == column[j])
    assert sum(j is not None for j in column) >= 2


def test_branches_are_numbered_in_order_of_airspeed():
    points, _ = analysed(85, -85)
    first = [next(p.speed for p in points if p.branch == b) for b in range(3)]
    assert first == sorted(first)
    assert {point.branch for point in points} == set(range(3))


def test_onset_and_recovery_alternate_on_a_branch():
    for case in CASES[:4]:
        points = of_kind(find_flutter(example(*case), RANGE), "flutter")
        for branch in {point.branch for point in points}:
            own = [point.event for point in points if point.branch == branch]
            assert all(a != b for a, b in pairwise(own))
            humps = [
                point.classification == "hump"
                for point in points
                if point.branch == branch and point.event == "onset"
            ]
            assert sum(humps) == sum(a == "onset" for a in own[:-1])


def test_modes_of_uncoupled_sections():
    """Side by side, each section's flutter starts from its own pitch mode, highest in frequency."""
    sections = tuple(TypicalSection(pitch_frequency=w) for w in (2.2, 3.0))
    points = of_kind(find_flutter(ManySections(sections), (0.3, 20.0)), "flutter")
    alone = [of_kind(find_flutter(s, (0.3, 20.0)), "flutter")[0] for s in sections]
    assert [point.speed for point in points] == pytest.approx([p.speed for p in alone], rel=1e-9)
    assert [point.branch for point in points] == [0, 1]
    assert {point.mode for point in points} <= {0, 1, 2, 3}
    assert len({point.mode for point in points}) == 2


def test_a_point_by_itself_is_a_branch():
    problem = example("goland")
    none = polish_crossings(problem, np.array([]), np.array([]))
    assert len(trace_origins(problem, none, 5.0).branch) == 0
    one = polish_crossings(problem, np.array([0.4668]), np.array([137.26]))
    origin = trace_origins(problem, one, 5.0)
    assert origin.branch.tolist() == [0]
    assert example_modes("goland").names[origin.mode[0]] == "T1"


def test_the_energy_of_a_divergence_is_in_its_mode():
    """Without a root to follow, the mode is that of the largest share, never called certain."""
    problem = example("hale")
    bending = np.zeros((2, 12), complex)
    bending[0, 0], bending[1, [0, 3]] = 1.0, [1.0, 100.0 * problem.omega[3] / problem.omega[0]]
    mode, share = energy_modes(problem, bending)
    assert mode.tolist() == [0, 3]
    assert np.all((share > 0.9) & (share < 1.0))
