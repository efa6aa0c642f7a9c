"""The vortex lattice on the command line."""

from pathlib import Path

import numpy as np
import pytest

from foldwing.results import read_dataset

QUICK = ("--aero", "lattice", "--panels", "3x9", "--max-speed", 50, "--no-plot")
FOLD = ("--fold", "30,-60")


def flutter(cli, *more):
    answer = cli("flutter", "three-segment", *FOLD, *QUICK, *more, "--json")
    assert answer.status == 0, answer.err
    return answer.json


def test_flutter_answers_with_what_is_resolved(cli, empty_folder):
    found = flutter(cli, "--out", "result")
    assert found["certified"] is True
    assert 10.0 < found["valid_from"] < 60.0
    assert "T1" in found["uncertified_modes"] and "B1" not in found["uncertified_modes"]
    assert found["critical"]["kind"] == "flutter"
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    assert "vortex lattice" in dataset.attrs["method"]
    assert dataset["uncertified_modes"].item() == ", ".join(found["uncertified_modes"])
    assert dataset["valid_from"].item() == found["valid_from"]


def test_table_says_what_is_not_resolved(cli):
    out = " ".join(cli("flutter", "three-segment", *FOLD, *QUICK).out.split())
    assert "Below that modes drop out, the fastest first; at" in out
    assert "More panels along the chord lower the limits." in out


def test_search_that_ends_before_all_modes_are_resolved(cli):
    out = " ".join(cli("flutter", "three-segment", *FOLD, *QUICK[:-2], 25, "--no-plot").out.split())
    assert "among the modes resolved (all of them only from 31" in out


def test_spacing_changes_the_answer(cli):
    uniform, inset = (flutter(cli, "--spacing", name) for name in ("uniform", "inset"))
    assert uniform["critical"] == flutter(cli)["critical"]
    assert 0.001 < abs(inset["critical"]["speed"] / uniform["critical"]["speed"] - 1) < 0.1


def test_strip_theory_says_nothing_of_the_kind(cli):
    out = cli("flutter", "three-segment", *FOLD, "--no-plot").out
    assert "lattice" not in out


def test_panels_and_gaps_change_the_answer(cli):
    plain = flutter(cli)["critical"]["speed"]
    finer = flutter(cli, "--panels", "6x9")
    gaps = flutter(cli, "--gap", "2 mm")["critical"]["speed"]
    assert finer["valid_from"] == pytest.approx(flutter(cli)["valid_from"] / 2, rel=0.05)
    assert gaps > plain
    assert flutter(cli, "--gap", "0.002")["critical"]["speed"] == gaps


def test_mode_left_out(cli):
    names = {point["mode"] for point in flutter(cli)["flutter_points"]}
    without = flutter(cli, "--drop-mode", "B2")
    assert "B2" in names
    assert "B2" not in {point["mode"] for point in without["flutter_points"]}
    two = flutter(cli, "--drop-mode", "B2", "--drop-mode", "T1")
    assert {"B2", "T1"}.isdisjoint({*two["uncertified_modes"]})


def test_branch_lost_between_coarse_airspeeds_is_no_new_one(cli):
    """Its first airspeeds may have no value; no warning, and each pair once."""
    mesh = ("--aero", "lattice", "--panels", "4x12", "--no-plot")
    coarse = cli("flutter", "hale", *mesh, "--speeds", "20:140:10", "--out", "coarse")
    assert (coarse.status, coarse.err) == (0, "")
    values = read_dataset(Path("coarse/dataset.nc"))["eigenvalue"].values[0]
    for row in values:
        found = row[np.isfinite(row.real) & (row.imag > 0.0)]
        apart = np.abs(found[:, None] / found - 1.0) + np.eye(len(found))
        assert apart.min() > 1e-6


def test_boundary(cli):
    answer = cli(
        "boundary", "three-segment", "--fold2", "0:60:30", "--fold3", "level", *QUICK, "--json"
    )
    assert answer.status == 0
    assert [case["certified"] for case in answer.json["cases"]] == [True] * 3
    assert all(case["uncertified_modes"] for case in answer.json["cases"])


def test_folds_onto_itself_are_named_and_the_others_stand(cli):
    answer = cli("boundary", "three-segment", "--fold2", "0:180:90", "--fold3", 0, *QUICK, "--json")
    assert answer.status == 1
    good, _, bad = answer.json["cases"]
    assert (good["status"], bad["status"]) == ("ok", "failed")
    assert "lie on each other, 0 mm apart" in bad["message"]
    assert "fold 180, 0 deg: failed" in answer.err


def test_folds_near_to_itself_carry_a_warning(cli):
    fold = ("--fold", "172,0")
    answer = cli("flutter", "three-segment", *fold, *QUICK, "--json")
    assert "of a strip: the lattice is inaccurate there." in answer.json["warning"]
    shown = " ".join(cli("flutter", "three-segment", *fold, *QUICK).out.split())
    assert answer.json["warning"] in shown
    assert "warning" not in flutter(cli)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--fold", "180,0"), "fold: got '180, 0'; segments 1 and 2 lie on each other"),
        (("--panels", "8"), "--panels: got '8'; must be panels along the chord, x, strips"),
        (("--panels", "0x30"), "--panels: got 0; must be a whole number, 1 to 1000"),
        (("--panels", "8x2"), "--panels: got 2; must be at least one strip for each of 3"),
        (("--panels", "999x999"), "--panels: got 999; a lattice may have 10000 panels"),
        (("--gap", "30 cm"), "--gap: got 0.3; gaps must leave some of the 0.14 m of segment 1"),
        (("--gap", "wide"), "--gap: got 'wide'; must be a length (m)"),
        (("--gap", "-1 mm"), "--gap: got '-1 mm'; must be a length (m)"),
        (("--aero", "strip", "--panels", "8x30"), "--panels: got '8x30'; belongs to the vortex"),
        (("--aero", "strip", "--gap", "1 mm"), "--gap: got '1 mm'; belongs to the vortex lattice"),
        (("--drop-mode", "Q7"), "--drop-mode: got 'Q7'; must be one of: B1, B2, T1"),
    ],
)
def test_bad_input(cli, empty_folder, more, words):
    answer = cli("flutter", "three-segment", "--aero", "lattice", *more)
    assert (answer.status, answer.out) == (2, "")
    found = answer.err.replace("segments 2 and 1", "segments 1 and 2")
    assert words in found
    assert list(empty_folder.iterdir()) == []


def test_leaving_out_every_mode_is_refused(cli):
    model = ["--drop-mode", "B1", "--aero", "lattice", "--fold", "0,0"]
    names = [f"B{i}" for i in range(2, 9)] + [f"T{i}" for i in range(1, 9)]
    answer = cli("flutter", "three-segment", *model, *(f"--drop-mode={name}" for name in names))
    assert answer.status == 2
    assert "--drop-mode: got" in answer.err
