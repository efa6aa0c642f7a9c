"""Views in space, still or as a film, as plotly JSON."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from foldwing.plots.interactive_base import Json, base_layout, color_scale, numbers
from foldwing.plots.picture import Dot, Picture, Scene, Surface, Tag, Thread

_HEIGHT = 300
_FILM_HEIGHT = 460
_BAR = 64
"""Height of a scale of colours with its label."""
_FRAME_MILLISECONDS = 50
_CYCLES = 20
_ZOOM, _FILM_ZOOM = 2.0, 2.6
"""Length of the longest side of the box in the view."""
_DISTANCE = 1.6
"""Of the eye from the middle of the view."""


def scenes_figure(picture: Picture) -> Json:
    """Return scenes side by side, or one with the buttons that play its film."""
    scenes = [scene for scene in picture.panels if isinstance(scene, Scene)]
    rows = -(-len(scenes) // picture.columns)
    layout = base_layout() | {
        "margin": {"l": 0, "r": 0, "t": 30, "b": 8},
        "height": _FILM_HEIGHT if picture.frames else rows * _HEIGHT,
        "annotations": [],
        "showlegend": False,
    }
    data: list[Json] = []
    for number, scene in enumerate(scenes):
        name = "scene" if number == 0 else f"scene{number + 1}"
        domain = _domain(number, picture.columns, rows)
        bar = 0.0 if scene.graded is None else _BAR / rows / _HEIGHT
        place = domain[0], (domain[1][0] + bar, domain[1][1])
        layout[name] = _axes(scene, place, _FILM_ZOOM if picture.frames else _ZOOM)
        layout[name]["camera"]["eye"] = _eye(picture.view)
        layout["annotations"] += [_title(scene.title, domain)] if scene.title else []
        traces = [{**_TRACES[type(item)](item), "scene": name} for item in scene.items]
        if scene.graded is not None:
            shown = next(n for n, item in enumerate(scene.items) if item is scene.graded)
            traces[shown] |= {"showscale": True, "colorbar": _bar(scene, domain)}
        data += traces
    if any(trace.get("showlegend") for trace in data):
        layout |= {"showlegend": True, "legend": _legend()}
        _name_once(data)
    if picture.frames:
        layout["updatemenus"] = [_buttons(len(picture.frames))]
    return {"data": data, "layout": layout, "frames": _frames(picture)}


def _legend() -> Json:
    return {"orientation": "h", "x": 0, "y": 0, "yanchor": "bottom", "itemsizing": "constant"}


def _name_once(data: list[Json]) -> None:
    """Leave each name in the legend once."""
    seen: set[str] = set()
    for trace in data:
        if trace.get("showlegend"):
            trace["showlegend"] = trace["name"] not in seen
            seen.add(trace["name"])


def _domain(number: int, columns: int, rows: int) -> tuple[tuple[float, float], ...]:
    row, column = divmod(number, columns)
    return (column / columns, (column + 1) / columns), (1 - (row + 1) / rows, 1 - row / rows)


def _axes(scene: Scene, domain: tuple[tuple[float, float], ...], zoom: float) -> Json:
    axes = {
        f"{letter}axis": {"visible": False, "range": list(limits), "autorange": False}
        for letter, limits in zip("xyz", _room(scene), strict=True)
    }
    low, high = np.array(_room(scene)).T
    sides = (high - low) / (high - low).max()
    return {
        **axes,
        "aspectmode": "manual",
        "aspectratio": {
            letter: zoom * float(side) for letter, side in zip("xyz", sides, strict=True)
        },
        "domain": {"x": list(domain[0]), "y": [domain[1][0], domain[1][1] - 0.03]},
        "camera": {"projection": {"type": "orthographic"}},
        "bgcolor": "@paper",
    }


def _eye(view: tuple[float, float]) -> Json:
    azimuth, elevation = np.radians(view)
    flat, up = _DISTANCE * np.cos(elevation), _DISTANCE * np.sin(elevation)
    place = {"x": flat * np.cos(azimuth), "y": flat * np.sin(azimuth), "z": up}
    return {letter: round(float(value), 3) for letter, value in place.items()}


def _room(scene: Scene) -> list[tuple[float, float]]:
    """Return the box with room for the arrows and texts outside it."""
    points = [item.points for item in scene.items if isinstance(item, Thread)]
    points += [item.point[None] for item in scene.items if isinstance(item, Tag | Dot)]
    corners = np.concatenate([np.array(scene.box).T, *points])
    return [(float(low), float(high)) for low, high in zip(*_extent(corners), strict=True)]


def _extent(points: Any) -> tuple[Any, Any]:
    return points.min(axis=0), points.max(axis=0)


def _title(text: str, domain: tuple[tuple[float, float], ...]) -> Json:
    return {
        "text": f"<b>{text}</b>",
        "x": sum(domain[0]) / 2,
        "y": domain[1][1],
        "xref": "paper",
        "yref": "paper",
        "xanchor": "center",
        "yanchor": "top",
        "showarrow": False,
        "font": {"size": 13},
    }


def _bar(scene: Scene, domain: tuple[tuple[float, float], ...]) -> Json:
    """Return the scale of colours below a scene."""
    return {
        "orientation": "h",
        "x": sum(domain[0]) / 2,
        "xanchor": "center",
        "y": domain[1][0],
        "yanchor": "bottom",
        "len": 0.7 * (domain[0][1] - domain[0][0]),
        "thickness": 12,
        "outlinewidth": 0,
        "title": {"text": scene.value_label, "side": "bottom", "font": {"size": 12}},
        **({"tickvals": list(scene.ticks)} if scene.ticks else {}),
    }


def _faces(surface: Surface) -> Json:
    """Return a sheet whose faces have one colour each, as two triangles for each face."""
    rows, columns = surface.x.shape
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (part.ravel() for part in _around(number))
    i, j, k = np.stack([a, a], 1), np.stack([b, c], 1), np.stack([c, d], 1)
    return {
        "type": "mesh3d",
        **{letter: numbers(getattr(surface, letter).ravel()) for letter in "xyz"},
        **{letter: part.ravel().tolist() for letter, part in zip("ijk", (i, j, k), strict=True)},
        "intensity": numbers(np.repeat(np.asarray(surface.values).ravel(), 2)),
        "intensitymode": "cell",
        "colorscale": color_scale(surface.scale),
        "cmin": surface.limits[0],
        "cmax": surface.limits[1],
        "showscale": False,
        "hoverinfo": "skip",
        "flatshading": True,
        "lighting": {"ambient": 1.0, "diffuse": 0.0, "specular": 0.0},
    }


def _around(number: Any) -> tuple[Any, ...]:
    """Return the corners of every face in their order around it."""
    return number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]


def _surface(surface: Surface) -> Json:
    if surface.by_face:
        return _faces(surface)
    trace: Json = {
        "type": "surface",
        "x": numbers(surface.x),
        "y": numbers(surface.y),
        "z": numbers(surface.z),
        "opacity": surface.opacity,
        "showscale": False,
        "hoverinfo": "skip",
        "contours": {f"{letter}": {"highlight": False} for letter in "xyz"},
        "lighting": {"ambient": 0.85, "diffuse": 0.3, "specular": 0.02},
    }
    if surface.values is None:
        plain = f"@{surface.color}"
        return trace | {
            "surfacecolor": numbers(np.zeros_like(surface.x)),
            "colorscale": [[0.0, plain], [1.0, plain]],
        }
    return trace | {
        "surfacecolor": numbers(surface.values),
        "colorscale": color_scale(surface.scale),
        "cmin": surface.limits[0],
        "cmax": surface.limits[1],
    }


def _thread(thread: Thread) -> Json:
    x, y, z = thread.points.T
    trace: Json = {
        "type": "scatter3d",
        "mode": "lines",
        "x": numbers(x),
        "y": numbers(y),
        "z": numbers(z),
        "opacity": thread.opacity,
        "hoverinfo": "skip",
        "line": {"color": f"@{thread.color}", "width": 2.5 * thread.width},
    }
    if thread.arrow:  # a triangle of markers would not turn with the view: draw the barbs
        tip, start = thread.points[-1], thread.points[0]
        back = tip - 0.25 * (tip - start)
        side = 0.1 * np.linalg.norm(tip - start) * np.array([0.0, 1.0, 0.0])
        path = np.stack([start, tip, back + side, tip, back - side])
        trace |= {letter: numbers(path[:, i]) for i, letter in enumerate("xyz")}
    return trace


def _tag(tag: Tag) -> Json:
    return {
        "type": "scatter3d",
        "mode": "text",
        "text": [tag.text],
        **{letter: [float(value)] for letter, value in zip("xyz", tag.point, strict=True)},
        "textfont": {"color": f"@{tag.color}", "size": 12},
        "hoverinfo": "skip",
    }


def _dot(dot: Dot) -> Json:
    return {
        "type": "scatter3d",
        "mode": "markers",
        **{letter: [float(value)] for letter, value in zip("xyz", dot.point, strict=True)},
        "name": dot.label,
        "showlegend": bool(dot.label),
        "legendgroup": dot.label,
        "hovertemplate": f"{dot.label}<extra></extra>",
        "marker": {
            "symbol": "circle" if dot.filled else "circle-open",
            "size": dot.size,
            "color": f"@{dot.color}",
        },
    }


_TRACES: Mapping[type, Callable[[Any], Json]] = {
    Surface: _surface,
    Thread: _thread,
    Tag: _tag,
    Dot: _dot,
}


def _frames(picture: Picture) -> list[Json]:
    """Return one frame for each step; only what moves is in it."""
    return [
        {
            "name": str(number),
            "traces": list(range(len(frame))),
            "data": [
                {
                    "type": "surface",
                    "x": numbers(surface.x),
                    "y": numbers(surface.y),
                    "z": numbers(surface.z),
                    "surfacecolor": numbers(surface.values),
                }
                for surface in frame
            ],
        }
        for number, frame in enumerate(picture.frames)
    ]


def _buttons(count: int) -> Json:
    duration = {"duration": _FRAME_MILLISECONDS, "redraw": True}
    play = {"frame": duration, "transition": {"duration": 0}, "mode": "immediate"}
    stop = {"frame": {"duration": 0}, "mode": "immediate"}
    names = [str(number) for number in range(count)] * _CYCLES
    return {
        "type": "buttons",
        "direction": "left",
        "x": 0.01,
        "y": 0.02,
        "xanchor": "left",
        "yanchor": "bottom",
        "showactive": False,
        "bgcolor": "@paper",
        "bordercolor": "@muted",
        "font": {"color": "@ink"},
        "buttons": [
            {"label": "▶ play", "method": "animate", "args": [names, play]},
            {"label": "■ stop", "method": "animate", "args": [[None], stop]},
        ],
    }
