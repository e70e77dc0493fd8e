"""panels.py - Properties > Physics > Desire Path, and the same in the sidebar."""

import bpy

from ..errors import DesirePathError
from . import arrival, panel_lists, soil_presets, soils
from .chosen import grounds, walkers
from .compat import WORDS, prop
from .late import bake_job, forward, json, plants, sentences, state

BOXED = 3  # letters that a box takes of a line


def _column(layout):
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout.column()


def draw(layout, context):
    obj = context.object
    if obj is not None and not obj.desire_path.is_ground and not obj.desire_path.is_walker:
        row = layout.row()
        row.scale_y = 1.4
        row.operator("object.desire_path_walk_it", icon="MOD_DYNAMICPAINT")
        layout.operator("object.desire_path_press", icon="BRUSH_DATA")
    if obj is not None and (obj.desire_path.is_ground or obj.desire_path.is_walker):
        arrival.begin()  # it may have come from another file
    if obj is None or obj.type not in {"MESH", "ARMATURE"}:
        _lines(layout, "Select a ground mesh or a walker", "INFO", _letters(context))
    elif obj.type == "MESH" and not obj.desire_path.is_walker:
        draw_ground(layout, context, obj)
    else:
        draw_walker(layout, context, obj)


def draw_ground(layout, context, obj):
    settings = obj.desire_path
    if not settings.is_ground:
        layout.operator("object.desire_path_ground_add", icon="ADD")
        layout.operator("object.desire_path_walker_add", icon="ADD")
        return
    column = _column(layout)
    prop(column, settings, "soil")
    column.operator("object.desire_path_material_add", icon="MATERIAL")
    prop(column, settings, "cell_length")
    frames = column.column(align=True)
    frames.prop(settings, "frame_start", text="Frame Start", text_ctxt=WORDS)
    prop(frames, settings, "frame_end")
    prop(column, settings, "folder")
    if settings.folder_auto and not bpy.data.filepath:
        _lines(column, "Temporary: save the file to keep it", "INFO", _letters(context))

    layout.label(text="Walkers")
    box = layout.box().column(align=True)
    there = walkers(context.scene, obj)
    for each in there:
        passes = each.desire_path.passes if each.desire_path.path is not None else 1
        box.label(
            text=f"{each.name}, {weight(each.desire_path)}"
            + (sentences.translated(f", {passes} passes") if passes > 1 else ""),
            icon="ARMATURE_DATA" if each.type == "ARMATURE" else "MESH_DATA",
        )
    if not there:
        _lines(box, "None: select one and press Add Walker", "INFO", _letters(context) - BOXED)

    job = bake_job.running()
    if job is not None:
        row = layout.row(align=True)
        if hasattr(row, "progress"):
            row.progress(factor=job.fraction, text=job.text)
        else:
            row.label(text=f"{job.text}, {100 * job.fraction:.0f} %")
        row.operator("object.desire_path_cancel", text="", icon="X")
    else:
        row = layout.row()
        row.scale_y = 1.4
        row.operator("object.desire_path_bake", icon="RENDER_ANIMATION")
        prop(_column(layout), settings, "auto_update")
        layout.operator("object.desire_path_press", icon="BRUSH_DATA")
        if len(grounds(context.scene)) > 1:
            layout.operator("wm.desire_path_bake_all")
        row = layout.row(align=True)
        row.operator("object.desire_path_free", icon="TRASH")
        row.operator("object.desire_path_show_files", text="", icon="FILE_FOLDER")
        row.operator("wm.desire_path_messages_copy", text="", icon="COPYDOWN")
        row.operator("wm.desire_path_manual", text="", icon="HELP")
        draw_state(layout, context, obj)
    draw_result(layout, context, settings)
    layout.operator("object.desire_path_remove", text="Remove Ground", icon="X")


def draw_state(layout, context, obj):
    """What has become of the bake, in a word and a sentence."""
    status = state.last(obj)
    if status is None:
        layout.label(text="Looking for Changes", icon="TIME")
        return
    word, icon = state.LOOKS[status.state]
    layout.label(text=word, icon=icon)
    if status.text:
        _lines(layout, status.text, "BLANK1", _letters(context))


def draw_result(layout, context, settings):
    """What the last bake did."""
    width = _letters(context)
    if not settings.summary:
        return
    found = json.loads(settings.summary)
    column = layout.column(align=True)
    baked = "Frames {} to {}: ".format(*found["frames"]) if "frames" in found else ""  # not in older files
    _lines(
        column,
        f"{baked}{found['contacts']} contacts, deepest print {1000 * found['deepest_m']:.0f} mm, "
        f"{1000 * found['pressed_m3']:.2f} l pressed, {1000 * found['heaped_m3']:.2f} l in "
        f"rims, baked in {found['seconds_in_all']:.1f} s",
        "BLANK1",
        width,
    )
    if found.get("with"):
        names = ", ".join(f"'{name}'" for name in found["with"])
        _lines(column, f"Baked together with {names}", "LINKED", width)
    for each in found["warnings"]:
        _lines(column, each, "ERROR", width)


