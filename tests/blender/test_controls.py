"""Feet that control bones lead: found by nudges, put on a hill, left alone where nothing leads them."""

import bpy
import numpy as np
from scenes import meshes, people, rigified
from test_place import ASIDE, UP, check_placed, heads, hill, is_undone, keys, on_hill, operator, scene_of
from test_rig import add_bones, record, refused

from desire_path.blender import bones, compat, controls, op_place, posing, private, sample
from desire_path.blender import ground as ground_of
from desire_path.ground.sim import Simulation
from desire_path.loads import walker
from desire_path.placement import place

SIDES = "LR"


def person(**more):
    return rigified.walker(**more)


def puppet(apart=False):
    """A biped whose bones copy those of a hidden leg that reaches for a control, through helpers between.

    apart: one control places the foot, another turns it
    """
    obj = people.biped()
    more = [("all", None, (0, 0.3, 0), (0, 0.5, 0)), ("body", "all", (0, 0, 0.95), (0, 0.2, 0.95))]
    for side, x in ((".L", 0.1), (".R", -0.1)):
        more += [
            ("mch-hips" + side, "body", (x, 0, 0.95), (x, 0, 1.0)),
            ("mch-thigh" + side, "mch-hips" + side, (x, 0, 0.92), (x, -0.01, 0.50)),
            ("mch-shin" + side, "mch-thigh" + side, (x, -0.01, 0.50), (x, 0.02, 0.08)),
            ("go" + side, "all", (x, 0.05, 0), (x, 0.25, 0)),
            ("way" + side, "all", (x, 0.02, 0.3), (x, 0.2, 0.3)),
            ("mch-goal" + side, "way" + side if apart else "go" + side, (x, 0.02, 0.08), (x, 0.1, 0.08)),
            ("mch-foot" + side, "go" + side, (x, 0.02, 0.08), (x, -0.11, 0.02)),
        ]
    add_bones(obj, *more)
    pose = obj.pose.bones

    def follow(name, kind, target):
        made = pose[name].constraints.new(kind)
        made.target, made.subtarget = obj, target
        return made

    for name in [b.name for b in pose if "mch" in b.name or b.name[:4] in ("hips", "thig", "shin", "foot")]:
        pose[name].lock_location = pose[name].lock_rotation = (True, True, True)
        pose[name].lock_rotation_w = True
    follow("hips", "CHILD_OF", "body").inverse_matrix = obj.data.bones["body"].matrix_local.inverted()
    for side in (".L", ".R"):
        follow("mch-shin" + side, "IK", "mch-goal" + side).chain_count = 2
        follow("thigh" + side, "COPY_TRANSFORMS", "mch-thigh" + side)
        follow("shin" + side, "COPY_TRANSFORMS", "mch-shin" + side)
        follow("foot" + side, "COPY_ROTATION", "mch-foot" + side)
    people.lead(obj, "body", ("way" if apart else "go") + ".{}", pitch=0.2)
    if apart:
        for side in (".L", ".R"):
            for index in range(3):
                obj.pose.bones["go" + side].keyframe_insert("location", index=index, frame=1)
    return obj


def leads(obj, frames=tuple(range(1, 49))):
    scene = bpy.context.scene
    with private.private_scene(scene, obj) as own:
        world = np.array(sample.evaluated(own, obj, 1).matrix_world)
        found = sample.rig(obj, bones.skeleton(obj, world, 1.0))
    led = controls.find(scene, obj, found.feet, found.feet, found.hips, list(frames))
    return {foot: {(each.job, each.bone) for each in every} for foot, every in led.items()}


def stand(obj):
    """What the channels of all bones hold, and the names of all actions."""
    return (
        {b.name: (tuple(b.location), tuple(b.rotation_quaternion), tuple(b.rotation_euler)) for b in obj.pose.bones},
        {each.name for each in bpy.data.actions},
        len(bpy.data.scenes),
    )


def placed(obj):
    """Place the feet of a led walk on a hill; the recording, and what its new action keys."""
    flat = record(obj, 48)
    old = obj.animation_data.action
    said = keys(old, obj)
    scene_of(obj)
    bpy.context.scene.frame_set(7)
    names = [f.foot for f in obj.desire_path.feet]
    before = heads(obj, names, range(1, 49))
    assert operator.desire_path_place_feet() == {"FINISHED"}
    assert bpy.context.scene.frame_current == 7 and bpy.context.object == obj
    assert not any("trial" in each.name for each in bpy.data.actions)
    check_placed(obj, flat)
    made = obj.animation_data.action
    assert made.name == old.name + "_placed"
    new = {each[:2]: each[2] for each in keys(made, obj)}
    kept = {path for path, index, points in said if new.get((path, index)) == points}
    compat.use_action(obj.animation_data, old)
    assert [each for each in keys(old, obj) if each in said] == said
    for name, was in heads(obj, names, range(1, 49)).items():
        np.testing.assert_allclose(was, before[name], atol=1e-4)
    compat.use_action(obj.animation_data, made)
    return kept, {path for path, _ in new}


