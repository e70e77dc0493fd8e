"""A ground looks like what it is made of, and a material of the user's stays as it is."""

import os

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused
from test_refined import baked, copy_of, plane

from desire_path.blender import compat, look_soils, looks, materials, playback_tree
from desire_path.ground.soil import SOILS

SIZE = 24  # pixels of a picture along each side
KEEP = ("materials", "node_groups")


def ground(soil="dry-sand", name="Ground", side=0.2, **settings):
    """A square of four points that is a ground."""
    obj = meshes.grid(2, 2, side, -side / 2, -side / 2, name=name)
    bpy.ops.object.desire_path_ground_add()
    obj.desire_path.soil = soil
    for key, value in settings.items():
        setattr(obj.desire_path, key, value)
    return obj


def make(*grounds, **options):
    meshes.activate(grounds[0])
    for each in grounds:
        each.select_set(True)
    assert bpy.ops.object.desire_path_material_add(**options) == {"FINISHED"}
    return grounds[0].material_slots[0].material


def counts():
    return {name: len(getattr(bpy.data, name)) for name in KEEP}


def bake_by_hand(obj, compression, heap=0.0):
    """What the playback would store, a value for each half: y below zero, y above."""
    mesh = obj.data
    low = compat.positions(mesh)[:, 1] < 0.0
    value = np.zeros((len(low), 4), np.float32)
    value[:, 2] = np.where(low, 0.0, compression)
    value[:, 0] = np.where(low, 0.0, heap) - value[:, 2]
    mesh.attributes.new(playback_tree.ATTRIBUTE, "FLOAT_COLOR", "POINT").data.foreach_set("color", value.ravel())


def two_halves(obj):
    """Six points in place of four: each half is of one value, with a sharp border between them."""
    mesh = bpy.data.meshes.new("Halves")
    a, h = 0.1, 1e-4
    rows = [(-a, -a, 0), (a, -a, 0), (a, -h, 0), (-a, -h, 0), (a, h, 0), (-a, h, 0), (a, a, 0), (-a, a, 0)]
    mesh.from_pydata(rows, [], [(0, 1, 2, 3), (3, 2, 4, 5), (5, 4, 6, 7)])
    obj.data = mesh
    return obj


def test_every_soil_has_a_look():
    known = {"dry-sand": "SAND", "snow": "SNOW", "mud": "MUD", "soil": "EARTH", "wet-soil": "EARTH"}
    known |= {"crust-snow": "CRUST", "packed-earth": "PACKED", "packed-snow": "SNOW"}
    for name in SOILS:
        look, wet = look_soils.look_of(name)
        assert look in look_soils.LOOKS and known.get(name, look) == look and 0.0 <= wet <= 1.0
    assert look_soils.look_of("deep-snow")[0] == "SNOW" and look_soils.look_of("wet-sand")[0] == "SAND"
    assert look_soils.look_of("wet-soil")[1] > look_soils.look_of("soil")[1]
    for name in ("dry-sand", "snow", "mud", "soil"):
        material = make(ground(name, name))
        assert look_soils.look_of(name)[0].capitalize() in material.name
    assert len(bpy.data.materials) == 4


def test_shares_of_groups_that_overlap_sum_to_one():
    obj = two_halves(ground("soil"))
    for name, soil, weight in (("a", "snow", 1.0), ("b", "mud", 1.0), ("c", "snow", 0.5)):
        obj.vertex_groups.new(name=name).add([0, 1], weight, "REPLACE")
        each = obj.desire_path.painted.add()
        each.vertex_group, each.soil = name, soil
    found = materials.shares(obj)
    assert len(found) == 2  # snow painted twice is snow
    assert np.allclose(found[looks.SHARE.format("snow")][:3], (0.6, 0.6, 0.0))
    assert np.allclose(sum(found.values())[:3], (1.0, 1.0, 0.0))
    obj.desire_path.painted[0].vertex_group = "gone"
    make(obj)


def test_a_material_of_the_users_stays_and_gets_a_group():
    obj = ground("mud")
    mine = bpy.data.materials.new("Mine")
    if not mine.use_nodes:
        mine.use_nodes = True
    obj.data.materials.append(mine)
    before = [(each.from_node.name, each.to_node.name) for each in mine.node_tree.links]
    nodes = set(mine.node_tree.nodes.keys())
    assert make(obj) == mine
    assert [(each.from_node.name, each.to_node.name) for each in mine.node_tree.links] == before
    (added,) = (each for each in mine.node_tree.nodes if each.name not in nodes)
    assert added.node_tree[looks.TAG] and not any(each.is_linked for each in added.outputs)
    assert {"Shader", "Color", "Roughness", "Normal", "Pressed", "Loose", "Disturbed"} <= set(added.outputs.keys())
    # plugged in it stays so when the soil changes
    leave = next(each for each in mine.node_tree.nodes if each.bl_idname == "ShaderNodeOutputMaterial")
    mine.node_tree.links.new(added.outputs["Shader"], leave.inputs["Surface"])
    obj.desire_path.soil = "snow"
    make(obj)
    assert len(mine.node_tree.nodes) == len(nodes) + 1 and "Snow" in added.node_tree.name
    assert leave.inputs["Surface"].links[0].from_socket == added.outputs["Shader"]
    assert counts() == {"materials": 1, "node_groups": 2}
    # asked for, ours takes its place
    assert make(obj, replace=True) != mine and mine.name in bpy.data.materials


