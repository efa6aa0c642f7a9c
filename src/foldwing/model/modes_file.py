"""A file of modes computed or measured elsewhere, and how it is placed on a segment."""

from typing import Annotated

from foldwing.model.listed import Point, Vector
from foldwing.model.planform import Planform
from foldwing.model.quantities import Bounds, Length, Mass, Quantity
from foldwing.model.record import Record

Smoothing = Annotated[float, Quantity("a length", "m", '"1 mm"', Bounds(at_least=0.0))]


class ModesFile(Record):
    """Where the modes of a segment come from.

    Attributes
    ----------
    file : str
        Path.
    geometry : str
        Path of a bulk data file with the points, where the first has none; else empty.
    length_unit : float
        Of the file's points, in m.
    origin : tuple of float
        Origin of the segment's local axes in axes and unit of the file.
    x_axis, y_axis : tuple of float
        Directions aft and outboard in axes of the file.
    mass : float
        Of the segment in kg.
    centre : (float, float), optional
        Of its mass, local x and y in m; the centroid of the outline unless given.
    smoothing : float
        Of noisy shapes; 0 goes through every point.
    """

    file: str
    mass: Mass
    geometry: str = ""
    length_unit: Length = 1.0
    origin: Vector = (0.0, 0.0, 0.0)
    x_axis: Vector = (1.0, 0.0, 0.0)
    y_axis: Vector = (0.0, 1.0, 0.0)
    centre: Point | None = None
    smoothing: Smoothing = 0.0

    def centre_in(self, outline: Planform) -> tuple[float, float]:
        """Return the centre of mass, that of an even sheet unless given."""
        return outline.centroid if self.centre is None else self.centre
