"""A leg of two bones that reaches for a foot: hip, knee and ankle over time, in any unit of length.

ankle -> target: the knee bends in the plane it bent in, the hips come down where legs are too short
"""

from __future__ import annotations

import numpy as np

from ..motion import rotation

STRETCH = 0.995  # legs reach this share of their length, or as far as they did [-]
FORWARD = 0.01  # a knee bends at least so far to its own side, in leg lengths: straight legs bend as others
ELBOW = 0.03  # legs whose middle is this far behind, in leg lengths, bend backward


def length(hip: np.ndarray, knee: np.ndarray, ankle: np.ndarray) -> np.ndarray:
    """Of a leg (T,)."""
    return np.asarray(np.linalg.norm(knee - hip, axis=1) + np.linalg.norm(ankle - knee, axis=1))


def drop(hip: np.ndarray, knee: np.ndarray, ankle: np.ndarray, target: np.ndarray) -> np.ndarray:
    """How far hips have to come down for the ankle to reach its target (T,) >= 0; +Z is up."""
    longest = np.maximum(STRETCH * length(hip, knee, ankle), np.linalg.norm(ankle - hip, axis=1))
    apart = target - hip
    aside = np.hypot(apart[:, 0], apart[:, 1])
    hang = np.sqrt(np.maximum(longest**2 - aside**2, 0.0))
    return np.asarray(np.maximum(-apart[:, 2] - hang, 0.0))


def eased(down: np.ndarray, frames: float) -> np.ndarray:
    """`down` (T,) never undercut, without jolts: its largest within `frames`, then the mean of those."""
    count = 2 * int(frames) + 1

    def near(values: np.ndarray) -> np.ndarray:
        padded = np.pad(values, int(frames), mode="edge")
        return np.lib.stride_tricks.sliding_window_view(padded, count)

    return np.asarray(near(near(down).max(axis=1)).mean(axis=1))


def turn_between(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The least turns that take unit vectors (T, 3) to others (T, 3, 3)."""
    axis = np.cross(one, other)
    cosine = np.sum(one * other, axis=1)
    cross = np.zeros((len(one), 3, 3))
    for i, j, k, sign in ((0, 1, 2, -1), (0, 2, 1, 1), (1, 2, 0, -1)):
        cross[:, i, j], cross[:, j, i] = sign * axis[:, k], -sign * axis[:, k]
    return np.asarray(np.eye(3) + cross + cross @ cross / np.maximum(1.0 + cosine, 1e-9)[:, None, None])


def reach(
    hip: np.ndarray, knee: np.ndarray, ankle: np.ndarray, target: np.ndarray, ahead: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Turns of thigh and shank (T, 3, 3) each, and where the knee comes to be (T, 3).

    ahead (T, 3): where the foot points, for legs too straight to say where their knee bends.
    """
    upper, lower = np.linalg.norm(knee - hip, axis=1), np.linalg.norm(ankle - knee, axis=1)
    full = upper + lower
    line, wanted = rotation.unit(ankle - hip), rotation.unit(target - hip)
    far = np.clip(np.linalg.norm(target - hip, axis=1), abs(upper - lower) + 1e-6 * full, (1 - 1e-7) * full)

    def across(v: np.ndarray) -> np.ndarray:
        return np.asarray(v - np.sum(v * line, axis=1, keepdims=True) * line)

    pole, side = across(knee - hip), rotation.unit(across(ahead))
    to_side = np.sum(pole * side, axis=1)
    if np.median(to_side / full) < -ELBOW:  # an elbow, or a bird's knee
        side, to_side = -side, -to_side
    pole = pole + np.maximum(FORWARD * full - to_side, 0.0)[:, None] * side
    pole = rotation.unit(pole)

    turned = turn_between(line, wanted)
    new_pole = np.einsum("tij,tj->ti", turned, pole)
    along = (upper**2 + far**2 - lower**2) / (2.0 * far)
    out = np.sqrt(np.maximum(upper**2 - along**2, 0.0))
    new_knee = hip + along[:, None] * wanted + out[:, None] * new_pole
    hinge, new_hinge = np.cross(line, pole), np.cross(wanted, new_pole)
    thigh = _between_frames(knee - hip, hinge, new_knee - hip, new_hinge)
    shank = _between_frames(ankle - knee, hinge, hip + far[:, None] * wanted - new_knee, new_hinge)
    return thigh, shank, new_knee


def _between_frames(along: np.ndarray, hinge: np.ndarray, new_along: np.ndarray, new_hinge: np.ndarray) -> np.ndarray:

    def frame(a: np.ndarray, h: np.ndarray) -> np.ndarray:  # z along the bone, x near the hinge
        return rotation.frame(h, a)

    return np.asarray(frame(new_along, new_hinge) @ np.swapaxes(frame(along, hinge), 1, 2))
