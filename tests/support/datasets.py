"""Synthetic datasets that look like those of a folding wing; no number here is a prediction."""

import math
from datetime import UTC, datetime
from typing import Any

import numpy as np
import xarray

from foldwing.results import FlutterRow, build_dataset, provenance, table_variables
from foldwing.stability.status import Status

MODEL_TEXT = """title = "Three-segment folding wing"
[wing]
chord = "5 cm"
[[wing.segment]]
span = "14 cm"
[[wing.segment]]
span = "10 cm"
hinge = { springs = 3, stiffness = "0.18 N*m/rad", fold = 30 }
[[wing.segment]]
span = "6 cm"
hinge = { springs = 3, stiffness = "0.18 N*m/rad", fold = -30 }
"""

SPANS = (0.14, 0.10, 0.06)
CHORD = 0.05
NAMES = ("B1", "B2", "T1", "B3", "T2", "B4", "L1", "T3")
_STATIONS = ((15, 6), (11, 6), (7, 6))


def attributes(kind: str, **more: Any) -> dict[str, Any]:
    """Provenance of a synthetic dataset."""
    fixed = provenance(
        "Three-segment folding wing",
        kind,
        MODEL_TEXT,
        "strip aerodynamics, beam structure",
        {"aero": "strip", "structure": "beam", "speeds": "0:40:0.5"},
        created=datetime(2026, 11, 23, 14, 15, 2, tzinfo=UTC),
    )
    return {**fixed, **more}


def grid() -> dict[str, Any]:
    """Coordinates of the points: a grid of span by chord on each segment."""
    segment, chordwise, spanwise = [], [], []
    for index, (along_span, along_chord) in enumerate(_STATIONS):
        span, chord = np.meshgrid(np.arange(along_span), np.arange(along_chord), indexing="ij")
        segment += [index + 1] * span.size
        spanwise += span.ravel().tolist()
        chordwise += chord.ravel().tolist()
    points = ("point",)
    return {
        "point": (points, np.arange(len(segment))),
        "segment": (points, segment),
        "chordwise": (points, chordwise),
        "spanwise": (points, spanwise),
        "axis": (("axis",), ["x", "y", "z"]),
    }


def _local(coords: dict[str, Any]) -> tuple[Any, Any, Any]:
    """Segment index, x aft of the mid chord and y along the segment, at the points."""
    segment = np.array(coords["segment"][1]) - 1
    stations = np.array(_STATIONS)[segment]
    x = (np.array(coords["chordwise"][1]) / (stations[:, 1] - 1) - 0.5) * CHORD
    y = np.array(coords["spanwise"][1]) / (stations[:, 0] - 1) * np.array(SPANS)[segment]
    return segment, x, y


def folded(coords: dict[str, Any], fold: tuple[float, float]) -> tuple[Any, Any]:
    """Positions and unit normals at the points of the wing folded by (psi_2, psi_3) degrees."""
    segment, x, y = _local(coords)
    angles = np.radians(np.cumsum([0.0, *fold]))
    along = np.stack([np.zeros(3), np.cos(angles), np.sin(angles)], axis=1)
    normal = np.stack([np.zeros(3), -np.sin(angles), np.cos(angles)], axis=1)
    start = np.concatenate([np.zeros((1, 3)), np.cumsum(along * np.c_[SPANS], axis=0)])[:3]
    position = start[segment] + y[:, None] * along[segment]
    position[:, 0] = x
    return position, normal[segment]


def _shape(coords: dict[str, Any], fold: tuple[float, float], mode: int) -> Any:
    """A made-up bending or twisting shape."""
    segment, x, y = _local(coords)
    s = (np.concatenate([[0.0], np.cumsum(SPANS)])[segment] + y) / sum(SPANS)
    twisting = NAMES[mode].startswith("T")
    order = int(NAMES[mode][1])
    along = np.sin((order - 0.5) * np.pi * s) ** (2 if order == 1 and not twisting else 1)
    normal_motion = -along * x / CHORD * 2 if twisting else along * s
    return normal_motion[:, None] * folded(coords, fold)[1]


def natural_frequencies(fold_2: Any) -> Any:
    """Frequencies in Hz, shape (fold, mode), two of which cross."""
    turn = np.sin(np.radians(np.asarray(fold_2, float)) / 2.0)[:, None]
    flat = np.array([5.6, 27.0, 38.0, 71.0, 96.0, 142.0, 168.0, 190.0])
    slope = np.array([0.9, 0.75, -0.35, -0.25, 0.15, -0.1, 0.05, -0.02])
    return flat * (1.0 + slope * turn)


