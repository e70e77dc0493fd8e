"""From bones that moved to a Gait: mass centre, contact parts, soles, contact points. MODEL 3.5

Skeleton, Motion, Skin ---rigs.detect---> Rig ---gait_from_bones---> Gait
"""

from dataclasses import dataclass

import numpy as np

from ..errors import DesirePathError
from ..motion import freeze, jumps, rotation, stays
from ..motion import size as sizes
from ..motion.gait import Gait
from . import foot as feet_of
from . import rigs, slope

LEAST_SPAN = 0.005  # of a walker's joints [m]
LEG_OF_TOP = 0.55  # hips over the ankles in shares of the highest joint's height over them; Winter, figure 4.1


@dataclass(frozen=True)
class Skeleton:
    names: tuple
    parents: np.ndarray  # (B,) i4, -1 for roots
    rest: np.ndarray  # bone to armature, +Y along the bone (B, 4, 4) [m]
    length: np.ndarray  # (B,) [m]
    mirrored: bool = False  # its left is on its right, by a negative scale


@dataclass(frozen=True)
class Motion:
    time: np.ndarray  # (T,) [s]
    bones: tuple
    matrix: np.ndarray  # bone to world, rotation free of scale (T, B', 4, 4) [m]


@dataclass(frozen=True)
class Skin:
    vertices: np.ndarray  # rest pose, in the skeleton's rest space (V, 3) [m]
    triangles: np.ndarray  # (F, 3)
    weights: dict  # bone name -> (V,) f4


class _Bones:
    """Looks up what was sampled, by bone name."""

    def __init__(self, skeleton, motion):
        self.row = {n: i for i, n in enumerate(skeleton.names)}
        self.column = {n: i for i, n in enumerate(motion.bones)}
        self.rest = np.asarray(skeleton.rest, float)
        self.length = np.asarray(skeleton.length, float)
        self.matrix = np.asarray(motion.matrix, float)
        self.turns = {}

    def point(self, name, along=0.0):
        m = self.matrix[:, self.column[name]]
        return m[:, :3, 3] + m[:, :3, 1] * (along * self.length[self.row[name]])

    def turn(self, name):
        if name not in self.turns:
            self.turns[name] = rotation.square(self.matrix[:, self.column[name], :3, :3])
        return self.turns[name]

    def rest_point(self, name, along=0.0):
        m = self.rest[self.row[name]]
        return m[:3, 3] + m[:3, 1] * (along * self.length[self.row[name]])

    def mean(self, points, rest=False):
        at = self.rest_point if rest else self.point
        return np.mean([at(n, a) for n, a in points], axis=0)


# ---- checks ----------------------------------------------------------------------------------------------


def _check(skeleton, motion, rig, mass, frame_rate, frame_start):
    count = len(skeleton.names)
    if np.shape(skeleton.rest) != (count, 4, 4) or np.shape(skeleton.length) != (count,):
        raise DesirePathError("The skeleton's rest matrices do not fit its bones: record again.")
    time = np.asarray(motion.time, float)
    if not len(time):
        raise DesirePathError("The recording has no frames: choose a frame range in which the character walks.")
    span = max(np.ptp(np.asarray(skeleton.rest, float)[:, :3, 3], axis=0).max(), np.max(skeleton.length))
    if span < LEAST_SPAN:
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


def leg_length(bones, rig, up):
    """Hips to ankles in the rest pose [m]; where hips tell none by what is above the feet, else by the feet."""
    ankles = np.array([bones.rest_point(f.foot) for f in rig.feet]) @ up
    top = float((bones.rest[:, :3, 3] @ up).max() - ankles.mean())
    leg = float(bones.rest_point(rig.hips) @ up - np.median(ankles)) if rig.hips else 0.0
    if leg > 0.1 * top:
        return leg
    foot = float(np.median([bones.length[bones.row[f.foot]] for f in rig.feet]))
    return LEG_OF_TOP * top if top > 0.1 * foot else foot / feet_of.GUESS[0]


def stretched_leg(bones, rig, leg):
    """From hip joint to ankle along the bones of a leg [m]; as given where a foot has none."""
    if not all(f.thigh for f in rig.feet):
        return leg
    joints = [[bones.rest_point(name) for name in (f.thigh, f.shank, f.foot) if name] for f in rig.feet]
    return float(np.mean([np.linalg.norm(np.diff(each, axis=0), axis=1).sum() for each in joints]))


