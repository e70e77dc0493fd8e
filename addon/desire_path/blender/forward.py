"""forward.py - a clip that walks in place goes ahead with its character: an action of its own, that can be left.

    the action in use --a copy, repeated if it loops, delta location at the speed of the feet--> `<action>_carried`
    along a curve --forward_curve.py--> the same, with delta rotation

The user's action stays as it is; delta location moves the object wherever its own keys, bones and controls are. Of a
character whose bones follow another armature that one is carried.
"""

import math
from collections import Counter

import bpy
import numpy as np

from .. import bounds
from ..errors import DesirePathError
from ..placement import cycle
from . import axes, clock, compat, forward_curve, moves, posing, recordings

OURS = "desire_path_carried"  # on an action of ours: how many keys it was made with
SOURCE = "desire_path_carried_from"  # and the action it was made from, where there was one
BEFORE = "desire_path_carried_delta"  # and the delta location before
TURNED = "desire_path_carried_turn"  # and the delta rotation before, Euler angles and then a quaternion
PLACED_FROM = "desire_path_placed_from"  # on an action of ours whose feet were placed: the one it was before
DELTA = "delta_location"
PAST = ", past the end of which its clip goes"  # of a curve
SHARE = 0.3  # of its displacement a carried character may be off
_refused = {}  # why who was not carried, by name


def leader(armature):
    """The armature that most bones of another one follow by constraints; itself where there is none."""
    led = Counter()
    for bone in armature.pose.bones if armature.pose is not None else ():
        for each in bone.constraints:
            target = getattr(each, "target", None)
            if target is not None and target != armature and target.type == "ARMATURE" and not each.mute:
                led[target] += 1
                break
    found, count = led.most_common(1)[0] if led else (armature, 0)
    return found if 2 * count > len(armature.pose.bones) else armature


def is_carried(armature):
    """Whether a character goes ahead by an action of ours."""
    animation = leader(armature).animation_data if armature.type == "ARMATURE" else None
    return animation is not None and animation.action is not None and OURS in animation.action


def carry(scene, armature, line=None):
    """Let a character whose clip walks in place go ahead; returns a sentence about it.

    line: places to go along (n, 2 or 3), from the first on [m]; None = straight ahead
    """
    if is_carried(armature):
        if line is None:
            return ""
        switch(armature, False)
    first, last = moves.frame_range(scene, armature)
    gait = recordings.record(scene, armature, first, last, samples=1)
    velocity = cycle.ahead(gait)
    if velocity is None:
        why = "does not walk" if _stays(gait) else "moves by itself"
        return f"'{armature.name}' {why}: it is not carried ahead."
    course = forward_curve.course(line, gait, velocity) if line is not None else None
    rig = leader(armature)
    animation = rig.animation_data or rig.animation_data_create()
    if animation is None:
        raise DesirePathError(f"'{rig.name}' cannot be given keys: make its library override editable first.")
    again = cycle.samples_to_loop(gait)
    copied = _action(rig, animation)
    try:
        curves = compat.curves(animation, rig)
        goes_on = _repeats(curves) or (again is not None and _repeat(curves, again))
        stretch, seconds = clock.stretch(scene), gait.time[-1] - gait.time[0]
        ends = course is not None and not course.closed and goes_on
        if ends:
            until = first + course.seconds * clock.frame_rate(scene)
            last, goes_on = max(last, math.ceil(_stop(curves, until / stretch) * stretch - 1e-3)), False
        if course is None:
            wanted = gait.com[0, -1] + (*(velocity * seconds), 0.0)
            _go(scene, rig, curves, velocity, first / stretch, last / stretch, goes_on)
        else:
            wanted = (course.moves([seconds])[0] @ (*gait.com[0, -1], 1.0))[:3]
            _follow(scene, rig, curves, course, first, max(last, scene.frame_end) if goes_on else last, goes_on)
        copied[OURS] = _keys(curves)
        bpy.context.view_layer.update()
        end = first + round(seconds * clock.frame_rate(scene))
        came = _came(scene, armature, end)
        if np.hypot(*(came - wanted)[:2]) > SHARE * np.hypot(*velocity) * seconds:
            raise DesirePathError(
                f"'{armature.name}' walks in place and cannot be carried ahead, since something else holds it there: "
                "move what its object or its bones follow, by keys or along a curve."
            )
    except BaseException:
        copied[OURS] = _keys(compat.curves(animation, rig))
        switch(armature, False)
        raise
    how = ", its clip repeated" if goes_on else ", as far as its clip goes, which does not loop"
    if ends:
        how = f" to its end, its clip repeated up to frame {last}" if last <= until else PAST
    return (
        f"'{armature.name}' walks in place and is carried {'ahead' if course is None else 'along the curve'} at "
        f"{np.hypot(*velocity):.2f} m/s{how}: action '{copied.name}'; Carried switches it off."
    )


