"""Feet that go through deep ground instead of over it: a clip of a firm floor walks in snow. MODEL 3.9

    recording --(a trial bake: how deep each stance sinks)--> legs, that carve what swinging feet do not clear

A foot that stands deep comes out of its print ahead and goes into the next one from behind. It is as much lower than it
was recorded as its walker has sunk, and lifted while it swings; what is in its way is pushed ahead.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from ..errors import DesirePathError
from ..ground.sim import Simulation
from ..loads import walker
from ..loads.force import FootForce
from ..motion import size as sizes
from ..motion import tracks
from ..motion.gait import AUTO, Gait
from . import shank

DEEP = 0.03  # feet that sink less leave what they do not clear to their soles [m]
HOLDS = 0.9  # of its depth: a leg stands so far in its print, which the sole presses
RISE = 0.15  # for a grown person: a foot is lifted out of its print within this time [s] ..
LIFT = 0.35  # .. and while it swings by no more than this above where it was recorded, in legs
CARRIES = 0.3  # of a stance's largest load: what carries less has not sunk yet, or has left


@dataclass(frozen=True)
class _Stance:
    first: int  # sample
    last: int
    sunk: float  # [m]


def _stances(stands: np.ndarray, first: int, deep: np.ndarray) -> list[_Stance]:
    """Of a limb in samples from `first` on. stands: whether it touches (n,); deep: how far below it the ground is (n,),
    NaN where it carries too little to tell"""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], stands, [False]]).astype(int)))
    found = []
    for a, b in zip(edges[::2].tolist(), edges[1::2].tolist()):
        known = deep[a:b][np.isfinite(deep[a:b])]
        found.append(_Stance(first + a, first + b - 1, float(np.median(known)) if len(known) else 0.0))
    return found


def _lowered(time: np.ndarray, first: int, stances: list[_Stance], rise: float, lift: float) -> np.ndarray:
    """How much lower a foot goes than it was recorded, at each sample from `first` on (n,) [m] >= 0"""
    out = np.zeros(len(time))
    for n, stance in enumerate(stances):
        out[stance.first - first : stance.last - first + 1] = stance.sunk
        before = stances[n - 1] if n else None
        _swing(out, time, (before.last - first if before else -1, stance.first - first), (before, stance), (rise, lift))
    if stances:
        _swing(out, time, (stances[-1].last - first, len(time)), (stances[-1], None), (rise, lift))
    return out


def _swing(
    out: np.ndarray,
    time: np.ndarray,
    between: tuple[int, int],
    ends: tuple[_Stance | None, _Stance | None],
    rises: tuple[float, float],
) -> None:
    """Fill in the samples between two stances, of which one may be missing."""
    a, b = between
    if b - a < 2:
        return
    at = time[a + 1 : b]
    rise, lift = rises
    if a >= 0 and b < len(time):
        rise = min(rise, 0.5 * (time[b] - time[a]))
    since = at - time[a] if a >= 0 else np.full(len(at), math.inf)
    until = time[b] - at if b < len(time) else np.full(len(at), math.inf)
    begin, end = (each.sunk if each else None for each in ends)
    held = [
        sunk * (1.0 - np.sin(0.5 * math.pi * np.minimum(gone / rise, 1.0)))
        for sunk, gone in ((begin or 0.0, since), (end or 0.0, until))
    ]
    sunk = np.interp(at, time[[max(a, 0), min(b, len(time) - 1)]], [_either(begin, end), _either(end, begin)])
    out[a + 1 : b] = np.maximum(np.maximum(*held), sunk - lift)


def _either(sunk: float | None, other: float | None) -> float:
    return float(sunk if sunk is not None else other or 0.0)


def _depth(trial: Simulation, gait: Gait, loads: FootForce, parts: np.ndarray, first: int, count: int) -> np.ndarray:
    """How deep the ground is pressed where a limb carries (n,) [m], NaN where it carries little."""
    out = np.full(count, np.nan)
    for part in parts.tolist():
        force = -np.asarray(loads.force[part, first : first + count])[:, 2]
        place = np.asarray(loads.point[part, first : first + count])[:, :2]
        bears = (force > CARRIES * max(float(force.max()), 1e-9)) & np.isfinite(place).all(axis=1)
        for k in np.flatnonzero(bears).tolist():
            (x, y), near = place[k].tolist(), 0.6 * trial.cell_size
            pressed = float(trial.read("compression", (x - near, y - near, x + near, y + near)).max())
            out[k] = np.fmax(out[k], pressed)
    return out


def wade(gait: Gait, trial: Simulation, lift: float | None = None, *, walkers: Collection[int] | None = None) -> Gait:
    """The recording with legs that carve their way through the ground which its walkers sink into; itself if none sinks
    by more than 3 cm. Their prints are as deep as before: to be used as the recording is, with ground and soil of
    the trial.

    trial: a new Simulation of that ground, in cells as coarse as one likes, which is stepped to its end
    walkers: who wades, by their numbers; None: all, but for those who carve
    lift: by how much at most swinging feet are lifted above where they were recorded [m] >= 0; None: 0.35 of the leg
    """
    if lift is not None and not (math.isfinite(lift) and lift >= 0.0):
        raise DesirePathError(f"Feet cannot be lifted by {lift:g} m: give 0 or more.")
    gait = sizes.known(gait.check())
    loads = walker.loads(gait, ground=trial)
    trial.load(gait, loads)
    trial.run(len(gait.time) - 1)
    lowered = tracks.blank(gait.pose, (), float, 0.0)
    wades = ~gait.carving() & np.isin(
        np.arange(len(gait.mass)), range(len(gait.mass)) if walkers is None else [*walkers]
    )
    for limb in np.flatnonzero(wades[gait.limb_walker]).tolist():
        parts, size = np.flatnonzero(gait.part_limb == limb), gait.leg[gait.limb_walker[limb]] / sizes.LEG
        own = [tracks.pieces(loads.touching, part) for part in parts.tolist()]
        for pieces in zip(*own):
            first, count = pieces[0][0], len(pieces[0][1])
            stands = np.any([values == 1 for _, values in pieces], axis=0)
            stances = _stances(stands, first, _depth(trial, gait, loads, parts, first, count))
            time, most = gait.time[first : first + count], LIFT * sizes.LEG * size if lift is None else lift
            down = HOLDS * _lowered(time, first, stances, RISE * math.sqrt(size), most)
            tracks.put(lowered, parts, np.arange(first, first + count), down[None])
    deepest = max(float(values.max(initial=0.0)) for values in tracks.values(lowered))
    if deepest < HOLDS * DEEP:
        return gait
    return _with_legs(gait, lowered, wades, deepest > HOLDS * shank.ANKLE * float(gait.leg.min()))


def _with_legs(gait: Gait, lowered: tracks.Array, wades: np.ndarray, shins: bool) -> Gait:
    """The recording, and legs of those who wade (W,) that go as much lower as told (P, T) [m]; with shins, or not."""
    pose = tracks.writable(gait.pose)
    for values, down in zip(tracks.values(pose), tracks.values(lowered)):
        values[..., 2] -= down
    legs = replace(
        gait,
        pose=pose,
        mass_keys=(),
        walker_name=tuple(f"{name}'s legs" for name in gait.walker_name),
        contact_law=("carve",) * len(gait.mass),
        warnings=(),
    ).only(np.flatnonzero(wades))
    if shins:
        legs = shank.shod(legs, gait.only(np.flatnonzero(wades)))
    laws = gait.contact_law or (AUTO,) * len(gait.mass)
    return Gait.join([replace(gait, contact_law=laws), legs])
