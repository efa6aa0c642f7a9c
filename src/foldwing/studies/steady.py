"""Steady lift, drag and moments over a grid of fold angles, with and without gaps."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aerodynamics.doubts import check_plain, gap_warning, strips_warning
from foldwing.aerodynamics.lattice import Strips, mesh_segments
from foldwing.aerodynamics.steady_loads import WingLoads, least_drag_known, wing_loads, wing_strips
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model import HingeKind, Wing
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.results.steady_table import PER_SEGMENT, WHOLE
from foldwing.stability.status import Status
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.grid import radians, swept_hinge
from foldwing.studies.modes import fold_coordinates
from foldwing.studies.speeds import LEAST_SPEED, MOST_SPEED

if TYPE_CHECKING:
    import xarray

METHOD = "steady vortex lattice"

MOST_DEGREES = 20.0
"""Angle of attack beyond which every wing has stalled and a linear theory says nothing."""

OPEN, CLOSED = "open", "closed"

NO_LEAST_DRAG = (
    "The least induced drag of this shape is not known: segments are too close for these strips."
)

NO_LEAST_DRAG_COSINE = (
    "The least induced drag is not known with cosine spacing: take inset or uniform strips for the "
    "efficiency."
)

Variables = dict[str, Any]


@dataclass(frozen=True)
class SteadyOutcome:
    """A case of a sweep.

    Attributes
    ----------
    folds : tuple of float
        In degrees.
    loads : tuple of WingLoads
        With each state of the gaps, empty when the case failed.
    message : str
        Why the case failed, or what makes it doubtful.
    """

    folds: tuple[float, ...]
    loads: tuple[WingLoads, ...]
    message: str = ""

    @property
    def status(self) -> Status:
        """How the case ended."""
        return Status.OK if self.loads else Status.FAILED


@dataclass(frozen=True)
class SteadyStudy:
    """A sweep.

    Attributes
    ----------
    dataset : xarray.Dataset
    gaps : tuple of str
        ``closed``; or ``open`` and ``closed`` for a wing with gaps.
    outcomes : tuple of SteadyOutcome
    """

    dataset: "xarray.Dataset"
    gaps: tuple[str, ...]
    outcomes: tuple[SteadyOutcome, ...]


def check_stream(alpha: float, speed: float) -> None:
    """Raise `InputError` unless the angle (degrees) and the airspeed (m/s) suit a linear theory."""
    if not abs(alpha) <= MOST_DEGREES:
        limit = f"must be -{MOST_DEGREES:g} to {MOST_DEGREES:g} degrees"
        remedy = "The theory is linear: its wing never stalls, a real one has by then."
        raise InputError("--alpha", alpha, limit, remedy)
    if not LEAST_SPEED <= speed <= MOST_SPEED:
        limit = f"must be {LEAST_SPEED:g} to {MOST_SPEED:g} m/s"
        raise InputError("--speed", speed, limit, "Give the airspeed in m/s, such as 20.")


def steady_study(
    wing: Wing,
    cases: Sequence[tuple[float, ...]],
    *,
    alpha: float = 5.0,
    speed: float = 20.0,
    source: Source = NO_SOURCE,
) -> SteadyStudy:
    """Return the steady loads of every case; of a wing with gaps also without them.

    A case of several that fails is named and the others stand.

    Parameters
    ----------
    wing : Wing
    cases : sequence of tuple of float
        psi_2 .. psi_N in degrees of each case.
    alpha : float
        Angle of attack of segment 1 in degrees, nose up.
    speed : float
        Airspeed in m/s.
    source : Source
        What was asked for, kept with the result.

    Raises
    ------
    InputError
        When the angle or the airspeed is out of range, or segments lie on each other in the only
        case.
    """
    check_stream(alpha, speed)
    check_plain(wing)
    wings = _by_gap(wing)
    run = _solved if len(cases) == 1 else _attempt
    outcomes = tuple(run(wings, case, alpha, speed) for case in cases)
    attrs: Variables = provenance(wing.title, "steady", source.model_text, METHOD, source.options)
    attrs |= {
        "alpha": float(alpha),
        "airspeed": float(speed),
        "air_density": wing.air.density,
        "reference_area": sum(segment.area for segment in wing.segments),
        "image": int(wing.lattice.image),
    }
    hinge = swept_hinge(cases)
    attrs |= {} if hinge is None else {"swept": f"fold_{hinge}"}
    variables = _load_variables(wing, outcomes, len(wings)) | _strip_variables(
        wings, outcomes, speed
    )
    coords = fold_coordinates(cases) | _coordinates(wings) | _strip_coordinates(wings)
    return SteadyStudy(build_dataset(variables, coords, attrs), tuple(wings), outcomes)


def _by_gap(wing: Wing) -> dict[str, Wing]:
    """Return the wing as it is, and closed when it has gaps."""
    if not any(hinge.gap > 0.0 for hinge in wing.hinges):
        return {CLOSED: wing}
    return {OPEN: wing, CLOSED: wing.with_gaps(0.0)}


def _solved(
    wings: dict[str, Wing], folds: tuple[float, ...], alpha: float, speed: float
) -> SteadyOutcome:
    angles = radians(folds)
    remarks = _warnings(wings, angles)
    loads = tuple(wing_loads(wing, angles, math.radians(alpha), speed) for wing in wings.values())
    if not all(least_drag_known(wing) for wing in wings.values()):
        remarks.append(NO_LEAST_DRAG_COSINE)
    elif not all(math.isfinite(each.efficiency) for each in loads):
        remarks.append(NO_LEAST_DRAG)
    remarks += [
        f"Hinge {number} is free: the wing is held in its shape."
        for number, hinge in enumerate(next(iter(wings.values())).hinges, start=2)
        if hinge.kind is HingeKind.FREE
    ]
    return SteadyOutcome(folds, loads, " ".join(remarks))


def _warnings(wings: dict[str, Wing], angles: Sequence[float]) -> list[str]:
    """Return what is doubtful about the strips; closed gaps may bring segments closer together."""
    found = {
        gaps: strips_warning(wing_strips(wing, angles), angles, wing.lattice.image)
        for gaps, wing in wings.items()
    }
    named = len(wings) > 1
    texts = [f"Gaps {gaps}: {text}" if named else text for gaps, text in found.items() if text]
    return [text for text in (*texts, gap_warning(next(iter(wings.values())))) if text]


def _attempt(
    wings: dict[str, Wing], folds: tuple[float, ...], alpha: float, speed: float
) -> SteadyOutcome:
    try:
        return _solved(wings, folds, alpha, speed)
    except NUMERICAL_FAILURES as problem:
        return SteadyOutcome(folds, (), str(problem))


def _load_variables(wing: Wing, outcomes: Sequence[SteadyOutcome], gaps: int) -> Variables:
    """Return forces and moments, nan where a case failed."""
    shape = (len(outcomes), gaps)
    variables: Variables = {name: (("fold", "gap"), np.full(shape, np.nan)) for name in WHOLE}
    projected = np.full(len(outcomes), np.nan)
    hinges = np.full((*shape, len(wing.hinges)), np.nan)
    segments = {name: np.full((*shape, wing.count), np.nan) for name in PER_SEGMENT}
    for case, outcome in enumerate(outcomes):
        for gap, loads in enumerate(outcome.loads):
            projected[case] = loads.projected_area
            hinges[case, gap] = loads.hinge_moments
            for name in WHOLE:
                variables[name][1][case, gap] = getattr(loads, name)
            for name, values in segments.items():
                values[case, gap] = [getattr(segment, name) for segment in loads.segments]
    dims = ("fold", "gap", "wing_segment")
    variables |= {f"segment_{name}": (dims, values) for name, values in segments.items()}
    return variables | {
        "projected_area": (("fold",), projected),
        "hinge_moment": (("fold", "gap", "hinge"), hinges),
        "case_status": (("fold",), np.array([int(outcome.status) for outcome in outcomes])),
        "message": (("fold",), np.array([outcome.message for outcome in outcomes], np.str_)),
    }


def _strip_variables(
    wings: dict[str, Wing], outcomes: Sequence[SteadyOutcome], speed: float
) -> Variables:
    """Return circulation and place of the strips of all lattices, one after the other."""
    by_case = [_circulation(wings, outcome) for outcome in outcomes]
    circulation = speed * np.array([panels for panels, _ in by_case])
    edges = [
        [_leading_edges(wing_strips(wing, radians(outcome.folds))) for wing in wings.values()]
        for outcome in outcomes
    ]
    strips = ("fold", "strip")
    return {
        "strip_circulation": (strips, circulation.sum(axis=2)),
        "local_lift_coefficient": (strips, np.array([local for _, local in by_case])),
        "panel_circulation": ((*strips, "row"), circulation),
        "strip_edge": ((*strips, "edge", "axis"), np.array([np.concatenate(e) for e in edges])),
    }


def _circulation(wings: dict[str, Wing], outcome: SteadyOutcome) -> tuple[Real, Real]:
    """Return circulation per airspeed (strips, rows) and lift coefficients (strips,) of a case."""
    rows = next(iter(wings.values())).lattice.chordwise
    if not outcome.loads:
        count = sum(len(mesh.middle) for wing in wings.values() for mesh in mesh_segments(wing))
        return np.full((count, rows), np.nan), np.full(count, np.nan)
    lattices = [loads.lattice for loads in outcome.loads]
    return (
        np.concatenate([lattice.circulation.reshape(rows, -1).T for lattice in lattices]),
        np.concatenate([lattice.local_lift_coefficient for lattice in lattices]),
    )


def _leading_edges(strips: Strips) -> Real:
    """Return x, y and z of the leading edge at both edges of each strip, shape (s, 2, 3)."""
    ends = np.stack([strips.inner, strips.outer], axis=1)
    x = np.broadcast_to(strips.leading[:, None, None], (strips.count, 2, 1))
    return np.concatenate([x, ends], axis=2)


def _strip_coordinates(wings: dict[str, Wing]) -> Variables:
    """Return where the strips of all lattices lie on the unfolded wing."""
    parts = []
    for gap, wing in wings.items():
        start = np.cumsum([0.0, *(segment.span for segment in wing.segments)])
        for index, mesh in enumerate(mesh_segments(wing)):
            edges, count = start[index] + mesh.edges, len(mesh.middle)
            whole = (gap, index + 1, edges[:-1], edges[1:], mesh.chord)
            parts.append([np.broadcast_to(value, count) for value in whole])
    names = ("gap", "segment", "inner", "outer", "chord")
    columns = (np.concatenate(column) for column in zip(*parts, strict=True))
    found = {
        f"strip_{name}": (("strip",), column) for name, column in zip(names, columns, strict=True)
    }
    return found | {"strip": (("strip",), np.arange(len(found["strip_gap"][1])))}


def _coordinates(wings: dict[str, Wing]) -> Variables:
    wing = next(iter(wings.values()))
    return {
        "gap": (("gap",), list(wings)),
        "wing_segment": (("wing_segment",), np.arange(1, wing.count + 1)),
        "hinge": (("hinge",), np.arange(2, wing.count + 1)),
        "row": (("row",), np.arange(1, wing.lattice.chordwise + 1)),
        "edge": (("edge",), ["inner", "outer"]),
        "axis": (("axis",), ["x", "y", "z"]),
    }
