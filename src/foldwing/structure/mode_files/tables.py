"""CSV files of modes: three tables in one text, written by hand or by a spreadsheet.

A table begins with the names of its columns. ``point,x,y,z`` lists the points,
``mode,frequency_hz,modal_mass,damping`` the modes and ``mode,point,ux,uy,uz`` the shapes. Lines
that begin with ``#`` are comments; ``# length_unit: mm`` and ``# mass_unit: g`` among them count.
"""

import csv
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Real
from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.raw import RawModes, unit_of

AXES = ("x", "y", "z")
_COLUMNS = {
    "points": ("point", *AXES),
    "modes": ("mode", "frequency_hz", "modal_mass", "damping", "phase_scatter_deg"),
    "shapes": ("mode", "point", "ux", "uy", "uz", "ux_im", "uy_im", "uz_im"),
}
_NEEDED = {
    "points": ("point", "x", "y"),
    "modes": ("mode", "frequency_hz"),
    "shapes": ("mode", "point"),
}
_KEYS = {"points": 1, "modes": 1, "shapes": 2}
_EMPTY = {"modal_mass": math.nan, "damping": math.nan}
_UNIT = re.compile(r"#\W*(length|mass)_unit\s*[:=]\s*([^,;\t]*)")
_FORM = (
    "Write a line of column names above each of the three tables: point,x,y,z then "
    "mode,frequency_hz,modal_mass,damping then mode,point,ux,uy,uz."
)


@dataclass
class _Tables:
    """What has been read so far: numbers by column for each key of each table."""

    path: Path
    rows: dict[str, dict[tuple[str, ...], dict[str, float]]] = field(default_factory=dict)
    units: dict[str, float] = field(default_factory=dict)

    def note_unit(self, line: int, text: str) -> None:
        """Take the unit that a comment states, if it does."""
        match = _UNIT.match(text)
        if match:
            kind = match[1]
            self.units[kind] = unit_of(kind, match[2], f"{self.path}:{line}: {kind}_unit")

    def add(self, line: int, kind: str, columns: list[str], cells: list[str]) -> None:
        """Take one line of a table."""
        if len(cells) > len(columns):
            limit = f"must be at most {len(columns)}, the columns of {kind}"
            remedy = "Separate the numbers by commas, with a point as decimal mark."
            raise InputError(f"{self.path}:{line}: cells", len(cells), limit, remedy)
        cells = [cell.strip() for cell in cells] + [""] * (len(columns) - len(cells))
        given = dict(zip(columns, cells, strict=True))
        keys = _COLUMNS[kind][: _KEYS[kind]]
        key = tuple(given.pop(name) for name in keys)
        for name, word in zip(keys, key, strict=True):
            if not word:
                limit = "is needed in every line of the table"
                raise InputError(f"{self.path}:{line}: {name}", None, limit, _FORM)
        table = self.rows[kind]
        if key in table:
            what = " at ".join(f"{n} {word}" for n, word in zip(keys, key, strict=True))
            limit = f"must stand once in the table of {kind}"
            raise InputError(f"{self.path}:{line}", what, limit, "Remove one of the lines.")
        table[key] = {name: self._number(line, name, text) for name, text in given.items()}

    def _number(self, line: int, name: str, text: str) -> float:
        if not text and (name in _EMPTY or name.startswith("u") or name == "phase_scatter_deg"):
            return _EMPTY.get(name, 0.0)
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        unknown = name in _EMPTY and text.lower() == "nan"
        if math.isfinite(value) or unknown:
            return value
        limit = "must be a finite number"
        remedy = "Write it with a point as decimal mark, for example 0.25 or 2.5e-3."
        raise InputError(f"{self.path}:{line}: {name}", text or None, limit, remedy)


def read_tables(path: Path) -> RawModes:
    """Read a CSV file.

    Raises
    ------
    InputError
        With file, line and column of whatever is wrong.
    """
    tables, kind, columns, separator = _Tables(path), "", [""], ","
    for line, text in _lines(path):
        if text.startswith(("#", '"#')):
            tables.note_unit(line, text.strip('"'))
            continue
        begun = _heading(text)
        if begun:
            separator, columns = begun
            kind = _kind(path, line, columns)
            if kind in tables.rows:
                limit = f"the table of {kind} must stand once"
                raise InputError(f"{path}:{line}", text[:60], limit, "Join the two tables.")
            tables.rows[kind] = {}
        elif not kind:
            limit = "must begin with the names of the columns of a table"
            raise InputError(f"{path}:{line}", text[:60], limit, _FORM)
        else:
            tables.add(line, kind, columns, _cells(path, line, text, separator))
    return _raw(path, tables)


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    try:
        content = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        limit = "must be text, UTF-8, or one of the other formats of modes"
        raise InputError(str(path), "binary data", limit, "Export the modes anew.") from error
    for line, text in enumerate(content.splitlines(), 1):
        if text.strip(" \t,;"):
            yield line, text.strip()


