"""Result folders: what is in them, and that they are written whole or not at all."""

import csv
import json
import os
import re

import pytest

from foldwing.cli.request import Request
from foldwing.model import example_text
from foldwing.results import read_dataset

SWEEP = ("boundary", "three-segment", "--fold2", "0:50:50", "--fold3", "level", "--max-speed", 40)
TABLES = {"dataset.nc", "natural_frequencies.csv", "manifest.txt"}


def names(folder):
    return {path.name for path in folder.iterdir()}


@pytest.mark.parametrize(
    ("command", "files"),
    [
        (("modes", "goland"), TABLES),
        (("flutter", "goland"), TABLES | {"flutter_points.csv"}),
        (SWEEP, TABLES | {"flutter_points.csv"}),
    ],
)
def test_contents(cli, empty_folder, command, files):
    answer = cli(*command, "--no-plot", "--out", "deep/er/result")
    assert answer.status == 0
    assert names(empty_folder) == {"deep"}
    assert names(empty_folder / "deep") == {"er"}
    folder = empty_folder / "deep" / "er" / "result"
    assert names(folder) == files
    assert "Written to deep/er/result:" in answer.out.replace(os.sep, "/")
    for name in files - {"manifest.txt"}:
        assert f"  {name}\n" in answer.out
        assert (folder / name).stat().st_size > 0


@pytest.mark.parametrize("command", [("modes", "goland"), ("flutter", "goland"), SWEEP])
def test_pictures_and_report(cli, empty_folder, command):
    answer = cli(*command, "--out", "result")
    assert answer.status == 0
    folder = empty_folder / "result"
    pictures = {path.name for path in folder.iterdir() if path.suffix in (".png", ".svg")}
    assert pictures
    assert {re.sub("png$", "svg", name) for name in pictures} <= pictures
    assert "<html" in (folder / "report.html").read_text(encoding="utf-8")[:500]
    for name in pictures | {"report.html"}:
        assert f"  {name}\n" in answer.out


def test_new_dated_folder_by_default(cli, empty_folder):
    for count in (1, 2):
        assert cli("modes", "goland", "--no-plot").status == 0
        assert len(names(empty_folder)) == count
    for name in names(empty_folder):
        assert re.fullmatch(r"foldwing-modes-goland-\d{4}-\d\d-\d\d-\d{6}(-\d+)?", name)


def test_json_and_folder_together(cli, empty_folder):
    plain = cli(*SWEEP, "--json")
    answer = cli(*SWEEP, "--json", "--no-plot", "--out", "result")
    assert answer.status == 0
    assert answer.out == plain.out
    assert "dataset.nc" in answer.err
    assert names(empty_folder) == {"result"}


def test_files_hold_the_answer(cli, empty_folder):
    cases = cli(*SWEEP, "--json", "--no-plot", "--out", "result").json["cases"]
    folder = empty_folder / "result"
    with (folder / "flutter_points.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    wanted = [
        (number, point) for number, case in enumerate(cases) for point in case["flutter_points"]
    ]
    assert [(int(row["case"]), float(row["speed"])) for row in rows] == [
        (number, point["speed"]) for number, point in wanted
    ]
    assert [row["class"] for row in rows] == [point["class"] for _, point in wanted]
    dataset = read_dataset(folder / "dataset.nc")
    assert dataset["flutter_speed"].values.tolist() == [point["speed"] for _, point in wanted]
    assert dataset["fold_2"].values.tolist() == [0.0, 50.0]
    assert dataset["certified"].values.all()