def modes_dataset(fold_2: Any = tuple(range(0, 151, 10)), modes: int = 8) -> xarray.Dataset:
    """Natural frequencies and shapes against the fold angle (or at a single one)."""
    fold_2 = np.asarray(fold_2, float)
    cases, coords = len(fold_2), grid()
    folds = [(angle, -angle) for angle in fold_2]
    confidence = np.full((cases, modes), 0.97)
    confidence[0] = 1.0
    shapes = [[_shape(coords, fold, mode) for mode in range(modes)] for fold in folds]
    share = np.array([0.05 if name.startswith("T") else 0.93 for name in NAMES[:modes]])
    both = ("fold", "mode")
    return build_dataset(
        {
            "natural_frequency": (both, natural_frequencies(fold_2)[:, :modes]),
            "mode_name": (both, [NAMES[:modes]] * cases),
            "mode_confidence": (both, confidence),
            "bending_share": (both, np.tile(share, (cases, 1))),
            "position": (("fold", "point", "axis"), [folded(coords, fold)[0] for fold in folds]),
            "mode_shape": (("fold", "mode", "point", "axis"), shapes),
            "status": (("fold",), [0] * cases),
        },
        {**coords, **fold_coords(fold_2), "mode": (("mode",), np.arange(modes) + 1)},
        attributes("modes"),
    )


def fold_coords(fold_2: Any) -> dict[str, Any]:
    """Case index and fold angles, the tip segment level with the root."""
    fold_2 = np.asarray(fold_2, float)
    return {
        "fold": (("fold",), np.arange(len(fold_2))),
        "fold_2": (("fold",), fold_2),
        "fold_3": (("fold",), -fold_2),
    }


def row(case: int, fold: float, **fields: Any) -> FlutterRow:
    """A flutter point with defaults for what is not given."""
    defaults: dict[str, Any] = {
        "kind": "flutter",
        "event": "onset",
        "classification": "",
        "frequency": 0.0,
        "strength": float("nan"),
        "branch": 2,
        "mode_name": "T1",
        "mode_confidence": 1.0,
        "threshold": 0.0,
        "residual": 3e-13,
    }
    return FlutterRow(case=case, fold=(fold, -fold), **{**defaults, **fields})


def _eigenvalues(speed: Any) -> Any:
    """Six branches, shape (speed, branch): a hump, a coalescence, damped modes, a real root."""
    u = np.asarray(speed, float)
    b1 = -0.9 * u + 1j * (48.0 - 0.012 * u**2)
    hump = -0.004 * u * (u - 14.0) * (u - 21.5) * 0.25
    b2 = np.where(u < 24, hump, -0.004 * 24 * 10 * 2.5 * 0.25 - 1.1 * (u - 24)) + 1j * (
        205.0 - 0.35 * u
    )
    t1 = 0.05 * (u - 31.0) * u * 0.4 + 1j * (265.0 - 0.09 * u**2)
    b3 = -1.6 * u + 1j * (450.0 + 0.2 * u)
    t2 = -0.6 * u - 0.004 * u**2 + 1j * (620.0 - 0.05 * u**2)
    d1 = np.where(u > 12, 2.2 * (u - 36.5), np.nan) + 0j
    return np.stack([b1, b2, t1, b3, t2, d1], axis=1)


def flutter_table() -> list[FlutterRow]:
    """The flutter points of the synthetic loci."""
    return [
        row(
            0, 30.0, classification="hump", speed=14.0, frequency=31.85, strength=0.0019,
            branch=1, mode_name="B2",
        ),
        row(
            0, 30.0, event="recovery", speed=21.5, frequency=31.43, strength=-0.003, branch=1,
            mode_name="B2",
        ),
        row(
            0, 30.0, classification="coalescence", speed=31.0, frequency=28.4, strength=0.0035,
            mode_confidence=0.88,
        ),
        row(0, 30.0, kind="divergence", speed=36.5, branch=5, mode_name="D1"),
    ]  # fmt: skip


