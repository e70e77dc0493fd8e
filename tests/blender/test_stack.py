"""Our modifier goes after what shapes the ground and before what stands on it, and speaks truly of what is seen."""

import bpy
import numpy as np
from scenes import meshes, people
from test_ground import mesh_of, read
from test_sample import ids

from desire_path.blender import compat, ground, playback_tree, stack, wiring

operator = bpy.ops.object


# ---- node trees that people put on their grounds ------------------------------------------------------


def tree_of(obj, name, build):
    """A nodes modifier; build: wire and geometry -> geometry."""
    tree = compat.geometry_tree(name, bpy.data.node_groups.new)
    wire = wiring.Wiring(tree)
    out = build(wire, wire.add("NodeGroupInput").outputs[0])
    tree.links.new(out, tree.nodes.new("NodeGroupOutput").inputs[0])
    return compat.nodes_modifier(obj, name, tree)


def joined(wire, *parts):
    node = wire.add("GeometryNodeJoinGeometry")
    for part in parts:
        wire.tree.links.new(part, node.inputs[0])
    return node.outputs[0]


def stones(wire, geometry, density=300.0):
    stone = wire.add("GeometryNodeMeshCube", Size=(0.01, 0.01, 0.01)).outputs[0]
    points = wire.add("GeometryNodeDistributePointsOnFaces", Mesh=geometry, Density=density).outputs["Points"]
    return wire.add("GeometryNodeInstanceOnPoints", Points=points, Instance=stone).outputs[0]


def scatter(wire, geometry):
    return joined(wire, geometry, stones(wire, geometry))


def real_scatter(wire, geometry):
    return joined(wire, wire.add("GeometryNodeRealizeInstances", Geometry=stones(wire, geometry)).outputs[0], geometry)


def scatter_around(wire, geometry):
    """Real stones before the ground's own points and after them."""
    real = [
        wire.add("GeometryNodeRealizeInstances", Geometry=stones(wire, geometry, density)).outputs[0]
        for density in (100.0, 200.0)
    ]
    return joined(wire, real[0], geometry, real[1])


def subdivided(wire, geometry):
    """Its points stay where they are, and more lie between them."""
    return wire.add("GeometryNodeSubdivideMesh", Mesh=geometry, Level=1).outputs[0]


def raised(wire, geometry):
    return wire.add("GeometryNodeSetPosition", Geometry=geometry, Offset=(0.0, 0.0, 0.5)).outputs[0]


def raised_and_scattered(wire, geometry):
    return scatter(wire, raised(wire, geometry))


def twice(wire, geometry):
    beside = wire.add("GeometryNodeTransform", Geometry=geometry, Translation=(3.0, 0.0, 0.0)).outputs[0]
    return joined(wire, geometry, beside)


def tiled(wire, geometry):
    """Only instances of what comes in, in a row of three."""
    points = wire.add("GeometryNodeMeshLine", Count=3, Offset=(1.0, 0.0, 0.0)).outputs[0]
    points = compat.socket(wire.tree.nodes[-1].outputs, "Mesh") or points
    return wire.add("GeometryNodeInstanceOnPoints", Points=points, Instance=geometry).outputs[0]


def coloured(wire, geometry):
    return wire.store(geometry, "wet", 1.0)


def place(obj):
    return stack.find(bpy.context.scene, obj, 1)


def test_what_nodes_do_is_seen():
    before = ids()
    for build, wanted in (
        (scatter, (0, False, False)),
        (real_scatter, (0, False, False)),
        (scatter_around, (0, False, False)),
        (subdivided, (1, False, False)),
        (raised, (1, False, False)),
        (raised_and_scattered, (1, False, True)),
        (twice, (1, False, False)),
        (tiled, (1, True, False)),
        (coloured, (1, False, False)),
    ):
        obj = meshes.grid(21, 21, 0.1)
        tree = tree_of(obj, build.__name__, build).node_group
        found = place(obj)
        assert (found.before, found.realise, found.scattered) == wanted, (build.__name__, found)
        assert not found.warnings
        mesh = obj.data
        bpy.data.objects.remove(obj)
        bpy.data.node_groups.remove(tree)
        bpy.data.meshes.remove(mesh)
    assert ids() == before


