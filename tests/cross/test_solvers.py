"""The same flutter points by five methods that share no search: sweep, loci, p-k, V-g, contours.

Evidence: each method looks for the points in its own way (over k, over the airspeed, with its own
iteration, with artificial damping, over the plane of lambda), and each agrees to its own accuracy.
"""

from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq

from foldwing.stability.contours import contour_roots, determinant_map
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import roots_at
from foldwing.stability.pk import pk, pk_flutter
from foldwing.stability.status import Status
from foldwing.stability.tracking import branches_at, record, track
from foldwing.stability.vg import vg, vg_flutter
from support.stability import example_modes, example_wing, of_kind

MODES = 6
CASES = {  # wing and folds, highest airspeed, number of flutter points below it
    "goland": (("goland",), 500.0, 2),
    "hale": (("hale",), 70.0, 1),
    "hump": (("three-segment", 30, -60), 50.0, 3),
    "level tip": (("three-segment", 85, -85), 70.0, 2),
}
EVERY = pytest.mark.parametrize("name", CASES)


@cache
def by_sweep(name):
    """System, highest airspeed and the oscillating flutter points of the sweep."""
    case, top, number = CASES[name]
    modes = example_modes(*case).only(np.arange(MODES))
    problem = example_wing(case[0]).system(modes)
    points = of_kind(find_flutter(problem, (top / 150, top)), "flutter")
    assert len(points) == number
    return problem, top, points


def agree(crossing, point, accuracy):
    assert crossing.event == point.event
    assert crossing.speed == pytest.approx(point.speed, rel=accuracy)
    assert crossing.frequency == pytest.approx(point.frequency, rel=accuracy)
    assert crossing.reduced_frequency == pytest.approx(point.p.imag, rel=2 * accuracy)


def brackets(problem, top, count=120):
    """Neighbouring airspeeds between which a tracked branch crosses, and the lower eigenvalue."""
    loci = track(problem, np.linspace(0.0, top, count + 1)[1:])
    assert set(np.unique(loci.status)) <= {Status.OK, Status.LEFT_DOMAIN}
    sign = np.sign(loci.eigenvalue.real)
    rows, columns = np.nonzero(sign[:-1] * sign[1:] < 0)
    for i, j in sorted(zip(rows.tolist(), columns.tolist(), strict=True)):
        event = "onset" if sign[i, j] < 0 else "recovery"
        yield event, loci.speed[i], loci.speed[i + 1], loci.eigenvalue[i, j]


def branch_at(problem, speed, eigenvalue):
    """The branch that passes through a root at an airspeed."""
    p = np.array([eigenvalue * problem.half_chord / speed])
    return branches_at(problem, roots_at(problem, p, np.array([speed])))


@EVERY
def test_tracked_crossings(name):
    problem, top, points = by_sweep(name)
    crossings = list(brackets(problem, top))
    assert [event for event, *_ in crossings] == [point.event for point in points]
    for (_, below, above, eigenvalue), point in zip(crossings, points, strict=True):
        start = branch_at(problem, below, eigenvalue)

        def growth(speed, start=start):
            return float(record(problem, start, np.array([speed])).eigenvalue[0, 0].real)

        speed = brentq(growth, below * (1 + 1e-9), above, xtol=1e-12 * above)
        assert speed == pytest.approx(point.speed, rel=1e-9)
        value = record(problem, start, np.array([speed])).eigenvalue[0, 0]
        assert value.imag / (2 * np.pi) == pytest.approx(point.frequency, rel=1e-9)


@EVERY
def test_p_k(name):
    problem, top, points = by_sweep(name)
    result = pk(problem, np.linspace(top / 60, top, 60))
    crossings = pk_flutter(problem, result, accuracy=1e-10)
    assert len(crossings) == len(points)
    for crossing, point in zip(crossings, points, strict=True):
        agree(crossing, point, 1e-6)
        assert crossing.accuracy < 1e-6 * point.speed


@EVERY
def test_v_g(name):
    """Interpolated between points of k, finer and finer: the error is what it says it is."""
    problem, top, points = by_sweep(name)
    k = np.geomspace(0.8 * min(p.p.imag for p in points), 1.25 * max(p.p.imag for p in points), 800)
    crossings = [c for c in vg_flutter(vg(problem, k)) if c.speed < top]
    assert len(crossings) == len(points)
    for crossing, point in zip(crossings, points, strict=True):
        agree(crossing, point, 1e-5)
        assert abs(crossing.speed - point.speed) <= crossing.accuracy


@EVERY
def test_determinant_contours(name):
    """At the flutter speed a root lies on the imaginary axis, to the square of the grid."""
    problem, _, points = by_sweep(name)
    for point in points:
        omega = 2 * np.pi * point.frequency
        errors = []
        for cells in (40, 80):
            # the root stands at the same place of a cell of either grid
            growth = omega * (np.arange(cells + 1) - 0.3 - cells // 2) * 0.4 / cells
            frequency = omega * (1 + (np.arange(cells + 1) - 0.4 - cells // 2) * 0.4 / cells)
            roots = contour_roots(determinant_map(problem, point.speed, growth, frequency))
            errors.append(np.abs(roots / (1j * omega) - 1).min())
        assert errors[0] < 2e-3
        assert errors[1] < errors[0] / 2.5


@EVERY
def test_p_k_has_the_mode_shape_of_the_sweep(name):
    problem, _, points = by_sweep(name)
    for point in points:
        result = pk(problem, np.linspace(point.speed / 40, point.speed, 40))
        distance = np.abs(result.eigenvalues[-1] / (2j * np.pi * point.frequency) - 1)
        j = int(np.nanargmin(distance))
        assert distance[j] < 1e-6
        likeness = abs(np.vdot(result.vectors[-1][:, j], point.vector)) ** 2
        assert likeness == pytest.approx(1.0, abs=1e-8)
