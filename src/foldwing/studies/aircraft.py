"""An aircraft in flight: trim, eigenvalues, flutter points, and its wing with the root clamped."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aeroelastic.trim import Trim
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Real
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.studies.case import Case, solve_case
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.flutter import METHODS, branch_names, case_loci, case_parts, search_attributes
from foldwing.studies.speeds import picture_speeds, speed_range

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]


@dataclass(frozen=True)
class AircraftStudy:
    """What is known of an aircraft at one set of fold angles.

    Attributes
    ----------
    dataset : xarray.Dataset
    case : Case
        The aircraft.
    clamped : Case or None
        Its wing with the root clamped, in the same range of airspeeds; None when that failed.
    failure : str
        Why it failed, empty when it did not.
    """

    dataset: "xarray.Dataset"
    case: Case
    clamped: Case | None
    failure: str = ""


def aircraft_study(
    model: AeroelasticWing,
    folds: tuple[float, ...],
    *,
    speeds: Real | None = None,
    highest: float | None = None,
    source: Source = NO_SOURCE,
) -> AircraftStudy:
    """Return the flight of an aircraft at one set of fold angles.

    Parameters
    ----------
    model : AeroelasticWing
        Of a wing that belongs to an aircraft.
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    speeds : array, shape (u,), optional
        Airspeeds of the curves in m/s; by default 61 from 0 to 1.5 times the critical speed of
        aircraft or clamped wing, whichever is higher.
    highest : float, optional
        Highest airspeed of the search for flutter points; by default the last of ``speeds``, else
        three times the divergence speed of the flat wing with its root clamped.
    source : Source
        What was asked for, kept with the result.
    """
    if highest is None and speeds is not None:
        highest = float(speeds[-1])
    searched = speed_range(model, highest)
    case = solve_case(model, folds, searched)
    clamped, failure = _clamped(model, folds, searched)
    chosen = _speeds(case, clamped) if speeds is None else speeds
    variables, coords = case_parts(model, case, chosen)
    for more, numbers in (trim_parts([case], chosen), _clamped_parts(clamped, chosen)):
        variables, coords = variables | more, coords | numbers
    attrs: dict[str, Any] = provenance(
        model.wing.title,
        "aircraft",
        source.model_text,
        f"{METHODS[model.aerodynamics]}, steady lift linearised",
        source.options,
    )
    attrs |= search_attributes(model, case.analysis.speed_range)
    return AircraftStudy(build_dataset(variables, coords, attrs), case, clamped, failure)


def _clamped(
    model: AeroelasticWing, folds: tuple[float, ...], searched: tuple[float, float]
) -> tuple[Case | None, str]:
    """Return the clamped wing, or why it failed."""
    try:
        return solve_case(replace(model, wing=model.wing.clamped), folds, searched), ""
    except NUMERICAL_FAILURES as problem:
        return None, f"{type(problem).__name__}: {problem}"


def _speeds(case: Case, clamped: Case | None) -> Real:
    solved = [one.analysis for one in (case, clamped) if one is not None]
    bounded = [analysis for analysis in solved if analysis.critical is not None]
    return max(map(picture_speeds, bounded or solved), key=lambda speeds: float(speeds[-1]))


def trim_parts(
    cases: Sequence[Case | None], speeds: Real | None = None
) -> tuple[Variables, Variables]:
    """Return variables and coordinates of level flight, nan where a case failed.

    With ``speeds`` (u,) in m/s, those at which it is given, also angles of attack and lift
    coefficients; nan at rest.
    """
    levels = [None if case is None or case.flight is None else case.flight.level for case in cases]
    known = [level for level in levels if level is not None]
    if not known:
        return {}, {}
    count = len(known[0].lift)
    names = [f"segment {number}" for number in range(1, count)] + ["tail"]
    nothing = np.full(count, np.nan)
    lift = np.array([nothing if level is None else level.lift for level in levels])
    share = np.array([nothing if level is None else level.share for level in levels])
    slowest = np.array([np.nan if level is None else level.slowest for level in levels])
    each = ("fold", "surface")
    variables: Variables = {
        "surface_lift": (each, lift),
        "lift_share": (each, share),
        "slowest_speed": (("fold",), slowest, {"lift_coefficient": known[0].largest}),
    }
    if speeds is not None:
        variables |= _trim_against_speed(known[0], speeds)
    return variables, {"surface": (("surface",), np.array(names, np.str_))}


def _trim_against_speed(level: Trim, speeds: Real) -> Variables:
    with np.errstate(divide="ignore"):
        inverse = np.where(speeds > 0.0, 1.0 / speeds**2, np.nan)
    coefficient = level.lift_coefficient(1.0) * inverse[:, None]
    dims = ("fold", "speed")
    return {
        "trim_angle": (dims, np.degrees(level.incidence * inverse)[None]),
        "trim_tail_angle": (dims, np.degrees(level.tail_incidence * inverse)[None]),
        "surface_lift_coefficient": ((*dims, "surface"), coefficient[None]),
    }


def _clamped_parts(clamped: Case | None, speeds: Real) -> tuple[Variables, Variables]:
    """Return eigenvalues and flutter points of the wing with its root clamped."""
    if clamped is None:
        return {}, {}
    loci = case_loci(clamped, speeds)
    names = branch_names(loci, clamped.modes.names, ())
    rows, at = clamped.rows(0), ("clamped_point",)
    columns = {
        "clamped_kind": "kind",
        "clamped_event": "event",
        "clamped_class": "classification",
        "clamped_flutter_speed": "speed",
        "clamped_flutter_frequency": "frequency",
        "clamped_flutter_mode": "mode_name",
    }
    numbers = ("clamped_flutter_speed", "clamped_flutter_frequency")
    variables: Variables = {
        name: (at, np.array([getattr(row, field) for row in rows], _type(name in numbers)))
        for name, field in columns.items()
    }
    variables["clamped_eigenvalue"] = (("speed", "clamped_mode"), loci.eigenvalue)
    variables["clamped_branch_name"] = (("clamped_mode",), np.array(names, np.str_))
    coords: Variables = {
        "clamped_mode": (("clamped_mode",), np.arange(1, len(names) + 1)),
        "clamped_point": (at, np.arange(len(rows))),
    }
    return variables, coords


def _type(is_number: bool) -> type:
    return float if is_number else np.str_
