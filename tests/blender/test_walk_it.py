"""Walk It: from a character to its prints at one button, and a clip in place that goes ahead with it."""

import json

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import refused
from test_refined import deepest, plane

from desire_path.blender import axes, compat, forward


def character(action="Walk_Loop"):
    """A character as it is imported: its armature and the mesh it wears are selected."""
    rig = people.glb(people.SCENES.joinpath("characters", "human_mixamo_names_inplace.glb"))
    strip = rig.animation_data.nla_tracks[action].strips[0]
    compat.use_action(rig.animation_data, strip.action, getattr(strip, "action_slot", None))
    return rig


def select(*objects):
    bpy.context.view_layer.update()
    for each in list(bpy.context.view_layer.objects):
        each.select_set(each in objects)
    bpy.context.view_layer.objects.active = objects[-1] if objects else None


def skin(rig):
    return next(each for each in rig.children if each.type == "MESH")


def summary(ground):
    return json.loads(ground.desire_path.summary)


def at(rig, frame):
    bpy.context.scene.frame_set(frame)
    return np.array(rig.matrix_world.translation)


def test_a_character_alone_gets_a_ground_and_walks_it():
    rig = character()
    select(rig)
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    ground = rig.desire_path.ground
    assert ground.name == "Ground" and len(ground.data.vertices) == 4
    assert abs(ground.location.z) < 0.02, ground.location.z
    assert ground.desire_path.cell_size == np.float32(0.01)
    found = summary(ground)
    assert found["contacts"] >= 15 and not [each for each in found["warnings"] if "slide" in each or "beside" in each]
    assert rig.desire_path.carried
    gone = at(rig, 49) - at(rig, 1)
    assert abs(np.hypot(*gone[:2]) / 2.0 - 1.1) < 0.05 and gone[1] < 0.0 and abs(gone[2]) < 1e-6
    bpy.context.scene.frame_set(250)
    assert deepest(ground) > 0.8 * found["deepest_m"] > 0.01


def test_a_mesh_it_wears_stands_for_it_and_a_plane_is_walked_on():
    rig = character()
    ground = plane(side=2.0)
    ground.scale = (4.0, 4.0, 1.0)
    bpy.context.view_layer.update()
    select(skin(rig), ground)
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert rig.desire_path.ground == ground and ground.desire_path.is_ground and not skin(rig).desire_path.is_ground
    assert len(ground.data.vertices) == 4 and summary(ground)["contacts"] >= 5
    assert rig.desire_path.tread == "plain"  # it has feet of its own
    bpy.context.scene.frame_set(250)
    assert deepest(ground) > 0.005


def test_who_wears_nothing_has_boots_on():
    rig = character()
    for each in list(rig.children_recursive):
        bpy.data.objects.remove(each)
    select(rig)
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert rig.desire_path.tread == "lugs" and summary(rig.desire_path.ground)["contacts"] >= 15
    deep = summary(rig.desire_path.ground)["deepest_m"]
    rig.desire_path.tread = "plain"
    meshes.activate(rig.desire_path.ground)
    assert rig.desire_path.ground.desire_path.bake_state == "OUTDATED"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert summary(rig.desire_path.ground)["deepest_m"] < deep  # less of lugs bears


def test_carried_is_switched_off_and_on():
    rig = character()
    first, slot = rig.animation_data.action, getattr(rig.animation_data, "action_slot", None)
    keys = [(each.data_path, each.array_index, len(each.modifiers)) for each in compat.curves(rig.animation_data, rig)]
    assert not rig.desire_path.carried
    rig.desire_path.carried = True
    ours = rig.animation_data.action
    assert rig.desire_path.carried and ours != first and ours.name.endswith("_carried")
    assert np.abs(at(rig, 49) - at(rig, 1)).max() > 1.0
    rig.desire_path.carried = False
    assert rig.animation_data.action == first and getattr(rig.animation_data, "action_slot", None) == slot
    assert np.abs(at(rig, 49)).max() < 1e-6 and not rig.desire_path.carried
    assert [
        (each.data_path, each.array_index, len(each.modifiers)) for each in compat.curves(rig.animation_data, rig)
    ] == keys
    assert not [each for each in bpy.data.actions if each.name.endswith("_carried")]


