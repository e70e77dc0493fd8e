"""Snow that packs, and ground that was measured by plates: MODEL 6.14, MODEL 11.23"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path import SOILS, DesirePathError, Simulation, SimulationOptions, Soil
from desire_path.ground import measured
from desire_path.ground.sim import Ground
from desire_path.ground.soil import MEASURED, as_soil, snow
from desire_path.loads import walker
from tests.scenes import gaits, plates

G = 9.81
PACKED = ((35e3, 500.0), (100e3, 500.0), (300e3, 550.0), (800e3, 650.0))  # CRREL 95-7 [Pa], [kg/m^3]


def stood(soil, newtons, box=(0.25, 0.11), cell=0.01, at=(0, 0, 0, 1, 0, 0, 0), **more):
    sim = Simulation(Ground.flat(), soil, cell, options=SimulationOptions(**more))
    gait, loads = gaits.pressed([gaits.box(*box)], [list(at)], [[0, 0, -newtons]], mass=max(newtons / G, 1.0))
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    return sim


def middle(sim):
    """Depth under the middle of the sole [m]."""
    return float(np.median(sim.read("compression", -3, -3, 6, 6)))


@pytest.mark.parametrize("law", ("sole", "uniform"))
@pytest.mark.parametrize("density", (100.0, 200.0, 350.0, 450.0))
@pytest.mark.parametrize("pressure, packed", PACKED)
def test_a_plate_packs_snow_as_measured(pressure, packed, density, law):
    sim = stood(snow(density), pressure * 0.24 * 0.12, box=(0.24, 0.12), law=law)
    wanted = 0.3 * (1.0 - density / packed)
    assert middle(sim) == pytest.approx(wanted, rel=0.02)
    assert sim.read("heap", -60, -60, 120, 120).max() == 0.0  # no rim


def packed_twin(soil, pressure):
    """Depth by bisection: the density at which the snow carries the pressure."""
    fresh = soil.snow_density
    step, at = (500.0, 550.0, 600.0, 650.0), (35e3, 190e3, 230e3, 320e3, 380e3, 650e3, 750e3, 1e6)
    rows = [(step[k // 2] + (0.5 if k % 2 else -0.5), at[k]) for k in range(8)]

    def carries(density):
        if density <= 499.5:
            return 35e3 * (density**3 - fresh**3) / (499.5**3 - fresh**3)
        return float(np.interp(density, *zip(*rows)))

    low, high = fresh, 650.5
    for _ in range(80):
        mid = 0.5 * (low + high)
        low, high = (mid, high) if carries(mid) < pressure else (low, mid)
    return soil.layer_depth * (1.0 - fresh / low)


@pytest.mark.parametrize("density", (60.0, 100.0, 300.0, 480.0))
def test_snow_is_as_deep_as_its_literal_twin(density):
    soil = snow(density, 0.4)
    for pressure in (0.5e3, 4e3, 20e3, 150e3, 210e3, 500e3):
        sim = stood(soil, pressure * 0.24 * 0.12, box=(0.24, 0.12))
        assert middle(sim) == pytest.approx(packed_twin(soil, pressure), rel=2e-3, abs=2e-5), pressure


@pytest.mark.parametrize("law", ("sole", "uniform"))
@pytest.mark.parametrize("turn", (0.0, 0.5))
def test_a_plate_sinks_by_bekkers_law(law, turn):
    """The smaller width counts, however the plate is turned."""
    at = (0, 0, 0, math.cos(turn / 2), 0, 0, math.sin(turn / 2))
    for name, soil in MEASURED.items():
        wanted = min(measured.sinks(name, 35e3, 0.12), 0.95 * soil.layer_depth)
        if wanted < 1e-4:
            continue  # as hard as a road
        sim = stood(soil, 35e3 * 0.24 * 0.12, box=(0.24, 0.12), at=at, law=law)
        assert middle(sim) == pytest.approx(wanted, rel=0.05 if turn else 1e-3), name
    assert len(MEASURED) == 21


def test_a_loaded_wheel_sinks_by_bekkers_formula():
    """Design: 64.7 N on a wheel of 0.18 x 0.11 m roll 18.5 mm deep, at any pace of the recording."""
    load, across, width, cohesion, friction, power = 64.7, 0.18, 0.11, 1370.0, 814e3, 1.0
    wanted = (3.0 * load / (width * (3.0 - power) * (cohesion / width + friction) * math.sqrt(across))) ** (
        2.0 / (2.0 * power + 1.0)
    )
    assert wanted == pytest.approx(0.0185, abs=5e-5)
    soil = Soil(
        layer_depth=0.3, poisson_ratio=0.0, settle_time=0.001, bekker_cohesion=cohesion, bekker_friction=friction
    )
    for rate in (30.0, 120.0):
        sim = Simulation(Ground.flat(), soil, 0.004)
        gait, loads = gaits.rolled(gaits.wheel(0.5 * across, width), 0.5 * across, 0.5, (0.0, 0.0, -load), rate=rate)
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        rut = sim.read("compression", (0.2, -0.02, 0.35, 0.02))
        assert np.median(rut) == pytest.approx(wanted, rel=0.15)


def test_measured_soils_have_the_numbers_of_the_table():
    soil = as_soil("measured-lete-sand-wong")
    assert (soil.bekker_cohesion, soil.bekker_friction, soil.bekker_power) == (102e3, 5301e3, 0.79)
    assert measured.sinks("measured-snow-us", 35e3) == pytest.approx(0.29615, rel=1e-4)
    assert measured.sinks("measured-dry-sand-lll", 100e3) == pytest.approx(0.08329, rel=1e-3)


@pytest.mark.parametrize(
    "name, least, most", (("powder-snow", 0.20, 0.26), ("trodden-snow", 0.02, 0.05), ("packed-snow", 0.006, 0.01))
)
def test_a_walker_sinks_as_people_do(name, least, most):
    """80 kg, as measured, through 0.30 m of snow as it fell, trodden, and packed by machines: the middle of
    what was stepped on, and the deepest."""
    gait = replace(plates.trial("gait_bmc_walk1"), mass=np.array([80.0]))
    sim = Simulation(Ground.flat(), name, 0.02)
    sim.load(gait, walker.loads(gait, ground=sim))
    sim.run(len(gait.time) - 1)
    x0, y0 = gait.pose[:, :, :2].min(axis=(0, 1)) - 0.5
    x1, y1 = gait.pose[:, :, :2].max(axis=(0, 1)) + 0.5
    pressed = sim.read("compression", (x0, y0, x1, y1))
    depth = pressed - sim.read("heap", (x0, y0, x1, y1))  # with what has crumbled into it
    prints = depth[pressed > 0.5 * pressed.max()]
    assert least <= np.median(prints) <= most and depth.max() <= most, (np.median(prints), depth.max())


def test_snowshoes_float():
    """80 kg on one foot, in boots of 0.022 m^2 and on snowshoes of 0.15 m^2."""
    for density, share in ((100.0, 0.85), (200.0, 0.6), (300.0, 0.4)):
        boot = middle(stood(snow(density), 80.0 * G, box=(0.22, 0.10)))
        shoe = middle(stood(snow(density), 80.0 * G, box=(0.60, 0.25)))
        assert 0.0 < shoe < share * boot, (density, shoe, boot)


def test_roots_make_it_as_much_harder_as_any_ground():
    from desire_path import _native

    soil, depths = snow(100.0), []
    for firm in (1.0, 8.0):
        grid = np.zeros((20, 20), np.float32)
        names = [number[0] for number in _native.soil_numbers()]
        patch = (
            0.02, 0.0, 0.0, grid, grid.copy(), grid.copy(), grid.copy(),
            grid + np.float32(soil.young_modulus * firm), grid + 1, grid.astype(np.uint8),
            [{name: getattr(soil, name) for name in names}],
        )  # fmt: skip
        cover, bottom = grid.copy(), grid.copy()
        cover[5:15, 5:15] = 1
        foot = np.array([[0, 0, -4e3 * 0.04 * firm], [0.2, 0.2, 0], [0, 0, 1]], float)
        _native.soil_compress(patch, (bottom, cover, grid.astype(np.int32)), foot, 0, 10.0)
        depths.append(patch[4][10, 10])
    assert depths[1] == pytest.approx(depths[0], rel=1e-6) and depths[0] > 0.1


def test_threads_mirrors_and_turns_do_not_matter():
    tilted = [0, 0, 0, math.cos(0.1), 0, math.sin(0.1), 0]
    for soil in (snow(120.0), as_soil("measured-rubicon-sandy-loam-43")):
        one, many = (stood(soil, 600.0, at=tilted, threads=threads) for threads in (1, 4))
        other = stood(soil, 600.0, at=[0, 0, 0, math.cos(0.1), 0, -math.sin(0.1), 0])
        here = one.read("compression", -60, -60, 120, 120)
        assert here.max() > 0.0 and np.array_equal(here, many.read("compression", -60, -60, 120, 120))
        np.testing.assert_allclose(other.read("compression", -60, -60, 120, 120)[:, ::-1], here, atol=2e-6)


def test_the_ledger_balances_on_measured_ground():
    told = stood(as_soil("measured-dry-sand-lll"), 900.0).report()
    laid = told["displaced_m3"] + told["loosened_m3"] - told["pressed_heap_m3"]
    assert told["heaped_m3"] == pytest.approx(laid, rel=1e-6) and told["displaced_m3"] > 1e-4


def test_snow_and_measured_ground_in_one_soil_are_refused():
    with pytest.raises(DesirePathError, match="not as both"):
        Soil(snow_density=100.0, bekker_friction=1e6)
    with pytest.raises(DesirePathError, match="snow_density"):
        snow(600.0)
    with pytest.raises(DesirePathError, match="measured-snow-us"):
        as_soil("measured-moon")
    assert SOILS["powder-snow"].snow_density == 100.0
