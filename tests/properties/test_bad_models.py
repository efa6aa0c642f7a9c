"""Bad models: every one is refused with an InputError that names field, value, limit, remedy."""

import copy
import math
import re
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foldwing.errors import InputError
from foldwing.model import Wing, example_text, parse_model, read_model

GOOD = """
title = "two segments"
[material.sheet]
youngs_modulus = "2.8 GPa"
poissons_ratio = 0.3
density = "1145 kg/m^3"
[wing]
chord = "5 cm"
thickness = "1/16 in"
material = "sheet"
[[wing.segment]]
span = "14 cm"
[[wing.segment]]
span = "10 cm"
hinge = { springs = 3, spacing = "15 mm", stiffness = "0.18 N*m/rad", fold = 30 }
[[point_mass]]
segment = 1
mass = "8.65 g"
x = "7.9 mm"
y = "14 cm"
[air]
density = "1.2 kg/m^3"
[analysis]
damping = 0.01
"""
HINGE = '{ springs = 3, spacing = "15 mm", stiffness = "0.18 N*m/rad", fold = 30 }'
SPAN, CHORD, THICK = 'span = "14 cm"', 'chord = "5 cm"', 'thickness = "1/16 in"'
FIRST = "wing.segment[1]"
BEYOND = "wing.segment[2].hinge"
MISSING = object()

