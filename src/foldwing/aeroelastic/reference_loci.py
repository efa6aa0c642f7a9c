"""Modes of the reference followed over airspeed, by the likeness of their vectors.

At every airspeed each mode is expected a little further on its way; the roots nearest to there are
computed, and the one with a like structural vector goes on as that mode. Modes whose surroundings
an earlier shift covers need none of their own. Where a mode is lost, the airspeed half way is
passed through first.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from foldwing.aeroelastic.reference import Marching, Reference
from foldwing.aeroelastic.reference_roots import CONVERGED, roots_near
from foldwing.maths.arrays import Complex, Indices, Mask, Real
from foldwing.stability.status import Spectrum, Status
from foldwing.stability.tracking import NEAR_REAL, SAME_ROOT

LEAST_MAC = 0.6
"""Structural vectors of a mode at consecutive airspeeds must be at least this alike."""

LONGEST_STEP = 0.25
"""Modes pass through airspeeds in between where the next one is further by more than this of it."""

HALVINGS = 3
"""How often the way to the next airspeed is halved before a mode is given up."""

BESIDE = 1e-3
"""Relative distance of a shift from where a root is expected, which may be right."""

REAL = 1e-6
"""Share of Im in the modulus of a root below which it is real."""

HIGHEST_PHASE = np.pi / 2.0
"""Phase that a mode at rest may turn in one step; faster ones the lattice does not resolve."""

ROOTS, TOLERANCE = 6, 1e-10
"""Roots computed around each shift, and the accuracy asked of Arnoldi's method for all of them."""


@dataclass(frozen=True)
class ModesAtSpeed:
    """Where n modes stand at one airspeed.

    Attributes
    ----------
    airspeed : float
        In m/s.
    eigenvalue : array of complex, shape (n,)
        lambda in rad/s, nan for a mode that is not there.
    drift, slope : array of complex, shape (n,)
        lambda less that without air, and its change per m/s.
    vectors : array of complex, shape (n, n)
        Modal coordinates of each root in rows, of unit 2-norm.
    residual, confidence : array, shape (n,)
        Confidence is the likeness (MAC) to the vector before.
    status : array of int, shape (n,)
    """

    airspeed: float
    eigenvalue: Complex
    drift: Complex
    slope: Complex
    vectors: Complex
    residual: Real
    confidence: Real
    status: Indices

    @property
    def found(self) -> Mask:
        """Which modes have a root."""
        return np.asarray(self.status == Status.OK)

    def expected(self, marching: Marching) -> Complex:
        """Return where the roots are expected at another airspeed, shape (n,)."""
        ahead = marching.airspeed - self.airspeed
        return np.asarray(marching.in_vacuo() + self.drift + self.slope * ahead)

    def with_modes(self, chosen: Mask, other: "ModesAtSpeed") -> "ModesAtSpeed":
        """Return these modes with the chosen ones as in another state."""
        names = ("eigenvalue", "drift", "slope", "residual", "confidence", "status")
        parts = {n: np.where(chosen, getattr(other, n), getattr(self, n)) for n in names}
        vectors = np.where(chosen[:, None], other.vectors, self.vectors)
        return replace(self, vectors=vectors, **parts)


def at_rest(omega: Real) -> ModesAtSpeed:
    """Return the modes from which to begin: without air, each by itself; none without stiffness."""
    count = len(omega)
    zero = np.zeros(count)
    return ModesAtSpeed(
        airspeed=0.0,
        eigenvalue=np.full(count, np.nan + 0j),
        drift=zero + 0j,
        slope=zero + 0j,
        vectors=np.eye(count, dtype=complex),
        residual=np.full(count, np.nan),
        confidence=zero,
        status=np.where(omega > 0.0, int(Status.OK), int(Status.ABSENT)),
    )


def follow(reference: Reference, speeds: Real) -> Iterator[ModesAtSpeed]:
    """Follow every mode over ascending airspeeds; give the modes at each as soon as it is done.

    Parameters
    ----------
    reference : Reference
    speeds : array, shape (u,)
        In m/s, ascending, greater than 0.

    Yields
    ------
    ModesAtSpeed
        A mode too fast for the steps at an airspeed is ``unresolved`` there and begins later; one
        that is lost stays lost.
    """
    state, between = at_rest(reference.modes.omega), reference.own_mesh
    for speed in speeds.tolist():
        steps = math.ceil((speed - state.airspeed) / (LONGEST_STEP * speed) - 1e-9)
        for passed in np.linspace(state.airspeed, speed, steps + 1)[1:-1].tolist():
            state = advance(between, state, passed)
        state = advance(reference, state, speed)
        yield state


def advance(
    reference: Reference, state: ModesAtSpeed, airspeed: float, halvings: int = HALVINGS
) -> ModesAtSpeed:
    """Return the modes at another airspeed."""
    marching = reference.at(airspeed)
    slow = reference.modes.omega * marching.step <= HIGHEST_PHASE
    found = _matched(marching, state, slow)
    lost = state.found & (found.status == Status.NOT_CONVERGED)
    lost |= state.found & (found.status == Status.COLLAPSED)
    halfway = (state.airspeed + airspeed) / 2.0
    if not lost.any() or halvings == 0 or halfway <= reference.slowest:
        return found
    only = replace(state, status=np.where(lost, state.status, int(Status.ABSENT)))
    middle = advance(reference, only, halfway, halvings - 1)
    again = _matched(marching, middle, slow)
    return _without_doubles(found.with_modes(lost, again))


