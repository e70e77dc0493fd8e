"""Plants on a ground: where they stand, what is seen of them, and how they lie where they were trodden."""

import os
import types

import bpy
import numpy as np
from scenes import exr, meshes
from test_bake import refused
from test_playback import corners
from test_sample import ids

from desire_path.blender import axes, compat, grass_tree, pictured, plants, playback, playback_tree
from desire_path.ground.plants import KINDS

NX, NY, CELL = 96, 64, 0.02
KEEP = ("node_groups", "images", "objects", "meshes", "scenes", "collections", "materials")


def everything():
    return ids() | {(kind, each.name) for kind in KEEP for each in getattr(bpy.data, kind)}


def bed(height=None, size=(NX, NY), spacing=CELL, **more):
    """A ground whose vertices are cell centres of index()."""
    ground = meshes.grid(*size, spacing, spacing / 2, spacing / 2, height=height, **more)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    return ground


def add(ground, kind="carex", **more):
    meshes.activate(ground)
    assert bpy.ops.object.desire_path_plants_add(kind=kind, **more) == {"FINISHED"}
    return ground.desire_path.plants[-1]


def paint(ground, weight, name="grown"):
    """A vertex group from a function of x and y."""
    group = ground.vertex_groups.new(name=name)
    at = compat.positions(ground.data)
    value = weight(at[:, 0], at[:, 1]) * np.ones(len(at))
    for level in np.unique(value):
        if level > 0:
            group.add(np.flatnonzero(value == level).tolist(), float(level), "REPLACE")


def roots(each):
    return compat.positions(each.grass.data)


def known(some, among):
    """Share of roots that are among others."""
    there = {tuple(root) for root in among[:, :2].tolist()}
    return np.mean([tuple(root) in there for root in some[:, :2].tolist()])


# ---- where they stand --------------------------------------------------------------------------------


def test_plants_stand_on_the_ground_as_dense_as_asked():
    ground = bed(lambda x, y: 0.1 * np.sin(4 * x) + 0.2 * y)
    for kind in ("carex", "fern", "moss"):
        each = add(ground, kind)
        place = roots(each)
        asked = KINDS[kind].density * NX * NY * CELL**2
        assert each.density == np.float32(KINDS[kind].density)
        assert len(place) == each.count and abs(len(place) - asked) < 0.15 * asked + 4, (kind, len(place), asked)
        wanted = 0.1 * np.sin(4 * place[:, 0]) + 0.2 * place[:, 1]
        np.testing.assert_allclose(place[:, 2], wanted, atol=2e-3)
        slope = np.empty((len(place), 3), np.float32)
        each.grass.data.attributes[grass_tree.SLOPE].data.foreach_get("vector", slope.ravel())
        inner = (place[:, 0] > 0.1) & (place[:, 0] < 1.8) & (place[:, 1] > 0.1) & (place[:, 1] < 1.1)
        np.testing.assert_allclose(slope[inner, 0], 0.4 * np.cos(4 * place[inner, 0]), atol=0.05)
        np.testing.assert_allclose(slope[inner, 1], 0.2, atol=0.02)
    assert [each.kind for each in ground.desire_path.plants] == ["carex", "fern", "moss"]
    refused(bpy.ops.object.desire_path_plants_add, "cactus", "carex", kind="cactus")
    refused(bpy.ops.object.desire_path_plants_add, "nan", density=float("nan"))
    assert len(ground.desire_path.plants) == 3


def test_the_densest_that_can_be_typed_grows():
    each = add(bed(size=(11, 11)), "carex", density=1e9)
    assert each.density == 5e4 and abs(each.count / (5e4 * 0.04) - 1.0) < 0.15
    each.density = 0.0
    assert 0.0 < each.density < 0.01 and each.count == 0


def test_a_painted_group_thins_and_moves_nobody():
    ground = bed()
    each = add(ground, "lawn")
    before = roots(each)
    paint(ground, lambda x, y: np.where(x < 0.9, 1.0, 0.0))
    each.density_group = "grown"
    painted = roots(each)
    assert painted[:, 0].max() < 0.94 and known(painted, before) == 1.0
    assert known(before[before[:, 0] < 0.88], painted) == 1.0
    ground.vertex_groups.remove(ground.vertex_groups["grown"])
    paint(ground, lambda x, y: np.where(x < 0.9, 0.25, 1.0))
    assert bpy.ops.object.desire_path_plants_update() == {"FINISHED"}
    thin, full = (np.count_nonzero((roots(each)[:, 0] < 0.88) == side) for side in (True, False))
    share = thin / np.count_nonzero(before[:, 0] < 0.88)
    assert 0.15 < share < 0.35, share
    each.density_group = ""
    assert roots(each).tobytes() == before.tobytes()
    # another density takes some away, a higher one adds; another seed moves all
    each.density = 200.0
    fewer = roots(each)
    assert known(fewer, before) == 1.0 and abs(len(fewer) / len(before) - 2 / 3) < 0.1
    each.density = 600.0
    assert abs(len(roots(each)) / len(before) - 2.0) < 0.2
    each.density, each.seed = 300.0, 9
    assert known(roots(each), before) < 0.01
    each.density_group = "nowhere"  # the sentence comes with the next Update
    assert "nowhere" in refused(bpy.ops.object.desire_path_plants_update)


def test_a_float_attribute_thins_as_well():
    ground = bed()
    at = compat.positions(ground.data)
    ground.data.attributes.new("wet", "FLOAT", "POINT").data.foreach_set("value", (at[:, 1] > 0.6).astype(np.float32))
    each = add(ground)
    each.density_group = "wet"
    assert roots(each)[:, 1].min() > 0.56 and each.count > 20


