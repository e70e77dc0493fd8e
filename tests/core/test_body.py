"""From bones to a recording: mass centre, soles, parts; any scale, pose and rest orientation."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.ground.sim import Ground, Simulation
from desire_path.ground.soil import Soil
from desire_path.loads import walker
from desire_path.motion import rotation
from desire_path.motion.gait import BALL, HEEL, TIP
from desire_path.rig import body, rigs, sole
from desire_path.rig.body import Motion, Skeleton

NAMES = ("hips", "neck", "thigh.L", "shin.L", "foot.L", "toe.L", "thigh.R", "shin.R", "foot.R", "toe.R")
PARENTS = (-1, 0, 0, 2, 3, 4, 0, 6, 7, 8)


def joints(side):
    """Hip, knee, ankle, ball, tip of one leg of a person who faces -Y."""
    return np.array(
        [
            (0.1 * side, 0, 0.92),
            (0.1 * side, -0.01, 0.5),
            (0.1 * side, 0.02, 0.09),
            (0.1 * side, -0.12, 0.025),
            (0.1 * side, -0.18, 0.02),
        ]
    )


def person(toes=True, scale=1.0, turn=np.eye(3), roll=0.0):
    """A Skeleton; bones roll about themselves by `roll`, rest space is turned by `turn`."""
    heads, tails = [(0, 0, 1.0), (0, 0, 1.5)], [(0, 0, 1.2), (0, 0, 1.65)]
    for side in (1, -1):  # the left is at +X of one who faces -Y
        leg = joints(side)
        heads += list(leg[:4])
        tails += list(leg[1:])
    heads, tails = np.array(heads, float), np.array(tails, float)
    keep = [k for k, n in enumerate(NAMES) if toes or not n.startswith("toe")]
    rest = np.tile(np.eye(4), (len(keep), 1, 1))
    for row, k in enumerate(keep):
        y = (tails[k] - heads[k]) / np.linalg.norm(tails[k] - heads[k])
        x = np.cross(y, [0.2, 0.3, 0.9])
        x /= np.linalg.norm(x)
        z = np.cross(x, y)
        x, z = np.cos(roll) * x + np.sin(roll) * z, -np.sin(roll) * x + np.cos(roll) * z
        rest[row, :3, :3] = turn @ np.stack([x, y, z], axis=1)
        rest[row, :3, 3] = turn @ heads[k] * scale
    length = np.linalg.norm(tails - heads, axis=1)[keep] * scale
    parents = [keep.index(PARENTS[k]) if PARENTS[k] >= 0 else -1 for k in keep]
    return Skeleton(tuple(NAMES[k] for k in keep), np.array(parents, "i4"), rest, length)


def about_x(angle):
    c, s = np.cos(angle), np.sin(angle)
    o, e = np.zeros_like(c), np.ones_like(c)
    return np.moveaxis(np.array([[e, o, o], [o, c, -s], [o, s, c]]), -1, 0)


def walk(skeleton, turn=np.eye(3), scale=1.0, toes_bend=True, count=240, rate=120.0, facing=0.0):
    """World matrices of a person who walks along -Y (turned by `facing`) with flat stances and raised
    heels; `turn` is what person() was turned by."""
    time = np.arange(count) / rate
    world = np.tile(skeleton.rest, (count, 1, 1, 1))
    world[..., :3, :] = turn.T @ world[..., :3, :]
    ahead = 1.1 * scale * time
    for b, name in enumerate(skeleton.names):
        side = 1 if name.endswith(".L") else -1 if name.endswith(".R") else 0
        if not side:
            world[:, b, 1, 3] -= ahead
            continue
        phase = time * 0.9 + (0.5 if side < 0 else 0.0)
        step, u = np.floor(phase), phase % 1.0
        swing = np.clip((u - 0.62) / 0.38, 0, 1)
        at = 1.1 * scale / 0.9 * (step + swing**2 * (3 - 2 * swing) - phase[0])
        lift = 0.10 * scale * np.sin(np.pi * swing) ** 2
        pitch = 0.6 * np.clip((u - 0.45) / 0.17, 0, 1) * (1 - swing) - 0.2 * np.sin(np.pi * swing) ** 2
        ball = joints(side)[3] * scale
        roll = about_x(pitch)  # heel up about the ball
        turned = (
            roll
            if name.startswith(("foot", "shin")) or not toes_bend and name.startswith("toe")
            else about_x(0 * pitch)
        )
        if name.startswith("thigh"):
            world[:, b, 1, 3] -= ahead
            continue
        world[:, b, :3, 3] = np.einsum("tij,tj->ti", turned, world[:, b, :3, 3] - ball) + ball
        world[:, b, :3, :3] = turned @ world[:, b, :3, :3]
        world[:, b, 1, 3] -= at
        world[:, b, 2, 3] += lift
    c, s = np.cos(facing), np.sin(facing)
    around = np.eye(4)
    around[:2, :2] = [[c, -s], [s, c]]
    return Motion(time, skeleton.names, around @ world)


def gait(skeleton, motion, skin=None, tread=None, **more):
    soles = body.SoleSource(skin, tread)
    return body.gait_from_bones(skeleton, motion, mass=70.0, frame_rate=120.0, soles=soles, **more)


def places(g, part):
    """A part's sole in the world (T, n, 3)."""
    p = np.broadcast_to(g.soles[part].vertices.astype(float), (len(g.time),) + g.soles[part].vertices.shape)
    u, w = g.pose[part, :, None, 4:], g.pose[part, :, None, 3:4]
    t = 2 * np.cross(u, p)
    return g.pose[part, :, None, :3] + p + w * t + np.cross(u, t)


