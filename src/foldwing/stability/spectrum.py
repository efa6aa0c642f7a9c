"""All roots of a matrix function in a region, with a certificate that none is missing.

Roots of T(z) x = 0 are found by contour integrals, polished by Newton's method and compared with
the number of zeros of det T that the argument principle counts inside the region. Where the
numbers differ the region is subdivided.
"""

from dataclasses import dataclass, replace

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Complex
from foldwing.stability.domains import Domain
from foldwing.stability.problem import AeroelasticProblem, evaluate, evaluate_with_derivatives
from foldwing.stability.rootfinding import (
    ACCEPTED_RESIDUAL,
    SAME,
    MatrixFunction,
    RootList,
    approximate_roots,
    count_roots,
    multiplicity,
    no_roots,
    null_vectors,
    polished,
    residuals,
)
from foldwing.stability.status import Spectrum, Status


@dataclass(frozen=True)
class _Search:
    """What stays the same while a region is searched and subdivided."""

    function: MatrixFunction
    whole: Domain
    nodes: int

    def candidates(self, region: Domain, count: int | None) -> RootList:
        """Return polished roots near ``region``, all of them inside the whole region."""
        rank = self.empty.x.shape[0] if count is None else count
        z, x = approximate_roots(self.function, region, rank, self.nodes)
        roots = polished(self.function, z, x, self.whole.radius)
        return roots.only(self.whole.contains(roots.z))

    @property
    def empty(self) -> RootList:
        """No roots, of the size of the function."""
        return no_roots(self.function.value(self.whole.points(np.zeros(1))).shape[-1])

    def completed(self, region: Domain, count: int | None, known: RootList, depth: int) -> RootList:
        """Add the roots in ``region`` to the known ones until they match its count."""
        known = known.joined(self.candidates(region, count)).distinct(SAME * self.whole.radius)
        if count is not None and known.number_inside(region) < count:
            known = self.with_multiplicities(known, region)
        if depth == 0 or (count is not None and known.number_inside(region) >= count):
            return known
        for part in region.split():
            part_count = count_roots(self.function, part)
            if part_count is None or known.number_inside(part) < part_count:
                known = self.completed(part, part_count, known, depth - 1)
        return known

    def with_multiplicities(self, roots: RootList, region: Domain) -> RootList:
        """Count the multiplicities of the roots in ``region``."""
        found = roots.multiplicity.copy()
        for i in np.flatnonzero(region.contains(roots.z)):
            found[i] = multiplicity(self.function, roots.z[i], roots.z, self.whole.radius)
        return roots._replace(multiplicity=found)


def _as_spectrum(function: MatrixFunction, roots: RootList, size: float) -> Spectrum:
    """Return the roots by increasing imaginary part, multiple ones repeated."""
    roots = roots.only(np.lexsort((roots.z.real, roots.z.imag)))
    index = np.repeat(np.arange(roots.z.size), roots.multiplicity)
    z, x = roots.z[index], roots.x[:, index]
    for i in np.flatnonzero(roots.multiplicity > 1):
        count = int(roots.multiplicity[i])
        x[:, index == i] = null_vectors(function, roots.z[i], count, size)
    iterations = tuple(int(steps) for steps in roots.iterations[index])
    return Spectrum(z, x, residuals(function, z, x, size), (Status.OK,) * z.size, iterations)


def _certificate(
    function: MatrixFunction, spectrum: Spectrum, region: Domain, count: int | None
) -> bool:
    """Return whether the spectrum holds exactly the counted roots of ``region``."""
    z, size = spectrum.eigenvalues, region.radius
    inside = region.contains(z)
    genuine = residuals(function, z, spectrum.vectors, size) < ACCEPTED_RESIDUAL
    if np.count_nonzero(inside) != count or not np.all(genuine[inside]):
        return False
    repeats = np.sum(np.abs(z[:, None] - z) < SAME * size, axis=1)
    return all(
        multiplicity(function, z[i], z, size) == repeats[i]
        for i in np.flatnonzero(inside & (repeats > 1))
    )


