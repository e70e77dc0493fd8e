"""walkers.py - who leaves deep prints and who does not, side by side in snow and in sand. After SOFT22 Fig. 4.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/walkers.py -- FOLDER
        [--width 640 --height 360 --samples 48 --scenes snow,dry-sand]

Writes FOLDER/SOIL.png. From the left: a walker, a runner, one on snowshoes, one of 160 kg with feet to match, and one
of 22 kg. Recorded clips; each walks by the operator an animator presses.
"""

import math
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import demo, materials, meshes, noise, people, shots  # noqa: E402

CLIPS = {"walk": "cmu_12_01_walk.bvh", "run": "cmu_02_03_run.bvh"}
# who: clip, size, mass [kg]
WHO = (("walk", 1.0, 75.0), ("run", 1.0, 75.0), ("walk", 1.0, 75.0), ("walk", 1.3, 160.0), ("walk", 0.62, 22.0))
SHOD = 2  # who of them wears snowshoes
APART = 0.75  # their trails [m]
SHOE = (0.58, 0.21, 0.025)  # length, width and thickness of a snowshoe [m]
BACK = 0.09  # so far behind the middle of the foot is that of its snowshoe [m]
SOILS = {"snow": -0.6, "dry-sand": 0.3}  # and the exposure


def waves(x, y):
    return 0.008 * (noise.rough(x, y, 1.3, 5) + 0.3 * noise.rough(x, y, 0.3, 7, octaves=2))


def oval(length, width, thick, corners=48):
    """A flat closed oval along y, its underside at z = 0."""
    turn = np.linspace(0.0, 2.0 * math.pi, corners, endpoint=False)
    rim = np.stack([0.5 * width * np.sin(turn), 0.5 * length * np.cos(turn)], axis=1)
    places = [(*at, z) for z in (0.0, thick) for at in rim.tolist()]
    sides = [(k, (k + 1) % corners, (k + 1) % corners + corners, k + corners) for k in range(corners)]
    mesh = bpy.data.meshes.new("Snowshoe")
    mesh.from_pydata(places, [], [*sides, tuple(reversed(range(corners))), tuple(range(corners, 2 * corners))])
    return meshes.link(bpy.data.objects.new("Snowshoe", mesh))


def snowshoe(rig, foot):
    """A flat oval under a foot where it stands, its nose a little ahead of the toes, carried by the foot's bone."""
    scene, low = bpy.context.scene, []
    bone = rig.pose.bones[foot]
    for frame in range(60, 440, 4):
        scene.frame_set(frame)
        low.append((bone.head.z + bone.tail.z, frame))
    scene.frame_set(min(low)[1])
    heel, toe = (rig.matrix_world @ at for at in (bone.head, bone.tail))
    shoe, ahead = oval(*SHOE), (toe - heel)
    turn = math.atan2(ahead.y, ahead.x) + 0.5 * math.pi  # its nose is at -y
    middle = 0.5 * (heel + toe) - BACK * Vector((ahead.x, ahead.y, 0.0)).normalized()
    shoe.parent, shoe.parent_type, shoe.parent_bone = rig, "BONE", foot
    bpy.context.view_layer.update()
    lies = Matrix.Translation((middle.x, middle.y, min(heel.z, toe.z) - SHOE[2]))
    shoe.matrix_world = lies @ Matrix.Rotation(turn, 4, "Z")
    scene.frame_set(scene.frame_start)


def walker(number):
    """One of WHO, on its own trail towards -Y."""
    clip, size, mass = WHO[number]
    rig = people.bvh(HERE / "walks" / CLIPS[clip], global_scale=demo.UNIT * size)
    rig.name = f"Walker {number + 1}"
    bpy.context.view_layer.update()
    start = (rig.matrix_world @ rig.pose.bones[0].matrix).translation
    rig.location += Vector(((number - 2) * APART - start.x, 1.9 - start.y, 0.0))
    if number == SHOD:
        for side in ("Left", "Right"):
            snowshoe(rig, f"{side}Foot")
    meshes.activate(rig)
    bpy.ops.object.desire_path_walker_add()
    rig.desire_path.mass = mass


def make(soil):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    ground = demo.add_mesh(demo.lines(-2.4, 2.4, 0.04, 25.0, 1.15), demo.lines(-3.6, 2.6, 0.04, 25.0, 1.15), waves)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.soil, ground.desire_path.cell_size = soil, 0.008
    for number in range(len(WHO)):
        walker(number)
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    bpy.ops.object.desire_path_material_add()
    scene.frame_set(scene.frame_end)
    for each in scene.objects:
        each.hide_render = each.name.startswith("Snowshoe")
    sun = demo.add_sun()
    turn, up = math.radians(165.0), math.radians(17.0)
    sun.location = 9.0 * Vector((math.cos(turn) * math.cos(up), math.sin(turn) * math.cos(up), math.sin(up)))
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene)
    scene.camera = demo.add_camera("View", (0.0, -3.3, 2.0), (0.0, -0.5, 0.0), 26.0)
    demo.cycles(scene)
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 4, 3
    scene.view_settings.exposure = SOILS[soil]


if __name__ == "__main__":
    shots.take(__doc__, "--scenes", tuple(SOILS), make, (640, 360, 48))
