"""Walls that slide and ground that differs from place to place: MODEL 6.7, 6.8, 11.16"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path import _native
from desire_path.ground.options import SimulationOptions
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import SOILS, Soil
from tests.core.test_soil_twins import Both
from tests.reference import noise
from tests.reference import soil as twin
from tests.scenes import gaits

G = 9.81
FOOT = gaits.box(0.25, 0.11)
AT_ORIGIN = [0, 0, 0, 1, 0, 0, 0]
SAND = Soil(young_modulus=0.35e6, poisson_ratio=0.25, settle_time=0.05, rest_angle=math.radians(31))


def noise_on(cell, count, longest, shortest, seed, at=(0.0, 0.0), first=(0, 0)):
    out = np.zeros((count, count), np.float32)
    _native.soil_noise(cell, *at, *first, longest, shortest, seed, out)
    return out


def walk_over(soil, cell=0.01, threads=1, at=(0.0, 0.0), rate=60.0, half=0.5):
    """The ground about `at` after a box has stood there, and the report."""
    pose = [at[0], at[1], 0, 1, 0, 0, 0]
    gait, loads = gaits.pressed([FOOT], [pose], [[40.0, 0, -75 * G]], rate=rate)
    sim = Simulation(Ground.flat(), soil, cell, options=SimulationOptions(threads=threads))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    i0, j0 = (round((x - half) / cell) for x in at)
    n = round(2 * half / cell)
    return {name: sim.read(name, i0, j0, n, n) for name in ("compression", "heap")}, sim.report()


# ---- chance ------------------------------------------------------------------------------------


@pytest.mark.parametrize("first", [(0, 0), (-4000, 77), (123456, -98765)])
@pytest.mark.parametrize("shortest", [0.006, 0.0])
def test_chance_is_that_of_its_twin(first, shortest):
    cell, at = 0.0031, (0.4, -2.3)
    got = noise_on(cell, 9, 0.024, shortest, 11, at, first)
    for j in range(9):
        for i in range(9):
            x, y = at[0] + (first[0] + i + 0.5) * cell, at[1] + (first[1] + j + 0.5) * cell
            want = noise.waves(x, y, cell, 0.024, shortest, 11) if shortest else noise.piece(x, y, 0.024, 11)
            assert got[j, i] == pytest.approx(want, abs=2e-6)


@pytest.mark.parametrize("longest, shortest, alike", [(0.048, 0.006, 0.98), (0.024, 0.006, 0.94), (0.024, 0.0, 0.93)])
def test_chance_has_mean_0_and_variance_1_and_is_the_same_for_any_cell(longest, shortest, alike):
    fine = noise_on(0.002, 1000, longest, shortest, 5)
    assert abs(fine.mean()) < 0.05 and fine.var() == pytest.approx(1.0, rel=0.1)
    coarse = noise_on(0.004, 500, longest, shortest, 5)
    means = fine.reshape(500, 2, 500, 2).mean(axis=(1, 3))
    assert np.corrcoef(means.ravel(), coarse.ravel())[0, 1] > alike
    assert not noise_on(0.03, 50, longest, shortest, 5).any() or longest >= 0.06  # cells cannot hold it


def test_other_seeds_and_places_are_other_chances():
    a, b = noise_on(0.003, 200, 0.024, 0.006, 1), noise_on(0.003, 200, 0.024, 0.006, 9)
    far = noise_on(0.003, 200, 0.024, 0.006, 1, first=(100000, 3))
    assert abs(np.corrcoef(a.ravel(), b.ravel())[0, 1]) < 0.1
    assert abs(np.corrcoef(a.ravel(), far.ravel())[0, 1]) < 0.1


# ---- walls -------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_a_sweep_lets_walls_fall_as_its_twin(seed):
    both = Both(seed, holes=seed % 2)
    slope = np.where(both.random.random(both.shape) < 0.2, np.inf, 0.1 + both.random.random(both.shape))
    both.native["wall_slope"] = slope.astype(np.float32)
    both.twin["wall_slope"] = both.native["wall_slope"].astype(float)
    bottom, cover = both.sole()
    touched = (cover > 0.5) if seed % 3 else np.zeros(both.shape, bool)
    ring = np.where(touched, 0, 9).astype(np.int32)
    patch = (*both.patch(), both.native["wall_slope"])
    tolerance = 1e-3
    for _ in range(3):
        off, onto = twin.walls(both.twin, touched, tolerance)
        twin.sweep(both.twin, touched, tolerance)
        both.twin["compression"] += off
        both.twin["heap"] += onto
        _native.soil_stabilize(patch, (bottom, cover, ring), None, tolerance, 1)
        both.same("compression", 2e-7)
        both.same("heap", 2e-7)
    assert off.sum() > 0


@pytest.mark.parametrize("angle, cell", [(30.0, 0.004), (30.0, 0.01), (45.0, 0.004), (45.0, 0.01), (70.0, 0.004)])
def test_no_wall_is_left_steeper_than_its_angle_and_volume_is_kept(angle, cell):
    soil = replace(SAND, wall_angle=math.radians(angle), poisson_ratio=0.1)
    maps, report = walk_over(soil, cell, half=0.3)
    firm, height = -maps["compression"].astype(float), maps["heap"] - maps["compression"].astype(float)
    steepest = max(
        np.max((firm - np.roll(height, (dj, di), (0, 1))) / (cell * math.hypot(dj, di)))
        for dj in (-1, 0, 1)
        for di in (-1, 0, 1)
        if dj or di
    )
    assert steepest < math.tan(math.radians(angle + 0.11))
    assert steepest > math.tan(math.radians(angle - 3.0)) or angle > 60  # and no farther than it had to
    assert report["loosened_m3"] > 0
    area = cell**2
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert maps["heap"].sum(dtype=float) * area == pytest.approx(heaped, rel=1e-6)
    pressed = report["pressed_m3"] + report["loosened_m3"]
    assert maps["compression"].sum(dtype=float) * area == pytest.approx(pressed, rel=1e-6)


def test_a_wall_that_stands_is_left_alone():
    for angle in (89.99, 90.0):
        maps, report = walk_over(replace(SAND, wall_angle=math.radians(angle)))
        plain, _ = walk_over(SAND)
        assert report["loosened_m3"] == 0
        assert all(np.array_equal(maps[name], plain[name]) for name in maps)
    deep = replace(SAND, wall_angle=math.radians(80), young_modulus=20e6)  # a print of half a millimetre
    assert walk_over(deep)[1]["loosened_m3"] == 0


def test_ground_nobody_cut_does_not_slide_however_steep():
    heights = np.zeros((81, 81), np.float32)
    heights[:, 40:] = 0.6  # a cliff
    sim = Simulation(Ground.heights(heights, 0.02, -0.8, -0.8), replace(SAND, wall_angle=math.radians(40)), 0.02)
    gait, loads = gaits.pressed([FOOT], [[-0.4, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * G]])
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    change = sim.read("height_change", -40, -40, 80, 80)
    assert change.min() < -0.01 and not change[:, 34:].any()


def test_walls_do_not_depend_on_the_cell_much():
    soil = replace(SAND, wall_angle=math.radians(40), poisson_ratio=0.1)
    loosened = [walk_over(soil, cell, half=0.3)[1]["loosened_m3"] for cell in (0.002, 0.004)]
    assert loosened[0] == pytest.approx(loosened[1], rel=0.15)


# ---- from place to place -----------------------------------------------------------------------

ROUGH = replace(SAND, wall_angle=math.radians(45), roughness=0.5)


def test_rough_ground_differs_from_place_to_place_but_not_in_volume():
    maps, report = walk_over(ROUGH)
    plain, _ = walk_over(replace(ROUGH, roughness=0.0))
    other, _ = walk_over(ROUGH, at=(5.0, 0.0))
    assert np.abs(maps["heap"] - plain["heap"]).max() > 1e-3
    assert np.abs(maps["heap"] - other["heap"]).max() > 1e-3
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert maps["heap"].sum(dtype=float) * 1e-4 == pytest.approx(heaped, rel=1e-6)
    assert maps["compression"].max() == pytest.approx(plain["compression"].max(), rel=1e-6)  # not the stiffness


def test_threads_do_not_matter_to_rough_ground():
    one, _ = walk_over(ROUGH, threads=1)
    for threads in (2, 5):
        many, _ = walk_over(ROUGH, threads=threads)
        assert all(np.array_equal(one[name], many[name]) for name in one)


def test_rough_ground_is_the_same_in_cells_of_2_4_and_10_mm():
    found = {}
    for cell in (0.002, 0.004, 0.01):
        maps, _ = walk_over(ROUGH, cell, half=0.3)
        n = round(0.02 / cell)
        squares = len(maps["heap"]) // n
        coarse = {k: v.reshape(squares, n, squares, n).mean(axis=(1, 3)) for k, v in maps.items()}
        found[cell] = coarse, {k: v.sum(dtype=float) * cell**2 for k, v in maps.items()}
    fine, volume = found[0.002]
    for cell, alike in ((0.004, 0.96), (0.01, 0.8)):  # 10 mm hold half of the waves
        coarse, other = found[cell]
        assert other["heap"] == pytest.approx(volume["heap"], rel=0.03)
        assert other["compression"] == pytest.approx(volume["compression"], rel=0.03)
        assert np.corrcoef(coarse["heap"].ravel(), fine["heap"].ravel())[0, 1] > alike


def test_only_the_soil_that_is_rough_is_rough():
    """Two soils side by side: the smooth one's prints stay mirrored."""
    smooth = replace(ROUGH, roughness=0.0)
    plain, _ = walk_over(smooth)
    heights = np.zeros((2, 2), np.float32)
    ground = Ground.heights(heights, 4.0, -2.0, -2.0, np.stack([np.ones((2, 2), "f4"), np.zeros((2, 2), "f4")]))
    sim = Simulation(ground, [smooth, ROUGH], 0.01)
    gait, loads = gaits.pressed([FOOT], [AT_ORIGIN], [[40.0, 0, -75 * G]], rate=60.0)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    assert np.array_equal(sim.read("heap", -50, -50, 100, 100), plain["heap"])


