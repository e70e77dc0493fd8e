"""Armatures are recorded as they move, whatever their scale, parents and constraints."""

import math

import bpy
import numpy as np
from scenes import meshes, people

from desire_path.blender import axes, bones, compat, moves, private, sample
from desire_path.errors import DesirePathError
from desire_path.rig import rigs

FRAMES = (1, 24)


def refused(call, *words):
    """The sentence a call is refused with."""
    try:
        call()
    except DesirePathError as problem:
        text = str(problem)
        for word in words:
            assert word in text, text
        return text
    raise AssertionError("not refused")


def direct(obj, names, frames, subframe=0.0):
    """World matrices by moving the user's own scene."""
    scene = bpy.context.scene
    out = np.empty((len(frames), len(names), 4, 4))
    for t, frame in enumerate(frames):
        scene.frame_set(frame, subframe=subframe)
        found = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        for b, name in enumerate(names):
            out[t, b] = np.array(found.matrix_world, np.float64) @ np.array(found.pose.bones[name].matrix, np.float64)
    return out


def privately(obj, names, frames):
    with private.private_scene(bpy.context.scene, obj) as own:
        return bones.motion(own, obj, names, frames, 24.0, 1.0)[0]


def ids():
    return {
        (kind, each.name)
        for kind in ("scenes", "objects", "collections", "meshes", "armatures", "actions", "node_groups")
        for each in getattr(bpy.data, kind)
    }


def everything():
    """A walker under a moving parent, with IK and a driver-like copied rotation, partly by NLA."""
    obj = people.walk(people.biped())
    empty = meshes.link(bpy.data.objects.new("Carrier", None))
    empty.scale = (0.5, 0.5, 0.5)
    empty.rotation_euler = (0.1, 0.2, 0.3)
    for frame, x in ((1, 0.0), (24, 3.0)):
        empty.location = (x, 1.0, 0.2)
        empty.keyframe_insert("location", frame=frame)
    obj.parent = empty
    target = meshes.link(bpy.data.objects.new("Target", None))
    for frame, z in ((1, 0.3), (24, 0.6)):
        target.location = (0.3, 0.2, z)
        target.keyframe_insert("location", frame=frame)
    reach = obj.pose.bones["shin.R"].constraints.new("IK")
    reach.target, reach.chain_count = target, 2
    turn = obj.pose.bones["hips"].constraints.new("COPY_ROTATION")
    turn.target = empty
    animation = obj.animation_data
    action = animation.action
    track = animation.nla_tracks.new()
    track.strips.new("walk", 1, action)
    animation.action = None
    meshes.activate(obj)
    return obj


def test_equal_to_the_bit():
    for make in (lambda: people.walk(people.biped()), everything):
        obj = make()
        names = [bone.name for bone in obj.data.bones]
        frames = list(range(FRAMES[0], FRAMES[1] + 1))
        wanted = axes.rigid(direct(obj, names, frames), 1.0)
        bpy.context.scene.frame_set(7)
        before = ids()
        found = privately(obj, names, frames)
        assert found.matrix.tobytes() == wanted.tobytes()
        assert bpy.context.scene.frame_current == 7 and ids() == before
        assert np.ptp(found.matrix[:, 0, :3, 3], axis=0).max() > 0.5
        np.testing.assert_allclose(found.time, np.arange(24) / 24.0)


def test_subframes():
    obj = everything()
    found = privately(obj, ["foot.L"], [3.0, 3.25, 3.5])
    wanted = axes.rigid(direct(obj, ["foot.L"], [3], 0.25), 1.0)
    assert found.matrix[1].tobytes() == wanted[0].tobytes()
    assert found.matrix[0].tobytes() != found.matrix[1].tobytes()
    obj.desire_path.subframes = 4
    gait = sample.record(bpy.context.scene, obj, 1, 5)
    assert len(gait.time) == 17


def test_mirrored_walker_wears_mirrored_soles():
    obj = people.walk(people.biped())
    plain = sample.record(bpy.context.scene, obj, *FRAMES)
    obj.scale.x = -1.0
    other = sample.record(bpy.context.scene, obj, *FRAMES)
    np.testing.assert_allclose(other.pose[..., :3] * (-1, 1, 1), plain.pose[..., :3], atol=1e-6)
    for a, b in zip(other.soles, plain.soles):
        apart = np.linalg.norm((a.vertices * (1, -1, 1))[:, None] - b.vertices, axis=2).min(axis=0)
        assert apart.max() < 1e-6
        assert np.linalg.norm(a.vertices[:, None] - b.vertices, axis=2).min(axis=0).max() > 0.005


