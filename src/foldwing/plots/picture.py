"""What a picture shows, said once: two renderers draw it, one static and one interactive.

A `Picture` holds panels, a panel holds items (lines, marks, areas, ...). Colours are roles such as
``ink``, ``series3`` or ``divergence``; a theme gives each role its colour.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Dash = Literal["solid", "dash", "dot", "dashdot", "longdash"]
Symbol = Literal[
    "circle",
    "circle-open",
    "square",
    "square-open",
    "diamond",
    "x",
    "star",
    "triangle",
    "triangle-down",
    "ring",
]
Scale = Literal["speed", "diverging", "cycle"]
Range = tuple[float, float]


@dataclass(frozen=True)
class Line:
    """A polyline; nan breaks it. ``name`` appears on hovering, ``label`` in the legend."""

    x: Array
    y: Array
    color: str = "ink"
    dash: Dash = "solid"
    width: float = 1.6
    name: str = ""
    label: str = ""
    opacity: float = 1.0


@dataclass(frozen=True)
class Graded:
    """A curve through points coloured by ``values``."""

    x: Array
    y: Array
    values: Array
    limits: Range
    value_label: str
    name: str = ""
    scale: Scale = "speed"


@dataclass(frozen=True)
class Marks:
    """Points with one symbol; ``hover`` holds one text for each."""

    x: Array
    y: Array
    symbol: Symbol
    color: str = "ink"
    label: str = ""
    size: float = 7.0
    hover: Sequence[str] = ()


@dataclass(frozen=True)
class Area:
    """A filled polygon; nan separates several. ``hatched`` ones have stripes of their colour."""

    x: Array
    y: Array
    color: str
    opacity: float
    label: str = ""
    hatched: bool = False


@dataclass(frozen=True)
class Rule:
    """A straight line across the whole panel at one x or one y."""

    at: float
    along: Literal["x", "y"]
    color: str = "muted"
    dash: Dash = "solid"
    width: float = 1.0


@dataclass(frozen=True)
class Bars:
    """Horizontal bars that end at ``length``, stacked on ``start``."""

    y: Array
    start: Array
    length: Array
    color: str
    label: str = ""


@dataclass(frozen=True)
class Note:
    """A text at a point, shifted by (dx, dy) points; it may lie outside the panel."""

    x: float
    y: float
    text: str
    color: str = "ink"
    anchor: Literal["left", "center", "right"] = "left"
    baseline: Literal["bottom", "middle", "top"] = "middle"
    dx: float = 0.0
    dy: float = 0.0
    upright: bool = False
    bold: bool = False


@dataclass(frozen=True)
class ZeroLine:
    """The curve on which ``z``, given at the crossings of ``x`` and ``y``, is zero."""

    x: Array
    y: Array
    z: Array
    color: str
    dash: Dash = "solid"
    label: str = ""


@dataclass(frozen=True)
class Cells:
    """A map of coloured cells; ``values`` has shape (y, x), nan leaves a cell empty."""

    x: Array
    y: Array
    values: Array
    value_label: str
    scale: Scale = "speed"


Item = Line | Graded | Marks | Area | Rule | Bars | Note | ZeroLine | Cells


@dataclass(frozen=True)
class Panel:
    """Axes in the plane with their items, drawn in order; ``equal``: one scale along both.

    The ``title`` stands above the panel.
    """

    x_label: str
    y_label: str
    items: Sequence[Item]
    x_range: Range | None = None
    y_range: Range | None = None
    log_y: bool = False
    y_ticks: Sequence[tuple[float, str]] | None = None
    title: str = ""
    height: float = 1.0
    log_x: bool = False
    x_ticks: Sequence[tuple[float, str]] | None = None
    equal: bool = False


@dataclass(frozen=True)
class Surface:
    """A sheet in space of shape (n, m): plain, or coloured by ``values``.

    These belong to its points, or to its faces when their shape is (n - 1, m - 1).
    """

    x: Array
    y: Array
    z: Array
    values: Array | None = None
    limits: Range = (-1.0, 1.0)
    color: str = "sheet"
    opacity: float = 1.0
    scale: Scale = "diverging"

    @property
    def by_face(self) -> bool:
        """Whether the values belong to the faces."""
        return self.values is not None and self.values.shape != self.x.shape


@dataclass(frozen=True)
class Thread:
    """A polyline in space."""

    points: Array
    color: str = "ink"
    width: float = 1.0
    opacity: float = 1.0
    label: str = ""
    arrow: bool = False


@dataclass(frozen=True)
class Dot:
    """A mark at a point in space; ``label`` appears in the legend."""

    point: Array
    color: str
    filled: bool
    label: str = ""
    size: float = 6.0


@dataclass(frozen=True)
class Tag:
    """A text at a point in space."""

    point: Array
    text: str
    color: str = "muted"


SceneItem = Surface | Thread | Tag | Dot


@dataclass(frozen=True)
class Scene:
    """A view in space, the same scale along all axes.

    With a ``value_label`` it has a scale of colours, that of its first coloured sheet; ``ticks``
    are the values marked there.
    """

    title: str
    items: Sequence[SceneItem]
    box: tuple[Range, Range, Range]
    value_label: str = ""
    ticks: Sequence[float] = ()

    @property
    def graded(self) -> Surface | None:
        """The sheet whose colours are explained; None when they need no explanation."""
        colored = (s for s in self.items if isinstance(s, Surface) and s.values is not None)
        return next(colored, None) if self.value_label else None


@dataclass(frozen=True)
class Picture:
    """One figure.

    Attributes
    ----------
    name : str
        Stem of the file.
    title : str
        A sentence that says what is shown.
    caption : str
        How to read it, one or two sentences.
    panels : sequence of Panel or of Scene
        Panels in one column lie below each other and share x; scenes, and panels in more columns,
        fill rows and have their own.
    columns : int
    view : (float, float)
        Whence scenes are seen, in degrees: azimuth from downstream towards outboard, elevation.
    right_margin : float
        Room for labels at the right-hand ends of the lines, in inches.
    frames : sequence of sequence of Surface
        Surfaces of the first scene that replace its surfaces one after the other: a film.
    """

    name: str
    title: str
    caption: str
    panels: Sequence[Panel] | Sequence[Scene]
    columns: int = 1
    view: tuple[float, float] = (-38.0, 24.0)
    right_margin: float = 0.35
    frames: Sequence[Sequence[Surface]] = field(default=())


def spread(values: Array, gap: float) -> Array:
    """Return values moved apart as little as possible so that neighbours keep a gap."""
    order = np.argsort(values, kind="stable")
    wanted = np.asarray(values, float)[order] - gap * np.arange(len(values))
    blocks: list[list[float]] = []  # [sum, count]: pool neighbours until the means increase
    for value in wanted:
        blocks.append([value, 1.0])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] >= blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1] = [blocks[-1][0] + total, blocks[-1][1] + count]
    means = [total / count for total, count in blocks for _ in range(int(count))]
    result = np.empty(len(values))
    result[order] = np.array(means) + gap * np.arange(len(values))
    return result


def padded(values: Array, share: float = 0.05) -> Range:
    """Return a range that holds all finite values with room to spare; (0, 1) without any."""
    finite = np.asarray(values, float)
    finite = finite[np.isfinite(finite)]
    if not finite.size:
        return (0.0, 1.0)
    low, high = float(finite.min()), float(finite.max())
    room = share * (high - low) or share * abs(high) or 1.0
    return (low - room, high + room)
