"""Eigenvalues of the reference: a few of thousands, near a shift, by Arnoldi's method.

Roots are z = exp(lambda dt) of z M1 x + M2 x = 0. With one sparse factorization of M2 + sigma M1,
the largest values of (M2 + sigma M1)^-1 M2 are those of z / (z - sigma): the roots nearest sigma.
M2 is far emptier than M1, which holds the influence of the wake.
"""

import numpy as np
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs, splu

from foldwing.aeroelastic.reference import Marching
from foldwing.maths.arrays import Complex, Real
from foldwing.stability.status import Spectrum, Status

CONVERGED = 1e-8
"""Residual below which a root counts as found."""


def roots_near(
    marching: Marching, guess: complex, count: int = 8, tolerance: float = 0.0
) -> Spectrum:
    """Return the roots nearest to a guess.

    Parameters
    ----------
    marching : Marching
    guess : complex
        lambda in rad/s; must not be a root itself.
    count : int
        How many.
    tolerance : float
        Relative accuracy of Arnoldi's method, 0 for round-off.

    Returns
    -------
    Spectrum
        Nearest first; vectors are whole states. ``iterations`` counts solutions with the
        factorized matrix. Roots of the cut-off wake, far from the shift, may not converge.
    """
    sigma = complex(marching.factor(np.array([guess]))[0])
    inverse = _Inverse(marching, sigma)
    count = min(count, marching.states - 2)
    start = np.random.default_rng(0).standard_normal(marching.states) + 0j
    try:
        theta, x = eigs(inverse.operator(), k=count, v0=start, tol=tolerance)
    except ArpackNoConvergence as problem:
        theta, x = problem.eigenvalues, problem.eigenvectors
    z = sigma * theta / (theta - 1.0)
    order = np.argsort(np.abs(z - sigma))
    z, x = z[order], x[:, order] / np.linalg.norm(x[:, order], axis=0)
    residuals = residual(marching, z, x)
    good = residuals < CONVERGED
    return Spectrum(
        marching.eigenvalue(z),
        x,
        residuals,
        tuple(Status.OK if found else Status.NOT_CONVERGED for found in good),
        (inverse.solutions,) * len(z),
    )


class _Inverse:
    """(M2 + sigma M1)^-1 M2, and how often it was applied."""

    def __init__(self, marching: Marching, sigma: complex) -> None:
        self.before = marching.before
        self.solutions = 0
        self.factors = splu(marching.before + marching.after * sigma)

    def apply(self, x: Complex) -> Complex:
        self.solutions += 1
        return np.asarray(self.factors.solve(self.before @ x.ravel()))

    def operator(self) -> LinearOperator:
        return LinearOperator(self.before.shape, matvec=self.apply, dtype=complex)


def residual(marching: Marching, z: Complex, x: Complex) -> Real:
    """Return the residual of roots, the largest of the four parts of the state, shape (m,).

    That of a part is its norm over that of the sum of all terms' sizes, so that units cancel.
    """
    missing = marching.after @ (x * z) + marching.before @ x
    terms = abs(marching.after) @ np.abs(x * z) + abs(marching.before) @ np.abs(x)
    parts = (marching.panels, marching.wake, marching.coordinates, marching.velocities)
    ratios = [
        np.linalg.norm(missing[part], axis=0) / np.linalg.norm(terms[part], axis=0)
        for part in parts
    ]
    return np.asarray(np.max(ratios, axis=0))
