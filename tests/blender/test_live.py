"""Auto Update bakes what was changed, and only that; what plays keeps its datablocks, so that undo finds them."""

import os

import bpy
import numpy as np
from scenes import meshes, people

from desire_path.bake.bake import read_index
from desire_path.blender import bake_job, compat, live, playback, playback_tree, state, timeline

FRAMES = 24


def scene(folder, ground=None):
    """A plane of one face that follows what is changed, and somebody who has walked over it."""
    ground = ground or meshes.grid(2, 2, 8.0, -4.0, -6.0)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.folder, settings.cell_size, settings.auto_update = str(folder), 0.02, True
    walker = people.walk(people.biped(), frames=FRAMES)
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground)
    assert live.update(bpy.context.scene) == []
    return ground, walker


def datablocks():
    lists = (bpy.data.node_groups, bpy.data.images, bpy.data.objects, bpy.data.meshes)
    return [sorted(each.as_pointer() for each in found) for found in lists]


def deepest(ground):
    bpy.context.scene.frame_set(FRAMES)
    found = ground.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return float(compat.positions(found.data)[:, 2].min())


def test_nothing_happens_by_itself_without_a_window(folder):
    ground, _ = scene(folder)
    assert ground.desire_path.bake_state == "FRESH" and not live.begun()
    ground.desire_path.soil = "mud"
    assert ground.desire_path.bake_state == "OUTDATED" and state.last(ground) != state.Status("FRESH")
    ground.desire_path.auto_update = False
    assert live.update(bpy.context.scene) == [] and ground.desire_path.bake_state == "OUTDATED"


def follows(folder, ground):
    ground, walker = scene(folder, ground)
    shallow, before = deepest(ground), datablocks()
    assert shallow < -0.001
    settings = ground.desire_path
    for who, what, value in (
        (settings, "soil", "snow"),
        (walker.desire_path, "mass", 150.0),
        (settings.soil_numbers, "layer_depth", 0.21),
        (settings, "cell_size", 0.016),
        (walker.location, "x", 0.05),
        (settings, "frame_end", FRAMES - 2),
        (settings, "attributes", False),
    ):
        setattr(who, what, value)
        bpy.context.view_layer.update()
        assert settings.bake_state == "OUTDATED"
        assert live.update(bpy.context.scene) == []
        assert settings.bake_state == "FRESH" and state.last(ground) == state.Status("FRESH"), what
        assert datablocks() == before, what
    assert deepest(ground) < 3.0 * shallow
    return ground


def test_a_refined_ground_follows_with_the_datablocks_it_has(folder):
    ground = follows(folder, None)
    copy = playback_tree.copy_of(playback.modifier(ground).node_group)
    assert copy is not None and len(copy.data.vertices) > 1000


def test_a_fine_ground_follows_with_the_datablocks_it_has(folder):
    ground = follows(folder, meshes.grid(200, 300, 0.02, -2.0, -4.0))
    assert playback_tree.copy_of(playback.modifier(ground).node_group) is None


