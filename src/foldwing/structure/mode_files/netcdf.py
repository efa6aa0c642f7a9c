"""netCDF files of modes: the attributes of a mode set as variables with units."""

from pathlib import Path

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Real
from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.raw import RawModes, trusting_nobody, unit_of

_VARIABLES = {
    "frequency": (("mode",), "Hz"),
    "modal_mass": (("mode",), "kg"),
    "damping": (("mode",), "1"),
    "phase_scatter": (("mode",), "degree"),
    "position": (("point", "axis"), "m"),
    "shape": (("mode", "point", "axis"), "1"),
    "shape_imag": (("mode", "point", "axis"), "1"),
    "point_name": (("point",), ""),
}
_OPTIONAL = ("modal_mass", "damping", "phase_scatter", "shape_imag", "point_name")
_FORM = (
    "It needs the variables frequency (mode), modal_mass (mode), position (point, axis) and shape "
    "(mode, point, axis)."
)


def read_netcdf(path: Path) -> RawModes:
    """Read a netCDF-4 file.

    Raises
    ------
    InputError
        When it is damaged, or a variable is missing or of another shape.
    """
    with trusting_nobody(path, "a netCDF file that can be read", "Export the modes anew."):
        import h5py
        import xarray

        h5py.File(path, "r").close()  # what it cannot open, h5netcdf cannot close either
        dataset = xarray.load_dataset(path, engine="h5netcdf", decode_times=False)
        content = {name: _checked(path, dataset, name) for name in _VARIABLES if name in dataset}
        units = {name: str(dataset[name].attrs.get("units", "")) for name in content}
    for name in _VARIABLES:
        if name not in content and name not in _OPTIONAL:
            raise InputError(f"{path}: {name}", None, "is a needed variable", _FORM)
    return _raw(path, content, units)


def _checked(path: Path, dataset: object, name: str) -> Real:
    variable = dataset[name]  # type: ignore[index]
    dims, _ = _VARIABLES[name]
    if variable.dims != dims:
        given = ", ".join(map(str, variable.dims))
        raise InputError(
            f"{path}: {name}", f"({given})", f"must be over ({', '.join(dims)})", _FORM
        )
    if name == "point_name":
        return np.asarray(variable.values)
    if variable.dtype.kind not in "fiu":
        raise InputError(f"{path}: {name}", str(variable.dtype), "must be numbers", _FORM)
    if dims[-1] == "axis" and variable.shape[-1] != 3:
        raise InputError(f"{path}: {name}", variable.shape[-1], "must have 3 axes", _FORM)
    return np.asarray(variable.values, float)


def _raw(path: Path, content: dict[str, Real], units: dict[str, str]) -> RawModes:
    modes, points = len(content["frequency"]), len(content["position"])
    for kind, name in (("length", "position"), ("mass", "modal_mass")):
        if units.get(name):
            content[f"{kind}_unit"] = np.array(unit_of(kind, units[name], f"{path}: {name}: units"))
    unknown, length, mass = np.full(modes, np.nan), *map(content.get, ("length_unit", "mass_unit"))
    shapes: Real | Complex = content["shape"]
    if "shape_imag" in content:
        shapes = shapes + 1j * content["shape_imag"]
    names = content.get("point_name", np.arange(1, points + 1))
    return RawModes(
        frequencies=content["frequency"],
        damping=content.get("damping", unknown),
        modal_mass=content.get("modal_mass", unknown),
        names=tuple(_text(name) for name in names),
        points=content["position"],
        shapes=shapes,
        length_unit=None if length is None else float(length),
        mass_unit=None if mass is None else float(mass),
        complexity=content.get("phase_scatter"),
    )


def _text(name: object) -> str:
    return name.decode("utf-8", "replace") if isinstance(name, bytes) else str(name)


def write_netcdf(modes: ModeSet, path: Path) -> None:
    """Write a netCDF-4 file, from which the numbers are read back exactly."""
    import xarray

    values = {
        "frequency": modes.frequencies,
        "modal_mass": modes.modal_mass,
        "damping": modes.damping,
        "phase_scatter": modes.complexity,
        "position": modes.points,
        "shape": modes.shapes,
        "point_name": np.array(modes.names, dtype=object),
    }
    dataset = xarray.Dataset(
        {
            name: (_VARIABLES[name][0], value, {"units": _VARIABLES[name][1]})
            for name, value in values.items()
        },
        coords={"axis": ["x", "y", "z"]},
    )
    dataset.to_netcdf(path, engine="h5netcdf")
