"""A wing of plates against the same wing whose plates come back from files of their modes."""

import dataclasses

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import example_text, parse_model, read_model
from foldwing.structure.assembly import assemble
from foldwing.structure.mode_files import write_modes
from foldwing.structure.modes import natural_modes
from support.mode_sets import mode_set


@pytest.fixture(scope="module")
def returned(tmp_path_factory):
    """The example with every plate replaced by a file of its elastic modes."""
    folder = tmp_path_factory.mktemp("modes")
    wing = read_model("three-segment-plate")
    text = example_text("three-segment-plate")
    parts = text.split("[[wing.segment]]\n")
    for number, (plate, segment) in enumerate(
        zip(assemble(wing).components, wing.segments, strict=True), start=1
    ):
        rows, columns = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 17), indexing="ij")
        x, y = segment.outline.point(columns.ravel(), rows.ravel()).T
        elastic = np.flatnonzero(np.diag(plate.stiffness) > 0.0)
        shapes = plate.displacement(x, y)[:, :, elastic].transpose(2, 0, 1)
        exported = mode_set(plate.frequencies, shapes, np.stack([x, y, np.zeros_like(x)], axis=1))
        mass = plate.mass_and_centre[0]
        exported = dataclasses.replace(exported, modal_mass=np.full(len(elastic), mass))
        write_modes(exported, folder / f"plate-{number}.csv")
        parts[number] = f'modes = {{ file = "plate-{number}.csv" }}\n' + parts[number]
    model = "[[wing.segment]]\n".join(parts)
    return wing, parse_model(model, "returned", folder=folder)


def test_natural_frequencies_come_back(returned):
    """Within half a percent, what the spline through 41 x 17 points leaves at the hinges."""
    wing, back = (natural_modes(assemble(each), count=8).frequencies for each in returned)
    assert back == pytest.approx(wing, rel=0.005)
    assert np.any(back != wing)


def test_forces_of_the_air_come_back(returned):
    """Forces are quadratic in the shapes: twice their error at points left out, below 1 %."""
    forces = []
    for each in returned:
        model = AeroelasticWing(each)
        system = model.system(model.modes())
        forces.append(np.abs(system.aerodynamics.forces(np.array([0.3j]))[0, :4, :4]))
    scale = np.sqrt(np.outer(*[np.diag(forces[0])] * 2))
    assert np.abs(forces[1] - forces[0]).max() < 0.02 * scale.max()