def mass_centre(bones, rig, leg):
    """(T, 3): the segments' centres weighted by their masses; the hips bone without segments, else over the feet."""
    if not rig.segments:
        if rig.hips:
            return bones.point(rig.hips).copy()
        return np.mean([bones.point(f.foot) for f in rig.feet], axis=0) + (0.0, 0.0, leg)
    total = sum(s.mass for s in rig.segments)
    com = 0.0
    ahead = _facing(bones, rig) if any(s.knee for s in rig.segments) else None
    for segment in rig.segments:
        start = bones.mean(segment.start)
        end = bones.mean(segment.end) if segment.end else start
        if segment.knee:
            knee = _knee(bones, segment, start, end, ahead)
            start, end = (start, knee) if segment.knee == "above" else (knee, end)
        at = start + segment.along * (end - start)
        at[:, 2] += segment.lift
        com = com + segment.mass / total * at
    return com


def _facing(bones, rig):
    """The way two feet point between them, level (T, 3); zero where they do not or are not two."""
    way = 0.0
    for foot in rig.feet:
        ahead = bones.point(foot.toe) if foot.toe else bones.point(foot.foot, 1.0)
        way = way + (ahead - bones.point(foot.foot)) * (1.0, 1.0, 0.0)
    return way * (len(rig.feet) == 2)


def _knee(bones, leg, hip, ankle, ahead):
    """Where the knee is that a leg has no bone for (T, 3).

    A leg is as long as in the rest pose, halved by its knee (Winter, figure 4.1: 0.245 and 0.246 of the
    height): an ankle nearer to the hip than that bends it ahead, the way the feet point.
    """
    half = np.linalg.norm(bones.mean(leg.end, rest=True) - bones.mean(leg.start, rest=True)) / 2.0
    down = ankle - hip
    reach = np.linalg.norm(down, axis=1, keepdims=True)
    down = down / np.maximum(reach, 1e-9)
    ahead = ahead - (ahead * down).sum(axis=1, keepdims=True) * down
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    return (hip + ankle) / 2.0 + np.sqrt(np.maximum(half**2 - reach**2 / 4.0, 0.0)) * ahead


def rest_up(bones, rig):
    """The axis of rest space that points up: the one nearest to feet-to-hips, of many feet that of their legs."""
    feet = np.mean([bones.rest_point(f.foot) for f in rig.feet], axis=0)
    high = bones.rest_point(rig.hips) - feet if rig.hips else np.array([0.0, 0.0, 1.0])
    if len(rig.feet) > 2 and all(f.thigh for f in rig.feet):  # their hips lie at one end of the body
        high = np.mean([bones.rest_point(f.thigh) for f in rig.feet], axis=0) - feet
    up = np.zeros(3)
    axis = int(np.argmax(abs(high))) if np.linalg.norm(high) > 0 else 2
    up[axis] = np.sign(high[axis]) or 1.0
    return up


# ---- the door --------------------------------------------------------------------------------------------------


