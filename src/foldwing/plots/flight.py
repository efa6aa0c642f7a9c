"""Flight paths of a rigid aircraft in each of its motions, with the pitch angle as arrows."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import PANEL_INCHES, subtitle
from foldwing.plots.picture import Array, Item, Line, Marks, Note, Panel, Picture, Range, Rule

if TYPE_CHECKING:
    import xarray

MODE_COLORS = {"phugoid": "series0", "short period": "series1", "third oscillation": "series2"}
"""Role of the colour of each mode."""

_ARROWS = 12
"""Equal intervals of time between arrows."""
_SIZE = (2.945, PANEL_INCHES)
"""Width and height of a panel in inches, of two beside each other."""
_ARROW, _HEAD, _OPENING = 0.4, 0.075, 0.45
"""Length of an arrow and of its head in inches, and half the angle of the head in rad."""
_TURNED = 4.0
"""Times the pitch angle by which arrows turn where the scale along both axes is the same."""
_TOP, _ROOM = 0.3, 0.12
"""Room for the name at the top of a panel in inches, and around the path as a share."""

_PITCH = "pitch, at equal times"
_STEADY = "steady flight"


def flight_paths(dataset: "xarray.Dataset") -> Picture | None:
    """Draw height against the distance flown over the ground, a panel for each motion."""
    if "path_distance" not in dataset:
        return None
    panels = [_absolute(dataset, motion) for motion in range(dataset.sizes["flight_motion"])]
    return Picture(
        "flight-paths",
        f"Paths over the ground after a disturbance at {_airspeed(dataset)}",
        f"{subtitle(dataset)}. Height is stretched, and the arrows with it: along the path where "
        f"the angle of attack stays as in level flight. {_amplitude(dataset)}",
        panels,
        columns=min(2, len(panels)),
    )


def flight_paths_relative(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the same paths as seen from a point that flies on steadily."""
    if "path_ahead" not in dataset:
        return None
    panels = [_relative(dataset, motion) for motion in range(dataset.sizes["flight_motion"])]
    return Picture(
        "flight-paths-relative",
        "The same paths seen from an aircraft that flies on undisturbed",
        f"{subtitle(dataset)}. One scale along both axes; arrows turn {_TURNED:g} times as far "
        f"as the aircraft pitches. The path begins at the square. {_amplitude(dataset)}",
        panels,
        columns=min(2, len(panels)),
    )


def _airspeed(dataset: "xarray.Dataset") -> str:
    return f"{dataset.attrs['airspeed']:.4g} m/s"


def _amplitude(dataset: "xarray.Dataset") -> str:
    """Return how large the motions are drawn, in a sentence."""
    share = 100.0 * float(dataset.attrs["amplitude"])
    degrees = np.degrees(float(dataset.attrs["amplitude"]))
    return f"Airspeed, incidence or pitch change by up to {share:g}\u00a0% or {degrees:.1f}°."


def _absolute(dataset: "xarray.Dataset", motion: int) -> Panel:
    x, y = (dataset[f"path_{name}"].values[motion] for name in ("distance", "altitude"))
    x_range, y_range = _range(x, _ROOM), _headed(_range(y, 1.5 * _ROOM))
    items: list[Item] = [Rule(0.0, "y", "muted", "dash", 1.2)]
    items += _path(dataset, motion, (x, y), (x_range, y_range), 1.0)
    items.append(Line(np.array([np.nan]), np.array([np.nan]), "muted", "dash", label=_STEADY))
    return Panel("distance flown (m)", "height (m)", items, x_range, y_range)


def _relative(dataset: "xarray.Dataset", motion: int) -> Panel:
    x, y = (dataset[f"path_{name}"].values[motion] for name in ("ahead", "altitude"))
    x_range, y_range = _square(np.append(x, 0.0), np.append(y, 0.0))
    origin = Marks(np.zeros(1), np.zeros(1), "x", "ink", _STEADY, 6.0)
    start = Marks(x[:1], y[:1], "square", _color(dataset, motion), "", 5.5)
    items = [*_path(dataset, motion, (x, y), (x_range, y_range), _TURNED), start, origin]
    labels = "ahead of steady flight (m)", "height above it (m)"
    return Panel(*labels, items, x_range, y_range, x_ticks=_ticks(x_range), equal=True)


