"""An aircraft with every body and both wings in coordinates of their own, joined by constraints.

Fuselage and tail have the coordinates (x, z, theta) of their own mass centres: aft, up, nose up.
They, the hinges and the roots of the wings are held together by rows C q = 0, which are either kept
as such, with Lagrange multipliers, or eliminated by their null space.

Forces on a strip follow from the displacements of three points of its chord: apparent mass is
accelerated at the middle, the lift of a turning flow acts at three quarters, that of the
circulation at one quarter.
"""

from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np
import scipy.linalg
import scipy.optimize
from scipy.special import kve

from foldwing.structure.beam import BeamModes, beam_modes
from foldwing.structure.component import Root
from foldwing.structure.spanwise import JacobiFunctions

MIRROR = np.diag([1.0, -1.0, 1.0])


def theodorsen(p):
    """C(p) from Bessel functions."""
    return kve(1, p) / (kve(0, p) + kve(1, p))


@dataclass(frozen=True)
class Strip:
    """Stations along one surface: rows of normal displacement, and displacement aft, over q.

    ``load`` is the steady lift per span that is felt in motion.
    """

    half_chord: float
    slope: float
    width: np.ndarray
    load: float
    axis: np.ndarray
    quarter: np.ndarray
    middle: np.ndarray
    three_quarters: np.ndarray
    aft: np.ndarray
    lags: bool

    def force(self, density, rate, speed):
        """Generalized force per q at exp(rate t)."""
        b, rho, U = self.half_chord, density, speed
        twist = (self.quarter - self.three_quarters) / b
        C = theodorsen(rate * b / U) if self.lags else 1.0
        downwash = U * twist - rate * self.three_quarters
        lift = self.slope * rho * U * b * C * downwash - 2.0 * C * self.load * rate / U * self.aft
        F = self._works(self.quarter, lift)
        F = F + self._works(self.aft, self.load * rate / U * self.axis)
        if self.lags:
            mass = np.pi * rho * b**2
            F = F - self._works(self.middle, mass * rate**2 * self.middle)
            F = F + self._works(self.three_quarters, mass * U * rate * twist)
            F = F - self._works(twist, mass * b**2 / 8.0 * rate**2 * twist)
        return F

    def _works(self, moved, force):
        return (moved * self.width[:, None]).T @ force


@dataclass(frozen=True)
class Explicit:
    """All coordinates, with constraints of full rank."""

    mass: np.ndarray
    stiffness: np.ndarray
    constraints: np.ndarray
    strips: tuple
    density: float

    def dynamic(self, rate, speed=None):
        """Return M rate^2 + K less the forces of the air, without constraints."""
        A = rate**2 * self.mass + self.stiffness
        if speed is not None:
            A = A - sum(s.force(self.density, rate, speed) for s in self.strips)
        return A

    def augmented(self, rate, speed=None):
        """Return the dynamic stiffness bordered by the constraints."""
        m = len(self.constraints)
        C = self.constraints
        return np.block([[self.dynamic(rate, speed), C.T], [C, np.zeros((m, m))]])

    def root_near(self, guess, speed=None):
        """Return the root of the augmented matrix near a guess, by the secant method."""
        size = len(self.mass) + len(self.constraints)
        a, b = np.random.default_rng(3).standard_normal((2, size))
        scale = np.abs(self.stiffness).max()
        unit = np.append(np.zeros(size), 1.0)

        def response(rate):
            A = self.augmented(rate, speed)
            bordered = np.block([[A, scale * b[:, None]], [a[None, :], np.zeros((1, 1))]])
            return np.linalg.solve(bordered, unit)[-1]

        # Round-off of the stiffest parts leaves slow roots ten digits: steps may dither there.
        size = 1e-12 * abs(guess)
        return scipy.optimize.newton(
            response, guess, x1=guess * (1 + 1e-5), tol=size, maxiter=25, disp=False
        )

    def count_below(self, omega):
        """Return how many natural frequencies lie below omega, by the inertia of the matrix."""
        size = np.sqrt(np.diagonal(self.stiffness) + omega**2 * np.diagonal(self.mass))
        scale = 1.0 / np.append(size, np.ones(len(self.constraints)))
        A = self.augmented(1j * omega).real * np.outer(scale, scale)
        return int((np.linalg.eigvalsh(A) < 0).sum()) - len(self.constraints)

    @cached_property
    def free(self):
        """Columns that obey the constraints."""
        return scipy.linalg.null_space(self.constraints)

    def frequencies(self):
        """Return all natural frequencies in rad/s, ascending."""
        Z = self.free
        values = scipy.linalg.eigh(Z.T @ self.stiffness @ Z, Z.T @ self.mass @ Z)[0]
        return np.sqrt(np.maximum(values, 0.0))

    def quasi_steady_roots(self, speed):
        """Return all roots in rad/s where no force lags: forces are then linear in the rate."""
        Z = self.free
        at_rest, moving = (
            sum(s.force(self.density, rate, speed) for s in self.strips) for rate in (0.0, 1.0)
        )
        M = Z.T @ self.mass @ Z
        K = Z.T @ (self.stiffness - at_rest) @ Z
        D = -Z.T @ (moving - at_rest) @ Z
        n = len(M)
        lower = -np.linalg.solve(M, np.hstack([K, D]))
        return np.linalg.eigvals(np.vstack([np.eye(n, 2 * n, n), lower]))

    def determinant(self, rate, speed):
        """Return phase and logarithm of the determinant of the unconstrained motions."""
        Z = self.free
        return np.linalg.slogdet(Z.T @ self.dynamic(rate, speed) @ Z)


