"""op_walkers.py - walkers are chosen with their feet, and a walk is recorded to a file."""

import bpy
from bpy.props import IntProperty, StringProperty

from ..errors import DesirePathError
from .chosen import WALKERS, grounds, walkers
from .late import axes, bodies, bones, ground, moves, plants, rigs, sample, show, sim
from .messages import tell
from .ops import AsksFirst, Refusal, active


def detect(scene, obj, keep=False):
    """Find an armature's feet and hips and fill its slots; `keep` those that were chosen and fit."""
    settings = obj.desire_path
    shape = bones.skeleton(obj, axes.matrix(obj.matrix_world, obj.name), axes.unit_scale(scene))
    if keep and settings.feet:
        try:
            return sample.rig(obj, shape)
        except DesirePathError:
            pass  # they are of another rig
    found = rigs.detect(shape)
    settings.feet.clear()
    for number, foot in enumerate(found.feet):  # a library override cannot remove what its library has
        each = settings.feet[number] if number < len(settings.feet) else settings.feet.add()
        each.name = foot.limb  # by which a library override knows it again
        for name in ("limb", "foot", "toe", "heel", "thigh", "shank"):
            setattr(each, name, getattr(foot, name, None) or "")
    settings.hips = found.hips or ""
    return found


class OBJECT_OT_desire_path_rig_detect(Refusal, bpy.types.Operator):
    """Find the feet, toes, heels and hips of the active armature; each can be changed by hand then"""

    bl_idname = "object.desire_path_rig_detect"
    bl_label = "Find Feet"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"ARMATURE"}, "the armature that walks")

    def work(self, context):
        obj = context.object
        found = detect(context.scene, obj)
        for each in found.warnings:
            tell(self, "WARNING", each)
        feet = "; ".join(
            f"{foot.limb}: " + ", ".join(name for name in (foot.foot, foot.toe, foot.heel) if name)
            for foot in found.feet
        )
        tell(
            self,
            "INFO",
            f"'{obj.name}' has {len(found.feet)} feet ({feet}) and "
            + (f"hangs on {found.hips}." if found.hips else "no hips bone."),
        )
        return {"FINISHED"}


class OBJECT_OT_desire_path_foot_add(bpy.types.Operator):
    """Add a foot that was not found; the active bone is taken for it, another can be chosen"""

    bl_idname = "object.desire_path_foot_add"
    bl_label = "Add Foot"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"ARMATURE"}, "the armature that walks")

    def execute(self, context):
        obj = context.object
        feet = obj.desire_path.feet
        bone = obj.data.bones.active
        taken = {each.foot for each in feet}
        each = feet.add()
        each.name = each.limb = f"foot {len(feet)}"
        if bone is not None and bone.name not in taken:
            each.foot = bone.name
        return {"FINISHED"}


class OBJECT_OT_desire_path_foot_remove(bpy.types.Operator):
    """Let this foot leave no prints; Find Feet brings it back"""

    bl_idname = "object.desire_path_foot_remove"
    bl_label = "Remove Foot"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(name="Foot", min=0, description="Which of the feet, counted from 0")

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"ARMATURE"}, "the armature that walks") and bool(context.object.desire_path.feet)

    def execute(self, context):
        feet = context.object.desire_path.feet
        if self.index >= len(feet):
            tell(self, "ERROR", f"There is no foot {self.index}: '{context.object.name}' has {len(feet)}.")
            return {"CANCELLED"}
        feet.remove(self.index)
        return {"FINISHED"}


def add(context, obj):
    """Let an armature or a mesh walk on a ground; returns what is to be told: levels of reports and sentences."""
    scene, settings = context.scene, obj.desire_path
    ground = _ground(context, settings.ground)
    means, sentences = _means(scene, obj)
    settings.is_walker = True
    settings.ground = ground
    moves.follow(scene, ground, walkers(scene, ground))
    text = f"'{obj.name}' walks on '{ground.name}' {means}."
    return [*(("WARNING", each) for each in sentences), ("INFO", text)]


