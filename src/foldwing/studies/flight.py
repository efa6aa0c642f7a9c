"""Longitudinal flight of a rigid aircraft: its modes, derivatives, flight paths; against speed."""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.errors import InputError
from foldwing.flight import (
    ModeRow,
    Motion,
    flight_path,
    neutral_point,
    stability_derivatives,
    state_matrix,
    static_margin,
    trimmed,
)
from foldwing.flight.derivatives import STATES
from foldwing.flight.modes import PHUGOID
from foldwing.flight.paths import AMPLITUDE, SAMPLES
from foldwing.flight.rows import model_rows
from foldwing.maths.arrays import Real
from foldwing.model import Airframe, FlightModel, StateMatrixModel
from foldwing.results.flight_summary import PER_ROOT
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.studies.speeds import LEAST_SPEED, MOST_SPEED

if TYPE_CHECKING:
    import xarray

METHODS = {
    "Airframe": "rigid aircraft of wing and tail, quasi-steady",
    "DerivativesModel": "rigid aircraft, given derivatives",
    "StateMatrixModel": "rigid aircraft, given matrix",
}
"""One line on how the numbers were computed, by form of the model."""

ROOTS = 4

Variables = dict[str, Any]
Answer = dict[str, Any]


@dataclass(frozen=True)
class FlightStudy:
    """The modes of an aircraft at its own airspeed and over a range.

    Attributes
    ----------
    dataset : xarray.Dataset
    model : Airframe, DerivativesModel or StateMatrixModel
    rows : tuple of ModeRow
        At the airspeed of the model, the four states first.
    swept : tuple of ModeRow
        At the other airspeeds asked for.
    """

    dataset: "xarray.Dataset"
    model: FlightModel
    rows: tuple[ModeRow, ...]
    swept: tuple[ModeRow, ...]


def flight_study(
    model: FlightModel,
    *,
    speeds: Sequence[float] | Real | None = None,
    comparisons: Sequence[ModeRow] = (),
    source: Source = NO_SOURCE,
) -> FlightStudy:
    """Return phugoid and short period of an aircraft in level flight.

    Parameters
    ----------
    model : Airframe, DerivativesModel or StateMatrixModel
    speeds : sequence of float, optional
        Airspeeds in m/s at which the modes are found too, in trim at each; for an `Airframe`.
    comparisons : sequence of ModeRow
        Modes by other models, shown beside those of this one; each at the airspeed of the model or
        at one of ``speeds``.
    source : Source
        What was asked for, kept with the result.

    Raises
    ------
    InputError
        When an airspeed cannot be flown, or a comparison is at another airspeed.
    """
    wanted = () if speeds is None else tuple(float(speed) for speed in speeds)
    check_speeds(model, wanted)
    _check_comparisons(model, wanted, comparisons)
    own = [row for row in comparisons if row.speed == model.speed]
    rows = (*model_rows(model), *own)
    swept: list[ModeRow] = []
    for speed in wanted:
        assert isinstance(model, Airframe)
        swept += model_rows(model.flown_at(speed))
    swept += [row for row in comparisons if row.speed in wanted]
    names = list(dict.fromkeys(row.model_name for row in (*rows, *swept)))
    variables = _row_variables(rows, names) | _model_variables(model) | _paths(model, rows[0])
    variables |= _swept_variables(model, swept, names, wanted) if wanted else {}
    dataset = build_dataset(variables, _coordinates(names, rows[0], wanted), _attrs(model, source))
    return FlightStudy(dataset, model, rows, tuple(swept))


def check_speeds(model: FlightModel, speeds: Sequence[float] | Real) -> None:
    """Raise `InputError` unless the model can be flown at all airspeeds (m/s)."""
    if len(speeds) and not isinstance(model, Airframe):
        limit = "belong to a model by wing and tail: other forms hold at one airspeed"
        remedy = "Leave the airspeeds out, or describe [flight.wing] and [flight.tail]."
        raise InputError("--speeds", _shown(speeds), limit, remedy)
    for speed in speeds:
        check_flight_speed(float(speed), "--speeds", "start for example at 25:60:5")


def check_flight_speed(speed: float, field: str = "--speed", remedy: str = "give 54") -> None:
    """Raise `InputError` unless an airspeed in m/s is one of level flight."""
    if not LEAST_SPEED <= speed <= MOST_SPEED:
        limit = f"must be {LEAST_SPEED:g} to {MOST_SPEED:g} m/s"
        raise InputError(field, speed, limit, f"An aircraft in level flight moves: {remedy}.")


def _check_comparisons(
    model: FlightModel, speeds: Sequence[float], comparisons: Sequence[ModeRow]
) -> None:
    for row in comparisons:
        if row.speed != model.speed and row.speed not in speeds:
            limit = "must be at the airspeed of the model or at one of the swept airspeeds"
            remedy = f"Compute {row.model_name} at one of these."
            raise InputError("comparisons", row.speed, limit, remedy)


def _shown(speeds: Sequence[float] | Real) -> str:
    return ", ".join(f"{speed:g}" for speed in speeds[:3]) + (", ..." if len(speeds) > 3 else "")


def _row_variables(rows: Sequence[ModeRow], names: list[str]) -> Variables:
    """Return the modes at the airspeed of the model."""
    dims, shape = ("flight_model", "flight_root"), (len(names), ROOTS)
    eigenvalue, modes = np.full(shape, np.nan, complex), np.full(shape, "", object)
    numbers = {name: np.full(shape, np.nan) for name in PER_ROOT}
    for row in rows:
        at = names.index(row.model_name)
        for place, (mode, value) in enumerate(row.roots):
            eigenvalue[at, place], modes[at, place] = value, mode
            for name, values in numbers.items():
                values[at, place] = getattr(Motion(mode, value), name)
    return {
        "flight_eigenvalue": (dims, eigenvalue),
        "flight_mode": (dims, modes.astype(np.str_)),
        **{f"flight_{name}": (dims, values) for name, values in numbers.items()},
    }


