"""Baked with plants: what the files say is what the ground and its grass show; passes; nothing is left."""

import json
import struct

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused, scene, state
from test_plants import everything, roots
from test_plants_image import picture
from test_plants_seen import grown
from test_playback import fresh

from desire_path.bake import bake
from desire_path.blender import compat, home, paths, plants, playback, playback_tree, stems
from desire_path.errors import DesirePathError
from desire_path.ground import maps
from desire_path.ground.plants import KINDS


def meadow(folder, kind="carex", **more):
    ground, walker = scene(folder, frames=24, **more)
    ground.desire_path.soil = "soil"
    assert bpy.ops.object.desire_path_plants_add(kind=kind) == {"FINISHED"}
    return ground, walker


def test_a_bake_shows_how_its_plants_lie(folder):
    ground, _ = meadow(folder, "lawn", size=(3.0, 3.4))
    each = ground.desire_path.plants[0]
    rest = compat.positions(ground.data)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    index = bake.read_index(str(folder / "bake"))
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert index.lean and index.complete and report["contacts"] >= 2
    place = (rest[:, :2].astype(np.float64) - (index.x0, index.y0)) / index.cell - 0.5
    i, j = np.round(place).astype(int).T
    inside = (i >= 0) & (i < index.nx) & (j >= 0) & (j < index.ny)
    for frame in (24, 9):
        bpy.context.scene.frame_set(frame)
        mesh = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        planes = maps.read(index.lean_path(frame)).planes
        shown = np.empty((len(rest), 3), np.float32)
        mesh.attributes[playback_tree.LEAN].data.foreach_get("vector", shown.ravel())
        wanted = np.stack([planes[name][j[inside], i[inside]] for name in "RGB"], axis=1)
        assert shown[inside].tobytes() == wanted.tobytes()
        strength = compat.float_attribute(mesh, playback_tree.STRENGTH)
        np.testing.assert_allclose(strength[inside], planes["A"][j[inside], i[inside]], atol=1e-6)
        assert strength[~inside].min() > 0.99  # a lawn is dense: whole where nobody came
    assert planes["B"].max() > 0.9  # under a foot
    standing, none, _ = grown(each.grass, 0)
    found, real, told = grown(each.grass, 24)
    assert len(none) == 0 and len(standing) == each.count
    assert 0 < len(standing) - len(found) < 0.6 * each.count and len(real) > 5000
    # final values on the mesh, too
    last = compat.float_attribute(ground.data, "plant_strength")
    assert (~inside).sum() > 1000 and (last[~inside] == 1.0).all()
    np.testing.assert_allclose(
        last[inside], maps.read(index.lean_path(24)).planes["A"][j[inside], i[inside]], atol=1e-6
    )


def test_plants_hold_the_soil(folder):
    deepest = []
    for kind in (None, "lawn"):
        ground, walker = scene(folder, frames=24)
        ground.desire_path.soil = "soft-soil"
        if kind:
            bpy.ops.object.desire_path_plants_add(kind=kind)
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        deepest.append(json.loads((folder / "bake" / "report.json").read_text())["deepest_m"])
        bpy.ops.object.desire_path_remove()
        bpy.data.objects.remove(ground)
        bpy.data.objects.remove(walker)
    assert deepest[1] < 0.6 * deepest[0], deepest


def test_free_and_bake_again_leave_nothing(folder):
    ground, _ = meadow(folder)
    ground.desire_path.plant_mesh = ground.desire_path.vertex_group = True
    before, have = state(ground), everything()
    for _ in range(2):
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
        played = [image.name for image in bpy.data.images if playback_tree.TAG in image]
        assert sorted(name.split(" ")[1][:4] for name in played) == ["lean", "trai"], played
        assert len(bpy.data.node_groups) == 3 and state(ground) != before  # ground, grass, stems
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert state(ground) == before and everything() == have
    assert len(grown(ground.desire_path.plants[0].grass, 24)[0]) == ground.desire_path.plants[0].count
    assert not [path for path in (folder / "bake").rglob("*") if path.is_file()]


