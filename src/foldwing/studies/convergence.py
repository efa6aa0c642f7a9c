"""How far the flutter points of one case depend on the settings of the computation."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Complex, Real
from foldwing.maths.extrapolation import Convergence, assess
from foldwing.results.flutter_table import FlutterRow, table_variables
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.stability.status import Status
from foldwing.studies.case import Case, solve_case, verdict_variables
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.flutter import METHODS, search_attributes
from foldwing.studies.matching import likeness, match_points
from foldwing.studies.modes import fold_coordinates
from foldwing.studies.settings import MESH, SETTINGS
from foldwing.studies.shapes import SurfaceGrid, surface_grid
from foldwing.studies.speeds import speed_range
from foldwing.studies.variants import Variant

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]

MISSING = "missing"
"""Verdict on a point that is not found with the model's own settings made finer."""

WIDER = 1.25
"""Factor by which variants are searched beyond the airspeeds of the model's own settings."""


@dataclass(frozen=True)
class Solved:
    """What is kept of a solved variant.

    Attributes
    ----------
    status : Status
    message : str
        Why it failed or is doubtful.
    rows : tuple of FlutterRow
    motions : array of complex, shape (rows, places)
        Displacement at each flutter point, on the same places of the wing in every variant.
    """

    status: Status
    message: str = ""
    rows: tuple[FlutterRow, ...] = ()
    motions: Complex | None = None


@dataclass(frozen=True)
class Matched:
    """The flutter points of the model's own settings as one variant has them; nan: not found.

    Attributes
    ----------
    speed, frequency, likeness : array, shape (flutter_point,)
        m/s, Hz, and the likeness (MAC) of the motions.
    """

    speed: Real
    frequency: Real
    likeness: Real


@dataclass(frozen=True)
class ConvergenceStudy:
    """A convergence study, as far as it came.

    Attributes
    ----------
    dataset : xarray.Dataset
    case : Case
        Solved with the model's own settings.
    failures : tuple of str
        What failed, and why.
    interrupted : bool
        Whether the run was stopped before its end.
    """

    dataset: "xarray.Dataset"
    case: Case
    failures: tuple[str, ...]
    interrupted: bool


def convergence_study(
    model: AeroelasticWing,
    folds: tuple[float, ...],
    chosen: Sequence[Variant],
    *,
    highest: float | None = None,
    jobs: int = 1,
    progress: Callable[[int], None] = lambda finished: None,
    source: Source = NO_SOURCE,
) -> ConvergenceStudy:
    """Solve one case with one setting at a time changed, and follow its flutter points.

    A variant that fails is named and the others stand; an interruption keeps what is finished.

    Parameters
    ----------
    model : AeroelasticWing
    folds : tuple of float
        psi_2 .. psi_N in degrees.
    chosen : sequence of Variant
        As `foldwing.studies.variants.variants` gives them.
    highest : float, optional
        Highest airspeed of the search in m/s; by default three times the divergence speed of the
        flat wing.
    jobs : int
        Processes to run in parallel.
    progress : callable
        Called with the number of finished variants after each.
    source : Source
        What was asked for, kept with the result.
    """
    speeds = speed_range(model, highest)
    case = solve_case(model, folds, speeds)
    grid = surface_grid(model.wing)
    base = _solved(case, grid)
    wings = [variant for variant in chosen if not variant.own]
    models = [replace(model, wing=variant.wing) for variant in wings]
    found: list[Solved] = []
    try:
        for solved in _solve(models, (folds, _widened(speeds), grid), jobs):
            found.append(solved)
            progress(len(found))
    except KeyboardInterrupt:
        pass
    interrupted = len(found) < len(wings)
    rest = [Solved(Status.ABSENT, "interrupted")] * (len(wings) - len(found))
    others = iter([*found, *rest])
    answers = [base if variant.own else next(others) for variant in chosen]
    attrs: dict[str, Any] = provenance(
        model.wing.title,
        "convergence",
        source.model_text,
        METHODS[model.aerodynamics],
        source.options,
    )
    attrs |= search_attributes(model, speeds)
    if interrupted:
        attrs["interrupted"] = f"{len(found)} of {len(wings)} variants finished"
    dataset = _dataset(case, base, chosen, answers, attrs)
    return ConvergenceStudy(dataset, case, _failures(chosen, answers), interrupted)


def _widened(speeds: tuple[float, float]) -> tuple[float, float]:
    """Return the range for variants: a point near an end of the search may move beyond it."""
    return speeds[0] / WIDER, speeds[1] * WIDER


def _solve(
    models: Sequence[AeroelasticWing],
    rest: tuple[tuple[float, ...], tuple[float, float], SurfaceGrid],
    jobs: int,
) -> Iterator[Solved]:
    if jobs == 1:
        for model in models:
            yield _attempt(model, *rest)
        return
    from joblib import Parallel, delayed

    run = Parallel(n_jobs=jobs, return_as="generator")
    yield from run(delayed(_attempt)(model, *rest) for model in models)


def _attempt(
    model: AeroelasticWing,
    folds: tuple[float, ...],
    speeds: tuple[float, float],
    grid: SurfaceGrid,
) -> Solved:
    try:
        return _solved(solve_case(model, folds, speeds), grid)
    except (*NUMERICAL_FAILURES, MemoryError) as problem:
        return Solved(Status.FAILED, f"{type(problem).__name__}: {problem}")


