"""The folded wing in space: shapes of its modes, and its motion at flutter."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.plots import bodies
from foldwing.plots.layout import subject, subtitle
from foldwing.plots.picture import Array, Picture, Range, Scene, SceneItem, Surface, Tag, Thread
from foldwing.results.cases import fold_text
from foldwing.results.flutter_table import FlutterRow, flutter_rows

if TYPE_CHECKING:
    import xarray

_MOST_MODES = 6
_AMPLITUDE = 0.16
"""Largest displacement drawn, as a share of the size of the wing."""
_NOTHING = 1e-9
"""Share of a motion that is round-off."""
_PHASES = 6
_FRAMES = 24
_PER_SEGMENT = tuple[Array, ...]


def mode_shapes(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the first six mode shapes, of the case in the middle of a sweep.

    Those of an aircraft come after its rigid motions. Circles are the centres of mass.
    """
    if "mode_shape" not in dataset or "position" not in dataset:
        return None
    case = _shown_case(dataset)
    if case is None:
        return None
    where = fold_text(dataset, case)
    frequency = dataset["natural_frequency"].values[case]
    known = np.argsort(frequency, kind="stable")[: np.isfinite(frequency).sum()]
    modes = known[: _MOST_MODES + int((frequency == 0.0).sum())]
    views = [_mode_view(dataset, case, int(mode)) for mode in modes]
    rest = sheets(dataset, dataset["position"].values[case])
    box = box_around(rest, [moved for _, moved, _ in views])
    scenes = [
        Scene(title, [*_at_rest(rest), *items, *signs(rest)], box) for title, _, items in views
    ]
    what, fixed = subject(dataset), "fixed " if subject(dataset) == "wing" else ""
    return Picture(
        "mode-shapes",
        f"The shapes in which the {what} vibrates in still air{f', at {where}' if where else ''}",
        subtitle(dataset) + ". Grey: at rest. Coloured: at the extreme of the motion (red up, "
        f"blue down, across the sheet). Its size is arbitrary. The thick line is the {fixed}root"
        f"{'' if fixed else ' at rest; at 0 Hz nothing pulls back'}.{bodies.words(dataset)}",
        scenes,
        columns=3 if len(scenes) > 2 else len(scenes),
    )


def _mode_view(
    dataset: "xarray.Dataset", case: int, mode: int
) -> tuple[str, _PER_SEGMENT, list[SceneItem]]:
    """Return the title of a mode, the moved wing, and what is drawn of its motion."""
    rest = sheets(dataset, dataset["position"].values[case])
    shape = sheets(dataset, dataset["mode_shape"].values[case, mode])
    name = str(dataset["mode_name"].values[case, mode])
    frequency = float(dataset["natural_frequency"].values[case, mode])
    title = f"{name}: {frequency:.3g} Hz"
    if not bodies.has_bodies(dataset):
        motion = _scaled(shape, rest)
        return title, _added(rest, motion), [*_deformed(rest, motion)]
    centres = dataset["mass_centre"].values[case]
    moving = dataset["mass_centre_shape"].values[case, mode]
    factor = _factor(shape, rest, float(np.abs(moving).max()))
    motion = tuple(grid * factor for grid in shape)
    moved = _added(rest, motion)
    roots = rest[0][0].mean(axis=0), moved[0][0].mean(axis=0)
    marks = bodies.mass_centres(dataset, centres, centres + factor * moving, roots)
    return title, moved, [*_deformed(rest, motion), *marks]


