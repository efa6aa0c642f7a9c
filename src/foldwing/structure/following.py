"""Natural modes followed through a sequence of fold angles, so that curves stay continuous.

Segment coordinates do not turn with the fold, therefore the mass-weighted MAC compares modes at
different fold angles directly. Where two consecutive cases are too different to match beyond doubt,
the way between them is halved until they are not, or until the fold changes by less than a
hundredth of a degree: there modes veer rather than cross, and the confidence says so.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from foldwing.conventions import DEGREE
from foldwing.maths.arrays import Real
from foldwing.structure.assembly import Assembly
from foldwing.structure.modes import StructuralModes, modal_assurance, natural_modes

CLEAR_MATCH = 0.9
"""MAC above which a match is beyond doubt."""

SMALLEST_FOLD_STEP = 0.01 * DEGREE

SPARE_MODES = 6
"""Modes above the wanted ones, so that those that cross the upper end are not lost."""


@dataclass(frozen=True)
class FollowedModes:
    """Modes of one case, in the order of the branches of the sequence.

    Attributes
    ----------
    modes : StructuralModes
    confidence : array, shape (n,)
        Smallest MAC on the way from the previous case; 1 for the first.
    """

    modes: StructuralModes
    confidence: Real


def follow_modes(
    assembly: Assembly, fold_angles: Sequence[tuple[float, ...]], count: int | None = None
) -> list[FollowedModes]:
    """Return the modes of every case in matched order.

    Parameters
    ----------
    assembly : Assembly
    fold_angles : sequence of tuple of float
        psi_2 .. psi_N in radians of each case.
    count : int, optional
        Number of modes; the analysis' ``system_modes`` by default.
    """
    wanted = assembly.wing.analysis.system_modes if count is None else count
    solved = wanted + SPARE_MODES
    first = natural_modes(assembly, fold_angles[0], solved)
    wanted = min(wanted + len(first.rigid_labels), first.count)
    result = [FollowedModes(first, np.ones(first.count))]
    for folds in fold_angles[1:]:
        result.append(_next(result[-1].modes, folds, solved))
    kept = np.arange(wanted)
    return [FollowedModes(case.modes.only(kept), case.confidence[:wanted]) for case in result]


def _next(previous: StructuralModes, folds: tuple[float, ...], count: int) -> FollowedModes:
    direct = _matched(previous, natural_modes(previous.assembly, folds, count))
    step = np.subtract(folds, previous.fold_angles)
    small = float(np.abs(step).max(initial=0.0)) < SMALLEST_FOLD_STEP
    if small or direct.confidence[: previous.count - SPARE_MODES].min(initial=1.0) > CLEAR_MATCH:
        return direct
    middle = tuple(float(angle) for angle in np.add(previous.fold_angles, step / 2.0))
    halfway = _next(previous, middle, count)
    rest = _next(halfway.modes, folds, count)
    return FollowedModes(rest.modes, np.minimum(halfway.confidence, rest.confidence))


def _matched(previous: StructuralModes, current: StructuralModes) -> FollowedModes:
    mac = modal_assurance(previous, current)
    rows, columns = linear_sum_assignment(-mac)
    return FollowedModes(current.only(columns), mac[rows, columns])
