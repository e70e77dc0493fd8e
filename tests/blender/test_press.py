"""Press: any object is pressed into any ground, which shows it at once; what is kept plays, and walks go on from it."""

import bpy
import numpy as np
from scenes import gaits, meshes, people

from desire_path.bake.bake import read_index
from desire_path.blender import compat, home, inputs, playback, press, pressed, show, state, watch
from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground


def ball(radius=0.125, at=(0.0, 0.0, 1.0)):
    sphere = gaits.sphere(radius, 12)
    mesh = bpy.data.meshes.new("Ball")
    mesh.from_pydata(sphere.vertices.tolist(), [], sphere.triangles.tolist())
    mesh.update()
    obj = bpy.data.objects.new("Ball", mesh)
    bpy.context.collection.objects.link(obj)
    obj.location = at
    bpy.context.view_layer.update()
    return obj


def chosen(*objects):
    for each in bpy.context.scene.objects:
        each.select_set(each in objects)
    bpy.context.view_layer.objects.active = objects[0]


def shown(obj):
    """Heights of the ground as it is shown (n, 3)."""
    bpy.context.view_layer.update()
    found = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return compat.positions(found.data) @ np.array(obj.matrix_world)[:3, :3].T + np.array(obj.matrix_world)[:3, 3]


def datablocks():
    lists = (bpy.data.node_groups, bpy.data.images, bpy.data.objects, bpy.data.meshes)
    return [sorted(each.name for each in found) for found in lists]


def plane(side=4.0):
    ground = meshes.grid(2, 2, side, -side / 2, -side / 2)
    ground.name = "Ground"
    return ground


def dragged(hand, y=0.0, to=0.5):
    for x in np.linspace(0.0, to, 6):
        hand.step(hand.at(x, y, down=True))
    hand.lift()


def test_the_ground_is_chosen_and_the_rest_presses_it(folder):
    ground, one = plane(), ball()
    chosen(one, ground)
    assert press.choose(bpy.context) == (ground, [one])
    chosen(one)
    for words, ask in (("Select a ground", press.choose),):
        try:
            ask(bpy.context)
            raise AssertionError(words)
        except DesirePathError as problem:
            assert words in str(problem), problem
    ground.desire_path.is_ground = True
    assert press.choose(bpy.context) == (ground, [one])


def test_a_plane_of_four_points_shows_what_is_pressed_into_it_and_nothing_after_drop(folder):
    ground, one = plane(), ball()
    before, points, matrix = datablocks(), compat.positions(ground.data), np.array(one.matrix_world)
    hand = press.Press(bpy.context, ground, [one], depth=0.04)
    assert ground.desire_path.is_ground and ground.desire_path.cell_size == np.float32(0.01)
    dragged(hand)
    found = shown(ground)
    assert abs(found[:, 2].min() + 0.04) < 0.004 and found[:, 2].max() > 0.002, (found[:, 2].min(), found[:, 2].max())
    middle = found[np.abs(found[:, 1]) < 0.005]
    groove = middle[(middle[:, 0] > 0.05) & (middle[:, 0] < 0.45)]
    assert len(groove) > 30 and groove[:, 2].max() < -0.03, "dashes"
    deep = found[:, 2].min()
    dragged(hand, 0.4)
    assert hand.undo() and abs(shown(ground)[:, 2].min() - deep) < 1e-6
    assert (np.abs(shown(ground)[:, 1] - 0.4) < 0.05).sum() < 4 or np.abs(
        shown(ground)[np.abs(shown(ground)[:, 1] - 0.4) < 0.05][:, 2]
    ).max() < 1e-6
    hand.put(hand.at(0.3, 0.3))
    hand.drop()
    assert np.array_equal(compat.positions(ground.data), points) and len(shown(ground)) == 4
    assert datablocks() == before and not ground.desire_path.is_ground and not ground.modifiers
    assert not ground.desire_path.folder and not ground.desire_path.bake_id
    bpy.context.view_layer.update()
    assert np.allclose(np.array(one.matrix_world), matrix)


def test_the_ground_is_fine_wherever_a_hand_goes_and_is_seldom_cut_anew(folder):
    ground, one = plane(), ball()
    hand, counts = press.Press(bpy.context, ground, [one], depth=0.04), []
    for turn in np.linspace(0.0, 1.5 * np.pi, 30):
        at = np.array((np.cos(turn), 0.5 * np.sin(turn)))
        hand.step(hand.at(*at, down=True))
        found = shown(ground)
        near = found[np.linalg.norm(found[:, :2] - at, axis=1) < 0.04]
        assert len(near) > 30 and abs(near[:, 2].min() + 0.04) < 0.004, (turn, len(near), near[:, 2].min(initial=0.0))
        counts.append(len(found))
    assert len(set(counts)) < 15 and max(counts) < 250_000, counts
    hand.drop()