def _contours() -> dict[str, Any]:
    growth, frequency = np.linspace(-40, 15, 111), np.linspace(0, 110, 221)
    point = growth[:, None] + 2j * np.pi * frequency
    roots = _eigenvalues([31.0])[0, :5]
    determinant = np.prod([(point - r) * (point - r.conj()) / abs(r) ** 2 for r in roots], axis=0)
    dims = ("contour_growth", "contour_frequency")
    return {
        "variables": {"determinant": (dims, determinant, {"speed": 31.0})},
        "coords": {
            "contour_growth": (dims[:1], growth),
            "contour_frequency": (dims[1:], frequency),
        },
    }


def flutter_dataset(rows: list[FlutterRow] | None = None) -> xarray.Dataset:
    """Eigenvalues against airspeed at one fold, with flutter points, shapes and contours."""
    rows = flutter_table() if rows is None else rows
    speed = np.arange(0, 40.5, 0.5)
    eigenvalue = _eigenvalues(speed)[None]
    oscillating = np.where(eigenvalue.imag != 0, abs(eigenvalue.imag), np.nan)
    names = ["B1", "B2", "T1", "B3", "T2", "D1"]
    still = np.append(natural_frequencies([30.0])[:, :5], [[np.nan]], axis=1)
    coords, contours, locus = grid(), _contours(), ("fold", "speed", "mode")
    bending, twisting = (_shape(coords, (30.0, -30.0), mode) for mode in (1, 2))
    shape = 0.7 * bending + 1j * 0.5 * twisting
    return build_dataset(
        {
            "eigenvalue": (locus, eigenvalue),
            "frequency": (locus, eigenvalue.imag / (2 * np.pi)),
            "growth": (locus, eigenvalue.real),
            "damping": (locus, -eigenvalue.real / oscillating),
            "residual": (locus, np.full(eigenvalue.shape, 1e-13)),
            "status": (
                locus,
                np.where(np.isnan(eigenvalue.real), int(Status.ABSENT), int(Status.OK)),
            ),
            "confidence": (locus, np.full(eigenvalue.shape, 0.99)),
            "loci_certified": (locus[:2], np.ones((1, len(speed)), bool)),
            "branch_name": (("mode",), names),
            "natural_frequency": (("fold", "mode"), still),
            "mode_name": (("fold", "mode"), [names]),
            "certified": (("fold",), [True]),
            "case_status": (("fold",), [0]),
            "valid_from": (("fold",), [1.5]),
            "position": (("fold", "point", "axis"), [folded(coords, (30.0, -30.0))[0]]),
            "flutter_shape": (
                ("flutter_point", "point", "axis"),
                np.tile(shape, (len(rows), 1, 1)),
            ),
            **table_variables(rows),
            **contours["variables"],
        },
        {
            **coords,
            **contours["coords"],
            **fold_coords([30.0]),
            "speed": (("speed",), speed),
            "mode": (("mode",), np.arange(6) + 1),
        },
        attributes("flutter"),
    )


def boundary_rows(fold_2: Any) -> list[FlutterRow]:
    """A hump that closes near 90 degrees, a coalescence, divergence that leaves, one merger."""
    rows = []
    for case, fold in enumerate(np.asarray(fold_2, float).tolist()):
        s = math.sin(math.radians(fold) / 2.0)
        base = 15.0 + 6.0 * s**2
        half = 4.5 * (1.0 - (fold / 92.0) ** 2)
        if half > 0:
            hump = {"branch": 1, "mode_name": "B2", "frequency": 31.0 + 9.0 * s}
            rows += [
                row(case, fold, classification="hump", speed=base - half**0.5 * 2,
                    strength=0.0008 * half, **hump),
                row(case, fold, event="recovery", speed=base + half**0.5 * 2,
                    strength=-0.0009 * half, **hump),
            ]  # fmt: skip
        rows.append(
            row(case, fold, classification="coalescence", speed=30.0 - 7.0 * s + 9.0 * s**4,
                frequency=33.0 - 9.0 * s, strength=0.0035 + 0.006 * s)
        )  # fmt: skip
        if fold <= 60:
            rows.append(
                row(case, fold, kind="divergence", branch=5, mode_name="D1", speed=33 + 9 * s)
            )
        if fold == 140:
            rows.append(row(case, fold, kind="divergence", event="merger", speed=36.0))
    return rows


