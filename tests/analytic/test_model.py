"""The model: units, section properties by hand, copies of a wing, shipped examples, JSON schema."""

import csv
import json
import math
import os
import re
import subprocess
import sys
import tomllib

import numpy as np
import pytest
from pydantic import ValidationError

from foldwing.errors import InputError
from foldwing.model import (
    Air,
    Analysis,
    Hinge,
    HingeKind,
    Material,
    PointMass,
    Segment,
    Wing,
    example_names,
    example_text,
    json_schema,
    list_examples,
    measurement_names,
    model_text,
    parse_model,
    read_model,
    strip_inertia,
    strip_properties,
)
from foldwing.model.reader import parse_file

SECTION = {
    "span": 2.0,
    "chord": 0.5,
    "bending_stiffness": 100.0,
    "torsion_stiffness": 50.0,
    "mass_per_span": 3.0,
    "inertia_per_span": 0.25,
}
TWO_SEGMENTS = """
[wing]
chord = 0.5
bending_stiffness = 100
torsion_stiffness = 50
mass_per_span = 3
inertia_per_span = 0.25
span = 2
[[wing.segment]]
[[wing.segment]]
hinge = {hinge}
"""


def hinge_of(text: str) -> Hinge:
    return parse_model(TWO_SEGMENTS.replace("{hinge}", text)).hinges[0]


def a_wing(count: int = 3) -> Wing:
    hinges = [Hinge(stiffness=1.0, fold=10.0 * i) for i in range(1, count)]
    return Wing(segments=[Segment(**SECTION)] * count, hinges=hinges)


# Units


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("14 cm", 0.14),
        ("14cm", 0.14),
        (" 14 cm ", 0.14),
        ("1/16 in", 0.0015875),
        ("1 / 16 inch", 0.0015875),
        ("1.5e2 mm", 0.15),
        (".5 m", 0.5),
        ("+2 ft", 0.6096),
        (0.14, 0.14),
        (3, 3.0),
        (np.float64(0.14), 0.14),
        (np.int64(3), 3.0),
    ],
)
def test_lengths_resolve_to_metres(text, metres):
    span = Segment(**SECTION | {"span": text}).span
    assert type(span) is float
    assert span == pytest.approx(metres, rel=1e-15)


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("bending_stiffness", "2e4 N*m^2", 2e4),
        ("torsion_stiffness", "1 kN m**2", 1e3),
        ("mass_per_span", "750 g/m", 0.75),
        ("inertia_per_span", "0.3 kg*m^2/m", 0.3),
        ("thickness", "2 mm", 0.002),
    ],
)
def test_section_quantities_resolve_to_si(key, text, value):
    assert getattr(Segment(**SECTION | {key: text}), key) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("fold", "degrees"),
    [(30, 30.0), (-30.5, -30.5), ("0.5 rad", 28.64788975654116), ("30 deg", 30.0), ("30°", 30.0)],
)
def test_bare_fold_angles_are_degrees(fold, degrees):
    assert math.degrees(Hinge(kind="rigid", fold=fold).fold) == pytest.approx(degrees, rel=1e-14)


def test_hinge_stiffness_per_degree():
    assert Hinge(stiffness="1 N*m/deg").stiffness == pytest.approx(180 / math.pi, rel=1e-14)


def test_a_dumped_wing_is_read_back():
    wing = a_wing()
    again = Wing.model_validate(wing.model_dump())
    assert again.fold_angles == pytest.approx(wing.fold_angles, rel=1e-15)
    assert again.segments == wing.segments


