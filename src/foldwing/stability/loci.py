"""Eigenvalues against airspeed: oscillating branches, real roots, and their certificate."""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.real_axis import real_axis_path, real_roots
from foldwing.stability.status import Status
from foldwing.stability.sweep import Sweep, count_unstable
from foldwing.stability.tracking import track


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
        Column of T that the branch starts from at rest; -1 for real roots.
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


def root_loci(problem: AeroelasticProblem, speeds: Real, sweep: Sweep) -> RootLoci:
    """Follow all oscillating roots and add the real positive ones.

    Parameters
    ----------
    problem : AeroelasticProblem
    speeds : array, shape (u,)
        In m/s, ascending, not negative.
    sweep : Sweep
        Of the same problem; its path around the unstable region counts the roots.
    """
    loci = track(problem, speeds)
    real, residual = _real_columns(problem, speeds)
    absent = np.isnan(real.real)
    values = np.hstack([loci.eigenvalue, real])
    return RootLoci(
        speed=loci.speed,
        eigenvalue=values,
        residual=np.hstack([loci.residual, residual]),
        confidence=np.hstack([loci.confidence, np.where(absent, 0.0, 1.0)]),
        status=np.hstack([loci.status, np.where(absent, Status.ABSENT, Status.OK)]),
        mode=np.concatenate([loci.mode, np.full(real.shape[1], -1)]),
        certified=_certified(problem, speeds, values, sweep),
    )


def _real_columns(problem: AeroelasticProblem, speeds: Real) -> tuple[Complex, Real]:
    path = real_axis_path(problem, float(speeds[-1]))
    moving = np.flatnonzero(speeds > 0.0)
    found = real_roots(problem, path, speeds[moving])
    width = max((len(roots.p) for roots in found), default=0)
    values = np.full((len(speeds), width), complex(np.nan, 0.0))
    residual = np.full((len(speeds), width), np.nan)
    for row, roots in zip(moving, found, strict=True):
        columns = slice(0, len(roots.p))
        values[row, columns] = roots.p.real * speeds[row] / problem.half_chord
        residual[row, columns] = roots.residual
    return values, residual


def _certified(problem: AeroelasticProblem, speeds: Real, values: Complex, sweep: Sweep) -> Mask:
    """Compare the unstable roots listed with those counted; rest is stable by itself."""
    with np.errstate(invalid="ignore"):
        beyond = values.real + sweep.region.threshold * np.abs(values.imag) > 0.0
    listed = np.where(values.imag == 0.0, 1, 2) * beyond
    expected = listed.sum(axis=1)
    counted = np.zeros(len(speeds), int)
    moving = speeds > 0.0
    counted[moving] = count_unstable(problem, sweep.path, sweep.region, speeds[moving])
    counted[~moving] = expected[~moving]
    return np.asarray(counted == expected)
