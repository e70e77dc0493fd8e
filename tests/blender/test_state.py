"""The state of a bake is told truly: what was changed, lost or stopped, and that nothing was."""

import json
import shutil

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import refused, scene
from test_home import files, opened, saved
from test_playback import shown
from test_sample import ids

import desire_path
from desire_path.bake import output
from desire_path.blender import axes, bake_job, compat, home, playback


def keys(obj):
    return compat.curves(obj.animation_data, obj)


def baked(folder, **more):
    ground, walker = scene(folder, frames=8, cell=0.03, **more)
    assert ground.desire_path.bake_state == "NONE" and not ground.desire_path.missing
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.bake_state == "FRESH" and not ground.desire_path.missing
    return ground, walker


def test_whatever_is_changed_and_changed_back(folder):
    ground, walker = baked(folder)
    settings, wears = ground.desire_path, walker.desire_path
    key = keys(walker)[0].keyframe_points[3]
    bump = ground.modifiers.new("Bump", "DISPLACE")
    bump.strength, bump.show_viewport, bump.show_render = 0.01, False, False
    bone = walker.data.bones["foot.L"]
    changes = (  # who, what, another value, the words it is told with
        (settings, "cell_size", 0.031, "settings"),
        (settings, "soil", "snow", "settings"),
        (settings, "frame_end", 7, "settings"),
        (settings, "law", "uniform", "settings"),
        (settings, "attributes", False, "settings"),
        (settings, "vertex_group", True, "settings"),
        (wears, "mass", 74.5, "walk"),
        (wears, "load_model", "impulse", "settings"),
        (wears, "place_feet", True, "settings"),
        (wears, "subframes", 2, "walk"),
        (wears, "ground", None, "Nobody walks"),
        (key, "co", (key.co[0], key.co[1] + 0.004), "walk"),
        (walker.location, "x", 0.01, "walk"),
        (bpy.context.scene.render, "fps", 31, "settings"),
        (ground.location, "z", -0.01, "ground"),
        (ground, "rotation_euler", (0.0, 0.0, 0.01), "ground"),
        (lambda: ground.data.vertices[0].co, "z", 0.02, "ground"),
        (bone, "use_deform", bone.use_deform, None),
        (walker, "hide_viewport", True, None),
        (walker, "name", "Somebody", None),
        (ground, "name", "Beach", None),
        (settings, "threads", 1, None),
    )
    for who, what, value, words in changes:
        find = who if callable(who) else lambda who=who: who
        before = getattr(find(), what)
        before = tuple(before) if hasattr(before, "__len__") and not isinstance(before, str) else before
        setattr(find(), what, value)  # and nobody updates anything
        told = settings.missing
        assert settings.bake_state == ("OUTDATED" if words else "FRESH"), (who, what, told)
        assert (words in told and "bake again" in told or words == "Nobody walks" in told) if words else not told, (
            who,
            what,
            told,
        )
        setattr(find(), what, before)
        assert settings.bake_state == "FRESH", (who, what, settings.missing)
    known = ids()
    bump.show_viewport = bump.show_render = True
    assert settings.bake_state == "OUTDATED" and "ground" in settings.missing
    ground.modifiers.remove(bump)
    assert settings.bake_state == "FRESH" and ids() == known
    bpy.data.objects.remove(walker)
    assert settings.bake_state == "OUTDATED" and "Nobody walks" in settings.missing