@dataclass(frozen=True)
class _Side:
    """One wing: its matrices, hinge constraints, strips and the motion of its root."""

    wing: object
    components: tuple
    mirror: np.ndarray

    @cached_property
    def starts(self):
        return np.cumsum([0, *(c.count for c in self.components)])

    @property
    def size(self):
        return int(self.starts[-1])

    def _rows(self, segment, block):
        """Place rows of a segment's coordinates among those of the wing."""
        block = np.atleast_2d(block)
        rows = np.zeros((len(block), self.size))
        rows[:, self.starts[segment] : self.starts[segment + 1]] = block
        return rows

    def turn(self, segment):
        angle = sum(hinge.fold for hinge in self.wing.hinges[:segment])
        c, s = np.cos(angle), np.sin(angle)
        return self.mirror @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])

    def displacement(self, segment, x, y):
        """Return the global displacement of a point, (3, n)."""
        local = self.components[segment].displacement(np.array([x]), np.array([y]))[0]
        return self._rows(segment, self.turn(segment) @ local)

    def slope(self, segment, y):
        """Return dw/dy on the elastic axis, (1, n)."""
        zero, y = np.zeros(1), np.array([y])
        return self._rows(segment, self.components[segment].slopes(zero, y)[0, 1])

    @cached_property
    def mass(self):
        M = scipy.linalg.block_diag(*(c.mass for c in self.components))
        for point in self.wing.point_masses:
            u = self.displacement(point.segment - 1, point.x, point.y)
            M += point.mass * u.T @ u
        return M

    @cached_property
    def stiffness(self):
        K = scipy.linalg.block_diag(*(c.stiffness for c in self.components))
        for joint, hinge in enumerate(self.wing.hinges):
            turn = self._opening(joint)
            K += hinge.stiffness * turn.T @ turn
        return K

    def _opening(self, joint):
        """Return by how much a hinge opens, (1, n)."""
        return self.slope(joint, self.wing.segments[joint].span) - self.slope(joint + 1, 0.0)

    @cached_property
    def constraints(self):
        rows = [np.zeros((0, self.size))]
        for joint, inner in enumerate(self.wing.segments[:-1]):
            for x in (0.1 * inner.chord, -0.3 * inner.chord):
                here, there = (joint, x, inner.span), (joint + 1, x, 0.0)
                rows.append(self.displacement(*here) - self.displacement(*there))
            if self.wing.hinges[joint].kind == "rigid":
                rows.append(self._opening(joint))
        return np.vstack(rows)

    def strips(self, loads, lags, placed):
        """Return the strips of every segment, with steady lifts per span normal to it."""
        points, weights = np.polynomial.legendre.leggauss(24)
        return [
            _strip(
                segment,
                weights * segment.span / 2,
                load,
                lags,
                lambda x, i=i, Y=segment.span: placed(
                    np.stack([self.displacement(i, x, y) for y in Y * (1 + points) / 2])
                ),
                self.turn(i)[:, 2],
            )
            for i, (segment, load) in enumerate(zip(self.wing.segments, loads, strict=True))
        ]


def _strip(section, width, load, lags, at, normal):
    """Return a strip from the displacements ``at(x)`` of its stations, (k, 3, n)."""
    b, a = section.half_chord, section.axis_offset
    axis, quarter, middle, three = (
        np.einsum("a,kan->kn", normal, at(x)) for x in (0.0, -b * (a + 0.5), -b * a, b * (0.5 - a))
    )
    return Strip(
        half_chord=b,
        slope=section.lift_slope,
        width=width,
        load=load,
        axis=axis,
        quarter=quarter,
        middle=middle,
        three_quarters=three,
        aft=at(0.0)[:, 0],
        lags=lags,
    )


def carriage_components(wing):
    """The component modes that the half aircraft uses."""
    return tuple(
        beam_modes(segment, wing.analysis, Root.FREE if i else Root.CARRIAGE)
        for i, segment in enumerate(wing.segments)
    )


