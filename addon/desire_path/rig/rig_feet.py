"""Which bones are feet, and what belongs to them: by name (rig_names.py), by where they stand, by shape.

names of feet --> hind pair, people's feet     hands the body stands on, more named feet --> the other pairs
no names      --> rig_shape.py
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from .rig_bones import Bones, Found, find_legs
from .rig_names import FINGERS, FOOT, FORE, HEEL, HOOF, NEVER_WORDS, TOE, rank_of
from .rig_shape import STEEP, by_structure

STANDS = 0.15  # a foot reaches as low as the others by this share of the leg
CLEAR = 0.8  # legs that go along one axis by this share of their length tell which one is up
APART = 0.25  # and is farther than this from them, in heights of the leg
WRIST = 0.5  # a hand that is a foot begins in the lower share of it: people's hang higher


def _foot_of(bones: Bones, foot: int, place: str) -> tuple[int, int, int]:
    """(foot, toe, heel) around a bone named like a foot."""
    side = bones.read[foot].side
    ankle = bones.find(("ankle",), side, place)
    ball = -1
    over = ankle >= 0 and ankle != foot and bones.under(foot, ankle)
    if over and bones.read[ankle].layer <= bones.read[foot].layer:
        foot, ball = ankle, foot  # SMPL: its left_foot is the ball of the foot
    layer = bones.read[foot].layer
    near = max(bones.size * 0.2, 1e-6)

    def under(b: int) -> bool:
        return bones.under(b, foot)

    hoof = bones.find(HOOF, side, where=under)
    if hoof >= 0 and bones.read[hoof].layer <= layer:
        return hoof, -1, -1  # what is called the foot of a horse is up its leg

    def beside(b: int) -> bool:
        return under(b) or (bones.apart(b, foot) < near and bones.read[b].layer == layer)

    toe = bones.find(TOE, side, place, where=beside)
    inside = bones.find(TOE, side, where=under)
    if inside >= 0 and (toe < 0 or bones.read[inside].layer <= max(layer, bones.read[toe].layer)):
        toe = inside
    if toe < 0 and rank_of(bones.read[foot].words, FORE) is not None:
        toe = bones.find(FINGERS, side, where=under)
    if toe < 0:
        toe = ball
    if toe < 0:
        toe = _middle_toe(bones, under, layer)
    heel = bones.find(HEEL, side, place, where=lambda b: bones.apart(b, foot) < near)
    return foot, toe, heel


def _middle_toe(bones: Bones, under: Callable[[int], bool], layer: int) -> int:
    """The first bone of the middle one of single toes, whatever their numbers; -1 if there are none."""
    toes = [
        b
        for b, name in enumerate(bones.read)
        if under(b)
        and name.layer <= layer
        and any("toe" in word for word in name.words)
        and not NEVER_WORDS & set(name.words)
    ]
    first = min((len(bones.chain(b)) for b in toes), default=0)
    toes = [b for b in toes if len(bones.chain(b)) == first]
    middle = bones.head[toes].mean(axis=0) if toes else 0.0
    return min(toes, key=lambda b: np.linalg.norm(bones.head[b] - middle), default=-1)


def _by_name(bones: Bones, side: str, place: str) -> tuple[int, int, int] | None:
    """(foot, toe, heel) of a side and place, by the foot's name; None where none is named so."""
    foot = bones.find(FOOT, side, place)
    return _foot_of(bones, foot, place) if foot >= 0 else None


