"""Two families of meshes that must have one limit, and two ways to take time derivatives."""

import numpy as np
import pytest

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.studies.convergence import convergence_study
from foldwing.studies.variants import variants

FOLDS = (30.0, -75.0)


def study(spacing, levels, highest=50.0):
    wing = read_model("three-segment").with_lattice(spacing=spacing)
    model = AeroelasticWing(wing, "lattice")
    chosen = variants(model, tuple(levels), levels)
    return convergence_study(model, FOLDS, chosen, highest=highest).dataset


def test_uniform_and_inset_strips_have_one_limit():
    uniform, inset = (
        study(spacing, {"spanwise": (15, 30, 60)}) for spacing in ("uniform", "inset")
    )
    assert uniform["flutter_mode_name"].values.tolist() == ["T1", "B2", "T1", "B1"]
    (limit,), (other,) = uniform["limit_speed"].values, inset["limit_speed"].values
    apart = np.abs(other - uniform["flutter_speed"].values)
    assert (apart > 4e-3 * other).all()  # so that the limits say something
    assert (np.abs(limit - other) < 0.25 * apart).all()
    bars = uniform["error_speed"].values[0] + inset["error_speed"].values[0]
    assert (apart <= bars).all()


def test_the_default_lattice_with_inset_strips_is_good_to_one_percent():
    levels = {"chordwise": (4, 8, 16), "spanwise": (15, 30, 60), "wake": (20, 40, 80)}
    dataset = study("inset", levels)
    error = dataset["mesh_error_speed"].values / dataset["flutter_speed"].values
    assert error.shape == (4,)
    assert (error < 0.01).all(), error
    assert (dataset["error_speed"].values >= 0.0).all()


def test_exact_and_average_time_derivatives_have_one_limit_and_second_order():
    levels = {"chordwise": (4, 8, 16), "time-step": (4, 8, 16)}
    dataset = study("uniform", levels, highest=60.0)
    torsion = dataset["flutter_mode_name"].values == "T2"
    assert torsion.sum() == 1
    order, limit = (dataset[name].values[:, torsion] for name in ("order", "limit_speed"))
    assert order == pytest.approx(2.0, abs=0.1)
    assert limit[0] == pytest.approx(limit[1], rel=1e-4)
