"""op_track.py - a curve becomes a track, whose marks are shown; the tracks of a ground are pressed into it."""

import bpy
from bpy.props import EnumProperty

from . import messages, props_track
from .late import bake_job, track
from .ops import Refusal, active

ADDED = ("kind", "stamp", "vehicle")  # of a track, as it is added


class _OfCurve(Refusal):
    @classmethod
    def poll(cls, context):
        return active(cls, context, {"CURVE"}, "the curve that a track lies along")


class OBJECT_OT_desire_path_track_add(_OfCurve, bpy.types.Operator):
    """Let marks lie along the active curve, on its ground or the only one there is, and show where"""

    bl_idname = "object.desire_path_track_add"
    bl_label = "Add Track"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Leaves", items=props_track.KINDS, description="What leaves the track")
    stamp: EnumProperty(name="Stamp", items=props_track.STAMPS, description="The shape of the marks")
    vehicle: EnumProperty(name="Vehicle", items=props_track.VEHICLES, description="Whose wheels roll along")

    def work(self, context):
        obj = context.object
        settings = obj.desire_path.track
        if self.kind == "SOLE" and settings.sole is None or self.kind == "STAMPS" and self.stamp == "image":
            obj.desire_path.ground = track.choose_ground(context.scene, obj)
            settings.kind, settings.stamp, settings.is_track = self.kind, self.stamp, True
            if self.kind == "SOLE" or settings.image is None:
                messages.tell(self, "INFO", f"Choose what leaves the marks of '{obj.name}' in its panel.")
                return {"FINISHED"}
        land, count = track.settle(context.scene, obj, {name: getattr(self, name) for name in ADDED})
        lies = f"{count} marks lie" if count else "A rut lies"
        messages.tell(self, "INFO", f"{lies} along '{obj.name}' on '{land.name}': Press Tracks presses them.")
        return {"FINISHED"}


class OBJECT_OT_desire_path_track_remove(_OfCurve, bpy.types.Operator):
    """Let no marks lie along the active curve; what was pressed stays until tracks are pressed again"""

    bl_idname = "object.desire_path_track_remove"
    bl_label = "Remove Track"
    bl_options = {"REGISTER", "UNDO"}

    def work(self, context):
        track.forget(context.object)
        return {"FINISHED"}


class OBJECT_OT_desire_path_tracks_press(Refusal, bpy.types.Operator):
    """Press all tracks of this ground into it, in the order of their names, in place of those pressed before"""

    bl_idname = "object.desire_path_tracks_press"
    bl_label = "Press Tracks"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if bake_job.running() is not None:
            cls.poll_message_set("A bake is running, or something is pressed already")
            return False
        return active(cls, context, {"CURVE", "MESH"}, "the curve that a track lies along")

    def work(self, context):
        obj, scene = context.object, context.scene
        land = track.choose_ground(scene, obj) if obj.type == "CURVE" else obj
        sentences = []
        text = track.press_all(scene, land, sentences)
        for each in (*dict.fromkeys(sentences), text):
            messages.tell(self, "INFO", each)
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_track_add, OBJECT_OT_desire_path_track_remove, OBJECT_OT_desire_path_tracks_press)
