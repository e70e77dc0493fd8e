"""Soils that artists write: numbers in the panel, files, painted soils with numbers of their own."""

import json
import os
from dataclasses import replace

import bpy
import numpy as np
from test_bake import refused, scene

from desire_path.blender import ground as grounds
from desire_path.blender import soil_presets, soils
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
    # a foot that rolls stands less long on each place, and these skate at half their pace: what is soft is pushed ahead
    assert 1.45 < soft / firm < 2.2, (soft, firm)
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
    assert report["parameters"]["soils"] == [mine.parameters()]
    (folder / "mine.json").write_text('{"desire_path_soil": 1, "young_modulus": -3}')
    refused(bpy.ops.object.desire_path_bake, "young_modulus")
    settings.soil_file = str(folder / "none.json")
    refused(bpy.ops.object.desire_path_bake, "There is no soil at")
    settings.soil = "snow"
    assert settings.soil_file == "" and soils.soil_of(settings) is SOILS["snow"]


def paint(ground):
    """Mud on the first points of the active ground; the settings of what is painted."""
    ground.vertex_groups.new(name="wet").add(range(20), 1.0, "REPLACE")
    bpy.ops.object.desire_path_paint_add()
    painted = ground.desire_path.painted[0]
    painted.vertex_group, painted.soil = "wet", "mud"
    return painted


def test_painted_soils_have_numbers_of_their_own(folder):
    ground, _ = scene(folder, frames=16)
    painted = paint(ground)
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
    settings.soil_numbers.heave, settings.soil_numbers.changed = 0.0, False  # as the preset was once
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "a.blend"))
    settings = bpy.data.objects[name].desire_path
    assert settings.soil_numbers.heave == np.float32(SOILS["mud"].heave) and not settings.soil_numbers.changed


def test_the_words_name_every_number():
    assert list(soils.WORDS) == list(Soil.__dataclass_fields__)


def test_words_of_people_stand_for_the_numbers(folder):
    ground, _ = scene(folder, frames=16)
    settings = ground.desire_path
    numbers = settings.soil_numbers
    settings.soil = "dry-sand"
    assert numbers.rim == 1.0 and np.isclose(numbers.crumble, 1.0 - 34.0 / 90.0) and 0.2 < numbers.softness < 0.5
    before = numbers.young_modulus
    numbers.softness += 0.1
    assert numbers.changed and np.isclose(before / numbers.young_modulus, 10**0.24, rtol=1e-4)
    numbers.rim, numbers.crumble, numbers.lump_size = 0.5, 0.5, 0.005
    mine = soils.soil_of(settings)
    assert np.isclose(mine.poisson_ratio, 0.25) and np.isclose(mine.wall_angle, np.pi / 4) and mine.grain_size == 0.005
    numbers.softness = 1.0
    assert np.isclose(numbers.young_modulus, 1e5) and numbers.softness == 1.0


def test_lengths_and_masses_are_shown_in_the_scenes_units(folder):
    ground, walker = scene(folder, frames=16)
    bpy.context.scene.unit_settings.scale_length = 0.01  # a unit is a centimetre
    settings = ground.desire_path
    settings.cell_length = 0.5  # units, as 5mm comes from the panel
    assert settings.cell_size == np.float32(0.005) and np.isclose(settings.cell_length, 0.5)
    settings.soil_numbers.loose_layer = 20.0
    assert np.isclose(settings.soil_numbers.layer_depth, 0.2)
    walker.desire_path.mass = 80.0
    assert np.isclose(walker.desire_path.weight, 80.0e6)  # Blender shows a mass times the scale cubed
    walker.desire_path.weight = 70.0e6
    assert np.isclose(walker.desire_path.mass, 70.0)


def test_a_soil_of_ones_own_is_kept_by_name_and_taken_by_another(folder):
    before = os.environ.get("BLENDER_USER_SCRIPTS")
    os.environ["BLENDER_USER_SCRIPTS"] = str(folder / "scripts")
    (folder / "scripts").mkdir()
    try:
        ground, _ = scene(folder, frames=16)
        settings = ground.desire_path
        settings.soil = "mud"
        settings.soil_numbers.softness = 0.9
        mine = soils.soil_of(settings)
        assert bpy.ops.object.desire_path_soil_preset_add(name="Bog") == {"FINISHED"} and settings.soil_name == "Bog"
        path = soil_presets.path_of("Bog")
        assert Soil.load(path) == mine and os.path.dirname(path) in bpy.utils.preset_paths(soil_presets.FOLDER)
        ground.vertex_groups.new(name="wet").add(range(20), 1.0, "REPLACE")
        bpy.ops.object.desire_path_paint_add()
        assert bpy.ops.object.desire_path_soil_load(filepath=path, painted=True) == {"FINISHED"}
        assert near(soils.soil_of(settings.painted[0]), mine) and settings.painted[0].soil_name == "Bog"
        settings.soil = "snow"
        assert settings.soil_name == "" and soils.soil_of(settings) is SOILS["snow"]
        assert bpy.ops.object.desire_path_soil_load(filepath=path) == {"FINISHED"}
        assert near(soils.soil_of(settings), mine)
        assert bpy.ops.object.desire_path_soil_preset_remove() == {"FINISHED"}
        assert not os.path.exists(path) and near(soils.soil_of(settings), mine)
        refused(bpy.ops.object.desire_path_soil_preset_remove, "No soil of your own is chosen")
        refused(bpy.ops.object.desire_path_soil_preset_add, "cannot name a soil", name="../x")
        refused(bpy.ops.object.desire_path_soil_preset_add, "cannot name a soil", name="")
    finally:
        if before is None:
            del os.environ["BLENDER_USER_SCRIPTS"]
        else:
            os.environ["BLENDER_USER_SCRIPTS"] = before