def verified(function: MatrixFunction, spectrum: Spectrum, region: Domain) -> Spectrum:
    """Compare a spectrum, found by whatever method, with the count of the argument principle.

    Parameters
    ----------
    function : MatrixFunction
    spectrum : Spectrum
        Eigenvalues in the variable of ``function``; those outside the region are ignored.
    region : Domain

    Returns
    -------
    Spectrum
        The same roots with ``count`` and ``certified``: the number inside the region equals the
        count, every residual is that of a root, and a root listed several times is a multiple
        one.
    """
    count = count_roots(function, region)
    certified = _certificate(function, spectrum, region, count)
    return replace(spectrum, certified=certified, count=count)


def all_roots(
    function: MatrixFunction, region: Domain, *, nodes: int = 64, subdivisions: int = 8
) -> Spectrum:
    """Return all roots of a matrix function inside a region.

    Parameters
    ----------
    function : MatrixFunction
        Analytic inside and on the boundary of the region.
    region : Domain
        Its boundary should keep clear of roots.
    nodes : int
        Quadrature nodes of each contour integral; roots that these miss cost subdivisions.
    subdivisions : int
        How often a region in which roots are missing may be divided.

    Returns
    -------
    Spectrum
        Roots by increasing imaginary part, multiple ones repeated (roots closer than 1e-5 of the
        size of the region count as one multiple root). The scale of the residuals is the 1-norm
        of T plus that of its change over the region. ``certified`` is false when a root is
        missing or the count did not settle.
    """
    count = count_roots(function, region)
    search = _Search(function, region, nodes)
    roots = search.empty
    if count != 0:
        roots = search.completed(region, count, roots, subdivisions)
    spectrum = _as_spectrum(function, roots, region.radius)
    certified = _certificate(function, spectrum, region, count)
    return replace(spectrum, certified=certified, count=count)


@dataclass(frozen=True)
class AtSpeed:
    """An aeroelastic problem at one airspeed (m/s) as a matrix function of p."""

    problem: AeroelasticProblem
    speed: float

    def value(self, z: Complex) -> Complex:
        """Return T(p, U) at the values p = z, shape (m, n, n)."""
        return evaluate(self.problem, z, np.full(z.shape, self.speed))

    def derivative(self, z: Complex) -> Complex:
        """Return dT/dp at the values p = z, shape (m, n, n)."""
        return evaluate_with_derivatives(self.problem, z, np.full(z.shape, self.speed)).by_p


def at_speed(problem: AeroelasticProblem, speed: float) -> AtSpeed:
    """Return T(p, U) at the airspeed U = ``speed`` (m/s) as a matrix function of p."""
    if not speed > 0:
        raise InputError("speed", speed, "must be greater than 0 m/s", "Raise the airspeed.")
    return AtSpeed(problem, speed)


def _touches_branch_cut(region: Domain) -> bool:
    z = region.points(np.linspace(0.0, 1.0, 1025))
    from_, to = z[:-1], z[1:]
    return bool(np.any((from_.imag * to.imag <= 0) & (np.minimum(from_.real, to.real) <= 0)))


def spectrum_at_speed(problem: AeroelasticProblem, speed: float, region: Domain) -> Spectrum:
    """Return all eigenvalues lambda of an aeroelastic problem at one airspeed.

    Parameters
    ----------
    problem : AeroelasticProblem
    speed : float
        Airspeed U in m/s, positive.
    region : Domain
        Region of the reduced variable p = lambda b / U, dimensionless. It must not touch the
        negative real axis or the origin, where the aerodynamics have a branch cut.

    Returns
    -------
    Spectrum
        Eigenvalues lambda = p U / b: growth rate in 1/s and angular frequency in rad/s.

    Raises
    ------
    InputError
        For a speed that is not positive or a region that touches the branch cut.
    """
    if _touches_branch_cut(region):
        limit = "must not touch the negative real axis or the origin"
        raise InputError("region", region, limit, "Keep Im p > 0 wherever Re p <= 0.")
    spectrum = all_roots(at_speed(problem, speed), region)
    return replace(spectrum, eigenvalues=spectrum.eigenvalues * (speed / problem.half_chord))
