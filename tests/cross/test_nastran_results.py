"""OP2 files that MSC Nastran wrote, against its printed output and its bulk data.

They are the free truss and the cantilever that pyyeti's own tests ship with.
"""

import re
from pathlib import Path

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.structure.component import Root
from foldwing.structure.imported_selection import selected
from foldwing.structure.mode_files import read_modes
from foldwing.structure.mode_files.nastran import read_bulk

pyyeti = pytest.importorskip("pyyeti")
FOLDER = Path(pyyeti.__file__).parent / "tests" / "nas2cam_extseout"
pytestmark = pytest.mark.skipif(not FOLDER.exists(), reason="pyyeti came without its tests")

ROW = re.compile(r"^ +(\d+) +\d+((?: +-?\d\.\d{6}E[+-]\d\d){5})\s*$", re.MULTILINE)
COUNT = 30


@pytest.fixture(scope="module")
def truss():
    return read_modes(FOLDER / "full.op2", count=COUNT, length_unit=1e-3)


def test_frequencies_and_modal_masses_are_those_that_nastran_printed(truss) -> None:
    text = (FOLDER / "full.out").read_text(encoding="latin-1")
    table = text[text.index("R E A L   E I G E N V A L U E S") :]
    printed = {int(row[1]): [float(v) for v in row[2].split()] for row in ROW.finditer(table)}
    for mode in range(1, COUNT + 1):
        _, _, cycles, mass, _ = printed[mode]
        assert truss.frequencies[mode - 1] == pytest.approx(cycles, rel=1e-6)
        assert truss.modal_mass[mode - 1] == pytest.approx(mass, rel=1e-6)


def test_points_are_those_of_the_bulk_data(truss) -> None:
    grids = read_bulk(FOLDER / "full.dat")
    assert {int(name) for name in truss.names} == set(grids)
    expected = np.array([grids[int(name)].position for name in truss.names])
    assert truss.points == pytest.approx(expected * 1e-3, abs=1e-12)


def test_its_six_zero_modes_are_rigid_motions_and_no_other_is(truss) -> None:
    assert selected(truss, Root.FREE, None).rigid == 6
    assert "3 modes have a negative eigenvalue" in truss.warnings[0]


def test_rigid_modes_of_unit_modal_mass_give_the_printed_mass_back(truss) -> None:
    """At the mass centre the sum of (u . e)^2 over the rigid modes is 1/mass in every direction."""
    text = (FOLDER / "full.out").read_text(encoding="latin-1")
    rows = dict(re.findall(r"^ +([XYZ])((?: +-?\d\.\d{6}E[+-]\d\d){4})\s*$", text, re.MULTILINE))
    printed = {axis: [float(v) for v in row.split()] for axis, row in rows.items()}
    centre = 1e-3 * np.array([printed["Y"][1], printed["X"][2], printed["X"][3]])
    p = truss.points - centre
    basis = np.zeros((len(p), 3, 6))
    basis[:, :, :3] = np.eye(3)
    basis[:, :, 3:] = np.cross(np.eye(3), p[:, None]).transpose(0, 2, 1)
    shapes = truss.shapes[:6].reshape(6, -1).T
    at_centre = np.linalg.lstsq(basis.reshape(-1, 6), shapes, rcond=None)[0][:3]
    assert at_centre @ at_centre.T == pytest.approx(np.eye(3) / printed["X"][0], abs=2e-6)


def test_all_modes_of_the_truss_are_more_than_its_points_tell_apart() -> None:
    with pytest.raises(InputError, match=r"278 modes in 147 moving directions"):
        read_modes(FOLDER / "full.op2")


def test_a_subset_of_points_and_a_long_beam_are_read() -> None:
    few = read_modes(FOLDER / "inboard_v2007.op2")
    assert few.names == ("4", "16")
    assert few.points[0].tolist() == [900.0, 0.0, 300.0]
    assert few.frequencies == pytest.approx([6.129345, 6.130134, 23.63188], rel=1e-6)
    beam = read_modes(FOLDER / "cant_beam.op2")
    assert (beam.count, len(beam.points)) == (4, 8222)


@pytest.mark.parametrize("name", ["assemble.op2", "cla_test_model.op2", "nas2cam.op2"])
def test_other_op2_files_are_refused(name: str) -> None:
    with pytest.raises(InputError, match=name):
        read_modes(FOLDER / name)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.6, 0.65, 0.7, 0.9])
def test_a_cut_op2_file_is_refused_or_still_has_all_modes(tmp_path: Path, share: float) -> None:
    """Stresses and forces stand behind the modes, which end at 15180 of 20600 bytes."""
    content = (FOLDER / "inboard_v2007.op2").read_bytes()
    path = tmp_path / "cut.op2"
    path.write_bytes(content[: int(len(content) * share)])
    if share < 15180 / 20600:
        with pytest.raises(InputError, match=r"cut\.op2"):
            read_modes(path)
    else:
        whole = read_modes(FOLDER / "inboard_v2007.op2")
        assert np.array_equal(read_modes(path).shapes, whole.shapes)
