"""The shipped aircraft are what their comments say."""

import re

import numpy as np
import pytest

from foldwing.flight import flight_modes, simple_phugoid, state_matrix
from foldwing.flight.phugoid import drag_over_lift
from foldwing.model import example_text, parse_flight, read_flight

FOOT = 0.3048
AIRCRAFT = ("boeing-747", "cessna-172", "cessna-172-identified")


def comment(name):
    text = example_text(name)
    return " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))


def number(name, pattern):
    found = re.search(pattern, comment(name))
    assert found, f"{pattern!r} is not in the comments of {name}"
    return float(found[1])


@pytest.mark.parametrize("name", AIRCRAFT)
def test_every_aircraft_is_stable(name):
    motions = flight_modes(state_matrix(read_flight(name)))
    assert [motion.mode for motion in motions] == ["phugoid", "short period"]
    assert all(motion.growth < 0.0 for motion in motions)


@pytest.mark.parametrize("name", AIRCRAFT)
def test_copies_are_the_same(name, tmp_path):
    path = tmp_path / "copy.toml"
    path.write_text(example_text(name), encoding="utf-8")
    assert read_flight(path) == parse_flight(example_text(name))


def test_cessna_of_the_table():
    craft = read_flight("cessna-172")
    for part, name in ((craft.wing, "wing"), (craft.tail, "tail")):
        feet = re.search(rf"{name} (\d+) ft by (\d+) ft", comment("cessna-172"))
        assert (part.span, part.chord) == pytest.approx([FOOT * float(f) for f in feet.groups()])
        assert part.span_efficiency == number("cessna-172", r"Inferred here: ([\d.]+) for both")
    assert craft.tail_arm == pytest.approx(15 * FOOT)
    assert craft.mass == number("cessna-172", r"(\d+) kg,")
    assert craft.pitch_inertia == number("cessna-172", r"(\d+) kg\*m")
    assert craft.speed == number("cessna-172", r"([\d.]+) m/s,")
    assert craft.gravity == number("cessna-172", r"printed; ([\d.]+) m/s\^2")
    assert craft.density == number("cessna-172", r"air of ([\d.]+) kg")
    assert craft.zero_lift_drag == number("cessna-172", r"coefficient of ([\d.]+) on")


def test_identified_cessna():
    name = "cessna-172-identified"
    craft = read_flight(name)
    assert craft.speed == number(name, r"once: ([\d.]+) m/s")
    assert craft.pitch_inertia == number(name, r"m/s, ([\d.]+) kg\*m\^2 and")
    assert craft.gravity == number(name, r"and ([\d.]+) m/s\^2, with")
    root = simple_phugoid(drag_over_lift(craft), craft.speed, craft.gravity)[0]
    assert f"{root.real:.4f} + {root.imag:.4f}i" in comment(name)
    for motion in flight_modes(state_matrix(craft)):
        value = motion.eigenvalue
        assert f"{value.real:.4f} + {value.imag:.4f}i" in comment(name)
    changed = {key: getattr(read_flight("cessna-172"), key) for key in
               ("speed", "pitch_inertia", "gravity", "title")}  # fmt: skip
    assert craft.model_copy(update=changed) == read_flight("cessna-172")


def test_boeing_follows_from_its_derivatives():
    found = dict(re.findall(r"([XZM]_\w+) = (-?[\d.]+e\d)", comment("boeing-747")))
    d = {name: float(value) for name, value in found.items()}
    craft = read_flight("boeing-747")
    m = number("boeing-747", r"weight of ([\d.e]+) N") / craft.gravity
    I = number("boeing-747", r"I = ([\d.e]+) kg")
    U = number("boeing-747", r"U = ([\d.]+) m/s")
    mass = np.diag([m, m - d["Z_wdot"], I, 1.0])
    mass[2, 1] = -d["M_wdot"]
    force = [
        [d["X_u"], d["X_w"], 0.0, -m * craft.gravity],
        [d["Z_u"], d["Z_w"], d["Z_q"] + m * U, 0.0],
        [d["M_u"], d["M_w"], d["M_q"], 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ]
    assert state_matrix(craft) == pytest.approx(np.linalg.solve(mass, force), abs=5.1e-9)
    assert craft.speed == U
