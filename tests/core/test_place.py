"""Feet on slopes: against a literal twin, and prints up, down and across a hill. TRAIL (1) (2), MODEL 11.13"""

import math
from dataclasses import fields, replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from reference import place as twin
from scenes import beasts, bvh

from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground, Simulation
from desire_path.loads import walker
from desire_path.motion.gait import BALL, HEEL, TIP, Gait, Sole
from desire_path.placement import place
from desire_path.rig import body

WALK = Path(__file__).resolve().parents[1] / "scenes" / "walks" / "cmu_12_01_walk.bvh"
SOLE = Sole([[-0.1, -0.05, 0], [0.1, -0.05, 0], [0.1, 0.05, 0], [-0.1, 0.05, 0]], [[0, 1, 2], [0, 2, 3]])
CELL = 0.01


def plane(x, y, height=0.0, half=8.0):
    """Ground that rises by x and y along the axes."""
    step = np.linspace(-half, half, 65)
    across, along = np.meshgrid(step, step)
    return Ground.heights(height + x * across + y * along, 2 * half / 64, -half, -half)


@lru_cache(maxsize=1)
def cmu():
    skeleton, motion, rate = bvh.load(WALK, scale=0.056444)
    return body.gait_from_bones(skeleton, motion, mass=75.0, frame_rate=rate)


