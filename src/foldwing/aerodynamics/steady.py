"""Steady vortex lattice: circulation of a wing of any shape at a small angle of attack.

No flow passes through the wing, A g = wash, with g = circulation / U at the bound vortices. For an
angle of attack alpha the wash of a panel is -alpha n_z: the stream meets its lower side. Loads are
those of Kutta and Joukowski, at right angles to the stream; everything but the drag is linear in
alpha.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.aerodynamics.panels import Panels
from foldwing.aerodynamics.trefftz import drag_form, least_drag
from foldwing.maths.arrays import Real


@dataclass(frozen=True)
class SteadyLattice:
    """A solved lattice. Forces are those of these panels alone, never of their image.

    Attributes
    ----------
    panels : Panels
        n panels on s strips.
    circulation : array, shape (n,)
        Circulation of the bound vortices per airspeed in metres; positive lifts along the normal.
    image : bool
        Whether the plane y = 0 mirrors the flow.
    """

    panels: Panels
    circulation: Real
    image: bool = False

    def scaled(self, factor: float) -> "SteadyLattice":
        """Return the lattice in a wash that is larger by ``factor``."""
        return SteadyLattice(self.panels, factor * self.circulation, self.image)

    @cached_property
    def by_strip(self) -> Real:
        """Circulation of the strips per airspeed in metres, shape (s,)."""
        return self.panels.by_strip(self.circulation)

    @cached_property
    def forces(self) -> Real:
        """Force on each panel per rho U^2, shape (n, 3), in m^2."""
        return np.asarray(self.circulation[:, None] * self.panels.force_per_circulation())

    @cached_property
    def places(self) -> Real:
        """Where the forces act: the middles of the bound vortices, shape (n, 3)."""
        return (self.panels.inner + self.panels.outer) / 2.0

    @property
    def total(self) -> Real:
        """Force on the wing per rho U^2, shape (3,): 0, side force, lift."""
        return np.asarray(self.forces.sum(axis=0))

    def moment(self, about: Real) -> Real:
        """Return the moment of all forces about a point per rho U^2, shape (3,), in m^3.

        About x it is positive when it lifts the outboard part, about y when it is nose up.
        """
        return np.asarray(np.cross(self.places - about, self.forces).sum(axis=0))

    @cached_property
    def local_lift_coefficient(self) -> Real:
        """Normal force of each strip per dynamic pressure and area, shape (s,)."""
        return np.asarray(2.0 * self.by_strip / self.panels.chord)

    @cached_property
    def _drag_form(self) -> Real:
        return drag_form(self.panels, self.image)

    @property
    def induced_drag(self) -> float:
        """Induced drag per rho U^2, in m^2."""
        return float(self.by_strip @ self._drag_form @ self.by_strip)

    @cached_property
    def least_drag(self) -> float:
        """Least induced drag of this shape for this lift per rho U^2; nan when not known."""
        lift = self.panels.width * self.panels.normals[: self.panels.strips, 2]
        return least_drag(self._drag_form, lift) * float(self.total[2]) ** 2

    @property
    def efficiency(self) -> float:
        """Least drag of this shape for this lift over the induced drag, at most 1; nan at rest."""
        drag = self.induced_drag
        return self.least_drag / drag if drag > 0.0 else float("nan")


def solve_steady(panels: Panels, wash: Real, image: bool = False) -> SteadyLattice:
    """Return the lattice whose vortices give a normal wash at the collocation points.

    Parameters
    ----------
    panels : Panels
    wash : array, shape (n,)
        Normal velocity of the wing's surface relative to the air, per airspeed, along the normals.
    image : bool
        Whether the plane y = 0 mirrors the flow.
    """
    return SteadyLattice(panels, np.linalg.solve(panels.influence(image), wash), image)


def at_unit_angle(panels: Panels, image: bool = False) -> SteadyLattice:
    """Return the lattice at an angle of attack of 1 rad; loads are linear in the angle."""
    return solve_steady(panels, -panels.normals[:, 2], image)


def lift_slope(unit: SteadyLattice, area: float) -> float:
    """Return the slope of the lift coefficient per radian, on ``area`` in m^2.

    Parameters
    ----------
    unit : SteadyLattice
        Of `at_unit_angle`.
    area : float
        Reference area.
    """
    return 2.0 * float(unit.total[2]) / area
