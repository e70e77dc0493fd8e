"""A baked ground that is changed goes on showing its prints where they were pressed."""

import bpy
import numpy as np
from scenes import meshes
from test_stack import raised, scatter, strip, tree_of, trodden

from desire_path.blender import compat, playback, playback_tree

LAST = 30


def drop(ground, points):
    """Heights of a ground in the world above points (n, 2), of its nearest ones."""
    scene = bpy.context.scene
    scene.frame_set(LAST)
    found = ground.evaluated_get(bpy.context.evaluated_depsgraph_get())
    world = np.array(found.matrix_world)
    there = compat.positions(found.data) @ world[:3, :3].T + world[:3, 3]
    far = ((there[None, :, :2] - points[:, None]) ** 2).sum(axis=-1)
    return there[far.argmin(axis=1), 2]


def lowest(ground, level=0.0):
    """(places, heights) of the lowest points (n, 2), (n,)."""
    bpy.context.scene.frame_set(LAST)
    found = ground.evaluated_get(bpy.context.evaluated_depsgraph_get())
    world = np.array(found.matrix_world)
    there = compat.positions(found.data) @ world[:3, :3].T + world[:3, 3]
    there = there[np.argsort(there[:, 2])[:40]]
    assert there[:, 2].max() < level - 0.004
    return there[:, :2], there[:, 2]


def order(ground):
    return [each.name for each in ground.modifiers]


def test_a_subdivision_that_is_added_later_shows_the_prints(folder):
    fine = strip()
    trodden(fine, folder / "fine")
    places, wanted = lowest(fine)
    ground = meshes.grid(2, 2, 1.2, -0.6, -2.2 * 1.2 / 2.6)  # a plane of one face
    ground.desire_path.refine = False
    ground.scale.y = 2.6 / 1.2
    for walker in [each for each in bpy.data.objects if each.type == "ARMATURE"]:
        bpy.data.objects.remove(walker)
    fine.desire_path.is_ground = False
    bpy.context.view_layer.update()
    assert "cannot be seen" in trodden(ground, folder / "plane")
    sub = ground.modifiers.new("Fine", "SUBSURF")
    sub.subdivision_type, sub.levels, sub.render_levels = "SIMPLE", 7, 7
    bpy.context.view_layer.update()
    assert order(ground) == ["Fine", playback_tree.MODIFIER]
    assert np.abs(drop(ground, places) - wanted).mean() < 0.002
    assert "subdivide" not in ground.desire_path.summary  # as it was told before
    sub.levels = sub.render_levels = 8
    compat.move_modifier(ground, playback.modifier(ground), 0)  # moved by hand
    bpy.context.view_layer.update()
    assert order(ground) == ["Fine", playback_tree.MODIFIER]
    meshes.activate(ground)
    bpy.ops.object.modifier_apply(modifier="Fine")
    assert order(ground) == [playback_tree.MODIFIER]
    assert np.abs(drop(ground, places) - wanted).mean() < 0.002


def test_what_is_added_on_the_ground_stays_behind_us(folder):
    ground = strip()
    trodden(ground, folder)
    before = len(bpy.data.node_groups), len(bpy.data.images)
    ground.modifiers.new("Hair", "PARTICLE_SYSTEM")
    tree_of(ground, "stones", scatter)
    bpy.context.scene.frame_set(LAST)
    assert order(ground) == [playback_tree.MODIFIER, "Hair", "stones"]
    tree_of(ground, "raised", raised)
    bpy.context.scene.frame_set(LAST - 1)  # a change of frame is enough to see it
    assert order(ground) == ["Hair", "stones", "raised", playback_tree.MODIFIER]
    assert (len(bpy.data.node_groups) - 2, len(bpy.data.images)) == before


def test_points_that_came_to_lie_between_cells_are_smooth(folder):
    """Cells are shown as they are by points on their centres, between them by finer ones."""
    ground = strip()
    trodden(ground, folder)
    sampled = lambda: next(
        node.interpolation
        for node in playback.modifier(ground).node_group.nodes
        if node.bl_idname == "GeometryNodeImageTexture"
    )
    assert sampled() == "Closest"
    sub = ground.modifiers.new("Fine", "SUBSURF")
    sub.subdivision_type = "SIMPLE"
    bpy.context.view_layer.update()
    assert sampled() == "Linear"
    ground.modifiers.remove(sub)
    bpy.context.view_layer.update()
    assert sampled() == "Linear"  # its neighbours may have been baked with it, which it meets at its edges


def test_points_only_the_viewport_has_are_smooth(folder):
    ground = strip()
    sub = ground.modifiers.new("Fine", "SUBSURF")
    sub.subdivision_type, sub.levels, sub.render_levels = "SIMPLE", 1, 0
    trodden(ground, folder)
    assert playback.interpolates(playback.modifier(ground).node_group)