def test_unit_scale_and_object_scale():
    # the same person in metres, in centimetres, and as a rig of 1:100 in an object scaled by 100
    scene = bpy.context.scene
    plain = sample.record(scene, people.walk(people.biped("Metres")), *FRAMES)
    scene.unit_settings.scale_length = 0.01
    small = sample.record(scene, people.walk(people.biped("Cm", 100.0), size=100.0), *FRAMES)
    scene.unit_settings.scale_length = 1.0
    scaled = people.walk(people.biped("Scaled", 0.01), size=0.01)
    scaled.scale = (100.0, 100.0, 100.0)
    for curve in curves(scaled):  # the location is keyed in the object's parent space, in metres
        if curve.data_path == "location":
            for key in curve.keyframe_points:
                key.co[1] *= 100.0
            curve.update()
    large = sample.record(scene, scaled, *FRAMES)
    for other in (small, large):
        sign = np.sign((other.pose[..., 3:] * plain.pose[..., 3:]).sum(axis=-1, keepdims=True))
        np.testing.assert_allclose(other.pose[..., :3], plain.pose[..., :3], atol=2e-5)
        np.testing.assert_allclose(other.pose[..., 3:] * sign, plain.pose[..., 3:], atol=2e-5)
        np.testing.assert_allclose(other.com, plain.com, atol=2e-5)
        for a, b in zip(other.soles, plain.soles):
            np.testing.assert_allclose(a.vertices, b.vertices, atol=2e-5)


def curves(obj):
    action = obj.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves
    return action.layers[0].strips[0].channelbag(action.slots[0]).fcurves


def test_turned_walker_turns():
    obj = people.walk(people.biped())
    plain = sample.record(bpy.context.scene, obj, *FRAMES)
    empty = meshes.link(bpy.data.objects.new("Turn", None))
    empty.rotation_euler = (0, 0, math.pi / 2)
    obj.parent = empty
    turned = sample.record(bpy.context.scene, obj, *FRAMES)
    x, y, z = np.moveaxis(plain.com, -1, 0)
    np.testing.assert_allclose(turned.com, np.stack((-y, x, z), axis=-1), atol=1e-5)


def shoe(obj, bone="foot.L", parent_type="BONE"):
    """A box round the left foot, hung on the bone or weighted to it."""
    at = obj.data.bones[bone]
    mesh = meshes.grid(8, 16, 0.02, at.head_local.x - 0.07, -0.25, name="Shoe")
    mesh.location = (0, 0, 0.003)
    bpy.context.view_layer.update()
    if parent_type == "BONE":
        world = mesh.matrix_world.copy()
        mesh.parent, mesh.parent_type, mesh.parent_bone = obj, "BONE", bone
        bpy.context.view_layer.update()
        mesh.matrix_world = world
    else:
        mesh.vertex_groups.new(name=bone).add(list(range(8 * 16)), 1.0, "REPLACE")
        mesh.modifiers.new("Armature", "ARMATURE").object = obj
        mesh.parent = obj
    bpy.context.view_layer.update()
    return mesh


def test_skin_of_shoes():
    # what hangs on a bone and what is weighted to it is the same shoe
    shapes = []
    for kind in ("BONE", "ARMATURE"):
        obj = people.biped("Rest " + kind)
        obj.location = (1.0, 2.0, 0.5)
        obj.rotation_euler = (0, 0, 0.6)
        obj.scale = (1.2, 1.2, 1.2)
        bpy.context.view_layer.update()
        mesh = shoe(obj, parent_type=kind)
        if kind == "BONE":
            wanted = np.array(obj.matrix_world.inverted() @ mesh.matrix_world)
            rest = axes.points(wanted, [v.co for v in mesh.data.vertices], 1.2)
        world = axes.matrix(obj.matrix_world, obj.name)
        feet = rigs.detect(bones.skeleton(obj, world, 1.0)).feet
        found = sample.skin(bpy.context.scene, obj, feet, world, 1.0)
        assert set(found.weights) == {"foot.L"} and (found.weights["foot.L"] == 1.0).all()
        assert len(found.triangles) == 2 * 7 * 15
        shapes.append(found.vertices)
        mesh.hide_render = True  # nobody sees it: it presses nothing
        assert sample.skin(bpy.context.scene, obj, feet, world, 1.0) is None
        mesh.hide_render, mesh.desire_path.is_ground = False, True  # nor does a ground that hangs on a rig
        assert sample.skin(bpy.context.scene, obj, feet, world, 1.0) is None
        bpy.data.objects.remove(mesh)
    np.testing.assert_allclose(shapes[0], rest, atol=1e-5)
    assert len(shapes[1]) == len(shapes[0])


