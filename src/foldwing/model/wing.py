"""A folding wing: segments joined by hinges, with point masses, in air."""

from collections.abc import Sequence
from itertools import accumulate
from typing import Self

import numpy as np
from pydantic import model_validator

from foldwing.errors import InputError
from foldwing.model.aircraft import Aircraft
from foldwing.model.faults import Path, as_input_error, fault, shown
from foldwing.model.frames import Frames, frames
from foldwing.model.joining import check_hinge
from foldwing.model.parts import Air, Analysis, Hinge, Lattice, PointMass
from foldwing.model.quantities import ANGLE, Bounds, Quantity
from foldwing.model.record import Record
from foldwing.model.segment import Segment, Structure

GAP = Quantity("a length", "m", '"1 mm"', Bounds(at_least=0.0))
IMBALANCE = Quantity("a static imbalance", "", "0.1", Bounds(at_least=0.0))

MOST_PANELS, MOST_ROWS = 10_000, 100_000
"""Panels and wake rows beyond which a lattice takes minutes and gigabytes."""

_ROUND_OFF = 1e-9
"""Relative excess that a length may have by conversion of units alone."""


class Wing(Record):
    """A wing of flat segments, its root clamped or joined to an aircraft; only ever copied.

    Attributes
    ----------
    segments : tuple of Segment
        From root to tip.
    hinges : tuple of Hinge
        One fewer than the segments; ``hinges[0]`` joins segments 1 and 2.
    point_masses : tuple of PointMass
        Masses fixed to segments.
    air : Air
        What the wing moves in.
    analysis : Analysis
        How it is analysed.
    lattice : Lattice
        Mesh of the vortex lattice.
    aircraft : Aircraft, optional
        What the root is joined to; without it the root is clamped.
    title : str
        For reports.
    """

    segments: tuple[Segment, ...]
    hinges: tuple[Hinge, ...] = ()
    point_masses: tuple[PointMass, ...] = ()
    air: Air = Air()
    analysis: Analysis = Analysis()
    lattice: Lattice = Lattice()
    aircraft: Aircraft | None = None
    title: str = ""

    @model_validator(mode="after")
    def _parts_fit(self) -> Self:
        if not self.segments:
            raise fault(("segments",), 0, "a wing has at least 1 segment", "Add a segment.")
        if len(self.hinges) != self.count - 1:
            limit = f"{self.count} segments need {self.count - 1} hinges"
            raise fault(("hinges",), len(self.hinges), limit, "Give one hinge between neighbours.")
        for index, hinge in enumerate(self.hinges):
            check_hinge(index, self.segments, hinge)
        for index, mass in enumerate(self.point_masses):
            self._check_point_mass(index, mass)
        self._check_gaps()
        self._check_strips()
        return self

    def _check_point_mass(self, index: int, mass: PointMass) -> None:
        where: Path = ("point_masses", index)
        if mass.segment > self.count:
            limit = f"must be a segment of this wing, 1 to {self.count}"
            remedy = "Count the segments from 1 at the root."
            raise fault((*where, "segment"), mass.segment, limit, remedy)
        segment = self.segments[mass.segment - 1]
        low, high = segment.outline.extent
        room = _ROUND_OFF * segment.span
        if not low - room <= mass.y <= high + room:
            limit = f"must lie on segment {mass.segment}, {low:g} to {high:g} m"
            remedy = "Measure y from the inboard edge of that segment."
            raise fault((*where, "y"), mass.y, limit, remedy)
        if segment.structure is Structure.BEAM:
            return
        front, back = (float(x[0]) for x in segment.outline.chord_ends(np.array([mass.y])))
        if not front - room <= mass.x <= back + room:
            limit = f"must lie on the {segment.structure} of segment {mass.segment}, at this y "
            limit += f"{front:g} to {back:g} m"
            remedy = "Only beams carry masses beside themselves, on a rigid arm."
            raise fault((*where, "x"), mass.x, limit, remedy)

    def _check_gaps(self) -> None:
        for index, segment in enumerate(self.segments):
            sides = [i for i in (index - 1, index) if 0 <= i < len(self.hinges)]
            taken = sum(self.hinges[i].gap for i in sides) / 2.0
            if taken >= segment.span:
                widest = max(sides, key=lambda i: self.hinges[i].gap)
                limit = f"gaps must leave some of the {segment.span:g} m of segment {index + 1}"
                remedy = "Half of a gap lies on either side of its hinge: make it narrower."
                raise fault(("hinges", widest, "gap"), self.hinges[widest].gap, limit, remedy)

    def _check_strips(self) -> None:
        strips = self.lattice.spanwise
        if isinstance(strips, tuple) and len(strips) != self.count:
            limit = f"this wing has {self.count} segments"
            remedy = "Give one number of strips for each segment, or one for the whole wing."
            raise fault(("lattice", "spanwise"), str(list(strips)), limit, remedy)
        if isinstance(strips, int) and strips < self.count:
            limit = f"must be at least one strip for each of {self.count} segments"
            raise fault(("lattice", "spanwise"), strips, limit, "Give a larger number.")
        total = sum(strips) if isinstance(strips, tuple) else strips
        if total * self.lattice.chordwise > MOST_PANELS:
            limit = f"a lattice may have {MOST_PANELS} panels, chordwise times spanwise"
            raise fault(("lattice", "spanwise"), total, limit, "Take fewer panels.")
        if self.lattice.wake * self.lattice.chordwise > MOST_ROWS:
            limit = f"the wake may have {MOST_ROWS} rows, its length times chordwise"
            raise fault(("lattice", "wake"), self.lattice.wake, limit, "Take a shorter wake.")

    @property
    def count(self) -> int:
        """Number of segments N."""
        return len(self.segments)

    @property
    def fold_angles(self) -> tuple[float, ...]:
        """Fold angles psi_2..psi_N in rad, each relative to the inboard neighbour."""
        return tuple(hinge.fold for hinge in self.hinges)

    @property
    def cumulative_angles(self) -> tuple[float, ...]:
        """Angle Psi_1..Psi_N of each segment to the first in rad; the first is 0."""
        return tuple(accumulate(self.fold_angles, initial=0.0))

    def frames(self, folds: Sequence[float] | None = None) -> Frames:
        """Return the axes of the segments at fold angles in rad, by default its own."""
        angles = self.fold_angles if folds is None else folds
        ends = [segment.end for segment in self.segments]
        return frames(ends, [hinge.direction for hinge in self.hinges], angles)

    @property
    def is_plain(self) -> bool:
        """Whether all segments are rectangles and all hinges run along the stream."""
        flared = any(hinge.flare != 0.0 for hinge in self.hinges)
        return not flared and all(segment.outline.is_rectangle for segment in self.segments)

    @property
    def structures(self) -> frozenset[Structure]:
        """What the segments are."""
        return frozenset(segment.structure for segment in self.segments)

    @property
    def mass_and_centre(self) -> tuple[float, float]:
        """Mass of the unfolded wing in kg and where its centre lies aft of the root's axis in m."""
        hung = self.frames((0.0,) * len(self.hinges)).origins
        parts = [
            (s.mass_and_centre.mass, float(o[0]) + s.mass_and_centre.x)
            for s, o in zip(self.segments, hung, strict=True)
        ]
        parts += [
            (point.mass, float(hung[point.segment - 1][0]) + point.x) for point in self.point_masses
        ]
        mass = sum(m for m, _ in parts)
        return mass, sum(m * x for m, x in parts) / mass

    @property
    def clamped(self) -> Self:
        """The same wing with its root clamped, whatever it was joined to."""
        return self if self.aircraft is None else self._with(aircraft=None)

    def carried_by(self, aircraft: Aircraft) -> Self:
        """Return this wing with its root joined to an aircraft."""
        return self._with(aircraft=aircraft)

    def folded(self, *degrees: float | str) -> Self:
        """Return this wing with other fold angles.

        Parameters
        ----------
        *degrees : float or str
            psi_2..psi_N in degrees, or texts with a unit.

        Raises
        ------
        InputError
            When there are not N - 1 finite angles.
        """
        if len(degrees) != len(self.hinges):
            raise InputError(
                "fold",
                ", ".join(f"{shown(angle)}" for angle in degrees) or "no angle",
                f"this wing has {self.count} segments and takes {len(self.hinges)} fold angles",
                "Give one angle in degrees for each hinge, from root to tip.",
            )
        angles = [ANGLE.read(angle, "fold") for angle in degrees]
        hinges = tuple(
            hinge.model_copy(update={"fold": angle})
            for hinge, angle in zip(self.hinges, angles, strict=True)
        )
        return self._with(hinges=hinges)

    def with_analysis(self, **changes: object) -> Self:
        """Return this wing with some values of its analysis changed, ``system_modes=20``."""
        with as_input_error(("analysis",)):
            analysis = Analysis.model_validate(self.analysis.model_dump() | changes)
        return self._with(analysis=analysis)

    def with_lattice(self, **changes: object) -> Self:
        """Return this wing with some values of its lattice changed, ``chordwise=16``."""
        with as_input_error(("lattice",)):
            lattice = Lattice.model_validate(self.lattice.model_dump() | changes)
        return self._with(lattice=lattice)

    def with_gaps(self, width: float | str) -> Self:
        """Return this wing with gaps of one width (m, or text with a unit) at all hinges."""
        gap = GAP.read(width, "gap")
        return self._with(hinges=tuple(h.model_copy(update={"gap": gap}) for h in self.hinges))

    def with_air(self, density: float | str) -> Self:
        """Return this wing in air of another density (kg/m^3, or text with a unit)."""
        with as_input_error(("air",)):
            air = Air.model_validate({"density": density})
        return self._with(air=air)

    def with_point_masses(self, *masses: PointMass) -> Self:
        """Return this wing with point masses added to those it has."""
        return self._with(point_masses=(*self.point_masses, *masses))

    def with_static_imbalance(self, imbalance: float) -> Self:
        """Return this wing with a point mass at each segment's outboard edge.

        The masses sit a quarter chord aft of the elastic axis and give every segment the same
        static imbalance s = 3 m_p (b/2) / L per mass per span and half chord.

        Parameters
        ----------
        imbalance : float
            s, 0 or more; 0 adds no mass.
        """
        s = IMBALANCE.read(imbalance, "static_imbalance")
        if s == 0.0:
            return self
        with as_input_error(("static_imbalance",)):
            masses = [
                PointMass(
                    segment=number,
                    mass=2.0 / 3.0 * s * segment.mass_and_centre.mass,
                    x=float(segment.end[0]) + segment.half_chord / 2.0,
                    y=float(segment.end[1]),
                )
                for number, segment in enumerate(self.segments, start=1)
            ]
        return self.with_point_masses(*masses)

    def _with(self, **changes: object) -> Self:
        """Return a copy whose parts are checked against each other again."""
        with as_input_error(place=in_file):
            return self.model_validate(dict(self) | changes)


def in_file(path: Path) -> Path:
    """Return where an attribute of a Wing stands in a model file."""
    match path:
        case ("hinges", int(index), *rest):
            return ("wing", "segment", index + 1, "hinge", *rest)
        case ("segments", *rest):
            return ("wing", "segment", *rest)
        case ("point_masses", *rest):
            return ("point_mass", *rest)
        case _:
            return path
