"""meadow.py - the demo's walk over a meadow: grass trodden once, and a path after many passes.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/meadow.py -- --out out

Makes meadow.blend (one walk, frame by frame) and path.blend (the same ground walked many times); both
play without the add-on. Plants and trail go through the public operators.
"""

import argparse
import os
import sys
import time

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "addon"), os.path.dirname(HERE)]

from scenes import demo, mannequin, materials, noise  # noqa: E402

CELL, FAR_CELL = 0.01, 0.02  # of the ground seen from close by and from ten metres [m]
PASSES = 200
# where the path goes: a bend to the right, past the middle of the picture [m]
WAY = ((-0.30, 4.5), (-0.10, 3.4), (0.05, 2.2), (0.0, 0.6), (-0.35, -1.2), (-1.0, -2.6), (-1.7, -3.6))


def height(x, y):
    """Gentle ground, hills farther off [m]."""
    aside = np.hypot(np.maximum(abs(x) - 1.0, 0.0), np.maximum(abs(y) - 6.0, 0.0))
    far = 1.0 - np.exp(-((aside / 9.0) ** 2))
    bumps = 0.030 * noise.smooth(x, y, 2.6, 3) + 0.006 * noise.smooth(x, y, 0.5, 8)
    return bumps + 1.1 * far * noise.rough(x, y, 9.0, 12, octaves=2) + 0.45 * far


def add_ground(step, passes):
    """Fine where the walk or the path goes; short grass where the camera looks, high grass beside the way."""
    if passes > 1:
        x, y = demo.lines(-2.2, 0.5, step, 26.0), demo.lines(-4.2, 5.1, step, 26.0)
    else:
        x, y = demo.lines(-0.5, 0.5, step, 26.0), demo.lines(-2.95, 1.85, step, 26.0)
    obj = demo.add_mesh(x, y, height)
    at = np.empty((len(obj.data.vertices), 3), np.float32)
    obj.data.vertices.foreach_get("co", at.ravel())
    x, y = at[:, 0].astype(float), at[:, 1].astype(float)
    patches = 0.5 + 0.5 * noise.rough(x, y, 1.7, 51)
    seen = (2.4, 2.5) if passes == 1 else (7.0, 9.0)
    away = np.hypot(np.maximum(abs(x) - 0.3 * seen[0], 0.0), np.maximum(abs(y + 0.6) - 0.6 * seen[1], 0.0))
    near = np.clip(1.6 - away / (0.6 * seen[0]), 0.0, 1.0)
    demo.paint(obj, "short grass", np.clip(near * (0.75 + 0.5 * patches), 0.0, 1.0))
    aside = np.clip((abs(x + 0.25) - 0.75) / 1.2, 0.0, 1.0)
    wide = np.clip(1.6 - np.hypot(x, y + 1.0) / 9.0, 0.0, 1.0)
    demo.paint(obj, "high grass", np.clip(wide * aside * (2.2 * patches - 0.7 + 0.8 * (1.0 - near)), 0.0, 1.0))
    obj.data.materials.append(materials.earth())
    return obj


def cameras(scene, passes):
    sun = demo.add_sun()
    sun.data.energy, sun.data.color, sun.location = 5.5, (1.0, 0.88, 0.70), (-3.0, -1.4, 2.7)
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene, 0.9)
    if passes > 1:
        scene.camera = demo.add_camera("Path", (0.9, 8.6, 2.2), (-0.35, 0.9, 0.10), 42.0)
    else:
        scene.camera = demo.add_camera("Trodden", (0.62, 1.22, 0.86), (0.03, -0.16, 0.07), 32.0)


def build(step=CELL, passes=1):
    """The scene without a trail: (ground, walker)."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = demo.RATE, 1.0
    walker = demo.import_walk()
    scene.frame_start, scene.frame_end = 1, int(walker.animation_data.action.frame_range[1])
    body = mannequin.add(walker)
    for each in materials.clothes():
        body.data.materials.append(each)
    ground = add_ground(step, passes)
    if passes > 1:
        walker.location.x = -0.8  # on the path when the clip ends
    demo.follow_ground(walker, height, lambda x, y: 0.006)
    cameras(scene, passes)
    demo.cycles(scene)
    scene.cycles.max_bounces, scene.cycles.transmission_bounces = 3, 2
    scene.view_settings.exposure = 0.35
    return ground, walker


def grow(ground, passes):
    """Two kinds of grass on one ground: a lawn shows single prints best, sedge how a path is worn."""
    short = ("lawn", 300.0) if passes == 1 else ("carex", 80.0)
    for (kind, density), group in ((short, "short grass"), (("meadow", 45.0), "high grass")):
        demo.activate(ground)
        bpy.ops.object.desire_path_plants_add(kind=kind, density=density, density_group=group)


def bake(ground, walker, folder, cell=CELL, passes=1):
    """Plants and trail, by the operators an animator presses."""
    demo.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size, settings.folder = "soil", cell, folder
    grow(ground, passes)
    demo.activate(walker)
    bpy.ops.object.desire_path_walker_add()
    walker.desire_path.mass = demo.MASS
    if passes > 1:
        walker.desire_path.path = add_way()
        walker.desire_path.passes = passes
    demo.activate(ground)
    bpy.ops.object.desire_path_bake()


def add_way():
    """The curve the walker goes along."""
    data = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    line = data.splines.new("POLY")
    line.points.add(len(WAY) - 1)
    for point, (x, y) in zip(line.points, WAY):
        point.co = (x, y, float(height(np.float64(x), np.float64(y))), 1.0)
    obj = bpy.data.objects.new("Way", data)
    bpy.context.scene.collection.objects.link(obj)
    obj.hide_render = True
    return obj


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="meadow.py", description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="out", help="folder for the .blend files and the bakes")
    parser.add_argument("--coarse", type=float, default=1.0, help="cells so many times as large")
    parser.add_argument("--only", choices=("meadow", "path"), help="one of the two files")
    parser.add_argument("--passes", type=int, default=PASSES, help="how often the path is walked")
    chosen = parser.parse_args(words)
    out = os.path.abspath(chosen.out)
    os.makedirs(out, exist_ok=True)
    import desire_path

    desire_path.register()
    for name, passes, cell in (("meadow", 1, CELL), ("path", chosen.passes, FAR_CELL)):
        if chosen.only not in (None, name):
            continue
        begun = time.perf_counter()
        cell *= chosen.coarse
        ground, walker = build(cell, passes)
        bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside it
        file = os.path.join(out, f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file, compress=True)
        bake(ground, walker, f"//bake_{name}", cell, passes)
        scene = bpy.context.scene
        scene.frame_set(scene.frame_end)
        bpy.ops.wm.save_as_mainfile(filepath=file, compress=True)
        print(f"stage {name} {time.perf_counter() - begun:.1f}")


if __name__ == "__main__":
    main()
