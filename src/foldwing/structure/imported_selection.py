"""Which modes of a mode set a segment takes, and from which points their surfaces are made."""

from dataclasses import dataclass

import numpy as np

from foldwing.errors import InputError
from foldwing.maths.arrays import Indices, Mask, Real
from foldwing.structure.component import Root
from foldwing.structure.mode_files import ModeSet

RIGID = 0.05
"""Part of a shape, in the root mean square, that no rigid motion may describe for it to be one."""

SOFT = 0.02
"""Frequency of a rigid mode, as a share of the first elastic one, that counts as zero."""

MECHANISM = 1e-3
"""Frequency of a mode as a share of the next below which nothing holds it."""

IN_PLANE_SHARE = 0.5
"""Share of the mean square displacement in the plane from which a mode is one of the plane."""

MOST_NODES = 2000
"""Points of a surface: its cost grows with their third power."""

SAME_PLACE = 1e-4
"""Distance in the plane of points that become one, as a share of the extent of all."""


@dataclass(frozen=True, eq=False)
class Selection:
    """Modes of a segment.

    Attributes
    ----------
    modes : array of int, shape (n,)
        Positions in the mode set, by ascending frequency.
    rigid : int
        How many rigid modes of the file are left out.
    warnings : tuple of str
    """

    modes: Indices
    rigid: int
    warnings: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Nodes:
    """Points of a surface.

    Attributes
    ----------
    points : array, shape (k, 2)
    values : array, shape (k, n)
        Displacement out of the plane.
    warnings : tuple of str
    """

    points: Real
    values: Real
    warnings: tuple[str, ...]


def in_plane_shares(modes: ModeSet) -> Real:
    """Return the share of the mean square displacement that lies in the plane, shape (m,)."""
    squares = (modes.shapes**2).sum(axis=1)
    return np.asarray(squares[:, :2].sum(axis=1) / squares.sum(axis=1))


def selected(modes: ModeSet, root: Root, count: int | None) -> Selection:
    """Return the elastic modes out of the plane, the first ``count`` by frequency or all.

    Raises
    ------
    InputError
        When fewer are left, or a mode that is not rigid has no stiffness.
    """
    f, shares = modes.frequencies, in_plane_shares(modes)
    rigid = _rigid_shapes(modes) if root is Root.FREE else np.zeros(modes.count, bool)
    planar = (shares > IN_PLANE_SHARE) & ~rigid
    elastic = np.flatnonzero(~rigid & ~planar)
    elastic = elastic[np.argsort(f[elastic], kind="stable")]
    wanted = len(elastic) if count is None else count
    if not 0 < wanted <= len(elastic):
        limit = (
            f"must be 1 to {len(elastic)}: of {modes.count} modes {int(rigid.sum())} are rigid and "
            f"{int(planar.sum())} move in the plane"
        )
        remedy = "Export more modes, or look whether the placement turns the normal up."
        raise InputError(f"{modes.source}: count of elastic modes", wanted, limit, remedy)
    _check_held(modes, elastic, root)
    texts = []
    if planar.any():
        named = _numbers(np.flatnonzero(planar))
        texts.append(f"modes {named} move mainly in the plane and are left out")
    supported = np.flatnonzero(rigid & (f > SOFT * f[elastic[0]]))
    if len(supported):
        ratio = f[supported].max() / f[elastic[0]]
        texts.append(
            f"modes {_numbers(supported)} are rigid motions on a support, up to {ratio:.2g} of the "
            "first elastic frequency; they are left out and the support with them"
        )
    return Selection(elastic[:wanted], int(rigid.sum()), tuple(texts))


def _rigid_shapes(modes: ModeSet) -> Mask:
    """Tell which shapes are translations and rotations of a rigid body, shape (m,)."""
    p = (modes.points - modes.points.mean(axis=0)) / (modes.size or 1.0)
    basis = np.zeros((len(p), 3, 6))
    basis[:, :, :3] = np.eye(3)
    for axis in range(3):
        basis[:, :, 3 + axis] = np.cross(np.eye(3)[axis], p)
    flat, shapes = basis.reshape(-1, 6), modes.shapes.reshape(modes.count, -1).T
    left = shapes - flat @ np.linalg.lstsq(flat, shapes, rcond=1e-9)[0]
    return np.asarray(np.linalg.norm(left, axis=0) <= RIGID * np.linalg.norm(shapes, axis=0))


def _check_held(modes: ModeSet, elastic: Indices, root: Root) -> None:
    f = modes.frequencies[elastic]
    above = np.append(f[1:], f[-1])
    loose = (f <= MECHANISM * above) | (f == 0.0)
    if loose.any():
        mode = int(elastic[np.argmax(loose)]) + 1
        limit = f"an elastic mode needs more than {MECHANISM:g} of the next frequency"
        remedy = "Look for a mechanism in the structure, or leave the mode out."
        if root is Root.CLAMPED:
            remedy = "A clamped segment has no mode without stiffness: is it one with Root.FREE?"
        value = float(modes.frequencies[mode - 1])
        raise InputError(f"{modes.source}: mode {mode}: frequency in Hz", value, limit, remedy)


def _numbers(indices: Indices) -> str:
    return ", ".join(str(int(i) + 1) for i in indices)


def surface_nodes(modes: ModeSet, chosen: Indices) -> Nodes:
    """Return the points of the surfaces: those in one place joined, and spread when too many."""
    points, values = modes.points[:, :2], modes.shapes[chosen][:, :, 2].T
    points, values, texts = _joined(points, values, max(modes.size, 1e-300))
    if len(points) > MOST_NODES:
        kept = _spread(points, MOST_NODES)
        texts += (f"of {len(points)} points {MOST_NODES}, spread evenly, carry the surface",)
        points, values = points[kept], values[kept]
    return Nodes(points, values, texts)


def _joined(points: Real, values: Real, size: float) -> tuple[Real, Real, tuple[str, ...]]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(SAME_PLACE * size, output_type="ndarray")
    if not len(pairs):
        return points, values, ()
    k = len(points)
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(k, k))
    count, group = connected_components(links, directed=False)
    share = 1.0 / np.bincount(group)
    mean = coo_array((share[group], (group, np.arange(k))), shape=(count, k)).tocsr()
    together = np.asarray(mean @ values)
    apart = np.abs(values - together[group]).max(axis=0) / np.abs(values).max(axis=0)
    text = (
        f"{k} points lie in {count} places of the plane; the mean is taken where several do, and "
        f"they differ from it by up to {apart.max():.1%} of the largest displacement"
    )
    return np.asarray(mean @ points), together, (text,)


def _spread(points: Real, count: int) -> Indices:
    """Return points each as far as can be from those before it."""
    kept = np.zeros(count, np.intp)
    distance = np.linalg.norm(points - points.mean(axis=0), axis=1)
    kept[0] = np.argmax(distance)
    distance = np.full(len(points), np.inf)
    for i in range(1, count):
        distance = np.minimum(distance, ((points - points[kept[i - 1]]) ** 2).sum(axis=1))
        kept[i] = np.argmax(distance)
    return np.sort(kept)
