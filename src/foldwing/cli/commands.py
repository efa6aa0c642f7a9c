"""What the commands do: read, check, compute, answer, write."""

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from foldwing.cli import tables
from foldwing.cli.request import Request
from foldwing.errors import ComputationError, InputError, OutputError
from foldwing.model import (
    example_text,
    json_schema,
    list_examples,
    measurement_names,
    model_text,
)

if TYPE_CHECKING:
    import xarray

    from foldwing.aeroelastic.wing import AeroelasticWing
    from foldwing.studies.boundary import Boundary

FAILED = 1


@dataclass(frozen=True)
class Output:
    """Where the answer goes."""

    plot: bool = True
    out: Path | None = None
    force: bool = False
    json: bool = False

    def folder(self, kind: str, model: str) -> Path | None:
        """Return the folder to write, checked before any computing; None when there is none."""
        from foldwing.results import check_writable, default_folder

        if self.json and self.out is None:
            return None
        folder = self.out or default_folder(kind, model)
        check_writable(folder, self.force)
        return folder


def run_examples(name: str | None, copy: Path | None) -> None:
    """List the shipped models and measurements, show one, or copy one to a new file."""
    if name is None:
        if copy is not None:
            raise InputError(
                "NAME", None, "--copy needs to know which example", "Write its name first."
            )
        tables.show_examples(list_examples(), measurement_names())
        return
    text = example_text(name)
    if copy is None:
        typer.echo(text, nl=False)
        return
    try:
        with copy.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise OutputError(f"--copy: {copy} exists already. Give the name of a new file.") from None
    except OSError as problem:
        reason = f"cannot be written ({problem.strerror})"
        raise OutputError(f"--copy: {copy} {reason}. Give another file.") from None
    typer.echo(f"{name} -> {copy}")


def run_schema() -> None:
    """Print the JSON schema of model files."""
    typer.echo(json.dumps(json_schema(), indent=2))


def run_modes(request: Request, output: Output) -> None:
    """Compute natural frequencies and mode shapes."""
    text = model_text(request.model)
    wing = request.wing(text)
    cases = request.cases(wing)
    measured = _measured(request, cases)
    folder = output.folder("modes", request.model)

    from foldwing.results import Source
    from foldwing.studies.answers import modes_answer
    from foldwing.studies.modes import modes_study

    dataset, followed = modes_study(
        wing, cases, source=Source(text, request.options), measured=measured
    )
    names = followed[0].modes.names
    answers = [modes_answer(case.modes, names) for case in followed]
    if output.json:
        print_json(answers[0] if len(answers) == 1 else {"cases": answers})
    else:
        with shown():
            tables.show_modes(answers)
    for text in followed[0].modes.assembly.warnings:
        print(text, file=sys.stderr)
    write_result(dataset, folder, output)


def run_flutter(request: Request, output: Output) -> None:
    """Compute flutter points and loci of one case."""
    text = model_text(request.model)
    wing = request.clamped_wing(text, "flutter")
    folds = request.one_case(wing)

    from foldwing.cli import reference
    from foldwing.results import Source
    from foldwing.studies.answers import flutter_answer
    from foldwing.studies.flutter import flutter_study
    from foldwing.studies.grid import parse_speeds
    from foldwing.studies.speeds import check_highest

    speeds = None if request.speeds is None else parse_speeds(request.speeds)
    check_highest(request.max_speed)
    model = reference.model_of(request, wing, text)
    folder = output.folder("flutter", request.model)
    source, highest = Source(text, request.options), request.max_speed
    with computing():
        if request.method == "reference":
            dataset, answer = reference.solve(request, model, folds, speeds, source)
        else:
            dataset, case = flutter_study(
                model, folds, speeds=speeds, highest=highest, source=source
            )
            answer = flutter_answer(case)
    if output.json:
        print_json(answer)
    else:
        with shown():
            tables.show_flutter(dataset)
    write_result(dataset, folder, output)


