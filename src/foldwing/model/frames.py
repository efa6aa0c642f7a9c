"""Where the segments of a folded wing are: positions, normals and hinge directions.

From inboard to outboard, with the flat directions h_i of the hinges (I. Wang, PhD dissertation,
Duke University, 2013, eqs. (2.1)-(2.15), without its angles between segments and axes):

    hhat_i = R_{i-1} h_i,   R_i = Rot(hhat_i, psi_i) R_{i-1},   o_i = o_{i-1} + R_{i-1} r_{i-1},

where r is the point of the outboard edge at which the next segment hangs. R_i = R_{i-1} Rot(h_i,
psi_i) is the same and is what is computed.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.maths.rotations import rotation_about


@dataclass(frozen=True)
class Frames:
    """Axes of the segments of a folded wing.

    Attributes
    ----------
    origins : tuple of array, shape (3,)
        Where each segment hangs on its neighbour, in m.
    rotations : tuple of array, shape (3, 3)
        R_i from the local axes of each segment to global axes.
    hinges : tuple of array, shape (3,)
        Unit vectors along hinges 2..N, aft, on the folded wing.
    """

    origins: tuple[Real, ...]
    rotations: tuple[Real, ...]
    hinges: tuple[Real, ...]

    @property
    def normals(self) -> tuple[Real, ...]:
        """Unit normals of the segments, up for an unfolded wing, shape (3,) each."""
        return tuple(R[:, 2] for R in self.rotations)

    @property
    def streams(self) -> tuple[Real, ...]:
        """Direction of the air stream in the axes of each segment, shape (3,) each."""
        return tuple(R[0] for R in self.rotations)

    def position(self, segment: int, x: Real, y: Real) -> Real:
        """Return the global position of points of one segment (from 0), shape (m, 3)."""
        local = np.stack([x, y, np.zeros_like(x)], axis=-1)
        return np.asarray(self.origins[segment] + local @ self.rotations[segment].T)


def frames(ends: Sequence[Real], directions: Sequence[Real], folds: Sequence[float]) -> Frames:
    """Return the axes of segments that hang on each other.

    Parameters
    ----------
    ends : sequence of array, shape (2,)
        Local x and y of the point on which the next segment hangs, of every segment.
    directions : sequence of array, shape (2,)
        Local direction h of hinges 2..N.
    folds : sequence of float
        psi_2 .. psi_N in rad.
    """
    origins, rotations, hinges = [np.zeros(3)], [np.eye(3)], []
    for end, h, fold in zip(ends, directions, folds, strict=False):
        R, axis = rotations[-1], np.append(h, 0.0)
        origins.append(origins[-1] + R[:, :2] @ end)
        hinges.append(R @ axis)
        rotations.append(R @ rotation_about(axis, float(fold)))
    return Frames(tuple(origins), tuple(rotations), tuple(hinges))
