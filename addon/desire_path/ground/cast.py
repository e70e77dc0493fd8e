"""A recording as the core takes it: its shape, its loads, and who is there when."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..motion.recording import AUTO, CONTACT_LAWS
from ..motion.tracks import TrackArray

if TYPE_CHECKING:
    from ..loads.force import FootForce
    from ..motion.gait import Gait

ANY = 255  # DP_LAW_ANY in native/base/types.h
HELD = 128  # DP_HELD in native/sim/sim.h, added to what touches


def cast_of(gait: Gait) -> tuple[np.ndarray, ...]:
    """Times, and who walks, as the core takes them."""
    vertices = np.concatenate([sole.vertices for sole in gait.soles]).astype(np.float32)
    triangles = np.concatenate([sole.triangles for sole in gait.soles]).astype(np.int32)
    return (
        np.ascontiguousarray(gait.time),
        np.ascontiguousarray(gait.mass),
        np.ascontiguousarray(gait.limb_walker, np.int32),
        np.ascontiguousarray(gait.part_limb, np.int32),
        np.ascontiguousarray(vertices),
        np.array([len(sole.vertices) for sole in gait.soles], np.int32),
        np.ascontiguousarray(triangles),
        np.array([len(sole.triangles) for sole in gait.soles], np.int32),
    )


def laws_of(gait: Gait) -> np.ndarray | None:
    """DpContactLaw of each walker (W,); None: all press as the simulation says."""
    if not gait.contact_law:
        return None
    return np.array([ANY if law == AUTO else CONTACT_LAWS.index(law) for law in gait.contact_law], np.uint8)


def pressing_of(touching: np.ndarray, held: np.ndarray | None) -> np.ndarray:
    """What the core is told of touching parts; what is carried elsewhere presses nothing."""
    out = (touching == 1).astype(np.uint8)
    if held is not None:
        out[held & (out != 0)] |= HELD
    return np.ascontiguousarray(out)


def tracks_of(
    gait: Gait, loads: FootForce, held: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, ...]]:
    """(walker, first sample, samples) (n, 3) of all who are there, their poses (N, 7), and (touching, force, point)."""
    owner = gait.limb_walker[gait.part_limb]
    table: list[tuple[int, int, int]] = []
    poses: list[np.ndarray] = []
    touching: list[np.ndarray] = []
    force: list[np.ndarray] = []
    point: list[np.ndarray] = []
    assert isinstance(gait.pose, TrackArray)
    for rows, first, values in gait.pose.blocks:
        count = values.shape[1]
        after = first + count
        for walker in np.unique(owner[rows]):
            mine = np.flatnonzero(owner == walker)
            table.append((walker, first, count))
            poses.append(gait.pose[mine, first:after].reshape(-1, 7))
            stays = None if held is None else held[mine, first:after]
            touching.append(pressing_of(loads.touching[mine, first:after], stays).reshape(-1))
            force.append(loads.force[mine, first:after].reshape(-1, 3))
            point.append(loads.point[mine, first:after].reshape(-1, 3))
    return (
        np.array(table, np.int32),
        np.concatenate(poses),
        tuple(np.concatenate(each) for each in (touching, force, point)),
    )
