"""A crust carries until it breaks, and lies in plates then: MODEL 6.12, MODEL 11.20"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path import SOILS, Simulation, SimulationOptions, Soil
from desire_path.ground.sim import Ground
from tests.scenes import gaits

G = 9.81
CRUST = Soil(
    young_modulus=2e5, poisson_ratio=0.02, rest_angle=0.66, settle_time=0.05, crust_depth=0.02, crust_strength=3e5
)
BARE = replace(CRUST, crust_depth=0.0)
LONG, WIDE = 0.25, 0.1


def bears(soil, area, edge=False):
    """The load a plate on springs bears, Westergaard 1926 [N]."""
    h, nu = soil.crust_depth, 0.3
    rigidity = 1000.0 * soil.crust_strength * h**3 / (12.0 * (1.0 - nu**2))
    length = (rigidity * soil.layer_depth / soil.young_modulus) ** 0.25
    a = math.sqrt(area / math.pi)
    b = a if a > 1.724 * h else math.sqrt(1.6 * a * a + h * h) - 0.675 * h
    stress = 3.0 * (1.0 + nu) / (2.0 * math.pi * h * h) * (math.log(length / b) + 0.6159)
    return soil.crust_strength / stress / (2.0 if edge else 1.0)


def stood(soil, newtons, cell=0.005, at=(0.0, 0.0), box=(LONG, WIDE), sim=None, **more):
    gait, loads = gaits.pressed([gaits.box(*box)], [[*at, 0, 1, 0, 0, 0]], [[0, 0, -newtons]], mass=newtons / G)
    sim = sim or Simulation(Ground.flat(), soil, cell, options=SimulationOptions(**more))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    return sim


def read(sim, name="compression"):
    n = round(0.4 / sim.cell_size)
    return sim.read(name, -n, -n, 2 * n, 2 * n).astype(float)


@pytest.mark.parametrize(
    "soil", [CRUST, replace(CRUST, crust_depth=0.05), replace(CRUST, crust_strength=8e5, young_modulus=5e5)]
)
@pytest.mark.parametrize("box", [(LONG, WIDE), (0.04, 0.04)])
def test_it_carries_up_to_the_load_that_bends_it_too_far(soil, box):
    most = bears(soil, box[0] * box[1])
    held, broken = stood(soil, 0.97 * most, box=box), stood(soil, 1.03 * most, box=box)
    assert not read(held).any() and not read(held, "heap").any() and held.report()["off_ground"] == 0
    assert read(held, "pressure_time").sum() * 2.5e-5 == pytest.approx(0.97 * most * 0.6, rel=0.03)
    under = read(broken)[80, 80]
    wanted = 1.03 * most / (box[0] * box[1]) * soil.layer_depth / soil.young_modulus
    assert under == pytest.approx(min(wanted, 0.95 * soil.layer_depth), rel=0.01)


def test_plates_beside_the_print_tilt_into_it_and_what_is_whole_stays():
    plain, sim = read(stood(BARE, 800.0)), stood(CRUST, 800.0)
    found = read(sim)
    under = plain > 0.0
    np.testing.assert_allclose(found[under], plain[under], atol=1e-6)
    beside = (found > 0.0) & ~under
    assert 0.3 * under.sum() < beside.sum() < 4.0 * under.sum()
    assert found[beside].max() < 0.99 * plain.max()
    far = np.hypot(
        *np.meshgrid(*[np.maximum(np.abs(np.arange(160) - 79.5) * 0.005 - half, 0) for half in (LONG / 2, WIDE / 2)])
    )
    assert not found[far > 7.0 * CRUST.crust_depth].any()
    # planes: the second differences within plates vanish but at their borders
    second = np.abs(found[1:-1, 2:] - 2 * found[1:-1, 1:-1] + found[1:-1, :-2])[beside[1:-1, 1:-1]]
    assert np.median(second) < 1e-6 < np.quantile(second, 0.9)


def test_pieces_are_the_same_whatever_the_cell():
    coarse, fine = read(stood(CRUST, 800.0, 0.005)), read(stood(CRUST, 800.0, 0.0025))
    averaged = fine.reshape(160, 2, 160, 2).mean(axis=(1, 3))
    assert coarse.sum() == pytest.approx(averaged.sum(), rel=0.03)
    assert np.abs(coarse - averaged).mean() < 0.05 * coarse[coarse > 0].mean()


def test_the_ledger_balances_with_plates_that_tilt():
    soil = replace(CRUST, poisson_ratio=0.3, wall_angle=1.2, roughness=0.3)
    sim = stood(soil, 800.0)
    for at in ((0.08, 0.06), (-0.05, 0.1)):
        stood(soil, 700.0, at=at, sim=sim)
    sim.settle()
    told = sim.report()
    n = 128
    heap, pressed = (sim.read(name, -n, -n, 2 * n, 2 * n).sum(dtype=float) * 2.5e-5 for name in ("heap", "compression"))
    assert told["loosened_m3"] > 0
    assert heap == pytest.approx(told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"], rel=1e-6)
    assert pressed == pytest.approx(told["pressed_m3"] + told["loosened_m3"], rel=1e-6)


def test_a_foot_half_on_broken_pieces_breaks_the_rest_at_a_lesser_load():
    most = bears(CRUST, LONG * WIDE)
    sim = stood(CRUST, 3.0 * most)
    before = read(sim)
    stood(CRUST, 0.8 * most, at=(0.0, 0.07), sim=sim)  # whole ground would bear it
    assert (read(sim) > before + 1e-4).any()
    sim = stood(CRUST, 3.0 * most)
    stood(CRUST, 0.8 * most, at=(0.0, 0.28), sim=sim)
    np.testing.assert_array_equal(read(sim), before)


@pytest.mark.parametrize("law", ["sole", "uniform"])
def test_threads_and_states_do_not_matter(law):
    whole = stood(CRUST, 800.0, law=law, threads=1)
    other = stood(CRUST, 800.0, law=law, threads=3)
    np.testing.assert_array_equal(read(whole), read(other))
    gait, loads = gaits.pressed([gaits.box(LONG, WIDE)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -800.0]], mass=800.0 / G)
    half, again = (Simulation(Ground.flat(), CRUST, 0.005, options=SimulationOptions(law=law)) for _ in range(2))
    for sim in (half, again):
        sim.load(gait, loads)
    half.run(6)
    again.restore(half.state())
    again.run(len(gait.time) - 1)
    np.testing.assert_array_equal(read(again), read(whole))


def test_a_crust_that_bears_nothing_is_none_to_the_bit():
    for soil in (replace(CRUST, crust_strength=0.0), BARE):
        np.testing.assert_array_equal(read(stood(soil, 400.0)), read(stood(replace(BARE, crust_strength=0.0), 400.0)))


def test_crust_snow_bears_a_fox_and_no_person():
    fox, person = (0.03, 0.03), (0.26, 0.1)
    assert not read(stood(SOILS["crust-snow"], 6.0 * G / 2, box=fox)).any()
    assert read(stood(SOILS["crust-snow"], 60.0 * G, box=person)).max() > 0.03
