"""Result folders: written whole or not at all, and never over something else.

A result is put together in a hidden folder next to its place and moved there at the end. The file
``manifest.txt`` lists what foldwing wrote: only that is ever replaced.
"""

import contextlib
import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

from foldwing.errors import OutputError

MANIFEST = "manifest.txt"
_HEAD = "foldwing result"


def default_folder(
    kind: str, model_name: str, now: datetime | None = None, parent: Path = Path()
) -> Path:
    """Return a new dated folder, e.g. ``foldwing-boundary-three-segment-2026-11-23-141502``.

    Parameters
    ----------
    kind : str
        What is computed.
    model_name : str
        Name or path of the model.
    now : datetime, optional
        Local time by default.
    parent : Path, optional
        Where the folder goes; the current folder by default.
    """
    stem = re.sub(r"[^A-Za-z0-9]+", "-", Path(model_name).stem).strip("-").lower() or "model"
    moment = (now or datetime.now()).strftime("%Y-%m-%d-%H%M%S")
    folder = parent / f"foldwing-{kind}-{stem}-{moment}"
    return free_name(folder)


def free_name(folder: Path) -> Path:
    """Return the folder, or the first of ``folder-2``, ``folder-3`` ... that does not exist."""
    free, suffix = folder, 2
    while free.exists():
        free = folder.with_name(f"{folder.name}-{suffix}")
        suffix += 1
    return free


def check_writable(path: Path, force: bool = False) -> None:
    """Raise `OutputError` when a result cannot be written to the folder ``path``.

    Nothing is left behind. To be called before a long computation.
    """
    _check_place(path, force)
    ancestor = path.absolute().parent
    while not ancestor.exists():
        ancestor = ancestor.parent
    with _naming(path):
        os.rmdir(tempfile.mkdtemp(prefix=".foldwing-", dir=ancestor))


@contextlib.contextmanager
def result_folder(path: Path, force: bool = False) -> Iterator[Path]:
    """Give a folder to write into, which becomes ``path`` when the block ends without error.

    Parameters
    ----------
    path : Path
        Where the result goes; missing parents are made.
    force : bool
        Replace an existing result. Files in it that foldwing did not write are kept.

    Yields
    ------
    Path
        The folder to write into.

    Raises
    ------
    OutputError
        When the folder cannot be written, or exists and may not be replaced.
    """
    _check_place(path, force)
    with _parents(path), _staging(path) as staging:
        yield staging
        with _naming(path):
            _write_manifest(staging)
            _check_place(path, force)
            _keep_foreign(path, staging)
            _move(staging, path)


def _check_place(path: Path, force: bool) -> None:
    """Raise unless ``path`` is free, empty, or a result that may be replaced."""
    if Path.cwd().is_relative_to(path.absolute()):
        raise OutputError(f"{path}: is the folder you work in. Choose a new one for --out.")
    with _naming(path):
        if not path.exists():
            return
        if not path.is_dir():
            raise OutputError(f"{path}: is a file; results go to a folder. Choose another --out.")
        if not any(path.iterdir()):
            return
    if _written_by_foldwing(path) is None:
        raise OutputError(
            f"{path}: the folder holds files that are not a foldwing result; they are never "
            "replaced. Choose another --out."
        )
    if not force:
        raise OutputError(
            f"{path}: the folder already holds a result. Choose another --out, or replace it "
            "with --force."
        )


def _written_by_foldwing(path: Path) -> set[str] | None:
    """Return the files that the manifest lists, or None when there is no manifest."""
    try:
        lines = (path / MANIFEST).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return None
    return {*lines[1:], MANIFEST} if lines[:1] == [_HEAD] else None


def _files(path: Path) -> list[str]:
    """Return everything in a folder that is not a folder, as relative paths."""
    return sorted(
        entry.relative_to(path).as_posix()
        for entry in path.rglob("*")
        if entry.is_symlink() or not entry.is_dir()
    )


def _write_manifest(staging: Path) -> None:
    lines = [_HEAD, *_files(staging)]
    (staging / MANIFEST).write_text("\n".join(lines) + "\n", encoding="utf-8")


def _keep_foreign(path: Path, staging: Path) -> None:
    """Copy what others put into the old result folder into the new one."""
    written = _written_by_foldwing(path) if path.is_dir() else None
    if written is None:
        return
    for name in _files(path):
        if name in written:
            continue
        if os.path.lexists(staging / name):
            raise OutputError(
                f"{path / name}: foldwing would replace this file, which it did not write. Move it "
                "away or choose another --out."
            )
        (staging / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path / name, staging / name, follow_symlinks=False)


def _move(staging: Path, path: Path) -> None:
    """Put the finished folder in place; an old one is back when that fails."""
    target = path.resolve()
    if not target.exists():
        os.rename(staging, target)
        return
    old = Path(tempfile.mkdtemp(prefix=f".{target.name}-old-", dir=target.parent))
    os.rename(target, old / target.name)
    try:
        os.rename(staging, target)
    except OSError:
        os.rename(old / target.name, target)
        old.rmdir()
        raise
    shutil.rmtree(old)


@contextlib.contextmanager
def _parents(path: Path) -> Iterator[None]:
    """Make the missing parents of ``path``, and remove them again after an error."""
    parents = path.resolve().parents
    missing = [parent for parent in parents if not parent.exists()]
    try:
        with _naming(path):
            path.resolve().parent.mkdir(parents=True, exist_ok=True)
        yield
    except BaseException:
        for parent in missing:
            with contextlib.suppress(OSError):
                parent.rmdir()
        raise


@contextlib.contextmanager
def _staging(path: Path) -> Iterator[Path]:
    """Make a hidden sibling of ``path``, which is gone at the end in any case."""
    target = path.resolve()
    with _naming(path):
        holder = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    try:
        staging = holder / target.name
        staging.mkdir()  # with the usual permissions, unlike the holder
        yield staging
    finally:
        shutil.rmtree(holder, ignore_errors=True)


@contextlib.contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Turn an error of the file system into one that names the folder and the remedy."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        raise OutputError(
            f"{path}: the folder cannot be written ({reason}). Choose another --out."
        ) from error
