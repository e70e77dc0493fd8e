"""Contacts and loads against slow twins."""

import numpy as np
import pytest
from reference import walker as twin

from desire_path import _native
from desire_path.loads import walker
from tests.core.test_walker import on_one_foot, two_feet

# ---- twins -------------------------------------------------------------------------------------------


def test_share_is_soft22_5():
    random = np.random.default_rng(5)
    for _ in range(50):
        com, left, right = random.normal(size=(3, 3))
        assert _native.foot_share(tuple(com), tuple(left), tuple(right)) == pytest.approx(
            twin.share_right(com, left, right), abs=1e-12
        )


FINE = 240.0  # samples a second at which loads are found: the twins know no other


@pytest.mark.parametrize("seed", range(4))
def test_contact_is_trail_4(seed):
    gait = two_feet(seed, FINE, 600, hover=0.02 * seed - 0.02)
    on, clearance = walker.contacts(gait, 0.0)
    v_com = twin.speed(gait.com[0], FINE, 3.0)
    for p in (0, 1):
        height, speeds = gait.pose[p, :, 2], twin.speed(gait.pose[p, :, :3], FINE, 20.0)
        assert clearance[p] == pytest.approx(twin.resting_height(height, speeds), abs=1e-12)
        want = twin.touches(height, speeds, v_com, clearance[p], p == 0, twin.drops(gait.pose[p, :, :3], FINE, 20.0))
        for value in (False, True):
            want = twin.without_runs(want, value, 0.03 * FINE)
        rise = np.gradient(twin.low_pass(gait.pose[p, :, 2], FINE, 20.0), 1 / FINE)
        want = twin.arrives(want, height, clearance[p], rise, FINE)
        want = twin.leaves(want, np.gradient(rise + speeds, 1 / FINE), FINE)
        for value in (False, True, False, True):
            want = twin.without_runs(want, value, 0.03 * FINE)
        assert (on[p] == want).all()
        assert 0.4 < on[p].mean() < 0.8


@pytest.mark.parametrize("seed", range(4))
def test_inertia_is_newton_shared(seed):
    gait = two_feet(seed, FINE, 600)
    loads = walker.loads(gait, "inertia")
    on = loads.touching.astype(bool)
    downs = np.concatenate([np.diff(np.flatnonzero(np.diff(row.astype(int)) == 1)) for row in on])
    period = float(np.sort(downs / FINE / 2)[(len(downs) - 1) // 2])
    cutoff = min(max(3.0 / period, 5.0), 10.0)
    feet = gait.pose[:, :, :3] * (1, 1, 0)
    want = twin.inertia_of_two(gait.com[0], 70.0, feet, on, FINE, cutoff)
    assert abs(loads.force - want).max() < 1e-6 * 70 * 9.81
    both = on.all(axis=0)
    assert both.sum() > 20 and (loads.force[:, both, 2].sum(axis=0) < 0).all()


def hop(seed, rate=FINE, count=480):
    """A body that hops on one foot: stances of 0.2 s, flights of 0.3 s, and what a camera adds."""
    random = np.random.default_rng(seed)
    time = np.arange(count) / rate
    phase = time % 0.5
    press = np.where(phase < 0.2, 2.5 * np.pi / 2 * np.sin(np.pi * np.clip(phase / 0.2, 0, 1)), 0.0)
    v = np.cumsum((press - press[: int(rate)].mean()) * 9.81) / rate
    z = np.cumsum(v - v[: int(rate)].mean()) / rate + 1.0 + random.normal(0, 5e-4, count)
    pose = np.zeros((count, 7))
    pose[:, 3] = 1.0
    swing = np.clip((phase - 0.2) / 0.3, 0, 1)
    pose[:, 2] = 0.15 * np.sin(np.pi * swing)
    pose[:, 0] = np.floor(time / 0.5) + swing**2 * (3 - 2 * swing)
    return on_one_foot(time, np.stack([2.0 * time, 0 * z, z], axis=1), pose, rate), press


@pytest.mark.parametrize("seed", range(3))
def test_who_flies_falls_freely(seed):
    gait, press = hop(seed)
    loads = walker.loads(gait)
    on = loads.touching[0] != 0
    downs = np.flatnonzero(on[1:] & ~on[:-1])
    cutoff = min(max(3.0 / (np.sort(np.diff(downs))[(len(downs) - 2) // 2] / FINE), 8.0), 10.0)
    want = 9.81 + twin.flown_acceleration(gait.com[0, :, 2], ~on, FINE, cutoff, -9.81)
    want = np.where(on & (want > 0), -70.0 * want, 0.0)
    assert abs(loads.force[0, :, 2] - want).max() < 1e-3 * 70 * 9.81
    inside = slice(120, -120)
    error = -loads.force[0, inside, 2] / (70 * 9.81) - press[inside]
    assert np.sqrt((error**2).mean()) < 0.3
    assert loads.mean[0] == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize("seed", range(4))
def test_impulse_is_trail_3(seed):
    gait = two_feet(seed, FINE, 600)
    loads = walker.loads(gait, "impulse", settle_time=0.2)
    on = loads.touching.astype(bool)
    want = twin.impulse_of_two(gait.com[0], 70.0, walker.point_places(gait), on, FINE, 0.2)
    assert abs(loads.force - want).max() < 1e-6 * 70 * 9.81


def test_sphere_from_two_and_a_half_metres():
    """MODEL 11.11: 50 kg, tau 0.2 s: 2241 N at impact."""
    peaks = []
    for rate in (60.0, 120.0, 240.0, 24.0):
        time = np.arange(int(2 * rate)) / rate
        z = np.maximum(2.5 - 0.5 * 9.81 * time**2, 0.0)
        pose = np.zeros((len(time), 7))
        pose[:, 2], pose[:, 3] = z, 1.0
        gait = on_one_foot(time, pose[:, :3] + (0, 0, 0.1), pose, rate, mass=[50.0])
        loads = walker.loads(gait, "impulse")
        peaks.append(-loads.force[0, :, 2].min())
    assert peaks[:3] == pytest.approx([2241] * 3, rel=0.05)
    assert peaks[3] == pytest.approx(2241, rel=0.3)  # 42 ms between frames: the impact lies in between
