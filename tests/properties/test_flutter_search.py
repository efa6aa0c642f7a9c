"""The sweep against tracked roots and plain counts, on random wings and random polynomials.

Evidence: every point must lie on a root followed in airspeed from still air, every crossing of such
a root must be a point, and a plain argument principle must count as many unstable roots as the
points imply, where a stable root comes nearest to instability. FOLDWING_RANDOM_WINGS=2000 examines
that many wings.
"""

import os
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.stability import sweep as sweep_module
from foldwing.stability.flutter import find_flutter
from foldwing.stability.newton import roots_at
from foldwing.stability.status import Status
from foldwing.stability.tracking import advance, branches_at, track
from foldwing.studies.case import solve_case
from foldwing.studies.speeds import speed_range
from support.random_wings import random_wing
from support.stability import Polynomials, UnstableRoots, of_kind, unstable_by

WINGS = int(os.environ.get("FOLDWING_RANDOM_WINGS", "200"))
LATTICES = WINGS // 5
CHUNK = 20
SPEEDS = 61
COUNTS = 3


@cache
def prepared(seed, aerodynamics="strip"):
    """A random wing, its system and its range of airspeeds."""
    wing = random_wing(np.random.default_rng(seed)).with_lattice(chordwise=4, spanwise=12)
    model = AeroelasticWing(wing, aerodynamics)
    return model, model.system(model.modes()), speed_range(model)


@pytest.mark.parametrize("first", range(0, WINGS, CHUNK))
def test_random_wings(first):
    complaints = []
    for seed in range(first, min(first + CHUNK, WINGS)):
        complaints += [f"wing {seed}: {complaint}" for complaint in examined(seed)]
        prepared.cache_clear()
    assert complaints == []


@pytest.mark.parametrize("first", range(0, LATTICES, CHUNK))
def test_random_wings_in_the_lattice(first):
    """Any number of segments, equal chords or not, folded anyhow but not onto themselves."""
    complaints, uncertified = [], []
    for seed in range(first, min(first + CHUNK, LATTICES)):
        model, system, limits = prepared(seed, "lattice")
        if model.warning(model.modes()):
            continue
        complaints += [f"wing {seed}: {complaint}" for complaint in examined(seed, "lattice")]
        uncertified += [] if find_flutter(system, limits).certified else [seed]
        prepared.cache_clear()
    assert complaints == []
    assert uncertified == []


def examined(seed, aerodynamics="strip"):
    """Everything in which the sweep differs from the tracked roots and the counts."""
    _, system, limits = prepared(seed, aerodynamics)
    analysis = find_flutter(system, limits)
    flutter = of_kind(analysis, "flutter")
    at = np.array([point.speed for point in flutter])
    speeds = np.unique(np.concatenate([np.linspace(*limits, SPEEDS), at]))
    loci = track(system, speeds)
    points = {float(point.speed): point for point in flutter}
    return [
        *points_off_the_loci(system, limits[0], loci, points),
        *crossings_that_are_no_points(system, loci, points),
        *wrong_counts(system, analysis, loci),
    ]


def points_off_the_loci(system, lowest, loci, points):
    """Points on no branch from rest must lie on a pair that was real at a lower airspeed."""
    for speed, point in points.items():
        row = int(np.flatnonzero(loci.speed == speed)[0])
        expected = point.p * speed / system.half_chord
        if np.nanmin(np.abs(loci.eigenvalue[row] / expected - 1)) < 1e-6:
            continue
        root = roots_at(system, np.array([point.p]), np.array([speed]))
        start = advance(system, branches_at(system, root), lowest)
        if is_of_the_wake(system, start):
            continue
        origin = start.status[0]
        if origin != Status.LEFT_DOMAIN:
            yield f"the point at {speed} is on no branch and ends {Status(origin).name} below"
        if not (loci.status[row] == Status.LEFT_DOMAIN).any():
            yield f"the point at {speed} is on no branch, and none has become real"


def is_of_the_wake(system, branch):
    """A root that keeps its reduced frequency, well damped, down to rest: it is one of the air."""
    p = branch.eigenvalue[0] * system.half_chord / branch.speed[0]
    return branch.status[0] == Status.OK and p.real < -0.1 and abs(p) < 1.0


def crossings_that_are_no_points(system, loci, points):
    """Branches change the sign of Re lambda at points, and in the direction of their event."""
    growth = loci.eigenvalue.real
    near = np.abs(growth) < 1e-9 * np.abs(loci.eigenvalue)
    sign = np.where(near, 0.0, np.sign(growth))
    for j in range(sign.shape[1]):
        rows = np.flatnonzero(np.isfinite(sign[:, j]) & (sign[:, j] != 0))
        for i, k in pairwise(rows):
            if sign[i, j] * sign[k, j] > 0:
                continue
            between = [points.get(float(speed)) for speed in loci.speed[i + 1 : k]]
            events = [point.event for point in between if point is not None]
            if events != ["onset" if sign[k, j] > 0 else "recovery"]:
                yield f"branch {j} crosses from {loci.speed[i]} to {loci.speed[k]}: {events}"


