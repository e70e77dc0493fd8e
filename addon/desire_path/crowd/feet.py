"""The feet of a crowd, pressed into the ground of a rectangle: every passage that comes through it. MODEL 12.7

    Feet(scene, "park").press()          after Crowd(scene, "park").run()

In the folder of the crowd are then

    trodden_final.exr    rest, compression, heap, pressure_time, plant_strength ..: what another bake goes on from
    feet.json            passages that came through, contacts, depth, and the cover of the plants that are left
    feet.state           where to go on when it was stopped; the same bits as if it never was
"""

from __future__ import annotations

import json
import math
import os
import re
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .. import memory
from ..bake import state as states
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, disk
from ..ground import maps
from ..ground.options import SimulationOptions
from ..ground.plants import Kind as Plant
from ..ground.plants import Planting
from ..ground.sim import Ground, Simulation
from ..ground.soil import as_soil
from ..loads import walker
from ..study.trampling import cover
from ..version import VERSION
from .crowd import PATHS
from .prints import gait_of
from .scene import Press, Scene

FINAL, REPORT, STATE, LOCK = "trodden_final.exr", "feet.json", "feet.state", "feet.lock"
BEFORE = 2.0  # walkers come so far from outside the rectangle [m]
STRIDE = 1.4  # over which they begin here or there [m]
SHORTEST = 0.5  # of a path [m]
EVERY = 20.0  # from state to state, at least [s]
DAY = 86400.0  # [s]


