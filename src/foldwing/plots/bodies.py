"""Centres of mass in a view in space: hollow at rest, filled where the motion takes them."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from foldwing.plots.picture import Array, Dot, Thread

if TYPE_CHECKING:
    import xarray

_COLORS = {"wing": "series2", "fuselage": "series5", "tail": "series3", "aircraft": "ink"}
_CARRIED = ("fuselage", "tail")
"""Bodies that a rigid line joins to the root."""
_SIZE = 5.5


def has_bodies(dataset: "xarray.Dataset") -> bool:
    """Return whether the centres of mass are known."""
    return "mass_centre" in dataset and "mass_centre_shape" in dataset


def mass_centres(
    dataset: "xarray.Dataset", rest: Array, moved: Array, roots: tuple[Array, Array]
) -> Iterator[Dot | Thread]:
    """Return the centres of mass and, of an aircraft, the lines that join them to the root.

    Parameters
    ----------
    dataset : xarray.Dataset
    rest, moved : array, shape (body, 3)
        In metres.
    roots : (array, array), each of shape (3,)
        Middle of the root at rest and moved.
    """
    names = [str(name) for name in dataset["body"].values]
    carried = [names.index(name) for name in _CARRIED if name in names]
    for places, root, look in (
        (rest, roots[0], ("muted", 0.9, 0.5)),
        (moved, roots[1], ("ink", 1.3, 1.0)),
    ):
        if carried:
            ends = np.array([*places[carried], root])
            yield Thread(ends[np.argsort(ends[:, 0])], *look)
    for index, name in enumerate(names):
        color = _COLORS.get(name, "ink")
        yield Dot(rest[index], color, filled=False, size=_SIZE)
        yield Dot(moved[index], color, filled=True, label=f"centre of mass: {name}", size=_SIZE)


def words(dataset: "xarray.Dataset") -> str:
    """Return a sentence on the marks; empty without any."""
    if not has_bodies(dataset):
        return ""
    if dataset.sizes["body"] == 1:
        return " Circle: the centre of mass, hollow at rest."
    return " Circles: centres of mass, hollow at rest; the line joins fuselage, root and tail."