def test_what_stands_on_it_comes_after():
    obj = meshes.grid(21, 21, 0.1)
    kinds = ("SOLIDIFY", "PARTICLE_SYSTEM", "COLLISION")
    for kind in kinds:
        obj.modifiers.new(kind, kind)
    tree_of(obj, "stones", scatter)
    assert place(obj).before == 1 and not place(obj).warnings
    assert len(mesh_of(read(obj))[0]) == 2 * 21 * 21  # the solid slab without stones
    obj.modifiers.new("Fine", "SUBSURF")  # comes last, so that hair above it cannot follow
    found = place(obj)
    assert found.before == 5 and len(found.warnings) == 1
    assert "'PARTICLE_SYSTEM'" in found.warnings[0] and "'Fine'" in found.warnings[0]
    assert found.warnings[0] in read(obj).warnings


def test_a_modifier_that_is_off_shapes_nothing():
    obj = meshes.grid(21, 21, 0.1)
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    lift = obj.modifiers.new("Lift", "DISPLACE")
    lift.mid_level, lift.direction = 0.0, "Z"
    lift.show_viewport = lift.show_render = False
    assert place(obj).before == 0
    lift.show_render = True  # seen in renders alone: it counts
    assert place(obj).before == 2
    np.testing.assert_allclose(mesh_of(read(obj))[0][:, 2], 1.0)
    lift.show_render, lift.show_viewport = False, True
    np.testing.assert_allclose(mesh_of(read(obj))[0][:, 2], 0.0)


def test_nodes_that_are_switched_shape_as_they_do_first():
    scene = bpy.context.scene
    obj = meshes.grid(21, 21, 0.1)
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    switch = tree_of(obj, "Switched", raised)
    for frame, on in ((1, True), (10, False)):
        switch.show_render = on
        switch.keyframe_insert("show_render", frame=frame)
    for shown in (1, 20):
        scene.frame_set(shown)
        assert stack.find(scene, obj, 1).before == 2, shown  # the tree shapes the ground: hair cannot follow
        assert stack.find(scene, obj, 20).before == 0, shown  # and does nothing there


# ---- the whole way ------------------------------------------------------------------------------------


def test_modifiers_that_are_switched_are_as_renders_have_them_first():
    """Whatever frame is shown; that they are switched in between is told."""
    scene = bpy.context.scene
    for way in ("keys", "driver", "strip", "levels"):
        obj = meshes.grid(20, 20, 0.1, name=way)
        if way == "levels":
            fine = obj.modifiers.new("Fine", "SUBSURF")
            fine.subdivision_type = "SIMPLE"
            path, values = 'modifiers["Fine"].render_levels', (1, 0)
        else:
            rise = obj.modifiers.new("Rise", "DISPLACE")
            rise.strength, rise.mid_level, rise.direction = 0.05, 0.0, "Z"
            path, values = 'modifiers["Rise"].show_render', (True, False)
        if way == "driver":
            obj.driver_add(path).driver.expression = "frame < 10"
        for frame, value in ((1, values[0]), (10, values[1])) if way != "driver" else ():
            owner, name = obj.modifiers[0], path.rsplit(".", 1)[1]
            setattr(owner, name, value)
            obj.keyframe_insert(path, frame=frame)
            if way == "keys":
                owner.show_viewport = value
                obj.keyframe_insert(path.replace("render", "viewport"), frame=frame)
        if way == "strip":
            animation = obj.animation_data
            strip = animation.nla_tracks.new().strips.new("switch", 1, animation.action)
            if hasattr(strip, "action_slot"):
                strip.action_slot = animation.action_slot
            animation.action = None
        marks = set()
        for shown_frame in (1, 20):
            scene.frame_set(shown_frame)
            surface = ground.read(scene, obj, 0.02, 1, 20)
            marks.add(surface.mark)
            assert len(surface.vertices) == (39 * 39 if way == "levels" else 400), (way, shown_frame)
            assert way == "levels" or np.allclose(surface.vertices[:, 2], 0.05), (way, shown_frame)
            assert any("changes between the frames" in each for each in surface.warnings), (way, shown_frame)
            assert scene.frame_current == shown_frame
        assert len(marks) == 1, way


