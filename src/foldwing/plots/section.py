"""The flutter boundary of a section against its torsion frequency, its changes marked."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from foldwing.plots.events import event_marks
from foldwing.plots.layout import subtitle
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import Array, Item, Line, Marks, Note, Panel, Picture, Rule, padded
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.summary import critical_row, failed_cases, uncertified_cases
from foldwing.results.units import units_of

if TYPE_CHECKING:
    import xarray

_MANY = 30
"""Cases from which on marks are small."""

_ROOM = 1.15
"""Height of the panels over the highest of what is always shown."""


def section_boundary(dataset: "xarray.Dataset") -> Picture | None:
    """Draw flutter speed and frequency of a section against its torsion frequency ratio."""
    if dataset.attrs["kind"] != "section" or dataset.sizes["fold"] < 2:
        return None
    x_range = padded(dataset["torsion_frequency_ratio"].values, 0.02)
    units, label = units_of(dataset), "torsion frequency ratio ωα/ω₁"
    top, highest = _top_speed(dataset), _top_frequency(dataset)
    speed = [
        *_crossings(dataset, None),
        *_curves(dataset, "speed"),
        *_points(dataset, "speed", top),
        *_changes(dataset, "speed", top),
        *_doubts(dataset, top),
    ]
    frequency = [
        *_crossings(dataset, highest),
        *_at_rest(dataset),
        *_curves(dataset, "frequency"),
        *_points(dataset, "frequency", highest),
        *_changes(dataset, "frequency", None),
    ]
    return Picture(
        "section-boundary",
        "The airspeeds at which the section becomes unstable",
        f"{subtitle(dataset)}. Lines: flutter and divergence, followed through the torsion "
        "frequency. Dotted upright: pitch and a plunge mode, each alone, are in tune at rest.",
        [
            Panel(label, units.speed_label, speed, x_range, (0.0, top), height=1.3),
            Panel(
                label,
                f"flutter {units.frequency_label}",
                frequency,
                x_range,
                (-0.03 * highest, highest),
            ),
        ],
    )


def _top_speed(dataset: "xarray.Dataset") -> float:
    """Return a height that holds the lowest onset of every case, not all that lies above."""
    values = [row.speed for row in _lowest(dataset)]
    return _ROOM * max(values, default=float(dataset.attrs["speed_limit"]))


def _top_frequency(dataset: "xarray.Dataset") -> float:
    values = [row.frequency for row in flutter_rows(dataset)]
    values += [float(value) for value in np.ravel(dataset["natural_frequency"].values)]
    return _ROOM * max(values)


def _lowest(dataset: "xarray.Dataset") -> list[FlutterRow]:
    by_case: dict[int, list[FlutterRow]] = {}
    for row in flutter_rows(dataset):
        by_case.setdefault(row.case, []).append(row)
    lowest = (critical_row(rows) for rows in by_case.values())
    return [row for row in lowest if row is not None]


def _crossings(dataset: "xarray.Dataset", top: float | None) -> Iterator[Item]:
    """Mark where pitch alone has the frequency of a plunge mode alone; names at ``top``."""
    low, high = padded(dataset["torsion_frequency_ratio"].values, 0.02)
    shown = [at for at in dataset["crossing_torsion_ratio"].values.tolist() if low < at < high]
    for line, at in enumerate(shown):
        yield Rule(at, "x", "muted", "dot", 1.4)
        if top is not None:
            yield _beside(dataset, (at, top), line, f"in tune {at:.4g}", "muted")


def _beside(
    dataset: "xarray.Dataset", point: tuple[float, float], line: int, text: str, color: str
) -> Note:
    """Return a text below the top of a panel, beside a rule, each on a line of its own."""
    low, high = padded(dataset["torsion_frequency_ratio"].values, 0.02)
    right = point[0] - low > 0.7 * (high - low)
    anchor: Literal["left", "right"] = "right" if right else "left"
    return Note(*point, text, color, anchor, "top", -5 if right else 5, -4 - 14 * line, bold=True)


def _at_rest(dataset: "xarray.Dataset") -> Iterator[Item]:
    x = dataset["torsion_frequency_ratio"].values
    values = dataset["natural_frequency"].values
    for mode in range(values.shape[1]):
        label = "natural frequencies at rest" if mode == 0 else ""
        yield Line(x, values[:, mode], "muted", "dash", 1.0, "natural frequency", label)


def _curves(dataset: "xarray.Dataset", quantity: str) -> Iterator[Item]:
    if "curve_id" not in dataset:
        return
    identity, kind = dataset["curve_id"].values, dataset["curve_kind"].values
    for curve in np.unique(identity):
        own = identity == curve
        diverging = str(kind[own][0]) == "divergence"
        if diverging and quantity != "speed":
            continue
        x, y = dataset["curve_torsion_ratio"].values[own], dataset[f"curve_{quantity}"].values[own]
        yield Line(x, y, "divergence" if diverging else "ink", width=1.1, name=str(kind[own][0]))


def _points(dataset: "xarray.Dataset", quantity: str, top: float) -> Iterator[Item]:
    rows = [
        row
        for row in flutter_rows(dataset)
        if getattr(row, quantity) <= top and (quantity == "speed" or row.kind == "flutter")
    ]
    many = dataset.sizes["fold"] > _MANY
    x = dataset["torsion_frequency_ratio"].values
    at = [float(x[row.case]) for row in rows]
    values = [float(getattr(row, quantity)) for row in rows]
    colors, units = mode_colors(dataset), units_of(dataset)
    for marks in event_marks(rows, at, values, colors, by_mode=True, units=units):
        yield replace(marks, size=4.0) if many else marks


def _changes(dataset: "xarray.Dataset", quantity: str, top: float | None) -> Iterator[Item]:
    """Mark where the lowest onset goes over to another curve; names at ``top``."""
    for change in range(dataset.sizes.get("change", 0)):
        at = float(dataset["change_torsion_ratio"][change])
        ends = dataset[f"change_{quantity}"].values[change]
        yield Rule(at, "x", "warning", "dash", 1.2)
        if np.isfinite(ends).all():
            both: Array = np.array([at, at])
            yield Line(both, ends, "warning", width=2.4, name="change of the lowest onset")
            yield Marks(both, ends, "ring", "warning", "the lowest onset changes", 10.0)
        if top is not None:
            text = f"{dataset['change_kind'].values[change]} {at:.5g}"
            yield _beside(dataset, (at, top), change, text, "warning")


def _doubts(dataset: "xarray.Dataset", top: float) -> Iterator[Item]:
    x = dataset["torsion_frequency_ratio"].values
    for cases, color, label in (
        (failed_cases(dataset), "muted", "computation failed"),
        (uncertified_cases(dataset), "warning", "case not certified: may be incomplete"),
    ):
        if cases:
            yield Marks(x[cases], np.full(len(cases), 0.03 * top), "x", color, label, 8)
