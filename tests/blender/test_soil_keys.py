"""Keys on the numbers of soils and on masses count over the time of a bake."""

import json
from dataclasses import replace

import bpy
import numpy as np
from test_bake import scene

from desire_path.blender import soil_keys
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
    ground.vertex_groups.new(name="wet").add(range(20), 1.0, "REPLACE")
    bpy.ops.object.desire_path_paint_add()
    painted = ground.desire_path.painted[0]
    painted.vertex_group, painted.soil = "wet", "mud"
    key(ground, "desire_path.painted[0].soil_numbers.softness", [(1, 0.5), (9, 1.0)])
    key(ground, "desire_path.soil_numbers.rim", [(1, 0.0), (9, 1.0)])
    own, wet = soil_keys.of_ground(bpy.context.scene, ground, 1, 16)
    assert np.isclose(wet.at(0.0).young_modulus, 1e6, rtol=1e-5)
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


def test_what_cannot_change_and_what_does_not_count_is_told(folder):
    ground, armature = scene(folder, frames=16)
    ground.desire_path.soil_numbers.driver_add("rest_angle")
    armature.desire_path.driver_add("mass")
    uncounted = soil_keys.uncounted([ground], [armature], False)
    assert len(uncounted) == 2 and all("as it is now" in each for each in uncounted)
    key(ground, "desire_path.soil_numbers.grain_size", [(1, 0.01), (16, 0.1)])
    try:
        bpy.ops.object.desire_path_bake()
    except RuntimeError as problem:
        assert "grain_size cannot change over time" in str(problem)
    else:
        raise AssertionError("a grain that changes was taken")
    assert "is a pass" in soil_keys.uncounted([ground], [armature], True)[0]
    Soil().save(folder / "mine.json")
    ground.desire_path.soil_file = str(folder / "mine.json")
    assert any("soil file" in each for each in soil_keys.uncounted([ground], [armature], False))
