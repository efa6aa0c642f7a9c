"""Structure and air in one matrix T(p, U), against Newton's second law in modal coordinates.

Evidence: the modal equation written with lambda, finite differences, the eigenvalues of a state
matrix where the aerodynamics are polynomials, and the apparent mass of a uniform wing.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
import scipy.linalg

from foldwing.aerodynamics.schemes import EXACT, TimeScheme
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.stability.flutter import find_flutter
from foldwing.stability.problem import evaluate, evaluate_with_derivatives
from support.random_wings import random_wing
from support.stability import (
    determinant,
    exact_root,
    example,
    example_modes,
    example_wing,
    of_kind,
    with_other_hinges,
)


@dataclass(frozen=True)
class PolynomialAir:
    """Qhat(p) = Q0 + p Q1 + p^2 Q2; the last term is b^-2 times minus an apparent mass."""

    Q0: np.ndarray
    Q1: np.ndarray
    Q2: np.ndarray
    half_chord: float = 0.5
    highest_frequency: float = math.inf
    largest_decay: float = math.inf
    scheme: TimeScheme = EXACT

    @property
    def size(self):
        return len(self.Q0)

    def forces(self, p):
        p = np.asarray(p)[:, None, None]
        return self.Q0 + p * self.Q1 + p**2 * self.Q2

    def forces_with_derivative(self, p):
        return self.forces(p), self.Q1 + 2 * np.asarray(p)[:, None, None] * self.Q2

    def steady_forces(self):
        return self.Q0

    has_apparent_mass = True

    def apparent_mass(self):
        return -self.Q2 * self.half_chord**2


def polynomial_system(rigid, damping, push=0.0):
    """Four modes, some of them rigid; of two rigid ones a combination feels no steady force.

    The air pushes the rigid motion on: in proportion to its rate, or to itself if it feels it.
    """
    rng = np.random.default_rng(5)
    Q0, Q1 = rng.standard_normal((2, 4, 4))
    Q0[:, :rigid] = np.outer(rng.standard_normal(4), [0.6, 0.8])[:, :rigid]
    if rigid == 1:
        Q0[:, 0] = 0.0
        Q1[0, 0] += push
    else:
        Q0[:2, :2] += push * np.outer([0.6, 0.8], [0.6, 0.8])
    A = rng.standard_normal((4, 4))
    air = PolynomialAir(Q0, Q1 - 3 * np.eye(4), -0.1 * A @ A.T)
    return AeroelasticSystem(np.array([0.0] * rigid + [2.0, 3.0, 5.0, 8.0][rigid:]), air, damping)


def random_system(seed, aerodynamics="strip"):
    model = AeroelasticWing(random_wing(np.random.default_rng(seed)), aerodynamics)
    return model.system(model.modes())


def damped(system):
    return AeroelasticSystem(system.omega, system.aerodynamics, 0.03)


SYSTEMS = {
    "section chords differ": random_system(5),
    "with damping": random_system(805),
    "quasi-steady": random_system(32, "quasi-steady"),
    "free tip": with_other_hinges("three-segment", ("same", None), 30, -60),
    "free, with damping": damped(with_other_hinges("three-segment", (None, None), 30, -60)),
    "one neutral": polynomial_system(1, 0.02),
    "one of two neutral": polynomial_system(2, 0.0),
    "one of two neutral, damped": polynomial_system(2, 0.04),
}
EVERY = pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)


def force_balance(system, p, speed):
    """Modal inertia, damping and stiffness minus air forces at lambda = p U / b."""
    rate = p * speed / system.half_chord
    own = rate**2 + 2 * system.damping * system.omega * rate + system.omega**2
    return np.diag(own) - speed**2 * system.aerodynamics.forces(np.array([p], complex))[0]


@EVERY
def test_t_has_the_determinant_of_the_force_balance(system):
    """Up to a constant, a power of p for neutral motions and one of U for rigid ones."""
    neutral, rigid = int(system.neutral.sum()), int((system.omega == 0).sum())
    ratios = []
    for p, U in ((0.1 + 0.3j, 9.0), (0.02 + 0.7j, 4.0), (0.5 + 0j, 30.0), (1e-3 + 1e-3j, 14.0)):
        sign, size = np.linalg.slogdet(force_balance(system, p, U))
        sign_T, size_T = np.linalg.slogdet(evaluate(system, np.array([p]), np.array([U]))[0])
        known = neutral * np.log(p + 0j) + 2 * rigid * np.log(U)
        ratios.append(sign / sign_T * np.exp(size - size_T - known - 2 * log_scale(system)))
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-7)


def log_scale(system):
    """Natural logarithm of the product of the frequencies, which keeps the ratios finite."""
    return float(np.log(system.omega[system.omega > 0]).sum())


@EVERY
def test_modal_vectors_balance_the_forces(system):
    for guess, U in ((0.02 + 0.4j, 20.0), (0.01 + 0.9j, 8.0)):
        p = exact_root(system, guess, U)
        T = evaluate(system, np.array([p]), np.array([U]))[0]
        x = np.linalg.svd(T)[2][-1:].conj()
        q = system.modal_vectors(np.array([p]), np.array([U]), x)[0]
        Z = force_balance(system, p, U)
        assert np.linalg.norm(q) == pytest.approx(1.0)
        assert np.linalg.norm(Z @ q) < 1e-9 * np.linalg.norm(Z, 2)
        # also row by row, each beside the largest of its terms: soft modes count as well
        assert np.all(np.abs(Z @ q) < 1e-8 * np.abs(Z) @ np.abs(q))


@EVERY
@pytest.mark.parametrize("p", [0.05 + 0.6j, 0.3 + 0j, -0.02 + 2.0j])
def test_derivatives_by_finite_differences(system, p):
    U, h = 13.0, 1e-6

    def T(p, U):
        return evaluate(system, np.array([p], complex), np.array([U]))[0]

    exact = evaluate_with_derivatives(system, np.array([p], complex), np.array([U]))
    size = np.abs(T(p, U)).max()
    np.testing.assert_allclose(exact.value[0], T(p, U), rtol=1e-15)
    for way in (1.0, 1.0j) if p.imag else (1.0,):
        along = (T(p + way * h, U) - T(p - way * h, U)) / (2 * h * way)
        np.testing.assert_allclose(exact.by_p[0], along, rtol=1e-6, atol=1e-8 * size / abs(p))
    # a quadratic in U: the central difference is exact for any step
    along = (T(p, U + 2.0) - T(p, U - 2.0)) / 4.0
    np.testing.assert_allclose(exact.by_speed[0], along, rtol=1e-9, atol=1e-12 * size)


@pytest.mark.parametrize("name", ["free tip", "one neutral", "one of two neutral"])
def test_neutral_motions_stand_apart(name):
    system = SYSTEMS[name]
    assert system.neutral.sum() == 1
    np.testing.assert_allclose(system.rotation.T @ system.rotation, np.eye(system.size), atol=1e-14)
    q = system.rotation[:, system.neutral][:, 0]
    for U in (1.0, 30.0):  # without any motion in time there is no force at all
        at_rest = np.diag(system.omega**2) - U**2 * system.aerodynamics.steady_forces()
        assert np.linalg.norm(at_rest @ q) < 1e-10 * np.linalg.norm(at_rest, 2)
    small, smaller = (abs(determinant(system, p, 5.0)) for p in (1e-7, 1e-8))
    assert smaller == pytest.approx(small, rel=1e-3)


def test_rigid_motion_that_feels_the_air_is_not_neutral():
    system = SYSTEMS["one of two neutral"]
    assert system.rigid.tolist() == [True, True, False, False]
    assert system.neutral.tolist() == [False, True, False, False]
    steady = np.linalg.norm(system.aerodynamics.steady_forces() @ system.rotation, axis=0)
    assert steady[0] > 0.1
    assert steady[1] < 1e-14


@pytest.mark.parametrize("name", ["one of two neutral", "one of two neutral, damped"])
def test_roots_of_polynomial_air_are_those_of_a_state_matrix(name):
    """The pencil has as many roots as states, less one exact zero for each neutral motion."""
    system, U = SYSTEMS[name], 1.7
    b, air, n = system.half_chord, system.aerodynamics, system.size
    M = np.eye(n) - b**2 * air.Q2
    C = np.diag(2 * system.damping * system.omega) - U * b * air.Q1
    K = np.diag(system.omega**2) - U**2 * air.Q0
    states = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, np.hstack([K, C]))]])
    roots = np.linalg.eigvals(states) * b / U
    assert np.count_nonzero(np.abs(roots) < 1e-12) == 1
    for p in roots[np.abs(roots) > 1e-12]:
        s = np.linalg.svd(evaluate(system, np.array([p]), np.array([U]))[0], compute_uv=False)
        assert s[-1] < 1e-12 * s[0]


@pytest.mark.parametrize("rigid", [1, 2])
@pytest.mark.parametrize("damping", [0.0, 0.04])
def test_counts_of_polynomial_air_from_a_state_matrix(rigid, damping):
    """A rigid motion that the air makes unstable at every airspeed is counted at every airspeed."""
    system = polynomial_system(rigid, damping, push=6.0)
    n, b, air = system.size, system.half_chord, system.aerodynamics
    M = np.eye(n) - b**2 * air.Q2
    analysis = find_flutter(system, (0.5, 20.0))
    exact = []
    for U in analysis.certificate.speeds:
        C = np.diag(2 * system.damping * system.omega) - U * b * air.Q1
        K = np.diag(system.omega**2) - U**2 * air.Q0
        states = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, np.hstack([K, C]))]])
        p = np.linalg.eigvals(states) * b / U
        assert p.real.max() < 1.5
        exact.append(int(np.count_nonzero(p.real > 1e-9)))
    assert analysis.certificate.counted.tolist() == exact
    assert analysis.certified
    assert min(exact) >= 1


def test_quasi_steady_points_from_a_state_matrix():
    """Without lag and apparent mass the roots at one airspeed are those of one matrix."""
    model = AeroelasticWing(example_wing("goland").wing, "quasi-steady")
    system = model.system(model.modes())
    air, n, b = system.aerodynamics, system.size, system.half_chord
    rate = (air.forces(np.array([1.0 + 0j]))[0] - air.steady_forces()).real

    def unstable(U):
        K = np.diag(system.omega**2) - U**2 * air.steady_forces()
        states = np.block([[np.zeros((n, n)), np.eye(n)], [-K, U * b * rate]])
        return np.count_nonzero(np.linalg.eigvals(states).real > 0)

    analysis = find_flutter(system, (40.0, 760.0))
    assert analysis.certified
    assert analysis.certificate.counted.tolist() == [
        unstable(U) for U in analysis.certificate.speeds
    ]
    points = [point for point in analysis.points if point.event != "merger"]
    assert len(points) > 2
    for point in points:
        change = unstable(point.speed * (1 + 1e-7)) - unstable(point.speed * (1 - 1e-7))
        size = 2 if point.kind == "flutter" else 1
        assert change == (size if point.event == "onset" else -size)
    assert not np.any(system.still_air().mass - np.diag(system.scale**2))


def test_still_air_has_the_apparent_mass_of_a_uniform_wing():
    """With the elastic axis at mid-chord bending carries pi rho b^2 of air per span."""
    wing = example_wing("hale").wing
    segment, modes = wing.segments[0], example_modes("hale")
    air = example("hale").still_air()
    omega = 1 / np.sqrt(scipy.linalg.eigvalsh(air.mass, air.stiffness)[::-1])
    apparent = np.pi * wing.air.density * segment.half_chord**2
    bending = np.sqrt(segment.mass_per_span / (segment.mass_per_span + apparent))
    twist = apparent * segment.half_chord**2 / 8
    torsion = np.sqrt(segment.inertia_per_span / (segment.inertia_per_span + twist))
    factors = [bending if name.startswith("B") else torsion for name in modes.names]
    np.testing.assert_allclose(omega, np.sort(modes.omega * factors), rtol=1e-9)
    assert air.apparent_mass


def test_still_air_is_the_limit_of_low_speed():
    system = damped(example("three-segment", 30, -60))
    air = system.still_air()
    values = scipy.linalg.eigvals(
        np.block([[np.zeros((12, 12)), np.eye(12)], [-air.stiffness, -air.damping]]),
        scipy.linalg.block_diag(np.eye(12), air.mass),
    )
    rest = np.sort_complex(values[values.imag > 0])[:3]
    errors = []
    for U in (0.02, 0.01):
        roots = [exact_root(system, z * system.half_chord / U, U) for z in rest]
        errors.append(np.abs(np.array(roots) * U / system.half_chord / rest - 1))
    assert np.max(errors[1]) < 1e-3
    np.testing.assert_allclose(errors[0] / errors[1], 2.0, rtol=0.02)


def test_free_flap_is_left_out_at_rest():
    system = SYSTEMS["free tip"]
    air = system.still_air()
    assert air.columns.tolist() == list(range(1, system.size))
    assert air.mass.shape == (system.size - 1,) * 2


@pytest.mark.parametrize("name", ["section chords differ", "with damping"])
def test_entries_are_of_order_one(name):
    """Whatever the stiffness of the modes, T is the unit matrix at rest and stays comparable."""
    system = SYSTEMS[name]
    at_rest = evaluate(system, np.array([0.3j]), np.array([1e-9]))[0]
    np.testing.assert_allclose(at_rest, np.eye(system.size), atol=1e-9)
    point = of_kind(find_flutter(system, (0.5, 55.0)), "flutter")
    for U in (5.0, *(p.speed for p in point)):
        assert np.abs(evaluate(system, np.array([0.3j]), np.array([U]))).max() < 100
