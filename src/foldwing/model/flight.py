"""An aircraft in longitudinal flight: the table [flight], and the three forms it resolves to."""

import math
from typing import Self

from pydantic import StrictBool, model_validator

from foldwing.conventions import STANDARD_GRAVITY
from foldwing.model.faults import as_input_error, fault, shown
from foldwing.model.parts import Air
from foldwing.model.quantities import (
    Acceleration,
    Airspeed,
    Density,
    DragCoefficient,
    ForceDerivative,
    Length,
    LiftSlope,
    Mass,
    MomentDerivative,
    PitchDamping,
    PitchInertia,
    Position,
    SpanEfficiency,
    StateMatrix,
    TailArm,
)
from foldwing.model.record import Record

_FORMS = "Give [flight.wing] and [flight.tail], or [flight.derivatives], or matrix."
_OF_ALL = {"speed", "gravity"}
_OF_A_BODY = _OF_ALL | {"mass", "pitch_inertia"}
_PITCH_IS_INTEGRATED = (0.0, 0.0, 1.0, 0.0)


class Surface(Record):
    """A wing or a tail of constant chord, without dihedral.

    Attributes
    ----------
    span, chord : float
        m; the span from tip to tip.
    lift_slope : float, optional
        Slope of the lift coefficient of the whole surface, 1/rad; by default that of lifting-line
        theory for the span efficiency.
    span_efficiency : float, optional
        e, of the induced drag.
    """

    span: Length
    chord: Length
    lift_slope: LiftSlope | None = None
    span_efficiency: SpanEfficiency | None = None

    @model_validator(mode="after")
    def _has_a_slope(self) -> Self:
        if self.lift_slope is None and self.span_efficiency is None:
            limit = "must be given, or else lift_slope"
            remedy = "Add span_efficiency = 0.93, or lift_slope = 5.0."
            raise fault(("span_efficiency",), None, limit, remedy)
        return self

    @property
    def area(self) -> float:
        """Planform area, m^2."""
        return self.span * self.chord

    @property
    def aspect_ratio(self) -> float:
        """Span over chord."""
        return self.span / self.chord

    @property
    def slope(self) -> float:
        """Lift slope a in 1/rad, as given or 2 pi / (1 + 2 / (e AR))."""
        if self.lift_slope is not None:
            return self.lift_slope
        assert self.span_efficiency is not None
        return 2.0 * math.pi / (1.0 + 2.0 / (self.span_efficiency * self.aspect_ratio))

    @property
    def induced_drag_factor(self) -> float:
        """Induced drag over lift coefficient squared, 1 / (pi e AR)."""
        assert self.span_efficiency is not None
        return 1.0 / (math.pi * self.span_efficiency * self.aspect_ratio)


class DerivativesTable(Record):
    """Stability derivatives with their dimensions, in body axes: x forward, z down, M nose up.

    Attributes
    ----------
    X_u, X_w, Z_u, Z_w : float
        Force per velocity, N s/m.
    Z_q : float
        Force per pitch rate, N s.
    M_u, M_w : float
        Moment per velocity, N s.
    M_q : float
        Moment per pitch rate, N m s.
    """

    X_u: ForceDerivative
    X_w: ForceDerivative
    Z_u: ForceDerivative
    Z_w: ForceDerivative
    M_w: MomentDerivative
    M_q: PitchDamping
    Z_q: MomentDerivative = 0.0
    M_u: MomentDerivative = 0.0


class FlightTable(Record):
    """The table [flight] as it is written: one of three forms, each with keys of its own."""

    speed: Airspeed | None = None
    gravity: Acceleration = STANDARD_GRAVITY
    mass: Mass | None = None
    pitch_inertia: PitchInertia | None = None
    matrix: StateMatrix | None = None
    derivatives: DerivativesTable | None = None
    centre_of_gravity: Position | None = None
    tail_arm: TailArm | None = None
    zero_lift_drag: DragCoefficient | None = None
    drag: StrictBool = True
    wing: Surface | None = None
    tail: Surface | None = None

    @model_validator(mode="after")
    def _is_of_one_form(self) -> Self:
        given = self.model_fields_set
        if not given - _OF_A_BODY:
            limit = "must be given, or else stability derivatives or a matrix"
            raise fault(("wing",), None, limit, _FORMS)
        known, form = set(type(self).model_fields), "a description by wing and tail"
        allowed = known - {"matrix", "derivatives"}
        if "matrix" in given:
            allowed, form = _OF_ALL | {"matrix"}, "a matrix"
        elif "derivatives" in given:
            allowed, form = _OF_A_BODY | {"derivatives"}, "stability derivatives"
        for key in (key for key in type(self).model_fields if key in given - allowed):
            limit = f"does not go with {form}: a model has one form"
            raise fault((key,), shown(getattr(self, key)), limit, f"Remove it. {_FORMS}")
        return self


