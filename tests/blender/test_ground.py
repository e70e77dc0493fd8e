"""Any mesh is ground, as it looks; walls, holes and broken meshes are refused in a sentence."""

import bpy
import numpy as np
from scenes import meshes
from test_playback import frames, index, play
from test_sample import ids, refused

from desire_path.blender import compat, ground, playback
from desire_path.ground.sim import Simulation
from desire_path.ground.soil import SOILS


def read(obj, cell=0.02, **more):
    return ground.read(bpy.context.scene, obj, cell, 1, **more)


def mesh_of(surface):
    """Vertices, triangles and weights as the core gets them."""
    return surface.ground.native[1:]


def test_world_metres():
    obj = meshes.grid(5, 4, 10.0)
    obj.location, obj.scale, obj.rotation_euler = (100, 0, 50), (2, 2, 1), (0, 0.3, 0)
    bpy.context.scene.unit_settings.scale_length = 0.01
    surface = read(obj)
    vertices, triangles, weights = mesh_of(surface)
    bpy.context.view_layer.update()
    wanted = [np.array(obj.matrix_world @ v.co) * 0.01 for v in obj.data.vertices]
    np.testing.assert_allclose(vertices, wanted, atol=1e-6)
    assert len(triangles) == 2 * 4 * 3 and weights is None
    assert surface.scale == 0.01


def test_modifiers_count_but_ours_does_not(folder):
    frames(folder)
    obj = meshes.grid(9, 9, 0.1)
    obj.modifiers.new("Fine", "SUBSURF").levels = 2
    obj.modifiers["Fine"].subdivision_type = "SIMPLE"
    lift = obj.modifiers.new("Lift", "DISPLACE")
    lift.strength, lift.mid_level, lift.direction = 0.25, 0.0, "Z"
    plain, _, _ = mesh_of(read(obj))
    assert len(plain) == 33 * 33
    np.testing.assert_allclose(plain[:, 2], 0.25, atol=1e-6)
    play(obj, folder, index())
    bpy.context.scene.frame_set(12)
    before = ids()
    again, _, _ = mesh_of(read(obj))
    assert again.tobytes() == plain.tobytes()
    assert ids() == before and playback.modifier(obj) is not None


def test_cells_meet_a_regular_mesh():
    obj = meshes.grid(40, 30, 0.02, 0.313, -7.77)
    surface = read(obj)
    assert not ground.smooth(surface.vertices, 0.02, surface.origin)
    coarse = meshes.grid(40, 30, 0.06, 0.313, -7.77)
    surface = read(coarse)
    assert not ground.smooth(surface.vertices, 0.02, surface.origin)
    odd = meshes.grid(40, 30, 0.0317)
    surface = read(odd)
    assert ground.smooth(surface.vertices, 0.02, surface.origin) and surface.origin == (0.0, 0.0)


def test_painted_soils_through_modifiers():
    obj = meshes.grid(11, 11, 0.1)
    obj.modifiers.new("Fine", "SUBSURF").levels = 1
    obj.modifiers["Fine"].render_levels = 1
    obj.modifiers["Fine"].subdivision_type = "SIMPLE"
    for name, low in (("snow", 0.35), ("mud", 0.75)):
        group = obj.vertex_groups.new(name=name)
        group.add([v.index for v in obj.data.vertices if v.co.x > low], 1.0, "REPLACE")
        each = obj.desire_path.painted.add()
        each.vertex_group, each.soil = name, name
    obj.vertex_groups["snow"].remove([v.index for v in obj.data.vertices if v.co.x > 0.75])
    before = ids()
    vertices, _, weights = mesh_of(read(obj))
    assert ids() == before and weights.shape == (3, 21 * 21)
    x = vertices[:, 0]
    winner = weights.argmax(axis=0)
    assert (winner[x < 0.32] == 0).all()
    assert (winner[(x > 0.38) & (x < 0.72)] == 1).all()
    assert (winner[x > 0.78] == 2).all()
    assert ground.soils(obj) == [SOILS[name] for name in ("dry-sand", "snow", "mud")]
    obj.desire_path.painted[0].vertex_group = "lost"
    refused(lambda: read(obj), "lost", "vertex group")
    assert ids() == before


def test_the_heaviest_paint_wins():
    """Weights above one half are the painted soil, those below leave the ground's own."""
    obj = meshes.grid(41, 4, 0.02, 0.01, 0.01)
    group = obj.vertex_groups.new(name="wet")
    for vertex in obj.data.vertices:
        group.add([vertex.index], vertex.co.x / 0.82, "REPLACE")
    each = obj.desire_path.painted.add()
    each.vertex_group, each.soil = "wet", "mud"
    sim = Simulation(read(obj).ground, ["soil", "mud"], 0.02)
    kind = sim.read("soil", 1, 1, 39, 1)[0]
    wet = (np.arange(1, 40) + 0.5) * 0.02 / 0.82
    sure = np.abs(wet - 0.5) > 0.03
    assert (kind[sure] == (wet[sure] > 0.5)).all(), kind


