"""panels_walker.py - what an armature is taken for, bone by bone, and what its forces are."""

from . import op_forces
from .late import json, report
from .panels import _column, _letters, _lines, in_both


def draw_rig(layout, obj):
    """Every slot a walker has, each to be set by hand."""
    settings, bones = obj.desire_path, obj.data
    for index, foot in enumerate(settings.feet):
        box = layout.box()
        row = box.row(align=True)
        row.prop(foot, "limb", text="")
        row.operator("object.desire_path_foot_remove", text="", icon="X").index = index
        column = _column(box)
        for slot in ("foot", "toe", "heel"):
            column.prop_search(foot, slot, bones, "bones")
        legs = column.column(align=True)
        legs.prop_search(foot, "thigh", bones, "bones")
        legs.prop_search(foot, "shank", bones, "bones")
    layout.operator("object.desire_path_foot_add", icon="ADD")
    column = _column(layout)
    column.prop_search(settings, "hips", bones, "bones")
    column.prop_search(settings, "mass_center", bones, "bones")
    if not settings.mass_center:
        column.label(text="From the body", icon="INFO")


def draw_forces(layout, context, obj):
    settings = obj.desire_path
    shown, graph = op_forces.shows(obj), op_forces.shows_graph(obj)
    row = layout.row(align=True)
    row.operator(
        "object.desire_path_forces_show",
        text="Hide" if shown else "Show",
        icon="HIDE_OFF" if shown else "HIDE_ON",
        depress=shown,
    )
    row.operator("object.desire_path_forces_graph", text="Graph", icon="FCURVE", depress=graph)
    row = layout.row(align=True)
    row.operator("object.desire_path_forces_report", text="Report", icon="TEXT")
    row.operator("object.desire_path_forces_write", text="Tables", icon="EXPORT")
    if not settings.forces:
        return
    numbers, width = json.loads(settings.forces), _letters(context)
    column = layout.column(align=True)
    for each in report.sentences(numbers):
        _lines(column, each, "DOT", width)
    for each in numbers["warnings"]:
        _lines(column, each, "ERROR", width)


class _Rig:
    bl_options = {"DEFAULT_CLOSED"}
    bl_label = "Rig"

    @classmethod
    def poll(cls, context):  # feet can be chosen before an armature is a walker, where none are found
        return context.object is not None and context.object.type == "ARMATURE"

    def draw(self, context):
        draw_rig(self.layout, context.object)


class _Forces(_Rig):
    bl_label = "Forces"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.desire_path.is_walker

    def draw(self, context):
        draw_forces(self.layout, context, context.object)


CLASSES = (*in_both(_Rig, "_rig", ""), *in_both(_Forces, "_forces", ""))
