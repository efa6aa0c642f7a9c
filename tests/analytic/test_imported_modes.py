"""Component modes from mode sets: exact limits, what is left out, and what is doubted."""

from dataclasses import replace

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.model.planform import rectangle, trapezoid
from foldwing.structure.component import Root
from foldwing.structure.imported import imported_modes
from foldwing.structure.mode_files import Placement
from foldwing.structure.rigid_properties import RigidProperties, area_rule, uniform_sheet
from support.mode_sets import beam, beam_mode_set, body, grid, mode_set, on_points, only, outline

KITE = trapezoid((0.12, 0.05), 0.3, 0.4, sweep=0.3, flares=(0.2, -0.1))


def free(modes=None, **options):
    modes = beam_mode_set(Root.FREE) if modes is None else modes
    return imported_modes(modes, outline(), 0.5, body(), Root.FREE, **options)


def clamped(modes=None, **options):
    modes = beam_mode_set(Root.CLAMPED) if modes is None else modes
    return imported_modes(modes, outline(), 0.5, body(), Root.CLAMPED, **options)


def about(modes, words):
    return [text for text in modes.warnings if words in text]


def test_moments_of_a_rectangle_and_of_a_triangle_are_those_of_the_textbook() -> None:
    sheet = uniform_sheet(rectangle(0.6, 0.2, 0.25), 3.0)
    m = 3.0 * 0.12
    assert sheet.mass == pytest.approx(m)
    assert sheet.centre == pytest.approx((0.05, 0.3))
    assert sheet.Ixx == pytest.approx(m * 0.6**2 / 3)
    assert sheet.Iyy == pytest.approx(m * (0.2**2 / 12 + 0.05**2))
    assert sheet.Ixy == pytest.approx(m * 0.05 * 0.3)


@pytest.mark.parametrize("planform", [KITE, rectangle(0.3, 0.1, 0.0)])
def test_area_rule_agrees_with_the_area_and_is_exact_for_its_degree(planform) -> None:
    points, weights = area_rule(planform, 2)
    assert weights.sum() == pytest.approx(planform.area, rel=1e-13)
    fine_points, fine = area_rule(planform, 9)
    for power in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2)):
        rough = weights @ np.prod(points**power, axis=1)
        assert rough == pytest.approx(fine @ np.prod(fine_points**power, axis=1), rel=1e-12)


def test_a_body_that_cannot_be_is_refused() -> None:
    RigidProperties(2.0, (0.1, 0.2), 0.09, 0.03, 0.04)
    for wrong in (
        (0.0, (0.1, 0.2), 0.09, 0.03, 0.04),
        (2.0, (0.1, 0.2), 0.07, 0.03, 0.04),
        (2.0, (0.1, np.nan), 0.09, 0.03, 0.04),
    ):
        with pytest.raises(InputError, match="body"):
            RigidProperties(*wrong)


def test_a_free_segment_has_the_rigid_motions_and_masses_of_its_body() -> None:
    modes, reference = free(), beam(Root.FREE)
    assert modes.count == 3 + 7 + 3
    assert modes.rigid_left_out == 3
    x, y = np.array([-0.03, 0.02]), np.array([0.0, 0.27])
    u = modes.displacement(x, y)
    assert u[:, 2, :3] == pytest.approx(np.column_stack([[1, 1], y, -x]), abs=1e-15)
    assert u[:, :, -3:] == pytest.approx(reference.displacement(x, y)[:, :, -3:], abs=1e-15)
    assert modes.mass[-3:, -3:] == pytest.approx(reference.mass[-3:, -3:], rel=1e-12, abs=1e-15)
    rigid = modes.mass[:3, :3]
    m, L = 0.09 * 0.3, 0.3
    expected = [[m, m * L / 2, 0], [m * L / 2, m * L**2 / 3, 0], [0, 0, m * 0.1**2 / 12]]
    assert rigid == pytest.approx(np.array(expected), abs=1e-15)
    assert not modes.mass[:3, 3:].any()
    assert not modes.stiffness[:3].any()


