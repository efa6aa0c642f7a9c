"""One aircraft by the three forms of a model, and in a simulation of the nonlinear equations."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from foldwing.flight import (
    flight_modes,
    flight_path,
    stability_derivatives,
    state_matrix,
)
from foldwing.flight.phugoid import drag_over_lift
from foldwing.model import example_text, parse_flight, parse_model
from foldwing.studies.multibody import airframe_of, multibody_rows
from support.aircraft import Nonlinear, airframe

CESSNA = example_text("cessna-172")
SEGMENTED = example_text("three-segment-aircraft")


def by_derivatives(craft):
    d = stability_derivatives(craft)
    units = {"Z_q": "N*s", "M_u": "N*s", "M_w": "N*s", "M_q": "N*m*s"}
    given = "\n".join(
        f'{name} = "{getattr(d, name)!r} {units.get(name, "N*s/m")}"'
        for name in ("X_u", "X_w", "Z_u", "Z_w", "Z_q", "M_u", "M_w", "M_q")
    )
    return f"""[flight]
speed = {craft.speed!r}
gravity = {craft.gravity!r}
mass = "{craft.mass!r} kg"
pitch_inertia = "{craft.pitch_inertia!r} kg*m^2"
[flight.derivatives]
{given}
"""


def by_matrix(craft):
    rows = ",\n".join(str(row) for row in state_matrix(craft).tolist())
    return f"[flight]\nspeed = {craft.speed!r}\ngravity = {craft.gravity!r}\nmatrix = [{rows}]\n"


@pytest.mark.parametrize("form", [by_derivatives, by_matrix])
def test_forms_of_a_model_agree(form):
    craft = parse_flight(CESSNA)
    other = parse_flight(form(craft))
    assert state_matrix(other) == pytest.approx(state_matrix(craft), rel=1e-12)
    assert drag_over_lift(other) == pytest.approx(drag_over_lift(craft), rel=1e-12)


@pytest.mark.parametrize("mode", [0, 1])
def test_nonlinear_flight_follows_the_path_of_a_small_motion(mode):
    craft = airframe(centre_of_gravity=0.1)
    motion = flight_modes(state_matrix(craft))[mode]
    path = flight_path(motion, craft.speed)
    small = 1e-3
    start = small * np.array(motion.shape).real * path.pitch[0]
    level = np.array([craft.speed, 0.0, 0.0, 0.0])
    model = Nonlinear(craft)

    def rates(_, y):
        u, w, _, theta = y[:4]
        ahead = u * np.cos(theta) + w * np.sin(theta) - craft.speed
        climb = u * np.sin(theta) - w * np.cos(theta)
        return [*model.rates(y[:4]), ahead, climb]

    begin = [*(level + start), small * path.ahead[0], small * path.altitude[0]]
    end = path.time[-1]
    found = solve_ivp(rates, (0.0, end), begin, t_eval=path.time, rtol=1e-9, atol=1e-12)
    for got, wanted in ((found.y[4], path.ahead), (found.y[5], path.altitude)):
        assert got / small == pytest.approx(wanted, abs=0.01 * np.abs(path.altitude).max())
    assert found.y[3] / small == pytest.approx(path.pitch, abs=1e-3 * np.abs(path.pitch).max())


@pytest.mark.parametrize("change", ["", "elastic_axis = 0.35", 'chord = "7 cm"'])
def test_a_wing_of_unlike_segments_flies_as_one_of_their_mean(change):
    """Their quarter chords lie apart: the lift acts between them."""
    root = 'span = "14 cm"\n'
    wing = parse_model(SEGMENTED.replace(root, root + change + "\n"))
    balanced = wing.aircraft.model_copy(update={"trim": "force-and-moment"})
    folds = (0.0, 0.0)
    bodies, *_ = multibody_rows(wing.carried_by(balanced), folds, (20.0,))
    states = flight_modes(state_matrix(airframe_of(wing, folds, 20.0)))
    for motion, wanted in zip(states, bodies.motions, strict=True):
        assert motion.eigenvalue == pytest.approx(wanted.eigenvalue, rel=3e-3)
