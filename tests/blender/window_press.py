"""window_press.py - run by test_window.py in a Blender with a window: a ball is taken in hand and pressed."""

import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
bpy.context.preferences.view.show_splash = False
import desire_path  # noqa: E402

desire_path.register()
from scenes import gaits  # noqa: E402
from scenes.hands import Hands, tell, until  # noqa: E402

from desire_path.blender import compat, op_press, playback, state  # noqa: E402

FOLDER = pathlib.Path(sys.argv[-1])


def ground():
    return bpy.data.objects["Plane"]


def heights():
    bpy.context.view_layer.update()
    found = ground().evaluated_get(bpy.context.evaluated_depsgraph_get())
    return compat.positions(found.data)[:, 2]


def setting(hands):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    bpy.ops.mesh.primitive_plane_add(size=3.0)
    sphere = gaits.sphere(0.125, 16)
    mesh = bpy.data.meshes.new("Ball")
    mesh.from_pydata(sphere.vertices.tolist(), [], sphere.triangles.tolist())
    ball = bpy.data.objects.new("Ball", mesh)
    ball.location.z = 1.0
    bpy.context.collection.objects.link(ball)
    ground().desire_path.soil = "deep-snow"
    ball.select_set(True)
    bpy.context.view_layer.objects.active = ball
    space = hands.area("VIEW_3D").spaces[0]
    space.region_3d.view_distance, space.region_3d.view_location = 2.4, (0.0, 0.0, 0.0)
    space.shading.light, space.shading.show_cavity = "MATCAP", True
    space.overlay.show_floor = space.overlay.show_outline_selected = False
    with bpy.context.temp_override(window=hands.window):
        bpy.ops.ed.undo_push(message="Scene")


def begin(hands):
    with hands.within("VIEW_3D"):
        assert bpy.ops.object.desire_path_press("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert op_press.running() and not op_press.OBJECT_OT_desire_path_press.poll(bpy.context)


def drag(hands, *points, release=True):
    """Press the mouse at the first of some places on the ground, and go along the others."""
    first, *others = [hands.place(each) for each in points]
    hands.event("MOUSEMOVE", "NOTHING", first)
    yield 0.3
    hands.event("LEFTMOUSE", "PRESS", first)
    yield 0.2
    for end in others:
        for share in np.linspace(0.0, 1.0, 8)[1:]:
            hands.event("MOUSEMOVE", "NOTHING", (np.array(first) * (1.0 - share) + np.array(end) * share).tolist())
            yield 0.05
        first = end
    yield 0.3
    if release:
        hands.event("LEFTMOUSE", "RELEASE", first)
        yield 0.3


def key(hands, kind, **more):
    yield from hands.key(kind, hands.place((0.0, 0.0, 0.0)), **more)


def story(hands):
    setting(hands)
    yield 1.0
    before = hands.shot("before")
    blocks = [len(each) for each in (bpy.data.meshes, bpy.data.node_groups, bpy.data.objects)]

    # a ball follows the mouse over the ground, and presses it while the button is held
    begin(hands)
    yield from drag(hands, (-0.5, -0.3, 0.0), (0.5, -0.2, 0.0), release=False)
    ball = bpy.data.objects["Ball"]
    assert 0.05 < ball.location.z < 0.12 and ball.location.x > 0.35, ball.location
    deep = heights().min()
    assert abs(deep + 0.05) < 0.004, deep
    during = hands.shot("pressing")
    hands.event("LEFTMOUSE", "RELEASE", hands.place((0.5, -0.2, 0.0)))
    yield 0.3
    x, y = (int(each) for each in hands.place((-0.2, -0.27, 0.0)))
    groove = np.s_[y - 40 : y + 40, x - 40 : x + 40]
    assert np.abs(during[groove] - before[groove]).max() > 0.1, "nothing is seen of it"

    # a notch of the wheel presses deeper; each stroke is taken back by itself
    deep = heights().min()  # a little has sprung back
    yield from key(hands, "PAGE_DOWN")
    yield from drag(hands, (-0.3, 0.3, 0.0), (0.2, 0.4, 0.0))
    assert heights().min() < 1.1 * deep
    yield from key(hands, "Z", ctrl=True)
    assert abs(heights().min() - deep) < 1e-6
    assert op_press.running()

    # ESC: as it was before
    yield from key(hands, "ESC")
    assert not op_press.running() and len(heights()) == 4 and not ground().modifiers
    assert not ground().desire_path.is_ground and abs(ball.location.z - 1.0) < 1e-6
    assert [len(each) for each in (bpy.data.meshes, bpy.data.node_groups, bpy.data.objects)] == blocks
    yield 0.3
    after = hands.shot("dropped")
    assert np.abs(after[groove] - before[groove]).max() < 0.02

    # Enter: it stays, undo takes it away and redo brings it again
    begin(hands)
    yield from drag(hands, (-0.5, -0.3, 0.0), (0.5, -0.2, 0.0))
    yield from key(hands, "RET")
    assert not op_press.running() and ground().desire_path.bake_state == "FRESH"
    kept = heights()
    assert abs(kept.min() + 0.05) < 0.004 and playback.modifier(ground()) is not None
    assert not any(map(playback.is_by_hand, ground().modifiers))
    yield from until(lambda: not state.busy())
    yield 0.3
    hands.shot("kept")
    for step, count in (("undo", 4), ("redo", len(kept))):
        with bpy.context.temp_override(window=hands.window):
            assert getattr(bpy.ops.ed, step)() == {"FINISHED"}
        yield 0.3
        assert len(heights()) == count, step

    # whatever goes through all data ends the tool, and nothing of it is left
    for each in bpy.context.scene.objects:
        each.select_set(True)
    begin(hands)
    yield from drag(hands, (0.0, 0.5, 0.0), (0.3, 0.5, 0.0))
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "pressed.blend"))
    assert not op_press.running() and not any(map(playback.is_by_hand, ground().modifiers))
    assert np.array_equal(heights(), kept) and ground().desire_path.pressed.startswith("//")
    assert ground().desire_path.bake_state == "FRESH"
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "pressed.blend"))
    yield 0.5
    assert np.array_equal(heights(), kept) and ground().desire_path.bake_state == "FRESH"
    yield 0.3


HANDS = Hands(FOLDER)
tell(story(HANDS))
