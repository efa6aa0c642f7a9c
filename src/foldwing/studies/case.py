"""One case: a wing at given fold angles, its modes and all its flutter points."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from foldwing.aeroelastic.flight_modes import with_motions
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.maths.arrays import Complex
from foldwing.results.aircraft_summary import DIVERGENCE
from foldwing.results.flutter_table import FlutterRow
from foldwing.stability.flutter import FlutterAnalysis, find_flutter, lowest_resolved
from foldwing.stability.real_axis import real_axis_path, real_roots
from foldwing.stability.status import ELASTIC, FlutterPoint, Status
from foldwing.structure.modes import StructuralModes
from foldwing.studies.flight_level import Flight
from foldwing.studies.grid import radians

CLEAR = 1.05
"""A search beyond a positive threshold starts at this multiple of where all modes are resolved: in
moving air they are a little faster than at rest."""


@dataclass(frozen=True)
class Case:
    """A solved case.

    Attributes
    ----------
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    modes : StructuralModes
    system : AeroelasticSystem
    analysis : FlutterAnalysis
    warning : str
        What makes the result doubtful, empty when nothing does.
    flight : Flight, optional
        What is known of an aircraft besides.
    """

    folds: tuple[float, ...]
    modes: StructuralModes
    system: AeroelasticSystem
    analysis: FlutterAnalysis
    warning: str = ""
    flight: Flight | None = None

    @property
    def uncertified_modes(self) -> tuple[str, ...]:
        """Modes that the aerodynamic model does not resolve at the lowest airspeeds."""
        return tuple(self.modes.names[column] for column in self.analysis.unresolved)

    @property
    def remarks(self) -> str:
        """What makes the result doubtful, and where an aircraft cannot fly level."""
        level = "" if self.flight is None else self.flight.warning
        return " ".join(filter(None, (self.warning, level)))

    @property
    def motion_names(self) -> tuple[str, ...]:
        """Motions of an aircraft as a whole; none of a clamped wing."""
        return () if self.flight is None else self.flight.modes.names

    @cached_property
    def unstable_motions(self) -> tuple[str, ...]:
        """Motions of an aircraft beyond the boundary at the lowest airspeed already.

        Oscillations by their names, and ``divergence`` for each real root that grows.
        """
        if self.flight is None:
            return ()
        lowest = np.array(self.analysis.speed_range[:1])
        found = self.flight.modes
        value = found.eigenvalues(self.system, lowest)[0]
        beyond = value.real + self.analysis.threshold * value.imag > 0.0
        edge = self.analysis.sweep.region.edge
        path = real_axis_path(self.system, self.analysis.speed_range[1], edge)
        growing = len(real_roots(self.system, path, lowest)[0].p)
        names = [name for name, out in zip(found.names, beyond, strict=True) if out]
        return (*names, *[DIVERGENCE] * growing)

    @property
    def status(self) -> Status:
        """OK, or uncertified when the count of unstable roots does not agree."""
        return Status.OK if self.analysis.certified else Status.UNCERTIFIED

    def rows(self, index: int) -> list[FlutterRow]:
        """Return the table of flutter points of this case, whose number is ``index``."""
        names, threshold = self.modes.names, self.analysis.threshold
        return [
            flutter_row(point, index, self.folds, names, threshold)
            for point in self.analysis.points
        ]

    def motions(self) -> Complex:
        """Return the motion at each flutter point in modal coordinates, shape (points, n)."""
        points = self.analysis.points
        p = np.array([point.p or 1e-9 for point in points], complex)
        speed = np.array([point.speed for point in points], float)
        x = np.array([point.vector for point in points]).reshape(len(points), self.system.size)
        return self.system.modal_vectors(p, speed, x)


def _name(point: FlutterPoint, names: Sequence[str]) -> str:
    """Return the name of the mode, or of the motion of an aircraft, that a point belongs to."""
    return point.origin or (names[point.mode] if point.motion == ELASTIC else point.motion)


def flutter_row(
    point: FlutterPoint,
    case: int,
    folds: tuple[float, ...],
    names: Sequence[str],
    threshold: float,
) -> FlutterRow:
    """Return the row of a flutter point in the table; ``names`` are those of the modes."""
    return FlutterRow(
        case=case,
        fold=folds,
        kind=point.kind,
        event=point.event,
        classification=point.classification,
        speed=point.speed,
        frequency=point.frequency,
        strength=point.strength,
        branch=point.branch,
        mode_name=_name(point, names),
        mode_confidence=point.mode_confidence,
        threshold=threshold,
        residual=point.residual,
        motion=point.motion,
    )


def solve_case(
    model: AeroelasticWing, folds: tuple[float, ...], speed_range: tuple[float, float]
) -> Case:
    """Return all flutter points of a wing at one set of fold angles.

    Parameters
    ----------
    model : AeroelasticWing
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    speed_range : (float, float)
        Lowest and highest airspeed in m/s.

    Raises
    ------
    InputError
        When segments of a vortex lattice lie on each other.
    """
    modes = model.modes(radians(folds))
    warning = model.warning(modes)
    system = model.system(modes)
    threshold = model.wing.analysis.damping_threshold
    if model.wing.aircraft is not None:
        flight = Flight.of(model, modes, system, speed_range)
        speed_range = _resolved_range(system, flight.speed_range, threshold)
        analysis = find_flutter(system, speed_range, threshold)
        analysis = with_motions(analysis, system, flight.modes)
        return Case(folds, modes, system, analysis, warning, flight)
    speed_range = _resolved_range(system, speed_range, threshold)
    return Case(folds, modes, system, find_flutter(system, speed_range, threshold), warning)


def _resolved_range(
    system: AeroelasticSystem, speed_range: tuple[float, float], threshold: float
) -> tuple[float, float]:
    """Return the airspeeds to search; with a positive threshold only those that resolve all modes.

    A mode that comes into what the model resolves is damped by less than the threshold there: it
    would be beyond the boundary without having crossed it.
    """
    slow, fast = speed_range
    if threshold <= 0.0:
        return speed_range
    start = max(slow, CLEAR * float(lowest_resolved(system, threshold).max(initial=0.0)))
    if start >= fast:
        limit = f"the lattice resolves all modes at this threshold only from {start:.3g} m/s on"
        remedy = "Take a shorter wake, fewer system_modes, or a higher --max-speed."
        raise InputError("--damping-threshold", threshold, limit, remedy)
    return start, fast


class Solved(Protocol):
    """A case with a result, of a wing or of anything else."""

    @property
    def analysis(self) -> FlutterAnalysis:
        """All its flutter points."""

    @property
    def uncertified_modes(self) -> tuple[str, ...]:
        """Modes that are not resolved at the lowest airspeeds."""

    @property
    def unstable_motions(self) -> tuple[str, ...]:
        """Oscillations of an aircraft beyond the boundary at the lowest airspeed already."""

    @property
    def status(self) -> Status:
        """How the case ended."""


def verdict_variables(cases: Sequence[Solved | None]) -> dict[str, Any]:
    """Return what is known of each case as a whole, as dataset variables; None for a failed one."""
    fold = ("fold",)
    status = [Status.FAILED if case is None else case.status for case in cases]
    lowest = [np.nan if case is None else case.analysis.valid_from for case in cases]
    outside = ["" if case is None else ", ".join(case.uncertified_modes) for case in cases]
    already = [-1 if case is None else case.analysis.unstable_from_start for case in cases]
    motions = ["" if case is None else ", ".join(case.unstable_motions) for case in cases]
    return {
        "certified": (fold, np.array([value is Status.OK for value in status])),
        "case_status": (fold, np.array([int(value) for value in status])),
        "valid_from": (fold, np.array(lowest)),
        "uncertified_modes": (fold, np.array(outside, np.str_)),
        "unstable_from_start": (fold, np.array(already)),
        "unstable_motions": (fold, np.array(motions, np.str_)),
    }
