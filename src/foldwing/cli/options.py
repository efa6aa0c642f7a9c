"""Arguments and options that commands share.

Numbers arrive as text, so that `number` and `whole_number` word their errors like all others.
"""

import os
from pathlib import Path
from typing import Annotated, Literal

import typer

from foldwing.errors import InputError

Model = Annotated[
    str,
    typer.Argument(help="A TOML file, or the name of a shipped example.", show_default=False),
]
Fold = Annotated[
    str | None,
    typer.Option(
        "--fold",
        metavar="DEG,DEG,...",
        help="Fold angles of all hinges from root to tip, 30,-75; instead of the model's.",
    ),
]
FoldOf = Annotated[
    list[str] | None,
    typer.Option(
        "--fold-of",
        metavar="I=ANGLE",
        help="Fold of hinge I: a number, a range start:stop:step, a list 0,60,90, or level. Also "
        "--foldI ANGLE: --fold2 0:150:2.5 --fold3 level.",
    ),
]
Speeds = Annotated[
    str | None,
    typer.Option(
        "--speeds",
        metavar="A:B:STEP",
        help="Airspeeds of the curves in m/s; the last one ends the search for flutter points.",
    ),
]
MaxSpeed = Annotated[
    str | None,
    typer.Option(
        "--max-speed",
        metavar="M/S",
        help="End of the search for flutter points. (default: 3 x divergence of the flat wing)",
    ),
]
Aero = Annotated[
    Literal["strip", "quasi-steady", "lattice"] | None,
    typer.Option(
        "--aero",
        metavar="NAME",
        help="strip (Theodorsen's theory), lattice (unsteady vortex lattice) or quasi-steady (for "
        "comparison). (default: strip, or what an aircraft's model says)",
    ),
]
TailAero = Annotated[
    Literal["theodorsen", "quasi-steady"] | None,
    typer.Option(
        "--tail-aero",
        metavar="NAME",
        help="Aircraft: theodorsen or quasi-steady forces on the tail; not the model's.",
    ),
]
Trim = Annotated[
    Literal["force", "force-and-moment"] | None,
    typer.Option(
        "--trim",
        metavar="NAME",
        help="Aircraft: force (the wing carries all weight) or force-and-moment (the tail balances "
        "it); not the model's.",
    ),
]
Clamped = Annotated[
    bool,
    typer.Option("--clamped", help="Clamp the root of the wing of an aircraft."),
]
DropMode = Annotated[
    list[str] | None,
    typer.Option(
        "--drop-mode",
        metavar="NAME",
        help="Leave a natural mode out, such as B2, to see what it does. May be repeated.",
    ),
]
Panels = Annotated[
    str | None,
    typer.Option(
        "--panels",
        metavar="CxS",
        help="Lattice: panels along the chord and strips along the span, 8x30; not the model's.",
    ),
]
Spacing = Annotated[
    Literal["uniform", "cosine", "inset"] | None,
    typer.Option(
        "--spacing",
        metavar="NAME",
        help="Lattice: uniform strips, cosine (denser at the ends of a segment) or inset (ending a "
        "quarter strip before free edges, most accurate); not the model's.",
    ),
]
Gap = Annotated[
    str | None,
    typer.Option(
        "--gap",
        metavar="WIDTH",
        help='Lattice: opening between the segments at all hinges, "1 mm"; not the model\'s.',
    ),
]
Image = Annotated[
    bool,
    typer.Option("--image", help="Lattice: a wall at the root mirrors the flow."),
]
Alpha = Annotated[
    str,
    typer.Option("--alpha", metavar="DEG", help="Angle of attack of segment 1, nose up."),
]
Speed = Annotated[str, typer.Option("--speed", metavar="M/S", help="Airspeed.")]
Basis = Annotated[
    Literal["free-free", "converged"] | None,
    typer.Option(
        "--basis", metavar="NAME", help="free-free or converged component modes, not the model's."
    ),
]
Structure = Annotated[
    Literal["beam", "plate"] | None,
    typer.Option(
        "--structure",
        metavar="NAME",
        help="beam or plate, for all segments; not the model's.",
    ),
]
Damping = Annotated[
    str | None,
    typer.Option(
        "--damping",
        metavar="RATIO",
        help="Structural damping ratio of every mode, instead of the model's.",
    ),
]
Threshold = Annotated[
    str | None,
    typer.Option(
        "--damping-threshold",
        metavar="RATIO",
        help="Damping ratio of the boundary, positive stable, instead of the model's.",
    ),
]
Measured = Annotated[
    str | None,
    typer.Option(
        "--measured",
        metavar="FILE.csv",
        help="Measured points to lay over the picture: a CSV file or a shipped table.",
    ),
]
Trace = Annotated[
    bool,
    typer.Option(
        "--trace",
        help="Join the points into curves, followed exactly around turns. Slow with the lattice.",
    ),
]
Vary = Annotated[
    str | None,
    typer.Option(
        "--vary",
        metavar="NAME,...",
        help="Vary only these: chordwise, spanwise, wake, time-step, segment-modes, system-modes, "
        "gap. (default: all that the model has)",
    ),
]
Levels = Annotated[
    list[str] | None,
    typer.Option(
        "--levels",
        metavar="NAME=N,N,...",
        help="Values to try, chordwise=4,8,16; the model's own is added. May be repeated.",
    ),
]
Jobs = Annotated[
    str,
    typer.Option(
        "--jobs", metavar="N", help="Processes to run in parallel, at most one for each core."
    ),
]
SectionAero = Annotated[
    Literal["strip", "quasi-steady"],
    typer.Option(
        "--aero",
        metavar="NAME",
        help="strip (Theodorsen's theory) or quasi-steady (for comparison).",
    ),
]
SectionSpeeds = Annotated[
    str | None,
    typer.Option(
        "--speeds",
        metavar="A:B:STEP",
        help="Airspeeds of the curves in m/s, or U/(b omega_1) for a section in ratios; the last "
        "one ends the search.",
    ),
]
SectionMaxSpeed = Annotated[
    str | None,
    typer.Option(
        "--max-speed",
        metavar="U",
        help="End of the search, in the same units. (default: 3 x divergence)",
    ),
]
Torsion = Annotated[
    str | None,
    typer.Option(
        "--torsion",
        metavar="RATIO",
        help="Torsion over plunge frequency: a number, a range 0.5:8:0.1 or a list 1.5,3.7,7; "
        "instead of the model's.",
    ),
]
Method = Annotated[
    Literal["sweep", "reference"],
    typer.Option(
        "--method",
        metavar="NAME",
        help="sweep (all points, certified), or reference: for checking, the lattice as one large "
        "eigenproblem marching in time; takes about a minute, never certified.",
    ),
]
TimeStep = Annotated[
    str | None,
    typer.Option(
        "--time-step",
        metavar="SECONDS",
        help="Reference: the same step at every airspeed, to which the panels are fitted.",
    ),
]
Plot = Annotated[bool, typer.Option("--plot/--no-plot", help="Draw pictures and a report.")]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="DIR",
        help="Folder of the result. (default: a new dated folder)",
    ),
]
Force = Annotated[bool, typer.Option("--force", help="Replace an existing result in --out.")]
Json = Annotated[
    bool,
    typer.Option("--json", help="One JSON document on standard output; no files without --out."),
]

