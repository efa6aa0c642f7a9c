"""The table of flutter points: rows in the program, variables in a dataset."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from foldwing.results.schema import fold_angle_names
from foldwing.stability.status import ELASTIC, is_critical, is_of_the_whole

if TYPE_CHECKING:
    import xarray

_FIELDS = {
    "case": "case",
    "kind": "kind",
    "event": "event",
    "class": "classification",
    "flutter_speed": "speed",
    "flutter_frequency": "frequency",
    "strength": "strength",
    "branch": "branch",
    "flutter_mode_name": "mode_name",
    "flutter_mode_confidence": "mode_confidence",
    "threshold": "threshold",
    "point_residual": "residual",
    "motion": "motion",
}
"""Variable of the dataset -> field of a row."""


@dataclass(frozen=True)
class FlutterRow:
    """One flutter point of one case.

    Attributes
    ----------
    case : int
        Index of the case along ``fold``.
    fold : tuple of float
        Fold angles psi_2..psi_N in degrees.
    kind : str
        ``flutter`` or ``divergence``.
    event : str
        ``onset``, ``recovery`` or ``merger``.
    classification : str
        ``hump``, ``coalescence`` or empty; the column ``class``.
    speed : float
        Airspeed in m/s.
    frequency : float
        Frequency in Hz, 0 for divergence.
    strength : float
        Strength in s/m; nan for divergence.
    branch : int
        Branch, -1 when not known.
    mode_name : str
        Still-air mode that the root starts from.
    mode_confidence : float
        Confidence in that name, 0..1.
    threshold : float
        Damping ratio at which the point is reported.
    residual : float
        Residual of the flutter equation.
    motion : str
        ``elastic``, ``phugoid``, ``short period`` or ``body freedom``.
    """

    case: int
    fold: tuple[float, ...]
    kind: str
    event: str
    classification: str
    speed: float
    frequency: float
    strength: float
    branch: int
    mode_name: str
    mode_confidence: float
    threshold: float
    residual: float
    motion: str = ELASTIC

    @property
    def as_a_whole(self) -> bool:
        """Whether an aircraft oscillates as a whole here, which bounds no airspeed."""
        return is_of_the_whole(self)

    @property
    def is_critical(self) -> bool:
        """Whether an instability that bounds the airspeed begins here."""
        return is_critical(self)


def table_variables(rows: Sequence[FlutterRow]) -> dict[str, tuple[tuple[str, ...], Any]]:
    """Return the variables on ``flutter_point`` that hold ``rows``, for `build_dataset`.

    The fold angles are not among them: they are the coordinates of ``fold``, which ``case`` points
    to.
    """
    return {
        variable: (("flutter_point",), np.array([getattr(row, field) for row in rows]))
        for variable, field in _FIELDS.items()
    }


def flutter_rows(dataset: "xarray.Dataset") -> list[FlutterRow]:
    """Return the table of flutter points of a dataset; empty when it has none."""
    if "case" not in dataset:
        return []
    angles = [dataset[name].values.tolist() for name in fold_angle_names(dataset)]
    columns = {field: dataset[name].values.tolist() for name, field in _FIELDS.items()}
    table = zip(*columns.values(), strict=True)
    rows = [dict(zip(columns, values, strict=True)) for values in table]
    return [FlutterRow(fold=tuple(angle[row["case"]] for angle in angles), **row) for row in rows]
