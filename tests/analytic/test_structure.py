"""Structural dynamics against closed forms, an own finite-element beam and invariances."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
import scipy.linalg
from numpy.polynomial import Chebyshev
from scipy.optimize import brentq

from foldwing.model import Hinge, HingeKind, PointMass, Segment, Wing, read_model
from foldwing.structure.assembly import Assembly, assemble
from foldwing.structure.beam import beam_modes
from foldwing.structure.component import Root
from foldwing.structure.following import follow_modes
from foldwing.structure.modes import modal_assurance, natural_modes
from support.dynamic_stiffness import Beam, FoldedWing

RIGID, FREE = Hinge(kind=HingeKind.RIGID), Hinge(kind=HingeKind.FREE)
BASES = ("free-free", "converged")
# cos x cosh x = -1
CANTILEVER = np.array(
    [1.8751040687119612, 4.6940911329741746, 7.8547574382376126, 10.995540734875467]
)
FOLDS = tuple(np.radians((30.0, -30.0)))

UNIFORM = Segment(
    span=0.3,
    chord=0.05,
    bending_stiffness=0.05,
    torsion_stiffness=0.08,
    mass_per_span=0.09,
    inertia_per_span=1.9e-5,
)
OFF_AXIS = Segment(
    span=0.3,
    chord=0.05,
    bending_stiffness=0.05,
    torsion_stiffness=0.08,
    mass_per_span=0.09,
    inertia_per_span=3.5e-5,
    elastic_axis=0.35,
    mass_centre=0.52,
)


def wing_of(*segments, hinges=(), masses=(), **analysis):
    """A wing with what matters here."""
    wing = Wing(segments=segments, hinges=tuple(hinges), point_masses=tuple(masses))
    return wing.with_analysis(**analysis) if analysis else wing


def omegas(wing, folds=None, count=8):
    """Angular natural frequencies; folds in radians."""
    return natural_modes(assemble(wing), folds, count).omega


def three_segment(hinge=None, **analysis):
    """The three-segment wing, with other hinges if wanted."""
    wing = read_model("three-segment").with_analysis(**analysis)
    if hinge is None:
        return wing
    return Wing(segments=wing.segments, hinges=(hinge, hinge), analysis=wing.analysis)


def cut(segment, *fractions):
    """The segment cut into pieces of these fractions of its span."""
    return [segment.model_copy(update={"span": segment.span * f}) for f in fractions]


# --- one beam -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("basis", "tolerance"), [("free-free", 1e-11), ("converged", 1e-9)])
def test_cantilever_has_its_closed_form_frequencies(basis, tolerance):
    """Clamped beam and bar: (beta L)^2 sqrt(EI / m L^4) and (n - 1/2) pi / L sqrt(GJ / i)."""
    s = UNIFORM
    bending = CANTILEVER**2 * np.sqrt(s.bending_stiffness / s.mass_per_span) / s.span**2
    speed = np.sqrt(s.torsion_stiffness / s.inertia_per_span)
    torsion = (np.arange(1, 4) - 0.5) * np.pi / s.span * speed
    closed = np.sort([*bending, *torsion])[:6]
    wing = wing_of(s, basis=basis, bending_modes=13, torsion_modes=11)
    np.testing.assert_allclose(omegas(wing, count=6), closed, rtol=tolerance)


@pytest.mark.parametrize("ratio", [0.05, 0.4, 3.0])
def test_tip_mass_obeys_the_transcendental_equation(ratio):
    """1 + cos z cosh z = mu z (sin z cosh z - cos z sinh z) for a mass mu m L at the tip."""
    s = UNIFORM

    def equation(z):
        beam = 1 / np.cosh(z) + np.cos(z)
        return beam - ratio * z * (np.sin(z) - np.cos(z) * np.tanh(z))

    grid = np.linspace(0.1, 11.0, 400)
    values = equation(grid)
    changes = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))
    z = np.array([brentq(equation, grid[j], grid[j + 1], xtol=1e-15) for j in changes])
    exact = z**2 * np.sqrt(s.bending_stiffness / s.mass_per_span) / s.span**2
    mass = PointMass(segment=1, mass=ratio * s.mass_per_span * s.span, x=0.0, y=s.span)
    wing = wing_of(s, masses=[mass], basis="converged", bending_modes=14, torsion_modes=3)
    modes = natural_modes(assemble(wing), (), 8)
    found = modes.omega[modes.bending_share > 0.5][:3]
    np.testing.assert_allclose(found, exact[:3], rtol=1e-7)


def hermite(s):
    """Cubic Hermite functions of value, slope, value, slope on [0, 1] and second derivatives."""
    f = [1 - 3 * s**2 + 2 * s**3, s - 2 * s**2 + s**3, 3 * s**2 - 2 * s**3, s**3 - s**2]
    slope = [6 * s**2 - 6 * s, 1 - 4 * s + 3 * s**2, 6 * s - 6 * s**2, 3 * s**2 - 2 * s]
    curvature = [12 * s - 6, 6 * s - 4, 6 - 12 * s, 6 * s - 2]
    return np.array(f), np.array(slope), np.array(curvature)


def element_matrices(segment, length):
    """Mass and stiffness (8, 8) of an element: plunge and its slope, then twist and its slope."""
    nodes, weights = np.polynomial.legendre.leggauss(6)
    f, slope, curvature = hermite((nodes + 1) / 2)
    unit = np.array([1.0, length, 1.0, length])
    f, slope, curvature = (g * unit[:, None] for g in (f, slope, curvature))
    product = (f * weights / 2) @ f.T * length
    m, i, x = segment.mass_per_span, segment.inertia_per_span, segment.mass_offset
    mass = np.block([[m * product, -m * x * product], [-m * x * product, i * product]])
    bending = segment.bending_stiffness * (curvature * weights / 2) @ curvature.T / length**3
    torsion = segment.torsion_stiffness * (slope * weights / 2) @ slope.T / length
    return mass, scipy.linalg.block_diag(bending, torsion)


def finite_element_omegas(segment, count, elements=80, tip_mass=0.0, tip_x=0.0):
    """Frequencies of a clamped beam and bar by cubic elements for plunge and for twist."""
    n = elements + 1
    M, K = np.zeros((2, 4 * n, 4 * n))
    mass, stiffness = element_matrices(segment, segment.span / elements)
    for e in range(elements):
        where = np.r_[2 * e : 2 * e + 4, 2 * n + 2 * e : 2 * n + 2 * e + 4]
        M[np.ix_(where, where)] += mass
        K[np.ix_(where, where)] += stiffness
    tip = np.zeros(4 * n)
    tip[[2 * n - 2, 4 * n - 2]] = 1.0, -tip_x
    M += tip_mass * np.outer(tip, tip)
    kept = np.setdiff1d(np.arange(4 * n), [0, 1, 2 * n])
    M, K = M[np.ix_(kept, kept)], K[np.ix_(kept, kept)]
    return np.sqrt(1 / scipy.linalg.eigvalsh(M, K)[::-1][:count])


def test_finite_elements_give_the_cantilever():
    """The reference itself: closed forms to 1e-8."""
    s = UNIFORM
    bending = CANTILEVER**2 * np.sqrt(s.bending_stiffness / s.mass_per_span) / s.span**2
    speed = np.sqrt(s.torsion_stiffness / s.inertia_per_span)
    closed = np.sort([*bending, *(np.array([0.5, 1.5, 2.5]) * np.pi / s.span * speed)])[:4]
    np.testing.assert_allclose(finite_element_omegas(s, 4), closed, rtol=1e-7)


@pytest.mark.parametrize(
    ("segment", "tip_mass", "tip_x"),
    [
        pytest.param(OFF_AXIS, 0.0, 0.0, id="off-axis"),
        pytest.param(UNIFORM, 0.006, 0.02, id="tip-mass"),
        pytest.param(OFF_AXIS, 0.006, -0.03, id="both"),
        pytest.param(read_model("goland").segments[0], 0.0, 0.0, id="goland"),
    ],
)
def test_coupled_frequencies_equal_finite_elements(segment, tip_mass, tip_x):
    """Bending and torsion coupled by the section or by a tip mass: seven frequencies to 1e-6."""
    masses = [PointMass(segment=1, mass=tip_mass, x=tip_x, y=segment.span)] if tip_mass else []
    wing = wing_of(segment, masses=masses, basis="converged", bending_modes=16, torsion_modes=14)
    reference = finite_element_omegas(segment, 7, tip_mass=tip_mass, tip_x=tip_x)
    np.testing.assert_allclose(omegas(wing, count=7), reference, rtol=1e-6)
    uncoupled = segment.model_copy(update={"mass_centre": segment.elastic_axis})
    assert abs(finite_element_omegas(uncoupled, 1)[0] / reference[0] - 1) > 1e-4


# --- hinges -------------------------------------------------------------------------------------


@pytest.mark.parametrize("segment", [UNIFORM, OFF_AXIS], ids=["uniform", "off-axis"])
@pytest.mark.parametrize(
    "fractions", [(0.5, 0.5), (0.2, 0.8), (0.47, 0.33, 0.2), (0.1, 0.4, 0.2, 0.3)]
)
def test_flat_wing_with_rigid_hinges_is_one_beam(segment, fractions):
    """However the beam is cut, rigid hinges in a flat wing leave its frequencies alone: 1e-6."""
    pieces = cut(segment, *fractions)
    joined = wing_of(
        *pieces,
        hinges=[RIGID] * (len(pieces) - 1),
        basis="converged",
        bending_modes=14,
        torsion_modes=13,
    )
    whole = wing_of(segment, basis="converged", bending_modes=16, torsion_modes=14)
    np.testing.assert_allclose(omegas(joined), omegas(whole), rtol=1e-6)


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("turn", [(360, 0), (0, -360), (-360, 360)])
def test_a_full_turn_is_no_fold(basis, turn):
    """A hinge turned right round gives the flat wing."""
    wing = three_segment(basis=basis, bending_modes=8, torsion_modes=8)
    flat = omegas(wing, (0.0, 0.0))
    np.testing.assert_allclose(omegas(wing, tuple(np.radians(turn))), flat, rtol=1e-7)


@pytest.mark.parametrize("basis", BASES)
def test_small_folds_tend_to_the_flat_wing(basis):
    """Frequencies are even in the fold: a hundredth of a degree changes them by less than 1e-6."""
    wing = three_segment(basis=basis, bending_modes=8, torsion_modes=8)
    flat = omegas(wing, (0.0, 0.0))
    nearly = omegas(wing, tuple(np.radians((0.01, -0.02))))
    np.testing.assert_allclose(nearly, flat, rtol=1e-6)
    assert abs(omegas(wing, FOLDS)[2] / flat[2] - 1) > 0.1


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("folds", [(30, -30), (20, 75), (120, -120), (-90, 45)])
def test_mirrored_folds_have_the_same_frequencies(basis, folds):
    """Folding down instead of up is a reflection and changes no frequency, off-axis too."""
    pieces = cut(OFF_AXIS, 0.5, 0.3, 0.2)
    wing = wing_of(*pieces, hinges=[Hinge(stiffness=0.5)] * 2, basis=basis, bending_modes=8)
    up, down = (omegas(wing, tuple(sign * np.radians(folds))) for sign in (1, -1))
    np.testing.assert_allclose(up, down, rtol=1e-7)


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("folds", [(0, 0), (30, -30), (90, 90), (180, 0), (12.3, -77.7)])
@pytest.mark.parametrize(
    ("hinges", "zeros"),
    [((FREE, FREE), 2), ((FREE, Hinge(stiffness=0.5)), 1), ((RIGID, FREE), 1), ((RIGID,) * 2, 0)],
    ids=["ff", "fs", "rf", "rr"],
)
def test_free_hinges_give_as_many_exact_zeros(basis, folds, hinges, zeros):
    """A free hinge is a mechanism at any fold; its frequency is 0.0 and nothing else is."""
    wing = wing_of(*cut(UNIFORM, 0.5, 0.3, 0.2), hinges=hinges, basis=basis)
    modes = natural_modes(assemble(wing), tuple(np.radians(folds)), 8)
    assert np.all(modes.omega[:zeros] == 0.0)
    assert np.all(modes.omega[zeros:] > 10.0)
    assert [name[0] == "R" for name in modes.names] == [True] * zeros + [False] * (8 - zeros)


@pytest.mark.parametrize("basis", BASES)
def test_free_flap_turns_about_its_hinge_line(basis):
    """The zero mode moves nothing inboard and turns what is outboard about the hinge line."""
    wing = wing_of(*cut(OFF_AXIS, 0.5, 0.3, 0.2), hinges=(RIGID, FREE), basis=basis)
    modes = natural_modes(assemble(wing), tuple(np.radians((40.0, 65.0))), 3)
    x, y = np.array([-0.01, 0.02, 0.0, 0.03]), np.array([0.0, 0.02, 0.05, 0.06])
    u = modes.displacement(2, x, y)[..., 0]
    turned = np.cross([1.0, 0.0, 0.0], modes.position(2, x, y) - modes.origins[2])
    rate = (u * turned).sum() / (turned**2).sum()
    np.testing.assert_allclose(u, rate * turned, atol=1e-9 * np.abs(u).max())
    for inner in (0, 1):
        still = modes.displacement(inner, x, y)[..., 0]
        np.testing.assert_allclose(still, 0.0, atol=1e-8 * np.abs(u).max())


@pytest.mark.parametrize(("basis", "round_off"), [("free-free", 1e-5), ("converged", 3e-5)])
def test_very_stiff_springs_act_as_rigid_hinges(basis, round_off):
    """1e5 N m/rad: within 1e-5 of rigid, softer by as much as 1/k.

    The eigenvalues of the solver, which are not used for the frequencies, carry round-off of the
    size of the largest eigenvalue; the polynomials reach higher.
    """
    rigid = omegas(three_segment(RIGID, basis=basis, bending_modes=8), FOLDS)
    stiff = natural_modes(
        assemble(three_segment(Hinge(stiffness=1e5), basis=basis, bending_modes=8)), FOLDS, 8
    )
    softer = omegas(three_segment(Hinge(stiffness=1e3), basis=basis, bending_modes=8), FOLDS)
    np.testing.assert_allclose(stiff.omega, rigid, rtol=1e-5)
    assert stiff.mismatch < round_off
    loss, hundredfold = 1 - stiff.omega[3] / rigid[3], 1 - softer[3] / rigid[3]
    assert 80 < hundredfold / loss < 120


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("stiffness", [1e6, 1e8])
def test_excessively_stiff_springs_lose_no_mode(stiffness, basis):
    """No mode of a wing without free hinges is rigid, however stiff its springs."""
    modes = natural_modes(
        assemble(three_segment(Hinge(stiffness=stiffness), basis=basis)), FOLDS, 8
    )
    assert np.all(modes.omega > 0.0)


@pytest.mark.parametrize("basis", BASES)
def test_hinge_lines_hold_together(basis):
    """All three displacements agree all along the hinge line, not only where tied."""
    wing = three_segment(basis=basis)
    modes = natural_modes(assemble(wing), tuple(np.radians((75.0, -130.0))), 8)
    x = np.linspace(-0.025, 0.025, 7)
    for joint, inner in enumerate(wing.segments[:-1]):
        inboard = modes.displacement(joint, x, np.full(7, inner.span))
        outboard = modes.displacement(joint + 1, x, np.zeros(7))
        size = np.abs(inboard).max()
        np.testing.assert_allclose(inboard, outboard, atol=1e-9 * size)


@dataclass(frozen=True)
class Rewritten(Assembly):
    """An assembly whose constraints are said in another way."""

    how: str = ""

    def constraints(self, fold_angles):
        C = super().constraints(fold_angles)
        rng = np.random.default_rng(5)
        match self.how:
            case "permuted":
                return C[rng.permutation(len(C))]
            case "duplicated":
                return np.vstack([C, C[::2], C[:3]])
            case "scaled":
                return C * 10.0 ** rng.uniform(-3, 3, (len(C), 1))
            case "mixed":
                return np.vstack([rng.standard_normal((len(C), len(C))) @ C, C[:4] + C[4:8]])
        return C


@pytest.mark.parametrize("how", ["permuted", "duplicated", "scaled", "mixed"])
@pytest.mark.parametrize("folds", [(0.0, 0.0), (30.0, -30.0), (90.0, 90.0), (180.0, -180.0)])
def test_frequencies_do_not_depend_on_how_constraints_are_written(how, folds):
    """Order, scale, repetition and mixture of redundant constraints leave the frequencies alone."""
    plain = assemble(three_segment())
    folds = tuple(np.radians(folds))
    other = Rewritten(plain.wing, plain.components, how)
    np.testing.assert_allclose(
        natural_modes(other, folds, 8).omega, natural_modes(plain, folds, 8).omega, rtol=1e-7
    )


# --- convergence --------------------------------------------------------------------------------


def exact_omegas(wing, count):
    """Frequencies by dynamic stiffness."""
    beams = [
        Beam(s.span, s.bending_stiffness, s.torsion_stiffness, s.mass_per_span, s.inertia_per_span)
        for s in wing.segments
    ]
    return FoldedWing(beams, [h.stiffness for h in wing.hinges], FOLDS).frequencies(count)


def basis_errors(basis, counts, modes=6):
    """Relative errors, shape (counts, modes)."""
    exact = exact_omegas(three_segment(), modes)
    cases = [three_segment(basis=basis, bending_modes=n, torsion_modes=n) for n in counts]
    return np.array([omegas(wing, FOLDS, modes) / exact - 1 for wing in cases])


def test_free_free_basis_converges_with_the_first_power():
    """Error of every mode between 10 and 40 functions falls as 1/N, from above."""
    counts = np.array([10, 20, 40])
    errors = basis_errors("free-free", counts)
    assert np.all(errors > 0)
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert np.all((order > 0.9) & (order < 1.1))


def test_converged_basis_converges_exponentially():
    """Two functions more divide the worst error of six modes by 100, to below 1e-7 at seven."""
    errors = np.abs(basis_errors("converged", (3, 5, 7))).max(axis=1)
    assert np.all(errors[:-1] > 100 * errors[1:])
    assert errors[-1] < 1e-7


@pytest.mark.parametrize(
    "count",
    [
        12,
        30,
        60,
    ],
)
def test_more_functions_lose_no_digits(count):
    """The largest bases still have the exact frequencies to 1e-6."""
    assert np.abs(basis_errors("converged", [count])).max() < 1e-6


# --- mass and energy ----------------------------------------------------------------------------


def chordwise_masses(segment):
    """Two points per section with the mass, mass centre and inertia of the section."""
    m, x = segment.mass_per_span, segment.mass_offset
    radius = np.sqrt(segment.inertia_per_span / m - x**2)
    return [(m / 2, x + radius), (m / 2, x - radius)]


def mass_points(segment, points=60):
    """x, y and mass of points that stand for a segment."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    y, weights = (nodes + 1) * segment.span / 2, weights * segment.span / 2
    parts = [(np.full_like(y, x), y, m * weights) for m, x in chordwise_masses(segment)]
    return (np.concatenate(values) for values in zip(*parts, strict=True))


