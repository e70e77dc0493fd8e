"""Rigid bodies: what they weigh on, where they touch, and what they press. MODEL 11.1"""

import numpy as np
import pytest

from desire_path import DesirePathError, Ground, Simulation, Soil
from desire_path.loads import walker
from desire_path.motion.points import point_places
from desire_path.rig import limbs, solid
from desire_path.rig.skeleton import Motion, Skeleton, Skin
from tests.scenes.gaits import BOX_FACES


def box(size, at=(0.0, 0.0, 0.0)):
    corner = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float) - 0.5
    return corner * size + at, BOX_FACES


def barrel(radius, wide, sides=360):
    """A closed cylinder that lies along X."""
    angle = np.arange(sides) * 2 * np.pi / sides
    ring = np.stack([np.zeros(sides), np.cos(angle), np.sin(angle)], axis=1) * radius
    vertices = np.concatenate([ring - (wide / 2, 0, 0), ring + (wide / 2, 0, 0), [[-wide / 2, 0, 0], [wide / 2, 0, 0]]])
    k, n = np.arange(sides), np.roll(np.arange(sides), -1)
    faces = np.concatenate(
        [
            np.stack([k, n, k + sides], 1),
            np.stack([n, n + sides, k + sides], 1),
            np.stack([n, k, np.full(sides, 2 * sides)], 1),
            np.stack([k + sides, n + sides, np.full(sides, 2 * sides + 1)], 1),
        ]
    )
    return vertices, faces


def still(height, seconds=2.0, rate=60.0):
    time = np.arange(int(seconds * rate) + 1) / rate
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    matrix[:, 2, 3] = height
    return time, matrix


def rolled(radius, speed, seconds=2.0, rate=60.0):
    """Along +Y without slipping."""
    time = np.arange(int(seconds * rate) + 1) / rate
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    angle = -speed * time / radius
    matrix[:, 1, 1], matrix[:, 1, 2], matrix[:, 2, 1], matrix[:, 2, 2] = (
        np.cos(angle),
        -np.sin(angle),
        np.sin(angle),
        np.cos(angle),
    )
    matrix[:, 1, 3], matrix[:, 2, 3] = speed * time, radius
    return time, matrix


def test_the_middle_of_what_a_mesh_holds():
    vertices, faces = box((0.2, 0.4, 0.6), at=(3.0, -2.0, 1.0))
    middle, volume = solid.centre(vertices, faces)
    np.testing.assert_allclose(middle, (3.0, -2.0, 1.0), atol=1e-12)
    assert volume == pytest.approx(0.048)
    heavy = np.concatenate([vertices, box((0.4, 0.4, 0.4), at=(3.0, -2.0, 3.0))[0]])  # two boxes of 48 and 64 l
    middle, volume = solid.centre(heavy, np.concatenate([faces, faces + 8]))
    assert volume == pytest.approx(0.112) and middle[2] == pytest.approx((0.048 * 1.0 + 0.064 * 3.0) / 0.112)
    middle, volume = solid.centre(vertices, faces[2:])  # open below: its faces tell, and it holds nothing
    assert volume == 0.0 and middle[2] > 1.0


def test_a_body_touches_with_its_corners_and_all_round_its_rims():
    assert len(solid.outermost(box((0.2, 0.3, 0.4))[0])) == 8
    vertices, _ = barrel(0.3, 0.1)
    points = solid.outermost(vertices)
    for side in (-0.05, 0.05):
        angle = np.sort(np.arctan2(*points[np.isclose(points[:, 0], side)][:, 1:].T))
        angle = np.append(angle, angle[0] + 2 * np.pi)
        assert np.diff(angle).max() < np.radians(5.1)


def test_a_crate_at_rest_presses_as_its_weight_says():
    """c = m g L0 / (E A)."""
    vertices, faces = box((0.4, 0.3, 0.2))
    time, matrix = still(0.1)
    gait = solid.gait_from_solid(time, matrix, vertices, faces, mass=60.0, frame_rate=60.0)
    soil = Soil(layer_depth=0.3, young_modulus=2e5, settle_time=0.05)
    sim = Simulation(Ground.flat(), soil, 0.01)
    loads = walker.loads(gait, ground=sim.rest_height)
    assert loads.touching.all() and loads.mean[0] == pytest.approx(1.0, abs=1e-3)
    sim.load(gait, loads)
    sim.run(len(time) - 1)
    pressed = sim.read("compression", -15, -10, 30, 20)
    assert pressed.mean() == pytest.approx(60.0 * 9.81 * 0.3 / (2e5 * 0.4 * 0.3), rel=0.02)


@pytest.mark.parametrize("radius, speed", [(0.3, 1.0), (0.3, 5.0), (0.05, 0.5), (1.0, 3.0)])
def test_what_rolls_never_leaves_the_ground(radius, speed):
    vertices, faces = barrel(radius, 0.5 * radius)
    time, matrix = rolled(radius, speed)
    gait = solid.gait_from_solid(time, matrix, vertices, faces, mass=50.0, frame_rate=60.0)
    loads = walker.loads(gait)
    assert loads.touching.all()
    assert loads.mean[0] == pytest.approx(1.0, abs=0.02)
    sim = Simulation(Ground.flat(), "mud", 0.01)
    sim.load(gait, loads)
    sim.run(len(time) - 1)
    i0, i1, j0, j1 = sim.reach()
    rut = sim.read("compression", i0, j0, i1 - i0, j1 - j0).max(axis=1)  # along the way
    there = rut[int((0.2 * speed) / 0.01) - j0 : int((1.8 * speed) / 0.01) - j0]
    assert there.min() > 0.1 * there.max() > 0.0  # no place is passed over


