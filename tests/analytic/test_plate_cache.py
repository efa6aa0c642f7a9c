"""What is kept of plates never changes an answer, and no damage to it ends a run."""

from dataclasses import fields

import numpy as np
import pytest

from foldwing.model import rectangle
from foldwing.structure import plate_cache
from foldwing.structure.component import Root
from foldwing.structure.plate import Plate, plate_modes
from foldwing.structure.plate_elastic import ElasticModes
from support.plates import SQUARE, sheet


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A cache of this test alone, and nothing held from before."""
    monkeypatch.setenv("FOLDWING_CACHE", str(tmp_path))
    forget()
    yield tmp_path / "plates"
    forget()


def forget():
    """As a new process would start."""
    plate_cache._kept.cache_clear()


def kept(of=None, planform=SQUARE, count=4, size=0.02):
    return plate_cache.kept_elastic_modes(planform, of or sheet(), count, True, size)


def never(*_):
    raise AssertionError("computed anew")


def assert_same(first, second):
    for field in fields(ElasticModes):
        np.testing.assert_array_equal(getattr(first, field.name), getattr(second, field.name))


def test_a_plate_is_computed_once(folder, monkeypatch):
    """In this process and in later ones, whoever made the equal outline and sheet."""
    first = kept()
    monkeypatch.setattr(plate_cache, "elastic_modes", never)
    twin = SQUARE.model_copy(), sheet().model_copy()
    assert twin[0].array is not None
    assert kept(twin[1], twin[0]) is first
    forget()
    assert_same(kept(), first)


def test_only_the_elastic_axis_does_not_count(folder):
    """Everything else gives another file; where sections have their plunge costs nothing."""
    kept()
    others = [
        {"of": sheet(poissons_ratio=0.31)},
        {"of": sheet(thickness=((0.001, 0.0011),))},
        {"planform": rectangle(0.1, 0.1, 0.4)},
        {"count": 5},
        {"size": 0.021},
    ]
    for number, other in enumerate(others, start=2):
        kept(**other)
        assert len(list(folder.iterdir())) == number
    for axis in (0.3, 0.5):
        plate_modes(Plate(SQUARE, sheet(), axis), 4, Root.CLAMPED, 0.02)
    assert len(list(folder.iterdir())) == 1 + len(others)


def test_plates_held_by_two_segments_cannot_be_changed(folder):
    with pytest.raises(ValueError, match="read-only"):
        kept().coefficients[0] = 0.0


@pytest.mark.parametrize("damage", ["empty", "short", "flipped", "other"])
def test_a_damaged_file_is_computed_anew_and_replaced(folder, damage):
    first = kept()
    (file,) = folder.iterdir()
    content = bytearray(file.read_bytes())
    if damage == "flipped":
        content[len(content) // 2] ^= 0xFF
    elif damage == "other":
        np.savez(file, points=np.zeros(3))
        content = bytearray(file.read_bytes())
    file.write_bytes(content[: {"empty": 0, "short": len(content) // 2}.get(damage, len(content))])
    forget()
    assert_same(kept(), first)
    forget()
    assert [other.name for other in folder.iterdir()] == [file.name]
    assert plate_cache._read(file) is not None


def test_a_folder_that_cannot_be_written_is_done_without(tmp_path, monkeypatch):
    """Here a file stands in its place."""
    (tmp_path / "taken").write_text("a file")
    monkeypatch.setenv("FOLDWING_CACHE", str(tmp_path / "taken"))
    forget()
    assert kept().omega2[0] > 0.0
    assert [file.name for file in tmp_path.iterdir()] == ["taken"]


def test_an_empty_name_keeps_nothing_on_disk(tmp_path, monkeypatch):
    monkeypatch.setenv("FOLDWING_CACHE", "")
    monkeypatch.chdir(tmp_path)
    forget()
    assert plate_cache.cache_folder() is None
    assert kept().omega2[0] > 0.0
    assert list(tmp_path.iterdir()) == []


def test_by_default_the_folder_is_that_of_the_users_caches(monkeypatch, tmp_path):
    monkeypatch.delenv("FOLDWING_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    found = plate_cache.cache_folder()
    assert found is not None and found.parts[-2:] == ("foldwing", "plates")


def test_the_oldest_files_make_room(folder, monkeypatch):
    monkeypatch.setattr(plate_cache, "FILES", 2)
    for count in (1, 2, 3, 4):
        kept(count=count)
    assert len(list(folder.iterdir())) == 2
