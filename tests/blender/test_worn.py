"""What presses is what renders show: shoes of every kind of binding, as their modifiers make them, in the rest pose."""

import bpy
import numpy as np
from scenes import meshes, people
from test_sample import ids, shoe
from test_stack import tree_of

from desire_path.blender import axes, bones, compat, sample, wiring, worn
from desire_path.rig import rigs

LAST = 30


def walker():
    """A biped that bends its toes."""
    obj = people.walk(people.biped(), frames=LAST)
    for side in "LR":
        toe = obj.pose.bones["toe." + side]
        for frame in range(1, LAST + 1):
            toe.rotation_euler.x = 0.5 * np.sin(0.5 * frame)
            toe.keyframe_insert("rotation_euler", index=0, frame=frame)
    bpy.context.scene.frame_set(1)
    return obj


def skin_of(obj, frames=range(1, LAST + 1)):
    scene = bpy.context.scene
    scene.frame_set(1)
    world = axes.matrix(obj.matrix_world, obj.name)
    feet = rigs.detect(bones.skeleton(obj, world, 1.0)).feet
    before, frame = ids(), scene.frame_current
    found = sample.skin(scene, obj, feet, world, 1.0, frames)
    assert ids() == before and obj.data.pose_position == "POSE" and scene.frame_current == frame
    return found


def rest_of(obj, mesh):
    """Where a mesh was modelled, in the armature's space."""
    return axes.points(np.array(obj.matrix_world.inverted() @ mesh.matrix_world), compat.positions(mesh.data), 1.0)


def in_rest(obj, change):
    """Do something to objects while the armature is in its rest pose."""
    obj.data.pose_position = "REST"
    bpy.context.view_layer.update()
    change()
    bpy.context.view_layer.update()
    obj.data.pose_position = "POSE"


def same(one, other, limit=2e-5):
    assert len(one) == len(other), (len(one), len(other))
    one, other = (each[np.lexsort(np.round(each.T, 4))] for each in (one, other))
    np.testing.assert_allclose(one, other, atol=limit)


def child_of(obj, mesh, bone, kind="CHILD_OF"):
    def bind():
        each = mesh.constraints.new(kind)
        if kind == "ARMATURE":
            target = each.targets.new()
            target.target, target.subtarget = obj, bone
            mesh.parent = obj
            return
        each.target, each.subtarget = obj, bone
        each.inverse_matrix = (obj.matrix_world @ obj.pose.bones[bone].matrix).inverted()

    in_rest(obj, bind)


def test_shoes_held_by_constraints_are_worn():
    for kind in ("CHILD_OF", "ARMATURE"):
        obj = walker()
        mesh = meshes.grid(8, 16, 0.02, 0.03, -0.25, name="Shoe")
        wanted = rest_of(obj, mesh)
        child_of(obj, mesh, "foot.L", kind)
        bpy.context.scene.frame_set(20)  # not where it was bound
        found = skin_of(obj)
        assert set(found.weights) == {"foot.L"}, kind
        same(found.vertices, wanted)
        hat = meshes.grid(8, 8, 0.02, name="Hat")
        child_of(obj, hat, "hips", kind)
        assert len(skin_of(obj).vertices) == 8 * 16
        for each in (mesh, hat, obj):
            bpy.data.objects.remove(each)


def test_shoes_bound_to_a_skin_move_with_the_bones_under_them():
    obj = walker()
    # a stocking with a foot and a toe part, hidden by its mask where the shoe is
    skin = meshes.grid(8, 16, 0.02, 0.03, -0.25, name="Stocking")
    y = compat.positions(skin.data)[:, 1]
    toe = obj.data.bones["toe.L"].head_local.y
    for name, there in (("foot.L", y > toe), ("toe.L", y <= toe)):
        skin.vertex_groups.new(name=name).add(np.flatnonzero(there).tolist(), 1.0, "REPLACE")
    skin.modifiers.new("Armature", "ARMATURE").object = obj
    skin.parent = obj
    skin.hide_render = True
    shoe_mesh = meshes.grid(10, 18, 0.0162, 0.031, -0.248, name="Shoe")
    shoe_mesh.location.z, shoe_mesh.parent = -0.01, obj
    bpy.context.view_layer.update()
    wanted = rest_of(obj, shoe_mesh)

    def bind():
        each = shoe_mesh.modifiers.new("Follows", "SURFACE_DEFORM")
        each.target = skin
        with bpy.context.temp_override(object=shoe_mesh, active_object=shoe_mesh):
            bpy.ops.object.surfacedeform_bind(modifier="Follows")
        assert each.is_bound

    in_rest(obj, bind)
    found = skin_of(obj)
    assert set(found.weights) == {"foot.L", "toe.L"}
    same(found.vertices, wanted, 1e-4)
    y = found.vertices[:, 1]
    assert (found.weights["toe.L"][y < toe - 0.03] == 1.0).all() and (
        found.weights["foot.L"][y > toe + 0.03] == 1.0
    ).all()


