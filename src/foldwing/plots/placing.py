"""Where a text covers least: boxes on paper, in inches from the lower left corner of a panel."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from foldwing.plots.picture import Array, Range

Box = tuple[float, float, float, float]
"""Left, bottom, right and top in inches."""

TEXT_HEIGHT = 0.15
"""Height of a line of text in inches."""
_LETTER = 0.085
"""Width of a letter."""
_RIM = 0.03
"""Width of the rim of a text."""
MARK = 0.06
"""Radius of a mark."""
_STEP = 0.04
"""Distance of the points that stand for a line."""
_LONGEST = 20.0
"""Length up to which a line is followed with that distance."""
_AWAY = (0.09, 0.16, 0.3, 0.45, 0.65, 0.9)
"""Distances of a text from its point."""
_DIRECTIONS = (
    (1.0, 1.0), (1.0, 0.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0), (-1.0, 0.0), (0.0, 1.0),
    (0.0, -1.0), (1.0, 2.0), (-1.0, 2.0),
)  # fmt: skip
"""Where a text stands: right and up."""
_OTHER_TEXT, _OUTSIDE = 50.0, 1000.0
"""What it costs to lie on another text and to leave the panel, in points covered."""


@dataclass(frozen=True)
class Paper:
    """A panel with its size in inches."""

    x_range: Range
    y_range: Range
    width: float
    height: float

    def inches(self, x: Array, y: Array) -> Array:
        """Return places on paper, shape (n, 2)."""
        along = (np.asarray(x, float) - self.x_range[0]) / (self.x_range[1] - self.x_range[0])
        up = (np.asarray(y, float) - self.y_range[0]) / (self.y_range[1] - self.y_range[0])
        return np.stack([along * self.width, up * self.height], axis=-1)

    def values(self, point: tuple[float, float]) -> tuple[float, float]:
        """Return x and y of a place on paper."""
        x = self.x_range[0] + point[0] / self.width * (self.x_range[1] - self.x_range[0])
        y = self.y_range[0] + point[1] / self.height * (self.y_range[1] - self.y_range[0])
        return x, y

    def along(self, x: Array, y: Array) -> Array:
        """Return points on paper close to each other along a polyline; nan breaks it."""
        corners = self.inches(x, y)
        parts = [corners[np.isfinite(corners).all(axis=1)]]
        for start, end in pairwise(corners):
            length = float(np.hypot(*(end - start)))
            if np.isfinite(length) and length > _STEP:
                share = np.linspace(0.0, 1.0, int(min(length, _LONGEST) / _STEP) + 1)
                parts.append(start + share[:, None] * (end - start))
        return np.concatenate(parts)

    def rims(self, x: Array, y: Array, radius: float = MARK) -> Array:
        """Return points on paper around marks, which weigh more than those of a line."""
        turn = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
        around = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        return (self.inches(x, y)[:, None, :] + around).reshape(-1, 2)


def text_width(text: str) -> float:
    """Return about how wide a text is, in inches."""
    return _LETTER * len(text)


def clearest(boxes: Sequence[Box], points: Array, taken: Sequence[Box], paper: Paper) -> int:
    """Return which box covers the fewest points and no other text, the first of the best.

    Parameters
    ----------
    boxes : sequence of Box
        The preferred ones first.
    points : array, shape (n, 2)
        What should not be covered.
    taken : sequence of Box
        Texts that stand already.
    paper : Paper
    """
    return int(np.argmin([_cost(box, points, taken, paper) for box in boxes]))


def around(start: Array, width: float) -> list[Box]:
    """Return boxes for a text beside a point on paper, the nearest ones first."""
    boxes = []
    for away in _AWAY:
        for right, up in _DIRECTIONS:
            x = start[0] + away * right + (right - 1.0) * width / 2.0
            y = start[1] + away * up + (up - 1.0) * TEXT_HEIGHT / 2.0
            boxes.append((float(x), float(y), float(x + width), float(y + TEXT_HEIGHT)))
    return boxes


def along_rule(at: float, text: str, paper: Paper) -> list[Box]:
    """Return boxes for a text on both sides of an upright rule, the upper ones first."""
    width = text_width(text)
    tops = np.arange(paper.height - 0.05, TEXT_HEIGHT, -TEXT_HEIGHT)
    lefts = (at + 0.07, at - 0.07 - width)
    return [(left, float(t) - TEXT_HEIGHT, left + width, float(t)) for t in tops for left in lefts]


def corner_words(paper: Paper) -> list[Box]:
    """Return the place of the words stable and unstable at the top of a plane of eigenvalues."""
    zero = float(paper.inches(np.zeros(1), np.zeros(1))[0, 0])
    low = paper.height - 2.0 * TEXT_HEIGHT
    left = zero - text_width("stable "), paper.width - text_width("unstable ")
    return [(left[0], low, zero, paper.height), (left[1], low, paper.width, paper.height)]


def _cost(box: Box, points: Array, taken: Sequence[Box], paper: Paper) -> float:
    left, bottom, right, top = box
    covered = (points[:, 0] > left - _RIM) & (points[:, 0] < right + _RIM)
    covered &= (points[:, 1] > bottom) & (points[:, 1] < top)
    others = sum(left < b[2] and b[0] < right and bottom < b[3] and b[1] < top for b in taken)
    outside = left < 0.0 or bottom < 0.0 or right > paper.width or top > paper.height
    return float(covered.sum()) + _OTHER_TEXT * others + _OUTSIDE * outside
