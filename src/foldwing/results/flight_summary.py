"""What the flight of a rigid aircraft is like, in one line."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray

PER_ROOT = ("period", "damping_ratio", "time_to_half", "time_to_double", "cycles")
"""What is told of an eigenvalue; in the dataset their names begin with ``flight_``."""


def shown_roots(values: Any) -> Iterator[int]:
    """Yield the places of the eigenvalues of one model, a pair once."""
    for place, value in enumerate(values):
        if np.isfinite(value) and value.imag >= 0.0:
            yield place


def flight_answer(dataset: "xarray.Dataset") -> str:
    """Return what the motions of the four states are like in one line."""
    first = dataset.isel(flight_model=0)
    modes, values = first["flight_mode"].values, first["flight_eigenvalue"].values
    columns = {name: first[f"flight_{name}"].values for name in PER_ROOT}
    parts = []
    for root in shown_roots(values):
        numbers = {name: float(column[root]) for name, column in columns.items()}
        parts.append(f"the {modes[root]} {_told(complex(values[root]), numbers)}")
    speed = dataset.attrs.get("airspeed")
    where = "" if speed is None else f"At {speed:.4g} m/s "
    text = "; ".join(parts)
    margin = f" {_margin(float(dataset['static_margin']))}" if "static_margin" in dataset else ""
    return f"{where}{text}.{margin}" if where else f"{text[0].upper()}{text[1:]}.{margin}"


def _told(value: complex, numbers: dict[str, float]) -> str:
    """Return ``has a period of 26.9 s and a damping ratio of 0.0861``, or how it goes."""
    half, double = numbers["time_to_half"], numbers["time_to_double"]
    if not np.isfinite(half) and not np.isfinite(double):
        grows = "neither grows nor decays"
    else:
        grows = f"halves in {half:.3g} s" if np.isfinite(half) else f"doubles in {double:.3g} s"
    if value.imag == 0.0:
        return f"has an aperiodic motion that {grows}"
    if value.real > 0.0:
        return f"is unstable: a period of {numbers['period']:.3g} s, and it {grows}"
    ratio = numbers["damping_ratio"]
    return f"has a period of {numbers['period']:.3g} s and a damping ratio of {ratio + 0.0:.3g}"


def _margin(margin: float) -> str:
    if margin >= 0.0:
        return f"The static margin is {100.0 * margin:.1f} % of the chord."
    return f"Statically unstable: the static margin is {100.0 * margin:.1f} % of the chord."
