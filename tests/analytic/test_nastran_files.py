"""Nastran punch files with grid points of bulk data in every layout and coordinate system."""

from pathlib import Path

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.structure.mode_files import read_modes

BULK = """\
SOL 103
CEND
BEGIN BULK
$ fields of eight columns, commas, and sixteen columns
GRID           1              0.      0.      0.
GRID,2,,100.,0.,0.
GRID*                  3                             0.            200.0
*                     0.
GRID,4,7,2.+2,90.,5.,7
grid,5,,0.,0.,5.0-1,8
CORD2C         7              0.      0.      0.      0.      0.      1.
              1.      0.      0.
CORD2R,8,,0.,0.,0.,1.,0.,0.
,0.,1.,0.
ENDDATA
"""
PLACES = {1: (0, 0, 0), 2: (100, 0, 0), 3: (0, 200, 0), 4: (0, 200, 5), 5: (0, 0, 0.5)}


def punch_mode(eigenvalue: float, mode: int, shape: dict, first: int) -> str:
    """Eigenvectors as Nastran punches them: 80 columns, the last eight count the lines."""
    heads = [
        "$TITLE   = A PLATE",
        "$SUBTITLE=",
        "$LABEL   =",
        "$EIGENVECTOR",
        "$REAL OUTPUT",
        "$SUBCASE ID =           1",
        f"$EIGENVALUE = {eigenvalue:14.7E}  MODE = {mode:5d}",
    ]
    lines = [f"{text:72s}" for text in heads]
    for grid, u in shape.items():
        lines.append(f"{grid:10d}       G" + "".join(f"{v:18.6E}" for v in u))
        lines.append(f"{'-CONT-':18s}" + "".join(f"{0.0:18.6E}" for _ in range(3)))
    return "".join(f"{text}{first + i:8d}\n" for i, text in enumerate(lines))


FIRST = {1: (0, 0, 1), 2: (0, 0, 1), 3: (0, 0, 2), 4: (0.5, 0.25, 2), 5: (3, 0, 0)}
SECOND = {1: (0, 0, 0), 2: (0, 0, -1), 3: (0, 0, 0.5), 4: (0, 0, 0.5), 5: (0, 0, 0)}
PUNCH = punch_mode(1000.0, 1, FIRST, 1) + punch_mode(4000.0, 2, SECOND, 18)


def both(tmp_path: Path, punch: str = PUNCH, bulk: str = BULK) -> tuple[Path, Path]:
    (tmp_path / "model.pch").write_text(punch)
    (tmp_path / "model.bdf").write_text(bulk)
    return tmp_path / "model.pch", tmp_path / "model.bdf"


def test_modes_of_a_punch_file(tmp_path: Path) -> None:
    punch, bulk = both(tmp_path)
    modes = read_modes(punch, geometry=bulk, length_unit=1e-3, mass_unit=1e3, modal_mass=1.0)
    assert modes.frequencies == pytest.approx(np.sqrt([1000.0, 4000.0]) / (2 * np.pi), rel=1e-6)
    assert modes.modal_mass.tolist() == [1000.0, 1000.0]
    assert modes.points == pytest.approx(np.array(list(PLACES.values())) / 1e3, abs=1e-15)
    assert modes.shapes[1, :, 2].tolist() == [0.0, -1.0, 0.5, 0.5, 0.0]
    assert modes.names == ("1", "2", "3", "4", "5")
    assert not modes.warnings


def test_displacements_are_turned_from_the_axes_of_their_points(tmp_path: Path) -> None:
    """Point 4 moves along r, theta, z where r is y; z of system 8 is x, its x is y."""
    punch, bulk = both(tmp_path)
    modes = read_modes(punch, geometry=bulk, modal_mass=1.0)
    assert modes.shapes[0, 3] == pytest.approx([-0.25, 0.5, 2.0], abs=1e-12)
    assert modes.shapes[0, 4] == pytest.approx([0.0, 3.0, 0.0], abs=1e-12)


def test_negative_eigenvalues_and_scalar_points_are_told(tmp_path: Path) -> None:
    text = PUNCH.replace("1.0000000E+03", "-1.000000E-04")
    spoint = f"{99:10d}       S" + f"{1.0:18.6E}" * 3 + f"{1:8d}\n"
    punch, bulk = both(tmp_path, text + spoint)
    modes = read_modes(punch, geometry=bulk, modal_mass=1.0)
    assert modes.warnings[0] == "1 scalar points are left out"
    assert "1 modes have a negative eigenvalue, the least -0.0001" in modes.warnings[1]