def test_elastic_modes_keep_modal_mass_frequency_and_shape() -> None:
    given = beam_mode_set(Root.FREE)
    given = replace(given, modal_mass=np.arange(1.0, 11.0))
    modes, e = free(given), slice(3, -3)
    assert np.diag(modes.mass)[e] == pytest.approx(np.arange(4.0, 11.0))
    omega2 = np.diag(modes.stiffness)[e] / np.diag(modes.mass)[e]
    assert np.sqrt(omega2) / (2 * np.pi) == pytest.approx(given.frequencies[3:])
    u = modes.displacement(given.points[:, 0], given.points[:, 1])[:, 2, e]
    assert u.T == pytest.approx(given.shapes[3:, :, 2], abs=1e-9 * np.abs(given.shapes).max())


@pytest.mark.parametrize("root", [Root.FREE, Root.CLAMPED])
def test_mass_centre_torsion_and_sections_are_those_of_the_beam(root) -> None:
    """Torsion and mass centre of natural modes, through a basis of functions that both share."""
    modes = free() if root is Root.FREE else clamped()
    reference, given = beam(root), beam_mode_set(root)
    x, y = given.points[:, :2].T
    u, v = (each.displacement(x, y).reshape(3 * len(x), -1) for each in (modes, reference))
    T = np.linalg.lstsq(v, u, rcond=None)[0]  # imported coordinates in those of the beam
    scale = np.abs(reference.mass_centre_motion @ T).max()
    assert modes.mass_centre_motion == pytest.approx(
        reference.mass_centre_motion @ T, abs=2e-3 * scale
    )
    torsion = T.T @ reference.torsion_mass @ T
    assert modes.torsion_mass == pytest.approx(torsion, abs=0.03 * np.abs(torsion).max())
    at = np.linspace(0.01, 0.29, 9)
    ours, theirs = modes.section_motion(at), reference.section_motion(at)
    for a, b in zip(ours, theirs, strict=True):
        assert a == pytest.approx(b @ T, abs=0.02 * np.abs(b @ T).max())


def test_sections_of_a_swept_segment_are_exact_for_rigid_motions() -> None:
    points = np.column_stack([KITE.point(*np.random.default_rng(0).random((2, 60))), np.zeros(60)])
    shape = np.zeros((1, 60, 3))
    shape[0, :, 2] = points[:, 1] ** 2
    given = mode_set([10.0], shape, points)
    modes = imported_modes(given, KITE, 0.3, uniform_sheet(KITE, 2.0), Root.FREE)
    y = np.array([0.02, 0.15, 0.29])
    plunge, twist = modes.section_motion(y)
    front, back = KITE.chord_ends(y)
    axis = front + 0.3 * (back - front)
    assert plunge[:, :3] == pytest.approx(np.column_stack([np.ones(3), y, -axis]), abs=1e-13)
    assert twist[:, :3] == pytest.approx(np.array([[0.0, 0.0, 1.0]] * 3), abs=1e-11)
    assert np.isnan(modes.section_motion(np.array([9.0])).twist[0, 2])


def test_rigid_masses_of_a_swept_segment_are_integrals_of_its_displacements() -> None:
    points = np.column_stack([KITE.point(*np.random.default_rng(0).random((2, 60))), np.zeros(60)])
    shape = np.zeros((1, 60, 3))
    shape[0, :, 2] = points[:, 1] ** 2
    given = mode_set([10.0], shape, points)
    modes = imported_modes(given, KITE, 0.3, uniform_sheet(KITE, 2.0), Root.FREE)
    at, weights = area_rule(KITE, 4)
    u = modes.displacement(*at.T)
    M, rigid = 2.0 * np.einsum("m,mai,maj->ij", weights, u, u), [0, 1, 2, 4, 5, 6]
    assert modes.mass[np.ix_(rigid, rigid)] == pytest.approx(M[np.ix_(rigid, rigid)], abs=1e-15)
    moved = 2.0 * np.einsum("m,mai->ai", weights, u)
    assert modes.mass_centre_motion[:, rigid] == pytest.approx(moved[:, rigid], abs=1e-15)
    mass, centre = modes.mass_and_centre
    assert mass * centre == pytest.approx(2.0 * weights @ at)


