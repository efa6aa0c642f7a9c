"""Universal files as test systems and other programs write them."""

from pathlib import Path

import numpy as np
import pytest

from foldwing.errors import InputError
from foldwing.structure.mode_files import read_modes

HEAD = "    -1\n{:6d}\n"
END = "    -1\n"
PLACES = {11: (0.0, 0.0, 0.0), 12: (-1.0, 5.5, 0.0), 13: (1.0, 5.5, 0.25), 14: (0.0, 3.0, 0.0)}


def nodes_15(places=PLACES, system=0) -> str:
    rows = (f"{n:10d}{system:10d}{0:10d}{1:10d}" + "".join(f"{v:13.5E}" for v in p) + "\n"
            for n, p in places.items())  # fmt: skip
    return HEAD.format(15) + "".join(rows) + END


def nodes_2411(places=PLACES) -> str:
    """As a modeller writes them: D for E, two lines a node."""
    rows = (f"{n:10d}{0:10d}{0:10d}{11:10d}\n" + "".join(f"{v:25.16E}" for v in p) + "\n"
            for n, p in places.items())  # fmt: skip
    return HEAD.format(2411) + "".join(rows).replace("E", "D") + END


def units(length: float, force: float) -> str:
    numbers = f"{length:25.17E}{force:25.17E}{1.0:25.17E}\n{273.15:25.17E}\n".replace("E", "D")
    return HEAD.format(164) + f"{9:10d}{'USER':>20}{2:10d}\n" + numbers + END


def shape(eigen: str, values: dict, kind=2, data=2, ndv=3, specific=8) -> str:
    """One dataset 55; ``eigen`` is its record 8 and ``values`` the records 9 and 10."""
    record_7 = {2: (2, 4, 1, 1), 3: (2, 6, 1, 1), 5: (2, 1, 1, 1)}[kind]
    lines = ["NONE"] * 5
    lines.append("".join(f"{v:10d}" for v in (1, kind, 2, specific, data, ndv)))
    lines.append("".join(f"{v:10d}" for v in record_7))
    lines.append(eigen)
    for node, row in values.items():
        lines += [f"{node:10d}", "".join(f"{v:13.5E}" for v in row)]
    return HEAD.format(55) + "\n".join(lines) + "\n" + END


def record(*values: float) -> str:
    return "".join(f"{v:13.5E}" for v in values)


def plunging(factor: float = 1.0, ndv: int = 3) -> dict:
    return {n: (0.0, 0.0, factor * (1 + p[1]), *[0.0] * (ndv - 3)) for n, p in PLACES.items()}


def twisting(ndv: int = 3) -> dict:
    return {n: (0.0, 0.0, p[0] + 0.2 * p[2], *[0.0] * (ndv - 3)) for n, p in PLACES.items()}


def written(tmp_path: Path, *parts: str) -> Path:
    path = tmp_path / "test.unv"
    path.write_text("".join(parts))
    return path


@pytest.mark.parametrize("ndv", [3, 6])
@pytest.mark.parametrize("nodes", [nodes_15, nodes_2411])
def test_normal_modes_at_nodes(tmp_path: Path, nodes, ndv: int) -> None:
    first = shape(record(4.5, 2.0, 0.01, 0.0), plunging(ndv=ndv), ndv=ndv)
    second = shape(record(9.0, 3.0, 0.0, 0.04), twisting(ndv), ndv=ndv)
    modes = read_modes(written(tmp_path, nodes(), first, second))
    assert modes.frequencies.tolist() == [4.5, 9.0]
    assert modes.modal_mass.tolist() == [2.0, 3.0]
    assert modes.damping.tolist() == [0.01, 0.02]  # half of the hysteretic one
    assert modes.points == pytest.approx(np.array(list(PLACES.values())))
    assert modes.shapes[1, :, 2] == pytest.approx([0.0, -1.0, 1.05, 0.0])
    assert modes.names == ("11", "12", "13", "14")
    assert not modes.warnings


def test_units_of_the_file_are_turned_into_si(tmp_path: Path) -> None:
    """Inches and pounds force: a unit of mass of 175.127 kg."""
    inches = units(1 / 0.0254, 1 / 4.4482216152605)
    path = written(tmp_path, inches, nodes_15(), shape(record(4.5, 2.0, 0.0, 0.0), plunging()))
    modes = read_modes(path)
    assert modes.points[1] == pytest.approx([-0.0254, 5.5 * 0.0254, 0.0])
    assert modes.modal_mass == pytest.approx([2 * 175.12683524], rel=1e-9)
    assert np.isnan(modes.damping[0])
    other = read_modes(path, length_unit=1.0)
    assert other.points[1, 1] == 5.5
    assert "unit of length" in other.warnings[0]


