"""A clip's cycle carried along a path, pass after pass: what makes a trail. MODEL 3.6

Every limb moves with the place it stands on. While it touches, that place is still, so a foot is set down on
the curve as it was in the clip and does not slide, in bends too; in the air it is led to the next place.
"""

import math
from dataclasses import replace
from statistics import NormalDist

import numpy as np

from ..errors import DesirePathError
from ..ground.sim import Ground, Simulation
from ..motion import rotation, size
from ..motion.gait import Gait
from ..motion.tracks import TrackArray
from . import place as placing
from .cycle import find
from .path import Path

RATE = 60.0  # at least so many samples a second [1/s]
MOST_SAMPLES = 20_000_000  # of all parts together
SWING = (6.0, 14.0)  # walkers weave from side to side over such lengths [m]
WEAVE = 0.6  # of the lateral scatter is weaving, the rest stays for a pass
SMOOTH = 0.4  # the body follows the ground smoothed over about this length [m]
FOOT = 0.12  # the slope under a foot is taken over this much to either side [m]
# steps that fill a box of five dimensions evenly, x^6 = x + 1: few passes are spread as well as many
EVEN = 1.1347241384015194 ** -np.arange(1.0, 6.0)
GRAVITY = 9.81


def along(
    gait, path, passes=1, *, back_and_forth=True, lateral=0.1, timing=0.05, stride=0.05, seed=0, pause=0.0, ground=None
):
    """The walkers of a recording carried along a path as often as wanted: a Gait with a cut at each pass.

    path: waypoints (n, 2 or 3) [m], or a Path; its height is the ground's where it has one.
    back_and_forth: every other pass goes back; else all go one way.
    lateral: how far passes scatter to the side, standard deviation [m]; timing, stride: by how much their
    pace and the length of their strides differ, standard deviation as a share. The first pass scatters in
    nothing; the others are the same for the same seed, however many follow.
    pause: time between passes [s]. ground: what is walked on, a Ground or a Simulation of one: feet are placed on its
    slopes, TRAIL (1) (2); or a function of points (n, 2) -> heights (n,) [m], on whose slopes they lie flat.
    """
    gait.check()
    if isinstance(ground, Ground):
        ground = Simulation(ground)
    if isinstance(ground, Simulation) and not np.isfinite(ground.bounds()).any():
        ground = ground.rest_height  # level without end: there are no slopes to place feet on
    line = path if isinstance(path, Path) else Path(path)
    if not _is_whole(passes, 1):
        raise DesirePathError(f"A walk of {passes} passes cannot be made: give a whole number from 1 on.")
    if not _is_whole(seed, 0):
        raise DesirePathError(f"A seed of {seed} cannot be used: choose a whole number, 0 or more.")
    for name, value, most in (
        ("lateral", lateral, 100.0),
        ("timing", timing, 0.3),
        ("stride", stride, 0.3),
        ("pause", pause, 1e9),
    ):
        if not (np.isfinite(value) and 0.0 <= value <= most):
            raise DesirePathError(f"A {name} of {value:g} cannot be used: choose one from 0 to {most:g}.")
    rate = gait.frame_rate * math.ceil(RATE / gait.frame_rate - 1e-6)
    cycles = [find(gait.only([w])) for w in range(len(gait.mass))]
    samples = sum(passes * (line.length / cycle.speed * rate + 2) for cycle in cycles) * len(gait.pose)
    if samples > MOST_SAMPLES:
        raise DesirePathError(
            f"{passes} passes over {line.length:.0f} m are too long for one recording: walk them in several bakes, "
            "or choose fewer passes or a lower frame rate."
        )
    turns = []
    for number in range(int(passes)):
        way = line.backwards() if back_and_forth and number % 2 else line
        for w, cycle in enumerate(cycles):
            even = np.random.default_rng([int(seed), w]).random(len(EVEN)) + number * EVEN
            random = np.random.default_rng([int(seed), w, number])
            scatter = _Scatter(even % 1.0, random, *((0.0,) * 3 if number == 0 else (lateral, timing, stride)))
            turns.append((w, *_one(cycle, way, rate, scatter, ground)))
    told = tuple(dict.fromkeys(gait.warnings + tuple(each for cycle in cycles for each in cycle.gait.warnings)))
    walks = [replace(cycle.gait, frame_start=gait.frame_start, warnings=told) for cycle in cycles]
    return _chained(walks, turns, rate, [pause if n else 0.0 for n in range(len(turns))])


def _is_whole(value, least):
    return (
        isinstance(value, (int, float, np.integer, np.floating))
        and not isinstance(value, bool)
        and least <= value < math.inf
        and int(value) == value
    )


# ---- one pass ----------------------------------------------------------------------------------------


def _normal(share):
    """The normal number below which a share 0..1 of all is, -3 to 3."""
    return min(max(NormalDist().inv_cdf(min(max(share, 1e-6), 1.0 - 1e-6)), -3.0), 3.0)


