"""What speaks against the imported modes of a segment, each in numbers."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model import Planform
from foldwing.structure.component import Root
from foldwing.structure.imported_selection import Nodes
from foldwing.structure.mode_files import ModeSet
from foldwing.structure.rigid_properties import area_rule

if TYPE_CHECKING:
    from foldwing.structure.imported import ImportedModes

OTHER_SIZE = 3.0
"""Extent of the points relative to that of the outline, or the inverse, that is refused."""

OUTSIDE = 0.1
"""Distance from the box around the outline, as a share of its extent, of a point far outside."""

THICK = 0.1
"""Extent of the points across the plane, as a share of that of the outline, that is named."""

COVERED = 0.5
"""Share of the outline's area within the points' hull below which the rest is named."""

LEFT_OUT = 0.05
"""Relative error at points left out from which a mode is named."""

PLANAR = 0.05
"""Share of the mean square displacement in the plane from which a mode is named."""

MOMENTUM = 0.05
"""Share of a free elastic mode that rigid motions make up from which it is named."""

EDGE_MOTION = 0.02
"""Displacement of a clamped edge, relative to the largest, from which a mode is named."""

EDGE_SLOPE = 0.25
"""Slope at a clamped edge, relative to the largest, from which a mode is named."""

MASS_RATIO = 5.0
"""Ratio of modal masses to those of an even sheet, or its inverse, that is named."""

ALIKE = 0.95
"""Cosine of two shapes from which they are named."""

_POINTS = 16
_UNITS = {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.3048}


def check_place(modes: ModeSet, planform: Planform) -> None:
    """Raise `InputError` when the points are not those of the segment: other units, other place."""
    extent = float(np.ptp(modes.points[:, :2], axis=0).max()) / planform.size
    if not 1.0 / OTHER_SIZE <= extent <= OTHER_SIZE:
        limit = f"must be from {1.0 / OTHER_SIZE:.2g} to {OTHER_SIZE:g}"
        field = f"{modes.source}: extent of the points relative to that of the segment's outline"
        raise InputError(field, float(f"{extent:.4g}"), limit, _unit_remedy(extent))
    outside = int(_far_outside(modes.points, planform).sum())
    if 2 * outside > len(modes.points):
        limit = "at most half of the points may lie outside the outline of the segment"
        remedy = "Give the axes of the file with a Placement; the origin is at the inboard edge."
        given = f"{outside} of {len(modes.points)}"
        raise InputError(f"{modes.source}: points far outside", given, limit, remedy)


def _unit_remedy(extent: float) -> str:
    factors = {f"{n}": f for n, f in _UNITS.items()} | {
        f"m where {n} was said": 1.0 / f for n, f in _UNITS.items()
    }
    name, factor = min(factors.items(), key=lambda each: abs(np.log(each[1] * max(extent, 1e-99))))
    if abs(np.log(factor * max(extent, 1e-99))) < np.log(2.0):
        return f"The coordinates look like {name}: multiply length_unit by {factor:g}."
    return "Give the unit of length of the file with length_unit, or the scale of the Placement."


def _far_outside(points: Real, planform: Planform) -> Real:
    room = OUTSIDE * planform.size
    low, high = planform.array.min(axis=0) - room, planform.array.max(axis=0) + room
    return np.asarray(np.any((points[:, :2] < low) | (points[:, :2] > high), axis=1))


def doubts(modes: "ImportedModes", mode_set: ModeSet, nodes: Nodes) -> "ImportedModes":
    """Return the modes with their doubts among the warnings."""
    points, weights = area_rule(modes.planform, _POINTS)
    w = modes.surface.evaluate(points)
    largest = np.abs(np.vstack([w, nodes.values])).max(axis=0)
    texts = [
        *_about_points(modes.planform, mode_set, nodes),
        *_about_fit(modes),
        *_about_likeness(modes, nodes),
        *_about_masses(modes, weights, w),
    ]
    if modes.root is Root.FREE:
        texts += _about_momentum(modes, points, weights, w)
    else:
        texts += _about_clamping(modes, points, largest)
    return replace(modes, warnings=(*modes.warnings, *texts))


def _named(modes: "ImportedModes", values: Real, limit: float, what: str) -> list[str]:
    """Return one sentence with the modes whose value is above a limit, and their percentages."""
    above = np.flatnonzero(values > limit)
    if not len(above):
        return []
    each = ", ".join(f"{modes.modes[i]} ({values[i]:.1%})" for i in above)
    return [f"{'mode' if len(above) == 1 else 'modes'} {each}: {what}"]


def _about_points(planform: Planform, mode_set: ModeSet, nodes: Nodes) -> list[str]:
    from scipy.spatial import ConvexHull, QhullError

    texts = []
    outside = int(_far_outside(mode_set.points, planform).sum())
    if outside:
        texts.append(f"{outside} of {len(mode_set.points)} points lie far outside the outline")
    thickness = float(np.ptp(mode_set.points[:, 2]))
    if thickness > THICK * planform.size:
        texts.append(
            f"the points extend over {thickness:.3g} m across the plane of the segment; their "
            "distance from it is ignored"
        )
    try:
        covered = ConvexHull(nodes.points).volume / planform.area  # in a plane, the area
    except (QhullError, ValueError):
        return texts
    if covered < COVERED:
        texts.append(
            f"the points enclose {covered:.0%} of the outline; elsewhere shapes are extrapolated"
        )
    return texts


def _about_fit(modes: "ImportedModes") -> list[str]:
    left_out = "displacement of a point against a surface made without it, rms; noise, or too few"
    return [
        *_named(modes, modes.left_out_error, LEFT_OUT, f"{left_out} points"),
        *_named(modes, modes.in_plane_share, PLANAR, "share of motion in the plane, ignored"),
    ]


def _about_likeness(modes: "ImportedModes", nodes: Nodes) -> list[str]:
    rows = nodes.values / np.linalg.norm(nodes.values, axis=0)
    alike = np.triu(np.abs(rows.T @ rows), 1)
    return [
        f"modes {modes.modes[i]} and {modes.modes[j]} are hard to tell apart at the points: the "
        f"cosine of their shapes is {alike[i, j]:.3f}"
        for i, j in np.argwhere(alike > ALIKE)
    ]


def _about_masses(modes: "ImportedModes", weights: Real, w: Real) -> list[str]:
    even = modes.body.mass / modes.planform.area * (weights @ w**2)
    ratio = float(np.median(modes.modal_mass / even))
    if 1.0 / MASS_RATIO <= ratio <= MASS_RATIO:
        return []
    return [
        f"modal masses are {ratio:.3g} times those of the same shapes on an even sheet of the "
        "segment's mass, in the median: is the unit of mass right?"
    ]


def _about_momentum(modes: "ImportedModes", points: Real, weights: Real, w: Real) -> list[str]:
    rigid = np.column_stack([np.ones(len(points)), points])
    P, M = (weights * rigid.T) @ w, (weights * rigid.T) @ rigid
    share = np.sqrt((P * np.linalg.solve(M, P)).sum(axis=0) / (weights @ w**2))
    what = "rigid motion in a mode of a free segment, if its mass were spread evenly"
    return _named(modes, share, MOMENTUM, what)


def _about_clamping(modes: "ImportedModes", points: Real, largest: Real) -> list[str]:
    lead, trail = modes.planform.inboard_edge
    along = (trail - lead) / np.linalg.norm(trail - lead)
    edge = lead + np.linspace(0.0, 1.0, 21)[:, None] * (trail - lead)
    motion = np.abs(modes.surface.evaluate(edge)).max(axis=0) / largest
    # Twist gives the edge a slope too, but none at the elastic axis.
    axis = lead + modes.elastic_axis * (trail - lead)
    slope = np.abs(np.array([-along[1], along[0]]) @ modes.surface.slopes(axis))[0]
    steepest = np.linalg.norm(modes.surface.slopes(points), axis=1).max(axis=0)
    what = "at the clamped edge, of the largest"
    return [
        *_named(modes, motion, EDGE_MOTION, f"displacement {what}"),
        *_named(modes, slope / steepest, EDGE_SLOPE, f"slope on the elastic axis {what}"),
    ]
