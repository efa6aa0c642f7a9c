"""The port that every kind of segment model obeys: its component modes."""

from enum import Enum
from typing import NamedTuple, Protocol

from foldwing.maths.arrays import Real


class Root(Enum):
    """How the inboard edge of a segment may move."""

    CLAMPED = "clamped"
    """Not at all."""
    CARRIAGE = "carriage"
    """With a symmetric aircraft: along x and z and in pitch, but neither sideways nor in roll."""
    FREE = "free"
    """In every way; a hinge holds it."""


class SectionMotion(NamedTuple):
    """Plunge and twist of chordwise sections, each of shape (m, n)."""

    plunge: Real
    twist: Real


class ComponentModes(Protocol):
    """Modes of one segment in its local axes; nothing downstream asks how they were computed.

    The n coordinates are the out-of-plane modes followed by the in-plane rigid motions (x and y
    translation, yaw; none for a clamped segment, x alone at the root of an aircraft). Points are
    given by x (m aft of the elastic axis) and y (m outboard of the inboard edge), each of shape
    (m,).
    """

    @property
    def count(self) -> int:
        """Number n of coordinates."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What makes the modes doubtful, in words."""

    @property
    def mass(self) -> Real:
        """Mass matrix, shape (n, n)."""

    @property
    def stiffness(self) -> Real:
        """Stiffness matrix, shape (n, n)."""

    @property
    def mass_and_centre(self) -> tuple[float, Real]:
        """Mass in kg, and x and y of its centre in m, shape (2,)."""

    @property
    def torsion_mass(self) -> Real:
        """Part of the mass matrix that belongs to twisting motion, shape (n, n)."""

    @property
    def mass_centre_motion(self) -> Real:
        """Displacement of the mass centre times the mass per coordinate, shape (3, n)."""

    def displacement(self, x: Real, y: Real) -> Real:
        """Return the local displacement per coordinate, shape (m, 3, n)."""

    def slopes(self, x: Real, y: Real) -> Real:
        """Return dw/dx and dw/dy per coordinate, shape (m, 2, n)."""

    def section_motion(self, y: Real) -> SectionMotion:
        """Return plunge (m, up) and twist (rad, nose up) of the sections at ``y``."""
