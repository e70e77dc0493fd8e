"""Soles cut from the mesh that is worn on the feet."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.motion.gait import HEEL, Sole
from desire_path.rig import body, sole
from desire_path.rig.body import Skin
from tests.core.test_body import flat_sample, gait, person, places, walk
from tests.scenes.gaits import BOX_FACES


def test_what_soles_come_from_may_be_given_one_by_one():
    bones = person()
    motion = walk(bones)
    with pytest.warns(DeprecationWarning, match=r"written gait_from_bones\(soles=SoleSource\(skin=\.\.\)\)"):
        old = body.gait_from_bones(bones, motion, mass=70.0, frame_rate=120.0, skin=boots())
    assert old == gait(bones, motion, skin=boots()) != gait(bones, motion)


# ---- skins -----------------------------------------------------------------------------------------------------


def boots(depth=0.02):
    """A skin of two boots: a box under each heel and toe, the heels with a tread, and a leg above."""
    vertices, triangles, weights = [], [], {n: [] for n in ("foot.L", "toe.L", "foot.R", "toe.R", "shin.L")}
    box = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)

    def add(low, high, owner):
        first = len(vertices)
        vertices.extend((np.array(low) + box * (np.array(high) - low)).tolist())
        triangles.extend((BOX_FACES + first).tolist())
        for name in weights:
            weights[name] += [1.0 if name == owner else 0.0] * 8

    for side, mark in ((1, "L"), (-1, "R")):
        a, b = sorted((0.05 * side, 0.15 * side))
        add((a, -0.12, 0.0), (b, 0.07, 0.05), f"foot.{mark}")
        add((a, -0.22, 0.0), (b, -0.12, 0.04), f"toe.{mark}")
        add((a + 0.03, 0.02, -depth), (b - 0.03, 0.05, 0.0), f"foot.{mark}")
    add((0.05, 0.0, 0.12), (0.15, 0.05, 0.5), "shin.L")
    return Skin(np.array(vertices), np.array(triangles), {n: np.array(w) for n, w in weights.items()})


def test_a_boot_leaves_a_boot_print():
    bones = person()
    g = gait(bones, walk(bones), skin=boots())
    assert not g.warnings
    for limb in (0, 1):
        heel, toe = g.soles[2 * limb], g.soles[2 * limb + 1]
        assert len(heel.triangles) == 24
        lap = toe.vertices[:, 0].min()  # the toes reach back under the heel part, to the cut and no further
        assert lap == pytest.approx(-sole.OVERLAP, abs=3e-3)
        assert len(toe.triangles) > 12
        t = flat_sample(g, limb)
        h, f = places(g, 2 * limb)[t], places(g, 2 * limb + 1)[t]
        assert np.ptp(np.concatenate([h, f])[:, 1]) == pytest.approx(0.29, abs=5e-3)
        assert h[:, 2].min() == pytest.approx(-0.02, abs=2e-3)  # the tread, where the skin has it
        assert f[:, 2].min() == pytest.approx(0.0, abs=2e-3)
    marks = g.point[g.point_role == HEEL]
    assert (marks[:, 0] < -0.02).all()


def test_soles_of_few_faces_are_told():
    bones = person()
    boxes = gait(bones, walk(bones), skin=boots())
    for cell in (0.004, 0.01):
        said = sole.few_faces(boxes, cell)
        assert len(said) == 1 and "foot.L and foot.R" in said[0] and "sole" in said[0]  # alike on both feet
        faces, cells = (int(word) for word in said[0].split() if word.isdigit())
        assert faces < 12 and cells == pytest.approx(0.1 * 0.29 / cell**2, rel=0.3)
    assert not sole.few_faces(boxes, 0.08)  # such cells show no more than the faces do
    built_in = gait(bones, walk(bones))
    assert not sole.few_faces(built_in, 0.004)
    fine = replace(boxes, soles=[finer(each) for each in boxes.soles])
    assert not sole.few_faces(fine, 0.01)
    solid = replace(boxes, part_name=["body"] * 4)  # a crate may have six sides
    assert not sole.few_faces(solid, 0.01)


def finer(shape):
    """Every triangle cut into four."""
    corner = np.asarray(shape.vertices, float)[shape.triangles]
    middle = (corner + np.roll(corner, -1, axis=1)) / 2.0
    parts = [
        np.stack(each, axis=1)
        for each in (
            (corner[:, 0], middle[:, 0], middle[:, 2]),
            (middle[:, 0], corner[:, 1], middle[:, 1]),
            (middle[:, 2], middle[:, 1], corner[:, 2]),
            (middle[:, 0], middle[:, 1], middle[:, 2]),
        )
    ]
    vertices = np.concatenate(parts).reshape(-1, 3)
    return Sole(vertices, np.arange(len(vertices), dtype="i4").reshape(-1, 3))


def test_a_skin_without_toe_weights_is_split_at_the_ball():
    bones = person(toes=False)
    skin = boots()
    fold = {
        n: skin.weights[n] + (skin.weights[n.replace("foot", "toe")] if "foot" in n else 0)
        for n in ("foot.L", "foot.R", "shin.L")
    }
    g = gait(bones, walk(bones), skin=replace(skin, weights=fold))
    assert not g.warnings
    assert len(g.soles[0].triangles) + len(g.soles[1].triangles) == 36
    assert len(g.soles[1].triangles) >= 10


def test_a_skin_without_feet_falls_back():
    bones = person()
    skin = boots()
    g = gait(bones, walk(bones), skin=replace(skin, weights={"shin.L": skin.weights["shin.L"]}))
    assert "built-in sole" in g.warnings[0]
    assert len(g.soles[0].triangles) > 50
