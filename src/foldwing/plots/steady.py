"""Circulation of a steady wing: along its span, across its folds, and in space."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from foldwing.plots.layout import PANEL_INCHES, WIDTH_INCHES, subtitle
from foldwing.plots.palette import SERIES
from foldwing.plots.picture import (
    Area,
    Array,
    Item,
    Line,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    Scene,
    Surface,
    Thread,
    padded,
)
from foldwing.plots.shapes import _size, box_around, signs
from foldwing.results.cases import degrees, fold_text

if TYPE_CHECKING:
    import xarray

_MOST_SHOWN = 6
_HEIGHT = 0.22
"""Largest circulation drawn across the wing, as a share of its unfolded span."""
_MARGIN, _RIGHT = 0.88, 2.1
"""Room to the left and to the right of the panels in inches."""


class _Profile(NamedTuple):
    """Circulation of one segment at the middles of its strips and at its two ends.

    ``along`` is the position on the unfolded span, ``place`` the leading edge in space and
    ``across`` the normal of the segment.
    """

    along: Array
    value: Array
    place: Array
    across: Array
    chord: float


def circulation(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the circulation of all folds against the unfolded span, dashed without gaps."""
    shown = _shown(dataset, SERIES)
    if not shown:
        return None
    items: list[Item] = [Rule(0.0, "y")]
    items += [Rule(x, "x", dash="dot") for x in _hinge_lines(dataset)]
    for number, case in enumerate(shown):
        for gap in dataset["gap"].values.tolist():
            items.append(_span_line(dataset, case, gap, f"series{number % SERIES}"))
    high = float(dataset["strip_outer"].values.max())
    values = dataset["strip_circulation"].values[shown]
    y_range = padded(np.append(values[np.isfinite(values)], 0.0), 0.06)
    notes = [
        Note(x, y_range[1], f"hinge {number}", "muted", "center", "bottom", dy=2)
        for number, x in enumerate(_hinge_lines(dataset), start=2)
    ]
    panel = Panel(
        "position along the unfolded span (m)",
        "circulation (m²/s)",
        [*items, *notes],
        (0.0, high),
        y_range,
        height=1.5,
    )
    dotted = " Dotted: hinges." if _hinge_lines(dataset) else ""
    dashed = " Dashed: the same wing without gaps." if _has_gaps(dataset) else ""
    return Picture(
        "circulation",
        f"Circulation along the wing at {_stream(dataset)}",
        f"{subtitle(dataset)}. The lift per span across a segment is density times airspeed times "
        f"circulation.{dotted}{dashed}{_left_out(dataset, shown)}",
        [panel],
    )


