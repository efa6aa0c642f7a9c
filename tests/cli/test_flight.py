"""foldwing flight: tables, JSON, files, and what it refuses."""

import csv
import math

import pytest

from foldwing.flight import mode_row
from foldwing.model import example_text, parse_flight, read_flight
from foldwing.results import read_dataset
from foldwing.studies.flight import flight_study

CESSNA = "cessna-172"
TEXT = example_text(CESSNA)
SPEEDS = ("--speeds", "25:60:5")
DERIVATIVES = "{ X_u = -44, X_w = 100, Z_u = -371, Z_w = -2990, M_w = -1580, M_q = -7900 }"
GIVEN = f"[flight]\nspeed = 54\nmass = 1020\npitch_inertia = 838\nderivatives = {DERIVATIVES}\n"
MATRIX = "[flight]\nmatrix = [[-0.04, 0.1, 0, -9.81], [-0.36, -2.9, 50, 0], {row}, [0, 0, 1, 0]]\n"
ROW = "[0, -1.9, -9.4, 0]"


def lines(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def saved(folder, text):
    path = folder / "model.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_answer_and_tables(cli):
    answer = cli("flight", CESSNA, *SPEEDS, "--no-plot", "--out", "x")
    assert answer.status == 0
    words = " ".join(answer.out.split())
    assert "phugoid has a period of 26.9 s and a damping ratio of 0.0861" in words
    assert "static margin is 34.9 % of the chord" in words
    assert "-6.198 ± 9.168i 0.6854 0.5601 0.1118" in words
    assert words.count("simple phugoid") == 1 + 8
    assert "neutral point 0.532 m" in words
    assert max(map(len, answer.out.splitlines())) <= 80


def test_json(cli, empty_folder):
    answer = cli("flight", CESSNA, *SPEEDS, "--json").json
    assert list(empty_folder.iterdir()) == []
    assert answer["speed"] == 54.0
    four, bare, simple, bodies = answer["models"]
    names = [each["model"] for each in (four, bare, simple, bodies)]
    assert names == ["four states", "without drag", "simple phugoid", "multi-body, quasi-steady"]
    phugoid, short_period = four["modes"]
    assert (phugoid["mode"], short_period["mode"]) == ("phugoid", "short period")
    assert phugoid["period"] == pytest.approx(2 * math.pi / phugoid["imag"])
    assert phugoid["time_to_double"] is None
    assert bare["modes"][0]["time_to_half"] is None
    assert len(simple["modes"]) == 1
    assert [row["speed"] for row in answer["speeds"]] == [
        float(speed) for speed in range(25, 61, 5) for _ in range(3)
    ] + [float(speed) for speed in range(25, 61, 5)]
    assert answer["derivatives"]["M_u"] == 0.0
    assert answer["trim"]["tail_lift"] == 0.0


def test_files_hold_the_answer(cli, empty_folder):
    models = cli("flight", CESSNA, *SPEEDS, "--json", "--out", "x").json["models"]
    folder = empty_folder / "x"
    rows = lines(folder / "flight_modes.csv")
    wanted = [(each["model"], mode["real"]) for each in models for mode in each["modes"]]
    assert [(row["model"], float(row["real"])) for row in rows] == wanted
    paths = lines(folder / "flight_paths.csv")
    assert {row["mode"] for row in paths} == {"phugoid", "short period"}
    assert float(paths[0]["pitch"]) == pytest.approx(math.degrees(0.1), rel=0.01)
    assert len(lines(folder / "flight_speeds.csv")) == 8 * 7
    for name in ("flight-paths", "flight-paths-relative", "flight-eigenvalues"):
        assert (folder / f"{name}.png").stat().st_size > 10_000
    assert (folder / "flight-against-speed.svg").exists()
    report = (folder / "report.html").read_text(encoding="utf-8")
    for words in ("Modes of the four states", "Stability derivatives", "neutral point"):
        assert words in report
    dataset = read_dataset(folder / "dataset.nc")
    assert dataset["flight_eigenvalue"].values[0, 0].real == models[0]["modes"][0]["real"]
    assert dataset.attrs["kind"] == "flight"
    assert dataset.attrs["options"] == '{"model": "cessna-172", "speeds": "25:60:5"}'


def test_a_matrix_without_airspeed_has_modes_alone(cli, empty_folder):
    model = saved(empty_folder, MATRIX.format(row=ROW))
    answer = cli("flight", model, "--out", "x")
    assert answer.status == 0
    assert answer.out.startswith("The phugoid has a period of")
    assert "Without an airspeed there are no flight paths" in " ".join(answer.out.split())
    assert {path.name for path in (empty_folder / "x").glob("*.png")} == {"flight-eigenvalues.png"}
    assert [each["model"] for each in cli("flight", model, "--json").json["models"]] == [
        "four states"
    ]


def test_given_derivatives(cli, empty_folder):
    answer = cli("flight", saved(empty_folder, GIVEN), "--json").json
    assert [each["model"] for each in answer["models"]] == ["four states", "simple phugoid"]
    assert answer["derivatives"]["Z_q"] == 0.0
    assert "static_margin" not in answer


def test_an_unstable_aircraft_says_so(cli, empty_folder):
    text = TEXT.replace("centre_of_gravity = 0.0", "centre_of_gravity = 0.6")
    answer = cli("flight", saved(empty_folder, text), *SPEEDS, "--out", "x")
    words = " ".join(answer.out.split())
    assert "phugoid has an aperiodic motion that doubles in 2.69 s" in words
    assert "third oscillation has a period" in words
    assert "Statically unstable" in words
    assert (empty_folder / "x" / "flight-against-speed.png").exists()


def test_other_models_are_named_in_tables_and_pictures():
    from foldwing.plots.catalogue import pictures
    from foldwing.results.flight_table import models_table, speeds_table

    rows = [mode_row("several bodies", speed, -0.02 + 0.23j, -6 + 9j) for speed in (30.0, 54.0)]
    dataset = flight_study(read_flight(CESSNA), speeds=(30.0, 54.0), comparisons=rows).dataset
    line = models_table(dataset).rows[-1]
    assert line == ("several bodies", "-0.02 ± 0.23i", "-6 ± 9i")
    assert sum("several bodies" in line for line in speeds_table(dataset).rows) == 2
    for picture in pictures(dataset)[:2]:
        labels = {getattr(item, "label", "") for panel in picture.panels for item in panel.items}
        assert "several bodies" in labels


# ------------------------------------------------------------------------------------- bad input

NAN_ROW = "[0, -1.9, nan, 0]"
BAD_MODELS = [
    (TEXT.replace('"54 m/s"', '"0 m/s"'), "flight.speed", "'0 m/s'", "0.001 m/s", "54 m/s"),
    (TEXT.replace('"54 m/s"', '"54 kg"'), "flight.speed", "'54 kg'", "[mass]", "54 m/s"),
    (TEXT.replace('speed = "54 m/s"\n', ""), "flight.speed: missing", "an airspeed", "Add speed"),
    (TEXT.replace('"15 ft"', '"-15 ft"'), "flight.tail_arm", "aft to that of the tail", "m"),
    (
        TEXT.replace("gravity = 0.0", "gravity = 5"),
        "flight.tail_arm",
        "greater than centre_of_gravity, 5 m",
        "behind the centre of gravity",
    ),
    (TEXT.replace("= 0.93", "= nan", 1), "flight.wing.span_efficiency", "nan", "finite", "0.93"),
    (
        TEXT.replace("span_efficiency = 0.93", "", 1),
        "flight.wing.span_efficiency",
        "missing",
        "or else lift_slope",
        "Add span_efficiency",
    ),
    (
        TEXT.replace("span_efficiency = 0.93", "lift_slope = 5.0", 1),
        "flight.wing.span_efficiency",
        "for the drag",
        "drag = false",
    ),
    (
        TEXT.replace("zero_lift_drag = 0.035", ""),
        "flight.zero_lift_drag",
        "missing",
        "drag = false",
    ),
    (TEXT.partition("[flight.tail]")[0], "flight.tail: missing", "Add tail"),
    (TEXT.replace("[flight.tail]", "[flight.tial]"), "flight.tial", "Did you mean tail?"),
    (TEXT.partition("[flight]")[0] + "[flight]\nspeed = 54", "flight.wing", "or a matrix"),
    (
        TEXT.replace("tail_arm", f"derivatives = {DERIVATIVES}\ntail_arm"),
        "flight.centre_of_gravity",
        "does not go with stability derivatives",
        "Remove it",
    ),
    (
        MATRIX.format(row=ROW) + f"derivatives = {DERIVATIVES}\n",
        "flight.derivatives",
        "does not go with a matrix",
        "one form",
    ),
    (MATRIX.format(row=ROW) + "mass = 3\n", "flight.mass", "does not go with a matrix"),
    (MATRIX.replace("{row}, ", ""), "flight.matrix", "a list of 3", "4 x 4", "Write 4 rows"),
    (MATRIX.format(row="[0, 1, 2]"), "flight.matrix[3]", "a list of 3", "4 x 4"),
    (MATRIX.format(row=NAN_ROW), "flight.matrix[3][3]", "nan", "finite"),
    (MATRIX.format(row=ROW).replace("0, 1, 0]", "0, 0, 1]"), "flight.matrix[4]", "0, 0, 1, 0"),
    (GIVEN.replace("M_q = -7900", "M_r = 1"), "flight.derivatives.M_r", "Did you mean M_w?"),
    (GIVEN.replace(", M_q = -7900", ""), "flight.derivatives.M_q", "missing", "N*m*s"),
    (GIVEN.replace("mass = 1020\n", ""), "flight.mass", "missing", "a mass (kg)"),
]


@pytest.fixture(name="computes_nothing")
def _computes_nothing(monkeypatch):
    def computed(*arguments):
        raise AssertionError("something was computed")

    monkeypatch.setattr("foldwing.studies.flight.model_rows", computed)


@pytest.mark.usefixtures("computes_nothing")
@pytest.mark.parametrize("case", BAD_MODELS, ids=lambda case: case[1])
def test_bad_models(cli, empty_folder, case):
    text, *words = case
    answer = cli("flight", saved(empty_folder, text), "--out", "x")
    assert (answer.status, answer.out) == (2, "")
    for word in words:
        assert word in answer.err
    assert not (empty_folder / "x").exists()


@pytest.mark.usefixtures("computes_nothing")
@pytest.mark.parametrize(
    "case",
    [
        ((CESSNA, "--speeds", "0:60:5"), "--speeds", "0.0", "0.001 to 100000 m/s", "25:60:5"),
        ((CESSNA, "--speeds", "30:20:-5"), "--speeds", "ascend"),
        ((CESSNA, "--speeds", "fast"), "--speeds", "'fast'", "made of numbers"),
        (("boeing-747", *SPEEDS), "--speeds", "wing and tail", "Leave the airspeeds out"),
        (("goland",), "flight: missing", "[flight] table", "foldwing modes"),
        (("cesna-172",), "Did you mean cessna-172"),
    ],
    ids=str,
)
def test_bad_options(cli, case):
    arguments, *words = case
    answer = cli("flight", *arguments)
    assert (answer.status, answer.out) == (2, "")
    for word in words:
        assert word in answer.err


def test_an_aircraft_is_no_wing(cli):
    answer = cli("modes", CESSNA)
    assert answer.status == 2
    assert "wing: missing" in answer.err and "foldwing flight" in answer.err


def test_hopeless_numbers_are_named(cli, empty_folder):
    text = TEXT.replace('"1020 kg"', "1e308")
    answer = cli("flight", saved(empty_folder, text), "--json")
    assert (answer.status, answer.out) == (1, "")
    assert "order of magnitude" in answer.err


def test_the_study_rejects_unknown_keywords():
    with pytest.raises(TypeError, match="unexpected keyword"):
        flight_study(read_flight(CESSNA), sped=(30.0,))


def test_a_model_is_read_from_text_or_file(empty_folder):
    path = saved(empty_folder, TEXT)
    assert parse_flight(TEXT) == read_flight(path) == read_flight(CESSNA)
