"""Status values, spectra and flutter points."""

from dataclasses import dataclass
from enum import IntEnum
from typing import Protocol

from foldwing.maths.arrays import Complex, Real

ELASTIC = "elastic"
"""Motion of a root that is not one of a whole aircraft."""

PHUGOID, SHORT_PERIOD = "phugoid", "short period"
"""Oscillations of a whole aircraft, the slower one first."""

BODY_FREEDOM = "body freedom"
"""Motion of a root that belongs to a motion of a whole aircraft, but bends the wing as it crosses
the boundary: body-freedom flutter."""

CRITICAL_EVENTS = ("onset", "merger")
"""Events with which an instability begins."""


class Event(Protocol):
    """What a flutter point is judged by, whether of a solver or of a table."""

    @property
    def kind(self) -> str:
        """``flutter`` or ``divergence``."""

    @property
    def event(self) -> str:
        """``onset``, ``recovery`` or ``merger``."""

    @property
    def motion(self) -> str:
        """``elastic``, or the name of a motion of a whole aircraft."""


def is_of_the_whole(point: Event) -> bool:
    """Return whether an aircraft oscillates as a whole at a point, which bounds no airspeed."""
    return point.kind == "flutter" and point.motion not in (ELASTIC, BODY_FREEDOM)


def is_critical(point: Event) -> bool:
    """Return whether an instability that bounds the airspeed begins at a point."""
    return point.event in CRITICAL_EVENTS and not is_of_the_whole(point)


class Status(IntEnum):
    """How a computation of one point, branch or case ended."""

    OK = 0
    NOT_CONVERGED = 1
    """Newton's method did not reach its tolerance: try smaller steps in airspeed."""
    LEFT_DOMAIN = 2
    """The root reached the real axis (overdamped, or merged into two real roots): no oscillating
    root is left on this branch."""
    COLLAPSED = 3
    """Two branches met on one root and could not be told apart: try smaller steps in airspeed."""
    UNCERTIFIED = 4
    """The roots found do not match the count of the argument principle."""
    ABSENT = 5
    """The branch does not exist at this airspeed."""
    FAILED = 6
    """The computation raised an error, whose message stands beside."""
    UNRESOLVED = 7
    """The root oscillates too fast at this airspeed for the aerodynamic model: take more panels
    along the chord."""

    @property
    def meaning(self) -> str:
        """One word for tables and dataset attributes."""
        return self.name.lower()


@dataclass(frozen=True)
class Spectrum:
    """Eigenvalues of a matrix function with all that tells how far they can be trusted.

    Attributes
    ----------
    eigenvalues : array of complex, shape (m,)
    vectors : array of complex, shape (n, m)
        Right eigenvectors, unit 2-norm.
    residuals : array, shape (m,)
        Dimensionless; of T x with the scale that the solver states.
    status : tuple of Status, length m
    iterations : tuple of int, length m
    certified : bool
        Whether the number of roots found equals the count of the argument principle.
    count : int or None
        That count; None when it was not made or did not settle.
    """

    eigenvalues: Complex
    vectors: Complex
    residuals: Real
    status: tuple[Status, ...]
    iterations: tuple[int, ...]
    certified: bool = False
    count: int | None = None


@dataclass(frozen=True)
class FlutterPoint:
    """A neutrally stable state: T(p, U) x = 0 with p on the damping threshold.

    Attributes
    ----------
    kind : str
        ``flutter`` (Im p > 0) or ``divergence`` (p = 0, or p > 0 for a ``merger``).
    event : str
        ``onset``, ``recovery`` or ``merger`` (an unstable complex pair becomes real).
    speed : float
        Airspeed in m/s.
    p : complex
        Reduced Laplace variable lambda b / U.
    frequency : float
        Frequency in Hz, 0 for divergence.
    strength : float
        d(Re lambda/Im lambda)/dU in s/m, positive for an onset; nan for divergence.
    vector : array of complex, shape (n,)
        Right null vector of T, unit 2-norm.
    residual : float
        2-norm of T x over the 1-norm of T.
    branch : int
        Points of one root share this number; -1 when the branch is not known.
    classification : str
        ``hump`` when the same branch recovers within the range, ``coalescence`` otherwise, empty
        for recoveries, divergence and mergers, and where one cannot tell.
    mode : int
        Index of the still-air mode that the root starts from, or of the mode with the largest share
        of kinetic energy where the root does not lead to one (divergence, mergers).
    mode_confidence : float
        1 when the root was followed down to low speed; else that share, below 1.
    motion : str
        ``elastic``, or the name of a motion of a whole aircraft that the root belongs to: its
        oscillations are listed, but never critical; ``body freedom`` when the wing takes part.
    origin : str
        Name of the motion of a whole aircraft on whose branch the point lies, empty otherwise.
    """

    kind: str
    event: str
    speed: float
    p: complex
    frequency: float
    strength: float
    vector: Complex
    residual: float
    branch: int = -1
    classification: str = ""
    mode: int = -1
    mode_confidence: float = 0.0
    motion: str = ELASTIC
    origin: str = ""
