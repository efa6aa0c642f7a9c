"""An aircraft as tables: trim, motions as a whole, flutter points; for reading and as CSV files."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.flutter_table import FlutterRow
from foldwing.results.schema import fold_angle_names
from foldwing.results.steady_table import Table
from foldwing.results.writing import write_table
from foldwing.stability.status import ELASTIC, PHUGOID, SHORT_PERIOD

if TYPE_CHECKING:
    import xarray

MOTIONS = (PHUGOID, SHORT_PERIOD)
"""Oscillations of an aircraft as a whole, the slower one first."""

SHOWN_SPEEDS = 5
"""Airspeeds at which a table shows an aircraft."""

_CLAMPED = {
    "kind": "clamped_kind",
    "event": "clamped_event",
    "classification": "clamped_class",
    "speed": "clamped_flutter_speed",
    "frequency": "clamped_flutter_frequency",
    "mode_name": "clamped_flutter_mode",
}
_CLAMPED_COLUMNS = ("kind", "event", "class", "speed", "frequency", "mode_name")
_ROUND_OFF = 1e-12
"""Share of the weight that is none."""


def clamped_rows(dataset: "xarray.Dataset") -> list[FlutterRow] | None:
    """Return the flutter points of the wing with its root clamped; None when it failed."""
    if "clamped_kind" not in dataset:
        return None
    nothing = float("nan")
    fold = tuple(float(dataset[name][0]) for name in fold_angle_names(dataset))
    blank = FlutterRow(
        case=0, fold=fold, kind="", event="", classification="", speed=nothing, frequency=nothing,
        strength=nothing, branch=-1, mode_name="", mode_confidence=1.0,
        threshold=float(dataset.attrs.get("damping_threshold", 0.0)), residual=nothing,
    )  # fmt: skip
    columns = [dataset[name].values.tolist() for name in _CLAMPED.values()]
    found = zip(*columns, strict=True)
    return [replace(blank, **dict(zip(_CLAMPED, values, strict=True))) for values in found]


def motions_found(dataset: "xarray.Dataset") -> dict[str, int]:
    """Return the places along ``mode`` of phugoid and short period, of those that were found."""
    if "branch_name" not in dataset:
        return {}
    names = dataset["branch_name"].values.tolist()
    return {name: names.index(name) for name in MOTIONS if name in names}


def shown_speeds(dataset: "xarray.Dataset") -> list[int]:
    """Return indices of a few airspeeds of the curves, from the slowest level flight on."""
    speeds = dataset["speed"].values
    slowest = min(float(dataset["slowest_speed"][0]), float(speeds[-1]))
    possible = np.flatnonzero(speeds >= slowest)
    chosen = np.linspace(0, len(possible) - 1, min(SHOWN_SPEEDS, len(possible)))
    return [int(possible[index]) for index in np.rint(chosen).astype(int)]


def points_table(rows: Sequence[FlutterRow]) -> Table:
    """Return flutter points with the motion that each belongs to."""
    heads = ("U m/s", "f Hz", "kind", "event", "class", "mode", "motion")
    lines: list[tuple[str, ...]] = [
        (
            f"{row.speed:.2f}",
            f"{row.frequency:.2f}" if row.frequency > 0.0 else "-",
            row.kind,
            row.event,
            row.classification,
            row.mode_name if row.motion == ELASTIC else "",
            row.motion,
        )
        for row in rows
    ]
    if all(row.motion == ELASTIC for row in rows):
        return Table(heads[:-1], [line[:-1] for line in lines])
    return Table(heads, lines)


def trim_table(dataset: "xarray.Dataset") -> Table:
    """Return how the weight is carried, with lift coefficients at a few airspeeds."""
    share, lift = (_exact(dataset, name) for name in ("lift_share", "surface_lift"))
    coefficient = dataset["surface_lift_coefficient"].values[0]
    at = shown_speeds(dataset)
    rows = []
    for index, name in enumerate(dataset["surface"].values.tolist()):
        values = (_three_decimals(float(coefficient[i, index])) for i in at)
        rows.append(
            (name, _percent(float(share[index])), _three_decimals(float(lift[index])), *values)
        )
    return Table(("surface", "Share", "Lift N", *(f"CL {_speed(dataset, i)}" for i in at)), rows)


def motions_table(dataset: "xarray.Dataset") -> Table:
    """Return angle of attack, phugoid and short period, one line for each of a few airspeeds."""
    found = motions_found(dataset)
    heads = ["U m/s", "Angle deg"]
    for name in found:
        initial = name[0].upper() + name[1:]
        heads += [f"{initial} Hz", f"{initial} 1/s", f"{initial} ζ"]
    angle = dataset["trim_angle"].values[0]
    rows = []
    for speed in shown_speeds(dataset):
        values = dataset["eigenvalue"].values[0, speed]
        cells = (cell for place in found.values() for cell in _motion_cells(complex(values[place])))
        rows.append((_speed(dataset, speed), f"{angle[speed]:.3f}", *cells))
    return Table(tuple(heads), rows)


def _motion_cells(value: complex) -> tuple[str, str, str]:
    """Return frequency, growth and damping ratio; dashes where the oscillation is lost."""
    if not np.isfinite(value) or value.imag == 0.0:
        return ("-", "-", "-")
    hertz, ratio = value.imag / (2.0 * np.pi), -value.real / value.imag
    return (f"{hertz:.3g}", f"{value.real:+.3g}", f"{ratio:+.3g}")


def _exact(dataset: "xarray.Dataset", name: str) -> Any:
    """Return lifts of the first case, those within round-off of the weight as zero."""
    values, share = dataset[name].values[0], dataset["lift_share"].values[0]
    return np.where(np.abs(share) < _ROUND_OFF, 0.0, values)


def _three_decimals(value: float) -> str:
    """Return a number without the sign that rounding leaves on zero."""
    return f"{round(value, 3) + 0.0:.3f}"


def _percent(share: float) -> str:
    return f"{round(share, 3) + 0.0:.1%}"


def _speed(dataset: "xarray.Dataset", index: int) -> str:
    return f"{float(dataset['speed'][index]):.3g}"


def write_aircraft_csv(dataset: "xarray.Dataset", folder: Path) -> None:
    """Write ``trim.csv``, and of one aircraft ``motions.csv`` and ``clamped_flutter_points.csv``.

    The trim of one aircraft has a line for each airspeed and surface, that of a sweep one for each
    case and surface.
    """
    angles = fold_angle_names(dataset)
    if "surface_lift_coefficient" not in dataset:
        heads = ("case", *angles, "slowest_speed", "surface", "lift", "share")
        write_table(folder / "trim.csv", heads, _case_lines(dataset))
        return
    heads = ("speed", "surface", "lift", "share", "lift_coefficient", "angle_of_attack")
    write_table(folder / "trim.csv", heads, _speed_lines(dataset))
    heads = ("speed", "motion", "growth", "frequency", "damping")
    write_table(folder / "motions.csv", heads, _motion_lines(dataset))
    rows = clamped_rows(dataset)
    if rows is not None:
        lines = ((*row.fold, *(_field(row, name) for name in _CLAMPED_COLUMNS)) for row in rows)
        heads = (*angles, *_CLAMPED_COLUMNS)
        write_table(folder / "clamped_flutter_points.csv", heads, lines)


def _field(row: FlutterRow, column: str) -> Any:
    return getattr(row, "classification" if column == "class" else column)


def _case_lines(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    angles = [dataset[name].values.tolist() for name in fold_angle_names(dataset)]
    lift, share = dataset["surface_lift"].values, dataset["lift_share"].values
    slowest = dataset["slowest_speed"].values.tolist()
    for case in range(dataset.sizes["fold"]):
        fold = (angle[case] for angle in angles)
        first = (case, *fold, slowest[case])
        for index, name in enumerate(dataset["surface"].values.tolist()):
            yield (*first, name, float(lift[case, index]), float(share[case, index]))


def _speed_lines(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    names = dataset["surface"].values.tolist()
    lift, share = dataset["surface_lift"].values[0], dataset["lift_share"].values[0]
    coefficient = dataset["surface_lift_coefficient"].values[0]
    wing, tail = (dataset[name].values[0] for name in ("trim_angle", "trim_tail_angle"))
    for at, speed in enumerate(dataset["speed"].values.tolist()):
        for index, name in enumerate(names):
            angle = tail[at] if name == "tail" else wing[at]
            numbers = (lift[index], share[index], coefficient[at, index], angle)
            yield (speed, name, *(float(number) for number in numbers))


def _motion_lines(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    columns = [dataset[name].values[0] for name in ("growth", "frequency", "damping")]
    for at, speed in enumerate(dataset["speed"].values.tolist()):
        for name, place in motions_found(dataset).items():
            numbers = [float(column[at, place]) for column in columns]
            if np.isfinite(numbers[0]):
                yield (speed, name, *numbers)
