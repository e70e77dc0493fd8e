"""stands.py - figures whose prints can be reckoned by hand: soles of known shape on feet that are moved by
numbers, under a mass centre that stays where it is put. Baked by the public operators, read as users read.
"""

import json
import math
import os
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass, replace
from unittest import mock

import bpy
import mathutils
import numpy as np

from desire_path.blender import compat, playback_tree
from desire_path.ground import maps
from desire_path.ground import soil as soils

from . import gaits, meshes, plain

ASIDE = 0.15  # the left foot stands here on rest pose's x, the right one opposite [m]
ANKLE = 0.08  # height of the foot bones [m]
GRAVITY = 9.81


@contextmanager
def soil(name="dry-soil", **numbers):
    """A preset with some numbers changed, for as long as a test needs it."""
    with mock.patch.dict(soils._SOILS, {name: replace(soils.SOILS[name], **numbers)}):
        yield soils.SOILS[name]


@contextmanager
def plain_soils():
    """Presets with the numbers of the papers alone, for as long as prints are reckoned by hand."""
    with mock.patch.dict(soils._SOILS, plain.all_plain()):
        yield


def ground(cell=0.01, half=(0.6, 0.6), name="dry-soil", folder=None):
    """A level ground with a point on every cell's centre, even in number along x and y: so it is its own
    mirror image and its own quarter turn."""
    nx, ny = (2 * int(round(each / cell)) for each in half)
    obj = meshes.grid(nx, ny, cell, (0.5 - nx / 2) * cell, (0.5 - ny / 2) * cell)
    assert bpy.ops.object.desire_path_ground_add() == {"FINISHED"}
    obj.desire_path.cell_size, obj.desire_path.soil = cell, name
    if folder is not None:
        os.makedirs(folder, exist_ok=True)
        obj.desire_path.folder = tempfile.mkdtemp(dir=folder)  # one of its own: each scene is another file
    return obj


def figure(sides="LR", name="Stand"):
    """An armature of a hips bone and feet that hang on nothing, facing -Y."""
    obj = meshes.link(bpy.data.objects.new(name, bpy.data.armatures.new(name)))
    bpy.ops.object.mode_set(mode="EDIT")
    hips = obj.data.edit_bones.new("hips")
    hips.head, hips.tail = (0, 0, 1.0), (0, 0, 1.2)
    for side in sides:
        x = ASIDE if side == "L" else -ASIDE
        foot = obj.data.edit_bones.new("foot." + side)
        foot.head, foot.tail = (x, 0.06, ANKLE), (x, -0.09, ANKLE)
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in obj.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return obj


def mesh_of(sole, name="Sole", at=(ASIDE, 0.0, 0.0)):
    """A gait.Sole as a mesh object that lies at the left foot of the rest pose."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.asarray(sole.vertices, float).tolist(), [], np.asarray(sole.triangles).tolist())
    obj = meshes.link(bpy.data.objects.new(name, mesh))
    obj.location = at
    bpy.context.view_layer.update()
    return obj


def plate(width, length):
    """A flat sole, `width` [m] along x and `length` [m] along the foot."""
    return mesh_of(gaits.box(width, length))


def walks(obj, sole=None, mass=75.0):
    """Let a figure walk on the only ground, its weight over its hips bone."""
    meshes.activate(obj)
    assert bpy.ops.object.desire_path_walker_add() == {"FINISHED"}
    settings = obj.desire_path
    settings.mass, settings.mass_center = mass, "hips"
    settings.sole = sole
    return obj


def move(obj, bone, seconds, offset=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
    """Key a bone away from its rest place by `offset` [m] and `turn` (Euler XYZ) [rad] of the armature's
    axes at a time; the bone turns about the ground under it."""
    scene = bpy.context.scene
    pose = obj.pose.bones[bone]
    rest = pose.bone.matrix_local
    foot = rest.translation.copy()
    foot.z = 0.0
    pivot = mathutils.Matrix.Translation(foot)
    turned = pivot @ mathutils.Euler(turn).to_matrix().to_4x4() @ pivot.inverted()
    wanted = mathutils.Matrix.Translation(offset) @ turned @ rest
    pose.matrix_basis = rest.inverted() @ wanted
    frame = 1.0 + seconds * scene.render.fps / scene.render.fps_base
    pose.keyframe_insert("location", frame=frame)
    pose.keyframe_insert("rotation_quaternion", frame=frame)


@dataclass(frozen=True)
class Trail:
    """What a bake left, as the evaluated mesh shows it at its last frame."""

    report: dict
    cell: float
    rest: np.ndarray  # the ground's points before (ny, nx, 3)
    moved: np.ndarray  # and after (ny, nx, 3)
    compression: np.ndarray  # attributes of the mesh (ny, nx) [m]
    heap: np.ndarray
    pressure_time: np.ndarray

    @property
    def drop(self):
        """How far the mesh was pressed below its rest (ny, nx) [m]."""
        return self.rest[..., 2] - self.moved[..., 2]


def bake(obj, seconds=None, **settings):
    """Bake a ground of `ground()`, its soils plain, from frame 1 on and look at it; a point is a cell there."""
    own, scene = obj.desire_path, bpy.context.scene
    for name, value in settings.items():
        setattr(own, name, value)
    if seconds is not None:
        own.frame_start = 1
        own.frame_end = 1 + math.ceil(seconds * scene.render.fps / scene.render.fps_base - 1e-6)
    meshes.activate(obj)
    with plain_soils():
        assert bpy.ops.object.desire_path_bake() == {"FINISHED"}
    folder = bpy.path.abspath(own.folder)
    with open(folder + "/report.json", encoding="utf-8") as file:
        report = json.load(file)
    scene.frame_set(own.frame_end)
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    rest = compat.positions(obj.data)
    nx = int((np.abs(rest[:, 1] - rest[0, 1]) < 1e-6).sum())
    grid = lambda values: np.asarray(values, np.float64).reshape(-1, nx, *np.shape(values)[1:])
    final = {name: grid(compat.float_attribute(obj.data, name)) for name in ("compression", "heap", "pressure_time")}
    colour = grid(compat.colour_attribute(shown, playback_tree.ATTRIBUTE))
    assert (colour[..., 2] == final["compression"]).all()  # playback and final map are one ground
    return Trail(report, own.cell_size, grid(rest), grid(compat.positions(shown)), **final)


def planes(obj):
    """The final maps of a ground's bake as its EXR has them, name -> float32 (ny, nx)."""
    return maps.read(bpy.path.abspath(obj.desire_path.folder) + "/maps_final.exr").planes
