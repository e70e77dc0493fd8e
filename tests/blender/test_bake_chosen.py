"""What is chosen in the panel, painted or switched off is what is baked."""

import json

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import pressed, refused, scene
from test_playback import shown
from test_sample import ids

from desire_path.blender import compat, op_forces, playback
from desire_path.ground import maps


def test_painted_soils_press_differently(folder):
    ground, _ = scene(folder, frames=30)
    group = ground.vertex_groups.new(name="snowy")
    group.add([v.index for v in ground.data.vertices if v.co.y < -0.7], 1.0, "REPLACE")
    plain = pressed(ground)
    assert bpy.ops.object.desire_path_paint_add() == {"FINISHED"}
    ground.desire_path.painted[0].vertex_group = "snowy"
    ground.desire_path.painted[0].soil = "snow"
    painted = pressed(ground)
    y = compat.positions(ground.data)[:, 1]
    far = y > -0.5
    assert (painted[far] == plain[far]).all() and plain[far].max() > 0.0
    assert painted[y < -0.75].max() > 1.5 * plain[y < -0.75].max()


def test_painted_soils_on_uneven_ground(folder):
    ground, walker = scene(folder, frames=16, height=lambda x, y: 0.03 * np.sin(5 * y))
    ground.vertex_groups.new(name="snowy").add(list(range(1000)), 1.0, "REPLACE")
    assert bpy.ops.object.desire_path_paint_add() == {"FINISHED"}
    assert pressed(ground).max() > 0.0
    walker.desire_path.path = curve = bpy.data.objects.new("way", bpy.data.meshes.new("way"))
    curve.data.from_pydata([(0, 0, 0), (0, -1.5, 0)], [(0, 1)], [])
    assert pressed(ground).max() > 0.0
    meshes.activate(walker)
    assert op_forces.read(bpy.context.scene, walker).loads.force.any()
    assert bpy.ops.object.desire_path_place_feet() == {"FINISHED"}


def test_law_heap_and_model_of_the_panel_are_what_is_baked(folder):
    ground, walker = scene(folder, frames=20)
    reports = []
    for choice in ({}, {"law": "uniform"}, {"heap": "paper"}, {"load_model": "impulse"}):
        for name, value in {"law": "sole", "heap": "rest", **choice}.items():
            if name != "load_model":
                setattr(ground.desire_path, name, value)
        walker.desire_path.load_model = choice.get("load_model", "inertia")
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        report = json.loads((folder / "bake" / "report.json").read_text())
        for name, value in {"law": "sole", "heap": "rest", "load_model": "inertia", **choice}.items():
            assert report["parameters"][name] == value, (choice, name)
        heap = maps.read(str(folder / "bake" / "maps_final.exr")).planes["heap"]
        reports.append((report["deepest_m"], float(heap.max())))
    assert len(set(reports)) == len(reports), reports  # each presses or heaps another way


def test_tilted_stretched_ground_in_centimetres(folder):
    # 8 degrees of slope along the walk, in a scene whose unit is a centimetre
    bpy.context.scene.unit_settings.scale_length = 0.01
    ground = meshes.grid(60, 130, 1.0, -30, -110)
    ground.scale, ground.rotation_euler = (2.0, 2.0, 3.0), (0.0, 0.05, 0.0)
    walker = people.walk(people.biped(size=100.0), frames=24, size=100.0)
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.folder = str(folder / "bake")
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    rest, _ = shown(ground, -10)
    position, colour = shown(ground, 24)
    world = np.array(ground.matrix_world, np.float64)
    moved = (position - rest).astype(np.float64) @ world[:3, :3].T * 0.01
    assert np.abs(colour[:, 0]).max() > 0.003
    np.testing.assert_allclose(moved[:, 2], colour[:, 0], atol=2e-6)
    np.testing.assert_allclose(moved[:, :2], 0.0, atol=2e-6)


def test_two_walkers(folder):
    ground, walker = scene(folder, frames=16)
    alone = pressed(ground)
    other = people.walk(people.biped("Second"), frames=16)
    other.location.x = 0.3
    other.desire_path.mass = 40.0
    meshes.activate(other)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    both = pressed(ground)
    assert (both > 0).sum() > 1.4 * (alone > 0).sum()
    other.desire_path.load_model = "impulse"
    refused(bpy.ops.object.desire_path_bake, "load model")
    walker.desire_path.load_model = "impulse"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}


