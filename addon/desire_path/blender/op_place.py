"""op_place.py - the feet of an armature are put on its ground, in an action of its own.

    record -> place.place_feet (-> sink.into_prints) -> where feet and body go -> legs reach for them -> keys in a
    new action

The action it had stays, to go back to, and shows what it showed. Roots are carried, legs of two bones reach for
their feet, feet that hang on no leg are moved, and legs that follow an IK target have the target moved; feet that
constraints hold are led by the control bones found for them.
"""

import math

import bpy
from bpy.props import BoolProperty

from ..errors import DesirePathError
from . import compat
from .late import (
    axes,
    baking,
    controls,
    footing,
    home,
    json,
    moves,
    np,
    place,
    playback,
    posing,
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
OFF = 0.02  # a foot this far from its place was held back, in leg lengths
OFF_TURN = math.radians(3.0)  # or a led one turned away from it by this [rad]


def frames_of(scene, armature, land):
    """Scene frames of the armature's animation and of its ground's bake."""
    first, last = moves.frame_range(scene, armature)
    if not land.desire_path.frames_auto:
        first = min(first, land.desire_path.frame_start)
        last = max(last, land.desire_path.frame_end)
    return list(range(first, last + 1))


def read(scene, armature, land, frames, prints):
    """(the walk as it is, the walk as it should be, warnings); prints: feet go down into those that are baked."""
    gait = recordings.record(scene, armature, frames[0], frames[-1], samples=1)
    below, beside, warnings = trodden.under(scene, armature, land, gait, frames[0])
    if slope.steep(below, gait) and not place.carries(gait, below, 0):  # of a level floor its feet lay level
        gait = sample.record(scene, armature, frames[0], frames[-1], samples=1, land=below)
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
    if animation is None or animation.action is None:
        return None, None
    action, slot = animation.action, getattr(animation, "action_slot", None)
    first = bpy.data.actions.get(action.get(SOURCE, ""))
    if first is None:
        return action, slot
    slots = getattr(first, "slots", ())
    same = [each for each in slots if slot is not None and each.identifier == slot.identifier]
    return first, same[0] if same else None


def bake(scene, armature, land, prints=False):
    """Give an armature a new action with its feet on the ground, or in their prints; (action, warnings)."""
    animation = armature.animation_data or armature.animation_data_create()
    if animation is None:  # a library override that is locked
        raise DesirePathError(f"'{armature.name}' cannot be given keys: make its library override editable first.")
    before, before_slot = animation.action, getattr(animation, "action_slot", None)
    action, slot = source(armature)
    if action is not None:
        compat.use_action(animation, action, slot)
    placed_action = None
    try:
        frames = frames_of(scene, armature, land)
        gait, placed, warnings = read(scene, armature, land, frames, prints)
        if np.abs(placed.pose - gait.pose).max() < 1e-6 and np.abs(placed.com - gait.com).max() < 1e-6:
            raise DesirePathError(
                f"The feet of '{armature.name}' lie on '{land.name}' already: there is nothing to place."
            )
        with sample.private_scene(scene, armature) as own:
            world = axes.matrix(sample.evaluated(own, armature, frames[0]).matrix_world, armature.name)
            found = sample.rig(armature, sample.skeleton(armature, world, axes.unit_scale(scene)))
        plan = footing.Plan(scene, armature, found, gait, placed, frames)
        placed_action = action.copy() if action is not None else bpy.data.actions.new(armature.name)
        placed_action.name = f"{action.name if action is not None else armature.name}_placed"
        placed_action[sample.PLACED] = json.dumps(plan.shapes)
        if action is not None:
            placed_action[SOURCE] = action.name
            action.use_fake_user = True  # to go back to, even after saving
        compat.use_action(animation, placed_action, None)
        curves = compat.curves(animation, armature)
        plan.write_all(scene, curves)
        check(scene, armature, plan, frames)
        if action is not None and action.library is None:
            hold(animation, armature, action, slot, plan.fresh, plan.keyed_at[0])
            compat.use_action(animation, placed_action, None)
    except BaseException:
        if before is not None:
            compat.use_action(animation, before, before_slot)
        else:
            animation.action = None
        if placed_action is not None:
            bpy.data.actions.remove(placed_action)
        raise
    if before is not None and before != action and before.get(SOURCE) and before.users == 0:
        bpy.data.actions.remove(before)
    return placed_action, tuple(warnings)


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
