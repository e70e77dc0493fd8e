"""op_export.py - what was baked, for other programs."""

import os

import bpy
from bpy.props import EnumProperty, StringProperty

from ..errors import DesirePathError
from . import messages
from .late import atomic_file, compat, disk, height16, home, playback_tree, stage, tempfile, volume
from .ops import Refusal, active

FORMATS = (
    ("HEIGHT16", "Heights of 16 Bit", "A grey picture or bare numbers; a .json beside it tells what a value is"),
    ("USD", "USD", "A mesh at the end of the walk with all maps, and the plants that were baked as a mesh"),
    ("VDB", "VDB", "A volume for each frame of what flies over the ground"),
    ("ALEMBIC", "Alembic", "The ground and its plants as they move, in the frames of the scene"),
)
KINDS = {
    "HEIGHT16": (".png", ".raw", ".r16"),
    "USD": (".usdc", ".usda", ".usd"),
    "VDB": (".vdb",),
    "ALEMBIC": (".abc",),
}


class WM_OT_desire_path_export(Refusal, bpy.types.Operator):
    """Write what was baked on the active ground for game engines, makers of terrain and other programs of pictures"""

    bl_idname = "wm.desire_path_export"
    bl_label = "Export Trail"
    bl_options = {"REGISTER"}

    format: EnumProperty(name="Format", items=FORMATS, description="What is written")
    filepath: StringProperty(
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
        description="Where it is written: .png, .raw or .r16; .usdc, .usda or .usd; .vdb; .abc",
    )
    filter_glob: StringProperty(default="*.png;*.raw;*.r16;*.usd;*.usda;*.usdc;*.vdb;*.abc", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "the ground", changed=False)

    def invoke(self, context, _event):
        if not self.filepath:
            self.filepath = f"//{bpy.path.clean_name(context.object.name)}{KINDS[self.format][0]}"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def check(self, _context):
        """The name goes along with the format that is chosen."""
        start, kind = os.path.splitext(self.filepath)
        if not start or kind.lower() in KINDS[self.format]:
            return False
        known = any(kind.lower() in each for each in KINDS.values())
        self.filepath = (start if known else self.filepath) + KINDS[self.format][0]
        return True

    def work(self, context):
        obj = context.object
        place = home.played(obj)
        if not place:
            raise DesirePathError(f"There are no files of '{obj.name}' yet: bake it first.")
        kinds = ", ".join(KINDS[self.format])
        if not self.filepath:
            raise DesirePathError(f"There is no name to write to: give a filepath that ends with {kinds}.")
        path = bpy.path.abspath(self.filepath)
        if self.format == "HEIGHT16":
            report = height16.write(place, path)
            messages.tell(self, "INFO", f"{report['columns']} x {report['rows']} heights are written to {path}.")
        elif self.format == "USD":
            with compat.bundled_modules():
                report = stage.write(place, path)
            messages.tell(self, "INFO", f"{report['points']} points and {report['stems']} stems are written to {path}.")
        elif self.format == "VDB":
            with compat.bundled_modules():
                report = volume.write(place, path)
            messages.tell(
                self, "INFO", f"{report['frames']} volumes of {report['grains']} grains are written to {path}."
            )
        else:
            if os.path.splitext(path)[1].lower() not in KINDS["ALEMBIC"]:
                raise DesirePathError(f"{path} is of no kind that is written: give it a name that ends with {kinds}.")
            count = alembic(context, obj, path)
            messages.tell(self, "INFO", f"{count} frames are written to {path}.")
        return {"FINISHED"}


def alembic(context, obj, path):
    """Let Blender write a ground and what grows on it, in every frame of the scene; returns how many frames."""
    if not bpy.app.build_options.alembic:
        raise DesirePathError("This Blender was built without Alembic: take one of blender.org, or export USD.")
    atomic_file.check(path, "The ground")
    layer, scene = context.view_layer, context.scene
    chosen, frame = [each for each in layer.objects if each and each.select_get()], scene.frame_current
    own = [obj, *(each for each in obj.children if playback_tree.TAG in each)]
    shown = [each for each in own if each.name in layer.objects and each.visible_get()]
    if obj not in shown:
        raise DesirePathError(f"'{obj.name}' is hidden, and so is not written: show it first.")
    with tempfile.TemporaryDirectory(prefix=".alembic-", dir=os.path.dirname(os.path.abspath(path))) as folder:
        exported = os.path.join(folder, "trail.abc")
        try:
            for each in chosen:
                each.select_set(False)
            for each in shown:
                each.select_set(True)
            bpy.ops.wm.alembic_export(
                filepath=exported, selected=True, start=scene.frame_start, end=scene.frame_end, as_background_job=False
            )
        except RuntimeError as problem:
            raise DesirePathError(f"Alembic cannot be written to {path} ({str(problem).strip()}).") from None
        finally:
            for each in shown:
                each.select_set(False)
            for each in chosen:
                each.select_set(True)
            scene.frame_set(frame)
        if not os.path.isfile(exported):
            raise DesirePathError(f"Alembic cannot be written to {path}: choose another folder or make room.")
        disk.replace(exported, path)
    return scene.frame_end - scene.frame_start + 1


def draw_menu(self, _context):
    self.layout.operator("wm.desire_path_export", text="Trail of Desire Path (.png, .usd, .abc)")


CLASSES = (WM_OT_desire_path_export,)


def register():
    bpy.types.TOPBAR_MT_file_export.append(draw_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(draw_menu)
