"""layer.py - a new action over the one in use: what it was stays, to go back to, and shows what it showed.

(action, slot) --a copy, keyed by a footing.Plan--> `<action>_<word>`, with the name of the first on it
"""

import math

import bpy
import numpy as np

from ..errors import DesirePathError
from . import axes, bones, compat, controls, footing, posing, private, sample

PLACED = "desire_path_placed_from"  # on a placed action: name of the one it was made from
BALANCED = "desire_path_balanced_from"  # on an action in which a body leans: the same
OFF = 0.02  # a foot this far from its place was held back, in leg lengths
OFF_TURN = math.radians(3.0)  # or a led one turned away from it by this [rad]


def plan(scene, armature, gait, placed, frames, lean=None):
    """A footing.Plan of an armature whose walk is to be another; lean: see there."""
    with private.private_scene(scene, armature) as own:
        world = axes.matrix(sample.evaluated(own, armature, frames[0]).matrix_world, armature.name)
        found = sample.rig(armature, bones.skeleton(armature, world, axes.unit_scale(scene)))
    return footing.Plan(scene, armature, found, gait, placed, frames, lean)


def first(animation, source):
    """(action, slot) that what is in use was made from by property `source`, else what is in use."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    return _made_from(action, slot, source) or (action, slot if action is not None else None)


def _made_from(action, slot, source):
    """(action, slot) that an action was made from by a property; None where there is none."""
    before = bpy.data.actions.get(action.get(source, "")) if action is not None else None
    if before is None:
        return None
    slots = getattr(before, "slots", ())
    same = [each for each in slots if slot is not None and each.identifier == slot.identifier]
    return before, same[0] if same else None


def write(scene, armature, of, planned, called):
    """Give an armature a new action made from another one; (action, what planned() told besides).

    of: (action, slot), or (None, None); planned() -> (Plan, properties of the new action, more), asked while that is
    played; called: (what comes after its name, the property that holds the first one's name)
    """
    animation = armature.animation_data or armature.animation_data_create()
    if animation is None:  # a library override that is locked
        raise DesirePathError(f"'{armature.name}' cannot be given keys: make its library override editable first.")
    before, before_slot = animation.action, getattr(animation, "action_slot", None)
    action, slot = of
    word, source = called
    if action is not None:
        compat.use_action(animation, action, slot)
    created = None
    try:
        todo, notes, more = planned()
        created = action.copy() if action is not None else bpy.data.actions.new(armature.name)
        created.name = f"{action.name if action is not None else armature.name}_{word}"
        for name, value in notes.items():
            created[name] = value
        if action is not None:
            created[source] = action.name
            action.use_fake_user = True  # to go back to, even after saving
        compat.use_action(animation, created, None)
        todo.write_all(scene, compat.curves(animation, armature))
        check(scene, armature, todo, todo.bones.frames)
        for each in (of, _made_from(action, slot, PLACED)):  # who goes back may go back to either
            if each is not None and each[0] is not None and each[0].library is None:
                hold(animation, armature, *each, todo.fresh, todo.keyed_at[0])
                compat.use_action(animation, created, None)
    except BaseException:
        if before is not None:
            compat.use_action(animation, before, before_slot)
        else:
            animation.action = None
        if created is not None:
            bpy.data.actions.remove(created)
        raise
    _drop(before, source, {action, created})
    return created, more


def _drop(before, source, kept):
    """Give up the action that was in use, where it was made so, too, and the one between it and the first."""
    between = bpy.data.actions.get(before.get(BALANCED, "")) if before is not None else None
    for each in (before, between):
        if each is None or each in kept or not each.get(source):
            continue
        each.use_fake_user = each.use_fake_user and each == before
        if each.users == 0:
            bpy.data.actions.remove(each)


def hold(animation, armature, action, slot, channels, frame):
    """Key what an action left to itself at the value it has, so that it shows the same after another."""
    compat.use_action(animation, action, slot)
    curves = compat.curves(animation, armature)
    for path, index, value in channels:
        if curves.find(path, index=index) is None:
            posing.set_curve(curves, path, index, [frame], np.array([value], np.float32))


def check(scene, armature, plan, frames):
    """Refuse where feet did not come to their places, or the hips did not follow: something else holds them."""
    some = range(len(frames))
    if not plan.leads:
        some = sorted({round(k) for k in np.linspace(0, len(frames) - 1, 12)})
    names = list(plan.goal) + ([plan.hips] if plan.leads and plan.hips else [])
    seen = posing.look(scene, armature, names, [frames[k] for k in some])
    for foot in plan.feet:
        goal = plan.goal[foot.foot][some]
        size = float(
            np.median(np.linalg.norm(plan.heads(foot.thigh) - plan.heads(foot.foot), axis=1))
            if foot.thigh
            else np.ptp(goal, axis=0).max()
        )
        checks = [(foot.foot, goal)]
        if foot.foot in plan.leads and plan.hips:
            checks.append((plan.hips, plan.carried(plan.hips)[some]))
        for name, wanted in checks:
            far = np.linalg.norm(seen.at(name)[:, :3, 3] - wanted, axis=1)
            if far.max() > OFF * max(size, 1e-9):
                refuse(
                    armature,
                    name,
                    f"{far.max() * plan.bones.scale:.2f} m from its place",
                    frames[some[int(far.argmax())]],
                )
        if foot.foot in plan.leads:
            turned = controls.between(seen.at(foot.foot), plan.turn[foot.foot][some])
            far = np.arccos(np.clip((np.trace(turned, axis1=1, axis2=2) - 1.0) / 2.0, -1.0, 1.0))
            if far.max() > OFF_TURN:
                refuse(
                    armature,
                    foot.foot,
                    f"turned by {np.degrees(far.max()):.0f} degrees from its place",
                    frames[some[int(far.argmax())]],
                )


def refuse(armature, name, how, frame):
    raise DesirePathError(
        f"Bone '{name}' of '{armature.name}' stays {how} at frame {frame}, since constraints or limits hold it: bake "
        "the animation to keys first (Pose > Animation > Bake Action, with Visual Keying and Clear Constraints)."
    )
