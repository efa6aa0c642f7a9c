"""Pictures as plotly figures, written as plain JSON data.

Plotly draws in the browser from JSON; making that JSON directly avoids the import and the
validation of ``plotly.graph_objects``, which would take longer than everything else here. Colours
are first written as roles (``@ink``, ``@series1/0.2``), so that one figure serves every theme.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from foldwing.plots.interactive_base import Json, base_layout, color_scale, numbers
from foldwing.plots.interactive_scenes import scenes_figure
from foldwing.plots.palette import THEMES
from foldwing.plots.picture import (
    Area,
    Bars,
    Cells,
    Graded,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Range,
    Rule,
    ZeroLine,
)

_PIXELS = 260
"""Height of a panel whose relative height is 1."""
_POINT = 4.0 / 3.0
"""Pixels per point."""
_GAP, _ROW_GAP = 22, 62
_COLUMN_GAP = 0.12
Domain = tuple[tuple[float, float] | None, tuple[float, float]]
_TOP, _BOTTOM, _LEGEND_ROW = 30, 56, 22
_DASHES = {
    "solid": "solid",
    "dash": "8px,4px",
    "dot": "2px,3px",
    "dashdot": "9px,3px,2px,3px",
    "longdash": "15px,4px",
}
_SYMBOLS = {
    "circle": "circle",
    "circle-open": "circle",
    "square": "square",
    "square-open": "square",
    "diamond": "diamond",
    "x": "x-thin-open",
    "star": "star",
    "triangle": "triangle-up",
    "triangle-down": "triangle-down",
    "ring": "circle-open",
}
_ROLE = re.compile(r"@(\w+)(?:/([\d.]+))?")


def figure(picture: Picture) -> Json:
    """Return a picture as plotly JSON: ``data``, ``layout``, ``frames``; colours as roles."""
    panels = [panel for panel in picture.panels if isinstance(panel, Panel)]
    if len(panels) != len(picture.panels):
        return scenes_figure(picture)
    labels = {getattr(item, "label", "") for panel in panels for item in panel.items} - {""}
    rows = -(-len(labels) // 3)
    domains, inner = _domains(panels, picture.columns)
    foot = _BOTTOM + rows * _LEGEND_ROW + (8 if rows else 0)
    layout = base_layout()
    layout |= {
        "height": round(_TOP + inner + foot),
        "margin": {"l": 78, "r": round(96 * picture.right_margin), "t": _TOP, "b": foot},
        "legend": {
            "orientation": "h", "x": 0, "y": -_BOTTOM / inner, "yanchor": "top",
            "font": {"size": 12}, "itemsizing": "constant",
        },
        "annotations": [],
        "shapes": [],
    }  # fmt: skip
    data: list[Json] = []
    for number, (panel, domain) in enumerate(zip(panels, domains, strict=True), start=1):
        _add_axes(layout, panel, number, domain, last=panel is panels[-1])
        if panel.title:
            layout["annotations"].append(_heading(panel.title, "" if number == 1 else str(number)))
        for item in panel.items:
            _add_item(data, layout, item, panel, number)
    return {"data": _legend_once(data), "layout": layout, "frames": []}


def _domains(panels: list[Panel], columns: int) -> tuple[list[Domain], float]:
    """Return the part of the width (None: all) and of the height of each panel, and the height."""
    gap = _GAP if columns == 1 else _ROW_GAP
    rows = [panels[first : first + columns] for first in range(0, len(panels), columns)]
    heights = [_PIXELS * max(panel.height for panel in row) for row in rows]
    inner = sum(heights) + gap * (len(rows) - 1)
    width = (1.0 - _COLUMN_GAP * (columns - 1)) / columns
    domains: list[Domain] = []
    upper = 1.0
    for row, height in zip(rows, heights, strict=True):
        lower = upper - height / inner
        for column in range(len(row)):
            left = column * (width + _COLUMN_GAP)
            part = None if columns == 1 else (left, min(left + width, 1.0))
            domains.append((part, (max(lower, 0.0), upper)))
        upper = lower - gap / inner
    return domains, inner


def colored(node: Any, theme: str) -> Any:
    """Return plotly JSON with the colours of a theme in place of roles."""
    colors = THEMES[theme]
    if isinstance(node, dict):
        return {key: colored(value, theme) for key, value in node.items()}
    if isinstance(node, list):
        return [colored(value, theme) for value in node]
    match = _ROLE.fullmatch(node) if isinstance(node, str) else None
    return _color(colors, match[1], match[2]) if match else node


def _color(colors: Mapping[str, str], role: str, opacity: str | None) -> str:
    if opacity is None:
        return colors[role]
    red, green, blue = (int(colors[role][i : i + 2], 16) for i in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity})"


def _add_axes(layout: Json, panel: Panel, number: int, domain: Domain, last: bool) -> None:
    suffix = "" if number == 1 else str(number)
    across, upright = domain
    shown = last or across is not None
    x = _axis(panel.x_label if shown else "", panel.x_range, panel.log_x, panel.x_ticks)
    x |= {"anchor": f"y{suffix}", "showticklabels": shown, "ticks": "outside"}
    x |= {"tickcolor": "@muted", "ticklen": 4}
    if across is not None:
        x["domain"] = list(across)
    elif number > 1:
        x["matches"] = "x"
    y = _axis(panel.y_label, panel.y_range, panel.log_y, panel.y_ticks)
    y |= {"domain": list(upright)}
    y |= {"anchor": f"x{suffix}"} if across is not None else {}
    y |= {"scaleanchor": f"x{suffix}", "scaleratio": 1} if panel.equal else {}
    layout[f"xaxis{suffix}"], layout[f"yaxis{suffix}"] = x, y


def _axis(
    label: str, limits: Range | None, log: bool, ticks: Sequence[tuple[float, str]] | None
) -> Json:
    axis: Json = {"gridcolor": "@grid", "zeroline": False, "linecolor": "@muted", "showline": True}
    if label:
        axis["title"] = {"text": label, "standoff": 8}
    if limits:
        axis["range"] = list(np.log10(limits) if log else limits)
    if log:
        axis["type"] = "log"
    if ticks is not None:
        axis |= {"tickvals": [at for at, _ in ticks], "ticktext": [text for _, text in ticks]}
    return axis


def _add_item(data: list[Json], layout: Json, item: Any, panel: Panel, number: int) -> None:
    suffix = "" if number == 1 else str(number)
    if isinstance(item, Note):
        layout["annotations"].append(_note(item, panel, suffix))
    elif isinstance(item, Rule):
        layout["shapes"].append(_rule(item, suffix))
    else:
        trace = _TRACES[type(item)](item, panel)
        data.append({**trace, "xaxis": f"x{suffix}", "yaxis": f"y{suffix}"})
        if isinstance(item, Graded | Cells):
            layout["coloraxis"] = _scale(item)
            layout["margin"]["r"] = max(layout["margin"]["r"], 40)


def _scale(item: Graded | Cells) -> Json:
    axis: Json = {
        "colorscale": color_scale(item.scale),
        "colorbar": {
            "title": {"text": item.value_label, "side": "right"},
            "outlinewidth": 0,
            "thickness": 14,
            "len": 0.8,
        },
    }
    if isinstance(item, Graded):
        axis |= {"cmin": item.limits[0], "cmax": item.limits[1]}
    return axis


def _note(note: Note, panel: Panel, suffix: str) -> Json:
    text = f"<b>{note.text}</b>" if note.bold else note.text
    found: Json = {
        "x": float(np.log10(note.x)) if panel.log_x else note.x,
        "y": float(np.log10(note.y)) if panel.log_y else note.y,
        "xref": f"x{suffix}",
        "yref": f"y{suffix}",
        "text": text,
        "showarrow": False,
        "xanchor": note.anchor,
        "yanchor": note.baseline,
        "xshift": note.dx * _POINT,
        "yshift": note.dy * _POINT,
        "borderpad": 0,
        "font": {"color": f"@{note.color}", "size": 12},
    }
    return found | ({"textangle": -90, "bgcolor": "@paper/0.75"} if note.upright else {})


def _heading(text: str, suffix: str) -> Json:
    """Return the title of a panel, above its upper left corner."""
    return {
        "x": 0, "y": 1, "xref": f"x{suffix} domain", "yref": f"y{suffix} domain",
        "text": f"<b>{text}</b>", "showarrow": False, "xanchor": "left", "yanchor": "bottom",
        "yshift": 3, "font": {"color": "@ink", "size": 12.5},
    }  # fmt: skip


def _rule(rule: Rule, suffix: str) -> Json:
    along = {"x0": rule.at, "x1": rule.at, "y0": 0, "y1": 1}
    if rule.along == "y":
        along = {"x0": 0, "x1": 1, "y0": rule.at, "y1": rule.at}
    return {
        "type": "line",
        "xref": f"x{suffix}" + (" domain" if rule.along == "y" else ""),
        "yref": f"y{suffix}" + (" domain" if rule.along == "x" else ""),
        "line": {"color": f"@{rule.color}", "width": rule.width, "dash": _DASHES[rule.dash]},
        **along,
    }


def _line(line: Line, panel: Panel) -> Json:
    name = line.label or line.name
    title = line.name or line.label
    hover = f"{_value('x', panel.x_label)}<br>{_value('y', panel.y_label)}"
    return {
        "type": "scatter",
        "mode": "lines",
        "x": numbers(line.x),
        "y": numbers(line.y),
        "name": name,
        "showlegend": bool(line.label),
        "opacity": line.opacity,
        "line": {"color": f"@{line.color}", "width": line.width, "dash": _DASHES[line.dash]},
        **(
            {"hovertemplate": f"<b>{title}</b><br>{hover}<extra></extra>"}
            if name
            else {"hoverinfo": "skip"}
        ),
    }


def _value(which: str, label: str) -> str:
    """Return the hover text of a coordinate, with the unit that stands in its axis label."""
    quantity, _, unit = label.rpartition(" (")
    if unit.startswith("degrees"):
        return f"{quantity}: %{{{which}:.4g}}°"
    return f"{quantity or label}: %{{{which}:.4g}} {unit.rstrip(')') if quantity else ''}"


def _graded(line: Graded, panel: Panel) -> Json:
    values = f"{_value('x', panel.x_label)}<br>{_value('y', panel.y_label)}"
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "x": numbers(line.x),
        "y": numbers(line.y),
        "name": line.name,
        "showlegend": False,
        "line": {"color": "@muted/0.5", "width": 1},
        "marker": {"color": numbers(line.values), "coloraxis": "coloraxis", "size": 5},
        "hovertemplate": f"<b>{line.name}</b><br>{values}<br>"
        + _value("marker.color", line.value_label)
        + "<extra></extra>",
    }


def _marks(marks: Marks, panel: Panel) -> Json:
    hollow = marks.symbol.endswith("-open")
    plain = hollow or marks.symbol in ("x", "ring")
    color = f"@{marks.color}"
    trace: Json = {
        "type": "scatter",
        "mode": "markers",
        "x": numbers(marks.x),
        "y": numbers(marks.y),
        "name": marks.label,
        "showlegend": bool(marks.label),
        "marker": {
            "symbol": _SYMBOLS[marks.symbol],
            "size": marks.size * (1.4 if marks.symbol == "star" else 1.35),
            "color": "@paper" if hollow else color,
            "line": {"color": color if plain else "@paper", "width": 1.8 if plain else 0.8},
        },
        "hovertemplate": f"<b>{marks.label}</b><extra></extra>",
    }
    if len(marks.hover):
        trace |= {"text": list(marks.hover), "hovertemplate": "%{text}<extra></extra>"}
    return trace


def _area(area: Area, panel: Panel) -> Json:
    return {
        "type": "scatter",
        "mode": "lines",
        "x": numbers(area.x),
        "y": numbers(area.y),
        "fill": "toself",
        "fillcolor": f"@{area.color}/{area.opacity}",
        **({"fillpattern": _stripes(area)} if area.hatched else {}),
        "line": {"width": 0},
        "hoverinfo": "skip",
        "name": area.label,
        "showlegend": bool(area.label),
    }


def _stripes(area: Area) -> Json:
    stripes, tint = f"@{area.color}/{min(1.0, 3.0 * area.opacity):g}", f"@{area.color}/0.05"
    return {"shape": "/", "size": 8, "solidity": 0.15, "fgcolor": stripes, "bgcolor": tint}


def _bars(bars: Bars, panel: Panel) -> Json:
    return {
        "type": "bar",
        "orientation": "h",
        "x": numbers(bars.length),
        "y": numbers(bars.y),
        "base": numbers(bars.start),
        "width": 0.62,
        "offset": -0.31,
        "name": bars.label,
        "showlegend": bool(bars.label),
        "marker": {"color": f"@{bars.color}"},
        "hoverinfo": "skip",
    }


def _zero_line(line: ZeroLine, panel: Panel) -> Json:
    return {
        "type": "contour",
        "x": numbers(line.x),
        "y": numbers(line.y),
        "z": numbers(line.z),
        "contours": {"coloring": "none", "start": 0, "end": 0, "size": 1},
        "line": {"color": f"@{line.color}", "width": 1.8, "dash": _DASHES[line.dash]},
        "name": line.label,
        "showlegend": bool(line.label),
        "showscale": False,
        "hoverinfo": "skip",
    }


def _cells(cells: Cells, panel: Panel) -> Json:
    return {
        "type": "heatmap",
        "x": numbers(cells.x),
        "y": numbers(cells.y),
        "z": numbers(cells.values),
        "coloraxis": "coloraxis",
        "showlegend": False,
        "hovertemplate": f"{_value('x', panel.x_label)}<br>{_value('y', panel.y_label)}<br>"
        f"{_value('z', cells.value_label)}<extra></extra>",
    }


_TRACES: Mapping[type, Callable[[Any, Panel], Json]] = {
    Line: _line,
    Graded: _graded,
    Marks: _marks,
    Area: _area,
    Bars: _bars,
    ZeroLine: _zero_line,
    Cells: _cells,
}


def _legend_once(data: list[Json]) -> list[Json]:
    """Show each label once; the entry switches all traces of that label."""
    seen: set[str] = set()
    for trace in data:
        name = trace.get("name", "")
        if trace.get("showlegend"):
            trace["legendgroup"] = name
            trace["showlegend"] = name not in seen
            seen.add(name)
    return data
