"""Loads of a steady lattice on a folding wing: as a whole, on each segment, about each hinge."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from foldwing.aerodynamics.lattice import Strips, folded_strips, mesh_segments
from foldwing.aerodynamics.panels import strip_panels
from foldwing.aerodynamics.steady import SteadyLattice, at_unit_angle, lift_slope
from foldwing.maths.arrays import Mask, Real
from foldwing.model import Frames, Segment, Wing

NO_FORCE = 1e-9
"""Share of the sum of the sizes of all forces below which a centre of pressure means nothing."""


@dataclass(frozen=True)
class SegmentLoads:
    """Loads on one segment, in N and N m.

    Attributes
    ----------
    normal_force : float
        Along its normal, up for an unfolded wing.
    lift, side_force : float
        Along z and y.
    pitching_moment : float
        About its elastic axis, nose up.
    bending_moment : float
        Of its own load about its inboard edge, positive when it folds the segment up.
    centre_x, centre_y : float
        Centre of pressure: fraction of the chord from the leading edge, and of the span from the
        inboard edge; nan without a force.
    """

    normal_force: float
    lift: float
    side_force: float
    pitching_moment: float
    bending_moment: float
    centre_x: float
    centre_y: float


@dataclass(frozen=True)
class WingLoads:
    """A folding wing in a steady stream; forces in N, moments in N m, of the modelled half alone.

    Attributes
    ----------
    lattice : SteadyLattice
        At the angle of attack, per airspeed.
    lift_slope : float
        Per radian, on the developed area.
    area, projected_area : float
        Developed area of the segments without regard to gaps, and the same seen from above (parts
        above each other both count), in m^2.
    lift_coefficient : float
        On the developed area.
    lift, side_force : float
        Along z and y.
    induced_drag, least_drag : float
        In the Trefftz plane, and the least of this shape for this lift; nan unless
        `least_drag_known`.
    efficiency : float
        Their ratio, at most 1; nan when the least drag is not known.
    pitching_moment : float
        About the elastic axis at the root, nose up.
    root_moment : float
        About the stream axis through the root, positive when it bends the wing up.
    aerodynamic_centre : float
        Fraction of the root chord from its leading edge.
    segments : tuple of SegmentLoads
    hinge_moments : tuple of float
        Of all loads outboard of each hinge about its line, positive when they fold the wing up.
    """

    lattice: SteadyLattice
    lift_slope: float
    area: float
    projected_area: float
    lift_coefficient: float
    lift: float
    side_force: float
    induced_drag: float
    least_drag: float
    efficiency: float
    pitching_moment: float
    root_moment: float
    aerodynamic_centre: float
    segments: tuple[SegmentLoads, ...]
    hinge_moments: tuple[float, ...]

    @property
    def projected_lift_slope(self) -> float:
        """Lift slope per radian on the projected area."""
        return self.lift_slope * self.area / self.projected_area


def wing_strips(wing: Wing, folds: Sequence[float]) -> Strips:
    """Return the strips of the lattice at the fold angles psi_2 .. psi_N in radians."""
    frames = wing.frames(folds)
    return folded_strips(mesh_segments(wing), frames.origins, frames.rotations)


def wing_loads(wing: Wing, folds: Sequence[float], alpha: float, speed: float) -> WingLoads:
    """Return the steady loads on a folding wing.

    Parameters
    ----------
    wing : Wing
        With its lattice, gaps and air.
    folds : sequence of float
        psi_2 .. psi_N in radians.
    alpha : float
        Angle of attack of segment 1 in radians, nose up.
    speed : float
        Airspeed in m/s.
    """
    frames = wing.frames(folds)
    panels = strip_panels(wing_strips(wing, folds), wing.lattice.chordwise)
    unit = at_unit_angle(panels, wing.lattice.image)
    lattice = unit.scaled(alpha)
    pressure = wing.air.density * speed**2
    area = sum(segment.area for segment in wing.segments)
    moment = unit.moment(frames.origins[0])
    known = least_drag_known(wing)
    return WingLoads(
        lattice=lattice,
        lift_slope=lift_slope(unit, area),
        area=area,
        projected_area=_projected_area(wing, frames),
        lift_coefficient=2.0 * float(lattice.total[2]) / area,
        lift=pressure * float(lattice.total[2]),
        side_force=pressure * float(lattice.total[1]),
        induced_drag=pressure * lattice.induced_drag,
        least_drag=pressure * lattice.least_drag if known else np.nan,
        efficiency=unit.efficiency if known else np.nan,
        pitching_moment=pressure * alpha * float(moment[1]),
        root_moment=pressure * alpha * float(moment[0]),
        aerodynamic_centre=_aerodynamic_centre(wing, unit, float(moment[1])),
        segments=_segment_loads(wing, unit, frames, pressure * alpha),
        hinge_moments=_hinge_moments(wing, unit, frames, pressure * alpha),
    )


def least_drag_known(wing: Wing) -> bool:
    """Return whether the least of the drag of its strips is that of the wing.

    Where strips narrow towards a hinge or a wall, the drag of the lattice is inaccurate for
    circulations that bend there; their minimum is too small, and refining does not help.
    """
    bends = wing.count > 1 or wing.lattice.image
    return wing.lattice.spacing != "cosine" or not bends


def _projected_area(wing: Wing, frames: Frames) -> float:
    tilted = zip(wing.segments, frames.rotations, strict=True)
    return float(sum(segment.area * abs(A[2, 2]) for segment, A in tilted))


def _aerodynamic_centre(wing: Wing, unit: SteadyLattice, moment: float) -> float:
    """Return where the lift of an angle of attack acts, as a fraction of the root chord."""
    lift, root = float(unit.total[2]), wing.segments[0]
    if abs(lift) < NO_FORCE * np.abs(unit.forces).sum():
        return float("nan")
    return -moment / (lift * root.chord) + root.elastic_axis


def _segment_loads(
    wing: Wing, unit: SteadyLattice, frames: Frames, factor: float
) -> tuple[SegmentLoads, ...]:
    """Return the loads on each segment; forces per rho U^2 and angle become loads by ``factor``."""
    return tuple(
        _loads_on(segment, _part(unit, unit.panels.segment == index), origin, A, factor)
        for index, (segment, origin, A) in enumerate(
            zip(wing.segments, frames.origins, frames.rotations, strict=True)
        )
    )


def _part(unit: SteadyLattice, strips: Mask) -> SteadyLattice:
    """Return the lattice with the loads on some of its strips alone."""
    mine = np.tile(strips, unit.panels.rows)
    return replace(unit, circulation=np.where(mine, unit.circulation, 0.0))


def _loads_on(
    segment: Segment, part: SteadyLattice, origin: Real, A: Real, factor: float
) -> SegmentLoads:
    normal, (_, side, lift) = float(part.total @ A[:, 2]), part.total.tolist()
    bending, pitching, _ = (A.T @ part.moment(origin)).tolist()
    acts = abs(normal) > NO_FORCE * np.abs(part.forces).sum()
    return SegmentLoads(
        normal_force=factor * normal,
        lift=factor * lift,
        side_force=factor * side,
        pitching_moment=factor * pitching,
        bending_moment=factor * bending,
        centre_x=-pitching / (normal * segment.chord) + segment.elastic_axis if acts else np.nan,
        centre_y=bending / (normal * segment.span) if acts else np.nan,
    )


def _hinge_moments(
    wing: Wing, unit: SteadyLattice, frames: Frames, factor: float
) -> tuple[float, ...]:
    """Return the moment about each hinge line; hinge lines run along the stream."""
    moments = []
    for hinge in range(1, wing.count):
        outboard = _part(unit, unit.panels.segment >= hinge)
        moments.append(factor * float(outboard.moment(frames.origins[hinge])[0]))
    return tuple(moments)
