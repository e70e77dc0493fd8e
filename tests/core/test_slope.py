"""Feet that lie on a slope have soles that do: a walk on a tilted floor is the walk, tilted."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import beasts

from desire_path.ground.sim import Ground, Simulation
from desire_path.motion import rotation
from desire_path.rig import body, rigs, slope
from desire_path.rig.body import Motion, SoleSource
from desire_path.rig.foot import FootShape
from tests.core.test_body import person, walk
from tests.core.test_place import plane

TILT = 0.25  # [rad]


def turn_about(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def on_hill(motion, turn):
    matrix = motion.matrix.copy()
    matrix[..., :3, :] = turn @ matrix[..., :3, :]
    return Motion(motion.time, motion.bones, matrix)


def level_and_tilted(bones, motion, axis, mass):
    """A turn about an axis, a walk on level ground, and the same walk turned, on ground that is."""
    turn = turn_about(axis, TILT)
    normal = turn[:, 2]
    land = Simulation(plane(-normal[0] / normal[2], -normal[1] / normal[2]))
    usual = {"mass": mass, "frame_rate": 120.0}
    tilted = body.gait_from_bones(bones, on_hill(motion, turn), soles=body.SoleSource(land=land), **usual)
    return turn, body.gait_from_bones(bones, motion, **usual), tilted


@pytest.mark.parametrize("toes", [True, False])
@pytest.mark.parametrize("axis", [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (1, 2, 0)])
def test_a_tilted_walk_is_the_walk_tilted(toes, axis):
    skeleton = person(toes=toes)
    motion = walk(skeleton)
    turn, flat, tilted = level_and_tilted(skeleton, motion, axis, 70.0)
    np.testing.assert_allclose(tilted.pose[..., :3], flat.pose[..., :3] @ turn.T, atol=2e-3)
    np.testing.assert_allclose(
        rotation.matrix(tilted.pose[..., 3:]), turn @ rotation.matrix(flat.pose[..., 3:]), atol=0.02
    )
    for one, other in zip(flat.soles, tilted.soles):
        np.testing.assert_allclose(one.vertices, other.vertices, atol=1e-3)
    # who takes it for level has other soles
    wrong = body.gait_from_bones(skeleton, on_hill(motion, turn), mass=70.0, frame_rate=120.0)
    apart = rotation.matrix(wrong.pose[..., 3:]) - turn @ rotation.matrix(flat.pose[..., 3:])
    assert np.abs(apart).max() > 0.1


def test_level_feet_over_a_slope_stay_level():
    skeleton = person()
    motion = walk(skeleton)
    flat = body.gait_from_bones(skeleton, motion, mass=70.0, frame_rate=120.0)
    for land in (
        Simulation(Ground.flat(1.0)),
        Simulation(plane(0.1, 0.25)),
        Simulation(Ground.heights(np.zeros((3, 3)), 0.1, 50.0, 50.0)),
    ):
        same = body.gait_from_bones(skeleton, motion, mass=70.0, frame_rate=120.0, soles=SoleSource(land=land))
        np.testing.assert_array_equal(same.pose, flat.pose)


def test_known_shapes_are_kept():
    skeleton = person()
    motion = walk(skeleton)
    shape = FootShape(
        ball=0.15,
        tip=0.25,
        heel=-0.04,
        ankle_height=0.1,
        ball_height=0.04,
        foot_turn=np.eye(3),
        toe_turn=np.eye(3),
        ball_side=0.0,
    )
    gait = body.gait_from_bones(
        skeleton, motion, mass=70.0, frame_rate=120.0, soles=SoleSource(shapes={"foot.L": shape})
    )
    left = gait.soles[2 * gait.limb_name.index("foot.L")].vertices
    assert left[:, 0].min() == pytest.approx(-0.04, abs=1e-6)
    turn = motion.matrix[:, motion.bones.index("foot.L"), :3, :3]
    part = 2 * gait.limb_name.index("foot.L")
    np.testing.assert_allclose(rotation.matrix(gait.pose[part, :, 3:]), turn, atol=1e-9)


def test_back_undoes_flattened():
    random = np.random.default_rng(3)
    turn = np.array([turn_about(random.normal(size=3), 0.3) for _ in range(20)])
    hill = slope.Slope(turn, random.normal(size=(20, 3)))
    pose = np.concatenate([random.normal(size=(20, 3)), rotation.quaternion(turn[::-1])], axis=1)

    class Bones:
        column, turns = {"foot": 0}, {}
        matrix = np.tile(np.eye(4), (20, 1, 1, 1))

    Bones.matrix[:, 0, :3, :3] = rotation.matrix(pose[:, 3:])
    Bones.matrix[:, 0, :3, 3] = pose[:, :3]
    flat = hill.flattened(Bones(), ("foot", None)).matrix[:, 0]
    level = np.concatenate([flat[:, :3, 3], rotation.quaternion(flat[:, :3, :3])], axis=1)
    back = hill.back(level)
    np.testing.assert_allclose(back[:, :3], pose[:, :3], atol=1e-12)
    np.testing.assert_allclose(rotation.matrix(back[:, 3:]), rotation.matrix(pose[:, 3:]), atol=1e-12)
    # what lies on the slope lies at height 0
    on = hill.at + np.einsum("tij,j->ti", turn, (0.3, -0.2, 0.0))
    Bones.matrix[:, 0, :3, 3] = on
    np.testing.assert_allclose(hill.flattened(Bones(), ("foot",)).matrix[:, 0, 2, 3], 0.0, atol=1e-12)


def trot(roll):
    """A beast's bones and a walk of a level floor, in which feet roll over their toes by so much while they stand."""
    bones = beasts.skeleton()
    moved = beasts.motion(bones, speed=0.8, stride=0.9, duty=0.65, phases=(0.0, 0.5, 0.75, 0.25))
    matrix = moved.matrix.copy()
    for k, name in enumerate(bones.names):
        if "foot" not in name:
            continue
        toe = matrix[:, bones.names.index(name.replace("foot", "toe")), :3, 3]
        phase = moved.time / 0.9 + {"front_foot.L": 0.0, "front_foot.R": 0.5, "foot.L": 0.75, "foot.R": 0.25}[name]
        turn = np.array([turn_about((1, 0, 0), roll * min(u / 0.65, 1.0)) for u in phase % 1.0])
        matrix[:, k, :3, 3] = toe + np.einsum("tij,tj->ti", turn, matrix[:, k, :3, 3] - toe)
        matrix[:, k, :3, :3] = turn @ matrix[:, k, :3, :3]
    return bones, Motion(moved.time, moved.bones, matrix)


