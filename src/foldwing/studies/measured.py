"""Measured points, to lay over a picture."""

import contextlib
import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model import example_text, measurement_names
from foldwing.studies.grid import swept_hinge

OFF_THE_WAY = 1.0
"""Degrees between a measured fold angle and that of the sweep that are too many."""

REMEDY = (
    "Write a CSV file whose header has fold_2 (and fold_3 ...) in degrees and speed in m/s, "
    "frequency in Hz, or both."
)


@dataclass(frozen=True)
class Measured:
    """Columns of a table of measured points; nan where a value is missing.

    Attributes
    ----------
    columns : dict of str to array, shape (m,)
        ``fold_2`` ... in degrees, ``speed`` in m/s, ``frequency`` in Hz.
    source : str
        Name of the file.
    """

    columns: dict[str, Real]
    source: str

    def variables(self, hinge: int | None) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return dataset variables and coordinates, against the angle of ``hinge`` (from 2).

        Raises
        ------
        InputError
            When the table has no column for that hinge.
        """
        name = f"fold_{hinge or 2}"
        if name not in self.columns:
            limit = f"must have a column {name}, the angle that is swept"
            raise InputError("--measured", self.source, limit, REMEDY)
        fold, count = self.columns[name], len(self.columns[name])
        missing = np.full(count, np.nan)
        dims = ("measured",)
        variables = {
            "measured_fold": (dims, fold),
            "measured_speed": (dims, self.columns.get("speed", missing)),
            "measured_frequency": (dims, self.columns.get("frequency", missing)),
        }
        return variables, {"measured": (dims, np.arange(count))}

    def check_cases(self, cases: Sequence[tuple[float, ...]]) -> None:
        """Raise `InputError` unless every point lies on the way of a sweep of fold angles."""
        hinge = swept_hinge(cases)
        if hinge is None:
            limit = "needs a sweep of fold angles to lie over"
            remedy = "Add a range, such as --fold2 0:150:2.5."
            raise InputError("--measured", self.source, limit, remedy)
        self.variables(hinge)
        way = np.array(sorted(cases, key=lambda case: case[hinge - 2]))
        for other in range(2, way.shape[1] + 2):
            name = f"fold_{other}"
            if name not in self.columns or len(np.unique(way[:, hinge - 2])) < len(way):
                continue
            fold = self.columns[f"fold_{hinge}"]
            expected = np.interp(fold, way[:, hinge - 2], way[:, other - 2])
            inside = (fold >= way[0, hinge - 2]) & (fold <= way[-1, hinge - 2])
            off = np.abs(self.columns[name] - expected) > OFF_THE_WAY
            if (inside & off).any():
                row = int(np.flatnonzero(inside & off)[0])
                limit = f"{name} = {self.columns[name][row]:g} deg is not on the way of the sweep"
                remedy = "Leave out points of other fold angles, or sweep theirs."
                raise InputError("--measured", self.source, limit, remedy)


def read_measured(source: str) -> Measured:
    """Read measured points from a CSV file, or from a table shipped with the package.

    Raises
    ------
    InputError
        When the file cannot be read or has not the right columns.
    """
    lines = _lines(_text(source))
    if len(lines) < 2:
        raise InputError("--measured", source, "must have a header and a row", REMEDY)
    header = [name.strip() for name in lines[0][1]]
    if not any(name in header for name in ("speed", "frequency")):
        raise InputError("--measured", source, "must have a column speed or frequency", REMEDY)
    if len(set(header)) < len(header):
        raise InputError("--measured", source, "must not name a column twice", REMEDY)
    columns: dict[str, list[float]] = {name: [] for name in header}
    for number, values in lines[1:]:
        if len(values) != len(header):
            limit = f"line {number} must have {len(header)} values"
            raise InputError("--measured", source, limit, REMEDY)
        for name, text in zip(header, values, strict=True):
            columns[name].append(_number(text, name, number, source))
    return Measured({name: np.array(values) for name, values in columns.items()}, source)


def _lines(text: str) -> list[tuple[int, list[str]]]:
    """Return number and fields of every line that is neither blank nor a comment."""
    return [
        (number, next(csv.reader([line])))
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]


def _text(source: str) -> str:
    if source in measurement_names():
        return example_text(source)
    try:
        return Path(source).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", None) or "not UTF-8 text"
        limit = f"must be a CSV file that can be read ({reason})"
        known = ", ".join(measurement_names())
        raise InputError("--measured", source, limit, f"{REMEDY} Shipped: {known}.") from None


def _number(text: str, name: str, line: int, source: str) -> float:
    if not text.strip():
        return math.nan
    with contextlib.suppress(ValueError):
        if math.isfinite(value := float(text)):
            return value
    limit = f"line {line}, column {name}: {text.strip()!r} is not a finite number"
    raise InputError("--measured", source, limit, REMEDY)
