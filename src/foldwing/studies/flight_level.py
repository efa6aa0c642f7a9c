"""Level flight of one case: trim, the motions of the aircraft as a whole, and where it can fly."""

from dataclasses import dataclass

from foldwing.aeroelastic.aircraft import aircraft_of
from foldwing.aeroelastic.flight_modes import FlightModes, flight_modes
from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.trim import Trim
from foldwing.aeroelastic.wing import AeroelasticWing
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
        """Return the level flight of an aircraft between two airspeeds in m/s."""
        level, gravity = model.trim(modes), aircraft_of(model.wing).gravity
        slow, fast = speed_range
        reachable = level.slowest < fast
        limits = (max(slow, level.slowest) if reachable else slow), fast
        return Flight(level, flight_modes(system, limits, gravity), limits, _warning(level, fast))

    def further(self, system: AeroelasticSystem) -> Further:
        """Return what the loci of an aircraft have besides those of a clamped wing."""
        until = self.speed_range[0]
        return Further(self.modes.roots, Beginning(system.partly_carried(until), until))


def _warning(level: Trim, fast: float) -> str:
    """Return what trim asks for more lift than there can be."""
    where = f"below {level.slowest:.3g} m/s" if level.slowest < fast else f"up to {fast:.3g} m/s"
    needs = f"needs a lift coefficient above {level.largest:g}"
    if level.slowest < fast:
        return f"Level flight {where} {needs} and is out of reach."
    return f"Level flight {where} {needs} and is out of reach; the result stands for none."
