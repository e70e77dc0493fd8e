"""posing.py - the bones of an armature: seen in the world over the frames, held by what, and keyed."""

from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix

from ..errors import DesirePathError
from . import axes, bones, moves, ride, sample

LOCKED = 1e-4  # a locked channel may change by rounding only
ROTATIONS = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}


@dataclass(frozen=True, eq=False)
class Bones:
    """What the bones of an armature do over the frames, in its own axes."""

    frames: list  # scene frames (T)
    world: np.ndarray  # the object's matrix, as seen from the ground it rides on (T, 4, 4)
    pose: dict  # bone name -> (T, 4, 4)
    scale: float  # metres in a unit [m]

    def at(self, name):
        """A bone in the world (T, 4, 4)."""
        return self.world @ self.pose[name]


def look(scene, armature, names, frames):
    """Bones as they are seen at each frame, constraints and all; a ground that moves lies as at the first one."""
    world, pose = [], {name: [] for name in names}
    with (
        sample.still(armature),
        moves.scene_of(scene, armature) as own,
        ride.on(own, armature.desire_path.ground, frames[0]) as carry,
    ):
        for frame in frames:
            seen = sample.evaluated(own, armature, frame)
            world.append(bones.world_of(seen, carry))
            for name in names:
                pose[name].append(np.array(seen.pose.bones[name].matrix, np.float64))
    return Bones(frames, np.array(world), {name: np.array(each) for name, each in pose.items()}, axes.unit_scale(scene))


def holders(armature, name):
    """What would not let keys move a bone, as a phrase; None where keys do."""
    bone = armature.pose.bones[name]
    for each in bone.constraints:
        if not each.mute and each.influence > 0.0 and not each.type.startswith("LIMIT"):
            return f"follows its constraint '{each.name}'"
    animation = armature.animation_data
    start = f'pose.bones["{bpy.utils.escape_identifier(name)}"].'
    for each in animation.drivers if animation is not None else ():
        if each.data_path.startswith((start + "location", start + "rotation")):
            return "is moved by a driver"
    return None


def basis(bone, wanted, parent):
    """The basis matrix that brings a bone to a matrix of its armature's axes; parent: its parent's, or None."""
    more = (
        {}
        if parent is None
        else {"parent_matrix": Matrix(parent.tolist()), "parent_matrix_local": bone.parent.matrix_local}
    )
    return bone.convert_local_to_pose(Matrix(wanted.tolist()), bone.matrix_local, invert=True, **more)


def values(bone, matrix, last=None):
    """([(property, its values), ..] of a pose bone with this basis, the turn); last: the turn before it."""
    at, quaternion, _ = matrix.decompose()
    mode = bone.rotation_mode
    if mode == "QUATERNION":
        if last is not None and last.dot(quaternion) < 0.0:
            quaternion.negate()
        last, row = quaternion, tuple(quaternion)
    elif mode == "AXIS_ANGLE":
        axis, angle = quaternion.to_axis_angle()
        row = (angle, *axis)
    else:
        last = quaternion.to_euler(mode, last) if last is not None else quaternion.to_euler(mode)
        row = tuple(last)
    return [("location", tuple(at)), (ROTATIONS.get(mode, "rotation_euler"), row)], last


def set_curve(curves, path, index, frames, values):
    """One value a frame, straight in between; was it keyed before?"""
    curve = curves.find(path, index=index)
    keyed = curve is not None
    if keyed:
        curves.remove(curve)
    curve = curves.new(path, index=index)
    curve.keyframe_points.add(len(frames))
    co = np.stack([np.asarray(frames, np.float32), values], axis=1)
    curve.keyframe_points.foreach_set("co", co.ravel())
    linear = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items["LINEAR"].value
    curve.keyframe_points.foreach_set("interpolation", np.full(len(frames), linear, np.int32))
    curve.update()
    return keyed


def unlocked(bone, kind, values):
    """Refuse to change what is locked."""
    if kind == "location" and any(bone.lock_location):
        moved = values[:, [bool(each) for each in bone.lock_location]]
    elif kind == "rotation" and any(bone.lock_rotation) and values.shape[1] == 3:
        moved = values[:, [bool(each) for each in bone.lock_rotation]]
    elif kind == "rotation" and all(bone.lock_rotation):
        moved = values
    else:
        return
    if np.ptp(moved, axis=0).max() > LOCKED:
        raise DesirePathError(
            f"The {kind} of bone '{bone.name}' is locked and would have to change: unlock it (Item in the "
            "sidebar of the 3D view), or place the feet of another rig."
        )


def turned(turn, about, to):
    """Moves (T, 4, 4) that turn about points (T, 3) and bring them to others."""
    out = np.tile(np.eye(4), (len(turn), 1, 1))
    out[:, :3, :3] = turn
    out[:, :3, 3] = to - np.einsum("tij,tj->ti", turn, about)
    return out
