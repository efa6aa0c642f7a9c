"""Where the lowest onset of a section goes over to another curve, in words."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.results.units import units_of

if TYPE_CHECKING:
    import xarray


def changes_text(dataset: "xarray.Dataset") -> str:
    """Return in a sentence each where the lowest onset changes; empty when it does not."""
    units = units_of(dataset)
    texts = []
    for change in range(dataset.sizes.get("change", 0)):
        ratio = float(dataset["change_torsion_ratio"][change])
        speed = dataset["change_speed"].values[change]
        sides = [
            _side(value, hertz, units.frequency)
            for value, hertz in zip(speed, dataset["change_frequency"].values[change], strict=True)
        ]
        at = f" At a torsion frequency ratio of {ratio:.6g} the lowest onset"
        if dataset["change_kind"].values[change] == "jump":
            values = [f"{v:.4g} {units.speed}" if np.isfinite(v) else "none" for v in speed]
            texts.append(f"{at} jumps from {values[0]} ({sides[0]}) to {values[1]} ({sides[1]}).")
        else:
            motion = f"goes over from {sides[0]} to {sides[1]}"
            texts.append(f"{at} {motion}, both at {speed[0]:.4g} {units.speed}.")
    return "".join(texts)


def _side(speed: float, frequency: float, unit: str) -> str:
    if not np.isfinite(speed):
        return "stable"
    return f"flutter with {frequency:.3g} {unit}" if frequency else "divergence"