@pytest.mark.parametrize("basis", BASES)
@pytest.mark.parametrize("root", Root)
@pytest.mark.parametrize("segment", [UNIFORM, OFF_AXIS], ids=["uniform", "off-axis"])
def test_mass_matrix_is_the_kinetic_energy_of_the_displacements(segment, root, basis):
    """All three displacement components of all component modes, integrated over the planform."""
    analysis = three_segment(basis=basis).analysis
    component = beam_modes(segment, analysis, root)
    x, y, mass = mass_points(segment)
    u = component.displacement(x, y)
    M = np.einsum("pai,p,paj->ij", u, mass, u)
    scale = np.sqrt(np.outer(np.diag(M), np.diag(M)))
    np.testing.assert_allclose(component.mass / scale, M / scale, atol=1e-12)
    carried = np.einsum("pai,p->ai", u, mass)
    size = np.sqrt(np.diag(M) * mass.sum())
    np.testing.assert_allclose(component.mass_centre_motion / size, carried / size, atol=1e-12)


def test_rigid_motions_of_a_free_segment_weigh_what_they_should():
    """The last three coordinates move the plate without strain and carry mass and yaw inertia."""
    s = OFF_AXIS
    component = beam_modes(s, three_segment().analysis, Root.FREE)
    x, y = np.array([0.01, -0.02]), np.array([0.05, 0.3])
    rigid = component.displacement(x, y)[..., -3:]
    np.testing.assert_array_equal(rigid[..., 0], [[1.0, 0.0, 0.0]] * 2)
    np.testing.assert_array_equal(rigid[..., 1], [[0.0, 1.0, 0.0]] * 2)
    position = np.stack([x, y, 0 * x], axis=1)
    np.testing.assert_array_equal(rigid[..., 2], np.cross([0.0, 0.0, 1.0], position))
    total = s.mass_per_span * s.span
    np.testing.assert_allclose(np.diag(component.mass)[-3:-1], total, rtol=1e-14)
    polar = total * s.span**2 / 3 + s.inertia_per_span * s.span
    np.testing.assert_allclose(component.mass[-1, -1], polar, rtol=1e-14)
    assert np.all(component.stiffness[-3:] == 0.0)


