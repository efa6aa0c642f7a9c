"""Eigenvalues against airspeed and all flutter points of one case."""

from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Real
from foldwing.results.flutter_table import table_variables
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.stability.contours import determinant_map
from foldwing.stability.loci import RootLoci, root_loci
from foldwing.stability.status import ELASTIC
from foldwing.stability.tracking import BORN
from foldwing.structure.following import FollowedModes
from foldwing.studies.case import Case, solve_case, verdict_variables
from foldwing.studies.loads import load_variables, unit_motions
from foldwing.studies.modes import (
    body_coordinates,
    fold_coordinates,
    mode_variables,
    shape_variables,
)
from foldwing.studies.shapes import surface_grid
from foldwing.studies.speeds import picture_speeds, speed_range

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]

METHODS = {
    "strip": "beam segments, Theodorsen strip theory, sweep of the reduced frequency",
    "quasi-steady": "beam segments, quasi-steady strip theory, sweep of the reduced frequency",
    "lattice": "beam segments, unsteady vortex lattice, sweep of the reduced frequency",
}
"""One line per aerodynamic model on how the numbers are computed."""

NEUTRAL = ("x", "z")
"""Motions of an aircraft at which nothing pulls: exact zero roots at every airspeed."""

CONTOUR_POINTS = 101
"""Points along each axis of the determinant contours."""


def flutter_study(
    model: AeroelasticWing,
    folds: tuple[float, ...],
    *,
    speeds: Real | None = None,
    highest: float | None = None,
    source: Source = NO_SOURCE,
) -> tuple["xarray.Dataset", Case]:
    """Return the dataset of one case, and the case itself.

    Parameters
    ----------
    model : AeroelasticWing
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    speeds : array, shape (u,), optional
        Airspeeds of the loci in m/s; by default 61 from 0 to 1.5 times the critical speed.
    highest : float, optional
        Highest airspeed of the search for flutter points; by default the last of ``speeds``, else
        three times the divergence speed of the flat wing.
    source : Source
        What was asked for, kept with the result.
    """
    if highest is None and speeds is not None:
        highest = float(speeds[-1])
    case = solve_case(model, folds, speed_range(model, highest))
    chosen = picture_speeds(case.analysis) if speeds is None else speeds
    variables, coords = case_parts(model, case, chosen)
    attrs: dict[str, Any] = provenance(
        model.wing.title,
        "flutter",
        source.model_text,
        METHODS[model.aerodynamics],
        source.options,
    )
    attrs |= search_attributes(model, case.analysis.speed_range)
    return build_dataset(variables, coords, attrs), case


def case_parts(model: AeroelasticWing, case: Case, speeds: Real) -> tuple[Variables, Variables]:
    """Return all variables and coordinates of one case, its loci at ``speeds`` (u,) in m/s."""
    loci = case_loci(case, speeds)
    followed = [FollowedModes(case.modes, np.ones(case.modes.count))]
    grid = surface_grid(model.wing)
    q, shapes = unit_motions(case.modes, case.motions(), grid)
    loads, load_coords = load_variables(model, case, q)
    contours, contour_coords = _contours(case, speeds)
    variables = (
        padded(mode_variables(followed) | shape_variables(followed, grid), len(loci.mode))
        | loci_variables(loci, case.modes.names, case.motion_names)
        | table_variables(case.rows(0))
        | {"flutter_shape": (("flutter_point", "point", "axis"), shapes)}
        | loads
        | verdict_variables([case])
        | {"message": (("fold",), np.array([case.warning], np.str_))}
        | contours
    )
    coords = fold_coordinates([case.folds]) | grid.coordinates() | load_coords | contour_coords
    coords |= body_coordinates(case.modes)
    coords["speed"] = (("speed",), speeds)
    coords["mode"] = (("mode",), np.arange(1, len(loci.mode) + 1))
    coords["flutter_point"] = (("flutter_point",), np.arange(len(case.analysis.points)))
    return variables, coords


def case_loci(case: Case, speeds: Real) -> RootLoci:
    """Return the roots of a case against airspeed: column j holds mode j, others come behind.

    The neutral motions of an aircraft have zero roots.
    """
    further = None if case.flight is None else case.flight.further(case.system)
    loci = root_loci(case.system, speeds, case.analysis.sweep, further)
    loci = loci.by_mode(case.modes.count)
    neutral = [index for index, name in enumerate(case.modes.names) if name in NEUTRAL]
    return loci.with_zero_roots(neutral)


