"""Modes of a structure on points."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from foldwing.maths.arrays import Real
from foldwing.structure.mode_files.checks import check_mode_set
from foldwing.structure.mode_files.placement import Placement


@dataclass(frozen=True, eq=False)
class ModeSet:
    """Natural modes of a structure, in SI units.

    A shape is the displacement of the points per unit of its modal coordinate, u = shape q, with q
    in m and shapes without unit; the kinetic energy of a mode is 1/2 modal_mass (dq/dt)^2.

    Attributes
    ----------
    frequencies : array, shape (m,)
        Natural frequencies in Hz.
    modal_mass : array, shape (m,)
        In kg, for the shapes as they are.
    points : array, shape (k, 3)
        Positions in m.
    shapes : array, shape (m, k, 3)
        Real displacements of every point.
    damping : array, shape (m,)
        Viscous damping ratios; nan where unknown.
    complexity : array, shape (m,)
        Phase scatter in degrees of the shapes before they were made real; 0 for real ones.
    names : tuple of str
        Of the points.
    source : str
        Where the modes are from, for messages.
    warnings : tuple of str
        What is to be doubted about them, one sentence each.

    Raises
    ------
    InputError
        When the modes cannot be those of a structure, see `check_mode_set`.
    """

    frequencies: Real
    modal_mass: Real
    points: Real
    shapes: Real
    damping: Real
    complexity: Real
    names: tuple[str, ...]
    source: str = "mode set"
    warnings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        check_mode_set(self)

    @property
    def count(self) -> int:
        """Number m of modes."""
        return len(self.frequencies)

    @cached_property
    def size(self) -> float:
        """Largest extent of the points along one axis in m."""
        return float(np.ptp(self.points, axis=0).max())

    def placed(self, placement: Placement) -> "ModeSet":
        """Return these modes in the local axes of a segment."""
        return replace(
            self, points=placement.points(self.points), shapes=placement.vectors(self.shapes)
        )
