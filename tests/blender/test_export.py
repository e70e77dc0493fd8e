"""What was baked is written for other programs, which read the same ground."""

import json

import bpy
import numpy as np
from scenes import meshes
from test_bake import refused
from test_bake_all import land
from test_trails import meadow

from desire_path.blender import compat
from desire_path.ground import maps

EXPORT = bpy.ops.wm.desire_path_export


def now(folder):
    """(heights, x, y) after a bake, row 0 at the lowest y [m]."""
    picture = maps.read(folder / "maps_final.exr")
    planes, notes = picture.planes, picture.notes
    heights = planes["rest"] - planes["compression"] + planes["heap"]
    ny, nx = heights.shape
    x, y = (notes[name] + notes["cell"] * (np.arange(n) + 0.5) for name, n in (("originX", nx), ("originY", ny)))
    return heights, x, y


def has_usd():
    try:
        with compat.bundled_modules():
            from pxr import Usd  # noqa: F401
    except ImportError:
        return False
    return True


def world_points(obj):
    found = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = compat.positions(found.to_mesh())
    matrix = np.array(found.matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def test_heights_are_exported(folder):
    beach, _ = land("Beach", 0.0, folder)
    meshes.activate(beach)
    path = folder / "trail.png"
    refused(EXPORT, "bake it first", filepath=str(path))
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    for name, kind in (
        ("", "HEIGHT16"),
        (str(folder / "trail.tif"), "HEIGHT16"),
        (str(path), "USD"),
        (str(path), "ALEMBIC"),
    ):
        if kind == "HEIGHT16" or (has_usd() if kind == "USD" else bpy.app.build_options.alembic):
            refused(EXPORT, "ends with", format=kind, filepath=name)
    assert EXPORT(format="HEIGHT16", filepath=str(path)) == {"FINISHED"}
    told = json.loads((folder / "trail.json").read_text(encoding="utf-8"))
    picture = bpy.data.images.load(str(path))
    assert tuple(picture.size) == (told["columns"], told["rows"])
    heights, _, _ = now(folder / "Beach")
    assert (told["rows"], told["columns"]) == heights.shape
    assert abs(told["lowest"] - np.nanmin(heights)) < 1e-6 and abs(told["highest"] - np.nanmax(heights)) < 1e-6
    assert told["lowest"] < 0.0 < told["highest"]


def test_a_stage_is_read_by_blender(folder):
    ground, _ = meadow(folder)
    ground.desire_path.plant_mesh = True
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    path = folder / "trail.usdc"
    if not has_usd():
        refused(EXPORT, "usd-core", format="USD", filepath=str(path))
        assert not path.exists()
        return
    assert EXPORT(format="USD", filepath=str(path)) == {"FINISHED"}
    heights, x, y = now(folder / "bake")
    before = set(bpy.data.objects)
    assert bpy.ops.wm.usd_import(filepath=str(path)) == {"FINISHED"}
    found = {each.name.split(".")[0]: each for each in set(bpy.data.objects) - before}
    points = world_points(found["Ground"])
    there = np.isfinite(heights)
    wanted = np.stack([*np.meshgrid(x, y), heights], -1)[there]
    assert points.shape == wanted.shape and np.abs(points - wanted).max() < 1e-5
    planes = maps.read(folder / "bake" / "maps_final.exr").planes
    for name in ("compression", "plant_strength"):
        values = np.empty(len(points), np.float32)
        found["Ground"].data.attributes[name].data.foreach_get("value", values)
        assert np.array_equal(values, planes[name][there]), name
    assert "Plants" in found


def test_alembic_moves_as_the_bake_does(folder):
    ground, _ = meadow(folder)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    scene, path = bpy.context.scene, folder / "trail.abc"
    scene.frame_start, scene.frame_end = 1, 24
    if not bpy.app.build_options.alembic:
        refused(EXPORT, "without Alembic", format="ALEMBIC", filepath=str(path))
        return
    scene.frame_set(7)
    chosen = list(bpy.context.selected_objects)
    assert EXPORT(format="ALEMBIC", filepath=str(path)) == {"FINISHED"}
    assert scene.frame_current == 7 and bpy.context.selected_objects == chosen and bpy.context.object == ground
    wanted = {}
    for frame in (1, 12, 24):
        scene.frame_set(frame)
        wanted[frame] = world_points(ground)
    before = set(bpy.data.objects)
    assert bpy.ops.wm.alembic_import(filepath=str(path)) == {"FINISHED"}
    mine = [
        each for each in set(bpy.data.objects) - before if each.type == "MESH" and each.name.startswith(ground.name)
    ]
    found = next(each for each in mine if len(each.data.vertices) == len(ground.data.vertices))
    for frame, points in wanted.items():
        scene.frame_set(frame)
        assert np.abs(world_points(found) - points).max() < 1e-5, frame
    assert np.abs(wanted[24] - wanted[1]).max() > 0.004
    assert sorted(each.name for each in folder.iterdir()) == ["bake", "trail.abc"]


def test_a_hidden_ground_is_not_written(folder):
    beach, _ = land("Beach", 0.0, folder)
    meshes.activate(beach)
    assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    if bpy.app.build_options.alembic:
        beach.hide_set(True)
        bpy.context.view_layer.objects.active = beach
        refused(EXPORT, "show it first", format="ALEMBIC", filepath=str(folder / "a.abc"))
