"""What the commands answer: JSON documents and tables."""

import math
import re

import pytest

NUMBERS = "-?\\d+\\.?\\d*"
POINT = {"kind", "event", "class", "speed", "frequency", "strength", "mode", "mode_confidence"}
CASE = {
    "fold", "flutter_points", "critical", "certified", "valid_from", "unstable_from_start",
    "uncertified_modes", "status",
}  # fmt: skip
LEVEL = ("--fold3", "level")


def files(folder):
    return sorted(path.name for path in folder.iterdir())


def check_point(point):
    assert set(point) == POINT
    assert point["kind"] in ("flutter", "divergence")
    assert point["event"] in ("onset", "recovery", "merger")
    assert point["class"] in ("hump", "coalescence", "")
    assert point["speed"] > 0.0
    assert re.fullmatch(r"[A-Z]\d+", point["mode"])
    assert 0.0 <= point["mode_confidence"] <= 1.0
    if point["kind"] == "divergence":
        assert point["frequency"] == 0.0
        assert point["strength"] is None
    else:
        assert point["frequency"] > 0.0
        assert (point["strength"] > 0.0) == (point["event"] == "onset")


def check_case(case):
    assert set(case) == CASE
    assert case["status"] == "ok"
    assert case["certified"] is True
    assert case["uncertified_modes"] == []
    assert case["valid_from"] > 0.0
    speeds = [point["speed"] for point in case["flutter_points"]]
    assert speeds == sorted(speeds)
    for point in case["flutter_points"]:
        check_point(point)
    unstable = [point for point in case["flutter_points"] if point["event"] != "recovery"]
    assert case["critical"] == (unstable[0] if unstable else None)