def gait_from_bones(
    skeleton,
    motion,
    *,
    mass,
    name="Walker",
    rig=None,
    skin=None,
    tread=None,
    frame_rate,
    frame_start=1,
    land=None,
    shapes=None,
):
    """What the walker did, from sampled bones. Refuses bad recordings with a sentence.

    Soles: the tread (a Tread), else the skin's underside, else built in. land: the ground it walks on, a
    Simulation: feet that lie on its slopes have soles that do; None: level ground. shapes: FootShape by foot
    bone, of feet that were placed on the ground and tell no more how they lie flat.
    """
    rig = rig or rigs.detect(skeleton)
    _check(skeleton, motion, rig, mass, frame_rate, frame_start)
    bones = _Bones(skeleton, motion)
    time = np.asarray(motion.time, float)
    warnings = list(rig.warnings)
    up_rest = rest_up(bones, rig)
    leg = leg_length(bones, rig, up_rest)
    com = mass_centre(bones, rig, leg)
    leaps = jumps.between(time, com, np.array([bones.point(f.foot) for f in rig.feet]), frame_rate, time[0])
    cut = [sample for a, b, _ in leaps for sample in range(a + 1, b + 1)]
    warnings += jumps.sentences(name, [(*(frame_start + time[[a, b]] * frame_rate), size) for a, b, size in leaps])
    bones.tell = ~jumps.alone(len(time), cut)
    own_leg = stretched_leg(bones, rig, leg)
    clip = time, com
    time, com, bones, again, rests = _moving(skeleton, motion, rig, bones, time, com, cut, own_leg / sizes.LEG)
    ankles = np.array([bones.rest_point(f.foot) for f in rig.feet])
    person = len(rig.feet) == 2 and bool(rig.hips)
    shapes = shapes or {}
    feet = [feet_of.Foot(bones, f, leg, person, shapes.get(f.foot), len(rig.feet) > 2) for f in rig.feet]
    square = _square(bones, feet, up_rest, -1.0 if skeleton.mirrored else 1.0)
    held = stays.still(com, time, own_leg / sizes.LEG)
    held &= ~np.all([foot.low(~held) for foot in feet], axis=0)  # who stands on all feet shows them flat
    held |= rests
    for foot in feet:
        foot.held, foot.size = held, own_leg / sizes.LEG
        if person and square is not None:
            foot.face(square, up_rest)
    ahead_rest = _ahead(feet, up_rest, square)
    left_axis = np.cross(up_rest, ahead_rest)
    middle = ankles.mean(axis=0) @ left_axis
    to_left = ankles @ left_axis - middle
    named = np.array([f.slots.limb.startswith("left") * 1.0 - f.slots.limb.startswith("right") for f in feet])
    mirrored = named @ to_left < 0.0  # the object is: what is called left stands on the right
    sided = -named if mirrored else named
    lefts = (sided > 0.0) | ((sided == 0.0) & (to_left > 0.0))
    laid = None
    if tread is not None:
        laid = feet_of.lay_tread(bones, feet, lefts, tread, time, up_rest, ahead_rest)
        warnings += laid.warnings
    hills = slope.below(land, feet, time, up_rest, bool(shapes) or None) if land is not None else [None] * len(feet)
    poses, soles, points, part_limb, point_part, point_role = [], [], [], [], [], []
    for limb, foot in enumerate(feet):
        hill = hills[limb]
        if hill is not None:
            flat = hill.flattened(bones, (foot.slots.foot, foot.slots.toe))
            foot = foot.over(flat)
        pose, sole_pair, marks = feet_of.parts(
            foot.bones, foot, time, up_rest, ahead_rest, lefts[limb], skin, skeleton, laid, warnings
        )
        if hill is not None:
            pose = [hill.back(each) for each in pose]
        first = len(poses)
        poses += pose
        soles += sole_pair
        part_limb += [limb, limb]
        for part, role, at in marks:
            points.append(at)
            point_part.append(first + part)
            point_role.append(role)
    time, com = clip
    return Gait(
        time=time,
        com=com[None],
        mass=np.array([mass]),
        pose=np.array(poses)[:, again],
        limb_walker=np.zeros(len(feet)),
        part_limb=part_limb,
        soles=soles,
        point=np.array(points),
        point_part=point_part,
        point_role=point_role,
        limb_name=[f.foot for f in rig.feet],
        part_name=["heel", "toe"] * len(feet),
        walker_name=[name],
        frame_rate=frame_rate,
        frame_start=frame_start,
        warnings=warnings,
        cut=cut,
        jump=[(sample, 0) for sample in cut],
        leg=[own_leg],
    ).check()


def _moving(skeleton, motion, rig, bones, time, com, cut, size):
    """The clip without the poses that are held in mid-step: what they interrupt is one motion.

    (times, mass centre, bones, the sample of theirs for each of the clip, which of them hold a pose at rest)
    """
    poses = [(bones.point(name), bones.turn(name)) for name in rig.bones]
    held, rests = [], np.zeros(len(time), bool)
    for first, after in zip([0, *cut], [*cut, len(time)]):
        piece = time[first:after], com[first:after], [(at[first:after], turn[first:after]) for at, turn in poses], size
        held += [(first + a, first + b) for a, b in freeze.stops(*piece)]
        for a, b in freeze.stops(*piece, rests=True):
            rests[first + a + 1 : first + b + 1] = True
    keep = freeze.kept(len(time), held)
    if held:
        tell, bones = (
            bones.tell[keep],
            _Bones(skeleton, Motion(time[keep], motion.bones, np.asarray(motion.matrix)[keep])),
        )
        bones.tell = tell
    again = np.searchsorted(keep, np.arange(len(time)), side="right") - 1
    return freeze.closed(time, held)[keep], com[keep], bones, again, rests[keep]


def _square(bones, feet, up, sign):
    """The way a body faces whose left feet are to its left, as they are named; None where they are not."""
    lefts = [bones.rest_point(f.slots.foot) for f in feet if f.slots.limb.startswith("left")]
    rights = [bones.rest_point(f.slots.foot) for f in feet if f.slots.limb.startswith("right")]
    if not lefts or not rights:
        return None
    ahead = np.cross(np.mean(lefts, axis=0) - np.mean(rights, axis=0), up)
    return sign * rotation.unit(ahead) if np.linalg.norm(ahead) > 1e-9 else None


def _ahead(feet, up, square):
    """The way the rest pose faces: where its feet point, else square to left-right."""
    way = np.zeros(3)
    for foot in feet:
        ankle, _, tip = foot.joints(rest=True)
        run = tip - ankle
        way = way + (run - (run @ up) * up)
    if np.linalg.norm(way) > 0.3 * sum(np.linalg.norm(np.subtract(*f.joints(rest=True)[::2])) for f in feet):
        return rotation.unit(way)
    if square is not None:
        return square
    return np.array([0.0, -1.0, 0.0]) if abs(up[2]) > 0.5 else np.array([0.0, 0.0, 1.0])
