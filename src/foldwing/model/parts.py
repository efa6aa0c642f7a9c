"""The parts of a wing besides its segments, resolved: SI floats only."""

import math
from enum import StrEnum
from typing import Annotated, Literal, Self

from pydantic import StrictBool, model_validator

from foldwing.maths.arrays import Real
from foldwing.model.faults import fault
from foldwing.model.listed import Positions
from foldwing.model.planform import hinge_direction
from foldwing.model.quantities import (
    Angle,
    Bounds,
    Count,
    Counts,
    DampingRatio,
    DampingThreshold,
    Density,
    Distance,
    HingeStiffness,
    Mass,
    Position,
    Quantity,
    Relaxation,
    WakeLength,
)
from foldwing.model.record import Record

MOST_MODES = 60
"""Largest number of modes of one kind: beyond it beam theory has long lost its meaning."""

MOST_PLATE_MODES = 200
"""Largest number of modes of a plate."""

MOST_SPRINGS = 1000
"""Largest number of springs in a hinge."""

MOST_FLARE = math.radians(75.0)
"""Largest flare of a hinge, rad."""

FLARE = Quantity("an angle", "rad", "15", Bounds(-MOST_FLARE, None, MOST_FLARE), "degrees")


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
    flare : float
        Angle of the hinge line in rad, positive when its front end lies outboard of its rear end:
        folding up then lowers the incidence. Given in degrees, or as text with a unit.
    positions : tuple of float
        Where the springs are along the hinge line, in m aft of the point where the outboard
        segment hangs; empty for springs that are spread evenly.
    gap : float
        Width in m of the opening between the two segments, half of it on either side of the hinge
        line. The structure has none; the vortex lattice leaves it open.
    """

    kind: HingeKind = HingeKind.SPRING
    stiffness: HingeStiffness = 0.0
    springs: Annotated[int, Count(1, MOST_SPRINGS)] = 1
    spacing: Distance = 0.0
    fold: Angle = 0.0
    flare: Annotated[float, FLARE] = 0.0
    positions: Positions | tuple[()] = ()
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
        if self.positions and len(self.positions) != self.springs:
            limit = f"{self.springs} springs need as many positions"
            raise fault(("positions",), len(self.positions), limit, "Give one for each spring.")
        return self

    @property
    def direction(self) -> Real:
        """Unit vector h along the flat hinge line, aft, shape (2,)."""
        return hinge_direction(self.flare)


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
    plate_modes : int
        Modes of each plate, its three rigid ones included where it is free.
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
    plate_modes: Annotated[int, Count(4, MOST_PLATE_MODES)] = 10
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
