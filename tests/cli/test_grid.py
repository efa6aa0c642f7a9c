"""Ranges, grids of fold angles and airspeeds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.errors import InputError
from foldwing.model import read_model
from foldwing.studies.grid import fold_cases, parse_range, parse_speeds, swept_hinge

numbers = st.integers(-2000, 2000).map(lambda number: number / 8)
steps = st.integers(1, 400).map(lambda number: number / 8)


@given(start=numbers, length=st.integers(0, 200), step=steps, down=st.booleans())
def test_ranges_include_their_stop(start, length, step, down):
    step = -step if down else step
    stop = start + length * step
    values = parse_range(f"{start}:{stop}:{step}", "--fold2")
    assert values == pytest.approx([start + i * step for i in range(length + 1)], abs=1e-12)


@given(start=numbers, stop=numbers, step=steps)
def test_ranges_stay_between_their_ends(start, stop, step):
    step = step if stop >= start else -step
    values = np.array(parse_range(f"{start}:{stop}:{step}", "--fold2"))
    assert (values[0], values[-1]) == (start, stop)
    gaps = np.diff(values) / step
    assert (gaps > 0.0).all()
    assert gaps[:-1] == pytest.approx(1.0)


def test_decimal_steps_hit_the_stop():
    assert parse_range("0:1:0.1", "--fold2") == tuple(round(0.1 * i, 12) for i in range(11))
    assert len(parse_range("0:150:2.5", "--fold2")) == 61
    assert parse_range(" 7.5 ", "--fold2") == (7.5,)


@given(values=st.lists(numbers, min_size=1, max_size=8))
def test_lists_keep_their_order_and_count_a_value_once(values):
    text = ",".join(str(value) for value in values)
    assert parse_range(text, "--fold2") == tuple(sorted(set(values), key=values.index))


def test_lists_may_hold_ranges():
    assert parse_range("0:90:45, 90:120:10,-5", "--fold2") == (
        0.0,
        45.0,
        90.0,
        100.0,
        110.0,
        120.0,
        -5.0,
    )
    cases = fold_cases(read_model("three-segment"), None, {2: "0,60,90", 3: "level"})
    assert cases == [(0.0, 0.0), (60.0, -60.0), (90.0, -90.0)]
    assert parse_speeds("5,20,60").tolist() == [5.0, 20.0, 60.0]


@given(text=st.text(alphabet="0123456789.:,-+einfa _xX", max_size=12))
def test_ranges_give_finite_values_or_an_input_error(text):
    try:
        values = parse_range(text, "--fold2")
    except InputError as problem:
        assert problem.field == "--fold2"
        assert problem.value == text
        assert problem.limit and problem.remedy
    else:
        assert values
        assert np.isfinite(values).all()


def test_first_hinge_is_slowest_and_unnamed_hinges_keep_their_angle():
    wing = read_model("three-segment")
    assert fold_cases(wing) == [(30.0, -30.0)]
    cases = fold_cases(wing, None, {2: "0:10:10", 3: "1:2:1"})
    assert cases == [(0.0, 1.0), (0.0, 2.0), (10.0, 1.0), (10.0, 2.0)]
    assert swept_hinge(cases) == 2
    assert swept_hinge(fold_cases(wing, None, {3: "1:2:1"})) == 3
    assert swept_hinge(fold_cases(wing)) is None


def test_level_has_no_negative_zero():
    wing = read_model("three-segment")
    angles = fold_cases(wing, None, {2: "0", 3: "level"})[0]
    assert np.signbit(angles).tolist() == [False, False]


def test_airspeeds():
    assert parse_speeds("0:60:20").tolist() == [0.0, 20.0, 40.0, 60.0]
    assert parse_speeds("35").tolist() == [35.0]


def test_no_more_processes_than_cores(monkeypatch):
    """A thousand of them would only fill the memory."""
    from foldwing.cli import options

    monkeypatch.setattr(options.os, "cpu_count", lambda: 3)
    assert [options.processes(text) for text in ("1", "3", "1000")] == [1, 3, 3]
