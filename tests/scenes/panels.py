"""panels.py - every panel of ours at its usual width, in a Blender with a window.

    xvfb-run -a -s "-screen 0 1920x2200x24" blender --factory-startup -noaudio --enable-event-simulate \\
        -p 0 0 1920 2200 --python-exit-code 1 -P tests/scenes/panels.py -- FOLDER [LABEL,LABEL [LANGUAGE]]

Writes FOLDER/SUBJECT_PLACE.png: a plain mesh, a ground, a walker, a track of a wheel, one of a stamp; in the sidebar
and in Properties; panels with these labels (all: every one) are open, the others as they are at first.
What a ground and a walker show in English and German is kept in pictures/panels.jpg.
"""

import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

from scenes import first_minute  # noqa: E402
from scenes.hands import Hands, tell  # noqa: E402

PLACES = (("sidebar", "VIEW_3D", "UI"), ("properties", "PROPERTIES", "WINDOW"))


def save(pixels, path):
    """A picture (height, width, 3), from below."""
    image = bpy.data.images.new("panel", pixels.shape[1], pixels.shape[0])
    image.pixels.foreach_set(np.dstack([pixels, np.ones(pixels.shape[:2], np.float32)]).astype(np.float32).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)


def opened(labels):
    """Let panels of these labels be open at first, which Blender asks once; "all": each of them."""
    from desire_path.blender import _CLASSES

    for each in _CLASSES:
        if issubclass(each, bpy.types.Panel) and (labels == ["all"] or each.bl_label in labels):
            each.bl_options = set()


def take(hands, name):
    """Both places of the object that is active."""
    for area in hands.window.screen.areas:
        area.tag_redraw()
    yield 1.0
    whole = hands.shot("whole")
    for place, kind, region in PLACES:
        found = hands.region(kind, region)
        part = whole[found.y : found.y + found.height, found.x : found.x + found.width]
        save(part, hands.folder / f"{name}_{place}.png")


def chosen(hands, obj):
    with hands.within("VIEW_3D"):
        bpy.ops.object.select_all(action="DESELECT")
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
    space = hands.area("PROPERTIES").spaces[0]
    if obj.type in {"MESH", "CURVE"}:
        space.context = "PHYSICS"


def story(hands):
    hands.area("VIEW_3D").spaces[0].shading.type = "WIREFRAME"
    bpy.context.scene.frame_end = 60
    first_minute.setting(hands, plane=True)
    rig, plane = bpy.data.objects["Rig"], bpy.data.objects["Plane"]
    yield 0.5
    yield from first_minute.sidebar(hands)
    chosen(hands, plane)
    yield from take(hands, "mesh")
    with hands.within("VIEW_3D"):
        rig.select_set(True)
        bpy.ops.object.desire_path_walk_it("INVOKE_DEFAULT")
    yield from first_minute.pressed(hands)
    with hands.within("VIEW_3D"):
        bpy.ops.screen.animation_cancel(restore_frame=False)
        chosen(hands, plane)
        bpy.ops.object.desire_path_plants_add()
        bpy.ops.object.desire_path_paint_add()
        plane.desire_path.painted[0].vertex_group = plane.vertex_groups.new(name="Wet Patch").name
        bpy.ops.curve.primitive_bezier_curve_add(radius=0.5)
        curve = bpy.context.object
        bpy.ops.object.desire_path_track_add()
    for obj in (plane, rig, curve):
        chosen(hands, obj)
        yield from take(hands, obj.name.lower())
    curve.desire_path.track.kind = "WHEEL"
    yield from take(hands, "wheel")


def main():
    import desire_path

    words = sys.argv[sys.argv.index("--") + 1 :]
    bpy.context.preferences.view.show_splash = False
    opened(words[1].split(",") if len(words) > 1 else [])
    if len(words) > 2:
        bpy.context.preferences.view.language = words[2]
        bpy.context.preferences.view.use_translate_interface = True
        bpy.context.preferences.view.use_translate_tooltips = True
        bpy.context.preferences.view.use_translate_new_dataname = False  # objects are looked for by their names
    desire_path.register()
    tell(story(Hands(pathlib.Path(words[0]))))


if __name__ == "__main__":
    main()
