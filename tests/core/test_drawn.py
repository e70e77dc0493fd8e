"""An animation on twos presses as the motion it is drawn from."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import bvh, gaits, trials

from desire_path.loads import walker
from desire_path.motion import drawn, jumps
from desire_path.rig import body, limbs, solid


def on(motion, count, first=0):
    """A clip each of whose poses is held for `count` samples; the first one for so many fewer."""
    pick = np.maximum((np.arange(len(motion.time)) + first) // count * count - first, 0)
    return replace(motion, matrix=np.asarray(motion.matrix)[pick])


def loads_of(skeleton, motion, rate):
    gait = body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)
    return gait, walker.loads(gait)


def contacts(loads):
    """How often a part comes down."""
    return int((np.diff(loads.touching.astype(int), axis=1) == 1).sum())


def clip(name):
    skeleton, motion, rate = bvh.load(bvh.WALKS / f"{name}.bvh", scale=0.056444)
    step = round(rate / 24)
    matrix = np.asarray(motion.matrix)[1::step]
    return skeleton, replace(motion, time=np.arange(len(matrix)) / 24.0, matrix=matrix)


@pytest.mark.parametrize("name", ("walk 1.25 m/s", "walk 0.8 m/s"))
@pytest.mark.parametrize(("count", "first"), ((2, 0), (2, 1), (3, 0), (3, 2)))
def test_twos_press_as_ones_do(name, count, first):
    trial = trials.make(name, 24.0)
    gait, loads = loads_of(trial.skeleton, on(trial.motion, count, first), 24.0)
    assert max(trials.compare(trial, gait, loads).rmse) < (0.1 if count == 2 else 0.2)
    assert f"are held for {count} frames each" in " ".join(gait.warnings)


@pytest.mark.parametrize("name", ("cmu_12_01_walk", "cmu_02_03_run", "cmu_02_04_jump"))
def test_recorded_clips_on_twos_have_their_contacts(name):
    skeleton, motion = clip(name)
    ones, twos = (loads_of(skeleton, each, 24.0)[1] for each in (motion, on(motion, 2)))
    assert abs(contacts(twos) - contacts(ones)) <= 1
    assert (twos.touching != ones.touching).mean() < 0.05


def test_ones_stay_to_the_bit():
    for name in ("cmu_12_01_walk", "cmu_02_04_jump"):
        matrix = np.asarray(clip(name)[1].matrix)
        found, held = drawn.moving(np.arange(len(matrix)) / 24.0, matrix, [])
        assert found is matrix and not held


def test_poses_that_are_drawn_stay_and_those_between_lie_between():
    skeleton, motion = clip("cmu_12_01_walk")
    twos = on(motion, 2)
    found, held = drawn.moving(twos.time, np.asarray(twos.matrix), [])
    assert held == pytest.approx(2 / 24)
    np.testing.assert_array_equal(found[::2], np.asarray(motion.matrix)[::2])
    miss = abs(found - np.asarray(motion.matrix))[4:-4, :, :3, 3].max()
    assert miss < 0.3 * abs(np.asarray(twos.matrix) - np.asarray(motion.matrix))[4:-4, :, :3, 3].max()


def test_a_long_hold_among_twos_is_held():
    skeleton, motion = clip("cmu_12_01_walk")
    matrix = np.asarray(on(motion, 2).matrix)
    matrix = np.concatenate([matrix[:20], np.repeat(matrix[18:19], 40, axis=0), matrix[20:]])
    found, _ = drawn.moving(np.arange(len(matrix)) / 24.0, matrix, [])
    np.testing.assert_array_equal(found[18:58], matrix[18:58])
    assert abs(found[59] - matrix[59]).max() > 1e-3


def test_nothing_moves_over_a_cut():
    skeleton, motion = clip("cmu_12_01_walk")
    away = np.asarray(on(motion, 2).matrix).copy()
    away[24:, :, 0, 3] += 7.0
    gait, _ = loads_of(skeleton, replace(motion, matrix=away), 24.0)
    assert gait.cut.tolist() == [24]
    assert abs(np.diff(gait.com[0, :, 0]))[:23].max() < 0.3 and abs(gait.com[0, 24, 0] - gait.com[0, 23, 0]) > 6.0
    assert jumps.found(gait) is gait


def hopping(count, rate=24.0):
    """A box of 30 cm that hops along X, by its matrices; each held for so many frames."""
    time = np.arange(73) / rate
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    phase = (time * 2.0) % 1.0
    matrix[:, 0, 3], matrix[:, 2, 3] = 0.8 * time, 0.15 + 4.0 * 0.3 * phase * (1.0 - phase)
    return time, matrix[np.arange(len(time)) // count * count]


def box():
    corner = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float) - 0.5
    return corner * 0.3, gaits.BOX_FACES


@pytest.mark.parametrize("count", (2, 3))
def test_rigid_bodies_and_limbs_on_twos_move_as_what_they_are_drawn_from(count):
    vertices, faces = box()
    (time, ones), (_, twos) = hopping(1), hopping(count)
    options = solid.SolidOptions("Box")
    plain = solid.gait_from_solid(time, ones, vertices, faces, mass=20.0, frame_rate=24.0, options=options)
    found = solid.gait_from_solid(time, twos, vertices, faces, mass=20.0, frame_rate=24.0, options=options)
    assert not plain.warnings
    assert found.warnings == (
        f"Poses of Box are held for {count} frames each: prints are those of the motion between them.",
    )
    assert (np.diff(found.com[0, :, 0]) > 0.01).all()  # it never stops
    assert abs(found.com - plain.com).max() < 0.03 * count and abs(twos[:, 0, 3] - ones[:, 0, 3]).max() > 0.03
    skeleton = body.Skeleton(("arm",), np.array([-1], np.int32), np.eye(4)[None], np.array([0.3]))
    skin = body.Skin(vertices, faces, {"arm": np.ones(len(vertices), np.float32)})
    moved = body.Motion(time, ("arm",), twos[:, None])
    limb = limbs.gait_from_limbs(skeleton, moved, skin, mass=20.0, frame_rate=24.0, options=options)
    assert limb.warnings == found.warnings
    np.testing.assert_allclose(limb.pose, found.pose, atol=1e-9)


def test_a_body_on_twos_that_is_put_elsewhere_does_not_fly_there():
    vertices, faces = box()
    time, twos = hopping(2)
    twos = twos.copy()
    twos[36:, 1, 3] += 3.0
    found = solid.gait_from_solid(time, twos, vertices, faces, mass=20.0, frame_rate=24.0)
    assert set(np.round(found.pose[0, :, 1], 6)) == {0.0, 3.0}
