"""Steady loads as tables: for the terminal and the report, and as CSV files."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from foldwing.results.cases import degrees
from foldwing.results.schema import fold_angle_names
from foldwing.results.writing import write_table

if TYPE_CHECKING:
    import xarray

WHOLE = (
    "lift_slope", "projected_lift_slope", "lift_coefficient", "lift", "side_force", "induced_drag",
    "least_drag", "efficiency", "pitching_moment", "root_moment", "aerodynamic_centre",
)  # fmt: skip
"""Loads on the wing as a whole, in the order of the columns."""

PER_SEGMENT = (
    "normal_force", "lift", "side_force", "pitching_moment", "bending_moment", "centre_x",
    "centre_y",
)  # fmt: skip
"""Loads on each segment; in the dataset their names begin with ``segment_``."""

_LEGEND = (
    "Eff.: least over actual induced drag (Di) of this shape. A.c.: aerodynamic centre in % of the "
    "root chord."
)
_HINGE_LEGEND = " M2, M3 ...: hinge moments, positive folding up."


class Table(NamedTuple):
    """A table to be read.

    Attributes
    ----------
    heads : tuple of str
        In lower case over words, otherwise over numbers.
    rows : list of tuple of str
    """

    heads: tuple[str, ...]
    rows: list[tuple[str, ...]]


def loads_table(dataset: "xarray.Dataset") -> Table:
    """Return the loads on the wing, one line for each case and each state of its gaps."""
    angles, gaps, hinges = _words(dataset)
    heads = (
        *["fold"][: len(angles[0])], *["gaps"][: len(gaps) - 1],
        "CLα /rad", "L N", "Di N", "Eff.", "A.c. %", *(f"M{hinge} N m" for hinge in hinges),
    )  # fmt: skip
    rows = []
    for case, fold in enumerate(angles):
        for gap, state in enumerate(gaps):
            loads = dataset.isel(fold=case, gap=gap)
            numbers = (
                _text(loads["lift_slope"], "{:.4g}"),
                _text(loads["lift"], "{:.3g}"),
                _text(loads["induced_drag"], "{:.3g}"),
                _text(loads["efficiency"], "{:.3f}"),
                _text(100.0 * loads["aerodynamic_centre"], "{:.1f}"),
                *(_text(moment, "{:.3g}") for moment in loads["hinge_moment"].values),
            )
            rows.append((*fold, *[state][: len(gaps) - 1], *numbers))
    return Table(heads, rows)


def legend(dataset: "xarray.Dataset") -> str:
    """Return what the heads of `loads_table` mean."""
    return _LEGEND + (_HINGE_LEGEND if dataset.sizes["hinge"] else "")


def segments_table(dataset: "xarray.Dataset", case: int = 0) -> Table:
    """Return the loads on each segment of one case."""
    gaps = _words(dataset)[1]
    heads = (
        "segment", *["gaps"][: len(gaps) - 1],
        "N N", "L N", "Pitch N m", "Bend N m", "C.p. % chord", "% Span",
    )  # fmt: skip
    rows = []
    for index, number in enumerate(dataset["wing_segment"].values):
        for gap, state in enumerate(gaps):
            loads = dataset.isel(fold=case, gap=gap, wing_segment=index)
            numbers = (
                _text(loads["segment_normal_force"], "{:.4g}"),
                _text(loads["segment_lift"], "{:.4g}"),
                _text(loads["segment_pitching_moment"], "{:.4g}"),
                _text(loads["segment_bending_moment"], "{:.4g}"),
                _text(100.0 * loads["segment_centre_x"], "{:.1f}"),
                _text(100.0 * loads["segment_centre_y"], "{:.1f}"),
            )
            rows.append((str(number), *[state][: len(gaps) - 1], *numbers))
    return Table(heads, rows)


def _words(dataset: "xarray.Dataset") -> tuple[list[tuple[str, ...]], list[str], list[int]]:
    """Return the fold angles of the cases, none for a wing without hinges; the gaps; the hinges."""
    names = fold_angle_names(dataset)
    cases = [
        tuple(degrees(float(dataset[name][case])) for name in names)
        for case in range(dataset.sizes["fold"])
    ]
    angles: list[tuple[str, ...]] = [(", ".join(case),) if case else () for case in cases]
    return angles, dataset["gap"].values.tolist(), dataset["hinge"].values.tolist()


def _text(value: Any, form: str) -> str:
    number = float(value) + 0.0
    if not np.isfinite(number):
        return "-"
    return form.format(0.0 if abs(number) < 1e-12 else number)


def write_steady_csv(dataset: "xarray.Dataset", folder: Path) -> None:
    """Write ``steady_loads.csv``, ``segment_loads.csv`` and ``circulation.csv``."""
    hinges = dataset["hinge"].values.tolist()
    names = fold_angle_names(dataset)
    first = ("case", *names, "gaps")
    moments = tuple(f"hinge_moment_{hinge}" for hinge in hinges)
    write_table(folder / "steady_loads.csv", (*first, *WHOLE, *moments), _whole(dataset))
    segment = (*first, "segment", *PER_SEGMENT)
    write_table(folder / "segment_loads.csv", segment, _by_segment(dataset))
    columns = ("segment", "inner", "outer", "circulation", "local_lift_coefficient")
    write_table(folder / "circulation.csv", (*first, *columns), _by_strip(dataset))


def _cases(dataset: "xarray.Dataset") -> Iterator[tuple[int, tuple[float, ...]]]:
    names = fold_angle_names(dataset)
    for case in range(dataset.sizes["fold"]):
        yield case, tuple(float(dataset[name][case]) for name in names)


def _whole(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    for case, folds in _cases(dataset):
        for gap, state in enumerate(dataset["gap"].values.tolist()):
            numbers = (float(dataset[name][case, gap]) for name in WHOLE)
            moments = dataset["hinge_moment"].values[case, gap].tolist()
            yield (case, *folds, state, *numbers, *moments)


def _by_segment(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    for case, folds in _cases(dataset):
        for gap, state in enumerate(dataset["gap"].values.tolist()):
            for index, number in enumerate(dataset["wing_segment"].values.tolist()):
                at = (case, gap, index)
                numbers = (float(dataset[f"segment_{name}"].values[at]) for name in PER_SEGMENT)
                yield (case, *folds, state, number, *numbers)


def _by_strip(dataset: "xarray.Dataset") -> Iterator[Sequence[Any]]:
    names = ("strip_gap", "strip_segment", "strip_inner", "strip_outer")
    fixed = [dataset[name].values.tolist() for name in names]
    for case, folds in _cases(dataset):
        values = (
            dataset[n].values[case].tolist()
            for n in ("strip_circulation", "local_lift_coefficient")
        )
        for line in zip(*fixed, *values, strict=True):
            yield (case, *folds, *line)
