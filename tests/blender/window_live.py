"""window_live.py - run by test_window.py in a Blender with a window: a ground that is changed is baked again."""

import pathlib
import sys
import time

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests"), str(ROOT / "tests" / "blender")]
bpy.context.preferences.view.show_splash = False
import desire_path  # noqa: E402

desire_path.register()
from scenes import hands, meshes, people  # noqa: E402

from desire_path.bake import bake  # noqa: E402
from desire_path.blender import bake_job, live, panels, playback, state, timeline  # noqa: E402
from desire_path.ground import sim  # noqa: E402

FOLDER = pathlib.Path(sys.argv[-1])
write_frame = sim.Film.write_frame
slowly = hands.slowed(write_frame)


def window():
    return bpy.context.window_manager.windows[0]


def ground():
    return bpy.data.objects["Ground"]


def until(condition, seconds=180):
    return hands.until(condition, seconds, 0.02, told)


def told():
    """What is on its way, for who reads a failure."""
    return (
        state.last(ground()),
        state.ask(ground()),
        live._work,
        live._done,
        state.changes(),
        state.baking,
        state.held,
        state.busy(),
        state.quiet_for(),
        live._calm,
    )


def shot(name):
    hands.screenshot(window(), FOLDER / f"{name}.png")


def bars(name):
    """How many pixels of a screenshot are of the colour of each kind of bar, in the lowest quarter of it."""
    shot(name)
    image = bpy.data.images.load(str(FOLDER / f"{name}.png"))
    found = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(found)
    wide, high = image.size
    bpy.data.images.remove(image)
    found = found.reshape(high, wide, 4)[: high // 4, :, :3]
    red, green, blue = np.moveaxis(found, -1, 0)
    strong = (red > 0.85) & (green > 0.45) & (green < 0.62) & (blue < 0.2)
    bright = (red > 0.95) & (green > 0.8) & (blue < 0.4)
    return int(strong.sum()), int(bright.sum())


def timed(call, took):
    def timing(*given):
        begun = time.thread_time()
        try:
            return call(*given)
        finally:
            took.append(time.thread_time() - begun)

    return timing


def made():
    """What the bake that is there was made from."""
    return dict(bake.read_index(str(FOLDER / "bake")).inputs)


def push(message):
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message=message)


def settled(before):
    """Wait until another bake plays and a panel would show a tick; what it shows until then is no tick."""
    seen = set()

    def done():
        told = state.last(ground())
        seen.add(told and told.state)
        fresh = told == state.Status("FRESH")
        assert not fresh or made() != before, "a tick for what is outdated"
        assert playback.modifier(ground()) is not None
        return fresh and made() != before

    yield from until(done)
    assert ground().desire_path.bake_state == "FRESH"
    return seen


def a_ground_and_a_walker():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    meshes.activate(meshes.grid(2, 2, 8.0, -4.0, -6.0))
    assert not live.begun() and not timeline._handles
    bpy.ops.object.desire_path_ground_add()
    ground().desire_path.folder = str(FOLDER / "bake")
    meshes.activate(people.walk(people.biped(), frames=60))
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground())
    for area in window().screen.areas:
        if area.type == "PROPERTIES":
            area.spaces[0].context = "PHYSICS"
        elif area.type == "VIEW_3D":
            area.type = "TEXT_EDITOR"  # which is drawn at once without a graphics card
    push("Scene")
    assert not live.begun()


def switched_on_it_bakes():
    """Switched on, it bakes what was not baked yet; the file is listened to from now on."""
    ground().desire_path.auto_update = True
    push("Auto Update")
    assert live.begun()
    yield from until(lambda: state.last(ground()) == state.Status("FRESH"))
    assert playback.modifier(ground()) is not None
    yield 1.0
    assert not bpy.app.timers.is_registered(live._tick), "it looks for ever"


def changes_are_baked_again():
    """Another soil, a mass, a key, the mesh and its place are baked again; no datablock is exchanged."""
    before, old = made(), playback.modifier(ground()).node_group
    begun = time.monotonic()
    ground().desire_path.soil = "mud"
    push("Mud")
    assert state.last(ground()) != state.Status("FRESH")
    seen = yield from settled(before)
    print(f"again after {time.monotonic() - begun:.2f} s", seen, flush=True)
    assert "BAKING" in seen, seen
    assert playback.modifier(ground()).node_group == old
    yield 0.5
    strong, bright = bars("fresh")
    assert strong > 300 and bright == 0, (strong, bright)
    for change in (
        lambda: setattr(bpy.data.objects["Walker"].desire_path, "mass", 40.0),
        lambda: setattr(ground().data.vertices[0].co, "z", 0.4) or ground().data.update(),
    ):
        before = made()
        change()
        push("Change")
        yield from settled(before)