def _solved(case: Case, grid: SurfaceGrid) -> Solved:
    motions = np.einsum("pan,fn->fpa", grid.displacement(case.modes), case.motions())
    rows = case.rows(0)
    places = 3 * len(grid.x)
    return Solved(case.status, case.warning, tuple(rows), motions.reshape(len(rows), places))


def _failures(chosen: Sequence[Variant], answers: Sequence[Solved]) -> tuple[str, ...]:
    return tuple(
        f"{variant.setting} {variant.value:g}: {solved.status.meaning}: {solved.message}"
        for variant, solved in zip(chosen, answers, strict=True)
        if solved.status is Status.FAILED
    )


def _matched(base: Solved, other: Solved) -> Matched:
    speed, frequency, alike = np.full((3, len(base.rows)), np.nan)
    if base.motions is not None and other.motions is not None and other.rows:
        every = likeness(base.motions, other.motions)
        for point, partner in enumerate(match_points(base.rows, other.rows, every)):
            if partner >= 0:
                row = other.rows[partner]
                speed[point], frequency[point] = row.speed, row.frequency
                alike[point] = every[point, partner]
    return Matched(speed, frequency, alike)


def assessed(setting: str, levels: Real, speeds: Real, at: int | None) -> Convergence:
    """Return how the airspeed of one flutter point converges with one setting.

    Parameters
    ----------
    setting : str
    levels : array, shape (m,)
        Ascending values of the setting.
    speeds : array, shape (m,)
        nan where the point is missing.
    at : int or None
        Level whose error is wanted; None when it is not among the levels.
    """
    rule = SETTINGS[setting]
    if at is not None and rule.finer_when_smaller:
        levels, speeds, at = levels[::-1], speeds[::-1], len(levels) - 1 - at
    if at is None or np.isnan(speeds[at:]).any():
        return Convergence(MISSING, np.nan, np.nan, np.nan)
    there = np.isfinite(speeds)
    size = 1.0 / levels[there] if rule.power_law else levels[there]
    return assess(size, speeds[there], float(speeds[at]), power_law=rule.power_law)


def _dataset(
    case: Case,
    base: Solved,
    chosen: Sequence[Variant],
    answers: Sequence[Solved],
    attrs: Variables,
) -> "xarray.Dataset":
    matched = [_matched(base, solved) for solved in answers]
    level, table = ("level",), ("level", "flutter_point")
    shape = (len(chosen), len(base.rows))
    variables: Variables = {
        "level_setting": (level, np.array([one.setting for one in chosen], np.str_)),
        "level_value": (level, np.array([one.value for one in chosen], float)),
        "level_own": (level, np.array([one.own for one in chosen], bool)),
        "level_status": (level, np.array([int(solved.status) for solved in answers], np.int64)),
        "level_message": (level, np.array([solved.message for solved in answers], np.str_)),
    }
    for name in ("speed", "frequency", "likeness"):
        values = [getattr(one, name) for one in matched]
        variables[f"level_{name}"] = (table, np.array(values, float).reshape(shape))
    names = list(dict.fromkeys(one.setting for one in chosen))
    variables |= _verdicts(names, chosen, variables["level_speed"][1])
    variables |= _totals(variables, names, np.array([row.speed for row in base.rows], float))
    variables |= table_variables(base.rows) | verdict_variables([case])
    variables["message"] = (("fold",), np.array([case.warning], np.str_))
    coords = fold_coordinates([case.folds])
    coords["setting"] = (("setting",), np.array(names, np.str_))
    coords["level"] = (level, np.arange(len(chosen)))
    coords["flutter_point"] = (("flutter_point",), np.arange(len(base.rows)))
    return build_dataset(variables, coords, attrs)


def _verdicts(names: Sequence[str], chosen: Sequence[Variant], speed: Real) -> Variables:
    """Return order, limit and error bar in m/s by setting and flutter point."""
    dims, shape = ("setting", "flutter_point"), (len(names), speed.shape[1])
    table: list[Convergence] = []
    for name in names:
        where = [index for index, one in enumerate(chosen) if one.setting == name]
        values = np.array([chosen[index].value for index in where])
        at = next((i for i, index in enumerate(where) if chosen[index].reference), None)
        table += [assessed(name, values, column, at) for column in speed[where].T]
    return {
        variable: (dims, np.array([getattr(one, field) for one in table], dtype).reshape(shape))
        for variable, field, dtype in (
            ("convergence", "verdict", np.str_),
            ("order", "order", float),
            ("limit_speed", "limit", float),
            ("error_speed", "error", float),
        )
    }


def _totals(variables: Variables, names: Sequence[str], own: Real) -> Variables:
    """Return limit and error bar of the mesh as a whole; nan unless all of it was varied.

    The errors are no accidents that may cancel: they are added.
    """
    rows = [names.index(name) for name in MESH if name in names]
    limits, errors = (variables[name][1][rows] for name in ("limit_speed", "error_speed"))
    whole = len(rows) == len(MESH)
    limit = own + (limits - own).sum(axis=0) if whole else np.full(len(own), np.nan)
    error = errors.sum(axis=0) if whole else np.full(len(own), np.nan)
    table = ("flutter_point",)
    return {"mesh_limit_speed": (table, limit), "mesh_error_speed": (table, error)}
