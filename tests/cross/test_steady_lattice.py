"""The steady lattice against the unsteady one at rest, and against work done by its forces."""

import numpy as np
import pytest

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import mesh_segments
from foldwing.aerodynamics.panels import strip_panels
from foldwing.aerodynamics.steady import at_unit_angle, solve_steady
from foldwing.aerodynamics.steady_loads import wing_loads, wing_strips
from foldwing.aerodynamics.unsteady import PanelMotion, lattice_model
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Segment, read_model

FOLDS = [(0.0, 0.0), (30.0, -75.0), (90.0, -90.0), (120.0, 40.0), (-150.0, 60.0)]


def wing(chords=(0.05, 0.05, 0.05), gap=0.0):
    flat = read_model("three-segment")
    segments = tuple(
        Segment(**{**dict(segment), "chord": chord, "elastic_axis": 0.4, "mass_centre": 0.4})
        for segment, chord in zip(flat.segments, chords, strict=True)
    )
    changed = flat.model_copy(update={"segments": segments}).with_lattice(chordwise=4, spanwise=17)
    return changed.with_gaps(gap)


def rigid_motion(panels):
    """Plunge along z and pitch about y through the origin, nose up, at the panels."""
    n_z = panels.normals[:, 2]

    def normal(x):
        return np.stack([n_z, -x * n_z], axis=1)

    x_c, x_v = panels.points[:, 0], panels.inner[:, 0]
    slope = np.stack([0.0 * n_z, -n_z], axis=1)
    return PanelMotion(slope, normal(x_c), normal(x_v), normal(x_v))


@pytest.mark.parametrize("folds", FOLDS)
@pytest.mark.parametrize("image", [False, True])
@pytest.mark.parametrize("chords", [(0.05, 0.05, 0.05), (0.05, 0.04, 0.07)])
def test_equals_the_unsteady_lattice_at_rest(folds, image, chords):
    """Two kernels: general horseshoes here, the fast normal component there."""
    model, angles = wing(chords).with_lattice(image=image), np.radians(folds)
    strips = wing_strips(model, angles)
    panels = strip_panels(strips, 4)
    unsteady = lattice_model(
        Influence(strips, 4, 4, image), rigid_motion(panels), np.ones(4 * 17),
        model.air.density, 0.025, model.lattice,
    )  # fmt: skip
    lift, moment = unsteady.steady_forces()[:, 1]
    unit = at_unit_angle(panels, image)
    total = model.air.density * np.array([unit.total[2], unit.moment(np.zeros(3))[1]])
    assert total == pytest.approx([lift, moment], rel=1e-12, abs=1e-12 * abs(lift))


@pytest.mark.parametrize("folds", FOLDS)
def test_equals_the_influence_of_the_fast_kernel(folds):
    strips = wing_strips(wing(), np.radians(folds))
    fast = Influence(strips, 4, 1).wing
    assert strip_panels(strips, 4).influence() == pytest.approx(fast, abs=1e-12 * abs(fast).max())


def test_elastic_twist_gives_the_generalized_forces_of_the_modes():
    model = AeroelasticWing(wing(), "lattice")
    modes = model.modes(tuple(np.radians((30.0, -75.0))))
    motion = model.panel_motion(modes)
    panels = strip_panels(model.strips(modes), 4)
    solved = [solve_steady(panels, motion.slope[:, k]) for k in range(modes.count)]
    force = np.array([np.einsum("nk,nk->n", s.forces, panels.normals) for s in solved])
    generalized = model.wing.air.density * (force @ motion.vortex).T
    wanted = model.lattice(modes).steady_forces()
    assert generalized == pytest.approx(wanted, abs=1e-12 * abs(wanted).max())


def test_frames_are_those_of_the_structure():
    folds = tuple(np.radians((40.0, -100.0)))
    modes = AeroelasticWing(wing()).modes(folds)
    frames = wing().frames(folds)
    assert np.array(frames.origins) == pytest.approx(np.array(modes.origins), abs=1e-16)
    assert np.array(frames.rotations) == pytest.approx(np.array(modes.rotations), abs=1e-16)