@pytest.mark.parametrize("basis", BASES)
def test_folded_wing_has_unit_modal_mass_in_global_displacements(basis):
    """Kinetic energy from the global displacement field, point masses included, is orthonormal."""
    wing = read_model("friction-hinge-1").with_analysis(basis=basis)
    modes = natural_modes(assemble(wing), tuple(np.radians((75.0, -110.0))), 8)
    gram = np.zeros((8, 8))
    for index, segment in enumerate(wing.segments):
        x, y, mass = mass_points(segment)
        u = modes.displacement(index, x, y)
        gram += np.einsum("pai,p,paj->ij", u, mass, u)
    for point in wing.point_masses:
        u = modes.displacement(point.segment - 1, np.array([point.x]), np.array([point.y]))[0]
        gram += point.mass * u.T @ u
    np.testing.assert_allclose(gram, np.eye(8), atol=1e-10)


def strain_energy(modes, index, segment):
    """Twice the strain energy (n, n) of a segment from the slopes of its surface."""
    component, q = modes.assembly.components[index], modes.by_segment[index]
    nodes, weights = np.polynomial.legendre.leggauss(40)
    y, weights = (nodes + 1) * segment.span / 2, weights * segment.span / 2

    def derivative(row):
        def slopes(at):
            return (component.slopes(np.zeros(len(at)), at) @ q)[:, row]

        span = [0.0, segment.span]
        fits = [Chebyshev.interpolate(lambda s, j=j: slopes(s)[:, j], 40, span) for j in range(8)]
        return np.stack([fit.deriv()(y) for fit in fits], axis=1)

    twist_rate, curvature = derivative(0), derivative(1)
    bending = segment.bending_stiffness * (curvature.T * weights) @ curvature
    return bending + segment.torsion_stiffness * (twist_rate.T * weights) @ twist_rate


