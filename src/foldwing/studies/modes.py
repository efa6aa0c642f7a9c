"""Natural frequencies and mode shapes over a grid of fold angles."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.model import Wing
from foldwing.results.provenance import NO_SOURCE, Source, provenance
from foldwing.results.schema import build_dataset
from foldwing.stability.status import Status
from foldwing.structure.assembly import assemble
from foldwing.structure.following import FollowedModes, follow_modes
from foldwing.structure.mass_centres import mass_centres
from foldwing.structure.modes import StructuralModes
from foldwing.studies.grid import radians, swept_hinge
from foldwing.studies.measured import Measured
from foldwing.studies.shapes import SurfaceGrid, surface_grid

if TYPE_CHECKING:
    import xarray

METHOD = "component modes of the segments joined in the null space of their constraints"

Variables = dict[str, Any]


def modes_study(
    wing: Wing,
    cases: Sequence[tuple[float, ...]],
    *,
    source: Source = NO_SOURCE,
    measured: Measured | None = None,
) -> tuple["xarray.Dataset", list[FollowedModes]]:
    """Return the dataset of every case, followed from case to case, and the modes themselves.

    Parameters
    ----------
    wing : Wing
    cases : sequence of tuple of float
        psi_2 .. psi_N in degrees of each case.
    source : Source
        What was asked for, kept with the result.
    measured : Measured, optional
        Measured points to lay over the picture.
    """
    followed = follow_modes(assemble(wing), [radians(case) for case in cases])
    grid = surface_grid(wing)
    hinge = swept_hinge(cases)
    attrs: dict[str, Any] = provenance(
        wing.title, "modes", source.model_text, METHOD, source.options
    )
    attrs |= {} if hinge is None else {"swept": f"fold_{hinge}"}
    variables = mode_variables(followed) | shape_variables(followed, grid)
    variables["status"] = (("fold",), np.full(len(cases), int(Status.OK)))
    coords = fold_coordinates(cases) | grid.coordinates() | body_coordinates(followed[0].modes)
    coords["mode"] = (("mode",), np.arange(1, followed[0].modes.count + 1))
    if measured is not None:
        points, numbers = measured.variables(hinge)
        variables, coords = variables | points, coords | numbers
    dataset = build_dataset(variables, coords, attrs)
    return dataset, followed


def fold_coordinates(cases: Sequence[tuple[float, ...]]) -> Variables:
    """Return the dataset coordinates of the cases."""
    coords: Variables = {"fold": (("fold",), np.arange(len(cases)))}
    for hinge, angles in enumerate(zip(*cases, strict=True), start=2):
        coords[f"fold_{hinge}"] = (("fold",), np.array(angles, float))
    return coords


def mode_variables(followed: Sequence[FollowedModes]) -> Variables:
    """Return frequencies, names and confidence; the names are those of the first case."""
    dims = ("fold", "mode")
    names = followed[0].modes.names
    return {
        "natural_frequency": (dims, np.array([case.modes.frequencies for case in followed])),
        "mode_name": (dims, np.array([names] * len(followed))),
        "mode_confidence": (dims, np.array([case.confidence for case in followed])),
        "bending_share": (dims, np.array([case.modes.bending_share for case in followed])),
    }


def shape_variables(followed: Sequence[FollowedModes], grid: SurfaceGrid) -> Variables:
    """Return positions at rest and displacements of the modes, largest displacement 1 m.

    Of points on the surface, and of mass centres.
    """
    positions = np.array([grid.position(case.modes) for case in followed])
    shapes = np.array([grid.displacement(case.modes) for case in followed])
    bodies = [mass_centres(case.modes) for case in followed]
    moved = np.array([[body.displacement for body in those] for those in bodies])
    both = np.concatenate([shapes, moved], axis=1)
    largest = np.linalg.norm(both, axis=2).max(axis=1)[:, None, None, :]
    return {
        "position": (("fold", "point", "axis"), positions),
        "mode_shape": (("fold", "mode", "point", "axis"), np.moveaxis(shapes / largest, 3, 1)),
        "mass_centre": (
            ("fold", "body", "axis"),
            np.array([[body.position for body in those] for those in bodies]),
        ),
        "mass_centre_shape": (
            ("fold", "mode", "body", "axis"),
            np.moveaxis(moved / largest, 3, 1),
        ),
    }


def body_coordinates(modes: StructuralModes) -> Variables:
    """Return the dataset coordinate of the mass centres."""
    return {"body": (("body",), np.array([body.name for body in mass_centres(modes)], np.str_))}
