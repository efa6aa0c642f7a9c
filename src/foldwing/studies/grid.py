"""Ranges, fold angles and airspeeds: what the user asks for as a grid of cases."""

import itertools
import math
from collections.abc import Mapping, Sequence

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model import Wing

LEVEL = "level"
"""Fold that keeps a segment parallel to segment 1."""

_FOLD_REMEDY = (
    "Give an angle in degrees, start:stop:step such as 0:150:2.5, a list such as 0,60,90, or level."
)

MOST_VALUES = 100_000
"""Values of a range or cases of a grid above which a typing error is more likely than a wish."""


def parse_range(text: str, field: str, remedy: str = "") -> tuple[float, ...]:
    """Return the values of a number, of ``"start:stop:step"``, or of a list of both.

    The stop is included, the order of a list is kept, and a value given twice counts once.

    Parameters
    ----------
    text : str
        As the user wrote it, for example ``"0:150:2.5"`` or ``"0,60,90,120"``.
    field : str
        Where it stands, for messages.
    remedy : str, optional
        How to write it, for messages.

    Raises
    ------
    InputError
        When the text is empty, not a number, not finite, reversed, or has a step of zero.
    """
    remedy = remedy or "Give one number, start:stop:step such as 0:150:2.5, or a list 0,60,90."
    values = (value for part in text.split(",") for value in _part(part, field, text, remedy))
    return tuple(dict.fromkeys(values))


def _part(part: str, field: str, text: str, remedy: str) -> tuple[float, ...]:
    """Return the values of one part of a list: a number or a range."""
    words = part.split(":")
    if len(words) not in (1, 3):
        raise InputError(field, text, "must be a number, start:stop:step or a list", remedy)
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        raise InputError(field, text, "must be made of numbers", remedy) from None
    if not all(math.isfinite(number) for number in numbers):
        raise InputError(field, text, "must be finite", remedy)
    return (numbers[0],) if len(numbers) == 1 else _values(*numbers, field=field, text=text)


def _values(start: float, stop: float, step: float, *, field: str, text: str) -> tuple[float, ...]:
    if step == 0.0:
        raise InputError(field, text, "the step must not be zero", "Give a step such as 2.5.")
    count = (stop - start) / step
    if count < -1e-9:
        remedy = f"Write {min(start, stop):g}:{max(start, stop):g}:{abs(step):g}."
        raise InputError(field, text, "the step must lead from start to stop", remedy)
    if count > MOST_VALUES:
        remedy = "Give a larger step."
        raise InputError(field, text, f"must have at most {MOST_VALUES} values", remedy)
    values = [start + i * step for i in range(int(count + 1e-9) + 1)]
    if abs(values[-1] - stop) > 1e-9 * abs(step):
        values.append(stop)
    return tuple(round(value, 12) for value in values)


def parse_folds(text: str, wing: Wing) -> tuple[float, ...]:
    """Return psi_2..psi_N in degrees from ``"30,-75"``.

    Raises
    ------
    InputError
        When the wing has no hinge, or the numbers are not as many as its hinges.
    """
    _require_hinges(wing, "--fold", text)
    hinges = len(wing.hinges)
    limit = f"must be {hinges} angles in degrees, one for each hinge"
    remedy = "Write them from root to tip, separated by commas: --fold 30,-75."
    try:
        angles = tuple(float(part) for part in text.split(","))
    except ValueError:
        raise InputError("--fold", text, limit, remedy) from None
    if len(angles) != hinges or not all(math.isfinite(angle) for angle in angles):
        raise InputError("--fold", text, limit, remedy)
    return angles


def _require_hinges(wing: Wing, field: str, value: object) -> None:
    if not wing.hinges:
        limit = "this wing has one segment and no hinge"
        raise InputError(field, value, limit, "Leave the option out.")


def fold_cases(
    wing: Wing, fold: str | None = None, by_hinge: Mapping[int, str] | None = None
) -> list[tuple[float, ...]]:
    """Return the fold angles in degrees of every case of a full grid, the first hinge slowest.

    Parameters
    ----------
    wing : Wing
    fold : str, optional
        ``"30,-75"``: angles of all hinges instead of the wing's own.
    by_hinge : mapping of int to str, optional
        For hinge I (from 2): a number, a range, a list or ``level``.
    """
    base = [math.degrees(angle) for angle in wing.fold_angles]
    angles = list(parse_folds(fold, wing)) if fold is not None else [round(a, 10) for a in base]
    choices: list[tuple[float | str, ...]] = [(angle,) for angle in angles]
    for hinge, text in (by_hinge or {}).items():
        field = f"--fold{hinge}"
        _require_hinges(wing, field, text)
        if not 2 <= hinge <= wing.count:
            limit = f"this wing has the hinges 2 to {wing.count}"
            raise InputError(field, text, limit, "Hinge I joins segments I-1 and I.")
        level = text.strip().lower() == LEVEL
        choices[hinge - 2] = (LEVEL,) if level else parse_range(text, field, _FOLD_REMEDY)
    total = math.prod(len(choice) for choice in choices)
    if total > MOST_VALUES:
        remedy = "Give larger steps, or sweep fewer hinges at once."
        limit = f"a grid may have at most {MOST_VALUES} cases"
        raise InputError("--fold-of", f"{total} cases", limit, remedy)
    return [_levelled(case) for case in itertools.product(*choices)]


def _levelled(case: Sequence[float | str]) -> tuple[float, ...]:
    angles: list[float] = []
    for angle in case:
        angles.append(-math.fsum(angles) if isinstance(angle, str) else angle)
    return tuple(0.0 if angle == 0.0 else angle for angle in angles)


def swept_hinge(cases: Sequence[tuple[float, ...]]) -> int | None:
    """Return the first hinge (from 2) whose angle varies over the cases, None when none does."""
    for hinge, angles in enumerate(zip(*cases, strict=True), start=2):
        if len(set(angles)) > 1:
            return hinge
    return None


def radians(folds: Sequence[float]) -> tuple[float, ...]:
    """Return fold angles in radians."""
    return tuple(math.radians(angle) for angle in folds)


def parse_speeds(text: str, unit: str = "m/s") -> Real:
    """Return airspeeds in m/s, or another unit, ascending and not negative.

    Raises
    ------
    InputError
        When a speed is negative, they do not ascend, or none is above zero.
    """
    remedy = f"Write start:stop:step in {unit} from 0 upwards, such as 0:60:1."
    speeds = parse_range(text, "--speeds", remedy)
    if list(speeds) != sorted(speeds):
        raise InputError("--speeds", text, "must ascend", remedy)
    if speeds[0] < 0.0 or speeds[-1] <= 0.0:
        raise InputError("--speeds", text, f"must not be negative or only 0 {unit}", remedy)
    return np.array(speeds)
