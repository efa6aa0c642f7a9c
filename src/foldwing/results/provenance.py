"""Where a result comes from: the attributes that let anyone compute it again."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from importlib import metadata
from typing import Any


@dataclass(frozen=True)
class Source:
    """What a run was asked for, kept with its result.

    Attributes
    ----------
    model_text : str
        The model as the user wrote it.
    options : mapping
        Options of the run.
    """

    model_text: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)


NO_SOURCE = Source()
"""Of a run that was not started from a model file."""


def package_version() -> str:
    """Return the version of the installed package, ``unknown`` in a bare source tree."""
    try:
        return metadata.version("foldwing")
    except metadata.PackageNotFoundError:
        return "unknown"


def model_hash(model_text: str) -> str:
    """Return the SHA-256 of the model text, 64 hexadecimal digits."""
    return hashlib.sha256(model_text.encode()).hexdigest()


def provenance(
    title: str,
    kind: str,
    model_text: str,
    method: str,
    options: Mapping[str, Any],
    *,
    created: datetime | None = None,
) -> dict[str, str]:
    """Return the attributes that every dataset carries.

    Parameters
    ----------
    title : str
        Title of the model.
    kind : str
        ``modes``, ``flutter``, ``boundary``, ``convergence``, ``steady``, ``aircraft``,
        ``flight`` or ``section``.
    model_text : str
        The model file as it was read.
    method : str
        One line on how the numbers were computed.
    options : mapping
        The options of the run, stored as JSON text.
    created : datetime, optional
        Now by default.
    """
    moment = created or datetime.now(UTC)
    return {
        "title": title,
        "kind": kind,
        "foldwing_version": package_version(),
        "model_text": model_text,
        "model_hash": model_hash(model_text),
        "method": method,
        "options": json.dumps(options, sort_keys=True, default=str),
        "created": moment.isoformat(timespec="seconds"),
    }
