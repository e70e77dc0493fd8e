"""The maps of a bake as Blender's own image: layers by name, or a picture, and the bits of the grid, MODEL 11.14."""

import bpy
import numpy as np
from test_bake import scene

from desire_path.ground import maps


def opened(path):
    """The file as an image that has been looked at."""
    image = bpy.data.images.load(str(path))
    len(image.pixels)  # only now Blender reads the file, and knows what it is
    return image


def layers(image, shape, folder):
    """What the compositor makes of every layer of an image, by name: float32 (ny, nx)."""
    world = bpy.context.scene
    world.render.resolution_y, world.render.resolution_x = shape
    world.render.resolution_percentage = 100
    if hasattr(world, "compositing_node_group"):
        tree = world.compositing_node_group = bpy.data.node_groups.new("layers", "CompositorNodeTree")
    else:
        world.use_nodes = True
        tree = world.node_tree
    tree.nodes.clear()
    source = tree.nodes.new("CompositorNodeImage")
    source.image = image
    found = {}
    for socket in source.outputs:
        place = folder / socket.name
        place.mkdir(parents=True)
        leave = tree.nodes.new("CompositorNodeOutputFile")
        if hasattr(leave, "base_path"):
            leave.base_path = str(place)
            composite = tree.nodes.new("CompositorNodeComposite")
            tree.links.new(socket, composite.inputs[0])
        else:
            leave.directory = str(place)
            leave.file_output_items.new("FLOAT", "layer")
            leave.format.media_type = "IMAGE"
        leave.format.file_format = "OPEN_EXR"
        leave.format.color_depth = "32"
        tree.links.new(socket, leave.inputs[0])
    assert bpy.ops.render.render() == {"FINISHED"}
    for socket in source.outputs:
        (written,) = (folder / socket.name).glob("*.exr")
        found[socket.name] = maps.read(written).planes["R"]
    return found


def test_maps_open_as_layers_with_the_bits_of_the_grid(folder):
    scene(folder, frames=12, height=lambda x, y: 0.1 + 0.02 * x)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    path = folder / "bake" / "maps_final.exr"
    grid = maps.read(path).planes
    image = opened(path)
    assert image.type == "MULTILAYER", image.type
    found = layers(image, grid["rest"].shape, folder / "layers")
    assert set(found) == set(grid), set(found) ^ set(grid)
    for layer, plane in grid.items():
        assert np.array_equal(found[layer], plane, equal_nan=True), layer


def test_the_first_map_is_a_picture(folder):
    """A script has its pixels, which layers have not: R the modulus, G the plants, B what was trodden before."""
    rig, ground = scene(folder, frames=12)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    path = folder / "bake" / "maps_start.exr"
    start = maps.read(path)
    image = opened(path)
    assert image.type == "IMAGE", image.type
    pixels = np.array(image.pixels[:], np.float32).reshape(*start.shape, 4)
    for number, plane in enumerate(("young_modulus_in", "plant_strength_in")):
        assert np.array_equal(pixels[..., number], start.planes[plane]), plane
    assert start.planes["young_modulus_in"].max() > 1e5 and not pixels[..., 2].any()
