"""layers.py - soils that lie on others, and soil that wheels and boots carry on, under a low sun.

    blender -b --factory-startup --python-exit-code 1 -P tests/scenes/layers.py -- FOLDER
        [--width 400 --height 225 --samples 48 --scenes road,tread,snow]

Writes FOLDER/SCENE.png: a road onto which two cars carry mud from both its sides, the tread of a tractor on a hard
yard, and boots that press through thin snow down to the earth. All of it by the operators an animator presses.
"""

import pathlib
import sys
from collections.abc import Callable
from dataclasses import dataclass

import bpy

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "addon"), str(HERE.parent)]

from scenes import meshes, shots, tracks  # noqa: E402


@dataclass(frozen=True)
class Lain:
    """What a view has beside its tracks: a layer, how much of it lies at a place, and how thick it sticks."""

    view: tracks.View
    layer: str
    thickness: float  # [m]
    sticks: float = 0.0  # [m]
    share: Callable[[float, float], float] | None = None  # of the thickness, 0..1; None: all of it


def _verges(_x, y):
    """Mud on both sides of a road as wide as two cars."""
    return min(max((abs(y) - 1.7) / 0.35, 0.0), 1.0)


CAR = {"kind": "WHEEL", "vehicle": "car"}
VIEWS = {
    "road": Lain(
        tracks.View(
            "packed-earth",
            (
                (CAR, ((-4.5, -3.6), (-2.6, -2.6), (0.0, -0.75), (2.6, -0.55), (5.0, -0.5))),
                (CAR, ((5.0, 3.4), (2.8, 2.4), (0.5, 0.9), (-2.2, 0.7), (-5.0, 0.65))),
            ),
            (6.0, 4.0),
            (-3.6, -4.6, 2.4),
            (0.2, -0.2, 0.0),
            cell=0.015,
            wave=0.01,
            sun=20.0,
            stops=1.7,
        ),
        "mud",
        0.06,
        0.006,
        _verges,
    ),
    "tread": Lain(
        tracks.View(
            "packed-earth",
            (({"kind": "WHEEL", "vehicle": "tractor"}, ((-3.5, -0.2), (-1.2, 0.0), (1.0, 0.0), (3.4, 0.1))),),
            (3.4, 1.8),
            (-0.2, -1.9, 1.0),
            (0.7, 0.15, 0.0),
            cell=0.01,
            wave=0.004,
            sun=20.0,
            stops=0.9,
        ),
        "mud",
        0.08,
        0.006,
        lambda x, _y: min(max((-0.6 - x) / 0.3, 0.0), 1.0),
    ),
    "snow": Lain(
        tracks.View("packed-earth", tracks.RIDE, (2.2, 1.4), (0.2, -1.2, 0.62), (0.05, -0.02, 0.0), sun=16.0),
        "powder-snow",
        0.0025,
    ),
}


def lay(ground, lain):
    """The layer of a view, as an animator lays it."""
    meshes.activate(ground)
    settings = ground.desire_path
    bpy.ops.object.desire_path_layer_add()
    layer = settings.layers[0]
    layer.soil, layer.thickness = lain.layer, lain.thickness
    if lain.sticks:
        layer.soil_numbers.adhesion = lain.sticks
    if lain.share is not None:
        group = ground.vertex_groups.new(name="lies")
        for vertex in ground.data.vertices:
            group.add([vertex.index], lain.share(vertex.co.x, vertex.co.y), "REPLACE")
        layer.group = group.name


def make(name):
    lain = VIEWS[name]
    scene = tracks.scene_of(lain.view, lambda ground: lay(ground, lain))
    tracks.light_and_camera(scene, lain.view)
    scene.cycles.use_denoising = False


if __name__ == "__main__":
    shots.take(__doc__, "--scenes", VIEWS, make, (400, 225, 48))
