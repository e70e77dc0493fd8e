"""Four legs: where the weight is, standing, walking and trotting."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import beasts

from desire_path.errors import DesirePathError
from desire_path.loads import walker
from desire_path.rig import body, mass, rigs


def gait(bones, motion, rig=None, kilograms=60.0):
    return body.gait_from_bones(bones, motion, mass=kilograms, rig=rig, frame_rate=120.0)


def by_volume(bones):
    rig = rigs.detect(bones)
    return replace(rig, segments=mass.by_volume(bones, rig, beasts.skin(bones)[0])[0])


def legs(g, loads):
    return np.stack([-loads.force[g.part_limb == limb].sum(axis=0) for limb in range(4)])


def test_a_mesh_tells_where_the_weight_is():
    bones = beasts.skeleton()
    hide, volume = beasts.skin(bones)
    rig = rigs.detect(bones)
    assert len(rig.feet) == 4
    segments, whole = mass.by_volume(bones, rig, hide)
    assert whole == pytest.approx(sum(volume.values()), rel=1e-3)
    share = {s.name: s.mass for s in segments}
    assert share["spine"] == pytest.approx(volume["spine"] / whole, rel=0.01)
    # the volume's centre lies where the boxes' centres have it
    middle = {n: bones.rest[k, :3, 3] + bones.rest[k, :3, 1] * bones.length[k] / 2 for k, n in enumerate(bones.names)}
    want = sum(volume[n] * middle[n] for n in volume) / whole
    g = gait(bones, beasts.motion(bones), replace(rig, segments=segments))
    assert g.com[0, 0] == pytest.approx(want, abs=0.02)  # hooves are left out
    table = gait(bones, beasts.motion(bones))
    assert table.com[0, 0, 2] > 0.5 and abs(table.com[0, 0, 0]) < 1e-6
    inside_out = replace(hide, triangles=hide.triangles[:, ::-1])
    assert mass.by_volume(bones, rig, inside_out)[1] == pytest.approx(whole)
    assert mass.by_volume(bones, rig, replace(hide, weights={})) is None
    with pytest.raises(DesirePathError, match="no mesh is bound"):
        mass.estimate(bones, rig)
    assert "litres of its mesh" in mass.sentence_by_volume("Dog", 1000 * whole, whole)


def wedge():
    """A bone from y = 0.3 to 0.7 m inside a closed body from 0 to 1 m, 1 m high, that widens from 1 to 2 m."""
    rest = np.eye(4)[None]
    rest[0, 1, 3] = 0.3
    bones = body.Skeleton(("bone",), np.array([-1], np.int32), rest, np.array([0.4]))
    ring = lambda y, wide: [(-wide, y, -0.5), (wide, y, -0.5), (wide, y, 0.5), (-wide, y, 0.5)]
    corner = np.array(ring(0.0, 0.5) + ring(1.0, 1.0), np.float32)
    sides = [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)] + [(3, 2, 1, 0), (4, 5, 6, 7)]
    faces = np.array([each for a, b, c, d in sides for each in ((a, b, c), (a, c, d))], np.int32)
    return bones, body.Skin(corner, faces, {"bone": np.ones(8, np.float32)})


def test_a_closed_mesh_is_as_large_as_it_is():
    """By the faces about their bone alone it is a third larger; its centre lies where that of a frustum does."""
    bones, hide = wedge()
    rig = rigs.Rig(feet=(rigs.Foot("left", "bone"),), segments=())
    (segment,), volume = mass.by_volume(bones, rig, hide)
    assert volume == pytest.approx(1.5, rel=1e-6)
    assert 0.3 + 0.4 * segment.start[0][1] == pytest.approx(5.0 / 9.0, abs=0.006)


def test_at_rest_four_feet_balance_about_the_mass_centre():
    bones = beasts.skeleton()
    g = gait(bones, beasts.motion(bones), by_volume(bones))
    loads = walker.loads(g)
    force = legs(g, loads)
    assert force[..., 2].sum(axis=0) == pytest.approx(60.0 * 9.81, rel=1e-6)
    weight = -loads.force[..., 2:]
    centre = np.nansum(loads.point * weight, axis=0) / weight.sum(axis=0)
    assert abs(centre - g.com[0])[:, :2].max() < 0.002
    assert (force[..., 2] > 0.05 * 60 * 9.81).all()
    assert force[:2, :, 2].sum() > force[2:, :, 2].sum()  # neck and head hang over the front
    assert abs(force[..., :2]).max() < 1e-6 * 60 * 9.81


@pytest.mark.parametrize("duty, bob", [(0.45, 0.02), (0.5, 0.01)])
def test_a_trot_never_pulls(duty, bob):
    """Diagonal pairs in turn, with flights between."""
    bones = beasts.skeleton()
    g = gait(bones, beasts.motion(bones, speed=2.5, duty=duty, bob=bob), by_volume(bones))
    loads = walker.loads(g)
    force = legs(g, loads)[..., 2]
    assert (loads.force[..., 2] <= 0.0).all() and force.sum(axis=0).min() >= 0.0
    assert loads.mean[0] == pytest.approx(1.0, abs=0.04)
    on = np.stack([loads.touching[g.part_limb == limb].any(axis=0) for limb in range(4)])
    inside = slice(30, -30)
    assert (on[0] == on[3])[inside].mean() > 0.9 and (on[1] == on[2])[inside].mean() > 0.9
    assert not (on[0] & on[1])[inside].mean() > 0.2
    a = force[0, inside].sum() / force[[0, 3]][:, inside].sum()
    assert 0.3 < a < 0.8
    assert not any("carry" in w for w in loads.warnings)


def test_a_walk_on_four_legs():
    bones = beasts.skeleton()
    g = gait(
        bones, beasts.motion(bones, speed=1.0, stride=0.9, duty=0.65, phases=(0.0, 0.5, 0.75, 0.25)), by_volume(bones)
    )
    loads = walker.loads(g)
    force = legs(g, loads)[..., 2] / (60 * 9.81)
    assert force.sum(axis=0)[30:-30] == pytest.approx(1.0, abs=0.1)
    assert loads.mean[0] == pytest.approx(1.0, abs=0.02)
    assert (force >= -1e-12).all() and force.max() < 0.95
    jump = abs(np.diff(force, axis=1)).max()
    assert jump < 0.2  # no load jumps


def test_a_paw_presses_where_the_toes_are():
    """Hocks in the air leave no heels: the sole lies around the ball and ahead, at the height of the lowest joint."""
    bones = beasts.skeleton()
    row = {name: k for k, name in enumerate(bones.names)}
    rest, length = bones.rest.copy(), bones.length.copy()
    for k, name in enumerate(bones.names):
        if "foot" in name:
            rest[k, 2, 3] = 0.25  # a metatarsus, upright
            length[k] = 0.24
        if "toe" in name:
            length[k] = 0.10
            rest[k, :3, 1] = (0.0, -1.0, 0.0)
    bones = replace(bones, rest=rest, length=length)
    g = gait(bones, beasts.motion(bones, speed=1.0, stride=0.9, duty=0.65, phases=(0.0, 0.5, 0.75, 0.25)))
    for limb in range(4):
        heel, toe = np.flatnonzero(g.part_limb == limb)
        pad = [np.ptp(g.soles[part].vertices[:, 0]) for part in (heel, toe)]
        assert pad[0] < 0.04 and 0.10 <= pad[1] < 0.125
        foot, ball = bones.rest[row[g.limb_name[limb]]], bones.rest[row[g.limb_name[limb].replace("foot", "toe")]]
        assert 0.0 < ball[2, 3] - g.pose[toe, :, 2].min() < 0.012
        assert g.pose[toe, 0, 1] - g.pose[heel, 0, 1] == pytest.approx(ball[1, 3] - foot[1, 3], abs=1e-6)
    # a person's foot of the same bones has its heel
    person = rigs.build(bones, rigs.detect(bones).feet[:2])
    assert np.ptp(gait(bones, beasts.motion(bones), person).soles[0].vertices[:, 0]) > 0.07
