"""Annotated types of quantities that stand in lists: points, tables of thickness, positions."""

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from foldwing.model.faults import fault, shown
from foldwing.model.quantities import Bounds, Quantity

MOST_VALUES = 1000
"""Values that a list may hold."""


@dataclass(frozen=True)
class _Listed:
    """What lists of one quantity have in common.

    Attributes
    ----------
    one : Quantity
        What every value is.
    """

    one: Quantity

    def parse(self, value: object) -> object:
        """Return the values in SI units, or raise the fault that names limit and remedy."""
        raise NotImplementedError

    def _number(self, path: tuple[int, ...], value: object) -> float:
        try:
            return self.one.parse(value)
        except PydanticCustomError as error:
            context = error.context or {}
            raise fault(path, context["value"], context["limit"], context["remedy"]) from None

    def _row(self, path: tuple[int, ...], value: object, limit: str, remedy: str) -> list[Any]:
        if not isinstance(value, list | tuple) or not 0 < len(value) <= MOST_VALUES:
            raise fault(path, shown(value), limit, remedy)
        return list(value)

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Validate with `parse`."""
        return core_schema.no_info_plain_validator_function(self.parse)

    def _schema_of_one(self, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return self.one.__get_pydantic_json_schema__(core_schema.any_schema(), handler)


class OnePoint(_Listed):
    """A point in a plane: two quantities."""

    def parse(self, value: object) -> tuple[float, float]:
        """Return x and y in SI units."""
        limit, remedy = "must be a point [x, y]", 'Write for example ["-2 cm", "14 cm"].'
        row = self._row((), value, limit, remedy)
        if len(row) != 2:
            raise fault((), shown(value), limit, remedy)
        x, y = (self._number((i,), entry) for i, entry in enumerate(row))
        return x, y

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a list of two."""
        one = self._schema_of_one(handler)
        return {"type": "array", "items": one, "minItems": 2, "maxItems": 2}


class OneVector(_Listed):
    """Three plain numbers or lengths."""

    def parse(self, value: object) -> tuple[float, float, float]:
        """Return the three components."""
        limit, remedy = "must be a list of three numbers", "Write for example [0, 0, 1]."
        row = self._row((), value, limit, remedy)
        if len(row) != 3:
            raise fault((), shown(value), limit, remedy)
        x, y, z = (self._number((i,), entry) for i, entry in enumerate(row))
        return x, y, z

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a list of three."""
        one = self._schema_of_one(handler)
        return {"type": "array", "items": one, "minItems": 3, "maxItems": 3}


class Values(_Listed):
    """A list of quantities, none of them twice."""

    def parse(self, value: object) -> tuple[float, ...]:
        """Return the values in SI units."""
        limit = (
            f"must be a list of 1 to {MOST_VALUES}, each {self.one.limit.removeprefix('must be ')}"
        )
        row = self._row((), value, limit, f"Write for example [{self.one.example}].")
        values = tuple(self._number((i,), entry) for i, entry in enumerate(row))
        for index, number in enumerate(values):
            if number in values[:index]:
                raise fault((index,), shown(row[index]), "must not stand twice", "Leave one out.")
        return values

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a list."""
        return {"type": "array", "items": self._schema_of_one(handler), "minItems": 1}


class Table(_Listed):
    """One quantity, a list along the span, or a list of rows along the chord."""

    def parse(self, value: object) -> tuple[tuple[float, ...], ...]:
        """Return the rows in SI units."""
        if not isinstance(value, list | tuple):
            return ((self._number((), value),),)
        limit = "must be a value, a list along the span, or a list of rows along the chord"
        remedy = f"Write {self.one.example}, [inboard, outboard], or [[front, rear], ...]."
        rows = self._row((), value, limit, remedy)
        if not isinstance(rows[0], list | tuple):
            return tuple((self._number((i,), entry),) for i, entry in enumerate(rows))
        table = []
        for i, entry in enumerate(rows):
            row = self._row((i,), entry, f"must be a row of {len(rows[0])} values", remedy)
            if len(row) != len(rows[0]):
                raise fault((i,), shown(entry), f"must have {len(rows[0])} values", remedy)
            table.append(tuple(self._number((i, j), each) for j, each in enumerate(row)))
        return tuple(table)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return the JSON schema: a value, a list or a list of lists."""
        one = self._schema_of_one(handler)
        row = {"type": "array", "items": one, "minItems": 1}
        return {"anyOf": [one, row, {"type": "array", "items": row, "minItems": 1}]}


_LENGTH = Quantity("a length", "m", '"-7.9 mm"')
_THICKNESS = Quantity("a length", "m", '"1.6 mm" or "1/16 in"', Bounds(above=0.0))

Point = Annotated[tuple[float, float], OnePoint(_LENGTH)]
Vector = Annotated[tuple[float, float, float], OneVector(Quantity("a number", "", "1"))]
Positions = Annotated[tuple[float, ...], Values(_LENGTH)]
Thickness = Annotated[tuple[tuple[float, ...], ...], Table(_THICKNESS)]
