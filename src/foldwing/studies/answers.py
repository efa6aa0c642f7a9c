"""Results as plain numbers and lists, for JSON: no nan, None instead."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.schema import fold_angle_names
from foldwing.results.summary import critical_row
from foldwing.stability.status import Status
from foldwing.structure.modes import StructuralModes
from foldwing.studies.boundary import Boundary, Outcome
from foldwing.studies.case import Case

if TYPE_CHECKING:
    import xarray

Answer = dict[str, Any]


def modes_answer(modes: StructuralModes, names: Sequence[str]) -> Answer:
    """Return natural frequencies in Hz and mode names of one case."""
    return {
        "fold": [_rounded(math.degrees(angle)) for angle in modes.fold_angles],
        "natural_frequencies_hz": [_number(value) for value in modes.frequencies],
        "mode_names": list(names),
    }


def flutter_answer(case: Case) -> Answer:
    """Return the flutter points of one case, in m/s, Hz and s/m."""
    rows = case.rows(0)
    critical = case.analysis.critical
    index = case.analysis.points.index(critical) if critical is not None else None
    return {
        "fold": list(case.folds),
        "flutter_points": [_point(row) for row in rows],
        "critical": None if index is None else _point(rows[index]),
        "certified": case.analysis.certified,
        "valid_from": case.analysis.valid_from,
        "unstable_from_start": max(case.analysis.unstable_from_start, 0),
        "uncertified_modes": list(case.uncertified_modes),
        "status": case.status.meaning,
        **({"warning": case.warning} if case.warning else {}),
    }


def reference_answer(dataset: "xarray.Dataset") -> Answer:
    """Return the flutter points of the reference, and what its response in time tells."""
    rows = flutter_rows(dataset)
    critical = critical_row(rows)
    response = dataset["response"].attrs
    keys = ("speed", "frequency", "damping_ratio", "growth", "misfit")
    return {
        "fold": [float(dataset[name][0]) for name in fold_angle_names(dataset)],
        "flutter_points": [_point(row) for row in rows],
        "critical": None if critical is None else _point(critical),
        "certified": False,
        "valid_from": _number(float(dataset["valid_from"][0])),
        "unstable_from_start": int(dataset["unstable_from_start"][0]),
        "uncertified_modes": [
            name for name in str(dataset["uncertified_modes"][0].item()).split(", ") if name
        ],
        "status": Status.UNCERTIFIED.meaning,
        "warning": str(dataset["message"][0].item()),
        "response": {key: _number(response[key]) for key in keys},
    }


def boundary_answer(boundary: Boundary) -> Answer:
    """Return one answer per case; a failed case has no points and says why.

    Curves add the fold angles at which they turn back.
    """
    attrs = boundary.dataset.attrs
    answer: Answer = {"cases": [_case(outcome) for outcome in boundary.outcomes]}
    if "interrupted" in attrs:
        answer["interrupted"] = attrs["interrupted"]
    if "turning" in attrs:
        answer["turning_folds"] = [float(angle) for angle in attrs["turning"].split(", ") if angle]
    return answer


def _case(outcome: Outcome) -> Answer:
    if outcome.case is not None:
        return flutter_answer(outcome.case)
    return {
        "fold": list(outcome.folds),
        "flutter_points": [],
        "critical": None,
        "certified": False,
        "valid_from": None,
        "unstable_from_start": None,
        "uncertified_modes": [],
        "status": Status.FAILED.meaning,
        "message": outcome.message,
    }


def _point(row: FlutterRow) -> Answer:
    return {
        "kind": row.kind,
        "event": row.event,
        "class": row.classification,
        "speed": row.speed,
        "frequency": row.frequency,
        "strength": _number(row.strength),
        "mode": row.mode_name,
        "mode_confidence": row.mode_confidence,
    }


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _rounded(angle: float) -> float:
    return round(angle, 9) + 0.0
