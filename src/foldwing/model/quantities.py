"""Annotated types of the numbers in a model: a bare SI number or text with a unit gives a float.

Every type carries one `Quantity` (or `Count`), which validates, words the error and describes
itself in the JSON schema. Pint is loaded only when a text with a unit is met: it is slow to load,
and bare numbers do not need it.
"""

import math
import numbers
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from foldwing.conventions import DEGREE
from foldwing.errors import InputError
from foldwing.model.faults import fault, shown

if TYPE_CHECKING:
    import pint

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_NAME = r"[A-Za-zµμ°_]+(?:(?:\^|\*\*)-?\d|[²³⁴])?"
_UNIT = rf"{_NAME}(?:(?:\s*[*/·]\s*|\s+){_NAME})*"
# The grammar is narrower than Pint's, which would evaluate any arithmetic, 9**9**9 included.
_TEXT = re.compile(rf"\s*({_NUMBER})(?:\s*/\s*({_NUMBER}))?\s*({_UNIT})?\s*\Z")
_LONGEST_UNIT = 40
_LONGEST_TEXT = 100  # beyond it the time of the match grows out of hand
_PATTERN = rf"^\s*{_NUMBER}(\s*/\s*{_NUMBER})?\s*{_UNIT}\s*$"


@dataclass(frozen=True)
class Bounds:
    """The open or closed interval that a number must lie in; None where there is no bound."""

    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None

    def hold(self, value: float) -> bool:
        """Tell whether the value lies within the bounds."""
        return (
            (self.above is None or value > self.above)
            and (self.at_least is None or value >= self.at_least)
            and (self.below is None or value < self.below)
            and (self.at_most is None or value <= self.at_most)
        )

    def describe(self, unit: str) -> str:
        """Return the bounds in words, ``greater than 0 m``."""
        words = (
            ("greater than", self.above),
            ("at least", self.at_least),
            ("less than", self.below),
            ("at most", self.at_most),
        )
        return " and ".join(f"{word} {value:g}{unit}" for word, value in words if value is not None)


@dataclass(frozen=True)
class Quantity:
    """A finite number with a unit, or without one, and its bounds.

    Attributes
    ----------
    kind : str
        What it is, with its article: "a length".
    unit : str
        SI unit of the float; empty for a plain number, for which text is no use.
    example : str
        How it may be written in a model file.
    bounds : Bounds
        In the SI unit.
    bare : str
        Unit of a number without unit, when it is not the SI unit: degrees for angles.
    """

    kind: str
    unit: str
    example: str
    bounds: Bounds = Bounds()
    bare: str = ""

    @property
    def limit(self) -> str:
        """What the field accepts, for messages and for the JSON schema."""
        bare = self.bare or self.unit
        kind = f"{self.kind} ({bare})" if bare else self.kind
        words = self.bounds.describe(f" {self.unit}" if self.unit else "")
        return f"must be {kind}, finite and {words}" if words else f"must be {kind}, finite"

    @property
    def remedy(self) -> str:
        """How to write it."""
        if not self.unit:
            return f"Write a number without quotes, for example {self.example}."
        bare = self.bare or self.unit
        return f"Write for example {self.example}, or a bare number in {bare}."

    def parse(self, value: object) -> float:
        """Return the value in SI units, or raise the fault that names limit and remedy."""
        if isinstance(value, str) and self.unit:
            number = self._from_text(value)
        elif isinstance(value, numbers.Real) and not isinstance(value, bool):
            number = _as_float(value) * (DEGREE if self.bare else 1.0)
        else:
            raise self._fault(value)
        if not (math.isfinite(number) and self.bounds.hold(number)):
            raise self._fault(value)
        return number

    def read(self, value: object, field: str) -> float:
        """Return the value in SI units, or raise an InputError that names the field."""
        try:
            return self.parse(value)
        except PydanticCustomError as error:
            context = error.context or {}
            raise InputError(
                field, context["value"], context["limit"], context["remedy"]
            ) from error

    def _from_text(self, text: str) -> float:
        match = _TEXT.match(text) if len(text) <= _LONGEST_TEXT else None
        if match is None:
            raise self._fault(text, "this is no number with a unit")
        top, bottom, unit = match.groups()
        if unit is None:
            raise self._fault(text, "this text has no unit")
        if len(unit) > _LONGEST_UNIT:
            raise self._fault(text, "the unit is too long")
        factor, complaint = _unit_factor(unit, self.unit)
        if complaint:
            raise self._fault(text, complaint)
        divisor = float(bottom) if bottom else 1.0
        return float(top) / divisor * factor if divisor else math.nan

    def _fault(self, value: object, complaint: str = "") -> Exception:
        limit = f"{self.limit}; {complaint}" if complaint else self.limit
        return fault((), shown(value), limit, self.remedy)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validate with `parse`; an angle is written out in degrees, as it is read."""
        written = None
        if self.bare:
            written = core_schema.plain_serializer_function_ser_schema(lambda angle: angle / DEGREE)
        return core_schema.no_info_plain_validator_function(self.parse, serialization=written)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a number, or text with a unit."""
        number = {"type": "number", **_json_bounds(self.bounds)}
        if not self.unit:
            return {**number, "description": self._description}
        text = {"type": "string", "pattern": _PATTERN}
        return {"anyOf": [number, text], "description": self._description}

    @property
    def _description(self) -> str:
        limit = self.limit.removeprefix("must be ")
        return f"{limit[0].upper()}{limit[1:]}. {self.remedy}"


