"""The simple phugoid: height and speed exchanged at constant angle of attack."""

import cmath

from foldwing.flight.derivatives import stability_derivatives
from foldwing.model import FlightModel, StateMatrixModel


def simple_phugoid(drag_over_lift: float, speed: float, gravity: float) -> tuple[complex, complex]:
    """Return both eigenvalues in 1/s of an aircraft that keeps its angle of attack.

    They are roots of lambda^2 + 2 (D/L) (g/V) lambda + 2 (g/V)^2 = 0: a pair of frequency
    sqrt(2) g / V without drag, whatever the aircraft, and real when D/L is above sqrt(2).

    Parameters
    ----------
    drag_over_lift : float
    speed : float
        V, m/s.
    gravity : float
        g, m/s^2.
    """
    scale = gravity / speed
    root = cmath.sqrt(drag_over_lift * drag_over_lift - 2.0)
    return scale * (-drag_over_lift + root), scale * (-drag_over_lift - root)


def drag_over_lift(model: FlightModel) -> float | None:
    """Return drag over lift, which is X_u / Z_u; None where Z_u tells of no lift.

    That holds while coefficients do not change with speed, and with a thrust that does not either.
    """
    if isinstance(model, StateMatrixModel):
        x_u, z_u = model.matrix[0][0], model.matrix[1][0]
    else:
        derivatives = stability_derivatives(model)
        x_u, z_u = derivatives.X_u, derivatives.Z_u
    return x_u / z_u if z_u < 0.0 else None
