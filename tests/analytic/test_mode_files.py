"""Files of modes: what is read, in which units, what comes back, and what is refused."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from foldwing.errors import InputError, OutputError
from foldwing.structure.mode_files import ModeSet, read_modes, write_modes
from foldwing.structure.mode_files.complex_modes import real_shapes
from support.mode_sets import mode_set, random_mode_set

ARRAYS = ("frequencies", "modal_mass", "points", "shapes", "damping", "complexity")

CSV = """\
# a strip with three sensors
# length_unit: mm
# mass_unit: g

point,x,y,z
root,0,0,0
front,-25,140,0
rear,25,140,0

mode,frequency_hz,modal_mass,damping
B1,4.5,6.2,0.01
T1,31,1.9,

mode,point,uz
B1,root,0
B1,front,1.0
B1,rear,1.1
T1,root,0
T1,front,1
T1,rear,-0.9
"""


def written(tmp_path: Path, text: str, name: str = "modes.csv") -> Path:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


def refusal(path: Path, **options) -> str:
    with pytest.raises(InputError) as caught:
        read_modes(path, **options)
    assert str(caught.value).startswith(caught.value.field)
    return str(caught.value)


def assert_same(a: ModeSet, b: ModeSet, rel: float = 0.0, names=ARRAYS) -> None:
    for name in names:
        assert getattr(b, name) == pytest.approx(getattr(a, name), rel=rel, abs=0.0, nan_ok=True), (
            name
        )
    assert a.names == b.names


def test_a_file_written_by_hand(tmp_path: Path) -> None:
    modes = read_modes(written(tmp_path, CSV))
    assert modes.frequencies.tolist() == [4.5, 31.0]
    assert modes.modal_mass == pytest.approx([6.2e-3, 1.9e-3])
    assert modes.points[1] == pytest.approx([-0.025, 0.14, 0.0])
    assert modes.shapes[1, :, 2].tolist() == [0.0, 1.0, -0.9]
    assert not modes.shapes[:, :, :2].any()
    assert modes.damping[0] == 0.01
    assert np.isnan(modes.damping[1])
    assert modes.names == ("root", "front", "rear")
    assert not modes.warnings


@pytest.mark.parametrize(
    "change",
    [
        lambda t: t.replace(",", ";"),
        lambda t: t.replace(",", "\t"),
        lambda t: "\ufeff" + t.replace("\n", "\r\n"),
        lambda t: t.replace("\n", ",,,\n"),
        lambda t: t.replace("# length", '"# length').replace("mm\n", 'mm"\n'),
        lambda t: t.replace("mode,point,uz", "Mode, Point, UZ"),
    ],
)
def test_spreadsheets_write_the_same_in_other_ways(tmp_path: Path, change) -> None:
    plain = read_modes(written(tmp_path, CSV))
    assert_same(plain, read_modes(written(tmp_path, change(CSV), "other.csv")))


@pytest.mark.parametrize("unit", ["in", "25.4 mm", "0.0254"])
def test_units_are_names_or_numbers(tmp_path: Path, unit: str) -> None:
    text = CSV.replace("length_unit: mm", f"length_unit: {unit}")
    if unit == "25.4 mm":
        assert "length_unit" in refusal(written(tmp_path, text))
        return
    assert read_modes(written(tmp_path, text)).points[1, 1] == pytest.approx(140 * 0.0254)


def test_what_the_user_says_goes_first_and_is_told(tmp_path: Path) -> None:
    path = written(tmp_path, CSV)
    modes = read_modes(path, length_unit=0.01, mass_unit=1.0, modal_mass=2.0, count=1)
    assert modes.points[1, 1] == pytest.approx(1.4)
    assert modes.modal_mass.tolist() == [2.0]
    assert modes.count == 1
    assert "the file states a unit of length of 0.001, and 0.01 is used" in modes.warnings[0]
    assert len(modes.warnings) == 2
    assert not read_modes(path, length_unit=1e-3).warnings


def test_millimetres_tonnes_and_seconds(tmp_path: Path) -> None:
    """Mass-normalised in mm, t, s: u^T M u = 1 t is a modal mass of 1000 kg, shapes as they are."""
    text = CSV.replace("# mass_unit: g", "").replace("6.2", "1").replace("1.9", "1")
    modes = read_modes(written(tmp_path, text), mass_unit=1000.0)
    assert modes.modal_mass.tolist() == [1000.0, 1000.0]
    assert modes.shapes[0, 2, 2] == 1.1


@pytest.mark.parametrize("ending", [".csv", ".nc"])
@pytest.mark.parametrize("seed", range(3))
def test_csv_and_netcdf_come_back_to_the_last_bit(tmp_path: Path, ending: str, seed: int) -> None:
    modes = replace(
        random_mode_set(seed), names=tuple("ä,b;c\"d'ef#g"[i : i + 2] for i in range(8))
    )
    path = tmp_path / f"modes{ending}"
    write_modes(modes, path)
    assert_same(modes, read_modes(path))


@pytest.mark.parametrize("ending", [".unv", ".uff"])
def test_universal_files_come_back_to_their_six_digits(tmp_path: Path, ending: str) -> None:
    modes = random_mode_set(7)
    path = tmp_path / f"modes{ending}"
    write_modes(modes, path)
    back = read_modes(path)
    assert_same(modes, back, rel=5.01e-6)
    assert_same(modes, back, names=("points",), rel=1e-15)
    assert all("phases scatter" in text for text in back.warnings)
    write_modes(back, tmp_path / "again.unv")
    assert (tmp_path / "again.unv").read_bytes() == path.read_bytes()


def test_universal_files_number_points_with_other_names(tmp_path: Path) -> None:
    modes = replace(random_mode_set(7), names=tuple("abcdefgh"))
    write_modes(modes, tmp_path / "modes.unv")
    assert read_modes(tmp_path / "modes.unv").names == tuple("12345678")


def test_no_file_is_replaced_and_none_is_left_in_part(tmp_path: Path, monkeypatch) -> None:
    modes = random_mode_set(1)
    (tmp_path / "modes.csv").write_text("mine")
    with pytest.raises(OutputError, match="exists already"):
        write_modes(modes, tmp_path / "modes.csv")
    assert (tmp_path / "modes.csv").read_text() == "mine"
    with pytest.raises(OutputError, match="cannot be written"):
        write_modes(modes, tmp_path / "nowhere" / "modes.csv")
    with pytest.raises(InputError, match=r"\.csv, \.nc"):
        write_modes(modes, tmp_path / "modes.txt")

    def breaks(modes, path):
        path.write_text("half")
        raise OSError(28, "No space left on device")

    for ending in (".csv", ".nc", ".unv"):
        monkeypatch.setitem(write_modes.__globals__["_WRITERS"], ending, breaks)
        with pytest.raises(OutputError, match="No space left"):
            write_modes(modes, tmp_path / f"new{ending}")
    assert sorted(os.listdir(tmp_path)) == ["modes.csv"]


def test_a_file_that_appears_meanwhile_is_kept(tmp_path: Path, monkeypatch) -> None:
    target = tmp_path / "modes.csv"

    def slow(modes, path):
        path.write_text("new")
        target.write_text("another's")

    monkeypatch.setitem(write_modes.__globals__["_WRITERS"], ".csv", slow)
    for links in (True, False):
        if not links:
            monkeypatch.setattr(os, "link", lambda *_: (_ for _ in ()).throw(OSError("no links")))
        target.unlink(missing_ok=True)
        with pytest.raises(OutputError, match="exists already"):
            write_modes(random_mode_set(1), target)
        assert target.read_text() == "another's"


def test_a_turned_real_shape_is_found_again() -> None:
    shapes = random_mode_set(2).shapes
    phases = np.exp(1j * np.array([0.3, 2.0, -1.4]))
    real, scatter = real_shapes(shapes * phases[:, None, None])
    signs = np.sign(np.sum(real * shapes, axis=(1, 2)))
    assert real * signs[:, None, None] == pytest.approx(shapes, rel=1e-12, abs=1e-12)
    assert scatter == pytest.approx(0.0, abs=1e-6)
    assert np.all(real.reshape(3, -1).max(axis=1) >= -real.reshape(3, -1).min(axis=1))


def test_the_real_part_is_the_largest_of_all_phases() -> None:
    rng = np.random.default_rng(3)
    z = rng.normal(size=(1, 9, 3)) + 0.4j * rng.normal(size=(1, 9, 3))
    real, _ = real_shapes(z * np.exp(0.7j))
    turned = [np.linalg.norm((z * np.exp(1j * a)).real) for a in np.linspace(0, np.pi, 721)]
    assert np.linalg.norm(real) == pytest.approx(max(turned), rel=1e-4)


def test_phase_scatter_of_known_phases() -> None:
    """Equal amplitudes at +-20 and 180 +- 20 degrees scatter by 20; a travelling wave by 52."""
    z = np.zeros((2, 360, 3), complex)
    z[0, :, 2] = np.exp(1j * np.radians(np.resize([20.0, -20.0, 160.0, 200.0], 360)))
    z[1, :, 2] = np.exp(1j * np.radians(np.arange(360.0)))
    _, scatter = real_shapes(z)
    assert scatter == pytest.approx([20.0, 180.0 / np.sqrt(12.0)], rel=2e-3)


def test_complex_shapes_in_a_table_are_made_real_and_named(tmp_path: Path) -> None:
    text = CSV.replace("mode,point,uz", "mode,point,uz,uz_im").replace("T1,front,1", "T1,front,1,1")
    text = text.replace("B1,front,1.0", "B1,front,1.0,0.4")
    modes = read_modes(written(tmp_path, text))
    z = np.array([1.0 + 0.4j, 1.1])
    angle = np.angle(z * np.exp(-0.5j * np.angle(sum(z**2))))
    expected = np.degrees(np.sqrt(np.average(angle**2, weights=abs(z))))
    assert modes.complexity[0] == pytest.approx(expected)
    assert modes.warnings[0].startswith(f"mode 1: its phases scatter by {expected:.1f} degrees")
    assert "travelling" not in modes.warnings[0]
    path = tmp_path / "real.csv"
    write_modes(modes, path)
    assert_same(modes, read_modes(path))
    wave = CSV.replace("mode,point,uz", "mode,point,uz,uz_im")
    wave = wave.replace("T1,rear,-0.9", "T1,rear,0.1,-0.9")
    assert "mode 2" in read_modes(written(tmp_path, wave)).warnings[0]
    assert "travelling" in read_modes(written(tmp_path, wave)).warnings[0]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("-25,140,0", "-25,140x,0", "modes.csv:7: y: got '140x'"),
        ("-25,140,0", "-25,,0", "modes.csv:7: y: missing"),
        ("-25,140,0", "-25,nan,0", "modes.csv:7: y: got 'nan'"),
        ("4.5,6.2", "inf,6.2", "modes.csv:11: frequency_hz: got 'inf'"),
        ("4.5,6.2", "-4.5,6.2", "mode 1: frequency: got -4.5"),
        ("4.5,6.2", "4.5,0", "mode 1: modal mass: got 0.0"),
        ("4.5,6.2", "4.5,", "mode 1: modal mass: missing"),
        ("6.2,0.01", "6.2,1.5", "mode 1: damping: got 1.5"),
        ("rear,25", "front,25", "modes.csv:8: got 'point front'; must stand once"),
        ("rear,25", "rear,-25", "points: got 'front and rear'; are in one place"),
        ("B1,rear,1.1\n", "", "mode B1, point rear: missing"),
        ("B1,rear,1.1", "B1,rear,1.1\nB1,rear,1.1", "modes.csv:18: got 'mode B1 at point rear'"),
        ("B1,rear,1.1", "B1,wing,1.1", "shapes: point: got 'wing'"),
        ("B1,rear,1.1", "B9,rear,1.1", "shapes: mode: got 'B9'"),
        ("B1,rear,1.1", "B1,rear,1,1", "modes.csv:17: cells: got 4"),
        ("B1,rear,1.1", ",rear,1.1", "modes.csv:17: mode: missing"),
        ("T1,front,1\nT1,rear,-0.9", "T1,front,2.0\nT1,rear,2.2", "smallest singular value"),
        ("T1,front,1\nT1,rear,-0.9", "T1,front,0\nT1,rear,0", "mode 2: shape: got 0.0"),
        ("mode,point,uz", "mode,point,w", "modes.csv:14: column: got 'w'"),
        ("point,x,y,z", "point,x,z", "modes.csv:5: y: missing"),
        ("point,x,y,z\n", "", "modes.csv:5: got 'root,0,0,0'"),
        ("length_unit: mm", "length_unit: kg", "modes.csv:2: length_unit"),
        ("mode,frequency_hz", "point,x,y\na,1,2\nmode,frequency_hz", "points must stand once"),
        ("rear,25", '"rear,25', "modes.csv:8: got"),
    ],
)
def test_what_is_wrong_in_a_table_is_named_with_its_line(tmp_path, old, new, words) -> None:
    assert CSV.count(old) == 1
    text = refusal(written(tmp_path, CSV.replace(old, new)))
    assert words in text
    assert "modes.csv" in text


def test_like_shapes_are_named(tmp_path: Path) -> None:
    text = CSV.replace("T1,front,1\nT1,rear,-0.9", "T1,front,2.0\nT1,rear,2.2")
    assert "most alike are modes 1 and 2" in refusal(written(tmp_path, text))


@pytest.mark.parametrize("table", ["points", "modes", "shapes"])
def test_a_missing_table_is_named(tmp_path: Path, table: str) -> None:
    parts = CSV.split("\n\n")
    part = {"points": 1, "modes": 2, "shapes": 3}[table]
    text = "\n\n".join(parts[:part] + parts[part + 1 :])
    assert f"modes.csv: {table}: missing" in refusal(written(tmp_path, text + "\n"))


def test_files_that_are_none(tmp_path: Path) -> None:
    assert "no such file" in refusal(tmp_path / "missing.csv")
    assert "no such file" in refusal(tmp_path)
    assert "bytes: got 0" in refusal(written(tmp_path, ""))
    junk = tmp_path / "junk.csv"
    junk.write_bytes(bytes(range(128, 256)) * 9)
    assert "must be text" in refusal(junk)
    junk.write_bytes(b"MZ\0\1" * 50)
    assert "must be one of CSV" in refusal(junk)
    assert "must be one of CSV" in refusal(written(tmp_path, "something", "modes.unv"))


def test_huge_files_are_refused(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(read_modes.__globals__, "LARGEST_FILE", 100)
    assert "must be 1 to 100" in refusal(written(tmp_path, CSV))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"length_unit": 0.0}, "length_unit"),
        ({"mass_unit": np.nan}, "mass_unit"),
        ({"modal_mass": -1.0}, "modal_mass"),
        ({"count": 0}, "count"),
        ({"count": 3}, "must be at most 2"),
        ({"geometry": "model.bdf"}, "no such file"),
        ({"length_unit": 1e30}, "below 1e+15"),
    ],
)
def test_wrong_wishes_are_refused(tmp_path: Path, options, words) -> None:
    assert words in refusal(written(tmp_path, CSV), **options)


def test_geometry_is_for_punch_files_alone(tmp_path: Path) -> None:
    path = written(tmp_path, CSV)
    assert "punch files alone" in refusal(path, geometry=path)


def test_mode_sets_of_arrays_are_checked_too() -> None:
    good = random_mode_set(3)
    for change, words in (
        ({"modal_mass": good.modal_mass[:2]}, "must have the shape"),
        ({"names": good.names[:3]}, "one for each point"),
        ({"shapes": np.where(good.shapes == good.shapes.max(), np.nan, good.shapes)}, "finite"),
        ({"points": np.full((8, 3), np.inf)}, "point .*: x"),
        ({"complexity": np.full(3, 99.0)}, "phase scatter"),
        ({"names": ("a",) * 8}, "must stand once"),
        ({"names": ("#1", *good.names[1:])}, "must be printable"),
        ({"names": ("a\nb", *good.names[1:])}, "must be printable"),
    ):
        with pytest.raises(InputError, match=words):
            replace(good, **change)
    with pytest.raises(InputError, match="number of modes"):
        mode_set([], np.zeros((0, 8, 3)), good.points)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.drop_vars("position"), "position: missing"),
        (lambda d: d.rename(mode="order"), r"must be over \(mode"),
        (lambda d: d.isel(axis=[0, 1]), "must have 3 axes"),
        (lambda d: d.assign(frequency=("mode", ["a", "b", "c"])), "must be numbers"),
        (lambda d: d.assign(position=d.position.assign_attrs(units="kg")), "position: units"),
        (lambda d: d.drop_vars("modal_mass"), "modal mass: missing"),
    ],
)
def test_what_is_wrong_in_a_netcdf_file_is_named(tmp_path: Path, change, words) -> None:
    import xarray

    write_modes(random_mode_set(1), tmp_path / "good.nc")
    dataset = xarray.load_dataset(tmp_path / "good.nc", engine="h5netcdf")
    change(dataset).to_netcdf(tmp_path / "bad.nc", engine="h5netcdf")
    with pytest.raises(InputError, match=words):
        read_modes(tmp_path / "bad.nc")


def test_netcdf_may_have_complex_shapes_and_other_units(tmp_path: Path) -> None:
    import xarray

    write_modes(random_mode_set(1), tmp_path / "real.nc")
    dataset = xarray.load_dataset(tmp_path / "real.nc", engine="h5netcdf")
    turned = dataset.assign(
        shape=dataset["shape"] * np.cos(1.0), shape_imag=dataset["shape"] * np.sin(1.0)
    ).drop_vars(["phase_scatter", "damping", "point_name"])
    turned["position"].attrs["units"] = "mm"
    turned["modal_mass"].attrs["units"] = "g"
    turned.to_netcdf(tmp_path / "complex.nc", engine="h5netcdf")
    real, back = read_modes(tmp_path / "real.nc"), read_modes(tmp_path / "complex.nc")
    assert np.abs(back.shapes) == pytest.approx(np.abs(real.shapes), rel=1e-12)
    assert back.points == pytest.approx(real.points * 1e-3)
    assert back.modal_mass == pytest.approx(real.modal_mass * 1e-3)
    assert back.names[:2] == ("1", "2")
    assert back.complexity == pytest.approx(0.0, abs=1e-5)
