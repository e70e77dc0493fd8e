"""seams.py - where another take may begin at once: between two frames the one before is seen to its end.

    strips and their repeats, cycles, keys that hold --Seams--> frames at which walkers are looked at besides
A take that ends with frame 86 is shown up to its last pose, though frame 86 already shows the next take's first. A
round that begins between two frames has its keys there, too: they are looked at, as those of the first round were.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..motion import drawn, jumps
from . import compat

NEAR = 0.02  # of a sample: so near to one nothing is looked at besides
ASIDE = 1.0 / 32.0  # of a frame: a take is looked at so near to where it ends and the next begins
SAME = 1e-4  # of a sample: a take that begins so shortly after one is seen by it
AFTER = 2.0 * SAME  # of a frame: a curve shows the end of a round there, not the next one yet
MANY = 1000  # a cycle is looked for at the ends of no more rounds to either side
FINE = 2  # of more keys in a frame than this Subframes say how many are seen


@dataclass(frozen=True)
class Besides:
    """Frames, most of them no whole ones, at which walkers are looked at besides."""

    ends: tuple[float, ...] = ()  # before the first of them and after the last a pose is held
    seams: tuple[float, ...] = ()  # where another take may begin
    keys: tuple[float, ...] = ()  # poses are keyed there; none where all are at whole frames
    alone: bool = False  # and nothing else moves who is looked at

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
        sides = np.array(sorted(at for at in sides if first < at < last))
        keys = np.array([at for at in self.keys if first <= at <= last])
        found = _between_keys(np.array(found), keys, samples) if self.alone else np.array(found)
        found = np.union1d(found, _far(sides, found, NEAR / samples))
        return np.union1d(found, _far(keys, found, NEAR / samples)).tolist()


NOTHING = Besides()


def _between_keys(grid, keys, samples):
    """Those of even samples that tell more than keys do: none between two keys that lie less than two samples apart."""
    at = np.searchsorted(keys, grid)
    inside = np.flatnonzero((at > 0) & (at < len(keys)))
    before, after = keys[at[inside] - 1], keys[at[inside]]
    keyed = np.minimum(grid[inside] - before, after - grid[inside]) < SAME
    return np.delete(grid, inside[~keyed & (after - before < 2.0 / samples)])


def _far(keys, found, near):
    """Keys that lie farther than this from all that is found, each of them once."""
    at = np.searchsorted(found, keys)
    before, after = found[np.maximum(at - 1, 0)], found[np.minimum(at, len(found) - 1)]
    keys = keys[np.minimum(abs(keys - before), abs(after - keys)) > near]
    return keys[np.diff(keys, prepend=-np.inf) > near]


def _apart(number):
    """Whether a place among samples lies between two."""
    return abs(number - np.round(number)) > NEAR


def of_strip(strip):
    """Where a strip of the NLA editor begins, begins again and ends, in the animation's time."""
    rounds = np.arange(min(int(np.ceil(strip.repeat)), MANY))
    length = (strip.frame_end - strip.frame_start) / strip.repeat
    inside = [seam for each in getattr(strip, "strips", ()) if not each.mute for seam in of_strip(each)]
    return [*(strip.frame_start + rounds * length).tolist(), strip.frame_end, *inside]


def keys_of_strip(strip):
    """Frames, in the animation's time, at which a strip shows the keys of its action; those of one that has its time by
    a curve are not known."""
    found = [each for inner in getattr(strip, "strips", ()) if not inner.mute for each in keys_of_strip(inner)]
    if strip.action is None or strip.use_animated_time:
        return found
    rounds = np.arange(min(int(np.ceil(strip.repeat)), MANY))
    length = (strip.frame_end - strip.frame_start) / strip.repeat
    first, last = strip.action_frame_start, strip.action_frame_end
    for at in _once(compat.strip_curves(strip)):
        at = at[(first <= at) & (at <= last)]
        since = strip.scale * (last - at if strip.use_reverse else at - first)
        found.append((strip.frame_start + rounds[:, None] * length + since).ravel())
    return found


def keys_of_curves(curves, first, last):
    """Frames of the animation at which curves have their keys, and have them again while they are cycled."""
    found, cycled = list(_once(curves)), {}
    for curve in curves:
        cycles = [each for each in curve.modifiers if each.type == "CYCLES" and not each.mute]
        if cycles and len(curve.keyframe_points) > 1:
            at, modes = _keys(curve), (cycles[0].mode_after, cycles[0].mode_before)
            cycled[at.tobytes(), modes] = at, modes
    for at, modes in cycled.values():
        length, back = at[-1] - at[0], at[0] + at[-1] - at
        after = np.arange(1, min(int(max(last - at[-1], 0.0) / length) + 2, MANY))
        before = np.arange(1, min(int(max(at[0] - first, 0.0) / length) + 2, MANY))
        for mode, rounds in zip(modes, (after, -before)):
            found += [k * length + (back if mode == "MIRROR" and k % 2 else at) for k in rounds if mode != "NONE"]
    return found


def _once(curves):
    """Frames of the keys of curves, as they are in their action; curves that are keyed alike count once."""
    return {at.tobytes(): at for at in map(_keys, curves)}.values()


def _keys(curve):
    at = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", at)
    return at[::2].astype(np.float64)


def together(found, slow, first, last):
    """Frames of the timeline of all keys, rising, each once; none where every one lies at a whole frame, or where so
    many lie in a frame that Subframes has to say how many are seen. slow: clock.stretch()"""
    at = np.unique(np.round(np.concatenate([np.empty(0), *found]) * slow, 4))
    at = at[(first <= at) & (at <= last)]
    return tuple(at.tolist()) if 0 < _apart(at).sum() <= FINE * (last - first) else ()


def of_curve(curve, first, last):
    """Where a curve jumps, from a frame of the animation to another one: where its cycle begins again as it did not
    end, and at a key that another one held its value for longer than poses of an animation on twos."""
    keys = curve.keyframe_points
    found = _steps(curve, first, last)
    cycles = [each for each in curve.modifiers if each.type == "CYCLES" and not each.mute]
    if cycles and len(keys) > 1 and keys[0].co.y != keys[-1].co.y:
        start, end = curve.range()
        length = end - start
        if cycles[0].mode_after == "REPEAT":
            found += [end + k * length + AFTER for k in range(min(int((last - end) / length) + 1, MANY))]
        if cycles[0].mode_before == "REPEAT":
            found += [start - k * length + AFTER for k in range(min(int((start - first) / length) + 1, MANY))]
    return found


def _steps(curve, first, last):
    """Where a curve that was held goes on from another value."""
    keys = curve.keyframe_points
    held = compat.held(keys)[:-1]
    if not held.any():
        return []
    co = np.empty(2 * len(keys), np.float32)
    keys.foreach_get("co", co)
    at, value = co[2::2], co[1::2]
    return at[held & (value[1:] != value[:-1]) & (first < at) & (at < last)].tolist()


def spread(found, rate):
    """Those of seams (in frames, so many a second) that are no poses of an animation on twos."""
    found = np.asarray(found, float)
    found = np.unique(np.where(_apart(found), np.ceil(found * 1e4) * 1e-4, np.round(found, 4)))  # none too early
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
