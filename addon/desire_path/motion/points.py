"""Where the contact points of a recording are."""

import numpy as np


def point_places(gait):
    """World positions of the contact points (K, T, 3)."""
    pose = gait.pose[gait.point_part]
    u, w = pose[..., 4:], pose[..., 3:4]
    p = np.broadcast_to(gait.point[:, None], u.shape)
    t = 2.0 * np.cross(u, p)
    return pose[..., :3] + p + w * t + np.cross(u, t)