@dataclass(frozen=True)
class Count:
    """A whole number between two limits, both included; None for no upper limit."""

    least: int
    most: int | None = None

    def parse(self, value: object) -> int:
        """Return the value, or raise the fault that names limit and remedy."""
        if isinstance(value, numbers.Integral) and not isinstance(value, bool):
            number = int(value)
            if number >= self.least and (self.most is None or number <= self.most):
                return number
        words = f"{self.least} or more" if self.most is None else f"{self.least} to {self.most}"
        remedy = f"Write it without quotes or decimal point, for example {self.least}."
        raise fault((), shown(value), f"must be a whole number, {words}", remedy)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validate with `parse`."""
        return core_schema.no_info_plain_validator_function(self.parse)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: an integer with its limits."""
        limits = {"minimum": self.least} | ({} if self.most is None else {"maximum": self.most})
        return {"type": "integer", **limits}


@cache
def _registry() -> "pint.UnitRegistry[float]":
    import pint

    # A short list of our own loads in a quarter of the time of pint's.
    definitions = files("foldwing.model").joinpath("units.txt").read_text(encoding="utf-8")
    registry: pint.UnitRegistry[float] = pint.UnitRegistry(None, cache_folder=None)
    registry.load_definitions(definitions.splitlines())
    return registry


def _unit_factor(unit: str, si_unit: str) -> tuple[float, str]:
    """Return the value of one `unit` in SI, and a complaint when it has none."""
    import pint

    registry = _registry()
    try:
        one = registry.Quantity(1.0, unit)
        factor = float(one.to(si_unit).magnitude)
    except pint.DimensionalityError:
        return math.nan, f"{unit!r} is {one.dimensionality}"
    except (pint.PintError, ArithmeticError, AttributeError, TypeError, ValueError):
        return math.nan, f"{unit!r} is not a unit we know"
    if si_unit == "Hz" and "radian" in dict(one.to_root_units().unit_items()):
        factor /= 2.0 * math.pi  # to pint a radian is 1, and so would be a cycle
    # Pint takes every dimensionless unit for an angle: five percent is none.
    if si_unit == "rad" and one.to_root_units().units != registry.radian:
        return math.nan, f"{unit!r} is not an angle"
    return factor, ""


def _as_float(value: numbers.Real) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _json_bounds(bounds: Bounds) -> dict[str, float]:
    keywords = {
        "exclusiveMinimum": bounds.above,
        "minimum": bounds.at_least,
        "exclusiveMaximum": bounds.below,
        "maximum": bounds.at_most,
    }
    return {word: value for word, value in keywords.items() if value is not None}


@dataclass(frozen=True)
class Counts:
    """A whole number, or a list of whole numbers, between two limits, both included."""

    least: int
    most: int

    def parse(self, value: object) -> int | tuple[int, ...]:
        """Return the value, a list as a tuple, or raise the fault that names limit and remedy."""
        one = Count(self.least, self.most)
        if isinstance(value, list | tuple) and value:
            return tuple(one.parse(part) for part in value)
        return one.parse(value)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validate with `parse`."""
        return core_schema.no_info_plain_validator_function(self.parse)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: an integer or a list of them."""
        one = {"type": "integer", "minimum": self.least, "maximum": self.most}
        return {"anyOf": [one, {"type": "array", "items": one, "minItems": 1}]}


_POSITIVE = Bounds(above=0.0)
_NOT_NEGATIVE = Bounds(at_least=0.0)

ANGLE = Quantity("an angle", "rad", '30 or "0.5 rad"', bare="degrees")
DENSITY = Quantity("a density", "kg/m^3", '"1145 kg/m^3"', _POSITIVE)

