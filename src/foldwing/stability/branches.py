"""Which flutter points belong to one root, and which still-air mode that root starts from.

Every crossing is followed down in airspeed. Where a followed root meets another crossing, the two
are one branch; at the lowest speed the root has come near to a still-air root, which names it.
"""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.newton import Roots
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.still_air import StillAirRoots, still_air_roots
from foldwing.stability.tracking import (
    Branches,
    advance,
    branches_at,
    resolved_speed,
)

MEETING = 1e-6
"""Relative difference of eigenvalues at which a followed root has met a crossing."""


MARGIN = 2.0
"""A root is followed down to this multiple of the airspeed below which it is not resolved."""


@dataclass(frozen=True)
class Origin:
    """Branch and still-air mode of each crossing.

    Attributes
    ----------
    branch : array of int, shape (m,)
        Crossings of one root share a number, counted from 0 in order of airspeed.
    mode : array of int, shape (m,)
        Column of T.
    confidence : array, shape (m,)
        1 when the root was followed down to the lowest airspeed that resolves it; else the share of
        kinetic energy that the mode has at the crossing.
    """

    branch: Indices
    mode: Indices
    confidence: Real


def trace_origins(problem: AeroelasticProblem, roots: Roots, lowest: float) -> Origin:
    """Follow oscillating crossings down to the airspeed ``lowest`` in m/s.

    Parameters
    ----------
    problem : AeroelasticProblem
    roots : Roots
        Converged crossings with Im p > 0, ascending in airspeed.
    lowest : float
        Where the roots are compared with the still-air ones.
    """
    count = len(roots.p)
    branch = np.arange(count)
    start = branches_at(problem, roots)
    order = np.argsort(-roots.speed, kind="stable")
    followed: Branches | None = None
    members: list[int] = []
    for index in order:
        new = start.take(np.array([index]))
        if followed is not None:
            followed = _lowered(problem, followed, float(roots.speed[index]))
            same = _meeting(followed, new)
            if same is not None:
                branch[branch == branch[members[same]]] = branch[index]
                keep = np.array([i for i in range(len(members)) if i != same], int)
                followed, members = followed.take(keep), [members[i] for i in keep]
        followed = new if followed is None else _joined(followed, new)
        members.append(int(index))
    mode, confidence = energy_modes(problem, roots.right)
    if followed is not None:
        followed = _lowered(problem, followed, lowest)
        named, sure = _named(problem, followed)
        for member, column, certain in zip(members, named, sure, strict=True):
            if certain:
                alike = branch == branch[member]
                mode[alike], confidence[alike] = column, 1.0
    return Origin(_renumbered(branch), mode, confidence)


def _lowered(problem: AeroelasticProblem, followed: Branches, speed: float) -> Branches:
    """Follow branches down to an airspeed, or to where they are still well resolved."""
    lowest = MARGIN * resolved_speed(problem, followed.eigenvalue)
    return advance(problem, followed, np.minimum(followed.speed, np.maximum(speed, lowest)))


def _joined(first: Branches, second: Branches) -> Branches:
    pairs = zip(vars(first).items(), vars(second).values(), strict=True)
    return Branches(**{name: np.concatenate([a, b]) for (name, a), b in pairs})


def _meeting(followed: Branches, crossing: Branches) -> int | None:
    distance = np.abs(followed.eigenvalue / crossing.eigenvalue[0] - 1.0)
    distance = np.where(followed.alive, distance, np.inf)
    return int(distance.argmin()) if distance.min(initial=np.inf) < MEETING else None


def _named(problem: AeroelasticProblem, followed: Branches) -> tuple[Indices, Mask]:
    """Return the still-air mode nearest in frequency and shape, and whether it is beyond doubt."""
    rest: StillAirRoots = still_air_roots(problem)
    mac = np.abs(followed.right.conj() @ rest.vectors.T) ** 2
    near = np.abs(followed.eigenvalue[:, None] / rest.eigenvalue - 1.0)
    best = np.argmax(mac / (1.0 + 10.0 * near), axis=1)
    rows = np.arange(len(best))
    certain = followed.alive & (mac[rows, best] > 0.5) & (near[rows, best] < 0.2)
    return rest.mode[best], certain


def energy_modes(problem: AeroelasticProblem, vectors: Complex) -> tuple[Indices, Real]:
    """Return the column with the largest share of modal kinetic energy, and that share below 1."""
    air = problem.still_air()
    energy = np.zeros(vectors.shape)
    energy[:, air.columns] = np.abs(vectors[:, air.columns]) ** 2 * np.diag(air.mass)
    share = energy / np.maximum(energy.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    mode = share.argmax(axis=1)
    return mode, np.minimum(share[np.arange(len(mode)), mode], 0.99)


def _renumbered(branch: Indices) -> Indices:
    _, first, inverse = np.unique(branch, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))
    return rank[inverse]
