"""Walkers that are animated otherwise: by slots, strips and on four legs."""

import bpy
import numpy as np
from scenes import people
from test_place import ASIDE, UP, check_placed, on_hill, operator, scene_of
from test_rig import beast

from desire_path.blender import posing, sample
from desire_path.loads import walker
from desire_path.placement import place

# ---- other ways to be animated --------------------------------------------------------------------------


def the_slot_in_use_is_placed():
    obj = people.walk(people.biped())
    action = obj.animation_data.action
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    other = action.slots.new(id_type="OBJECT", name="Other")
    mine = obj.animation_data.action_slot
    strip = action.layers[0].strips[0]
    strip.channelbag(other, ensure=True).fcurves.new("location", index=2).keyframe_points.insert(1.0, 7.0)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    made = obj.animation_data.action
    assert made != action and obj.animation_data.action_slot.identifier == mine.identifier
    assert {each.identifier for each in made.slots} == {mine.identifier, other.identifier}
    check_placed(obj, flat)


if hasattr(bpy.types.Action, "slots"):  # from 4.4 on
    test_the_slot_in_use_is_placed = the_slot_in_use_is_placed


def test_strips_are_placed_over():
    obj = people.walk(people.biped())
    flat = sample.record(bpy.context.scene, obj, 1, 48)
    animation = obj.animation_data
    action = animation.action
    track = animation.nla_tracks.new()
    strip = track.strips.new("walk", 1, action)
    if hasattr(strip, "action_slot") and strip.action_slot is None:
        strip.action_slot = action.slots[0]
    animation.action = None
    np.testing.assert_allclose(sample.record(bpy.context.scene, obj, 1, 48).pose, flat.pose, atol=1e-6)
    scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    assert animation.action.name == "Walker_placed" and len(track.strips) == 1
    check_placed(obj, flat)
    animation.action = None
    again = sample.record(bpy.context.scene, obj, 1, 48)
    np.testing.assert_allclose(again.com, flat.com, atol=0.02)


def test_a_beast_of_four_legs():
    obj, _, _ = beast()
    land = scene_of(obj)
    land.desire_path.frame_start, land.desire_path.frame_end = 1, 6
    bpy.context.scene.frame_end = 6
    before = sample.record(bpy.context.scene, obj, 1, 6)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    over, gait, _ = on_hill(obj, 1, 6)
    check_trunk(obj, np.array((UP, place.ROLL * ASIDE)))
    assert len(gait.limb_walker) == 4
    np.testing.assert_allclose(over, walker.point_places(before)[..., 2], atol=0.02)
    np.testing.assert_allclose(gait.pose[..., :2], before.pose[..., :2], atol=0.03)


def check_trunk(obj, lean):
    """The trunk leans (along -Y, along X), and each leg is as long from hip to ankle as it was, but for what legs do
    sideways."""
    seen = posing.look(
        bpy.context.scene,
        obj,
        ["hips", "spine"]
        + [f"{word}{bone}.{side}" for word in ("", "front_") for bone in ("thigh", "foot") for side in "LR"],
        [1, 4, 6],
    )
    rest = {bone.name: np.array(bone.matrix_local) for bone in obj.data.bones}
    for name in ("hips", "spine"):
        turn = seen.at(name)[:, :3, :3] @ np.linalg.inv(rest[name][:3, :3])
        np.testing.assert_allclose(turn[:, :2, 2] / turn[:, 2:, 2], [(-lean[1], lean[0])] * 3, atol=0.03)
    for word in ("", "front_"):
        for side in "LR":
            thigh, foot = f"{word}thigh.{side}", f"{word}foot.{side}"
            now = np.linalg.norm(seen.at(thigh)[:, :3, 3] - seen.at(foot)[:, :3, 3], axis=1)
            was = np.linalg.norm(rest[thigh][:3, 3] - rest[foot][:3, 3])
            assert abs(now / was - 1.0).max() < 0.05, (thigh, now, was)


def test_a_beast_whose_trunk_may_not_turn():
    obj, _, _ = beast()
    land = scene_of(obj)
    land.desire_path.frame_start, land.desire_path.frame_end = 1, 6
    bpy.context.scene.frame_end = 6
    obj.pose.bones["hips"].lock_rotation = (True, True, True)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    seen = posing.look(bpy.context.scene, obj, ["hips"], [1, 6]).at("hips")
    np.testing.assert_allclose(seen[:, :3, :3], [np.array(obj.data.bones["hips"].matrix_local)[:3, :3]] * 2, atol=1e-5)
