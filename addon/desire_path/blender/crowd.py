"""crowd.py - a crowd goes between empties over a ground, and its last ways become curves.

empties, meshes in the way, ground --Scene--> Crowd --paths.csv--> a curve object
"""

import os

import bpy
import numpy as np
from mathutils.geometry import convex_hull_2d

from ..crowd import scene as scenes
from ..crowd.covers import as_cover
from ..crowd.crowd import PATHS, Crowd
from ..errors import DesirePathError
from . import axes, compat, home, track
from .chosen import grounds

SHOWN = 100  # ways that become curves, the last ones
ABOVE = 0.02  # they are shown so high over the ground [m]
FINE = 200  # cells along the shorter side of a ground, where they are not as wide as they may be
WIDE = 0.03  # of that side is the circle of a place


def choose_ground(scene, chosen):
    """The selected ground, or the only one; DesirePathError where there is none."""
    there = [obj for obj in chosen if obj in grounds(scene)] or grounds(scene)
    if len(there) != 1:
        raise DesirePathError(
            "There are several grounds: select the one of the crowd, too."
            if there
            else "The crowd has no ground: press Add Ground on a mesh first."
        )
    return there[0]


def _hull(obj, scale):
    """A mesh that stands in the way, as a shape: the outline of its places seen from above."""
    world = axes.points(axes.matrix(obj.matrix_world, obj.name), compat.positions(obj.data), scale)[:, :2]
    return {"polygon": world[convex_hull_2d(world.tolist())].tolist()}


def scene_of(scene, chosen, land, numbers):
    """(Scene, a Simulation of the ground) of the empties and meshes that were chosen."""
    scale = axes.unit_scale(scene)
    below = track.heights(track.surface_of(scene, land), land)
    x0, y0, x1, y1 = below.bounds()
    side = min(x1 - x0, y1 - y0)
    cell = float(np.clip(side / FINE, 0.05, scenes.MAX_CELL))
    empties = sorted((obj for obj in chosen if obj.type == "EMPTY"), key=lambda each: each.name)
    places = [
        {
            "name": obj.name.replace(",", " "),
            "at": [float(each) * scale for each in obj.matrix_world.translation[:2]],
            "rate": obj.get("rate", 1.0),
            "radius": float(np.clip(WIDE * side, 0.1, 1.25)),
        }
        for obj in empties
    ]
    if len(places) < 2:
        raise DesirePathError("A crowd goes between places: select two empties or more.")
    meshes = [obj for obj in chosen if obj.type == "MESH" and obj != land]
    given = scenes.of(
        {
            "size": [x1 - x0, y1 - y0],
            "origin": [x0, y0],
            "cell": cell,
            "places": places,
            "obstacles": [_hull(obj, scale) for obj in meshes if len(obj.data.vertices) > 2],
            **numbers,
        }
    )
    x, y = np.broadcast_arrays(*given.middles())
    return given.over(below.rest_height(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(given.shape)), below


def folder_of(land):
    """Where the paths and the cover of a ground's crowd lie."""
    return os.path.join(bpy.path.abspath(home.beside()), f"{bpy.path.clean_name(land.name)}_crowd")


def walk(scene, chosen, numbers, progress):
    """Let a crowd walk; returns (a sentence, the curves of its last ways)."""
    land = choose_ground(scene, chosen)
    given, below = scene_of(scene, chosen, land, {**numbers, "ground": as_cover(numbers["ground"])})
    folder = folder_of(land)
    report = Crowd(given, folder).run(progress)
    shown = _shown(scene, land, _last(os.path.join(folder, PATHS)), below)
    return (
        f"{report['passages']} passages on '{land.name}', detour {report['detour']:.2f}: the last ways are in "
        f"'{shown.name}', all of them and the cover in {folder}."
    ), shown


def _last(path):
    """The ways (n, 2) [m] of the last passages of a table."""
    ways = {}
    with open(path, encoding="utf-8") as file:
        next(file)
        for line in file:
            number, _, _, _, x, y = line.split(",")
            ways.setdefault(int(number), []).append((float(x), float(y)))
            if len(ways) > SHOWN:
                del ways[min(ways)]
    return [np.array(walked) for _, walked in sorted(ways.items()) if len(walked) > 1]


def _shown(scene, land, ways, below):
    """One curve object of all ways, in place of those that were shown before."""
    name, scale = f"{land.name} Crowd", axes.unit_scale(scene)
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    for walked in ways:
        height = np.nan_to_num(below.rest_height(walked)) + ABOVE
        spline = data.splines.new("POLY")
        spline.points.add(len(walked) - 1)
        flat = np.column_stack([walked / scale, height / scale, np.ones(len(walked))])
        spline.points.foreach_set("co", flat.astype(np.float32).ravel())
    old = scene.objects.get(name)
    if old is None or old.type != "CURVE" or old.library is not None:
        old = bpy.data.objects.new(name, data)
        scene.collection.objects.link(old)
        return old
    before, old.data = old.data, data
    if not before.users:
        bpy.data.curves.remove(before)
    return old
