"""The part of a clip that repeats: found by the feet, closed so that it can go on without end.

    recording ---carried---> moves over the ground ---find---> Cycle

Places are given along the path that the walker takes: s ahead, l to the left, z up [m].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING
from warnings import warn

import numpy as np

from ..arrays import Record
from ..errors import DesirePathError
from ..loads import walker
from ..motion import rotation
from ..motion import size as sizes
from ..motion.gait import Gait
from ..motion.points import point_places

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

RATE = 120.0  # cycles are found at this rate or a finer one [1/s]
IN_PLACE = 0.25  # feet that slide back faster while they are low belong to a clip in place [m/s]
LOW = 0.03  # a foot this near to its lowest place may carry [m]
MIN_SECONDS = 0.3  # of a cycle [s]
MIN_SPEED = 0.1  # who is slower does not walk [m/s]
LOOP = 0.04  # start and end of a clip that loops lie so near to each other [m]
HOLD = 0.05  # feet are held this much before and after they touch [s]
FADE = 0.2  # the body's path is led over the seam within this time [s]


# ---- clips in place ----------------------------------------------------------------------------------


def carried(gait: Gait) -> Gait:
    """The recording with every walker that walks in place carried ahead by its own speed.

    In place means: while a foot is low it slides back, and the body stays. Others are left alone; without
    any in place the recording itself is returned.
    """
    shifts = [_belt(gait, w) for w in range(len(gait.mass))]
    if not any(shift is not None for shift in shifts):
        return gait
    com, pose, warnings = gait.com.copy(), gait.pose.copy(), list(gait.warnings)
    for w, shift in enumerate(shifts):
        if shift is None:
            continue
        since = np.concatenate([gait.time[a:b] - gait.time[a] for a, b in gait.pieces(gait.cuts_of([w]))])
        displacement = since[:, None] * -shift
        com[w, :, :2] += displacement
        pose[gait.limb_walker[gait.part_limb] == w, :, :2] += displacement
        warnings.append(f"{gait.walker_name[w]} walks in place and is carried ahead at {np.hypot(*shift):.2f} m/s.")
    return replace(gait, com=com, pose=pose, warnings=tuple(warnings))


def _belt(gait: Gait, w: int) -> np.ndarray | None:
    """Velocity (2,) [m/s] at which the standing feet of a walker in place slide; None if it moves itself."""
    if len(gait.time) < 5:
        return None
    if (gait.rate() or RATE) < RATE:
        gait = gait.resample(RATE)
    mine = np.flatnonzero(gait.limb_walker[gait.part_limb[gait.point_part]] == w)
    leg = sizes.legs(gait)[w] / sizes.LEG
    at, time, com = point_places(gait)[mine] / leg, gait.time / np.sqrt(leg), gait.com[w] / leg
    rush = np.gradient(at, time, axis=1)
    rush[:, np.r_[gait.cut, gait.cut - 1]] = np.nan
    limb = gait.part_limb[gait.point_part[mine]]
    steps = (np.linalg.norm(rush, axis=2) > walker.STILL).any(axis=0)  # who stands and waits tells nothing
    low_speeds = []
    for each in np.unique(limb):
        rows = np.flatnonzero(limb == each)
        lowest = at[rows, :, 2].argmin(axis=0)
        sample = np.arange(at.shape[1])
        height, speed = at[rows[lowest], sample, 2], rush[rows[lowest], sample]
        low = steps & (height < height.min() + LOW) & (abs(speed[:, 2]) < 0.3 + 0.2 * np.hypot(*speed.T[:2]))
        low_speeds.append(speed[low & np.isfinite(speed[:, 0]), :2])
    seen = np.concatenate(low_speeds)
    if len(seen) < 5:
        return None
    slide = np.median(seen, axis=0)
    near = np.linalg.norm(seen - slide, axis=1)
    pace = float(np.hypot(*slide))
    body = (com[-1, :2] - com[0, :2]) / ((time[-1] - time[0]) * steps.mean())
    if pace < IN_PLACE or np.median(near) > 0.35 * pace or np.hypot(*body) > 0.3 * pace:
        return None
    for _ in range(20):  # to where speeds are densest: a foot that rolls is slower or faster for a while
        weight = np.exp(-0.5 * (np.linalg.norm(seen - slide, axis=1) / (0.06 * pace + 0.02)) ** 2)
        slide = (weight[:, None] * seen).sum(axis=0) / weight.sum()
    return np.asarray(slide * np.sqrt(leg))


# ---- the cycle ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Cycle(Record):
    """One walker's motion that repeats: N samples, over which it comes `length` metres ahead.

    Arrays hold what is left when s ahead grows evenly, so that they repeat exactly.
    """

    gait: Gait  # the recording it is from, with what belongs to its walker
    rate: float  # [1/s]
    length: float  # [m]
    floor: float  # height of the ground the clip walks on [m]
    com: np.ndarray  # (N, 3)
    pose: np.ndarray  # (P, N, 7), turned so that ahead is +x
    stand: np.ndarray  # where each limb stands: still while it touches, led to the next while not (L, N, 2)

    @property
    def seconds(self) -> float:
        """How long it takes [s]."""
        return len(self.com) / self.rate

    @property
    def speed(self) -> float:
        """How fast it goes [m/s]."""
        return self.length / self.seconds

    @property
    def way(self) -> float:
        """An old name of length."""
        warn("way is an old name: ask a Cycle for its length.", DeprecationWarning, stacklevel=2)
        return self.length

    def at(self, phase: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """com (T, 3), pose (P, T, 7), stand (L, T, 2) at phases [cycles]."""
        ahead = self.length * np.asarray(phase, float)
        com, stand = _wrapped(self.com, phase), _wrapped(self.stand, phase)
        pose = np.concatenate(
            [_wrapped(self.pose[..., :3], phase), _wrapped(self.pose[..., 3:], phase, turns=True)], axis=-1
        )
        com[:, 0] += ahead
        pose[..., 0] += ahead
        stand[..., 0] += ahead
        return com, pose, stand


def _wrapped(track: np.ndarray, phase: ArrayLike, turns: bool = False) -> np.ndarray:
    """A repeating track (.., N, c) at phases [cycles], by cubics through its samples; turns: quaternions."""
    count = track.shape[-2]
    place = np.asarray(phase, float) % 1.0 * count
    k = np.floor(place).astype(int)
    u = (place - k)[:, None]
    p0, p1, p2, p3 = (track[..., (k + d) % count, :] for d in (-1, 0, 1, 2))
    if turns:  # q and -q are one turn
        p0, p2, p3 = (q * np.where((q * p1).sum(axis=-1, keepdims=True) < 0, -1.0, 1.0) for q in (p0, p2, p3))
    value: np.ndarray = p1 + 0.5 * u * (p2 - p0 + u * (2 * p0 - 5 * p1 + 4 * p2 - p3 + u * (3 * (p1 - p2) + p3 - p0)))
    return value / np.linalg.norm(value, axis=-1, keepdims=True) if turns else value


def find(gait: Gait) -> Cycle:
    """The Cycle of a recording of one walker; a sentence where it does not walk."""
    name = gait.walker_name[0]
    if len(gait.cut):
        first, after = max(gait.pieces(), key=lambda ends: ends[1] - ends[0])
        gait = gait.piece(first, after)
    gait, loops = _loop(carried(gait))
    rate = gait.rate()
    if rate is None or rate < RATE:
        gait = gait.resample(RATE if rate is None else rate * np.ceil(RATE / rate - 1e-6))
        rate = gait.rate()
    if rate is None or (len(gait.time) - 1) / rate < MIN_SECONDS:
        raise DesirePathError(
            f"The recording of {name} is too short to be carried along a path: record at least one whole stride."
        )
    on, _ = walker.contacts(gait, floor(gait))
    touch = np.array([on[gait.part_limb == limb].any(axis=0) for limb in range(len(gait.limb_walker))])
    first, last = (0, len(gait.time) - 1) if loops else _span(gait, rate, touch)
    if np.hypot(*(gait.com[0, last] - gait.com[0, first])[:2]) < MIN_SPEED * (last - first) / rate:
        raise DesirePathError(
            f"{name} does not walk ahead in its recording and cannot be carried along a "
            "path: record a walk, in place or over the ground."
        )
    return _closed(gait, rate, first, last, touch)


def _drift(gait: Gait) -> tuple[Callable[[int, int], float], np.ndarray]:
    """A function: how far two samples' poses are apart, seen from the body [m]; and the same from each
    sample to the next."""
    shape = np.concatenate([gait.pose[..., :3] - gait.com[0][None], _ahead_axis(gait)], axis=0)
    step = np.linalg.norm(np.diff(shape, axis=1), axis=-1).mean(axis=0)
    return lambda a, b: float(np.linalg.norm(shape[:, b] - shape[:, a], axis=-1).mean()), step


def _loop(gait: Gait) -> tuple[Gait, bool]:
    """(recording, does its last sample repeat its first); one that loops but leaves this sample out gets it."""
    rate = gait.rate()
    drift, step = _drift(gait)
    here = 0.5 * (step[0] + step[-1]) if len(step) > 3 else 0.0  # from sample to sample at the seam
    if rate is None or len(step) < 4 or drift(0, -1) > LOOP + 1.5 * here:
        return gait, False
    if drift(0, -1) < 0.5 * here:
        return gait, True
    count = len(gait.time)
    ahead = (gait.com[0, -1] - gait.com[0, 0]) * (1.0, 1.0, 0.0) * count / (count - 1)
    com = np.concatenate([gait.com, gait.com[:, :1] + ahead], axis=1)
    pose = np.concatenate([gait.pose, gait.pose[:, :1] + np.r_[ahead, np.zeros(4)]], axis=1)
    return replace(gait, time=np.r_[gait.time, gait.time[-1] + 1.0 / rate], com=com, pose=pose), True


def _span(gait: Gait, rate: float, touch: np.ndarray) -> tuple[int, int]:
    """(first, last sample) of the strides that close best; the whole clip without whole strides."""
    drift, _ = _drift(gait)
    best, span = np.inf, (0, len(gait.time) - 1)
    for row in touch:
        downs = (np.flatnonzero(row[1:] & ~row[:-1]) + 1).tolist()
        for i, a in enumerate(downs):
            for b in downs[i + 1 :]:
                if (b - a) / rate < MIN_SECONDS or not all(other[a:b].any() for other in touch if other.any()):
                    continue
                cost = drift(a, b) / (b - a)
                if cost < best:
                    best, span = cost, (a, b)
    return span


def _ahead_axis(gait: Gait) -> np.ndarray:
    """A tenth of each part's forward axis (P, T, 3), so that turns count like places."""
    q = gait.pose[..., 3:]
    w, x, y, z = (q[..., k] for k in range(4))
    return 0.1 * np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=-1)


