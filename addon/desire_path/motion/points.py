"""Where the contact points of a recording are."""

from __future__ import annotations

import numpy as np

from .recording import Recording


def point_places(gait: Recording) -> np.ndarray:
    """World positions of the contact points (K, T, 3)."""
    return moved_points(gait.pose[gait.point_part], gait.point)


def moved_points(pose: np.ndarray, point: np.ndarray) -> np.ndarray:
    """World positions (k, n, 3) of points (k, 3) of parts at poses (k, n, 7)."""
    u, w = pose[..., 4:], pose[..., 3:4]
    p = np.broadcast_to(point[:, None], u.shape)
    t = 2.0 * np.cross(u, p)
    return np.asarray(pose[..., :3] + p + w * t + np.cross(u, t))
