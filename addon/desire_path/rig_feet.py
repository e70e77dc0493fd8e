"""Which bones are feet, and what belongs to them: by name (rig_names.py), by where they stand, by structure.

    names of feet --> hind pair, people's feet     hands the body stands on, more named feet --> the other pairs
    no names      --> the lowest chains that come in mirrored pairs
"""

from dataclasses import dataclass

import numpy as np

from .rig_names import (FINGERS, FOOT, FORE, FORE_SHANK, FORE_THIGH, HEEL, HOOF, NEVER_WORDS, SHANK, THIGH, TOE,
                        rank_of, read)

STANDS = 0.15  # a foot reaches as low as the others by this share of the leg
CLEAR = 0.8  # legs that go along one axis by this share of their length tell which one is up
TOES = 0.15  # toes begin within this share of the body's height from where they come together
STEEP = 0.15  # legs go down by this share of their length at least, however far out they stand
APART = 0.25  # and is farther than this from them, in heights of the leg
WRIST = 0.5  # a hand that is a foot begins in the lower share of it: people's hang higher


class Bones:
    """A skeleton with its names read."""

    def __init__(self, skeleton):
        self.names = tuple(skeleton.names)
        self.parents = [int(p) for p in skeleton.parents]
        self.read = [read(n) for n in self.names]
        rest = np.asarray(skeleton.rest, float)
        self.head = rest[:, :3, 3]
        self.tail = self.head + rest[:, :3, 1] * np.asarray(skeleton.length, float)[:, None]
        self.size = float(np.ptp(self.head, axis=0).max()) if len(self.head) else 0.0

    def chain(self, bone):
        """The bone and its ancestors, upward."""
        seen = []
        while bone >= 0 and bone not in seen:
            seen.append(bone)
            bone = self.parents[bone]
        return seen

    def under(self, bone, ancestor):
        return bone != ancestor and ancestor in self.chain(bone)

    def apart(self, a, b):
        return float(np.linalg.norm(self.head[a] - self.head[b]))

    def beside(self, bone, point):
        """How far a point is from a bone, anywhere along it."""
        way = self.tail[bone] - self.head[bone]
        along = np.clip((point - self.head[bone]) @ way / max(way @ way, 1e-18), 0.0, 1.0)
        return float(np.linalg.norm(self.head[bone] + along * way - point))

    def find(self, table, side="", place=None, where=None):
        """The best bone for a slot: layer first, then pattern; -1 if none."""
        best, found = None, -1
        for b, name in enumerate(self.read):
            if name.side != side or NEVER_WORDS & set(name.words):
                continue
            rank = rank_of(name.words, table)
            if rank is None or (place is not None and name.place != place):
                continue
            if where is not None and not where(b):
                continue
            order = (name.layer, rank, name.size, len(self.chain(b)))
            if best is None or order < best:
                best, found = order, b
        return found


@dataclass(frozen=True)
class Found:
    """Bones of one foot, -1 for none."""

    limb: str
    foot: int
    toe: int
    heel: int
    place: str = ""


# ---- by name ---------------------------------------------------------------------------------------------


def _foot_of(bones, foot, place):
    """(foot, toe, heel) around a bone named like a foot."""
    side = bones.read[foot].side
    ankle = bones.find(("ankle",), side, place)
    ball = -1
    if ankle >= 0 and ankle != foot and bones.under(foot, ankle):
        if bones.read[ankle].layer <= bones.read[foot].layer:
            foot, ball = ankle, foot  # SMPL: its left_foot is the ball of the foot
    layer = bones.read[foot].layer
    near = max(bones.size * 0.2, 1e-6)
    under = lambda b: bones.under(b, foot)
    hoof = bones.find(HOOF, side, where=under)
    if hoof >= 0 and bones.read[hoof].layer <= layer:
        return hoof, -1, -1  # what is called the foot of a horse is up its leg

    def beside(b):
        return under(b) or (bones.apart(b, foot) < near and bones.read[b].layer == layer)

    toe = bones.find(TOE, side, place, where=beside)
    inside = bones.find(TOE, side, where=under)
    if inside >= 0 and (toe < 0 or bones.read[inside].layer <= max(layer, bones.read[toe].layer)):
        toe = inside
    if toe < 0 and rank_of(bones.read[foot].words, FORE) is not None:
        toe = bones.find(FINGERS, side, where=under)
    if toe < 0:
        toe = ball
    heel = bones.find(HEEL, side, place, where=lambda b: bones.apart(b, foot) < near)
    return foot, toe, heel


