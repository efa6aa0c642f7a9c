"""The tables of a model file, as they are written."""

import math
from typing import Annotated, Any, Literal, Self

from pydantic import Field, StrictBool, model_validator

from foldwing.conventions import STANDARD_GRAVITY
from foldwing.errors import InputError
from foldwing.model.aircraft import TailTheory, Trim, WingTheory
from foldwing.model.faults import fault
from foldwing.model.flight import FlightTable
from foldwing.model.listed import Point, Positions, Thickness
from foldwing.model.material import Material
from foldwing.model.modes_file import ModesTable
from foldwing.model.parts import FLARE, MOST_SPRINGS, Air, Analysis, Lattice, PointMass
from foldwing.model.planform import MOST as MOST_CORNERS
from foldwing.model.quantities import (
    Acceleration,
    Airspeed,
    Angle,
    Bounds,
    ChordFraction,
    Count,
    Distance,
    HingeStiffness,
    InertiaPerSpan,
    Length,
    LiftCoefficient,
    LiftSlope,
    Mass,
    MassPerSpan,
    PitchInertia,
    Position,
    Quantity,
    SectionStiffness,
    TailArm,
)
from foldwing.model.record import Record
from foldwing.model.section_table import SectionTable
from foldwing.model.segment import MID_CHORD

MOST_SWEEP = math.radians(80.0)
"""Largest sweep of a segment, rad."""

SWEEP = Quantity("an angle", "rad", "20", Bounds(-MOST_SWEEP, None, MOST_SWEEP), "degrees")
CornerNumber = Annotated[int, Count(1, MOST_CORNERS)]

HingeForm = Literal["springs", "stiffness", "rigid", "free"]

_FORMS = (
    'Write hinge = { springs = 3, spacing = "15 mm", stiffness = "0.18 N*m/rad" }, '
    '{ stiffness = "0.54 N*m/rad" }, { rigid = true } or { free = true }.'
)


class HingeTable(Record):
    """The hinge at the inboard edge of a segment: springs, one stiffness, rigid or free.

    With ``springs`` or ``positions`` the stiffness is that of each spring, without them that of the
    whole hinge.
    """

    fold: Angle = 0.0
    flare: Annotated[float, FLARE] | None = None
    gap: Distance = 0.0
    positions: Positions | None = None
    springs: Annotated[int, Count(1, MOST_SPRINGS)] | None = None
    spacing: Distance | None = None
    stiffness: HingeStiffness | None = None
    rigid: StrictBool | None = None
    free: StrictBool | None = None

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        for key in ("rigid", "free"):
            if getattr(self, key) is False:
                raise fault((key,), False, "can only be true", f"Remove {key}. {_FORMS}")
        kinds = [key for key in ("stiffness", "rigid", "free") if getattr(self, key) is not None]
        if len(kinds) > 1:
            limit = f"a hinge has only one of {' and '.join(kinds)}"
            raise fault((kinds[1],), getattr(self, kinds[1]), limit, _FORMS)
        if self.positions is not None:
            self._check_positions(kinds)
        elif self.springs is not None or self.spacing is not None:
            self._check_springs(kinds)
        elif not kinds:
            raise fault((), None, "needs a stiffness, or to be rigid or free", _FORMS)
        return self

    def _check_springs(self, kinds: list[str]) -> None:
        if kinds and kinds != ["stiffness"]:
            limit = f"a {kinds[0]} hinge has no springs"
            raise fault((kinds[0],), True, limit, _FORMS)
        if self.springs is None:
            limit = "must be given together with spacing"
            raise fault(("springs",), None, limit, "Add springs = 3, or remove spacing.")
        if self.stiffness is None:
            limit = "must be given together with springs"
            remedy = 'Add the stiffness of each spring, stiffness = "0.18 N*m/rad".'
            raise fault(("stiffness",), None, limit, remedy)
        if self.springs > 1 and self.spacing is None:
            limit = f"must be given for {self.springs} springs"
            raise fault(("spacing",), None, limit, 'Add spacing = "15 mm".')

    def _check_positions(self, kinds: list[str]) -> None:
        for key in ("springs", "spacing"):
            if getattr(self, key) is not None:
                limit = "must not be given together with positions"
                raise fault((key,), getattr(self, key), limit, f"Remove {key}.")
        if not kinds:
            limit = "must be given together with positions, or the hinge be rigid or free"
            remedy = 'Add the stiffness of each spring, stiffness = "0.18 N*m/rad".'
            raise fault(("stiffness",), None, limit, remedy)

    @property
    def form(self) -> HingeForm:
        """Which of the four ways of describing a hinge was taken."""
        if self.rigid:
            return "rigid"
        if self.free:
            return "free"
        discrete = self.springs is not None or self.positions is not None
        return "springs" if discrete else "stiffness"


class SegmentKeys(Record):
    """What may be said of one segment, or in the wing table of all."""

    structure: Literal["beam", "plate"] | None = None
    span: Length | None = None
    chord: Length | None = None
    thickness: Thickness | None = None
    material: str | None = None
    elastic_axis: ChordFraction | None = None
    mass_centre: ChordFraction | None = None
    bending_stiffness: SectionStiffness | None = None
    torsion_stiffness: SectionStiffness | None = None
    mass_per_span: MassPerSpan | None = None
    inertia_per_span: InertiaPerSpan | None = None
    lift_slope: LiftSlope | None = None


