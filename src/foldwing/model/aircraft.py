"""What carries the wing when its root is not clamped: fuselage, tail, and how they fly."""

import math
from typing import Literal

from foldwing.conventions import STANDARD_GRAVITY
from foldwing.model.quantities import (
    Acceleration,
    Airspeed,
    ChordFraction,
    Length,
    LiftCoefficient,
    LiftSlope,
    Mass,
    PitchInertia,
    Position,
)
from foldwing.model.record import Record
from foldwing.model.segment import MID_CHORD, Segment

QUARTER = 0.25
"""Fraction of the chord where the lift of a thin section acts, and from where arms are measured."""

Trim = Literal["force", "force-and-moment"]
WingTheory = Literal["theodorsen", "quasi-steady", "lattice"]
TailTheory = Literal["theodorsen", "quasi-steady"]


class Fuselage(Record):
    """A rigid body at the root of the wing; every value that of the half aircraft.

    Attributes
    ----------
    mass : float
        kg.
    pitch_inertia : float
        About its own centre of mass, kg*m^2.
    x : float
        Where its centre of mass lies aft of the wing's elastic axis, m.
    """

    mass: Mass
    pitch_inertia: PitchInertia
    x: Position


class Tail(Record):
    """A rigid horizontal tail; every value that of the half aircraft.

    Attributes
    ----------
    mass : float
        kg.
    pitch_inertia : float
        About its own centre of mass, kg*m^2.
    chord, span : float
        m.
    x : float
        Where its elastic axis, with its centre of mass, lies aft of the wing's, m.
    elastic_axis : float
        Fraction of the chord from the leading edge.
    lift_slope : float
        Slope of its lift coefficient, 1/rad.
    """

    mass: Mass
    pitch_inertia: PitchInertia
    chord: Length
    span: Length
    x: Position
    elastic_axis: ChordFraction = MID_CHORD
    lift_slope: LiftSlope = 2.0 * math.pi

    @property
    def half_chord(self) -> float:
        """Half chord b, m."""
        return self.chord / 2.0

    @property
    def axis_offset(self) -> float:
        """Distance a of the elastic axis aft of mid-chord, in half chords."""
        return 2.0 * self.elastic_axis - 1.0

    @property
    def area(self) -> float:
        """Planform area, m^2."""
        return self.span * self.chord

    @property
    def quarter_chord(self) -> float:
        """Where the quarter chord lies aft of the wing's elastic axis, m."""
        return self.x + (QUARTER - self.elastic_axis) * self.chord


class Aircraft(Record):
    """An aircraft that is its own mirror image, of which the wing is one half.

    Attributes
    ----------
    fuselage : Fuselage
    tail : Tail
    gravity : float
        m/s^2.
    trim : str
        What balances in level flight: "force" (the wing alone carries the weight) or
        "force-and-moment" (the tail carries what keeps the pitching moment zero).
    wing_aerodynamics : str
        "theodorsen", "quasi-steady" or "lattice".
    tail_aerodynamics : str
        "theodorsen" or "quasi-steady".
    largest_lift_coefficient : float
        What a surface can lift at most; trim beyond it is computed, and called out of reach.
    cruise_speed : float, optional
        Airspeed in m/s at which the rigid aircraft is looked at.
    """

    fuselage: Fuselage
    tail: Tail
    gravity: Acceleration = STANDARD_GRAVITY
    trim: Trim = "force"
    wing_aerodynamics: WingTheory = "theodorsen"
    tail_aerodynamics: TailTheory = "theodorsen"
    largest_lift_coefficient: LiftCoefficient = 1.2
    cruise_speed: Airspeed | None = None


def quarter_chord(segment: Segment) -> float:
    """Return where the quarter chord of a segment lies aft of its elastic axis, in metres."""
    return (QUARTER - segment.elastic_axis) * segment.chord
