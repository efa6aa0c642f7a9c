"""The report: one HTML file that works without a network, in light and dark."""

import html
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from foldwing.plots.catalogue import films, pictures
from foldwing.plots.events import words
from foldwing.plots.interactive import figure
from foldwing.plots.palette import THEMES
from foldwing.results.aircraft_table import (
    clamped_rows,
    motions_table,
    points_table,
    trim_table,
)
from foldwing.results.cases import degrees, fold_text
from foldwing.results.flight_table import (
    derivatives_table,
    models_table,
    modes_table,
    speeds_table,
    trim_text,
)
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.schema import fold_angle_names
from foldwing.results.section_table import changes_table, section_points_table
from foldwing.results.steady_table import legend, loads_table, segments_table
from foldwing.results.summary import answer, certificate, warnings
from foldwing.stability.status import ELASTIC

if TYPE_CHECKING:
    import xarray

    from foldwing.plots.picture import Picture

_LONG_TABLE = 24

_STYLE = """
:root { color-scheme: light dark; LIGHT }
@media (prefers-color-scheme: dark) { :root { DARK } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 66rem; padding: 1.5rem 1rem 4rem; background: var(--paper);
  color: var(--ink); font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.6rem; margin: 0; line-height: 1.25; }
h2 { font-size: 1.15rem; margin: 2.6rem 0 .2rem; line-height: 1.3; }
.answer { font-size: 1.2rem; font-weight: 600; border-left: 4px solid var(--series0);
  padding: .1rem 0 .1rem .8rem; margin: 1rem 0; }
.caption, .small { color: var(--muted); font-size: .9rem; margin: .1rem 0 .6rem; }
.scroll { overflow: auto; max-height: 32rem; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th { text-align: left; position: sticky; top: 0; background: var(--paper); font-weight: 600; }
th, td { padding: .25rem .7rem .25rem 0; border-bottom: 1px solid var(--grid);
  white-space: nowrap; }
th { white-space: normal; vertical-align: bottom; }
td.number, th.number { text-align: right; }
pre { background: color-mix(in srgb, var(--grid) 45%, transparent); padding: .8rem;
  overflow: auto; font-size: .85rem; border-radius: 4px; }
dt { font-weight: 600; } dd { margin: 0 0 .5rem; overflow-wrap: anywhere; }
"""

_SCRIPT = """
const themes = THEMES, figures = FIGURES;
const dark = window.matchMedia("(prefers-color-scheme: dark)");
function paint(node, colors) {
  if (typeof node === "string") {
    const role = /^@(\\w+)(?:\\/([\\d.]+))?$/.exec(node);
    if (!role) return node;
    const color = colors[role[1]];
    if (!role[2]) return color;
    const [r, g, b] = [1, 3, 5].map(i => parseInt(color.slice(i, i + 2), 16));
    return `rgba(${r},${g},${b},${role[2]})`;
  }
  if (Array.isArray(node)) return node.map(value => paint(value, colors));
  if (node && typeof node === "object") {
    return Object.fromEntries(Object.entries(node).map(([k, v]) => [k, paint(v, colors)]));
  }
  return node;
}
function show() {
  const colors = themes[dark.matches ? "dark" : "light"];
  figures.forEach((figure, number) => {
    const inSpace = figure.data.some(trace => trace.scene);
    const buttons = inSpace ? ["orbitRotation", "zoom3d", "pan3d", "resetCameraDefault3d"]
                            : ["zoom2d", "pan2d", "resetScale2d"];
    const config = {responsive: true, displaylogo: false,
                    modeBarButtons: [[...buttons, "toImage"]]};
    Plotly.react(`figure-${number}`, {...paint(figure, colors), config});
  });
}
show();
dark.addEventListener("change", show);
"""


def write_report(dataset: "xarray.Dataset", path: Path) -> None:
    """Write the report of a dataset.

    It holds the answer in one line, all pictures, the table of flutter points, what is certified,
    and the model, the options and the version that made it.
    """
    path.write_text(report_html(dataset), encoding="utf-8")


def report_html(dataset: "xarray.Dataset") -> str:
    """Return the report as HTML text."""
    from plotly.offline import get_plotlyjs

    shown = [picture for picture in pictures(dataset) if picture.name != "flutter-motion"]
    shown += films(dataset)
    script = _SCRIPT.replace("THEMES", _json(THEMES)).replace(
        "FIGURES", _json([figure(picture) for picture in shown])
    )
    title = html.escape(str(dataset.attrs["title"]))
    body = [
        f"<h1>{title}</h1>",
        f'<p class="answer">{html.escape(answer(dataset))}</p>',
        *_certificate(dataset),
        *(_section(number, picture) for number, picture in enumerate(shown)),
        *_table(dataset),
        *_provenance(dataset),
    ]
    return "\n".join(
        [
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{title}</title>\n<style>{_style()}</style>",
            f"<script>{get_plotlyjs()}</script>\n</head>\n<body>",
            *body,
            f"<script>{script}</script>\n</body>\n</html>\n",
        ]
    )


def _json(value: Any) -> str:
    """JSON that may stand inside a script element."""
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c")


def _style() -> str:
    light, dark = (
        " ".join(f"--{role}: {color};" for role, color in THEMES[theme].items())
        for theme in ("light", "dark")
    )
    return _STYLE.replace("LIGHT", light).replace("DARK", dark)


def _section(number: int, picture: "Picture") -> str:
    return (
        f"<h2>{html.escape(picture.title)}</h2>\n"
        f'<p class="caption">{html.escape(picture.caption)}</p>\n'
        f'<div id="figure-{number}"></div>'
    )


