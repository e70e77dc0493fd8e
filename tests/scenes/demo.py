"""demo.py - a recorded walk through sand, snow and mud, baked, saved, and set up to be rendered.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/demo.py -- --out out

Everything about the trail goes through the public operators; the rest is an ordinary scene: an
imported BVH clip, a skinned walker, a graded ground mesh with painted soils, a low sun, cameras.
"""

import argparse
import builtins
import math
import os
import sys
import time

import bpy
import numpy as np
from mathutils import Vector

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "addon"), os.path.dirname(HERE)]

from scenes import mannequin, materials, noise  # noqa: E402

WALK = os.path.join(HERE, "walks", "cmu_12_01_walk.bvh")
UNIT = 0.056444  # metres in a unit of the clip
RATE = 24  # frames a second
MASS = 68.0  # [kg]
SOILS = ("dry-sand", "snow", "mud")
BORDERS = (0.03, -1.18)  # y where sand becomes snow, and snow mud; the walk goes to -y [m]
SINK = (0.007, 0.033, 0.021)  # about how far a foot goes in, by soil [m]
CELL = 0.005  # [m]
# a print in each soil to look at closely: place [m], and how far off the camera is [m]
PRINTS = {
    "sand": ((0.03, 0.33, -0.005), 0.84),
    "snow": ((0.055, -0.86, -0.02), 0.84),
    "mud": ((-0.045, -1.445, -0.015), 0.84),
}


# ---- the ground ----------------------------------------------------------------------------------


def shares(x, y):
    """How much sand, snow and mud there is at places, (3, ..), sum 1; the borders wander."""
    wander = (0.26 - 0.18 * np.exp(-((x / 0.9) ** 2))) * noise.rough(x, y, 1.1, 5) + 0.05 * x
    soft = 0.10  # half the width of a border [m]
    below = [np.clip(0.5 + (y + wander - at) / (2 * soft), 0.0, 1.0) for at in BORDERS]
    below = [s * s * (3 - 2 * s) for s in below]
    sand, snow = below[0], below[1] - below[0]
    return np.stack([sand, snow, 1.0 - below[1]])


def waves(x, y):
    """The ground without its fine grain [m]: gentle where the walk goes, dunes farther off."""
    aside = np.hypot(np.maximum(abs(x) - 0.7, 0.0), np.maximum(abs(y + 0.5) - 2.4, 0.0))
    far = 1.0 - np.exp(-((aside / 5.0) ** 2))
    return (
        0.045 * noise.smooth(x, y, 3.2, 3)
        + 0.012 * noise.smooth(x, y, 1.3, 8)
        + 0.9 * far * noise.rough(x, y, 8.0, 12, octaves=2)
        + 0.35 * far
    )


def height(x, y):
    """The ground [m]: ripples on the sand, soft humps in the snow, clods in the mud."""
    sand, snow, mud = shares(x, y)
    phase = (y + 0.22 * x + 0.05 * noise.smooth(x, y, 0.55, 21)) / 0.085
    crest = 0.5 + 0.5 * np.cos(2 * np.pi * phase)
    ripples = 0.0042 * crest**1.5 * (0.65 + 0.35 * noise.smooth(x, y, 0.7, 22))
    # what the mesh is too coarse for, off the walk, is left to the shader
    near = np.exp(-((np.maximum(np.maximum(abs(x), abs(y + 0.55) - 2.2) - 0.3, 0.0) / 0.35) ** 2))
    humps = 0.007 * noise.rough(x, y, 0.34, 31)
    humps += 0.0016 * near * noise.rough(x, y, 0.06, 33, octaves=2)
    clods = 0.005 * noise.rough(x, y, 0.16, 41)
    clods += 0.0026 * near * noise.rough(x, y, 0.034, 43, octaves=2)
    # the snow lies on the sand and the mud, and thins out towards them
    blanket = 0.020 * snow * snow
    return waves(x, y) + sand * ripples + snow * humps + mud * clods + blanket


def lines(low, high, step, reach, grow=1.06):
    """Coordinates: even between low and high, then farther and farther apart."""
    middle = np.arange(round(low / step), round(high / step) + 1) * step
    out, width = [], step
    while sum(out) < reach:
        width *= grow
        out.append(width)
    outside = np.cumsum(out)
    return np.concatenate([middle[0] - outside[::-1], middle, middle[-1] + outside])