def flutter_phases(dataset: "xarray.Dataset") -> Picture | None:
    """Draw the flutter motion with the lowest onset in steps over one cycle."""
    found = flutter_motions(dataset)
    if not found:
        return None
    row, rest, motion, box = found[0]
    scenes = []
    for step in range(_PHASES):
        now = _at_phase(motion, step / _PHASES)
        ghosts = [
            Thread(line, "muted", 0.7, 0.35)
            for other in range(_PHASES)
            if other != step
            for line in _outline(_added(rest, _at_phase(motion, other / _PHASES)))
        ]
        time = "" if row.frequency <= 0 else f" ({1000 * step / _PHASES / row.frequency:.0f} ms)"
        title = f"{step}/{_PHASES} of the cycle{time}"
        scenes.append(Scene(title, [*ghosts, *_deformed(rest, now), *signs(rest)], box))
    return Picture(
        "flutter-motion",
        f"One cycle of the flutter motion at {row.speed:.3g} m/s and {row.frequency:.3g} Hz",
        _motion_caption(dataset, row) + " Thin outlines: the other steps.",
        scenes,
        columns=3,
    )


def flutter_films(dataset: "xarray.Dataset", most: int = 3) -> list[Picture]:
    """Return the motions at the lowest flutter onsets as films of one cycle."""
    films = []
    for number, (row, rest, motion, box) in enumerate(flutter_motions(dataset)[:most]):
        frames = [
            list(_deformed(rest, _at_phase(motion, step / _FRAMES))) for step in range(_FRAMES)
        ]
        still = [*_at_rest(rest), *signs(rest)]
        films.append(
            Picture(
                f"flutter-film-{number + 1}",
                f"The flutter motion at {row.speed:.3g} m/s and {row.frequency:.3g} Hz",
                _motion_caption(dataset, row) + " Grey: the wing at rest.",
                [Scene("", [*frames[0], *still], box)],
                frames=frames,
            )
        )
    return films


Motion = tuple[FlutterRow, _PER_SEGMENT, _PER_SEGMENT, tuple[Range, Range, Range]]


def flutter_motions(dataset: "xarray.Dataset") -> list[Motion]:
    """Return (point, positions at rest, complex motion, box) of each flutter onset by speed."""
    if "flutter_shape" not in dataset or "position" not in dataset:
        return []
    shapes, found = dataset["flutter_shape"].values, []
    for index, row in enumerate(flutter_rows(dataset)):
        usable = np.isfinite(shapes[index]).all() and np.abs(shapes[index]).max() > 0
        begins = (row.kind, row.event) == ("flutter", "onset") and not row.as_a_whole
        if begins and usable:
            rest = sheets(dataset, dataset["position"].values[row.case])
            motion = _scaled(sheets(dataset, shapes[index]), rest)
            turned = [_added(rest, _at_phase(motion, step / _FRAMES)) for step in range(_FRAMES)]
            found.append((row, rest, motion, box_around(rest, turned)))
    return sorted(found, key=lambda entry: entry[0].speed)


def _motion_caption(dataset: "xarray.Dataset", row: FlutterRow) -> str:
    return (
        subtitle(dataset, fold_text(dataset, row.case), f"mode {row.mode_name}")
        + ". Red moves up, blue down, across the sheet; the size is arbitrary."
    )


