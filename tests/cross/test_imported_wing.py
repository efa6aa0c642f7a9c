"""A folding wing whose segments are imported modes, against the same wing of beam functions."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from foldwing.model import Hinge, HingeKind, Wing
from foldwing.structure.assembly import Assembly
from foldwing.structure.component import Root
from foldwing.structure.imported import imported_modes
from foldwing.structure.mode_files import read_modes, write_modes
from foldwing.structure.modes import natural_modes
from support.mode_sets import SEGMENT, beam, beam_mode_set, body, grid, outline

HINGE = Hinge(kind=HingeKind.SPRING, stiffness=0.1)
FOLDS = ((0.0, 0.0), (0.5, -1.1))
ROOTS = (Root.CLAMPED, Root.FREE, Root.FREE)


def wing_of(*components) -> Assembly:
    wing = Wing(segments=(SEGMENT,) * len(components), hinges=(HINGE,) * (len(components) - 1))
    return Assembly(wing, components)


def imported(root: Root, along: int, across: int, count=None):
    modes = beam_mode_set(root, points=grid(along=along, across=across), count=None)
    return imported_modes(modes, outline(), 0.5, body(), root, count)


def through_the_same_modes(along: int, across: int, folds) -> float:
    """Largest relative difference of the first eight frequencies."""
    ours = wing_of(*(imported(root, along, across) for root in ROOTS))
    theirs = wing_of(*(beam(root) for root in ROOTS))
    f, reference = (natural_modes(each, folds, 8).frequencies for each in (ours, theirs))
    return float(np.abs(f / reference - 1.0).max())


@pytest.mark.parametrize("folds", FOLDS)
def test_frequencies_of_the_wing_converge_to_those_of_beam_functions(folds) -> None:
    errors = [through_the_same_modes(*points, folds) for points in ((16, 3), (31, 5), (61, 9))]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 5e-3


def test_through_a_file_in_other_axes_and_units(tmp_path: Path) -> None:
    """What a wing takes from a file is what it takes from memory."""
    modes = beam_mode_set(Root.FREE, points=grid(along=21, across=5))
    write_modes(replace(modes, points=modes.points * 1e3), tmp_path / "modes.csv")
    back = read_modes(tmp_path / "modes.csv", length_unit=1e-3)
    direct, read = (imported_modes(m, outline(), 0.5, body(), Root.FREE) for m in (modes, back))
    x, y = np.array([0.02, -0.05]), np.array([0.0, 0.3])
    assert read.slopes(x, y) == pytest.approx(direct.slopes(x, y), rel=1e-9, abs=1e-9)
    assert read.mass == pytest.approx(direct.mass)


def test_names_of_modes_are_those_of_the_beam_wing() -> None:
    ours = wing_of(*(imported(root, 31, 7) for root in ROOTS))
    theirs = wing_of(*(beam(root) for root in ROOTS))
    names = [natural_modes(each, (0.0, 0.0), 8).names for each in (ours, theirs)]
    assert names[0] == names[1]


def test_momentum_of_the_joined_wing() -> None:
    """A hinged free segment carries its mass exactly, whatever its elastic modes are."""
    few = wing_of(imported(Root.CLAMPED, 31, 7), imported(Root.FREE, 31, 7, count=1))
    q = np.zeros(few.size)
    q[few.slices[1].start] = 1.0  # segment 2 moves up as a whole
    assert q @ few.mass @ q == pytest.approx(SEGMENT.mass_per_span * SEGMENT.span)
