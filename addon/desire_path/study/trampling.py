"""The lane experiment: how much of a stand is left where people walk to and fro. Cole 1995, MODEL 7.7

A lane is planted, trodden so many times from end to end, and its cover is read: the mean over its plants of
the share that is not broken, alpha of TRAIL (7). With days of rest every count is a lane of its own, which
grows again before it is read.
"""

from __future__ import annotations

import csv
import math
import numbers
import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from ..core import side_by_side
from ..errors import DesirePathError
from ..files import atomic_file, table
from ..ground.options import SimulationOptions
from ..ground.plants import MAX_PLANTS, Kind, Planting, as_kind, vigour_at
from ..ground.sim import Ground, Simulation
from ..ground.soil import Soil
from ..keywords import fields_of
from ..loads import walker
from ..motion.gait import Gait
from ..motion.scatter import Scatter

WALK = Path(__file__).parents[1] / "walks" / "walk.npz"
PASSES = (25, 75, 200, 500)  # counts of Cole's lanes
MAX_PASSES = 1_000_000_000  # a table may speak of
BEYOND = 0.4  # people walk on so far past both ends [m]
SCATTER = 0.32  # standard deviation of their tracks, in widths of the lane
ENOUGH = 400  # plants that tell a lane's cover to a point or so
DENSER = 2.0  # a lane with fewer may be planted so many times as densely as the kind is
EVEN = 1.2207440846057596 ** -np.arange(1.0, 4.0)  # steps that fill a cube evenly, x^4 = x + 1
DAY = 86400.0  # [s]
Progress: TypeAlias = Callable[[float], object]  # called with 0..1
Row: TypeAlias = tuple[int, float, float]  # passes, cover [per cent], days of rest


@dataclass(frozen=True)
class Lane:
    """A lane that is planted and trodden: where, on what, and who walks there."""

    length: float = 5.0  # [m] 0.5..1000
    width: float = 0.5  # [m] 0.1..100
    mass: float = 75.0  # of each walker [kg] 1..1000
    seed: int = 0  # of the plants and of the walkers' scatter
    soil: Soil | str = "soil"  # a Soil, or a name in SOILS
    cell_size: float = 0.02  # of the ground [m] > 0
    frame_rate: float = 60.0  # of the walk's recording [1/s] > 0
    density: float | None = None  # plants [1/m^2]; None = the kind's own, or up to twice as many if they would be few

    def stand(self, kind: Kind) -> float:
        """Plants of a kind on this lane [1/m^2]."""
        return _density(kind, self.length, self.width, self.density)

    def check(self, kind: Kind) -> None:
        """Refuse a lane that cannot be trodden, naming what is wrong with it."""
        for name, low, high in (("length", 0.5, 1000.0), ("width", 0.1, 100.0), ("mass", 1.0, 1000.0)):
            _check_range(name, getattr(self, name), low, high)
        stand = self.stand(kind)
        if not 0.0 < stand * self.length * self.width <= MAX_PLANTS:
            raise DesirePathError(
                f"A density of {stand:g} plants a m^2 cannot be used for this lane: choose one that "
                f"makes up to {MAX_PLANTS} plants."
            )


USUAL = asdict(Lane())  # its fields by name


