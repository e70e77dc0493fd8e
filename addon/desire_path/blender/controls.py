"""controls.py - which bones lead a foot that constraints hold: those that take it along when they are nudged.

    foot <- parents, targets of constraints --nudged one by one in a copy of the action--> Leads of the foot
    Leads + where feet must come to be --look, move, write; again while they are off--> keys

A foot has one lead that takes it along whole (an IK control), or one that places it and one that turns it, or
one that takes the toes along and one that rolls the foot over them (a paw), or one each for thigh, shank and foot
(FK); where an animation switches from one to the other, both. A lead of the toes goes with any but a paw's.
"""

from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

from ..motion import rotation
from ..rig import leg
from . import compat, posing, private, sample

SHIFT, TURN = 0.02, np.radians(4.0)  # a nudge, in leg lengths and [rad]
SAME = 0.15  # what is led goes where it should but for this share of the nudge
ROUNDS = 5  # of corrections
NEAR, NEAR_TURN = 5e-4, np.radians(0.2)  # no more to correct, in leg lengths and [rad]
STAGES = (("thigh",), ("shank",), ("whole", "place", "paw"), ("turn", "roll"), ("toe",))
ENOUGH = ({"whole"}, {"place", "turn"}, {"paw", "roll"}, {"thigh", "shank", "turn"})


@dataclass(frozen=True)
class Lead:
    """A bone that keys move, and what of the foot it moves: a word of STAGES."""

    bone: str
    job: str


# ---- what could lead ----------------------------------------------------------------------------------


def upstream(armature, names):
    """Bones that these hang on or follow, themselves too, nearest first."""
    found, todo = {}, list(names)
    while todo:
        name = todo.pop(0)
        bone = armature.pose.bones.get(name)
        if bone is None or name in found:
            continue
        found[name] = bone
        todo += [bone.parent.name] if bone.parent else []
        for each in bone.constraints:
            if each.mute:
                continue
            ends = list(each.targets) if hasattr(each, "targets") else [each]
            todo += [end.subtarget for end in ends if getattr(end, "target", None) == armature and end.subtarget]
            if getattr(each, "pole_target", None) == armature and each.pole_subtarget:
                todo.append(each.pole_subtarget)
    return list(found)


def candidates(armature, foot):
    """Bones upstream of a foot that keys move."""
    return [
        name
        for name in upstream(armature, [n for n in (foot.toe, foot.foot) if n])
        if posing.holders(armature, name) is None and not _locked(armature, name, "rotation")
    ]


def _locked(armature, name, kind):
    bone = armature.pose.bones[name]
    return all(bone.lock_location) if kind == "location" else all(bone.lock_rotation)


# ---- nudges -------------------------------------------------------------------------------------------


@contextmanager
def trial(scene, armature):
    """(a scene, the curves of a copy of the action): what is keyed there is gone afterwards."""
    animation = armature.animation_data
    action, slot = animation.action, getattr(animation, "action_slot", None)
    copied = action.copy() if action is not None else bpy.data.actions.new("desire_path trial")
    try:
        compat.use_action(animation, copied, None)
        with sample.still(armature), private.private_scene(scene, armature) as own:
            yield own, compat.curves(animation, armature)
    finally:
        compat.use_action(animation, action, slot)
        bpy.data.actions.remove(copied)