def test_empty_slots_are_filled_and_others_are_not():
    obj = ground()
    mine = bpy.data.materials.new("Mine")
    if not mine.use_nodes:
        mine.use_nodes = True
    for each in (mine, None, mine):
        obj.data.materials.append(each)
    make(obj)
    assert [materials.is_ours(slot.material) for slot in obj.material_slots] == [False, True, False]
    assert [slot.material for slot in obj.material_slots][::2] == [mine, mine]


def test_what_cannot_be_done_is_told_and_nothing_changes():
    obj = bpy.data.objects.new("Plain", ground().data)
    meshes.link(obj)
    meshes.activate(obj)
    refused(bpy.ops.object.desire_path_material_add, "'Plain' is no ground yet")
    bpy.ops.object.desire_path_ground_add()
    if "use_nodes" in bpy.types.Material.bl_rna.properties:
        mine = bpy.data.materials.new("Mine")
        mine.use_nodes = False
        if not mine.use_nodes:  # later Blenders know no others
            obj.data.materials.append(mine)
            before = counts()
            refused(bpy.ops.object.desire_path_material_add, "'Mine'", "Use Nodes")
            assert counts() == before and not mine.use_nodes
            make(obj, replace=True)


def test_linked_data_is_told_or_kept(folder):
    bpy.context.preferences.filepaths.save_version = 0
    bare, slotted = ground(name="Bare"), ground(name="Slotted")
    slotted.data.materials.append(None)
    path = str(folder / "library.blend")
    bpy.data.libraries.write(path, {bare.data, slotted.data})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.meshes = there.meshes
    bare, slotted = (
        meshes.link(bpy.data.objects.new(each.name, each)) for each in sorted(here.meshes, key=lambda each: each.name)
    )
    for each in (bare, slotted):
        meshes.activate(each)
        bpy.ops.object.desire_path_ground_add()
    meshes.activate(bare)
    refused(bpy.ops.object.desire_path_material_add, "linked from another file", "no material slot", "local")
    assert counts() == {"materials": 0, "node_groups": 0}
    material = make(slotted)
    assert materials.is_ours(material) and slotted.material_slots[0].link == "OBJECT"


def test_grounds_of_the_same_soils_share_a_material():
    one, other = ground(name="One"), ground(name="Other")
    assert make(one, other) == other.material_slots[0].material
    other.scale = (2.0, 2.0, 2.0)  # grains stay as large as they are
    bpy.context.view_layer.update()
    make(one, other)
    assert one.material_slots[0].material != other.material_slots[0].material


def test_pressed_twice_there_is_one_and_another_soil_takes_its_place():
    obj = ground()
    sand = make(obj)
    before = counts()
    assert make(obj) == sand and counts() == before
    obj.desire_path.soil = "snow"
    snow = make(obj)
    assert "Snow" in snow.name and len(obj.material_slots) == 1 and counts() == before
    assert "Mud" in make(obj, kind="MUD").name and counts() == before


def test_a_material_that_was_tuned_stays_when_another_takes_its_place():
    obj = ground()
    tuned = make(obj)
    tuned.name = "Mine now"
    tuned.node_tree.nodes.new("ShaderNodeRGB")
    obj.desire_path.soil = "snow"
    assert "Snow" in make(obj).name
    assert tuned.use_fake_user and tuned.users == 1 and bpy.data.materials.get("Mine now") == tuned
    other = make(ground("mud", "Other"))
    group = next(each for each in other.node_tree.nodes if each.bl_idname == "ShaderNodeGroup")
    group.inputs["Tint"].default_value = (1.0, 0.0, 0.0, 1.0)  # by a number alone
    bpy.data.objects["Other"].desire_path.soil = "dry-sand"
    third = make(bpy.data.objects["Other"])
    assert other.use_fake_user and other.name in bpy.data.materials
    assert third != tuned  # which is of the same sand, and somebody's own


def test_a_material_that_is_replaced_stays_in_the_file():
    obj = ground()
    mine = bpy.data.materials.new("Mine")
    obj.data.materials.append(mine)
    assert make(obj, replace=True) != mine and mine.use_fake_user