class _Scatter:
    """What one pass does in its own way: where in the cycle it begins, how far beside the path and how it weaves,
    its strides and its pace.

    even: five numbers 0..1 that fill their box evenly from pass to pass.
    """

    def __init__(self, even, random, lateral, timing, stride):
        self.start = even[0] if lateral or timing or stride else 0.0
        self.shift = math.sqrt(1.0 - WEAVE**2) * lateral * _normal(even[1])
        self.phase = 2.0 * math.pi * even[2]
        self.size = math.sqrt(2.0) * WEAVE * lateral * _normal(even[3])
        self.scale = math.exp(stride * _normal(even[4]))
        self.turn = 2.0 * math.pi / random.uniform(*SWING)
        self.pace = math.exp(timing * _normal(random.random()))

    def beside(self, s):
        """How far to the left of the path a walker goes [m] at lengths along it."""
        return self.shift + self.size * np.sin(self.turn * s + self.phase)

    def slope(self, s):
        return self.size * self.turn * np.cos(self.turn * s + self.phase)


def _one(cycle, line, rate, scatter, ground):
    """(com (T, 3), pose (P, T, 7)) of one pass."""
    pace, scale = scatter.pace, scatter.scale
    cycles = line.length / (cycle.way * scale)
    count = max(int(math.ceil(cycles * cycle.seconds / pace * rate)), 2) + 1
    phase = np.arange(count) * pace / rate / cycle.seconds + scatter.start
    com, pose, stand = cycle.at(phase)

    # strides get longer by moving the places where limbs stand; the path begins where the body is at first
    begin = com[0, 0]
    grown = lambda s: scale * (s - begin)
    feet = np.stack([grown(stand[..., 0]), stand[..., 1]], axis=-1)
    place, heading = _laid(line, scatter, feet)
    limb = cycle.gait.part_limb
    over = pose[..., :3].copy()
    over[..., :2] -= stand[limb]
    over[..., 2] -= cycle.floor
    turn = rotation.about_z(heading)
    height = cycle.floor
    placed = isinstance(ground, Simulation)
    if not placed and (ground is not None or line.has_height):
        below = _Below(line, scatter, ground)
        height, tilt = below.feet(place, heading, feet[..., 0])
        turn = rotation.product(tilt, turn)
    pose[..., 3:] = rotation.product(turn[limb], pose[..., 3:])
    pose[..., :3] = rotation.turned(turn[limb], over)
    pose[..., :2] += place[limb]
    pose[..., 2] += height[limb] if np.ndim(height) else height

    # who goes round a bend leans into it
    s = grown(com[:, 0])
    speed = cycle.speed * scale * pace
    lean = speed**2 * line.bend_at(s) * (com[:, 2] - cycle.floor) / GRAVITY
    body, _ = _laid(line, scatter, np.stack([s, com[:, 1] + lean], axis=-1))
    if not placed and (ground is not None or line.has_height):
        com[:, 2] += below.body(s) - cycle.floor
    com[:, :2] = body
    if placed:
        level = replace(cycle.gait, time=np.arange(count) / rate, com=com[None], pose=pose, cut=())
        level = placing.place_feet(level, ground, carry=True, floor=cycle.floor)
        com, pose = level.com[0], level.pose
    return com, pose


def _laid(line, scatter, at):
    """World places (.., 2) and headings of places (s, l) along the path."""
    s = at[..., 0]
    place, heading = line.at(s)
    side = (at[..., 1] + scatter.beside(s))[..., None]
    place = place + side * np.stack([-np.sin(heading), np.cos(heading)], axis=-1)
    return place, heading + np.arctan(scatter.slope(s))


