"""Discrete time derivatives: their order, their limits, and the damping that one invents."""

from dataclasses import dataclass

import numpy as np
import pytest

from foldwing.aerodynamics.schemes import EXACT, TimeScheme
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.stability.newton import polish_roots

R = np.array([0.3j, 1.0 + 0.4j, -0.2 + 2.0j])


@dataclass(frozen=True)
class Vacuum:
    """No air at all, seen in steps of time."""

    scheme: TimeScheme
    size: int = 2
    half_chord: float = 0.5
    highest_frequency: float = np.inf
    largest_decay: float = np.inf

    def forces(self, p):
        return np.zeros((len(p), 2, 2), complex)

    def forces_with_derivative(self, p):
        return self.forces(p), self.forces(p)

    def steady_forces(self):
        return np.zeros((2, 2))

    def apparent_mass(self):
        return np.zeros((2, 2))


def test_exact_scheme_changes_nothing():
    rates, slopes = EXACT.rates_with_derivative(R)
    np.testing.assert_array_equal(rates, [R, R**2, np.ones(3)])
    np.testing.assert_array_equal(slopes, [np.ones(3), 2 * R, np.zeros(3)])


@pytest.mark.parametrize(("name", "order"), [("average", 2), ("literal", 1), ("printed", 1)])
def test_order_of_the_derivatives(name, order):
    steps = np.array([0.04, 0.02, 0.01])
    exact = EXACT.rates(R)
    errors = [
        [np.abs(found - right).max() for found, right in zip(rates, exact, strict=True)]
        for rates in (TimeScheme(name, step).rates(R) for step in steps)
    ]
    for error in np.array(errors).T:
        if error.max() > 0.0:
            slope = np.polyfit(np.log(steps), np.log(error), 1)[0]
            assert slope == pytest.approx(order, abs=0.05)


@pytest.mark.parametrize("name", ["exact", "average", "literal", "printed"])
def test_derivatives_with_respect_to_the_rate(name):
    scheme, h = TimeScheme(name, 0.3), 1e-5
    _, slopes = scheme.rates_with_derivative(R)
    ahead, behind = scheme.rates(R + h), scheme.rates(R - h)
    for slope, right, left in zip(slopes, ahead, behind, strict=True):
        np.testing.assert_allclose(slope, (right - left) / (2 * h), rtol=0, atol=2e-9)


def root_in_vacuum(name, step, frequency, damping=0.0):
    """The root of an oscillator of 1 rad/s times ``frequency`` at U = 1 m/s, in rad/s."""
    omega = np.array([frequency, 7.0 * frequency])
    system = AeroelasticSystem(omega, Vacuum(TimeScheme(name, step)), damping)
    start = np.array([0.5j * frequency])
    roots = polish_roots(system, start, np.ones(1), iterations=30)
    assert roots.converged[0]
    return roots.p[0] / 0.5


@pytest.mark.parametrize("step", [0.02, 0.1, 0.5])
def test_average_scheme_keeps_an_oscillator_undamped_and_slows_it(step):
    """tan(omega' h / 2) = omega h / 2 for the trapezoidal rule."""
    root = root_in_vacuum("average", step, 2.0)
    assert root.imag == pytest.approx(2 / step * np.arctan(step), rel=1e-12)
    assert abs(root.real) < 1e-12


@pytest.mark.parametrize("step", [0.01, 0.02, 0.05])
def test_literal_scheme_damps_an_oscillator(step):
    """By the artificial damping ratio omega dt / 4, here 0.5 to 2.5 per cent."""
    root = root_in_vacuum("literal", step, 2.0)
    assert -root.real / root.imag == pytest.approx(2.0 * step / 4, rel=0.02)


@pytest.mark.parametrize("name", ["exact", "average", "literal"])
def test_structural_damping_is_met_as_the_step_vanishes(name):
    root = root_in_vacuum(name, 1e-6, 2.0, damping=0.03)
    assert -root.real / abs(root) == pytest.approx(0.03, rel=1e-4)
