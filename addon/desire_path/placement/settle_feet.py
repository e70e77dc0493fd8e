"""Feet let down into the prints they press, and the body with them. MODEL 4.4

Gait, its loads, the pressed ground over time ---depth under each limb---> eased in the air ---> Gait in its prints
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np

from ..errors import DesirePathError
from ..ground import maps
from ..loads.below import Heights
from ..loads.force import FootForce
from ..loads.plot import foot_loads
from ..motion import rotation
from ..motion.gait import Gait
from ..motion.tracks import Array

PRESSED = 1e-3  # ground pressed less than this is not under a sole [m]
FIRM = 0.25  # cells a sole covers in part are pressed less than this share of what is usual under it [-]
LOWEST = 0.1  # a sole rests on the ground by this share of its points over pressed ground [-]
RISE = 0.2  # a foot that has left the ground comes up again over this [s]
BODY = 0.5  # the body follows its feet smoothed over this [s]


class Pages(Protocol):
    """Where in a sparse picture cells are shown, as bake.atlas.Atlas tells it."""

    def find(self, i: np.ndarray, j: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...


class Frames(Protocol):
    """Where the frames of a bake lie and what they show, as FrameIndex has it."""

    frame_start: int
    frames: int
    x0: float
    y0: float
    cell: float
    nx: int
    ny: int

    @property
    def atlas(self) -> Pages | None: ...

    def path(self, number: int) -> str: ...


class Film:
    """The frames of a bake as ground that changes: trail_NNNN.exr, looked up by scene frame."""

    def __init__(self, index: Frames) -> None:
        self.index = index
        self.number: int | None = None
        self.planes: Mapping[str, np.ndarray] = {}

    def at(self, frame: float, xy: np.ndarray) -> np.ndarray:
        """Height change and compression (2, n) [m] at a scene frame and places (n, 2); zero beside it."""
        index = self.index
        number = min(max(int(round(frame)) - index.frame_start + 1, 0), index.frames)
        if number != self.number:
            self.planes = maps.read(index.path(number)).planes
            self.number = number
        i = np.floor((xy[:, 0] - index.x0) / index.cell).astype(int)
        j = np.floor((xy[:, 1] - index.y0) / index.cell).astype(int)
        inside = (i >= 0) & (i < index.nx) & (j >= 0) & (j < index.ny)
        if index.atlas is not None:
            j, i, there = index.atlas.find(i, j)
            inside &= there
        out = []
        for name in ("R", "B"):
            values = np.zeros(len(xy))
            values[inside] = self.planes[name][j[inside], i[inside]]
            out.append(values)
        return np.array(out)


class Films:
    """The same of several grounds that were baked together: each place is seen where it is pressed deepest."""

    def __init__(self, films: Sequence[Film]) -> None:
        self.films = films

    def at(self, frame: float, xy: np.ndarray) -> np.ndarray:
        """As Film.at()."""
        seen = np.array([film.at(frame, xy) for film in self.films])
        deepest: np.ndarray = np.take_along_axis(seen, seen[:, 1].argmax(axis=0)[None, None], axis=0)[0]
        return deepest


def depths(gait: Gait, touching: Array, film: Film | Films, rest_height: Heights) -> np.ndarray:
    """How far each limb has to come down to rest on the ground it has pressed (L, T) >= 0 [m]; NaN in the air.

    touching (P, T) as loads have it; film: a Film; rest_height: of the ground before the walk, at (n, 2).
    """
    out = np.full((len(gait.limb_walker), len(gait.time)), np.nan)
    turns = rotation.matrix(gait.pose[..., 3:])
    for t in range(len(gait.time)):
        for limb in range(len(out)):
            parts = np.flatnonzero((gait.part_limb == limb) & (touching[:, t] != 0))
            if not len(parts):
                continue
            points = np.concatenate([gait.soles[p].vertices @ turns[p, t].T + gait.pose[p, t, :3] for p in parts])
            change, pressed = film.at(gait.frame(t), points[:, :2])
            under = (pressed > PRESSED) & (change < 0.0)
            if not under.any():
                out[limb, t] = 0.0
                continue
            firm = under & (pressed > FIRM * np.median(pressed[under]))
            gap = points[firm, 2] - rest_height(points[firm, :2]) - change[firm]
            out[limb, t] = max(float(np.nanquantile(gap, LOWEST)), 0.0)
    return out


def eased(depth: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Depths of limbs (L, T), carried on in the air: up again after a contact, from nothing before the next."""
    out = np.zeros_like(depth)
    for row, known in zip(out, depth):
        down = np.flatnonzero(np.isfinite(known))
        if not len(down):
            continue
        last = np.full(len(time), -1)
        last[down] = down
        last = np.maximum.accumulate(last)
        gone = np.where(last >= 0, time - time[last], np.inf)
        share = np.clip(1.0 - gone / RISE, 0.0, 1.0)
        row[:] = np.where(last >= 0, known[last], 0.0) * share * share * (3.0 - 2.0 * share)
    return out


def into_prints(gait: Gait, loads: FootForce, film: Film | Films, rest_height: Heights) -> Gait:
    """The same walk, its feet as deep in the ground as the prints they have pressed by then, as a new Gait."""
    depth = depths(gait, loads.touching, film, rest_height)
    if not (depth > 0.0).any():
        raise DesirePathError("No foot stands on ground that is pressed: bake the trail of this walk first.")
    down = np.concatenate([eased(depth[:, a:b], gait.time[a:b]) for a, b in gait.pieces()], axis=1)
    pose, com = gait.pose.copy(), gait.com.copy()
    pose[..., 2] -= down[gait.part_limb]
    force, _ = foot_loads(gait, loads)
    count = max(1, int(round(BODY / max(np.median(np.diff(gait.time)), 1e-9)))) if len(gait.time) > 1 else 1
    for w in range(len(gait.mass)):
        limbs = gait.limb_walker == w
        weight = np.maximum(force[limbs], 0.0)
        total = weight.sum(axis=0)
        mean = np.where(total > 0.0, (weight * down[limbs]).sum(axis=0) / np.maximum(total, 1e-12), np.nan)
        known = np.isfinite(mean)
        if known.any():
            sample = np.arange(len(mean))
            mean = np.interp(sample, sample[known], mean[known])
            com[w, :, 2] -= gait.by_piece(lambda part: _smooth(part, count), mean)
    return replace(gait, pose=pose, com=com)


def _smooth(values: np.ndarray, count: int) -> np.ndarray:
    """The mean over `count` samples about each, twice."""
    for _ in range(2):
        padded = np.pad(values, count // 2, mode="edge")
        values = np.lib.stride_tricks.sliding_window_view(padded, 2 * (count // 2) + 1).mean(axis=1)
    return values
