"""A body whose limbs all press, as a rider who falls: one limb of one part for each bone that a mesh hangs on.

Skeleton, Motion, Skin ---gait_from_limbs---> Gait
"""

from __future__ import annotations

import numpy as np

from ..errors import DesirePathError
from ..keywords import fields_of
from ..motion import rotation
from ..motion.gait import HEEL, Gait, Sole
from . import solid
from .skeleton import Motion, Skeleton, Skin


def bones_of(skeleton: Skeleton, skin: Skin) -> tuple[str, ...]:
    """The bones that have faces of the mesh, in the skeleton's order."""
    owned = _owned(skeleton, skin)
    return tuple(name for name in skeleton.names if name in owned)


def _owned(skeleton: Skeleton, skin: Skin) -> dict[str, np.ndarray]:
    """Faces (n, 3) of each bone, that has most of their weight."""
    names = [name for name in skin.weights if name in skeleton.names]
    if not names or not len(skin.triangles):
        return {}
    share = np.stack([np.asarray(skin.weights[name], float)[skin.triangles].sum(axis=1) for name in names])
    owner = np.where(share.max(axis=0) > 0.0, share.argmax(axis=0), -1)
    return {name: skin.triangles[owner == k] for k, name in enumerate(names) if (owner == k).any()}


@fields_of(options=solid.SolidOptions)
def gait_from_limbs(
    skeleton: Skeleton,
    motion: Motion,
    skin: Skin,
    *,
    mass: float,
    frame_rate: float,
    options: solid.SolidOptions = solid.SolidOptions(),
) -> Gait:
    """What a body did, as a Gait of one walker with a limb for each of bones_of(), rigid between its joints.

    motion: of those bones. mass [kg] > 0; frame_rate: scene frames a second. DesirePathError: nothing hangs on them.
    """
    owned = _owned(skeleton, skin)
    names = [name for name in motion.bones if name in owned]
    if not names:
        raise DesirePathError(f"No mesh hangs on the bones of '{options.name}': bind one to it, or let its feet press.")
    size = float(np.linalg.norm(np.ptp(skin.vertices, axis=0)))
    moving, sentences = solid.between_poses(
        options.name, np.asarray(motion.time, float), np.asarray(motion.matrix, float), size, frame_rate
    )
    rest = {name: np.asarray(skeleton.rest, float)[skeleton.names.index(name)] for name in names}
    soles, poses, points, owner, weight, middle = [], [], [], [], [], []
    for number, name in enumerate(names):
        used, packed = np.unique(owned[name], return_inverse=True)
        corners = (np.asarray(skin.vertices, float)[used] - rest[name][:3, 3]) @ rest[name][:3, :3]
        faces = packed.reshape(-1, 3)
        matrix = moving[:, motion.bones.index(name)]
        turn = rotation.square(matrix[:, :3, :3])
        poses.append(np.concatenate([matrix[:, :3, 3], rotation.quaternion(turn)], axis=1))
        soles.append(Sole(corners, faces))
        own = solid.outermost(corners)
        points.append(own)
        owner += [number] * len(own)
        weight.append(float(np.prod(np.maximum(np.ptp(corners, axis=0), 1e-3))))  # of its box: near enough
        middle.append(matrix[:, :3, 3] + turn @ corners.mean(axis=0))
    return Gait(
        time=motion.time,
        com=np.average(middle, axis=0, weights=weight)[None],
        mass=np.array([mass]),
        pose=np.array(poses),
        limb_walker=np.zeros(len(names)),
        part_limb=np.arange(len(names)),
        soles=tuple(soles),
        point=np.concatenate(points),
        point_part=np.array(owner),
        point_role=np.full(len(owner), HEEL),
        limb_name=tuple(names),
        part_name=("limb",) * len(names),
        walker_name=(options.name,),
        frame_rate=frame_rate,
        frame_start=options.frame_start,
        warnings=(*options.warnings, *sentences),
    ).check()