# (what is replaced, by what, field, value as the message gives it, words of limit, of remedy)
CASES = [
    # Unknown keys
    (SPAN, "spam = 1", f"{FIRST}.spam", 1, "not a known key", "Did you mean span?"),
    ("[air]", "[airs]", "airs", "a table of 1 keys", "not a known key", "Did you mean air?"),
    ("damping =", "dampin =", "analysis.dampin", 0.01, "not a known key", "Did you mean damping?"),
    ("fold =", "angle =", f"{BEYOND}.angle", 30, "not a known key", "fold, flare, gap, positions"),
    ('title = "two segments"', "[trellis]", "trellis", "a table of 0 keys", "not a known", "Known"),
    # Missing, zero and negative
    (SPAN, "", f"{FIRST}.span", MISSING, "greater than 0 m", "Add span"),
    (CHORD, "", f"{FIRST}.chord", MISSING, "greater than 0 m", "Add chord"),
    (THICK, "", f"{FIRST}.thickness", MISSING, "needed for bending_stiffness", "Add thickness"),
    ('material = "sheet"', "", f"{FIRST}.material", MISSING, "is needed for", "Add material"),
    (
        THICK + '\nmaterial = "sheet"',
        "",
        f"{FIRST}.bending_stiffness",
        MISSING,
        "a material and a thickness",
        "Add bending_stiffness",
    ),
    (
        'density = "1145 kg/m^3"',
        "",
        "material.sheet.density",
        MISSING,
        "greater than 0 kg/m^3",
        "Add density",
    ),
    ('mass = "8.65 g"', "", "point_mass[1].mass", MISSING, "a mass (kg)", "Add mass"),
    (SPAN, "span = 0", f"{FIRST}.span", 0, "greater than 0 m", "14 cm"),
    (SPAN, 'span = "-1 m"', f"{FIRST}.span", "-1 m", "greater than 0 m", "14 cm"),
    (THICK, "thickness = 0", "wing.thickness", 0, "greater than 0 m", "1/16 in"),
    (THICK, "thickness = -1", "wing.thickness", -1, "greater than 0 m", "1/16 in"),
    ('"1145 kg/m^3"', "0", "material.sheet.density", 0, "greater than 0", "1145 kg/m^3"),
    ('"1145 kg/m^3"', "-3", "material.sheet.density", -3, "greater than 0", "1145 kg/m^3"),
    ('"2.8 GPa"', "0", "material.sheet.youngs_modulus", 0, "greater than 0 Pa", "3 GPa"),
    ('"1.2 kg/m^3"', "-1.2", "air.density", -1.2, "greater than 0 kg/m^3", "kg/m^3"),
    ('"8.65 g"', "0", "point_mass[1].mass", 0, "greater than 0 kg", "8.65 g"),
    # Units
    (SPAN, 'span = "14 kg"', f"{FIRST}.span", "14 kg", "'kg' is [mass]", "14 cm"),
    (SPAN, 'span = "14 furlog"', f"{FIRST}.span", "14 furlog", "not a unit", "14 cm"),
    (SPAN, 'span = "14"', f"{FIRST}.span", "14", "has no unit", "14 cm"),
    (SPAN, 'span = "cm"', f"{FIRST}.span", "cm", "no number with a unit", "14 cm"),
    (SPAN, 'span = ""', f"{FIRST}.span", "", "no number with a unit", "14 cm"),
    (SPAN, 'span = "1/0 m"', f"{FIRST}.span", "1/0 m", "greater than 0 m", "14 cm"),
    (SPAN, 'span = "9**9**9 m"', f"{FIRST}.span", "9**9**9 m", "no number with a unit", "14 cm"),
    (SPAN, f'span = "1 {"m*" * 30}m"', f"{FIRST}.span", f"1 {'m*' * 30}m", "too long", "14 cm"),
    ("fold = 30", 'fold = "5 percent"', f"{BEYOND}.fold", "5 percent", "not an angle", "0.5 rad"),
    ("fold = 30", 'fold = "3 m"', f"{BEYOND}.fold", "3 m", "'m' is [length]", "in degrees"),
    # Not a finite number
    (SPAN, "span = nan", f"{FIRST}.span", math.nan, "finite", "14 cm"),
    (SPAN, "span = inf", f"{FIRST}.span", math.inf, "finite", "14 cm"),
    (SPAN, 'span = "nan m"', f"{FIRST}.span", "nan m", "no number with a unit", "14 cm"),
    (SPAN, 'span = "1e999 m"', f"{FIRST}.span", "1e999 m", "finite", "14 cm"),
    (SPAN, f"span = 1{'0' * 400}", f"{FIRST}.span", math.inf, "finite", "14 cm"),
    ("fold = 30", "fold = nan", f"{BEYOND}.fold", math.nan, "finite", "in degrees"),
    ("fold = 30", "fold = -inf", f"{BEYOND}.fold", -math.inf, "finite", "in degrees"),
    ("= 0.3", "= nan", "material.sheet.poissons_ratio", math.nan, "finite", "0.3"),
    ("damping = 0.01", "damping = nan", "analysis.damping", math.nan, "less than 1", "0.01"),
    ('x = "7.9 mm"', "x = nan", "point_mass[1].x", math.nan, "finite", "mm"),
    (THICK, "thickness = 1e200", f"{FIRST}.bending_stiffness", math.inf, "finite", "N*m^2"),
    # Not a number
    (SPAN, "span = [14]", f"{FIRST}.span", "a list of 1", "a length (m)", "14 cm"),
    (SPAN, "span = true", f"{FIRST}.span", True, "a length (m)", "14 cm"),
    (SPAN, "span = { m = 1 }", f"{FIRST}.span", "a table of 1 keys", "a length (m)", "14 cm"),
    (SPAN, "span = 1979-05-27", f"{FIRST}.span", "1979-05-27", "a length (m)", "14 cm"),
    ("= 0.3", '= "0.3"', "material.sheet.poissons_ratio", "0.3", "a number", "without quotes"),
    ("damping = 0.01", "damping = [0]", "analysis.damping", "a list of 1", "damping", "0.01"),
    ("springs = 3", "springs = 2.5", f"{BEYOND}.springs", 2.5, "a whole number", "decimal"),
    ("springs = 3", "springs = true", f"{BEYOND}.springs", True, "a whole number", "quotes"),
    ("segment = 1", 'segment = "1"', "point_mass[1].segment", "1", "a whole number", "quotes"),
    # Not the right shape
    ('title = "two segments"', "title = 3", "title", 3, "must be text", "quotes"),
    (HINGE, "3", BEYOND, 3, "must be a table", "keys and values"),
    ("[[point_mass]]", "[point_mass]", "point_mass", "a table of 4 keys", "a list", "[["),
    (GOOD, "wing = 1", "wing", 1, "must be a table", "keys and values"),
    (GOOD, "title = 'x'", "wing", MISSING, "is required", "Add wing"),
    (GOOD, "material = 3\n[wing]\nsegment = [{}]", "material", 3, "must be a table", "keys"),
    (GOOD, "[wing]\nsegment = 3", "wing.segment", 3, "must be a list", "[[wing.segment]]"),
    (GOOD, "[wing]\nchord = 1", "wing.segment", "no segment", "at least 1", "[[wing.segment]]"),
    (GOOD, "[wing]\nsegment = []", "wing.segment", "no segment", "at least 1", "[[wing.segment]]"),
    # Materials
    ("= 0.3", "= -1", "material.sheet.poissons_ratio", -1, "greater than -1", "0.3"),
    ("= 0.3", "= 0.51", "material.sheet.poissons_ratio", 0.51, "at most 0.5", "0.3"),
    (
        "poissons_ratio = 0.3",
        "",
        "material.sheet.shear_modulus",
        MISSING,
        "exactly one of",
        "Add poissons_ratio",
    ),
    (
        "= 0.3",
        "= 0.3\nshear_modulus = 1e9",
        "material.sheet.poissons_ratio",
        0.3,
        "exactly one of",
        "Remove one",
    ),
    ('= "sheet"', '= "sheat"', "wing.material", "sheat", "name of a", "Did you mean sheet?"),
    (
        SPAN,
        f'{SPAN}\nmaterial = "steel"',
        f"{FIRST}.material",
        "steel",
        "name of a",
        "Known here: sheet",
    ),
    # Sections
    (CHORD, f"{CHORD}\nmass_centre = 1.01", "wing.mass_centre", 1.01, "at most 1", "0.5"),
    (CHORD, f"{CHORD}\nelastic_axis = -0.1", "wing.elastic_axis", -0.1, "at least 0", "0.5"),
    (CHORD, f"{CHORD}\nlift_slope = 0", "wing.lift_slope", 0, "greater than 0", "6.283"),
    (
        SPAN,
        f"{SPAN}\nmass_centre = 0.9\nmass_per_span = 1\ninertia_per_span = 4e-4",
        f"{FIRST}.inertia_per_span",
        4e-4,
        "0.0004 kg*m",
        "about the elastic axis",
    ),
    # Hinges
    (SPAN, f"{SPAN}\nhinge = {HINGE}", f"{FIRST}.hinge", "a hinge", "has no hinge", "Move it"),
    (f"hinge = {HINGE}", "", BEYOND, MISSING, "needs the hinge", "Write hinge ="),
    (HINGE, "{ rigid = true, free = true }", f"{BEYOND}.free", True, "only one of", "Write hinge"),
    (HINGE, "{ stiffness = 1, free = true }", f"{BEYOND}.free", True, "only one of", "Write"),
    (HINGE, "{ springs = 3, free = true }", f"{BEYOND}.free", True, "no springs", "Write hinge"),
    (HINGE, "{ fold = 3 }", BEYOND, MISSING, "needs a stiffness", "Write hinge"),
    (HINGE, "{ rigid = false }", f"{BEYOND}.rigid", False, "only be true", "Remove rigid"),
    (HINGE, '{ rigid = "yes" }', f"{BEYOND}.rigid", "yes", "true or false", "Write true"),
    (HINGE, "{ stiffness = 0 }", f"{BEYOND}.stiffness", 0.0, "greater than 0", "free hinge"),
    (HINGE, "{ stiffness = -1 }", f"{BEYOND}.stiffness", -1, "at least 0", "0.18 N*m/rad"),
    (HINGE, "{ stiffness = inf }", f"{BEYOND}.stiffness", math.inf, "finite", "0.18 N*m/rad"),
    (HINGE, "{ springs = 2, spacing = 0.01 }", f"{BEYOND}.stiffness", MISSING, "springs", "Add"),
    (HINGE, "{ springs = 2, stiffness = 1 }", f"{BEYOND}.spacing", MISSING, "2 springs", "Add"),
    (HINGE, "{ spacing = 2, stiffness = 1 }", f"{BEYOND}.springs", MISSING, "spacing", "Add"),
    ("springs = 3", "springs = 0", f"{BEYOND}.springs", 0, "1 to 1000", "for example 1"),
    ('"15 mm"', "0.026", f"{BEYOND}.spacing", 0.026, "fit in the edge that both share", "0.025 m"),
    # Point masses
    ("segment = 1", "segment = 3", "point_mass[1].segment", 3, "1 to 2", "from 1 at the root"),
    ("segment = 1", "segment = 0", "point_mass[1].segment", 0, "1 or more", "for example 1"),
    ('y = "14 cm"', 'y = "15 cm"', "point_mass[1].y", 0.15, "0 to 0.14 m", "inboard edge"),
    ('y = "14 cm"', 'y = "-1 mm"', "point_mass[1].y", "-1 mm", "at least 0 m", "mm"),
    # Analysis
    ("damping = 0.01", "damping = 1", "analysis.damping", 1, "less than 1", "0.01"),
    ("damping =", "damping_threshold = 0.5 #", "analysis.damping_threshold", 0.5, "0.5", "0.02"),
    ("damping =", "bending_modes = 1 #", "analysis.bending_modes", 1, "2 to 60", "example 2"),
    ("damping =", "torsion_modes = 61 #", "analysis.torsion_modes", 61, "1 to 60", "example 1"),
    ("damping =", 'basis = "fixed" #', "analysis.basis", "fixed", "'free-free'", "Choose"),
]


