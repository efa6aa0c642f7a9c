"""Component modes of plates against beams, limits, symmetry and the theory of corners."""

import numpy as np
import pytest
import scipy.linalg
from numpy.polynomial.legendre import leggauss
from scipy.optimize import root

from foldwing.errors import ComputationError, InputError
from foldwing.model import Planform, Segment, Sheet, rectangle
from foldwing.structure.beam import beam_modes
from foldwing.structure.component import Root
from foldwing.structure.in_plane import IN_PLANE
from foldwing.structure.plate import OUT_OF_PLANE, Plate, plate_modes
from foldwing.structure.plate_elastic import elastic_modes
from support.plates import (
    L_SHAPE,
    OUTLINES,
    SQUARE,
    TRAPEZOID,
    legendre_derivatives,
    parameters,
    ritz,
    sheet,
)

CANTILEVER = np.array([1.8751040687119612, 4.6940911329741746, 7.8547574382376126]) ** 2
TAPERED = ((0.0014, 0.001), (0.0008, 0.0012))


@pytest.fixture(autouse=True)
def _no_disk(monkeypatch):
    monkeypatch.setenv("FOLDWING_CACHE", "")


def modes_of(planform, root, count=8, elastic_axis=0.4, **of):
    return plate_modes(Plate(planform, sheet(**of), elastic_axis), count, root)


