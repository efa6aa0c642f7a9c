"""A rigid aircraft in level flight whose lift follows the wind at every strip, without lag.

Nothing is linear here: every strip sees an airspeed and an angle of its own, and lifts at right
angles to its own wind. Forces are differenced numerically where they are compared.
"""

from dataclasses import dataclass

import numpy as np

from support.whole_aircraft import level_loads


@dataclass(frozen=True)
class Body:
    """Mass in kg, centre of gravity aft of and above the root's elastic axis, pitch inertia."""

    mass: float
    centre: np.ndarray
    inertia: float


def pieces(wing):
    """Return mass, x, z and own pitch inertia of the parts of the half aircraft, (4, parts)."""
    result, z, turned, cuts = [], 0.0, 0.0, 2000
    for index, segment in enumerate(wing.segments):
        turned += wing.hinges[index - 1].fold if index else 0.0
        spread = segment.inertia_per_span - segment.mass_per_span * segment.mass_offset**2
        y = (np.arange(cuts) + 0.5) / cuts * segment.span
        for s in y:
            width = segment.span / cuts
            height = z + s * np.sin(turned)
            result.append(
                (segment.mass_per_span * width, segment.mass_offset, height, spread * width)
            )
        for point in wing.point_masses:
            if point.segment == index + 1:
                result.append((point.mass, point.x, z + point.y * np.sin(turned), 0.0))
        z += segment.span * np.sin(turned)
    for body in (wing.aircraft.fuselage, wing.aircraft.tail):
        result.append((body.mass, body.x, 0.0, body.pitch_inertia))
    return np.array(result).T


def rigid_body(wing):
    """Return the half aircraft as one body."""
    m, x, z, own = pieces(wing)
    centre = np.array([(m * x).sum(), (m * z).sum()]) / m.sum()
    inertia = (own + m * ((x - centre[0]) ** 2 + (z - centre[1]) ** 2)).sum()
    return Body(m.sum(), centre, inertia)


@dataclass(frozen=True)
class Motion:
    """Velocity aft and up of the centre of gravity, nose-up angle and rate."""

    aft: float = 0.0
    up: float = 0.0
    angle: float = 0.0
    rate: float = 0.0

    def velocity(self, x, z, body):
        """Return velocity aft and up at points x aft of and z above the root."""
        x_cg, z_cg = body.centre
        return self.aft + self.rate * (z - z_cg), self.up - self.rate * (x - x_cg)


def strips(wing, speed):
    """Yield section, width, height, turn and steady incidence of strips; the tail comes last."""
    loads, on_tail = level_loads(wing)
    points, weights = np.polynomial.legendre.leggauss(6)
    z, turned, pressure = 0.0, 0.0, wing.air.density * speed**2
    for index, (segment, load) in enumerate(zip(wing.segments, loads, strict=True)):
        turned += wing.hinges[index - 1].fold if index else 0.0
        incidence = load / (pressure * segment.half_chord * segment.lift_slope)
        for t, weight in zip(points, weights, strict=True):
            height = z + segment.span * (1 + t) / 2 * np.sin(turned)
            yield segment, 0.0, weight * segment.span / 2, height, turned, incidence
        z += segment.span * np.sin(turned)
    tail = wing.aircraft.tail
    yield (
        tail,
        tail.x,
        tail.span,
        0.0,
        0.0,
        on_tail / (pressure * tail.half_chord * tail.lift_slope),
    )


def quasi_steady_forces(wing, speed, motion):
    """Return force aft, force up, and nose-up moment about the centre of gravity, (3,)."""
    body, total = rigid_body(wing), np.zeros(3)
    x_cg, z_cg = body.centre
    for section, axis, width, z, turned, incidence in strips(wing, speed):
        b, c = section.half_chord, np.cos(turned)
        quarter, three_quarters = (axis + b * (d - section.axis_offset) for d in (-0.5, 0.5))
        aft, up = motion.velocity(axis, z, body)
        _, up_behind = motion.velocity(three_quarters, z, body)
        along, across = speed - aft, -up * c
        angle = incidence + motion.angle * c + np.arctan(-up_behind * c / along)
        wind = np.hypot(along, across)
        lift = section.lift_slope * wing.air.density * b * wind**2 * angle * width
        force_aft, normal = -lift * across / wind, lift * along / wind
        force_up = normal * c
        moment = force_aft * (z - z_cg) - force_up * (quarter - x_cg)
        total += [force_aft, force_up, moment]
    return total


def differenced(forces, name, step):
    """Return the derivative of forces(motion) with respect to one part of the motion."""
    ahead, behind = forces(Motion(**{name: step})), forces(Motion(**{name: -step}))
    return (ahead - behind) / (2 * step)
