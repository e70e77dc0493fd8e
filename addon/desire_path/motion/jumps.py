"""Where a recording jumps: a pose that stands alone, a teleport, another take. It is cut there. MODEL 3.4

    places of the mass centre and the feet --from sample to sample--> farther than bodies go --> Gait.cut

A step is measured against the steps before and after it: what lies between those two is motion, however fast, and
so is a body that stops dead. What is left over is a jump when it is far beyond the sway of bodies, which is told in
leg lengths and in what gravity does to a leg's length in the time of a step, and beyond what the same body did in
the second around it. So a leap, a spin or an insect's scurry is none, nor is an animation on twos.

    body.gait_from_bones, Bake, the command line ---found---> pieces, each for itself from then on
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias, TypeVar

import numpy as np

from .recording import Recording

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Jump: TypeAlias = tuple[int, int, float]  # last sample before, first sample after, how far [m]
R = TypeVar("R", bound=Recording)

GRAVITY = 9.81
# what is left over of steps of bodies in motion: (leg lengths, times GRAVITY step^2). Measured walks, runs, jumps and
# landings, also thinned to 12 samples a second, leave 0.006 and 1.3 of the mass centre, 0.014 and 3 of most feet
SWAY = {"com": (0.02, 4.0), "foot": (0.03, 8.0)}
MAX_FALL = 1.5  # gravity takes no leg farther than this beyond its path in one step, however small it is [leg lengths]
BEYOND = 1.5  # and a jump is larger by this than nine of ten steps around it
AT_ONCE = 0.8  # share of a frame's path that is jumped from one sample to the next
STAYS = 0.25  # feet that go by less than this share of the body's path stay, and a body whose feet stay sways
COARSE = 1.0 / 8.0  # steps so long still tell jumps from what bodies do [s]
HELD = 0.25  # a pose held longer stands still [s]
AROUND = 0.5  # this long to either side [s]


def found(gait: R) -> R:
    """The recording with a cut wherever one of its walkers jumps, and sentences that say so."""
    jump, warnings = {(sample, walker) for sample, walker in gait.jump.tolist()}, list[str]()
    for w, name in enumerate(gait.walker_name):
        parts = np.flatnonzero(gait.limb_walker[gait.part_limb] == w)
        if not len(parts):
            continue
        feet = parts[np.unique(gait.part_limb[parts], return_index=True)[1]]  # the first part of each
        sole = max(float(np.linalg.norm(gait.soles[p].vertices, axis=1).max()) for p in parts)
        seen: list[Jump] = []
        for first, after in gait.stays(w):
            seen += [
                (first + a, first + b, size)
                for a, b, size in between(
                    gait.time[first:after],
                    gait.com[w, first:after],
                    gait.pose[feet, first:after, :3],
                    gait.frame_rate,
                    gait.time[0],
                    sole,
                )
            ]
        for a, b, _ in seen:
            jump.update((sample, w) for sample in range(a + 1, b + 1))
        warnings += sentences(name, [(gait.frame(a), gait.frame(b), size) for a, b, size in seen])
    if len(jump) == len(gait.jump):
        return gait
    cut = np.union1d(gait.cut, [sample for sample, _ in jump])
    return replace(gait, cut=cut, jump=np.array(sorted(jump)), warnings=gait.warnings + tuple(warnings))


def sentences(name: str, jumps: Sequence[tuple[float, float, float]]) -> list[str]:
    """What is told of jumps (frame before, frame after, metres)."""
    if not jumps:
        return []
    a, b, size = max(jumps, key=lambda each: each[2])
    first = f"{name} jumps {size:.2g} m between frames {round(a, 2):g} and {round(b, 2):g}"
    if len(jumps) == 1:
        return [f"{first}: taken as a cut, over which nothing moves."]
    return [f"{first}, and {len(jumps) - 1} more times elsewhere: taken as cuts, over which nothing moves."]


def alone(count: int, cut: ArrayLike) -> np.ndarray:
    """Samples (count,) that are a piece of their own: a pose from which no contact can be judged."""
    ends = np.concatenate([[0], np.asarray(cut, int), [count]])
    single = np.zeros(count, bool)
    single[ends[:-1][np.diff(ends) == 1]] = True
    return single & (count > 1)


def between(
    time: np.ndarray, com: np.ndarray, feet: np.ndarray, frame_rate: float, start: float, min_leg: float = 0.0
) -> list[Jump]:
    """Jumps of one walker: [(last sample before, first sample after, how far [m])], rising.

    time (T,) [s], com (T, 3), feet (L, T, 3) [m]; start: when a frame begins [s]; min_leg: legs are no shorter
    [m]. An animation that was looked at more often than once a frame spreads a jump over the samples of a frame:
    steps of frames are measured, too. One whose keys lie between frames spreads it over two of them, where each half is
    like the other: so are steps of two frames, as long as those tell what bodies do.
    """
    if len(time) < 3:
        return []
    leg = max(float(np.median(np.linalg.norm(com - feet, axis=-1).max(axis=0))), min_leg)
    runs = _frames(time, frame_rate, start)
    jumps = [
        _at_once(com, int(frames[a]), int(frames[b]), size)
        for frames in (runs if len(runs) != 1 or len(runs[0]) < len(time) else ())
        for a, b, size in _steps(time[frames], com[frames], feet[:, frames], leg)
    ]
    for _ in range(2):  # what a jump leaves on its other side may be one, too
        ends = [0, *(sample for a, b, _ in sorted(jumps) for sample in (a + 1, b)), len(time)]
        more = []
        for first, after in zip(ends[:-1:2], ends[1::2]):  # between them
            part = slice(first, after)
            more += [(first + a, first + b, size) for a, b, size in _steps(time[part], com[part], feet[:, part], leg)]
        jumps += more
    halves = [frames[odd::2] for frames in runs for odd in (0, 1)]
    for pairs in halves if 2.0 / frame_rate < COARSE + 1e-6 else ():
        for k, after, size in _steps(time[pairs], com[pairs], feet[:, pairs], leg):
            a, b, size = _at_once(com, int(pairs[k]), int(pairs[after]), size)
            if not any(a < other[1] and other[0] < b for other in jumps):
                jumps.append((a, b, size))
    return sorted(jumps)


def _frames(time: np.ndarray, frame_rate: float, start: float) -> list[np.ndarray]:
    """Samples that whole frames show, in runs of frames that follow each other."""
    at = (time - start) * frame_rate
    shown = np.flatnonzero(abs(at - np.round(at)) < 1e-3)
    return np.split(shown, np.flatnonzero(np.diff(np.round(at[shown])) > 1.0) + 1)


def _at_once(com: np.ndarray, a: int, b: int, size: float) -> Jump:
    """A jump from a sample to a later one, between two of them only where most of the displacement lies."""
    path = np.linalg.norm(np.diff(com[a : b + 1], axis=0), axis=1)
    if path.max() > AT_ONCE * np.linalg.norm(com[b] - com[a]):
        a += int(path.argmax())
        b = a + 1
    return a, b, size


def _steps(time: np.ndarray, com: np.ndarray, feet: np.ndarray, leg: float) -> list[Jump]:
    """Jumps from one sample that shows motion to the next."""
    if len(time) < 3 or not leg > 0.0:
        return []
    at, held = _moving(time, np.concatenate([com[None], feet]), leg)
    time, com, feet = time[at], com[at], feet[:, at]
    if len(time) < 3:
        return []
    step = np.minimum(np.diff(time), held)
    path = np.linalg.norm(np.diff(com, axis=0), axis=1)
    paths = np.linalg.norm(np.diff(feet, axis=1), axis=2)
    body = _leaps(step, com, leg, *SWAY["com"]) & _majority(paths > STAYS * path)
    limbs = _majority([_leaps(step, foot, leg, *SWAY["foot"]) for foot in feet])
    return [
        (int(at[k + 1] - 1), int(at[k + 1]), float(np.median([path[k], *paths[:, k]])))
        for k in np.flatnonzero(body | limbs)
    ]


def _majority(limbs: ArrayLike) -> np.ndarray:
    """Where more than half of the limbs (L, n) do so."""
    limbs = np.asarray(limbs)
    return np.asarray(np.sum(limbs, axis=0) > 0.5 * len(limbs))


def _moving(time: np.ndarray, places: np.ndarray, leg: float) -> tuple[np.ndarray, float]:
    """(samples that tell of motion, how long a pose is held [s]): an animation on twos tells every other one."""
    moved = np.abs(np.diff(places, axis=1)).max(axis=(0, 2)) > 1e-9 * leg
    new = np.concatenate([[0], np.flatnonzero(moved) + 1])
    held = float(min(np.median(np.diff(time[new])), HELD)) if len(new) > 1 else 0.0
    last = np.append(new[1:], len(time)) - 1  # of each pose
    long = time[last] - time[new] > max(held, np.diff(time).min()) * (1 + 1e-6)
    return np.union1d(new, last[long]), float(max(held, np.diff(time).min()))


def _leaps(step: np.ndarray, at: np.ndarray, leg: float, lengths: float, falls: float) -> np.ndarray:
    """Where places (T, 3) go farther in a step (T - 1,) [s] than a body does."""
    run = np.diff(at, axis=0)
    before, after = np.concatenate([run[1:2], run[:-1]]), np.concatenate([run[1:], run[-2:-1]])
    change = after - before
    share = ((run - before) * change).sum(axis=1) / np.maximum((change * change).sum(axis=1), 1e-300)
    over = np.linalg.norm(run - before - np.clip(share, 0.0, 1.0)[:, None] * change, axis=1)
    out = over > lengths * leg + np.minimum(falls * GRAVITY * step**2, MAX_FALL * leg)
    far = np.linalg.norm(run, axis=1)
    for k in np.flatnonzero(out):
        around_steps = max(int(AROUND / step[k]), 2)
        around = np.concatenate([far[max(k - around_steps, 0) : k], far[k + 1 : k + 1 + around_steps]])
        out[k] = min(over[k], far[k]) > BEYOND * np.quantile(around, 0.9)
    return np.asarray(out)
