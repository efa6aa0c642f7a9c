"""Cases in words: their fold angles."""

from typing import TYPE_CHECKING

from foldwing.results.schema import fold_angle_names

if TYPE_CHECKING:
    import xarray


def fold_text(dataset: "xarray.Dataset", case: int) -> str:
    """Return the fold angles of a case, e.g. ``fold 30°, −30°``; empty without hinges."""
    angles = [float(dataset[name][case]) for name in fold_angle_names(dataset)]
    if "torsion_frequency_ratio" in dataset.coords:
        return f"torsion frequency ratio {float(dataset['torsion_frequency_ratio'][case]):.4g}"
    if not angles:
        return "" if dataset.sizes["fold"] == 1 else f"case {case}"
    return "fold " + ", ".join(degrees(angle) for angle in angles)


def degrees(angle: float) -> str:
    """Return an angle as text, e.g. ``−30°``."""
    return f"{angle + 0.0:g}°".replace("-", "−")
