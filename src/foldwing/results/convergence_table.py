"""What a convergence study found: settings in words, error bars in per cent, the answer."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from foldwing.results.flutter_table import FlutterRow, flutter_rows

if TYPE_CHECKING:
    import xarray

SPAN_REMEDY = "Inset spacing (--spacing inset) or more strips lessen the error of the span."

TARGET = 0.01
"""Relative error bar that is asked of the mesh."""

TITLES: Mapping[str, str] = {
    "chordwise": "panels along the chord",
    "spanwise": "strips along the span",
    "wake": "length of the wake (chords)",
    "time-step": "panels along the chord, discrete time steps",
    "segment-modes": "bending and torsion modes per segment",
    "system-modes": "modes of the joined wing",
    "gap": "gap between segments (mm)",
}
"""What each setting is, with its unit."""

_PARTS = {"chordwise": "chord", "spanwise": "span", "wake": "wake"}

_UNKNOWN = {
    "missing": "it is not found at every finer",
    "diverging": "it changes more and more with a finer",
    "few": "there are too few levels of the",
}
"""Why an error bar is not known, before the part of the mesh."""


@dataclass(frozen=True)
class Levels:
    """One setting and the flutter points at each of its values.

    Attributes
    ----------
    setting : str
    values : array, shape (m,)
        Ascending; a gap in mm.
    own : array of bool, shape (m,)
        Which is the model's own.
    speed : array, shape (m, flutter_point)
        m/s, nan where the point is missing.
    verdict : list of str, length flutter_point
    order, limit, error : array, shape (flutter_point,)
        Observed order; extrapolated airspeed and error bar in m/s.
    """

    setting: str
    values: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"
    own: "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]"
    speed: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"
    verdict: list[str]
    order: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"
    limit: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"
    error: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]"


def levels_by_setting(dataset: "xarray.Dataset") -> list[Levels]:
    """Return what a convergence study found for each setting."""
    found = []
    for index, name in enumerate(dataset["setting"].values.tolist()):
        here = dataset["level_setting"].values == name
        found.append(
            Levels(
                name,
                dataset["level_value"].values[here] * (1e3 if name == "gap" else 1.0),
                dataset["level_own"].values[here],
                dataset["level_speed"].values[here],
                dataset["convergence"].values[index].tolist(),
                *(dataset[part].values[index] for part in ("order", "limit_speed", "error_speed")),
            )
        )
    return found


def point_name(row: FlutterRow) -> str:
    """Return a flutter point in words, ``flutter onset T1 at 18.8 m/s``."""
    return f"{row.kind} {row.event} {row.mode_name} at {row.speed:.3g} m/s"


def convergence_answer(dataset: "xarray.Dataset") -> str:
    """Return in a sentence or two whether the mesh is fine enough, and where it is not."""
    rows = flutter_rows(dataset)
    if not rows:
        return "No flutter or divergence found: there is nothing to converge."
    relative = dataset["mesh_error_speed"].values / dataset["flutter_speed"].values
    if set(_PARTS) <= set(dataset["setting"].values.tolist()):
        return _mesh_answer(dataset, rows, relative)
    parts = [
        f"{TITLES[one.setting].partition(' (')[0]} {_worst(one, rows)}"
        for one in levels_by_setting(dataset)
    ]
    return f"Largest error bars of the airspeeds: {'; '.join(parts)}."


def _worst(one: Levels, rows: list[FlutterRow]) -> str:
    relative = one.error / np.array([row.speed for row in rows])
    if not np.isfinite(relative).any():
        return "not known"
    at = int(np.nanargmax(relative))
    return f"{100.0 * relative[at]:.3g} % ({point_name(rows[at])})"


def _mesh_answer(
    dataset: "xarray.Dataset",
    rows: list[FlutterRow],
    relative: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]",
) -> str:
    good = relative <= TARGET
    text = (
        f"{int(good.sum())} of {len(rows)} flutter points are good to {100.0 * TARGET:g} % in "
        "airspeed, by chord, span and wake together"
    )
    parts = [
        f"{point_name(row)} ({_reason(dataset, point, float(relative[point]))})"
        for point, row in enumerate(rows)
        if not good[point]
    ]
    if not parts:
        return f"{text}."
    remedy = f" {SPAN_REMEDY}" if any("the span" in part for part in parts) else ""
    return f"{text}; not {', '.join(parts)}.{remedy}"


def _reason(dataset: "xarray.Dataset", point: int, relative: float) -> str:
    """Return the error bar and the setting that has most of it."""
    mesh = [one for one in levels_by_setting(dataset) if one.setting in _PARTS]
    parts = {_PARTS[one.setting]: float(one.error[point]) for one in mesh}
    unknown: dict[str, list[str]] = {}
    for one in mesh:
        if np.isnan(one.error[point]):
            why = _UNKNOWN.get(one.verdict[point], _UNKNOWN["missing"])
            unknown.setdefault(why, []).append(_PARTS[one.setting])
    if unknown:
        reasons = (f"{why} {' and '.join(names)}" for why, names in unknown.items())
        return f"not known: {', and '.join(reasons)}"
    return f"{100.0 * relative:.3g} %, most of it from the {max(parts, key=lambda n: parts[n])}"