def test_bare_numbers_do_not_load_pint():
    code = (
        "import sys, foldwing.model as m;"
        "m.Air(density=1.2); m.Hinge(stiffness=1, fold=30);"
        "assert 'pint' not in sys.modules;"
        "m.Air(density='1.2 kg/m^3');"
        "assert 'pint' in sys.modules"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    subprocess.run([sys.executable, "-c", code], check=True, env=environment)


# Materials and sections


def test_shear_modulus_from_poissons_ratio():
    given = Material(youngs_modulus="3 GPa", density=1145, poissons_ratio=0.45)
    assert given.shear == pytest.approx(1.0344827586e9, rel=1e-10)
    assert Material(youngs_modulus=3e9, density=1145, shear_modulus=1e9).shear == 1e9
    assert Material(youngs_modulus=3e9, density=1145, poissons_ratio=0.5).shear == pytest.approx(
        1e9
    )


def test_strip_properties_by_hand():
    sheet = Material(youngs_modulus=12e9, density=1000, shear_modulus=3e9)
    properties = strip_properties(sheet, chord=0.1, thickness=0.01)
    assert properties["bending_stiffness"] == pytest.approx(100.0, rel=1e-14)
    assert properties["torsion_stiffness"] == pytest.approx(100.0, rel=1e-14)
    assert properties["mass_per_span"] == pytest.approx(1.0, rel=1e-14)
    assert strip_inertia(12.0, chord=1.0, mass_offset=0.5) == pytest.approx(4.0, rel=1e-14)


def test_three_segment_example_by_hand():
    wing = read_model("three-segment")
    segment = wing.segments[0]
    t = 0.0254 / 16
    assert segment.thickness == pytest.approx(t, rel=1e-15)
    assert segment.bending_stiffness == pytest.approx(2.82685e9 * 0.05 * t**3 / 12, rel=1e-13)
    assert segment.torsion_stiffness == pytest.approx(1.2e9 * 0.05 * t**3 / 3, rel=1e-13)
    assert segment.mass_per_span == pytest.approx(1145 * 0.05 * t, rel=1e-13)
    assert segment.inertia_per_span == pytest.approx(1145 * t * 0.05**3 / 12, rel=1e-13)
    assert [s.span for s in wing.segments] == pytest.approx([0.14, 0.10, 0.06], rel=1e-15)
    assert [h.stiffness for h in wing.hinges] == pytest.approx([0.54, 0.54], rel=1e-15)
    assert [h.springs for h in wing.hinges] == [3, 3]
    assert [h.spacing for h in wing.hinges] == pytest.approx([0.015, 0.015], rel=1e-15)
    assert np.degrees(wing.fold_angles) == pytest.approx([30, -30])
    assert wing.air.density == 1.2
    assert wing.analysis == Analysis()


def test_sheet_with_an_axis_off_its_mass_centre():
    text = """
    [material.sheet]
    youngs_modulus = 12e9
    density = 1000
    shear_modulus = 3e9
    [[wing.segment]]
    span = 1
    chord = 0.1
    thickness = 0.01
    material = "sheet"
    elastic_axis = 0.3
    mass_centre = 0.6
    """
    segment = parse_model(text).segments[0]
    assert segment.half_chord == 0.05
    assert segment.axis_offset == pytest.approx(-0.4, rel=1e-14)
    assert segment.mass_offset == pytest.approx(0.03, rel=1e-14)
    assert segment.area == pytest.approx(0.1, rel=1e-14)
    assert segment.inertia_per_span == pytest.approx(0.01 / 12 + 0.03**2, rel=1e-13)


def test_direct_properties_replace_those_of_the_sheet():
    text = example_text("three-segment").replace(
        'material = "sheet"', 'material = "sheet"\nbending_stiffness = 7\nmass_per_span = 2'
    )
    segment = parse_model(text).segments[1]
    assert segment.bending_stiffness == 7
    assert segment.torsion_stiffness == read_model("three-segment").segments[1].torsion_stiffness
    assert segment.mass_per_span == 2
    assert segment.inertia_per_span == pytest.approx(2 * 0.05**2 / 12, rel=1e-14)


def test_a_segment_overrides_the_wing_table():
    text = TWO_SEGMENTS.replace("hinge =", "chord = 0.4\nhinge =").replace(
        "{hinge}", "{ rigid = true }"
    )
    assert [s.chord for s in parse_model(text).segments] == [0.5, 0.4]
    assert [s.span for s in parse_model(text).segments] == [2.0, 2.0]


def test_defaults_of_a_segment():
    segment = Segment(**SECTION)
    assert (segment.elastic_axis, segment.mass_centre, segment.thickness) == (0.5, 0.5, None)
    assert segment.lift_slope == 2 * math.pi
    assert Air().density == 1.225


def test_inertia_of_a_line_of_mass_is_refused():
    line = SECTION | {"chord": 2.0, "mass_centre": 1.0, "mass_per_span": 1.0}
    assert Segment(**line | {"inertia_per_span": 1.001}).mass_offset == 1.0
    for alike in (1.0, 1.0 + 1e-14):  # a line but for round-off has no positive mass matrix either
        with pytest.raises(ValidationError, match=r"inertia_per_span: must be greater.* 1 kg\*m"):
            Segment(**line | {"inertia_per_span": alike})


def test_goland_example():
    wing = read_model("goland")
    segment = wing.segments[0]
    assert wing.count == 1
    assert wing.hinges == wing.fold_angles == ()
    assert wing.cumulative_angles == (0.0,)
    assert segment.axis_offset == pytest.approx(-0.34, rel=1e-14)
    assert segment.mass_offset == pytest.approx(0.18288, rel=1e-14)
    assert (segment.bending_stiffness, segment.torsion_stiffness) == (9.77e6, 0.99e6)


def test_friction_hinge_examples():
    for name, chord, spans in [
        ("friction-hinge-1", 0.05, (0.16, 0.08, 0.06)),
        ("friction-hinge-2", 0.065, (0.14, 0.10, 0.06)),
    ]:
        wing = read_model(name)
        assert [s.chord for s in wing.segments] == [chord] * 3
        assert [s.span for s in wing.segments] == pytest.approx(spans, rel=1e-15)
        assert [h.kind for h in wing.hinges] == [HingeKind.RIGID] * 2
        assert wing.segments[0].thickness == pytest.approx(0.98 * 0.0254 / 16, rel=1e-14)
        placed = [(m.segment, m.x, m.y) for m in wing.point_masses]
        expected = [(i, x, wing.segments[i - 1].span) for i in (1, 2) for x in (0.0079, -0.0079)]
        assert np.allclose(placed, expected, rtol=1e-14)
        assert sum(m.mass for m in wing.point_masses) == pytest.approx(2 * 0.0173, rel=1e-14)


# Hinges


@pytest.mark.parametrize(
    ("text", "kind", "stiffness", "springs"),
    [
        ('{ springs = 3, spacing = "15 mm", stiffness = "0.18 N*m/rad" }', "spring", 0.54, 3),
        ("{ springs = 1, stiffness = 0.18 }", "spring", 0.18, 1),
        ("{ stiffness = 0.54 }", "spring", 0.54, 1),
        ("{ rigid = true }", "rigid", 0.0, 1),
        ("{ free = true, fold = 20 }", "free", 0.0, 1),
    ],
)
def test_forms_of_a_hinge(text, kind, stiffness, springs):
    hinge = hinge_of(text)
    assert hinge.kind == kind
    assert hinge.stiffness == pytest.approx(stiffness, rel=1e-15)
    assert hinge.springs == springs
    assert math.degrees(hinge.fold) == pytest.approx(20.0 if "fold" in text else 0.0)


def test_springs_may_fill_the_chord_exactly():
    assert hinge_of("{ springs = 3, spacing = 0.25, stiffness = 1 }").spacing == 0.25


# Copies of a wing


def test_folded_wing():
    wing = a_wing()
    folded = wing.folded(30, -75)
    assert np.degrees(folded.fold_angles) == pytest.approx([30, -75])
    assert np.degrees(folded.cumulative_angles) == pytest.approx([0, 30, -45])
    assert np.degrees(wing.fold_angles) == pytest.approx([10, 20])
    assert folded.segments == wing.segments
    assert [h.stiffness for h in folded.hinges] == [1.0, 1.0]
    assert wing.folded("0.5 rad", 0).fold_angles == (0.5, 0.0)


def test_a_wing_without_hinges_is_folded_by_no_angles():
    assert a_wing(1).folded() == a_wing(1)


@pytest.mark.parametrize("angles", [(), (1,), (1, 2, 3), (1, math.nan), (math.inf, 1), (1, "2 m")])
def test_wrong_fold_angles(angles):
    with pytest.raises(InputError) as caught:
        a_wing().folded(*angles)
    assert caught.value.field == "fold"
    assert caught.value.limit and caught.value.remedy


def test_changed_analysis_and_air():
    wing = a_wing().with_analysis(system_modes=20, damping_threshold=-0.02).with_air("1.2 kg/m^3")
    assert wing.analysis == Analysis(system_modes=20, damping_threshold=-0.02)
    assert wing.air.density == 1.2
    with pytest.raises(InputError, match=r"analysis\.dampings: got 0.1.*Did you mean damping\?"):
        wing.with_analysis(dampings=0.1)
    with pytest.raises(InputError, match=r"air\.density: got -1"):
        wing.with_air(-1)


def test_added_point_masses():
    mass = PointMass(segment=2, mass="8.65 g", x="-7.9 mm", y=2.0)
    heavier = a_wing().with_point_masses(mass).with_point_masses(mass)
    assert heavier.point_masses == (mass, mass)
    assert (mass.mass, mass.x) == pytest.approx((0.00865, -0.0079), rel=1e-14)
    with pytest.raises(InputError, match=r"point_mass\[1\]\.segment: got 2"):
        a_wing(1).with_point_masses(mass)


def test_static_imbalance():
    wing = a_wing().with_static_imbalance(0.3)
    assert [m.segment for m in wing.point_masses] == [1, 2, 3]
    for mass, segment in zip(wing.point_masses, wing.segments, strict=True):
        b = segment.half_chord
        assert (mass.x, mass.y) == (b / 2, segment.span)
        moment = 3 * mass.mass * (b / 2) / segment.span
        assert moment / (segment.mass_per_span * b) == pytest.approx(0.3, rel=1e-14)
    assert a_wing().with_static_imbalance(0) == a_wing()


@pytest.mark.parametrize("imbalance", [-0.1, math.nan, math.inf, "0.1", 5e-324])
def test_impossible_static_imbalance(imbalance):
    wing = Wing(segments=[Segment(**SECTION | {"span": 0.1})])
    with pytest.raises(InputError, match="static_imbalance"):
        wing.with_static_imbalance(imbalance)


# Python constructors


def test_a_wing_is_frozen():
    with pytest.raises(ValidationError, match="frozen"):
        a_wing().title = "another"


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: Segment(**SECTION | {"span": "14 kg"}), r"'kg' is \[mass\].*14 cm"),
        (lambda: Segment(**SECTION, spam=1), r"spam: is not a known key\. Did you mean span\?"),
        (lambda: Segment(span=1), r"chord: must be a length.*Add chord"),
        (lambda: Wing(segments=()), "at least 1 segment"),
        (lambda: Wing(segments=[Segment(**SECTION)] * 2), "2 segments need 1 hinges"),
        (lambda: Hinge(stiffness=0), "greater than 0 N"),
        (lambda: Hinge(stiffness=math.inf), "finite"),
        (lambda: Hinge(kind="rigid", stiffness=1), "absent from a rigid hinge"),
        (
            lambda: Wing(
                segments=[Segment(**SECTION), Segment(**SECTION | {"chord": 0.2})],
                hinges=[Hinge(stiffness=1, springs=3, spacing=0.15)],
            ),
            r"hinges\[0\]\.spacing: 3 springs must fit in the edge that both share, 0.2 m.*0.1 m",
        ),
    ],
)
def test_python_users_meet_the_same_words(build, words):
    with pytest.raises(ValidationError, match=words):
        build()