def test_parents_scales_and_units_do_not_change_the_speed():
    rig = character()
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 0.5
    above = bpy.data.objects.new("Above", None)
    above.scale, above.rotation_euler = (2.0, 2.0, 2.0), (0.0, 0.0, 0.7)
    scene.collection.objects.link(above)
    rig.parent = above
    bpy.context.view_layer.update()
    rig.desire_path.carried = True
    gone = (at(rig, 49) - at(rig, 1)) * axes.unit_scale(scene)
    assert abs(np.hypot(*gone[:2]) / 2.0 - 1.1) < 0.05
    assert abs(np.arctan2(gone[0], -gone[1]) - 0.7) < 0.05  # it faces where its parent turns it


def test_who_walks_by_itself_is_not_carried():
    rig = people.walk(people.biped(), frames=40)
    for frame, y in ((1, 0.0), (40, -1.95)):
        rig.location.y = y
        rig.keyframe_insert("location", frame=frame)
    select(rig)
    bpy.ops.object.desire_path_walk_it()
    assert not rig.desire_path.carried and not [each for each in bpy.data.actions if each.name.endswith("_carried")]


def test_two_characters_walk_one_ground():
    one, other = character(), character()
    other.location.x = 1.5
    bpy.context.view_layer.update()
    select(one, other)
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert one.desire_path.ground == other.desire_path.ground is not None
    assert summary(one.desire_path.ground)["contacts"] >= 30, summary(one.desire_path.ground)


def test_a_clip_that_does_not_loop_goes_as_far_as_it_goes():
    rig = character()
    for curve in compat.curves(rig.animation_data, rig):
        for k in range(len(curve.keyframe_points) - 1, -1, -1):
            if curve.keyframe_points[k].co[0] > 24.0 and len(curve.keyframe_points) > 2:
                curve.keyframe_points.remove(curve.keyframe_points[k])
    rig.desire_path.carried = True
    assert rig.desire_path.carried
    assert np.abs(at(rig, 24) - at(rig, 1)).max() > 0.5
    assert np.abs(at(rig, 100) - at(rig, 33)).max() < 1e-6


def test_strips_alone_are_carried_as_far_as_they_go():
    rig = character()
    rig.animation_data.action = None
    for track in rig.animation_data.nla_tracks:
        track.mute = track.name != "Walk_Loop"
    strips = [each for track in rig.animation_data.nla_tracks for each in track.strips if not track.mute]
    strips[0].repeat = 1.5  # no whole number of cycles
    rig.desire_path.carried = True
    end = round(strips[0].frame_end)
    assert np.abs(at(rig, end) - at(rig, 1)).max() > 1.0
    assert np.abs(at(rig, 200) - at(rig, end + 1)).max() < 1e-6
    rig.desire_path.carried = False
    assert rig.animation_data.action is None and np.abs(at(rig, 33)).max() < 1e-6


def test_a_strip_that_loops_is_repeated_as_its_action_is():
    rig = character()
    rig.animation_data.action = None
    for track in rig.animation_data.nla_tracks:
        track.mute = track.name != "Walk_Loop"
    strip = next(track.strips[0] for track in rig.animation_data.nla_tracks if not track.mute)
    strip.frame_start, strip.frame_end = strip.frame_start + 10.0, strip.frame_end + 10.0
    foot = lambda frame: at(rig, frame) * 0.0 + np.array(rig.pose.bones["mixamorig:LeftFoot"].matrix.translation)
    first, later = foot(15), foot(25)
    rig.desire_path.carried = True
    assert "Walk_Loop" in rig.animation_data.action.name
    assert np.allclose(foot(15), first, atol=1e-4) and np.allclose(foot(25), later, atol=1e-4)
    period = round(strip.frame_end - strip.frame_start)
    assert np.allclose(foot(15 + 4 * period), first, atol=1e-3) and np.abs(later - first).max() > 0.05
    assert np.hypot(*(at(rig, 235) - at(rig, 115))[:2]) / 5.0 > 1.0
    rig.desire_path.carried = False
    assert rig.animation_data.action is None and not [each for each in bpy.data.actions if "_carried" in each.name]


def test_what_goes_by_itself_and_what_stands_are_told_apart():
    rig = character()
    for frame, y in ((1, 0.0), (60, -3.0)):
        rig.location.y = y
        rig.keyframe_insert("location", frame=frame)
    assert "moves by itself: it is not carried" in forward.switch(rig, True)
    select(rig)
    bpy.ops.object.desire_path_walk_it()
    told = summary(rig.desire_path.ground)["warnings"]
    assert any("though it goes at 1.2 m/s" in each for each in told), told
    assert not any("in place" in each for each in told), told


