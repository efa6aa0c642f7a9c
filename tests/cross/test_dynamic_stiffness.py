"""Natural frequencies of folded wings against exact dynamic stiffness."""

import numpy as np
import pytest

from foldwing.model import Hinge, HingeKind, PointMass, Segment, Wing, read_model
from foldwing.structure.assembly import assemble
from foldwing.structure.modes import natural_modes
from support.dynamic_stiffness import Beam, FoldedWing

THREE_SEGMENT_FOLDS = [
    (0, 0),
    (30, -30),
    (30, 60),
    (-45, 20),
    (85, -85),
    (90, 45),
    (90, -90),
    (120, -120),
    (150, -150),
    (180, -180),
    (17, 163),
]


def beam_of(segment, tip_masses=()):
    """The exact beam of a segment."""
    assert segment.mass_offset == 0.0 == segment.axis_offset
    return Beam(
        segment.span,
        segment.bending_stiffness,
        segment.torsion_stiffness,
        segment.mass_per_span,
        segment.inertia_per_span,
        tip_masses,
    )


def exact(wing, folds, count):
    """Exact angular frequencies at fold angles in degrees; point masses stand on outboard edges."""
    stiffness = [np.inf if h.kind is HingeKind.RIGID else h.stiffness for h in wing.hinges]
    masses = [[] for _ in wing.segments]
    for point in wing.point_masses:
        assert point.y == wing.segments[point.segment - 1].span
        masses[point.segment - 1].append((point.mass, point.x))
    beams = [beam_of(s, m) for s, m in zip(wing.segments, masses, strict=True)]
    return FoldedWing(beams, stiffness, np.radians(folds)).frequencies(count)


def converged(wing, folds, count):
    """Angular frequencies of the wing in the converged basis, rigid motions left out."""
    counts = (10, 9) if wing.hinges else (15, 14)  # several segments share the half waves
    bending, torsion = counts
    wing = wing.with_analysis(basis="converged", bending_modes=bending, torsion_modes=torsion)
    modes = natural_modes(assemble(wing), tuple(np.radians(folds)), count + 4)
    return modes.omega[modes.omega > 0][:count]


def segment(span, chord, thickness):
    """A segment of sheet: E 2.8 GPa, G 1.2 GPa, 1145 kg/m^3."""
    mass = 1145.0 * chord * thickness
    return Segment(
        span=span,
        chord=chord,
        bending_stiffness=2.8e9 * chord * thickness**3 / 12,
        torsion_stiffness=1.2e9 * chord * thickness**3 / 3,
        mass_per_span=mass,
        inertia_per_span=mass * chord**2 / 12,
    )


def spring(stiffness):
    """A spring hinge."""
    return Hinge(stiffness=stiffness)


RIGID, FREE = Hinge(kind=HingeKind.RIGID), Hinge(kind=HingeKind.FREE)

SEGMENTS = (
    segment(0.16, 0.06, 1.8e-3),
    segment(0.10, 0.05, 1.5e-3),
    segment(0.07, 0.05, 1.5e-3),
    segment(0.05, 0.035, 1.2e-3),
)


def unlike_wing(count, *hinges):
    """The first segments, all unlike, joined by the hinges."""
    return Wing(segments=SEGMENTS[:count], hinges=hinges)


CASES = [
    pytest.param(unlike_wing(1), (), id="one"),
    pytest.param(unlike_wing(2, spring(0.5)), (40,), id="two"),
    pytest.param(unlike_wing(2, RIGID), (-110,), id="two-rigid"),
    pytest.param(unlike_wing(2, FREE), (70,), id="two-free"),
    pytest.param(unlike_wing(3, spring(0.5), RIGID), (60, 50), id="three-mixed"),
    pytest.param(unlike_wing(3, FREE, spring(0.2)), (25, -80), id="three-free"),
    pytest.param(unlike_wing(4, spring(0.6), spring(0.4), spring(0.1)), (35, -60, 100), id="four"),
    pytest.param(unlike_wing(4, spring(0.6), RIGID, FREE), (90, -45, -45), id="four-mixed"),
]


def test_reference_gives_the_cantilever():
    """The exact method itself: closed forms of a clamped beam and bar, to 1e-12."""
    beam = beam_of(SEGMENTS[0])
    bending = np.array([1.8751040687119612, 4.6940911329741746, 7.8547574382376126]) ** 2
    bending *= np.sqrt(beam.bending / beam.mass) / beam.length**2
    torsion = np.array([0.5, 1.5]) * np.pi / beam.length * np.sqrt(beam.torsion / beam.inertia)
    closed = np.sort([*bending, *torsion])
    np.testing.assert_allclose(FoldedWing([beam], [], []).frequencies(5), closed, rtol=1e-12)


def test_reference_does_not_see_a_rigid_flat_hinge():
    """The exact method itself: a beam cut in two and joined rigidly is the same beam."""
    whole = Beam(0.3, 2.0, 1.5, 0.4, 1e-4)
    half = Beam(0.15, 2.0, 1.5, 0.4, 1e-4)
    joined = FoldedWing([half, half], [np.inf], [0.0]).frequencies(10)
    np.testing.assert_allclose(joined, FoldedWing([whole], [], []).frequencies(10), rtol=1e-11)


@pytest.mark.parametrize("folds", THREE_SEGMENT_FOLDS)
def test_three_segment_wing_has_the_exact_frequencies(folds):
    """Kinematics, springs and in-plane inertia at all folds: ten frequencies to 5e-7."""
    wing = read_model("three-segment")
    found = converged(wing, folds, 10)
    np.testing.assert_allclose(found, exact(wing, folds, 10), rtol=5e-7)


@pytest.mark.parametrize(("wing", "folds"), CASES)
def test_unlike_segments_have_the_exact_frequencies(wing, folds):
    """One to four segments of different chord, spring, rigid and free hinges: eight to 5e-7."""
    np.testing.assert_allclose(converged(wing, folds, 8), exact(wing, folds, 8), rtol=5e-7)


@pytest.mark.parametrize("folds", [(30, -30), (120, -120)])
def test_point_masses_at_the_hinges_have_the_exact_frequencies(folds):
    """Hinge bodies off the elastic axis, which move in plane as well: eight to 5e-7."""
    wing = read_model("friction-hinge-1")
    assert len(wing.point_masses) == 4
    heavier = wing.with_point_masses(PointMass(segment=3, mass=0.01, x=0.02, y=0.06))
    for case in (wing, heavier):
        np.testing.assert_allclose(converged(case, folds, 8), exact(case, folds, 8), rtol=5e-7)
