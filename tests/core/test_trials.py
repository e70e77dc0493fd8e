"""Loads of walkers whose forces are known, and their prints, at any frame rate."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scenes import bvh, plates, trials

from desire_path.bake import bake
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.rig import body


def loads_of(trial):
    gait = body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=trial.rate)
    return gait, walker.loads(gait)


# RMSE of a foot at 120 frames a second, and at 24 [body weights]; a knock of the ground shorter than the
# filters is lost, but for landings out of flights long enough to tell that nothing was recorded but the body
WITHIN = {
    "walk 1.25 m/s": (0.04, 0.05),
    "walk 0.8 m/s": (0.04, 0.04),
    "walk 1.9 m/s": (0.05, 0.05),
    "run 3.8 m/s": (0.09, 0.11),
    "run 2.6 m/s": (0.08, 0.10),
    "sprint 9 m/s": (0.13, 0.10),
    "landing": (0.02, 0.03),
    "landing, uneven": (0.07, 0.07),
    "squats": (0.01, 0.01),
    "squats, uneven": (0.01, 0.01),
}


@pytest.mark.parametrize("name", trials.TRIALS)
def test_known_forces_are_found(name):
    for rate, within in zip((120.0, 24.0), WITHIN[name]):
        found = trials.errors(name, rate)
        assert max(found.rmse) <= within, rate
        assert found.mean == pytest.approx(1.0, abs=0.02)
        assert max(abs(found.late), default=0.0) <= 1.01 / rate + 0.02


@pytest.mark.parametrize("rate", [240.0, 60.0, 48.0, 30.0, 25.0])
def test_an_uneven_landing_is_shared_at_any_frame_rate(rate):
    assert max(trials.errors("landing, uneven", rate).rmse) <= 0.11


@pytest.mark.parametrize("name", trials.TRIALS)
def test_no_constant_carries_the_known_forces(name):
    """Each constant moved by 30 % either way; 4 ms earlier, one sample, a sprint's stance of 105 ms tells 0.031."""
    trial = trials.make(name, 120.0)
    gait, loads = loads_of(trial)
    base = trials.compare(trial, gait, loads).rmse
    for table, kind in ((walker.LIMITS, "limits"), (walker.OPTIONS, "options")):
        for constant, value in table.items():
            for factor in (0.7, 1.3):
                moved = walker.loads(gait, **{kind: {constant: value * factor}})
                most = abs(trials.compare(trial, gait, moved).rmse - base).max()
                assert most <= (0.032 if name.startswith("sprint") else 0.03), (constant, factor)


@pytest.mark.parametrize("name", trials.TRIALS)
def test_few_frames_tell_as_much(name):
    """Thinned to 24, 25 or 30 frames a second, wherever the first one falls."""
    fine = trials.make(name, 480.0)
    for rate in (24.0, 25.0, 30.0):
        rmse = []
        for begin in np.arange(4) / 4 * 480.0 / rate:
            pick = np.round(np.arange(begin, len(fine.time) - 1, 480.0 / rate)).astype(int)
            trial = replace(
                fine,
                rate=rate,
                time=fine.time[pick],
                force=fine.force[:, pick],
                motion=replace(fine.motion, time=fine.time[pick], matrix=fine.motion.matrix[pick]),
            )
            found = trials.compare(trial, *loads_of(trial))
            assert found.mean == pytest.approx(1.0, abs=0.03), (rate, begin)
            rmse.append(found.rmse)
        assert np.mean(rmse) <= 0.8 * trials.TRIALS[name][1], rate


PUSHES = {
    "half a sine": lambda u: np.sin(np.pi * u),
    "blunt": lambda u: np.clip(np.sin(np.pi * u), 0, 1) ** 0.6,
    "sharp": lambda u: np.clip(np.sin(np.pi * u), 0, 1) ** 1.5,
    "late": lambda u: np.sin(np.pi * u**1.25),
    "early": lambda u: np.sin(np.pi * u**0.7),
    "with a knock": trials.heel_run,
}


@pytest.mark.parametrize("push", PUSHES)
def test_bounces_of_any_shape_are_found_in_few_frames(push):
    """A jog over the heel, a run and a sprint, at 24 frames a second."""
    over = dict(wide=0.05, strike=-0.25, flat=(0.18, 0.45), leave=1.0, arrive=(1.2, -0.9), part=(1.5, 1.6))
    ball = dict(wide=0.03, strike=0.35, flat=(1.0, 0.0), leave=1.1, arrive=(1.5, -1.8), part=(3.0, 2.5))
    for speed, step, contact, feet, within in (
        (2.4, 0.37, 0.30, over, 0.06),
        (3.8, 0.355, 0.22, over, 0.11),
        (9.0, 0.225, 0.105, ball, 0.15),
    ):
        trial = trials.build(trials.steps(speed, step, contact, PUSHES[push], **feet), 3.0, rate=24.0, height=0.94)
        found = trials.compare(trial, *loads_of(trial))
        assert np.mean(found.rmse) <= within, speed
        assert found.mean == pytest.approx(1.0, abs=0.03), speed


