"""Component modes of a segment from modes that were computed or measured elsewhere.

What a file gives are natural frequencies, modal masses and displacements at points. Surfaces
through the displacements, smooth with their slopes, make them functions of x and y. A segment that
is free to move has its rigid motions exactly, from its mass, centre and moments of inertia.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.maths.splines import Surface, line_spline, on_one_line, plate_spline
from foldwing.model import Planform
from foldwing.structure.component import Root, SectionMotion
from foldwing.structure.imported_doubts import check_place, doubts
from foldwing.structure.imported_selection import (
    Nodes,
    in_plane_shares,
    selected,
    surface_nodes,
)
from foldwing.structure.in_plane import IN_PLANE, in_plane_displacement, with_twisting
from foldwing.structure.mode_files import ModeSet
from foldwing.structure.rigid_properties import RigidProperties, area_rule
from foldwing.structure.sections import section_motion, span_rule

RIGID_MOTIONS = 3
"""Rigid motions out of the plane of a free segment: w = 1, y and -x."""

_SPAN_POINTS = 24
_AREA_POINTS = 24


@dataclass(frozen=True, eq=False)
class ImportedModes:
    """Rigid motions and imported elastic modes of one segment; see `ComponentModes`.

    Coordinates are, of a free segment, the rigid motions w = 1, y and -x, the elastic modes by
    ascending frequency, and the in-plane motions x, y and yaw; of a clamped one the elastic modes
    alone. Natural modes of a free segment have neither momentum nor moment of momentum, so that
    they are coupled to no rigid motion.

    Attributes
    ----------
    planform : Planform
    elastic_axis : float
        Fraction of the chord, from the leading edge, to which section motions refer.
    body : RigidProperties
    root : Root
    surface : Surface
        Displacements w of the elastic modes.
    frequencies, modal_mass, damping : array, shape (e,)
        Of the elastic modes, in Hz, in kg, and as ratios (nan where unknown). The damping is for
        information: it is in none of the matrices.
    modes : tuple of int
        Positions of the elastic modes in the mode set, from 1.
    rigid_left_out : int
        How many rigid modes of the mode set the exact ones replace.
    left_out_error : array, shape (e,)
        Difference of the displacement of a point to a surface made without it, root mean square
        over the points relative to that of the displacement.
    in_plane_share : array, shape (e,)
        Share of the mean square displacement of the points that lies in the plane and is ignored.
    warnings : tuple of str
        What is to be doubted, one sentence each, those of the mode set included.
    """

    planform: Planform
    elastic_axis: float
    body: RigidProperties
    root: Root
    surface: Surface
    frequencies: Real
    modal_mass: Real
    damping: Real
    modes: tuple[int, ...]
    rigid_left_out: int
    left_out_error: Real
    in_plane_share: Real
    warnings: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number n of coordinates."""
        return int(self._blocks[2].stop)

    @property
    def _blocks(self) -> tuple[slice, slice, slice]:
        """Where rigid motions, elastic modes and in-plane motions stand."""
        rigid = RIGID_MOTIONS if self.root is Root.FREE else 0
        n = rigid + len(self.frequencies)
        return slice(0, rigid), slice(rigid, n), slice(n, n + len(IN_PLANE[self.root]))

    @cached_property
    def mass(self) -> Real:
        """Mass matrix, shape (n, n), in kg, kg m and kg m^2."""
        M = np.zeros((self.count, self.count))
        rigid, elastic, in_plane = self._blocks
        if self.root is Root.FREE:
            M[rigid, rigid] = self.body.out_of_plane_mass
            M[in_plane, in_plane] = self.body.in_plane_mass
        M[elastic, elastic] = np.diag(self.modal_mass)
        return M

    @cached_property
    def stiffness(self) -> Real:
        """Stiffness matrix, shape (n, n): omega^2 times the modal mass of elastic modes, in N/m."""
        K = np.zeros((self.count, self.count))
        _, elastic, _ = self._blocks
        K[elastic, elastic] = np.diag((2.0 * np.pi * self.frequencies) ** 2 * self.modal_mass)
        return K

    @property
    def mass_and_centre(self) -> tuple[float, Real]:
        """Mass in kg, and x and y of its centre in m, shape (2,)."""
        return self.body.mass, np.array(self.body.centre)

    @cached_property
    def mass_centre_motion(self) -> Real:
        """Displacement of the mass centre times the mass per coordinate, shape (3, n).

        Exact for rigid motions and zero for elastic modes of a free segment. For those of a clamped
        one the mass is taken as spread evenly over the outline.
        """
        motion = np.zeros((3, self.count))
        rigid, elastic, in_plane = self._blocks
        if self.root is Root.FREE:
            motion[2, rigid] = self.body.out_of_plane_mass[0]
            motion[:2, in_plane] = self.body.in_plane_mass[:2]
        else:
            points, weights = area_rule(self.planform, _AREA_POINTS)
            motion[2, elastic] = self._mass_per_area * weights @ self.surface.evaluate(points)
        return motion

    @cached_property
    def torsion_mass(self) -> Real:
        """Part of the mass matrix that belongs to twisting motion, shape (n, n).

        That of the twist of sections, with the mass spread evenly over the outline, and of in-plane
        x motion and yaw.
        """
        y, weights = span_rule(self.planform, _SPAN_POINTS)
        front, back = self.planform.chord_ends(y)
        axis = front + self.elastic_axis * (back - front)
        inertia = self._mass_per_area * ((back - axis) ** 3 - (front - axis) ** 3) / 3.0
        twist = self.section_motion(y).twist
        M = np.asarray(twist.T @ ((weights * inertia)[:, None] * twist))
        return with_twisting(M, self.mass, self.root)

    @property
    def _mass_per_area(self) -> float:
        return self.body.mass / self.planform.area

    def displacement(self, x: Real, y: Real) -> Real:
        """Return the local displacement per coordinate, shape (m, 3, n)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        rigid, elastic, in_plane = self._blocks
        u = np.zeros((len(y), 3, self.count))
        u[:, 2, elastic] = self.surface.evaluate(np.column_stack([x, y]))
        u[:, :2, in_plane] = in_plane_displacement(x, y, self.root)
        if self.root is Root.FREE:
            u[:, 2, rigid] = np.stack([np.ones_like(y), y, -x], axis=1)
        return u

    def slopes(self, x: Real, y: Real) -> Real:
        """Return dw/dx and dw/dy per coordinate, shape (m, 2, n)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        rigid, elastic, _ = self._blocks
        slopes = np.zeros((len(y), 2, self.count))
        slopes[:, :, elastic] = self.surface.slopes(np.column_stack([x, y]))
        if self.root is Root.FREE:
            slopes[:, :, rigid] = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
        return slopes

    def section_motion(self, y: Real) -> SectionMotion:
        """Return plunge (m, up) and twist (rad, nose up) of the sections at ``y`` (m,)."""
        return section_motion(self.planform, self.elastic_axis, y, self.displacement).motion