def run_boundary(request: Request, output: Output) -> None:
    """Compute flutter points of every case of a grid of fold angles."""
    text = model_text(request.model)
    wing = request.wing(text)
    cases = request.cases(wing)
    measured = _measured(request, cases)

    from foldwing.results import Source
    from foldwing.studies.answers import boundary_answer
    from foldwing.studies.boundary import boundary_study
    from foldwing.studies.speeds import check_highest
    from foldwing.studies.trace import check_traceable

    check_highest(request.max_speed)
    if request.trace:
        check_traceable(cases)
    folder = output.folder("boundary", request.model)
    model = request.model_of(wing)
    with computing(), tables.progress("Fold angles", len(cases)) as advance:
        result = boundary_study(
            model,
            cases,
            highest=request.max_speed,
            jobs=request.jobs,
            progress=advance,
            source=Source(text, request.options),
            measured=measured,
        )
    if request.trace and not result.interrupted:
        result = _with_curves(result, model)
    if output.json:
        print_json(boundary_answer(result))
    else:
        with shown():
            tables.show_boundary(result.dataset)
    write_result(result.dataset, folder, output)
    tables.name_failures(result.outcomes, result.wanted)
    if result.interrupted or any(outcome.case is None for outcome in result.outcomes):
        raise typer.Exit(FAILED)


def _with_curves(result: "Boundary", model: "AeroelasticWing") -> "Boundary":
    """Join the points of a boundary into curves; an interruption leaves them as they are."""
    from foldwing.studies.trace import with_curves

    total = result.dataset.sizes["flutter_point"]
    try:
        with computing(), tables.progress("Curves", total) as advance:
            return with_curves(result, model, advance)
    except KeyboardInterrupt:
        print("Interrupted: the points are kept without curves.", file=sys.stderr)
        return result


def _measured(request: Request, cases: list[tuple[float, ...]]) -> Any:
    """Return the measured points, checked to lie on the sweep."""
    if request.measured is None:
        return None
    from foldwing.studies.measured import read_measured

    measured = read_measured(request.measured)
    measured.check_cases(cases)
    return measured


@contextlib.contextmanager
def shown() -> Iterator[None]:
    """Go on without standard output when its reader has gone (``| head``): files come after it."""
    try:
        yield
        sys.stdout.flush()
    except (BrokenPipeError, SystemExit):  # rich turns the one into the other
        sys.stdout = open(os.devnull, "w", encoding="utf-8")


@contextlib.contextmanager
def computing() -> Iterator[None]:
    """Name a numerical failure that left nothing to show."""
    import numpy as np

    try:
        yield
    except (ArithmeticError, np.linalg.LinAlgError) as problem:
        raise ComputationError(
            f"the computation failed ({type(problem).__name__}: {problem}). Check the order of "
            "magnitude of the model's values and of the airspeeds."
        ) from problem


def print_json(answer: dict[str, Any]) -> None:
    """Print one JSON document; NaN is refused."""
    typer.echo(json.dumps(answer, allow_nan=False))


def write_result(dataset: "xarray.Dataset", folder: Path | None, output: Output) -> None:
    """Write the dataset, its tables and its pictures into a folder, and name them."""
    if folder is None:
        return
    from foldwing.results import DATASET_FILE, free_name, result_folder, write_dataset

    if output.out is None:  # another run may have taken the dated name meanwhile
        folder = free_name(folder)
    with result_folder(folder, output.force) as staging:
        write_dataset(dataset, staging / DATASET_FILE)
        _write_tables(dataset, staging)
        if output.plot:
            from foldwing.plots import write_pictures, write_report

            write_pictures(dataset, staging)
            write_report(dataset, staging / "report.html")
        names = sorted(path.name for path in staging.iterdir() if path.name != "manifest.txt")
    stream = sys.stderr if output.json else sys.stdout
    with shown():
        print(f"\nWritten to {folder}:", *names, sep="\n  ", file=stream)
        if output.plot:
            print(f"\nReport: {folder / 'report.html'}", file=stream)


def _write_tables(dataset: "xarray.Dataset", folder: Path) -> None:
    """Write the CSV files of what the dataset holds."""
    from foldwing.results import (
        write_aircraft_csv,
        write_changes_csv,
        write_convergence_csv,
        write_csv,
        write_flight_csv,
        write_frequencies_csv,
        write_steady_csv,
    )

    if "natural_frequency" in dataset:
        write_frequencies_csv(dataset, folder / "natural_frequencies.csv")
    if "case" in dataset:
        write_csv(dataset, folder / "flutter_points.csv")
    for variable, write in (
        ("level_speed", write_convergence_csv),
        ("lift_slope", write_steady_csv),
        ("flight_eigenvalue", write_flight_csv),
        ("lift_share", write_aircraft_csv),
    ):
        if variable in dataset:
            write(dataset, folder)
    if "change_kind" in dataset:
        write_changes_csv(dataset, folder / "changes.csv")
