"""What the air does at the flutter points: work, and with a lattice pressure and circulation."""

from typing import Any

import numpy as np

from foldwing.aeroelastic.loads import Loads, Motions, loads_of, panel_grid
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.arrays import Complex
from foldwing.structure.modes import StructuralModes
from foldwing.studies.case import Case
from foldwing.studies.shapes import SurfaceGrid

Variables = dict[str, Any]

AMPLITUDE = 0.01
"""Largest displacement to which loads belong, in chords of segment 1."""

LEADING_MODES, LEADING_SHARE = 3, 0.01
"""Most modes whose pressure is kept, and the share in the kinetic energy that they need."""


def unit_motions(modes: StructuralModes, q: Complex, grid: SurfaceGrid) -> tuple[Complex, Complex]:
    """Return motions ``q`` (points, n) scaled to a largest displacement of 1 m with phase zero.

    Returns
    -------
    q : array, shape (points, n)
        In modal coordinates.
    shapes : array, shape (points, m, 3)
        Displacement of the points of the grid.
    """
    shapes = np.einsum("pan,fn->fpa", grid.displacement(modes), q)
    if len(shapes):
        flat = shapes.reshape(len(shapes), -1)
        largest = flat[np.arange(len(flat)), np.abs(flat).argmax(axis=1)]
        q, shapes = q / largest[:, None], shapes / largest[:, None, None]
    return q, shapes


def load_variables(model: AeroelasticWing, case: Case, q: Complex) -> tuple[Variables, Variables]:
    """Return variables and coordinates of the loads at the flutter points of a case.

    Parameters
    ----------
    model : AeroelasticWing
    case : Case
    q : array, shape (points, n)
        Motions whose largest displacement is 1 m.
    """
    points, amplitude = case.analysis.points, AMPLITUDE * 2.0 * model.half_chord
    p = np.array([point.p for point in points], complex)
    speed = np.array([point.speed for point in points], float)
    loads = loads_of(model, case.modes, Motions(p, speed, amplitude * q))
    at, further = ("flutter_point",), {"amplitude": amplitude}
    count = len(model.wing.segments)
    tail = {} if model.wing.aircraft is None else {"tail": count + 1}
    between = (*at, "moving_mode", "driving_mode")
    variables: Variables = {
        "work": ((*at, "wing_segment"), loads.work_by_segment, further | tail),
        "work_between_modes": (between, loads.work_between_modes, further),
        "kinetic_energy": (at, loads.kinetic_energy, further),
        "mode_share": ((*at, "moving_mode"), loads.mode_shares),
    }
    numbers = np.arange(1, case.modes.count + 1)
    coords: Variables = {
        "wing_segment": (("wing_segment",), np.arange(1, loads.forces.shape[1] + 1)),
        "moving_mode": (("moving_mode",), numbers),
        "driving_mode": (("driving_mode",), numbers),
    }
    if loads.panels is None:
        return variables, coords
    panels = (*at, "panel")
    variables["circulation"] = (panels, loads.circulation(), further)
    variables["pressure"] = (panels, loads.pressure(), further)
    more, places = _of_modes(case, loads, further)
    where, numbering = _panels(model, case)
    return variables | where | more, coords | numbering | places


def _of_modes(case: Case, loads: Loads, further: Variables) -> tuple[Variables, Variables]:
    """Return what the leading modes add to the pressure at the lowest flutter onset."""
    events = [(point.kind, point.event) for point in case.analysis.points]
    if ("flutter", "onset") not in events:
        return {}, {}
    index = events.index(("flutter", "onset"))
    shares = loads.mode_shares[index]
    largest = np.argsort(-shares)[:LEADING_MODES]
    leading = largest[shares[largest] >= LEADING_SHARE]
    values = loads.pressure_of_modes(index)[leading]
    attributes = {**further, "flutter_point": index}
    return (
        {"mode_pressure": (("leading_mode", "panel"), values, attributes)},
        {"leading_mode": (("leading_mode",), leading + 1)},
    )


def _panels(model: AeroelasticWing, case: Case) -> tuple[Variables, Variables]:
    grid, dims = panel_grid(model, case.modes), ("panel",)
    coords: Variables = {
        "panel": (dims, np.arange(len(grid.span))),
        "panel_segment": (dims, grid.segment + 1),
        "panel_chordwise": (dims, grid.chordwise),
        "panel_spanwise": (dims, grid.spanwise),
        "panel_span": (dims, grid.span),
        "corner": (("corner",), np.arange(4)),
    }
    return {"panel_position": (("panel", "corner", "axis"), grid.corners)}, coords
