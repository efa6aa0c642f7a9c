"""How flutter points look in every picture: filled onset, hollow recovery, square, diamond."""

import math
from collections.abc import Sequence

import numpy as np

from foldwing.plots.picture import Marks, Symbol
from foldwing.results.flutter_table import FlutterRow
from foldwing.results.units import SI, Units
from foldwing.stability.status import ELASTIC

_SYMBOLS: dict[tuple[str, str], Symbol] = {
    ("flutter", "onset"): "circle",
    ("flutter", "recovery"): "circle-open",
    ("divergence", "onset"): "square",
    ("divergence", "recovery"): "square-open",
    ("divergence", "merger"): "diamond",
}

Group = tuple[str, str, str, str, Symbol]
"""Kind, event, label, colour and symbol of points that look alike."""

_WORDS = {
    ("flutter", "onset"): "flutter begins",
    ("flutter", "recovery"): "flutter ends",
    ("divergence", "onset"): "divergence begins",
    ("divergence", "recovery"): "divergence ends",
    ("divergence", "merger"): "flutter turns into divergence (merger)",
}


_TURNS: Symbol = "triangle-down"
"""Where a motion of an aircraft as a whole turns into divergence."""


def short_words(row: FlutterRow) -> str:
    """Return what happens at a flutter point in two words, for a legend tells more."""
    return "merger" if row.event == "merger" else words(row)


def words(row: FlutterRow) -> str:
    """Return what happens at a flutter point, e.g. ``flutter begins``.

    A motion of an aircraft as a whole that grows is no flutter.
    """
    if row.as_a_whole:
        does = "ceases" if row.event == "recovery" else "begins"
        return f"{row.motion} {does} to grow"
    if row.motion != ELASTIC and row.event == "merger":
        return f"{row.motion} turns into divergence (merger)"
    return _WORDS.get((row.kind, row.event), f"{row.kind} {row.event}")


def symbol_of(row: FlutterRow) -> Symbol:
    """Return the symbol of a flutter point."""
    if row.event == "merger" and row.motion != ELASTIC:
        return _TURNS
    return _SYMBOLS.get((row.kind, row.event), "x")


def color_of(row: FlutterRow, colors: dict[str, str]) -> str:
    """Return the colour role: of the mode for an oscillation, its own for divergence."""
    return colors.get(row.mode_name, "ink") if row.kind == "flutter" else "divergence"


def hover_text(row: FlutterRow, units: Units = SI) -> str:
    """Return all that is known about a point, for hovering."""
    parts = [f"<b>{words(row)}</b>", f"{row.speed:.4g} {units.speed}"]
    if row.kind == "flutter":
        parts += [f"{row.frequency:.4g} {units.frequency}"]
        parts += [f"mode {row.mode_name}"] if not row.as_a_whole else []
        parts += [row.classification] if row.classification else []
        if math.isfinite(row.strength):
            parts.append(f"strength {row.strength:.3g} {units.strength}")
    return "<br>".join(parts)


def event_marks(
    rows: Sequence[FlutterRow],
    x: Sequence[float],
    y: Sequence[float],
    colors: dict[str, str],
    by_mode: bool = False,
    units: Units = SI,
) -> list[Marks]:
    """Return the marks of flutter points at (x, y), one group for each entry of the legend.

    Parameters
    ----------
    rows : sequence of FlutterRow
    x, y : sequence of float
        Where each point stands.
    colors : dict
        Colour role of each mode name.
    by_mode : bool
        Whether the legend names the modes.
    units : Units
        Of the rows, for hovering.
    """
    groups: dict[Group, list[int]] = {}
    for index, row in enumerate(rows):
        label = words(row)
        if by_mode and row.kind == "flutter" and not row.as_a_whole:
            label += f", mode {row.mode_name}"
        key = (row.kind, row.event, label, color_of(row, colors), symbol_of(row))
        groups.setdefault(key, []).append(index)
    return [
        Marks(
            np.array([x[index] for index in members], float),
            np.array([y[index] for index in members], float),
            symbol,
            color,
            label,
            6.5,
            [hover_text(rows[index], units) for index in members],
        )
        for (_, _, label, color, symbol), members in sorted(groups.items(), key=_legend_order)
    ]


def _legend_order(group: tuple[Group, list[int]]) -> tuple[bool, str, str]:
    kind, event, label, *_ = group[0]
    return kind != "flutter", label.rpartition("mode ")[2], event
