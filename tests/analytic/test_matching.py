"""The same flutter points in two computations."""

import numpy as np
import pytest

from foldwing.results import FlutterRow
from foldwing.studies.matching import likeness, match_points


def point(speed, frequency=10.0, event="onset", kind="flutter"):
    return FlutterRow(0, (), kind, event, "", speed, frequency, 0.1, 0, "T1", 1.0, 0.0, 0.0)


def motion(*parts):
    return np.array(parts, complex)


def matched(rows, motions, others, other_motions):
    alike = likeness(np.array(motions), np.array(other_motions))
    return match_points(rows, others, alike).tolist()


A, B = motion(1.0, 0.0, 1j), motion(0.0, 1.0, 0.0)


def test_likeness_ignores_size_and_phase():
    alike = likeness(np.array([A, B]), np.array([3j * A, B, A + B]))
    assert alike == pytest.approx(np.array([[1.0, 0.0, 2 / 3], [0.0, 1.0, 1 / 3]]))


def test_points_that_change_places_follow_their_motion():
    rows, others = [point(20.0), point(21.0)], [point(20.1), point(20.9)]
    assert matched(rows, [A, B], others, [B, A]) == [1, 0]


def test_a_vanished_point_is_missing_and_takes_no_other():
    rows = [point(20.0), point(30.0)]
    assert matched(rows, [A, B], [point(20.2)], [A]) == [0, -1]
    assert matched(rows, [A, B], [point(30.1)], [A]) == [-1, -1]


@pytest.mark.parametrize(
    "other",
    [
        point(20.0, event="recovery"),
        point(20.0, 0.0, kind="divergence"),
        point(35.0),
        point(20.0, 18.0),
    ],
    ids=["event", "kind", "speed", "frequency"],
)
def test_points_that_differ_are_not_paired(other):
    assert matched([point(20.0)], [A], [other], [A]) == [-1]


def test_divergence_has_no_frequency_to_compare():
    row, other = point(40.0, 0.0, kind="divergence"), point(41.0, 0.0, kind="divergence")
    assert matched([row], [A], [other], [A]) == [0]


def test_of_like_points_the_nearest_is_taken_once():
    rows, others = [point(20.0), point(22.0)], [point(22.5), point(20.4)]
    assert matched(rows, [A, A], others, [A, A]) == [1, 0]
    assert matched(rows, [A, A], [point(21.9)], [A]) == [-1, 0]


def test_nothing_matches_nothing():
    assert match_points([], [point(1.0)], np.zeros((0, 1))).tolist() == []
    assert match_points([point(1.0)], [], np.zeros((1, 0))).tolist() == [-1]