# What is shipped


def test_every_example_is_read():
    assert {e.name for e in list_examples()} == set(example_names()) >= {"three-segment", "goland"}
    for example in list_examples():
        assert parse_file(example.text).title == example.title
        assert example.text == model_text(example.name) == example_text(f"{example.name}.toml")
        assert example.text.startswith("# "), f"{example.name} does not say where it comes from"


def test_a_file_is_read_like_its_example(tmp_path):
    path = tmp_path / "model.toml"
    path.write_text(
        "\ufeff" + example_text("three-segment").replace("\n", "\r\n"), encoding="utf-8"
    )
    assert read_model(path) == read_model(str(path)) == read_model("three-segment")


def test_measured_level_tip():
    assert measurement_names() == ("level-tip-wind-tunnel",)
    text = example_text("level-tip-wind-tunnel.csv")
    assert text == example_text("level-tip-wind-tunnel")
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert [float(row["speed"]) for row in rows] == [34.61, 36.52, 45.09, 25.98]
    assert [float(row["fold_2"]) for row in rows] == [75, 90, 105, 120]
    assert all(float(row["fold_3"]) == -float(row["fold_2"]) for row in rows)


# JSON schema

TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
    "null": type(None),
}


def conforms(value, schema, root):
    """Tell whether a value obeys the part of JSON schema that the exported one uses."""
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/$defs/")
        return conforms(value, root["$defs"][name], root)
    options = schema.get("anyOf")
    if options and not any(conforms(value, option, root) for option in options):
        return False
    if "type" not in schema:
        return set(schema.get("required", ())) <= set(value if isinstance(value, dict) else ())
    kind = TYPES[schema["type"]]
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        return False
    if isinstance(value, dict):
        return conforms_object(value, schema, root)
    if isinstance(value, list):
        return all(conforms(item, schema["items"], root) for item in value)
    if isinstance(value, str):
        return re.search(schema.get("pattern", ""), value) is not None and (
            value in schema.get("enum", [value])
        )
    if value is None:
        return True
    return (
        schema.get("minimum", -math.inf) <= value <= schema.get("maximum", math.inf)
        and schema.get("exclusiveMinimum", -math.inf) < value
        and value < schema.get("exclusiveMaximum", math.inf)
    )