class Nudges:
    """The pose of one frame, in which bones are moved and what follows is seen."""

    def __init__(self, own, curves, armature, frame, names, watched):
        self.own, self.armature, self.frame = own, armature, frame
        bones = armature.data.bones
        self.watched = set(names) | set(watched) | {bones[n].parent.name for n in names if bones[n].parent}
        seen = sample.evaluated(own, armature, frame)
        self.rest = self._pose(seen)
        self.keys = {
            name: [
                (self._key(curves, name, prop, index, value), value)
                for prop, each in posing.values(armature.pose.bones[name], seen.pose.bones[name].matrix_basis.copy())[0]
                for index, value in enumerate(each)
            ]
            for name in names
        }

    def _key(self, curves, name, prop, index, value):
        path = f'pose.bones["{bpy.utils.escape_identifier(name)}"].{prop}'
        posing.set_curve(curves, path, index, [self.frame], np.array([value], np.float32))
        return path, index

    def _pose(self, seen):
        return {name: np.array(seen.pose.bones[name].matrix, np.float64) for name in self.watched}

    def _set(self, name, values):
        curves = compat.curves(self.armature.animation_data, self.armature)
        for ((path, index), _), value in zip(self.keys[name], values):
            curve = curves.find(path, index=index)
            curve.keyframe_points[0].co[1] = value
            curve.update()

    def pose(self, name, move):
        """The watched bones (name -> (4, 4)) with one of them moved thus in the armature's axes."""
        bone = self.armature.data.bones[name]
        parent = self.rest[bone.parent.name] if bone.parent else None
        basis = posing.basis(bone, move @ self.rest[name], parent)
        wanted = posing.values(self.armature.pose.bones[name], basis)[0]
        self._set(name, [value for _, each in wanted for value in each])
        try:
            return self._pose(sample.evaluated(self.own, self.armature, self.frame))
        finally:
            self._set(name, [value for _, value in self.keys[name]])


def _turn(about):
    """A small turn about a point, askew to all axes."""
    axis = np.array((0.48, 0.6, 0.64))
    cross = np.array(((0, -axis[2], axis[1]), (axis[2], 0, -axis[0]), (-axis[1], axis[0], 0)))
    out = np.eye(4)
    out[:3, :3] = np.eye(3) + np.sin(TURN) * cross + (1 - np.cos(TURN)) * cross @ cross
    out[:3, 3] = about - out[:3, :3] @ about
    return out


def _apart(one, other):
    """The angle between two turns, scale left out [rad]."""
    between = rotation.square(other[:3, :3] @ np.linalg.inv(one[:3, :3]))
    return float(np.arccos(np.clip((np.trace(between) - 1.0) / 2.0, -1.0, 1.0)))


class Leg:
    """One foot and the bones that tell what a nudge did to it; some may be missing."""

    def __init__(self, foot, others, nudges):
        self.foot, self.others, self.nudges = foot, others, nudges
        self.was = nudges.rest
        ankle = self.head(self.was, foot.foot)
        top = self.head(self.was, foot.thigh) if foot.thigh else ankle + (0.0, 0.0, 1.0)
        self.size = max(float(np.linalg.norm(top - ankle)), 1e-6)
        self.up = (top - ankle) / self.size

    @staticmethod
    def head(pose, name):
        return pose[name][:3, 3]

    def moved(self, now, name):
        return float(np.linalg.norm(self.head(now, name) - self.head(self.was, name)))

    def stays(self, now, *names):
        """Are these bones' heads where they were?"""
        return all(self.moved(now, name) < SAME * SHIFT * self.size for name in names if name)

    def turns(self, now, name, turn):
        return _apart(turn @ self.was[name], now[name]) < SAME * TURN

    def swings(self, now, start, end, turn):
        """Does the line from one head to another turn thus?"""
        line = lambda pose: self.head(pose, end) - self.head(pose, start)
        wanted = turn[:3, :3] @ line(self.was)
        return np.linalg.norm(line(now) - wanted) < SAME * TURN * max(np.linalg.norm(wanted), 1e-6)

    def carries(self, name, job="whole"):
        """Does the foot go along with this bone, and its leg bend for it? job: "place" without turning, "paw" the
        toes alone."""
        foot = self.foot
        led = foot.toe if job == "paw" else foot.foot
        move = _turn(self.head(self.was, led)) if job != "place" else np.eye(4)
        move[:3, 3] += SHIFT * self.size * self.up
        now = self.nudges.pose(name, move)
        gone = self.head(now, led) - self.head(self.was, led) - SHIFT * self.size * self.up
        if np.linalg.norm(gone) > SAME * SHIFT * self.size or not self.stays(now, foot.thigh, *self.others):
            return False
        turned = {"whole": (foot.foot, foot.toe), "paw": (foot.toe,), "place": ()}[job]
        if not all(self.turns(now, each, move) for each in turned if each):
            return False
        bends = lambda each: _apart(self.was[each], now[each]) > 0.1 * SHIFT
        return all(bends(each) for each in (foot.thigh, foot.shank) if each)

    def joint(self, name):
        """What turns with this bone: "thigh", "shank", "turn" (the foot), "roll" (over its toes), "toe" or None."""
        foot = self.foot
        about = self.head(self.was, name)
        now = self.nudges.pose(name, _turn(about))
        if not self.stays(now, foot.thigh, *self.others):
            return None
        turn = now[name] @ np.linalg.inv(self.was[name])
        if _apart(np.eye(4), turn) < 0.5 * TURN:
            return None
        if not self.turns(now, foot.foot, turn):
            still = _apart(self.was[foot.foot], now[foot.foot]) < SAME * TURN and self.stays(now, foot.foot)
            return "toe" if still and foot.toe and self.turns(now, foot.toe, turn) else None
        if self.stays(now, foot.foot):
            return "turn"
        if foot.toe and self.stays(now, foot.toe) and _apart(self.was[foot.toe], now[foot.toe]) < SAME * TURN:
            return "roll"
        if not (foot.thigh and foot.shank and self.swings(now, foot.shank, foot.foot, turn)):
            return None
        if self.stays(now, foot.shank):
            return "shank"
        return "thigh" if self.swings(now, foot.thigh, foot.shank, turn) else None