def undo_and_redo_are_followed():
    """Undo and redo are followed, too."""
    for step in (bpy.ops.ed.undo, bpy.ops.ed.redo):
        before = made()
        with bpy.context.temp_override(window=window()):
            assert step() == {"FINISHED"}
        yield from settled(before)


def while_the_animation_plays():
    """While the animation plays, too."""
    screen = window().screen
    with bpy.context.temp_override(window=window(), screen=screen, area=screen.areas[0]):
        bpy.ops.screen.animation_play()
    before = made()
    ground().desire_path.soil = "dry-soil"
    push("Dry Soil")
    yield from settled(before)
    with bpy.context.temp_override(window=window(), screen=screen, area=screen.areas[0]):
        bpy.ops.screen.animation_cancel()
    yield 0.2


def a_change_while_it_bakes():
    """A change while it bakes: it begins anew, and takes no key."""
    sim.Film.write_frame = slowly
    before = made()
    ground().desire_path.soil = "snow"
    push("Snow")
    yield from until(lambda: live._work is not None and live._work.job.fraction > 0.4)
    assert made() == before and not len(getattr(window(), "modal_operators", ()))
    strong, bright = bars("updating")
    assert strong == 0 and bright > 10, (strong, bright)
    assert bake_job.running() is None and bpy.ops.object.desire_path_bake.poll()
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type="ESC", value=value, x=10, y=10)
    yield 0.1
    assert live._work is not None
    first = live._work
    ground().desire_path.soil = "wet-soil"
    push("Wet Soil")
    yield from until(lambda: live._work is not None and live._work is not first)
    assert first.job.bake.report is None and made() == before
    sim.Film.write_frame = write_frame
    yield from settled(before)


def what_takes_longer_is_coarse_first():
    """What takes longer is shown coarse first, which is in no file."""
    sim.Film.write_frame, live.LONG = slowly, 0.2
    before = made()
    ground().desire_path.soil = "snow"
    push("Snow")
    yield from until(lambda: live._work is not None and live._work.coarse and live._work.coarse.shown)
    assert any(map(playback.is_by_hand, ground().modifiers)) and made() == before
    assert state.last(ground()).state == "BAKING" and not playback.modifier(ground()).show_viewport
    shot("coarse")
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "saved.blend"), copy=True)
    assert live._work is None and not any(map(playback.is_by_hand, ground().modifiers))
    assert playback.modifier(ground()).show_viewport
    yield from until(lambda: live._work is not None and live._work.coarse and live._work.coarse.shown)
    ground().desire_path.soil = "wet-soil"
    push("Wet Soil")
    yield from until(lambda: not any(map(playback.is_by_hand, ground().modifiers)))
    assert made() == before and playback.modifier(ground()).show_viewport
    sim.Film.write_frame, live.LONG = write_frame, 1.0
    yield from until(lambda: state.last(ground()) == state.Status("FRESH"))
    assert not any(map(playback.is_by_hand, ground().modifiers))


def a_bake_that_was_asked_for_goes_first():
    """A bake that was asked for has the right of way, one that is freed is not made again."""
    sim.Film.write_frame = slowly
    ground().desire_path.soil = "snow"
    push("Snow")
    yield from until(lambda: live._work is not None and live._work.job.fraction > 0.1)
    screen = window().screen
    with bpy.context.temp_override(window=window(), screen=screen, area=screen.areas[0]):
        assert bpy.ops.object.desire_path_bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert live._work is None
    sim.Film.write_frame = write_frame
    yield from until(lambda: bake_job.running() is None)
    yield from until(lambda: state.last(ground()) == state.Status("FRESH"))
    with bpy.context.temp_override(window=window(), area=screen.areas[0]):
        bpy.ops.object.desire_path_free("EXEC_DEFAULT")
    assert not ground().desire_path.auto_update
    ground().location.z = 0.0
    yield 1.0
    yield from until(lambda: state.last(ground()) == state.Status("NONE"))
    assert playback.modifier(ground()) is None


def drawing_takes_little():
    """Drawing takes less than a millisecond of ours."""
    took = {}
    for module, name in ((panels, "draw"), (timeline, "spans")):
        took[name] = []
        setattr(module, name, timed(getattr(module, name), took[name]))
    for area in window().screen.areas:
        area.tag_redraw()
    yield 1.0
    print({name: f"{1000 * min(each):.2f} ms" for name, each in took.items() if each}, flush=True)


def another_file_listens_no_more():
    """Another file listens no more."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield 0.5
    assert not live.begun() and not bpy.app.timers.is_registered(live._tick) and not timeline._handles


def story():
    a_ground_and_a_walker()
    yield from switched_on_it_bakes()
    yield from changes_are_baked_again()
    yield from undo_and_redo_are_followed()
    yield from while_the_animation_plays()
    yield from a_change_while_it_bakes()
    yield from what_takes_longer_is_coarse_first()
    yield from a_bake_that_was_asked_for_goes_first()
    yield from drawing_takes_little()
    yield from another_file_listens_no_more()


hands.tell(story())
