"""Where the axes of a file stand in the plane of a segment."""

from dataclasses import dataclass

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real

_SQUARE = 1e-6
"""Cosine that two perpendicular axes may have."""


@dataclass(frozen=True)
class Placement:
    """The local axes of a segment, described in the axes of a file.

    Attributes
    ----------
    origin : (float, float, float)
        Where the origin of the segment is, in the file's axes and in m.
    x_axis, y_axis : (float, float, float)
        Directions aft and outboard in the file's axes, perpendicular, of any length; the segment's
        normal, up, is x_axis cross y_axis.
    scale : float
        Factor by which lengths are multiplied, after the unit: for a model of another size.
        Displacements are not scaled.

    Raises
    ------
    InputError
        When the axes are no perpendicular directions or the scale is not above 0.
    """

    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    x_axis: tuple[float, float, float] = (1.0, 0.0, 0.0)
    y_axis: tuple[float, float, float] = (0.0, 1.0, 0.0)
    scale: float = 1.0

    def __post_init__(self) -> None:
        for name in ("origin", "x_axis", "y_axis"):
            vector = np.asarray(getattr(self, name), float)
            if vector.shape != (3,) or not np.all(np.isfinite(vector)):
                limit = "must be three finite numbers"
                raise InputError(f"placement.{name}", getattr(self, name), limit, "Write x, y, z.")
        lengths = [float(np.linalg.norm(axis)) for axis in (self.x_axis, self.y_axis)]
        if min(lengths) == 0.0 or abs(np.dot(self.x_axis, self.y_axis)) > _SQUARE * np.prod(
            lengths
        ):
            limit = "must be two perpendicular directions"
            remedy = "Give the directions aft and outboard, for example (1, 0, 0) and (0, 1, 0)."
            raise InputError("placement axes", (self.x_axis, self.y_axis), limit, remedy)
        if not (np.isfinite(self.scale) and self.scale > 0.0):
            limit = "must be finite and greater than 0"
            raise InputError("placement.scale", self.scale, limit, "Leave it out for 1.")

    @property
    def _axes(self) -> Real:
        x, y = (np.asarray(a, float) / np.linalg.norm(a) for a in (self.x_axis, self.y_axis))
        return np.stack([x, y, np.cross(x, y)])

    def points(self, points: Real) -> Real:
        """Return local positions of points (k, 3) of the file."""
        return np.asarray(self.scale * (points - np.asarray(self.origin, float)) @ self._axes.T)

    def vectors(self, vectors: Real) -> Real:
        """Return displacements (..., 3) of the file in local axes."""
        return np.asarray(vectors @ self._axes.T)