def _shown_case(dataset: "xarray.Dataset") -> int | None:
    """Return the case in the middle of those that have shapes."""
    whole = np.isfinite(dataset["mode_shape"].values).all(axis=(2, 3)).any(axis=1)
    whole &= np.isfinite(dataset["natural_frequency"].values).any(axis=1)
    usable = np.flatnonzero(whole & np.isfinite(dataset["position"].values).all(axis=(1, 2)))
    return int(usable[len(usable) // 2]) if usable.size else None


def sheets(dataset: "xarray.Dataset", values: Array) -> _PER_SEGMENT:
    """Return values on (point, axis) as one grid (span, chord, axis) for each segment."""
    segment = dataset["segment"].values
    spanwise, chordwise = dataset["spanwise"].values, dataset["chordwise"].values
    grids = []
    for number in np.unique(segment):
        own = segment == number
        grid = np.full((spanwise[own].max() + 1, chordwise[own].max() + 1, 3), np.nan, values.dtype)
        grid[spanwise[own], chordwise[own]] = values[own]
        grids.append(grid)
    return tuple(grids)


def _size(rest: _PER_SEGMENT) -> float:
    """Largest extent of the wing along an axis."""
    points = np.concatenate([grid.reshape(-1, 3) for grid in rest])
    return float(np.ptp(points, axis=0).max())


def _scaled(motion: _PER_SEGMENT, rest: _PER_SEGMENT) -> _PER_SEGMENT:
    """Scale a motion to be seen well; its largest displacement across the sheet is up."""
    factor = _factor(motion, rest)
    return tuple(grid * factor for grid in motion)


def _factor(motion: _PER_SEGMENT, rest: _PER_SEGMENT, beside: float = 0.0) -> Any:
    """Return what scales and turns a motion; ``beside`` is the largest of what moves with it."""
    normal = [_normal_part(m, r) for m, r in zip(motion, rest, strict=True)]
    flat = np.concatenate([part.ravel() for part in normal])
    extreme = flat[np.argmax(np.abs(flat))]
    largest = max(beside, *(float(np.abs(grid).max()) for grid in motion))
    if largest == 0:
        return 1.0
    if abs(extreme) < _NOTHING * largest:  # a motion in the plane of the wing is drawn aft
        aft = np.concatenate([grid[..., 0].ravel() for grid in motion])
        extreme = aft[np.argmax(np.abs(aft))]
    turn = np.conj(extreme) / abs(extreme) if extreme != 0 else 1.0
    return turn * _AMPLITUDE * _size(rest) / largest


def _normal_part(motion: Array, rest: Array) -> Array:
    """Displacement along the normal of the sheet, which points up when the wing is unfolded."""
    chord, span = rest[0, -1] - rest[0, 0], rest[-1, 0] - rest[0, 0]
    normal = np.cross(chord, span)
    part: Array = motion @ (normal / (np.linalg.norm(normal) or 1.0))
    return part


def _at_phase(motion: _PER_SEGMENT, turn: float) -> _PER_SEGMENT:
    return tuple((grid * np.exp(2j * np.pi * turn)).real for grid in motion)


def _added(rest: _PER_SEGMENT, motion: _PER_SEGMENT) -> _PER_SEGMENT:
    return tuple(a + b for a, b in zip(rest, motion, strict=True))


def _at_rest(rest: _PER_SEGMENT) -> Iterator[Surface]:
    for grid in rest:
        yield Surface(grid[..., 0], grid[..., 1], grid[..., 2], opacity=0.35)


def _deformed(rest: _PER_SEGMENT, motion: _PER_SEGMENT) -> Iterator[Surface]:
    limit = _AMPLITUDE * _size(rest)
    for still, moving in zip(rest, motion, strict=True):
        place = still + moving
        values = _normal_part(moving, still)
        yield Surface(place[..., 0], place[..., 1], place[..., 2], values, (-limit, limit))


def _outline(grids: _PER_SEGMENT) -> Iterator[Array]:
    for grid in grids:
        yield np.concatenate([grid[0], grid[1:, -1], grid[-1, -2::-1], grid[-2::-1, 0]])


def signs(rest: _PER_SEGMENT) -> Iterator[Thread | Tag]:
    """Return an arrow along the air stream, and the clamped root."""
    size = _size(rest)
    root = rest[0][0]
    yield Thread(root[[0, -1]], "ink", 2.0)
    y, z = root[0, 1] - 0.10 * size, root[0, 2]
    stream = np.array([[root[:, 0].min() + along * size, y, z] for along in (-0.12, 0.20)])
    yield Thread(stream, "ink", 1.3, arrow=True)
    yield Tag(stream[0] - [0.02 * size, 0.04 * size, 0.0], "air", "ink")


def box_around(rest: _PER_SEGMENT, moved: list[_PER_SEGMENT]) -> tuple[Range, Range, Range]:
    """Return ranges along all axes that hold the wing at rest and moved, with some room."""
    points = np.concatenate([g.reshape(-1, 3) for grids in (rest, *moved) for g in grids])
    room = 0.02 * _size(rest)
    low, high = np.nanmin(points, axis=0) - room, np.nanmax(points, axis=0) + room
    x, y, z = ((float(a), float(b)) for a, b in zip(low, high, strict=True))
    return x, y, z