def wrong_counts(system, analysis, loci):
    """`certified` must say what an independent count says."""
    slow, fast = analysis.speed_range
    highest = analysis.sweep.region.highest
    plain = UnstableRoots(system, min(1.5 * highest, max(highest, system.highest_frequency)))
    lowest = plain.at(slow)
    speeds = [*nearest_misses(loci), (slow * fast) ** 0.5, fast * 0.999][:COUNTS]
    right = all(plain.at(U) == unstable_by(analysis.points, U, lowest) for U in speeds)
    if right != analysis.certified:
        yield f"certified is {analysis.certified}, but the counts are {right} at {speeds}"


def nearest_misses(loci):
    """Airspeeds at which a stable branch comes near to instability and turns back."""
    damping = -loci.eigenvalue.real / np.abs(loci.eigenvalue)
    with np.errstate(invalid="ignore"):
        dip = (damping[1:-1] < damping[:-2]) & (damping[1:-1] < damping[2:]) & (damping[1:-1] > 0)
        dip[np.any(np.abs(damping[1:-1]) < 1e-9, axis=1)] = False  # at points no count is defined
    rows, columns = np.nonzero(dip)
    order = np.argsort(damping[rows + 1, columns])
    return loci.speed[rows[order] + 1].tolist()[: COUNTS - 1]


@pytest.mark.parametrize("seed", [1, 4, 14, 15, 32, 45])
def test_a_case_that_lacks_a_crossing_is_not_certified(seed, monkeypatch):
    model, system, limits = prepared(seed)
    folds = tuple(np.degrees(model.wing.fold_angles))
    found = len(of_kind(find_flutter(system, limits), "flutter"))
    assert solve_case(model, folds, limits).status is Status.OK
    assert found > 0
    whole = sweep_module.flutter_roots
    for missing in range(found):

        def without(*arguments, index=missing):
            roots, path = whole(*arguments)
            return roots.take(np.delete(np.arange(len(roots.p)), index)), path

        monkeypatch.setattr(sweep_module, "flutter_roots", without)
        case = solve_case(model, folds, limits)
        assert not case.analysis.certificate.certified
        assert not case.analysis.certified
        assert case.status is Status.UNCERTIFIED
        assert len(of_kind(case.analysis, "flutter")) == found - 1


@pytest.mark.parametrize("seed", [32, 805])
def test_humps_beside_each_other(seed):
    """Wings whose branches touch the stability boundary: counted on a fine grid of airspeeds."""
    _, system, limits = prepared(seed)
    analysis = find_flutter(system, limits)
    assert analysis.certified
    events = [point.event for point in of_kind(analysis, "flutter")]
    assert events.count("recovery") == 1
    plain = UnstableRoots(system, 1.5 * analysis.sweep.region.highest)
    lowest = plain.at(limits[0])
    for speed in np.linspace(limits[0], limits[1], 50)[1:]:
        assert plain.at(speed) == unstable_by(analysis.points, speed, lowest)


SPEED_RANGE = (0.5, 5.0)
COEFFICIENT = st.floats(0.001, 0.3).flatmap(lambda x: st.sampled_from([x, -x]))
OSCILLATOR = st.tuples(  # d, c, m, g
    st.floats(0.05, 1.0), COEFFICIENT, st.floats(0.5, 2.0), COEFFICIENT
)


def neutral_points(oscillators):
    """1 + U g p + U^2 (d + c p + m p^2) = 0 has purely imaginary roots at U = -g/c only."""
    points = []
    for d, c, m, g in oscillators:
        U = -g / c
        if SPEED_RANGE[0] < U < SPEED_RANGE[1]:
            points.append((U, ((d + U**-2) / m) ** 0.5, "onset" if c < 0 else "recovery"))
    return sorted(points)


@settings(max_examples=60)
@given(st.lists(OSCILLATOR, min_size=2, max_size=3))
def test_oscillators_flutter_where_their_damping_vanishes(oscillators):
    expected = neutral_points(oscillators)
    at = np.array([U for U, *_ in expected])
    edges = np.concatenate([SPEED_RANGE, at])
    assume(np.diff(np.sort(edges)).min() > 1e-3)
    d, c, m, g = zip(*oscillators, strict=True)
    analysis = find_flutter(Polynomials(tuple(zip(d, c, m, strict=True)), g), SPEED_RANGE)
    points = of_kind(analysis, "flutter")
    assert analysis.certified
    assert [point.event for point in points] == [event for *_, event in expected]
    np.testing.assert_allclose([point.speed for point in points], at, rtol=1e-9)
    k = [k for _, k, _ in expected]
    np.testing.assert_allclose([point.p.imag for point in points], k, rtol=1e-9)