def test_a_bake_is_freed_without_the_file_of_its_kind(folder):
    file = folder / "fern-tall.json"
    KINDS["fern"].save(file)
    ground, _ = scene(folder, frames=24)
    none = everything()
    assert bpy.ops.object.desire_path_plants_add(kind=str(file)) == {"FINISHED"}
    before, have = state(ground), everything()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    file.unlink()
    refused(bpy.ops.object.desire_path_bake, "fern-tall.json")
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert state(ground) == before and everything() == have
    each = ground.desire_path.plants[0]
    assert len(grown(each.grass, 24)[0]) == each.count > 10
    assert bpy.ops.object.desire_path_remove() == {"FINISHED"}
    assert everything() == none and not ground.desire_path.is_ground


def test_a_duplicate_of_the_ground_leaves_its_grass_alone(folder):
    ground, _ = meadow(folder)
    ground.desire_path.plant_mesh = True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    have = everything()
    meshes.activate(ground)
    bpy.ops.object.duplicate()
    other, mine = bpy.context.object, ground.desire_path.plants[0]
    count, stood = mine.count, compat.positions(mine.grass.data).tobytes()
    theirs = other.desire_path.plants[0]
    theirs.density = 20.0
    assert theirs.count < 0.4 * count and plants.shown(theirs) is None
    assert bpy.ops.object.desire_path_plants_update() == {"FINISHED"}
    assert compat.positions(mine.grass.data).tobytes() == stood
    assert bpy.ops.object.desire_path_grass_add() == {"FINISHED"}
    assert len(theirs.grass.data.vertices) == theirs.count and theirs.grass != mine.grass
    assert bpy.ops.object.desire_path_plants_remove() == {"FINISHED"}
    assert bpy.ops.object.desire_path_remove() == {"FINISHED"}  # the files are the other's, too
    bpy.data.meshes.remove(other.data)
    assert everything() == have and len(mine.grass.data.vertices) == count
    assert ground.desire_path.plant_object is not None and playback.modifier(ground) is not None
    assert bake.read_index(str(folder / "bake")).complete


def test_an_image_says_where_plants_grow_in_a_bake(folder):
    ground, _ = meadow(folder, size=(3.0, 3.4))
    each, have = ground.desire_path.plants[0], len(bpy.data.images)
    value = np.zeros((1, 64), np.float32)
    value[:, 32:] = 1.0
    each.density_image = picture(value)
    at = compat.positions(ground.data)[:, 0]
    middle = (at.min() + at.max()) / 2
    assert roots(each)[:, 0].min() > middle - 0.03
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    strength = compat.float_attribute(ground.data, "plant_strength")
    full = min(1.0, each.density / plants.kind(each.kind).full_density)
    assert strength[at < middle - 0.3].max() == 0.0
    np.testing.assert_allclose(np.median(strength[at > middle + 0.3]), full, atol=0.05)
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert len(bpy.data.images) == have + 1


def test_saved_and_loaded_it_plays_on(folder):
    ground, _ = meadow(folder)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    each = ground.desire_path.plants[0]
    found, real, _ = grown(each.grass, 20)
    have = everything()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    ground = bpy.data.objects["Ground"]
    each = ground.desire_path.plants[0]
    again, bent, _ = grown(each.grass, 20)
    assert everything() == have and again == found and bent.tobytes() == real.tobytes() and len(real)


def test_undo_brings_back_what_was(folder):
    ground, _ = meadow(folder)
    bpy.ops.ed.undo_push(message="planted")
    each = ground.desire_path.plants[0]
    count, kind = each.count, each.kind
    each.density = 20.0
    bpy.ops.ed.undo_push(message="thinned")
    assert each.count < 0.4 * count
    bpy.ops.ed.undo()
    each = bpy.data.objects["Ground"].desire_path.plants[0]
    assert (each.count, each.kind) == (count, kind) and len(each.grass.data.vertices) == count
    bpy.ops.ed.redo()
    each = bpy.data.objects["Ground"].desire_path.plants[0]
    assert len(each.grass.data.vertices) == each.count < 0.4 * count


# ---- the plants themselves ---------------------------------------------------------------------------