def test_include_statements_are_followed(tmp_path: Path) -> None:
    (tmp_path / "grids.inc").write_text(BULK.split("BEGIN BULK\n")[1].replace("ENDDATA\n", ""))
    punch, bulk = both(tmp_path, bulk="BEGIN BULK\nINCLUDE 'grids.inc'\nENDDATA\n")
    assert len(read_modes(punch, geometry=bulk, modal_mass=1.0).points) == 5


LINE_8 = PUNCH.splitlines()[7]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (LINE_8, LINE_8.replace("1.000000E+00", "1.0000x0E+00"), "model.pch:8: got '1"),
        (LINE_8, LINE_8.replace("1.000000E+00", "         NaN"), "model.pch:8: got '1"),
        (LINE_8, LINE_8.replace(" G ", " E "), "model.pch:8: got"),
        (LINE_8, LINE_8.replace("         1 ", "         z ", 1), "model.pch:8: got"),
        (LINE_8, LINE_8.replace("         1 ", "         2 ", 1), "every point must stand once"),
        (LINE_8, LINE_8.replace("         1 ", "         6 ", 1), "mode 1: grid point 1: missing"),
        (LINE_8 + "\n", "", "model.pch:8: got '-CONT-"),
        ("$REAL OUTPUT", "$SORT2 REAL", "sorted by mode"),
        ("1.0000000E+03", "          abc", "a finite eigenvalue"),
    ],
)
def test_what_is_wrong_in_a_punch_file_is_named_with_its_line(tmp_path, old, new, words) -> None:
    assert old in PUNCH
    punch, bulk = both(tmp_path, PUNCH.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        read_modes(punch, geometry=bulk, modal_mass=1.0)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("GRID,2,,100.", "$RID,2,,100.", "grid point: got 2; has a shape but no GRID"),
        ("GRID,2,", "GRID,3,", "every grid point must stand once"),
        ("GRID,2,,100.", "GRID,2,9,100.", "coordinate system: got 9"),
        ("GRID,2,,100.", "GRID,2,,1x0.", "GRID 2: got '1x0.'"),
        ("GRID,2,,100.", f"GRID,2,,{'9' * 400}", "GRID 2: got '999"),
        ("GRID,2,,100.", "GRID,200000000,,100.", "GRID: got"),
        ("$ fields", "GRDSET,,7\n$ fields", "GRDSET: got 'a card'"),
        ("100.,0.,0.", "100.,0.,0.,12", "coordinate system: got 12"),
    ],
)
def test_what_is_wrong_in_bulk_data_is_named(tmp_path: Path, old, new, words) -> None:
    assert old in BULK
    punch, bulk = both(tmp_path, bulk=BULK.replace(old, new))
    with pytest.raises(InputError) as caught:
        read_modes(punch, geometry=bulk, modal_mass=1.0)
    assert words in str(caught.value)
    assert "model." in str(caught.value)


def test_what_a_punch_file_lacks_is_asked_for(tmp_path: Path) -> None:
    punch, bulk = both(tmp_path)
    with pytest.raises(InputError, match=r"geometry: missing.*bulk data"):
        read_modes(punch)
    with pytest.raises(InputError, match=r"modal mass: missing.*modal_mass=1\.0"):
        read_modes(punch, geometry=bulk)
    cut, _ = both(tmp_path, "".join(PUNCH.splitlines(keepends=True)[:-4]))
    with pytest.raises(InputError, match=r"mode 2: grid point 4: missing"):
        read_modes(cut, geometry=bulk, modal_mass=1.0)
    bare, _ = both(tmp_path, "".join(PUNCH.splitlines(keepends=True)[:7]))
    with pytest.raises(InputError, match=r"shapes: got 'none'"):
        read_modes(bare, geometry=bulk, modal_mass=1.0)
    empty, _ = both(tmp_path, "$TITLE = NOTHING\n")
    with pytest.raises(InputError, match=r"no eigenvector"):
        read_modes(empty, geometry=bulk)
    with pytest.raises(InputError, match=r"must hold GRID cards"):
        read_modes(both(tmp_path)[0], geometry=punch, modal_mass=1.0)


def test_without_pyyeti_the_remedy_is_an_extra(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyyeti", None)
    punch, bulk = both(tmp_path)
    with pytest.raises(InputError, match=r"foldwing\[nastran\]"):
        read_modes(punch, geometry=bulk)
