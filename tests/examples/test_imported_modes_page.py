"""The files that the page on imported modes shows are read, and all describe the same mode."""

import re
from pathlib import Path

import pytest

from foldwing.structure.mode_files import read_modes

PAGE = Path(__file__).parents[2] / "docs" / "imported-modes.md"
NASTRAN = {"length_unit": 1e-3, "mass_unit": 1e3, "modal_mass": 1.0}


def shown(language: str) -> str:
    (block,) = re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text("utf-8"), re.M | re.S)
    return block


@pytest.mark.parametrize(("language", "options"), [("csv", {}), ("unv", {}), ("pch", NASTRAN)])
def test_files_of_the_page_describe_one_mode(tmp_path: Path, language: str, options) -> None:
    path = tmp_path / f"strip.{language}"
    path.write_text(shown(language))
    if language == "pch":
        (tmp_path / "strip.bdf").write_text(shown("bdf"))
        options = options | {"geometry": tmp_path / "strip.bdf"}
    modes = read_modes(path, **options)
    assert modes.frequencies == pytest.approx([4.5], rel=1e-6)
    assert modes.points[1] == pytest.approx([-0.025, 0.14, 0.0])
    receptance = modes.shapes[0, :, 2] ** 2 / modes.modal_mass
    assert receptance[1:] == pytest.approx([1.0 / 6.2e-3, 1.21 / 6.2e-3], rel=1e-5)
    assert not modes.warnings
