"""The half aircraft, whose bodies are terms of its mass matrix, against bodies with coordinates.

The other formulation (support.whole_aircraft) shares with the program only the functions of single
segments: it has its own joints, its own forces of the air, and its own eliminations.
"""

from functools import cache

import numpy as np
import pytest

from foldwing.aeroelastic.flight_modes import flight_modes
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.newton import polish_roots
from foldwing.structure.assembly import assemble
from foldwing.structure.modes import natural_modes
from support.random_aircraft import random_aircraft, with_aircraft
from support.whole_aircraft import carriage_components, explicit_aircraft, free_components

EVERY_MODE = 60


def small(wing, basis):
    analysis = {"basis": basis, "bending_modes": 4, "torsion_modes": 4, "damping": 0.0}
    return wing.with_analysis(system_modes=EVERY_MODE, **analysis)


@cache
def plane(name, basis="converged"):
    """Aircraft with few modes per segment, all of which are kept."""
    if isinstance(name, int):
        return small(random_aircraft(np.random.default_rng(name)), basis)
    return small(read_model("three-segment-aircraft").folded(*name), basis)


PLANES = ((30, -60), (0, 0), (80, 50), 1, 4, 7, 9)
EVERY = pytest.mark.parametrize("name", PLANES, ids=str)


@cache
def explicit(name, basis="converged", sides=1, lags=(True, True)):
    wing = plane(name, basis)
    free = sides == 2 and basis == "converged"
    components = free_components(wing) if free else carriage_components(wing)
    return explicit_aircraft(wing, components, sides, *lags)


@cache
def flying(name, lags):
    """Return the program's half aircraft; ``lags`` says whether wing and tail forces do."""
    tail = "theodorsen" if lags[1] else "quasi-steady"
    wing = with_aircraft(plane(name), tail_aerodynamics=tail)
    model = AeroelasticWing(wing, "strip" if lags[0] else "quasi-steady")
    return model, model.system(model.modes())


@pytest.mark.parametrize("basis", ["free-free", "converged"])
@EVERY
def test_natural_frequencies_are_those_with_lagrange_multipliers(name, basis):
    """The inertia of the bordered matrix counts them, its determinant places them."""
    elastic = natural_modes(assemble(plane(name, basis))).omega[3:11]
    other = explicit(name, basis)
    below, above = ([other.count_below(w * (1 + d)) for w in elastic] for d in (-1e-6, 1e-6))
    assert below == list(range(3, 11))
    assert above == list(range(4, 12))
    found = [other.root_near(1j * w * (1 + 1e-6)).imag for w in elastic]
    np.testing.assert_allclose(found, elastic, rtol=1e-10)


@pytest.mark.parametrize("basis", ["free-free", "converged"])
@EVERY
def test_half_the_full_aircraft_is_the_half_aircraft_and_the_other_half_a_clamped_wing(name, basis):
    """The motions that are not mirror images of themselves leave the fuselage at rest."""
    half = natural_modes(assemble(plane(name, basis))).omega
    full = explicit(name, basis, sides=2).frequencies()
    whole, other = full, half[3:][:6]
    for value in other:
        nearest = np.abs(whole / value - 1).argmin()
        assert whole[nearest] == pytest.approx(value, rel=1e-8)
        whole = np.delete(whole, nearest)
    if basis == "converged":
        clamped = natural_modes(assemble(plane(name, basis).clamped)).omega[:6]
        # The clamped root has its twist functions one degree higher.
        np.testing.assert_allclose(whole[3:9], clamped, rtol=2e-3)


def followed_roots(name, lags, speeds):
    """Yield oscillating roots of the half aircraft at several airspeeds, the slowest first."""
    _, problem = flying(name, lags)
    slow = explicit(name, lags=(False, False))
    for U in speeds:
        guess = slow.quasi_steady_roots(U)
        guess = guess[guess.imag > 1e-7 * np.abs(guess).max()]
        guess = guess[np.argsort(np.abs(guess))][:5] * problem.half_chord / U
        found = polish_roots(problem, guess, np.full(len(guess), U), iterations=40)
        kept = found.converged & (found.p.imag > 1e-6)
        yield U, found.p[kept] * U / problem.half_chord


LAGS = {"theodorsen": (True, True), "quasi-steady": (False, False), "mixed": (True, False)}


@pytest.mark.parametrize("sides", [1, 2], ids=["multipliers", "full aircraft"])
@pytest.mark.parametrize("lags", LAGS.values(), ids=LAGS)
@pytest.mark.parametrize("name", [(30, -60), (80, 50), 4, 7, 9], ids=str)
def test_eigenvalues_in_flight_are_the_same(name, lags, sides):
    model, _ = flying(name, lags)
    slowest = model.trim(model.modes()).slowest
    other, checked = explicit(name, sides=sides, lags=lags), 0
    for U, roots in followed_roots(name, lags, slowest * np.array([1.0, 2.2])):
        for root in roots:
            assert other.root_near(root * (1 + 1e-5 + 1e-5j), U) == pytest.approx(root, rel=5e-9)
            checked += 1
    assert checked >= 6


@pytest.mark.parametrize("name", [(30, -60), (30, 60), (0, 0), 1, 4, 9], ids=str)
def test_phugoid_and_short_period_are_eigenvalues_of_one_matrix_without_lag(name):
    """All roots at once: two of zero, the phugoid the slowest of the others, then the faster."""
    model, problem = flying(name, (False, False))
    slowest, other = model.trim(model.modes()).slowest, explicit(name, lags=(False, False))
    speeds = slowest * np.array([1.0, 1.15, 1.3])
    motions = flight_modes(problem, (slowest, 4 * slowest), 9.80665)
    assert motions.names == ("phugoid", "short period")
    values = motions.eigenvalues(problem, speeds)
    for U, (phugoid, short) in zip(speeds, values, strict=True):
        roots = other.quasi_steady_roots(U)
        size = np.sort(np.abs(roots))
        assert size[1] < 1e-3 * abs(phugoid)
        for value in (phugoid, short):
            assert np.abs(roots / value - 1).min() < 1e-6
            assert other.root_near(value * (1 + 1e-6j), U) == pytest.approx(value, rel=1e-9)
        moving = roots[(roots.imag > 1e-3 * abs(phugoid)) & (np.abs(roots) > 0.1 * abs(phugoid))]
        assert np.abs(moving).min() == pytest.approx(abs(phugoid), rel=1e-6)
