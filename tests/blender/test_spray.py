"""What flies over a ground, as points: as many as the bake says, where it says, without this add-on too."""

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused
from test_plants import everything
from test_playback import fresh
from test_solid import ball, key, sand

from desire_path.bake.bake import read_index
from desire_path.blender import compat, sprays
from desire_path.ground import spray

COUNTS = """
import sys
import bpy
path, count = sys.argv[-2:]
bpy.ops.wm.open_mainfile(filepath=path)
bpy.context.scene.frame_set(15)
graph = bpy.context.evaluated_depsgraph_get()
found = [len(each.object.data.points) for each in graph.object_instances if each.object.type == "POINTCLOUD"]
assert found == [int(count)], found
"""


def kicked(folder):
    """A ball that ploughs through a ground and is swung up out of it."""
    ground = sand(folder, cell=0.02)
    ground.desire_path.spray, ground.desire_path.frame_end = "SAND", 24
    body = ball()
    meshes.activate(body)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    body.desire_path.ground, body.desire_path.contact_law = ground, "CARVE"
    key(body, 1, location=(-0.8, 0.0, 0.15))
    key(body, 9, location=(0.0, 0.0, 0.15))
    key(body, 14, location=(1.2, 0.0, 0.9))
    key(body, 24, location=(1.3, 0.0, 1.0))
    meshes.activate(ground)
    return ground


def points(obj, frame):
    """(position in the world, velocity, radius) of the points an object shows at a frame."""
    bpy.context.scene.frame_set(frame)
    graph = bpy.context.evaluated_depsgraph_get()
    shown = obj.evaluated_get(graph)
    for each in graph.object_instances:
        if each.object.original == obj and each.object.type == "POINTCLOUD":
            cloud, world = each.object.data, np.array(each.matrix_world)
            break
    else:
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
    del shown
    found = {}
    for name, wide, kind in (("position", 3, "vector"), (sprays.VELOCITY, 3, "vector"), ("radius", 1, "value")):
        value = np.zeros(len(cloud.points) * wide, np.float32)
        cloud.attributes[name].data.foreach_get(kind, value)
        found[name] = value.reshape(-1, wide)
    at = found["position"].astype(float) @ world[:3, :3].T + world[:3, 3]
    return at, found[sprays.VELOCITY], found["radius"][:, 0]


def volumes_hold_the_ledger(folder, index):
    """Voxels sum to what is in the air, in a Blender that knows volumes; else it is told."""
    export = bpy.ops.wm.desire_path_export
    try:
        with compat.bundled_modules():
            import openvdb
    except ImportError:
        refused(export, "openvdb", format="VDB", filepath=str(folder / "trail.vdb"))
        return
    refused(export, "ends with .vdb", format="VDB", filepath=str(folder / "trail.png"))
    assert export(format="VDB", filepath=str(folder / "trail.vdb")) == {"FINISHED"}
    assert sorted(each.name for each in folder.glob("*.vdb*")) == [f"trail_{n:04d}.vdb" for n in range(1, 25)]
    for frame in (1, 14, 17):
        grid = openvdb.read(str(folder / f"trail_{frame:04d}.vdb"), "density")
        size = grid.transform.voxelSize()[0]
        filled = sum(each.value for each in grid.citerOnValues()) * size**3
        wanted = len(spray.read_frame(index.spray_path(frame))) * np.pi / 6.0 * index.grain_size**3
        np.testing.assert_allclose(filled, wanted, rtol=1e-5)


def test_points_are_where_the_bake_says(folder):
    ground = kicked(folder)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    index = read_index(str(folder / "bake"))
    obj = ground.desire_path.spray_object
    assert obj.name == "Ground Spray" and obj.parent == ground and len(obj.data.vertices) == index.most_grains() > 300
    seen = 0
    for frame in (1, 12, 14, 17, 20):
        grains = spray.read_frame(index.spray_path(frame))
        at, velocity, radius = points(obj, frame)
        assert len(at) == len(grains)
        seen += len(at)
        np.testing.assert_allclose(at, grains.position, atol=1e-5)
        np.testing.assert_allclose(velocity, grains.velocity, atol=1e-5)
        if len(at):
            assert 0.2 * index.grain_size < radius.min() < radius.max() < 0.7 * index.grain_size
    assert seen > 500
    # a farm without the add-on shows as many
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "farm.blend"))
    here = len(points(obj, 15)[0])
    assert here > 50
    fresh(COUNTS, folder / "farm.blend", here)
    volumes_hold_the_ledger(folder, index)
    # another spray would be another bake
    assert ground.desire_path.bake_state == "FRESH"
    ground.desire_path.spray = "MUD"
    assert ground.desire_path.bake_state == "OUTDATED"
    # points go along where the ground is moved
    before = points(obj, 16)[0]
    ground.location.z += 2.0
    np.testing.assert_allclose(points(obj, 16)[0], before + [0.0, 0.0, 2.0], atol=1e-5)


def test_free_and_bake_again_leave_nothing_and_keep_the_material(folder):
    ground = kicked(folder)
    have = everything()
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    mine = bpy.data.materials.new("Mine")
    tree = ground.desire_path.spray_object.modifiers[0].node_group
    (node,) = (each for each in tree.nodes if each.bl_idname == "GeometryNodeSetMaterial")
    node.inputs["Material"].default_value = mine
    ground.desire_path.spray_amount = 2.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    tree = ground.desire_path.spray_object.modifiers[0].node_group
    (node,) = (each for each in tree.nodes if each.bl_idname == "GeometryNodeSetMaterial")
    assert node.inputs["Material"].default_value == mine
    assert sum("Spray" in each.name for each in bpy.data.objects) == 1
    ground.desire_path.spray = "NONE"
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert ground.desire_path.spray_object is None and not read_index(str(folder / "bake")).grain_size
    assert bpy.ops.object.desire_path_free() == {"FINISHED"}
    bpy.data.materials.remove(mine)
    for each in [each for each in bpy.data.materials if each.name.startswith(sprays.MODIFIER)]:
        bpy.data.materials.remove(each)
    assert everything() == have and ground.desire_path.spray_object is None
    assert not [path for path in (folder / "bake").rglob("*") if path.is_file()]
