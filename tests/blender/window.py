"""window.py - run by test_window.py in a Blender with a window: presses what a user presses."""

import pathlib
import sys

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
bpy.context.preferences.view.show_splash = False
import desire_path  # noqa: E402

desire_path.register()
from scenes import hands, meshes, people  # noqa: E402

from desire_path.bake import bake  # noqa: E402
from desire_path.blender import bake_job, op_forces, playback, state  # noqa: E402
from desire_path.ground import sim  # noqa: E402

FOLDER = pathlib.Path(sys.argv[-1])
write_frame = sim.Film.write_frame
slowly = hands.slowed(write_frame)


def window():
    return bpy.context.window_manager.windows[0]


def press_bake():
    screen = window().screen
    with bpy.context.temp_override(window=window(), screen=screen, area=screen.areas[0]):
        assert bpy.ops.object.desire_path_bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert bake_job.running() is not None
    assert not bpy.ops.object.desire_path_free.poll()


def shot(name):
    hands.screenshot(window(), FOLDER / f"{name}.png")


def pixels(name):
    """How many pixels of a screenshot are as orange as the arrows."""
    shot(name)
    image = bpy.data.images.load(str(FOLDER / f"{name}.png"))
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    bpy.data.images.remove(image)
    red, green, blue = found.reshape(-1, 4)[:, :3].T
    return int(((red > 0.8) & (green > 0.45) & (green < 0.9) & (blue < 0.3)).sum())


def dark(name):
    """How many pixels of a screenshot that was taken are as dark as the graph's paper."""
    image = bpy.data.images.load(str(FOLDER / f"{name}.png"))
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    bpy.data.images.remove(image)
    return int((found.reshape(-1, 4)[:, :3].max(axis=1) < 0.17).sum())


def a_ground_and_a_walker():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    ground = meshes.grid(120, 260, 0.01, -0.6, -2.2)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.folder = str(FOLDER / "bake")
    meshes.activate(people.walk(people.biped(), frames=60))
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground)
    for area in window().screen.areas:
        if area.type == "PROPERTIES":
            area.spaces[0].context = "PHYSICS"
    yield 0.5


def esc_keeps_what_was_baked():
    """ESC: what was baked stays and plays."""
    sim.Film.write_frame = slowly
    press_bake()
    yield from hands.until(lambda: bake_job.running() is None or bake_job.running().fraction > 0.3)
    job = bake_job.running()
    assert job is not None and job.fraction < 0.9, "it ran in one go"
    shot("baking")
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type="ESC", value=value, x=10, y=10)
    yield from hands.until(lambda: bake_job.running() is None)
    ground = bpy.data.objects["Ground"]
    index = bake.read_index(str(FOLDER / "bake"))
    assert not index.complete and index.frames >= 18
    assert f"frames 1 to {index.frames} play" in ground.desire_path.missing
    assert playback.modifier(ground) is not None and ground.desire_path.bake_state == "PARTIAL"
    yield 0.3


def cancelled_and_baked_to_the_end():
    """The Cancel button, then once more to the end."""
    press_bake()
    yield from hands.until(lambda: bake_job.running() is None or bake_job.running().fraction > 0.6)
    assert bpy.ops.object.desire_path_cancel() == {"FINISHED"}
    yield from hands.until(lambda: bake_job.running() is None)
    index = bake.read_index(str(FOLDER / "bake"))
    assert not index.complete and index.frames >= 36, index
    sim.Film.write_frame = write_frame
    yield 0.3
    press_bake()
    yield from hands.until(lambda: bake_job.running() is None)
    ground = bpy.data.objects["Ground"]
    assert bake.read_index(str(FOLDER / "bake")).complete
    assert not ground.desire_path.missing and "contacts" in ground.desire_path.summary
    yield from hands.until(lambda: state.last(ground) == state.Status("FRESH"))
    shot("done")


def a_change_is_seen_and_free_asks():
    """A change is seen without anybody asking; Free asks, and nothing is lost before the answer."""
    ground, walker = bpy.data.objects["Ground"], bpy.data.objects["Walker"]
    walker.location.x = 0.1
    yield from hands.until(lambda: (state.last(ground) or state.Status("")).state == "OUTDATED")
    yield 0.5
    shot("outdated")
    walker.location.x = 0.0
    yield from hands.until(lambda: state.last(ground) == state.Status("FRESH"))
    with bpy.context.temp_override(window=window(), area=window().screen.areas[0]):
        bpy.ops.object.desire_path_free("INVOKE_DEFAULT")
    yield 0.5
    shot("asked")
    assert playback.modifier(ground) is not None and bake.read_index(str(FOLDER / "bake")).complete
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type="ESC", value=value, x=10, y=10)
    yield 0.5
    assert playback.modifier(ground) is not None
    meshes.activate(bpy.data.objects["Walker"])
    yield 0.5
    shot("walker")


def forces_are_drawn():
    """Forces are drawn while they are shown, and gone with the file."""
    bpy.context.scene.frame_set(30)
    view = next(area for area in window().screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(window=window(), area=view, region=view.regions[-1]):
        bpy.ops.view3d.view_axis(type="RIGHT")
        bpy.ops.view3d.view_selected()
    yield 0.5
    without = pixels("plain")
    assert bpy.ops.object.desire_path_forces_show() == {"FINISHED"}
    walker = bpy.data.objects["Walker"]
    assert op_forces.shows(walker) and op_forces._handles
    yield 0.5
    assert pixels("forces") > without + 100, "no arrow is seen"
    assert "contacts" in walker.desire_path.forces
    return without


def the_graph_lies_in_the_corner(without):
    """The graph lies in the corner: paper, letters and curves, and goes again."""
    before, walker = dark("forces"), bpy.data.objects["Walker"]
    assert bpy.ops.object.desire_path_forces_graph() == {"FINISHED"} and op_forces.shows_graph(walker)
    yield 0.5
    shot("graph")
    assert dark("graph") > before + 20000, "no graph is seen"
    bpy.context.scene.frame_set(36)
    yield 0.5
    shot("later")
    assert bpy.ops.object.desire_path_forces_graph() == {"FINISHED"} and not op_forces.shows_graph(walker)
    bpy.context.scene.frame_set(30)
    yield 0.5
    shot("nograph")
    assert dark("nograph") < before + 1000
    assert bpy.ops.object.desire_path_forces_show() == {"FINISHED"}
    assert not op_forces._handles
    yield 0.5
    assert pixels("hidden") == without
    bpy.ops.object.desire_path_forces_show()
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert not op_forces._handles and not op_forces._shown
    yield 0.5


def story():
    yield from a_ground_and_a_walker()
    yield from esc_keeps_what_was_baked()
    yield from cancelled_and_baked_to_the_end()
    yield from a_change_is_seen_and_free_asks()
    without = yield from forces_are_drawn()
    yield from the_graph_lies_in_the_corner(without)


hands.tell(story())