def flat_sample(g, limb=0):
    """A sample in the middle of a stance."""
    phase = g.time * 0.9 + 0.5 * limb
    return int(np.argmin(abs(phase % 1.0 - 0.25) + 10 * (g.time < 0.3)))


# ---- parts and soles ------------------------------------------------------------------------------------


def test_a_walk_becomes_a_gait():
    bones = person()
    g = gait(bones, walk(bones))
    assert g.pose.shape == (4, 240, 7) and g.part_limb.tolist() == [0, 0, 1, 1]
    assert g.limb_name == ("foot.L", "foot.R") and g.part_name == ("heel", "toe") * 2
    assert g.point_role.tolist() == [HEEL, BALL, BALL, TIP] * 2
    assert not g.warnings
    # Winter's segments put the mass centre of a standing body near 0.57 of its height
    assert 0.9 < g.com[0, :, 2].mean() < 1.1
    loads = walker.loads(g)
    on = loads.touching[:2].any(axis=0)
    assert 0.45 < on.mean() < 0.8


@pytest.mark.parametrize("roll", [0.0, 1.0, 2.5])
@pytest.mark.parametrize("facing", [0.0, 2.0])
def test_flat_soles_are_level_and_point_ahead(roll, facing):
    bones = person(roll=roll)
    g = gait(bones, walk(bones, facing=facing))
    for limb in (0, 1):
        t = flat_sample(g, limb)
        heel, toe = (places(g, 2 * limb + k)[t] for k in (0, 1))
        both = np.concatenate([heel, toe])
        flat_heel = heel[g.soles[2 * limb].vertices[:, 2] < 1e-4]
        flat_toe = toe[g.soles[2 * limb + 1].vertices[:, 2] < 1e-4]
        assert np.ptp(np.concatenate([flat_heel, flat_toe])[:, 2]) < 2e-3  # one plane
        ahead = np.array([np.sin(facing), -np.cos(facing)])
        assert (toe.mean(axis=0) - heel.mean(axis=0))[:2] @ ahead > 0.1
        length, across = np.ptp(both[:, :2] @ ahead), np.ptp(both[:, :2] @ [ahead[1], -ahead[0]])
        assert length == pytest.approx(1.17 * 0.20, rel=0.03)
        assert across == pytest.approx(0.36 * length, rel=0.05)
        assert -0.03 < both[:, 2].min() < 0.03  # near where the ground of the clip is


def test_parts_tile_without_a_gap():
    heel, toe = sole.built_in(-0.05, 0.15, 0.22, True)
    split = toe.vertices[:, 0] + 0.15
    assert heel.vertices[:, 0].max() == pytest.approx(0.15, abs=1e-6)
    assert split.min() < 0.15 - 0.008  # the toe part laps behind the ball
    at_split = [
        np.ptp(heel.vertices[abs(heel.vertices[:, 0] - 0.15) < 1e-6, 1]),
        np.ptp(toe.vertices[abs(split - 0.15) < 1e-6, 1]),
    ]
    assert at_split[0] == pytest.approx(at_split[1], abs=1e-6)
    assert 150 <= len(heel.triangles) + len(toe.triangles) <= 400


