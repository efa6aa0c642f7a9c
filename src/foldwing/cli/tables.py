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
    from foldwing.results import FlutterRow
    from foldwing.stability.status import Status
    from foldwing.studies.boundary import Outcome

MOST_ROWS = 40
"""Cases above which the table shows the critical point of each alone."""

MOST_MODES = 6
"""Natural frequencies of each case that the table of a sweep shows."""


def new_table(*columns: str) -> Table:
    """Return a table; columns whose heads are in lower case hold words, the others numbers."""
    table = Table(header_style="bold", box=None, pad_edge=False)
    for column in columns:
        table.add_column(column, justify="left" if column.islower() else "right")
    return table


def show_examples(models: "Sequence[ExampleInfo]", measurements: Sequence[str]) -> None:
    """Print the names of what is shipped."""
    table = new_table("model", "what it is")
    for model in models:
        table.add_row(model.name, model.title)
    console = Console(highlight=False)
    console.print(table)
    console.print(f"\nMeasured points: {', '.join(measurements)}")


def show_modes(answers: Sequence[dict[str, Any]]) -> None:
    """Print natural frequencies, one line per case in a sweep."""
    first = answers[0]
    names, folds = first["mode_names"], first["fold"]
    console = Console(highlight=False)
    if len(answers) == 1:
        table = new_table("mode", "Hz")
        for name, frequency in zip(names, first["natural_frequencies_hz"], strict=True):
            table.add_row(name, f"{frequency:.5g}")
        console.print("Natural frequencies" + (f" at {_fold(folds)}" if folds else ""))
    else:
        table = new_table("fold, deg", *names[:MOST_MODES])
        for answer in answers:
            frequencies = answer["natural_frequencies_hz"][:MOST_MODES]
            table.add_row(_angles(answer["fold"]), *(f"{f:.4g}" for f in frequencies))
        part = f", {MOST_MODES} of {len(names)}" if len(names) > MOST_MODES else ""
        console.print(f"Natural frequencies in Hz{part}, named as in the first case")
    console.print(table)


def show_flutter(dataset: "xarray.Dataset") -> None:
    """Print the answer, the table of flutter points and the certificate of one case."""
    from foldwing.results import flutter_rows
    from foldwing.results.summary import answer

    rows = flutter_rows(dataset)
    table = new_table("U m/s", "f Hz", "kind", "event", "class", "mode", "S s/m")
    for row in rows:
        strength = "" if row.strength != row.strength else f"{row.strength:.4f}"
        cells = (row.kind, row.event, row.classification, row.mode_name, strength)
        table.add_row(f"{row.speed:.2f}", f"{row.frequency:.2f}", *cells)
    console = Console(highlight=False)
    console.print(plain(answer(dataset)))
    if rows:
        console.print(table)
    speeds = dataset["speed"].values
    span = f"{len(speeds)} speeds from {speeds[0]:.4g} to {speeds[-1]:.4g} m/s"
    span = span if len(speeds) > 1 else f"at {speeds[0]:.4g} m/s"
    console.print(f"\nCurves: {span}; flutter sought up to {dataset.attrs['speed_limit']:.4g} m/s.")
    _conclude(console, dataset)


def _conclude(console: Console, dataset: "xarray.Dataset") -> None:
    """Print what is certified and what is doubtful."""
    from foldwing.results.summary import certificate, response, warnings

    for text in filter(None, (response(dataset), certificate(dataset), *warnings(dataset))):
        console.print(plain(text))


def show_boundary(dataset: "xarray.Dataset") -> None:
    """Print the critical point of every case, the answer and the certificate."""
    from foldwing.results import flutter_rows, fold_angle_names
    from foldwing.results.summary import answer, failed_cases

    hinges, failed = fold_angle_names(dataset), set(failed_cases(dataset))
    brief = dataset.sizes["fold"] > MOST_ROWS
    columns = ["U m/s", "f Hz", "kind", "class", "mode", "further points, m/s"]
    table = new_table(*["fold, deg"][: len(hinges)], *columns[: -1 if brief else None])
    by_case: dict[int, list[FlutterRow]] = {}
    for row in flutter_rows(dataset):
        by_case.setdefault(row.case, []).append(row)
    for case in range(dataset.sizes["fold"]):
        cells = ["-", "", "failed" if case in failed else "none"]
        if case in by_case:
            cells = _critical_cells(by_case[case])
        folds = [_angles([float(dataset[name][case]) for name in hinges])] if hinges else []
        table.add_row(*folds, *cells[: len(columns) - brief])
    console = Console(highlight=False)
    console.print("Critical airspeed of each case")
    console.print(table)
    if brief:
        console.print("\nFurther points of each case are in flutter_points.csv.")
    console.print(plain(f"\n{answer(dataset)}"))
    if dataset.attrs.get("turning"):
        console.print(f"The boundary turns back at {dataset.attrs['turning']} deg.")
    _conclude(console, dataset)


def _critical_cells(rows: "Sequence[FlutterRow]") -> list[str]:
    """Return the first point of instability of a case, and the others in short."""
    from foldwing.results.summary import critical_row

    critical = critical_row(rows)
    others = ", ".join(f"{row.speed:.1f} {_event(row)}" for row in rows if row is not critical)
    if critical is None:
        return ["-", "", "none", "", "", others]
    numbers = [f"{critical.speed:.2f}", f"{critical.frequency:.2f}"]
    return [*numbers, critical.kind, critical.classification, critical.mode_name, others]


def _event(row: "FlutterRow") -> str:
    """Return what happens at a flutter point in a word or two."""
    if row.event == "recovery":
        return f"{row.kind} ends"
    return row.kind if row.event == "onset" else row.event


def name_failures(outcomes: "Sequence[Outcome]", wanted: int) -> None:
    """Say on standard error which cases failed, are uncertified or were never reached."""
    for outcome in outcomes:
        if outcome.status:
            reason = outcome.message or "the count of unstable roots does not agree"
            name_failure(outcome.folds, outcome.status, reason)
    if len(outcomes) < wanted:
        _say(f"Interrupted: {len(outcomes)} of {wanted} cases are finished and were kept.")


def name_problems(texts: Sequence[str]) -> None:
    """Say on standard error what failed, a line each."""
    for text in texts:
        _say(text)


def name_failure(folds: Sequence[float], status: "Status", reason: str) -> None:
    """Say on standard error how a case ended and why."""
    _say(f"{_fold(folds) or 'this wing'}: {status.meaning}: {reason}")


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
    hidden = total < 2 or not console.is_terminal
    with Progress(*columns, console=console, transient=True, disable=hidden) as bar:
        task = bar.add_task(label, total=total)
        yield lambda finished: bar.update(task, completed=finished)


def _fold(folds: Sequence[float]) -> str:
    """Return ``fold 30, -30 deg``; empty without hinges."""
    return f"fold {_angles(folds)} deg" if folds else ""


def _angles(folds: Sequence[float]) -> str:
    return ", ".join(f"{angle:g}" for angle in folds)


def plain(text: str) -> str:
    """Return text whose minus signs every terminal can show."""
    return text.replace("\u2212", "-")


def _say(text: str) -> None:
    print(text, file=sys.stderr)
