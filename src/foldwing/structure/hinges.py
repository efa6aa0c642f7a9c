"""Hinges: what they store as energy and what they constrain, in the segments' local coordinates."""

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.model import Hinge, HingeKind, Segment
from foldwing.structure.component import ComponentModes


def relative_slope(inboard: ComponentModes, span: float, outboard: ComponentModes) -> Real:
    """Return dw/dy of the inboard segment minus that of the outboard one on the elastic axis.

    Folding does not change it: both slopes are taken in local axes. Shape (n_inboard +
    n_outboard,).
    """
    origin = np.zeros(1)
    inner = inboard.slopes(origin, np.array([span]))[0, 1]
    outer = outboard.slopes(origin, origin)[0, 1]
    return np.concatenate([inner, -outer])


def hinge_stiffness(hinge: Hinge, slope: Real) -> Real:
    """Return the stiffness matrix of the hinge springs, 1/2 k (relative slope)^2."""
    return hinge.stiffness * np.outer(slope, slope)


def hinge_points(inboard: Segment, outboard: Segment) -> Real:
    """Return x of the two points that the segments share: elastic axis and a leading edge.

    The leading edge is that of the side on which it is nearer to the elastic axis.
    """
    ahead = min(s.half_chord * (1.0 + s.axis_offset) for s in (inboard, outboard))
    if ahead == 0.0:
        ahead = -min(s.half_chord * (1.0 - s.axis_offset) for s in (inboard, outboard))
    return np.array([0.0, -ahead])


def slope_constraint(hinge: Hinge, slope: Real) -> Real:
    """Return the rows that keep a rigid hinge from turning: one for a rigid hinge, else none."""
    return slope[None, :] if hinge.kind is HingeKind.RIGID else np.zeros((0, len(slope)))
