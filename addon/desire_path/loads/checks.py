"""What is odd about how a recording stands on its ground, in sentences."""

from __future__ import annotations

import numpy as np

from ..errors import DesirePathError
from ..motion.gait import Gait
from .force import ELSEWHERE, GRAVITY, PRESSES

MEAN_FORCE = (0.9, 1.1)  # what a believable clip's mean vertical force is within [body weights]
# A person's feet that stand slide no faster than a share of how fast it goes, for few samples smear who runs; recorded
# walks slide at 0.04 to 0.1 m/s, a jump at 0.26 and a run at 0.32 where they have 8 samples a second
SLIDE_SHARE = 0.13
SLIDE_LEAST, SLIDE = 0.27, 0.4  # but at this by any speed, and never faster than that [m/s]
STILL = 0.25  # who stands moves no foot faster [m/s]
HOVER = 0.1  # a person's feet that stand do not do so farther from the ground [m]
TELLING = 0.5  # who stands there for less is not told of [s]
# Feet push along the ground with no more than this; recorded walks, runs, landings and a step off a stair need 0.66
PUSH = 1.2  # [body weights, and of what the feet carry at the time]
FALL = 2.0  # who is in the air falls no harder [g]
SPAN = 1.0 / 24.0  # to either side of where a person's fall is measured, or a sample if that is longer [s]


class Sunk(DesirePathError):
    """A walker is under the ground all the time."""


def sinks(gait: Gait, below: np.ndarray) -> None:
    """Refuse a walker that is under the ground all the time."""
    ground = np.nanmedian(below) if np.isfinite(below).any() else -np.inf
    for w in range(len(gait.mass)):
        if gait.com[w, :, 2].max() < ground:
            raise Sunk(
                f"{gait.walker_name[w]} is below the ground all the time, whose highest "
                "faces count: move the ground down or the walker up, or take roofs "
                "out of the ground."
            )


def never(name: str) -> str:
    """What is told of a walker that touches nothing."""
    return f"{name} never touches the ground: check its feet, its scale and the frame range."


def hovers(gait: Gait, touching: np.ndarray, clearance: np.ndarray, size: float) -> list[str]:
    """A sentence for each walker whose feet stand far from the ground."""
    warnings = []
    part = gait.point_part
    for w, name in enumerate(gait.walker_name):
        mine = (gait.limb_walker[gait.part_limb[part]] == w) & touching[part].any(axis=1)
        height = float(np.median(clearance[mine])) if mine.any() else 0.0
        if height > HOVER * size:
            warnings.append(f"{name} walks {height:.2f} m above the ground: lower it or raise the ground.")
        elif height < -HOVER * size:
            warnings.append(f"{name} walks {-height:.2f} m deep in the ground: raise it or lower the ground.")
    return warnings


def slides(gait: Gait, places: np.ndarray, touching: np.ndarray, size: float) -> list[str]:
    """A sentence for each walker whose feet slide while they carry: it walks in place."""
    warnings: list[str] = []
    if len(gait.time) < 3:
        return warnings
    rush = np.linalg.norm(np.gradient(places[..., :2], gait.time, axis=1), axis=2)
    for part in np.flatnonzero(np.array(gait.part_name) == "body"):  # what may roll is as fast as where it stands
        rush[gait.point_part == part] = rush[gait.point_part == part].min(axis=0)
    on, pace = touching[gait.point_part] != 0, np.sqrt(size)
    lasts = gait.time[-1] - gait.time[0]
    for w, name in enumerate(gait.walker_name):
        goes = np.linalg.norm(np.diff(gait.com[w, :, :2], axis=0), axis=1).sum() / lasts
        limit = min(max(SLIDE_SHARE * goes, SLIDE_LEAST * pace), SLIDE * pace)
        own = gait.limb_walker[gait.part_limb[gait.point_part]] == w
        mine = own[:, None] & on
        still = (rush[own] < STILL * pace).all(axis=0)  # all of it stands: no step is taken
        mine = mine & ~still if (mine & ~still).any() else mine
        speed = float(np.median(rush[mine])) if mine.any() else 0.0
        if speed > limit:
            along = np.hypot(*(gait.com[w, -1] - gait.com[w, 0])[:2]) / lasts
            warnings.append(
                f"The feet of {name} slide at {speed:.1f} m/s while they stand"
                + (
                    f", though it goes at {along:.1f} m/s: make it faster or slower, until they stand still."
                    if along > STILL * pace
                    else ": if its clip walks in place, move the character forward at that speed."
                )
            )
    return warnings


