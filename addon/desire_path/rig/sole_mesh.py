"""A mesh somebody picked as the sole of every foot: a boot's tread, a hoof, a snowshoe.

mesh in rest space --nearest foot, or centred--> under one foot --mirrored, cut at the ball--> soles
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Record
from ..errors import DesirePathError
from ..motion.gait import Sole
from . import sole
from .sole import Faces

LIKELY = (0.5, 2.5)  # a sole is this many times as long as its foot; else something is scaled wrongly
ASIDE = 0.2  # one that lies at a foot has its middle this near to the ankle's line, in foot lengths
MIN_PART = 0.05  # heel and toe part each get this share of the length at least


@dataclass(frozen=True, eq=False, repr=False)
class Tread(Record):
    """A mesh that is the sole of every foot."""

    vertices: np.ndarray  # in the skeleton's rest space (V, 3) [m]
    triangles: np.ndarray  # (F, 3), seen counter-clockwise from outside
    name: str = "The sole"


@dataclass(frozen=True, eq=False, repr=False)
class Laid(Record):
    """A tread under one foot: x forward, y left; z up from the ankle if it lies at a foot, else from
    its own lowest place."""

    vertices: np.ndarray
    triangles: np.ndarray
    left: bool
    at_foot: bool
    warnings: tuple[str, ...] = ()


def lay(tread: Tread, feet: Sequence[tuple[np.ndarray, float, float, bool]], up: np.ndarray, ahead: np.ndarray) -> Laid:
    """Lay a tread under the foot it lies at in the rest pose, else centred under a left one.

    feet: (rest space to the foot's frame with the ankle at 0 (4, 4), heel x, tip x, is it a left one)
    """
    vertices = np.asarray(tread.vertices, float).reshape(-1, 3)
    triangles = np.asarray(tread.triangles, "i8").reshape(-1, 3)
    if not len(triangles):
        raise DesirePathError(f"{tread.name} has no faces to be a sole: choose a mesh with faces.")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise DesirePathError(f"{tread.name} has a face without its vertices: repair the mesh.")
    used = vertices[np.unique(triangles)]
    if not np.isfinite(used).all():
        raise DesirePathError(f"{tread.name} has NaN or infinite vertices: repair the mesh.")
    best: tuple[float, np.ndarray, bool] | None = None
    for to_foot, heel, tip, left in feet:
        own = used @ to_foot[:3, :3].T + to_foot[:3, 3]
        low, high = own.min(axis=0), own.max(axis=0)
        length = tip - heel
        under = min(high[0], tip) - max(low[0], heel)  # how much of the foot it lies under
        aside = abs(0.5 * (low[1] + high[1]))
        fits = under > 0.5 * length and aside < ASIDE * length and -length < low[2] < 0.0
        if fits and (best is None or aside < best[0]):
            best = (aside, to_foot, left)
    heel, tip = feet[0][1:3]
    if best is not None:
        _, to_foot, left = best
        placed = vertices @ to_foot[:3, :3].T + to_foot[:3, 3]
        keep = placed[triangles, 2].min(axis=1) < 0.0  # a boot's shaft presses nothing
        triangles, warnings = triangles[keep], list[str]()
    else:
        left = True
        turn = np.stack([ahead, np.cross(up, ahead), up])
        placed = vertices @ turn.T
        low, high = (f((used @ turn.T), axis=0) for f in (np.min, np.max))
        middle = 0.5 * (low + high)
        placed = placed - (middle[0] - 0.5 * (heel + tip), middle[1], low[2])
        warnings = [
            f"{tread.name} lies at no foot of the rest pose: it was laid centred under each, its "
            "front the way the walker faces."
        ]
    found = sole.cut(placed, triangles)
    if found is None:
        raise DesirePathError(f"{tread.name} has no faces to be a sole: choose a mesh with faces.")
    placed, triangles = found
    length = float(np.ptp(placed[:, 0]))
    if not LIKELY[0] * (tip - heel) <= length <= LIKELY[1] * (tip - heel):
        warnings.append(f"{tread.name} is {length:.2f} m long under a foot of {tip - heel:.2f} m: check its scale.")
    return Laid(placed, triangles, left, best is not None, tuple(warnings))


def soles(laid: Laid, left: bool, ball: float) -> tuple[tuple[Sole, Sole], float]:
    """((heel part, toe part), how deep the lowest place is under z = 0) for a foot with its ball at
    x = ball; the soles' lowest place is at z = 0."""
    vertices, triangles = laid.vertices.copy(), laid.triangles
    if left != laid.left:
        vertices[:, 1] *= -1.0
        triangles = triangles[:, ::-1]
    floor = float(vertices[:, 2].min())
    vertices[:, 2] -= floor
    low, high = vertices[:, 0].min(), vertices[:, 0].max()
    edge = MIN_PART * (high - low)
    at = float(np.clip(ball, low + edge, high - edge))
    heel, _ = split(vertices, triangles, at)
    lap = sole.OVERLAP * sole.size_of(float(high - low))  # under the heel part, as the built-in sole has it
    _, toe = split(vertices, triangles, at - lap)
    return (Sole(*heel), Sole(toe[0] - (ball, 0.0, 0.0), toe[1])), -floor


def split(vertices: np.ndarray, triangles: np.ndarray, x: float) -> list[Faces]:
    """Cut a mesh by a plane across: what lies behind x, and what lies ahead of it."""
    parts = []
    for sign in (1.0, -1.0):
        beyond = sign * (vertices[triangles, 0] - x)  # above 0: on the other side
        inside = (beyond <= 0.0).all(axis=1)
        corners = [vertices[triangles[inside]]]
        for corner, depth in zip(vertices[triangles], beyond):
            if depth.min() < 0.0 < depth.max():
                corners.append(_clipped(corner, depth))
        points = np.concatenate(corners).reshape(-1, 3)
        unique, packed = np.unique(points, axis=0, return_inverse=True)
        faces = packed.reshape(-1, 3)
        proper = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 0] != faces[:, 2])
        parts.append((unique, faces[proper].astype("i4")))
    return parts


def _clipped(corner: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """The part of a triangle with depth below 0, as triangles (n, 3, 3)."""
    outline = []
    for k in range(3):
        a, b = corner[k], corner[(k + 1) % 3]
        da, db = depth[k], depth[(k + 1) % 3]
        if da <= 0.0:
            outline.append(a)
        if da * db < 0.0:
            outline.append(a + da / (da - db) * (b - a))
    return np.array([(outline[0], outline[k], outline[k + 1]) for k in range(1, len(outline) - 1)])
