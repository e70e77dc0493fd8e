"""Wheels as meshes: a closed drum whose rim carries a tread. Ours, for looks. MODEL 3.8

The axle lies along y through the origin, lugs reach out to the radius.
"""

from __future__ import annotations

import numpy as np

from ..errors import DesirePathError
from ..rig.sole import Faces

TYRES = ("plain", "blocks", "bars")  # smooth | rows of blocks, as on roads | bars that meet, as of a tractor
ACROSS = 25  # points from side to side
STEP = 0.008  # points of a tread lie so far apart along the rim, about [m] ..
MAX_POINTS = 720  # .. but no more of them than this
DEEP = 0.06  # of the width: how far grooves stand back ..
DEEPEST = 0.03  # .. at most, in shares of the radius
SHOULDER = 0.12  # of the width: the rim rounds off so near to its sides
ROUND = 180  # points round a drum
TOUCHES = 72  # points all round that may touch
LARGEST = 100.0  # a wheel's radius may be [m]


def check(tread: str) -> str:
    """The name of a wheel's tread, if there is such a one."""
    if tread not in TYRES:
        raise DesirePathError(f"There is no tread '{str(tread)[:40]}' for wheels: choose one of {', '.join(TYRES)}.")
    return tread


def _grooved(tread: str, along: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Where it is groove. along: in pitches, round the rim; across: -1 to 1, from side to side."""
    if tread == "blocks":
        row = np.floor((across + 1.0) * 2.0)  # four rows, every other one half a pitch ahead
        slit = abs(np.mod((across + 1.0) * 2.0 + 0.5, 1.0) - 0.5) < 0.12
        return np.asarray((np.mod(along + 0.5 * row, 1.0) > 0.72) | slit)
    if tread == "bars":
        ahead = np.mod(along + 0.7 * abs(across) + np.where(across > 0.0, 0.5, 0.0), 1.0)
        return np.asarray((ahead > 0.42) & (abs(across) > 0.08))
    return np.zeros(np.broadcast(along, across).shape, bool)


def wheel(radius: float, width: float, tread: str = "plain") -> Faces:
    """Vertices (V, 3) [m] and triangles (F, 3), seen counter-clockwise from outside. radius, width: > 0 [m]"""
    check(tread)
    for name, size in (("radius", radius), ("width", width)):
        if not 0.0 < size <= LARGEST:
            raise DesirePathError(
                f"A wheel with a {name} of {size:g} m cannot roll: give one above 0 and up to {LARGEST:g} m."
            )
    around = 2.0 * np.pi * radius
    pitches = max(int(round(around / (0.45 * width if tread == "bars" else 0.22 * width))), 3)
    count = 120 if tread == "plain" else int(np.clip(np.ceil(around / STEP), 120, MAX_POINTS))
    share = np.arange(count) / count
    across = np.linspace(-1.0, 1.0, 9 if tread == "plain" else ACROSS)
    groove = _grooved(tread, share[:, None] * pitches, across[None])
    deep = min(DEEP * width, DEEPEST * radius)
    from_side = np.clip((1.0 - abs(across)) / (2.0 * SHOULDER), 0.0, 1.0)
    rounded = deep * (1.0 - np.sqrt(1.0 - (1.0 - from_side) ** 2))
    out = radius - np.maximum(groove * deep, rounded[None])
    angle = 2.0 * np.pi * share[:, None]
    rim = np.stack(
        [out * np.sin(angle), np.broadcast_to(across * width / 2.0, out.shape), out * np.cos(angle)], axis=-1
    )
    return _closed(rim, width)


def touching(vertices: np.ndarray) -> np.ndarray:
    """The points a wheel can touch with (K, 3): to both sides of its tread, every 5 degrees."""
    across, out = _profile(vertices)
    angle = np.arange(TOUCHES)[:, None] * (2.0 * np.pi / TOUCHES)
    flat = np.flatnonzero(out > out.max() - 1e-3 * float(np.ptp(across)))[[0, -1]]
    rim = [out[flat] * np.sin(angle), np.broadcast_to(across[flat], (TOUCHES, 2)), out[flat] * np.cos(angle)]
    return np.stack(rim, axis=-1).reshape(-1, 3)


def drum(vertices: np.ndarray) -> Faces:
    """What a wheel would be without grooves: round, as wide, and as large at each place across its tyre."""
    across, out = _profile(vertices)
    angle = 2.0 * np.pi * np.arange(ROUND)[:, None] / ROUND
    rim = [out * np.sin(angle), np.broadcast_to(across, (ROUND, len(across))), out * np.cos(angle)]
    return _closed(np.stack(rim, axis=-1), float(np.ptp(across)))


def _profile(vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places across a tyre, and how far it reaches out at each (n,) [m]."""
    across, column = np.unique(np.round(vertices[:, 1], 6), return_inverse=True)
    out = np.zeros(len(across))
    np.maximum.at(out, column.reshape(-1), np.hypot(vertices[:, 0], vertices[:, 2]))
    return across, out


def _closed(rim: np.ndarray, width: float) -> Faces:
    """A rim (round, across, 3) with its two sides."""
    count, n = rim.shape[:2]
    vertices = np.concatenate([rim.reshape(-1, 3), [(0.0, -width / 2.0, 0.0), (0.0, width / 2.0, 0.0)]])
    k, after = np.arange(count) * n, np.roll(np.arange(count), -1) * n
    faces = []
    for j in range(n - 1):
        faces.append(np.stack([k + j, after + j, k + j + 1], axis=1))
        faces.append(np.stack([after + j, after + j + 1, k + j + 1], axis=1))
    faces.append(np.stack([after, k, np.full(count, count * n)], axis=1))
    faces.append(np.stack([k + n - 1, after + n - 1, np.full(count, count * n + 1)], axis=1))
    return vertices, np.concatenate(faces).astype("i4")