def test_complex_modes_of_a_test_with_their_eigenvalues(tmp_path: Path) -> None:
    """m = |a| / (2 omega_d) for proportional damping, a = 2 i m omega_d (phase of the shape)^2."""
    omega, zeta, m, phase = 40.0, 0.02, 1.7, np.exp(0.6j)
    damped = omega * np.sqrt(1 - zeta**2)
    a = 2j * m * damped * phase**2
    eigen = record(-zeta * omega, damped, a.real, a.imag, 0.0, 0.0)
    values = {
        n: np.ravel([[v.real, v.imag] for v in phase * np.array(u)]) for n, u in plunging().items()
    }
    conjugate = {n: row * np.resize([1, -1], 6) for n, row in values.items()}
    other = record(-zeta * omega, -damped, a.real, -a.imag, 0.0, 0.0)
    path = written(
        tmp_path,
        nodes_15(),
        shape(eigen, values, kind=3, data=5),
        shape(other, conjugate, kind=3, data=5),
    )
    modes = read_modes(path)
    assert modes.count == 1
    assert modes.frequencies == pytest.approx([omega / (2 * np.pi)], rel=1e-5)
    assert modes.damping == pytest.approx([zeta], rel=1e-4)
    assert modes.modal_mass == pytest.approx([m], rel=1e-4)
    assert modes.shapes[0, :, 2] == pytest.approx([1.0, 6.5, 6.5, 4.0], rel=1e-4)
    assert modes.complexity == pytest.approx([0.0], abs=1e-3)
    assert modes.warnings == ("1 datasets 55 hold no oscillating mode and are left out",)


def test_nodes_without_shape_are_left_out_and_told(tmp_path: Path) -> None:
    values = plunging()
    del values[14]
    modes = read_modes(written(tmp_path, nodes_15(), shape(record(4.5, 2.0, 0.0, 0.0), values)))
    assert modes.names == ("11", "12", "13")
    assert "1 of 4 nodes stand in no shape" in modes.warnings[0]


GOOD = shape(record(4.5, 2.0, 0.0, 0.0), plunging())
WITHOUT_13 = {n: u for n, u in twisting().items() if n != 13}


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ([GOOD], "geometry: missing"),
        ([nodes_15()], "0 datasets 55"),
        ([nodes_15(), GOOD[: len(GOOD) // 2]], "cut short"),
        ([nodes_15(), GOOD, "    -1\n    55\nNONE\n"], "cut short"),
        ([nodes_15(), shape(record(4.5, 0.0, 0.0, 0.0), plunging())], "modal mass: missing"),
        ([nodes_15(), shape(record(-4.5, 1.0, 0.0, 0.0), plunging())], "frequency: got -4.5"),
        (
            [nodes_15(), GOOD, shape(record(9.0, 1.0, 0.0, 0.0), WITHOUT_13)],
            "mode 2: node 13: missing",
        ),
        (
            [nodes_15({n: p for n, p in PLACES.items() if n != 13}), GOOD],
            "mode 1: node: got 13; must be among",
        ),
        ([nodes_15(), shape(record(4.5, 1.0, 0.0, 0.0), {})], "shapes: got 'none'"),
        ([nodes_15(), GOOD, GOOD], "smallest singular value"),
        ([nodes_15() + units(0.0, 1.0), GOOD], "units: length: got 0.0"),
        ([nodes_15({n: (np.nan, *p[1:]) for n, p in PLACES.items()}), GOOD], "point 11: x"),
        ([nodes_15().replace("        13         0", "        13         5"), GOOD], "one coord"),
        (
            [nodes_15().replace("        13         0", "        12         0"), GOOD],
            "node: got 12; must stand once",
        ),
        ([nodes_15(), GOOD.replace("4.50000E+00", "4.5x000E+00")], "can be read"),
        ([nodes_15(), HEAD.format(58) + "NONE\n" * 11 + END], "measured functions"),
        ([nodes_15(), shape(record(4.5), plunging(), kind=5)], "1 datasets 55, none of them"),
    ],
)
def test_what_is_wrong_in_a_universal_file_is_named(tmp_path: Path, parts, words) -> None:
    with pytest.raises(InputError) as caught:
        read_modes(written(tmp_path, *parts))
    assert words in str(caught.value)
    assert "test.unv" in str(caught.value)


def test_complex_shapes_with_rotations_are_refused(tmp_path: Path) -> None:
    values = {n: np.ones(12) for n in PLACES}
    eigen = record(-1.0, 40.0, 1.0, 0.0, 0.0, 0.0)
    path = written(tmp_path, nodes_15(), shape(eigen, values, kind=3, data=5, ndv=6))
    with pytest.raises(InputError, match=r"test\.unv"):
        read_modes(path)


def test_accelerations_are_taken_as_displacements_and_told(tmp_path: Path) -> None:
    eigen = record(4.5, 2.0, 0.0, 0.0)
    path = written(tmp_path, nodes_15(), shape(eigen, plunging(), specific=12))
    assert "accelerations" in read_modes(path).warnings[0]


def test_without_pyuff_the_remedy_is_an_extra(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyuff", None)
    with pytest.raises(InputError, match=r"foldwing\[universal\]"):
        read_modes(written(tmp_path, nodes_15(), GOOD))