@pytest.mark.parametrize("basis", BASES)
def test_strain_energy_of_the_modes_is_the_frequency_squared(basis):
    """Curvature and twist rate from differentiated slopes, and hinge turns, give omega^2."""
    wing = three_segment(basis=basis)
    modes = natural_modes(assemble(wing), FOLDS, 8)
    energy = sum(strain_energy(modes, i, s) for i, s in enumerate(wing.segments))
    zero = np.zeros(1)
    for joint, hinge in enumerate(wing.hinges):
        parts, q = modes.assembly.components, modes.by_segment
        end = np.array([wing.segments[joint].span])
        inner = (parts[joint].slopes(zero, end) @ q[joint])[0, 1]
        outer = (parts[joint + 1].slopes(zero, zero) @ q[joint + 1])[0, 1]
        energy += hinge.stiffness * np.outer(inner - outer, inner - outer)
    scale = np.outer(modes.omega, modes.omega)
    np.testing.assert_allclose(energy / scale, np.eye(8), atol=1e-6)


def test_static_imbalance_couples_like_a_section_with_its_mass_centre_aft():
    """For a motion that grows linearly along each segment, the tip mass of static imbalance s
    couples plunge and twist as a section whose mass centre lies s half chords aft would."""
    s = 0.12
    wing = three_segment(basis="converged")
    balanced, unbalanced = assemble(wing), assemble(wing.with_static_imbalance(s))
    assert len(unbalanced.wing.point_masses) == 3
    change = unbalanced.mass - balanced.mass
    for index in (1, 2):
        segment, where = wing.segments[index], balanced.slices[index]
        component = balanced.components[index]
        y = np.linspace(0, segment.span, 30)
        motion = component.section_motion(y)
        linear = y / segment.span
        plunge, twist = (np.linalg.lstsq(f, linear, rcond=None)[0] for f in motion)
        coupling = plunge @ change[where, where] @ twist
        integral = segment.mass_per_span * segment.span / 3
        np.testing.assert_allclose(coupling, -integral * s * segment.half_chord, rtol=1e-9)


