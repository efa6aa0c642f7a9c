"""A typical section: an airfoil on springs, its numbers as ratios, and its scales if it has any."""

import math
from typing import Annotated, Self

from pydantic import model_validator

from foldwing.model.faults import as_input_error, fault
from foldwing.model.parts import Analysis
from foldwing.model.quantities import Bounds, Frequency, Length, Quantity, Ratio
from foldwing.model.record import Record
from foldwing.model.segment import BEYOND_ROUND_OFF

AxisOffset = Annotated[
    float, Quantity("a distance in half chords", "", "-0.2", Bounds(at_least=-1, at_most=1))
]
MassOffset = Annotated[
    float, Quantity("a distance in half chords", "", "0.1", Bounds(at_least=-2, at_most=2))
]

_ROUND_OFF = 1e-12


class TypicalSection(Record):
    """An airfoil with springs in plunge and pitch, and perhaps a second mass above its plunge.

    Lengths are in half chords b, masses in that of the airfoil, m, frequencies in that of the
    plunge alone, omega_1.

    Attributes
    ----------
    title : str
    mass_ratio : float
        mu = m / (pi rho b^2), the airfoil's mass per span over that of the air around it.
    inertia_ratio : float
        r^2 = i / (m b^2), with the moment of inertia i about the elastic axis of all that pitches.
    axis_offset : float
        a, elastic axis aft of mid-chord.
    mass_offset : float
        e, mass centre aft of the elastic axis.
    torsion_frequency_ratio : float
        omega_alpha / omega_1, each of the motion alone and without air.
    second_mass_ratio, second_frequency_ratio : float, optional
        m_2 / m and omega_2 / omega_1 of a mass on a spring above the plunge of the airfoil, which
        pitches with it; both or neither.
    half_chord : float, optional
        b in m.
    plunge_frequency : float, optional
        omega_1 / 2 pi in Hz; both or neither of the two scales.
    analysis : Analysis
        Damping and threshold; the rest concerns wings.
    """

    title: str = ""
    mass_ratio: Ratio
    inertia_ratio: Ratio
    axis_offset: AxisOffset = 0.0
    mass_offset: MassOffset = 0.0
    torsion_frequency_ratio: Ratio
    second_mass_ratio: Ratio | None = None
    second_frequency_ratio: Ratio | None = None
    half_chord: Length | None = None
    plunge_frequency: Frequency | None = None
    analysis: Analysis = Analysis()

    @model_validator(mode="after")
    def _is_possible(self) -> Self:
        check_pair(self, "second_mass_ratio", "second_frequency_ratio")
        check_pair(self, "half_chord", "plunge_frequency")
        if abs(self.axis_offset + self.mass_offset) > 1.0 + _ROUND_OFF:
            limit = "must leave the mass centre on the chord, 1 half chord from the middle at most"
            remedy = "It is measured from the elastic axis, aft positive."
            raise fault(("mass_offset",), self.mass_offset, limit, remedy)
        least = self.mass_offset**2 * (1.0 + (self.second_mass_ratio or 0.0))
        if self.inertia_ratio < least * BEYOND_ROUND_OFF:
            limit = (
                f"must be greater than mass_offset^2 times all mass over the airfoil's, {least:g}"
            )
            remedy = "Give the inertia about the elastic axis, or a smaller mass_offset."
            raise fault(("inertia_ratio",), self.inertia_ratio, limit, remedy)
        return self

    @property
    def has_scales(self) -> bool:
        """Whether airspeeds are known in m/s and frequencies in Hz."""
        return self.half_chord is not None

    @property
    def speed_unit(self) -> float:
        """Speed b omega_1 in m/s; 1 for a section without scales."""
        return (self.half_chord or 1.0) * self.rate_unit

    @property
    def rate_unit(self) -> float:
        """Frequency omega_1 in rad/s; 1 for a section without scales."""
        return 1.0 if self.plunge_frequency is None else 2.0 * math.pi * self.plunge_frequency

    def with_torsion(self, ratio: float) -> Self:
        """Return this section with another torsion spring, given by omega_alpha / omega_1."""
        with as_input_error():
            return self.model_validate(dict(self) | {"torsion_frequency_ratio": ratio})

    def with_analysis(self, **changes: float) -> Self:
        """Return this section with some values of its analysis changed, ``damping=0.01``."""
        with as_input_error(("analysis",)):
            changed = self.analysis.model_dump() | changes
            return self.model_copy(update={"analysis": Analysis.model_validate(changed)})


def check_pair(record: Record, first: str, second: str) -> None:
    """Raise a fault when only one of two keys is given that belong together."""
    for given, absent in ((first, second), (second, first)):
        if getattr(record, given) is not None and getattr(record, absent) is None:
            limit = f"must be given together with {given}"
            raise fault((absent,), None, limit, f"Add {absent}, or remove {given}.")