def turned(planform, angle):
    """The outline turned about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    corners = planform.array @ np.array([[c, s], [-s, c]])
    return Planform(corners=tuple(map(tuple, corners.tolist())), tip=planform.tip)


def random_points(planform, count, seed=1):
    rng = np.random.default_rng(seed)
    y = rng.uniform(planform.breaks[0], planform.breaks[-1], count)
    front, back = planform.chord_ends(y)
    return front + rng.uniform(0.02, 0.98, count) * (back - front), y


# --- beams --------------------------------------------------------------------------------------


def test_bending_without_poissons_ratio_is_that_of_a_cantilever_beam():
    """nu = 0: w(y) of the beam satisfies plate and edges, so they agree whatever the width."""
    material = sheet(poissons_ratio=0.0)
    omega2 = elastic_modes(rectangle(0.3, 0.02, 0.5), material, 5, True, 0.01).omega2
    found = parameters(omega2, 0.3, material)
    for exact in CANTILEVER[:2]:
        assert np.abs(found / exact - 1.0).min() < 1e-6


def test_torsion_of_a_slender_free_strip_is_that_of_a_thin_strip():
    """k pi/L sqrt(GJ/i) with GJ = G c t^3/3 and i = m c^2/12, the nearer the longer the strip."""
    errors = []
    for length in (0.2, 0.4):
        material, t, c = sheet(poissons_ratio=0.0), 0.001, 0.02
        G, m = 70e9 / 2.0, 2700.0 * c * t
        exact = np.pi / length * np.sqrt(G * c * t**3 / 3.0 / (m * c**2 / 12.0))
        omega = np.sqrt(
            elastic_modes(rectangle(length, c, 0.5), material, 8, False, c / 3.0).omega2
        )
        errors.append(np.abs(omega / exact - 1.0).min())
    assert errors[1] < 0.001
    assert errors[1] < 0.35 * errors[0]


def test_linear_taper_of_the_thickness_is_that_of_a_tapered_beam():
    """nu = 0 and t falling from root to tip: a beam of depth t by the Ritz method."""
    length, root_t, tip_t, E, rho = 0.3, 0.002, 0.0008, 70e9, 2700.0
    z, weights = leggauss(40)
    w = legendre_derivatives(16, z, 2)
    t = root_t + (tip_t - root_t) * (z + 1.0) / 2.0
    K = np.einsum("am,bm,m->ab", w[2], w[2], weights * E * t**3 / 12.0) * (2.0 / length) ** 4
    M = np.einsum("am,bm,m->ab", w[0], w[0], weights * rho * t)
    exact = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[:2])
    material = sheet(poissons_ratio=0.0, thickness=((root_t,), (tip_t,)))
    found = np.sqrt(elastic_modes(rectangle(length, 0.02, 0.5), material, 5, True, 0.01).omega2)
    for omega in exact:
        assert np.abs(found / omega - 1.0).min() < 1e-6


# --- limits and symmetry --------------------------------------------------------------------------


def test_errors_of_a_cantilever_fall_as_its_corners_prescribe():
    """Where clamped and free edges meet at 90 degrees, w ~ r^(1 + s), s complex: the error of
    omega is h^(2 Re s) (A + B cos(2 Im s log h) + C sin(...)) above the limit. Fitted to four
    meshes it holds for the others; with any other exponent it does not."""
    s = corner_exponent(0.3)
    np.testing.assert_allclose([s.real, s.imag], [1.0687, 0.4386], atol=1e-4)
    h = 1.0 / np.array([4.0, 6.0, 8.0, 10.0, 12.0, 16.0])
    omega = np.array(
        [
            parameters(elastic_modes(SQUARE, sheet(), 3, True, 0.1 * one).omega2, 0.1, sheet())
            for one in h
        ]
    )
    assert np.all(np.diff(omega, axis=0) < 0.0)
    for mode in (0, 1, 2):
        limits, left = zip(*(fitted(h, omega[:, mode], p, s.imag) for p in ORDERS), strict=True)
        orders = np.array(ORDERS)
        assert abs(orders[np.argmin(left)] - s.real) < 0.25
        assert np.all(omega[:, mode] > limits[ORDERS.index(1.07)])


ORDERS = [0.57, 0.82, 1.07, 1.32, 1.57]


def fitted(h, omega, real, imaginary):
    """Limit and remainder, relative to the smallest error, of the law of errors at a corner."""
    phase = 2.0 * imaginary * np.log(h)
    law = np.column_stack(
        [np.ones_like(h), *(h ** (2 * real) * f for f in (1 + 0 * h, np.cos(phase), np.sin(phase)))]
    )
    held, *_ = np.linalg.lstsq(law, omega, rcond=None)
    return held[0], np.abs(law @ held - omega).max()


def corner_exponent(nu):
    """s of w = r^(1+s) F(angle) with the least real part, clamped at 0 and free at 90 degrees."""

    def residual(parts):
        s = complex(*parts)
        p, q = s + 1.0, s - 1.0
        rates = np.array([p, p, q, q])

        def shapes(angle, order):
            phase = order * np.pi / 2.0
            waves = [np.sin(p * angle + phase), np.cos(p * angle + phase)]
            waves += [np.sin(q * angle + phase), np.cos(q * angle + phase)]
            return rates**order * np.array(waves)

        f, f1, f2, f3 = (shapes(np.pi / 2.0, order) for order in range(4))
        moment = p * f + f2 + nu * p * (p - 1.0) * f
        shear = p**2 * f1 + f3 + (1.0 - nu) * (p - 1.0) * (p - 2.0) * f1
        d = np.linalg.det(np.array([shapes(0.0, 0), shapes(0.0, 1), moment, shear]))
        return [d.real, d.imag]

    return complex(*root(residual, [1.1, 0.4]).x)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_free_plate_has_no_such_corners_and_converges_fast(order):
    """Fourth order or better, from above."""
    exact = np.sqrt(ritz(1.0, 1.0, 0.3, False, 18)[3:6])[order]
    errors = [
        parameters(elastic_modes(SQUARE, sheet(), 3, False, 0.1 / n).omega2, 0.1, sheet())[order]
        / exact
        - 1.0
        for n in (1, 2, 4)
    ]
    assert errors[0] > errors[1] > errors[2] > 0.0
    assert np.polyfit(np.log((1.0, 0.5, 0.25)), np.log(errors), 1)[0] > 4.0


@pytest.mark.parametrize("angle", [0.4, -1.1])
@pytest.mark.parametrize("planform", [SQUARE, L_SHAPE], ids=["square", "L"])
def test_a_plate_turned_in_its_plane_keeps_its_frequencies(planform, angle):
    """Also where the clamped edge lies across the axes."""
    straight = elastic_modes(planform, sheet(), 6, True, 0.02).omega2
    other = elastic_modes(turned(planform, angle), sheet(), 6, True, 0.02).omega2
    np.testing.assert_allclose(other, straight, rtol=1e-9 if planform is SQUARE else 2e-3)


class Orthotropic(Sheet):
    """A sheet with a grain along x, or along y."""

    across: bool = False

    @property
    def stiffness(self):
        Q = np.array([[90.0, 4.0, 0.0], [4.0, 15.0, 0.0], [0.0, 0.0, 7.0]]) * 1e9
        return Q[np.ix_([1, 0, 2], [1, 0, 2])] if self.across else Q


def test_a_grain_turned_by_ninety_degrees_exchanges_the_axes():
    """Of a free square: the same frequencies, and the mode at (x, y) is the other's at (y, x)."""
    along, across = (
        plate_modes(
            Plate(SQUARE, Orthotropic(**sheet().model_dump(), across=turn), 0.5), 8, Root.FREE
        )
        for turn in (False, True)
    )
    np.testing.assert_allclose(across.frequencies, along.frequencies, rtol=1e-9)
    assert not np.allclose(along.frequencies, modes_of(SQUARE, Root.FREE).frequencies, rtol=0.05)
    x, y = random_points(SQUARE, 50)
    w = along.displacement(x, y)[:, 2, 3:8]
    other = across.displacement(y - 0.05, x + 0.05)[:, 2, 3:8]
    signs = np.sign((w * other).sum(axis=0))
    np.testing.assert_allclose(other * signs, w, atol=1e-7)


