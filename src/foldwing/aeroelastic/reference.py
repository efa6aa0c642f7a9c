"""The reference: structure, vortex lattice and wake marching in time together.

With dt = dx / U, the time in which the stream passes one panel, the state

    x = (circulation of the panels, circulation of the wake, q, dq/dt)

obeys M1 x(n+1) + M2 x(n) = 0. The rows of the panels hold the normal wash, those of the wake
convect the circulation that the strips have shed, and the last two move the structure by a scheme
of discrete time (K. C. Hall, AIAA Journal 32, 1994; I. Wang, PhD dissertation, Duke University,
2013, appendix A). Nothing is condensed, so that thousands of states serve some tens of roots. The
fast form of the lattice (`foldwing.aerodynamics.unsteady`) has the same roots.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse
from scipy.sparse import csc_array

from foldwing.aerodynamics.doubts import check_equal_chords
from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.unsteady import PanelMotion
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.errors import InputError
from foldwing.maths.arrays import Complex, Real
from foldwing.structure.modes import StructuralModes

MOST_CHORDWISE = 24
"""Panels along the chord that a fixed time step may ask for."""


@dataclass(frozen=True)
class Marching:
    """One step in time at one airspeed: after @ x(n+1) + before @ x(n) = 0.

    Attributes
    ----------
    after, before : sparse array, shape (states, states)
        M1 and M2.
    step : float
        dt in seconds.
    airspeed : float
        U in m/s.
    sizes : (int, int, int)
        Numbers of panels, of strips and of modes.
    """

    after: csc_array
    before: csc_array
    step: float
    airspeed: float
    sizes: tuple[int, int, int]

    @property
    def states(self) -> int:
        """Number of states."""
        return int(self.after.shape[0])

    @property
    def panels(self) -> slice:
        """Where the circulation of the panels stands in the state, in m^2/s."""
        return slice(0, self.sizes[0])

    @property
    def wake(self) -> slice:
        """Where the circulation of the wake stands, row by row, in m^2/s."""
        return slice(self.sizes[0], self.states - 2 * self.sizes[2])

    @property
    def coordinates(self) -> slice:
        """Where the modal coordinates q stand, in m kg^(1/2)."""
        return slice(self.states - 2 * self.sizes[2], self.states - self.sizes[2])

    @property
    def velocities(self) -> slice:
        """Where dq/dt stands."""
        return slice(self.states - self.sizes[2], self.states)

    def eigenvalue(self, z: Complex) -> Complex:
        """Return lambda in rad/s of the factors ``z`` by which states grow in one step."""
        return np.asarray(np.log(np.asarray(z, complex)) / self.step)

    def factor(self, eigenvalue: Complex) -> Complex:
        """Return z = exp(lambda dt)."""
        return np.asarray(np.exp(np.asarray(eigenvalue, complex) * self.step))

    def in_vacuo(self) -> Complex:
        """Return lambda of every mode by itself, without air, with Im lambda >= 0, shape (n,)."""
        n = self.sizes[2]
        M1, M2 = (matrix[-2 * n :, -2 * n :].toarray() for matrix in (self.after, self.before))
        pairs = [np.ix_((mode, n + mode), (mode, n + mode)) for mode in range(n)]
        z = [np.linalg.eigvals(-np.linalg.solve(M1[pair], M2[pair])) for pair in pairs]
        return self.eigenvalue(np.array([values[np.argmax(values.imag)] for values in z]))


@dataclass(frozen=True)
class CoupledLattice:
    """Modes, panels and wake on one mesh: all that the equations of every airspeed share.

    Parameters
    ----------
    influence : Influence
        Strips of one chord.
    motion : PanelMotion
    load : array, shape (panels,)
        Density times width of the strip, in kg/m^2.
    length : array, shape (panels,)
        Length behind each bound vortex that its growing circulation loads, in metres.
    modes : StructuralModes
    relaxation : float
        Factor by which the circulation in the last row of the wake fades in each step.
    scheme : str
        ``average``, ``literal`` or ``printed``.
    """

    influence: Influence
    motion: PanelMotion
    load: Real
    length: Real
    modes: StructuralModes
    relaxation: float
    scheme: str

    @property
    def panel_length(self) -> float:
        """Length dx of a panel in metres."""
        return self.influence.step(0)

    def at(self, airspeed: float) -> Marching:
        """Return the equations at an airspeed in m/s."""
        U, n, panels = airspeed, self.modes.count, self.influence.count
        step = self.panel_length / U
        shed_after, shed_before = self._circulation
        wash = -np.hstack([U * self.motion.slope, self.motion.collocation])
        motion = scipy.sparse.vstack(
            [
                csc_array(wash),
                csc_array((shed_after.shape[0] - panels, 2 * n)),
            ]
        )
        still = csc_array(motion.shape)
        (F1, F2), (E1, E2) = self._loads(U, step), self._structure(step)
        return Marching(
            _joined(shed_after, motion, F1, E1),
            _joined(shed_before, still, F2, E2),
            step,
            airspeed,
            (panels, self.influence.strips.count, n),
        )

    @cached_property
    def _circulation(self) -> tuple[csc_array, csc_array]:
        """Columns of the circulations in the rows of the wash and of the wake, for M1 and M2."""
        strips, rows = self.influence.strips.count, self.influence.rows
        panels, shed = self.influence.count, strips * rows
        sums = csc_array(np.tile(np.eye(strips), self.influence.chordwise))
        sums = scipy.sparse.vstack([sums, csc_array((shed - strips, panels))])
        own = scipy.sparse.eye_array(shed)
        fading = np.repeat(np.arange(rows) == rows - 1, strips) * self.relaxation
        moved = scipy.sparse.eye_array(shed, k=-strips) + scipy.sparse.diags_array(fading)
        empty = csc_array((panels, panels + shed))
        return (
            _stacked([np.hstack([self.influence.wing, self._wake]), [sums, own]]),
            _stacked([empty, [-sums, -moved]]),
        )

    @property
    def _wake(self) -> Real:
        """Influence of the wake on the panels, shape (panels, rows strips)."""
        influence = self.influence
        A = np.empty((influence.count, influence.rows, influence.strips.count))
        for group, members in enumerate(influence.groups):
            for row, part in enumerate(influence.wake_rows(group)):
                A[:, row, members] = part
        return A.reshape(influence.count, -1)

    def _loads(self, U: float, step: float) -> tuple[Real, Real]:
        """Return the forces of the panels on the left of the equation of motion, (n, panels).

        L1 is the load of Kutta and Joukowski, L2 that of the growing circulation.
        """
        L1 = U * self.load * self.motion.vortex.T
        L2 = self.load * self.length * self.motion.load.T / step
        if self.scheme == "average":
            return -L1 / 2.0 - L2, L2 - L1 / 2.0
        return -L1 - L2, L2

    def _structure(self, step: float) -> tuple[Real, Real]:
        """Return the equation of motion over q and dq/dt, and what ties the two, (2 n, 2 n)."""
        omega, one = self.modes.omega, np.eye(self.modes.count)
        K = np.diag(omega**2) / 2.0
        C = np.diag(2.0 * self.modes.damping * omega)
        if self.scheme == "average":  # v averaged over the step is the change of q
            return (
                np.block([[K + C / step, one / step], [-one / step, one / 2.0]]),
                np.block([[K - C / step, -one / step], [one / step, one / 2.0]]),
            )
        return (  # v at the end of the step is the change of q
            np.block([[K, one / step + C / 2.0], [-one / step, one]]),
            np.block([[K, -one / step + C / 2.0], [one / step, 0.0 * one]]),
        )


def _stacked(blocks: list[list[object] | object]) -> csc_array:
    rows = [scipy.sparse.hstack(row) if isinstance(row, list) else csc_array(row) for row in blocks]
    return csc_array(scipy.sparse.vstack(rows))


def _joined(circulation: csc_array, motion: csc_array, loads: Real, structure: Real) -> csc_array:
    """Return a matrix of all states from its four blocks."""
    n, states = len(loads), circulation.shape[1]
    below = csc_array((2 * n, states))
    if loads.any():
        rest = csc_array((n, states - loads.shape[1]))
        forces = scipy.sparse.hstack([csc_array(loads), rest])
        below = scipy.sparse.vstack([forces, csc_array((n, states))])
    left = scipy.sparse.vstack([circulation, below])
    right = scipy.sparse.vstack([motion, csc_array(structure)])
    return csc_array(scipy.sparse.hstack([left, right]))


def coupled_lattice(model: AeroelasticWing, modes: StructuralModes) -> CoupledLattice:
    """Return modes, panels and wake on the mesh of the model.

    Raises
    ------
    InputError
        When the chords differ, or the scheme of the lattice is not one of discrete time.
    """
    check_reference(model)
    influence = model.influence(modes)
    lattice = model.wing.lattice
    return CoupledLattice(
        influence,
        model.panel_motion(modes),
        model.wing.air.density * np.tile(influence.strips.width, influence.chordwise),
        model.load_lengths,
        modes,
        lattice.relaxation,
        lattice.scheme,
    )


def check_reference(model: AeroelasticWing) -> None:
    """Raise `InputError` unless the wing has one chord and its lattice steps in time."""
    chords = ", ".join(f"{segment.chord:g} m" for segment in model.wing.segments)
    check_equal_chords(model.wing, "wing.chord", chords, "Take the sweep, which needs no steps.")
    check_scheme(model.wing.lattice.scheme)


def check_scheme(scheme: str) -> None:
    """Raise `InputError` unless a scheme of the lattice is one of discrete time."""
    if scheme == "exact":
        limit = "the reference marches in time and needs a scheme of discrete time"
        raise InputError("lattice.scheme", scheme, limit, 'Take scheme = "average".')


def check_time_step(time_step: float | None) -> None:
    """Raise `InputError` unless the time step in seconds is left open or is a time."""
    if time_step is not None and not 0.0 < time_step < np.inf:
        remedy = "Write it in seconds, for example --time-step 0.0003."
        raise InputError("--time-step", time_step, "must be greater than 0 s", remedy)


@dataclass(frozen=True)
class Reference:
    """The coupled equations of a wing at any airspeed.

    Parameters
    ----------
    model : AeroelasticWing
        With the lattice as aerodynamics.
    modes : StructuralModes
    time_step : float, optional
        dt in seconds, at every airspeed about the same; by default the panels are the same.

    Raises
    ------
    InputError
        When the wing has no reference, or ``time_step`` is no time.
    """

    model: AeroelasticWing
    modes: StructuralModes
    time_step: float | None = None

    def __post_init__(self) -> None:
        """Refuse what cannot be marched, before any computing."""
        check_reference(self.model)
        check_time_step(self.time_step)

    def chordwise(self, airspeed: float) -> int:
        """Return the number of panels along the chord at an airspeed in m/s.

        Raises
        ------
        InputError
            When a fixed time step asks for too many.
        """
        if self.time_step is None:
            return self.model.wing.lattice.chordwise
        chord = self.model.wing.segments[0].chord
        count = max(1, round(chord / (airspeed * self.time_step)))
        if count > MOST_CHORDWISE:
            limit = f"needs {count} panels along the chord at {airspeed:.4g} m/s"
            remedy = f"At most {MOST_CHORDWISE}: take longer steps or leave out low airspeeds."
            raise InputError("--time-step", self.time_step, limit, remedy)
        return count

    @property
    def slowest(self) -> float:
        """Airspeed in m/s from which on a fixed time step takes no more panels than allowed."""
        if self.time_step is None:
            return 0.0
        return self.model.wing.segments[0].chord / (MOST_CHORDWISE * self.time_step)

    @property
    def own_mesh(self) -> "Reference":
        """The same with the panels of the model at every airspeed."""
        return replace(self, time_step=None)

    def at(self, airspeed: float) -> Marching:
        """Return the equations at an airspeed in m/s, greater than 0."""
        return self._lattice(self.chordwise(airspeed)).at(airspeed)

    @cached_property
    def _own(self) -> CoupledLattice:
        return coupled_lattice(self.model, self.modes)

    def _lattice(self, chordwise: int) -> CoupledLattice:
        if chordwise == self.model.wing.lattice.chordwise:
            return self._own
        wing = self.model.wing.with_lattice(chordwise=chordwise)
        return coupled_lattice(replace(self.model, wing=wing), self.modes)
