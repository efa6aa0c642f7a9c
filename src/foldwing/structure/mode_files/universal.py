"""Universal files: shapes in dataset 55, nodes in 15 or 2411, units in 164.

Numbers are read and written by pyuff. It drops a dataset that has no end and takes six numbers of a
complex shape for garbage, so that both are looked for here.
"""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.structure.mode_files.mode_set import ModeSet
from foldwing.structure.mode_files.raw import RawModes, trusting_nobody

SHAPES, NODES, UNITS, FUNCTIONS = 55, (2411, 15), 164, 58
NORMAL_MODE, COMPLEX_MODES = 2, (3, 7)
_GENERAL, _DISPLACEMENT, _RATES = (0, 1), 8, (11, 12)
_MOST_LABELS = 2_000_000_000
_SCATTER = re.compile(r"PHASE SCATTER (\S+) DEG")
_EXPORT = "Export shapes as dataset 55 and nodes as 2411 or 15."


def read_universal(path: Path) -> RawModes:
    """Read normal or complex modes from a universal file.

    The frequency of a complex mode is the modulus of its eigenvalue, and its modal mass
    |modal A| / (2 Im eigenvalue), as for a mode with proportional damping. Dataset 58, measured
    functions, is not read.

    Raises
    ------
    InputError
        When the file is cut short or damaged, or lacks shapes or nodes.
    """
    _check_ends(path)
    sets = _datasets(path)
    shapes, others = _mode_sets(path, sets)
    numbers, points, notes = _nodes(path, sets)
    moving, table = _by_node(path, shapes, numbers)
    if len(moving) < len(numbers):
        notes += (
            f"{len(numbers) - len(moving)} of {len(numbers)} nodes stand in no shape and are left "
            "out",
        )
    if others:
        notes += (f"{others} datasets 55 hold no oscillating mode and are left out",)
    if any(s["spec_data_type"] in _RATES for s in shapes):
        notes += ("shapes are called velocities or accelerations and are taken as displacements",)
    length, force = _units(path, sets)
    frequencies, damping, modal_mass = (
        np.array(column) for column in zip(*map(_mode, shapes), strict=True)
    )
    return RawModes(
        frequencies=frequencies,
        damping=damping,
        modal_mass=modal_mass,
        names=tuple(str(numbers[i]) for i in moving),
        points=points[moving],
        shapes=table,
        length_unit=length,
        mass_unit=None if length is None or force is None else force / length,
        complexity=np.array([_scatter(s) for s in shapes]),
        notes=notes,
    )


def _check_ends(path: Path) -> None:
    with path.open("rb") as file:
        ends = sum(line.startswith(b"    -1") and not line[6:].strip() for line in file)
    if ends % 2:
        limit = "the last dataset has no end: the file is cut short"
        raise InputError(str(path), f"{ends} lines with -1", limit, "Export or copy it again.")


def _datasets(path: Path) -> list[Mapping[str, Any]]:
    try:
        import pyuff
    except ImportError as error:
        limit = "universal files need the package pyuff"
        remedy = 'Install it: pip install "foldwing[universal]".'
        raise InputError(str(path), "a universal file", limit, remedy) from error
    with trusting_nobody(path, "a universal file that can be read", _EXPORT):
        file = pyuff.UFF(str(path))
        types = [int(each) for each in file.get_set_types()]
        wanted = [i for i, each in enumerate(types) if each in (SHAPES, *NODES, UNITS)]
        sets = [file.read_sets(i) for i in wanted]
    if FUNCTIONS in types and SHAPES not in types:
        limit = "holds measured functions (dataset 58) but no shapes"
        raise InputError(str(path), None, limit, f"Identify the modes first. {_EXPORT}")
    return sets


def _of_type(sets: list[Mapping[str, Any]], *types: int) -> list[Mapping[str, Any]]:
    return [s for wanted in types for s in sets if s["type"] == wanted]


