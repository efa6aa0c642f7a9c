"""The commands on an aircraft: answers, tables, files, and everything that can be asked wrongly."""

import numpy as np
import pytest

from foldwing.model import example_text
from foldwing.results import read_dataset

AIRCRAFT = "three-segment-aircraft"
CLAMPED = "three-segment"
CESSNA = "cessna-172-multibody"


def test_the_answer_holds_trim_motions_and_the_clamped_wing(cli):
    answer = cli("aircraft", AIRCRAFT, "--fold", "30,-60", "--json").json
    first = answer["flutter_points"][0]
    assert (first["kind"], first["event"], first["mode"]) == ("flutter", "onset", "T1")
    assert first["speed"] == pytest.approx(25.54, abs=0.005)
    assert answer["critical"] == first
    assert answer["certified"] is True
    merger = next(p for p in answer["flutter_points"] if p["event"] == "merger")
    assert merger["motion"] == merger["mode"] == "phugoid"
    trim = answer["trim"]
    assert [surface["name"] for surface in trim["surfaces"]][-1] == "tail"
    assert sum(s["share"] for s in trim["surfaces"]) == pytest.approx(1.0, abs=1e-12)
    assert sum(s["lift"] for s in trim["surfaces"]) == pytest.approx(trim["weight"], rel=1e-12)
    assert answer["unstable_motions"] == ["phugoid"]
    assert [motion["name"] for motion in answer["motions"]] == ["phugoid", "short period"]
    assert len(answer["motions"][0]["growth"]) == len(answer["speeds"])
    clamped = cli("flutter", CLAMPED, "--fold", "30,-60", "--json").json
    there = [(p["event"], p["speed"]) for p in answer["clamped"]["flutter_points"]]
    here = [(p["event"], p["speed"]) for p in clamped["flutter_points"]]
    assert [event for event, _ in there] == [event for event, _ in here]
    np.testing.assert_allclose([u for _, u in there], [u for _, u in here], rtol=1e-9)


def test_the_tables_tell_flutter_trim_and_motions(cli):
    answer = cli("aircraft", AIRCRAFT, "--no-plot", "--out", "r")
    assert answer.status == 0
    for words in ("Flutter begins", "root clamped", "Level flight", "tail", "phugoid", "Certified"):
        assert words in answer.out
    dataset = read_dataset(answer_folder() / "dataset.nc")
    assert dataset.attrs["kind"] == "aircraft"
    columns = dataset["branch_name"].values.tolist()
    neutral = dataset["eigenvalue"].values[0][:, [columns.index(name) for name in ("x", "z")]]
    assert np.all(neutral == 0.0)
    kinds = dict(zip(columns, dataset["branch_motion"].values.tolist(), strict=True))
    assert {kinds["x"], kinds["z"]} == {"neutral"}
    assert (kinds["phugoid"], kinds["short period"]) == ("phugoid", "short period")
    assert (kinds["pitch"], kinds["B1"], kinds["D1"]) == ("", "elastic", "real")
    moving = dataset["speed"].values >= float(dataset["slowest_speed"][0])
    assert np.isfinite(dataset["eigenvalue"].values[0][moving, columns.index("phugoid")][0])


def answer_folder():
    from pathlib import Path

    return Path("r")


def test_an_aircraft_has_three_zero_modes(cli):
    answer = cli("modes", AIRCRAFT, "--json").json
    assert answer["mode_names"][:4] == ["x", "z", "pitch", "B1"]
    assert answer["natural_frequencies_hz"][:3] == [0.0, 0.0, 0.0]
    assert len(answer["mode_names"]) == 3 + 12
    clamped = cli("modes", AIRCRAFT, "--clamped", "--json").json
    assert clamped == cli("modes", CLAMPED, "--json").json


def test_a_boundary_of_aircraft(cli):
    answer = cli("boundary", AIRCRAFT, "--fold3", "-60:60:60", "--json").json
    critical = [case["critical"] for case in answer["cases"]]
    assert [point["event"] for point in critical] == ["onset", "onset", "merger"]
    assert [round(point["speed"], 1) for point in critical] == [25.5, 27.1, 41.4]
    assert all(case["certified"] for case in answer["cases"])
    assert all("out of reach" in case["warning"] for case in answer["cases"])


def test_the_clamped_wing_of_an_aircraft_is_the_wing(cli):
    alone = cli("flutter", CLAMPED, "--json").json
    assert cli("flutter", AIRCRAFT, "--clamped", "--json").json == alone


