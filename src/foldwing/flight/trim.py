"""Level flight of a wing and a tail: who carries the weight, what drag, where the neutral point."""

from dataclasses import dataclass

from foldwing.model import Airframe


@dataclass(frozen=True)
class Trim:
    """Coefficients in level flight; those without a surface in their name are on the wing's area.

    Attributes
    ----------
    lift, drag : float
        Of the whole aircraft.
    wing_lift, tail_lift : float
        Of each surface on its own area.
    """

    lift: float
    drag: float
    wing_lift: float
    tail_lift: float


def trimmed(airframe: Airframe) -> Trim:
    """Return the coefficients at which lift equals weight and no moment pitches the aircraft.

    The loads of wing and tail act at their quarter chords; profile and fuselage pitch nothing.
    """
    wing, tail = airframe.wing, airframe.tail
    pressure = 0.5 * airframe.density * airframe.speed * airframe.speed
    weight = airframe.mass * airframe.gravity
    tail_load = weight * airframe.centre_of_gravity / airframe.tail_arm
    wing_lift = (weight - tail_load) / (pressure * wing.area)
    tail_lift = tail_load / (pressure * tail.area)
    drag = 0.0
    if airframe.drag:
        assert airframe.zero_lift_drag is not None
        drag = airframe.zero_lift_drag + wing.induced_drag_factor * wing_lift * wing_lift
        share = tail.area / wing.area
        drag += share * tail.induced_drag_factor * tail_lift * tail_lift
    return Trim(weight / (pressure * wing.area), drag, wing_lift, tail_lift)


def neutral_point(airframe: Airframe) -> float:
    """Return where the centre of gravity makes the pitching moment independent of incidence.

    Returns
    -------
    float
        Distance aft of the wing's quarter chord, m.
    """
    wing, tail = (part.area * part.slope for part in (airframe.wing, airframe.tail))
    return airframe.tail_arm * tail / (wing + tail)


def static_margin(airframe: Airframe) -> float:
    """Return how far the centre of gravity lies ahead of the neutral point, in wing chords."""
    return (neutral_point(airframe) - airframe.centre_of_gravity) / airframe.wing.chord
