"""Layers in Blender: a list on the ground, painted by vertex groups, obeyed by bakes and told by their state."""

import json

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused, scene
from test_live import deepest
from test_live import scene as followed

from desire_path.blender import compat, layered, live
from desire_path.blender import ground as grounds
from desire_path.ground import maps


def laid(ground, soil="mud", thickness=0.03, group=""):
    assert bpy.ops.object.desire_path_layer_add() == {"FINISHED"}
    layer = ground.desire_path.layers[0]
    layer.soil, layer.thickness, layer.group = soil, thickness, group
    return layer


def painted(ground, name, weight):
    """A vertex group with `weight(x)` at each vertex."""
    group = ground.vertex_groups.new(name=name)
    for vertex in ground.data.vertices:
        share = float(weight((ground.matrix_world @ vertex.co).x))
        if share > 0.0:
            group.add([vertex.index], share, "REPLACE")


def planes(folder):
    return maps.read(folder / "bake" / "maps_final.exr").planes


def test_layers_are_added_moved_and_removed():
    ground, _ = scene(None, frames=16)
    settings = ground.desire_path
    remove, move = bpy.ops.object.desire_path_layer_remove, bpy.ops.object.desire_path_layer_move
    refused(remove, "Nothing lies on")
    for soil in ("mud", "dry-sand", "fresh-snow"):
        laid(ground, soil)
    assert [each.soil for each in settings.layers] == ["fresh-snow", "dry-sand", "mud"] and settings.layers_index == 0
    refused(bpy.ops.object.desire_path_layer_add, "has 3 layers, which is the most")
    assert move(direction="UP") == {"FINISHED"} and settings.layers_index == 0
    assert move(direction="DOWN") == {"FINISHED"} and settings.layers_index == 1
    assert [each.soil for each in settings.layers] == ["dry-sand", "fresh-snow", "mud"]
    assert remove() == {"FINISHED"}
    assert [each.soil for each in settings.layers] == ["dry-sand", "mud"] and settings.layers_index == 1