def add_mesh(x, y, height):
    """A ground mesh with points at these coordinates; returns the object."""
    x, y = np.meshgrid(x, y)
    points = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3).astype(np.float32)
    rows, columns = x.shape
    at = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
    mesh = bpy.data.meshes.new("Ground")
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.add(quads.size)
    mesh.loops.foreach_set("vertex_index", quads.ravel())
    mesh.polygons.add(len(quads))
    mesh.polygons.foreach_set("loop_start", np.arange(0, quads.size, 4, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(quads), 4, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(quads), bool))
    mesh.update(calc_edges=True)
    obj = bpy.data.objects.new("Ground", mesh)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def paint(obj, name, weight):
    """A vertex group, its weights in 64 steps."""
    group = obj.vertex_groups.new(name=name)
    level = np.round(weight * 64).astype(int)
    for value in range(1, 65):
        group.add(np.flatnonzero(level == value).tolist(), value / 64, "REPLACE")


def add_ground(step):
    """One mesh, fine where the walk goes, coarse at the horizon, soils painted by vertex groups."""
    obj = add_mesh(lines(-0.29, 0.29, step, 22.0), lines(-2.95, 1.85, step, 22.0), height)
    mesh = obj.data
    points = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", points.ravel())
    weight = shares(points[:, 0].astype(float), points[:, 1].astype(float))
    colour = np.ones((len(points), 4), np.float32)
    colour[:, :3] = weight.T
    mesh.attributes.new(materials.SOIL, "FLOAT_COLOR", "POINT").data.foreach_set("color", colour.ravel())
    mesh.materials.append(materials.ground())
    for name, each in zip(SOILS, weight):
        paint(obj, name, each)
    return obj


# ---- the walker ----------------------------------------------------------------------------------


def import_walk():
    """The clip as Blender imports it, in metres, at the scene's rate."""
    bpy.ops.preferences.addon_enable(module="io_anim_bvh")
    from io_anim_bvh import import_bvh

    # Blender 3.4 with Python 3.11: the importer opens files in a mode that is gone
    import_bvh.open = lambda path, mode="r", *a, **k: builtins.open(path, mode.replace("U", "") or "r", *a, **k)  # noqa: SIM115
    bpy.ops.import_anim.bvh(
        filepath=WALK, global_scale=UNIT, use_fps_scale=True, update_scene_fps=False, update_scene_duration=False
    )
    walker = bpy.context.object
    walker.name = "Walker"
    return walker


def sink(x, y):
    """About how far a foot goes in [m]."""
    return float(np.dot(SINK, shares(x, y)))


def follow_ground(walker, height=height, sink=sink):
    """Key the object's height so that each step stands on the uneven ground, and a little in it.

    The clip was recorded on a level floor. Every stance asks for one height; between the middles of
    stances the object moves smoothly from one to the next.
    """
    scene = bpy.context.scene
    first, last = scene.frame_start, scene.frame_end
    ankles = {side: [] for side in ("Left", "Right")}
    toes = {side: [] for side in ("Left", "Right")}
    for frame in range(first, last + 1):
        scene.frame_set(frame)
        for side in ankles:
            ankles[side].append(walker.pose.bones[side + "Foot"].head.copy())
            toes[side].append(walker.pose.bones[side + "ToeBase"].head.copy())
    keys = []
    for side in ankles:
        ankle, toe = np.array(ankles[side]), np.array(toes[side])
        speed = np.maximum(*(np.linalg.norm(np.gradient(p, axis=0), axis=1) * RATE for p in (ankle, toe)))
        slow = speed < 0.12
        edges = np.flatnonzero(np.diff(np.concatenate([[0], slow, [0]])))
        for start, stop in zip(edges[::2], edges[1::2]):
            if stop - start < 3:
                continue
            at = (0.6 * ankle[start:stop] + 0.4 * toe[start:stop]).mean(axis=0)
            sole = ankle[start:stop, 2].mean() - mannequin.ANKLE
            dx, dy = np.meshgrid((-0.03, 0.0, 0.03), (-0.10, -0.05, 0.0, 0.05, 0.10))
            below = height(at[0] + dx, at[1] + dy).mean()
            keys.append((first + 0.5 * (start + stop - 1), below - sink(at[0], at[1]) - sole))
    keys.sort()
    for frame, z in keys:
        walker.location.z = z
        walker.keyframe_insert("location", index=2, frame=round(frame))
    for curve in walker.animation_data.action.fcurves:
        if curve.data_path == "location":
            for key in curve.keyframe_points:
                key.interpolation = "BEZIER"
                key.handle_left_type = key.handle_right_type = "AUTO_CLAMPED"
            curve.update()


# ---- light and cameras ---------------------------------------------------------------------------


def aim(obj, target):
    way = Vector(target) - obj.location
    obj.rotation_euler = way.to_track_quat("-Z", "Y").to_euler()


