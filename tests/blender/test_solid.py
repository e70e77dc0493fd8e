"""Meshes that move leave prints as rigid bodies: by keys, parents, constraints and Blender's own rigid bodies."""

import json
import math

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import refused
from test_playback import shown

from desire_path.blender import chosen, sample

RATE = 24


def crate(size=0.4, name="Crate"):
    """A cube that stands on z = 0, its origin in its middle."""
    bpy.ops.mesh.primitive_cube_add(size=size, location=(0.0, 0.0, 0.5 * size))
    obj = bpy.context.object
    obj.name = name
    return obj


def key(obj, frame, **values):
    for name, value in values.items():
        setattr(obj, name, value)
        obj.keyframe_insert(name, frame=frame)


def sand(folder, size=4.0, cell=0.02):
    count = int(size / 0.04)
    ground = meshes.grid(count + 1, count + 1, 0.04, -size / 2, -size / 2)
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.cell_size, ground.desire_path.refine = cell, False  # depths are read at its own points
    ground.desire_path.folder = str(folder / "bake")
    return ground


def pressed_by(obj, ground, folder, mass=60.0):
    """(report, how much lower points lie at the end (n,), where they are (n, 3))"""
    meshes.activate(obj)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    obj.desire_path.mass = mass
    meshes.activate(ground)
    frame = bpy.context.scene.frame_current
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bpy.context.scene.frame_current == frame
    report = json.loads((folder / "bake" / "report.json").read_text())
    at, _ = shown(ground, ground.desire_path.frame_end)
    rest, _ = shown(ground, ground.desire_path.frame_start - 1)
    return report, rest[:, 2] - at[:, 2], rest


def hops(obj, size=0.4):
    """Three hops along +X, 0.6 m each, with a stand of 6 frames between."""
    for k in range(4):
        at = 1 + 18 * k
        for frame in (at, at + 6):
            key(obj, frame, location=(0.6 * k - 0.9, 0.0, 0.5 * size))
        if k < 3:
            key(obj, at + 12, location=(0.6 * k - 0.6, 0.0, 0.5 * size + 0.3))


def test_a_crate_that_hops_leaves_its_square(folder):
    ground, obj = sand(folder), crate()
    hops(obj)
    report, depth, at = pressed_by(obj, ground, folder, mass=600.0)
    assert ground.desire_path.frame_end == 61
    assert report["contacts"] == 4, report
    deep = at[depth > 0.001]
    for k in range(4):
        here = deep[np.abs(deep[:, 0] - (0.6 * k - 0.9)) < 0.3]
        assert np.ptp(here[:, 0]) > 0.3 and np.ptp(here[:, 1]) > 0.3, k
        assert np.abs(here[:, :2] - (0.6 * k - 0.9, 0.0)).max() < 0.26, k
    assert 0.0005 < report["deepest_m"] < 0.1


def test_scale_parents_units_and_modifiers_count(folder):
    ground, obj = sand(folder), crate(size=0.2)
    obj.scale = (2.0, 2.0, -2.0)  # mirrored, too
    obj.location.z = 0.2
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    key(carrier, 1, location=(-0.5, 0.3, 0.3))
    key(carrier, 12, location=(-0.5, 0.3, 0.0))
    key(carrier, 24, location=(-0.5, 0.3, 0.0))
    obj.parent = carrier
    more = obj.modifiers.new("Array", "ARRAY")
    more.count = 2  # a second one beside it
    more.relative_offset_displace = (1.0, 0.0, 0.0)
    report, depth, at = pressed_by(obj, ground, folder, mass=600.0)
    deep = at[depth > 0.001]
    np.testing.assert_allclose(deep[:, :2].min(axis=0), (-0.7, 0.1), atol=0.05)
    np.testing.assert_allclose(deep[:, :2].max(axis=0), (0.1, 0.5), atol=0.05)


def test_a_wheel_leaves_a_rut(folder):
    ground = sand(folder)
    bpy.ops.mesh.primitive_cylinder_add(vertices=180, radius=0.3, depth=0.12, rotation=(0.0, math.pi / 2, 0.0))
    bpy.ops.object.transform_apply(rotation=True)
    wheel = bpy.context.object
    for frame, way in ((1, -1.2), (49, 1.2)):
        key(wheel, frame, location=(0.0, way, 0.3), rotation_euler=(-way / 0.3, 0.0, 0.0))
    for curve in people_curves(wheel):
        for each in curve.keyframe_points:
            each.interpolation = "LINEAR"
    report, depth, at = pressed_by(wheel, ground, folder, mass=100.0)
    assert report["contacts"] == 1
    middle = (np.abs(at[:, 0]) < 0.01) & (np.abs(at[:, 1]) < 1.0)
    assert middle.sum() > 20 and depth[middle].min() > 0.0001
    assert depth[np.abs(at[:, 0]) > 0.2].max() < 1e-5


