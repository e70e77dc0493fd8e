"""Four, six and eight feet by name and by structure, one naming after another; people keep two."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.rig import body, rig_names, rigs
from desire_path.rig.body import Motion, Skeleton
from desire_path.rig.skeleton import SampledBones
from tests.core import test_rigs
from tests.core.test_rigs import person, skeleton

# hind and fore leg: thigh, shank, foot, toe; {} stands for the side's word. None: there is no such bone
BEASTS = {
    "rigify quadruped, wolf": (
        ("L", "R"),
        "spine",
        ("thigh.{}", "shin.{}", "foot.{}", "toe.{}"),
        ("front_thigh.{}", "front_shin.{}", "front_foot.{}", "front_toe.{}"),
    ),
    "rigify cat": (
        ("L", "R"),
        "spine",
        ("thigh.{}", "shin.{}", "foot.{}", "r_toe.{}"),
        ("upper_arm.{}", "forearm.{}", "hand.{}", "f_toe.{}"),
    ),
    "rigify cat, generated": (
        ("L", "R"),
        "DEF-spine",
        ("DEF-thigh.{}", "DEF-shin.{}", "DEF-foot.{}", "DEF-r_toe.{}"),
        ("DEF-upper_arm.{}", "DEF-forearm.{}", "DEF-hand.{}", "DEF-f_toe.{}"),
    ),
    "mixamo names": (
        ("Left", "Right"),
        "mixamorig:Hips",
        ("mixamorig:{}UpLeg", "mixamorig:{}Leg", "mixamorig:{}Foot", "mixamorig:{}ToeBase"),
        ("mixamorig:{}Arm", "mixamorig:{}ForeArm", "mixamorig:{}Hand", "mixamorig:{}HandMiddle1"),
    ),
    "a letter before people's names": (
        ("Left", "Right"),
        "b_Hips",
        ("b_{}UpLeg", "b_{}Leg", "b_{}Foot", "b_{}Toe"),
        ("b_{}Arm", "b_{}ForeArm", "b_{}Hand", None),
    ),
    "unreal": (
        ("l", "r"),
        "pelvis",
        ("thigh_{}", "calf_{}", "foot_{}", "ball_{}"),
        ("upperarm_{}", "lowerarm_{}", "hand_{}", None),
    ),
    "3ds max biped on all fours": (
        ("L", "R"),
        "Bip01 Pelvis",
        ("Bip01 {} Thigh", "Bip01 {} Calf", "Bip01 {} Foot", "Bip01 {} Toe0"),
        ("Bip01 {} UpperArm", "Bip01 {} Forearm", "Bip01 {} Hand", "Bip01 {} Finger0"),
    ),
    "front and back legs": (
        ("L", "R"),
        "Hips",
        ("BackUpLeg_{}", "BackLeg_{}", "BackPaw_{}", "BackToe_{}"),
        ("FrontUpLeg_{}", "FrontLeg_{}", "FrontPaw_{}", "FrontToe_{}"),
    ),
    "the place behind": (
        ("L", "R"),
        "root",
        ("Leg_Upper_Back_{}", "Leg_Lower_Back_{}", "Paw_Back_{}", None),
        ("Leg_Upper_Front_{}", "Leg_Lower_Front_{}", "Paw_Front_{}", None),
    ),
    "hind and fore in one word": (
        ("left", "right"),
        "pelvis",
        ("{}_hindthigh", "{}_hindshin", "{}_hindfoot", None),
        ("{}_forethigh", "{}_foreshin", "{}_forefoot", None),
    ),
    "corners": (
        ("L", "R"),
        "Pelvis",
        ("Thigh_B{}", "Calf_B{}", "Paw_B{}", "Toe_B{}"),
        ("UpperArm_F{}", "Forearm_F{}", "Paw_F{}", "Toe_F{}"),
    ),
    "rear corners": (
        ("L", "R"),
        "Pelvis",
        ("R{}_thigh", "R{}_calf", "R{}_foot", None),
        ("F{}_thigh", "F{}_calf", "F{}_foot", None),
    ),
    "horsemen's corners": (
        ("L", "R"),
        "Pelvis",
        ("{}H_Thigh", "{}H_Shin", "{}H_Hoof", None),
        ("{}F_Humerus", "{}F_Radius", "{}F_Hoof", None),
    ),
    "letters before": (
        ("L", "R"),
        "pelvis",
        ("b_thigh.{}", "b_shin.{}", "b_foot.{}", "b_toe.{}"),
        ("f_thigh.{}", "f_shin.{}", "f_foot.{}", "f_toe.{}"),
    ),
    "camel case": (
        ("Left", "Right"),
        "Hips",
        ("Hind{}Thigh", "Hind{}Calf", "Hind{}Foot", None),
        ("Front{}Thigh", "Front{}Calf", "Front{}Foot", None),
    ),
    "hooves by name": (
        ("l", "r"),
        "hips",
        ("hind_thigh_{}", "hind_shin_{}", "hind_hoof_{}", None),
        ("front_thigh_{}", "front_shin_{}", "front_hoof_{}", None),
    ),
    "a number each": (
        ("L", "R"),
        "hips",
        ("thigh.{}", "shin.{}", "foot.{}", None),
        ("thigh.{}.001", "shin.{}.001", "foot.{}.001", None),
    ),
}


def beast(sides, hips, hind, fore, extra=()):
    """A skeleton on four legs of metres, standing along y."""
    bones = [(hips, None, (0, 0.5, 0.8), (0, 0.2, 0.82), 0), ("back of it", hips, (0, 0.2, 0.82), (0, -0.45, 0.82), 0)]
    for parts, y, above in ((hind, 0.45, hips), (fore, -0.45, "back of it")):
        spots = [(0.13, y, 0.75), (0.13, y, 0.4), (0.13, y, 0.08), (0.13, y - 0.07, 0.02), (0.13, y - 0.12, 0.02)]
        for side, word in ((-1, sides[0]), (1, sides[1])):
            up = above
            for part, head, tail in zip(parts, spots, spots[1:]):
                if part:
                    bones.append((part.replace("{}", word), up, head, tail, side))
                    up = bones[-1][0]
    return skeleton(bones + list(extra))


@pytest.mark.parametrize("name", BEASTS)
def test_named_beasts(name):
    sides, hips, hind, fore = BEASTS[name]
    found = rigs.detect(beast(sides, hips, hind, fore))
    want = {tuple(part and part.replace("{}", word) for part in parts) for parts in (hind, fore) for word in sides}
    assert {(f.thigh, f.shank, f.foot, f.toe) for f in found.feet} == want
    assert [f.limb.split()[0] for f in found.feet] == ["left", "right"] * 2
    assert len({f.limb for f in found.feet}) == 4
    assert found.feet[0].foot == hind[2].replace("{}", sides[0])
    assert found.hips == hips and not found.warnings
    assert sum(s.mass for s in found.segments) == pytest.approx(1.0)


def test_a_horse_stands_on_its_hooves():
    legs = (
        {
            "thigh": (0.62, 1.41),
            "lower_leg": (0.56, 1.03),
            "hind_foot": (0.76, 0.61),
            "r_toe": (0.69, 0.2),
            "r_hoof": (0.63, 0.11),
        },
        {
            "upper_arm": (-0.69, 1.16),
            "forearm": (-0.53, 0.84),
            "forefoot": (-0.54, 0.48),
            "f_toe": (-0.52, 0.22),
            "f_hoof": (-0.57, 0.09),
        },
    )
    bones = [("spine.001", None, (0, 0.81, 1.39), (0, -0.76, 1.38), 0)]
    for leg in legs:
        spots = [(0.17, *place) for place in leg.values()] + [(0.17, list(leg.values())[-1][0] - 0.05, 0.0)]
        for side, word in ((-1, "L"), (1, "R")):
            up = "spine.001"
            for part, head, tail in zip(leg, spots, spots[1:]):
                bones.append((f"{part}.{word}", up, head, tail, side))
                up = bones[-1][0]
    found = rigs.detect(skeleton(bones))
    assert [(f.limb, f.foot, f.toe, f.thigh, f.shank) for f in found.feet] == [
        ("left", "r_hoof.L", None, "thigh.L", "lower_leg.L"),
        ("right", "r_hoof.R", None, "thigh.R", "lower_leg.R"),
        ("left front", "f_hoof.L", None, "upper_arm.L", "forearm.L"),
        ("right front", "f_hoof.R", None, "upper_arm.R", "forearm.R"),
    ]


def arms(lift, reach, y=0.0):
    """Bones of arms that hang from 1.4 m; the hand begins at lift [m] and ends reach below it."""
    return (
        ("upper_arm.{}", (0.2, y, 1.4), (0.25, y, (1.4 + lift) / 2)),
        ("forearm.{}", (0.25, y, (1.4 + lift) / 2), (0.25, y, lift)),
        ("hand.{}", (0.25, y, lift), (0.25, y - 0.03, lift - reach)),
    )


def test_hands_of_people_stay_hands():
    test_rigs.SIDES = ("L", "R")

    def make(extra):
        bones = person("hips", "thigh.{}", "shin.{}", "foot.{}", "toe.{}", extra=extra)
        parents = bones.parents.copy()
        for side in "LR":
            chain = [bones.names.index(f"{part}.{side}") for part in ("hand", "forearm", "upper_arm")] + [0]
            parents[chain[:-1]] = chain[1:]
        return replace(bones, parents=parents)

    for extra in (
        arms(1.35, 0.1),
        arms(0.75, 0.19),
        arms(0.5, 0.2),  # along the body, and a gorilla's
        arms(0.75, 0.75),
        arms(0.7, 0.7, -0.6),  # a bone that an importer made as long as it liked
        arms(0.75, 0.19) + (("sword.{}", (0.3, 0, 0.6), (0.3, 0, 0.0)),),
    ):
        assert len(rigs.detect(make(extra)).feet) == 2
    four = rigs.detect(make(arms(0.1, 0.1, -0.6)))
    assert [f.foot for f in four.feet] == ["foot.L", "foot.R", "hand.L", "hand.R"]


def test_decoys_of_people_are_no_more_feet():
    test_rigs.SIDES = ("L", "R")
    decoys = (
        ("foot.{}.001", "foot", "toe"),
        ("foot_target.{}", "foot", "toe"),
        ("forefoot.{}", "toe", "tip"),
        ("foot_back.{}", "foot", "heel"),
        ("front_foot_pivot.{}", "toe", "tip"),
        ("ground_hand.{}", "foot", "tip"),
    )
    found = rigs.detect(person("hips", "thigh.{}", "shin.{}", "foot.{}", "toe.{}", extra=decoys))
    assert [f.foot for f in found.feet] == ["foot.L", "foot.R"] and found.feet[0].toe == "toe.L"


def test_a_bone_named_spine_may_be_a_tail():
    sides, _, hind, fore = BEASTS["rigify quadruped, wolf"]
    bones = beast(sides, "spine.004", hind, fore, (("spine", "spine.004", (0, 1.2, 0.75), (0, 1.3, 0.75), 0),))
    assert rigs.detect(bones).hips == "spine.004"


@pytest.mark.parametrize("pairs", [3, 4])
@pytest.mark.parametrize("names", ["{s}{k}x{j}", "leg{k}_{j}.{s}", "DEF-leg{k}.{s}.00{j}", "foot"])
@pytest.mark.parametrize("turned, tall", [(False, 2), (True, 2), (False, 1)])
def test_spiders(pairs, names, turned, tall):
    """Legs that rise to a knee and come down far out, three bones each, the last of which stands."""
    if names == "foot" and tall == 1:
        return  # what is up is told by two legs, which go farther ahead than down
    bones = [("body", None, (0, 0.2, 0.1), (0, -0.2, 0.1), 0)]
    for k in range(pairs):
        y = 0.15 - 0.3 * k / (pairs - 1)
        spots = [(0.05, y, 0.1), (0.2, 1.5 * y, 0.3), (0.4, 2.5 * y, 0.15), (0.45, 3 * y, 0.0)]
        for side, word in ((-1, "L"), (1, "R")):
            up = "body"
            for j in range(3):
                if names == "foot":
                    name = f"{('thigh', 'shin', 'foot')[j]}.{word}" + (f".{k:03}" if k else "")
                else:
                    name = names.format(s=word, k=k, j=j)
                bones.append((name, up, spots[j], spots[j + 1], side))
                up = name
    made = skeleton(bones)
    rest = made.rest.copy()
    if turned:  # it faces along x
        rest[:, :3] = np.array([[0, 1.0, 0], [-1, 0, 0], [0, 0, 1]]) @ rest[:, :3]
    if tall == 1:  # up is y, as in files of motion capture
        rest[:, :3] = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]) @ rest[:, :3]
    found = rigs.detect(Skeleton(made.names, made.parents, rest, made.length))
    lasts = {b[0] for k, b in enumerate(bones) if k % 3 == 0 and k}
    assert {f.foot for f in found.feet} == lasts and len({f.limb for f in found.feet}) == 2 * pairs
    assert all(f.thigh and f.shank and f.toe is None for f in found.feet)
    if not turned:
        for f in found.feet:
            assert f.limb.split()[0] == ("left" if rest[made.names.index(f.foot), 0, 3] > 0 else "right")
    assert found.hips == "body" and bool(found.warnings) == (names != "foot")


def test_toes_of_one_foot_are_not_feet():
    """A bird of unknown names, three toes of two bones at each foot."""
    bones = [("a", None, (0, 0.1, 0.3), (0, -0.1, 0.35), 0)]
    for side, mark in ((-1, "x"), (1, "y")):
        spots = [(0.05, 0, 0.28), (0.05, -0.02, 0.16), (0.05, 0.02, 0.03), (0.05, -0.005, 0.005)]
        up = "a"
        for k in range(3):
            bones.append((f"{mark}{k}", up, spots[k], spots[k + 1], side))
            up = f"{mark}{k}"
        for toe, x in enumerate((0.03, 0.05, 0.07)):
            bones.append((f"{mark}t{toe}", up, (0.05 + (x - 0.05) / 4, -0.015, 0.005), (x, -0.03, 0.002), side))
            bones.append((f"{mark}u{toe}", f"{mark}t{toe}", (x, -0.03, 0.002), (x, -0.05, 0.0), side))
    found = rigs.detect(skeleton(bones))
    assert [(f.limb, f.foot, f.thigh, f.shank) for f in found.feet] == [
        ("left", "x2", "x0", "x1"),
        ("right", "y2", "y0", "y1"),
    ]
    assert found.feet[0].toe[:2] == "xt"


@pytest.mark.parametrize(
    "name, words, side, place",
    [
        ("r_toe.L", ("toe",), "L", ""),
        ("f_toe.R", ("toe",), "R", "front"),
        ("r_toe.R.001", ("toe", "001"), "R", ""),
        ("Bip01 L Toe0", ("bip", "01", "toe", "0"), "L", ""),
        ("f_avg_L_Foot", ("f", "avg", "foot"), "L", ""),
        ("mixamorig:LeftHandMiddle1", ("hand", "middle", "1"), "L", ""),
        ("MidHip", ("mid", "hip"), "", ""),
        ("Paw_FL", ("paw",), "L", "front"),
        ("LeftForeArm", ("fore", "arm"), "L", ""),
        ("LFrontPaw", ("paw",), "L", "front"),
        ("frontleftpaw", ("paw",), "L", "front"),
        ("rforefoot", ("foot",), "R", "front"),
        ("LAnkle", ("ankle",), "L", ""),
        ("spine_back", ("spine", "back"), "", ""),
        ("lFoot", ("foot",), "L", ""),
        ("Left_r_foot", ("foot",), "L", ""),
    ],
)
def test_names_are_read(name, words, side, place):
    got = rig_names.read(name)
    assert (got.words, got.side, got.place) == (words, side, place)


@pytest.mark.parametrize("name", ["rigify quadruped, wolf", "mixamo names"])
def test_up_is_where_the_legs_go(name):
    """Hips at the end of a long body are farther behind its feet than above them."""
    sides, hips, hind, fore = BEASTS[name]
    made = beast(sides, hips, hind, fore)
    rig = rigs.detect(made)
    rest = made.rest.copy()
    rest[0, 1, 3] = 1.9
    made = replace(made, rest=rest)
    motion = Motion(np.array([0.0]), made.names, made.rest[None])
    np.testing.assert_array_equal(body.rest_up(SampledBones(made, motion), rig), (0.0, 0.0, 1.0))
