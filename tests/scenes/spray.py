"""spray.py - a runner throws sand, mud and snow, under a low sun.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/spray.py -- FOLDER
        [--width 400 --height 360 --samples 48 --scenes sand,mud,snow]

Writes FOLDER/SCENE.png: the frame of a recorded run in which most of it flies. All of it by the operators an animator
presses.
"""

import math
import pathlib
import sys
from dataclasses import dataclass

import bpy
from mathutils import Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import demo, mannequin, materials, meshes, noise, shots  # noqa: E402

RUN = str(HERE / "walks" / "cmu_02_03_run.bvh")


@dataclass(frozen=True)
class View:
    """What is run through, how much of it sticks, and how light the picture is."""

    soil: str
    spray: str
    amount: float
    stops: float
    later: int = 0  # so many frames after most flies, which is higher by then


VIEWS = {
    "sand": View("dry-sand", "SAND", 2.0, 0.0),
    "mud": View("mud", "MUD", 3.0, 0.6, 1),
    "snow": View("fresh-snow", "SNOW", 2.0, -0.4),
}


BONES = {"root": "Hips", "lowerback": "LowerBack", "upperback": "Spine", "thorax": "Spine1", "lowerneck": "Neck"}
BONES |= {"upperneck": "Neck1", "head": "Head"}
SIDE = {"clavicle": "Shoulder", "humerus": "Arm", "radius": "ForeArm", "wrist": "Hand", "femur": "UpLeg"}
SIDE |= {"tibia": "Leg", "foot": "Foot", "toes": "ToeBase"}
BONES |= {side[0].lower() + name: side + to for side in ("Left", "Right") for name, to in SIDE.items()}


def runner():
    """The recorded run, its bones named as those of the walk that the body is made for."""
    demo.WALK = RUN
    walker = demo.import_walk()
    for name, to in BONES.items():
        walker.data.bones[name].name = to
    body = mannequin.add(walker)
    for each in materials.clothes():
        body.data.materials.append(each)
    return walker


def scene_of(view):
    """The ground, and who has run over it; returns the frame that shows most, and where the runner is then."""
    from desire_path.bake.bake import read_index
    from desire_path.bake.folder import spray_sums

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = demo.RATE, 1.0
    walker = runner()
    first, last = (int(each) for each in walker.animation_data.action.frame_range)
    scene.frame_start, scene.frame_end = first, last
    places = []
    for frame in range(first, last + 1):
        scene.frame_set(frame)
        places.append(walker.matrix_world @ walker.pose.bones["Hips"].head)
    low, high = (Vector(pick(each[k] for each in places) for k in (0, 1)) for pick in (min, max))

    def height(x, y):
        return 0.006 * noise.rough(x, y, 1.1, 5) + 0.004 * noise.rough(x, y, 0.25, 7, octaves=2)

    sides = [demo.lines(low[k] - 0.6, high[k] + 0.6, 0.03, 22.0, 1.12) for k in (0, 1)]
    ground = demo.add_mesh(*sides, height)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size = view.soil, 0.01
    settings.spray, settings.spray_amount = view.spray, view.amount
    meshes.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    walker.desire_path.mass = demo.MASS
    meshes.activate(ground)
    bpy.ops.object.desire_path_bake()
    bpy.ops.object.desire_path_material_add()
    index = read_index(bpy.path.abspath(settings.folder))
    counts = [count for _, count in spray_sums(index.folder).values()]
    number = max(range(1, index.frames + 1), key=lambda each: counts[each])
    frame = index.frame_start + number - 1 + view.later
    return frame, places[frame - first], (places[-1] - places[0]).normalized()


def make(name):
    view = VIEWS[name]
    frame, at, ahead = scene_of(view)
    scene = bpy.context.scene
    aside = Vector((-ahead.y, ahead.x, 0.0))
    eye = Vector((at.x, at.y, 1.3)) - 1.7 * ahead + 2.1 * aside
    look = Vector((at.x, at.y, 0.6)) - 0.3 * ahead
    sun = demo.add_sun()
    sun.location = 9.0 * (0.5 * aside + 0.85 * ahead) + Vector((0.0, 0.0, 9.0 * math.tan(math.radians(22.0))))
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene)
    scene.camera = demo.add_camera("View", eye, look, 30.0)
    scene.camera.data.clip_start = 0.01
    demo.cycles(scene)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.1
    scene.view_settings.exposure = view.stops
    scene.frame_set(frame)


if __name__ == "__main__":
    shots.take(__doc__, "--scenes", VIEWS, make, (400, 360, 48))
