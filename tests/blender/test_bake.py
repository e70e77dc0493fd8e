"""The whole way in Blender: choose, bake, play, free; and what happens when something is wrong."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import bpy
import numpy as np
from scenes import meshes, people
from test_playback import fresh, shown
from test_sample import ids

from desire_path.bake import bake, output
from desire_path.bake.options import BakeOptions
from desire_path.blender import compat, op_bake, op_forces, playback
from desire_path.ground import maps, sim
from desire_path.ground.soil import SOILS
from desire_path.motion.gait import Gait


def scene(folder=None, cell=0.02, frames=30, height=None, spacing=None, size=(1.2, 2.6)):
    """A biped walking along a strip of ground; ground added, walker added."""
    spacing = spacing or cell
    nx, ny = int(size[0] / spacing), int(size[1] / spacing)
    ground = meshes.grid(nx, ny, spacing, -size[0] / 2, 0.4 - size[1], height=height)
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    ground.desire_path.cell_size = cell
    if folder is not None:
        ground.desire_path.folder = str(folder / "bake")
    walker = people.walk(people.biped(), frames=frames)
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    return ground, walker


def refused(operator, *words, **arguments):
    """The sentence an operator refuses with."""
    try:
        done = operator(**arguments)
    except RuntimeError as problem:
        text = str(problem)
        for word in words:
            assert word in text, text
        assert "Traceback" not in text, text
        return text
    raise AssertionError(f"not refused: {done}")


def state(obj):
    """Everything of a mesh object that a bake might leave changed, as bytes and names."""
    mesh = obj.data
    attributes = []
    for each in mesh.attributes:
        attributes.append((each.name, each.domain, each.data_type))
    weights = [[(m.group, m.weight) for m in v.groups] for v in mesh.vertices]
    return (
        compat.positions(mesh).tobytes(),
        compat.triangles(mesh).tobytes(),
        sorted(attributes),
        [g.name for g in obj.vertex_groups],
        weights,
        [m.name for m in obj.modifiers],
        np.array(obj.matrix_world).tobytes(),
    )


def test_bake_plays_what_the_core_pressed(folder):
    ground, walker = scene(folder)
    settings = ground.desire_path
    assert (settings.frame_start, settings.frame_end) == (1, 30)
    rest = compat.positions(ground.data)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert report["contacts"] >= 2 and 0.003 < report["deepest_m"] < 0.29, report
    index = bake.read_index(str(folder / "bake"))
    assert index.complete and index.frames == 30
    # the mesh has the cells' own spacing, so that its points are cell centres
    place = (rest[:, :2].astype(np.float64) - (index.x0, index.y0)) / index.cell - 0.5
    i, j = np.round(place).astype(int).T
    assert np.abs(place - np.round(place)).max() < 0.02
    inside = (i >= 0) & (i < index.nx) & (j >= 0) & (j < index.ny)
    for frame in (30, 1, 17, 500, -3, 25):
        n = min(max(frame, 0), 30)
        planes = maps.read(index.path(n)).planes
        wanted = np.zeros((len(rest), 4), np.float32)
        for k, name in enumerate("RGBA"):
            wanted[inside, k] = planes[name][j[inside], i[inside]]
        position, colour = shown(ground, frame)
        assert colour.tobytes() == wanted.tobytes(), frame
        assert (position[:, 2] == rest[:, 2] + wanted[:, 0]).all()
    final = maps.read(str(folder / "bake" / "maps_final.exr")).planes
    last = maps.read(index.path(30)).planes
    assert (last["B"] == final["compression"]).all() and final["compression"].max() > 0.003
    assert (last["R"] == final["heap"] - final["compression"]).all()
    # final values on the mesh itself
    for name in ("compression", "heap", "pressure_time", "plant_strength"):
        value = compat.float_attribute(ground.data, name)
        wanted = np.zeros(len(rest), np.float32)
        wanted[inside] = final[name][j[inside], i[inside]]
        assert (value == wanted).all(), name
    assert "contacts" in settings.summary and not settings.missing


def test_a_mesh_without_points_in_the_prints_is_told(folder):
    ground, _ = scene(folder, cell=0.01, frames=16, spacing=0.6)
    ground.desire_path.refine = False
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert "subdivide it there, to about 0.01 m" in ground.desire_path.summary
    finer = ground.modifiers.new("Finer", "SUBSURF")
    finer.subdivision_type, finer.levels, finer.render_levels = "SIMPLE", 5, 5
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert "subdivide" not in ground.desire_path.summary


def test_free_gives_the_mesh_back(folder):
    for groups in (False, True):
        ground, walker = scene(folder, frames=12)
        own = ground.vertex_groups.new(name="own")
        own.add([1, 2, 3], 0.5, "REPLACE")
        ground.modifiers.new("Keep", "SMOOTH").show_viewport = False
        before, known = state(ground), ids()
        ground.desire_path.vertex_group = groups
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        assert state(ground) != before
        if groups:
            names = [g.name for g in ground.vertex_groups]
            assert names == ["own", "desire_path_plant_strength", "desire_path_compression"]
            pressed = compat.float_attribute(ground.data, "compression")
            weights = np.zeros(len(pressed))
            for vertex in ground.data.vertices:
                for member in vertex.groups:
                    assert member.group != 1  # no plants, no strength
                    weights[vertex.index] = member.weight if member.group == 2 else 0.0
            assert pressed.max() > 0.003
            np.testing.assert_allclose(weights, pressed / SOILS["dry-sand"].layer_depth, atol=0.5 / 1024 + 1e-6)
        foreign = folder / "bake" / "frames" / "mine.txt"
        foreign.write_text("keep")
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        assert bpy.ops.object.desire_path_free() == {"FINISHED"}
        assert state(ground) == before and ids() == known
        left = [p for p in (folder / "bake").rglob("*") if p.is_file()]
        assert left == [foreign], left
        foreign.unlink()
        bpy.data.objects.remove(ground)
        bpy.data.objects.remove(walker)


def test_attributes_of_others_stay(folder):
    ground, _ = scene(folder, frames=8)
    mine = ground.data.attributes.new("heap", "FLOAT", "POINT")
    mine.data[0].value = 3.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.data.attributes["heap"].data[0].value == 3.0
    assert "attribute 'heap'" in ground.desire_path.summary
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert ground.data.attributes["heap"].data[0].value == 3.0


def test_groups_of_others_stay(folder):
    ground, _ = scene(folder, frames=8)
    mine = ground.vertex_groups.new(name="desire_path_compression")
    mine.add([0], 0.25, "REPLACE")
    ground.desire_path.vertex_group = True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert [each.name for each in ground.vertex_groups] == ["desire_path_compression"]


def test_undo_save_load(folder):
    ground, _ = scene(folder, frames=8)
    before = state(ground)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="after")
    position, _ = shown(bpy.data.objects["Ground"], 8)
    bpy.ops.ed.undo()
    assert state(bpy.data.objects["Ground"]) == before
    bpy.ops.ed.redo()
    again, _ = shown(bpy.data.objects["Ground"], 8)
    assert again.tobytes() == position.tobytes()
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    ground = bpy.data.objects["Ground"]
    again, _ = shown(ground, 8)
    assert again.tobytes() == position.tobytes()
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert state(ground) == before


def test_undo_of_another_bake(folder):
    # the files are those of the second bake, whatever undo brings back
    ground, _ = scene(folder, frames=8)
    ground.desire_path.refine = False  # a copy of the mesh would be a datablock that the step does not hold
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="first")
    bpy.data.objects["Ground"].desire_path.cell_size = 0.013
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="second")
    second, _ = shown(bpy.data.objects["Ground"], 8)
    bpy.ops.ed.undo()
    again, _ = shown(bpy.data.objects["Ground"], 8)
    assert again.tobytes() == second.tobytes()
    bpy.ops.ed.redo()
    again, _ = shown(bpy.data.objects["Ground"], 8)
    assert again.tobytes() == second.tobytes()
    meshes.activate(bpy.data.objects["Ground"])
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="freed")
    bpy.ops.ed.undo()
    again, _ = shown(bpy.data.objects["Ground"], 8)
    assert again.tobytes() == second.tobytes()


PLAYS = """
import bpy, numpy as np, sys
assert not hasattr(bpy.types.Object, "desire_path")
bpy.ops.wm.open_mainfile(filepath=sys.argv[-2])
obj = bpy.data.objects["Ground"]
bpy.context.scene.frame_set(20)
mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
co = np.empty(3 * len(mesh.vertices), np.float32)
mesh.vertices.foreach_get("co", co)
np.save(sys.argv[-1], co.reshape(-1, 3))
"""


def test_plays_in_a_fresh_process_without_the_addon(folder):
    (folder / "here").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "here" / "a.blend"))
    ground, _ = scene(frames=24)
    assert ground.desire_path.folder == "//desire_path/a/Ground"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert (folder / "here" / "desire_path" / "a" / "Ground" / "frames" / "trail_0024.exr").exists()
    wanted, _ = shown(ground, 20)
    rest = compat.positions(ground.data)
    assert np.abs(wanted - rest).max() > 0.003
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    (folder / "here").rename(folder / "there")
    fresh(PLAYS, folder / "there" / "a.blend", folder / "out.npy")
    assert np.load(folder / "out.npy").tobytes() == wanted.tobytes()


def test_saved_elsewhere_and_linked(folder):
    for name in ("here", "else", "lib"):
        (folder / name).mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "here" / "a.blend"))
    ground, _ = scene(frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 12)
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "else" / "b.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "else" / "b.blend"))
    ground = bpy.data.objects["Ground"]
    assert shown(ground, 12)[0].tobytes() == wanted.tobytes()
    assert not ground.desire_path.missing  # it plays, from where it was baked

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "lib" / "c.blend"))
    with bpy.data.libraries.load(str(folder / "here" / "a.blend"), link=True) as (_, wants):
        wants.objects = ["Ground"]
    meshes.link(wants.objects[0])
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(folder / "lib" / "c.blend"))
    ground = bpy.data.objects["Ground"]
    assert ground.library is not None and not ground.desire_path.missing
    assert shown(ground, 12)[0].tobytes() == wanted.tobytes()
    meshes.activate(ground)
    refused(bpy.ops.object.desire_path_bake, "linked from another file")
    refused(bpy.ops.object.desire_path_free, "linked from another file")
    assert shown(ground, 12)[0].tobytes() == wanted.tobytes()


def test_frames_that_went_back_to_the_making_play(folder):
    # stopped, started again and killed before a frame was written: they lie in bake.new once more
    (folder / "here").mkdir()
    file = str(folder / "here" / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    ground, _ = scene(frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    wanted, _ = shown(ground, 12)
    bpy.ops.wm.save_mainfile()
    place = folder / "here" / "desire_path" / "a" / "Ground"
    (place / "bake.new").mkdir()
    (place / "frames").rename(place / "bake.new" / "frames")
    bpy.ops.wm.open_mainfile(filepath=file)
    assert shown(bpy.data.objects["Ground"], 12)[0].tobytes() == wanted.tobytes()


def test_frames_without_end_are_refused_at_once(folder):
    ground, _ = scene(folder, frames=6)
    ground.desire_path.frame_end = 100_000_000
    begun = time.monotonic()
    refused(bpy.ops.object.desire_path_bake, "100,000,000 frames", "250,000 are the limit")
    assert time.monotonic() - begun < 5.0 and not (folder / "bake").exists()


def test_a_folder_that_is_baked_into_is_refused(folder):
    """As by another Blender with the same file; nothing is recorded first."""
    ground, _ = scene(frames=12)
    ground.desire_path.folder = str(folder / "bake")
    other = output.Output(folder / "bake")
    other.open()
    refused(bpy.ops.object.desire_path_bake, "Another bake into", "is running")
    assert not ground.modifiers
    other.release()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}


def test_unsaved_file_says_where_its_bake_goes():
    ground, _ = scene(frames=6)
    place = ground.desire_path.folder
    assert pathlib.Path(place).is_absolute()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert os.path.isdir(os.path.join(place, "frames"))
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert not os.path.exists(place)


def test_record_bakes_the_same_without_blender(folder):
    ground, walker = scene(folder, frames=16)
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_record(filepath=str(folder / "walk.npz")) == {"FINISHED"}
    gait = Gait.load(str(folder / "walk.npz"))
    assert gait.walker_name == ("Walker",) and gait.mass[0] == 75.0 and len(gait.time) == 16
    from desire_path.ground.sim import Ground

    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    vertices = compat.positions(ground.data).astype(np.float64)
    job = bake.Bake(
        gait,
        Ground.mesh(vertices, compat.triangles(ground.data)),
        "dry-sand",
        str(folder / "plain"),
        cell_size=0.02,
        options=BakeOptions(origin=origin_of(folder)),
    )
    for _ in job.run():
        pass
    for name in ("compression", "heap", "pressure_time"):
        one, two = (maps.read(str(folder / place / "maps_final.exr")).planes[name] for place in ("bake", "plain"))
        assert one.tobytes() == two.tobytes(), name


def origin_of(folder):
    return json.loads((folder / "bake" / "report.json").read_text())["parameters"]["origin"]


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


def pressed(ground):
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    return compat.float_attribute(ground.data, "compression")


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


# ---- what is wrong is said in a sentence ------------------------------------------------------------


def test_bad_input(folder):
    operator = bpy.ops.object
    refused(operator.desire_path_ground_add, "mesh")
    refused(operator.desire_path_bake, "ground")
    stick = meshes.link(bpy.data.objects.new("Stick", bpy.data.armatures.new("Stick")))
    meshes.activate(stick)
    refused(operator.desire_path_walker_add, "no ground", "Add Ground")
    points = meshes.link(bpy.data.objects.new("Points", bpy.data.meshes.new("Points")))
    meshes.activate(points)
    refused(operator.desire_path_ground_add, "no faces")
    cube = meshes.grid(4, 4, 1.0, name="Plain")
    meshes.activate(cube)
    refused(operator.desire_path_walker_add, "no ground", "Add Ground")
    light = meshes.link(bpy.data.objects.new("Light", bpy.data.lights.new("Light", "POINT")))
    meshes.activate(light)
    refused(operator.desire_path_walker_add, "armature", "mesh")
    refused(operator.desire_path_record, "armature", "mesh")
    meshes.activate(cube)
    refused(operator.desire_path_bake, "no ground yet")
    refused(operator.desire_path_free, "no ground")
    ground, walker = scene(folder, frames=10)
    settings = ground.desire_path
    meshes.activate(stick)
    refused(operator.desire_path_walker_add, "no bones")
    second = meshes.grid(4, 4, 1.0, name="Second")
    meshes.activate(second)
    assert operator.desire_path_ground_add() == {"FINISHED"}
    refused(operator.desire_path_bake, "Nobody walks")
    lost = people.biped("Lost")
    meshes.activate(lost)
    refused(operator.desire_path_walker_add, "several grounds")
    second.select_set(True)
    assert operator.desire_path_walker_add() == {"FINISHED"}
    assert lost.desire_path.ground == second
    meshes.activate(second)
    second.desire_path.folder = settings.folder
    refused(operator.desire_path_bake, "same folder")
    second.desire_path.folder = str(folder / "second")
    bpy.data.objects.remove(lost)  # it stands on both
    meshes.activate(ground)
    for first, last in ((5, 5), (9, 2)):
        settings.frame_start, settings.frame_end = first, last
        refused(operator.desire_path_bake, f"{first} to {last}")
    settings.frame_start, settings.frame_end = 1, 10
    for cell in (0.0, -1.0, 1e-7, 50.0, float("nan")):
        settings.cell_size = cell
        refused(operator.desire_path_bake, "A cell size of", "choose")
    settings.cell_size = 0.02
    walker.desire_path.mass = -70.0
    refused(operator.desire_path_bake, "mass")
    walker.desire_path.mass = float("inf")
    refused(operator.desire_path_bake, "mass")
    walker.desire_path.mass = 75.0
    walker.scale = (1e-5,) * 3
    refused(operator.desire_path_bake, "scale")
    walker.scale = (1.0,) * 3
    walker.desire_path.feet[0].foot = "foot.R"
    refused(operator.desire_path_bake, "'foot.R'", "both")
    walker.desire_path.feet[0].foot = "foot.L"
    walker.location.z = -30.0
    refused(operator.desire_path_bake, "below the ground", "roofs")
    walker.location.z = 0.0
    walker.location.x = 500.0
    refused(operator.desire_path_bake, "beside the ground")
    walker.location.x = 0.0
    walker.data.bones["foot.L"].name = "renamed"
    refused(operator.desire_path_bake, "'foot.L'", "renamed")
    meshes.activate(walker)
    refused(operator.desire_path_record, "'foot.L'", filepath=str(folder / "walk.npz"))
    walker.data.bones["renamed"].name = "foot.L"
    refused(operator.desire_path_record, "cannot be written", filepath=str(folder / "nowhere" / "walk.npz"))
    meshes.activate(ground)
    (folder / "file").write_text("in the way")
    settings.folder = str(folder / "file")
    refused(operator.desire_path_bake, str(folder / "file"))
    settings.folder = "//somewhere"
    refused(operator.desire_path_bake, "save the file")
    settings.folder = str(folder / "bake")
    ground.rotation_euler.x = np.pi / 2
    refused(operator.desire_path_bake, "upright")
    ground.rotation_euler.x = 0.0
    assert operator.desire_path_bake() == {"FINISHED"}
    assert len(bpy.data.scenes) == 1


def test_full_disk_keeps_what_was_baked(folder):
    ground, _ = scene(folder, frames=12)
    real = sim.Film.write_frame

    def full(self, path, moment):
        if path is not None and path.endswith("trail_0007.exr"):
            raise OSError(28, "No space left on device", path)
        real(self, path, moment)

    sim.Film.write_frame = full
    try:
        refused(bpy.ops.object.desire_path_bake, "No space left", "room")
    finally:
        sim.Film.write_frame = real
    assert "frames 1 to 6 play" in ground.desire_path.missing
    sixth, _ = shown(ground, 6)
    later, _ = shown(ground, 12)
    assert sixth.tobytes() == later.tobytes()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing
    index = bake.read_index(str(folder / "bake"))
    assert index.complete and index.frames == 12


KILLED = """
import sys, bpy
sys.path.insert(0, sys.argv[-2])
import desire_path
desire_path.register()
bpy.ops.wm.open_mainfile(filepath=sys.argv[-1])
import time
from desire_path import bake, sim
real = sim.Film.write_frame
def slow(self, path, moment):
    real(self, path, moment)
    time.sleep(0.05)
