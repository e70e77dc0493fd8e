"""Bodies that lean on a hill in a new action: feet stay, hips turn, and it is taken off again."""

import math

import bpy
import numpy as np
from scenes import meshes, people
from test_place import UP, follow, keys, scene_of
from test_rig import add_bones, refused

from desire_path.blender import layer, op_place, posing

operator = bpy.ops.object
FEET = ("foot.L", "foot.R", "toe.L", "toe.R")
FRAMES = range(1, 49)


def seen(obj):
    """(heads of feet, upward axes of neck (T, 3)) over the frames."""
    bones = posing.look(bpy.context.scene, obj, [*FEET, "hips", "neck"], FRAMES)
    trunk = bones.at("neck")[:, :3, 3] - bones.at("hips")[:, :3, 3]
    feet = {name: bones.at(name)[:, :3] for name in FEET}
    return feet, trunk / np.linalg.norm(trunk, axis=1, keepdims=True)


def kept(before, after):
    """How far feet have moved [m] and turned [rad]."""
    far = max(np.abs(before[name][..., 3] - after[name][..., 3]).max() for name in FEET)
    return far, max(np.abs(before[name][..., :3] - after[name][..., :3]).max() for name in FEET)


def leaned(one, other):
    """By how much trunks lean ahead, along -Y (T,) [rad]."""
    return np.arctan2(-other[:, 1], other[:, 2]) - np.arctan2(-one[:, 1], one[:, 2])


def placed(obj):
    land = scene_of(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    return land


def test_a_body_leans_uphill_over_feet_that_stay():
    obj = people.walk(people.biped())
    placed(obj)
    old = obj.animation_data.action
    said, (feet, trunk) = keys(old, obj), seen(obj)
    assert operator.desire_path_balance() == {"FINISHED"}
    new = obj.animation_data.action
    assert new != old and new.name == old.name + "_balanced" and new[layer.BALANCED] == old.name
    feet_after, trunk_after = seen(obj)
    far, turned = kept(feet, feet_after)
    assert far < 0.001 and turned < 0.002
    angle = leaned(trunk, trunk_after)
    assert np.abs(angle[6:-6] - math.atan(0.5 * UP)).max() < math.radians(2.0)
    assert np.abs(np.diff(angle, 2)).max() < 0.01  # without jolts
    assert [each for each in keys(old, obj) if each in said] == said
    # again it begins from the first; more is more
    count = len(bpy.data.actions)
    assert operator.desire_path_balance(share=1.0) == {"FINISHED"}
    assert len(bpy.data.actions) == count and obj.animation_data.action[layer.BALANCED] == old.name
    assert np.median(leaned(trunk, seen(obj)[1])) > 1.7 * np.median(angle)
    # and it is taken off
    assert operator.desire_path_balance(remove=True) == {"FINISHED"}
    assert obj.animation_data.action == old and len(bpy.data.actions) == count - 1
    assert kept(feet, seen(obj)[0])[0] < 1e-5
    refused(lambda: operator.desire_path_balance(remove=True), "plays no action that Balance made")


def test_legs_that_follow_ik_targets_keep_their_feet():
    obj = people.walk(people.biped())
    add_bones(obj, *((f"ik.{side}", None, (x, 0.02, 0.08), (x, 0.2, 0.08)) for side, x in (("L", 0.1), ("R", -0.1))))
    before = posing.look(bpy.context.scene, obj, ["foot.L", "foot.R"], FRAMES)
    for side in "LR":
        target = np.tile(np.eye(4), (48, 1, 1))
        target[:, :3, 3] = before.at("foot." + side)[:, :3, 3]
        follow(obj, "ik." + side, target)
        constraint = obj.pose.bones["shin." + side].constraints.new("IK")
        constraint.target, constraint.subtarget, constraint.chain_count = obj, "ik." + side, 2
    placed(obj)
    feet, trunk = seen(obj)
    assert operator.desire_path_balance() == {"FINISHED"}
    feet_after, trunk_after = seen(obj)
    far, _ = kept(feet, feet_after)
    assert far < 0.002
    assert abs(np.median(leaned(trunk, trunk_after)) - 0.5 * UP) < math.radians(2.0)


def test_placed_again_it_leans_no_more():
    obj = people.walk(people.biped())
    placed(obj)
    before, count = seen(obj)[1], len(bpy.data.actions)
    assert operator.desire_path_balance() == {"FINISHED"}
    meshes.activate(obj)
    assert operator.desire_path_place_feet() == {"FINISHED"}
    again = obj.animation_data.action
    assert again.get(layer.BALANCED) is None and again[op_place.SOURCE]
    assert np.abs(leaned(before, seen(obj)[1])).max() < 1e-4
    assert len(bpy.data.actions) == count


def test_who_does_not_lean_is_told():
    obj = people.walk(people.biped())
    land = scene_of(obj, lambda x, y: 0.0 * x)
    action, count = obj.animation_data.action, len(bpy.data.actions)
    refused(operator.desire_path_balance, "would hardly lean", "Place Feet")
    obj.desire_path.ground = None
    refused(operator.desire_path_balance, "walks on no ground yet")
    assert obj.animation_data.action == action and len(bpy.data.actions) == count and land
