"""Units of a dataset: SI, or ratios to b and omega_1 for a section that has no scales."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from foldwing.results.variables import COORDINATES, VARIABLES

if TYPE_CHECKING:
    import xarray

Variables = dict[str, Any]


@dataclass(frozen=True)
class Units:
    """How numbers of a dataset are written.

    Attributes
    ----------
    speed, frequency, strength : str
        Unit behind a number.
    speed_label, frequency_label, growth_label : str
        Labels of axes.
    """

    speed: str = "m/s"
    frequency: str = "Hz"
    strength: str = "s/m"
    speed_label: str = "airspeed (m/s)"
    frequency_label: str = "frequency (Hz)"
    growth_label: str = "growth rate (1/s)"


SI = Units()
RATIOS = Units(
    "b ω₁", "ω₁", "1/(b ω₁)", "airspeed U/(b ω₁)", "frequency ω/ω₁", "growth rate Re λ/ω₁"
)

_IN_RATIOS = {
    "m/s": "over b omega_1",
    "Hz": "omega over omega_1",
    "rad/s": "over omega_1",
    "1/s": "over omega_1",
    "s/m": "times b omega_1",
}


def units_of(dataset: "xarray.Dataset") -> Units:
    """Return the units of the airspeeds and frequencies of a dataset."""
    if "flutter_speed" in dataset and dataset["flutter_speed"].attrs.get("units") == "1":
        return RATIOS
    return SI


def as_ratios(values: Variables) -> Variables:
    """Return variables or coordinates whose attributes say that they are ratios.

    Parameters
    ----------
    values : dict
        Name -> (dims, values), as `build_dataset` takes them; the numbers are ratios already.
    """
    labelled = {}
    for name, given in values.items():
        row = VARIABLES.get(name) or COORDINATES.get(name)
        words = _IN_RATIOS.get(row.units) if row is not None else None
        if row is not None and words is not None:
            attrs = {"units": "1", "long_name": f"{row.long_name}, {words}"}
            labelled[name] = (given[0], given[1], attrs)
        else:
            labelled[name] = given
    return labelled
