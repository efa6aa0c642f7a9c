"""An aircraft in flight: its tail, its trim, and the forces that the steady lift adds.

The steady lift L of a segment does not depend on the airspeed; it carries the weight. Two terms
make it felt in motion, without which there is no phugoid: flying faster by -u', u aft, it grows by
2 L (-u')/U, and rising by h' it turns aft by h'/U. In strip theory the growth lags as a whole by
Theodorsen's function. In the vortex lattice the stream past the bound vortices is faster at once,
and the wash of the faster stream builds up its circulation as any other wash does.
"""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.aerodynamics.combined import CombinedModel
from foldwing.aerodynamics.panel_loads import panel_loads
from foldwing.aerodynamics.port import AerodynamicModel
from foldwing.aerodynamics.strip import (
    StripForces,
    StripModel,
    strip_forces,
    trim_strip_forces,
)
from foldwing.aerodynamics.unsteady import LatticeModel
from foldwing.aeroelastic.trim import LiftingSurfaces, Trim, trim
from foldwing.maths.arrays import Complex, Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Aircraft, HingeKind, Tail, Wing
from foldwing.model.aircraft import QUARTER, quarter_chord
from foldwing.structure.component import ComponentModes
from foldwing.structure.mass_centres import mass_centres
from foldwing.structure.modes import StructuralModes

if TYPE_CHECKING:
    from foldwing.aeroelastic.wing import AeroelasticWing


def aircraft_of(wing: Wing) -> Aircraft:
    """Return the aircraft that a wing belongs to."""
    if wing.aircraft is None:
        raise ValueError("wing.aircraft: got None; a clamped wing has no trim")
    return wing.aircraft


def free_hinge_warning(wing: Wing) -> str:
    """Return that a free hinge of an aircraft is out of balance in words, empty otherwise."""
    free = [i for i, hinge in enumerate(wing.hinges, start=2) if hinge.kind is HingeKind.FREE]
    if wing.aircraft is None or not free:
        return ""
    which = ", ".join(str(number) for number in free)
    return (
        f"Hinge {which} is free: nothing balances the moment of the steady lift about it, so that "
        "level flight at this fold angle is no equilibrium."
    )


def tail_lags(aircraft: Aircraft) -> bool:
    """Return whether the forces on the tail lag behind its motion."""
    return aircraft.tail_aerodynamics == "theodorsen"


def tail_forces(wing: Wing, root: ComponentModes) -> StripForces:
    """Return the forces on the tail in the coordinates of segment 1."""
    aircraft = aircraft_of(wing)
    tail = aircraft.tail
    plunge, twist, _ = _tail_motion(tail, root)
    forces = strip_forces(tail, wing.air.density, np.array([tail.span]), plunge, twist)
    return forces if tail_lags(aircraft) else forces.quasi_steady


def _tail_motion(tail: Tail, root: ComponentModes) -> tuple[Real, Real, Real]:
    """Return plunge, twist and displacement aft of the tail's elastic axis, each (1, n)."""
    u = root.displacement(np.array([tail.x]), np.zeros(1))
    return u[:, 2], root.section_motion(np.zeros(1)).twist, u[:, 0]


def aircraft_trim(model: "AeroelasticWing", modes: StructuralModes) -> Trim:
    """Return level flight of the aircraft at the fold angles of its modes.

    Raises
    ------
    InputError
        When no angle of attack lifts the weight.
    """
    wing, aircraft = model.wing, aircraft_of(model.wing)
    whole = mass_centres(modes)[-1]
    surfaces = lifting_surfaces(model, modes)
    air = wing.air.density, aircraft.largest_lift_coefficient
    balances = aircraft.trim == "force-and-moment"
    return trim(surfaces, whole.mass * aircraft.gravity, float(whole.position[0]), air, balances)


def lifting_surfaces(model: "AeroelasticWing", modes: StructuralModes) -> LiftingSurfaces:
    """Return the steady lift of every segment and of the tail at 1 rad."""
    wing, rho = model.wing, model.wing.air.density
    tail = aircraft_of(wing).tail
    cosine = np.cos(np.cumsum([0.0, *modes.fold_angles]))
    half = np.array([s.lift_slope * rho * s.half_chord * s.span for s in wing.segments])
    slope, place = half * cosine**2, np.array([quarter_chord(s) for s in wing.segments])
    if model.aerodynamics == "lattice":
        slope, place = _lattice_lift(model, modes)
    on_tail = tail.lift_slope * rho * tail.half_chord * tail.span
    return LiftingSurfaces(
        slope=np.append(slope, on_tail),
        flat=np.append(half, on_tail),
        place=np.append(place, tail.quarter_chord),
        area=np.append([segment.area for segment in wing.segments], tail.area),
        cosine=np.append(cosine, 1.0),
    )


def _steady_circulation(model: "AeroelasticWing", modes: StructuralModes) -> Real:
    """Return the circulation of every panel at 1 rad over the airspeed in metres."""
    influence = model.influence(modes)
    return np.linalg.solve(influence.wing, -_upward(model, modes))


def _upward(model: "AeroelasticWing", modes: StructuralModes) -> Real:
    """Return the vertical component of the normal of every panel."""
    strips, rows = model.strips(modes), model.wing.lattice.chordwise
    cosine = np.cos(np.cumsum([0.0, *modes.fold_angles]))
    return np.tile(cosine[strips.segment], rows)


