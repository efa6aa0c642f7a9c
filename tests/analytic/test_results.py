"""Datasets, tables, result folders and the pictures drawn from them."""

import csv
import json
import math
import re
import subprocess
import sys
from dataclasses import replace
from datetime import datetime
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import xarray

from foldwing import plots, results
from foldwing.errors import OutputError
from foldwing.plots.determinant import crossings
from foldwing.plots.interactive import figure as plotly_figure
from foldwing.plots.palette import THEMES
from foldwing.plots.picture import Line, Panel, Picture, spread
from foldwing.plots.static import draw
from foldwing.stability.status import Status
from support import datasets

EVERY = {
    "modes": datasets.modes_dataset,
    "one-fold": lambda: datasets.modes_dataset((30.0,)),
    "flutter": datasets.flutter_dataset,
    "quiet": lambda: datasets.flutter_dataset([]),
    "boundary": datasets.boundary_dataset,
    "all-failed": lambda: datasets.boundary_dataset(30.0, failed=tuple(range(6))),
    "convergence": datasets.convergence_dataset,
    "steady": datasets.steady_dataset,
}


@pytest.fixture(params=EVERY, name="dataset")
def _dataset(request):
    return EVERY[request.param]()


# ---------------------------------------------------------------------------------- datasets


def test_a_dataset_is_read_as_it_was_written(dataset, tmp_path):
    results.write_dataset(dataset, tmp_path / "dataset.nc")
    read = results.read_dataset(tmp_path / "dataset.nc")
    xarray.testing.assert_identical(read, dataset)
    for name, variable in dataset.variables.items():
        assert read[name].dtype.kind == variable.dtype.kind, name
        if name in ("flag_values", "flag_meanings"):
            assert read[name].attrs == variable.attrs


def test_complex_variables_are_pairs_on_disk_and_keep_nan_parts(tmp_path):
    dataset = datasets.flutter_dataset()
    dataset["eigenvalue"].values[0, 3, 1] = complex(math.nan, 2.0)
    dataset["eigenvalue"].values[0, 4, 1] = complex(-0.0, math.inf)
    results.write_dataset(dataset, tmp_path / "a.nc")
    with xarray.open_dataset(tmp_path / "a.nc", engine="h5netcdf") as stored:
        assert {"eigenvalue_real", "eigenvalue_imag", "determinant_real"} <= set(stored)
        assert "eigenvalue" not in stored
    read = results.read_dataset(tmp_path / "a.nc")["eigenvalue"].values
    assert read.tobytes() == dataset["eigenvalue"].values.tobytes()
    assert results.read_dataset(tmp_path / "a.nc")["determinant"].attrs["speed"] == 31.0


def test_every_variable_has_a_unit_and_a_long_name(dataset):
    for name, variable in dataset.variables.items():
        assert variable.attrs["long_name"], name
        assert "units" in variable.attrs, name
    assert dataset["fold_2"].attrs["units"] == "degree"


def test_status_variables_explain_their_flags():
    attrs = datasets.modes_dataset()["status"].attrs
    assert attrs["flag_values"].tolist() == [int(member) for member in Status]
    assert attrs["flag_meanings"].split()[int(Status.FAILED)] == "failed"


@pytest.mark.parametrize(
    ("variables", "coords", "message"),
    [
        ({"frequencies": (("mode",), [1.0])}, {}, r"frequencies.*did you mean 'frequency'"),
        ({"growth": (("speed", "fold", "mode"), np.zeros((1, 1, 1)))}, {}, "growth: got dim"),
        ({"growth": (("fold", "speed", "mode"), np.zeros((1, 1, 1), complex))}, {}, "complex128"),
        ({"certified": (("fold",), [2])}, {}, "certified.*truth"),
        ({}, {"sped": (("speed",), [1.0])}, "did you mean 'speed'"),
        ({}, {"fold_1": (("fold",), [1.0])}, "unknown coordinate 'fold_1'"),
    ],
)
def test_what_the_schema_does_not_know_is_refused(variables, coords, message):
    with pytest.raises(ValueError, match=message):
        results.build_dataset(variables, coords, datasets.attributes("modes"))


