"""Plates with known answers, and the Ritz method of polynomials for rectangular ones."""

import numpy as np
import scipy.linalg
from numpy.polynomial import legendre
from numpy.polynomial.legendre import leggauss

from foldwing.model import Planform, Sheet, rectangle

L_SHAPE = Planform(
    corners=((-0.05, 0.0), (-0.05, 0.2), (0.15, 0.2), (0.15, 0.1), (0.05, 0.1), (0.05, 0.0)),
    tip=(1, 2),
)
CRANK = Planform(
    corners=((-0.05, 0.0), (0.0, 0.1), (0.1, 0.2), (0.15, 0.2), (0.06, 0.1), (0.05, 0.0)),
    tip=(2, 3),
)
TRAPEZOID = Planform(corners=((-0.03, 0.0), (0.01, 0.12), (0.05, 0.1), (0.04, -0.01)), tip=(1, 2))
DELTA = Planform(corners=((-0.05, 0.0), (0.08, 0.15), (0.05, 0.0)), tip=(1, 1))
ARROW = Planform(corners=((-0.05, 0.0), (0.1, 0.2), (0.04, 0.05), (0.05, 0.0)), tip=(1, 1))
SQUARE = rectangle(0.1, 0.1, 0.5)
OUTLINES = {
    "square": SQUARE,
    "trapezoid": TRAPEZOID,
    "delta": DELTA,
    "arrow": ARROW,
    "L": L_SHAPE,
    "crank": CRANK,
}


def sheet(poissons_ratio=0.3, thickness=((0.001,),)):
    """A sheet of aluminium."""
    return Sheet(
        youngs_modulus=70e9, poissons_ratio=poissons_ratio, density=2700.0, thickness=thickness
    )


def parameters(omega2, side, of):
    """omega a^2 sqrt(rho t / D) of a uniform sheet, a the given side."""
    t = of.thickness[0][0]
    D = of.youngs_modulus * t**3 / 12.0 / (1.0 - of.poissons_ratio**2)
    return np.sqrt(omega2) * side**2 * np.sqrt(of.density * t / D)


def legendre_derivatives(order, y, ramp):
    """(y + 1)^ramp P_k(y), k < order, and two derivatives at y in [-1, 1]: (3, order, m)."""
    edge = legendre.poly2leg([1.0]) if ramp == 0 else legendre.poly2leg([1.0, 2.0, 1.0])
    series = [legendre.legmul(edge, np.eye(order)[k]) for k in range(order)]
    return np.array([[legendre.legval(y, legendre.legder(s, d)) for s in series] for d in range(3)])


def ritz(length, width, nu, clamped, order=14):
    """Eigenvalues of a rectangle, y along the length, with t^3/12 Q of D = 1 and unit mass."""
    z, weights = leggauss(order + 4)
    X = legendre_derivatives(order, z, 0)
    Y = legendre_derivatives(order, z, 2 if clamped else 0)
    a, b = width / 2.0, length / 2.0

    def gram(F, i, j, scale):
        return np.einsum("am,bm,m->ab", F[i], F[j], weights) * scale ** (1 - i - j)

    def term(i, j, k, m):
        return np.kron(gram(X, i, j, a), gram(Y, k, m, b))

    K = term(2, 2, 0, 0) + term(0, 0, 2, 2) + 2.0 * (1.0 - nu) * term(1, 1, 1, 1)
    K += nu * (term(2, 0, 0, 2) + term(0, 2, 2, 0))
    M = term(0, 0, 0, 0)
    return scipy.linalg.eigh(K, M, eigvals_only=True)
