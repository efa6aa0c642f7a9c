"""Orders, limits and error bars of sequences whose limit is known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.maths.extrapolation import assess, extrapolated, observed_order

HALVED = np.array([1.0, 0.5, 0.25, 0.125])
UNEVEN = np.array([1 / 8, 1 / 10, 1 / 14, 1 / 20])


@pytest.mark.parametrize("size", [HALVED, UNEVEN], ids=["halved", "uneven"])
@pytest.mark.parametrize("order", [0.6, 1.0, 1.5, 2.0, 3.3])
@pytest.mark.parametrize("factor", [-7.0, 0.2])
def test_order_and_limit_of_a_power_are_recovered(size, order, factor):
    found = assess(size, 40.0 + factor * size**order, 40.0 + factor * size[1] ** order)
    assert found.verdict == "monotone"
    assert found.order == pytest.approx(order, abs=1e-7)
    assert found.limit == pytest.approx(40.0, rel=1e-9)
    assert found.error == pytest.approx(1.25 * abs(factor) * size[1] ** order, rel=1e-6)


def test_coarse_levels_outside_the_power_law_do_not_matter():
    values = 3.0 + HALVED**2
    values[0] = -100.0
    assert assess(HALVED, values, values[1]).order == pytest.approx(2.0)


@pytest.mark.parametrize("order", [1, 2])
def test_observed_order_approaches_the_leading_one(order):
    errors = []
    for n in (1, 4, 16):
        size = HALVED[:3] / n
        errors.append(abs(observed_order(size, size**order + size ** (order + 1)) - order))
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.4)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.2)


@given(
    order=st.sampled_from([1.0, 2.0]),
    next_term=st.floats(-0.3, 0.3),
    level=st.integers(0, 3),
)
def test_error_bar_covers_the_true_error_of_a_sequence_with_a_second_term(order, next_term, level):
    size = HALVED / 2.0
    values = 10.0 + size**order + next_term * size ** (order + 1.0)
    found = assess(size, values, values[level])
    assert found.error >= abs(values[level] - 10.0)


def test_trapezoidal_rule_has_order_two():
    counts = np.array([4, 8, 16])
    sums = [np.trapezoid(np.exp(np.linspace(0, 1, n + 1)), dx=1 / n) for n in counts]
    found = assess(1.0 / counts, np.array(sums), sums[1])
    assert found.order == pytest.approx(2.0, abs=0.01)
    assert found.limit == pytest.approx(math.e - 1.0, abs=2e-6)


def test_oscillating_sequence_is_flagged_and_its_bar_spans_the_finest_values():
    values = np.array([9.0, 1.2, 0.9, 1.05])
    found = assess(HALVED, values, 1.2)
    assert (found.verdict, found.limit) == ("oscillating", 1.05)
    assert math.isnan(found.order)
    assert found.error == pytest.approx(1.25 * 0.3)


@pytest.mark.parametrize(("order", "verdict"), [(0.2, "slow"), (9.0, "steep")])
def test_very_low_and_very_high_orders_are_not_built_upon(order, verdict):
    values = 5.0 + HALVED**order
    found = assess(HALVED, values, values[-1])
    assert found.verdict == verdict
    assert found.order == pytest.approx(order, abs=1e-6)
    assert found.limit == values[-1]
    assert found.error == pytest.approx(3.0 * np.ptp(values[1:]))


@pytest.mark.parametrize("values", [[10.0, 10.1, 10.5], [10.0, 10.1, 10.2], [3.0, 2.0, 0.0]])
def test_differences_that_do_not_shrink_have_no_limit(values):
    found = assess(HALVED[:3], np.array(values), values[0])
    assert found.verdict == "diverging"
    assert math.isnan(found.limit) and math.isnan(found.error)


def test_orders_out_of_reach_end_at_the_bounds():
    assert observed_order(HALVED[:3], np.array([1.0, 1e-30, 0.0])) > 30.0
    assert observed_order(HALVED[:3], np.array([0.0, 1e-30, 1.0])) < -30.0


def test_equal_values_are_settled():
    found = assess(HALVED, np.full(4, 7.0), 7.0)
    assert (found.verdict, found.limit, found.error) == ("settled", 7.0, 0.0)


def test_too_few_levels_are_flagged():
    two = assess(HALVED[:2], np.array([1.0, 1.1]), 1.1)
    assert (two.verdict, two.limit) == ("few", 1.1)
    assert two.error == pytest.approx(0.3)
    one = assess(HALVED[:1], np.array([1.0]), 1.0)
    assert (one.verdict, one.limit) == ("few", 1.0)
    assert math.isnan(one.error)
    none = assess(HALVED[:0], np.array([]), 1.0)
    assert none.verdict == "few"
    assert math.isnan(none.limit) and math.isnan(none.error)


def test_without_a_power_law_nothing_is_extrapolated():
    values = 1.0 + HALVED
    found = assess(HALVED, values, values[0], power_law=False)
    assert (found.verdict, found.limit) == ("scattered", values[-1])
    assert found.error == pytest.approx(1.25 * (values[0] - values[-1]))


def test_two_levels_give_the_limit_of_a_known_order():
    size = np.array([0.3, 0.1])
    assert extrapolated(size, 2.0 - 5.0 * size**3, 3.0) == pytest.approx(2.0)
