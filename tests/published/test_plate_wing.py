"""The three-segment wing of plates against printed natural frequencies."""

import numpy as np
import pytest

from foldwing.model import read_model
from foldwing.structure.assembly import assemble
from foldwing.structure.modes import natural_modes

PRINTED = (4.58, 22.9, 23.4, 57.3, 73.4, 114.0)
"""I. Wang, PhD dissertation, Duke University, 2013, chapter 2: plate finite elements of a
commercial code, ten modes per segment, fold angles (30, -30) degrees."""


def frequencies(count):
    wing = read_model("three-segment-plate").with_analysis(plate_modes=count)
    return natural_modes(assemble(wing), count=6).frequencies


def test_natural_frequencies_with_ten_modes_per_segment():
    """Within 2 %: the printed digits leave 0.2 % open, and another element has other modes."""
    assert frequencies(10) == pytest.approx(PRINTED, rel=0.02)


def test_frequencies_fall_with_the_number_of_modes():
    """Ritz: a larger basis that holds the smaller one never raises a frequency."""
    found = np.array([frequencies(count) for count in (6, 10, 14, 20)])
    assert np.all(np.diff(found, axis=0) < 0.0)
