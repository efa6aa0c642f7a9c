"""Eigenvalues against airspeed: growth and frequency below each other, and the root locus."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.events import color_of, event_marks, words
from foldwing.plots.layout import (
    body_of,
    dash_of,
    end_labels,
    focused,
    subtitle,
    threshold,
    upright_labels,
)
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import (
    Area,
    Array,
    Graded,
    Item,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    padded,
    spread,
)
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.summary import fold_text, unresolved_below
from foldwing.results.units import Units, units_of

if TYPE_CHECKING:
    import xarray

_PLOT_INCHES = 6.3
_PANEL_SHARE = 0.035
"""Distance of names in the root locus as a share of its height."""


def against_speed(dataset: "xarray.Dataset") -> Picture | None:
    """Draw growth rate and frequency of every branch against airspeed."""
    if not _has_loci(dataset):
        return None
    speed = dataset["speed"].values
    limits = _speed_range(speed)
    rows = _rows_shown(dataset)
    colors = mode_colors(dataset)
    growth, frequency = _visible(dataset, "growth"), _visible(dataset, "frequency")
    growth_range = focused(growth, 3.0)
    top = _highest_shown(frequency, rows)
    x = [row.speed for row in rows]
    resolved = _resolved_from(dataset, limits)
    upper = [
        *_unstable_above(limits, growth_range),
        *_branches(dataset, growth, growth_range, "growth"),
        *_rules(rows, colors),
        *resolved,
        *_threshold_marks(rows, colors, units_of(dataset)),
        *_rule_labels(rows, colors, limits, (growth_range[0], units_of(dataset).speed)),
    ]
    lower = [
        *_branches(dataset, frequency, (-0.03 * top, top), "frequency"),
        *_rules(rows, colors),
        *resolved,
        *event_marks(rows, x, [row.frequency for row in rows], colors, units=units_of(dataset)),
    ]
    units, body = units_of(dataset), body_of(dataset)
    label = units.speed_label
    return Picture(
        "growth-and-frequency",
        f"How the motions of the {body} grow or decay as the airspeed rises",
        subtitle(dataset, fold_text(dataset, 0)) + ". Above zero (shaded) a motion grows by "
        f"itself: the {body} is unstable. Vertical lines mark the exact speeds {_where(dataset)}."
        + (" Dotted: from here on the lattice resolves all modes." if resolved else ""),
        [
            Panel(label, units.growth_label, upper, limits, growth_range, height=1.1),
            Panel(label, units.frequency_label, lower, limits, (-0.03 * top, top), height=1.1),
        ],
        right_margin=0.6 if body == "wing" else 0.85,
    )


def _resolved_from(dataset: "xarray.Dataset", limits: Range) -> list[Item]:
    """Return a line at the airspeed from which all modes are resolved, if that is in view."""
    lowest = float(unresolved_below(dataset)[0])
    return [Rule(lowest, "x", "muted", "dot", 1.4)] if limits[0] < lowest < limits[1] else []


def _where(dataset: "xarray.Dataset") -> str:
    limit = threshold(dataset)
    if limit == 0.0:
        return "where that changes"
    return f"where a damping ratio passes {limit:g}".replace("-", "−")


def root_locus(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the paths of the eigenvalues in the plane of growth rate and frequency."""
    if not _has_loci(dataset):
        return None
    growth, frequency = _visible(dataset, "growth"), _visible(dataset, "frequency")
    x_range = focused(growth, 5.0)
    top = _highest_shown(frequency, _rows_shown(dataset))
    y_range = (-0.04 * top, top)
    tint = Area(
        np.array([0.0, x_range[1], x_range[1], 0.0]), np.repeat(y_range, 2), "unstable", 0.1
    )
    units = units_of(dataset)
    items: list[Item] = [tint, Rule(0.0, "x", "ink", width=1.2)]
    items += _paths(dataset, growth, frequency)
    items += _path_ends(dataset, (growth, frequency), x_range, top)
    items += _crossing_marks(dataset)
    items += [
        Note(x_range[1], top, "unstable", "unstable", "right", "top", -4, -4, bold=True),
        Note(0.0, top, "stable", "muted", "right", "top", -5, -4, bold=True),
    ]
    return Picture(
        "root-locus",
        "Flutter begins where a path crosses to the right of zero growth",
        subtitle(dataset, fold_text(dataset, 0)) + ". Each path is one motion (an eigenvalue) "
        "from the lowest airspeed (blue) to the highest (orange).",
        [Panel(units.growth_label, units.frequency_label, items, x_range, y_range, height=1.8)],
    )


def _has_loci(dataset: "xarray.Dataset") -> bool:
    return "growth" in dataset and bool(np.isfinite(dataset["growth"].values).any())


def _visible(dataset: "xarray.Dataset", name: str) -> Array:
    """Values of the first case, shape (speed, mode)."""
    return np.asarray(dataset[name].values[0], float)


def _speed_range(speed: Array) -> Range:
    return (float(speed[0]), float(speed[-1])) if len(speed) > 1 else padded(speed)


def _rows_shown(dataset: "xarray.Dataset") -> list[FlutterRow]:
    """Return the flutter points within the airspeeds of the curves."""
    low, high = _speed_range(dataset["speed"].values)
    return [row for row in flutter_rows(dataset) if low <= row.speed <= high]