def _by_name(bones, side, place):
    foot = bones.find(FOOT, side, place)
    return _foot_of(bones, foot, place) if foot >= 0 else None


class _Stand:
    """How the feet that are known stand, to tell whether others do: up, floor and height of their legs."""

    def __init__(self, bones, feet):
        self.bones = bones
        tops = [next((b for b in find_legs(bones, foot) if b >= 0), bones.chain(foot)[-1]) for foot in feet]
        self.tops = set(tops)
        ways = np.array([bones.head[top] - max(self.ends(foot), key=lambda at: np.linalg.norm(at - bones.head[top]))
                         for top, foot in zip(tops, feet)])
        legs = ways.mean(axis=0)
        share = np.abs(legs) / max(np.linalg.norm(ways, axis=1).mean(), 1e-12)
        self.axis = 2 if share.max() < CLEAR and share[2] > STEEP else int(np.argmax(share))
        self.sign = np.sign(legs[self.axis]) or 1.0
        self.floor = max(self.low(foot) for foot in feet)
        self.height = max(float(np.mean(self.level(bones.head[tops]))) - self.floor, 1e-9)
        self.feet = list(feet)
        self.layer = max(bones.read[foot].layer for foot in feet)

    def level(self, points):
        return self.sign * points[..., self.axis]

    def ends(self, bone):
        """The points of a foot; a last bone counts no farther than it is from the one before."""
        bones, found = self.bones, []
        for b in range(len(bones.names)):
            if bone not in bones.chain(b) or bones.read[b].layer > max(2, bones.read[bone].layer):
                continue
            way, above = bones.tail[b] - bones.head[b], bones.parents[b]
            reach = bones.apart(b, above) if above >= 0 else 0.0
            found += [bones.head[b], bones.head[b] + way * min(1.0, reach / max(np.linalg.norm(way), 1e-12))]
        return found

    def low(self, bone):
        """How low a foot reaches."""
        return float(min(map(self.level, self.ends(bone))))

    def holds(self, foot, hand=False):
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
        return not hand or self.level(bones.head[foot]) - self.floor < WRIST * self.height


def _pairs(bones, table, stand, place=None):
    """Pairs of bones named by a table that the body stands on, beside those known: [(left, right)], best first."""
    sides = []
    for side in ("L", "R"):
        known, taken = list(stand.feet), []
        holds = lambda b: stand.holds(b, table is FORE)
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


def _off_mirror(bones, a, b):
    """How far two bones are from being each other's mirror image across the side axis that parts them."""
    apart = np.abs(bones.head[a] - bones.head[b])
    return float(np.sort(apart)[:2].sum())


def find_feet(bones):
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
    chains = _by_structure(bones)
    if chains:
        return chains, True
    if not found and (slots := _by_name(bones, "", "")):
        found.append(Found("foot", *slots))  # a pogo stick, a lamp: one leg in the middle
    return found, False