def test_built_in_sole_is_a_shoe():
    heel, toe = sole.built_in(-0.05, 0.15, 0.22, True)
    v = np.concatenate([heel.vertices, toe.vertices + [0.15, 0, 0]])
    width = lambda a, b: np.ptp(v[(v[:, 0] >= a) & (v[:, 0] <= b), 1])
    assert width(-0.02, 0.0) < width(0.12, 0.18) and width(0.03, 0.08) < width(0.12, 0.18)
    assert v[:, 2].min() == 0.0 and v[:, 2].max() == pytest.approx(0.008, abs=1e-6)
    waist = (v[:, 0] > 0.04) & (v[:, 0] < 0.08) & (v[:, 2] < 0.0079) & (v[:, 2] > 0)
    assert v[waist, 1].min() < 0  # the arch is on the inner side, which is a left foot's right
    for part in (heel, toe):
        corner = part.vertices[part.triangles]
        down = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, 2]
        assert (down < 0).all()  # faces look at the ground
    other = sole.built_in(-0.05, 0.15, 0.22, False)
    for a, b in zip((heel, toe), other):
        assert np.array_equal(a.vertices * [1, -1, 1], b.vertices)
        corner = b.vertices[b.triangles]
        assert (np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, 2] < 0).all()


@pytest.mark.parametrize("tread, deep", [("lugs", 0.016), ("waves", 0.009)])
def test_a_built_in_sole_has_the_tread_it_is_given(tread, deep):
    plain, soles = (sole.built_in(-0.05, 0.15, 0.22, True, each) for each in ("plain", tread))
    other = sole.built_in(-0.05, 0.15, 0.22, False, tread)
    for smooth, part, mirrored in zip(plain, soles, other):
        assert np.allclose(part.vertices.min(axis=0), smooth.vertices.min(axis=0), atol=1e-3)
        assert np.allclose(part.vertices[:, :2].max(axis=0), smooth.vertices[:, :2].max(axis=0), atol=1e-3)
        assert np.array_equal(part.vertices * [1, -1, 1], mirrored.vertices)
        corner = part.vertices[part.triangles]
        assert (np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])[:, 2] < 0).all()
    heel = soles[0].vertices
    inside = heel[(abs(heel[:, 1]) < 0.02) & (heel[:, 0] > -0.02) & (heel[:, 0] < 0.14)]
    assert inside[:, 2].min() < 0.001 and abs(np.quantile(inside[:, 2], 0.9) - 0.27 * deep) < 0.002
    assert 500 < len(soles[0].triangles) + len(soles[1].triangles) < 8000


def test_a_tread_prints_and_one_that_nobody_knows_is_refused():
    bones = person()
    smooth, lugs = (gait(bones, walk(bones), tread=each) for each in ("plain", "lugs"))
    assert smooth == gait(bones, walk(bones)) != lugs
    assert np.array_equal(smooth.pose, lugs.pose)
    deep = {}
    for name, each in (("plain", smooth), ("lugs", lugs)):
        sim = Simulation(Ground.flat(), Soil(young_modulus=4e7), 0.005)
        sim.load(each, walker.loads(each))
        sim.run(len(each.time) - 1)
        deep[name] = sim.read("compression", -400, -400, 800, 800)
    there = deep["plain"] > 5e-5
    assert there.sum() > 1000
    assert 0.15 < (deep["lugs"][there] == 0.0).mean() < 0.8  # between the lugs nothing was pressed
    with pytest.raises(DesirePathError, match="There is no tread 'spikes': choose one of plain, lugs, waves"):
        gait(bones, walk(bones), tread="spikes")


def test_toe_parts_stay_level_while_the_heel_rises():
    for toes, bend in ((True, True), (True, False), (False, False)):
        bones = person(toes)
        g = gait(bones, walk(bones, toes_bend=bend))
        phase = g.time * 0.9
        rising = (phase % 1.0 > 0.52) & (phase % 1.0 < 0.6) & (g.time > 0.3)
        up = lambda part: 1 - 2 * (g.pose[part, :, 4] ** 2 + g.pose[part, :, 5] ** 2)  # cos of the tilt
        assert (up(0)[rising] < np.cos(0.2)).all()
        assert (up(1)[rising] > np.cos(0.08)).all()
        swing = (phase % 1.0 > 0.78) & (phase % 1.0 < 0.85)
        assert (up(1)[swing] > np.cos(0.35)).all()