def weighted(obj, bone="foot.L"):
    return shoe(obj, bone, "ARMATURE")


def test_modifiers_shape_the_sole():
    obj = walker()
    mesh = weighted(obj)
    plain = skin_of(obj).vertices
    thick = mesh.modifiers.new("Thick", "SOLIDIFY")
    thick.thickness, thick.offset = 0.01, -1.0
    assert abs(np.ptp(skin_of(obj).vertices[:, 2]) - 0.01) < 1e-5 and np.ptp(plain[:, 2]) < 1e-5
    thick.show_render = False
    same(skin_of(obj).vertices, plain)
    thick.show_render, thick.show_viewport = True, False  # off where one works, on in renders
    assert abs(np.ptp(skin_of(obj).vertices[:, 2]) - 0.01) < 1e-5
    mesh.modifiers.remove(thick)
    fine = mesh.modifiers.new("Fine", "SUBSURF")
    fine.subdivision_type, fine.levels, fine.render_levels = "SIMPLE", 0, 2
    assert len(skin_of(obj).vertices) == (4 * 7 + 1) * (4 * 15 + 1)
    mesh.modifiers.remove(fine)
    group = mesh.vertex_groups.new(name="gone")
    group.add([k for k, each in enumerate(compat.positions(mesh.data)) if each[1] > -0.1], 1.0, "REPLACE")
    mask = mesh.modifiers.new("Mask", "MASK")
    mask.vertex_group, mask.invert_vertex_group = "gone", True
    left = skin_of(obj).vertices
    assert len(left) < len(plain) and left[:, 1].max() <= -0.1 + 1e-6
    mesh.modifiers.remove(mask)
    mesh.shape_key_add(name="Basis")
    heel = mesh.shape_key_add(name="Heels")
    for each in heel.data:
        each.co.z -= 0.03
    heel.value = 1.0
    np.testing.assert_allclose(skin_of(obj).vertices[:, 2], plain[:, 2] - 0.03, atol=1e-5)


def test_a_mirrored_shoe_is_on_both_feet():
    obj = walker()
    mesh = weighted(obj)
    mesh.vertex_groups.new(name="foot.R")
    mirror = mesh.modifiers.new("Mirror", "MIRROR")
    mirror.use_axis, mirror.use_mirror_vertex_groups, mirror.use_clip = (True, False, False), True, False
    mirror.use_mirror_merge = False
    found = skin_of(obj)
    assert set(found.weights) == {"foot.L", "foot.R"} and len(found.vertices) == 2 * 8 * 16
    right = found.weights["foot.R"] == 1.0
    assert right.sum() == 8 * 16 and (found.vertices[right, 0] < 0.0).all()


def test_a_shoe_that_is_a_shown_collection():
    obj = walker()
    kept = bpy.data.collections.new("Shoes")  # in no scene, as of a library
    mesh = meshes.grid(8, 16, 0.02, 5.03, -0.25, name="Shoe")
    bpy.context.scene.collection.objects.unlink(mesh)
    kept.objects.link(mesh)
    kept.instance_offset = (5.0, 0.0, 0.0)
    empty = meshes.link(bpy.data.objects.new("Shown", None))
    empty.instance_type, empty.instance_collection = "COLLECTION", kept

    def bind():
        empty.parent, empty.parent_type, empty.parent_bone = obj, "BONE", "foot.L"
        bpy.context.view_layer.update()
        empty.matrix_world = np.eye(4)

    in_rest(obj, bind)
    found = skin_of(obj)
    assert set(found.weights) == {"foot.L"}
    same(found.vertices, compat.positions(mesh.data).astype(float) - (5.0, 0.0, 0.0))
    mesh.hide_render = True
    assert skin_of(obj) is None


