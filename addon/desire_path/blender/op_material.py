"""op_material.py - a ground is shown as what it is made of."""

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..errors import DesirePathError
from .late import materials, watch
from .messages import tell
from .ops import Refusal, active

KINDS = (
    ("AUTO", "Of Its Soils", "What the ground's soils look like, the painted ones where they lie"),
    ("SAND", "Sand", "Grains, a little damp below the surface"),
    ("SNOW", "Snow", "White and a little translucent, bluer where it was pressed"),
    ("CRUST", "Crusted Snow", "Snow under a plate of ice, which cracks around prints"),
    ("MUD", "Mud", "Damp lumps, smooth and wet where feet went"),
    ("EARTH", "Earth", "Dark crumbs, darker and flat where feet went"),
    ("PACKED", "Packed Earth", "Dusty and hard, with small stones, flaked and cracked around prints"),
    ("GRASS", "Grass Floor", "Moss and dead leaves between plants, bare earth where the cover is gone"),
)


class OBJECT_OT_desire_path_material_add(Refusal, bpy.types.Operator):
    """Give the selected grounds a material of what they are made of. Your own materials stay, and get a node group"""

    bl_idname = "object.desire_path_material_add"
    bl_label = "Make Material"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Kind", description="What the ground looks like", items=KINDS)
    replace: BoolProperty(name="Replace", description="Use it in place of materials of your own, too")

    @classmethod
    def poll(cls, context):
        return active(cls, context, {"MESH"}, "a ground")

    def work(self, context):
        obj = context.object
        if not obj.desire_path.is_ground:
            raise DesirePathError(f"'{obj.name}' is no ground yet: press Add Ground first.")
        beside = [
            each
            for each in context.selected_objects
            if each != obj
            and each.type == "MESH"
            and each.mode != "EDIT"
            and each.library is None
            and each.desire_path.is_ground
        ]
        done, wrong = [], []
        for each in (obj, *beside):
            try:
                done.append(materials.add(context.scene, each, self.kind, self.replace))
            except DesirePathError as problem:
                wrong.append(str(problem))
                continue
            watch.renew(context.scene, each)
        if not done:
            raise DesirePathError(" ".join(wrong))
        for kind, sentences in (("INFO", done), ("WARNING", wrong)):
            if sentences:
                tell(self, kind, " ".join(sentences))
        return {"FINISHED"}


class WM_OT_desire_path_assets_add(Refusal, bpy.types.Operator):
    """Write the looks of grounds to a file of assets, and list it as a library of the Asset Browser"""

    bl_idname = "wm.desire_path_assets_add"
    bl_label = "Add Desire Path Asset Library"
    bl_options = {"REGISTER"}

    directory: StringProperty(
        name="Folder",
        subtype="DIR_PATH",
        options={"HIDDEN", "SKIP_SAVE"},
        description="Where the file is written; empty = beside Blender's own data of this user",
    )

    def work(self, _context):
        folder = bpy.path.abspath(self.directory) or bpy.utils.user_resource("DATAFILES", path="desire_path")
        path = materials.write_library(folder)
        tell(self, "INFO", f"The Asset Browser has the library '{materials.LIBRARY}', {path}.")
        return {"FINISHED"}


CLASSES = (OBJECT_OT_desire_path_material_add, WM_OT_desire_path_assets_add)
