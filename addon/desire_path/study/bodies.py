"""Bodies of a few numbers for experiments: a block that stands and is lifted, a ball that falls."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..loads.force import GRAVITY, PRESSES, FootForce
from ..motion.gait import Gait, Sole

RATE = 120.0  # of the recordings [1/s]
FALL_RATE = 240.0  # of what falls [1/s]
RISE = 0.3  # how high is lifted what had stood [m]
BOX_FACES = np.array(
    [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4]]
    + [[2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
)  # of a box whose corners are numbered x first, z last; out of it


def box(length: float, width: float, height: float = 0.02) -> Sole:
    """A closed box of 12 triangles, the middle of its underside at the origin. length along x, width along y [m]"""
    x, y = length / 2, width / 2
    corners = [[sx * x, sy * y, z] for z in (0.0, height) for sy in (-1, 1) for sx in (-1, 1)]
    return Sole(np.array(corners), BOX_FACES)


def sphere(radius: float, rings: int = 24) -> Sole:
    """A sphere about the origin, of so many rings of triangles from pole to pole. radius [m]"""
    up = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
    around = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    corners = [[np.cos(u) * np.cos(r), np.cos(u) * np.sin(r), np.sin(u)] for u in up for r in around]
    faces, n = [], 2 * rings
    for j in range(rings):
        for i in range(n):
            a, b = j * n + i, j * n + (i + 1) % n
            faces += [[a, b, a + n], [b, b + n, a + n]]
    return Sole(radius * np.array(corners), np.array(faces))


def pressed(
    soles: Sequence[Sole],
    poses: ArrayLike,
    forces: ArrayLike,
    *,
    seconds: float = 0.6,
    rate: float = RATE,
    mass: float = 75.0,
    lift: float = 0.1,
) -> tuple[Gait, FootForce]:
    """Rigid parts that stand still and press for `seconds` [s], then are lifted within `lift` [s].

    soles, poses (n, 7), forces on the ground (n, 3) [N]: one a limb. rate: samples [1/s]. mass: of the walker [kg],
    whose mass centre stays where it is.
    """
    at = np.asarray(poses, float)
    count, samples = len(soles), int(round((seconds + lift) * rate)) + 1
    time = np.arange(samples) / rate
    stands = time < seconds + 1e-9
    pose = np.repeat(at[:, None, :], samples, axis=1)
    risen = np.clip((time - seconds) / lift, 0.0, 1.0)
    pose[:, :, 2] += RISE * risen * risen * (3.0 - 2.0 * risen)
    gait = Gait(
        time=time,
        com=np.repeat(np.mean(at, axis=0)[None, None, :3] + [0, 0, 0.9], samples, axis=1),
        mass=np.array([mass]),
        pose=pose,
        limb_walker=np.zeros(count),
        part_limb=np.arange(count),
        soles=tuple(soles),
        point=np.zeros((count, 3)),
        point_part=np.arange(count),
        point_role=np.ones(count),
        frame_rate=rate,
    )
    loads = FootForce(
        time=time,
        touching=np.repeat(PRESSES * stands[None], count, axis=0).astype(np.uint8),
        force=np.asarray(forces, float)[:, None, :] * stands[None, :, None],
        point=pose[:, :, :3].copy(),
        clearance=np.zeros(count),
    )
    return gait, loads


def dropped(mass: float, height: float, radius: float, after: float = 0.5) -> Gait:
    """A ball that falls from `height` over z = 0 and lies there, sampled until `after` [s] it has landed. SI units"""
    fall = float(np.sqrt(2.0 * height / GRAVITY))
    return _ball(mass, radius, lambda time: height - GRAVITY * time**2 / 2, fall + after)


def landed(mass: float, speed: float, radius: float, height: float = 0.5, after: float = 0.5) -> Gait:
    """A ball that comes down from `height` at one speed [m/s] and lies there. Other SI units as dropped() has them"""
    return _ball(mass, radius, lambda time: height - speed * time, height / speed + after)


def _ball(mass: float, radius: float, low: Callable[[np.ndarray], np.ndarray], seconds: float) -> Gait:
    """A ball whose lowest point is at low(time), or at 0 where that is below."""
    time = np.arange(int(seconds * FALL_RATE) + 1) / FALL_RATE
    at = np.stack([0.0 * time, 0.0 * time, np.maximum(low(time), 0.0) + radius], axis=1)
    return Gait(
        time=time,
        com=at[None],
        mass=np.array([mass]),
        pose=np.concatenate([at, np.tile([1.0, 0, 0, 0], (len(time), 1))], axis=1)[None],
        limb_walker=np.zeros(1),
        part_limb=np.zeros(1),
        soles=(sphere(radius),),
        point=np.array([[0.0, 0.0, -radius]]),
        point_part=np.zeros(1),
        point_role=np.ones(1),
        frame_rate=FALL_RATE,
    )
