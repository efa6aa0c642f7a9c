"""The base of everything a model is made of: frozen, and strict about its keys."""

from collections.abc import Collection, Mapping
from difflib import get_close_matches
from typing import Any

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic.fields import FieldInfo

from foldwing.model.faults import fault, shown
from foldwing.model.quantities import Quantity


def _for_editors(schema: dict[str, Any]) -> None:
    """Keep out of the JSON schema what a model file cannot say: null, tables of attributes."""
    if "description" in schema:
        schema["description"] = schema["description"].split("\n\n")[0]
    for field in schema.get("properties", {}).values():
        options = field.get("anyOf", [])
        if {"type": "null"} in options:
            rest = [option for option in options if option != {"type": "null"}]
            del field["anyOf"], field["default"]
            field.update(rest[0] if len(rest) == 1 else {"anyOf": rest})


class Record(BaseModel):
    """A frozen set of validated values; unknown and missing keys are errors with a suggestion."""

    model_config = ConfigDict(frozen=True, extra="forbid", json_schema_extra=_for_editors)

    @model_validator(mode="before")
    @classmethod
    def _check_keys(cls, data: Any) -> Any:
        if not isinstance(data, Mapping):
            return data
        known = cls.model_fields
        for key, value in data.items():
            if key not in known:
                raise fault((str(key),), shown(value), "is not a known key", suggest(key, known))
        for key, field in known.items():
            if field.is_required() and key not in data:
                raise fault((key,), None, _limit(field), _how_to_add(key, field))
        return data


def suggest(word: object, known: Collection[str]) -> str:
    """Return a remedy that names the known word nearest to an unknown one, and all of them."""
    nearest = get_close_matches(str(word), known, n=1, cutoff=0.5)
    question = f"Did you mean {nearest[0]}? " if nearest else ""
    return f"{question}Known here: {', '.join(known) or 'none'}."


def _quantity(field: FieldInfo) -> Quantity | None:
    return next((mark for mark in field.metadata if isinstance(mark, Quantity)), None)


def _limit(field: FieldInfo) -> str:
    quantity = _quantity(field)
    return quantity.limit if quantity else "is required"


def _how_to_add(key: str, field: FieldInfo) -> str:
    quantity = _quantity(field)
    return f"Add {key}, for example {quantity.example}." if quantity else f"Add {key}."