def test_modes_json(cli, empty_folder):
    answer = cli("modes", "three-segment", "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.count("\n") == 1
    result = answer.json
    assert set(result) == {"fold", "natural_frequencies_hz", "mode_names"}
    assert result["fold"] == [30.0, -30.0]
    assert result["natural_frequencies_hz"][:4] == pytest.approx(
        [4.30387, 21.1277, 24.1515, 53.3882], rel=3e-5
    )
    assert result["mode_names"][:4] == ["B1", "B2", "T1", "B3"]
    assert len(result["mode_names"]) == len(result["natural_frequencies_hz"]) == 12
    assert files(empty_folder) == []


def test_modes_json_of_a_sweep(cli):
    result = cli("modes", "three-segment", "--fold2", "0:60:30", *LEVEL, "--json").json
    assert [case["fold"] for case in result["cases"]] == [[0.0, 0.0], [30.0, -30.0], [60.0, -60.0]]
    one = cli("modes", "three-segment", "--fold", "60,-60", "--json").json
    swept = sorted(result["cases"][2]["natural_frequencies_hz"])
    assert swept[:8] == pytest.approx(one["natural_frequencies_hz"][:8], rel=1e-9)


def test_flutter_json(cli, empty_folder):
    answer = cli("flutter", "three-segment", "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.count("\n") == 1
    result = answer.json
    check_case(result)
    assert result["fold"] == [30.0, -30.0]
    first = result["critical"]
    assert (first["kind"], first["event"], first["class"]) == ("flutter", "onset", "coalescence")
    assert first["speed"] == pytest.approx(25.06, abs=0.01)
    assert first["frequency"] == pytest.approx(19.48, abs=0.01)
    assert first["mode"] == "T1"
    kinds = [(point["kind"], point["event"]) for point in result["flutter_points"]]
    assert ("divergence", "onset") in kinds
    assert ("flutter", "recovery") in kinds
    assert files(empty_folder) == []


def test_boundary_json(cli, empty_folder):
    answer = cli("boundary", "three-segment", "--fold2", "0:150:75", *LEVEL, "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out.count("\n") == 1
    assert set(answer.json) == {"cases"}
    cases = answer.json["cases"]
    for case in cases:
        check_case(case)
    assert [case["fold"] for case in cases] == [[0.0, 0.0], [75.0, -75.0], [150.0, -150.0]]
    assert [case["critical"]["speed"] for case in cases] == pytest.approx(
        [28.95, 23.03, 18.29], abs=0.01
    )
    assert files(empty_folder) == []


def test_no_flutter_is_an_answer(cli):
    result = cli("boundary", "three-segment", "--max-speed", 10, "--json").json["cases"][0]
    check_case(result)
    assert result["flutter_points"] == []
    assert result["critical"] is None


@pytest.mark.parametrize("extra", [(), ("--json",)])
def test_no_flutter_is_an_answer_of_flutter_too(cli, extra):
    answer = cli("flutter", "three-segment", "--max-speed", 10, "--no-plot", *extra)
    assert answer.status == 0
    if extra:
        check_case(answer.json)
        assert answer.json["critical"] is None
    else:
        assert "No flutter or divergence found up to 10 m/s" in answer.out


def test_wing_without_hinges(cli):
    flutter = cli("flutter", "goland", "--json").json
    check_case(flutter)
    assert flutter["fold"] == []
    assert cli("boundary", "goland", "--json").json == {"cases": [flutter]}
    assert cli("modes", "goland", "--json").json["fold"] == []


def test_flutter_and_boundary_agree(cli):
    folds = ("three-segment", "--fold", "75,-75", "--json")
    assert cli("boundary", *folds).json["cases"] == [cli("flutter", *folds).json]


def test_processes_do_not_change_the_answer(cli):
    sweep = ("boundary", "three-segment", "--fold2", "0:90:30", *LEVEL, "--json", "--jobs")
    assert cli(*sweep, 2).out == cli(*sweep, 1).out


# ------------------------------------------------------------------------------------ fold angles


def folds(cli, *options, model="three-segment"):
    answer = cli("modes", model, *options, "--json").json
    cases = answer["cases"] if "cases" in answer else [answer]
    return [tuple(case["fold"]) for case in cases]


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((), [(30, -30)]),
        (("--fold", "10,20"), [(10, 20)]),
        (("--fold", "-10,-20.5"), [(-10, -20.5)]),
        (("--fold=-10,20"), [(-10, 20)]),
        (("--fold2", "10"), [(10, -30)]),
        (("--fold3", "-75"), [(30, -75)]),
        (("--fold3=-75",), [(30, -75)]),
        (("--fold-of", "3=-75"), [(30, -75)]),
        (("--fold", "10,20", "--fold2", "5"), [(5, 20)]),
        (LEVEL, [(30, -30)]),
        (("--fold3", "LEVEL", "--fold2", "40"), [(40, -40)]),
        (("--fold2", "level", "--fold3", "level"), [(0, 0)]),
        (("--fold2", "0:20:10", *LEVEL), [(0, 0), (10, -10), (20, -20)]),
        (("--fold2", "20:0:-10"), [(20, -30), (10, -30), (0, -30)]),
        (("--fold2", "0:25:10"), [(0, -30), (10, -30), (20, -30), (25, -30)]),
        (("--fold2", "0:10:10", "--fold3", "1:2:1"), [(0, 1), (0, 2), (10, 1), (10, 2)]),
        (("--fold2", "5:5:1"), [(5, -30)]),
    ],
)
def test_fold_angles(cli, options, expected):
    options = [options] if isinstance(options, str) else options
    assert folds(cli, *options) == expected


def test_level_is_parallel_to_the_first_segment_at_any_hinge(cli, empty_folder):
    hinge = '[[wing.segment]]\nspan = "5 cm"\nhinge = { rigid = true, fold = 20 }\n'
    text = cli("examples", "three-segment").out.replace("[air]", f"{hinge}[air]")
    (empty_folder / "four.toml").write_text(text, encoding="utf-8")
    found = folds(cli, "--fold2", "0:10:10", "--fold4", "level", model="four.toml")
    assert found == [(0, -30, 30), (10, -30, 20)]


# ------------------------------------------------------------------------------ options take effect


def critical(cli, *options):
    return cli("flutter", "three-segment", "--json", *options).json["critical"]["speed"]


@pytest.mark.parametrize(
    "options",
    [
        ("--aero", "quasi-steady"),
        ("--basis", "converged"),
        ("--damping", "0.03"),
        ("--damping-threshold", "-0.02"),
        ("--fold", "0,0"),
    ],
)
def test_options_change_the_answer(cli, options):
    assert abs(critical(cli, *options) - critical(cli)) > 1e-3


def test_range_of_airspeeds_does_not_change_the_points_within_it(cli):
    speeds = [critical(cli, *more) for more in [(), ("--speeds", "0:40:4"), ("--max-speed", 30)]]
    assert speeds == pytest.approx(speeds[:1] * 3, rel=1e-9)


def test_far_end_of_the_search_hides_nothing(cli):
    assert critical(cli, "--max-speed", 1e5) == pytest.approx(critical(cli), rel=1e-9)


def test_search_ends_where_it_is_told(cli):
    def last(*options):
        points = cli("flutter", "three-segment", "--json", *options).json["flutter_points"]
        return points[-1]["speed"]

    assert last() > 60.0
    assert 50.0 < last("--max-speed", 54) < 54.0
    assert 50.0 < last("--speeds", "0:54:9") < 54.0


# ------------------------------------------------------------------------------------------ tables


def width(text):
    return max(len(line.rstrip()) for line in text.splitlines())


@pytest.mark.parametrize("columns", ["80", "120"])
def test_tables_fit_the_terminal(cli, monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", columns)
    for command in (
        ("modes", "three-segment"),
        ("modes", "three-segment", "--fold2", "0:50:50"),
        ("flutter", "friction-hinge-1"),
        ("boundary", "three-segment", "--fold2", "75:125:50", *LEVEL),
    ):
        answer = cli(*command, "--no-plot", "--out", "result", "--force")
        assert answer.status == 0
        assert width(answer.out) <= int(columns)
        assert "…" not in answer.out
        assert "\x1b" not in answer.out


def test_modes_table(cli):
    lines = cli("modes", "three-segment", "--no-plot").out.splitlines()
    assert lines[0] == "Natural frequencies at fold 30, -30 deg"
    assert lines[2].split() == ["B1", "4.3038"]
    sweep = cli("modes", "three-segment", "--fold2", "0:50:50", "--no-plot").out.splitlines()
    assert sweep[1].split() == ["fold,", "deg", "B1", "B2", "T1", "B3", "B4", "T2"]
    assert [line.split()[:2] for line in sweep[2:4]] == [["0,", "-30"], ["50,", "-30"]]


def test_flutter_table_shows_every_point(cli):
    points = cli("flutter", "three-segment", "--json").json["flutter_points"]
    out = cli("flutter", "three-segment", "--no-plot").out
    assert out.startswith("Flutter begins at 25.1 m/s with 19.5 Hz (mode T1)")
    rows = [
        line.split() for line in out.splitlines() if re.match(rf" *{NUMBERS} +{NUMBERS} ", line)
    ]
    assert [row[0] for row in rows] == [f"{point['speed']:.2f}" for point in points]
    assert [row[1] for row in rows] == [f"{point['frequency']:.2f}" for point in points]
    assert [row[2:4] for row in rows] == [[point["kind"], point["event"]] for point in points]
    assert "Certified: the unstable roots listed" in out


def test_curves_are_named_with_their_airspeeds(cli):
    out = cli("flutter", "goland", "--no-plot").out
    assert "Curves: 61 speeds from 0 to 205.9 m/s; flutter sought up to 760 m/s." in out
    out = cli("flutter", "goland", "--no-plot", "--speeds", 150, "--out", "one").out
    assert "Curves: at 150 m/s; flutter sought up to 150 m/s." in out


def test_boundary_table(cli, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    out = cli("boundary", "three-segment", "--fold2", "75:100:25", *LEVEL, "--no-plot").out
    lines = out.splitlines()
    assert lines[2].split()[:7] == ["75,", "-75", "23.03", "11.87", "flutter", "hump", "T1"]
    assert "43.7 divergence" in lines[2]
    assert "65.8 flutter ends" in lines[2]
    assert lines[3].split()[:6] == ["100,", "-100", "44.91", "0.00", "divergence", "B1"]
    assert "The lowest speed of instability in 2 cases is 23 m/s (flutter, fold 75°, -75°" in out


def test_boundary_table_of_a_stable_wing(cli):
    out = cli("boundary", "three-segment", "--max-speed", 5, "--no-plot").out
    assert out.splitlines()[2].split() == ["30,", "-30", "-", "none"]
    assert "No flutter or divergence" in out


def test_long_boundary_table_has_one_line_for_each_case(cli):
    sweep = ("boundary", "three-segment", "--fold2", "0:100:2", *LEVEL, "--max-speed", 40)
    out = cli(*sweep, "--no-plot").out
    rows = [line for line in out.splitlines() if re.match(rf"{NUMBERS}, {NUMBERS} ", line)]
    assert len(rows) == 51
    assert "flutter_points.csv" in out


def test_measured_points_come_with_the_result(cli, empty_folder):
    from foldwing.results import read_dataset

    (empty_folder / "own.csv").write_text(
        "# tunnel\nfold_2, fold_3, speed\n\n10,-10,20.5\n20,-20,\n", encoding="utf-8-sig"
    )
    for source, count in (("own.csv", 2), ("level-tip-wind-tunnel", 4)):
        sweep = ("boundary", "three-segment", "--fold2", "0:30:30", *LEVEL, "--max-speed", 20)
        answer = cli(*sweep, "--measured", source, "--no-plot", "--out", source[:3])
        assert answer.status == 0
        dataset = read_dataset(empty_folder / source[:3] / "dataset.nc")
        assert dataset.sizes["measured"] == count
    own = read_dataset(empty_folder / "own" / "dataset.nc")
    assert own["measured_fold"].values.tolist() == [10.0, 20.0]
    assert own["measured_speed"].values[0] == 20.5
    assert math.isnan(own["measured_speed"].values[1])


def test_no_color_and_pipes_give_plain_text(shell):
    for more in ({}, {"NO_COLOR": "1"}):
        answer = shell("examples", **more)
        assert answer.status == 0
        assert "\x1b" not in answer.out
        assert "three-segment-table-2-1" in answer.out


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "latin-1"])
def test_poor_terminals_show_what_they_can(shell, encoding):
    sweep = ("boundary", "three-segment", "--fold2", "0:50:50", *LEVEL, "--max-speed", 40)
    answer = shell(*sweep, "--no-plot", PYTHONIOENCODING=encoding, PYTHONUTF8="0")
    assert answer.status == 0
    assert re.search("fold 50., -50.", answer.out.replace("\n", " "))
