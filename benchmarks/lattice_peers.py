"""How accurate and how fast is the vortex lattice, beside other open codes?

Each code solves the same flat rectangular wing with the same 8 x 60 equal panels on one core; two
rows more show strips that lie otherwise. Times are medians of warm runs (one warm run for the
doublet lattice), without imports and compilation. What is compared:

    foldwing        horseshoes; the lift slope from one real solve, the unsteady forces of all
                    frequencies and modes from one set-up
    PteraSoftware   steady ring and horseshoe vortices; builds the geometry, solves, and finds the
                    forces from the velocity at every vortex
    PanelAero       vortex lattice at k = 0, doublet lattice (parabolic) at k > 0: one matrix of
                    influence coefficients, inverted, for each frequency; it serves any modes

The doublet lattice is an independent theory of the same flow: its forces must agree with ours as
far as panels allow. A folded wing turned about the stream as a whole must keep its forces; past 90
degrees PanelAero itself warns of panels upside down.

The other codes come with ``pip install -e '.[peers]'``; what is not installed is left out.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"
os.environ["OMP_NUM_THREADS"] = "1"
os.environ["NUMBA_NUM_THREADS"] = "1"

import importlib
import logging
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from support.timing import median_time

from foldwing.aerodynamics.influence import Influence
from foldwing.aerodynamics.lattice import INSET, SegmentMesh, Strips
from foldwing.aerodynamics.unsteady import LatticeModel, PanelMotion, lattice_model, load_length
from foldwing.aeroelastic.wing import AeroelasticWing
from foldwing.model import Lattice, read_model

CHORDWISE, SPANWISE, WAKE = 8, 60, 20
HALF_CHORD = 0.5
EXACT = {6: 4.2138, 12: 5.0210}
"""Lift slope per radian of flat rectangular wings by aspect ratio, extrapolated in the panels."""

FREQUENCIES = np.linspace(0.05, 2.0, 24)
COMPARED = (0.1, 0.5, 1.0)
ANGLES = (30.0, 60.0, 90.0, 120.0, 150.0, 180.0)


@dataclass(frozen=True)
class Case:
    """A lattice and how its panels move per unit of each mode; air of unit density."""

    strips: Strips
    chordwise: int
    motion: PanelMotion
    lengths: np.ndarray
    half_chord: float

    def model(self, turn: float = 0.0) -> LatticeModel:
        """Return the unsteady lattice of the wing turned about the stream."""
        strips = self.strips.turned(turn)
        influence = Influence(strips, self.chordwise, WAKE * self.chordwise)
        return lattice_model(influence, self.motion, self.lengths, 1.0, self.half_chord, Lattice())


def peer(name: str) -> ModuleType | None:
    """Return a module of another code, or say that it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        print(f"{name.split('.')[0]} is left out: {error}. pip install -e '.[peers]' brings it.")
        return None


# --- the wings ------------------------------------------------------------------------------------


def rectangle(aspect: float, inset: float = 0.0) -> Strips:
    """Return the strips of a wing of unit chord; the lattice may end before its tips."""
    y = aspect * (inset + np.arange(SPANWISE + 1)) / (SPANWISE + 2.0 * inset)
    edges = np.stack([y, np.zeros_like(y)], axis=1)
    ones = np.ones(SPANWISE)
    return Strips(edges[:-1], edges[1:], -0.5 * ones, ones, np.zeros(SPANWISE, int))


def rectangle_case(aspect: float) -> Case:
    """Return the rectangle with twelve modes: plunge and pitch times six polynomials along it."""
    strips = rectangle(aspect)
    mesh = SegmentMesh(np.append(strips.inner[:, 0], aspect), -0.5, 1.0, CHORDWISE)
    lengths = load_length(mesh, "exact")

    def modes(station: np.ndarray, slope: bool = False) -> np.ndarray:
        x, y = mesh.points(station)
        along = legendre.legvander(2.0 * y / aspect - 1.0, 5)
        plunge, pitch = (0.0, -1.0) if slope else (1.0, -x[:, None])
        return np.hstack([plunge * along, pitch * along])

    collocation, vortex = mesh.station(0.75), mesh.station(0.25)
    motion = PanelMotion(
        modes(collocation, slope=True),
        modes(collocation),
        modes(vortex),
        modes(vortex + lengths / 2.0),
    )
    return Case(strips, CHORDWISE, motion, np.repeat(lengths, SPANWISE), HALF_CHORD)