def imported_modes(
    mode_set: ModeSet,
    planform: Planform,
    elastic_axis: float,
    body: RigidProperties,
    root: Root,
    count: int | None = None,
    smoothing: float = 0.0,
) -> ImportedModes:
    """Return the component modes of a segment whose elastic modes are imported.

    Parameters
    ----------
    mode_set : ModeSet
        In the local axes of the segment; `ModeSet.placed` turns other axes into these. For a free
        segment its modes are those with free edges, for a clamped one with the inboard edge held.
    planform : Planform
    elastic_axis : float
        Fraction of the chord, from the leading edge, to which section motions refer.
    body : RigidProperties
    root : Root
        Clamped or free.
    count : int, optional
        How many elastic modes are taken, by ascending frequency; all by default.
    smoothing : float
        Length in m below which the surface does not follow the displacements, for measured shapes:
        waves of 2 pi times the length are halved. 0 goes through every point.

    Raises
    ------
    InputError
        When the points are not those of the segment, modes are missing, or an argument is out of
        its range.
    """
    _check_arguments(elastic_axis, root, smoothing)
    check_place(mode_set, planform)
    selection = selected(mode_set, root, count)
    nodes = surface_nodes(mode_set, selection.modes)
    surface, texts = _surface(nodes, smoothing, mode_set.source)
    size = np.sqrt((nodes.values**2).mean(axis=0))
    modes = ImportedModes(
        planform=planform,
        elastic_axis=elastic_axis,
        body=body,
        root=root,
        surface=surface,
        frequencies=mode_set.frequencies[selection.modes],
        modal_mass=mode_set.modal_mass[selection.modes],
        damping=mode_set.damping[selection.modes],
        modes=tuple(int(i) + 1 for i in selection.modes),
        rigid_left_out=selection.rigid,
        left_out_error=np.sqrt((surface.left_out**2).mean(axis=0)) / size,
        in_plane_share=in_plane_shares(mode_set)[selection.modes],
        warnings=(*mode_set.warnings, *selection.warnings, *nodes.warnings, *texts),
    )
    return doubts(modes, mode_set, nodes)


def _check_arguments(elastic_axis: float, root: Root, smoothing: float) -> None:
    if root is Root.CARRIAGE:
        limit = "must be clamped or free for imported modes"
        remedy = "Describe the segment at the root of an aircraft as a beam or a plate."
        raise InputError("root", root.value, limit, remedy)
    if not 0.0 <= elastic_axis <= 1.0:
        limit = "must be a fraction of the chord, 0 to 1"
        raise InputError("elastic_axis", elastic_axis, limit, "Write for example 0.5.")
    if not 0.0 <= smoothing < np.inf:
        limit = "must be a length in m, finite and at least 0"
        raise InputError("smoothing", smoothing, limit, "Leave it out to go through every point.")


def _surface(nodes: Nodes, smoothing: float, source: str) -> tuple[Surface, tuple[str, ...]]:
    if len(nodes.points) < 2 or not np.any(np.ptp(nodes.points, axis=0)):
        limit = "must be 2 or more, in different places of the segment's plane"
        remedy = "Add points, or look whether the placement turns the plane."
        raise InputError(f"{source}: points", len(nodes.points), limit, remedy)
    if not on_one_line(nodes.points):
        return plate_spline(nodes.points, nodes.values, smoothing), ()
    if smoothing > 0.0:
        limit = "must be 0 for points on one line"
        remedy = "Leave it out, or add points away from the line."
        raise InputError("smoothing", smoothing, limit, remedy)
    text = (
        "all points lie on one line: displacements are taken as constant across it, and torsion "
        "about it is not seen"
    )
    return line_spline(nodes.points, nodes.values), (text,)
