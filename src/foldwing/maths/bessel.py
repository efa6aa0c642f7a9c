"""Theodorsen's function C(p) and its derivative on the plane cut along the negative real axis.

    C(p) = K1(p) / (K0(p) + K1(p)),    |arg p| < pi,    p = lambda b / U,

with K0 and K1 the modified Bessel functions of the second kind. On the imaginary axis p = i k it
is Theodorsen's C(k) (T. Theodorsen, NACA report 496, 1935); off the axis it is the analytic
continuation of Edwards, Ashley and Breakwell (AIAA Journal 17, 1979).
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import kve

from foldwing.maths.arrays import Complex

_FAR = 18.0
"""From this |p| on the asymptotic series is exact to round-off: its smallest term is of the order
exp(-2 |p|). The closed form of the derivative would lose 8 |p|^2 units of round-off there."""

_ORIGIN = 1e-300
"""Below this |p|, K1 overflows and C(p) is 1 to round-off."""


def _series_coefficients(count: int) -> tuple[float, ...]:
    """Return c_1 .. c_count of C(p) = 1/2 + sum of c_n p^-n.

    They follow from the differential equation p C' = p (2 C - 1) - C (1 - C) term by term.
    """
    c = [0.0, 0.125]
    for n in range(1, count):
        products = sum(c[i] * c[n - i] for i in range(1, n))
        c.append(-(n * c[n] + products) / 2)
    return tuple(c[1:])


_COEFFICIENTS = _series_coefficients(30)


def _from_bessel(p: Complex) -> tuple[Complex, Complex]:
    """Return C and C' from Bessel functions scaled by exp(p), which cancels in the ratio."""
    K0, K1 = kve(0, p), kve(1, p)
    total = K0 + K1
    C = K1 / total
    # 1 - C from its own ratio keeps its digits near the origin.
    complement = K0 / total
    return C, C - complement - C * complement / p


def _from_series(p: Complex) -> tuple[Complex, Complex]:
    """Return C and C' from the asymptotic series in 1/p."""
    q = 1 / p
    n = np.arange(1.0, len(_COEFFICIENTS) + 1)
    c = np.array(_COEFFICIENTS)
    C = 0.5 + q * np.polynomial.polynomial.polyval(q, c)
    return C, -(q**2) * np.polynomial.polynomial.polyval(q, n * c)


def theodorsen_with_derivative(p: ArrayLike) -> tuple[Complex, Complex]:
    """Return Theodorsen's function C(p) and its derivative dC/dp.

    The derivative follows from K0' = -K1 and K1' = -K0 - K1/p:
    C' = 2 C - 1 - C (1 - C)/p.

    Parameters
    ----------
    p : array_like of complex
        Reduced Laplace variable lambda b / U, dimensionless, any shape, |arg p| < pi. On the
        negative real axis itself the limit from above (Im p -> +0) is returned.

    Returns
    -------
    value : array of complex, same shape
        C(p): 1 at the origin, 1/2 at infinity. Relative error a few units of round-off.
    derivative : array of complex, same shape
        dC/dp, relative error below 1e-11. At the origin C' grows like log p: there the value is
        minus infinity, and whoever needs T'(0) has to treat that point apart.
    """
    p = np.asarray(p, dtype=np.complex128)
    size = np.abs(p)
    if p.size and _ORIGIN <= size.min() and size.max() < _FAR:
        return _from_bessel(p)
    C = np.ones(p.shape, dtype=np.complex128)
    dC = np.full(p.shape, complex(-np.inf, 0.0))
    far = size >= _FAR
    near = ~far & (size >= _ORIGIN)
    if near.any():
        C[near], dC[near] = _from_bessel(p[near])
    if far.any():
        C[far], dC[far] = _from_series(p[far])
    unknown = np.isnan(p)
    C[unknown], dC[unknown] = np.nan, np.nan
    return C, dC


def theodorsen(p: ArrayLike) -> Complex:
    """Return Theodorsen's function C(p) = K1/(K0 + K1) for |arg p| < pi.

    Parameters
    ----------
    p : array_like of complex
        Reduced Laplace variable lambda b / U, dimensionless, any shape. On the negative real axis
        itself the limit from above (Im p -> +0) is returned.

    Returns
    -------
    array of complex, same shape
        C(p): 1 at the origin, 1/2 at infinity.
    """
    return theodorsen_with_derivative(p)[0]
