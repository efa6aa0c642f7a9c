"""The fast lattice against the slow one: every vortex in space, every row of the wake."""

import numpy as np
import pytest

from foldwing.aerodynamics.horseshoe import Edges, induced_velocity, streamwise_wash
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.maths.skeleton import skeleton
from foldwing.model import read_model

P = np.array([0.3j, 2.0j, 0.05 + 0j, 0.4 + 1.0j, -0.1 + 0.7j])


def lattice_case(folds, chords=(1.0, 1.0, 1.0), gap=0.0, **lattice):
    """The three-segment wing, with chords changed by factors, and its modes."""
    wing = read_model("three-segment")
    update = {
        "lattice": wing.lattice.model_copy(update={"chordwise": 4, "spanwise": 12} | lattice),
        "hinges": tuple(hinge.model_copy(update={"gap": gap}) for hinge in wing.hinges),
        "segments": tuple(
            segment.model_copy(update={"chord": factor * segment.chord})
            for segment, factor in zip(wing.segments, chords, strict=True)
        ),
    }
    model = AeroelasticWing(wing.model_copy(update=update), "lattice")
    return model, model.modes(tuple(np.radians(folds)))


@pytest.mark.parametrize("gap", [0.0, 2e-3])
@pytest.mark.parametrize("backwards", [False, True])
def test_wash_is_the_normal_velocity_of_horseshoes_in_space(gap, backwards):
    model, modes = lattice_case((30, -75), gap=gap)
    strips = model.strips(modes)
    order = slice(None, None, -1 if backwards else 1)
    edges = Edges(strips.inner[order], strips.outer[order])
    xi = np.array([-1.0, -0.04, -1e-4, 0.0, 1e-3, 0.03, 0.5])
    wash = streamwise_wash(xi, strips.middle, strips.normal, edges)
    ends = (np.pad(end, ((0, 0), (1, 0))) for end in edges)
    points = np.concatenate([np.insert(strips.middle, 0, x, axis=1) for x in xi])
    velocity = induced_velocity(points, *ends).reshape(len(xi), strips.count, -1, 3)
    normal = np.einsum("qrsi,ri->qrs", velocity[..., 1:], strips.normal)
    scale = np.abs(normal).max(axis=(1, 2), keepdims=True)
    np.testing.assert_allclose(wash / scale, normal / scale, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("folds", "options"),
    [
        ((30, -75), {}),
        ((120, -120), {"image": True, "relaxation": 0.8}),
        ((40, -70), {"chords": (1.0, 0.8, 0.8), "wake": 8.0}),
        ((90, 10), {"gap": 1e-3, "wake": 2.0}),
    ],
)
def test_forces_are_those_of_every_row_of_the_wake(folds, options):
    model, modes = lattice_case(folds, **options)
    influence, motion, fast = (
        model.influence(modes),
        model.panel_motion(modes),
        model.lattice(modes),
    )
    chordwise, strips = influence.chordwise, influence.strips
    load = model.wing.air.density * np.tile(strips.width, chordwise)
    for p, Q in zip(P, fast.forces(P), strict=True):
        A = influence.wing.astype(complex)
        for group, members in enumerate(influence.groups):
            columns = np.arange(chordwise)[:, None] * strips.count + members
            z = np.exp(-p * influence.step(group) / model.half_chord)
            rows = list(influence.wake_rows(group))
            for j, A_j in enumerate(rows):
                omega = z ** (j + 1) - z**j
                if j == len(rows) - 1:
                    omega /= 1.0 - model.wing.lattice.relaxation * z
                A[:, columns.ravel()] += np.tile(omega * A_j, chordwise)
        r = p / model.half_chord
        g = np.linalg.solve(A, motion.slope + r * motion.collocation)
        lengths = (load * model.load_lengths)[:, None]
        direct = motion.vortex.T @ (load[:, None] * g) + r * motion.load.T @ (lengths * g)
        np.testing.assert_allclose(Q, direct, rtol=0, atol=1e-13 * np.abs(direct).max())


def test_many_values_are_those_of_one_at_a_time():
    """More values than one block holds."""
    model, modes = lattice_case((30, -75))
    fast, p = model.lattice(modes), 0.05 + 1j * np.linspace(0.1, 3.0, 300)
    Q, dQ = fast.forces_with_derivative(p)
    for index in (0, 150, 299):
        alone = fast.forces_with_derivative(p[index : index + 1])
        for part, single in zip((Q, dQ), alone, strict=True):
            size = np.abs(single).max()
            np.testing.assert_allclose(part[index], single[0], rtol=0, atol=1e-13 * size)
        np.testing.assert_allclose(
            dQ[index], alone[1][0], rtol=0, atol=1e-13 * abs(dQ[index]).max()
        )
    assert np.abs(fast.forces(p) - Q).max() < 1e-13 * np.abs(Q).max()


def test_few_rows_stand_for_a_long_wake():
    model, modes = lattice_case((30, -75), wake=60.0)
    wake = model.influence(modes).wake_skeleton(0)
    assert len(wake.weights) == 240
    assert len(wake.rows) < 40


def test_rows_that_have_nothing_in_common_all_stand_for_themselves():
    matrix = np.random.default_rng(1).standard_normal((150, 400))
    found = skeleton(lambda count: matrix[:, :count], 150)
    assert sorted(found.rows) == list(range(150))
    np.testing.assert_allclose(found.weights @ matrix[found.rows], matrix, atol=1e-12)


def test_skeleton_of_smooth_rows_holds_the_small_ones_too():
    """Rows of very different size, each met to round-off of its own size."""
    x, y = np.linspace(0.0, 1.0, 200)[:, None], np.linspace(0.0, 3.0, 90)
    matrix = np.exp(-30.0 * x) / (1.0 + x + y)
    mix = np.random.default_rng(2).standard_normal((90, 90))
    found = skeleton(lambda count: matrix @ mix[:, :count], 200)
    error = np.abs(found.weights @ matrix[found.rows] - matrix).max(axis=1)
    assert len(found.rows) < 20
    assert (error / np.abs(matrix).max(axis=1)).max() < 1e-12
