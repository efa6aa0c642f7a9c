"""Wings at the edge of what is built: the search ends, and what it certifies is true."""

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Air, Hinge, Segment, Wing, read_model
from foldwing.stability.domains import Rectangle
from foldwing.stability.rootfinding import count_roots
from foldwing.stability.spectrum import at_speed
from foldwing.studies.case import solve_case
from foldwing.studies.speeds import speed_range

HEAVY_AIR = Wing(
    segments=(
        Segment(
            span=0.844,
            chord=0.186,
            bending_stiffness=21.6,
            torsion_stiffness=1340.0,
            mass_per_span=1.11,
            inertia_per_span=0.0177,
            mass_centre=0.0,
            lift_slope=4.4,
        ),
        Segment(
            span=0.758,
            chord=0.186,
            bending_stiffness=0.579,
            torsion_stiffness=26.3,
            mass_per_span=0.1104,
            inertia_per_span=0.000241,
        ),
    ),
    hinges=(Hinge(stiffness=0.0959, fold=180.0),),
    air=Air(density=25.28),
).with_analysis(basis="converged")


def solved(model):
    folds = tuple(float(np.degrees(angle)) for angle in model.wing.fold_angles)
    return solve_case(model, folds, speed_range(model))


@pytest.mark.parametrize("basis", ["free-free", "converged"])
@pytest.mark.parametrize("axis", [0.0, 0.1, 0.24, 0.25, 0.26])
def test_an_axis_near_the_quarter_chord_has_a_sane_range(axis, basis):
    """Without divergence round-off must not pass for a divergence speed of 1e6 m/s."""
    goland = read_model("goland")
    segment = goland.segments[0].model_copy(
        update={"elastic_axis": axis, "mass_centre": min(axis + 0.1, 0.35)}
    )
    wing = Wing(segments=(segment,), air=goland.air).with_analysis(basis=basis)
    case = solved(AeroelasticWing(wing))
    assert case.analysis.speed_range[1] < 5000.0
    assert case.analysis.certified
    assert case.analysis.critical.kind == "flutter"
    assert 150.0 < case.analysis.critical.speed < 700.0


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady"])
def test_roots_that_grow_fast_are_counted(aerodynamics):
    """Without apparent mass roots grow far beyond the usual region; none may be left out."""
    case = solved(AeroelasticWing(HEAVY_AIR, aerodynamics))
    assert case.analysis.certified
    points = case.analysis.points
    start = case.analysis.unstable_from_start
    for speed in (3.3, 29.6):
        below = [p for p in points if p.speed < speed and p.event != "merger"]
        jumps = [
            (2 if p.kind == "flutter" else 1) * (1 if p.event == "onset" else -1) for p in below
        ]
        function = at_speed(case.system, speed)
        oscillating = count_roots(function, Rectangle((1e-7, 40.0), (1e-4, 400.0)))
        real = count_roots(function, Rectangle((1e-7, 40.0), (-1e-4, 1e-4)))
        assert 2 * oscillating + real == start + sum(jumps)


def test_a_free_flap_without_twist_is_neutral():
    """Modes that carry no twist have no steady force at all: round-off must not hide that."""
    section = {
        "chord": 0.1,
        "bending_stiffness": 0.5,
        "torsion_stiffness": 500.0,
        "mass_per_span": 0.2,
        "inertia_per_span": 1.7e-4,
        "elastic_axis": 0.4,
        "mass_centre": 0.4,
    }
    wing = Wing(
        segments=(Segment(span=0.5, **section), Segment(span=0.4, **section)),
        hinges=(Hinge(kind="free"),),
    ).with_analysis(system_modes=4)
    case = solved(AeroelasticWing(wing))
    assert case.system.neutral.tolist() == [True, False, False, False]
    assert case.analysis.certified
