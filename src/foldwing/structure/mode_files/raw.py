"""Modes as they stand in a file, and their way into SI units."""

import contextlib
import io
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Real
from foldwing.model.quantities import Bounds, Quantity
from foldwing.structure.mode_files.complex_modes import real_shapes, scatter_warnings
from foldwing.structure.mode_files.mode_set import ModeSet

_UNITS = {
    "length": Quantity("a unit of length", "m", '"mm"', Bounds(above=0.0)),
    "mass": Quantity("a unit of mass", "kg", '"g"', Bounds(above=0.0)),
}


@dataclass(frozen=True, eq=False)
class RawModes:
    """What a file says, in its own units.

    Attributes
    ----------
    frequencies, damping : array, shape (m,)
        Hz; viscous ratio, nan where not given.
    modal_mass : array, shape (m,)
        In the file's unit of mass; nan where the file gives none.
    names : tuple of str
    points : array, shape (k, 3)
    shapes : array, shape (m, k, 3)
        Real or complex.
    length_unit, mass_unit : float, optional
        In m and kg, where the file states them.
    complexity : array, shape (m,), optional
        Phase scatter in degrees that the file states of shapes already real.
    notes : tuple of str
        Warnings of the reader.
    """

    frequencies: Real
    damping: Real
    modal_mass: Real
    names: tuple[str, ...]
    points: Real
    shapes: Real | Complex
    length_unit: float | None = None
    mass_unit: float | None = None
    complexity: Real | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Wishes:
    """What the user says about a file, in preference to the file; None where nothing is said.

    Attributes
    ----------
    length_unit, mass_unit : float, optional
        In m and kg.
    modal_mass : float, optional
        Of every mode, in the unit of mass.
    count : int, optional
        How many modes are taken, the first ones of the file.
    """

    length_unit: float | None = None
    mass_unit: float | None = None
    modal_mass: float | None = None
    count: int | None = None

    def __post_init__(self) -> None:
        for name in ("length_unit", "mass_unit", "modal_mass"):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0.0):
                limit = "must be finite and greater than 0"
                raise InputError(name, value, limit, "Leave it out to take what the file says.")
        if self.count is not None and self.count < 1:
            raise InputError("count", self.count, "must be at least 1", "Leave it out for all.")


def unit_of(kind: str, text: str, field: str) -> float:
    """Return the size in SI of a unit of ``length`` or ``mass``: a name, or a number of m or kg."""
    words = text.strip()
    try:
        value: object = float(words)
    except ValueError:
        value = f"1 {words}"
    return _UNITS[kind].read(value, field)


def finished(raw: RawModes, wishes: Wishes, source: str) -> ModeSet:
    """Return the modes in SI units with real shapes.

    Lengths are multiplied by the unit of length, modal masses by that of mass. Shapes stay as they
    are: they have no unit, so that the modal coordinate becomes one in m and the modal mass one in
    kg, whatever the unit of length.
    """
    count = len(raw.frequencies) if wishes.count is None else wishes.count
    if count > len(raw.frequencies):
        limit = f"must be at most {len(raw.frequencies)}, the modes of {source}"
        raise InputError("count", count, limit, "Leave it out for all.")
    if raw.shapes.size == 0:
        limit = "must hold displacements of points"
        raise InputError(f"{source}: shapes", "none", limit, "Export the shapes too.")
    length, by_length = _unit("length", wishes.length_unit, raw.length_unit)
    mass, by_mass = _unit("mass", wishes.mass_unit, raw.mass_unit)
    own = raw.modal_mass if wishes.modal_mass is None else np.full(count, wishes.modal_mass)
    if np.isnan(own[:count]).any():
        mode = int(np.argmax(np.isnan(own[:count]))) + 1
        remedy = "Give modal_mass=1.0 when the shapes are normalised to unit modal mass."
        limit = "is needed: shapes have any size without it"
        raise InputError(f"{source}: mode {mode}: modal mass", None, limit, remedy)
    shapes, scatter = real_shapes(raw.shapes[:count])
    if raw.complexity is not None and not np.iscomplexobj(raw.shapes):
        scatter = raw.complexity[:count]
    with np.errstate(over="ignore", invalid="ignore"):
        points, modal_mass = raw.points * length, own[:count] * mass
    return ModeSet(
        frequencies=raw.frequencies[:count],
        modal_mass=modal_mass,
        points=points,
        shapes=shapes,
        damping=raw.damping[:count],
        complexity=scatter,
        names=raw.names,
        source=source,
        warnings=(*raw.notes, *by_length, *by_mass, *scatter_warnings(scatter)),
    )


def _unit(kind: str, wished: float | None, stated: float | None) -> tuple[float, tuple[str, ...]]:
    if wished is None:
        return (1.0 if stated is None else stated), ()
    if stated is None or np.isclose(wished, stated, rtol=1e-6):
        return wished, ()
    note = (
        f"the file states a unit of {kind} of {stated:g}, and {wished:g} is used as was asked for"
    )
    return wished, (note,)


@contextlib.contextmanager
def trusting_nobody(path: Path, what: str, remedy: str) -> Iterator[None]:
    """Turn whatever a library raises on a file into an `InputError`; silence what it prints."""
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
            warnings.simplefilter("ignore")
            yield
    except (InputError, ImportError):
        raise
    except Exception as error:  # third-party readers raise anything on a damaged file
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        raise InputError(str(path), reason, f"must be {what}", remedy) from error
