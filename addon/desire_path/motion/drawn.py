"""Poses that are held for a few frames each, as in an animation on twos, stand for a motion. MODEL 3.4

    matrices with poses that are held ---moving---> the motion they are drawn from

Eyes take such poses for motion, and the ground has to: a body that stops and goes on twelve times a second would strike
it as often. A pose that is held longer is a hold and stays one, see freeze.
"""

from __future__ import annotations

import numpy as np

from ..core import _native
from . import rotation

SAME = 1e-7  # entries of matrices that differ by no more are of one pose [m, -]
HELD = 0.2  # poses of an animation are held no longer than this: five frames of 24 a second [s]
MIN_POSES = 4  # from fewer nothing is told
SHARE = 0.7  # of the poses that are held no longer, so many are held for more than a sample


def moving(time: np.ndarray, matrix: np.ndarray, cut: list[int]) -> tuple[np.ndarray, float]:
    """(matrices of the motion that poses are drawn from, how long each is held [s]); the same and 0 where they are not.

    time (T,) [s], even; matrix (T, B, 4, 4): turns and places; cut: the first sample of each piece but the first.
    """
    found, held = matrix, list[float]()
    for first, after in zip([0, *cut], [*cut, len(time)]):
        new = _poses(matrix[first:after])
        usual = _usual(np.diff(time[first:after][new]), np.diff(new))
        if not usual:
            continue
        found = matrix.copy() if found is matrix else found
        step = float(time[first + 1] - time[first])
        found[first:after] = _between(matrix[first:after], _telling(step, after - first, new, usual), usual)
        held.append(usual * step)
    return found, float(np.median(held)) if held else 0.0


def _poses(matrix: np.ndarray) -> np.ndarray:
    """The samples at which a pose begins."""
    moved = abs(np.diff(matrix, axis=0)).max(axis=(1, 2, 3), initial=0.0) > SAME
    return np.concatenate([[0], np.flatnonzero(moved) + 1])


def _usual(lasts: np.ndarray, samples: np.ndarray) -> int:
    """How many samples a pose usually is held, 0 where it is for one, or too long."""
    short = samples[lasts < HELD + 1e-6]
    if len(short) < MIN_POSES or np.mean(short > 1) < SHARE:
        return 0
    return int(np.median(short))


def _telling(step: float, count: int, new: np.ndarray, usual: int) -> np.ndarray:
    """Samples (of `count`, a step [s] apart) that tell of the motion: those at which poses begin, and all of a hold up
    to its last pose."""
    tells = [new]
    for a, b in zip(new, np.append(new[1:], count)):
        if (b - a) * step > HELD + 1e-6:
            tells.append(np.arange(a, b if b == count else max(b - usual, a) + 1))
    return np.unique(np.concatenate(tells))


def _between(matrix: np.ndarray, tells: np.ndarray, usual: int) -> np.ndarray:
    """Matrices (T, B, 4, 4) through those that tell. A pose that was begun before the first sample did so in its time,
    and the last one goes on as it came."""
    count, bones = matrix.shape[:2]
    pose = np.concatenate([matrix[tells][..., :3, 3], rotation.quaternion(matrix[tells][..., :3, :3])], axis=-1)
    at = tells.astype(float)
    at[0] = min(at[0], at[1] - usual) if at[1] < usual else at[0]
    if tells[-1] < count - 1:
        ahead = _ahead(pose[-2], pose[-1], (count - 1 - at[-1]) / (at[-1] - at[-2]))
        pose, at = np.concatenate([pose, ahead[None]]), np.append(at, count - 1.0)
    early = round(-at[0])
    out = np.empty((bones, count + early, 7))
    places, times = np.zeros((1, len(at), 3)), np.empty(count + early)
    _native.resample(
        at, places, np.ascontiguousarray(pose.swapaxes(0, 1)), 1.0, times, np.empty((1, count + early, 3)), out
    )
    found = matrix.copy()
    found[..., :3, 3] = out[:, early:, :3].swapaxes(0, 1)
    found[..., :3, :3] = rotation.matrix(out[:, early:, 3:]).swapaxes(0, 1)
    same = tells if not early else tells[1:]
    found[same] = matrix[same]
    return found


def _ahead(before: np.ndarray, last: np.ndarray, share: float) -> np.ndarray:
    """Poses (B, 7) that go on from the last ones by a share of the way from those before."""
    step = rotation.product(rotation.inverse(before[:, 3:]), last[:, 3:])
    step = np.where(step[:, :1] < 0.0, -step, step)
    sine = np.linalg.norm(step[:, 1:], axis=1, keepdims=True)
    half = np.arctan2(sine, step[:, :1]) * share
    turn = np.concatenate([np.cos(half), np.sin(half) * step[:, 1:] / np.maximum(sine, 1e-12)], axis=1)
    place = last[:, :3] + share * (last[:, :3] - before[:, :3])
    return np.concatenate([place, rotation.product(last[:, 3:], turn)], axis=1)


def sentences(name: str, frames: float) -> list[str]:
    """What is told of poses that are held for so many frames; of those that are looked at between frames, nothing."""
    if frames < 1.5:
        return []
    return [f"Poses of {name} are held for {frames:.3g} frames each: prints are those of the motion between them."]
