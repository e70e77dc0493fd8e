"""Small recordings made of numbers: a box that stands, a sphere that falls, a stamp that is pressed.

They drive the core directly, with forces said and not computed, so that a test knows the answer.
"""

from dataclasses import fields, replace
from types import SimpleNamespace

import numpy as np

from desire_path.motion.gait import Gait, Sole
from desire_path.study import bodies
from desire_path.study.bodies import BOX_FACES, box, sphere  # noqa: F401  (scenes are made of them)


def wheel(radius, width, around=180):
    """A smooth drum about its centre, its axle along y."""
    turn = np.linspace(0, 2 * np.pi, around, endpoint=False)
    rim = radius * np.stack([np.sin(turn), 0 * turn, np.cos(turn)], axis=1)
    side = [rim + [0, 0.5 * width * s, 0] for s in np.linspace(-1, 1, 5)]
    corner = np.concatenate([*side, [[0, -0.5 * width, 0], [0, 0.5 * width, 0]]])
    k, after, axle = np.arange(around), (np.arange(around) + 1) % around, 5 * around
    faces = [(k, after, 0 * k + axle), (after + 4 * around, k + 4 * around, 0 * k + axle + 1)]
    for ring in range(0, 4 * around, around):
        faces += [(k + ring, k + ring + around, after + ring), (after + ring, k + ring + around, after + ring + around)]
    return Sole(corner, np.concatenate([np.stack(face, axis=1) for face in faces]))


def writable(record):
    """A recording with arrays of its own that a test may change before anybody reads them."""
    own = replace(record)
    for each in fields(record):
        if isinstance(getattr(record, each.name), np.ndarray):
            object.__setattr__(own, each.name, np.array(getattr(record, each.name)))
    return own


def turn_z(angle):
    """Quaternion of a turn about +Z."""
    return np.array([np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)])


def pressed(*args, **more):
    """bodies.pressed(), with loads that a test may change."""
    gait, loads = bodies.pressed(*args, **more)
    own = {name: np.array(getattr(loads, name)) for name in ("touching", "force", "point")}
    return gait, SimpleNamespace(**own, warnings=())


def rolled(sole, radius, length, force, *, speed=0.5, rate=120.0):
    """A round body that rolls `length` [m] along x without slip, from the origin on: (Gait, loads)."""
    samples = int(length / speed * rate) + 1
    time = np.arange(samples) / rate
    pose = np.zeros((1, samples, 7))
    turned = time * speed / radius
    pose[0, :, 0], pose[0, :, 2] = time * speed, radius
    pose[0, :, 3], pose[0, :, 5] = np.cos(0.5 * turned), np.sin(0.5 * turned)
    gait = Gait(
        time=time,
        com=pose[:, :, :3],
        mass=[-force[2] / 9.81],
        pose=pose,
        limb_walker=np.zeros(1),
        part_limb=np.zeros(1),
        soles=[sole],
        point=np.zeros((1, 3)),
        point_part=np.zeros(1),
        point_role=np.ones(1),
        frame_rate=rate,
    )
    force = np.broadcast_to(np.asarray(force, float), (1, samples, 3)).copy()
    at = pose[:, :, :3] - [0.0, 0.0, radius]
    return gait, SimpleNamespace(touching=np.ones((1, samples), np.uint8), force=force, point=at, warnings=())


def strides(length, *, speed=1.3, rate=60.0, y=0.0, shift=0.0, mass=75.0):
    """Two box feet that walk `length` [m] along x at `speed` [m/s]: (Gait, loads).

    They stand for 0.6 of a cycle, 1.4 m long, and swing 12 cm high. shift: where in the cycle they begin, 0..1.
    """
    samples = int(length / speed * rate) + 1
    time = np.arange(samples) / rate
    stride = 1.4
    pose, force = np.zeros((2, samples, 7)), np.zeros((2, samples, 3))
    touching = np.zeros((2, samples), np.uint8)
    pose[:, :, 3] = 1.0
    for foot in range(2):
        cycles = time * speed / stride + 0.5 * foot + shift
        phase = cycles % 1.0
        swung = np.clip((phase - 0.6) / 0.4, 0.0, 1.0)
        ahead = np.floor(cycles) - 0.5 * foot - shift + swung * swung * (3.0 - 2.0 * swung)
        pose[foot, :, 0] = stride * ahead
        pose[foot, :, 1] = y + (0.08 if foot else -0.08)
        pose[foot, :, 2] = 0.12 * np.sin(np.pi * swung)
        touching[foot] = phase < 0.6
        load = np.clip(np.minimum(phase / 0.1, (0.6 - phase) / 0.1), 0.0, 1.0)
        force[foot, :, 2] = -mass * 9.81 * load
    com = np.stack([time * speed, 0.0 * time + y, 0.0 * time + 0.95], -1)[None]
    gait = Gait(
        time=time,
        com=com,
        mass=[mass],
        pose=pose,
        limb_walker=np.zeros(2),
        part_limb=np.arange(2),
        soles=[box(0.28, 0.10, 0.10)] * 2,
        point=np.zeros((2, 3)),
        point_part=np.arange(2),
        point_role=np.ones(2),
        frame_rate=rate,
    )
    return gait, SimpleNamespace(touching=touching, force=force, point=pose[:, :, :3].copy(), warnings=())