def test_grounds_of_one_mesh_have_a_material_each():
    one = ground("snow", "One")
    other = meshes.link(bpy.data.objects.new("Other", one.data))
    meshes.activate(other)
    bpy.ops.object.desire_path_ground_add()
    other.desire_path.soil = "mud"
    assert "Snow" in make(one).name and "Mud" in make(other).name
    assert "Snow" in one.material_slots[0].material.name and one.data.materials[0] is None


def test_shares_of_what_is_painted_no_more_go():
    obj = two_halves(ground("soil"))
    obj.vertex_groups.new(name="drift").add([0, 1], 1.0, "REPLACE")
    each = obj.desire_path.painted.add()
    each.vertex_group, each.soil = "drift", "snow"
    make(obj)
    assert looks.SHARE.format("snow") in obj.data.attributes
    each.soil = "mud"
    make(obj)
    assert [a.name for a in obj.data.attributes if "share" in a.name] == [looks.SHARE.format("mud")]
    obj.desire_path.painted.clear()
    make(obj)
    assert not [a.name for a in obj.data.attributes if "share" in a.name]


def test_a_soil_file_that_no_bake_would_take_makes_no_material(folder):
    obj = ground()
    obj.desire_path.soil_file = str(folder / "snow.json")
    refused(bpy.ops.object.desire_path_material_add, "snow.json")
    SOILS["snow"].save(folder / "snow.json")
    assert "Snow" in make(obj).name


def test_painted_soils_of_a_linked_mesh_are_told(folder):
    bpy.context.preferences.filepaths.save_version = 0
    painted = ground("soil", "Painted")
    painted.data.materials.append(None)
    painted.vertex_groups.new(name="drift").add([0, 1], 1.0, "REPLACE")
    path = str(folder / "library.blend")
    bpy.data.libraries.write(path, {painted.data})
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.meshes = there.meshes
    obj = meshes.link(bpy.data.objects.new("Painted", here.meshes[0]))
    meshes.activate(obj)
    bpy.ops.object.desire_path_ground_add()
    each = obj.desire_path.painted.add()
    each.vertex_group, each.soil = "drift", "snow"
    refused(bpy.ops.object.desire_path_material_add, "linked from another file", "painted")
    assert counts() == {"materials": 0, "node_groups": 0}
    assert "Sand" in make(obj, kind="SAND").name


def test_a_bake_that_is_shown_by_a_copy_has_it(folder):
    obj = plane()
    group = obj.vertex_groups.new(name="drift")
    group.add([0, 1], 1.0, "REPLACE")
    each = obj.desire_path.painted.add()
    each.vertex_group, each.soil = "drift", "snow"
    baked(folder, obj)
    material = make(obj)
    name = looks.SHARE.format("snow")
    copy = copy_of(obj).data
    at = compat.positions(copy)
    assert [each.name for each in copy.materials] == [material.name]
    assert np.allclose(compat.float_attribute(copy, name), (3.0 - at[:, 1]) / 6.0, atol=1e-5)
    assert obj.desire_path.bake_state == "FRESH"
    # painted elsewhere and baked again
    group.add([0, 1], 0.0, "REPLACE")
    meshes.activate(obj)
    bpy.ops.object.desire_path_bake()
    assert not compat.float_attribute(copy_of(obj).data, name).any()


def test_undo_takes_it_back():
    obj = ground()
    bpy.ops.ed.undo_push(message="before")
    make(obj)
    bpy.ops.ed.undo_push(message="made")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Ground"]
    assert not len(obj.material_slots) and counts() == {"materials": 0, "node_groups": 0}


def test_looks_are_assets_of_a_library(folder):
    mine = make(ground("snow"))
    before = counts()
    known = bpy.context.preferences.filepaths.asset_libraries
    others = [each.path for each in known]
    place = str(folder / "assets")
    for _ in range(2):  # the second time it is listed already
        assert bpy.ops.wm.desire_path_assets_add(directory=place) == {"FINISHED"}
    assert counts() == before and mine.name in bpy.data.materials and mine.asset_data is None
    assert len(known) == len(others) + 1 and known[-1].name == materials.LIBRARY
    assert os.path.realpath(known[-1].path) == os.path.realpath(place)
    with bpy.data.libraries.load(os.path.join(place, materials.FILE), assets_only=True) as (there, here):
        assert len(there.materials) == len(materials.ASSETS)
        here.materials = there.materials
    assert {"Desire Path Mud", "Desire Path Wet Sand"} <= {each.name for each in here.materials}
    assert all(materials.is_ours(each) and each.asset_data is not None for each in here.materials)
    bpy.ops.preferences.asset_library_remove(index=len(known) - 1)
    (folder / "file").write_text("no folder")
    refused(bpy.ops.wm.desire_path_assets_add, "file", directory=str(folder / "file"))
    (folder / "taken" / materials.FILE).mkdir(parents=True)
    refused(bpy.ops.wm.desire_path_assets_add, "taken", directory=str(folder / "taken"))
    assert counts()["materials"] == before["materials"] + len(materials.ASSETS)  # those that were appended
