"""A ground's memory limit is kept to, and one that is too low is refused with the number that would do."""

import re
from pathlib import Path

import bpy
from scenes import meshes
from test_bake import refused, scene

from desire_path.bake.bake import read_index
from desire_path.blender import home


def files(ground):
    """The frames of a bake, and its last maps."""
    place = Path(home.folder(ground))
    return [path.read_bytes() for path in (*sorted(place.glob("frames/trail_*.exr")), place / "maps_final.exr")]


def test_the_limit_of_a_ground_is_kept_to(folder):
    ground, _ = scene(frames=8)
    meshes.activate(ground)
    ground.desire_path.memory_limit = 0.02
    text = refused(bpy.ops.object.desire_path_bake, "cannot be done in 20 MB of memory", "give at least")
    assert not Path(home.folder(ground)).joinpath("frames").exists()
    size, unit = re.search(r"at least ([\d.,]+) (GB|MB)", text).groups()
    enough = float(size.replace(",", "")) * {"GB": 1.0, "MB": 1e-3}[unit]
    ground.desire_path.memory_limit = 1.2 * enough
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    held = files(ground)
    assert len(held) == 10 and read_index(home.folder(ground)).complete
    assert not list(Path(home.folder(ground)).rglob("memory*"))
    ground.desire_path.memory_limit = 0.0
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    assert files(ground) == held