def circulation_across(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the circulation as a height across the folded wing, seen along the stream."""
    shown = _shown(dataset, _MOST_SHOWN)
    if not shown:
        return None
    scale = _drawn_scale(dataset, shown)
    outlines = [_outline(dataset, case, scale) for case in shown]
    x_range = padded(np.concatenate([points[:, 0] for points in outlines]), 0.08)
    panels = []
    for case, points in zip(shown, outlines, strict=True):
        y_range = padded(points[:, 1], 0.12)
        share = (y_range[1] - y_range[0]) / (x_range[1] - x_range[0])
        panels.append(
            Panel(
                "y, outboard (m)",
                "z, up (m)",
                [*_across(dataset, case, scale), *_labels(dataset, case, x_range, y_range)],
                x_range,
                y_range,
                height=share * (WIDTH_INCHES - _MARGIN - _RIGHT) / PANEL_INCHES,
                equal=True,
            )
        )
    bar = _round_value(0.4 * _largest(dataset, shown))
    panels[0] = _with_scale(panels[0], bar, scale)
    dashed = " Dashed: without gaps." if _has_gaps(dataset) else ""
    return Picture(
        "circulation-across",
        f"Circulation across the folded wing at {_stream(dataset)}",
        f"{subtitle(dataset)}. Seen along the stream, root at the left. The height above the wing "
        "(thick), on the side to which it is sucked, is the circulation, to one scale in all "
        f"panels.{dashed}{_left_out(dataset, shown)}",
        panels,
        right_margin=_RIGHT,
    )


def circulation_in_space(dataset: "xarray.Dataset") -> Picture | None:
    """Colour the folded wing by its circulation, with the circulation as a height above it."""
    shown = _shown(dataset, _MOST_SHOWN)
    if not shown:
        return None
    gap, scale = dataset["gap"].values.tolist()[0], _drawn_scale(dataset, shown)
    views = [[*_profiles(dataset, case, gap)] for case in shown]
    grids = [tuple(_sheet(profile) for profile in view) for view in views]
    raised = [tuple(_raised(profile, scale)[:, None] for profile in view) for view in views]
    limit = max(float(np.abs(profile.value).max()) for view in views for profile in view) or 1.0
    box = box_around(grids[0], [*grids, *raised])
    largest = max(grids, key=_size)  # the root is the same: signs of one size in all views
    scenes = [
        Scene(
            fold_text(dataset, case),
            [
                *(_coloured(profile, limit) for profile in view),
                *(thread for profile in view for thread in _curtain(profile, scale)),
                *signs(largest),
            ],
            box,
        )
        for case, view in zip(shown, views, strict=True)
    ]
    return Picture(
        "circulation-in-space",
        f"Circulation on the folded wing at {_stream(dataset)}",
        f"{subtitle(dataset)}. The curve above the quarter-chord line and the colour both show the "
        f"circulation: full red (or blue, when it is negative) is {limit:.3g} m²/s. The thick line "
        f"is the root.{_left_out(dataset, shown)}",
        scenes,
        columns=min(2, len(scenes)),
    )


# ------------------------------------------------------------------------------------- the data


def _shown(dataset: "xarray.Dataset", most: int) -> list[int]:
    """Return the cases that have a result, spread over all when they are too many."""
    if "strip_circulation" not in dataset:
        return []
    known = np.flatnonzero(np.isfinite(dataset["strip_circulation"].values).all(axis=1))
    picked = np.linspace(0, len(known) - 1, min(most, len(known))).round().astype(int)
    return [int(case) for case in known[picked]]


def _left_out(dataset: "xarray.Dataset", shown: Sequence[int]) -> str:
    total = dataset.sizes["fold"]
    return f" {len(shown)} of {total} cases are shown." if len(shown) < total else ""


def _has_gaps(dataset: "xarray.Dataset") -> bool:
    return bool(dataset.sizes["gap"] > 1)


def _stream(dataset: "xarray.Dataset") -> str:
    return f"{degrees(dataset.attrs['alpha'])} and {dataset.attrs['airspeed']:g} m/s"


def _largest(dataset: "xarray.Dataset", shown: Sequence[int]) -> float:
    return float(np.abs(dataset["strip_circulation"].values[shown]).max()) or 1.0


def _drawn_scale(dataset: "xarray.Dataset", shown: Sequence[int]) -> float:
    """Return the height in metres at which a unit of circulation is drawn."""
    span = float(dataset["strip_outer"].values.max())
    return _HEIGHT * span / _largest(dataset, shown)


def _hinge_lines(dataset: "xarray.Dataset") -> list[float]:
    """Return where the hinges are on the unfolded span: half way between segments."""
    first = dataset["strip_gap"].values == dataset["gap"].values[0]
    segment = dataset["strip_segment"].values[first]
    outer = dataset["strip_outer"].values[first]
    inner = dataset["strip_inner"].values[first]
    last = np.flatnonzero(np.diff(segment))
    return [float((outer[i] + inner[i + 1]) / 2.0) for i in last]


def _profiles(dataset: "xarray.Dataset", case: int, gap: str) -> Iterator[_Profile]:
    """Return the circulation of each segment; it is zero at free edges."""
    strips = np.flatnonzero(dataset["strip_gap"].values == gap)
    inner, outer = (dataset[f"strip_{end}"].values[strips] for end in ("inner", "outer"))
    segment, chord = (dataset[f"strip_{what}"].values[strips] for what in ("segment", "chord"))
    value = dataset["strip_circulation"].values[case, strips]
    edge = dataset["strip_edge"].values[case, strips]
    joined = np.isclose(outer[:-1], inner[1:], atol=1e-9)
    shared = np.where(joined, (value[1:] + value[:-1]) / 2.0, 0.0)
    root = value[0] if dataset.attrs["image"] else 0.0
    starts, ends = np.append(root, shared), np.append(shared, 0.0)
    for number in np.unique(segment):
        own = np.flatnonzero(segment == number)
        i, j = own[0], own[-1]
        ray = edge[j, 1, 1:] - edge[i, 0, 1:]
        yield _Profile(
            np.concatenate([[inner[i]], (inner[own] + outer[own]) / 2.0, [outer[j]]]),
            np.concatenate([[starts[i]], value[own], [ends[j]]]),
            np.concatenate([edge[i, :1], edge[own].mean(axis=1), edge[j, 1:]]),
            np.array([0.0, -ray[1], ray[0]]) / np.linalg.norm(ray),
            float(chord[i]),
        )


# ----------------------------------------------------------------------------------- its drawing


def _span_line(dataset: "xarray.Dataset", case: int, gap: str, color: str) -> Line:
    parts = [*_profiles(dataset, case, gap)]
    x = np.concatenate([part.along for part in parts])
    y = np.concatenate([part.value for part in parts])
    as_modelled = gap == dataset["gap"].values[0]
    where = fold_text(dataset, case) or "circulation"
    if as_modelled:
        return Line(x, y, color, "solid", 1.9, name=where, label=where)
    return Line(x, y, color, "dash", 1.3, name=f"{where}, without gaps")


def _raised(profile: _Profile, scale: float) -> Array:
    """Return the curve above the quarter-chord line, shape (m, 3)."""
    quarter = profile.place + np.array([0.25 * profile.chord, 0.0, 0.0])
    return np.asarray(quarter + scale * profile.value[:, None] * profile.across)


def _outline(dataset: "xarray.Dataset", case: int, scale: float) -> Array:
    """Return y and z of everything that is drawn of a case, shape (m, 2)."""
    parts = [
        points[:, 1:]
        for gap in dataset["gap"].values.tolist()
        for profile in _profiles(dataset, case, gap)
        for points in (profile.place, _raised(profile, scale))
    ]
    return np.concatenate(parts)


def _across(dataset: "xarray.Dataset", case: int, scale: float) -> Iterator[Item]:
    gaps = dataset["gap"].values.tolist()
    for gap in reversed(gaps):
        for profile in _profiles(dataset, case, gap):
            y, z = _raised(profile, scale)[:, 1:].T
            if gap != gaps[0]:
                yield Line(y, z, "series0", "dash", 1.2, name="without gaps")
                continue
            foot = profile.place[::-1, 1:]
            area = np.concatenate([np.stack([y, z], axis=1), foot])
            yield Area(area[:, 0], area[:, 1], "series0", 0.22)
            yield Line(y, z, "series0", width=1.8, name="circulation")
            yield Line(profile.place[:, 1], profile.place[:, 2], "ink", width=2.6, name="wing")


def _labels(dataset: "xarray.Dataset", case: int, x_range: Range, y_range: Range) -> Iterator[Note]:
    """Return the fold angles, the lift and its slope, to the right of a panel."""
    loads = dataset.isel(fold=case, gap=0)
    lines = (
        fold_text(dataset, case),
        f"lift {float(loads['lift']):.3g} N",
        f"lift slope {float(loads['lift_slope']):.3g} per rad",
    )
    for number, text in enumerate(filter(None, lines)):
        bold, below = text.startswith("fold"), -14.0 * number
        words = text.replace("-", "\u2212")
        yield Note(x_range[1], y_range[1], words, baseline="top", dx=8, dy=below, bold=bold)


def _with_scale(panel: Panel, value: float, scale: float) -> Panel:
    """Return the panel with a bar, to its right, as high as a circulation of ``value``."""
    assert panel.x_range is not None and panel.y_range is not None
    (x, x_end), (y, _) = panel.x_range, panel.y_range
    at = x + 0.975 * (x_end - x)
    foot = y + 0.04 * (panel.y_range[1] - y)
    bar = Line(np.array([at, at]), np.array([foot, foot + value * scale]), "ink", width=3.0)
    text = Note(x_end, foot + value * scale / 2.0, f"the bar is {value:g} m²/s", "muted", dx=8)
    return replace(panel, items=[*panel.items, bar, text])


def _round_value(value: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that does not exceed ``value``."""
    unit = 10.0 ** np.floor(np.log10(value))
    return float(max(unit * step for step in (1.0, 2.0, 5.0) if unit * step <= value * 1.001))


def _sheet(profile: _Profile) -> Array:
    """Return the segment as a grid (span, chord, axis)."""
    back = np.array([profile.chord, 0.0, 0.0])
    return np.stack([profile.place, profile.place + 0.25 * back, profile.place + back], axis=1)


def _coloured(profile: _Profile, limit: float) -> Surface:
    grid = _sheet(profile)
    values = np.repeat(profile.value[:, None], grid.shape[1], axis=1)
    return Surface(grid[..., 0], grid[..., 1], grid[..., 2], values, (-limit, limit))


def _curtain(profile: _Profile, scale: float) -> Iterator[Thread]:
    """Return the curve and the posts that carry it."""
    foot = profile.place + np.array([0.25 * profile.chord, 0.0, 0.0])
    top = _raised(profile, scale)
    for a, b in zip(foot, top, strict=True):
        yield Thread(np.stack([a, b]), "series0", 0.6, 0.55)
    yield Thread(top, "series0", 1.8)
