"""The variables of a result: name, dimensions, unit and meaning, and the one way to build one."""

import difflib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.stability.status import Status

if TYPE_CHECKING:
    import xarray

KINDS = ("modes", "flutter", "boundary")
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

Dims = tuple[str, ...]
Values = Mapping[str, tuple[Any, ...]]
"""Name -> (dims, values) or (dims, values, further attributes)."""

_DTYPES = {"real": np.float64, "complex": np.complex128, "integer": np.int64, "truth": np.bool_}


@dataclass(frozen=True)
class Variable:
    """One row of the schema.

    Attributes
    ----------
    name : str
    dims : tuple of tuple of str
        The dimensions it may have; more than one choice when kinds of dataset differ.
    units : str
        ``1`` for dimensionless numbers, empty for text.
    long_name : str
    dtype : str
        ``real``, ``complex``, ``integer``, ``truth``, ``text`` or ``status``.
    """

    name: str
    dims: tuple[Dims, ...]
    units: str
    long_name: str
    dtype: str = "real"


_FOLD: Dims = ("fold",)
_MODE: Dims = ("fold", "mode")
_LOCUS: Dims = ("fold", "speed", "mode")
_TABLE: Dims = ("flutter_point",)
_CURVE: Dims = ("curve_sample",)
_MEASURED: Dims = ("measured",)


def _row(name: str, dims: Dims, units: str, long_name: str, dtype: str = "real") -> Variable:
    return Variable(name, (dims,), units, long_name, dtype)


_COORDINATES = (
    _row("fold", _FOLD, "1", "case index", "integer"),
    _row("speed", ("speed",), "m/s", "airspeed"),
    _row("mode", ("mode",), "1", "mode or branch, from 1", "integer"),
    _row("point", ("point",), "1", "point index", "integer"),
    _row("segment", ("point",), "1", "segment, 1 at the root", "integer"),
    _row("chordwise", ("point",), "1", "index along the chord within the segment", "integer"),
    _row("spanwise", ("point",), "1", "index along the span within the segment", "integer"),
    _row("axis", ("axis",), "", "global axis: x aft, y outboard, z up", "text"),
    _row("flutter_point", _TABLE, "1", "row of the table of flutter points", "integer"),
    _row("contour_growth", ("contour_growth",), "1/s", "growth rate of the contour grid"),
    _row("contour_frequency", ("contour_frequency",), "Hz", "frequency of the contour grid"),
    _row("curve_sample", _CURVE, "1", "sample of the continuation curves", "integer"),
    _row("measured", _MEASURED, "1", "measured point", "integer"),
    _row("time", ("time",), "s", "time after the disturbance"),
)

_MODES = (
    _row("natural_frequency", _MODE, "Hz", "natural frequency"),
    _row("mode_name", _MODE, "", "name of the mode", "text"),
    _row("mode_confidence", _MODE, "1", "likeness (MAC) to the same mode at the previous fold"),
    _row("bending_share", _MODE, "1", "share of bending in the energy of the mode"),
    _row("position", ("fold", "point", "axis"), "m", "position on the folded wing at rest"),
    _row("mode_shape", ("fold", "mode", "point", "axis"), "m", "displacement in the mode"),
    Variable("status", (_FOLD, _LOCUS), "1", "how the computation ended", "status"),
)

_LOCI = (
    _row("eigenvalue", _LOCUS, "rad/s", "eigenvalue", "complex"),
    _row("frequency", _LOCUS, "Hz", "frequency of the eigenvalue"),
    _row("damping", _LOCUS, "1", "damping ratio -Re/|Im|, positive when stable"),
    _row("growth", _LOCUS, "1/s", "growth rate, the real part of the eigenvalue"),
    _row("residual", _LOCUS, "1", "residual of the eigenvalue"),
    _row("confidence", _LOCUS, "1", "likeness (MAC) to the same branch at the previous airspeed"),
    _row("branch_name", ("mode",), "", "name of the branch", "text"),
    _row("loci_certified", ("fold", "speed"), "", "all unstable eigenvalues are listed", "truth"),
)