def test_a_dataset_without_provenance_is_refused():
    attrs = datasets.attributes("modes")
    del attrs["model_hash"]
    with pytest.raises(ValueError, match="model_hash"):
        results.build_dataset({}, {}, attrs)
    with pytest.raises(ValueError, match="kind: got 'mode'"):
        results.build_dataset({}, {}, datasets.attributes("mode"))


def test_provenance_identifies_the_model():
    attrs = datasets.attributes("modes")
    assert attrs["model_hash"] == results.model_hash(datasets.MODEL_TEXT)
    assert attrs["model_hash"] != results.model_hash(datasets.MODEL_TEXT + " ")
    assert json.loads(attrs["options"])["aero"] == "strip"
    assert attrs["created"] == "2026-11-23T14:15:02+00:00"


# ------------------------------------------------------------------------------------ tables


def test_flutter_rows_survive_the_dataset():
    rows = datasets.boundary_rows(np.arange(0, 151, 30))
    variables = results.table_variables(rows)
    dataset = results.build_dataset(
        variables, datasets.fold_coords(np.arange(0, 151, 30)), datasets.attributes("boundary")
    )
    back = results.flutter_rows(dataset)
    assert [str(row) for row in back] == [str(row) for row in rows]  # nan equals nan as text


def test_csv_holds_the_table_in_full_precision(tmp_path):
    rows = [
        replace(datasets.flutter_table()[0], speed=0.1 + 0.2),
        replace(datasets.flutter_table()[3], fold=(30.0, -30.0)),
    ]
    results.write_csv(datasets.flutter_dataset(rows), tmp_path / "points.csv")
    with (tmp_path / "points.csv").open(newline="") as file:
        lines = list(csv.DictReader(file))
    assert (
        list(lines[0])
        == (
            "case fold_2 fold_3 kind event class speed frequency strength branch mode_name "
            "mode_confidence threshold motion"
        ).split()
    )
    assert float(lines[0]["speed"]) == 0.1 + 0.2
    assert (lines[0]["class"], lines[0]["mode_name"], lines[0]["fold_3"]) == ("hump", "B2", "-30.0")
    assert (lines[1]["kind"], lines[1]["strength"]) == ("divergence", "")


def test_csv_of_no_points_is_a_header(tmp_path):
    results.write_csv(datasets.flutter_dataset([]), tmp_path / "points.csv")
    assert (tmp_path / "points.csv").read_text().count("\n") == 1


def test_frequencies_csv_has_one_line_for_each_case_and_mode(tmp_path):
    dataset = datasets.modes_dataset((0.0, 45.0), modes=3)
    results.write_frequencies_csv(dataset, tmp_path / "f.csv")
    lines = (tmp_path / "f.csv").read_text().splitlines()
    assert len(lines) == 1 + 2 * 3
    assert lines[0].startswith("case,fold_2,fold_3,mode,mode_name,natural_frequency,")
    assert lines[1].startswith("0,0.0,0.0,1,B1,5.6,1.0,0.93")
    assert lines[4].startswith("1,45.0,-45.0,1,B1,")


# ----------------------------------------------------------------------------------- folders


def _write_result(path, text="new", force=False):
    with results.result_folder(path, force) as folder:
        (folder / "dataset.nc").write_text(text)


def test_a_result_appears_only_when_it_is_whole(tmp_path):
    with results.result_folder(tmp_path / "a" / "out") as folder:
        (folder / "dataset.nc").write_text("x")
        assert not (tmp_path / "a" / "out").exists()
    names = {entry.name for entry in (tmp_path / "a" / "out").iterdir()}
    assert names == {"dataset.nc", "manifest.txt"}
    assert [entry.name for entry in (tmp_path / "a").iterdir()] == ["out"]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_nothing_remains_of_an_interrupted_result(tmp_path, error):
    with pytest.raises(error), results.result_folder(tmp_path / "a" / "out") as folder:
        (folder / "dataset.nc").write_text("x")
        raise error
    assert list(tmp_path.iterdir()) == []