def test_rigify_feet_are_found():
    obj = person()
    operator.desire_path_rig_detect()
    assert [(f.foot, f.toe, f.thigh, f.shank) for f in obj.desire_path.feet] == [
        tuple(f"DEF-{bone}.{side}" for bone in ("foot", "toe", "thigh", "shin")) for side in SIDES
    ]
    before = stand(obj)
    assert leads(obj) == {
        f"DEF-foot.{side}": {("whole", f"foot_ik.{side}"), ("toe", f"toe_ik.{side}")} for side in SIDES
    }
    assert stand(obj) == before
    rigified.to_fk(obj, range(1, 49))
    assert leads(obj)["DEF-foot.L"] == {
        ("thigh", "thigh_fk.L"),
        ("shank", "shin_fk.L"),
        ("turn", "foot_fk.L"),
        ("toe", "toe_fk.L"),
    }


def test_rigify_walks_uphill():
    obj = person()
    kept, keyed = placed(obj)
    assert 'pose.bones["foot_heel_ik.L"].rotation_euler' in kept  # the roll is the animator's
    assert 'pose.bones["torso"].rotation_quaternion' in kept
    for name in ("foot_ik.L", "foot_ik.R", "root"):
        assert f'pose.bones["{name}"].location' in keyed - kept
    assert not any("_fk" in path for path in keyed)


def test_rigify_walks_uphill_on_fk_legs():
    obj = person(fk=True)
    kept, keyed = placed(obj)
    for name in ("thigh_fk", "shin_fk", "foot_fk"):
        assert f'pose.bones["{name}.R"].rotation_quaternion' in keyed - kept
    assert 'pose.bones["thigh_fk.R"].location' not in keyed


def test_rigify_switches_to_fk_on_the_way():
    obj = person(fk=True)
    for side in SIDES:
        bone = obj.pose.bones[f"thigh_parent.{side}"]
        for frame, value in ((1, 0.0), (29, 0.0), (30, 1.0)):
            bone["IK_FK"] = value
            bone.keyframe_insert('["IK_FK"]', frame=frame)
    _, keyed = placed(obj)
    assert {f'pose.bones["{name}.L"].rotation_quaternion' for name in ("thigh_fk", "foot_ik")} <= keyed


def test_rigify_feet_chosen_by_hand():
    obj = person()
    operator.desire_path_rig_detect()
    for each in obj.desire_path.feet:
        for slot in ("foot", "toe", "thigh", "shank"):
            setattr(each, slot, getattr(each, slot).replace("DEF", "ORG"))
    placed(obj)


def test_rigify_paws_go_uphill_under_a_trunk_that_leans():
    obj = rigified.body("quadruped")
    land = scene_of(obj)
    land.desire_path.frame_start, land.desire_path.frame_end = 1, 6
    bpy.context.scene.frame_end = 6
    obj.animation_data_create()
    led = leads(obj, range(1, 7))
    assert led["DEF-foot.L"] == {("paw", "foot_ik.L"), ("roll", "foot_heel_ik.L")}
    assert led["DEF-front_foot.R"] == {("paw", "front_foot_ik.R"), ("roll", "front_foot_heel_ik.R")}
    flat, wanted, _ = op_place.read(bpy.context.scene, obj, land, list(range(1, 7)), False)
    assert np.ptp(wanted.pose[:, 0, 2] - flat.pose[:, 0, 2]) > 0.2
    assert operator.desire_path_place_feet() == {"FINISHED"}
    _, gait, _ = on_hill(obj, 1, 6)
    np.testing.assert_allclose(gait.pose[..., :3], wanted.pose[..., :3], atol=0.005)
    assert abs(np.abs(np.sum(gait.pose[..., 3:] * wanted.pose[..., 3:], axis=-1)) - 1.0).max() < 1e-4
    seen = posing.look(bpy.context.scene, obj, ["DEF-spine.003"], [1, 6]).at("DEF-spine.003")
    rest = np.array(obj.data.bones["DEF-spine.003"].matrix_local)
    turn = seen[:, :3, :3] @ np.linalg.inv(rest[:3, :3])
    np.testing.assert_allclose(turn[:, :2, 2] / turn[:, 2:, 2], [(-place.ROLL * ASIDE, UP)] * 2, atol=0.03)


