"""One foot: where its heel, ball and tip are while it stands flat, its two parts and their soles.

bones of a foot ---flat samples of the clip, or the rest pose---> FootShape ---> poses, soles, points
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace

import numpy as np

from ..errors import DesirePathError
from ..motion import rotation, stays
from ..motion import size as sizes
from .rigs import Foot as Slots
from .skeleton import SampledBones

HEEL_BEHIND = 0.17  # the heel lies this share of ankle-to-tip behind the ankle, on the ground
HEEL_FAR = 0.6  # a heel bone farther behind than this share of ankle-to-tip is none
ANKLE_HEIGHT = 0.039 / 0.152  # ankle over the sole, in foot lengths; Winter, figure 4.1
TOE_SHARE = (0.25, 0.75)  # plausible ball-to-tip in shares of ankle-to-ball; else TOE_GUESS
TOE_GUESS = 0.42
FOOT_OF_LEG = 0.285  # foot length in shares of hips bone to ankle: 0.152 of 0.53 statures, Winter, Fig. 4.1
SHORT_FOOT = 0.85  # a person's foot is no shorter than this share of that; toe bones that end early are
FOOT_TO_LEG = 0.22  # a foot bone longer than this share of the leg ends at the tip, not at the ball
ASTRAY = np.radians(75.0)  # a toe bone that points this far off ankle-to-ball says nothing of where toes end
LONG = 2.0  # nor does one longer than this many times ankle-to-ball
SIDEWAYS = np.cos(np.radians(70.0))  # a last bone that points so far off where the body faces tells no foot
FAR_TAIL = 0.6  # nor does one longer than this share of the leg
GUESS = (0.17, 0.06)  # ankle to ball where nothing tells: ahead and down, in shares of the leg
PAW = 0.6  # a foot of many that goes down by this share of ankle-to-ball stands on its toes alone
PAW_PAD = 0.3  # such a foot presses this share of the toes' length behind the ball
PAW_SKIN = 0.06  # the paw's sole lies this share of its length under its lowest joint
BALL_PAD = 0.06  # the ball presses this share of the foot behind its joint
STIFF = np.radians(3.0)  # a toe bone that turns less than this against its foot never bends
FLAT_SPEED = 0.25  # a grown person's flat foot moves slower than this [m/s]
FLAT_RISE = 0.12  # rises and falls slower [m/s]
FLAT_TURN = 1.0  # and turns slower [rad/s]
LOW = 0.10  # it is low within this of its lowest, in shares of the leg
DOWN = 0.03  # and stands within this
ENOUGH = 3  # samples of a foot that stands, in one piece of a clip
HEEL_DOWN = 0.03  # its heel is down when the ankle is no more than this over its usual height over the ball


@dataclass(eq=False)
class FootShape:
    """One foot, flat on the ground: where its joints are in the foot's frame, and the bones' turns."""

    ball: float  # x of the ball joint [m]
    tip: float  # x of the tip of the toes [m]
    heel: float  # x of the heel's end [m]
    ankle_height: float  # z of the ankle [m]
    ball_height: float  # z of the ball joint [m]
    foot_turn: np.ndarray  # foot frame in the foot bone (3, 3)
    toe_turn: np.ndarray | None  # toe frame in the toe bone (3, 3)
    ball_side: float  # y of the ball joint [m]


class Foot:
    """The bones of one foot over the clip."""

    def __init__(
        self,
        bones: SampledBones,
        foot: Slots,
        leg: float,
        person: bool,
        known: FootShape | None = None,
        multipod: bool = False,
    ) -> None:
        self.bones, self.slots = bones, foot
        self.multipod = multipod  # walks on more than two legs
        self.known = known  # its FootShape, where the clip need not tell
        length = bones.length[bones.row[foot.foot]]
        self.toe = foot.toe
        if length <= 1e-6 * max(leg, 1e-9):
            raise DesirePathError(f"Bone {foot.foot} has no length: give it one in edit mode.")
        if self.toe:
            apart = np.linalg.norm(bones.rest_point(self.toe) - bones.rest_point(foot.foot))
            if apart <= 1e-4 * max(leg, 1e-9):
                raise DesirePathError(
                    f"Bone {foot.foot} has no length up to {self.toe}: choose another toe bone or none."
                )
        self.leg = leg
        self.size = leg / sizes.LEG  # its leg in those of a grown person
        self.held: np.ndarray | None = (
            None  # samples at which the body keeps its pose: what other ones tell goes before them (T,)
        )
        self.person = person  # walks on two legs below its hips
        self.assumed: np.ndarray | None = (
            None  # ball and tip seen from the ankle in the foot bone's axes, where the bone tells nothing
        )
        self.ahead = None if multipod else self._ahead()
        self.tip: str | None = None  # a far "toe" bone: its head is the tip
        if not multipod and self._far():
            self.tip, self.toe = self.toe, None
        self.ends_at_tip = not self.toe and bool(self.tip or length > FOOT_TO_LEG * leg > 0)

    def over(self, bones: SampledBones) -> Foot:
        """The same foot, of bones that were moved."""
        other = copy.copy(self)
        other.bones = bones
        return other

    def face(self, ahead: np.ndarray, up: np.ndarray) -> None:
        """Make up a foot that points ahead where its only bone points to one side, or far away."""
        bones, name = self.bones, self.slots.foot
        axis = bones.rest_point(name, 1.0) - bones.rest_point(name)
        length, level = np.linalg.norm(axis), axis - (axis @ up) * up
        aside = abs(level @ ahead) < SIDEWAYS * np.linalg.norm(level) and np.linalg.norm(level) > 0.3 * length
        if self.slots.toe or not (aside or length > FAR_TAIL * self.leg):
            return
        ball = self.leg * (GUESS[0] * ahead - GUESS[1] * up)
        tip = ball + self.leg * TOE_GUESS * GUESS[0] * ahead
        self.assumed = np.stack([ball, tip]) @ rotation.square(bones.rest[bones.row[name], :3, :3])
        self.ends_at_tip = False

    def _ahead(self) -> np.ndarray | None:
        """Where the toes end, from the ball in the toe bone's axes, where its tail does not tell; else None."""
        if not self.toe:
            return None
        ankle, ball = self.bones.rest_point(self.slots.foot), self.bones.rest_point(self.toe)
        run, toe = ball - ankle, self.bones.rest_point(self.toe, 1.0) - ball
        run_length, toe_length = np.linalg.norm(run), np.linalg.norm(toe)
        if toe_length < LONG * run_length and run @ toe > np.cos(ASTRAY) * run_length * toe_length:
            return None
        return np.asarray(rotation.square(self.bones.rest[self.bones.row[self.toe], :3, :3]).T @ (TOE_GUESS * run))

    def _far(self) -> bool:
        """Does a short toe bone begin so far from the ankle that it must be where the toes end?"""
        if not self.toe:
            return False
        ankle, ball = self.bones.rest_point(self.slots.foot), self.bones.rest_point(self.toe)
        tip = self.bones.rest_point(self.toe, 1.0)
        run = float(np.linalg.norm(ball - ankle))
        return run > FOOT_TO_LEG * self.leg > 0 and bool(np.linalg.norm(tip - ball) < 0.35 * run)

    def joints(self, rest: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """ankle, ball, tip: (T, 3) each, or (3,) in the rest pose."""
        at = self.bones.rest_point if rest else self.bones.point
        foot, toe = self.slots.foot, self.toe
        ankle, tail = at(foot), at(foot, 1.0)
        if self.assumed is not None:
            turn = rotation.square(self.bones.rest[self.bones.row[foot], :3, :3]) if rest else self.bones.turn(foot)
            return ankle, ankle + turn @ self.assumed[0], ankle + turn @ self.assumed[1]
        if toe and self.ahead is not None:
            turn = rotation.square(self.bones.rest[self.bones.row[toe], :3, :3]) if rest else self.bones.turn(toe)
            return ankle, at(toe), at(toe) + turn @ self.ahead
        if toe:
            return ankle, at(toe), at(toe, 1.0)
        if self.ends_at_tip:
            share = 1.0 / (1.0 + TOE_GUESS)
            tail = at(self.tip) if self.tip else tail
            return ankle, ankle + share * (tail - ankle), tail
        return ankle, tail, tail + TOE_GUESS * (tail - ankle)

    def bends(self) -> bool:
        """Does the toe bone turn against the foot bone at all?"""
        if not self.toe:
            return False
        between = np.swapaxes(self.bones.turn(self.slots.foot), 1, 2) @ self.bones.turn(self.toe)
        apart = np.einsum("tij,ij->t", between, between[0])
        return bool(np.arccos(np.clip((apart.min() - 1) / 2, -1, 1)) > STIFF)

    def low(self, seen: np.ndarray) -> np.ndarray:
        """Where ankle and ball are as low as where they stand in the samples of a mask, if it has any (T,)."""
        return self._height(seen if seen.any() else ~seen) < DOWN * self.leg

    def _height(self, seen: np.ndarray) -> np.ndarray:
        """Of ankle and ball over their lowest places in the samples of a mask, the greater (T,)."""
        return np.asarray(np.maximum(*(joint[:, 2] - np.quantile(joint[seen, 2], 0.02) for joint in self.joints()[:2])))

    def flat(self, time: np.ndarray) -> np.ndarray:
        """Samples at which the foot stands flat: low or slow, neither rising nor turning.

        A pose that is held in mid-step says least of that, since a foot in the air is as still in it as one that
        stands: where the rest of the clip shows the foot flat, what is held is left out.
        """
        if len(time) < 3:
            return np.zeros(len(time), bool)
        tell, cut = self.bones.tell, self.bones.cut
        if self.held is not None and self.held.any():
            flat = self._flat(time, tell & ~self.held)
            if stays.votes(flat, time, self.size, cut).sum() >= stays.VOTE * np.sqrt(self.size):
                return flat
        return self._flat(time, tell)

    def _flat(self, time: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """flat() of the samples in a mask.

        A runner's foot is hardly ever still: where too little is found, up to four times as much goes. How often a walk
        is repeated tells nothing.
        """
        cut = self.bones.cut
        ankle, ball, _ = self.joints()
        pace = np.sqrt(self.size)
        v_ankle, v_ball = rotation.rate_of(ankle, time, cut) / pace, rotation.rate_of(ball, time, cut) / pace
        turn = self.bones.turn(self.slots.foot)
        spin = np.linalg.norm(rotation.rate_of(turn, time, cut), axis=(1, 2)) / np.sqrt(2.0) * pace
        speed = np.maximum(np.linalg.norm(v_ankle, axis=1), np.linalg.norm(v_ball, axis=1))
        rise = np.maximum(abs(v_ankle[:, 2]), abs(v_ball[:, 2]))
        low = self._height(seen) < LOW * self.leg
        over_ball = ankle[:, 2] - ball[:, 2]
        for more in (1.0, 2.0, 4.0):
            slow = (speed < more * FLAT_SPEED) | (low & (rise < more * 0.5 * FLAT_RISE))
            flat = seen & slow & (rise < more * FLAT_RISE) & (spin < more * FLAT_TURN)
            if more > 1.0:
                flat &= low
            if flat.any():  # of those, the ones with the heel down
                usual = stays.median(over_ball, stays.votes(flat, time, self.size, cut))
                flat &= over_ball < usual + HEEL_DOWN * self.leg
            if max(np.add.reduceat(flat, [0, *cut], dtype=int)) >= ENOUGH:
                return np.asarray(flat)
        return np.zeros(len(time), bool)

    def _heel(self, foot_turn: np.ndarray, frame: np.ndarray, weight: np.ndarray, heel_x: float, tip_x: float) -> float:
        """x of the heel's end: a heel bone tells it, where it lies behind the ankle."""
        if not self.slots.heel:
            return heel_x
        bones, foot = self.bones, self.slots.foot
        rest = rotation.square(bones.rest[bones.row[foot], :3, :3])
        turn = rotation.mean_turn(np.swapaxes(foot_turn, 1, 2) @ frame, weight)
        ends = [
            turn.T @ rest.T @ (bones.rest_point(self.slots.heel, along) - bones.rest_point(foot))
            for along in (0.0, 1.0)
        ]
        behind = min(end[0] for end in ends)
        return behind if -HEEL_FAR * tip_x < behind < 0.0 else heel_x

    def shape(
        self, time: np.ndarray, up_rest: np.ndarray, ahead_rest: np.ndarray, skinned: bool
    ) -> tuple[FootShape, np.ndarray]:
        """Joints in the flat foot, from the clip itself, else from the rest pose."""
        flat, cut = self.flat(time), self.bones.cut
        if self.known is not None and not skinned:
            return replace(self.known), flat
        if skinned or not flat.any():
            ankle, ball, tip = (j[None] for j in self.joints(rest=True))
            row = self.bones.row
            foot_turn = rotation.square(self.bones.rest[row[self.slots.foot], :3, :3])[None]
            toe_turn = rotation.square(self.bones.rest[row[self.toe], :3, :3])[None] if self.toe else None
            up, weight = up_rest, np.ones(1)
            ahead: np.ndarray | None = ahead_rest
        else:
            weight = stays.votes(flat, time, self.size, cut)[flat]
            ankle, ball, tip = (j[flat] for j in self.joints())
            foot_turn = self.bones.turn(self.slots.foot)[flat]
            toe_turn = self.bones.turn(self.toe)[flat] if self.toe else None
            up, ahead = np.array([0.0, 0.0, 1.0]), None
        forward = tip - ankle
        across = forward - (forward @ up)[:, None] * up
        if stays.median(np.linalg.norm(across, axis=1) / np.linalg.norm(forward, axis=1), weight) < 0.3:
            if ahead is None:  # the foot bone stands upright: face as in the rest pose
                rest = rotation.square(self.bones.rest[self.bones.row[self.slots.foot], :3, :3])
                ahead = foot_turn @ (rest.T @ ahead_rest)
            across = np.broadcast_to(ahead, forward.shape)
        frame = rotation.frame(across, up)

        def inside(p: np.ndarray) -> np.ndarray:
            return stays.median(np.einsum("tji,tj->ti", frame, p - ankle), weight)

        ball_in, tip_in = inside(ball), inside(tip)

        def mean(turn: np.ndarray) -> np.ndarray:
            return rotation.mean_turn(np.swapaxes(turn, 1, 2) @ frame, weight)

        foot_in = mean(foot_turn)
        toe_in = None if toe_turn is None else mean(toe_turn)
        if self.multipod and self.toe and -ball_in[2] > PAW * np.linalg.norm(ball_in):
            return self._paw(ball_in, tip_in, foot_in, toe_in), flat
        ball_x = ball_in[0]
        if ball_x < 0.02 * self.leg:  # an upright foot bone tells nothing of the foot's length
            ball_x = 0.17 * self.leg
        toes = tip_in[0] - ball_x
        if not TOE_SHARE[0] * ball_x <= toes <= TOE_SHARE[1] * ball_x:
            toes = TOE_GUESS * ball_x
        tip_x = ball_x + toes
        heel_x = -HEEL_BEHIND * tip_x
        length = tip_x - heel_x
        if self.person and not skinned and length < SHORT_FOOT * FOOT_OF_LEG * self.leg:
            more = FOOT_OF_LEG * self.leg - length  # joints tell where it bends, not where it ends
            tip_x, heel_x = tip_x + 0.55 * more, heel_x - 0.45 * more
            length += more
        if not skinned:
            heel_x = self._heel(foot_turn, frame, weight, heel_x, tip_x)
        # the sole lies under the lowest joint, the ankle no lower over it than in people
        ankle_height = max(ANKLE_HEIGHT * length, -ball_in[2] + 0.06 * length)
        return FootShape(
            ball_x, tip_x, heel_x, ankle_height, ankle_height + ball_in[2], foot_in, toe_in, ball_in[1]
        ), flat

    def _paw(self, ball: np.ndarray, tip: np.ndarray, foot_turn: np.ndarray, toe_turn: np.ndarray | None) -> FootShape:
        """The shape of a foot on its toes: its heel is in the air, what presses lies around the ball and ahead."""
        toes = max(tip[0] - ball[0], 0.03 * self.leg)
        heel, end = ball[0] - PAW_PAD * toes, ball[0] + toes
        height = -min(ball[2], tip[2]) + PAW_SKIN * (end - heel)
        return FootShape(ball[0], end, heel, height, height + ball[2], foot_turn, toe_turn, ball[1])
