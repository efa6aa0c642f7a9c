"""Axes, signs and reduced variables that every part of foldwing shares.

Axes
----
Global axes are right-handed: ``x`` aft (direction of the free stream), ``y`` outboard along the
unfolded starboard span, ``z`` up. The local axes of a segment are the same axes turned by its
cumulative fold angle about x; their origin is the point of the elastic axis on the segment's
inboard edge.

Fold angles
-----------
``psi_i`` is the angle of hinge i = 2..N relative to the inboard neighbour; positive folds the
outboard part up. The cumulative angle is ``Psi_i = psi_2 + ... + psi_i``. Degrees at the border,
radians inside.

Displacements
-------------
The displacement normal to a segment is ``w(x, y) = h(y) - x phi(y)``: plunge ``h`` up, twist
``phi`` nose up, ``x`` measured aft from the elastic axis. (Theodorsen's plunge is positive down.)

Time
----
All motions vary as ``exp(lambda t)``, ``lambda = sigma + i omega``. With the half chord ``b`` of
segment 1 the reduced Laplace variable is ``p = lambda b / U`` and the reduced frequency is
``k = Im p``.

Damping
-------
The damping ratio is ``zeta = -Re(lambda) / |Im(lambda)|``, positive when stable and undefined for
a real root, whose growth rate ``Re(lambda)`` in 1/s is always given.

The flight of a rigid aircraft keeps the conventions of flight mechanics, see `foldwing.flight`:
axes of the body, ``x`` forward and ``z`` down, and ``zeta = -Re(lambda) / |lambda|``.
"""

import math

DEGREE = math.pi / 180.0
"""One degree in radians."""


STANDARD_GRAVITY = 9.80665
"""m/s^2."""


def hertz(angular_frequency: float) -> float:
    """Return a frequency in Hz from an angular frequency in rad/s."""
    return angular_frequency / (2.0 * math.pi)
