"""Views in space as matplotlib figures: a parallel projection, drawn from back to front.

The views are simple enough to be projected here: sheets, lines and texts. That is several times
faster than three-dimensional axes and sorts the faces of all sheets together.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from foldwing.plots.picture import Array, Dot, Picture, Scene, SceneItem, Surface, Thread
from foldwing.plots.static_base import (
    WIDTH,
    Colors,
    color_map,
    new_figure,
    wrapped,
    write_head,
)

_MARGIN = 0.1
_BAR = 0.62
"""Height of a scale of colours with its label in inches."""

_LEGEND = 0.3
"""Height of the legend in inches."""

Range = tuple[float, float]
View = tuple[float, float]
"""Azimuth and elevation from which a scene is seen, in degrees."""


class Window(NamedTuple):
    """The part of the paper that is shown, and whence it is seen."""

    across: Range
    up: Range
    view: View


def draw_scenes(picture: Picture, colors: Colors) -> Figure:
    """Return views in space side by side, all at one scale."""
    scenes = [scene for scene in picture.panels if isinstance(scene, Scene)]
    columns, rows = picture.columns, -(-len(scenes) // picture.columns)
    caption = wrapped(picture.caption)
    head = 0.42 + 0.19 * len(caption)
    width = (WIDTH - 2 * _MARGIN) / columns
    window = _window([*(scene.items for scene in scenes), *picture.frames], picture.view)
    shape = (window.up[1] - window.up[0]) / (window.across[1] - window.across[0])
    bar = _BAR if any(scene.graded for scene in scenes) else 0.0
    height = min(max(shape * width, 1.1), 4.5) + 0.3 + bar
    legend = {d.label: d for s in scenes for d in s.items if isinstance(d, Dot) and d.label}
    foot = _LEGEND if legend else 0.0
    total = head + rows * height + 0.1 + foot
    figure = new_figure(WIDTH, total, colors)
    write_head(figure, picture.title, caption, colors)
    for number, scene in enumerate(scenes):
        row, column = divmod(number, columns)
        place = (
            (_MARGIN + column * width) / WIDTH,
            (total - head - (row + 1) * height + bar) / total,
            width / WIDTH,
            (height - 0.3 - bar) / total,
        )
        _draw(figure.add_axes(place), scene, window, colors)
        _add_scale(figure, scene, place, colors)
    if legend:
        _add_legend(figure, legend, colors)
    return figure


def _add_legend(figure: Figure, legend: dict[str, Dot], colors: Colors) -> None:
    """Name the marks below the scenes."""
    handles = [Line2D([], [], linestyle="none", **_marker(dot, colors)) for dot in legend.values()]
    box = figure.legend(
        handles,
        list(legend),
        loc="lower left",
        bbox_to_anchor=(_MARGIN / WIDTH, 0.04 / figure.get_figheight()),
        ncols=len(legend),
        frameon=False,
        fontsize=8.5,
        labelcolor=colors["ink"],
        handletextpad=0.3,
    )
    box.set_in_layout(False)


def _add_scale(
    figure: Figure, scene: Scene, place: tuple[float, float, float, float], colors: Colors
) -> None:
    """Add the scale of colours below a scene."""
    sheet = scene.graded
    if sheet is None:
        return
    left, lower, width, _ = place
    high = figure.get_figheight()
    axes = figure.add_axes((left + 0.15 * width, lower - 0.16 / high, 0.7 * width, 0.1 / high))
    shown = ScalarMappable(Normalize(*sheet.limits), color_map(sheet.scale, colors))
    bar = figure.colorbar(shown, cax=axes, orientation="horizontal")
    if scene.ticks:
        bar.set_ticks(list(scene.ticks))
    bar.set_label(scene.value_label, color=colors["ink"], size=9)
    axes.tick_params(colors=colors["ink"], labelsize=8.5, length=3)
    bar.outline.set_visible(False)


def project(points: Array, view: View) -> tuple[Array, Array]:
    """Return the place on the paper, shape (..., 2), and the depth of points (x, y, z)."""
    azimuth, elevation = np.radians(view)
    forward, side, up = points[..., 0], points[..., 1], points[..., 2]
    c, s = np.cos(azimuth), np.sin(azimuth)
    across, away = c * side - s * forward, -s * side - c * forward
    tilt_c, tilt_s = np.cos(elevation), np.sin(elevation)
    paper = np.stack([across, tilt_c * up + tilt_s * away], axis=-1)
    return paper, tilt_c * away - tilt_s * up


def _window(scenes: Sequence[Sequence[SceneItem]], view: View) -> Window:
    """Return the part of the paper that all scenes need, those of a film too."""
    places = (project(points, view)[0] for items in scenes for points in _points(items))
    parts = [place.reshape(-1, 2) for place in places]
    parts = [part[np.isfinite(part).all(axis=1)] for part in parts]
    flat = np.concatenate(parts)
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = 0.06 * (high - low).max()
    return Window((low[0] - room, high[0] + room), (low[1] - room, high[1] + room), view)


def _points(items: Sequence[SceneItem]) -> Iterator[Array]:
    for item in items:
        if isinstance(item, Surface):
            yield np.stack([item.x, item.y, item.z], axis=-1)
        else:
            yield item.points if isinstance(item, Thread) else item.point


def _draw(axes: Axes, scene: Scene, window: Window, colors: Colors) -> None:
    axes.set_axis_off()
    axes.set_aspect("equal")
    axes.set_xlim(window.across)
    axes.set_ylim(window.up)
    axes.set_title(scene.title, color=colors["ink"], size=10, weight="bold", pad=4)
    sheets = [item for item in scene.items if isinstance(item, Surface)]
    _draw_surfaces(axes, sheets, window.view, colors)
    for item in scene.items:
        if isinstance(item, Thread):
            _draw_thread(axes, item, window.view, colors)
        elif isinstance(item, Dot):
            x, y = project(item.point, window.view)[0]
            axes.plot([x], [y], zorder=5 if item.filled else 4, **_marker(item, colors))
        elif not isinstance(item, Surface):
            x, y = project(item.point, window.view)[0]
            axes.text(x, y, item.text, color=colors[item.color], size=8, ha="center", va="center")


def _marker(dot: Dot, colors: Colors) -> dict[str, Any]:
    """Return how a mark looks: filled ones get a rim in the colour of the paper."""
    color = colors[dot.color]
    return {
        "marker": "o",
        "markersize": dot.size,
        "markerfacecolor": color if dot.filled else "none",
        "markeredgecolor": colors["paper"] if dot.filled else color,
        "markeredgewidth": 0.7 if dot.filled else 1.4,
    }


def _draw_surfaces(axes: Axes, surfaces: list[Surface], view: View, colors: Colors) -> None:
    """Draw the faces of all sheets, the farthest first."""
    faces, depths, fills, edges = [], [], [], []
    for surface in surfaces:
        paper, depth = project(np.stack([surface.x, surface.y, surface.z], axis=-1), view)
        corners = _corners(paper).reshape(-1, 4, 2)
        faces.append(corners)
        depths.append(_corners(depth[..., None]).mean(axis=2).ravel())
        fills.append(_fills(surface, colors))
        edge = "ink" if surface.values is not None else "muted"
        edges.append(np.tile(to_rgba(colors[edge], 0.22 * surface.opacity), (len(corners), 1)))
    order = np.argsort(-np.concatenate(depths), kind="stable")
    axes.add_collection(
        PolyCollection(
            list(np.concatenate(faces)[order]),
            facecolors=np.concatenate(fills)[order].tolist(),
            edgecolors=np.concatenate(edges)[order].tolist(),
            linewidths=0.3,
        ),
        autolim=False,
    )


def _corners(grid: Array) -> Array:
    """Return the four corners of each face, shape (n - 1, m - 1, 4, k)."""
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2)


def _fills(surface: Surface, colors: Colors) -> Array:
    count = (surface.x.shape[0] - 1) * (surface.x.shape[1] - 1)
    if surface.values is None:
        return np.tile(to_rgba(colors[surface.color], surface.opacity), (count, 1))
    values = surface.values.ravel()
    if not surface.by_face:
        values = _corners(surface.values[..., None]).mean(axis=2).ravel()
    fills: Array = color_map(surface.scale, colors)(Normalize(*surface.limits)(values))
    fills[:, 3] = surface.opacity
    return fills


def _draw_thread(axes: Axes, thread: Thread, view: View, colors: Colors) -> None:
    paper = project(thread.points, view)[0]
    style: dict[str, Any] = {"color": colors[thread.color], "alpha": thread.opacity}
    style["linewidth"] = thread.width
    if thread.arrow:
        axes.annotate(
            "", paper[-1], paper[0], arrowprops={"arrowstyle": "-|>", "shrinkA": 0, **style}
        )
        return
    axes.plot(paper[:, 0], paper[:, 1], zorder=0.5 if thread.opacity < 1 else 3, **style)
