"""What does an aircraft cost beside its wing clamped, and a shifted pencil beside QZ?

All in one process on one core, one after the other; fold angles 30, -60 degrees, strip theory,
twelve elastic modes.

- One case, clamped and as an aircraft, both as `foldwing boundary` solves them: structure, flutter
  points, certificate; of the aircraft also trim, phugoid and short period.
- The eigenvalues of the pencil at 200 reduced frequencies. K - Qhat_0 of an aircraft may be
  singular; the usual remedy is the generalized eigenproblem by QZ (scipy.linalg.eigvals with two
  matrices, called for each frequency), ours a pencil about a negative airspeed squared, all
  frequencies at once.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import scipy.linalg
from support.timing import median_time

from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.path import factors_of
from foldwing.studies.boundary import boundary_study
from foldwing.studies.case import solve_case
from foldwing.studies.grid import radians
from foldwing.studies.speeds import speed_range

FOLDS = (30.0, -60.0)
FREQUENCIES = 1j * np.geomspace(1e-6, 3.0, 200)
SHIFT = 25.0


def qz(pencil) -> np.ndarray:
    """Return 1/U^2 of every frequency from two matrices each."""
    return np.array(
        [
            scipy.linalg.eigvals(-T2, T0)
            for T0, T2 in zip(pencil.constant, pencil.quadratic, strict=True)
        ]
    )


def difference(pencil) -> float:
    """Return the largest relative difference of the real positive airspeeds of both ways."""
    ours = np.sort(np.abs(1.0 / factors_of(pencil, SHIFT).inverse - SHIFT), axis=1)
    theirs = np.sort(np.abs(1.0 / qz(pencil)), axis=1)
    usual = (theirs > 1.0) & (theirs < 1e4)
    return float(np.abs(ours / theirs - 1.0)[usual].max())


def main() -> None:
    """Print absolute times and ratios."""
    aircraft = AeroelasticWing(read_model("three-segment-aircraft"))
    clamped = AeroelasticWing(aircraft.wing.clamped)
    speeds = speed_range(aircraft)
    seconds = [
        median_time(lambda model=model: solve_case(model, FOLDS, speeds))
        for model in (clamped, aircraft)
    ]
    cases = [(fold, -fold) for fold in np.arange(0.0, 150.1, 2.5)]
    sweep = median_time(lambda: boundary_study(aircraft, cases), 1)
    pencil = aircraft.system(aircraft.modes(radians(FOLDS))).pencil(FREQUENCIES)
    slow = median_time(lambda: qz(pencil))
    fast = median_time(lambda: factors_of(pencil, SHIFT))
    print(f"one certified case, root clamped          {1e3 * seconds[0]:9.1f} ms")
    print(f"one certified case, aircraft              {1e3 * seconds[1]:9.1f} ms")
    print(f"boundary of {len(cases)} fold angles, aircraft   {sweep:9.2f} s")
    print(f"200 pencils by QZ                         {1e3 * slow:9.1f} ms")
    print(f"200 pencils about a negative airspeed     {1e3 * fast:9.1f} ms")
    print(f"aircraft / root clamped                   {seconds[1] / seconds[0]:9.1f} times")
    print(f"QZ / negative airspeed                    {slow / fast:9.1f} times")
    print(f"largest difference of their airspeeds     {difference(pencil):9.1e}")


if __name__ == "__main__":
    main()