def _mode_sets(path: Path, sets: list[Mapping[str, Any]]) -> tuple[list[Mapping[str, Any]], int]:
    every = _of_type(sets, SHAPES)
    kinds = (*_GENERAL, _DISPLACEMENT, *_RATES)
    modes = [
        s
        for s in every
        if s["spec_data_type"] in kinds
        and (
            s["analysis_type"] == NORMAL_MODE
            or (s["analysis_type"] in COMPLEX_MODES and s["eig"].imag > 0.0)
        )
    ]
    if not modes:
        limit = "must hold normal modes or complex ones (dataset 55, analysis 2, 3 or 7)"
        given = f"{len(every)} datasets 55, none of them a mode"
        raise InputError(str(path), given, limit, _EXPORT)
    return modes, len(every) - len(modes)


def _nodes(path: Path, sets: list[Mapping[str, Any]]) -> tuple[list[int], Real, tuple[str, ...]]:
    found = _of_type(sets, *NODES)
    if not found:
        limit = "must hold the positions of the nodes (dataset 2411 or 15)"
        raise InputError(f"{path}: geometry", None, limit, _EXPORT)
    nodes = found[0]
    columns = [np.asarray(nodes[key], float) for key in ("node_nums", "x", "y", "z")]
    if len({len(column) for column in columns}) > 1 or not np.all(np.isfinite(columns[0])):
        limit = "every node needs a number and three coordinates"
        raise InputError(f"{path}: geometry", "an incomplete table", limit, _EXPORT)
    if np.abs(columns[0]).max(initial=0.0) > _MOST_LABELS:
        limit = f"must be at most {_MOST_LABELS}"
        raise InputError(f"{path}: node", float(np.abs(columns[0]).max()), limit, _EXPORT)
    repeated, times = np.unique(columns[0], return_counts=True)
    if times.max(initial=0) > 1:
        limit = "must stand once"
        raise InputError(f"{path}: node", int(repeated[times.argmax()]), limit, _EXPORT)
    systems = {float(each) for key in ("def_cs", "disp_cs") for each in nodes[key]}
    if len(systems) > 1:
        given = ", ".join(f"{s:g}" for s in sorted(systems))
        limit = "all nodes must be given in one coordinate system"
        remedy = "Export positions and shapes in global axes."
        raise InputError(f"{path}: coordinate systems of nodes", given, limit, remedy)
    notes: tuple[str, ...] = ()
    if len(found) > 1:
        notes = (f"of {len(found)} tables of nodes the first is used",)
    return [int(n) for n in columns[0]], np.column_stack(columns[1:]), notes


def _by_node(
    path: Path, shapes: list[Mapping[str, Any]], numbers: list[int]
) -> tuple[list[int], Real]:
    """Return which nodes have shapes, and the shapes (m, k, 3) in that order."""
    place = {number: i for i, number in enumerate(numbers)}
    tables = [dict(_displacements(path, m, s)) for m, s in enumerate(shapes, 1)]
    used = {number for table in tables for number in table}
    for mode, table in enumerate(tables, 1):
        for number in sorted(used):
            if number not in place:
                limit = "must be among the nodes with a position"
                raise InputError(f"{path}: mode {mode}: node", number, limit, _EXPORT)
            if number not in table:
                limit = "every mode needs every node"
                field = f"{path}: mode {mode}: node {number}"
                raise InputError(field, None, limit, "Export the shapes of all nodes.")
    moving = [i for number, i in place.items() if number in used]
    values = [table[numbers[i]] for table in tables for i in moving]
    return moving, np.array(values).reshape(len(tables), len(moving), 3)


def _displacements(
    path: Path, mode: int, dataset: Mapping[str, Any]
) -> Iterator[tuple[int, tuple[complex, ...]]]:
    columns = [dataset.get(key, ()) for key in ("node_nums", "r1", "r2", "r3")]
    if len({len(column) for column in columns}) > 1:
        limit = "must have 3 displacements of each node, or 6 values when real"
        given = f"{dataset['n_data_per_node']} values of each node"
        raise InputError(f"{path}: mode {mode}", given, limit, _EXPORT)
    seen = set()
    for number, *u in zip(*columns, strict=True):
        if number in seen:
            limit = "must stand once in a shape"
            raise InputError(f"{path}: mode {mode}: node", int(number), limit, _EXPORT)
        seen.add(number)
        yield int(number), tuple(u)


