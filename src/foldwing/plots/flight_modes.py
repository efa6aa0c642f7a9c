"""Eigenvalues of a rigid aircraft: in the complex plane and against airspeed, by all models."""

import math
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import subtitle
from foldwing.plots.palette import SERIES
from foldwing.plots.picture import (
    Area,
    Array,
    Dash,
    Item,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    Symbol,
    padded,
)

if TYPE_CHECKING:
    import xarray

_MODES = ("phugoid", "short period", "third oscillation")
_SYMBOLS: tuple[Symbol, ...] = ("circle", "ring", "diamond", "triangle", "x", "star")
_SIZES = (10.0, 14.0, 6.0, 5.5, 5.0, 5.0)
"""Of the symbols in points: later ones are smaller, or rings, and show on those before."""
_DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
_MOST_MARKS = 30
"""Airspeeds up to which each is marked."""
_HARDLY = 0.05
"""Relative change of the product that is hardly one."""


def flight_eigenvalues(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the eigenvalues of each mode in the plane of growth and frequency."""
    if "flight_eigenvalue" not in dataset:
        return None
    panels = [_plane(dataset, mode) for mode in _modes(dataset)]
    speed = dataset.attrs.get("airspeed")
    where = "" if speed is None else f" at {speed:.4g} m/s"
    few = dataset.sizes.get("speed", 0) <= _MOST_MARKS
    steps = ", with a small mark at each" if few else ""
    swept = f" Lines: their paths over the airspeeds{steps}." if "swept_mode" in dataset else ""
    return Picture(
        "flight-eigenvalues",
        f"How fast the motions go and how soon they die out{where}",
        f"{subtitle(dataset)}. Left of zero a motion decays, to the right (shaded) it grows; at "
        f"zero frequency it does not oscillate.{swept}",
        panels,
        columns=min(2, len(panels)),
    )


def flight_against_speed(dataset: "xarray.Dataset") -> Picture | None:
    """Draw growth and frequency of each mode against airspeed, and what hardly changes."""
    if "swept_eigenvalue" not in dataset:
        return None
    panels = [
        _against(dataset, mode, quantity)
        for mode in _modes(dataset)
        for quantity in ("growth rate (1/s)", "frequency (rad/s)")
    ]
    return Picture(
        "flight-against-speed",
        "The modes against the airspeed of level flight",
        f"{subtitle(dataset)}. {_product_words(dataset)} Dotted there: √2 g, the simple phugoid "
        "without drag.",
        [*panels, _product(dataset), _lift(dataset)],
        columns=2,
    )


def _modes(dataset: "xarray.Dataset") -> list[str]:
    names = set(dataset["flight_mode"].values.ravel().tolist())
    if "swept_mode" in dataset:
        names |= set(dataset["swept_mode"].values.ravel().tolist())
    return [mode for mode in _MODES if mode in names]


def _models(dataset: "xarray.Dataset") -> list[str]:
    return [str(name) for name in dataset["flight_model"].values]


def _plane(dataset: "xarray.Dataset", mode: str) -> Panel:
    growth, frequency = _points(dataset, mode)
    paths = _paths(dataset, mode)
    everything = [growth.ravel(), *(path[0].ravel() for path in paths), np.zeros(1)]
    x_range = padded(np.concatenate(everything), 0.12)
    heights = [frequency.ravel(), *(path[1].ravel() for path in paths)]
    y_range = _upwards(np.concatenate(heights), 0.1)
    items: list[Item] = [*_shaded(x_range, y_range), Rule(0.0, "y")]
    for at, (x, y) in enumerate(paths):
        for i in range(x.shape[1]):
            broken = _broken(x[:, i], y[:, i], y[:, i] > 0.0)
            items.append(Line(*broken, _color(at), _dash(at), 1.2))
            items += _steps(dataset, at, x[:, i], y[:, i])
    for at, name in enumerate(_models(dataset)):
        kept = np.isfinite(growth[at])
        marks = growth[at][kept], frequency[at][kept]
        items.append(
            Marks(*marks, _symbol(at), _color(at), name, _size(at), [name] * int(kept.sum()))
        )
    items.append(Note(x_range[0], y_range[1], mode, "ink", "left", "top", 5, -4, bold=True))
    return Panel("growth rate (1/s)", "frequency (rad/s)", items, x_range, y_range, height=1.1)


def _shaded(x_range: Range, y_range: Range) -> list[Item]:
    corners = np.array([0.0, x_range[1], x_range[1], 0.0])
    return [
        Area(corners, np.repeat(y_range, 2), "unstable", 0.1),
        Rule(0.0, "x", "ink", width=1.2),
    ]


def _points(dataset: "xarray.Dataset", mode: str) -> tuple[Array, Array]:
    """Return growth and frequency of a mode at the airspeed of the model, shape (models, roots)."""
    values = dataset["flight_eigenvalue"].values
    return _of_mode(values, dataset["flight_mode"].values, mode)


def _paths(dataset: "xarray.Dataset", mode: str) -> list[tuple[Array, Array]]:
    """Return for each model growth and frequency against airspeed, shape (speeds, roots)."""
    if "swept_eigenvalue" not in dataset:
        return []
    values, modes = dataset["swept_eigenvalue"].values, dataset["swept_mode"].values
    return [_of_mode(v, m, mode) for v, m in zip(values, modes, strict=True)]


def _of_mode(values: Array, modes: Array, mode: str) -> tuple[Array, Array]:
    """Return growth and frequency of the roots of a mode, two columns, nan where there are none.

    An oscillation is one root, without its conjugate. The first column is the root that stays when
    the mode has lost one: of the phugoid the one that grows most, of the short period the one that
    decays most.
    """
    chosen = (modes == mode) & (values.imag >= 0.0)
    growth = np.where(chosen, values.real, np.nan)
    frequency = np.where(chosen, values.imag, np.nan)
    rank = -growth if mode == _MODES[0] else growth
    order = np.argsort(np.where(chosen, rank, np.inf), axis=-1, kind="stable")[..., :2]
    return np.take_along_axis(growth, order, -1), np.take_along_axis(frequency, order, -1)


def _upwards(values: Array, room: float) -> Range:
    """Return a range that holds zero and all values, with room for a name at the top."""
    whole = np.append(values.ravel(), 0.0)
    low, high = padded(whole, room) if np.nanmax(np.abs(whole)) > 0.0 else (-0.1, 1.0)
    return low, high + 0.16 * (high - low)


def _against(dataset: "xarray.Dataset", mode: str, quantity: str) -> Panel:
    speed = dataset["speed"].values
    which = 0 if quantity.startswith("growth") else 1
    paths = _paths(dataset, mode)
    curves = [path[which] for path in paths]
    y_range = _upwards(np.concatenate([curve.ravel() for curve in curves]), 0.08)
    items: list[Item] = [Rule(0.0, "y", "ink", width=1.0)]
    for at, curve in enumerate(curves):
        items += _curves(dataset, at, curve, paths[at][1] > 0.0)
    items.append(_name(dataset, mode, y_range))
    return Panel("airspeed (m/s)", quantity, items, _across(speed), y_range, height=0.8)


def _curves(dataset: "xarray.Dataset", at: int, curve: Array, oscillates: Array) -> list[Item]:
    """Return the lines of one model, with a mark at each of a few airspeeds."""
    name, speed = _models(dataset)[at], dataset["speed"].values
    items: list[Item] = []
    for column in range(curve.shape[1]):
        y = curve[:, column]
        if column:
            y = np.where(y == curve[:, 0], np.nan, y)
        if not np.isfinite(y).any():
            continue
        broken = _broken(speed, y, oscillates[:, column])
        items.append(Line(*broken, _color(at), _dash(at), 1.6, name=name, label=name))
        items += _steps(dataset, at, speed, y)
    return items


def _broken(x: Array, y: Array, oscillates: Array) -> tuple[Array, Array]:
    """Return a curve that is cut where a real root and an oscillation follow each other."""
    cuts = np.flatnonzero(oscillates[1:] != oscillates[:-1]) + 1
    return np.insert(x, cuts, np.nan), np.insert(y, cuts, np.nan)


def _steps(dataset: "xarray.Dataset", at: int, x: Array, y: Array) -> list[Item]:
    """Return a small mark at each of a few airspeeds; of many, where no line can be drawn."""
    marked = np.isfinite(x) & np.isfinite(y)
    if len(x) > _MOST_MARKS:
        around = np.pad(marked, 1)
        marked &= ~(around[:-2] | around[2:])
    if not marked.any():
        return []
    name = [_models(dataset)[at]] * int(marked.sum())
    return [Marks(x[marked], y[marked], _symbol(at), _color(at), "", 0.65 * _size(at), name)]


def _product_words(dataset: "xarray.Dataset") -> str:
    """Return what stands bottom left, and whether it hardly changes."""
    values = dataset["phugoid_product"].values
    known = [row[np.isfinite(row)] for row in values]
    steady = all(row.size > 1 and np.ptp(row) < _HARDLY * row.max() for row in known)
    text = "Bottom left: frequency times airspeed of a phugoid that oscillates"
    return f"{text}, which hardly changes." if steady else f"{text}."


def _product(dataset: "xarray.Dataset") -> Panel:
    speed, product = dataset["speed"].values, dataset["phugoid_product"].values
    constant = math.sqrt(2.0) * float(dataset.attrs["gravity"])
    top = 1.35 * np.nanmax(np.append(product.ravel(), constant))
    y_range = (0.0, float(top))
    items: list[Item] = [Rule(constant, "y", "ink", "dot", 1.4)]
    for at in range(len(product)):
        curve = product[at][:, None]
        items += _curves(dataset, at, curve, np.isfinite(curve))
    items.append(_name(dataset, "phugoid frequency × airspeed", y_range))
    return Panel("airspeed (m/s)", "product (m/s²)", items, _across(speed), y_range, height=0.8)


def _lift(dataset: "xarray.Dataset") -> Panel:
    speed, lift = dataset["speed"].values, dataset["swept_lift_coefficient"].values
    y_range = (0.0, 1.35 * float(np.max(lift)))
    items: list[Item] = [
        Line(speed, lift, "ink", "solid", 1.6, name="lift coefficient"),
        _name(dataset, "lift coefficient of level flight", y_range),
    ]
    return Panel("airspeed (m/s)", "lift coefficient", items, _across(speed), y_range, height=0.8)


def _name(dataset: "xarray.Dataset", text: str, y_range: Range) -> Note:
    left = _across(dataset["speed"].values)[0]
    return Note(left, y_range[1], text, "ink", "left", "top", 5, -4, bold=True)


def _across(speed: Array) -> Range:
    return padded(speed, 0.04)


def _color(at: int) -> str:
    return f"series{at % SERIES}"


def _symbol(at: int) -> Symbol:
    return _SYMBOLS[at % len(_SYMBOLS)]


def _size(at: int) -> float:
    return _SIZES[at % len(_SIZES)]


def _dash(at: int) -> Dash:
    return _DASHES[at % len(_DASHES)]
