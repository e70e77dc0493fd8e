"""soil_presets.py - soils of one's own, by name: files in the user's presets folder, in a menu with + and -.

    numbers of a ground or of its active painted soil --save--> presets/desire_path/soils/<name>.json --load--> them

The files are those of Soil.save, so that scripts and the command line take them, too.
"""

import os

import bpy
from bpy.props import BoolProperty, StringProperty

from ..errors import DesirePathError
from ..ground.soil import Soil
from . import soils
from .ops import Refusal

FOLDER = os.path.join("desire_path", "soils")


def settings_of(obj, painted):
    """What holds the numbers of a ground, or of its active painted soil; None where there is none."""
    if obj is None or obj.type != "MESH" or not obj.desire_path.is_ground:
        return None
    settings = obj.desire_path
    if not painted:
        return settings
    return settings.painted[min(settings.painted_index, len(settings.painted) - 1)] if settings.painted else None


def path_of(name):
    """The file of a soil of this name in the user's presets folder, which is made; refuses what is no file's name."""
    name = name.strip()
    if not name or name != bpy.path.clean_name(name, replace=" ").strip() and name != bpy.path.clean_name(name):
        raise DesirePathError(f"'{name}' cannot name a soil: use letters, digits, spaces, - and _.")
    return os.path.join(
        bpy.utils.user_resource("SCRIPTS", path=os.path.join("presets", FOLDER), create=True), name + ".json"
    )


class _Preset(Refusal):
    bl_options = {"INTERNAL", "UNDO"}
    painted: BoolProperty(options={"HIDDEN", "SKIP_SAVE"}, description="The active painted soil, not the ground's own")

    @classmethod
    def poll(cls, context):
        if settings_of(context.object, False) is None:
            cls.poll_message_set("Select a ground first")
            return False
        return True

    def settings(self, context):
        found = settings_of(context.object, self.painted)
        if found is None:
            raise DesirePathError(f"No soil is painted on '{context.object.name}' yet: add one first.")
        return found


class OBJECT_OT_desire_path_soil_load(_Preset, bpy.types.Operator):
    """Take the numbers of this soil"""

    bl_idname = "object.desire_path_soil_load"
    bl_label = "Load Soil"

    filepath: StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"}, description="The .json file of the soil")
    menu_idname: StringProperty(options={"HIDDEN", "SKIP_SAVE"}, description="The menu it is chosen from")

    def work(self, context):
        settings = self.settings(context)
        soils.take(settings, Soil.load(bpy.path.abspath(self.filepath)))
        settings.soil_name = os.path.splitext(os.path.basename(self.filepath))[0]
        return {"FINISHED"}


class OBJECT_OT_desire_path_soil_preset_add(_Preset, bpy.types.Operator):
    """Keep these numbers as a soil of your own, for all files"""

    bl_idname = "object.desire_path_soil_preset_add"
    bl_label = "Add Soil Preset"

    name: StringProperty(name="Name", options={"SKIP_SAVE"}, description="What the soil is called")

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def work(self, context):
        settings = self.settings(context)
        soils.soil_of(settings).save(path_of(self.name))
        settings.soil_name = self.name.strip()
        return {"FINISHED"}


class OBJECT_OT_desire_path_soil_preset_remove(_Preset, bpy.types.Operator):
    """Remove this soil of your own; grounds that have its numbers keep them"""

    bl_idname = "object.desire_path_soil_preset_remove"
    bl_label = "Remove Soil Preset"

    def work(self, context):
        settings = self.settings(context)
        if not settings.soil_name:
            raise DesirePathError("No soil of your own is chosen: choose the one to remove in the menu.")
        path = path_of(settings.soil_name)
        if not os.path.isfile(path):
            raise DesirePathError(f"There is no soil at {path}: it was removed already.")
        os.remove(path)
        settings.soil_name = ""
        return {"FINISHED"}


class OBJECT_MT_desire_path_soils(bpy.types.Menu):
    """Soils of your own"""

    bl_idname = "OBJECT_MT_desire_path_soils"
    bl_label = "Own Soils"
    preset_subdir = FOLDER
    preset_operator = "object.desire_path_soil_load"
    preset_extensions = {".json"}
    draw = bpy.types.Menu.draw_preset


class OBJECT_MT_desire_path_painted_soils(bpy.types.Menu):
    """Soils of your own, for the active painted soil"""

    bl_idname = "OBJECT_MT_desire_path_painted_soils"
    bl_label = "Own Soils"
    preset_subdir = FOLDER
    preset_operator = "object.desire_path_soil_load"
    preset_operator_defaults = {"painted": True}
    preset_extensions = {".json"}
    draw = bpy.types.Menu.draw_preset


def draw(layout, settings, painted):
    """The menu of soils of one's own, with + and -."""
    row = layout.row(align=True)
    menu = OBJECT_MT_desire_path_painted_soils if painted else OBJECT_MT_desire_path_soils
    row.menu(menu.bl_idname, text=settings.soil_name or menu.bl_label)
    row.operator("object.desire_path_soil_preset_add", text="", icon="ADD").painted = painted
    row.operator("object.desire_path_soil_preset_remove", text="", icon="REMOVE").painted = painted


CLASSES = (
    OBJECT_OT_desire_path_soil_load,
    OBJECT_OT_desire_path_soil_preset_add,
    OBJECT_OT_desire_path_soil_preset_remove,
    OBJECT_MT_desire_path_soils,
    OBJECT_MT_desire_path_painted_soils,
)
