"""Seven small worlds whose every number is made by sums, products and quotients alone, so that what goes into the
core is the same on every machine: no sine, no random generator, nothing that a library computes its own way.

    flat     level ground that walkers cross side by side; one slips, one is held in mid-step
    hill     painted heights with a hole, steeper in places than soil stays, far from the origin
    layers   a soft layer and one of snow on firm ground
    road     soft ground that sticks beside a hard road, walked there and back
    meadow   three kinds of plants on level ground, trodden, shown, broken and left to recover
    ragged   two soils whose walls slide, that differ from place to place, come back and bulge; prints over prints
    passes   a painted mesh with a trail on it, walked one way and back, with grass and a rest between
"""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np

from desire_path import KINDS, SOILS, Gait, Ground, Planting, Simulation, Soil, Sole
from desire_path.ground.layers import Layer
from desire_path.ground.options import SimulationOptions
from tests.scenes.plain import plain

RATE = 60.0  # samples a second
STRIDE = 1.0  # [m]
STANCE = 0.6  # share of a cycle


@dataclass
class World:
    """What a world is made of; `walks` are loaded one after the other."""

    make: object  # (law, heap, threads) -> Simulation
    walks: list  # (Gait, loads)
    window: tuple  # i0, j0, nx, ny that is read
    film: tuple  # tile_x, tile_y, tiles_x, tiles_y
    rest: float = 0.0  # plants rest for so long after each walk [s]
    shown: bool = False
    frames: tuple = field(default=(0.35, 0.7))  # when frames are written, share of a walk


