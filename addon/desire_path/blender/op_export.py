"""op_export.py - what was baked, for other programs."""

import bpy
from bpy.props import EnumProperty, StringProperty

from ..errors import DesirePathError
from . import messages
from .late import height16, home
from .ops import Refusal, active

FORMATS = (
    ("HEIGHT16", "Heights of 16 Bit", "A grey picture or bare numbers; a .json beside it tells what a value is"),
)


class WM_OT_desire_path_export(Refusal, bpy.types.Operator):
    """Write the baked heights of the active ground for game engines and makers of terrain"""

    bl_idname = "wm.desire_path_export"
    bl_label = "Export Trail"
    bl_options = {"REGISTER"}

    format: EnumProperty(name="Format", items=FORMATS, description="What is written")
    filepath: StringProperty(
        subtype="FILE_PATH", options={"SKIP_SAVE"}, description="Where the heights are written: .png, .raw or .r16"
    )
    filter_glob: StringProperty(default="*.png;*.raw;*.r16", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "the ground", changed=False)

    def invoke(self, context, _event):
        if not self.filepath:
            self.filepath = f"//{bpy.path.clean_name(context.object.name)}.png"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def work(self, context):
        obj = context.object
        place = home.played(obj)
        if not place:
            raise DesirePathError(f"There are no files of '{obj.name}' yet: bake it first.")
        if not self.filepath:
            raise DesirePathError("There is no name to write to: give a filepath that ends with .png, .raw or .r16.")
        path = bpy.path.abspath(self.filepath)
        told = height16.write(place, path)
        messages.tell(self, "INFO", f"{told['columns']} x {told['rows']} heights are written to {path}.")
        return {"FINISHED"}


def draw_menu(self, _context):
    self.layout.operator("wm.desire_path_export", text="Trail of Desire Path (.png, .raw)")


CLASSES = (WM_OT_desire_path_export,)


def register():
    bpy.types.TOPBAR_MT_file_export.append(draw_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(draw_menu)
