"""Frequencies of rectangular plates by the Ritz method, omega a^2 sqrt(rho t / D), nu = 0.3.

Values of few products of beam functions go back to M. V. Barton, "Vibration of rectangular and skew
cantilever plates", Journal of Applied Mechanics 18, 1951, and stand in collections of plate
frequencies; they lie above the exact ones by up to 1 %. Those of many terms are nearer, are known
here from secondary sources only, and agree with `test_plate` among the cross tests.
"""

import numpy as np
import pytest

from foldwing.model import rectangle
from foldwing.structure.plate_elastic import elastic_modes
from support.plates import parameters, sheet

BY_FEW_TERMS = {
    (1.0, True): (3.492, 8.525, 21.43, 27.33, 31.11, 54.44),
    (1.0, False): (13.49, 19.79, 24.43, 35.02, 35.02),
}
BY_MANY_TERMS = {
    (1.0, True): (3.4710, 8.5066, 21.285, 27.199, 30.956, 54.186),
    (2.0, True): (3.4393, 14.802, 21.434, 48.179, 60.150, 92.521),
    (1.0, False): (13.468, 19.596, 24.270, 34.801),
}


def of_plate(aspect, clamped, count):
    side = 0.1 * aspect
    planform = rectangle(side, 0.1, 0.5)
    size = np.sqrt(planform.area / 200.0)
    found = elastic_modes(planform, sheet(), count, clamped, size).omega2
    return parameters(found, side, sheet())


@pytest.mark.parametrize(("aspect", "clamped"), BY_FEW_TERMS)
def test_ritz_values_of_few_terms_lie_above_by_less_than_one_and_a_half_percent(aspect, clamped):
    """Half a unit of their last place allowed."""
    printed = np.array(BY_FEW_TERMS[aspect, clamped])
    excess = printed / of_plate(aspect, clamped, len(printed)) - 1.0
    assert np.all((excess > -0.005 / 21.43) & (excess < 0.015))


@pytest.mark.parametrize(("aspect", "clamped"), BY_MANY_TERMS)
def test_ritz_values_of_many_terms_are_met(aspect, clamped):
    """Within 0.1 % where clamped and free edges meet, whose corners slow both methods down, and
    by half a unit of the last place of a free plate."""
    printed = BY_MANY_TERMS[aspect, clamped]
    found = of_plate(aspect, clamped, len(printed))
    np.testing.assert_allclose(found, printed, rtol=1e-3 if clamped else 4e-5)
