"""Bodies that lean into slopes and swing, and what giving ground costs them. SOFT22 (1), SOFT22 3.2, MODEL 4.5, 4.6"""

import math
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from reference import walker as twin
from scenes import beasts, bvh, gaits

from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground, Simulation
from desire_path.placement import balance, effort, place
from desire_path.placement.balance import BalanceOptions, swing, torque
from desire_path.rig import body

WALK = Path(__file__).resolve().parents[1] / "scenes" / "walks" / "cmu_12_01_walk.bvh"
USUAL = BalanceOptions()


@lru_cache(maxsize=1)
def walk():
    skeleton, motion, rate = bvh.load(WALK, scale=0.056444)
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)


def walking():
    """Steps of a body of numbers, on level ground."""
    return gaits.strides(3.0, rate=60.0)[0]


def trot():
    bones = beasts.skeleton()
    moved = beasts.motion(bones, speed=1.0, seconds=1.0, rate=30.0)
    return body.gait_from_bones(bones, moved, mass=40.0, frame_rate=30.0)


def hill(along, across=0.0):
    """Ground that rises where the walk goes, and to its left."""
    ahead = walk().com[0, -1, :2] - walk().com[0, 0, :2]
    x, y = ahead / np.hypot(*ahead)
    rate = (along * x - across * y, along * y + across * x)
    step = np.linspace(-8.0, 8.0, 65)
    a, b = np.meshgrid(step, step)
    return Ground.heights(rate[0] * a + rate[1] * b, 0.25, -8.0, -8.0)


def leaned(along, across=0.0, **numbers):
    placed = place.place_feet(walk(), ground := hill(along, across), carry=True)
    return balance.lean(placed, Simulation(ground).rest_height, options=BalanceOptions(**numbers))


# ---- SOFT22 (1) -------------------------------------------------------------------------------------


def test_no_torque_where_the_mass_centre_stands_over_the_middle():
    """SOFT22 (1): over the middle nothing turns the body; behind it, it is turned forward; a swing is braked."""
    target, along = np.array([[2.0, 3.0, 0.1]]), np.array([[0.6, 0.8, 0.0]])
    over, still = target + (0.0, 0.0, 1.2), np.zeros(1)
    assert torque(target, over, along, still, USUAL) == [0.0]
    assert torque(target, over + (0.8, -0.6, 0.0), along, still, USUAL) == pytest.approx([0.0], abs=1e-12)  # beside it
    assert torque(target, over - 0.1 * along, along, still, USUAL) == pytest.approx([3.0])
    assert torque(target, over, along, np.array([0.5]), USUAL) == pytest.approx([-3.0])


def test_the_torque_is_as_printed():
    """SOFT22 (1), against its twin: any place of the mass centre, any heading, any swing."""
    random = np.random.default_rng(2)
    target, com, heading = random.normal(size=(20, 3)), random.normal(size=(20, 3)), random.uniform(0, 7, 20)
    along = np.stack([np.cos(heading), np.sin(heading), 0 * heading], axis=1)
    turning, options = random.normal(size=20), BalanceOptions(stiffness=22.0, damping=4.5)
    printed = [twin.tilt(*each, 22.0, 4.5) for each in zip(target, com, along, turning)]
    np.testing.assert_allclose(torque(target, com, along, turning, options), printed, rtol=1e-12)


@pytest.mark.parametrize("height", [0.01, 1.0, 3.0])
def test_a_body_swings_as_a_damped_pendulum(height):
    """Its frequency is sqrt(alpha / h) and its damping beta / (2 sqrt(alpha)), by the formula, for any size."""
    omega, zeta = math.sqrt(30.0 / height), 6.0 / (2.0 * math.sqrt(30.0))
    time = np.linspace(0.0, 3.0 * 2.0 * math.pi / omega, 500)
    wanted = np.full(len(time), 0.2)
    wanted[0] = 0.0  # it is drawn aside within the first step
    angle = swing(wanted, time, height, USUAL)
    damped = omega * math.sqrt(1.0 - zeta**2)
    t = time - 0.5 * time[1]
    free = 0.2 * (1.0 - np.exp(-zeta * omega * t) * (np.cos(damped * t) + zeta * omega / damped * np.sin(damped * t)))
    assert np.abs(angle - free)[2:].max() < 2e-4
    assert angle.max() == pytest.approx(0.2 * (1.0 + math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2))), rel=1e-3)


@pytest.mark.parametrize("damping", [0.0 + 1.0, 6.0, 2.0 * math.sqrt(30.0), 60.0])
def test_a_swing_is_what_the_torque_says(damping):
    """I theta'' = T of SOFT22 (1), under, at and over critical damping, and however finely it is sampled."""
    options = replace(USUAL, damping=damping)
    time = np.linspace(0.0, 4.0, 4001)
    wanted = 0.2 * np.sin(2.0 * time) + 0.1 * time
    angle = swing(wanted, time, 1.0, options)
    rate = np.gradient(angle, time)
    level = np.array([[1.0, 0.0, 0.0]])
    told = torque(wanted[:, None] * level, angle[:, None] * level, level, rate, options)
    assert np.abs(np.gradient(rate, time) - told)[5:-5].max() < 2e-3 * np.abs(told).max()
    assert np.abs(swing(wanted[::100], time[::100], 1.0, options) - angle[::100]).max() < 1e-3