def test_what_changes_nothing(folder):
    """Frames that are shown, selection, undo, another file in between, the file moved with its folder."""
    ground, walker = saved(folder / "here" / "one.blend", frames=8, cell=0.03)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.context.scene.frame_set(5)
    meshes.activate(walker)
    assert ground.desire_path.bake_state == "FRESH"
    meshes.activate(ground)
    bpy.ops.ed.undo_push(message="baked")
    walker.location.x = 0.2
    bpy.ops.ed.undo_push(message="moved")
    assert ground.desire_path.bake_state == "OUTDATED"
    bpy.ops.ed.undo()
    ground = bpy.data.objects["Ground"]
    assert ground.desire_path.bake_state == "FRESH"
    bpy.ops.ed.redo()
    assert bpy.data.objects["Ground"].desire_path.bake_state == "OUTDATED"
    bpy.ops.ed.undo()
    bpy.ops.wm.save_mainfile()
    assert opened(folder / "here" / "one.blend").desire_path.bake_state == "FRESH"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "here" / "two.blend"))
    assert bpy.data.objects["Ground"].desire_path.bake_state == "FRESH"
    (folder / "else").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "else" / "two.blend"))
    assert bpy.data.objects["Ground"].desire_path.bake_state == "FRESH"
    assert opened(folder / "else" / "two.blend").desire_path.bake_state == "FRESH"
    bpy.ops.wm.read_factory_settings(use_empty=True)
    (folder / "here").rename(folder / "there")
    ground = opened(folder / "there" / "one.blend")
    assert ground.desire_path.bake_state == "FRESH"
    bpy.data.objects["Walker"].desire_path.mass = 60.0
    assert ground.desire_path.bake_state == "OUTDATED"


def test_a_ground_of_two_scenes_is_told_of_by_the_one_where_somebody_walks(folder):
    ground, walker = baked(folder)
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(ground)
    other.render.fps = 48
    bpy.context.window.scene = other
    assert ground.desire_path.bake_state == "FRESH", ground.desire_path.missing
    walker.delta_location.x = 0.01
    assert ground.desire_path.bake_state == "OUTDATED" and "The walk has changed" in ground.desire_path.missing
    bpy.data.objects.remove(walker)
    assert ground.desire_path.bake_state == "OUTDATED" and "Nobody walks" in ground.desire_path.missing


def test_transforms_that_are_applied_after_the_bake(folder):
    """The points of the ground have other numbers and lie where they lay: nothing is to be baked again."""
    hills = lambda x, y: 0.004 * np.sin(9 * x) * np.cos(7 * y)  # noqa: E731
    for number, applied in enumerate((("scale",), ("rotation",), ("location",), ("location", "rotation", "scale"))):
        ground = meshes.grid(60, 130, 0.01, -0.3, -1.1, hills)
        ground.scale, ground.rotation_euler, ground.location = (2.0, 2.1, 1.9), (0.0, 0.0, 0.2), (0.05, -0.1, 0.001)
        paint = ground.vertex_groups.new(name="wet")
        paint.add(range(4000), 1.0, "REPLACE")
        meshes.activate(ground)
        assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
        ground.desire_path.folder, ground.desire_path.cell_size = str(folder / str(number)), 0.02
        ground.desire_path.painted.add().vertex_group = "wet"
        walker = people.walk(people.biped(f"Walker {number}"), frames=12)
        meshes.activate(walker)
        assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
        meshes.activate(ground)
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        before = placed(ground, 12)
        chosen = {each: each in applied for each in ("location", "rotation", "scale")}
        assert bpy.ops.object.transform_apply(**chosen) == {"FINISHED"}
        assert np.abs(placed(ground, 12) - before).max() < 1e-5
        assert ground.desire_path.bake_state == "FRESH", (applied, ground.desire_path.missing)
        trodden = int(np.argmin(before[:, 2]))
        height = ground.data.vertices[trodden].co.z
        ground.data.vertices[trodden].co.z = height + 1e-3
        assert ground.desire_path.bake_state == "OUTDATED" and "ground" in ground.desire_path.missing
        ground.data.vertices[trodden].co.z = height
        assert ground.desire_path.bake_state == "FRESH"
        paint.add([trodden], 0.5, "REPLACE")
        assert ground.desire_path.bake_state == "OUTDATED"
        for each in (ground, walker):
            bpy.data.objects.remove(each)
        bpy.context.view_layer.update()  # nothing is selected that is gone


def placed(ground, frame):
    """The points of a ground in the world as they are shown."""
    return axes.points(np.array(ground.matrix_world), shown(ground, frame)[0], 1.0)