def test_shapes_that_a_scene_leads_or_that_come_and_go_are_told():
    """Whatever frame is shown: a shape key and a modifier that follow a property of the scene, a bump of six frames."""
    scene = bpy.context.scene
    scene["tide"] = 0.0
    for frame, value in ((1, 0.5), (86, 1.0)):
        scene["tide"] = value
        scene.keyframe_insert('["tide"]', frame=frame)

    def lead(owner, name):
        driver = owner.driver_add(name).driver
        variable = driver.variables.new()
        variable.targets[0].id_type, variable.targets[0].id = "SCENE", scene
        variable.targets[0].data_path, driver.expression = '["tide"]', variable.name

    for way in ("key", "modifier", "pulse"):
        obj = meshes.grid(20, 20, 0.1, name=way)
        if way == "modifier":
            rise = obj.modifiers.new("Rise", "DISPLACE")
            rise.direction, rise.mid_level = "Z", 0.0
            lead(rise, "strength")
        else:
            obj.shape_key_add(name="Basis")
            up = obj.shape_key_add(name="Up")
            for k, point in enumerate(up.data):
                point.co.z += 0.1 * (k % 2)
            if way == "key":
                lead(up, "value")
            for frame, value in ((1, 0.0), (60, 0.0), (63, 1.0), (66, 0.0), (86, 0.0)) if way == "pulse" else ():
                up.value = value
                up.keyframe_insert("value", frame=frame)
        surfaces = []
        for shown_frame in (1, 40):
            scene.frame_set(shown_frame)
            surfaces.append(ground.read(scene, obj, 0.02, 1, 86))
            assert any("changes between the frames" in each for each in surfaces[-1].warnings), (way, shown_frame)
            assert scene.frame_current == shown_frame and len(scene.collection.objects) == len(scene.objects)
        assert surfaces[0].mark == surfaces[1].mark, way


def trodden(ground, folder, cell=0.02, frames=30):
    """A biped walks over a ground; returns its sentences."""
    meshes.activate(ground)
    operator.desire_path_ground_add()
    settings = ground.desire_path
    settings.cell_size, settings.folder = cell, str(folder / "bake")
    walker = people.walk(people.biped(), frames=frames)
    meshes.activate(walker)
    operator.desire_path_walker_add()
    meshes.activate(ground)
    assert operator.desire_path_bake() == {"FINISHED"}
    return settings.summary


def strip(spacing=0.02):
    return meshes.grid(round(1.2 / spacing), round(2.6 / spacing), spacing, -0.6, -2.2)


def shown(ground, frame=30):
    bpy.context.scene.frame_set(frame)
    return ground.evaluated_get(bpy.context.evaluated_depsgraph_get())


def deepest(ground):
    found = shown(ground)
    return float(compat.positions(found.data)[:, 2].min()) * found.matrix_world[2][2]


def test_hair_goes_down_with_the_ground(folder):
    ground = strip()
    ground.modifiers.new("Hair", "PARTICLE_SYSTEM")
    hair = ground.particle_systems[0].settings
    hair.type, hair.count, hair.use_modifier_stack = "HAIR", 8000, True
    trodden(ground, folder)
    assert [each.name for each in ground.modifiers] == [playback_tree.MODIFIER, "Hair"]
    found = shown(ground)
    grown = found.particle_systems[0]  # asked this way, since 3.4 stops where hair keys are read
    roots = [grown.co_hair(object=found, particle_no=k, step=0).z for k in range(len(grown.particles))]
    assert min(roots) < -0.005 < 0.0 < max(roots) + 1e-6


def instances(obj):
    """Where the instances of a ground are (n, 3), made points by a last modifier."""
    last = tree_of(
        obj,
        "points",
        lambda wire, geometry: wire.add(
            "GeometryNodePointsToVertices",
            Points=wire.add(
                "GeometryNodeInstancesToPoints",
                Instances=compat.socket(
                    wire.add("GeometryNodeSeparateComponents", Geometry=geometry).outputs, "Instances"
                ),
            ).outputs[0],
        ).outputs[0],
    )
    found = compat.positions(shown(obj).data)
    obj.modifiers.remove(last)
    return found