def test_frames_that_play_change_nothing(folder):
    ground = strip()
    trodden(ground, folder)
    tree = playback.modifier(ground).node_group
    kept = list(tree[playback.LIE])
    for frame in range(1, LAST + 1):
        bpy.context.scene.frame_set(frame)
    ground.modifiers.new("Fine", "SUBSURF").show_viewport = False
    bpy.context.view_layer.update()
    other = playback.modifier(ground).node_group
    ground.modifiers["Fine"].show_viewport = True  # renders have it all the time
    bpy.context.view_layer.update()
    assert playback.modifier(ground).node_group == other
    fine = ground.modifiers["Fine"]
    for frame, level in ((1, 0), (LAST, 2)):
        fine.levels = level
        fine.keyframe_insert("levels", frame=frame)
    bpy.context.view_layer.update()
    other = playback.modifier(ground).node_group
    for frame in (1, LAST, 5):
        bpy.context.scene.frame_set(frame)
        assert playback.modifier(ground).node_group == other
    assert kept[:16] == list(other[playback.LIE])[:16]


def applied(ground, **what):
    meshes.activate(ground)
    chosen = {"location": False, "rotation": False, "scale": False} | what
    assert bpy.ops.object.transform_apply(**chosen) == {"FINISHED"}


def baked(folder):
    """A ground of uneven scale, turned."""
    ground = meshes.grid(81, 121, 0.005, -0.2, -0.3)
    ground.scale, ground.rotation_euler.z, ground.location = (4.0, 5.0, 2.0), 0.3, (0.0, -1.0, 0.0)
    trodden(ground, folder)
    return ground


def test_prints_stay_when_a_transform_is_applied(folder):
    ground = baked(folder)
    places, wanted = lowest(ground)
    for what in ({"scale": True}, {"rotation": True}, {"location": True}):
        applied(ground, **what)
        np.testing.assert_allclose(drop(ground, places), wanted, atol=1e-4, err_msg=str(what))
    bpy.context.scene.cursor.location = (1.0, 2.0, 3.0)
    bpy.ops.object.origin_set(type="ORIGIN_CURSOR")
    assert ground.location.z == 3.0
    np.testing.assert_allclose(drop(ground, places), wanted, atol=1e-4)


def test_an_applied_scale_is_undone_and_done_again(folder):
    ground = baked(folder)
    name = ground.name
    places, wanted = lowest(ground)
    bpy.ops.ed.undo_push(message="Baked")
    applied(ground, scale=True)
    bpy.ops.ed.undo_push(message="Applied")
    for again, step in enumerate((bpy.ops.ed.undo, bpy.ops.ed.redo)):
        assert step() == {"FINISHED"}
        ground = bpy.data.objects[name]
        assert (abs(ground.scale.x - 1.0) < 1e-6) == again
        np.testing.assert_allclose(drop(ground, places), wanted, atol=1e-4)


def test_prints_ride_along_and_stay_when_it_is_applied_elsewhere(folder):
    ground = baked(folder)
    places, wanted = lowest(ground)
    ground.location.x += 7.0
    bpy.context.view_layer.update()
    np.testing.assert_allclose(drop(ground, places + (7.0, 0.0)), wanted, atol=1e-4)
    applied(ground, scale=True, rotation=True)
    np.testing.assert_allclose(drop(ground, places + (7.0, 0.0)), wanted, atol=1e-4)
    # another modifier leaves them there, too
    ground.modifiers.new("Fine", "SUBSURF").subdivision_type = "SIMPLE"
    bpy.context.view_layer.update()
    assert order(ground) == ["Fine", playback_tree.MODIFIER]
    np.testing.assert_allclose(drop(ground, places + (7.0, 0.0)), wanted, atol=0.004)


def test_what_was_applied_without_us_is_mended_when_the_file_is_read(folder):
    ground = baked(folder / "bake")
    places, wanted = lowest(ground)
    tree = playback.modifier(ground).node_group
    kept = {name: list(tree[name]) if name == playback.LIE else tree[name] for name in (playback.STACK, playback.LIE)}
    world = np.array(ground.matrix_world)
    for vertex in ground.data.vertices:  # as if done where this add-on is not
        vertex.co = ground.matrix_world @ vertex.co
    ground.matrix_world = np.eye(4)
    for name, value in kept.items():
        tree[name] = value
    assert not np.allclose(world, np.eye(4))
    path = str(folder / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    np.testing.assert_allclose(drop(bpy.data.objects[ground_name(bpy.data)], places), wanted, atol=1e-4)


def ground_name(data):
    return next(each.name for each in data.objects if each.desire_path.is_ground)


def test_prints_stay_when_an_edited_mesh_is_applied(folder):
    ground = baked(folder)
    tree = playback.modifier(ground).node_group
    for vertex in ground.data.vertices:
        vertex.co.z += 0.1
    ground.data.update()
    bpy.context.view_layer.update()
    assert playback.modifier(ground).node_group == tree
    places, wanted = lowest(ground, 0.2)
    applied(ground, scale=True)
    np.testing.assert_allclose(drop(ground, places), wanted, atol=1e-4)
