"""Two walkers side by side on a hill: feet placed alone, and with the body that leans by Balance.

blender -b --factory-startup -P tests/scenes/leaning.py -- FOLDER     writes uphill.png and downhill.png
"""

import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

from scenes import demo, mannequin, materials, meshes, people, shots  # noqa: E402

WALK = ROOT / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"
UNIT = 0.056444  # metres in one of the clip's
SLOPES = {"uphill": 0.3, "downhill": -0.3}  # along -Y, where the walk goes
FRAMES = range(150, 400, 10)  # one of them is shown
APART = 1.3  # the two walk beside each other [m]


def walker(x, leans):
    """A mannequin whose feet stand on the hill."""
    armature = people.bvh(WALK, global_scale=UNIT)
    armature.location.x = x
    body = mannequin.add(armature)
    for each in materials.clothes():
        body.data.materials.append(each)
    meshes.activate(armature)
    bpy.ops.object.desire_path_walker_add()
    bpy.ops.object.desire_path_place_feet()
    if leans:
        bpy.ops.object.desire_path_balance()
    return armature


def stride(scene, armature, frame):
    """How far the feet are apart at a frame."""
    scene.frame_set(frame)
    left, right = (armature.pose.bones[f"{side}Foot"].head for side in ("Left", "Right"))
    return (left - right).length


def make(name):
    """The hill, the two on it, and the camera beside them."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    slope = SLOPES[name]
    hill = meshes.grid(41, 81, 0.2, -4.0, -10.0, lambda x, y: -slope * y)
    bpy.ops.object.desire_path_ground_add()
    plain = bpy.data.materials.new("Earth")
    plain.use_nodes = True
    plain.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.20, 0.16, 0.10, 1.0)
    hill.data.materials.append(plain)
    both = [walker(0.0, False), walker(-APART, True)]
    scene = bpy.context.scene
    scene.frame_set(max(FRAMES, key=lambda frame: stride(scene, both[0], frame)))
    hips = both[0].matrix_world @ both[0].pose.bones["Hips"].head
    demo.add_sun()
    materials.sky(scene)
    demo.cycles(scene)
    middle = (-0.5 * APART, hips.y, hips.z - 0.05)
    scene.camera = demo.add_camera("Beside", (hips.x + 4.2, hips.y - 1.7, hips.z + 0.4), middle, 55.0)


if __name__ == "__main__":
    shots.take(__doc__, "--slopes", SLOPES, make, (720, 640, 20))