def test_an_attribute_that_is_no_number_is_named():
    ground = bed()
    value = np.ones(len(ground.data.vertices), np.float32)
    value[7], value[9] = np.nan, np.inf
    ground.data.attributes.new("wet", "FLOAT", "POINT").data.foreach_set("value", value)
    refused(bpy.ops.object.desire_path_plants_add, "'wet'", "point 7", density_group="wet")
    assert not ground.desire_path.plants


def share(each, among, where):
    """How many of the roots `among` are left where a function of them says."""
    left, there = where(roots(each)), where(among)
    return np.count_nonzero(left) / np.count_nonzero(there)


GROWN = """
import bpy, numpy as np, sys
bpy.ops.wm.open_mainfile(filepath=sys.argv[-3])
bpy.context.scene.frame_set(1)
mesh = bpy.data.objects[sys.argv[-1]].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
value = np.empty(len(mesh.vertices), np.float32)
mesh.attributes["plant_strength"].data.foreach_get("value", value)
np.save(sys.argv[-2], value)
"""


def test_modifiers_scale_and_units_of_the_ground_count():
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 0.01
    ground = meshes.grid(12, 9, 10.0, 0.0, 0.0)
    lift = ground.modifiers.new("lift", "DISPLACE")
    lift.strength, lift.mid_level = 25.0, 0.0
    ground.location, ground.rotation_euler, ground.scale = (30.0, -20.0, 5.0), (0.0, 0.0, 0.5), (2.0, 2.0, 2.0)
    bpy.ops.object.desire_path_ground_add()
    each = add(ground, "carex")
    place = roots(each)  # metres in the world
    np.testing.assert_allclose(place[:, 2], 0.05 + 0.5, atol=1e-3)
    assert abs(each.count / (80 * 2.2 * 1.6) - 1.0) < 0.15
    bpy.context.view_layer.update()
    world = np.array(each.grass.matrix_world)
    shown = place @ world[:3, :3].T + world[:3, 3]
    np.testing.assert_allclose(shown, place * 100.0, rtol=1e-4, atol=1e-3)
    ground.location.x += 7.0  # grass goes along
    bpy.context.view_layer.update()
    np.testing.assert_allclose(np.array(each.grass.matrix_world)[:3, 3] - world[:3, 3], (7, 0, 0), atol=1e-4)


def test_plants_stand_on_the_ground_as_it_is_first_whatever_frame_is_shown():
    scene = bpy.context.scene
    ground = bed()
    rise = ground.modifiers.new("Rise", "DISPLACE")
    rise.strength, rise.mid_level, rise.direction = 0.05, 0.0, "Z"
    for frame, on in ((1, True), (10, False)):
        rise.show_render = on
        rise.keyframe_insert("show_render", frame=frame)
    ground.desire_path.frame_start = 1
    for shown in (1, 20):
        scene.frame_set(shown)
        np.testing.assert_allclose(roots(add(ground))[:, 2], 0.05, atol=1e-6)


def test_a_kind_is_chosen_by_its_picture():
    ground = bed()
    each = add(ground)
    assert each.pictured == "carex"
    before = each.grass.name
    each.pictured = "fern"
    assert each.kind == "fern" and each.pictured == "fern" and before in bpy.data.objects
    each.kind = "mine.json"
    assert each.pictured == pictured.OWN and each.kind == "mine.json"
    for kind in KINDS:
        image = bpy.data.images.load(os.path.join(pictured.FOLDER, f"{kind}.png"))
        assert tuple(image.size) == (96, 96), kind


def test_a_kind_of_the_user(folder):
    path = str(folder / "heath.json")
    KINDS["carex"].save(path)
    text = (folder / "heath.json").read_text().replace('"height": 0.1', '"height": 0.2')
    (folder / "heath.json").write_text(text)
    ground = bed()
    each = add(ground, path)
    assert plants.kind(each.kind).height == 0.2 and each.count > 50 and "Heath" in each.grass.name
    (folder / "heath.json").write_text("{")
    assert "heath.json" in refused(bpy.ops.object.desire_path_plants_update)


def images(folder, trail, lean):
    """Two frames of a bake: at rest, and as told."""
    os.makedirs(folder / "frames", exist_ok=True)
    rest = np.zeros((2, NY, NX, 4), np.float32)
    rest[0, ..., 1] = rest[1, ..., 3] = 1.0
    for number, (ground, plant) in enumerate((rest, (trail, lean))):
        exr.write(folder / "frames" / f"trail_{number:04d}.exr", ground)
        exr.write(folder / "frames" / f"lean_{number:04d}.exr", plant)
    return types.SimpleNamespace(
        cell=CELL,
        x0=0.0,
        y0=0.0,
        nx=NX,
        ny=NY,
        frame_start=1,
        frame_end=1,
        frames=1,
        lean=True,
        folder=str(folder / "frames"),
    )


def play(ground, index, **more):
    bpy.context.view_layer.update()
    playing = playback_tree.Playing(
        index,
        count=1,
        world=axes.matrix(ground.matrix_world, "g"),
        scale=1.0,
        smooth=False,
        corners=corners(ground),
        standing=plants.standing(ground),
        **more,
    )
    playback.attach(ground, index.folder, playing)
    plants.show(ground, index)


def blank():
    trail, lean = np.zeros((NY, NX, 4), np.float32), np.zeros((NY, NX, 4), np.float32)
    trail[..., 1] = lean[..., 3] = 1.0
    x, y = np.meshgrid((np.arange(NX) + 0.5) * CELL, (np.arange(NY) + 0.5) * CELL)
    return trail, lean, x, y
