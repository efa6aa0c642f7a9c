"""The table of a typical section as it is written: in ratios, or with dimensions."""

import math
from typing import Self

from pydantic import model_validator

from foldwing.model.faults import fault
from foldwing.model.parts import Air, Analysis
from foldwing.model.quantities import (
    ChordFraction,
    Frequency,
    InertiaPerSpan,
    Length,
    MassPerSpan,
    PlungeStiffness,
    Ratio,
    TorsionStiffness,
)
from foldwing.model.record import Record
from foldwing.model.section import AxisOffset, MassOffset, TypicalSection, check_pair
from foldwing.model.segment import BEYOND_ROUND_OFF, MID_CHORD

RATIOS = (
    "mass_ratio",
    "inertia_ratio",
    "axis_offset",
    "mass_offset",
    "torsion_frequency_ratio",
    "second_mass_ratio",
    "second_frequency_ratio",
)
"""Keys of a section in ratios."""

_NEEDED = {"mass_ratio": "20", "inertia_ratio": "0.24", "torsion_frequency_ratio": "2.5"}
_NEEDED_WITH_DIMENSIONS = {"mass_per_span": '"35.7 kg/m"', "inertia_per_span": '"8.64 kg*m"'}
_ONE_OF = {
    ("chord", "half_chord"): 'chord = "1.8 m"',
    ("plunge_stiffness", "plunge_frequency"): 'plunge_frequency = "8 Hz"',
    ("torsion_stiffness", "torsion_frequency"): 'torsion_frequency = "14 Hz"',
}


class SectionTable(Record):
    """A typical section; stiffnesses and masses are those of a unit of span."""

    mass_ratio: Ratio | None = None
    inertia_ratio: Ratio | None = None
    axis_offset: AxisOffset | None = None
    mass_offset: MassOffset | None = None
    torsion_frequency_ratio: Ratio | None = None
    second_mass_ratio: Ratio | None = None
    second_frequency_ratio: Ratio | None = None
    chord: Length | None = None
    half_chord: Length | None = None
    elastic_axis: ChordFraction | None = None
    mass_centre: ChordFraction | None = None
    mass_per_span: MassPerSpan | None = None
    inertia_per_span: InertiaPerSpan | None = None
    plunge_stiffness: PlungeStiffness | None = None
    plunge_frequency: Frequency | None = None
    torsion_stiffness: TorsionStiffness | None = None
    torsion_frequency: Frequency | None = None
    second_mass_per_span: MassPerSpan | None = None
    second_stiffness: PlungeStiffness | None = None
    second_frequency: Frequency | None = None

    @model_validator(mode="after")
    def _is_one_form(self) -> Self:
        ratios = [key for key in RATIOS if getattr(self, key) is not None]
        others = [key for key in self.model_fields_set if key not in RATIOS]
        if ratios and others:
            first = next(key for key in type(self).model_fields if key in others)
            limit = f"a section is given in ratios or with dimensions, and {ratios[0]} is a ratio"
            remedy = f"Remove {first}, or give everything with dimensions."
            raise fault((first,), getattr(self, first), limit, remedy)
        if others:
            self._check_dimensions()
        else:
            self._check_ratios()
        return self

    def _check_ratios(self) -> None:
        for key, example in _NEEDED.items():
            if getattr(self, key) is None:
                limit = "must be given, or else chord, mass_per_span and the others with dimensions"
                raise fault((key,), None, limit, f"Add {key}, for example {key} = {example}.")
        check_pair(self, "second_mass_ratio", "second_frequency_ratio")

    def _check_dimensions(self) -> None:
        for (first, second), example in _ONE_OF.items():
            self._check_one_of(first, second, f"Add for example {example}.")
        for key, example in _NEEDED_WITH_DIMENSIONS.items():
            if getattr(self, key) is None:
                limit = "must be given in a section with dimensions"
                raise fault((key,), None, limit, f"Add {key}, for example {key} = {example}.")
        if self.second_mass_per_span is not None:
            remedy = 'Add second_frequency = "20 Hz", or remove second_mass_per_span.'
            self._check_one_of("second_stiffness", "second_frequency", remedy)
        elif self.second_stiffness is not None or self.second_frequency is not None:
            limit = "must be given together with its spring"
            remedy = "Add second_mass_per_span, or remove second_stiffness and second_frequency."
            raise fault(("second_mass_per_span",), None, limit, remedy)
        self._check_inertia()

    def _check_one_of(self, first: str, second: str, remedy: str) -> None:
        given = [key for key in (first, second) if getattr(self, key) is not None]
        if not given:
            raise fault((first,), None, f"{first} or {second} must be given", remedy)
        if len(given) == 2:
            limit = f"only one of {first} and {second} may be given"
            raise fault((second,), getattr(self, second), limit, f"Remove {first} or {second}.")

    def _check_inertia(self) -> None:
        assert self.mass_per_span is not None and self.inertia_per_span is not None
        mass = self.mass_per_span + (self.second_mass_per_span or 0.0)
        least = mass * (self._mass_offset * self._half_chord) ** 2
        if self.inertia_per_span < least * BEYOND_ROUND_OFF:
            limit = (
                f"must be greater than all mass per span times mass offset squared, {least:g} kg*m"
            )
            remedy = "Give the inertia about the elastic axis, or move mass_centre towards it."
            raise fault(("inertia_per_span",), self.inertia_per_span, limit, remedy)

    @property
    def in_ratios(self) -> bool:
        """Whether the section is given in ratios."""
        return self.mass_ratio is not None

    @property
    def _half_chord(self) -> float:
        return self.half_chord or (self.chord or 0.0) / 2.0

    @property
    def _axis(self) -> float:
        return MID_CHORD if self.elastic_axis is None else self.elastic_axis

    @property
    def _mass_offset(self) -> float:
        """Distance of the mass centre aft of the elastic axis in half chords."""
        centre = MID_CHORD if self.mass_centre is None else self.mass_centre
        return 2.0 * (centre - self._axis)

    def resolved(self, title: str, air: Air, analysis: Analysis) -> TypicalSection:
        """Return the section in ratios, with its scales when it is given with dimensions."""
        values = {key: getattr(self, key) for key in RATIOS}
        if not self.in_ratios:
            values = self._as_ratios(air)
        given = {key: value for key, value in values.items() if value is not None}
        return TypicalSection(title=title, analysis=analysis, **given)

    def _as_ratios(self, air: Air) -> dict[str, float | None]:
        m, i, b = self.mass_per_span, self.inertia_per_span, self._half_chord
        assert m is not None and i is not None
        plunge = _hertz(self.plunge_frequency, self.plunge_stiffness, m)
        torsion = _hertz(self.torsion_frequency, self.torsion_stiffness, i)
        m2, second = self.second_mass_per_span, None
        if m2 is not None:
            second = _hertz(self.second_frequency, self.second_stiffness, m2) / plunge
        return {
            "mass_ratio": m / (math.pi * air.density * b**2),
            "inertia_ratio": i / (m * b**2),
            "axis_offset": 2.0 * self._axis - 1.0,
            "mass_offset": self._mass_offset,
            "torsion_frequency_ratio": torsion / plunge,
            "second_mass_ratio": None if m2 is None else m2 / m,
            "second_frequency_ratio": second,
            "half_chord": b,
            "plunge_frequency": plunge,
        }


def _hertz(frequency: float | None, stiffness: float | None, mass: float) -> float:
    """Return the frequency that is given, or that of a mass on its spring."""
    if frequency is not None:
        return frequency
    assert stiffness is not None
    return math.sqrt(stiffness / mass) / (2.0 * math.pi)
