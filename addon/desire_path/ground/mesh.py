"""Meshes of other programs: what of them lies near a walk, and what maps say at their points.

A mesh comes as arrays: points in its own space, float32 (n, 3); corners, int32 (c,), the point of every
corner, face by face. A place is the map from its own space to the world, float64 (3, 4) [m].
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Record
from ..core import _native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False, repr=False)
class Near(Record):
    """The triangles near a walk, and the points they need."""

    low: tuple[float, float, float]  # of all points of the mesh, in its own space
    high: tuple[float, float, float]
    bad: int  # first point that is not finite, else -1; there is nothing more if there is one
    vertices: np.ndarray  # float64 (k, 3) [m]
    triangles: np.ndarray  # int32 (m, 3)
    of: np.ndarray  # int32 (k,): their numbers among all points


def mark(arrays: Iterable[np.ndarray], words: object = ()) -> str:
    """A word for arrays, and for numbers and words in lists or by name: another one when any of them differs.

    What float64 arrays hold was calculated, by other machines and NumPys with other last digits: 1e-6 counts.
    """
    digest = hashlib.sha256(json.dumps(words, sort_keys=True, default=float).encode())
    for array in arrays:
        if array.dtype == np.float64:
            array = np.round(array, 6) + 0.0  # no -0
        digest.update(f"{array.shape} {array.dtype}".encode())
        digest.update(_native.digest(np.ascontiguousarray(array)))
    return digest.hexdigest()[:32]


def near(
    points: np.ndarray,
    corners: np.ndarray,
    starts: np.ndarray | None,
    sides: int,
    place: np.ndarray,
    box: Sequence[float] | np.ndarray | None = None,
) -> Near:
    """Cut the faces of 3 or 4 corners that reach into a box (x0, y0, x1, y1) [m] into triangles.

    starts: int32 (f + 1,), first corner of each face, or None where each has `sides`
    """
    box = None if box is None else np.array(box, np.float64)
    place = np.ascontiguousarray(place, np.float64)
    low, high, bad, *blocks = _native.mesh_cut(points, corners, starts, sides, place, box)
    vertices, triangles, of = (
        np.frombuffer(block, kind) if block is not None else np.zeros(0, kind)
        for block, kind in zip(blocks, (np.float64, np.int32, np.int32))
    )
    return Near(low, high, bad, vertices.reshape(-1, 3), triangles.reshape(-1, 3), of)


def are_quads(corners: np.ndarray, corner_edges: np.ndarray, edges: np.ndarray) -> bool:
    """Whether faces are quads alone, told by the edge from each corner to the next one, int32 (c,), and
    the points of the edges, int32 (e, 2)."""
    return _native.are_quads(corners, corner_edges, edges)


def are_centres(vertices: ArrayLike, cell: float, corner: tuple[float, float], max_away: float) -> bool:
    """Whether all world points (n, 3) [m] lie within `max_away` cells of the centres of the cells they lie in."""
    return _native.are_centres(np.ascontiguousarray(vertices, np.float64), cell, *corner, max_away)


def at_points(
    planes: Mapping[str, np.ndarray],
    cell: float,
    corner: tuple[float, float],
    points: np.ndarray,
    place: np.ndarray | None = None,
    still: float = 0.0,
) -> dict[str, np.ndarray]:
    """What planes of cells say at points, between the centres of cells in proportion, 0 outside.

    planes: dict of name -> float32 (ny, nx); cell: their side [m]; corner: (x0, y0) of cell (0, 0) [m]
    points: float64 (n, 3) in the world, or with a place float32 (n, 3) in their own space
    still: a point this near to a centre lies on it; above 0.5 every point does [cells]
    Returns a dict of name -> float32 (n,).
    """
    out = np.zeros((len(planes), len(points)), np.float32)
    place = None if place is None else np.ascontiguousarray(place, np.float64)
    if planes:
        grids = [np.ascontiguousarray(plane, np.float32) for plane in planes.values()]
        _native.planes_at(grids, *corner, cell, still, points, place, out)
    return dict(zip(planes, out))
