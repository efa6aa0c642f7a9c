"""The direct solution of the lattice against its fast transfer function."""

import numpy as np
import pytest

from foldwing.aeroelastic.loads import Motions, loads_of
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model

FOLDS = np.radians((30.0, -75.0))
P = np.array([0.0, 0.2j, 0.05 + 0.6j, -0.02 + 0.1j])


def unequal_chords(wing):
    segments = list(wing.segments)
    segments[1] = segments[1].model_copy(update={"chord": 0.04})
    return wing.model_copy(update={"segments": tuple(segments)})


MESHES = {
    "exact": {},
    "average": {"scheme": "average"},
    "literal": {"scheme": "literal"},
    "printed": {"scheme": "printed"},
    "wall": {"image": True, "relaxation": 0.9, "spacing": "cosine"},
}


@pytest.mark.parametrize("mesh", [*MESHES, "unequal chords"])
def test_loads_of_the_panels_are_the_generalized_forces(mesh):
    wing = read_model("three-segment")
    wing = unequal_chords(wing) if mesh == "unequal chords" else wing
    wing = wing.with_lattice(chordwise=4, spanwise=9, wake=5.0, **MESHES.get(mesh, {}))
    model = AeroelasticWing(wing, "lattice")
    modes = model.modes(FOLDS)
    motions = Motions(P, np.full(len(P), 20.0), np.ones((len(P), modes.count), complex))
    exact = model.lattice(modes).forces(P)
    forces = loads_of(model, modes, motions).forces.sum(axis=1)
    assert np.abs(forces - exact).max() < 1e-12 * np.abs(exact).max()


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady"])
def test_segments_of_strip_theory_add_up(aerodynamics):
    model = AeroelasticWing(unequal_chords(read_model("three-segment")), aerodynamics)
    modes = model.modes(FOLDS)
    motions = Motions(P, np.full(len(P), 20.0), np.ones((len(P), modes.count), complex))
    exact = model.aerodynamic_model(modes).forces(P)
    forces = loads_of(model, modes, motions).forces
    assert forces.shape[1] == 3
    assert np.abs(forces.sum(axis=1) - exact).max() < 1e-13 * np.abs(exact).max()
