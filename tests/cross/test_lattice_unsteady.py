"""The fast form of the unsteady lattice: against direct solutions, Theodorsen, and symmetries."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.unsteady import lattice_model
from foldwing.maths.bessel import theodorsen
from support.lattices import direct_forces, section_lattice, small, three_segment, unequal_chords

P = np.array([0.02j, 0.3j, 1.1 - 0.1j, 2.0j, 0.4 + 0.0j, -0.05 + 0.6j])


def worst(found, expected):
    """Largest difference relative to the largest entry."""
    return np.abs(found - expected).max() / np.abs(expected).max()


# ------------------------------------------------------------------------- against direct solutions

MESHES = {
    "folded": small(),
    "image": small(image=True),
    "relaxation": small(relaxation=0.9),
    "one panel": small(chordwise=1, wake=3.0),
    "one wake row": small(wake=1 / 3),
    "cosine": small(spacing="cosine"),
    "inset": small(spacing="inset"),
    "unequal chords": unequal_chords(),
    "unequal chords, image": unequal_chords(image=True, relaxation=0.5),
}


@pytest.mark.parametrize("mesh", MESHES)
def test_fast_form_equals_the_direct_solution(mesh):
    model, modes = MESHES[mesh]
    fast = model.lattice(modes).forces(P)
    for p, found in zip(P, fast, strict=True):
        assert worst(found, direct_forces(model, modes, p)) < 1e-12


def test_fast_form_equals_the_direct_solution_on_the_default_mesh():
    model, modes = three_segment()
    found = model.lattice(modes).forces(np.array([0.37j]))[0]
    assert worst(found, direct_forces(model, modes, 0.37j)) < 1e-13


@pytest.mark.parametrize(
    ("mesh", "scheme"),
    [
        *(("folded", scheme) for scheme in ("exact", "average", "literal", "printed")),
        ("relaxation", "average"),
        ("unequal chords, image", "exact"),
    ],
)
def test_derivative_is_that_of_the_forces(mesh, scheme):
    """By a central difference of fourth order."""
    model, modes = MESHES[mesh]
    model = replace(model, wing=model.wing.with_lattice(scheme=scheme))
    lattice, h = model.lattice(modes), 2e-4
    forces, slope = lattice.forces_with_derivative(P)
    shifted = [lattice.forces(P + n * h) for n in (-2, -1, 1, 2)]
    difference = (shifted[0] - 8 * shifted[1] + 8 * shifted[2] - shifted[3]) / (12 * h)
    assert worst(slope, difference) < 1e-9
    assert worst(forces, lattice.forces(P)) < 1e-14


def test_many_values_at_once_equal_one_at_a_time():
    model, modes = small()
    lattice, p = model.lattice(modes), 1j * np.geomspace(0.01, 2.0, 150)
    alone = np.concatenate([lattice.forces(p[i : i + 1]) for i in range(len(p))])
    assert worst(lattice.forces(p), alone) < 1e-13


def test_conjugate_motion_has_conjugate_forces():
    model, modes = small()
    lattice = model.lattice(modes)
    assert worst(lattice.forces(P.conj()), lattice.forces(P).conj()) < 1e-14


def test_steady_forces_are_the_limit_at_rest():
    model, modes = small()
    lattice = model.lattice(modes)
    assert worst(lattice.forces(np.array([1e-12 + 0j]))[0], lattice.steady_forces()) < 1e-10


def test_apparent_mass_is_the_limit_of_fast_growth():
    model, modes = small()
    lattice = model.lattice(modes)
    p = 1e5
    growing = -lattice.forces(np.array([p + 0j]))[0] / (p / model.half_chord) ** 2
    assert worst(growing, lattice.apparent_mass()) < 1e-4
    far = -lattice.forces(np.array([10 * p + 0j]))[0] / (10 * p / model.half_chord) ** 2
    assert worst(far, lattice.apparent_mass()) < worst(growing, lattice.apparent_mass()) / 5


# ---------------------------------------------------------------------------- two-dimensional flow


def theodorsen_section(k):
    """Lift and nose-up moment about mid-chord per plunge up and twist; everything else is 1."""
    p = 1j * k
    C = theodorsen(p)
    lift = [-np.pi * p**2 - 2 * np.pi * C * p, np.pi * p + 2 * np.pi * C * (1 + p / 2)]
    moment = [-np.pi * C * p, -np.pi * (p / 2 + p**2 / 8) + np.pi * C * (1 + p / 2)]
    return np.array([lift, moment])


def section_errors(chordwise, k, wake=1000.0):
    """Errors of lift and of moment, each relative to its largest coefficient."""
    found = section_lattice(chordwise, wake).forces(np.array([1j * k]))[0]
    expected = theodorsen_section(k)
    return np.abs(found - expected).max(axis=1) / np.abs(expected).max(axis=1)


@pytest.mark.parametrize(("k", "error"), [(0.1, 1e-3), (0.5, 6e-3), (1.0, 1.35e-2)])
def test_eight_panels_meet_theodorsen(k, error):
    assert section_errors(8, k).max() < error


def test_error_falls_with_the_square_of_the_panel():
    """In lift and moment at k = 1, from 4 to 16 panels: finer ones see the end of the wake."""
    panels = np.array([4, 8, 16])
    errors = np.array([section_errors(n, 1.0) for n in panels])
    order = -np.polyfit(np.log(panels), np.log(errors), 1)[0]
    assert (order > 1.85).all()


def test_printed_unsteady_load_is_of_first_order_only():
    panels = np.array([8, 16, 32])
    expected = theodorsen_section(0.5)
    errors = [
        worst(section_lattice(n, 200.0, "printed").forces(np.array([0.5j]))[0], expected)
        for n in panels
    ]
    order = -np.polyfit(np.log(panels), np.log(errors), 1)[0]
    assert 0.7 < order < 1.2


def test_a_wake_of_twenty_chords_costs_two_per_cent_at_low_frequency():
    """In two dimensions, where the influence of a vortex falls slowest."""
    assert 0.01 < section_errors(8, 0.1, wake=20.0).max() < 0.025
    assert section_errors(8, 0.1, wake=100.0).max() < 0.006


def test_apparent_mass_of_a_section_converges_to_the_exact_one():
    """pi for plunge and pi/8 for twist about mid-chord; of first order."""
    panels = np.array([32, 64, 128])
    masses = [np.diag(section_lattice(n, 2.0).apparent_mass()) for n in panels]
    errors = np.abs(np.array(masses) / [np.pi, np.pi / 8] - 1)
    order = -np.polyfit(np.log(panels), np.log(errors), 1)[0]
    assert errors[-1].max() < 0.02
    assert (order > 0.8).all()


# -------------------------------------------------------------------------------------- symmetries


def forces_of(model, modes, strips, image=False, repeat=1):
    """Qhat at P of any strips that move as those of the model do, one or several times over."""
    lattice = model.wing.lattice
    motion, length = model.panel_motion(modes), model.load_lengths
    nc = lattice.chordwise

    def repeated(part):
        rows = part.reshape(nc, -1, *part.shape[1:])
        return np.concatenate([rows] * repeat, axis=1).reshape(-1, *part.shape[1:])

    motion = type(motion)(*(repeated(part) for part in motion))
    influence = Influence(strips, nc, round(lattice.wake * nc), image)
    arguments = repeated(length), model.wing.air.density, model.half_chord, lattice
    return lattice_model(influence, motion, *arguments).forces(P)


@settings(max_examples=20)
@given(st.floats(-3.1, 3.1), st.floats(-140.0, 140.0), st.floats(-140.0, 140.0))
def test_turning_the_whole_wing_about_the_stream_changes_nothing(angle, first, second):
    """Upright, upside down, anyhow; folds of any size."""
    model, modes = small((round(first, 1), round(second, 1)))
    if model.warning(modes):
        return
    strips = model.strips(modes)
    turned = forces_of(model, modes, strips.turned(angle))
    assert worst(turned, forces_of(model, modes, strips)) < 1e-12


@pytest.mark.parametrize("angle", [0.5, 1.0, np.pi / 2, 2.0, 3.0, np.pi])
def test_turning_the_default_mesh_about_the_stream_changes_nothing(angle):
    model, modes = three_segment((30.0, -60.0))
    strips = model.strips(modes)
    assert worst(
        forces_of(model, modes, strips.turned(angle)), forces_of(model, modes, strips)
    ) < 1e-12  # fmt: skip


@pytest.mark.parametrize("folds", [(0.0, 0.0), (30.0, -75.0), (-120.0, 60.0)])
def test_image_equals_the_whole_symmetric_wing(folds):
    model, modes = small(folds)
    strips = model.strips(modes)
    whole = forces_of(model, modes, strips.joined(strips.mirrored()), repeat=2)
    assert worst(whole / 2, forces_of(model, modes, strips, image=True)) < 1e-12


def test_a_wing_and_its_mirror_image_have_equal_forces():
    model, modes = small()
    strips = model.strips(modes)
    assert worst(
        forces_of(model, modes, strips.mirrored()), forces_of(model, modes, strips)
    ) < 1e-13  # fmt: skip


def test_folding_by_zero_equals_a_flat_wing():
    """The strips of three level segments, and of one segment as long as all three."""
    model, modes = small((0.0, 0.0), spanwise=15)
    y = np.linspace(0.0, 0.30, 16)
    line = np.column_stack([y, np.zeros(16)])
    flat = replace(model.strips(modes), inner=line[:-1], outer=line[1:])
    assert worst(forces_of(model, modes, flat), model.lattice(modes).forces(P)) < 1e-12


def test_order_of_segments_with_unequal_chords_does_not_matter():
    """Strips of one chord are handled together, wherever they stand."""
    model, modes = unequal_chords()
    strips, nc = model.strips(modes), model.wing.lattice.chordwise
    order = np.random.default_rng(1).permutation(strips.count)
    fields = ("inner", "outer", "leading", "chord", "segment")
    shuffled = type(strips)(*(getattr(strips, name)[order] for name in fields))

    def rows(part):
        return part.reshape(nc, -1, *part.shape[1:])[:, order].reshape(part.shape)

    motion = model.panel_motion(modes)
    model_of = lattice_model(
        Influence(shuffled, nc, round(4 * nc)),
        type(motion)(*map(rows, motion)),
        rows(model.load_lengths),
        model.wing.air.density,
        model.half_chord,
        model.wing.lattice,
    )
    assert worst(model_of.forces(P), model.lattice(modes).forces(P)) < 1e-13
