"""op_balance.py - the body of an armature leans into slopes and swings on giving ground, in an action of its own.

record -> balance.lean: by how much -> footing.Plan: hips turn about the mass centre, legs reach for the feet where
they were -> keys in a new action over the one in use
"""

import math

import bpy
from bpy.props import BoolProperty, FloatProperty

from ..errors import DesirePathError
from .late import balance, compat, layer, np
from .op_place import frames_of, recorded
from .ops import TakenOff

LEAST = math.radians(0.5)  # who leans less anywhere stands as well as not


def bake(scene, armature, land, options):
    """Give an armature a new action in which its body leans; (action, a balance.Lean, warnings)."""

    def planned():
        frames = frames_of(scene, armature, land)
        gait, below, _, warnings = recorded(scene, armature, land, frames)
        lean = balance.lean(gait, below.rest_height, options=options)
        if np.abs(lean.angle).max() < LEAST:
            raise DesirePathError(
                f"'{armature.name}' would hardly lean, for its feet stand level: press Place Feet on a slope or Sink "
                "into Prints first, or let it lean more."
            )
        return layer.plan(scene, armature, gait, gait, frames, lean.turns()), {}, (lean, tuple(warnings))

    animation = armature.animation_data
    of = (None, None) if animation is None else layer.first(animation, layer.BALANCED)
    action, (lean, warnings) = layer.write(scene, armature, of, planned, ("balanced", layer.BALANCED))
    return action, lean, warnings


def remove(armature):
    """Let an armature play the action that its balanced one was made from; its name."""
    animation = armature.animation_data
    action = animation.action if animation is not None else None
    if action is None or not action.get(layer.BALANCED):
        raise DesirePathError(f"'{armature.name}' plays no action that Balance made: there is nothing to take off.")
    before, slot = layer.first(animation, layer.BALANCED)
    if before == action:
        raise DesirePathError(
            f"The action '{action[layer.BALANCED]}' that '{action.name}' was made from is gone: undo, or choose "
            "another action."
        )
    compat.use_action(animation, before, slot)
    if action.users == 0:
        bpy.data.actions.remove(action)
    return before.name


class OBJECT_OT_desire_path_balance(TakenOff, bpy.types.Operator):
    """Let the body of the active armature lean into slopes and swing on ground that gives way, its feet staying where \
they are. Makes a new action; the one it had stays"""

    bl_idname = "object.desire_path_balance"
    bl_label = "Balance"
    bl_options = {"REGISTER", "UNDO"}

    share: FloatProperty(
        name="Lean",
        default=0.5,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        description="By which share of the slope under its feet the body leans",
    )
    stiffness: FloatProperty(
        name="Stiffness",
        default=30.0,
        min=1.0,
        max=1000.0,
        description="How soon the body follows the ground, in newtons for a mass centre 1 m high",
    )
    damping: FloatProperty(
        name="Damping",
        default=6.0,
        min=0.1,
        max=1000.0,
        description="How little it swings, in newton metre seconds for a mass centre 1 m high",
    )
    remove: BoolProperty(name="Take Off", description="Play the action again that the balanced one was made from")

    take_off = staticmethod(remove)

    def change(self, scene, obj, land):
        options = balance.BalanceOptions(share=self.share, stiffness=self.stiffness, damping=self.damping)
        action, lean, warnings = bake(scene, obj, land, options)
        low, high = (round(math.degrees(each)) for each in (lean.angle.min(), lean.angle.max()))
        back = action.get(layer.BALANCED)
        return warnings, f"'{obj.name}' plays '{action.name}', leaning by {low} to {high} degrees" + (
            f"; '{back}' is as it was." if back else "."
        )


CLASSES = (OBJECT_OT_desire_path_balance,)