def test_feet_without_toe_bones_have_two_parts_of_the_same_foot():
    with_toes, without = person(True), person(False)
    a, b = gait(with_toes, walk(with_toes)), gait(without, walk(without))
    assert b.pose.shape == a.pose.shape
    la = np.ptp(np.concatenate([places(a, 0)[30], places(a, 1)[30]])[:, 1])
    lb = np.ptp(np.concatenate([places(b, 0)[30], places(b, 1)[30]])[:, 1])
    assert lb == pytest.approx(la, rel=0.15)


# ---- robustness ----------------------------------------------------------------------------------------------


def test_a_clip_that_walks_in_place_is_told():
    bones = person()
    motion = walk(bones)
    still = motion.matrix.copy()
    still[:, :, 1, 3] += 1.1 * motion.time[:, None]
    g = gait(bones, replace(motion, matrix=still))
    loads = walker.loads(g)
    assert any("slide at 1.1 m/s" in w and "in place" in w for w in loads.warnings)
    on = np.stack([loads.touching[:2].any(axis=0), loads.touching[2:].any(axis=0)])
    assert on.any(axis=0).mean() > 0.9
    for limb in (0, 1):
        phase = (g.time * 0.9 + 0.5 * limb) % 1.0
        middle = (phase > 0.2) & (phase < 0.35) & (g.time > 0.1) & (g.time < 1.9)
        assert on[limb, middle].mean() > 0.9
    assert not any("slide" in w for w in walker.loads(gait(bones, motion)).warnings)


def poison(motion, bone, sample, value):
    matrix = motion.matrix.copy()
    matrix[sample, list(motion.bones).index(bone)] = value
    return replace(motion, matrix=matrix)


def test_bad_recordings_get_a_sentence():
    bones = person()
    motion = walk(bones)
    with pytest.raises(DesirePathError, match="Bone foot.L has no finite position at frame 18:"):
        gait(bones, poison(motion, "foot.L", 17, np.nan))
    with pytest.raises(DesirePathError, match="Bone toe.R has no finite position at frame 101"):
        gait(bones, poison(motion, "toe.R", 0, np.inf), frame_start=101)
    with pytest.raises(DesirePathError, match="Bone foot.R is scaled to nothing at frame 4:"):
        gait(bones, poison(motion, "foot.R", 3, np.diag([0.0, 0, 0, 1])))
    with pytest.raises(DesirePathError, match="Bone foot.L has no length"):
        gait(replace(bones, length=np.where(np.array(bones.names) == "foot.L", 0, bones.length)), motion)
    with pytest.raises(DesirePathError, match="no frames"):
        gait(bones, Motion(np.zeros(0), bones.names, np.zeros((0, 10, 4, 4))))
    with pytest.raises(DesirePathError, match="mass of -1 kg"):
        body.gait_from_bones(bones, motion, mass=-1.0, frame_rate=24)
    with pytest.raises(DesirePathError, match="mass of nan kg"):
        body.gait_from_bones(bones, motion, mass=float("nan"), frame_rate=24)
    with pytest.raises(DesirePathError, match="mass of 1e.08 kg"):
        body.gait_from_bones(bones, motion, mass=1e8, frame_rate=24)
    tiny = bones.rest.copy()
    tiny[:, :3, 3] *= 1e-5
    with pytest.raises(DesirePathError, match="span 1.*e-05 m"):
        gait(replace(bones, rest=tiny, length=1e-5 * bones.length), motion)
    with pytest.raises(DesirePathError, match="frame rate"):
        body.gait_from_bones(bones, motion, mass=70, frame_rate=0)
    with pytest.raises(DesirePathError, match="do not increase"):
        gait(bones, replace(motion, time=motion.time[::-1]))
    renamed = replace(motion, bones=tuple(n.replace("foot", "fuss") for n in motion.bones))
    with pytest.raises(DesirePathError, match="foot.L was not recorded"):
        gait(bones, renamed)