def _letters(context):
    """About how many letters fit into a line of the panel."""
    beside = 80 if context.region.type == "UI" else 60  # the sidebar has tabs
    return max(16, int((context.region.width / context.preferences.system.ui_scale - beside) / 6.0))


def _lines(layout, text, icon, width):
    """A sentence over several lines, since labels do not wrap, in the language of the interface."""
    column = layout.column(align=True)
    line = ""
    label = bpy.app.translations.pgettext_iface(text)
    for word in (label if label != text else sentences.translated(text)).split():
        if line and len(line) + 1 + len(word) > width:
            column.label(text=line, icon=icon)
            line, icon = word, "BLANK1"
        else:
            line = f"{line} {word}".strip()
    column.label(text=line, icon=icon)


def draw_painted(layout, obj):
    settings = obj.desire_path
    row = layout.row()
    row.template_list("OBJECT_UL_desire_path_paint", "", settings, "painted", settings, "painted_index", rows=2)
    side = row.column(align=True)
    side.operator("object.desire_path_paint_add", text="", icon="ADD")
    side.operator("object.desire_path_paint_remove", text="", icon="REMOVE")
    if settings.painted:
        chosen = settings.painted[min(settings.painted_index, len(settings.painted) - 1)]
        layout.prop_search(chosen, "vertex_group", obj, "vertex_groups", text="")
        soil_presets.draw(layout, chosen, True)
        soils.draw(_column(layout), chosen, save=False)


def draw_plants(layout, context, obj):
    settings = obj.desire_path
    row = layout.row()
    row.template_list("OBJECT_UL_desire_path_plants", "", settings, "plants", settings, "plants_index", rows=2)
    side = row.column(align=True)
    side.operator("object.desire_path_plants_add", text="", icon="ADD")
    side.operator("object.desire_path_plants_remove", text="", icon="REMOVE")
    if not settings.plants:
        return
    each = settings.plants[min(settings.plants_index, len(settings.plants) - 1)]
    layout.template_icon_view(each, "pictured", show_labels=True, scale=4.0)
    column = _column(layout)
    prop(column, each, "kind")
    column.prop(each, "density", text="Per m²", text_ctxt=WORDS)
    column.prop_search(each, "density_group", obj, "vertex_groups", text="Only In")
    prop(column, each, "seed")
    picked = layout.column(align=True)  # a line of its own: its buttons need the panel's width
    picked.label(text="Density Image")
    picked.template_ID(each, "density_image", new="image.new", open="image.open")
    column = _column(layout)
    if plants.shown(each) is not None:
        column.prop(each, "grass", text="Shown By", text_ctxt=WORDS)
    else:
        column.operator("object.desire_path_grass_add", icon="OUTLINER_OB_CURVES")
    column.operator("object.desire_path_plants_update", icon="FILE_REFRESH")
    text = f"{each.count:,} plants"
    try:
        its = plants.kind(each.kind)
        text += f", {100 * its.height:.3g} cm high, full cover from {its.full_density:g} /m2 on"
    except DesirePathError as problem:
        text = str(problem)
    _lines(layout, text, "INFO", _letters(context))
    prop(_column(layout), settings, "plant_mesh")


def draw_output(layout, obj):
    settings = obj.desire_path
    column = _column(layout)
    prop(column, settings, "refine")
    if settings.refine:
        prop(column, settings, "refine_length")
        column.prop(settings, "refine_pixels", text="Pixels", text_ctxt=WORDS)
        column.prop(settings, "detail_size", text="Detail [m]", text_ctxt=WORDS)
    prop(column, settings, "attributes")
    prop(column, settings, "vertex_group")
    for name in ("law", "heap", "spray"):
        prop(column, settings, name)
    if settings.spray != "NONE":
        prop(column, settings, "spray_amount")
    for name in ("threads", "memory_limit"):
        prop(column, settings, name)


def weight(settings):
    """A walker's mass in words."""
    if settings.mass:
        return f"{settings.mass:g} kg"
    if settings.estimated_mass:
        return sentences.translated(f"about {settings.estimated_mass:.3g} kg")
    return sentences.translated("mass estimated when recorded")