def test_imbalance_masses_sit_at_the_outboard_edges():
    """One mass per segment, a quarter chord aft of the elastic axis; none for zero imbalance."""
    wing = three_segment()
    points = wing.with_static_imbalance(0.1).point_masses
    assert [(p.segment, p.x, p.y) for p in points] == [
        (1, 0.0125, 0.14),
        (2, 0.0125, 0.1),
        (3, 0.0125, 0.06),
    ]
    assert wing.with_static_imbalance(0.0) == wing


# --- names and following ------------------------------------------------------------------------


def level_tip(step, last=150.0):
    """Fold angles psi, -psi from 0 in steps, in radians."""
    return [tuple(np.radians((psi, -psi))) for psi in np.arange(0.0, last + step / 2, step)]


def test_uncoupled_wing_has_pure_bending_and_pure_torsion():
    """Sections symmetric about the elastic axis: every mode is wholly one or the other, and a
    bending mode does not twist."""
    wing = three_segment()
    modes = natural_modes(assemble(wing), FOLDS, 8)
    twist = [
        np.abs(modes.section_motion(i, np.linspace(0, s.span, 9)).twist).max(axis=0)
        for i, s in enumerate(wing.segments)
    ]
    twist = np.max(twist, axis=0)
    bending = np.array([name[0] == "B" for name in modes.names])
    np.testing.assert_allclose(modes.bending_share, bending, atol=1e-9)
    assert twist[bending].max() < 1e-6 * twist[~bending].min()
    assert sorted(modes.names) == ["B1", "B2", "B3", "B4", "B5", "T1", "T2", "T3"]