def _more(bones, feet, places):
    """The other feet of a body that stands on more than two: named fore and mid, hands, more of the same name."""
    found = []
    for table, place, word in ((FOOT, "front", "front"), (FOOT, "mid", "mid"), (FORE, None, "front"),
                               (FOOT, None, "")):
        if place in places or (word == "front" and any(each.place == "front" for each in found)):
            continue
        for pair in _pairs(bones, table, _Stand(bones, feet), place)[:1 if word else None]:
            number = word or str(len(feet) // 2 + 1)
            for side, foot in zip(("L", "R"), pair):
                slots = _foot_of(bones, foot, bones.read[foot].place)
                found.append(Found(_word(side, number), *slots, word or bones.read[foot].place))
                feet = feet + [slots[0]]
    return found


def _word(side, place):
    return f"{dict(L='left', R='right').get(side, '')} {place}".strip() or "foot"


# ---- thighs and shanks ---------------------------------------------------------------------------------


def find_legs(bones, foot, place=None):
    """(thigh, shank) above a foot bone, -1 each where there are none."""
    side = bones.read[foot].side
    place = bones.read[foot].place if place is None else place
    thigh, shank = _legs_by_name(bones, side, place, foot) if side else (-1, -1)
    if thigh < 0 or shank < 0:
        guess = _legs_by_structure(bones, foot)
        thigh, shank = guess if guess[0] >= 0 else (thigh, shank)
    return thigh, shank


def _legs_by_name(bones, side, place, foot):
    """Thigh and shank of a foot: on its own chain where it has one, else by name alone."""
    on_chain = set(bones.chain(foot)[1:])
    shank = bones.find(("knee",), side, where=on_chain.__contains__)
    thigh = bones.find(THIGH[:-2], side, where=on_chain.__contains__)
    if shank < 0:
        shank = bones.find(SHANK, side, where=lambda b: b in on_chain and b != thigh)
    if thigh < 0:
        thigh = bones.find(THIGH + ("leg",), side, where=lambda b: b in on_chain and b != shank)
    if thigh < 0 or shank < 0:
        arm = (bones.find(FORE_THIGH, side, where=on_chain.__contains__),
               bones.find(FORE_SHANK, side, where=on_chain.__contains__))
        if min(arm) >= 0 and bones.under(arm[1], arm[0]):
            thigh, shank = arm
    if thigh < 0 and shank < 0:
        thigh = bones.find(THIGH[:-2], side, place)
        shank = bones.find(SHANK, side, place, where=lambda b: b != thigh)
    if thigh >= 0 and shank >= 0 and bones.under(thigh, shank):
        thigh, shank = -1, -1
    return thigh, shank


def _legs_by_structure(bones, foot):
    """Thigh and shank from the two bones above a foot, where they are long enough for legs."""
    above = [b for b in bones.chain(foot)[1:]]
    shank = thigh = -1
    for b in above:
        if bones.apart(b, foot) > 0.12 * bones.size:
            shank = b
            break
    if shank >= 0:
        for b in above[above.index(shank) + 1:]:
            if bones.apart(b, shank) > 0.12 * bones.size and bones.parents[b] >= 0:
                thigh = b
                break
    return (thigh, shank) if thigh >= 0 else (-1, -1)


# ---- by structure ----------------------------------------------------------------------------------------


def _by_structure(bones):
    """The lowest chains that come in mirrored pairs: their last bones are feet and toes."""
    useful = [b for b, each in enumerate(bones.read) if not NEVER_WORDS & set(each.words)]
    for deepest in (0, 2, 3):  # bones that deform alone, before a control rig's other copies of them
        kept = [b for b in useful if bones.read[b].layer <= deepest]
        best = (-1, [])
        for up in (2, 1):
            chains = _low_chains(bones, kept, up)
            for across in (0, 3 - up):  # armatures face along Y or Z, so that left and right are x; or along X
                pairs = _mirrored(bones, kept, chains, across, up)
                legs = len({_thigh_down(bones, a, up) for a, b in pairs if _thigh_down(bones, b, up) >= 0} - {-1})
                if pairs and (legs, len(pairs) if up == 2 else 0) > (best[0], len(best[1])):
                    best = legs, pairs, chains, up, across
        if best[1]:
            _, pairs, chains, up, across = best
            left = _left(bones, chains, pairs, up, across)
            number = lambda k: f" {k + 1}" if len(pairs) > 1 else ""
            return [Found(word + number(k), b, chains[b], -1) for k, pair in enumerate(pairs)
                    for word, b in zip(("left", "right"), sorted(pair, key=lambda b: -left * bones.head[b, across]))]
    return []


def _thigh_down(bones, foot, up):
    """The thigh of the leg that goes down to a foot, -1 where none does."""
    thigh = _legs_by_structure(bones, foot)[0]
    way = bones.tail[foot] - bones.head[thigh]
    return thigh if thigh >= 0 and -way[up] > STEEP * np.linalg.norm(way) else -1


def _low_chains(bones, kept, up):
    """Foot -> toe or -1 of each chain of these bones that ends low."""
    if not kept:
        return {}
    inside = set(kept)
    parent = {b: next((above for above in bones.chain(b)[1:] if above in inside), -1) for b in kept}
    low, high = bones.tail[kept, up].min(), bones.head[kept, up].max()
    height = max(high - low, 1e-9)
    feet = {}
    for leaf in set(kept) - set(parent.values()):
        if parent[leaf] < 0 or min(bones.tail[leaf, up], bones.head[leaf, up]) >= low + 0.12 * height:
            continue
        toe, foot = leaf, parent[leaf]
        run = bones.head[toe] - bones.head[foot]
        drop, size = -run[up], np.linalg.norm(run)
        if parent[foot] < 0 or drop > 0.85 * size or size > 0.25 * height:
            toe, foot = -1, leaf  # what lies above is a shank: the leaf is the whole foot
        feet.setdefault(foot, toe)
    return _one_foot(bones, feet, height)


def _one_foot(bones, feet, height):
    """Chains that hang on one shank are toes of one foot, where they come together below it."""
    shanks = {}
    for foot in feet:
        shanks.setdefault(_legs_by_structure(bones, foot)[1], []).append(foot)
    out = {}
    for shank, group in shanks.items():
        whole = [b for b in bones.chain(group[0]) if all(b in bones.chain(other) for other in group)]
        far = max((bones.apart(b, whole[0]) for b in group), default=0.0) if whole else np.inf
        if shank < 0 or len(group) == 1 or not bones.under(whole[0], shank) and far > TOES * height:
            out.update({foot: feet[foot] for foot in group})
        elif whole[0] not in out:
            toes = [foot for foot in group if foot != whole[0]] or [feet[whole[0]]]
            out[whole[0]] = max(toes, key=lambda b: bones.apart(b, whole[0]))
    return out


def _mirrored(bones, kept, chains, across, up):
    """Pairs of feet that are mirror images across an axis, from one end of the body to the other."""
    if not chains:
        return []
    height = max(bones.head[kept, up].max() - bones.tail[kept, up].min(), 1e-9)
    middle = np.median(bones.head[kept, across])
    off = lambda a, b: np.linalg.norm((bones.head[a] - bones.head[b])[[k for k in range(3) if k != across]])
    left, pairs = sorted(chains, key=lambda b: bones.names[b]), []
    along = 3 - up - across
    while left:
        a = left.pop(0)
        if abs(bones.head[a, across] - middle) <= 0.01 * height:
            continue
        twins = [b for b in left if off(a, b) < 0.1 * height
                 and abs(bones.head[a, across] + bones.head[b, across] - 2 * middle) < 0.05 * height]
        if twins:
            twin = min(twins, key=lambda b: off(a, b))
            left.remove(twin)
            pairs.append((a, twin))
    return sorted(pairs, key=lambda pair: bones.head[list(pair), along].mean())


def _left(bones, chains, pairs, up, across):
    """The sign of what is left along an axis: as the toes point, else as if facing -Y or, with Y up, Z."""
    along = 3 - up - across
    ahead = sum(bones.head[chains[b], along] - bones.head[b, along] for pair in pairs for b in pair if chains[b] >= 0)
    default = {(2, 1): -1.0, (1, 2): 1.0}.get((up, along), 1.0)
    way = np.zeros(3)
    way[along] = np.sign(ahead) or default
    return np.sign(np.cross(np.eye(3)[up], way)[across])