Angle = Annotated[float, ANGLE]
Length = Annotated[float, Quantity("a length", "m", '"14 cm" or "1/16 in"', _POSITIVE)]
Distance = Annotated[float, Quantity("a length", "m", '"15 mm"', _NOT_NEGATIVE)]
Position = Annotated[float, Quantity("a length", "m", '"-7.9 mm"')]
Modulus = Annotated[float, Quantity("a pressure", "Pa", '"3 GPa"', _POSITIVE)]
Density = Annotated[float, DENSITY]
Mass = Annotated[float, Quantity("a mass", "kg", '"8.65 g"', _POSITIVE)]
MassPerSpan = Annotated[float, Quantity("a mass per span", "kg/m", '"35.7 kg/m"', _POSITIVE)]
InertiaPerSpan = Annotated[
    float, Quantity("a mass moment of inertia per span", "kg*m", '"8.64 kg*m"', _POSITIVE)
]
SectionStiffness = Annotated[
    float, Quantity("a section stiffness", "N*m^2", '"2e4 N*m^2"', _POSITIVE)
]
HingeStiffness = Annotated[
    float, Quantity("a rotational stiffness", "N*m/rad", '"0.18 N*m/rad"', _NOT_NEGATIVE)
]
ChordFraction = Annotated[
    float,
    Quantity(
        "a fraction of the chord from the leading edge", "", "0.5", Bounds(at_least=0, at_most=1)
    ),
]
PoissonsRatio = Annotated[float, Quantity("a number", "", "0.3", Bounds(above=-1, at_most=0.5))]
LiftSlope = Annotated[float, Quantity("a lift slope per radian", "", "6.283", _POSITIVE)]
DampingRatio = Annotated[
    float, Quantity("a damping ratio", "", "0.01", Bounds(at_least=0, below=1))
]
DampingThreshold = Annotated[
    float, Quantity("a damping ratio", "", "0.02", Bounds(above=-0.5, below=0.5))
]
WakeLength = Annotated[
    float, Quantity("a number of chords", "", "20", Bounds(above=0, at_most=1e4))
]
Relaxation = Annotated[float, Quantity("a factor", "", "0.99", Bounds(at_least=0, below=1))]
PitchInertia = Annotated[
    float, Quantity("a mass moment of inertia", "kg*m^2", '"22.7e-6 kg*m^2"', _POSITIVE)
]
LiftCoefficient = Annotated[float, Quantity("a lift coefficient", "", "1.2", _POSITIVE)]
TailArm = Annotated[
    float,
    Quantity(
        "a distance from the quarter chord of the wing aft to that of the tail",
        "m",
        '"25 cm"',
        _POSITIVE,
    ),
]
Airspeed = Annotated[
    float, Quantity("an airspeed", "m/s", '"54 m/s"', Bounds(at_least=1e-3, at_most=1e5))
]
Acceleration = Annotated[float, Quantity("an acceleration", "m/s^2", '"9.81 m/s^2"', _POSITIVE)]
SpanEfficiency = Annotated[float, Quantity("a span efficiency", "", "0.93", _POSITIVE)]
DragCoefficient = Annotated[float, Quantity("a drag coefficient", "", "0.035", Bounds(at_least=0))]
ForceDerivative = Annotated[float, Quantity("a force per velocity", "N*s/m", '"-150 N*s/m"')]
MomentDerivative = Annotated[
    float, Quantity("a moment per velocity, or a force per pitch rate", "N*s", '"-180 N*s"')
]
PitchDamping = Annotated[float, Quantity("a moment per pitch rate", "N*m*s", '"-5000 N*m*s"')]


@dataclass(frozen=True)
class Square:
    """A square matrix of finite numbers, written as a list of its rows."""

    size: int

    def parse(self, value: object) -> tuple[tuple[float, ...], ...]:
        """Return the rows, or raise the fault that names limit and remedy."""
        if not isinstance(value, list | tuple) or len(value) != self.size:
            raise self._fault((), value)
        return tuple(self._row(index, row) for index, row in enumerate(value))

    def _row(self, index: int, row: object) -> tuple[float, ...]:
        if not isinstance(row, list | tuple) or len(row) != self.size:
            raise self._fault((index,), row)
        return tuple(self._number(index, column, entry) for column, entry in enumerate(row))

    def _number(self, row: int, column: int, entry: object) -> float:
        if isinstance(entry, numbers.Real) and not isinstance(entry, bool):
            number = _as_float(entry)
            if math.isfinite(number):
                return number
        limit = "must be a number, finite"
        raise fault((row, column), shown(entry), limit, "Write a number without quotes.")

    def _fault(self, path: tuple[int, ...], value: object) -> Exception:
        what = "a row" if path else "a list of rows"
        limit = f"must be {what} of a matrix of {self.size} x {self.size} numbers"
        zeros = "[" + ", ".join("0" * self.size) + "]"
        remedy = f"Write {self.size} rows of {self.size} numbers: [{zeros}, ...]."
        return fault(path, shown(value), limit, remedy)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validate with `parse`."""
        return core_schema.no_info_plain_validator_function(self.parse)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a list of rows."""
        length = {"minItems": self.size, "maxItems": self.size}
        row = {"type": "array", "items": {"type": "number"}, **length}
        return {"type": "array", "items": row, **length}


StateMatrix = Annotated[tuple[tuple[float, ...], ...], Square(4)]
Frequency = Annotated[float, Quantity("a frequency", "Hz", '"8 Hz" or "50 rad/s"', _POSITIVE)]
PlungeStiffness = Annotated[
    float, Quantity("a stiffness per span", "N/m^2", '"2 kN/m^2"', _POSITIVE)
]
TorsionStiffness = Annotated[
    float, Quantity("a torsion stiffness per span", "N*m/rad/m", '"40 N*m/rad/m"', _POSITIVE)
]
Ratio = Annotated[float, Quantity("a ratio", "", "2.5", _POSITIVE)]
