"""bench_sampling.py - what it takes to record 1,000 frames of a rig in a scene with a heavy character.

    python tests/bench/bench_sampling.py [frames, 1000] [runs, 5]      (bpy module, or blender -b --python)
The character is skinned to the rig, subdivided and smoothed. Compared with the plain way, frame_set in the
scene itself and reading the bones, which is timed over a few frames.
"""

import pathlib
import sys
import time

import bpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
from scenes import mannequin, people  # noqa: E402

import desire_path  # noqa: E402
from desire_path.blender import sample  # noqa: E402

WALK = ROOT / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"
SCALE = 0.056444  # m per unit of the clip
PLAIN = 12  # frames the plain way


def timed(function):
    begun = time.perf_counter()
    function()
    return time.perf_counter() - begun


def plain(armature):
    """The poses of a few frames, read in the scene itself."""
    scene = bpy.context.scene
    for frame in range(1, PLAIN + 1):
        scene.frame_set(frame)
        pose = armature.evaluated_get(bpy.context.view_layer.depsgraph)
        for bone in pose.pose.bones:
            bone.matrix.copy()


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    frames, runs = [*map(int, words), *(1000, 5)[len(words) :]]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    desire_path.register()
    armature = people.bvh(WALK, global_scale=SCALE)
    body = mannequin.add(armature)
    alone = min(timed(lambda: sample.record(bpy.context.scene, armature, 1, frames)) for _ in range(runs))
    body.modifiers.new("Subdivision", "SUBSURF").levels = 2
    body.modifiers.new("Smooth", "SMOOTH")  # else only a window would have the subdivision worked out
    bpy.context.view_layer.update()
    shown = len(body.evaluated_get(bpy.context.view_layer.depsgraph).data.vertices)
    ours = min(timed(lambda: sample.record(bpy.context.scene, armature, 1, frames)) for _ in range(runs))
    slow = min(timed(lambda: plain(armature)) for _ in range(runs)) * frames / PLAIN
    print(
        f"Blender {bpy.app.version_string}, {len(armature.data.bones)} bones, a character of "
        f"{len(body.data.vertices)} points, {shown} as it is shown; {frames} frames"
    )
    print(f"ours {ours:.2f} s ({1000 * ours / frames:.2f} ms a frame; {alone:.2f} s with the character plain)")
    print(f"frame_set in the scene {slow:.1f} s: {slow / ours:.0f}x as long")


main()