def test_an_existing_result_is_replaced_only_with_force(tmp_path):
    out = tmp_path / "out"
    _write_result(out, "old")
    for attempt in (lambda: _write_result(out), lambda: results.check_writable(out)):
        with pytest.raises(OutputError, match=re.escape(str(out)) + ".*--force"):
            attempt()
    assert (out / "dataset.nc").read_text() == "old"
    results.check_writable(out, force=True)
    _write_result(out, "new", force=True)
    assert (out / "dataset.nc").read_text() == "new"
    assert [entry.name for entry in tmp_path.iterdir()] == ["out"]


def test_the_old_result_stays_when_its_replacement_fails(tmp_path):
    out = tmp_path / "out"
    _write_result(out, "old")
    with pytest.raises(RuntimeError), results.result_folder(out, force=True) as folder:
        (folder / "dataset.nc").write_text("half")
        raise RuntimeError
    assert (out / "dataset.nc").read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["out"]


def test_stale_files_go_and_foreign_files_stay(tmp_path):
    out = tmp_path / "out"
    with results.result_folder(out) as folder:
        (folder / "stale.png").write_text("x")
    (out / "notes").mkdir()
    (out / "notes" / "mine.txt").write_text("keep me")
    _write_result(out, force=True)
    _write_result(out, force=True)
    assert not (out / "stale.png").exists()
    assert (out / "notes" / "mine.txt").read_text() == "keep me"


def test_a_foreign_file_is_never_replaced(tmp_path):
    out = tmp_path / "out"
    _write_result(out)
    (out / "model.toml").write_text("mine")
    with (
        pytest.raises(OutputError, match=r"model\.toml"),
        results.result_folder(out, force=True) as folder,
    ):
        (folder / "model.toml").write_text("theirs")
    assert (out / "model.toml").read_text() == "mine"


def test_a_folder_of_someone_else_is_refused_even_with_force(tmp_path):
    (tmp_path / "model.toml").write_text("mine")
    with pytest.raises(OutputError, match="not a foldwing result"):
        _write_result(tmp_path, force=True)
    assert [entry.name for entry in tmp_path.iterdir()] == ["model.toml"]


def test_an_empty_folder_may_be_used(tmp_path):
    (tmp_path / "out").mkdir()
    results.check_writable(tmp_path / "out")
    _write_result(tmp_path / "out")
    assert (tmp_path / "out" / "dataset.nc").exists()


@pytest.mark.parametrize("attempt", [results.check_writable, _write_result])
def test_an_unwritable_place_is_named(tmp_path, attempt):
    (tmp_path / "file").write_text("x")
    for place in (tmp_path / "file", tmp_path / "file" / "out"):
        with pytest.raises(OutputError, match=re.escape(str(place))):
            attempt(place)


def test_default_folders_are_dated_and_new(tmp_path):
    now = datetime(2026, 11, 23, 14, 15, 2)
    first = results.default_folder("boundary", "models/Three segment.toml", now, tmp_path)
    assert first.name == "foldwing-boundary-three-segment-2026-11-23-141502"
    first.mkdir()
    second = results.default_folder("boundary", "models/Three segment.toml", now, tmp_path)
    assert second.name == f"{first.name}-2"


# ----------------------------------------------------------------------------------- summary


def test_the_answer_names_the_lowest_onsets():
    assert results.answer(datasets.flutter_dataset()) == (
        "Flutter begins at 14 m/s with 31.9 Hz (mode B2, a hump that ends at 21.5 m/s); "
        "flutter again from 31 m/s (mode T1); divergence begins at 36.5 m/s."
    )
    quiet = results.answer(datasets.flutter_dataset([]))
    assert quiet == "No flutter or divergence found up to 40 m/s."
    boundary = results.answer(datasets.boundary_dataset())
    assert "10.8 m/s (flutter, fold 0°, 0°, mode B2 at 31 Hz)" in boundary
    assert "5.6 Hz (mode B1" in results.answer(datasets.modes_dataset())


