"""Pictures of aircraft: what is drawn is what the dataset holds, and what is left out is named."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from foldwing import plots
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.plots.boundary import boundary, boundary_map
from foldwing.plots.catalogue import pictures
from foldwing.plots.clamped import beside_clamped
from foldwing.plots.energy import work_of_segments
from foldwing.plots.events import event_marks
from foldwing.plots.frequencies import natural_frequencies
from foldwing.plots.loci import against_speed, root_locus
from foldwing.plots.motions import motions
from foldwing.plots.palette import mode_colors
from foldwing.plots.picture import Area, Bars, Dot, Graded, Line, Marks, Note, Panel, Rule, Thread
from foldwing.plots.placing import Paper
from foldwing.plots.report import report_html
from foldwing.plots.shapes import mode_shapes
from foldwing.plots.trim import trim, trim_against_speed
from foldwing.results import flutter_rows
from foldwing.results.aircraft_table import trim_table
from foldwing.studies.aircraft import aircraft_study
from foldwing.studies.modes import modes_study
from support import datasets

FOLD = (30.0, -60.0)


@pytest.fixture(name="wing", scope="module")
def _wing():
    return read_model("three-segment-aircraft").with_analysis(bending_modes=4, torsion_modes=3)


@pytest.fixture(name="dataset", scope="module")
def _dataset(wing):
    speeds = np.linspace(0.0, 40.0, 41)
    return aircraft_study(AeroelasticWing(wing), FOLD, speeds=speeds, highest=70.0).dataset


def of(panel, kind):
    return [item for item in panel.items if isinstance(item, kind)]


def curves(panel, quantity):
    """Lines of a quantity by name of the branch."""
    found = [line for line in of(panel, Line) if line.name.startswith(f"{quantity} of ")]
    return {line.name.removeprefix(f"{quantity} of "): line for line in found}


def column(dataset, name):
    return dataset["branch_name"].values.tolist().index(name)


def notes(panel):
    return [note.text for note in of(panel, Note)]


# -------------------------------------------------------------------------------- labels and marks


def test_names_in_the_root_locus_stand_beside_each_other(dataset):
    (panel,) = root_locus(dataset).panels
    paper = Paper(panel.x_range, panel.y_range, 6.02, panel.height * 2.6)
    names = [note for note in of(panel, Note) if note.text in dataset["branch_name"].values]
    assert {"phugoid", "short period", "B1", "D1"} <= {note.text for note in names}
    corners = [paper.inches(note.x, note.y) for note in names]
    for i, j in combinations(range(len(names)), 2):
        across, up = np.abs(corners[i] - corners[j])
        first = min((corners[i][0], names[i].text), (corners[j][0], names[j].text))[1]
        assert up >= 0.12 or across >= 0.06 * len(first), (names[i].text, names[j].text)
    for corner in corners:
        assert 0.0 <= corner[0] <= paper.width and 0.0 <= corner[1] <= paper.height


def test_the_root_locus_marks_where_the_phugoid_turns_real(dataset):
    (panel,) = root_locus(dataset).panels
    (mark,) = [m for m in of(panel, Marks) if "merger" in m.label]
    (row,) = [row for row in flutter_rows(dataset) if row.event == "merger"]
    after = int(np.searchsorted(dataset["speed"].values, row.speed))
    growth = dataset["growth"].values[0]
    phugoid = growth[after - 1, column(dataset, "phugoid")]
    assert mark.y[0] == 0.0 and mark.x[0] == phugoid
    low, high = sorted(growth[after, column(dataset, name)] for name in ("D1", "D2"))
    assert low < mark.x[0] < high


def test_a_real_root_that_leaves_the_magnified_panel_is_named(dataset):
    panels = motions(dataset).panels
    growth = next(p for p in panels if p.y_label.startswith("growth"))
    assert {"D1", "D2"} <= set(notes(growth))
    assert all(growth.y_range[0] <= note.y <= growth.y_range[1] for note in of(growth, Note))


def test_mergers_of_a_motion_and_of_flutter_differ(dataset):
    (row,) = [row for row in flutter_rows(dataset) if row.event == "merger"]
    other = replace(row, motion="elastic", mode_name="B1")
    first, second = event_marks([row, other], [1.0, 2.0], [0.0, 0.0], {})
    assert first.symbol != second.symbol
    assert {first.label, second.label} == {
        "phugoid turns into divergence (merger)", "flutter turns into divergence (merger)",
    }  # fmt: skip


def test_single_mergers_of_neighbouring_folds_are_joined_beside_followed_curves(sweep):
    values = {"id": [1, 1], "fold": [0.0, 10.0], "speed": [20.0, 21.0], "frequency": [9.0, 9.1],
              "strength": [0.1, 0.1], "kind": ["flutter"] * 2}  # fmt: skip
    traced = sweep.assign({f"curve_{key}": ("curve_point", x) for key, x in values.items()})
    mergers = [row for row in flutter_rows(sweep) if row.event == "merger"]
    lines = [i for i in of(boundary(traced).panels[0], Line) if i.color == "divergence"]
    joined = {(x, y) for line in lines for x, y in zip(line.x, line.y, strict=True) if x == x}
    assert joined and joined <= {(row.fold[0], row.speed) for row in mergers}
    twice = traced.isel(flutter_point=np.repeat(np.arange(traced.sizes["flutter_point"]), 2))
    assert not [i for i in of(boundary(twice).panels[0], Line) if i.color == "divergence"]


def test_the_table_of_trim_shows_zero_without_a_sign(dataset):
    tiny = np.full(dataset["surface_lift_coefficient"].shape, -0.0004)
    coefficients = (dataset["surface_lift_coefficient"].dims, tiny)
    rows = trim_table(dataset.assign(surface_lift_coefficient=coefficients)).rows
    assert {cell for row in rows for cell in row[3:]} == {"0.000"}


# ------------------------------------------------------------------------ beside the clamped wing


def test_both_sides_show_their_eigenvalues_on_the_same_axes(dataset):
    panels = beside_clamped(dataset).panels
    assert [panel.x_range for panel in panels] == [panels[0].x_range] * 4
    for left, right in (panels[:2], panels[2:]):
        assert left.y_range == right.y_range
    names = dataset["clamped_branch_name"].values.tolist()
    for name, line in curves(panels[0], "growth").items():
        values = dataset["clamped_eigenvalue"].values[:, names.index(name)]
        np.testing.assert_array_equal(line.y, values.real)
        other = curves(panels[2], "frequency")[name].y
        known = np.isfinite(values.real)
        np.testing.assert_allclose(other[known] * 2.0 * np.pi, np.abs(values.imag[known]))
        assert np.isnan(other[~known]).all()
    for quantity, panel in (("growth", panels[1]), ("frequency", panels[3])):
        for name, line in curves(panel, quantity).items():
            np.testing.assert_array_equal(
                line.y, dataset[quantity].values[0, :, column(dataset, name)]
            )


def test_the_same_mode_has_the_same_colour_on_both_sides_and_in_its_wing_alone(dataset):
    left, right, *_ = (curves(panel, "growth") for panel in beside_clamped(dataset).panels)
    shared = set(left) & set(right)
    assert {"B1", "B2", "T1"} <= shared
    alone = mode_colors(datasets.modes_dataset())
    for name in shared:
        assert left[name].color == right[name].color
    assert [right[name].color for name in ("B1", "B2")] == [alone[name] for name in ("B1", "B2")]
    assert right["phugoid"].dash != right["short period"].dash != right["T1"].dash


def test_every_event_in_view_is_marked_and_written_on_its_side(dataset):
    panels = beside_clamped(dataset).panels
    free = [row.speed for row in flutter_rows(dataset) if row.speed <= 40.0]
    fixed = [u for u in dataset["clamped_flutter_speed"].values.tolist() if u <= 40.0]
    for speeds, above, below in ((fixed, *panels[::2]), (free, *panels[1::2])):
        for panel in (above, below):
            vertical = {r.at for r in of(panel, Rule) if r.along == "x" and r.dash == "dash"}
            assert vertical == set(speeds)
        assert sorted(x for marks in of(below, Marks) for x in marks.x) == sorted(speeds)
        assert sum(" m/s" in text for text in notes(above)) == len(speeds)


def test_the_title_says_what_flight_changes(dataset):
    picture = beside_clamped(dataset)
    assert picture.title.endswith("flutter later, divergence earlier")
    (merger,) = [row.speed for row in flutter_rows(dataset) if row.event == "merger"]
    free = f"in flight: flutter {flutter_rows(dataset)[0].speed:.3g}, divergence {merger:.3g} m/s"
    assert picture.panels[1].title == free
    real = dataset["clamped_flutter_speed"].values[dataset["clamped_kind"].values == "divergence"]
    onset = float(dataset["clamped_flutter_speed"][0])
    assert picture.panels[0].title == (
        f"clamped: flutter {onset:.3g}, divergence {real.min():.3g} m/s"
    )


@pytest.mark.parametrize(
    ("keep_free", "keep_fixed", "words"),
    [
        (False, True, "flutter gone, divergence gone"),
        (True, False, "flutter new, divergence new"),
        (False, False, "flutter in neither, divergence in neither"),
    ],
)
def test_the_title_knows_what_comes_and_goes(dataset, keep_free, keep_fixed, words):
    for kept, name in ((keep_free, "flutter_point"), (keep_fixed, "clamped_point")):
        dataset = dataset if kept else dataset.isel({name: slice(0, 0)})
    assert beside_clamped(dataset).title.endswith(words)


def test_an_equal_onset_is_called_so(dataset):
    changed = dataset.copy(deep=True)
    first = changed["flutter_speed"].values[0]
    changed["clamped_flutter_speed"].values[0] = first * 1.0005
    assert "flutter unchanged, " in beside_clamped(changed).title


# ------------------------------------------------------------------------------ trim and motions


def test_bars_are_the_shares_of_the_weight(dataset):
    panel = trim(dataset).panels[0]
    lengths = np.concatenate([bars.length for bars in of(panel, Bars)])
    np.testing.assert_allclose(lengths, 100.0 * dataset["lift_share"].values[0])
    assert lengths.sum() == pytest.approx(100.0)
    assert [text for _, text in panel.y_ticks] == dataset["surface"].values.tolist()
    assert "53.8 %, 0.612 N" in notes(panel)


def test_trim_against_speed_shows_the_limit_and_the_slowest_flight(dataset):
    lift, angle = trim_against_speed(dataset).panels
    for index, name in enumerate(dataset["surface"].values.tolist()):
        (line,) = [line for line in of(lift, Line) if line.name == name]
        np.testing.assert_array_equal(
            line.y, dataset["surface_lift_coefficient"].values[0, :, index]
        )
    slowest = float(dataset["slowest_speed"][0])
    for panel in (lift, angle):
        assert slowest in [rule.at for rule in of(panel, Rule)]
        (hatched,) = [area for area in of(panel, Area) if area.hatched]
        assert (hatched.x.min(), hatched.x.max()) == (0.0, slowest)
    assert 1.2 in [rule.at for rule in of(lift, Rule) if rule.along == "y"]
    wing = next(line for line in of(angle, Line) if line.name == "wing")
    np.testing.assert_array_equal(wing.y, dataset["trim_angle"].values[0])


def test_the_phugoid_is_magnified_until_it_turns_real(dataset):
    left, _, below, whole = motions(dataset).panels
    phugoid = dataset["growth"].values[0, :, column(dataset, "phugoid")]
    np.testing.assert_array_equal(curves(below, "growth")["phugoid"].y, phugoid)
    assert below.y_range[1] > np.nanmax(phugoid) > 0.3 * below.y_range[1]
    assert np.ptp(whole.y_range) > 30.0 * np.ptp(below.y_range)
    (merger,) = [row for row in flutter_rows(dataset) if row.event == "merger"]
    for panel in (left, below):
        assert merger.speed in [rule.at for rule in of(panel, Rule)]
    (mark,) = of(left, Marks)
    assert (mark.x[0], mark.y[0], mark.symbol) == (merger.speed, 0.0, "triangle-down")
    assert mark.label == "phugoid turns into divergence (merger)"
    assert {"D1", "D2"} <= set(curves(below, "growth"))


def test_without_an_oscillation_of_the_whole_there_is_no_picture_of_it(dataset):
    names = dataset["branch_name"].values.copy()
    names[np.isin(names, ["phugoid", "short period"])] = "P9"
    assert motions(dataset.assign(branch_name=("mode", names))) is None


# ------------------------------------------------------------------------------- other pictures


def test_loci_leave_out_neutral_motions_and_name_them(dataset):
    for picture in (against_speed(dataset), root_locus(dataset)):
        drawn = {getattr(item, "name", "") for panel in picture.panels for item in panel.items}
        assert not {"x", "z", "growth of x", "frequency of z"} & drawn
        assert "motions x and z" in picture.caption
    assert {"phugoid", "short period"} <= {path.name for path in of(picture.panels[0], Graded)}
    assert "Left out" not in against_speed(datasets.flutter_dataset()).caption


def test_airspeeds_out_of_reach_are_hatched_where_there_are_any(dataset):
    for panel in against_speed(dataset).panels:
        (hatched,) = [area for area in of(panel, Area) if area.hatched]
        assert hatched.x.max() == float(dataset["slowest_speed"][0])
        assert (hatched.y.min(), hatched.y.max()) == panel.y_range
        assert hatched.label == "too slow to carry the weight"
    fast = dataset.sel(speed=slice(20.0, None))
    clamped = datasets.flutter_dataset()
    for plain in (fast, clamped):
        assert not any(a.hatched for p in against_speed(plain).panels for a in of(p, Area))


def test_a_search_below_level_flight_stands_for_none(dataset):
    slow = dataset.sel(speed=slice(0.0, 8.0)).assign_attrs(speed_limit=8.0)
    assert "stand for none" in against_speed(slow).caption
    assert "only from 11 m/s on" in motions(slow.assign(growth=slow["growth"].fillna(0.1))).caption


def test_shapes_show_every_centre_of_mass_at_rest_and_displaced(wing):
    dataset, _ = modes_study(wing, [FOLD])
    scenes = mode_shapes(dataset).panels
    assert [scene.title for scene in scenes[:3]] == ["x: 0 Hz", "z: 0 Hz", "pitch: 0 Hz"]
    assert len(scenes) == 9
    rest = dataset["mass_centre"].values[0]
    for mode, scene in enumerate(scenes):
        dots = [item for item in scene.items if isinstance(item, Dot)]
        hollow, filled = ([d.point for d in dots if d.filled == which] for which in (False, True))
        np.testing.assert_array_equal(hollow, rest)
        moved, shape = np.array(filled) - rest, dataset["mass_centre_shape"].values[0, mode]
        across = np.vdot(shape, moved) / np.vdot(shape, shape)
        np.testing.assert_allclose(moved, across * shape, atol=1e-12)
        span = np.ptp(dataset["position"].values[0], axis=0).max()
        assert np.linalg.norm(moved, axis=1).max() < 0.2 * span


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_motion_in_the_plane_of_the_wing_is_drawn_aft(wing, sign):
    dataset, _ = modes_study(wing, [FOLD])
    shapes = {name: sign * dataset[name] for name in ("mode_shape", "mass_centre_shape")}
    first = shapes["mode_shape"].values[0, 0]
    first[:, 2] = -1e-14 * first[:, 0]  # round-off that has the last word
    scene = mode_shapes(dataset.assign(shapes)).panels[0]
    filled = [item.point for item in scene.items if isinstance(item, Dot) and item.filled]
    moved = np.array(filled) - dataset["mass_centre"].values[0]
    assert scene.title == "x: 0 Hz" and moved[:, 0].min() > 0.01


def test_a_line_joins_fuselage_root_and_tail(wing):
    dataset, _ = modes_study(wing, [FOLD])
    pitch = mode_shapes(dataset).panels[2]
    dots = [item for item in pitch.items if isinstance(item, Dot) and item.filled]
    ends = [dot.point for dot in dots if dot.label.endswith(("fuselage", "tail"))]
    (line,) = [
        item
        for item in pitch.items
        if isinstance(item, Thread) and len(item.points) == 3 and item.opacity == 1.0
    ]
    for end in ends:
        assert np.abs(line.points - end).sum(axis=1).min() == 0.0
    steps = np.diff(line.points, axis=0)
    slopes = steps[:, 2] / steps[:, 0]
    assert slopes[0] == pytest.approx(slopes[1], rel=0.02)
    assert abs(slopes[0]) > 0.1


def test_a_clamped_wing_shows_its_own_centre_of_mass(wing):
    dataset, _ = modes_study(wing.clamped, [FOLD])
    for scene in mode_shapes(dataset).panels:
        labels = [item.label for item in scene.items if isinstance(item, Dot) and item.filled]
        assert labels == ["centre of mass: wing"]
    assert "fixed root" in mode_shapes(dataset).caption


def test_zero_modes_are_named_beside_a_logarithmic_axis(wing):
    dataset, _ = modes_study(wing, [(30.0, -60.0), (30.0, 0.0), (30.0, 60.0)])
    (panel,) = natural_frequencies(dataset).panels
    assert panel.log_y
    assert "x, z, pitch: 0 Hz (nothing pulls back)" in notes(panel)
    assert len(of(panel, Line)) == dataset.sizes["mode"] - 3
    assert all((line.y > panel.y_range[0]).all() for line in of(panel, Line))


def test_work_on_the_tail_is_called_so(dataset):
    for panel in work_of_segments(dataset).panels:
        assert [text for _, text in panel.y_ticks] == ["1", "2", "3", "tail", "all"]


# ------------------------------------------------------------------------------------ boundaries


@pytest.fixture(name="sweep")
def _sweep():
    """A boundary of aircraft: its mergers are of the phugoid, which also begins to grow once."""
    plain = datasets.boundary_dataset(10.0, failed=())
    motion = np.full(plain.sizes["flutter_point"], "elastic", "<U12")
    event, kind = plain["event"].values.copy(), plain["kind"].values
    motion[kind == "divergence"] = "phugoid"
    event[kind == "divergence"] = "merger"
    motion[0] = "phugoid"
    slowest = 10.0 + 0.01 * plain["fold_2"].values
    return plain.assign(
        motion=("flutter_point", motion),
        event=("flutter_point", event),
        slowest_speed=("fold", slowest, {"lift_coefficient": 1.2}),
    )


def test_a_phugoid_that_begins_to_grow_is_no_boundary(sweep):
    picture = boundary(sweep)
    apart = flutter_rows(sweep)[0]
    for panel in picture.panels:
        points = {
            (x, y) for marks in of(panel, Marks) for x, y in zip(marks.x, marks.y, strict=True)
        }
        assert (apart.fold[0], apart.speed) not in points
        assert (apart.fold[0], apart.strength) not in points
    assert "Not drawn: where the phugoid begins or ceases to grow" in picture.caption
    assert "Not drawn" not in boundary(datasets.boundary_dataset()).caption


def test_a_merger_of_the_phugoid_is_divergence(sweep):
    speed = boundary(sweep).panels[0]
    mergers = [row for row in flutter_rows(sweep) if row.event == "merger"]
    (marks,) = [m for m in of(speed, Marks) if m.symbol == "triangle-down"]
    assert marks.label == "phugoid turns into divergence (merger)"
    assert sorted(marks.y) == sorted(row.speed for row in mergers)
    shaded = [area for area in of(speed, Area) if area.color == "divergence"]
    starts = {float(y) for area in shaded for y in area.y if np.isfinite(y)} - {45.0}
    assert starts == {row.speed for row in mergers}


def test_the_slowest_level_flight_bounds_a_hatched_region(sweep):
    speed = boundary(sweep).panels[0]
    (line,) = [line for line in of(speed, Line) if line.label.startswith("below: too slow")]
    np.testing.assert_array_equal(line.y, sweep["slowest_speed"].values)
    (hatched,) = [area for area in of(speed, Area) if area.hatched]
    assert set(line.y) | {0.0} == set(hatched.y)


def test_the_map_takes_mergers_and_no_phugoid(sweep):
    columns = sweep.isel(fold=slice(0, 4))
    kept = np.flatnonzero(columns["case"].values < 4)
    grid = columns.isel(flutter_point=kept).assign_coords(
        fold_2=("fold", [0.0, 0.0, 30.0, 30.0]), fold_3=("fold", [0.0, 30.0, 0.0, 30.0])
    )
    (cells,) = boundary_map(grid).panels[0].items
    rows = [row for row in flutter_rows(grid) if row.case == 0 and row.event != "recovery"]
    lowest = min(row.speed for row in rows if row.motion == "elastic" or row.event == "merger")
    assert cells.values[0, 0] == lowest > rows[0].speed


# --------------------------------------------------------------------------- everything together


def test_both_renderers_draw_every_picture(dataset):
    from plotly import graph_objects

    wanted = {"aircraft-beside-clamped", "trim", "trim-against-speed", "motions", "mode-shapes"}
    assert wanted <= set(plots.static_figures(dataset, "dark"))
    for _, _, figure in plots.interactive_figures(dataset, "dark"):
        assert "'@" not in str(figure)
        if not any(name.startswith("scene") for name in figure["layout"]):
            graph_objects.Figure(figure)


def test_everything_has_its_unit(dataset):
    flat = [panel for p in pictures(dataset) for panel in p.panels if isinstance(panel, Panel)]
    for panel in flat:
        assert panel.x_label.endswith(")")
        assert (
            panel.y_label.endswith(")")
            or panel.y_ticks
            or panel.y_label in ("", "lift coefficient")
        )


def test_interactive_scenes_name_each_body_once(dataset):
    shown = {title: figure for title, _, figure in plots.interactive_figures(dataset)}
    scenes = next(figure for title, figure in shown.items() if title.startswith("The shapes"))
    named = [trace["name"] for trace in scenes["data"] if trace.get("showlegend")]
    assert named == [f"centre of mass: {name}" for name in ("wing", "fuselage", "tail", "aircraft")]


def test_the_report_holds_the_tables(dataset):
    text = report_html(dataset)
    for heading in (
        "root clamped",
        "Level flight of the half aircraft",
        "as a whole",
        "motion</th>",
    ):
        assert heading in text
    assert "<td>segment 1</td><td>53.8%</td>" in text
    assert "phugoid turns into divergence (merger)" in text
    assert "Level flight of" not in report_html(datasets.flutter_dataset())
