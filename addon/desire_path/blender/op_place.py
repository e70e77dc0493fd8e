"""op_place.py - the feet of an armature are put on its ground, in an action of its own.

    record -> place.place_feet (-> sink.into_prints) -> where feet and body go -> legs reach for them -> keys in a
    new action

The action it had stays, to go back to, and shows what it showed. Roots are carried, legs of two bones reach for
their feet, feet that hang on no leg are moved, and legs that follow an IK target have the target moved; feet that
constraints hold are led by the control bones found for them.
"""

import bpy
from bpy.props import BoolProperty

from ..errors import DesirePathError
from .late import (
    baking,
    home,
    json,
    layer,
    moves,
    np,
    place,
    playback,
    recordings,
    sample,
    settle_feet,
    slope,
    trodden,
    walker,
)
from .messages import tell
from .ops import Refusal, active

SOURCE = "desire_path_placed_from"  # on a placed action: name of the one it was made from


def frames_of(scene, armature, land):
    """Scene frames of the armature's animation and of its ground's bake."""
    first, last = moves.frame_range(scene, armature)
    if not land.desire_path.frames_auto:
        first = min(first, land.desire_path.frame_start)
        last = max(last, land.desire_path.frame_end)
    return list(range(first, last + 1))


def read(scene, armature, land, frames, prints):
    """(the walk as it is, the walk as it should be, warnings); prints: feet go down into those that are baked."""
    gait, below, beside, warnings = recorded(scene, armature, land, frames)
    placed = place.place_feet(gait, below)
    if prints:
        film = settle_feet.Films(
            [
                settle_feet.Film(baking.read_index(home.folder(each)))
                for each in (land, *beside)
                if each == land or playback.modifier(each) is not None
            ]
        )
        loads = walker.loads(placed, armature.desire_path.load_model, ground=below.rest_height)
        placed = settle_feet.into_prints(placed, loads, film, below.rest_height)
    return gait, placed, warnings


def source(armature):
    """(action, slot) the feet are placed from: the one a placed action was made of, else the one in use."""
    animation = armature.animation_data
    return (None, None) if animation is None else layer.first(animation, SOURCE)


def recorded(scene, armature, land, frames):
    """(the walk as it is, the ground below it, grounds beside that one, warnings)."""
    gait = recordings.record(scene, armature, frames[0], frames[-1], samples=1)
    below, beside, warnings = trodden.under(scene, armature, land, gait, frames[0])
    if slope.steep(below, gait) and not place.carries(gait, below, 0):  # of a level floor its feet lay level
        gait = sample.record(scene, armature, frames[0], frames[-1], samples=1, land=below)
    return gait, below, beside, warnings


def bake(scene, armature, land, prints=False):
    """Give an armature a new action with its feet on the ground, or in their prints; (action, warnings)."""

    def planned():
        frames = frames_of(scene, armature, land)
        gait, placed, warnings = read(scene, armature, land, frames, prints)
        if np.abs(placed.pose - gait.pose).max() < 1e-6 and np.abs(placed.com - gait.com).max() < 1e-6:
            raise DesirePathError(
                f"The feet of '{armature.name}' lie on '{land.name}' already: there is nothing to place."
            )
        plan = layer.plan(scene, armature, gait, placed, frames)
        return plan, {sample.PLACED: json.dumps(plan.shapes)}, tuple(warnings)

    return layer.write(scene, armature, source(armature), planned, ("placed", SOURCE))


class OBJECT_OT_desire_path_place_feet(Refusal, bpy.types.Operator):
    """Put the feet of the active armature on its ground: up, down and across slopes, carried there from a level \
floor. Makes a new action; the one it had stays"""

    bl_idname = "object.desire_path_place_feet"
    bl_label = "Place Feet"
    bl_options = {"REGISTER", "UNDO"}

    into_prints: BoolProperty(
        name="Sink into Prints", description="Let the feet down into the prints that are baked, and the body with them"
    )

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"ARMATURE"}, "the armature that walks")

    def work(self, context):
        obj = context.object
        land = obj.desire_path.ground
        if land is None:
            raise DesirePathError(f"'{obj.name}' walks on no ground yet: press Add Walker, or choose its ground.")
        context.view_layer.update()
        action, warnings = bake(context.scene, obj, land, self.into_prints)
        for each in warnings:
            tell(self, "WARNING", each)
        back, where = action.get(SOURCE), "in the prints of" if self.into_prints else "on"
        tell(
            self,
            "INFO",
            f"'{obj.name}' plays '{action.name}', its feet {where} '{land.name}'"
            + (f"; '{back}' is as it was." if back else "."),
        )
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_place_feet,)
