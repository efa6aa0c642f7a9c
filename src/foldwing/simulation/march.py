"""The coupled equations of a wing in an airstream, marched in time from a disturbance."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu

from foldwing.aeroelastic.reference import Marching
from foldwing.errors import InputError
from foldwing.maths.arrays import Real


@dataclass(frozen=True)
class Response:
    """The motion of a wing after a disturbance.

    Attributes
    ----------
    airspeed : float
        U in m/s.
    time : array, shape (t,)
        In seconds, from 0.
    coordinates, velocities : array, shape (t, n)
        Modal coordinates q in m kg^(1/2), for modes of unit modal mass, and dq/dt.
    circulation : array, shape (t, strips)
        Bound circulation of every strip in m^2/s, lifting when positive.
    """

    airspeed: float
    time: Real
    coordinates: Real
    velocities: Real
    circulation: Real

    @property
    def step(self) -> float:
        """Time step dt in seconds."""
        return float(self.time[1])


def march(
    marching: Marching,
    steps: int,
    displacement: Real | None = None,
    velocity: Real | None = None,
) -> Response:
    """Return the response to a disturbance; before it the wing does not disturb the stream.

    Parameters
    ----------
    marching : Marching
    steps : int
        How many steps in time, at least 1.
    displacement, velocity : array, shape (n,), optional
        Modal coordinates at time 0 and their rates; zero when left out.

    Raises
    ------
    InputError
        When there is no step, or nothing disturbs the wing.
    """
    if steps < 1:
        raise InputError("steps", steps, "must be at least 1", "Give the number of time steps.")
    x = _disturbed(marching, displacement, velocity)
    panels, strips, _ = marching.sizes
    factors = splu(marching.after)
    states = np.empty((steps + 1, marching.states - marching.wake.stop + strips))
    for index in range(steps + 1):
        states[index, :strips] = x[:panels].reshape(-1, strips).sum(axis=0)
        states[index, strips:] = x[marching.wake.stop :]
        x = factors.solve(-(marching.before @ x))
    q, v = np.split(states[:, strips:], 2, axis=1)
    time = np.arange(steps + 1) * marching.step
    return Response(marching.airspeed, time, q, v, states[:, :strips])


def _disturbed(marching: Marching, displacement: Real | None, velocity: Real | None) -> Real:
    """Return the state at time 0, without any circulation."""
    x = np.zeros(marching.states)
    if displacement is not None:
        x[marching.coordinates] = displacement
    if velocity is not None:
        x[marching.velocities] = velocity
    if not x.any():
        limit = "displacement or velocity of some mode must not be zero"
        raise InputError("displacement", None, limit, "Displace the first mode, for example.")
    return x
