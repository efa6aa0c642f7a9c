"""Curves of the flutter boundary: ``--trace``."""

import numpy as np

from foldwing.results import read_dataset

SWEEP = ("boundary", "three-segment", "--fold2", "30", "--no-plot", "--max-speed", "40")


def test_curves_turn_back_where_the_hump_appears(cli, empty_folder):
    """Onset and recovery of the hump are one curve, whose turn is between the two cases."""
    answer = cli(*SWEEP, "--fold3", "-60:-10:10", "--trace", "--json", "--out", "result")
    assert answer.status == 0
    (turn,) = answer.json["turning_folds"]
    assert -31.42 < turn < -31.40
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    on_turn = np.abs(dataset["curve_fold"] - turn) < 0.2
    assert on_turn.any()
    assert np.all(np.abs(dataset["curve_strength"][on_turn]) < 1e-3)


def test_every_flutter_point_lies_on_a_curve(cli, empty_folder):
    cli(*SWEEP, "--fold3", "-60:-10:10", "--trace", "--out", "result")
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    flutter = dataset["kind"].values == "flutter"
    fold = dataset["fold_3"].values[dataset["case"].values[flutter]]
    speed = dataset["flutter_speed"].values[flutter]
    samples = np.stack([dataset["curve_fold"] / 10, np.log(dataset["curve_speed"])], axis=1)
    points = np.stack([fold / 10, np.log(speed)], axis=1)
    nearest = np.linalg.norm(points[:, None] - samples, axis=2).min(axis=1)
    assert len(points) > 8
    assert nearest.max() < 0.7


def test_a_grid_of_two_folds_has_no_curves(cli):
    answer = cli("boundary", "three-segment", "--fold2", "0:20:10", "--fold3", "0:20:10", "--trace")
    assert answer.status == 2
    assert "--trace" in answer.err
    assert "single swept fold angle" in answer.err


def test_damping_and_threshold_are_followed_too(cli):
    answer = cli(
        "boundary", "three-segment", "--fold2", "90:150:10", "--fold3", "level", "--json",
        "--trace", "--damping", "0.01", "--damping-threshold", "0.02",
    )  # fmt: skip
    assert answer.status == 0
    assert len(answer.json["cases"]) == 7
    assert all(case["unstable_from_start"] > 0 for case in answer.json["cases"])
