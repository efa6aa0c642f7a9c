"""Which pictures a dataset has."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from foldwing.plots.boundary import boundary, boundary_map
from foldwing.plots.clamped import beside_clamped
from foldwing.plots.convergence import convergence
from foldwing.plots.determinant import determinant_contours
from foldwing.plots.energy import work_of_modes, work_of_segments
from foldwing.plots.flight import flight_paths, flight_paths_relative
from foldwing.plots.flight_modes import flight_against_speed, flight_eigenvalues
from foldwing.plots.frequencies import natural_frequencies
from foldwing.plots.loads import flutter_circulation, pressure, pressure_of_modes
from foldwing.plots.loci import against_speed, root_locus
from foldwing.plots.motions import motions
from foldwing.plots.picture import Picture
from foldwing.plots.response import response
from foldwing.plots.section import section_boundary
from foldwing.plots.shapes import flutter_films, flutter_phases, mode_shapes
from foldwing.plots.steady import circulation, circulation_across, circulation_in_space
from foldwing.plots.trim import trim, trim_against_speed

if TYPE_CHECKING:
    import xarray

PICTURES: "tuple[Callable[[xarray.Dataset], Picture | None], ...]" = (
    beside_clamped,
    boundary,
    boundary_map,
    against_speed,
    motions,
    trim,
    trim_against_speed,
    root_locus,
    determinant_contours,
    natural_frequencies,
    mode_shapes,
    flutter_phases,
    work_of_segments,
    work_of_modes,
    pressure,
    pressure_of_modes,
    flutter_circulation,
    convergence,
    circulation,
    circulation_across,
    circulation_in_space,
    response,
    flight_eigenvalues,
    flight_against_speed,
    flight_paths,
    flight_paths_relative,
    section_boundary,
)
"""Every picture, the most telling first; each gives None for a dataset that lacks its data."""

LEFT_OUT: "Mapping[str, tuple[Callable[[xarray.Dataset], Picture | None], ...]]" = {
    "flutter": (natural_frequencies,),
    "aircraft": (natural_frequencies,),
    "section": (natural_frequencies,),
}
"""By kind of dataset, pictures that would say what others say already."""


def pictures(dataset: "xarray.Dataset") -> list[Picture]:
    """Return the pictures that can be drawn from a dataset."""
    left_out = LEFT_OUT.get(dataset.attrs["kind"], ())
    drawn = (make(dataset) for make in PICTURES if make not in left_out)
    return [picture for picture in drawn if picture is not None]


def films(dataset: "xarray.Dataset") -> list[Picture]:
    """Return the pictures that move."""
    return flutter_films(dataset)
