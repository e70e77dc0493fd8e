"""A pose that is held in mid-step: time stands still for the walker, and its motion goes on as if it had not. MODEL 3.4

    recording with holds ---without---> the motion itself ---loads---> ---fill---> holds get what they interrupted

A body that walks cannot stop at once. Where a clip shows that, since its last pose is held to the end of a shot
or a pose waits for its turn, nothing is to be learnt from the stop; a body that comes to rest is no such case.

A pose that is held may jitter, as a recording does, and may drift as no eye sees. That is told from slow motion by how
the body came to it: from a walk's speed to none between one frame and the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias, TypeVar

import numpy as np

from . import size as sizes
from . import stays
from .recording import Recording

SAME = 2e-6  # a pose that is held moves no more than this from one sample to the next, in legs of a person [m]
STRAY = 1e-4  # and no more than this in all [m]
JITTERS = 0.05  # what comes and goes in less than this is noise [s]
NOISE = 1e-3  # a pose that is held jitters by no more, its standard deviation [m]
DRIFT = 2e-3  # and goes no farther than this, but for what noise leaves in means over HELD [m]
TURNS = 0.02  # nor turns farther than this [rad]
BEFORE = 0.04  # a body's speed beside a hold is taken over this [s]
WALKS = 0.15  # who walks is faster [m/s]

Held: TypeAlias = tuple[tuple[int, int], ...]  # first and last sample of each hold
R = TypeVar("R", bound=Recording)


def frozen(gait: Recording, walker: int, size: float) -> Held:
    """(first, last) sample of every hold of one walker that is no rest; the poses from first to last are one.

    size: its leg in those of a grown person.
    """
    if (gait.limb_walker == walker).sum() < 2:
        return ()
    parts = np.flatnonzero(gait.limb_walker[gait.part_limb] == walker)
    return stops(gait.time, gait.com[walker], [(gait.pose[p, :, :3], gait.pose[p, :, 3:]) for p in parts], size)


def stops(
    time: np.ndarray, com: np.ndarray, poses: Sequence[tuple[np.ndarray, np.ndarray]], size: float, rests: bool = False
) -> Held:
    """frozen() of a body by its mass centre (T, 3) and (places (T, 3), turns (T, ..)) of what it consists of.

    rests: those in which it does rest count, too.
    """
    if len(time) < 4:
        return ()
    found = _exact(time, com, poses, size)
    if rests:
        return tuple(each for each in found if time[each[1]] - time[each[0]] > stays.HELD * np.sqrt(size) - 1e-9)
    found = [each for each in found if _is_moving(time, com, *each, size)]
    jitters = [each for each in _jittery(time, com, poses, size) if _is_moving(time, com, *each, size)]
    apart = [(a, b) for a, b in jitters if not any(first < b and a < last for first, last in found)]
    return tuple(sorted(found + apart))


def _exact(
    time: np.ndarray, com: np.ndarray, poses: Sequence[tuple[np.ndarray, np.ndarray]], size: float
) -> list[tuple[int, int]]:
    """(first, last) sample of stretches over which nothing moves."""
    same = abs(np.diff(com, axis=0)).max(axis=1) < SAME * size
    if not same.any():
        return []
    for at, turn in poses:
        same &= abs(np.diff(at, axis=0)).max(axis=1) < SAME * size
        same &= abs(np.diff(turn.reshape(len(time), -1), axis=0)).max(axis=1) < SAME
    found = []
    for first, last in _runs(same):
        inside = first > 0 and last < len(time) - 1  # at the ends of a clip any is one, however short
        if inside and time[last] - time[first] < stays.HELD * np.sqrt(size) - 1e-9:
            continue
        if max(np.ptp(at[first : last + 1], axis=0).max() for at, _ in poses) < STRAY * size:
            found.append((first, last))
    return found


def _jittery(
    time: np.ndarray, com: np.ndarray, poses: Sequence[tuple[np.ndarray, np.ndarray]], size: float
) -> list[tuple[int, int]]:
    """(first, last) sample of stretches over which nothing moves but by noise."""
    min_time = stays.HELD * np.sqrt(size)
    rate = (len(time) - 1) / (time[-1] - time[0])
    lag, wide = max(1, int(JITTERS * np.sqrt(size) * rate + 1e-6)), int(min_time * rate + 1e-6)
    if len(time) <= max(lag, wide):
        return []
    max_step = 4.0 * np.sqrt(2.0) * NOISE * size
    slow = abs(com[lag:] - com[:-lag]).max(axis=1) < max_step
    for at, turn in poses if slow.any() else ():
        turn = turn.reshape(len(time), -1)
        slow &= abs(at[lag:] - at[:-lag]).max(axis=1) < max_step
        slow &= abs(turn[lag:] - turn[:-lag]).max(axis=1) < TURNS
    found = []
    for first, last in _runs(slow):
        last = min(last + lag - 1, len(time) - 1)
        if time[last] - time[first] < min_time - 1e-9:
            continue
        stretch = slice(first, last + 1)
        places = np.concatenate([com[stretch], *(at[stretch] for at, _ in poses)], axis=1)
        noise = np.median(abs(places[lag:] - places[:-lag]), axis=0) / 0.954  # of what is normal, 0.954 sigma
        stray = abs(places - np.median(places, axis=0))
        inside = np.flatnonzero((stray < 6.0 * noise + DRIFT / 2.0 * size).all(axis=1))
        if not len(inside):
            continue
        first, last = first + int(inside[0]), first + int(inside[-1])
        places = places[inside[0] : inside[-1] + 1]
        if len(inside) < len(places) or time[last] - time[first] < min_time - 1e-9 or noise.max() > NOISE * size:
            continue
        sums = np.cumsum(np.concatenate([np.zeros((1, places.shape[1])), places - places[0]]), axis=0)
        means = (sums[wide:] - sums[:-wide]) / wide
        if (np.ptp(means, axis=0) < DRIFT * size + 9.0 * noise * np.sqrt(lag / wide)).all():
            found.append((first, last))
    return found


def _runs(mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """(first, after) of the runs of a mask, which also are the first and last samples of runs of steps."""
    edge = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype("i1"), [0]])))
    return zip(edge[::2].tolist(), edge[1::2].tolist())


def _is_moving(time: np.ndarray, com: np.ndarray, first: int, last: int, size: float) -> bool:
    """Did the body walk up to a hold, or does it from there on?"""
    span, pace = BEFORE * np.sqrt(size), WALKS * np.sqrt(size)
    before, after = (
        np.searchsorted(time, time[first] - span + 1e-9) - 1,
        np.searchsorted(time, time[last] + span - 1e-9),
    )
    speed = []
    if before >= 0:
        speed.append((com[first] - com[before]) / (time[first] - time[before]))
    if after < len(time):
        speed.append((com[after] - com[last]) / (time[after] - time[last]))
    if any(np.hypot(*v[:2]) > pace for v in speed):
        return True
    # in the air, too: what goes on as it came was stopped by nothing
    return (
        len(speed) == 2
        and np.linalg.norm(speed[0]) > pace
        and (np.linalg.norm(speed[0] - speed[1]) < 0.5 * np.linalg.norm(speed[0]))
    )


def holds(gait: Recording) -> list[Held]:
    """The holds of each walker (W)."""
    return [frozen(gait, w, leg / sizes.LEG) for w, leg in enumerate(sizes.legs(gait))]


def kept(count: int, held: Held) -> np.ndarray:
    """Samples that are left of `count` without the holds: their first ones stand for them."""
    keep = np.ones(count, bool)
    for first, last in held:
        keep[first + 1 : last + 1] = False
    return np.flatnonzero(keep)


def without(gait: R, held: Held) -> R:
    """The recording without its holds, its time closed over them."""
    keep = kept(len(gait.time), held)
    return replace(gait, time=closed(gait.time, held)[keep], com=gait.com[:, keep], pose=gait.pose[:, keep])


def closed(time: np.ndarray, held: Held) -> np.ndarray:
    """Times (T,) as they are without the holds in between."""
    step = np.diff(time, prepend=time[0])
    for first, last in held:
        step[first + 1 : last + 1] = 0.0
    return np.asarray(time[0] + np.cumsum(step))


def resampled(gait: R, rate: float, held: Sequence[Held]) -> R:
    """The recording at an even rate, of walkers whose time stands still; held: holds() of it.

    A hold lasts a round number of samples, so that what it interrupts goes on at the pace it had: a step that is part
    motion and part hold would be a stop.
    """
    plain = gait.evenly(rate)
    com, pose = plain.com.copy(), plain.pose.copy()
    owner = gait.limb_walker[gait.part_limb]
    for walker, mine in enumerate(held):
        if not mine:
            continue
        own = gait.only([walker])
        went = np.interp(plain.time, gait.time, closed(gait.time, mine)) - gait.time[0]
        moves = without(own, mine).evenly(rate)
        pick = np.minimum(np.round(went * rate).astype(int), len(moves.time) - 1)
        com[walker], pose[owner == walker] = moves.com[0, pick], moves.pose[:, pick]
    return replace(plain, com=com, pose=pose)