def free_components(wing):
    """Segments that may all move in every way; the first spans the same motions and more."""
    first, count = wing.segments[0], wing.analysis.bending_modes
    twist = JacobiFunctions(first.span, wing.analysis.torsion_modes, 0)
    root = BeamModes(first, JacobiFunctions(first.span, count + 2, 0), twist, Root.FREE)
    return (root, *carriage_components(wing)[1:])


def level_loads(wing):
    """Return the steady lift per span normal to each segment, and that of the tail.

    The lift of a segment is normal to it and grows with the cosine of its turn. Without trim of
    the moment the tail is set so that it lifts nothing.
    """
    aircraft, rho = wing.aircraft, wing.air.density
    turned = np.cos(np.cumsum([0.0, *(hinge.fold for hinge in wing.hinges)]))
    per_span = np.array([s.lift_slope * rho * s.half_chord for s in wing.segments]) * turned
    upward = per_span * turned * np.array([s.span for s in wing.segments])
    quarter = np.array([s.chord * (0.25 - s.elastic_axis) for s in wing.segments])
    bodies = [(s.mass_per_span * s.span, s.mass_offset) for s in wing.segments]
    bodies += [(point.mass, point.x) for point in wing.point_masses]
    bodies += [(body.mass, body.x) for body in (aircraft.fuselage, aircraft.tail)]
    mass = sum(m for m, _ in bodies)
    centre = sum(m * x for m, x in bodies) / mass
    tail = aircraft.tail
    behind = tail.x + (0.25 - tail.elastic_axis) * tail.chord - centre
    on_tail = 0.0
    if aircraft.trim == "force-and-moment":
        ahead = (upward * (quarter - centre)).sum() / upward.sum()
        on_tail = -mass * aircraft.gravity * ahead / (behind - ahead)
    angle = (mass * aircraft.gravity - on_tail) / upward.sum()
    return angle * per_span, on_tail / tail.span


def explicit_aircraft(wing, components, sides=1, wing_lags=True, tail_lags=True):
    """Return the half aircraft (one side) or the full one, in level flight."""
    aircraft = wing.aircraft
    wings = [_Side(wing, components, mirror) for mirror in (np.eye(3), MIRROR)[:sides]]
    bodies = [aircraft.fuselage, aircraft.tail]
    ends = np.cumsum([0, *(w.size for w in wings), 3, 3])
    size = int(ends[-1])

    def placed(part, rows):
        whole = np.zeros((*rows.shape[:-1], size))
        whole[..., ends[part] : ends[part + 1]] = rows
        return whole

    mass = scipy.linalg.block_diag(
        *(w.mass for w in wings),
        *(sides * np.diag([b.mass, b.mass, b.pitch_inertia]) for b in bodies),
    )
    stiffness = scipy.linalg.block_diag(*(w.stiffness for w in wings), np.zeros((6, 6)))
    rows = [placed(part, w.constraints) for part, w in enumerate(wings)]
    first = len(wings)

    def carried(body, place, x):
        """Displacement of the point x of a body, (3, size)."""
        return placed(first + body, np.array([[1, 0, 0], [0, 0, 0], [0, 1, place - x]], float))

    for part, side in enumerate(wings):
        rows += _joined(wing, side, partial(placed, part), carried)
    for x in (0.0, 0.7):
        rows.append(carried(0, aircraft.fuselage.x, x) - carried(1, aircraft.tail.x, x))
    loads, on_tail = level_loads(wing)
    strips = [
        strip
        for part, side in enumerate(wings)
        for strip in side.strips(loads, wing_lags, partial(placed, part))
    ]
    tail = aircraft.tail
    up, width = np.array([0.0, 0.0, 1.0]), np.array([sides * tail.span])
    strips.append(
        _strip(tail, width, on_tail, tail_lags, lambda x: carried(1, tail.x, tail.x + x)[None], up)
    )
    return Explicit(mass, stiffness, _independent(np.vstack(rows)), tuple(strips), wing.air.density)


def _joined(wing, side, placed, carried):
    """Return the rows that hold the root of one wing to the fuselage."""
    yield placed(side.slope(0, 0.0))
    for x in (0.0, 0.4 * wing.segments[0].chord):
        yield placed(side.displacement(0, x, 0.0)) - carried(0, wing.aircraft.fuselage.x, x)


def _independent(rows):
    """Return as many rows as are independent, chosen by pivoted elimination."""
    _, R, order = scipy.linalg.qr(rows.T, mode="economic", pivoting=True)
    size = np.abs(np.diagonal(R))
    return rows[np.sort(order[: (size > 1e-9 * size[0]).sum()])]