def test_curves_of_other_lengths_repeat_as_one():
    rig = character()
    moving = [each for each in compat.curves(rig.animation_data, rig) if len(each.keyframe_points) > 8]
    for _ in range(3):
        moving[7].keyframe_points.remove(moving[7].keyframe_points[-1])
    rig.desire_path.carried = True
    ours = [each for each in compat.curves(rig.animation_data, rig) if each.modifiers]
    assert len({(each.keyframe_points[0].co[0], each.keyframe_points[-1].co[0]) for each in ours}) == 1


def test_a_renamed_action_is_gone_back_to_and_work_is_kept():
    rig = character()
    first = rig.animation_data.action
    rig.desire_path.carried = True
    first.name = "Mine"
    rig.keyframe_insert("location", frame=5)
    rig.desire_path.carried = False
    assert rig.animation_data.action == first
    kept = [each for each in bpy.data.actions if each.name.endswith("_carried")]
    assert len(kept) == 1 and kept[0].use_fake_user


def test_what_is_held_in_place_is_told_and_nothing_changes():
    rig = character()
    post = bpy.data.objects.new("Post", None)
    bpy.context.scene.collection.objects.link(post)
    rig.constraints.new("COPY_LOCATION").target = post
    first, known = rig.animation_data.action, set(bpy.data.objects)
    select(rig)
    refused(bpy.ops.object.desire_path_walk_it, "something else holds it there")
    assert rig.animation_data.action == first and not rig.desire_path.is_walker and set(bpy.data.objects) == known


def test_a_rig_that_follows_another_walks_once():
    control, deform = character(), character()
    for bone in deform.pose.bones:
        bone.constraints.new("COPY_TRANSFORMS").target = control
        bone.constraints[-1].subtarget = bone.name
    deform.animation_data.action = None
    select(control, deform)
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert deform.desire_path.is_walker and not control.desire_path.is_walker
    assert deform.desire_path.carried and 15 <= summary(deform.desire_path.ground)["contacts"] <= 20
    assert np.abs(at(control, 49) - at(control, 1)).max() > 1.0


def test_a_refused_bake_leaves_all_as_it_was():
    rig = character()
    ground = plane(side=2.0)
    ground.scale.y = 0.0
    bpy.context.view_layer.update()
    first = rig.animation_data.action
    select(rig, ground)
    refused(bpy.ops.object.desire_path_walk_it, "scaled to nothing")
    assert rig.animation_data.action == first and not rig.desire_path.is_walker and not ground.desire_path.is_ground


def test_a_second_time_only_bakes():
    rig = character()
    select(rig)
    bpy.ops.object.desire_path_walk_it()
    ground, action = rig.desire_path.ground, rig.animation_data.action
    ground.desire_path.soil = "mud"
    select(rig)
    bpy.ops.object.desire_path_walk_it()
    assert rig.desire_path.ground == ground and rig.animation_data.action == action
    assert sum(each.type == "MESH" and each.desire_path.is_ground for each in bpy.data.objects) == 1


def test_what_cannot_walk_is_told():
    ground = meshes.grid(4, 4, 1.0)
    select(ground)
    refused(bpy.ops.object.desire_path_walk_it, "Select a character")
    empty = bpy.data.objects.new("Bones", bpy.data.armatures.new("Bones"))
    bpy.context.scene.collection.objects.link(empty)
    select(ground, empty)
    refused(bpy.ops.object.desire_path_walk_it, "has no bones")
    assert not ground.desire_path.is_ground and not empty.desire_path.is_walker


def hill(height, nx=60, ny=160, spacing=0.1, x0=-3.0, y0=-14.0):
    """A ground whose height [m] is a function of places."""
    made = meshes.grid(nx, ny, spacing, x0, y0)
    places = np.empty((len(made.data.vertices), 3), np.float32)
    made.data.vertices.foreach_get("co", places.ravel())
    places[:, 2] = height(places[:, 0], places[:, 1])
    made.data.vertices.foreach_set("co", places.ravel())
    made.data.update()
    return made


def curve(*places, cyclic=False):
    data = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    line = data.splines.new("POLY")
    line.points.add(len(places) - 1)
    line.use_cyclic_u = cyclic
    for point, (x, y) in zip(line.points, places):
        point.co = (x, y, 0.0, 1.0)
    made = bpy.data.objects.new("Way", data)
    bpy.context.scene.collection.objects.link(made)
    return made


