"""The documentation runs: Python, models, commands and links; its tables are complete.

A block of text that follows a block of Python is its output, word for word.
"""

import contextlib
import io
import re
import shlex
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import pytest

from foldwing.cli.main import run
from foldwing.model import DerivativesTable, Surface, parse_model
from foldwing.model.modes_file import ModesTable
from foldwing.model.quantities import Quantity
from foldwing.model.record import Record
from foldwing.model.schema import (
    AircraftTable,
    FuselageTable,
    HingeTable,
    ModelFile,
    SegmentTable,
    TailTable,
    WingTable,
)
from foldwing.results.variables import COORDINATES, VARIABLES

ROOT = Path(__file__).parents[2]
DOCS = sorted((ROOT / "docs").glob("*.md"))
PAGES = [*DOCS, *(path for path in [ROOT / "README.md"] if path.exists())]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

# What a model lacks that shows only one of its tables.
REST = '[[wing.segment]]\nspan = "14 cm"\nchord = "5 cm"\nthickness = "2 mm"\nmaterial = "sheet"\n'
REST += '[material.sheet]\nyoungs_modulus = "3 GPa"\npoissons_ratio = 0.4\ndensity = 1145\n'


@dataclass(frozen=True)
class Block:
    """A fenced block, the line it starts at, and the output that the page gives for it."""

    line: int
    language: str
    text: str
    output: str | None


def blocks(page):
    """Return the fenced blocks of a page in order."""
    text = page.read_text(encoding="utf-8")
    matches = list(FENCE.finditer(text))
    result = []
    for match, following in zip_longest(matches, matches[1:]):
        adjacent = following is not None and not text[match.end() : following.start()].strip()
        output = following[2] if adjacent and following[1] == "text" else None
        line = text.count("\n", 0, match.start()) + 2
        result.append(Block(line, match[1], match[2], output))
    return result


def models():
    """Every model of the pages, as parameters."""
    for page in PAGES:
        for block in blocks(page):
            if block.language == "toml":
                yield pytest.param(block.text, id=f"{page.stem}-{block.line}")


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_runs_from_top_to_bottom(page, capsys):
    """Commands and Python in one folder; what a block prints is what the page says. Pictures are
    left out, and the commands of the README: both have tests of their own."""
    for block in blocks(page):
        if block.language == "sh" and page in DOCS:
            run_commands(block)
        elif block.language == "python":
            printed = run_python(page, block)
            if block.output is not None:
                assert printed.strip() == block.output.strip(), f"{page.name}:{block.line}"
    assert "Error" not in capsys.readouterr().err


def run_commands(block):
    """Run the lines of a block that start with foldwing."""
    for line in block.text.splitlines():
        if line.startswith("foldwing "):
            words = shlex.split(line.split(">")[0], comments=True)[1:]
            draws = (
                words[0] in ("modes", "flutter", "boundary", "steady", "aircraft", "flight")
                and "--no-plot" not in words
            )
            assert run([*words, *(["--no-plot"] if draws else [])]) == 0, line


def run_python(page, block):
    """Run a block by itself and return what it prints."""
    code = compile("\n" * (block.line - 1) + block.text, str(page), "exec")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(code, {"__name__": "__main__"})
    return printed.getvalue()


@pytest.mark.parametrize("text", models())
def test_models_are_accepted(text):
    """A table shown by itself is completed to a whole model."""
    whole = "[[wing.segment]]" in text
    assert parse_model(text if whole else text + REST).count >= 1


# --------------------------------------------------------------------------- links between pages


def anchors(page):
    """The anchors that the headings of a page get."""
    text = FENCE.sub("", page.read_text(encoding="utf-8"))
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_lead_somewhere(page):
    text = FENCE.sub("", page.read_text(encoding="utf-8"))
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        linked = (page.parent / name).resolve() if name else page
        assert linked.exists(), target
        assert not anchor or anchor in anchors(linked), target


