"""The one way to build a dataset: every variable as it is declared in `variables`."""

import difflib
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.variables import COORDINATES, FOLD, VARIABLES, Dims, Variable, variable
from foldwing.stability.status import Status

if TYPE_CHECKING:
    import xarray

KINDS = ("modes", "flutter", "boundary", "convergence", "steady", "aircraft", "flight", "section")
"""What a dataset can hold; its attribute ``kind`` is one of these."""

REQUIRED_ATTRIBUTES = (
    "title",
    "kind",
    "foldwing_version",
    "model_text",
    "model_hash",
    "method",
    "options",
    "created",
)
"""Attributes that every dataset carries, so that it can be reproduced."""

Values = Mapping[str, tuple[Any, ...]]
"""Name -> (dims, values) or (dims, values, further attributes)."""

_DTYPES = {"real": np.float64, "complex": np.complex128, "integer": np.int64, "truth": np.bool_}


_FOLD_ANGLE = re.compile(r"fold_(\d+)")


def is_fold_angle(name: str) -> bool:
    """Return whether ``name`` is the coordinate of a fold angle: ``fold_2``, ``fold_3``, ..."""
    match = _FOLD_ANGLE.fullmatch(name)
    return match is not None and int(match[1]) >= 2


def fold_angle_names(dataset: "xarray.Dataset") -> list[str]:
    """Return ``fold_2``, ``fold_3``, ... of a dataset, in the order of the hinges."""
    names = [str(name) for name in dataset.coords if is_fold_angle(str(name))]
    return sorted(names, key=lambda name: int(name.removeprefix("fold_")))


def case_names(dataset: "xarray.Dataset") -> list[str]:
    """Return the coordinates that tell cases apart: fold angles, or a torsion frequency ratio."""
    others = [name for name in ("torsion_frequency_ratio",) if name in dataset.coords]
    return [*fold_angle_names(dataset), *others]


def build_dataset(variables: Values, coords: Values, attrs: Mapping[str, Any]) -> "xarray.Dataset":
    """Build a labelled dataset, checked against the schema.

    Parameters
    ----------
    variables, coords : mapping
        Name -> ``(dims, values)`` or ``(dims, values, further attributes)``. Units, long names
        and status flags are filled in.
    attrs : mapping
        Attributes of the dataset; `foldwing.results.provenance` gives the required ones.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    ValueError
        When a name is unknown, dimensions or types differ from the schema, or an attribute is
        missing.
    """
    import xarray

    _check_attributes(attrs)
    return xarray.Dataset(
        {name: _labelled(_variable(name), given) for name, given in variables.items()},
        {name: _labelled(_coordinate(name), given) for name, given in coords.items()},
        dict(attrs),
    )


def _check_attributes(attrs: Mapping[str, Any]) -> None:
    missing = [name for name in REQUIRED_ATTRIBUTES if name not in attrs]
    if missing:
        raise ValueError(f"dataset attributes missing: {', '.join(missing)}")
    if attrs["kind"] not in KINDS:
        raise ValueError(f"kind: got {attrs['kind']!r}; must be one of {', '.join(KINDS)}")


def _variable(name: str) -> Variable:
    if name not in VARIABLES:
        raise ValueError(_unknown("variable", name, VARIABLES))
    return VARIABLES[name]


def _coordinate(name: str) -> Variable:
    if is_fold_angle(name):
        hinge = name.removeprefix("fold_")
        return variable(name, FOLD, "degree", f"fold angle of hinge {hinge}")
    if name not in COORDINATES:
        raise ValueError(_unknown("coordinate", name, COORDINATES))
    return COORDINATES[name]


def _unknown(what: str, name: str, known: Mapping[str, Variable]) -> str:
    near = difflib.get_close_matches(name, known, n=1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return f"unknown {what} {name!r}{hint}"


def _labelled(row: Variable, given: tuple[Any, ...]) -> tuple[Dims, Any, dict[str, Any]]:
    """Return (dims, values of the type of the schema, attributes)."""
    dims, values, further = given if len(given) == 3 else (*given, {})
    dims = (dims,) if isinstance(dims, str) else tuple(dims)
    if dims not in row.dims:
        allowed = " or ".join(str(choice) for choice in row.dims)
        raise ValueError(f"{row.name}: got dimensions {dims}; must be {allowed}")
    attrs = {"long_name": row.long_name, "units": row.units, **further}
    if row.dtype == "status":
        attrs["flag_values"] = np.array([int(member) for member in Status], np.int64)
        attrs["flag_meanings"] = " ".join(member.meaning for member in Status)
    return dims, _typed(row, values), attrs


def _typed(row: Variable, values: Any) -> Any:
    array = np.asarray(values)
    if row.dtype == "text":
        return array.astype(np.str_)
    dtype = np.dtype(_DTYPES.get(row.dtype, np.int64))
    if array.size and not _fits(array, dtype):
        raise ValueError(f"{row.name}: got values of type {array.dtype}; must be {row.dtype}")
    return array.astype(dtype)


def _fits(array: Any, dtype: "np.dtype[Any]") -> bool:
    """Whether the values keep their meaning as ``dtype`` (0 and 1 may stand for truth)."""
    if dtype == np.bool_:
        return array.dtype.kind == "b" or bool(np.isin(array, (0, 1)).all())
    return np.can_cast(array.dtype, dtype, "same_kind") and array.dtype.kind != "b"