class _Stand:
    """How the feet that are known stand, to tell whether others do: up, floor and height of their legs."""

    def __init__(self, bones: Bones, feet: Iterable[int]) -> None:
        self.bones = bones
        tops = [next((b for b in find_legs(bones, foot) if b >= 0), bones.chain(foot)[-1]) for foot in feet]
        self.tops = set(tops)
        axes = np.array(
            [
                bones.head[top] - max(self.ends(foot), key=lambda at: np.linalg.norm(at - bones.head[top]))
                for top, foot in zip(tops, feet)
            ]
        )
        legs = axes.mean(axis=0)
        share = np.abs(legs) / max(np.linalg.norm(axes, axis=1).mean(), 1e-12)
        self.axis = 2 if share.max() < CLEAR and share[2] > STEEP else int(np.argmax(share))
        self.sign = np.sign(legs[self.axis]) or 1.0
        self.floor = max(self.low(foot) for foot in feet)
        self.height = max(float(np.mean(self.level(bones.head[tops]))) - self.floor, 1e-9)
        self.feet = list(feet)
        self.layer = max(bones.read[foot].layer for foot in feet)

    def level(self, points: np.ndarray) -> np.ndarray:
        """How high points (.., 3) are [m]."""
        return np.asarray(self.sign * points[..., self.axis])

    def ends(self, bone: int) -> list[np.ndarray]:
        """The points of a foot; a last bone counts no farther than it is from the one before."""
        bones, found = self.bones, list[np.ndarray]()
        for b in range(len(bones.names)):
            if bone not in bones.chain(b) or bones.read[b].layer > max(2, bones.read[bone].layer):
                continue
            axis, above = bones.tail[b] - bones.head[b], bones.parents[b]
            length = bones.apart(b, above) if above >= 0 else 0.0
            found += [bones.head[b], bones.head[b] + axis * min(1.0, length / max(float(np.linalg.norm(axis)), 1e-12))]
        return found

    def low(self, bone: int) -> float:
        """How low a foot reaches."""
        return float(min(map(self.level, self.ends(bone))))

    def holds(self, foot: int, hand: bool = False) -> bool:
        """Does the body stand on this bone, with a leg of its own, beside the feet that are known?"""
        bones = self.bones
        if bones.read[foot].layer > self.layer:
            return False  # a control rig's copy
        if any(bones.under(foot, b) or bones.under(b, foot) or foot == b for b in self.feet):
            return False
        if min(bones.apart(foot, b) for b in self.feet) < APART * self.height:
            return False  # another bone of the same foot
        top = find_legs(bones, foot)[0]
        if top < 0 or top in self.tops or abs(self.low(foot) - self.floor) > STANDS * self.height:
            return False
        return not hand or bool(self.level(bones.head[foot]) - self.floor < WRIST * self.height)


def _pairs(bones: Bones, table: Sequence[str], stand: _Stand, place: str | None = None) -> list[tuple[int, int]]:
    """Pairs of bones named by a table that the body stands on, beside those known: [(left, right)], best first."""
    sides = []
    for side in ("L", "R"):
        known, taken = list(stand.feet), list[int]()

        def holds(b: int) -> bool:
            return stand.holds(b, table is FORE)

        while (bone := bones.find(table, side, place, where=holds)) >= 0:
            taken.append(bone)
            stand.feet = stand.feet + [bone]
        stand.feet = known
        sides.append(taken)
    out = []
    for left in sides[0]:
        if sides[1]:
            twin = min(sides[1], key=lambda b: _off_mirror(bones, left, b))
            sides[1].remove(twin)
            out.append((left, twin))
    return out


def _off_mirror(bones: Bones, a: int, b: int) -> float:
    """How far two bones are from being each other's mirror image across the side axis that parts them."""
    apart = np.abs(bones.head[a] - bones.head[b])
    return float(np.sort(apart)[:2].sum())


def find_feet(bones: Bones) -> tuple[list[Found], bool]:
    """([Found], whether the rig's shape told instead of names)."""
    found = []
    for side in ("L", "R"):
        if slots := _by_name(bones, side, ""):
            found.append(Found(_word(side, ""), *slots))
    places = {""}
    if len(found) < 2:  # the hind ones may be called otherwise
        found = []
        for place in ("", "front", "mid"):
            for side in ("L", "R"):
                if slots := _by_name(bones, side, place):
                    found.append(Found(_word(side, place), *slots, place))
        places = {each.place for each in found}
    if len({each.foot for each in found}) >= 2:
        return found + _more(bones, [each.foot for each in found], places), False
    chains = by_structure(bones)
    if chains:
        return chains, True
    if not found and (slots := _by_name(bones, "", "")):
        found.append(Found("foot", *slots))  # a pogo stick, a lamp: one leg in the middle
    return found, False


def _more(bones: Bones, feet: list[int], places: set[str]) -> list[Found]:
    """The other feet of a body that stands on more than two: named fore and mid, hands, more of the same name."""
    found: list[Found] = []
    for table, place, word in ((FOOT, "front", "front"), (FOOT, "mid", "mid"), (FORE, None, "front"), (FOOT, None, "")):
        if place in places or (word == "front" and any(each.place == "front" for each in found)):
            continue
        for pair in _pairs(bones, table, _Stand(bones, feet), place)[: 1 if word else None]:
            number = word or str(len(feet) // 2 + 1)
            for side, foot in zip(("L", "R"), pair):
                slots = _foot_of(bones, foot, bones.read[foot].place)
                found.append(Found(_word(side, number), *slots, word or bones.read[foot].place))
                feet = feet + [slots[0]]
    return found


def _word(side: str, place: str) -> str:
    """What a foot is called for people."""
    return f"{dict(L='left', R='right').get(side, '')} {place}".strip() or "foot"
