"""One task of a job: the components of a window that a tile has, pressed from where others left them. MODEL 13

    job/results of windows before --run(job, window, tile)--> job/results/w003_t005.bin

A task that was stopped has left nothing, and is done again; one that was done is not.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from .. import memory
from ..bake import state as states
from ..bake.report import carried
from ..errors import DesirePathError
from ..ground import pieces
from ..ground.film import Film
from ..ground.sim import Simulation
from . import chunks
from .chunks import Changes, Frame
from .job import WALKERS, Job, window_name
from .parts import Component, rising

AT_ONCE = 16  # frames that wait to be looked at


def run(
    job: Job,
    window: int,
    tile: int,
    threads: int = 0,
    progress: Callable[[float], object] | None = None,
    *,
    limit: float | str | None = None,
) -> dict[str, Any]:
    """Do a task, unless it was done; returns what its result tells of it.

    limit: of memory, in bytes or as "4G"; what does not fit waits in the job's folder
    DesirePathError where the job has no such task, a result it goes on from is not there, soil went farther than was
    planned, or the limit is too low.
    """
    job.check_task(window, tile)
    with memory.held(limit, job.folder):
        try:
            return job.result(window, tile)[0]
        except states.Damaged:
            return _do(job, window, tile, threads, progress)


def _do(job: Job, window: int, tile: int, threads: int, progress: Callable[[float], object] | None) -> dict[str, Any]:
    begun = time.perf_counter()
    components = [each for each in job.components(window) if each.owner == tile]
    if not components:
        return {"report": {}, "seconds": 0.0}
    sim = _ground(job, window, components, threads)
    parts = _press(job, window, sim, components, progress)
    there = pieces.tiles(sim)
    if not job.chained:
        _check_reach(job, window, tile, there, components)
    seconds = round(time.perf_counter() - begun, 3)
    about = {"report": sim.report(), "carried": carried([sim]), "seconds": seconds}
    job.keep(window, tile, about, {"tiles": there.tobytes(), "state": sim.state(), **parts})
    return about


def first_sample(job: Job, window: int) -> int:
    """Sample at which a window begins."""
    first = job.windows[window].first
    return job.samples[first - 1] if first > 1 else 0


# ---- from where it goes on --------------------------------------------------------------------------------------


def _ground(job: Job, window: int, components: list[Component], threads: int) -> Simulation:
    """The ground with what the windows before left of these components, at the begin of the window."""
    walkers = job.arrays(WALKERS)
    sim = job.simulation(threads)
    whose = f"Window {window} needs"
    if job.chained:
        pieces.follow(sim, walkers, job.arrays(window_name(0)))
        sim.restore(job.needed(window - 1, 0, whose)[1]["state"])
        return sim
    tracks = job.arrays(window_name(window))
    own = np.isin(tracks["track"][:, 0], [walker for each in components for walker in each.walkers])
    pieces.follow(sim, walkers, with_datum(pieces.some({**walkers, **tracks}, own), walkers))
    tiles = np.concatenate([each.tiles for each in components])
    tile_from = np.concatenate([each.tile_from for each in components])
    names = np.concatenate([each.walkers for each in components])
    walker_from = np.concatenate([each.walker_from for each in components])
    for source in sorted(set(map(tuple, np.concatenate([tile_from, walker_from]).tolist()))):
        if source[0] < -1:
            continue
        parts = job.needed(source[0], source[1], whose)[1]
        mine = np.zeros(len(walkers["mass"]), bool)
        mine[names[(walker_from == source).all(axis=1)]] = True
        take(sim, parts, tiles[(tile_from == source).all(axis=1)], mine)
    pieces.begin_at(sim, first_sample(job, window))
    return sim


def take(sim: Simulation, parts: dict[str, memoryview], tiles: np.ndarray, walkers: np.ndarray) -> None:
    """Let a simulation take of a result those of some tiles that were touched there, and limbs."""
    there = np.frombuffer(parts["tiles"], np.int32).reshape(-1, 2)
    wanted = set(map(tuple, tiles.tolist()))
    some = [each for each in map(tuple, there.tolist()) if each in wanted]
    pieces.take(sim, parts["state"], rising(np.array(some, np.int64)), walkers)


def with_datum(tracks: dict[str, np.ndarray], walkers: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Tracks with the first touch of the whole walk, from which heights count: there already, or as one sample more."""
    first = {name: walkers[f"first_{name}"] for name in pieces.TRACKS}
    for walker, sample, _ in first["track"].tolist():
        own = tracks["track"][tracks["track"][:, 0] == walker]
        if ((own[:, 1] <= sample) & (sample < own[:, 1] + own[:, 2])).any():
            return tracks
    return pieces.join(tracks, first)


