"""What pictures of an aircraft share: where it cannot fly level, and motions left out."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.picture import Area, Item, Range, Rule

if TYPE_CHECKING:
    import xarray

NEUTRAL = ("x", "z")
"""Motions at which nothing pulls: zero roots at every airspeed."""

OUT_OF_REACH = "too slow to carry the weight"


def without_neutral(dataset: "xarray.Dataset") -> "xarray.Dataset":
    """Return the dataset without the branches of the neutral motions."""
    names = dataset["branch_name"].values
    kept = np.flatnonzero(~np.isin(names, NEUTRAL))
    return dataset if len(kept) == len(names) else dataset.isel(mode=kept)


def slowest(dataset: "xarray.Dataset") -> float:
    """Return the lowest airspeed of level flight of the first case; nan of a clamped wing."""
    return float(dataset["slowest_speed"][0]) if "slowest_speed" in dataset else np.nan


def out_of_reach(dataset: "xarray.Dataset", limits: Range, y_range: Range) -> list[Item]:
    """Return the hatched part of a panel where the aircraft cannot fly level; none elsewhere."""
    end = slowest(dataset)
    if not end > limits[0]:
        return []
    right = min(end, limits[1])
    x = np.array([limits[0], right, right, limits[0]])
    y = np.repeat(np.array(y_range), 2)
    items: list[Item] = [Area(x, y, "muted", 0.09, OUT_OF_REACH, hatched=True)]
    return [*items, Rule(end, "x", "muted", width=1.2)] if end < limits[1] else items


def neutral_words(dataset: "xarray.Dataset") -> str:
    """Return a sentence on what is left out; empty for a clamped wing."""
    if "slowest_speed" not in dataset:
        return ""
    return " Left out: the motions x and z, at which nothing pulls (zero at every airspeed)."


def reach_words(dataset: "xarray.Dataset") -> str:
    """Return a sentence on the hatched airspeeds and the curves there; empty without any."""
    end = slowest(dataset)
    if not end > float(dataset["speed"][0]):
        return ""
    largest = float(dataset["slowest_speed"].attrs["lift_coefficient"])
    text = f" Hatched: below {end:.3g} m/s level flight needs a lift coefficient above {largest:g}"
    if end >= float(dataset.attrs.get("speed_limit", np.inf)):
        return f"{text} and is out of reach; the curves stand for none."
    return f"{text}; the curves there are with the lift that this one gives."
