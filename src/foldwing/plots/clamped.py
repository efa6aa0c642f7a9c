"""An aircraft beside its wing with the root clamped: the same axes, the same colours."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.branches import (
    Branches,
    branches_of,
    clamped_branches,
    frequency_marks,
    highest_shown,
    lines,
    neutral_marks,
    rule_labels,
    rules,
    unstable_above,
)
from foldwing.plots.layout import focused, subtitle
from foldwing.plots.level_flight import (
    neutral_words,
    out_of_reach,
    reach_words,
    without_neutral,
)
from foldwing.plots.picture import Item, Panel, Picture, Range
from foldwing.results.aircraft_summary import statically_unstable
from foldwing.results.aircraft_table import clamped_rows
from foldwing.results.cases import fold_text
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.summary import critical_row

if TYPE_CHECKING:
    import xarray

_LABEL = "airspeed (m/s)"
_UNSTABLE = "In flight it is statically unstable: divergence at every airspeed"
_INCHES = 2.7
"""Width of a panel."""
_SAME = 0.002
"""Relative difference of airspeeds below which they are the same."""
_DEPTH = 1.2
"""How far the decay is shown, in heights of the growth."""
_HIGH, _LOW = 1.35, 1.1
"""Relative heights of the panels."""

Events = list[FlutterRow]


def beside_clamped(dataset: "xarray.Dataset") -> Picture | None:
    """Draw growth and frequency of the clamped wing on the left, of the aircraft on the right."""
    fixed = clamped_branches(dataset)
    if fixed is None or "growth" not in dataset or len(fixed.speed) < 2:
        return None
    free = branches_of(without_neutral(dataset))
    top = max(highest_shown(fixed), highest_shown(free))
    fixed, free = fixed.below(top), free.below(top)
    growth = focused(np.concatenate([fixed.growth, free.growth], axis=1), _DEPTH)
    events = clamped_rows(dataset) or [], flutter_rows(dataset)
    unstable = bool(statically_unstable(dataset))
    in_flight = "diverges from the start" if unstable else _first(events[1])
    headings = (f"clamped: {_first(events[0])}", f"in flight: {in_flight}")
    sides = (fixed, ()), (free, (growth, (-0.03 * top, top)))
    columns = [
        _column(side, (growth, top), [out_of_reach(dataset, side.limits, y) for y in hatched])
        for side, hatched in sides
    ]
    panels = [
        *(
            Panel(_LABEL, label, upper, fixed.limits, growth, title=heading, height=_HIGH)
            for heading, label, (upper, _) in zip(
                headings, ("growth rate (1/s)", ""), columns, strict=True
            )
        ),
        *(
            Panel(_LABEL, label, lower, fixed.limits, (-0.03 * top, top), height=_LOW)
            for label, (_, lower) in zip(("frequency (Hz)", ""), columns, strict=True)
        ),
    ]
    return Picture(
        "aircraft-beside-clamped",
        _UNSTABLE if unstable else _story(*events),
        subtitle(dataset, fold_text(dataset, 0)) + ". Left the wing with its root clamped, right "
        "the aircraft: the same axes, and the same mode in the same colour. Above zero (shaded) a "
        f"motion grows. Modes that stay above {top:.3g} Hz are not shown."
        + reach_words(dataset)
        + neutral_words(dataset),
        panels,
        columns=2,
        right_margin=1.05,
    )


def _column(
    side: Branches, ranges: tuple[Range, float], hatched: list[list[Item]]
) -> tuple[list[Item], list[Item]]:
    """Return the items of both panels of a side."""
    growth, top = ranges
    above, below = hatched or ([], [])
    upper = [
        *unstable_above(side.limits, growth),
        *above,
        *lines(side, side.growth, growth, "growth", _HIGH),
        *rules(side),
        *neutral_marks(side),
        *rule_labels(side, growth[0], _INCHES),
    ]
    lower = [
        *below,
        *lines(side, side.frequency, (-0.03 * top, top), "frequency", _LOW),
        *rules(side),
        *frequency_marks(side),
    ]
    return upper, lower


def _of_kind(rows: Events, kind: str) -> float | None:
    """Return the lowest airspeed at which flutter or divergence begins."""
    row = critical_row([row for row in rows if row.kind == kind])
    return None if row is None else row.speed


def _first(rows: Events) -> str:
    """Return the first flutter and divergence in a few words."""
    found = ((kind, _of_kind(rows, kind)) for kind in ("flutter", "divergence"))
    parts = [f"{kind} {speed:.3g}" for kind, speed in found if speed is not None]
    return f"{', '.join(parts)} m/s" if parts else "stable"


def _story(fixed: Events, free: Events) -> str:
    """Return what flight changes, in a sentence."""
    changes = (
        f"{kind} {_change(_of_kind(fixed, kind), _of_kind(free, kind))}"
        for kind in ("flutter", "divergence")
    )
    return f"From a clamped root to flight: {', '.join(changes)}"


def _change(fixed: float | None, free: float | None) -> str:
    if fixed is None or free is None:
        return "new" if free is not None else "gone" if fixed is not None else "in neither"
    if abs(free / fixed - 1.0) < _SAME:
        return "unchanged"
    return "later" if free > fixed else "earlier"
