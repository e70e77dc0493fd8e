"""bench_press.py - milliseconds from one place of the mouse to ground that shows what was pressed there.

    python tests/bench/bench_press.py [--profile]      (bpy module, or blender -b --python)
A ball of 25 cm is drawn 4 cm a step over a plane of four points, at cells of 1 cm: to and fro, so that some of the
way is ground where it was before. What is shown is evaluated after each step.
"""

import argparse
import cProfile
import pathlib
import pstats
import sys
import time

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from scenes import gaits, meshes  # noqa: E402

import desire_path  # noqa: E402
from desire_path.blender import press  # noqa: E402

STEP, SIDE = 0.04, 8.0


def ball():
    sphere = gaits.sphere(0.125, 16)
    mesh = bpy.data.meshes.new("Ball")
    mesh.from_pydata(sphere.vertices.tolist(), [], sphere.triangles.tolist())
    obj = bpy.data.objects.new("Ball", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.update()
    return obj


def drawn(hand, places):
    """Milliseconds of each step, and how many points are shown at its end."""
    took = []
    for x, y in places:
        start = time.perf_counter()
        there = hand.at(x, y, down=True)
        hand.step(there)
        hand.put(there)
        bpy.context.view_layer.update()
        took.append(1e3 * (time.perf_counter() - start))
    hand.lift()
    bpy.context.view_layer.update()
    return took


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--profile", action="store_true", help="tell where the time goes")
    parser.add_argument("--steps", type=int, default=150, help="of each stroke")
    options = parser.parse_args(words)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    desire_path.register()
    ground, one = meshes.grid(2, 2, SIDE, -SIDE / 2, -SIDE / 2), ball()
    hand = press.Press(bpy.context, ground, [one], depth=0.04)
    profile = cProfile.Profile()
    along = np.arange(-3.0, 3.0, STEP)[: options.steps]
    for name, y, way in (("there", 0.0, along), ("back", 0.1, along[::-1]), ("beside", 1.5, along)):
        if options.profile:
            profile.enable()
        took = drawn(hand, [(x, y) for x in way])
        profile.disable()
        shown = ground.evaluated_get(bpy.context.evaluated_depsgraph_get())
        half, most = np.percentile(took, (50, 90))
        count = len(shown.data.vertices)
        print(f"{name:7s} median {half:5.1f}   p90 {most:5.1f}   worst {max(took):5.1f} ms   {count} points")
    if options.profile:
        pstats.Stats(profile).sort_stats("cumulative").print_stats(45)
    hand.drop()


main()
