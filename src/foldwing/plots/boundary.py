"""The flutter boundary: speed, frequency and strength against the fold angle."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.events import color_of, event_marks
from foldwing.plots.layout import Sweep, angle_label, subject, subtitle, sweep
from foldwing.plots.level_flight import OUT_OF_REACH
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import (
    Area,
    Array,
    Cells,
    Item,
    Line,
    Marks,
    Panel,
    Picture,
    Range,
    padded,
)
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.schema import fold_angle_names
from foldwing.results.summary import failed_cases, uncertified_cases, unresolved_below
from foldwing.stability.status import ELASTIC

if TYPE_CHECKING:
    import xarray

_DOUBTFUL = "case not certified: may be incomplete"
_CONTINUES = 0.12
"""Largest relative change of speed and of frequency between neighbours that a line joins."""


def boundary(dataset: "xarray.Dataset") -> Picture | None:
    """Draw flutter speed, frequency and strength against the fold angle."""
    if dataset.attrs["kind"] != "boundary" or not sweep(dataset).single:
        return None
    swept, colors, every = sweep(dataset), mode_colors(dataset), flutter_rows(dataset)
    rows = [row for row in every if not row.as_a_whole]
    flutter = [row for row in rows if row.kind == "flutter"]
    with_strength = [row for row in flutter if np.isfinite(row.strength)]
    chosen = ((rows, "speed"), (flutter, "frequency"), (with_strength, "strength"))
    speed, frequency, strength = (
        [
            *_lines(dataset, swept, points, quantity, colors),
            *_marks(dataset, swept, points, quantity, colors),
        ]
        for points, quantity in chosen
    )
    top, x = _top(dataset, rows), padded(swept.values, 0.02)
    shaded = _shaded(dataset, swept, rows, colors)
    marks = _case_marks(dataset, swept, rows, top)
    reach = _out_of_reach(dataset, swept)
    speed = [*shaded, *reach, *_unresolved(dataset, swept), *speed, *marks]
    hertz = _frequency_range(dataset, flutter)
    return Picture(
        "boundary",
        f"The airspeeds at which the {subject(dataset)} becomes unstable, against fold angle",
        subtitle(dataset, swept.rest) + ". Shaded: unstable airspeeds (darker when the flutter "
        "ends again). Strength is how fast the instability sets in with airspeed."
        + _left_out([row for row in every if row.as_a_whole]),
        [
            Panel(swept.label, "airspeed (m/s)", speed, x, (0.0, top)),
            Panel(swept.label, "flutter frequency (Hz)", frequency, x, hertz, height=0.75),
            Panel(swept.label, "strength (s/m)", strength, x, height=0.75),
        ],
    )


def _left_out(apart: Sequence[FlutterRow]) -> str:
    """Return which rows are not drawn: oscillations of an aircraft as a whole bound nothing."""
    if not apart:
        return ""
    names = " or ".join(sorted({row.motion for row in apart}))
    return f" Not drawn: where the {names} begins or ceases to grow, which bounds no airspeed."


def _out_of_reach(dataset: "xarray.Dataset", swept: Sweep) -> list[Item]:
    """Return the hatched airspeeds at which an aircraft cannot fly level, and their upper end."""
    if "slowest_speed" not in dataset:
        return []
    x, y = swept.values[swept.order], dataset["slowest_speed"].values[swept.order]
    known = np.isfinite(y)
    x, y = x[known], y[known]
    area = Area(np.append(x, x[::-1]), np.append(y, 0.0 * y), "muted", 0.09, "", hatched=True)
    line = Line(
        x, y, "muted", width=1.4, name="slowest level flight", label=f"below: {OUT_OF_REACH}"
    )
    return [area, line] if known.any() else []


def _unresolved(dataset: "xarray.Dataset", swept: Sweep) -> list[Item]:
    """Return the airspeeds below which some modes are too fast for the lattice."""
    lowest = unresolved_below(dataset)
    if not np.isfinite(lowest).any():
        return []
    x, y = swept.values[swept.order], lowest[swept.order]
    return [Line(x, y, "muted", "dot", 1.4, label="below: some modes are not resolved")]


def boundary_map(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the lowest airspeed of instability over two fold angles, for a grid of cases."""
    names = [n for n in fold_angle_names(dataset) if len(np.unique(dataset[n].values)) > 1]
    if dataset.attrs["kind"] != "boundary" or sweep(dataset).single or len(names) < 2:
        return None
    (x, column), (y, line) = (
        np.unique(dataset[name].values, return_inverse=True) for name in names[:2]
    )
    lowest = np.full((len(y), len(x)), np.nan)
    for row in flutter_rows(dataset):
        if row.is_critical:
            here = line[row.case], column[row.case]
            lowest[here] = np.nanmin([lowest[here], row.speed])
    return Picture(
        "boundary-map",
        "The lowest airspeed at which the wing becomes unstable, over two fold angles",
        f"{subtitle(dataset)}. {_over_others(names)}"
        "Empty cells: no flutter or divergence found, or no result.",
        [
            Panel(
                angle_label(names[0]),
                angle_label(names[1]),
                [Cells(x, y, lowest, "airspeed (m/s)")],
                height=1.7,
            )
        ],
    )


