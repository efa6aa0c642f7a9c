"""The closed forms of a horseshoe's velocity against the integral and against each other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from foldwing.aerodynamics.horseshoe import Edges, induced_velocity, streamwise_wash

COORDINATE = st.floats(-2.0, 2.0).map(lambda value: round(value, 3))
PLACE = st.tuples(COORDINATE, COORDINATE)


def integrated(point, start, end):
    """Law of Biot and Savart along a straight vortex of unit circulation, by quadrature."""
    along = end - start

    def integrand(s, axis):
        r = point - start - s * along
        return np.cross(along, r)[axis] / np.linalg.norm(r) ** 3 / (4 * np.pi)

    nearest = float(np.clip((point - start) @ along / (along @ along), 0.0, 1.0))
    options = {"epsabs": 1e-14, "epsrel": 1e-13, "limit": 400}
    return np.array(
        [
            quad(integrand, 0.0, nearest, args=(axis,), **options)[0]
            + quad(integrand, nearest, 1.0, args=(axis,), **options)[0]
            for axis in range(3)
        ]
    )


def integrated_leg(point, start):
    """The same from a point downstream to infinity, x = start + tan(angle)."""
    r0 = point - start

    def integrand(angle, axis):
        r = r0 - np.array([np.tan(angle), 0.0, 0.0])
        stretch = 1.0 / np.cos(angle) ** 2
        return np.cross([1.0, 0.0, 0.0], r)[axis] / np.linalg.norm(r) ** 3 * stretch / (4 * np.pi)

    turn = np.arctan(max(r0[0], 0.0))
    options = {"epsabs": 1e-14, "epsrel": 1e-13, "limit": 400}
    return np.array(
        [
            quad(integrand, 0.0, turn, args=(axis,), **options)[0]
            + quad(integrand, turn, np.pi / 2, args=(axis,), **options)[0]
            for axis in range(3)
        ]
    )


CASES = [
    # point, A, B: beside, above, upstream, far, swept either way, folded upright
    ((0.3, 0.4, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    ((0.3, 0.4, 0.7), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    ((-0.8, 1.9, 0.1), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    ((6.0, 1.4, -0.3), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    ((0.2, 0.6, 0.1), (0.0, 0.0, 0.0), (0.5, 1.0, 0.2)),
    ((0.9, -0.3, 0.5), (0.7, 0.1, 0.0), (0.0, 1.0, -0.4)),
    ((0.1, 0.2, 0.3), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
]


@pytest.mark.parametrize(("point", "inner", "outer"), CASES)
def test_velocity_is_the_integral_along_the_three_vortices(point, inner, outer):
    point, inner, outer = (np.array(value, float) for value in (point, inner, outer))
    expected = integrated(point, inner, outer)
    expected += integrated_leg(point, outer) - integrated_leg(point, inner)
    found = induced_velocity(point[None], inner[None], outer[None])[0, 0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def in_space(x, places):
    return np.column_stack([np.broadcast_to(x, len(places)), places])


def both(xi, points, angles, inner, outer):
    """Normal wash by the form for bound vortices across the stream, and by the general one."""
    points, inner, outer = (np.array(value, float) for value in (points, inner, outer))
    normals = np.column_stack([-np.sin(angles), np.cos(angles)])
    fast = streamwise_wash(np.asarray(xi), points, normals, Edges(inner, outer))
    slow = [
        np.einsum(
            "rsi,ri->rs",
            induced_velocity(in_space(x, points), in_space(0.0, inner), in_space(0.0, outer)),
            np.column_stack([np.zeros(len(points)), normals]),
        )
        for x in xi
    ]
    return fast, np.array(slow)


@given(
    st.lists(st.floats(-3.0, 3.0), min_size=1, max_size=4, unique=True),
    st.lists(PLACE, min_size=1, max_size=3),
    st.lists(st.tuples(PLACE, PLACE), min_size=1, max_size=3),
)
def test_form_across_the_stream_equals_the_general_form(xi, points, vortices):
    inner, outer = (np.array(ends, float) for ends in zip(*vortices, strict=True))
    clear = np.linalg.norm(outer - inner, axis=1) > 0.05
    if not clear.any():
        return
    places = np.array(points, float)[:, None]
    legs = np.stack([places - inner[clear], places - outer[clear]])
    if np.linalg.norm(legs, axis=3).min() < 1e-3:
        return
    angles = np.linspace(0.3, 5.0, len(points))
    fast, slow = both(np.sort(xi), points, angles, inner[clear], outer[clear])
    np.testing.assert_allclose(fast, slow, rtol=0, atol=1e-12 * np.abs(slow).max() + 1e-15)


def test_forms_agree_on_the_mesh_of_a_folded_wing():
    """From the panel beside its own vortex to a wake of two hundred panels."""
    y = np.linspace(0.0, 0.3, 7)
    line = np.column_stack([np.minimum(y, 0.15), np.maximum(y - 0.15, 0.0)])
    xi = (np.arange(-200, 9) + 0.5) * 0.006
    middle = (line[1:] + line[:-1]) / 2
    fast, slow = both(xi, middle, np.repeat([0.0, np.pi / 2], 3), line[:-1], line[1:])
    np.testing.assert_allclose(fast, slow, rtol=0, atol=1e-12 * np.abs(slow).max())
    np.testing.assert_allclose(fast, slow, rtol=1e-9)


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9])
def test_point_almost_in_line_with_the_bound_vortex(distance):
    """Beyond its end the bound part fades with the distance along the stream."""
    fast, slow = both([-distance, distance], [(1.5, 0.0)], np.zeros(1), [(0.0, 0.0)], [(1.0, 0.0)])
    np.testing.assert_allclose(fast, slow, rtol=1e-12)
    legs = (1 / 0.5 - 1 / 1.5) / (4 * np.pi)
    np.testing.assert_allclose(fast[:, 0, 0], legs, rtol=3 * distance + 1e-12)


def test_point_on_the_vortex_itself_feels_nothing_of_it():
    ends = np.array([[0.0, 0.0, 0.0]]), np.array([[0.0, 1.0, 0.0]])
    on_bound = np.array([[0.0, 0.5, 0.0]])
    on_leg = np.array([[2.0, 1.0, 0.0]])
    assert np.isfinite(induced_velocity(np.vstack([on_bound, on_leg]), *ends)).all()
    wash = streamwise_wash(
        np.array([0.0]), np.array([[0.5, 0.0]]), np.array([[0.0, 1.0]]),
        Edges(np.array([[0.0, 0.0]]), np.array([[1.0, 0.0]])),
    )  # fmt: skip
    assert wash[0, 0, 0] == pytest.approx(-2 / 0.5 / (4 * np.pi))


def test_far_downstream_only_the_legs_are_left():
    """Two straight vortices of infinite length, 1/(2 pi r) each."""
    fast, _ = both([1e7], [(0.3, 0.2)], np.zeros(1), [(0.0, 0.0)], [(1.0, 0.0)])
    from_b = -0.7 / (0.7**2 + 0.2**2)
    from_a = -0.3 / (0.3**2 + 0.2**2)
    assert fast[0, 0, 0] == pytest.approx((from_b + from_a) / (2 * np.pi), rel=1e-12)


def printed_kernel(x, y, z, half, corrected):
    """Components of I. Wang, PhD dissertation, Duke University, 2013, eqs. (3.3) to (3.5)."""
    left, right = y - half, y + half
    to_b, to_a = np.sqrt(x**2 + left**2 + z**2), np.sqrt(x**2 + right**2 + z**2)
    bound = (left / to_b - right / to_a) / (x**2 + z**2)
    leg_b, leg_a = (1 + x / to_b) / (left**2 + z**2), (1 + x / to_a) / (right**2 + z**2)
    legs = left * leg_b - right * leg_a if corrected else left * leg_a - right * leg_b
    return np.array([-z * bound, z * (leg_a - leg_b), x * bound + legs]) / (4 * np.pi)


@pytest.mark.parametrize("point", [(0.3, 0.4, 0.7), (-0.4, 0.2, -0.3), (2.0, 1.5, 0.1)])
def test_dissertation_s_kernel_holds_with_two_numerators_swapped(point):
    """Eq. (3.5) as printed gives another normal velocity."""
    ends = np.array([[0.0, -0.5, 0.0]]), np.array([[0.0, 0.5, 0.0]])
    found = induced_velocity(np.array([point]), *ends)[0, 0]
    np.testing.assert_allclose(found, printed_kernel(*point, 0.5, True), rtol=0, atol=1e-14)
    assert abs(found[2] / printed_kernel(*point, 0.5, False)[2] - 1) > 0.1
