"""What holds for the steady lattice of any wing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foldwing.aerodynamics.lattice import closeness
from foldwing.aerodynamics.panels import strip_panels
from foldwing.aerodynamics.steady import at_unit_angle, solve_steady
from foldwing.aerodynamics.steady_loads import wing_loads, wing_strips
from foldwing.model import Wing, read_model

WING = read_model("three-segment").with_lattice(chordwise=2, spanwise=12)
angles = st.floats(-150.0, 150.0)
folds = st.tuples(angles, angles).map(np.radians)


def far_apart(strips):
    """Whether segments keep a third of a strip from the middles of each other's strips."""
    return closeness(strips).ratio > 0.35


@given(fold=folds, gap=st.sampled_from([0.0, 0.001]), image=st.booleans())
def test_drag_is_never_below_the_least_of_the_shape(fold, gap, image):
    wing = WING.with_gaps(gap).with_lattice(image=image)
    strips = wing_strips(wing, fold)
    if closeness(strips).ratio < 1e-3:
        return
    loads = wing_loads(wing, fold, 0.1, 1.0)
    assert far_apart(strips) <= np.isfinite(loads.efficiency)
    if np.isfinite(loads.efficiency):
        assert 0.0 < loads.efficiency <= 1.0 + 1e-12
        assert loads.induced_drag * (1.0 + 1e-12) >= loads.least_drag > 0.0


@given(fold=folds, image=st.booleans())
def test_segments_add_up_to_the_wing(fold, image):
    loads = wing_loads(WING.with_lattice(image=image), fold, 0.1, 15.0)
    assert sum(s.lift for s in loads.segments) == pytest.approx(loads.lift, abs=1e-12)
    assert sum(s.side_force for s in loads.segments) == pytest.approx(loads.side_force, abs=1e-12)
    tilt = np.cos(np.cumsum([0.0, *fold]))
    lifts = [s.normal_force * c for s, c in zip(loads.segments, tilt, strict=True)]
    assert sum(lifts) == pytest.approx(loads.lift, abs=1e-12)
    assert loads.segments[2].bending_moment == pytest.approx(loads.hinge_moments[1], abs=1e-12)


@given(fold=folds, turn=st.floats(-np.pi, np.pi))
def test_turning_wing_and_wash_together_changes_nothing(fold, turn):
    """Past upright and upside down too."""
    panels = strip_panels(wing_strips(WING, fold), 2)
    if not far_apart(wing_strips(WING, fold)):
        return
    wash = np.sin(np.arange(len(panels.points)))
    still, turned = (solve_steady(each, wash) for each in (panels, panels.turned(turn)))
    scale = abs(still.circulation).max()
    assert turned.circulation == pytest.approx(still.circulation, abs=1e-11 * scale)
    assert turned.induced_drag == pytest.approx(still.induced_drag, rel=1e-11)
    back = strip_panels(wing_strips(WING, fold).turned(turn), 2)
    assert back.points == pytest.approx(panels.turned(turn).points, abs=1e-15)


@given(first=st.floats(-120.0, 120.0), second=angles)
def test_image_is_the_other_half(first, second):
    """Below 120 degrees no segment reaches the wall."""
    strips = wing_strips(WING, np.radians((first, second)))
    if not far_apart(strips):
        return
    panels = strip_panels(strips, 2)
    half = at_unit_angle(panels, image=True)
    whole = at_unit_angle(panels.mirrored().joined(panels))
    scale = abs(half.circulation).max()
    both = whole.circulation.reshape(2, 2, -1)
    for side in (0, 1):
        assert both[:, side].ravel() == pytest.approx(half.circulation, abs=1e-12 * scale)
    assert whole.total[2] == pytest.approx(2.0 * half.total[2], rel=1e-12)
    assert whole.induced_drag == pytest.approx(2.0 * half.induced_drag, rel=1e-12)
    assert whole.efficiency == pytest.approx(half.efficiency, rel=1e-9)


