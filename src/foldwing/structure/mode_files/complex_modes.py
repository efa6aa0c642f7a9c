"""Complex shapes made real: the phase that makes a shape most real, and what is then lost."""

import numpy as np

from foldwing.maths.arrays import Complex, Real

NOISY = 10.0
"""Phase scatter in degrees from which a mode is named in a warning."""

TRAVELLING = 30.0
"""Phase scatter in degrees from which a mode is a travelling wave rather than a standing one."""


def real_shapes(shapes: Real | Complex) -> tuple[Real, Real]:
    """Return real shapes and the phase scatter that they hide.

    Every shape z is turned by the phase theta for which the sum of Re(z exp(-i theta))^2 is
    greatest, theta = arg(sum z^2) / 2, and its real part is kept, with its largest component
    positive.

    Parameters
    ----------
    shapes : array, shape (m, k, 3)
        Real or complex.

    Returns
    -------
    real : array, shape (m, k, 3)
    scatter : array, shape (m,)
        Root mean square, weighted by amplitude, of the phases about 0 or 180 degrees, in degrees;
        0 for real shapes, 52 for phases spread evenly.
    """
    if not np.iscomplexobj(shapes):
        return np.asarray(shapes, float), np.zeros(len(shapes))
    z = shapes.reshape(len(shapes), -1)
    with np.errstate(all="ignore"):  # what is not finite stays so and is refused later
        size = np.abs(z).max(axis=1, keepdims=True)
        z = z / np.where(size > 0.0, size, 1.0)
        z = z * np.exp(-0.5j * np.angle((z**2).sum(axis=1)))[:, None]
        largest = np.take_along_axis(z.real, np.abs(z.real).argmax(axis=1)[:, None], axis=1)
        z = z * np.where(largest < 0.0, -1.0, 1.0)
        phases = np.degrees(np.arctan2(np.abs(z.imag), np.abs(z.real)))
        weights = np.abs(z)
        total = np.maximum(weights.sum(axis=1), np.finfo(float).tiny)
        scatter = np.sqrt((weights * phases**2).sum(axis=1) / total)
        real = z.real * size
    return np.asarray(real.reshape(shapes.shape)), np.asarray(scatter)


def scatter_warnings(scatter: Real) -> tuple[str, ...]:
    """Return one sentence for every mode whose phases scatter too much for a real shape."""
    texts = []
    for mode, degrees in enumerate(scatter, 1):
        if degrees > TRAVELLING:
            texts.append(
                f"mode {mode}: its phases scatter by {degrees:.1f} degrees, as in a travelling "
                "wave; a real shape does not describe it"
            )
        elif degrees > NOISY:
            texts.append(
                f"mode {mode}: its phases scatter by {degrees:.1f} degrees about a real shape; "
                "only the real part is kept"
            )
    return tuple(texts)
