"""Roots at rest: where every elastic branch begins."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.optimize

from foldwing.maths.arrays import Complex, Indices
from foldwing.stability.problem import AeroelasticProblem


@dataclass(frozen=True)
class StillAirRoots:
    """Roots at U = 0 with positive frequency, ascending.

    Attributes
    ----------
    eigenvalue : array of complex, shape (m,)
        lambda in rad/s.
    vectors : array of complex, shape (m, n)
        In the coordinates of T, unit 2-norm.
    mode : array of int, shape (m,)
        Column of T with the largest share of kinetic energy, each used once.
    """

    eigenvalue: Complex
    vectors: Complex
    mode: Indices


def still_air_roots(problem: AeroelasticProblem) -> StillAirRoots:
    """Solve (lambda^2 M + lambda C + K) x = 0 of the problem at rest."""
    air = problem.still_air()
    m = len(air.columns)
    zero, eye = np.zeros((m, m)), np.eye(m)
    values, vectors = scipy.linalg.eig(
        np.block([[zero, eye], [-air.stiffness, -air.damping]]),
        np.block([[eye, zero], [zero, air.mass]]),
    )
    upper = np.flatnonzero(values.imag > 0.0)
    order = upper[np.argsort(values[upper].imag)]
    shapes = vectors[:m, order].T
    shapes = shapes / np.linalg.norm(shapes, axis=1, keepdims=True)
    full = np.zeros((len(order), problem.size), complex)
    full[:, air.columns] = shapes
    energy = np.abs(shapes) ** 2 * np.diag(air.mass)
    _, columns = scipy.optimize.linear_sum_assignment(-energy / energy.sum(axis=1, keepdims=True))
    return StillAirRoots(values[order], full, air.columns[columns])
