"""The segments joined by hinges: everything that does not depend on the fold angles, once.

In local coordinates neither mass, nor stiffness, nor hinge springs depend on the fold; only the
constraints that hold the hinge lines together do. A sweep of fold angles therefore assembles once
and solves many times.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import scipy.linalg

from foldwing.maths.arrays import Real
from foldwing.model import PointMass, Wing
from foldwing.structure.bodies import RigidBody, rigid_bodies
from foldwing.structure.component import ComponentModes, Root
from foldwing.structure.hinges import Joint, hinge_joint
from foldwing.structure.kinds import component_modes


@dataclass(frozen=True)
class Assembly:
    """Component modes of every segment with the wing's mass and stiffness in their coordinates.

    Parameters
    ----------
    wing : Wing
    components : tuple of ComponentModes
        One per segment, from root to tip.
    """

    wing: Wing
    components: tuple[ComponentModes, ...]

    @cached_property
    def slices(self) -> tuple[slice, ...]:
        """Where each segment's coordinates stand among all."""
        ends = np.cumsum([0, *(c.count for c in self.components)])
        return tuple(slice(int(a), int(b)) for a, b in pairwise(ends))

    @property
    def size(self) -> int:
        """Number of coordinates of all segments."""
        return int(self.slices[-1].stop)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What makes the modes of segments doubtful, in words."""
        return tuple(
            f"Segment {number}: {text}."
            for number, component in enumerate(self.components, start=1)
            for text in component.warnings
        )

    @cached_property
    def mass(self) -> Real:
        """Mass matrix of the wing and of rigid bodies at its root, shape (size, size)."""
        M, root = self.wing_mass.copy(), self.slices[0]
        for body in self.bodies:
            M[root, root] += body.mass_matrix(self.components[0])
        return M

    @cached_property
    def wing_mass(self) -> Real:
        """Mass matrix of the segments and point masses alone, shape (size, size)."""
        M = scipy.linalg.block_diag(*(c.mass for c in self.components))
        for point in self.wing.point_masses:
            where = self.slices[point.segment - 1]
            M[where, where] += _point_mass(point, self.components[point.segment - 1])
        return np.asarray(M)

    @cached_property
    def bodies(self) -> tuple[RigidBody, ...]:
        """Rigid bodies at the root; none when it is clamped."""
        return rigid_bodies(self.wing.aircraft)

    @cached_property
    def torsion_mass(self) -> Real:
        """Part of the mass matrix that belongs to twisting, shape (size, size)."""
        return np.asarray(scipy.linalg.block_diag(*(c.torsion_mass for c in self.components)))

    @cached_property
    def stiffness(self) -> Real:
        """Stiffness matrix of the segments and hinge springs, shape (size, size)."""
        K = scipy.linalg.block_diag(*(c.stiffness for c in self.components))
        for index, joint in enumerate(self.joints):
            pair = self._pair(index)
            K[pair, pair] += joint.spring_matrix
        return np.asarray(K)

    @cached_property
    def strains(self) -> Real:
        """Rows that vanish on motions without strain energy, each of unit norm.

        The stiffness of every segment and the slopes of sprung hinges apart: together, the stiffer
        would hide the softer.
        """
        rows = [scipy.linalg.block_diag(*(c.stiffness for c in self.components))]
        for index, joint in enumerate(self.joints):
            if joint.stiffness > 0.0:
                rows.append(self._placed(index, joint.slopes))
        S = np.vstack(rows)
        norms = np.linalg.norm(S, axis=1, keepdims=True)
        return np.asarray(S[norms[:, 0] > 0.0] / norms[norms[:, 0] > 0.0])

    def stored_energy(self, modes: Real) -> Real:
        """Return q^T K q of modes (size, n), which is omega^2 for unit modal mass, shape (n,).

        The energy of a stiff spring is taken from its own rotation, which loses no digits.
        """
        energy = np.zeros(modes.shape[1])
        for component, q in zip(self.components, self.by_segment(modes), strict=True):
            energy += ((component.stiffness @ q) * q).sum(axis=0)
        for index, joint in enumerate(self.joints):
            turned = joint.slopes @ modes[self._pair(index)]
            energy += joint.stiffness * (turned**2).sum(axis=0)
        return energy

    def _pair(self, index: int) -> slice:
        return slice(self.slices[index].start, self.slices[index + 1].stop)

    def _placed(self, index: int, rows: Real) -> Real:
        """Return rows in the coordinates of two neighbours among those of all segments."""
        full = np.zeros((len(rows), self.size))
        full[:, self._pair(index)] = rows
        return full

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """Springs and shared points of every hinge."""
        sides = zip(pairwise(self.wing.segments), pairwise(self.components), strict=True)
        return tuple(
            hinge_joint(hinge, segments, components)
            for hinge, (segments, components) in zip(self.wing.hinges, sides, strict=True)
        )

    def constraints(self, fold_angles: tuple[float, ...]) -> Real:
        """Return C of C q = 0 at the fold angles psi_2 .. psi_N in radians; rows are redundant."""
        rows: list[Real] = [np.zeros((0, self.size))]
        for index, (fold, joint) in enumerate(zip(fold_angles, self.joints, strict=True)):
            rows.append(self._placed(index, joint.constraints(fold)))
        return np.vstack(rows)

    @cached_property
    def mass_factor(self) -> Real:
        """Upper triangular R with R^T R = mass."""
        return np.asarray(scipy.linalg.cholesky(self.mass))

    def by_segment(self, vectors: Real) -> Iterator[Real]:
        """Yield the rows of ``vectors`` (size, n) that belong to each segment."""
        for where in self.slices:
            yield vectors[where]


def _point_mass(point: PointMass, component: ComponentModes) -> Real:
    u = component.displacement(np.array([point.x]), np.array([point.y]))[0]
    return np.asarray(point.mass * u.T @ u)


def assemble(wing: Wing) -> Assembly:
    """Return the assembly of a wing.

    The first segment is clamped, or moves with the aircraft that the wing belongs to.

    Raises
    ------
    InputError
        When modes that a segment imports cannot be read or used.
    """
    first = Root.CLAMPED if wing.aircraft is None else Root.CARRIAGE
    components = tuple(
        component_modes(segment, wing.analysis, Root.FREE if index else first)
        for index, segment in enumerate(wing.segments)
    )
    return Assembly(wing, components)
