"""The modes of several models of one aircraft beside each other."""

from collections.abc import Iterator
from dataclasses import dataclass

from foldwing.flight.derivatives import state_matrix
from foldwing.flight.modes import PHUGOID, SHORT_PERIOD, Mode, Motion, flight_modes
from foldwing.flight.phugoid import drag_over_lift, simple_phugoid
from foldwing.model import Airframe, FlightModel

FOUR_STATES = "four states"
WITHOUT_DRAG = "without drag"
SIMPLE = "simple phugoid"


@dataclass(frozen=True)
class ModeRow:
    """What one model says of the modes at one airspeed.

    Attributes
    ----------
    model_name : str
        In a few words, for tables and legends.
    speed : float
        m/s; nan for a matrix given without it.
    motions : tuple of Motion
        One for each pair of eigenvalues and each real one, the phugoid first.
    """

    model_name: str
    speed: float
    motions: tuple[Motion, ...]

    @property
    def roots(self) -> tuple[tuple[Mode, complex], ...]:
        """All eigenvalues with their modes, a pair as two neighbours."""
        return tuple(
            (motion.mode, value)
            for motion in self.motions
            for value in (motion.eigenvalue, motion.eigenvalue.conjugate())[: 1 + motion.oscillates]
        )


def mode_row(
    model_name: str,
    speed: float,
    phugoid: complex | tuple[complex, complex],
    short_period: complex | tuple[complex, complex] | None = None,
) -> ModeRow:
    """Return the row of a model that is not of this package's making.

    Parameters
    ----------
    model_name : str
    speed : float
        m/s.
    phugoid, short_period : complex, or two of them
        Eigenvalues in 1/s: one of a pair, or both (of a pair, or real). None when not known.
    """
    motions = _motions(PHUGOID, phugoid)
    if short_period is not None:
        motions += _motions(SHORT_PERIOD, short_period)
    return ModeRow(model_name, speed, motions)


def _motions(mode: Mode, roots: complex | tuple[complex, complex]) -> tuple[Motion, ...]:
    given = roots if isinstance(roots, tuple) else (roots,)
    if complex(given[0]).imag:
        value = complex(given[0])
        return (Motion(mode, complex(value.real, abs(value.imag))),)
    return tuple(Motion(mode, complex(root)) for root in given)


def model_rows(model: FlightModel) -> Iterator[ModeRow]:
    """Yield the rows of all models that an aircraft has: four states, without drag, phugoid."""
    speed = float("nan") if model.speed is None else model.speed
    yield ModeRow(FOUR_STATES, speed, flight_modes(state_matrix(model)))
    if isinstance(model, Airframe) and model.drag:
        modes = flight_modes(state_matrix(model.without_drag()))
        yield ModeRow(WITHOUT_DRAG, speed, modes)
    ratio = drag_over_lift(model)
    if model.speed is not None and ratio is not None:
        yield mode_row(SIMPLE, speed, simple_phugoid(ratio, model.speed, model.gravity))