def test_a_step_of_the_pendulum_may_be_of_any_length():
    """Exact for straight angles: half the samples, the same swing."""
    time = np.array([0.0, 0.5, 0.6, 1.7, 4.0, 9.0])
    wanted = np.interp(time, [0.0, 9.0], [0.1, 0.5])
    fine = np.linspace(0.0, 9.0, 901)
    whole = swing(np.interp(fine, time, wanted), fine, 0.9, USUAL)
    assert np.allclose(swing(wanted, time, 0.9, USUAL), np.interp(time, fine, whole), atol=1e-9)


# ---- bodies on slopes -------------------------------------------------------------------------------


def test_no_lean_on_level_ground():
    """Feet that rest at one height lean nobody at all; a recorded floor that slopes by a per cent, hardly."""
    assert np.abs(balance.lean(walk()).angle).max() < math.radians(0.8)
    told = balance.lean(walking())
    assert np.abs(told.angle).max() < 1e-6 and np.abs(told.turns() - np.eye(3)).max() < 1e-6


@pytest.mark.parametrize("slope", [-0.3, -0.1, 0.1, 0.3])
def test_a_body_leans_forward_uphill_and_back_downhill(slope):
    told = leaned(slope)
    middle = slice(len(told.time) // 4, -len(told.time) // 4)
    assert told.grade[middle] == pytest.approx(slope, abs=0.035)
    assert told.angle[middle] == pytest.approx(math.atan(0.5 * slope), abs=math.radians(1.5))
    up = told.turns()[:, :, 2]
    assert (np.sum(up[:, :2] * told.heading, axis=1)[middle] * slope > 0.0).all()
    assert np.allclose(np.sum(up[:, :2] * told.heading, axis=1), np.sin(told.angle))


def test_a_slope_to_the_side_leans_nobody():
    told = leaned(0.0, 0.3)
    assert np.abs(told.angle).max() < math.radians(2.0)


def test_half_the_share_is_half_the_lean_and_none_is_none():
    whole, half, none = (leaned(0.15, share=share).angle for share in (0.5, 0.25, 0.0))
    assert np.allclose(half, 0.5 * whole, rtol=0.02, atol=1e-4) and not none.any()


def test_ground_that_gives_under_one_foot_swings_the_body():
    """Where every step sinks after it has come down, the foot ahead stands higher, and the body nods forward."""
    gait = walk()
    pose = gait.pose.copy()
    own = gait.part_limb == 0
    pose[own, :, 2] -= 0.08  # the left foot stands deeper
    told, level = balance.lean(replace(gait, pose=pose), 0.0), balance.lean(gait, 0.0)
    assert np.ptp(told.angle[1:]) > 4.0 * np.ptp(level.angle[1:]) and np.abs(np.diff(told.angle[1:], 2)).max() < 1e-3


def test_who_does_not_lean_is_told():
    with pytest.raises(DesirePathError, match="not go on two feet"):
        balance.lean(trot())
    with pytest.raises(DesirePathError, match="no walker 3"):
        balance.lean(walk(), walker=3)
    for name, value in (("share", 2.0), ("stiffness", 0.0), ("damping", math.nan)):
        with pytest.raises(DesirePathError, match=name):
            balance.lean(walk(), options=BalanceOptions(**{name: value}))


# ---- effort -----------------------------------------------------------------------------------------


def test_effort_grows_with_the_depth_of_prints():
    """eta = 1.3 + 0.08 z: 1 on firm ground, 2.5 in 15 cm of snow, 4.1 at most; sand 2.1, brush 1.2 to 1.5."""
    depth = [0.0, 0.03, 0.15, 0.25, 0.35, 2.0]
    assert effort.effort(depth) == pytest.approx([1.0, 1.54, 2.5, 3.3, 4.1, 4.1])
    assert (np.diff(effort.effort(np.linspace(0.0, 0.4, 100))) >= 0.0).all()
    assert effort.effort([0.0, 0.2], "sand") == pytest.approx([2.1, 2.9])
    assert effort.effort(0.0, cover=[0.0, 0.5, 1.0]) == pytest.approx([1.0, 1.35, 1.5])


def test_a_time_curve_slows_by_the_root_of_the_effort():
    time = np.linspace(0.0, 10.0, 241)
    assert np.allclose(effort.time_curve(time, np.ones(241)), time)
    assert np.allclose(effort.time_curve(time, np.full(241, 2.25)), 1.5 * time)
    curve = effort.time_curve(time, np.where(time < 5.0, 1.0, 4.0))
    pace = np.gradient(curve, time)
    assert pace[:96] == pytest.approx(1.0) and pace[-96:] == pytest.approx(2.0) and (np.diff(pace) > -1e-9).all()


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: effort.effort(0.1, "cheese"), "effort on 'cheese'"),
        (lambda: effort.effort(-0.1), "depth that is none"),
        (lambda: effort.effort(0.1, cover=2.0), "cover that is none"),
        (lambda: effort.time_curve([0.0, 1.0], [1.0]), "times that rise"),
        (lambda: effort.time_curve([1.0, 0.0], [1.0, 1.0]), "times that rise"),
        (lambda: effort.time_curve([0.0, 1.0], [1.0, 0.5]), "below that on firm ground"),
    ],
)
def test_efforts_that_cannot_be_are_told(call, words):
    with pytest.raises(DesirePathError, match=words):
        call()
