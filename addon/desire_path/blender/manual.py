"""manual.py - the documentation that comes with the add-on, shown in Blender's own text editor."""

import pathlib

import bpy
from bpy.props import EnumProperty

from ..errors import DesirePathError
from .ops import Refusal

HOME = pathlib.Path(__file__).resolve().parents[1]
PAGES = (
    ("README", "Documentation", "How everything is used, in Blender and without"),
    ("CHANGELOG", "What Is New", "What has changed from version to version"),
)


def path_of(page):
    """A page's file: in the package, or, where the add-on runs from its sources, above it."""
    for folder in (HOME, HOME.parents[1]):
        path = folder / f"{page}.md"
        if path.is_file():
            return path
    raise DesirePathError(f"{page}.md does not lie in {HOME}: install the add-on anew.")


class WM_OT_desire_path_manual(Refusal, bpy.types.Operator):
    """Show the documentation of Desire Path, which is installed with it, in a text editor"""

    bl_idname = "wm.desire_path_manual"
    bl_label = "Documentation"
    bl_options = {"REGISTER"}

    page: EnumProperty(name="Page", items=PAGES, description="Which page is shown")

    def work(self, context):
        path = path_of(self.page)
        name = f"Desire Path {path.name}"
        text = bpy.data.texts.get(name) or bpy.data.texts.new(name)
        text.from_string(path.read_text(encoding="utf-8"))
        text.cursor_set(0)
        if not bpy.app.background:
            bpy.ops.wm.window_new()
            area = context.window_manager.windows[-1].screen.areas[0]
            area.type = "TEXT_EDITOR"
            area.spaces[0].text, area.spaces[0].show_word_wrap = text, True
        return {"FINISHED"}


def draw(layout):
    """A row of what tells more."""
    row = layout.row(align=True)
    for page, label, _description in PAGES:
        row.operator("wm.desire_path_manual", text=label, icon="HELP" if page == "README" else "NONE").page = page
    row.operator("wm.desire_path_messages_copy", text="Copy Messages", icon="COPYDOWN")


class DesirePathPreferences(bpy.types.AddonPreferences):
    """What the preferences of the add-on show."""

    bl_idname = __package__.rpartition(".")[0]

    def draw(self, _context):
        draw(self.layout)
        self.layout.label(text="A report of a bug needs what Copy Messages copies, and the file", icon="INFO")


CLASSES = (WM_OT_desire_path_manual, DesirePathPreferences)
