"""Level flight of one case: trim, the motions of the aircraft as a whole, and where it can fly."""

from dataclasses import dataclass

from foldwing.aeroelastic.aircraft import aircraft_of
from foldwing.aeroelastic.flight_modes import FlightModes, flight_modes
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.trim import Trim
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.stability.loci import Further
from foldwing.stability.tracking import Beginning
from foldwing.structure.modes import StructuralModes


@dataclass(frozen=True)
class Flight:
    """What an aircraft has besides a clamped wing.

    Attributes
    ----------
    level : Trim
    modes : FlightModes
    speed_range : (float, float)
        Airspeeds in m/s to search: from the lowest at which it can carry its weight, on.
    warning : str
        What is out of reach, empty when nothing is.
    """

    level: Trim
    modes: FlightModes
    speed_range: tuple[float, float]
    warning: str

    @staticmethod
    def of(
        model: AeroelasticWing,
        modes: StructuralModes,
        system: AeroelasticSystem,
        speed_range: tuple[float, float],
    ) -> "Flight":
        """Return the level flight of an aircraft between two airspeeds in m/s.

        Raises
        ------
        InputError
            When it cannot fly level at any of them.
        """
        level, gravity = model.trim(modes), aircraft_of(model.wing).gravity
        slow, fast = speed_range
        if level.slowest >= fast:
            limit = (
                f"level flight needs {level.slowest:.4g} m/s or more, for a lift coefficient of "
                f"{level.largest:g}"
            )
            remedy = "Look at higher airspeeds, or raise aircraft.largest_lift_coefficient."
            raise InputError("highest airspeed", fast, limit, remedy)
        limits = max(slow, level.slowest), fast
        return Flight(level, flight_modes(system, limits, gravity), limits, _warning(level))

    def further(self, system: AeroelasticSystem) -> Further:
        """Return what the loci of an aircraft have besides those of a clamped wing."""
        until = self.level.slowest
        return Further(self.modes.roots, Beginning(system.partly_carried(until), until))


def _warning(level: Trim) -> str:
    """Return below which airspeed trim asks for more lift than there can be."""
    needs = f"needs a lift coefficient above {level.largest:g}"
    return f"Level flight below {level.slowest:.3g} m/s {needs} and is out of reach."