def lane_of(ground, frames):
    """How far the ground's points left of x = 1 are pressed at each of the frames (T, n) [m]."""
    rest, _ = shown(ground, ground.desire_path.frame_start - 1)
    left = rest[:, 0] < 1.0
    return np.array([rest[left, 2] - shown(ground, frame)[0][left, 2] for frame in frames])


def test_who_walks_beside_another_leaves_each_print_when_it_treads(folder):
    ground, walker = scene(folder, frames=30, size=(5.0, 2.6))
    frames = (1, 8, 15, 22, 30)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    alone = lane_of(ground, frames)
    other = people.walk(people.biped("Second"), frames=30)
    other.location.x = 2.0
    meshes.activate(other)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert json.loads((folder / "bake" / "report.json").read_text())["passes"] == 1
    assert alone.max() > 0.005 and alone[0].max() < 1e-4  # nothing before they tread
    np.testing.assert_allclose(lane_of(ground, frames), alone, atol=1e-3)


def test_who_is_off_in_renders_does_not_walk_and_who_is_hidden_does(folder):
    ground, walker = scene(folder, frames=16)
    first = pressed(ground)
    other = people.walk(people.biped("Second"), frames=16)
    other.location.x = 0.3
    meshes.activate(other)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    apart = bpy.data.collections.new("Apart")
    bpy.context.scene.collection.children.link(apart)
    bpy.context.scene.collection.objects.unlink(other)
    apart.objects.link(other)
    apart.hide_render = True
    meshes.activate(ground)
    assert pressed(ground).tobytes() == first.tobytes()
    assert any("'Second' is off in renders" in each for each in json.loads(ground.desire_path.summary)["warnings"])
    apart.hide_render = False
    bpy.context.view_layer.layer_collection.children["Apart"].exclude = True
    assert pressed(ground).tobytes() == first.tobytes()
    bpy.context.view_layer.layer_collection.children["Apart"].exclude = False
    other.hide_viewport = True
    assert (pressed(ground) > 0).sum() > 1.4 * (first > 0).sum() and other.hide_viewport
    other.hide_viewport = False
    walker.desire_path.is_walker = False
    apart.hide_render = True
    refused(bpy.ops.object.desire_path_bake, "'Second' is off in renders")


def test_who_walks_in_another_scene_is_named(folder):
    ground, walker = scene(folder, frames=16)
    other = bpy.data.scenes.new("Other")
    other.collection.objects.link(walker)
    bpy.context.scene.collection.objects.unlink(walker)
    meshes.activate(ground)
    words = "'Walker' walks on 'Ground' in the scene 'Other' only: link it to 'Scene', or bake there."
    refused(bpy.ops.object.desire_path_bake, words)
    bpy.data.objects.remove(walker)
    refused(bpy.ops.object.desire_path_bake, "Nobody walks on 'Ground'")


def test_copies_and_names_do_not_mix_bakes(folder):
    (folder / "here").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "here" / "a.blend"))
    ground, walker = scene(frames=8)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    first, _ = shown(ground, 8)
    copy = meshes.link(ground.copy())
    copy.data = ground.data.copy()
    meshes.activate(copy)
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert shown(ground, 8)[0].tobytes() == first.tobytes()
    assert (folder / "here" / "desire_path" / "a" / "Ground" / "frames" / "trail_0008.exr").exists()
    walker.desire_path.ground = copy
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert copy.desire_path.folder == "//desire_path/a/Ground_001"
    assert shown(copy, 8)[0].tobytes() == first.tobytes()
    copy.name = "Renamed"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert copy.desire_path.folder == "//desire_path/a/Ground_001"


def test_user_frame_and_selection_stay(folder):
    ground, walker = scene(folder, frames=8)
    bpy.context.scene.frame_set(5, subframe=0.25)
    known = ids()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bpy.context.scene.frame_current_final == 5.25
    assert bpy.context.object == ground
    assert set(ids() - known) == {("node_groups", "Desire Path Ground")}


def test_rig_on_the_grounds_surface(folder):
    # feet that cling to the ground must not cling to the print they are about to make
    ground, walker = scene(folder, frames=16)
    for side in "LR":
        cling = walker.pose.bones["foot." + side].constraints.new("SHRINKWRAP")
        cling.target, cling.shrinkwrap_type, cling.distance = ground, "PROJECT", 0.08
        cling.project_axis, cling.project_axis_space = "NEG_Z", "WORLD"
    first = pressed(ground)
    again = pressed(ground)
    assert again.tobytes() == first.tobytes() and first.max() > 0.003
    assert playback.modifier(ground).show_viewport