def test_what_renders_show_at_some_frames_only_presses_and_is_told_whatever_frame_is_shown(folder):
    ground, obj = sand(folder), crate()
    hops(obj)
    scene = bpy.context.scene
    for frame, off in ((1, False), (30, True)):
        obj.hide_render = off
        obj.keyframe_insert("hide_render", frame=frame)
    depths = []
    for frame in (1, 40):
        scene.frame_set(frame)
        assert obj.hide_render == (frame == 40)
        depths.append(pressed_by(obj, ground, folder)[1].max())
        told = json.loads(ground.desire_path.summary)["warnings"]
        assert any("'Crate' is off in renders at some of the frames" in each for each in told), told
    assert depths[0] == depths[1] > 0.0
    for frame in (1, 30):
        obj.hide_render = True
        obj.keyframe_insert("hide_render", frame=frame)
    meshes.activate(ground)
    refused(bpy.ops.object.desire_path_bake, "'Crate' is off in renders")


def people_curves(obj):
    action = obj.animation_data.action
    if hasattr(action, "layers"):
        return action.layers[0].strips[0].channelbag(action.slots[0]).fcurves
    return action.fcurves


def test_what_blenders_rigid_bodies_let_fall_presses(folder):
    ground, obj = sand(folder), crate()
    meshes.activate(obj)
    bpy.ops.rigidbody.object_add(type="ACTIVE")
    obj.location = (0.3, -0.2, 0.7)
    meshes.activate(ground)
    bpy.ops.rigidbody.object_add(type="PASSIVE")
    ground.rigid_body.collision_shape = "MESH"
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 40
    scene.frame_set(7)
    report, depth, at = pressed_by(obj, ground, folder, mass=400.0)
    assert (ground.desire_path.frame_start, ground.desire_path.frame_end) == (1, 40)
    assert ground.desire_path.bake_state == "FRESH"  # it does not fall on what it has pressed
    deep = at[depth > 0.001]
    assert report["contacts"] >= 1 and len(deep)
    lies = sample.record(scene, obj, 1, 40).pose[0, -1, :3]  # after a bounce or two
    assert lies[2] < 0.3 and np.hypot(*(at[depth.argmax(), :2] - lies[:2])) < 0.4
    middle = np.hypot(*(at[:, :2] - lies[:2]).T) < 0.1
    assert depth[middle].min() > 0.0005


def test_mass_is_estimated_from_what_it_holds(folder):
    sand(folder)
    obj = crate(size=0.5)
    meshes.activate(obj)
    bpy.ops.object.desire_path_walker_add()
    obj.desire_path.mass = 0.0
    key(obj, 1, location=(0.0, 0.0, 0.25))
    key(obj, 10, location=(0.1, 0.0, 0.25))
    gait = sample.record(bpy.context.scene, obj, 1, 10)
    assert abs(gait.mass[0] - 125.0) < 0.5 and any("125 kg" in each for each in gait.warnings)


def test_what_changes_its_shape_is_told(folder):
    sand(folder)
    obj = crate()
    obj.shape_key_add(name="Basis")
    block = obj.shape_key_add(name="Wide")
    block.data[0].co.x -= 0.3
    block.value = 0.0
    block.keyframe_insert("value", frame=1)
    block.value = 1.0
    block.keyframe_insert("value", frame=10)
    gait = sample.record(bpy.context.scene, obj, 1, 10)
    assert any("changes its shape" in each for each in gait.warnings)


def test_who_is_no_rigid_body_is_told_what_to_do(folder):
    ground = sand(folder)
    rig = people.walk(people.biped())
    meshes.activate(rig)
    skin = crate(name="Skin")
    skin.parent = rig
    meshes.activate(skin)
    refused(bpy.ops.object.desire_path_walker_add, "Skin", "Walker", "select that")
    meshes.activate(ground)
    assert not bpy.ops.object.desire_path_walker_add.poll()
    empty = meshes.link(bpy.data.objects.new("Nothing", bpy.data.meshes.new("Nothing")))
    meshes.activate(empty)
    refused(bpy.ops.object.desire_path_walker_add, "no faces")
    assert chosen.walkers(bpy.context.scene, ground) == []


def ball(radius=0.2, name="Ball"):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=48, radius=radius)
    obj = bpy.context.object
    obj.name = name
    return obj


def test_a_ball_moved_a_hand_deep_leaves_that_whatever_it_weighs(folder):
    """Within 2 mm of 100 mm: its underside is round, and a cell of 2 cm holds the mean of it."""
    ground, obj = sand(folder, size=2.0), ball()
    for frame, z in ((1, 0.25), (10, 0.1), (15, 0.1), (24, 0.5)):
        key(obj, frame, location=(0.013, 0.007, z))
    for mass, law in ((1.0, "CARVE"), (20.0, "CARVE"), (75.0, "AUTO")):
        obj.desire_path.contact_law = law
        report, depth, at = pressed_by(obj, ground, folder, mass=mass)
        assert report["contacts"] == 1, report
        assert abs(report["deepest_m"] - 0.1) < 0.002, (mass, law, report["deepest_m"])
        assert any("carves" in each for each in report["warnings"]) == (law == "AUTO"), report["warnings"]
        assert report["parameters"]["walkers"] == ["Ball"]