# ---- what is made -------------------------------------------------------------------------------------------------


def _press(
    job: Job, window: int, sim: Simulation, components: list[Component], progress: Callable[[float], object] | None
) -> dict[str, bytes]:
    """Step through the window; returns the tables and tiles of its films by name."""
    first, last = job.windows[window].first, job.windows[window].last
    tiles = np.concatenate([each.tiles for each in components])
    box = job.film if job.chained else chunks.box_of(tiles, job.film)
    with tempfile.TemporaryDirectory(prefix="desire_path_") as folder:
        films = _Films(job, sim, box, folder) if box else None
        if films:
            films.begin()
        for number in range(first, last + 1):
            sim.run(job.samples[number])
            if films:
                films.write(number, number == last)
            memory.check_kept()
            if progress:
                progress((number - first + 1) / (last - first + 1))
        return films.packed() if films else {}


class _Films:
    """What a task shows of its tiles: files that are looked at as they come, and dropped."""

    def __init__(self, job: Job, sim: Simulation, box: tuple[int, int, int, int], folder: str) -> None:
        self.job, self.sim, self.folder = job, sim, folder
        self.film: Film = sim.open_frames(*box)
        self.film.open_maps(job.about["fields"], ())
        kinds = ("trail", "maps", "lean") if job.about["plants"] else ("trail", "maps")
        self.changes = {kind: Changes(box[:2]) for kind in kinds}
        self.waiting: list[tuple[int, str, str]] = []

    def _write(self, number: int, kind: str) -> None:
        path = os.path.join(self.folder, f"{kind}_{number}.exr")
        write = {"trail": self.film.write_frame, "lean": self.film.write_lean, "maps": self.film.write_maps}[kind]
        write(path, self.job.about["times"][number])
        self.waiting.append((number, kind, path))

    def begin(self) -> None:
        """The films as they are when the window begins."""
        for kind in self.changes:
            self._write(0, kind)
        self.sim.flush()
        for _, kind, path in self.waiting:
            self.changes[kind].begin(Frame.read(path))
        self.waiting = []

    def write(self, number: int, last: bool) -> None:
        """One frame of every film; of the maps where there is one, and the last: others go on from it."""
        for kind in self.changes:
            if kind != "maps" or last or self.job.about["maps"][number]:
                self._write(number, kind)
        if last or len(self.waiting) >= AT_ONCE:
            self.sim.flush()
            for each, kind, path in self.waiting:
                self.changes[kind].add(each, Frame.read(path))
                os.unlink(path)
            self.waiting = []

    def packed(self) -> dict[str, bytes]:
        found = {}
        for kind, changes in self.changes.items():
            found[f"{kind}_table"], found[f"{kind}_tiles"] = changes.packed()
        return found


def _check_reach(job: Job, window: int, tile: int, there: np.ndarray, components: list[Component]) -> None:
    planned = {each for component in components for each in map(tuple, component.tiles.tolist())}
    beyond = [each for each in map(tuple, there.tolist()) if each not in planned]
    if beyond:
        raise DesirePathError(
            f"Soil of window {window}, tile {tile} went {len(beyond)} tiles of ground farther than was planned, where "
            f"it could meet that of others: plan the job anew with --margin {job.about['wide'] + 1.0:g} or more."
        )
