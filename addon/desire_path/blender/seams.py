"""seams.py - where another take may begin at once: between two frames the one before is seen to its end.

    strips and their repeats, cycles, keys that hold --Seams--> frames at which walkers are looked at besides
A take that ends with frame 86 is shown up to its last pose, though frame 86 already shows the next take's first.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..motion import drawn, jumps

NEAR = 0.02  # of a sample: so near to one nothing is looked at besides
ASIDE = 1.0 / 32.0  # of a frame: a take is looked at so near to where it ends and the next begins
SAME = 1e-4  # of a sample: a take that begins so shortly after one is seen by it
MANY = 1000  # a cycle is looked for at the ends of no more rounds to either side


@dataclass(frozen=True)
class Besides:
    """Frames, most of them no whole ones, at which walkers are looked at besides."""

    ends: tuple[float, ...] = ()  # before the first of them and after the last a pose is held
    seams: tuple[float, ...] = ()  # where another take may begin

    def frames(self, first, last, samples):
        """All frames to look at from one to another, rising: so many in each, and those besides."""
        found = [first + k / samples for k in range((last - first) * samples + 1)]
        sides = set(self.ends)
        for at in self.seams:
            if first + ASIDE < at < last - ASIDE:
                sides |= {
                    at - ASIDE,
                    at if _apart(at * samples) or at * samples < round(at * samples) + SAME else at + ASIDE,
                }
        return sorted(found + [at for at in sides if first < at < last and _apart(at * samples)])


NOTHING = Besides()


def _apart(number):
    """Whether a place among samples lies between two."""
    return abs(number - round(number)) > NEAR


def of_strip(strip):
    """Where a strip of the NLA editor begins, begins again and ends, in the animation's time."""
    rounds = np.arange(min(int(np.ceil(strip.repeat)), MANY))
    length = (strip.frame_end - strip.frame_start) / strip.repeat
    inside = [seam for each in getattr(strip, "strips", ()) if not each.mute for seam in of_strip(each)]
    return [*(strip.frame_start + rounds * length).tolist(), strip.frame_end, *inside]


def of_curve(curve, first, last):
    """Where a curve jumps, from a frame of the animation to another one: where its cycle begins again as it did not
    end, and at a key that another one held its value for longer than poses of an animation on twos."""
    keys = curve.keyframe_points
    found = [
        after.co.x
        for key, after in zip(keys, keys[1:])
        if key.interpolation == "CONSTANT" and key.co.y != after.co.y and first < after.co.x < last
    ]
    cycles = [each for each in curve.modifiers if each.type == "CYCLES" and not each.mute]
    if cycles and len(keys) > 1 and keys[0].co.y != keys[-1].co.y:
        start, end = curve.range()
        length = end - start
        if cycles[0].mode_after == "REPEAT":
            found += [end + k * length for k in range(min(int((last - end) / length) + 1, MANY))]
        if cycles[0].mode_before == "REPEAT":
            found += [start - k * length for k in range(min(int((start - first) / length) + 1, MANY))]
    return found


def spread(found, rate):
    """Those of seams (in frames, so many a second) that are no poses of an animation on twos."""
    found = np.unique(np.round(found, 4))
    away = np.diff(found, prepend=-np.inf) > drawn.HELD * rate + 1e-6
    return found[away & np.append(away[1:], True)].tolist()


def closed(gaits, besides):
    """Recordings of walkers at the same times, without the sides of a seam over which none of them jumps: how well one
    take fits the next is not to be told from so short a time."""
    if not besides.seams or not gaits:
        return gaits
    gaits = [jumps.found(gait) for gait in gaits]
    frames = gaits[0].frame(np.arange(len(gaits[0].time)))
    keep = np.ones(len(frames), bool)
    for seam in besides.seams:
        near = np.flatnonzero(abs(frames - seam) < 2.0 * ASIDE)
        if not any(np.isin(gait.cut, near).any() for gait in gaits):
            keep[near[abs(frames[near] - seam) > 0.5 * ASIDE]] = False
    return [_thinned(gait, np.flatnonzero(keep)) for gait in gaits]


def _thinned(gait, keep):
    """A recording of some of its samples, the first of each piece among them."""
    jump = gait.jump.copy()
    jump[:, 0] = np.searchsorted(keep, jump[:, 0])
    return replace(
        gait,
        time=gait.time[keep],
        com=gait.com[:, keep],
        pose=gait.pose[:, keep],
        cut=np.searchsorted(keep, gait.cut),
        jump=jump,
    )