# -------------------------------------------------------------------- tables of keys and variables


def rows(page, heading):
    """The table below a heading: first cell without backquotes -> the other cells."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    section = re.split(r"^##+ ", text.split(f"# {heading}\n", 1)[1], flags=re.MULTILINE)[0]
    lines = [line for line in section.splitlines() if line.startswith("| `")]
    cells = [re.split(r"(?<!\\)\|", line)[1:-1] for line in lines]
    return {row[0].strip().strip("`"): [cell.strip() for cell in row[1:]] for row in cells}


def quantity(field):
    """The quantity of a field of a model, also when the field is optional."""
    marks = [*field.metadata]
    for option in getattr(field.annotation, "__args__", ()):
        marks += getattr(option, "__metadata__", ())
    return next((mark for mark in marks if isinstance(mark, Quantity)), None)


def table(name):
    """The class behind a top-level table of a model file."""
    annotation = ModelFile.model_fields[name].annotation
    options = [annotation, *getattr(annotation, "__args__", ())]
    return next(
        option for option in options if isinstance(option, type) and issubclass(option, Record)
    )


OF_ONE_SEGMENT = set(SegmentTable.model_fields) - set(WingTable.model_fields)

TABLES = [
    ("material", table("material"), set()),
    ("wing and wing.segment", SegmentTable, OF_ONE_SEGMENT),
    ("wing.segment alone", SegmentTable, set(SegmentTable.model_fields) - OF_ONE_SEGMENT),
    ("wing.segment.hinge", HingeTable, set()),
    ("wing.segment.modes", ModesTable, set()),
    ("point_mass", table("point_mass"), set()),
    ("air", table("air"), set()),
    ("analysis", table("analysis"), set()),
    ("lattice", table("lattice"), set()),
    ("aircraft", AircraftTable, {"fuselage", "tail"}),
    ("aircraft.fuselage", FuselageTable, set()),
    ("aircraft.tail", TailTable, set()),
    ("flight", table("flight"), {"wing", "tail", "derivatives"}),
    ("flight.wing and flight.tail", Surface, set()),
    ("flight.derivatives", DerivativesTable, set()),
    ("section", table("section"), set()),
]


@pytest.mark.parametrize(("heading", "model", "elsewhere"), TABLES, ids=[row[0] for row in TABLES])
def test_every_key_is_described(heading, model, elsewhere):
    described = rows("model-file", heading)
    assert set(described) == set(model.model_fields) - elsewhere
    for key, (unit, default, *_) in described.items():
        field = model.model_fields[key]
        kind = quantity(field)
        if kind is not None:
            assert unit == {"degrees": "degree"}.get(kind.bare, kind.unit or "1"), key
        if field.is_required():
            assert default == "required", key
        elif isinstance(field.default, bool):
            assert default == str(field.default).lower(), key
        elif isinstance(field.default, int | float):
            assert float(default) == field.default, key
        elif isinstance(field.default, str):
            assert default.strip("`") == (field.default or "empty"), key


def test_wing_and_top_level_keys_are_described():
    assert set(WingTable.model_fields) - {"segment"} == set(rows("model-file", TABLES[1][0]))
    assert set(rows("model-file", "Top level")) == set(ModelFile.model_fields)


@pytest.mark.parametrize(
    ("heading", "known"),
    [("Dimensions and coordinates", COORDINATES), ("Variables", VARIABLES)],
)
def test_every_variable_is_described(heading, known):
    described = rows("results", heading)
    described.pop("fold_2` … `fold_N", None)
    described = {name: cells for name, cells in described.items() if "fold_2" not in name}
    assert list(described) == list(known)
    for name, (dims, unit, *_) in described.items():
        row = known[name]
        written = [tuple(re.findall(r"`(\w+)`", choice)) for choice in dims.split(" or ")]
        assert written == list(row.dims), name
        kind = "truth" if row.dtype == "truth" else "text"
        assert unit == (row.units or kind), name
