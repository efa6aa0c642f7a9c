"""Stability derivatives of a wing and a tail, and the matrix of the four states."""

from dataclasses import dataclass

import numpy as np

from foldwing.flight.trim import trimmed
from foldwing.maths.arrays import Real
from foldwing.model import Airframe, DerivativesModel, FlightModel, StateMatrixModel

STATES = ("u", "w", "q", "theta")


@dataclass(frozen=True)
class Slopes:
    """How the coefficients of the whole aircraft, on the wing's area, grow with incidence.

    Attributes
    ----------
    lift, drag : float
        With the angle of attack, 1/rad.
    """

    lift: float
    drag: float


@dataclass(frozen=True)
class StabilityDerivatives:
    """Changes of force and moment with each velocity, in axes of the body.

    Attributes
    ----------
    X_u, X_w, Z_u, Z_w : float
        N s/m.
    Z_q, M_u, M_w : float
        N s.
    M_q : float
        N m s.
    """

    X_u: float
    X_w: float
    Z_u: float
    Z_w: float
    Z_q: float
    M_u: float
    M_w: float
    M_q: float


def slopes(airframe: Airframe) -> Slopes:
    """Return the slopes of lift and drag; the wing leaves no downwash on the tail."""
    wing, tail = airframe.wing, airframe.tail
    share, trim = tail.area / wing.area, trimmed(airframe)
    drag = 0.0
    if airframe.drag:
        drag = 2.0 * wing.induced_drag_factor * trim.wing_lift * wing.slope
        drag += share * 2.0 * tail.induced_drag_factor * trim.tail_lift * tail.slope
    return Slopes(wing.slope + share * tail.slope, drag)


def arms(airframe: Airframe) -> tuple[float, float]:
    """Return how far aft of the centre of gravity wing and tail feel the pitch rate, m.

    A thin airfoil in quasi-steady flow has the incidence of its three-quarter chord.
    """
    x = airframe.centre_of_gravity
    wing = airframe.wing.chord / 2.0 - x
    return wing, airframe.tail_arm - x + airframe.tail.chord / 2.0


def stability_derivatives(model: Airframe | DerivativesModel) -> StabilityDerivatives:
    """Return the stability derivatives of an aircraft in level flight.

    Forces are quasi-steady, the thrust is constant and along x, and there is no downwash. Given
    derivatives are returned as they are.
    """
    if isinstance(model, DerivativesModel):
        return StabilityDerivatives(**dict(model.derivatives))
    trim, slope = trimmed(model), slopes(model)
    flux = model.density * model.speed * model.wing.area
    l_w, l_t = model.centre_of_gravity, model.centre_of_gravity - model.tail_arm
    d_w, d_t = arms(model)
    # Lift that each surface gains per downward velocity of its three-quarter chord, N s/m.
    k_w, k_t = (
        0.5 * model.density * model.speed * part.area * part.slope
        for part in (model.wing, model.tail)
    )
    return StabilityDerivatives(
        X_u=-flux * trim.drag,
        X_w=0.5 * flux * (trim.lift - slope.drag),
        Z_u=-flux * trim.lift,
        Z_w=-0.5 * flux * (slope.lift + trim.drag),
        Z_q=-(k_w * d_w + k_t * d_t),
        M_u=0.0,
        M_w=k_w * l_w + k_t * l_t,
        M_q=k_w * l_w * d_w + k_t * l_t * d_t,
    )


def state_matrix(model: FlightModel) -> Real:
    """Return A of d/dt (u, w, q, theta) = A (u, w, q, theta), shape (4, 4); SI and radians."""
    if isinstance(model, StateMatrixModel):
        return np.array(model.matrix)
    d, m, I = stability_derivatives(model), model.mass, model.pitch_inertia
    return np.array(
        [
            [d.X_u / m, d.X_w / m, 0.0, -model.gravity],
            [d.Z_u / m, d.Z_w / m, d.Z_q / m + model.speed, 0.0],
            [d.M_u / I, d.M_w / I, d.M_q / I, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]
    )
