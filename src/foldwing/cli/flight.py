"""The command ``flight``: its request, its tables and what it does."""

from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any

from rich.console import Console

from foldwing.cli import tables
from foldwing.cli.commands import Output, computing, print_json, shown, write_result
from foldwing.model import model_text, parse_flight

if TYPE_CHECKING:
    import xarray

    from foldwing.results.steady_table import Table


@dataclass(frozen=True)
class FlightRequest:
    """What is to be computed: a model, and airspeeds in m/s as the user gave them."""

    model: str
    speeds: str | None = None

    @property
    def options(self) -> dict[str, Any]:
        """The options that differ from their defaults, kept with the result."""
        defaults = {field.name: field.default for field in fields(self)}
        return {key: value for key, value in asdict(self).items() if value != defaults[key]}


def run_flight(request: FlightRequest, output: Output) -> None:
    """Compute phugoid and short period of an aircraft, at its airspeed and over a range."""
    text = model_text(request.model)
    model = parse_flight(text, request.model)

    from foldwing.results import Source
    from foldwing.studies.flight import check_speeds, flight_answer, flight_study
    from foldwing.studies.grid import parse_speeds

    speeds = None if request.speeds is None else parse_speeds(request.speeds)
    if speeds is not None:
        check_speeds(model, speeds)
    folder = output.folder("flight", request.model)
    with computing():
        study = flight_study(model, speeds=speeds, source=Source(text, request.options))
    if output.json:
        print_json(flight_answer(study))
    else:
        with shown():
            show_flight(study.dataset)
    write_result(study.dataset, folder, output)


def show_flight(dataset: "xarray.Dataset") -> None:
    """Print the modes, the same by other models, derivatives, trim and airspeeds."""
    from foldwing.results.flight_table import (
        derivatives_table,
        models_table,
        modes_table,
        speeds_table,
        trim_text,
    )
    from foldwing.results.summary import answer

    console = Console(highlight=False)
    console.print(tables.plain(answer(dataset)))
    _print(console, "Modes of the four states", modes_table(dataset))
    if dataset.sizes["flight_model"] > 1:
        _print(console, "Beside other models", models_table(dataset))
    if "X_u" in dataset:
        _print(console, "Stability derivatives in N, N m", derivatives_table(dataset))
    if "swept_eigenvalue" in dataset:
        _print(console, "Against airspeed, in trim at each", speeds_table(dataset))
    if text := trim_text(dataset):
        console.print(f"\n{tables.plain(text)}")
    if "path_time" not in dataset:
        console.print("\nWithout an airspeed there are no flight paths and no simple phugoid.")


def _print(console: Console, title: str, table: "Table") -> None:
    console.print(f"\n{title}")
    printed = tables.new_table(*(head.replace(" ", "\n", 1) for head in table.heads))
    for row in table.rows:
        printed.add_row(*(tables.plain(cell) for cell in row))
    console.print(printed)
