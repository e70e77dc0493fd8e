"""Loads of walkers whose forces are known: walks, runs, sprints, landings and squats."""

import numpy as np
import pytest

from desire_path import body, walker
from scenes import trials


def loads_of(trial):
    gait = body.gait_from_bones(trial.skeleton, trial.motion, mass=trial.mass, frame_rate=trial.rate)
    return gait, walker.loads(gait)


# RMSE of a foot at 120 frames a second, and at 24 [body weights]; a knock of the ground shorter than the
# filters is lost, and 24 frames a second hold two of a sprinter's stance
WITHIN = {"walk 1.25 m/s": (0.04, 0.06), "walk 0.8 m/s": (0.04, 0.05), "walk 1.9 m/s": (0.05, 0.07),
          "run 3.8 m/s": (0.10, 0.14), "run 2.6 m/s": (0.10, 0.13), "sprint 9 m/s": (0.14, 0.22),
          "landing": (0.07, 0.08), "landing, uneven": (0.15, 0.22), "squats": (0.02, 0.02),
          "squats, uneven": (0.05, 0.05)}


@pytest.mark.parametrize("name", trials.TRIALS)
def test_known_forces_are_found(name):
    for rate, within in zip((120.0, 24.0), WITHIN[name]):
        found = trials.errors(name, rate)
        assert max(found.rmse) <= within, rate
        assert found.mean == pytest.approx(1.0, abs=0.04 if rate > 30 else 0.06)
        assert max(abs(found.late), default=0.0) <= 1.01 / rate + 0.02


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