def _check_range(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise DesirePathError(f"A {name} of {value:g} cannot be used for a lane: choose {low:g} to {high:g}.")


def walk(mass: float = 75.0) -> Gait:
    """The walk that comes with Desire Path: whole strides that repeat on level ground, of a person of `mass` [kg]."""
    return replace(Gait.load(WALK), mass=np.array([mass])).check()


@fields_of(lane=Lane)
def measure(
    kind: Kind | str,
    *,
    lane: Lane = Lane(),
    passes: Iterable[float] = PASSES,
    rest_days: float = 0.0,
    threads: int = 0,
    progress: Progress | None = None,
) -> list[tuple[int, float]]:
    """[(passes, cover [per cent]), ..] of a lane of one kind, rising.

    passes: counts to read the cover at, whole numbers from 1 on. rest_days: days of growth before every count, 0..1e6.
    threads: 0 = one for each processor. progress: called with 0..1.
    """
    plant, counts = as_kind(kind), _counts(passes)
    lane.check(plant)
    _check_range("rest", rest_days, 0.0, 1e6)
    if not rest_days:
        sim, marks = trodden(plant, counts[-1], lane=lane, threads=threads)
        return list(zip(counts, read_at(sim, [marks[n - 1] for n in counts], marks[-1], progress)))
    shares = dict.fromkeys(counts, 0.0)

    def rested(count: int) -> tuple[int, float]:
        def report(share: float) -> None:
            shares[count] = share
            if progress:
                progress(sum(n * done for n, done in shares.items()) / sum(counts))

        sim, marks = trodden(plant, count, lane=lane, threads=1)
        read_at(sim, marks[-1:], marks[-1], report)
        sim.rest_plants(rest_days * DAY)
        return count, cover(sim)

    return sorted(side_by_side(rested, reversed(counts), threads))


@fields_of(lane=Lane)
def trodden(kind: Kind, passes: int, *, lane: Lane = Lane(), threads: int = 0) -> tuple[Simulation, list[int]]:
    """(Simulation of a planted lane with its walkers loaded, sample after each pass)."""
    ends = [(-BEYOND, 0.0), (lane.length + BEYOND, 0.0)]
    person = walk(lane.mass)
    if lane.frame_rate != person.frame_rate:
        person = replace(person.resample(lane.frame_rate), frame_rate=lane.frame_rate)
    gait = person.along(ends, passes, scatter=Scatter(SCATTER * lane.width), seed=lane.seed)
    plants = planted(kind, lane.length, lane.width, lane.seed, lane.density)
    options = SimulationOptions(threads=threads)
    sim = Simulation(Ground.flat(), lane.soil, lane.cell_size, plants=plants, options=options)
    sim.load(gait, walker.loads(gait))
    return sim, [int(cut) for cut in gait.cut] + [len(gait.time) - 1]


def planted(kind: Kind, length: float, width: float, seed: int, density: float | None = None) -> Planting:
    """The lane's plants: places and vigour fill lane and range evenly, so that few plants tell what many would."""
    count = max(int(round(_density(kind, length, width, density) * length * width)), 1)
    even = (np.random.default_rng([int(seed), count]).random(3) + np.arange(count)[:, None] * EVEN) % 1.0
    roots = np.stack([even[:, 0] * length, (even[:, 1] - 0.5) * width], axis=1)
    return Planting(kind, seed=seed, roots=roots, vigour=vigour_at(even[:, 2]))


def _density(kind: Kind, length: float, width: float, density: float | None) -> float:
    """Plants of a lane [1/m^2]: what was asked for, else the kind's own, or more where those are few to measure by."""
    if density is not None:
        return density
    return kind.density * min(max(ENOUGH / (kind.density * length * width), 1.0), DENSER)


def cover(sim: Simulation) -> float:
    """Mean share of every plant that is not broken [per cent], TRAIL (7)."""
    alpha = np.concatenate([sim.plants_alpha(stand) for stand, _, _ in sim.stands])
    return 100.0 * float(alpha.mean())


def _counts(passes: Iterable[float]) -> list[int]:
    given = list(passes)
    counts = sorted({int(n) for n in given if isinstance(n, numbers.Real) and math.isfinite(n) and n == int(n)})
    if not counts or counts[0] < 1 or len(counts) < len(set(given)):
        raise DesirePathError(f"The passes {given} cannot be counted: give whole numbers from 1 on.")
    return counts


def read_at(
    sim: Simulation,
    marks: Sequence[int],
    last: int,
    progress: Progress | None = None,
    what: Callable[[], Any] | None = None,
) -> list[Any]:
    """What there is, or else the cover, at each of the rising samples `marks` of `last`."""
    found, at = [], 0
    for mark in marks:
        while at < mark:
            at = min(at + max(last // 200, 1), mark)
            sim.run(at)
            if progress:
                progress(at / last)
        found.append(what() if what else cover(sim))
    return found


# ---- tables ------------------------------------------------------------------------------------------


def write(path: str | os.PathLike[str], rows: Iterable[tuple[int, float]]) -> None:
    """The table `passes,cover`, cover in per cent."""
    with atomic_file.file(path, "The table of cover", "w", newline="", encoding="utf-8") as stream:
        lines = csv.writer(stream, lineterminator="\n")
        lines.writerow(("passes", "cover"))
        lines.writerows((count, f"{share:.2f}") for count, share in rows)


def read(path: str | os.PathLike[str]) -> list[Row]:
    """[(passes, cover, days of rest), ..] of a table with the columns passes,cover and, if it likes, days."""
    names, lines = table.read(path, ("passes", "cover"))
    found = []
    for number, line in enumerate(lines, 2):
        try:
            cells = {name: float(cell) for name, cell in zip(names, line) if name in ("passes", "cover", "days")}
            count, share, days = cells["passes"], cells["cover"], cells.get("days", 0.0)
        except (KeyError, ValueError):
            raise DesirePathError(f"Line {number} of {path} is not in numbers: mend it.") from None
        if not (1 <= count <= MAX_PASSES and count == int(count) and 0.0 <= share <= 100.0 and 0.0 <= days < math.inf):
            raise DesirePathError(
                f"Line {number} of {path} cannot be: passes are whole numbers from 1 on, cover is "
                "0 to 100 per cent, days are 0 or more."
            )
        found.append((int(count), share, days))
    return found