@pytest.mark.parametrize("toes", [True, False])
@pytest.mark.parametrize("roll", [0.3, -0.3, 0.0])
@pytest.mark.parametrize("along, across", [(0.25, 0.0), (-0.25, 0.0), (0.2, 0.15)])
def test_a_beast_of_a_level_floor_stays_level(toes, roll, along, across):
    """Feet that roll ahead while they stand turn towards one slope or the other; where they stand tells the truth."""
    bones, motion = trot(roll)
    rig = rigs.detect(bones)
    if not toes:
        rig = rigs.build(bones, [replace(foot, toe=None) for foot in rig.feet])
    flat = body.gait_from_bones(bones, motion, mass=30.0, frame_rate=120.0, rig=rig)
    same = body.gait_from_bones(
        bones, motion, mass=30.0, frame_rate=120.0, rig=rig, soles=SoleSource(land=Simulation(plane(across, along)))
    )
    np.testing.assert_array_equal(same.pose, flat.pose)


@pytest.mark.parametrize("roll", [0.3, -0.3, 0.0])
@pytest.mark.parametrize("axis", [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (1, 2, 0)])
def test_a_beast_of_a_hill_lies_on_it(roll, axis):
    bones, motion = trot(roll)
    turn, flat, tilted = level_and_tilted(bones, motion, axis, 30.0)
    np.testing.assert_allclose(tilted.pose[..., :3], flat.pose[..., :3] @ turn.T, atol=5e-3)
