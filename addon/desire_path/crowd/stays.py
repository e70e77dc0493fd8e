"""The path of one passage: where somebody walks, and where it stays a while. MODEL 12.9. Experimental.

Who lingers goes to a spot in the circle of the place, and takes a pace in any direction now and then; so it wears the
ground as who walks, by the length of its paces.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

EACH = 30.0  # who stays takes a pace in so long [s]
PACE = 0.7  # of this length [m]
TURNS = 12  # directions it looks in for one that is free


@dataclass(eq=False)
class Walked:
    """Parts that follow each other, each begun where the one before ends."""

    parts: Sequence[tuple[np.ndarray, bool]]  # points (n, 2) from the ground's corner [m]; whether it stays there

    @classmethod
    def straight(cls, points: np.ndarray) -> Walked:
        """One without a stay."""
        return cls([(points, False)])

    @property
    def points(self) -> np.ndarray:
        """All of it (n, 2) [m]."""
        return np.concatenate([self.parts[0][0], *(points[1:] for points, _ in self.parts[1:])])

    @property
    def length(self) -> float:
        """How long it is without what is paced where it stays [m]."""
        return sum(float(np.hypot(*np.diff(points, axis=0).T).sum()) for points, stays in self.parts if not stays)

    def thin(self, every: int) -> np.ndarray:
        """Each such point of what is walked, every pace, and the ends of parts (n, 2) [m]."""
        kept = [points[:1] for points, _ in self.parts[:1]]
        for points, stays in self.parts:
            kept.append(points[1:] if stays else np.r_[points[every:-1:every], points[1:][-1:]])
        return np.concatenate(kept)


def stay(
    at: np.ndarray,
    middle: tuple[float, float],
    radius: float,
    seconds: float,
    chance: np.random.Generator,
    free: Callable[[np.ndarray], bool],
) -> np.ndarray:
    """What somebody paces who stays so long in a circle (n, 2) [m], begun where it came in; all of it is `free`."""
    far, turn = radius * math.sqrt(chance.random()), 2.0 * math.pi * chance.random()
    spot = np.add(middle, (far * math.cos(turn), far * math.sin(turn)))
    points = [np.asarray(at, float)]
    if _clear(points[0], spot, free):
        points.append(spot)
    for _ in range(math.floor(seconds / EACH + chance.random())):
        first = 2.0 * math.pi * chance.random()
        for k in range(TURNS):
            angle = first + 2.0 * math.pi * k / TURNS
            to = points[-1] + PACE * np.array([math.cos(angle), math.sin(angle)])
            if math.dist(to, middle) <= radius and _clear(points[-1], to, free):
                points.append(to)
                break
    return np.array(points)


def _clear(a: np.ndarray, b: np.ndarray, free: Callable[[np.ndarray], bool]) -> bool:
    """Whether nothing lies between two places."""
    count = max(math.ceil(math.dist(a, b) / (PACE / 8.0)), 1)
    return free(a + (b - a) * (np.arange(1, count + 1) / count)[:, None])