class SegmentTable(SegmentKeys):
    """One segment; what it does not say is taken from the wing table."""

    tip_chord: Length | None = None
    sweep: Annotated[float, SWEEP] | None = None
    corners: tuple[Point, ...] | None = None
    outboard_edge: tuple[CornerNumber, ...] | None = None
    modes: ModesTable | None = None
    hinge: HingeTable | None = None


class WingTable(SegmentKeys):
    """The segments from root to tip, and what they have in common."""

    segment: tuple[SegmentTable, ...] = ()

    @model_validator(mode="after")
    def _hinges_join_segments(self) -> Self:
        if not self.segment:
            limit = "a wing has at least 1 segment"
            raise fault(("segment",), "no segment", limit, "Add a [[wing.segment]] table.")
        for index, segment in enumerate(self.segment):
            where = ("segment", index, "hinge")
            if index == 0 and segment.hinge is not None:
                limit = "the first segment is clamped at the root and has no hinge"
                raise fault(
                    where, "a hinge", limit, "Move it to the segment outboard of the hinge."
                )
            if index > 0 and segment.hinge is None:
                limit = "every segment after the first needs the hinge at its inboard edge"
                raise fault(where, None, limit, _FORMS)
        return self


class FuselageTable(Record):
    """The fuselage; without ``x`` it is placed so that the centre of gravity is as wanted."""

    mass: Mass
    pitch_inertia: PitchInertia
    x: Position | None = None


class TailTable(Record):
    """The horizontal tail; without ``x`` it is placed by the tail arm."""

    mass: Mass
    pitch_inertia: PitchInertia
    chord: Length
    span: Length
    x: Position | None = None
    elastic_axis: ChordFraction = MID_CHORD
    lift_slope: LiftSlope = 2.0 * math.pi


class AircraftTable(Record):
    """The aircraft that the wing belongs to; ``figures`` says whose the numbers are.

    With "full" figures mass, inertia and span of fuselage and tail are those of the whole aircraft,
    with "half" those of the half that belongs to the one wing.
    """

    fuselage: FuselageTable
    tail: TailTable
    figures: Literal["half", "full"] = "full"
    tail_arm: TailArm | None = None
    centre_of_gravity: Position | None = None
    gravity: Acceleration = STANDARD_GRAVITY
    trim: Trim = "force"
    wing_aerodynamics: WingTheory = "theodorsen"
    tail_aerodynamics: TailTheory = "theodorsen"
    largest_lift_coefficient: LiftCoefficient = 1.2
    cruise_speed: Airspeed | None = None

    @model_validator(mode="after")
    def _places_its_parts(self) -> Self:
        _check_place("tail_arm", self.tail_arm, "tail", self.tail.x, '"25 cm"')
        cg = self.centre_of_gravity
        _check_place("centre_of_gravity", cg, "fuselage", self.fuselage.x, '"12.5 mm"')
        return self


def _check_place(key: str, wanted: float | None, part: str, x: float | None, example: str) -> None:
    """Refuse a part of the aircraft that is placed twice or not at all."""
    remedy = f"Give either {key} = {example}, or x in [aircraft.{part}]."
    if wanted is None and x is None:
        raise fault((key,), None, f"must be given, or else x of the {part}", remedy)
    if wanted is not None and x is not None:
        raise fault((key,), wanted, f"must not be given together with x of the {part}", remedy)


COMMANDS = {
    "wing": "foldwing modes, flutter, boundary, convergence, steady or aircraft",
    "flight": "foldwing flight",
    "section": "foldwing section",
}
"""By table that a model file may be about: what works on it."""


class ModelFile(Record):
    """A whole model file."""

    wing: WingTable | None = None
    title: str = ""
    material: dict[str, Material] = Field(default_factory=dict)
    point_mass: tuple[PointMass, ...] = ()
    aircraft: AircraftTable | None = None
    air: Air = Air()
    analysis: Analysis = Analysis()
    lattice: Lattice = Lattice()
    flight: FlightTable | None = None
    section: SectionTable | None = None

    @model_validator(mode="after")
    def _is_about_something(self) -> Self:
        if all(getattr(self, table) is None for table in COMMANDS):
            limit = f"is required: a model has a table {' or '.join(f'[{t}]' for t in COMMANDS)}"
            raise fault(("wing",), None, limit, "Add wing.")
        return self

    def built_of(self, structure: str) -> Self:
        """Return the same model with segments of another structure, where they are not imported."""
        if self.wing is None:
            return self
        segments = tuple(s.model_copy(update={"structure": None}) for s in self.wing.segment)
        wing = self.wing.model_copy(update={"structure": structure, "segment": segments})
        return self.model_copy(update={"wing": wing})

    def missing(self, table: str) -> InputError:
        """Return the error of a command that needs a table which this file does not have."""
        others = [name for name in COMMANDS if getattr(self, name) is not None]
        use = "; or use " + " or ".join(COMMANDS[name] for name in others) if others else ""
        return InputError(table, None, f"this command needs a [{table}] table", f"Add it{use}.")


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a model file, for editors."""
    schema = ModelFile.model_json_schema()
    about = [{"required": [table]} for table in COMMANDS]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema, "anyOf": about}
