"""Flutter points followed while one setting at a time is changed."""

import csv
import re

import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.results import read_dataset
from foldwing.studies import convergence
from foldwing.studies.case import solve_case
from foldwing.studies.settings import SETTINGS
from foldwing.studies.variants import variants

CHEAP = ("convergence", "three-segment", "--fold", "30,-75", "--aero", "lattice", "--panels", "4x9")
MESH = ("--vary", "chordwise,spanwise,wake", "--levels", "wake=5,10")


def named(answer, **fields):
    """The one flutter point with these fields."""
    found = [
        point
        for point in answer["flutter_points"]
        if all(point[key] == value for key, value in fields.items())
    ]
    assert len(found) == 1
    return found[0]


def test_document(cli, empty_folder):
    answer = cli(*CHEAP, *MESH, "--json")
    assert answer.status == 0
    assert list(empty_folder.iterdir()) == []
    point = named(answer.json, mode="T1", event="onset")
    assert list(point["settings"]) == ["chordwise", "spanwise", "wake"]
    chord, span, wake = point["settings"].values()
    assert [level["value"] for level in chord["levels"]] == [1, 2, 4, 8, 16]
    assert [level["value"] for level in span["levels"]] == [5, 9, 18, 36]
    assert [level["value"] for level in wake["levels"]] == [5, 10, 20]
    for setting in (chord, span, wake):
        own = [level["speed"] for level in setting["levels"] if level["own"]]
        assert own == [point["speed"]]
    errors = [setting["error_speed"] for setting in (chord, span, wake)]
    assert point["error_speed"] == pytest.approx(sum(errors))
    moved = [setting["limit_speed"] - point["speed"] for setting in (chord, span, wake)]
    assert point["limit_speed"] - point["speed"] == pytest.approx(sum(moved))
    assert chord["convergence"] == "monotone"
    assert chord["order"] == pytest.approx(2.0, abs=0.2)


def test_each_level_is_the_case_solved_with_it(cli):
    document = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=6,8", "--json").json
    levels = named(document, mode="B2", event="onset")["settings"]["chordwise"]["levels"]
    assert [level["value"] for level in levels] == [4, 6, 8]
    for level in levels:
        panels = f"{level['value']:g}x9"
        alone = cli("flutter", *CHEAP[1:-1], panels, "--max-speed", "60", "--json").json
        point = named(alone, mode="B2", event="onset")
        assert level["speed"] == pytest.approx(point["speed"], rel=1e-9)
        assert level["frequency"] == pytest.approx(point["frequency"], rel=1e-9)


def test_tables_and_files(cli, empty_folder):
    answer = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=2,8", "--out", "a")
    assert answer.status == 0
    assert re.search(r"^T1 onset +\d+\.\d+ +\d+\.\d+ +\d+\.\d+ +\d\.\d\d ", answer.out, re.M)
    assert "4*" in answer.out
    assert max(map(len, answer.out.splitlines())) <= 80
    names = {path.name for path in (empty_folder / "a").iterdir()}
    assert {"levels.csv", "convergence.csv", "flutter_points.csv", "convergence.png"} <= names
    dataset = read_dataset(empty_folder / "a" / "dataset.nc")
    with (empty_folder / "a" / "levels.csv").open() as file:
        lines = list(csv.DictReader(file))
    assert len(lines) == 3 * dataset.sizes["flutter_point"]
    assert float(lines[0]["speed"]) == dataset["level_speed"].values[0, 0]
    with (empty_folder / "a" / "convergence.csv").open() as file:
        orders = list(csv.DictReader(file))
    assert float(orders[0]["order"]) == dataset["order"].values[0, 0]
    assert {line["setting"] for line in orders} == {"chordwise"}


def test_total_is_unknown_unless_chord_span_and_wake_are_varied(cli):
    document = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=2,8", "--json").json
    assert all(point["error_speed"] is None for point in document["flutter_points"])


def test_strip_theory_varies_the_modes_alone(cli):
    levels = ("--levels", "segment-modes=6,8", "--levels", "system-modes=8,10")
    answer = cli("convergence", "goland", *levels, "--no-plot", "--out", "a")
    assert answer.status == 0
    document = cli("convergence", "goland", *levels, "--json").json
    for point in document["flutter_points"]:
        assert list(point["settings"]) == ["segment-modes", "system-modes"]
    assert answer.out.startswith("Largest error bars of the airspeeds: ")


def test_a_wing_without_flutter_has_nothing_to_converge(cli):
    levels = ("--vary", "system-modes", "--levels", "system-modes=8,10")
    answer = cli("convergence", "goland", "--max-speed", "20", *levels, "--out", "a")
    assert answer.status == 0
    assert "nothing to converge" in answer.out
    named_files = cli("convergence", "goland", "--max-speed", "20", *levels, "--json").json
    assert named_files["flutter_points"] == []