def test_options_change_the_aircraft(cli):
    usual = cli("aircraft", AIRCRAFT, "--json").json
    trimmed = cli("aircraft", AIRCRAFT, "--trim", "force-and-moment", "--json").json
    assert usual["trim"]["surfaces"][-1]["share"] == 0.0
    assert trimmed["trim"]["surfaces"][-1]["share"] == pytest.approx(0.05, abs=1e-9)
    tail = cli("aircraft", AIRCRAFT, "--tail-aero", "quasi-steady", "--json").json
    change = tail["flutter_points"][0]["speed"] / usual["flutter_points"][0]["speed"] - 1.0
    assert 1e-7 < abs(change) < 0.02
    lattice = cli("aircraft", AIRCRAFT, "--aero", "lattice", "--panels", "4x12", "--json").json
    assert lattice["certified"] is True


def test_flight_of_joined_bodies_beside_four_states(cli):
    answer = cli("flight", CESSNA, "--json").json
    names = [model["model"] for model in answer["models"]]
    assert names == ["four states", "simple phugoid", "multi-body, quasi-steady"]
    modes = [
        {m["mode"]: complex(m["real"], m["imag"]) for m in r["modes"]} for r in answer["models"]
    ]
    four, _, bodies = modes
    assert abs(bodies["short period"] / four["short period"] - 1.0) < 1e-4
    assert abs(bodies["phugoid"] / four["phugoid"] - 1.0) < 2e-3


def test_a_rigid_aircraft_is_compared_with_joined_bodies_too(cli):
    answer = cli("flight", "cessna-172", "--speeds", "30:60:30", "--json").json
    rows = {row["model"]: row["modes"] for row in answer["speeds"] if row["speed"] == 30.0}
    four, bodies = rows["without drag"], rows["multi-body, quasi-steady"]
    assert bodies[1]["real"] == pytest.approx(four[1]["real"], rel=1e-3)
    assert bodies[1]["imag"] == pytest.approx(four[1]["imag"], rel=1e-3)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("flutter", AIRCRAFT), ("aircraft:", "root is clamped", "--clamped")),
        (("convergence", AIRCRAFT), ("aircraft:", "foldwing convergence", "--clamped")),
        (("steady", AIRCRAFT), ("aircraft:", "foldwing steady", "--clamped")),
        (("aircraft", CLAMPED), ("aircraft: missing", "[aircraft] table", "foldwing flutter")),
        (("aircraft", "cessna-172"), ("wing: missing", "[wing]", "foldwing flight")),
        (("boundary", CLAMPED, "--trim", "force"), ("--trim", "'force'", "belongs to an aircraft")),
        (
            ("boundary", AIRCRAFT, "--clamped", "--tail-aero", "theodorsen"),
            ("--tail-aero", "belongs to an aircraft", "without --clamped"),
        ),
        (
            ("aircraft", AIRCRAFT, "--panels", "4x12"),
            ("--panels", "vortex lattice", "--aero lattice"),
        ),
        (("aircraft", AIRCRAFT, "--speeds", "0:0:1"), ("--speeds", "0 m/s", "0:60:1")),
        (("aircraft", AIRCRAFT, "--max-speed", "0"), ("--max-speed", "0.0", "m/s")),
        (("flight", AIRCRAFT), ("cruise_speed: missing", "--speed 54")),
        (("flight", CESSNA, "--speed", "0"), ("--speed", "0.0", "moves")),
        (("flight", CESSNA, "--speeds", "0:60:30"), ("--speeds", "0.0", "moves")),
        (("flight", CLAMPED), ("flight: missing", "[flight]")),
        (("flight", "cessna-172", "--fold", "30"), ("--fold", "'30'", "rigid aircraft")),
        (("flight", "boeing-747", "--speed", "100"), ("--speed", "100", "one airspeed")),
    ],
)
def test_wrong_questions(cli, empty_folder, arguments, words):
    answer = cli(*arguments)
    assert answer.status == 2
    assert answer.out == ""
    text = " ".join(answer.err.split())
    for word in words:
        assert word in text
    assert list(empty_folder.iterdir()) == []


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('tail_arm = "25 cm"', 'tail_arm = "-25 cm"', ("aircraft.tail_arm", "-25 cm", "greater")),
        ('tail_arm = "25 cm"', "tail_arm = 0", ("aircraft.tail_arm", "0", "greater")),
        ('tail_arm = "25 cm"', "", ("aircraft.tail_arm: missing", "x of the tail")),
        ('chord = "5 cm"\nspan', 'x = "-1 cm"\nchord = "5 cm"\nspan', ("tail_arm", "together")),
        ('centre_of_gravity = "1.25 cm"', "", ("centre_of_gravity: missing", "x of the fuselage")),
        ('mass = "81.796 g"', "mass = 0", ("aircraft.fuselage.mass", "0", "greater")),
        ('mass = "81.796 g"', "", ("aircraft.fuselage.mass: missing",)),
        ('figures = "half"', 'figures = "both"', ("aircraft.figures", "'both'", "'half'")),
        ('figures = "half"', 'wing_aerodynamics = "strip"', ("wing_aerodynamics", "theodorsen")),
        ('figures = "half"', 'tail_aerodynamics = "lattice"', ("tail_aerodynamics", "theodorsen")),
        ('figures = "half"', 'trim = "moment"', ("aircraft.trim", "force-and-moment")),
        ('figures = "half"', "cruise_speed = 0", ("aircraft.cruise_speed", "0")),
        ('figures = "half"', "tailarm = 1", ("aircraft.tailarm", "Did you mean tail_arm?")),
        ('gravity = "9.81 m/s^2"', "gravity = -9.81", ("aircraft.gravity", "-9.81")),
        ("[aircraft.tail]", "[aircraft.rudder]", ("aircraft.rudder", "Known here")),
    ],
)
def test_wrong_aircraft(cli, empty_folder, old, new, words):
    text = example_text(AIRCRAFT)
    assert old in text
    (empty_folder / "model.toml").write_text(text.replace(old, new))
    answer = cli("aircraft", "model.toml")
    assert answer.status == 2
    assert answer.out == ""
    for word in words:
        assert word in " ".join(answer.err.split())


