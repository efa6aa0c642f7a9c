"""Infinite-plate spline: what it reproduces, how fast it converges, its slopes and errors."""

import numpy as np
import pytest

from foldwing.maths.splines import (
    line_spline,
    on_one_line,
    plate_spline,
    sprung_plate_spline,
)


def scattered(count: int, seed: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).uniform((-0.1, 0.0), (0.2, 0.5), (count, 2))


def grid(n: int) -> np.ndarray:
    x, y = np.meshgrid(np.linspace(0.0, 1.0, n), np.linspace(0.0, 1.0, n))
    return np.column_stack([x.ravel(), y.ravel()])


INSIDE = np.random.default_rng(9).uniform(0.25, 0.75, (200, 2))


def test_planes_are_exact_everywhere_even_far_outside_and_with_smoothing() -> None:
    points = scattered(30)
    values = np.column_stack([np.ones(30), points])
    far = np.array([[0.0, 0.1], [3.0, -2.0]])
    for smoothing in (0.0, 0.05):
        spline = plate_spline(points, values, smoothing)
        assert spline.evaluate(far) == pytest.approx(np.column_stack([[1, 1], far]), abs=1e-11)
        expected = [[[0, 1, 0], [0, 0, 1]]] * 2
        assert spline.slopes(far) == pytest.approx(np.array(expected, float), abs=1e-11)


@pytest.mark.parametrize(
    ("field", "slopes"),
    [
        (lambda x, y: x * y - y**2, lambda x, y: (y, x - 2 * y)),
        (lambda x, y: x**3 - 2 * x * y**2, lambda x, y: (3 * x**2 - 2 * y**2, -4 * x * y)),
    ],
)
def test_edges_converge_slowly_and_the_inside_fast(field, slopes) -> None:
    """The plate has free edges, which the field has not; inside this is soon forgotten.

    Worst are the corners, where the orders are 1.6 and 0.6.
    """
    along = np.linspace(0.0, 1.0, 801)
    edges = np.concatenate(
        [
            np.column_stack(each)
            for end in (0.0, 1.0)
            for each in ((along, 0 * along + end), (0 * along + end, along))
        ]
    )
    errors = []
    for n in (11, 21, 41):
        points = grid(n)
        spline = plate_spline(points, field(*points.T)[:, None])
        row = []
        for at in (edges, INSIDE):
            true = np.array(slopes(*at.T)).T
            row.append(np.abs(spline.evaluate(at)[:, 0] - field(*at.T)).max())
            row.append(np.abs(spline.slopes(at)[:, :, 0] - true).max())
        errors.append(row)
    order = -np.polyfit(np.log([10, 20, 40]), np.log(errors), 1)[0]
    assert order[0] > 1.5
    assert order[1] > 0.5
    assert min(order[2:]) > 4.0


def test_it_goes_through_every_point() -> None:
    points = scattered(80)
    values = np.random.default_rng(1).normal(size=(80, 4))
    assert plate_spline(points, values).evaluate(points) == pytest.approx(values, abs=1e-9)


@pytest.mark.parametrize("kind", ["plate", "line"])
def test_slopes_are_those_of_finite_differences(kind: str) -> None:
    points = scattered(40)
    if kind == "line":
        points = np.outer(np.linspace(0.0, 1.0, 9), (0.3, 0.5))
    values = np.random.default_rng(2).normal(size=(len(points), 3))
    spline = plate_spline(points, values) if kind == "plate" else line_spline(points, values)
    at, step = np.concatenate([scattered(25, 8), points[:1] + 1e-3]), 1e-6
    numeric = np.stack(
        [
            (spline.evaluate(at + step * e) - spline.evaluate(at - step * e)) / (2 * step)
            for e in np.eye(2)
        ],
        axis=1,
    )
    assert spline.slopes(at) == pytest.approx(numeric, abs=2e-7 * np.abs(numeric).max())


