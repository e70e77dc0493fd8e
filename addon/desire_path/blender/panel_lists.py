"""panel_lists.py - lists in the panels: painted soils, and kinds of plants."""

import bpy

from . import pictured
from .late import plants, tufts


class OBJECT_UL_desire_path_paint(bpy.types.UIList):
    """Soils and the vertex groups they are painted with"""

    def draw_item(self, context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        row = layout.row(align=True)
        row.label(text=item.vertex_group or "No Group", icon="GROUP_VERTEX")
        row.prop(item, "soil", text="")


class OBJECT_UL_desire_path_plants(bpy.types.UIList):
    """Kinds of plants that grow on a ground"""

    def draw_item(self, context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        row = layout.row(align=True)
        row.label(text=tufts.label(item.kind), icon_value=pictured.icon(item.kind))
        row.label(text=f"{item.count:,}")
        if plants.shown(item) is not None:
            row.prop(item.grass, "hide_viewport", text="", emboss=False)
            row.prop(item.grass, "hide_render", text="", emboss=False)


CLASSES = (OBJECT_UL_desire_path_paint, OBJECT_UL_desire_path_plants)
