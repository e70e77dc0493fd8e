"""A pose that is held in mid-step: time stands still for the walker, and its motion goes on as if it had not.

    recording with holds ---without---> the motion itself ---loads---> ---fill---> holds get what they interrupted

A body that walks cannot stop at once. Where a clip shows that, since its last pose is held to the end of a shot
or a pose waits for its turn, nothing is to be learnt from the stop; a body that comes to rest is no such case.
"""

from dataclasses import replace

import numpy as np

from . import size as sizes
from . import stays

SAME = 2e-6  # a pose that is held moves no more than this from one sample to the next, in legs of a person [m]
STRAY = 1e-4  # and no more than this in all [m]
BEFORE = 0.04  # a body's speed beside a hold is taken over this [s]
WALKS = 0.15  # who walks is faster [m/s]


def frozen(gait, walker, size):
    """(first, last) sample of every hold of one walker that is no rest; the poses from first to last are one.

    size: its leg in those of a grown person.
    """
    if (gait.limb_walker == walker).sum() < 2:
        return ()
    parts = np.flatnonzero(gait.limb_walker[gait.part_limb] == walker)
    return stops(gait.time, gait.com[walker], [(gait.pose[p, :, :3], gait.pose[p, :, 3:]) for p in parts], size)


def stops(time, com, poses, size, rests=False):
    """frozen() of a body by its mass centre (T, 3) and (places (T, 3), turns (T, ..)) of what it consists of.

    rests: those in which it does rest count, too.
    """
    if len(time) < 4:
        return ()
    same = abs(np.diff(com, axis=0)).max(axis=1) < SAME * size
    if not same.any():
        return ()
    for at, turn in poses:
        same &= abs(np.diff(at, axis=0)).max(axis=1) < SAME * size
        same &= abs(np.diff(turn.reshape(len(time), -1), axis=0)).max(axis=1) < SAME
    edge = np.flatnonzero(np.diff(np.concatenate([[0], same.astype("i1"), [0]])))
    found = []
    for first, last in zip(edge[::2].tolist(), edge[1::2].tolist()):
        if time[last] - time[first] < stays.HELD * np.sqrt(size) - 1e-9:
            continue
        stray = max(np.ptp(at[first : last + 1], axis=0).max() for at, _ in poses)
        if stray < STRAY * size and (rests or _under_way(time, com, first, last, size)):
            found.append((first, last))
    return tuple(found)


def _under_way(time, com, first, last, size):
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


def holds(gait):
    """The holds of each walker (W)."""
    return [frozen(gait, w, leg / sizes.LEG) for w, leg in enumerate(sizes.legs(gait))]


def kept(count, held):
    """Samples that are left of `count` without the holds: their first ones stand for them."""
    keep = np.ones(count, bool)
    for first, last in held:
        keep[first + 1 : last + 1] = False
    return np.flatnonzero(keep)


def without(gait, held):
    """The recording without its holds, its time closed over them."""
    keep = kept(len(gait.time), held)
    return replace(gait, time=closed(gait.time, held)[keep], com=gait.com[:, keep], pose=gait.pose[:, keep])


def closed(time, held):
    """Times (T,) as they are without the holds in between."""
    step = np.diff(time, prepend=time[0])
    for first, last in held:
        step[first + 1 : last + 1] = 0.0
    return time[0] + np.cumsum(step)


def resampled(gait, rate, held):
    """The recording at an even rate, of walkers whose time stands still; held: holds() of it."""
    plain = gait.evenly(rate)
    com, pose = plain.com.copy(), plain.pose.copy()
    owner = gait.limb_walker[gait.part_limb]
    for walker, mine in enumerate(held):
        if not mine:
            continue
        own = gait.only([walker])
        went = np.interp(plain.time, gait.time, closed(gait.time, mine)) - gait.time[0]
        whole = abs(went * rate - np.round(went * rate)).max() < 1e-3
        fine = 1 if whole else 8  # holds that are no whole number of samples long
        moves = without(own, mine).evenly(rate * fine)
        pick = np.minimum(np.round(went * rate * fine).astype(int), len(moves.time) - 1)
        com[walker], pose[owner == walker] = moves.com[0, pick], moves.pose[:, pick]
    return replace(plain, com=com, pose=pose)
