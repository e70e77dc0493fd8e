"""Feet that land, and those that stand on something else than the ground."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path import _native
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from desire_path.loads import walker
from desire_path.motion import size
from tests.core.test_walker import on_one_foot, on_two_feet

# ---- what the design says of feet that land, and of those that stand on something else ---------------------


def stepping(heights, speed=0.0, rate=120.0):
    """Two one-point feet that take turns under a body that goes ahead; heights: of what each stance stands on [m]."""
    stance, count = 0.6, len(heights)
    time = np.arange(int(stance * count * rate)) / rate
    pose = np.zeros((2, len(time), 7))
    pose[..., 3] = 1.0
    for foot in range(2):
        for t, now in enumerate(time / stance):
            turn = min(int(now), count - 1)
            mine = turn if turn % 2 == foot else turn + 1  # where it stands, or is led to
            before = mine - 2
            share = now - turn if turn % 2 != foot else 1.0
            share = share * share * (3 - 2 * share)
            at = lambda n: (0.6 * n, heights[min(max(n, 0), count - 1)])
            (x0, z0), (x1, z1) = at(before), at(mine)
            pose[foot, t, 0] = x0 + (x1 - x0) * share
            pose[foot, t, 1] = 0.1 - 0.2 * foot
            pose[foot, t, 2] = z0 + (z1 - z0) * share + 0.15 * np.sin(np.pi * share)
    high = np.interp(time / stance, np.arange(count) + 0.5, heights)
    com = np.stack([0.6 * time / stance, 0 * time, 0.95 + high], axis=1)
    return on_two_feet(time, com, pose, rate)


def test_what_stands_on_a_box_is_carried_there_and_leaves_no_print():
    heights = [0.0, 0.0, 0.0, 0.25, 0.25, 0.25, 0.0, 0.0, 0.0]  # over a box that is no ground
    gait = stepping(heights)
    loads = walker.loads(gait, ground=lambda xy: np.zeros(len(xy)))
    for turn, high in enumerate(heights):
        sample, foot = int((0.6 * turn + 0.35) * 120), turn % 2
        assert loads.touching[foot, sample] == (walker.ELSEWHERE if high else walker.PRESSES), turn
        assert -loads.force[foot, sample, 2] > 0.5 * 70 * 9.81, turn  # carried all the same
    assert any("something else than the ground" in each and "0.25 m" in each for each in loads.warnings)
    level = stepping([0.0] * 9)
    assert not any(
        "something else" in each for each in walker.loads(level, ground=lambda xy: np.zeros(len(xy))).warnings
    )
    sim = Simulation(Ground.flat(), "mud", 0.01)
    sim.load(gait, walker.loads(gait, ground=sim.rest_height))
    sim.run(len(gait.time) - 1)
    row = sim.read("compression", -50, -30, 600, 60).max(axis=0)
    under = lambda turn: row[50 + int(60 * turn) - 5 : 50 + int(60 * turn) + 5].max()
    assert [under(turn) > 0.002 for turn in range(1, 8)] == [high == 0.0 for high in heights[1:8]]


def test_what_is_carried_elsewhere_is_in_the_table(tmp_path):
    gait = stepping([0.0, 0.0, 0.3, 0.3, 0.0, 0.0])
    walker.write_loads(tmp_path / "loads.csv", gait, walker.loads(gait, ground=lambda xy: np.zeros(len(xy))))
    rows = [line.split(",") for line in (tmp_path / "loads.csv").read_text().splitlines()[1:]]
    assert {row[4] for row in rows} == {"0", "1", "2"}
    assert max(-float(row[7]) for row in rows if row[4] == "2") > 500.0


@pytest.mark.parametrize("speed, weights", [(0.5, 1.51), (1.0, 2.02), (2.0, 3.04), (4.0, 5.08)])
def test_a_foot_hits_as_fast_as_it_lands(speed, weights):
    """TRAIL (3) (4): by the speed of the foot, under a body that stays where it is."""
    rate, tau = 240.0, 0.1
    time = np.arange(int(2.0 * rate)) / rate
    pose = np.zeros((len(time), 7))
    pose[:, 3] = 1.0
    pose[:, 2] = np.maximum(speed * (1.0 - time), 0.0)
    gait = on_one_foot(time, np.tile((0.0, 0.0, 1.0), (len(time), 1)), pose, rate, leg=[size.LEG])
    touching = (time >= 1.0).astype("u1")[None]
    force, point = np.zeros((1, len(time), 3)), np.zeros((1, len(time), 3))
    _native.foot_force(walker.native_gait(gait), touching, np.zeros((1, len(time))), 1, tau, False, force, point)
    inside = (time > 1.0 + 2 / rate) & (time < 1.0 + tau - 2 / rate)
    assert -force[0, inside, 2] / (70 * 9.81) == pytest.approx(weights, abs=0.02)
    after = time > 1.0 + tau + 2 / rate
    assert -force[0, after, 2] / (70 * 9.81) == pytest.approx(1.0, abs=1e-9)


def test_a_heel_lands_with_the_speed_of_the_heel():
    """TRAIL (4): v_heel if the heel lands, v_toe if the toe does, that between them if both do."""
    rate, tau = 240.0, 0.1
    time = np.arange(int(1.5 * rate)) / rate
    spin = np.minimum(time - 1.0, 0.0)  # the foot turns about y while it comes down
    pose = np.zeros((len(time), 7))
    pose[:, 2] = -1.0 * spin
    pose[:, 3], pose[:, 5] = np.cos(2.0 * spin), np.sin(2.0 * spin)  # 4 rad/s: toes come down 0.8 m/s slower
    points = np.array([(-0.1, 0.0, 0.0), (0.1, 0.0, 0.0)])
    both = {"point": points, "point_part": [0, 0], "point_role": [0, 1], "leg": [size.LEG]}
    gait = on_one_foot(time, np.tile((0.0, 0.0, 1.0), (len(time), 1)), pose, rate, **both)
    lands = -np.gradient(walker.point_places(gait)[..., 2], time, axis=1)[:, int(rate) - 8]
    assert abs(lands[0] - lands[1]) > 0.7
    high = np.zeros((2, len(time)))
    for on, speed in (((1, 0), lands[0]), ((0, 1), lands[1]), ((1, 1), lands.mean())):
        ground = np.where(np.array(on, bool)[:, None], high, high - 1.0)  # who does not land is far up
        force, point = np.zeros((1, len(time), 3)), np.zeros((1, len(time), 3))
        _native.foot_force(
            walker.native_gait(gait), (time >= 1.0).astype("u1")[None], ground, 1, tau, False, force, point
        )
        inside = (time > 1.0 + 2 / rate) & (time < 1.0 + tau - 2 / rate)
        assert -force[0, inside, 2] / (70 * 9.81) == pytest.approx(1.0 + speed / tau / 9.81, rel=0.03)


def test_the_soil_under_each_foot_stops_it_in_its_own_time():
    weight = np.zeros((2, 21, 21))
    weight[1, :, 10:] = 1.0  # x > 0 is the second soil
    soils = [Soil(settle_time=0.05), Soil(settle_time=0.2)]
    sim = Simulation(Ground.heights(np.zeros((21, 21)), 0.5, -5.0, -5.0, weight), soils, 0.02)
    assert sim.settle_time([(-2.0, 0.0), (2.0, 0.0), (-3.0, 1.0)]).tolist() == pytest.approx([0.05, 0.2, 0.05])
    far = sim.settle_time([(4.0, 0.0), (9.0, 0.0), (-4.0, 0.0), (-7.0, 0.5)])  # beside the ground: of the nearest point
    assert far.tolist() == pytest.approx([0.2, 0.2, 0.05, 0.05]) and sim.settle_time([(9.0, 0.0)]).shape == (1,)
    both = {}
    for x in (-2.0, 2.0):
        gait = stepping([0.0] * 6)
        gait = replace(gait, pose=gait.pose + np.array([x - 1.5, 0, 0, 0, 0, 0, 0]), com=gait.com + (x - 1.5, 0, 0))
        tau = lambda xy: np.full(len(xy), 0.05 if x < 0 else 0.2)
        want = walker.loads(gait, "impulse", sim.rest_height, settle_time=0.05 if x < 0 else 0.2)
        found = walker.loads(gait, "impulse", sim.rest_height, settle_time=tau)
        assert np.allclose(found.force, want.force)
        both[x] = found.force[..., 2].min()
    assert both[-2.0] < both[2.0]  # the stiffer the shorter, and harder
