"""op_crowd.py - a crowd goes between the selected empties, and wears the paths it chooses; its panel."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from . import messages
from .late import crowd
from .ops import Refusal, active
from .panels import in_both

COVERS = (
    ("meadow", "Meadow", "Grass that wears, and draws walkers where it is worn"),
    ("lawn", "Lawn", "Grass that hardly costs more than a firm way"),
    ("brush", "Brush", "High plants, which walkers go round"),
    ("sand", "Sand", "Loose ground that does not wear"),
    ("snow-15", "Snow 15 cm", "Snow in which feet sink by 15 cm, until it is trodden"),
    ("snow-25", "Snow 25 cm", "Snow in which feet sink by 25 cm, until it is trodden"),
    ("snow-35", "Snow 35 cm", "Snow in which feet sink by 35 cm, until it is trodden"),
)


class OBJECT_OT_desire_path_crowd_add(Refusal, bpy.types.Operator):
    """Let a crowd go between the selected empties, round the selected meshes, and show its last ways"""

    bl_idname = "object.desire_path_crowd_add"
    bl_label = "Add Crowd"
    bl_options = {"REGISTER", "UNDO"}

    ground: EnumProperty(name="Ground", items=COVERS, description="What the crowd walks on")
    passages: IntProperty(
        name="Passages", default=1000, min=1, max=1_000_000, description="How often somebody goes from place to place"
    )
    per_day: FloatProperty(
        name="A Day", default=30.0, min=0.001, max=1e6, description="So many of the passages are those of one day"
    )
    seed: IntProperty(name="Seed", min=0, description="Of who goes where, and how")

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"EMPTY"}, "an empty that the crowd goes to", changed=False)

    def work(self, context):
        window = context.window_manager
        window.progress_begin(0.0, 1.0)
        try:
            numbers = {name: getattr(self, name) for name in ("ground", "passages", "per_day", "seed")}
            text, shown = crowd.walk(context.scene, context.selected_objects, numbers, window.progress_update)
        finally:
            window.progress_end()
        messages.tell(self, "INFO", text)
        shown.select_set(False)
        return {"FINISHED"}


class _Crowd:
    bl_label = "Desire Path"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "EMPTY"

    def draw(self, context):
        row = self.layout.row()
        row.scale_y = 1.4
        row.operator("object.desire_path_crowd_add", icon="OUTLINER_OB_CURVE")


CLASSES = (OBJECT_OT_desire_path_crowd_add, *in_both(_Crowd, "_crowd"))
