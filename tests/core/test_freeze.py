"""How long a pose is held changes no print: in mid-step, at rest, and while another walks."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import bvh, plates, trials
from test_size import scaled

from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion import freeze, size, stays
from desire_path.motion.gait import Gait
from desire_path.placement import place
from desire_path.rig import body
from desire_path.rig.body import Motion

CELL = 0.02
RATE = 30.0


def walk(name="walk"):
    if name == "walk":
        trial = trials.make("walk 1.25 m/s", RATE)
        early = trial.motion.time < 2.45
        return trial.skeleton, Motion(trial.motion.time[early], trial.motion.bones, trial.motion.matrix[early])
    skeleton, motion, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=0.056444)
    matrix = motion.matrix[:: round(rate / RATE)]
    return skeleton, Motion(np.arange(len(matrix)) / RATE, motion.bones, matrix)


def held(motion, at, seconds):
    """The clip with its pose at a sample held for so long."""
    more = round(seconds * RATE)
    pick = np.concatenate([np.arange(at + 1), np.full(more, at), np.arange(at + 1, len(motion.time))])
    return Motion(np.arange(len(pick)) / RATE, motion.bones, motion.matrix[pick])


def gait_of(skeleton, motion, name="Walker"):
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=RATE, name=name)


def prints(*gaits):
    """What they press together, on one ground [m], and their loads."""
    gait = Gait.join(gaits).resample(120.0)
    land = Simulation(Ground.heights(np.zeros((300, 500)), CELL, -3.0, -3.0), "dry-sand", CELL)
    loads = walker.loads(gait, ground=land.rest_height)
    land.load(gait, loads)
    land.run(len(gait.time) - 1)
    return land.read("compression", -150, -150, 500, 300), loads


@pytest.mark.parametrize("name", ["walk", "cmu_02_03_run"])
def test_a_pose_held_in_mid_step_changes_no_print(name):
    skeleton, motion = walk(name)
    alone, before = prints(gait_of(skeleton, motion))
    last = len(motion.time) - 1
    for at, seconds in ((0, 5.0), (last // 2, 0.5), (last // 3, 60.0), (last, 0.5), (last, 5.0)):
        pressed, loads = prints(gait_of(skeleton, held(motion, at, seconds)))
        assert abs(pressed - alone).max() < 1e-3, (at, seconds)
        assert loads.clearance == pytest.approx(before.clearance, abs=1e-6)
        still = slice(4 * at + 1, 4 * (at + round(seconds * RATE)) - 1)
        down = -loads.force[:, still, 2].sum(axis=0)
        assert loads.held[:, still].all() and np.ptp(down) == 0.0 and down.max() <= 75.0 * 9.81 + 1e-6


def jittering(motion, size, seed=1):
    """The clip as it is recorded: every joint off by so much in every frame [m]."""
    matrix = motion.matrix.copy()
    matrix[..., :3, 3] += np.random.default_rng(seed).normal(0, size, matrix[..., :3, 3].shape)
    return replace(motion, matrix=matrix)


def test_a_clip_that_begins_or_ends_with_a_pose_held_for_a_sample_presses_as_it_does_without():
    skeleton, motion = walk()
    alone, _ = prints(gait_of(skeleton, motion))
    for at in (0, len(motion.time) - 1):
        gait = gait_of(skeleton, held(motion, at, 1.0 / RATE))
        assert freeze.holds(gait) == [((0, 1),) if at == 0 else ((at, at + 1),)]
        pressed, _ = prints(gait)
        assert abs(pressed - alone).max() < 1e-3
    inside = gait_of(skeleton, held(motion, len(motion.time) // 2, 1.0 / RATE))
    assert freeze.holds(inside) == [()]  # there it may be slow motion


@pytest.mark.parametrize("noise", [5e-5, 1e-4, 3e-4])
def test_a_held_pose_may_jitter(noise):
    skeleton, motion = walk()
    noisy = jittering(motion, noise)
    alone, _ = prints(gait_of(skeleton, noisy))
    last = len(motion.time) - 1
    for at, seconds in ((0, 2.0), (last // 2, 0.5), (last // 3, 10.0), (last, 2.0)):
        clip, more = held(noisy, at, seconds), round(seconds * RATE)
        matrix, still = clip.matrix.copy(), slice(at + 1, at + more + 1)
        matrix[still] = jittering(held(motion, at, seconds), noise, 2).matrix[still]
        clip = replace(clip, matrix=matrix)
        pressed, loads = prints(gait_of(skeleton, clip))
        assert abs(pressed - alone).max() < 1e-3, (at, seconds)
        assert loads.held[:, 4 * at + 6 : 4 * (at + more) - 6].all()


def test_a_hold_is_found_in_a_noisy_recording_at_any_rate():
    """.. that was made elsewhere; and keys that drift by half a millimetre are a hold as well."""
    skeleton, motion = walk()
    gait = gait_of(skeleton, held(motion, 30, 2.0))
    drift = np.interp(gait.time, [1.0, 3.0], [0.0, 5e-4])
    keyed = replace(gait, com=gait.com + drift[:, None], pose=gait.pose + drift[:, None] * np.eye(7)[0])
    assert freeze.holds(keyed) == [((30, 90),)]
    for rate in (30.0, 60.0, 240.0):
        noisy = plates.noisy(gait.resample(rate), 1e-4)
        ((first, last),) = freeze.holds(noisy)[0]
        assert abs(noisy.time[[first, last]] - (1.0, 3.0)).max() < 0.05


def test_slow_motion_is_no_hold():
    """A walk at a fiftieth of its speed, with noise and without; who brakes in 0.4 s; every recording there is."""
    skeleton, motion = walk()
    plain = gait_of(skeleton, motion)
    slow = replace(plain, time=plain.time * 50.0).resample(RATE)
    fine, time = plain.resample(1200.0), motion.time
    pick = np.round(1200.0 * np.where(time < 0.6, time, 0.8 - (1.0 - np.minimum(time, 1.0)) ** 2 / 0.8)).astype(int)
    ends = replace(fine, time=time, com=fine.com[:, pick], pose=fine.pose[:, pick])
    for gait in (slow, plates.noisy(slow, 1e-4), plates.noisy(ends, 1e-4), plain, plates.noisy(plain, 3e-4)):
        assert freeze.holds(gait) == [()]
    for name in plates.TRIALS:
        assert freeze.holds(plates.trial(name)) == [()], name
    for name in ("cmu_12_01_walk", "cmu_02_03_run", "cmu_02_04_jump", "cmu_03_02_uneven"):
        assert freeze.holds(gait_of(*walk(name))) == [()], name
    for name in trials.TRIALS:
        assert freeze.holds(recorded(name)[1]) == [()], name


def test_a_wait_with_a_sway_hardly_changes_a_print():
    """Recorded people are never quite still: 3 mm to and fro, before the walk and after it, on different feet."""
    skeleton, motion = walk()
    alone, _ = prints(gait_of(skeleton, motion))
    last = len(motion.time) - 1
    more = held(held(motion, last, 20.0), 0, 10.0)
    matrix = more.matrix.copy()
    waits = np.r_[np.arange(300), np.arange(300 + last, len(more.time))]
    matrix[waits, :2, 1, 3] += 0.003 * np.sin(2.0 * more.time[waits])[:, None]  # hips and trunk
    pressed, _ = prints(gait_of(skeleton, replace(more, matrix=matrix)))
    middle = slice(150 + 25, 150 + 100)  # steps between those on which is waited
    assert abs(pressed - alone)[:, middle].max() < 2e-3


def test_two_who_walk_in_turn_leave_what_each_leaves_alone():
    skeleton, motion = walk()
    aside = motion.matrix.copy()
    aside[..., 1, 3] += 1.5
    first, second = motion, replace(motion, matrix=aside)
    last, span = len(motion.time) - 1, motion.time[-1] + 1.0 / RATE
    a, b = gait_of(skeleton, held(first, last, span), "A"), gait_of(skeleton, held(second, 0, span), "B")
    together, _ = prints(a, b)
    assert abs(together - prints(gait_of(skeleton, first))[0] - prints(gait_of(skeleton, second))[0]).max() < 1e-3


def test_a_kneel_presses_its_own_prints_only():
    """Down on the toes of one foot for 30 s after some steps: these are as they were."""
    skeleton, motion = walk()
    alone, _ = prints(gait_of(skeleton, motion))
    last = len(motion.time) - 1
    goes = np.r_[np.zeros(last + 1), np.linspace(0, 1, 30) ** 2 * (3 - 2 * np.linspace(0, 1, 30)), np.ones(900)]
    pick = np.minimum(np.arange(len(goes)), last)
    matrix = motion.matrix[pick]
    matrix[:, :2, 2, 3] -= 0.45 * goes[:, None]  # hips and trunk sink
    bones = list(motion.bones)
    rear = min(("L", "R"), key=lambda side: matrix[last, bones.index(f"foot.{side}"), 0, 3])
    foot, toe = bones.index(f"foot.{rear}"), bones.index(f"toe.{rear}")
    ball = matrix[:, toe, :3, 3]
    c, s = np.cos(0.6 * goes), np.sin(0.6 * goes)
    turn = np.zeros((len(goes), 3, 3))
    turn[:, 0, 0], turn[:, 0, 2], turn[:, 1, 1], turn[:, 2, 0], turn[:, 2, 2] = c, s, 1.0, -s, c
    matrix[:, foot, :3, 3] = ball + np.einsum("tij,tj->ti", turn, matrix[:, foot, :3, 3] - ball)
    matrix[:, foot, :3, :3] = turn @ matrix[:, foot, :3, :3]
    pressed, _ = prints(gait_of(skeleton, Motion(np.arange(len(goes)) / RATE, motion.bones, matrix)))
    before = slice(0, 150 + int(matrix[last, foot, 0, 3] / CELL) - 15)
    assert alone[:, before].max() > 0.01
    assert abs(pressed - alone)[:, before].max() < 1e-3


def recorded(name):
    trial = trials.make(name, 120.0)
    return trial, body.gait_from_bones(trial.skeleton, trial.motion, mass=75.0, frame_rate=120.0)


def test_who_comes_to_rest_has_not_stopped_in_mid_step():
    _, gait = recorded("squats")
    stop = len(gait.time) - 1
    pick = np.minimum(np.arange(len(gait.time) + 240), stop)
    longer = replace(gait, time=np.arange(len(pick)) / 120.0, com=gait.com[:, pick], pose=gait.pose[:, pick])
    assert freeze.holds(longer) == [()]
    loads = walker.loads(longer)
    assert -loads.force[:, -100:, 2].sum(axis=0) == pytest.approx(75.0 * 9.81, rel=0.01)


def test_who_is_held_in_the_air_falls_on():
    trial, gait = recorded("landing")
    air = int(np.argmin(abs(gait.time - (trial.window[0] + 0.15))))
    pick = np.r_[np.arange(air), np.full(120, air), np.arange(air, len(gait.time))]
    floats = replace(gait, time=np.arange(len(pick)) / 120.0, com=gait.com[:, pick], pose=gait.pose[:, pick])
    found = walker.loads(floats)
    assert freeze.holds(floats) == [((air, air + 120),)]
    assert not found.touching[:, air : air + 120].any()
    assert found.force[:, air + 121 :] == pytest.approx(walker.loads(gait).force[:, air + 1 :], abs=1e-6)


def test_stays_are_votes():
    time = np.arange(1000) / 100.0
    mask = np.zeros(1000, bool)
    mask[10:40], mask[100:900], mask[950:960] = True, True, True
    weight = stays.votes(mask, time)
    assert weight[10:40].sum() == pytest.approx(0.2) == pytest.approx(weight[100:900].sum())
    assert weight[950:960].sum() == pytest.approx(0.1)
    values = np.where(np.arange(1000) < 500, 1.0, 3.0)
    assert stays.median(values, weight * (np.arange(1000) < 50) + weight * (np.arange(1000) > 940)) == 1.0
    assert stays.median(np.array([1.0, 2.0, 4.0, 9.0]), np.ones(4)) == 3.0
    random = np.random.default_rng(3).normal(size=(51, 2))
    assert stays.median(random, np.ones(51)) == pytest.approx(np.median(random, axis=0))


def test_a_hold_may_begin_between_two_samples():
    skeleton, motion = walk()
    gait = gait_of(skeleton, held(motion, 30, 1.0))
    plain = gait_of(skeleton, motion)
    for rate in (100.0, 77.0):
        found, want = gait.resample(rate), plain.resample(rate)
        assert len(found.time) == len(want.time) + math.floor(rate + 1e-6)
        after = found.time > 2.5
        x = np.interp(found.time[after] - 1.0, want.time, want.com[0, :, 0])
        assert found.com[0, after, 0] == pytest.approx(x, abs=2e-3)
    assert gait.leg[0] == pytest.approx(size.LEG, rel=0.05)


def test_who_waits_before_a_walk_in_place_is_carried_all_the_same():
    skeleton, motion = walk()
    matrix = motion.matrix.copy()
    matrix[..., 0, 3] -= (1.25 * motion.time)[:, None]
    in_place = replace(motion, matrix=matrix)
    speed = lambda gait: (gait.carried().com - gait.com)[0, -1, 0] / (gait.time[-1] - gait.time[0])
    alone = speed(gait_of(skeleton, in_place))
    assert alone == pytest.approx(1.25, abs=0.05)
    assert speed(gait_of(skeleton, held(in_place, 0, 10.0))) == pytest.approx(alone, abs=0.02)
    small = body.gait_from_bones(*scaled(skeleton, in_place, 0.05), mass=0.01, frame_rate=RATE)
    assert speed(small) == pytest.approx(alone * 0.05**0.5, rel=0.02)


def test_a_wait_does_not_decide_what_a_clip_walked_on():
    """A walk of a level floor over waves of the ground, its first pose held for a minute: it is carried over them."""
    skeleton, motion = walk()
    x = np.arange(-200, 400) * 0.05
    land = Simulation(Ground.heights(np.tile(0.15 * np.sin(2.0 * x), (200, 1)), 0.05, -10.0, -5.0), "dry-sand", 0.02)
    for seconds in (0.0, 60.0):
        assert place.carries(gait_of(skeleton, held(motion, 0, seconds)), land, 0), seconds
