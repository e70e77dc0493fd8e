"""Prints on any mesh: a copy that is fine along the trail is shown, the user's mesh stays as it is."""

import json
import types
from dataclasses import replace

import bpy
import numpy as np
from scenes import meshes, people
from test_bake import state

from desire_path import Gait, Ground, read_index
from desire_path.bake.bake import Bake, BakeOptions
from desire_path.blender import compat, cover, playback, playback_tree, refined, show
from desire_path.blender import ground as surface
from desire_path.blender import seen as detail
from desire_path.bounds import Limits
from desire_path.ground import maps, refine
from desire_path.study.trampling import WALK

LOW = 0.8  # of the deepest print at least is shown


def plane(side=6.0, cuts=0):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=cuts + 1, y_subdivisions=cuts + 1, size=side)
    return bpy.context.object


def baked(folder, ground, cell=0.02, frames=30, **settings):
    """A biped walks over a ground."""
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.cell_size, ground.desire_path.folder = cell, str(folder / "bake")
    for name, value in settings.items():
        setattr(ground.desire_path, name, value)
    walker = people.walk(people.biped(), frames=frames)
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    bpy.context.scene.frame_set(frames)
    return ground


def copy_of(ground):
    return playback_tree.copy_of(playback.modifier(ground).node_group)


def seen(ground):
    """The evaluated mesh."""
    bpy.context.view_layer.update()
    return ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data


def deepest(ground):
    return -compat.positions(seen(ground))[:, 2].min()


def shortest(mesh):
    """Length of the edges of which one in a hundred is shorter."""
    ends = np.empty(2 * len(mesh.edges), np.int32)
    mesh.edges.foreach_get("vertices", ends)
    at = compat.positions(mesh)[ends.reshape(-1, 2)].astype(float)
    return np.quantile(np.linalg.norm(at[:, 0] - at[:, 1], axis=1), 0.01)


def border(mesh):
    """Length of the edges that have one face."""
    edges = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("edge_index", edges)
    count = np.bincount(edges, minlength=len(mesh.edges))
    assert count.max() == 2
    ends = np.empty(2 * len(mesh.edges), np.int32)
    mesh.edges.foreach_get("vertices", ends)
    at = compat.positions(mesh)[ends.reshape(-1, 2)[count == 1]].astype(float)
    return np.linalg.norm(at[:, 0] - at[:, 1], axis=1).sum()


def test_four_points_show_prints_and_stay_four(folder):
    ground = plane()
    before = compat.positions(ground.data).copy()
    baked(folder, ground)
    pressed = json.loads(ground.desire_path.summary)["deepest_m"]
    assert deepest(ground) > LOW * pressed > 0.005
    assert np.array_equal(compat.positions(ground.data), before) and len(ground.data.polygons) == 1
    copy = copy_of(ground)
    assert copy.users_collection == () and copy.users == 1
    assert abs(border(copy.data) - 24.0) < 1e-4
    bpy.context.scene.frame_set(0)
    assert deepest(ground) < 1e-7
    bpy.ops.object.desire_path_free()
    assert len(seen(ground).vertices) == 4
    assert not [each for each in bpy.data.objects if each.name.startswith("Desire Path")]
    assert not [each for each in bpy.data.meshes if each.name.startswith("Desire Path")]


def test_a_mesh_that_is_fine_enough_is_shown_itself(folder):
    ground = plane(side=3.0, cuts=299)
    baked(folder, ground)
    assert copy_of(ground) is None and len(seen(ground).vertices) == 301**2


def test_it_can_be_switched_off_and_on(folder):
    ground = plane()
    baked(folder, ground)
    fine = len(seen(ground).vertices)
    ground.desire_path.refine = False
    assert len(seen(ground).vertices) == 4 and copy_of(ground) is None
    ground.desire_path.refine = True
    assert len(seen(ground).vertices) == fine
    ground.desire_path.refine_size = 0.2
    assert 4 < len(seen(ground).vertices) < 0.5 * fine
    assert sum(each.name.startswith("Desire Path") for each in bpy.data.objects) == 1


