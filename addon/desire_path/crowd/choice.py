"""How walkers choose: fields of times and pull over the ground as it is, and the path of each. MODEL 12.5-12.7

loads --Cover--> costs --arrival--> times --+--descend--> one walker's path
             +-> wear ---pull------> aside -+
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..errors import DesirePathError
from ..paths.arrival import arrival, descend, goal_around
from ..paths.pull import pull
from .scene import Place, Scene
from .stays import Walked, stay

INERTIA = 0.7  # over which length a heading is kept [m]
STRAIGHT = 2.0  # over which length headings err alike [m]
ERRORS = 1024  # steps until they err as at first


@dataclass(frozen=True)
class Passage:
    """Who goes from where to where."""

    number: int  # from 0
    kind: int  # of walkers
    start: int  # place
    goal: int  # place
    aside: tuple[float, float]  # where in the start's circle, of its radius 1
    by: int = -1  # place it visits on its way; -1 = none


def kinds_of(scene: Scene, first: int, count: int) -> list[int]:
    """Which kind of walkers each passage from number `first` on is of; it depends on the seed and the number alone."""
    shares = np.array([kind.share for kind in scene.walkers])
    upto = np.cumsum(shares) / shares.sum()
    chance = [np.random.default_rng([scene.seed, number, 2]).random() for number in range(first, first + count)]
    return np.minimum(np.searchsorted(upto, chance, "right"), len(upto) - 1).tolist()


class Choice:
    """The ground a crowd chooses on, and how.

    blocked: obstacles (ny, nx); free: the lengths of ways over ground that costs 1, from each cell to each place
    """

    def __init__(self, scene: Scene) -> None:
        if sum(place.rate > 0.0 for place in scene.places) < 2:
            raise DesirePathError("Nobody can go anywhere: give at least two places a rate above 0.")
        self.scene = scene
        self.names = [place.name for place in scene.places]
        self.blocked, self.paved, self.level = scene.lie()
        self._goals = [self._goal(place) for place in scene.places]
        even = np.where(self.blocked, np.inf, 1.0).astype(np.float32)
        self.free = [self._times(even, number) for number in range(len(scene.places))]
        self._check_ways()
        rates = np.outer(*(np.array([place.rate for place in scene.places]),) * 2)
        np.fill_diagonal(rates, 0.0)
        self._pairs = np.cumsum(rates.ravel()) / rates.sum()

    def _goal(self, place: Place) -> tuple[np.ndarray, np.ndarray]:
        """Cells around a place, and how far it is from them."""
        scene, at = self.scene, self.scene.inside(place)
        ny, nx = self.blocked.shape
        if not (0.0 <= at[0] < nx * scene.cell and 0.0 <= at[1] < ny * scene.cell):
            raise DesirePathError(f"The place '{place.name}' lies outside the ground: move it, or make that larger.")
        if self.blocked[int(at[1] / scene.cell), int(at[0] / scene.cell)]:
            raise DesirePathError(f"The place '{place.name}' lies in an obstacle: move it.")
        even = np.where(self.blocked, np.inf, 1.0).astype(np.float32)
        return goal_around(even, at, max(place.radius, 1.5 * scene.cell), scene.cell)

    def _times(self, cost: np.ndarray, goal: int) -> np.ndarray:
        cells, far = self._goals[goal]
        return arrival(cost, cells, self.scene.cell, far * cost[cells[:, 1], cells[:, 0]])

    def _check_ways(self) -> None:
        """A sentence for the first two places that no ground is between, or that no path joins."""
        used = [number for number, place in enumerate(self.scene.places) if place.rate > 0.0 or place.visit > 0.0]
        for at, number in enumerate(used):
            for before in used[:at]:
                self._check_apart(self.scene.places[before], self.scene.places[number])
        for number in used[1:]:
            if math.isinf(self._direct(used[0], number)):
                first, other = self.scene.places[used[0]].name, self.scene.places[number].name
                raise DesirePathError(
                    f"No way leads from '{first}' to '{other}', for obstacles lie all around one of them: leave a gap."
                )

    def _check_apart(self, place: Place, other: Place) -> None:
        if math.dist(place.at, other.at) <= max(place.radius, other.radius):
            raise DesirePathError(
                f"The places '{place.name}' and '{other.name}' have no ground between them: move one of them, or make "
                "its radius smaller."
            )

    def direct(self, passage: Passage) -> float:
        """How long the shortest path between its places is, by the one it visits [m]."""
        legs = _legs(passage)
        return sum(self._direct(start, goal) for start, goal in zip(legs, legs[1:]))

    def _direct(self, start: int, goal: int) -> float:
        """From place to place, up to the goal's circle [m]; inf = there is no path."""
        x, y = self.scene.inside(self.scene.places[start])
        time = self.free[goal][int(y / self.scene.cell), int(x / self.scene.cell)]
        return float(time) - self.scene.places[goal].radius

    def passages(self, first: int, count: int) -> list[Passage]:
        """Those from number `first` on; each depends on the seed and its number alone."""
        found = []
        for number, kind in enumerate(kinds_of(self.scene, first, count), first):
            chance = np.random.default_rng([self.scene.seed, number]).random(4)
            pair = min(int(np.searchsorted(self._pairs, chance[0], "right")), len(self._pairs) - 1)
            far, turn = math.sqrt(chance[2]), 2.0 * math.pi * chance[3]
            start, goal = divmod(pair, len(self.scene.places))
            aside = (far * math.cos(turn), far * math.sin(turn))
            found.append(Passage(number, kind, start, goal, aside, self._visited(number, start, goal)))
        return found

    def _visited(self, number: int, start: int, goal: int) -> int:
        """The place that a passage goes by on its way, -1 = none."""
        upto = np.cumsum([place.visit for place in self.scene.places])
        if upto[-1] == 0.0:
            return -1
        by = int(np.searchsorted(upto, np.random.default_rng([self.scene.seed, number, 4]).random(), "right"))
        return by if by < len(upto) and by not in (start, goal) else -1

    def costs(self, load: np.ndarray) -> np.ndarray:
        """Of a metre of each cell, float32 (ny, nx); inf = an obstacle. MODEL 12.6"""
        cost = np.where(self.paved, 1.0, self.scene.ground.cost(load)) * self.level
        return np.where(self.blocked, np.inf, cost).astype(np.float32)

    def wear(self, load: np.ndarray) -> np.ndarray:
        """How worn each cell is, 0 to 1 (ny, nx); obstacles and paved ways are not."""
        return np.where(self.blocked | self.paved, 0.0, 1.0 - self.scene.ground.left(load))

    def ways(self, load: np.ndarray, passages: Iterable[Passage]) -> list[Walked]:
        """The path of each passage from the ground's corner, over the ground as loads tell it. MODEL 12.7"""
        passages = list(passages)
        cost, step = self.costs(load), 0.5 * self.scene.cell
        aside = None
        if self.scene.ground.pull > 0.0:
            aside = pull(self.wear(load), self.scene.cell, self.scene.ground.pull)
        goals = sorted({goal for each in passages for goal in _legs(each)[1:]})
        times = {goal: self._times(cost, goal) for goal in goals}
        turns = self._turns([each.number for each in passages], [each.kind for each in passages], step)
        return [self._passed(each, times, aside, turn, step) for each, turn in zip(passages, turns)]

    def _turns(self, numbers: list[int], kinds: list[int], step: float) -> np.ndarray:
        """How far each step of each walker errs, float32 (walkers, ERRORS) [rad]. MODEL 12.5"""
        chance = np.stack([np.random.default_rng([self.scene.seed, n, 1]).standard_normal(ERRORS) for n in numbers])
        alike = math.exp(-step / STRAIGHT)
        turns = np.empty_like(chance)
        turns[:, 0] = chance[:, 0]
        for k in range(1, ERRORS):
            turns[:, k] = alike * turns[:, k - 1] + math.sqrt(1.0 - alike * alike) * chance[:, k]
        stray = np.radians([self.scene.walkers[kind].stray for kind in kinds])
        return (turns * stray[:, None]).astype(np.float32)

    def _passed(
        self, passage: Passage, times: dict[int, np.ndarray], aside: np.ndarray | None, turn: np.ndarray, step: float
    ) -> Walked:
        """From place to place, with a stay in each that one lingers at."""
        legs = _legs(passage)
        at = self._begin(passage, times[legs[1]])
        chance = np.random.default_rng([self.scene.seed, passage.number, 5])
        parts = []
        for goal in legs[1:]:
            walked = self._walk(at, goal, times[goal], aside, turn, step)
            parts.append((walked, False))
            place, at = self.scene.places[goal], walked[-1]
            if place.linger > 0.0:
                seconds = place.linger * chance.exponential()
                middle = self.scene.inside(place)
                paced = stay(at, middle, place.radius, seconds, chance, functools.partial(self._free, times[goal]))
                parts.append((paced, True))
                at = paced[-1]
            turn = np.roll(turn, -len(walked))
        return Walked(parts)

    def _free(self, time: np.ndarray, points: np.ndarray) -> bool:
        """Whether all places (n, 2) [m] lie where somebody may go."""
        i, j = np.floor(points / self.scene.cell).astype(int).T
        there = (i >= 0) & (j >= 0) & (i < time.shape[1]) & (j < time.shape[0])
        return bool(there.all() and (time[j, i] < math.inf).all())

    def _begin(self, passage: Passage, time: np.ndarray) -> np.ndarray:
        """Where it starts [m]: nobody does in an obstacle or behind one."""
        place = self.scene.places[passage.start]
        at = np.array(self.scene.inside(place))
        for share in (1.0, 0.5):
            aside = at + share * place.radius * np.array(passage.aside)
            if self._free(time, aside[None, :]):
                return aside
        return at

    def _walk(
        self, at: np.ndarray, goal: int, time: np.ndarray, aside: np.ndarray | None, turn: np.ndarray, step: float
    ) -> np.ndarray:
        """From where one is into the circle of a place (n, 2) [m]."""
        place = self.scene.places[goal]
        x, y = at.tolist()
        walked = descend(time, (x, y), self.scene.cell, aside, step, turn=turn, inertia=INERTIA)
        near = np.hypot(*(walked - self.scene.inside(place)).T) <= place.radius
        return walked[: int(np.argmax(near)) + 1] if near.any() else walked


def _legs(passage: Passage) -> list[int]:
    """Places one after the other."""
    return [passage.start, *([passage.by] if passage.by >= 0 else []), passage.goal]
