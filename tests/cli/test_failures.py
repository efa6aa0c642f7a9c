"""Cases that fail, runs that are interrupted, pipes that break."""

import contextlib
import signal
import subprocess
import time

import numpy as np
import pytest

from foldwing.results import read_dataset
from foldwing.studies import boundary

SWEEP = ("boundary", "three-segment", "--fold2", "0:90:30", "--fold3", "level", "--max-speed", 40)


@pytest.fixture
def fail_at(monkeypatch):
    """Make the case with one of the given values of fold_2 raise."""

    def prepare(problem, *angles):
        def solve(model, folds, speeds):
            if folds[0] in angles:
                raise problem
            return original(model, folds, speeds)

        original = boundary.solve_case
        monkeypatch.setattr(boundary, "solve_case", solve)

    return prepare


@pytest.mark.parametrize("more", [("--no-plot",), ()])
def test_other_cases_stand_when_one_fails(cli, empty_folder, fail_at, more):
    whole = cli(*SWEEP, "--json").json["cases"]
    fail_at(np.linalg.LinAlgError("Singular matrix"), 30.0)
    answer = cli(*SWEEP, "--json", "--out", "result", *more)
    assert answer.status == 1
    assert answer.err.splitlines()[-1] == ("fold 30, -30 deg: failed: LinAlgError: Singular matrix")
    cases = answer.json["cases"]
    assert [case["status"] for case in cases] == ["ok", "failed", "ok", "ok"]
    assert [cases[i] for i in (0, 2, 3)] == [whole[i] for i in (0, 2, 3)]
    failed = cases[1]
    assert failed["fold"] == [30.0, -30.0]
    assert (failed["flutter_points"], failed["critical"]) == ([], None)
    assert failed["certified"] is False
    assert failed["valid_from"] is None
    assert "Singular matrix" in failed["message"]
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    meanings = dataset["case_status"].attrs["flag_meanings"].split()
    values = dataset["case_status"].attrs["flag_values"].tolist()
    status = [meanings[values.index(value)] for value in dataset["case_status"].values]
    assert status == ["ok", "failed", "ok", "ok"]
    assert dataset["certified"].values.tolist() == [True, False, True, True]
    assert 1 not in dataset["case"].values


def test_failed_case_is_named_in_the_table(cli, fail_at):
    fail_at(ZeroDivisionError("division by zero"), 30.0)
    answer = cli(*SWEEP, "--no-plot")
    assert answer.status == 1
    assert ["30,", "-30", "-", "failed"] in [line.split() for line in answer.out.splitlines()]
    assert "3 of 4 cases certified" in answer.out.replace("\n", " ")
    assert "fold 30, -30 deg: failed: ZeroDivisionError: division by zero" in answer.err


@pytest.mark.parametrize("more", [("--no-plot",), ()])
def test_all_cases_fail(cli, empty_folder, fail_at, more):
    fail_at(np.linalg.LinAlgError("Singular matrix"), 0.0, 30.0, 60.0, 90.0)
    answer = cli(*SWEEP, "--out", "result", *more)
    assert answer.status == 1
    assert answer.err.count(": failed: LinAlgError") == 4
    assert read_dataset(empty_folder / "result" / "dataset.nc").sizes["flutter_point"] == 0


def test_failure_of_the_natural_modes_leaves_the_rest(cli, empty_folder, monkeypatch):
    def follow(*arguments):
        raise np.linalg.LinAlgError("no convergence")

    monkeypatch.setattr(boundary, "follow_modes", follow)
    answer = cli(*SWEEP, "--out", "result")
    assert answer.status == 0
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    assert dataset.sizes["flutter_point"] >= 4
    assert dataset["certified"].values.all()
    assert (dataset["mode_confidence"].values == 0.0).all()


def test_failure_without_hinges_is_named_too(cli, monkeypatch):
    def solve(*arguments):
        raise FloatingPointError("overflow")

    monkeypatch.setattr(boundary, "solve_case", solve)
    answer = cli("boundary", "goland", "--json")
    assert answer.status == 1
    assert answer.err == "this wing: failed: FloatingPointError: overflow\n"
    assert answer.json["cases"][0]["status"] == "failed"


