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
    told: dict[str, list[str]] = {}
    real: dict[str, list[str]] = {}
    for root in shown_roots(values):
        numbers = {name: float(column[root]) for name, column in columns.items()}
        mode, value = str(modes[root]), complex(values[root])
        told.setdefault(mode, [])
        if value.imag == 0.0:
            real.setdefault(mode, []).append(_grows(numbers))
        else:
            told[mode].append(_told(value, numbers))
    parts = [f"the {m} {text}" for m in told for text in (*told[m], *_aperiodic(real.get(m, [])))]
    speed = dataset.attrs.get("airspeed")
    where = "" if speed is None else f"At {speed:.4g} m/s "
    text = "; ".join(parts)
    margin = f" {_margin(float(dataset['static_margin']))}" if "static_margin" in dataset else ""
    return f"{where}{text}.{margin}" if where else f"{text[0].upper()}{text[1:]}.{margin}"


def _told(value: complex, numbers: dict[str, float]) -> str:
    """Return ``has a period of 26.9 s and a damping ratio of 0.0861``, or how it goes."""
    if value.real > 0.0:
        return f"is unstable: a period of {numbers['period']:.3g} s, and it {_grows(numbers)}"
    ratio = numbers["damping_ratio"]
    return f"has a period of {numbers['period']:.3g} s and a damping ratio of {ratio + 0.0:.3g}"


def _grows(numbers: dict[str, float]) -> str:
    """Return ``halves in 0.5 s`` and the like."""
    half, double = numbers["time_to_half"], numbers["time_to_double"]
    if not np.isfinite(half) and not np.isfinite(double):
        return "neither grows nor decays"
    return f"halves in {half:.3g} s" if np.isfinite(half) else f"doubles in {double:.3g} s"


def _aperiodic(roots: list[str]) -> list[str]:
    """Return the real roots of one mode in one sentence; none without any."""
    if not roots:
        return []
    if len(roots) == 1:
        return [f"has an aperiodic motion that {roots[0]}"]
    count = {2: "two", 3: "three", 4: "four"}[len(roots)]
    *others, last = (f"one {grows}" for grows in roots)
    return [f"does not oscillate but has {count} aperiodic motions: {', '.join(others)} and {last}"]


def _margin(margin: float) -> str:
    if margin >= 0.0:
        return f"The static margin is {100.0 * margin:.1f} % of the chord."
    return f"Statically unstable: the static margin is {100.0 * margin:.1f} % of the chord."