def test_simulated_plants_play_as_a_mesh(folder):
    ground, _ = meadow(folder)
    ground.desire_path.plant_mesh = True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    obj = ground.desire_path.plant_object
    with np.load(folder / "bake" / "plants.npz") as file:
        edges = len(file["edges"])
    raw = (folder / "bake" / "plants.pc2").read_bytes()
    _, _, count, start, step, samples = struct.unpack("<12siiffi", raw[:32])
    assert (start, step, samples) == (1.0, 1.0, 24) and count == len(obj.data.vertices)
    points = np.frombuffer(raw[32:], "<f4").reshape(samples, count, 3)
    blades = obj.modifiers[stems.BLADES]
    for frame in (24, 7):
        blades.show_viewport = False
        bpy.context.scene.frame_set(frame)
        shown = compat.positions(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data)
        np.testing.assert_allclose(shown, points[frame - 1], atol=1e-5)
        blades.show_viewport = True
        bpy.context.scene.frame_set(frame)
        wide = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        assert len(wide.polygons) == edges
        assert wide.materials[0] is not None and "tuft_look" in wide.attributes
    assert np.abs(points[6] - points[0]).max() > 0.01  # somebody trod on them
    ground.desire_path.plant_mesh = False
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.plant_object is None and "Ground Plants" not in bpy.data.objects


def test_blades_taper_and_no_two_lie_in_one_place(folder):
    ground, _ = meadow(folder, "meadow")  # the middle stems of its three sheets are one
    ground.desire_path.plant_mesh = True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.context.scene.frame_set(1)
    mesh = ground.desire_path.plant_object.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    at = compat.positions(mesh)
    quad = np.array([face.vertices[:] for face in mesh.polygons])
    look = np.empty((len(at), 3), np.float32)
    mesh.attributes["tuft_look"].data.foreach_get("vector", look.ravel())
    ends = np.array([edge.vertices[:] for edge in mesh.edges])
    ends = ends[look[ends[:, 0], 0] == look[ends[:, 1], 0]]  # across a blade
    wide = np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1)
    along = look[ends[:, 0], 0]
    assert abs(wide[along == 0.0] / stems.WIDTH - 1.02).max() < 0.01
    assert wide[along == 1.0].max() < 0.1 * stems.WIDTH
    foot = quad[look[quad, 0].min(axis=1) == 0.0]
    middle, normal = at[foot].mean(axis=1), np.cross(at[foot[:, 1]] - at[foot[:, 0]], at[foot[:, 3]] - at[foot[:, 0]])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    order = np.lexsort(np.round(middle, 5).T)
    same = np.linalg.norm(np.diff(middle[order], axis=0), axis=1) < 1e-4
    turned = abs((normal[order][1:] * normal[order][:-1]).sum(axis=1))
    assert same.any() and turned[same].max() < 0.95, (same.sum(), turned[same].max())


# ---- passes ------------------------------------------------------------------------------------------


def curve(points, name="Way"):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    line = data.splines.new("POLY")
    line.points.add(len(points) - 1)
    for point, at in zip(line.points, points):
        point.co = (*at, 0.0, 1.0)
    data.bevel_depth = 0.05
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


PLACES = ((-0.4, 0.2), (0.2, -0.6), (0.3, -1.9))


def test_waypoints_of_curves_meshes_and_empties():
    here = bpy.context.scene
    line = curve(PLACES)
    line.location, line.scale = (1.0, 0.0, 0.5), (2.0, 1.0, 1.0)
    wanted = np.column_stack([np.array(PLACES) * (2.0, 1.0) + (1.0, 0.0), np.full(3, 0.5)])
    bpy.context.view_layer.update()
    np.testing.assert_allclose(paths.waypoints(here, line), wanted, atol=1e-6)
    mesh = bpy.data.meshes.new("edges")
    mesh.from_pydata([(*PLACES[1], 0), (*PLACES[2], 0), (*PLACES[0], 0)], [(0, 1), (2, 0)], [])
    obj = meshes.link(bpy.data.objects.new("edges", mesh))
    np.testing.assert_allclose(paths.waypoints(here, obj)[::-1, :2], PLACES, atol=1e-6)
    root = meshes.link(bpy.data.objects.new("stations", None))
    for name, at in zip(("b", "a", "c"), (PLACES[1], PLACES[0], PLACES[2])):
        child = meshes.link(bpy.data.objects.new(name, None))
        child.parent, child.location = root, (*at, 0.0)
    bpy.context.view_layer.update()
    here.unit_settings.scale_length = 0.1
    np.testing.assert_allclose(paths.waypoints(here, root)[:, :2], np.array(PLACES) * 0.1, atol=1e-6)
    bare = meshes.link(bpy.data.objects.new("bare", bpy.data.curves.new("bare", "CURVE")))
    for at in ((0.0, 5.0), (1.0, 5.0)):  # beside the line that was there, another
        line.data.splines.new("POLY").points[0].co = (*at, 0.0, 1.0)
    line.data.splines[1].points.add(1)
    line.data.splines[1].points[1].co = (1.0, 6.0, 0.0, 1.0)
    net = meshes.grid(4, 4, 0.5, name="net")  # one way leads through all of it, but no line is meant
    for odd, words in ((bare, "no length"), (line, "not one line"), (net, "not one line")):
        try:
            paths.waypoints(here, odd)
        except DesirePathError as problem:
            assert words in str(problem)
        else:
            raise AssertionError(words)
    assert not [each for each in bpy.data.curves if each.name not in ("Way", "bare")]