def test_flutter_that_fails(cli, monkeypatch, empty_folder):
    def solve(*arguments):
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr("foldwing.studies.flutter.solve_case", solve)
    answer = cli("flutter", "goland", "--out", "result")
    assert (answer.status, answer.out) == (1, "")
    assert "the computation failed (LinAlgError: Singular matrix)" in answer.err
    assert list(empty_folder.iterdir()) == []


def test_uncertified_case_is_named_and_is_no_failure(cli, monkeypatch):
    from foldwing.stability.flutter import FlutterAnalysis

    monkeypatch.setattr(FlutterAnalysis, "certified", False)
    answer = cli(*SWEEP, "--json")
    assert answer.status == 0
    assert {case["status"] for case in answer.json["cases"]} == {"uncertified"}
    assert answer.err.count("deg: uncertified: ") == 4
    assert "Not certified: fold 0°, 0°" in cli(*SWEEP, "--no-plot").out.replace("\n", " ")


def test_defect_is_reported_without_traceback(capsys, monkeypatch, empty_folder):
    from foldwing.cli.main import run

    def solve(*arguments):
        raise TypeError("some mistake")

    monkeypatch.setattr(boundary, "solve_case", solve)
    assert run(["boundary", "goland", "--out", "result"]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("Internal error: TypeError: some mistake\n")
    assert "report it" in captured.err
    assert list(empty_folder.iterdir()) == []


# ------------------------------------------------------------------------------------ interruptions


def test_interrupted_sweep_keeps_what_is_finished(cli, empty_folder, fail_at):
    fail_at(KeyboardInterrupt(), 60.0)
    answer = cli(*SWEEP, "--json", "--no-plot", "--out", "result")
    assert answer.status == 1
    assert "Interrupted: 2 of 4 cases are finished and were kept." in answer.err
    assert answer.json["interrupted"] == "2 of 4 cases finished"
    assert [case["status"] for case in answer.json["cases"]] == ["ok", "ok"]
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    assert dataset["fold_2"].values.tolist() == [0.0, 30.0]
    assert dataset.attrs["interrupted"] == "2 of 4 cases finished"


@pytest.mark.parametrize("command", [SWEEP, ("flutter", "three-segment")])
def test_interrupted_before_anything_is_finished(cli, monkeypatch, empty_folder, command):
    def solve(*arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(f"foldwing.studies.{command[0]}.solve_case", solve)
    answer = cli(*command, "--out", "result")
    assert (answer.status, answer.out) == (1, "")
    assert answer.err.strip() == "Interrupted: nothing was written."
    assert list(empty_folder.iterdir()) == []


def test_ctrl_c(start, empty_folder):
    many = ("boundary", "three-segment", "--fold2", "0:150:0.01", "--fold3", "level")
    for seconds in (3.0, 10.0, 30.0):  # a busy machine may not have finished a case by then
        process = start(*many, "--max-speed", 40, "--no-plot", "--out", "result")
        time.sleep(seconds)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)
        assert process.returncode == 1
        assert "Traceback" not in out + err
        if "nothing was written" not in err:
            break
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    finished = dataset.sizes["fold"]
    assert 0 < finished < 15001
    assert f"Interrupted: {finished} of 15001 cases are finished and were kept." in err
    assert dataset["fold_2"].values == pytest.approx(np.arange(finished) * 0.01)
    assert dataset["certified"].values.all()


def press_ctrl_c(process):
    """Press it again where nothing happens: a library that is being loaded may swallow one."""
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            return process.communicate(timeout=15)
    process.send_signal(signal.SIGINT)
    return process.communicate(timeout=15)


@pytest.mark.parametrize("seconds", [0.1, 0.3])
def test_ctrl_c_at_the_start(start, empty_folder, seconds):
    process = start("flutter", "three-segment", "--json", "--speeds", "0:90:0.001")
    time.sleep(seconds)
    out, err = press_ctrl_c(process)
    assert out == ""
    assert process.returncode in (1, -signal.SIGINT)  # the latter before foldwing is loaded
    if process.returncode == 1:
        assert err.strip() == "Interrupted: nothing was written."
    assert list(empty_folder.iterdir()) == []


def test_broken_pipe(start):
    process = start("schema")
    process.stdout.close()
    process.wait(timeout=30)
    assert "Traceback" not in process.stderr.read()
