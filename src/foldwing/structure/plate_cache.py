"""Elastic modes of plates kept on disk, so that they are computed once.

They lie in the user's folder of caches, or in that named by the environment variable
``FOLDWING_CACHE``; an empty name keeps nothing. What cannot be read or written is computed anew.
"""

import hashlib
import os
import tempfile
from contextlib import suppress
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache
from importlib.metadata import version
from pathlib import Path

import numpy as np

from foldwing.model import Planform, Sheet
from foldwing.structure.plate_elastic import ElasticModes, elastic_modes

VARIABLE = "FOLDWING_CACHE"

FORMAT = 1
"""Of the files, and of how their content is computed: raised when either changes."""

PLATES = 16
"""How many plates one process keeps."""

FILES = 100
"""How many files the folder holds, of about a megabyte each."""


def kept_elastic_modes(
    planform: Planform, sheet: Sheet, count: int, clamped: bool, size: float
) -> ElasticModes:
    """Return `elastic_modes` of the same arguments, from the cache when it holds them.

    The arrays are read-only, for several segments may share them.
    """
    return _kept(_Problem(planform, sheet, count, clamped, size))


@dataclass(frozen=True)
class _Problem:
    """The arguments of `elastic_modes`, the same when their content is."""

    planform: Planform
    sheet: Sheet
    count: int
    clamped: bool
    size: float

    @cached_property
    def key(self) -> str:
        """A name of the content, and of what computes from it."""
        made_by = (FORMAT, version("scikit-fem"))
        outline = (self.planform.corners, self.planform.tip)
        stiffness = [float(q).hex() for q in self.sheet.stiffness.ravel()]
        sheet = (self.sheet.model_dump_json(), stiffness)
        content = (made_by, outline, sheet, self.count, self.clamped, self.size.hex())
        return hashlib.sha256(repr(content).encode()).hexdigest()


@lru_cache(maxsize=PLATES)
def _kept(problem: _Problem) -> ElasticModes:
    folder = cache_folder()
    file = None if folder is None else folder / f"{problem.key}.npz"
    modes = None if file is None else _read(file)
    if modes is None:
        p = problem
        modes = elastic_modes(p.planform, p.sheet, p.count, p.clamped, p.size)
        if file is not None:
            _write(file, modes)
    for field in fields(modes):
        getattr(modes, field.name).setflags(write=False)
    return modes


def cache_folder() -> Path | None:
    """Return the folder of the cache; None where nothing is to be kept."""
    named = os.environ.get(VARIABLE)
    if named is not None:
        return Path(named) / "plates" if named else None
    from platformdirs import user_cache_path

    try:
        return user_cache_path("foldwing", appauthor=False) / "plates"
    except RuntimeError:  # there is no home
        return None


def _read(file: Path) -> ElasticModes | None:
    # There is no list of what a damaged file may raise, and none of it may end a run.
    with suppress(Exception), file.open("rb") as stream:
        held = np.load(stream, allow_pickle=False)
        return ElasticModes(**{field.name: held[field.name] for field in fields(ElasticModes)})
    return None


def _write(file: Path, modes: ElasticModes) -> None:
    """Write beside the file and rename, so that none is ever seen half written."""
    arrays = {field.name: getattr(modes, field.name) for field in fields(modes)}
    with suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=file.parent, suffix=".tmp")
        try:
            with os.fdopen(handle, "wb") as stream:
                np.savez(stream, **arrays)
            os.replace(name, file)
        except OSError:
            Path(name).unlink(missing_ok=True)
            raise
        _leave(file.parent, FILES)


def _leave(folder: Path, count: int) -> None:
    """Delete the oldest files beyond that many."""
    files = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime)
    for file in files[: max(0, len(files) - count)]:
        file.unlink(missing_ok=True)