@given(fold=folds)
def test_mirrored_wings_are_equal(fold):
    panels = strip_panels(wing_strips(WING, fold), 2)
    if not far_apart(wing_strips(WING, fold)):
        return
    first, second = at_unit_angle(panels), at_unit_angle(panels.mirrored())
    scale = abs(first.circulation).max()
    assert second.circulation == pytest.approx(first.circulation, abs=1e-12 * scale)
    assert second.total * [1.0, -1.0, 1.0] == pytest.approx(first.total, abs=1e-12)


@given(fold=folds, alpha=st.floats(-0.3, 0.3), speed=st.floats(1.0, 100.0))
@settings(max_examples=25)
def test_loads_are_linear_in_the_angle_and_quadratic_in_the_speed(fold, alpha, speed):
    unit, loads = wing_loads(WING, fold, 1.0, 1.0), wing_loads(WING, fold, alpha, speed)
    assert loads.lift == pytest.approx(alpha * speed**2 * unit.lift, rel=1e-12, abs=1e-12)
    assert loads.induced_drag == pytest.approx(
        (alpha * speed) ** 2 * unit.induced_drag, rel=1e-12, abs=1e-12
    )
    assert loads.lift_slope == unit.lift_slope


def test_a_fold_of_nothing_is_a_flat_wing():
    """Three segments in line are one, strip for strip."""
    folded = wing_loads(WING.with_lattice(spanwise=(14, 10, 6)), (0.0, 0.0), 0.1, 10.0)
    whole = WING.segments[0].model_copy(update={"span": 0.30})
    flat = Wing(segments=(whole,), air=WING.air).with_lattice(chordwise=2, spanwise=30)
    alone = wing_loads(flat, (), 0.1, 10.0)
    assert folded.lift == pytest.approx(alone.lift, rel=1e-12)
    assert folded.induced_drag == pytest.approx(alone.induced_drag, rel=1e-12)
    assert folded.pitching_moment == pytest.approx(alone.pitching_moment, rel=1e-12)
    assert folded.root_moment == pytest.approx(alone.root_moment, rel=1e-12)


@pytest.mark.parametrize("fold", [30.0, 90.0, -120.0])
def test_folding_a_tiny_tip_hardly_matters(fold):
    spans = (0.14, 0.1599, 1e-4)
    segments = tuple(
        segment.model_copy(update={"span": span})
        for segment, span in zip(WING.segments, spans, strict=True)
    )
    wing = WING.model_copy(update={"segments": segments}).with_lattice(spanwise=(6, 6, 1))
    flat, folded = (wing_loads(wing, (0.0, np.radians(angle)), 0.1, 10.0) for angle in (0.0, fold))
    assert folded.lift == pytest.approx(flat.lift, rel=2e-3)
    assert folded.lift != flat.lift
    assert folded.hinge_moments[0] == pytest.approx(flat.hinge_moments[0], rel=5e-3)


@pytest.mark.parametrize("tip", [0.0, -60.0, -90.0, -120.0])
def test_gaps_lower_the_lift_of_a_level_tip(tip):
    fold = np.radians((-tip, tip))
    lift = [wing_loads(WING.with_gaps(gap), fold, 0.1, 10.0).lift for gap in (0.0, 0.001, 0.004)]
    assert lift == sorted(lift, reverse=True)
    assert lift[2] < 0.99 * lift[0]


def test_lift_acts_up_and_folds_up():
    loads = wing_loads(WING, (0.0, 0.0), 0.1, 10.0)
    assert min(loads.lift, loads.root_moment, *loads.hinge_moments) > 0.0
    down = wing_loads(WING, (0.0, 0.0), -0.1, 10.0)
    assert max(down.lift, down.root_moment, *down.hinge_moments) < 0.0
    assert down.induced_drag == pytest.approx(loads.induced_drag, rel=1e-12)


def test_dihedral_pushes_inboard():
    """The load of an upward fold leans towards the root."""
    assert wing_loads(WING, np.radians((30.0, 0.0)), 0.1, 10.0).side_force < 0.0