def _mode(dataset: Mapping[str, Any]) -> tuple[float, float, float]:
    """Return frequency, damping ratio and modal mass; nan where 0 stands for unknown."""
    if dataset["analysis_type"] == NORMAL_MODE:
        damping = dataset["modal_damp_vis"] or dataset["modal_damp_his"] / 2.0
        return dataset["freq"], damping or np.nan, dataset["modal_m"] or np.nan
    eigenvalue = dataset["eig"]
    mass = abs(dataset["modal_a"]) / (2.0 * eigenvalue.imag)
    return abs(eigenvalue) / (2.0 * np.pi), -eigenvalue.real / abs(eigenvalue), mass or np.nan


def _scatter(dataset: Mapping[str, Any]) -> float:
    match = _SCATTER.search(str(dataset["id4"]))
    try:
        return float(match[1]) if match else 0.0
    except ValueError:
        return 0.0


def _units(path: Path, sets: list[Mapping[str, Any]]) -> tuple[float | None, float | None]:
    """Return the units of length and force in SI; dataset 164 holds their inverses."""
    stated = _of_type(sets, UNITS)
    if not stated:
        return None, None
    units = []
    for key in ("length", "force"):
        factor = float(stated[0][key])
        if not (np.isfinite(factor) and factor > 0.0):
            limit = "must be finite and greater than 0"
            raise InputError(f"{path}: units: {key}", factor, limit, "Correct dataset 164.")
        units.append(1.0 / factor)
    return units[0], units[1]


def write_universal(modes: ModeSet, path: Path) -> None:
    """Write units, nodes and shapes: positions with 17 digits, all else with the format's 6.

    Points whose names are no node numbers are numbered from 1. Unknown damping becomes 0.
    """
    try:
        import pyuff
    except ImportError as error:
        limit = "universal files need the package pyuff"
        remedy = 'Install it: pip install "foldwing[universal]", or write CSV or netCDF.'
        raise InputError(str(path), "a universal file", limit, remedy) from error
    numbers, zeros = _node_numbers(modes.names), np.zeros(len(modes.names), int)
    x, y, z = modes.points.T
    units = {"type": UNITS, "units_code": 1, "units_description": "SI: Meter (newton)"}
    factors = {"temp_mode": 1, "length": 1.0, "force": 1.0, "temp": 1.0, "temp_offset": 273.15}
    nodes = {"type": NODES[0], "node_nums": numbers, "def_cs": zeros, "disp_cs": zeros}
    sets = [units | factors, nodes | {"color": zeros, "x": x, "y": y, "z": z}]
    sets += [_shape_set(modes, mode, numbers) for mode in range(modes.count)]
    pyuff.UFF(str(path)).write_sets(sets, mode="overwrite")


def _shape_set(modes: ModeSet, mode: int, numbers: list[int]) -> dict[str, Any]:
    x, y, z = modes.shapes[mode].T
    return {
        "type": SHAPES,
        "id4": f"PHASE SCATTER {modes.complexity[mode]:.5e} DEG",
        "analysis_type": NORMAL_MODE,
        "data_ch": 2,
        "spec_data_type": _DISPLACEMENT,
        "load_case": 1,
        "mode_n": mode + 1,
        "freq": modes.frequencies[mode],
        "modal_m": modes.modal_mass[mode],
        "modal_damp_vis": np.nan_to_num(modes.damping[mode]),
        "node_nums": numbers,
        "r1": x,
        "r2": y,
        "r3": z,
    }


def _node_numbers(names: tuple[str, ...]) -> list[int]:
    if all(re.fullmatch(r"[1-9]\d{0,8}", name) for name in names):
        return [int(name) for name in names]
    return list(range(1, len(names) + 1))
