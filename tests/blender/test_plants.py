"""Plants on a ground: where they stand, what is seen of them, and how they lie where they were trodden."""

import os
import struct
import types
import zlib

import bpy
import numpy as np
from scenes import exr, meshes
from test_bake import refused, state
from test_playback import corners, fresh
from test_sample import ids

from desire_path.blender import axes, compat, grass, grass_tree, plants, playback, playback_tree, wiring
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


# ---- thinned by an image -----------------------------------------------------------------------------


def picture(value, name="mask", **more):
    """An image of so bright pixels (rows, columns), grey or (rows, columns, 3); row 0 below."""
    value = np.asarray(value, np.float32)
    image = bpy.data.images.new(name, value.shape[1], value.shape[0], **more)
    pixels = np.ones((*value.shape[:2], 4), np.float32)
    pixels[..., :3] = value if value.ndim == 3 else value[..., None]
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image


def halves(share_left=0.0, rows=8, columns=64):
    """Bright on the right, as bright as told on the left."""
    value = np.ones((rows, columns), np.float32)
    value[:, : columns // 2] = share_left
    return value


def unwrap(ground, at, name="UVMap"):
    """A UV map from a function of x and y, made the active one."""
    layer = ground.data.uv_layers.new(name=name)
    place = compat.positions(ground.data)
    of = np.empty(len(ground.data.loops), np.int32)
    ground.data.loops.foreach_get("vertex_index", of)
    for loop, (x, y) in zip(layer.data, place[of, :2].tolist()):
        loop.uv = at(x, y)
    ground.data.uv_layers.active = layer


def share(each, among, where):
    """How many of the roots `among` are left where a function of them says."""
    left, there = where(roots(each)), where(among)
    return np.count_nonzero(left) / np.count_nonzero(there)


def test_an_image_thins_over_the_bounding_rectangle():
    ground = bed(lambda x, y: 0.2 * x)
    each = add(ground, "lawn")
    before = roots(each)
    each.density_image = picture(halves(0.25))  # put anew at once
    after = roots(each)
    wide = NX * CELL / 2
    assert known(after, before) == 1.0 and each.count == len(after) < len(before)
    assert known(before[before[:, 0] > wide + 0.02], after) == 1.0
    assert abs(share(each, before, lambda at: at[:, 0] < wide - 0.02) - 0.25) < 0.05
    # columns of brightness, twice as high as wide, are rows of none of them: the picture lies the right way up
    each.density_image = picture(halves().T, "up")
    assert roots(each)[:, 1].min() > NY * CELL / 2 - 0.03 and each.count > 0.4 * len(before)
    each.density_image = None
    assert roots(each).tobytes() == before.tobytes()


def test_an_image_and_a_group_multiply():
    ground = bed()
    before = roots(add(ground, "lawn"))
    paint(ground, lambda x, y: np.where(y < 0.6, 0.5, 1.0))
    each = add(ground, "lawn", density_group="grown", density_image=picture(np.full((3, 5), 0.5)).name)
    each.seed = 0
    assert abs(share(each, before, lambda at: at[:, 1] < 0.57) - 0.25) < 0.04
    assert abs(share(each, before, lambda at: at[:, 1] > 0.63) - 0.5) < 0.05


def test_an_image_follows_the_active_uv_map_and_repeats():
    ground = bed(size=(13, 9), spacing=0.2)  # few points: the picture is finer than the mesh
    before = roots(add(ground, "lawn"))
    each = add(ground, "lawn", density_image=picture(halves(rows=4, columns=32)).name)
    each.seed = 0
    unwrap(ground, lambda x, y: (0.0, 0.0), "other")
    unwrap(ground, lambda x, y: (y - 0.1 + 3.0, x), "mine")  # bright where 0.6 < y < 1.1, dark, and again from 1.6 on
    bpy.ops.object.desire_path_plants_update()
    bright = lambda at: np.mod(at[:, 1] - 0.1, 1.0) > 0.5  # noqa: E731
    assert share(each, before, bright) > 0.93 and share(each, before, lambda at: ~bright(at)) < 0.07
    ground.data.uv_layers.active = ground.data.uv_layers["other"]
    bpy.ops.object.desire_path_plants_update()
    assert each.count == 0
    # a modifier may turn the faces into others: the map goes with them
    ground.data.uv_layers.active = ground.data.uv_layers["mine"]
    finer = ground.modifiers.new("finer", "SUBSURF")
    finer.subdivision_type, finer.levels = "SIMPLE", 2
    bpy.ops.object.desire_path_plants_update()
    assert share(each, before, bright) > 0.93 and share(each, before, lambda at: ~bright(at)) < 0.07


def test_islands_of_a_uv_map_do_not_mix_and_the_upper_face_counts():
    # a slab: its top is cut in two islands that lie apart in the picture, its bottom lies where it is black
    at = [(x, y, z) for z in (0.0, 0.3) for y in (0.0, 1.0) for x in (0.0, 1.0, 2.0)]
    mesh = bpy.data.meshes.new("slab")
    mesh.from_pydata(at, [], [(6, 7, 10, 9), (7, 8, 11, 10), (0, 3, 4, 1), (1, 4, 5, 2)])
    layer = mesh.uv_layers.new(name="UVMap")
    island = [(0.55, 0.1), (0.95, 0.1), (0.95, 0.9), (0.55, 0.9)]
    corners = island + [(u - 0.5, v) for u, v in island] + [(0.9 if u < 0.8 else 0.1, v) for u, v in 2 * island]
    for loop, uv in zip(layer.data, corners):
        loop.uv = uv
    ground = bpy.data.objects.new("slab", mesh)
    bpy.context.scene.collection.objects.link(ground)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    before = roots(add(ground, "lawn"))
    assert len(before) > 400 and np.ptp(before[:, 2]) < 1e-4
    each = add(ground, "lawn", density_image=picture(halves()).name)
    each.seed = 0
    assert share(each, before, lambda at: at[:, 0] < 1.0) == 1.0
    assert roots(each)[:, 0].max() <= 1.02


def test_pixels_count_as_they_are_stored(folder):
    from desire_path.blender import picture as pictures

    red = np.zeros((2, 3, 3), np.float32)
    red[..., 0], red[0, 1] = 1.0, (0.0, 1.0, 0.0)
    wanted = np.full((2, 3), 0.2126)
    wanted[0, 1] = 0.7152
    for deep in (False, True):
        np.testing.assert_allclose(pictures.brightness(picture(red, float_buffer=deep)), wanted, atol=1e-4)
    wild = picture([[-1.0, 0.5, 7.0, np.nan]], float_buffer=True)
    np.testing.assert_allclose(pictures.brightness(wild), [[0.0, 0.5, 1.0, 0.0]], atol=1e-4)
    # 8 and 16 bits a channel, from files, packed, and after a tree of nodes has used them
    grey = np.array([[32, 128, 200]])
    for bits in (8, 16):
        path = folder / f"grey{bits}.png"
        path.write_bytes(png(grey, bits))
        for space in ("sRGB", "Non-Color"):
            image = bpy.data.images.load(str(path))
            image.colorspace_settings.name = space
            np.testing.assert_allclose(pictures.brightness(image), grey / 255.0, atol=3e-3, err_msg=f"{bits} {space}")
            image.pack()
            np.testing.assert_allclose(pictures.brightness(image), grey / 255.0, atol=3e-3)
            used(image)
            np.testing.assert_allclose(pictures.brightness(image), grey / 255.0, atol=3e-3, err_msg=f"{bits} {space}")
    path = folder / "one.exr"
    exr.write(path, np.full((4, 6, 4), 0.3, np.float32))
    np.testing.assert_allclose(pictures.brightness(bpy.data.images.load(str(path))), 0.3, atol=1e-5)


def png(grey, bits):
    """A grey PNG of 0..255 (rows, columns), row 0 below."""
    value = np.asarray(grey)[::-1]
    rows = value.astype(">u1") if bits == 8 else (value * 257).astype(">u2")
    data = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    head = struct.pack(">IIBBBBB", value.shape[1], value.shape[0], bits, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")


def used(image):
    """Let geometry nodes read an image."""
    ground = meshes.grid(3, 3, 0.1, 0.0, 0.0)
    tree = compat.geometry_tree("reads", bpy.data.node_groups.new)
    wire = wiring.Wiring(tree)
    here = wire.add("GeometryNodeInputPosition").outputs[0]
    colour = wire.image(image, here, 0, False).outputs["Color"]
    moved = wire.add("GeometryNodeSetPosition", Geometry=wire.add("NodeGroupInput").outputs[0], Offset=colour)
    tree.links.new(moved.outputs[0], tree.nodes.new("NodeGroupOutput").inputs[0])
    grass.use_tree(ground.modifiers.new("reads", "NODES"), tree)
    bpy.context.view_layer.update()
    assert ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices[4].co.z > 0.01


def test_images_that_cannot_be_used_get_a_sentence(folder):
    ground = bed(size=(20, 20))
    refused(bpy.ops.object.desire_path_plants_add, "no image 'nowhere'", density_image="nowhere")
    (folder / "lost.png").write_bytes(png(np.zeros((2, 2), int), 8))
    lost = bpy.data.images.load(str(folder / "lost.png"))
    (folder / "lost.png").unlink()
    lost.reload()
    refused(bpy.ops.object.desire_path_plants_add, "cannot be loaded", density_image=lost.name)
    moving = bpy.data.images.new("moving", 2, 2)
    moving.source = "SEQUENCE"
    refused(bpy.ops.object.desire_path_plants_add, "sequence", density_image=moving.name)
    assert not ground.desire_path.plants
    each = add(ground, "carex")
    each.density_image = lost  # the sentence comes with the next Update
    assert "lost.png" in refused(bpy.ops.object.desire_path_plants_update)
    assert plants.stale(ground) == [each]
    # an image that was removed is an image that was taken off
    bpy.data.images.remove(lost)
    assert each.density_image is None and not plants.stale(ground)
    assert bpy.ops.object.desire_path_plants_update() == {"FINISHED"} and each.count > 0


def test_other_pixels_are_another_bake():
    ground = bed(size=(40, 40))
    image = picture(halves())
    each = add(ground, "carex", density_image=image.name)

    def planted():
        (planting,) = plants.plantings(bpy.context.scene, ground)
        return b"".join(array.tobytes() for array in planting.arrays()), planting

    once, planting = planted()
    place = planting.within(-10, -10, 10, 10)
    assert {tuple(at) for at in roots(each)[:, :2].tolist()} == {tuple(at) for at in place.tolist()}  # as shown
    assert once == planted()[0] and not plants.stale(ground)
    image.pixels.foreach_set(np.ones(len(image.pixels), np.float32))
    image.update()
    assert planted()[0] != once
    other = picture(halves(), "other")
    each.density_image = other
    assert planted()[0] == once and not plants.stale(ground)
    other.name = "renamed"
    assert plants.stale(ground) == [each]


def test_off_the_images_the_ground_says_what_an_image_let_grow(folder):
    ground = meshes.grid(NX + 40, NY + 40, CELL, CELL / 2 - 20 * CELL, CELL / 2 - 20 * CELL)
    bpy.ops.object.desire_path_ground_add()
    paint(ground, lambda x, y: np.where(y < 0.0, 0.5, 1.0))
    value = np.tile(np.linspace(0.0, 1.0, 34, dtype=np.float32), (2, 1))
    each = add(
        ground, "lycopodium", density=32.0, grass=False, density_group="grown", density_image=picture(value).name
    )
    add(ground, "lycopodium", density=4.0, grass=False)
    have = everything()
    trail, lean, *_ = blank()
    trail[..., 1] = lean[..., 3] = 0.7
    play(ground, images(folder, trail, lean))
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    fresh(GROWN, folder / "a.blend", folder / "out.npy", ground.name)
    strength, rest = np.load(folder / "out.npy"), compat.positions(ground.data)
    i, j = np.round(rest[:, :2] / CELL - 0.5).astype(int).T
    inside = (i >= 0) & (i < NX) & (j >= 0) & (j < NY)
    np.testing.assert_allclose(strength[inside], 0.7, atol=1e-5)
    along = (rest[:, 0] - rest[:, 0].min()) / np.ptp(rest[:, 0])
    bright = np.interp(along * 34 - 0.5, np.arange(34), value[0])
    wanted = 0.1 + 0.8 * bright * np.where(rest[:, 1] < 0.0, 0.5, 1.0)
    clear = ~inside & (abs(rest[:, 1]) > 2 * CELL) & (along > 0.02) & (along < 0.98)
    np.testing.assert_allclose(strength[clear], wanted[clear], atol=0.02)
    assert each.density_image is not None
    playback.detach(ground)
    assert everything() == have


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


# ---- what is seen ------------------------------------------------------------------------------------


def grown(obj, frame=None):
    """(instances as {(x, y): height}, real vertices (n, 3), their attributes) of an object of grass."""
    scene = bpy.context.scene
    scene.frame_set(scene.frame_current if frame is None else frame)
    graph = bpy.context.evaluated_depsgraph_get()
    found = {}
    for each in graph.object_instances:
        if each.is_instance and each.parent is not None and each.parent.original == obj:
            matrix = np.array(each.matrix_world)
            if len(each.object.data.vertices) and not _is_real(each.object.data):
                found[tuple(np.round(matrix[:2, 3], 4).tolist())] = float(matrix[2, 3])
    mesh = obj.evaluated_get(graph).data
    real = compat.positions(mesh) if _is_real(mesh) else np.zeros((0, 3), np.float32)
    values = {}
    if len(real):
        for name in (grass_tree.PLACE, grass_tree.ROOT, grass_tree.AT, grass_tree.LOOK):
            values[name] = np.empty((len(real), 3), np.float32)
            mesh.attributes[name].data.foreach_get("vector", values[name].ravel())
        values[grass_tree.STRENGTH] = compat.float_attribute(mesh, grass_tree.STRENGTH)
        values[grass_tree.SIZE] = compat.float_attribute(mesh, grass_tree.SIZE)
    return found, real, values


def _is_real(mesh):
    return grass_tree.PLACE in mesh.attributes


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


def test_standing_grass_is_instances_at_the_roots():
    ground = bed(lambda x, y: 0.3 * x)
    each = add(ground, "meadow")
    found, real, _ = grown(each.grass)
    place = roots(each)
    assert len(real) == 0 and len(found) == each.count == len(place)
    seen = np.array([(*at, height) for at, height in found.items()])
    apart = np.abs(seen[:, None] - place[None]).max(axis=2)
    assert apart.min(axis=0).max() < 1e-4 and apart.min(axis=1).max() < 1e-4


def test_trodden_stems_lie_along_the_lean_and_standing_ones_stay(folder):
    ground = bed()
    each = add(ground, "carex")
    trail, lean, x, y = blank()
    trodden = (abs(x - 0.96) < 0.25) & (abs(y - 0.6) < 0.2)
    trail[trodden, 0] = -0.03
    lean[trodden] = (1.0, 0.0, 1.0, 1.0)
    play(ground, images(folder, trail, lean))
    standing, none, _ = grown(each.grass, 0)
    assert len(none) == 0 and len(standing) == each.count
    found, real, told = grown(each.grass, 1)
    # those far away are the very same, those under the foot are real now
    assert all(standing[at] == height for at, height in found.items())
    away = [at for at in standing if abs(at[0] - 0.96) > 0.4 or abs(at[1] - 0.6) > 0.35]
    assert len(away) > 50 and all(at in found for at in away) and len(found) < len(standing)
    size = told[grass_tree.SIZE]
    foot = told[grass_tree.PLACE][:, :2]
    deep = (abs(foot[:, 0] - 0.96) < 0.16) & (abs(foot[:, 1] - 0.6) < 0.11)
    above = told[grass_tree.AT][:, 2] > 1e-4
    assert deep.sum() > 1000
    # flat on the pressed ground, none below it
    height = real[deep & above, 2]
    assert height.min() > -0.0301 and np.percentile(height, 90) < -0.03 + 0.012 and height.max() < 0.02, height.max()
    # tips point along +x, at about the stem's length
    tip = deep & (told[grass_tree.LOOK][:, 0] > 0.99)
    reach = (real[tip, 0] - foot[tip, 0]) / (told[grass_tree.ROOT][tip, 2] * size[tip])
    assert np.median(reach) > 0.75 and (reach > 0.3).mean() > 0.95, np.median(reach)


def lengths(real, told, many=200):
    """Length of every real stem along its middle over its length when straight."""
    key = np.column_stack([told[grass_tree.PLACE], told[grass_tree.ROOT]])
    out = []
    for stem in np.unique(key, axis=0)[:many]:
        at = np.flatnonzero((key == stem).all(axis=1))
        s = told[grass_tree.AT][at, 2]
        rows = np.unique(np.round(s, 6))
        rows = rows[rows >= -1e-6]
        middle = np.array([real[at][np.abs(s - row) < 2e-6].mean(axis=0) for row in rows])
        straight = (rows[-1] - rows[0]) * told[grass_tree.SIZE][at[0]]
        if straight > 0.01:
            out.append(np.linalg.norm(np.diff(middle, axis=0), axis=1).sum() / straight)
    return np.array(out)


def test_leaning_stems_are_arcs_of_the_same_length(folder):
    ground = bed()
    each = add(ground, "lawn")
    each.density = 40.0
    trail, lean, *_ = blank()
    for lean_x, crushed in ((0.5, 0.15), (0.8, 0.5), (0.0, 0.3)):
        lean[...] = (lean_x, 0.0, crushed, 1.0)
        play(ground, images(folder, trail, lean))
        found, real, told = grown(each.grass, 1)
        assert len(found) == 0
        kept = lengths(real, told)  # along the blades' few pieces: chords of an arc are a little shorter
        assert len(kept) > 100 and np.median(kept) > 0.93 and kept.max() < 1.02, (kept.min(), kept.max())
        # bent more towards the tip: the lower half rises higher than the upper
        s, high = told[grass_tree.LOOK][:, 0], real[:, 2] / (told[grass_tree.ROOT][:, 2] * told[grass_tree.SIZE])
        half = high[abs(s - 1 / 3) < 0.01].mean()
        top = high[s > 0.99].mean()
        assert half > 1.2 * top / 3, (half, top)


def test_images_at_rest_change_nothing(folder):
    # real stems in their own shape are what the instances are
    ground = bed(lambda x, y: 0.1 * x)
    each = add(ground, "meadow")
    trail, lean, *_ = blank()
    lean[..., 3] = 0.98  # just enough to be made real; hardly a stem is broken
    play(ground, images(folder, trail, lean))
    _, real, told = grown(each.grass, 1)
    assert len(real) > 10000
    shape = dict(enumerate(grass.scattered(each.grass.modifiers[0].node_group).objects))
    graph = bpy.context.evaluated_depsgraph_get()
    bpy.context.scene.frame_set(0)
    graph = bpy.context.evaluated_depsgraph_get()
    wanted = []
    for instance in graph.object_instances:
        mine = instance.is_instance and instance.parent is not None and instance.parent.original == each.grass
        if mine and not _is_real(instance.object.data):
            local = compat.positions(instance.object.data)
            matrix = np.array(instance.matrix_world)
            wanted.append(local @ matrix[:3, :3].T + matrix[:3, 3])
    wanted = np.concatenate(wanted)
    assert len(shape) == 8 and len(wanted) == len(real)
    order, other = (np.lexsort(np.round(a[:, :2], 3).T) for a in (wanted, real))
    # roots follow the slope stem by stem, which instances do not; sideways all is the same
    gap = np.abs(wanted[order][:, :2] - real[other][:, :2]).max(axis=1)
    assert np.percentile(gap, 95) < 2e-3, np.percentile(gap, 95)


def test_broken_stems_are_pale_and_wear_away(folder):
    ground = bed()
    each = add(ground, "lawn")
    trail, lean, *_ = blank()
    heights, pale = [], []
    for strength in (0.9, 0.5, 0.02):
        trail[..., 3] = 3e5 * (1 - strength)  # trodden that often
        lean[...] = (0.9 * (1 - strength), 0.0, 1 - strength, strength)
        play(ground, images(folder, trail, lean))
        _, real, told = grown(each.grass, 1)
        tips = told[grass_tree.LOOK][:, 0] > 0.99
        heights.append(real[tips, 2].mean())
        pale.append(told[grass_tree.STRENGTH][tips].mean())
    assert heights[0] > 1.4 * heights[1] > 5 * heights[2], heights
    assert pale[0] > pale[1] > pale[2] and pale[2] < 0.15, pale


# ---- attributes for any other grass -------------------------------------------------------------------


def test_the_ground_says_how_plants_lie(folder):
    random = np.random.default_rng(5)
    lean = random.uniform(-0.7, 0.7, (NY, NX, 4)).astype(np.float32)
    lean[..., 2:] = np.abs(lean[..., 2:])
    trail = blank()[0]
    trail[..., 1] = lean[..., 3]
    # wider than the images, on all sides
    ground = meshes.grid(NX + 40, NY + 40, CELL, CELL / 2 - 20 * CELL, CELL / 2 - 20 * CELL)
    bpy.ops.object.desire_path_ground_add()
    paint(ground, lambda x, y: np.where(y < 0.0, 0.25, 1.0))
    each = add(ground, "lycopodium", grass=False)
    assert each.grass is None and plants.shown(each) is None
    each.density_group, each.density = "grown", 32.0
    rest = compat.positions(ground.data)
    group = ground.vertex_groups.new(name=playback_tree.group_name("plant_strength"))
    play(ground, images(folder, trail, lean), layer_depth=0.3)
    bpy.context.scene.frame_set(1)
    mesh = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    at = np.empty((len(rest), 3), np.float32)
    mesh.attributes[playback_tree.LEAN].data.foreach_get("vector", at.ravel())
    strength = compat.float_attribute(mesh, playback_tree.STRENGTH)
    i, j = np.round(rest[:, :2] / CELL - 0.5).astype(int).T
    inside = (i >= 0) & (i < NX) & (j >= 0) & (j < NY)
    assert at[inside].tobytes() == lean[..., :3].reshape(-1, 3).tobytes()
    np.testing.assert_allclose(strength[inside], lean[..., 3].ravel(), atol=1e-6)
    # off the images they stand as they grew: 32 of the 40 a square metre that are full cover, thinned below
    assert not at[~inside].any()
    wanted = np.where(rest[~inside, 1] < -CELL, 0.25, 1.0) * 0.8
    clear = abs(rest[~inside, 1]) > 2 * CELL
    np.testing.assert_allclose(strength[~inside][clear], wanted[clear], atol=1e-5)
    weight = {v.index: g.weight for v in mesh.vertices for g in v.groups if g.group == group.index}
    for vertex in range(0, len(rest), 371):
        assert abs(weight[vertex] - strength[vertex]) < 1e-5
    assert compat.positions(ground.data).tobytes() == rest.tobytes()


def test_bare_ground_plays_by_the_same_nodes(folder):
    ground = bed()
    index = images(folder, *blank()[:2])
    index.lean = False
    play(ground, index)
    nodes = [node.bl_idname for node in playback.modifier(ground).node_group.nodes]
    assert nodes.count("GeometryNodeImageTexture") == 1
    assert nodes.count("GeometryNodeStoreNamedAttribute") == 1
    assert set(playback.images(playback.modifier(ground).node_group)) == {"trail"}


# ---- nothing is left ----------------------------------------------------------------------------------


def test_grass_without_the_addon(folder):
    ground = bed()
    each = add(ground, "carex")
    trail, lean, x, y = blank()
    lean[(abs(x - 0.9) < 0.2)] = (0.2, 0.9, 0.9, 0.8)
    play(ground, images(folder, trail, lean))
    found, real, _ = grown(each.grass, 1)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    fresh(FRESH, folder / "a.blend", folder / "out.npz", each.grass.name)
    with np.load(folder / "out.npz") as out:
        assert out["count"] == len(found) > 10 and out["real"].tobytes() == real.tobytes() and len(real)


FRESH = """
import bpy, numpy as np, sys
assert not hasattr(bpy.types.Object, "desire_path")
bpy.ops.wm.open_mainfile(filepath=sys.argv[-3])
bpy.context.scene.frame_set(1)
graph = bpy.context.evaluated_depsgraph_get()
mesh = bpy.data.objects[sys.argv[-1]].evaluated_get(graph).data
co = np.empty(3 * len(mesh.vertices), np.float32)
mesh.vertices.foreach_get("co", co)
real = sum(1 for each in graph.object_instances
           if each.is_instance and "tuft_place" not in each.object.data.attributes)
np.savez(sys.argv[-2], real=co.reshape(-1, 3), count=real)
"""


def test_removed_plants_leave_nothing(folder):
    ground = bed()
    before, have = state(ground), everything()
    add(ground, "carex"), add(ground, "carex"), add(ground, "wheat", grass=False)
    trail, lean, *_ = blank()
    lean[..., 2] = 0.5
    play(ground, images(folder, trail, lean))
    assert bpy.ops.object.desire_path_plants_remove() == {"FINISHED"}
    assert [each.kind for each in ground.desire_path.plants] == ["carex", "carex"]
    playback.detach(ground)
    plants.show(ground)
    assert not [image for image in bpy.data.images if grass.TAG in image]
    for _ in range(2):
        assert bpy.ops.object.desire_path_plants_remove() == {"FINISHED"}
    assert everything() == have and state(ground) == before
    assert not bpy.ops.object.desire_path_plants_remove.poll()
    # with its ground
    add(ground, "moss")
    assert bpy.ops.object.desire_path_remove() == {"FINISHED"}
    assert everything() == have


def test_grass_that_was_deleted_can_be_shown_again():
    ground = bed()
    each = add(ground, "fern")
    meshes.activate(each.grass)
    bpy.ops.object.delete()
    meshes.activate(ground)
    assert plants.shown(each) is None
    assert bpy.ops.object.desire_path_plants_update() == {"FINISHED"}
    assert bpy.ops.object.desire_path_grass_add() == {"FINISHED"}
    assert len(grown(each.grass)[0]) == each.count > 0
    assert "already" in refused(bpy.ops.object.desire_path_grass_add)


def test_the_users_own_tufts_stay(folder):
    ground = bed()
    each = add(ground, "carex")
    own = bpy.data.collections.new("mine")
    stick = bpy.data.meshes.new("mine")
    stick.from_pydata([(0, 0, 0.1 * k) for k in range(2)], [(0, 1)], [])
    own.objects.link(bpy.data.objects.new("mine", stick))
    node = [n for n in each.grass.modifiers[0].node_group.nodes if n.bl_idname == "GeometryNodeCollectionInfo"][0]
    node.inputs["Collection"].default_value = own
    each.seed = 4
    play(ground, images(folder, *blank()[:2]))
    assert grass.scattered(each.grass.modifiers[0].node_group) == own
    each.kind = "lawn"
    assert grass.scattered(each.grass.modifiers[0].node_group) == own
    # meshes of the user bend as one stem each
    each.kind = "carex"
    trail, lean, *_ = blank()
    lean[...] = (0.0, 1.0, 1.0, 1.0)
    play(ground, images(folder, trail, lean))
    bpy.context.scene.frame_set(1)
    mesh = each.grass.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    ends = compat.positions(mesh).reshape(-1, 2, 3)
    assert len(ends) == each.count and np.abs(ends[:, 0, 2]).max() < 0.003
    way, size = ends[:, 1] - ends[:, 0], compat.float_attribute(mesh, grass_tree.SIZE).reshape(-1, 2)[:, 0]
    np.testing.assert_allclose(np.linalg.norm(way, axis=1), 0.1 * size, rtol=0.1)
    assert way[:, 2].max() < 0.03 and np.median(way[:, 1] / size) > 0.08
