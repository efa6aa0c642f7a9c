"""Level flight of an aircraft: who carries the weight, and how steeply it flies."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import PANEL_INCHES, end_labels, subtitle, sweep
from foldwing.plots.level_flight import out_of_reach, slowest
from foldwing.plots.palette import SERIES
from foldwing.plots.picture import (
    Array,
    Bars,
    Dash,
    Item,
    Line,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    padded,
)
from foldwing.results.cases import fold_text

if TYPE_CHECKING:
    import xarray

_ROW_INCHES = 0.3
_DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
_NOTHING = 1e-9
"""Share of the weight that is round-off."""
_ROOM = 1.5
"""Highest lift coefficient shown over what one can be at most."""


def trim(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the share of every segment and of the tail in the weight: bars, or against the fold."""
    if "lift_share" not in dataset or not np.isfinite(dataset["lift_share"].values).any():
        return None
    title = "How much of the weight each segment and the tail carry in level flight"
    if dataset.sizes["fold"] == 1:
        caption = f"{subtitle(dataset, fold_text(dataset, 0))}. In percent of the weight, and in "
        caption += "newtons of the half aircraft; the same at every airspeed."
        return Picture("trim", title, caption, [_bars(dataset)])
    return _against_fold(dataset, title) if sweep(dataset).single else None


def _bars(dataset: "xarray.Dataset") -> Panel:
    share, lift = dataset["lift_share"].values[0], dataset["surface_lift"].values[0]
    names = [str(name) for name in dataset["surface"].values]
    place, percent = -np.arange(len(names), dtype=float), 100.0 * share
    low, high = min(float(percent.min()), 0.0), max(float(percent.max()), 0.0)
    room = 0.24 * (high - low)
    ends = [
        Note(max(float(value), 0.0), float(y), _amount(float(value), float(force)), dx=5)
        for value, force, y in zip(percent, lift, place, strict=True)
    ]
    bars = [
        Bars(place[i : i + 1], np.zeros(1), percent[i : i + 1], _color(dataset, i))
        for i in range(len(names))
    ]
    return Panel(
        "share of the weight (%)",
        "",
        [Rule(0.0, "x", "ink"), *bars, *ends],
        (low - (room if low < 0.0 else 0.0), high + room),
        (0.4 - len(names), 0.6),
        y_ticks=[(float(y), name) for y, name in zip(place, names, strict=True)],
        height=_ROW_INCHES * (len(names) + 0.2) / PANEL_INCHES,
    )


def _amount(percent: float, newton: float) -> str:
    if abs(percent) < 100.0 * _NOTHING:
        return "0"
    return f"{percent:.1f} %, {newton:.3g} N".replace("-", "−")


def _color(dataset: "xarray.Dataset", index: int) -> str:
    return "ink" if _is_tail(dataset, index) else f"series{index % SERIES}"


def _is_tail(dataset: "xarray.Dataset", index: int) -> bool:
    return str(dataset["surface"].values[index]) == "tail"


def _dash(dataset: "xarray.Dataset", index: int) -> Dash:
    return "dashdot" if _is_tail(dataset, index) else _DASHES[index % len(_DASHES)]


def _against_fold(dataset: "xarray.Dataset", title: str) -> Picture:
    swept = sweep(dataset)
    order, x = swept.order, swept.values[swept.order]
    percent = 100.0 * dataset["lift_share"].values[order]
    y_range = padded(np.append(percent.ravel(), 0.0))
    items: list[Item] = [Rule(0.0, "y", "ink")]
    items += _lines(dataset, x, percent, y_range, 1.4)
    panel = Panel(
        swept.label, "share of the weight (%)", items, (float(x[0]), float(x[-1])), y_range,
        height=1.4,
    )  # fmt: skip
    caption = f"{subtitle(dataset, swept.rest)}. The same at every airspeed."
    return Picture("trim", title, caption, [panel], right_margin=1.0)


