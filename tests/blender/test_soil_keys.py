"""Keys on the numbers of soils and on masses count over the time of a bake."""

import json
from dataclasses import replace

import bpy
import numpy as np
from scenes import meshes
from test_bake import scene
from test_soils import paint

from desire_path.blender import compat, moves, private, sample, soil_keys, soils
from desire_path.ground.soil import SOILS, Soil
from desire_path.ground.soil_keys import SoilKeys


def key(owner, path, keys):
    """Keys (frame, value) of a property, one straight line after the other."""
    group, _, name = path.rpartition(".")
    into = owner.path_resolve(group)
    for frame, value in keys:
        setattr(into, name, value)
        owner.keyframe_insert(path, frame=frame)
    for curve in soil_keys._curves(owner, path).values():
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def depth(ground):
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    return json.loads(ground.desire_path.summary)["deepest_m"]


def test_a_soil_that_hardens_is_pressed_less_and_what_is_baked_is_outdated(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "soil"
    soft = depth(ground)
    key(ground, "desire_path.soil_numbers.young_modulus", [(1, 1.25e6), (16, 1.25e6)])
    assert soil_keys.of_ground(bpy.context.scene, ground, 1, 16) == [SOILS["soil"]]
    assert settings.bake_state == "FRESH" and depth(ground) == soft
    curve = soil_keys._curves(ground, "desire_path.soil_numbers.")["young_modulus"]
    curve.keyframe_points[0].co.y = 1.25e8
    curve.keyframe_points[1].co.y = 1.25e8
    curve.update()
    assert settings.bake_state == "OUTDATED"
    hard = depth(ground)
    assert hard < 0.1 * soft, (hard, soft)
    assert settings.bake_state == "FRESH"
    curve.keyframe_points[1].co.y = 1.25e6
    curve.update()
    assert settings.bake_state == "OUTDATED"
    (found,) = soil_keys.of_ground(bpy.context.scene, ground, 1, 16)
    assert isinstance(found, SoilKeys)
    assert found.soil == replace(SOILS["soil"], young_modulus=1.25e8)
    assert found.at(0.0).young_modulus == 1.25e8
    assert np.isclose(found.at(7.5 / 24.0).young_modulus, 0.5 * (1.25e8 + 1.25e6), rtol=1e-3)
    assert hard < depth(ground) < soft
    bpy.context.scene.frame_set(9)  # another frame changes what is shown, not what is baked
    assert settings.bake_state == "FRESH"


def test_words_of_people_have_keys_as_numbers_do_and_painted_soils_their_own(folder):
    ground, _ = scene(folder, frames=16)
    paint(ground)
    key(ground, "desire_path.painted[0].soil_numbers.softness", [(1, 0.5), (9, 1.0)])
    key(ground, "desire_path.soil_numbers.rim", [(1, 0.0), (9, 1.0)])
    own, wet = soil_keys.of_ground(bpy.context.scene, ground, 1, 16)
    assert np.isclose(wet.at(0.0).young_modulus, 10.0 ** (0.5 * (soils.HARD + soils.SOFT)), rtol=1e-5)
    assert np.isclose(wet.at(1.0).young_modulus, 1e5, rtol=1e-5)
    assert np.isclose(own.at(4.0 / 24.0).poisson_ratio, 0.25, atol=1e-6) and wet.at(0.3).poisson_ratio == 0.35
    assert soil_keys.names(ground) == {"young_modulus", "poisson_ratio"}
    depth(ground)
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert "keys" in report["parameters"]["soils"][1]


def test_a_walker_that_gets_heavier_presses_deeper(folder):
    ground, armature = scene(folder, frames=16)
    armature.desire_path.mass = 70.0
    light = depth(ground)
    key(armature, "desire_path.mass", [(1, 70.0), (16, 70.0)])
    assert ground.desire_path.bake_state == "FRESH" and depth(ground) == light
    for point in soil_keys._curves(armature, "desire_path.")["mass"].keyframe_points:
        point.co.y = 140.0
    assert ground.desire_path.bake_state == "OUTDATED"
    assert 1.2 < depth(ground) / light < 2.1
    assert ground.desire_path.bake_state == "FRESH"


def leader(keys):
    """An object whose place along X is keyed, for drivers to follow."""
    obj = meshes.link(bpy.data.objects.new("Leader", None))
    for frame, x in keys:
        obj.location.x = x
        obj.keyframe_insert("location", index=0, frame=frame)
    for curve in compat.curves_played(obj.animation_data):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    return obj


def drive(owner, name, leading, expression):
    driver = owner.driver_add(name).driver
    variable = driver.variables.new()
    variable.name, variable.targets[0].id, variable.targets[0].data_path = "x", leading, "location.x"
    driver.expression = expression
    return driver


def shown(frame):
    bpy.context.scene.frame_set(frame)


def test_a_soil_that_a_driver_leads_is_pressed_as_it_is_at_each_time_whatever_frame_is_shown(folder):
    ground, _ = scene(folder, frames=16)
    ground.desire_path.soil = "soil"
    depth(ground)
    driver = drive(ground.desire_path.soil_numbers, "young_modulus", leader([(1, 1.25), (16, 125.0)]), "x * 1e6")
    for frame in (9, 2):
        shown(frame)
        assert ground.desire_path.bake_state == "OUTDATED"
    (found,) = soil_keys.of_ground(bpy.context.scene, ground, 1, 16)
    assert np.isclose(found.at(0.0).young_modulus, 1.25e6, rtol=1e-5)
    assert np.isclose(found.at(15 / 24).young_modulus, 1.25e8, rtol=1e-5)
    assert np.isclose(found.at(7.5 / 24).young_modulus, 0.5 * (1.25e6 + 1.25e8), rtol=1e-3)
    first = depth(ground)
    for frame in (1, 5, 16, 40):
        shown(frame)
        assert ground.desire_path.bake_state == "FRESH", frame
        assert depth(ground) == first
    driver.expression = "x * 2e6"
    assert ground.desire_path.bake_state == "OUTDATED"
    depth(ground)
    assert ground.desire_path.bake_state == "FRESH"
    bpy.data.objects["Leader"].location.y = 3.0  # has no part in it
    assert ground.desire_path.bake_state == "FRESH"


def test_drivers_that_ask_the_scene_lead_soils_and_masses_and_who_is_seen(folder):
    ground, rig = scene(folder, frames=16)
    now = bpy.context.scene
    now["rain"] = 1.25
    now.keyframe_insert('["rain"]', frame=1)
    now["rain"] = 125.0
    now.keyframe_insert('["rain"]', frame=16)
    for curve in compat.curves_played(now.animation_data):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    for owner, name, path, expression in (
        (ground.desire_path.soil_numbers, "young_modulus", '["rain"]', "x * 1e6"),
        (rig.desire_path, "mass", "frame_current", "x + 70.0"),
        (rig, "hide_render", "frame_current", "x > 8"),
    ):
        driver = owner.driver_add(name).driver
        variable = driver.variables.new()
        variable.name, variable.targets[0].id_type = "x", "SCENE"
        variable.targets[0].id, variable.targets[0].data_path = now, path
        driver.expression = expression
    shown(5)
    (found,) = soil_keys.of_ground(now, ground, 1, 16)
    assert np.isclose(found.at(0.0).young_modulus, 1.25e6, rtol=1e-5)
    assert np.isclose(found.at(15 / 24).young_modulus, 1.25e8, rtol=1e-5)
    gait = sample.record(now, rig, 1, 16)
    assert np.isclose(soil_keys.weighed(now, gait, rig, 16).mass_keys[0][-1][1], 86.0)
    assert private.off_in_renders(now, rig, [1.0, 8.0, 9.0, 16.0]) == [False, False, True, True]
    assert now.frame_current == 5


def test_painted_soils_in_strips_and_masses_with_drivers_count_at_each_time(folder):
    ground, armature = scene(folder, frames=16)
    paint(ground)
    key(ground, "desire_path.painted[0].soil_numbers.young_modulus", [(1, 1e5), (16, 1e6)])
    data = ground.animation_data
    action, slot = data.action, getattr(data, "action_slot", None)
    data.action = None
    strip = data.nla_tracks.new().strips.new("wetter", 1, action)
    if slot is not None and strip.action_slot is None:
        strip.action_slot = slot
    drive(armature.desire_path, "mass", leader([(1, 70.0), (16, 140.0)]), "x")
    own, wet = soil_keys.of_ground(bpy.context.scene, ground, 1, 16)
    assert isinstance(own, Soil)
    assert np.isclose(wet.at(0.0).young_modulus, 1e5, rtol=1e-5)
    assert np.isclose(wet.at(15 / 24).young_modulus, 1e6, rtol=1e-5)
    assert moves.frame_range(bpy.context.scene, armature) == (1, 16)  # what leads a mass moves nobody
    gait = sample.gaits(bpy.context.scene, [armature], 1, 16)
    ((first, *_, last),) = gait.mass_keys
    assert gait.mass.tolist() == [70.0] and first == (0.0, 70.0) and np.allclose(last, (15 / 24, 140.0))
    for frame in (3, 12):
        shown(frame)
        depth(ground)
        shown(frame + 1)
        assert ground.desire_path.bake_state == "FRESH"


def test_layers_that_keys_or_drivers_lead_are_refused_where_they_change(folder):
    ground, armature = scene(folder, frames=16)
    bpy.ops.object.desire_path_layer_add()
    layer = ground.desire_path.layers[0]
    key(ground, "desire_path.layers[0].thickness", [(1, 0.02), (16, 0.2)])
    drive(layer.soil_numbers, "young_modulus", leader([(1, 1.0), (16, 9.0)]), "x * 1e5")
    for frame in (12, 3):
        shown(frame)
        ((soil, thickness),) = soil_keys.laid(ground)
        assert np.isclose(thickness, 0.02) and np.isclose(soil.young_modulus, 1e5)
        meshes.activate(ground)
        try:
            bpy.ops.object.desire_path_bake()
        except RuntimeError as problem:
            assert "change between frames 1 and 16, by keys or drivers" in str(problem)
        else:
            raise AssertionError("layers that change were taken")
        assert not (folder / "bake").exists()
    ground.animation_data.drivers[0].mute = True
    (curve,) = compat.curves_played(ground.animation_data)
    for point in curve.keyframe_points:
        point.co.y = 0.02
    depth(ground)  # keys that change nothing
    shown(15)
    assert ground.desire_path.bake_state == "FRESH"


def test_what_cannot_change_and_what_does_not_count_is_told(folder):
    ground, _ = scene(folder, frames=16)
    assert soil_keys.uncounted([ground], False) == []
    key(ground, "desire_path.soil_numbers.grain_size", [(1, 0.01), (16, 0.1)])
    try:
        bpy.ops.object.desire_path_bake()
    except RuntimeError as problem:
        assert "grain_size cannot change over time" in str(problem)
    else:
        raise AssertionError("a grain that changes was taken")
    assert "is a pass: they are as at frame 1." in soil_keys.uncounted([ground], True)[0]
    Soil().save(folder / "mine.json")
    ground.desire_path.soil_file = str(folder / "mine.json")
    assert any("soil file" in each for each in soil_keys.uncounted([ground], False))
