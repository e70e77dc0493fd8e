"""Shanks of a person who wades: from the ankle up a leg meets what is deeper than its foot is high. MODEL 3.9

    heel part and mass centre --(a leg of two equal halves)--> knee --> shank, a cone from the ankle to the knee

A recording knows feet and a mass centre. The hip joint is below that; a leg whose ankle is nearer to it than it is long
bends its knee ahead, the way its foot points. Lengths are shares of the leg from hip to ankle, after Winter,
Biomechanics and Motor Control of Human Movement, figure 4.1.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..motion import rotation, tracks
from ..motion import size as sizes
from ..motion.gait import HEEL, Gait, Sole
from ..motion.tracks import TrackArray

ANKLE = 0.039 / 0.491  # over the sole
HIPS = 0.068  # below the mass centre of one who walks, as measured (gait_bmc_walk1)
ASIDE = 0.1  # of the middle between them, as measured there
THICK = (0.05, 0.06)  # radius of a grown person's leg in its clothes, over the ankle and at the calf [m]
AROUND = 12  # corners of the cone
FEET = ("heel", "toe") * 2  # parts of a person


def persons(gait: Gait) -> np.ndarray:
    """The walkers on two feet (n,), whose legs are known to bend as a person's do; gait: with its legs."""
    owner = gait.limb_walker[gait.part_limb]
    parts = [np.flatnonzero(owner == walker) for walker in range(len(gait.mass))]
    return np.array([w for w, own in enumerate(parts) if tuple(gait.part_name[p] for p in own) == FEET], int)


def cone(length: float, size: float) -> Sole:
    """A closed cone along z from the origin. length [m]; size: of the walker, in grown persons"""
    angle = 2.0 * np.pi * np.arange(AROUND) / AROUND
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(AROUND)], axis=1)
    low, high = (size * thick * ring for thick in THICK)
    a, b = np.arange(AROUND), np.roll(np.arange(AROUND), -1)
    bottom, top = np.full(AROUND, 2 * AROUND), np.full(AROUND, 2 * AROUND + 1)
    sides = np.concatenate([np.stack([a, b, AROUND + b], 1), np.stack([a, AROUND + b, AROUND + a], 1)])
    ends = np.concatenate([np.stack([bottom, b, a], 1), np.stack([top, AROUND + a, AROUND + b], 1)])
    up = np.array([0.0, 0.0, length])
    return Sole(np.concatenate([low, high + up, [[0.0, 0.0, 0.0], up]]), np.concatenate([sides, ends]))


def stands(heel: np.ndarray, com: np.ndarray, leg: float, side: float) -> np.ndarray:
    """Where the shank over a foot is: its origin the ankle, z towards the knee, x ahead (T, 7).

    heel: pose of the foot's heel part, below the ankle (T, 7); com: the mass centre (T, 3) [m]; leg: hip to ankle [m];
    side: 1 of a left foot, -1 of a right one
    """
    turn = rotation.matrix(heel[:, 3:])
    ankle = heel[:, :3] + ANKLE * leg * turn[:, :, 2]
    level, up = np.array([1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    points = turn[:, :, 0] * level
    steep = 1.0 - np.linalg.norm(points, axis=1, keepdims=True)  # of a foot on its tip the instep faces ahead
    ahead = rotation.unit(points + steep * turn[:, :, 2] * level)
    hip = com - HIPS * leg * up + side * ASIDE * leg * np.cross(up, ahead) - ankle
    far = np.linalg.norm(hip, axis=1, keepdims=True)
    bends = rotation.unit(ahead - (ahead * rotation.unit(hip)).sum(axis=1, keepdims=True) * rotation.unit(hip))
    knee = 0.5 * hip + np.sqrt(np.maximum(0.25 * (leg**2 - far**2), 0.0)) * bends
    return np.concatenate([ankle, rotation.quaternion(rotation.frame(ahead, knee))], axis=1)


def _side(heel: np.ndarray, other: np.ndarray) -> float:
    """1 of the left of two feet, -1 of the right one; by where they mostly are (T, 7)."""
    across, points = heel[:, :3] - other[:, :3], rotation.matrix(heel[:, 3:])[:, :, 0]
    return 1.0 if np.median(points[:, 0] * across[:, 1] - points[:, 1] * across[:, 0]) > 0.0 else -1.0


def shod(legs: Gait, recorded: Gait) -> Gait:
    """The legs, of which those of persons have shanks as limbs of their own. recorded: the same walkers as they were
    recorded, whose feet are no lower; both with their legs"""
    walkers = persons(recorded)
    limbs = np.flatnonzero(np.isin(legs.limb_walker, walkers))
    if not len(limbs):
        return legs
    heels = np.array([int(np.flatnonzero(legs.part_limb == limb)[0]) for limb in limbs])
    length = recorded.leg[legs.limb_walker[limbs]]
    shins = []
    for (rows, first, low), values in zip(tracks.blocks(legs.pose), tracks.values(recorded.pose)):
        place = {row: n for n, row in enumerate(rows.tolist())}
        here = [n for n, heel in enumerate(heels.tolist()) if heel in place]
        more = np.empty((len(here), *low.shape[1:]))
        for own, n in zip(more, here):
            walker, heel, other = int(legs.limb_walker[limbs[n]]), heels[n], heels[n ^ 1]  # one after the other
            com = recorded.com[walker, first : first + len(own)]
            side = _side(values[place[heel]], values[place[other]])
            own[:] = stands(values[place[heel]], com, float(length[n]), side)
            own[:, 2] += low[place[heel], :, 2] - values[place[heel], :, 2]
        shins.append(
            (np.concatenate([rows, len(legs.part_limb) + np.array(here, int)]), first, np.concatenate([low, more]))
        )
    parts, many = len(legs.part_limb), len(limbs)
    return replace(
        legs,
        pose=TrackArray(parts + many, len(legs.time), shins) if isinstance(legs.pose, TrackArray) else shins[0][2],
        limb_walker=np.concatenate([legs.limb_walker, legs.limb_walker[limbs]]),
        part_limb=np.concatenate([legs.part_limb, len(legs.limb_walker) + np.arange(many)]),
        soles=(*legs.soles, *(cone(0.5 * each, each / sizes.LEG) for each in length.tolist())),
        point=np.concatenate([legs.point, *([(0.0, 0.0, 0.0), (0.0, 0.0, 0.5 * each)] for each in length.tolist())]),
        point_part=np.concatenate([legs.point_part, parts + np.repeat(np.arange(many), 2)]),
        point_role=np.concatenate([legs.point_role, np.full(2 * many, HEEL)]),
        limb_name=(*legs.limb_name, *(f"shank over {legs.limb_name[limb]}" for limb in limbs)),
        part_name=(*legs.part_name, *["shank"] * many),
    )