def add_camera(name, at, target, lens, aperture=None):
    data = bpy.data.cameras.new(name)
    data.lens = lens
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    obj.location = at
    aim(obj, target)
    if aperture:
        data.dof.use_dof = True
        data.dof.focus_distance = (obj.location - Vector(target)).length
        data.dof.aperture_fstop = aperture
    return obj


def add_sun():
    data = bpy.data.lights.new("Sun", "SUN")
    data.energy, data.angle, data.color = 3.6, math.radians(1.2), (1.0, 0.80, 0.58)
    obj = bpy.data.objects.new("Sun", data)
    bpy.context.scene.collection.objects.link(obj)
    obj.location = (-3.2, -2.6, 1.50)
    aim(obj, (0.0, 0.0, 0.0))
    return obj


def light_and_cameras(scene):
    add_sun()
    materials.sky(scene)
    still = add_camera("Still", (1.45, 1.30, 1.20), (0.06, -0.85, 0.375), 23.8)
    film = add_camera("Film", (1.55, 0.0, 0.62), (0.0, 0.0, 0.30), 32.0)
    # the film's camera goes along with the walker, evenly, and falls behind a little
    span = scene.frame_end - scene.frame_start
    for frame in (scene.frame_start, scene.frame_end):
        y = 1.34 - (frame - scene.frame_start) / span * 3.66
        film.location = (1.42, y - 1.18, 0.98)
        aim(film, (-0.03, y + 0.20, 0.27))
        film.keyframe_insert("location", frame=frame)
    for curve in film.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.camera = still
    for name, (at, apart) in PRINTS.items():
        at = Vector((at[0], at[1], at[2] + float(waves(at[0], at[1]))))
        add_camera("Print in " + name, at + apart * Vector((0.62, 0.58, 0.53)), at, 60.0)
    return still, film


def cycles(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_threshold = 0.03
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 2
    scene.cycles.glossy_bounces = 1
    # what light does after its first bounce is guessed: shadows are quiet with few samples
    scene.cycles.use_fast_gi = True
    scene.cycles.fast_gi_method = "REPLACE"
    scene.cycles.ao_bounces_render = 1
    scene.world.light_settings.distance = 0.8
    scene.cycles.transmission_bounces = scene.cycles.transparent_max_bounces = 0
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.cycles.sample_clamp_indirect = 3.0
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.cycles.samples = 48
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.exposure = -0.12
    scene.view_settings.look = "Medium High Contrast"


# ---- the whole scene -----------------------------------------------------------------------------


def build(step=CELL):
    """The scene without a trail: (ground, walker)."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = RATE, 1.0
    walker = import_walk()
    scene.frame_start = 1
    scene.frame_end = int(walker.animation_data.action.frame_range[1])
    body = mannequin.add(walker)
    for each in materials.clothes():
        body.data.materials.append(each)
    ground = add_ground(step)
    follow_ground(walker)
    light_and_cameras(scene)
    cycles(scene)
    scene.frame_set(scene.frame_start)
    return ground, walker


def bake(ground, walker, cell=CELL):
    """The trail, by the operators an animator presses."""
    import desire_path

    desire_path.register()
    activate(ground)
    bpy.ops.object.desire_path_ground_add()
    settings = ground.desire_path
    settings.soil, settings.cell_size = SOILS[0], cell
    settings.folder = "//bake"
    for number, name in enumerate(SOILS[1:]):
        bpy.ops.object.desire_path_paint_add()
        settings.painted[number].vertex_group = name
        settings.painted[number].soil = name
    activate(walker)
    bpy.ops.object.desire_path_walker_add()
    walker.desire_path.mass = MASS
    activate(ground)
    bpy.ops.object.desire_path_bake()


def activate(obj):
    for each in list(bpy.context.view_layer.objects):
        each.select_set(each == obj)
    bpy.context.view_layer.objects.active = obj


def main():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="demo.py", description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="out", help="folder for the .blend file and the bake")
    parser.add_argument("--cell", type=float, default=CELL, help="cell size and mesh spacing [m]")
    parser.add_argument("--no-bake", action="store_true", help="the scene without its trail")
    chosen = parser.parse_args(words)
    out = os.path.abspath(chosen.out)
    os.makedirs(out, exist_ok=True)

    begun = time.perf_counter()
    ground, walker = build(chosen.cell)
    bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside it
    file = os.path.join(out, "desire_path_demo.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file, compress=True)
    print(f"stage scene {time.perf_counter() - begun:.1f}")
    if not chosen.no_bake:
        begun = time.perf_counter()
        bake(ground, walker, chosen.cell)
        print(f"stage bake {time.perf_counter() - begun:.1f}")
    scene = bpy.context.scene
    scene.frame_set(scene.frame_end)
    bpy.ops.wm.save_as_mainfile(filepath=file, compress=True)


if __name__ == "__main__":
    main()
