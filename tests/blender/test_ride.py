"""On a ship, a lift or a turning platform the prints stay where the feet were set, as on firm ground."""

import json

import bpy
import numpy as np
from mathutils import Matrix
from scenes import meshes
from test_bake import scene as strip
from test_place import hill, operator, people, scene_of
from test_playback import shown

from desire_path.blender import op_forces, posing, ride, sample

LAST = 30


def carrier(*riders, at=((0.0, 0.0, 0.0), (6.0, -2.0, 0.5)), turn=(0.0, 0.0, 0.8), frames=(1, LAST)):
    """An empty that goes from here to there, with others on it."""
    ship = meshes.link(bpy.data.objects.new("Ship", None))
    for frame, place, angle in zip(frames, at, (np.zeros(3), np.asarray(turn))):
        ship.location, ship.rotation_euler = place, angle
        ship.keyframe_insert("location", frame=frame)
        ship.keyframe_insert("rotation_euler", frame=frame)
    bpy.context.scene.frame_set(1)
    for each in riders:
        each.parent = ship
    bpy.context.view_layer.update()
    return ship


def record(walker, last=LAST):
    return sample.record(bpy.context.scene, walker, 1, last)


def rode(gait):
    return [each for each in gait.warnings if "'Ground'" in each]


def test_prints_on_a_ship_are_those_on_land(folder):
    found = []
    for rides in (False, True):
        ground, walker = strip(folder / str(rides))
        if rides:
            carrier(ground, walker)
        gait = record(walker)
        meshes.activate(ground)
        bpy.context.scene.frame_set(17)
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        report = json.loads((folder / str(rides) / "bake" / "report.json").read_text())
        found.append((gait, [shown(ground, frame)[0] for frame in (1, 15, LAST)], report))
        bpy.ops.wm.read_factory_settings(use_empty=True)
    (land, still, plain), (sea, riding, report) = found
    np.testing.assert_allclose(sea.pose[..., :3], land.pose[..., :3], atol=2e-5)
    np.testing.assert_allclose(sea.com, land.com, atol=2e-5)
    assert report["contacts"] == plain["contacts"] and np.ptp(still[-1][:, 2]) > 0.01
    for a, b in zip(riding, still):  # in the ground's own space
        assert (np.abs(a - b).max(axis=1) > 2e-3).mean() < 0.005
    assert not rode(land) and any("moves: its prints stay on it" in each for each in report["warnings"])


def test_a_ground_that_only_could_move_changes_nothing():
    ground, walker = strip()
    plain = record(walker)
    carrier(ground, turn=(0, 0, 0), at=((0, 0, 0), (0, 0, 0)))
    keyed = record(walker)
    assert not rode(keyed)
    assert keyed.pose.tobytes() == plain.pose.tobytes() and keyed.com.tobytes() == plain.com.tobytes()


def test_what_riding_leaves_out_is_told():
    for turn, at, words in (
        ((0, 0, 0), ((0, 0, 0), (0, 0, 0.1)), ()),
        ((0.1, 0, 0), ((0, 0, 0), (0, 0, 0)), ("tilts by up to 6 degrees",)),
        ((0, 0, 0), ((0, 0, 0), (9, 0, 0)), ("times gravity near frame",)),
    ):
        ground, walker = strip()
        carrier(ground, walker, turn=turn, at=at)
        told = rode(record(walker))
        assert "moves" in told[0] and len(told) == 1 + len(words), told
        assert all(word in each for word, each in zip(words, told[1:])), told
        bpy.ops.wm.read_factory_settings(use_empty=True)


def test_who_walks_on_a_belt_walks_ahead():
    ground, walker = strip(size=(1.2, 5.0))
    plain = record(walker)
    for frame in (1, LAST):  # the walker stays, the belt goes back under it
        ground.location = (0.0, (frame - 1) * 1.3 / 24, 0.0)
        ground.keyframe_insert("location", frame=frame)
    for owner in (ground, walker):
        data = owner.animation_data.action
        for curve in data.layers[0].strips[0].channelbags[0].fcurves if hasattr(data, "layers") else data.fcurves:
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"
    walker.animation_data.action = walker.animation_data.action.copy()
    for curve in list(_curves(walker)):
        if curve.data_path == "location":
            _curves(walker).remove(curve)
    walker.location = (0.0, 0.0, 0.0)
    belt = record(walker)
    np.testing.assert_allclose(belt.com[0, :, 1], plain.com[0, :, 1], atol=1e-4)


def _curves(obj):
    from desire_path.blender import compat

    return compat.curves(obj.animation_data, obj)


