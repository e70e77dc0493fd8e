"""bench_landscape.py - one walk over 10 km x 10 km of ground at 1 cm: what the core holds, and the time.

    python tests/bench/bench_landscape.py      (bpy module, or blender -b --python)
The same walk on 10 m x 10 m stands beside it: cost follows the walk and not the land.
"""

import pathlib
import sys
import tempfile
import time

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from scenes import people  # noqa: E402

import desire_path  # noqa: E402
from desire_path import _native  # noqa: E402
from desire_path.bake.bake import Bake  # noqa: E402
from desire_path.blender import sample  # noqa: E402
from desire_path.ground.sim import Ground  # noqa: E402

WALK = ROOT / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"
SCALE = 0.056444  # m per unit of the clip
RUNS = 3


def ground(side):
    """Gentle hills of 500 x 500 samples, level where the walk is, about the middle of the walk."""
    axis = np.linspace(-side / 2, side / 2, 500)
    hills = side / 500 * np.sin(6 * axis / side)[:, None] ** 2 * np.sin(6 * axis / side) ** 2
    return Ground.heights(hills, axis[1] - axis[0], -side / 2, -side / 2)


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    desire_path.register()
    armature = people.bvh(WALK, global_scale=SCALE)
    scene = bpy.context.scene
    gait = sample.record(scene, armature, scene.frame_start, scene.frame_end)
    print(f"{'ground':>8} {'cells':>10} {'most held':>10} {'bake':>8} {'a frame':>8}")
    for side in (10.0, 10000.0):
        best = 1e9
        for _ in range(RUNS):
            with tempfile.TemporaryDirectory() as folder:
                held = _native.bytes_live()
                _native.bytes_peak()
                begun = time.perf_counter()
                bake = Bake(gait, ground(side), "dry-sand", folder, cell_size=0.01)
                frames = sum(1 for _ in bake.run())
                best = min(best, time.perf_counter() - begun)
                most = _native.bytes_peak() - held
        print(
            f"{side / 1000:>5g} km {(side / 0.01) ** 2:10.0e} {most / 2**20:7.1f} MB {best:6.2f} s "
            f"{1000 * best / frames:5.2f} ms  ({bake.report['contacts']} contacts)"
        )


main()
