"""panel_lists.py - lists in the panels: painted soils, and kinds of plants."""

import bpy

from .late import plants, tufts


class OBJECT_UL_desire_path_paint(bpy.types.UIList):
    """Soils and the vertex groups they are painted with"""

    def draw_item(self, context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        row = layout.row(align=True)
        row.prop_search(item, "vertex_group", context.object, "vertex_groups", text="")
        row.prop(item, "soil", text="")


class OBJECT_UL_desire_path_plants(bpy.types.UIList):
    """Kinds of plants that grow on a ground"""

    def draw_item(self, context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        row = layout.row(align=True)
        row.label(text=tufts.label(item.kind))
        row.label(text=f"{item.count:,}")
        if plants.shown(item) is not None:
            row.prop(item.grass, "hide_viewport", text="", emboss=False)
            row.prop(item.grass, "hide_render", text="", emboss=False)


CLASSES = (OBJECT_UL_desire_path_paint, OBJECT_UL_desire_path_plants)
