"""Soles that slide while they press push what is in their way ahead. MODEL 6.18, MODEL 11.27"""

from dataclasses import replace

import numpy as np
import pytest
from scenes import gaits, plates
from test_carve import AT, MUD, balances, moved, pressed
from test_slip import SAND as GIVES
from test_solid import box

from desire_path import Simulation, Soil
from desire_path.ground.sim import Ground
from desire_path.ground.soil import NUMBERS, SOILS
from desire_path.loads import walker

SOFT = Soil(young_modulus=0.4e6, poisson_ratio=0.4, rest_angle=np.radians(32.0), settle_time=0.05)
SIZE = (0.3, 0.3, 0.2)


def dragged(law="sole", *, far=1.0, seconds=4.0, rate=120.0, mass=150.0, way=1.0, size=SIZE):
    """A box that is set down, stands, is dragged along x by its weight alone, and stands."""
    return moved(
        box(size),
        lambda t: np.c_[
            way * (AT[0] + far * np.clip((t - 0.5) / seconds, 0.0, 1.0)),
            np.full_like(t, AT[1]),
            np.interp(t, (0.0, 0.1), (size[2] / 2 + 0.05, size[2] / 2)),
        ],
        seconds=1.0 + seconds,
        rate=rate,
        mass=mass,
        law=law,
    )


def furrow(sim):
    return float(sim.read("compression", (0.3, -0.05, 0.7, 0.05)).mean())


@pytest.mark.parametrize("law", ("sole", "uniform"))
@pytest.mark.parametrize("soil", (SOFT, MUD, SOILS["fresh-snow"]), ids=("soft", "mud", "snow"))
def test_a_dragged_weight_leaves_a_furrow_and_has_its_heap_ahead(law, soil):
    sim = pressed(dragged(law), soil)
    told = sim.report()
    assert balances(sim)
    track = furrow(sim) * SIZE[1] * (1.0 - soil.flow_shear)  # of the rest it has not flowed: MODEL 6.18
    assert told["loosened_m3"] == pytest.approx(track, rel=0.08)
    heap = sim.read("heap", (-0.8, -0.8, 2.0, 0.8))
    x = -0.8 + (np.arange(heap.shape[1]) + 0.5) * 0.01
    front, back = AT[0] + 1.0 + 0.15, AT[0] - 0.15
    ahead, beside = heap[:, x > front], heap[:, (x > 0.3) & (x < 0.8)]
    assert ahead.max() > 1.2 * beside.max() > 0.0, "windrows are lower"
    assert ahead.sum(dtype=float) > 3.0 * heap[:, x < back].sum(dtype=float)
    assert abs(beside[:80].sum(dtype=float) / beside[80:].sum(dtype=float) - 1.0) < 0.2, "on both sides"


def test_cells_do_not_matter():
    volumes = []
    for cell in (0.04, 0.02, 0.01):
        sim = pressed(dragged(far=0.5, seconds=2.0), SOFT, cell)
        assert balances(sim)
        told = sim.report()
        volumes.append((told["loosened_m3"], told["loosened_m3"] + told["pressed_m3"], told["heaped_m3"]))
    cut, firm, heap = np.transpose(volumes)
    np.testing.assert_allclose(cut, cut[-1], rtol=0.04)
    np.testing.assert_allclose(firm, firm[-1], rtol=0.02)
    np.testing.assert_allclose(heap, heap[-1], rtol=0.1)


def test_frame_rates_and_speeds_do_not_matter():
    volumes = []
    for rate, seconds in ((30.0, 2.0), (120.0, 2.0), (480.0, 2.0), (120.0, 8.0)):
        told = pressed(dragged(far=0.5, seconds=seconds, rate=rate), SOFT).report()
        volumes.append((told["loosened_m3"], told["heaped_m3"]))
    cut, heap = np.transpose(volumes)
    np.testing.assert_allclose(cut, cut[1], rtol=0.03)
    np.testing.assert_allclose(heap, heap[1], rtol=0.1)


def test_threads_mirrors_and_a_stop_do_not_matter():
    gait, held = dragged(far=0.4, seconds=1.6), replace(SOFT, flow_shear=0.1)
    one, many = (pressed(gait, held, threads=threads) for threads in (1, 4))
    back = pressed(dragged(far=0.4, seconds=1.6, way=-1.0), held)
    window = (-1.5, -1.0, 1.5, 1.0)
    for name in ("compression", "heap"):
        assert np.array_equal(one.read(name, window), many.read(name, window)), name
        here, there = one.read(name, window), back.read(name, window)[:, ::-1]
        assert np.abs(there - here).sum(dtype=float) < 1e-3 * here.sum(dtype=float), name
        assert (np.abs(there - here) > 1e-5).mean() < 1e-3, name  # a grain or two may roll the other way
    first, second = Simulation(Ground.flat(), held), Simulation(Ground.flat(), held)
    first.load(gait, walker.loads(gait, ground=first))
    first.run(150)  # while it slides
    second.load(gait, walker.loads(gait, ground=second))
    second.restore(first.state())
    second.run(len(gait.time) - 1)
    second.settle()
    assert np.array_equal(one.read("heap", window), second.read("heap", window))
    assert one.report() == second.report()


def test_who_does_not_slide_cuts_nothing():
    sim = pressed(dragged(far=0.0), SOFT)
    assert sim.report()["loosened_m3"] == 0.0 and sim.report()["pressed_m3"] > 0.0


def test_feet_that_skate_a_little_leave_clean_prints():
    """A measured walk, whose soles skate by 6 to 10 mm where they bear: next to nothing of its prints is pushed."""
    gait, told = plates.trial("gait_bmc_walk1"), {}
    for hold in (SOILS["soil"].flow_shear, 0.0, NUMBERS["flow_shear"].high):
        sim = Simulation(Ground.flat(), replace(SOILS["soil"], flow_shear=hold, wall_angle=np.pi / 2))
        sim.load(gait, walker.loads(gait, ground=sim))
        sim.run(len(gait.time) - 1)
        told[hold] = sim.report()
        assert balances(sim)
    held, free, never = told.values()
    assert held["loosened_m3"] < 0.04 * held["pressed_m3"] < 0.4 * free["loosened_m3"]
    assert held["heaped_m3"] < 1.03 * never["heaped_m3"] < free["heaped_m3"]
    assert never["loosened_m3"] < 0.01 * never["pressed_m3"]


def test_soles_that_slip_plough():
    """Sand that gives way under a push: what is before the sole is cut, as far as it slips. MODEL 6.5"""
    cut = []
    for modulus in (0.0, 0.02):
        gait, loads = gaits.pressed([gaits.box(0.2, 0.1)], [[0, 0, 0.0, 1, 0, 0, 0]], [[0, 0, 0]])
        loads.force[0, loads.touching[0] != 0] = (150.0, 0.0, -600.0)
        sim = Simulation(Ground.flat(), replace(GIVES, shear_modulus=modulus), 0.002)
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        cut.append((sim.report()["loosened_m3"], sim.report()["deepest_m"]))
    assert cut[0][0] == 0.0
    whole = 0.010 * 0.1 * cut[1][1]  # had it sunk before it slipped
    assert 0.4 * whole < cut[1][0] < whole
