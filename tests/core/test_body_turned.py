"""Bones that rest, point, are mirrored or scaled in any way."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.loads import walker
from desire_path.motion import rotation
from desire_path.rig.body import Motion
from tests.core.test_body import flat_sample, gait, person, places, walk


@pytest.mark.parametrize(
    "turn", [np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]), np.array([[0, 0, -1], [1, 0, 0], [0, -1, 0]])]
)
def test_any_rest_orientation(turn):
    plain, turned = person(), person(turn=turn)
    a, b = gait(plain, walk(plain)), gait(turned, walk(turned, turn=turn))
    assert b.com == pytest.approx(a.com, abs=1e-9)
    for part in range(4):
        assert places(b, part)[40] == pytest.approx(places(a, part)[40], abs=2e-3)


def retailed(bones, motion, parts, tail, length):
    """The same joints and motion with the tails of some bones elsewhere."""
    y = np.array(tail, float) / np.linalg.norm(tail)
    x = np.cross(y, [0.3, 0.5, 0.81])
    x /= np.linalg.norm(x)
    turn = np.stack([x, y, np.cross(x, y)], axis=1)
    rest, matrix, lengths = bones.rest.copy(), motion.matrix.copy(), bones.length.copy()
    for k, name in enumerate(bones.names):
        if name.startswith(parts):
            own = rest[k, :3, :3].T @ turn
            rest[k, :3, :3], matrix[:, k, :3, :3] = rest[k, :3, :3] @ own, matrix[:, k, :3, :3] @ own
            lengths[k] = length
    return replace(bones, rest=rest, length=lengths), Motion(motion.time, motion.bones, matrix)


@pytest.mark.parametrize(
    "toes, parts", [(True, ("foot", "toe")), (True, ("toe",)), (True, ("foot",)), (False, ("foot",))]
)
@pytest.mark.parametrize(
    "tail, length",
    [
        ((0, 0, 1), 0.1),
        ((0, 0, -1), 0.1),
        ((0, 0, 1), 5.0),
        ((1, 0, 0), 0.1),
        ((-1, 0.2, 0.1), 0.2),
        ((0, -1, 0), 5.0),
        ((0, 1, 0), 0.1),
        ((1, 1, 1), 0.2),
    ],
)
def test_tails_of_bones_may_point_anywhere(toes, parts, tail, length):
    bones = person(toes=toes)
    want = gait(bones, walk(bones))
    if not toes and tail[1] > 0.9:
        return  # a foot of one bone that points back may be of a mirrored body
    g = gait(*retailed(bones, walk(bones), parts, tail, length))
    for part in range(4):
        ahead = [rotation.matrix(each.pose[part, :, 3:])[..., 0] for each in (g, want)]
        assert np.degrees(np.arccos(np.clip((ahead[0] * ahead[1]).sum(axis=1), -1, 1))).max() < (1 if toes else 10)
        assert abs(g.pose[part, :, :3] - want.pose[part, :, :3]).max() < (1e-3 if toes else 0.045)
        size = [np.ptp(each.soles[part].vertices[:, 0]) for each in (g, want)]
        assert size[0] == pytest.approx(size[1], rel=0.02 if toes else 0.15)


@pytest.mark.parametrize("mirrored", [False, True])
def test_upright_feet_of_a_mirrored_body_point_ahead(mirrored):
    """Foot bones that stand tell no direction: left and right do, the other way round in a mirrored body."""
    bones, motion = retailed(person(toes=False), walk(person(toes=False)), ("foot",), (0, 0, 1), 0.1)
    if mirrored:
        other_side = np.ones((4, 4))
        other_side[0, 3] = -1.0
        motion = replace(motion, matrix=motion.matrix * other_side)
        bones = replace(bones, rest=bones.rest * other_side, mirrored=True)
    g = gait(bones, motion)
    assert (rotation.matrix(g.pose[:, flat_sample(g), 3:])[:, 1, 0] < -0.9).all()


@pytest.mark.parametrize("scale", [0.01, 1.0, 100.0])
def test_any_scale(scale):
    bones = person(scale=scale)
    motion = walk(bones, scale=scale)
    g = gait(bones, motion)
    length = np.ptp(np.concatenate([places(g, 0)[40], places(g, 1)[40]])[:, 1])
    assert length == pytest.approx(0.234 * scale, rel=0.1)
    assert np.isfinite(g.pose).all()


def test_scaled_matrices_leave_rotations_alone():
    bones = person()
    motion = walk(bones)
    big = replace(motion, matrix=motion.matrix * np.array([2, 2, 2, 1.0]))
    a, b = gait(bones, motion), gait(bones, big)
    assert b.pose[:, :, 3:] == pytest.approx(a.pose[:, :, 3:], abs=1e-9)


def test_a_still_pose_and_a_single_frame():
    bones = person()
    for count in (1, 2, 5, 60):
        motion = Motion(np.arange(count) / 24, bones.names, np.tile(bones.rest, (count, 1, 1, 1)))
        g = gait(bones, motion)
        both = np.concatenate([places(g, 0)[0], places(g, 1)[0]])
        assert both[:, 2].min() == pytest.approx(0.0, abs=0.04)
        loads = walker.loads(g)
        assert loads.touching.any()
        total = -loads.force[:, :, 2].sum(axis=0) / (70 * 9.81)
        assert total == pytest.approx(np.ones(count), abs=1e-6)
