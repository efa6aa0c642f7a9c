"""Pictures of flight: arrows on paper, both renderers, nothing drawn of what is not there."""

import json

import numpy as np
import pytest

from foldwing import plots
from foldwing.plots.catalogue import pictures
from foldwing.plots.flight import _ARROW, _SIZE, flight_paths, flight_paths_relative
from foldwing.plots.flight_modes import flight_against_speed, flight_eigenvalues
from foldwing.plots.picture import Line, Marks, Note
from foldwing.results.flight_summary import flight_answer
from foldwing.studies.flight import flight_study
from support.aircraft import airframe
from support.datasets import modes_dataset

SPEEDS = (30.0, 42.0, 54.0)


@pytest.fixture(name="dataset", params=[0.0, 0.6], ids=["stable", "unstable"])
def _dataset(request):
    craft = airframe(centre_of_gravity=request.param)
    return flight_study(craft, speeds=SPEEDS).dataset


@pytest.fixture(name="turning")
def _turning():
    """At the lowest airspeed alone the phugoid is real, beside an oscillation."""
    craft = airframe(centre_of_gravity=0.65)
    return flight_study(craft, speeds=(20.0, *SPEEDS[1:])).dataset


def on_paper(panel, x, y):
    """Points in inches."""
    scale = [
        size / np.ptp(ends)
        for size, ends in zip(_SIZE, (panel.x_range, panel.y_range), strict=True)
    ]
    return np.stack([x * scale[0], y * scale[1]], axis=1)


def shafts(panel):
    """Tail and tip of every arrow in inches, shape (n, 2, 2)."""
    (line,) = [item for item in panel.items if isinstance(item, Line) and "pitch" in item.label]
    return on_paper(panel, line.x, line.y).reshape(-1, 6, 2)[:, :2]


def test_arrows_have_one_length_on_paper(dataset):
    for picture in (flight_paths(dataset), flight_paths_relative(dataset)):
        for panel in picture.panels:
            ends = shafts(panel)
            assert len(ends) == 13
            assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) == pytest.approx(_ARROW)


def test_arrows_lie_along_the_path_of_a_phugoid_over_the_ground(dataset):
    """The angle of attack hardly changes in it."""
    panel = flight_paths(dataset).panels[0]
    path = next(item for item in panel.items if isinstance(item, Line) and item.name == "phugoid")
    points = on_paper(panel, path.x, path.y)
    along = np.gradient(points, axis=0)[::16]
    ends = shafts(panel)
    arrows = ends[:, 1] - ends[:, 0]
    angle = [np.arctan2(v[:, 1], v[:, 0]) for v in (along, arrows)]
    assert np.degrees(np.abs(angle[1] - angle[0])[1:-1]).max() < 6.0


def test_relative_panels_have_one_scale(dataset):
    for panel in flight_paths_relative(dataset).panels:
        metres = [np.ptp(panel.x_range) / _SIZE[0], np.ptp(panel.y_range) / _SIZE[1]]
        assert metres[0] == pytest.approx(metres[1])
        texts = [text for _, text in panel.x_ticks]
        assert 2 <= len(texts) <= 6 and len(set(texts)) == len(texts)


def test_everything_lies_within_its_panel(dataset):
    for picture in pictures(dataset):
        for panel in picture.panels:
            for item in panel.items:
                if isinstance(item, Line | Marks):
                    for values, ends in ((item.x, panel.x_range), (item.y, panel.y_range)):
                        known = np.asarray(values)[np.isfinite(values)]
                        assert (known >= ends[0]).all() and (known <= ends[1]).all()


def test_a_panel_for_each_mode(dataset):
    motions = dataset.sizes["flight_motion"]
    assert len(flight_paths(dataset).panels) == motions
    modes = len(set(dataset["swept_mode"].values.ravel()) - {""})
    assert len(flight_eigenvalues(dataset).panels) == modes
    assert len(flight_against_speed(dataset).panels) == 2 * modes + 2


def test_every_eigenvalue_of_a_few_airspeeds_has_a_mark(turning):
    panels = flight_eigenvalues(turning).panels
    assert len(panels) == 3
    for panel in panels:
        (mode,) = [item.text for item in panel.items if isinstance(item, Note)]
        marks = [item for item in panel.items if isinstance(item, Marks)]
        names = ("swept_mode", "swept_eigenvalue"), ("flight_mode", "flight_eigenvalue")
        found = [turning[v].values[turning[m].values == mode] for m, v in names]
        assert sum(np.isfinite(mark.x).sum() for mark in marks) == sum(
            int((values.imag >= 0.0).sum()) for values in found
        )


def test_no_line_joins_a_real_root_to_an_oscillation(turning):
    panels = flight_eigenvalues(turning).panels
    panels += [p for p in flight_against_speed(turning).panels if p.y_label.startswith("freq")]
    lines = [item for panel in panels for item in panel.items if isinstance(item, Line)]
    for line in lines:
        pairs = np.stack([line.y[:-1], line.y[1:]])
        oscillates = pairs[:, np.isfinite(pairs).all(axis=0)] > 0.0
        np.testing.assert_array_equal(oscillates[0], oscillates[1])


def test_an_oscillation_has_one_line_for_each_model(dataset):
    for panel in flight_eigenvalues(dataset).panels:
        lines = [item for item in panel.items if isinstance(item, Line)]
        drawn = [(i.color, *i.x.tolist()) for i in lines if np.isfinite(i.x).sum() > 1]
        assert drawn and len(set(drawn)) == len(drawn)
    for panel in flight_against_speed(dataset).panels[:-2]:
        lines = [item for item in panel.items if isinstance(item, Line)]
        drawn = [(i.color, *i.y.tolist()) for i in lines if np.isfinite(i.y).sum() > 1]
        assert drawn and len(set(drawn)) == len(drawn)


def test_the_caption_says_that_the_product_hardly_changes_only_when_it_does(dataset):
    assert "hardly changes" in flight_against_speed(still(dataset, 1.02)).caption
    assert "hardly changes" not in flight_against_speed(still(dataset, 1.15)).caption


def still(dataset, end):
    """The dataset with products that rise from 13 to so many times that."""
    shape = dataset["phugoid_product"].shape
    product = 13.0 * np.linspace(1.0, end, shape[1]) * np.ones(shape)
    return dataset.assign(phugoid_product=(dataset["phugoid_product"].dims, product))


def test_the_answer_names_each_mode_once(dataset):
    answer = flight_answer(dataset)
    for mode in set(dataset["flight_mode"].values[0]) - {""}:
        assert answer.lower().count(f"the {mode}") == 1


def test_two_real_roots_are_told_together(turning):
    first = turning.isel(flight_model=0)
    modes, values = first["flight_mode"].values, first["flight_eigenvalue"].values
    assert (values[modes == "short period"].imag == 0.0).sum() == 2
    answer = flight_answer(turning)
    assert "the short period does not oscillate but has two aperiodic motions: one " in answer
    assert answer.count("short period") == 1


def test_both_renderers_draw(dataset):
    from plotly import graph_objects

    for title, caption, figure in plots.interactive_figures(dataset, "dark"):
        assert title and caption.endswith(".")
        assert graph_objects.Figure(figure).data
        assert "NaN" not in json.dumps(figure)
    names = ["flight-eigenvalues", "flight-against-speed", "flight-paths", "flight-paths-relative"]
    assert list(plots.static_figures(dataset)) == names


def test_other_datasets_have_none_of_these():
    makers = (flight_paths, flight_paths_relative, flight_eigenvalues, flight_against_speed)
    assert [make(modes_dataset()) for make in makers] == [None] * 4