def test_result_says_how_to_compute_it_again(cli, empty_folder):
    options = ("--fold", "10,20", "--aero", "quasi-steady", "--damping", "0.01", "--max-speed", 40)
    cli("flutter", "three-segment", *options, "--no-plot", "--out", "first")
    attrs = read_dataset(empty_folder / "first" / "dataset.nc").attrs
    assert attrs["model_text"] == example_text("three-segment")
    stored = json.loads(attrs["options"])
    assert stored.pop("model") == "three-segment"
    assert stored == {
        "fold": "10,20", "aero": "quasi-steady", "damping": 0.01, "max_speed": 40.0,
    }  # fmt: skip
    assert Request("x", **stored).aero == "quasi-steady"
    (empty_folder / "again.toml").write_text(attrs["model_text"], encoding="utf-8")
    again = [f"--{key.replace('_', '-')}={value}" for key, value in stored.items()]
    cli("flutter", "again.toml", *again, "--no-plot", "--out", "second")
    first, second = (
        read_dataset(empty_folder / name / "dataset.nc") for name in ("first", "second")
    )
    assert first.drop_attrs().equals(second.drop_attrs())


@pytest.fixture
def old(cli, empty_folder):
    assert cli("modes", "goland", "--no-plot", "--out", "result").status == 0
    return empty_folder / "result"


def read(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize("command", [("modes", "hale"), ("flutter", "hale"), SWEEP])
def test_existing_result_is_refused_before_computing(cli, empty_folder, command):
    folder = empty_folder / "result"
    folder.mkdir()
    for name, text in (("manifest.txt", "foldwing result\ndataset.nc\n"), ("dataset.nc", "old")):
        (folder / name).write_text(text, encoding="utf-8")
    before = read(folder)
    answer = cli(*command, "--out", "result")
    assert (answer.status, answer.out) == (2, "")
    for word in ("result: ", "already holds a result", "--force"):
        assert word in answer.err
    assert read(folder) == before
    assert names(empty_folder) == {"result"}


def test_force_replaces_the_result_and_keeps_the_rest(cli, old):
    (old / "notes.txt").write_text("mine", encoding="utf-8")
    answer = cli("flutter", "hale", "--no-plot", "--out", "result", "--force")
    assert answer.status == 0
    assert names(old) == TABLES | {"flutter_points.csv", "notes.txt"}
    assert (old / "notes.txt").read_text(encoding="utf-8") == "mine"
    assert "High-altitude" in read_dataset(old / "dataset.nc").attrs["title"]


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize("more", [(), ("--force",)])
def test_folders_of_others_are_never_replaced(cli, empty_folder, more):
    (empty_folder / "photos").mkdir()
    (empty_folder / "photos" / "cat.jpg").write_text("cat", encoding="utf-8")
    answer = cli("modes", "goland", "--out", "photos", *more)
    assert (answer.status, answer.out) == (2, "")
    assert "not a foldwing result" in answer.err
    assert names(empty_folder / "photos") == {"cat.jpg"}


@pytest.mark.usefixtures("no_computing")
@pytest.mark.parametrize("place", ["file", "file/below", "file/far/below"])
def test_folder_that_cannot_be_written(cli, empty_folder, place):
    (empty_folder / "file").write_text("text", encoding="utf-8")
    answer = cli("flutter", "three-segment", "--json", "--out", place)
    assert (answer.status, answer.out) == (2, "")
    assert "file" in answer.err
    assert "Choose another --out." in answer.err
    assert names(empty_folder) == {"file"}


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root writes anywhere")
@pytest.mark.usefixtures("no_computing")
def test_folder_without_permission(cli, empty_folder):
    (empty_folder / "locked").mkdir(mode=0o500)
    answer = cli("flutter", "three-segment", "--json", "--out", "locked/result")
    assert (answer.status, answer.out) == (2, "")
    assert "Permission denied" in answer.err


@pytest.mark.parametrize("existing", [False, True])
def test_folder_is_written_whole_or_not_at_all(cli, monkeypatch, empty_folder, existing):
    if existing:
        cli("modes", "goland", "--no-plot", "--out", "result")
    before = read(empty_folder / "result") if existing else None

    def full(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("foldwing.results.write_frequencies_csv", full)
    answer = cli("modes", "hale", "--no-plot", "--out", "result", "--force")
    assert answer.status == 1
    assert "No space left on device" in answer.err
    assert names(empty_folder) == ({"result"} if existing else set())
    if existing:
        assert read(empty_folder / "result") == before