def ask(armature, on):
    """Switch as a user asks for it: why that cannot be is kept, to be shown."""
    _refused.pop(armature.name, None)
    try:
        reason = switch(armature, on)
    except DesirePathError as problem:
        reason = str(problem)
    if on and not is_carried(armature):
        _refused[armature.name] = reason
        print(f"Desire Path: {reason}")


def refused(armature):
    """Why a character is not carried though it was asked for; empty where it is, or was not."""
    return "" if is_carried(armature) else _refused.get(armature.name, "")


def placed_anew(armature):
    """Take note that the action in use, one of ours, has got its feet placed by us."""
    animation = leader(armature).animation_data
    animation.action[OURS] = _keys(compat.curves(animation, leader(armature)))


def switch(armature, on):
    """Let a character go ahead, or walk in place as it did; an action of ours that was worked on is kept. Returns a
    sentence where it was asked to go ahead."""
    rig = leader(armature)
    if on and not is_carried(armature):
        return carry(next(iter(rig.users_scene), bpy.context.scene), armature)
    if on or not is_carried(armature):
        return ""
    animation, ours = rig.animation_data, rig.animation_data.action
    first, before, turned = ours.get(SOURCE), list(ours[BEFORE]), list(ours.get(TURNED, ()))  # it may be removed below
    slot = getattr(animation, "action_slot", None)
    _leave(animation, rig, ours)
    if first is not None:
        compat.use_action(animation, first, _same_slot(first, slot))
    else:
        animation.action = None
    rig.delta_location = before
    if turned:
        rig.delta_rotation_euler, rig.delta_rotation_quaternion = turned[:3], turned[3:]
    return ""


def _leave(animation, rig, ours):
    """Give up an action of ours, and the one its feet were placed from; what was worked on is kept."""
    through = bpy.data.actions.get(ours.get(PLACED_FROM, ""))
    slot = getattr(animation, "action_slot", None)
    for each in (ours, through):
        if each is None or OURS not in each:
            continue
        compat.use_action(animation, each, _same_slot(each, slot))
        changed = _keys(compat.curves(animation, rig)) != each[OURS]
        animation.action = None
        each.use_fake_user = changed
        if not changed and each.users == 0:
            bpy.data.actions.remove(each)


def _action(rig, animation):
    """A copy of the action in use, or a new one, in its place."""
    action, slot, shift = animation.action, getattr(animation, "action_slot", None), 0.0
    strip = _only_strip(animation)
    if strip is not None:
        action, slot = strip.action, getattr(strip, "action_slot", None)
        shift = strip.frame_start - strip.action_frame_start
    copied = action.copy() if action is not None else bpy.data.actions.new(rig.name)
    copied.name = f"{action.name if action is not None else rig.name}_carried"
    copied[OURS] = 0
    copied[BEFORE] = list(rig.delta_location)
    copied[TURNED] = [*rig.delta_rotation_euler, *rig.delta_rotation_quaternion]
    if animation.action is not None:
        copied[SOURCE] = action
        action.use_fake_user = True  # to go back to, even after saving
    copied.use_fake_user = False
    compat.use_action(animation, copied, _same_slot(copied, slot))
    if shift:
        for curve in compat.curves(animation, rig):
            for point in curve.keyframe_points:
                point.co_ui[0] += shift  # with its handles
            curve.update()
    return copied


def _only_strip(animation):
    """The strip that alone moves an object, as its action does: whole, as fast and once; else None."""
    if animation.action is not None or not animation.use_nla or animation.action_blend_type != "REPLACE":
        return None
    tracks = list(animation.nla_tracks)
    tracks = [each for each in tracks if each.is_solo] or [each for each in tracks if not each.mute]
    strips = [each for track in tracks for each in track.strips if not each.mute]
    if len(strips) != 1 or strips[0].type != "CLIP" or strips[0].action is None or animation.action_influence < 1.0:
        return None
    strip = strips[0]
    span = (strip.action_frame_start, strip.action_frame_end)
    full = np.allclose(span, strip.action.frame_range[:], atol=1e-3)
    plain = strip.scale == strip.repeat == 1.0 and not (strip.use_reverse or strip.use_animated_influence)
    return strip if full and plain and strip.blend_type == "REPLACE" else None


