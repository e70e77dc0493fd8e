"""A leg that reaches for its foot: lengths, planes, straight knees, hips that come down."""

import numpy as np
import pytest

from desire_path.rig import leg

COUNT = 40


def legs(seed=0, bend=0.3):
    """Hips, knees, ankles of a leg that hangs down and bends ahead (+X)."""
    random = np.random.default_rng(seed)
    hip = random.normal(0.0, 0.1, (COUNT, 3)) + (0, 0, 0.9)
    angle = random.uniform(0.2, 1.0, COUNT) * bend
    sway = random.uniform(-0.2, 0.2, COUNT)
    thigh = np.stack([np.sin(angle), 0.1 * sway, -np.cos(angle)], axis=1)
    shank = np.stack([-np.sin(angle), 0.1 * sway, -np.cos(angle)], axis=1)
    thigh /= np.linalg.norm(thigh, axis=1, keepdims=True)
    shank /= np.linalg.norm(shank, axis=1, keepdims=True)
    return hip, hip + 0.45 * thigh, hip + 0.45 * thigh + 0.40 * shank


AHEAD = np.tile((1.0, 0.0, 0.0), (COUNT, 1))


def turned(turn, v):
    return np.einsum("tij,tj->ti", turn, v)


@pytest.mark.parametrize("seed", range(3))
def test_the_ankle_comes_to_its_target(seed):
    hip, knee, ankle = legs(seed)
    target = ankle + np.random.default_rng(seed).uniform((-0.2, -0.1, 0.0), (0.2, 0.1, 0.25), (COUNT, 3))
    target = hip + (target - hip) * np.minimum(0.84 / np.linalg.norm(target - hip, axis=1), 1.0)[:, None]
    thigh, shank, new_knee = leg.reach(hip, knee, ankle, target, AHEAD)
    for turn in (thigh, shank):
        np.testing.assert_allclose(turn @ np.swapaxes(turn, 1, 2), np.tile(np.eye(3), (COUNT, 1, 1)), atol=1e-12)
        assert (np.linalg.det(turn) > 0).all()
    np.testing.assert_allclose(hip + turned(thigh, knee - hip), new_knee, atol=1e-9)
    np.testing.assert_allclose(new_knee + turned(shank, ankle - knee), target, atol=1e-6)
    assert (np.cross(target - hip, new_knee - hip)[:, 1] < 0).all()  # knees stay ahead


def test_nothing_changes_where_nothing_has_to():
    hip, knee, ankle = legs()
    thigh, shank, new_knee = leg.reach(hip, knee, ankle, ankle, AHEAD)
    np.testing.assert_allclose(new_knee, knee, atol=1e-9)
    np.testing.assert_allclose(thigh, np.tile(np.eye(3), (COUNT, 1, 1)), atol=1e-9)
    np.testing.assert_allclose(shank, np.tile(np.eye(3), (COUNT, 1, 1)), atol=1e-9)


@pytest.mark.parametrize("bend", [0.0, -0.02])
def test_straight_knees_bend_ahead(bend):
    hip, knee, ankle = legs(bend=bend)
    for ahead, sign in ((AHEAD, 1.0), (np.tile((0.0, 1.0, 0.0), (COUNT, 1)), 0.0)):
        _, _, new_knee = leg.reach(hip, knee, ankle, ankle + (0, 0, 0.1), ahead)
        middle = 0.53 * (ankle - hip) + hip
        assert ((new_knee - middle) @ (1, 0, 0) > 0.05).all() == bool(sign)
        assert ((new_knee - middle) @ ahead[0] > 0.05).all()


def test_an_elbow_bends_back():
    hip, knee, ankle = legs(bend=0.8)
    _, _, new_knee = leg.reach(hip, knee, ankle, ankle + (0, 0, 0.1), -AHEAD)
    assert (new_knee[:, 0] > knee[:, 0]).all()


def test_hips_come_down_to_what_legs_reach():
    hip, knee, ankle = legs()
    np.testing.assert_array_equal(leg.drop(hip, knee, ankle, ankle), 0.0)
    target = ankle - (0, 0, 0.3)
    down = leg.drop(hip, knee, ankle, target)
    assert (down > 0.1).all() and (down < 0.3 + 1e-9).all()
    far = np.linalg.norm(target - (hip - down[:, None] * (0, 0, 1)), axis=1)
    was = np.linalg.norm(ankle - hip, axis=1)
    np.testing.assert_allclose(far, np.maximum(leg.STRETCH * 0.85, was), rtol=1e-9)
    # as straight as it was it may be
    straight = legs(bend=0.0)
    np.testing.assert_allclose(leg.drop(*straight, straight[2]), 0.0, atol=1e-12)


def test_hips_come_down_without_jolts():
    down = np.zeros(60)
    down[30] = 0.1
    eased = leg.eased(down, 5)
    assert (eased >= down - 1e-12).all() and eased.max() == pytest.approx(0.1)
    assert abs(np.diff(eased)).max() < 0.01 and (eased[:15] == 0).all()
    np.testing.assert_array_equal(leg.eased(down, 0), down)
