"""Small tools for rotations as matrices (.., 3, 3) and for rates over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def quaternion(turn: np.ndarray) -> np.ndarray:
    """Unit quaternions (n, 4) w x y z of rotation matrices (n, 3, 3), each near the one before."""
    m = np.asarray(turn, float)
    four = np.empty(m.shape[:-2] + (4, 4))  # 4 q q^T, the largest column is safe to divide by
    xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    four[..., 0, 0] = 1 + xx + yy + zz
    four[..., 1, 1] = 1 + xx - yy - zz
    four[..., 2, 2] = 1 - xx + yy - zz
    four[..., 3, 3] = 1 - xx - yy + zz
    for a, b, value in (
        (0, 1, m[..., 2, 1] - m[..., 1, 2]),
        (0, 2, m[..., 0, 2] - m[..., 2, 0]),
        (0, 3, m[..., 1, 0] - m[..., 0, 1]),
        (1, 2, m[..., 1, 0] + m[..., 0, 1]),
        (1, 3, m[..., 0, 2] + m[..., 2, 0]),
        (2, 3, m[..., 2, 1] + m[..., 1, 2]),
    ):
        four[..., a, b] = four[..., b, a] = value
    best = np.einsum("...ii->...i", four).argmax(axis=-1)
    q = np.take_along_axis(four, best[..., None, None], axis=-1)[..., 0]
    q /= np.linalg.norm(q, axis=-1, keepdims=True)
    if q.ndim == 2 and len(q) > 1:
        flips = np.cumprod(np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1.0, 1.0))
        q[1:] *= flips[:, None]
    return q


def matrix(q: ArrayLike) -> np.ndarray:
    """Rotation matrices (.., 3, 3) of unit quaternions (.., 4) w x y z."""
    w, x, y, z = np.moveaxis(np.asarray(q, float), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def unit(v: np.ndarray) -> np.ndarray:
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12))


def square(turn: np.ndarray) -> np.ndarray:
    """The rotation nearest to a matrix, so that leftover shear or scale does no harm."""
    u, _, vt = np.linalg.svd(turn)
    flip = np.ones(turn.shape[:-2] + (3,))
    flip[..., 2] = np.sign(np.linalg.det(u @ vt))
    return np.asarray((u * flip[..., None, :]) @ vt)


def mean_turn(turns: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """The mean of rotations by their weights (T,), counting those far from it for little."""
    mean = square(np.average(turns, axis=0, weights=weight))
    for _ in range(4):
        apart = np.sqrt(np.maximum(3.0 - np.einsum("tij,ij->t", turns, mean), 0.0))  # the angle, if small
        near = weight / np.maximum(apart, 0.01)
        mean = square(np.einsum("t,tij->ij", near, turns) / near.sum())
    return mean


def frame(forward: np.ndarray, up: ArrayLike) -> np.ndarray:
    """Rotation with x along `forward` across `up`, z along `up`."""
    z = unit(np.asarray(up, float))
    x = unit(forward - (forward * z).sum(axis=-1, keepdims=True) * z)
    return np.stack([x, np.cross(z, x), np.broadcast_to(z, x.shape)], axis=-1)


def rate_of(values: np.ndarray, time: np.ndarray, cut: Sequence[int] = ()) -> np.ndarray:
    """Change a second along the first axis; over a cut, before the first sample of a new piece, nothing changes."""
    out = np.zeros(np.shape(values))
    for first, after in zip([0, *cut], [*cut, len(time)]):
        if after - first > 1:
            out[first:after] = np.gradient(values[first:after], time[first:after], axis=0)
    return out


def product(a: ArrayLike, b: ArrayLike) -> np.ndarray:
    """Unit quaternions (.., 4) w x y z that turn by b, then by a."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a, float), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b, float), -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def inverse(q: ArrayLike) -> np.ndarray:
    """The turn back."""
    return np.asarray(q, float) * (1.0, -1.0, -1.0, -1.0)


def about_z(angle: ArrayLike) -> np.ndarray:
    """Unit quaternions (.., 4) of turns about +Z [rad]."""
    half = 0.5 * np.asarray(angle, float)
    zero = np.zeros_like(half)
    return np.stack([np.cos(half), zero, zero, np.sin(half)], axis=-1)


def turned(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Vectors (.., 3) turned by unit quaternions (.., 4)."""
    u, w = q[..., 1:], q[..., :1]
    t = 2.0 * np.cross(u, v)
    return v + w * t + np.cross(u, t)
