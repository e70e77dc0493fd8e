"""footing.py - which bones of an armature are keyed so that its feet come to their places, and how.

Bones as they are seen + a Gait and where it should be --Plan--> a move of each bone in the world --> keys
"""

import bpy
import numpy as np

from ..errors import DesirePathError
from ..motion import rotation
from ..placement import place
from ..rig import leg
from . import axes, clock, controls, posing

EASE = 0.15  # hips come down over this before and after they must [s]


# ---- what is there ------------------------------------------------------------------------------------


def free(armature, name):
    held = posing.holders(armature, name)
    if held is not None:
        raise DesirePathError(
            f"Bone '{name}' of '{armature.name}' {held}, so that keys would not move it: bake the animation to "
            "keys first (Pose > Animation > Bake Action, with Visual Keying and Clear Constraints), or choose "
            "the bone that leads it as the foot."
        )
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
                        "let the constraint reach for a bone of the armature."
                    )
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


def _at(move, points):
    return np.einsum("tij,tj->ti", move[:, :3, :3], points) + move[:, :3, 3]


class Plan:
    """Which bones are keyed, and how each moves in the world."""

    def __init__(self, scene, armature, found, gait, placed, frames, lean=None):
        """lean: how the body turns about its mass centre (T, 3, 3); None = as the ground turns it."""
        self.armature = armature
        self.move = {}  # bone -> (T, 4, 4), in the order in which they are keyed
        self.keyed = {}  # bone -> "location", "rotation" or both
        self.late = []  # bones whose parents are moved by a solver
        self.keyed_at = [frame / clock.stretch(scene) for frame in frames]
        self.fresh = []  # (path, index, value) of channels that had no keys
        self.stood = {
            bone.name: {
                prop: tuple(getattr(bone, prop))
                for prop in ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle")
            }
            for bone in armature.pose.bones
        }
        self.shapes = {}  # foot bone -> FootShape as a dict
        self.goal = {}  # foot bone -> where its head must come to be (T, 3)
        self.turn, self.ahead = {}, {}  # led foot or toe bone -> its matrix in the world; where it points
        bones = armature.data.bones
        self.roots = [b.name for b in bones if b.parent is None and posing.holders(armature, b.name) is None]
        chain = bones[found.hips or found.feet[0].thigh or found.feet[0].foot]
        while chain.parent is not None:
            chain = chain.parent
        if not set(controls.upstream(armature, [chain.name])) & set(self.roots):
            free(armature, chain.name)
        self.feet, self.hips = found.feet, found.hips
        self.targets = [ik_target(armature, foot.foot, foot.thigh) for foot in found.feet]
        held = [foot for foot, target in zip(self.feet, self.targets) if self._held(foot, target)]
        self.leads = controls.find(scene, armature, self.feet, held, found.hips, frames) if held else {}
        names = dict.fromkeys(self.roots)
        for foot, target in zip(self.feet, self.targets):
            names.update(dict.fromkeys(filter(None, (foot.thigh, foot.shank, foot.foot, foot.toe, target))))
        if found.hips:
            names[found.hips] = None
        for name in list(names):
            if bones[name].parent is not None:
                names[bones[name].parent.name] = None
        self.bones = posing.look(scene, armature, list(names), frames)
        self._carry(gait, placed, lean)
        for limb, (foot, target) in enumerate(zip(self.feet, self.targets)):
            self._foot(limb, foot, target, gait, placed)

    def heads(self, name):
        return self.bones.at(name)[:, :3, 3]

    def _held(self, foot, target):
        """Do constraints or drivers hold what would be keyed?"""
        names = (target, foot.foot) if target is not None else (foot.thigh, foot.shank, foot.foot)
        return any(posing.holders(self.armature, name) is not None for name in names if name)

    def _turns(self, name):
        """May keys turn and move a bone?"""
        if not name or posing.holders(self.armature, name) is not None:
            return False
        bone, data = self.armature.pose.bones[name], self.armature.data.bones[name]
        return not (data.use_connect or any(bone.lock_location) or any(bone.lock_rotation))

    def hangs(self, foot):
        """Does a foot hang on a leg of two bones that keys can move?"""
        return bool(
            foot.thigh
            and foot.shank
            and under(self.armature, foot.foot, foot.shank)
            and under(self.armature, foot.shank, foot.thigh)
        )

    def _carry(self, gait, placed, lean):
        """Roots rise and lean with the body, and come down as far as legs are too short."""
        centre = gait.com[0] / self.bones.scale
        carrying = self.roots
        if lean is None:
            lean = place.tilt(gait, placed)
            if any(any(self.armature.pose.bones[root].lock_rotation) for root in self.roots):
                lean = None
        elif self._turns(self.hips):
            carrying = [self.hips]
        level = np.tile(np.eye(3), (len(centre), 1, 1))
        self.body = posing.turned(level if lean is None else lean, centre, placed.com[0] / self.bones.scale)
        down = np.zeros(len(centre))
        for limb, foot in enumerate(self.feet):
            if not (self.hangs(foot) or foot.foot in self.leads and foot.thigh and foot.shank):
                continue
            goal = _at(self._foot_move(limb, gait, placed), self.heads(foot.foot))
            down = np.maximum(down, leg.drop(*(self.carried(n) for n in (foot.thigh, foot.shank, foot.foot)), goal))
        self.body[:, 2, 3] -= gait.by_piece(lambda part: leg.eased(part, round(EASE * gait.frame_rate)), down)
        for root in carrying:
            self._key(root, self.body, "location", *(("rotation",) if lean is not None else ()))

    def carried(self, name):
        """Where a bone's head comes to be with the body (T, 3)."""
        return _at(self.body, self.heads(name))

    def _foot_move(self, limb, gait, placed):
        part = int(np.flatnonzero(gait.part_limb == limb)[0])
        return _moves(gait.pose[part], placed.pose[part], self.bones.scale)

    def _foot(self, limb, foot, target, gait, placed):
        parts = np.flatnonzero(gait.part_limb == limb)
        move = self._foot_move(limb, gait, placed)
        ankle = self.heads(foot.foot)
        self.goal[foot.foot] = _at(move, ankle)
        self.shapes[foot.foot] = self.shape(foot, parts, gait)
        toes = None
        if foot.toe and len(parts) > 1:
            toes = _moves(gait.pose[parts[1]], placed.pose[parts[1]], self.bones.scale)
        if foot.foot in self.leads:
            self.ahead[foot.foot] = rotation.matrix(gait.pose[parts[0], :, 3:])[:, :, 0]
            self.turn[foot.foot] = move @ self.bones.at(foot.foot)
            if foot.toe:
                self.turn[foot.toe] = (move if toes is None else toes) @ self.bones.at(foot.toe)
                self.turn[foot.toe][:, :3, 3] = _at(move, self.heads(foot.toe))
            return
        if target is not None:
            self._key(free(self.armature, target), move, "location", "rotation")
            if posing.holders(self.armature, foot.foot) is None and foot.foot != target:
                self._key(foot.foot, move, "rotation", late=True)
        elif self.hangs(foot):
            for name in (foot.thigh, foot.shank, foot.foot):
                free(self.armature, name)
            base = self.inherited(foot.thigh)
            hip, knee, old = (_at(base, self.heads(n)) for n in (foot.thigh, foot.shank, foot.foot))
            ahead = rotation.matrix(gait.pose[parts[0], :, 3:])[:, :, 0]
            thigh, shank, at = leg.reach(hip, knee, old, self.goal[foot.foot], ahead)
            self._key(foot.thigh, posing.turned(thigh, hip, hip) @ base, "rotation")
            self._key(foot.shank, posing.turned(shank, knee, at) @ base, "rotation")
            self._key(foot.foot, move, "rotation")
        else:
            bone = self.armature.data.bones[foot.foot]
            if bone.use_connect:
                raise DesirePathError(
                    f"Bone '{foot.foot}' of '{self.armature.name}' is fixed to its parent and no leg of two bones "
                    "was found above it: choose the foot bone of a leg, or disconnect it in Edit Mode."
                )
            self._key(free(self.armature, foot.foot), move, "location", "rotation")
        if toes is not None and posing.holders(self.armature, foot.toe) is None:
            head = self.heads(foot.toe)
            apart = not under(self.armature, foot.toe, foot.foot)
            self._key(
                foot.toe,
                posing.turned(toes[:, :3, :3], head, _at(move, head)),
                *(("location", "rotation") if apart else ("rotation",)),
                late=target is not None,
            )

    def shape(self, foot, parts, gait):
        """How a foot lies under its bones, as FootShape has it, read off a recording."""
        inside = lambda name: axes.rigid(self.bones.at(name)[0], 1.0)[:3, :3].T  # as recorded, mirrored or not
        turns = [rotation.matrix(gait.pose[part, :, 3:]) for part in (parts[0], parts[-1])]
        within = lambda at: np.einsum("tji,tj->ti", turns[0], at - gait.pose[parts[0], :, :3])
        ankle = within(self.heads(foot.foot) * self.bones.scale)[0]
        ball = within(gait.pose[parts[-1], :, :3])
        joint = within(self.heads(foot.toe) * self.bones.scale)[0] if foot.toe else ball[0]
        bends = np.ptp(ball[:, 0]) > 1e-6  # a toe part that turns about its joint
        ball = joint if bends else ball[0]
        heel, toe = (gait.soles[part].vertices[:, 0] for part in (parts[0], parts[-1]))
        return {
            "ball": ball[0],
            "tip": ball[0] + float(toe.max()),
            "heel": float(heel.min()),
            "ankle_height": ankle[2],
            "ball_height": joint[2],
            "ball_side": joint[1],
            "foot_turn": (inside(foot.foot) @ turns[0][0]).tolist(),
            "toe_turn": (inside(foot.toe) @ turns[1][0]).tolist() if foot.toe else None,
        }

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

    def wanted(self, name):
        """Where a bone goes in the armature's axes (T, 4, 4)."""
        return np.linalg.inv(self.bones.world) @ self.move[name] @ self.bones.at(name)

    def parents(self, name):
        bone = self.armature.data.bones[name].parent
        if bone is None:
            return None
        move = self.move.get(bone.name)
        move = self.inherited(bone.name) if move is None else move
        return np.linalg.inv(self.bones.world) @ move @ self.bones.at(bone.name)

    def channels(self, name, wanted, parents, kinds):
        """(property, index, values (T,)) of a bone's keys; refuses to change what is locked.

        wanted, parents: where it and its parent are in the armature's axes (T, 4, 4), None: it has none
        """
        bone, data = self.armature.pose.bones[name], self.armature.data.bones[name]
        rows, last = {}, None
        for t, matrix in enumerate(wanted):
            found, last = posing.values(bone, posing.basis(data, matrix, None if parents is None else parents[t]), last)
            for prop, row in found:
                rows.setdefault(prop, []).append(row)
        for prop, row in rows.items():
            kind = "location" if prop == "location" else "rotation"
            if kind in kinds:
                numbers = np.array(row, np.float32)
                posing.unlocked(bone, kind, numbers)
                for index in range(numbers.shape[1]):
                    yield prop, index, numbers[:, index]

    def write(self, curves, name, wanted, parents, kinds):
        start = f'pose.bones["{bpy.utils.escape_identifier(name)}"].'
        for prop, index, numbers in list(self.channels(name, wanted, parents, kinds)):
            if not posing.set_curve(curves, start + prop, index, self.keyed_at, numbers):
                self.fresh.append((start + prop, index, self.stood[name][prop][index]))

    def write_all(self, scene, curves):
        """Key all bones, and lead the feet that others hold to their places."""
        for name in self.move:
            if name not in self.late:
                self.write(curves, name, self.wanted(name), self.parents(name), self.keyed[name])
        for name in self.late:  # a foot before its toes
            above = self.armature.data.bones[name].parent.name
            seen = posing.look(scene, self.armature, [above], self.bones.frames)
            self.write(curves, name, self.wanted(name), seen.pose[above], self.keyed[name])
        if self.leads:
            solver = controls.Solver(
                scene, self.armature, self.leads, self.feet, self.turn, self.ahead, self.bones.frames
            )
            solver.run(lambda *each: self.write(curves, *each))