class _Below:
    """The ground a pass goes over: a function of places, or the path's own height."""

    def __init__(self, line, scatter, ground):
        self.line, self.ground = line, ground
        beyond = 3.0
        count = int((line.length + 2 * beyond) / 0.05) + 2
        self.s = np.linspace(-beyond, line.length + beyond, count)
        if ground is None:
            rise = line.height(self.s)
        else:
            rise = self._heights(_laid(line, scatter, np.stack([self.s, 0 * self.s], axis=-1))[0], self.s, None)
        reach = np.arange(-40, 41) * 0.05
        weight = np.exp(-0.5 * (reach / (0.5 * SMOOTH)) ** 2)
        padded = np.pad(rise, 40, mode="edge")
        self.rise = rise
        self.smooth = np.convolve(padded, weight / weight.sum(), "valid")

    def body(self, s):
        return np.interp(s, self.s, self.smooth)

    def _heights(self, place, s, line_height):
        """Heights at places; where there is no ground, that of the nearest length of the pass that has some."""
        found = np.asarray(self.ground(np.ascontiguousarray(place.reshape(-1, 2))), float).reshape(place.shape[:-1])
        known = np.isfinite(found)
        if known.all():
            return found
        if line_height is not None:
            return np.where(known, found, line_height)
        if not known.any():
            return np.zeros_like(found)
        return np.interp(s, s[known], found[known])

    def feet(self, place, heading, s):
        """Height (L, T) under each limb, and the turn (L, T, 4) that lays it on the slope there."""
        ahead = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
        left = np.stack([-ahead[..., 1], ahead[..., 0]], axis=-1)
        if self.ground is None:
            at = self.line.height
            middle, climb, side = at(s), (at(s + FOOT) - at(s - FOOT)) / (2 * FOOT), 0.0 * s
        else:
            line = np.interp(s, self.s, self.rise)
            look = lambda way, far: self._heights(place + far * way, s, line)
            middle = look(ahead, 0.0)
            climb = (look(ahead, FOOT) - look(ahead, -FOOT)) / (2 * FOOT)
            side = (look(left, FOOT) - look(left, -FOOT)) / (2 * FOOT)
        normal = np.concatenate([-climb[..., None] * ahead - side[..., None] * left, np.ones(s.shape + (1,))], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        tilt = np.stack([1.0 + normal[..., 2], -normal[..., 1], normal[..., 0], 0.0 * s], axis=-1)
        return middle, tilt / np.linalg.norm(tilt, axis=-1, keepdims=True)


# ---- many passes, many walkers -----------------------------------------------------------------------


def _chained(gaits, turns, rate, pauses):
    """One recording of walkers who go one at a time: turns (walker, com (T, 3), pose (P, T, 7)), each after
    its pause [s]. In a pause nobody is there, nor is who does not walk: see Gait.there().
    """
    lengths, starts, time, at = [], [], [], gaits[0].time[0]
    for (_, com, _), pause in zip(turns, pauses):
        if pause > 0.0:  # a piece of one sample, just before the next walker comes
            at += pause
            lengths.append(1)
            time.append([at - 1.0 / rate])
        starts.append(sum(lengths))
        lengths.append(len(com))
        time.append(at + np.arange(len(com)) / rate)
        at = time[-1][-1] + 1.0 / rate
    time = np.concatenate(time)
    walkers = np.cumsum([0] + [len(gait.mass) for gait in gaits])
    parts = np.cumsum([0] + [len(gait.pose) for gait in gaits])
    coms = [(np.array([walkers[who]]), start, com[None]) for (who, com, _), start in zip(turns, starts)]
    poses = [(np.arange(parts[who], parts[who + 1]), start, pose) for (who, _, pose), start in zip(turns, starts)]
    if len(gaits) == 1 and len(turns) == len(lengths):  # one who is always there
        com, pose = (np.concatenate([each for _, _, each in blocks], axis=1) for blocks in (coms, poses))
    else:
        com = TrackArray(walkers[-1], len(time), coms)
        pose = TrackArray(parts[-1], len(time), poses)
    one = lambda gait: replace(gait, time=time[:1], com=gait.com[:, :1], pose=gait.pose[:, :1], cut=(), jump=(), leg=())
    chained = replace(
        Gait.join([one(gait) for gait in gaits]),
        time=time,
        com=com,
        pose=pose,
        cut=np.cumsum(lengths)[:-1],
        jump=(),
        frame_rate=gaits[0].frame_rate,
        frame_start=gaits[0].frame_start,
    )
    if not any(len(gait.leg) for gait in gaits):
        return chained
    legs = size.legs(chained)
    return replace(
        chained, leg=[leg for gait, own in zip(gaits, legs) for leg in (gait.leg if len(gait.leg) else [own])]
    )


def in_turn(gaits):
    """Walkers with passes of their own as one recording: pass n of each, one after the other, then n + 1."""
    gaits = list(gaits)
    if len(gaits) < 2:
        return Gait.join(gaits)
    rates = [gait.rate() for gait in gaits]
    if None in rates or max(rates) - min(rates) > 1e-6 * max(rates):
        raise DesirePathError("The walkers were recorded at different rates: resample them to one.")
    spans = [turns_of(gait) for gait in gaits]
    alone = [gait.only([w]) for gait in gaits for w in range(len(gait.mass))]
    turns, pauses, first = [], [], np.cumsum([0] + [len(gait.mass) for gait in gaits])
    for n in range(max(map(len, spans))):
        for gait, span, base in zip(gaits, spans, first):
            if n < len(span):
                a, b, w, pause = span[n]
                mine = gait.limb_walker[gait.part_limb] == w
                turns.append((base + w, gait.com[w, a:b], gait.pose[mine, a:b]))
                pauses.append(pause if turns[1:] else 0.0)
    return _chained(alone, turns, rates[0], pauses)


def turns_of(gait):
    """(first sample, sample after the last, walker, pause before [s]) of each pass of a recording, in time."""
    rate = gait.rate() or gait.frame_rate
    turns, before = [], gait.time[0]
    for a, b in gait.pieces(gait.cuts_of(())):
        there = gait.there(a, b)
        for w in there:
            pause = float(gait.time[a] - before)
            turns.append((a, b, int(w), pause if pause > 0.5 / rate else 0.0))
        if len(there):
            before = gait.time[b - 1] + 1.0 / rate
    return turns