def test_what_plays_is_what_a_bake_of_its_own_would_show(folder):
    """Numbers that a tree has taken over are those it would have been made with."""
    ground, walker = scene(folder / "one")
    settings = ground.desire_path
    settings.soil, settings.cell_size, settings.frame_end = "snow", 0.025, FRAMES - 3
    walker.location.y = 0.3
    assert live.update(bpy.context.scene) == []
    taken = compat.positions(ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)
    playback.detach(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    made = compat.positions(ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)
    np.testing.assert_array_equal(taken, made)


def test_undo_finds_what_was_there(folder):
    scene(folder)
    bpy.ops.ed.undo_push(message="Scene")
    other = bpy.data.objects.new("Other", None)
    bpy.context.collection.objects.link(other)
    for step in range(3):
        bpy.data.objects["Other"].location.x = step
        bpy.ops.ed.undo_push(message=f"Step {step}")
    for soil in ("snow", "mud"):
        bpy.data.objects["Ground"].desire_path.soil = soil
        assert live.update(bpy.context.scene) == []
    for step in (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo):
        assert step() == {"FINISHED"}
        ground = bpy.data.objects["Ground"]
        assert deepest(ground) < -0.001 and len(ground.modifiers) == 1
        ground.desire_path.soil = "soil"
        assert live.update(bpy.context.scene) == []


def test_a_bake_that_is_fresh_is_not_made_again(folder):
    ground, _ = scene(folder)
    stamp = (folder / "report.json").stat().st_mtime_ns
    bpy.data.objects.new("Other", None)
    assert live.update(bpy.context.scene) == []
    assert (folder / "report.json").stat().st_mtime_ns == stamp
    ground.desire_path.soil = "mud"
    assert live.update(bpy.context.scene) == []
    assert (folder / "report.json").stat().st_mtime_ns != stamp


def test_what_cannot_be_baked_is_told_and_the_earlier_bake_plays_on(folder):
    ground, walker = scene(folder)
    before = deepest(ground)
    walker.location.x = 100.0
    (wrong,) = live.update(bpy.context.scene)
    assert "beside the ground" in wrong
    assert deepest(ground) == before and ground.desire_path.bake_state == "OUTDATED"


def test_free_switches_it_off(folder):
    ground, _ = scene(folder)
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert not ground.desire_path.auto_update and live.update(bpy.context.scene) == []
    assert playback.modifier(ground) is None


def test_a_tree_that_others_use_is_left_to_them(folder):
    ground, _ = scene(folder / "one")
    other = ground.copy()
    bpy.context.collection.objects.link(other)
    other.desire_path.is_ground = False
    tree = playback.modifier(other).node_group
    ground.desire_path.soil = "snow"
    assert live.update(bpy.context.scene) == []
    assert playback.modifier(other).node_group == tree != playback.modifier(ground).node_group


def test_the_bar_tells_what_plays(folder):
    ground, walker = scene(folder)
    assert timeline.ground_of(walker) == timeline.ground_of(ground) == ground
    state.hear()
    state.ask(ground)
    assert timeline.spans(ground) == [("RANGE", 1, FRAMES), ("FRESH", 1, FRAMES)]
    ground.desire_path.soil = "mud"
    bpy.context.view_layer.update()
    assert timeline.spans(ground) == [("RANGE", 1, FRAMES), ("UNSURE", 1, FRAMES)]
    state.ask(ground)
    assert timeline.spans(ground) == [("RANGE", 1, FRAMES), ("OUTDATED", 1, FRAMES)]
    job = bake_job.Job(bpy.context.scene, ground)
    bake_job.again(job)
    steps = job.run()
    try:
        while job.frame != 9:
            next(steps)
        assert timeline.spans(ground) == [("RANGE", 1, FRAMES), ("OUTDATED", 1, FRAMES), ("MAKING", 1, 9)]
    finally:
        bake_job.again(None)
        steps.close()
    playback.detach(ground)
    for number in range(13, FRAMES + 1):
        (folder / "frames" / f"trail_{number:04d}.exr").unlink()
    assert timeline.spans(ground) == [("RANGE", 1, FRAMES)]
    state.unregister()
    assert state._scene_changed not in bpy.app.handlers.depsgraph_update_post


def test_the_bar_of_a_stopped_bake_ends_where_it_was_stopped(folder):
    ground, _ = scene(folder)
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    job = bake_job.Job(bpy.context.scene, ground)
    steps = job.run()
    while job.frame != 9:
        next(steps)
    steps.close()
    job.play()
    state.ask(ground)
    kind, first, last = timeline.spans(ground)[1]
    assert (kind, first) == ("FRESH", 1) and 7 <= last <= 10
    assert last == read_index(str(folder)).frames


def test_what_takes_long_is_shown_coarse_first_and_never_kept_so(folder):
    ground, _ = scene(folder)
    own, before, shallow = read_index(folder), datablocks(), deepest(ground)
    inputs, hidden = dict(own.inputs), []
    ground.desire_path.soil = "snow"
    live.SEEN = live.LONG = -1.0  # whatever it takes is long
    try:
        for stopped in (True, False):
            work = live._Work(bpy.context.scene, ground, previews=True)
            for _ in work.steps:
                if work.coarse and work.coarse.shown:
                    assert not playback.modifier(ground).show_viewport and deepest(ground) < 2.0 * shallow
                    assert read_index(folder).inputs == inputs, "what plays is another one"
                    hidden.append(work.coarse.folder)
                    assert work.coarse.cell > 0.03 and "Until then shown in cells of" in work.progress()
                    if stopped:
                        break
            assert hidden
            if stopped:
                live._work = work
                live.drop()
                assert datablocks() == before and playback.modifier(ground).show_viewport
                assert abs(deepest(ground) - shallow) < 1e-6 and read_index(folder).inputs == inputs
            else:
                live._show(work)
    finally:
        live.SEEN, live.LONG = 0.25, 1.0
    assert not any(map(playback.is_by_hand, ground.modifiers)) and playback.modifier(ground).show_viewport
    assert ground.desire_path.bake_state == "FRESH" and read_index(folder).cell == own.cell
    assert datablocks() == before and deepest(ground) < 2.0 * shallow
    assert not any(map(os.path.exists, hidden))
