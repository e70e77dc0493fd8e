"""op_layers.py - soils are laid on a ground, one on the other; the list of them in Properties and the sidebar."""

import bpy
from bpy.props import EnumProperty

from ..errors import DesirePathError
from . import soils
from .compat import WORDS
from .late import layers
from .ops import Refusal, active, chosen_in, take_off
from .panels import _column, _Ground, in_both

UP, DOWN = "UP", "DOWN"


class _OfLayers(Refusal):
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not active(cls, context, {"MESH"}, "a ground"):
            return False
        if not context.object.desire_path.is_ground:
            cls.poll_message_set("Select a ground first")
            return False
        return True


class OBJECT_OT_desire_path_layer_add(_OfLayers, bpy.types.Operator):
    """Lay another soil on the ground, on top of all that lie there"""

    bl_idname = "object.desire_path_layer_add"
    bl_label = "Add Layer"

    def work(self, context):
        settings = context.object.desire_path
        if len(settings.layers) >= layers.MOST:
            raise DesirePathError(
                f"'{context.object.name}' has {layers.MOST} layers, which is the most: remove one first."
            )
        settings.layers.add()
        settings.layers.move(len(settings.layers) - 1, 0)
        settings.layers_index = 0
        return {"FINISHED"}


class OBJECT_OT_desire_path_layer_remove(_OfLayers, bpy.types.Operator):
    """Take the layer off the ground; its vertex group stays"""

    bl_idname = "object.desire_path_layer_remove"
    bl_label = "Remove Layer"
    bl_translation_context = WORDS

    def work(self, context):
        _chosen(context.object)
        take_off(context.object.desire_path, "layers")
        return {"FINISHED"}


class OBJECT_OT_desire_path_layer_move(_OfLayers, bpy.types.Operator):
    """Move the layer above or below another one"""

    bl_idname = "object.desire_path_layer_move"
    bl_label = "Move Layer"
    bl_translation_context = WORDS

    direction: EnumProperty(
        name="Direction",
        items=((UP, "Up", "Above the one that lies on it"), (DOWN, "Down", "Below the one it lies on")),
        description="Where the layer goes",
    )

    def work(self, context):
        settings = context.object.desire_path
        place = _chosen(context.object)
        to = place + (1 if self.direction == DOWN else -1)
        if 0 <= to < len(settings.layers):
            settings.layers.move(place, to)
            settings.layers_index = to
        return {"FINISHED"}


def _chosen(obj):
    """The place of the layer that is chosen in the list."""
    settings = obj.desire_path
    if not settings.layers:
        raise DesirePathError(f"Nothing lies on '{obj.name}' yet: add a layer first.")
    return chosen_in(settings, "layers")


# ---- panels ----------------------------------------------------------------------------------------------


class OBJECT_UL_desire_path_layers(bpy.types.UIList):
    """Soils that lie on the ground, from the top down"""

    def draw_item(self, _context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        row = layout.row(align=True)
        row.prop(item, "soil", text="")
        row.prop(item, "thickness_length", text="")


def draw(layout, obj):
    settings = obj.desire_path
    row = layout.row()
    row.template_list("OBJECT_UL_desire_path_layers", "", settings, "layers", settings, "layers_index", rows=2)
    side = row.column(align=True)
    side.operator("object.desire_path_layer_add", text="", icon="ADD")
    side.operator("object.desire_path_layer_remove", text="", icon="REMOVE")
    if len(settings.layers) > 1:
        side.operator("object.desire_path_layer_move", text="", icon="TRIA_UP").direction = UP
        side.operator("object.desire_path_layer_move", text="", icon="TRIA_DOWN").direction = DOWN
    if settings.layers:
        chosen = settings.layers[min(settings.layers_index, len(settings.layers) - 1)]
        column = _column(layout)
        column.prop_search(chosen, "group", obj, "vertex_groups")
        soils.draw(column, chosen, save=False)


class _Layers(_Ground):
    bl_label = "Layers"
    bl_order = 2

    def draw(self, context):
        draw(self.layout, context.object)


CLASSES = (
    OBJECT_OT_desire_path_layer_add,
    OBJECT_OT_desire_path_layer_remove,
    OBJECT_OT_desire_path_layer_move,
    OBJECT_UL_desire_path_layers,
    *in_both(_Layers, "_layers", ""),
)