def quaternions(random, count, most):
    """Turns about any axis by at most `most` [rad], then about z by anything."""
    axis = random.normal(size=(count, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    half, yaw = random.uniform(-most, most, count) / 2, random.uniform(-1.5, 1.5, count)
    w, (x, y, z) = np.cos(half), np.sin(half) * axis.T
    c, s = np.cos(yaw), np.sin(yaw)
    return np.stack([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w], axis=1)


# ---- the twin ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("roll", [True, False])
def test_places_as_trail_1_and_2_say(seed, roll):
    random = np.random.default_rng(seed)
    count = 20
    pose = np.zeros((2, count, 7))
    pose[0, :, :3] = random.uniform((-1, -1, 0), (1, 1, 0.25), (count, 3))
    pose[1, :, :3] = pose[0, :, :3] + random.uniform(-0.2, 0.2, (count, 3))
    pose[:, :, 3:] = quaternions(random, 2 * count, 0.5).reshape(2, count, 4)
    points = [np.array([(-0.06, 0.01, 0.0), (0.14, 0, 0.0)]), np.array([(0, 0, 0), (0.06, 0, 0.0)])]
    gait = Gait(
        time=np.arange(count) / 20.0,
        com=np.tile((0.0, 0.0, 0.9), (1, count, 1)),
        mass=[70.0],
        pose=pose,
        limb_walker=[0],
        part_limb=[0, 0],
        soles=(SOLE, SOLE),
        point=np.concatenate(points),
        point_part=[0, 0, 1, 1],
        point_role=[HEEL, BALL, BALL, TIP],
        frame_rate=20.0,
    )
    x, y = random.uniform(-0.6, 0.6, 2)
    normal = np.array([-x, -y, 1.0]) / math.sqrt(x * x + y * y + 1)
    got = place.place_feet(
        gait, plane(x, y, 5.0), roll=roll, carry=True, floor=0.0, options=place.PlaceOptions(reach=0.3, toe_slope=0.1)
    )
    clearance = walker.contacts(gait)[1]
    tips = walker.point_places(gait)[[0, 3], :, 2] - clearance[[0, 3], None]
    for t in range(count):
        want = twin.place(
            pose[:, t],
            points,
            tips[:, t],
            lambda a, b: 5.0 + x * a + y * b,
            normal,
            floor=0.0,
            d_max=0.3,
            theta_0=0.1,
            flat=not roll,
        )
        for part, (at, turn) in enumerate(want):
            np.testing.assert_allclose(got.pose[part, t, :3], at, atol=2e-6)  # heights are float32
            np.testing.assert_allclose(twin.matrix(got.pose[part, t, 3:]), turn, atol=2e-6)
    np.testing.assert_allclose(got.com[0, :, 2], 0.9 + 5.0, atol=1e-5)


# ---- what holds of any walk -------------------------------------------------------------------------


def test_level_ground_leaves_a_walk_as_it_is():
    gait = cmu()
    for carry in (None, False):
        same = place.place_feet(gait, Ground.flat(), carry=carry)
        np.testing.assert_allclose(same.pose, gait.pose, atol=1e-9)
        np.testing.assert_array_equal(same.com, gait.com)
    raised = place.place_feet(gait, Ground.flat(2.0), carry=True, floor=0.0)
    np.testing.assert_allclose(raised.pose[..., 2], gait.pose[..., 2] + 2.0, atol=1e-9)
    np.testing.assert_allclose(raised.com, gait.com + (0, 0, 2.0), atol=1e-9)


def test_a_walk_of_the_hill_is_not_carried_twice():
    hill = plane(0.2, -0.3)
    once = place.place_feet(cmu(), hill)
    land = Simulation(hill)
    assert place.carries(cmu(), land, 0) and not place.carries(once, land, 0)
    again = place.place_feet(once, hill)
    np.testing.assert_array_equal(again.com, once.com)
    np.testing.assert_array_equal(again.pose, once.pose)
    # one who is on the hill with level feet has them turned
    level = replace(once, pose=np.concatenate([once.pose[..., :3], cmu().pose[..., 3:]], axis=2))
    turned = place.place_feet(level, hill)
    np.testing.assert_array_equal(turned.com, once.com)
    stands = walker.loads(once, ground=land.rest_height).touching != 0
    up = [
        np.stack(
            [
                2 * (q[..., 1] * q[..., 3] + q[..., 0] * q[..., 2]),
                2 * (q[..., 2] * q[..., 3] - q[..., 0] * q[..., 1]),
                1 - 2 * (q[..., 1] ** 2 + q[..., 2] ** 2),
            ],
            axis=-1,
        )
        for q in (each.pose[..., 3:] for each in (level, turned, once))
    ]
    aligned = [np.mean(np.sum(each * up[2], axis=-1)[stands]) for each in up]
    assert aligned[0] < 0.96 < 0.99 < aligned[1]


@pytest.mark.parametrize("size", [1.0, 0.1])
def test_a_small_walk_is_told_from_one_of_the_hill(size):
    """A bird's steps differ by millimetres where a person's differ by centimetres."""
    bones = beasts.skeleton()
    moved = beasts.motion(bones, speed=0.3, stride=0.9, duty=0.65, phases=(0.0, 0.5, 0.75, 0.25), seconds=3.0)
    scale = np.ones((4, 4))
    scale[:3, 3] = size
    bones = replace(bones, rest=bones.rest * scale, length=bones.length * size)
    moved = replace(moved, matrix=moved.matrix * scale)
    land = Simulation(plane(0.05, 0.15))
    level = body.gait_from_bones(bones, moved, mass=1.0, frame_rate=120.0)
    assert place.carries(level, land, 0)
    assert not place.carries(place.place_feet(level, land, carry=True), land, 0)


def test_it_stands_and_weighs_as_on_the_floor():
    gait = cmu()
    land = Simulation(plane(0.1, -0.25, 3.0))
    placed = place.place_feet(gait, land)
    flat, hill = walker.loads(gait), walker.loads(placed, ground=land.rest_height)
    assert not hill.warnings
    assert hill.mean == pytest.approx(flat.mean, rel=0.01)
    assert (hill.touching != flat.touching).mean() < 0.04
    # nobody stands in the hill
    places = walker.point_places(placed)
    over = places[..., 2] - land.rest_height(places[..., :2].reshape(-1, 2)).reshape(places.shape[:2])
    before = walker.point_places(gait)[..., 2]
    assert over.min() > min(before.min() - np.median(walker.contacts(gait)[1]), 0.0) - 1e-6


def test_on_rough_ground_the_body_goes_smoothly():
    x = np.arange(-3.0, 3.0, 0.05)
    random = np.random.default_rng(2)
    rough = Ground.heights(random.uniform(-0.02, 0.02, (len(x), len(x))), 0.05, -3.0, -3.0)
    placed = place.place_feet(cmu(), rough, carry=True)
    rise = placed.com[0, :, 2] - cmu().com[0, :, 2]
    assert np.ptp(rise) < 0.01
    assert walker.loads(placed, ground=Simulation(rough).rest_height).mean == pytest.approx([1.0], abs=0.03)


def test_a_trunk_on_four_feet_leans_along_the_slope():
    bones = beasts.skeleton()
    motion = beasts.motion(bones, speed=1.0, stride=1.0, duty=0.6, seconds=2.0, rate=60.0)
    gait = body.gait_from_bones(bones, motion, mass=30.0, frame_rate=60.0)
    up, aside = 0.36, 0.2  # along -Y, the way it walks, and along X
    placed = place.place_feet(gait, plane(aside, -up), carry=True)
    turn = place.tilt(gait, placed)
    normal = turn[:, :, 2] / turn[:, 2:, 2]
    np.testing.assert_allclose(normal[:, 1], up, atol=0.02)
    np.testing.assert_allclose(normal[:, 0], -place.ROLL * aside, atol=0.02)
    np.testing.assert_allclose(turn @ np.swapaxes(turn, 1, 2), np.tile(np.eye(3), (len(turn), 1, 1)), atol=1e-9)
    assert abs(turn[:, 0, 1] - turn[:, 1, 0]).max() < 1e-9  # it does not turn about
    np.testing.assert_allclose(place.tilt(gait, gait), np.tile(np.eye(3), (len(turn), 1, 1)), atol=1e-12)
    walk = cmu()
    assert place.tilt(walk, place.place_feet(walk, plane(0.0, -up), carry=True)) is None  # people stay upright


def test_one_of_two_walkers():
    gait = cmu()
    two = Gait.join([gait, replace(gait, walker_name=("Other",))])
    placed = place.place_feet(two, plane(0.2, 0.1), walkers=[1])
    alone = place.place_feet(gait, plane(0.2, 0.1))
    parts = len(gait.part_limb)
    np.testing.assert_array_equal(placed.pose[:parts], gait.pose)
    np.testing.assert_array_equal(placed.com[0], gait.com[0])
    np.testing.assert_allclose(placed.pose[parts:], alone.pose, atol=1e-12)


@pytest.mark.parametrize(
    "words, arguments",
    [
        ("walks beside the ground", {"ground": Ground.heights(np.zeros((3, 3)), 0.1, 50.0, 50.0), "carry": True}),
        ("A reach of 0 m", {"options": place.PlaceOptions(reach=0.0)}),
        ("toe slope of -1", {"options": place.PlaceOptions(toe_slope=-1.0)}),
        ("radius of a foot of -1 m", {"options": place.PlaceOptions(foot_radius=-1.0)}),
        ("no walker 3", {"walkers": [3]}),
        ("floor's height", {"floor": math.nan}),
        ("Ground or a Simulation", {"ground": 0.0}),
    ],
)
def test_what_cannot_be_is_a_sentence(words, arguments):
    arguments = {"ground": plane(0.1, 0.1), **arguments}
    with pytest.raises(DesirePathError, match=words):
        place.place_feet(cmu(), **arguments)


def test_options_may_be_given_one_by_one():
    options = place.PlaceOptions(reach=0.3, toe_slope=0.1, foot_radius=0.3, body_radius=0.2)
    gait, land = cmu(), Ground.heights(np.random.default_rng(1).random((120, 120)) * 0.2, 0.2, -12.0, -12.0)
    placed = place.place_feet(gait, land, options=options)
    with pytest.warns(DeprecationWarning, match=r"written place_feet\(options=PlaceOptions\(reach="):
        assert place.place_feet(gait, land, reach=0.3, toe_slope=0.1, foot_radius=0.3, body_radius=0.2) == placed
    for each in fields(options):
        usual = replace(options, **{each.name: each.default})
        assert place.place_feet(gait, land, options=usual) != placed, each.name


# ---- MODEL 11.13, TRAIL Fig. 12 -----------------------------------------------------------------------


def tracks(steep, turned):
    """Prints of the walk on a slope that rises by `steep` [degrees] along its way turned by `turned`.

    (median length of a whole print along the slope, how far the heaps' centre lies ahead of the prints', how
    far to the left) [m]
    """
    gait = cmu()
    way = gait.com[0, -1, :2] - gait.com[0, 0, :2]
    ahead = math.atan2(way[1], way[0])
    rise = math.tan(math.radians(steep))
    land = Simulation(plane(rise * math.cos(ahead + turned), rise * math.sin(ahead + turned)), "dry-sand", CELL)
    placed = place.place_feet(gait, land)
    land.load(placed, walker.loads(placed, ground=land.rest_height))
    i0, i1, j0, j1 = land.reach()
    land.run(len(placed.time) - 1)
    land.settle()
    pressed, heap = (land.read(name, i0, j0, i1 - i0, j1 - j0) for name in ("compression", "heap"))
    x, y = np.meshgrid((np.arange(i0, i1) + 0.5) * CELL, (np.arange(j0, j1) + 0.5) * CELL)
    along = x * math.cos(ahead) + y * math.sin(ahead)
    aside = y * math.cos(ahead) - x * math.sin(ahead)
    centre = lambda of, weight: float((of * weight).sum() / weight.sum())
    prints = np.sort(along[pressed > 0.25 * pressed.max()])
    cuts = np.flatnonzero(np.diff(prints) > 0.2) + 1
    assert 6 <= len(cuts) + 1 <= 8
    lengths = [np.ptp(each) for each in np.split(prints, cuts)][1:-1]
    stretch = math.hypot(1.0, rise * math.cos(turned))
    return (
        float(np.median(lengths)) * stretch,
        centre(along, heap) - centre(along, pressed),
        centre(aside, heap) - centre(aside, pressed),
    )


def test_prints_of_a_hill():
    level, fore, _ = tracks(0.0, 0.0)
    up, up_fore, _ = tracks(25.0, 0.0)
    down, down_fore, _ = tracks(25.0, math.pi)
    side, _, side_left = tracks(25.0, math.pi / 2)  # rises to the left
    assert up < 0.75 * level  # toes alone
    assert down > 1.03 * level > level > up  # the whole foot, and it slides
    assert side > 0.97 * level
    assert up_fore < fore - 0.02 and down_fore > fore + 0.02  # the heap behind; ahead
    assert side_left < -0.02  # on the low side
    gentle, _, _ = tracks(10.0, 0.0)
    assert gentle > 0.95 * level  # below theta_0 heels come down
