"""What several pictures share: the swept fold angle, labels at line ends, the range to show."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.plots.picture import Array, Dash, Note, Range, padded, spread
from foldwing.results.cases import degrees
from foldwing.results.schema import fold_angle_names

if TYPE_CHECKING:
    import xarray

WIDTH_INCHES = 8.0
"""Width of a picture."""
PANEL_INCHES = 2.6
"""Height of a panel whose relative height is 1."""
ROUND_OFF = 1e-6
"""Growth below this fraction of the largest decay is none."""
_TEXT_INCHES = 0.155
"""Line spacing of labels."""


@dataclass(frozen=True)
class Sweep:
    """The angle that varies along the horizontal axis.

    Attributes
    ----------
    name : str
        Coordinate, ``fold`` (the case index) for a wing without hinges.
    values : array, shape (fold,)
    label : str
    rest : str
        The other hinges in words.
    single : bool
        Whether each value stands for one case, so that neighbours may be joined by lines.
    """

    name: str
    values: Array
    label: str
    rest: str
    single: bool

    @property
    def order(self) -> Array:
        """Cases in increasing order of the angle."""
        return np.argsort(self.values, kind="stable")


def sweep(dataset: "xarray.Dataset") -> Sweep:
    """Return what varies: the attribute ``swept``, else the first angle that is not constant."""
    names = fold_angle_names(dataset)
    moving = [name for name in names if np.ptp(dataset[name].values) > 0] if _many(dataset) else []
    name = str(dataset.attrs.get("swept") or (moving or names or ["fold"])[0])
    if name not in names:
        values = np.arange(dataset.sizes["fold"], dtype=float)
        return Sweep("fold", values, "case", "", True)
    values = np.asarray(dataset[name].values, float)
    rest = ", ".join(_in_words(dataset, other) for other in names if other != name)
    return Sweep(name, values, angle_label(name), rest, len(np.unique(values)) == len(values))


def angle_label(name: str) -> str:
    """Return the axis label of ``fold_2``, ``fold_3``, ..."""
    return f"fold angle of hinge {name.removeprefix('fold_')} (degrees)"


def _many(dataset: "xarray.Dataset") -> bool:
    return int(dataset.sizes["fold"]) > 1


def _in_words(dataset: "xarray.Dataset", name: str) -> str:
    values = np.asarray(dataset[name].values, float)
    hinge = f"hinge {name.removeprefix('fold_')}"
    if np.ptp(values) == 0:
        return f"{hinge} at {degrees(values[0])}"
    return f"{hinge} from {degrees(values[0])} to {degrees(values[-1])}"


def dash_of(name: str) -> Dash:
    """Return a dash by family, so that colour is not the only difference: T twisting, D real.

    Phugoid and short period of an aircraft have their own.
    """
    motions: Mapping[str, Dash] = {"phugoid": "dashdot", "short period": "longdash"}
    families: Mapping[str, Dash] = {"T": "dash", "D": "dot"}
    if name == "pitch":
        return families["T"]
    return motions.get(name) or families.get(name[:1], "solid")


def end_labels(
    ends: Sequence[tuple[float, str, str]],
    x: float,
    y_range: Range,
    log_y: bool = False,
    height: float = 1.0,
) -> list[Note]:
    """Return the names of lines to the right of a panel, moved apart where they would overlap.

    Parameters
    ----------
    ends : sequence of (y, text, color)
        Last point of each line; those outside ``y_range`` get no label.
    x : float
        Right-hand end of the panel.
    y_range : tuple of float
    log_y : bool
    height : float
        Relative height of the panel.
    """
    shown = [end for end in ends if y_range[0] <= end[0] <= y_range[1]]
    if not shown:
        return []
    scale: Any = np.log10 if log_y else np.asarray
    low, high = (float(scale(limit)) for limit in y_range)
    gap = (high - low) * min(_TEXT_INCHES / (PANEL_INCHES * height), 1.0 / len(shown))
    wanted = np.asarray(scale([end[0] for end in shown]), float)
    placed = _within(spread(wanted, gap), (low, high), gap)
    heights = 10.0**placed if log_y else placed
    return [
        Note(x, float(y), text, color, dx=6, bold=True)
        for y, (_, text, color) in zip(heights, shown, strict=True)
    ]


def _within(values: Array, limits: Range, gap: float) -> Array:
    """Push values that keep a gap into a range that has room for them."""
    rank = np.argsort(np.argsort(values, kind="stable"), kind="stable")
    lowered = np.minimum(values, limits[1] - gap * (len(values) - 1 - rank))
    raised: Array = np.maximum(lowered, limits[0] + gap * rank)
    return raised


def upright_labels(
    events: Sequence[tuple[float, str, str]], y: float, x_range: Range, inches: float
) -> list[Note]:
    """Return texts along vertical rules, moved apart: (x, text, color) each."""
    if not events:
        return []
    gap = _TEXT_INCHES * 1.15 / inches * (x_range[1] - x_range[0])
    offset = 0.55 * gap
    rules = np.array([event[0] for event in events])
    placed = _left_of_rules(rules, offset, gap)
    if placed.min() < x_range[0] + offset:
        placed = _within(spread(rules - offset, gap), (x_range[0], x_range[1] - offset), gap)
    return [
        Note(float(x), y, text, color, "center", "bottom", dy=4, upright=True)
        for x, (_, text, color) in zip(placed, events, strict=True)
    ]


def _left_of_rules(rules: Array, offset: float, gap: float) -> Array:
    """Return places left of each rule, a gap apart, that no rule runs through."""
    placed, limit = np.empty(len(rules)), np.inf
    for index in np.argsort(rules, kind="stable")[::-1]:
        place = min(rules[index] - offset, limit)
        for rule in np.sort(rules)[::-1]:
            if abs(place - rule) < 0.99 * offset:
                place = rule - offset
        placed[index], limit = place, place - gap
    return placed


def focused(growth: Array, depth: float) -> Range:
    """Return a range of growth rates that shows the unstable ones and ``depth`` times as much."""
    finite = growth[np.isfinite(growth)]
    if not finite.size:
        return (-1.0, 1.0)
    low, high = padded(finite)
    if finite.max() <= ROUND_OFF * abs(finite.min()):
        return (low, max(high, 0.08 * (high - low)))
    top = 1.15 * float(finite.max())
    return (max(low, -depth * top), top)


def subtitle(dataset: "xarray.Dataset", *more: str) -> str:
    """Return the model, the method and the damping, for the line below a title."""
    parts = (dataset.attrs["title"], dataset.attrs["method"], *_damping(dataset), *more)
    return " · ".join(filter(None, parts))


def subject(dataset: "xarray.Dataset") -> str:
    """Return what the dataset is about: ``wing``, ``aircraft`` or ``section``."""
    if dataset.attrs["kind"] == "section":
        return "section"
    bodies = dataset["body"].values.tolist() if "body" in dataset.coords else []
    return "aircraft" if "slowest_speed" in dataset or "aircraft" in bodies else "wing"


def threshold(dataset: "xarray.Dataset") -> float:
    """Return the damping ratio of the boundary, positive stable."""
    return float(dataset.attrs.get("damping_threshold", 0.0))


def _damping(dataset: "xarray.Dataset") -> list[str]:
    """Return structural damping and threshold in words, where they are not zero."""
    words = []
    if damping := float(dataset.attrs.get("damping", 0.0)):
        words.append(f"structural damping ratio {damping:g}")
    if limit := threshold(dataset):
        words.append(f"boundary at damping ratio {limit:g}".replace("-", "−"))
    return words