def test_a_bake_obeys_layers_and_its_state_tells_of_them(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "packed-earth"
    bpy.ops.object.desire_path_bake()
    assert settings.bake_state == "FRESH" and "layer_1" not in planes(folder)
    firm = json.loads(settings.summary)["deepest_m"]
    layer = laid(ground, "mud", 0.03)
    assert settings.bake_state == "OUTDATED" and "settings" in settings.missing
    bpy.ops.object.desire_path_bake()
    assert settings.bake_state == "FRESH", settings.missing
    assert json.loads(settings.summary)["deepest_m"] > 1.5 * firm
    found = planes(folder)
    assert np.isclose(found["layer_1"].max(), 0.03) and found["layer_1"].min() < 0.03
    assert np.allclose(found["surface_mud"] + found["surface_packed-earth"], 1.0, atol=1e-5)
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert report["parameters"]["layers"][0][1] == 0.03
    for name, value in (("thickness", 0.05), ("soil", "dry-sand")):
        setattr(layer, name, value)
        assert settings.bake_state == "OUTDATED", name
        setattr(layer, name, {"thickness": 0.03, "soil": "mud"}[name])
        assert settings.bake_state == "FRESH", settings.missing
    layer.soil_numbers.young_modulus *= 0.5
    assert settings.bake_state == "OUTDATED"


def test_a_layer_is_as_thick_as_its_group_is_painted(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "packed-earth"
    across = [(ground.matrix_world @ each.co).x for each in ground.data.vertices]
    middle, half = np.mean((min(across), max(across))), (max(across) - min(across)) / 2
    painted(ground, "puddle", lambda x: max(1.0 - abs(x - middle) / half, 0.0))
    laid(ground, "mud", 0.04, "puddle")
    bpy.ops.object.desire_path_bake()
    thick = planes(folder)["layer_1"]
    assert 0.02 < thick.max() <= 0.04 + 1e-6 and 5 < len(np.unique(thick[planes(folder)["compression"] == 0])) < 20
    ground.vertex_groups["puddle"].add([0, 1, 2], 0.5, "REPLACE")
    assert settings.bake_state == "OUTDATED"


def test_what_cannot_lie_is_told_before_anything_is_baked(folder):
    ground, _ = scene(folder, frames=16)
    layer = laid(ground)
    bake = bpy.ops.object.desire_path_bake
    for thickness in (0.0, -0.1, 10.5, float("nan")):
        layer.thickness = thickness
        refused(bake, "thick cannot lie on the ground: give more than 0 and up to 10 m")
    layer.thickness, layer.group = 0.1, "mudd"
    refused(bake, "has no vertex group 'mudd' by which a layer lies")
    layer.group, layer.soil_file = "", str(folder / "none.json")
    refused(bake, "There is no soil at")
    layer.soil_file = ""
    laid(ground)
    refused(bake, "Two layers of one soil lie on each other")
    bpy.ops.object.desire_path_layer_remove()
    ground.desire_path.soil_numbers.keyframe_insert("young_modulus", frame=1)
    ground.desire_path.soil_numbers.young_modulus *= 2.0
    ground.desire_path.soil_numbers.keyframe_insert("young_modulus", frame=16)
    refused(bake, "has keys, which ground in layers does not take")
    assert not (folder / "bake").exists()


def test_a_layer_is_shown_in_the_units_of_the_scene():
    ground, _ = scene(None, frames=16)
    layer = laid(ground)
    bpy.context.scene.unit_settings.scale_length = 0.01
    assert np.isclose(layer.thickness_length, 3.0)
    layer.thickness_length = 5.0
    assert np.isclose(layer.thickness, 0.05)
    assert layered.above(ground) == grounds.axes.typed(layer.thickness)


def test_materials_and_attributes_tell_what_is_seen(folder):
    ground, _ = scene(folder, frames=16, spacing=0.1)
    settings = ground.desire_path
    settings.soil = "packed-earth"
    laid(ground, "mud", 0.03)
    assert bpy.ops.object.desire_path_material_add() == {"FINISHED"}
    (material,) = {slot.material for slot in ground.material_slots}
    assert "Mud" in material.name and "Earth" in material.name
    bpy.ops.object.desire_path_bake()
    for frame, least, most in ((1, 0.0, 0.0), (16, 0.9, 1.0)):
        bpy.context.scene.frame_set(frame)
        shown = ground.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        value = {
            name: compat.float_attribute(shown, name) for name in ("surface_mud", "desire_path_progress", "layer_1")
        }
        trodden = compat.float_attribute(shown, "compression") > 1e-3
        assert trodden.any() and np.allclose(value["surface_mud"][trodden], 1.0, atol=1e-4)
        assert least <= value["desire_path_progress"][trodden].min() and value["desire_path_progress"].max() <= most
        assert value["layer_1"][trodden].max() < 0.03
    bpy.ops.object.desire_path_free()
    assert not [each.name for each in ground.data.attributes if each.name.startswith(("surface_", "layer_"))]


def road(folder, y=6.5):
    """A ground of packed earth, mud that sticks on its near part, and a curve along all of it."""
    ground = meshes.grid(16, int(y / 0.1), 0.1, -0.8, 0.0)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size, settings.folder = "packed-earth", 0.02, str(folder / "bake")
    group = ground.vertex_groups.new(name="mud")
    group.add([v.index for v in ground.data.vertices if v.co.y < 1.5], 1.0, "REPLACE")
    data = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(1)
    for point, at in zip(spline.points, (0.3, y - 0.6)):
        point.co = (0.0, at, 0.0, 1.0)
    way = meshes.link(bpy.data.objects.new("Way", data))
    meshes.activate(ground)
    return ground, way


def test_mud_is_carried_onto_a_road_by_stamps_and_wheels_and_fades(folder):
    """From a painted soil and from a painted layer alike."""
    for layered_, given in ((True, {"stamp": "boot"}), (False, {"kind": "WHEEL"}), (True, {"kind": "WHEEL"})):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        ground, way = road(folder)
        settings = ground.desire_path
        if layered_:
            layer = laid(ground, "mud", 0.05, "mud")
        else:
            bpy.ops.object.desire_path_paint_add()
            layer = settings.painted[0]
            layer.soil, layer.vertex_group = "mud", "mud"
        layer.soil_numbers.adhesion = 0.004
        meshes.activate(way)
        bpy.ops.object.desire_path_track_add(**given)
        meshes.activate(ground)
        assert bpy.ops.object.desire_path_tracks_press() == {"FINISHED"}
        assert settings.bake_state == "FRESH", settings.missing
        found = maps.read(bpy.path.abspath(settings.pressed) + "/maps_final.exr")
        left, seen = found.planes["carried_mud"], found.planes["surface_mud"]
        y = float(found.notes["originY"]) + 0.02 * (0.5 + np.arange(len(left)))
        near, far = (left[(y > low) & (y < low + 2.07)].sum() for low in (1.5, 3.57))
        assert near > far > 0.0, (given, near, far)
        assert seen[(y > 1.7) & (y < 5.6)].max() > 0.1
        assert "surface_mud" in ground.data.attributes
        layer.soil_numbers.adhesion = 0.003
        assert settings.bake_state == "OUTDATED"


def test_auto_update_follows_layers(folder):
    ground, _ = followed(folder / "bake")
    settings = ground.desire_path
    settings.soil = "packed-earth"
    assert live.update(bpy.context.scene) == []
    depths = [deepest(ground)]
    layer = laid(ground, "mud", 0.03)
    for what, value in ((None, None), ("thickness", 0.06), ("soil", "fresh-snow")):
        if what:
            setattr(layer, what, value)
        assert settings.bake_state == "OUTDATED"
        assert live.update(bpy.context.scene) == [] and settings.bake_state == "FRESH", what
        depths.append(deepest(ground))
    assert (np.diff(depths) < -0.002).all(), depths
    layer.group = ground.vertex_groups.new(name="puddle").name
    assert live.update(bpy.context.scene) == [] and np.isclose(deepest(ground), depths[0], atol=1e-5), "it is nowhere"
    ground.vertex_groups.clear()
    assert "no vertex group 'puddle'" in live.update(bpy.context.scene)[0]
    assert bpy.ops.object.desire_path_layer_remove() == {"FINISHED"}
    assert live.update(bpy.context.scene) == [] and np.isclose(deepest(ground), depths[0], atol=1e-5)


def test_an_override_keeps_layers_of_its_own_over_those_of_the_file(folder):
    file, shot = str(folder / "library.blend"), str(folder / "shot.blend")
    ground, _ = scene(folder, frames=16)
    laid(ground, "mud", 0.05)
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(file, link=True) as (_, found):
        found.objects = ["Ground", "Walker"]
    for each in found.objects:
        bpy.context.scene.collection.objects.link(each)
    ground, walker = (each.override_create(remap_local_usages=True) for each in found.objects)
    meshes.activate(walker)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    meshes.activate(ground)
    ground.desire_path.folder = str(folder / "bake")
    ground.desire_path.layers[0].thickness = 0.1
    assert bpy.ops.object.desire_path_layer_add() == {"FINISHED"}  # dry sand, 3 cm, on top
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert {"layer_1", "layer_2", "surface_mud"} <= set(planes(folder))
    bpy.ops.wm.save_as_mainfile(filepath=shot)
    for _ in range(2):
        bpy.ops.wm.open_mainfile(filepath=shot)
        settings = next(each for each in bpy.context.scene.objects if each.desire_path.is_ground).desire_path
        lies = [(each.soil, round(each.thickness, 6)) for each in settings.layers]
        assert lies == [("dry-sand", 0.03), ("mud", 0.1)] and settings.bake_state == "FRESH", settings.missing
        bpy.ops.wm.save_mainfile()
