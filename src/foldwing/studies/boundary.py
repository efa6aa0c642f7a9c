"""All flutter points over a grid of fold angles."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.results.flutter_table import table_variables
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.stability.status import Status
from foldwing.structure.following import FollowedModes, follow_modes
from foldwing.studies.aircraft import trim_parts
from foldwing.studies.case import Case, solve_case, verdict_variables
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.flutter import METHODS, search_attributes
from foldwing.studies.grid import radians, swept_hinge
from foldwing.studies.measured import Measured
from foldwing.studies.modes import fold_coordinates, mode_variables
from foldwing.studies.speeds import speed_range

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]


@dataclass(frozen=True)
class Outcome:
    """A case of a sweep: solved, or failed with the reason.

    Attributes
    ----------
    folds : tuple of float
        In degrees.
    case : Case or None
    message : str
        Why the case failed; empty when it did not.
    """

    folds: tuple[float, ...]
    case: Case | None
    message: str = ""

    @property
    def remark(self) -> str:
        """Why the case failed, or what makes its result doubtful."""
        return self.message if self.case is None else self.case.warning

    @property
    def status(self) -> Status:
        """How the case ended."""
        return Status.FAILED if self.case is None else self.case.status


@dataclass(frozen=True)
class Boundary:
    """A sweep, as far as it came.

    Attributes
    ----------
    dataset : xarray.Dataset
        Of the finished cases.
    outcomes : tuple of Outcome
    wanted : int
        Number of cases asked for; more than there are outcomes when the run was interrupted.
    """

    dataset: "xarray.Dataset"
    outcomes: tuple[Outcome, ...]
    wanted: int

    @property
    def interrupted(self) -> bool:
        """Whether the run was stopped before its end."""
        return len(self.outcomes) < self.wanted


def boundary_study(
    model: AeroelasticWing,
    cases: Sequence[tuple[float, ...]],
    *,
    highest: float | None = None,
    jobs: int = 1,
    progress: Callable[[int], None] = lambda finished: None,
    source: Source = NO_SOURCE,
    measured: Measured | None = None,
) -> Boundary:
    """Find all flutter points of every case.

    A case that fails is named and the others stand; an interruption keeps what is finished.

    Parameters
    ----------
    model : AeroelasticWing
    cases : sequence of tuple of float
        psi_2 .. psi_N in degrees of each case.
    highest : float, optional
        Highest airspeed of the search in m/s; by default three times the divergence speed of the
        flat wing.
    jobs : int
        Processes to run in parallel.
    progress : callable
        Called with the number of finished cases after each.
    source : Source
        What was asked for, kept with the result.
    measured : Measured, optional
        Measured points to lay over the picture.

    Raises
    ------
    KeyboardInterrupt
        When the run is interrupted before its first case is finished.
    """
    hinge = swept_hinge(cases)
    overlay = ({}, {}) if measured is None else measured.variables(hinge)
    speeds = speed_range(model, highest)
    outcomes: list[Outcome] = []
    try:
        for outcome in _outcomes(model, cases, speeds, jobs):
            outcomes.append(outcome)
            progress(len(outcomes))
    except KeyboardInterrupt:
        if not outcomes:
            raise
    attrs: dict[str, Any] = provenance(
        model.wing.title,
        "boundary",
        source.model_text,
        METHODS[model.aerodynamics],
        source.options,
    )
    attrs |= search_attributes(model, speeds)
    attrs |= {} if hinge is None else {"swept": f"fold_{hinge}"}
    if len(outcomes) < len(cases):
        attrs["interrupted"] = f"{len(outcomes)} of {len(cases)} cases finished"
    dataset = _dataset(model, outcomes, overlay, attrs)
    return Boundary(dataset, tuple(outcomes), len(cases))


def _outcomes(
    model: AeroelasticWing,
    cases: Sequence[tuple[float, ...]],
    speeds: tuple[float, float],
    jobs: int,
) -> Iterator[Outcome]:
    if jobs == 1:
        for folds in cases:
            yield attempt(model, folds, speeds)
        return
    from joblib import Parallel, delayed

    run = Parallel(n_jobs=jobs, return_as="generator")
    yield from run(delayed(attempt)(model, folds, speeds) for folds in cases)


def attempt(
    model: AeroelasticWing, folds: tuple[float, ...], speeds: tuple[float, float]
) -> Outcome:
    """Solve one case of a sweep; a numerical failure becomes part of the result."""
    try:
        return Outcome(folds, solve_case(model, folds, speeds))
    except NUMERICAL_FAILURES as problem:
        return Outcome(folds, None, f"{type(problem).__name__}: {problem}")


def _dataset(
    model: AeroelasticWing,
    outcomes: Sequence[Outcome],
    overlay: tuple[Variables, Variables],
    attrs: Mapping[str, Any],
) -> "xarray.Dataset":
    rows = [
        row
        for index, outcome in enumerate(outcomes)
        if outcome.case is not None
        for row in outcome.case.rows(index)
    ]
    folds = [outcome.folds for outcome in outcomes]
    trim, surfaces = trim_parts([outcome.case for outcome in outcomes])
    variables = table_variables(rows) | _frequencies(model, outcomes) | _verdicts(outcomes)
    variables |= trim | overlay[0]
    coords = fold_coordinates(folds) | surfaces | overlay[1]
    coords["flutter_point"] = (("flutter_point",), np.arange(len(rows)))
    if "natural_frequency" in variables:
        count = variables["natural_frequency"][1].shape[1]
        coords["mode"] = (("mode",), np.arange(1, count + 1))
    return build_dataset(variables, coords, attrs)


def _frequencies(model: AeroelasticWing, outcomes: Sequence[Outcome]) -> Variables:
    """Return the natural frequencies, followed from case to case; nan where a case failed."""
    cases = {i: outcome.case for i, outcome in enumerate(outcomes) if outcome.case is not None}
    if not cases:
        return {}
    found = mode_variables(_followed(model, list(cases.values())))
    spread = {}
    for name, (dims, values) in found.items():
        missing = "" if values.dtype.kind == "U" else np.nan
        every = np.full((len(outcomes), values.shape[1]), missing, values.dtype)
        every[list(cases)] = values
        spread[name] = (dims, every)
    return spread


def _followed(model: AeroelasticWing, cases: Sequence[Case]) -> list[FollowedModes]:
    """Return the modes of the cases in matched order, or as they are with no confidence."""
    try:
        return follow_modes(model.assembly, [radians(case.folds) for case in cases])
    except NUMERICAL_FAILURES:
        return [FollowedModes(case.modes, np.zeros(case.modes.count)) for case in cases]


def _verdicts(outcomes: Sequence[Outcome]) -> Variables:
    messages = np.array([outcome.remark for outcome in outcomes], dtype=np.str_)
    verdicts = verdict_variables([outcome.case for outcome in outcomes])
    return verdicts | {"message": (("fold",), messages)}
