"""What holds for any rigid aircraft."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.flight import (
    dimensionless,
    flight_modes,
    flight_path,
    stability_derivatives,
    state_matrix,
    static_margin,
)
from foldwing.flight.rows import model_rows
from foldwing.model import Airframe, Surface

numbers = st.floats
surfaces = st.builds(
    Surface,
    span=numbers(2.0, 40.0),
    chord=numbers(0.3, 4.0),
    span_efficiency=numbers(0.5, 1.0),
    lift_slope=st.none() | numbers(2.0, 6.3),
)
aircraft = st.builds(
    Airframe,
    mass=numbers(50.0, 1e5),
    pitch_inertia=numbers(50.0, 1e6),
    speed=numbers(10.0, 250.0),
    centre_of_gravity=numbers(-1.0, 1.0),
    tail_arm=numbers(2.0, 30.0),
    wing=surfaces,
    tail=surfaces,
    zero_lift_drag=numbers(0.0, 0.1),
    drag=st.booleans(),
    density=numbers(0.1, 1.3),
)


def rates(matrix):
    """Coefficients of the characteristic polynomial: they change smoothly where roots do not."""
    return np.poly(matrix)


@given(aircraft, numbers(0.01, 100.0))
def test_dimensionless_equations_have_the_same_eigenvalues_for_any_length(craft, length):
    unit = craft.speed / length
    wanted = rates(state_matrix(craft)) / unit ** np.arange(5)
    scale = np.abs(np.linalg.eigvals(state_matrix(craft))).max() / unit
    found = rates(dimensionless(craft, length).matrix)
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12 * max(1.0, scale) ** 4)


@given(aircraft, numbers(0.1, 10.0))
def test_models_of_another_scale_fly_alike(craft, s):
    """Froude: lengths grow by s, speeds by its root, and every motion takes its root longer."""
    part = {
        name: getattr(craft, name).model_copy(
            update={
                "span": getattr(craft, name).span * s, "chord": getattr(craft, name).chord * s,
            }
        )
        for name in ("wing", "tail")
    }  # fmt: skip
    larger = craft.model_copy(
        update={
            **part,
            "mass": craft.mass * s**3,
            "pitch_inertia": craft.pitch_inertia * s**5,
            "speed": craft.speed * s**0.5,
            "tail_arm": craft.tail_arm * s,
            "centre_of_gravity": craft.centre_of_gravity * s,
        }
    )
    wanted = rates(state_matrix(craft))
    found = rates(state_matrix(larger)) * s ** (np.arange(5) / 2.0)
    scale = np.abs(np.linalg.eigvals(state_matrix(craft))).max()
    assert found == pytest.approx(wanted, rel=1e-8, abs=1e-11 * scale**4)
    assert static_margin(larger) == pytest.approx(static_margin(craft), rel=1e-9, abs=1e-12)


@given(aircraft)
def test_the_margin_has_the_sign_of_the_moment(craft):
    margin, moment = static_margin(craft), stability_derivatives(craft).M_w
    assert np.sign(moment) == -np.sign(margin) or abs(margin) < 1e-12


@given(aircraft)
def test_every_eigenvalue_is_named_once(craft):
    row = next(model_rows(craft))
    found = sorted((value for _, value in row.roots), key=lambda v: (v.real, v.imag))
    wanted = sorted(np.linalg.eigvals(state_matrix(craft)), key=lambda v: (v.real, v.imag))
    scale = max(map(abs, wanted))
    assert len(found) == 4
    assert np.array(found) == pytest.approx(np.array(wanted), rel=1e-6, abs=1e-6 * scale)


@given(aircraft)
def test_paths_are_finite_and_small(craft):
    for motion in flight_modes(state_matrix(craft)):
        path = flight_path(motion, craft.speed)
        assert np.isfinite([path.time, path.ahead, path.altitude, path.pitch]).all()
        assert np.abs(path.pitch).max() <= 0.1 + 1e-9


@given(aircraft)
def test_airspeed_and_drag_are_changed_in_copies(craft):
    assert craft.flown_at(33.0).flown_at(craft.speed) == craft
    assert stability_derivatives(craft.without_drag()).X_u == 0.0
