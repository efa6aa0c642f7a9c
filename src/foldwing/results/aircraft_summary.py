"""What a result says of an aircraft, in one line each."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.results.cases import fold_text
from foldwing.results.flutter_table import flutter_rows
from foldwing.stability.status import SHORT_PERIOD

if TYPE_CHECKING:
    import xarray

DIVERGENCE = "divergence"
"""Among the motions that are unstable from the start on: a real root, the aircraft pitches away."""


def statically_unstable(dataset: "xarray.Dataset") -> str:
    """Return which cases diverge at the lowest airspeed already, or nothing."""
    those = [index for index, names in enumerate(_from_start(dataset)) if DIVERGENCE in names]
    if not those:
        return ""
    text = "The aircraft diverges from the slowest level flight on: it is statically unstable"
    if dataset.sizes["fold"] == 1:
        return f"{text}. "
    return f"{text} in {len(those)} of {dataset.sizes['fold']} cases. "


def unstable_motions(dataset: "xarray.Dataset") -> str:
    """Return which oscillations of an aircraft are beyond the boundary from the start on."""
    lists = [[name for name in names if name != DIVERGENCE] for names in _from_start(dataset)]
    growing = [names for names in lists if names]
    if not growing:
        return ""
    names = " and ".join(dict.fromkeys(name for those in growing for name in those))
    total = dataset.sizes["fold"]
    cases = "" if total == 1 else f" in {len(growing)} of {total} cases"
    text = f"The {names} grows at the slowest level flight{cases}: listed, it bounds no airspeed."
    if dataset.attrs.get("trim") == "force":
        text += " Trim of forces alone leaves a moment that makes it grow; see --trim."
    return text


def elastic_from_start(dataset: "xarray.Dataset") -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
    """Return the number of unstable roots at the lowest airspeed less those of the aircraft."""
    counts: np.ndarray[tuple[int], np.dtype[np.int64]] = dataset["unstable_from_start"].values
    known = [
        sum(1 if name == DIVERGENCE else 2 for name in names) for names in _from_start(dataset)
    ]
    return np.asarray(counts - np.array(known or [0] * len(counts), np.int64))


def _from_start(dataset: "xarray.Dataset") -> list[list[str]]:
    """Return the motions of every case that are unstable at its lowest airspeed."""
    if "unstable_motions" not in dataset:
        return []
    texts = dataset["unstable_motions"].values.tolist()
    return [text.split(", ") if text else [] for text in texts]


def short_period(dataset: "xarray.Dataset") -> str:
    """Return from where on the short period of an aircraft grows, or nothing."""
    rows = [
        row
        for row in flutter_rows(dataset)
        if row.motion == SHORT_PERIOD and row.kind == "flutter" and row.event == "onset"
    ]
    if not rows:
        return ""
    first = min(rows, key=lambda row: row.speed)
    where = f" ({fold_text(dataset, first.case)})" if dataset.sizes["fold"] > 1 else ""
    text = f"The short period grows from {first.speed:.3g} m/s on at {first.frequency:.3g} Hz"
    return f"{text}{where}. It is listed but not called critical: see to it by control or trim."


def level_flight(dataset: "xarray.Dataset") -> str:
    """Return below which airspeed an aircraft needs more lift than there can be, or nothing."""
    if "slowest_speed" not in dataset:
        return ""
    slowest = dataset["slowest_speed"].values
    slowest = slowest[np.isfinite(slowest)]
    if not slowest.size:
        return ""
    low, high = f"{slowest.min():.3g}", f"{slowest.max():.3g}"
    span = f"{low} m/s" if low == high else f"{low} to {high} m/s, by fold angles,"
    largest = float(dataset["slowest_speed"].attrs["lift_coefficient"])
    return f"Level flight below {span} needs a lift coefficient above {largest:g}: out of reach."
