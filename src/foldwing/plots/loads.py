"""Pressure on the folded wing and circulation along it, at flutter."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.energy import in_words, onsets
from foldwing.plots.events import color_of
from foldwing.plots.layout import subtitle
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import (
    Array,
    Dash,
    Item,
    Line,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    Scale,
    Scene,
    Surface,
)
from foldwing.plots.shapes import box_around, sheets, signs
from foldwing.results.cases import fold_text

if TYPE_CHECKING:
    import xarray

_MOST_ONSETS = 3
_VIEW = (-12.0, 52.0)
"""From above, so that segments folded down show their upper side as well."""
_DASHES: tuple[Dash, ...] = ("solid", "dash", "dot")
_ANGLES = (-180.0, -90.0, 0.0, 90.0, 180.0)
_PHASE_LABEL = "phase, ahead of the motion (degrees)"


def pressure(dataset: "xarray.Dataset") -> Picture | None:
    """Draw amplitude and phase of the pressure at the lowest flutter onset."""
    found = onsets(dataset)
    if "pressure" not in dataset or not found:
        return None
    index, row = found[0]
    values = dataset["pressure"].values[index]
    scenes = [
        _amplitude(dataset, "amplitude", values),
        _phase(dataset, "phase", values),
    ]
    title = f"Pressure of the air on the wing as flutter begins: {in_words(row)}"
    return Picture("flutter-pressure", title, _caption(dataset), scenes, columns=2, view=_VIEW)


def pressure_of_modes(dataset: "xarray.Dataset") -> Picture | None:
    """Draw what each of the leading modes adds to the pressure at the lowest flutter onset."""
    if "mode_pressure" not in dataset:
        return None
    index = int(dataset["mode_pressure"].attrs["flutter_point"])
    row = dict(onsets(dataset))[index]
    values, modes = dataset["mode_pressure"].values, dataset["leading_mode"].values
    names = dataset["mode_name"].values[0]
    shares = dataset["mode_share"].values[index]
    titles = [f"{names[m - 1]}: {100.0 * shares[m - 1]:.0f} % of the energy" for m in modes]
    upper = [_amplitude(dataset, t, v) for t, v in zip(titles, values, strict=True)]
    lower = [_phase(dataset, "", v) for v in values]
    return Picture(
        "flutter-pressure-modes",
        f"What each mode of vibration adds to this pressure: {in_words(row)}",
        _caption(dataset) + " Each mode moves as it does in the flutter motion, the others stand "
        "still; what all modes add is the pressure at flutter. Each has colours of its own.",
        [*upper, *lower],
        columns=len(upper),
        view=_VIEW,
    )


def flutter_circulation(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the circulation along the folded span at the lowest flutter onsets."""
    found = onsets(dataset)[:_MOST_ONSETS]
    if "circulation" not in dataset or not found:
        return None
    colors, hinges, end = mode_colors(dataset), *_stations(dataset)
    upper: list[Item] = [Rule(place, "x") for place in hinges]
    lower, top = [*upper], 0.0
    for (index, row), dash in zip(found, _DASHES, strict=False):
        span, values = _along_span(dataset, dataset["circulation"].values[index])
        line = Line(span, np.abs(values), color_of(row, colors), dash, label=in_words(row))
        x, phase = _unbroken(span, np.degrees(np.angle(values)))
        upper.append(line)
        lower.append(replace(line, x=x, y=phase))
        top = max(top, 1.12 * float(np.abs(values).max()))
    upper += _names(hinges, top)
    x_label, x_range = "way along the folded wing from the root (m)", (0.0, end)
    ticks = [(angle, f"{angle:g}".replace("-", "−")) for angle in _ANGLES]
    below = Panel(x_label, "phase (degrees)", lower, x_range, (-190.0, 190.0), y_ticks=ticks)
    return Picture(
        "flutter-circulation",
        "Circulation of the air around the wing as flutter begins",
        _caption(dataset, "circulation") + " Shown is the sum along the chord of each strip; "
        "positive circulation lifts.",
        [Panel(x_label, "circulation (m²/s)", upper, x_range, (0.0, top or 1.0)), below],
    )


