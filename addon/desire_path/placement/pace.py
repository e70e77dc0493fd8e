"""What goes along a curve and stays on the ground: when it is where, how high that is, how it slopes. MODEL 3.8"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ..errors import DesirePathError
from ..loads.below import GroundHeights, heights_of
from ..motion import rotation

Land: TypeAlias = Callable[[np.ndarray], np.ndarray]  # places (n, 2) -> heights (n,), NaN where there is none [m]


class Pace:
    """A speed that changes evenly along the path, from its start to its end [m/s]."""

    def __init__(self, length: float, start: float, end: float) -> None:
        self.length, self.start, self.end = length, start, end
        more = (end - start) / length
        self.more = more if abs(end - start) > 1e-6 * start else 0.0  # [1/s]

    def time(self, s: np.ndarray | float) -> np.ndarray:
        """When it is there [s]; ds/dt = start + more s."""
        return np.asarray(np.log1p(self.more * s / self.start) / self.more if self.more else np.divide(s, self.start))

    def place(self, time: np.ndarray) -> np.ndarray:
        """Where it is then [m]."""
        return np.asarray(self.start * np.expm1(self.more * time) / self.more if self.more else self.start * time)

    def spacings(self, spacing: float) -> float:
        """How many spacings there are, each sqrt(speed / start) times as long as the first. MODEL 3.8"""
        first, last = math.sqrt(self.start), math.sqrt(self.end)
        return self.length * 2.0 * first / ((first + last) * spacing)

    def marks(self, spacing: float, count: int | None) -> np.ndarray:
        """Where marks lie (n,) [m]; as many as fit, or so many."""
        k = np.arange(int(self.spacings(spacing) + 1e-6) + 1 if count is None else count)
        first = math.sqrt(self.start)
        root = first + self.more * k * spacing / (2.0 * first)  # of the speed at each
        return np.asarray(k * spacing * (root + first) / (2.0 * first))


def ahead_of(heading: np.ndarray) -> np.ndarray:
    """Directions (n, 2) of headings."""
    return np.stack([np.cos(heading), np.sin(heading)], axis=-1)


def left_of(heading: np.ndarray) -> np.ndarray:
    """Directions (n, 2) to the left of headings."""
    return np.stack([-np.sin(heading), np.cos(heading)], axis=-1)


def land_of(ground: GroundHeights) -> Land:
    """Heights of places (n, 2), a sentence where there is no ground."""
    given = heights_of(ground)
    if not callable(given):
        level = np.asarray(0.0 if given is None else given, float)
        if level.ndim or not np.isfinite(level):
            raise DesirePathError("A track's ground is a height, a function of places (n, 2), or a Simulation.")
        return lambda at: np.full(len(at), float(level))
    return lambda at: np.asarray(given(np.ascontiguousarray(at)), float)


def slope_of(land: Land, at: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Heights (n,) and slopes (n, 2) of the ground at places; level where it ends so near."""
    high = land(at)
    if not np.isfinite(high).all():
        x, y = at[int(np.argmin(np.isfinite(high)))]
        raise DesirePathError(
            f"The track leaves the ground at x {x:.3g} m, y {y:.3g} m: keep the curve on it, or make it larger."
        )
    slope = [(land(at + by) - land(at - by)) / (2.0 * step) for by in ((step, 0.0), (0.0, step))]
    return high, np.nan_to_num(np.stack(slope, axis=1))


def laid(place: np.ndarray, heading: np.ndarray, land: Land, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3) and rotations (n, 3, 3) of what lies flat on the ground."""
    high, slope = slope_of(land, place, step)
    up = rotation.unit(np.column_stack([-slope, np.ones(len(slope))]))
    flat = ahead_of(heading)
    ahead = rotation.unit(np.column_stack([flat, (flat * slope).sum(axis=1)]))
    return np.column_stack([place, high]), np.stack([ahead, np.cross(up, ahead), up], axis=-1)