CruiseSpeed = Annotated[
    str | None,
    typer.Option("--speed", metavar="M/S", help="Airspeed of the flight, instead of the model's."),
]
FlightSpeeds = Annotated[
    str | None,
    typer.Option(
        "--speeds",
        metavar="A:B:STEP",
        help="Airspeeds in m/s at which the modes are found too, in trim at each: 25:60:5.",
    ),
]


def number(field: str, text: str | None, example: str) -> float | None:
    """Return the number that an option was given, None when it was left out."""
    return None if text is None else given_number(field, text, example)


def given_number(field: str, text: str, example: str) -> float:
    """Return the number that an option was given or has by default."""
    try:
        return float(text)
    except ValueError:
        remedy = f"Write it without a unit, for example {field} {example}."
        raise InputError(field, text, "must be a number", remedy) from None


def processes(jobs: str) -> int:
    """Return how many processes to run: as asked for, but never more than there are cores."""
    return min(whole_number("--jobs", jobs), os.cpu_count() or 1)


def whole_number(field: str, text: str) -> int:
    """Return the whole number, 1 or more, that an option was given."""
    if not text.isdecimal() or int(text) < 1:
        remedy = f"Write it in digits, for example {field} 4."
        raise InputError(field, text, "must be a whole number, 1 or more", remedy)
    return int(text)