# ---- finding leads ------------------------------------------------------------------------------------


def find(scene, armature, feet, driven, hips, frames):
    """{foot bone: its Leads} of feet that constraints hold; feet nothing leads are left out."""
    names = {foot.foot: candidates(armature, foot) for foot in driven}
    nudged = list(dict.fromkeys(name for each in names.values() for name in each))
    watched = [n for foot in feet for n in (foot.foot, foot.toe, foot.thigh, foot.shank)] + [hips]
    watched = [name for name in watched if name]
    found = {foot.foot: [] for foot in driven}
    for frame in dict.fromkeys((frames[0], frames[len(frames) // 2], frames[-1])):
        with trial(scene, armature) as (own, curves):
            nudges = Nudges(own, curves, armature, frame, nudged, watched)
            for foot in driven:
                others = [each.foot for each in feet if each != foot] + ([hips] if hips else [])
                leads = _leads(armature, Leg(foot, others, nudges), names[foot.foot])
                if any(each <= {lead.job for lead in leads} for each in ENOUGH):
                    found[foot.foot] += [lead for lead in leads if lead not in found[foot.foot]]
            if all(found.values()) and not _switches(armature.animation_data, curves):
                break
    return {name: leads for name, leads in found.items() if leads}


def _switches(animation, curves):
    """May other bones lead later on, since more than bones is animated?"""
    usual = ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")
    return bool(animation.nla_tracks) or not all(curve.data_path.endswith(usual) for curve in curves)


def _leads(armature, limb, names):
    movable = [name for name in names if not _locked(armature, name, "location")]
    jobs = {"whole": [name for name in movable if limb.carries(name)]}
    for name in names:
        job = None if name in jobs["whole"] else limb.joint(name)
        if job is not None:
            jobs.setdefault(job, []).append(name)
    if jobs["whole"]:
        wanted = ("whole", "toe")
    elif "thigh" in jobs and "shank" in jobs:
        wanted = ("thigh", "shank", "turn", "toe")
    elif "roll" in jobs:
        wanted = ("paw", "roll")
        jobs["paw"] = [name for name in movable if limb.carries(name, "paw")]
    else:
        wanted = ("place", "turn", "toe")
        jobs["place"] = [name for name in movable if limb.carries(name, "place")]
    jobs = {job: jobs[job] for job in wanted if job in jobs}
    return [Lead(_first(armature, each), job) for job, each in jobs.items() if each]


def _first(armature, names):
    """Of bones that do the same, the one that the others follow."""
    for name in names:
        if not set(upstream(armature, [name])) & set(names) - {name}:
            return name
    return names[-1]


# ---- moving them --------------------------------------------------------------------------------------


class Solver:
    """Moves leads until feet are where they must be.

    goal: foot or toe bone -> world matrices (T, 4, 4); ahead: foot bone -> where it points (T, 3)
    """

    def __init__(self, scene, armature, leads, feet, goal, ahead, frames):
        self.scene, self.armature, self.frames = scene, armature, frames
        self.leads, self.goal, self.ahead = leads, goal, ahead
        self.feet = [foot for foot in feet if foot.foot in leads]

    def look(self):
        names = [n for foot in self.feet for n in (foot.thigh, foot.shank, foot.foot, foot.toe) if n]
        for each in self.leads.values():
            for lead in each:
                bone = self.armature.data.bones[lead.bone]
                names += [bone.name] + ([bone.parent.name] if bone.parent else [])
        return posing.look(self.scene, self.armature, list(dict.fromkeys(names)), self.frames)

    def run(self, write):
        """write(bone, wanted poses, parents' poses or None, kinds) keys a bone."""
        seen = self.look()
        for _ in range(ROUNDS):
            quiet = True
            for stage in STAGES:
                wrote = [
                    self._step(seen, foot, lead, write)
                    for foot in self.feet
                    for lead in self.leads[foot.foot]
                    if lead.job in stage
                ]
                if any(wrote):
                    quiet, seen = False, self.look()
            if quiet:
                break

    def _step(self, seen, foot, lead, write):
        move = self._move(seen, foot, lead.job)
        size = 1.0
        if foot.thigh:
            size = float(np.median(np.linalg.norm(_heads(seen, foot.thigh) - _heads(seen, foot.foot), axis=1)))
        at = _heads(seen, foot.toe if lead.job in ("toe", "paw") else foot.foot)
        shift = np.linalg.norm(np.einsum("tij,tj->ti", move[:, :3, :3], at) + move[:, :3, 3] - at, axis=1)
        turn = np.arccos(np.clip((np.trace(move[:, :3, :3], axis1=1, axis2=2) - 1.0) / 2.0, -1.0, 1.0))
        if shift.max() < NEAR * size and turn.max() < NEAR_TURN:
            return False
        bone = self.armature.data.bones[lead.bone]
        parents = seen.pose[bone.parent.name] if bone.parent else None
        wanted = np.linalg.inv(seen.world) @ move @ seen.at(lead.bone)
        kinds = {"whole": ("location", "rotation"), "paw": ("location", "rotation"), "place": ("location",)}.get(
            lead.job, ("rotation",)
        )
        write(lead.bone, wanted, parents, kinds)
        return True

    def _move(self, seen, foot, job):
        """How the lead must move in the world, as things are now (T, 4, 4)."""
        ankle, wanted = _heads(seen, foot.foot), self.goal[foot.foot]
        goal, still = wanted[:, :3, 3], np.tile(np.eye(3), (len(ankle), 1, 1))
        if job == "place":
            return posing.turned(still, ankle, goal)
        if job in ("whole", "turn"):
            turn = between(seen.at(foot.foot), wanted)
            return posing.turned(turn, ankle, goal if job == "whole" else ankle)
        if job in ("toe", "paw", "roll"):
            head, of = _heads(seen, foot.toe), foot.foot if job == "roll" else foot.toe
            return posing.turned(
                between(seen.at(of), self.goal[of]), head, self.goal[of][:, :3, 3] if job == "paw" else head
            )
        hip, knee = _heads(seen, foot.thigh), _heads(seen, foot.shank)
        if job == "thigh":
            turn, _, _ = leg.reach(hip, knee, ankle, goal, self.ahead[foot.foot])
            return posing.turned(turn, hip, hip)
        turn = leg.turn_between(rotation.unit(ankle - knee), rotation.unit(goal - knee))
        return posing.turned(turn, knee, knee)


def _heads(seen, name):
    return seen.at(name)[:, :3, 3]


def between(one, other):
    """Turns from matrices (T, 4, 4) to others, scale left out (T, 3, 3)."""
    return rotation.square(other[:, :3, :3] @ np.linalg.inv(one[:, :3, :3]))
