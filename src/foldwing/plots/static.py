"""Pictures as matplotlib figures, without any global state."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize, to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.textpath import TextPath

from foldwing.plots.layout import PANEL_INCHES
from foldwing.plots.palette import THEMES
from foldwing.plots.picture import (
    Area,
    Array,
    Bars,
    Cells,
    Graded,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Rule,
    ZeroLine,
)
from foldwing.plots.static_base import (
    LINE,
    WIDTH,
    Colors,
    color_map,
    new_figure,
    wrapped,
    write_head,
)
from foldwing.plots.static_scenes import draw_scenes

_LEFT, _BOTTOM, _GAP, _ROW_GAP = 0.88, 0.52, 0.18, 0.62
_LEGEND_POINTS, _POINTS, _HANDLE = 8.5, 72.0, 0.62
"""Size of the text of a legend, points of an inch, and what a column needs besides its text."""
Box = tuple[float, float, float, float]
_DASHES: Mapping[str, Any] = {
    "solid": "-",
    "dash": (0, (5, 2)),
    "dot": (0, (1.2, 1.6)),
    "dashdot": (0, (6, 1.6, 1.2, 1.6)),
    "longdash": (0, (10, 2.5)),
}
_TITLE = 0.24
"""Height of the title of a panel in inches."""
_MARKERS = {
    "circle": "o",
    "circle-open": "o",
    "square": "s",
    "square-open": "s",
    "diamond": "D",
    "x": "x",
    "star": "*",
    "triangle": "^",
    "triangle-down": "v",
    "ring": "o",
}


def draw(picture: Picture, theme: str = "light") -> Figure:
    """Return a picture as a matplotlib figure.

    Parameters
    ----------
    picture : Picture
    theme : str
        ``light`` or ``dark``.
    """
    colors = THEMES[theme]
    if not all(isinstance(panel, Panel) for panel in picture.panels):
        return draw_scenes(picture, colors)
    panels = [panel for panel in picture.panels if isinstance(panel, Panel)]
    legend = _legend(panels, colors)
    caption = wrapped(picture.caption)
    head = 0.36 + LINE * len(caption) + 0.16
    foot = _BOTTOM + LINE * -(-len(legend) // _columns(legend)) + (0.12 if legend else 0.0)
    boxes, inner = _boxes(panels, picture)
    total = head + inner + foot
    figure = new_figure(WIDTH, total, colors)
    write_head(figure, picture.title, caption, colors)
    for panel, (left, top, width, height) in zip(panels, boxes, strict=True):
        below = total - head - top - height
        axes = figure.add_axes((left / WIDTH, below / total, width / WIDTH, height / total))
        _fill(axes, panel, colors, last=panel is panels[-1] or picture.columns > 1)
    if legend:
        _add_legend(figure, legend, colors)
    return figure


def _boxes(panels: list[Panel], picture: Picture) -> tuple[list[Box], float]:
    """Return left, top, width and height of each panel in inches, and the height of all."""
    columns = picture.columns
    gap = _GAP if columns == 1 else _ROW_GAP
    boxes, top = [], 0.0
    for first in range(0, len(panels), columns):
        row = panels[first : first + columns]
        top += _TITLE if any(panel.title for panel in row) else 0.0
        height = PANEL_INCHES * max(panel.height for panel in row)
        right = picture.right_margin + (0.75 if any(map(_graded, row)) else 0.0)
        width = (WIDTH - right) / columns - _LEFT
        boxes += [(_LEFT + i * (_LEFT + width), top, width, height) for i in range(len(row))]
        top += height + gap
    return boxes, top - gap


def _graded(panel: Panel) -> bool:
    return any(isinstance(item, Graded | Cells) for item in panel.items)


def _fill(axes: Axes, panel: Panel, colors: Colors, last: bool) -> None:
    axes.set_facecolor(colors["paper"])
    axes.set_axisbelow(True)
    axes.grid(True, color=colors["grid"], linewidth=0.7)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(colors["muted"])
    axes.tick_params(colors=colors["ink"], labelsize=9, labelbottom=last, length=3)
    if panel.title:
        axes.set_title(panel.title, color=colors["ink"], size=9.5, weight="bold", loc="left")
    axes.set_ylabel(panel.y_label, color=colors["ink"], size=9.5)
    axes.yaxis.set_label_coords(-0.64 / (WIDTH * axes.get_position().width), 0.5)
    if last:
        axes.set_xlabel(panel.x_label, color=colors["ink"], size=9.5)
    if panel.log_x:
        axes.set_xscale("log")
    if panel.log_y:
        axes.set_yscale("log")
    for number, item in enumerate(panel.items):
        _DRAW[type(item)](axes, item, colors, 2.0 + 0.01 * number)
    if panel.x_range:
        axes.set_xlim(panel.x_range)
    if panel.y_range:
        axes.set_ylim(panel.y_range)
    if panel.equal:
        axes.set_aspect("equal", adjustable="datalim")
    _show_whole_marks(axes)
    _set_ticks(axes, panel)
    _add_scale(axes, panel, colors)


def _show_whole_marks(axes: Axes) -> None:
    """Let the marks at the edge of a panel stand beyond it."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    for line in axes.lines:
        x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
        within = (x >= left) & (x <= right) & (y >= bottom) & (y <= top)
        if line.get_linestyle() == "None" and within.all():
            line.set_clip_on(False)


