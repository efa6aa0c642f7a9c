"""Nastran punch files of real modes, sorted by mode (SORT1).

Every line has 80 columns: a number in 1-10, the letter of the kind of point in 18, three numbers in
19-36, 37-54 and 55-72, and the count of lines in 73-80. ``-CONT-`` begins a line with the rotations
of the point before it. What concerns all points of a mode stands before them after a dollar sign.
"""

import math
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from foldwing.errors import InputError
from foldwing.structure.mode_files.nastran import joined, negative_eigenvalues, read_bulk
from foldwing.structure.mode_files.raw import RawModes

_EIGENVALUE = re.compile(r"\$EIGENVALUE\s*=\s*(\S+)(?:\s+MODE\s*=\s*(\d+))?")
_FIELDS = ((18, 36), (36, 54), (54, 72))
_LEFT_OUT = {"S": "scalar points", "M": "modal points"}
_EXPORT = "Ask for VECTOR(SORT1,REAL,PUNCH) = ALL in the case control."


@dataclass
class _Shape:
    """One mode as it is read: where it begins, its eigenvalue, and displacements by grid."""

    line: int
    eigenvalue: float
    rows: dict[int, tuple[float, ...]] = field(default_factory=dict)


def read_punch(path: Path, geometry: Path | None) -> RawModes:
    """Read modes from a punch file and positions from the bulk data file ``geometry``.

    Modal masses do not stand in such a file.

    Raises
    ------
    InputError
        When either file is missing, cut short or not of that kind.
    """
    if geometry is None:
        limit = "a punch file holds no positions of the grid points"
        remedy = "Name the bulk data file (.bdf, .dat) with its GRID cards as geometry."
        raise InputError(f"{path}: geometry", None, limit, remedy)
    shapes, left_out = _shapes(path)
    if not shapes:
        limit = "must hold eigenvectors after lines $EIGENVALUE = ..."
        raise InputError(str(path), "no eigenvector", limit, _EXPORT)
    grids = read_bulk(geometry)
    names, points, table = joined(path, grids, [shape.rows for shape in shapes])
    eigenvalues = np.array([shape.eigenvalue for shape in shapes])
    unknown = np.full(len(shapes), np.nan)
    notes = tuple(f"{count} {_LEFT_OUT[kind]} are left out" for kind, count in left_out.items())
    return RawModes(
        frequencies=np.sqrt(np.abs(eigenvalues)) / (2.0 * math.pi),
        damping=unknown,
        modal_mass=unknown,
        names=names,
        points=points,
        shapes=table,
        notes=notes + negative_eigenvalues(eigenvalues),
    )


def _shapes(path: Path) -> tuple[list[_Shape], dict[str, int]]:
    shapes: list[_Shape] = []
    left_out: dict[str, set[int]] = {}
    wanted, after_point = False, False
    with path.open(encoding="latin-1") as file:
        for number, line in enumerate(file, 1):
            text = line.rstrip("\r\n")
            if text.startswith("$"):
                wanted = _heading(path, number, text, shapes, wanted)
                after_point = False
            elif not wanted or not text.strip():
                continue
            elif text.startswith("-CONT-"):
                if not after_point:
                    raise _damaged(path, number, text, "must follow the line of a point")
                _numbers(path, number, text)
                after_point = False
            else:
                after_point = _point(path, number, text, shapes[-1], left_out)
    return shapes, {kind: len(points) for kind, points in left_out.items()}


def _heading(path: Path, number: int, text: str, shapes: list[_Shape], wanted: bool) -> bool:
    """Take a line after a dollar sign; return whether the lines that follow hold a mode."""
    match = _EIGENVALUE.match(text)
    if match:
        eigenvalue = _float(match[1])
        if not math.isfinite(eigenvalue):
            raise _damaged(path, number, text, "must state a finite eigenvalue")
        shapes.append(_Shape(number, eigenvalue))
        return True
    if "SORT2" in text or "MAGNITUDE-PHASE" in text or "$COMPLEX" in text:
        raise _damaged(path, number, text, "must be real modes sorted by mode")
    return wanted and text.startswith(("$SUBCASE", "$LABEL", "$TITLE", "$SUBTITLE"))


def _point(
    path: Path, number: int, text: str, shape: _Shape, left_out: dict[str, set[int]]
) -> bool:
    kind = text[10:18].strip()
    try:
        grid = int(text[:10])
    except ValueError:
        raise _damaged(path, number, text, "must begin with the number of a point") from None
    if kind in _LEFT_OUT:
        left_out.setdefault(kind, set()).add(grid)
        return True
    if kind != "G":
        raise _damaged(path, number, text, "must have a G for a grid point in column 18")
    if grid in shape.rows:
        raise _damaged(path, number, text, "every point must stand once in a mode")
    shape.rows[grid] = _numbers(path, number, text)
    return True


def _numbers(path: Path, number: int, text: str) -> tuple[float, ...]:
    values = tuple(_float(text[start:end]) for start, end in _FIELDS)
    if all(map(math.isfinite, values)):
        return values
    raise _damaged(path, number, text, "must have three finite numbers in columns 19 to 72")


def _float(text: str) -> float:
    try:
        return float(text.replace("D", "E"))
    except ValueError:
        return math.nan


def _damaged(path: Path, number: int, text: str, limit: str) -> InputError:
    return InputError(f"{path}:{number}", text[:72].strip(), limit, _EXPORT)
