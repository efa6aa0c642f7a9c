"""Where the energy of flutter enters: what the air feeds in is what is taken away."""

import numpy as np
import pytest

from foldwing.aeroelastic.loads import Motions, loads_of
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.studies.case import solve_case
from foldwing.studies.speeds import speed_range

MODELS = ["strip", "quasi-steady", "lattice"]
MESH = {"chordwise": 4, "spanwise": 9, "wake": 6.0}


def solved(aerodynamics, folds=(30.0, -75.0), mesh=MESH, **analysis):
    wing = read_model("three-segment").with_analysis(system_modes=6, **analysis)
    model = AeroelasticWing(wing.with_lattice(**mesh), aerodynamics)
    case = solve_case(model, folds, speed_range(model, 60.0))
    points = case.analysis.points
    p = np.array([point.p for point in points], complex)
    speed = np.array([point.speed for point in points])
    motions = Motions(p, speed, case.motions())
    return case, motions, loads_of(model, case.modes, motions)


def of_flutter(case):
    flutter = np.array([point.kind == "flutter" for point in case.analysis.points])
    assert flutter.any()
    return flutter


@pytest.mark.parametrize("aerodynamics", ["strip", "lattice"])
def test_at_flutter_the_segments_together_do_no_work(aerodynamics):
    case, _, loads = solved(aerodynamics)
    work = loads.work_by_segment[of_flutter(case)]
    assert (np.abs(work.sum(axis=1)) < 1e-9 * np.abs(work).max(axis=1)).all()
    assert (np.abs(work).max(axis=1) > 1e-3 * loads.kinetic_energy[of_flutter(case)]).all()


def test_trapezoidal_steps_of_time_add_no_damping():
    case, _, loads = solved("lattice", mesh={**MESH, "scheme": "average"})
    work = loads.work_by_segment[of_flutter(case)]
    assert (np.abs(work.sum(axis=1)) < 1e-9 * np.abs(work).max(axis=1)).all()


@pytest.mark.parametrize("aerodynamics", MODELS)
def test_the_air_feeds_in_what_structural_damping_dissipates(aerodynamics):
    """A damper of coefficient c takes pi c omega |q|^2 over a cycle of amplitude |q|."""
    zeta = 0.004
    case, motions, loads = solved(aerodynamics, damping=zeta)
    omega = motions.p.imag * motions.speed / loads.half_chord
    coefficients = 2.0 * zeta * case.modes.omega
    dissipated = np.pi * omega * (np.abs(motions.q) ** 2 @ coefficients)
    flutter = of_flutter(case)
    work = loads.work_by_segment[flutter]
    assert work.sum(axis=1) == pytest.approx(dissipated[flutter], rel=1e-7)


@pytest.mark.parametrize("aerodynamics", ["strip", "lattice"])
def test_divergence_has_no_cycle_and_no_work(aerodynamics):
    case, _, loads = solved(aerodynamics)
    still = ~of_flutter(case)
    assert still.any()
    assert np.isnan(loads.work_by_segment[still]).all()
    assert np.isnan(loads.work_between_modes[still]).all()
    assert np.isnan(loads.kinetic_energy[still]).all()


@pytest.mark.parametrize("aerodynamics", ["strip", "lattice"])
def test_work_is_the_power_of_the_forces_over_a_cycle(aerodynamics):
    case, motions, loads = solved(aerodynamics)
    index = int(np.flatnonzero(of_flutter(case))[0])
    phase = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    turning = np.exp(1j * phase)[:, None]
    q = motions.q[index]
    velocity = (1j * turning * q).real  # per radian
    for segment in range(3):
        on_modes = motions.speed[index] ** 2 * loads.forces[index, segment] @ q
        power = ((turning * on_modes).real * velocity).sum(axis=1)
        work = power.mean() * 2.0 * np.pi
        assert loads.work_by_segment[index, segment] == pytest.approx(work, rel=1e-9)


@pytest.mark.parametrize("aerodynamics", ["strip", "lattice"])
def test_work_between_modes_adds_up_and_does_not_depend_on_phase(aerodynamics):
    case, motions, loads = solved(aerodynamics)
    flutter = of_flutter(case)
    total = loads.work_by_segment[flutter].sum(axis=1)
    pairs = loads.work_between_modes[flutter]
    size = np.abs(pairs).max(axis=(1, 2))
    assert (np.abs(pairs.sum(axis=(1, 2)) - total) < 1e-12 * size).all()
    turned = Motions(motions.p, motions.speed, motions.q * np.exp(0.7j))
    again = type(loads)(turned, loads.half_chord, loads.forces).work_between_modes[flutter]
    assert np.abs(again - pairs).max() < 1e-12 * size.max()


def test_a_wing_folded_down_has_the_loads_of_one_folded_up():
    """In the mirror z -> -z motion up is motion down, pressure changes its sign with it."""
    _, motions, up = solved("lattice")
    _, _, down = solved("lattice", folds=(-30.0, 75.0))
    size = np.nanmax(np.abs(up.work_by_segment))
    assert np.abs(np.nan_to_num(up.work_by_segment - down.work_by_segment)).max() < 1e-7 * size
    p_up, p_down = np.abs(up.pressure()), np.abs(down.pressure())
    assert np.abs(p_up - p_down).max() < 1e-7 * p_up.max()
    assert len(motions.p) > 1


def test_pressures_of_the_modes_add_up():
    _, _, loads = solved("lattice")
    each = loads.pressure_of_modes(0)
    assert each.sum(axis=0) == pytest.approx(loads.pressure()[0], rel=1e-10)
    assert loads.mode_shares.sum(axis=1) == pytest.approx(1.0)


def test_strip_theory_has_no_panels():
    _, _, loads = solved("strip")
    with pytest.raises(ValueError, match="panels"):
        loads.pressure()
