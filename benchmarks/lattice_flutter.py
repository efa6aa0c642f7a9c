"""How fast are certified flutter points of the unsteady vortex lattice, beside its eigenproblem?

Both sides solve the same case, the three-segment wing at 30, -75 degrees with six modes, one after
the other in one process on one core: all flutter points up to 60 m/s with their certificate, from
the fast form, beside the eigenvalues of the reference at 100 airspeeds, from which flutter points
would still have to be found between the airspeeds.

The reference is the sparse eigenproblem of thousands of states, solved as well as can be with
standard tools: matrices are assembled once and only what depends on the airspeed is renewed, one
sparse factorization with shift for each airspeed, Arnoldi's method for twice as many roots as modes
to 1e-8, the shift at the flutter root as followed from the airspeed before. A second, smarter
baseline factorizes by hand what a general sparse solver does not see: the wake only shifts, so that
a system of the size of the panels is left.

Some airspeeds are timed and scaled to 100; each side runs once before it counts.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg
from scipy.signal import lfilter
from scipy.sparse.linalg import LinearOperator, eigs
from support.timing import median_time

from foldwing.aeroelastic.reference import Marching, Reference
from foldwing.aeroelastic.reference_roots import roots_near
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.flutter import FlutterAnalysis, find_flutter
from foldwing.structure.modes import StructuralModes
from foldwing.studies.grid import radians

FOLDS = (30.0, -75.0)
MODES = 6
SPEED_RANGE = (0.4, 60.0)
AIRSPEEDS = np.linspace(0.6, 60.0, 100)
TIMED = AIRSPEEDS[4::10]
TOLERANCE = 1e-8
REPEATS = 5


def model_of(chordwise: int, scheme: str) -> AeroelasticWing:
    """Return the wing with a mesh and a scheme."""
    wing = read_model("three-segment").with_lattice(chordwise=chordwise, scheme=scheme)
    return AeroelasticWing(wing, "lattice")


def six_modes(model: AeroelasticWing) -> StructuralModes:
    """Return the modes of the case."""
    return model.modes(radians(FOLDS)).only(np.arange(MODES))


def flutter(model: AeroelasticWing) -> FlutterAnalysis:
    """Return all flutter points, structure and lattice of the fold angles solved anew."""
    return find_flutter(model.system(six_modes(model)), SPEED_RANGE)


def general(marching: Marching, guess: complex) -> tuple[np.ndarray, np.ndarray]:
    """Return roots and vectors around a guess by sparse factorization and Arnoldi's method."""
    spectrum = roots_near(marching, guess * 1.001, 2 * MODES, TOLERANCE)
    return spectrum.eigenvalues, spectrum.vectors


@dataclass(frozen=True)
class Structured:
    """The inverse of M2 + sigma M1 by elimination of the wake; no relaxation.

    Row j of the wake holds h_j, which the right-hand side alone gives, plus omega_j times what the
    strips shed, with omega_j = (1/sigma - 1) sigma^-j.
    """

    wake: np.ndarray
    strips: int

    def roots(self, marching: Marching, guess: complex) -> tuple[np.ndarray, np.ndarray]:
        """Return roots and vectors around a guess."""
        sigma = complex(marching.factor(np.array([guess * 1.001]))[0])
        panels, wake = marching.panels, marching.wake
        rows = (wake.stop - wake.start) // self.strips
        omega = (1.0 / sigma - 1.0) * sigma ** -np.arange(rows)
        shed = np.tensordot(self.wake.reshape(panels.stop, rows, self.strips), omega, (1, 0))
        kept = np.r_[panels, wake.stop : marching.states]
        reduced = marching.before[kept][:, kept] + marching.after[kept][:, kept] * sigma
        reduced = reduced.toarray()
        reduced[panels, panels] += sigma * np.tile(shed, panels.stop // self.strips)
        factors = scipy.linalg.lu_factor(reduced, check_finite=False)

        def apply(x: np.ndarray) -> np.ndarray:
            r = marching.before @ x.ravel()
            h = lfilter([1.0 / sigma], [1.0, -1.0 / sigma], r[wake].reshape(rows, -1), axis=0)
            seen = self.wake @ np.stack([h.real.ravel(), h.imag.ravel()], axis=1)
            b = r[kept]
            b[panels] -= sigma * (seen[:, 0] + 1j * seen[:, 1])
            y = scipy.linalg.lu_solve(factors, b, check_finite=False)
            sums = y[panels].reshape(-1, self.strips).sum(axis=0)
            h += omega[:, None] * sums
            return np.concatenate([y[panels], h.ravel(), y[panels.stop :]])

        operator = LinearOperator(marching.after.shape, matvec=apply, dtype=complex)
        start = np.random.default_rng(0).standard_normal(marching.states) + 0j
        theta, x = eigs(operator, k=2 * MODES, v0=start, tol=TOLERANCE)
        return marching.eigenvalue(sigma * theta / (theta - 1.0)), x


def swept(
    reference: Reference, solve: Callable[[Marching, complex], tuple[np.ndarray, np.ndarray]]
) -> list[complex]:
    """Return the flutter root at the airspeeds that are timed, with those around it computed."""
    mode, found = 1, []
    vector = np.eye(MODES)[mode]
    guess = complex(1j * reference.modes.omega[mode])
    for speed in TIMED:
        marching = reference.at(float(speed))
        values, x = solve(marching, guess)
        q = x[marching.coordinates] / np.linalg.norm(x[marching.coordinates], axis=0)
        likeness = np.where(values.imag > 0.0, np.abs(vector.conj() @ q), 0.0)
        best = int(np.argmax(likeness))
        vector, guess = q[:, best], complex(values[best])
        found.append(guess)
    return found


def compare(chordwise: int) -> None:
    """Print absolute times and ratios of one mesh."""
    exact, average = model_of(chordwise, "exact"), model_of(chordwise, "average")
    reference = Reference(average, six_modes(average))
    marching = reference.at(20.0)
    wake = marching.after[marching.panels, marching.wake].toarray()
    structured = Structured(wake, marching.sizes[1])
    roots = [swept(reference, solve) for solve in (general, structured.roots)]
    np.testing.assert_allclose(*roots, rtol=1e-6)
    scale = len(AIRSPEEDS) / len(TIMED)
    brute = scale * median_time(lambda: swept(reference, general), 1)
    smart = scale * median_time(lambda: swept(reference, structured.roots), 1)
    points = median_time(lambda: flutter(exact), REPEATS)
    result = flutter(exact)
    verdict = "certified" if result.certified else "NOT certified"
    print(f"{chordwise} x 30 panels, {marching.states} states, {MODES} modes")
    print(f"  eigs, 100 airspeeds ({len(TIMED)} timed, scaled)   {brute:9.2f} s")
    print(f"  eigs, wake eliminated by hand         {smart:9.2f} s")
    print(f"  {len(result.points)} flutter points, {verdict:<19}  {1e3 * points:9.1f} ms")
    print(f"  eigs / flutter points                 {brute / points:9.0f} times")
    print(f"  eigs by hand / flutter points         {smart / points:9.0f} times")


def main() -> None:
    """Print the comparison for two meshes."""
    for chordwise in (4, 8):
        compare(chordwise)


if __name__ == "__main__":
    main()
