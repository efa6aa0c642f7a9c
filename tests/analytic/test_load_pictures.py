"""Loads in datasets and pictures: written, read, and drawn by both renderers."""

import json

import numpy as np
import pytest
import xarray

from foldwing import plots, results
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.plots.catalogue import pictures
from foldwing.plots.interactive import figure as plotly_figure
from foldwing.plots.palette import THEMES
from foldwing.plots.static import draw
from foldwing.plots.static_base import color_map
from foldwing.studies.flutter import flutter_study

ENERGY = {"flutter-energy", "flutter-energy-modes"}
PRESSURE = {"flutter-pressure", "flutter-pressure-modes", "flutter-circulation"}
LOADS = ENERGY | PRESSURE
MESH = {"chordwise": 3, "spanwise": 6, "wake": 4.0}


def study(aerodynamics, example="three-segment", folds=(30.0, -75.0), highest=60.0):
    wing = read_model(example).with_analysis(system_modes=6).with_lattice(**MESH)
    model = AeroelasticWing(wing, aerodynamics)
    speeds = np.linspace(0.0, 20.0, 3)
    return flutter_study(model, folds, speeds=speeds, highest=highest)[0]


@pytest.fixture(name="lattice", scope="module")
def _lattice():
    return study("lattice")


def loads_among(dataset):
    return {p.name: p for p in pictures(dataset) if p.name in LOADS}


def test_loads_are_read_as_they_were_written(lattice, tmp_path):
    results.write_dataset(lattice, tmp_path / "dataset.nc")
    read = results.read_dataset(tmp_path / "dataset.nc")
    xarray.testing.assert_identical(read, lattice)
    assert read["pressure"].dtype.kind == "c"
    assert read["pressure"].attrs["amplitude"] == pytest.approx(0.0005)
    assert read["pressure"].shape == (lattice.sizes["flutter_point"], 18)


def test_leading_modes_carry_most_of_the_motion_and_of_the_pressure(lattice):
    index = lattice["mode_pressure"].attrs["flutter_point"]
    assert (lattice["kind"][index], lattice["event"][index]) == ("flutter", "onset")
    shares = lattice["mode_share"].values[index]
    leading = lattice["leading_mode"].values - 1
    assert shares[leading].tolist() == sorted(shares, reverse=True)[: len(leading)]
    left = lattice["pressure"].values[index] - lattice["mode_pressure"].values.sum(axis=0)
    assert np.abs(left).max() < 0.1 * np.abs(lattice["pressure"].values[index]).max()


def test_energy_is_that_of_the_mass_in_the_motion_of_the_stated_amplitude(lattice):
    """Mass times mean square of velocity, by Simpson's rule on the points of the shapes."""
    simpson_y = np.array([1.0, *[4.0, 2.0] * 4, 4.0, 1.0]) / 30.0
    weights = np.outer(simpson_y, np.array([1.0, 4.0, 1.0]) / 6.0).ravel()
    mass = np.concatenate(
        [1145.0 * 0.0015875 * 0.05 * span * weights for span in (0.14, 0.1, 0.06)]
    )
    amplitude = lattice["kinetic_energy"].attrs["amplitude"]
    square = (np.abs(amplitude * lattice["flutter_shape"].values) ** 2).sum(axis=2)
    omega = 2.0 * np.pi * lattice["flutter_frequency"].values
    flutter = lattice["kind"].values == "flutter"
    energy = 0.5 * omega**2 * (square @ mass)
    assert lattice["kinetic_energy"].values[flutter] == pytest.approx(energy[flutter], rel=0.02)


def test_every_picture_of_loads_is_drawn_by_both_renderers(lattice):
    from plotly import graph_objects

    assert set(loads_among(lattice)) == LOADS
    for theme in THEMES:
        assert set(plots.static_figures(lattice, theme)) >= LOADS
        for _, caption, figure in plots.interactive_figures(lattice, theme):
            assert graph_objects.Figure(figure).data
            assert caption.endswith(".")
            assert "@" not in json.dumps(figure)


@pytest.mark.parametrize("aerodynamics", ["strip", "quasi-steady"])
def test_strip_theory_shows_energy_but_no_pressure(aerodynamics):
    dataset = study(aerodynamics, folds=(30.0, 60.0))
    assert set(loads_among(dataset)) <= ENERGY
    assert dataset["work"].shape == (dataset.sizes["flutter_point"], 3)
    assert "pressure" not in dataset


def test_a_wing_of_one_segment_has_no_segments_to_compare():
    names = set(loads_among(study("strip", "goland", (), 200.0)))
    assert names == {"flutter-energy-modes"}


def test_without_flutter_there_is_nothing_to_draw():
    dataset = study("lattice", highest=15.0)
    assert dataset.sizes["flutter_point"] == 0
    assert dataset["pressure"].shape == (0, 18)
    assert loads_among(dataset) == {}


def test_bars_show_the_work_in_parts_of_the_energy(lattice):
    axes = draw(loads_among(lattice)["flutter-energy"]).axes[0]
    speeds = np.where(
        (lattice["kind"] == "flutter") & (lattice["event"] == "onset"),
        lattice["flutter_speed"],
        np.inf,
    )
    first = int(np.argmin(speeds))
    share = 100.0 * lattice["work"].values[first] / float(lattice["kinetic_energy"][first])
    bars = {round(bar.get_y() + bar.get_height() / 2.0): bar.get_width() for bar in axes.patches}
    assert [bars[-segment] for segment in range(3)] == pytest.approx(share.tolist())
    assert bars[-3] == pytest.approx(0.0, abs=1e-8)
    texts = [text.get_text() for text in axes.texts]
    assert "0 %" in texts
    assert [text.startswith("−") for text in texts[1:4]] == (share < 0.0).tolist()


def test_every_panel_has_one_colour(lattice):
    picture = loads_among(lattice)["flutter-pressure"]
    meshes = [trace for trace in plotly_figure(picture)["data"] if trace["type"] == "mesh3d"]
    assert sum(len(trace["intensity"]) for trace in meshes) == 2 * 2 * 18
    corners = np.stack([meshes[0][letter] for letter in "xyz"], axis=1)
    triangles = corners[np.stack([meshes[0][letter] for letter in "ijk"], axis=1)]
    sides = triangles[:, 1:] - triangles[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum() / 2.0
    assert area == pytest.approx(0.14 * 0.05)
    bars = [trace["colorbar"]["title"]["text"] for trace in meshes if trace["showscale"]]
    assert bars == ["pressure, below less above (Pa)", "phase, ahead of the motion (degrees)"]
    faces = draw(picture).axes[0].collections[0]
    assert len(faces.get_facecolor()) == 18


@pytest.mark.parametrize("theme", THEMES)
def test_the_colours_of_an_angle_end_as_they_start(theme):
    cycle = color_map("cycle", THEMES[theme])
    assert cycle(0.0) == cycle(1.0)
    assert len({cycle(turn) for turn in (0.0, 0.25, 0.5, 0.75)}) == 4


def test_the_caption_of_the_circulation_speaks_of_circulation(lattice):
    caption = loads_among(lattice)["flutter-circulation"].caption
    assert "the circulation is highest" in caption
    assert "pressure" not in caption
