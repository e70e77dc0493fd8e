"""footing.py - which bones of an armature are keyed so that its feet come to their places, and how.

    Bones as they are seen + a Gait and where it should be --Plan--> a move of each bone in the world --> keys
"""
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix

from .. import leg, rotation
from ..errors import DesirePathError
from . import axes, sample

EASE = 0.15  # hips come down over this before and after they must [s]
LOCKED = 1e-4  # a locked channel may change by rounding only
ROTATIONS = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}


@dataclass(frozen=True)
class Bones:
    """What the bones of an armature do over the frames, in its own axes."""

    frames: list  # scene frames (T)
    world: np.ndarray  # the object's matrix (T, 4, 4)
    pose: dict  # bone name -> (T, 4, 4)
    scale: float  # metres in a unit [m]

    def at(self, name):
        """A bone in the world (T, 4, 4)."""
        return self.world @ self.pose[name]


# ---- what is there ------------------------------------------------------------------------------------


def look(scene, armature, names, frames):
    """Bones as they are seen at each frame, constraints and all."""
    world, pose = [], {name: [] for name in names}
    with sample.still(armature), sample.private_scene(scene, armature) as own:
        for frame in frames:
            seen = sample.evaluated(own, armature, frame)
            world.append(np.array(seen.matrix_world, np.float64))
            for name in names:
                pose[name].append(np.array(seen.pose.bones[name].matrix, np.float64))
    return Bones(frames, np.array(world), {name: np.array(each) for name, each in pose.items()},
                 axes.unit_scale(scene))


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


def free(armature, name):
    held = holders(armature, name)
    if held is not None:
        raise DesirePathError(
            f"Bone '{name}' of '{armature.name}' {held}, so that keys would not move it: bake the animation to "
            "keys first (Pose > Animation > Bake Action, with Visual Keying and Clear Constraints), or choose "
            "the bone that leads it as the foot.")
    return name


def ik_target(armature, foot, thigh):
    """(the bone an IK constraint between foot and thigh reaches for, the bone that has it), or None."""
    bone = armature.pose.bones[foot]
    while bone is not None:
        for each in bone.constraints:
            if each.type == "IK" and not each.mute and each.influence > 0.0 and each.target is not None:
                if each.target != armature or not each.subtarget:
                    raise DesirePathError(
                        f"The leg of '{foot}' reaches for the object '{each.target.name}': move that object, or "
                        "let the constraint reach for a bone of the armature.")
                return each.subtarget
        if bone.name == thigh:
            return None
        bone = bone.parent
    return None


def under(armature, name, ancestor):
    bone = armature.data.bones[name].parent
    while bone is not None and bone.name != ancestor:
        bone = bone.parent
    return bone is not None


# ---- where bones go -----------------------------------------------------------------------------------


def _moves(old, new, scale):
    """Rigid moves of the world (T, 4, 4), in the scene's units, from poses (T, 7) to others."""
    turn = [rotation.matrix(pose[:, 3:]) for pose in (old, new)]
    out = np.tile(np.eye(4), (len(old), 1, 1))
    out[:, :3, :3] = turn[1] @ np.swapaxes(turn[0], 1, 2)
    out[:, :3, 3] = (new[:, :3] - np.einsum("tij,tj->ti", out[:, :3, :3], old[:, :3])) / scale
    return out


def _turned(turn, about, to):
    """Moves (T, 4, 4) that turn about points (T, 3) and bring them to others."""
    out = np.tile(np.eye(4), (len(turn), 1, 1))
    out[:, :3, :3] = turn
    out[:, :3, 3] = to - np.einsum("tij,tj->ti", turn, about)
    return out


def _at(move, points):
    return np.einsum("tij,tj->ti", move[:, :3, :3], points) + move[:, :3, 3]


