"""Strips of simple wings, both halves, for the steady lattice."""

import numpy as np

from foldwing.aerodynamics.lattice import Strips


def strips(places, leading, chord):
    """Strips between places (y, z) that follow each other."""
    count = len(places) - 1
    one = np.ones(count)
    return Strips(
        places[:-1], places[1:], leading * one, chord * one, np.zeros(count, dtype=np.intp)
    )


def rectangle(aspect, count):
    """A flat wing of chord 1."""
    y = np.linspace(-aspect / 2.0, aspect / 2.0, count + 1)
    return strips(np.stack([y, 0.0 * y], axis=1), 0.0, 1.0)


def disc(count):
    """A flat wing of circular planform and radius 1, narrower strips towards the tips."""
    edge, middle = (np.linspace(0.0, np.pi, count + 1), (np.arange(count) + 0.5) * np.pi / count)
    chord = 2.0 * np.sin(middle)
    return strips(np.stack([-np.cos(edge), 0.0 * edge], axis=1), -chord / 2.0, chord)


def slit_ring(count):
    """A wing seen as a ring of radius 1 along the stream; one of ``count`` strips is left out."""
    angle = np.linspace(0.0, 2.0 * np.pi, count + 1)[:-1] - np.pi / 2.0 + np.pi / count
    return strips(np.stack([np.cos(angle), np.sin(angle)], axis=1), 0.0, 1.0)