@pytest.mark.parametrize("kind", [Root.CLAMPED, Root.FREE])
def test_modes_of_a_symmetric_plate_are_symmetric_or_antisymmetric(kind):
    """About the middle of a rectangle's chord."""
    planform = rectangle(0.14, 0.05, 0.5)
    modes = modes_of(planform, kind, 10)
    x, y = random_points(planform, 60)
    here, there = (modes.displacement(s * x, y)[:, 2] for s in (1.0, -1.0))
    elastic = slice(len(OUT_OF_PLANE[kind]), 10)
    parity = np.sign((here * there).sum(axis=0))[elastic]
    np.testing.assert_allclose(there[:, elastic], here[:, elastic] * parity, atol=1e-8)
    assert {1.0, -1.0} == set(parity)


def test_a_rectangle_with_corners_on_its_sides_is_the_rectangle():
    """Meshed by netgen instead of in cells: frequencies within the errors of both."""
    more = ((-0.05, 0.0), (-0.05, 0.03), (-0.05, 0.1), (0.05, 0.1), (0.05, 0.04), (0.05, 0.0))
    same = Planform(corners=more, tip=(2, 3))
    for clamped, tolerance in ((True, 1e-3), (False, 1e-6)):
        plain, other = (elastic_modes(p, sheet(), 6, clamped, 0.01).omega2 for p in (SQUARE, same))
        np.testing.assert_allclose(other, plain, rtol=tolerance)


# --- what every component offers ------------------------------------------------------------------


