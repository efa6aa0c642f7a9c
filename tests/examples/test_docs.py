"""The documentation runs: every block of Python, every model, every command, every link.

A block of text that follows a block of Python is its output, word for word.
"""

import contextlib
import io
import re
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from foldwing.cli.main import run
from foldwing.model import example_text, parse_model
from foldwing.model.quantities import Quantity
from foldwing.model.record import Record
from foldwing.model.schema import HingeTable, ModelFile, SegmentTable, WingTable
from foldwing.results.schema import COORDINATES, VARIABLES

ROOT = Path(__file__).parents[2]
DOCS = sorted((ROOT / "docs").glob("*.md"))
PAGES = [*DOCS, *(path for path in [ROOT / "README.md"] if path.exists())]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

# What a model lacks that shows only one of its tables.
REST = '[[wing.segment]]\nspan = "14 cm"\nchord = "5 cm"\nthickness = "2 mm"\nmaterial = "sheet"\n'
REST += '[material.sheet]\nyoungs_modulus = "3 GPa"\npoissons_ratio = 0.4\ndensity = 1145\n'


@dataclass(frozen=True)
class Block:
    """A fenced block, and the output that the page gives for it."""

    page: Path
    line: int
    language: str
    text: str
    output: str | None


def blocks(*languages):
    """Every block of the pages in one of the languages, as parameters."""
    result = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        matches = list(FENCE.finditer(text))
        for match, following in zip(matches, [*matches[1:], None], strict=False):
            if match[1] not in languages:
                continue
            between = following and text[match.end() : following.start()].strip()
            output = following[2] if following and following[1] == "text" and not between else None
            line = text.count("\n", 0, match.start()) + 2
            block = Block(page, line, match[1], match[2], output)
            result.append(pytest.param(block, id=f"{page.stem}-{line}"))
    return result


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("block", blocks("python"))
def test_python_runs_and_prints_what_the_page_says(block):
    code = compile("\n" * (block.line - 1) + block.text, str(block.page), "exec")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(code, {"__name__": "__main__"})
    if block.output is not None:
        assert printed.getvalue().strip() == block.output.strip()


@pytest.mark.parametrize("block", blocks("toml"))
def test_models_are_accepted(block):
    whole = "[[wing.segment]]" in block.text
    assert parse_model(block.text if whole else block.text + REST).count >= 1


@pytest.mark.parametrize("page", DOCS, ids=lambda page: page.stem)
def test_commands_run(page, capsys):
    """Every line that starts with foldwing; pictures are left out, they have tests of their own."""
    text = page.read_text(encoding="utf-8")
    lines = [line for match in FENCE.finditer(text) if match[1] == "sh" for line in
             match[2].splitlines() if line.startswith("foldwing ")]
    for line in lines:
        words = shlex.split(line.split(">")[0])[1:]
        draws = words[0] in ("modes", "flutter", "boundary") and "--no-plot" not in words
        assert run([*words, *(["--no-plot"] if draws else [])]) == 0, line
    assert "Error" not in capsys.readouterr().err


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


TABLES = [
    ("material", table("material"), set()),
    ("wing and wing.segment", SegmentTable, {"hinge"}),
    ("wing.segment.hinge", HingeTable, set()),
    ("point_mass", table("point_mass"), set()),
    ("air", table("air"), set()),
    ("analysis", table("analysis"), set()),
]


@pytest.mark.parametrize(("heading", "model", "elsewhere"), TABLES, ids=lambda value: str(value))
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
