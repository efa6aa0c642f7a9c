"""When a vortex lattice is refused, and what makes its results doubtful, in words."""

import math
from collections.abc import Sequence

import numpy as np

from foldwing.aerodynamics.lattice import Strips, closeness, mesh_segments
from foldwing.errors import InputError
from foldwing.model import Segment, Wing

DEFAULT_LIFT_SLOPE = float(Segment.model_fields["lift_slope"].default)

WIDE = 0.1
"""Width of a gap in chords above which it is named."""

TOUCHING, CLOSE = 1e-3, 0.1
"""Distance of segments, in widths of a strip, below which a lattice is refused or doubtful."""


def gap_warning(wing: Wing) -> str:
    """Return in words that the lattice is too coarse for narrow gaps, or gaps are very wide."""
    meshes = mesh_segments(wing)
    narrow, wide = [], []
    for number, hinge in enumerate(wing.hinges, start=2):
        beside = [np.diff(meshes[number - 2].edges)[-1], np.diff(meshes[number - 1].edges)[0]]
        if 0.0 < hinge.gap < max(beside) and wing.lattice.spacing != "inset":
            narrow.append(str(number))
        if hinge.gap > WIDE * min(wing.segments[i].chord for i in (number - 2, number - 1)):
            wide.append(str(number))
    texts = (
        (
            narrow,
            "narrower than the strips beside: forces may be 10 % off, less with inset spacing",
        ),
        (wide, f"wider than {WIDE:g} chords"),
    )
    return " ".join(f"Gaps of hinges {', '.join(who)} are {text}." for who, text in texts if who)


def unused_warning(wing: Wing) -> str:
    """Return in words that the model says something of which a lattice makes no use."""
    slopes = {segment.lift_slope for segment in wing.segments} - {DEFAULT_LIFT_SLOPE}
    return "The lattice does not use the model's lift_slope." if slopes else ""


def _in_degrees(fold_angles: Sequence[float]) -> str:
    return ", ".join(f"{math.degrees(angle):g}" for angle in fold_angles)


def strips_warning(strips: Strips, fold_angles: Sequence[float], image: bool) -> str:
    """Return in words that segments come too close for a lattice, empty when they do not.

    Parameters
    ----------
    strips : Strips
    fold_angles : sequence of float
        psi_2 .. psi_N in radians, for the message.
    image : bool
        Whether there is a wall at y = 0.

    Raises
    ------
    InputError
        When segments lie on each other, or reach through the wall.
    """
    if image and strips.middle[:, 0].min() <= 0.0:
        limit = "the folded wing must stay on its side of the wall at the root"
        remedy = "Take the wall away (image), or change the angles."
        raise InputError("fold", _in_degrees(fold_angles), limit, remedy)
    near = closeness(strips)
    pair = f"segments {near.segment + 1} and {near.other + 1}"
    if near.ratio < TOUCHING:
        limit = f"{pair} lie on each other, {round(1e3 * near.distance, 6):g} mm apart"
        remedy = "A vortex lattice cannot be folded flat: change the angle by some degrees."
        raise InputError("fold", _in_degrees(fold_angles), limit, remedy)
    if near.ratio < CLOSE:
        return (
            f"{pair.capitalize()} come within {1e3 * near.distance:.2g} mm of each other, "
            f"{near.ratio:.2g} widths of a strip: the lattice is inaccurate there."
        )
    return ""


def check_plain(wing: Wing) -> None:
    """Raise `InputError` unless all segments are rectangles and all hinges run along the stream."""
    if not wing.is_plain:
        limit = "aerodynamics knows rectangular segments and hinges along the stream only"
        remedy = "Use foldwing modes, which takes any outline and flare."
        raise InputError("wing", "another outline or a flared hinge", limit, remedy)


def have_equal_chords(wing: Wing) -> bool:
    """Return whether all segments have the same chord."""
    return len({segment.chord for segment in wing.segments}) == 1


def check_equal_chords(wing: Wing, field: str, value: str, remedy: str) -> None:
    """Raise `InputError` unless one step in time fits all chords.

    Parameters
    ----------
    wing : Wing
    field, value, remedy : str
        What asks for discrete time, and what to do instead, for the message.
    """
    if not have_equal_chords(wing):
        limit = "a discrete-time scheme needs segments of equal chord"
        raise InputError(field, value, limit, remedy)