def _ticks(ends: Range) -> list[tuple[float, str]]:
    """Return four or five round values within a range, with their texts."""
    least = (ends[1] - ends[0]) / 5.0
    unit = 10.0 ** np.floor(np.log10(least))
    step = float(unit * next(n for n in (1.0, 2.0, 5.0, 10.0) if n * unit >= least))
    first, last = int(np.ceil(ends[0] / step)), int(np.floor(ends[1] / step))
    return [(n * step, f"{n * step:.3g}".replace("-", "−")) for n in range(first, last + 1)]


def _path(
    dataset: "xarray.Dataset",
    motion: int,
    path: tuple[Array, Array],
    ranges: tuple[Range, Range],
    turned: float,
) -> list[Item]:
    """Return a path with its name and its arrows, turned by a multiple of the pitch angle."""
    mode, color = str(dataset["motion_mode"].values[motion]), _color(dataset, motion)
    step = (len(path[0]) - 1) // _ARROWS
    slope = np.tan(turned * np.radians(dataset["path_pitch"].values[motion][::step]))
    arrows = _arrows(path[0][::step], path[1][::step], slope, ranges)
    seconds = float(dataset["path_time"].values[motion][-1]) / _ARROWS
    value = complex(dataset["motion_eigenvalue"].values[motion])
    kind = "" if value.imag else ", aperiodic"
    corner = (ranges[0][0], ranges[1][1])
    return [
        Line(*path, color, "solid", 1.8, name=mode),
        Line(*arrows, "ink", "solid", 1.2, label=_PITCH),
        Note(*corner, f"{mode}{kind}", color, "left", "top", 5, -4, bold=True),
        Note(
            ranges[0][1],
            corner[1],
            f"every {seconds:.2g} s",
            "muted",
            "right",
            "top",
            -5,
            -4,
        ),
    ]


def _color(dataset: "xarray.Dataset", motion: int) -> str:
    return MODE_COLORS[str(dataset["motion_mode"].values[motion])]


def _arrows(x: Array, y: Array, slope: Array, ranges: tuple[Range, Range]) -> tuple[Array, Array]:
    """Return arrows of one length on paper, in the direction of a slope in the units of the axes.

    Parameters
    ----------
    x, y : array, shape (n,)
        Their middles.
    slope : array, shape (n,)
    ranges : (x_range, y_range)
        Of the panel.
    """
    scale = np.array([size / np.ptp(ends) for size, ends in zip(_SIZE, ranges, strict=True)])
    along = np.stack([np.full_like(slope, scale[0]), slope * scale[1]], axis=1)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    tip, tail = 0.5 * _ARROW * along, -0.5 * _ARROW * along
    back = _HEAD * np.cos(_OPENING) * along
    side = _HEAD * np.sin(_OPENING) * across
    gap = np.full_like(tip, np.nan)
    parts = np.stack([tail, tip, tip - back + side, tip, tip - back - side, gap], axis=1)
    points = np.stack([x, y], axis=1)[:, None, :] + parts / scale
    flat = points.reshape(-1, 2)
    return flat[:, 0], flat[:, 1]


def _range(values: Array, share: float) -> Range:
    """Return a range with room on both sides."""
    low, high = float(np.min(values)), float(np.max(values))
    room = share * (high - low) or 1.0
    return low - room, high + room


def _headed(values: Range) -> Range:
    """Return a range with room for a name at its top."""
    return values[0], values[0] + (values[1] - values[0]) / (1.0 - _TOP / _SIZE[1])


def _square(x: Array, y: Array) -> tuple[Range, Range]:
    """Return ranges in which a metre is as long along both axes."""
    # Arrows reach out of the path by half their length on either side.
    across, upright = _SIZE[0] - _ARROW, _SIZE[1] - _TOP
    unit = max(np.ptp(x) / across, np.ptp(y) / upright) * (1.0 + 2.0 * _ROOM) or 1.0
    x_mid, y_mid = (0.5 * float(v.min() + v.max()) for v in (x, y))
    half, low = 0.5 * unit * _SIZE[0], y_mid - 0.5 * unit * upright
    return (x_mid - half, x_mid + half), (low, low + unit * _SIZE[1])
