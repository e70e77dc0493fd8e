"""Which bones are feet, toes, heels, hips and body segments. Names first (rig_names.py), then structure.

Skeleton --rig_feet.find_feet--> feet, toes, heels --rig_bones.find_legs--> thighs, shanks --build--> Rig
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..errors import DesirePathError
from .rig_bones import Bones, find_legs
from .rig_feet import find_feet
from .rig_names import CHEST, HEAD, HIPS, NECK
from .skeleton import Skeleton

# Winter, Biomechanics and Motor Control of Human Movement, 4th ed., table 4.1: share of the body's
# mass, and how far along the segment its centre lies from the first joint.
TRUNK = (0.678, 0.626)  # head, arms and trunk: hips to shoulders
UPPER = (0.100, 0.433)  # thigh: hip to knee
LOWER = (0.0465, 0.433)  # shank: knee to ankle
SOLE = (0.0145, 0.500)  # foot: ankle to ball
# Without a neck: the trunk's centre over the hips, in hip-to-ankle lengths, that puts the mass centre
# of a standing body at 0.56 of its height (Winter, chapter 4; leg 0.491, hip 0.530 of the height).
TRUNK_LIFT = 0.296
HIPS_NEAR = 0.75  # a bone named like hips lies this near to the legs' tops, in leg lengths: `spine` may be a tail

Points: TypeAlias = tuple[tuple[str, float], ...]  # bones, and where along them: 0 head .. 1 tail


# ---- what comes out --------------------------------------------------------------------------------


@dataclass(frozen=True)
class Foot:
    """The bones of one foot, by name."""

    limb: str  # a word for people: "left", "right", "left front" ..
    foot: str  # the bone whose head is the ankle
    toe: str | None = None  # the bone whose head is the ball
    heel: str | None = None  # a bone lying at the heel
    thigh: str | None = None
    shank: str | None = None


@dataclass(frozen=True)
class Segment:
    """A piece of the body: its mass sits `along` from start to end.

    start and end are means of points ((bone, 0 head .. 1 tail), ..); without an end the centre lies
    `lift` [m] above start. A leg without a knee bone goes from start to end as a whole: its segment is
    the one "above" or "below" the knee.
    """

    name: str
    mass: float  # share of the body
    along: float
    start: Points
    end: Points = ()
    lift: float = 0.0
    knee: str = ""  # "above", "below", or "" for a segment from joint to joint


@dataclass(frozen=True)
class Rig:
    """Which bones of an armature are what."""

    feet: tuple[Foot, ...]
    hips: str | None = None
    segments: tuple[Segment, ...] = ()
    warnings: tuple[str, ...] = ()

    @property
    def bones(self) -> tuple[str, ...]:
        """Names that must be sampled, each once."""
        names: list[str | None] = [n for f in self.feet for n in (f.foot, f.toe)]
        names += [self.hips] + [n for s in self.segments for n, _ in s.start + s.end]
        return tuple(dict.fromkeys(n for n in names if n))


# ---- finding feet -----------------------------------------------------------------------------------


def legs(skeleton: Skeleton, foot: str) -> tuple[str | None, str | None]:
    """Names of thigh and shank above a foot bone, None each where there are none."""
    bones = Bones(skeleton)
    if foot not in bones.names:
        raise DesirePathError(
            f"The armature has no bone {foot}: it was renamed or removed; choose the foot bone again."
        )
    thigh, shank = find_legs(bones, bones.names.index(foot))
    return bones.names[thigh] if thigh >= 0 else None, bones.names[shank] if shank >= 0 else None


def detect(skeleton: Skeleton) -> Rig:
    """Feet, hips and segments of a skeleton, or a DesirePathError that says what is missing."""
    bones = Bones(skeleton)
    if not bones.names:
        raise DesirePathError("The armature has no bones: choose the one that walks.")
    found, by_shape = find_feet(bones)
    if not found:
        raise DesirePathError(
            "No foot bones were found: the armature has no bone named like a foot or an ankle and "
            "no pair of legs; choose the foot bones by hand."
        )
    warnings = []
    if by_shape:
        warnings.append(
            "The feet were found by the shape of the rig, not by name: check that "
            + ", ".join(bones.names[each.foot] for each in found)
            + " are the feet."
        )

    def name(b: int) -> str | None:
        return bones.names[b] if b >= 0 else None

    feet = [
        Foot(
            each.limb,
            bones.names[each.foot],
            *map(name, (each.toe, each.heel, *find_legs(bones, each.foot, each.place))),
        )
        for each in found
    ]
    return build(skeleton, feet, warnings=warnings)


# ---- segments -----------------------------------------------------------------------------------------


def _hips(bones: Bones, feet: Sequence[Foot]) -> int:
    """The bone named like hips that lies at the legs, else the one on which the first two of them hang."""
    row = {name: k for k, name in enumerate(bones.names)}
    ground = np.mean([bones.head[row[f.foot]] for f in feet], axis=0)
    tops = [row[f.thigh] for f in feet[:2] if f.thigh]
    top, leg = np.zeros(3), np.inf
    if tops:
        top = bones.head[tops].mean(axis=0)
        leg = float(np.mean([bones.apart(row[f.thigh], row[f.foot]) for f in feet[:2] if f.thigh]))
    passes = len(feet) > 2 and bool(tops)  # a trunk passes its legs, wherever it begins

    def near(b: int) -> bool:
        return not tops or bool(np.linalg.norm(bones.head[b] - top) < HIPS_NEAR * leg)

    def high(b: int) -> bool:
        if passes:
            return bones.beside(b, top) < HIPS_NEAR * leg
        return bool(np.linalg.norm(bones.head[b] - ground) > 0.25 * bones.size)

    named = bones.find(HIPS[:2] if len(feet) > 2 else HIPS, "", where=lambda b: high(b) and near(b))
    if (
        named >= 0
        and bones.read[named].layer < 3
        and (len(feet) == 2 or bones.read[named].layer <= max(bones.read[row[f.foot]].layer for f in feet))
    ):
        return named
    chains = [bones.chain(row[f.thigh or f.foot]) for f in (feet[:2] if len(feet) > 2 else feet)]
    shared = [b for b in chains[0][1:] if all(b in c for c in chains[1:]) and high(b)]
    if not shared and len(feet) > 2:
        shared = [b for b in chains[0][1:] if all(b in c for c in chains[1:])]
    if not shared:
        return bones.find(HIPS, "", where=high) if named < 0 else named
    twin = bones.names[shared[0]].replace("ORG-", "DEF-")  # Rigify's legs hang on bones that deform nothing
    return row.get(twin, shared[0])


def build(skeleton: Skeleton, feet: Sequence[Foot], hips: str | None = None, *, warnings: Iterable[str] = ()) -> Rig:
    """A Rig from chosen feet: hips found where not given, segments from whatever bones there are."""
    bones = Bones(skeleton)
    for foot in feet:
        for name in (foot.foot, foot.toe, foot.thigh, foot.shank):
            if name is not None and name not in bones.names:
                raise DesirePathError(
                    f"The armature has no bone {name}: it was renamed or removed; "
                    "detect the rig again or choose the bone by hand."
                )
    if not feet:
        raise DesirePathError("No foot bones were chosen: choose at least one foot bone.")
    if hips is not None and hips not in bones.names:
        raise DesirePathError(
            f"The armature has no bone {hips}: it was renamed or removed; detect "
            "the rig again or choose the hips by hand."
        )
    at = _hips(bones, feet) if hips is None else bones.names.index(hips)
    warnings = list(warnings)
    many = len(feet) > 2
    tops = tuple((f.thigh, 0.0) for f in feet if f.thigh)
    if at < 0 and not tops:
        warnings.append(
            "No hips bone was found: the mass centre is taken above the feet; choose the hips bone by hand."
        )
        return Rig(tuple(feet), None, (), tuple(warnings))
    hip = ((bones.names[at], 0.0),) if at >= 0 else tops
    segments = []
    # the trunk: hips to neck, or what stands in for the neck, or straight up
    if many:
        # a body hung between its legs: no table fits every animal
        segments.append(Segment("trunk", 0.8, 0.0, tops if len(tops) == len(feet) else hip))
    else:
        neck = bones.find(NECK, "")
        end: Points = ((bones.names[neck], 0.0),) if neck >= 0 else ()
        if neck < 0 and (neck := bones.find(HEAD, "")) >= 0:
            end = ((bones.names[neck], 0.0),)
        if neck < 0 and (neck := bones.find(CHEST, "")) >= 0:
            end = ((bones.names[neck], 1.0),)
        if end and at >= 0 and end[0][0] == bones.names[at]:
            end = ()
        legs = [
            np.linalg.norm(bones.head[bones.names.index(f.thigh or hip[0][0])] - bones.head[bones.names.index(f.foot)])
            for f in feet
        ]
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
            segments.append(Segment(f"{foot.limb} thigh", UPPER[0] * scale, UPPER[1], top, ankle, knee="above"))
            segments.append(Segment(f"{foot.limb} shank", LOWER[0] * scale, LOWER[1], top, ankle, knee="below"))
        ball = ((foot.toe, 0.0),) if foot.toe else ((foot.foot, 1.0),)
        segments.append(Segment(f"{foot.limb} foot", SOLE[0] * scale, SOLE[1], ankle, ball))
    return Rig(tuple(feet), bones.names[at] if at >= 0 else None, tuple(segments), tuple(warnings))
