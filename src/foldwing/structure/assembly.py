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
from foldwing.maths.rotations import rotation_about_x
from foldwing.model import PointMass, Wing
from foldwing.structure.beam import beam_modes
from foldwing.structure.bodies import RigidBody, rigid_bodies
from foldwing.structure.component import ComponentModes, Root
from foldwing.structure.hinges import (
    hinge_points,
    hinge_stiffness,
    relative_slope,
    slope_constraint,
)


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
        for joint, hinge in enumerate(self.wing.hinges):
            pair = self._pair(joint)
            K[pair, pair] += hinge_stiffness(hinge, self._slopes[joint])
        return np.asarray(K)

    @cached_property
    def strains(self) -> Real:
        """Rows that vanish on motions without strain energy, each of unit norm.

        The stiffness of every segment and the slopes of sprung hinges apart: together, the stiffer
        would hide the softer.
        """
        rows = [scipy.linalg.block_diag(*(c.stiffness for c in self.components))]
        for joint, hinge in enumerate(self.wing.hinges):
            if hinge.stiffness > 0.0:
                row = np.zeros((1, self.size))
                row[0, self._pair(joint)] = self._slopes[joint]
                rows.append(row)
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
        for joint, hinge in enumerate(self.wing.hinges):
            energy += hinge.stiffness * (self._slopes[joint] @ modes[self._pair(joint)]) ** 2
        return energy

    def _pair(self, joint: int) -> slice:
        return slice(self.slices[joint].start, self.slices[joint + 1].stop)

    @cached_property
    def _slopes(self) -> tuple[Real, ...]:
        return tuple(
            relative_slope(inner, segment.span, outer)
            for inner, segment, outer in zip(
                self.components[:-1], self.wing.segments[:-1], self.components[1:], strict=True
            )
        )

    @cached_property
    def _edges(self) -> tuple[tuple[Real, Real], ...]:
        """Local displacements of the shared points, inboard and outboard side, per hinge."""
        edges = []
        for joint, (inner, outer) in enumerate(
            zip(self.components, self.components[1:], strict=False)
        ):
            segments = self.wing.segments
            x = hinge_points(segments[joint], segments[joint + 1])
            span = np.full(len(x), segments[joint].span)
            edges.append((inner.displacement(x, span), outer.displacement(x, np.zeros(len(x)))))
        return tuple(edges)

    def constraints(self, fold_angles: tuple[float, ...]) -> Real:
        """Return C of C q = 0 at the fold angles psi_2 .. psi_N in radians; rows are redundant."""
        rows = [np.zeros((0, self.size))]
        for joint, (fold, hinge) in enumerate(zip(fold_angles, self.wing.hinges, strict=True)):
            inner, outer = self._edges[joint]
            turned = np.einsum("ab,mbn->man", rotation_about_x(fold), outer)
            together = np.concatenate([inner, -turned], axis=2).reshape(
                -1, inner.shape[2] + outer.shape[2]
            )
            block = np.vstack([together, slope_constraint(hinge, self._slopes[joint])])
            full = np.zeros((len(block), self.size))
            full[:, self._pair(joint)] = block
            rows.append(full)
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
    """Return the assembly of a wing with beam segments.

    The first segment is clamped, or moves with the aircraft that the wing belongs to.
    """
    first = Root.CLAMPED if wing.aircraft is None else Root.CARRIAGE
    components = tuple(
        beam_modes(segment, wing.analysis, Root.FREE if index else first)
        for index, segment in enumerate(wing.segments)
    )
    return Assembly(wing, components)