def _over_others(names: Sequence[str]) -> str:
    """Return what the map shows when more than two fold angles vary."""
    others = " and ".join(name.removeprefix("fold_") for name in names[2:])
    return f"Each cell is the lowest over all angles of hinge {others}. " if others else ""


def _top(dataset: "xarray.Dataset", rows: Sequence[FlutterRow]) -> float:
    """Highest airspeed to show."""
    measured = dataset["measured_speed"].values if "measured_speed" in dataset else ()
    values = np.array([*(row.speed for row in rows), *measured, 0.0])
    limit = dataset.attrs.get("speed_limit")
    return 1.03 * float(limit) if limit else 1.08 * float(np.nanmax(values)) or 1.0


def _frequency_range(dataset: "xarray.Dataset", rows: Sequence[FlutterRow]) -> Range:
    measured = dataset["measured_frequency"].values if "measured_frequency" in dataset else ()
    values = np.array([*(row.frequency for row in rows), *measured, 0.0])
    return (0.0, 1.15 * float(np.nanmax(values)) or 1.0)


def _marks(
    dataset: "xarray.Dataset",
    swept: Sweep,
    rows: Sequence[FlutterRow],
    quantity: str,
    colors: dict[str, str],
) -> list[Item]:
    x = [float(swept.values[row.case]) for row in rows]
    y = [float(getattr(row, quantity)) for row in rows]
    doubtful = set(uncertified_cases(dataset))
    crossed = [index for index, row in enumerate(rows) if row.case in doubtful]
    items: list[Item] = [*event_marks(rows, x, y, colors, by_mode=True)]
    if crossed:
        items.append(
            Marks(
                np.array([x[index] for index in crossed]),
                np.array([y[index] for index in crossed]),
                "x",
                "warning",
                _DOUBTFUL,
                8,
            )
        )
    return items + _measured(dataset, quantity)


def _measured(dataset: "xarray.Dataset", quantity: str) -> list[Item]:
    name = f"measured_{quantity}"
    if name not in dataset:
        return []
    y = dataset[name].values
    unit = dataset[name].attrs["units"]
    hover = [f"measured: {value:.4g} {unit}" for value in y]
    return [Marks(dataset["measured_fold"].values, y, "star", "ink", "measured", 9, hover)]


def _case_marks(
    dataset: "xarray.Dataset", swept: Sweep, rows: Sequence[FlutterRow], top: float
) -> list[Item]:
    """Mark at the edge what has no flutter point: failed, stable and uncertified cases."""
    failed, doubtful = failed_cases(dataset), uncertified_cases(dataset)
    with_points = {row.case for row in rows}
    quiet = [
        case
        for case in range(dataset.sizes["fold"])
        if case not in with_points and case not in failed
    ]
    messages = dataset["message"].values if "message" in dataset else None
    text = [str(messages[case]) if messages is not None else "failed" for case in failed]
    empty = [case for case in quiet if case in doubtful]
    stable = [case for case in quiet if case not in doubtful]

    def at(cases: Sequence[int], share: float) -> tuple[Array, Array]:
        return swept.values[list(cases)], np.full(len(cases), share * top)

    found = [
        Marks(*at(failed, 0.03), "x", "muted", "computation failed", 8, text),
        Marks(*at(empty, 0.03), "x", "warning", _DOUBTFUL, 8),
        Marks(*at(stable, 0.97), "triangle", "muted", "stable up to the highest airspeed", 7),
    ]
    return [marks for marks in found if len(marks.x)]


def _shaded(
    dataset: "xarray.Dataset", swept: Sweep, rows: Sequence[FlutterRow], colors: dict[str, str]
) -> list[Item]:
    """Shade the unstable airspeeds of each case over the width that it stands for."""
    limit = float(dataset.attrs.get("speed_limit", _top(dataset, rows)))
    closed: dict[str, list[tuple[FlutterRow, float]]] = {}
    open_: dict[str, list[tuple[FlutterRow, float]]] = {}
    for row in rows:
        if row.event == "onset" or row.motion != ELASTIC:
            end = _end(row, rows)
            (open_ if end is None else closed).setdefault(color_of(row, colors), []).append(
                (row, limit if end is None else end)
            )
    edges = _edges(swept)
    return [
        Area(*_boxes(group, edges), color, opacity)
        for groups, opacity in ((open_, 0.09), (closed, 0.26))
        for color, group in groups.items()
    ]


def _end(row: FlutterRow, rows: Sequence[FlutterRow]) -> float | None:
    """Return where the instability that begins at ``row`` ends.

    The merger of an aircraft's phugoid leaves two growing real roots: the second to stop ends it.
    """
    if row.event == "merger":
        ends = sorted(r.speed for r in rows if _stops(r, row))
        return ends[1] if len(ends) > 1 else None
    later = [
        other.speed
        for other in rows
        if (other.case, other.kind, other.branch) == (row.case, row.kind, row.branch)
        and other.event == "recovery"
        and other.speed > row.speed
    ]
    return min(later, default=None)