def test_what_is_kept_plays_and_says_so_and_can_be_pressed_again(folder):
    ground, one = plane(), ball()
    ground.desire_path.is_ground = True
    ground.desire_path.folder = str(folder / "bake")
    hand = press.Press(bpy.context, ground, [one], depth=0.04)
    dragged(hand)
    text = hand.keep()
    assert "mm deep" in text and ground.desire_path.bake_state == "FRESH"
    first = ground.desire_path.pressed
    assert first.endswith("pressed_1") and home.played(ground) == pressed.folder(ground)
    for frame in (-5, 1, 100):
        bpy.context.scene.frame_set(frame)
        assert abs(shown(ground)[:, 2].min() + 0.04) < 0.004
    ground.desire_path.soil = "mud"
    assert ground.desire_path.bake_state == "OUTDATED" and "press it again" in ground.desire_path.missing
    ground.desire_path.soil = "dry-sand"
    ground.location.z = 0.1
    assert ground.desire_path.bake_state == "OUTDATED"
    ground.location.z = 0.0
    assert ground.desire_path.bake_state == "FRESH"

    again = press.Press(bpy.context, ground, [one], depth=0.06)
    assert abs(shown(ground)[:, 2].min() + 0.04) < 0.004, "what was kept is shown while one goes on"
    dragged(again, 0.5)
    assert again.undo() and not again.undo()
    assert abs(shown(ground)[:, 2].min() + 0.04) < 0.004
    dragged(again, 0.5)
    again.keep()
    assert ground.desire_path.pressed.endswith("pressed_2") and abs(shown(ground)[:, 2].min() + 0.06) < 0.005
    assert read_index(folder / "bake" / "pressed_1").complete, "undo would miss it"
    third = press.Press(bpy.context, ground, [one])
    third.drop()
    assert abs(shown(ground)[:, 2].min() + 0.06) < 0.005 and ground.desire_path.bake_state == "FRESH"
    pressed.tidy()
    assert not (folder / "bake" / "pressed_1").exists() and read_index(folder / "bake" / "pressed_2").complete

    show.free(ground)
    assert not ground.modifiers and not ground.desire_path.pressed and len(shown(ground)) == 4
    pressed.tidy()
    assert not (folder / "bake").exists() or not list((folder / "bake").iterdir())


def test_what_is_done_to_pressed_ground_later_is_seen(folder):
    ground, one = plane(), ball()
    ground.desire_path.folder = str(folder / "bake")
    hand = press.Press(bpy.context, ground, [one], depth=0.04)
    dragged(hand)
    hand.keep()
    place, low = home.played(ground), shown(ground)[:, 2].min()
    assert low < -0.03 and home.place(ground) == place
    chosen(ground)
    assert bpy.ops.object.desire_path_material_add() == {"FINISHED"}
    made = ground.material_slots[0].material
    found = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    assert [each.name for each in found.materials] == [made.name]
    hill = ground.modifiers.new("Hill", "DISPLACE")  # the ground is 5 cm higher
    hill.mid_level, hill.strength = 0.0, 0.05
    hill.direction = "Z"
    watch.renew(bpy.context.scene, ground)
    assert abs(shown(ground)[:, 2].min() - low - 0.05) < 1e-3, shown(ground)[:, 2].min()
    assert home.played(ground) == place


def test_a_walk_goes_on_from_what_was_pressed(folder):
    ground, one = plane(6.0), ball()
    ground.desire_path.is_ground = True
    ground.desire_path.folder, ground.desire_path.cell_size = str(folder / "bake"), 0.02
    walker = people.walk(people.biped(), frames=24)
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    walker.desire_path.ground = ground
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    assert ground.desire_path.bake_state == "FRESH"
    alone = read_index(folder / "bake")
    before = dict(alone.inputs)

    hand = press.Press(bpy.context, ground, [one], depth=0.04)
    assert any("before its walk" in each for each in hand.sentences)
    assert playback.modifier(ground) is not None and not playback.modifier(ground).show_viewport
    for x in (1.5, 1.9):
        hand.step(hand.at(x, 1.0, down=True))
    text = hand.keep()
    assert "Bake it again" in text and home.played(ground) == str(folder / "bake")
    assert playback.modifier(ground).show_viewport and ground.desire_path.bake_state == "OUTDATED"
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    assert ground.desire_path.bake_state == "FRESH"
    index = read_index(folder / "bake")
    assert index.inputs["ground"] != before["ground"] and index.inputs["walk"] == before["walk"]
    bpy.context.scene.frame_set(1)
    found = shown(ground)
    there = found[(np.abs(found[:, 1] - 1.0) < 0.02) & (np.abs(found[:, 0] - 1.7) < 0.15)]
    assert abs(there[:, 2].min() + 0.04) < 0.005, there[:, 2].min()
    trail = Ground.read(folder / "bake" / "maps_final.exr").trail
    assert trail.compression.max() > 0.03
    marks, _ = inputs.now(bpy.context.scene, ground)
    ground.desire_path.pressed = ""
    assert inputs.now(bpy.context.scene, ground)[0]["ground"] != marks["ground"]
    assert ground.desire_path.missing.startswith("The ground has changed since the bake")


