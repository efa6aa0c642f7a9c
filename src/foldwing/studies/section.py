"""A typical section: its flutter points and eigenvalues, and a sweep of its torsion spring."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.airfoil.system import SectionSystem
from foldwing.maths.arrays import Real
from foldwing.model import TypicalSection
from foldwing.results.flutter_table import FlutterRow, table_variables
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.results.units import as_ratios
from foldwing.stability.flutter import FlutterAnalysis, find_flutter
from foldwing.stability.loci import root_loci
from foldwing.stability.status import Status
from foldwing.studies.case import flutter_row, verdict_variables
from foldwing.studies.failures import NUMERICAL_FAILURES
from foldwing.studies.flutter import loci_variables, padded
from foldwing.studies.lowest import Change
from foldwing.studies.section_curves import curve_variables, traced
from foldwing.studies.speeds import LOWEST_FRACTION, automatic_end, picture_speeds

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]

METHODS = {
    "strip": "typical section, Theodorsen's theory, sweep of the reduced frequency",
    "quasi-steady": "typical section, quasi-steady theory, sweep of the reduced frequency",
}
"""One line per aerodynamic model on how the numbers are computed."""


@dataclass(frozen=True)
class SectionCase:
    """A section with one torsion spring, solved.

    Attributes
    ----------
    system : SectionSystem
    analysis : FlutterAnalysis
    """

    system: SectionSystem
    analysis: FlutterAnalysis

    @property
    def section(self) -> TypicalSection:
        """The section itself."""
        return self.system.section

    @property
    def uncertified_modes(self) -> tuple[str, ...]:
        """None: the theory resolves every mode at any airspeed."""
        return ()

    @property
    def unstable_motions(self) -> tuple[str, ...]:
        """None: a section does not fly."""
        return ()

    @property
    def status(self) -> Status:
        """OK, or uncertified when the count of unstable roots does not agree."""
        return Status.OK if self.analysis.certified else Status.UNCERTIFIED

    def rows(self, index: int) -> list[FlutterRow]:
        """Return the table of flutter points of this case, whose number is ``index``."""
        names, threshold = self.system.mode_names, self.analysis.threshold
        unit = frequency_unit(self.section)
        rows = [flutter_row(point, index, (), names, threshold) for point in self.analysis.points]
        return [replace(row, frequency=row.frequency * unit) for row in rows]


@dataclass(frozen=True)
class SectionOutcome:
    """A case of a sweep: solved, or failed with the reason.

    Attributes
    ----------
    ratio : float
        omega_alpha / omega_1.
    case : SectionCase or None
    message : str
        Why the case failed; empty when it did not.
    """

    ratio: float
    case: SectionCase | None
    message: str = ""

    @property
    def status(self) -> Status:
        """How the case ended."""
        return Status.FAILED if self.case is None else self.case.status


@dataclass(frozen=True)
class SectionStudy:
    """What was found, with its dataset.

    Attributes
    ----------
    dataset : xarray.Dataset
    outcomes : tuple of SectionOutcome
    changes : tuple of Change
        Where the lowest onset goes over to another curve, in a sweep; frequencies in Hz, or over
        omega_1 for a section without scales.
    """

    dataset: "xarray.Dataset"
    outcomes: tuple[SectionOutcome, ...]
    changes: tuple[Change, ...] = ()


def frequency_unit(section: TypicalSection) -> float:
    """Return what a frequency in cycles is multiplied by: 1, or 2 pi for omega / omega_1."""
    return 1.0 if section.has_scales else 2.0 * np.pi


def section_study(
    section: TypicalSection,
    *,
    aerodynamics: str = "strip",
    speeds: Real | None = None,
    highest: float | None = None,
    source: Source = NO_SOURCE,
) -> SectionStudy:
    """Find all flutter points of a section, and its eigenvalues against airspeed.

    Airspeeds are in m/s, or U / (b omega_1) for a section without scales.

    Parameters
    ----------
    section : TypicalSection
    aerodynamics : str
        ``strip`` or ``quasi-steady``.
    speeds : array, shape (u,), optional
        Of the eigenvalues; by default 61 from 0 to 1.5 times the critical speed.
    highest : float, optional
        End of the search for flutter points; by default the last of ``speeds``, else three times
        the divergence speed.
    source : Source
        What was asked for, kept with the result.
    """
    if highest is None and speeds is not None:
        highest = float(speeds[-1])
    system = SectionSystem(section, aerodynamics)
    case = _solved(system, search_range(system, highest))
    chosen = picture_speeds(case.analysis) if speeds is None else speeds
    loci = root_loci(system, chosen, case.analysis.sweep).by_mode(system.size)
    curves = loci_variables(loci, system.mode_names)
    dims, frequency = curves["frequency"]
    curves["frequency"] = (dims, frequency * frequency_unit(section))
    outcome = SectionOutcome(section.torsion_frequency_ratio, case)
    variables = padded(_modes([system]), len(loci.mode)) | curves | _cases([outcome])
    coords = {
        "speed": (("speed",), chosen),
        "mode": (("mode",), np.arange(1, len(loci.mode) + 1)),
    }
    dataset = _dataset(case.system, [outcome], (variables, coords), source)
    floor, limit = case.analysis.speed_range
    attrs = {"speed_floor": floor, "speed_limit": limit}
    return SectionStudy(dataset.assign_attrs(attrs), (outcome,))


def section_sweep(
    section: TypicalSection,
    ratios: Sequence[float],
    *,
    aerodynamics: str = "strip",
    highest: float | None = None,
    progress: Callable[[int], None] = lambda finished: None,
    source: Source = NO_SOURCE,
) -> SectionStudy:
    """Find the flutter boundary against the torsion frequency ratio, as points and as curves.

    A case that fails is named and the others stand.

    Parameters
    ----------
    section : TypicalSection
    ratios : sequence of float
        omega_alpha / omega_1, ascending, at least two; the torsion spring changes and nothing else.
    aerodynamics, highest, source
        As of `section_study`; the search ends at three times the highest divergence speed.
    progress : callable
        Called with the number of finished cases after each.
    """
    family = section_family(section, aerodynamics)
    systems = [family(ratio) for ratio in ratios]
    ranges = [search_range(system, highest) for system in systems]
    speeds = min(low for low, _ in ranges), max(top for _, top in ranges)
    outcomes = []
    for ratio, system, (lowest, _) in zip(ratios, systems, ranges, strict=True):
        outcomes.append(_attempt(ratio, system, (lowest, speeds[1])))
        progress(len(outcomes))
    points = [
        (outcome.ratio, point)
        for outcome in outcomes
        if outcome.case is not None
        for point in outcome.case.analysis.points
    ]
    threshold = section.analysis.damping_threshold
    curves, stretches, changes = traced(family, np.array(ratios), points, speeds, threshold)
    unit = frequency_unit(section)
    found = tuple(
        replace(change, frequency=(change.frequency[0] * unit, change.frequency[1] * unit))
        for change in changes
    )
    drawn, coords = curve_variables(curves, stretches, unit)
    variables = _modes(systems) | drawn | _changes(found) | _cases(outcomes)
    coords["mode"] = (("mode",), np.arange(1, systems[0].size + 1))
    if found:
        coords["change"] = (("change",), np.arange(len(found)))
        coords["side"] = (("side",), np.array(["below", "above"]))
    dataset = _dataset(systems[0], outcomes, (variables, coords), source)
    attrs = {"speed_limit": speeds[1], "swept": "torsion_frequency_ratio"}
    return SectionStudy(dataset.assign_attrs(attrs), tuple(outcomes), found)


def section_family(
    section: TypicalSection, aerodynamics: str = "strip"
) -> Callable[[float], SectionSystem]:
    """Return the system of a section as a function of its torsion frequency ratio."""

    @lru_cache(maxsize=64)
    def system(ratio: float) -> SectionSystem:
        return SectionSystem(section.with_torsion(ratio), aerodynamics)

    return system


def search_range(system: SectionSystem, highest: float | None = None) -> tuple[float, float]:
    """Return the lowest and highest airspeed between which flutter is sought.

    Parameters
    ----------
    system : SectionSystem
    highest : float, optional
        By default three times the divergence speed, rounded up to two digits.
    """
    section = system.section
    automatic = automatic_end(system, section.torsion_frequency_ratio * section.rate_unit)
    top = automatic if highest is None else highest
    return min(top, automatic) * LOWEST_FRACTION, top


def _solved(system: SectionSystem, speeds: tuple[float, float]) -> SectionCase:
    threshold = system.section.analysis.damping_threshold
    return SectionCase(system, find_flutter(system, speeds, threshold))


def _attempt(ratio: float, system: SectionSystem, speeds: tuple[float, float]) -> SectionOutcome:
    try:
        return SectionOutcome(ratio, _solved(system, speeds))
    except NUMERICAL_FAILURES as problem:
        return SectionOutcome(ratio, None, f"{type(problem).__name__}: {problem}")


def _modes(systems: Sequence[SectionSystem]) -> Variables:
    """Return natural frequencies and names of the modes at rest, by case."""
    dims = ("fold", "mode")
    hertz = [
        system.frequency_ratios * system.section.rate_unit * frequency_unit(system.section)
        for system in systems
    ]
    return {
        "natural_frequency": (dims, np.array(hertz) / (2.0 * np.pi)),
        "mode_name": (dims, np.array([system.mode_names for system in systems])),
    }


def _cases(outcomes: Sequence[SectionOutcome]) -> Variables:
    """Return the flutter points of all cases and what is known of each case as a whole."""
    rows = [
        (outcome.case.section, row)
        for index, outcome in enumerate(outcomes)
        if outcome.case is not None
        for row in outcome.case.rows(index)
    ]
    ratios = {
        "speed_ratio": [row.speed / section.speed_unit for section, row in rows],
        "frequency_ratio": [
            row.frequency / frequency_unit(section) * 2.0 * np.pi / section.rate_unit
            for section, row in rows
        ],
    }
    points = table_variables([row for _, row in rows])
    points |= {name: (("flutter_point",), np.array(values)) for name, values in ratios.items()}
    verdicts = verdict_variables([outcome.case for outcome in outcomes])
    messages = np.array([outcome.message for outcome in outcomes], np.str_)
    return points | verdicts | {"message": (("fold",), messages)}


def _changes(found: Sequence[Change]) -> Variables:
    """Return where the lowest onset goes over to another curve; nothing when it never does."""
    if not found:
        return {}
    one, both = ("change",), ("change", "side")
    return {
        "change_torsion_ratio": (one, np.array([change.parameter for change in found])),
        "change_kind": (one, np.array([change.kind for change in found])),
        "change_speed": (both, np.array([change.speed for change in found])),
        "change_frequency": (both, np.array([change.frequency for change in found])),
        "change_confirmed": (one, np.array([change.confirmed for change in found])),
    }


def _dataset(
    system: SectionSystem,
    outcomes: Sequence[SectionOutcome],
    values: tuple[Variables, Variables],
    source: Source,
) -> "xarray.Dataset":
    """Return the dataset of one case or a sweep, its attributes saying what the numbers are."""
    variables, coords = values
    section = system.section
    crossings = system.uncoupled_crossings()
    variables = variables | {"crossing_torsion_ratio": (("crossing",), crossings)}
    coords = coords | {
        "fold": (("fold",), np.arange(len(outcomes))),
        "torsion_frequency_ratio": (("fold",), np.array([one.ratio for one in outcomes])),
        "crossing": (("crossing",), np.arange(1, len(crossings) + 1)),
        "flutter_point": (("flutter_point",), np.arange(len(variables["case"][1]))),
    }
    if not section.has_scales:
        variables, coords = as_ratios(variables), as_ratios(coords)
    attrs: dict[str, Any] = provenance(
        section.title,
        "section",
        source.model_text,
        METHODS[system.aerodynamics],
        source.options,
    )
    return build_dataset(variables, coords, attrs | _described(section))


def _described(section: TypicalSection) -> dict[str, float]:
    """Return damping, threshold and scales of a section as attributes."""
    analysis = section.analysis
    described = {
        "damping": analysis.damping,
        "damping_threshold": analysis.damping_threshold,
    }
    if section.half_chord is not None and section.plunge_frequency is not None:
        described["half_chord"] = section.half_chord
        described["plunge_frequency"] = section.plunge_frequency
    return described