class Feet:
    """A crowd's scene with its `press`, and the folder that holds its paths."""

    def __init__(self, scene: Scene, folder: str | os.PathLike[str]) -> None:
        if scene.press is None:
            raise DesirePathError('The scene does not say where feet press: add {"press": {"box": [x0, y0, x1, y1]}}.')
        self.scene, self.folder, self.where = scene, os.path.abspath(os.fspath(folder)), scene.press
        self._gaits = [gait_of(kind.walk, kind.mass) for kind in scene.walkers]
        ground = Ground.read(scene.heights, None) if scene.heights else Ground.flat()
        self.sim = Simulation(
            ground,
            as_soil(self.where.soil),
            self.where.cell,
            plants=[_planting(text, scene.seed, self.where) for text in self.where.plants],
            options=SimulationOptions(),
        )
        self.pressed = 0  # passages that came through
        self._last, self._done = -1, -1  # passages that were pressed, and read

    def press(self, progress: Callable[[float], object] | None = None) -> dict[str, Any]:
        """Press all feet, from where it was stopped; returns what feet.json says."""
        try:
            handle = disk.lock(os.path.join(self.folder, LOCK), "feet")
        except disk.Held:
            raise DesirePathError(
                f"The feet in {self.folder} are pressed already: wait, or choose another folder."
            ) from None
        except (OSError, ValueError):
            raise DesirePathError(f"{self.folder} is no folder of a crowd: let one walk into it first.") from None
        try:
            atomic_file.sweep(self.folder, "|".join(map(re.escape, (STATE, REPORT, FINAL))))
            return self._press(progress)
        finally:
            disk.unlock(handle, os.path.join(self.folder, LOCK))

    def _press(self, progress: Callable[[float], object] | None) -> dict[str, Any]:
        about = {"version": VERSION, "scene": self._name()}
        self._resume(about)
        kept, rested, calendar = time.monotonic(), self._last, self.scene.calendar
        for number, kind, points in self._passages():
            if number <= self._done:
                continue
            runs = list(self._through(number, points))
            if runs and self.sim.plantings and rested >= 0:
                self.sim.rest_plants((calendar.until(number)[1] - calendar.until(rested)[1]) * DAY)
            for run in runs:
                self._walk(kind, run)
            if runs:
                self.pressed, self._last, rested = self.pressed + 1, number, number
            self._done = number
            memory.check_kept()
            if runs and time.monotonic() - kept > EVERY:
                self._keep(about)
                kept = time.monotonic()
            if progress:
                progress((number + 1) / self.scene.passages)
        if self._done + 1 < self.scene.passages:
            raise DesirePathError(f"The crowd in {self.folder} has not walked to its end: let it go on first.")
        return self._write()

    def _name(self) -> str:
        """A digest of the scene and of the paths."""
        try:
            with atomic_file.reader(os.path.join(self.folder, PATHS)) as file:
                paths = _native.digest(file.read())
        except OSError:
            raise DesirePathError(f"{self.folder} holds no paths of a crowd: let one walk first.") from None
        return _native.digest(repr(self.scene).encode() + paths).hex()

    # ---- passages ----------------------------------------------------------------------------------------

    def _passages(self) -> Iterator[tuple[int, int, np.ndarray]]:
        """(number, kind, places (n, 2) [m]) of paths.csv, one after the other."""
        path = os.path.join(self.folder, PATHS)
        with open(path, encoding="utf-8") as file:
            next(file, None)
            now, kind = -1, 0
            points: list[tuple[float, float]] = []
            for line in file:
                try:
                    name, which, _, _, x, y = line.split(",")
                    number, at = int(name), (float(x), float(y))
                    if number != now and points:
                        yield now, kind, np.array(points)
                        points = []
                    now, kind = number, int(which)
                    points.append(at)
                except ValueError:
                    raise DesirePathError(f"{path} is damaged: let the crowd walk again.") from None
            if points:
                yield now, kind, np.array(points)

    def _through(self, number: int, points: np.ndarray) -> Iterator[np.ndarray]:
        """The parts of a path that come through the rectangle, each begun some part of a stride before."""
        x0, y0, x1, y1 = self.where.box
        wide = BEFORE + STRIDE * float(np.random.default_rng([self.scene.seed, number, 3]).random())
        near = ((points >= (x0 - wide, y0 - wide)) & (points <= (x1 + wide, y1 + wide))).all(axis=1)
        edges = np.flatnonzero(np.diff(np.r_[False, near, False].astype(int)))
        for begin, end in zip(edges[::2], edges[1::2]):
            run = points[begin:end]
            within = ((run >= (x0, y0)) & (run <= (x1, y1))).all(axis=1).any()
            if within and len(run) > 1 and np.hypot(*np.diff(run, axis=0).T).sum() > SHORTEST:
                yield run

    def _walk(self, kind: int, run: np.ndarray) -> None:
        gait = self._gaits[kind].along(run, 1, ground=self.sim)
        self.sim.load(gait, walker.loads(gait, ground=self.sim.rest_height if self.scene.heights else None))
        self.sim.run(len(gait.time) - 1)

    # ---- files -------------------------------------------------------------------------------------------

    def _keep(self, about: dict[str, Any]) -> None:
        line = {**about, "done": self._done, "last": self._last, "pressed": self.pressed}
        states.write(os.path.join(self.folder, STATE), line, self.sim.state())

    def _resume(self, about: dict[str, Any]) -> None:
        """Take up the state that was kept: the last passage is loaded again, not pressed."""
        try:
            line, state = states.read(os.path.join(self.folder, STATE), about)
            last = int(line["last"])
        except (states.Damaged, KeyError, ValueError):
            return
        for number, kind, points in self._passages():
            if number == last:
                gait = self._gaits[kind].along(list(self._through(number, points))[-1], 1, ground=self.sim)
                self.sim.load(gait, walker.loads(gait, ground=self.sim.rest_height if self.scene.heights else None))
                self.sim.restore(state)
                self._done, self._last, self.pressed = int(line["done"]), last, int(line["pressed"])
                return

    def _write(self) -> dict[str, Any]:
        if self.sim.plantings and self.scene.rest_days:
            self.sim.rest_plants(self.scene.rest_days * DAY)
        i0, i1, j0, j1 = self.sim.cells(self.where.box)
        names = [each.name for each in (*maps.MAPS, *maps.GROUND, *(maps.LEAN if self.sim.plantings else ()))]
        deepest = 0.0

        def rows(name: str, j: int, count: int) -> np.ndarray:
            nonlocal deepest
            found = self.sim.read(name, i0, j0 + j, i1 - i0, count)
            if name == "compression":
                deepest = max(deepest, float(found.max()))
            return found

        x0, y0, _, _ = self.sim.box((i0, i1, j0, j1))
        ground = {"ground": self.scene.heights or "flat"}
        notes: dict[str, str | float] = {
            "cell": self.where.cell,
            "originX": x0,
            "originY": y0,
            "parameters": json.dumps(ground),
        }
        maps.write_rows(os.path.join(self.folder, FINAL), names, (j1 - j0, i1 - i0), rows, notes)
        report = self.sim.report()
        report = {
            "version": VERSION,
            "passages": self.pressed,
            "contacts": report["contacts"],
            "deepest_m": deepest,
            **({"cover": cover(self.sim)} if self.sim.plants_count() else {}),
        }
        atomic_file.write_json(os.path.join(self.folder, REPORT), report, "The numbers of the feet")
        return report


def _planting(text: str, seed: int, where: Press) -> Planting:
    """KIND or KIND:DENSITY, in the rectangle."""
    name, colon, density = text.partition(":")
    try:
        many = float(density) if colon else None
    except ValueError:
        raise DesirePathError(f"'{text}' cannot be planted: write KIND or KIND:PLANTS for each m^2.") from None
    if many is not None and not math.isfinite(many):
        raise DesirePathError(f"'{text}' cannot be planted: write KIND or KIND:PLANTS for each m^2.")
    return Planting(Plant.load(name) if name.endswith(".json") else name, many, seed=seed, rectangle=where.box)