def folded_case() -> Case:
    """Return the three-segment wing at 30, -75 degrees with its twelve natural modes."""
    wing = AeroelasticWing(read_model("three-segment"), "lattice")
    modes = wing.modes(tuple(np.radians((30.0, -75.0))))
    return Case(
        wing.strips(modes),
        wing.wing.lattice.chordwise,
        wing.panel_motion(modes),
        wing.load_lengths,
        wing.half_chord,
    )


# --- foldwing -------------------------------------------------------------------------------------


def our_slope(aspect: float, inset: float) -> float:
    """Return the lift slope per radian of the rectangle."""
    strips = rectangle(aspect, inset)
    A = Influence(strips, CHORDWISE, rows=0).wing
    circulation = np.linalg.solve(A, -np.ones(len(A)))
    return float(2.0 * circulation @ np.tile(strips.width, CHORDWISE) / aspect)


def our_forces(case: Case) -> np.ndarray:
    """Return Qhat at all reduced frequencies, set-up and all."""
    return case.model().forces(1j * FREQUENCIES)


# --- PteraSoftware --------------------------------------------------------------------------------


def ptera_slope(ps: ModuleType, kind: str, spacing: str, aspect: float) -> float:
    """Return the lift slope per radian from the lift at one tenth of a degree."""
    geometry, alpha = ps.geometry, 0.1
    foil = geometry.airfoil.Airfoil(name="naca0012")  # only its camber line counts: flat
    root, tip = (
        geometry.wing_cross_section.WingCrossSection(
            airfoil=foil,
            num_spanwise_panels=count,
            chord=1.0,
            Lp_Wcsp_Lpp=(0.0, y, 0.0),
            spanwise_spacing=spacing if count else None,
        )
        for count, y in ((SPANWISE, 0.0), (None, float(aspect)))
    )
    wing = geometry.wing.Wing(
        wing_cross_sections=[root, tip], num_chordwise_panels=CHORDWISE, chordwise_spacing="uniform"
    )
    airplane = geometry.airplane.Airplane(wings=[wing])
    flight = ps.operating_point.OperatingPoint(rho=1.0, vCg__E=1.0, alpha=alpha)
    problem = ps.problems.SteadyProblem(airplanes=[airplane], operating_point=flight)
    module = getattr(ps, f"steady_{kind}_vortex_lattice_method")
    solver = getattr(module, f"Steady{kind.title()}VortexLatticeMethodSolver")
    solver(problem).run(calculate_streamlines=False)
    return float(-airplane.forceCoefficients_W[2] / np.radians(alpha))


# --- PanelAero ------------------------------------------------------------------------------------


def aerogrid(strips: Strips, chordwise: int) -> dict[str, Any]:
    """Return the panels of a lattice as PanelAero describes them."""
    length = np.tile(strips.chord / chordwise, chordwise)
    first = (
        np.tile(strips.leading, chordwise) + np.repeat(np.arange(chordwise), strips.count) * length
    )

    def points(part: np.ndarray, fraction: float) -> np.ndarray:
        return np.insert(np.tile(part, (chordwise, 1)), 0, first + fraction * length, axis=1)

    return {
        "n": len(length),
        "l": length,
        "A": length * np.tile(strips.width, chordwise),
        "N": np.insert(np.tile(strips.normal, (chordwise, 1)), 0, 0.0, axis=1),
        "offset_j": points(strips.middle, 0.75),
        "offset_k": points(strips.middle, 0.5),
        "offset_l": points(strips.middle, 0.25),
        "offset_P1": points(strips.inner, 0.25),
        "offset_P3": points(strips.outer, 0.25),
    }


def panelaero_slope(dlm: ModuleType, aspect: float) -> float:
    """Return the lift slope per radian of the rectangle."""
    grid = aerogrid(rectangle(aspect), CHORDWISE)
    pressure = dlm.calc_Qjj(grid, 0.0, 0.0) @ np.ones(grid["n"])
    return float(pressure @ grid["A"] / aspect)


def panelaero_forces(
    dlm: ModuleType, case: Case, frequencies: np.ndarray, turn: float = 0.0
) -> np.ndarray:
    """Return the generalized forces at reduced frequencies, as Qhat."""
    grid = aerogrid(case.strips.turned(turn), case.chordwise)
    k = np.asarray(frequencies) / case.half_chord
    Q = dlm.calc_Qjjs(grid, [0.0], k)[0]
    motion = case.motion
    load = -0.5 * motion.vortex.T * grid["A"]
    return np.array(
        [
            load @ (q @ (motion.slope + 1j * kk * motion.collocation))
            for q, kk in zip(Q, k, strict=True)
        ]
    )


