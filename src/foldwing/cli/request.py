"""What is asked for on the command line, and the wing that it means."""

import contextlib
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any

from foldwing.errors import InputError
from foldwing.model import Wing, folder_of, parse_model

if TYPE_CHECKING:
    from foldwing.aeroelastic.wing import AeroelasticWing


@dataclass(frozen=True)
class Request:
    """What is to be computed; every field as the user gave it."""

    model: str
    fold: str | None = None
    fold_of: list[str] | None = None
    basis: str | None = None
    structure: str | None = None
    aero: str | None = None
    drop_mode: list[str] | None = None
    panels: str | None = None
    spacing: str | None = None
    gap: str | None = None
    damping: float | None = None
    damping_threshold: float | None = None
    max_speed: float | None = None
    speeds: str | None = None
    measured: str | None = None
    trace: bool = False
    jobs: int = 1
    vary: str | None = None
    levels: list[str] | None = None
    method: str = "sweep"
    time_step: float | None = None
    clamped: bool = False
    tail_aero: str | None = None
    trim: str | None = None

    @property
    def options(self) -> dict[str, Any]:
        """The options that differ from their defaults, kept with the result."""
        defaults = {field.name: field.default for field in fields(self)}
        return {key: value for key, value in asdict(self).items() if value != defaults[key]}

    def wing(self, text: str) -> Wing:
        """Return the wing of the model file, its analysis changed by the options."""
        folder = folder_of(self.model)
        wing = parse_model(text, self.model, structure=self.structure, folder=folder)
        changes = {
            "basis": self.basis,
            "damping": self.damping,
            "damping_threshold": self.damping_threshold,
        }
        given = {key: value for key, value in changes.items() if value is not None}
        wing = self._meshed(self._carried(wing))
        try:
            return wing.with_analysis(**given) if given else wing
        except InputError as problem:
            key = problem.field.removeprefix("analysis.")
            raise InputError(
                f"--{key.replace('_', '-')}", problem.value, problem.limit, problem.remedy
            ) from None

    def clamped_wing(self, text: str, command: str) -> Wing:
        """Return the wing of the model file for a command that knows no aircraft."""
        wing = self.wing(text)
        if wing.aircraft is None:
            return wing
        limit = f"foldwing {command} studies wings whose root is clamped, and this is an aircraft"
        remedy = "Use foldwing aircraft, or add --clamped to study its wing alone."
        raise InputError("aircraft", "a table of this model", limit, remedy)

    def aircraft_wing(self, text: str) -> Wing:
        """Return the wing of the model file for a command that needs an aircraft."""
        wing = self.wing(text)
        if wing.aircraft is not None:
            return wing
        limit = "this command needs an [aircraft] table"
        remedy = "Add it, or use foldwing flutter for a wing whose root is clamped."
        raise InputError("aircraft", None, limit, remedy)

    def _carried(self, wing: Wing) -> Wing:
        """Return the wing with its aircraft as the options want it."""
        options = {"tail_aerodynamics": self.tail_aero, "trim": self.trim}
        given = {key: value for key, value in options.items() if value is not None}
        if self.clamped or wing.aircraft is None:
            for key, value in given.items():
                option = "--trim" if key == "trim" else "--tail-aero"
                limit = "belongs to an aircraft, and the root of this wing is clamped"
                remedy = "Leave it out, or take a model with an [aircraft] table without --clamped."
                raise InputError(option, value, limit, remedy)
            return wing.clamped
        return wing.carried_by(wing.aircraft.model_copy(update=given))

    def _meshed(self, wing: Wing) -> Wing:
        """Return the wing with the panels, their spacing and the gaps of the options."""
        if self.panels is not None:
            count = re.fullmatch(r"(\d{1,6})[x×](\d{1,6})", self.panels.strip())
            limit = "must be panels along the chord, x, strips along the span"
            if count is None:
                raise InputError("--panels", self.panels, limit, "Write for example --panels 8x30.")
            with _as_option("--panels"):
                wing = wing.with_lattice(chordwise=int(count[1]), spanwise=int(count[2]))
        if self.spacing is not None:
            with _as_option("--spacing"):
                wing = wing.with_lattice(spacing=self.spacing)
        if self.gap is not None:
            with _as_option("--gap"):
                wing = wing.with_gaps(_bare_or_text(self.gap))
        return wing

    def model_of(self, wing: Wing) -> "AeroelasticWing":
        """Return the wing with the aerodynamics asked for."""
        from foldwing.aeroelastic.wing import AeroelasticWing, default_aerodynamics

        aero = self.aero or default_aerodynamics(wing)
        lattice = {"--panels": self.panels, "--spacing": self.spacing, "--gap": self.gap}
        for option, value in lattice.items():
            if value is not None and aero != "lattice":
                limit = "belongs to the vortex lattice"
                raise InputError(option, value, limit, "Add --aero lattice, or leave it out.")
        dropped = tuple(name.upper() for name in self.drop_mode or ())
        return AeroelasticWing(wing, aero, dropped)

    def cases(self, wing: Wing) -> list[tuple[float, ...]]:
        """Return the fold angles in degrees of every case."""
        from foldwing.studies.grid import fold_cases

        return fold_cases(wing, self.fold, _by_hinge(self.fold_of or []))

    def one_case(self, wing: Wing, command: str = "flutter") -> tuple[float, ...]:
        """Return the fold angles in degrees when only one case is possible."""
        cases = self.cases(wing)
        if len(cases) > 1:
            ranges = _by_hinge(self.fold_of or [])
            hinge = next(hinge for hinge, text in ranges.items() if set(text) & {":", ","})
            limit = f"{command} takes one set of fold angles, not {len(cases)}"
            remedy = "Give one angle for each hinge, or use: foldwing boundary."
            raise InputError(f"--fold{hinge}", ranges[hinge], limit, remedy)
        return cases[0]


@contextlib.contextmanager
def _as_option(option: str) -> Iterator[None]:
    """Name the option where a value that it gave cannot be used."""
    try:
        yield
    except InputError as problem:
        raise InputError(option, problem.value, problem.limit, problem.remedy) from None


def _bare_or_text(value: str) -> float | str:
    try:
        return float(value)
    except ValueError:
        return value


def _by_hinge(texts: list[str]) -> dict[int, str]:
    """Return what ``I=ANGLE`` or ``--foldI ANGLE`` gave for each hinge."""
    result: dict[int, str] = {}
    for text in texts:
        number, _, value = text.partition("=")
        remedy = "Write --fold2 30, --fold2 0:150:5 or --fold3 level."
        if not number.isdecimal():
            raise InputError("--fold-of", text, "must be a hinge from 2 and its angle", remedy)
        hinge = int(number)
        if not value.strip():
            raise InputError(f"--fold{hinge}", None, "needs an angle", remedy)
        if hinge in result:
            raise InputError(f"--fold{hinge}", value, "was given already", "Give it once.")
        result[hinge] = value
    return result
