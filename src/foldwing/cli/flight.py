"""The command ``flight``: its request, its tables and what it does."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from rich.console import Console

from foldwing.cli import tables
from foldwing.cli.commands import Output, computing, print_json, shown, write_result
from foldwing.cli.request import Request
from foldwing.errors import InputError
from foldwing.model import Airframe, Wing, model_text, parse_file, parse_flight

if TYPE_CHECKING:
    import xarray

    from foldwing.flight import ModeRow
    from foldwing.model import FlightModel
    from foldwing.results.steady_table import Table


@dataclass(frozen=True)
class FlightRequest(Request):
    """What is to be computed; the airspeed of the flight in m/s."""

    speed: float | None = None


def run_flight(request: FlightRequest, output: Output) -> None:
    """Compute phugoid and short period of an aircraft, at its airspeed and over a range."""
    text = model_text(request.model)
    flown = _flown(request, text)

    from foldwing.results import Source
    from foldwing.studies.flight import check_speeds, flight_answer, flight_study
    from foldwing.studies.grid import parse_speeds
    from foldwing.studies.multibody import multibody_rows

    speeds = None if request.speeds is None else parse_speeds(request.speeds)
    check_speeds(flown.model, () if speeds is None else speeds)
    folder = output.folder("flight", request.model)
    with computing():
        rows: tuple[ModeRow, ...] = ()
        if flown.wing is not None and flown.model.speed is not None:
            at = [flown.model.speed, *([] if speeds is None else speeds.tolist())]
            rows = multibody_rows(flown.wing, flown.folds, at)
        study = flight_study(
            flown.model, speeds=speeds, comparisons=rows, source=Source(text, request.options)
        )
    if output.json:
        print_json(flight_answer(study))
    else:
        with shown():
            show_flight(study.dataset)
    write_result(study.dataset, folder, output)


class _Flown(NamedTuple):
    """The rigid aircraft, and the same as joined bodies where it has a wing and a tail."""

    model: "FlightModel"
    wing: Wing | None
    folds: tuple[float, ...]


def _flown(request: FlightRequest, text: str) -> _Flown:
    """Return what a model file describes, by [flight], or by [wing] and [aircraft]."""
    from foldwing.studies.multibody import airframe_of, wing_of

    tables = parse_file(text, request.model)
    if tables.flight is None:
        if tables.aircraft is None:
            raise tables.missing("flight")
        wing = request.aircraft_wing(text)
        folds = request.one_case(wing, "flight")
        return _Flown(airframe_of(wing, folds, _speed(request, wing)), wing, folds)
    others = {
        "--fold": request.fold,
        "--fold-of": request.fold_of,
        "--trim": request.trim,
        "--tail-aero": request.tail_aero,
    }
    for option, value in others.items():
        if value:
            limit = "belongs to a wing of an aircraft, and [flight] describes a rigid aircraft"
            raise InputError(option, str(value), limit, "Leave it out.")
    model = _at(parse_flight(text, request.model), request.speed)
    return _Flown(model, wing_of(model) if isinstance(model, Airframe) else None, ())


def _speed(request: FlightRequest, wing: Wing) -> float | None:
    """Return the airspeed asked for; the first of a range where there is no other."""
    if request.speed is not None or request.speeds is None:
        return request.speed
    if wing.aircraft is not None and wing.aircraft.cruise_speed is not None:
        return None
    from foldwing.studies.grid import parse_speeds

    return float(parse_speeds(request.speeds)[0])


def _at(model: "FlightModel", speed: float | None) -> "FlightModel":
    from foldwing.studies.flight import check_flight_speed

    if speed is None:
        return model
    if not isinstance(model, Airframe):
        limit = "belongs to a model by wing and tail: other forms hold at one airspeed"
        raise InputError("--speed", speed, limit, "Change the speed in the model file.")
    check_flight_speed(speed)
    return model.flown_at(speed)


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
