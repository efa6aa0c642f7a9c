"""Eigenvalues against airspeed: oscillating branches, real roots, and their certificate."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.certificate import count_unstable
from foldwing.stability.newton import Roots, polish_roots, roots_at
from foldwing.stability.path import EigenvaluePath
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.real_axis import births, real_axis_path, real_roots
from foldwing.stability.status import Status
from foldwing.stability.sweep import Sweep
from foldwing.stability.tracking import (
    BORN,
    TINY,
    Beginning,
    Branches,
    Loci,
    branches_at,
    record,
    track,
)

OVERDAMPED = 0.02
"""Ratio of Im to modulus below which a motion of a whole aircraft no longer oscillates."""

BESIDE = 1e-3
"""Relative change of p and U at which a pair just born is looked for."""

MARGINAL = 1e-6
"""Distance from the stability boundary in p below which a root is on it."""

SAME_EIGENVALUE = 1e-6
"""Relative difference below which a root lies on a branch."""


@dataclass(frozen=True)
class RootLoci:
    """Oscillating branches followed by as many columns of real roots as ever occur at once.

    Attributes
    ----------
    speed : array, shape (u,)
        In m/s.
    eigenvalue : array of complex, shape (u, r)
        lambda in rad/s, nan where a branch has none.
    residual, confidence : array, shape (u, r)
    status : array of int, shape (u, r)
    mode : array of int, shape (r,)
        Column of T that the branch starts from at rest; -1 for real roots, and for oscillating
        ones born of two real roots; -2, -3 ... for the first, second ... of further roots.
    certified : array of bool, shape (u,)
        Whether the unstable eigenvalues listed are as many as the argument principle counts.
    """

    speed: Real
    eigenvalue: Complex
    residual: Real
    confidence: Real
    status: Indices
    mode: Indices
    certified: Mask

    def by_mode(self, count: int) -> "RootLoci":
        """Return the loci with branch j in column j, absent ones empty, and the others behind.

        Further roots come first among the others.

        Parameters
        ----------
        count : int
            Number of columns of T; one without stiffness has no branch from rest.
        """
        others = np.flatnonzero(self.mode < 0)
        source = np.full(count + len(others), -1)
        for column, mode in enumerate(self.mode):
            if mode >= 0:
                source[mode] = column
        source[count:] = others
        absent = source < 0
        empty = {
            "eigenvalue": complex(np.nan, 0.0),
            "residual": np.nan,
            "confidence": 0.0,
            "status": int(Status.ABSENT),
        }
        columns = {
            name: np.where(absent, nothing, getattr(self, name)[:, source])
            for name, nothing in empty.items()
        }
        mode = np.concatenate([np.arange(count), self.mode[others]])
        return replace(self, mode=mode, **columns)

    def with_zero_roots(self, columns: Sequence[int]) -> "RootLoci":
        """Return the loci with an exact zero root at every airspeed in the columns."""
        if not columns:
            return self
        zero = {
            "eigenvalue": 0j,
            "residual": 0.0,
            "confidence": 1.0,
            "status": int(Status.OK),
        }
        changed = {}
        for name, value in zero.items():
            changed[name] = getattr(self, name).copy()
            changed[name][:, list(columns)] = value
        return replace(self, **changed)


class Further(NamedTuple):
    """What an aircraft has besides a clamped wing.

    Attributes
    ----------
    roots : Roots
        Oscillating roots that lead to no root at rest.
    beginning : Beginning
        The problem that holds at low airspeed; further and real roots are left out there.
    """

    roots: Roots
    beginning: Beginning


def root_loci(
    problem: AeroelasticProblem, speeds: Real, sweep: Sweep, further: Further | None = None
) -> RootLoci:
    """Follow all oscillating roots and add the real positive ones.

    Parameters
    ----------
    problem : AeroelasticProblem
    speeds : array, shape (u,)
        In m/s, ascending, not negative.
    sweep : Sweep
        Of the same problem; its path around the unstable region counts the roots.
    further : Further, optional
    """
    real_axis = real_axis_path(problem, float(speeds[-1]), sweep.region.edge)
    beginning = None if further is None else further.beginning
    lowest = 0.0 if beginning is None else beginning.until
    loci = track(problem, speeds, beginning)
    if further is not None:
        loci = _with_further(problem, loci, further)
    loci = _with_born_pairs(problem, loci, sweep, real_axis)
    real, residual = _real_columns(problem, real_axis, speeds, lowest)
    absent = np.isnan(real.real)
    values = np.hstack([loci.eigenvalue, real])
    return RootLoci(
        speed=loci.speed,
        eigenvalue=values,
        residual=np.hstack([loci.residual, residual]),
        confidence=np.hstack([loci.confidence, np.where(absent, 0.0, 1.0)]),
        status=np.hstack([loci.status, np.where(absent, Status.ABSENT, Status.OK)]),
        mode=np.concatenate([loci.mode, np.full(real.shape[1], -1)]),
        certified=_certified(problem, speeds, values, sweep, lowest),
    )


def _with_further(problem: AeroelasticProblem, loci: Loci, further: Further) -> Loci:
    for index in range(len(further.roots.p)):
        root = branches_at(problem, further.roots.take(np.array([index])))
        loci = _with_branch(problem, loci, root, further.beginning.until, BORN - 1 - index)
    value = loci.eigenvalue
    with np.errstate(invalid="ignore"):
        still = (loci.mode < BORN) & (value.imag < OVERDAMPED * np.abs(value))
    status = np.where(still, Status.LEFT_DOMAIN, loci.status)
    return replace(loci, eigenvalue=np.where(still, complex(np.nan, 0.0), value), status=status)


def _with_born_pairs(
    problem: AeroelasticProblem, loci: Loci, sweep: Sweep, real_axis: EigenvaluePath
) -> Loci:
    """Add oscillating roots that no branch from rest passes through, followed both ways.

    Such a pair was born of two real roots: it is known by where that happens while it is unstable,
    or by a crossing of the stability boundary.
    """
    crossings = sweep.crossings
    starts = [crossings.roots.take(np.array([i])) for i in np.flatnonzero(~crossings.divergence)]
    top = float(loci.speed[-1])
    double = births(problem, real_axis, (float(sweep.certificate.speeds[0]), top))
    starts += [_just_born(problem, double, index) for index in range(len(double.p))]
    for root in starts:
        if root.converged[0] and root.p[0].imag > 0.0:
            loci = _with_branch(problem, loci, branches_at(problem, root))
    return loci


def _just_born(problem: AeroelasticProblem, double: Roots, index: int) -> Roots:
    """Return the complex pair at a slightly higher airspeed than the double root.

    Near it U = U0 - c (p - p0)^2, so that p - p0 = i sqrt((U - U0) / c) above U0.
    """
    p, speed = double.p[index].real, double.speed[index]
    beside = roots_at(problem, np.array([p * (1.0 + BESIDE) + 0j]), np.array([speed]))
    slope = abs(1.0 / beside.p_by_speed[0].real)
    higher = speed * (1.0 + BESIDE)
    guess = p + 1j * np.sqrt(2.0 * BESIDE**2 * speed * p / slope)
    return polish_roots(problem, np.array([guess]), np.array([higher]))


def _with_branch(
    problem: AeroelasticProblem,
    loci: Loci,
    root: Branches,
    lowest: float = 0.0,
    mode: int = BORN,
) -> Loci:
    """Add the branch through one root, unless a branch passes through it already."""
    above = np.flatnonzero(loci.speed >= root.speed[0])
    below = np.flatnonzero((loci.speed < root.speed[0]) & (loci.speed >= max(lowest, TINY)))[::-1]
    if mode == BORN and (len(above) == 0 or len(below) == 0):
        return loci
    upward = record(problem, root, loci.speed[above])
    downward = record(problem, root, loci.speed[below])
    rows = np.concatenate([above, below])
    values = np.concatenate([upward.eigenvalue[:, 0], downward.eigenvalue[:, 0]])
    known = np.flatnonzero(np.isfinite(values.real))
    if len(known) == 0:
        return loci
    beside, value = loci.eigenvalue[rows[known[0]]], values[known[0]]
    if (np.abs(beside / value - 1.0) < SAME_EIGENVALUE).any():
        return loci
    unborn = downward.status == Status.LEFT_DOMAIN
    downward = replace(downward, status=np.where(unborn, Status.ABSENT, downward.status))
    return loci.joined(upward, above, downward, below, mode)


def _real_columns(
    problem: AeroelasticProblem, path: EigenvaluePath, speeds: Real, lowest: float
) -> tuple[Complex, Real]:
    moving = np.flatnonzero(speeds >= max(lowest, TINY))
    found = real_roots(problem, path, speeds[moving])
    width = max((len(roots.p) for roots in found), default=0)
    values = np.full((len(speeds), width), complex(np.nan, 0.0))
    residual = np.full((len(speeds), width), np.nan)
    for row, roots in zip(moving, found, strict=True):
        columns = slice(0, len(roots.p))
        values[row, columns] = roots.p.real * speeds[row] / problem.half_chord
        residual[row, columns] = roots.residual
    return values, residual


def _certified(
    problem: AeroelasticProblem, speeds: Real, values: Complex, sweep: Sweep, lowest: float
) -> Mask:
    """Compare the unstable roots listed with those counted; rest is stable by itself.

    Nothing is claimed below the ``lowest`` airspeed at which the problem holds.

    At the very speed of a crossing its root is neither stable nor unstable: it is left out of the
    list, and the count is the smaller one of both sides.
    """
    moving = np.flatnonzero(speeds >= max(lowest, TINY))
    U, roots = speeds[moving], values[moving]
    with np.errstate(invalid="ignore"):
        beyond = roots.real + sweep.region.threshold * np.abs(roots.imag)
        marginal = np.abs(beyond) * problem.half_chord < MARGINAL * U[:, None]
        unstable = (beyond > 0.0) & ~marginal
    listed = (np.where(roots.imag == 0.0, 1, 2) * unstable).sum(axis=1)
    beside = BESIDE * marginal.any(axis=1)
    counted = count_unstable(
        problem, sweep.path, sweep.region, np.concatenate([U * (1 - beside), U * (1 + beside)])
    )
    result = np.asarray(speeds == 0.0)
    result[moving] = listed == counted.reshape(2, -1).min(axis=0)
    return result