def test_objects_of_a_weight_sink_as_far_as_they_are_carried(folder):
    ground, one = plane(), ball()
    light = press.Press(bpy.context, ground, [one], mass=2.0)
    assert light.weighs
    for _ in range(10):
        light.step(light.at(0.0, 0.0, down=True))
    shallow = shown(ground)[:, 2].min()
    light.drop()
    heavy = press.Press(bpy.context, ground, [one], mass=40.0)
    for _ in range(10):
        heavy.step(heavy.at(0.0, 0.0, down=True))
    assert shown(ground)[:, 2].min() < 2.0 * shallow < -0.001
    heavy.drop()


def test_objects_that_are_moved_by_others_are_followed(folder):
    ground, one = plane(), ball()
    one.location = (0.0, 0.0, 0.5)
    one.keyframe_insert("location", frame=1)
    one.location = (0.4, 0.0, 0.125 - 0.05)
    one.keyframe_insert("location", frame=11)
    scene = bpy.context.scene
    scene.frame_set(1)
    hand = press.Press(bpy.context, ground, [one])
    for frame in range(1, 12):
        scene.frame_set(frame)
        hand.follow()
    assert not hand.follow(), "it stands still"
    hand.lift()
    found = shown(ground)
    assert abs(found[:, 2].min() + 0.05) < 0.005
    assert np.abs(found[found[:, 2].argmin(), 0] - 0.4) < 0.03
    hand.drop()


def test_a_turned_scaled_mirrored_object_presses_what_is_seen(folder):
    ground, one = plane(), ball()
    one.scale, one.rotation_euler = (2.0, 0.5, -0.5), (0.3, 0.2, 0.7)
    bpy.context.view_layer.update()
    hand = press.Press(bpy.context, ground, [one], depth=0.03)
    hand.put(hand.at(0.2, 0.1, 0.4, down=True))
    bpy.context.view_layer.update()
    world = compat.positions(one.data) @ np.array(one.matrix_world)[:3, :3].T + np.array(one.matrix_world)[:3, 3]
    assert abs(world[:, 2].min() + 0.03) < 2e-3
    assert hand.follow()
    hand.lift()
    found = shown(ground)
    deepest = found[found[:, 2].argmin()]
    lowest = world[world[:, 2].argmin()]
    assert np.abs(deepest[:2] - lowest[:2]).max() < 0.07 and abs(deepest[2] - lowest[2]) < 0.005, (deepest, lowest)
    hand.drop()


def test_what_cannot_be_pressed_is_told_and_nothing_is_changed(folder):
    ground, one = plane(), ball()
    empty = bpy.data.objects.new("None", bpy.data.meshes.new("None"))
    bpy.context.collection.objects.link(empty)
    nan = ball()
    nan.data.vertices[0].co.x = np.nan
    before = datablocks()
    for bodies, words in (([empty], "no faces"), ([nan], "NaN")):
        try:
            press.Press(bpy.context, ground, bodies)
            raise AssertionError(words)
        except DesirePathError as problem:
            assert words in str(problem), problem
    ground.scale = (0.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    try:
        press.Press(bpy.context, ground, [one])
        raise AssertionError("flat")
    except DesirePathError as problem:
        assert "scaled to nothing" in str(problem)
    assert datablocks() == before and not ground.desire_path.is_ground and not ground.modifiers
    assert state.found(ground).state == "NONE"


def test_the_operator_presses_once_where_things_stand(folder):
    ground, one = plane(), ball(at=(0.2, 0.1, 0.125 - 0.03))
    chosen(one, ground)
    assert bpy.ops.object.desire_path_press() == {"FINISHED"}
    found = shown(ground)
    assert abs(found[:, 2].min() + 0.03) < 0.004 and ground.desire_path.bake_state == "FRESH"
    one.location.z = 5.0
    bpy.context.view_layer.update()
    count = len(shown(ground))
    for words in ("touches no ground",):
        try:
            bpy.ops.object.desire_path_press()
            raise AssertionError(words)
        except RuntimeError as problem:
            assert words in str(problem), problem
    assert ground.desire_path.pressed.endswith("pressed_1") and len(shown(ground)) == count
    assert ground.desire_path.bake_state == "FRESH"


def test_the_mouse_meets_the_ground(folder):
    hill = meshes.grid(41, 41, 0.1, -2.0, -2.0)
    at = compat.positions(hill.data)
    at[:, 2] = 0.3 * at[:, 0]
    hill.data.vertices.foreach_set("co", at.ravel())
    hill.data.update()
    hand = press.Press(bpy.context, hill, [ball()])
    along = np.array((0.6, 0.0, -0.8))
    x, y = hand.hit(np.array((0.0, 0.2, 2.0)), along, 64)
    assert abs(2.0 - 0.8 * x / 0.6 - 0.3 * x) < 1e-3 and abs(y - 0.2) < 1e-9
    assert hand.hit(np.array((0.0, 0.2, 2.0)), -along, 64) is None
    assert hand.hit(np.array((5.0, 0.2, 2.0)), np.array((0.0, 0.0, -1.0)), 64) is None
    hand.drop()
