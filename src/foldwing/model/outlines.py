"""Outlines of all segments of a wing table, with the flare of the hinges between them."""

from typing import NamedTuple

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model.faults import as_input_error, file_path
from foldwing.model.planform import Planform, flare_of, trapezoid
from foldwing.model.schema import SegmentTable, WingTable
from foldwing.model.segment import MID_CHORD

_NOT_WITH_CORNERS = ("span", "chord", "tip_chord", "sweep")
_SIDES = {3: (1, 1), 4: (1, 2)}
"""By number of corners, where the outboard edge is unless given."""

_FARTHEST = 1e-9


class Outlines(NamedTuple):
    """Outlines of the segments, None for rectangles, and flares of the hinges in rad."""

    planforms: tuple[Planform | None, ...]
    flares: tuple[float, ...]


def outlines(wing: WingTable) -> Outlines:
    """Return outlines and flares; a flare that is not given is that of the edges at the hinge.

    Raises
    ------
    InputError
        When an outline cannot be; it names the field in the file.
    """
    polygons = [_polygon(wing, index, table) for index, table in enumerate(wing.segment)]
    flares = [_flare(wing.segment[i], *polygons[i - 1 : i + 1]) for i in range(1, len(polygons))]
    sides = [0.0, *flares, 0.0]
    planforms = tuple(
        polygon or _trapezoid(wing, index, (sides[index], sides[index + 1]))
        for index, polygon in enumerate(polygons)
    )
    return Outlines(planforms, tuple(flares))


def axis_of(wing: WingTable, table: SegmentTable) -> float:
    """Return the elastic axis of a segment as a fraction of the chord."""
    own = wing.elastic_axis if table.elastic_axis is None else table.elastic_axis
    return MID_CHORD if own is None else own


def _flare(table: SegmentTable, inboard: Planform | None, outboard: Planform | None) -> float:
    assert table.hinge is not None
    if table.hinge.flare is not None:
        return table.hinge.flare
    if inboard is not None and not inboard.is_pointed:
        return flare_of(inboard.outboard_edge)
    return 0.0 if outboard is None else flare_of(outboard.inboard_edge)


def _polygon(wing: WingTable, index: int, table: SegmentTable) -> Planform | None:
    """Return the outline given by corners, its origin where the segment hangs; None without."""
    where = ("wing", "segment", index)
    if table.corners is None:
        if table.outboard_edge is not None:
            path = file_path((*where, "outboard_edge"))
            limit = "belongs to an outline given by corners"
            raise InputError(path, str(list(table.outboard_edge)), limit, "Remove it.")
        return None
    for key in _NOT_WITH_CORNERS:
        if getattr(table, key) is not None:
            path = file_path((*where, key))
            limit = "must not be given together with corners"
            raise InputError(path, getattr(table, key), limit, f"Remove {key}, or the corners.")
    with as_input_error(where, lambda path: ("outboard_edge",) if path == ("tip",) else path):
        drawn = Planform(corners=table.corners, tip=_tip(table))
        axis = axis_of(wing, table)
        start = _share(drawn.inboard_edge, axis)
        corners = tuple((x, y) for x, y in (drawn.array - start).tolist())
        x, y = (_share(drawn.outboard_edge, axis) - start).tolist()
        return Planform(corners=corners, tip=drawn.tip, end=(x, y))


def _tip(table: SegmentTable) -> tuple[int, int]:
    corners, given = np.array(table.corners), table.outboard_edge
    if given is not None:
        return given[0] - 1, given[-1] - 1
    if len(corners) in _SIDES:
        return _SIDES[len(corners)]
    far = corners[:, 1] >= corners[:, 1].max() - _FARTHEST * float(np.ptp(corners))
    first, last = (int(i) for i in np.flatnonzero(far)[[0, -1]])
    return first, last


def _share(edge: Real, share: float) -> Real:
    return np.asarray((1.0 - share) * edge[0] + share * edge[1])


def _trapezoid(wing: WingTable, index: int, flares: tuple[float, float]) -> Planform | None:
    """Return the outline of a segment with taper, sweep or a flared hinge; None for a rectangle."""
    table = wing.segment[index]
    if table.tip_chord is None and table.sweep is None and not any(flares):
        return None
    chord = wing.chord if table.chord is None else table.chord
    span = wing.span if table.span is None else table.span
    if chord is None or span is None:
        return None  # named as missing where the segment is resolved
    chords = chord, chord if table.tip_chord is None else table.tip_chord
    with as_input_error(("wing", "segment", index), lambda path: ("span",)):
        return trapezoid(chords, span, axis_of(wing, table), table.sweep or 0.0, flares)