def test_a_thrown_ball_presses_where_it_lands():
    vertices, faces = box((0.2, 0.2, 0.2))
    time = np.arange(121) / 60.0
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    flight = 0.75  # thrown up at t = 0.25, down again 0.75 s later
    t = np.clip(time - 0.25, 0.0, flight)
    matrix[:, 2, 3] = 0.1 + 9.81 / 2 * t * (flight - t)
    matrix[:, 0, 3] = 2.0 * t
    gait = solid.gait_from_solid(time, matrix, vertices, faces, mass=5.0, frame_rate=60.0)
    on = walker.loads(gait).touching[0].astype(bool)
    assert on[:10].all() and not on[(time > 0.4) & (time < 0.85)].any() and on[time > 1.1].all()


def test_a_crate_on_a_rope_presses_nothing():
    """Keyed by hand, it does not fall as it should; lifted, it is carried by what lifts it."""
    vertices, faces = box((0.4, 0.4, 0.4))
    time = np.arange(121) / 60.0
    matrix = np.tile(np.eye(4), (len(time), 1, 1))
    matrix[:, 2, 3] = 0.2 + 0.3 * np.interp(time, (0.0, 0.5, 0.7, 1.3, 1.5, 2.0), (0, 0, 1, 1, 0, 0))
    gait = solid.gait_from_solid(time, matrix, vertices, faces, mass=60.0, frame_rate=60.0)
    on = walker.loads(gait).touching[0].astype(bool)
    assert on[time < 0.45].all() and not on[(time > 0.6) & (time < 1.4)].any() and on[time > 1.55].all()


@pytest.mark.parametrize(
    "change, words",
    [
        (dict(triangles=np.zeros((0, 3), int)), "no faces"),
        (dict(vertices=np.full((8, 3), np.nan)), "NaN or infinite"),
        (dict(mass=0.0), "mass"),
        (dict(triangles=[(0, 1, 8)]), "face without its vertices"),
        (dict(triangles=[(0, 1, -1)]), "face without its vertices"),
        (dict(matrix=np.eye(4)), r"shape \(4, 4\) where .* is needed"),
    ],
)
def test_bad_bodies_are_refused(change, words):
    vertices, faces = box((0.2, 0.2, 0.2))
    time, matrix = still(0.1)
    given = dict(matrix=matrix, vertices=vertices, triangles=faces, mass=5.0, frame_rate=60.0) | change
    with pytest.raises(DesirePathError, match=words):
        solid.gait_from_solid(time, **given)


def test_what_is_said_of_a_body_may_be_given_one_by_one():
    vertices, faces = box((0.2, 0.2, 0.2))
    body = (*still(0.1), vertices, faces)
    new = solid.gait_from_solid(*body, mass=5.0, frame_rate=60.0, options=solid.SolidOptions("Crate", 7, ("Odd.",)))
    with pytest.warns(DeprecationWarning, match=r"SolidOptions\(name=.*frame_start=.*warnings="):
        old = solid.gait_from_solid(*body, mass=5.0, frame_rate=60.0, name="Crate", frame_start=7, warnings=["Odd."])
    assert old == new and new.walker_name == ("Crate",) and new.frame_start == 7 and new.warnings == ("Odd.",)


def test_every_bone_that_has_faces_is_a_limb_of_its_own():
    """Two bones along +X, each with a block, and one with nothing; the second one swings by 90 degrees."""
    rest = np.tile(np.eye(4), (3, 1, 1))
    rest[:, :3, :3] = ((0, 1, 0), (1, 0, 0), (0, 0, -1))  # +Y of a bone is +X
    rest[:, 0, 3] = (0.0, 1.0, 2.0)
    shapes = [box((0.8, 0.2, 0.1), at=(x, 0.0, 0.0)) for x in (0.5, 1.5)]
    skin = Skin(
        np.concatenate([vertices for vertices, _ in shapes]),
        np.concatenate([BOX_FACES, BOX_FACES + 8]).astype(np.int32),
        {"upper": np.repeat((1.0, 0.2), 8).astype("f4"), "lower": np.repeat((0.0, 0.8), 8).astype("f4")},
    )
    skeleton = Skeleton(("upper", "lower", "tip"), np.array((-1, 0, 1)), rest, np.ones(3))
    assert limbs.bones_of(skeleton, skin) == ("upper", "lower")
    matrix = np.tile(rest[:2], (2, 1, 1, 1))
    matrix[1, 1, :3, :3] = ((1, 0, 0), (0, 0, -1), (0, 1, 0))  # +Y of it is +Z
    gait = limbs.gait_from_limbs(
        skeleton, Motion(np.array((0.0, 0.1)), ("upper", "lower"), matrix), skin, mass=70.0, frame_rate=24.0
    )
    assert gait.limb_name == ("upper", "lower") and gait.part_name == ("limb", "limb") and len(gait.soles) == 2
    places = point_places(gait)
    for part, x in ((0, 0.5), (1, 1.5)):
        own = places[gait.point_part == part, 0]
        np.testing.assert_allclose(own.min(axis=0), (x - 0.4, -0.1, -0.05), atol=1e-6)
        np.testing.assert_allclose(own.max(axis=0), (x + 0.4, 0.1, 0.05), atol=1e-6)
    up = places[gait.point_part == 1, 1]
    assert up[:, 2].max() == pytest.approx(0.9) and up[:, 2].min() == pytest.approx(0.1)  # along +Z from its joint
    with pytest.raises(DesirePathError, match="No mesh hangs on the bones of 'Rider'"):
        limbs.gait_from_limbs(
            skeleton,
            Motion(np.array((0.0, 0.1)), ("tip",), matrix[:, :1]),
            skin,
            mass=70.0,
            frame_rate=24.0,
            options=solid.SolidOptions("Rider"),
        )
