"""A segment of a wing, resolved: its outline, and what it is made of."""

import math
from enum import StrEnum
from functools import lru_cache
from typing import NamedTuple, Self

import numpy as np
from pydantic import model_validator

from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model.faults import fault
from foldwing.model.modes_file import ModesFile
from foldwing.model.planform import Planform, rectangle
from foldwing.model.quantities import (
    ChordFraction,
    InertiaPerSpan,
    Length,
    LiftSlope,
    MassPerSpan,
    SectionStiffness,
)
from foldwing.model.record import Record
from foldwing.model.sheet import Sheet

BEYOND_ROUND_OFF = 1.0 + 1e-9
"""Factor by which an inertia must exceed that of all mass on one line, to count as greater."""

MID_CHORD = 0.5
"""Fraction of the chord where elastic axis and mass centre lie unless given."""


class Structure(StrEnum):
    """Where the component modes of a segment come from."""

    BEAM = "beam"
    PLATE = "plate"
    IMPORTED = "imported"


NEEDS = {
    Structure.BEAM: (
        "bending_stiffness",
        "torsion_stiffness",
        "mass_per_span",
        "inertia_per_span",
    ),
    Structure.PLATE: ("sheet",),
    Structure.IMPORTED: ("modes",),
}
"""What each kind of structure is computed from."""


class BeamSection(NamedTuple):
    """Section properties of a uniform beam, see `Segment`."""

    bending_stiffness: float
    torsion_stiffness: float
    mass_per_span: float
    inertia_per_span: float


class MassAndCentre(NamedTuple):
    """Mass in kg, and where its centre lies in local axes in m."""

    mass: float
    x: float
    y: float


class Segment(Record):
    """One flat segment of a wing; every value in SI units.

    Attributes
    ----------
    span, chord : float
        m. Of an outline that is no rectangle: extent across the stream, and the chord at the root
        or the mean chord.
    bending_stiffness : float
        EI, N*m^2; this and the next three belong to beams.
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
        m, of a uniform sheet; for reports.
    structure : Structure
        Beam, plate or imported modes.
    planform : Planform, optional
        Outline; without it the segment is a rectangle.
    sheet : Sheet, optional
        What a plate is made of.
    modes : ModesFile, optional
        Where imported modes come from.
    """

    span: Length
    chord: Length
    bending_stiffness: SectionStiffness | None = None
    torsion_stiffness: SectionStiffness | None = None
    mass_per_span: MassPerSpan | None = None
    inertia_per_span: InertiaPerSpan | None = None
    elastic_axis: ChordFraction = MID_CHORD
    mass_centre: ChordFraction = MID_CHORD
    lift_slope: LiftSlope = 2.0 * math.pi
    thickness: Length | None = None
    structure: Structure = Structure.BEAM
    planform: Planform | None = None
    sheet: Sheet | None = None
    modes: ModesFile | None = None

    @model_validator(mode="after")
    def _has_what_it_needs(self) -> Self:
        for key in NEEDS[self.structure]:
            if getattr(self, key) is None:
                limit = f"is required: a {self.structure} segment is computed from it"
                raise fault((key,), None, limit, f"Add {key}.")
        if self.structure is Structure.BEAM and not self.outline.is_rectangle:
            limit = "beams are rectangles along the stream"
            remedy = 'Take structure = "plate" for any other outline.'
            raise fault(("structure",), "beam", limit, remedy)
        if not self.outline.has_one_chord:
            limit = "every line along the stream must cross the outline once in and once out"
            remedy = "Fill the notch, or cut the segment in two."
            raise fault(("corners",), f"a list of {len(self.outline.corners)}", limit, remedy)
        return self

    @model_validator(mode="after")
    def _inertia_is_possible(self) -> Self:
        if self.mass_per_span is None or self.inertia_per_span is None:
            return self
        offset = self.mass_offset
        least = self.mass_per_span * offset * offset
        if self.inertia_per_span < least * BEYOND_ROUND_OFF:
            limit = f"must be greater than mass_per_span times mass offset squared, {least:g} kg*m"
            remedy = "Give the inertia about the elastic axis, or move mass_centre towards it."
            raise fault(("inertia_per_span",), self.inertia_per_span, limit, remedy)
        return self

    @property
    def outline(self) -> Planform:
        """The outline in local axes."""
        if self.planform is not None:
            return self.planform
        return rectangle(self.span, self.chord, self.elastic_axis)

    @property
    def beam(self) -> BeamSection:
        """Section properties of a beam."""
        values = [getattr(self, key) for key in NEEDS[Structure.BEAM]]
        if any(value is None for value in values):
            raise ValueError("beam: this segment has no section properties")
        return BeamSection(*values)

    @property
    def end(self) -> Real:
        """Local x and y of the point on which the next segment hangs, shape (2,)."""
        if self.planform is None:
            return np.array([0.0, self.span])
        return self.planform.outboard_point

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
        """Distance of the mass centre of a beam aft of the elastic axis, m."""
        return (self.mass_centre - self.elastic_axis) * self.chord

    @property
    def area(self) -> float:
        """Planform area, m^2."""
        return self.span * self.chord if self.planform is None else self.planform.area

    @property
    def mass_and_centre(self) -> MassAndCentre:
        """Mass without point masses, and its centre."""
        if self.structure is Structure.BEAM:
            mass = self.beam.mass_per_span * self.span
            return MassAndCentre(mass, self.mass_offset, self.span / 2.0)
        if self.modes is not None and self.structure is Structure.IMPORTED:
            return MassAndCentre(self.modes.mass, *self.outline.centroid)
        assert self.sheet is not None
        return _mass_of_sheet(self.outline, self.sheet)


@lru_cache(maxsize=64)
def _mass_of_sheet(outline: Planform, sheet: Sheet) -> MassAndCentre:
    x, y, weights = area_rule(outline, _POINTS)
    dm = sheet.density * sheet.thickness_at(*outline.fractions(x, y)) * weights
    mass = float(dm.sum())
    return MassAndCentre(mass, float(dm @ x) / mass, float(dm @ y) / mass)


_POINTS = 40
"""Points along chord and span between corners: linear thickness has kinks inside."""


def area_rule(outline: Planform, points: int) -> tuple[Real, Real, Real]:
    """Return x, y and weights (m^2) of a quadrature over an outline with one chord, (m,) each."""
    parts = []
    for low, high in zip(outline.breaks[:-1], outline.breaks[1:], strict=True):
        y, across = gauss_rule(float(high - low), points)
        front, back = outline.chord_ends(low + y)
        share, along = gauss_rule(1.0, points)
        x = front[:, None] + share * (back - front)[:, None]
        weight = across[:, None] * along * (back - front)[:, None]
        parts.append((x.ravel(), np.repeat(low + y, points), weight.ravel()))
    x, y, weights = (np.concatenate(part) for part in zip(*parts, strict=True))
    return x, y, weights
