"""Aircraft for tests: random ones, and a multi-body Cessna 172 that hardly bends."""

import numpy as np

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Air, Aircraft, Fuselage, Segment, Tail, Wing
from support.random_wings import random_wing

FOOT = 0.3048


def random_aircraft(rng):
    """Return a half aircraft with a random wing; some have a centre of gravity far aft."""
    wing = random_wing(rng)
    mass, _ = wing.mass_and_centre
    chord, span = wing.segments[0].chord, sum(s.span for s in wing.segments)
    arm = chord * float(rng.uniform(2.0, 7.0))
    tail_mass = mass * float(rng.uniform(0.05, 0.5))
    body_mass = mass * float(np.exp(rng.uniform(np.log(1.0), np.log(10.0))))
    tail = Tail(
        mass=tail_mass,
        pitch_inertia=tail_mass * (chord * float(rng.uniform(0.1, 0.4))) ** 2,
        chord=chord * float(rng.uniform(0.4, 1.0)),
        span=span * float(rng.uniform(0.15, 0.4)),
        x=arm,
        elastic_axis=float(rng.uniform(0.2, 0.6)),
        lift_slope=float(rng.uniform(3.5, 6.3)),
    )
    fuselage = Fuselage(
        mass=body_mass,
        pitch_inertia=body_mass * (chord * float(rng.uniform(0.3, 2.0))) ** 2,
        x=chord * float(rng.uniform(-0.5, 0.3)) - arm * tail_mass / body_mass,
    )
    return wing.carried_by(
        Aircraft(
            fuselage=fuselage,
            tail=tail,
            trim=("force", "force-and-moment")[int(rng.integers(2))],
            tail_aerodynamics=("theodorsen", "quasi-steady")[int(rng.integers(2))],
        )
    )


def with_aircraft(wing, **changes):
    """Return a wing whose aircraft has other values."""
    return wing.carried_by(wing.aircraft.model_copy(update=changes))


def heavier(wing, factor):
    """Return a wing whose fuselage has its mass and inertia multiplied."""
    fuselage = wing.aircraft.fuselage
    changes = {name: factor * getattr(fuselage, name) for name in ("mass", "pitch_inertia")}
    return with_aircraft(wing, fuselage=fuselage.model_copy(update=changes))


def rigid_system(wing, aerodynamics=""):
    """Return the aeroelastic wing, its three rigid modes, and their system."""
    model = AeroelasticWing(wing, aerodynamics)
    modes = model.modes().only(np.arange(3))
    return model, modes, model.system(modes)


def cessna(inertia, gravity):
    """Half a Cessna 172: span 36 ft, chord 5 ft, tail 10 x 3 ft, 15 ft between quarter chords.

    Its 510 kg have their centre at the quarter chord, and the given pitch inertia about it. The
    elastic axis stays at mid-chord. A light wing and tail share the mass and inertia with the
    fuselage in an arbitrary way, which must not matter.
    """
    chord, span, arm, tail_chord = 5 * FOOT, 18 * FOOT, 15 * FOOT, 3 * FOOT
    centre, per_span, per_span_inertia = -chord / 4, 1.0, (chord / 4) ** 2
    tail_mass, tail_inertia, tail_x = 10.0, 5.0, centre + arm + tail_chord / 4
    mass = 510.0 - per_span * span - tail_mass
    x = centre + (per_span * span * centre - tail_mass * (tail_x - centre)) / mass
    others = per_span_inertia * span + per_span * span * centre**2
    others += tail_inertia + tail_mass * (tail_x - centre) ** 2
    own = inertia - others - mass * (x - centre) ** 2
    segment = Segment(
        span=span,
        chord=chord,
        bending_stiffness=1e6,
        torsion_stiffness=1e8,
        mass_per_span=per_span,
        inertia_per_span=per_span_inertia,
    )
    tail = Tail(
        mass=tail_mass,
        pitch_inertia=tail_inertia,
        chord=tail_chord,
        span=5 * FOOT,
        x=tail_x,
        lift_slope=3.8192,
    )
    aircraft = Aircraft(
        fuselage=Fuselage(mass=mass, pitch_inertia=own, x=x),
        tail=tail,
        gravity=gravity,
        wing_aerodynamics="quasi-steady",
        tail_aerodynamics="quasi-steady",
    )
    return Wing(segments=(segment,), air=Air(density=1.2), aircraft=aircraft)
