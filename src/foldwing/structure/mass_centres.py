"""Centres of mass of the folded wing and of the aircraft, and how the modes move them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.structure.bodies import RigidBody
from foldwing.structure.modes import StructuralModes


class MassCentre(NamedTuple):
    """A mass centre.

    Attributes
    ----------
    name : str
    mass : float
        kg.
    position : array, shape (3,)
        At rest on the folded wing, in metres.
    displacement : array, shape (3, n)
        Per unit modal coordinate.
    """

    name: str
    mass: float
    position: Real
    displacement: Real


def mass_centres(modes: StructuralModes) -> tuple[MassCentre, ...]:
    """Return mass centres: of the wing, of rigid bodies at its root, and of all together.

    That of the wing alone when its root is clamped.
    """
    parts = [_wing_centre(modes), *(_body_centre(modes, body) for body in modes.assembly.bodies)]
    return tuple(parts) if len(parts) == 1 else (*parts, _together(parts))


def _wing_centre(modes: StructuralModes) -> MassCentre:
    wing, total = modes.assembly.wing, 0.0
    place, moved = np.zeros(3), np.zeros((3, modes.count))
    components = zip(modes.assembly.components, modes.by_segment, strict=True)
    for index, (component, q) in enumerate(components):
        mass, (x, y) = component.mass_and_centre
        at = modes.position(index, np.array([x]), np.array([y]))
        total, place = total + mass, place + mass * at[0]
        moved = moved + modes.rotations[index] @ component.mass_centre_motion @ q
    for point in wing.point_masses:
        index, where = point.segment - 1, (np.array([point.x]), np.array([point.y]))
        total, place = total + point.mass, place + point.mass * modes.position(index, *where)[0]
        moved = moved + point.mass * modes.displacement(index, *where)[0]
    return MassCentre("wing", total, place / total, moved / total)


def _body_centre(modes: StructuralModes, body: RigidBody) -> MassCentre:
    moved = body.displacement(modes.assembly.components[0]) @ modes.by_segment[0]
    return MassCentre(body.name, body.mass, np.array([body.x, 0.0, 0.0]), moved)


def _together(parts: Sequence[MassCentre]) -> MassCentre:
    total = sum(part.mass for part in parts)
    place, moved = np.zeros(3), np.zeros_like(parts[0].displacement)
    for part in parts:
        place = place + part.mass / total * part.position
        moved = moved + part.mass / total * part.displacement
    aside = np.array([1.0, 0.0, 1.0])  # the other half balances this one
    return MassCentre("aircraft", total, place * aside, moved * aside[:, None])
