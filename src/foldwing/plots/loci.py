"""Eigenvalues against airspeed: growth and frequency below each other, and the root locus."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.branches import (
    Branches,
    branches_of,
    frequency_marks,
    highest_shown,
    lines,
    neutral_marks,
    rule_labels,
    rules,
    unstable_above,
)
from foldwing.plots.events import event_marks
from foldwing.plots.layout import PANEL_INCHES, dash_of, focused, subject, subtitle, threshold
from foldwing.plots.level_flight import (
    neutral_words,
    out_of_reach,
    reach_words,
    slowest,
    without_neutral,
)
from foldwing.plots.picture import (
    Area,
    Graded,
    Item,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
)
from foldwing.plots.placing import Paper, around, clearest, corner_words, text_width
from foldwing.results.aircraft_table import MOTIONS
from foldwing.results.cases import fold_text
from foldwing.results.summary import unresolved_below

if TYPE_CHECKING:
    import xarray

_SIZE = (6.02, 1.8)
"""Width of the root locus in inches and its relative height."""
_FAR = 0.25
"""Distance in inches of a name from its path from which on a line joins them."""
_OWN = 0.12
"""Distance in inches around the beginning of a path where other names would mislead."""


def against_speed(dataset: "xarray.Dataset") -> Picture | None:
    """Draw growth rate and frequency of every branch against airspeed."""
    if not _has_loci(dataset):
        return None
    dataset = without_neutral(dataset)
    shown = branches_of(dataset)
    limits, top = shown.limits, highest_shown(shown)
    growth_range, hertz = focused(shown.growth, 3.0), (-0.03 * top, top)
    resolved = _resolved_from(dataset, limits)
    upper = [
        *unstable_above(limits, growth_range),
        *out_of_reach(dataset, limits, growth_range),
        *lines(shown, shown.growth, growth_range, "growth"),
        *rules(shown),
        *resolved,
        *neutral_marks(shown),
        *rule_labels(shown, growth_range[0]),
    ]
    lower = [
        *out_of_reach(dataset, limits, hertz),
        *lines(shown, shown.frequency, hertz, "frequency"),
        *rules(shown),
        *resolved,
        *frequency_marks(shown),
    ]
    what, units = subject(dataset), shown.units
    label = units.speed_label
    return Picture(
        "growth-and-frequency",
        f"How the motions of the {what} grow or decay as the airspeed rises",
        subtitle(dataset, fold_text(dataset, 0)) + ". Above zero (shaded) a motion grows by "
        f"itself: the {what} is unstable. Vertical lines mark the exact speeds {_where(dataset)}."
        + (" Dotted: from here on the lattice resolves all modes." if resolved else "")
        + reach_words(dataset)
        + neutral_words(dataset),
        [
            Panel(label, units.growth_label, upper, limits, growth_range, height=1.1),
            Panel(label, units.frequency_label, lower, limits, hertz, height=1.1),
        ],
        right_margin={"wing": 0.6, "section": 0.85}.get(what, 1.05),
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
    dataset = without_neutral(dataset)
    shown = branches_of(dataset)
    x_range, top = focused(shown.growth, 5.0), highest_shown(shown)
    y_range = (-0.04 * top, top)
    tint = Area(
        np.array([0.0, x_range[1], x_range[1], 0.0]), np.repeat(y_range, 2), "unstable", 0.1
    )
    units = shown.units
    items: list[Item] = [tint, Rule(0.0, "x", "ink", width=1.2)]
    items += _paths(shown)
    items += _path_ends(shown, Paper(x_range, y_range, _SIZE[0], _SIZE[1] * PANEL_INCHES))
    items += _crossing_marks(shown)
    items += _merger_marks(shown)
    items += [
        Note(x_range[1], top, "unstable", "unstable", "right", "top", -4, -4, bold=True),
        Note(0.0, top, "stable", "muted", "right", "top", -5, -4, bold=True),
    ]
    return Picture(
        "root-locus",
        "Flutter begins where a path crosses to the right of zero growth",
        subtitle(dataset, fold_text(dataset, 0)) + ". Each path is one motion (an eigenvalue) "
        "from the lowest airspeed (blue) to the highest (orange)."
        + _locus_words(dataset)
        + neutral_words(dataset),
        [
            Panel(
                units.growth_label, units.frequency_label, items, x_range, y_range, height=_SIZE[1]
            )
        ],
    )


def _locus_words(dataset: "xarray.Dataset") -> str:
    """Return what the paths of an aircraft mean below its slowest level flight."""
    end = slowest(dataset)
    if not end > float(dataset["speed"][0]):
        return ""
    largest = float(dataset["slowest_speed"].attrs["lift_coefficient"])
    return (
        f" Below {end:.3g} m/s, out of reach of level flight, paths are with the lift of a lift "
        f"coefficient of {largest:g}."
    )


def _has_loci(dataset: "xarray.Dataset") -> bool:
    return "growth" in dataset and bool(np.isfinite(dataset["growth"].values).any())


def _paths(shown: Branches) -> list[Item]:
    """Return every path coloured by airspeed; those of an aircraft as a whole also by a line."""
    speed, limits = shown.speed, shown.limits
    items: list[Item] = []
    for branch, name in enumerate(shown.names):
        x, y = shown.growth[:, branch], shown.frequency[:, branch]
        if not np.isfinite(x).any():
            continue
        items.append(Graded(x, y, speed, limits, shown.units.speed_label, name))
        if name in MOTIONS:
            label = f"{name} (thin line)"
            items.append(Line(x, y, "ink", dash_of(name), 1.0, name=name, label=label))
    return items


def _path_ends(shown: Branches, paper: Paper) -> list[Item]:
    """Mark the first and the last point of each path and name it where it comes into view."""
    growth, frequency = shown.growth, shown.frequency
    (left, right), (_, highest) = paper.x_range, paper.y_range
    names: list[tuple[float, float, str]] = []
    ends: tuple[list[tuple[float, float]], ...] = ([], [])
    for branch, name in enumerate(shown.names):
        finite = np.flatnonzero(np.isfinite(growth[:, branch]))
        inside = (growth[:, branch] >= left) & (growth[:, branch] <= right)
        inside &= frequency[:, branch] <= highest
        seen = np.flatnonzero(inside)
        if not seen.size:
            continue
        names.append((float(growth[seen[0], branch]), float(frequency[seen[0], branch]), name))
        for index, found in ((finite[0], ends[0]), (finite[-1], ends[1])):
            if inside[index]:
                found.append((float(growth[index, branch]), float(frequency[index, branch])))
    (x1, y1), (x2, y2) = (np.array(points).reshape(-1, 2).T for points in ends)
    return [
        Marks(x1, y1, "circle-open", "ink", "lowest airspeed", 5),
        Marks(x2, y2, "triangle", "ink", "highest airspeed", 6.5),
        *_names(shown, names, paper),
    ]


def _names(
    shown: Branches, names: list[tuple[float, float, str]], paper: Paper
) -> list[Note | Line]:
    """Return the names of paths where they cover least, those far away with a thin line."""
    paths = [paper.along(x, y) for x, y in zip(shown.growth.T, shown.frequency.T, strict=True)]
    axis = paper.along(np.zeros(2), np.array(paper.y_range))
    points = np.concatenate([axis, *paths])
    taken = corner_words(paper)
    items: list[Note | Line] = []
    for x, y, text in sorted(names, key=lambda name: (name[1], name[0])):
        start = paper.inches(np.array([x]), np.array([y]))[0]
        boxes = around(start, text_width(text))
        others = np.array([(at, up) for at, up, name in names if name != text]).reshape(-1, 2)
        avoided = np.concatenate([points, paper.rims(others[:, 0], others[:, 1], _OWN)])
        chosen = boxes[clearest(boxes, avoided, taken, paper)]
        end = np.clip(start, chosen[:2], chosen[2:])
        if np.hypot(*(end - start)) > _FAR:
            thread = np.array([(x, y), paper.values((end[0], end[1]))]).T
            items.append(Line(thread[0], thread[1], "muted", width=0.8))
            points = np.concatenate([points, paper.along(*thread)])
        middle = paper.values((chosen[0], (chosen[1] + chosen[3]) / 2.0))
        items.append(Note(*middle, text, "ink", bold=True))
        taken.append(chosen)
    return items


def _crossing_marks(shown: Branches) -> list[Marks]:
    rows = [row for row in shown.rows if row.threshold == 0 and row.event != "merger"]
    zero = [0.0] * len(rows)
    frequency = [row.frequency for row in rows]
    return event_marks(rows, zero, frequency, shown.colors, units=shown.units)


def _merger_marks(shown: Branches) -> list[Marks]:
    """Mark where an oscillation turns into real roots, at the growth it had just before."""
    rows, growth = [], []
    for row in shown.rows:
        name = row.motion if row.motion in MOTIONS else row.mode_name
        if row.event != "merger" or name not in shown.names:
            continue
        values = shown.growth[:, shown.names.index(name)]
        before = np.flatnonzero((shown.speed <= row.speed) & np.isfinite(values))
        if before.size:
            rows.append(row)
            growth.append(float(values[before[-1]]))
    return event_marks(rows, growth, [0.0] * len(rows), shown.colors, units=shown.units)
