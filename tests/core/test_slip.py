"""Soles slip before the ground carries them: Janosi and Hanamoto, and longer prints downhill. TRAIL Fig. 12."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import gaits

from desire_path import Ground, Simulation, Soil
from desire_path.ground.soil import SOILS

CELL = 0.002
SAND = Soil(layer_depth=0.3, young_modulus=2e6, settle_time=0.02, poisson_ratio=0.0, rest_angle=math.radians(32.0))


def pressed(force, soil, hill=0.0):
    """(first and last x, first and last y, of what a box of 0.2 x 0.1 m pressed) [m]"""
    gait, loads = gaits.pressed([gaits.box(0.2, 0.1)], [[0, 0, 0.0, 1, 0, 0, 0]], [[0, 0, 0]])
    stands = loads.touching[0] != 0
    loads.force[0, stands] = force(np.linspace(0.0, 1.0, stands.sum())) if callable(force) else force
    step = np.linspace(-0.4, 0.4, 17)
    ground = Ground.heights(np.broadcast_to(hill * step, (17, 17)), 0.05, -0.4, -0.4) if hill else Ground.flat()
    sim = Simulation(ground, soil, CELL)
    sim.load(gait, loads)
    sim.run(len(gait.time) - 1)
    i0, i1, j0, j1 = sim.reach()
    deep = sim.read("compression", i0, j0, i1 - i0, j1 - j0) > 1e-5
    x, y = (np.arange(i0, i1) + 0.5) * CELL, (np.arange(j0, j1) + 0.5) * CELL
    return np.array([*x[deep.any(axis=0)][[0, -1]], *y[deep.any(axis=1)][[0, -1]]])


def slipped(modulus, force):
    return pressed(force, replace(SAND, shear_modulus=modulus)) - pressed(force, SAND)


def test_a_push_of_a_quarter_of_the_weight_slips_a_centimetre():
    far = slipped(0.02, (150.0, 0.0, -600.0))
    assert far[1] == pytest.approx(0.010, abs=CELL)
    assert far[0] >= -1e-9 and np.abs(far[2:]).max() < CELL  # only that way
    aside = slipped(0.02, (0.0, -150.0, -600.0))
    assert aside[2] == pytest.approx(-0.010, abs=CELL) and np.abs(aside[:2]).max() < CELL


def test_weight_alone_does_not_slip():
    assert np.abs(slipped(0.02, (0.0, 0.0, -600.0))).max() < 1e-9


def test_it_does_not_go_back_and_is_sheared_anew_the_other_way():
    def braked(t):  # pushed forward, then not, and at the end backward half as hard
        push = np.interp(t, (0.0, 0.2, 0.5, 0.7, 1.0), (150.0, 150.0, 0.0, -75.0, -75.0))
        return np.stack([push, 0 * t, -600.0 + 0 * t], axis=1)

    far = slipped(0.02, braked)
    assert far[1] == pytest.approx(0.010, abs=CELL)
    whole = slipped(0.02, lambda t: np.stack([0 * t + 150.0, 0 * t, -600.0 + 0 * t], axis=1))
    assert far[0] == pytest.approx(whole[0], abs=CELL)  # back by less than it had gone ahead


def test_no_sole_slips_farther_than_it_may():
    assert slipped(0.1, (590.0, 0.0, -600.0))[1] == pytest.approx(0.05, abs=2 * CELL)


def test_a_foot_that_stands_on_a_slope_slides_down_it():
    """With its force straight down, and farther the steeper."""
    far = [
        (
            pressed((0.0, 0.0, -600.0), replace(SAND, shear_modulus=0.02), hill)
            - pressed((0.0, 0.0, -600.0), SAND, hill)
        )[0]
        for hill in (0.1, 0.2, 0.4)
    ]
    assert 0.0 > far[0] > far[1] > far[2]
    for hill, down in zip((0.1, 0.2, 0.4), far):
        assert -down == pytest.approx(-0.02 * math.log(1 - hill / math.tan(math.radians(32.0))), rel=0.35, abs=CELL)


def test_loose_grains_slip_and_hard_ground_does_not():
    assert SOILS["dry-sand"].shear_modulus > 0.0 and SOILS["snow"].shear_modulus > 0.0
    assert SOILS["soil"].shear_modulus == 0.0


def test_every_soil_of_a_ground_slips_by_its_own():
    """Painted soils: the second is loose, the first is not, and the other way round."""
    gait, loads = gaits.pressed([gaits.box(0.2, 0.1)], [[0, 0, 0.0, 1, 0, 0, 0]], [[150.0, 0, -600.0]])
    widths = []
    for slips in ((0.0, 0.02), (0.02, 0.0)):
        weight = np.zeros((2, 9, 9))
        weight[1] = 1.0  # all of it is the second soil
        ground = Ground.heights(np.zeros((9, 9)), 0.1, -0.4, -0.4, weight)
        sim = Simulation(ground, [replace(SAND, shear_modulus=modulus) for modulus in slips], CELL)
        sim.load(gait, loads)
        sim.run(len(gait.time) - 1)
        i0, i1, j0, j1 = sim.reach()
        widths.append((sim.read("compression", i0, j0, i1 - i0, j1 - j0) > 1e-5).any(axis=0).sum() * CELL)
    assert widths[0] > widths[1] + 0.006
