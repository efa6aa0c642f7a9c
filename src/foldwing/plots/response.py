"""The response in time to a tap on the tip, with the motion identified in it."""

from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.plots.layout import subtitle
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import Array, Item, Line, Panel, Picture, Range
from foldwing.results.cases import fold_text

if TYPE_CHECKING:
    import xarray

_GROWTH_DIGITS = 3
_MOST_PANELS = 2
"""Modes shown: those in which the identified motion is largest."""


def response(dataset: "xarray.Dataset") -> Picture | None:
    """Draw modal displacements against time; None for a dataset without a response."""
    if "response" not in dataset:
        return None
    variable = dataset["response"]
    envelope = dataset["response_envelope"].values
    size = np.nan_to_num(np.nanmax(envelope, axis=0, initial=0.0))
    shown = np.argsort(-size)[:_MOST_PANELS]
    panels = [_panel(dataset, int(mode)) for mode in shown]
    attrs = variable.attrs
    return Picture(
        "response",
        f"How the wing moves after a tap on its tip at {attrs['speed']:.4g} m/s",
        subtitle(dataset, fold_text(dataset, 0)) + f". {_identified(attrs)} Shown are "
        "the modes in which it is largest; 1 is the largest displacement of any mode.",
        panels,
    )


def _identified(attrs: dict[str, Any]) -> str:
    """Return what was identified and what the eigenvalue says, in a sentence."""
    found = _motion(attrs["frequency"], attrs["growth"])
    value = _motion(attrs["eigenvalue_frequency"], attrs["eigenvalue_growth"])
    text = f"The dashed envelope is the motion identified in the response: {found}"
    return f"{text} (eigenvalue: {value}).".replace("-", "−")


def _motion(frequency: float, growth: float) -> str:
    rounded = round(growth, _GROWTH_DIGITS) + 0.0
    return f"{frequency:.4g} Hz, growth {rounded:g} 1/s"


def _panel(dataset: "xarray.Dataset", mode: int) -> Panel:
    time = dataset["time"].values
    q = dataset["response"].values[:, mode]
    envelope = dataset["response_envelope"].values[:, mode]
    name = str(dataset["mode_name"].values[0, mode])
    items: list[Item] = [
        Line(time, q, mode_colors(dataset)[name], "solid", 1.2, name=f"mode {name}"),
        Line(time, envelope, "ink", "dash", 1.2, name="envelope", label="identified envelope"),
        Line(time, -envelope, "ink", "dash", 1.2, name="envelope"),
    ]
    return Panel(
        "time (s)",
        f"displacement of mode {name}",
        items,
        (float(time[0]), float(time[-1])),
        _symmetric(q, envelope),
    )


def _symmetric(*values: Array) -> Range:
    top = 1.08 * max(float(np.nanmax(np.abs(value), initial=0.0)) for value in values)
    return (-top, top) if top > 0.0 else (-1.0, 1.0)
