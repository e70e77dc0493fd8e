"""A take that is shown again, or after another one, presses what it does alone; a hold takes nothing of the pace."""

import numpy as np
import pytest
from scenes import trials
from test_freeze import CELL, gait_of, walk

from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from desire_path.loads import walker
from desire_path.motion import freeze, stays
from desire_path.rig import body
from desire_path.rig.body import Motion


def prints(gait):
    """What it presses in a soil that is the same everywhere [m], and its loads."""
    gait = gait.resample(120.0)
    land = Simulation(Ground.heights(np.zeros((300, 500)), CELL, -3.0, -3.0), Soil(), CELL)
    loads = walker.loads(gait, ground=land.rest_height)
    land.load(gait, loads)
    land.run(len(gait.time) - 1)
    return land.read("compression", -150, -150, 500, 300), loads


def again(motion, aside, rate=30.0):
    """A clip, and once more from the beginning, so far to one side [m]."""
    second = motion.matrix.copy()
    second[..., :3, 3] += aside
    matrix = np.concatenate([motion.matrix, second])
    return Motion(np.arange(len(matrix)) / rate, motion.bones, matrix)


@pytest.mark.parametrize(("name", "aside"), [("walk", (0.0, 1.0, 0.0)), ("cmu_02_03_run", (1.6, 0.0, 0.0))])
def test_each_round_of_a_repeated_clip_presses_as_the_clip_alone(name, aside):
    skeleton, motion = walk(name)
    alone, before = prints(gait_of(skeleton, motion))
    gait = gait_of(skeleton, again(motion, aside))
    assert len(gait.cut) == 1
    pressed, after = prints(gait)
    shift = [round(aside[1] / CELL), round(aside[0] / CELL)]
    assert alone.max() > 0.01
    for back in ((0, 0), (-shift[0], -shift[1])):
        there = np.roll(pressed, back, axis=(0, 1))
        assert abs(there - alone)[alone > 1e-4].max() < 1e-3
    count = before.force.shape[1]
    # up to its last sample before the cut it presses with the force it has there
    assert np.allclose(after.force[:, count - 1], before.force[:, -1], atol=1.0)
    assert not after.touching[:, count - 1 : count + 1].any()  # over the cut it does not


def test_a_foot_is_found_flat_in_the_same_samples_however_often_a_clip_is_repeated():
    skeleton, motion = walk("cmu_02_03_run")
    alone, twice = gait_of(skeleton, motion), gait_of(skeleton, again(motion, (1.6, 0.0, 0.0)))
    count = len(motion.time)
    assert abs(np.asarray(twice.pose)[:, :count] - np.asarray(alone.pose)).max() < 1e-9
    assert all(abs(a.vertices - b.vertices).max() < 1e-9 for a, b in zip(alone.soles, twice.soles))


def test_runs_and_their_votes_end_at_a_cut():
    mask, time = np.array([1, 1, 1, 1, 0, 1], bool), np.arange(6) * 0.1
    assert stays.runs(mask) == [(0, 4), (5, 6)]
    assert stays.runs(mask, (2,)) == [(0, 2), (2, 4), (5, 6)]
    assert stays.votes(mask, time).tolist() == pytest.approx([0.05] * 4 + [0.0, 0.1])
    assert stays.votes(mask, time, cut=(2,)).tolist() == pytest.approx([0.1] * 4 + [0.0, 0.1])


@pytest.mark.parametrize("at", [0.4, 1.0])
def test_a_hold_that_is_no_round_number_of_samples_leaves_the_pace_around_it(at):
    """25 frames a second in 120 samples: the hold begins and ends between two of them."""
    trial = trials.make("walk 1.25 m/s", 25.0)
    motion = Motion(np.arange(50) / 25.0, trial.motion.bones, trial.motion.matrix[:50])
    begin = round(at * 49)
    pick = np.concatenate([np.arange(begin + 1), np.full(11, begin), np.arange(begin + 1, 50)])
    stopped = Motion(np.arange(len(pick)) / 25.0, motion.bones, motion.matrix[pick])
    even = gait_of_25(trial.skeleton, stopped).resample(120.0)
    (((first, last),),) = freeze.holds(even)
    moves = freeze.without(even, ((first, last),))
    alone = gait_of_25(trial.skeleton, motion).resample(120.0)
    assert len(moves.time) == pytest.approx(len(alone.time), abs=1)
    count = min(len(moves.time), len(alone.time))
    assert abs(moves.com[0, :count] - alone.com[0, :count]).max() < 1e-6
    force = walker.loads(even).force[:, : first + 1]
    assert abs(force - walker.loads(alone).force[:, : first + 1]).max() < 1.0


def gait_of_25(skeleton, motion):
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=25.0)
