"""Pressure on the panels of a lattice: closed forms of thin airfoils, and where the loads act."""

import numpy as np
import pytest

from foldwing.aerodynamics.horseshoe import induced_velocity
from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import Strips
from foldwing.aerodynamics.panel_loads import panel_corners, panel_loads
from foldwing.aerodynamics.unsteady import PanelMotion
from foldwing.aeroelastic.loads import Motions, loads_of, panel_grid
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.bessel import theodorsen
from foldwing.model import Lattice, read_model


def two_dimensional(rows, slope, lift, k, wake=200):
    """Pressure over density of a strip so wide that its middle is two-dimensional; b = 1."""
    strips = Strips(
        np.array([[-5e4, 0.0]]),
        np.array([[5e4, 0.0]]),
        np.array([-1.0]),
        np.array([2.0]),
        np.array([0]),
    )
    flat, up = np.full((rows, 1), slope), np.full((rows, 1), lift)
    length = (rows - np.arange(rows) - 0.5) * 2.0 / rows
    loads = panel_loads(
        Influence(strips, rows, wake * rows),
        PanelMotion(flat, up, up, up),
        length,
        (1.0, 1.0),
        Lattice(),
        np.array([1j * k]),
    )
    return loads.pressure[0, :, 0]


def quarter_points(rows):
    return -1.0 + (np.arange(rows) + 0.25) * 2.0 / rows


@pytest.mark.parametrize("k", [0.05, 0.3, 1.0])
def test_pressure_of_a_plunging_airfoil_is_that_of_thin_airfoil_theory(k):
    """Its lift is Theodorsen's; on the first panel a lattice is low by 11 %, however fine."""
    x, s = quarter_points(8), 1j * k
    C = complex(theodorsen(np.array([s]))[0])
    exact = -2.0 * s * C * np.sqrt((1.0 - x) / (1.0 + x)) - 2.0 * s**2 * np.sqrt(1.0 - x**2)
    found = two_dimensional(8, 0.0, 1.0, k)
    assert abs(found - exact)[1:].max() < 0.006 * abs(exact).max()
    assert np.degrees(np.abs(np.angle(found / exact))).max() < 0.5
    assert abs(found[0] / exact[0]) == pytest.approx(0.887, abs=0.003)
    lift = -2.0 * np.pi * s * C - np.pi * s**2
    assert abs(found.sum() * 2.0 / 8.0 - lift) < 0.004 * abs(lift)


def test_steady_pressure_of_a_flat_plate_follows_its_closed_form():
    x = quarter_points(12)
    found = two_dimensional(12, -1.0, 0.0, 0.0, wake=1)
    exact = 2.0 * np.sqrt((1.0 - x) / (1.0 + x))
    assert found.imag == pytest.approx(0.0, abs=1e-14)
    assert found.real[1:] == pytest.approx(exact[1:], rel=0.03)


def test_slow_plunge_is_opposed_by_pressure_a_quarter_period_behind():
    """Moving up, a wing is pushed down: pressure lags the displacement."""
    phase = np.degrees(np.angle(two_dimensional(4, 0.0, 1.0, 1e-4)))
    assert phase == pytest.approx(-90.0, abs=1.0)


def small_wing(chordwise=4, **changes):
    mesh = {"chordwise": chordwise, "spanwise": 8, "wake": 6.0, **changes}
    return AeroelasticWing(read_model("three-segment").with_lattice(**mesh), "lattice")


def test_at_rest_the_pressure_is_that_of_kutta_and_joukowski():
    """Circulation by horseshoes in space, none of it shared with the unsteady lattice."""
    model = small_wing()
    modes = model.modes(np.radians((40.0, -70.0)))
    strips, motion = model.strips(modes), model.panel_motion(modes)
    corners = panel_grid(model, modes).corners
    inner = 0.75 * corners[:, 0] + 0.25 * corners[:, 3]
    outer = 0.75 * corners[:, 1] + 0.25 * corners[:, 2]
    points = (corners[:, :2] + 3.0 * corners[:, 2:]).mean(axis=1) / 4.0
    normal = np.insert(np.tile(strips.normal, (4, 1)), 0, 0.0, axis=1)
    wash = np.einsum("psx,px->ps", induced_velocity(points, inner, outer), normal)
    speed, q = 20.0, np.array([[0.01, -0.02, 0.03]])
    circulation = np.linalg.solve(wash, motion.slope[:, :3] @ q[0] * speed)
    q = np.pad(q, ((0, 0), (0, modes.count - 3)))
    loads = loads_of(model, modes, Motions(np.zeros(1), np.array([speed]), q.astype(complex)))
    assert loads.circulation()[0] == pytest.approx(circulation, rel=1e-9)
    pressure = 1.2 * speed * circulation / (0.05 / 4)
    assert loads.pressure()[0] == pytest.approx(pressure, rel=1e-9)


def test_loads_on_the_vortices_give_the_generalized_forces_to_second_order():
    errors = []
    for chordwise in (4, 8, 16):
        model = small_wing(chordwise)
        modes = model.modes(np.radians((30.0, -75.0)))
        p = np.array([0.4j])
        q = np.ones((1, modes.count), complex)
        panels = loads_of(model, modes, Motions(p, np.ones(1), q)).panels
        area = np.tile(model.strips(modes).width, chordwise) * 0.05 / chordwise
        found = model.panel_motion(modes).vortex.T @ (area[:, None] * panels.pressure[0])
        exact = model.lattice(modes).forces(p)[0]
        errors.append(np.linalg.norm(found - exact) / np.linalg.norm(exact))
    assert errors[0] < 0.02
    assert np.log2(errors[0] / errors[1]) > 1.8
    assert np.log2(errors[1] / errors[2]) > 1.8


def test_corners_go_around_the_panels():
    model = small_wing()
    modes = model.modes(np.radians((50.0, 20.0)))
    strips = model.strips(modes)
    corners = panel_corners(strips, 4)
    diagonals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    area = np.linalg.norm(diagonals, axis=1) / 2.0
    assert area == pytest.approx(np.tile(strips.width, 4) * 0.05 / 4)
    # They turn as they are seen from above the sheet, where the normal points.
    normal = np.insert(np.tile(strips.normal, (4, 1)), 0, 0.0, axis=1)
    assert (np.sign((diagonals * normal).sum(axis=1)) == -1.0).all()
