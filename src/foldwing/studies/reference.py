"""Eigenvalues against airspeed by the reference, and a response in time: slow, for checking.

The sweep only says up to which airspeed to look. What is reported comes from the reference alone,
which follows modes from airspeed to airspeed and certifies nothing.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aerodynamics.doubts import check_equal_chords
from foldwing.aeroelastic.reference import Reference
from foldwing.aeroelastic.reference_flutter import (
    RealRoots,
    beyond,
    divergence_crossing,
    flutter_crossings,
    one_crosses,
    real_roots,
)
from foldwing.aeroelastic.reference_loci import ModesAtSpeed, follow
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Real
from foldwing.model import Wing
from foldwing.results.flutter_table import table_variables
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.stability.loci import RootLoci
from foldwing.stability.status import FlutterPoint, Status
from foldwing.structure.following import FollowedModes
from foldwing.studies.case import flutter_row, solve_case
from foldwing.studies.flutter import loci_variables, padded, search_attributes
from foldwing.studies.grid import radians
from foldwing.studies.loads import unit_motions
from foldwing.studies.modes import fold_coordinates, mode_variables, shape_variables
from foldwing.studies.response import tip_response
from foldwing.studies.shapes import surface_grid
from foldwing.studies.speeds import picture_speeds, speed_range

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]

SPEEDS = 13
"""Airspeeds looked at when none are named."""

METHOD = "beam segments, unsteady vortex lattice marching in time, reference ({scheme} scheme)"
"""How the numbers are computed."""

WARNING = (
    "The reference follows each mode over {count} airspeeds: two points of one mode between "
    "neighbouring ones, and mergers, go unseen."
)

MISSED = "A real root begins or ceases to grow between {:.4g} and {:.4g} m/s; where was not found."


def reference_model(wing: Wing, dropped: tuple[str, ...] = ()) -> AeroelasticWing:
    """Return the wing with a lattice that marches in time: the model's scheme, or ``average``.

    Raises
    ------
    InputError
        When the chords differ: a step in time must fit all of them.
    """
    remedy = "Use --method sweep, which needs no steps."
    check_equal_chords(wing, "--method", "reference", remedy)
    if wing.lattice.scheme == "exact":
        wing = wing.with_lattice(scheme="average")
    return AeroelasticWing(wing, "lattice", dropped)


@dataclass(frozen=True)
class ReferenceFlutter:
    """What the reference finds at some airspeeds and between them.

    Attributes
    ----------
    speeds : array, shape (u,)
        In m/s.
    modes : tuple of ModesAtSpeed, length u
    real : tuple of RealRoots, length u
    points : tuple of FlutterPoint
        Ascending in airspeed. An onset is a ``hump`` when its branch recovers at a higher airspeed
        looked at, and has no class otherwise: the airspeeds end before one can tell.
    threshold : float
        Damping ratio of the boundary, positive stable.
    missed : tuple of (float, float)
        Airspeeds in m/s between which one more or one fewer real root grows without a point.
    """

    speeds: Real
    modes: tuple[ModesAtSpeed, ...]
    real: tuple[RealRoots, ...]
    points: tuple[FlutterPoint, ...]
    threshold: float = 0.0
    missed: tuple[tuple[float, float], ...] = ()

    @property
    def critical(self) -> FlutterPoint | None:
        """The lowest onset of flutter."""
        flutter = (point for point in self.points if point.kind == "flutter")
        return next((point for point in flutter if point.event == "onset"), None)

    @property
    def unstable_from_start(self) -> int:
        """Number of roots beyond the boundary at the lowest airspeed."""
        first = self.modes[0]
        outside = first.found & (beyond(first, self.threshold) > 0.0)
        return 2 * int(outside.sum()) + self.real[0].growing


def solve_reference(
    reference: Reference,
    speeds: Real,
    threshold: float = 0.0,
    progress: Callable[[int], None] | None = None,
) -> ReferenceFlutter:
    """Follow the modes over ascending airspeeds and find where they cross the boundary."""
    modes: list[ModesAtSpeed] = []
    real: list[RealRoots] = []
    points: list[FlutterPoint] = []
    missed: list[tuple[float, float]] = []
    for state in follow(reference, speeds):
        modes.append(state)
        real.append(real_roots(reference, state.airspeed))
        for below, above in list(pairwise(modes))[-1:]:
            points += flutter_crossings(reference, below, above, threshold)
        for lower, higher in list(pairwise(real))[-1:]:
            crossing = divergence_crossing(reference, lower, higher)
            points += filter(None, [crossing])
            if crossing is None and one_crosses(lower, higher):
                missed.append((lower.airspeed, higher.airspeed))
        if progress is not None:
            progress(len(modes))
    points.sort(key=lambda point: point.speed)
    named = tuple(_classified(point, points) for point in points)
    return ReferenceFlutter(speeds, tuple(modes), tuple(real), named, threshold, tuple(missed))


def _classified(point: FlutterPoint, points: list[FlutterPoint]) -> FlutterPoint:
    """Return an onset as a hump when its branch recovers later; what else it is stays open."""
    if point.kind != "flutter" or point.event != "onset":
        return point
    later = [p for p in points if p.branch == point.branch and p.speed > point.speed]
    hump = any(p.event == "recovery" for p in later)
    return replace(point, classification="hump") if hump else point


def reference_study(
    model: AeroelasticWing,
    folds: tuple[float, ...],
    *,
    speeds: Real | None = None,
    highest: float | None = None,
    time_step: float | None = None,
    source: Source = NO_SOURCE,
    progress: Callable[[int], None] | None = None,
) -> "xarray.Dataset":
    """Return the dataset of one case by the reference.

    Parameters
    ----------
    model : AeroelasticWing
        As `reference_model` makes it.
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    speeds : array, shape (u,), optional
        Airspeeds in m/s; by default 13 up to 1.5 times the critical speed of the sweep.
    highest : float, optional
        Highest airspeed in m/s that is looked at by default.
    time_step : float, optional
        Time step in seconds, the same at every airspeed; by default the panels are the same.
    source : Source
        What was asked for, kept with the result.
    progress : callable, optional
        Told the number of airspeeds done.
    """
    modes = model.modes(radians(folds))
    warning = model.warning(modes)
    reference = Reference(model, modes, time_step)
    chosen = _default_speeds(reference, folds, highest) if speeds is None else speeds
    moving = chosen[chosen > 0.0]
    for speed in moving.tolist():
        reference.chordwise(speed)
    threshold = model.wing.analysis.damping_threshold
    found = solve_reference(reference, moving, threshold, progress)
    variables, coords = _case_variables(reference, folds, found, chosen)
    variables |= _verdict(found, modes.names, warning)
    method = METHOD.format(scheme=model.wing.lattice.scheme)
    attrs: dict[str, Any] = provenance(
        model.wing.title, "flutter", source.model_text, method, source.options
    )
    attrs |= search_attributes(model, (float(moving[0]), float(moving[-1])))
    return build_dataset(variables, coords, attrs)


def _case_variables(
    reference: Reference, folds: tuple[float, ...], found: ReferenceFlutter, speeds: Real
) -> tuple[Variables, Variables]:
    """Return modes, loci, points and response as variables, and their coordinates."""
    modes, wing = reference.modes, reference.model.wing
    points, critical = found.points, found.critical
    where = float(found.speeds[-1]) if critical is None else critical.speed
    response, time = tip_response(reference, where, _followed_root(found))
    loci, grid = _loci(found, speeds), surface_grid(wing)
    followed = [FollowedModes(modes, np.ones(modes.count))]
    motions = np.array([point.vector for point in points], complex).reshape(-1, modes.count)
    shapes = unit_motions(modes, motions, grid)[1]
    limit = wing.analysis.damping_threshold
    variables = (
        padded(
            mode_variables(followed) | shape_variables(followed, grid) | response, len(loci.mode)
        )
        | loci_variables(loci, modes.names)
        | table_variables([flutter_row(point, 0, folds, modes.names, limit) for point in points])
        | {"flutter_shape": (("flutter_point", "point", "axis"), shapes)}
    )
    coords = fold_coordinates([folds]) | grid.coordinates()
    coords["speed"] = (("speed",), speeds)
    coords["mode"] = (("mode",), np.arange(1, len(loci.mode) + 1))
    coords["flutter_point"] = (("flutter_point",), np.arange(len(points)))
    coords["time"] = (("time",), time)
    return variables, coords


def _default_speeds(reference: Reference, folds: tuple[float, ...], highest: float | None) -> Real:
    """Return airspeeds up to 1.5 times the critical one, none too low for the time step."""
    model = reference.model
    case = solve_case(model, folds, speed_range(model, highest))
    top = float(picture_speeds(case.analysis)[-1])
    return np.linspace(min(max(top / SPEEDS, reference.slowest), top), top, SPEEDS)


def _followed_root(found: ReferenceFlutter) -> complex:
    """Return the root that the response is to show: at the lowest onset, or the least stable."""
    critical = found.critical
    if critical is not None:
        return 2j * np.pi * critical.frequency
    last = found.modes[-1]
    values = last.eigenvalue[last.found]
    return complex(values[np.argmax(values.real)]) if len(values) else 0j


def _loci(found: ReferenceFlutter, speeds: Real) -> RootLoci:
    """Return modes and growing real roots against all airspeeds, absent at rest."""
    count = len(found.modes[0].status)
    width = max(roots.growing for roots in found.real)
    shape = (len(speeds), count + width)
    values, residual = np.full(shape, np.nan + 0j), np.full(shape, np.nan)
    confidence, status = np.zeros(shape), np.full(shape, int(Status.ABSENT))
    rows = np.flatnonzero(speeds > 0.0)
    for row, modes, real in zip(rows, found.modes, found.real, strict=True):
        values[row, :count], residual[row, :count] = modes.eigenvalue, modes.residual
        confidence[row, :count], status[row, :count] = modes.confidence, modes.status
        growing = slice(count, count + real.growing)
        values[row, growing] = real.eigenvalue[: real.growing]
        residual[row, growing] = real.residual[: real.growing]
        confidence[row, growing], status[row, growing] = 1.0, int(Status.OK)
    return RootLoci(
        speed=speeds,
        eigenvalue=values,
        residual=residual,
        confidence=confidence,
        status=status,
        mode=np.concatenate([np.arange(count), np.full(width, -1)]),
        certified=np.zeros(len(speeds), bool),
    )


def _verdict(found: ReferenceFlutter, names: tuple[str, ...], warning: str) -> Variables:
    """Return what is known of the case as a whole: nothing is certified."""
    outside = np.array([modes.status == Status.UNRESOLVED for modes in found.modes])
    resolved = found.speeds[~outside.any(axis=1)]
    unresolved = [name for name, out in zip(names, outside[0], strict=True) if out]
    gaps = (MISSED.format(*ends) for ends in found.missed)
    message = " ".join(filter(None, [warning, WARNING.format(count=len(found.speeds)), *gaps]))
    fold = ("fold",)
    return {
        "certified": (fold, np.array([False])),
        "case_status": (fold, np.array([int(Status.UNCERTIFIED)])),
        "valid_from": (fold, np.array([resolved[0] if len(resolved) else np.nan])),
        "uncertified_modes": (fold, np.array([", ".join(unresolved)], np.str_)),
        "unstable_from_start": (fold, np.array([found.unstable_from_start])),
        "message": (fold, np.array([message], np.str_)),
    }
