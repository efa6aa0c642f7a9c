"""The command ``steady``: its request, its tables and what it does."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import typer
from rich.console import Console

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
from foldwing.model import Wing, model_text

if TYPE_CHECKING:
    import xarray

    from foldwing.results.steady_table import Table


@dataclass(frozen=True)
class SteadyRequest(Request):
    """What is to be computed: angle of attack in degrees, airspeed in m/s, a wall at the root."""

    alpha: float = 5.0
    speed: float = 20.0
    image: bool = False

    def wing(self, text: str) -> Wing:
        """Return the wing of the model file, its lattice changed by the options."""
        wing = super().wing(text)
        return wing.with_lattice(image=True) if self.image else wing


def run_steady(request: SteadyRequest, output: Output) -> None:
    """Compute steady loads of every case of a grid of fold angles."""
    text = model_text(request.model)
    wing = request.clamped_wing(text, "steady")
    cases = request.cases(wing)

    from foldwing.results import Source
    from foldwing.studies.answers import steady_answer
    from foldwing.studies.steady import check_stream, steady_study

    check_stream(request.alpha, request.speed)
    folder = output.folder("steady", request.model)
    with computing():
        study = steady_study(
            wing,
            cases,
            alpha=request.alpha,
            speed=request.speed,
            source=Source(text, request.options),
        )
    if output.json:
        print_json(steady_answer(study))
    else:
        with shown():
            show_steady(study.dataset)
    write_result(study.dataset, folder, output)
    failed = [outcome for outcome in study.outcomes if not outcome.loads]
    for outcome in failed:
        tables.name_failure(outcome.folds, outcome.status, outcome.message)
    if failed:
        raise typer.Exit(FAILED)


def show_steady(dataset: "xarray.Dataset") -> None:
    """Print the loads of every case, those of the segments of a single one, and the answer."""
    from foldwing.results.steady_table import legend, loads_table, segments_table
    from foldwing.results.summary import answer, warnings

    console = Console(highlight=False)
    attrs = dataset.attrs
    console.print(
        f"Steady loads at {attrs['alpha']:g} deg and {attrs['airspeed']:g} m/s; coefficients on "
        f"the developed area, {attrs['reference_area']:.4g} m2"
    )
    _print(console, loads_table(dataset))
    console.print(legend(dataset))
    if dataset.sizes["fold"] == 1:
        console.print("\nOn each segment")
        _print(console, segments_table(dataset))
    for line in filter(None, (answer(dataset), *warnings(dataset))):
        console.print(f"\n{tables.plain(line)}")


def _print(console: Console, table: "Table") -> None:
    printed = tables.new_table(*(head.replace(" ", "\n", 1) for head in table.heads))
    for column in printed.columns:
        column.no_wrap = column.header != "fold"  # it wraps where nothing else would fit
    for row in table.rows:
        printed.add_row(*(tables.plain(cell) for cell in row))
    console.print(printed)
