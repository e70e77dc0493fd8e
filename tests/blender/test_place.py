"""Feet put on a hill in a new action: where they come to be, what stays, what is refused."""

import json
import pathlib

import bpy
import numpy as np
from mathutils import Matrix
from scenes import meshes, people
from test_rig import add_bones, refused

from desire_path.blender import compat, moves, op_place, posing, sample
from desire_path.blender import ground as ground_of
from desire_path.ground import maps
from desire_path.ground.sim import Simulation
from desire_path.loads import walker
from desire_path.motion import rotation

WALKS = pathlib.Path(__file__).resolve().parents[1] / "scenes" / "walks"
operator = bpy.ops.object
UP, ASIDE = 0.25, 0.12  # slopes along -Y, the way the biped walks, and +X


def hill(x, y):
    return 0.4 - UP * y + ASIDE * x


def scene_of(obj, height=hill, size=1.0):
    """The armature as a walker of a hill; returns the ground."""
    ground = meshes.grid(51, 101, 0.1 * size, -2.5 * size, -7.0 * size, lambda x, y: size * height(x / size, y / size))
    operator.desire_path_ground_add()
    meshes.activate(obj)
    operator.desire_path_walker_add()
    bpy.context.view_layer.update()
    return ground


def keys(action, obj):
    """What an action says, as text that can be compared."""
    animation = obj.animation_data
    now, slot = animation.action, getattr(animation, "action_slot", None)
    compat.use_action(animation, action)
    found = sorted(
        (curve.data_path, curve.array_index, tuple(tuple(p.co) for p in curve.keyframe_points))
        for curve in compat.curves(animation, obj)
    )
    compat.use_action(animation, now, slot)
    return found


def heads(obj, names, frames):
    bones = posing.look(bpy.context.scene, obj, names, frames)
    return {name: bones.at(name)[:, :3, 3] for name in names}


def on_hill(obj, first, last, height=hill, scale=1.0):
    """(how far each contact point is over the hill (K, T), the recording, its loads)."""
    land = obj.desire_path.ground
    surface = ground_of.read(bpy.context.scene, land, 0.02, first)
    gait = sample.record(bpy.context.scene, obj, first, last, land=Simulation(surface.ground))
    places = walker.point_places(gait)
    over = places[..., 2] - height(places[..., 0], places[..., 1])
    return over, gait, walker.loads(gait, ground=lambda xy: height(xy[:, 0], xy[:, 1]))


def check_placed(obj, flat, first=1, last=48, height=hill):
    """Feet stand on the hill as they stood on the floor, joints are where bones say."""
    over, gait, loads = on_hill(obj, first, last, height)
    before = walker.point_places(flat)[..., 2]
    stood = float(np.median(walker.contacts(flat)[1]))
    low = before - stood < 0.02
    assert low.sum() > 100
    assert np.abs(over[low] - (before[low] - stood)).max() < 0.02
    assert over.min() > min(before.min() - stood, 0.0) - 0.006
    normal = np.array((-(height(1e-3, 0) - height(0, 0)) / 1e-3, -(height(0, 1e-3) - height(0, 0)) / 1e-3, 1.0))
    normal /= np.linalg.norm(normal)
    tilts = [(rotation.matrix(g.pose[::2, :, 3:]) @ (0, 0, 1.0)) @ n for g, n in ((flat, (0, 0, 1.0)), (gait, normal))]
    stands = low[::4] & low[1::4]
    assert np.abs(tilts[0] - tilts[1])[stands].max() < 0.01
    return gait, loads


def test_a_walk_goes_uphill():
    obj = people.walk(people.biped())
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    old = obj.animation_data.action
    said = keys(old, obj)
    land = scene_of(obj)
    before = heads(obj, ["thigh.L", "shin.L", "foot.L", "neck"], range(1, 49))
    assert operator.desire_path_place_feet() == {"FINISHED"}
    new = obj.animation_data.action
    assert new != old and new.name == old.name + "_placed" and new[op_place.SOURCE] == old.name
    gait, loads = check_placed(obj, flat)
    assert abs(loads.mean[0] - walker.loads(flat).mean[0]) < 0.05
    after = heads(obj, list(before), range(1, 49))
    for one, other in (("thigh.L", "shin.L"), ("shin.L", "foot.L")):  # legs keep their length
        was, now = (np.linalg.norm(each[one] - each[other], axis=1) for each in (before, after))
        np.testing.assert_allclose(was, now, atol=1e-4)
    rise = after["neck"] - before["neck"]
    np.testing.assert_allclose(rise[:, :2], 0.0, atol=1e-4)
    along = hill(*before["neck"].T[:2]) - float(np.median(walker.contacts(flat)[1]))
    assert (rise[:, 2] <= along + 0.005).all() and (rise[:, 2] > along - 0.14).all()
    assert np.abs(np.diff(rise[:, 2], 2)).max() < 0.01  # without jolts
    # the old action shows what it showed, with what it left to itself held at that
    kept = keys(old, obj)
    assert [each for each in kept if each in said] == said and old.use_fake_user
    assert {len(each[2]) for each in kept if each not in said} == {1}
    compat.use_action(obj.animation_data, old)
    for name, was in heads(obj, list(before), range(1, 49)).items():
        np.testing.assert_allclose(was, before[name], atol=1e-5)
    assert land.desire_path.frame_end == 48