def test_a_path_on_a_ship_is_walked_where_it_lies_on_the_ship(folder):
    made = []
    for rides in (False, True):
        ground, walker = strip(folder / str(rides))
        way = meshes.link(bpy.data.objects.new("Way", None))
        for number, y in enumerate((0.2, -1.6)):
            stop = meshes.link(bpy.data.objects.new(f"Stop {number}", None))
            stop.location, stop.parent = (0.1, y, 0.0), way
        walker.desire_path.path = way
        if rides:
            carrier(ground, walker, way)
            bpy.context.scene.frame_set(23)
        meshes.activate(ground)
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        made.append(shown(ground, 1000)[0])  # after the last
        bpy.ops.wm.read_factory_settings(use_empty=True)
    assert np.ptp(made[0][:, 2]) > 0.01
    assert (np.abs(made[1] - made[0]).max(axis=1) > 2e-3).mean() < 0.005


def test_feet_are_placed_on_a_hill_that_moves():
    risen = []
    for rides in (False, True):
        walker = people.walk(people.biped(), frames=LAST)
        ground = scene_of(walker, hill)
        if rides:
            carrier(ground, walker)
        meshes.activate(walker)
        before = posing.look(bpy.context.scene, walker, ["hips", "foot.L"], [1, 12, LAST])
        assert operator.desire_path_place_feet() == {"FINISHED"}
        after = posing.look(bpy.context.scene, walker, ["hips", "foot.L"], [1, 12, LAST])
        risen.append([(after.at(name) - before.at(name))[:, :3, 3] for name in ("hips", "foot.L")])
        bpy.ops.wm.read_factory_settings(use_empty=True)
    assert np.abs(risen[0][0][:, 2]).max() > 0.2
    np.testing.assert_allclose(risen[1], risen[0], atol=5e-3)


def test_arrows_are_drawn_where_the_feet_are():
    ground, walker = strip()
    carrier(ground, walker)
    found = op_forces.read(bpy.context.scene, walker)
    for frame in (5, 14, 24):
        lines = op_forces.arrows(found.forces, frame)
        assert len(lines)
        bpy.context.scene.frame_set(frame)
        seen = walker.evaluated_get(bpy.context.evaluated_depsgraph_get())
        feet = [np.array(seen.matrix_world @ seen.pose.bones[name].tail) for name in ("foot.L", "foot.R")]
        assert min(np.linalg.norm(foot - lines[0]) for foot in feet) < 0.3, frame


def test_a_crate_on_a_ship_lies_where_it_lay():
    ground = meshes.grid(20, 20, 0.1, -1.0, -1.0)
    operator.desire_path_ground_add()
    crate = meshes.grid(2, 2, 0.2, 0.0, 0.0, name="Crate")
    crate.location.z = 0.1
    operator.desire_path_walker_add()
    carrier(ground, crate)
    gait = record(crate)
    assert np.ptp(gait.pose[0, :, :3], axis=0).max() < 1e-5
    moved = Matrix(np.array(crate.matrix_world))
    bpy.context.scene.frame_set(LAST)
    assert (
        crate.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation - moved.translation
    ).length > 3.0


def test_a_deck_of_two_pieces_is_trodden_on_both(folder):
    found = []
    for rides in (False, True):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        fore, walker = strip(folder / f"{rides} fore", size=(1.2, 1.2))
        aft = meshes.grid(60, 70, 0.02, -0.6, -2.2, name="Aft")
        operator.desire_path_ground_add()
        aft.desire_path.cell_size = 0.02
        aft.desire_path.folder = str(folder / f"{rides} aft")
        fore.location.y = 0.0
        if rides:
            carrier(fore, aft, walker)
            bpy.context.scene.frame_set(26)
        meshes.activate(fore)
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        found.append([shown(each, LAST)[0][:, 2] for each in (fore, aft)])
    for still, riding in zip(*found):
        assert np.ptp(still) > 0.01
        assert (np.abs(riding - still) > 2e-3).mean() < 0.005


def test_a_ship_that_follows_the_frame_of_the_scene_is_ridden_on():
    """A driver that asks for scene.frame_current, as one with the word `frame` is."""
    gaits = []
    for word in ("frame", "x"):
        ground, walker = strip()
        ship = carrier(ground, walker, at=((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), turn=(0.0, 0.0, 0.0))
        ship.animation_data_clear()
        driver = ship.driver_add("location", 0).driver
        variable = driver.variables.new()
        variable.name, variable.targets[0].id_type = "x", "SCENE"
        variable.targets[0].id, variable.targets[0].data_path = bpy.context.scene, "frame_current"
        driver.expression = f"0.1 * {word}"
        walker.parent = None  # it goes ashore, over which the ship sails
        bpy.context.scene.frame_set(9)
        gaits.append(record(walker))
        path = ride.path(bpy.context.scene, ground, range(1, LAST + 1))
        assert abs(path[-1, 0, 3] - 0.1 * (LAST - 1)) < 1e-4, (word, path[-1])
        assert bpy.context.scene.frame_current == 9
        bpy.ops.wm.read_factory_settings(use_empty=True)
    one, other = gaits
    assert rode(one) and rode(other)
    np.testing.assert_allclose(one.pose, other.pose, atol=1e-5)
