"""Where the contact points of a recording are."""

from __future__ import annotations

import numpy as np

from .recording import Recording


def point_places(gait: Recording) -> np.ndarray:
    """World positions of the contact points (K, T, 3)."""
    pose = gait.pose[gait.point_part]
    u, w = pose[..., 4:], pose[..., 3:4]
    p = np.broadcast_to(gait.point[:, None], u.shape)
    t = 2.0 * np.cross(u, p)
    return np.asarray(pose[..., :3] + p + w * t + np.cross(u, t))
