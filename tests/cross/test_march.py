"""Damping and frequency seen in a response in time agree with the eigenvalues of the same scheme.

Evidence: marching knows no eigenvalue, and identification knows only numbers against time.
"""

from functools import cache

import numpy as np
import pytest

from foldwing.aeroelastic.reference import Reference
from foldwing.aeroelastic.reference_roots import roots_near
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import read_model
from foldwing.simulation import identify, march

PERCENT = 1e-2


@cache
def marching_of(speed, **lattice):
    small = {"chordwise": 2, "spanwise": 6, "wake": 5.0, "scheme": "average"}
    wing = read_model("three-segment").with_lattice(**(small | lattice))
    model = AeroelasticWing(wing, "lattice")
    return Reference(model, model.modes(tuple(np.radians([30.0, -75.0])))).at(speed)


def displaced(modes=4):
    q = np.zeros(12)
    q[:modes] = 1e-3
    return q


@pytest.mark.parametrize("scheme", ["average", "literal", "printed"])
@pytest.mark.parametrize("speed", [15.0, 22.0])
def test_identified_motions_are_the_eigenvalues(scheme, speed):
    marching = marching_of(speed, scheme=scheme, relaxation=0.3)
    response = march(marching, 600, displacement=displaced())
    found = identify(response.coordinates, response.step, skip=60)
    roots = roots_near(marching, 150.0j, 10).eigenvalues
    roots = roots[(roots.imag > 0.0) & (roots.real > -0.1 * speed / 0.025)]
    assert len(roots) >= 4
    for root in roots:
        seen = found.eigenvalues[found.nearest(root)]
        assert seen.imag == pytest.approx(root.imag, rel=0.1 * PERCENT)
        assert seen.real == pytest.approx(root.real, rel=0.1 * PERCENT)
    assert found.residual < 1e-6


def test_a_response_grows_where_an_eigenvalue_says_so():
    last = []
    for speed in (15.0, 25.0):
        q = march(marching_of(speed), 1500, displacement=displaced()).coordinates
        last.append(np.abs(q[-100:]).max() / np.abs(q[600:700]).max())
    assert last[0] < 0.5
    assert last[1] > 2.0


def test_a_response_is_linear_in_the_disturbance():
    marching = marching_of(20.0)
    v = np.linspace(-1.0, 1.0, 12)
    parts = (march(marching, 50, displaced()), march(marching, 50, velocity=v))
    both = march(marching, 50, 2.0 * displaced(), -3.0 * v)
    for name in ("coordinates", "velocities", "circulation"):
        q, u = (getattr(part, name) for part in parts)
        np.testing.assert_allclose(
            getattr(both, name), 2.0 * q - 3.0 * u, atol=1e-12 * np.abs(u).max()
        )


def test_the_disturbance_is_where_the_response_begins():
    v = np.arange(12.0)
    response = march(marching_of(20.0), 3, displaced(), v)
    np.testing.assert_array_equal(response.coordinates[0], displaced())
    np.testing.assert_array_equal(response.velocities[0], v)
    assert not response.circulation[0].any()
    np.testing.assert_allclose(response.time, np.arange(4) * 0.05 / 2 / 20.0, rtol=1e-12)


def test_a_wing_held_still_settles_to_its_steady_circulation():
    """Without flexibility of note a displaced wing keeps its incidence for a while."""
    marching = marching_of(20.0, wake=40.0)
    x = np.zeros(marching.states)
    x[marching.coordinates] = displaced()
    panels = marching.panels
    A0 = marching.after[panels, panels].toarray()
    wash = -(marching.after[panels, marching.coordinates] @ displaced())
    strips = marching.sizes[1]
    steady = np.linalg.solve(A0, wash).reshape(-1, strips).sum(axis=0)
    held = _held(marching, displaced(), 60)
    np.testing.assert_allclose(held, steady, rtol=0.02, atol=0.02 * np.abs(steady).max())


def _held(marching, q, steps):
    """Circulation of the strips after marching the air alone past a wing that does not move."""
    air = slice(0, marching.wake.stop)
    M1, M2 = (m[air, air].toarray() for m in (marching.after, marching.before))
    wash = np.zeros(air.stop)
    wash[marching.panels] = -(marching.after[marching.panels, marching.coordinates] @ q)
    x = np.zeros(air.stop)
    for _ in range(steps):
        x = np.linalg.solve(M1, wash - M2 @ x)
    return x[marching.panels].reshape(-1, marching.sizes[1]).sum(axis=0)


def test_nothing_to_march():
    with pytest.raises(InputError, match="must not be zero"):
        march(marching_of(20.0), 10)
    with pytest.raises(InputError, match="at least 1"):
        march(marching_of(20.0), 0, displaced())
