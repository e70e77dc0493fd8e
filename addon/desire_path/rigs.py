"""Which bones are feet, toes, heels, hips and body segments. Names first (rig_names.py), then structure."""

from dataclasses import dataclass

import numpy as np

from .errors import DesirePathError
from .rig_names import (CHEST, FOOT, HEAD, HEEL, HIPS, NECK, NEVER_WORDS, PLACE_WORDS, SHANK, THIGH, TOE,
                        rank_of, read)

# Winter, Biomechanics and Motor Control of Human Movement, 4th ed., table 4.1: share of the body's
# mass, and how far along the segment its centre lies from the first joint.
TRUNK = (0.678, 0.626)  # head, arms and trunk: hips to shoulders
UPPER = (0.100, 0.433)  # thigh: hip to knee
LOWER = (0.0465, 0.433)  # shank: knee to ankle
SOLE = (0.0145, 0.500)  # foot: ankle to ball
# Without a neck: the trunk's centre over the hips, in hip-to-ankle lengths, that puts the mass centre
# of a standing body at 0.56 of its height (Winter, chapter 4; leg 0.491, hip 0.530 of the height).
TRUNK_LIFT = 0.296


# ---- what comes out --------------------------------------------------------------------------------


@dataclass(frozen=True)
class Foot:
    limb: str  # a word for people: "left", "right", "left front" ..
    foot: str  # the bone whose head is the ankle
    toe: str | None = None  # the bone whose head is the ball
    heel: str | None = None  # a bone lying at the heel
    thigh: str | None = None
    shank: str | None = None


@dataclass(frozen=True)
class Segment:
    """A piece of the body: its mass sits `along` the way from start to end.

    start and end are means of points ((bone, 0 head .. 1 tail), ..); without an end the centre lies
    `lift` [m] above start. A leg without a knee bone goes from start to end as a whole: its segment is
    the one "above" or "below" the knee.
    """

    name: str
    mass: float  # share of the body
    along: float
    start: tuple
    end: tuple = ()
    lift: float = 0.0
    knee: str = ""  # "above", "below", or "" for a segment from joint to joint


@dataclass(frozen=True)
class Rig:
    feet: tuple  # Foot
    hips: str | None = None
    segments: tuple = ()
    warnings: tuple = ()

    @property
    def bones(self):
        """Names that must be sampled, each once."""
        names = [n for f in self.feet for n in (f.foot, f.toe)]
        names += [self.hips] + [n for s in self.segments for n, _ in s.start + s.end]
        return tuple(dict.fromkeys(n for n in names if n))


class _Bones:
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

    def find(self, table, side="", place=None, where=None):
        """The best bone for a slot: layer first, then pattern; -1 if none."""
        best, found = None, -1
        for b, name in enumerate(self.read):
            if name.side != side or NEVER_WORDS & set(name.words):
                continue
            rank = rank_of(name.words, table)
            if rank is None or (place is not None and _place(name.words) != place):
                continue
            if where is not None and not where(b):
                continue
            order = (name.layer, rank, len(name.words), len(self.chain(b)))
            if best is None or order < best:
                best, found = order, b
        return found


def _place(words):
    for word in words:
        if word in PLACE_WORDS:
            return PLACE_WORDS[word]
    return ""


# ---- finding feet -----------------------------------------------------------------------------------


def _foot_by_name(bones, side, place):
    foot = bones.find(FOOT, side, place)
    if foot < 0:
        return None
    ankle = bones.find(("ankle",), side, place)
    ball = -1
    if ankle >= 0 and ankle != foot and bones.under(foot, ankle):
        if bones.read[ankle].layer <= bones.read[foot].layer:
            foot, ball = ankle, foot  # SMPL: its left_foot is the ball of the foot
    layer = bones.read[foot].layer
    near = max(bones.size * 0.2, 1e-6)

    def beside(b):
        if bones.under(b, foot):
            return True
        apart = np.linalg.norm(bones.head[b] - bones.head[foot])
        return apart < near and bones.read[b].layer == layer

    toe = bones.find(TOE, side, place, where=beside)
    inside = bones.find(TOE, side, place, where=lambda b: bones.under(b, foot))
    if inside >= 0 and bones.read[inside].layer <= max(layer, bones.read[toe].layer):
        toe = inside
    if toe < 0:
        toe = ball
    heel = bones.find(HEEL, side, place,
                      where=lambda b: np.linalg.norm(bones.head[b] - bones.head[foot]) < near)
    return foot, toe, heel