def test_rigify_horses_and_cats_walk_uphill():
    for kind, size, thigh, shank, feet in (
        ("horse", 1.0, ("thigh", "upper_arm"), ("lower_leg", "forearm"), (("r_hoof", ""), ("f_hoof", ""))),
        ("cat", 0.15, ("thigh", "upper_arm"), ("shin", "forearm"), (("foot", "DEF-r_toe"), ("hand", "DEF-f_toe"))),
    ):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        obj = rigified.beast(kind)
        operator.desire_path_rig_detect()
        assert [(f.foot, f.toe, f.thigh, f.shank) for f in obj.desire_path.feet] == [
            (f"DEF-{foot}.{side}", toe and f"{toe}.{side}", f"DEF-{top}.{side}", f"DEF-{low}.{side}")
            for (foot, toe), top, low in zip(feet, thigh, shank)
            for side in SIDES
        ]
        obj.desire_path.mass = 300.0 * size
        flat = record(obj, 36)
        scene_of(obj, size=size)
        land = sample_land(obj, size)
        np.testing.assert_array_equal(  # plain baking leaves level feet level
            sample.record(bpy.context.scene, obj, 1, 36, land=land).pose,
            sample.record(bpy.context.scene, obj, 1, 36).pose,
        )
        assert operator.desire_path_place_feet() == {"FINISHED"}
        gait = sample.record(bpy.context.scene, obj, 1, 36, land=land)
        places, before = walker.point_places(gait), walker.point_places(flat)[..., 2]
        over = places[..., 2] - size * hill(places[..., 0] / size, places[..., 1] / size)
        low = before - before.min(axis=1, keepdims=True) < 0.01 * size
        assert low.mean() > 0.5
        assert np.abs(over - before)[low].max() < 0.03 * size, np.abs(over - before)[low].max()


def sample_land(obj, size):
    return Simulation(ground_of.read(bpy.context.scene, obj.desire_path.ground, 0.02 * size, 1).ground)


def test_a_control_leads_through_helpers():
    obj = puppet()
    assert leads(obj) == {f"foot.{side}": {("whole", f"go.{side}"), ("toe", f"toe.{side}")} for side in SIDES}
    kept, keyed = placed(obj)
    assert 'pose.bones["go.L"].location' in keyed - kept and 'pose.bones["all"].location' in keyed


def test_one_control_places_and_one_turns():
    obj = puppet(apart=True)
    assert leads(obj)["foot.R"] == {("place", "way.R"), ("turn", "go.R"), ("toe", "toe.R")}
    _, keyed = placed(obj)
    assert 'pose.bones["way.R"].location' in keyed and 'pose.bones["go.R"].rotation_quaternion' in keyed


def test_what_holds_led_feet_is_a_sentence():
    obj = puppet()
    scene_of(obj)
    pose, old = obj.pose.bones, obj.animation_data.action
    said = keys(old, obj)

    def unchanged(*words):
        before = stand(obj)
        refused(operator.desire_path_place_feet, *words)
        assert obj.animation_data.action == old and stand(obj) == before and keys(old, obj) == said
        meshes.activate(obj)

    pose["go.L"].lock_location = pose["go.L"].lock_rotation = (True, True, True)
    unchanged("'thigh.L'", "Copy Transforms", "Bake Action")  # nothing leads it that may be moved
    pose["go.L"].lock_location = pose["go.L"].lock_rotation = (False, False, False)
    pose["go.R"].driver_add("location", 2)
    unchanged("'thigh.R'", "Bake Action")
    pose["go.R"].driver_remove("location", 2)
    limit = pose["mch-goal.R"].constraints.new("LIMIT_LOCATION")
    limit.use_max_z, limit.max_z, limit.owner_space = True, 0.25, "WORLD"
    unchanged("'foot.R'", "from its place")
    pose["mch-goal.R"].constraints.remove(limit)
    child = pose["hips"].constraints[0]
    child.influence = 0.3  # the body no longer goes where the root does
    unchanged("from its place")
    child.influence = 1.0
    assert operator.desire_path_place_feet() == {"FINISHED"}


def test_led_feet_are_undone():
    obj = puppet()
    scene_of(obj)
    assert is_undone(obj)