def _set_ticks(axes: Axes, panel: Panel) -> None:
    for ticks, axis in ((panel.x_ticks, axes.xaxis), (panel.y_ticks, axes.yaxis)):
        if ticks is not None:
            axis.set_ticks([at for at, _ in ticks], [text for _, text in ticks])
            axis.minorticks_off()


def _line(axes: Axes, line: Line, colors: Colors, order: float) -> None:
    axes.plot(
        line.x,
        line.y,
        color=colors[line.color],
        linestyle=_DASHES[line.dash],
        linewidth=line.width,
        alpha=line.opacity,
        zorder=order,
    )


def _graded_line(axes: Axes, line: Graded, colors: Colors, order: float) -> None:
    points = np.stack([line.x, line.y], axis=1)
    segments = np.stack([points[:-1], points[1:]], axis=1)
    middle = (np.asarray(line.values)[1:] + np.asarray(line.values)[:-1]) / 2
    whole = np.isfinite(segments).all(axis=(1, 2))
    collection = LineCollection(
        list(segments[whole]),
        cmap=color_map(line.scale, colors),
        norm=Normalize(*line.limits),
        linewidths=2.4,
        capstyle="round",
        zorder=order,
    )
    collection.set_array(middle[whole])
    axes.add_collection(collection, autolim=True)


def _marks(axes: Axes, marks: Marks, colors: Colors, order: float) -> None:
    axes.plot(marks.x, marks.y, linestyle="none", zorder=order + 1, **_marker(marks, colors))


def _marker(marks: Marks, colors: Colors) -> dict[str, Any]:
    """Return how a mark looks: filled ones get a rim in the colour of the paper."""
    color = colors[marks.color]
    hollow = marks.symbol.endswith("-open")
    face: str = "none" if marks.symbol == "ring" else colors["paper"] if hollow else color
    plain = marks.symbol in ("x", "ring") or hollow
    return {
        "marker": _MARKERS[marks.symbol],
        "markersize": marks.size + (3 if marks.symbol == "star" else 0),
        "markerfacecolor": face,
        "markeredgecolor": color if plain else colors["paper"],
        "markeredgewidth": 1.5 if plain else 0.7,
    }


def _area(axes: Axes, area: Area, colors: Colors, order: float) -> None:
    points = np.stack([area.x, area.y], axis=1)
    breaks = np.flatnonzero(np.isnan(points[:, 0]))
    polygons = [part[np.isfinite(part[:, 0])] for part in np.split(points, breaks)]
    collection = PolyCollection(
        [polygon for polygon in polygons if len(polygon) > 2],
        linewidths=0,
        antialiaseds=False,
        zorder=1 + order / 100,
        **_filling(area, colors),
    )
    axes.add_collection(collection, autolim=True)


def _filling(area: Area, colors: Colors) -> dict[str, Any]:
    """Return how an area is filled: plain, or with stripes."""
    tint = to_rgba(colors[area.color], area.opacity)
    if not area.hatched:
        return {"facecolor": tint}
    stripes = to_rgba(colors[area.color], min(1.0, 3.0 * area.opacity))
    return {"facecolor": tint, "edgecolor": stripes, "hatch": "////"}


def _rule(axes: Axes, rule: Rule, colors: Colors, order: float) -> None:
    draw_rule = axes.axvline if rule.along == "x" else axes.axhline
    draw_rule(
        rule.at,
        color=colors[rule.color],
        linestyle=_DASHES[rule.dash],
        linewidth=rule.width,
        zorder=1.5 + order / 100,
    )


def _bars(axes: Axes, bars: Bars, colors: Colors, order: float) -> None:
    axes.barh(
        bars.y, bars.length, left=bars.start, height=0.62, color=colors[bars.color], zorder=order
    )