def refusal(text: str) -> InputError:
    with pytest.raises(InputError) as caught:
        parse_model(text)
    return caught.value


def check(error, field, value, limit, remedy):
    assert error.field == field
    if value is MISSING:
        assert error.value is None
    elif isinstance(value, float) and math.isnan(value):
        assert math.isnan(error.value)
    else:
        assert (error.value, type(error.value)) == (value, type(value))
    assert limit in error.limit
    assert remedy in error.remedy
    given = "missing" if value is MISSING else f"got {error.value!r}"
    assert str(error) == f"{field}: {given}; {error.limit}. {error.remedy}"


def test_the_good_model_is_good():
    assert parse_model(GOOD).count == 2


@pytest.mark.parametrize(
    ("old", "new", "field", "value", "limit", "remedy"),
    CASES,
    ids=[f"{case[2]}-{i}" for i, case in enumerate(CASES)],
)
def test_bad_model(old, new, field, value, limit, remedy):
    assert old in GOOD
    check(refusal(GOOD.replace(old, new, 1)), field, value, limit, remedy)


def test_the_number_of_other_faults_is_told():
    error = refusal(GOOD.replace("0.01", "2").replace('"14 cm"', '"14 kg"'))
    assert error.field == "wing.segment[1].span"
    assert "(2 more to mend in this model.)" in error.remedy


