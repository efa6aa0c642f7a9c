"""The command ``section``: its request, its tables and what it does."""

from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any

import typer
from rich.console import Console

from foldwing.cli import tables
from foldwing.cli.commands import (
    FAILED,
    Output,
    computing,
    print_json,
    shown,
    write_result,
)
from foldwing.errors import InputError
from foldwing.model import TypicalSection, model_text, parse_section

if TYPE_CHECKING:
    import xarray

    from foldwing.results import Source
    from foldwing.results.steady_table import Table
    from foldwing.studies.section import SectionStudy

LARGEST_RATIO = 1e4
"""Torsion frequency ratio beyond which a typing error is more likely than a wish."""


@dataclass(frozen=True)
class SectionRequest:
    """What is to be computed; every field as the user gave it."""

    model: str
    torsion: str | None = None
    speeds: str | None = None
    max_speed: float | None = None
    aero: str = "strip"
    damping: float | None = None
    damping_threshold: float | None = None

    @property
    def options(self) -> dict[str, Any]:
        """The options that differ from their defaults, kept with the result."""
        defaults = {field.name: field.default for field in fields(self)}
        return {key: value for key, value in asdict(self).items() if value != defaults[key]}

    def section(self, text: str) -> TypicalSection:
        """Return the section of the model file, changed by the options."""
        section = parse_section(text, self.model)
        changes = {"damping": self.damping, "damping_threshold": self.damping_threshold}
        given = {key: value for key, value in changes.items() if value is not None}
        try:
            return section.with_analysis(**given) if given else section
        except InputError as problem:
            option = f"--{problem.field.removeprefix('analysis.').replace('_', '-')}"
            raise InputError(option, problem.value, problem.limit, problem.remedy) from None

    def ratios(self, section: TypicalSection) -> list[float]:
        """Return the torsion frequency ratios asked for, ascending; else that of the model."""
        from foldwing.studies.grid import parse_range

        if self.torsion is None:
            return [section.torsion_frequency_ratio]
        remedy = "Give one ratio, start:stop:step such as 0.5:8:0.1, or a list 1.5,3.7,7."
        ratios = sorted(parse_range(self.torsion, "--torsion", remedy))
        if ratios[0] <= 0.0 or ratios[-1] > LARGEST_RATIO:
            limit = f"must be greater than 0 and at most {LARGEST_RATIO:g}"
            raise InputError("--torsion", self.torsion, limit, remedy)
        return ratios


def run_section(request: SectionRequest, output: Output) -> None:
    """Compute the flutter points of a section, or its boundary against the torsion frequency."""
    text = model_text(request.model)
    section = request.section(text)
    ratios = request.ratios(section)
    _check_speeds(request, section, len(ratios))
    folder = output.folder("section", request.model)

    from foldwing.results import Source
    from foldwing.studies.answers import section_answer

    with computing():
        study = _solved(request, section, ratios, Source(text, request.options))
    if output.json:
        print_json(section_answer(study))
    else:
        with shown():
            show_section(study.dataset)
    write_result(study.dataset, folder, output)
    failed = [outcome for outcome in study.outcomes if outcome.case is None]
    tables.name_problems(
        [f"torsion frequency ratio {one.ratio:g}: failed: {one.message}" for one in failed]
    )
    if failed:
        raise typer.Exit(FAILED)


def _check_speeds(request: SectionRequest, section: TypicalSection, cases: int) -> None:
    """Refuse airspeeds that cannot be used before anything is computed."""
    from foldwing.studies.grid import parse_speeds
    from foldwing.studies.speeds import check_highest

    unit = _unit(section)
    check_highest(request.max_speed, unit)
    if request.speeds is not None and cases > 1:
        limit = f"belongs to one torsion frequency ratio, not {cases}"
        raise InputError("--speeds", request.speeds, limit, "Use --max-speed, or one --torsion.")
    if request.speeds is not None:
        parse_speeds(request.speeds, unit)


def _unit(section: TypicalSection) -> str:
    return "m/s" if section.has_scales else "b omega_1"


def _solved(
    request: SectionRequest, section: TypicalSection, ratios: list[float], source: "Source"
) -> "SectionStudy":
    from foldwing.studies.grid import parse_speeds
    from foldwing.studies.section import section_study, section_sweep

    common: dict[str, Any] = {
        "aerodynamics": request.aero,
        "highest": request.max_speed,
        "source": source,
    }
    if len(ratios) > 1:
        with tables.progress("Torsion frequencies", len(ratios)) as advance:
            return section_sweep(section, ratios, progress=advance, **common)
    speeds = None if request.speeds is None else parse_speeds(request.speeds, _unit(section))
    return section_study(section.with_torsion(ratios[0]), speeds=speeds, **common)


def show_section(dataset: "xarray.Dataset") -> None:
    """Print the answer, the flutter points and the certificate."""
    from foldwing.results.section_table import changes_table, lowest_table, section_points_table
    from foldwing.results.summary import answer, certificate, warnings

    console = Console(highlight=False)
    console.print(_plain(answer(dataset)))
    if dataset.sizes["fold"] == 1:
        console.print(_plain(_at_rest(dataset)))
        _print(console, section_points_table(dataset))
    else:
        console.print("\nLowest airspeed of instability at each torsion frequency ratio")
        _print(console, lowest_table(dataset))
    if dataset.sizes.get("change", 0):
        console.print("\nWhere the lowest onset goes over to another curve")
        _print(console, changes_table(dataset))
    limit = f"{dataset.attrs['speed_limit']:.4g} {_plain(_speed_unit(dataset))}"
    console.print(f"\nU in b omega_1, w in omega_1; flutter sought up to {limit}.")
    for text in filter(None, (certificate(dataset), *warnings(dataset))):
        console.print(_plain(text))


def _speed_unit(dataset: "xarray.Dataset") -> str:
    from foldwing.results.units import units_of

    return units_of(dataset).speed


def _at_rest(dataset: "xarray.Dataset") -> str:
    from foldwing.results.units import units_of

    names, values = (dataset[key].values[0] for key in ("mode_name", "natural_frequency"))
    modes = [f"{name} {value:.5g}" for name, value in zip(names, values, strict=True) if name]
    return f"At rest: {', '.join(modes)} {units_of(dataset).frequency}."


def _print(console: Console, table: "Table") -> None:
    if not table.rows:
        return
    printed = tables.new_table(*(_head(head) for head in table.heads))
    for column, cell in zip(printed.columns, table.rows[0], strict=True):
        column.justify = "right" if cell[:1].isdigit() else column.justify
        column.no_wrap = True
    for row in table.rows:
        printed.add_row(*(_plain(cell) for cell in row))
    console.print(printed)


def _head(text: str) -> str:
    """Return the head of a column, its words below each other and ratios by a letter."""
    return text.replace("U/(b ω₁)", "U").replace("ω/ω₁", "w").replace(" ", "\n")


def _plain(text: str) -> str:
    """Return text in letters that every terminal can show."""
    return tables.plain(text).replace("ω₁", "omega_1").replace("ω", "omega")
