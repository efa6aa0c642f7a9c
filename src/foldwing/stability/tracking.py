"""Roots followed in airspeed by Newton continuation, many branches at once.

Each branch has its own step: it is quartered when the correction is large, when the eigenvector
turns too far, or when Newton's method fails, and doubled when all goes well.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.newton import TOLERANCE, Roots, polish_roots
from foldwing.stability.problem import AeroelasticProblem
from foldwing.stability.status import Status
from foldwing.stability.still_air import StillAirRoots, still_air_roots

SMALLEST_STEP = 1e-5
"""Fraction of the way to the next speed below which a branch is given up."""

ON_THE_WAY = 1e-4
"""Relative size of the last Newton step at speeds that are only passed through."""

LEAST_MAC = 0.8
"""Eigenvectors of consecutive steps must be at least this alike."""

LARGEST_CORRECTION = 0.05
"""Newton may move the predicted root by this fraction of its size."""

SAME_ROOT = 1e-7
"""Relative difference below which two branches have collapsed on one root."""

NEAR_REAL = 0.2
"""A branch lost with |Im| below this fraction of its modulus has reached the real axis."""

SMALLEST_STEP_NEAR_REAL = 0.02
"""The smallest step of a branch near the real axis, which it meets with ever steeper slope."""

FAR_BEYOND = 1.5
"""Multiple of the highest reduced frequency at which a branch is no longer followed."""

BORN = -1
"""In place of a mode: the branch starts from none; it was born of two real roots."""

TINY = 1e-300
"""The smallest airspeed that is not rest."""


@dataclass(frozen=True)
class Branches:
    """Where r branches stand: one root each, at its own airspeed.

    Attributes
    ----------
    speed : array, shape (r,)
    eigenvalue : array of complex, shape (r,)
        lambda in rad/s.
    slope, bend : array of complex, shape (r,)
        First derivative of lambda with respect to U and an estimate of the second.
    right, left : array, shape (r, n)
    residual : array, shape (r,)
    confidence : array, shape (r,)
        Smallest MAC of consecutive steps since the last target speed.
    status : array of int, shape (r,)
        Values of Status; a branch that is not OK stays where it was lost.
    iterations : array of int, shape (r,)
    """

    speed: Real
    eigenvalue: Complex
    slope: Complex
    bend: Complex
    right: Complex
    left: Complex
    residual: Real
    confidence: Real
    status: Indices
    iterations: Indices

    @property
    def alive(self) -> Mask:
        """Which branches are still followed."""
        return np.asarray(self.status == Status.OK)

    def take(self, index: Indices) -> "Branches":
        """Return the branches at the positions ``index``."""
        return Branches(**{name: value[index] for name, value in vars(self).items()})

    def put(self, index: Indices, other: "Branches") -> "Branches":
        """Return a copy with ``other`` at the positions ``index``."""
        fields = {}
        for name, value in vars(self).items():
            fields[name] = value.copy()
            fields[name][index] = getattr(other, name)
        return Branches(**fields)


def branches_at(problem: AeroelasticProblem, roots: Roots) -> Branches:
    """Return branches that start from converged roots."""
    b, U = problem.half_chord, roots.speed
    return Branches(
        speed=U,
        eigenvalue=roots.p * U / b,
        slope=(roots.p + U * roots.p_by_speed) / b,
        bend=np.zeros(len(U), complex),
        right=roots.right,
        left=roots.left,
        residual=roots.residual,
        confidence=np.ones(len(U)),
        status=np.where(roots.converged, Status.OK, Status.NOT_CONVERGED).astype(int),
        iterations=roots.iterations,
    )


def resolved_speed(
    problem: AeroelasticProblem, eigenvalue: Complex, highest: float | None = None
) -> Real:
    """Return the airspeed in m/s below which a root lies beyond a highest reduced frequency.

    By default that is what the problem holds for.
    """
    limit = problem.highest_frequency if highest is None else highest
    return np.abs(eigenvalue.imag) * problem.half_chord / limit


def advance(
    problem: AeroelasticProblem, branches: Branches, target: float | Real, first_step: float = 1.0
) -> Branches:
    """Follow every living branch to the airspeed ``target``.

    Parameters
    ----------
    problem : AeroelasticProblem
    branches : Branches
    target : float or array, shape (r,)
        Airspeed in m/s, above or below the present ones.
    first_step : float
        First step as a fraction of the way.
    """
    end = np.broadcast_to(np.asarray(target, float), branches.speed.shape)
    way = end - branches.speed
    size = np.full(len(way), first_step)
    done = np.where(way == 0.0, 1.0, 0.0)
    state = replace(branches, confidence=np.ones(len(way)))
    while True:
        active = np.flatnonzero(state.alive & (done < 1.0))
        if len(active) == 0:
            return state
        length = np.minimum(size[active], 1.0 - done[active])
        now = state.take(active)
        last = done[active] + length >= 1.0 - 1e-12
        speed = np.where(last, end[active], now.speed + length * way[active])
        new, good, easy = _step(problem, now, speed, np.where(last, TOLERANCE, ON_THE_WAY))
        state = state.put(active[good], new.take(np.flatnonzero(good)))
        done[active[good]] = np.where(last, 1.0, done[active] + length)[good]
        size[active] = np.where(good, length * np.where(easy, 2.0, 1.0), length / 4.0)
        short = np.where(_near_real(now.eigenvalue), SMALLEST_STEP_NEAR_REAL, SMALLEST_STEP)
        state = _given_up(state, active[~good & (size[active] < short)])


def _step(
    problem: AeroelasticProblem, now: Branches, speed: Real, tolerance: Real
) -> tuple[Branches, Mask, Mask]:
    """Predict and correct; say which steps are good and which may be longer next time."""
    b = problem.half_chord
    dU = speed - now.speed
    predicted = now.eigenvalue + now.slope * dU + now.bend * dU**2 / 2.0
    borders = (now.right, now.left)
    roots = polish_roots(problem, predicted * b / speed, speed, borders, 6, tolerance)
    new = branches_at(problem, roots)
    mac = np.abs(np.einsum("mi,mi->m", now.right.conj(), new.right)) ** 2
    moved = np.abs(new.eigenvalue - predicted) / np.abs(new.eigenvalue)
    upper = (new.eigenvalue.imag > 0.0) & (predicted.imag > 0.0)
    good = roots.converged & upper & (mac > LEAST_MAC) & (moved < LARGEST_CORRECTION)
    easy = (mac > 0.95) & (moved < LARGEST_CORRECTION / 4.0)
    bend = (new.slope - now.slope) / np.where(dU == 0.0, 1.0, dU)
    confidence = np.minimum(now.confidence, mac)
    return replace(new, bend=bend, confidence=confidence), good, easy


def _given_up(state: Branches, lost: Indices) -> Branches:
    if len(lost) == 0:
        return state
    status = state.status.copy()
    real = _near_real(state.eigenvalue[lost])
    status[lost] = np.where(real, Status.LEFT_DOMAIN, Status.NOT_CONVERGED)
    return replace(state, status=status)


def _near_real(eigenvalue: Complex) -> Mask:
    return np.asarray(np.abs(eigenvalue.imag) < NEAR_REAL * np.abs(eigenvalue))


@dataclass(frozen=True)
class Loci:
    """Eigenvalues against airspeed in branches; nan where a branch has none.

    Attributes
    ----------
    speed : array, shape (u,)
    eigenvalue : array of complex, shape (u, r)
        lambda in rad/s.
    residual, confidence : array, shape (u, r)
    status : array of int, shape (u, r)
    mode : array of int, shape (r,)
        Column of T that the branch starts from at rest; below 0 when it does not start there.
    """

    speed: Real
    eigenvalue: Complex
    residual: Real
    confidence: Real
    status: Indices
    mode: Indices

    def joined(
        self,
        upward: "Loci",
        above: Indices,
        downward: "Loci",
        below: Indices,
        mode: int = BORN,
    ) -> "Loci":
        """Return these loci with one more branch, recorded at the speeds above and below."""
        shape = (len(self.speed), 1)
        empty = {
            "eigenvalue": np.full(shape, complex(np.nan, 0.0)),
            "residual": np.full(shape, np.nan),
            "confidence": np.zeros(shape),
            "status": np.full(shape, int(Status.ABSENT)),
        }
        columns = {}
        for name, column in empty.items():
            column[above], column[below] = getattr(upward, name), getattr(downward, name)
            columns[name] = np.hstack([getattr(self, name), column])
        return replace(self, mode=np.append(self.mode, mode), **columns)


class Beginning(NamedTuple):
    """Another problem that holds at low airspeed, where it passes into the one of interest.

    Attributes
    ----------
    problem : AeroelasticProblem
    until : float
        Airspeed in m/s at which both are the same.
    """

    problem: AeroelasticProblem
    until: float


def track(problem: AeroelasticProblem, speeds: Real, beginning: Beginning | None = None) -> Loci:
    """Follow every oscillating root from still air through ascending airspeeds.

    Parameters
    ----------
    problem : AeroelasticProblem
    speeds : array, shape (u,)
        In m/s, ascending, not negative.
    beginning : Beginning, optional
        What to follow the roots in first.
    """
    if beginning is None:
        beginning = Beginning(problem, 0.0)
    start = still_air_roots(beginning.problem)
    first = float(speeds[-1]) if beginning.until == 0.0 else beginning.until
    branches = _launched(beginning.problem, start, first)
    since = branches.speed
    slow = speeds[(speeds > 0.0) & (speeds < beginning.until)]
    branches, before = _recorded(beginning.problem, branches, slow, since)
    branches = _passed_on(branches, beginning, problem)
    fast = speeds[speeds >= max(beginning.until, TINY)]
    branches, after = _recorded(problem, branches, fast, since)
    resting = int(np.count_nonzero(speeds == 0.0))
    shape = (resting, len(start.mode))
    return Loci(
        speed=np.asarray(speeds, float),
        eigenvalue=np.vstack(
            [np.tile(start.eigenvalue, (resting, 1)), before.eigenvalue, after.eigenvalue]
        ),
        residual=np.vstack([np.zeros(shape), before.residual, after.residual]),
        confidence=np.vstack([np.ones(shape), before.confidence, after.confidence]),
        status=np.vstack([np.zeros(shape, int), before.status, after.status]),
        mode=start.mode,
    )


def _passed_on(branches: Branches, beginning: Beginning, problem: AeroelasticProblem) -> Branches:
    """Return the branches in the problem of interest, where the first one passes into it.

    The roots are the same there, but not the coordinates.
    """
    if beginning.until == 0.0:
        return branches
    at = _advanced_apart(beginning.problem, branches, beginning.until)
    p = at.eigenvalue * problem.half_chord / at.speed
    there = branches_at(problem, polish_roots(problem, p, at.speed))
    return replace(there, status=np.where(at.alive, there.status, at.status))


def record(
    problem: AeroelasticProblem, branches: Branches, speeds: Real, since: Real | float = 0.0
) -> Loci:
    """Follow branches through positive airspeeds, ascending or descending, and write them down.

    Parameters
    ----------
    problem : AeroelasticProblem
    branches : Branches
    speeds : array, shape (u,)
        In m/s.
    since : float or array, shape (r,)
        Airspeed below which a branch is beyond what the problem holds for.
    """
    return _recorded(problem, branches, speeds, since)[1]


def _recorded(
    problem: AeroelasticProblem, branches: Branches, speeds: Real, since: Real | float
) -> tuple[Branches, Loci]:
    """Return also where the branches have come to."""
    shape = (len(speeds), len(branches.speed))
    values, residual = np.full(shape, complex(np.nan, 0.0)), np.full(shape, np.nan)
    confidence, status = np.zeros(shape), np.zeros(shape, int)
    first = np.broadcast_to(np.asarray(since, float), branches.speed.shape)
    for row, speed in enumerate(speeds):
        ready = np.flatnonzero(speed >= first)
        there = _advanced_apart(problem, branches.take(ready), float(speed))
        branches = _resolved(problem, branches.put(ready, there))
        beyond = speed < np.maximum(first, resolved_speed(problem, branches.eigenvalue))
        alive = branches.alive & ~beyond
        values[row, alive] = branches.eigenvalue[alive]
        residual[row, alive] = branches.residual[alive]
        confidence[row, alive] = branches.confidence[alive]
        status[row] = np.where(branches.alive & beyond, Status.UNRESOLVED, branches.status)
    unknown = np.full(shape[1], -1)
    loci = Loci(np.asarray(speeds, float), values, residual, confidence, status, unknown)
    return branches, loci


def _launched(problem: AeroelasticProblem, start: StillAirRoots, fastest: float) -> Branches:
    """Return the branches at a first airspeed so small that the still-air roots still hold."""
    speed = np.maximum(1e-4 * fastest, resolved_speed(problem, start.eigenvalue))
    p = start.eigenvalue * problem.half_chord / speed
    right = start.vectors
    return branches_at(problem, polish_roots(problem, p, speed, (right, right.conj())))


def _resolved(problem: AeroelasticProblem, branches: Branches) -> Branches:
    """Give up branches that have come far beyond what the problem holds for."""
    lowest = resolved_speed(problem, branches.eigenvalue)
    lost = branches.alive & (branches.speed < lowest / FAR_BEYOND)
    return replace(branches, status=np.where(lost, Status.UNRESOLVED, branches.status))


def _advanced_apart(problem: AeroelasticProblem, branches: Branches, speed: float) -> Branches:
    """Advance; where branches meet on one root, try again with ever smaller steps."""
    result = advance(problem, branches, speed)
    for first_step in (0.1, 0.01):
        together = _collapsed(result)
        if len(together) == 0:
            return result
        again = advance(problem, branches.take(together), speed, first_step)
        result = result.put(together, again)
    together = _collapsed(result)
    status = result.status.copy()
    status[together] = Status.COLLAPSED
    return replace(result, status=status)


def _collapsed(branches: Branches) -> Indices:
    value = np.where(branches.alive, branches.eigenvalue, np.nan)
    with np.errstate(invalid="ignore"):
        near = np.abs(value[:, None] - value) < SAME_ROOT * np.abs(value)
    np.fill_diagonal(near, False)
    return np.flatnonzero(near.any(axis=1))