def test_slopes_are_those_of_finite_differences() -> None:
    modes, step = free(), 1e-6
    x, y = np.array([-0.031, 0.0, 0.047]), np.array([0.011, 0.15, 0.299])
    by_x = modes.displacement(x + step, y) - modes.displacement(x - step, y)
    by_y = modes.displacement(x, y + step) - modes.displacement(x, y - step)
    numeric = np.stack([by_x[:, 2], by_y[:, 2]], axis=1) / (2 * step)
    assert modes.slopes(x, y) == pytest.approx(numeric, abs=1e-6 * np.abs(numeric).max())


def test_count_takes_the_lowest_frequencies_in_any_order_of_the_file() -> None:
    given = beam_mode_set(Root.FREE)
    back = slice(None, None, -1)
    turned = replace(given, frequencies=given.frequencies[back], shapes=given.shapes[back])
    assert free(turned, count=2).frequencies == pytest.approx(given.frequencies[3:5])
    assert free(turned, count=2).modes == (7, 6)
    with pytest.raises(InputError, match=r"1 to 7.*3 are rigid"):
        free(given, count=8)


def test_modes_in_the_plane_are_left_out_and_small_parts_are_told() -> None:
    given = beam_mode_set(Root.CLAMPED)
    shapes = given.shapes.copy()
    shapes[1, :, 0], shapes[1, :, 2] = shapes[1, :, 2], 0.01
    shapes[2, :, 1] = 0.5 * shapes[2, :, 2]
    modes = clamped(replace(given, shapes=shapes))
    assert modes.modes == (1, 3, 4, 5, 6, 7, 8, 9, 10)
    assert about(modes, "modes 2 move mainly in the plane")
    assert modes.in_plane_share[1] == pytest.approx(0.25 / 1.25)
    assert about(modes, "mode 3 (20.0%)")


def test_rigid_modes_on_a_soft_support_are_left_out_and_named() -> None:
    given = beam_mode_set(Root.FREE)
    f = given.frequencies.copy()
    f[:3] = 0.1 * f[3], 1e-9, 1e-7
    modes = free(replace(given, frequencies=f))
    assert modes.rigid_left_out == 3
    assert about(modes, "modes 1 are rigid motions on a support, up to 0.1 of")
    assert not about(free(given), "support")


def test_a_mechanism_is_refused() -> None:
    given = beam_mode_set(Root.FREE)
    f = given.frequencies.copy()
    f[3] = 1e-6
    with pytest.raises(InputError, match=r"mode 4: frequency.*mechanism"):
        free(replace(given, frequencies=f))
    f = beam_mode_set(Root.CLAMPED).frequencies.copy()
    f[0] = 0.0
    with pytest.raises(InputError, match=r"mode 1: frequency.*Root\.FREE"):
        clamped(replace(beam_mode_set(Root.CLAMPED), frequencies=f))


def test_modes_of_a_free_segment_have_no_momentum() -> None:
    assert not about(free(), "rigid motion in a mode")
    given = beam_mode_set(Root.FREE)
    shapes = given.shapes.copy()
    mean_square = (shapes[3, :, 2] ** 2).mean()
    shapes[3, :, 2] += 0.25 * np.sqrt(mean_square)
    text = about(free(replace(given, shapes=shapes)), "rigid motion in a mode")
    share = float(text[0].split("(")[1].split("%")[0]) / 100
    assert share == pytest.approx(0.25 / np.hypot(1.0, 0.25), rel=0.1)


