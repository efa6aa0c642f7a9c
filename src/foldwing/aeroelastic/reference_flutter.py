"""Where modes of the reference cross the stability boundary between two airspeeds.

Nothing is certified: two crossings of one mode between neighbouring airspeeds go unseen.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.optimize import brentq

from foldwing.aeroelastic.reference import Reference
from foldwing.aeroelastic.reference_loci import REAL, ModesAtSpeed, advance
from foldwing.aeroelastic.reference_roots import CONVERGED, roots_near
from foldwing.maths.arrays import Real
from foldwing.stability.status import FlutterPoint, Status

ACCURACY = 1e-10
"""Relative accuracy of the airspeed of a crossing."""

BESIDE = 1e-5
"""Relative distance in airspeed over which the strength is taken."""

RIGID = 0.999
"""Share of motions without stiffness in that of a root at zero above which it is neutral."""

GROWING, NEUTRAL, REAL_ROOTS = 0.15, 0.01, 10
"""Reduced shifts p around which real roots are sought, and how many roots are computed there."""


def flutter_crossings(
    reference: Reference, below: ModesAtSpeed, above: ModesAtSpeed, threshold: float = 0.0
) -> list[FlutterPoint]:
    """Return where oscillating modes pass a damping ratio between two airspeeds.

    Parameters
    ----------
    reference : Reference
    below, above : ModesAtSpeed
        At neighbouring airspeeds.
    threshold : float
        Damping ratio, positive stable.
    """
    both = below.found & above.found & np.isfinite(below.eigenvalue) & np.isfinite(above.eigenvalue)
    changed = (beyond(below, threshold) > 0.0) != (beyond(above, threshold) > 0.0)
    points = (
        _crossing(reference, (below, above), int(mode), threshold)
        for mode in np.flatnonzero(both & changed)
    )
    return [point for point in points if point is not None]


def beyond(state: ModesAtSpeed, threshold: float) -> Real:
    """Return how far each mode is beyond the boundary, in rad/s, shape (n,).

    Parameters
    ----------
    state : ModesAtSpeed
    threshold : float
        Damping ratio of the boundary, positive stable.
    """
    return np.asarray(state.eigenvalue.real + threshold * np.abs(state.eigenvalue.imag))


def _crossing(
    reference: Reference,
    ends: tuple[ModesAtSpeed, ModesAtSpeed],
    mode: int,
    threshold: float,
) -> FlutterPoint | None:
    """Return the crossing of one mode, None when it is lost on the way."""
    path = _Path(reference, ends, mode)
    below, above = ends
    try:
        speed = float(
            brentq(
                lambda U: float(beyond(path.at(U), threshold)[mode]),
                below.airspeed,
                above.airspeed,
                xtol=ACCURACY * above.airspeed,
                rtol=ACCURACY,
            )
        )
        state, beside = path.at(speed), path.at(speed * (1.0 + BESIDE))
    except ArithmeticError:
        return None
    value, change = state.eigenvalue[mode], beside.airspeed - speed
    ratio, further = (e.real / abs(e.imag) for e in (value, beside.eigenvalue[mode]))
    return FlutterPoint(
        kind="flutter",
        event="onset" if beyond(above, threshold)[mode] > 0.0 else "recovery",
        speed=speed,
        p=complex(value * reference.model.half_chord / speed),
        frequency=float(abs(value.imag) / (2.0 * np.pi)),
        strength=float((further - ratio) / change),
        vector=state.vectors[mode],
        residual=float(state.residual[mode]),
        branch=mode,
        mode=mode,
        mode_confidence=float(min(below.confidence[mode], above.confidence[mode])),
    )


class _Path:
    """One mode at any airspeed between two, each time from the nearest one known."""

    def __init__(
        self, reference: Reference, ends: tuple[ModesAtSpeed, ModesAtSpeed], mode: int
    ) -> None:
        one = np.arange(reference.modes.count) == mode
        self.reference = reference
        self.mode = mode
        self.known = [
            replace(end, status=np.where(one, end.status, int(Status.ABSENT))) for end in ends
        ]

    def at(self, airspeed: float) -> ModesAtSpeed:
        nearest = min(self.known, key=lambda state: abs(state.airspeed - airspeed))
        if nearest.airspeed == airspeed:
            return nearest
        state = advance(self.reference, nearest, airspeed)
        if not state.found[self.mode]:
            raise ArithmeticError
        self.known.append(state)
        return state


@dataclass(frozen=True)
class RealRoots:
    """Real roots at one airspeed.

    Attributes
    ----------
    airspeed : float
    eigenvalue, residual : array, shape (r,)
        lambda in rad/s, descending.
    vectors : array, shape (r, n)
        Modal coordinates, of unit 2-norm.
    """

    airspeed: float
    eigenvalue: Real
    residual: Real
    vectors: Real

    @property
    def growing(self) -> int:
        """Number of roots that grow."""
        return int((self.eigenvalue > 0.0).sum())


def real_roots(reference: Reference, airspeed: float, shift: float = GROWING) -> RealRoots:
    """Return the real roots among those nearest to a real reduced shift p, but not neutral ones."""
    marching = reference.at(airspeed)
    rate = airspeed / reference.model.half_chord
    spectrum = roots_near(marching, complex(shift * rate), REAL_ROOTS)
    values = spectrum.eigenvalues
    kept = (np.abs(values.imag) < REAL * (np.abs(values) + rate * REAL)) & (
        spectrum.residuals < CONVERGED
    )
    order = np.flatnonzero(kept)[np.argsort(-values[kept].real)]
    x = spectrum.vectors[marching.coordinates][:, order].T
    largest = np.take_along_axis(x, np.abs(x).argmax(axis=1, keepdims=True), axis=1)
    q: Real = (x / largest).real
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    found = values[order].real
    rigid = np.linalg.norm(q[:, reference.modes.omega == 0.0], axis=1) > RIGID
    moving = ~(rigid & (np.abs(found) < REAL * rate))
    return RealRoots(airspeed, found[moving], spectrum.residuals[order][moving], q[moving])


def one_crosses(below: RealRoots, above: RealRoots) -> bool:
    """Return whether one more real root grows at one of two airspeeds than at the other."""
    return abs(above.growing - below.growing) == 1


def divergence_crossing(
    reference: Reference, below: RealRoots, above: RealRoots
) -> FlutterPoint | None:
    """Return where one more real root grows at the higher of two airspeeds, or one fewer.

    Returns
    -------
    FlutterPoint or None
        None too when the roots nearest to zero do not show the crossing that the counts promise.
    """
    if not one_crosses(below, above):
        return None
    index = min(above.growing, below.growing)

    @cache
    def roots(airspeed: float) -> RealRoots:
        return real_roots(reference, airspeed, NEUTRAL)

    def growth(airspeed: float) -> float:
        values = roots(airspeed).eigenvalue
        return float(values[index]) if len(values) > index else -airspeed

    ends = (below.airspeed, above.airspeed)
    if growth(ends[0]) * growth(ends[1]) > 0.0:
        return None
    speed = float(brentq(growth, *ends, xtol=ACCURACY * ends[1], rtol=ACCURACY))
    if abs(growth(speed)) > REAL * speed / reference.model.half_chord:  # a jump, not a zero
        return None
    root = roots(speed)
    energy = root.vectors[index] ** 2
    return FlutterPoint(
        kind="divergence",
        event="onset" if growth(ends[1]) > growth(ends[0]) else "recovery",
        speed=speed,
        p=0.0 + 0.0j,
        frequency=0.0,
        strength=float("nan"),
        vector=root.vectors[index].astype(complex),
        residual=float(root.residual[index]),
        mode=int(np.argmax(energy)),
        mode_confidence=float(energy.max()),
    )
