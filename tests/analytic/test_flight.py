"""Flight of a rigid aircraft against closed forms and differenced forces."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from foldwing.errors import InputError
from foldwing.flight import (
    Motion,
    dimensionless,
    flight_modes,
    flight_path,
    mode_row,
    neutral_point,
    simple_phugoid,
    stability_derivatives,
    state_matrix,
    static_margin,
    trimmed,
)
from foldwing.flight.phugoid import drag_over_lift
from foldwing.model import Surface
from foldwing.studies.flight import flight_study
from support.aircraft import Nonlinear, airframe

CRAFT = {
    "as printed": airframe(),
    "centre of gravity aft": airframe(centre_of_gravity=0.3),
    "centre of gravity ahead": airframe(centre_of_gravity=-0.4, speed=31.0),
    "without drag": airframe(drag=False, centre_of_gravity=0.2),
    "unlike surfaces": airframe(
        wing=Surface(span=9.0, chord=1.1, span_efficiency=0.8, lift_slope=5.0),
        tail=Surface(span=4.0, chord=0.6, span_efficiency=0.6),
        centre_of_gravity=0.45,
    ),
}


@pytest.fixture(name="craft", params=CRAFT.values(), ids=CRAFT.keys())
def _craft(request):
    return request.param


# ------------------------------------------------------------------------- forces and derivatives


def test_forces_balance_in_trim(craft):
    trim, model = trimmed(craft), Nonlinear(craft)
    assert [trim.wing_lift, trim.tail_lift] == pytest.approx(model.trim_lift(), rel=1e-12)
    X, Z, M = model.forces(craft.speed, 0.0, 0.0)
    pressure = 0.5 * craft.density * craft.speed**2 * craft.wing.area
    weight = craft.mass * craft.gravity
    assert -Z == pytest.approx(weight) and -Z == pytest.approx(pressure * trim.lift)
    assert -X == pytest.approx(pressure * trim.drag, abs=1e-9)
    assert abs(M) < 1e-9 * weight


def test_derivatives_are_those_of_the_forces(craft):
    model, V = Nonlinear(craft), craft.speed
    steps = {"u": (1e-3, 0.0, 0.0), "w": (0.0, 1e-3, 0.0), "q": (0.0, 0.0, 1e-4)}
    d = stability_derivatives(craft)
    ours = {
        "u": (d.X_u, d.Z_u, d.M_u),
        "w": (d.X_w, d.Z_w, d.M_w),
        "q": (0.0, d.Z_q, d.M_q),
    }
    for name, step in steps.items():
        up = np.array(model.forces(V + step[0], step[1], step[2]))
        down = np.array(model.forces(V - step[0], -step[1], -step[2]))
        wanted = (up - down) / (2.0 * sum(step))
        assert ours[name] == pytest.approx(wanted, rel=1e-6, abs=1e-5), name


def test_state_matrix_is_the_jacobian_of_the_equations_of_motion(craft):
    wanted = Nonlinear(craft).jacobian()
    assert state_matrix(craft) == pytest.approx(wanted, rel=1e-6, abs=1e-7)


def test_signs():
    d = stability_derivatives(airframe())
    assert d.X_u < 0 and d.Z_u < 0 and d.Z_w < 0 and d.Z_q < 0 and d.M_w < 0 and d.M_q < 0
    assert d.X_w > 0  # the lift leans forward by more than the drag grows


# ----------------------------------------------------------------------------------- the phugoid


def test_simple_phugoid_without_drag():
    root, conjugate = simple_phugoid(0.0, 54.0, 9.81)
    assert root == np.conj(conjugate) == pytest.approx(1j * math.sqrt(2.0) * 9.81 / 54.0)
    assert root.real == 0.0


@pytest.mark.parametrize("ratio", [0.05, 0.5, 1.4, 1.5, 3.0])
def test_simple_phugoid_balances_forces_along_and_across_the_path(ratio):
    V, g = 40.0, 9.81
    matrix = g * np.array([[-2.0 * ratio / V, -1.0], [2.0 / V**2, 0.0]])  # dV, path angle
    wanted = sorted(np.linalg.eigvals(matrix).astype(complex), key=lambda v: (v.real, v.imag))
    roots = sorted(simple_phugoid(ratio, V, g), key=lambda v: (v.real, v.imag))
    assert roots == pytest.approx(wanted)
    assert (roots[0].imag == 0.0) is (ratio > math.sqrt(2.0))


def test_drag_over_lift_is_that_of_the_trim(craft):
    trim = trimmed(craft)
    assert drag_over_lift(craft) == pytest.approx(trim.drag / trim.lift, abs=1e-15)


def test_heavy_aircraft_approach_the_simple_phugoid():
    """The angle of attack stays when the tail turns the aircraft along its path at once."""
    errors = []
    for mass in (1e3, 4e3, 16e3, 64e3):
        craft = airframe(drag=False, mass=mass)
        (phugoid, _) = flight_modes(state_matrix(craft))
        wanted = math.sqrt(2.0) * craft.gravity / craft.speed
        errors.append(abs(phugoid.eigenvalue / (1j * wanted) - 1.0))
    ratios = np.array(errors[1:]) / errors[:-1]
    assert ratios == pytest.approx(0.25, rel=0.12)


# ------------------------------------------------------------------------------- static stability


def test_no_margin_no_moment_and_a_root_at_zero(craft):
    neutral = neutral_point(craft)
    there = craft.model_copy(update={"centre_of_gravity": neutral})
    scale = abs(stability_derivatives(craft.model_copy(update={"centre_of_gravity": 0.0})).M_w)
    assert static_margin(there) == 0.0
    assert abs(stability_derivatives(there).M_w) < 1e-12 * scale
    assert min(abs(m.eigenvalue) for m in flight_modes(state_matrix(there))) < 1e-9


@pytest.mark.parametrize("margin", [0.3, 0.01, -0.01, -0.3])
def test_a_negative_margin_is_an_aperiodic_motion_that_grows(margin):
    neutral = neutral_point(airframe())
    craft = airframe(centre_of_gravity=neutral - margin * 1.524)
    assert static_margin(craft) == pytest.approx(margin)
    assert (stability_derivatives(craft).M_w < 0.0) is (margin > 0.0)
    growing = [m for m in flight_modes(state_matrix(craft)) if m.growth > 0 and not m.oscillates]
    assert len(growing) == (margin < 0.0)


# ------------------------------------------------------------------------------- names and numbers


def matrix_of(*eigenvalues):
    """A full real matrix with the given eigenvalues; of a pair one is given."""
    blocks = np.zeros((4, 4))
    at = 0
    for value in map(complex, eigenvalues):
        if value.imag:
            blocks[at : at + 2, at : at + 2] = [[value.real, value.imag], [-value.imag, value.real]]
        else:
            blocks[at, at] = value.real
        at += 1 + (value.imag != 0.0)
    turn = np.random.default_rng(1).normal(size=(4, 4))
    return turn @ blocks @ np.linalg.inv(turn)


P, S, T = "phugoid", "short period", "third oscillation"


@pytest.mark.parametrize(
    ("roots", "names"),
    [
        ([-6 + 9j, -0.02 + 0.2j], {-0.02 + 0.2j: P, -6 + 9j: S}),
        ([-6 + 9j, 0.1, -0.2], {0.1: P, -0.2: P, -6 + 9j: S}),
        ([-0.02 + 0.2j, 1.0, -12.0], {-0.02 + 0.2j: P, 1.0: S, -12.0: S}),
        ([0.25, -9.0, -0.6 + 0.2j], {0.25: P, -0.6 + 0.2j: T, -9.0: S}),
        ([0.1, -0.2, -3.0, -8.0], {0.1: P, -0.2: P, -3.0: S, -8.0: S}),
    ],
)
def test_modes_are_named_from_slow_to_fast(roots, names):
    motions = flight_modes(matrix_of(*roots))
    assert [m.mode for m in motions] == [names[root] for root in sorted(names, key=abs)]
    for motion in motions:
        nearest = min(names, key=lambda root: abs(root - motion.eigenvalue))
        assert abs(nearest - motion.eigenvalue) < 1e-9
        assert names[nearest] == motion.mode


def test_shapes_are_eigenvectors(craft):
    A = state_matrix(craft)
    for motion in flight_modes(A):
        x = np.array(motion.shape)
        assert motion.eigenvalue * x == pytest.approx(A @ x, rel=1e-9, abs=1e-9)
        assert x[3] == pytest.approx(1.0)


@pytest.mark.parametrize("value", [-0.02 + 0.23j, 0.004 + 0.3j, -6.2 + 9.2j])
def test_what_is_told_of_an_oscillation(value):
    motion = Motion("phugoid", value)
    turned = np.exp(value * motion.period)
    assert turned.imag == pytest.approx(0.0, abs=1e-12) and turned.real > 0.0
    time = motion.time_to_half if value.real < 0 else motion.time_to_double
    assert abs(np.exp(value * time)) == pytest.approx(0.5 if value.real < 0 else 2.0)
    assert math.isnan(motion.time_to_double if value.real < 0 else motion.time_to_half)
    assert time == pytest.approx(motion.cycles * motion.period)
    natural = abs(value)
    # roots of s^2 + 2 zeta omega s + omega^2
    assert value**2 + 2 * motion.damping_ratio * natural * value + natural**2 == pytest.approx(0)


def test_what_is_told_of_an_aperiodic_motion():
    growing = Motion("phugoid", complex(0.25))
    assert growing.time_to_double == pytest.approx(2.7726, rel=1e-4)
    neutral = Motion("phugoid", complex(0.0))
    for name in ("period", "damping_ratio", "time_to_half", "cycles"):
        assert math.isnan(getattr(growing, name)) and math.isnan(getattr(neutral, name))
    assert math.isnan(neutral.time_to_double)


# ----------------------------------------------------------------------------------- flight paths


@pytest.mark.parametrize("x", [0.0, 0.55, 0.6, "neutral"])
def test_paths_follow_from_the_motion(x):
    """The states at any time come from the matrix exponential; the path is their integral."""
    craft = airframe(centre_of_gravity=neutral_point(airframe()) if x == "neutral" else x)
    A, V = state_matrix(craft), craft.speed
    for motion in flight_modes(A):
        if abs(motion.shape[3] - 1.0) > 1e-9:
            continue  # at the neutral point two motions do not pitch
        path = flight_path(motion, V)
        start = np.array(motion.shape).real * path.pitch[0]
        step = expm(A * (path.time[1] - path.time[0]))
        states = [start]
        for _ in path.time[1:]:
            states.append(step @ states[-1])
        u, w, _, theta = np.array(states).T
        if not motion.oscillates:
            assert path.ahead[0] == path.altitude[0] == 0.0
        largest = max(np.abs(u).max() / V, np.abs(w).max() / V, np.abs(theta).max())
        assert 0.08 < largest < 0.1 + 1e-9
        assert path.pitch == pytest.approx(theta, abs=1e-6)
        for got, wanted in ((path.ahead, u), (path.altitude, V * theta - w)):
            rate = np.gradient(got, path.time)[1:-1]
            assert rate == pytest.approx(wanted[1:-1], abs=4e-3 * np.abs(wanted).max())
        assert path.distance == pytest.approx(V * path.time + path.ahead)


def test_an_oscillation_goes_on_around_the_steady_point():
    """After a cycle it is where it was, only nearer: there is no drift."""
    (phugoid, _) = flight_modes(state_matrix(airframe()))
    path = flight_path(phugoid, 54.0)
    cycle = len(path.time) // 2
    assert path.time[cycle] == pytest.approx(phugoid.period)
    left = np.exp(phugoid.growth * phugoid.period)
    for values in (path.ahead, path.altitude, path.pitch):
        assert values[cycle:] == pytest.approx(left * values[: cycle + 1])


def test_a_phugoid_climbs_where_it_slows_down():
    (phugoid, _) = flight_modes(state_matrix(airframe(drag=False)))
    path = flight_path(phugoid, 54.0)
    top, bottom = path.altitude.argmax(), path.altitude.argmin()
    forward = np.gradient(path.ahead, path.time)
    assert forward[top] < 0.0 < forward[bottom]
    energy = 0.5 * (54.0 + forward) ** 2 + 9.81 * path.altitude
    assert np.ptp(energy) < 0.1 * np.ptp(9.81 * path.altitude)


# ---------------------------------------------------------------------------- several models


def test_rows_of_other_models_stand_beside():
    rows = [
        mode_row("from elsewhere", 54.0, -0.01 + 0.22j, (-6 + 9j, -6 - 9j)),
        mode_row("from elsewhere", 30.0, (0.1, -0.2)),
    ]
    study = flight_study(airframe(), speeds=(30.0, 54.0), comparisons=rows)
    found = study.dataset.sel(flight_model="from elsewhere")
    values = found["flight_eigenvalue"].values
    assert values.tolist() == [-0.01 + 0.22j, -0.01 - 0.22j, -6 + 9j, -6 - 9j]
    assert found["flight_mode"].values.tolist() == [P, P, S, S]
    swept = found["swept_eigenvalue"].values
    assert swept[0, :2].tolist() == [0.1, -0.2] and np.isnan(swept[0, 2:]).all()
    assert swept[1].tolist() == values.tolist()
    assert found["phugoid_product"].values[1] == pytest.approx(0.22 * 54.0)


def test_rows_at_another_airspeed_are_refused():
    row = mode_row("from elsewhere", 55.0, -0.01 + 0.22j)
    with pytest.raises(InputError, match=r"comparisons: got 55.0"):
        flight_study(airframe(), comparisons=[row])


def test_product_of_frequency_and_airspeed_hardly_changes():
    dataset = flight_study(airframe(drag=False), speeds=(30.0, 54.0, 80.0)).dataset
    product = dataset["phugoid_product"].values
    assert product[0] == pytest.approx(product[0].mean(), rel=0.005)
    simple = dataset.sel(flight_model="simple phugoid")["phugoid_product"].values
    assert simple == pytest.approx(math.sqrt(2.0) * 9.81)


def test_dimensionless_coefficients():
    equations = dimensionless(airframe())
    trim = trimmed(airframe())
    assert equations.mass_ratio == pytest.approx(1020.0 / (1.2 * 10.9728 * 1.524 * 1.524))
    assert equations.gyration_squared == pytest.approx(838.0 / (1020.0 * 1.524**2))
    assert equations.right[0, 0] == -trim.drag and equations.right[1, 0] == -trim.lift
    # weight over dynamic pressure: mu g c / U^2 is half the lift coefficient
    assert equations.right[0, 3] == pytest.approx(-trim.lift / 2.0)
