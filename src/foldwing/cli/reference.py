"""What ``flutter --method reference`` does: check, compute, answer."""

import tomllib
from typing import TYPE_CHECKING, Any

from foldwing.cli import tables
from foldwing.errors import InputError
from foldwing.maths.arrays import Real
from foldwing.model import Wing

if TYPE_CHECKING:
    import xarray

    from foldwing.aeroelastic.wing import AeroelasticWing
    from foldwing.cli.request import Request
    from foldwing.results import Source


def model_of(request: "Request", wing: Wing, text: str) -> "AeroelasticWing":
    """Return the wing with its aerodynamics, refusing what the method cannot serve."""
    if request.method != "reference":
        if request.time_step is not None:
            limit = "only the reference marches in time"
            remedy = "Add --aero lattice --method reference."
            raise InputError("--time-step", request.time_step, limit, remedy)
        return request.model_of(wing)
    if request.aero != "lattice":
        other = request.aero or "strip"
        limit = f"the reference is that of the vortex lattice, not of {other} aerodynamics"
        raise InputError("--method", "reference", limit, "Add --aero lattice.")
    from foldwing.aeroelastic.reference import check_scheme, check_time_step
    from foldwing.studies.reference import reference_model

    check_scheme(tomllib.loads(text).get("lattice", {}).get("scheme", "average"))
    check_time_step(request.time_step)
    return reference_model(wing, tuple(request.drop_mode or ()))


def solve(
    request: "Request",
    model: "AeroelasticWing",
    folds: tuple[float, ...],
    speeds: Real | None,
    source: "Source",
) -> tuple["xarray.Dataset", dict[str, Any]]:
    """Return the dataset and the answer of one case by the reference."""
    from foldwing.studies.answers import reference_answer
    from foldwing.studies.reference import SPEEDS, reference_study

    total = SPEEDS if speeds is None else int((speeds > 0.0).sum())
    with tables.progress("Airspeeds", total) as advance:
        dataset = reference_study(
            model,
            folds,
            speeds=speeds,
            highest=request.max_speed,
            time_step=request.time_step,
            source=source,
            progress=advance,
        )
    return dataset, reference_answer(dataset)
