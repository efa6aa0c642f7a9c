"""What flat pictures and scenes share when plotly draws them."""

from typing import Any

import numpy as np

from foldwing.plots.palette import SCALES

Json = dict[str, Any]


def base_layout() -> Json:
    """Return what every figure shares."""
    return {
        "autosize": True,
        "paper_bgcolor": "@paper",
        "plot_bgcolor": "@paper",
        "font": {"color": "@ink", "size": 12.5},
        "hovermode": "closest",
        "hoverlabel": {
            "bgcolor": "@paper",
            "bordercolor": "@muted",
            "font": {"color": "@ink"},
            "namelength": -1,
        },
    }


def color_scale(scale: str) -> list[list[Any]]:
    """Return the colours of a scale from low to high, as roles."""
    roles = SCALES[scale]
    return [[index / (len(roles) - 1), f"@{role}"] for index, role in enumerate(roles)]


def numbers(values: Any) -> Any:
    """Return nested lists with six significant digits and None for nan."""
    array = np.asarray(values, float)
    if array.ndim > 1:
        return [numbers(part) for part in array]
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in array.tolist()]