def _legs_by_name(bones, side, place, foot):
    """Thigh and shank of a foot: on its own chain where it has one, else by name alone."""
    on_chain = set(bones.chain(foot)[1:])
    shank = bones.find(("knee",), side, place, where=on_chain.__contains__)
    thigh = bones.find(THIGH[:-2], side, place, where=on_chain.__contains__)
    if shank < 0:
        shank = bones.find(SHANK, side, place, where=lambda b: b in on_chain and b != thigh)
    if thigh < 0:
        thigh = bones.find(THIGH + ("leg",), side, place,
                           where=lambda b: b in on_chain and b != shank)
    if thigh < 0 and shank < 0:
        thigh = bones.find(THIGH[:-2], side, place)
        shank = bones.find(SHANK, side, place, where=lambda b: b != thigh)
    if thigh >= 0 and shank >= 0 and bones.under(thigh, shank):
        thigh, shank = -1, -1
    return thigh, shank


def _leg_by_structure(bones, foot):
    """Thigh and shank from the two bones above a foot, where they are long enough for legs."""
    above = [b for b in bones.chain(foot)[1:]]
    length = lambda a, b: np.linalg.norm(bones.head[a] - bones.head[b])
    shank = thigh = -1
    for b in above:
        if length(b, foot) > 0.12 * bones.size:
            shank = b
            break
    if shank >= 0:
        for b in above[above.index(shank) + 1:]:
            if length(b, shank) > 0.12 * bones.size and bones.parents[b] >= 0:
                thigh = b
                break
    return (thigh, shank) if thigh >= 0 else (-1, -1)


def _feet_by_structure(bones):
    """The lowest chains that come in mirrored pairs: their last bones are feet and toes."""
    count = len(bones.names)
    children = [[] for _ in range(count)]
    for b, p in enumerate(bones.parents):
        if p >= 0:
            children[p].append(b)
    for up in (2, 1):
        low, high = bones.tail[:, up].min(), bones.head[:, up].max()
        height = max(high - low, 1e-9)
        leaves = [b for b in range(count) if not children[b] and bones.parents[b] >= 0
                  and min(bones.tail[b, up], bones.head[b, up]) < low + 0.12 * height]
        feet = {}
        for leaf in leaves:
            toe, foot = leaf, bones.parents[leaf]
            run = bones.head[toe] - bones.head[foot]
            drop, size = -run[up], np.linalg.norm(run)
            if bones.parents[foot] < 0 or drop > 0.85 * size or size > 0.25 * height:
                toe, foot = -1, leaf  # what lies above is a shank: the leaf is the whole foot
            if foot not in feet:
                feet[foot] = toe
        across = 0  # armatures face along Y or Z: left and right are x
        middle = np.median(bones.head[:, across])
        pairs = []
        for a in feet:
            twin = [b for b in feet if b != a
                    and abs(bones.head[a, across] + bones.head[b, across] - 2 * middle) < 0.05 * height
                    and np.linalg.norm(np.delete(bones.head[a] - bones.head[b], across)) < 0.1 * height
                    and abs(bones.head[a, across] - middle) > 0.01 * height]
            if twin:
                pairs.append(a)
        if len(pairs) >= 2:
            return [(a, feet[a], -1) for a in pairs], up
    return [], 2


def legs(skeleton, foot):
    """Names of thigh and shank above a foot bone, None each where there are none."""
    bones = _Bones(skeleton)
    at = bones.names.index(foot)
    read = bones.read[at]
    thigh, shank = (_legs_by_name(bones, read.side, _place(read.words), at) if read.side
                    else (-1, -1))
    if thigh < 0 or shank < 0:
        guess = _leg_by_structure(bones, at)
        thigh, shank = guess if guess[0] >= 0 else (thigh, shank)
    return tuple(bones.names[b] if b >= 0 else None for b in (thigh, shank))


def _limb_word(side, place):
    word = {"L": "left", "R": "right"}.get(side, "")
    return f"{word} {place}".strip() or "foot"


def detect(skeleton):
    """Feet, hips and segments of a skeleton, or a DesirePathError that says what is missing."""
    bones = _Bones(skeleton)
    if not bones.names:
        raise DesirePathError("The armature has no bones: choose the one that walks.")
    found, warnings = [], []
    for place in ("", "front", "mid"):
        for side in ("L", "R"):
            slots = _foot_by_name(bones, side, place)
            if slots:
                found.append((_limb_word(side, place), side, place) + slots)
    if len({f[3] for f in found}) < 2:
        chains, up = _feet_by_structure(bones)
        if chains:
            middle = np.median(bones.head[:, 0])
            found = [("left" if bones.head[foot, 0] > middle else "right", None, None, foot, toe,
                      heel) for foot, toe, heel in chains]
            if len(found) > 2:
                found = [(f"{f[0]} {i // 2 + 1}",) + f[1:] for i, f in enumerate(found)]
            warnings.append("The feet were found by the shape of the rig, not by name: check that "
                            + ", ".join(bones.names[f[3]] for f in found) + " are the feet.")
    if not found and (slots := _foot_by_name(bones, "", "")):
        found.append((_limb_word("", ""), "", "") + slots)  # a pogo stick, a lamp: one leg in the middle
    if not found:
        raise DesirePathError(
            "No foot bones were found: the armature has no bone named like a foot or an ankle and "
            "no pair of legs; choose the foot bones by hand.")
    feet = []
    for word, side, place, foot, toe, heel in found:
        thigh, shank = _legs_by_name(bones, side, place, foot) if side else (-1, -1)
        if thigh < 0 or shank < 0:
            guess = _leg_by_structure(bones, foot)
            thigh, shank = guess if guess[0] >= 0 else (thigh, shank)
        name = lambda b: bones.names[b] if b >= 0 else None
        feet.append(Foot(word, name(foot), name(toe), name(heel), name(thigh), name(shank)))
    return build(skeleton, feet, warnings=warnings)