def test_a_tail_placed_ahead_of_the_wing(cli, empty_folder):
    text = example_text(AIRCRAFT).replace('tail_arm = "25 cm"\n', "")
    text = text.replace('chord = "5 cm"\nspan', 'x = "-25 cm"\nchord = "5 cm"\nspan')
    (empty_folder / "model.toml").write_text(text)
    answer = cli("aircraft", "model.toml")
    assert answer.status == 2
    assert "aircraft.tail.x: got -0.25" in answer.err
    assert "behind the wing" in " ".join(answer.err.split())


def test_figures_of_the_whole_aircraft_are_halved(cli, empty_folder):
    text = example_text(AIRCRAFT).replace('figures = "half"', 'figures = "full"')
    doubled = {
        '"81.796 g"': '"163.592 g"',
        '"22.721e-6': '"45.442e-6',
        '"6.8163 g"': '"13.6326 g"',
        '"1.4201e-6': '"2.8402e-6',
        'span = "7.5 cm"': 'span = "15 cm"',
    }
    for old, new in doubled.items():
        assert old in text
        text = text.replace(old, new)
    (empty_folder / "model.toml").write_text(text)
    whole = cli("aircraft", "model.toml", "--json").json
    half = cli("aircraft", AIRCRAFT, "--json").json
    speeds = [[p["speed"] for p in answer["flutter_points"]] for answer in (whole, half)]
    np.testing.assert_allclose(*speeds, rtol=1e-10)


def table(path):
    import csv

    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_files_of_an_aircraft_hold_the_dataset(cli, empty_folder):
    answer = cli("aircraft", AIRCRAFT, "--fold", "30,-60", "--no-plot", "--out", "r")
    assert all(len(line) <= 80 for line in answer.out.splitlines())
    folder = empty_folder / "r"
    dataset = read_dataset(folder / "dataset.nc")
    speeds, surfaces = dataset["speed"].values, dataset["surface"].values.tolist()

    trim = table(folder / "trim.csv")
    assert list(trim[0]) == "speed surface lift share lift_coefficient angle_of_attack".split()
    assert [row["surface"] for row in trim] == surfaces * len(speeds)
    assert trim[0]["angle_of_attack"] == trim[0]["lift_coefficient"] == ""  # at rest
    given = np.array([float(row["lift_coefficient"] or "nan") for row in trim])
    np.testing.assert_array_equal(given, dataset["surface_lift_coefficient"].values.ravel())

    for surface, name in (("segment 3", "trim_angle"), ("tail", "trim_tail_angle")):
        given = [float(r["angle_of_attack"] or "nan") for r in trim if r["surface"] == surface]
        np.testing.assert_array_equal(given, dataset[name].values[0])

    motions = table(folder / "motions.csv")
    assert list(motions[0]) == "speed motion growth frequency damping".split()
    place = dataset["branch_name"].values.tolist().index("phugoid")
    growth = dataset["growth"].values[0, :, place]
    found = {float(r["speed"]): float(r["growth"]) for r in motions if r["motion"] == "phugoid"}
    known = np.isfinite(growth)
    assert found == dict(zip(speeds[known].tolist(), growth[known].tolist(), strict=True))

    clamped = table(folder / "clamped_flutter_points.csv")
    assert [row["event"] for row in clamped] == dataset["clamped_event"].values.tolist()
    given = [float(row["speed"]) for row in clamped]
    assert given == dataset["clamped_flutter_speed"].values.tolist()
    assert {row["motion"] for row in table(folder / "flutter_points.csv")} == {"elastic", "phugoid"}


