"""Tables, progress and messages on the terminal."""

import contextlib
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table

if TYPE_CHECKING:
    import xarray

    from foldwing.model import ExampleInfo
    from foldwing.studies.boundary import Outcome

MOST_ROWS = 40
"""Rows of a table above which only the critical point of each case is shown."""


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", header_style="bold", box=None, pad_edge=False)
    for column in columns:
        table.add_column(column, justify="left" if column.islower() else "right")
    return table


def show_examples(models: "Sequence[ExampleInfo]", measurements: Sequence[str]) -> None:
    """Print the names of what is shipped."""
    table = _table("", "model", "what it is")
    for model in models:
        table.add_row(model.name, model.title)
    console = Console()
    console.print(table)
    console.print(f"\nMeasured points: {', '.join(measurements)}", highlight=False)


def show_modes(answers: Sequence[dict[str, Any]]) -> None:
    """Print natural frequencies, one column per mode for a sweep."""
    first = answers[0]
    names = first["mode_names"]
    if len(answers) == 1:
        table = _table(_title("Natural frequencies", first["fold"]), "mode", "Hz")
        for name, frequency in zip(names, first["natural_frequencies_hz"], strict=True):
            table.add_row(name, f"{frequency:.5g}")
    else:
        table = _table("Natural frequencies in Hz", "fold, deg", *(f"{n} Hz" for n in names[:6]))
        for answer in answers:
            frequencies = answer["natural_frequencies_hz"][:6]
            table.add_row(_angles(answer["fold"]), *(f"{f:.4g}" for f in frequencies))
    Console().print(table)


def show_flutter(dataset: "xarray.Dataset") -> None:
    """Print the answer, the table of flutter points and the certificate of one case."""
    from foldwing.results import flutter_rows
    from foldwing.results.summary import answer, certificate

    rows = flutter_rows(dataset)
    columns = ("U m/s", "f Hz", "kind", "event", "class", "mode", "S s/m")
    table = _table("", *columns)
    for row in rows:
        strength = "" if row.strength != row.strength else f"{row.strength:.4f}"
        cells = (row.kind, row.event, row.classification, row.mode_name, strength)
        table.add_row(f"{row.speed:.2f}", f"{row.frequency:.2f}", *cells)
    console = Console(highlight=False)
    console.print(answer(dataset))
    if rows:
        console.print(table)
    speeds = dataset["speed"].values
    span = f"{len(speeds)} speeds from {speeds[0]:g} to {speeds[-1]:g} m/s"
    console.print(f"\nCurves: {span}; flutter sought up to {dataset.attrs['speed_limit']:g} m/s.")
    console.print(certificate(dataset))


def show_boundary(dataset: "xarray.Dataset") -> None:
    """Print the critical point of every case, the answer and the certificate."""
    from foldwing.results import flutter_rows, fold_angle_names
    from foldwing.results.summary import answer, certificate

    columns = ("fold, deg", "U m/s", "f Hz", "kind", "class", "mode", "further points, m/s")
    table = _table("Critical airspeed of each case", *columns)
    rows = flutter_rows(dataset)
    for case in range(dataset.sizes["fold"]):
        mine = [row for row in rows if row.case == case]
        critical = next((row for row in mine if row.event != "recovery"), None)
        folds = [float(dataset[name][case]) for name in fold_angle_names(dataset)]
        if critical is None:
            table.add_row(_angles(folds), "-", "", "", "", "", "")
            continue
        others = ", ".join(f"{row.speed:.1f} {row.event}" for row in mine if row is not critical)
        cells = (critical.kind, critical.classification, critical.mode_name, others)
        speed, frequency = f"{critical.speed:.2f}", f"{critical.frequency:.2f}"
        table.add_row(_angles(folds), speed, frequency, *cells)
    console = Console(highlight=False)
    console.print(table)
    console.print(answer(dataset))
    console.print(certificate(dataset))


def name_failures(outcomes: "Sequence[Outcome]", wanted: int) -> None:
    """Say on standard error which cases failed, are uncertified or were never reached."""
    for outcome in outcomes:
        if outcome.status:
            reason = outcome.message or "the count of unstable roots does not agree"
            _say(f"{_angles(outcome.folds)} deg: {outcome.status.meaning}: {reason}")
    if len(outcomes) < wanted:
        _say(f"Interrupted: {len(outcomes)} of {wanted} cases are finished and were kept.")


@contextlib.contextmanager
def progress(label: str, total: int) -> Iterator[Callable[[int], None]]:
    """Show a bar on standard error while the block runs; give a function that moves it."""
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (TextColumn(label), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    console = Console(file=sys.stderr)
    with Progress(*columns, console=console, transient=True, disable=total < 2) as bar:
        task = bar.add_task(label, total=total)
        yield lambda finished: bar.update(task, completed=finished)


def _title(what: str, folds: Sequence[float]) -> str:
    return f"{what} at fold {_angles(folds)} deg" if folds else what


def _angles(folds: Sequence[float]) -> str:
    return ", ".join(f"{angle:g}" for angle in folds)


def _say(text: str) -> None:
    print(text, file=sys.stderr)
