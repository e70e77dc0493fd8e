"""A whole bake beside Blender's own Dynamic Paint: same grid, same feet, same frames, one process.

    python tests/bench/bench_dynamic_paint.py [--sizes 256,512,1024] [--frame-rate 120] [--soil dry-sand]

Run it with a Python that has bpy (5.2 is the fair one: Dynamic Paint is 25 times slower in 3.4) and
the built module in addon/desire_path. A recorded walk crosses a square ground of N x N vertices; ours
samples, simulates and writes every frame; Dynamic Paint displaces the vertices into its disk cache
(vertex bake) or paints an image sequence of N x N pixels (image bake; the wheel of 5.2 computes the
pictures but saves none, so its time is without writing). Feet of Dynamic Paint are the very soles
that press our ground, keyed at every frame. Prints ms a frame, the least of --runs, ratios, and where
the time of our quickest bake went.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPO = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPO / "addon"), str(REPO / "tests"), str(REPO / "tests" / "bench")]

import bpy  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402
import starts  # noqa: E402
from scenes import meshes, people  # noqa: E402

import desire_path  # noqa: E402
from desire_path.blender import compat  # noqa: E402
from desire_path.motion.gait import Gait  # noqa: E402

SIDE = 4.6  # of the ground [m]
SOIL = "dry-sand"  # a new ground's own; soft ones slide longer: --soil mud
WALK = REPO / "tests" / "scenes" / "walks" / "cmu_12_01_walk.bvh"
SCALE = 0.056444  # m per unit of the clip


def grid(name, count, centre, larger=1.0):
    """A flat square of count x count vertices with UVs, `larger` times the usual side."""
    side = SIDE * larger
    first = np.subtract(centre, side / 2)
    obj = meshes.grid(count, count, side / (count - 1), *first, name=name)
    corners = np.zeros(len(obj.data.loops), np.int32)
    obj.data.loops.foreach_get("vertex_index", corners)
    place = compat.positions(obj.data)[corners, :2]
    obj.data.uv_layers.new(name="UVMap").data.foreach_set("uv", ((place - first) / side).astype(np.float32).ravel())
    return obj


def walker(frame_rate):
    """The armature on the scene's frames, and its last frame."""
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = frame_rate, 1.0
    armature = people.bvh(WALK, global_scale=SCALE, use_fps_scale=True, update_scene_fps=False)
    last = int(armature.animation_data.action.frame_range[1])
    scene.frame_start, scene.frame_end = 1, last
    return armature, last


def start(frame_rate):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return walker(frame_rate)


def ours(count, frame_rate, folder, centre, larger=1.0):
    """Seconds of one whole bake, by stage; `whole` is all of it."""
    armature, last = start(frame_rate)
    ground = grid("Ground", count, centre, larger)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size, settings.folder = SOIL, SIDE * larger / (count - 1), str(folder)
    settings.frame_start, settings.frame_end = 1, last
    meshes.activate(armature)
    bpy.ops.object.desire_path_walker_add()
    meshes.activate(ground)
    with stages.clock() as spent:
        bpy.ops.object.desire_path_bake()
    return spent


def brushes(gait, last):
    """One closed mesh a part, keyed at every frame."""
    sampled = gait.resample(gait.frame_rate)
    made = []
    for part, sole in enumerate(gait.soles):
        top = sole.vertices + np.array([0, 0, 0.05], np.float32)
        count = len(sole.vertices)
        edges = {}
        for a, b, c in sole.triangles.tolist():
            for pair in ((a, b), (b, c), (c, a)):
                edges[frozenset(pair)] = None if frozenset(pair) in edges else pair
        sides = [(p[1], p[0], p[0] + count, p[1] + count) for p in edges.values() if p]
        mesh = bpy.data.meshes.new(f"Sole {part}")
        faces = sole.triangles.tolist() + (sole.triangles[:, ::-1] + count).tolist() + sides
        mesh.from_pydata(np.concatenate([sole.vertices, top]).tolist(), [], faces)
        obj = bpy.data.objects.new(mesh.name, mesh)
        bpy.context.scene.collection.objects.link(obj)
        obj.rotation_mode = "QUATERNION"
        for frame in range(1, last + 1):
            pose = sampled.pose[part, min(frame - 1, len(sampled.time) - 1)]
            obj.location = pose[:3] - [0, 0, 0.02]  # as deep as a print
            obj.rotation_quaternion = pose[3:]
            obj.keyframe_insert("location", frame=frame)
            obj.keyframe_insert("rotation_quaternion", frame=frame)
        obj.modifiers.new("Brush", "DYNAMIC_PAINT").ui_type = "BRUSH"
        meshes.activate(obj)
        bpy.ops.dpaint.type_toggle(type="BRUSH")
        obj.modifiers["Brush"].brush_settings.paint_source = "VOLUME"
        made.append(obj)
    return made


