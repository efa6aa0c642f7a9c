"""How the airspeeds of flutter points settle as the computation is made finer."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.events import symbol_of, words
from foldwing.plots.layout import subtitle
from foldwing.plots.palette import SERIES
from foldwing.plots.picture import (
    Area,
    Array,
    Item,
    Line,
    Marks,
    Panel,
    Picture,
    Range,
    Rule,
    padded,
)
from foldwing.results.cases import fold_text
from foldwing.results.convergence_table import TARGET, TITLES, Levels, levels_by_setting
from foldwing.results.flutter_table import FlutterRow, flutter_rows

if TYPE_CHECKING:
    import xarray

_LEAST, _MOST = 1.5, 6.0
"""Per cent that a panel shows at least, and at most where points stray far."""


def convergence(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the airspeeds relative to their limits against each setting."""
    if dataset.attrs["kind"] != "convergence" or not dataset.sizes["flutter_point"]:
        return None
    rows = flutter_rows(dataset)
    panels = [_panel(one, rows) for one in levels_by_setting(dataset)]
    return Picture(
        "convergence",
        "How the flutter speeds settle as the computation is made finer",
        subtitle(dataset, fold_text(dataset, 0)) + ". Each point relative to its extrapolated "
        f"airspeed, or to the finest where there is no order; shaded: within {100 * TARGET:g} %; "
        "dashed: the model's own setting. One setting varies at a time.",
        panels,
        columns=2 if len(panels) > 1 else 1,
    )


def _panel(one: Levels, rows: list[FlutterRow]) -> Panel:
    limit = np.where(np.isnan(one.limit), one.speed[-1], one.limit)
    relative = 100.0 * (one.speed / limit - 1.0)
    x = one.values
    log = bool(x[0] > 0.0)
    x_range = (float(x[0]) / 1.12, float(x[-1]) * 1.12)
    if not log:
        x_range = (-0.05 * float(x[-1]), 1.05 * float(x[-1]))
    own: list[Item] = [Rule(float(at), "x", dash="dash") for at in x[one.own]]
    return Panel(
        TITLES[one.setting],
        "airspeed off its limit (%)",
        [_band(x_range), *own, Rule(0.0, "y"), *_curves(x, relative, one, rows)],
        x_range,
        _range(relative, relative[one.own]),
        height=0.8,
        log_x=log,
        x_ticks=[(float(value), f"{value:g}") for value in x],
    )


def _band(x_range: Range) -> Area:
    low, high = x_range
    band = 100.0 * TARGET
    x = np.array([low, high, high, low, low])
    y = np.array([-band, -band, band, band, -band])
    return Area(x, y, "series2", 0.13, f"within {100 * TARGET:g} %")


def _range(relative: Array, own: Array) -> Range:
    """Return limits that show the model's own setting whole, and others unless they stray far."""
    low, high = padded(relative)
    least, most = padded(own)
    return (
        min(max(low, -_MOST), least, -_LEAST),
        max(min(high, _MOST), most, _LEAST),
    )


def _curves(x: Array, relative: Array, one: Levels, rows: list[FlutterRow]) -> list[Item]:
    items: list[Item] = []
    for point, row in enumerate(rows):
        color = f"series{point % SERIES}" if row.kind == "flutter" else "divergence"
        mode = f" ({row.mode_name})" if row.kind == "flutter" else ""
        label = f"{words(row)}, {row.speed:.3g} m/s{mode}"
        y = relative[:, point]
        hover = [
            f"<b>{label}</b><br>{value:g}: {speed:.5g} m/s, {off:+.2f} %"
            for value, speed, off in zip(x, one.speed[:, point], y, strict=True)
        ]
        items.append(Line(x, y, color, width=1.4, name=label))
        items.append(Marks(x, y, symbol_of(row), color, label, 5.5, hover))
    return items
