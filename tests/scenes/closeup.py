"""closeup.py - what a boot leaves in one soil after another, close by, under a low sun.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/closeup.py -- FOLDER
        [--width 480 --height 270 --samples 64 --soils dry-sand,mud@5]

Writes FOLDER/SOIL.png. A recorded walker in boots with lugs crosses even ground of 2 mm cells, 5 mm in snow, or of as
many as stand behind the soil's name, shown with details of 2 mm and the material that Make Material gives it: all of it
by the operators an animator presses.
"""

import math
import os
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import demo, mannequin, materials, meshes, noise, people, shots  # noqa: E402

SOILS = ("deep-snow", "fresh-snow", "crust-snow", "dry-sand", "wet-sand", "mud", "wet-soil", "packed-earth", "soil")
CELL, DETAIL = 2.0, 0.002  # [mm], [m]
DRIFT = 5.0  # cells of snow, which shows no grooves but walls [mm]
LUG = 0.005  # how high the lugs of the sole stand [m]
LENGTH = 0.31  # of the sole [m]
STEPS = (140, 400)  # frames of the clip, at 120 a second: the foot that is looked for has left its print by then
# what a soil's name says: height of waves [m], the sun above the horizon and round it [degrees], exposure [stops]
LIGHT = {
    "snow": (0.006, 24.0, 44.0, 0.15),
    "sand": (0.003, 18.0, 104.0, 0.1),
    "mud": (0.005, 24.0, 104.0, 0.85),
    "wet-soil": (0.004, 24.0, 104.0, 0.6),
    "earth": (0.004, 24.0, 104.0, 0.2),
    "soil": (0.004, 20.0, 104.0, 0.4),
}


def setting(soil):
    return next(each for word, each in LIGHT.items() if word in soil)


def boot():
    """A sole with lugs under a left foot, the way the walker goes being -y."""
    step = 0.002
    share, inner, outer = mannequin.LAST[:, 0], mannequin.LAST[:, 1], mannequin.LAST[:, 2]
    along, aside = np.meshgrid(np.arange(0.0, LENGTH, step), np.arange(-0.07, 0.07, step), indexing="ij")
    u = along / LENGTH
    # how far from the rim; the inner side of a left foot lies to the right of the way it goes
    rim = np.minimum(np.interp(u, share, outer) * LENGTH - aside, aside + np.interp(u, share, inner) * LENGTH)
    rim = np.minimum(rim, np.minimum(along, LENGTH - along))
    bar = (along + 0.35 * abs(aside)) % 0.030 < 0.021  # bars bent in the middle
    split = abs(aside) > 0.004
    edge = (rim < 0.014) & ((along % 0.030) < 0.021)
    heel = (u < 0.27) & (rim < 0.016)
    inside = (rim > 0.021) & bar & split & ~((u > 0.27) & (u < 0.40))
    high = np.where(inside | edge | heel, 0.0, LUG)
    high += 0.012 * np.clip((u - 0.80) / 0.20, 0.0, 1.0) ** 2 + 0.004 * np.clip(1.0 - u / 0.08, 0.0, 1.0) ** 2
    mesh = bpy.data.meshes.new("Boot")
    at = np.arange(u.size).reshape(u.shape)
    keep = rim > 0.0
    keep = keep[:-1, :-1] & keep[1:, :-1] & keep[:-1, 1:] & keep[1:, 1:]
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], -1)[keep]
    used, quads = np.unique(quads, return_inverse=True)
    points = np.stack([aside, -along, high], -1).reshape(-1, 3)[used]
    mesh.from_pydata(points.tolist(), [], quads.reshape(-1, 4).tolist())
    mesh.update()
    obj = meshes.link(bpy.data.objects.new("Boot", mesh))
    obj.hide_render = True
    return obj


def walker():
    """The clip as it was recorded, in metres; and where a left foot stands [m]."""
    obj = people.bvh(demo.WALK, global_scale=demo.UNIT)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = STEPS
    ankle = []
    for frame in range(STEPS[0] + 30, STEPS[1] - 30, 2):
        scene.frame_set(frame)
        ankle.append(obj.matrix_world @ obj.pose.bones["LeftFoot"].head)
    ankle = np.array(ankle)
    stands = np.linalg.norm(np.diff(ankle, axis=0), axis=1)
    k = int(np.convolve(stands, np.ones(9), "same")[5:-5].argmin()) + 5
    return obj, ankle[k], float(ankle[:, 2].min()) - mannequin.ANKLE


def scene_of(soil, cell):
    """One soil with the prints in it, in cells of so many millimetres; returns where to look [m]."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    armature, stands, floor = walker()
    wave = setting(soil)[0]

    def height(x, y):
        return floor + wave * (noise.rough(x, y, 0.45, 5) + 0.35 * noise.rough(x, y, 0.11, 7, octaves=2))

    x, y = float(stands[0]), float(stands[1])
    spread = demo.lines(-0.6, 0.6, 0.02, 12.0, 1.12)
    ground = demo.add_mesh(x + spread, y + demo.lines(-2.0, 2.0, 0.02, 12.0, 1.12), height)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size, settings.detail_size = soil, 0.001 * cell, DETAIL
    settings.folder = os.path.join(bpy.app.tempdir, "bake")
    meshes.activate(armature)
    bpy.ops.object.desire_path_walker_add()
    armature.desire_path.mass, armature.desire_path.sole, armature.desire_path.ground = demo.MASS, boot(), ground
    meshes.activate(ground)
    settings.frame_start, settings.frame_end = STEPS
    bpy.ops.object.desire_path_bake()
    bpy.ops.object.desire_path_material_add()
    print(soil, settings.summary)
    scene.frame_set(scene.frame_end)
    return Vector((x, y - 0.08, float(height(x, y))))


def light_and_camera(scene, soil, at):
    sun = demo.add_sun()
    up, turn = (math.radians(each) for each in setting(soil)[1:3])
    sun.location = at + 5.0 * Vector((math.cos(turn) * math.cos(up), math.sin(turn) * math.cos(up), math.sin(up)))
    demo.aim(sun, at)
    materials.sky(scene)
    scene.camera = demo.add_camera("Close", at + Vector((0.41, 0.15, 0.35)), at + Vector((0.0, 0.01, -0.02)), 46.0)
    scene.camera.data.clip_start = 0.01
    demo.cycles(scene)
    scene.cycles.use_fast_gi = False  # a hollow in snow is lit by its own walls
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 5, 4
    scene.view_settings.exposure = setting(soil)[3]


def make(name):
    soil, _, cell = name.partition("@")
    at = scene_of(soil, float(cell or (DRIFT if "snow" in soil else CELL)))
    light_and_camera(bpy.context.scene, soil, at)


if __name__ == "__main__":
    shots.take(__doc__, "--soils", SOILS, make, (480, 270, 64))
