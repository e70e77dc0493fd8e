"""tracks.py - what stamps and wheels leave along drawn curves, under a low sun.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/tracks.py -- FOLDER
        [--width 400 --height 225 --samples 48 --scenes horse-wet,lorry]

Writes FOLDER/SCENE.png: a horse and boots on wet sand and in soft earth, three trails of five hundred marks that
cross, gulls on a shore, wet and dry, a bicycle's tyres, a car in snow, a lorry and a tractor in mud. All of it by
the operators an animator presses.
"""

import math
import pathlib
import sys
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Vector

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import demo, materials, meshes, noise, shots  # noqa: E402


@dataclass(frozen=True)
class View:
    """A ground with tracks on it, and who looks from where. Places [m]"""

    soil: str
    tracks: tuple[tuple[dict, tuple], ...]  # settings of each, and where its curve goes
    half: tuple[float, float]  # the ground's fine part reaches so far to the sides, and ahead
    eye: tuple[float, float, float]
    look: tuple[float, float, float]
    cell: float = 0.005
    wave: float = 0.01  # height of the ground's waves
    lens: float = 35.0
    sun: float = 16.0  # above the horizon [degrees]
    stops: float = 0.0  # exposure


HORSE = {"stamp": "horse-shoe"}
BOOT = {"stamp": "boot"}
GULL = {"stamp": "gull", "scatter": 0.1}
RIDE = (
    (HORSE, ((-2.6, -0.75), (-1.0, -0.35), (0.8, 0.25), (2.7, 0.5))),
    (BOOT, ((2.6, -0.75), (1.0, -0.25), (-0.6, 0.35), (-2.6, 1.1))),
)
SHORE = (
    (GULL, ((-0.9, -0.35), (-0.2, -0.1), (0.3, 0.2), (0.9, 0.25))),
    (GULL, ((0.8, -0.4), (0.2, -0.15), (-0.3, 0.35), (-0.7, 0.6))),
    (GULL, ((-0.8, 0.3), (0.0, 0.42), (0.8, 0.6))),
)


def _wander(turn, waves):
    """A trail that winds through the middle of the field, of some 170 marks."""
    s = np.linspace(-37.0, 37.0, 150)
    aside = 4.0 * np.sin(waves * s)
    x, y = s * math.cos(turn) - aside * math.sin(turn), s * math.sin(turn) + aside * math.cos(turn)
    return BOOT, tuple(zip(x.tolist(), y.tolist()))


VIEWS = {
    "horse-wet": View("wet-sand", RIDE, (2.2, 1.4), (0.2, -1.2, 0.62), (0.05, -0.02, 0.0), stops=0.9),
    "horse-earth": View("soft-soil", RIDE, (2.2, 1.4), (0.2, -1.2, 0.62), (0.05, -0.02, 0.0), sun=18.0, stops=0.8),
    "crossing": View(
        "fresh-snow",
        tuple(_wander(math.radians(15.0 + 60.0 * k), 0.42 + 0.04 * k) for k in range(3)),
        (38.0, 38.0),
        (0.0, -6.5, 2.6),
        (0.0, 0.4, 0.0),
        cell=0.02,
        wave=0.12,
        sun=14.0,
        stops=-0.5,
    ),
    "gulls-wet": View(
        "wet-sand", SHORE, (0.9, 0.7), (0.0, -0.62, 0.38), (0.0, 0.03, 0.0), cell=0.002, wave=0.004, stops=0.7
    ),
    "gulls-dry": View(
        "dry-sand", SHORE, (0.9, 0.7), (0.0, -0.62, 0.38), (0.0, 0.03, 0.0), cell=0.002, wave=0.004, stops=0.2
    ),
    "bicycle": View(
        "wet-soil",
        (
            (
                {"kind": "WHEEL", "vehicle": "bicycle"},
                tuple((0.14 * k - 2.8, 0.5 * math.sin(0.22 * k)) for k in range(41)),
            ),
        ),
        (2.6, 1.2),
        (-0.75, -1.15, 0.5),
        (-0.1, -0.4, 0.0),
        wave=0.006,
        sun=16.0,
        stops=1.1,
    ),
    "car": View(
        "fresh-snow",
        (({"kind": "WHEEL", "vehicle": "car"}, tuple((0.4 * k - 4.0, 0.012 * k * k - 0.6) for k in range(21))),),
        (3.6, 2.4),
        (-0.6, -2.0, 0.9),
        (0.3, 0.0, 0.0),
        wave=0.02,
        sun=14.0,
        stops=-0.5,
    ),
    "lorry": View(
        "mud",
        (
            ({"kind": "WHEEL", "vehicle": "lorry"}, tuple((k - 4.0, 0.02 * k * k - 2.2) for k in range(13))),
            ({"kind": "WHEEL", "vehicle": "tractor"}, tuple((k - 4.5, 2.6 - 0.3 * k) for k in range(11))),
        ),
        (8.0, 4.5),
        (-1.4, -4.6, 2.3),
        (0.4, -0.5, 0.0),
        cell=0.02,
        wave=0.05,
        sun=18.0,
        stops=1.3,
    ),
}


def curve(name, places):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(len(places) - 1)
    for point, place in zip(spline.bezier_points, places):
        point.co = (*place, 0.0)
        point.handle_left_type = point.handle_right_type = "AUTO"
    return meshes.link(bpy.data.objects.new(name, data))


def scene_of(view, prepare=None):
    """The ground with its tracks in it. prepare: called with the ground before anything is pressed"""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene

    def height(x, y):
        return view.wave * (noise.rough(x, y, 1.3, 5) + 0.3 * noise.rough(x, y, 0.3, 7, octaves=2))

    step = max(view.half) / 60.0
    sides = [demo.lines(-each, each, step, 25.0, 1.15) for each in view.half]
    ground = demo.add_mesh(*sides, height)
    meshes.activate(ground)
    bpy.ops.object.desire_path_ground_add()
    ground.desire_path.soil, ground.desire_path.cell_size = view.soil, view.cell
    for number, (settings, places) in enumerate(view.tracks, 1):
        line = curve(f"Track {number}", places)
        meshes.activate(line)
        given = {name: settings[name] for name in ("kind", "stamp", "vehicle") if name in settings}
        bpy.ops.object.desire_path_track_add(**given)
        for name in settings.keys() - given.keys():
            setattr(line.desire_path.track, name, settings[name])
        line.hide_render = True
    if prepare is not None:
        prepare(ground)
    meshes.activate(ground)
    bpy.ops.object.desire_path_tracks_press()
    bpy.ops.object.desire_path_material_add()
    return scene


def light_and_camera(scene, view):
    sun = demo.add_sun()
    turn, up = math.radians(160.0), math.radians(view.sun)
    sun.location = 9.0 * Vector((math.cos(turn) * math.cos(up), math.sin(turn) * math.cos(up), math.sin(up)))
    demo.aim(sun, (0.0, 0.0, 0.0))
    materials.sky(scene)
    scene.camera = demo.add_camera("View", view.eye, view.look, view.lens)
    scene.camera.data.clip_start = 0.01
    demo.cycles(scene)
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 4, 3
    scene.view_settings.exposure = view.stops


def make(name):
    light_and_camera(scene_of(VIEWS[name]), VIEWS[name])


if __name__ == "__main__":
    shots.take(__doc__, "--scenes", VIEWS, make, (400, 225, 48))