def test_slopes_are_continuous_at_the_points() -> None:
    points = scattered(40)
    spline = plate_spline(points, np.random.default_rng(2).normal(size=(40, 1)))
    at = spline.slopes(points)
    for distance in (1e-9, 1e-12):
        jump = np.abs(spline.slopes(points + distance) - at).max() / np.abs(at).max()
        assert jump < 1e5 * distance


@pytest.mark.parametrize("springs", [0.0, 0.02])
def test_error_with_a_point_left_out_is_that_of_real_refitting(springs: float) -> None:
    points = scattered(35)
    values = np.random.default_rng(5).normal(size=(35, 2))
    closed = sprung_plate_spline(points, values, springs).left_out
    for i in range(35):
        others = np.arange(35) != i
        refit = sprung_plate_spline(points[others], values[others], springs)
        error = values[i] - refit.evaluate(points[i : i + 1])[0]
        assert closed[i] == pytest.approx(error, abs=1e-10 * np.abs(closed).max())


def test_smoothing_halves_a_wave_of_two_pi_times_its_length() -> None:
    points = grid(41)
    length = 0.2
    wave = np.sin(2 * np.pi * points[:, 0] / length)[:, None]
    middle = np.abs(points - 0.5).max(axis=1) < 0.15
    left = plate_spline(points, wave, smoothing=length / (2 * np.pi)).evaluate(points[middle])
    share = np.linalg.lstsq(wave[middle], left, rcond=None)[0].item()
    assert share == pytest.approx(0.5, abs=0.02)


def test_units_of_length_do_not_matter() -> None:
    points, at = scattered(30), scattered(10, 4)
    values = np.random.default_rng(6).normal(size=(30, 1))
    metres = plate_spline(points, values, 0.01)
    millimetres = plate_spline(points * 1e3, values, 10.0)
    assert millimetres.evaluate(at * 1e3) == pytest.approx(metres.evaluate(at), abs=1e-9)
    assert millimetres.slopes(at * 1e3) * 1e3 == pytest.approx(metres.slopes(at), abs=1e-7)


def test_many_points_are_treated_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    points, at = scattered(30), scattered(50, 4)
    spline = plate_spline(points, np.random.default_rng(6).normal(size=(30, 2)))
    whole = spline.evaluate(at), spline.slopes(at)
    monkeypatch.setattr("foldwing.maths.splines._BLOCK", 100)
    assert spline.evaluate(at) == pytest.approx(whole[0], abs=1e-14)
    assert spline.slopes(at) == pytest.approx(whole[1], abs=1e-12)
    assert spline.evaluate(np.zeros((0, 2))).shape == (0, 2)


def test_line_spline_is_exact_for_cubics_and_straight_beyond_the_ends() -> None:
    direction = np.array([0.28, 0.96])
    s = np.array([0.5, 0.0, 0.9, 0.2, 0.7])
    points = np.outer(s, direction) + np.array([0.1, -0.2])
    spline = line_spline(points, (s**3)[:, None])
    across = np.array([-0.96, 0.28])
    at = 0.4 * direction + [0.1, -0.2] + 0.05 * across
    assert spline.evaluate(at) == pytest.approx(0.4**3, abs=1e-13)
    assert spline.slopes(at)[0, :, 0] == pytest.approx(3 * 0.4**2 * direction, abs=1e-12)
    beyond = 1.1 * direction + [0.1, -0.2]
    assert spline.evaluate(beyond) == pytest.approx(0.9**3 + 0.2 * 3 * 0.9**2, abs=1e-12)
    between = (s > 0.0) & (s < 0.9)
    assert spline.left_out[between] == pytest.approx(0.0, abs=1e-12)
    assert spline.left_out[s == 0.9].item() == pytest.approx(0.9**3 - (0.7**3 + 0.2 * 3 * 0.7**2))


def test_points_on_a_line_are_recognised() -> None:
    line = np.outer(np.linspace(0, 1, 7), (0.3, 1.0))
    assert on_one_line(line)
    assert not on_one_line(line + np.outer(np.arange(7) % 2, (0.05, 0.0)))
    assert on_one_line(line[:2])
