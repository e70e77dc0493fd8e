"""The lane experiment: how much of a stand is left where people walk to and fro. Cole 1995, MODEL 7.7

A lane is planted, trodden so many times from end to end, and its cover is read: the mean over its plants of
the share that is not broken, alpha of TRAIL (7). With days of rest every count is a lane of its own, which
grows again before it is read.
"""

import csv
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..core import side_by_side
from ..errors import DesirePathError
from ..files import atomic_file, table
from ..ground.plants import MOST_PLANTS, Planting, as_kind, vigour_at
from ..ground.sim import Ground, Simulation
from ..loads import walker
from ..motion.gait import Gait

WALK = Path(__file__).parents[1] / "walks" / "walk.npz"
PASSES = (25, 75, 200, 500)  # counts of Cole's lanes
MOST_PASSES = 1_000_000_000  # a table may speak of
BEYOND = 0.4  # people walk on so far past both ends [m]
SCATTER = 0.32  # standard deviation of their tracks, in widths of the lane
ENOUGH = 400  # plants that tell a lane's cover to a point or so
DENSER = 2.0  # a lane with fewer may be planted so many times as densely as the kind is
EVEN = 1.2207440846057596 ** -np.arange(1.0, 4.0)  # steps that fill a cube evenly, x^4 = x + 1
DAY = 86400.0  # [s]
USUAL = {
    "length": 5.0,
    "width": 0.5,
    "mass": 75.0,
    "seed": 0,
    "soil": "soil",
    "cell_size": 0.02,
    "frame_rate": 60.0,
    "density": None,
}


def walk(mass=75.0):
    """The walk that comes with Desire Path: whole strides that repeat on level ground, of a person of `mass` [kg]."""
    return replace(Gait.load(WALK), mass=[mass]).check()


def measure(
    kind,
    *,
    length=5.0,
    width=0.5,
    passes=PASSES,
    mass=75.0,
    seed=0,
    rest_days=0.0,
    soil="soil",
    cell_size=0.02,
    frame_rate=60.0,
    density=None,
    threads=0,
    progress=None,
):
    """[(passes, cover [per cent]), ..] of a lane of one kind, rising.

    length, width [m]; mass of the walkers [kg]; seed: of the plants and of the walkers' scatter. rest_days: days
    of growth before every count. frame_rate: of the walk's recording [1/s]. density: plants [1/m^2], None = the
    kind's own, or up to twice as many if they would be few to measure by. progress: called with 0..1.
    """
    kind, passes = as_kind(kind), _counts(passes)
    for name, value, low, high in (
        ("length", length, 0.5, 1000.0),
        ("width", width, 0.1, 100.0),
        ("mass", mass, 1.0, 1000.0),
        ("rest", rest_days, 0.0, 1e6),
    ):
        if not low <= value <= high:
            raise DesirePathError(f"A {name} of {value:g} cannot be used for a lane: choose {low:g} to {high:g}.")
    stand = _density(kind, length, width, density)
    if not 0.0 < stand * length * width <= MOST_PLANTS:
        raise DesirePathError(
            f"A density of {stand:g} plants a m^2 cannot be used for this lane: choose one that "
            f"makes up to {MOST_PLANTS} plants."
        )
    lane = dict(
        length=length,
        width=width,
        mass=mass,
        seed=seed,
        soil=soil,
        cell_size=cell_size,
        frame_rate=frame_rate,
        density=density,
    )
    if not rest_days:
        sim, marks = trodden(kind, passes[-1], threads=threads, **lane)
        return list(zip(passes, read_at(sim, [marks[n - 1] for n in passes], marks[-1], progress)))
    shares = dict.fromkeys(passes, 0.0)

    def rested(count):
        def told(share):
            shares[count] = share
            if progress:
                progress(sum(n * done for n, done in shares.items()) / sum(passes))

        sim, marks = trodden(kind, count, threads=1, **lane)
        read_at(sim, marks[-1:], marks[-1], told)
        sim.rest_plants(rest_days * DAY)
        return count, cover(sim)

    return sorted(side_by_side(rested, reversed(passes), threads))


def trodden(kind, passes, *, length, width, mass, seed, soil, cell_size, frame_rate, density, threads=0):
    """(Simulation of a planted lane with its walkers loaded, sample after each pass)."""
    ends = [(-BEYOND, 0.0), (length + BEYOND, 0.0)]
    person = walk(mass)
    if frame_rate != person.frame_rate:
        person = replace(person.resample(frame_rate), frame_rate=frame_rate)
    gait = person.along(ends, passes, lateral=SCATTER * width, seed=seed)
    sim = Simulation(
        Ground.flat(), soil, cell_size, plants=planted(kind, length, width, seed, density), threads=threads
    )
    sim.load(gait, walker.loads(gait))
    return sim, [int(cut) for cut in gait.cut] + [len(gait.time) - 1]


def planted(kind, length, width, seed, density=None):
    """The lane's plants: places and vigour fill lane and range evenly, so that few plants tell what many would."""
    count = max(int(round(_density(kind, length, width, density) * length * width)), 1)
    even = (np.random.default_rng([int(seed), count]).random(3) + np.arange(count)[:, None] * EVEN) % 1.0
    roots = np.stack([even[:, 0] * length, (even[:, 1] - 0.5) * width], axis=1)
    return Planting(kind, seed=seed, roots=roots, vigour=vigour_at(even[:, 2]))


def _density(kind, length, width, density):
    """Plants of a lane [1/m^2]: what was asked for, else the kind's own, or more where those are few to measure by."""
    if density is not None:
        return density
    return kind.density * min(max(ENOUGH / (kind.density * length * width), 1.0), DENSER)


def cover(sim):
    """Mean share of every plant that is not broken [per cent], TRAIL (7)."""
    alpha = np.concatenate([sim.plants_alpha(stand) for stand, _, _ in sim.stands])
    return 100.0 * float(alpha.mean())


def _counts(passes):
    counts = sorted({int(n) for n in passes if n == int(n)})
    if not counts or counts[0] < 1 or len(counts) < len(set(passes)):
        raise DesirePathError(f"The passes {passes} cannot be counted: give whole numbers from 1 on.")
    return counts


def read_at(sim, marks, last, progress=None, what=None):
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


def write(path, rows):
    """The table `passes,cover`, cover in per cent."""
    with atomic_file.file(path, "The table of cover", "w", newline="", encoding="utf-8") as stream:
        lines = csv.writer(stream, lineterminator="\n")
        lines.writerow(("passes", "cover"))
        lines.writerows((count, f"{share:.2f}") for count, share in rows)


def read(path):
    """[(passes, cover, days of rest), ..] of a table with the columns passes,cover and, if it likes, days."""
    names, rows = table.read(path, ("passes", "cover"))
    found = []
    for number, row in enumerate(rows, 2):
        try:
            told = {name: float(cell) for name, cell in zip(names, row) if name in ("passes", "cover", "days")}
            row = told["passes"], told["cover"], told.get("days", 0.0)
        except (KeyError, ValueError):
            raise DesirePathError(f"Line {number} of {path} is not in numbers: mend it.") from None
        if not (
            1 <= row[0] <= MOST_PASSES and row[0] == int(row[0]) and 0.0 <= row[1] <= 100.0 and 0.0 <= row[2] < math.inf
        ):
            raise DesirePathError(
                f"Line {number} of {path} cannot be: passes are whole numbers from 1 on, cover is "
                "0 to 100 per cent, days are 0 or more."
            )
        found.append((int(row[0]), *row[1:]))
    return found
