"""Natural frequencies of a folded wing by exact dynamic stiffness, without any mode functions.

Every segment is a uniform Euler-Bernoulli beam in bending and a St. Venant bar in torsion, both
solved exactly at the frequency omega, and rigid in its own plane. Mass centre and elastic axis
coincide at mid-chord. The wing has minimal coordinates: the outboard end (plunge, slope, twist) of
each segment and, past a hinge, the slope of its inboard end. Everything else follows from the root
outward: on the hinge line neighbours share displacement and the two turns that are not the hinge's
own, which fixes the in-plane position and yaw, the plunge and the twist of the next segment. No
constraint is ever written down.

The number of natural frequencies below omega is that of negative eigenvalues of the stiffness plus
that of the frequencies of the segments with both ends held (W. H. Wittrick, F. W. Williams, A
general algorithm for computing natural frequencies of elastic structures, Quarterly Journal of
Mechanics and Applied Mathematics 24, 1971), so that bisection finds them all, equal ones too.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg

# Displacement of a segment, in its local axes and of its elastic axis, as rows of a matrix over
# the wing's coordinates: x and y of the inboard end, yaw, then plunge, slope and twist of each end.
X, Y, YAW, PLUNGE, SLOPE, TWIST, TIP_PLUNGE, TIP_SLOPE, TIP_TWIST = range(9)


@dataclass(frozen=True)
class Beam:
    """A uniform segment with mass centre and elastic axis at mid-chord.

    Attributes
    ----------
    length, bending, torsion : float
        m, EI and GJ in N m^2.
    mass, inertia : float
        Per span: kg/m, and about the elastic axis kg m.
    tip_masses : sequence of (mass, x)
        Point masses at the outboard edge, x aft of the elastic axis.
    """

    length: float
    bending: float
    torsion: float
    mass: float
    inertia: float
    tip_masses: Sequence[tuple[float, float]] = ()

    def stiffness(self, omega):
        """Dynamic stiffness (9, 9) over the segment's own displacements."""
        D = np.zeros((9, 9))
        bending, torsion = [PLUNGE, SLOPE, TIP_PLUNGE, TIP_SLOPE], [TWIST, TIP_TWIST]
        D[np.ix_(bending, bending)] = self._bending(omega)
        D[np.ix_(torsion, torsion)] = self._torsion(omega)
        D[:3, :3] = -(omega**2) * self._in_plane()
        for mass, x in self.tip_masses:
            u = self._tip_displacement(x)
            D -= omega**2 * mass * u.T @ u
        return D

    def _bending(self, omega):
        """Forces and moments at the ends of the exact solution for unit end displacements."""
        L, beta = self.length, self._bending_number(omega)
        growth = np.array([-1, 1, 1j, -1j]) * beta  # exp(-y), exp(y - L), exp(+-iy) of beta y
        start, end = (np.exp(growth * y) for y in (0.0, L))
        start[1], end[1] = np.exp(-beta * L), 1.0
        shapes = np.stack([start, growth * start, end, growth * end])
        loads = np.stack(
            [growth**3 * start, -(growth**2) * start, -(growth**3) * end, growth**2 * end]
        )
        return self.bending * np.linalg.solve(shapes.T, loads.T).T.real

    def _torsion(self, omega):
        gamma = omega * np.sqrt(self.inertia / self.torsion)
        s, c = np.sin(gamma * self.length), np.cos(gamma * self.length)
        return self.torsion * gamma / s * np.array([[c, -1.0], [-1.0, c]])

    def _in_plane(self):
        """Mass matrix of x and y translation and yaw about the inboard end of a rigid plate."""
        m, i, L = self.mass, self.inertia, self.length
        moment = m * L**2 / 2
        polar = m * L**3 / 3 + i * L
        return np.array([[m * L, 0, -moment], [0, m * L, 0], [-moment, 0, polar]])

    def _tip_displacement(self, x):
        u = np.zeros((3, 9))
        u[0, [X, YAW]] = 1.0, -self.length
        u[1, [Y, YAW]] = 1.0, x
        u[2, [TIP_PLUNGE, TIP_TWIST]] = 1.0, -x
        return u

    def held_count(self, omega):
        """Number of frequencies below omega of the segment with both ends held."""
        z = self._bending_number(omega) * self.length
        half_waves = int(z / np.pi)
        sign = np.sign(1 - np.cos(z) * np.cosh(min(z, 700.0)))
        bending = half_waves - (1 - (-1) ** half_waves * sign) / 2
        torsion = int(omega * np.sqrt(self.inertia / self.torsion) * self.length / np.pi)
        return round(bending) + torsion

    def _bending_number(self, omega):
        return np.sqrt(omega) * (self.mass / self.bending) ** 0.25