# ---- segments -----------------------------------------------------------------------------------------


def _hips(bones, feet):
    ground = np.mean([bones.head[bones.names.index(f.foot)] for f in feet], axis=0)
    high = lambda b: np.linalg.norm(bones.head[b] - ground) > 0.25 * bones.size
    named = bones.find(HIPS, "", where=high)
    if named >= 0 and bones.read[named].layer < 3:
        return named
    chains = [bones.chain(bones.names.index(f.thigh or f.foot)) for f in feet]
    shared = [b for b in chains[0] if all(b in c for c in chains[1:]) and high(b)]
    return shared[0] if shared else named


def build(skeleton, feet, hips=None, *, warnings=()):
    """A Rig from chosen feet: hips found where not given, segments from whatever bones there are."""
    bones = _Bones(skeleton)
    for foot in feet:
        for name in (foot.foot, foot.toe, foot.thigh, foot.shank):
            if name is not None and name not in bones.names:
                raise DesirePathError(f"The armature has no bone {name}: it was renamed or removed; "
                                      "detect the rig again or choose the bone by hand.")
    if not feet:
        raise DesirePathError("No foot bones were chosen: choose at least one foot bone.")
    if hips is not None and hips not in bones.names:
        raise DesirePathError(f"The armature has no bone {hips}: it was renamed or removed; detect "
                              "the rig again or choose the hips by hand.")
    at = _hips(bones, feet) if hips is None else bones.names.index(hips)
    warnings = list(warnings)
    many = len(feet) > 2
    tops = tuple((f.thigh, 0.0) for f in feet if f.thigh)
    if at < 0 and not tops:
        warnings.append("No hips bone was found: the mass centre is taken above the feet; choose "
                        "the hips bone by hand.")
        return Rig(tuple(feet), None, (), tuple(warnings))
    hip = ((bones.names[at], 0.0),) if at >= 0 else tops
    segments = []
    # the trunk: hips to neck, or what stands in for the neck, or straight up
    if many:
        # a body hung between its legs: no table fits every animal
        segments.append(Segment("trunk", 0.8, 0.0, tops if len(tops) == len(feet) else hip))
    else:
        top = bones.find(NECK, "")
        end = ((bones.names[top], 0.0),) if top >= 0 else ()
        if top < 0 and (top := bones.find(HEAD, "")) >= 0:
            end = ((bones.names[top], 0.0),)
        if top < 0 and (top := bones.find(CHEST, "")) >= 0:
            end = ((bones.names[top], 1.0),)
        if end and at >= 0 and end[0][0] == bones.names[at]:
            end = ()
        legs = [np.linalg.norm(bones.head[bones.names.index(f.thigh or hip[0][0])]
                               - bones.head[bones.names.index(f.foot)]) for f in feet]
        lift = TRUNK_LIFT * float(np.mean(legs))
        low = hip if end or len(tops) < len(feet) else tops  # straight up from between the hip joints
        segments.append(Segment("trunk", *TRUNK, low, end, 0.0 if end else lift))
    scale = 0.2 / len(feet) / (UPPER[0] + LOWER[0] + SOLE[0]) if many else 1.0
    for foot in feet:
        top = ((foot.thigh, 0.0),) if foot.thigh else hip
        ankle = ((foot.foot, 0.0),)
        if foot.thigh and foot.shank:
            knee = ((foot.shank, 0.0),)
            segments.append(Segment(f"{foot.limb} thigh", UPPER[0] * scale, UPPER[1], top, knee))
            segments.append(Segment(f"{foot.limb} shank", LOWER[0] * scale, LOWER[1], knee, ankle))
        else:
            segments.append(Segment(f"{foot.limb} thigh", UPPER[0] * scale, UPPER[1], top, ankle,
                                    knee="above"))
            segments.append(Segment(f"{foot.limb} shank", LOWER[0] * scale, LOWER[1], top, ankle,
                                    knee="below"))
        ball = ((foot.toe, 0.0),) if foot.toe else ((foot.foot, 1.0),)
        segments.append(Segment(f"{foot.limb} foot", SOLE[0] * scale, SOLE[1], ankle, ball))
    return Rig(tuple(feet), bones.names[at] if at >= 0 else None, tuple(segments), tuple(warnings))