def box(length, width, height):
    """A closed box, its underside at z = 0, with a row of corners in the middle: its ball."""
    at = [
        (x, y, z) for z in (0.0, height) for y in (-width / 2, width / 2) for x in (-length / 2, length / 4, length / 2)
    ]
    quads = [
        (0, 3, 4, 1),
        (1, 4, 5, 2),
        (6, 7, 10, 9),
        (7, 8, 11, 10),
        (0, 1, 7, 6),
        (1, 2, 8, 7),
        (3, 9, 10, 4),
        (4, 10, 11, 5),
        (0, 6, 9, 3),
        (2, 5, 11, 8),
    ]
    return Sole(np.array(at), np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def turned(half):
    """A turn about +Z whose half angle has the tangent `half`, by rational numbers."""
    size = 1.0 + half * half
    return np.array([(1.0 - half * half) / size, 0.0, 0.0, 2.0 * half / size])


def walk(
    length,
    *,
    height=None,
    start=(0.0, 0.0),
    way=(1.0, 0.0),
    speed=1.2,
    mass=70.0,
    push=(0.15, 0.0),
    sink=0.0,
    shift=0.0,
    turn=0.0,
):
    """Two feet, each one limb of two parts (heel and toe), that walk `length` [m] from `start` along a unit `way`.

    height: (x, y) -> z of the ground [m]. push: ahead and aside, shares of the weight.
    """
    height = height or (lambda x, y: np.zeros(np.shape(x)))
    samples = int(length / speed * RATE) + 1
    time = np.arange(samples) / RATE
    pose, force, touching = np.zeros((4, samples, 7)), np.zeros((4, samples, 3)), np.zeros((4, samples), np.uint8)
    for part in range(4):
        foot, toe = part // 2, part % 2
        cycles = time * speed / STRIDE + 0.5 * foot + shift
        phase = cycles - np.floor(cycles)
        swung = np.clip((phase - STANCE) / (1.0 - STANCE), 0.0, 1.0)
        along = STRIDE * (np.floor(cycles) - 0.5 * foot - shift + swung * swung * (3.0 - 2.0 * swung))
        along = along + (0.14 if toe else 0.0)
        aside = 0.09 if foot else -0.09
        pose[part, :, 0] = start[0] + way[0] * along - way[1] * aside
        pose[part, :, 1] = start[1] + way[1] * along + way[0] * aside
        lift = 0.4 * swung * (1.0 - swung)
        pose[part, :, 2] = height(pose[part, :, 0], pose[part, :, 1]) + lift - sink
        pose[part, :, 3:] = turned(turn + (way[1] / (1.0 + way[0]) / 2.0 if way[0] > -0.9 else 4.0))
        ends = (0.2, STANCE) if toe else (0.0, 0.4)
        on = (phase >= ends[0]) & (phase < ends[1])
        share = np.clip(np.minimum(phase - ends[0], ends[1] - phase) / 0.1, 0.0, 1.0) * on
        touching[part] = on
        weight = 0.7 * mass * 9.81 * share
        tilt = (phase - 0.3) * push[0] * 4.0
        force[part, :, 0] = -weight * (tilt * way[0] - push[1] * way[1])
        force[part, :, 1] = -weight * (tilt * way[1] + push[1] * way[0])
        force[part, :, 2] = -weight
    com = pose.mean(axis=0)[None, :, :3] + np.array([0.0, 0.0, 0.9])
    gait = Gait(
        time=time,
        com=com,
        mass=[mass],
        pose=pose,
        limb_walker=np.zeros(2),
        part_limb=np.array([0, 0, 1, 1]),
        soles=[box(0.14, 0.09, 0.06), box(0.12, 0.10, 0.04)] * 2,
        point=np.zeros((4, 3)),
        point_part=np.arange(4),
        point_role=np.array([0, 2, 0, 2]),
        frame_rate=RATE,
    )
    point = np.where(touching[..., None] == 1, pose[..., :3], np.nan)
    return gait, SimpleNamespace(touching=touching, force=force, point=point, warnings=(), held=None)


def together(*walks):
    """Several walkers of one length at once."""
    count = min(len(gait.time) for gait, _ in walks)
    cut = [(replace(g, time=g.time[:count], com=g.com[:, :count], pose=g.pose[:, :count]), loads) for g, loads in walks]

    def join(name):
        return np.concatenate([getattr(loads, name)[:, :count] for _, loads in cut])

    return Gait.join([g for g, _ in cut]), SimpleNamespace(
        touching=join("touching"), force=join("force"), point=join("point"), warnings=(), held=None
    )


def slope(x, y):
    """Height of the hill: gentle, then steeper than any soil stays [m]."""
    ahead = np.clip((np.asarray(x) - 40.0) / 1.6, 0.0, 1.0)
    return 12.5 + 0.9 * ahead * ahead * (3.0 - 2.0 * ahead) + 0.05 * (np.asarray(y) + 7.0) ** 2


def _flat():
    slipping = walk(1.1, start=(0.1, 0.0), push=(0.6, 0.25), sink=0.01)
    held = walk(1.1, start=(0.13, 0.11), way=(0.8, 0.6), mass=95.0, shift=0.3, turn=0.25)
    hold = np.zeros(held[1].touching.shape, bool)
    hold[:, 20:26] = True
    both = together(slipping, held)
    both[1].held = np.concatenate([np.zeros(both[1].touching[:4].shape, bool), hold[:, : both[1].touching.shape[1]]])
    soils = {"rest": plain("dry-sand"), "paper": plain("snow")}
    cells = {"rest": 0.0075, "paper": 0.015}  # a sole is sampled three and four times along a cell's side

    def make(law, heap, threads):
        return Simulation(
            Ground.flat(), soils[heap], cells[heap], options=SimulationOptions(law=law, heap=heap, threads=threads)
        )

    return World(make, [both], (-96, -96, 384, 256), (-2, -2, 7, 5))


def _hill():
    x, y = 38.9 + 0.05 * np.arange(60), -8.0 + 0.05 * np.arange(40)
    heights = slope(x[None, :], y[:, None]) + 0.004 * ((np.arange(60)[None, :] * 7 + np.arange(40)[:, None] * 5) % 11)
    heights[22:25, 20:24] = np.nan
    second = np.clip((y[:, None] + 7.1) * 4.0 + 0.0 * x[None, :], 0.0, 1.0)
    weight = np.stack([1.0 - second, second, 1.5 * (x[None, :] > 40.6) + 0.0 * y[:, None]])
    ground = Ground.heights(heights, 0.05, 38.9, -8.0, kind_weight=weight)
    soils = [plain("dry-sand"), plain("mud"), plain("snow")]

    def make(law, heap, threads):
        return Simulation(
            ground, soils, 0.02, options=SimulationOptions(law=law, heap=heap, threads=threads, origin=(0.005, 0.003))
        )

    up = walk(1.6, height=slope, start=(39.3, -7.0), push=(0.3, 0.2), sink=0.005)
    return World(make, [up], (1940, -400, 152, 104), (30, -7, 3, 2))


def _ragged():
    weight = np.stack([np.ones((2, 2)), np.array([[0.0, 2.0], [0.0, 2.0]])])
    ground = Ground.heights(np.zeros((2, 2)), 2.0, -0.5, -1.0, kind_weight=weight)
    soils = [
        Soil(young_modulus=4e5, rest_angle=0.55, wall_angle=0.7, roughness=0.5, grain_size=0.03, rebound=0.1),
        Soil(young_modulus=6e5, rest_angle=0.4, wall_angle=1.1, roughness=0.3, grain_size=0.02, heave=0.03),
    ]

    def make(law, heap, threads):
        return Simulation(ground, soils, 0.01, options=SimulationOptions(law=law, heap=heap, threads=threads))

    there, back = walk(0.9), walk(0.9, start=(0.9, 0.05), way=(-1.0, 0.0), mass=95.0)
    return World(make, [there, back], (-64, -64, 256, 128), (-1, -1, 4, 2))


def _meadow():
    roots = np.array([[0.02 + 0.033 * i, -0.12 + 0.05 * j + 0.007 * (i % 3)] for i in range(16) for j in range(4)])
    vigour = np.array([(k * 7 % 17) / 8.0 - 1.0 for k in range(len(roots))])
    brittle = replace(KINDS["carex"], break_angle=0.6, degrade_angle=0.1, degrade_rate=1.0, strength=0.05, curl=0.1)
    plants = [
        Planting(brittle, roots=roots, vigour=vigour),
        Planting(
            "lawn",
            density=70.0,
            seed=5,
            rectangle=(-0.3, -0.2, 0.8, 0.3),
            weight=np.array([[1.0, 0.5, 0.75], [0.25, 1.0, 0.5]]),
        ),
        Planting("meadow", density=20.0, seed=9, rectangle=(0.2, -0.3, 1.0, 0.4)),
    ]

    def make(law, heap, threads):
        return Simulation(
            Ground.flat(3.2),
            "soft-soil",
            0.02,
            options=SimulationOptions(law=law, heap=heap, threads=threads),
            plants=plants,
        )

    def lifted(x, y):
        return np.full(np.shape(x), 3.2)

    one, other = walk(0.8, height=lifted), walk(0.6, height=lifted, start=(0.8, 0.05), way=(-1.0, 0.0), shift=0.2)
    return World(make, [one, other], (-64, -64, 192, 128), (-1, -1, 3, 2), rest=3.0e6, shown=True)


def _passes():
    nx, ny = 24, 12
    at = [
        (-0.4 + 0.1 * i + 0.02 * (j % 2), -0.5 + 0.1 * j, 0.02 * ((i * 5 + j * 3) % 7) / 7.0 + 0.05 * i / nx)
        for j in range(ny)
        for i in range(nx)
    ]
    faces = []
    for j in range(ny - 1):
        for i in range(nx - 1):
            a = j * nx + i
            faces += [(a, a + 1, a + nx + 1), (a, a + nx + 1, a + nx)]
    at, faces = np.array(at), np.array(faces)
    weight = np.stack([0.5 + 0.0 * at[:, 0], (at[:, 1] > 0.02) * 0.75])
    ground = Ground.mesh(at, faces, kind_weight=weight)
    plants = [Planting("moss", density=90.0, seed=2, rectangle=(-0.2, -0.3, 1.2, 0.3))]

    def make(law, heap, threads):
        soils = [replace(SOILS["wet-soil"], rebound=0.0), "dry-soil"]
        return Simulation(
            ground, soils, 0.02, options=SimulationOptions(law=law, heap=heap, threads=threads), plants=plants
        )

    def over(x, y):
        return 0.03 + 0.05 * (np.asarray(x) + 0.4) / 2.4

    there = walk(0.9, height=over, start=(0.0, 0.0))
    back = walk(0.9, height=over, start=(1.1, 0.03), way=(-1.0, 0.0), shift=0.1, mass=55.0)
    return World(make, [there, back, there], (-64, -64, 192, 128), (-1, -1, 3, 2), rest=86400.0)


def _road():
    weight = np.stack([np.array([[1.0, 0.0], [1.0, 0.0]]), np.array([[0.0, 1.0], [0.0, 1.0]])])
    ground = Ground.heights(np.zeros((2, 2)), 2.4, -0.5, -1.2, kind_weight=weight)
    soils = [
        Soil(young_modulus=5e5, poisson_ratio=0.35, rest_angle=0.3, adhesion=0.005, rebound=0.1),
        Soil(young_modulus=5e8, adhesion=0.001),
    ]

    def make(law, heap, threads):
        return Simulation(ground, soils, 0.01, options=SimulationOptions(law=law, heap=heap, threads=threads))

    there, back = walk(1.8, start=(-0.4, 0.0)), walk(1.8, start=(1.6, 0.05), way=(-1.0, 0.0), mass=95.0)
    return World(make, [there, back], (-64, -64, 320, 128), (-1, -1, 5, 2))


def _layers():
    top = Soil(young_modulus=2e5, poisson_ratio=0.2, rest_angle=0.4)
    snow = Soil(snow_density=250.0, poisson_ratio=0.0, layer_depth=0.3)
    ground = Ground.flat().layered(Layer(top, 0.04), Layer(snow, 0.1))

    def make(law, heap, threads):
        return Simulation(
            ground, Soil(young_modulus=3e6), 0.02, options=SimulationOptions(law=law, heap=heap, threads=threads)
        )

    return World(make, [walk(0.9)], (-64, -64, 192, 128), (-1, -1, 3, 2))


def worlds():
    """name -> World"""
    return {
        "flat": _flat(),
        "hill": _hill(),
        "ragged": _ragged(),
        "road": _road(),
        "layers": _layers(),
        "meadow": _meadow(),
        "passes": _passes(),
    }


def trodden(soil, law, heap, threads):
    """Level ground of one soil on which two slipping steps were taken: (Simulation, window that is read)."""
    gait, loads = walk(1.0, push=(0.4, 0.2), sink=0.01)
    sim = Simulation(Ground.flat(), soil, 0.02, options=SimulationOptions(law=law, heap=heap, threads=threads))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim, (-48, -32, 128, 64)
