"""Every shipped model runs, is certified, and holds what its comments say."""

import json
import re
from fractions import Fraction

import numpy as np
import pytest

from foldwing.cli.main import run
from foldwing.model import (
    example_names,
    example_text,
    measurement_names,
    read_model,
    read_section,
)
from foldwing.model.reader import parse_file
from foldwing.studies.measured import read_measured

ALL = example_names()
MODELS = [name for name in ALL if parse_file(example_text(name)).wing is not None]
SECTIONS = [name for name in ALL if parse_file(example_text(name)).section is not None]
AIRCRAFT = [name for name in MODELS if read_model(name).aircraft is not None]
WINGS = [name for name in MODELS if name not in AIRCRAFT]
INCH = 0.0254


@pytest.fixture
def answer(capsys, tmp_path, monkeypatch):
    """Run foldwing in an empty folder and return its JSON answer."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        capsys.readouterr()
        assert run([*arguments, "--json"]) == 0
        captured = capsys.readouterr()
        assert captured.err == ""
        return json.loads(captured.out)

    return call


def test_something_is_shipped():
    assert {"three-segment", "goland", "hale", "friction-hinge-1"} <= set(MODELS)
    assert "level-tip-wind-tunnel" in measurement_names()


@pytest.mark.parametrize("name", WINGS)
def test_modes(answer, name):
    modes = answer("modes", name)
    frequencies = modes["natural_frequencies_hz"]
    assert frequencies == sorted(frequencies)
    zero = 3 if name in AIRCRAFT else 0
    assert frequencies[:zero] == [0.0] * zero
    assert frequencies[zero] > 0.0
    assert len(set(modes["mode_names"])) == len(frequencies)
    assert {"B1", "T1"} <= set(modes["mode_names"])


@pytest.mark.parametrize("name", WINGS)
def test_flutter_is_certified(answer, name):
    flutter = answer("flutter", name)
    assert flutter["certified"] is True
    assert flutter["status"] == "ok"
    kinds = {point["kind"] for point in flutter["flutter_points"]}
    assert kinds == {"flutter", "divergence"}
    assert flutter["valid_from"] < 0.1 * flutter["critical"]["speed"]


@pytest.mark.parametrize("name", AIRCRAFT)
def test_aircraft_are_certified(answer, name):
    aircraft = answer("aircraft", name)
    assert aircraft["certified"] is True
    assert aircraft["critical"]["speed"] > aircraft["trim"]["slowest_speed"]
    assert {motion["name"] for motion in aircraft["motions"]} >= {"phugoid"}


@pytest.mark.parametrize("name", SECTIONS)
def test_sections_are_certified(answer, name):
    section = answer("section", name)
    assert section["certified"] is True
    assert section["status"] == "ok"
    assert {point["kind"] for point in section["flutter_points"]} == {"flutter", "divergence"}
    assert section["natural_frequency_ratios"] == sorted(section["natural_frequency_ratios"])


@pytest.mark.parametrize("name", MODELS)
def test_copies_run_identically(answer, capsys, tmp_path, name):
    assert run(["examples", name, "--copy", "copy.toml"]) == 0
    assert capsys.readouterr().out == f"{name} -> copy.toml\n"
    assert (tmp_path / "copy.toml").read_text(encoding="utf-8") == example_text(name)
    for command in ("modes", "aircraft" if name in AIRCRAFT else "flutter"):
        assert answer(command, "copy.toml") == answer(command, name)


@pytest.mark.parametrize("name", [*ALL, *measurement_names()])
def test_shown_as_it_is_shipped(capsys, name):
    assert run(["examples", name]) == 0
    assert capsys.readouterr().out == example_text(name)


def test_list_names_everything(capsys):
    assert run(["examples"]) == 0
    out = capsys.readouterr().out
    for name in ALL:
        title = parse_file(example_text(name)).title
        assert re.search(rf"^{re.escape(name)} +{re.escape(title)}\s*$", out, re.MULTILINE)
    for name in measurement_names():
        assert name in out


@pytest.mark.parametrize("name", [*ALL, *measurement_names()])
def test_source_is_named(name):
    comment = "".join(line for line in example_text(name).splitlines(True) if line[0] == "#")
    assert "Source: " in comment
    assert re.search(r"\b(19|20)\d\d\b", comment)


# ------------------------------------------------------------------- the numbers in the comments


def comment(name):
    lines = example_text(name).splitlines()
    return " ".join(line.lstrip("# ") for line in lines if line.startswith("#"))


def given(name, pattern):
    found = re.search(pattern, comment(name))
    assert found, f"{pattern!r} is not in the comments of {name}"
    return found[1]


def test_frequencies_that_the_moduli_were_identified_from(answer):
    printed = [float(text) for text in given("three-segment", r"clamped: ([\d., ]+) Hz").split(",")]
    tolerance = float(given("three-segment", r"within ([\d.]+) %")) / 100.0
    modes = answer("modes", "three-segment", "--fold", "30,-30")
    assert len(printed) == 4
    assert modes["natural_frequencies_hz"][:4] == pytest.approx(printed, rel=tolerance)


def test_printed_material_gives_other_frequencies(answer):
    ours, printed = (
        answer("modes", name)["natural_frequencies_hz"]
        for name in ("three-segment", "three-segment-table-2-1")
    )
    assert abs(printed[0] / ours[0] - 1.0) > 0.02


@pytest.mark.parametrize("name", ["three-segment", "three-segment-table-2-1"])
def test_three_segment_wing(name):
    wing = read_model(name)
    thickness = float(Fraction(given(name, r"(1/16) in"))) * INCH
    stiffness = float(given(name, r"([\d.]+) N\*m/rad in all"))
    assert [s.thickness for s in wing.segments] == pytest.approx([thickness] * 3)
    assert [s.chord for s in wing.segments] == pytest.approx([0.05] * 3)
    assert [hinge.stiffness for hinge in wing.hinges] == pytest.approx([stiffness] * 2)
    assert [hinge.springs for hinge in wing.hinges] == [3, 3]
    assert wing.air.density == float(given(name, r"([\d.]+) kg/m\^3"))


def test_moduli_of_table_2_1():
    section = read_model("three-segment-table-2-1").segments[0]
    shear, cube = 3.0e9 / (2 * (1 + 0.45)), section.chord * section.thickness**3
    assert section.bending_stiffness == pytest.approx(3.0e9 * cube / 12)
    assert section.torsion_stiffness == pytest.approx(shear * cube / 3)


@pytest.mark.parametrize("name", ["friction-hinge-1", "friction-hinge-2"])
def test_friction_hinge_wings(name):
    wing = read_model(name)
    thickness = float(given(name, r"([\d.]+) mm \* 0\.98")) * 0.98e-3
    youngs = 3.0e9 * (1 + float(given(name, r"Young's modulus by (\d+) %")) / 100)
    shear = float(given(name, r"from ([\d.]+) GPa, which")) * 0.9e9
    mass = (float(given(name, r"gives ([\d.]+) g for a hinge")) + 5.2) / 2 * 1e-3
    arm = float(given(name, r"gyration of ([\d.]+) mm")) * 1e-3
    for section in wing.segments:
        cube = section.chord * thickness**3
        assert section.thickness == pytest.approx(thickness)
        assert section.bending_stiffness == pytest.approx(youngs * cube / 12, rel=1e-3)
        assert section.torsion_stiffness == pytest.approx(shear * cube / 3, rel=1e-3)
    assert [mass.segment for mass in wing.point_masses] == [1, 1, 2, 2]
    for point in wing.point_masses:
        assert point.mass == pytest.approx(mass)
        assert abs(point.x) == pytest.approx(arm)
        assert point.y == pytest.approx(wing.segments[point.segment - 1].span)


def test_goland_wing():
    section = read_model("goland").segments[0]
    feet = [float(given("goland", rf"{what} (\d+) ft")) for what in ("Span", "chord")]
    assert [section.span, section.chord] == pytest.approx([foot * 12 * INCH for foot in feet])
    axis, centre = (float(given("goland", rf"{what} at (\d+) %")) for what in ("axis", "centre"))
    assert (section.elastic_axis, section.mass_centre) == pytest.approx((axis / 100, centre / 100))


def test_hale_wing():
    section = read_model("hale").segments[0]
    span = float(given("hale", r"span (\d+) m"))
    axis = float(given("hale", r"both at (\d+) % of the chord")) / 100
    assert (section.span, section.elastic_axis, section.mass_centre) == (span, axis, axis)


def test_section_with_a_second_mass(answer):
    section = read_section("airfoil-3dof")
    air, inertia = (
        float(given("airfoil-3dof", rf"1/([\d.]+) of the printed {what}"))
        for what in ("air", "one")
    )
    assert (section.mass_ratio, section.inertia_ratio) == pytest.approx((1 / air, 1 / inertia))
    printed = given("airfoil-3dof", r"at rest ([\d.]+ and [\d.]+);").split(" and ")
    ours = answer("section", "airfoil-3dof")["natural_frequency_ratios"]
    assert ours[:2] == pytest.approx([float(text) for text in printed], abs=0.005)


def test_section_of_two_degrees_of_freedom_is_the_other_without_its_mass():
    two, three = read_section("airfoil-2dof"), read_section("airfoil-3dof")
    fewer = {"title": two.title, "second_mass_ratio": None, "second_frequency_ratio": None}
    assert three.model_copy(update=fewer) == two


def test_section_of_hodges_and_pierce():
    section = read_section("hodges-pierce")
    ratio, a, e, r2, sigma = (
        float(Fraction(given("hodges-pierce", rf"{key} (-?[\d/]+)")))
        for key in ("mass ratio", "a =", "e =", r"r\^2 =", "omega_theta =")
    )
    assert (section.mass_ratio, section.axis_offset) == pytest.approx((ratio, a))
    assert section.mass_offset == pytest.approx(e - a)
    assert section.inertia_ratio == pytest.approx(r2)
    assert section.torsion_frequency_ratio == pytest.approx(1 / sigma)


def test_measurements_belong_to_the_level_tip(answer, tmp_path):
    measured = read_measured("level-tip-wind-tunnel").columns
    assert np.array_equal(measured["fold_3"], -measured["fold_2"])
    sweep = ("boundary", "three-segment", "--fold2", "75:120:15", "--fold3", "level")
    cases = answer(*sweep, "--measured", "level-tip-wind-tunnel")["cases"]
    assert [case["fold"][0] for case in cases] == measured["fold_2"].tolist()
