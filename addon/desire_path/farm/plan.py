"""Cut a bake into tasks that many machines can do, and write them to a job's folder. MODEL 13

    Bake --plan(bake, "job", (4, 4), 10)--> job/   then a task for each window and tile, windows in turn: task.run()

The tasks of one window need those of the windows before, and none of each other. Their results together are the bake,
to the bit, whatever machine each was done on and however often it was stopped.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import memory
from ..bake.bake import Bake
from ..bake.grounds import simulations
from ..bake.report import layer_of
from ..bake.share import Share
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file
from ..ground import materials, pieces
from ..ground.sim import Simulation
from ..loads.force import PRESSES, FootForce
from ..motion import tracks
from ..motion.gait import Gait
from ..version import VERSION
from . import job as jobs
from . import send
from .job import Job, Window
from .parts import Component, Treads, margin, rising, why_chained

MAX_TASKS = 1_000_000
MAX_SIDE = 1000  # tiles of a job along a side
STEP_SECONDS = 50e-6  # of a limb that presses, from sample to sample, in cells of 1 cm


@dataclass(frozen=True)
class Summary:
    """What a job will take, about."""

    windows: int
    tiles: int
    tasks: int  # with something to do
    components: int
    most: int  # components of one window
    seconds: float  # of one core, for all of it
    longest: float  # .. for one task after the other on the longest path through the windows
    bytes: int  # of the job as it was planned
    chained: str  # why all walkers count as one component; empty: they do not
    template: bool  # whether there is one of an Open Job Description: not of more windows than it may have


def plan(
    bake: Bake, folder: str | os.PathLike[str], tiles: tuple[int, int], windows: int, wide: float = 0.0
) -> Summary:
    """Write the job of a bake to a folder.

    tiles: columns and rows of tasks; windows: how many follow each other; wide: how much more ground beside its soles a
    step is taken to change, for soil that goes far [m].
    A folder with the same job keeps the results that are there; with another one it is refused. The bake's limit of
    memory is kept to meanwhile; tasks have their own.
    """
    _check(bake, tiles, windows, wide)
    folder = os.path.abspath(os.fspath(folder))
    with memory.held(bake.options.memory, folder):
        return _write(bake, folder, tiles, windows, wide)


def _write(bake: Bake, folder: str, tiles: tuple[int, int], windows: int, wide: float) -> Summary:
    sims, loads, shares = simulations(bake)
    if len(sims) != 1 or len(shares) != 1:
        raise DesirePathError("A farm bakes one ground: give the bake one Ground, not several Parcels.")
    share, sim = shares[0], sims[0]
    if share.parcel.ground.layers or materials.sticky(sim.soils):
        raise DesirePathError("A farm bakes no ground in layers and no soil that sticks: bake it on one machine.")
    share.find(bake.signature())
    cut = _Cut(bake, share, sim, loads, tiles, windows, wide)
    about = cut.about()
    _take_folder(folder, bake.signature(), tiles, windows, wide)
    files = cut.write(folder)
    about["files"] = files
    content = {
        "format": jobs.FORMAT,
        "version": VERSION,
        "digest": _native.digest(json.dumps(about, sort_keys=True).encode()).hex(),
        "about": about,
    }
    atomic_file.write_json(os.path.join(folder, jobs.JOB), content, "The job")
    start: dict[str, bytes | memoryview] = {
        "tiles": rising(pieces.tiles(sim)).astype(np.int32).tobytes(),
        "state": sim.state(),
    }
    Job(folder).keep(-1, 0, {}, start)
    owners = [sorted({each.owner for each in here}) for here in cut.components]
    return cut.summary(folder, send.write(folder, owners))


def _check(bake: Bake, tiles: tuple[int, int], windows: int, wide: float) -> None:
    if not (1 <= tiles[0] <= MAX_SIDE and 1 <= tiles[1] <= MAX_SIDE):
        raise DesirePathError(f"{tiles[0]} x {tiles[1]} tiles cannot be planned: give 1 to {MAX_SIDE} along each side.")
    if not 1 <= windows <= bake.count:
        raise DesirePathError(
            f"A bake of {bake.count} frames cannot be cut into {windows} windows: choose 1 to {bake.count}."
        )
    if windows * tiles[0] * tiles[1] > MAX_TASKS:
        raise DesirePathError(
            f"{windows} windows of {tiles[0]} x {tiles[1]} tiles are more than {MAX_TASKS:,} tasks: choose fewer."
        )
    if not 0.0 <= wide <= 100.0:
        raise DesirePathError(f"A margin of {wide:g} m cannot be planned: choose 0 to 100.")
    if bake.output.plant_mesh:
        raise DesirePathError("A farm writes no plants as a mesh: leave out plant_mesh.")
    if bake.options.spray:
        raise DesirePathError("A farm bakes no spray: leave it out.")


def _take_folder(folder: str, signature: str, tiles: tuple[int, int], windows: int, wide: float) -> None:
    """Make it, unless another job lies there."""
    try:
        os.makedirs(os.path.join(folder, "windows"), exist_ok=True)
        os.makedirs(os.path.join(folder, "results"), exist_ok=True)
        os.makedirs(os.path.join(folder, "rest"), exist_ok=True)
    except (OSError, ValueError) as problem:
        raise DesirePathError(
            f"The folder {folder} cannot be made ({getattr(problem, 'strerror', None) or problem}): choose another one."
        ) from None
    if not os.path.lexists(os.path.join(folder, jobs.JOB)):
        return
    try:
        there = Job(folder).about
        same = [there["signature"], there["tiles"], len(there["windows"]), there["wide"]]
    except DesirePathError:
        same = []
    if same != [signature, list(tiles), windows, wide]:
        raise DesirePathError(
            f"The job in {folder} is of another walk, ground or cut: choose another folder, or delete that one first."
        )


class _Cut:
    """A bake as it is cut."""

    def __init__(
        self,
        bake: Bake,
        share: Share,
        sim: Simulation,
        loads: FootForce,
        tiles: tuple[int, int],
        windows: int,
        wide: float,
    ) -> None:
        self.bake, self.share, self.sim, self.loads, self.wide = bake, share, sim, loads, wide
        self.tiles, self.gait = tiles, bake.stepped
        self.own: Any = share.parcel.soils
        self.chained = why_chained(self.own, share.plants)
        ends = [round(bake.count * (k + 1) / windows) for k in range(windows)]
        self.windows = [Window(first + 1, last) for first, last in zip([0, *ends], ends)]
        self.samples = [0, *(bake.sample(bake.frame_start + n) for n in range(bake.count))]
        self.components = self._components()

    def steps(self, window: Window) -> tuple[int, int]:
        """(first step of a window, the one after its last)."""
        return (self.samples[window.first - 1] if window.first > 1 else 0), self.samples[window.last]

    # ---- who does what --------------------------------------------------------------------------------

    def _components(self) -> list[list[Component]]:
        """Of each window, with their owners, and where each was last."""
        if self.chained:
            everybody = Component(list(range(len(self.gait.mass))), np.zeros((0, 2), np.int32))
            everybody.steps = int((np.asarray(self.loads.touching) == PRESSES).sum())
            return [[everybody]] * len(self.windows)
        carves = self.bake.options.law == "carve" or "carve" in (self.gait.contact_law or ())
        around = margin(self.own, self.bake.options, carves, self.sim.cell_size) + self.wide
        treads = Treads(self.gait, self.loads, self.sim.cell_size, self.sim.origin, around)
        last_tile = dict.fromkeys(map(tuple, pieces.tiles(self.sim).tolist()), (-1, 0))
        last_walker: dict[int, tuple[int, int]] = {}
        found = []
        for number, window in enumerate(self.windows):
            here = treads.components(*self.steps(window))
            for each in here:
                each.owner = self._owner(each.tiles)
                each.tile_from = _lasts(last_tile, map(tuple, each.tiles.tolist()))
                each.walker_from = _lasts(last_walker, each.walkers)
            for each in here:
                last_tile.update(dict.fromkeys(map(tuple, each.tiles.tolist()), (number, each.owner)))
                last_walker.update(dict.fromkeys(each.walkers, (number, each.owner)))
            found.append(here)
        return found

    def _owner(self, tiles: np.ndarray) -> int:
        """The tile of the job that most of some tiles of ground lie in."""
        x, y, nx, ny = self.share.tiles
        columns, rows = self.tiles
        i = np.clip((tiles[:, 0] - x) * columns // nx, 0, columns - 1)
        j = np.clip((tiles[:, 1] - y) * rows // ny, 0, rows - 1)
        return int(np.bincount(j * columns + i).argmax())

    # ---- what is written ------------------------------------------------------------------------------

    def about(self) -> dict[str, Any]:
        """What job.json tells, but for its files."""
        bake, share, sim = self.bake, self.share, self.sim
        planted: Any = share.plants
        warnings = [*bake.warnings, *self.loads.warnings, *sim.warnings]
        return {
            "signature": bake.signature(),
            "tiles": list(self.tiles),
            "windows": [[each.first, each.last] for each in self.windows],
            "wide": self.wide,
            "chained": self.chained,
            "film": list(share.tiles),
            "cell": sim.cell_size,
            "origin": list(sim.origin),
            "law": bake.options.law,
            "heap": bake.options.heap,
            "rim_width": bake.options.rim_width,
            "soils": [jobs.soil_data(soil) for soil in self.own],
            "plants": [jobs.planting_data(each) for each in planted],
            "ground_parts": len(share.parcel.ground.native),
            "samples": [int(sample) for sample in self.samples],
            "times": [0.0, *(bake.time(bake.frame_start + n) for n in range(bake.count))],
            "maps": [None, *(bake.map_name(bake.frame_start + n) for n in range(bake.count))],
            "index": share.index,
            "fields": [entry.name for entry in share.fields()],
            "layer": layer_of(sim.soils),
            "trail": share.parcel.ground.trail is not None,
            "report": {
                "passes": len(bake.passes),
                "warnings": list(dict.fromkeys(warnings)),
                "parameters": bake.parameters(share.parcel),
            },
        }

    def write(self, folder: str) -> dict[str, str]:
        """All files but job.json; returns their digests by name."""
        share, sim = self.share, self.sim
        films = share.open_films()
        films.write_frame(os.path.join(folder, "rest", "trail_0000.exr"), 0.0)
        if share.plants:
            films.write_lean(os.path.join(folder, "rest", "lean_0000.exr"), 0.0)
        films.write_maps(os.path.join(folder, "rest", "maps.exr"), 0.0)
        share.write_start(os.path.join(folder, "rest", "maps_start.exr"))
        sim.flush()
        datum = _first_touch(self.gait, self.loads)
        first = pieces.tracks(self.gait, self.loads, datum)
        walkers = {**pieces.cast(self.gait), **{f"first_{name}": each for name, each in first.items()}}
        names = {jobs.GROUND: jobs.ground_arrays(share.parcel.ground), jobs.WALKERS: walkers}
        for number, window in enumerate(self.windows):
            steps = (0, len(self.gait.time)) if self.chained else self.steps(window)
            spans = _spans(self.gait, self.components[number], *steps) if not self.chained or not number else datum[:0]
            names[jobs.window_name(number)] = {
                **pieces.tracks(self.gait, self.loads, spans),
                **jobs.component_arrays(self.components[number]),
            }
        for name, arrays in names.items():
            jobs.write_arrays(os.path.join(folder, name), arrays, "The job")
        return {name: jobs.digest_of(os.path.join(folder, name)) for name in names}

    def summary(self, folder: str, template: bool) -> Summary:
        a_step = STEP_SECONDS * (0.01 / self.sim.cell_size) ** 2
        tasks, longest, steps = 0, 0, 0
        for here in self.components:
            of: dict[int, int] = {}
            for each in here:
                of[each.owner] = of.get(each.owner, 0) + each.steps
            tasks, steps = tasks + len(of), steps + sum(of.values())
            longest += max(of.values(), default=0)
        if self.chained:
            longest = steps = steps // len(self.windows)
        sizes = [os.path.getsize(os.path.join(at, name)) for at, _, names in os.walk(folder) for name in names]
        return Summary(
            len(self.windows),
            self.tiles[0] * self.tiles[1],
            tasks,
            sum(map(len, self.components)),
            max(map(len, self.components)),
            a_step * steps,
            a_step * longest,
            sum(sizes),
            self.chained,
            template,
        )


def _lasts(known: dict[Any, tuple[int, int]], names: Any) -> np.ndarray:
    """(window, tile) in which each was last (n, 2), (-2, 0): never."""
    return np.array([known.get(each, (-2, 0)) for each in names], np.int32).reshape(-1, 2)


def _spans(gait: Gait, components: Sequence[Component], first: int, after: int) -> np.ndarray:
    """(walker, first sample, samples) (n, 3) of those who are there in the steps first..after-1."""
    found = []
    owner = np.asarray(gait.limb_walker)[np.asarray(gait.part_limb)]
    for walker in sorted(walker for each in components for walker in each.walkers):
        part = int(np.flatnonzero(owner == walker)[0])
        for begin, values in tracks.pieces(gait.pose, part):
            low, high = max(begin, first - 1), min(begin + len(values), after + 1)
            if low < high:
                found.append((walker, low, high - low))
    return np.array(found, np.int64).reshape(-1, 3)


def _first_touch(gait: Gait, loads: FootForce) -> np.ndarray:
    """(walker, sample, 1) (1, 3) of the first part, in their order, that ever touches, where it does: heights count
    from there, see dp_motion_first_touch. A walker who is there at one sample alone presses nothing."""
    for part in range(len(gait.part_limb)):
        for begin, touching in tracks.pieces(loads.touching, part):
            down = np.flatnonzero(np.asarray(touching) == PRESSES)
            if len(down):
                return np.array([[gait.limb_walker[gait.part_limb[part]], begin + down[0], 1]], np.int64)
    return np.zeros((0, 3), np.int64)
