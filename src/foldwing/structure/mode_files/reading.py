"""Modes from a file of any kind that is known."""

from pathlib import Path

from foldwing.errors import InputError
from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.nastran import read_op2
from foldwing.structure.mode_files.netcdf import read_netcdf
from foldwing.structure.mode_files.punch import read_punch
from foldwing.structure.mode_files.raw import RawModes, Wishes, finished
from foldwing.structure.mode_files.tables import read_tables
from foldwing.structure.mode_files.universal import read_universal

LARGEST_FILE = 500_000_000
"""Bytes of a file."""

_HDF5 = b"\x89HDF\r\n\x1a\n"
_KINDS = "CSV, netCDF-4, universal file, Nastran punch (.pch) or OP2 (.op2)"
_HEAD = 4096


def read_modes(
    path: str | Path,
    *,
    geometry: str | Path | None = None,
    length_unit: float | None = None,
    mass_unit: float | None = None,
    modal_mass: float | None = None,
    count: int | None = None,
) -> ModeSet:
    """Read the modes of a structure: CSV, netCDF-4, universal file, Nastran punch or OP2.

    The content tells which it is. What the user says goes before what the file says.

    Parameters
    ----------
    path : str or Path
    geometry : str or Path, optional
        Bulk data file with the grid points of a punch file, which has none.
    length_unit : float, optional
        Unit of length of the file in m: 1e-3 for mm, 0.0254 for inches. 1 when neither the file nor
        the user says anything.
    mass_unit : float, optional
        Unit of mass of the file in kg: 1000 for tonnes, as with mm, t, s and N; 1 for mm, kg, s and
        mN; 175.127 for inches, s and lbf. 1 when nothing is said.
    modal_mass : float, optional
        Modal mass of every mode in the unit of mass, instead of those of the file; 1 for shapes
        that are normalised to unit modal mass.
    count : int, optional
        Read only the first modes of the file.

    Returns
    -------
    ModeSet
        In SI units. Points are multiplied by the unit of length, modal masses by that of mass, and
        shapes keep their normalisation.

    Raises
    ------
    InputError
        When the file cannot be read or used; the message names file, place, limit and remedy.
    """
    wishes = Wishes(length_unit, mass_unit, modal_mass, count)
    file, places = Path(path), None if geometry is None else Path(geometry)
    for each in (file, places):
        if each is not None:
            _check_file(each)
    kind = _kind(file)
    if places is not None and kind != "punch":
        limit = "is for punch files alone; others hold their points"
        raise InputError("geometry", str(places), limit, "Leave it out.")
    raw: RawModes = (
        read_punch(file, places)
        if kind == "punch"
        else {"netcdf": read_netcdf, "universal": read_universal, "op2": read_op2}.get(
            kind, read_tables
        )(file)
    )
    return finished(raw, wishes, str(path))


def _check_file(path: Path) -> None:
    remedy = "Give the path of a file of modes."
    try:
        if not path.is_file():
            raise InputError(str(path), "no such file", f"must be a file: {_KINDS}", remedy)
        size = path.stat().st_size
        with path.open("rb") as file:
            file.read(1)
    except (OSError, ValueError) as error:
        limit = "must be a file that can be read"
        raise InputError(str(path), str(error)[:200], limit, remedy) from error
    if not 0 < size <= LARGEST_FILE:
        limit = f"must be 1 to {LARGEST_FILE}"
        remedy = "Export fewer modes or points." if size else "Export the modes anew."
        raise InputError(f"{path}: bytes", size, limit, remedy)


def _kind(path: Path) -> str:
    with path.open("rb") as file:
        head = file.read(_HEAD)
    lines = head.splitlines()
    first = next((line for line in lines if line.strip()), b"")
    if head.startswith(_HDF5):
        return "netcdf"
    if head[:4] in (b"\x04\0\0\0", b"\0\0\0\x04", b"\x08\0\0\0", b"\0\0\0\x08"):
        return "op2"
    if first.strip() == b"-1":
        return "universal"
    if first.startswith(b"$") or path.suffix.lower() == ".pch":
        return "punch"
    if b"\0" in head or path.suffix.lower() in (".nc", ".op2", ".unv", ".uff"):
        limit = f"must be one of {_KINDS}"
        remedy = "Its beginning is that of none of them: export the modes anew."
        raise InputError(str(path), first[:40].decode("ascii", "replace"), limit, remedy)
    return "tables"
