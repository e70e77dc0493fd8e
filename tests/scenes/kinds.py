"""kinds.py - a small picture of every kind of plant, as the panel lists them.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/kinds.py -- FOLDER
        [--width 96 --height 96 --samples 64 --kinds carex,fern]

Writes FOLDER/KIND.png: a few plants of it, as Add Plants lets them grow, on nothing. addon/desire_path/blender/pictures
has them.
"""

import pathlib
import sys

import bpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from desire_path.ground.plants import KINDS  # noqa: E402
from scenes import demo, meshes, shots  # noqa: E402

SIDE = 1.1  # of the bed, times the height of the plants
MANY = 26  # plants on it, at most
VIEW = 1.75  # of the picture, times that height


def bed(name):
    """Plants of a kind on a small square, which is not rendered."""
    kind = KINDS[name]
    side = max(SIDE * kind.height, (6.0 / kind.density) ** 0.5)
    bpy.ops.mesh.primitive_plane_add(size=side)
    ground = bpy.context.object
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    bpy.ops.object.desire_path_plants_add(kind=name, density=min(kind.density, MANY / side**2))
    ground.hide_render = True
    return side


def make(name):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, high = bpy.context.scene, KINDS[name].height
    side = bed(name)
    sun = demo.add_sun()
    sun.data.energy, sun.location = 4.0, (1.2, -1.6, 2.4)
    demo.aim(sun, (0.0, 0.0, 0.0))
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.85, 1.0, 1.0)
    scene.world = world
    far = 4.0 * max(side, high)
    scene.camera = demo.add_camera("Seen", (0.0, -far, 0.35 * far + 0.5 * high), (0.0, 0.0, 0.42 * high), 50.0)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", max(VIEW * high, 1.15 * side)
    scene.camera.data.clip_start = 0.001
    demo.cycles(scene)
    scene.render.film_transparent = True
    scene.render.image_settings.color_mode = "RGBA"


if __name__ == "__main__":
    shots.take(__doc__, "--kinds", tuple(KINDS), make, (96, 96, 64))
