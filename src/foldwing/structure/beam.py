"""Component modes of a uniform beam segment (Euler-Bernoulli bending, St. Venant torsion)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.maths.quadrature import gauss_rule
from foldwing.model import Analysis, Segment
from foldwing.structure.component import Root, SectionMotion
from foldwing.structure.in_plane import (
    IN_PLANE,
    in_plane_displacement,
    in_plane_mass,
    with_twisting,
)
from foldwing.structure.spanwise import (
    SpanwiseFunctions,
    bending_functions,
    torsion_functions,
)


@dataclass(frozen=True)
class BeamModes:
    """Plunge functions, twist functions and in-plane rigid motions of one segment.

    Parameters
    ----------
    segment : Segment
    plunge, twist : SpanwiseFunctions
    root : Root
        How its inboard edge may move.
    """

    segment: Segment
    plunge: SpanwiseFunctions
    twist: SpanwiseFunctions
    root: Root

    @property
    def count(self) -> int:
        """Number n of coordinates."""
        return self._out_of_plane + len(self._in_plane)

    @property
    def _in_plane(self) -> list[int]:
        return IN_PLANE[self.root]

    @property
    def _out_of_plane(self) -> int:
        return self.plunge.count + self.twist.count

    @property
    def _blocks(self) -> tuple[slice, slice, slice]:
        nb, n = self.plunge.count, self._out_of_plane
        return slice(0, nb), slice(nb, n), slice(n, self.count)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Nothing: the modes are computed here."""
        return ()

    @cached_property
    def mass(self) -> Real:
        """Mass matrix, shape (n, n), in kg and kg m^2."""
        segment = self.segment
        _, _, m, i = segment.beam
        x_cg = segment.mass_offset
        y, weights = gauss_rule(segment.span, self._quadrature_points)
        h, phi = self.plunge.evaluate(y, 0), self.twist.evaluate(y, 0)
        M = np.zeros((self.count, self.count))
        bending, torsion, in_plane = self._blocks
        M[bending, bending] = m * _gram(h, h, weights)
        M[torsion, torsion] = i * _gram(phi, phi, weights)
        M[bending, torsion] = -m * x_cg * _gram(h, phi, weights)
        M[torsion, bending] = M[bending, torsion].T
        M[in_plane, in_plane] = self._in_plane_mass()[np.ix_(self._in_plane, self._in_plane)]
        return M

    def _in_plane_mass(self) -> Real:
        segment = self.segment
        _, _, m, i = segment.beam
        L = segment.span
        by_x, by_y = m * segment.mass_offset * L, m * L**2 / 2.0
        polar = m * L**3 / 3.0 + i * L
        return in_plane_mass(m * L, by_x, by_y, polar)

    @cached_property
    def stiffness(self) -> Real:
        """Stiffness matrix, shape (n, n), in N/m and N m."""
        segment = self.segment
        y, weights = gauss_rule(segment.span, self._quadrature_points)
        curvature, twist_rate = self.plunge.evaluate(y, 2), self.twist.evaluate(y, 1)
        K = np.zeros((self.count, self.count))
        bending, torsion, _ = self._blocks
        EI, GJ, _, _ = segment.beam
        K[bending, bending] = EI * _gram(curvature, curvature, weights)
        K[torsion, torsion] = GJ * _gram(twist_rate, twist_rate, weights)
        return K

    @cached_property
    def torsion_mass(self) -> Real:
        """Mass of twist, and of in-plane x motion and yaw, which a folded wing's twist drives."""
        _, torsion, _ = self._blocks
        M = np.zeros_like(self.mass)
        M[torsion, torsion] = self.mass[torsion, torsion]
        return with_twisting(M, self.mass, self.root)

    @property
    def mass_and_centre(self) -> tuple[float, Real]:
        """Mass in kg, and x and y of its centre in m, shape (2,)."""
        mass, *centre = self.segment.mass_and_centre
        return mass, np.array(centre)

    @cached_property
    def mass_centre_motion(self) -> Real:
        """Displacement of the mass centre times the mass per coordinate, shape (3, n)."""
        segment = self.segment
        y, weights = gauss_rule(segment.span, self._quadrature_points)
        u = self.displacement(np.full_like(y, segment.mass_offset), y)
        return np.asarray(segment.beam.mass_per_span * np.einsum("m,man->an", weights, u))

    @property
    def _quadrature_points(self) -> int:
        return 2 * max(self.plunge.count, self.twist.count) + 24

    def displacement(self, x: Real, y: Real) -> Real:
        """Return the local displacement per coordinate, shape (m, 3, n): w = h - x phi."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        bending, torsion, in_plane = self._blocks
        u = np.zeros((len(y), 3, self.count))
        u[:, 2, bending] = self.plunge.evaluate(y, 0)
        u[:, 2, torsion] = -x[:, None] * self.twist.evaluate(y, 0)
        u[:, :2, in_plane] = in_plane_displacement(x, y, self.root)
        return u

    def slopes(self, x: Real, y: Real) -> Real:
        """Return dw/dx and dw/dy per coordinate, shape (m, 2, n)."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        bending, torsion, _ = self._blocks
        slopes = np.zeros((len(y), 2, self.count))
        slopes[:, 0, torsion] = -self.twist.evaluate(y, 0)
        slopes[:, 1, bending] = self.plunge.evaluate(y, 1)
        slopes[:, 1, torsion] = -x[:, None] * self.twist.evaluate(y, 1)
        return slopes

    def section_motion(self, y: Real) -> SectionMotion:
        """Return plunge (m, up) and twist (rad, nose up) of the sections at ``y`` (m,)."""
        bending, torsion, _ = self._blocks
        y = np.asarray(y, float)
        plunge, twist = np.zeros((2, len(y), self.count))
        plunge[:, bending] = self.plunge.evaluate(y, 0)
        twist[:, torsion] = self.twist.evaluate(y, 0)
        return SectionMotion(plunge, twist)


def _gram(f: Real, g: Real, weights: Real) -> Real:
    return (f * weights[:, None]).T @ g


def beam_modes(segment: Segment, analysis: Analysis, root: Root) -> BeamModes:
    """Return the component modes of a beam segment in the basis that the analysis asks for."""
    L, basis = segment.span, analysis.basis
    return BeamModes(
        segment,
        bending_functions(L, analysis.bending_modes, root, basis),
        torsion_functions(L, analysis.torsion_modes, root, basis),
        root,
    )
