"""Plants thinned by an image."""

import struct
import zlib

import bpy
import numpy as np
from scenes import exr, meshes
from test_bake import refused
from test_plants import CELL, GROWN, NX, NY, add, bed, blank, everything, images, known, paint, play, roots, share
from test_playback import fresh

from desire_path.blender import compat, grass, plants, playback, wiring

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
