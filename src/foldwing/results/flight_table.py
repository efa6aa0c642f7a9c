"""Flight of a rigid aircraft as tables: for the terminal and the report, and as CSV files."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.flight_summary import PER_ROOT, shown_roots
from foldwing.results.steady_table import Table
from foldwing.results.writing import write_table

if TYPE_CHECKING:
    import xarray

_DERIVATIVES = (("X_u", "Z_u", "M_u"), ("X_w", "Z_w", "M_w"), ("", "Z_q", "M_q"))
_LINES = ("u, m/s", "w, m/s", "q, rad/s")
_MODES = ("phugoid", "short period", "third oscillation")


def modes_table(dataset: "xarray.Dataset") -> Table:
    """Return the motions of the four states with all that is told of them."""
    heads = ("mode", "Eigenvalue 1/s", "Period s", "Damping", "Half s", "Double s", "Cycles")
    first = dataset.isel(flight_model=0)
    rows = []
    for root in shown_roots(first["flight_eigenvalue"].values):
        numbers = (float(first[f"flight_{name}"][root]) for name in PER_ROOT)
        value = complex(first["flight_eigenvalue"].values[root])
        mode = str(first["flight_mode"].values[root])
        rows.append((mode, _pair(value), *(_text(number) for number in numbers)))
    return Table(heads, rows)


def models_table(dataset: "xarray.Dataset") -> Table:
    """Return the eigenvalues of all models beside each other."""
    values, modes = dataset["flight_eigenvalue"].values, dataset["flight_mode"].values
    kept = _modes_of(modes)
    heads = ("model", *(f"{mode.capitalize()} 1/s" for mode in kept))
    rows = [
        (name, *(_mode_text(values[at], modes[at], mode) for mode in kept))
        for at, name in enumerate(dataset["flight_model"].values.tolist())
        if modes[at].any()
    ]
    return Table(heads, rows)


def derivatives_table(dataset: "xarray.Dataset") -> Table:
    """Return forces and moments per velocity and pitch rate."""
    rows = [
        (line, *(_text(float(dataset[name])) if name else "" for name in names))
        for line, names in zip(_LINES, _DERIVATIVES, strict=True)
    ]
    return Table(("per", "X N", "Z N", "M N m"), rows)


def speeds_table(dataset: "xarray.Dataset") -> Table:
    """Return the eigenvalues of all models at every airspeed."""
    values, modes = dataset["swept_eigenvalue"].values, dataset["swept_mode"].values
    product, lift = dataset["phugoid_product"].values, dataset["swept_lift_coefficient"].values
    kept = _modes_of(modes)
    heads = ("U m/s", "CL", "model", *(f"{mode.capitalize()} 1/s" for mode in kept), "ωU m/s²")
    rows = []
    for speed, airspeed in enumerate(dataset["speed"].values.tolist()):
        for at, name in enumerate(dataset["flight_model"].values.tolist()):
            if modes[at, speed].any():
                pairs = (_mode_text(values[at, speed], modes[at, speed], mode) for mode in kept)
                number = _text(float(product[at, speed]))
                rows.append((f"{airspeed:g}", _text(lift[speed]), name, *pairs, number))
    return Table(heads, rows)


def trim_text(dataset: "xarray.Dataset") -> str:
    """Return trim and static margin in a sentence; empty unless wing and tail are known."""
    if "static_margin" not in dataset:
        return ""
    lift, drag = (float(dataset[f"trim_{name}_coefficient"]) for name in ("lift", "drag"))
    ratio = f", L/D = {lift / drag:.3g}" if drag else ""
    margin, neutral = float(dataset["static_margin"]), float(dataset["neutral_point"])
    return (
        f"Level flight: CL = {lift:.4g}, CD = {drag:.4g}{ratio}. Static margin "
        f"{100.0 * margin:.1f} % of the chord; neutral point {neutral:.3g} m aft of the wing's "
        "quarter chord."
    )


def _modes_of(modes: Any) -> list[str]:
    return [mode for mode in _MODES if (modes == mode).any()]


def _mode_text(values: Any, modes: Any, mode: str) -> str:
    places = [place for place in shown_roots(values) if modes[place] == mode]
    return ", ".join(_pair(complex(values[place])) for place in places)


def _pair(value: complex) -> str:
    """Return ``-0.0201 ± 0.233i``, or a real number."""
    if value.imag == 0.0:
        return _text(value.real)
    return f"{_text(value.real)} ± {_text(value.imag)}i"


def _text(value: float) -> str:
    return f"{value + 0.0:.4g}" if np.isfinite(value) else "-"


def write_flight_csv(dataset: "xarray.Dataset", folder: Path) -> None:
    """Write ``flight_modes.csv``, ``flight_paths.csv`` and, of a sweep, ``flight_speeds.csv``."""
    heads = ("model", "mode", "real", "imag")
    write_table(folder / "flight_modes.csv", (*heads, *PER_ROOT), _mode_lines(dataset))
    if "path_time" in dataset:
        columns = ("time", "distance", "ahead", "altitude", "pitch")
        lines = _path_lines(dataset, columns)
        write_table(folder / "flight_paths.csv", ("motion", "mode", *columns), lines)
    if "swept_eigenvalue" in dataset:
        lines = _speed_lines(dataset)
        write_table(folder / "flight_speeds.csv", ("speed", *heads, "phugoid_product"), lines)


def _mode_lines(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    values, modes = dataset["flight_eigenvalue"].values, dataset["flight_mode"].values
    for at, name in enumerate(dataset["flight_model"].values.tolist()):
        for root in shown_roots(values[at]):
            value = complex(values[at, root])
            numbers = (float(dataset[f"flight_{n}"].values[at, root]) for n in PER_ROOT)
            yield (name, str(modes[at, root]), value.real, value.imag, *numbers)


def _speed_lines(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    values, modes = dataset["swept_eigenvalue"].values, dataset["swept_mode"].values
    product = dataset["phugoid_product"].values
    for speed, airspeed in enumerate(dataset["speed"].values.tolist()):
        for at, name in enumerate(dataset["flight_model"].values.tolist()):
            for root in shown_roots(values[at, speed]):
                value, mode = complex(values[at, speed, root]), str(modes[at, speed, root])
                number = float(product[at, speed]) if mode == _MODES[0] else float("nan")
                yield (airspeed, name, mode, value.real, value.imag, number)


def _path_lines(dataset: "xarray.Dataset", columns: Sequence[str]) -> Iterator[Sequence[Any]]:
    modes = dataset["motion_mode"].values.tolist()
    for motion, number in enumerate(dataset["flight_motion"].values.tolist()):
        values = (dataset[f"path_{name}"].values[motion].tolist() for name in columns)
        for line in zip(*values, strict=True):
            yield (number, modes[motion], *line)