def test_fold_list_of_wrong_length():
    with pytest.raises(InputError) as caught:
        parse_model(GOOD).folded(30, -30)
    check(caught.value, "fold", "30, -30", "takes 1 fold angles", "for each hinge")


@pytest.mark.parametrize("text", ["x" * 10_000, "1" + " " * 10_000 + "!", "1" * 10_000])
def test_a_long_value_is_refused_at_once_and_shortened(text):
    error = refusal(GOOD.replace("14 cm", text))
    assert len(str(error)) < 400


# Files


@pytest.mark.parametrize(
    ("content", "limit"),
    [
        (b"", "must describe a model"),
        (b" \n\n", "must describe a model"),
        (b"\x89PNG\r\n\x1a\n\x00\xff", "UTF-8"),
        ("title = 'x'".encode("utf-16"), "UTF-8"),
        (b"\x00\x01\x02", "valid TOML"),
        (b"[wing\nspan = 3", "valid TOML"),
        (b"a = 1\na = 2", "valid TOML"),
        (b"a = " + b"[" * 100_000, "valid TOML"),
        (b"a = " + b"9" * 5_000, "valid TOML"),
        (b"a = 2020-13-45", "valid TOML"),
    ],
)
def test_bad_file(tmp_path, content, limit):
    path = tmp_path / "model.toml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_model(path)
    assert limit in caught.value.limit
    assert caught.value.remedy
    assert "model.toml" in str(caught.value)


