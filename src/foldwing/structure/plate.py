"""Component modes of a plate segment of any outline (Kirchhoff bending, no rotary inertia)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Real
from foldwing.maths.triangles import Triangles
from foldwing.model import Planform, Sheet
from foldwing.structure.component import Root, SectionMotion
from foldwing.structure.in_plane import (
    IN_PLANE,
    in_plane_displacement,
    in_plane_mass,
    with_twisting,
)
from foldwing.structure.plate_cache import kept_elastic_modes
from foldwing.structure.plate_elastic import RIGID, ElasticModes
from foldwing.structure.plate_elements import monomials
from foldwing.structure.sections import ALONG, section_inertia, section_motion, span_rule

OUT_OF_PLANE: dict[Root, list[int]] = {
    Root.CLAMPED: [],
    Root.CARRIAGE: [0, 1],
    Root.FREE: [0, 1, 2],
}
"""Rigid motions of a segment out of its plane, of plunge, pitch nose up and roll: 1, -x, y."""

_RIGID = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
"""Plunge, pitch and roll (columns) in terms of 1, x and y."""

CELLS, CELLS_PER_MODE = 200.0, 4.0
"""Squares of the size of the elements that cover a plate: at least, and for every mode."""


@dataclass(frozen=True)
class Plate:
    """A plate segment.

    Attributes
    ----------
    planform : Planform
        Outline in local axes, x aft and y outboard, in m.
    sheet : Sheet
        What it is made of.
    elastic_axis : float
        Fraction of the local chord along the stream at which sections have their plunge.
    """

    planform: Planform
    sheet: Sheet
    elastic_axis: float


@dataclass(frozen=True)
class PlateModes:
    """Rigid motions out of the plane, elastic modes, and in-plane rigid motions of one segment.

    Parameters
    ----------
    plate : Plate
    elastic : ElasticModes
    root : Root
        How its inboard edge may move.
    """

    plate: Plate
    elastic: ElasticModes
    root: Root

    @property
    def count(self) -> int:
        """Number n of coordinates."""
        return int(self._blocks[2].stop)

    @property
    def frequencies(self) -> Real:
        """Natural frequencies of the elastic modes of this segment alone in Hz."""
        return np.asarray(np.sqrt(self.elastic.omega2) / (2.0 * np.pi))

    @property
    def _blocks(self) -> tuple[slice, slice, slice]:
        """Where rigid motions out of the plane, elastic modes and in-plane motions stand."""
        rigid = len(OUT_OF_PLANE[self.root])
        elastic = rigid + len(self.elastic.omega2)
        return slice(0, rigid), slice(rigid, elastic), slice(elastic, elastic + len(self._in_plane))

    @property
    def _in_plane(self) -> list[int]:
        return IN_PLANE[self.root]

    @property
    def _rigid(self) -> Real:
        return _RIGID[:, OUT_OF_PLANE[self.root]]

    @property
    def warnings(self) -> tuple[str, ...]:
        """Nothing: the modes are computed here."""
        return ()

    @cached_property
    def mass(self) -> Real:
        """Mass matrix, shape (n, n), in kg, kg m and kg m^2."""
        rigid, elastic, in_plane = self._blocks
        modes, R = self.elastic, self._rigid
        M = np.zeros((self.count, self.count))
        M[rigid, rigid] = R.T @ modes.moments @ R
        M[rigid, elastic] = R.T @ modes.coupling
        M[elastic, rigid] = M[rigid, elastic].T
        M[elastic, elastic] = modes.moments[0, 0] * np.eye(len(modes.omega2))
        M[in_plane, in_plane] = self._in_plane_mass()[np.ix_(self._in_plane, self._in_plane)]
        return M

    def _in_plane_mass(self) -> Real:
        J = self.elastic.moments
        m, by_x, by_y, polar = J[0, 0], J[0, 1], J[0, 2], J[1, 1] + J[2, 2]
        return in_plane_mass(m, by_x, by_y, polar)

    @cached_property
    def stiffness(self) -> Real:
        """Stiffness matrix, shape (n, n), in N/m; exactly zero for rigid motions."""
        diagonal = np.zeros(self.count)
        diagonal[self._blocks[1]] = self.elastic.moments[0, 0] * self.elastic.omega2
        return np.diag(diagonal)

    @cached_property
    def torsion_mass(self) -> Real:
        """Mass of the twist of sections, and of in-plane x motion and yaw, which it drives."""
        plate = self.plate
        y, weights = span_rule(plate.planform, ALONG + self.count)
        inertia = section_inertia(plate.planform, plate.sheet, plate.elastic_axis, y)
        twist = self.section_motion(y).twist
        M = np.asarray(twist.T @ ((weights * inertia)[:, None] * twist))
        return with_twisting(M, self.mass, self.root)

    @property
    def mass_and_centre(self) -> tuple[float, Real]:
        """Mass in kg, and x and y of its centre in m, shape (2,)."""
        m, *by = self.elastic.moments[0]
        return float(m), np.array(by) / m

    @cached_property
    def mass_centre_motion(self) -> Real:
        """Displacement of the mass centre times the mass per coordinate, shape (3, n)."""
        rigid, elastic, in_plane = self._blocks
        motion = np.zeros((3, self.count))
        motion[:2, in_plane] = self._in_plane_mass()[:2, self._in_plane]
        motion[2, rigid] = self.elastic.moments[0] @ self._rigid
        motion[2, elastic] = self.elastic.coupling[0]
        return motion

    @cached_property
    def _triangles(self) -> Triangles:
        return Triangles(self.elastic.points, self.elastic.corners)

    def displacement(self, x: Real, y: Real) -> Real:
        """Return the local displacement per coordinate, shape (m, 3, n)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        rigid, elastic, in_plane = self._blocks
        u = np.zeros((len(y), 3, self.count))
        u[:, 2, rigid] = np.stack([np.ones_like(y), x, y], axis=1) @ self._rigid
        u[:, 2, elastic] = self._of_elements(x, y, [(0, 0)])[:, 0]
        u[:, :2, in_plane] = in_plane_displacement(x, y, self.root)
        return u

    def slopes(self, x: Real, y: Real) -> Real:
        """Return dw/dx and dw/dy per coordinate, shape (m, 2, n)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        rigid, elastic, _ = self._blocks
        slopes = np.zeros((len(y), 2, self.count))
        slopes[:, :, rigid] = self._rigid[1:]
        slopes[:, :, elastic] = self._of_elements(x, y, [(1, 0), (0, 1)])
        return slopes

    def _of_elements(self, x: Real, y: Real, derivatives: list[tuple[int, int]]) -> Real:
        """Return derivatives of the elastic modes, shape (m, derivatives, modes)."""
        points, modes = np.stack([x, y], axis=1), self.elastic
        element: Indices = self._triangles.holding(points)
        size = modes.sizes[element]
        local = (points - modes.middles[element]) / size[:, None]
        terms = [monomials(local, d) / size[:, None] ** sum(d) for d in derivatives]
        return np.asarray(np.stack(terms, axis=1) @ modes.coefficients[element])

    def section_motion(self, y: Real) -> SectionMotion:
        """Return plunge (m, up) and twist (rad, nose up) of the sections at ``y`` (m,)."""
        plate = self.plate
        return section_motion(plate.planform, plate.elastic_axis, y, self.displacement).motion


def plate_modes(plate: Plate, count: int, root: Root, size: float | None = None) -> PlateModes:
    """Return the component modes of a plate segment.

    Parameters
    ----------
    plate : Plate
    count : int
        Number of modes out of the plane. Those of a free plate include its `RIGID` rigid motions;
        at the root of an aircraft plunge and pitch come on top of the modes of the clamped plate.
    root : Root
        How the inboard edge may move.
    size : float, optional
        Of the elements, in m; by default such that squares of it cover the plate `CELLS` times, or
        `CELLS_PER_MODE` times for every mode.

    Raises
    ------
    InputError
        When there is no mode, elements have no size, or the outline needs netgen and it is not
        installed.
    ComputationError
        When the elements are too few for the modes.
    """
    clamped = root is not Root.FREE
    rigid = 0 if clamped else RIGID
    if count <= rigid:
        limit = f"must be at least {rigid + 1} for a plate that is {root.value}"
        raise InputError("count", count, limit, "Ask for more modes.")
    if size is not None and not size > 0.0:
        raise InputError("size", size, "must be greater than 0 m", "Leave it out.")
    if size is None:
        size = float(np.sqrt(plate.planform.area / max(CELLS, CELLS_PER_MODE * count)))
    elastic = kept_elastic_modes(plate.planform, plate.sheet, count - rigid, clamped, float(size))
    return PlateModes(plate, elastic, root)
