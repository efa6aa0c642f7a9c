"""The functions behind the commands do not swallow what they do not know."""

import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import read_model
from foldwing.studies.boundary import boundary_study
from foldwing.studies.flutter import flutter_study
from foldwing.studies.modes import modes_study

CASES = [(30.0, -30.0)]


@pytest.fixture(scope="module")
def wing():
    return read_model("three-segment")


def test_records_reject_unknown_keywords(wing):
    for part, word, near in (
        (wing.segments[0], "cord", "chord"),
        (wing.hinges[0], "stifness", "stiffness"),
        (wing, "titel", "title"),
        (wing.air, "densty", "density"),
        (wing.analysis, "dampin", "damping"),
    ):
        with pytest.raises(ValueError, match=f"Did you mean {near}"):
            type(part)(**dict(part), **{word: 1.0})


def test_analysis_rejects_unknown_keywords(wing):
    with pytest.raises(InputError, match="Did you mean damping"):
        wing.with_analysis(dampin=0.1)


def test_studies_reject_unknown_keywords(wing):
    model = AeroelasticWing(wing)
    for call in (
        lambda: flutter_study(model, CASES[0], sped=1.0),
        lambda: boundary_study(model, CASES, job=2),
        lambda: modes_study(wing, CASES, measurd=None),
        lambda: AeroelasticWing(wing, aero="strip"),
    ):
        with pytest.raises(TypeError, match="unexpected keyword"):
            call()


@pytest.mark.parametrize("highest", [0.0, -1.0, float("nan"), float("inf")])
def test_studies_reject_impossible_airspeeds(wing, highest):
    model = AeroelasticWing(wing)
    with pytest.raises(InputError, match="100000 m/s"):
        boundary_study(model, CASES, highest=highest)
    with pytest.raises(InputError, match="100000 m/s"):
        flutter_study(model, CASES[0], highest=highest)


def test_command_line_and_python_give_the_same(cli, wing):
    result = boundary_study(AeroelasticWing(wing), CASES)
    point = result.outcomes[0].case.analysis.critical
    answer = cli("boundary", "three-segment", "--json").json
    assert answer["cases"][0]["critical"]["speed"] == point.speed
    assert not result.interrupted
