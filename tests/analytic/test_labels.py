"""Labels of pictures: in their panel, off the rules, where they cover least."""

import numpy as np
import pytest

from foldwing.plots.layout import end_labels, upright_labels
from foldwing.plots.placing import Paper, clearest


@pytest.mark.parametrize("count", [3, 13, 40])
def test_labels_at_line_ends_stay_in_their_panel(count):
    ends = [(-40.0 + 0.1 * i, f"B{i}", "ink") for i in range(count)]
    heights = [note.y for note in end_labels(ends, 1.0, (-40.0, 20.0), height=1.1)]
    assert len(heights) == count and min(heights) >= -40.0 and max(heights) <= 20.0
    gap = min(0.15, 2.8 / count) / (1.1 * 2.6) * 60.0
    assert np.diff(sorted(heights)).min() >= gap


def test_upright_labels_keep_off_every_rule_and_in_the_panel():
    rules = [(39.2, "a", "ink"), (40.4, "b", "ink"), (41.1, "c", "ink"), (41.2, "d", "ink")]
    labels = upright_labels(rules, 0.0, (0.0, 41.5), 2.7)
    inch = 41.5 / 2.7
    places = {note.text: note.x for note in labels}
    assert sorted(places, key=places.get) == ["a", "b", "c", "d"]
    assert np.diff(sorted(places.values())).min() >= 0.15 * inch
    for x in places.values():
        assert 0.0 < x < 41.5 and min(abs(x - at) for at, *_ in rules) > 0.07 * inch


def test_a_text_covers_no_line_when_there_is_room_beside_it():
    paper = Paper((0.0, 10.0), (0.0, 1.0), 5.0, 2.0)
    line = paper.along(np.array([0.0, 10.0]), np.array([0.5, 0.5]))
    boxes = [(1.0, 0.95, 2.0, 1.1), (4.8, 1.2, 5.8, 1.35), (1.0, 1.1, 2.0, 1.25)]
    assert clearest(boxes, line, [], paper) == 2
    assert clearest(boxes, line, [boxes[2]], paper) == 0
