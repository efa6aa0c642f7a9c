"""Induced drag in the Trefftz plane and loads with a known answer."""

import numpy as np
import pytest

from foldwing.aerodynamics.panels import Trapezoid, strip_panels, swept_panels
from foldwing.aerodynamics.steady import SteadyLattice, at_unit_angle
from foldwing.aerodynamics.steady_loads import wing_loads
from foldwing.errors import InputError
from foldwing.model import read_model
from support.steady_wings import disc, rectangle, slit_ring


def elliptic(lift, span):
    """Induced drag per rho U^2 of an elliptic wing: D = L^2 / (q pi b^2)."""
    return 2.0 * lift**2 / (np.pi * span**2)


@pytest.mark.parametrize("count", [4, 20, 77])
def test_least_drag_of_a_flat_lattice(count):
    """J. DeYoung: a lattice of N equal strips acts as if its span were larger, (1 + 1/N) b^2."""
    unit = at_unit_angle(strip_panels(rectangle(7.0, count), 2))
    wanted = elliptic(unit.total[2], 7.0) * count / (count + 1)
    assert unit.least_drag == pytest.approx(wanted, rel=1e-12)


def test_ring_wing_has_half_the_drag_of_a_flat_one():
    """Th. von Karman, J. M. Burgers, in Durand, Aerodynamic Theory II, 1935."""
    errors = []
    for count in (100, 200):
        unit = at_unit_angle(strip_panels(slit_ring(count), 1))
        errors.append(unit.least_drag / (elliptic(unit.total[2], 2.0) / 2.0) - 1.0)
    assert abs(errors[1]) < 0.02
    assert abs(errors[1]) < 0.6 * abs(errors[0])


def test_circular_wing_is_nearly_elliptic():
    shares = []
    for count in (30, 60):
        unit = at_unit_angle(strip_panels(disc(count), 4))
        assert unit.efficiency == pytest.approx(1.0, abs=5e-3)
        shares.append(unit.induced_drag / elliptic(unit.total[2], 2.0))
    assert 2.0 * shares[1] - shares[0] == pytest.approx(1.0, abs=5e-3)


@pytest.mark.parametrize(("aspect", "low", "high"), [(4, 0.985, 0.999), (10, 0.95, 0.975)])
def test_efficiency_of_flat_rectangles(aspect, low, high):
    """H. Glauert, The Elements of Aerofoil and Airscrew Theory: 1/(1 + delta), 0.98 to 0.91 by
    lifting lines; surfaces are rounder at their tips and a little better."""
    assert low < at_unit_angle(strip_panels(rectangle(aspect, 40), 4)).efficiency < high


def test_drag_is_more_than_elliptic_in_the_limit():
    drag = []
    for count in (40, 80):
        unit = at_unit_angle(strip_panels(rectangle(8.0, count), 2))
        drag.append(unit.induced_drag / elliptic(unit.total[2], 8.0))
    assert 2.0 * drag[1] - drag[0] > 1.01


def test_elliptic_circulation_has_the_least_drag():
    panels = strip_panels(rectangle(6.0, 200), 1)
    y = panels.points[:, 1]
    lattice = SteadyLattice(panels, np.sqrt(9.0 - y**2))
    assert lattice.efficiency == pytest.approx(1.0, abs=2e-3)
    assert lattice.induced_drag == pytest.approx(elliptic(lattice.total[2], 6.0), rel=1e-2)


def test_centre_of_pressure_of_a_high_aspect_ratio_is_the_quarter_chord():
    wing = read_model("goland").with_lattice(image=True, spanwise=40)
    loads = wing_loads(wing, (), 0.1, 10.0)
    assert loads.segments[0].centre_x == pytest.approx(0.25, abs=0.02)
    segment = wing.segments[0].model_copy(update={"span": 400.0})
    long = wing_loads(wing.model_copy(update={"segments": (segment,)}), (), 0.1, 10.0)
    assert long.aerodynamic_centre == pytest.approx(0.25, abs=1e-3)
    assert long.lift_slope == pytest.approx(2.0 * np.pi, rel=0.02)


def test_swept_back_wings_carry_more_at_their_tips():
    middle_to_tip = []
    for sweep in (-0.5, 0.0, 0.5):
        unit = at_unit_angle(swept_panels(Trapezoid(4.0, 1.0, 1.0, sweep), 2, 16))
        g = unit.by_strip[16:]
        middle_to_tip.append(g[14] / g[1])
    assert middle_to_tip == sorted(middle_to_tip)


def test_taper_keeps_the_line_of_sweep_straight():
    wing = Trapezoid(2.0, 1.0, 0.4, 0.3, sweep_line=0.25)
    y = np.array([0.0, 0.7, 2.0])
    line = wing.leading(y) + 0.25 * wing.chord(y)
    assert line - line[0] == pytest.approx(np.tan(0.3) * y)
    assert swept_panels(wing, 3, 5).area == pytest.approx(2.0 * 2.0 * 0.7)


@pytest.mark.parametrize("field", ["semispan", "root_chord", "tip_chord", "sweep"])
@pytest.mark.parametrize("value", [-2.0, float("nan")])
def test_impossible_trapezoids_are_refused(field, value):
    sizes = {"semispan": 1.0, "root_chord": 1.0, "tip_chord": 1.0, field: value}
    with pytest.raises(InputError, match=field):
        Trapezoid(**sizes)


def beside_gap(**mesh):
    """Circulation of the strip of segment 1 beside a gap of 2 cm, and the lift."""
    wing = read_model("three-segment").with_gaps("2 cm").with_lattice(**mesh)
    loads = wing_loads(wing, (0.0, 0.0), 0.1, 1.0)
    last = np.flatnonzero(loads.lattice.panels.segment == 0)[-1]
    return loads.lattice.by_strip[last], loads.lift


def test_circulation_falls_towards_a_gap_with_the_root_of_the_distance():
    meshes = [{"chordwise": 1, "gap_refinement": 0, "spanwise": n} for n in (54, 108, 216)]
    values = [beside_gap(**mesh)[0] for mesh in meshes]
    assert np.array(values[1:]) / values[:-1] == pytest.approx([0.5**0.5] * 2, rel=0.03)


def test_strips_halved_towards_a_gap_converge():
    values = [beside_gap(gap_refinement=count) for count in (2, 5, 8)]
    circulation, lift = zip(*values, strict=True)
    assert circulation[2] < 0.25 * circulation[0]
    assert abs(lift[2] - lift[1]) < 0.1 * abs(lift[1] - lift[0])


def test_spacings_agree_on_the_efficiency_or_give_none():
    wing = read_model("three-segment")
    folds = np.radians((30.0, -75.0))
    for angles in (np.zeros(2), folds):
        uniform, inset, cosine = (
            wing_loads(wing.with_lattice(spacing=spacing), angles, 0.1, 1.0)
            for spacing in ("uniform", "inset", "cosine")
        )
        assert inset.efficiency == pytest.approx(uniform.efficiency, rel=0.01)
        assert np.isnan([cosine.efficiency, cosine.least_drag]).all()
    plain = read_model("goland")
    alone = [
        wing_loads(plain.with_lattice(spacing=spacing), (), 0.1, 1.0).efficiency
        for spacing in ("uniform", "cosine")
    ]
    assert alone[1] == pytest.approx(alone[0], rel=0.01)