def _cells(path: Path, line: int, text: str, separator: str) -> list[str]:
    try:
        cells = next(csv.reader([text], delimiter=separator, strict=True))
    except csv.Error as error:
        limit = f"must be cells separated by {separator!r}"
        raise InputError(f"{path}:{line}", text[:60], limit, "Close every quotation.") from error
    while cells and not cells[-1].strip():  # spreadsheets fill up lines with empty cells
        cells.pop()
    return cells


def _heading(text: str) -> tuple[str, list[str]] | None:
    """Return separator and names of columns of a line that begins a table."""
    for separator in (",", ";", "\t"):
        words = [word.strip().strip('"').strip().lower() for word in text.split(separator)]
        if len(words) > 1 and words[0] in ("point", "mode") and words[1][:1].isalpha():
            known = {name for names in _COLUMNS.values() for name in names}
            if any(word in known for word in words[1:]):
                while not words[-1]:
                    words.pop()
                return separator, words
    return None


def _kind(path: Path, line: int, columns: list[str]) -> str:
    kind = "points" if columns[0] == "point" else "shapes" if "point" in columns else "modes"
    for name in columns:
        if name not in _COLUMNS[kind] or columns.count(name) > 1:
            limit = f"must be different columns of {kind}: {', '.join(_COLUMNS[kind])}"
            raise InputError(f"{path}:{line}: column", name, limit, _FORM)
    for name in _NEEDED[kind]:
        if name not in columns:
            limit = f"is a needed column of {kind}"
            raise InputError(f"{path}:{line}: {name}", None, limit, _FORM)
    return kind


def _raw(path: Path, tables: _Tables) -> RawModes:
    for kind in _COLUMNS:
        if not tables.rows.get(kind):
            limit = f"the table of {kind} must be there, with at least one line"
            raise InputError(f"{path}: {kind}", None, limit, _FORM)
    points, modes, shapes = (tables.rows[kind] for kind in ("points", "modes", "shapes"))
    for mode, point in shapes:
        for known, name, what in ((modes, mode, "mode"), (points, point, "point")):
            if (name,) not in known:
                limit = f"must be a {what} of the table of {what}s"
                remedy = f"Add it there or remove its lines (mode {mode}, point {point})."
                raise InputError(f"{path}: shapes: {what}", name, limit, remedy)
    wanted = [(mode, point) for (mode,) in modes for (point,) in points]
    missing = [key for key in wanted if key not in shapes]
    if missing:
        mode, point = missing[0]
        limit = "every mode needs a line for every point"
        if len(missing) > 1:
            limit += f"; {len(missing)} of {len(wanted)} are missing"
        remedy = "Add the lines, with 0 where a point rests, or remove the point."
        raise InputError(f"{path}: shapes: mode {mode}, point {point}", None, limit, remedy)
    return RawModes(
        frequencies=_column(modes, "frequency_hz"),
        damping=_column(modes, "damping", math.nan),
        modal_mass=_column(modes, "modal_mass", math.nan),
        names=tuple(name for (name,) in points),
        points=np.column_stack([_column(points, axis) for axis in AXES]),
        shapes=_displacements([shapes[key] for key in wanted], len(modes)),
        length_unit=tables.units.get("length"),
        mass_unit=tables.units.get("mass"),
        complexity=_column(modes, "phase_scatter_deg"),
    )


def _column(table: dict[tuple[str, ...], dict[str, float]], name: str, empty: float = 0.0) -> Real:
    return np.array([row.get(name, empty) for row in table.values()])


def _displacements(rows: list[dict[str, float]], modes: int) -> Real | Complex:
    real, imaginary = (
        np.array([[row.get(f"u{axis}{part}", 0.0) for axis in AXES] for row in rows])
        for part in ("", "_im")
    )
    u = real + 1j * imaginary if imaginary.any() else real
    return u.reshape(modes, -1, 3)


def write_tables(modes: ModeSet, path: Path) -> None:
    """Write a CSV file with numbers of 17 digits, from which they are read back exactly."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        file.write("# modes of a structure; frequencies in Hz, damping as a ratio\n")
        file.write("# length_unit: m\n# mass_unit: kg\n")
        writer.writerow(_COLUMNS["points"])
        for name, point in zip(modes.names, modes.points, strict=True):
            writer.writerow([name, *map(_digits, point)])
        writer.writerow(_COLUMNS["modes"])
        rows = (modes.frequencies, modes.modal_mass, modes.damping, modes.complexity)
        for mode, row in enumerate(zip(*rows, strict=True), 1):
            writer.writerow([mode, *map(_digits, row)])
        writer.writerow(_COLUMNS["shapes"][:5])
        for mode, shape in enumerate(modes.shapes, 1):
            for name, u in zip(modes.names, shape, strict=True):
                writer.writerow([mode, name, *map(_digits, u)])


def _digits(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.17g}"