def test_the_line_of_a_toml_error_is_shown():
    error = refusal("[wing]\nspan = = 3\n")
    assert error.value == "span = = 3"
    assert "line 2" in error.limit


def test_folder_instead_of_a_file(tmp_path):
    with pytest.raises(InputError, match=r"folder.*TOML file inside"):
        read_model(tmp_path)


def test_unreadable_file(tmp_path, monkeypatch):
    path = tmp_path / "model.toml"
    path.write_text(GOOD)

    def refuse(self):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(InputError, match=r"cannot be read \(Permission denied\).*permissions"):
        read_model(path)


@pytest.mark.parametrize("name", ["three-segmnt", "nowhere/model.toml", "", "\0", "x" * 5000, "-"])
def test_unknown_model(name):
    with pytest.raises(InputError) as caught:
        read_model(name)
    assert caught.value.field == "MODEL"
    assert caught.value.limit and caught.value.remedy
    assert len(str(caught.value)) < 500


def test_unknown_names_suggest_the_nearest():
    with pytest.raises(InputError, match=r"Did you mean three-segment\?.*goland"):
        read_model("three-segmnt")
    with pytest.raises(InputError, match=r"Did you mean level-tip-wind-tunnel\?"):
        example_text("level-tip-windtunnel.csv")


# Random damage

SCALARS = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=20)
    | st.sampled_from(["14 kg", "1/0 m", "3 m", "-2 cm", "1e400 m", "0 N*m/rad", 10**400, 1e200])
    | st.dates()
)
VALUES = st.recursive(
    SCALARS, lambda v: st.lists(v, max_size=3) | st.dictionaries(st.text(max_size=8), v, max_size=3)
)
DOCUMENTS = [GOOD, example_text("friction-hinge-1"), example_text("goland")]


def places(node, path=()):
    """Return the path of every value in a document."""
    items = node.items() if isinstance(node, dict) else enumerate(node)
    for key, value in list(items):
        yield (*path, key)
        if isinstance(value, dict | list):
            yield from places(value, (*path, key))


def damage(document, path, how, value):
    node = document
    for key in path[:-1]:
        node = node[key]
    if how == "remove":
        del node[path[-1]]
    elif how == "add" and isinstance(node, dict):
        node[f"{path[-1]}s"] = value
    else:
        node[path[-1]] = value


@st.composite
def damaged_documents(draw):
    document = copy.deepcopy(tomllib.loads(draw(st.sampled_from(DOCUMENTS))))
    for _ in range(draw(st.integers(1, 3))):
        paths = list(places(document))
        if paths:
            how = draw(st.sampled_from(["replace", "remove", "add"]))
            damage(document, draw(st.sampled_from(paths)), how, draw(VALUES))
    return document


@settings(max_examples=300, deadline=None)
@given(document=damaged_documents())
def test_damaged_documents_raise_only_input_errors(document):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tomllib, "loads", lambda text: document)
        try:
            wing = parse_model("any text")
        except InputError as error:
            assert error.field and error.limit and error.remedy
        else:
            assert_usable(wing)


def assert_usable(wing: Wing) -> None:
    numbers = [n for s in wing.segments for n in (s.span, s.bending_stiffness, s.inertia_per_span)]
    assert all(math.isfinite(n) and n > 0 for n in numbers)
    assert len(wing.hinges) == wing.count - 1
    assert all(math.isfinite(angle) for angle in wing.cumulative_angles)


@settings(max_examples=200, deadline=None)
@given(text=st.text(max_size=60), cut=st.integers(0, len(GOOD)), width=st.integers(0, 60))
def test_damaged_text_raises_only_input_errors(text, cut, width):
    try:
        assert_usable(parse_model(GOOD[:cut] + text + GOOD[cut + width :]))
    except InputError as error:
        assert re.search(r"\S", error.field)