def test_a_state_goes_on_from_rough_ground(tmp_path):
    def begun():
        gait, loads = gaits.pressed([FOOT], [AT_ORIGIN], [[40.0, 0, -75 * G]], rate=60.0)
        sim = Simulation(Ground.flat(), ROUGH, 0.01)
        sim.load(gait, loads)
        return sim, len(gait.time) - 1

    sim, last = begun()
    sim.run(last // 2)
    sim.save_state(tmp_path / "state")
    sim.run(last)
    again, _ = begun()
    again.load_state(tmp_path / "state")
    again.run(last)
    for name in ("compression", "heap"):
        assert np.array_equal(sim.read(name, -50, -50, 100, 100), again.read(name, -50, -50, 100, 100))
    assert sim.report() == again.report()


def test_a_soil_tells_its_numbers_where_they_matter():
    for soil in SOILS.values():
        assert soil.parameters().keys() >= {"layer_depth", "shear_modulus"}
        assert Soil(**soil.parameters()) == soil
    assert "roughness" in ROUGH.parameters() and "grain_size" not in ROUGH.parameters()


def test_loose_soil_rests_at_slopes_that_differ():
    """Steeper and flatter than their mean, where the place says so."""
    soil = replace(SAND, roughness=0.6, grain_size=0.03, poisson_ratio=0.5)
    mean = math.tan(SAND.rest_angle)

    def slopes(soil):
        maps, _ = walk_over(soil)
        heap = maps["heap"].astype(float)
        drop = np.max([heap - np.roll(heap, side, axis) for side in (1, -1) for axis in (0, 1)], axis=0) / 0.01
        return drop[(maps["compression"] == 0) & (heap > 0.004)]

    rough, smooth = slopes(soil), slopes(replace(soil, roughness=0.0))
    assert np.percentile(rough, 90) > 1.1 * mean > 1.09 * np.percentile(smooth, 99)
    assert np.mean(rough < 0.8 * mean) > 1.4 * np.mean(smooth < 0.8 * mean)
