"""How a hinge lies between two segments: the edge that both share, and where its springs are."""

import math

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.model.faults import Path, fault
from foldwing.model.parts import Hinge
from foldwing.model.planform import flare_of
from foldwing.model.segment import Segment, Structure

PARALLEL = 1e-6
"""Sine of the angle, or share of the edge, by which edges may miss a hinge line."""

SPREAD = 3
"""Points at which a hinge without discrete springs joins a plate to its neighbour."""

_EXCESS = 1e-9
"""Relative excess that a length may have by conversion of units alone."""


def shared_edge(inboard: Segment, outboard: Segment, hinge: Hinge) -> tuple[float, float]:
    """Return where the edge that both segments share begins and ends along the hinge, in m aft.

    Measured from the point where the outboard segment hangs.
    """
    h = hinge.direction
    inner = (inboard.outline.outboard_edge - inboard.end) @ h
    outer = outboard.outline.inboard_edge @ h
    return max(float(inner.min()), float(outer.min())), min(float(inner.max()), float(outer.max()))


def spring_places(inboard: Segment, outboard: Segment, hinge: Hinge) -> Real:
    """Return where the springs of a hinge are along it, in m aft of where the outboard part hangs.

    Springs are centred on the shared edge; a hinge that has none, but one stiffness, is rigid or
    free, is spread evenly over it.
    """
    if hinge.positions:
        return np.array(hinge.positions)
    first, last = shared_edge(inboard, outboard, hinge)
    if hinge.springs > 1:
        offset = (np.arange(hinge.springs) - (hinge.springs - 1) / 2.0) * hinge.spacing
        return np.asarray((first + last) / 2.0 + offset)
    return first + (last - first) * (np.arange(SPREAD) + 0.5) / SPREAD


def joins_at_points(inboard: Segment, outboard: Segment) -> bool:
    """Return whether a hinge joins its segments at its springs; beams are stiff across them."""
    return {inboard.structure, outboard.structure} != {Structure.BEAM}


def check_hinge(index: int, segments: tuple[Segment, ...], hinge: Hinge) -> None:
    """Raise the fault of a hinge that does not fit between its two segments.

    Parameters
    ----------
    index : int
        Of the hinge, from 0.
    segments : tuple of Segment
        All of the wing.
    hinge : Hinge
    """
    inboard, outboard = segments[index : index + 2]
    where: Path = ("hinges", index)
    if inboard.outline.is_pointed:
        limit = f"segment {index + 1} ends in a point, and no hinge can join another to it"
        raise fault((*where, "flare"), math.degrees(hinge.flare), limit, "Give it a tip edge.")
    _check_beams(index, segments, hinge)
    _check_edge(
        where, hinge, inboard.outline.outboard_edge, f"outboard edge of segment {index + 1}"
    )
    _check_edge(where, hinge, outboard.outline.inboard_edge, f"inboard edge of segment {index + 2}")
    first, last = shared_edge(inboard, outboard, hinge)
    if first >= last:
        limit = f"segments {index + 1} and {index + 2} have no edge in common"
        raise fault(
            (*where, "flare"), math.degrees(hinge.flare), limit, "Move their edges together."
        )
    _check_springs(where, hinge, (inboard, outboard))


def _check_beams(index: int, segments: tuple[Segment, ...], hinge: Hinge) -> None:
    for segment in segments[index : index + 2]:
        if segment.structure is Structure.BEAM and hinge.flare != 0.0:
            limit = "must be 0 at the edge of a beam: beams are joined by hinges along the stream"
            remedy = 'Take structure = "plate" for the segments on both sides.'
            raise fault(("hinges", index, "flare"), math.degrees(hinge.flare), limit, remedy)


def _check_edge(where: Path, hinge: Hinge, edge: Real, name: str) -> None:
    way = edge[1] - edge[0]
    h = hinge.direction
    turned = abs(way[0] * h[1] - way[1] * h[0]) / float(np.linalg.norm(way))
    if turned > PARALLEL or way @ h < 0.0:
        own = math.degrees(flare_of(edge)) + 0.0  # no minus before a zero
        limit = f"must be the flare of the {name}, {own:.6g} degrees"
        remedy = "Both edges at a hinge have its direction: turn the edge, or change the flare."
        raise fault((*where, "flare"), round(math.degrees(hinge.flare), 9), limit, remedy)


def _check_springs(where: Path, hinge: Hinge, sides: tuple[Segment, Segment]) -> None:
    first, last = shared_edge(*sides, hinge)
    room = _EXCESS * (last - first)
    if not hinge.positions:
        length = last - first
        if (hinge.springs - 1) * hinge.spacing > length + room:
            limit = f"{hinge.springs} springs must fit in the edge that both share, {length:g} m"
            remedy = (
                f"Keep the spacing to {length / (hinge.springs - 1):g} m, or take fewer springs."
            )
            raise fault((*where, "spacing"), hinge.spacing, limit, remedy)
    for number, place in enumerate(hinge.positions):
        if not first - room <= place <= last + room:
            limit = f"must lie on the edge that both segments share, {first:g} to {last:g} m"
            remedy = "Measure along the hinge, aft of the point where the outboard segment hangs."
            raise fault((*where, "positions", number), place, limit, remedy)
    if joins_at_points(*sides) and len(spring_places(*sides, hinge)) < 2:
        limit = "a plate held at one point would turn about it"
        raise fault((*where, "positions"), 1, limit, "Give two springs or more.")