def test_mass_centre_is_the_segments():
    bones = person()
    motion = Motion(np.arange(3) / 24, bones.names, np.tile(bones.rest, (3, 1, 1, 1)))
    com = gait(bones, motion).com[0, 0]
    want = 0.678 * np.array([0, 0, 1.0 + 0.626 * 0.5])
    for side in (1, -1):
        hip, knee, ankle, ball, _ = joints(side)
        want = want + 0.100 * (hip + 0.433 * (knee - hip)) + 0.0465 * (knee + 0.433 * (ankle - knee))
        want = want + 0.0145 * (ankle + 0.5 * (ball - ankle))
    assert com == pytest.approx(want, abs=1e-9)
    rig = rigs.detect(bones)
    only_hips = rigs.Rig(rig.feet, rig.hips, ())
    assert gait(bones, motion, rig=only_hips).com[0, 0] == pytest.approx([0, 0, 1.0])


def test_quaternions_come_back():
    random = np.random.default_rng(2)
    q = random.normal(size=(200, 4))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    w, x, y, z = q.T
    turn = np.moveaxis(
        np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
        ),
        -1,
        0,
    )
    assert abs((rotation.quaternion(turn) * q).sum(axis=1)) == pytest.approx(np.ones(200), abs=1e-12)


def test_a_leg_without_a_knee_bends_it_ahead():
    """The mass centre of a person who squats is the same with knee bones and without."""
    bones = person()
    count = 5
    motion = np.tile(bones.rest, (count, 1, 1, 1))
    row = {name: k for k, name in enumerate(bones.names)}
    fold = np.linspace(0.0, 0.8, count)  # of the thighs, forward; the shanks as much back
    for t, angle in enumerate(fold):
        for side in "LR":
            hip, ankle = bones.rest[row[f"thigh.{side}"], :3, 3], bones.rest[row[f"foot.{side}"], :3, 3]
            half = np.linalg.norm(hip - ankle) / 2
            knee = ankle + half * np.array([0.0, -np.sin(angle), np.cos(angle)])
            motion[t, row[f"shin.{side}"], :3, 3] = knee
            motion[t, row[f"thigh.{side}"], :3, 3] = knee + half * np.array([0.0, np.sin(angle), np.cos(angle)])
        sunk = motion[t, row["thigh.L"], :3, 3] - bones.rest[row["thigh.L"], :3, 3]
        for name in ("hips", "neck"):
            motion[t, row[name], :3, 3] += sunk
    time = np.arange(count) / 30.0
    whole = body.gait_from_bones(bones, Motion(time, bones.names, motion), mass=70.0, frame_rate=30.0)
    keep = [k for k, name in enumerate(bones.names) if not name.startswith(("thigh", "shin"))]
    parents = [
        0 if name.startswith(("foot", "neck")) else keep.index(bones.parents[k]) if k else -1
        for k, name in ((k, bones.names[k]) for k in keep)
    ]
    names = tuple(bones.names[k] for k in keep)
    few = Skeleton(names, np.array(parents, "i4"), bones.rest[keep], bones.length[keep])
    kneeless = body.gait_from_bones(few, Motion(time, names, motion[:, keep]), mass=70.0, frame_rate=30.0)
    drop = lambda g: g.com[0, :, 1:] - g.com[0, 0, 1:]
    assert drop(whole)[-1, 1] < -0.15
    assert abs(drop(kneeless) - drop(whole)).max() < 0.02


@pytest.mark.parametrize("behind", [0.03, 0.08])
def test_a_heel_bone_is_where_the_sole_ends(behind):
    bones = person()
    motion = walk(bones)
    plain = gait(bones, motion)
    names, parents = list(bones.names), list(bones.parents)
    rest, length = list(bones.rest), list(bones.length)
    for side, x in (("L", 1), ("R", -1)):
        head = joints(x)[2] * (1, 1, 0) + [-0.03 * x, behind, 0.0]
        heel = np.eye(4)
        heel[:3, :3] = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]] if x < 0 else [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        heel[:3, 3] = head
        parents.append(names.index(f"foot.{side}"))
        names.append(f"heel.02.{side}")
        rest.append(heel)
        length.append(0.06)
    told = Skeleton(tuple(names), np.array(parents, "i4"), np.array(rest), np.array(length))
    assert [f.heel for f in rigs.detect(told).feet] == ["heel.02.L", "heel.02.R"]
    found = gait(told, motion)
    ends = [g.soles[0].vertices[:, 0].min() for g in (plain, found)]
    assert ends[1] == pytest.approx(-behind, abs=0.012)
    assert found.soles[1].vertices[:, 0].max() == pytest.approx(plain.soles[1].vertices[:, 0].max(), abs=1e-6)
    assert found.point[0, 0] - ends[1] == pytest.approx(plain.point[0, 0] - ends[0], abs=0.01)