def padded(variables: Variables, width: int) -> Variables:
    """Widen variables on ``mode`` for branches of real roots, which have no natural mode."""
    result = {}
    for name, (dims, values, *further) in variables.items():
        if "mode" in dims:
            axis = dims.index("mode")
            missing = [(0, 0)] * values.ndim
            missing[axis] = (0, width - values.shape[axis])
            empty = "" if values.dtype.kind == "U" else np.nan
            values = np.pad(values, missing, constant_values=empty)
        result[name] = (dims, values, *further)
    return result


def loci_variables(
    loci: RootLoci, modes: tuple[str, ...], motions: tuple[str, ...] = ()
) -> Variables:
    """Return the eigenvalues against airspeed, and what follows from them, as variables.

    Parameters
    ----------
    loci : RootLoci
    modes, motions : tuple of str
        Names of the natural modes, and of the motions of an aircraft as a whole.
    """
    dims = ("fold", "speed", "mode")
    values = loci.eigenvalue
    with np.errstate(divide="ignore", invalid="ignore"):
        damping = np.where(values.imag == 0.0, np.nan, -values.real / np.abs(values.imag))
    names = branch_names(loci, modes, motions)
    frequency = np.where(np.isnan(values.real), np.nan, np.abs(values.imag) / (2.0 * np.pi))
    return {
        "eigenvalue": (dims, values[None]),
        "frequency": (dims, frequency[None]),
        "damping": (dims, damping[None]),
        "growth": (dims, values.real[None]),
        "residual": (dims, loci.residual[None]),
        "status": (dims, loci.status[None]),
        "confidence": (dims, loci.confidence[None]),
        "loci_certified": (("fold", "speed"), loci.certified[None]),
        "branch_name": (("mode",), np.array(names)),
        "branch_motion": (("mode",), np.array(_branch_motions(loci, names, motions), np.str_)),
    }


def branch_names(loci: RootLoci, modes: tuple[str, ...], motions: tuple[str, ...]) -> list[str]:
    """Return mode names, D1 ... for real roots and P1 ... for pairs born of real roots."""
    real = np.nan_to_num(np.abs(loci.eigenvalue.imag)).max(axis=0) == 0.0
    counts = {"D": 0, "P": 0}
    names = []
    for mode, is_real in zip(loci.mode, real, strict=True):
        if mode >= 0:
            names.append(modes[mode])
        elif mode < BORN:
            names.append(motions[BORN - 1 - mode])
        else:
            letter = "D" if is_real else "P"
            counts[letter] += 1
            names.append(f"{letter}{counts[letter]}")
    return names


def _branch_motions(loci: RootLoci, names: list[str], motions: tuple[str, ...]) -> list[str]:
    """Return what each branch is: elastic, real, neutral, or a motion of an aircraft as a whole."""
    result = []
    for name, values in zip(names, loci.eigenvalue.T, strict=True):
        known = values[np.isfinite(values.real)]
        if not known.size:
            result.append("")
        elif name in NEUTRAL or name in motions:
            result.append("neutral" if name in NEUTRAL else name)
        else:
            result.append(ELASTIC if np.any(known.imag != 0.0) else "real")
    return result


def search_attributes(model: AeroelasticWing, speeds: tuple[float, float]) -> Variables:
    """Return the attributes that say what was searched."""
    analysis = model.wing.analysis
    return {
        "speed_floor": speeds[0],
        "speed_limit": speeds[1],
        "damping": analysis.damping,
        "damping_threshold": analysis.damping_threshold,
        **({} if model.wing.aircraft is None else {"trim": model.wing.aircraft.trim}),
    }


def _contours(case: Case, speeds: Real) -> tuple[Variables, Variables]:
    """Return the determinant around the roots at the critical speed, or at the last speed."""
    critical = case.analysis.critical
    speed = float(speeds[-1]) if critical is None else critical.speed
    elastic = case.modes.omega[case.modes.omega > 0.0]
    highest = 1.15 * float(elastic[min(3, len(elastic) - 1)])
    growth = np.linspace(-0.35 * highest, 0.12 * highest, CONTOUR_POINTS)
    omega = np.linspace(highest / CONTOUR_POINTS, highest, CONTOUR_POINTS)
    result = determinant_map(case.system, speed, growth, omega)
    dims = ("contour_growth", "contour_frequency")
    variables = {"determinant": (dims, result.determinant, {"speed": speed})}
    coords = {
        "contour_growth": (dims[:1], growth),
        "contour_frequency": (dims[1:], omega / (2.0 * np.pi)),
    }
    return variables, coords
