"""What ``flutter --method reference`` answers, writes and refuses."""

import numpy as np
import pytest

from foldwing.model import example_text
from foldwing.results import read_dataset

CASE = ("--aero", "lattice", "--fold", "30,-75", "--panels", "2x6")
REFERENCE = ("flutter", "three-segment", *CASE, "--method", "reference")


@pytest.fixture
def no_marching(monkeypatch):
    """Make every computation of the reference an error."""

    def computed(*arguments, **options):
        raise AssertionError("something was computed")

    for name in ("solve_case", "solve_reference"):
        monkeypatch.setattr(f"foldwing.studies.reference.{name}", computed)


def test_reference_finds_the_points_of_the_sweep_with_the_same_scheme(cli, empty_folder):
    text = example_text("three-segment") + '\n[lattice]\nscheme = "average"\n'
    (empty_folder / "average.toml").write_text(text, encoding="utf-8")
    swept = cli("flutter", "average.toml", *CASE, "--json").json["critical"]
    answer = cli(*REFERENCE, "--json")
    assert answer.status == 0
    found = answer.json
    assert (found["certified"], found["status"]) == (False, "uncertified")
    assert found["fold"] == [30.0, -75.0]
    for key in ("speed", "frequency"):
        assert found["critical"][key] == pytest.approx(swept[key], rel=1e-7)
    assert found["critical"]["strength"] == pytest.approx(swept["strength"], rel=1e-3)
    for key in ("kind", "event", "mode"):
        assert found["critical"][key] == swept[key]


def test_the_response_at_the_onset_neither_grows_nor_decays(cli):
    found = cli(*REFERENCE, "--json").json
    response, critical = found["response"], found["critical"]
    assert response["speed"] == critical["speed"]
    assert response["frequency"] == pytest.approx(critical["frequency"], rel=1e-6)
    assert abs(response["damping_ratio"]) < 1e-6
    assert response["misfit"] < 1e-6


def test_reference_writes_the_response_and_its_picture(cli, empty_folder):
    speeds = ("--speeds", "0:16:4")
    answer = cli(*REFERENCE, *speeds, "--out", "result")
    assert (answer.status, answer.err) == (0, "")
    assert "No flutter or divergence found up to 16 m/s, but the case is not" in answer.out
    assert "After a tap at 16 m/s" in answer.out
    folder = empty_folder / "result"
    assert (folder / "response.png").stat().st_size > 10000
    dataset = read_dataset(folder / "dataset.nc")
    assert "marching in time, reference (average scheme)" in dataset.attrs["method"]
    assert not dataset["certified"].any()
    assert not dataset["loci_certified"].any()
    assert np.isnan(dataset["growth"].sel(speed=0.0)).all()
    response = dataset["response"]
    assert response.attrs["speed"] == 16.0
    last = dataset["eigenvalue"].sel(speed=16.0).values.ravel()
    slowest = last[np.nanargmax(last.real)]
    assert response.attrs["growth"] == pytest.approx(slowest.real, rel=1e-3)
    assert response.attrs["frequency"] == pytest.approx(abs(slowest.imag) / (2 * np.pi), rel=1e-3)
    assert np.abs(response).max() == 1.0
    envelope = dataset["response_envelope"]
    begun = np.isfinite(envelope.isel(mode=0).values)
    assert begun.any() and not begun.all()
    late = slice(-len(begun) // 3, None)
    mode = int(np.argmax(np.nan_to_num(envelope.values[-1])))
    peaks = np.abs(response.values[late, mode]) / envelope.values[late, mode]
    assert peaks.max() == pytest.approx(1.0, abs=0.1)


def test_the_terminal_says_each_thing_on_its_own_line_and_the_fold_not_again(cli, monkeypatch):
    monkeypatch.setenv("COLUMNS", "500")
    lines = cli(*REFERENCE, "--speeds", "4:16:4", "--no-plot").out.splitlines()
    first = lines.index("The reference is never certified.")
    assert lines[first - 1].startswith("After a tap at 16 m/s")
    assert "modes drop out, the fastest first" in lines[first + 1]
    assert lines[first + 2].startswith("The reference follows each mode over 4 airspeeds")
    assert "fold" not in " ".join(lines[: first + 3])


def test_the_message_names_airspeeds_between_which_a_divergence_was_lost(cli, monkeypatch):
    near = ("--speeds", "34:46:12", "--json")
    found = cli(*REFERENCE, *near).json
    assert "divergence" in [point["kind"] for point in found["flutter_points"]]
    assert "real root" not in found["warning"]
    monkeypatch.setattr("foldwing.studies.reference.divergence_crossing", lambda *ends: None)
    lost = cli(*REFERENCE, *near).json
    assert "divergence" not in [point["kind"] for point in lost["flutter_points"]]
    assert "begins or ceases to grow between 34 and 46 m/s" in lost["warning"]


def test_the_model_is_built_once(cli, monkeypatch):
    from foldwing.studies import reference

    built, build = [], reference.reference_model
    monkeypatch.setattr(reference, "reference_model", lambda *a: built.append(a) or build(*a))
    assert cli(*REFERENCE, "--speeds", "4:8:4", "--json").status == 0
    assert len(built) == 1


@pytest.mark.parametrize(("step", "panels"), [("0.0012", "2x6"), ("0.0005", "5x6")])
def test_a_fixed_step_fits_the_panels_to_the_airspeed(cli, step, panels):
    near = ("--speeds", "16:24:4", "--json")
    meshed = cli(*REFERENCE, *near, "--panels", panels).json["critical"]
    stepped = cli(*REFERENCE, *near, "--time-step", step).json["critical"]
    assert stepped["speed"] == pytest.approx(meshed["speed"], rel=1e-9)


@pytest.mark.usefixtures("no_marching")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--method", "reference"), ("--method", "not of strip", "--aero lattice")),
        (("--method", "reference", "--aero", "quasi-steady"), ("--method", "not of quasi-steady")),
        (("--time-step", "0.001"), ("--time-step", "only the reference", "--method reference")),
        ((*REFERENCE[2:], "--time-step", "0"), ("--time-step", "greater than 0 s")),
        ((*REFERENCE[2:], "--time-step", "soon"), ("--time-step", "must be a number")),
        (
            (*REFERENCE[2:], "--time-step", "1e-5", "--speeds", "5:20:5"),
            ("--time-step", "1000 panels along the chord at 5 m/s"),
        ),
    ],
)
def test_what_the_reference_cannot_serve_is_refused_before_computing(cli, arguments, words):
    answer = cli("flutter", "three-segment", *arguments, "--json")
    assert (answer.status, answer.out) == (2, "")
    for word in words:
        assert word in " ".join(answer.err.split())


@pytest.mark.usefixtures("no_marching")
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (('\n[lattice]\nscheme = "exact"\n',), ("lattice.scheme", "discrete time", "average")),
        (("", "chord = "), ("--method", "equal chord", "--method sweep")),
    ],
)
def test_a_model_without_reference_is_refused(cli, empty_folder, change, words):
    text = example_text("three-segment") + change[0]
    if len(change) > 1:
        text = text.replace('span = "6 cm"', 'span = "6 cm"\nchord = "4 cm"')
        assert "4 cm" in text
    (empty_folder / "model.toml").write_text(text, encoding="utf-8")
    answer = cli("flutter", "model.toml", *REFERENCE[2:], "--json")
    assert (answer.status, answer.out) == (2, "")
    for word in words:
        assert word in " ".join(answer.err.split())