def conforms_object(value, schema, root):
    known, others = schema.get("properties", {}), schema.get("additionalProperties", True)
    if not set(schema.get("required", ())) <= set(value):
        return False
    for key, item in value.items():
        rule = known.get(key, others)
        if rule is False or (rule is not True and not conforms(item, rule, root)):
            return False
    return True


def test_json_schema_is_json():
    schema = json_schema()
    assert json.loads(json.dumps(schema, allow_nan=False)) == schema
    assert {"required": ["wing"]} in schema["anyOf"]


@pytest.mark.parametrize("name", example_names())
def test_examples_conform_to_the_json_schema(name):
    schema = json_schema()
    assert conforms(tomllib.loads(example_text(name)), schema, schema)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("chord", "cord"),
        ('"5 cm"', '"5"'),
        ('"5 cm"', "-5"),
        ('"5 cm"', "true"),
        ("springs = 3", "springs = 1.5"),
        ("springs = 3", "springs = 0"),
        ("[wing]", "[wings]"),
    ],
)
def test_the_json_schema_finds_faults(old, new):
    text, schema = example_text("three-segment"), json_schema()
    assert not conforms(tomllib.loads(text.replace(old, new)), schema, schema)


def test_the_json_schema_names_unit_and_example():
    span = json_schema()["$defs"]["SegmentTable"]["properties"]["span"]
    assert "(m)" in span["description"]
    assert "14 cm" in span["description"]
    assert '"null"' not in json.dumps(json_schema()), "TOML has no null"
