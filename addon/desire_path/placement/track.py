"""Tracks: a drawn curve makes the motion that leaves a row of marks, or a rut, along it. PEYRAT11, MODEL 3.8

    curve + Stamp ---stamped---> Gait of two feet that come down in turn on the marks of marks.lay()
    curve + wheel ---rolled----> Gait of a wheel, of two, or of all those of a vehicle, that roll without slip

What presses weighs something, or goes as deep as it is told (contact law "carve").
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DesirePathError
from ..loads.below import GroundHeights
from ..motion import rotation
from ..motion.gait import AUTO, HEEL, Gait, Sole
from . import tyre
from .marks import LONGEST, SIDES, Drive, Marks, depth_of, lay, mass_of, number_of, path_of, rate_of, speeds_of
from .pace import Land, Pace, ahead_of, land_of, left_of, slope_of
from .stamps import Stamp
from .vehicle import Axle, Vehicle

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

MAX_SAMPLES = 10_000_000  # of its motion
STANDS = 0.6  # of the time from mark to mark a foot is down before its mark's own time, and after it
RISES = 0.2  # .. of it, it takes to come straight down, and up again
LIFT = 0.25  # feet are carried so high, in legs
SAMPLES = 30.0  # from mark to mark, at least
ROLLS = math.radians(3.0)  # a wheel turns from sample to sample, at most
COMES_DOWN = 0.5  # time a wheel that is told its depth takes to come down, and up at the end [s]
TALL = 1.1  # mass centres are so high over the feet, in legs


@dataclass(frozen=True)
class Wheel:
    """What rolls."""

    radius: float = 0.33  # [m] > 0
    width: float = 0.2  # of the tyre [m] > 0
    tread: str = "blocks"  # one of tyre.TYRES
    gauge: float = 0.0  # between the middles of a left and a right wheel [m]; 0: one wheel

    def plain(self) -> Wheel:
        """The same without a tread."""
        return replace(self, tread="plain")

    def vehicle(self) -> Vehicle:
        """One axle of it."""
        number_of("gauge", self.gauge, 0.0, LONGEST)
        return Vehicle((Axle(0.0, self.radius, self.width, self.tread, self.gauge),))


def stamped(
    curve: ArrayLike,
    stamp: str | Stamp = "boot",
    marks: Marks = Marks(),
    drive: Drive = Drive(),
    ground: GroundHeights = None,
) -> Gait:
    """The motion of two feet that press the marks of lay(), one after the other, from which they rise straight."""
    laid_marks = lay(curve, stamp, marks, drive, ground)
    stamp, t, depth, sizes = laid_marks.stamp, laid_marks.time, laid_marks.depth, laid_marks.size
    pace, leg = laid_marks.pace, laid_marks.stamp.leg * laid_marks.times
    gap = np.diff(t) if len(t) > 1 else np.array([laid_marks.gap])
    before, after = np.r_[gap[:1], gap], np.r_[gap, gap[-1:]]
    free = 0.0 if depth == 0.0 else 1.0 - STANDS  # who weighs something stands from the first moment to the last
    ends = -(STANDS + free) * before[0], t[-1] + (STANDS + free) * after[-1]
    time = _samples(*ends, SAMPLES / gap.min(), drive)
    feet = _Feet(
        begin=t - STANDS * before,
        end=t + STANDS * after,
        at=laid_marks.pressed_at(),
        turn=rotation.quaternion(laid_marks.turn),
        ahead=laid_marks.turn[:, :, 0],
        speed=pace.start,
        lift=LIFT * leg + depth,
        rise=RISES * float(gap.min()),
    )
    kinds = sorted({*zip(laid_marks.left.tolist(), sizes.tolist())}, reverse=True)
    com, _ = laid_marks.path.at(pace.place(time))
    high = np.interp(time, t, laid_marks.at[:, 2]) + TALL * leg
    names = [SIDES[not left] + (f" {each:.3g}" if marks.scatter else "") for left, each in kinds]
    mine = [np.flatnonzero((laid_marks.left == left) & (sizes == each)) for left, each in kinds]
    return _gait(
        drive,
        time,
        np.column_stack([com, high])[None],
        np.stack([feet.pose(time, each) for each in mine]),
        [stamp.sole(left, each) for left, each in kinds],
        _Who(laid_marks.mass, names, [leg]),
    )


def rolled(
    curve: ArrayLike, wheel: Wheel | Vehicle = Wheel(), drive: Drive = Drive(), ground: GroundHeights = None
) -> Gait:
    """A wheel, a left and a right one, or all those of a vehicle, upright along a curve (n, 2 or 3) [m] without slip:
    each turns by the length of its path over its radius. What they weigh is shared, between axles as the vehicle says.

    ground: as for stamped(). The foremost axle goes from the curve's start to its end; what lies behind it comes
    straight from before the start. Wheels that are told their depth come down at the start and are lifted at the end.
    """
    path = path_of(curve)
    vehicle = wheel if isinstance(wheel, Vehicle) else wheel.vehicle()
    shapes = [tyre.wheel(axle.radius, axle.width, axle.tread) for axle in vehicle.axles]
    pace = Pace(path.length, *speeds_of(drive, vehicle.speed))
    depth, land = depth_of(drive), land_of(ground)
    least = min(axle.radius for axle in vehicle.axles)
    if not depth < least:
        raise DesirePathError(
            f"A wheel of radius {least:g} m cannot roll {depth:g} m deep: give it less depth, or more radius."
        )
    duration, wait = float(pace.time(path.length)), COMES_DOWN if depth > 0.0 else 0.0
    wide = max(axle.gauge for axle in vehicle.axles)
    turns = max(pace.start, pace.end) * (1.0 + wide * abs(path.bend).max()) / least
    time = _samples(-wait, duration + wait, max(turns / ROLLS, 24.0), drive)
    s = pace.place(np.clip(time, 0.0, duration) if wait else time)
    above = np.clip(np.maximum(-time, time - duration) / COMES_DOWN, 0.0, 1.0) * (2.0 * depth) - depth
    mass = mass_of(drive, vehicle.mass) / sum(axle.share for axle in vehicle.axles)
    gaits = []
    for number, (axle, (place, heading)) in enumerate(zip(vehicle.axles, vehicle.steer(path, s)), 1):
        sides = axle.sides()
        for side, aside in sides:
            pose = _wheel_pose(land, place + aside * left_of(heading), heading, axle.radius, above)
            name = f"axle {number} {side}".strip() if len(vehicle.axles) > 1 else side or "wheel"
            who = _Who(mass * axle.share / len(sides), [name], [])
            vertices, triangles = shapes[number - 1]
            gaits.append(_gait(drive, time, pose[None, :, :3], pose[None], [Sole(vertices, triangles)], who))
    return Gait.join(gaits)


def _wheel_pose(land: Land, at: np.ndarray, heading: np.ndarray, radius: float, above: np.ndarray) -> np.ndarray:
    """Poses (T, 7) of a wheel at places (T, 2) that has rolled as far as it has gone along its headings."""
    high, slope = slope_of(land, at, 0.1 * radius)
    z = high + radius * np.sqrt(1.0 + (slope**2).sum(axis=1)) + above
    own = np.r_[0.0, np.cumsum((np.diff(at, axis=0) * ahead_of(0.5 * (heading[1:] + heading[:-1]))).sum(axis=1))]
    return np.column_stack([at, z, _rolling(heading, own / radius)])


def _samples(first: float, last: float, rate: float, drive: Drive) -> np.ndarray:
    """Times from the first to the last at a whole number a frame, `rate` a second at least [s]."""
    rate = rate_of(drive) * math.ceil(rate / drive.frame_rate)
    count = (last - first) * rate + 1.0
    if count > MAX_SAMPLES:
        raise DesirePathError(
            f"This track would take {count:.0f} samples, and {MAX_SAMPLES} are the most: shorten the curve, go "
            "faster, or on larger wheels."
        )
    return first + np.arange(math.ceil(count)) / rate


# ---- feet and wheels ------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Feet:
    """When and where marks are pressed, of all feet."""

    begin: np.ndarray  # a foot is down from here (n,) [s] ..
    end: np.ndarray  # .. to here
    at: np.ndarray  # where it is then (n, 3) [m]
    turn: np.ndarray  # quaternions (n, 4)
    ahead: np.ndarray  # direction in which it goes (n, 3)
    speed: float  # of who goes there [m/s]
    lift: float  # in between it is so much higher [m]
    rise: float  # in this time it comes straight up, or down [s]

    def pose(self, time: np.ndarray, own: np.ndarray) -> np.ndarray:
        """Poses (T, 7) of the foot whose marks these are (m,), rising."""
        begun = np.searchsorted(self.begin[own], time, side="right")
        last, following = own[np.maximum(begun - 1, 0)], own[np.minimum(begun, len(own) - 1)]
        since = np.where(begun > 0, time - self.end[last], np.inf)  # less than 0 while it stands
        until = np.where(begun < len(own), self.begin[following] - time, np.inf)
        up = _smooth(np.minimum(since, until) / self.rise)
        lone = np.isinf(since) | np.isinf(until)  # before its first mark, and after its last, it goes along
        share = (begun == 0).astype(float)
        free = np.maximum(since + until - 2.0 * self.rise, 1e-9)
        np.divide(since - self.rise, free, out=share, where=~lone)
        share = np.clip(share, 0.0, 1.0)[:, None]
        at = (1.0 - share) * self.at[last] + share * self.at[following]
        beyond = np.where(lone, np.maximum(np.minimum(since, until) - self.rise, 0.0), 0.0)
        at += (np.where(begun == 0, -beyond, beyond) * self.speed)[:, None] * self.ahead[last]
        at[:, 2] += self.lift * up
        same = np.sign((self.turn[last] * self.turn[following]).sum(axis=1))[:, None]
        turn = (1.0 - share) * self.turn[last] + share * same * self.turn[following]
        return np.column_stack([at, turn / np.linalg.norm(turn, axis=1)[:, None]])


@dataclass(frozen=True)
class _Who:
    mass: float
    names: Sequence[str]
    leg: Sequence[float]


def _gait(drive: Drive, time: np.ndarray, com: np.ndarray, pose: np.ndarray, soles: Sequence[Sole], who: _Who) -> Gait:
    """One walker, each of whose limbs is a part."""
    points = [_corners(each) if who.leg else tyre.touching(np.asarray(each.vertices, float)) for each in soles]
    parts = np.arange(len(soles))
    return Gait(
        time=time - time[0],
        com=com,
        mass=np.array([who.mass]),
        pose=pose,
        limb_walker=np.zeros(len(soles), int),
        part_limb=parts,
        soles=tuple(soles),
        point=np.concatenate(points),
        point_part=np.repeat(parts, [len(each) for each in points]),
        point_role=np.full(sum(map(len, points)), HEEL),
        limb_name=tuple(f"{drive.name} {name}" for name in who.names),
        part_name=("body",) * len(soles),
        walker_name=(drive.name if len(soles) > 1 else f"{drive.name} {who.names[0]}",),
        frame_rate=drive.frame_rate,
        frame_start=drive.frame_start,
        contact_law=("carve" if drive.depth is not None else AUTO,),
        leg=np.array(who.leg),
    ).check()


def _corners(sole: Sole) -> np.ndarray:
    """The places a stamp touches with first, all round (k, 3)."""
    angle = np.arange(12) * (np.pi / 6.0)
    toward = np.stack([np.cos(angle), np.sin(angle), np.full(12, -3.0)], axis=1)
    return np.asarray(sole.vertices[np.unique((sole.vertices @ toward.T).argmax(axis=0))], float)


def _rolling(heading: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Quaternions (n, 4) of what has rolled ahead by angles, about the y of its heading."""
    cz, sz, cy, sy = np.cos(heading / 2.0), np.sin(heading / 2.0), np.cos(angle / 2.0), np.sin(angle / 2.0)
    return np.stack([cz * cy, -sz * sy, cz * sy, sz * cy], axis=1)


def _smooth(x: np.ndarray) -> np.ndarray:
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x * x * (3.0 - 2.0 * x))
