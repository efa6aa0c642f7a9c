"""Where the real and the imaginary part of the determinant vanish: their crossings are roots."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.layout import subtitle
from foldwing.plots.picture import (
    Area,
    Array,
    Dash,
    Item,
    Line,
    Marks,
    Note,
    Panel,
    Picture,
    Rule,
    ZeroLine,
)
from foldwing.results.cases import fold_text

if TYPE_CHECKING:
    import xarray


def determinant_contours(dataset: "xarray.Dataset") -> Picture | None:
    """Draw both families of zero lines and mark their crossings."""
    if "determinant" not in dataset:
        return None
    growth = dataset["contour_growth"].values
    frequency = dataset["contour_frequency"].values
    z = dataset["determinant"].values
    x, y = crossings(growth, frequency, z)
    hover = [f"growth {a:.4g} 1/s<br>{b:.4g} Hz" for a, b in zip(x, y, strict=True)]
    x_range = (float(growth[0]), float(growth[-1]))
    y_range = (float(frequency[0]), float(frequency[-1]))
    items: list[Item] = [
        ZeroLine(growth, frequency, z.real.T, "series0", "solid", "real part is zero"),
        *_imaginary_zero(growth, frequency, z.imag),
        Marks(x, y, "ring", "ink", "both are zero: an eigenvalue", 8, hover),
    ]
    if x_range[0] < 0 < x_range[1]:
        right = np.array([0.0, x_range[1], x_range[1], 0.0])
        corner = Note(
            x_range[1], y_range[1], "unstable", "unstable", "right", "top", -4, -4, bold=True
        )
        tint = Area(right, np.repeat(y_range, 2), "unstable", 0.1)
        items = [tint, Rule(0.0, "x", "ink", width=1.2), *items, corner]
    speed = dataset["determinant"].attrs.get("speed")
    at = f" at {float(speed):.4g} m/s" if speed is not None else ""
    return Picture(
        "determinant",
        f"Eigenvalues{at} lie where both parts of the determinant are zero",
        subtitle(dataset, fold_text(dataset, 0)) + ". A crossing in the shaded half is a motion "
        "that grows.",
        [Panel("growth rate (1/s)", "frequency (Hz)", items, x_range, y_range, height=1.8)],
    )


def _imaginary_zero(growth: Array, frequency: Array, part: Array) -> list[Item]:
    """Without the real axis, all of which is a zero line with nothing but rounding around it."""
    look: tuple[str, Dash, str] = ("series1", "dash", "imaginary part is zero")
    if frequency[0] != 0:
        return [ZeroLine(growth, frequency, part.T, *look)]
    axis = Line(growth[[0, -1]], np.zeros(2), *look[:2])
    return [ZeroLine(growth, frequency[1:], part[:, 1:].T, *look), axis]


def crossings(x: Array, y: Array, z: Array) -> tuple[Array, Array]:
    """Return the points where both parts of ``z``, linear in triangles, are zero.

    Parameters
    ----------
    x, y : array, shapes (n,) and (m,)
    z : array of complex, shape (n, m)
    """
    i, j = (index.ravel() for index in np.indices((len(x) - 1, len(y) - 1)))
    found = [
        _in_triangles(x, y, z, (i + a, j + a), (i + 1 - a, j + a), (i + a, j + 1 - a))
        for a in (0, 1)
    ]
    points = np.concatenate(found)
    size = np.array([np.ptp(x), np.ptp(y)])
    _, kept = np.unique(np.round(points / size, 6), axis=0, return_index=True)
    return points[kept, 0], points[kept, 1]


def _in_triangles(x: Array, y: Array, z: Array, *corners: tuple[Array, Array]) -> Array:
    """Return the zeros of z inside the triangles, shape (found, 2)."""
    xy = [np.stack([x[i], y[j]], axis=1) for i, j in corners]
    z0, z1, z2 = (z[i, j] for i, j in corners)
    e1, e2 = z1 - z0, z2 - z0
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = (e1.conj() * e2).imag
        s = -(z0.conj() * e2).imag / cross
        t = (z0.conj() * e1).imag / cross
        inside = (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9)
    s, t = s[inside, None], t[inside, None]
    origin = xy[0][inside]
    found: Array = origin + s * (xy[1][inside] - origin) + t * (xy[2][inside] - origin)
    return found
