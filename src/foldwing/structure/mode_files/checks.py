"""What a set of modes must fulfil before anything is computed from it."""

from typing import TYPE_CHECKING

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Mask, Real

if TYPE_CHECKING:
    from foldwing.structure.mode_files.mode_set import ModeSet

INDEPENDENT = 1e-6
"""Smallest singular value of the shapes, each of norm 1, relative to the largest."""

MOST_MODES = 1000
MOST_POINTS = 100_000

LARGEST = 1e15
"""Largest number, in SI units: beyond it squares and products get lost."""

_SAME_PLACE = 1e-9
"""Distance of points in one place, as a share of the extent of all."""

_SAME_MOTION = 1e-6
"""Difference of equal displacements, as a share of the largest of the shape."""


def check_mode_set(modes: "ModeSet") -> None:
    """Raise `InputError` unless the modes can be those of a structure.

    Numbers are finite, frequencies not negative, modal masses positive, damping ratios unknown or
    from 0 to 1; points have different names, and points in one place move together; no shape is
    zero or follows from the others.
    """
    _check_sizes(modes)
    _check_numbers(modes)
    _check_points(modes)
    _check_shapes(modes)


def _check_sizes(modes: "ModeSet") -> None:
    m, k = np.size(modes.frequencies), len(modes.points)
    for count, most, what in ((m, MOST_MODES, "modes"), (k, MOST_POINTS, "points")):
        if not 0 < count <= most:
            limit = f"must be 1 to {most}"
            remedy = f"Export fewer {what}." if count else f"The file needs {what}."
            raise InputError(f"{modes.source}: number of {what}", count, limit, remedy)
    expected = {
        "frequencies": (m,),
        "modal_mass": (m,),
        "damping": (m,),
        "complexity": (m,),
        "points": (k, 3),
        "shapes": (m, k, 3),
    }
    for name, shape in expected.items():
        given = np.shape(getattr(modes, name))
        if given != shape:
            limit = f"must have the shape {shape} for {m} modes and {k} points"
            raise InputError(f"{modes.source}: {name}", given, limit, "Complete the file.")
    if len(modes.names) != k:
        limit = f"must be {k}, one for each point"
        raise InputError(f"{modes.source}: names", len(modes.names), limit, "Name every point.")


def _check_numbers(modes: "ModeSet") -> None:
    damping = modes.damping
    rows: tuple[tuple[str, Real, Mask, str, str], ...] = (
        (
            "frequency",
            modes.frequencies,
            (modes.frequencies >= 0.0) & (modes.frequencies < LARGEST),
            f"must be in Hz, at least 0 and below {LARGEST:g}",
            "Correct it or leave the mode out.",
        ),
        (
            "modal mass",
            modes.modal_mass,
            (modes.modal_mass > 0.0) & (modes.modal_mass < LARGEST),
            f"must be in kg, greater than 0 and below {LARGEST:g}",
            "Give the modal mass that belongs to the shape, or modal_mass=1.0 when the shapes are "
            "normalised to unit modal mass.",
        ),
        (
            "damping",
            damping,
            np.isnan(damping) | ((damping >= 0.0) & (damping < 1.0)),
            "must be a ratio from 0 to 1, or empty",
            "Correct it or leave it empty.",
        ),
        (
            "phase scatter",
            modes.complexity,
            (modes.complexity >= 0.0) & (modes.complexity <= 90.0),
            "must be from 0 to 90 degrees",
            "Write 0 for real shapes.",
        ),
    )
    for what, values, good, limit, remedy in rows:
        if not good.all():
            mode = int(np.argmin(good))
            field = f"{modes.source}: mode {mode + 1}: {what}"
            raise InputError(field, float(values[mode]), limit, remedy)


def _check_points(modes: "ModeSet") -> None:
    from scipy.spatial import cKDTree

    bad = ~(np.abs(modes.points) < LARGEST)
    if bad.any():
        point, axis = (int(i) for i in np.argwhere(bad)[0])
        field = f"{modes.source}: point {modes.names[point]}: {'xyz'[axis]}"
        value = float(modes.points[point, axis])
        limit = f"must be in m, finite and below {LARGEST:g}"
        raise InputError(field, value, limit, "Correct the coordinate.")
    seen: set[str] = set()
    for name in modes.names:
        if name in seen:
            limit = "must stand once"
            raise InputError(f"{modes.source}: point", name, limit, "Rename or remove one of them.")
        if not name or name != name.strip() or not name.isprintable() or name.startswith("#"):
            limit = "must be printable text in one line, and not begin with # or a space"
            raise InputError(f"{modes.source}: point", name, limit, "Rename it.")
        seen.add(name)
    tree, scale = cKDTree(modes.points), np.abs(modes.shapes).max(axis=(1, 2))
    for i, j in sorted(tree.query_pairs(_SAME_PLACE * float(np.ptp(modes.points, axis=0).max()))):
        apart = np.abs(modes.shapes[:, i] - modes.shapes[:, j]).max(axis=1)
        if np.any(apart > _SAME_MOTION * scale):
            limit = "are in one place and must move together"
            pair = f"{modes.names[i]} and {modes.names[j]}"
            remedy = "Remove one of them, or correct its coordinates."
            raise InputError(f"{modes.source}: points", pair, limit, remedy)


def _check_shapes(modes: "ModeSet") -> None:
    bad = ~(np.abs(modes.shapes) < LARGEST)
    if bad.any():
        mode, point, axis = (int(i) for i in np.argwhere(bad)[0])
        field = f"{modes.source}: mode {mode + 1}: point {modes.names[point]}: u{'xyz'[axis]}"
        value = float(modes.shapes[mode, point, axis])
        limit = f"must be finite and below {LARGEST:g}"
        raise InputError(field, value, limit, "Correct the shape or leave it out.")
    largest = np.abs(modes.shapes).max(axis=(1, 2))
    if not largest.all():
        mode = int(np.argmin(largest))
        limit = "must move at least one point"
        remedy = "Leave the mode out, or add points that it moves."
        raise InputError(f"{modes.source}: mode {mode + 1}: shape", 0.0, limit, remedy)
    _check_independence(modes, modes.shapes.reshape(modes.count, -1) / largest[:, None])


def _check_independence(modes: "ModeSet", rows: Real) -> None:
    rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    values = np.linalg.svd(rows, compute_uv=False)
    smallest = float(values[-1] / values[0]) if len(values) == len(rows) else 0.0
    moving = int(np.any(modes.shapes != 0.0, axis=0).sum())
    if len(rows) <= moving and smallest >= INDEPENDENT:
        return
    alike = np.abs(rows @ rows.T) - np.eye(len(rows))
    first, other = (int(i) + 1 for i in np.unravel_index(np.argmax(alike), alike.shape))
    limit = (
        f"must be at least {INDEPENDENT:g} for independent shapes of {len(rows)} modes in "
        f"{moving} moving directions of points; most alike are modes {first} and {other}, with a "
        f"cosine of {alike.max():.6f}"
    )
    remedy = (
        "Leave one of them out, read fewer modes with count, or add points that tell them apart."
    )
    field = f"{modes.source}: shapes, smallest singular value relative to the largest"
    raise InputError(field, smallest, limit, remedy)
