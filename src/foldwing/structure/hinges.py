"""Hinges: what they store as energy and what they constrain, in the segments' local coordinates.

A spring at a point of the hinge line stores 1/2 k (dw_{i-1}/dv - dw_i/dv)^2, v the direction in the
plane of a segment across the hinge, outboard: v = -h x e_z with h aft. Folding does not change it:
both slopes are taken in local axes. At shared points R_{i-1} u_{i-1} = R_i u_i, that is
u_{i-1} = Rot(h_i, psi_i) u_i in the local axes of the inboard segment. (I. Wang, PhD dissertation,
Duke University, 2013, eqs. (2.16)-(2.28).)

Beams are stiff across the chord: one slope on the elastic axis and two shared points are all there
is. Plates are joined at their springs.
"""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.maths.rotations import rotation_about
from foldwing.model import Hinge, HingeKind, Segment
from foldwing.model.joining import joins_at_points, spring_places
from foldwing.structure.component import ComponentModes

Sides = tuple[Segment, Segment]
Components = tuple[ComponentModes, ComponentModes]


@dataclass(frozen=True)
class Joint:
    """A hinge in the n coordinates of the segments inboard and outboard of it.

    Attributes
    ----------
    kind : HingeKind
    direction : array, shape (2,)
        Unit vector h along the flat hinge line, aft.
    stiffness : float
        Of each spring in N m/rad.
    slopes : array, shape (springs, n)
        Slope across the hinge of the inboard segment less that of the outboard one.
    inner, outer : array, shape (points, 3, n_inboard) and (points, 3, n_outboard)
        Local displacements of both segments at shared points.
    """

    kind: HingeKind
    direction: Real
    stiffness: float
    slopes: Real
    inner: Real
    outer: Real

    @property
    def spring_matrix(self) -> Real:
        """Stiffness matrix of the springs, shape (n, n)."""
        return np.asarray(self.stiffness * self.slopes.T @ self.slopes)

    def constraints(self, fold: float) -> Real:
        """Return the rows that hold the segments together at a fold angle in rad, (rows, n).

        A rigid hinge does not turn at its springs either.
        """
        turn = rotation_about(np.append(self.direction, 0.0), fold)
        turned = np.einsum("ab,mbn->man", turn, self.outer)
        together = np.concatenate([self.inner, -turned], axis=2)
        rows = together.reshape(-1, together.shape[2])
        return np.vstack([rows, self.slopes]) if self.kind is HingeKind.RIGID else rows


def hinge_joint(hinge: Hinge, segments: Sides, components: Components) -> Joint:
    """Return a hinge between two segments, inboard and outboard."""
    h = hinge.direction
    if joins_at_points(*segments):
        places = spring_places(*segments, hinge)
        springs = points = places[:, None] * h
    else:
        springs = np.zeros((1, 2))
        points = np.stack([_beam_points(*segments), np.zeros(2)], axis=1)
    across = np.array([-h[1], h[0]])
    inner = (points + segments[0].end).T
    slopes = [
        np.einsum("b,mbn->mn", across, component.slopes(*where.T))
        for component, where in zip(components, (springs + segments[0].end, springs), strict=True)
    ]
    return Joint(
        kind=hinge.kind,
        direction=h,
        stiffness=hinge.stiffness / len(springs),
        slopes=np.concatenate([slopes[0], -slopes[1]], axis=1),
        inner=components[0].displacement(*inner),
        outer=components[1].displacement(*points.T),
    )


def _beam_points(inboard: Segment, outboard: Segment) -> Real:
    """Return x of the two points that beams share: elastic axis and a leading edge.

    The leading edge is that of the side on which it is nearer to the elastic axis.
    """
    ahead = min(s.half_chord * (1.0 + s.axis_offset) for s in (inboard, outboard))
    if ahead == 0.0:
        ahead = -min(s.half_chord * (1.0 - s.axis_offset) for s in (inboard, outboard))
    return np.array([0.0, -ahead])
