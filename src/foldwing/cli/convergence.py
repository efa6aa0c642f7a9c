"""The command convergence and its tables."""

from typing import TYPE_CHECKING

import typer
from rich.console import Console
from rich.table import Table

from foldwing.cli import tables
from foldwing.cli.commands import (
    FAILED,
    Output,
    computing,
    print_json,
    shown,
    write_result,
)
from foldwing.cli.request import Request
from foldwing.model import model_text

if TYPE_CHECKING:
    import xarray

    from foldwing.results import FlutterRow
    from foldwing.results.convergence_table import Levels


def run_convergence(request: Request, output: Output) -> None:
    """Compute how the flutter points of one case depend on mesh, wake, time step and modes."""
    text = model_text(request.model)
    wing = request.clamped_wing(text, "convergence")
    folds = request.one_case(wing, "convergence")

    from foldwing.results import Source
    from foldwing.studies.answers import convergence_answer
    from foldwing.studies.convergence import convergence_study
    from foldwing.studies.speeds import check_highest
    from foldwing.studies.variants import parse_levels, parse_settings, variants

    check_highest(request.max_speed)
    settings, levels = parse_settings(request.vary), parse_levels(request.levels or ())
    model = request.model_of(wing)
    chosen = variants(model, settings, levels)
    folder = output.folder("convergence", request.model)
    total = sum(not variant.own for variant in chosen)
    with computing(), tables.progress("Levels", total) as advance:
        study = convergence_study(
            model,
            folds,
            chosen,
            highest=request.max_speed,
            jobs=request.jobs,
            progress=advance,
            source=Source(text, request.options),
        )
    if output.json:
        print_json(convergence_answer(study))
    else:
        with shown():
            show_convergence(study.dataset)
    write_result(study.dataset, folder, output)
    tables.name_problems(study.failures)
    if study.interrupted or study.failures:
        raise typer.Exit(FAILED)


def show_convergence(dataset: "xarray.Dataset") -> None:
    """Print the answer, the error bar of every flutter point, and the levels by setting."""
    from foldwing.results import flutter_rows
    from foldwing.results.convergence_table import TITLES, levels_by_setting
    from foldwing.results.summary import answer, certificate, warnings

    rows, console = flutter_rows(dataset), Console(highlight=False)
    console.print(tables.plain(answer(dataset)))
    settings = levels_by_setting(dataset)
    if rows:
        console.print("\nError bars of the airspeed in %, by setting; mesh: chord + span + wake")
        console.print(_summary(dataset, rows, settings))
    for one in settings if rows else ():
        console.print(f"\nAirspeed in m/s against {TITLES[one.setting]}; * the model's own")
        console.print(_levels(one, rows))
    for text in filter(None, (certificate(dataset), *warnings(dataset))):
        console.print(tables.plain(f"\n{text}"))


def _summary(
    dataset: "xarray.Dataset", rows: "list[FlutterRow]", settings: "list[Levels]"
) -> Table:
    mesh = dataset["mesh_error_speed"].values
    limit = dataset["mesh_limit_speed"].values
    whole = bool((limit == limit).any())
    heads = [_HEADS[one.setting] for one in settings]
    table = tables.new_table("U m/s", "f Hz", "what", *(["Limit", "Mesh"] if whole else []), *heads)
    for point, row in enumerate(rows):
        total = [_limit(limit[point]), _percent(mesh[point], row.speed)] if whole else []
        parts = [_percent(one.error[point], row.speed) for one in settings]
        cells = (f"{row.speed:.2f}", f"{row.frequency:.2f}", _what(row))
        table.add_row(*cells, *total, *parts)
    return table


_HEADS = {
    "chordwise": "Chord",
    "spanwise": "Span",
    "wake": "Wake",
    "time-step": "Step",
    "segment-modes": "Segm.",
    "system-modes": "Syst.",
    "gap": "Gap",
}


_SHORT = {"oscillating": "osc.", "scattered": "none", "diverging": "grows"}


def _levels(one: "Levels", rows: "list[FlutterRow]") -> Table:
    heads = [f"{v:g}{'*' if own else ''}" for v, own in zip(one.values, one.own, strict=True)]
    table = tables.new_table("what", *heads, "Order", "Limit", "Error %")
    for point, row in enumerate(rows):
        order = f"{one.order[point]:.2f}" if one.verdict[point] == "monotone" else ""
        table.add_row(
            _what(row),
            *(_speed(speed) for speed in one.speed[:, point]),
            order or _SHORT.get(one.verdict[point], one.verdict[point]),
            _limit(one.limit[point]),
            _percent(one.error[point], row.speed),
        )
    return table


def _what(row: "FlutterRow") -> str:
    """Return a flutter point in two words, ``T1 onset``; divergence by its kind."""
    name = row.mode_name if row.kind == "flutter" else "div."
    return f"{name} {row.event}"


def _speed(value: float) -> str:
    return f"{value:#.5g}" if value == value else "missing"


def _limit(value: float) -> str:
    return f"{value:#.5g}" if value == value else "?"


def _percent(error: float, speed: float) -> str:
    return f"{100.0 * error / speed:.2f}" if error == error else "?"