def test_motions_take_one_line_for_each_airspeed(cli):
    out = cli("aircraft", AIRCRAFT, "--speeds", "10:30:5", "--no-plot").out
    lines = out.partition("ratio of the motions")[2].partition("Written")[0].strip().splitlines()
    assert [line.split()[0] for line in lines[-4:]] == ["15", "20", "25", "30"]
    assert lines[-5].split()[:2] == ["m/s", "deg"]


def test_the_trim_of_a_sweep_has_a_line_for_each_case_and_surface(cli, empty_folder):
    cli("boundary", AIRCRAFT, "--fold3", "-60:60:60", "--no-plot", "--out", "r")
    rows = table(empty_folder / "r" / "trim.csv")
    dataset = read_dataset(empty_folder / "r" / "dataset.nc")
    assert [float(row["fold_3"]) for row in rows[::4]] == [-60.0, 0.0, 60.0]
    given = np.array([float(row["share"]) for row in rows]).reshape(3, 4)
    np.testing.assert_array_equal(given, dataset["lift_share"].values)
    np.testing.assert_allclose(given.sum(axis=1), 1.0)
    assert not (empty_folder / "r" / "motions.csv").exists()


def changed(folder, **texts):
    """Write the shipped aircraft with other lines, and return its name."""
    text = example_text(AIRCRAFT)
    for key, value in texts.items():
        start = text.index(f"\n{key} = ") + 1
        text = text[:start] + f"{key} = {value}" + text[text.index("\n", start) :]
    (folder / "changed.toml").write_text(text)
    return "changed.toml"


def test_a_statically_unstable_aircraft_says_so(cli, empty_folder):
    model = changed(empty_folder, centre_of_gravity='"8 cm"')
    margin = cli("flight", model, "--speed", "20", "--json").json["static_margin"]
    assert margin < 0.0
    answer = cli("aircraft", model, "--json").json
    assert "divergence" in answer["unstable_motions"]
    assert answer["certified"] is True
    told = cli("aircraft", model, "--no-plot", "--out", "u").out
    assert "statically unstable" in " ".join(told.split())


def test_no_search_where_there_is_no_level_flight(cli):
    answer = cli("aircraft", AIRCRAFT, "--max-speed", "5")
    assert answer.status == 2
    for words in ("got 5.0", "level flight needs 10.7", "largest_lift_coefficient"):
        assert words in " ".join(answer.err.split())
    sweep = cli("boundary", AIRCRAFT, "--fold3", "-60:60:60", "--max-speed", "5", "--json")
    assert sweep.status == 1
    assert all("level flight needs" in case["message"] for case in sweep.json["cases"])


def test_body_freedom_flutter_is_critical(cli, empty_folder):
    """A broad root and slender outer segments: the short period bends the wing as it grows."""
    text = example_text(AIRCRAFT)
    for old, new in (
        ('chord = "5 cm"\nthickness', 'chord = "12 cm"\nthickness'),
        ('span = "10 cm"\n', 'span = "10 cm"\nchord = "4 cm"\n'),
        ('span = "6 cm"\n', 'span = "16 cm"\nchord = "4 cm"\n'),
        ('spacing = "15 mm"', 'spacing = "10 mm"'),
        ('centre_of_gravity = "1.25 cm"', 'centre_of_gravity = "1 cm"\ntrim = "force-and-moment"'),
        ('span = "7.5 cm"', 'span = "3 cm"'),
    ):
        assert old in text
        text = text.replace(old, new)
    (empty_folder / "broad.toml").write_text(text)
    answer = cli("aircraft", "broad.toml", "--fold", "0,0", "--json").json
    both = [p for p in answer["flutter_points"] if p.get("motion") == "body freedom"]
    assert [p["mode"] for p in both] == ["short period"] * len(both)
    first = next(p for p in both if p["event"] == "onset")
    assert first["speed"] == pytest.approx(39.78, abs=0.01)
    capped = cli("aircraft", "broad.toml", "--fold", "0,0", "--drop-mode", "B3", "--json").json
    onsets = [p for p in capped["flutter_points"] if p["event"] in ("onset", "merger")]
    of_whole = ("phugoid", "short period")
    bounding = [p for p in onsets if p["kind"] != "flutter" or p.get("motion") not in of_whole]
    assert capped["critical"] == min(bounding, key=lambda p: p["speed"])


def test_an_aircraft_that_has_no_margin_gets_an_answer(cli, empty_folder):
    """Its phugoid is born beyond the airspeeds of the curves: there is none to show."""
    text = example_text(AIRCRAFT).replace(
        'centre_of_gravity = "1.25 cm"', 'centre_of_gravity = "8 cm"'
    )
    (empty_folder / "aft.toml").write_text(text)
    answer = cli("aircraft", "aft.toml", "--json")
    assert answer.status == 0
    assert answer.json["unstable_from_start"] == 2
    assert answer.json["motions"] == []