def _highest_shown(frequency: Array, rows: list[FlutterRow]) -> float:
    """Return the frequency up to which branches are shown: those that flutter, and at least four.

    The highest modes, many times faster, would press the others flat.
    """
    finite = frequency[np.isfinite(frequency)]
    if not finite.size:
        return 1.0
    rows_with_values = np.flatnonzero(np.isfinite(frequency).any(axis=1))
    first = np.sort(frequency[rows_with_values[0]])
    fourth = float(first[min(3, int(np.isfinite(first).sum()) - 1)])
    flutter = max((row.frequency for row in rows), default=0.0)
    return min(1.15 * float(finite.max()), max(1.25 * fourth, 1.6 * flutter)) or 1.0


def _names(dataset: "xarray.Dataset") -> list[str]:
    return [str(name) for name in dataset["branch_name"].values]


def _unstable_above(limits: Range, growth_range: Range) -> list[Item]:
    x = np.array([limits[0], limits[1], limits[1], limits[0]])
    y = np.array([0.0, 0.0, growth_range[1], growth_range[1]])
    return [
        Area(x, y, "unstable", 0.1),
        Rule(0.0, "y", "ink", width=1.2),
        Note(limits[0], growth_range[1], "unstable", "unstable", "left", "top", 5, -4, bold=True),
        Note(limits[0], growth_range[0], "stable", "muted", "left", "bottom", 5, 4, bold=True),
    ]


def _branches(
    dataset: "xarray.Dataset", values: Array, y_range: Range, quantity: str
) -> list[Item]:
    speed, colors = dataset["speed"].values, mode_colors(dataset)
    items: list[Item] = []
    ends = []
    for branch, name in enumerate(_names(dataset)):
        y = values[:, branch]
        finite = np.flatnonzero(np.isfinite(y))
        if not finite.size:
            continue
        color = colors[name]
        items.append(Line(speed, y, color, dash_of(name), 1.8, name=f"{quantity} of {name}"))
        if finite[-1] == len(speed) - 1:
            ends.append((float(y[-1]), name, color))
    return items + list(end_labels(ends, float(speed[-1]), y_range, height=1.1))


def _rules(rows: list[FlutterRow], colors: dict[str, str]) -> list[Item]:
    return [Rule(row.speed, "x", color_of(row, colors), "dash", 0.9) for row in rows]


def _threshold_marks(rows: list[FlutterRow], colors: dict[str, str], units: Units) -> list[Marks]:
    """Return marks at zero growth, for the points that are reported there."""
    neutral = [row for row in rows if row.threshold == 0 and row.event != "merger"]
    speed = [row.speed for row in neutral]
    return event_marks(neutral, speed, [0.0] * len(neutral), colors, units=units)


def _rule_labels(
    rows: list[FlutterRow], colors: dict[str, str], limits: Range, foot: tuple[float, str]
) -> list[Note]:
    y, unit = foot
    events = [
        (
            row.speed,
            f"{words(row).partition(' (')[0]} {row.speed:.3g} {unit}",
            color_of(row, colors),
        )
        for row in rows
    ]
    return upright_labels(events, y, limits, _PLOT_INCHES)


def _paths(dataset: "xarray.Dataset", growth: Array, frequency: Array) -> list[Item]:
    speed = dataset["speed"].values
    limits, label = _speed_range(speed), units_of(dataset).speed_label
    return [
        Graded(growth[:, branch], frequency[:, branch], speed, limits, label, name)
        for branch, name in enumerate(_names(dataset))
        if np.isfinite(growth[:, branch]).any()
    ]


def _path_ends(
    dataset: "xarray.Dataset", paths: tuple[Array, Array], x_range: Range, highest: float
) -> list[Item]:
    """Mark the first and the last point of each path and name it where it comes into view."""
    growth, frequency = paths
    notes: list[Note] = []
    ends: tuple[list[tuple[float, float]], ...] = ([], [])
    for branch, name in enumerate(_names(dataset)):
        finite = np.flatnonzero(np.isfinite(growth[:, branch]))
        inside = (growth[:, branch] >= x_range[0]) & (growth[:, branch] <= x_range[1])
        inside &= frequency[:, branch] <= highest
        shown = np.flatnonzero(inside)
        if not shown.size:
            continue
        x, y = float(growth[shown[0], branch]), float(frequency[shown[0], branch])
        notes.append(Note(x, y, name, "ink", dx=7, dy=7, bold=True))
        for index, found in ((finite[0], ends[0]), (finite[-1], ends[1])):
            if inside[index]:
                found.append((float(growth[index, branch]), float(frequency[index, branch])))
    (x1, y1), (x2, y2) = (np.array(points).reshape(-1, 2).T for points in ends)
    return [
        Marks(x1, y1, "circle-open", "ink", "lowest airspeed", 5),
        Marks(x2, y2, "triangle", "ink", "highest airspeed", 6.5),
        *_apart(notes, _PANEL_SHARE * highest),
    ]


def _apart(notes: list[Note], gap: float) -> list[Note]:
    y = spread(np.array([note.y for note in notes]), gap)
    return [replace(note, y=float(at)) for note, at in zip(notes, y, strict=True)]


def _crossing_marks(dataset: "xarray.Dataset") -> list[Marks]:
    rows = [row for row in _rows_shown(dataset) if row.threshold == 0 and row.event != "merger"]
    zero = [0.0] * len(rows)
    frequency = [row.frequency for row in rows]
    return event_marks(rows, zero, frequency, mode_colors(dataset), units=units_of(dataset))