@pytest.mark.parametrize(
    "step",
    [
        0.5,
        2.5,
        5.0,
        10.0,
    ],
)
def test_followed_branches_are_the_families_of_the_level_tip_sweep(step):
    """Bending and torsion cross, members of one family veer: the branches are the bending
    frequencies in ascending order and the torsion frequencies in ascending order."""
    assembly = assemble(three_segment())
    folds = level_tip(step)
    followed = follow_modes(assembly, folds, 8)
    family = np.array([name[0] for name in followed[0].modes.names])
    for case, angles in zip(followed, folds, strict=True):
        all_modes = natural_modes(assembly, angles, 16)
        for letter in "BT":
            share = all_modes.bending_share > 0.5
            expected = all_modes.omega[share if letter == "B" else ~share]
            branch = case.modes.omega[family == letter]
            np.testing.assert_allclose(branch, expected[: len(branch)], rtol=1e-7)


def test_followed_frequencies_are_continuous_and_the_confidence_is_honest():
    """Between half degrees no curve jumps by more than 3 %, no match is worse than 0.95, and a
    confidence is never above the MAC of the two modes."""
    followed = follow_modes(assemble(three_segment()), level_tip(0.5), 8)
    omega = np.array([case.modes.omega for case in followed])
    assert np.abs(np.diff(np.log(omega), axis=0)).max() < 0.03
    assert np.all(followed[0].confidence == 1.0)
    for before, after in pairwise(followed):
        mac = np.diag(modal_assurance(before.modes, after.modes))
        assert mac.min() > 0.95
        assert np.all(after.confidence <= mac + 1e-9)


def test_steps_too_large_to_match_are_halved():
    """From flat to 90 degrees at once: the branches of small steps, and the confidence is that of
    the worse half, for the way is first halved at 45."""
    assembly = assemble(three_segment())
    _, large = follow_modes(assembly, level_tip(90.0, 90.0), 8)
    *_, small = follow_modes(assembly, level_tip(1.0, 90.0), 8)
    np.testing.assert_allclose(large.modes.omega, small.modes.omega, rtol=1e-9)
    start, middle, end = follow_modes(assembly, level_tip(45.0, 90.0), 8)
    worse = np.minimum(middle.confidence, end.confidence)
    assert not np.allclose(middle.confidence, end.confidence, atol=0.05)
    np.testing.assert_allclose(large.confidence, worse, rtol=1e-6)
    assert np.diag(modal_assurance(start.modes, large.modes)).min() < 0.5 < worse.min()


def test_modes_are_comparable_by_mass_weighted_assurance():
    """A set of modes is orthonormal to itself, and unlike modes have no part in each other."""
    modes = natural_modes(assemble(three_segment()), FOLDS, 12)
    np.testing.assert_allclose(modal_assurance(modes, modes), np.eye(12), atol=1e-9)
