"""A foot that lies on a slope, seen as if the ground below it were level and at height 0.

bones over a hill ---flattened---> bones over a floor --foot.parts--> poses ---back---> poses on the hill
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..arrays import Record
from ..motion import rotation
from ..motion import size as sizes
from ..motion.gait import Gait
from . import leg
from .foot import Foot
from .skeleton import SampledBones

RADIUS = 0.25  # the ground is smoothed over this, about a grown person's foot [m]
STEEP = 2e-4  # ground whose normal leaves the vertical less than this is level: 1 - cosine of 1.1 degrees
FITS = 0.8  # many feet stand on the slope when their heights over it are apart by less than this share of theirs
NEARER = 1e-3  # feet lie on a slope when their soles' normal is nearer to the ground's by this [-]


class Hills(Protocol):
    """Ground with slopes, as a Simulation."""

    def rest_height(self, xy: np.ndarray) -> np.ndarray: ...

    def normal(self, xy: np.ndarray, radius: float) -> np.ndarray: ...


@dataclass(frozen=True, eq=False, repr=False)
class Slope(Record):
    """Ground below one foot over time."""

    turn: np.ndarray  # level to slope (T, 3, 3)
    at: np.ndarray  # the ground's point below the ankle (T, 3) [m]

    def flattened(self, bones: SampledBones, names: Iterable[str | None]) -> SampledBones:
        """Bones with these turned and lowered to a level floor at height 0."""
        back = np.tile(np.eye(4), (len(self.at), 1, 1))
        back[:, :3, :3] = np.swapaxes(self.turn, 1, 2)
        level = self.at * (1.0, 1.0, 0.0)
        back[:, :3, 3] = level - np.einsum("tij,tj->ti", back[:, :3, :3], self.at)
        flat = copy.copy(bones)
        flat.matrix, flat.turns = bones.matrix.copy(), {}
        for name in filter(None, names):
            flat.matrix[:, bones.column[name]] = back @ bones.matrix[:, bones.column[name]]
        return flat

    def back(self, pose: np.ndarray) -> np.ndarray:
        """Poses (T, 7) of the level floor, on the slope."""
        out = np.empty_like(pose)
        level = self.at * (1.0, 1.0, 0.0)
        out[:, :3] = self.at + np.einsum("tij,tj->ti", self.turn, pose[:, :3] - level)
        out[:, 3:] = rotation.quaternion(self.turn @ rotation.matrix(pose[:, 3:]))
        return out


def steep(land: Hills, gait: Gait) -> bool:
    """Is the ground below a recording's feet anywhere steeper than level?"""
    step = max(1, int(0.1 * len(gait.time) / max(gait.time[-1] - gait.time[0], 1e-9))) if len(gait.time) > 1 else 1
    radius = RADIUS * sizes.legs(gait)[gait.limb_walker[gait.part_limb]] / sizes.LEG
    return any(
        land.normal(xy, over)[2] < 1.0 - STEEP for part, over in zip(gait.pose[:, ::step, :2], radius) for xy in part
    )


def below(
    land: Hills, feet: Sequence[Foot], time: np.ndarray, up_rest: np.ndarray, lie: bool | None = None
) -> list[Slope | None]:
    """The Slope each foot lies on (F), None where the ground is level or the feet do not lie on it.

    land: a Simulation of the ground; lie: whether feet lie on it; None: as the rest pose's soles tell where they
    stand. It is asked of all feet together, since rest poses splay them. More than two feet must stand on it, too:
    the feet of animals roll as they stand, so that their soles tell little.
    """
    found = [_under(land, foot.joints()[0], RADIUS * foot.size) for foot in feet]
    if lie is None:
        lie = _lie(feet, found, time, up_rest) and (len(feet) <= 2 or _stand(land, feet, time, up_rest))
    return found if lie else [None] * len(feet)


def _lie(feet: Sequence[Foot], hills: Sequence[Slope | None], time: np.ndarray, up_rest: np.ndarray) -> bool:
    """Are soles nearer to the ground's slope than to level?"""
    ups, normals = [], []
    for foot, hill in zip(feet, hills):
        if hill is None:
            continue
        stands = foot.flat(time)
        if not stands.any():
            continue
        name = foot.toe if foot.multipod and foot.toe else foot.slots.foot  # what lies of a paw
        rest = rotation.square(foot.bones.rest[foot.bones.row[name], :3, :3])
        ups.append((foot.bones.turn(name)[stands] @ (rest.T @ up_rest)).mean(axis=0))
        normals.append(hill.turn[stands, :, 2].mean(axis=0))
    if not ups:
        return False
    up, normal = (rotation.unit(np.mean(each, axis=0)) for each in (ups, normals))
    return bool(up @ normal - up[2] > NEARER)


def _stand(land: Hills, feet: Sequence[Foot], time: np.ndarray, up_rest: np.ndarray) -> bool:
    """Are the places where feet stand apart in height as the ground is, rather than level?"""
    levels, overs = [], []
    for foot in feet:
        ankle, ball, _ = foot.joints()
        low = ball if foot.toe else ankle
        stands = foot.flat(time)
        ground = land.rest_height(low[:, :2])
        stands = stands & np.isfinite(ground)
        if stands.any():
            level = low[stands, 2] - foot.joints(rest=True)[1 if foot.toe else 0] @ up_rest
            levels.append(level)
            overs.append(level - ground[stands])
    if not levels:
        return False
    return bool(np.std(np.concatenate(overs)) < FITS * np.std(np.concatenate(levels)))


def _under(land: Hills, ankle: np.ndarray, radius: float) -> Slope | None:
    """The ground under an ankle over time (T, 3), smoothed over a radius [m]; None: there is none or it is level."""
    height = land.rest_height(ankle[:, :2])
    known = np.isfinite(height)
    if not known.any():
        return None
    sample = np.arange(len(height))
    height = np.interp(sample, sample[known], height[known])
    normal = np.array([land.normal(xy, radius) for xy in ankle[:, :2]])
    if (normal[:, 2] > 1.0 - STEEP).all():
        return None
    turn = leg.turn_between(np.broadcast_to((0.0, 0.0, 1.0), normal.shape), normal)
    return Slope(turn, np.concatenate([ankle[:, :2], height[:, None]], axis=1))
