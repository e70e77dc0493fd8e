"""A clip's cycle carried along a path, pass after pass: what makes a trail. Design 7.

Every limb moves with the place it stands on. While it touches, that place is still, so a foot is set down on
the curve as it was in the clip and does not slide, in bends too; in the air it is led to the next place.
"""

import math
from dataclasses import replace

import numpy as np

from . import rotation
from .cycle import find
from .errors import DesirePathError
from .gait import AWAY, Gait
from .path import Path

RATE = 60.0  # at least so many samples a second [1/s]
MOST_SAMPLES = 20_000_000  # of all parts together
SWING = (6.0, 14.0)  # walkers weave from side to side over such lengths [m]
WEAVE = 0.6  # of the lateral scatter is weaving, the rest stays for a pass
SMOOTH = 0.4  # the body follows the ground smoothed over about this length [m]
FOOT = 0.12  # the slope under a foot is taken over this much to either side [m]
GRAVITY = 9.81


def along(gait, path, passes=1, *, back_and_forth=True, lateral=0.1, timing=0.05, stride=0.05, seed=0, pause=0.0,
          ground=None):
    """The walkers of a recording carried along a path as often as wanted: a Gait with a cut at each pass.

    path: waypoints (n, 2 or 3) [m], or a Path; its height is the ground's where it has one.
    back_and_forth: every other pass goes back; else all go one way.
    lateral: how far passes scatter to the side, standard deviation [m]; timing, stride: by how much their
    pace and the length of their strides differ, standard deviation as a share. The first pass scatters in
    nothing; the others are the same for the same seed, however many follow.
    pause: time between passes [s]. ground: a function of points (n, 2) -> heights (n,) [m] to walk on.
    """
    gait.check()
    line = path if isinstance(path, Path) else Path(path)
    if isinstance(passes, bool) or int(passes) != passes or passes < 1:
        raise DesirePathError(f"A walk of {passes} passes cannot be made: give a whole number from 1 on.")
    for name, value, most in (("lateral", lateral, 100.0), ("timing", timing, 0.3), ("stride", stride, 0.3),
                              ("pause", pause, 1e9)):
        if not (np.isfinite(value) and 0.0 <= value <= most):
            raise DesirePathError(f"A {name} of {value:g} cannot be used: choose one from 0 to {most:g}.")
    rate = gait.frame_rate * math.ceil(RATE / gait.frame_rate - 1e-6)
    walkers = []
    for w in range(len(gait.mass)):
        cycle = find(gait.only([w]))
        samples = passes * (line.length / cycle.speed * rate + 1) * len(cycle.pose)
        if samples > MOST_SAMPLES:
            raise DesirePathError(
                f"{passes} passes over {line.length:.0f} m are too long for one recording: walk them in several "
                "bakes, or choose fewer passes or a lower frame rate.")
        pieces = []
        for number in range(int(passes)):
            random = np.random.default_rng([int(seed), w, number])
            back = back_and_forth and number % 2 == 1
            way = line.backwards() if back else line
            pieces.append(_one(cycle, way, rate, random, number == 0, lateral, timing, stride, ground))
        walkers.append(_chained(cycle.gait, pieces, rate, pause))
    return in_turn(walkers)


# ---- one pass ----------------------------------------------------------------------------------------


def _normal(random):
    return float(np.clip(random.normal(), -3.0, 3.0))


class _Weave:
    """How far beside the path a walker goes, and how steeply it nears it, at lengths along it."""

    def __init__(self, random, lateral):
        self.shift = math.sqrt(1.0 - WEAVE ** 2) * lateral * _normal(random)
        self.size = math.sqrt(2.0) * WEAVE * lateral * _normal(random)
        self.turn = 2.0 * math.pi / random.uniform(*SWING)
        self.phase = random.uniform(0.0, 2.0 * math.pi)

    def at(self, s):
        return self.shift + self.size * np.sin(self.turn * s + self.phase)

    def slope(self, s):
        return self.size * self.turn * np.cos(self.turn * s + self.phase)


