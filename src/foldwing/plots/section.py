"""The flutter boundary of a section against its torsion frequency, its changes marked."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.events import event_marks
from foldwing.plots.layout import PANEL_INCHES, subtitle
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import Array, Item, Line, Marks, Note, Panel, Picture, Rule, padded
from foldwing.plots.placing import Box, Paper, along_rule, clearest
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.summary import critical_row, failed_cases, uncertified_cases
from foldwing.results.units import units_of

if TYPE_CHECKING:
    import xarray

_MANY = 30
"""Cases from which on marks are small."""

_WIDTH, _HIGH = 6.77, 1.3
"""Width of a panel in inches and relative height of the upper one."""

_ROOM = 1.15
"""Height of the panels over the highest of what is always shown."""


def section_boundary(dataset: "xarray.Dataset") -> Picture | None:
    """Draw flutter speed and frequency of a section against its torsion frequency ratio."""
    if dataset.attrs["kind"] != "section" or dataset.sizes["fold"] < 2:
        return None
    x_range = padded(dataset["torsion_frequency_ratio"].values, 0.02)
    units, label = units_of(dataset), "torsion frequency ratio ωα/ω₁"
    top, highest = _top_speed(dataset), _top_frequency(dataset)
    speed: list[Item] = [
        *_in_tune(dataset),
        *_curves(dataset, "speed"),
        *_points(dataset, "speed", top),
        *_changes(dataset, "speed"),
        *_doubts(dataset, top),
    ]
    frequency: list[Item] = [
        *_in_tune(dataset),
        *_at_rest(dataset),
        *_curves(dataset, "frequency"),
        *_points(dataset, "frequency", highest),
        *_changes(dataset, "frequency"),
    ]
    tuned = [(at, f"in tune {at:.4g}") for at in _crossings(dataset)]
    ranges = (0.0, top), (-0.03 * highest, highest)
    above, below = (
        Paper(x_range, y_range, _WIDTH, height * PANEL_INCHES)
        for y_range, height in zip(ranges, (_HIGH, 1.0), strict=True)
    )
    speed += _beside(_change_words(dataset), speed, above, "warning")
    frequency += _beside(tuned, frequency, below, "muted")
    return Picture(
        "section-boundary",
        "The airspeeds at which the section becomes unstable",
        f"{subtitle(dataset)}. Lines: flutter and divergence, followed through the torsion "
        "frequency. Dotted upright: pitch and a plunge mode, each alone, are in tune at rest.",
        [
            Panel(label, units.speed_label, speed, x_range, ranges[0], height=_HIGH),
            Panel(label, f"flutter {units.frequency_label}", frequency, x_range, ranges[1]),
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


def _crossings(dataset: "xarray.Dataset") -> list[float]:
    """Return where pitch alone has the frequency of a plunge mode alone."""
    low, high = padded(dataset["torsion_frequency_ratio"].values, 0.02)
    return [at for at in dataset["crossing_torsion_ratio"].values.tolist() if low < at < high]


def _in_tune(dataset: "xarray.Dataset") -> list[Item]:
    return [Rule(at, "x", "muted", "dot", 1.4) for at in _crossings(dataset)]


def _beside(
    texts: Sequence[tuple[float, str]], items: Sequence[Item], paper: Paper, color: str
) -> list[Note]:
    """Return texts beside the rules they belong to, as high as they cover nothing."""
    lines = [paper.along(item.x, item.y) for item in items if isinstance(item, Line)]
    marks = [paper.rims(item.x, item.y) for item in items if isinstance(item, Marks)]
    points = np.concatenate([np.empty((0, 2)), *lines, *marks])
    taken: list[Box] = []
    notes = []
    for at, text in texts:
        boxes = along_rule(float(paper.inches(np.array(at), np.zeros(()))[0]), text, paper)
        left, bottom, right, top = boxes[clearest(boxes, points, taken, paper)]
        taken.append((left, bottom, right, top))
        x, y = paper.values((left, (bottom + top) / 2.0))
        notes.append(Note(x, y, text, color, "left", bold=True))
    return notes


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


def _change_words(dataset: "xarray.Dataset") -> list[tuple[float, str]]:
    """Return where the lowest onset goes over to another curve, and how."""
    if "change" not in dataset.sizes:
        return []
    at = dataset["change_torsion_ratio"].values.tolist()
    kinds = dataset["change_kind"].values.tolist()
    return [(x, f"{kind} {x:.5g}") for x, kind in zip(at, kinds, strict=True)]


def _changes(dataset: "xarray.Dataset", quantity: str) -> Iterator[Item]:
    """Mark where the lowest onset goes over to another curve."""
    for change in range(dataset.sizes.get("change", 0)):
        at = float(dataset["change_torsion_ratio"][change])
        ends = dataset[f"change_{quantity}"].values[change]
        yield Rule(at, "x", "warning", "dash", 1.2)
        if np.isfinite(ends).all():
            both: Array = np.array([at, at])
            yield Line(both, ends, "warning", width=2.4, name="change of the lowest onset")
            yield Marks(both, ends, "ring", "warning", "the lowest onset changes", 10.0)


def _doubts(dataset: "xarray.Dataset", top: float) -> Iterator[Item]:
    x = dataset["torsion_frequency_ratio"].values
    for cases, color, label in (
        (failed_cases(dataset), "muted", "computation failed"),
        (uncertified_cases(dataset), "warning", "case not certified: may be incomplete"),
    ):
        if cases:
            yield Marks(x[cases], np.full(len(cases), 0.03 * top), "x", color, label, 8)
