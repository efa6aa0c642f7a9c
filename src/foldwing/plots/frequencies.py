"""Natural frequencies: against the fold angle, or as bars at a single one."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import dash_of, end_labels, subject, subtitle, sweep
from foldwing.plots.palette import SERIES, mode_colors
from foldwing.plots.picture import (
    Array,
    Bars,
    Item,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Range,
    padded,
)
from foldwing.results.cases import fold_text

if TYPE_CHECKING:
    import xarray

_LOG_FROM = 25.0
"""Ratio of highest to lowest frequency from which the axis is logarithmic."""
_DOUBTFUL = 0.5


def natural_frequencies(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the natural frequencies; None when there are none or cases form a grid."""
    if "natural_frequency" not in dataset:
        return None
    if not np.isfinite(dataset["natural_frequency"].values).any():
        return None
    if dataset.sizes["fold"] == 1:
        return _bars(dataset)
    return _against_fold(dataset) if sweep(dataset).single else None


def _against_fold(dataset: "xarray.Dataset") -> Picture:
    swept = sweep(dataset)
    order, x = swept.order, swept.values[swept.order]
    frequency = dataset["natural_frequency"].values[order]
    names, colors = dataset["mode_name"].values[order], mode_colors(dataset)
    measured = _measured(dataset)
    everything = np.concatenate([frequency.ravel(), *(mark.y for mark in measured)])
    y_range, log_y = _range(everything)
    ends: list[tuple[float, str, str]] = []
    items: list[Item] = []
    for mode in range(frequency.shape[1]):
        finite = np.flatnonzero(np.isfinite(frequency[:, mode]))
        if not finite.size or not frequency[finite, mode].any():
            continue
        name = str(names[finite[-1], mode])
        color = colors.get(name, f"series{mode % SERIES}")
        items.append(Line(x, frequency[:, mode], color, dash_of(name), 1.8, name=f"mode {name}"))
        ends.append((float(frequency[finite[-1], mode]), name, color))
    labels = end_labels(ends, float(x[-1]), y_range, log_y, height=1.7)
    panel = Panel(
        swept.label,
        "natural frequency (Hz)",
        [*items, *_doubtful(dataset, x, order), *measured, *labels, *_free(dataset, x, y_range)],
        (float(x[0]), float(x[-1])),
        y_range,
        log_y,
        y_ticks=_log_ticks(y_range) if log_y else None,
        height=1.7,
    )
    return Picture(
        "natural-frequencies",
        f"Natural frequencies of the {subject(dataset)} in still air as it folds",
        subtitle(dataset, swept.rest) + ". Each line follows one mode of vibration through "
        "crossings; its name stands at its end (B bending, T twisting; dashed lines twist).",
        [panel],
        right_margin=0.6,
    )


def _free(dataset: "xarray.Dataset", x: Array, y_range: Range) -> list[Note]:
    """Name the motions at which nothing pulls: their frequency is zero, out of a log axis."""
    frequency = dataset["natural_frequency"].values
    known = np.isfinite(frequency).any(axis=0)
    zero = known & (np.nan_to_num(frequency) == 0.0).all(axis=0)
    if not zero.any():
        return []
    case = int(np.argmax(np.isfinite(frequency).any(axis=1)))
    names = ", ".join(str(name) for name in dataset["mode_name"].values[case][zero])
    text = f"{names}: 0 Hz (nothing pulls back)"
    return [Note(float(x[0]), y_range[0], text, "muted", "left", "bottom", 5, 5)]


def _range(frequency: Array) -> tuple[Range, bool]:
    positive = frequency[np.isfinite(frequency) & (frequency > 0)]
    if positive.size and positive.max() / positive.min() > _LOG_FROM:
        return (float(positive.min()) * 0.7, float(positive.max()) * 1.15), True
    return (0.0, padded(frequency)[1]), False


def _log_ticks(limits: Range) -> list[tuple[float, str]]:
    decades = np.arange(np.floor(np.log10(limits[0])), np.ceil(np.log10(limits[1])) + 1)
    ticks = [base * 10.0**decade for decade in decades for base in (1, 2, 5)]
    return [(tick, f"{tick:g}") for tick in ticks if limits[0] <= tick <= limits[1]]


def _measured(dataset: "xarray.Dataset") -> list[Marks]:
    """Measured natural frequencies (those of a boundary are flutter frequencies)."""
    if "measured_frequency" not in dataset or dataset.attrs["kind"] != "modes":
        return []
    x, y = dataset["measured_fold"].values, dataset["measured_frequency"].values
    hover = [f"measured: {value:.4g} Hz" for value in y]
    return [Marks(x, y, "star", "ink", "measured", 8, hover)]


def _doubtful(dataset: "xarray.Dataset", x: Array, order: Array) -> list[Marks]:
    """Mark where a mode could not be told from its neighbour."""
    if "mode_confidence" not in dataset:
        return []
    confidence = dataset["mode_confidence"].values[order]
    case, mode = np.nonzero(confidence < _DOUBTFUL)
    if not case.size:
        return []
    y = dataset["natural_frequency"].values[order][case, mode]
    hover = [f"likeness {value:.2f}" for value in confidence[case, mode]]
    return [Marks(x[case], y, "x", "warning", "mode followed with doubt (MAC < 0.5)", 6, hover)]


def _bars(dataset: "xarray.Dataset") -> Picture:
    frequency = dataset["natural_frequency"].values[0]
    kept = np.flatnonzero(np.isfinite(frequency))[:12]
    frequency, row = frequency[kept], -np.arange(len(kept), dtype=float)
    names = dataset["mode_name"].values[0][kept]
    high = 1.12 * float(frequency.max())
    notes = [
        Note(float(f), float(y), f"{f:.4g} Hz", dx=5) for f, y in zip(frequency, row, strict=True)
    ]
    panel = Panel(
        "natural frequency (Hz)",
        "mode",
        [*_shares(dataset, kept, frequency, row), *notes],
        (0.0, high),
        (-len(kept) + 0.4, 0.6),
        y_ticks=[(float(y), str(name)) for y, name in zip(row, names, strict=True)],
        height=max(0.8, 0.14 * len(kept) + 0.2),
    )
    caption = subtitle(dataset, fold_text(dataset, 0)) + ". One bar for each mode of vibration"
    split = ", divided by how much the mode bends and how much it twists"
    return Picture(
        "natural-frequencies",
        f"Natural frequencies of the {subject(dataset)} in still air",
        f"{caption}{split if 'bending_share' in dataset else ''}.",
        [panel],
    )


def _shares(dataset: "xarray.Dataset", kept: Array, frequency: Array, row: Array) -> list[Bars]:
    zero = np.zeros_like(frequency)
    if "bending_share" not in dataset:
        return [Bars(row, zero, frequency, "series0")]
    bending = np.nan_to_num(dataset["bending_share"].values[0][kept], nan=1.0) * frequency
    return [
        Bars(row, zero, bending, "series0", "share of bending"),
        Bars(row, bending, frequency - bending, "series1", "share of twisting"),
    ]