def test_what_is_off_in_renders_is_not_worn():
    scene = bpy.context.scene
    obj = walker()
    mesh = weighted(obj)
    outer, inner = bpy.data.collections.new("Outfits"), bpy.data.collections.new("Outfit")
    scene.collection.children.link(outer)
    outer.children.link(inner)
    scene.collection.objects.unlink(mesh)
    inner.objects.link(mesh)
    layer = bpy.context.view_layer.layer_collection.children["Outfits"]
    assert skin_of(obj) is not None
    for owner, name in ((outer, "hide_render"), (inner, "hide_render"), (layer.children["Outfit"], "exclude")):
        setattr(owner, name, True)
        assert skin_of(obj) is None, (owner, name)
        setattr(owner, name, False)
    for owner, name in ((outer, "hide_viewport"), (mesh, "hide_viewport"), (layer.children["Outfit"], "hide_viewport")):
        setattr(owner, name, True)  # only not seen while one works
        assert skin_of(obj) is not None, (owner, name)
        setattr(owner, name, False)
    for frame, off in ((1, True), (10, False)):  # put on later
        mesh.hide_render = off
        mesh.keyframe_insert("hide_render", frame=frame)
    scene.frame_set(1)
    assert mesh.hide_render and skin_of(obj) is not None and skin_of(obj, range(1, 9)) is None
    for first, last, told in ((1, 12, 1), (1, 9, 0), (10, 20, 0)):
        said = [each for each in sample.record(scene, obj, first, last).warnings if "off in renders" in each]
        assert len(said) == told and all(mesh.name in each and obj.name in each for each in said), (first, said)
    mesh.animation_data_clear()
    mesh.hide_render = False
    led = mesh.driver_add("hide_render").driver  # whatever frame is shown
    led.expression = "frame < 10"
    for shown in (1, 20):
        scene.frame_set(shown)
        assert skin_of(obj, range(1, 9)) is None and skin_of(obj) is not None, shown
        (said,) = (each for each in sample.record(scene, obj, 1, 12).warnings if "off in renders" in each)
    led.expression = "outfit > 0.5"  # of no time, but for keys of what it asks
    asks = led.variables.new()
    asks.name, asks.targets[0].id, asks.targets[0].data_path = "outfit", obj, '["outfit"]'
    for value in (1.0, 0.0):
        obj["outfit"] = value
        obj.update_tag()
        scene.frame_set(2)
        assert mesh.hide_render == (value > 0.5)
        assert (skin_of(obj) is None) == (value > 0.5)
    for frame, value in ((1, 1.0), (10, 0.0)):
        obj["outfit"] = value
        obj.keyframe_insert('["outfit"]', frame=frame)
    for shown in (1, 20):
        scene.frame_set(shown)
        assert skin_of(obj, range(1, 3)) is None and skin_of(obj) is not None, shown
    mesh.driver_remove("hide_render")
    for frame, off in ((1, True), (10, False)):
        mesh.hide_render = off
        mesh.keyframe_insert("hide_render", frame=frame)
    action = mesh.animation_data.action
    strip = mesh.animation_data.nla_tracks.new().strips.new("on and off", 1, action)
    if hasattr(strip, "action_slot"):
        strip.action_slot = mesh.animation_data.action_slot
    mesh.animation_data.action = None
    for shown in (1, 20):
        scene.frame_set(shown)
        assert skin_of(obj, range(1, 9)) is None and skin_of(obj) is not None, shown
    mesh.animation_data_clear()
    mesh.hide_render = False
    layer.children["Outfit"].exclude = True
    other = scene.view_layers.new("Feet")  # rendered beside the first
    assert skin_of(obj) is not None
    other.use = False
    assert skin_of(obj) is None


def test_soles_that_change_their_shape_are_told():
    scene, obj = bpy.context.scene, walker()
    mesh = weighted(obj)
    mesh.shape_key_add(name="Basis")
    thick = mesh.shape_key_add(name="Thick")
    for point in thick.data:
        point.co.z -= 0.03

    def told():
        return [each for each in sample.record(scene, obj, 1, 12).warnings if "changes its shape" in each]

    for values, count in (((0.0, 0.0), 0), ((0.0, 1.0), 1)):
        for frame, value in zip((1, 12), values):
            thick.value = value
            thick.keyframe_insert("value", frame=frame)
        for shown in (1, 12):
            scene.frame_set(shown)
            assert len(told()) == count, (values, shown)
    assert obj.name in told()[0] and "as at frame 1." in told()[0]
    mesh.data.shape_keys.animation_data_clear()
    bent = thick.driver_add("value").driver  # as bones bend, which in the rest pose they do not
    asks = bent.variables.new()
    asks.type, asks.targets[0].id, asks.targets[0].bone_target = "TRANSFORMS", obj, "foot.L"
    asks.targets[0].transform_type, asks.targets[0].transform_space = "ROT_X", "LOCAL_SPACE"
    bent.expression = f"min(abs({asks.name}), 1)"
    assert not told()


