"""Every rig's feet by name, one by one; decoys; structure; many legs; none."""

from dataclasses import replace

import numpy as np
import pytest

from desire_path.errors import DesirePathError
from desire_path.rig import rigs
from desire_path.rig.body import Skeleton
from tests.scenes.rig_names import RIGS

# where joints of a standing person are: (across, behind, up) [m], left side
PLACES = {
    "root": (0, 0, 0),
    "hips": (0, 0, 1.0),
    "spine": (0, 0, 1.1),
    "chest": (0, 0, 1.3),
    "neck": (0, 0, 1.5),
    "head": (0, 0, 1.6),
    "thigh": (0.1, 0, 0.92),
    "shank": (0.1, -0.01, 0.5),
    "foot": (0.1, 0.02, 0.09),
    "toe": (0.1, -0.11, 0.02),
    "tip": (0.1, -0.18, 0.02),
    "heel": (0.07, 0.06, 0.0),
    "hand": (0.7, 0, 1.4),
}


def skeleton(bones):
    """bones: (name, parent or None, head place, tail place, side) with side -1 left, 1 right, 0 middle."""
    names = [b[0] for b in bones]
    rest = np.tile(np.eye(4), (len(bones), 1, 1))
    length = np.zeros(len(bones))
    for k, (_, _, head, tail, side) in enumerate(bones):
        flip = np.array([-1.0 if side > 0 else 1.0, 1, 1])
        head = np.array(PLACES[head] if isinstance(head, str) else head, float) * flip
        tail = np.array(PLACES[tail] if isinstance(tail, str) else tail, float) * flip
        length[k] = np.linalg.norm(tail - head)
        y = (tail - head) / length[k]
        x = np.cross(y, [0.3, 0.1, 0.9])
        x /= np.linalg.norm(x)
        rest[k, :3, :3] = np.stack([x, y, np.cross(x, y)], axis=1)
        rest[k, :3, 3] = head
    parents = [names.index(b[1]) if b[1] else -1 for b in bones]
    return Skeleton(tuple(names), np.array(parents, "i4"), rest, length)


def person(hips, thigh, shank, foot, toe=None, heel=None, neck=None, extra=(), attached=True):
    """A biped whose side bones are named by patterns with {} for the side's word."""
    sides = SIDES
    bones = [(hips, None, "hips", "spine", 0)]
    if neck:
        bones.append((neck, hips, "neck", "head", 0))
    for side, word in ((-1, 0), (1, 1)):
        say = lambda pattern: (
            pattern if pattern is None else pattern.replace("{}", sides[word]).replace("{!}", sides[word].upper())
        )
        if thigh:
            bones.append((say(thigh), hips, "thigh", "shank", side))
        if shank:
            bones.append((say(shank), say(thigh), "shank", "foot", side))
        bones.append((say(foot), say(shank) if attached else None, "foot", "toe", side))
        if toe:
            bones.append((say(toe), say(foot), "toe", "tip", side))
        if heel:
            bones.append((say(heel), say(foot), "heel", (0.13, 0.06, 0.0), side))
        for pattern, head, tail in extra:
            bones.append((say(pattern), None, head, tail, side))
    return skeleton(bones)


SIDES = ("L", "R")


@pytest.mark.parametrize("rig", RIGS)
def test_named_rigs(rig):
    global SIDES
    SIDES, hips, thigh, shank, foot, toe, heel, neck, decoys = RIGS[rig]
    found = rigs.detect(person(hips, thigh, shank, foot, toe, heel, neck, decoys))
    assert [f.limb for f in found.feet] == ["left", "right"]
    for side, got in zip(SIDES, found.feet):
        assert got.foot == foot.replace("{}", side)
        assert got.toe == (toe.replace("{}", side) if toe else None)
        assert got.thigh == thigh.replace("{}", side)
        assert got.shank == shank.replace("{}", side)
        assert got.heel == (heel.replace("{}", side) if heel else None)
    assert found.hips == hips
    assert sum(s.mass for s in found.segments) == pytest.approx(1.0)
    trunk = found.segments[0]
    assert trunk.end == ((neck, 0.0),)
    assert set(found.bones) >= {found.feet[0].foot, found.feet[1].foot, hips}
    assert not found.warnings


def test_heels_lie_at_the_heel():
    global SIDES
    SIDES, hips, thigh, shank, foot, toe, heel, neck, decoys = RIGS["rigify generated"]
    found = rigs.detect(person(hips, thigh, shank, foot, toe, heel, neck, decoys))
    assert found.feet[0].heel == "ORG-heel.02.L"


def test_the_middle_one_of_single_toes():
    sides = [
        (f"toe{k}_01.{{}}", (0.1 + 0.02 * (k - 2), -0.11, 0.02), (0.1 + 0.02 * (k - 2), -0.17, 0.02)) for k in range(5)
    ]
    global SIDES
    SIDES = ("L", "R")
    bones = person("hips", "thigh.{}", "shin.{}", "foot.{}", extra=sides)
    parents = bones.parents.copy()
    for k, name in enumerate(bones.names):
        if name.startswith("toe"):
            parents[k] = bones.names.index("foot." + name[-1])
    bones = replace(bones, parents=parents)
    assert [f.toe for f in rigs.detect(bones).feet] == ["toe2_01.L", "toe2_01.R"]