def test_a_copy_that_is_moved(folder):
    ground, _ = baked(folder)
    for linked in (False, True):
        copy = ground.copy()
        if not linked:
            copy.data = ground.data.copy()
        bpy.context.scene.collection.objects.link(copy)
        assert copy.desire_path.bake_state == "FRESH"
        copy.location.x += 5.0
        bpy.context.view_layer.update()
        assert copy.desire_path.bake_state == "OUTDATED" and "moved since the bake" in copy.desire_path.missing
        assert ground.desire_path.bake_state == "FRESH"
        copy.location.x -= 5.0
        bpy.context.view_layer.update()
        assert copy.desire_path.bake_state == "FRESH"
        bpy.data.objects.remove(copy)


def test_files_that_are_gone(folder):
    ground, _ = baked(folder)
    place = folder / "bake" / "frames"
    kept = files(folder / "bake")

    def restored():
        shutil.rmtree(folder / "bake", ignore_errors=True)
        for name, data in kept.items():
            path = folder / "bake" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        assert ground.desire_path.bake_state == "FRESH"

    for name in ("maps_start.exr", "maps_final.exr", "report.json"):
        (folder / "bake" / name).unlink()
        assert ground.desire_path.bake_state == "MISSING"
        assert f"{name} of the last bake is gone" in ground.desire_path.missing
        restored()
    (place / "trail_0005.exr").unlink()
    assert ground.desire_path.bake_state == "MISSING" and "5 to 8 are missing" in ground.desire_path.missing
    restored()
    (place / "index.json").write_text("{")
    assert ground.desire_path.bake_state == "MISSING" and "damaged" in ground.desire_path.missing
    restored()
    (place / "index.json").unlink()
    assert ground.desire_path.bake_state == "MISSING"
    restored()
    shutil.rmtree(folder / "bake")
    assert ground.desire_path.bake_state == "MISSING" and "bake" in ground.desire_path.missing
    restored()
    index = json.loads((place / "index.json").read_text())
    del index["inputs"]
    (place / "index.json").write_text(json.dumps(index))
    assert ground.desire_path.bake_state == "OUTDATED" and "earlier" in ground.desire_path.missing


def test_soles_of_few_cells_are_told_before_anything_is_written(folder):
    ground, _ = scene(folder, frames=8, cell=0.06)
    job = bake_job.Job(bpy.context.scene, ground)
    steps = job.run()
    while not job.early:
        assert job.bake is None
        next(steps)
    (told,) = (each for each in job.early if "too few for a print to have their shape: choose a cell size of" in each)
    assert not files(folder / "bake")
    steps.close()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert json.loads(ground.desire_path.summary)["warnings"].count(told) == 1


def stopped(after):
    """Bake, stopped as ESC does after so many steps of writing."""
    job = bake_job.Job(bpy.context.scene, bpy.context.object)
    steps = job.run()
    while job.fraction < after:
        next(steps)
    steps.close()
    job.play()


def test_a_bake_that_was_stopped(folder):
    ground, walker = scene(folder, frames=12, cell=0.03)
    stopped(0.4)
    assert ground.desire_path.bake_state == "PARTIAL" and "bake again to go on" in ground.desire_path.missing
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.bake_state == "FRESH"
    before, _ = shown(ground, 12)
    stopped(0.4)  # in a bake of the same: what was whole plays on
    assert ground.desire_path.bake_state == "FRESH" and shown(ground, 12)[0].tobytes() == before.tobytes()
    walker.desire_path.mass = 40.0
    stopped(0.4)
    assert ground.desire_path.bake_state == "OUTDATED" and shown(ground, 12)[0].tobytes() == before.tobytes()
    walker.desire_path.mass = 75.0
    assert ground.desire_path.bake_state == "FRESH"
    ground.location.x = 0.1  # what plays was pressed before it was moved
    bpy.context.view_layer.update()
    stopped(0.4)
    assert ground.desire_path.bake_state == "OUTDATED" and shown(ground, 12)[0].tobytes() == before.tobytes()


def test_a_bake_that_was_stopped_goes_on_from_there(folder):
    ground, _ = scene(folder, frames=12, cell=0.03)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    names = ("frames/trail_0012.exr", "maps_final.exr", "maps_start.exr")
    want = [(folder / "bake" / name).read_bytes() for name in names]
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    stopped(0.4)
    job = bake_job.Job(bpy.context.scene, bpy.context.object)
    come = [job.fraction for _ in job.run() if job.fraction]
    assert come[0] > 0.4 and come[-1] == 1.0  # nothing of before was simulated again
    job.finish()
    assert ground.desire_path.bake_state == "FRESH"
    assert [(folder / "bake" / name).read_bytes() for name in names] == want


