"""Characters that walk as slowly as their prints are deep: by a strip's time, no key of theirs moved."""

import math

import bpy
import numpy as np
from scenes import meshes, people
from test_rig import refused

from desire_path.bake.bake import read_index
from desire_path.blender import home, op_slow, posing, sample
from desire_path.loads import walker
from desire_path.placement import effort, settle_feet

operator = bpy.ops.object
FEET = ["foot.L", "foot.R", "hips"]


def waded(soil="deep-snow"):
    """(the walker, the ground it has walked on)."""
    obj = people.walk(people.biped())
    land = meshes.grid(81, 201, 0.05, -2.0, -8.0)
    operator.desire_path_ground_add()
    land.desire_path.soil, land.desire_path.cell = soil, 0.02
    meshes.activate(obj)
    operator.desire_path_walker_add()
    meshes.activate(land)
    assert operator.desire_path_bake() == {"FINISHED"}
    meshes.activate(obj)
    return obj, land


def keys(action):
    """What an action says."""
    bags = [action]
    if hasattr(action, "layers"):
        bags = [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
    return sorted(
        (c.data_path, c.array_index, *(tuple(p.co) for p in c.keyframe_points)) for b in bags for c in b.fcurves
    )


def test_who_sinks_takes_longer_by_the_root_of_the_effort():
    obj, land = waded()
    scene = bpy.context.scene
    action, before = obj.animation_data.action, posing.look(scene, obj, FEET, range(1, 49))
    said = keys(action)
    # from the papers' numbers: how deep it goes, what that costs
    gait = sample.record(scene, obj, 1, 48, samples=1)
    loads = walker.loads(gait)
    film = settle_feet.Film(read_index(home.folder(land)))
    depth = effort.depth_of(gait, effort.print_depths(gait, loads.touching, film))
    assert depth.max() > 0.1
    eta = np.where(depth < 0.03, 1.0 + 0.54 * depth / 0.03, np.minimum(1.3 + 8.0 * depth, 4.1))

    assert operator.desire_path_slow_down() == {"FINISHED"}
    strip = obj.animation_data.nla_tracks[0].strips[0]
    curve = strip.fcurves.find("strip_time")
    end = curve.keyframe_points[-1].co[0]
    assert obj.animation_data.action is None and strip.action == action and keys(action) == said
    longer = (end - 1.0) / 47.0
    assert abs(longer - np.sqrt(eta).mean()) < 0.03 * longer and 1.2 < longer < 2.1
    assert len(curve.keyframe_points) < 40
    # every pose comes, later: where the curve says
    frames = np.arange(1, math.ceil(end) + 1)
    when = np.array([curve.evaluate(each) for each in frames])
    assert (np.diff(when) > 0.0).all() and when[0] == 1.0 and abs(when[-1] - 48.0) < 1e-3
    after = posing.look(scene, obj, FEET, [int(each) for each in frames])
    for name in FEET:
        was, now = before.at(name)[:, :3, 3], after.at(name)[:, :3, 3]
        wanted = np.stack([np.interp(when, np.arange(1, 49), was[:, k]) for k in range(3)], axis=1)
        off = np.abs(now - wanted)  # feet swing in arcs between frames
        assert off.max() < 0.04 and off.mean() < 0.005, (name, off.max(), off.mean())
        assert np.abs(now[-1] - was[-1]).max() < 1e-3
    assert land.desire_path.bake_state == "OUTDATED"
    refused(operator.desire_path_slow_down, "is slowed down already")

    # a bake follows it, and treads the same places
    meshes.activate(land)
    assert operator.desire_path_bake() == {"FINISHED"}
    assert read_index(home.folder(land)).frames == math.ceil(end)
    meshes.activate(obj)
    assert operator.desire_path_slow_down(remove=True) == {"FINISHED"}
    assert obj.animation_data.action == action and not obj.animation_data.nla_tracks and keys(action) == said
    again = posing.look(scene, obj, FEET, range(1, 49))
    assert all(np.abs(again.at(name) - before.at(name)).max() < 1e-5 for name in FEET)
    refused(lambda: operator.desire_path_slow_down(remove=True), "is not slowed down")


def test_time_that_is_stretched_is_slowed_as_well():
    obj, _ = waded()
    assert operator.desire_path_slow_down() == {"FINISHED"}
    plain = obj.animation_data.nla_tracks[0].strips[0].fcurves.find("strip_time").keyframe_points[-1].co[0]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.frame_map_new = 200
    obj, _ = waded()
    assert operator.desire_path_slow_down() == {"FINISHED"}
    slow = obj.animation_data.nla_tracks[0].strips[0].fcurves.find("strip_time").keyframe_points[-1].co[0]
    assert abs(slow - plain) < 0.05 * plain


def test_who_cannot_be_slowed_is_told_why():
    obj, land = waded("packed-earth")
    obj.desire_path.ground = None
    refused(operator.desire_path_slow_down, "walks on no ground yet")
    obj.desire_path.ground = land
    land.desire_path.soil_numbers.young_modulus = 1e9
    meshes.activate(land)
    operator.desire_path_bake()
    meshes.activate(obj)
    refused(operator.desire_path_slow_down, "hardly sinks")
    assert obj.animation_data.action is not None and not obj.animation_data.nla_tracks
    assert operator.desire_path_slow_down(surface="SAND") == {"FINISHED"}
    assert op_slow.track_of(obj.animation_data) is not None
    operator.desire_path_slow_down(remove=True)
    land.desire_path.soil = "mud"
    refused(operator.desire_path_slow_down, "How deep")
    meshes.activate(land)
    operator.desire_path_bake()
    meshes.activate(obj)
    action = obj.animation_data.action
    obj.animation_data.nla_tracks.new().strips.new("walk", 1, action)
    obj.animation_data.action = None
    refused(operator.desire_path_slow_down, "plays strips of the NLA editor")


def test_a_clip_that_repeats_is_slowed_in_every_round():
    obj = people.walk(people.biped())
    action, scene = obj.animation_data.action, bpy.context.scene
    bags = [action]
    if hasattr(action, "layers"):
        bags = [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
    for curve in (each for bag in bags for each in bag.fcurves):
        curve.modifiers.new("CYCLES").mode_after = "REPEAT_OFFSET"
    scene.frame_start, scene.frame_end = 1, 90
    land = meshes.grid(81, 301, 0.05, -2.0, -13.0)
    operator.desire_path_ground_add()
    land.desire_path.soil, land.desire_path.cell = "deep-snow", 0.02
    meshes.activate(obj)
    operator.desire_path_walker_add()
    meshes.activate(land)
    assert operator.desire_path_bake() == {"FINISHED"}
    meshes.activate(obj)
    before = posing.look(scene, obj, FEET, range(1, 91))
    assert operator.desire_path_slow_down() == {"FINISHED"}
    curve = obj.animation_data.nla_tracks[0].strips[0].fcurves.find("strip_time")
    frames = list(range(1, math.ceil(curve.keyframe_points[-1].co[0]) + 1))
    when = np.array([curve.evaluate(each) for each in frames])
    assert abs(when[-1] - 90.0) < 1e-3
    after = posing.look(scene, obj, FEET, frames)
    was, now = (each.at("hips")[:, :3, 3] for each in (before, after))
    for k in range(3):
        assert np.abs(now[:, k] - np.interp(when, np.arange(1, 91), was[:, k])).max() < 0.03
