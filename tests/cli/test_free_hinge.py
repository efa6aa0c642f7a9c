"""Wings with a free hinge through every command."""

import numpy as np
import pytest

from foldwing.model import example_text
from foldwing.results import read_dataset

FREE = "hinge = { free = true, fold = -30 }"


@pytest.fixture
def model(empty_folder):
    text = example_text("three-segment")
    line = next(part for part in text.splitlines() if "fold = -30" in part)
    path = empty_folder / "free.toml"
    path.write_text(text.replace(line, FREE), encoding="utf-8")
    return str(path)


def test_modes_name_the_rigid_motion(cli, model):
    answer = cli("modes", model, "--json").json
    assert answer["natural_frequencies_hz"][0] == 0.0
    assert answer["mode_names"][0] == "R1"


@pytest.mark.parametrize("command", ["flutter", "boundary"])
def test_flutter_points_are_certified(cli, model, command):
    answer = cli(command, model, "--json").json
    case = answer if command == "flutter" else answer["cases"][0]
    assert case["certified"]
    assert case["critical"]["kind"] == "flutter"


def test_branches_stand_beside_their_modes(cli, model, empty_folder):
    """Eigenvalues and natural frequencies of one row belong to one mode; R1 has no branch."""
    assert cli("flutter", model, "--no-plot", "--out", "result", "--speeds", "0:60:1").status == 0
    dataset = read_dataset(empty_folder / "result" / "dataset.nc")
    names, branches = dataset["mode_name"].values[0], dataset["branch_name"].values
    kept = names != ""
    assert names[kept].tolist() == branches[kept].tolist()
    assert np.isnan(dataset["growth"].values[0, :, 0]).all()
    at_rest = dataset["frequency"].values[0, 0, 1:6]
    still = dataset["natural_frequency"].values[0, 1:6]
    np.testing.assert_allclose(at_rest, still, rtol=0.25)


def test_pictures_are_drawn(cli, model, empty_folder):
    assert cli("flutter", model, "--out", "result").status == 0
    assert (empty_folder / "result" / "report.html").stat().st_size > 1e6


def test_reference_leaves_the_free_motion_out(cli, model):
    """A flap at any angle is in equilibrium: an exact zero root, neither growing nor decaying."""
    lattice = ("--aero", "lattice", "--panels", "2x6", "--speeds", "2:40:4", "--json")
    answer = cli("flutter", model, *lattice, "--method", "reference").json
    assert answer["unstable_from_start"] == 0
    assert {point["kind"] for point in answer["flutter_points"]} == {"flutter"}