class Plan:
    """Which bones are keyed, and how each moves in the world."""

    def __init__(self, scene, armature, found, gait, placed, frames):
        self.armature = armature
        self.move = {}  # bone -> (T, 4, 4), in the order in which they are keyed
        self.keyed = {}  # bone -> "location", "rotation" or both
        self.late = []  # bones whose parents are moved by a solver
        self.fresh = []  # (path, index, value) of channels that had no keys
        self.stood = {bone.name: {prop: tuple(getattr(bone, prop)) for prop in (
            "location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle")}
            for bone in armature.pose.bones}
        self.shapes = {}  # foot bone -> FootShape as a dict
        self.goal = {}  # foot bone -> where its head must come to be (T, 3)
        bones = armature.data.bones
        self.roots = [b.name for b in bones if b.parent is None and holders(armature, b.name) is None]
        chain = bones[found.hips or found.feet[0].thigh or found.feet[0].foot]
        while chain.parent is not None:
            chain = chain.parent
        free(armature, chain.name)
        self.feet = found.feet
        self.targets = [ik_target(armature, foot.foot, foot.thigh) for foot in found.feet]
        names = dict.fromkeys(self.roots)
        for foot, target in zip(self.feet, self.targets):
            names.update(dict.fromkeys(filter(None, (foot.thigh, foot.shank, foot.foot, foot.toe, target))))
        for name in list(names):
            if bones[name].parent is not None:
                names[bones[name].parent.name] = None
        self.bones = look(scene, armature, list(names), frames)
        self._carry(gait, placed)
        for limb, (foot, target) in enumerate(zip(self.feet, self.targets)):
            self._foot(limb, foot, target, gait, placed)

    def heads(self, name):
        return self.bones.at(name)[:, :3, 3]

    def hangs(self, foot):
        """Does a foot hang on a leg of two bones that keys can move?"""
        return bool(foot.thigh and foot.shank and under(self.armature, foot.foot, foot.shank)
                    and under(self.armature, foot.shank, foot.thigh))

    def _carry(self, gait, placed):
        """Roots rise with the body, and come down as far as legs are too short."""
        rise = (placed.com[0, :, 2] - gait.com[0, :, 2]) / self.bones.scale
        up = np.array((0.0, 0.0, 1.0))
        down = np.zeros(len(rise))
        for limb, (foot, target) in enumerate(zip(self.feet, self.targets)):
            if not self.hangs(foot):
                continue
            hip, knee, ankle = (self.heads(n) for n in (foot.thigh, foot.shank, foot.foot))
            goal = _at(self._foot_move(limb, gait, placed), ankle)
            lift = rise[:, None] * up
            down = np.maximum(down, leg.drop(hip + lift, knee + lift, ankle + lift, goal))
        down = leg.eased(down, round(EASE * gait.frame_rate))
        carried = np.tile(np.eye(4), (len(rise), 1, 1))
        carried[:, 2, 3] = rise - down
        for root in self.roots:
            self._key(root, carried, "location")

    def _foot_move(self, limb, gait, placed):
        part = int(np.flatnonzero(gait.part_limb == limb)[0])
        return _moves(gait.pose[part], placed.pose[part], self.bones.scale)

    def _foot(self, limb, foot, target, gait, placed):
        parts = np.flatnonzero(gait.part_limb == limb)
        move = self._foot_move(limb, gait, placed)
        ankle = self.heads(foot.foot)
        self.goal[foot.foot] = _at(move, ankle)
        self.shapes[foot.foot] = self.shape(foot, parts, gait)
        if target is not None:
            self._key(free(self.armature, target), move, "location", "rotation")
            if holders(self.armature, foot.foot) is None and foot.foot != target:
                self._key(foot.foot, move, "rotation", late=True)
        elif self.hangs(foot):
            for name in (foot.thigh, foot.shank, foot.foot):
                free(self.armature, name)
            base = self.inherited(foot.thigh)
            hip, knee, old = (_at(base, self.heads(n)) for n in (foot.thigh, foot.shank, foot.foot))
            ahead = rotation.matrix(gait.pose[parts[0], :, 3:])[:, :, 0]
            thigh, shank, at = leg.reach(hip, knee, old, self.goal[foot.foot], ahead)
            self._key(foot.thigh, _turned(thigh, hip, hip) @ base, "rotation")
            self._key(foot.shank, _turned(shank, knee, at) @ base, "rotation")
            self._key(foot.foot, move, "rotation")
        else:
            bone = self.armature.data.bones[foot.foot]
            if bone.use_connect:
                raise DesirePathError(
                    f"Bone '{foot.foot}' of '{self.armature.name}' is fixed to its parent and no leg of two bones "
                    "was found above it: choose the foot bone of a leg, or disconnect it in Edit Mode.")
            self._key(free(self.armature, foot.foot), move, "location", "rotation")
        if foot.toe and len(parts) > 1 and holders(self.armature, foot.toe) is None:
            toes = _moves(gait.pose[parts[1]], placed.pose[parts[1]], self.bones.scale)
            head = self.heads(foot.toe)
            apart = not under(self.armature, foot.toe, foot.foot)
            self._key(foot.toe, _turned(toes[:, :3, :3], head, _at(move, head)),
                      *(("location", "rotation") if apart else ("rotation",)), late=target is not None)

    def shape(self, foot, parts, gait):
        """How a foot lies under its bones, as FootShape has it, read off a recording."""
        inside = lambda name: rotation.square(self.bones.at(name)[0, :3, :3]).T
        turns = [rotation.matrix(gait.pose[part, :, 3:]) for part in (parts[0], parts[-1])]
        within = lambda at: np.einsum("tji,tj->ti", turns[0], at - gait.pose[parts[0], :, :3])
        ankle = within(self.heads(foot.foot) * self.bones.scale)[0]
        ball = within(gait.pose[parts[-1], :, :3])
        joint = within(self.heads(foot.toe) * self.bones.scale)[0] if foot.toe else ball[0]
        bends = np.ptp(ball[:, 0]) > 1e-6  # a toe part that turns about its joint
        ball = joint if bends else ball[0]
        heel, toe = (gait.soles[part].vertices[:, 0] for part in (parts[0], parts[-1]))
        return {"ball": ball[0], "tip": ball[0] + float(toe.max()), "heel": float(heel.min()),
                "ankle_height": ankle[2], "ball_height": joint[2], "ball_side": joint[1],
                "foot_turn": (inside(foot.foot) @ turns[0][0]).tolist(),
                "toe_turn": (inside(foot.toe) @ turns[1][0]).tolist() if foot.toe else None}

    def _key(self, name, move, *channels, late=False):
        self.move[name] = move
        self.keyed[name] = channels
        if late:
            self.late.append(name)

    def inherited(self, name):
        """How a bone moves because those above it do (T, 4, 4)."""
        bone = self.armature.data.bones[name].parent
        while bone is not None:
            if bone.name in self.move:
                return self.move[bone.name]
            bone = bone.parent
        return np.tile(np.eye(4), (len(self.bones.frames), 1, 1))

    # ---- keys ---------------------------------------------------------------------------------------

    def basis(self, name, parents):
        """Basis matrices that put a bone where it goes; parents: theirs, where they are (T, 4, 4) or None."""
        bone = self.armature.data.bones[name]
        to_pose = np.linalg.inv(self.bones.world)
        wanted = to_pose @ self.move[name] @ self.bones.at(name)
        for t, matrix in enumerate(wanted):
            more = {} if parents is None else {"parent_matrix": Matrix(parents[t].tolist()),
                                               "parent_matrix_local": bone.parent.matrix_local}
            yield bone.convert_local_to_pose(Matrix(matrix.tolist()), bone.matrix_local, invert=True, **more)

    def parents(self, name):
        bone = self.armature.data.bones[name].parent
        if bone is None:
            return None
        move = self.move.get(bone.name)
        move = self.inherited(bone.name) if move is None else move
        return np.linalg.inv(self.bones.world) @ move @ self.bones.at(bone.name)

    def channels(self, name, parents):
        """(property, index, values (T,)) of a bone's keys; refuses to change what is locked."""
        bone = self.armature.pose.bones[name]
        mode = bone.rotation_mode
        turn = ROTATIONS.get(mode, "rotation_euler")
        rows = {"location": [], turn: []}
        last = None
        for basis in self.basis(name, parents):
            at, quaternion, _ = basis.decompose()
            rows["location"].append(tuple(at))
            if mode == "QUATERNION":
                if last is not None and last.dot(quaternion) < 0.0:
                    quaternion.negate()
                last = quaternion
                rows[turn].append(tuple(quaternion))
            elif mode == "AXIS_ANGLE":
                axis, angle = quaternion.to_axis_angle()
                rows[turn].append((angle, *axis))
            else:
                last = quaternion.to_euler(mode, last) if last is not None else quaternion.to_euler(mode)
                rows[turn].append(tuple(last))
        for kind, prop in (("location", "location"), ("rotation", turn)):
            if kind in self.keyed[name]:
                values = np.array(rows[prop], np.float32)
                self._unlocked(bone, kind, values)
                for index in range(values.shape[1]):
                    yield prop, index, values[:, index]

    def _unlocked(self, bone, kind, values):
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
                "sidebar of the 3D view), or place the feet of another rig.")

    def write(self, curves, names, parents_of):
        for name in names:
            start = f'pose.bones["{bpy.utils.escape_identifier(name)}"].'
            for prop, index, values in list(self.channels(name, parents_of(name))):
                if not set_curve(curves, start + prop, index, self.bones.frames, values):
                    self.fresh.append((start + prop, index, self.stood[name][prop][index]))


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
