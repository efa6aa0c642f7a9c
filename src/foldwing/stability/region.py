"""The contour around all roots that count as unstable, and the path along it.

The upper half of the region right of the damping threshold: from p = 0 along the ray
p = k (i - threshold) to k_max, across to the right edge Re p = R, and down to the real axis. The
lower half is its mirror image.
"""

from dataclasses import dataclass

import numpy as np

from foldwing.maths.arrays import Complex, Real

RIGHT_EDGE = 1.5
"""Re p of the right edge at first: most unstable roots grow by less per b/U with apparent mass."""

SMALLEST = 1e-10
"""Reduced frequency that stands for zero."""


@dataclass(frozen=True)
class Region:
    """The path around the unstable region.

    Attributes
    ----------
    threshold : float
        Damping ratio of its left border, positive stable.
    lowest, highest : float
        Reduced frequencies between which the ray is swept densely, and where it ends.
    density : float
        Points per factor e of reduced frequency.
    edge : float
        Re p of the right edge at the real axis.
    """

    threshold: float
    lowest: float
    highest: float
    density: float = 11.0
    edge: float = RIGHT_EDGE

    @property
    def ray(self) -> complex:
        """Direction of the threshold ray, p = k ray."""
        return 1j - self.threshold

    @property
    def right(self) -> float:
        """Re p of the right edge."""
        return self.edge + max(0.0, -self.threshold) * self.highest

    @property
    def _corner(self) -> float:
        return float(np.log(self.highest))

    @property
    def _descent(self) -> float:
        return float(np.arcsinh(self.highest / self.right))

    def parameter(self) -> Real:
        """Return the points of the path: ln k on the ray, then running on."""
        start, corner = np.log(SMALLEST), self._corner
        approach = np.linspace(start, np.log(self.lowest), 9)
        count = int(np.ceil((corner - approach[-1]) * self.density)) + 1
        ray = np.linspace(approach[-1], corner, max(count, 12))
        top = corner + np.linspace(0.0, 1.0, 6)[1:]
        right = top[-1] + np.linspace(0.0, self._descent, int(4 * self._descent) + 6)[1:]
        return np.concatenate([[start - 1.0], approach[:-1], ray, top, right])

    def point(self, parameter: Real) -> Complex:
        """Return p at positions of the path."""
        t, corner = np.asarray(parameter, float), self._corner
        on_ray = np.exp(np.minimum(t, corner)) * self.ray
        across = np.clip(t - corner, 0.0, 1.0)
        end = self.highest * self.ray
        top = end + across * (self.right + 1j * self.highest - end)
        height = np.sinh(np.clip(self._descent - (t - corner - 1.0), 0.0, self._descent))
        side = self.right * (1.0 + 1j * height)
        p = np.where(t <= corner, on_ray, np.where(t <= corner + 1.0, top, side))
        return np.where(t < np.log(SMALLEST) - 0.5, SMALLEST + 0j, p)
