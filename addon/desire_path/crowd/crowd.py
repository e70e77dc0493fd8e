"""A crowd that walks, wears the ground and chooses by what is worn: passage after passage, into a folder. MODEL 12.7

    crowd = Crowd(scene.read("park.json"), "park")
    crowd.run(progress=print)

The folder holds, when it is done:

    paths.csv                  passage,kind,from,to,x,y: the path of everybody, a point every two cells [m]
    cover_final.exr            cover (1 = untouched), load (passes), rest (height)
    frames/cover_000300.exr    the same after 300 passages, where the scene asks for a film
    crowd.json                 numbers: lengths, detours, bare area
    crowd.state                where to go on when it was stopped; the same bits as if it never was
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, replace
from typing import Any, Protocol

import numpy as np

from .. import memory
from ..bake import state as states
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, disk
from ..ground import maps
from ..version import VERSION
from .choice import Choice, Passage
from .covers import BODY
from .scene import Scene, schedule
from .stays import Walked
from .tread import tread

PATHS, STATE, REPORT, FINAL, LOCK = "paths.csv", "crowd.state", "crowd.json", "cover_final.exr", "crowd.lock"
FRAME = re.compile(r"cover_\d{6,}\.exr")
HEADER = b"passage,kind,from,to,x,y\n"
EVERY = 2.0  # from state to state, at least [s]
THIN = 4  # steps of half a cell from point to point of paths.csv
CELL_BYTES, PLACE_BYTES, PULL_BYTES = 70.0, 5.0, 65.0  # of memory, for each cell
HALF, BARE = 0.5, 0.1  # cover below which ground counts as worn, and as bare


class Ways(Protocol):
    """Who tells the ways of passages: walkers that choose, or recorded ones."""

    names: list[str]  # of places
    blocked: np.ndarray  # (ny, nx)

    def passages(self, first: int, count: int) -> list[Passage]: ...

    def ways(self, load: np.ndarray, passages: list[Passage]) -> list[Walked]: ...

    def direct(self, passage: Passage) -> float: ...


def _bytes(scene: Scene) -> float:
    """Memory that its fields take, about [bytes]."""
    each = CELL_BYTES + PLACE_BYTES * len(scene.places) + (PULL_BYTES if scene.ground.pull else 0.0)
    return each * scene.shape[0] * scene.shape[1]


class Crowd:
    """A scene and what its walkers have made of it so far.

    folder: what comes out, see the module. ways: who tells where walkers go; None = they choose.
    """

    def __init__(self, scene: Scene, folder: str | os.PathLike[str], *, ways: Ways | None = None) -> None:
        self.scene, self.folder = scene, os.path.abspath(os.fspath(folder))
        memory.check_rest(_bytes(scene))
        self.ways: Ways = ways or Choice(scene)
        self.load = np.zeros(scene.shape)  # of each cell [passes]
        self.done = 0  # passages
        places = len(self.ways.names)
        self.trips = np.zeros((3, places, places))  # number, length walked, length of the shortest path [m]
        self._written = 0  # bytes of paths.csv
        self._about = {"version": VERSION, "scene": self._name()}

    def _name(self) -> str:
        """A digest of all that the result depends on."""
        numbers = json.dumps(asdict(replace(self.scene, press=None)), default=str)
        parts = [numbers.encode(), np.packbits(self.ways.blocked).tobytes()]
        parts += [np.ascontiguousarray(self.scene.relief).tobytes(), getattr(self.ways, "digest", b"")]
        return _native.digest(b"".join(parts)).hex()

    def path(self, *names: str) -> str:
        return os.path.join(self.folder, *names)

    # ---- the run -----------------------------------------------------------------------------------------

    def run(self, progress: Callable[[float], object] | None = None) -> dict[str, Any]:
        """Walk all passages, from where it was stopped; returns what crowd.json says."""
        scene = self.scene
        with self._held():
            self._resume()
            kept = time.monotonic()
            with open(self.path(PATHS), "r+b" if self._written else "wb") as table:
                table.truncate(self._written)
                table.seek(self._written)
                if not self._written:
                    self._written = table.write(HEADER)
                while self.done < scene.passages:
                    before = self.done
                    self._written += table.write(self._walk(schedule(scene, before)))
                    if scene.film_every and self.done // scene.film_every > before // scene.film_every:
                        self._write(self.path("frames", f"cover_{self.done:06d}.exr"))
                    if time.monotonic() - kept > EVERY or self.done == scene.passages:
                        table.flush()
                        os.fsync(table.fileno())
                        self._keep()
                        kept = time.monotonic()
                    if progress:
                        progress(self.done / scene.passages)
            rested = scene.ground.rested(self.load, scene.rest_days)
            self._write(self.path(FINAL), rested)
            report = self.report(rested)
            atomic_file.write_json(self.path(REPORT), report, "The numbers of the crowd")
            return report

    def _walk(self, count: int) -> bytes:
        """So many passages by the ground as it is; their lines of paths.csv."""
        scene = self.scene
        passages = self.ways.passages(self.done, count)
        ways = self.ways.ways(self.load, passages)
        weights = [scene.walkers[each.kind].mass / BODY for each in passages]
        trodden = self.load + tread([walked.points for walked in ways], weights, self.load.shape, scene.cell)
        self.load = scene.ground.rested(trodden, self._grown(self.done + count) - self._grown(self.done))
        for each, walked in zip(passages, ways):
            at = (each.start, each.goal)
            self.trips[0][at] += 1.0
            self.trips[1][at] += walked.length
            self.trips[2][at] += self.ways.direct(each)
        self.done += count
        return b"".join(self._lines(each, walked) for each, walked in zip(passages, ways))

    def _grown(self, passages: int) -> float:
        """Days of growth until so many passages have gone; those after the last one are days of rest."""
        return self.scene.calendar.until(passages, passages < self.scene.passages)[1]

    def _lines(self, passage: Passage, walked: Walked) -> bytes:
        thin = walked.thin(THIN) + self.scene.origin
        names = self.ways.names
        begin = f"{passage.number},{passage.kind},{names[passage.start]},{names[passage.goal]}"
        return "".join(f"{begin},{x:.2f},{y:.2f}\n" for x, y in thin.tolist()).encode()

    # ---- files -------------------------------------------------------------------------------------------

    @contextlib.contextmanager
    def _held(self) -> Iterator[None]:
        """The folder is there and ours."""
        try:
            os.makedirs(self.path("frames") if self.scene.film_every else self.folder, exist_ok=True)
            handle = disk.lock(self.path(LOCK), "crowd")
        except disk.Held:
            raise DesirePathError(
                f"Another crowd is walking into {self.folder}: wait for it, stop it, or choose another folder."
            ) from None
        except (OSError, ValueError) as problem:
            raise DesirePathError(
                f"The folder {self.folder} cannot be written ({getattr(problem, 'strerror', None) or problem}): choose "
                "another one."
            ) from None
        try:
            for name, what in (
                (PATHS, "The paths"),
                (STATE, "The state"),
                (FINAL, "The cover"),
                (REPORT, "The numbers"),
            ):
                atomic_file.check(self.path(name), what)
            atomic_file.sweep(self.folder, "|".join(map(re.escape, (STATE, REPORT, FINAL))))
            atomic_file.sweep(self.path("frames"), FRAME.pattern)
            yield
        except OSError as problem:
            raise DesirePathError(
                f"The crowd cannot be written to {self.folder} ({problem.strerror or problem}): make room and start it "
                "again, and it goes on."
            ) from None
        finally:
            disk.unlock(handle, self.path(LOCK))

    def _keep(self) -> None:
        held = np.concatenate([self.load.ravel(), self.trips.ravel()])
        about = {**self._about, "done": self.done, "written": self._written}
        states.write(self.path(STATE), about, memoryview(held.tobytes()))

    def _resume(self) -> None:
        """Take up the state that was kept, if it is this scene's and its paths are all there."""
        try:
            about, held = states.read(self.path(STATE), self._about)
            done, written = int(about["done"]), int(about["written"])
            numbers = np.frombuffer(held, np.float64).copy()
            if os.path.getsize(self.path(PATHS)) < written or numbers.size != self.load.size + self.trips.size:
                raise states.Damaged
        except (states.Damaged, OSError, KeyError, ValueError):
            self._clear()
            return
        self.done, self._written = done, written
        self.load = numbers[: self.load.size].reshape(self.load.shape)
        self.trips = numbers[self.load.size :].reshape(self.trips.shape)

    def _clear(self) -> None:
        """Pictures of another crowd go."""
        for name in os.listdir(self.path("frames")) if os.path.isdir(self.path("frames")) else ():
            if FRAME.fullmatch(name):
                os.unlink(self.path("frames", name))

    def _write(self, path: str, load: np.ndarray | None = None) -> None:
        scene = self.scene
        load = self.load if load is None else load
        planes = {"cover": scene.ground.left(load), "load": load, "rest": scene.relief}
        notes = {"cell": scene.cell, "originX": scene.origin[0], "originY": scene.origin[1], "passages": self.done}
        maps.write(path, planes, notes)

    # ---- numbers -----------------------------------------------------------------------------------------

    def report(self, load: np.ndarray | None = None) -> dict[str, Any]:
        """What the crowd has done so far, in numbers."""
        cover = self.scene.ground.left(self.load if load is None else load)
        count, walked, direct = self.trips
        area, names = self.scene.cell**2, self.ways.names
        return {
            "version": VERSION,
            "passages": self.done,
            "days": self.scene.calendar.until(self.done, idle=False)[0],
            "detour": float(walked.sum() / max(direct.sum(), 1e-9)),
            "area_below_half_cover": float(np.sum((cover < HALF) & ~self.ways.blocked) * area),
            "bare_area": float(np.sum((cover < BARE) & ~self.ways.blocked) * area),
            "trips": [
                {
                    "from": names[a],
                    "to": names[b],
                    "passages": int(count[a, b]),
                    "direct": float(direct[a, b] / count[a, b]),
                    "walked": float(walked[a, b] / count[a, b]),
                }
                for a, b in np.argwhere(count).tolist()
            ],
        }
