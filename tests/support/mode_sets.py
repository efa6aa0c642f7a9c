"""Mode sets that stand in for exports of other programs: natural modes of a beam segment."""

from dataclasses import replace

import numpy as np
import scipy.linalg

from foldwing.model import Planform, Segment
from foldwing.model.planform import rectangle
from foldwing.structure.beam import BeamModes
from foldwing.structure.component import Root
from foldwing.structure.mode_files import ModeSet
from foldwing.structure.rigid_properties import RigidProperties
from foldwing.structure.spanwise import bending_functions, torsion_functions

SEGMENT = Segment(
    span=0.3,
    chord=0.1,
    bending_stiffness=0.05,
    torsion_stiffness=0.08,
    mass_per_span=0.09,
    inertia_per_span=0.09 * 0.1**2 / 12.0,  # of an even sheet
)


def outline(segment: Segment = SEGMENT) -> Planform:
    """Outline of a beam segment."""
    return rectangle(segment.span, segment.chord, segment.elastic_axis)


def body(segment: Segment = SEGMENT) -> RigidProperties:
    """Rigid properties of a beam segment with its centre on the elastic axis: thin in x."""
    m, L = segment.mass_per_span * segment.span, segment.span
    return RigidProperties(m, (0.0, L / 2), m * L**2 / 3, segment.inertia_per_span * L, 0.0)


def beam(root: Root, segment: Segment = SEGMENT, bending: int = 6, torsion: int = 4) -> BeamModes:
    """Beam modes in the functions that are natural modes of one uniform segment."""
    return BeamModes(
        segment,
        bending_functions(segment.span, bending, root, "free-free"),
        torsion_functions(segment.span, torsion, root, "free-free"),
        root,
    )


def grid(segment: Segment = SEGMENT, along: int = 31, across: int = 7) -> np.ndarray:
    """Points over the outline, shape (k, 3)."""
    front = -segment.elastic_axis * segment.chord
    x, y = np.meshgrid(
        front + np.linspace(0.0, segment.chord, across), np.linspace(0.0, segment.span, along)
    )
    return np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])


def beam_mode_set(
    root: Root, segment: Segment = SEGMENT, points: np.ndarray | None = None, count: int | None = 10
) -> ModeSet:
    """Natural modes of a beam segment on points, rigid ones included."""
    modes = beam(root, segment)
    points = grid(segment) if points is None else points
    n = modes.plunge.count + modes.twist.count
    squares, vectors = scipy.linalg.eigh(modes.stiffness[:n, :n], modes.mass[:n, :n])
    u = modes.displacement(points[:, 0], points[:, 1])[:, :, :n] @ vectors[:, :count]
    return mode_set(
        np.sqrt(np.maximum(squares[:count], 0.0)) / (2 * np.pi), u.transpose(2, 0, 1), points
    )


def only(modes: ModeSet, picked) -> ModeSet:
    """Some of the modes."""
    names = ("frequencies", "modal_mass", "shapes", "damping", "complexity")
    return replace(modes, **{name: getattr(modes, name)[picked] for name in names})


def on_points(modes: ModeSet, picked) -> ModeSet:
    """The modes on some of their points."""
    names = tuple(modes.names[i] for i in picked)
    return replace(modes, points=modes.points[picked], shapes=modes.shapes[:, picked], names=names)


def mode_set(frequencies, shapes, points, **changes) -> ModeSet:
    """Modes of unit modal mass."""
    m = len(frequencies)
    modes = ModeSet(
        frequencies=np.asarray(frequencies, float),
        modal_mass=np.ones(m),
        points=np.asarray(points, float),
        shapes=np.asarray(shapes, float),
        damping=np.full(m, np.nan),
        complexity=np.zeros(m),
        names=tuple(str(i + 1) for i in range(len(points))),
    )
    return replace(modes, **changes) if changes else modes


def random_mode_set(seed: int, modes: int = 3, points: int = 8) -> ModeSet:
    """Modes of random numbers of many magnitudes, with all that a file may hold."""
    rng = np.random.default_rng(seed)
    scale = 10.0 ** rng.integers(-6, 6, modes)
    return ModeSet(
        frequencies=rng.uniform(0.0, 300.0, modes),
        modal_mass=rng.uniform(1e-6, 5.0, modes),
        points=rng.normal(size=(points, 3)) / 3.0,
        shapes=rng.normal(size=(modes, points, 3)) * scale[:, None, None],
        damping=np.where(rng.random(modes) < 0.3, np.nan, rng.uniform(1e-4, 0.1, modes)),
        complexity=rng.uniform(0.0, 50.0, modes),
        names=tuple(str(n) for n in rng.choice(10**6, points, replace=False) + 1),
    )
