"""A file of modes computed or measured elsewhere, and how it is placed on a segment."""

from typing import Annotated

from foldwing.model.listed import Vector
from foldwing.model.quantities import Bounds, Length, Mass, Quantity
from foldwing.model.record import Record

Smoothing = Annotated[float, Quantity("a length", "m", '"1 mm"', Bounds(at_least=0.0))]


class ModesTable(Record):
    """Modes of the segment computed or measured elsewhere; ``file`` is found beside the model.

    Attributes
    ----------
    file : str
        Path.
    mass : float, optional
        Of the segment in kg, taken as spread evenly over it; that of its sheet unless given.
    geometry : str, optional
        Path of a bulk data file with the points, where the first has none.
    length_unit, mass_unit : float, optional
        Units of the file in m and kg; what the file says, else 1.
    modal_mass : float, optional
        Of every mode in the file's unit of mass, instead of those of the file.
    origin : tuple of float
        Origin of the segment's local axes in the axes of the file, in m.
    x_axis, y_axis : tuple of float
        Directions aft and outboard in the axes of the file.
    smoothing : float
        Of noisy shapes, in m; 0 goes through every point.
    """

    file: str
    mass: Mass | None = None
    geometry: str | None = None
    length_unit: Length | None = None
    mass_unit: Mass | None = None
    modal_mass: Mass | None = None
    origin: Vector = (0.0, 0.0, 0.0)
    x_axis: Vector = (1.0, 0.0, 0.0)
    y_axis: Vector = (0.0, 1.0, 0.0)
    smoothing: Smoothing = 0.0


class ModesFile(ModesTable):
    """The same, resolved: the mass is known, and paths are those of files that can be opened."""

    mass: Mass
