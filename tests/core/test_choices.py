"""Every choice reaches the core: a ground baked with another law, heap, rim or soil is another ground, as said."""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path.bake.bake import Bake
from desire_path.ground import maps
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from tests.scenes import gaits
from tests.scenes.records import for_bake, for_simulation

G = 9.81
SOIL = Soil(layer_depth=0.3, young_modulus=0.5e6, poisson_ratio=0.35, settle_time=0.1, rest_angle=math.radians(25))
TILTED = [0, 0, 0.004, math.cos(0.03), 0, math.sin(0.03), 0]  # its front lower by 15 mm


def pressed(pose=TILTED, force=(0, 0, -700), ground=None, soil=SOIL, **choices):
    """compression and heap, 1 cm cells about the origin, after a box has stood for half a second; it still stands."""
    sim = Simulation(ground or Ground.flat(), soil, 0.01, **for_simulation(**choices))
    gait, loads = gaits.pressed([gaits.box(0.25, 0.1)], [pose], [force], seconds=0.5)
    sim.load(gait, loads)
    sim.run(58)
    return sim.read("compression", -60, -60, 120, 120), sim.read("heap", -60, -60, 120, 120)


def test_law_uniform_presses_all_that_touches_alike_and_sole_its_lower_end_most():
    even, _ = pressed(law="uniform")
    tilted, _ = pressed(law="sole")
    touched = even[even > 0.9 * even.max()]
    assert len(touched) > 100 and np.ptp(touched) < 1e-6
    assert np.diff(tilted[60, 50:70]) == pytest.approx(np.full(19, 0.01 * math.tan(0.06)), rel=0.01)


def test_heap_rest_lays_cones_and_paper_a_rim():
    flat = [0, 0, 0, 1, 0, 0, 0]
    _, cones = pressed(flat, heap="rest")
    _, rim = pressed(flat, heap="paper", rim_width=0.10)
    slope = math.tan(SOIL.rest_angle) * 0.01
    beside = cones[60, 73:76]  # from the sole on
    assert np.diff(beside) == pytest.approx([-slope] * 2, rel=0.05)
    assert rim[60, 73:80] == pytest.approx(np.full(7, rim[60, 73]), rel=0.01)  # full as far as 8 of its 10 cm
    assert rim.sum() == pytest.approx(cones.sum(), rel=1e-3)


@pytest.mark.parametrize("width", [0.02, 0.06, 0.12])
def test_rim_width_is_how_far_soil_is_laid(width):
    steep = replace(SOIL, rest_angle=math.radians(70))
    _, rim = pressed([0, 0, 0, 1, 0, 0, 0], soil=steep, heap="paper", rim_width=width)
    out = np.flatnonzero(rim[60, 73:] > 1e-5)
    assert (out.max() + 1) * 0.01 == pytest.approx(width, abs=0.0101)


def test_each_painted_soil_has_its_push_threshold():
    """A heap is one-sided as far as the push reaches the threshold of the soil under the foot, TRAIL (13)."""
    soils = [replace(SOIL, push_threshold=1e6), replace(SOIL, push_threshold=50.0)]
    weight = np.zeros((2, 41, 41), np.float32)
    weight[0, :, :20], weight[1, :, 20:] = 1, 1  # left and right half
    ground = Ground.heights(np.zeros((41, 41)), 0.1, -2.0, -2.0, weight)
    ahead = []
    for x in (-1.0, 1.0):
        sim = Simulation(ground, soils, 0.01)
        gait, loads = gaits.pressed([gaits.box(0.25, 0.1)], [[x, 0, 0, 1, 0, 0, 0]], [[150, 0, -700]], seconds=0.5)
        sim.load(gait, loads)
        sim.run(58)
        middle = round(x * 100)
        heap = sim.read("heap", middle - 60, -60, 120, 120)
        ahead.append(heap[:, 60:].sum() / heap.sum())
    assert ahead[0] == pytest.approx(0.5, abs=0.01)
    assert ahead[1] > 0.9