def test_a_failing_level_is_named_and_the_others_stand(cli, monkeypatch):
    def fails_at_two(model, folds, speeds):
        if model.wing.lattice.chordwise == 2:
            raise ArithmeticError("too coarse")
        return solve_case(model, folds, speeds)

    monkeypatch.setattr(convergence, "solve_case", fails_at_two)
    answer = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=2,8", "--json")
    assert answer.status == 1
    assert "chordwise 2: failed: ArithmeticError: too coarse" in answer.err
    chord = named(answer.json, mode="T1", event="onset")["settings"]["chordwise"]
    assert [level["speed"] is None for level in chord["levels"]] == [True, False, False]
    assert chord["convergence"] == "few"
    assert answer.json["failures"] == ["chordwise 2: failed: ArithmeticError: too coarse"]


def test_a_point_without_a_finer_counterpart_has_no_error_bar(cli, monkeypatch):
    def fails_at_eight(model, folds, speeds):
        if model.wing.lattice.chordwise == 8:
            raise ArithmeticError("too fine")
        return solve_case(model, folds, speeds)

    monkeypatch.setattr(convergence, "solve_case", fails_at_eight)
    answer = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=2,8", "--json")
    chord = answer.json["flutter_points"][0]["settings"]["chordwise"]
    assert (chord["convergence"], chord["error_speed"]) == ("missing", None)


def test_an_interruption_keeps_what_is_finished(cli, monkeypatch):
    def interrupted_at_eight(model, folds, speeds):
        if model.wing.lattice.chordwise == 8:
            raise KeyboardInterrupt
        return solve_case(model, folds, speeds)

    monkeypatch.setattr(convergence, "solve_case", interrupted_at_eight)
    answer = cli(*CHEAP, "--vary", "chordwise", "--levels", "chordwise=2,8", "--json")
    assert answer.status == 1
    assert answer.json["interrupted"] == "1 of 2 variants finished"
    chord = answer.json["flutter_points"][0]["settings"]["chordwise"]
    assert [level["speed"] is None for level in chord["levels"]] == [False, False, True]


def test_meshes_are_refined_alike_and_gaps_shrink_together():
    wing = read_model("three-segment").with_gaps("1 mm")
    found = variants(AeroelasticWing(wing, "lattice"))
    assert list(dict.fromkeys(variant.setting for variant in found)) == list(SETTINGS)
    spanwise = [one.wing.lattice.spanwise for one in found if one.setting == "spanwise"]
    assert spanwise == [(7, 5, 3), 30, (28, 20, 12), (56, 40, 24)]
    gaps = [[h.gap for h in one.wing.hinges] for one in found if one.setting == "gap"]
    assert gaps == [[gap, gap] for gap in (0.0, 0.25e-3, 0.5e-3, 1e-3)]
    schemes = {one.wing.lattice.scheme for one in found if one.setting == "time-step"}
    assert schemes == {"average"}
    own = [one.setting for one in found if one.own]
    assert own == [name for name in SETTINGS if name != "time-step"]
    assert all(one.wing == wing for one in found if one.own)


def test_a_costly_level_is_left_out():
    wing = read_model("three-segment").with_lattice(chordwise=32, spanwise=60)
    counts = [
        one.value
        for one in variants(AeroelasticWing(wing, "lattice"), ("chordwise",))
        if one.setting == "chordwise"
    ]
    assert counts == [8, 16, 32, 64]


def test_fewer_than_three_levels_are_refused_before_computing(cli, monkeypatch):
    monkeypatch.setattr(convergence, "solve_case", None)
    for levels, own in (("chordwise=4", 4), ("chordwise=8", 4), ("spanwise=9,18", 9)):
        answer = cli(*CHEAP, "--vary", levels.split("=")[0], "--levels", levels)
        assert (answer.status, answer.out) == (2, "")
        wanted = f"got '{levels}'; at least 3 levels are needed, the model's own {own} among them"
        assert wanted in " ".join(answer.err.split())


@pytest.mark.parametrize(("bending", "torsion"), [(12, 6), (6, 12), (10, 10), (40, 5)])
def test_bending_and_torsion_modes_keep_their_proportion(bending, torsion):
    wing = read_model("goland").with_analysis(bending_modes=bending, torsion_modes=torsion)
    found = variants(AeroelasticWing(wing, "strip"), ("segment-modes",))
    assert sum(one.own for one in found) == 1
    for one in found:
        analysis = one.wing.analysis
        assert analysis.bending_modes * torsion == analysis.torsion_modes * bending
