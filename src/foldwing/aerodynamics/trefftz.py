"""Induced drag in the Trefftz plane, and the least that a shape allows.

Far downstream the legs are two-dimensional vortices, and the drag is a quadratic form of the
circulations of the strips, D = rho G^T Q G, with the normal wash in the middle of each strip. The
least drag for a given lift rho U a^T G belongs to Q G parallel to a (M. M. Munk, NACA report 121,
1921: the normal wash is then proportional to the cosine of the dihedral).
"""

import numpy as np
import scipy.linalg

from foldwing.aerodynamics.panels import Panels
from foldwing.maths.arrays import Real


def drag_form(panels: Panels, image: bool = False) -> Real:
    """Return the symmetric matrix Q of the induced drag, dimensionless, shape (s, s).

    Parameters
    ----------
    panels : Panels
        Of s strips.
    image : bool
        Whether the plane y = 0 mirrors the flow; the drag is then that of these strips alone.
    """
    wash = _far_wash(panels, panels)
    if image:
        wash = wash + _far_wash(panels, panels.mirrored())
    Q = -0.5 * panels.width[:, None] * wash
    return np.asarray((Q + Q.T) / 2.0)


def _far_wash(receivers: Panels, sources: Panels) -> Real:
    """Return the normal wash far downstream per circulation of the source strips, (r, s)."""
    inner, outer = receivers.edges
    middle, normal = (inner + outer) / 2.0, receivers.normals[: receivers.strips, 1:]
    to_inner, to_outer = (_vortex(middle, normal, edge) for edge in sources.edges)
    return to_outer - to_inner


def _vortex(points: Real, normals: Real, centres: Real) -> Real:
    """Return the normal velocity of unit vortices along x, shape (r, s)."""
    y, z = np.moveaxis(points[:, None] - centres, 2, 0)
    across = y * normals[:, 1:] - z * normals[:, :1]
    return np.asarray(across / (2.0 * np.pi * (y**2 + z**2)))


def least_drag(Q: Real, lift: Real) -> float:
    """Return the least of G^T Q G for a^T G = 1; nan when the mesh is too poor to have one.

    Parameters
    ----------
    Q : array, shape (s, s)
        Of `drag_form`.
    lift : array, shape (s,)
        Lift a per circulation: the widths seen from above.
    """
    try:
        factor = scipy.linalg.cho_factor(Q)
    except scipy.linalg.LinAlgError:
        return float("nan")
    share = float(lift @ scipy.linalg.cho_solve(factor, lift))
    return 1.0 / share if share > 0.0 else float("nan")
