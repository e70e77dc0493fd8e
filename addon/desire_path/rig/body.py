"""From bones that moved to a Gait: mass centre, contact parts, soles, contact points. MODEL 3.5

Skeleton, Motion, Skin ---rigs.detect---> Rig ---gait_from_bones---> Gait
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..errors import DesirePathError
from ..keywords import fields_of
from ..motion import drawn, freeze, jumps, rotation, stays
from ..motion import size as sizes
from ..motion.gait import Gait, Sole
from . import rigs, slope, tread
from .foot import GUESS, Foot, FootShape
from .foot_parts import RestPose, lay_tread, parts
from .rigs import Rig, Segment
from .skeleton import Motion, SampledBones, Skeleton, Skin
from .sole_mesh import Tread

__all__ = ["Motion", "Skeleton", "Skin", "SoleSource", "gait_from_bones"]

MIN_SPAN = 0.005  # of a walker's joints [m]
LEG_OF_TOP = 0.55  # hips over the ankles in shares of the highest joint's height over them; Winter, figure 4.1


# ---- checks ----------------------------------------------------------------------------------------------


def _check(skeleton: Skeleton, motion: Motion, rig: Rig, mass: float, frame_rate: float, frame_start: int) -> None:
    count = len(skeleton.names)
    if np.shape(skeleton.rest) != (count, 4, 4) or np.shape(skeleton.length) != (count,):
        raise DesirePathError("The skeleton's rest matrices do not fit its bones: record again.")
    time = np.asarray(motion.time, float)
    if not len(time):
        raise DesirePathError("The recording has no frames: choose a frame range in which the character walks.")
    span = max(np.ptp(np.asarray(skeleton.rest, float)[:, :3, 3], axis=0).max(), np.max(skeleton.length))
    if span < MIN_SPAN:
        raise DesirePathError(
            f"The bones span {span:.2g} m, too little for feet: check the walker's scale and the scene's unit scale."
        )
    if np.shape(motion.matrix) != (len(time), len(motion.bones), 4, 4):
        raise DesirePathError("The recorded matrices do not fit their times and bones: record again.")
    if not np.isfinite(mass) or mass <= 0:
        raise DesirePathError(f"A mass of {mass:g} kg cannot press the ground: give the walker a mass above 0.")
    if not np.isfinite(frame_rate) or frame_rate <= 0:
        raise DesirePathError(
            f"A frame rate of {frame_rate:g} cannot be used: set the scene's frames a second to more than 0."
        )
    if not np.isfinite(time).all() or (np.diff(time) <= 0).any():
        raise DesirePathError("The recorded times do not increase: record again.")
    for name in rig.bones:
        if name not in skeleton.names or name not in motion.bones:
            raise DesirePathError(
                f"Bone {name} was not recorded: it was renamed or removed; detect "
                "the rig again or choose the bone by hand."
            )
        row = list(skeleton.names).index(name)
        if not np.isfinite(skeleton.rest[row]).all() or not np.isfinite(skeleton.length[row]):
            raise DesirePathError(f"Bone {name} has a broken rest pose: mend the bone in edit mode.")
        matrix = np.asarray(motion.matrix)[:, list(motion.bones).index(name)]
        bad = ~np.isfinite(matrix).all(axis=(1, 2))
        if bad.any():
            frame = frame_start + (time[bad.argmax()] - time[0]) * frame_rate
            raise DesirePathError(
                f"Bone {name} has no finite position at frame {frame:g}: mend the "
                "animation there or leave the frame out."
            )
        bad = abs(np.linalg.det(matrix[:, :3, :3])) < 1e-9
        if bad.any():
            frame = frame_start + (time[bad.argmax()] - time[0]) * frame_rate
            raise DesirePathError(
                f"Bone {name} is scaled to nothing at frame {frame:g}: give it a scale above 0 there."
            )


# ---- the mass centre --------------------------------------------------------------------------------------


def leg_length(bones: SampledBones, rig: Rig, up: np.ndarray) -> float:
    """Hips to ankles in the rest pose [m]; where hips tell none by what is above the feet, else by the feet."""
    ankles = np.array([bones.rest_point(f.foot) for f in rig.feet]) @ up
    top = float((bones.rest[:, :3, 3] @ up).max() - ankles.mean())
    leg = float(bones.rest_point(rig.hips) @ up - np.median(ankles)) if rig.hips else 0.0
    if leg > 0.1 * top:
        return leg
    foot = float(np.median([bones.length[bones.row[f.foot]] for f in rig.feet]))
    return LEG_OF_TOP * top if top > 0.1 * foot else foot / GUESS[0]


def stretched_leg(bones: SampledBones, rig: Rig, leg: float) -> float:
    """From hip joint to ankle along the bones of a leg [m]; as given where a foot has none."""
    if not all(f.thigh for f in rig.feet):
        return leg
    joints = [[bones.rest_point(name) for name in (f.thigh, f.shank, f.foot) if name] for f in rig.feet]
    return float(np.mean([np.linalg.norm(np.diff(each, axis=0), axis=1).sum() for each in joints]))


def mass_centre(bones: SampledBones, rig: Rig, leg: float) -> np.ndarray:
    """(T, 3): the segments' centres weighted by their masses; the hips bone without segments, else over the feet."""
    if not rig.segments:
        if rig.hips:
            return bones.point(rig.hips).copy()
        return np.asarray(np.mean([bones.point(f.foot) for f in rig.feet], axis=0) + (0.0, 0.0, leg))
    total = sum(s.mass for s in rig.segments)
    com = np.zeros((len(bones.matrix), 3))
    ahead = _facing(bones, rig) if any(s.knee for s in rig.segments) else None
    for segment in rig.segments:
        start = bones.mean(segment.start)
        end = bones.mean(segment.end) if segment.end else start
        if segment.knee and ahead is not None:
            knee = _knee(bones, segment, start, end, ahead)
            start, end = (start, knee) if segment.knee == "above" else (knee, end)
        at = start + segment.along * (end - start)
        at[:, 2] += segment.lift
        com = com + segment.mass / total * at
    return com