def floor(gait: Gait) -> float:
    """Height of the ground a clip walks on [m]: where its contact points are at their lowest."""
    return float(np.median(point_places(gait)[..., 2].min(axis=1)))


def _closed(gait: Gait, rate: float, first: int, last: int, touch: np.ndarray) -> Cycle:
    """Close the seam: feet make up what they miss while in the air, the body all the time."""
    count = last - first
    x, y = (gait.com[0, last] - gait.com[0, first])[:2]
    heading, length = np.arctan2(y, x), float(np.hypot(x, y))
    turn = np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])
    origin = gait.com[0, first, :2]
    com, pose = gait.com[0].copy(), gait.pose.copy()
    com[:, :2] = (com[:, :2] - origin) @ turn.T
    pose[..., :2] = (pose[..., :2] - origin) @ turn.T
    pose[..., 3:] = rotation.product(rotation.about_z(-heading), pose[..., 3:])
    share = np.array([_shares(row, rate, first, last) for row in touch])
    body = _led(com, first, last, length, rate)
    parts = _corrected(pose, first, last, length, share[gait.part_limb])
    ahead, middle = length * np.arange(count) / count, body[:, 1].mean()
    for track in (body, parts):
        track[..., 0] -= ahead
        track[..., 1] -= middle
    return _stood(Cycle(gait, rate, length, 0.0, body, parts, np.zeros((len(touch), count, 2))))