def _certificate(dataset: "xarray.Dataset") -> list[str]:
    texts = filter(None, (certificate(dataset), *warnings(dataset)))
    return [f'<p class="small">{html.escape(text)}</p>' for text in texts]


def _table(dataset: "xarray.Dataset") -> list[str]:
    if dataset.attrs["kind"] == "modes":
        return []
    if dataset.attrs["kind"] == "steady":
        return _loads(dataset)
    if dataset.attrs["kind"] == "section":
        return _section_tables(dataset)
    if dataset.attrs["kind"] == "flight":
        return _flight(dataset)
    return [*_points(dataset), *_aircraft(dataset)]


def _points(dataset: "xarray.Dataset") -> list[str]:
    """Return the table of flutter points."""
    rows = flutter_rows(dataset)
    if not rows:
        return ["<h2>Flutter points</h2>", "<p>None were found.</p>"]
    hinges = [name.removeprefix("fold_") for name in fold_angle_names(dataset)]
    motions = any(row.motion != ELASTIC for row in rows)
    heads = [*(f"hinge {hinge}" for hinge in hinges), *_COLUMNS, *["motion"][: int(motions)]]
    lines = [(*_cells(row), *[row.motion][: int(motions)]) for row in rows]
    table = _html(heads, lines)
    note = f" ({len(rows)} rows)" if len(rows) > _LONG_TABLE else ""
    return [f"<h2>Flutter points{note}</h2>", f'<div class="scroll">{table}</div>']


def _html(heads: Sequence[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f"<th>{html.escape(text)}</th>" for text in heads)
    lines = "".join(_line(row) for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table>"


def _loads(dataset: "xarray.Dataset") -> list[str]:
    """Return the loads on the wing, and those on the segments of the first case."""
    first = fold_text(dataset, 0)
    return [
        "<h2>Steady loads</h2>",
        f'<p class="small">{html.escape(legend(dataset))}</p>',
        f'<div class="scroll">{_html(*loads_table(dataset))}</div>',
        f"<h2>On each segment{f', {first}' if first else ''}</h2>",
        f'<div class="scroll">{_html(*segments_table(dataset))}</div>',
    ]


def _aircraft(dataset: "xarray.Dataset") -> list[str]:
    """Return the clamped wing, trim and motions of an aircraft; nothing of other datasets."""
    if "trim_angle" not in dataset:
        return []
    fixed = clamped_rows(dataset)
    heading = "<h2>The same wing with its root clamped</h2>"
    parts = [heading, "<p>It could not be computed.</p>"]
    if fixed is not None:
        table = _html(*points_table(fixed))
        parts[1] = table if fixed else "<p>No flutter points were found.</p>"
    tables = (
        ("Level flight of the half aircraft; lift coefficients by airspeed", trim_table),
        ("Motions of the aircraft as a whole; ζ is the damping ratio", motions_table),
    )
    for title, make in tables:
        parts += [f"<h2>{title}</h2>", f'<div class="scroll">{_html(*make(dataset))}</div>']
    return parts


def _flight(dataset: "xarray.Dataset") -> list[str]:
    """Return the modes of the aircraft, by all models and at all airspeeds, and its derivatives."""
    tables = [
        ("Modes of the four states", modes_table(dataset)),
        ("Beside other models", models_table(dataset)),
    ]
    if "X_u" in dataset:
        tables.append(("Stability derivatives in N, N m", derivatives_table(dataset)))
    if "swept_eigenvalue" in dataset:
        tables.append(("Against airspeed, in trim at each", speeds_table(dataset)))
    parts = [
        f'<h2>{title}</h2><div class="scroll">{_html(*table)}</div>' for title, table in tables
    ]
    return [*parts, f'<p class="small">{html.escape(trim_text(dataset))}</p>']


def _section_tables(dataset: "xarray.Dataset") -> list[str]:
    """Return the flutter points of a section, and where the lowest onset changes."""
    points, changes = section_points_table(dataset), changes_table(dataset)
    parts = ["<h2>Flutter points</h2>"]
    parts.append(f'<div class="scroll">{_html(*points)}</div>' if points.rows else "<p>None.</p>")
    if changes.rows:
        parts.append("<h2>Where the lowest onset goes over to another curve</h2>")
        parts.append(f'<div class="scroll">{_html(*changes)}</div>')
    return parts


_COLUMNS = ("what happens", "speed (m/s)", "frequency (Hz)", "mode", "class", "strength (s/m)")


def _cells(row: FlutterRow) -> Sequence[str]:
    flutter = row.kind == "flutter"
    return (
        *(degrees(angle) for angle in row.fold),
        words(row),
        f"{row.speed:.2f}",
        f"{row.frequency:.2f}" if flutter else "",
        row.mode_name,
        row.classification,
        f"{row.strength:.5f}" if row.strength == row.strength else "",
    )


def _line(cells: Iterable[str]) -> str:
    return f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in cells)}</tr>"


def _provenance(dataset: "xarray.Dataset") -> list[str]:
    attrs = dataset.attrs
    options = json.loads(attrs["options"])
    chosen = ", ".join(f"{name} = {value}" for name, value in options.items()) or "none"
    entries = {
        "Method": attrs["method"],
        "Options": chosen,
        "Made by": f"foldwing {attrs['foldwing_version']} on {attrs['created']}",
        "Model, SHA-256": attrs["model_hash"],
    }
    listed = "".join(
        f"<dt>{html.escape(name)}</dt><dd>{html.escape(str(value))}</dd>"
        for name, value in entries.items()
    )
    return [
        "<h2>How this was computed</h2>",
        f"<dl>{listed}</dl>",
        "<h2>The model</h2>",
        f"<pre>{html.escape(attrs['model_text'])}</pre>",
    ]
