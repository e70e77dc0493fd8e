"""forward.py - a clip that walks in place goes ahead with its character: an action of its own, that can be left.

    the action in use --a copy, repeated if it loops, delta location at the speed of the feet--> `<action>_carried`

The user's action stays as it is; delta location moves the object wherever its own keys, bones and controls are.
"""

import bpy
import numpy as np

from ..errors import DesirePathError
from ..placement import cycle
from . import axes, clock, compat, moves, posing, sample

SOURCE = "desire_path_carried_from"  # on an action of ours: name of the one it was made from, "" where there was none
DELTA = "delta_location"


def is_carried(armature):
    """Whether a character goes ahead by an action of ours."""
    animation = armature.animation_data
    return animation is not None and animation.action is not None and SOURCE in animation.action


def carry(scene, armature):
    """Let a character whose clip walks in place go ahead; returns a sentence, empty where there was nothing to do."""
    if is_carried(armature):
        return ""
    first, last = moves.frame_range(scene, armature)
    gait = sample.record(scene, armature, first, last)
    velocity = cycle.ahead(gait)
    if velocity is None:
        return ""
    animation = armature.animation_data or armature.animation_data_create()
    if animation is None:
        raise DesirePathError(f"'{armature.name}' cannot be given keys: make its library override editable first.")
    made = _action(armature, animation)
    curves = compat.curves(animation, armature)
    again = cycle.loops(gait)
    for each in curves if again else ():
        if not each.modifiers:
            each.modifiers.new("CYCLES")
    _go(scene, armature, curves, velocity, first / clock.stretch(scene))
    armature.update_tag()
    text = f"'{armature.name}' walks in place and is carried ahead at {np.hypot(*velocity):.2f} m/s"
    return text + (", its clip repeated" if again else "") + f": action '{made.name}'; Carried switches it off."


def switch(armature, on):
    """Let a character go ahead, or walk in place as it did."""
    if on and not is_carried(armature):
        scene = next(iter(armature.users_scene), bpy.context.scene)
        carry(scene, armature)
    elif not on and is_carried(armature):
        animation, ours = armature.animation_data, armature.animation_data.action
        first = bpy.data.actions.get(ours[SOURCE])
        if first is not None:
            compat.use_action(animation, first, _same_slot(first, getattr(animation, "action_slot", None)))
        else:
            animation.action = None
        armature.delta_location = ours["desire_path_delta"]
        if ours.users == 0:
            bpy.data.actions.remove(ours)


def _action(armature, animation):
    """A copy of the action in use, or a new one, in its place."""
    action, slot = animation.action, getattr(animation, "action_slot", None)
    made = action.copy() if action is not None else bpy.data.actions.new(armature.name)
    made.name = f"{action.name if action is not None else armature.name}_carried"
    made[SOURCE] = action.name if action is not None else ""
    made["desire_path_delta"] = armature.delta_location
    if action is not None:
        action.use_fake_user = True  # to go back to, even after saving
    compat.use_action(animation, made, _same_slot(made, slot))
    return made


def _same_slot(action, slot):
    """The slot of an action that another one's stands for."""
    return next(
        (each for each in getattr(action, "slots", ()) if slot is not None and each.identifier == slot.identifier), None
    )


def _go(scene, armature, curves, velocity, start):
    """Key the delta location so that the object goes on at a velocity (2,) [m/s] of the world from a frame on."""
    world = axes.matrix(armature.matrix_world, armature.name)
    above = world @ np.linalg.inv(np.array(armature.matrix_basis, np.float64))  # from its parent's space
    frame = np.array((*velocity, 0.0)) / (axes.unit_scale(scene) * clock.frame_rate(scene) / clock.stretch(scene))
    step = np.linalg.solve(above[:3, :3], frame)
    for axis in range(3):
        old = curves.find(DELTA, index=axis)
        if old is not None:
            curves.remove(old)
        base = armature.delta_location[axis]
        posing.set_curve(curves, DELTA, axis, [start, start + 1.0], np.array([base, base + step[axis]], np.float32))
        curves.find(DELTA, index=axis).extrapolation = "LINEAR"