@pytest.mark.parametrize("folds", FOLDS)
@pytest.mark.parametrize("gap", [0.0, 0.001])
def test_hinge_moments_are_the_work_of_folding(folds, gap):
    """Turning a hinge moves every panel outboard of it: moment = work / angle."""
    model, angles, step = wing(gap=gap), np.radians(folds), 1e-5
    loads = wing_loads(model, angles, 0.07, 12.0)
    force = model.air.density * 12.0**2 * loads.lattice.forces

    def middles(moved):
        panels = strip_panels(wing_strips(model, moved), 4)
        return (panels.inner + panels.outer) / 2.0

    for hinge, moment in enumerate(loads.hinge_moments):
        turn = step * np.eye(2)[hinge]
        work = np.sum(force * (middles(angles + turn) - middles(angles - turn)))
        assert moment == pytest.approx(work / (2.0 * step), rel=1e-6, abs=1e-10)


@pytest.mark.parametrize("folds", FOLDS)
def test_moments_of_the_wing_are_the_work_of_turning_it(folds):
    model, angles = wing(), np.radians(folds)
    loads = wing_loads(model, angles, 0.07, 12.0)
    force = model.air.density * 12.0**2 * loads.lattice.forces
    x, y, z = loads.lattice.places.T
    nose_up = np.sum(force * np.stack([z, 0.0 * x, -x], axis=1))
    tip_up = np.sum(force * np.stack([0.0 * x, -z, y], axis=1))
    assert loads.pitching_moment == pytest.approx(nose_up, rel=1e-12)
    assert loads.root_moment == pytest.approx(tip_up, rel=1e-12)
    assert loads.aerodynamic_centre == pytest.approx(0.4 - nose_up / loads.lift / 0.05, rel=1e-12)


@pytest.mark.parametrize("folds", FOLDS)
def test_segment_loads_in_the_plane_of_the_unfolded_segment(folds):
    model = wing((0.05, 0.04, 0.07))
    loads = wing_loads(model, np.radians(folds), 0.07, 12.0)
    panels, density = loads.lattice.panels, model.air.density
    normal = density * 12.0**2 * np.einsum("nk,nk->n", loads.lattice.forces, panels.normals)
    of_panel = np.tile(panels.segment, panels.rows)
    for index, (mesh, segment) in enumerate(zip(mesh_segments(model), loads.segments, strict=True)):
        x, y = mesh.points(mesh.station(0.25))
        N, shape = normal[of_panel == index], model.segments[index]
        assert segment.normal_force == pytest.approx(N.sum(), rel=1e-12)
        assert segment.pitching_moment == pytest.approx(-N @ x, rel=1e-9, abs=1e-14)
        assert segment.bending_moment == pytest.approx(N @ y, rel=1e-9, abs=1e-14)
        centre = (segment.centre_x - 0.4) * shape.chord, segment.centre_y * shape.span
        assert np.array(centre) * N.sum() == pytest.approx([N @ x, N @ y], rel=1e-9, abs=1e-14)


def test_areas_and_coefficients():
    loads = wing_loads(wing((0.05, 0.04, 0.07)), np.radians((60.0, 120.0)), 0.1, 10.0)
    areas = 0.14 * 0.05, 0.10 * 0.04, 0.06 * 0.07
    assert loads.area == pytest.approx(sum(areas))
    assert loads.projected_area == pytest.approx(areas[0] + 0.5 * areas[1] + areas[2])
    assert loads.projected_lift_slope * loads.projected_area == pytest.approx(
        loads.lift_slope * loads.area
    )
    assert loads.lift_coefficient == pytest.approx(loads.lift / (0.5 * 1.2 * 100.0 * sum(areas)))
    assert loads.lift_coefficient == pytest.approx(0.1 * loads.lift_slope)
