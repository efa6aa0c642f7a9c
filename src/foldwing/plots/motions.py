"""Phugoid and short period of an aircraft against airspeed, the slow one magnified."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.branches import Branches, branches_of, leaving, lines, rule_labels, rules
from foldwing.plots.events import event_marks
from foldwing.plots.layout import subtitle
from foldwing.plots.level_flight import slowest
from foldwing.plots.picture import Array, Item, Note, Panel, Picture, Range, Rule, padded
from foldwing.results.aircraft_table import MOTIONS, motions_found
from foldwing.results.cases import fold_text
from foldwing.results.flutter_table import FlutterRow

if TYPE_CHECKING:
    import xarray

_LABEL = "airspeed (m/s)"
_QUANTITIES = (("frequency (Hz)", "frequency"), ("growth rate (1/s)", "growth"))
_INCHES = 2.6
_ROOM = 1.0
"""Room above and below the curve of the phugoid, in heights of it."""


def motions(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the motions as a whole: the phugoid on the left in its own scale, all on the right."""
    found = motions_found(dataset)
    if not found or dataset.sizes["speed"] < 2:
        return None
    if not np.isfinite(dataset["growth"].values[0][:, list(found.values())]).any():
        return None
    every = branches_of(dataset)
    names = [name for name in MOTIONS if name in found]
    columns = [
        _phugoid(every, found) if "phugoid" in found else None,
        _all(every, found),
    ]
    shown = [column for column in columns if column is not None]
    if len(shown) > 1:
        shown[1] = [replace(panel, y_label="") for panel in shown[1]]  # names stand there
    panels = [panel for row in zip(*shown, strict=True) for panel in row]
    magnified = (
        " Left the phugoid, magnified; where its frequency falls to zero it turns into two real "
        "roots (D), which grow without oscillating: divergence. Right all of them with the first "
        "mode of vibration, in one scale."
        if len(shown) > 1
        else ""
    )
    return Picture(
        "motions",
        f"How the aircraft moves as a whole: {' and '.join(names)}",
        f"{subtitle(dataset, fold_text(dataset, 0))}.{magnified}{_since(dataset)}",
        panels,
        columns=len(shown),
        right_margin=1.05,
    )


def _since(dataset: "xarray.Dataset") -> str:
    """Return from which airspeed on the aircraft can carry its weight."""
    end = slowest(dataset)
    if end < float(dataset["speed"][-1]):
        return f" Shown from the slowest level flight, {end:.3g} m/s, on."
    return f" The aircraft can carry its weight only from {end:.3g} m/s on: at none of these."


def _across(every: Branches, found: dict[str, int]) -> Range:
    """Return the airspeeds from the first at which a motion is known."""
    known = np.isfinite(every.growth[:, list(found.values())]).any(axis=1)
    return float(every.speed[int(np.argmax(known))]), every.limits[1]


def _phugoid(every: Branches, found: dict[str, int]) -> list[Panel]:
    places = [found["phugoid"], *_real(every)]
    side = every.taken(places)
    own = [row for row in every.rows if _is_phugoid(row)]
    side = Branches(side.speed, side.growth, side.frequency, side.names, own, side.colors)
    limits = _across(every, found)
    panels = []
    for label, quantity in _QUANTITIES:
        values = getattr(side, quantity)
        y_range = _magnified(values[:, 0])
        items: list[Item] = [Rule(0.0, "y", "ink", width=1.2)]
        named = lines(side, values, y_range, quantity)
        items += [i for i in named if not isinstance(i, Note) or i.text != "phugoid"]
        items += leaving(side, values, y_range)
        items += rules(side)
        items += _marks(side) if quantity == "frequency" else []
        items += rule_labels(side, y_range[0], _INCHES) if quantity == "growth" else []
        title = "phugoid, magnified" if quantity == "frequency" else ""
        panels.append(Panel(_LABEL, label, items, limits, y_range, title=title, height=1.15))
    return panels


def _is_phugoid(row: FlutterRow) -> bool:
    return row.motion == "phugoid"


def _real(every: Branches) -> list[int]:
    return [place for place, name in enumerate(every.names) if name.startswith("D")]


def _magnified(values: Array) -> Range:
    """Return a range that holds zero and all values, with room for what becomes of them."""
    low, high = padded(np.append(values, 0.0), 0.12)
    if high <= 0.12 * (high - low):
        return low, high
    return low, high + _ROOM * (high - low)


def _marks(side: Branches) -> list[Item]:
    at = [row.speed for row in side.rows], [row.frequency for row in side.rows]
    return list(event_marks(side.rows, *at, side.colors))


def _all(every: Branches, found: dict[str, int]) -> list[Panel]:
    first = [place for place, name in enumerate(every.names) if name == "B1"]
    side = every.taken([*first, *found.values(), *_real(every)])
    side = Branches(side.speed, side.growth, side.frequency, side.names, [], side.colors)
    limits = _across(every, found)
    seen = side.speed >= limits[0]
    panels = []
    for label, quantity in _QUANTITIES:
        values = getattr(side, quantity)
        y_range = padded(np.append(values[seen].ravel(), 0.0), 0.06)
        items = [Rule(0.0, "y", "ink", width=1.2), *lines(side, values, y_range, quantity)]
        title = "beside the first mode of vibration" if quantity == "frequency" else ""
        panels.append(Panel(_LABEL, label, items, limits, y_range, title=title, height=1.15))
    return panels