def dynamic_paint(form, count, frame_rate, folder, centre, gait):
    """Seconds of one Dynamic Paint bake of form VERTEX; an IMAGE bake tells its own."""
    armature, last = start(frame_rate)
    bpy.data.objects.remove(armature)
    bpy.context.view_layer.update()
    brushes(gait, last)
    ground = grid("Canvas", count, centre)
    meshes.activate(ground)
    modifier = ground.modifiers.new("Canvas", "DYNAMIC_PAINT")
    modifier.ui_type = "CANVAS"
    bpy.ops.dpaint.type_toggle(type="CANVAS")
    surface = modifier.canvas_settings.canvas_surfaces[0]
    surface.surface_format = form
    surface.surface_type = "DISPLACE"
    surface.frame_start, surface.frame_end = 1, last
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "canvas.blend"))
    if form == "IMAGE":
        surface.image_resolution = count
        surface.image_output_path = str(folder)
        surface.uv_layer = "UVMap"
        surface.image_fileformat = "OPENEXR"
        bpy.ops.dpaint.bake()  # starts a job; Blender says how long it took when it ends
        return None
    cache = surface.point_cache
    cache.frame_start, cache.frame_end, cache.use_disk_cache = 1, last, True
    begun = time.perf_counter()
    with bpy.context.temp_override(point_cache=cache, object=ground, active_object=ground):
        bpy.ops.ptcache.bake(bake=True)
    if not cache.is_baked:
        raise SystemExit("Dynamic Paint did not bake its vertices.")
    return time.perf_counter() - begun


def image_bake(count, frame_rate, folder, centre):
    """Seconds of an image bake, in a process of its own: its end is only told when Blender leaves."""
    words = ["--image", str(count), "--frame-rate", str(frame_rate), "--folder", str(folder)]
    words += ["--centre", *map(str, centre)]
    itself = starts.command(__file__, *words, blender=bpy.app.binary_path)
    said = subprocess.run(itself, capture_output=True, text=True).stdout
    found = re.search(r"Bake complete! \(([0-9.]+)\)", said)
    if not found:
        raise SystemExit("Dynamic Paint did not finish its image bake.")
    return float(found.group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", default="256,512,1024")
    parser.add_argument("--frame-rate", type=int, default=120, help="the clip's own is 120")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--soil", default=SOIL)
    parser.add_argument("--image", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--folder", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--centre", type=float, nargs=2, help=argparse.SUPPRESS)
    args = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None)

    globals()["SOIL"] = args.soil
    desire_path.register()
    if args.image:
        gait = Gait.load(args.folder / "walk.npz")
        dynamic_paint("IMAGE", args.image, args.frame_rate, args.folder, args.centre, gait)
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        armature, last = start(args.frame_rate)
        meshes.activate(grid("Ground", 8, (0, 0)))
        bpy.ops.object.desire_path_ground_add()
        meshes.activate(armature)
        bpy.ops.object.desire_path_walker_add()
        bpy.ops.object.desire_path_record(filepath=str(folder / "walk.npz"))
        gait = Gait.load(folder / "walk.npz")
        at = gait.com[0, :, :2]
        centre = (at.min(axis=0) + at.max(axis=0)) / 2
        print(
            f"Blender {bpy.app.version_string}, {last} frames at {args.frame_rate}/s, ms a frame (least of {args.runs})"
        )
        print(f"{'grid':>6} {'ours':>8} {'vertex':>8} {'image':>8}   {'vertex/ours':>11} {'image/ours':>11}")
        best = {}
        for count in map(int, args.sizes.split(",")):
            found = {"ours": [], "VERTEX": [], "IMAGE": []}
            for run in range(args.runs):
                for what, times in found.items():
                    place = folder / f"{what}_{count}_{run}"
                    place.mkdir()
                    if what == "ours":
                        spent = ours(count, args.frame_rate, place, centre)
                        if spent["whole"] < best.get(count, {"whole": 1e9})["whole"]:
                            best[count] = spent
                        seconds = spent["whole"]
                    elif what == "VERTEX":
                        seconds = dynamic_paint(what, count, args.frame_rate, place, centre, gait)
                    else:
                        gait.save(place / "walk.npz")
                        seconds = image_bake(count, args.frame_rate, place, centre)
                    times.append(1000 * seconds / last)
            us, vertex, image = (min(times) for times in found.values())
            print(f"{count:>6} {us:8.2f} {vertex:8.2f} {image:8.2f}   {vertex / us:10.1f}x {image / us:10.1f}x")
            print(f"       {stages.line(best[count])}")
        small, large = min(best), max(best)
        ratio = best[large]["whole"] / best[small]["whole"]
        print(f"ours at {large} against {small}, finer cells: {ratio:.2f}x a frame")
        wide = []
        for run in range(args.runs):
            place = folder / f"landscape_{run}"
            place.mkdir()
            wide.append(ours(large, args.frame_rate, place, centre, large / small))
        spent = min(wide, key=lambda each: each["whole"])
        print(
            f"ours at {large} against {small}, same cells: {spent['whole'] / best[small]['whole']:.2f}x "
            f"a frame ({1000 * spent['whole'] / last:.2f} ms)"
        )
        print(f"       {stages.line(spent)}")


main()
