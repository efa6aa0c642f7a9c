"""One aircraft in two descriptions: bodies joined to a wing, and a rigid wing with a tail."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.linalg
from pydantic import ValidationError

from foldwing.aeroelastic.rigid import rigid_roots, rigid_system
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.flight import ModeRow, flight_modes, mode_row
from foldwing.maths.arrays import Real
from foldwing.model import Air, Aircraft, Airframe, Fuselage, Segment, Surface, Tail, Wing
from foldwing.model.aircraft import QUARTER
from foldwing.structure.mass_centres import mass_centres
from foldwing.studies.flight import check_flight_speed
from foldwing.studies.grid import radians

MULTI_BODY = "multi-body"
"""Name of the rigid aircraft of joined bodies, before that of its aerodynamics."""

STATES = 4
"""Roots of a rigid aircraft that are not neutral."""

WING_SHARE = 0.01
"""Share of the mass that a rigid wing is given; where it lies does not matter."""


def airframe_of(wing: Wing, folds: tuple[float, ...], speed: float | None) -> Airframe:
    """Return the rigid aircraft of a wing with fuselage and tail, without drag.

    Parameters
    ----------
    wing : Wing
        Of an aircraft. A wing of several chords is given their mean, with its quarter chord where
        the lift acts.
    folds : tuple of float
        psi_2 .. psi_N in degrees; a folded wing lifts less, see `foldwing.aeroelastic.trim`.
    speed : float or None
        m/s; by default the aircraft's cruise speed.

    Raises
    ------
    InputError
        When no airspeed is known.
    """
    aircraft = wing.aircraft
    assert aircraft is not None
    at = aircraft.cruise_speed if speed is None else speed
    if at is None:
        remedy = 'Add cruise_speed = "54 m/s", or give --speed 54.'
        raise InputError("aircraft.cruise_speed", None, "is needed for rigid flight", remedy)
    check_flight_speed(at)
    model = AeroelasticWing(wing)
    modes = model.modes(radians(folds))
    level, density = model.trim(modes), wing.air.density
    whole = mass_centres(modes)[-1]
    pitch = modes.section_motion(0, np.zeros(1)).twist[0, modes.names.index("pitch")]
    area = sum(segment.area for segment in wing.segments)
    span = sum(segment.span for segment in wing.segments)
    tail, slopes = aircraft.tail, level.surfaces.slope[:-1]
    lift_at = float(slopes @ level.surfaces.place[:-1] / slopes.sum())
    slope = 2.0 * float(slopes.sum()) / (density * area)
    return Airframe(
        mass=2.0 * whole.mass,
        pitch_inertia=2.0 / float(pitch) ** 2,
        speed=at,
        centre_of_gravity=float(whole.position[0]) - lift_at,
        tail_arm=tail.quarter_chord - lift_at,
        wing=Surface(span=2.0 * span, chord=area / span, lift_slope=slope),
        tail=Surface(span=2.0 * tail.span, chord=tail.chord, lift_slope=tail.lift_slope),
        drag=False,
        gravity=aircraft.gravity,
        density=density,
        title=wing.title,
    )


def wing_of(airframe: Airframe) -> Wing | None:
    """Return a wing with fuselage and tail that flies as a rigid aircraft does.

    Quasi-steady, without drag, and so stiff that it stays rigid; mass and inertia are shared out
    between the parts so that those of the whole are right. None where that is not possible, because
    the pitch inertia is too small for masses at these places.
    """
    try:
        return _wing_of(airframe)
    except ValidationError:
        return None


def _wing_of(airframe: Airframe) -> Wing:
    wing, tail = airframe.wing, airframe.tail
    half, centre = airframe.mass / 2.0, airframe.centre_of_gravity
    span, own = wing.span / 2.0, WING_SHARE * airframe.mass / 2.0
    to_axis = QUARTER * wing.chord  # elastic axis at mid-chord, quarter chord ahead of it
    x_cg, x_tail = centre - to_axis, airframe.tail_arm - to_axis + QUARTER * tail.chord
    on_tail = min(own, QUARTER * airframe.pitch_inertia / (x_tail - x_cg) ** 2)
    rest = half - own - on_tail
    x_rest = x_cg - (own * (0.0 - x_cg) + on_tail * (x_tail - x_cg)) / rest
    across = own * wing.chord**2 / 12.0
    spread = own * x_cg**2 + on_tail * (x_tail - x_cg) ** 2 + rest * (x_rest - x_cg) ** 2
    inertia = airframe.pitch_inertia / 2.0 - spread - across
    segment = Segment(
        span=span,
        chord=wing.chord,
        bending_stiffness=1e6 * airframe.mass * span**3,
        torsion_stiffness=1e6 * airframe.mass * span**3,
        mass_per_span=own / span,
        inertia_per_span=across / span,
        lift_slope=wing.slope,
    )
    aircraft = Aircraft(
        fuselage=Fuselage(mass=rest, pitch_inertia=inertia / 2.0, x=x_rest),
        tail=Tail(
            mass=on_tail,
            pitch_inertia=inertia / 2.0,
            chord=tail.chord,
            span=tail.span / 2.0,
            x=x_tail,
            lift_slope=tail.slope,
        ),
        gravity=airframe.gravity,
        trim="force-and-moment",
        wing_aerodynamics="quasi-steady",
        tail_aerodynamics="quasi-steady",
        cruise_speed=airframe.speed,
    )
    air = Air(density=airframe.density)
    return Wing(segments=(segment,), air=air, aircraft=aircraft, title=airframe.title)


def multibody_rows(
    wing: Wing, folds: tuple[float, ...], speeds: Sequence[float]
) -> tuple[ModeRow, ...]:
    """Return phugoid and short period of the joined bodies, all elastic modes left out.

    With quasi-steady aerodynamics, and with those of the aircraft where they are others.
    """
    rows: list[ModeRow] = []
    assert wing.aircraft is not None
    own = (wing.aircraft.wing_aerodynamics, wing.aircraft.tail_aerodynamics)
    kinds = dict.fromkeys([("quasi-steady", "quasi-steady"), own])
    for on_wing, on_tail in kinds:
        change = {"wing_aerodynamics": on_wing, "tail_aerodynamics": on_tail}
        changed = wing.carried_by(wing.aircraft.model_copy(update=change))
        name = on_wing if on_wing == on_tail else f"{on_wing}, tail {on_tail}"
        rows += _rows(changed, folds, speeds, f"{MULTI_BODY}, {name}")
    return tuple(rows)


def _rows(
    wing: Wing, folds: tuple[float, ...], speeds: Sequence[float], name: str
) -> list[ModeRow]:
    model = AeroelasticWing(wing)
    system = rigid_system(model, model.modes(radians(folds)))
    rows = []
    for speed in dict.fromkeys(speeds):
        roots = [complex(root) for root in rigid_roots(system, float(speed))]
        if len(roots) == STATES:
            motions = tuple(replace(m, shape=()) for m in flight_modes(_with_roots(roots)))
            rows.append(ModeRow(name, float(speed), motions))
        elif len(roots) == 2 and roots[0].imag != 0.0:  # a decaying real motion lags: it is unknown
            rows.append(mode_row(name, float(speed), (roots[0], roots[1])))
    return rows


def _with_roots(roots: Sequence[complex]) -> Real:
    """Return a real matrix that has these roots, both of a pair among them."""
    blocks = [
        np.array([[root.real, root.imag], [-root.imag, root.real]])
        if root.imag > 0.0
        else np.array([[root.real]])
        for root in roots
        if root.imag >= 0.0
    ]
    return np.asarray(scipy.linalg.block_diag(*blocks))
