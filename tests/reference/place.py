"""Slow literal twin of foot placement: TRAIL (1) (2), with matrices, one foot of two parts on a plane."""

import math

import numpy as np


def matrix(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def about(axis, angle):
    """Rodrigues."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def slerp(a, b, w):
    """From rotation a to b: a part w of the one turn that takes a to b."""
    between = b @ a.T
    angle = math.acos(min(max((np.trace(between) - 1) / 2, -1.0), 1.0))
    if angle < 1e-9:
        return a.copy()
    axis = np.array([between[2, 1] - between[1, 2], between[0, 2] - between[2, 0], between[1, 0] - between[0, 1]])
    return about(axis / np.linalg.norm(axis), w * angle) @ a


def on_ground(normal, left):
    """Orthogonal to the ground, facing the same way as seen from above."""
    ahead = np.cross(left, (0, 0, 1.0))
    ahead[2] = -(normal[0] * ahead[0] + normal[1] * ahead[1]) / normal[2]
    ahead /= np.linalg.norm(ahead)
    return np.stack([ahead, np.cross(normal, ahead), normal], axis=1)


def turn(q_kin, d, normal, d_max, theta_0, heel, flat):
    """The part's rotation matrix on a slope of this normal; d: clearance of its tip."""
    kin = matrix(q_kin)
    left = kin[:, 1] * (1, 1, 0)
    left /= np.linalg.norm(left)
    perp = on_ground(normal, left)
    if not flat:  # the roll over the floor is kept
        perp = perp @ on_ground(np.array([0, 0, 1.0]), left).T @ kin
    w = min(max(1 - d / d_max, 0.0), 1.0)  # TRAIL (1)
    q = slerp(kin, perp, w)  # TRAIL (1)
    slope = on_ground(normal, left)
    theta = math.asin(slope[2, 0])
    if heel and theta > theta_0:
        toe_up = 0.0 if flat else max(math.asin(kin[2, 0]), 0.0)
        q = about(slope[:, 1], w * (theta - theta_0 + toe_up * min(theta / theta_0 - 1, 1))) @ q  # TRAIL (2)
    return q


def place(pose, points, d, height, normal, *, floor, d_max, theta_0, flat):
    """(heel, toe) as ((3,) place, (3, 3) turn), carried from a floor at this height.

    pose: (2, 7) of heel and toe; points: for each part its contact points (n, 3); d: clearance of each tip;
    height: function of x and y.
    """
    heel, toe = pose
    ball = toe[:3]
    turns = [turn(part[3:], d[k], normal, d_max, theta_0, k == 0, flat) for k, part in enumerate(pose)]
    at = [ball + turns[0] @ matrix(heel[3:]).T @ (heel[:3] - ball), ball.copy()]
    rise = height(*ball[:2]) - floor
    before = min((part[:3] + matrix(part[3:]) @ p)[2] - floor for part, own in zip(pose, points) for p in own)
    for place_ in at:
        place_[2] += rise
    placed = [a + t @ p for a, t, own in zip(at, turns, points) for p in own]
    lift = min(before, 0.0) - min(p[2] - height(p[0], p[1]) for p in placed)
    for place_ in at:
        place_[2] += max(lift, 0.0)
    return list(zip(at, turns))