def _led(com: np.ndarray, first: int, last: int, length: float, rate: float) -> np.ndarray:
    """The body's path over one cycle, led into the next one without a jump in place or speed."""
    count = last - first
    body = com[first:last].copy()
    over = min(int(FADE * rate), first, count // 2)
    if over > 1:
        u = np.arange(1, over + 1) / (over + 1)
        fade = (u**3 * (10 - 15 * u + 6 * u * u))[:, None]
        body[-over:] += fade * (com[first - over : first] + (length, 0, 0) - body[-over:])
    else:
        body += np.arange(count)[:, None] / count * (com[first] + (length, 0, 0) - com[last])
    return body


def _shares(touch: np.ndarray, rate: float, first: int, last: int) -> np.ndarray:
    """How much of what it misses a limb has made up by each sample (N,): all of it while in the air."""
    hold = int(round(HOLD * rate))
    wide = np.convolve(touch, np.ones(2 * hold + 1), "same") > 0.5
    free = ~wide[first:last]
    if not free.any():
        free = ~touch[first:last]
    if not free.any():
        free[:] = True
    share = np.zeros(last - first)
    total = free.sum()
    edges = np.flatnonzero(np.diff(np.r_[0, free.astype(int), 0]))
    done = 0.0
    for a, b in zip(edges[::2], edges[1::2]):
        u = np.arange(1, b - a + 1) / (b - a)
        share[a:b] = done + (b - a) / total * u * u * (3 - 2 * u)
        done += (b - a) / total
        share[b:] = done
    return share


def _corrected(pose: np.ndarray, first: int, last: int, length: float, share: np.ndarray) -> np.ndarray:
    """Poses over the cycle (P, N, 7) that end where the next cycle begins."""
    parts = pose[:, first:last].copy()
    start, end = pose[:, first], pose[:, last]
    parts[..., :3] += share[..., None] * (start[:, :3] + (length, 0, 0) - end[:, :3])[:, None]
    back = rotation.product(start[:, 3:], rotation.inverse(end[:, 3:]))
    back *= np.where(back[:, :1] < 0, -1.0, 1.0)
    part = np.concatenate(
        [1.0 - share[..., None] * (1.0 - back[:, None, :1]), share[..., None] * back[:, None, 1:]], axis=-1
    )
    part /= np.linalg.norm(part, axis=-1, keepdims=True)
    parts[..., 3:] = rotation.product(part, parts[..., 3:])
    return parts


def _stood(cycle: Cycle) -> Cycle:
    """The cycle with the places where its limbs stand, and its floor."""
    count, gait = len(cycle.com), cycle.gait
    phase = np.arange(-count, 2 * count) / count
    com, pose, _ = cycle.at(phase)
    time = np.arange(3 * count) / cycle.rate
    thrice = replace(gait, time=time, com=com[None], pose=pose, cut=np.empty(0), warnings=())
    level = floor(thrice)
    on, clearance = walker.contacts(thrice, level)
    points = point_places(thrice)[..., :2]
    hold = int(round(HOLD * cycle.rate))
    stand = np.zeros((len(gait.limb_walker), count, 2))
    for limb in range(len(gait.limb_walker)):
        touch = np.asarray(on[gait.part_limb == limb].any(axis=0))
        mean = points[gait.part_limb[gait.point_part] == limb].mean(axis=0)
        stand[limb] = _stands(touch, mean, hold)[count : 2 * count]
    stand[..., 0] -= cycle.length * np.arange(count) / count
    touched = on[gait.point_part].any(axis=1)
    rise = float(np.median(clearance[touched])) if touched.any() else 0.0
    return replace(cycle, stand=stand, floor=level + rise)


def _stands(touch: np.ndarray, mean: np.ndarray, hold: int) -> np.ndarray:
    """Where a limb stands (T, 2): the middle of each contact, led from one to the next in the air."""
    edges = np.flatnonzero(np.diff(np.r_[0, touch.astype(int), 0]))
    spans = list(zip(edges[::2], edges[1::2]))
    if not spans or touch.all():
        return mean
    knots, places = [], []
    for n, (a, b) in enumerate(spans):
        # held a little before and after, but for half of the way to its neighbours at most
        before = min(hold, (a - spans[n - 1][1]) // 3) if n else min(hold, a)
        behind = min(hold, (spans[n + 1][0] - b) // 3) if n + 1 < len(spans) else min(hold, len(touch) - b)
        knots.append((a - before, b - 1 + behind))
        places.append(mean[a:b].mean(axis=0))
    stand = np.empty_like(mean)
    stand[: knots[0][0]], stand[knots[-1][1] :] = places[0], places[-1]
    for n, (a, b) in enumerate(knots):
        stand[a : b + 1] = places[n]
        if n + 1 < len(knots):
            c = knots[n + 1][0]
            u = (np.arange(b, c + 1) - b)[:, None] / max(c - b, 1)
            stand[b : c + 1] = places[n] + (u * u * (3 - 2 * u)) * (places[n + 1] - places[n])
    return stand


def ahead(gait: Gait, walker_row: int = 0) -> np.ndarray | None:
    """Velocity (2,) [m/s] at which a walker that walks in place would go; None if it moves itself, or does not walk."""
    slide = _belt(gait, walker_row)
    return None if slide is None else -slide


def samples_to_loop(gait: Gait) -> int | None:
    """How many samples after its last one a recording of one walker repeats its first: 0 where the last one does,
    None where it does not loop."""
    closed, loops = _loop(gait)
    return len(closed.time) - len(gait.time) if loops else None