@dataclass(frozen=True)
class FoldedWing:
    """Segments joined by hinges; the first is clamped.

    Attributes
    ----------
    beams : sequence of Beam
    hinges : sequence of float
        Rotational stiffness of each hinge in N m/rad; infinite for a rigid one.
    folds : sequence of float
        Fold angle of each hinge in radians, positive outboard part up.
    """

    beams: Sequence[Beam]
    hinges: Sequence[float]
    folds: Sequence[float]

    def kinematics(self):
        """Displacements (9, n) of each segment over the n coordinates of the wing."""
        rigid = [np.isinf(k) for k in self.hinges]
        n = 3 * len(self.beams) + rigid.count(False)
        unit = iter(np.eye(n))
        parts = []
        for index in range(len(self.beams)):
            T = np.zeros((9, n))
            if index:
                self._carry_over(T, parts[-1], index - 1)
                T[SLOPE] = parts[-1][TIP_SLOPE] if rigid[index - 1] else next(unit)
            for row in (TIP_PLUNGE, TIP_SLOPE, TIP_TWIST):
                T[row] = next(unit)
            parts.append(T)
        return parts

    def _carry_over(self, T, inner, joint):
        """Fill the inboard end of a segment with the motion of its neighbour's outboard end.

        Turning with the hinge, e_x stays; displacement and turn are the same vectors.
        """
        c, s = np.cos(self.folds[joint]), np.sin(self.folds[joint])
        across = inner[Y]
        up = inner[TIP_PLUNGE]
        T[X] = inner[X] - self.beams[joint].length * inner[YAW]
        T[Y], T[PLUNGE] = c * across + s * up, -s * across + c * up
        T[TWIST] = c * inner[TIP_TWIST] + s * inner[YAW]
        T[YAW] = -s * inner[TIP_TWIST] + c * inner[YAW]

    def count_below(self, omega):
        """Number of natural frequencies below omega."""
        parts = self.kinematics()
        K = sum(T.T @ b.stiffness(omega) @ T for T, b in zip(parts, self.beams, strict=True))
        for k, inner, outer in zip(self.hinges, parts[:-1], parts[1:], strict=True):
            if np.isfinite(k):
                turn = inner[TIP_SLOPE] - outer[SLOPE]
                K = K + k * np.outer(turn, turn)
        scale = 1 / np.sqrt(np.abs(np.diag(K)))
        negative = np.count_nonzero(scipy.linalg.eigvalsh(K * np.outer(scale, scale)) < 0)
        return negative + sum(beam.held_count(omega) for beam in self.beams)

    def frequencies(self, count, lowest=1e-2):
        """The first ``count`` angular frequencies above ``lowest``, by bisection to round-off."""
        first = self.count_below(lowest)
        return np.array([self._frequency(first + n, lowest) for n in range(count)])

    def _frequency(self, number, low):
        high = 2 * low
        while self.count_below(high) <= number:
            high *= 2
        while high - low > 1e-13 * high:
            middle = (low + high) / 2
            if self.count_below(middle) <= number:
                low = middle
            else:
                high = middle
        return high