def test_a_hidden_ground_is_ground():
    obj = meshes.grid(5, 5, 0.1)
    plain, _, _ = mesh_of(read(obj))
    obj.hide_viewport = True
    hidden, _, _ = mesh_of(read(obj))
    assert hidden.tobytes() == plain.tobytes() and obj.hide_viewport


def test_refusals():
    before_scenes = len(bpy.data.scenes)
    refused(lambda: read(None), "ground")
    points = meshes.link(bpy.data.objects.new("Points", bpy.data.meshes.new("Points")))
    refused(lambda: read(points), "no faces", "Points")
    wall = meshes.grid(4, 4, 1.0, name="Wall")
    wall.rotation_euler.x = np.pi / 2
    refused(lambda: read(wall), "upright", "Wall")
    ceiling = meshes.grid(4, 4, 1.0, name="Ceiling")
    ceiling.rotation_euler.x = 2.5
    refused(lambda: read(ceiling), "normals", "Ceiling")
    broken = meshes.grid(4, 4, 1.0, name="Broken")
    for bad in (float("nan"), float("inf")):
        broken.data.vertices[7].co.z = bad
        refused(lambda: read(broken), "Vertex 7", "Broken")
    lost = meshes.grid(4, 4, 1.0, name="Lost")
    lost.location.x = float("inf")
    refused(lambda: read(lost), "NaN or infinite", "Lost")
    lost.location.x = 0.0
    lost.scale.z = 0.0
    refused(lambda: read(lost), "scale")
    line = meshes.grid(4, 4, 0.0, name="Line")
    refused(lambda: read(line), "no area")
    assert len(bpy.data.scenes) == before_scenes


def test_mirrored_ground_is_ground():
    obj = meshes.grid(4, 4, 1.0)
    obj.scale = (-1, 1, 1)
    vertices, _, _ = mesh_of(read(obj))
    assert vertices[:, 0].min() == -3.0


def test_moving_ground_is_read_where_it_lies_at_first():
    obj = meshes.grid(4, 4, 1.0)
    for frame, z in ((1, 0.0), (20, 1.0)):
        obj.location.z = z
        obj.keyframe_insert("location", frame=frame)
    surface = read(obj, frame_end=20)
    assert not surface.warnings  # who records the walk tells of it: test_ride.py
    assert compat.positions(obj.data)[:, 2].max() == 0.0
    np.testing.assert_allclose(mesh_of(surface)[0][:, 2], 0.0, atol=1e-6)


def area(surface):
    vertices, triangles, _ = mesh_of(surface)
    a, b, c = (vertices[triangles[:, k], :2] for k in range(3))
    return 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()


def polygons(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    return meshes.link(bpy.data.objects.new(name, mesh))


def test_faces_of_any_size():
    # a dented quad and a dented pentagon keep their area
    dart = polygons("Dart", [(0, 0, 0), (1, 1, 0), (0, 3, 0), (-1, 1, 0), (0, 2, 0)], [(0, 1, 4, 3)])
    assert abs(area(read(dart)) - 2.0) < 1e-6
    turned = polygons("Turned", [(0, 0, 0), (1, 1, 0), (0, 2, 0), (-1, 1, 0)], [(1, 2, 3, 0)])
    assert abs(area(read(turned)) - 2.0) < 1e-6
    dent = polygons("Dent", [(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 0.5, 0), (0, 2, 0)], [(0, 1, 2, 3, 4)])
    assert abs(area(read(dent)) - 2.5) < 1e-6
    mixed = polygons("Mixed", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)], [(0, 1, 2, 3), (1, 4, 2)])
    assert abs(area(read(mixed)) - 1.5) < 1e-6


def test_only_what_reaches_into_the_box():
    obj = meshes.grid(101, 101, 0.1)
    obj.location.x = 2.0
    part = read(obj, box=(3.05, 1.05, 4.02, 2.02))
    vertices, triangles, _ = mesh_of(part)
    assert len(triangles) == 2 * 11 * 11 and abs(vertices[:, 0].min() - 3.0) < 1e-5
    large = polygons("Large", [(-90, -90, 0), (90, -90, 0), (90, 90, 0), (-90, 90, 0)], [(0, 1, 2, 3)])
    assert len(mesh_of(read(large, box=(3, 3, 4, 4)))[1]) == 2
    refused(lambda: read(obj, box=(30, 1, 40, 2)), "beside the ground")
