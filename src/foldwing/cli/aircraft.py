"""The command aircraft and its tables."""

from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console

from foldwing.cli import tables
from foldwing.cli.commands import Output, computing, print_json, shown, write_result
from foldwing.cli.request import Request
from foldwing.model import model_text

if TYPE_CHECKING:
    import xarray

SHOWN_SPEEDS = 5
"""Airspeeds at which the table shows the motions of the aircraft."""


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


def show_aircraft(dataset: "xarray.Dataset") -> None:
    """Print the answer, trim, the motions as a whole, and the flutter points beside the clamped."""
    tables.show_flutter(dataset)
    console = Console(highlight=False)
    _show_clamped(console, dataset)
    _show_trim(console, dataset)
    _show_motions(console, dataset)


def _show_clamped(console: Console, dataset: "xarray.Dataset") -> None:
    console.print("\nThe same wing with its root clamped")
    if "clamped_kind" not in dataset:
        console.print("could not be computed.")
        return
    table = tables.new_table("U m/s", "f Hz", "kind", "event", "class", "mode")
    names = ("flutter_speed", "flutter_frequency", "kind", "event", "class", "flutter_mode")
    columns = [dataset[f"clamped_{name}"].values.tolist() for name in names]
    for speed, frequency, *words in zip(*columns, strict=True):
        table.add_row(f"{speed:.2f}", f"{frequency:.2f}", *words)
    console.print(table if table.row_count else "has no flutter points in this range.")


def _show_trim(console: Console, dataset: "xarray.Dataset") -> None:
    """Print how the weight is carried, and the angle of attack where the motions are shown."""
    share, lift = dataset["lift_share"].values[0], dataset["surface_lift"].values[0]
    coefficient = dataset["surface_lift_coefficient"].values[0]
    at = shown_speeds(dataset)
    table = tables.new_table("lift", "share", "N", *(f"CL {_speed(dataset, i)}" for i in at))
    for index, name in enumerate(dataset["surface"].values.tolist()):
        values = (f"{coefficient[i, index] + 0.0:.3f}" for i in at)
        table.add_row(name, f"{share[index] + 0.0:.1%}", f"{lift[index] + 0.0:.4g}", *values)
    angles = dataset["trim_angle"].values[0]
    table.add_row("angle, deg", "", "", *(f"{angles[i]:.3f}" for i in at))
    console.print("\nLevel flight of the half aircraft; CL at the airspeed in m/s")
    console.print(table)


def _show_motions(console: Console, dataset: "xarray.Dataset") -> None:
    from foldwing.results.summary import motion_text

    names = dataset["branch_name"].values.tolist()
    at = shown_speeds(dataset)
    found = [name for name in ("phugoid", "short period") if name in names]
    if not found:
        console.print("\nNeither phugoid nor short period was found as an oscillation.")
        return
    table = tables.new_table("motion", *(_speed(dataset, index) for index in at))
    for name in found:
        values = dataset["eigenvalue"].values[0, at, names.index(name)]
        table.add_row(name, *(motion_text(value) for value in values))
    console.print("\nMotions of the aircraft as a whole: Hz and damping ratio, by airspeed in m/s")
    console.print(table)


def _speed(dataset: "xarray.Dataset", index: int) -> str:
    return f"{float(dataset['speed'][index]):.3g}"


def shown_speeds(dataset: "xarray.Dataset") -> list[int]:
    """Return indices of a few airspeeds of the curves, from the slowest level flight on."""
    speeds = dataset["speed"].values
    slowest = min(float(dataset["slowest_speed"][0]), float(speeds[-1]))
    possible = np.flatnonzero(speeds >= slowest)
    chosen = np.linspace(0, len(possible) - 1, min(SHOWN_SPEEDS, len(possible)))
    return [int(possible[index]) for index in np.rint(chosen).astype(int)]