def _matched(marching: Marching, state: ModesAtSpeed, slow: Mask) -> ModesAtSpeed:
    """Return every mode at the root near where it is expected whose vector is like its own."""
    expected, alone = state.expected(marching), marching.in_vacuo()
    unresolved = ~slow & np.isin(state.status, (Status.OK, Status.UNRESOLVED))
    result = _none_found(marching, state, np.where(unresolved, int(Status.UNRESOLVED), -1))
    begun = slow & (state.status == Status.UNRESOLVED)
    result = replace(result, status=np.where(begun, int(Status.NOT_CONVERGED), result.status))
    pool: list[_Surroundings] = []
    for mode in np.flatnonzero((state.found | begun) & slow):
        root = next((r for s in pool if (r := s.match(expected[mode], state.vectors[mode]))), None)
        if root is None:
            pool.append(_surroundings(marching, expected[mode]))
            root = pool[-1].match(expected[mode], state.vectors[mode], whole=True)
        if root is not None:
            result = _with_root(result, int(mode), root, state, alone[mode])
    return _without_doubles(result)


@dataclass(frozen=True)
class _Root:
    eigenvalue: complex
    vector: Complex
    residual: float
    confidence: float


@dataclass(frozen=True)
class _Surroundings:
    """The oscillating roots around a shift, and how far they are all there are."""

    shift: complex
    radius: float
    eigenvalues: Complex
    vectors: Complex
    residuals: Real

    def match(self, expected: complex, vector: Complex, whole: bool = False) -> _Root | None:
        """Return the nearest root with a like vector, None if there is none or one may be nearer.

        With ``whole`` nothing is known of nearer ones and the nearest here is taken.
        """
        mac = np.abs(self.vectors.conj() @ vector) ** 2
        away = np.where(mac >= LEAST_MAC, np.abs(self.eigenvalues - expected), np.inf)
        if not np.isfinite(away).any():
            return None
        best = int(np.argmin(away))
        if not whole and away[best] > self.radius - abs(expected - self.shift):
            return None
        q = self.vectors[best]
        return _Root(self.eigenvalues[best], q, float(self.residuals[best]), float(mac[best]))


def _surroundings(marching: Marching, expected: complex) -> _Surroundings:
    shift = expected * (1.0 + BESIDE)
    spectrum: Spectrum = roots_near(marching, shift, ROOTS, TOLERANCE)
    values = spectrum.eigenvalues
    kept = (values.imag > REAL * np.abs(values)) & (spectrum.residuals < CONVERGED)
    q = spectrum.vectors[marching.coordinates][:, kept].T
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    radius = float(np.abs(values - shift).max(initial=0.0))
    return _Surroundings(shift, radius, values[kept], q, spectrum.residuals[kept])


def _none_found(marching: Marching, state: ModesAtSpeed, status: Indices) -> ModesAtSpeed:
    """Return the modes at a new airspeed before any is found: why they are not there."""
    count = len(state.status)
    with np.errstate(invalid="ignore"):
        near_real = np.abs(state.eigenvalue.imag) < NEAR_REAL * np.abs(state.eigenvalue)
    lost = np.where(near_real, int(Status.LEFT_DOMAIN), int(Status.NOT_CONVERGED))
    why = np.where(state.found, lost, state.status)
    return replace(
        state,
        airspeed=marching.airspeed,
        eigenvalue=np.full(count, np.nan + 0j),
        residual=np.full(count, np.nan),
        confidence=np.zeros(count),
        status=np.where(status >= 0, status, why),
    )


def _with_root(
    modes: ModesAtSpeed, mode: int, root: _Root, before: ModesAtSpeed, alone: complex
) -> ModesAtSpeed:
    """Return the modes with one at a root."""
    one = np.arange(len(modes.status)) == mode
    drift = root.eigenvalue - alone
    slope = (drift - before.drift[mode]) / (modes.airspeed - before.airspeed)
    return replace(
        modes,
        eigenvalue=np.where(one, root.eigenvalue, modes.eigenvalue),
        drift=np.where(one, drift, modes.drift),
        slope=np.where(one, slope, modes.slope),
        vectors=np.where(one[:, None], root.vector, modes.vectors),
        residual=np.where(one, root.residual, modes.residual),
        confidence=np.where(one, root.confidence, modes.confidence),
        status=np.where(one, int(Status.OK), modes.status),
    )


def _without_doubles(modes: ModesAtSpeed) -> ModesAtSpeed:
    """Mark the less alike of two modes that met on one root as collapsed."""
    status = modes.status.copy()
    value = modes.eigenvalue
    for mode in np.flatnonzero(modes.found)[np.argsort(-modes.confidence[modes.found])]:
        same = np.abs(value - value[mode]) < SAME_ROOT * np.abs(value[mode])
        rivals = np.flatnonzero(same & (status == Status.OK))
        status[rivals[rivals != mode]] = int(Status.COLLAPSED)
    gone = status == Status.COLLAPSED
    return replace(modes, status=status, eigenvalue=np.where(gone, np.nan + 0j, value))