def test_pressed_again_it_starts_from_the_first_action():
    obj = people.walk(people.biped())
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    old = obj.animation_data.action
    land = scene_of(obj)
    operator.desire_path_place_feet()
    count = len(bpy.data.actions)
    land.location.z = -1.5
    land.rotation_euler.x = 0.1
    bpy.context.view_layer.update()
    meshes.activate(obj)
    operator.desire_path_place_feet()
    assert len(bpy.data.actions) == count and obj.animation_data.action[op_place.SOURCE] == old.name
    world = np.array(land.matrix_world)

    def turned(x, y):
        normal = np.linalg.inv(world).T[:3, :3] @ (-ASIDE, UP, 1.0)
        at = world @ (0, 0, 0.4, 1)
        return at[2] - (normal[0] * (x - at[0]) + normal[1] * (y - at[1])) / normal[2]

    check_placed(obj, flat, height=turned)
    # and back on level ground of that height there is nothing to place
    compat.use_action(obj.animation_data, old)
    land.hide_viewport = True
    level = meshes.grid(9, 17, 1.0, -4.0, -10.0)
    operator.desire_path_ground_add()
    obj.desire_path.ground = level
    meshes.activate(obj)
    refused(operator.desire_path_place_feet, "lie on", "already")
    assert obj.animation_data.action == old and len(bpy.data.actions) == count


def test_centimetres_and_a_scaled_object():
    bpy.context.scene.unit_settings.scale_length = 0.01
    obj = people.walk(people.biped(size=50.0), size=50.0)
    obj.scale = (2, 2, 2)
    for curve in compat.curves(obj.animation_data, obj):
        if curve.data_path == "location":  # of the object: it is scaled, its way is not
            for point in curve.keyframe_points:
                point.co[1] *= 2.0
                point.handle_left[1] *= 2.0
                point.handle_right[1] *= 2.0
    obj.rotation_euler.z = 0.0
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    scene_of(obj, size=100.0)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    check_placed(obj, flat)


def test_a_mirrored_object():
    obj = people.walk(people.biped())
    obj.scale = (-1, 1, 1)
    bpy.context.view_layer.update()
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    check_placed(obj, flat)


def follow(obj, name, world, *, place=True):
    """Key a bone so that it takes these world matrices from frame 1 on."""
    bone, scene = obj.pose.bones[name], bpy.context.scene
    bone.rotation_mode = "QUATERNION"
    for t, matrix in enumerate(world):
        scene.frame_set(t + 1)
        bone.matrix = Matrix((np.linalg.inv(np.array(obj.matrix_world)) @ matrix).tolist())
        bpy.context.view_layer.update()
        if place:
            bone.keyframe_insert("location", frame=t + 1)
        bone.keyframe_insert("rotation_quaternion", frame=t + 1)


def test_quaternions_and_a_turned_object():
    obj = people.walk(people.biped())
    names = [f"{bone}.{side}" for side in "LR" for bone in ("thigh", "shin", "foot", "toe")]
    seen = posing.look(bpy.context.scene, obj, names, range(1, 49))
    for name in names:
        follow(obj, name, seen.at(name), place=False)
    obj.rotation_euler.z = 0.4
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    paths = {key[0] for key in keys(obj.animation_data.action, obj)}
    assert 'pose.bones["foot.L"].rotation_quaternion' in paths
    check_placed(obj, flat)


def test_legs_that_follow_ik_targets():
    obj = people.walk(people.biped())
    add_bones(obj, *((f"ik.{side}", None, (x, 0.02, 0.08), (x, 0.2, 0.08)) for side, x in (("L", 0.1), ("R", -0.1))))
    seen = posing.look(bpy.context.scene, obj, ["foot.L", "foot.R"], range(1, 49))
    for side in "LR":
        target = np.tile(np.eye(4), (48, 1, 1))
        target[:, :3, 3] = seen.at("foot." + side)[:, :3, 3]
        follow(obj, "ik." + side, target)
        constraint = obj.pose.bones["shin." + side].constraints.new("IK")
        constraint.target, constraint.subtarget, constraint.chain_count = obj, "ik." + side, 2
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    check_placed(obj, flat)
    paths = {key[0] for key in keys(obj.animation_data.action, obj)}
    assert 'pose.bones["ik.L"].location' in paths


