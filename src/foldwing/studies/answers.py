"""Results as plain numbers and lists, for JSON: no nan, None instead."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aerodynamics.steady_loads import WingLoads
from foldwing.maths.arrays import Complex, Real
from foldwing.results.aircraft_table import motions_found
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.schema import fold_angle_names
from foldwing.results.steady_table import PER_SEGMENT, WHOLE
from foldwing.results.summary import critical_row
from foldwing.results.units import RATIOS, units_of
from foldwing.stability.status import ELASTIC, Status
from foldwing.structure.modes import StructuralModes
from foldwing.studies.aircraft import AircraftStudy
from foldwing.studies.boundary import Boundary, Outcome
from foldwing.studies.case import Case
from foldwing.studies.convergence import ConvergenceStudy
from foldwing.studies.lowest import Change
from foldwing.studies.section import SectionOutcome, SectionStudy
from foldwing.studies.steady import SteadyStudy

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
    already = case.analysis.unstable_from_start
    return {
        "fold": list(case.folds),
        "flutter_points": [_point(row) for row in rows],
        "critical": None if index is None else _point(rows[index]),
        "certified": case.analysis.certified,
        "valid_from": case.analysis.valid_from,
        "unstable_from_start": None if already < 0 else already,
        "uncertified_modes": list(case.uncertified_modes),
        "status": case.status.meaning,
        **({"warning": case.remarks} if case.remarks else {}),
    }


def aircraft_answer(study: AircraftStudy) -> Answer:
    """Return flutter points of an aircraft, its trim and motions, and its wing clamped.

    Lift in N of the half aircraft, angles in degrees, eigenvalues in 1/s and Hz.
    """
    dataset, level = study.dataset, study.case.flight.level if study.case.flight else None
    assert level is not None
    answer = flutter_answer(study.case)
    answer["unstable_motions"] = list(study.case.unstable_motions)
    answer["trim"] = {
        "weight": level.weight,
        "slowest_speed": level.slowest,
        "largest_lift_coefficient": level.largest,
        "surfaces": [
            {"name": name, "lift": _number(lift), "share": _number(share)}
            for name, lift, share in zip(
                dataset["surface"].values.tolist(), level.lift, level.share, strict=True
            )
        ],
    }
    angles = dataset["trim_angle"].values[0]
    answer["speeds"] = dataset["speed"].values.tolist()
    answer["angle_of_attack"] = [_number(angle) for angle in angles]
    answer["motions"] = [
        _motion(dataset, name, column) for name, column in motions_found(dataset).items()
    ]
    answer["clamped"] = None if study.clamped is None else flutter_answer(study.clamped)
    return answer


def _motion(dataset: "xarray.Dataset", name: str, column: int) -> Answer:
    values = dataset["eigenvalue"].values[0, :, column]
    return {
        "name": name,
        "growth": [_number(value) for value in values.real],
        "frequency_hz": [_number(value / (2.0 * math.pi)) for value in _imaginary(values)],
    }


def _imaginary(values: Complex) -> Real:
    return np.where(np.isnan(values.real), np.nan, values.imag)


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


def convergence_answer(study: ConvergenceStudy) -> Answer:
    """Return the flutter points of one case with their error bars, by setting, in m/s and Hz."""
    dataset = study.dataset
    answer = flutter_answer(study.case)
    mesh = [dataset[f"mesh_{name}_speed"].values for name in ("limit", "error")]
    points = [
        {
            **point,
            "limit_speed": _number(mesh[0][index]),
            "error_speed": _number(mesh[1][index]),
            "settings": {
                name: _convergence(dataset, row, index)
                for row, name in enumerate(dataset["setting"].values.tolist())
            },
        }
        for index, point in enumerate(answer["flutter_points"])
    ]
    answer |= {"flutter_points": points, "failures": list(study.failures)}
    if study.interrupted:
        answer["interrupted"] = dataset.attrs["interrupted"]
    return answer


def _convergence(dataset: "xarray.Dataset", row: int, point: int) -> Answer:
    here = dataset["level_setting"].values == dataset["setting"].values[row]
    columns = {name: dataset[f"level_{name}"].values[here] for name in ("value", "own")}
    columns |= {
        name: dataset[f"level_{name}"].values[here, point] for name in ("speed", "frequency")
    }
    return {
        "convergence": str(dataset["convergence"].values[row, point]),
        "order": _number(dataset["order"].values[row, point]),
        "limit_speed": _number(dataset["limit_speed"].values[row, point]),
        "error_speed": _number(dataset["error_speed"].values[row, point]),
        "levels": [
            {"value": float(value), "own": bool(own), "speed": _number(u), "frequency": _number(f)}
            for value, own, u, f in zip(*columns.values(), strict=True)
        ],
    }


def steady_answer(study: SteadyStudy) -> Answer:
    """Return the steady loads of every case, in N, N m and per radian; a failed one says why."""
    attrs = study.dataset.attrs
    return {
        "alpha": attrs["alpha"],
        "speed": attrs["airspeed"],
        "reference_area": attrs["reference_area"],
        "cases": [
            {
                "fold": list(outcome.folds),
                "status": outcome.status.meaning,
                "loads": [
                    {"gaps": gaps, **_loads(loads)}
                    for gaps, loads in zip(study.gaps, outcome.loads, strict=False)
                ],
                **({"message": outcome.message} if outcome.message else {}),
            }
            for outcome in study.outcomes
        ],
    }


def _loads(loads: WingLoads) -> Answer:
    return {
        **{name: _number(getattr(loads, name)) for name in (*WHOLE, "projected_area")},
        "hinge_moments": [_number(moment) for moment in loads.hinge_moments],
        "segments": [
            {name: _number(getattr(segment, name)) for name in PER_SEGMENT}
            for segment in loads.segments
        ],
    }


def section_answer(study: SectionStudy) -> Answer:
    """Return the flutter points of a section; of a sweep every case, and where the lowest changes.

    Airspeeds and frequencies as ratios, and in m/s and Hz when the section has scales.
    """
    dataset = study.dataset
    rows = [_with_ratios(dataset, point, row) for point, row in enumerate(flutter_rows(dataset))]
    owners = dataset["case"].values.tolist()
    cases = [
        _section_case(
            study, index, [row for row, own in zip(rows, owners, strict=True) if own == index]
        )
        for index in range(len(study.outcomes))
    ]
    if "swept" not in dataset.attrs:
        return cases[0]
    crossings = [float(ratio) for ratio in dataset["crossing_torsion_ratio"].values]
    changes = [_change(study, change) for change in study.changes]
    return {"cases": cases, "changes": changes, "crossing_torsion_ratios": crossings}


def _section_case(study: SectionStudy, index: int, points: list[Answer]) -> Answer:
    outcome: SectionOutcome = study.outcomes[index]
    answer: Answer = {"torsion_frequency_ratio": float(outcome.ratio)}
    if outcome.case is None:
        return answer | {
            "natural_frequency_ratios": [],
            "mode_names": [],
            "flutter_points": [],
            "critical": None,
            "certified": False,
            "unstable_from_start": None,
            "status": outcome.status.meaning,
            "message": outcome.message,
        }
    analysis, critical = outcome.case.analysis, outcome.case.analysis.critical
    already = analysis.unstable_from_start
    return answer | {
        "natural_frequency_ratios": [
            _number(ratio) for ratio in outcome.case.system.frequency_ratios
        ],
        "mode_names": list(outcome.case.system.mode_names),
        "flutter_points": points,
        "critical": None if critical is None else points[analysis.points.index(critical)],
        "certified": analysis.certified,
        "unstable_from_start": None if already < 0 else already,
        "status": outcome.status.meaning,
    }


def _with_ratios(dataset: "xarray.Dataset", point: int, row: FlutterRow) -> Answer:
    """Return a flutter point of a section; m/s, Hz and s/m are null without scales."""
    answer = _point(row)
    if units_of(dataset) is RATIOS:
        answer |= {"speed": None, "frequency": None, "strength": None}
    names = ("speed_ratio", "frequency_ratio")
    return answer | {name: _number(float(dataset[name][point])) for name in names}


def _change(study: SectionStudy, change: Change) -> Answer:
    """Return a change of the lowest onset, its two sides in ratios, and in m/s and Hz."""
    case = next(outcome.case for outcome in study.outcomes if outcome.case is not None)
    section = case.section
    per_speed, per_frequency = section.speed_unit, 1.0
    answer: Answer = {
        "torsion_frequency_ratio": change.parameter,
        "kind": change.kind,
        "confirmed": change.confirmed,
    }
    if section.plunge_frequency is not None:
        per_frequency = section.plunge_frequency
        answer["speed"] = [_number(value) for value in change.speed]
        answer["frequency"] = [_number(value) for value in change.frequency]
    else:
        answer |= {"speed": None, "frequency": None}
    answer["speed_ratio"] = [_number(value / per_speed) for value in change.speed]
    answer["frequency_ratio"] = [_number(value / per_frequency) for value in change.frequency]
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
        **({} if row.motion == ELASTIC else {"motion": row.motion}),
    }


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _rounded(angle: float) -> float:
    return round(angle, 9) + 0.0
