"""Folding moves segments as rigid bodies, about hinges of any direction."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.model import (
    Planform,
    example_text,
    flare_of,
    frames,
    parse_model,
    read_model,
    trapezoid,
)

ANGLE = st.floats(-np.pi, np.pi)
FLARE = st.floats(-1.0, 1.0)
LENGTH = st.floats(0.05, 2.0)


@given(st.lists(st.tuples(FLARE, ANGLE, LENGTH, LENGTH), min_size=1, max_size=4))
def test_axes_stay_orthonormal_and_hinges_common_to_both_sides(hinges):
    directions = [np.array([np.cos(f), -np.sin(f)]) for f, *_ in hinges]
    ends = [np.array([x, y]) for *_, x, y in hinges]
    folded = frames([*ends, np.zeros(2)], directions, [psi for _, psi, *_ in hinges])
    for R in folded.rotations:
        assert R @ R.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(R) == pytest.approx(1.0, abs=1e-12)
    for i, h in enumerate(directions):
        for along in (-0.3, 0.7):
            inner, outer = ends[i] + along * h, along * h
            a = folded.position(i, inner[:1], inner[1:])
            b = folded.position(i + 1, outer[:1], outer[1:])
            assert a == pytest.approx(b, abs=1e-12)


@given(st.lists(st.tuples(FLARE, ANGLE), min_size=1, max_size=4))
def test_folding_there_and_back_returns_to_the_start(hinges):
    directions = [np.array([np.cos(f), -np.sin(f)]) for f, _ in hinges]
    folds = [psi for _, psi in hinges]
    there_and_back = frames(
        [np.zeros(2)] * (2 * len(hinges) + 1),
        [*directions, *directions[::-1]],
        [*folds, *(-psi for psi in folds[::-1])],
    )
    assert there_and_back.rotations[-1] == pytest.approx(np.eye(3), abs=1e-12)


@given(st.integers(3, 8), LENGTH)
def test_a_closed_chain_of_folds_ends_where_it_starts(count, length):
    """A tube of equal segments along the stream, each turned by a full circle over their number."""
    end = np.array([0.0, length])
    folded = frames(
        [end] * (count + 1), [np.array([1.0, 0.0])] * count, [2 * np.pi / count] * count
    )
    assert folded.origins[-1] == pytest.approx(np.zeros(3), abs=1e-12 * count * length)
    assert folded.rotations[-1] == pytest.approx(np.eye(3), abs=1e-12)


@given(FLARE, ANGLE, st.floats(0.1, 1.0), st.floats(0.1, 1.0))
def test_lengths_and_areas_of_a_folded_outline(flare, psi, chord, tip):
    outline = trapezoid((3.0 * chord, 3.0 * tip), 8.0, 0.4, 0.2, (flare, 0.0))
    h = np.array([np.cos(flare), -np.sin(flare)])
    folded = frames([np.zeros(2)] * 2, [h], [psi])
    corners = folded.position(1, *outline.array.T)
    flat = outline.array
    for i in range(4):
        assert np.linalg.norm(corners[i] - corners[i - 1]) == pytest.approx(
            np.linalg.norm(flat[i] - flat[i - 1]), rel=1e-12
        )
    halves = [np.cross(corners[i] - corners[0], corners[i + 1] - corners[0]) for i in (1, 2)]
    assert np.linalg.norm(sum(halves)) / 2.0 == pytest.approx(outline.area, rel=1e-10)
    assert flare_of(outline.inboard_edge) == pytest.approx(flare, abs=1e-9)


@given(ANGLE)
def test_hinges_along_the_stream_turn_about_x(psi):
    folded = frames([np.zeros(2)] * 2, [np.array([1.0, 0.0])], [psi])
    c, s = np.cos(psi), np.sin(psi)
    assert np.array_equal(folded.rotations[1], [[1, 0, 0], [0, c, -s], [0, s, c]])


def test_a_flared_tip_folded_up_meets_the_stream_with_less_incidence():
    flare = np.radians(15.0)
    folded = frames(
        [np.zeros(2)] * 2, [np.array([np.cos(flare), -np.sin(flare)])], [np.radians(30.0)]
    )
    incidence = folded.normals[1] @ [1.0, 0.0, 0.0]
    assert incidence == pytest.approx(-np.sin(flare) * np.sin(np.radians(30.0)), rel=1e-12)
    assert folded.normals[1][2] > 0.0


def test_centroid_and_area_of_a_triangle():
    triangle = Planform(corners=((0.0, 0.0), (0.9, 3.0), (3.0, 0.0)), tip=(1, 1))
    assert triangle.area == pytest.approx(4.5)
    assert triangle.centroid == pytest.approx((1.3, 1.0))
    assert triangle.is_pointed and triangle.has_one_chord


def test_which_wings_are_plain():
    assert read_model("three-segment").is_plain
    flared = example_text("three-segment-plate").replace("fold = -30", "fold = -30, flare = 10")
    assert not parse_model(flared).is_plain