def _caption(dataset: "xarray.Dataset", what: str = "pressure") -> str:
    amplitude = 1000.0 * float(dataset["pressure"].attrs["amplitude"])
    return (
        subtitle(dataset, fold_text(dataset, 0))
        + f". For a motion with a largest displacement of {amplitude:.3g} mm. Phase is relative to "
        f"that displacement: at 0° the {what} is highest when it is largest, at 90° a quarter of "
        "a cycle before, at −90° after."
    )


def _amplitude(dataset: "xarray.Dataset", title: str, values: Array) -> Scene:
    limits = (0.0, float(np.abs(values).max()) or 1.0)
    surfaces = _panels(dataset, np.abs(values), limits, "speed")
    return _scene(dataset, title, surfaces, "pressure, below less above (Pa)")


def _phase(dataset: "xarray.Dataset", title: str, values: Array) -> Scene:
    surfaces = _panels(dataset, np.degrees(np.angle(values)), (-180.0, 180.0), "cycle")
    return _scene(dataset, title, surfaces, _PHASE_LABEL, _ANGLES)


def _scene(
    dataset: "xarray.Dataset",
    title: str,
    surfaces: list[Surface],
    label: str,
    ticks: Sequence[float] = (),
) -> Scene:
    rest = sheets(dataset, dataset["position"].values[0])
    return Scene(title, [*surfaces, *signs(rest)], box_around(rest, []), label, ticks)


def _panels(dataset: "xarray.Dataset", values: Array, limits: Range, scale: Scale) -> list[Surface]:
    """Return one sheet of panels for each segment, each panel in one colour."""
    segment = dataset["panel_segment"].values
    corners = dataset["panel_position"].values
    rows = int(dataset["panel_chordwise"].values.max()) + 1
    surfaces = []
    for number in np.unique(segment):
        own = segment == number
        grid = corners[own].reshape(rows, -1, 4, 3)
        front = np.concatenate([grid[:, :, 0], grid[:, -1:, 1]], axis=1)
        back = np.concatenate([grid[-1:, :, 3], grid[-1:, -1:, 2]], axis=1)
        x, y, z = np.moveaxis(np.concatenate([front, back]), 2, 0)
        faces = values[own].reshape(rows, -1)
        surfaces.append(Surface(x, y, z, faces, limits, scale=scale))
    return surfaces


def _along_span(dataset: "xarray.Dataset", values: Array) -> tuple[Array, Array]:
    """Return the middle of each strip along the folded wing, and values summed along its chord."""
    strip = dataset["panel_spanwise"].values
    count = int(strip.max()) + 1
    total = np.zeros(count, values.dtype)
    np.add.at(total, strip, values)
    return dataset["panel_span"].values[:count], total


def _stations(dataset: "xarray.Dataset") -> tuple[list[float], float]:
    """Return the places of the hinges along the folded wing, and that of its tip."""
    position, segment = dataset["position"].values[0], dataset["segment"].values
    spans = []
    for grid in sheets(dataset, position):
        spans.append(float(np.linalg.norm(grid[-1, 0] - grid[0, 0])))
    ends = np.cumsum(spans).tolist()
    return ends[: len(np.unique(segment)) - 1], ends[-1]


def _names(hinges: Sequence[float], top: float) -> list[Note]:
    return [
        Note(place, top, f"hinge {number}", "muted", "center", "bottom", dy=2)
        for number, place in enumerate(hinges, start=2)
    ]


def _unbroken(x: Array, degrees: Array) -> tuple[Array, Array]:
    """Break a line where the angle leaves the range and comes in again at its other end."""
    jumps = np.flatnonzero(np.abs(np.diff(degrees)) > 180.0) + 1
    return np.insert(x, jumps, np.nan), np.insert(degrees, jumps, np.nan)
