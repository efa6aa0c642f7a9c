"""How fast are certified flutter points and loci, beside determinant contours?

Both sides solve the same case, the three-segment wing at 30, -60 degrees with twelve modes, one
after the other in one process on one core.

The contours are the brute-force method: at each of 100 airspeeds the determinant on a grid of
200 x 200 values of lambda, vectorized, with everything that does not depend on the grid point
computed once; its zero lines and their crossings. It yields approximate eigenvalues; no exact
flutter points.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"


import numpy as np
from support.timing import median_time

from foldwing.aeroelastic.system import AeroelasticSystem
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.stability.contours import contour_roots, determinant_map
from foldwing.stability.flutter import find_flutter
from foldwing.stability.tracking import track
from foldwing.studies.boundary import boundary_study
from foldwing.studies.grid import radians

FOLDS = (30.0, -60.0)
SPEED_RANGE = (0.4, 60.0)
AIRSPEEDS = np.linspace(0.6, 60.0, 100)
GRID = 200


def system_of(model: AeroelasticWing) -> AeroelasticSystem:
    """Return the aeroelastic system of the case, structure and strips solved anew."""
    return model.system(model.modes(radians(FOLDS)))


def contours(system: AeroelasticSystem, speeds: np.ndarray) -> int:
    """Return the number of eigenvalues found at all airspeeds by determinant contours."""
    top = 1.1 * system.omega[-1]
    growth = np.linspace(-0.5 * top, 0.1 * top, GRID)
    omega = np.linspace(top / GRID, top, GRID)
    return sum(len(contour_roots(determinant_map(system, U, growth, omega))) for U in speeds)


def main() -> None:
    """Print absolute times and ratios."""
    wing = read_model("three-segment")
    undamped, damped = AeroelasticWing(wing), AeroelasticWing(wing.with_analysis(damping=0.01))
    system, few = system_of(undamped), AIRSPEEDS[::20]
    brute = median_time(lambda: contours(system, few), 3) * len(AIRSPEEDS) / len(few)
    points = median_time(lambda: find_flutter(system_of(undamped), SPEED_RANGE))
    points_damped = median_time(lambda: find_flutter(system_of(damped), SPEED_RANGE))
    loci = median_time(lambda: track(system, AIRSPEEDS), 3)
    cases = [(fold, -fold) for fold in np.arange(0.0, 150.1, 2.5)]
    boundary = median_time(lambda: boundary_study(undamped, cases), 1)
    print(f"determinant contours, {len(AIRSPEEDS)} airspeeds      {brute:9.2f} s")
    print(f"certified flutter points, undamped        {1e3 * points:9.1f} ms")
    print(f"certified flutter points, zeta 0.01       {1e3 * points_damped:9.1f} ms")
    print(f"loci at {len(AIRSPEEDS)} airspeeds, 12 modes         {1e3 * loci:9.1f} ms")
    print(f"boundary of {len(cases)} fold angles             {boundary:9.2f} s")
    print(f"contours / certified flutter points       {brute / points:9.0f} times")
    print(f"contours / loci                           {brute / loci:9.0f} times")


if __name__ == "__main__":
    main()