def test_a_first_bake_in_another_file_that_was_stopped(folder):
    ground, walker = saved(folder / "one.blend", frames=12, cell=0.03)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    before, _ = shown(ground, 12)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "two.blend"))
    walker.desire_path.mass = 40.0
    stopped(0.4)
    for _ in range(2):
        assert shown(ground, 12)[0].tobytes() == before.tobytes() and ground.desire_path.bake_state == "OUTDATED"
        bpy.ops.wm.save_mainfile()
        ground = opened(folder / "two.blend")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.bake_state == "FRESH" and home.played(ground) == str(folder / "desire_path/two/Ground")
    assert shown(ground, 12)[0].tobytes() != before.tobytes()


def test_undone_bakes(folder):
    ground, _ = scene(folder, frames=8, cell=0.03)
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="first")
    bpy.data.objects["Ground"].desire_path.soil = "snow"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="second")
    told = lambda: bpy.data.objects["Ground"].desire_path.bake_state  # noqa: E731
    assert told() == "FRESH"
    bpy.ops.ed.undo()
    assert told() == "OUTDATED"  # the files are those of snow
    bpy.ops.ed.undo()
    assert told() == "NONE"
    bpy.ops.ed.redo()
    bpy.ops.ed.redo()
    assert told() == "FRESH"


def test_free_is_undone_until_the_file_is_saved(folder):
    ground, _ = saved(folder / "one.blend", frames=8, cell=0.03)
    place = folder / "desire_path" / "one" / "Ground"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    kept, before = files(place), shown(ground, 8)[0].tobytes()
    (place / "frames" / "mine.txt").write_text("keep")
    bpy.ops.ed.undo_push(message="baked")
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="freed")
    rest = shown(ground, 8)[0].tobytes()
    for _ in range(2):
        ground = bpy.data.objects["Ground"]
        assert ground.desire_path.bake_state == "NONE" and shown(ground, 8)[0].tobytes() == rest != before
        assert list(files(place)) == ["frames/mine.txt"]
        bpy.ops.ed.undo()
        ground = bpy.data.objects["Ground"]
        assert ground.desire_path.bake_state == "FRESH" and shown(ground, 8)[0].tobytes() == before
        assert files(place) == kept | {"frames/mine.txt": b"keep"}
        assert not place.with_name("Ground.freed").exists()
        bpy.ops.ed.redo()
    bpy.ops.wm.save_mainfile()
    assert list(files(folder / "desire_path")) == ["one/Ground/frames/mine.txt"]
    bpy.ops.ed.undo_push(message="saved")
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    ground = bpy.data.objects["Ground"]
    assert playback.modifier(ground) is not None and ground.desire_path.bake_state == "MISSING"
    assert "bake" in ground.desire_path.missing and shown(ground, 8)[0].tobytes() == rest


def test_what_was_freed_goes_with_the_file(folder):
    ground, _ = saved(folder / "one.blend", frames=8, cell=0.03)
    for leave in (lambda: bpy.ops.wm.read_factory_settings(use_empty=True), desire_path.unregister):
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        bpy.ops.wm.save_mainfile()
        assert bpy.ops.object.desire_path_free() == {"FINISHED"}
        assert files(folder / "desire_path")
        leave()
        assert not (folder / "desire_path").exists()
        if leave is desire_path.unregister:
            desire_path.register()
        ground = opened(folder / "one.blend")
        assert ground.desire_path.bake_state == "MISSING"


def test_free_that_is_refused_changes_nothing(folder):
    ground, _ = baked(folder)
    other = output.Output(str(folder / "bake"))
    other.open()  # somebody bakes there
    try:
        before, _ = shown(ground, 8)
        refused(bpy.ops.object.desire_path_free, "Another bake", "is running")
        assert shown(ground, 8)[0].tobytes() == before.tobytes() and playback.modifier(ground) is not None
    finally:
        other.release()
    assert ground.desire_path.bake_state == "FRESH"
