"""bench_playback.py - milliseconds of one frame_set with a bake playing.

    python tests/bench/bench_playback.py [side ..]      (bpy module, or blender -b --python)
Random tiles of a walk's width are changed in every frame; the mesh is a square grid of cell centres
(Closest), the same shifted by a third of a cell (Linear), and a landscape of which the image covers
a sixteenth.
"""

import pathlib
import statistics
import sys
import tempfile
import time
import types

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from scenes import exr, meshes  # noqa: E402

import desire_path  # noqa: E402
from desire_path.blender import compat, playback, playback_tree  # noqa: E402

CELL, COUNT = 0.01, 24


def frames(folder, side):
    (folder / "frames").mkdir()
    rng = np.random.default_rng(0)
    value = np.zeros((side, side, 4), np.float32)
    band = slice(side // 3, side // 2)
    for n in range(COUNT + 1):
        if n:
            value[band] = rng.normal(0.0, 0.03, value[band].shape)
        exr.write(folder / "frames" / f"trail_{n:04d}.exr", value)


def measure(obj):
    scene = bpy.context.scene
    took = []
    for turn in range(2):  # the files are read in the first turn
        for frame in range(1, COUNT + 1):
            start = time.perf_counter()
            scene.frame_set(frame)
            if turn:
                took.append(1e3 * (time.perf_counter() - start))
    return statistics.median(took), max(took)


def main():
    desire_path.register()
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    for side in [int(w) for w in words if w.isdigit()] or [512, 1024]:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            frames(folder, side)
            for name, shift, stretch, groups in (
                ("closest", 0.5, 1, 0),
                ("linear", 0.83, 1, 0),
                ("landscape", 0.5, 4, 0),
                ("groups", 0.5, 1, 1),
            ):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                obj = meshes.grid(side, side, CELL * stretch, CELL * shift, CELL * shift)
                at = types.SimpleNamespace(cell=CELL, x0=0.0, y0=0.0, nx=side, ny=side, frame_start=1, frame_end=COUNT)
                if groups:
                    for each in playback_tree.GROUPS:
                        obj.vertex_groups.new(name=playback_tree.group_name(each))
                co = compat.positions(obj.data)
                box = np.array([(x, y, 0.0) for x in (co[0, 0], co[-1, 0]) for y in (co[0, 1], co[-1, 1])])
                depth = 0.3 if groups else 0.0
                how = playback_tree.Playing(at, COUNT, np.eye(4), 1.0, name == "linear", box, depth)
                playback.attach(obj, str(folder / "frames"), how)
                middle, worst = measure(obj)
                print(
                    f"{bpy.app.version_string} {side:5d}^2 {name:10s} {middle:7.1f} ms a frame_set (worst {worst:.1f})"
                )


if __name__ == "__main__":
    main()
