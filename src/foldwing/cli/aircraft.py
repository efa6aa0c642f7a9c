"""The command aircraft and its tables."""

from typing import TYPE_CHECKING

import typer
from rich.console import Console

from foldwing.cli import tables
from foldwing.cli.commands import FAILED, Output, computing, print_json, shown, write_result
from foldwing.cli.request import Request
from foldwing.model import model_text

if TYPE_CHECKING:
    import xarray

    from foldwing.results.steady_table import Table


def run_aircraft(request: Request, output: Output) -> None:
    """Compute trim, eigenvalues and flutter points of an aircraft, and of its wing clamped."""
    text = model_text(request.model)
    wing = request.aircraft_wing(text)
    folds = request.one_case(wing, "aircraft")

    from foldwing.results import Source
    from foldwing.studies.aircraft import aircraft_study
    from foldwing.studies.answers import aircraft_answer
    from foldwing.studies.grid import parse_speeds
    from foldwing.studies.speeds import check_highest

    speeds = None if request.speeds is None else parse_speeds(request.speeds)
    check_highest(request.max_speed)
    model = request.model_of(wing)
    folder = output.folder("aircraft", request.model)
    with computing():
        study = aircraft_study(
            model,
            folds,
            speeds=speeds,
            highest=request.max_speed,
            source=Source(text, request.options),
        )
    if output.json:
        print_json(aircraft_answer(study))
    else:
        with shown():
            show_aircraft(study.dataset)
    write_result(study.dataset, folder, output)
    if study.clamped is None:
        tables.name_problems([f"with its root clamped: {study.failure}"])
        raise typer.Exit(FAILED)


def show_aircraft(dataset: "xarray.Dataset") -> None:
    """Print the answer, trim, the motions as a whole, and the flutter points beside the clamped."""
    tables.show_flutter(dataset)
    console = Console(highlight=False)
    _show_clamped(console, dataset)
    _show_trim(console, dataset)
    _show_motions(console, dataset)


def _show_clamped(console: Console, dataset: "xarray.Dataset") -> None:
    from foldwing.results.aircraft_table import clamped_rows, points_table

    console.print("\nThe same wing with its root clamped")
    rows = clamped_rows(dataset)
    if rows is None:
        console.print("could not be computed.")
    elif not rows:
        console.print("has no flutter points in this range.")
    else:
        _print(console, points_table(rows))


def _show_trim(console: Console, dataset: "xarray.Dataset") -> None:
    """Print how the weight is carried."""
    from foldwing.results.aircraft_table import trim_table

    console.print("\nLevel flight of the half aircraft; lift coefficients at airspeeds in m/s")
    _print(console, trim_table(dataset))


def _show_motions(console: Console, dataset: "xarray.Dataset") -> None:
    """Print angle of attack and motions at the same airspeeds."""
    from foldwing.results.aircraft_table import motions_found, motions_table

    console.print("\nAngle of attack; frequency, growth rate and damping ratio of the motions")
    _print(console, motions_table(dataset))
    if not motions_found(dataset):
        console.print("Neither phugoid nor short period was found as an oscillation.")


def _print(console: Console, table: "Table") -> None:
    printed = tables.new_table(*(head.replace(" ", "\n") for head in table.heads))
    for row in table.rows:
        printed.add_row(*row)
    console.print(printed)
