"""Reading a model from a TOML file, or from one of the examples shipped with the package."""

import re
import tomllib
from pathlib import Path

from foldwing.errors import InputError
from foldwing.model.faults import as_input_error
from foldwing.model.flight import FlightModel, resolved_flight
from foldwing.model.library import example_names, example_text
from foldwing.model.record import suggest
from foldwing.model.resolve import resolved, resolved_section
from foldwing.model.schema import ModelFile
from foldwing.model.section import TypicalSection
from foldwing.model.wing import Wing

_TOML_REMEDY = "Correct the file: each line is a [table], or key = value with text in quotes."
LONGEST_NAME = 400
"""Characters of a file name shown in a message."""

_START = "foldwing examples NAME --copy FILE gives a model to start from."


def read_model(source: str | Path) -> Wing:
    """Return the wing described by a TOML file or by a shipped example.

    Parameters
    ----------
    source : str or Path
        Path of a model file, or the name of a shipped example.

    Raises
    ------
    InputError
        When the model cannot be read or used; it names the field.
    """
    return parse_model(model_text(source), str(source), folder=folder_of(source))


def folder_of(source: str | Path) -> Path | None:
    """Return where the files that a model names are found; None beside a shipped example."""
    shipped = isinstance(source, str) and source in example_names()
    return None if shipped else Path(source).parent


def model_text(source: str | Path) -> str:
    """Return the text of a model file or shipped example, as `read_model` reads it."""
    if isinstance(source, str) and source in example_names():
        return example_text(source)
    path = Path(source)
    try:
        content = path.read_bytes() if path.is_file() else None
    except (OSError, ValueError) as error:
        limit = f"cannot be read ({getattr(error, 'strerror', None) or error})"
        raise InputError(
            "MODEL", _named(source), limit, "Check the name and permissions."
        ) from error
    if content is None:
        raise _no_such_model(path, source)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        limit = "must be a text file in UTF-8"
        remedy = f"Give a TOML file saved as UTF-8. {_START}"
        raise InputError("MODEL", _named(source), limit, remedy) from error


def parse_model(
    text: str,
    source: str = "MODEL",
    *,
    structure: str | None = None,
    folder: Path | None = None,
) -> Wing:
    """Return the wing described by TOML text.

    Parameters
    ----------
    text : str
        The model.
    source : str
        Name of the text for error messages.
    structure : str, optional
        "beam" or "plate" for every segment that does not import its modes, whatever the model says.
    folder : Path, optional
        Where the files that the model names are found; the current one by default.

    Raises
    ------
    InputError
        When the model cannot be used, or has no wing; it names the field.
    """
    model = parse_file(text, source)
    return resolved(model if structure is None else model.built_of(structure), folder)


def read_flight(source: str | Path) -> FlightModel:
    """Return the aircraft in longitudinal flight of a TOML file or of a shipped example.

    Parameters
    ----------
    source : str or Path
        Path of a model file, or the name of a shipped example.

    Raises
    ------
    InputError
        When the model cannot be read or used, or has no table [flight]; it names the field.
    """
    return parse_flight(model_text(source), str(source))


def parse_flight(text: str, source: str = "MODEL") -> FlightModel:
    """Return the aircraft in longitudinal flight described by TOML text.

    Parameters
    ----------
    text : str
        The model.
    source : str
        Name of the text for error messages.

    Raises
    ------
    InputError
        When the model cannot be used, or has no table [flight]; it names the field.
    """
    model = parse_file(text, source)
    if model.flight is None:
        raise model.missing("flight")
    return resolved_flight(model.flight, model.title, model.air)


def read_section(source: str | Path) -> TypicalSection:
    """Return the typical section described by a TOML file or by a shipped example.

    Parameters
    ----------
    source : str or Path
        Path of a model file, or the name of a shipped example.

    Raises
    ------
    InputError
        When the model cannot be read or used, or has no section; it names the field.
    """
    return parse_section(model_text(source), str(source))


def parse_section(text: str, source: str = "MODEL") -> TypicalSection:
    """Return the typical section described by TOML text, as `parse_model` does a wing."""
    return resolved_section(parse_file(text, source))


def parse_file(text: str, source: str = "MODEL") -> ModelFile:
    """Return the tables of a model file as they are written, each checked by itself.

    Parameters
    ----------
    text : str
        The model.
    source : str
        Name of the text for error messages.

    Raises
    ------
    InputError
        When the text is no model file; it names the field.
    """
    if not text.strip():
        raise InputError(source, "an empty text", "must describe a model in TOML", _START)
    try:
        content = tomllib.loads(text)
    except RecursionError as error:
        limit = "must be valid TOML: nested too deeply"
        raise InputError(source, "brackets in brackets", limit, _TOML_REMEDY) from error
    except ValueError as error:
        # tomllib lets the ValueError of an overlong integer or impossible date through.
        limit = f"must be valid TOML: {error}"
        raise InputError(source, _line_of(str(error), text), limit, _TOML_REMEDY) from error
    with as_input_error():
        return ModelFile.model_validate(content)


def _line_of(message: str, text: str) -> str:
    """Return the line that a TOML error message points at."""
    where = re.search(r"at line (\d+)", message)
    lines = text.splitlines()
    number = int(where.group(1)) if where else len(lines)
    return lines[min(number, len(lines)) - 1].strip()[:80]


def _no_such_model(path: Path, source: str | Path) -> InputError:
    if path.is_dir():
        limit, remedy = "must be a file, and this is a folder", "Name the TOML file inside it."
    elif path.exists():
        limit, remedy = "must be a regular file", f"Give a TOML file. {_START}"
    else:
        limit = "must be a TOML file or the name of a shipped example"
        remedy = suggest(source, example_names())
    return InputError("MODEL", _named(source), limit, remedy)


def _named(source: str | Path) -> str:
    """Return a file name in full, unless it is longer than any path may be."""
    name = str(source)
    return name if len(name) <= LONGEST_NAME else f"{name[:LONGEST_NAME]}..."