def test_the_answer_claims_stability_only_where_it_is_certified():
    quiet = datasets.flutter_dataset([])
    quiet["certified"].values[:] = False
    assert results.answer(quiet).endswith("up to 40 m/s, but the case is not certified.")
    boundary = datasets.boundary_dataset().isel(flutter_point=slice(0, 0))
    assert results.answer(boundary) == (
        "No flutter or divergence found up to 45 m/s in 30 of 31 cases, but 1 is not certified."
    )
    assert results.answer(EVERY["all-failed"]()) == "All 6 cases failed."


def test_the_certificate_names_the_cases_without_one():
    text = results.certificate(datasets.boundary_dataset())
    assert text.startswith("29 of 31 cases certified")
    assert "Not certified: fold 65°, −65°." in text
    assert "Failed: fold 120°, −120°." in text
    assert results.certificate(datasets.flutter_dataset()).startswith("Certified")
    failed = results.certificate(EVERY["all-failed"]())
    assert "certified:" not in failed and failed.startswith("Failed: ")


# ---------------------------------------------------------------------------------- pictures


EXPECTED = {
    "modes": {"natural-frequencies", "mode-shapes"},
    "one-fold": {"natural-frequencies", "mode-shapes"},
    "flutter": {
        "growth-and-frequency",
        "root-locus",
        "determinant",
        "flutter-motion",
    },
    "quiet": {"growth-and-frequency", "root-locus", "determinant"},
    "boundary": {"boundary", "natural-frequencies"},
    "all-failed": {"boundary"},
    "convergence": {"convergence"},
    "steady": {"circulation", "circulation-across", "circulation-in-space"},
}


@pytest.mark.parametrize("kind", EVERY)
def test_each_dataset_has_its_pictures(kind):
    assert set(plots.static_figures(EVERY[kind]())) == EXPECTED[kind]


@pytest.mark.parametrize("theme", THEMES)
def test_every_picture_is_written_in_every_theme(dataset, theme, tmp_path):
    names = plots.write_pictures(dataset, tmp_path, (theme,), ("png", "svg"))
    assert sorted(names) == sorted(entry.name for entry in tmp_path.iterdir())
    assert all((theme == "dark") == ("-dark." in name) for name in names)
    assert all((tmp_path / name).stat().st_size > 4000 for name in names)


def _labels(figure):
    return [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]


def _texts(figure):
    shown = [text.get_text() for axes in figure.axes for text in axes.texts]
    return shown + [text.get_text() for text in figure.texts]


