"""Airspeeds below which a lattice does not resolve all modes are marked in the pictures."""

import numpy as np

from foldwing.plots.boundary import boundary
from foldwing.plots.loci import against_speed
from foldwing.plots.picture import Line, Rule
from support import datasets


def with_unresolved(dataset, lowest):
    """The dataset of a lattice that resolves its modes from ``lowest`` on, case by case."""
    names = np.where(np.isfinite(lowest), "T2, B4", "")
    return dataset.assign(
        uncertified_modes=("fold", names),
        valid_from=("fold", np.where(np.isfinite(lowest), lowest, 1.0)),
    )


def dotted_lines(panel):
    return [item for item in panel.items if isinstance(item, Line) and "not resolved" in item.label]


def dotted_rules(panel):
    return [item.at for item in panel.items if isinstance(item, Rule) and item.dash == "dot"]


def test_boundary_shows_the_limit_of_each_case():
    plain = datasets.boundary_dataset()
    assert dotted_lines(boundary(plain).panels[0]) == []
    cases = plain.sizes["fold"]
    lowest = np.where(np.arange(cases) < 3, np.nan, np.linspace(10.0, 12.0, cases))
    speed, frequency, strength = boundary(with_unresolved(plain, lowest)).panels
    (line,) = dotted_lines(speed)
    order = np.argsort(line.x)
    np.testing.assert_allclose(np.sort(line.y[order]), np.sort(lowest))
    assert dotted_lines(frequency) == dotted_lines(strength) == []


def test_curves_show_the_limit_when_it_is_in_view():
    plain = datasets.flutter_dataset()
    assert dotted_rules(against_speed(plain).panels[0]) == []
    for lowest, marks in ((7.5, [7.5]), (1e3, [])):
        picture = against_speed(with_unresolved(plain, np.array([lowest])))
        assert [dotted_rules(panel) for panel in picture.panels] == [marks, marks]
        assert ("resolves all modes" in picture.caption) == bool(marks)