def boundary_dataset(step: float = 5.0, failed: tuple[int, ...] = (24,)) -> xarray.Dataset:
    """The flutter boundary against fold_2, with failed and uncertified cases and measurements."""
    fold_2 = np.arange(0, 150 + step / 2, step)
    cases = len(fold_2)
    rows = [row for row in boundary_rows(fold_2) if row.case not in failed]
    status = np.zeros(cases, int)
    status[list(failed)] = int(Status.FAILED)
    certified = status == 0
    if cases > 13 and certified.any():
        certified[13] = False
    frequency = natural_frequencies(fold_2)
    frequency[list(failed)] = np.nan
    nan = np.nan
    return build_dataset(
        {
            "natural_frequency": (("fold", "mode"), frequency),
            "mode_name": (("fold", "mode"), [NAMES] * cases),
            "certified": (("fold",), certified),
            "case_status": (("fold",), status),
            "valid_from": (("fold",), np.full(cases, 1.5)),
            "message": (("fold",), ["" if code == 0 else "no convergence" for code in status]),
            **table_variables(rows),
            "measured_fold": (("measured",), [0.0, 30.0, 60.0, 90.0, 120.0]),
            "measured_speed": (("measured",), [10.2, 11.6, 13.1, 25.9, nan]),
            "measured_frequency": (("measured",), [30.1, 32.8, nan, 27.4, 25.5]),
        },
        {**fold_coords(fold_2), "mode": (("mode",), np.arange(len(NAMES)) + 1)},
        attributes("boundary", swept="fold_2", speed_limit=45.0),
    )


def convergence_dataset() -> xarray.Dataset:
    """Onset, recovery and divergence of one case; at the coarsest level the recovery is missing."""
    rows = flutter_table()
    speed = np.array([entry.speed for entry in rows])
    settings = {"chordwise": (2, 4, 8, 16), "wake": (10, 20, 40), "gap": (0.0, 0.5e-3, 1e-3)}
    own = {"chordwise": 8, "wake": 20, "gap": 1e-3}
    levels = [(name, value) for name, values in settings.items() for value in values]
    values = np.array([value for _, value in levels])
    error = np.where(values > 1, 2.0 / np.maximum(values, 1.0) ** 2, 20.0 * values)
    level_speed = speed * (1.0 + error[:, None])
    level_speed[0, 1] = np.nan
    shape = (len(settings), len(rows))
    level, table, verdict = ("level",), ("level", "flutter_point"), ("setting", "flutter_point")
    status = np.full(len(levels), int(Status.OK))
    status[0] = Status.FAILED
    kinds = np.full(shape, "monotone", dtype="<U12")
    kinds[1] = "oscillating"
    variables = {
        "level_setting": (level, np.array([name for name, _ in levels])),
        "level_value": (level, values),
        "level_own": (level, np.array([own[name] == value for name, value in levels])),
        "level_status": (level, status),
        "level_message": (level, np.where(status > 0, "ValueError: too coarse", "")),
        "level_speed": (table, level_speed),
        "level_frequency": (table, np.full_like(level_speed, 20.0)),
        "level_likeness": (table, np.where(np.isnan(level_speed), np.nan, 0.99)),
        "convergence": (verdict, kinds),
        "order": (verdict, np.where(kinds == "monotone", 2.0, np.nan)),
        "limit_speed": (verdict, np.tile(speed, (len(settings), 1))),
        "error_speed": (verdict, np.tile(0.01 * speed, (len(settings), 1))),
        "mesh_limit_speed": (("flutter_point",), speed),
        "mesh_error_speed": (("flutter_point",), np.full(len(rows), np.nan)),
        "certified": (("fold",), np.array([True])),
        "case_status": (("fold",), np.array([int(Status.OK)])),
        "message": (("fold",), np.array([""])),
    }
    coords = fold_coords([60.0])
    coords |= {
        "setting": (("setting",), np.array(list(settings))),
        "level": (level, np.arange(len(levels))),
        "flutter_point": (("flutter_point",), np.arange(len(rows))),
    }
    attrs = attributes("convergence", speed_limit=40.0)
    return build_dataset(variables | table_variables(rows), coords, attrs)


def steady_dataset(folds: Any = ((0.0, 0.0), (60.0, -60.0), (180.0, 0.0))) -> xarray.Dataset:
    """Steady loads with and without gaps; the last case, folded flat, fails."""
    from foldwing.model import read_model
    from foldwing.studies.steady import steady_study

    wing = read_model("three-segment").with_gaps("1 mm").with_lattice(chordwise=2, spanwise=9)
    return steady_study(wing, folds).dataset