def pushes(gait: Gait, person: Gait, force: np.ndarray) -> list[str]:
    """A sentence for each walker whose feet would have to push as no soles hold: it is moved by something else.

    person: the recording as of a person's size, on which the forces are (P, T, 3) [N]
    """
    warnings = []
    for w, mass in enumerate(person.mass):
        total = force[_parts_with_feet(gait, w)].sum(axis=0) / (mass * GRAVITY)
        push = np.linalg.norm(total[:, :2], axis=1)
        push[push <= PUSH * np.maximum(-total[:, 2], 1.0)] = 0.0
        if push.any():
            warnings.append(
                f"The feet of {gait.walker_name[w]} would have to push along the ground with {push.max():.1f} times "
                f"its weight near frame {gait.frame(push.argmax()):.0f}, more than soles hold: a pose that is blended "
                "in, or something else that moves it; make that slower, or leave those frames out."
            )
    return warnings


def falls(gait: Gait, touching: np.ndarray, size: float) -> list[str]:
    """A sentence for each walker that comes down harder than things fall.

    touching: of parts at the recording's own samples (P, T), since what is put between them swings over where a fall
    ends; size: of the walkers, a person's is 1
    """
    warnings: list[str] = []
    count = len(gait.time)
    lag = max(int(round(SPAN * np.sqrt(size) / np.median(np.diff(gait.time)))), 1) if count > 1 else 1
    if count <= 2 * lag:
        return warnings
    before, at, after = slice(None, -2 * lag), slice(lag, -lag), slice(2 * lag, None)
    first, then = gait.time[at] - gait.time[before], gait.time[after] - gait.time[at]
    for w, name in enumerate(gait.walker_name):
        parts, z = _parts_with_feet(gait, w), gait.com[w, :, 2]
        fall = ((z[at] - z[before]) / first - (z[after] - z[at]) / then) / (0.5 * (first + then) * GRAVITY)
        on = (touching[parts] == PRESSES).any(axis=0)  # who stands on a box may drop off it
        fall[on[before] | on[at]] = 0.0  # what stops it at the end makes it no harder
        if len(parts) and fall.max() > FALL:
            warnings.append(
                f"{name} falls {fall.max():.1f} times as hard as gravity draws it near frame "
                f"{gait.frame(lag + fall.argmax()):.0f}, and presses the deeper: a pose that is blended in, or a fall "
                "that is too short; make that slower, or leave those frames out."
            )
    return warnings


def _parts_with_feet(gait: Gait, walker: int) -> np.ndarray:
    """Parts (n,) of a walker; none of a body of one piece, which others may push."""
    parts = np.flatnonzero(gait.limb_walker[gait.part_limb] == walker)
    return parts if any(gait.part_name[part] != "body" for part in parts) else parts[:0]


def off(gait: Gait, places: np.ndarray, touching: np.ndarray, beside: np.ndarray) -> list[str]:
    """A sentence for each walker that steps beside the ground: how often, and how much ground its steps need.

    places: of the points (C, T, 3) [m]; beside: where the whole limb of a part is beside the ground (P, T)
    """
    warnings = []
    for w, name in enumerate(gait.walker_name):
        steps = away = 0
        for limb in np.flatnonzero(gait.limb_walker == w):
            mine = gait.part_limb == limb
            on, out = (touching[mine] != 0).any(axis=0), ((touching != 0) & beside)[mine].any(axis=0)
            edges = np.flatnonzero(np.diff(np.r_[False, on, False]))
            steps += len(edges) // 2
            away += sum(bool(out[a:b].any()) for a, b in zip(edges[::2], edges[1::2]))
        if away:
            own = (gait.limb_walker[gait.part_limb[gait.point_part]] == w)[:, None]
            x, y = np.ptp(places[own & (touching[gait.point_part] != 0)][:, :2], axis=0)
            warnings.append(
                f"{away} of {steps} steps of {name} land beside the ground or reach over its edge, and leave no print "
                f"there: make the ground larger, or move it under the walk, which takes up {x:.1f} x {y:.1f} m."
            )
    return warnings


