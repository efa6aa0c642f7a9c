"""Branches against airspeed: their lines, and the events on them; for several pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.events import color_of, event_marks, short_words
from foldwing.plots.layout import dash_of, end_labels, upright_labels
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import Area, Array, Item, Line, Marks, Note, Range, Rule, padded
from foldwing.results.aircraft_table import MOTIONS, clamped_rows
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.units import SI, Units, units_of

if TYPE_CHECKING:
    import xarray

PLOT_INCHES = 6.3
"""Width of a panel that fills its picture."""


@dataclass(frozen=True)
class Branches:
    """What is drawn against airspeed.

    Attributes
    ----------
    speed : array, shape (u,)
        m/s.
    growth, frequency : array, shape (u, branch)
        1/s and Hz.
    names : tuple of str
    rows : list of FlutterRow
        Flutter points within the airspeeds.
    colors : dict
        Role of each name.
    units : Units
    """

    speed: Array
    growth: Array
    frequency: Array
    names: tuple[str, ...]
    rows: list[FlutterRow]
    colors: dict[str, str]
    units: Units = SI

    @property
    def limits(self) -> Range:
        """Range of airspeeds to show."""
        return speed_range(self.speed)

    def taken(self, places: Sequence[int]) -> "Branches":
        """Return some of the branches, with all events."""
        kept = list(places)
        names = tuple(self.names[place] for place in kept)
        growth, frequency = self.growth[:, kept], self.frequency[:, kept]
        return replace(self, growth=growth, frequency=frequency, names=names)

    def below(self, highest: float) -> "Branches":
        """Return the branches that come below a frequency in Hz."""
        low = np.where(np.isfinite(self.frequency), self.frequency, np.inf).min(axis=0)
        return self.taken(np.flatnonzero(low <= highest).tolist())


def branches_of(dataset: "xarray.Dataset") -> Branches:
    """Return the branches of the first case."""
    speed = dataset["speed"].values
    growth, frequency = (np.asarray(dataset[n].values[0], float) for n in ("growth", "frequency"))
    names = tuple(str(name) for name in dataset["branch_name"].values)
    rows = _within(flutter_rows(dataset), speed)
    return Branches(speed, growth, frequency, names, rows, mode_colors(dataset), units_of(dataset))


def clamped_branches(dataset: "xarray.Dataset") -> Branches | None:
    """Return the branches of the wing of an aircraft with its root clamped; None without any."""
    rows = clamped_rows(dataset)
    if rows is None:
        return None
    speed, values = dataset["speed"].values, dataset["clamped_eigenvalue"].values
    names = tuple(str(name) for name in dataset["clamped_branch_name"].values)
    hertz = np.where(np.isnan(values.real), np.nan, np.abs(values.imag) / (2.0 * np.pi))
    return Branches(speed, values.real, hertz, names, _within(rows, speed), mode_colors(dataset))


def _within(rows: Sequence[FlutterRow], speed: Array) -> list[FlutterRow]:
    low, high = speed_range(speed)
    return [row for row in rows if low <= row.speed <= high]


def speed_range(speed: Array) -> Range:
    """Return the range of airspeeds to show."""
    return (float(speed[0]), float(speed[-1])) if len(speed) > 1 else padded(speed)


def highest_shown(branches: Branches) -> float:
    """Return the frequency up to which branches are shown: those that flutter, and at least four.

    The highest modes, many times faster, would press the others flat.
    """
    frequency = branches.frequency
    finite = frequency[np.isfinite(frequency)]
    if not finite.size:
        return 1.0
    rows_with_values = np.flatnonzero(np.isfinite(frequency).any(axis=1))
    first = np.sort(frequency[rows_with_values[0]])
    fourth = float(first[min(3, int(np.isfinite(first).sum()) - 1)])
    flutter = max((row.frequency for row in branches.rows), default=0.0)
    return min(1.15 * float(finite.max()), max(1.25 * fourth, 1.6 * flutter)) or 1.0


def unstable_above(limits: Range, growth_range: Range) -> list[Item]:
    """Return a panel's halves where motions grow and where they decay."""
    x = np.array([limits[0], limits[1], limits[1], limits[0]])
    y = np.array([0.0, 0.0, growth_range[1], growth_range[1]])
    return [
        Area(x, y, "unstable", 0.1),
        Rule(0.0, "y", "ink", width=1.2),
        Note(limits[0], growth_range[1], "unstable", "unstable", "left", "top", 5, -4, bold=True),
        Note(limits[0], growth_range[0], "stable", "muted", "left", "bottom", 5, 4, bold=True),
    ]


def lines(
    branches: Branches, values: Array, y_range: Range, quantity: str, height: float = 1.1
) -> list[Item]:
    """Return the line of every branch, named at its end.

    Parameters
    ----------
    branches : Branches
    values : array, shape (u, branch)
    y_range : tuple of float
    quantity : str
        In words.
    height : float
        Relative height of the panel.
    """
    speed = branches.speed
    items: list[Item] = []
    ends = []
    for branch, name in enumerate(branches.names):
        y = values[:, branch]
        finite = np.flatnonzero(np.isfinite(y))
        if not finite.size:
            continue
        color = branches.colors[name]
        label = name if name in MOTIONS else ""
        items.append(Line(speed, y, color, dash_of(name), 1.8, f"{quantity} of {name}", label))
        if finite[-1] == len(speed) - 1:
            ends.append((float(y[-1]), name, color))
    return items + list(end_labels(ends, float(speed[-1]), y_range, height=height))


def rules(branches: Branches) -> list[Item]:
    """Return a line at the airspeed of each event."""
    return [Rule(r.speed, "x", color_of(r, branches.colors), "dash", 0.9) for r in branches.rows]


def neutral_marks(branches: Branches) -> list[Marks]:
    """Return marks at zero growth, for the points that are reported there."""
    neutral = [row for row in branches.rows if row.threshold == 0 and row.event != "merger"]
    speeds = [row.speed for row in neutral]
    return event_marks(neutral, speeds, [0.0] * len(neutral), branches.colors, units=branches.units)


def frequency_marks(branches: Branches) -> list[Marks]:
    """Return marks of all events at their frequencies."""
    rows = branches.rows
    at = [row.speed for row in rows], [row.frequency for row in rows]
    return event_marks(rows, *at, branches.colors, units=branches.units)


def leaving(branches: Branches, values: Array, y_range: Range) -> list[Note]:
    """Return the names of branches that end above a panel, where they leave it."""
    notes = []
    for branch, name in enumerate(branches.names):
        y = values[:, branch]
        finite = np.flatnonzero(np.isfinite(y))
        inside = np.flatnonzero((y >= y_range[0]) & (y <= y_range[1]))
        if inside.size and y[finite[-1]] > y_range[1]:
            x, color = float(branches.speed[inside[-1]]), branches.colors[name]
            notes.append(Note(x, y_range[1], name, color, "left", "top", 9, -4, bold=True))
    return notes


def rule_labels(branches: Branches, y: float, inches: float = PLOT_INCHES) -> list[Note]:
    """Return what happens at each event and its airspeed, upright from ``y`` on."""
    events = [
        (
            row.speed,
            f"{short_words(row)} {row.speed:.3g} {branches.units.speed}",
            color_of(row, branches.colors),
        )
        for row in branches.rows
    ]
    return upright_labels(events, y, branches.limits, inches)
