"""Which walkers can meet in a span of time, and on which tiles: they make a component, which no other touches.

    walk, loads --Treads--> tiles that a limb can change from sample to sample --components()--> who is pressed together

A limb changes the ground around its soles, and where it lifts all that it stood on: so far as `margin` says. Nobody
knows before how far loose soil slides; whoever presses a component sees whether it went beyond its tiles, and says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..ground.options import SimulationOptions
from ..ground.sim import TILE
from ..ground.soil_keys import AnySoil, rows
from ..loads.force import PRESSES, FootForce
from ..motion import tracks
from ..motion.gait import Gait

AROUND = 0.35  # of ground that a step can change beside its soles, at least [m]
SETTLED = 72  # .. and cells in which loose soil comes to rest, see native/sim/sim_slide.c
CARVED = 0.7  # .. more, where walkers carve
CRUST = 1.0  # .. where a crust breaks
BULGES = 4.0  # .. of the width of a bulge, see native/sim/sim_plan.c


def margin(soils: Sequence[AnySoil], options: SimulationOptions, carves: bool, cell: float) -> float:
    """How far beside its soles a step is taken to change the ground [m]."""
    every = [row for soil in soils for row in rows(soil)]
    bulge = max(min(BULGES * row.heave, 1.0) for row in every)
    rim = options.rim_width if options.heap == "paper" else 0.0
    crust = CRUST if any(row.crust_depth > 0.0 for row in every) else 0.0
    return AROUND + SETTLED * cell + 3.0 * max(bulge, rim) + crust + (CARVED if carves else 0.0)


def why_chained(soils: Sequence[AnySoil], plants: Sequence[object]) -> str:
    """Why all who walk count as one component; empty: they do not."""
    if plants:
        return "plants go on moving where nobody walks any more"
    if any(row.flow_time > 0.0 for soil in soils for row in rows(soil)):
        return "the soil goes on sliding where nobody walks any more"
    if any(row.adhesion > 0.0 for soil in soils for row in rows(soil)):
        return "soil sticks to soles, of which all of it is counted"
    return ""


@dataclass(eq=False)
class Component:
    """Walkers that can meet in a window, and the tiles they can change."""

    walkers: list[int]
    tiles: np.ndarray  # (n, 2), rising by (y, x)
    steps: int = 0  # of a limb that presses, from sample to sample
    owner: int = 0  # tile of the job whose task presses it
    tile_from: np.ndarray = field(default_factory=lambda: np.zeros((0, 2), np.int32))  # (window, tile) each was last in
    walker_from: np.ndarray = field(default_factory=lambda: np.zeros((0, 2), np.int32))


def rising(tiles: np.ndarray) -> np.ndarray:
    """Each of some tiles (n, 2) once, rising by (y, x)."""
    return np.unique(np.asarray(tiles, np.int64).reshape(-1, 2)[:, ::-1], axis=0)[:, ::-1]


class Treads:
    """Which tiles each limb of a walk can change in each of its steps."""

    def __init__(self, gait: Gait, loads: FootForce, cell: float, origin: tuple[float, float], margin: float) -> None:
        radius = np.array([np.linalg.norm(sole.vertices.astype(float), axis=1).max() for sole in gait.soles]) + margin
        limb_of, side, low = np.asarray(gait.part_limb), cell * TILE, np.array([*origin, *origin])
        self.walkers = len(gait.mass)
        self._steps: list[list[tuple[np.ndarray, np.ndarray, np.ndarray]]] = [[] for _ in range(self.walkers)]
        for parts, first, touching in tracks.blocks(loads.touching):
            for limb in np.unique(limb_of[parts]).tolist():
                mine = np.flatnonzero(limb_of[parts] == limb)
                down = (touching[mine] == PRESSES).any(axis=0)
                steps = np.flatnonzero(down[:-1] | down[1:])
                if not len(steps):
                    continue
                at = np.asarray(gait.pose[parts[mine], first : first + touching.shape[1]])[..., :2]
                wide = radius[parts[mine], None, None]
                box = np.concatenate([(at - wide).min(axis=0), (at + wide).max(axis=0)], axis=1)
                box = np.concatenate(
                    [np.minimum(box[steps, :2], box[steps + 1, :2]), np.maximum(box[steps, 2:], box[steps + 1, 2:])],
                    axis=1,
                )
                begins = np.r_[True, np.diff(steps) > 1]  # of stances
                stance = steps[begins][np.cumsum(begins) - 1]
                walker = int(np.asarray(gait.limb_walker)[limb])
                tile = np.floor((box - low) / side).astype(np.int64)
                self._steps[walker].append((steps + first, stance + first, tile))

    def tiles(self, walker: int, first: int, after: int) -> tuple[np.ndarray, int]:
        """(tiles (n, 2) of a walker in the steps first..after-1 and the stances that these go on with or end, how many
        steps of its limbs press)."""
        boxes, count = [np.zeros((0, 4), np.int64)], 0
        for steps, stance, tile in self._steps[walker]:
            low, high = np.searchsorted(steps, [first - 1, after])
            if low < high:
                low = int(np.searchsorted(steps, stance[low]))
                boxes.append(tile[low:high])
                count += int((steps[low:high] >= first).sum())
        found: set[tuple[int, int]] = set()
        for x0, y0, x1, y1 in np.unique(np.concatenate(boxes), axis=0).tolist():
            found.update((x, y) for y in range(y0, y1 + 1) for x in range(x0, x1 + 1))
        return rising(np.array(sorted(found), np.int64)), count

    def components(self, first: int, after: int) -> list[Component]:
        """Who presses in the steps first..after-1, with all they can meet there."""
        root: dict[int, int] = {}

        def top(walker: int) -> int:
            while root[walker] != walker:
                walker = root[walker]
            return walker

        on: dict[tuple[int, int], int] = {}
        of: dict[int, Any] = {}
        for walker in range(self.walkers):
            tiles, count = self.tiles(walker, first, after)
            if not len(tiles):
                continue
            root[walker] = walker
            of[walker] = (tiles, count)
            for tile in map(tuple, tiles.tolist()):
                other = on.setdefault(tile, walker)
                a, b = sorted((top(other), top(walker)))
                root[b] = a
        found: dict[int, list[int]] = {}
        for walker in of:
            found.setdefault(top(walker), []).append(walker)
        return [
            Component(
                walkers,
                rising(np.concatenate([of[walker][0] for walker in walkers])),
                sum(of[walker][1] for walker in walkers),
            )
            for walkers in found.values()
        ]
