"""The models and measurements shipped with the package."""

import tomllib
from dataclasses import dataclass
from importlib.resources import files

from foldwing.errors import InputError
from foldwing.model.record import suggest

_PACKAGE = "foldwing.examples"


@dataclass(frozen=True)
class ExampleInfo:
    """A shipped model.

    Attributes
    ----------
    name : str
        What `read_model` takes.
    title : str
        One line that says what it is.
    text : str
        The model file, with the source of its numbers in comments.
    """

    name: str
    title: str
    text: str


def list_examples() -> tuple[ExampleInfo, ...]:
    """Return the shipped models, in alphabetical order."""
    return tuple(_info(name) for name in example_names())


def example_names() -> tuple[str, ...]:
    """Return the names of the shipped models, in alphabetical order."""
    return _names(".toml")


def measurement_names() -> tuple[str, ...]:
    """Return the names of the shipped tables of measurements, in alphabetical order."""
    return _names(".csv")


def example_text(name: str) -> str:
    """Return the text of a shipped model or table of measurements.

    Parameters
    ----------
    name : str
        With or without the ending ``.toml`` or ``.csv``.

    Raises
    ------
    InputError
        When there is none of that name; it names the nearest.
    """
    known = (*example_names(), *measurement_names())
    stem = name.removesuffix(".toml").removesuffix(".csv")
    for ending in (".toml", ".csv"):
        if name in (stem, stem + ending) and stem in _names(ending):
            return files(_PACKAGE).joinpath(stem + ending).read_text(encoding="utf-8")
    limit = "must be the name of something shipped with foldwing"
    raise InputError("example", name, limit, suggest(name, known))


def _names(ending: str) -> tuple[str, ...]:
    entries = (entry.name for entry in files(_PACKAGE).iterdir())
    return tuple(sorted(name.removesuffix(ending) for name in entries if name.endswith(ending)))


def _info(name: str) -> ExampleInfo:
    text = example_text(name)
    return ExampleInfo(name, tomllib.loads(text).get("title", name), text)
