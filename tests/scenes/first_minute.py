"""first_minute.py - what a user does first, in a Blender with a window: from a character of a library to its prints.

    xvfb-run -a -s "-screen 0 1280x800x24" blender --factory-startup --enable-event-simulate -noaudio \\
        -p 0 0 1280 800 --python-exit-code 1 -P tests/scenes/first_minute.py -- FOLDER

Writes whole windows into FOLDER: minute_1.png to minute_3.png (the button, the walk, its prints) and panel.png.
"""

import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

from scenes.hands import Hands, tell, until  # noqa: E402

CHARACTER = ROOT / "tests" / "scenes" / "characters" / "human_mixamo_names_inplace.glb"
TABS = {"de_DE": 265}  # of the pixels of the sidebar, from above: the middle of our tab, below Item, Tool and View
TAB = 178  # the same in English


def setting(hands, plane):
    """A new file with a plane, if one is wanted, in place of the cube, and the character as it is imported."""
    import addon_utils

    np.__dict__.setdefault("bool", bool)  # Debian's 3.4 uses an alias its NumPy no longer has
    addon_utils.enable("io_scene_gltf2")
    with hands.within("VIEW_3D"):
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        if plane:
            bpy.ops.mesh.primitive_plane_add()
        bpy.ops.import_scene.gltf(filepath=str(CHARACTER))


def walk_it(hands):
    """By the menu under the right button of the mouse: two clicks."""
    region = hands.region("VIEW_3D")
    at = region.x + 0.3 * region.width, region.y + 60.0  # low, so that the menu ends above the lower edge
    yield from hands.click(at, "RIGHTMOUSE")
    hands.shot("minute_1")
    yield from hands.click((at[0], 46.0))  # above Press, which is the lowest


def pressed(hands):
    """Wait until Walk It has been pressed and its bake is over."""
    from desire_path.blender import bake_job

    grounds = lambda: [each for each in bpy.data.objects if each.desire_path.is_ground]
    yield from until(grounds)
    yield from until(lambda: bake_job.running() is None)
    assert grounds()[0].desire_path.summary, "nothing was baked"


def sidebar(hands):
    """Open the sidebar of the 3D view at the tab of Desire Path: a key and a click."""
    region = hands.region("VIEW_3D")
    yield from hands.key("N", (region.x + 0.3 * region.width, region.y + 0.5 * region.height))
    yield 1.0
    side = hands.region("VIEW_3D", "UI")
    down = TABS.get(bpy.context.preferences.view.language, TAB)
    yield from hands.click((side.x + side.width - 12, side.y + side.height - down))


def story(hands):
    setting(hands, plane=False)
    yield 0.5
    yield from walk_it(hands)
    yield from pressed(hands)
    yield 2.0
    assert hands.window.screen.is_animation_playing
    with hands.within("VIEW_3D"):
        bpy.ops.screen.animation_cancel(restore_frame=False)
    for number, frame in enumerate((24, 48), 2):
        bpy.context.scene.frame_set(frame)
        yield 1.0
        hands.shot(f"minute_{number}")
    yield from sidebar(hands)
    hands.shot("panel")


def main():
    import desire_path

    bpy.context.preferences.view.show_splash = False
    desire_path.register()
    tell(story(Hands(pathlib.Path(sys.argv[-1]))))


if __name__ == "__main__":
    main()
