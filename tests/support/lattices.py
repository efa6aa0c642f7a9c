"""Wings for the vortex lattice, and the direct solution of its equations."""

from functools import cache

import numpy as np

from foldwing.aerodynamics.horseshoe import induced_velocity
from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import SegmentMesh, Strips
from foldwing.aerodynamics.unsteady import PanelMotion, lattice_model, load_length
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Lattice, Segment, Wing, read_model


@cache
def three_segment(folds=(30.0, -75.0), **lattice):
    """The three-segment wing with a lattice of its own, and its modes; cached."""
    wing = read_model("three-segment").folded(*folds).with_lattice(**dict(lattice))
    model = AeroelasticWing(wing, "lattice")
    return model, model.modes()


def small(folds=(30.0, -75.0), **lattice):
    """The same with so few panels that direct solutions cost nothing."""
    return three_segment(folds, **({"chordwise": 3, "spanwise": 8, "wake": 4.0} | lattice))


def unequal_chords(**lattice):
    """A wing of two segments whose chords and elastic axes differ, folded by 40 degrees."""
    thin = {"bending_stiffness": 0.05, "torsion_stiffness": 0.08, "mass_per_span": 0.09}
    inner = Segment(span=0.14, chord=0.05, inertia_per_span=2e-5, **thin)
    outer = Segment(span=0.10, chord=0.035, inertia_per_span=2e-5, elastic_axis=0.4, **thin)
    three = read_model("three-segment")
    wing = Wing(segments=(inner, outer), hinges=three.hinges[:1], air=three.air).folded(40.0)
    wing = wing.with_lattice(chordwise=3, spanwise=7, wake=4.0, **lattice)
    model = AeroelasticWing(wing, "lattice")
    return model, model.modes()


def direct_matrix(model, modes, p):
    """Normal wash per circulation of all panels at one p, with the general kernel and no tricks.

    One unknown per panel; the wake is added up row by row.
    """
    strips, lattice, b = model.strips(modes), model.wing.lattice, model.half_chord
    nc, rows = lattice.chordwise, max(1, round(lattice.wake * lattice.chordwise))
    dx = strips.chord / nc

    def placed(fraction, yz):
        return np.column_stack([strips.leading + fraction * dx, yz])

    points = np.vstack([placed(i + 0.75, strips.middle) for i in range(nc)])
    normals = np.tile(np.column_stack([np.zeros(strips.count), strips.normal]), (nc, 1))

    def row(j):
        sides = [(placed(j + 0.25, strips.inner), placed(j + 0.25, strips.outer))]
        if lattice.image:
            flip = np.array([1.0, -1.0, 1.0])
            sides.append((sides[0][1] * flip, sides[0][0] * flip))
        return sum(
            np.einsum("psi,pi->ps", induced_velocity(points, A, B), normals) for A, B in sides
        )

    A = np.hstack([row(j) for j in range(nc)]).astype(complex)
    z = np.exp(p * dx / b)
    for j in range(rows):
        omega = z ** -(j + 1.0) - z ** -float(j)
        if j == rows - 1:
            omega = omega * z / (z - lattice.relaxation)
        A += np.tile(row(nc + j) * omega, nc)
    return A


def direct_forces(model, modes, p, wash=None):
    """Qhat at one p from the equations as they stand; of another wash than the motion's if given.

    Loads are summed over panels.
    """
    motion, length, b = model.panel_motion(modes), model.load_lengths, model.half_chord
    if wash is None:
        wash = motion.slope + p / b * motion.collocation
    g = np.linalg.solve(direct_matrix(model, modes, p), wash)
    width = np.tile(model.strips(modes).width, model.wing.lattice.chordwise)[:, None]
    pressure = model.wing.air.density * width * g
    return motion.vortex.T @ pressure + p / b * motion.load.T @ (length[:, None] * pressure)


def section_lattice(chordwise, wake, scheme="exact"):
    """A flat strip ten million chords wide: two-dimensional flow, plunge and pitch about mid-chord.

    Density, speed and half chord are 1; the model's forces are those of a unit of span.
    """
    width = 2e7
    edges = np.array([[-width / 2, 0.0], [width / 2, 0.0]])
    strips = Strips(edges[:1], edges[1:], np.array([-1.0]), np.array([2.0]), np.array([0]))
    mesh = SegmentMesh(edges[:, 0], -1.0, 2.0, chordwise)
    length = load_length(mesh, scheme)

    def w(x):
        return np.column_stack([np.ones_like(x), -x])

    motion = PanelMotion(
        np.column_stack([np.zeros(chordwise), -np.ones(chordwise)]),
        w(mesh.station(0.75)),
        w(mesh.station(0.25)),
        w(mesh.station(0.25) + length / 2),
    )
    influence = Influence(strips, chordwise, round(wake * chordwise))
    return lattice_model(influence, motion, length, 1.0 / width, 1.0, Lattice(scheme=scheme))