def test_stones_go_down_with_the_ground(folder):
    for build, level in ((scatter, 0.0), (raised_and_scattered, 0.5)):
        ground = strip()
        ground.location.z = -level
        tree_of(ground, "stones", build)
        trodden(ground, folder / build.__name__)
        z = instances(ground)[:, 2] - level
        assert len(z) > 500 and z.min() < -0.005 and np.median(np.abs(z)) < 1e-4, build.__name__
        bpy.data.objects.remove(ground)


def test_a_ground_of_instances_is_pressed(folder):
    ground = meshes.grid(51, 131, 0.02, -1.5, -2.2)
    tree_of(ground, "tiles", tiled)
    assert "instances" not in trodden(ground, folder)
    found = compat.positions(shown(ground).data)
    assert len(found) == 3 * 51 * 131 and found[:, 2].min() < -0.01
    assert 0.0 < np.ptp(found[found[:, 2] < -0.003, 0]) < 0.5


def test_prints_that_only_renders_or_the_viewport_show(folder):
    for levels, render, word in (
        (0, 3, "the viewport does not"),
        (3, 0, "renders do not"),
        (0, 0, "cannot be seen"),
        (3, 3, ""),
        (2, 2, ""),
    ):
        ground = strip(0.1)
        ground.desire_path.refine = False
        fine = ground.modifiers.new("Fine", "SUBSURF")
        fine.subdivision_type, fine.levels, fine.render_levels = "SIMPLE", levels, render
        said = trodden(ground, folder / f"{levels} {render}")
        for each in ("the viewport does not", "renders do not", "cannot be seen", "lie 0."):
            assert (each in said) == (
                each == word or each == "lie 0." and "not" in word and word != "cannot be seen"
            ), said
        bpy.data.objects.remove(ground)


def test_points_far_coarser_than_cells_are_told(folder):
    ground = strip(0.04)
    ground.desire_path.refine = False
    said = trodden(ground, folder, cell=0.005, frames=16)
    assert " m apart" in said and "cells of 0.005 m" in said and "cannot be seen" not in said


def test_a_ground_whose_shape_is_keyed_is_told():
    obj = meshes.grid(21, 21, 0.1)
    assert not read(obj, frame_end=20).warnings
    obj.shape_key_add(name="Basis")
    wave = obj.shape_key_add(name="Wave")
    for each in wave.data:
        each.co.z += 0.2
    for frame, value in ((1, 0.0), (8, 1.0), (20, 0.0)):  # gone again at the end
        wave.value = value
        wave.keyframe_insert("value", frame=frame)
    said = read(obj, frame_end=20).warnings
    assert len(said) == 1 and "shape" in said[0] and "frame 1" in said[0]
    obj.data.shape_keys.animation_data_clear()
    assert not read(obj, frame_end=20).warnings


def test_our_modifier_comes_before_pinned_ones(folder):
    ground = strip()
    last = tree_of(ground, "by angle", coloured)
    if hasattr(last, "use_pin_to_last"):
        last.use_pin_to_last = True
    trodden(ground, folder)
    assert deepest(ground) < -0.01


def test_instances_that_no_node_makes_are_named():
    ground = meshes.grid(21, 21, 0.1)
    tile = meshes.grid(3, 3, 0.05, name="Tile")
    tile.parent = ground
    assert not read(ground).warnings
    ground.instance_type = "FACES"
    assert len(read(ground).warnings) == 1 and "instances" in read(ground).warnings[0]
    shown = meshes.link(bpy.data.objects.new("Shown", None))
    shown.instance_type, shown.instance_collection = "COLLECTION", bpy.data.collections.new("Tiles")
    meshes.activate(shown)
    try:
        operator.desire_path_ground_add()
    except RuntimeError as problem:
        assert "instances" in str(problem) and "Make Instances Real" in str(problem)
    else:
        raise AssertionError("not refused")