def _lines(
    dataset: "xarray.Dataset", x: Array, values: Array, y_range: Range, height: float
) -> list[Item]:
    """Return one line for each surface, (x, surface), named at its end."""
    items: list[Item] = []
    ends = []
    for index, name in enumerate(dataset["surface"].values.tolist()):
        y, color = values[:, index], _color(dataset, index)
        items.append(Line(x, y, color, _dash(dataset, index), 1.8, name=name))
        finite = np.flatnonzero(np.isfinite(y))
        if finite.size:
            ends.append((float(y[finite[-1]]), name, color))
    return [*items, *end_labels(ends, float(x[-1]), y_range, height=height)]


def trim_against_speed(dataset: "xarray.Dataset") -> Picture | None:
    """Draw angles of attack and lift coefficients against airspeed."""
    if "trim_angle" not in dataset or dataset.sizes["speed"] < 2:
        return None
    speed = dataset["speed"].values
    limits = (float(speed[0]), float(speed[-1]))
    largest = float(dataset["slowest_speed"].attrs["lift_coefficient"])
    coefficient, angle = _coefficients(dataset, largest, limits), _angles(dataset, limits)
    end = slowest(dataset)
    return Picture(
        "trim-against-speed",
        f"Slower is steeper: below {end:.3g} m/s the aircraft cannot carry its weight",
        f"{subtitle(dataset, fold_text(dataset, 0))}. Lift coefficients are those of the normal "
        f"force on each surface. The slowest level flight is where the first of them reaches "
        f"{largest:g} (dotted).",
        [
            Panel("airspeed (m/s)", "lift coefficient", *coefficient, height=1.1),
            Panel("airspeed (m/s)", "angle of attack (degrees)", *angle, height=0.9),
        ],
        right_margin=1.0,
    )


def _coefficients(
    dataset: "xarray.Dataset", largest: float, limits: Range
) -> tuple[list[Item], Range, Range]:
    values, end = dataset["surface_lift_coefficient"].values[0], slowest(dataset)
    least = float(np.nanmin(values[dataset["speed"].values >= end], initial=0.0))
    top = max(_ROOM * largest, 1.2 * float(np.nanmax(values[-1])))
    y_range = (_ROOM * least - 0.04 * top, top)
    items = [
        *out_of_reach(dataset, limits, y_range),
        Rule(largest, "y", "ink", "dot", 1.4),
        Note(limits[1], largest, f"largest lift coefficient {largest:g}", "ink", "right", "bottom",
             -4, 3),
        *([Rule(-largest, "y", "ink", "dot", 1.4)] if y_range[0] < -largest else []),
        *_lines(dataset, dataset["speed"].values, values, y_range, 1.1),
    ]  # fmt: skip
    if limits[0] < end < limits[1]:
        text = f"slowest level flight {end:.3g} m/s"
        items.append(Note(end, y_range[1], text, "ink", "left", "top", 5, -4))
    return items, limits, y_range


def _angles(dataset: "xarray.Dataset", limits: Range) -> tuple[list[Item], Range, Range]:
    speed = dataset["speed"].values
    wing, tail = (dataset[name].values[0] for name in ("trim_angle", "trim_tail_angle"))
    apart = not np.array_equal(wing, tail, equal_nan=True)
    shown = [("wing", wing, "series0"), ("tail", tail, "ink")] if apart else [("", wing, "series0")]
    flying = speed >= min(slowest(dataset), float(speed[-1]))
    values = np.concatenate([angle[flying] for _, angle, _ in shown])
    low, high = min(float(np.nanmin(values)), 0.0), max(float(np.nanmax(values)), 0.0)
    y_range = (_ROOM * low - 0.04 * (high - low), _ROOM * high)
    items: list[Item] = [*out_of_reach(dataset, limits, y_range)]
    ends = []
    for name, angle, color in shown:
        dash: Dash = "dashdot" if name == "tail" else "solid"
        items.append(Line(speed, angle, color, dash, 1.8, name=name or "angle of attack"))
        ends.append((float(angle[-1]), name, color))
    return [*items, *end_labels(ends, limits[1], y_range, height=0.9)], limits, y_range
