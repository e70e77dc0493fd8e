"""A picked object is the sole of every foot, and its tread shows in the print."""

import bpy
import mathutils
import numpy as np
from scenes import meshes, people

from desire_path.bake import bake
from desire_path.blender import sample
from desire_path.errors import DesirePathError
from desire_path.ground import maps

operator = bpy.ops.object
LUGS = 5  # bars across the sole, a bar and a gap of 3 cm each


def refused(call, *words):
    try:
        call()
    except (RuntimeError, DesirePathError) as problem:
        assert all(word in str(problem) for word in words), str(problem)
        return
    raise AssertionError("not refused")


def barred(depth=0.012, at=(0.0, 0.0, 0.0)):
    """A plate with bars across beneath, 11 cm wide; its bars repeat by a modifier."""
    box = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    co = (np.array((-0.055, -0.015, 0.0)) + box * (0.11, 0.03, depth)).tolist()
    mesh = bpy.data.meshes.new("Bar")
    mesh.from_pydata(co, [], faces)
    obj = meshes.link(bpy.data.objects.new("Bar", mesh))
    bars = obj.modifiers.new("Bars", "ARRAY")
    bars.count = LUGS
    bars.use_relative_offset, bars.use_constant_offset = False, True
    bars.constant_offset_displace = (0.0, -0.06, 0.0)
    obj.location = at
    bpy.context.view_layer.update()
    return obj


def corners(sole):
    """Corners of each face, whatever order they come in (n, 3, 3)."""
    return np.sort(sole.vertices[sole.triangles].astype(float), axis=1)


def standing():
    """A biped that stands still on a ground of 60 x 80 cm."""
    ground = meshes.grid(31, 41, 0.02, -0.3, -0.5)
    operator.desire_path_ground_add()
    obj = people.biped()
    obj.keyframe_insert("location", frame=1)
    obj.keyframe_insert("location", frame=24)
    operator.desire_path_walker_add()
    return ground, obj


def print_of(ground, folder):
    """compression (ny, nx) and its cells' x, y."""
    meshes.activate(ground)
    ground.desire_path.folder = str(folder)
    ground.desire_path.soil = "mud"
    ground.desire_path.cell_size = 0.005
    assert operator.desire_path_bake() == {"FINISHED"}
    index = bake.read_index(str(folder))
    found = maps.read(folder / "maps_final.exr").planes["compression"]
    ny, nx = found.shape
    return found, index.x0 + (np.arange(nx) + 0.5) * index.cell, index.y0 + (np.arange(ny) + 0.5) * index.cell


def test_a_tread_shows_in_the_print(folder):
    ground, obj = standing()
    plain, x, y = print_of(ground, folder / "plain")
    obj.desire_path.sole = barred(at=(0.10, 0.05, 0.0))
    worn, x, y = print_of(ground, folder / "worn")
    assert not [w for w in obj.users_scene if w.name.startswith("desire_path")]
    for side in (0.10, -0.10):
        along = worn[:, np.abs(x - side) < 0.03].mean(axis=1)
        bars = [along[np.abs(y - (0.05 - 0.06 * k)) < 0.008].mean() for k in range(LUGS)]
        gaps = [along[np.abs(y - (0.02 - 0.06 * k)) < 0.008].mean() for k in range(LUGS - 1)]
        assert min(bars[:-1]) > 0.002 and max(gaps) < 0.3 * min(bars[:-1]), (bars, gaps)
        bare = plain[:, np.abs(x - side) < 0.02].mean(axis=1)
        assert bare[np.abs(y + 0.04) < 0.06].min() > 0.3 * bare.max()
    # nothing is pressed where no bar is
    assert worn[:, np.abs(x) < 0.03].max() == 0.0


def test_it_is_the_same_sole_however_the_walker_stands():
    ground, obj = standing()
    scene = bpy.context.scene
    sole = barred(at=(-0.10, 0.05, 0.0))
    obj.desire_path.sole = sole
    before = sample.record(scene, obj, 1, 4)
    assert not [w for w in before.warnings if "sole" in w or "Bar" in w]
    for location, turn in (((3.0, 2.0, 0.5), 1.0), ((0.0, 0.0, 0.0), 0.4)):
        empty = meshes.link(bpy.data.objects.new("Carrier", None))
        obj.parent = sole.parent = empty
        empty.location, empty.rotation_euler = location, (0, 0, turn)
        bpy.context.view_layer.update()
        after = sample.record(scene, obj, 1, 4)
        for one, other in zip(before.soles, after.soles):
            assert corners(one).shape == corners(other).shape
            apart = np.linalg.norm(corners(one)[:, None] - corners(other), axis=(2, 3))
            assert apart.min(axis=0).max() < 1e-4 and apart.min(axis=1).max() < 1e-4
    # hung on a bone it is where the rest pose has it
    sole.parent, sole.parent_type, sole.parent_bone = obj, "BONE", "foot.R"
    sole.modifiers.clear()
    bpy.context.view_layer.update()
    sole.matrix_world = mathutils.Matrix.Translation((-0.10, -0.05, 0.0)) @ mathutils.Matrix.Diagonal(
        (1.0, 8.0, 1.0, 1.0)
    )
    bpy.context.view_layer.update()
    hung = sample.record(scene, obj, 1, 4)
    assert not [w for w in hung.warnings if "Bar" in w], hung.warnings
    obj.pose.bones["foot.R"].rotation_mode = "XYZ"
    obj.pose.bones["foot.R"].rotation_euler = (0.5, 0, 0)
    bpy.context.view_layer.update()
    for one, other in zip(hung.soles, sample.record(scene, obj, 1, 4).soles):
        np.testing.assert_allclose(one.vertices, other.vertices, atol=1e-5)
    # hidden, or in no scene: still the sole
    obj.parent = sole.parent = None
    sole.hide_viewport = sole.hide_render = True
    assert len(sample.record(scene, obj, 1, 4).soles[0].triangles)
    sole.hide_viewport = sole.hide_render = False
    scene.collection.objects.unlink(sole)
    assert len(sample.record(scene, obj, 1, 4).soles[0].triangles)
    assert not [s for s in bpy.data.scenes if s.name.startswith("desire_path")]


def test_what_is_no_sole():
    ground, obj = standing()
    scene = bpy.context.scene
    obj.desire_path.sole = meshes.link(bpy.data.objects.new("Nothing", None))
    refused(lambda: sample.record(scene, obj, 1, 4), "'Nothing'", "mesh")
    obj.desire_path.sole = meshes.link(bpy.data.objects.new("Bare", bpy.data.meshes.new("Bare")))
    refused(lambda: sample.record(scene, obj, 1, 4), "'Bare'", "no faces")
    far = barred(at=(5.0, 5.0, 5.0))
    obj.desire_path.sole = far
    assert any("'Bar' lies at no foot" in each for each in sample.record(scene, obj, 1, 4).warnings)
    bpy.data.objects.remove(far)
    assert obj.desire_path.sole is None
    assert len(sample.record(scene, obj, 1, 4).soles[0].triangles) > 50
