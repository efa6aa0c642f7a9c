"""The mesh of the vortex lattice: strips, spacing, gaps, folds."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.aerodynamics.lattice import Strips, closeness, mesh_segments, strips_by_segment
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import Hinge, Segment, Wing, parse_model, read_model

THREE = read_model("three-segment")
ANGLE = st.floats(-170.0, 170.0).map(lambda value: round(value, 1))


def widths(wing):
    """Widths of the strips of each segment in mm."""
    return [1e3 * np.diff(mesh.edges) for mesh in mesh_segments(wing)]


def straight(span=1.0, **lattice):
    section = {"bending_stiffness": 1.0, "torsion_stiffness": 1.0, "mass_per_span": 1.0}
    segment = Segment(span=span, chord=0.1, inertia_per_span=0.1, **section)
    return Wing(segments=(segment,)).with_lattice(**lattice)


def lattice(wing, *folds):
    model = AeroelasticWing(wing, "lattice")
    modes = model.modes(tuple(np.radians(folds)))
    return model, modes, model.strips(modes)


def test_strips_are_shared_out_by_span():
    assert strips_by_segment(THREE) == (14, 10, 6)
    assert strips_by_segment(THREE.with_lattice(spanwise=[3, 4, 5])) == (3, 4, 5)
    assert strips_by_segment(THREE.with_lattice(spanwise=3)) == (1, 1, 1)


@given(st.integers(3, 200))
def test_every_strip_asked_for_is_there(count):
    counts = strips_by_segment(THREE.with_lattice(spanwise=count))
    assert sum(counts) == count
    assert min(counts) >= 1
    spans = np.array([segment.span for segment in THREE.segments])
    assert (np.abs(counts - count * spans / spans.sum()) <= 2.0).all()


def test_uniform_strips_cover_the_wing():
    np.testing.assert_allclose(np.concatenate(widths(THREE)), 10.0)


def test_cosine_spacing_is_dense_at_both_ends_of_a_segment():
    (found,) = widths(straight(spanwise=4, spacing="cosine"))
    edges = 500.0 * (1 - np.cos(np.radians([0, 45, 90, 135, 180])))
    np.testing.assert_allclose(found, np.diff(edges))


@pytest.mark.parametrize(("image", "quarters"), [(False, 2), (True, 1)])
def test_inset_lattice_ends_a_quarter_strip_before_free_edges(image, quarters):
    """Both ends of a wing in free air; a wall at the root closes one of them."""
    wing = straight(span=1.0, spanwise=8, spacing="inset", image=image)
    (mesh,) = mesh_segments(wing)
    (found,) = widths(wing)
    width = 1000.0 / (8 + quarters / 4)
    np.testing.assert_allclose(found, width)
    assert 1e3 * mesh.edges[0] == pytest.approx(0.0 if image else width / 4)
    assert 1e3 * mesh.edges[-1] == pytest.approx(1000.0 - width / 4)


def test_hinges_without_gap_are_no_free_edges():
    wing = THREE.with_lattice(spacing="inset", spanwise=[4, 4, 4], image=True)
    inner, middle, outer = mesh_segments(wing)
    assert inner.edges[[0, -1]] == pytest.approx([0.0, 0.14])
    assert middle.edges[[0, -1]] == pytest.approx([0.0, 0.10])
    assert outer.edges[0] == 0.0
    assert outer.edges[-1] == pytest.approx(0.06 * (1 - 0.25 / 4.25))


def test_gap_opens_half_on_either_side_and_is_refined():
    wing = THREE.with_gaps("2 mm").with_lattice(spanwise=[3, 3, 2], gap_refinement=2)
    inner, middle, outer = mesh_segments(wing)
    assert inner.edges[[0, -1]] == pytest.approx([0.0, 0.139])
    assert middle.edges[[0, -1]] == pytest.approx([0.001, 0.099])
    assert outer.edges[[0, -1]] == pytest.approx([0.001, 0.06])
    whole = 139.0 / 3
    np.testing.assert_allclose(widths(wing)[0], [whole, whole, whole / 2, whole / 4, whole / 4])
    assert [len(found) for found in widths(wing)] == [5, 7, 4]
    plain = wing.with_lattice(gap_refinement=0)
    assert [len(found) for found in widths(plain)] == [3, 3, 2]


@pytest.mark.parametrize(("refinement", "share"), [(1, [0.5, 0.5]), (2, [0.25, 0.25, 0.25, 0.25])])
def test_single_strip_between_two_gaps_is_refined_from_both_ends(refinement, share):
    wing = THREE.with_gaps("2 mm").with_lattice(spanwise=[1, 1, 1], gap_refinement=refinement)
    np.testing.assert_allclose(widths(wing)[1], 98.0 * np.array(share))


def test_panels_of_a_segment_lie_where_vortices_and_collocation_points_belong():
    (mesh,) = mesh_segments(straight(spanwise=2, chordwise=4))
    np.testing.assert_allclose(mesh.station(0.25), -0.05 + 0.1 * np.array([1, 5, 9, 13]) / 16)
    x, y = mesh.points(mesh.station(0.75))
    np.testing.assert_allclose(x, np.repeat(-0.05 + 0.1 * np.array([3, 7, 11, 15]) / 16, 2))
    np.testing.assert_allclose(y, np.tile([0.25, 0.75], 4))


@given(ANGLE, ANGLE)
def test_folding_keeps_widths_and_turns_normals(first, second):
    _, _, strips = lattice(THREE, first, second)
    np.testing.assert_allclose(strips.width, 0.01, rtol=1e-12)
    assert strips.area == pytest.approx(0.05 * 0.30, rel=1e-12)
    angles = np.radians(np.cumsum([0.0, first, second]))[strips.segment]
    np.testing.assert_allclose(
        strips.normal, np.column_stack([-np.sin(angles), np.cos(angles)]), atol=1e-12
    )
    same = strips.segment[1:] == strips.segment[:-1]
    gaps = np.linalg.norm(strips.inner[1:] - strips.outer[:-1], axis=1)
    assert gaps[same].max() < 1e-12 and gaps[~same].max() < 1e-12


def test_leading_edges_follow_the_elastic_axis():
    model = AeroelasticWing(read_model("goland"), "lattice")
    strips = model.strips(model.modes())
    np.testing.assert_allclose(strips.leading, -0.33 * 1.8288)
    np.testing.assert_allclose(strips.chord, 1.8288)


# --------------------------------------------------------------------------- what cannot be meshed


def test_closeness_is_the_distance_between_a_strip_and_its_neighbour():
    """Half a strip from the hinge, and the neighbour is turned by 170 degrees."""
    _, _, strips = lattice(THREE, 170.0, 0.0)
    near = closeness(strips)
    assert {near.segment, near.other} == {0, 1}
    assert near.distance == pytest.approx(0.005 * np.sin(np.radians(10.0)), rel=1e-9)
    assert near.ratio == pytest.approx(0.5 * np.sin(np.radians(10.0)), rel=1e-9)


@pytest.mark.parametrize("strips", [[2, 40, 2], [1, 900, 1], [5, 30, 5]])
@pytest.mark.parametrize("spacing", ["uniform", "cosine"])
def test_flat_wing_is_never_too_close_to_itself(strips, spacing):
    """However unlike the strips on either side of a hinge are."""
    wing = THREE.with_lattice(spanwise=strips, spacing=spacing, chordwise=1)
    model, modes, found = lattice(wing, 0.0, 0.0)
    assert closeness(found).ratio == pytest.approx(0.5)
    assert model.warning(modes) == ""


def test_narrow_and_wide_gaps_are_named():
    for gap, spacing, words in (
        ("1 mm", "uniform", "Gaps of hinges 2, 3 are narrower than the strips beside"),
        ("6 mm", "uniform", "Gaps of hinges 2, 3 are wider than 0.1 chords."),
        ("1 mm", "inset", ""),
        ("4 mm", "uniform", ""),
    ):
        model, modes, _ = lattice(THREE.with_gaps(gap).with_lattice(spacing=spacing), 0.0, 0.0)
        warning = model.warning(modes)
        assert warning.startswith(words) and bool(warning) == bool(words)


def test_closeness_finds_segments_that_are_no_neighbours():
    wing = THREE.with_lattice(spanwise=60)
    _, _, strips = lattice(wing, 90.0, 90.0)
    assert closeness(strips).ratio == pytest.approx(0.5)
    wide = Wing(
        segments=THREE.segments[:1] + THREE.segments[2:] + THREE.segments[:1],
        hinges=THREE.hinges,
    ).with_lattice(spanwise=[14, 6, 14])
    _, _, strips = lattice(wide, 90.0, 89.0)
    near = closeness(strips)
    assert {near.segment, near.other} != {0, 2}
    _, _, strips = lattice(wide, 90.0, 120.0)
    near = closeness(strips)
    assert {near.segment, near.other} == {0, 2}


@pytest.mark.parametrize("folds", [(180.0, 0.0), (0.0, -180.0), (30.0, 180.0), (540.0, 0.0)])
def test_segments_folded_onto_each_other_are_refused(folds):
    model, modes, _ = lattice(THREE, *folds)
    with pytest.raises(InputError, match=r"lie on each other, .* mm apart\. .*change the angle"):
        model.warning(modes)


def test_segments_almost_folded_onto_each_other_are_doubtful():
    model, modes, _ = lattice(THREE, 175.0, 0.0)
    assert re.search("Segments (1 and 2|2 and 1) come within 0.44 mm", model.warning(modes))
    for folds in ((0.0, 0.0), (120.0, -120.0), (160.0, 0.0)):
        model, modes, _ = lattice(THREE, *folds)
        assert model.warning(modes) == ""


def test_wing_that_reaches_through_the_wall_is_refused():
    wing = THREE.with_lattice(image=True)
    model, modes, _ = lattice(wing, 170.0, 0.0)
    with pytest.raises(InputError, match="must stay on its side of the wall"):
        model.warning(modes)
    model, modes, _ = lattice(wing, 120.0, -60.0)
    assert model.warning(modes) == ""


def test_lift_slope_of_the_model_is_said_to_be_unused():
    segment = THREE.segments[0].model_copy(update={"lift_slope": 5.0})
    wing = THREE.model_copy(update={"segments": (segment, *THREE.segments[1:])})
    model, modes, _ = lattice(wing, 0.0, 0.0)
    assert model.warning(modes) == "The lattice does not use the model's lift_slope."


@pytest.mark.parametrize(("edge", "chord", "words"), [(0.0, 0.1, "width"), (0.2, 0.0, "chord")])
def test_panels_without_size_are_refused(edge, chord, words):
    inner, outer = np.array([[0.0, 0.0]]), np.array([[edge, 0.0]])
    with pytest.raises(InputError, match=f"the {words} of strip 1 must be greater than 0 m"):
        Strips(inner, outer, np.zeros(1), np.array([chord]), np.array([0]))


@pytest.mark.parametrize("refinement", [0, 1, 3])
def test_inset_lattice_ends_a_quarter_of_the_refined_strip_before_a_gap(refinement):
    wing = THREE.with_gaps("2 mm").with_lattice(
        spanwise=[4, 4, 4], spacing="inset", gap_refinement=refinement
    )
    middle = mesh_segments(wing)[1].edges
    last = middle[-1] - middle[-2]
    assert 0.099 - middle[-1] == pytest.approx(last / 4)
    assert middle[0] - 0.001 == pytest.approx(last / 4)


def test_strip_theory_may_be_folded_flat():
    model = AeroelasticWing(THREE, "strip")
    assert model.warning(model.modes((np.pi, 0.0))) == ""


LATTICE = """
[[wing.segment]]
span = "14 cm"
chord = "5 cm"
thickness = "2 mm"
material = "sheet"
[[wing.segment]]
span = "10 cm"
chord = "5 cm"
thickness = "2 mm"
material = "sheet"
hinge = { rigid = true, gap = "GAP" }
[material.sheet]
youngs_modulus = "3 GPa"
poissons_ratio = 0.4
density = 1145
[lattice]
KEY
"""


@pytest.mark.parametrize(
    ("key", "gap", "words"),
    [
        ("chordwise = 0", "1 mm", "lattice.chordwise: got 0; must be a whole number, 1 to 1000"),
        ("chordwise = 2.5", "1 mm", "lattice.chordwise: got 2.5; must be a whole number"),
        ("spanwise = 1", "1 mm", "lattice.spanwise: got 1; must be at least one strip for each"),
        ("spanwise = [3]", "1 mm", "lattice.spanwise: got '[3]'; this wing has 2 segments"),
        ("spanwise = [3, 0]", "1 mm", "lattice.spanwise: got 0; must be a whole number"),
        ("wake = 0", "1 mm", "lattice.wake: got 0; must be a number of chords"),
        ("relaxation = 1", "1 mm", "lattice.relaxation: got 1; must be a factor"),
        ("image = 1", "1 mm", "lattice.image: got 1; must be true or false"),
        ('spacing = "dense"', "1 mm", "lattice.spacing: got 'dense'; must be 'uniform'"),
        ('scheme = "euler"', "1 mm", "lattice.scheme: got 'euler'; must be 'exact'"),
        ("panels = 8", "1 mm", "lattice.panels: got 8; is not a known key"),
        ("wake = 5", "20 cm", "wing.segment[2].hinge.gap: got 0.2; gaps must leave some of the"),
        ("wake = 5", "-1 mm", "wing.segment[2].hinge.gap: got '-1 mm'; must be a length"),
        ("chordwise = 1000\nspanwise = 1000", "1 mm", "lattice.spanwise: got 1000; a lattice may"),
        ("chordwise = 300\nwake = 10000", "1 mm", "lattice.wake: got 10000.0; the wake may have"),
    ],
)
def test_bad_lattice(key, gap, words):
    with pytest.raises(InputError) as caught:
        parse_model(LATTICE.replace("KEY", key).replace("GAP", gap))
    assert str(caught.value).startswith(words)


def test_time_steps_fit_one_chord():
    wing = THREE.with_lattice(scheme="average")
    outer = wing.segments[2].model_copy(update={"chord": 0.04})
    unequal = wing.model_copy(update={"segments": (*wing.segments[:2], outer)})
    AeroelasticWing(wing, "lattice")
    AeroelasticWing(unequal, "strip")
    with pytest.raises(InputError, match="a discrete-time scheme needs segments of equal chord"):
        AeroelasticWing(unequal, "lattice")


def test_gap_of_a_hinge_is_read():
    wing = parse_model(LATTICE.replace("KEY", "wake = 5").replace("GAP", "2 mm"))
    assert wing.hinges == (Hinge(kind="rigid", gap=0.002),)
    assert wing.lattice.wake == 5.0
