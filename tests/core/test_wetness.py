"""Wet soil: MODEL 6.13, MODEL 11.21"""

import math
from dataclasses import replace

import numpy as np
import pytest

from desire_path import Soil, SoilKeys
from desire_path.ground.sim import Ground, Simulation
from tests.scenes import gaits

REST = math.radians(32.0)
SAND = Soil(young_modulus=4e5, poisson_ratio=0.1, settle_time=0.02, rest_angle=REST, wall_angle=REST)
CELL = 0.005
G = 9.81


def stood(soil):
    gait, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * G]])
    sim = Simulation(Ground.flat(), soil, CELL)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    sim.settle()
    return sim


def slope(sim):
    """The steepest of the surface along x and y [-]."""
    height = sim.read("height_change", -60, -60, 120, 120).astype(float)
    return max(np.abs(np.diff(height, axis=axis)).max() for axis in (0, 1)) / CELL


def walls(wet, rest=REST, wall=REST):
    """The steepest that stands, from the papers [rad]."""
    cohesion = 3000.0 * wet * (wet ** (4.0 / (1.0 - 4.0)) - 1.0) ** 0.25 * math.tan(rest)
    angles = np.linspace(rest + 1e-4, math.pi / 2, 200_000)
    height = 4.0 * cohesion / 16e3 * np.sin(angles) * math.cos(rest) / (1.0 - np.cos(angles - rest))
    return max(wall, angles[height >= 0.1].max(initial=rest))


def test_dry_sand_flows_damp_sand_stands_and_soaked_sand_slides_at_half_the_slope():
    dry, damp, soaked = (stood(replace(SAND, wetness=wet)) for wet in (0.0, 0.4, 1.0))
    slack = math.tan(REST + math.radians(0.11)) - math.tan(REST)
    assert slope(dry) == pytest.approx(math.tan(REST), abs=slack)
    assert slope(damp) > 2.0 and damp.report()["loosened_m3"] == 0.0
    assert slope(soaked) == pytest.approx(0.5 * math.tan(REST), abs=slack)
    assert soaked.read("compression", 0, 0, 1, 1)[0, 0] > 1.05 * damp.read("compression", 0, 0, 1, 1)[0, 0]


@pytest.mark.parametrize("wet", [0.0005, 0.005, 0.02])
def test_walls_stand_as_steeply_as_suction_holds_them(wet):
    """In a print of 8 cm, so that walls are higher than what the steepest falls from cell to cell, 2 cm: what stands
    over the angle falls, and stops within the tolerance, 0.1 degrees."""
    steepest = walls(wet)
    assert math.tan(REST) < math.tan(steepest) < 4.2
    found = stood(replace(SAND, young_modulus=1e5, wetness=wet))
    assert found.read("compression", 0, 0, 1, 1)[0, 0] > 0.08
    assert math.tan(steepest) <= slope(found) <= math.tan(steepest + math.radians(0.1))


@pytest.mark.parametrize("wet", [0.0, 0.3, 0.9, 1.0])
def test_stiffness_and_a_dry_soil_that_is_as_it_was(wet):
    sim = stood(replace(SAND, wetness=wet))
    lifted = 0.5 * max(wet - 0.8, 0.0) / 0.2
    assert sim.read("young_modulus", 0, 0, 1, 1)[0, 0] == pytest.approx(4e5 * math.sqrt(1.0 - lifted), rel=1e-6)


def test_firm_walls_that_stand_anyway_stand_until_it_is_soaked():
    firm = replace(SAND, wall_angle=math.pi / 2)
    names = ("compression", "heap")
    dry, damp = (stood(replace(firm, wetness=wet)) for wet in (0.0, 0.5))
    for name in names:
        np.testing.assert_array_equal(dry.read(name, -40, -40, 80, 80), damp.read(name, -40, -40, 80, 80))
    assert stood(replace(firm, wetness=1.0)).report()["loosened_m3"] > 0.0


def test_rain_is_a_key():
    gait, loads = gaits.pressed([gaits.box(0.25, 0.11)], [[0, 0, 0, 1, 0, 0, 0]], [[0, 0, -75 * G]])
    wet = SoilKeys(SAND, {"wetness": [(0.0, 0.4), (0.6, 0.4), (0.6, 1.0)]})
    sim = Simulation(Ground.flat(), wet, CELL)
    sim.load(gait, loads)
    sim.run(70)
    assert slope(sim) > 3.0
    sim.run(len(gait.time) - 1)
    sim.settle()
    assert slope(sim) < 0.55 * math.tan(REST)
