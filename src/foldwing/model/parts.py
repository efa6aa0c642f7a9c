"""The parts a wing is made of, resolved: section properties and SI floats only."""

import math
from enum import StrEnum
from typing import Annotated, Literal, Self

from pydantic import StrictBool, model_validator

from foldwing.model.faults import fault
from foldwing.model.quantities import (
    Angle,
    ChordFraction,
    Count,
    Counts,
    DampingRatio,
    DampingThreshold,
    Density,
    Distance,
    HingeStiffness,
    InertiaPerSpan,
    Length,
    LiftSlope,
    Mass,
    MassPerSpan,
    Position,
    Relaxation,
    SectionStiffness,
    WakeLength,
)
from foldwing.model.record import Record

MOST_MODES = 60
"""Largest number of modes of one kind: beyond it beam theory has long lost its meaning."""

BEYOND_ROUND_OFF = 1.0 + 1e-9
"""Factor by which an inertia must exceed that of all mass on one line, to count as greater."""

MID_CHORD = 0.5
"""Fraction of the chord where elastic axis and mass centre lie unless given."""

MOST_SPRINGS = 1000
"""Largest number of springs in a hinge."""


class Segment(Record):
    """One uniform flat segment of a wing; every value in SI units.

    Attributes
    ----------
    span, chord : float
        m.
    bending_stiffness : float
        EI, N*m^2.
    torsion_stiffness : float
        GJ, N*m^2.
    mass_per_span : float
        kg/m.
    inertia_per_span : float
        Integral of x^2 dm per span about the elastic axis, kg*m.
    elastic_axis, mass_centre : float
        Fractions of the chord from the leading edge.
    lift_slope : float
        Slope of the section's lift coefficient, 1/rad.
    thickness : float, optional
        m; for reports and plate theory.
    """

    span: Length
    chord: Length
    bending_stiffness: SectionStiffness
    torsion_stiffness: SectionStiffness
    mass_per_span: MassPerSpan
    inertia_per_span: InertiaPerSpan
    elastic_axis: ChordFraction = MID_CHORD
    mass_centre: ChordFraction = MID_CHORD
    lift_slope: LiftSlope = 2.0 * math.pi
    thickness: Length | None = None

    @model_validator(mode="after")
    def _inertia_is_possible(self) -> Self:
        offset = self.mass_offset
        least = self.mass_per_span * offset * offset
        if self.inertia_per_span < least * BEYOND_ROUND_OFF:
            limit = f"must be greater than mass_per_span times mass offset squared, {least:g} kg*m"
            remedy = "Give the inertia about the elastic axis, or move mass_centre towards it."
            raise fault(("inertia_per_span",), self.inertia_per_span, limit, remedy)
        return self

    @property
    def half_chord(self) -> float:
        """Half chord b, m."""
        return self.chord / 2.0

    @property
    def axis_offset(self) -> float:
        """Distance a of the elastic axis aft of mid-chord, in half chords."""
        return 2.0 * self.elastic_axis - 1.0

    @property
    def mass_offset(self) -> float:
        """Distance of the mass centre aft of the elastic axis, m."""
        return (self.mass_centre - self.elastic_axis) * self.chord

    @property
    def area(self) -> float:
        """Planform area, m^2."""
        return self.span * self.chord


class HingeKind(StrEnum):
    """What a hinge does to the relative rotation about its line."""

    SPRING = "spring"
    RIGID = "rigid"
    FREE = "free"