def _lattice_lift(model: "AeroelasticWing", modes: StructuralModes) -> tuple[Real, Real]:
    """Return vertical lift of every segment at 1 rad, and where it acts aft of the elastic axis."""
    strips, rows = model.strips(modes), model.wing.lattice.chordwise
    load = model.wing.air.density * np.tile(strips.width, rows)
    lift = load * _steady_circulation(model, modes) * _upward(model, modes)
    segment = np.tile(strips.segment, rows)
    x = (strips.leading + (np.arange(rows)[:, None] + QUARTER) * strips.chord / rows).ravel()
    count = len(model.wing.segments)
    slope: Real = np.bincount(segment, lift, count).astype(float)
    moment: Real = np.bincount(segment, lift * x, count).astype(float)
    with np.errstate(invalid="ignore", divide="ignore"):
        return slope, np.where(slope == 0.0, 0.0, moment / slope)


def trim_forces(
    model: "AeroelasticWing", modes: StructuralModes, level: Trim, lattice: LatticeModel | None
) -> AerodynamicModel:
    """Return what the steady lift adds to the forces: Qhat_0 as a model of its own.

    Parameters
    ----------
    model : AeroelasticWing
    modes : StructuralModes
    level : Trim
        At the same fold angles.
    lattice : LatticeModel, optional
        That of the wing, when it has one.
    """
    if lattice is None:
        return _trim_strips(model, modes, level)
    wash = _faster_stream(model, modes, level)
    tail = _tail_trim_forces(model, level).projected(modes.by_segment[0])
    strips = StripModel(model.half_chord, (*_at_once(model, modes, level), tail))
    return CombinedModel((lattice.driven(np.zeros_like(wash), wash), strips))


def trim_forces_by_surface(
    model: "AeroelasticWing", modes: StructuralModes, level: Trim, p: Complex
) -> Complex:
    """Return the part of Qhat_0 from each segment and, last, from the tail: (m, s, n, n)."""
    if model.aerodynamics != "lattice":
        return _trim_strips(model, modes, level).forces_by_segment(p)
    wash = _faster_stream(model, modes, level)
    motion = model.panel_motion(modes)._replace(slope=np.zeros_like(wash), collocation=wash)
    air = model.wing.air.density, model.half_chord
    lattice = model.wing.lattice
    loads = panel_loads(model.influence(modes), motion, model.load_lengths, air, lattice, p)
    tail = _tail_trim_forces(model, level).projected(modes.by_segment[0])
    strips = StripModel(model.half_chord, (*_at_once(model, modes, level), tail))
    forces = strips.forces_by_segment(p)
    forces[:, :-1] += loads.forces_by_segment()
    return forces


def tail_forces_alone(model: "AeroelasticWing", modes: StructuralModes, p: Complex) -> Complex:
    """Return the part of Qhat from the tail, shape (m, n, n)."""
    forces = tail_forces(model.wing, model.assembly.components[0])
    return StripModel(model.half_chord, (forces.projected(modes.by_segment[0]),)).forces(p)


def _trim_strips(model: "AeroelasticWing", modes: StructuralModes, level: Trim) -> StripModel:
    own = zip(_segment_trim_forces(model, level), modes.by_segment, strict=True)
    tail = _tail_trim_forces(model, level).projected(modes.by_segment[0])
    return StripModel(model.half_chord, (*(forces.projected(q) for forces, q in own), tail))


def _segment_trim_forces(model: "AeroelasticWing", level: Trim) -> list[StripForces]:
    lags, rho = model.aerodynamics == "strip", model.wing.air.density
    result = []
    for index, segment in enumerate(model.wing.segments):
        component = model.assembly.components[index]
        y, weights = gauss_rule(segment.span, component.count + 24)
        angle = level.incidence * level.surfaces.cosine[index]
        load = segment.lift_slope * rho * segment.half_chord * angle
        surge = component.displacement(np.zeros_like(y), y)[:, 0]
        motion = (*component.section_motion(y), surge)
        result.append(trim_strip_forces(segment, float(load), weights, motion, lags))
    return result


def _tail_trim_forces(model: "AeroelasticWing", level: Trim) -> StripForces:
    aircraft = aircraft_of(model.wing)
    tail, root = aircraft.tail, model.assembly.components[0]
    load = float(level.lift[-1]) / tail.span
    motion = _tail_motion(tail, root)
    return trim_strip_forces(tail, load, np.array([tail.span]), motion, tail_lags(aircraft))


def _faster_stream(model: "AeroelasticWing", modes: StructuralModes, level: Trim) -> Real:
    """Return the wash of a faster stream, alpha n_z u', on top of the steady one, -alpha n_z U."""
    return level.incidence * _upward(model, modes)[:, None] * _surge(model, modes)


def _at_once(
    model: "AeroelasticWing", modes: StructuralModes, level: Trim
) -> tuple[StripForces, ...]:
    """Return the forces of a faster stream past, and of the tilted lift on, the bound vortices.

    Those on each segment apart.
    """
    strips, rows = model.strips(modes), model.wing.lattice.chordwise
    load = model.wing.air.density * np.tile(strips.width, rows)
    load = load * level.incidence * _steady_circulation(model, modes)
    w, u, segment = model.panel_motion(modes).vortex, _surge(model, modes), strips.segment
    zero = np.zeros((w.shape[1],) * 2)
    result = []
    for number in range(len(model.wing.segments)):
        own = np.tile(segment == number, rows)
        coupling = u[own].T @ (load[own, None] * w[own])
        forces = StripForces(model.half_chord, zero, coupling - coupling.T, zero, zero)
        result.append(forces)
    return tuple(result)


def _surge(model: "AeroelasticWing", modes: StructuralModes) -> Real:
    """Return the displacement aft of every panel at the elastic axis, shape (panels, n)."""
    parts = [
        component.displacement(np.zeros_like(mesh.middle), mesh.middle)[:, 0] @ q
        for component, mesh, q in zip(
            model.assembly.components, model.meshes, modes.by_segment, strict=True
        )
    ]
    return np.tile(np.concatenate(parts), (model.wing.lattice.chordwise, 1))
