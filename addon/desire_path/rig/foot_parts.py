"""The two parts of one foot over time: their poses, their soles, and the points by which they touch. MODEL 3.5

Foot, its FootShape ---skin, tread or built in---> poses, soles, points
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..arrays import Record
from ..motion import rotation, stays
from ..motion.gait import BALL, HEEL, TIP, Sole
from . import rig_names, sole
from . import sole_mesh as treads
from .foot import BALL_PAD, Foot, FootShape
from .skeleton import SampledBones, Skeleton, Skin
from .sole import Faces

Mark: TypeAlias = tuple[int, int, tuple[float, float, float]]  # part 0 or 1, role, where [m]


@dataclass(frozen=True, eq=False, repr=False)
class RestPose(Record):
    """A character at rest, by which soles are laid under its feet."""

    skeleton: Skeleton
    up: np.ndarray  # in rest space (3,)
    ahead: np.ndarray  # direction in which it faces there (3,)
    skin: Skin | None = None  # what soles are cut from
    laid: treads.Laid | None = None  # else what is laid under them
    tread: str = "plain"  # of soles that are built in, one of TREADS


def _level_toe(turn: np.ndarray, ball: np.ndarray, low: float) -> np.ndarray:
    """Turn of a toe part without a bone of its own: level until the ball has left the ground.

    turn (T, 3, 3) of the heel part, ball (T,) height of the ball over its resting height [m]; `low`
    [m] is the height over which the toes follow the foot again. TRAIL (2) gives it thus.
    """
    forward = turn[:, :, 0]
    level = rotation.frame(forward, (0.0, 0.0, 1.0))
    steep = np.hypot(forward[:, 0], forward[:, 1]) < 0.2
    level[steep] = turn[steep]
    bend = np.clip(-forward[:, 2], 0.0, None) > 0.0  # heel above ball
    lift = np.clip((ball - 0.3 * low) / (0.7 * low), 0.0, 1.0)
    follow = np.where(bend, lift * lift * (3 - 2 * lift), 1.0)
    mixed = level + follow[:, None, None] * (turn - level)
    return rotation.square(mixed)


def parts(
    foot: Foot, bones: SampledBones, time: np.ndarray, left: bool, at_rest: RestPose
) -> tuple[list[np.ndarray], tuple[Sole, Sole], list[Mark], list[str]]:
    """(poses, soles, contact points of the two parts of one foot, warnings)."""
    skin, laid, warnings = at_rest.skin, at_rest.laid, list[str]()
    at_foot = laid is not None and laid.at_foot
    shape, flat = foot.shape(time, at_rest.up, at_rest.ahead, skin is not None or at_foot)
    if skin is None and not at_foot and not flat.any() and len(time) > 2:
        warnings.append(f"{foot.slots.foot} never stands flat: its sole was laid by the rest pose.")
    soles = None
    if skin is not None:
        soles = _skin_soles(bones, foot, shape, skin, at_rest.skeleton)
        if soles is None and laid is None:
            warnings.append(f"No faces of the mesh move with {foot.slots.foot}: it got the built-in sole.")
    if laid is not None:
        soles, below = treads.soles(laid, left, shape.ball)
        if at_foot:  # as thick as it was modelled
            shape.ball_height += below - shape.ankle_height
            shape.ankle_height = below
    heel_turn = bones.turn(foot.slots.foot) @ shape.foot_turn
    ankle, ball, _ = foot.joints()
    heel_at = ankle - heel_turn[:, :, 2] * shape.ankle_height
    ball_in_foot = np.array([shape.ball, 0.0, 0.0])
    if foot.toe and shape.toe_turn is not None and foot.bends():
        toe_turn = bones.turn(foot.toe) @ shape.toe_turn
        toe_at = ball - toe_turn @ np.array([0.0, shape.ball_side, shape.ball_height])
    else:
        under = heel_at + heel_turn @ ball_in_foot
        rest_height = (
            stays.median(under[:, 2], stays.votes(flat, time, foot.size, bones.cut))
            if flat.any()
            else np.quantile(under[bones.tell, 2], 0.05)
        )
        low = 0.25 * (shape.tip - shape.heel)
        toe_turn = _level_toe(heel_turn, under[:, 2] - rest_height, low)
        toe_at = under
    heel_x, tip_x = shape.heel, shape.tip
    if soles is None:
        soles = sole.built_in(shape.heel, shape.ball, shape.tip, left, at_rest.tread)
    else:
        heel_x = float(soles[0].vertices[:, 0].min())
        tip_x = shape.ball + float(soles[1].vertices[:, 0].max())
    length = tip_x - heel_x
    toe_length = tip_x - shape.ball
    points: list[Mark] = [
        (0, HEEL, (heel_x + 0.09 * length, 0.0, 0.0)),
        (0, BALL, (shape.ball - BALL_PAD * length, 0.0, 0.0)),
        (1, BALL, (0.0, 0.0, 0.0)),
        (1, TIP, (toe_length - 0.04 * length, 0.0, 0.0)),
    ]
    poses = [
        np.concatenate([at, rotation.quaternion(turn)], axis=1)
        for at, turn in ((heel_at, heel_turn), (toe_at, toe_turn))
    ]
    return poses, soles, points, warnings


def _to_frame(bones: SampledBones, foot: Foot, shape: FootShape) -> np.ndarray:
    """Rest space to the frame of a flat foot, its ankle at the origin (4, 4)."""
    turn = rotation.square(bones.rest[bones.row[foot.slots.foot], :3, :3]) @ shape.foot_turn
    out = np.eye(4)
    out[:3, :3] = turn.T
    out[:3, 3] = -turn.T @ foot.joints(rest=True)[0]
    return out


def lay_tread(
    tread: treads.Tread, feet: Sequence[Foot], lefts: Sequence[bool], time: np.ndarray, at_rest: RestPose
) -> treads.Laid:
    """The tread under one foot of the rest pose, left feet asked first."""
    places = []
    for foot, left in sorted(zip(feet, lefts), key=lambda each: not each[1]):
        shape, _ = foot.shape(time, at_rest.up, at_rest.ahead, True)
        places.append((_to_frame(foot.bones, foot, shape), shape.heel, shape.tip, left))
    return treads.lay(tread, places, at_rest.up, at_rest.ahead)


def _skin_soles(
    bones: SampledBones, foot: Foot, shape: FootShape, skin: Skin, skeleton: Skeleton
) -> tuple[Sole, Sole] | None:
    """Soles from the rest pose's skin, laid so that its lowest vertex is at z = 0; None if none."""
    parents = [int(p) for p in skeleton.parents]

    def family(name: str, stop: Collection[str]) -> set[str]:
        """A bone and those that hang on it, but for what hangs on `stop`."""
        row, found = bones.row[name], set()
        for b, other in enumerate(skeleton.names):
            up = b
            while up >= 0 and up != row and skeleton.names[up] not in stop:
                up = parents[up]
            if up == row:
                found.add(other)
        return found

    toe_family = family(foot.toe, ()) if foot.toe else set()
    foot_family = family(foot.slots.foot, ()) - toe_family
    if foot.slots.heel and foot.slots.heel not in toe_family:  # need not hang on the foot
        foot_family.add(foot.slots.heel)
    if foot.toe:  # small toes beside the chosen one
        for name in list(foot_family):
            if name != foot.slots.foot and rig_names.is_toe(name):
                foot_family.discard(name)
                toe_family.add(name)
    to_frame = _to_frame(bones, foot, shape)
    heel, toe = sole.from_skin(skin, foot_family, toe_family, to_frame, 0.0)
    if heel is None:
        return None
    if toe is None:  # no toe bone, or none that moves faces: split at the ball
        vertices, triangles = heel
        ahead = vertices[triangles, 0].mean(axis=1) > shape.ball
        heel, toe = _pick(vertices, triangles[~ahead]), _pick(vertices, triangles[ahead])
        if heel is None or toe is None:
            return None
    floor = float(min(heel[0][:, 2].min(), toe[0][:, 2].min()))
    shape.ball_height += -floor - shape.ankle_height
    shape.ankle_height = -floor
    return Sole(heel[0] - (0.0, 0.0, floor), heel[1]), Sole(toe[0] - (shape.ball, 0.0, floor), toe[1])


def _pick(vertices: np.ndarray, triangles: np.ndarray) -> Faces | None:
    """Some faces of a mesh with their vertices alone; None without any."""
    if not len(triangles):
        return None
    used, packed = np.unique(triangles, return_inverse=True)
    return vertices[used], packed.reshape(-1, 3).astype("i4")
