"""The command section: its document, its tables, its files, its pictures and its errors."""

import csv

import numpy as np
import pytest

from foldwing.model import example_text
from foldwing.plots.catalogue import pictures
from foldwing.plots.picture import Line, Note, Rule
from foldwing.results import read_dataset

THREE = "airfoil-3dof"
SWEEP = ("--torsion", "3.6:4:0.1")
POINT = {
    "kind", "event", "class", "speed", "frequency", "strength", "mode", "mode_confidence",
    "speed_ratio", "frequency_ratio",
}  # fmt: skip
CASE = {
    "torsion_frequency_ratio", "natural_frequency_ratios", "mode_names", "flutter_points",
    "critical", "certified", "unstable_from_start", "status",
}  # fmt: skip
SCALED = """title = "Goland's section"
[section]
chord = "1.8288 m"
elastic_axis = 0.33
mass_centre = 0.43
mass_per_span = "35.71 kg/m"
inertia_per_span = "8.64 kg*m"
plunge_frequency = "7.7 Hz"
torsion_frequency = "13.9 Hz"
[air]
density = 1.225
"""
WAY = 2 * np.pi * 7.7 * 0.9144
"""b omega_1 of that section in m/s."""


@pytest.fixture
def scaled(empty_folder):
    (empty_folder / "scaled.toml").write_text(SCALED, encoding="utf-8")
    return "scaled.toml"


