"""Steady level flight: how much lift each segment and the tail carry.

The angle of attack alpha of the aircraft gives segment i, turned by Psi_i, the incidence
alpha cos Psi_i and the vertical lift of its normal force times cos Psi_i, so that

    U^2 alpha sum of s_i = W        s_i: vertical lift per U^2 and radian.

Since alpha U^2 is the same at every airspeed, so are all lifts. With trim of the moment as well the
tail carries what keeps the pitching moment about the centre of gravity zero.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real

LEAST_SLOPE = 1e-9
"""Vertical lift per radian, relative to that of the flat wing, below which no trim exists."""


@dataclass(frozen=True)
class LiftingSurfaces:
    """Steady lift of every segment and of the tail at 1 rad and unit airspeed.

    Attributes
    ----------
    slope : array, shape (s,)
        Vertical lift of each segment and, last, of the tail, in N per rad and (m/s)^2.
    flat : array, shape (s,)
        The same of the flat wing, by which the slopes are judged.
    place : array, shape (s,)
        Where it acts aft of the elastic axis of segment 1, in metres.
    area : array, shape (s,)
        m^2.
    cosine : array, shape (s,)
        Of the angle of each segment to the horizontal.
    """

    slope: Real
    flat: Real
    place: Real
    area: Real
    cosine: Real


@dataclass(frozen=True)
class Trim:
    """Level flight of the half aircraft.

    Attributes
    ----------
    incidence : float
        Angle of attack of the wing times U^2, in rad (m/s)^2.
    tail_incidence : float
        The same of the tail, which may be set apart.
    weight : float
        N.
    surfaces : LiftingSurfaces
    density : float
        Of the air in kg/m^3.
    largest : float
        What a lift coefficient can be at most.
    """

    incidence: float
    tail_incidence: float
    weight: float
    surfaces: LiftingSurfaces
    density: float
    largest: float

    @cached_property
    def lift(self) -> Real:
        """Vertical lift of each segment and, last, of the tail in N, shape (s,)."""
        angles = np.full(len(self.surfaces.slope), self.incidence)
        angles[-1] = self.tail_incidence
        return np.asarray(self.surfaces.slope * angles)

    @property
    def share(self) -> Real:
        """Share of each segment and of the tail in the weight, shape (s,)."""
        return self.lift / self.weight

    def angle_of_attack(self, speed: float) -> float:
        """Return the angle of attack of the wing in rad at an airspeed in m/s."""
        return self.incidence / speed**2

    def tail_angle(self, speed: float) -> float:
        """Return the angle of attack of the tail in rad at an airspeed in m/s."""
        return self.tail_incidence / speed**2

    def lift_coefficient(self, speed: float) -> Real:
        """Return the lift coefficient of each segment (of its normal force) and of the tail."""
        with np.errstate(divide="ignore", invalid="ignore"):
            normal = np.where(self.lift == 0.0, 0.0, self.lift / self.surfaces.cosine)
        return np.asarray(2.0 * normal / (self.density * speed**2 * self.surfaces.area))

    @property
    def slowest(self) -> float:
        """Airspeed in m/s below which a surface needs more than the largest lift coefficient."""
        return float(np.sqrt(np.abs(self.lift_coefficient(1.0)).max() / self.largest))


def trim(
    surfaces: LiftingSurfaces,
    weight: float,
    centre: float,
    air: tuple[float, float],
    moment: bool,
) -> Trim:
    """Balance the weight of the half aircraft, and its pitching moment.

    Parameters
    ----------
    surfaces : LiftingSurfaces
    weight : float
        Of the half aircraft in N.
    centre : float
        Where the centre of gravity lies aft of the elastic axis of segment 1, in metres.
    air : (float, float)
        Density in kg/m^3, and what a lift coefficient can be at most.
    moment : bool
        Whether the pitching moment is balanced; else the wing alone carries the weight.

    Raises
    ------
    InputError
        When no angle of attack lifts the weight.
    """
    density, largest = air
    slope, arm = surfaces.slope, surfaces.place - centre
    on_wing = float(slope[:-1].sum())
    if on_wing <= LEAST_SLOPE * float(surfaces.flat[:-1].sum()):
        limit = "must leave some segment that lifts: none is level enough to carry the weight"
        remedy = "Fold less, or study the wing with its root clamped."
        raise InputError("fold", "all segments upright", limit, remedy)
    if not moment:
        return Trim(weight / on_wing, 0.0, weight, surfaces, density, largest)
    wing_moment = float(slope[:-1] @ arm[:-1])
    balance = np.array([[on_wing, slope[-1]], [wing_moment, slope[-1] * arm[-1]]])
    size = np.abs(balance).max(axis=1, keepdims=True)
    if abs(np.linalg.det(balance / size)) < LEAST_SLOPE:
        limit = "must lift behind or ahead of the wing, or no balance of forces and moments exists"
        raise InputError("aircraft.tail", "at the wing", limit, 'Take trim = "force".')
    wing, tail = np.linalg.solve(balance, np.array([weight, 0.0]))
    return Trim(float(wing), float(tail), weight, surfaces, density, largest)
