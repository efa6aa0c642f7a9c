"""Datasets and tables on disk: netCDF (complex numbers as pairs of real ones) and CSV."""

import csv
import math
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.flutter_table import flutter_rows
from foldwing.results.schema import case_names
from foldwing.results.variables import COORDINATES, VARIABLES

if TYPE_CHECKING:
    import xarray

DATASET_FILE = "dataset.nc"
"""Name of the dataset in a result folder."""

POINT_COLUMNS = (
    "kind",
    "event",
    "class",
    "speed",
    "frequency",
    "strength",
    "branch",
    "mode_name",
    "mode_confidence",
    "threshold",
    "motion",
)
"""Columns of the table of flutter points after ``case`` and the fold angles."""

_PARTS = ("_real", "_imag")


def write_dataset(dataset: "xarray.Dataset", path: Path) -> None:
    """Write a dataset as netCDF; `read_dataset` gives it back unchanged."""
    _split_complex(dataset).to_netcdf(path, engine="h5netcdf")


def read_dataset(path: Path) -> "xarray.Dataset":
    """Read a dataset that `write_dataset` wrote."""
    import xarray

    stored = xarray.load_dataset(path, engine="h5netcdf", decode_times=False)
    return _plain(_join_complex(stored))


def write_csv(dataset: "xarray.Dataset", path: Path) -> None:
    """Write the table of flutter points; numbers in full precision, empty for nan."""
    named = case_names(dataset)
    ratios = [name for name in ("speed_ratio", "frequency_ratio") if name in dataset]
    body = (
        (
            row.case,
            *(float(dataset[name][row.case]) for name in named),
            *(_field(row, column) for column in POINT_COLUMNS),
            *(float(dataset[name][point]) for name in ratios),
        )
        for point, row in enumerate(flutter_rows(dataset))
    )
    write_table(path, ("case", *named, *POINT_COLUMNS, *ratios), body)


def write_frequencies_csv(dataset: "xarray.Dataset", path: Path) -> None:
    """Write the natural frequencies: one line for each case and mode."""
    angles = case_names(dataset)
    columns = [
        name
        for name in ("mode_name", "natural_frequency", "mode_confidence", "bending_share")
        if name in dataset
    ]
    body = (
        (
            case,
            *(float(dataset[name][case]) for name in angles),
            mode + 1,
            *(dataset[name].values[case, mode].item() for name in columns),
        )
        for case in range(dataset.sizes["fold"])
        for mode in range(dataset.sizes["mode"])
    )
    write_table(path, ("case", *angles, "mode", *columns), body)


def write_convergence_csv(dataset: "xarray.Dataset", folder: Path) -> None:
    """Write a convergence study: ``convergence.csv`` with orders, ``levels.csv`` with speeds.

    Both have one line for each setting (or level) and flutter point; ``point`` counts the lines of
    the table of flutter points from 0.
    """
    points = range(dataset.sizes["flutter_point"])
    columns = ("convergence", "order", "limit_speed", "error_speed")
    orders = (
        (name, point, *(dataset[column].values[index, point].item() for column in columns))
        for index, name in enumerate(dataset["setting"].values.tolist())
        for point in points
    )
    write_table(folder / "convergence.csv", ("setting", "point", *columns), orders)
    fixed = ("setting", "value", "own")
    varying = ("speed", "frequency", "likeness")
    levels = (
        (
            *(dataset[f"level_{name}"].values[level].item() for name in fixed),
            point,
            *(dataset[f"level_{name}"].values[level, point].item() for name in varying),
        )
        for level in range(dataset.sizes["level"])
        for point in points
    )
    write_table(folder / "levels.csv", (*fixed, "point", *varying), levels)


def _field(row: Any, column: str) -> Any:
    return getattr(row, "classification" if column == "class" else column)


def write_table(path: Path, head: Iterable[str], body: Iterable[Iterable[Any]]) -> None:
    """Write a CSV file: a line of names, then numbers in full precision, empty for nan."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows([_cell(value) for value in line] for line in body)


def _cell(value: Any) -> Any:
    if not isinstance(value, float):
        return value
    return "" if math.isnan(value) else value + 0.0  # -0.0 becomes 0.0


def _split_complex(dataset: "xarray.Dataset") -> "xarray.Dataset":
    split = dataset.copy(deep=False)
    for name, variable in dataset.data_vars.items():
        if variable.dtype.kind == "c":
            real, imaginary = (f"{name}{part}" for part in _PARTS)
            split = split.drop_vars([name]).assign(
                {real: variable.real.copy(), imaginary: variable.imag.copy()}
            )
            split[real].attrs = split[imaginary].attrs = dict(variable.attrs)
    return split


def _join_complex(dataset: "xarray.Dataset") -> "xarray.Dataset":
    joined = dataset
    for name, row in VARIABLES.items():
        real, imaginary = (f"{name}{part}" for part in _PARTS)
        if row.dtype == "complex" and real in dataset:
            values = np.empty(dataset[real].shape, np.complex128)
            values.real, values.imag = dataset[real].values, dataset[imaginary].values
            whole = (dataset[real].dims, values, dataset[real].attrs)
            joined = joined.drop_vars([real, imaginary]).assign({name: whole})
    return joined


def _plain(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Text as numpy strings, and no trace of how the file was encoded."""
    known = (*VARIABLES.values(), *COORDINATES.values())
    texts = [row.name for row in known if row.dtype == "text" and row.name in dataset.variables]
    plain = dataset.assign({name: dataset[name].astype(np.str_) for name in texts})
    return plain.drop_encoding()