def _cycle(on: np.ndarray, count: int) -> tuple[int, int]:
    """First and last sample of whole strides of one walker's limbs (L, T); the whole clip if none."""
    best = (0, count - 1)
    longest = 0
    for row in on:
        down = np.flatnonzero((row[1:] != 0) & (row[:-1] == 0)) + 1
        if len(down) > 1 and down[-1] - down[0] > longest:
            longest, best = down[-1] - down[0], (down[0], down[-1])
    return best


def weigh(gait: Gait, touching: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Mean vertical force in body weights over whole strides, and a sentence where it is odd."""
    mean, warnings = np.ones(len(gait.mass)), list[str]()
    count = len(gait.time)
    for w, mass in enumerate(gait.mass):
        limbs = np.flatnonzero(gait.limb_walker == w)
        parts = np.flatnonzero(np.isin(gait.part_limb, limbs))
        on = np.array([touching[gait.part_limb == limb].any(axis=0) for limb in limbs])
        if not on.any():
            warnings.append(never(str(gait.walker_name[w])))
            mean[w] = 0.0
            continue
        if count < 5:
            continue
        first, last = _cycle(on, count)
        total = -force[parts, first : last + 1, 2].sum(axis=0) / (mass * GRAVITY)
        # over whole strides the body neither gains nor loses speed; elsewhere it may
        z, lag = gait.com[w, :, 2], max(1, int(round(0.05 / (gait.time[1] - gait.time[0]))))
        slope = [
            (z[min(k + lag, count - 1)] - z[max(k - lag, 0)])
            / (gait.time[min(k + lag, count - 1)] - gait.time[max(k - lag, 0)])
            for k in (first, last)
        ]
        gain = (slope[1] - slope[0]) / ((gait.time[last] - gait.time[first]) * GRAVITY)
        mean[w] = np.mean(total) - gain
        if not MEAN_FORCE[0] <= mean[w] <= MEAN_FORCE[1]:
            warnings.append(
                f"The feet of {gait.walker_name[w]} carry {mean[w]:.2f} of its weight on "
                "average: check the mass centre, the scale and whether feet float."
            )
    return mean, warnings


def elsewhere(gait: Gait, over: np.ndarray, touching: np.ndarray, max_height: float, size: float) -> list[str]:
    """Mark parts that stand farther over the ground than `max_height` [m]; sentences about who does.

    over: height of each contact point over the ground, less its clearance (K, T) [m]
    """
    lowest = np.stack(
        [
            np.nanmin(np.where(np.isfinite(over), over, np.inf)[gait.point_part == part], axis=0)
            for part in range(len(gait.part_limb))
        ]
    )
    up = (touching == PRESSES) & (lowest > max_height)
    touching[up] = ELSEWHERE
    warnings = []
    for w, name in enumerate(gait.walker_name):
        when = up[gait.limb_walker[gait.part_limb] == w].any(axis=0)
        edges = np.flatnonzero(np.diff(np.concatenate([[0], when, [0]])))
        if len(edges) and np.diff(edges)[::2].max() >= TELLING * np.sqrt(size) * (gait.rate() or 1.0):
            high = float(np.median(lowest[gait.limb_walker[gait.part_limb] == w][:, when].min(axis=0)))
            warnings.append(
                f"{name} stands on something else than the ground, of which there is no print: about {high:.2g} "
                f"m over it, first at frame {gait.frame(when.argmax()):.0f}; make that a ground if it is to "
                "take prints."
            )
    return warnings
