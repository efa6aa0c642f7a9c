"""Lift slopes of wings whose exact or printed values are known."""

import numpy as np
import pytest

from foldwing.aerodynamics.panels import Trapezoid, strip_panels, swept_panels
from foldwing.aerodynamics.steady import at_unit_angle, lift_slope
from foldwing.aerodynamics.steady_loads import wing_loads
from foldwing.model import read_model
from support.steady_wings import disc, rectangle


def slope(strips, chordwise=4):
    panels = strip_panels(strips, chordwise)
    return lift_slope(at_unit_angle(panels), panels.area)


# Aspect ratio -> limit of the lifting-surface equation for a flat rectangle, per radian.
RECTANGLES = {
    1: 1.4595, 2: 2.4734, 4: 3.6111, 6: 4.2138, 8: 4.5853, 12: 5.0210, 20: 5.4329,
}  # fmt: skip


@pytest.mark.parametrize("aspect", RECTANGLES)
def test_rectangles_extrapolated_to_infinitely_many_strips(aspect):
    """The lattice converges with the first power of the width of its strips."""
    coarse, fine = (slope(rectangle(aspect, count)) for count in (24, 48))
    assert 2.0 * fine - coarse == pytest.approx(RECTANGLES[aspect], rel=3e-3)


def test_order_of_convergence_with_the_width_of_strips():
    values = [slope(rectangle(8, count), 2) for count in (32, 64, 128)]
    ratio = (values[0] - values[1]) / (values[1] - values[2])
    assert np.log2(ratio) == pytest.approx(1.0, abs=0.1)


def test_strips_that_end_before_the_tips_meet_the_limit_at_once():
    """Ending the lattice a quarter of a strip before its tips removes the error of first order."""
    wing = read_model("three-segment").with_lattice(spacing="inset", spanwise=30)
    loads = wing_loads(wing, (0.0, 0.0), 0.1, 1.0)
    assert loads.lift_slope == pytest.approx(RECTANGLES[6], rel=1e-3)


def test_circular_wing():
    """P. F. Jordan, Exact solutions for lifting surfaces, AIAA Journal 11, 1973: 1.790023."""
    coarse, fine = (slope(disc(count)) for count in (32, 64))
    assert 2.0 * fine - coarse == pytest.approx(1.790023, rel=1e-3)


@pytest.mark.parametrize("both_halves", [True, False])
def test_swept_wing_of_bertin_and_smith(both_halves):
    """J. J. Bertin, M. L. Smith, Aerodynamics for Engineers: aspect ratio 5, 45 degrees, 1 x 4."""
    panels = swept_panels(Trapezoid(0.5, 0.2, 0.2, np.radians(45.0)), 1, 4, both_halves=both_halves)
    unit = at_unit_angle(panels, image=not both_halves)
    assert lift_slope(unit, panels.area) == pytest.approx(3.444, abs=1e-3)
