"""bones.py - an armature's bones as they rest and as they move, in metres.

armature, frames --axes--> Skeleton, Motion, what is odd about its size
"""

import numpy as np

from ..errors import DesirePathError
from ..rig import body
from . import axes
from .private import check_library, evaluated

GROWS = 0.05  # of its size who keeps it may change by [log of a ratio]


def skeleton(armature, world, scale):
    """The rest pose in the armature's own axes, as large as the object's scale makes it.

    world: the object's matrix (4, 4)
    """
    bones = list(armature.data.bones)
    if not bones:
        check_library(armature)
        raise DesirePathError(f"'{armature.name}' has no bones: choose the armature that walks.")
    number = {bone.name: i for i, bone in enumerate(bones)}
    size = axes.sizes(world)
    local = np.array([bone.matrix_local for bone in bones], np.float64)
    parents = [number[bone.parent.name] if bone.parent else -1 for bone in bones]
    along = (size @ local)[:, :3, 1] * np.array([bone.length for bone in bones])[:, None]
    return body.Skeleton(
        tuple(number),
        np.array(parents, np.int32),
        axes.rigid(size @ local, scale),
        np.linalg.norm(along, axis=1) * scale,
        bool(np.linalg.det(size[:3, :3]) < 0.0),
    )


def world_of(found, carry=None):
    """An evaluated object's matrix, as seen from the ground it rides on."""
    world = np.array(found.matrix_world, np.float64)
    return world if carry is None else carry.now() @ world


def motion(own, armature, names, frames, rate, scale, carry=None):
    """World matrices of bones at frames (floats), scale taken out; time counts from the first. carry: a Ride.

    returns (Motion, sentences about a size that changes)
    """
    out = np.empty((len(frames), len(names), 4, 4))
    for t, frame in enumerate(frames):
        pose = evaluated(own, armature, frame)
        world = world_of(pose, carry)
        bones = pose.pose.bones
        for b, name in enumerate(names):
            out[t, b] = world @ np.array(bones[name].matrix, np.float64)
    bad = ~(np.abs(out) < axes.FAR).all(axis=(2, 3))
    bad |= ~(np.linalg.norm(out[..., :3, :3], axis=2) > 0.0).all(axis=2)
    if bad.any():
        t, b = np.argwhere(bad)[0]
        raise DesirePathError(
            f"Bone '{names[b]}' of '{armature.name}' has no usable transform at frame "
            f"{frames[t]:g} (NaN, infinite, or scaled to nothing): look at its keys and drivers "
            "there."
        )
    time = (np.asarray(frames, np.float64) - frames[0]) / rate
    return body.Motion(time, tuple(names), axes.rigid(out, scale)), _growth(armature, out, frames)


def _growth(armature, world, frames):
    """A sentence about a body that is not as large all the time; world: of its bones (T, B, 4, 4)."""
    large = np.median(np.cbrt(np.abs(np.linalg.det(world[..., :3, :3]))), axis=1)
    large /= large[0]
    other = int(np.abs(np.log(large)).argmax())
    if abs(np.log(large[other])) < GROWS:
        return ()
    return (
        f"'{armature.name}' changes its size, and is {large[other]:.2g} times as large at frame {frames[other]:g} as "
        f"at frame {frames[0]:g}: its feet press as large as they are there. Keep its scale, or bake frames apart.",
    )
