"""What flat pictures and scenes share when matplotlib draws them."""

import textwrap
from collections.abc import Mapping

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from foldwing.plots.layout import WIDTH_INCHES
from foldwing.plots.palette import SCALES

Colors = Mapping[str, str]

WIDTH = WIDTH_INCHES
LINE = 0.19
"""Height of a line of caption or legend in inches."""


def new_figure(width: float, height: float, colors: Colors) -> Figure:
    """Return an empty figure that can be saved without pyplot."""
    figure = Figure(figsize=(width, height), facecolor=colors["paper"])
    FigureCanvasAgg(figure)
    return figure


def wrapped(caption: str) -> list[str]:
    """Break a caption into lines that fit the width."""
    return textwrap.wrap(caption, 114)


def write_head(figure: Figure, title: str, caption: list[str], colors: Colors) -> None:
    """Write title and caption at the top left."""
    height = figure.get_figheight()
    x = 0.16 / figure.get_figwidth()
    figure.text(x, 1 - 0.12 / height, title, color=colors["ink"], size=12, weight="bold", va="top")
    for number, line in enumerate(caption):
        y = 1 - (0.38 + LINE * number) / height
        figure.text(x, y, line, color=colors["muted"], size=8.5, va="top")


def color_map(scale: str, colors: Colors) -> LinearSegmentedColormap:
    """Return the colours of a scale from low to high."""
    return LinearSegmentedColormap.from_list(scale, [colors[role] for role in SCALES[scale]])