def _stops(other: FlutterRow, merger: FlutterRow) -> bool:
    """Return whether a real root stops to grow at another point, above the merger."""
    same = (other.case, other.kind, other.event) == (merger.case, "divergence", "recovery")
    return same and other.speed > merger.speed


def _edges(swept: Sweep) -> Array:
    """Return the interval that each case stands for, shape (fold, 2)."""
    x = swept.values[swept.order]
    if len(x) == 1:
        return np.array([[x[0] - 1.0, x[0] + 1.0]])
    middle = (x[1:] + x[:-1]) / 2
    edges = np.empty((len(x), 2))
    edges[swept.order, 0] = np.concatenate([[x[0]], middle])
    edges[swept.order, 1] = np.concatenate([middle, [x[-1]]])
    return edges


def _boxes(group: Sequence[tuple[FlutterRow, float]], edges: Array) -> tuple[Array, Array]:
    x = [(*edges[row.case][[0, 1, 1, 0]], np.nan) for row, _ in group]
    y = [(row.speed, row.speed, end, end, np.nan) for row, end in group]
    return np.ravel(x), np.ravel(y)


def _lines(
    dataset: "xarray.Dataset",
    swept: Sweep,
    rows: Sequence[FlutterRow],
    quantity: str,
    colors: dict[str, str],
) -> list[Item]:
    """Thin lines: the continuation curves, and between close neighbours what none follows."""

    def coordinates(row: FlutterRow) -> tuple[float, float]:
        return float(swept.values[row.case]), float(getattr(row, quantity))

    followed = list(_curves(dataset, quantity)) if "curve_id" in dataset else []
    groups = _alone(dataset, rows) if followed else _alike(rows)
    return [
        *followed,
        *(
            Line(*_joined(group, swept, coordinates), color_of(group[0], colors), width=1.0)
            for group in groups
        ),
    ]


def _alike(rows: Sequence[FlutterRow]) -> list[list[FlutterRow]]:
    """Return the points of one kind, event and mode together."""
    groups: dict[tuple[str, str, str], list[FlutterRow]] = {}
    for row in rows:
        groups.setdefault((row.kind, row.event, row.mode_name), []).append(row)
    return list(groups.values())


def _alone(dataset: "xarray.Dataset", rows: Sequence[FlutterRow]) -> list[list[FlutterRow]]:
    """Return points of divergence that no curve follows: of each event and motion one a case."""
    if (dataset["curve_kind"].values == "divergence").any():
        return []
    groups: dict[tuple[str, str], list[FlutterRow]] = {}
    for row in rows:
        if row.kind == "divergence":
            groups.setdefault((row.event, row.motion), []).append(row)
    single = []
    for group in groups.values():
        cases = [row.case for row in group]
        kept = [row for row in group if cases.count(row.case) == 1]
        single += [kept] if kept else []
    return single


def _joined(
    rows: Sequence[FlutterRow],
    swept: Sweep,
    coordinates: Callable[[FlutterRow], tuple[float, float]],
) -> tuple[Array, Array]:
    """Return segments between points of neighbouring cases, separated by nan."""
    by_case: dict[int, list[FlutterRow]] = {}
    for row in rows:
        by_case.setdefault(row.case, []).append(row)
    points: list[tuple[float, float]] = []
    order = swept.order.tolist()
    for left, right in pairwise(order):
        for a, b in _pairs(by_case.get(left, []), by_case.get(right, [])):
            points += [coordinates(a), coordinates(b), (np.nan, np.nan)]
    x, y = np.array(points or [(np.nan, np.nan)]).T
    return x, y


def _pairs(
    left: Sequence[FlutterRow], right: Sequence[FlutterRow]
) -> Iterator[tuple[FlutterRow, FlutterRow]]:
    """Match points that clearly continue, nearest first, each once."""
    ranked = sorted((_change(a, b), i, j) for i, a in enumerate(left) for j, b in enumerate(right))
    used_left: set[int] = set()
    used_right: set[int] = set()
    for change, i, j in ranked:
        if change < _CONTINUES and i not in used_left and j not in used_right:
            used_left.add(i)
            used_right.add(j)
            yield left[i], right[j]


def _change(a: FlutterRow, b: FlutterRow) -> float:
    speed = abs(a.speed - b.speed) / max(a.speed, b.speed)
    if a.kind == "divergence":
        return speed
    return max(speed, abs(a.frequency - b.frequency) / max(a.frequency, b.frequency))


def _curves(dataset: "xarray.Dataset", quantity: str) -> Iterator[Line]:
    identity, kind = dataset["curve_id"].values, dataset["curve_kind"].values
    for curve in np.unique(identity):
        own = identity == curve
        diverging = str(kind[own][0]) == "divergence"
        if diverging and quantity != "speed":
            continue
        x, y = dataset["curve_fold"].values[own], dataset[f"curve_{quantity}"].values[own]
        yield Line(x, y, "divergence" if diverging else "ink", width=1.0)
