"""Help, version and start."""

import os
import re
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

import foldwing

OF_A_MODEL = {"--fold", "--fold-of", "--basis", "--plot", "--no-plot", "--out", "--force", "--json"}
OF_AN_AIRSTREAM = {"--structure", "--aero", "--panels", "--spacing", "--gap", "--drop-mode"}
OF_A_SEARCH = OF_AN_AIRSTREAM | {"--max-speed", "--damping", "--damping-threshold"}
OF_AN_AIRCRAFT = {"--tail-aero", "--trim"}
OPTIONS = {
    "examples": {"--copy"},
    "schema": set(),
    "modes": OF_A_MODEL | {"--structure", "--measured", "--clamped"},
    "flutter": OF_A_MODEL | OF_A_SEARCH | {"--speeds", "--method", "--time-step", "--clamped"},
    "steady": (OF_A_MODEL - {"--basis"})
    | {"--alpha", "--speed", "--panels", "--spacing", "--gap", "--image", "--clamped"},
    "aircraft": OF_A_MODEL | OF_A_SEARCH | OF_AN_AIRCRAFT | {"--speeds"},
    "flight": (OF_A_MODEL - {"--basis"}) | OF_AN_AIRCRAFT | {"--speed", "--speeds"},
    "boundary": OF_A_MODEL
    | OF_A_SEARCH
    | OF_AN_AIRCRAFT
    | {"--measured", "--trace", "--jobs", "--clamped"},
    "convergence": OF_A_MODEL | OF_A_SEARCH | {"--vary", "--levels", "--jobs", "--clamped"},
    "section": {"--plot", "--no-plot", "--out", "--force", "--json"}
    | {"--torsion", "--speeds", "--max-speed", "--aero", "--damping", "--damping-threshold"},
}


@pytest.mark.parametrize("command", OPTIONS)
@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_help_lists_every_option(cli, command, flag):
    answer = cli(command, flag)
    assert answer.status == 0
    assert answer.err == ""
    listed = set(re.findall(r"(?<![\w-])--[a-z-]+", answer.out))
    mentioned = {"--fold2", "--fold3", "--fold"}
    assert OPTIONS[command] | {"--help"} <= listed
    assert listed <= OPTIONS[command] | {"--help"} | mentioned


def test_help_tells_the_defaults_in_words(cli):
    words = " ".join(re.findall(r"[\w(),-]+", cli("boundary", "--help").out))
    assert "(default: a new dated folder)".replace(":", "") in words
    assert "divergence of the flat wing)" in words


def test_help_tells_how_long_the_reference_takes(cli):
    words = " ".join(re.findall(r"[\w(),-]+", cli("flutter", "--help").out))
    assert "takes about a minute" in words


def test_help_lists_every_command(cli):
    answer = cli("--help")
    assert answer.status == 0
    for command in OPTIONS:
        assert re.search(rf"\b{command} +[A-Z]", answer.out)


@pytest.mark.parametrize("width", ["80", "200"])
def test_help_fits_the_terminal(shell, width):
    answer = shell("flutter", "--help", COLUMNS=width, TERMINAL_WIDTH=width)
    assert "--damping-threshold" in answer.out
    assert max(len(line.rstrip()) for line in answer.out.splitlines()) <= int(width)


def test_help_does_not_load_what_computing_needs():
    heavy = "scipy", "xarray", "pandas", "matplotlib", "plotly", "pint", "joblib", "h5py"
    code = (
        "import sys\nfrom foldwing.cli.main import run\nrun(['boundary', '--help'])\n"
        f"print(*[name for name in {heavy} if name in sys.modules], file=sys.stderr)"
    )
    environment = {**os.environ, "PYTHONPATH": str(Path(foldwing.__file__).parents[1])}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment
    )
    assert "--jobs" in done.stdout
    assert done.stderr.strip() == ""


def test_version(cli, monkeypatch):
    monkeypatch.setattr(metadata, "version", lambda name: "1.2.3")
    answer = cli("--version")
    assert (answer.status, answer.out, answer.err) == (0, "foldwing 1.2.3\n", "")


def test_nothing_at_all_shows_help(cli):
    answer = cli()
    assert "boundary" in answer.out + answer.err
    assert answer.status in (0, 2)


def test_schema_is_json(cli):
    answer = cli("schema")
    assert answer.status == 0
    assert "wing" in answer.json["properties"]