def test_clamped_modes_vanish_at_the_edge_and_free_ones_do_not() -> None:
    good = clamped()
    assert not about(good, "clamped edge")
    given = beam_mode_set(Root.FREE)
    wrong = only(given, slice(3, None))
    text = about(clamped(wrong), "displacement at the clamped edge")
    assert "mode" in text[0]
    assert "100.0%" in text[0]
    assert about(clamped(wrong), "slope on the elastic axis at the clamped edge")


def test_an_aircraft_s_root_is_refused() -> None:
    with pytest.raises(InputError, match=r"root.*beam or a plate"):
        imported_modes(beam_mode_set(Root.FREE), outline(), 0.5, body(), Root.CARRIAGE)


@pytest.mark.parametrize(
    ("factor", "words"),
    [
        (1e3, "look like mm: multiply length_unit by 0.001"),
        (39.37, "like in:"),
        (1e-5, "Placement"),
    ],
)
def test_points_in_another_unit_are_refused_with_the_likely_one(factor, words) -> None:
    given = beam_mode_set(Root.FREE)
    with pytest.raises(InputError, match=words):
        free(replace(given, points=given.points * factor))


def test_points_elsewhere_are_refused_and_a_placement_brings_them_home() -> None:
    given = beam_mode_set(Root.FREE)
    x, y, z = given.points.T
    away = replace(
        given,
        points=np.column_stack([2.0 + y, 1.0 - z, 3.0 - x]),
        shapes=given.shapes[:, :, [1, 2, 0]] * [1.0, -1.0, -1.0],
    )
    with pytest.raises(InputError, match=r"points far outside.*Placement"):
        free(away)
    placed = away.placed(Placement((2.0, 1.0, 3.0), (0, 0, -1), (2, 0, 0)))
    assert placed.points == pytest.approx(given.points, abs=1e-12)
    assert placed.shapes == pytest.approx(given.shapes, abs=1e-12)
    assert free(placed).mass == pytest.approx(free(given).mass)


def test_a_placement_scales_points_and_not_displacements() -> None:
    given = beam_mode_set(Root.FREE)
    small = replace(given, points=given.points / 4.0)
    assert small.placed(Placement(scale=4.0)).points == pytest.approx(given.points)
    assert small.placed(Placement(scale=4.0)).shapes == pytest.approx(given.shapes)
    for wrong in ({"x_axis": (0, 0, 0)}, {"x_axis": (1, 1, 0)}, {"scale": 0.0}):
        with pytest.raises(InputError, match="placement"):
            Placement(**wrong)
    with pytest.raises(InputError, match=r"placement\.origin"):
        Placement(origin=(0.0, np.inf, 0.0))


def test_a_line_of_points_bends_and_does_not_twist() -> None:
    bending = only(beam_mode_set(Root.CLAMPED), [0, 2])
    axis = np.flatnonzero(bending.points[:, 0] == 0.0)
    modes = clamped(on_points(bending, axis))
    assert about(modes, "torsion about it is not seen")
    assert np.abs(modes.section_motion(np.array([0.1, 0.2])).twist).max() < 1e-12
    away = np.flatnonzero(bending.points[:, 0] != 0.0)
    u = modes.displacement(*bending.points[away, :2].T)[:, 2].T
    expected = bending.shapes[:, away, 2]
    assert u == pytest.approx(expected, abs=1e-3 * np.abs(expected).max())
    with pytest.raises(InputError, match=r"smoothing.*0 for points on one line"):
        clamped(on_points(bending, axis), smoothing=0.01)