def test_feet_detached_from_legs():
    global SIDES
    SIDES = ("L", "R")
    found = rigs.detect(person("hips", "thigh.{}", "shin.{}", "foot.{}", "toe.{}", attached=False))
    assert [f.foot for f in found.feet] == ["foot.L", "foot.R"]
    assert [f.thigh for f in found.feet] == ["thigh.L", "thigh.R"]


def nameless(foot_names, feet_ahead=True):
    bones = [("a", None, "hips", "spine", 0), ("b", "a", "neck", "head", 0)]
    for side, names in ((-1, foot_names[0]), (1, foot_names[1])):
        bones += [
            (names[0], "a", "thigh", "shank", side),
            (names[1], names[0], "shank", "foot", side),
            (names[2], names[1], "foot", "toe", side),
            (names[3], names[2], "toe", "tip", side),
            (names[4], "b", "neck", "hand", side),
        ]
    return skeleton(bones)


def test_unknown_names_go_by_structure():
    found = rigs.detect(nameless((("c1", "c2", "c3", "c4", "c5"), ("d1", "d2", "d3", "d4", "d5"))))
    assert {(f.limb, f.foot, f.toe, f.thigh, f.shank) for f in found.feet} == {
        ("left", "c3", "c4", "c1", "c2"),
        ("right", "d3", "d4", "d1", "d2"),
    }
    assert found.hips == "a"
    assert "c3" in found.warnings[0]


def test_four_legs_by_name_and_by_structure():
    place = {"front": -0.4, "": 0.4}
    for named in (True, False):
        bones, count = [("body", None, (0, 0.4, 0.7), (0, -0.4, 0.7), 0)], 0
        for word, y in place.items():
            for side, mark in ((-1, "L"), (1, "R")):
                names = []
                for part in ("thigh", "shin", "foot", "toe"):
                    count += 1
                    names.append(f"{word + '_' if word else ''}{part}.{mark}" if named else f"x{count}")
                spots = [
                    (0.12, y, 0.65),
                    (0.12, y, 0.35),
                    (0.12, y, 0.08),
                    (0.12, y - 0.06, 0.02),
                    (0.12, y - 0.1, 0.02),
                ]
                above = "body"
                for name, head, tail in zip(names, spots, spots[1:]):
                    bones.append((name, above, head, tail, side))
                    above = name
        found = rigs.detect(skeleton(bones))
        assert len(found.feet) == 4 and len({f.foot for f in found.feet}) == 4
        assert sum(s.mass for s in found.segments) == pytest.approx(1.0)
        if named:
            assert {f.foot for f in found.feet} == {"front_foot.L", "front_foot.R", "foot.L", "foot.R"}


def test_one_leg_in_the_middle_is_a_foot():
    legs = (("thigh", "thigh", "shank"), ("shin", "shank", "foot"), ("foot", "foot", "toe"), ("toe", "toe", "tip"))
    above, bones = "hips", [("hips", None, "hips", "spine", 0)]
    for name, head, tail in legs:
        bones.append((name, above, head, tail, 0))
        above = name
    found = rigs.detect(skeleton(bones))
    assert [(f.limb, f.foot, f.toe, f.thigh, f.shank) for f in found.feet] == [("foot", "foot", "toe", "thigh", "shin")]
    assert found.hips == "hips" and not found.warnings


def test_nothing_to_walk_on_gets_a_sentence():
    chair = skeleton([("seat", None, "hips", "spine", 0), ("back", "seat", "spine", "neck", 0)])
    with pytest.raises(DesirePathError, match="No foot bones were found: .* choose the foot bones"):
        rigs.detect(chair)
    with pytest.raises(DesirePathError, match="no bones"):
        rigs.detect(Skeleton((), np.zeros(0, "i4"), np.zeros((0, 4, 4)), np.zeros(0)))


def test_chosen_bones_are_kept_and_missed():
    global SIDES
    SIDES = ("L", "R")
    bones = person("hips", "thigh.{}", "shin.{}", "foot.{}", "toe.{}")
    rig = rigs.build(bones, [rigs.Foot("left", "foot.L", "toe.L")], hips="hips")
    assert [f.foot for f in rig.feet] == ["foot.L"] and rig.hips == "hips"
    with pytest.raises(DesirePathError, match="no bone foot.X: it was renamed"):
        rigs.build(bones, [rigs.Foot("left", "foot.X")])
    with pytest.raises(DesirePathError, match="no bone pelvis"):
        rigs.build(bones, [rigs.Foot("left", "foot.L")], hips="pelvis")
    with pytest.raises(DesirePathError, match="No foot bones were chosen"):
        rigs.build(bones, [])