def _one(cycle, line, rate, random, first, lateral, timing, stride, ground):
    """(com (T, 3), pose (P, T, 7)) of one pass."""
    share = 0.0 if first else 1.0
    weave = _Weave(random, share * lateral)
    pace = math.exp(share * timing * _normal(random))
    scale = math.exp(share * stride * _normal(random))
    start = random.uniform() * share
    cycles = line.length / (cycle.way * scale)
    count = max(int(math.ceil(cycles * cycle.seconds / pace * rate)), 2) + 1
    phase = np.arange(count) * pace / rate / cycle.seconds + start
    com, pose, stand = cycle.at(phase)

    # strides get longer by moving the places where limbs stand; the path begins where the body is at first
    begin = com[0, 0]
    grown = lambda s: scale * (s - begin)
    feet = np.stack([grown(stand[..., 0]), stand[..., 1]], axis=-1)
    place, heading = _laid(line, weave, feet)
    limb = cycle.gait.part_limb
    over = pose[..., :3].copy()
    over[..., :2] -= stand[limb]
    over[..., 2] -= cycle.floor
    turn = rotation.about_z(heading)
    height = cycle.floor
    if ground is not None or line.has_height:
        below = _Below(line, weave, ground)
        height, tilt = below.feet(place, heading, feet[..., 0])
        turn = rotation.product(tilt, turn)
    pose[..., 3:] = rotation.product(turn[limb], pose[..., 3:])
    pose[..., :3] = rotation.turned(turn[limb], over)
    pose[..., :2] += place[limb]
    pose[..., 2] += height[limb] if np.ndim(height) else height

    # who goes round a bend leans into it
    s = grown(com[:, 0])
    speed = cycle.speed * scale * pace
    lean = speed ** 2 * line.bend_at(s) * (com[:, 2] - cycle.floor) / GRAVITY
    body, _ = _laid(line, weave, np.stack([s, com[:, 1] + lean], axis=-1))
    if ground is not None or line.has_height:
        com[:, 2] += below.body(s) - cycle.floor
    com[:, :2] = body
    return com, pose


def _laid(line, weave, at):
    """World places (.., 2) and headings of places (s, l) along the path."""
    s = at[..., 0]
    place, heading = line.at(s)
    side = (at[..., 1] + weave.at(s))[..., None]
    place = place + side * np.stack([-np.sin(heading), np.cos(heading)], axis=-1)
    return place, heading + np.arctan(weave.slope(s))


class _Below:
    """The ground a pass goes over: a function of places, or the path's own height."""

    def __init__(self, line, weave, ground):
        self.line, self.ground = line, ground
        beyond = 3.0
        count = int((line.length + 2 * beyond) / 0.05) + 2
        self.s = np.linspace(-beyond, line.length + beyond, count)
        if ground is None:
            rise = line.height(self.s)
        else:
            rise = self._heights(_laid(line, weave, np.stack([self.s, 0 * self.s], axis=-1))[0], self.s, None)
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
        normal = np.concatenate([-climb[..., None] * ahead - side[..., None] * left,
                                 np.ones(s.shape + (1,))], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        tilt = np.stack([1.0 + normal[..., 2], -normal[..., 1], normal[..., 0], 0.0 * s], axis=-1)
        return middle, tilt / np.linalg.norm(tilt, axis=-1, keepdims=True)


# ---- many passes, many walkers -----------------------------------------------------------------------


def _chained(gait, pieces, rate, pause):
    """One recording of pieces (com, pose) one after the other."""
    lengths = np.array([len(com) for com, _ in pieces])
    begin = np.r_[0, np.cumsum(lengths)]
    time = np.arange(begin[-1]) / rate + np.repeat(np.arange(len(pieces)), lengths) * pause
    return replace(gait, time=time, com=np.concatenate([com for com, _ in pieces])[None],
                   pose=np.concatenate([pose for _, pose in pieces], axis=1), cut=begin[1:-1])


def in_turn(gaits):
    """Walkers with passes of their own as one recording: pass n of each, one after the other, then n + 1.

    Who does not walk at the moment is away: see Gait.there().
    """
    gaits = list(gaits)
    if len(gaits) < 2:
        return Gait.join(gaits)
    rates = [gait.rate() for gait in gaits]
    if None in rates or max(rates) - min(rates) > 1e-6 * max(rates):
        raise DesirePathError("The walkers were recorded at different rates: resample them to one.")
    spans = [gait.pieces() for gait in gaits]
    turns = [(w, n) for n in range(max(map(len, spans))) for w in range(len(gaits)) if n < len(spans[w])]
    lengths = np.array([spans[w][n][1] - spans[w][n][0] for w, n in turns])
    gaps = np.cumsum([_gap(gaits[w], n, rates[0]) for w, n in turns])
    begin = np.r_[0, np.cumsum(lengths)]
    time = gaits[0].time[0] + np.arange(begin[-1]) / rates[0] + np.repeat(gaps, lengths)
    alike = dict(time=time, cut=begin[1:-1], frame_rate=gaits[0].frame_rate, frame_start=gaits[0].frame_start)
    walking = []
    for w, gait in enumerate(gaits):
        take, high = np.zeros(begin[-1], int), np.full(begin[-1], 2.0 * AWAY)
        for (other, n), a, b in zip(turns, begin[:-1], begin[1:]):
            if other == w:
                take[a:b] = np.arange(*spans[w][n])
                high[a:b] = 0.0
            else:
                take[a:b] = take[a - 1] if a else 0
        com, pose = gait.com[:, take].copy(), gait.pose[:, take].copy()
        com[..., 2] += high
        pose[..., 2] += high
        walking.append(replace(gait, com=com, pose=pose, **alike))
    return Gait.join(walking)


def _gap(gait, number, rate):
    """Time without samples before a piece of a recording [s]."""
    if number == 0:
        return 0.0
    cut = gait.cut[number - 1]
    return max(float(gait.time[cut] - gait.time[cut - 1]) - 1.0 / rate, 0.0)