def _came(scene, armature, frame):
    """Where the mass centre is at a scene frame (3,) [m], seen in all of the walk where that is asked for next."""
    first, last = moves.frame_range(scene, armature)
    endless = last - first + 1 > bounds.Limits().frames  # which is told of before it is recorded
    if recordings.current() is None or endless or not first <= frame <= last:
        first, last = frame - 1, frame
    return recordings.record(scene, armature, first, last, samples=1).com[0, frame - first]


def _stays(gait):
    """Whether the body of a recording of one walker comes nowhere."""
    return np.hypot(*(gait.com[0, -1] - gait.com[0, 0])[:2]) < cycle.MIN_SPEED * (gait.time[-1] - gait.time[0])


def _same_slot(action, slot):
    """The slot of an action that another one's stands for."""
    slots = getattr(action, "slots", ())
    return next((each for each in slots if slot is not None and each.identifier == slot.identifier), None)


def _keys(curves):
    return sum(len(each.keyframe_points) for each in curves)


def _repeats(curves):
    """Whether all curves that move anything go on by themselves for ever."""
    moving = [each for each in curves if len(each.keyframe_points) > 1]
    return bool(moving) and all(
        any(one.type == "CYCLES" and not one.mute and not one.cycles_after for one in each.modifiers) for each in moving
    )


def _repeat(curves, more):
    """Let curves repeat as one, the first frame again `more` frames after the last; False where they cannot."""
    moving = [each for each in curves if len(each.keyframe_points) > 1]
    if not moving or any(each.modifiers for each in curves):
        return False
    begin = min(each.keyframe_points[0].co[0] for each in moving)
    end = max(each.keyframe_points[-1].co[0] for each in moving)
    for each in moving:
        first, last = each.evaluate(begin), each.evaluate(end)
        if each.keyframe_points[0].co[0] > begin:
            each.keyframe_points.insert(begin, first)
        if each.keyframe_points[-1].co[0] < end:
            each.keyframe_points.insert(end, last)
        if more:
            each.keyframe_points.insert(end + more, first)
        each.update()
        each.modifiers.new("CYCLES")
    return True


def _stop(curves, until):
    """Let curves that repeat for ever do so only as often as they are whole before a frame; the frame they end at."""
    ends = []
    for curve in curves:
        for each in [one for one in curve.modifiers if one.type == "CYCLES" and not one.mute and not one.cycles_after]:
            begin, end = curve.keyframe_points[0].co[0], curve.keyframe_points[-1].co[0]
            more = int(max(0.0, until - end) / max(end - begin, 1e-6) + 1e-6)
            if more:
                each.cycles_after = more
            else:
                curve.modifiers.remove(each)
            ends.append(end + more * (end - begin))
    return max(ends)


def _go(scene, rig, curves, velocity, start, end, goes_on):
    """Key the delta location so that the object goes at a velocity (2,) [m/s] of the world, for ever or to a frame."""
    world = axes.matrix(rig.matrix_world, rig.name)
    above = world @ np.linalg.inv(np.array(rig.matrix_basis, np.float64))  # from its parent's space
    frame = np.array((*velocity, 0.0)) / (axes.unit_scale(scene) * clock.frame_rate(scene) / clock.stretch(scene))
    step = np.linalg.solve(above[:3, :3], frame)
    for axis in range(3):
        old = curves.find(DELTA, index=axis)
        if old is not None:
            curves.remove(old)
        base = rig.delta_location[axis]
        values = np.array([base, base + step[axis] * (end - start)], np.float32)
        posing.set_curve(curves, DELTA, axis, [start, end], values)
        curves.find(DELTA, index=axis).extrapolation = "LINEAR" if goes_on else "CONSTANT"


def _follow(scene, rig, curves, course, first, last, goes_on):
    """Key the object along a course, from a scene frame to another one; straight on where an open curve ends."""
    stretch, rate = clock.stretch(scene), clock.frame_rate(scene)
    frames = first + np.arange(max(last - first + 1, 2))
    scale = axes.unit_scale(scene)
    forward_curve.key(rig, curves, course, frames / stretch, (frames - first) / rate, scale, goes_on)
