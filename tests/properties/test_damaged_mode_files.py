"""Files of modes, damaged in any way, are read or refused: only `InputError` ever escapes."""

import os
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from foldwing.errors import InputError
from foldwing.structure.mode_files import ModeSet, read_modes, write_modes
from support.mode_sets import random_mode_set

POINT = "{:10d}       G{:18.6E}{:18.6E}{:18.6E}       1\n"
ROTATION = "-CONT-            {:18.6E}{:18.6E}{:18.6E}\n"
TOKENS = (
    "nan",
    "inf",
    "-1",
    "1e999",
    "9" * 400,
    "",
    ",",
    "\n",
    "\0",
    "é",
    "#",
    '"',
    "$",
    "*",
    "mode",
)


@cache
def good(ending: str) -> bytes:
    """A sound file."""
    if ending == ".pch":
        modes = random_mode_set(4)
        text = ""
        for mode in range(3):
            text += f"$EIGENVALUE = {1e3 * (mode + 1):14.7E}  MODE = {mode + 1:5d}\n"
            for point, u in enumerate(np.clip(modes.shapes[mode], -1e6, 1e6), 1):
                text += POINT.format(point, *u) + ROTATION.format(0, 0, 0)
        return text.encode()
    if ending == ".bdf":
        points = random_mode_set(4).points
        return "".join(f"GRID,{i},,{x:.5f},{y:.5f},{z:.5f}\n"
                       for i, (x, y, z) in enumerate(points, 1)).encode()  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        write_modes(random_mode_set(4), Path(folder) / f"modes{ending}")
        return (Path(folder) / f"modes{ending}").read_bytes()


@st.composite
def damages(draw):
    """Where a file is cut, and what stands at which places instead (as shares of its length)."""
    places = st.floats(0.0, 1.0)
    cut = draw(st.none() | places)
    changes = st.tuples(places, st.integers(0, 30), st.sampled_from(TOKENS) | st.binary(max_size=9))
    return cut, draw(st.lists(changes, max_size=4))


def damaged(content: bytes, damage) -> bytes:
    cut, changes = damage
    for place, length, new in changes:
        at = int(place * len(content))
        new = new.encode() if isinstance(new, str) else new
        content = content[:at] + new + content[at + length :]
    return content if cut is None else content[: int(cut * len(content))]


def read_or_refused(content: bytes, ending: str, geometry: bytes | None = None) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path, model = Path(folder) / f"modes{ending}", Path(folder) / "model.bdf"
        path.write_bytes(content)
        if geometry is not None:
            model.write_bytes(geometry)
        options = {} if geometry is None else {"geometry": model, "modal_mass": 1.0}
        try:
            modes = read_modes(path, **options)
        except InputError as error:
            assert folder in str(error)
        else:
            assert isinstance(modes, ModeSet)
        assert set(os.listdir(folder)) <= {path.name, model.name}


@pytest.mark.parametrize("ending", [".csv", ".unv", ".nc"])
@given(damage=damages())
def test_damaged_files(ending: str, damage) -> None:
    read_or_refused(damaged(good(ending), damage), ending)


@given(damage=damages(), of_geometry=st.booleans())
def test_damaged_punch_files_and_bulk_data(damage, of_geometry: bool) -> None:
    punch, bulk = good(".pch"), good(".bdf")
    if of_geometry:
        bulk = damaged(bulk, damage)
    else:
        punch = damaged(punch, damage)
    read_or_refused(punch, ".pch", bulk)


@pytest.mark.parametrize("ending", [".csv", ".unv", ".nc", ".op2", ".pch", ""])
@given(content=st.binary(max_size=300))
def test_files_of_anything(ending: str, content: bytes) -> None:
    read_or_refused(content, ending)


@given(seed=st.integers(0, 10**6))
def test_any_modes_come_back(seed: int) -> None:
    modes = random_mode_set(seed)
    with tempfile.TemporaryDirectory() as folder:
        for ending, digits in ((".csv", 0.0), (".unv", 5.01e-6)):
            path = Path(folder) / f"modes{ending}"
            write_modes(modes, path)
            back = read_modes(path)
            for name in ("frequencies", "modal_mass", "points", "shapes", "damping", "complexity"):
                expected = getattr(modes, name)
                assert getattr(back, name) == pytest.approx(
                    expected, rel=digits, abs=0, nan_ok=True
                )
            assert back.names == modes.names
