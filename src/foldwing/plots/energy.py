"""Where the energy of flutter enters: the work of the air on segments, and between modes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import PANEL_INCHES, subject, subtitle, threshold
from foldwing.plots.picture import Array, Bars, Note, Panel, Picture, Rule
from foldwing.results.cases import fold_text
from foldwing.results.flutter_table import FlutterRow, flutter_rows

if TYPE_CHECKING:
    import xarray

_MOST_ONSETS = 3
_MOST_PAIRS = 8
_ROW_INCHES = 0.24
_NOTHING = 1e-6
"""Work in parts of the energy that is round-off."""
_X_LABEL = "work of the air over one cycle (% of the energy of the vibration)"

Entry = tuple[str, float]
"""Name of a bar and its length."""


def work_of_segments(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the work of the air on each segment at the lowest flutter onsets."""
    if "work" not in dataset or dataset.sizes["wing_segment"] < 2:
        return None
    energy, work = dataset["kinetic_energy"].values, dataset["work"].values
    tail = dataset["work"].attrs.get("tail")
    numbers = dataset["wing_segment"].values.tolist()
    names = ["tail" if number == tail else str(number) for number in numbers]
    groups = []
    for index, row in onsets(dataset)[:_MOST_ONSETS]:
        share = 100.0 * work[index] / energy[index]
        groups.append((row, [*zip(names, share, strict=True), ("all", float(share.sum()))]))
    balance = (
        f"The whole {subject(dataset)} (all) receives what the structure dissipates, which is "
        "nothing without structural damping."
    )
    return _picture(
        dataset,
        "flutter-energy",
        "Where flutter takes its energy from the air: work on each segment"
        + ("" if tail is None else " and the tail"),
        f"The row “all” is the whole {subject(dataset)}." if threshold(dataset) else balance,
        ("segment" if tail is None else "segment or tail", groups),
    )


def work_of_modes(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the largest works of the air between modes at the lowest flutter onsets."""
    if "work_between_modes" not in dataset:
        return None
    energy, work = dataset["kinetic_energy"].values, dataset["work_between_modes"].values
    names = dataset["mode_name"].values[0]
    groups = []
    for index, row in onsets(dataset)[:_MOST_ONSETS]:
        groups.append((row, _pairs(100.0 * work[index] / energy[index], names)))
    return _picture(
        dataset,
        "flutter-energy-modes",
        "How flutter takes its energy from the air: work between modes of vibration",
        "T1→B2: the force that the air exerts because of the motion in T1 works on the motion in "
        "B2; what a mode does to itself bears its name alone. Much work from one to the other "
        "and back shows which modes flutter together.",
        ("modes", groups),
    )


def onsets(dataset: "xarray.Dataset") -> list[tuple[int, FlutterRow]]:
    """Return the flutter onsets with their place along ``flutter_point``, the lowest first.

    Phugoid and short period of an aircraft do not count: they are no flutter.
    """
    rows = [entry for entry in enumerate(flutter_rows(dataset)) if not entry[1].as_a_whole]
    found = [entry for entry in rows if (entry[1].kind, entry[1].event) == ("flutter", "onset")]
    return sorted(found, key=lambda entry: entry[1].speed)


def in_words(row: FlutterRow) -> str:
    """Return a flutter onset in words."""
    return f"{row.speed:.3g} m/s, {row.frequency:.3g} Hz, mode {row.mode_name}"


def _pairs(share: Array, names: Array) -> list[Entry]:
    """Return the largest entries by pair of modes, and the sum of the others."""
    order = np.argsort(-np.abs(share), axis=None)
    moving, driving = np.unravel_index(order, share.shape)
    entries = [
        (str(names[i]) if i == j else f"{names[j]}→{names[i]}", float(share[i, j]))
        for i, j in zip(moving[:_MOST_PAIRS], driving[:_MOST_PAIRS], strict=True)
    ]
    rest = share[moving[_MOST_PAIRS:], driving[_MOST_PAIRS:]]
    return [*entries, ("others", float(rest.sum()))] if rest.size else entries


def _picture(
    dataset: "xarray.Dataset",
    name: str,
    title: str,
    reading: str,
    bars: tuple[str, Sequence[tuple[FlutterRow, list[Entry]]]],
) -> Picture | None:
    """Return one panel of bars below the other for each flutter onset; None without any."""
    y_label, groups = bars
    if not groups:
        return None
    values = np.array([value for _, entries in groups for _, value in entries])
    low, high = min(float(values.min()), 0.0), max(float(values.max()), 0.0)
    room = 0.17 * ((high - low) or 1.0)
    panels = [_panel(y_label, row, entries, (low - room, high + room)) for row, entries in groups]
    caption = f"{subtitle(dataset, fold_text(dataset, 0))}. {reading}"
    return Picture(name, title, caption, panels)


def _panel(
    y_label: str, row: FlutterRow, entries: list[Entry], limits: tuple[float, float]
) -> Panel:
    places = -np.arange(len(entries), dtype=float)
    values = np.array([value for _, value in entries])
    feeds, takes = values > 0.0, values <= 0.0
    bars = [
        Bars(places[which], np.zeros(int(which.sum())), values[which], color, label)
        for which, color, label in (
            (feeds, "unstable", "the air feeds the motion"),
            (takes, "series0", "the air damps the motion"),
        )
    ]
    heading = Note(limits[0], 1.0, in_words(row), dx=6, bold=True)
    ends = [_end(float(place), value) for place, (_, value) in zip(places, entries, strict=True)]
    return Panel(
        _X_LABEL,
        y_label,
        [Rule(0.0, "x", "ink"), *bars, heading, *ends],
        limits,
        (0.4 - len(entries), 1.6),
        y_ticks=[(float(y), name) for y, (name, _) in zip(places, entries, strict=True)],
        height=_ROW_INCHES * (len(entries) + 1.2) / PANEL_INCHES,
    )


def _end(place: float, value: float) -> Note:
    """Return the number at the end of a bar."""
    if abs(value) < 100.0 * _NOTHING:
        return Note(0.0, place, "0 %", dx=4)
    digits = f"{value:+.0f}" if abs(value) >= 100.0 else f"{value:+.2g}"
    text = f"{digits} %".replace("-", "−")
    if value > 0.0:
        return Note(value, place, text, dx=4)
    return Note(value, place, text, anchor="right", dx=-4)
