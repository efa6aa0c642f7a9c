"""Gauss quadrature along a span."""

from functools import cache

import numpy as np

from foldwing.maths.arrays import Real


@cache
def _unit_rule(points: int) -> tuple[Real, Real]:
    nodes, weights = np.polynomial.legendre.leggauss(points)
    nodes, weights = (nodes + 1.0) / 2.0, weights / 2.0
    nodes.setflags(write=False)
    weights.setflags(write=False)
    return nodes, weights


def gauss_rule(length: float, points: int) -> tuple[Real, Real]:
    """Return Gauss-Legendre nodes and weights on [0, length], each of shape (points,)."""
    nodes, weights = _unit_rule(points)
    return nodes * length, weights * length
