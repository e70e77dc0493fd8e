"""window_walk_it.py - run by test_window.py in a Blender with a window: from an imported clip and a default plane to
prints that are seen, and what a user does next."""

import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
bpy.context.preferences.view.show_splash = False
import desire_path  # noqa: E402

desire_path.register()
from scenes import first_minute  # noqa: E402
from scenes.hands import Hands, tell, until  # noqa: E402

from desire_path.bake import bake  # noqa: E402
from desire_path.blender import bake_job, sample  # noqa: E402

FOLDER = pathlib.Path(sys.argv[-1])


def object_of(name):
    return bpy.data.objects[name]


def stop_playing(hands):
    yield from hands.key("ESC", hands.place((0.0, 0.0, 0.0)))
    yield from until(lambda: not hands.window.screen.is_animation_playing)


def seen(hands, name, points, frame):
    """How much the picture changes around points of the world from before the walk to a frame, the most."""
    shots = []
    for each in (-1, frame):
        bpy.context.scene.frame_set(each)
        yield 0.7
        shots.append(hands.shot(f"{name}_{each}"))
    most = 0.0
    for point in points:
        x, y = (int(each) for each in hands.place(point))
        a, b = (shot[y - 12 : y + 13, x - 20 : x + 21] for shot in shots)
        most = max(most, float(np.abs(a - b).max()))
    return most


def story(hands):
    first_minute.setting(hands, plane=True)
    yield 0.5
    yield from hands.click(hands.place((0.8, -0.8, 0.0)), shift=True)
    assert bpy.context.object == object_of("Plane") and object_of("Rig").select_get()
    made, baked, record, finish = [], [], sample.record, bake_job.Job.finish
    sample.record = lambda *asked, **more: made.append(asked[1:4]) or record(*asked, **more)
    bake_job.Job.finish = lambda job: baked.append(made[:]) or finish(job)
    yield from first_minute.walk_it(hands)
    yield from first_minute.pressed(hands)
    sample.record, bake_job.Job.finish = record, finish
    assert len(baked[0]) == 2, baked  # the clip and the walk, which the bake in the window is handed
    assert hands.clicks <= 3 and hands.digits == 0 and hands.keys == 0, (hands.clicks, hands.digits, hands.keys)
    yield from until(lambda: hands.window.screen.is_animation_playing)
    yield 1.0
    yield from stop_playing(hands)

    # the plane has its four corners, and prints are seen on it where the view has gone
    plane = object_of("Plane")
    assert len(plane.data.vertices) == 4 and not bake_job.running()
    folder = bpy.path.abspath(plane.desire_path.folder)
    assert bake.read_index(folder).complete
    object_of("Rig").select_set(False)
    object_of("Mannequin").hide_set(True)
    object_of("Rig").hide_set(True)
    steps = [(0.08 * side, 0.1 * k, 0.0) for k in range(-9, 4) for side in (-1, 0, 1)]
    change = yield from seen(hands, "prints", steps, 60)
    assert change > 0.15, f"prints change the picture by {change:.2f}"
    for name in ("Mannequin", "Rig"):
        object_of(name).hide_set(False)

    # another soil; ESC in its bake leaves one that plays, undo and another bake go on from there
    plane.desire_path.soil = "mud"
    with hands.within("VIEW_3D"):
        assert bpy.ops.object.desire_path_bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from hands.key("ESC", hands.place((0.0, 0.0, 0.0)))
    yield from until(lambda: bake_job.running() is None)
    assert object_of("Plane").desire_path.bake_state in {"OUTDATED", "PARTIAL", "FRESH"}
    with hands.within("VIEW_3D"):
        bpy.ops.ed.undo_push(message="before")
        object_of("Plane").desire_path.soil_numbers.softness = 0.9
        bpy.ops.ed.undo_push(message="softer")
        bpy.ops.ed.undo()
    assert not object_of("Plane").desire_path.soil_numbers.changed
    yield 0.5
    with hands.within("VIEW_3D"):
        bpy.context.view_layer.objects.active = object_of("Plane")
        assert bpy.ops.object.desire_path_bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from until(lambda: bake_job.running() is None)
    assert object_of("Plane").desire_path.bake_state == "FRESH", object_of("Plane").desire_path.missing
    hands.shot("mud")

    # saved, opened again, saved elsewhere: the walk and its prints are there
    (FOLDER / "else").mkdir()
    for path in (FOLDER / "a.blend", FOLDER / "else" / "b.blend"):
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
        bpy.ops.wm.open_mainfile(filepath=str(path))
        yield 1.0
        settings = object_of("Plane").desire_path
        assert settings.bake_state == "FRESH", f"{path.name}: {settings.missing}"
        assert settings.soil == "mud" and object_of("Rig").desire_path.carried
    hands.shot("reopened")


tell(story(Hands(FOLDER)))
