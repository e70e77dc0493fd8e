"""Parks that a crowd has worn, from above and from eye height, and what they are in numbers.

    python tests/scenes/park.py FOLDER     park.jpg, park_eye.jpg, park.csv; some minutes; needs bpy, for the pictures

A park with four gates, one with eight, one with a pond and a bench where some stay: after 100, 1,000 and 10,000
passages, after a year without walkers, and after 1,000 in deep snow.
"""

import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]

from reference import network  # noqa: E402

from desire_path.crowd import scene as scenes  # noqa: E402
from desire_path.crowd.crowd import Crowd  # noqa: E402
from desire_path.ground import maps  # noqa: E402
from scenes import crowds, park_eye  # noqa: E402

POND = {"ellipse": [58, 52, 17, 10, 25]}
BENCH = {"name": "bench", "at": [30, 42], "rate": 0.0, "visit": 0.15, "linger": 300.0, "radius": 1.5}
PARKS = {
    "four gates": crowds.park(),
    "eight gates": crowds.park(crowds.EIGHT),
    "pond and bench": {**crowds.park(obstacles=[POND]), "places": [*crowds.park()["places"], BENCH]},
}
SHOWN = (100, 1000, 10_000)  # passages
SNOW = {"ground": "snow-25", "passages": 1000, "renewals": 20}
LINES, HOLES = 4.0, 6.0  # branches that are shorter are none [m], nor are holes that are smaller [m^2]
FINE = 2  # pixels of a cell
GRASS = ((0.0, (0.62, 0.50, 0.35)), (0.3, (0.55, 0.50, 0.30)), (0.6, (0.44, 0.50, 0.25)), (1.0, (0.31, 0.43, 0.19)))
WHITE = ((0.0, (0.62, 0.64, 0.68)), (0.5, (0.78, 0.81, 0.86)), (1.0, (0.93, 0.95, 0.98)))
HEADER = "park,ground,passages,lines_m,straight_m,detour,below_half_m2,bare_m2,below_half_a_year_later_m2"


def walked(given):
    """(covers by passages, cover a year later, report, a row of the table's numbers, what is an obstacle)"""
    scene = scenes.of({**given, "film_every": 100})
    with tempfile.TemporaryDirectory() as folder:
        crowd = Crowd(scene, folder)
        report = crowd.run()
        films = sorted(Path(folder, "frames").glob("*.exr"))
        covers = {
            int(film.stem.split("_")[1]): maps.read(film).planes["cover"]
            for film in films
            if int(film.stem.split("_")[1]) in SHOWN
        }
    rested = scene.ground.left(scene.ground.rested(crowd.load, 365.0))
    row = [
        scene.passages,
        measured(scene.ground.left(crowd.load) < 0.5, scene.cell),
        measured(straight(scene, crowd.ways.blocked), scene.cell),
        report["detour"],
        report["area_below_half_cover"],
        report["bare_area"],
        float((rested < 0.5).sum() * scene.cell**2),
    ]
    return covers, rested, row, crowd.ways.blocked


def measured(worn, cell):
    """How long the lines of worn ground are [m]."""
    lines = network.pruned(network.thin(network.filled(worn, int(HOLES / cell**2))), int(LINES / cell))
    return float(network.length(lines, cell))


def straight(scene, blocked):
    """The straight lines between all gates, as wide as worn ones; those that a pond cuts lead along its rim."""
    x, y = scene.middles()
    worn = np.zeros(scene.shape, bool)
    gates = [np.array(place.at) for place in scene.places if place.rate > 0.0]
    for n, a in enumerate(gates):
        for b in gates[:n]:
            along, far = (b - a) / np.hypot(*(b - a)), np.hypot(*(b - a))
            on = (x - a[0]) * along[0] + (y - a[1]) * along[1]
            off = (x - a[0]) * along[1] - (y - a[1]) * along[0]
            worn |= (np.abs(off) < 0.7) & (on > 0.0) & (on < far)
    return worn & ~blocked


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


def beside(tiles, axis):
    """Pictures with white between them."""
    shape = list(tiles[0].shape)
    shape[axis] = 8
    gap = np.ones(shape)
    return np.concatenate([part for tile in tiles for part in (tile, gap)][:-1], axis=axis)


def save(picture, path):
    image = bpy.data.images.new(path.stem, picture.shape[1], picture.shape[0])
    rgba = np.concatenate([np.clip(picture, 0.0, 1.0), np.ones((*picture.shape[:2], 1))], axis=-1)
    image.pixels.foreach_set(rgba.astype(np.float32).ravel())
    image.file_format = "JPEG"
    image.filepath_raw = str(path.resolve())
    image.save()


def main(folder):
    folder, chance = Path(folder), np.random.default_rng(1)
    folder.mkdir(parents=True, exist_ok=True)
    rows, strips = [HEADER], []
    for name, given in PARKS.items():
        covers, later, row, blocked = walked(given)
        snow, _, snowed, _ = walked({**given, **SNOW})
        tiles = [painted(covers[n], blocked, GRASS, chance) for n in SHOWN]
        tiles += [painted(later, blocked, GRASS, chance), painted(snow[1000], blocked, WHITE, chance)]
        strips.append(beside(tiles, 1))
        for ground, numbers in (("meadow", row), ("snow-25", snowed)):
            rows.append(",".join([name, ground, *(f"{number:.5g}" for number in numbers)]))
        print(*rows[-2:], sep="\n", flush=True)
    (folder / "park.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    save(beside(strips[::-1], 0), folder / "park.jpg")  # pictures are stored from below
    park_eye.picture(covers[10_000], blocked, scenes.of(given).cell, folder / "park_eye.jpg")


if __name__ == "__main__":
    main(sys.argv[-1])
