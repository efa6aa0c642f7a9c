"""How does the cost of the vortex lattice grow with its panels?

The three-segment wing at 30, -75 degrees with twelve modes and a wake of 20 chords, on one core.
Every mesh runs in a process of its own, so that its peak memory is its own: what the lattice adds
to the imports. The direct way solves, for each p, one dense complex system of all panels; that is
what the lattice replaces, and its results are compared. Larger meshes than ``DIRECT`` panels would
take it minutes.

Then what it comes to: one case with certificate, and a boundary of 61 fold angles on two processes;
and a rational approximation of the forces, for whoever needs them at very many p.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["OMP_NUM_THREADS"] = "1"

import json
import resource
import subprocess
import sys
import time

import numpy as np
from support.timing import median_time

from foldwing.aerodynamics.rational import rational_model
from foldwing.aerodynamics.unsteady import LatticeModel
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import read_model
from foldwing.structure.modes import StructuralModes
from foldwing.studies.boundary import boundary_study
from foldwing.studies.case import solve_case

FOLDS = (30.0, -75.0)
SPEED_RANGE = (3.0, 70.0)
MESHES = ((4, 30), (8, 30), (16, 60), (16, 120), (32, 240))
DIRECT = 2000
P = 0.02 + 1j * np.linspace(0.05, 2.0, 32)
COLUMNS = {
    "set-up, ms": "setup",
    "forces, us per p": "forces",
    "with derivative": "derivative",
    "direct, ms per p": "direct",
    "memory, MB": "memory",
}


def peak_memory() -> float:
    """Return the most memory that this process has held, in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def wing_of(chordwise: int, spanwise: int) -> AeroelasticWing:
    """Return the wing with a mesh."""
    wing = read_model("three-segment")
    mesh = wing.lattice.model_copy(update={"chordwise": chordwise, "spanwise": spanwise})
    return AeroelasticWing(wing.model_copy(update={"lattice": mesh}), "lattice")


# --- one mesh, in its own process -----------------------------------------------------------------


def measure(chordwise: int, spanwise: int) -> dict[str, float]:
    """Return times in seconds and memory in MB of one mesh."""
    wing = wing_of(chordwise, spanwise)
    modes = wing.modes(tuple(np.radians(FOLDS)))
    large = chordwise * spanwise > DIRECT
    before = peak_memory()
    model = wing.lattice(modes)
    memory = peak_memory() - before
    result = {
        "panels": chordwise * spanwise,
        "setup": median_time(lambda: wing.lattice(modes), 1 if large else 5),
        "forces": median_time(lambda: model.forces(P)) / len(P),
        "derivative": median_time(lambda: model.forces_with_derivative(P)) / len(P),
        "memory": memory,
        "rows": model.weights[0].shape[1],
        "wake": model.weights[0].shape[0],
    }
    return result if large else result | measure_direct(wing, modes, model)


def measure_direct(
    wing: AeroelasticWing, modes: StructuralModes, model: LatticeModel
) -> dict[str, float]:
    """Return the time per p of dense systems, and how far their forces are from the lattice's."""
    influence, motion = wing.influence(modes), wing.panel_motion(modes)
    A0, wake = influence.wing, np.array(list(influence.wake_rows(0)))
    load = wing.wing.air.density * np.tile(influence.strips.width, influence.chordwise)
    step = influence.step(0) / wing.half_chord
    L1 = load * motion.vortex.T
    L2 = load * wing.load_lengths * motion.load.T / wing.half_chord

    def forces(p: complex) -> np.ndarray:
        omega = np.diff(np.exp(-p * step * np.arange(influence.rows + 1)))
        shed = (omega @ wake.reshape(len(wake), -1)).reshape(wake.shape[1:])
        A = A0 + np.tile(shed, influence.chordwise)
        g = np.linalg.solve(A, motion.slope + p / wing.half_chord * motion.collocation)
        return (L1 + p * L2) @ g

    Q, exact = model.forces(P[:2]), np.array([forces(p) for p in P[:2]])
    return {
        "direct": median_time(lambda: forces(P[0]), 3),
        "difference": float(np.abs(Q - exact).max() / np.abs(exact).max()),
    }


# --- all meshes -----------------------------------------------------------------------------------


def measured_apart(chordwise: int, spanwise: int) -> dict[str, float]:
    """Return what a process of its own measures."""
    command = [sys.executable, __file__, str(chordwise), str(spanwise)]
    answer = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(answer.stdout)


def print_growth() -> None:
    """Print the cost of every mesh and the exponents of its growth with the panels."""
    print(f"{'panels':>10}" + "".join(f"{title:>18}" for title in COLUMNS) + f"{'wake rows':>14}")
    factors = {"memory": 1.0, "forces": 1e6, "derivative": 1e6}
    results = []
    for mesh in MESHES:
        result = measured_apart(*mesh)
        results.append(result)
        cells = (
            f"{factors.get(key, 1e3) * result[key]:18.1f}" if key in result else f"{'-':>18}"
            for key in COLUMNS.values()
        )
        rows = f"{result['rows']:.0f} of {result['wake']:.0f}"
        print(f"{mesh[0]:>4} x {mesh[1]:<3}" + "".join(cells) + f"{rows:>14}", flush=True)
    exponents = []
    for key in COLUMNS.values():
        known = [(r["panels"], r[key]) for r in results if r.get(key, 0.0) > 0.0]
        exponents.append(np.polyfit(*np.log(np.array(known)).T, 1)[0])
    print(f"{'panels^':>10}" + "".join(f"{exponent:18.2f}" for exponent in exponents))
    worst = max(result.get("difference", 0.0) for result in results)
    print(f"largest difference from the direct way, relative: {worst:.0e}")


def print_cases() -> None:
    """Print the time of a certified case and of a boundary."""
    wing = wing_of(8, 30)
    analysis = solve_case(wing, FOLDS, SPEED_RANGE).analysis
    case = median_time(lambda: solve_case(wing, FOLDS, SPEED_RANGE))
    cases = [(fold, -fold) for fold in np.arange(0.0, 150.1, 2.5)]
    start = time.perf_counter()
    boundary_study(wing, cases, jobs=2)
    boundary = time.perf_counter() - start
    verdict = "certified" if analysis.certified else "not certified"
    points = f"{len(analysis.points)} points, {verdict}"
    print(f"\none case, 8 x 30 panels, {points}: {1e3 * case:.0f} ms")
    print(f"boundary of {len(cases)} fold angles, 2 processes: {boundary:.1f} s")


def print_rational() -> None:
    """Print what a rational approximation takes and gives."""
    wing = wing_of(8, 30)
    model = wing.lattice(wing.modes(tuple(np.radians(FOLDS))))
    fitted = rational_model(model, 1.0)
    build = median_time(lambda: rational_model(model, 1.0))
    each = median_time(lambda: fitted.forces_with_derivative(P)) / len(P)
    print(f"rational forces up to k = 1, error {fitted.error:.0e}: built in {1e3 * build:.1f} ms,")
    print(f"then {1e6 * each:.1f} us per p with derivative")


def main() -> None:
    """Measure one mesh when it is named, else print all there is."""
    if len(sys.argv) == 3:
        print(json.dumps(measure(int(sys.argv[1]), int(sys.argv[2]))))
        return
    print_growth()
    print_cases()
    print_rational()
    print(f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
