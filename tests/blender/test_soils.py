"""Soils that artists write: numbers in the panel, files, painted soils with numbers of their own."""

import json
from dataclasses import replace

import bpy
import numpy as np
from test_bake import refused, scene

from desire_path.blender import ground as grounds
from desire_path.blender import soils
from desire_path.ground.soil import SOILS, Soil


def baked(ground):
    bpy.ops.object.desire_path_bake()
    return json.loads(ground.desire_path.summary)["deepest_m"]


def near(soil, other):
    return all(np.isclose(getattr(soil, name), getattr(other, name), rtol=1e-6) for name in soils.WORDS)


def test_a_preset_is_shown_by_its_numbers_and_kept_to_the_bit(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    for name in SOILS:
        settings.soil = name
        assert soils.soil_of(settings) is SOILS[name] and not settings.soil_numbers.changed
        for number in soils.WORDS:
            assert getattr(settings.soil_numbers, number) == np.float32(getattr(SOILS[name], number)), (name, number)


def test_half_as_stiff_is_twice_as_deep(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "soil"
    firm = baked(ground)
    settings.soil_numbers.young_modulus = 0.5 * SOILS["soil"].young_modulus
    assert settings.soil_numbers.changed and settings.bake_state == "OUTDATED"
    soft = baked(ground)
    assert 1.6 < soft / firm < 2.2, (soft, firm)  # a foot that rolls stands less long on each place
    assert settings.bake_state == "FRESH", settings.missing
    settings.soil = "soil"  # chosen again: as it was
    assert not settings.soil_numbers.changed and baked(ground) == firm


def test_a_soil_is_saved_and_taken_from_a_file(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "mud"
    settings.soil_numbers.layer_depth = 0.15
    mine = soils.soil_of(settings)
    assert near(mine, replace(SOILS["mud"], layer_depth=0.15))
    assert bpy.ops.object.desire_path_soil_save(filepath=str(folder / "mine.json")) == {"FINISHED"}
    assert Soil.load(folder / "mine.json") == mine
    settings.soil = "snow"
    settings.soil_file = str(folder / "mine.json")
    assert grounds.soils(ground) == [mine]
    baked(ground)
    report = json.loads((folder / "bake" / "report.json").read_text())
    assert report["parameters"]["soils"] == [mine.told()]
    (folder / "mine.json").write_text('{"desire_path_soil": 1, "young_modulus": -3}')
    refused(bpy.ops.object.desire_path_bake, "young_modulus")
    settings.soil_file = str(folder / "none.json")
    refused(bpy.ops.object.desire_path_bake, "There is no soil at")
    settings.soil = "snow"
    assert settings.soil_file == "" and soils.soil_of(settings) is SOILS["snow"]


def test_painted_soils_have_numbers_of_their_own(folder):
    ground, _ = scene(folder, frames=16)
    ground.vertex_groups.new(name="wet").add(range(20), 1.0, "REPLACE")
    bpy.ops.object.desire_path_paint_add()
    painted = ground.desire_path.painted[0]
    painted.vertex_group, painted.soil = "wet", "mud"
    painted.soil_numbers.settle_time = 0.5
    own, wet = grounds.soils(ground)
    assert own is SOILS["dry-sand"] and near(wet, replace(SOILS["mud"], settle_time=0.5))


def test_files_of_before_show_their_preset(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    settings.soil = "mud"
    settings.soil_numbers.young_modulus, settings.soil_numbers.changed = 1.0, False  # as if they had not been there
    name = ground.name
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    settings = bpy.data.objects[name].desire_path
    assert settings.soil_numbers.young_modulus == SOILS["mud"].young_modulus and not settings.soil_numbers.changed


def test_the_words_name_every_number():
    assert list(soils.WORDS) == list(Soil.__dataclass_fields__)