def test_feet_that_hang_on_nothing_are_moved():
    obj = people.walk(people.biped())
    seen = posing.look(bpy.context.scene, obj, ["foot.L", "foot.R"], range(1, 49))
    meshes.activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    for side in "LR":
        obj.data.edit_bones["foot." + side].use_connect = False
        obj.data.edit_bones["foot." + side].parent = None
    bpy.ops.object.mode_set(mode="OBJECT")
    for side in "LR":
        follow(obj, "foot." + side, seen.at("foot." + side))
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    check_placed(obj, flat)


def test_an_object_without_an_action():
    obj = people.biped()
    bpy.context.scene.frame_end = 10
    flat = sample.record(bpy.context.scene, obj, 1, 10)
    land = scene_of(obj)
    land.desire_path.frame_start, land.desire_path.frame_end = 1, 10
    assert operator.desire_path_place_feet() == {"FINISHED"}
    assert obj.animation_data.action.name == "Walker_placed"
    over, _, _ = on_hill(obj, 1, 10)
    np.testing.assert_allclose(over, walker.point_places(flat)[..., 2], atol=0.02)


def test_what_holds_bones_is_a_sentence():
    obj = people.walk(people.biped())
    meshes.activate(obj)
    refused(operator.desire_path_place_feet, "no ground")
    scene_of(obj)
    old, count = obj.animation_data.action, len(bpy.data.actions)
    pose = obj.pose.bones

    limit = pose["shin.R"].constraints.new("COPY_ROTATION")
    limit.target, limit.subtarget = obj, "neck"
    refused(operator.desire_path_place_feet, "'shin.R'", "Copy Rotation", "Bake Action")
    limit.mute = True
    pose["thigh.L"].driver_add("rotation_euler", 0)
    refused(operator.desire_path_place_feet, "'thigh.L'", "driver")
    pose["thigh.L"].driver_remove("rotation_euler", 0)
    pose["foot.L"].lock_rotation = (True, True, True)
    refused(operator.desire_path_place_feet, "'foot.L'", "locked")
    pose["foot.L"].lock_rotation = (False, False, False)
    pose["hips"].lock_location = (False, True, False)
    refused(operator.desire_path_place_feet, "'hips'", "location", "locked")
    pose["hips"].lock_location = (False, False, False)
    hold = pose["foot.L"].constraints.new("LIMIT_LOCATION")
    hold.use_max_z, hold.max_z, hold.owner_space = True, 0.1, "WORLD"
    refused(operator.desire_path_place_feet, "'foot.L'", "from its place")
    pose["foot.L"].constraints.remove(hold)
    empty = meshes.link(bpy.data.objects.new("Goal", None))
    reach = pose["shin.L"].constraints.new("IK")
    reach.target = empty
    meshes.activate(obj)
    refused(operator.desire_path_place_feet, "'Goal'")
    pose["shin.L"].constraints.remove(reach)
    assert obj.animation_data.action == old and len(bpy.data.actions) == count
    meshes.activate(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}


def is_undone(obj):
    """Whether a character plays its own action again once it was placed and that was undone."""
    old = obj.animation_data.action.name
    bpy.ops.ed.undo_push(message="before")
    operator.desire_path_place_feet()
    bpy.ops.ed.undo_push(message="placed")
    bpy.ops.ed.undo()
    return bpy.data.objects["Walker"].animation_data.action.name == old


def test_undone_it_is_as_before():
    obj = people.walk(people.biped())
    scene_of(obj)
    assert is_undone(obj)


def test_motion_capture_on_rough_ground():
    obj = people.bvh(WALKS / "cmu_12_01_walk.bvh", global_scale=0.056444)
    first, last = moves.frame_range(bpy.context.scene, obj)
    flat = sample.record(bpy.context.scene, obj, first, last)

    def rough(x, y):
        return 0.15 * np.sin(1.3 * x + 0.4) * np.cos(1.1 * y) + 0.2 * x

    scene_of(obj, rough)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    over, gait, loads = on_hill(obj, first, last, rough)
    before = walker.point_places(flat)[..., 2] - float(np.median(walker.contacts(flat)[1]))
    assert over.min() > min(before.min(), 0.0) - 0.02
    assert abs(loads.mean[0] - 1.0) < 0.05
    assert (loads.touching != walker.loads(flat).touching).mean() < 0.06