def draw_walker(layout, context, obj):
    settings = obj.desire_path
    if not settings.is_walker:
        layout.operator("object.desire_path_walker_add", icon="ADD")
        layout.operator("object.desire_path_record", icon="REC")
        return
    column = _column(layout)
    prop(column, settings, "ground")
    prop(column, settings, "weight")
    if not settings.mass:
        known = weight(settings).capitalize() if settings.estimated_mass else "Estimated when recorded"
        _lines(column, known, "INFO", _letters(context))
    legged = obj.type == "ARMATURE"
    if legged:
        prop(column, settings, "sole")
        if settings.sole is None:
            prop(column, settings, "tread")
        prop(column, settings, "path")
        if settings.path is None:
            prop(column, settings, "carried")
            if forward.refused(obj):
                _lines(column, forward.refused(obj), "ERROR", _letters(context))
    if legged and settings.path is not None:
        walked = column.column(align=True)
        prop(walked, settings, "passes")
        prop(walked, settings, "scatter")
        prop(walked, settings, "path_seed")
        prop(walked, settings, "back_and_forth")
    if legged:
        prop(column, settings, "limbs")
        prop(column, settings, "wade")
    prop(column, settings, "contact_law")
    prop(column, settings, "load_model")
    prop(column, settings, "subframes")
    buttons = layout.column(align=True)
    if legged:
        buttons.operator("object.desire_path_rig_detect", icon="FILE_REFRESH")
    buttons.operator("object.desire_path_record", text="Record", icon="REC")
    if legged:
        layout.label(text="Feet on Slopes")
        feet = layout.column(align=True)
        feet.operator("object.desire_path_place_feet", icon="CON_FLOOR").into_prints = False
        feet.operator("object.desire_path_place_feet", text="Sink into Prints", icon="TRIA_DOWN_BAR").into_prints = True
        row = feet.row(align=True)
        row.operator("object.desire_path_balance", icon="MOD_SIMPLEDEFORM").remove = False
        row.operator("object.desire_path_balance", text="", icon="X").remove = True
        row = feet.row(align=True)
        row.operator("object.desire_path_slow_down", icon="PREVIEW_RANGE").remove = False
        row.operator("object.desire_path_slow_down", text="", icon="X").remove = True
        column = _column(layout)
        prop(column, settings, "place_feet")
    layout.operator("object.desire_path_remove", text="Remove Walker", icon="X")


_PLACES = {  # where each panel stands
    "PHYSICS": {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": "physics"},
    "VIEW3D": {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": "Desire Path"},
}


def in_both(panel, name="", parent=None):
    """Two classes of a panel, one for each place: <place>_PT_desire_path<name>, below <place>_PT_desire_path<parent>.

    panel: a class with label, poll() and draw(); parent: None where it is below none
    """
    return tuple(_at(place, panel, name, parent) for place in _PLACES)


def _at(place, panel, name, parent):
    base = f"{place}_PT_desire_path"
    below = {} if parent is None else {"bl_parent_id": base + parent}
    fields = {**_PLACES[place], **below, "__module__": panel.__module__, "bl_translation_context": WORDS}
    return type(base + name, (panel, bpy.types.Panel), fields)


class _Main:
    bl_label = "Desire Path"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type in {"MESH", "ARMATURE"}

    def draw(self, context):
        draw(self.layout, context)


class _Ground:
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        obj = context.object
        return obj is not None and obj.type == "MESH" and obj.desire_path.is_ground


class _Soil(_Ground):
    bl_label = "Soil"
    bl_order = 0

    def draw(self, context):
        soil_presets.draw(self.layout, context.object.desire_path, False)
        soils.draw(_column(self.layout), context.object.desire_path)


class _Numbers(_Ground):
    bl_label = "Physical Numbers"

    def draw(self, context):
        soils.draw_numbers(_column(self.layout), context.object.desire_path)


class _Painted(_Ground):
    bl_label = "Painted Soils"
    bl_order = 1

    def draw(self, context):
        draw_painted(self.layout, context.object)


class _Plants(_Ground):
    bl_label = "Plants"
    bl_order = 3

    def draw(self, context):
        draw_plants(self.layout, context, context.object)


class _Output(_Ground):
    bl_label = "Output and Method"
    bl_order = 4

    def draw(self, context):
        draw_output(self.layout, context.object)


CLASSES = (
    *panel_lists.CLASSES,
    *in_both(_Main),
    *in_both(_Soil, "_soil", ""),
    *in_both(_Numbers, "_numbers", "_soil"),
    *in_both(_Painted, "_painted", ""),
    *in_both(_Plants, "_plants", ""),
    *in_both(_Output, "_output", ""),
)