def _legend(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_axes_carry_units():
    flutter = plots.static_figures(datasets.flutter_dataset())
    assert _labels(flutter["growth-and-frequency"]) == [
        ("", "growth rate (1/s)"),
        ("airspeed (m/s)", "frequency (Hz)"),
    ]
    assert _labels(flutter["root-locus"])[0] == ("growth rate (1/s)", "frequency (Hz)")
    boundary = plots.static_figures(datasets.boundary_dataset())
    assert [y for _, y in _labels(boundary["boundary"])] == [
        "airspeed (m/s)",
        "flutter frequency (Hz)",
        "strength (s/m)",
    ]
    assert _labels(boundary["boundary"])[-1][0] == "fold angle of hinge 2 (degrees)"


def test_lines_are_named_at_their_ends():
    figure = plots.static_figures(datasets.modes_dataset())["natural-frequencies"]
    assert set(datasets.NAMES) <= set(_texts(figure))
    assert len(figure.axes[0].lines) == len(datasets.NAMES)


def test_exact_speeds_are_written_at_their_rules():
    figure = plots.static_figures(datasets.flutter_dataset())["growth-and-frequency"]
    expected = {
        "flutter begins 14 m/s",
        "flutter ends 21.5 m/s",
        "flutter begins 31 m/s",
        "divergence begins 36.5 m/s",
    }
    assert expected <= set(_texts(figure))
    rules = {line.get_xdata()[0] for line in figure.axes[1].lines if len(line.get_xdata()) == 2}
    assert {14.0, 21.5, 31.0, 36.5} <= rules


def _points(axes, marker, filled):
    paper = THEMES["light"]["paper"]
    lines = [
        line
        for line in axes.lines
        if line.get_marker() == marker and (line.get_markerfacecolor() != paper) == filled
    ]
    return sum(len(line.get_xdata()) for line in lines)


def test_symbols_tell_the_events_apart():
    dataset = datasets.boundary_dataset()
    axes = plots.static_figures(dataset)["boundary"].axes[0]
    rows = results.flutter_rows(dataset)

    def count(kind, event):
        return sum((row.kind, row.event) == (kind, event) for row in rows)

    assert _points(axes, "o", True) == count("flutter", "onset") > 0
    assert _points(axes, "o", False) == count("flutter", "recovery") > 0
    assert _points(axes, "s", True) == count("divergence", "onset") > 0
    assert _points(axes, "D", True) == count("divergence", "merger") == 1
    assert _points(axes, "*", True) == 5
    uncertified = sum(row.case == 13 for row in rows)
    assert _points(axes, "x", True) == uncertified + 1  # and one failed case


def test_the_legend_explains_every_symbol_once():
    legend = _legend(plots.static_figures(datasets.boundary_dataset())["boundary"])
    assert len(legend) == len(set(legend))
    assert set(legend) == {
        "flutter begins, mode B2",
        "flutter ends, mode B2",
        "flutter begins, mode T1",
        "divergence begins",
        "flutter turns into divergence (merger)",
        "case not certified: may be incomplete",
        "computation failed",
        "measured",
    }


def test_only_close_neighbours_are_joined():
    near = datasets.boundary_dataset(5.0, failed=())
    apart = near.copy(deep=True)
    case = apart["case"].values
    apart["flutter_speed"].values[case >= 15] *= 1.5
    joined, broken = (
        _segments(plots.static_figures(dataset)["boundary"].axes[0]) for dataset in (near, apart)
    )
    assert joined - broken == len({row.event + row.kind + row.mode_name for row in _at(near, 15)})


def _at(dataset, case):
    return [row for row in results.flutter_rows(dataset) if row.case == case]


def _segments(axes):
    lines = [
        line
        for line in axes.lines
        if line.get_linestyle() == "-" and line.get_marker() in ("None", None, "")
    ]
    return sum(int(np.isfinite(line.get_xdata()).sum()) // 2 for line in lines)


def test_cases_without_instability_are_marked_at_the_limit():
    dataset = datasets.boundary_dataset(30.0, failed=())
    stable = dataset.isel(flutter_point=slice(0, 0))
    figure = plots.static_figures(stable)["boundary"]
    assert "stable up to the highest airspeed" in _legend(figure)
    assert _points(figure.axes[0], "^", True) == dataset.sizes["fold"]


def test_a_grid_of_folds_becomes_a_map():
    dataset = datasets.boundary_dataset(30.0, failed=())
    second = dataset["fold_3"].copy(data=[0, 30, 0, 30, 0, 30])
    first = dataset["fold_2"].copy(data=[0, 0, 45, 45, 90, 90])
    grid = dataset.assign_coords(fold_2=first, fold_3=second)
    figures = plots.static_figures(grid)
    assert set(figures) == {"boundary-map"}
    mesh = figures["boundary-map"].axes[0].collections[0]
    lowest = [min(row.speed for row in _at(grid, c) if row.event == "onset") for c in range(6)]
    assert mesh.get_array().T.ravel().tolist() == pytest.approx(lowest)


def test_continuation_curves_replace_the_joining_lines():
    dataset = datasets.boundary_dataset(10.0, failed=())
    samples = {
        "curve_id": [1, 1, 1, 2, 2],
        "curve_fold": [0.0, 50.0, 90.0, 0.0, 60.0],
        "curve_speed": [10.0, 12.0, 17.0, 33.0, 37.0],
        "curve_frequency": [31.0, 33.0, 36.0, 0.0, 0.0],
        "curve_strength": [0.003, 0.002, 0.0, np.nan, np.nan],
        "curve_kind": ["flutter"] * 3 + ["divergence"] * 2,
    }
    dims = ("curve_sample",)
    extra = results.build_dataset(
        {name: (dims, values) for name, values in samples.items()}, {}, dataset.attrs
    )
    axes = plots.static_figures(dataset.merge(extra))["boundary"].axes
    curves = [line.get_xydata().tolist() for line in axes[0].lines if line.get_marker() == "None"]
    assert curves[0] == [[0.0, 10.0], [50.0, 12.0], [90.0, 17.0]]
    assert len(curves) == 2


def test_curves_of_the_determinant_cross_at_its_zeros():
    x, y = np.linspace(-3, 3, 61), np.linspace(0, 4, 41)
    s = x[:, None] + 1j * y
    roots = [-1.03 + 1.27j, 0.52 + 3.11j, 0.73 + 0.0j]
    pairs = {*roots, *(root.conjugate() for root in roots)}  # real on the real axis
    z = np.prod([s - root for root in pairs], axis=0)
    found = np.array(crossings(x, y, z)).T
    wanted = sorted((root.real, root.imag) for root in roots)
    assert np.array(sorted(map(tuple, found))) == pytest.approx(np.array(wanted), abs=0.01)


def test_spread_keeps_order_and_gaps_and_moves_little():
    values = np.array([5.0, 1.0, 1.1, 0.9, 9.0])
    placed = spread(values, 0.5)
    assert np.array_equal(np.argsort(placed), np.argsort(values))
    assert np.diff(np.sort(placed)).min() >= 0.5 - 1e-12
    assert placed[[0, 4]].tolist() == [5.0, 9.0]
    assert placed[[1, 2, 3]].mean() == pytest.approx(values[[1, 2, 3]].mean())


def test_drawing_leaves_no_global_state():
    program = (
        "import sys, foldwing.plots, foldwing.results\n"
        "assert not {'matplotlib', 'plotly', 'xarray'} & set(sys.modules)\n"
        "import matplotlib\n"
        "before = dict(matplotlib.rcParams)\n"
        "from support import datasets\n"
        "foldwing.plots.static_figures(datasets.flutter_dataset())\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
        "assert dict(matplotlib.rcParams) == before\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, env=_environment())


def _environment():
    import os

    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}


# ------------------------------------------------------------------------- interactive, report


def test_interactive_figures_are_valid_plotly(dataset):
    from plotly import graph_objects

    found = plots.interactive_figures(dataset, "dark")
    assert found
    for title, caption, figure in found:
        assert title and caption.endswith(".")
        assert graph_objects.Figure(figure).data or title.startswith("The airspeeds")
        assert "@" not in json.dumps(figure)


def test_both_renderers_show_the_same_labels():
    from foldwing.plots.catalogue import pictures

    for picture in pictures(datasets.boundary_dataset()):
        shown = {trace["name"] for trace in plotly_figure(picture)["data"] if trace["showlegend"]}
        assert shown == set(_legend(draw(picture)))


def test_the_film_moves_all_segments():
    *_, (_, _, film) = plots.interactive_figures(datasets.flutter_dataset())
    assert len(film["frames"]) == 24
    assert all(frame["traces"] == [0, 1, 2] for frame in film["frames"])
    assert film["frames"][0]["data"][2]["z"] == film["data"][2]["z"]
    assert film["frames"][0]["data"][2]["z"] != film["frames"][6]["data"][2]["z"]
    assert film["layout"]["updatemenus"][0]["buttons"][0]["method"] == "animate"


def test_an_animation_is_written_when_there_is_a_motion(tmp_path):
    from PIL import Image

    assert plots.write_animation(datasets.flutter_dataset(), tmp_path / "a.gif")
    with Image.open(tmp_path / "a.gif") as film:
        assert film.n_frames == 24
    assert not plots.write_animation(datasets.modes_dataset(), tmp_path / "b.gif")
    assert not (tmp_path / "b.gif").exists()


class _Loads(HTMLParser):
    """Collects what a page would fetch, its visible text and the number of its scripts."""

    def __init__(self):
        super().__init__()
        self.fetched, self.text, self.scripts, self._inside = [], [], [], ""

    def handle_starttag(self, tag, attrs):
        self._inside = tag
        self.fetched += [value for name, value in attrs if name in ("src", "href", "srcset")]
        self.fetched += [tag] if tag in ("link", "iframe", "img", "base") else []

    def handle_endtag(self, tag):
        self._inside = ""

    def handle_data(self, data):
        (self.scripts if self._inside == "script" else self.text).append(data)


@pytest.fixture(name="page")
def _page(tmp_path):
    def read(dataset):
        plots.write_report(dataset, tmp_path / "report.html")
        page = _Loads()
        page.feed((tmp_path / "report.html").read_text(encoding="utf-8"))
        return page

    return read


def test_the_report_needs_no_network_and_holds_plotly_once(dataset, page):
    page = page(dataset)
    assert page.fetched == []
    own = [script for script in page.scripts if "Plotly.react" in script and len(script) < 2e6]
    library = [script for script in page.scripts if len(script) > 2e6]
    assert (len(library), len(own)) == (1, 1)
    assert "@import" not in "".join(page.text)
    assert not re.search(r"https?://", own[0])


def test_the_report_tells_the_whole_story(page):
    dataset = datasets.flutter_dataset()
    text = " ".join(page(dataset).text)
    assert results.answer(dataset) in text
    assert results.certificate(dataset) in text
    assert dataset.attrs["model_hash"] in text
    assert 'stiffness = "0.18 N*m/rad"' in text
    assert "aero = strip" in text
    assert "prefers-color-scheme: dark" in text
    for title, _, _ in plots.interactive_figures(dataset):
        assert title in text
    for words in ("flutter begins", "14.00", "31.85", "hump", "divergence begins", "36.50"):
        assert words in text


def test_text_of_the_user_cannot_break_the_report(page):
    dataset = datasets.boundary_dataset()
    dataset["message"] = dataset["message"].astype(object)
    dataset["message"].values[24] = "</script><img src=y>"
    dataset.attrs |= {"title": "</script><img src=x>", "model_text": "<b>&</b></pre>"}
    page = page(dataset)
    assert page.fetched == []
    assert any("</script><img src=x>" in text for text in page.text)
    assert "<b>&</b></pre>" in page.text


def test_reports_of_nothing_say_so(page):
    text = " ".join(page(datasets.flutter_dataset([])).text)
    assert "No flutter or divergence found up to 40 m/s." in text
    assert "None were found." in text


def test_files_of_a_run_fit_into_a_result_folder(tmp_path):
    dataset = datasets.flutter_dataset()
    with results.result_folder(tmp_path / "out") as folder:
        results.write_dataset(dataset, folder / results.DATASET_FILE)
        plots.write_pictures(dataset, folder, formats=("svg",))
    listed = (tmp_path / "out" / "manifest.txt").read_text().splitlines()
    assert Path("root-locus.svg").name in listed and results.DATASET_FILE in listed


# ------------------------------------------------------------------------------- convergence


def test_a_convergence_picture_has_axes_of_its_own_for_each_setting():
    dataset = datasets.convergence_dataset()
    axes = plots.static_figures(dataset)["convergence"].axes
    assert [one.get_xscale() for one in axes] == ["log", "log", "linear"]
    assert [one.get_xlabel() for one in axes] == [
        "panels along the chord",
        "length of the wake (chords)",
        "gap between segments (mm)",
    ]
    assert [[tick.get_text() for tick in one.get_xticklabels()] for one in axes] == [
        ["2", "4", "8", "16"],
        ["10", "20", "40"],
        ["0", "0.5", "1"],
    ]
    boxes = [one.get_position() for one in axes]
    assert boxes[0].y0 == boxes[1].y0 > boxes[2].y1
    assert boxes[0].x1 < boxes[1].x0


def test_interactive_panels_of_a_convergence_picture_do_not_share_an_axis():
    ((_, _, figure),) = plots.interactive_figures(datasets.convergence_dataset())
    layout = figure["layout"]
    assert [layout[name].get("matches") for name in ("xaxis", "xaxis2", "xaxis3")] == [None] * 3
    assert layout["xaxis"]["domain"][1] < layout["xaxis2"]["domain"][0]
    assert layout["xaxis"]["range"][0] == pytest.approx(math.log10(2 / 1.12))
    assert layout["yaxis3"]["domain"][1] < layout["yaxis"]["domain"][0]


def test_the_answer_of_a_convergence_study_names_what_is_not_good_enough():
    dataset = datasets.convergence_dataset()
    assert results.answer(dataset).startswith("Largest error bars of the airspeeds: panels along")
    names = dataset["setting"].values.tolist()
    dataset = dataset.assign_coords(setting=[names[0], names[1], "spanwise"])
    dataset["level_setting"] = dataset["level_setting"].where(
        dataset["level_setting"] != "gap", "spanwise"
    )
    count = dataset.sizes["flutter_point"]
    dataset["mesh_error_speed"].values[:] = 0.005 * dataset["flutter_speed"].values
    assert results.answer(dataset) == (
        f"{count} of {count} flutter points are good to 1 % in airspeed, by chord, span and wake "
        "together."
    )
    dataset["mesh_error_speed"].values[0] *= 4.0
    dataset["error_speed"].values[1, 0] *= 2.0
    text = results.answer(dataset)
    assert text.startswith(f"{count - 1} of {count} ")
    assert text.endswith("(2 %, most of it from the wake).")
    dataset["mesh_error_speed"].values[0] = math.nan
    dataset["error_speed"].values[2, 0] = math.nan
    assert "not known: it is not found at every finer span" in results.answer(dataset)
    dataset["convergence"] = dataset["convergence"].astype("<U12")
    dataset["convergence"].values[2, 0] = "diverging"
    assert "not known: it changes more and more with a finer span" in results.answer(dataset)
    dataset["error_speed"].values[0, 0] = math.nan
    dataset["convergence"].values[0, 0] = "few"
    wanted = "too few levels of the chord, and it changes more and more with a finer span"
    assert wanted in results.answer(dataset)


def test_a_sequence_without_a_limit_is_drawn_relative_to_its_finest_value():
    dataset = datasets.convergence_dataset()
    finest = dataset["level_speed"].values[3, 0]
    dataset["limit_speed"].values[0, 0] = math.nan
    curve = plots.static_figures(dataset)["convergence"].axes[0].lines[2]
    wanted = 100.0 * (dataset["level_speed"].values[:4, 0] / finest - 1.0)
    assert curve.get_ydata() == pytest.approx(wanted)


@pytest.mark.parametrize(("length", "columns"), [(10, 3), (40, 2), (70, 1)])
def test_a_legend_of_long_labels_stays_on_the_page(length, columns):
    x = np.array([0.0, 1.0])
    lines = [Line(x, x, "ink", label=f"{n}".ljust(length, "o")) for n in range(5)]
    figure = draw(Picture("name", "Title", "Caption.", [Panel("x", "y", lines)]))
    box = figure.legends[0].get_window_extent(figure.canvas.get_renderer())
    assert box.x1 <= figure.bbox.x1
    assert figure.legends[0]._ncols == columns
    assert box.y1 < figure.axes[0].get_window_extent().y0
