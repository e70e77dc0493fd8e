"""op_ground.py - a mesh is made a ground, and soils are painted on it."""

import bpy

from ..errors import DesirePathError
from . import auto
from .late import home
from .messages import tell
from .ops import Refusal, active, take_off
from .translations import say


def add(scene, obj):
    """Make a mesh a ground; returns a sentence."""
    if not len(obj.data.polygons) and not obj.modifiers:
        raise DesirePathError(f"'{obj.name}' has no faces: give it some to walk on.")
    settings = obj.desire_path
    settings.is_ground = True
    home.settle(obj)
    if settings.frames_auto:
        auto.set_auto(settings, frame_start=scene.frame_start, frame_end=scene.frame_end)
    text = f"'{obj.name}' is a ground"
    if not bpy.data.filepath and settings.folder_auto:
        text += f"; until the file is saved its bake goes to the temporary folder {settings.folder}"
    return text + "."


class OBJECT_OT_desire_path_ground_add(Refusal, bpy.types.Operator):
    """Make the active mesh a ground in which walkers leave prints"""

    bl_idname = "object.desire_path_ground_add"
    bl_label = "Add Ground"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = context.object
        if obj is not None and obj.type == "EMPTY" and obj.instance_collection is not None:
            cls.poll_message_set(
                say(
                    "'{}' shows instances of a collection: make them real (Object > Apply > Make Instances Real) and "
                    "select the mesh that is walked on",
                    obj.name,
                )
            )
            return False
        return active(cls, context, {"MESH"}, "the mesh that is walked on")

    def work(self, context):
        tell(self, "INFO", add(context.scene, context.object))
        return {"FINISHED"}


class OBJECT_OT_desire_path_paint_add(bpy.types.Operator):
    """Add a soil that lies where a vertex group is painted"""

    bl_idname = "object.desire_path_paint_add"
    bl_label = "Add Painted Soil"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "a ground") and context.object.desire_path.is_ground

    def execute(self, context):
        obj = context.object
        settings = obj.desire_path
        each = settings.painted.add()
        if obj.vertex_groups.active is not None:
            each.vertex_group = obj.vertex_groups.active.name
        settings.painted_index = len(settings.painted) - 1
        return {"FINISHED"}


class OBJECT_OT_desire_path_paint_remove(bpy.types.Operator):
    """Remove the painted soil from the list; the vertex group stays"""

    bl_idname = "object.desire_path_paint_remove"
    bl_label = "Remove Painted Soil"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "a ground") and bool(context.object.desire_path.painted)

    def execute(self, context):
        take_off(context.object.desire_path, "painted")
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_ground_add, OBJECT_OT_desire_path_paint_add, OBJECT_OT_desire_path_paint_remove)
