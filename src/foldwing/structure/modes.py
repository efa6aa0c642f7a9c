"""Natural modes of the folded wing."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.linalg

from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Real
from foldwing.maths.null_space import null_space
from foldwing.model import Frames, HingeKind
from foldwing.structure.assembly import Assembly
from foldwing.structure.component import SectionMotion

AIRCRAFT_MOTIONS = ("x", "z", "pitch")
"""Rigid motions of an aircraft: aft, up, and nose up about the centre of gravity."""


@dataclass(frozen=True)
class StructuralModes:
    """Natural modes with unit modal mass.

    Attributes
    ----------
    assembly : Assembly
    fold_angles : tuple of float
        psi_2 .. psi_N in radians.
    omega : array, shape (n,)
        Angular natural frequencies in rad/s, ascending; exactly zero for rigid motions.
    coordinates : array, shape (size, n)
        Modes in the coordinates of all segments.
    damping : float
        Structural damping ratio of every mode.
    mismatch : float
        Largest relative difference of an omega, which is taken from the stored energy of its mode,
        and that of the eigenvalue solver. Grows when a hinge is so stiff, or the basis so large,
        that round-off spoils the modes; below 1e-5 it is of no concern.
    labels : tuple of str
        Names of the modes where they are not to be counted anew.
    rigid_labels : tuple of str
        Names of the first rigid motions: those of an aircraft as a whole.
    """

    assembly: Assembly
    fold_angles: tuple[float, ...]
    omega: Real
    coordinates: Real
    damping: float = 0.0
    mismatch: float = 0.0
    labels: tuple[str, ...] = ()
    rigid_labels: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number n of modes."""
        return len(self.omega)

    @property
    def frequencies(self) -> Real:
        """Natural frequencies in Hz, shape (n,)."""
        return self.omega / (2.0 * np.pi)

    @cached_property
    def by_segment(self) -> tuple[Real, ...]:
        """Modes in the coordinates of each segment, shapes (n_i, n)."""
        return tuple(self.assembly.by_segment(self.coordinates))

    @cached_property
    def frames(self) -> Frames:
        """Axes of the segments of the folded wing."""
        return self.assembly.wing.frames(self.fold_angles)

    @property
    def rotations(self) -> tuple[Real, ...]:
        """Rotation R_i from the local axes of each segment to global axes."""
        return self.frames.rotations

    @property
    def origins(self) -> tuple[Real, ...]:
        """Global position of the origin of each segment, shape (3,), in metres."""
        return self.frames.origins

    def position(self, segment: int, x: Real, y: Real) -> Real:
        """Return the global position at rest of points of one segment (from 0), shape (m, 3)."""
        return self.frames.position(segment, x, y)

    def displacement(self, segment: int, x: Real, y: Real) -> Real:
        """Return the global displacement of points per unit modal coordinate, shape (m, 3, n)."""
        local = self.assembly.components[segment].displacement(x, y) @ self.by_segment[segment]
        return np.asarray(np.einsum("ab,mbn->man", self.rotations[segment], local))

    def section_motion(self, segment: int, y: Real) -> SectionMotion:
        """Return local plunge and twist of sections per unit modal coordinate, each (m, n)."""
        plunge, twist = self.assembly.components[segment].section_motion(y)
        q = self.by_segment[segment]
        return SectionMotion(plunge @ q, twist @ q)

    @cached_property
    def bending_share(self) -> Real:
        """Share of the kinetic energy of the wing that is in bending, 0 to 1, shape (n,)."""
        q = self.coordinates
        torsion = np.einsum("im,ij,jm->m", q, self.assembly.torsion_mass, q)
        total = np.einsum("im,ij,jm->m", q, self.assembly.wing_mass, q)
        return np.asarray(np.clip(1.0 - torsion / total, 0.0, 1.0))

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names B1, B2, T1 ... by the larger share of kinetic energy; R1 ... for rigid motions.

        The rigid motions of an aircraft are called x, z and pitch (about the centre of gravity).
        """
        if self.labels:
            return self.labels
        counts = {"B": 0, "T": 0, "R": 0}
        names = list(self.rigid_labels)
        flexible = slice(len(names), None)
        for omega, share in zip(self.omega[flexible], self.bending_share[flexible], strict=True):
            letter = "R" if omega == 0.0 else "B" if share >= 0.5 else "T"
            counts[letter] += 1
            names.append(f"{letter}{counts[letter]}")
        return tuple(names)

    def only(self, keep: Indices) -> "StructuralModes":
        """Return these modes with only the columns ``keep``, in that order."""
        labels = tuple(self.names[column] for column in keep) if self.rigid_labels else ()
        return StructuralModes(
            self.assembly,
            self.fold_angles,
            self.omega[keep],
            self.coordinates[:, keep],
            self.damping,
            self.mismatch,
            labels,
        )

    def without(self, names: Sequence[str]) -> "StructuralModes":
        """Return these modes less the named ones; the others keep their names.

        The rigid motions of an aircraft cannot be left out.

        Raises
        ------
        InputError
            When there is no such mode, or none would remain.
        """
        known = [name for name in self.names if name not in self.rigid_labels]
        unknown = [name for name in names if name not in known]
        if unknown:
            limit = f"must be one of: {', '.join(known)}"
            raise InputError("--drop-mode", unknown[0], limit, "Name a mode of this wing.")
        keep = [column for column, name in enumerate(self.names) if name not in names]
        if not keep:
            limit = "at least one mode must remain"
            raise InputError("--drop-mode", ", ".join(names), limit, "Leave out fewer modes.")
        labels = tuple(self.names[column] for column in keep)
        return replace(self.only(np.array(keep)), labels=labels)


def modal_assurance(first: StructuralModes, second: StructuralModes) -> Real:
    """Return the mass-weighted MAC of two sets of modes of one assembly, shape (n1, n2).

    The coordinates are local to the segments, so the fold angles of the two may differ.
    """
    overlap = first.coordinates.T @ first.assembly.mass @ second.coordinates
    return np.asarray(overlap**2)


def natural_modes(
    assembly: Assembly, fold_angles: tuple[float, ...] | None = None, count: int | None = None
) -> StructuralModes:
    """Solve the joined wing in the null space of its constraints.

    Parameters
    ----------
    assembly : Assembly
    fold_angles : tuple of float, optional
        psi_2 .. psi_N in radians; those of the wing by default.
    count : int, optional
        Number of modes, besides the rigid motions of an aircraft; the analysis' ``system_modes`` by
        default, never more than there are.

    Notes
    -----
    In coordinates y = R q with R^T R = M the problem is a standard symmetric one.
    """
    wing = assembly.wing
    folds = wing.fold_angles if fold_angles is None else tuple(fold_angles)
    wanted = wing.analysis.system_modes if count is None else count
    R = assembly.mass_factor
    C = scipy.linalg.solve_triangular(R, assembly.constraints(folds).T, trans="T").T
    Z = np.asarray(scipy.linalg.solve_triangular(R, null_space(C).basis))
    rigid, names = _rigid_motions(assembly, Z, folds)
    wanted += len(names)
    omega2, vectors = _elastic_modes(Z.T @ assembly.stiffness @ Z, rigid, wanted)
    modes = Z @ np.hstack([rigid, vectors])[:, :wanted]
    modes[:, len(names) :] = _signed(modes[:, len(names) :])
    stored = assembly.stored_energy(modes)
    stored[: rigid.shape[1]] = 0.0
    solved = np.concatenate([np.zeros(rigid.shape[1]), omega2])[:wanted]
    elastic = stored > 0.0
    mismatch = np.abs(np.sqrt(np.abs(solved[elastic]) / stored[elastic]) - 1.0)
    return StructuralModes(
        assembly,
        folds,
        np.sqrt(stored),
        modes,
        wing.analysis.damping,
        float(mismatch.max(initial=0.0)),
        rigid_labels=names,
    )


def _rigid_motions(
    assembly: Assembly, Z: Real, folds: tuple[float, ...]
) -> tuple[Real, tuple[str, ...]]:
    """Return an orthonormal basis of the motions in the null space Z that strain nothing.

    Those of an aircraft come first, with their names. Besides, only a free hinge allows any.
    """
    aircraft = assembly.wing.aircraft is not None
    if not aircraft and all(hinge.kind is not HingeKind.FREE for hinge in assembly.wing.hinges):
        return np.zeros((Z.shape[1], 0)), ()
    basis = null_space(assembly.strains @ Z, scaled=False).basis
    if not aircraft:
        return basis, ()
    still = StructuralModes(assembly, folds, np.zeros(basis.shape[1]), Z @ basis)
    whole, size = np.linalg.qr(_as_a_whole(still))
    whole *= np.sign(np.diagonal(size))
    others = null_space(whole.T).basis
    return basis @ np.hstack([whole, others]), AIRCRAFT_MOTIONS


def _as_a_whole(still: StructuralModes) -> Real:
    """Return how the motions that strain nothing combine to those of a rigid aircraft, (r, 3).

    Translation aft and up, and nose-up pitch about the root's elastic axis. Made orthogonal to the
    translations, the last is pitch about the centre of gravity.
    """
    moved, wanted = [], []
    for index, segment in enumerate(still.assembly.wing.segments):
        x, y = segment.outline.array.T
        at, zero = still.position(index, x, y), np.zeros(len(x))
        unit = np.broadcast_to(np.eye(3)[:, [0, 2]], (len(x), 3, 2))
        pitch = np.stack([at[:, 2], zero, -at[:, 0]], axis=1)
        wanted.append(np.concatenate([unit, pitch[:, :, None]], axis=2).reshape(-1, 3))
        moved.append(still.displacement(index, x, y).reshape(-1, still.count))
    return np.asarray(np.linalg.lstsq(np.vstack(moved), np.vstack(wanted), rcond=None)[0])


def _elastic_modes(K: Real, rigid: Real, wanted: int) -> tuple[Real, Real]:
    """Return omega^2, ascending, and vectors of the modes orthogonal to the rigid motions."""
    count = max(min(wanted, len(K)) - rigid.shape[1], 1)
    if rigid.shape[1] == 0:
        values, vectors = scipy.linalg.eigh(
            K, subset_by_index=(0, count - 1), check_finite=False, driver="evr"
        )
        return values, vectors
    elastic = null_space(rigid.T).basis
    values, vectors = np.linalg.eigh(elastic.T @ K @ elastic)
    return values[:count], elastic @ vectors[:, :count]


def _signed(modes: Real) -> Real:
    """Fix the arbitrary sign: the largest coordinate of each mode is positive."""
    largest = np.argmax(np.abs(modes), axis=0)
    signs = np.sign(modes[largest, np.arange(modes.shape[1])])
    return np.asarray(modes * np.where(signs == 0.0, 1.0, signs))
