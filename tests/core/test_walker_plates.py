"""Loads of recorded walkers against force plates, at any frame rate and with any constant moved."""

from dataclasses import replace

import numpy as np
import pytest
from reference import walker as twin
from scenes import bvh, plates

from desire_path.loads import walker
from desire_path.rig import body

# ---- plates ----------------------------------------------------------------------------------------------


def errors(name, model="inertia", gait=None, window=None, **more):
    gait = gait or plates.trial(name)
    return plates.errors(name, walker.loads(gait, model, **more), gait, window)


@pytest.mark.parametrize("name", plates.TRIALS)
def test_forces_hold_up_against_plates(name):
    """MODEL 11.12"""
    found = errors(name)
    print(
        f"{name}: RMSE {found.rmse[0]:.3f} {found.rmse[1]:.3f} body weights, r {found.r[0]:.3f} {found.r[1]:.3f}, "
        f"mean {found.mean:.3f}, edges off by {1000 * abs(found.late).max():.0f} ms"
    )
    assert max(found.rmse) <= plates.TRIALS[name].within
    assert 0.96 <= found.mean <= 1.03
    assert max(abs(found.late)) <= 0.03
    if name in plates.WALKS:
        assert min(found.r) >= 0.98
        papers = errors(name, "impulse")
        assert max(papers.rmse) <= 0.20 and min(papers.r) >= 0.90


def test_walks_are_near_the_plates_on_average():
    assert np.mean([errors(name).rmse for name in plates.WALKS]) <= 0.05


@pytest.mark.parametrize("name", plates.TRIALS)
def test_recordings_may_have_any_frame_rate(name):
    """Edges are told to within a frame, forces as well as by the recording itself."""
    gait = plates.trial(name)
    base = errors(name, gait=gait)
    for rate in (240.0, 150.0, 120.0, 100.0, 60.0, 50.0, 48.0, 30.0, 25.0, 24.0):
        seen = replace(gait.resample(rate), frame_rate=rate)
        found = errors(name, gait=seen)
        assert max(found.rmse - base.rmse) <= (0.02 if rate >= 100.0 else 0.04), rate
        assert max(abs(found.late)) <= 0.03 + 1.0 / rate, rate


def test_the_last_plate_of_bmc_misses_weight():
    """From 2.1 s on its plates add up to a body that falls; the recorded one does not."""
    gait = plates.trial("gait_bmc_walk1")
    total = plates.measured("gait_bmc_walk1", gait.time).weight.sum(axis=0)
    late = gait.time > 2.1
    gained = ((total[late] - 1.0) * 9.81).sum() / gait.rate()
    speed = np.gradient(twin.low_pass(gait.com[0, :, 2], gait.rate(), 6.0), gait.time)[late]
    assert gained < -0.7 and speed[-1] - speed[0] > -0.25  # [m/s]


@pytest.mark.parametrize("name", plates.WALKS)
def test_feet_push_and_brake_as_on_plates(name):
    assert max(errors(name).drive) <= 0.045


@pytest.mark.parametrize("name", plates.WALKS)
def test_no_stance_is_broken(name):
    gait = plates.trial(name)
    on = plates.by_foot(gait, walker.loads(gait))[1]
    assert max(len(twin.stances(row)) for row in on) <= 3


@pytest.mark.parametrize("name", plates.WALKS)
def test_centre_of_pressure_holds_up_against_plates(name):
    apart = errors(name).apart
    print(f"{name}: centre of pressure {apart[0] * 100:.1f} {apart[1] * 100:.1f} cm off")
    assert max(apart) < 0.03


@pytest.mark.parametrize("name", plates.TRIALS)
def test_no_constant_carries_the_result(name):
    """Each constant moved by 30 % either way moves the errors by 0.03 at most."""
    gait = plates.trial(name)
    base = errors(name, gait=gait).rmse
    for table, kind in ((walker.LIMITS, "limits"), (walker.OPTIONS, "options")):
        for constant, value in table.items():
            for factor in (0.7, 1.3):
                moved = errors(name, gait=gait, **{kind: {constant: value * factor}}).rmse
                assert abs(moved - base).max() <= 0.03, constant


@pytest.mark.parametrize("name", plates.WALKS)
def test_a_trial_seen_otherwise_weighs_the_same(name):
    """Fewer frames, noise, another floor, mirrored, fewer bones."""
    gait = plates.trial(name)
    base = errors(name, gait=gait)
    seen = {rate: gait.resample(rate) for rate in (24.0, 30.0, 60.0, 120.0, 240.0)}
    seen |= {
        "noise": plates.noisy(gait, 0.001),
        "up": plates.raised(gait, 0.05),
        "down": plates.raised(gait, -0.05),
        "tilt": plates.tilted(gait, np.radians(0.5)),
        "steep": plates.tilted(gait, np.radians(4.0)),
        "far up": plates.raised(gait, 0.3),
        "mirror": plates.mirrored(gait),
        "no toes": plates.trial(name, without=("Toe",)),
        "no knees": plates.trial(name, without=("LeftLeg", "RightLeg", "UpLeg")),
        "no spine": plates.trial(name, without=("Spine", "Neck")),
    }
    for what, other in seen.items():
        found = errors(name, gait=other)
        assert max(found.rmse - base.rmse) <= 0.02, what
        assert max(abs(found.late)) <= 0.055 and max(found.apart) <= 0.03, what


def test_frame_rate_does_not_matter():
    name = plates.WALKS[0]
    base = errors(name).rmse
    for every in (2, 5):  # 75 and 30 frames a second
        assert abs(errors(name, gait=plates.trial(name, every)).rmse - base).max() < 0.008
    gait = plates.trial(name)
    whole = None
    for rate in (240, 120, 60, 30, 24):
        loads = walker.loads(gait.resample(rate))
        impulse = -loads.force[..., 2].sum() / rate
        whole = whole or impulse
        assert impulse == pytest.approx(whole, rel=0.02)


CLIPS = (
    ("cmu_12_01_walk", (3, 5), 0.1),
    ("cmu_02_03_run", (1, 3), 0.8),
    ("cmu_02_04_jump", (2, 3), 0.7),
    ("cmu_03_02_uneven", (2, 5), 0.5),
)


@pytest.mark.parametrize("name,stances,air", CLIPS)
def test_clips_without_plates(name, stances, air):
    skeleton, motion, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=0.056444)
    gait = body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)
    loads = walker.loads(gait)
    force, on, _ = plates.by_foot(gait, loads)
    force = force[..., 2]
    for foot in on:
        assert stances[0] <= len(twin.stances(foot)) <= stances[1]
    assert (~on.any(axis=0)).mean() * gait.time[-1] < air
    assert 0.8 < loads.mean[0] < 1.1
    assert (force >= -1e-9).all() and force.sum(axis=0).max() < 4.0
    if name.endswith("jump"):
        flight = ~on.any(axis=0)
        assert flight[gait.time > 1.0][0] and force[:, flight].max() == 0.0