def integrated(modes, planform, material):
    """The mass matrix, the motion of the centre and the mass by quadrature of displacements."""
    total = 0.0
    for low, high in zip(planform.breaks[:-1], planform.breaks[1:], strict=True):
        z, weights = leggauss(60)
        y = low + (high - low) * (z + 1.0) / 2.0
        front, back = planform.chord_ends(y)
        x = front[:, None] + (back - front)[:, None] * (z + 1.0) / 2.0
        area = np.outer(weights * (back - front), weights) * (high - low) / 4.0
        points = x.ravel(), np.repeat(y, len(z))
        t = material.thickness_at(*planform.fractions(*points))
        u = modes.displacement(*points)
        u = np.concatenate([u, np.broadcast_to(np.eye(3), (len(u), 3, 3))], axis=2)
        total = total + np.einsum("m,mai,maj->ij", area.ravel() * 2700.0 * t, u, u)
    return total[:-3, :-3], total[-3:, :-3], total[-1, -1]


@pytest.mark.parametrize("kind", list(Root))
@pytest.mark.parametrize("name", ["trapezoid", "delta", "crank"])
def test_mass_is_that_of_the_displacements(name, kind):
    """All blocks, elastic, rigid, mixed and in the plane, of a sheet of varying thickness; the
    number and order of coordinates are those that every component has."""
    planform, material = OUTLINES[name], sheet(thickness=TAPERED)
    modes = modes_of(planform, kind, thickness=TAPERED)
    rigid = OUT_OF_PLANE[kind]
    assert modes.count == 8 + len(IN_PLANE[kind]) + (2 if kind is Root.CARRIAGE else 0)
    M, motion, mass = integrated(modes, planform, material)
    size = np.sqrt(np.outer(np.diag(modes.mass), np.diag(modes.mass)))
    np.testing.assert_allclose(M / size, modes.mass / size, atol=2e-4)
    scale = np.sqrt(mass * np.diag(modes.mass))
    np.testing.assert_allclose(motion / scale, modes.mass_centre_motion / scale, atol=2e-4)
    assert modes.mass_and_centre[0] == pytest.approx(mass, rel=1e-4)
    assert np.all(modes.stiffness[: len(rigid)] == 0.0)
    assert np.all(np.diag(modes.stiffness)[len(rigid) : modes.count - len(IN_PLANE[kind])] > 0.0)
    assert scipy.linalg.eigvalsh(modes.mass)[0] > 0.0


def test_rigid_motions_are_exact_and_in_the_plane_those_of_a_beam():
    """Plunge, pitch nose up and roll; x, y and yaw, with the masses of a beam of the same strip."""
    modes = modes_of(rectangle(0.14, 0.05, 0.4), Root.FREE)
    strip = Segment(
        span=0.14,
        chord=0.05,
        bending_stiffness=1.0,
        torsion_stiffness=1.0,
        mass_per_span=2.7 * 0.05,
        inertia_per_span=2.7 * (0.05**3 / 12.0 + 0.05 * 0.005**2),
        elastic_axis=0.4,
        mass_centre=0.5,
    )
    from foldwing.model import Analysis

    beam = beam_modes(strip, Analysis(), Root.FREE)
    x, y = random_points(rectangle(0.14, 0.05, 0.4), 20)
    np.testing.assert_array_equal(
        modes.displacement(x, y)[:, 2, :3], np.stack([np.ones(20), -x, y], axis=1)
    )
    np.testing.assert_array_equal(
        modes.displacement(x, y)[:, :, -3:], beam.displacement(x, y)[:, :, -3:]
    )
    np.testing.assert_allclose(modes.mass[-3:, -3:], beam.mass[-3:, -3:], rtol=1e-12, atol=1e-18)
    twisting = modes.torsion_mass
    np.testing.assert_allclose(
        twisting[-3:, -3:], beam.torsion_mass[-3:, -3:], rtol=1e-12, atol=1e-18
    )
    about_axis = strip.inertia_per_span * 0.14
    np.testing.assert_allclose(np.diag(twisting)[:3], [0.0, about_axis, 0.0], atol=1e-16)


