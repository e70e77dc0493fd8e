"""Where the contact points of a recording are, and what its soles reach."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .recording import Recording, Sole

SPACING = 0.25  # between its tips one place of a sole stands for those around it [lengths of the sole]
BLOCK = 4096  # samples looked at together


def point_places(gait: Recording) -> np.ndarray:
    """World positions of the contact points (K, T, 3)."""
    return moved_points(gait.pose[gait.point_part], gait.point)


def moved_points(pose: np.ndarray, point: np.ndarray) -> np.ndarray:
    """World positions (k, n, 3) of points (k, 3) of parts at poses (k, n, 7)."""
    u, w = pose[..., 4:], pose[..., 3:4]
    p = np.broadcast_to(point[:, None], u.shape)
    t = 2.0 * np.cross(u, p)
    return np.asarray(pose[..., :3] + p + w * t + np.cross(u, t))


def _tips(sole: Sole) -> np.ndarray:
    """Places (n, 3) of a sole that tell where it lies: its tips in 26 directions, and some between them."""
    corners: np.ndarray = sole.vertices[np.unique(sole.triangles)].astype(float)
    if not len(corners):
        return corners
    directions = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    tips = corners[(corners @ directions[directions.any(axis=1)].T).argmax(axis=0)]
    every = np.concatenate([corners, sole.vertices[sole.triangles].astype(float).mean(axis=1)])
    size = max(SPACING * float(np.ptp(corners, axis=0).max()), 1e-30)
    number = np.floor((every - corners.min(axis=0)) / size)
    _, first = np.unique(number, axis=0, return_index=True)
    return np.asarray(np.unique(np.concatenate([tips, every[first]]), axis=0))


def below_sole(sole: Sole, pose: np.ndarray, at: np.ndarray, land: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Height of the ground under points (k, n, 3) of a part that lie beside it, where its sole at poses (n, 7) reaches
    over it: that at the nearest of such places (k, n) [m]; NaN where none does.

    land: heights at places (m, 2), NaN where there is no ground.
    """
    found = np.full(at.shape[:2], np.nan)
    tips = _tips(sole)
    for first in range(0, pose.shape[0] if len(tips) else 0, BLOCK):
        span = slice(first, first + BLOCK)
        places = moved_points(np.broadcast_to(pose[span], (len(tips), *pose[span].shape)), tips)[..., :2]
        height = np.asarray(land(np.ascontiguousarray(places.reshape(-1, 2))), float).reshape(places.shape[:2])
        there = np.isfinite(height)
        if not there.any():
            continue
        for row, point in zip(found[:, span], at[:, span, :2]):
            away = np.where(there, ((places - point) ** 2).sum(axis=-1), np.inf)
            row[:] = np.take_along_axis(height, away.argmin(axis=0)[None], axis=0)[0]
    return found