def _note(axes: Axes, note: Note, colors: Colors, order: float) -> None:
    text = axes.annotate(
        note.text,
        (note.x, note.y),
        (note.dx, note.dy),
        textcoords="offset points",
        color=colors[note.color],
        size=9,
        weight="bold" if note.bold else "normal",
        ha=note.anchor,
        va="center" if note.baseline == "middle" else note.baseline,
        rotation=90 if note.upright else 0,
        annotation_clip=False,
        zorder=order + 2,
    )
    text.set_path_effects([withStroke(linewidth=2.5, foreground=colors["paper"])])


def _zero_line(axes: Axes, line: ZeroLine, colors: Colors, order: float) -> None:
    axes.contour(
        line.x,
        line.y,
        line.z,
        levels=[0.0],
        colors=[colors[line.color]],
        linestyles=[_DASHES[line.dash]],
        linewidths=1.6,
        zorder=order,
    )


def _cells(axes: Axes, cells: Cells, colors: Colors, order: float) -> None:
    mesh = axes.pcolormesh(
        _borders(cells.x),
        _borders(cells.y),
        np.ma.masked_invalid(cells.values),
        cmap=color_map(cells.scale, colors),
        zorder=order,
    )
    mesh.set_label("cells")


def _borders(centres: Array) -> Array:
    if len(centres) == 1:
        return np.array([centres[0] - 0.5, centres[0] + 0.5])
    middle = (centres[1:] + centres[:-1]) / 2
    first, last = 2 * centres[0] - middle[0], 2 * centres[-1] - middle[-1]
    return np.concatenate([[first], middle, [last]])


_DRAW: dict[type, Any] = {
    Line: _line,
    Graded: _graded_line,
    Marks: _marks,
    Area: _area,
    Rule: _rule,
    Bars: _bars,
    Note: _note,
    ZeroLine: _zero_line,
    Cells: _cells,
}


def _add_scale(axes: Axes, panel: Panel, colors: Colors) -> None:
    """Add the scale of a coloured item to the right of its panel."""
    label = next((i.value_label for i in panel.items if isinstance(i, Graded | Cells)), None)
    shown = next((c for c in axes.collections if c.get_array() is not None), None)
    figure = axes.get_figure(root=True)
    if label is None or shown is None or figure is None:
        return
    box = axes.get_position()
    place = (box.x1 + 0.02, box.y0 + 0.1 * box.height, 0.018, 0.8 * box.height)
    bar = figure.colorbar(shown, cax=figure.add_axes(place))
    bar.set_label(label, color=colors["ink"], size=9.5)
    bar.ax.tick_params(colors=colors["ink"], labelsize=9, length=3)
    bar.outline.set_visible(False)


def _legend(panels: list[Panel], colors: Colors) -> dict[str, Any]:
    """Return label -> handle, each label once."""
    entries: dict[str, Any] = {}
    for panel in panels:
        for item in panel.items:
            label = getattr(item, "label", "")
            if label and label not in entries:
                entries[label] = _handle(item, colors)
    return entries


def _handle(item: Any, colors: Colors) -> Any:
    if isinstance(item, Marks):
        return Line2D([], [], linestyle="none", **_marker(item, colors))
    if isinstance(item, Line | ZeroLine):
        return Line2D([], [], color=colors[item.color], linestyle=_DASHES[item.dash])
    if isinstance(item, Area):
        return Patch(linewidth=0, **_filling(item, colors))
    return Patch(facecolor=colors[item.color])


def _columns(legend: dict[str, Any]) -> int:
    """Return how many columns fit beside each other, at most three."""
    widths = (TextPath((0.0, 0.0), label, size=_LEGEND_POINTS).get_extents().x1 for label in legend)
    column = max(widths, default=0.0) / _POINTS + _HANDLE
    return max(1, min(3, len(legend), int((WIDTH - _LEFT) / column)))


def _add_legend(figure: Figure, legend: dict[str, Any], colors: Colors) -> None:
    box = figure.legend(
        list(legend.values()),
        list(legend),
        loc="lower left",
        bbox_to_anchor=(_LEFT / WIDTH, 0.04 / figure.get_figheight()),
        ncols=_columns(legend),
        frameon=False,
        fontsize=_LEGEND_POINTS,
        labelcolor=colors["ink"],
        columnspacing=1.6,
        handlelength=3.0,
        handletextpad=0.8,
        borderpad=0.2,
        labelspacing=0.35,
    )
    box.set_in_layout(False)