def test_boxes_may_be_too_high_to_show():
    """Who stands on one is held up by something, and flies from where he begins to fall."""
    for drop in (0.3, 0.5):
        trial = trials.landing(120.0, drop=drop)
        assert max(trials.compare(trial, *loads_of(trial)).rmse) <= 0.054, drop
    # on one just as high as feet may stand over the ground, noise does not lift them
    trial = trials.make("landing")
    gait = plates.noisy(loads_of(trial)[0], 0.001)
    assert max(trials.compare(trial, gait, walker.loads(gait)).rmse) <= 0.06


@pytest.mark.parametrize("name", trials.TRIALS)
def test_a_wobbling_trunk_does_little(name):
    """5 mm of what skin and breath add to the hips."""
    found = trials.errors(name, 120.0, shake=0.0025)
    assert max(found.rmse) <= trials.TRIALS[name][1]
    assert found.mean == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("ball_up", [0.01, 0.05])
@pytest.mark.parametrize("ankle", [0.03, 0.13])
def test_joints_may_lie_anywhere_over_the_sole(ball_up, ankle):
    trial = trials.make("walk 1.25 m/s", ball_up=min(ball_up, ankle), lower=ankle)
    gait, loads = loads_of(trial)
    assert max(trials.compare(trial, gait, loads).rmse) <= 0.06


def test_truth_is_newton():
    """The trials hold what they promise: the mass centre moves as the forces move it."""
    for name in trials.TRIALS:
        trial = trials.make(name, 240.0)
        accel = np.gradient(np.gradient(trial.com, trial.time, axis=0), trial.time, axis=0)
        force = trial.force.sum(axis=0) / trial.mass - [0, 0, 9.81]
        inside = slice(40, -40)
        smooth = lambda x: np.stack([np.convolve(x[:, c], np.ones(9) / 9, "same") for c in range(3)], axis=1)
        assert abs(smooth(accel) - smooth(force))[inside].max() < 1.0, name
        gait, _ = loads_of(trial)
        assert abs(gait.com[0] - trial.com).max() < 0.005, name


# ---- the same prints at any frame rate ---------------------------------------------------------------------

CELL = 0.01
MOVES = (
    "cmu_12_01_walk",
    "cmu_02_03_run",
    "cmu_02_04_jump",
    "gait_bmc_walk1",
    "gait_opensim_walk",
    "run 3.8 m/s",
    "landing",
)


def moves(name):
    if name in trials.TRIALS:
        trial = trials.make(name, 240.0)
        return body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=240.0)
    if name in plates.TRIALS:
        return plates.trial(name)
    skeleton, motion, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=0.056444)
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)


def print_of(gait, rate):
    """(pressed volume [m^3], mean of the deepest 2 % of the cells [m]) as a bake at this frame rate has them."""
    gait = replace(gait.resample(rate), frame_rate=rate)
    gait = gait.resample(rate * math.ceil(bake.SAMPLE_RATE / rate - 1e-6))
    low = gait.pose[..., :2].min(axis=(0, 1)) - 1.0
    size = ((gait.pose[..., :2].max(axis=(0, 1)) + 1.0 - low) / CELL).astype(int)
    land = Simulation(Ground.heights(np.zeros(size[::-1]), CELL, *low), "dry-sand", CELL)
    land.load(gait, walker.loads(gait, ground=land.rest_height))
    land.run(len(gait.time) - 1)
    i0, i1, j0, j1 = land.reach()
    pressed = np.sort(land.read("compression", i0, j0, i1 - i0, j1 - j0).ravel())
    count = (pressed > 0).sum()
    return pressed.sum() * CELL**2, pressed[-max(1, count // 50) :].mean()


@pytest.mark.parametrize("name", MOVES)
def test_prints_do_not_depend_on_the_frame_rate(name):
    gait = moves(name).resample(240.0)
    # as long at every rate: the last sixth of a second is whole at 24 and at 30
    keep = gait.time <= gait.time[0] + math.floor((gait.time[-1] - gait.time[0]) * 6 + 1e-9) / 6 + 1e-6
    gait = replace(gait, time=gait.time[keep], com=gait.com[:, keep], pose=gait.pose[:, keep])
    volume, depth = print_of(gait, 240.0)
    for rate in (24.0, 30.0, 60.0, 120.0):
        found = print_of(gait, rate)
        assert found[0] == pytest.approx(volume, rel=0.07), (
            rate
        )  # the knock of a landing, and how far it slips, show in few frames only
        assert found[1] == pytest.approx(depth, rel=0.06), rate
