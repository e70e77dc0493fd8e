"""The whole way in Blender: choose, bake, play, free; and what happens when something is wrong."""

import json
import os
import pathlib
import time

import bpy
import numpy as np
from scenes import meshes, people
from test_playback import fresh, shown
from test_sample import ids

from desire_path.bake import bake, output
from desire_path.bake.options import BakeOptions
from desire_path.blender import compat
from desire_path.ground import maps
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


def pressed(ground):
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    return compat.float_attribute(ground.data, "compression")