def test_feet_go_down_into_their_prints(folder):
    obj = people.bvh(WALKS / "cmu_12_01_walk.bvh", global_scale=0.056444)
    old = obj.animation_data.action
    land = meshes.grid(41, 161, 0.05, -1.0, -5.5, lambda x, y: -0.1 * y)
    operator.desire_path_ground_add()
    settings = land.desire_path
    settings.folder, settings.cell_size, settings.soil = str(folder / "bake"), 0.01, "mud"
    meshes.activate(obj)
    operator.desire_path_walker_add()
    bpy.context.view_layer.update()
    operator.desire_path_place_feet()
    refused(lambda: operator.desire_path_place_feet(into_prints=True), "bake")
    meshes.activate(land)
    operator.desire_path_bake()
    meshes.activate(obj)
    first, last = moves.frame_range(bpy.context.scene, obj)
    frames = list(range(first, last + 1, 3))
    names = ["LeftFoot", "RightFoot", "Hips"]
    before = heads(obj, names, frames)
    assert operator.desire_path_place_feet(into_prints=True) == {"FINISHED"}
    assert obj.animation_data.action[op_place.SOURCE] == old.name
    assert sum("_placed" in each.name for each in bpy.data.actions) == 1
    after = heads(obj, names, frames)
    down = {name: before[name][:, 2] - after[name][:, 2] for name in names}
    for name in names[:2]:
        assert down[name].max() > 0.02 and down[name].min() > -0.003
    assert 0.01 < down["Hips"].mean() < 0.08
    assert np.abs(np.diff(down["Hips"][1:])).max() < 0.006  # frame 1 is cut off: a pose alone
    # baked once more the prints are the same
    deep = json.loads(settings.summary)["deepest_m"]
    meshes.activate(land)
    operator.desire_path_bake()
    assert abs(json.loads(settings.summary)["deepest_m"] / deep - 1.0) < 0.1


# ---- MODEL 11.13, TRAIL Fig. 12 -------------------------------------------------------------------------


def prints(folder, steep, aside, *, character):
    """Bake the motion capture on a slope [tangents along its way and to its left]; (median length of a print along
    the slope, how far the heaps' centre lies ahead of the prints', how far to the left) [m]."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = people.bvh(WALKS / "cmu_12_01_walk.bvh", global_scale=0.056444)
    land = meshes.grid(41, 161, 0.05, -1.0, -5.5, lambda x, y: -steep * y + aside * x)  # it walks along -Y
    operator.desire_path_ground_add()
    settings = land.desire_path
    settings.folder, settings.cell_size = str(folder / f"bake {steep} {aside} {character}"), 0.01
    meshes.activate(obj)
    operator.desire_path_walker_add()
    bpy.context.view_layer.update()
    if character and (steep or aside):
        assert operator.desire_path_place_feet() == {"FINISHED"}
    obj.desire_path.place_feet = not character
    meshes.activate(land)
    assert operator.desire_path_bake() == {"FINISHED"}
    found = maps.read(settings.folder + "/maps_final.exr")
    pressed, heap = found.planes["compression"], found.planes["heap"]
    y, x = np.mgrid[: pressed.shape[0], : pressed.shape[1]] * 0.01
    rows = np.sort(-y[pressed > 0.25 * pressed.max()])
    cuts = np.flatnonzero(np.diff(rows) > 0.2) + 1
    assert 6 <= len(cuts) + 1 <= 8, len(cuts)
    length = np.median([np.ptp(each) for each in np.split(rows, cuts)][1:-1]) * np.hypot(1.0, steep)
    apart = [float((of * heap).sum() / heap.sum() - (of * pressed).sum() / pressed.sum()) for of in (-y, x)]
    return length, *apart


def test_prints_of_a_hill(folder):
    level, fore, left = prints(folder, 0.0, 0.0, character=True)
    for character in (True, False):
        up, up_fore, _ = prints(folder, 0.47, 0.0, character=character)
        down, down_fore, _ = prints(folder, -0.47, 0.0, character=character)
        side, _, side_left = prints(folder, 0.0, 0.47, character=character)
        assert up < 0.75 * level and down > 1.02 * level and side > 0.95 * level, (up, down, side, level)
        print(f"        prints up {up:.3f}, level {level:.3f}, down {down:.3f}, aside {side:.3f} m")
        assert up_fore < fore - 0.02 and down_fore > fore + 0.02, (up_fore, down_fore, fore)
        assert side_left < left - 0.02, (side_left, left)  # it rises to the left
