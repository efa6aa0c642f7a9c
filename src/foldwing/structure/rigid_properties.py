"""Mass, centre and moments of inertia of a segment that moves as a rigid body in its plane."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Planform
from foldwing.structure.in_plane import in_plane_mass


@dataclass(frozen=True)
class RigidProperties:
    """A thin body in the local axes of a segment.

    Attributes
    ----------
    mass : float
        kg.
    centre : (float, float)
        x and y of the mass centre in m.
    Ixx, Iyy, Ixy : float
        Integrals of y^2, x^2 and x y over the mass, about the local origin, in kg m^2.

    Raises
    ------
    InputError
        When no distribution of mass has these properties.
    """

    mass: float
    centre: tuple[float, float]
    Ixx: float
    Iyy: float
    Ixy: float

    def __post_init__(self) -> None:
        values = (self.mass, *self.centre, self.Ixx, self.Iyy, self.Ixy)
        if not (np.all(np.isfinite(values)) and self.mass > 0.0):
            limit = "must be finite, with a mass greater than 0 kg"
            raise InputError("body", values, limit, "Give mass, centre, Ixx, Iyy and Ixy.")
        about_centre = np.array(
            [[self.Ixx, self.Ixy], [self.Ixy, self.Iyy]]
        ) - self.mass * np.outer(self.centre[::-1], self.centre[::-1])
        least = float(np.linalg.eigvalsh(about_centre)[0])
        if least <= 1e-12 * (self.Ixx + self.Iyy):
            limit = "least moment of inertia about the mass centre must be greater than 0 kg m^2"
            remedy = "Ixx, Iyy and Ixy are taken about the local origin: Ixx is that of y^2."
            raise InputError("body", least, limit, remedy)

    @cached_property
    def out_of_plane_mass(self) -> Real:
        """Mass matrix of the motions w = 1, y, -x, shape (3, 3)."""
        m, (x, y) = self.mass, self.centre
        return np.array(
            [
                [m, m * y, -m * x],
                [m * y, self.Ixx, -self.Ixy],
                [-m * x, -self.Ixy, self.Iyy],
            ]
        )

    @cached_property
    def in_plane_mass(self) -> Real:
        """Mass matrix of translation along x and y and of yaw about the origin, shape (3, 3)."""
        m, (x, y) = self.mass, self.centre
        return in_plane_mass(m, m * x, m * y, self.Ixx + self.Iyy)


def uniform_sheet(planform: Planform, mass_per_area: float) -> RigidProperties:
    """Return the properties of a sheet of the same mass per area (kg/m^2) everywhere.

    The moments of the polygon are exact.
    """
    points, weights = area_rule(planform, 3)
    x, y = points.T
    dm = mass_per_area * weights
    mass = float(dm.sum())
    return RigidProperties(
        mass=mass,
        centre=(float(dm @ x) / mass, float(dm @ y) / mass),
        Ixx=float(dm @ y**2),
        Iyy=float(dm @ x**2),
        Ixy=float(dm @ (x * y)),
    )


def area_rule(planform: Planform, points: int) -> tuple[Real, Real]:
    """Return points (m, 2) and weights (m,) of quadrature over an outline.

    A fan of triangles from the first corner, with signs where the outline is not convex, and a
    product of Gauss rules on each: exact for polynomials of degree 2 ``points`` - 2.
    """
    nodes, weights = gauss_rule(1.0, points)
    apex, corners = planform.array[0], planform.array[1:]
    to_first, to_second = corners[:-1] - apex, corners[1:] - apex
    s, t = (grid.ravel() for grid in np.meshgrid(nodes, nodes, indexing="ij"))
    share = np.outer(weights, weights).ravel() * s
    along = (1.0 - t)[:, None, None] * to_first + t[:, None, None] * to_second
    at = apex + s[:, None, None] * along
    # Outlines run clockwise seen from above.
    twice = to_second[:, 0] * to_first[:, 1] - to_second[:, 1] * to_first[:, 0]
    return at.reshape(-1, 2), np.outer(share, twice).ravel()
