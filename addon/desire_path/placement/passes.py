"""A clip's cycle carried along a path, pass after pass: what makes a trail. MODEL 3.6

Every limb moves with the place it stands on. While it touches, that place is still, so a foot is set down on
the curve as it was in the clip and does not slide, in bends too; in the air it is led to the next place.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from statistics import NormalDist
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ..errors import DesirePathError
from ..ground.sim import Ground, Simulation
from ..keywords import fields_of
from ..loads.below import Heights
from ..motion import rotation, size
from ..motion.gait import Gait
from ..motion.scatter import Scatter
from ..motion.tracks import Array, TrackArray
from . import place as placing
from .cycle import Cycle, find
from .path import Path

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

RATE = 60.0  # at least so many samples a second [1/s]
MAX_PAUSE = 1e9  # [s]
MAX_SAMPLES = 20_000_000  # of all parts together
SWING = (6.0, 14.0)  # walkers weave from side to side over such lengths [m]
WEAVE = 0.6  # of the lateral scatter is weaving, the rest stays for a pass
SMOOTH = 0.4  # the body follows the ground smoothed over about this length [m]
FOOT = 0.12  # the slope under a foot is taken over this much to either side [m]
# steps that fill a box of five dimensions evenly, x^6 = x + 1: few passes are spread as well as many
EVEN = 1.1347241384015194 ** -np.arange(1.0, 6.0)
GRAVITY = 9.81
Pass: TypeAlias = tuple[np.ndarray, np.ndarray]  # com (T, 3), pose (P, T, 7)


@fields_of(scatter=Scatter)
def along(
    gait: Gait,
    path: Path | ArrayLike,
    passes: int = 1,
    *,
    back_and_forth: bool = True,
    scatter: Scatter = Scatter(),
    seed: int = 0,
    pause: float = 0.0,
    ground: Ground | Simulation | Heights | None = None,
) -> Gait:
    """The walkers of a recording carried along a path as often as wanted: a Gait with a cut at each pass.

    path: waypoints (n, 2 or 3) [m], or a Path; its height is the ground's where it has one.
    back_and_forth: every other pass goes back; else all go one way.
    scatter: how far passes go to the side, and how their pace and strides differ. The first pass scatters in
    nothing; the others are the same for the same seed, however many follow.
    pause: time between passes [s]. ground: what is walked on, a Ground or a Simulation of one: feet are placed on its
    slopes, TRAIL (1) (2); or a function of points (n, 2) -> heights (n,) [m], on whose slopes they lie flat.
    """
    gait.check()
    if isinstance(ground, Ground):
        ground = Simulation(ground)
    if isinstance(ground, Simulation) and not np.isfinite(ground.bounds()).any():
        ground = ground.rest_height  # level without end: there are no slopes to place feet on
    if ground is not None and not isinstance(ground, Simulation) and not callable(ground):
        raise DesirePathError(
            f"A {type(ground).__name__} is no ground to walk on: give a Ground, a Simulation or a function of points "
            "(n, 2)."
        )
    line = path if isinstance(path, Path) else Path(path)
    if not _is_integer(passes, 1):
        raise DesirePathError(f"A walk of {passes} passes cannot be walked: give a whole number from 1 on.")
    if not _is_integer(seed, 0) or seed >= 1 << 64:
        raise DesirePathError(f"A seed of {seed} cannot be used: choose a whole number from 0 to 2^64 - 1.")
    scatter.check()
    if not (math.isfinite(pause) and 0.0 <= pause <= MAX_PAUSE):
        raise DesirePathError(f"A pause of {pause:g} s cannot be used: choose one from 0 to {MAX_PAUSE:g}.")
    rate = gait.frame_rate * math.ceil(RATE / gait.frame_rate - 1e-6)
    if gait.mass_keys:
        sentence = "The keys on the mass of walkers do not count along a path: they weigh what they do at first."
        gait = replace(gait, mass_keys=(), warnings=(sentence, *gait.warnings))
    cycles = [find(gait.only([w])) for w in range(len(gait.mass))]
    samples = sum(passes * (line.length / cycle.speed * rate + 2) for cycle in cycles) * len(gait.pose)
    if samples > MAX_SAMPLES:
        raise DesirePathError(
            f"{passes} passes over {line.length:.0f} m are too long for one recording: walk them in several bakes, "
            "or choose fewer passes or a lower frame rate."
        )
    turns = []
    for number in range(int(passes)):
        course = line.backwards() if back_and_forth and number % 2 else line
        for w, cycle in enumerate(cycles):
            even = np.random.default_rng([int(seed), w]).random(len(EVEN)) + number * EVEN
            random = np.random.default_rng([int(seed), w, number])
            own = _Scattered(even % 1.0, random, scatter if number else Scatter(0.0, 0.0, 0.0))
            turns.append((w, *_one(cycle, course, rate, own, ground)))
    warnings = tuple(dict.fromkeys(gait.warnings + tuple(each for cycle in cycles for each in cycle.gait.warnings)))
    walks = [replace(cycle.gait, frame_start=gait.frame_start, warnings=warnings) for cycle in cycles]
    return _chained(walks, turns, rate, [pause if n else 0.0 for n in range(len(turns))])


def _is_integer(value: object, low: int) -> bool:
    return (
        isinstance(value, (int, float, np.integer, np.floating))
        and not isinstance(value, bool)
        and bool(low <= value < math.inf and int(value) == value)
    )


# ---- one pass ----------------------------------------------------------------------------------------


def _normal(share: float) -> float:
    """The normal number below which a share 0..1 of all is, -3 to 3."""
    return min(max(NormalDist().inv_cdf(min(max(share, 1e-6), 1.0 - 1e-6)), -3.0), 3.0)


class _Scattered:
    """What one pass does in its own way: where in the cycle it begins, how far beside the path and how it weaves,
    its strides and its pace.

    even: five numbers 0..1 that fill their box evenly from pass to pass.
    """

    def __init__(self, even: np.ndarray, random: np.random.Generator, scatter: Scatter) -> None:
        lateral, timing, stride = scatter.lateral, scatter.timing, scatter.stride
        self.start = even[0] if lateral or timing or stride else 0.0
        self.shift = math.sqrt(1.0 - WEAVE**2) * lateral * _normal(even[1])
        self.phase = 2.0 * math.pi * even[2]
        self.size = math.sqrt(2.0) * WEAVE * lateral * _normal(even[3])
        self.scale = math.exp(stride * _normal(even[4]))
        self.turn = 2.0 * math.pi / random.uniform(*SWING)
        self.pace = math.exp(timing * _normal(random.random()))

    def beside(self, s: np.ndarray) -> np.ndarray:
        """How far to the left of the path a walker goes [m] at lengths along it."""
        return np.asarray(self.shift + self.size * np.sin(self.turn * s + self.phase))

    def slope(self, s: np.ndarray) -> np.ndarray:
        """How fast that grows [-]."""
        return np.asarray(self.size * self.turn * np.cos(self.turn * s + self.phase))


def _one(cycle: Cycle, line: Path, rate: float, scatter: _Scattered, ground: Simulation | Heights | None) -> Pass:
    """(com (T, 3), pose (P, T, 7)) of one pass."""
    pace, scale = scatter.pace, scatter.scale
    cycles = line.length / (cycle.length * scale)
    count = max(int(math.ceil(cycles * cycle.seconds / pace * rate)), 2) + 1
    phase = np.arange(count) * pace / rate / cycle.seconds + scatter.start
    com, pose, stand = cycle.at(phase)

    # strides get longer by moving the places where limbs stand; the path begins where the body is at first
    begin = com[0, 0]

    def grown(s: np.ndarray) -> np.ndarray:
        return np.asarray(scale * (s - begin))

    feet = np.stack([grown(stand[..., 0]), stand[..., 1]], axis=-1)
    place, heading = _laid(line, scatter, feet)
    limb = cycle.gait.part_limb
    over = pose[..., :3].copy()
    over[..., :2] -= stand[limb]
    over[..., 2] -= cycle.floor
    turn = rotation.about_z(heading)
    height: float | np.ndarray = cycle.floor
    below = None
    if not isinstance(ground, Simulation) and (ground is not None or line.has_height):
        below = _Below(line, scatter, ground)
        height, tilt = below.feet(place, heading, feet[..., 0])
        turn = rotation.product(tilt, turn)
    pose[..., 3:] = rotation.product(turn[limb], pose[..., 3:])
    pose[..., :3] = rotation.turned(turn[limb], over)
    pose[..., :2] += place[limb]
    pose[..., 2] += height[limb] if isinstance(height, np.ndarray) else height

    # who goes round a bend leans into it
    s = grown(com[:, 0])
    high = max(float(np.mean(com[:, 2])) - cycle.floor, 0.0)
    body, heading = line.led(s, cycle.speed * scale * pace * math.sqrt(high / GRAVITY))
    body = _beside(body, heading, com[:, 1] + scatter.beside(s))
    if below is not None:
        com[:, 2] += below.body(s) - cycle.floor
    com[:, :2] = body
    if isinstance(ground, Simulation):
        level = replace(cycle.gait, time=np.arange(count) / rate, com=com[None], pose=pose, cut=np.empty(0))
        level = placing.place_feet(level, ground, carry=True, floor=cycle.floor)
        com, pose = level.com[0], np.asarray(level.pose)
    return com, pose


def _laid(line: Path, scatter: _Scattered, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """World places (.., 2) and headings of places (s, l) along the path."""
    s = at[..., 0]
    place, heading = line.at(s)
    return _beside(place, heading, at[..., 1] + scatter.beside(s)), heading + np.arctan(scatter.slope(s))


def _beside(place: np.ndarray, heading: np.ndarray, left: np.ndarray) -> np.ndarray:
    """Places (.., 2) so far to the left of others, seen along a heading."""
    moved: np.ndarray = place + left[..., None] * np.stack([-np.sin(heading), np.cos(heading)], axis=-1)
    return moved


class _Below:
    """The ground a pass goes over: a function of places, or the path's own height."""

    def __init__(self, line: Path, scatter: _Scattered, ground: Heights | None) -> None:
        self.line, self.ground = line, ground
        beyond = 3.0
        count = int((line.length + 2 * beyond) / 0.05) + 2
        self.s = np.linspace(-beyond, line.length + beyond, count)
        if ground is None:
            rise = line.height(self.s)
        else:
            middle = _laid(line, scatter, np.stack([self.s, 0 * self.s], axis=-1))[0]
            rise = _known_heights(ground, middle, self.s, None)
        apart = np.arange(-40, 41) * 0.05
        weight = np.exp(-0.5 * (apart / (0.5 * SMOOTH)) ** 2)
        padded = np.pad(rise, 40, mode="edge")
        self.rise = rise
        self.smooth = np.convolve(padded, weight / weight.sum(), "valid")

    def body(self, s: np.ndarray) -> np.ndarray:
        """Heights that a body follows [m] at lengths along the path."""
        return np.asarray(np.interp(s, self.s, self.smooth))

    def feet(self, place: np.ndarray, heading: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Height (L, T) under each limb, and the turn (L, T, 4) that lays it on the slope there."""
        ahead = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
        left = np.stack([-ahead[..., 1], ahead[..., 0]], axis=-1)
        ground = self.ground
        if ground is None:
            at = self.line.height
            middle, climb, side = at(s), (at(s + FOOT) - at(s - FOOT)) / (2 * FOOT), 0.0 * s
        else:
            line = np.interp(s, self.s, self.rise)

            def look(direction: np.ndarray, far: float) -> np.ndarray:
                return _known_heights(ground, place + far * direction, s, line)

            middle = look(ahead, 0.0)
            climb = (look(ahead, FOOT) - look(ahead, -FOOT)) / (2 * FOOT)
            side = (look(left, FOOT) - look(left, -FOOT)) / (2 * FOOT)
        normal = np.concatenate([-climb[..., None] * ahead - side[..., None] * left, np.ones(s.shape + (1,))], axis=-1)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        tilt = np.stack([1.0 + normal[..., 2], -normal[..., 1], normal[..., 0], 0.0 * s], axis=-1)
        return middle, tilt / np.linalg.norm(tilt, axis=-1, keepdims=True)


def _known_heights(ground: Heights, place: np.ndarray, s: np.ndarray, line_height: np.ndarray | None) -> np.ndarray:
    """Heights at places; where there is no ground, that of the nearest length of the pass that has some."""
    found = np.asarray(ground(np.ascontiguousarray(place.reshape(-1, 2))), np.float64).reshape(place.shape[:-1])
    known = np.isfinite(found)
    if known.all():
        return found
    if line_height is not None:
        return np.where(known, found, line_height)
    if not known.any():
        return np.zeros_like(found)
    return np.asarray(np.interp(s, s[known], found[known]))


# ---- many passes, many walkers -----------------------------------------------------------------------


def _chained(
    gaits: Sequence[Gait], turns: Sequence[tuple[int, np.ndarray, np.ndarray]], rate: float, pauses: Sequence[float]
) -> Gait:
    """One recording of walkers who go one at a time: turns (walker, com (T, 3), pose (P, T, 7)), each after
    its pause [s]. In a pause nobody is there, nor is who does not walk: see Gait.there().
    """
    lengths, starts, times, at = list[int](), list[int](), list[np.ndarray](), float(gaits[0].time[0])
    for (_, com, _), pause in zip(turns, pauses):
        if pause > 0.0:  # a piece of one sample, just before the next walker comes
            at += pause
            lengths.append(1)
            times.append(np.array([at - 1.0 / rate]))
        starts.append(sum(lengths))
        lengths.append(len(com))
        times.append(at + np.arange(len(com)) / rate)
        at = float(times[-1][-1]) + 1.0 / rate
    time = np.concatenate(times)
    walkers = np.cumsum([0] + [len(gait.mass) for gait in gaits])
    parts = np.cumsum([0] + [len(gait.pose) for gait in gaits])
    coms = [(np.array([walkers[who]]), start, com[None]) for (who, com, _), start in zip(turns, starts)]
    poses = [(np.arange(parts[who], parts[who + 1]), start, pose) for (who, _, pose), start in zip(turns, starts)]
    if len(gaits) == 1 and len(turns) == len(lengths):  # one who is always there
        tracks: list[Array] = [np.concatenate([each for _, _, each in blocks], axis=1) for blocks in (coms, poses)]
    else:
        tracks = [TrackArray(walkers[-1], len(time), coms), TrackArray(parts[-1], len(time), poses)]
    none = np.empty(0)

    def one(gait: Gait) -> Gait:
        com, pose = gait.com[:, :1], gait.pose[:, :1]
        return replace(gait, time=time[:1], com=com, pose=pose, cut=none, jump=none, leg=none)

    chained = replace(
        Gait.join([one(gait) for gait in gaits]),
        time=time,
        com=tracks[0],
        pose=tracks[1],
        cut=np.cumsum(lengths)[:-1],
        jump=none,
        frame_rate=gaits[0].frame_rate,
        frame_start=gaits[0].frame_start,
    )
    if not any(len(gait.leg) for gait in gaits):
        return chained
    legs = size.legs(chained)
    return replace(
        chained, leg=np.array([leg for gait, own in zip(gaits, legs) for leg in (gait.leg if len(gait.leg) else [own])])
    )


def in_turn(gaits: Iterable[Gait]) -> Gait:
    """Walkers with passes of their own as one recording: pass n of each, one after the other, then n + 1."""
    gaits = list(gaits)
    if len(gaits) < 2:
        return Gait.join(gaits)
    rates = [rate for rate in (gait.rate() for gait in gaits) if rate is not None]
    if len(rates) < len(gaits) or max(rates) - min(rates) > 1e-6 * max(rates):
        raise DesirePathError("The walkers were recorded at different rates: resample them to one.")
    spans = [turns_of(gait) for gait in gaits]
    alone = [gait.only([w]) for gait in gaits for w in range(len(gait.mass))]
    turns, pauses = [], list[float]()
    first = np.cumsum([0] + [len(gait.mass) for gait in gaits]).tolist()
    for n in range(max(map(len, spans))):
        for gait, span, base in zip(gaits, spans, first):
            if n < len(span):
                a, b, w, pause = span[n]
                mine = gait.limb_walker[gait.part_limb] == w
                turns.append((base + w, gait.com[w, a:b], gait.pose[mine, a:b]))
                pauses.append(pause if turns[1:] else 0.0)
    return _chained(alone, turns, rates[0], pauses)


def turns_of(gait: Gait) -> list[tuple[int, int, int, float]]:
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