def test_a_body_that_came_apart_is_told_before_anything_is_lost(folder):
    ground, obj = sand(folder, size=2.0), crate()
    key(obj, 1, location=(0.0, 0.0, 0.15))
    key(obj, 10, location=(0.0, 0.0, 0.15))
    report, _, _ = pressed_by(obj, ground, folder)
    assert 0.049 < report["deepest_m"] < 0.051
    key(obj, 20, location=(1e9, 0.0, 1e9))
    meshes.activate(ground)
    refused(bpy.ops.object.desire_path_bake, "Crate", "1e+09 m away", "frame 20")
    assert json.loads((folder / "bake" / "report.json").read_text()) == report  # what was baked is still there


def blocks(rig):
    """A block of 10 cm about every bone of an armature, bound to it."""
    mesh = bpy.data.meshes.new("Blocks")
    vertices, faces, owner = [], [], []
    for bone in rig.data.bones:
        middle = (np.array(bone.head_local) + np.array(bone.tail_local)) / 2.0
        half = np.maximum(np.abs(np.array(bone.tail_local) - np.array(bone.head_local)) / 2.0, 0.05)
        first = len(vertices)
        vertices += [middle + half * (x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
        owner += [bone.name] * 8
        sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        faces += [[first + k for k in side] for side in sides]
    mesh.from_pydata([tuple(map(float, each)) for each in vertices], [], faces)
    obj = meshes.link(bpy.data.objects.new("Blocks", mesh))
    for k, name in enumerate(owner):
        (obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)).add([k], 1.0, "REPLACE")
    obj.parent = rig
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    return obj


def test_all_limbs_of_who_falls_press(folder):
    """A person who falls on his back leaves the whole pattern, from head to foot, two hands deep where he lies so."""
    ground = sand(folder, size=6.0, cell=0.02)
    rig = people.biped()
    blocks(rig)
    rig.rotation_mode = "XYZ"
    key(rig, 1, location=(0.0, 0.0, 0.05), rotation_euler=(0.0, 0.0, 0.0))
    key(rig, 12, location=(0.0, 0.0, 0.0), rotation_euler=(-math.pi / 2, 0.0, 0.0))
    key(rig, 20, location=(0.0, 0.0, 0.0), rotation_euler=(-math.pi / 2, 0.0, 0.0))
    rig.desire_path.limbs = "ALL"
    report, depth, at = pressed_by(rig, ground, folder, mass=75.0)
    gait = sample.record(bpy.context.scene, rig, 1, 20)
    assert gait.contact_law == ("carve",) and set(gait.limb_name) == {bone.name for bone in rig.data.bones}
    deep = at[depth > 0.02]
    assert np.ptp(deep[:, 1]) > 1.3, np.ptp(deep[:, 1])  # from the heels to the head
    lowest = min(
        (rotated(pose[-1], sole.vertices)[:, 2].min() for pose, sole in zip(gait.pose, gait.soles)), default=0.0
    )
    assert abs(report["deepest_m"] + lowest) < 0.03, (report["deepest_m"], lowest)


def rotated(pose, vertices):
    """Vertices (n, 3) of a part in the world."""
    w, v = pose[3], pose[4:]
    twice = 2.0 * np.cross(v, vertices)
    return pose[:3] + vertices + w * twice + np.cross(v, twice)


def test_limbs_without_a_mesh_are_told(folder):
    sand(folder)
    rig = people.walk(people.biped())
    rig.desire_path.limbs = "ALL"
    meshes.activate(rig)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    refused(bpy.ops.object.desire_path_record, "No mesh hangs on the bones of 'Walker'", filepath=str(folder / "a.npz"))


def test_what_its_weight_carries_is_not_carved(folder):
    """By weight a ball of 1 kg that is moved a hand deep leaves a few millimetres."""
    ground, obj = sand(folder, size=2.0), ball()
    for frame, z in ((1, 0.25), (10, 0.1), (30, 0.1)):
        key(obj, frame, location=(0.013, 0.007, z))
    obj.desire_path.contact_law = "SOLE"
    report, _, _ = pressed_by(obj, ground, folder, mass=1.0)
    assert 0.0 < report["deepest_m"] < 0.02


def test_an_open_mesh_carves_and_one_over_the_ground_is_told(folder):
    ground = sand(folder, size=2.0)
    bpy.ops.mesh.primitive_plane_add(size=0.5)
    plate = bpy.context.object
    plate.name = "Plate"
    for frame, z in ((1, 0.1), (10, -0.03), (20, 0.3)):
        key(plate, frame, location=(0.0, 0.0, z))
    report, _, _ = pressed_by(plate, ground, folder, mass=0.0)
    assert abs(report["deepest_m"] - 0.03) < 0.001
    for layer in people_curves(plate):
        for point in layer.keyframe_points:
            point.co.y += 0.05 if layer.array_index == 2 else 0.0
            point.handle_left.y += 0.05 if layer.array_index == 2 else 0.0
            point.handle_right.y += 0.05 if layer.array_index == 2 else 0.0
    report, _, _ = pressed_by(plate, ground, folder, mass=0.0)
    assert report["deepest_m"] == 0.0 and any("stays over the ground" in each for each in report["warnings"])