def test_toe_children_count_for_the_toe():
    obj = people.biped()
    meshes.activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    tip = obj.data.edit_bones.new("tip.L")
    tip.head, tip.tail = (0.1, -0.17, 0.02), (0.1, -0.2, 0.02)
    tip.parent = obj.data.edit_bones["toe.L"]
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = shoe(obj, "tip.L", "ARMATURE")
    mesh.vertex_groups["tip.L"].add(list(range(8 * 16)), 0.25, "REPLACE")
    mesh.vertex_groups.new(name="toe.L").add(list(range(8 * 16)), 0.75, "REPLACE")
    world = axes.matrix(obj.matrix_world, obj.name)
    feet = rigs.detect(bones.skeleton(obj, world, 1.0)).feet
    found = sample.skin(bpy.context.scene, obj, feet, world, 1.0)
    assert (found.weights["toe.L"] == 1.0).all() and "tip.L" not in found.weights


def test_frames_are_those_of_all_that_moves_the_walker():
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 3, 7
    obj = people.biped()
    assert moves.frame_range(scene, obj) == (3, 7)  # nothing moves: the scene's own
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    obj.parent = carrier
    for frame in (5, 20):
        carrier.keyframe_insert("location", frame=frame)
    assert moves.frame_range(scene, obj) == (5, 20)
    for frame in (-2, 9):
        obj.keyframe_insert("location", frame=frame)
    assert moves.frame_range(scene, obj) == (-2, 20)


def test_recording_leaves_nothing_behind():
    obj = everything()
    shoe(obj, parent_type="ARMATURE")
    bpy.context.scene.frame_set(5)
    before = ids()
    gait = sample.record(bpy.context.scene, obj, *FRAMES)
    assert ids() == before and bpy.context.scene.frame_current == 5
    assert gait.limb_name == ("foot.L", "foot.R") and gait.frame_start == 1
    refused(lambda: sample.record(bpy.context.scene, people.biped("Bad"), 5, 5), "5 to 5")
    assert not [s for s in bpy.data.scenes if s.name.startswith("desire_path")]


def test_refusals():
    scene = bpy.context.scene
    obj = people.walk(people.biped())
    refused(lambda: sample.record(scene, None, 1, 9), "armature")
    refused(lambda: sample.record(scene, obj, 9, 9), "9 to 9", "end")
    refused(lambda: sample.record(scene, obj, 9, 1), "9 to 1")
    obj.desire_path.mass = -3.0
    refused(lambda: sample.record(scene, obj, 1, 9), "mass", "Walker")
    obj.desire_path.mass = 75.0
    there = sample.record(scene, obj, 1, 9)
    obj.hide_viewport = True  # of renders this says nothing
    assert sample.record(scene, obj, 1, 9).pose.tobytes() == there.pose.tobytes() and obj.hide_viewport
    obj.hide_viewport = False
    obj.scale = (0, 0, 0)
    refused(lambda: sample.record(scene, obj, 1, 9), "scale")
    obj.scale = (1, 1, 1)
    obj.pose.bones["foot.R"].scale = (0, 0, 0)
    refused(lambda: sample.record(scene, obj, 3, 9), "foot.R", "frame 3")
    obj.pose.bones["foot.R"].scale = (1, 1, 1)
    obj.location.x = float("nan")
    refused(lambda: sample.record(scene, obj, 1, 9), "NaN")


