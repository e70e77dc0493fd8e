"""The mesh that shows prints: faces cut along a trail, and all that lies on them interpolated. PEYRAT11 3.2

    final heights --wishes--> how long edges may be where --refine--> Refined: triangles, and shares of the old ones

A mesh comes as its triangles: which points, which corners and which face each one is of, as Blender's loop
triangles. Faces that no wish reaches stay as they are, with all their corners.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..core import Begun, _native, begun
from ..errors import DesirePathError

BLOCK = 4  # cells on the edge of the squares that wishes are for
DEVIATION = 0.05  # of a cell: how far the shown ground may lie from the baked one between its points
MAX_COARSE = 8  # edges within the trail are no longer than this [cells]
MAX_TRIANGLES = 20_000_000


@dataclass(frozen=True, eq=False, repr=False)
class Wishes(Record):
    """How long edges may be in squares of the world."""

    corners: np.ndarray  # least x and y of each, float64 (w, 2) [m]
    sizes: np.ndarray  # how long the legs of a triangle may be there, float64 (w,) [m]
    block: float  # edge of the squares [m]


@dataclass(frozen=True, eq=False, repr=False)
class Triangles(Record):
    """A mesh cut into triangles."""

    points: np.ndarray  # in the world, float64 (n, 3) [m]
    triangles: np.ndarray  # points of each, int32 (t, 3)
    corners: np.ndarray  # corners of the faces they are of, int32 (t, 3)
    faces: np.ndarray  # the face each is of, int32 (t,)
    starts: np.ndarray  # first corner of each face, and how many corners there are, int32 (f + 1,)


@dataclass(frozen=True, eq=False, repr=False)
class Refined(Record):
    """A mesh whose faces were cut: first the faces that were left, in order, then triangles."""

    of: Triangles
    valid: bool  # every wish was met; False: there would have been too many triangles
    kept: np.ndarray  # the faces that were left as they were, int64 (k,)
    triangles: np.ndarray  # points of the new faces, int32 (m, 3)
    source: np.ndarray  # the triangle of the old mesh each one lies in, int32 (m,)
    weight: np.ndarray  # for each of its corners, shares of that triangle's corners, float32 (m, 3, 3)
    point_source: np.ndarray  # the triangle each new point lies in, int32 (p,)
    point_weight: np.ndarray  # shares of its points, float32 (p, 3)

    @property
    def point_count(self) -> int:
        return len(self.of.points) + len(self.point_source)

    @property
    def sizes(self) -> np.ndarray:
        """Corners of each face, int64 (k + m,)."""
        return np.concatenate((np.diff(self.of.starts)[self.kept], np.full(len(self.triangles), 3)))

    def _kept_corners(self) -> np.ndarray:
        """Corners of the faces that were left, in order."""
        is_kept = np.zeros(len(self.of.starts) - 1, bool)
        is_kept[self.kept] = True
        return np.repeat(is_kept, np.diff(self.of.starts))

    def corner_points(self, corner_points: np.ndarray) -> np.ndarray:
        """The point of every corner, from those of the old mesh, int32."""
        return np.concatenate((corner_points[self._kept_corners()], self.triangles.ravel())).astype(np.int32)

    def on_points(self, values: np.ndarray) -> np.ndarray:
        """What points have, (n, ..) -> (n + p, ..): floats by their shares, others as the nearest has it."""
        return np.concatenate((values, _mixed(values, self.of.triangles[self.point_source], self.point_weight)))

    def on_corners(self, values: np.ndarray) -> np.ndarray:
        """What corners of faces have, as `on_points`."""
        of = np.repeat(self.of.corners[self.source], 3, axis=0)
        return np.concatenate((values[self._kept_corners()], _mixed(values, of, self.weight.reshape(-1, 3))))

    def on_faces(self, values: np.ndarray) -> np.ndarray:
        """What faces have."""
        return values[np.concatenate((self.kept, self.of.faces[self.source]))]

    def on_edges(self, values: np.ndarray, old: np.ndarray, new: np.ndarray) -> np.ndarray:
        """What edges have, zero on those that did not lie on one; old, new: points of the edges (e, 2)."""
        at = self._edges(old, new)
        out = np.zeros((len(new),) + values.shape[1:], values.dtype)
        out[at >= 0] = values[at[at >= 0]]
        return out

    def _edges(self, old: np.ndarray, new: np.ndarray) -> np.ndarray:
        """The old edge each new one lies on, or -1."""
        found = _look_up(_key(*new.T), _key(*old.T))
        # sides of new triangles both of whose ends have no share of one corner lie on the side across from it
        none = self.weight == 0.0  # (m, corner, share)
        along = none & np.roll(none, -1, axis=1)
        rows, sides = np.nonzero(along.any(axis=2))
        across = along[rows, sides].argmax(axis=1)
        of = self.of.triangles[self.source[rows]]
        lie_on = _look_up(
            _key(of[np.arange(len(of)), (across + 1) % 3], of[np.arange(len(of)), (across + 2) % 3]), _key(*old.T)
        )
        here = _look_up(_key(self.triangles[rows, sides], self.triangles[rows, (sides + 1) % 3]), _key(*new.T))
        good = (lie_on >= 0) & (here >= 0)
        found[here[good]] = lie_on[good]
        return found


def _mixed(values: np.ndarray, of: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Values of three corners by their shares; of: their numbers (m, 3)."""
    if values.dtype.kind != "f":
        return values[of[np.arange(len(of)), share.argmax(axis=1)]]
    share = share.reshape(share.shape + (1,) * (values.ndim - 1))
    return sum(values[of[:, k]] * share[:, k] for k in range(3)).astype(values.dtype)


