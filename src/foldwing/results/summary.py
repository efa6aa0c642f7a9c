"""What a result says, in one line each: the answer and how far it can be trusted."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from foldwing.results.aircraft_summary import (
    elastic_from_start,
    level_flight,
    short_period,
    statically_unstable,
    unstable_motions,
)
from foldwing.results.cases import degrees, fold_text
from foldwing.results.changes import changes_text
from foldwing.results.convergence_table import convergence_answer
from foldwing.results.flight_summary import flight_answer
from foldwing.results.flutter_table import FlutterRow, flutter_rows
from foldwing.results.units import SI, Units, units_of
from foldwing.stability.status import Status

if TYPE_CHECKING:
    import xarray


def answer(dataset: "xarray.Dataset") -> str:
    """Return the result in one line."""
    if dataset.attrs["kind"] == "modes":
        return _modes_answer(dataset)
    if dataset.attrs["kind"] == "convergence":
        return convergence_answer(dataset)
    if dataset.attrs["kind"] == "steady":
        return _steady_answer(dataset)
    if dataset.attrs["kind"] == "flight":
        return flight_answer(dataset)
    if dataset.sizes.get("fold", 1) > 1:
        return _boundary_answer(dataset)
    return _flutter_answer(dataset)


def certificate(dataset: "xarray.Dataset") -> str:
    """Return which cases are certified, from which airspeed on, and which are not."""
    if "certified" not in dataset:
        failed = failed_cases(dataset)
        return f"Failed: {_case_list(dataset, failed)}." if failed else ""
    if "response" in dataset:
        return "The reference is never certified."
    failed, doubtful = failed_cases(dataset), uncertified_cases(dataset)
    total = dataset.sizes["fold"]
    good = total - len(doubtful) - len(failed)
    share = "Certified" if total == good == 1 else f"{good} of {total} cases certified"
    text = f"{share}: the unstable roots listed are all there are, by an independent count"
    parts = [f"{text}{_validity(dataset)}."] if good else []
    parts += [f"Not certified: {_case_list(dataset, doubtful)}."] if doubtful else []
    parts += [f"Failed: {_case_list(dataset, failed)}."] if failed else []
    return " ".join(parts)


def failed_cases(dataset: "xarray.Dataset") -> list[int]:
    """Return the cases without a result."""
    if "case_status" not in dataset:
        return []
    return np.flatnonzero(dataset["case_status"].values == int(Status.FAILED)).tolist()


def uncertified_cases(dataset: "xarray.Dataset") -> list[int]:
    """Return the cases that have a result but no certificate."""
    if "certified" not in dataset:
        return []
    failed = set(failed_cases(dataset))
    return [
        case for case in np.flatnonzero(~dataset["certified"].values).tolist() if case not in failed
    ]


def critical_row(rows: Sequence[FlutterRow]) -> FlutterRow | None:
    """Return the onset or merger at the lowest airspeed, but no oscillation of an aircraft."""
    onsets = [row for row in rows if row.is_critical and math.isfinite(row.speed)]
    return min(onsets, key=lambda row: row.speed, default=None)


def _modes_answer(dataset: "xarray.Dataset") -> str:
    frequencies = dataset["natural_frequency"].values
    if not np.isfinite(frequencies).any():
        return "No natural frequencies were found."
    elastic = np.where(frequencies > 0.0, frequencies, np.nan)
    of = " of an elastic mode" if (frequencies == 0.0).any() else ""
    if np.isnan(elastic).all():
        return "No mode is elastic."
    case, mode = np.unravel_index(np.nanargmin(elastic), elastic.shape)
    name = dataset["mode_name"].values[case, mode]
    where = _listed(f"mode {name}", fold_text(dataset, int(case)))
    return f"The lowest natural frequency{of} is {elastic[case, mode]:.3g} Hz ({where})."


def _steady_answer(dataset: "xarray.Dataset") -> str:
    lift, slope = dataset["lift"].values[:, 0], dataset["lift_slope"].values[:, 0]
    known = np.flatnonzero(np.isfinite(lift))
    if not known.size:
        return "The computation failed."
    attrs = dataset.attrs
    where = f"At {degrees(attrs['alpha'])} and {attrs['airspeed']:g} m/s"
    high, low = (int(known[pick(slope[known])]) for pick in (np.argmax, np.argmin))
    if len(known) == 1:
        drag = float(dataset["induced_drag"].values[high, 0])
        forces = f"the lift is {lift[high]:.4g} N and the induced drag {drag:.3g} N"
        text = f"{where} {forces}; the lift slope is {slope[high]:.4g} per radian"
        return f"{text}{_in_brackets(fold_text(dataset, high))}."
    ends = (f"{lift[i]:.4g} N{_in_brackets(fold_text(dataset, i))}" for i in (high, low))
    slopes = f"the lift slope from {slope[high]:.4g} to {slope[low]:.4g} per radian"
    return f"{where} the lift goes from {' to '.join(ends)}, {slopes}."


def _in_brackets(text: str) -> str:
    return f" ({text})" if text else ""


def _flutter_answer(dataset: "xarray.Dataset") -> str:
    rows = flutter_rows(dataset)
    first = {
        kind: critical_row([row for row in rows if row.kind == kind])
        for kind in ("flutter", "divergence")
    }
    units = units_of(dataset)
    parts = [_onset(row, rows, units) for row in first.values() if row is not None]
    again = _onset_after_hump(first["flutter"], rows, units)
    if again is not None:
        parts.insert(1, again)
    already = statically_unstable(dataset) + _unstable_from_start(dataset)
    if parts:
        text = "; ".join(parts)
        return f"{already}{text[0].upper()}{text[1:]}."
    return already or _nothing_found(dataset)


def _unstable_from_start(dataset: "xarray.Dataset") -> str:
    """Return a sentence on roots beyond the boundary at the lowest airspeed already, or nothing.

    Oscillations of an aircraft as a whole do not count.
    """
    if "unstable_from_start" not in dataset:
        return ""
    already = elastic_from_start(dataset) > 0
    if not already.any():
        return ""
    lowest = float(dataset.attrs.get("speed_floor", np.nanmax(dataset["valid_from"].values)))
    unit = units_of(dataset).speed
    if dataset.sizes["fold"] > 1:
        who = f"{int(already.sum())} of {already.size} cases are"
        where = "" if "slowest_speed" in dataset else f", {lowest:.3g} {unit},"
        return f"{who} beyond the boundary from the lowest airspeed{where} on. "
    count = int(elastic_from_start(dataset)[0])
    roots = "1 root is" if count == 1 else f"{count} roots are"
    return f"{roots} beyond the boundary from the lowest airspeed, {lowest:.3g} {unit}, on. "


def _boundary_answer(dataset: "xarray.Dataset") -> str:
    row = critical_row(flutter_rows(dataset))
    total = dataset.sizes["fold"]
    if row is None:
        return _nothing_found(dataset)
    units = units_of(dataset)
    hertz = f"{row.frequency:.3g} {units.frequency}"
    what = f"mode {row.mode_name} at {hertz}" if row.kind == "flutter" else ""
    detail = _listed(row.kind, fold_text(dataset, row.case), what)
    where = f"in {total} cases is {row.speed:.3g} {units.speed} ({detail})"
    text = f"{_unstable_from_start(dataset)}The lowest speed of instability {where}."
    return text + changes_text(dataset)


def _nothing_found(dataset: "xarray.Dataset") -> str:
    """Claim stability only of the cases that are certified."""
    total = dataset.sizes["fold"]
    failed, doubtful = len(failed_cases(dataset)), len(uncertified_cases(dataset))
    if failed == total:
        return "The computation failed." if total == 1 else f"All {total} cases failed."
    text = f"No flutter or divergence found{_limit(dataset)}"
    if total > 1:
        text += f" in {total - failed} of {total} cases"
    if not doubtful:
        return f"{text}."
    which = "the case is" if total == 1 else f"{doubtful} {'is' if doubtful == 1 else 'are'}"
    return f"{text}, but {which} not certified."


def _listed(*parts: str) -> str:
    return ", ".join(filter(None, parts))


def _onset(row: FlutterRow, rows: Sequence[FlutterRow], units: Units = SI) -> str:
    at = f"{row.speed:.3g} {units.speed}"
    if row.kind == "divergence":
        return f"divergence begins at {at}"
    begin = f"flutter begins at {at} with {row.frequency:.3g} {units.frequency}"
    text = f"{begin} (mode {row.mode_name}"
    end = [
        other.speed
        for other in rows
        if other.event == "recovery" and other.branch == row.branch and other.speed > row.speed
    ]
    return f"{text}, a hump that ends at {min(end):.3g} {units.speed})" if end else f"{text})"


def _onset_after_hump(
    first: FlutterRow | None, rows: Sequence[FlutterRow], units: Units = SI
) -> str | None:
    """Return where flutter begins next when the first one is a hump, and no motion flutters."""
    if first is None or first.classification != "hump":
        return None
    later = [
        row
        for row in rows
        if row.kind == "flutter" and row.event == "onset" and row.is_critical
        if row.speed > first.speed
    ]
    return (
        f"flutter again from {later[0].speed:.3g} {units.speed} (mode {later[0].mode_name})"
        if later
        else None
    )


def _limit(dataset: "xarray.Dataset") -> str:
    if "speed_limit" in dataset.attrs:
        return f" up to {float(dataset.attrs['speed_limit']):.3g} {units_of(dataset).speed}"
    if "speed" in dataset.coords and dataset.sizes["speed"]:
        return f" up to {float(dataset['speed'][-1]):.3g} m/s"
    return ""


def _validity(dataset: "xarray.Dataset") -> str:
    """Return the airspeeds for which the result holds."""
    if "valid_from" not in dataset:
        return ""
    lowest = dataset["valid_from"].values
    lowest = lowest[np.isfinite(lowest)]
    if not lowest.size:
        return ""
    if lowest.max() > float(dataset.attrs.get("speed_limit", np.inf)):
        return f" among the modes resolved (all of them only from {lowest.max():.3g} m/s on)"
    return f", from {lowest.max():.3g} {units_of(dataset).speed} on"


def response(dataset: "xarray.Dataset") -> str:
    """Return what was identified in the response in time, beside the eigenvalue; or nothing."""
    if "response" not in dataset:
        return ""
    attrs = dataset["response"].attrs
    found = f"{attrs['frequency']:.5g} Hz and growth {round(attrs['growth'], 4) + 0.0:g} 1/s"
    hertz, growth = attrs["eigenvalue_frequency"], round(attrs["eigenvalue_growth"], 4) + 0.0
    value = f"{hertz:.5g} Hz and {growth:g} 1/s"
    return f"After a tap at {attrs['speed']:.4g} m/s: {found}; the eigenvalue says {value}."


def warnings(dataset: "xarray.Dataset") -> list[str]:
    """Return what makes results doubtful: modes not resolved, remarks on cases, each once."""
    parts = [_unresolved(dataset), unstable_motions(dataset), short_period(dataset)]
    parts.append(level_flight(dataset))
    if "message" in dataset:
        failed = set(failed_cases(dataset))
        cases: dict[str, list[int]] = {}
        for case, remark in enumerate(dataset["message"].values.tolist()):
            if remark and case not in failed:
                cases.setdefault(remark, []).append(case)
        parts += [_remark(dataset, those, remark) for remark, those in cases.items()]
    return [part for part in parts if part]


def _remark(dataset: "xarray.Dataset", cases: Sequence[int], remark: str) -> str:
    """Return a remark with the fold angles that it is on, unless it is on all of them."""
    if len(cases) == dataset.sizes["fold"]:
        return remark
    return f"{_case_list(dataset, cases)}: {remark}"


def unresolved_below(dataset: "xarray.Dataset") -> "np.ndarray[tuple[int], np.dtype[np.float64]]":
    """Return the airspeed below which modes of each case are not resolved; nan where all are."""
    if "uncertified_modes" not in dataset:
        return np.full(dataset.sizes["fold"], np.nan)
    named = dataset["uncertified_modes"].values != ""
    return np.where(named, dataset["valid_from"].values, np.nan)


def _unresolved(dataset: "xarray.Dataset") -> str:
    """Return which modes are too fast for the aerodynamic model at low airspeed, and the remedy."""
    if "uncertified_modes" not in dataset:
        return ""
    named = [text.split(", ") for text in dataset["uncertified_modes"].values.tolist() if text]
    if not named:
        return ""
    modes = ", ".join(dict.fromkeys(name for names in named for name in names))
    slow = float(dataset.attrs.get("speed_floor", 0.0))
    return (
        f"{_where_unresolved(dataset)} modes drop out, the fastest first; at {slow:.2g} m/s the "
        f"lattice does not resolve {modes}. Flutter points of a mode that has dropped out would "
        "not be found. More panels along the chord lower the limits."
    )


def _where_unresolved(dataset: "xarray.Dataset") -> str:
    """Return below which airspeed: the one that a certificate has just named, if there is one."""
    if dataset["certified"].any():
        return "Below that"
    lowest = np.nanmax(dataset["valid_from"].values, initial=0.0)
    return f"Below {lowest:.3g} m/s" if lowest > 0.0 else "At these airspeeds"


def _case_list(dataset: "xarray.Dataset", cases: Sequence[int], most: int = 12) -> str:
    named = "; ".join(fold_text(dataset, case) or "this case" for case in cases[:most])
    return named if len(cases) <= most else f"{named}; and {len(cases) - most} more"