def _means(scene, obj):
    """(by what a walker leaves prints, in words; sentences about it)"""
    if obj.type == "ARMATURE" and obj.desire_path.limbs == "ALL":
        return "with all that hangs on its bones", ()
    if obj.type == "ARMATURE":
        found = detect(scene, obj, keep=not obj.desire_path.is_walker)
        shape = bones.skeleton(obj, axes.matrix(obj.matrix_world, obj.name), axes.unit_scale(scene))
        odd = sample.odd_size(obj, shape, found)
        return "with " + ", ".join(foot.foot for foot in found.feet), tuple(found.warnings) + (odd[:1] if odd else ())
    bound = [each.object for each in obj.modifiers if each.type == "ARMATURE" and each.object is not None]
    if bound or obj.parent is not None and obj.parent.type == "ARMATURE":
        rig = bound[0] if bound else obj.parent
        raise DesirePathError(f"'{obj.name}' is moved by the armature '{rig.name}': select that, and press Add Walker.")
    if not len(obj.data.polygons) and not obj.modifiers:
        raise DesirePathError(f"'{obj.name}' has no faces to press the ground with: give it some.")
    return "as a rigid body", ()


def _ground(context, chosen):
    """The ground chosen before, a selected one, or the only one."""
    there = grounds(context.scene)
    if chosen is not None and chosen in there:
        return chosen
    selected = [obj for obj in context.selected_objects if obj in there]
    if len(selected) == 1:
        return selected[0]
    if not there:
        raise DesirePathError("There is no ground yet: select the mesh that is walked on and press Add Ground.")
    if len(there) > 1:
        raise DesirePathError(
            "There are several grounds: select the one to walk on together with the armature, the armature last."
        )
    return there[0]


class OBJECT_OT_desire_path_walker_add(Refusal, bpy.types.Operator):
    """Let the active armature or mesh leave prints"""

    bl_description = (
        "Let the active armature leave prints, by the feet found in it, or the active mesh, as a rigid body; joins it "
        "to the ground"
    )
    bl_idname = "object.desire_path_walker_add"
    bl_label = "Add Walker"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not active(cls, context, WALKERS, "the armature that walks, or a mesh that moves"):
            return False
        if context.object.desire_path.is_ground:
            cls.poll_message_set("This is a ground: select the armature that walks on it, or a mesh that moves")
            return False
        return True

    def work(self, context):
        for level, text in add(context, context.object):
            tell(self, level, text)
        return {"FINISHED"}


class OBJECT_OT_desire_path_remove(AsksFirst, Refusal, bpy.types.Operator):
    """Let the active object be a ground or walker no more; frees its bake"""

    bl_idname = "object.desire_path_remove"
    bl_label = "Remove"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = context.object
        return obj is not None and obj.mode != "EDIT" and (obj.desire_path.is_ground or obj.desire_path.is_walker)

    def work(self, context):
        obj = context.object
        settings = obj.desire_path
        if settings.is_ground:
            show.free(obj)
            for each in settings.plants:
                plants.forget(each)
            settings.plants.clear()
            settings.is_ground = False
        settings.is_walker = False
        settings.ground = None
        return {"FINISHED"}


def _land(scene, obj, gait, first):
    """The ground of a walker as it is to be asked for heights; without one: flat at 0."""
    on = obj.desire_path.ground
    if on is None:
        return sim.Simulation(sim.Ground.flat())
    cell = axes.typed(on.desire_path.cell_size)
    return ground.land(ground.read(scene, on, cell, first, box=ground.under(gait)), cell)


class OBJECT_OT_desire_path_record(Refusal, bpy.types.Operator):
    """Write what the active walker does to a file that bakes without Blender"""

    bl_idname = "object.desire_path_record"
    bl_label = "Record Walk"
    bl_options = {"REGISTER"}

    filepath: StringProperty(
        name="File", subtype="FILE_PATH", default="walk.npz", description="Where the recording is written"
    )
    filter_glob: StringProperty(default="*.npz", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return active(cls, context, WALKERS, "the armature that walks, or a mesh that moves", changed=False)

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        obj, scene = context.object, context.scene
        context.view_layer.update()
        ground = obj.desire_path.ground
        if ground is not None:
            first, last = moves.frames(scene, ground, walkers(scene, ground))
        else:
            first, last = moves.frame_range(scene, obj)
        gait = sample.gaits(scene, [obj], first, last)
        gait = bodies.laws([obj], gait, lambda: _land(scene, obj, gait, first))
        path = bpy.path.abspath(self.filepath)
        gait.save(path)
        for each in gait.warnings:
            tell(self, "WARNING", each)
        tell(self, "INFO", f"Recorded frames {first} to {last} of '{obj.name}' to {path}.")
        return {"FINISHED"}


CLASSES = (
    OBJECT_OT_desire_path_walker_add,
    OBJECT_OT_desire_path_rig_detect,
    OBJECT_OT_desire_path_foot_add,
    OBJECT_OT_desire_path_foot_remove,
    OBJECT_OT_desire_path_remove,
    OBJECT_OT_desire_path_record,
)