# --- what is printed ------------------------------------------------------------------------------


def print_slopes(ps: ModuleType | None, dlm: ModuleType | None) -> None:
    """Print lift slopes, their errors and times."""
    codes: list[tuple[str, Callable[[float], float]]] = [
        ("foldwing, equal strips", partial(our_slope, inset=0.0)),
        ("foldwing, inset tips", partial(our_slope, inset=INSET)),
    ]
    if ps is not None:
        for kind, spacing in (("ring", "uniform"), ("horseshoe", "uniform"), ("ring", "cosine")):
            name = f"PteraSoftware, {kind}, {spacing}"
            codes.append((name, partial(ptera_slope, ps, kind, spacing)))
    if dlm is not None:
        codes.append(("PanelAero, k = 0", partial(panelaero_slope, dlm)))
    print(f"\nLift slope per radian, {CHORDWISE} x {SPANWISE} panels")
    print(
        f"{'':32}"
        + "".join(f"{f'aspect {aspect}':>12}{'error':>9}" for aspect in EXACT)
        + "      time"
    )
    for name, slope in codes:
        values = [(slope(aspect), exact) for aspect, exact in EXACT.items()]
        row = "".join(f"{value:12.4f}{100 * (value / exact - 1):8.2f}%" for value, exact in values)
        print(f"{name:32}{row}{1e3 * median_time(partial(slope, 6)):7.1f} ms")


def print_forces(dlm: ModuleType | None) -> None:
    """Print the time of unsteady forces, and plunge and pitch beside the doublet lattice."""
    case = rectangle_case(6)
    ours = 1e3 * median_time(lambda: our_forces(case))
    print(f"\nForces of {len(FREQUENCIES)} reduced frequencies, 12 modes, aspect 6")
    print(f"foldwing                        {ours:9.1f} ms, set-up and all")
    if dlm is None:
        return
    theirs = 1e3 * median_time(lambda: panelaero_forces(dlm, case, FREQUENCIES), 1)
    print(f"PanelAero                       {theirs:9.1f} ms, {theirs / ours:.0f} times as long")
    Q = case.model().forces(1j * np.array(COMPARED))
    D = panelaero_forces(dlm, case, np.array(COMPARED))
    modes = {"plunge": 0, "pitch": 6}
    print("\nPlunge and pitch about mid-chord, aspect 6: foldwing | PanelAero | difference")
    for index, k in enumerate(COMPARED):
        scale = np.abs(Q[index][np.ix_([0, 6], [0, 6])])
        for force, i in modes.items():
            for mode, j in modes.items():
                a, b = Q[index, i, j], D[index, i, j]
                off = 100 * abs(a - b) / scale[list(modes.values()).index(i)].max()
                print(f"  k {k:3.1f}  {force:>6} by {mode:6}  {a:20.4f} | {b:20.4f} | {off:5.2f} %")
    worst = 100 * np.abs(Q - D).max(axis=(1, 2)) / np.abs(Q).max(axis=(1, 2))
    print("  all 12 modes, largest difference: " + ", ".join(f"{w:.2f} %" for w in worst))


def print_rotation(dlm: ModuleType | None) -> None:
    """Print how forces change when a folded wing is turned about the stream as a whole."""
    case = folded_case()
    k = np.array([0.5])

    def change(forces: Callable[[float], np.ndarray]) -> str:
        still = forces(0.0)
        turned = [np.abs(forces(np.radians(angle)) - still).max() for angle in ANGLES]
        return "".join(f"{value / np.abs(still).max():10.1e}" for value in turned)

    print("\nThe folded wing turned about the stream: change of its forces at k = 0.5")
    print("degrees   " + "".join(f"{angle:10.0f}" for angle in ANGLES))
    print("foldwing  " + change(lambda turn: case.model(turn).forces(1j * k)))
    if dlm is not None:
        print("PanelAero " + change(lambda turn: panelaero_forces(dlm, case, k, turn)))


def main() -> None:
    """Print all comparisons."""
    logging.disable(logging.WARNING)
    ps, dlm = peer("pterasoftware"), peer("panelaero.DLM")
    print_slopes(ps, dlm)
    print_forces(dlm)
    print_rotation(dlm)
    print(f"\nload of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