def test_the_normal_is_that_of_the_ground_under_a_whole_foot():
    """On ripples much shorter than a foot the load is as on level ground, wherever on a ripple its point lies."""
    x = np.arange(-1, 1.0001, 0.01)
    ripples = np.broadcast_to(0.008 * np.sin(2 * np.pi * x / 0.06), (len(x), len(x)))
    ground = Ground.heights(ripples, 0.01, -1.0, -1.0)
    level, _ = pressed([0, 0, 0, 1, 0, 0, 0])
    for at in (0.0, 0.015, 0.03, 0.045):  # flank, crest, flank, trough
        sim = Simulation(ground, replace(SOIL, young_modulus=0.1e6), 0.01)
        gait, loads = gaits.pressed([gaits.box(0.24, 0.1)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -700]], seconds=0.5)
        loads.point[:, :, 0] = at
        sim.load(gait, loads)
        sim.run(58)
        # what the ground gives back is the force's part along the normal: none is lost to a slope
        carried = sim.read("pressure_time", -60, -60, 120, 120).sum(dtype=float) * 1e-4 / (58 / 120)
        assert carried == pytest.approx(700, rel=0.01)
        heap = sim.read("heap", -60, -60, 120, 120)
        assert heap[:, :60].sum() == pytest.approx(heap[:, 60:].sum(), rel=0.1)  # nor pushes it to a side


# ---- through a bake ------------------------------------------------------------------------------


def bake(tmp_path, gait, soil=SOIL, **choices):
    made = Bake(
        gait, Ground.flat(), soil, tmp_path, cell_size=0.01, **for_bake(map_seconds=False, threads=1, **choices)
    )
    for _ in made.run():
        pass
    return made


def tilted_gait():
    return gaits.pressed([gaits.box(0.25, 0.1)], [TILTED], [[0, 0, -700]], seconds=0.5, rate=24.0)[0]


@pytest.mark.parametrize("choice", [{"law": "uniform"}, {"heap": "paper"}, {"heap": "paper", "rim_width": 0.12}])
def test_a_bake_is_made_with_what_was_chosen(tmp_path, choice):
    gait = tilted_gait()
    made = bake(tmp_path / "chosen", gait, **choice)
    bake(tmp_path / "usual", gait, **({"heap": "paper"} if "rim_width" in choice else {}))
    planes = [maps.read(tmp_path / name / "maps_final.exr").planes for name in ("chosen", "usual")]
    for name in ("compression", "heap"):
        if name == "heap" or "law" in choice:
            assert np.abs(planes[0][name] - planes[1][name]).max() > 0.001
    even = gait.resample(120.0)
    sim = Simulation(Ground.flat(), SOIL, 0.01, **for_simulation(**choice))
    sim.load(even, made.loads)
    sim.run(len(even.time) - 1)
    assert sim.report()["deepest_m"] == made.report["deepest_m"]
    assert sim.report()["heaped_m3"] == made.report["heaped_m3"]


def test_a_bake_with_impulse_stops_feet_in_the_time_of_its_soil(tmp_path):
    """TRAIL (3): m (g + v/tau), v of a box that comes down with 1 m/s."""
    rate = 120.0
    time = np.arange(100) / rate
    pose = np.zeros((1, 100, 7))
    pose[0, :, 2], pose[0, :, 3] = np.maximum(0.5 - time, 0.0), 1.0
    base = tilted_gait()
    gait = replace(
        base, time=time, pose=pose, com=pose[:, :, :3] + [0, 0, 0.3], mass=[10.0], frame_rate=rate, cut=np.zeros(0, int)
    )
    for tau in (0.05, 0.2, 0.5):
        made = bake(tmp_path / str(tau), gait, replace(SOIL, settle_time=tau), load_model="impulse")
        assert -made.loads.force[0, :, 2].min() == pytest.approx(10.0 * (G + 1.0 / tau), rel=0.03)


def test_the_load_presses_along_the_normal_of_the_ground_around_not_of_a_ridge_under_the_sole():
    """MODEL 6.2: it is fitted over 0.25 m, so that ridges of 8 cm with slopes of 1 : 2 carry the whole weight."""
    x = np.arange(-100, 101) * 0.01
    ridges = 0.02 - abs((x % 0.08) - 0.04) * 0.5
    ground = Ground.heights(np.tile(ridges, (101, 1)), 0.01, x[0], -0.5)
    gait, loads = gaits.pressed([gaits.box(0.03, 0.03)], [[0.02, 0, 0.01, 1, 0, 0, 0]], [[0, 0, -60.0]])
    with Simulation(ground, "soil", 0.005) as sim:
        sim.load(gait, loads)
        sim.run(len(gait.time) // 2)
        carried = sim.read("pressure", -20, -20, 60, 40).sum() * 0.005**2
    assert carried == pytest.approx(60.0, rel=0.02)