class StateMatrixModel(Record):
    """An aircraft given by the matrix of its four states.

    Attributes
    ----------
    matrix : tuple of tuple of float, 4 x 4
        A of d/dt (u, w, q, theta) = A (u, w, q, theta): m/s, m/s, rad/s, rad.
    speed : float, optional
        m/s; without it there are no flight paths and no simple phugoid.
    gravity : float
        m/s^2.
    title : str
    """

    matrix: StateMatrix
    speed: Airspeed | None = None
    gravity: Acceleration = STANDARD_GRAVITY
    title: str = ""

    @model_validator(mode="after")
    def _pitch_rate_turns_pitch(self) -> Self:
        if self.matrix[3] != _PITCH_IS_INTEGRATED:
            limit = "must be 0, 0, 1, 0: the pitch angle grows by the pitch rate"
            remedy = "Order rows and columns as u, w, q, theta, in m/s, rad/s and rad."
            raise fault(("matrix", 3), str(list(self.matrix[3])), limit, remedy)
        return self


class DerivativesModel(Record):
    """An aircraft given by its stability derivatives at one airspeed.

    Attributes
    ----------
    mass, pitch_inertia : float
        kg, kg m^2 about the centre of gravity.
    speed : float
        m/s.
    derivatives : DerivativesTable
    gravity : float
        m/s^2.
    title : str
    """

    mass: Mass
    pitch_inertia: PitchInertia
    speed: Airspeed
    derivatives: DerivativesTable
    gravity: Acceleration = STANDARD_GRAVITY
    title: str = ""


class Airframe(Record):
    """An aircraft given by its wing and its tail.

    Attributes
    ----------
    mass, pitch_inertia : float
        kg, kg m^2 about the centre of gravity.
    speed : float
        m/s.
    centre_of_gravity : float
        Aft of the wing's quarter chord, m.
    tail_arm : float
        From the wing's quarter chord aft to that of the tail, m.
    wing, tail : Surface
    zero_lift_drag : float, optional
        Drag coefficient without lift, on the area of the wing; needed unless drag is left out.
    drag : bool
        Whether the aircraft has drag, zero-lift and induced.
    gravity, density : float
        m/s^2, kg/m^3.
    title : str
    """

    mass: Mass
    pitch_inertia: PitchInertia
    speed: Airspeed
    centre_of_gravity: Position
    tail_arm: TailArm
    wing: Surface
    tail: Surface
    zero_lift_drag: DragCoefficient | None = None
    drag: StrictBool = True
    gravity: Acceleration = STANDARD_GRAVITY
    density: Density = Air().density
    title: str = ""

    @model_validator(mode="after")
    def _tail_is_behind(self) -> Self:
        if self.tail_arm <= self.centre_of_gravity:
            limit = f"must be greater than centre_of_gravity, {self.centre_of_gravity:g} m"
            remedy = "The tail stands behind the centre of gravity: move one of them."
            raise fault(("tail_arm",), self.tail_arm, limit, remedy)
        return self

    @model_validator(mode="after")
    def _drag_is_known(self) -> Self:
        if not self.drag:
            return self
        limit, without = "is needed for the drag", "or leave the drag out with drag = false."
        if self.zero_lift_drag is None:
            raise fault(("zero_lift_drag",), None, limit, f"Add zero_lift_drag = 0.035, {without}")
        for name in ("wing", "tail"):
            if getattr(self, name).span_efficiency is None:
                remedy = f"Add span_efficiency = 0.93, {without}"
                raise fault((name, "span_efficiency"), None, limit, remedy)
        return self

    def flown_at(self, speed: float) -> "Airframe":
        """Return the aircraft in trimmed flight at another airspeed in m/s."""
        return self.model_copy(update={"speed": speed})

    def without_drag(self) -> "Airframe":
        """Return the aircraft with neither zero-lift nor induced drag."""
        return self.model_copy(update={"drag": False})


FlightModel = StateMatrixModel | DerivativesModel | Airframe
"""An aircraft in level flight, by one of the three forms."""


def resolved_flight(table: FlightTable, title: str, air: Air) -> FlightModel:
    """Return the aircraft that the table [flight] of a model file describes.

    Raises
    ------
    InputError
        When something is missing or does not fit; it names the field in the file.
    """
    given = {key: getattr(table, key) for key in FlightTable.model_fields}
    values = {key: value for key, value in given.items() if value is not None} | {"title": title}
    forms: tuple[type[FlightModel], ...] = (StateMatrixModel, DerivativesModel, Airframe)
    marks = ("matrix", "derivatives")
    chosen = next((i for i, mark in enumerate(marks) if mark in values), len(marks))
    form = forms[chosen]
    if form is Airframe:
        values["density"] = air.density
    with as_input_error(("flight",)):
        return form.model_validate({k: v for k, v in values.items() if k in form.model_fields})