def _facing(bones: SampledBones, rig: Rig) -> np.ndarray:
    """Where two feet point between them, level (T, 3); zero where they do not or are not two."""
    ahead = np.zeros((len(bones.matrix), 3))
    for foot in rig.feet:
        tip = bones.point(foot.toe) if foot.toe else bones.point(foot.foot, 1.0)
        ahead = ahead + (tip - bones.point(foot.foot)) * (1.0, 1.0, 0.0)
    return ahead * (len(rig.feet) == 2)


def _knee(bones: SampledBones, leg: Segment, hip: np.ndarray, ankle: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """Where the knee is that a leg has no bone for (T, 3).

    A leg is as long as in the rest pose, halved by its knee (Winter, figure 4.1: 0.245 and 0.246 of the
    height): an ankle nearer to the hip than that bends it ahead, where the feet point.
    """
    half = np.linalg.norm(bones.mean(leg.end, rest=True) - bones.mean(leg.start, rest=True)) / 2.0
    down = ankle - hip
    apart = np.linalg.norm(down, axis=1, keepdims=True)
    down = down / np.maximum(apart, 1e-9)
    ahead = ahead - (ahead * down).sum(axis=1, keepdims=True) * down
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    return np.asarray((hip + ankle) / 2.0 + np.sqrt(np.maximum(half**2 - apart**2 / 4.0, 0.0)) * ahead)


def rest_up(bones: SampledBones, rig: Rig) -> np.ndarray:
    """The axis of rest space that points up: the one nearest to feet-to-hips, of many feet that of their legs."""
    feet = np.mean([bones.rest_point(f.foot) for f in rig.feet], axis=0)
    high = bones.rest_point(rig.hips) - feet if rig.hips else np.array([0.0, 0.0, 1.0])
    thighs = [f.thigh for f in rig.feet if f.thigh]
    if len(rig.feet) > 2 and len(thighs) == len(rig.feet):  # their hips lie at one end of the body
        high = np.mean([bones.rest_point(thigh) for thigh in thighs], axis=0) - feet
    up = np.zeros(3)
    axis = int(np.argmax(abs(high))) if np.linalg.norm(high) > 0 else 2
    up[axis] = np.sign(high[axis]) or 1.0
    return up


# ---- the door --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class SoleSource:
    """Where a walker's soles come from, and by what they lie."""

    skin: Skin | None = None  # its underside; None: soles are built in
    # a mesh under every foot, in the place of the skin; or what built-in soles have: "plain", "lugs" or "waves"
    tread: Tread | str | None = None
    land: slope.Hills | None = None  # a Simulation: feet that lie on its slopes have soles that do; None: level ground
    shapes: Mapping[str, FootShape] | None = None  # by foot bone, of feet that were placed on the ground and tell no
    # more how they lie flat


@fields_of(soles=SoleSource)
def gait_from_bones(
    skeleton: Skeleton,
    motion: Motion,
    *,
    mass: float,
    name: str = "Walker",
    rig: Rig | None = None,
    frame_rate: float,
    frame_start: int = 1,
    soles: SoleSource = SoleSource(),
) -> Gait:
    """What the walker did, from sampled bones. Refuses bad recordings with a sentence.

    mass [kg] > 0. rig: which bones are what; None: as their names and shape tell. frame_rate: scene frames a second;
    frame_start: the frame at the first time. soles: where they come from.
    """
    rig = rig or rigs.detect(skeleton)
    _check(skeleton, motion, rig, mass, frame_rate, frame_start)
    bones = SampledBones(skeleton, motion)
    time = np.asarray(motion.time, float)
    warnings = list(rig.warnings)
    up_rest = rest_up(bones, rig)
    leg = leg_length(bones, rig, up_rest)
    com = mass_centre(bones, rig, leg)
    leaps = jumps.between(time, com, np.array([bones.point(f.foot) for f in rig.feet]), frame_rate, time[0])
    cut = [sample for a, b, _ in leaps for sample in range(a + 1, b + 1)]
    warnings += jumps.sentences(name, [(*(frame_start + time[[a, b]] * frame_rate), size) for a, b, size in leaps])
    matrix, lasts = drawn.moving(time, np.asarray(motion.matrix, float), cut)
    if lasts:
        motion = replace(motion, matrix=matrix)
        bones = SampledBones(skeleton, motion)
        com = mass_centre(bones, rig, leg)
        warnings += drawn.sentences(name, lasts * frame_rate)
    bones.tell, bones.cut = ~jumps.alone(len(time), cut), tuple(cut)
    own_leg = stretched_leg(bones, rig, leg)
    moving, moving_com, bones, again, rests = _moving(skeleton, motion, rig, bones, time, com, cut, own_leg / sizes.LEG)
    shapes = soles.shapes or {}
    person = len(rig.feet) == 2 and bool(rig.hips)
    feet = [Foot(bones, f, leg, person, shapes.get(f.foot), len(rig.feet) > 2) for f in rig.feet]
    square = _square(bones, feet, up_rest, -1.0 if skeleton.mirrored else 1.0)
    _hold(feet, stays.still(moving_com, moving, own_leg / sizes.LEG), rests, own_leg / sizes.LEG)
    if person and square is not None:
        for foot in feet:
            foot.face(square, up_rest)
    ahead_rest = _ahead(feet, up_rest, square)
    lefts = _lefts(bones, feet, np.cross(up_rest, ahead_rest))
    at_rest = _soled(RestPose(skeleton, up_rest, ahead_rest, soles.skin), soles, feet, lefts, moving)
    warnings += at_rest.laid.warnings if at_rest.laid is not None else ()
    hills: Sequence[slope.Slope | None] = [None] * len(feet)
    if soles.land is not None:
        hills = slope.below(soles.land, feet, moving, up_rest, bool(shapes) or None)
    limbs = _limbs(bones, feet, hills, lefts, moving, at_rest)
    return Gait(
        time=time,
        com=com[None],
        mass=np.array([mass]),
        pose=np.array(limbs.pose)[:, again],
        limb_walker=np.zeros(len(feet)),
        part_limb=np.repeat(np.arange(len(feet)), 2),
        soles=tuple(limbs.soles),
        point=np.array(limbs.point),
        point_part=np.array(limbs.point_part),
        point_role=np.array(limbs.point_role),
        limb_name=tuple(f.foot for f in rig.feet),
        part_name=("heel", "toe") * len(feet),
        walker_name=(name,),
        frame_rate=frame_rate,
        frame_start=frame_start,
        warnings=(*warnings, *limbs.warnings),
        cut=np.array(cut),
        jump=np.array([(sample, 0) for sample in cut]),
        leg=np.array([own_leg]),
    ).check()


def _hold(feet: Sequence[Foot], still: np.ndarray, rests: np.ndarray, size: float) -> None:
    """Tell feet when their body keeps still (T,), and how large it is."""
    still = still & ~np.all([foot.low(~still) for foot in feet], axis=0)  # who stands on all feet shows them flat
    for foot in feet:
        foot.held, foot.size = still | rests, size


def _soled(
    at_rest: RestPose, soles: SoleSource, feet: Sequence[Foot], lefts: Sequence[bool], moving: np.ndarray
) -> RestPose:
    """The rest pose with the treads that are asked for."""
    if isinstance(soles.tread, str):
        return replace(at_rest, tread=tread.check(soles.tread))
    if soles.tread is not None:
        return replace(at_rest, laid=lay_tread(soles.tread, feet, lefts, moving, at_rest))
    return at_rest


def _lefts(bones: SampledBones, feet: Sequence[Foot], left_axis: np.ndarray) -> list[bool]:
    """Which feet are left ones: by their names, else by their side of the others."""
    ankles = np.array([bones.rest_point(foot.slots.foot) for foot in feet])
    to_left = ankles @ left_axis - ankles.mean(axis=0) @ left_axis
    named = np.array([f.slots.limb.startswith("left") * 1.0 - f.slots.limb.startswith("right") for f in feet])
    mirrored = named @ to_left < 0.0  # the object is: what is called left stands on the right
    sided = -named if mirrored else named
    return [bool(each) for each in (sided > 0.0) | ((sided == 0.0) & (to_left > 0.0))]


@dataclass
class _Limbs:
    """The parts of all limbs, two each, with their contact points, as a Gait has them."""

    pose: list[np.ndarray] = field(default_factory=list)
    soles: list[Sole] = field(default_factory=list)
    point: list[tuple[float, float, float]] = field(default_factory=list)
    point_part: list[int] = field(default_factory=list)
    point_role: list[int] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def _limbs(
    bones: SampledBones,
    feet: Sequence[Foot],
    hills: Sequence[slope.Slope | None],
    lefts: Sequence[bool],
    time: np.ndarray,
    at_rest: RestPose,
) -> _Limbs:
    """Parts of feet; who lies on a hill is taken from it to level ground, and what is found there back."""
    out = _Limbs()
    for limb, (foot, hill) in enumerate(zip(feet, hills)):
        if hill is not None:
            foot = foot.over(hill.flattened(bones, (foot.slots.foot, foot.slots.toe)))
        pose, pair, marks, odd = parts(foot, foot.bones, time, lefts[limb], at_rest)
        first = len(out.pose)
        out.pose += pose if hill is None else [hill.back(each) for each in pose]
        out.soles += pair
        out.warnings += odd
        for part, role, at in marks:
            out.point.append(at)
            out.point_part.append(first + part)
            out.point_role.append(role)
    return out


def _moving(
    skeleton: Skeleton,
    motion: Motion,
    rig: Rig,
    bones: SampledBones,
    time: np.ndarray,
    com: np.ndarray,
    cut: Sequence[int],
    size: float,
) -> tuple[np.ndarray, np.ndarray, SampledBones, np.ndarray, np.ndarray]:
    """The clip without the poses that are held in mid-step: what they interrupt is one motion.

    (times, mass centre, bones, the sample of theirs for each of the clip, which of them hold a pose at rest)
    """
    poses = [(bones.point(name), bones.turn(name)) for name in rig.bones]
    held, rests = [], np.zeros(len(time), bool)
    for first, after in zip([0, *cut], [*cut, len(time)]):
        part = slice(first, after)
        moves = [(at[part], turn[part]) for at, turn in poses]
        held += [(first + a, first + b) for a, b in freeze.stops(time[part], com[part], moves, size)]
        for a, b in freeze.stops(time[part], com[part], moves, size, rests=True):
            rests[first + a + 1 : first + b + 1] = True
    keep = freeze.kept(len(time), tuple(held))
    if held:
        tell, bones = (
            bones.tell[keep],
            SampledBones(skeleton, Motion(time[keep], motion.bones, np.asarray(motion.matrix)[keep])),
        )
        bones.tell, bones.cut = tell, tuple(np.searchsorted(keep, cut).tolist())
    again = np.searchsorted(keep, np.arange(len(time)), side="right") - 1
    return freeze.closed(time, tuple(held))[keep], com[keep], bones, again, rests[keep]


def _square(bones: SampledBones, feet: Sequence[Foot], up: np.ndarray, sign: float) -> np.ndarray | None:
    """Where a body faces whose left feet are to its left, as they are named; None where they are not."""
    lefts = [bones.rest_point(f.slots.foot) for f in feet if f.slots.limb.startswith("left")]
    rights = [bones.rest_point(f.slots.foot) for f in feet if f.slots.limb.startswith("right")]
    if not lefts or not rights:
        return None
    ahead = np.cross(np.mean(lefts, axis=0) - np.mean(rights, axis=0), up)
    return np.asarray(sign * rotation.unit(ahead)) if np.linalg.norm(ahead) > 1e-9 else None


def _ahead(feet: Sequence[Foot], up: np.ndarray, square: np.ndarray | None) -> np.ndarray:
    """Where the rest pose faces: where its feet point, else square to left-right."""
    total = np.zeros(3)
    for foot in feet:
        ankle, _, tip = foot.joints(rest=True)
        run = tip - ankle
        total = total + (run - (run @ up) * up)
    if np.linalg.norm(total) > 0.3 * sum(np.linalg.norm(np.subtract(*f.joints(rest=True)[::2])) for f in feet):
        return rotation.unit(total)
    if square is not None:
        return square
    return np.array([0.0, -1.0, 0.0]) if abs(up[2]) > 0.5 else np.array([0.0, 0.0, 1.0])