@pytest.mark.parametrize("kind", list(Root))
@pytest.mark.parametrize("name", ["square", "delta", "L"])
def test_slopes_are_differences_of_displacements(name, kind):
    """Central differences of w at points anywhere inside."""
    planform = OUTLINES[name]
    modes = modes_of(planform, kind)
    x, y = random_points(planform, 200)
    step = 1e-6
    for axis, (dx, dy) in enumerate([(step, 0.0), (0.0, step)]):
        ahead, behind = (modes.displacement(x + s * dx, y + s * dy)[:, 2] for s in (1.0, -1.0))
        slopes = modes.slopes(x, y)[:, axis]
        error = np.abs((ahead - behind) / (2.0 * step) - slopes)
        assert error.max() < 1e-5 * np.abs(slopes).max()


def test_a_clamped_edge_stays_where_it_is_and_corners_can_be_asked_for():
    """Also a little outside of the outline, by round-off."""
    modes = modes_of(TRAPEZOID, Root.CLAMPED)
    first, last = TRAPEZOID.inboard_edge
    at = first + np.linspace(0.0, 1.0, 15)[:, None] * (last - first)
    for shift in (0.0, 1e-12, -1e-12):
        x, y = (at + shift).T
        assert np.abs(modes.displacement(x, y)).max() < 1e-9
        assert np.abs(modes.slopes(x, y)).max() < 1e-7
        corners = TRAPEZOID.array + shift
        inner = TRAPEZOID.array + 1e-6 * (TRAPEZOID.array.mean(axis=0) - TRAPEZOID.array)
        np.testing.assert_allclose(
            modes.displacement(*corners.T), modes.displacement(*inner.T), atol=1e-4
        )


def test_torsion_mass_of_slender_plates_is_all_mass_of_twisting_modes_and_none_of_bending():
    """Of a strip; the share of the rest is a few percent."""
    modes = modes_of(rectangle(0.3, 0.03, 0.5), Root.CLAMPED, 5, 0.5, poissons_ratio=0.0)
    share = np.diag(modes.torsion_mass) / np.diag(modes.mass)
    assert np.all((share < 1e-9) | ((share > 0.97) & (share < 1.0)))
    assert 0 < np.count_nonzero(share > 0.5) < 5


def test_section_motion_of_bending_modes_is_their_displacement():
    """nu = 0: the sections of a strip stay straight in bending."""
    modes = modes_of(rectangle(0.3, 0.03, 0.5), Root.CLAMPED, 1, 0.5, poissons_ratio=0.0)
    y = np.linspace(0.0, 0.3, 11)
    motion = modes.section_motion(y)
    np.testing.assert_allclose(motion.plunge, modes.displacement(0.01, y)[:, 2], atol=1e-7)
    np.testing.assert_allclose(motion.twist, 0.0, atol=1e-6)


def test_bad_requests_are_refused_before_anything_is_computed():
    """Too few modes, elements without size, elements too few for the modes."""
    plate = Plate(SQUARE, sheet(), 0.5)
    for count, kind in ((0, Root.CLAMPED), (3, Root.FREE)):
        with pytest.raises(InputError, match="must be at least"):
            plate_modes(plate, count, kind)
    with pytest.raises(InputError, match="greater than 0"):
        plate_modes(plate, 4, Root.FREE, size=0.0)
    with pytest.raises(ComputationError, match="too few"):
        plate_modes(plate, 60, Root.CLAMPED, size=0.1)


def test_modes_are_the_same_each_time_and_have_their_sign_fixed():
    """Of a free square, two of whose modes share a frequency."""
    first, second = (elastic_modes(SQUARE, sheet(), 6, False, 0.02) for _ in range(2))
    np.testing.assert_array_equal(first.coefficients, second.coefficients)
    modes = modes_of(SQUARE, Root.FREE)
    w = modes.displacement(*modes.elastic.points.T)[:, 2, 3:8]
    farthest = np.argmax(np.abs(w) > 0.999 * np.abs(w).max(axis=0), axis=0)
    assert np.all(w[farthest, np.arange(5)] > 0.0)