def test_feet_that_are_chosen_by_hand():
    """A bone is one foot, and legs that nobody named are those above it."""
    obj = people.walk(people.biped())
    for limb, bone in (("left", "foot.L"), ("right", "foot.L")):
        each = obj.desire_path.feet.add()
        each.limb, each.foot = limb, bone
    refused(lambda: sample.record(bpy.context.scene, obj, 1, 9), "'foot.L'", "is both the left foot and the right foot")
    obj.desire_path.feet[1].foot = "foot.R"
    feet = sample.rig(obj, bones.skeleton(obj, np.eye(4), 1.0)).feet
    assert [(foot.thigh, foot.shank) for foot in feet] == [("thigh.L", "shin.L"), ("thigh.R", "shin.R")]


def test_no_feet():
    mesh = bpy.data.armatures.new("Stick")
    obj = meshes.link(bpy.data.objects.new("Stick", mesh))
    refused(lambda: sample.record(bpy.context.scene, obj, 1, 9), "bones")
    bpy.ops.object.mode_set(mode="EDIT")
    bone = mesh.edit_bones.new("pole")
    bone.tail = (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    refused(lambda: sample.record(bpy.context.scene, obj, 1, 9), "foot")


def test_recording_again_is_the_same():
    # wherever arrays happen to lie in memory: a stopped bake goes on only from the very same walk
    obj = people.walk(people.biped(), frames=60)
    held, found = [], set()
    for turn in range(12):
        held.append(bytearray(1 + 777 * turn))
        gait = sample.record(bpy.context.scene, obj, 1, 60)
        found.add(gait.pose.tobytes() + gait.com.tobytes())
    assert len(found) == 1


def test_without_a_unit_system_a_unit_is_a_metre():
    scene = bpy.context.scene
    obj = people.walk(people.biped(), frames=8)
    plain = sample.record(scene, obj, 1, 8)
    scene.unit_settings.scale_length = 2.0
    for system, size in (("NONE", 1.0), ("METRIC", 2.0), ("IMPERIAL", 2.0)):
        scene.unit_settings.system = system
        found = sample.record(scene, obj, 1, 8)
        np.testing.assert_allclose(found.com, size * plain.com, rtol=1e-6, atol=1e-9)


def test_who_follows_a_property_of_the_scene_is_recorded_as_it_moves():
    """A driver that asks for the scene's frame or for a property of it that is keyed goes as one that knows frames."""
    scene = bpy.context.scene
    obj = people.walk(people.biped(), frames=24)
    carrier = meshes.link(bpy.data.objects.new("Carrier", None))
    obj.parent = carrier
    driver = carrier.driver_add("location", 0).driver
    driver.expression = "0.02 * (frame - 1)"
    wanted = sample.gaits(scene, [obj], 1, 24)
    scene["slide"] = 0.0
    for frame, value in ((1, 0.0), (24, 23.0)):
        scene["slide"] = value
        scene.keyframe_insert('["slide"]', frame=frame)
    for curve in compat.curves_played(scene.animation_data):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    variable = driver.variables.new()
    variable.name = "x"
    target = variable.targets[0]
    target.id_type, target.id = "SCENE", scene
    for path, expression in (("frame_current", "0.02 * (x - 1)"), ('["slide"]', "0.02 * x")):
        target.data_path, driver.expression = path, expression
        scene.frame_set(9)
        found = sample.gaits(scene, [obj], 1, 24)
        assert abs(np.asarray(found.pose) - np.asarray(wanted.pose)).max() < 1e-4, path
        assert scene.frame_current == 9 and abs(carrier.matrix_world.translation.x - 0.16) < 1e-6


def test_a_library_that_is_not_there_is_named(folder):
    people.biped()
    file = folder / "people.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(file))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(str(file), link=True) as (_, wanted):
        wanted.armatures = ["Walker"]
    meshes.link(bpy.data.objects.new("Walker", wanted.armatures[0]))
    assert record(bpy.data.objects["Walker"], 1, 12).walker_name == ("Walker",)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "shot.blend"))
    file.rename(folder / "moved.blend")
    bpy.ops.wm.open_mainfile(filepath=str(folder / "shot.blend"))
    refused(lambda: record(bpy.data.objects["Walker"], 1, 12), "library of 'Walker'", "people.blend", "relocate")


def record(obj, first, last):
    return sample.record(bpy.context.scene, obj, first, last)