def test_a_cameras_pixels_say_how_fine(folder):
    ground = plane()
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, 0.0, 30.0)
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    baked(folder, ground)
    fine = len(seen(ground).vertices)
    ground.desire_path.refine_pixels = 4.0  # of 1920: some 0.045 m each at 30 m
    coarse = len(seen(ground).vertices)
    assert 4 < coarse < 0.5 * fine
    camera.location = (0.0, 0.0, 0.5)
    ground.desire_path.refine_pixels = 4.1
    assert len(seen(ground).vertices) > 1.5 * coarse


def test_what_lies_on_the_mesh_is_on_the_copy(folder):
    ground = plane(cuts=2)
    mesh = ground.data
    for slot in ("earth", "stone"):
        mesh.materials.append(bpy.data.materials.new(slot))
    for each in mesh.polygons:
        each.material_index = each.index % 2
    mine = mesh.attributes.new("mine", "FLOAT", "POINT")
    mine.data.foreach_set("value", compat.positions(mesh)[:, 0].copy())
    group = ground.vertex_groups.new(name="left")
    group.add([each.index for each in mesh.vertices if each.co.x < -0.5], 1.0, "REPLACE")
    mesh.edges[0].use_seam = True
    baked(folder, ground)
    copy = copy_of(ground).data
    at = compat.positions(copy)
    assert len(at) > 100
    assert np.allclose(compat.float_attribute(copy, "mine"), at[:, 0], atol=1e-5)
    corner = np.empty(len(copy.loops), np.int32)
    copy.loops.foreach_get("vertex_index", corner)
    uv = compat.uv(copy, copy.uv_layers.active.name)
    assert np.allclose(uv * 6.0 - 3.0, at[corner, :2], atol=1e-4)
    assert [each.name for each in copy.materials] == ["earth", "stone"]
    for each in copy.polygons:
        centre = each.center
        column, row = int((centre.x + 3.0) // 2.0), int((centre.y + 3.0) // 2.0)
        assert each.material_index == (3 * row + column) % 2
    seams = sum(each.use_seam for each in copy.edges)
    assert seams >= 1
    assert {"compression", "heap"} <= {each.name for each in copy.attributes}
    holder = copy_of(ground)
    weight = [sum(m.weight for m in v.groups) for v in copy.vertices]
    assert [each.name for each in holder.vertex_groups] == ["left"]
    assert np.abs(np.array(weight) - np.clip(-(at[:, 0] + 1.0) / 2.0 + 1.0, 0, 1)).max() < 0.51
    assert sum(weight) > 0.0


def test_a_bent_flat_shaded_ground_keeps_its_crease(folder):
    ground = plane(cuts=1)
    for each in ground.data.vertices:
        if each.co.x > 1.0:
            each.co.z = 0.5
    baked(folder, ground)
    copy = copy_of(ground).data
    sharp = [each for each in copy.edges if each.use_edge_sharp]
    assert sharp
    at = compat.positions(copy)
    for each in sharp:
        assert np.abs(at[list(each.vertices), 0]).max() < 1e-5


def test_what_is_asked_for_square_by_square_is_what_all_at_once_would(folder):
    ground = plane()
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    rng = np.random.default_rng(5)
    planes = {name: np.zeros((1100, 700), np.float32) for name in ("compression", "heap")}
    for j, i in rng.integers(0, (1080, 680), (400, 2)):  # some over the borders of squares
        planes["compression"][j : j + 20, i : i + 12] = rng.uniform(0.0, 6e-4, (min(20, 1100 - j), min(12, 700 - i)))
        planes["heap"][j, i : i + 15] = 0.02
    planes["compression"][505:520, 100:400] = 0.03
    planes["heap"][300:600, 508:515] = 0.03
    where = types.SimpleNamespace(cell=0.01, x0=3.3, y0=-2.7)
    changed = (planes["compression"] > 0.0) | (planes["heap"] > 0.0)
    settings = ground.desire_path
    for size in (0.0, 0.01):
        settings.detail_size = size
        fine = detail.fine(settings, planes, where.cell) if settings.detail_size else None
        wanted = refine.wishes(planes["heap"] - planes["compression"], changed, 0.01, (3.3, -2.7), 0.0, fine)
        found = refined.wishes(settings, planes, where)
        assert len(found.sizes) > 1000 and found.block == wanted.block
        assert found.corners.tobytes() == wanted.corners.tobytes() and found.sizes.tobytes() == wanted.sizes.tobytes()


def test_a_bake_whose_pictures_are_sparse_is_shown_as_another(folder):
    gait = replace(Gait.load(WALK).along([[0.0, 0.0], [4.0, 3.5]]), frame_rate=6.0)
    shown = []
    for limits in (Limits(), Limits(cells=300_000)):
        place, options = folder / f"{limits.cells:.0f}", BakeOptions(threads=2, limits=limits)
        for _ in Bake(gait, Ground.flat(), "mud", place, cell_size=0.01, options=options).run():
            pass
        index = read_index(place)
        ground = plane(12.0)
        meshes.activate(ground)
        bpy.ops.object.desire_path_ground_add()
        ground.desire_path.folder, ground.desire_path.cell_size = str(place), 0.01
        show.play(bpy.context.scene, ground, surface.read(bpy.context.scene, ground, 0.01, index.frame_start))
        for frame in (index.frame_start + index.frames // 2, index.frame_end):
            bpy.context.scene.frame_set(frame)
            mesh = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            shown.append(compat.positions(mesh).copy())
    assert index.atlas is not None and cover.is_plain(place / "maps_final.exr")
    maps.write(folder / "more.exr", {"compression": np.zeros((1, 1)), "surface_mud": np.zeros((1, 1))})
    assert not cover.is_plain(folder / "more.exr")
    for dense, sparse in zip(shown[:2], shown[2:]):
        assert dense[:, 2].min() < -0.01 and len(dense) > 10_000
        assert dense.shape == sparse.shape
        np.testing.assert_allclose(sparse, dense, atol=2e-5)


def test_the_file_has_it(folder):
    ground = baked(folder, plane())
    count = len(seen(ground).vertices)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    ground = bpy.data.objects["Grid"]
    assert len(seen(ground).vertices) == count


def test_modifiers_before_ours_are_in_it(folder):
    ground = plane(cuts=3)
    ground.modifiers.new("Rough", "SUBSURF").render_levels = 2
    ground.modifiers["Rough"].levels = 2
    baked(folder, ground)
    assert copy_of(ground) is not None
    assert len(copy_of(ground).data.vertices) > 17**2
    untouched = state(ground)
    ground.desire_path.refine = False
    assert state(ground)[:2] == untouched[:2]


def test_hair_instances_and_children_keep_the_points_they_stand_on(folder):
    for number, what in enumerate(("hair", "instances", "child", "scatter", "time", "hook", "shape keys")):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        ground = plane(cuts=3)
        if what == "hair":
            ground.modifiers.new("Hair", "PARTICLE_SYSTEM")
        elif what == "instances":
            ground.instance_type = "VERTS"
        elif what == "child":
            child = bpy.data.objects.new("Flag", None)
            bpy.context.scene.collection.objects.link(child)
            child.parent, child.parent_type, child.parent_vertices = ground, "VERTEX", (3, 0, 0)
        elif what == "scatter":
            tree = compat.geometry_tree("Scatter", bpy.data.node_groups.new)
            here, there = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
            points = tree.nodes.new("GeometryNodeDistributePointsOnFaces")
            on, cube = tree.nodes.new("GeometryNodeInstanceOnPoints"), tree.nodes.new("GeometryNodeMeshCube")
            cube.inputs["Size"].default_value = (0.01, 0.01, 0.01)
            tree.links.new(points.outputs[0], on.inputs[0])
            tree.links.new(cube.outputs[0], on.inputs["Instance"])
            join = tree.nodes.new("GeometryNodeJoinGeometry")
            tree.links.new(here.outputs[0], points.inputs[0])
            tree.links.new(here.outputs[0], join.inputs[0])
            tree.links.new(on.outputs[0], join.inputs[0])
            tree.links.new(join.outputs[0], there.inputs[0])
            compat.nodes_modifier(ground, "Scatter", tree)
        elif what == "time":
            tree = compat.geometry_tree("Time", bpy.data.node_groups.new)
            here, there = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
            now, move = tree.nodes.new("GeometryNodeInputSceneTime"), tree.nodes.new("GeometryNodeSetPosition")
            tree.links.new(here.outputs[0], move.inputs[0])
            tree.links.new(now.outputs["Seconds"], move.inputs["Offset"])
            tree.links.new(move.outputs[0], there.inputs[0])
            compat.nodes_modifier(ground, "Time", tree)
        elif what == "hook":
            hook = bpy.data.objects.new("Hook", None)
            bpy.context.scene.collection.objects.link(hook)
            hook.keyframe_insert("location", frame=1)
            hook.location.z = 1.0
            hook.keyframe_insert("location", frame=20)
            ground.modifiers.new("Hook", "HOOK").object = hook
        else:
            ground.shape_key_add(name="Basis")
            ground.shape_key_add(name="Wave")
        baked(folder / str(number), ground, frames=12)
        assert copy_of(ground) is None, what
        assert "is not refined" in ground.desire_path.summary, what


def test_the_copy_follows_materials_and_edits(folder):
    ground = plane(cuts=1)
    ground.data.materials.append(bpy.data.materials.new("earth"))
    baked(folder, ground, frames=12)
    bpy.context.view_layer.update()
    ground.data.materials[0] = bpy.data.materials.new("clay")
    ground.data.update_tag()
    bpy.context.view_layer.update()
    assert copy_of(ground).data.materials[0].name == "clay"
    for each in ground.data.vertices:
        each.co.z += 0.25
    ground.data.update_tag()
    bpy.context.view_layer.update()
    assert compat.positions(copy_of(ground).data)[:, 2].min() > 0.2


def test_a_bake_from_before_is_shown_as_it_was(folder):
    ground = plane(side=3.0, cuts=60)
    ground.desire_path.refine = False
    baked(folder, ground, frames=12)
    del playback.modifier(ground).node_group[playback.WISHES]
    ground.desire_path.refine = True
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    ground = bpy.data.objects["Grid"]
    bpy.context.view_layer.update()
    assert copy_of(ground) is None and len(seen(ground).vertices) == 62**2


def test_a_copy_whose_ground_was_shaped_otherwise_since_is_outdated(folder):
    ground = plane(cuts=3)
    shape = ground.modifiers.new("Raised", "DISPLACE")
    shape.strength, shape.mid_level = 0.1, 0.0
    baked(folder, ground)
    assert copy_of(ground) is not None and ground.desire_path.bake_state == "FRESH"
    shape.strength = 0.3
    bpy.context.view_layer.update()
    assert ground.desire_path.bake_state == "OUTDATED" and "ground" in ground.desire_path.missing


def test_applied_it_leaves_nothing_behind(folder):
    ground = baked(folder, plane())
    fine = len(seen(ground).vertices)
    bpy.ops.object.modifier_apply(modifier=playback.modifier(ground).name)
    bpy.context.view_layer.update()
    assert len(ground.data.vertices) == fine and deepest(ground) > 0.005
    for kind in ("objects", "meshes", "node_groups", "images"):
        assert not [each.name for each in getattr(bpy.data, kind) if each.name.lower().startswith("desire")], kind


def test_a_panorama_has_pixels_too():
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 2000, 1000, 100
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "PANO"
    lens = camera.data if hasattr(camera.data, "panorama_type") else camera.data.cycles
    lens.panorama_type = "EQUIRECTANGULAR"
    wide = refined.pixel(scene, camera, np.array([1.0, 10.0]))
    assert np.allclose(wide, np.array([1.0, 10.0]) * np.pi / 1000)
    lens.panorama_type = "FISHEYE_EQUIDISTANT"
    lens.fisheye_fov = np.pi / 2
    assert np.allclose(refined.pixel(scene, camera, np.array([2.0])), 2.0 * np.pi / 2 / 2000, rtol=1e-5)
