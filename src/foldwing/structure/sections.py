"""Sections of a segment that bends along its chord: the plunge and twist nearest to its motion.

Strip theory and the names of modes want plunge h and twist phi of a section, and a plate has
neither. Those whose w = h - (x - x_ea) phi is nearest over the chord, in the mean square, serve.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Planform, Sheet
from foldwing.structure.component import SectionMotion

Displacement = Callable[[Real, Real], Real]
"""Local displacement (m, 3, n) at points x and y, as `ComponentModes.displacement`."""

ACROSS = 12
"""Gauss points along a chord."""

ALONG = 12
"""Gauss points along the span between two corners of an outline."""

SHORTEST = 1e-4
"""Share of the size of an outline: a shorter chord is sampled over this length instead, for the
twist is a difference of displacements divided by it."""


class SectionFit(NamedTuple):
    """Plunge and twist of sections, and what they leave.

    Attributes
    ----------
    motion : SectionMotion
        Plunge at the elastic axis in m, up, and twist in rad, nose up, each of shape (m, n).
    remainder : array, shape (m, n)
        Root mean square over the chord of the displacement that they leave, in m.
    """

    motion: SectionMotion
    remainder: Real


def section_motion(
    planform: Planform, elastic_axis: float, y: Real, displacement: Displacement
) -> SectionFit:
    """Return plunge and twist of sections along the stream, by least squares over the chord.

    Parameters
    ----------
    planform : Planform
        With one chord at every y.
    elastic_axis : float
        Fraction of the chord at which the plunge is taken.
    y : array, shape (m,)
        Where the sections are, in m; nan outside the outline gives nan.
    displacement : callable
    """
    y = np.asarray(y, float)
    front, back = planform.chord_ends(y)
    middle, half = _sampled_chords(planform, y)
    mean, lean, rest = _fitted(_along_chords(middle, half, y, displacement))
    twist = -lean / half[:, None]
    ahead = middle - front - elastic_axis * (back - front)
    plunge = mean + ahead[:, None] * twist
    remainder = np.sqrt(np.einsum("c,mcn->mn", _across()[1], rest**2))
    return SectionFit(SectionMotion(plunge, twist), remainder)


def chordwise_bending(planform: Planform, displacement: Displacement, combinations: Real) -> Real:
    """Return the share of the mean square displacement that plunge and twist leave, shape (k,).

    It is 0 for sections that stay straight, and for a segment that does not move out of its plane.

    Parameters
    ----------
    planform : Planform
    displacement : callable
    combinations : array, shape (n, k)
        Combinations of the coordinates of the segment, of which shares are asked.
    """
    combinations = np.asarray(combinations, float)
    y, weights = span_rule(planform, ALONG + len(combinations))
    middle, half = _sampled_chords(planform, y)
    w = _along_chords(middle, half, y, displacement) @ combinations
    area = np.einsum("m,c->mc", 2.0 * half * weights, _across()[1])
    left, whole = (np.einsum("mc,mck->k", area, part**2) for part in (_fitted(w)[2], w))
    return np.asarray(np.where(whole > 0.0, left / np.where(whole > 0.0, whole, 1.0), 0.0))


def span_rule(planform: Planform, points: int) -> tuple[Real, Real]:
    """Return y and weights of Gauss quadrature along the span, that many points between corners."""
    nodes, weights = gauss_rule(1.0, points)
    lengths = np.diff(planform.breaks)
    y = planform.breaks[:-1, None] + lengths[:, None] * nodes
    return y.ravel(), np.outer(lengths, weights).ravel()


def section_inertia(planform: Planform, sheet: Sheet, elastic_axis: float, y: Real) -> Real:
    """Return the inertia per span of sections about the elastic axis in kg m, shape (m,)."""
    front, back = planform.chord_ends(y)
    nodes, weights = gauss_rule(1.0, ACROSS)
    x = front[:, None] + nodes * (back - front)[:, None]
    points = x.ravel(), np.repeat(y, ACROSS)
    t = sheet.thickness_at(*planform.fractions(*points)).reshape(x.shape)
    aft = (nodes - elastic_axis) * (back - front)[:, None]
    return np.asarray(sheet.density * (back - front) * ((t * aft**2) @ weights))


def _across() -> tuple[Real, Real]:
    """Gauss points on [-1, 1] and weights of a mean, each of shape (ACROSS,)."""
    nodes, weights = gauss_rule(2.0, ACROSS)
    return nodes - 1.0, weights / 2.0


def _sampled_chords(planform: Planform, y: Real) -> tuple[Real, Real]:
    """Return middles and half lengths of the chords over which sections are sampled, (m,) each."""
    front, back = planform.chord_ends(y)
    return (front + back) / 2.0, np.maximum(back - front, SHORTEST * planform.size) / 2.0


def _along_chords(middle: Real, half: Real, y: Real, displacement: Displacement) -> Real:
    """Return w at the Gauss points of every chord, shape (m, ACROSS, n)."""
    x = middle[:, None] + half[:, None] * _across()[0]
    w = displacement(x.ravel(), np.repeat(y, ACROSS))[:, 2]
    return np.asarray(w.reshape(*x.shape, -1))


def _fitted(w: Real) -> tuple[Real, Real, Real]:
    """Return mean, slope over the half chord, both (m, n), and what they leave (m, ACROSS, n)."""
    place, weights = _across()
    mean = np.einsum("c,mcn->mn", weights, w)
    lean = 3.0 * np.einsum("c,mcn->mn", weights * place, w)
    return mean, lean, w - mean[:, None] - place[:, None] * lean[:, None]
