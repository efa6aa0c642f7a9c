"""How a fault in a model is worded: where, what was given, the limit and the remedy.

Validators raise `fault(...)`. Users of the Python constructors meet it inside pydantic's
ValidationError; whoever reads a model file meets the same words as an `InputError`.
"""

import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from pydantic import ValidationError
from pydantic_core import PydanticCustomError

from foldwing.errors import InputError

Path = tuple[str | int, ...]
"""Where a value stands: keys, and positions counted from 0."""

LONGEST_SHOWN = 80
"""Characters of a value that a message repeats."""

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+\Z")

_SHAPES = {
    "model_type": ("must be a table", "Write it as a table of keys and values."),
    "dict_type": ("must be a table", "Write it as a table of keys and values."),
    "tuple_type": ("must be a list", "Write one entry for each, as in [[wing.segment]]."),
    "string_type": ("must be text", "Put it in quotes."),
    "bool_type": ("must be true or false", "Write true, without quotes."),
}


def fault(path: Path, value: object, limit: str, remedy: str) -> PydanticCustomError:
    """Return the error a validator raises for a value that cannot be used.

    Parameters
    ----------
    path : tuple
        Where the value stands below the object that is being validated; empty for the object.
    value : object
        The value as it was given; None when it is missing.
    limit : str
        What the field accepts.
    remedy : str
        What to do about it.
    """
    context: dict[str, Any] = {"path": path, "value": value, "limit": limit, "remedy": remedy}
    if not path:
        return PydanticCustomError("fault", "{limit}. {remedy}", context)
    context["where"] = python_path(path)
    return PydanticCustomError("fault", "{where}: {limit}. {remedy}", context)


def python_path(path: Path) -> str:
    """Return a path as a Python user writes it, ``hinges[0].spacing``."""
    return _joined(path, first=0)


def file_path(path: Path) -> str:
    """Return a path in the words of the model file, counted from 1: ``wing.segment[2].span``."""
    return _joined(path, first=1)


def input_error(
    error: ValidationError,
    prefix: Path = (),
    place: Callable[[Path], Path] = lambda path: path,
) -> InputError:
    """Return the first fault of a ValidationError as an InputError.

    Parameters
    ----------
    error : ValidationError
        What pydantic raised.
    prefix : tuple
        Where the validated object stands in the file.
    place : callable
        Turns the path of an attribute of the validated object into a path in the file.
    """
    faults = error.errors(include_url=False)
    first = faults[0]
    context = first.get("ctx", {})
    if first["type"] == "fault":
        path, value = (*first["loc"], *context["path"]), context["value"]
        limit, remedy = context["limit"], context["remedy"]
    else:
        path, value = first["loc"], first["input"]
        limit, remedy = _plain_fault(first["type"], first["msg"], context)
    if len(faults) > 1:
        remedy += f" ({len(faults) - 1} more to mend in this model.)"
    return InputError(file_path((*prefix, *place(path))), shown(value), limit, remedy)


@contextmanager
def as_input_error(
    prefix: Path = (), place: Callable[[Path], Path] = lambda path: path
) -> Iterator[None]:
    """Turn a ValidationError raised inside the block into an InputError, see `input_error`."""
    try:
        yield
    except ValidationError as error:
        raise input_error(error, prefix, place) from error


def shown(value: object) -> object:
    """Return a value in a form that is short enough, and safe, to repeat in a message."""
    if isinstance(value, int) and abs(value) >= 10**LONGEST_SHOWN:
        return math.inf if value > 0 else -math.inf
    if value is None or isinstance(value, bool | int | float):
        return value
    text = value if isinstance(value, str) else _kind_of(value)
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 3] + "..."


def _kind_of(value: object) -> str:
    if isinstance(value, dict):
        return f"a table of {len(value)} keys"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    return str(value)


def _plain_fault(kind: str, message: str, context: dict[str, Any]) -> tuple[str, str]:
    """Return limit and remedy of a fault that pydantic found by itself."""
    if kind == "literal_error":
        return f"must be {context['expected']}", "Choose one of these."
    return _SHAPES.get(kind, (message, "Correct this value."))


def _joined(path: Path, first: int) -> str:
    text = ""
    for key in path:
        if isinstance(key, int):
            text += f"[{key + first}]"
        else:
            name = key if _BARE_KEY.match(key) else f'"{shown(key)}"'
            text += f".{name}" if text else name
    return text