def test_what_stands_still_is_not_worn():
    obj = walker()
    mesh = meshes.grid(8, 16, 0.02, 0.03, -0.25, name="Mat")
    mesh.parent = obj  # goes where the armature goes as a whole, with no bone of it
    bpy.context.view_layer.update()
    assert skin_of(obj) is None
    mesh.parent = None
    track = mesh.constraints.new("LIMIT_DISTANCE")
    track.target, track.distance, track.limit_mode = obj, 1e3, "LIMITDIST_INSIDE"
    assert skin_of(obj) is None


def test_a_shoe_of_nodes_moves_with_its_bone():
    obj = walker()
    mesh = weighted(obj)
    plain = skin_of(obj).vertices
    holder = meshes.grid(2, 2, 0.02, name="Holder")

    def shown(wire, _geometry):
        return wire.add("GeometryNodeObjectInfo", {"transform_space": "RELATIVE"}, Object=mesh).outputs["Geometry"]

    tree_of(holder, "shows", shown)
    mesh.hide_render = True
    found = skin_of(obj)
    assert set(found.weights) == {"foot.L"}
    same(found.vertices, plain)


def test_looking_leaves_nothing_to_be_done():
    """What a user's scene has to work out again afterwards would look like a change."""
    obj = walker()
    weighted(obj)
    skin_of(obj)
    seen = []
    handler = lambda _scene, depsgraph: seen.extend(
        each.id.name
        for each in depsgraph.updates
        if not isinstance(each.id, (bpy.types.Scene, bpy.types.Collection))
        and (each.is_updated_geometry or each.is_updated_transform or not isinstance(each.id, bpy.types.Object))
    )
    bpy.app.handlers.depsgraph_update_post.append(handler)
    try:
        world = axes.matrix(obj.matrix_world, obj.name)
        feet = rigs.detect(bones.skeleton(obj, world, 1.0)).feet
        assert sample.skin(bpy.context.scene, obj, feet, world, 1.0) is not None
        seen.clear()
        bpy.context.view_layer.update()
        assert not seen, seen
    finally:
        bpy.app.handlers.depsgraph_update_post.remove(handler)


def test_an_object_that_is_given_to_nodes_is_followed():
    obj = walker()
    mesh = weighted(obj)
    plain = skin_of(obj).vertices
    holder = meshes.grid(2, 2, 0.02, name="Holder")
    modifier = tree_of(holder, "shows", lambda wire, geometry: geometry)
    tree = modifier.node_group
    if hasattr(tree, "interface"):
        identifier = tree.interface.new_socket("Shown", in_out="INPUT", socket_type="NodeSocketObject").identifier
    else:
        identifier = tree.inputs.new("NodeSocketObject", "Shown").identifier
    wire = wiring.Wiring(tree)
    enter = next(node for node in tree.nodes if node.bl_idname == "NodeGroupInput")
    info = wire.add("GeometryNodeObjectInfo", {"transform_space": "RELATIVE"}, Object=enter.outputs["Shown"])
    leave = next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput")
    tree.links.new(info.outputs["Geometry"], leave.inputs[0])
    if hasattr(modifier, "properties"):
        getattr(modifier.properties.inputs, identifier).value = mesh
    else:
        modifier[identifier] = mesh
    holder.update_tag()
    bpy.context.view_layer.update()
    mesh.hide_render = True
    assert worn.hanging(bpy.context.scene, obj) == [mesh, holder]
    same(skin_of(obj).vertices, plain)


def test_a_character_of_a_library_wears_its_shoes(folder):
    obj = walker()
    mesh = weighted(obj)
    mesh.modifiers.new("Thick", "SOLIDIFY").thickness = 0.01
    wanted = skin_of(obj).vertices
    path = str(folder / "character.blend")
    bpy.data.libraries.write(path, {obj, mesh, obj.data, mesh.data})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.objects = list(there.objects)
    linked = list(here.objects)
    for each in linked:
        bpy.context.scene.collection.objects.link(each)
    own, shoe_of = (
        next(each for each in linked if each.type == kind).override_create(remap_local_usages=True)
        for kind in ("ARMATURE", "MESH")
    )
    shoe_of.parent = shoe_of.modifiers["Armature"].object = own
    bpy.context.view_layer.update()
    assert own.data.library is not None and own.library is None
    same(skin_of(own).vertices, wanted)
