"""Plunge and twist of sections that bend, against closed forms."""

import numpy as np
import pytest

from foldwing.model import rectangle
from foldwing.structure.sections import (
    chordwise_bending,
    section_inertia,
    section_motion,
    span_rule,
)
from support.plates import CRANK, DELTA, OUTLINES, TRAPEZOID, sheet


def moving(*shapes):
    """A displacement with these shapes w(x, y)."""

    def displacement(x, y):
        u = np.zeros((len(y), 3, len(shapes)))
        for column, w in enumerate(shapes):
            u[:, 2, column] = w(x, y)
        return u

    return displacement


def inside(planform, count=9):
    return np.linspace(planform.breaks[0], planform.breaks[-1], count)


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize("elastic_axis", [0.0, 0.4])
def test_straight_sections_keep_their_plunge_and_twist(name, elastic_axis):
    """w = h - (x - x_ea) phi with h and phi of any kind along the span, to the very ends."""
    planform = OUTLINES[name]
    front, back = planform.chord_ends(y := inside(planform))
    axis = front + elastic_axis * (back - front)
    h, phi = np.cos(20.0 * y), 1.0 + 30.0 * y**2

    def straight(x, y):
        front, back = planform.chord_ends(y)
        axis = front + elastic_axis * (back - front)
        return np.cos(20.0 * y) - (x - axis) * (1.0 + 30.0 * y**2)

    fit = section_motion(planform, elastic_axis, y, moving(straight))
    np.testing.assert_allclose(fit.motion.plunge[:, 0], h, atol=1e-12)
    np.testing.assert_allclose(fit.motion.twist[:, 0], phi, atol=1e-9)
    assert np.abs(fit.remainder).max() < 1e-12
    assert np.all(np.isfinite(axis))


def test_a_parabola_along_the_chord_leaves_its_second_legendre_polynomial():
    """w = x^2 on a chord from -b to b: plunge b^2/3, no twist, rms b^2 sqrt(4/45)."""
    b = 0.03
    fit = section_motion(
        rectangle(0.2, 2 * b, 0.5), 0.5, np.array([0.1]), moving(lambda x, y: x**2)
    )
    assert fit.motion.plunge[0, 0] == pytest.approx(b**2 / 3.0)
    assert fit.motion.twist[0, 0] == pytest.approx(0.0, abs=1e-15)
    assert fit.remainder[0, 0] == pytest.approx(b**2 * np.sqrt(4.0 / 45.0))


def test_the_twist_of_a_pointed_tip_is_the_slope_there():
    """The chord has no length at the tip of a delta, or where a flared edge ends."""
    w = moving(lambda x, y: np.sin(20.0 * x) + y)
    tip = DELTA.outboard_edge[0]
    fit = section_motion(DELTA, 0.5, tip[1:], w)
    assert fit.motion.twist[0, 0] == pytest.approx(-20.0 * np.cos(20.0 * tip[0]), rel=1e-5)
    assert fit.motion.plunge[0, 0] == pytest.approx(np.sin(20.0 * tip[0]) + tip[1], rel=1e-5)
    ends = section_motion(TRAPEZOID, 0.5, TRAPEZOID.breaks, w)
    assert np.all(np.isfinite(ends.motion.twist)) and np.all(np.isfinite(ends.remainder))


def test_shares_of_chordwise_bending_are_those_of_legendre_polynomials():
    """P2 alone 1, straight sections 0, and a mixture by the squares of its parts: 4/45 and 1."""
    b = 0.03
    planform = rectangle(0.2, 2 * b, 0.5)
    displacement = moving(
        lambda x, y: y * ((x / b) ** 2 - 1.0 / 3.0), lambda x, y: y, lambda x, y: 0.0 * x
    )
    q = np.array([[1.0, 0.0, 2.0, 0.0], [0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
    share = chordwise_bending(planform, displacement, q)
    mixed = 4.0 * 4.0 / 45.0 / (4.0 * 4.0 / 45.0 + 1.0)
    np.testing.assert_allclose(share, [1.0, 0.0, mixed, 0.0], atol=1e-13)


def test_rule_along_the_span_and_inertia_of_sections():
    """A kinked outline: its area; a tapered thickness: its moment by a sum over thin strips."""
    y, weights = span_rule(CRANK, 4)
    front, back = CRANK.chord_ends(y)
    assert weights @ (back - front) == pytest.approx(CRANK.area, rel=1e-13)
    material = sheet(thickness=((0.001, 0.003), (0.002, 0.001)))
    inertia = section_inertia(CRANK, material, 0.3, y[:3])
    for at, found in zip(y[:3], inertia, strict=True):
        front, back = CRANK.chord_ends(np.array([at]))
        x = front + (np.arange(20000) + 0.5) / 20000 * (back - front)
        t = material.thickness_at(*CRANK.fractions(x, np.full_like(x, at)))
        axis = front + 0.3 * (back - front)
        strips = 2700.0 * np.sum(t * (x - axis) ** 2) * (back - front)[0] / 20000
        assert found == pytest.approx(strips, rel=1e-7)