def test_document_of_one_case(cli, empty_folder):
    answer = cli("section", "hodges-pierce", "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.count("\n") == 1
    assert set(answer.json) == CASE
    assert answer.json["mode_names"] == ["plunge", "pitch"]
    flutter, divergence = answer.json["flutter_points"]
    assert set(flutter) == POINT
    assert 0.4 * flutter["speed_ratio"] == pytest.approx(2.183915, abs=1e-5)
    assert 0.4 * flutter["frequency_ratio"] == pytest.approx(0.648984, abs=1e-5)
    assert (flutter["speed"], flutter["frequency"], flutter["strength"]) == (None, None, None)
    assert divergence["frequency_ratio"] == 0.0
    assert answer.json["critical"] == flutter
    assert list(empty_folder.iterdir()) == []


def test_document_of_a_section_with_dimensions(cli, scaled):
    for point in cli("section", scaled, "--json").json["flutter_points"]:
        assert point["speed"] == pytest.approx(WAY * point["speed_ratio"], rel=1e-12)
        assert point["frequency"] == pytest.approx(7.7 * point["frequency_ratio"], rel=1e-12)


def test_document_of_a_sweep(cli):
    answer = cli("section", THREE, *SWEEP, "--json")
    assert (answer.status, answer.err) == (0, "")
    assert set(answer.json) == {"cases", "changes", "crossing_torsion_ratios"}
    cases = answer.json["cases"]
    assert [case["torsion_frequency_ratio"] for case in cases] == [3.6, 3.7, 3.8, 3.9, 4.0]
    assert all(set(case) == CASE and case["certified"] for case in cases)
    (change,) = answer.json["changes"]
    assert change["kind"] == "crossing" and change["confirmed"] is True
    assert 3.7 < change["torsion_frequency_ratio"] < 3.8
    low, high = change["frequency_ratio"]
    assert low == pytest.approx(1.965, abs=1e-3) and high == pytest.approx(3.709, abs=1e-3)
    assert (change["speed"], change["frequency"]) == (None, None)
    assert answer.json["crossing_torsion_ratios"][1] == pytest.approx(3.541, abs=1e-3)


def test_changes_of_a_section_with_dimensions(cli, scaled):
    (change,) = cli("section", scaled, "--torsion", "0.3:1:0.1", "--json").json["changes"][:1]
    for speed, ratio in zip(change["speed"], change["speed_ratio"], strict=True):
        assert speed == pytest.approx(WAY * ratio, rel=1e-12)
    for hertz, ratio in zip(change["frequency"], change["frequency_ratio"], strict=True):
        assert hertz == pytest.approx(7.7 * ratio, rel=1e-12)


def test_torsion_of_one_number_replaces_the_models(cli):
    answer = cli("section", THREE, "--torsion", "7", "--json").json
    assert answer["torsion_frequency_ratio"] == 7.0
    assert answer["critical"]["speed_ratio"] == pytest.approx(14.858, abs=1e-3)


def test_quasi_steady_is_another_theory(cli):
    one, other = (
        cli("section", THREE, "--aero", aero, "--json").json for aero in ("strip", "quasi-steady")
    )
    assert one["natural_frequency_ratios"] < other["natural_frequency_ratios"]
    divergence = [
        [p for p in each["flutter_points"] if p["kind"] == "divergence"] for each in (one, other)
    ]
    assert divergence[0][0]["speed_ratio"] == pytest.approx(divergence[1][0]["speed_ratio"])


def test_table_of_one_case(cli):
    answer = cli("section", "hodges-pierce", "--no-plot", "--out", "x")
    assert answer.status == 0
    words = " ".join(answer.out.split())
    assert "Flutter begins at 5.46 b omega_1 with 1.62 omega_1 (mode pitch)" in words
    assert "At rest: plunge 0.97173, pitch 2.528 omega_1." in words
    assert "Certified" in words
    assert answer.out.isascii()


@pytest.mark.parametrize("model", [THREE, "scaled.toml"])
def test_tables_of_a_sweep_fit_the_terminal(cli, scaled, model):
    answer = cli("section", model, "--torsion", "0.5:4:0.5", "--no-plot", "--out", "x")
    lines = answer.out.splitlines()
    assert max(map(len, lines)) <= 80
    assert answer.out.isascii()
    assert "…" not in answer.out and "..." not in answer.out
    assert ("m/s" in answer.out) == (model != THREE)


def test_the_change_is_told_in_words(cli):
    words = " ".join(cli("section", THREE, *SWEEP, "--no-plot", "--out", "x").out.split())
    assert "goes over from flutter with 1.97 omega_1 to flutter with 3.71 omega_1" in words


def test_files_hold_the_answer(cli, empty_folder):
    answer = cli("section", THREE, *SWEEP, "--json", "--out", "x").json
    folder = empty_folder / "x"
    rows = {}
    for name in ("flutter_points", "natural_frequencies", "changes"):
        with (folder / f"{name}.csv").open(encoding="utf-8") as file:
            rows[name] = list(csv.DictReader(file))
    points = [point for case in answer["cases"] for point in case["flutter_points"]]
    for name in ("speed_ratio", "frequency_ratio"):
        assert [float(row[name]) for row in rows["flutter_points"]] == [p[name] for p in points]
    assert {row["torsion_frequency_ratio"] for row in rows["flutter_points"]} == {
        "3.6", "3.7", "3.8", "3.9", "4.0",
    }  # fmt: skip
    assert len(rows["natural_frequencies"]) == 15
    (change,), (row,) = answer["changes"], rows["changes"]
    assert float(row["torsion_frequency_ratio"]) == change["torsion_frequency_ratio"]
    assert float(row["frequency_above"]) == change["frequency_ratio"][1]
    assert (folder / "section-boundary.png").stat().st_size > 10_000
    report = (folder / "report.html").read_text(encoding="utf-8")
    assert "goes over to another curve" in report and "b ω₁" in report
    assert "m/s" not in report.partition("<script>")[0]


def test_one_case_has_its_pictures(cli, empty_folder):
    assert cli("section", "hodges-pierce", "--out", "x").status == 0
    names = {path.name for path in (empty_folder / "x").glob("*.png")}
    assert names == {"growth-and-frequency.png", "root-locus.png"}


def drawn(cli, folder, *arguments):
    """Return the dataset of a run and its pictures by name."""
    assert cli("section", *arguments, "--no-plot", "--out", "x").status == 0
    dataset = read_dataset(folder / "x" / "dataset.nc")
    return dataset, {picture.name: picture for picture in pictures(dataset)}


def test_axes_of_a_section_in_ratios_say_so(cli, empty_folder):
    dataset, by_name = drawn(cli, empty_folder, "hodges-pierce")
    assert {dataset[name].attrs["units"] for name in ("speed", "flutter_speed", "growth")} == {"1"}
    upper, lower = by_name["growth-and-frequency"].panels
    assert upper.x_label == "airspeed U/(b ω₁)"
    assert (upper.y_label, lower.y_label) == ("growth rate Re λ/ω₁", "frequency ω/ω₁")
    (locus,) = by_name["root-locus"].panels
    assert (locus.x_label, locus.y_label) == (upper.y_label, lower.y_label)
    texts = [item.text for item in upper.items if isinstance(item, Note)]
    assert "flutter begins 5.46 b ω₁" in texts
    at_rest = dataset["frequency"].values[0, 0, :2]
    np.testing.assert_allclose(at_rest, dataset["natural_frequency"].values[0, :2], rtol=1e-9)


def test_axes_of_a_section_with_dimensions_have_units(cli, empty_folder, scaled):
    dataset, by_name = drawn(cli, empty_folder, scaled)
    assert dataset["flutter_speed"].attrs["units"] == "m/s"
    (panel,) = by_name["root-locus"].panels
    assert (panel.x_label, panel.y_label) == ("growth rate (1/s)", "frequency (Hz)")


def test_boundary_marks_the_change_and_the_frequencies_in_tune(cli, empty_folder):
    dataset, by_name = drawn(cli, empty_folder, THREE, "--torsion", "3.4:4:0.1")
    speed, frequency = by_name["section-boundary"].panels
    at = float(dataset["change_torsion_ratio"][0])
    for panel in (speed, frequency):
        rules = {item.color: item.at for item in panel.items if isinstance(item, Rule)}
        assert rules["warning"] == at
        assert rules["muted"] == pytest.approx(3.541, abs=1e-3)
    (step,) = (i for i in frequency.items if isinstance(i, Line) and i.color == "warning")
    assert step.y.tolist() == dataset["change_frequency"].values[0].tolist()
    assert "U/(b ω₁)" in speed.y_label and "ω/ω₁" in frequency.y_label
    low, high = speed.y_range
    assert low <= dataset["change_speed"].values.min() < dataset["change_speed"].values.max() < high


def with_changes(name, *pairs):
    text = example_text(name)
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return text


INERTIA = "inertia_ratio = 0.24"
BAD_MODELS = [
    (INERTIA, "inertia_ratio = 0.005", "section.inertia_ratio", "0.005", "0.01", "elastic axis"),
    (INERTIA, "inertia_ratio = -1", "section.inertia_ratio", "-1", "greater than 0", "2.5"),
    (INERTIA, "", "section.inertia_ratio", "missing", "must be given", "inertia_ratio = 0.24"),
    (INERTIA, f"{INERTIA}\nchord = 1.0", "section.chord", "1.0", "in ratios or with dim", "Remove"),
    (INERTIA, f"{INERTIA}\nsecond_mass_ratio = 1", "section.second_frequency_ratio", "missing",
     "together with second_mass_ratio", "Add second_frequency_ratio"),
    (INERTIA, f"{INERTIA}\nsecond_mass_ratio = 0", "section.second_mass_ratio", "0",
     "greater", "2.5"),
    ("= 2.5", "= 0", "section.torsion_frequency_ratio", "got 0;", "greater than 0", "2.5"),
    ("= 0.1", "= 1.3", "section.mass_offset", "1.3", "on the chord", "elastic axis"),
    ("axis_offset", "axis_ofset", "section.axis_ofset", "-0.2", "not a known key", "axis_offset?"),
    ("[section]", "[air]\ndensity = 1.2\n[section]", "air", "1.2", "mass_ratio", "Remove [air]"),
    ("[section]", "[lattice]\nchordwise = 8\n[section]", "lattice", "belongs to a wing", "Remove"),
    ("[section]", "[analysis]\nsystem_modes = 8\n[section]", "analysis.system_modes",
     "wing", "Remove"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "words"), [(m[0], m[1], m[2:]) for m in BAD_MODELS])
def test_bad_models(cli, empty_folder, no_computing, old, new, words):
    (empty_folder / "m.toml").write_text(with_changes("hodges-pierce", (old, new)))
    answer = cli("section", "m.toml")
    assert answer.status == 2
    for word in words:
        assert word in answer.err
    assert [path.name for path in empty_folder.iterdir()] == ["m.toml"]


BAD_DIMENSIONS = [
    ('"8.64 kg*m"', "0.1", "section.inertia_per_span", "0.1", "1.19", "mass_centre"),
    ('"13.9 Hz"', "0", "section.torsion_frequency", "got 0;", "greater than 0 Hz", '"8 Hz"'),
    ('"13.9 Hz"', '"3 kg"', "section.torsion_frequency", "'3 kg'", "is [mass]", "Hz"),
    ("plunge_frequency", "# ", "section.plunge_stiffness", "missing", "plunge_frequency must",
     "Add"),
    ("[air]", "half_chord = 1\n[air]", "section.half_chord", "1.0", "only one", "Remove chord"),
    ("[air]", "second_frequency = 3\n[air]", "section.second_mass_per_span", "missing",
     "together", "Add second_mass_per_span"),
    ("[air]", "second_mass_per_span = 3\n[air]", "section.second_stiffness", "missing",
     "must be given", "Add second_frequency"),
    ("[air]", "mass_ratio = 3\n[air]", "section.chord", "mass_ratio is a ratio", "Remove chord"),
    ('mass_per_span = "35.71 kg/m"\n', "", "section.mass_per_span", "missing", "dimensions", "Add"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "words"), [(m[0], m[1], m[2:]) for m in BAD_DIMENSIONS])
def test_bad_dimensions(cli, empty_folder, no_computing, old, new, words):
    assert old in SCALED
    (empty_folder / "m.toml").write_text(SCALED.replace(old, new, 1))
    answer = cli("section", "m.toml")
    assert answer.status == 2
    for word in words:
        assert word in answer.err


BAD_OPTIONS = [
    (("section", "goland"), "section", "missing", "[section]", "foldwing modes"),
    (("flutter", "hodges-pierce"), "wing", "missing", "[wing]", "foldwing section"),
    (("modes", "hodges-pierce"), "wing", "missing", "[wing]", "foldwing section"),
    (("section", "hodge-pierce"), "MODEL", "Did you mean hodges-pierce?"),
    (("section", THREE, "--torsion", "0:8:1"), "--torsion", "'0:8:1'", "greater than 0", "0.5:8"),
    (("section", THREE, "--torsion", "-1"), "--torsion", "'-1'", "greater than 0", "0.5:8"),
    (("section", THREE, "--torsion", "1e9"), "--torsion", "'1e9'", "at most 10000", "0.5:8"),
    (("section", THREE, "--torsion", "stiff"), "--torsion", "'stiff'", "numbers", "0.5:8"),
    (("section", THREE, "--torsion", "8:1:1"), "--torsion", "'8:1:1'", "start to stop", "1:8:1"),
    (("section", THREE, *SWEEP, "--speeds", "0:9:1"), "--speeds", "not 5", "--max-speed"),
    (("section", THREE, "--speeds", "-1:9:1"), "--speeds", "negative", "b omega_1"),
    (("section", THREE, "--max-speed", "0"), "--max-speed", "0.0", "b omega_1", "such as 60"),
    (("section", THREE, "--max-speed", "fast"), "--max-speed", "'fast'", "a number", "30"),
    (("section", THREE, "--damping-threshold", "2"), "--damping-threshold", "2.0", "0.5", "0.02"),
]


@pytest.mark.parametrize(("arguments", "words"), [(case[0], case[1:]) for case in BAD_OPTIONS])
def test_bad_options(cli, empty_folder, no_computing, arguments, words):
    answer = cli(*arguments)
    assert answer.status == 2
    assert answer.out == ""
    for word in words:
        assert word in answer.err
    assert list(empty_folder.iterdir()) == []


def test_a_failed_case_is_named(cli, monkeypatch):
    from foldwing.studies import section as studies

    def fails(problem, *arguments):
        raise np.linalg.LinAlgError("singular")

    monkeypatch.setattr(studies, "find_flutter", fails)
    answer = cli("section", THREE, "--torsion", "3,4", "--json")
    assert answer.status == 1
    assert answer.err.count("singular") == 2
    assert [case["status"] for case in answer.json["cases"]] == ["failed", "failed"]


def test_an_existing_result_is_kept(cli, empty_folder):
    assert cli("section", "hodges-pierce", "--no-plot", "--out", "x").status == 0
    assert cli("section", THREE, "--no-plot", "--out", "x").status == 2
    assert cli("section", THREE, "--no-plot", "--out", "x", "--force").status == 0
