"""Tables of a typical section: its flutter points, and where the lowest onset changes."""

from pathlib import Path
from typing import TYPE_CHECKING

from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.steady_table import Table
from foldwing.results.summary import critical_row, failed_cases
from foldwing.results.units import RATIOS, units_of
from foldwing.results.writing import write_table

if TYPE_CHECKING:
    import xarray

_WORDS = ("kind", "event", "class", "mode")


def section_points_table(dataset: "xarray.Dataset") -> Table:
    """Return all flutter points; ratios beside them when there are units."""
    rows = enumerate(flutter_rows(dataset))
    cells = [(*_first(dataset, row.case), *_cells(dataset, point, row)) for point, row in rows]
    return Table((*_heads(dataset), *_WORDS), cells)


def lowest_table(dataset: "xarray.Dataset") -> Table:
    """Return the lowest onset of every case, in the units of the dataset."""
    rows = flutter_rows(dataset)
    failed = set(failed_cases(dataset))
    heads = _heads(dataset)[:3]
    cells = []
    for case in range(dataset.sizes["fold"]):
        row = critical_row([row for row in rows if row.case == case])
        first = _first(dataset, case)
        if row is None:
            what = "failed" if case in failed else "none"
            cells.append((*first, "-", "", what, "", ""))
        else:
            words = (row.kind, row.classification, row.mode_name)
            cells.append((*first, f"{row.speed:.5g}", f"{row.frequency:.5g}", *words))
    return Table((*heads, "kind", "class", "mode"), cells)


def changes_table(dataset: "xarray.Dataset") -> Table:
    """Return where the lowest onset goes over to another curve, with both its sides."""
    speed, frequency = _heads(dataset, several=False)[:2]
    cells = []
    for change in range(dataset.sizes.get("change", 0)):
        numbers = [
            f"{dataset[f'change_{name}'].values[change, side]:.7g}"
            for side in (0, 1)
            for name in ("speed", "frequency")
        ]
        ratio = f"{float(dataset['change_torsion_ratio'][change]):.9g}"
        sure = "yes" if bool(dataset["change_confirmed"][change]) else "no"
        cells.append((ratio, str(dataset["change_kind"].values[change]), *numbers, sure))
    sides = [f"{head} {side}" for side in ("below", "above") for head in (speed, frequency)]
    return Table(("torsion", "what", *sides, "confirmed"), cells)


def write_changes_csv(dataset: "xarray.Dataset", path: Path) -> None:
    """Write where the lowest onset changes: one line each, both sides in the dataset's units."""
    names = ("speed_below", "frequency_below", "speed_above", "frequency_above")
    body = (
        (
            float(dataset["change_torsion_ratio"][change]),
            str(dataset["change_kind"].values[change]),
            *(
                float(dataset[f"change_{name}"].values[change, side])
                for side in (0, 1)
                for name in ("speed", "frequency")
            ),
            bool(dataset["change_confirmed"][change]),
        )
        for change in range(dataset.sizes["change"])
    )
    write_table(path, ("torsion_frequency_ratio", "kind", *names, "confirmed"), body)


def _heads(dataset: "xarray.Dataset", several: bool | None = None) -> tuple[str, ...]:
    """Return the heads of the numbers: torsion frequency ratio in a sweep, speed, frequency."""
    units, ratios = units_of(dataset), ("U/(b ω₁)", "ω/ω₁")
    several = dataset.sizes["fold"] > 1 if several is None else several
    first = ("torsion",) if several else ()
    scaled = (f"U {units.speed}", f"f {units.frequency}")
    return (*first, *ratios) if units is RATIOS else (*first, *scaled, *ratios)


def _first(dataset: "xarray.Dataset", case: int) -> tuple[str, ...]:
    if dataset.sizes["fold"] == 1:
        return ()
    return (f"{float(dataset['torsion_frequency_ratio'][case]):.5g}",)


def _cells(dataset: "xarray.Dataset", point: int, row: FlutterRow) -> tuple[str, ...]:
    numbers = [row.speed, row.frequency]
    if units_of(dataset) is not RATIOS:
        numbers += [float(dataset[f"{name}_ratio"][point]) for name in ("speed", "frequency")]
    words = (row.kind, row.event, row.classification, row.mode_name)
    return (*(f"{number:.5g}" for number in numbers), *words)