_CASES = (
    _row("certified", _FOLD, "", "all unstable eigenvalues were found at every airspeed", "truth"),
    _row("case_status", _FOLD, "1", "how the computation of the case ended", "status"),
    _row("valid_from", _FOLD, "m/s", "lowest airspeed for which the result holds"),
    _row("uncertified_modes", _FOLD, "", "modes not resolved at the lowest airspeeds", "text"),
    _row("unstable_from_start", _FOLD, "1", "unstable roots at the lowest airspeed", "integer"),
    _row("message", _FOLD, "", "why the case failed or is doubtful", "text"),
)

_POINTS = (
    _row("case", _TABLE, "1", "index of the case along fold", "integer"),
    _row("kind", _TABLE, "", "flutter or divergence", "text"),
    _row("event", _TABLE, "", "onset, recovery or merger", "text"),
    _row("class", _TABLE, "", "hump or coalescence", "text"),
    _row("flutter_speed", _TABLE, "m/s", "airspeed of the flutter point"),
    _row("flutter_frequency", _TABLE, "Hz", "frequency of the flutter point"),
    _row("strength", _TABLE, "s/m", "strength of the instability, d(Re/Im)/dU"),
    _row("branch", _TABLE, "1", "branch, -1 when not known", "integer"),
    _row("flutter_mode_name", _TABLE, "", "still-air mode that the root starts from", "text"),
    _row("flutter_mode_confidence", _TABLE, "1", "confidence in the name of the mode"),
    _row("threshold", _TABLE, "1", "damping ratio at which the point is reported"),
    _row("point_residual", _TABLE, "1", "residual of the flutter point"),
    _row("flutter_shape", (*_TABLE, "point", "axis"), "m", "motion at the point", "complex"),
)

_EXTRAS = (
    _row(
        "determinant",
        ("contour_growth", "contour_frequency"),
        "1",
        "determinant of the flutter equation",
        "complex",
    ),
    _row("curve_id", _CURVE, "1", "number of the curve", "integer"),
    _row("curve_fold", _CURVE, "degree", "fold angle along the curve"),
    _row("curve_speed", _CURVE, "m/s", "airspeed along the curve"),
    _row("curve_frequency", _CURVE, "Hz", "frequency along the curve"),
    _row("curve_strength", _CURVE, "s/m", "strength along the curve"),
    _row("curve_kind", _CURVE, "", "flutter or divergence", "text"),
    _row("measured_fold", _MEASURED, "degree", "measured: fold angle"),
    _row("measured_speed", _MEASURED, "m/s", "measured: airspeed of flutter"),
    _row("measured_frequency", _MEASURED, "Hz", "measured: frequency"),
    _row("response", ("time", "mode"), "1", "modal displacement over the largest of all modes"),
    _row("response_envelope", ("time", "mode"), "1", "amplitude of the identified motion"),
)

VARIABLES: Mapping[str, Variable] = {
    row.name: row for row in (*_MODES, *_LOCI, *_CASES, *_POINTS, *_EXTRAS)
}
"""Every variable a dataset may hold."""

COORDINATES: Mapping[str, Variable] = {row.name: row for row in _COORDINATES}
"""Every coordinate a dataset may hold, besides the fold angles ``fold_2``, ``fold_3``, ..."""

_FOLD_ANGLE = re.compile(r"fold_(\d+)")


def is_fold_angle(name: str) -> bool:
    """Return whether ``name`` is the coordinate of a fold angle: ``fold_2``, ``fold_3``, ..."""
    match = _FOLD_ANGLE.fullmatch(name)
    return match is not None and int(match[1]) >= 2


def fold_angle_names(dataset: "xarray.Dataset") -> list[str]:
    """Return ``fold_2``, ``fold_3``, ... of a dataset, in the order of the hinges."""
    names = [str(name) for name in dataset.coords if is_fold_angle(str(name))]
    return sorted(names, key=lambda name: int(name.removeprefix("fold_")))


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
        return _row(name, _FOLD, "degree", f"fold angle of hinge {hinge}")
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