def test_noise_shows_in_the_error_and_smoothing_takes_it_away() -> None:
    given, rng = beam_mode_set(Root.CLAMPED, count=3), np.random.default_rng(4)
    rms = np.sqrt((given.shapes[:, :, 2] ** 2).mean(axis=1))[:, None]
    noise = np.zeros_like(given.shapes)
    noise[:, :, 2] = 0.1 * rms * rng.normal(size=noise.shape[:2])
    noisy = replace(given, shapes=given.shapes + noise)
    rough, smooth = clamped(noisy), clamped(noisy, smoothing=0.02)
    assert about(rough, "noise, or too few points")
    assert clamped(given).left_out_error.max() < 0.01
    x, y = np.random.default_rng(5).uniform((-0.05, 0.0), (0.05, 0.3), (300, 2)).T
    true = beam_mode_set(Root.CLAMPED, points=np.column_stack([x, y, 0 * x]), count=3).shapes[
        :, :, 2
    ]
    errors = [np.std(m.displacement(x, y)[:, 2].T - true) for m in (rough, smooth)]
    assert errors[1] < 0.7 * errors[0]
    assert smooth.left_out_error[0] < rough.left_out_error[0]


def test_points_above_each_other_become_one() -> None:
    given = beam_mode_set(Root.CLAMPED)
    skin = np.array([0.0, 0.0, 0.004])
    both = replace(
        given,
        points=np.concatenate([given.points + skin, given.points - skin]),
        shapes=np.concatenate([given.shapes, given.shapes], axis=1),
        names=tuple(str(i) for i in range(2 * len(given.points))),
    )
    modes = clamped(both)
    assert about(modes, "434 points lie in 217 places of the plane")
    x, y = np.array([0.013]), np.array([0.2])
    assert modes.displacement(x, y) == pytest.approx(clamped(given).displacement(x, y), rel=1e-9)


def test_more_points_than_a_surface_carries_are_thinned(monkeypatch) -> None:
    monkeypatch.setattr("foldwing.structure.imported_selection.MOST_NODES", 120)
    modes = clamped()
    assert about(modes, "of 217 points 120, spread evenly")
    x, y = grid()[:, :2].T
    full = beam_mode_set(Root.CLAMPED).shapes[:3, :, 2]
    u = modes.displacement(x, y)[:, 2, :3].T
    assert u == pytest.approx(full, abs=0.01 * np.abs(full).max())


def test_wrong_masses_sparse_points_and_like_shapes_are_told() -> None:
    given = beam_mode_set(Root.CLAMPED)
    assert not clamped(given).warnings
    heavy = clamped(replace(given, modal_mass=given.modal_mass * 1e3))
    ratio = float(about(heavy, "modal masses are")[0].split()[3])
    assert ratio == pytest.approx(1e3, rel=0.01)
    inner = grid()[grid()[:, 1] < 0.12]
    text = about(clamped(beam_mode_set(Root.CLAMPED, points=inner, count=2)), "enclose")
    assert "37%" in text[0]
    shapes = given.shapes.copy()
    shapes[1] = shapes[0] + 0.1 * shapes[1]
    assert about(clamped(replace(given, shapes=shapes)), "modes 1 and 2 are hard to tell apart")
    thick = replace(given, points=given.points + [[0, 0, 0.1]] * (np.arange(217) % 2)[:, None])
    assert about(clamped(thick), "0.1 m across the plane")


def test_wrong_arguments_are_refused() -> None:
    for options, words in (
        ({"smoothing": -1.0}, "smoothing"),
        ({"smoothing": np.nan}, "smoothing"),
        ({"count": 0}, "count of elastic modes"),
    ):
        with pytest.raises(InputError, match=words):
            free(**options)
    with pytest.raises(InputError, match="elastic_axis"):
        imported_modes(beam_mode_set(Root.FREE), outline(), 50.0, body(), Root.FREE)
    point = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.3]])
    shape = np.ones((1, 2, 3)) * [0.0, 0.0, 1.0]
    with pytest.raises(InputError, match="extent of the points"):
        clamped(mode_set([5.0], shape, point))