def test_on_a_hill_its_feet_are_placed_and_carried_switches_back():
    rig = character()
    first = rig.animation_data.action
    select(rig, hill(lambda x, y: 0.3 * np.sin(y)))
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    found = summary(rig.desire_path.ground)
    assert found["contacts"] >= 15 and not found["warnings"], found
    assert rig.desire_path.carried
    assert rig.animation_data.action.name.endswith("_carried_placed"), rig.animation_data.action
    rig.desire_path.carried = False
    assert rig.animation_data.action == first, rig.animation_data.action
    left = [each.name for each in bpy.data.actions if "_carried" in each.name]
    assert not left, left


def test_where_feet_cannot_be_placed_only_prints_are():
    rig = character()
    rig.pose.bones["mixamorig:LeftUpLeg"].lock_rotation = (True, True, True)
    select(rig, hill(lambda x, y: 0.3 * np.sin(y)))
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert rig.desire_path.place_feet and rig.animation_data.action.name.endswith("_carried")
    assert summary(rig.desire_path.ground)["contacts"] >= 15


def test_a_level_ground_leaves_the_feet_alone():
    rig = character()
    select(rig, hill(lambda x, y: 0.0 * x))
    bpy.ops.object.desire_path_walk_it()
    assert rig.animation_data.action.name.endswith("_carried") and not rig.desire_path.place_feet


def test_it_goes_along_a_selected_curve_and_turns_with_it():
    for mode in ("QUATERNION", "XYZ"):
        rig = character()
        rig.rotation_mode = mode
        rig.location = (0.3, 0.2, 0.0)
        turned = [4.0 + 3.0 * np.array([np.cos(a), np.sin(a)]) for a in np.linspace(0.0, 2.0 * np.pi, 48, False)]
        way = curve(*turned, cyclic=True)
        select(rig, way)
        assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
        found = summary(rig.desire_path.ground)
        assert found["contacts"] >= 15 and not found["warnings"], found
        for frame in (1, 90, 200):
            place = at(rig, frame)
            assert abs(np.hypot(*(place[:2] - 4.0)) - 3.0) < 0.05, (mode, frame, place)
            outward = (place[:2] - 4.0) / 3.0
            ahead = -np.array(rig.matrix_world)[:2, 1]  # it faces -Y
            assert abs(outward @ ahead) < 0.1 and outward[0] * ahead[1] - outward[1] * ahead[0] > 0.9, (mode, frame)
        rig.desire_path.carried = False
        assert np.allclose(at(rig, 90), (0.3, 0.2, 0.0), atol=1e-6)
        assert rig.delta_rotation_quaternion[:] == (1.0, 0.0, 0.0, 0.0) and not any(rig.delta_rotation_euler)


def test_at_the_end_of_a_curve_it_stops():
    rig = character()
    select(rig, curve((1, 1), (4, 1), (4, 3)))
    assert bpy.ops.object.desire_path_walk_it() == {"FINISHED"}
    assert 6 <= summary(rig.desire_path.ground)["contacts"] <= 9
    end, later = at(rig, 150), at(rig, 248)
    assert np.allclose(later, end, atol=1e-6) and 1.5 < end[1] < 3.05 and abs(end[0] - 4.0) < 0.1, (end, later)
    foot = lambda frame: at(rig, frame) + np.array(rig.pose.bones["mixamorig:LeftFoot"].matrix.translation)
    assert np.allclose(foot(150), foot(248), atol=1e-6)
    rig.desire_path.carried = False
    told = forward.carry(bpy.context.scene, rig, np.array([(1.0, 1.0), (4.0, 1.0), (4.0, 3.0)]))
    assert "to its end, its clip repeated up to frame 96" in told, told


def test_a_curve_that_is_shorter_than_the_clip_is_left_at_its_end():
    rig = character()
    told = forward.carry(bpy.context.scene, rig, np.array([(1.0, 1.0), (1.5, 1.0)]))
    assert "past the end of which its clip goes" in told and np.allclose(at(rig, 200), at(rig, 40), atol=1e-6)
    assert at(rig, 33)[0] > 2.0


def test_carried_says_why_it_cannot_be():
    rig = character()
    rig.data.pose_position = "REST"
    rig.desire_path.carried = True
    assert not rig.desire_path.carried and "Rest Position" in forward.refused(rig)
    rig.data.pose_position = "POSE"
    rig.desire_path.carried = True
    assert rig.desire_path.carried and not forward.refused(rig)
