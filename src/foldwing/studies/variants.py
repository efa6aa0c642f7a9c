"""The models of a convergence study: each differs from the model's own settings in one."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.model import Wing
from foldwing.studies.settings import SETTINGS

MOST_LEVELS = 100
"""Levels of one setting above which a typing error is more likely than a wish."""

LEAST_LEVELS = 3
"""Levels of one setting from which an order of convergence can be found."""

_LEVELS_REMEDY = "Write for example --levels chordwise=4,8,16."


@dataclass(frozen=True)
class Variant:
    """A wing with one setting changed.

    Attributes
    ----------
    setting : str
    value : float
        A number, chords of wake, or a gap in metres.
    own : bool
        Whether this is the model as it is.
    reference : bool
        Whether the error of this variant is wanted: that of the model's own value.
    wing : Wing
    """

    setting: str
    value: float
    own: bool
    reference: bool
    wing: Wing


def variants(
    model: AeroelasticWing,
    chosen: Sequence[str] = (),
    levels: Mapping[str, Sequence[float]] | None = None,
) -> list[Variant]:
    """Return every variant of a model, by setting and ascending value.

    Parameters
    ----------
    model : AeroelasticWing
    chosen : sequence of str
        Names of the settings to vary; by default all that the model has.
    levels : mapping of str to sequence of float, optional
        Values in place of the default ones. The model's own is added.

    Raises
    ------
    InputError
        When the model lacks a setting that is asked for, or cannot take a value, or there are too
        few values.
    """
    values = levels or {}
    names = chosen or [name for name, setting in SETTINGS.items() if setting.applies(model)]
    for name in names:
        _check_applies(model, name, "--vary")
    for name in values:
        _check_applies(model, name, "--levels")
        if name not in names:
            raise InputError("--levels", name, "is not among --vary", "Add it there.")
    return [one for name in names for one in _of_setting(model.wing, name, values.get(name))]


def _check_applies(model: AeroelasticWing, name: str, field: str) -> None:
    if SETTINGS[name].applies(model):
        return
    remedy = "Leave it out."
    if model.aerodynamics != "lattice":
        remedy = "Add --aero lattice, or leave it out."
    elif name == "gap":
        remedy = 'Give --gap "1 mm", or leave it out.'
    limit = f"this model with {model.aerodynamics} aerodynamics does not depend on it"
    raise InputError(field, name, limit, remedy)


def _of_setting(wing: Wing, name: str, values: Sequence[float] | None) -> list[Variant]:
    setting = SETTINGS[name]
    own = setting.own(wing)
    try:
        changed = [setting.changed(wing, value) for value in values or setting.levels(wing)]
    except InputError as problem:
        value, limit = f"{name}={problem.value}", problem.limit
        raise InputError("--levels", value, limit, problem.remedy) from None
    found = {setting.own(other): other for other in changed}
    if setting.own_counts:
        found[own] = wing
    if values and len(found) < LEAST_LEVELS:
        given = f"{name}={','.join(f'{value:g}' for value in values)}"
        limit = f"at least {LEAST_LEVELS} levels are needed"
        limit += f", the model's own {own:g} among them" if setting.own_counts else ""
        raise InputError("--levels", given, limit, "Give more values, or none for the default.")
    return [
        Variant(name, value, found[value] is wing, value == own, found[value])
        for value in sorted(found)
    ]


def parse_settings(text: str | None) -> tuple[str, ...]:
    """Return the settings named in ``"chordwise,spanwise"``; none for None.

    Raises
    ------
    InputError
        When a name is not known.
    """
    names = [] if text is None else [part.strip() for part in text.split(",")]
    for name in names:
        _check_known(name, "--vary", name)
    return tuple(dict.fromkeys(names))


def parse_levels(texts: Sequence[str]) -> dict[str, tuple[float, ...]]:
    """Return the values in texts such as ``"chordwise=4,8,16"``; a gap in metres.

    Raises
    ------
    InputError
        When a text does not give numbers to a known setting.
    """
    found: dict[str, tuple[float, ...]] = {}
    for text in texts:
        name, _, values = text.partition("=")
        name = name.strip()
        _check_known(name, "--levels", text)
        if name in found:
            raise InputError("--levels", text, f"{name} was given already", "Give it once.")
        parts = values.split(",")
        if len(parts) > MOST_LEVELS:
            limit = f"may have at most {MOST_LEVELS} values"
            raise InputError("--levels", f"{len(parts)} values", limit, "Give fewer.")
        found[name] = tuple(_number(part, text, zero=name == "gap") for part in parts)
    return found


def _number(part: str, text: str, zero: bool) -> float:
    try:
        value = float(part)
    except ValueError:
        limit = "must be numbers, separated by commas"
        raise InputError("--levels", text, limit, _LEVELS_REMEDY) from None
    if not (math.isfinite(value) and (value > 0.0 or (zero and value == 0.0))):
        raise InputError("--levels", text, "must be finite and greater than 0", _LEVELS_REMEDY)
    return value


def _check_known(name: str, field: str, value: str) -> None:
    if name not in SETTINGS:
        limit = f"must name one of: {', '.join(SETTINGS)}"
        example = "--vary chordwise,spanwise" if field == "--vary" else "--levels chordwise=4,8,16"
        raise InputError(field, value, limit, f"Write for example {example}.")
