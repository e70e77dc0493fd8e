"""A park from above: what a crowd has worn after 300, 1,000 and 10,000 passages, and how it goes through snow.

tests/scenes/park.py park.jpg     a minute; needs bpy, to write the picture
"""

import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "addon"))

from desire_path.crowd import scene as scenes  # noqa: E402
from desire_path.crowd.crowd import Crowd  # noqa: E402
from desire_path.ground import maps  # noqa: E402

GATES = [(3, 18, 1.0), (97, 30, 0.8), (66, 97, 0.6), (10, 90, 0.4), (30, 42, 0.35)]
POND = {"ellipse": [58, 52, 17, 10, 25]}
FINE = 2  # pixels of a cell
GRASS = ((0.0, (0.62, 0.50, 0.35)), (0.3, (0.55, 0.50, 0.30)), (0.6, (0.44, 0.50, 0.25)), (1.0, (0.31, 0.43, 0.19)))
SNOW = ((0.0, (0.62, 0.64, 0.68)), (0.5, (0.78, 0.81, 0.86)), (1.0, (0.93, 0.95, 0.98)))


def walked(ground, passages, **more):
    """(covers after the films asked for, what is an obstacle)"""
    places = [{"name": f"gate {n}", "at": [x, y], "rate": rate} for n, (x, y, rate) in enumerate(GATES)]
    scene = scenes.of(
        {
            "places": places,
            "obstacles": [POND],
            "ground": ground,
            "passages": passages,
            "seed": 1,
            "film_every": 100,
            **more,
        }
    )
    with tempfile.TemporaryDirectory() as folder:
        crowd = Crowd(scene, folder)
        crowd.run()
        return {
            int(path.stem.split("_")[1]): maps.read(path).planes["cover"]
            for path in sorted(Path(folder, "frames").glob("*.exr"))
        }, crowd.ways.blocked


def larger(field):
    """A field with FINE times as many places along each side, straight in between."""
    for axis in (0, 1):
        count = field.shape[axis]
        at = np.clip((np.arange(count * FINE) + 0.5) / FINE - 0.5, 0.0, count - 1.0)
        low = np.minimum(at.astype(int), count - 2)
        share = (at - low).reshape([-1, 1] if axis == 0 else [1, -1])
        field = np.take(field, low, axis) * (1.0 - share) + np.take(field, low + 1, axis) * share
    return field


def painted(cover, blocked, colours, chance):
    at, tones = [each for each, _ in colours], np.array([tone for _, tone in colours])
    cover = larger(cover)
    picture = np.stack([np.interp(cover, at, tones[:, k]) for k in range(3)], axis=-1)
    picture *= 1.0 + 0.03 * chance.standard_normal(cover.shape)[..., None]
    pond = larger(blocked.astype(float))[..., None]
    return picture * (1.0 - pond) + pond * np.array((0.22, 0.34, 0.42))


def main(path):
    chance = np.random.default_rng(1)
    meadow, blocked = walked("meadow", 10_000)
    snow, _ = walked("snow-25", 1000, renewals=20)
    tiles = [painted(meadow[n], blocked, GRASS, chance) for n in (300, 1000, 10_000)]
    tiles.append(painted(snow[1000], blocked, SNOW, chance))
    gap = np.ones((tiles[0].shape[0], 8, 3))
    picture = np.concatenate([part for tile in tiles for part in (tile, gap)][:-1], axis=1)
    image = bpy.data.images.new("Park", picture.shape[1], picture.shape[0])
    rgba = np.concatenate([np.clip(picture, 0.0, 1.0), np.ones((*picture.shape[:2], 1))], axis=-1)
    image.pixels.foreach_set(rgba.astype(np.float32).ravel())
    image.file_format = "JPEG"
    image.filepath_raw = str(Path(path).resolve())
    image.save()


if __name__ == "__main__":
    main(sys.argv[-1])