def _swept_variables(
    model: FlightModel, rows: Sequence[ModeRow], names: list[str], speeds: Sequence[float]
) -> Variables:
    """Return the modes at every airspeed asked for."""
    shape = (len(names), len(speeds))
    eigenvalue = np.full((*shape, ROOTS), np.nan, complex)
    modes, product = np.full((*shape, ROOTS), "", object), np.full(shape, np.nan)
    for row in rows:
        at = (names.index(row.model_name), speeds.index(row.speed))
        for place, (mode, value) in enumerate(row.roots):
            eigenvalue[(*at, place)], modes[(*at, place)] = value, mode
            if mode == PHUGOID and value.imag > 0.0:
                product[at] = value.imag * row.speed
    assert isinstance(model, Airframe)
    lift = [trimmed(model.flown_at(speed)).lift for speed in speeds]
    dims = ("flight_model", "speed")
    return {
        "swept_eigenvalue": ((*dims, "flight_root"), eigenvalue),
        "swept_mode": ((*dims, "flight_root"), modes.astype(np.str_)),
        "phugoid_product": (dims, product),
        "swept_lift_coefficient": (("speed",), np.array(lift)),
    }


def _model_variables(model: FlightModel) -> Variables:
    """Return matrix and derivatives, and for wing and tail the trim."""
    variables: Variables = {"state_matrix": (("equation", "state"), state_matrix(model))}
    if not isinstance(model, StateMatrixModel):
        derivatives = asdict(stability_derivatives(model))
        variables |= {name: ((), value) for name, value in derivatives.items()}
    if isinstance(model, Airframe):
        variables |= {f"{name}_coefficient": ((), value) for name, value in _trim(model).items()}
        variables["static_margin"] = ((), static_margin(model))
        variables["neutral_point"] = ((), neutral_point(model))
    return variables


def _trim(model: Airframe) -> dict[str, float]:
    trim = trimmed(model)
    whole = {"trim_lift": trim.lift, "trim_drag": trim.drag}
    return whole | {"wing_lift": trim.wing_lift, "tail_lift": trim.tail_lift}


def _paths(model: FlightModel, row: ModeRow) -> Variables:
    """Return the motions of the four states, and their flight paths where the airspeed is known."""
    dims = ("flight_motion", "path_sample")
    variables: Variables = {
        "motion_mode": (dims[:1], [motion.mode for motion in row.motions]),
        "motion_eigenvalue": (dims[:1], [motion.eigenvalue for motion in row.motions]),
        "motion_shape": ((dims[0], "state"), [motion.shape for motion in row.motions]),
    }
    if model.speed is None:
        return variables
    paths = [flight_path(motion, model.speed) for motion in row.motions]
    columns = {
        "path_time": [path.time for path in paths],
        "path_distance": [path.distance for path in paths],
        "path_ahead": [path.ahead for path in paths],
        "path_altitude": [path.altitude for path in paths],
        "path_pitch": [np.degrees(path.pitch) for path in paths],
    }
    return variables | {name: (dims, np.array(values)) for name, values in columns.items()}


def _coordinates(names: list[str], row: ModeRow, speeds: Sequence[float]) -> Variables:
    coords: Variables = {
        "flight_model": (("flight_model",), names),
        "flight_root": (("flight_root",), np.arange(1, ROOTS + 1)),
        "state": (("state",), list(STATES)),
        "equation": (("equation",), list(STATES)),
        "flight_motion": (("flight_motion",), np.arange(1, len(row.motions) + 1)),
    }
    if not math.isnan(row.speed):
        coords["path_sample"] = (("path_sample",), np.arange(SAMPLES))
    return coords | ({"speed": (("speed",), np.array(speeds))} if speeds else {})


def _attrs(model: FlightModel, source: Source) -> Variables:
    method = METHODS[type(model).__name__]
    attrs: Variables = provenance(model.title, "flight", source.model_text, method, source.options)
    attrs |= {"gravity": model.gravity, "amplitude": AMPLITUDE}
    return attrs | ({} if model.speed is None else {"airspeed": model.speed})


def flight_answer(study: FlightStudy) -> Answer:
    """Return modes, derivatives and trim as plain numbers; what does not exist is None."""
    model, dataset = study.model, study.dataset
    answer: Answer = {
        "speed": model.speed,
        "gravity": model.gravity,
        "models": [_row(row) for row in study.rows],
        "state_matrix": dataset["state_matrix"].values.tolist(),
    }
    if not isinstance(model, StateMatrixModel):
        answer["derivatives"] = asdict(stability_derivatives(model))
    if isinstance(model, Airframe):
        answer["static_margin"] = static_margin(model)
        answer["neutral_point"] = neutral_point(model)
        answer["trim"] = _trim(model)
    if study.swept:
        answer["speeds"] = [{"speed": row.speed} | _row(row) for row in study.swept]
    return answer


def _row(row: ModeRow) -> Answer:
    return {"model": row.model_name, "modes": [_motion(motion) for motion in row.motions]}


def _motion(motion: Motion) -> Answer:
    value = motion.eigenvalue
    numbers = {name: getattr(motion, name) for name in PER_ROOT}
    return {"mode": motion.mode, "real": value.real + 0.0, "imag": value.imag + 0.0} | {
        name: number if math.isfinite(number) else None for name, number in numbers.items()
    }
