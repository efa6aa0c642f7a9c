"""The command steady: its document, its tables, its files and its failures."""

import csv
import re

import pytest

from foldwing.model import example_text, read_model
from foldwing.results import read_dataset
from foldwing.studies.steady import steady_study

THREE = "three-segment"
LEVEL = ("--fold2", "0,60,90,120", "--fold3", "level", "--panels", "2x12")
WHOLE = {
    "lift_slope", "projected_lift_slope", "lift_coefficient", "lift", "side_force", "induced_drag",
    "least_drag", "efficiency", "pitching_moment", "root_moment", "aerodynamic_centre",
    "projected_area",
}  # fmt: skip
PER_SEGMENT = {
    "normal_force", "lift", "side_force", "pitching_moment", "bending_moment", "centre_x",
    "centre_y",
}  # fmt: skip


def test_document(cli, empty_folder):
    answer = cli("steady", THREE, *LEVEL, "--alpha", "4", "--speed", "15", "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.count("\n") == 1
    assert (answer.json["alpha"], answer.json["speed"]) == (4.0, 15.0)
    assert answer.json["reference_area"] == pytest.approx(0.30 * 0.05)
    cases = answer.json["cases"]
    assert [case["fold"] for case in cases] == [[f, -f + 0.0] for f in (0.0, 60.0, 90.0, 120.0)]
    for case in cases:
        assert set(case) == {"fold", "status", "loads"}
        (loads,) = case["loads"]
        assert set(loads) == WHOLE | {"gaps", "hinge_moments", "segments"}
        assert loads["gaps"] == "closed"
        assert len(loads["hinge_moments"]) == 2
        assert [set(segment) for segment in loads["segments"]] == [PER_SEGMENT] * 3
    slopes = [case["loads"][0]["lift_slope"] for case in cases]
    assert slopes == sorted(slopes, reverse=True)
    assert list(empty_folder.iterdir()) == []


def test_lift_follows_from_its_slope(cli):
    loads = cli("steady", THREE, "--fold", "0,0", "--alpha", "5", "--json").json["cases"][0][
        "loads"
    ]
    pressure, radians = 0.5 * 1.2 * 20.0**2, 0.0872664626
    wanted = loads[0]["lift_slope"] * radians * pressure * 0.015
    assert loads[0]["lift"] == pytest.approx(wanted, rel=1e-9)


def test_gaps_are_shown_with_the_closed_wing(cli):
    (case,) = cli("steady", THREE, "--gap", "1 mm", "--json").json["cases"]
    assert [loads["gaps"] for loads in case["loads"]] == ["open", "closed"]
    assert case["loads"][0]["lift"] < case["loads"][1]["lift"]
    (plain,) = cli("steady", THREE, "--json").json["cases"]
    assert plain["loads"][0]["lift"] == case["loads"][1]["lift"]


def test_a_wall_raises_the_lift(cli):
    lift = [
        cli("steady", "goland", *wall, "--json").json["cases"][0]["loads"][0]["lift"]
        for wall in ((), ("--image",))
    ]
    assert lift[1] > 1.1 * lift[0]


def test_no_angle_no_lift(cli):
    (case,) = cli("steady", THREE, "--alpha", "0", "--json").json["cases"]
    assert case["loads"][0]["lift"] == case["loads"][0]["induced_drag"] == 0.0
    assert case["loads"][0]["lift_slope"] > 3.0
    assert cli("steady", THREE, "--alpha", "0", "--out", "still").status == 0


def test_table_of_a_sweep(cli):
    answer = cli("steady", THREE, *LEVEL, "--gap", "1 mm", "--no-plot", "--out", "x")
    assert answer.status == 0
    lines = answer.out.splitlines()
    assert sum(" open " in line for line in lines) == sum(" closed " in line for line in lines) == 4
    assert "5 deg and 20 m/s" in lines[0]
    assert max(map(len, lines)) <= 80
    assert "On each segment" not in answer.out


def test_table_of_one_case_has_its_segments(cli):
    answer = cli("steady", THREE, "--no-plot", "--out", "x")
    assert "On each segment" in answer.out
    assert "the lift slope is 3.928 per radian" in " ".join(answer.out.split())


def test_files_hold_the_answer(cli, empty_folder):
    cases = cli("steady", THREE, *LEVEL, "--gap", "1 mm", "--json", "--out", "x").json["cases"]
    folder = empty_folder / "x"
    loads = [loads for case in cases for loads in case["loads"]]
    rows = {}
    for name in ("steady_loads", "segment_loads", "circulation"):
        with (folder / f"{name}.csv").open(encoding="utf-8") as file:
            rows[name] = list(csv.DictReader(file))
    assert [float(row["lift"]) for row in rows["steady_loads"]] == [each["lift"] for each in loads]
    moments = [float(row["hinge_moment_3"]) for row in rows["steady_loads"]]
    assert moments == [each["hinge_moments"][1] for each in loads]
    wanted = [segment["lift"] for each in loads for segment in each["segments"]]
    assert [float(row["lift"]) for row in rows["segment_loads"]] == wanted
    lift = sum(  # of the flat wing with its gaps: density, airspeed, circulation, width
        1.2 * 20.0 * float(row["circulation"]) * (float(row["outer"]) - float(row["inner"]))
        for row in rows["circulation"]
        if (row["case"], row["gaps"]) == ("0", "open")
    )
    assert lift == pytest.approx(loads[0]["lift"], rel=1e-9)
    for name in ("circulation", "circulation-across", "circulation-in-space"):
        assert (folder / f"{name}.png").stat().st_size > 10_000
    report = (folder / "report.html").read_text(encoding="utf-8")
    assert "Steady loads" in report and "On each segment" in report
    dataset = read_dataset(folder / "dataset.nc")
    assert dataset["lift"].values.ravel().tolist() == [each["lift"] for each in loads]


def test_segments_folded_on_each_other(cli, empty_folder):
    answer = cli("steady", THREE, "--fold", "180,0", "--out", "x")
    assert (answer.status, answer.out) == (2, "")
    for words in ("fold: got '180, 0'", "segments 1 and 2 lie on each other", "some degrees"):
        assert words in answer.err
    assert not (empty_folder / "x").exists()


def test_one_hopeless_case_does_not_end_a_sweep(cli, empty_folder):
    options = ("--fold2", "0,180", "--fold3", "0", "--gap", "1 mm")
    answer = cli("steady", THREE, *options, "--json", "--out", "x")
    assert answer.status == 1
    good, bad = answer.json["cases"]
    assert (good["status"], bad["status"]) == ("ok", "failed")
    assert bad["loads"] == [] and "lie on each other" in bad["message"]
    assert "fold 180, 0 deg: failed" in answer.err
    assert (empty_folder / "x" / "circulation.png").exists()
    with (empty_folder / "x" / "steady_loads.csv").open(encoding="utf-8") as file:
        assert [row["lift"] == "" for row in csv.DictReader(file)] == [False, False, True, True]


def test_close_segments_are_named(cli):
    answer = cli("steady", THREE, "--fold", "178,0", "--json")
    (case,) = answer.json["cases"]
    assert "come within 0.17 mm of each other" in case["message"]
    assert case["loads"][0]["efficiency"] is None or case["loads"][0]["efficiency"] <= 1.0


@pytest.mark.parametrize("word", ["alfa", "sped"])
def test_the_study_rejects_unknown_keywords(word):
    with pytest.raises(TypeError, match="unexpected keyword"):
        steady_study(read_model(THREE), [(0.0, 0.0)], **{word: 1.0})


def test_the_run_can_be_repeated(cli, empty_folder):
    options = ("--image", "--alpha", "3", "--gap", "2 mm", "--panels", "2x9")
    cli("steady", THREE, *options, "--no-plot", "--out", "first")
    attrs = read_dataset(empty_folder / "first" / "dataset.nc").attrs
    assert (attrs["kind"], attrs["alpha"], attrs["image"]) == ("steady", 3.0, 1)
    for text in ('"alpha": 3.0', '"gap": "2 mm"', '"image": true', '"panels": "2x9"'):
        assert text in attrs["options"]


def test_cosine_spacing_gives_no_efficiency_and_says_why(cli):
    (case,) = cli("steady", THREE, "--spacing", "cosine", "--json").json["cases"]
    assert case["loads"][0]["efficiency"] is case["loads"][0]["least_drag"] is None
    assert case["loads"][0]["induced_drag"] > 0.0
    assert "not known with cosine spacing" in case["message"]


def test_the_closed_wing_is_checked_too(cli):
    fold = ("--fold", "170,0", "--gap", "1 cm", "--panels", "2x30")
    (case,) = cli("steady", THREE, *fold, "--json").json["cases"]
    assert re.search("Gaps closed: Segments (1 and 2|2 and 1) come within", case["message"])


def test_gaps_narrower_than_the_strips_beside_them_are_named(cli):
    gap = ("--gap", "1 mm", "--fold", "0,0", "--panels", "2x30", "--json")
    (coarse,) = cli("steady", THREE, *gap).json["cases"]
    assert "Gaps of hinges 2, 3 are narrower than the strips beside" in coarse["message"]
    (inset,) = cli("steady", THREE, *gap, "--spacing", "inset").json["cases"]
    assert "message" not in inset


def test_a_free_hinge_is_held(cli, empty_folder):
    text = example_text(THREE)
    line = next(part for part in text.splitlines() if "fold = -30" in part)
    path = empty_folder / "free.toml"
    path.write_text(text.replace(line, "hinge = { free = true, fold = -30 }"), encoding="utf-8")
    (case,) = cli("steady", str(path), "--json").json["cases"]
    assert case["message"] == "Hinge 3 is free: the wing is held in its shape."


def test_angles_stay_on_one_line_and_hinges_are_explained_where_there_are_any(cli):
    fold = ("--fold2", "-112.5,112.5", "--fold3", "120", "--gap", "1 mm")
    answer = cli("steady", THREE, *fold, "--no-plot", "--out", "a")
    assert answer.out.count("\n-112.5°, 120°  ") == 2
    assert "…" not in answer.out
    assert "hinge moments" in " ".join(answer.out.split())
    assert "hinge moments" not in cli("steady", "goland", "--no-plot", "--out", "b").out
