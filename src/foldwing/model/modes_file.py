"""A file of modes computed or measured elsewhere, and how it is placed on a segment."""

from typing import Annotated

from foldwing.model.listed import Vector
from foldwing.model.quantities import Bounds, Length, Mass, Quantity
from foldwing.model.record import Record

Smoothing = Annotated[float, Quantity("a length", "m", '"1 mm"', Bounds(at_least=0.0))]


class ModesFile(Record):
    """Where the modes of a segment come from.

    Attributes
    ----------
    file : str
        Path.
    mass : float
        Of the segment in kg, taken as spread evenly over it.
    geometry : str
        Path of a bulk data file with the points, where the first has none; else empty.
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
    mass: Mass
    geometry: str = ""
    length_unit: Length | None = None
    mass_unit: Mass | None = None
    modal_mass: Mass | None = None
    origin: Vector = (0.0, 0.0, 0.0)
    x_axis: Vector = (1.0, 0.0, 0.0)
    y_axis: Vector = (0.0, 1.0, 0.0)
    smoothing: Smoothing = 0.0