def test_passes_along_a_curve_are_a_frame_each(folder):
    ground, walker = meadow(folder, cell=0.02, size=(2.2, 3.0))
    rest = state(ground)
    walker.desire_path.path = curve(PLACES)
    walker.desire_path.passes = 6
    walker.desire_path.lateral = 0.03
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    index = bake.read_index(str(folder / "bake"))
    assert index.frames == 6 and index.complete and index.frame_start == 1
    worn = [maps.read(index.lean_path(n)).planes["A"] for n in (0, 1, 6)]
    lost = [float((worn[0] - each).sum()) for each in worn]
    assert lost[0] == 0.0 < lost[1] < lost[2]
    # where it is worn most lies the curve
    j, i = np.nonzero(worn[0] - worn[2] > 0.5 * (worn[0] - worn[2]).max())
    x = index.x0 + (i + 0.5) * index.cell
    y = index.y0 + (j + 0.5) * index.cell
    line = np.interp(-y, [-at[1] for at in PLACES], [at[0] for at in PLACES])
    assert len(x) > 50 and np.abs(x - line).max() < 0.45
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    assert state(ground) == rest
    # one pass is shown frame by frame
    walker.desire_path.passes = 1
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bake.read_index(str(folder / "bake")).frames > 24
    walker.desire_path.path = meshes.link(bpy.data.objects.new("lonely", None))
    meshes.activate(ground)
    refused(bpy.ops.object.desire_path_bake, "lonely", "empties")


def test_walkers_with_and_without_paths_go_in_turn(folder):
    from scenes import people

    ground, walker = scene(folder, frames=24, size=(2.2, 3.0))
    other = people.walk(people.biped(), frames=24)
    meshes.activate(other)
    bpy.ops.object.desire_path_walker_add()
    other.desire_path.path = curve(PLACES)
    other.desire_path.passes = 2
    walker.desire_path.passes = 7  # along no path
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert bake.read_index(str(folder / "bake")).frames == 3
    told = [each for each in json.loads(ground.desire_path.summary)["warnings"] if "no path" in each]
    assert len(told) == 1 and f"'{walker.name}' has 7 passes" in told[0]
    assert home.folder(ground) == str(folder / "bake") and not plants.stale(ground)


FRESH = """
import bpy, numpy as np, sys
assert not hasattr(bpy.types.Object, "desire_path")
bpy.ops.wm.open_mainfile(filepath=sys.argv[-2])
bpy.context.scene.frame_set(15)
graph = bpy.context.evaluated_depsgraph_get()
out = {}
for name in ("Ground Plants", "Ground Carex"):
    mesh = bpy.data.objects[name].evaluated_get(graph).data
    co = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", co)
    out[name[7:]] = co.reshape(-1, 3)
np.savez(sys.argv[-1], **out)
"""


def test_all_of_it_without_the_addon(folder):
    ground, _ = meadow(folder)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    ground.desire_path.folder, ground.desire_path.plant_mesh = "//bake", True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    bpy.context.scene.frame_set(15)
    graph = bpy.context.evaluated_depsgraph_get()
    wanted = {
        name: compat.positions(bpy.data.objects["Ground " + name].evaluated_get(graph).data)
        for name in ("Plants", "Carex")
    }
    bpy.ops.wm.save_mainfile()
    fresh(FRESH, folder / "a.blend", folder / "out.npz")
    with np.load(folder / "out.npz") as out:
        for name, points in wanted.items():
            assert out[name].tobytes() == points.tobytes() and len(points) > 500, name