sim.Film.write_frame = slow
bpy.context.view_layer.objects.active = bpy.data.objects["Ground"]
bpy.ops.object.desire_path_bake()
"""


def test_killed_in_the_middle(folder):
    (folder / "here").mkdir()
    file = str(folder / "here" / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    ground, _ = scene(frames=30)
    bpy.ops.wm.save_mainfile()
    addon = pathlib.Path(op_bake.__file__).parents[2]
    path = os.environ["PATH"]
    if bpy.app.binary_path:
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-expr", KILLED, "--", str(addon), file]
        path = "/usr/bin:/bin"
    else:
        command = [sys.executable, "-c", KILLED, str(addon), file]
    child = subprocess.Popen(
        command, env={**os.environ, "PATH": path}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    place = folder / "here" / "desire_path" / "a" / "Ground"
    until = time.monotonic() + 60
    while not list(place.rglob("trail_0006.exr")) and time.monotonic() < until:
        assert child.poll() is None, child.stdout.read().decode()
        time.sleep(0.01)
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    bpy.ops.wm.open_mainfile(filepath=file)
    ground = bpy.data.objects["Ground"]
    index = bake.read_index(str(place))
    assert not index.complete and 6 <= index.frames < 30
    assert playback.modifier(ground) is not None
    assert f"frames 1 to {index.frames} play" in ground.desire_path.missing
    position, colour = shown(ground, index.frames)
    assert colour.any()
    assert shown(ground, 30)[0].tobytes() == position.tobytes()
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing
    assert bake.read_index(str(place)).complete
    assert shown(ground, index.frames)[0].tobytes() == position.tobytes()


def test_lost_and_foreign_files_are_said(folder):
    (folder / "here").mkdir()
    file = str(folder / "here" / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    ground, _ = scene(frames=6)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.ops.wm.save_mainfile()
    place = folder / "here" / "desire_path" / "a" / "Ground" / "frames"
    text = (place / "index.json").read_text()
    (place / "index.json").write_text(text.replace('"format": 1', '"format": 99'))
    bpy.ops.wm.open_mainfile(filepath=file)
    assert "another form" in bpy.data.objects["Ground"].desire_path.missing
    (place / "index.json").write_text("{")
    bpy.ops.wm.open_mainfile(filepath=file)
    assert "damaged" in bpy.data.objects["Ground"].desire_path.missing
    (place / "index.json").write_text(text)
    data = (place / "trail_0004.exr").read_bytes()
    for wrong in (None, data[:-1], bytes(len(data))):  # gone, cut short, nothing but zeros
        (place / "trail_0004.exr").unlink()
        if wrong is not None:
            (place / "trail_0004.exr").write_bytes(wrong)
        bpy.ops.wm.open_mainfile(filepath=file)
        ground = bpy.data.objects["Ground"]
        assert "1 to 3 play, 4 to 6 are missing" in ground.desire_path.missing, ground.desire_path.missing
        assert shown(ground, 4)[0].tobytes() == shown(ground, 3)[0].tobytes()
        (place / "trail_0004.exr").write_bytes(data)
    (place / "trail_0004.exr").unlink()
    bpy.ops.wm.open_mainfile(filepath=file)
    ground = bpy.data.objects["Ground"]
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert not ground.desire_path.missing
