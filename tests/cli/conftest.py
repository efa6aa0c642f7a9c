"""Run foldwing in an empty folder, inside this process or in one of its own."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import foldwing
from foldwing.cli.main import run

START = (
    # Whoever starts the tests in the background has Ctrl-C ignored, and children inherit that.
    "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from foldwing.cli import main; main()"
)


@dataclass(frozen=True)
class Answer:
    """What a command left behind."""

    status: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """The one document on standard output; NaN is not JSON."""
        return json.loads(self.out, parse_constant=refuse)


def refuse(name: str) -> None:
    raise AssertionError(f"{name} in JSON")


def sound(status: int, out: str, err: str) -> Answer:
    assert "Traceback" not in out + err
    assert "Internal error" not in err, err
    return Answer(status, out, err)


@pytest.fixture(autouse=True)
def empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in an empty folder with a terminal of 80 columns."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    for variable in ("FORCE_COLOR", "NO_COLOR", "PY_COLORS", "TTY_COMPATIBLE"):
        monkeypatch.delenv(variable, raising=False)
    return tmp_path


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str]) -> Callable[..., Answer]:
    """Run foldwing in this process."""

    def call(*arguments: object) -> Answer:
        capsys.readouterr()
        status = run([str(argument) for argument in arguments])
        return sound(status, *capsys.readouterr())

    return call


@pytest.fixture
def start() -> Iterator[Callable[..., "subprocess.Popen[str]"]]:
    """Start foldwing in a process of its own."""
    started: list[subprocess.Popen[str]] = []

    def call(*arguments: object, **environment: str) -> "subprocess.Popen[str]":
        source = str(Path(foldwing.__file__).parents[1])
        process = subprocess.Popen(
            [sys.executable, "-c", START, *map(str, arguments)],
            env={**os.environ, "PYTHONPATH": source, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
        )
        started.append(process)
        return process

    yield call
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def shell(start: Callable[..., "subprocess.Popen[str]"]) -> Callable[..., Answer]:
    """Run foldwing in a process of its own, to the end."""

    def call(*arguments: object, **environment: str) -> Answer:
        process = start(*arguments, **environment)
        out, err = process.communicate(timeout=60)
        return sound(process.returncode, out, err)

    return call


@pytest.fixture
def no_computing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make every computation an error."""

    def computed(*arguments: object) -> None:
        raise AssertionError("something was computed")

    for name in (
        "boundary.solve_case",
        "flutter.solve_case",
        "convergence.solve_case",
        "modes.follow_modes",
        "steady.wing_loads",
        "section.find_flutter",
    ):
        monkeypatch.setattr(f"foldwing.studies.{name}", computed)
