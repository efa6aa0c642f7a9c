"""Outlines and hinges of a model file: what is refused, and one wing of everything."""

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.model import parse_model
from foldwing.structure.assembly import assemble
from foldwing.structure.modes import natural_modes

MODEL = """
[material.sheet]
youngs_modulus = "3 GPa"
poissons_ratio = 0.3
density = "1145 kg/m^3"
[wing]
material = "sheet"
thickness = "1.6 mm"
[[wing.segment]]
span = "14 cm"
chord = "5 cm"
[[wing.segment]]
structure = "plate"
span = "10 cm"
chord = "5 cm"
hinge = { positions = ["-15 mm", "0 mm", "15 mm"], stiffness = "0.18 N*m/rad", fold = 30 }
[[wing.segment]]
structure = "plate"
corners = [["0 cm", "0 cm"], ["3 cm", "8 cm"], ["5 cm", "0 cm"]]
hinge = { stiffness = "0.5 N*m/rad", fold = 20 }
[[point_mass]]
segment = 2
mass = "2 g"
x = "1 cm"
y = "5 cm"
"""
CORNERS = '["0 cm", "0 cm"], ["3 cm", "8 cm"], ["5 cm", "0 cm"]'
CROSSED = '["0 cm", "0 cm"], ["3 cm", "8 cm"], ["3 cm", "-1 cm"], ["2 cm", "9 cm"]'
NOTCHED = (
    '["0 cm", "0 cm"], ["0 cm", "8 cm"], ["2 cm", "8 cm"], ["2.5 cm", "2 cm"], ["3 cm", "9 cm"], '
    '["5 cm", "0 cm"]'
)
BAD = [
    (CORNERS, CROSSED, "corners", "cross itself"),
    (CORNERS, NOTCHED, "corners", "once in and once out"),
    (CORNERS, '["0 cm", "0 cm"], ["5 cm", "0 cm"], ["3 cm", "8 cm"]', "corners", "leading edge"),
    (CORNERS, '["0 cm", "0 cm"], ["5 cm", "0 cm"]', "corners", "3 to"),
    ('"-15 mm"', '"-26 mm"', "hinge.positions[1]", "edge that both segments share"),
    ("fold = 20", "fold = 20, flare = 20", "hinge.flare", "inboard edge of segment 3"),
    ('positions = ["-15 mm", "0 mm", "15 mm"]', 'positions = ["0 mm"]', "positions", "turn"),
    ('thickness = "1.6 mm"', 'thickness = ["1.6 mm", "0 mm"]', "wing.thickness[2]", "greater"),
    ('span = "14 cm"', 'span = "14 cm"\nsweep = 20', "segment[1].structure", "rectangles"),
    ("fold = 30", "fold = 30, flare = 10", "segment[1].structure", "rectangles"),
    ('x = "1 cm"', 'x = "3 cm"', "point_mass[1].x", "plate of segment 2"),
]


@pytest.mark.parametrize(("before", "after", "field", "limit"), BAD)
def test_bad_outline(before, after, field, limit):
    assert before in MODEL
    with pytest.raises(InputError) as problem:
        parse_model(MODEL.replace(before, after))
    assert field in problem.value.field
    assert limit in problem.value.limit


def test_beam_plate_and_pointed_plate_hold_together():
    """Both sides of a hinge move alike at its springs, the plate's mass counts, and a hinge along
    the stream lets no segment move along it."""
    wing = parse_model(MODEL)
    modes = natural_modes(assemble(wing))
    assert np.all(np.diff(modes.frequencies) > 0.0) and modes.frequencies[0] > 1.0
    for x in (-0.015, 0.0, 0.015):
        inner = modes.displacement(0, np.array([x]), np.array([0.14]))
        outer = modes.displacement(1, np.array([x]), np.array([0.0]))
        assert inner == pytest.approx(outer, abs=1e-8 * np.abs(inner).max())
    lighter = natural_modes(assemble(parse_model(MODEL.split("[[point_mass]]")[0])))
    assert lighter.frequencies[0] > modes.frequencies[0]


def test_mass_of_a_pointed_plate():
    """Area 20 cm^2, thickness and density as given; the centre a third of the span outboard."""
    mass, x, y = parse_model(MODEL).segments[2].mass_and_centre
    assert mass == pytest.approx(1145 * 1.6e-3 * 20e-4, rel=1e-12)
    assert y == pytest.approx(0.08 / 3.0, rel=1e-12)
    assert x == pytest.approx((0.0 + 0.03 + 0.05) / 3.0 - 0.025, rel=1e-12)
