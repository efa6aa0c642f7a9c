"""Numbers printed for a Cessna 172 and a Boeing 747.

Dissertation: I. Wang, Duke University, 2013, appendix C: Table C.1 and section C.4. Its equation
C.16 takes the weight from X_w a second time: gravity acts through the pitch angle already.
"""

import math

import numpy as np

from foldwing.flight import flight_modes, simple_phugoid, state_matrix
from foldwing.flight.phugoid import drag_over_lift
from foldwing.model import read_flight


def eigenvalues(matrix):
    phugoid, short_period = flight_modes(matrix)
    return phugoid.eigenvalue, short_period.eigenvalue


def modes(model):
    return eigenvalues(state_matrix(model))


def rounded(value, digits=4):
    return complex(round(value.real, digits), round(value.imag, digits))


def with_the_weight_counted_twice(model):
    """The state matrix with the term -m g / U of equation C.16 in X_w."""
    matrix = state_matrix(model).copy()
    matrix[0, 1] -= model.gravity / model.speed
    return matrix


def without_drag(model, **changes):
    """The aircraft of the dissertation's comparison with a multi-body model: given lift slopes."""
    return model.model_copy(
        update={
            "drag": False,
            "speed": 54.0,
            "wing": model.wing.model_copy(update={"lift_slope": 2.0 * math.pi}),
            "tail": model.tail.model_copy(update={"lift_slope": 3.8192}),
            **changes,
        }
    )


PRINTED = read_flight("cessna-172")
IDENTIFIED = read_flight("cessna-172-identified")


def test_inputs_as_printed():
    phugoid, short_period = modes(PRINTED)
    assert rounded(phugoid) == -0.0201 + 0.2332j
    assert rounded(short_period) == -6.1977 + 9.1678j


def test_inputs_as_printed_do_not_give_the_printed_eigenvalues():
    """Neither as derived nor with the weight counted twice: hence the identified inputs."""
    for matrix in (state_matrix(PRINTED), with_the_weight_counted_twice(PRINTED)):
        assert rounded(eigenvalues(matrix)[1]) != -6.2410 + 9.2282j


def test_simple_phugoid_of_the_identified_inputs():
    ratio = drag_over_lift(IDENTIFIED)
    root = simple_phugoid(ratio, IDENTIFIED.speed, IDENTIFIED.gravity)[0]
    assert rounded(root) == -0.0216 + 0.2540j


def test_identified_inputs():
    phugoid, short_period = modes(IDENTIFIED)
    assert rounded(phugoid) == -0.0202 + 0.2313j
    assert rounded(short_period) == -6.2385 + 9.2300j


def test_printed_digits_need_the_weight_counted_twice():
    phugoid, short_period = eigenvalues(with_the_weight_counted_twice(IDENTIFIED))
    assert rounded(phugoid) == -0.0177 + 0.2315j
    assert rounded(short_period) == -6.2410 + 9.2282j


def test_without_drag():
    phugoid, short_period = modes(without_drag(IDENTIFIED))
    assert rounded(phugoid) == 0.0002 + 0.2283j
    assert rounded(short_period) == -6.5673 + 9.2322j


def test_without_drag_and_with_the_weight_counted_twice():
    """Printed: 0.0027 + 0.2283i and -6.5697 + 9.2304i, which rounding leaves 5e-5 of."""
    matrix = with_the_weight_counted_twice(without_drag(IDENTIFIED))
    phugoid, short_period = eigenvalues(matrix)
    assert abs(phugoid - (0.0027 + 0.2283j)) < 6e-5
    assert abs(short_period - (-6.5697 + 9.2304j)) < 6e-5


def test_without_drag_from_the_printed_inputs():
    model = without_drag(IDENTIFIED, gravity=9.81, pitch_inertia=838.0)
    phugoid, short_period = modes(model)
    assert round(phugoid.imag, 4) == 0.2285
    assert rounded(short_period) == -6.5696 + 9.2339j


def test_tail_slope_is_that_of_its_span_efficiency():
    assert round(PRINTED.tail.slope, 4) == 3.8192


def test_boeing_747():
    """Etkin and Reid, Dynamics of Flight, 1996, chapter 6: periods of about 93 and 7 s."""
    phugoid, short_period = modes(read_flight("boeing-747"))
    assert rounded(phugoid, 6) == -0.003289 + 0.067202j
    assert rounded(short_period, 6) == -0.371683 + 0.886924j
    periods = [2.0 * np.pi / value.imag for value in (phugoid, short_period)]
    assert [round(period) for period in periods] == [93, 7]