class Hinge(Record):
    """The joint between a segment and its inboard neighbour.

    Attributes
    ----------
    kind : HingeKind
        Spring, rigid or free.
    stiffness : float
        Total rotational stiffness, N*m/rad; above 0 for a spring, otherwise 0.
    springs : int
        Number of equal springs along the hinge, centred on it.
    spacing : float
        Distance between neighbouring springs, m.
    fold : float
        Fold angle psi in rad, positive folding the outboard part up. Given in degrees, or as text
        with a unit.
    gap : float
        Width in m of the opening between the two segments, half of it on either side of the hinge
        line. The structure has none; the vortex lattice leaves it open.
    """

    kind: HingeKind = HingeKind.SPRING
    stiffness: HingeStiffness = 0.0
    springs: Annotated[int, Count(1, MOST_SPRINGS)] = 1
    spacing: Distance = 0.0
    fold: Angle = 0.0
    gap: Distance = 0.0

    @model_validator(mode="after")
    def _stiffness_suits_kind(self) -> Self:
        is_spring = self.kind is HingeKind.SPRING
        if is_spring and self.stiffness == 0.0:
            remedy = "Give the stiffness of the hinge, or make it a free hinge."
            raise fault(("stiffness",), 0.0, "must be greater than 0 N*m/rad in a spring", remedy)
        if not is_spring and self.stiffness != 0.0:
            remedy = "Remove the stiffness, or make it a spring."
            limit = f"must be absent from a {self.kind} hinge"
            raise fault(("stiffness",), self.stiffness, limit, remedy)
        return self


class PointMass(Record):
    """A mass without extent, fixed to a segment.

    Attributes
    ----------
    segment : int
        Number of the segment, 1 at the root.
    mass : float
        kg.
    x : float
        Distance aft of the elastic axis, m.
    y : float
        Distance outboard of the segment's inboard edge, m.
    """

    segment: Annotated[int, Count(1)]
    mass: Mass
    y: Distance
    x: Position = 0.0


class Air(Record):
    """The air a wing moves in.

    Attributes
    ----------
    density : float
        kg/m^3.
    """

    density: Density = 1.225


class Analysis(Record):
    """How finely a wing is analysed and what counts as unstable.

    Attributes
    ----------
    bending_modes, torsion_modes : int
        Modes per segment. Segment 1 has so many clamped modes; in every other segment one of each
        is a rigid mode (roll, pitch), and its translations and yaw are not counted.
    system_modes : int
        Modes of the joined wing that are kept.
    basis : str
        "free-free": the natural modes of each uniform segment; "converged": as many polynomials,
        which converge much faster at the hinges.
    damping : float
        Structural damping ratio of every system mode.
    damping_threshold : float
        A mode is unstable when its damping ratio is below this.
    """

    bending_modes: Annotated[int, Count(2, MOST_MODES)] = 10
    torsion_modes: Annotated[int, Count(1, MOST_MODES)] = 10
    system_modes: Annotated[int, Count(1, MOST_MODES)] = 12
    basis: Literal["free-free", "converged"] = "free-free"
    damping: DampingRatio = 0.0
    damping_threshold: DampingThreshold = 0.0


MOST_DIVISIONS = 1000
"""Largest number of panels along a chord, or of strips along a segment."""


class Lattice(Record):
    """The mesh of the vortex lattice, its wake, and how it takes time derivatives.

    Attributes
    ----------
    chordwise : int
        Panels along the chord of every segment.
    spanwise : int or tuple of int
        Strips along the whole wing, shared out by span; or those of each segment.
    wake : float
        Length of the wake in chords.
    relaxation : float
        Factor below 1 by which the circulation gathered in the last row of the wake fades in each
        step.
    image : bool
        Whether a wall at the root mirrors the flow; in a file with an aircraft it does by default.
    spacing : str
        "uniform", "cosine" (denser at the ends of each segment) or "inset" (uniform, ending a
        quarter of a strip before a free edge).
    gap_refinement : int
        How often the strip beside a gap is halved towards it.
    scheme : str
        "exact", or a discrete-time scheme for comparison: "average" (trapezoidal), "literal"
        (velocity at the end of the step) or "printed" (literal, with the unsteady load of three
        quarters of a panel's own circulation).
    """

    chordwise: Annotated[int, Count(1, MOST_DIVISIONS)] = 8
    spanwise: Annotated[int | tuple[int, ...], Counts(1, MOST_DIVISIONS)] = 30
    wake: WakeLength = 20.0
    relaxation: Relaxation = 0.0
    image: StrictBool = False
    spacing: Literal["uniform", "cosine", "inset"] = "uniform"
    gap_refinement: Annotated[int, Count(0, 10)] = 2
    scheme: Literal["exact", "average", "literal", "printed"] = "exact"
