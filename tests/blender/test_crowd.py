"""Crowds between empties: their last ways become curves on the ground, and what cannot be is told."""

import os

import bpy
import numpy as np
from scenes import meshes

from desire_path.blender import crowd
from desire_path.ground import maps


def field():
    land = meshes.grid(9, 9, 2.5, -10.0, -10.0)
    land.name = "Ground"
    land.desire_path.is_ground = True
    return land


def place(x, y, name="Gate"):
    obj = bpy.data.objects.new(name, None)
    bpy.context.collection.objects.link(obj)
    obj.location = (x, y, 0.0)
    bpy.context.view_layer.update()
    return obj


def select(*objects):
    for each in bpy.context.scene.objects:
        each.select_set(each in objects)
    bpy.context.view_layer.objects.active = objects[0]


def add(*objects, **more):
    select(*objects)
    return bpy.ops.object.desire_path_crowd_add(**more)


def refused(words, *objects, **more):
    try:
        add(*objects, **more)
    except RuntimeError as problem:
        assert words in str(problem), problem
        assert str(problem).count("\n") <= 1, problem
        return
    raise AssertionError(f"nobody said: {words}")


def places_of(obj):
    return [np.array([point.co[:3] for point in spline.points]) for spline in obj.data.splines]


def test_a_crowd_leaves_its_ways_as_curves_and_the_cover_in_files(folder):
    land, pond = field(), meshes.grid(2, 2, 4.0, -2.0, -2.0)
    gates = [place(-9.0, -8.0), place(9.0, 8.0), place(-8.0, 7.0)]
    gates[2]["rate"] = 0.5
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "park.blend"))
    assert add(*gates, pond, passages=150, ground="snow-25") == {"FINISHED"}
    shown = bpy.data.objects["Ground Crowd"]
    ways = places_of(shown)
    assert len(ways) == crowd.SHOWN and shown.type == "CURVE"
    points = np.concatenate(ways)
    assert np.allclose(points[:, 2], crowd.ABOVE, atol=1e-5)
    assert not ((np.abs(points[:, :2]) < 1.9).all(axis=1)).any()  # round what stands in the way
    ends = np.array([obj.location[:2] for obj in gates])
    for way in ways:
        near = [np.linalg.norm(ends - end, axis=1).min() for end in (way[0, :2], way[-1, :2])]
        assert max(near) < 0.7, near
    cover = maps.read(os.path.join(crowd.folder_of(land), "cover_final.exr"))
    assert cover.planes["cover"].min() < 0.1 and (cover.notes["originX"], cover.notes["originY"]) == (-10.0, -10.0)
    assert add(*gates, passages=20, seed=3) == {"FINISHED"}
    assert len(places_of(shown)) == 20 and "Ground Crowd.001" not in bpy.data.objects


def test_what_cannot_be_walked_is_told(folder):
    gate = place(0.0, 0.0)
    refused("has no ground", gate, place(1.0, 1.0))
    land = field()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "park.blend"))
    refused("select two empties", gate)
    refused("lies outside the ground", gate, place(30.0, 1.0))
    wall = meshes.grid(2, 2, 1.0, -0.5, -0.5)
    refused("lies in an obstacle", gate, place(5.0, 5.0), wall)
    other = meshes.grid(2, 2, 1.0, 20.0, 20.0)
    other.desire_path.is_ground = True
    refused("several grounds", gate, place(5.0, 5.0))
    assert add(gate, place(5.0, 5.0), land, passages=5) == {"FINISHED"}
    assert not bpy.ops.object.desire_path_crowd_add.poll() or bpy.context.object.type == "EMPTY"
