"""Nastran: grid points of bulk data files, and modes with their grid points of OP2 files.

Both are read by pyyeti; positions and displacements are turned from the coordinate systems of the
grid points into basic axes.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.structure.mode_files.raw import RawModes, trusting_nobody

_CARDS = "Name the bulk data file that holds the GRID cards of the model."
_POST = "Write the file with PARAM,POST,-1 and VECTOR(PLOT) = ALL."
_LARGEST = 1e15
_MOST_GRID = 100_000_000  # of Nastran itself
_TABLES = ("OUGV1", "BOPHIG", "OUG1")


class Grid(NamedTuple):
    """A grid point in basic axes.

    Attributes
    ----------
    position : array, shape (3,)
    rotation : array, shape (3, 3)
        Displacement in basic axes is rotation @ displacement in the axes of the point.
    """

    position: Real
    rotation: Real


def read_bulk(path: Path) -> dict[int, Grid]:
    """Return the grid points of a bulk data file by number; INCLUDE statements are followed.

    GRID cards may have fields of 8 or 16 columns or commas; coordinate systems are those of CORD2R,
    CORD2C and CORD2S cards.

    Raises
    ------
    InputError
        When there is no GRID card, or a card cannot be read.
    """
    bulk = _pyyeti(path).bulk
    with trusting_nobody(path, "a bulk data file that can be read", _CARDS):
        cards, defaults = (
            bulk.rdcards(str(path), name, return_var="list", no_data_return=[], encoding="latin-1")
            for name in ("grid", "grdset")
        )
        systems = bulk.rdcord2cards(str(path), encoding="latin-1")
    if defaults:
        limit = "is not read: every GRID card must state its own coordinate systems"
        raise InputError(f"{path}: GRDSET", "a card", limit, "Write them into the GRID cards.")
    if not cards:
        raise InputError(f"{path}: GRID", None, "must hold GRID cards", _CARDS)
    return _grids(path, np.array([_fields(path, card) for card in cards]), systems)


def _fields(path: Path, card: Sequence[object]) -> list[float]:
    """Return number, system, x, y, z and system of displacements of a GRID card; blanks are 0."""
    given = [*card, *[""] * 6][:6]
    for field in given:
        if field != "" and not (isinstance(field, int | float) and abs(field) < _LARGEST):
            limit = "must be numbers: a grid point, its system, x, y, z, and another system"
            where = f"{path}: GRID {str(card[0])[:16]}"
            raise InputError(where, str(field)[:40], limit, "Correct the card.")
    return [float(field) if field != "" else 0.0 for field in given]  # type: ignore[arg-type]


def _pyyeti(path: Path) -> Any:
    try:
        from pyyeti import nastran
        from pyyeti.nastran import bulk, n2p, op2
    except ImportError as error:
        limit = "Nastran files need the package pyyeti"
        remedy = 'Install it: pip install "foldwing[nastran]".'
        raise InputError(str(path), "a Nastran file", limit, remedy) from error
    del bulk, n2p, op2  # they are attributes of the package from now on
    return nastran


def _grids(path: Path, cards: Real, systems: Mapping[int, Any]) -> dict[int, Grid]:
    """Return grid points from rows of number, system, x, y, z, system of displacements, ..."""
    numbers, counts = np.unique(cards[:, 0], return_counts=True)
    if counts.max() > 1:
        repeated = float(numbers[np.argmax(counts)])
        limit = "every grid point must stand once"
        raise InputError(f"{path}: GRID", repeated, limit, "Remove one of the cards.")
    if not (np.all(np.isfinite(cards[:, :6])) and 0 < numbers[0] <= numbers[-1] <= _MOST_GRID):
        limit = f"must have a number from 1 to {_MOST_GRID} and finite coordinates"
        raise InputError(f"{path}: GRID", "a card without them", limit, _CARDS)
    for column, what in ((1, "positions"), (5, "displacements")):
        unknown = {int(s) for s in cards[:, column]} - {0, *systems}
        if unknown:
            limit = (
                f"the coordinate system of {what} must be a CORD2R, CORD2C or CORD2S of the file"
            )
            remedy = "Export with basic coordinates (system 0), or add the card."
            raise InputError(f"{path}: coordinate system", min(unknown), limit, remedy)
    n2p = _pyyeti(path).n2p
    with trusting_nobody(path, "grid points in known coordinate systems", _CARDS):
        ids = cards[:, 0].astype(int)
        table = n2p.addgrid(None, ids, "b", cards[:, 1], cards[:, 2:5], cards[:, 5], dict(systems))
        rigid = np.asarray(n2p.rbgeom_uset(table)).reshape(-1, 6, 6)
        positions = table.to_numpy()[::6, 1:4].astype(float)
    # Rigid translations in the axes of each point are the columns of the inverse of its rotation.
    rotations = np.swapaxes(rigid[:, :3, :3], 1, 2)
    return {int(n): Grid(p, R) for n, p, R in zip(ids, positions, rotations, strict=True)}


def joined(
    path: Path, grids: Mapping[int, Grid], shapes: Sequence[Mapping[int, Sequence[float]]]
) -> tuple[tuple[str, ...], Real, Real]:
    """Return names, positions (k, 3) and displacements (m, k, 3) in basic axes.

    Raises
    ------
    InputError
        When a mode lacks a point that another has, or a point has no position.
    """
    used = sorted(set().union(*shapes))
    if not used:
        limit = "must hold displacements of grid points"
        raise InputError(f"{path}: shapes", "none", limit, "The file may be cut short.")
    for mode, shape in enumerate(shapes, 1):
        for number in used:
            if number not in shape:
                limit = f"every mode needs every point; this one has {len(shape)} of {len(used)}"
                field = f"{path}: mode {mode}: grid point {number}"
                raise InputError(field, None, limit, "The file may be cut short: export it anew.")
    for number in used:
        if number not in grids:
            limit = f"has a shape but no GRID card among the {len(grids)} that were read"
            raise InputError(f"{path}: grid point", number, limit, _CARDS)
    points = np.array([grids[n].position for n in used])
    rotations = np.array([grids[n].rotation for n in used]).reshape(-1, 3, 3)
    local = np.array([[shape[n] for n in used] for shape in shapes], float)
    return tuple(map(str, used)), points, np.einsum("kab,mkb->mka", rotations, local)


def read_op2(path: Path) -> RawModes:
    """Read real modes, their modal masses and grid points from an OP2 file of PARAM,POST,-1.

    Raises
    ------
    InputError
        When it is damaged, or eigenvectors (OUGV1, BOPHIG), eigenvalues (LAMA) or grid points
        (GEOM1) are not there.
    """
    op2 = _pyyeti(path).op2
    with trusting_nobody(path, "an OP2 file that can be read", _POST):
        content = op2.rdparampost(str(path), get_ougs=True)
        table = next(
            (content[n.lower()] for n in _TABLES if content.get(n.lower()) is not None), None
        )
        geometry = (content.get("geom1") or {}).get(0, {})
    for given, what in (
        (table, "real eigenvectors (OUGV1 or BOPHIG)"),
        (content.get("lama"), "eigenvalues and modal masses (LAMA)"),
        (geometry.get("grid"), "grid points (GEOM1)"),
    ):
        if given is None or not len(given):
            raise InputError(str(path), None, f"must hold {what}", _POST)
    return _from_op2(path, table, np.asarray(content["lama"], float), geometry)


def _from_op2(path: Path, table: Any, lama: Real, geometry: Mapping[str, Any]) -> RawModes:
    if len(lama) != table.shape[1]:
        limit = f"must be {len(lama)}, the number of eigenvalues"
        remedy = "Export the modes of one subcase alone."
        raise InputError(f"{path}: number of eigenvectors", table.shape[1], limit, remedy)
    systems = {n: s for n, s in geometry["cords"].items() if n >= 0}
    grids = _grids(path, np.asarray(geometry["grid"], float), systems)
    direction = table.index.get_level_values(1).to_numpy()
    numbers = table.index.get_level_values(0).to_numpy()
    moving = [int(n) for n in numbers[direction == 1] if int(n) in grids]
    rows = np.flatnonzero(direction == 1)[[int(n) in grids for n in numbers[direction == 1]]]
    if not moving:
        raise InputError(f"{path}: grid points", 0, "eigenvectors must move some", _POST)
    values = np.stack([table.to_numpy(float)[rows + i] for i in range(3)], axis=-1)
    shapes = [dict(zip(moving, column, strict=True)) for column in values.transpose(1, 0, 2)]
    names, points, displacements = joined(path, grids, shapes)
    left_out = int((direction == 1).sum()) - len(moving) + int((direction == 0).sum())
    notes = (f"{left_out} points without position are left out",) if left_out else ()
    return RawModes(
        frequencies=np.sqrt(np.abs(lama[:, 2])) / (2.0 * np.pi),
        damping=np.full(len(lama), np.nan),
        modal_mass=lama[:, 5],
        names=names,
        points=points,
        shapes=displacements,
        notes=notes + negative_eigenvalues(lama[:, 2]),
    )


def negative_eigenvalues(eigenvalues: Real) -> tuple[str, ...]:
    """Return a warning of negative eigenvalues, which round-off makes of zero ones."""
    count = int((eigenvalues < 0.0).sum())
    if not count:
        return ()
    least, largest = float(eigenvalues.min()), float(np.abs(eigenvalues).max())
    return (
        f"{count} modes have a negative eigenvalue, the least {least:g} of up to {largest:g}; the "
        "root of its modulus is taken as their angular frequency",
    )
