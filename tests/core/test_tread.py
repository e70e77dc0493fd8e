"""A picked mesh is the sole of every foot: laid, mirrored, cut at the ball, pressed as it is."""

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.rig import sole, sole_mesh
from desire_path.rig.sole_mesh import Tread
from tests.core.test_body import flat_sample, gait, person, places, walk
from tests.core.test_body_skin import boots
from tests.scenes.gaits import BOX_FACES


def boxes(*limits):
    """A Tread of boxes (low, high)."""
    corner = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    vertices = [np.array(low) + corner * (np.array(high, float) - low) for low, high in limits]
    return Tread(np.concatenate(vertices), np.concatenate([BOX_FACES + 8 * k for k in range(len(limits))]), "'Boot'")


def boot(side=1):
    """Where a foot of person() is: a plate from heel to tip, with a lug on its outer heel."""
    a, b = sorted((0.05 * side, 0.15 * side))
    lug = sorted((0.12 * side, 0.15 * side))
    return boxes(((a, -0.22, -0.01), (b, 0.07, 0.02)), ((lug[0], 0.02, -0.03), (lug[1], 0.06, -0.01)))


def area(vertices, triangles):
    corner = np.asarray(vertices, float)[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    return 0.5 * np.linalg.norm(normal, axis=1).sum(), 0.5 * normal.sum(axis=0)


def test_split_keeps_every_face():
    random = np.random.default_rng(5)
    vertices = random.normal(size=(60, 3))
    triangles = random.integers(0, 60, (90, 3))
    triangles = triangles[
        (triangles[:, 0] != triangles[:, 1])
        & (triangles[:, 1] != triangles[:, 2])
        & (triangles[:, 0] != triangles[:, 2])
    ]
    whole, facing = area(vertices, triangles)
    for x in (0.2, float(vertices[7, 0]), -9.0):
        behind, ahead = sole_mesh.split(vertices, triangles, x)
        assert not len(behind[0]) or behind[0][:, 0].max() <= x + 1e-12
        assert ahead[0][:, 0].min() >= x - 1e-12
        sizes, facings = zip(area(*behind), area(*ahead))
        assert sum(sizes) == pytest.approx(whole, rel=1e-9)
        np.testing.assert_allclose(sum(facings), facing, atol=1e-9)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("skin", [None, boots()])
def test_a_boot_at_one_foot_is_worn_on_both(side, skin):
    bones = person()
    g = gait(bones, walk(bones), tread=boot(side), skin=skin)
    assert not g.warnings
    for limb, outside in ((0, 1), (1, -1)):
        t = flat_sample(g, limb)
        heel, toe = places(g, 2 * limb)[t], places(g, 2 * limb + 1)[t]
        both = np.concatenate([heel, toe])
        # the mesh stands where it was modelled: 3 cm below the rest pose's ground
        assert both[:, 2].min() == pytest.approx(-0.03, abs=2e-3)
        assert np.ptp(both[:, 1]) == pytest.approx(0.29, abs=5e-3)
        assert both[:, 0].min() == pytest.approx(0.10 * outside - 0.05, abs=5e-3)
        lug = heel[heel[:, 2] < -0.02]
        assert len(lug) and np.mean(lug[:, 0]) == pytest.approx(0.135 * outside, abs=5e-3)
        assert toe[:, 2].min() == pytest.approx(-0.01, abs=2e-3)
        # cut at the ball, the joint the toes turn about, with a lap
        assert g.soles[2 * limb + 1].vertices[:, 0].min() == pytest.approx(-sole.OVERLAP, abs=1e-6)
        assert heel[:, 1].min() == pytest.approx(toe[:, 1].max() - sole.OVERLAP, abs=2e-3)
        # the underside still looks down
        for part, count in ((0, 2), (1, 1)):
            found = g.soles[2 * limb + part]
            corner = found.vertices[found.triangles].astype(float)
            normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
            low = corner[:, :, 2].max(axis=1) < corner[:, :, 2].min() + 1e-4
            assert low.sum() >= count and (normal[low, 2] < 0.0).all()


def test_a_tread_elsewhere_is_centred_under_the_feet():
    bones = person()
    near, far = boot(), boot()
    far = Tread(far.vertices + (5.0, 3.0, 2.0), far.triangles, far.name)
    a, b = (gait(bones, walk(bones), tread=each) for each in (near, far))
    assert len(b.warnings) == 1 and "'Boot' lies at no foot" in b.warnings[0]
    for one, other in zip(a.soles, b.soles):
        assert np.ptp(one.vertices[:, 1]) == pytest.approx(np.ptp(other.vertices[:, 1]), abs=0.02)
    plain = gait(bones, walk(bones))
    for limb in (0, 1):
        t = flat_sample(b, limb)
        worn = np.concatenate([places(b, 2 * limb)[t], places(b, 2 * limb + 1)[t]])
        bare = np.concatenate([places(plain, 2 * limb)[t], places(plain, 2 * limb + 1)[t]])
        assert worn[:, 2].min() == pytest.approx(bare[:, 2].min(), abs=3e-3)
        middle = lambda p: 0.5 * (p.min(axis=0) + p.max(axis=0))[:2]
        np.testing.assert_allclose(middle(worn), middle(bare), atol=0.03)


def test_between_the_feet_is_at_no_foot():
    bones = person()
    middle = Tread(boot().vertices - (0.10, 0.0, 0.0), boot().triangles, "'Boot'")
    assert "lies at no foot" in gait(bones, walk(bones), tread=middle).warnings[0]
    near = Tread(boot().vertices - (0.02, 0.0, 0.0), boot().triangles, "'Boot'")
    assert not gait(bones, walk(bones), tread=near).warnings


def test_a_shaft_presses_nothing():
    bones = person()
    plain = gait(bones, walk(bones), tread=boot())
    tall = boot()
    shaft = boxes(((0.05, -0.02, 0.12), (0.15, 0.07, 0.5)))
    tall = Tread(
        np.concatenate([tall.vertices, shaft.vertices]),
        np.concatenate([tall.triangles, shaft.triangles + 16]),
        tall.name,
    )
    g = gait(bones, walk(bones), tread=tall)
    assert [s.vertices.tolist() for s in g.soles] == [s.vertices.tolist() for s in plain.soles]


def test_a_tread_of_no_use():
    bones = person()
    motion = walk(bones)
    with pytest.raises(DesirePathError, match="'Boot' has no faces"):
        gait(bones, motion, tread=Tread(boot().vertices, np.zeros((0, 3), "i4"), "'Boot'"))
    bad = boot().vertices.copy()
    bad[3, 1] = np.nan
    with pytest.raises(DesirePathError, match="'Boot' has NaN"):
        gait(bones, motion, tread=Tread(bad, BOX_FACES, "'Boot'"))
    for faces in ([(0, 1, 10**6)], [(0, 1, -1)]):
        with pytest.raises(DesirePathError, match="'Boot' has a face without its vertices"):
            gait(bones, motion, tread=Tread(boot().vertices, np.array(faces), "'Boot'"))
    large = Tread(boot().vertices * 10.0, boot().triangles, "'Boot'")
    assert any("2.90 m long under a foot" in each for each in gait(bones, motion, tread=large).warnings)
