"""Walkers who wade through deep snow: MODEL 3.9"""

import json

import bpy
import numpy as np
from test_bake import scene

from desire_path.ground import maps


def baked(folder):
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    planes = maps.read(folder / "bake" / "maps_final.exr").planes
    return json.loads((folder / "bake" / "report.json").read_text()), planes["compression"] - planes["heap"]


def test_feet_go_through_snow_where_they_are_told_to_wade(folder):
    ground, walker = scene(folder, cell=0.03)
    ground.desire_path.soil = "powder-snow"
    over, _ = baked(folder)
    assert over["parameters"]["walkers"] == [walker.name] and ground.desire_path.bake_state == "FRESH"
    walker.desire_path.wade = True
    assert ground.desire_path.bake_state == "OUTDATED"
    through, _ = baked(folder)
    assert through["parameters"]["walkers"] == [walker.name, f"{walker.name}'s legs"]
    assert ground.desire_path.bake_state == "FRESH"
    assert not [each for each in through["warnings"] if "legs" in each], through["warnings"]
    assert through["loosened_m3"] > over["loosened_m3"] + 5e-5  # what was in their way
    assert abs(through["deepest_m"] - over["deepest_m"]) < 0.01


def test_who_does_not_sink_is_baked_as_without(folder):
    ground, walker = scene(folder, cell=0.03)
    ground.desire_path.soil = "packed-earth"
    _, over = baked(folder)
    walker.desire_path.wade = True
    report, through = baked(folder)
    assert report["parameters"]["walkers"] == [walker.name] and np.array_equal(over, through)
