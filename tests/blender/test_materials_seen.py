"""What a material shows in a rendered picture."""

import bpy
import numpy as np
from scenes import meshes
from test_materials import SIZE, bake_by_hand, counts, ground, make, two_halves
from test_plants import add as plant

from desire_path.blender import compat, looks, playback_tree


def _lit():
    """The scene, seen from straight above in even light."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 0.19, (0.0, 0.0, 1.0)
    scene.collection.objects.link(camera)
    world = bpy.data.worlds.new("World")
    if not world.use_nodes:
        world.use_nodes = True
    world.node_tree.nodes.clear()
    light = world.node_tree.nodes.new("ShaderNodeBackground")
    leave = world.node_tree.nodes.new("ShaderNodeOutputWorld")
    world.node_tree.links.new(light.outputs[0], leave.inputs[0])
    light.inputs[0].default_value = (1.0, 1.0, 1.0, 1.0)
    scene.world, scene.camera = world, camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 16, False, 1
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    return scene


def rendered(folder, name="picture"):
    """Its picture, light in (rows, columns, 3), row 0 below."""
    scene = _lit()
    scene.render.filepath = str(folder / name)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(folder / f"{name}.exr"))
    pixels = np.empty(SIZE * SIZE * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(SIZE, SIZE, 4)[..., :3]


def halves(folder, name="picture"):
    """Mean colours of the half that lies as it was and of the other one."""
    seen = rendered(folder, name)
    return seen[: SIZE // 2 - 1].mean(axis=(0, 1)), seen[SIZE // 2 + 1 :].mean(axis=(0, 1))


def test_pressed_ground_is_seen_in_a_picture(folder):
    for kind in ("SAND", "EARTH", "SNOW", "GRASS"):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        obj = two_halves(ground())
        bake_by_hand(obj, 0.03)
        make(obj, kind=kind)
        level, pressed = halves(folder, kind)
        assert (level > 0.005).all(), kind
        darker = pressed.mean() / level.mean()
        if kind == "GRASS":  # the earth below it shows, which is no green
            assert level[1] > level[0] and pressed[0] > pressed[1]
        else:
            assert darker < (0.97 if kind == "SNOW" else 0.85), (kind, darker)


def glowing(obj, output):
    """Let an object glow by what the group of its material says."""
    tree = make(obj).node_tree
    group, leave = (
        next(n for n in tree.nodes if n.bl_idname == f"ShaderNode{kind}") for kind in ("Group", "OutputMaterial")
    )
    tree.links.new(group.outputs[output], leave.inputs["Surface"])


def test_mud_shines_where_it_was_pressed_and_where_it_slid_back(folder):
    for heap in (0.0, 0.010):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        obj = two_halves(ground("mud"))
        bake_by_hand(obj, 0.03, heap)
        for output, most in (("Roughness", 0.6), ("Color", 0.8)):
            glowing(obj, output)
            level, pressed = halves(folder, f"{output}_{heap}")
            assert 0.0 < pressed.mean() < most * level.mean(), (output, heap)


def test_crusts_crack_where_they_are_lifted(folder):
    for soil, lifted in (("crust-snow", 0.003), ("packed-earth", 0.002)):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        obj = two_halves(ground(soil))
        glowing(obj, "Color")
        whole = rendered(folder, soil)
        bake_by_hand(obj, 0.0, lifted)
        darker = rendered(folder, f"{soil}_lifted") < 0.9 * whole
        assert not darker[: SIZE // 2 - 1].any(), soil
        cracked = darker[SIZE // 2 + 1 :].all(axis=2).mean()
        assert 0.005 < cracked < 0.5, (soil, cracked)  # plates lie between


def test_crumbs_end_where_they_meet(folder):
    """A step between two is a straight scratch once light falls on it."""
    obj = two_halves(ground("soil"))
    tree = make(obj).node_tree
    n = looks.Shade(tree)
    place = n.add("ShaderNodeTexCoord").outputs["Object"]
    leave = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeOutputMaterial")
    for away in (0.0, 1.8, 2.2):
        moved = n.vector("ADD", place, (away, 0.0, 0.0))
        tree.links.new(n.crumbs(moved, 4.0), leave.inputs["Surface"])  # it glows by how high they are
        high = rendered(folder, f"{away}")[..., 0]
        assert max(np.abs(np.diff(high, axis=axis)).max() for axis in (0, 1)) < 0.25, away


def test_without_a_bake_it_is_as_nobody_walked(folder):
    obj = two_halves(ground("mud"))
    make(obj)
    first, second = halves(folder)
    assert np.allclose(first, second, rtol=0.25)


def test_painted_soils_lie_where_they_are_painted(folder):
    obj = two_halves(ground("soil"))
    group = obj.vertex_groups.new(name="drift")
    group.add([4, 5, 6, 7], 1.0, "REPLACE")
    each = obj.desire_path.painted.add()
    each.vertex_group, each.soil = "drift", "snow"
    make(obj)
    name = looks.SHARE.format("snow")
    assert compat.float_attribute(obj.data, name).tolist() == [0, 0, 0, 0, 1, 1, 1, 1]
    earth, snow = halves(folder)
    assert earth.max() < 0.2 and snow.min() > 0.5
    # painted anew: pressed again, the material follows
    group.add([4, 5, 6, 7], 0.0, "REPLACE")
    make(obj)
    assert not compat.float_attribute(obj.data, name).any() and counts()["materials"] == 1


def test_plants_stand_before_and_after_a_bake(folder):
    obj = meshes.grid(9, 9, 0.05, -0.2, -0.2)
    bpy.ops.object.desire_path_ground_add()
    obj.desire_path.soil = "soil"
    plant(obj, "carex", density=200.0)
    make(obj)
    assert "Grass" in obj.material_slots[0].material.name
    grown = compat.float_attribute(obj.data, playback_tree.STRENGTH)
    assert grown.min() > 0.3 and obj.desire_path.made_attributes == playback_tree.STRENGTH
    seen = rendered(folder).mean(axis=(0, 1))
    assert seen[1] > seen[0]