def _key(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.minimum(a, b).astype(np.int64) << 32 | np.maximum(a, b).astype(np.int64)


def _look_up(keys: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Where keys are among others, or -1."""
    if not len(among):
        return np.full(len(keys), -1)
    order = np.argsort(among)
    at = order[np.searchsorted(among, keys, sorter=order).clip(0, len(among) - 1)]
    return np.where(among[at] == keys, at, -1)


def wishes(
    height: np.ndarray,
    changed: np.ndarray,
    cell: float,
    corner: tuple,
    size: float = 0.0,
    detail: tuple[np.ndarray, np.ndarray | float] | None = None,
) -> Wishes:
    """What a trail asks of the mesh that shows it: edges so short that nowhere the shown ground lies more than
    DEVIATION cells from the baked one, but none shorter than `size`.

    height: of the ground over the one before the walk, float (ny, nx) [m]; changed: where anything is to be seen,
    bool (ny, nx); corner: of cell (0, 0) (x, y) [m]; size: shortest edge [m], 0 = a cell; detail: where something finer
    than a cell is to be seen, bool (ny, nx), and how long edges are there, a number or (ny, nx) [m]
    """
    finest = size if size > 0.0 else cell
    bend = _bend(height)
    with np.errstate(divide="ignore"):
        wanted = np.minimum(cell * np.sqrt(8.0 * DEVIATION * cell / bend), MAX_COARSE * cell)
    wanted = np.where(_around(changed), np.maximum(wanted, finest), np.inf)
    if detail is not None:
        wanted = np.where(detail[0], np.minimum(wanted, detail[1]), wanted)
    ny, nx = height.shape
    rows, columns = -(-ny // BLOCK), -(-nx // BLOCK)
    tiles = np.full((rows * BLOCK, columns * BLOCK), np.inf)
    tiles[:ny, :nx] = wanted
    least = tiles.reshape(rows, BLOCK, columns, BLOCK).min(axis=(1, 3))
    j, i = np.nonzero(np.isfinite(least))
    corners = np.stack((i, j), axis=1) * (BLOCK * cell) + np.asarray(corner, np.float64)
    return Wishes(corners, least[j, i], BLOCK * cell)


def _around(mask: np.ndarray) -> np.ndarray:
    """Cells of a mask and their eight neighbours."""
    wide = np.pad(mask, 1)
    wide = wide[:-2] | wide[1:-1] | wide[2:]
    return wide[:, :-2] | wide[:, 1:-1] | wide[:, 2:]


def _bend(height: np.ndarray) -> np.ndarray:
    """How much heights bend from cell to cell, the largest second difference of a cell and its neighbours [m]."""
    wide = np.pad(np.asarray(height, np.float64), 1, mode="edge")
    mid = wide[1:-1, 1:-1]
    bend = np.maximum(
        np.abs(wide[1:-1, 2:] + wide[1:-1, :-2] - 2.0 * mid), np.abs(wide[2:, 1:-1] + wide[:-2, 1:-1] - 2.0 * mid)
    )
    bend = np.maximum(bend, 0.25 * np.abs(wide[2:, 2:] + wide[:-2, :-2] - wide[2:, :-2] - wide[:-2, 2:]))
    wide = np.pad(bend, 1)
    wide = np.maximum(np.maximum(wide[:-2], wide[1:-1]), wide[2:])
    return np.maximum(np.maximum(wide[:, :-2], wide[:, 1:-1]), wide[:, 2:])


def refine(mesh: Triangles, wanted: Wishes, max_triangles: int = MAX_TRIANGLES) -> Refined:
    """Cut the triangles of a mesh until no edge is longer than is wished for where it is, without gaps.

    Raises DesirePathError where a point is not finite.
    """
    if not np.isfinite(mesh.points).all():
        bad = int(np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))[0])
        raise DesirePathError(f"Vertex {bad} is NaN or infinite: move or remove it in Edit Mode.")
    valid, *blocks = _native.refine(
        np.ascontiguousarray(mesh.points, np.float64),
        np.ascontiguousarray(mesh.triangles, np.int32),
        wanted.corners,
        wanted.sizes,
        wanted.block,
        max_triangles,
    )
    kinds = (np.float64, np.int32, np.float32, np.int32, np.int32, np.float32, np.uint8)
    _, point_source, point_weight, triangles, source, weight, cut = (
        np.frombuffer(block, kind) for block, kind in zip(blocks, kinds)
    )
    touched = np.zeros(len(mesh.starts) - 1, bool)
    touched[mesh.faces[cut != 0]] = True
    new = touched[mesh.faces[source]]
    return Refined(
        mesh,
        valid,
        np.flatnonzero(~touched),
        triangles.reshape(-1, 3)[new],
        source[new],
        weight.reshape(-1, 3, 3)[new],
        point_source,
        point_weight.reshape(-1, 3),
    )


def begin(mesh: Triangles, wanted: Wishes) -> Begun[Refined]:
    """Begin refine() beside what goes on: done() tells whether it is through, result() waits for what it returns."""
    return begun(refine, mesh, wanted)
