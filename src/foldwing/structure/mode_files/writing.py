"""Modes to a file, which is there whole or not at all."""

import os
import tempfile
from pathlib import Path

from foldwing.errors import InputError, OutputError
from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.netcdf import write_netcdf
from foldwing.structure.mode_files.tables import write_tables
from foldwing.structure.mode_files.universal import write_universal

_WRITERS = {
    ".csv": write_tables,
    ".nc": write_netcdf,
    ".unv": write_universal,
    ".uff": write_universal,
}


def write_modes(modes: ModeSet, path: str | Path) -> None:
    """Write modes to a new file, which `read_modes` reads back.

    The ending of the name chooses the format. CSV and netCDF keep every digit; universal files keep
    6 digits of everything but positions, no names that are not whole numbers, and 0 for a damping
    that is not known. ``source`` and ``warnings`` are not written.

    Parameters
    ----------
    modes : ModeSet
    path : str or Path
        Ending in .csv, .nc, .unv or .uff.

    Raises
    ------
    InputError
        When the ending is another, or pyuff is not installed.
    OutputError
        When the file exists, which is never replaced, or cannot be written.
    """
    target = Path(path)
    writer = _WRITERS.get(target.suffix.lower())
    if writer is None:
        limit = f"must end in {', '.join(_WRITERS)}"
        raise InputError("path", str(path), limit, "Choose one of these formats.")
    if os.path.lexists(target):
        raise OutputError(_exists(target))
    try:
        with tempfile.TemporaryDirectory(prefix=".foldwing-", dir=target.parent) as folder:
            part = Path(folder) / target.name
            writer(modes, part)
            _publish(part, target)
    except FileExistsError as error:
        raise OutputError(_exists(target)) from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise OutputError(
            f"{target}: cannot be written: {reason}. Choose another place."
        ) from error


def _publish(part: Path, target: Path) -> None:
    try:
        os.link(part, target)  # unlike a rename, never replaces a file
    except FileExistsError:
        raise
    except OSError:  # a file system without links
        if os.path.lexists(target):
            raise FileExistsError(target) from None
        part.rename(target)


def _exists(target: Path) -> str:
    return f"{target}: exists already and is never replaced. Choose another name or remove it."
