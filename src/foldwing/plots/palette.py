"""Colours by role for a light and a dark background, told apart with every kind of colour sight."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray

SERIES = 8
"""Number of colours for modes."""

# After Okabe and Ito (2008), darkened on white and lightened on black for contrast.
THEMES: Mapping[str, Mapping[str, str]] = {
    "light": {
        "paper": "#ffffff",
        "ink": "#1b1f24",
        "muted": "#5b6470",
        "grid": "#e4e7eb",
        "sheet": "#b9c0c9",
        "series0": "#0072b2",
        "series1": "#c14f00",
        "series2": "#007a5a",
        "series3": "#b0468a",
        "series4": "#2f9bd4",
        "series5": "#a67c00",
        "series6": "#31348f",
        "series7": "#7d4a2b",
        "divergence": "#7b3fb5",
        "unstable": "#d55e00",
        "warning": "#c8102e",
        "speed0": "#24418e",
        "speed1": "#199a8c",
        "speed2": "#e08214",
        "diverging0": "#1f66b0",
        "diverging1": "#eceef1",
        "diverging2": "#c0392b",
        "cycle0": "#22356f",
        "cycle1": "#2f9487",
        "cycle2": "#f0cc4d",
        "cycle3": "#b8456f",
    },
    "dark": {
        "paper": "#14171c",
        "ink": "#eceff3",
        "muted": "#a3adb9",
        "grid": "#2b313a",
        "sheet": "#6a7380",
        "series0": "#5ab4f0",
        "series1": "#ff8a4a",
        "series2": "#2ecc9b",
        "series3": "#ee8cc4",
        "series4": "#9ad8ff",
        "series5": "#f0c040",
        "series6": "#a0a4ff",
        "series7": "#d0a080",
        "divergence": "#c79bff",
        "unstable": "#ff8a4a",
        "warning": "#ff6470",
        "speed0": "#6f9bff",
        "speed1": "#45d6c2",
        "speed2": "#ffb347",
        "diverging0": "#62aef5",
        "diverging1": "#4a525e",
        "diverging2": "#ff8571",
        "cycle0": "#4459b8",
        "cycle1": "#45bfae",
        "cycle2": "#ffe28c",
        "cycle3": "#de6d9c",
    },
}


SCALES: Mapping[str, tuple[str, ...]] = {
    "speed": ("speed0", "speed1", "speed2"),
    "diverging": ("diverging0", "diverging1", "diverging2"),
    "cycle": ("cycle0", "cycle1", "cycle2", "cycle3", "cycle0"),
}
"""Roles of the colours of a scale from low to high; that of an angle ends as it starts."""


_RIGID = {
    "x": "muted", "z": "muted", "pitch": "muted", "phugoid": "ink", "short period": "muted",
}  # fmt: skip
"""Motions of an aircraft as a whole, so that its elastic modes have the colours of its wing's."""


def mode_colors(dataset: "xarray.Dataset") -> dict[str, str]:
    """Return a colour role for each name of a mode, the same in all pictures of a dataset."""
    names: list[str] = []
    if "mode_name" in dataset and dataset.sizes["fold"]:
        names += dataset["mode_name"].values[0].tolist()
    if "branch_name" in dataset:
        names += dataset["branch_name"].values.tolist()
    if "clamped_branch_name" in dataset:
        names += dataset["clamped_branch_name"].values.tolist()
    if "flutter_mode_name" in dataset:
        names += sorted(set(dataset["flutter_mode_name"].values.tolist()))
    apart = {name: "divergence" for name in names if name.startswith("D")} | _RIGID
    flutter = [name for name in dict.fromkeys(names) if name not in apart]
    colors = {name: f"series{index % SERIES}" for index, name in enumerate(flutter)}
    return colors | apart
