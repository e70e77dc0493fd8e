"""What slides takes its time: MODEL 6.4"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from tests.scenes import gaits
from tests.scenes.records import for_simulation

SLUSH = Soil(young_modulus=0.2e6, poisson_ratio=0.1, settle_time=0.02, rest_angle=0.3, wall_angle=math.radians(50))
SLOW = replace(SLUSH, flow_time=0.3)
LIFT = 73  # the sample before the one by which the foot is up


def begun(soil, cell=0.01, **more):
    gait, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * 9.81]], lift=2.4)
    sim = Simulation(Ground.flat(), soil, cell, **for_simulation(**more))
    sim.load(gait, loads)
    return sim, len(gait.time) - 1


def height(sim):
    n = round(0.4 / sim.cell_size)
    return sim.read("height_change", -n, -n, 2 * n, 2 * n).astype(float)


def still(soil, cell=0.01):
    """Samples after lift-off until hardly anything moves; how far it is from there after the first [m]."""
    sim, end = begun(soil, cell)
    sim.run(LIFT)
    steps, before, first = [], height(sim), None
    for k in range(LIFT + 1, end + 1):
        sim.run(k)
        now = height(sim)
        steps.append(np.abs(now - before).max())
        before, first = now, now if first is None else first
    return np.flatnonzero(np.array(steps) > 5e-4).max(initial=-1) + 1, np.abs(now - first).max()


def test_slides_take_their_time_and_longer_ones_longer():
    at_once, left = still(SLUSH)
    slow, still_to_go = still(SLOW)
    slower, _ = still(replace(SLOW, flow_time=0.6))
    assert at_once <= 1 and left < 1e-4
    assert slow > 20 and still_to_go > 0.005
    assert slower == pytest.approx(2 * slow, rel=0.2)


def test_no_slope_falls_all_at_once():
    """A high wall and what it leaves go down half a cell each a sweep, a hundred times lower than they are."""
    soil, cell = replace(SLOW, young_modulus=4e4, rest_angle=0.6, wall_angle=math.radians(80)), 0.005
    sim, end = begun(soil, cell)
    sim.run(LIFT)
    before, most = height(sim), 0.0
    assert before.min() < -0.15
    sweeps = math.ceil(0.1 / (soil.flow_time * cell) / 120.0)
    for k in range(LIFT + 1, end + 1):
        sim.run(k)
        now = height(sim)
        most, before = max(most, (before - now).max()), now
    assert 0.5 * cell < most < 1.01 * sweeps * cell, most


def test_they_take_as_long_in_any_cell():
    coarse, fine = still(SLOW)[0], still(SLOW, 0.005)[0]
    assert fine == pytest.approx(coarse, rel=0.5)


def test_in_the_end_all_rests_and_nothing_is_lost():
    quick, end = begun(SLUSH)
    quick.run(end)
    slow, _ = begun(replace(SLOW, flow_time=2.0))
    slow.run(end)
    assert np.abs(height(slow) - height(quick)).max() > 2e-3  # on its way
    slow.settle()
    np.testing.assert_allclose(height(slow), height(quick), atol=6e-3)
    report = slow.report()
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert report["heaped_m3"] == pytest.approx(heaped, rel=1e-6)
    before = height(slow)
    slow.settle()
    assert np.array_equal(height(slow), before)


def test_threads_and_states_on_the_way_do_not_matter(tmp_path):
    one, end = begun(SLOW, threads=1)
    one.run(end)
    many, _ = begun(SLOW, threads=5)
    many.run(LIFT + 9)
    many.save_state(tmp_path / "state")
    again, _ = begun(SLOW, threads=1)
    again.load_state(tmp_path / "state")
    for sim in (many, again):
        sim.run(end)
        assert np.array_equal(height(sim), height(one)) and sim.report() == one.report()


def test_a_foot_that_comes_down_again_leaves_nothing_behind():
    """What still slides when the limb begins its next stance slides on after it."""
    gait, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * 9.81]], lift=0.1)
    sim = Simulation(Ground.flat(), replace(SLOW, flow_time=5.0), 0.01)
    for _ in range(2):
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
    sim.settle()
    report = sim.report()
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert report["heaped_m3"] == pytest.approx(heaped, rel=1e-6)
    change, slope = height(sim), math.tan(SLOW.rest_angle + math.radians(0.11))
    heap = sim.read("heap", -40, -40, 80, 80)
    for axis in (0, 1):
        for side in (1, -1):
            drop = change - np.roll(change, side, axis)
            assert (drop[heap > 1e-4] <= slope * 0.01 + 1e-6).all()


def test_a_print_slides_on_while_its_foot_stands_elsewhere(tmp_path):
    gait, loads = gaits.strides(3.0)
    loads.touching[1:], loads.force[1:] = 0, 0.0  # the other foot stays off the ground
    soil, cell = replace(SLOW, flow_time=4.0), 0.01

    def fresh(threads=1):
        sim = Simulation(Ground.flat(), soil, cell, **for_simulation(threads=threads))
        sim.load(gait, loads)
        return sim

    def heights(sim):
        return sim.read("height_change", -100, -60, 480, 120).astype(float)

    sim, (begins, ends) = fresh(), (70, 100)  # samples between which the foot stands at 1.4 m, its print at 0
    sim.run(begins)
    before = heights(sim)
    sim.run(ends)
    moved = np.abs(heights(sim) - before)
    assert moved[:, 70:130].max() > 1e-3, moved[:, 70:130].max()

    half, end = (begins + ends) // 2, len(gait.time) - 1
    one = fresh()
    one.run(half)
    one.save_state(tmp_path / "state")
    again = fresh(5)
    again.load_state(tmp_path / "state")
    for each in (one, again):
        each.run(end)
    assert np.array_equal(heights(one), heights(again)) and one.report() == again.report()
    one.settle()
    report = one.report()
    heaped = report["displaced_m3"] - report["pressed_heap_m3"] + report["loosened_m3"]
    assert report["heaped_m3"] == pytest.approx(heaped, rel=1e-6)
    change, heap = heights(one), one.read("heap", -100, -60, 480, 120)
    slope = math.tan(SLOW.rest_angle + math.radians(0.11))
    for axis in (0, 1):
        drop = change - np.roll(change, 1, axis)
        assert (drop[heap > 1e-4] <= slope * cell + 1e-6).all()
