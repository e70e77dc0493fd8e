"""A job's folder: what is to be done, and what its tasks have made so far. MODEL 13

    job.json                    windows, tiles, frames, numbers of soils and plants; a digest of every other file
    ground.npz, walkers.npz     the ground before anybody walks; who walks
    windows/w003.npz            what they do in window 3, and which components they make
    start.bin                   the ground before the first step: a trail that goes on
    rest/trail_0000.exr ..      the pictures before the first step
    openjd.json, flamenco.json  the job as farms take it, see send.py
    results/w003_t005.bin       what the task of window 3 and tile 5 made: state, tiles of frames
    bake/                       what merge() makes of them

A job is whole by itself: the recording and the ground it was planned from may change, or be elsewhere.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import memory
from ..bake import state as states
from ..core import _native
from ..errors import DesirePathError
from ..files import atomic_file, npz
from ..ground.kinds import Kind
from ..ground.options import SimulationOptions
from ..ground.planting import Planting
from ..ground.sim import Ground, Simulation
from ..ground.soil import Soil
from ..ground.soil_keys import AnySoil, SoilKeys
from ..version import VERSION
from .parts import Component

FORMAT = 1  # of job.json
JOB, GROUND, WALKERS, START = "job.json", "ground.npz", "walkers.npz", "start.bin"
MAX_JSON = 1 << 28  # bytes
MAX_ARRAYS = 64 << 30  # bytes of the arrays of one file
COMPONENT = ("walkers", "tiles", "tile_from", "walker_from")


@dataclass(frozen=True)
class Window:
    """Some frames of the clip that follow each other: numbers first..last of the files for playback."""

    first: int
    last: int


def window_name(window: int) -> str:
    return os.path.join("windows", f"w{window:03d}.npz")


def result_name(window: int, tile: int) -> str:
    return os.path.join("results", f"w{window:03d}_t{tile:03d}.bin")


def digest_of(path: str) -> str:
    """Of a file's bytes."""
    with atomic_file.reader(path) as stream:
        return _native.digest(stream.read()).hex()


def write_arrays(path: str, arrays: Mapping[str, np.ndarray], what: str) -> None:
    with atomic_file.file(path, what) as stream:
        np.savez(stream, **arrays)  # type: ignore[arg-type]


# ---- what is told of ground, soils, plants and components ----------------------------------------------------


def soil_data(soil: AnySoil) -> dict[str, Any]:
    """A soil as JSON."""
    if isinstance(soil, SoilKeys):
        return {"soil": soil_data(soil.soil), "keys": {name: [list(pair) for pair in keys] for name, keys in soil.keys}}
    return {name: getattr(soil, name) for name in soil.__dataclass_fields__}


def _soil(data: Mapping[str, Any]) -> AnySoil:
    return SoilKeys(Soil(**data["soil"]), data["keys"]) if "keys" in data else Soil(**data)


def planting_data(planting: Planting) -> dict[str, Any]:
    """A planting without arrays as JSON."""
    if planting.arrays():
        raise DesirePathError("Plants at places of their own cannot be sent to a farm: plant them by density.")
    return planting.parameters()


def _planting(data: Mapping[str, Any]) -> Planting:
    box = data.get("rectangle")
    return Planting(Kind(**data["kind"]), data["density"], seed=data["seed"], rectangle=tuple(box) if box else None)


def ground_arrays(ground: Ground) -> dict[str, np.ndarray]:
    """The ground before anybody walks, as arrays."""
    return {f"part{k}": np.array(part) for k, part in enumerate(ground.native) if part is not None}


def _ground(arrays: Mapping[str, np.ndarray], parts: int) -> Ground:
    native: list[Any] = []
    for k in range(parts):
        part = arrays.get(f"part{k}")
        native.append(None if part is None else part if part.ndim else part.item())
    return Ground(tuple(native))


def component_arrays(components: list[Component]) -> dict[str, np.ndarray]:
    """All components of a window, one after the other, and how many of each they have."""
    found: dict[str, np.ndarray] = {"owner": np.array([each.owner for each in components], np.int32)}
    for name in COMPONENT:
        values = [np.asarray(getattr(each, name), np.int32) for each in components]
        found[f"{name}_count"] = np.array([len(each) for each in values], np.int32)
        found[name] = np.concatenate(values) if values else np.zeros(0, np.int32)
    return found


def components_of(arrays: Mapping[str, np.ndarray]) -> list[Component]:
    """What component_arrays() told."""
    parts = {name: np.split(arrays[name], np.cumsum(arrays[f"{name}_count"])[:-1]) for name in COMPONENT}
    return [
        Component(
            parts["walkers"][k].tolist(),
            parts["tiles"][k],
            owner=int(owner),
            tile_from=parts["tile_from"][k],
            walker_from=parts["walker_from"][k],
        )
        for k, owner in enumerate(arrays["owner"].tolist())
    ]


# ---- the folder ---------------------------------------------------------------------------------------------


class Job:
    """A job that was planned. Its numbers are those of job.json, by name in `about`."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = os.path.abspath(os.fspath(folder))
        self.about = self._read()
        self.digest = _native.digest(json.dumps(self.about, sort_keys=True).encode()).hex()
        self.windows = [Window(*each) for each in self.about["windows"]]
        self.columns, self.rows = self.about["tiles"]
        self.film: tuple[int, int, int, int] = tuple(self.about["film"])
        self.chained: str = self.about["chained"]
        self.samples: list[int] = self.about["samples"]  # of each number of a file, 0: before the first step

    def path(self, *names: str) -> str:
        return os.path.join(self.folder, *names)

    def _read(self) -> dict[str, Any]:
        path = self.path(JOB)
        try:
            with atomic_file.reader(path) as stream:
                data = json.loads(stream.read(MAX_JSON).decode("utf-8"))
            found, version = data["format"], data["version"]
            if data["digest"] != _native.digest(json.dumps(data["about"], sort_keys=True).encode()).hex():
                raise ValueError
        except FileNotFoundError:
            raise DesirePathError(f"There is no job in {self.folder}: let farm plan make one there.") from None
        except (OSError, ValueError, KeyError, TypeError, RecursionError, MemoryError):
            raise DesirePathError(f"{path} is damaged, or no job: plan it again.") from None
        if found != FORMAT or version != VERSION:
            raise DesirePathError(
                f"The job in {self.folder} was planned by version {str(version)[:40]}, and this is {VERSION}: use the "
                "same version on all machines, or plan it again."
            )
        about: dict[str, Any] = data["about"]
        return about

    def check_task(self, window: int, tile: int) -> None:
        """Refuse a task that the job does not have."""
        for name, number, count in (("window", window, len(self.windows)), ("tile", tile, self.columns * self.rows)):
            if not 0 <= number < count:
                last = f"0 to {count - 1}" if count > 1 else "0 alone"
                raise DesirePathError(f"The job in {self.folder} has no {name} {number}: choose {last}.")

    def arrays(self, name: str) -> dict[str, np.ndarray]:
        """Of one of its files, which is as it was planned."""
        path = self.path(name)
        try:
            if digest_of(path) != self.about["files"][name]:
                raise npz.Damaged
            return npz.read(path, MAX_ARRAYS)
        except (OSError, KeyError, npz.Damaged):
            raise DesirePathError(
                f"{path} is not as it was planned: copy the whole job again, or plan it again."
            ) from None

    def components(self, window: int) -> list[Component]:
        """Those of a window."""
        return components_of(self.arrays(window_name(window)))

    def simulation(self, threads: int = 0) -> Simulation:
        """The ground before anybody walks."""
        about = self.about
        options = SimulationOptions(
            law=about["law"],
            heap=about["heap"],
            rim_width=about["rim_width"],
            origin=tuple(about["origin"]),
            threads=threads,
        )
        return Simulation(
            _ground(self.arrays(GROUND), about["ground_parts"]),
            [_soil(each) for each in about["soils"]],
            about["cell"],
            plants=[_planting(each) for each in about["plants"]],
            options=options,
        )

    # ---- results ----------------------------------------------------------------------------------------

    def _task(self, window: int, tile: int) -> dict[str, Any]:
        return {"job": self.digest, "window": window, "tile": tile}

    def keep(self, window: int, tile: int, about: dict[str, Any], parts: Mapping[str, bytes | memoryview]) -> None:
        """Write the result of a task, whole or not at all."""
        sizes = {name: len(part) for name, part in parts.items()}
        path = self.path(START if window < 0 else result_name(window, tile))
        states.write(path, {**about, "parts": sizes, **self._task(window, tile)}, memory.joined(list(parts.values())))

    def result(self, window: int, tile: int) -> tuple[dict[str, Any], dict[str, memoryview]]:
        """(what it tells, its parts by name) of the result of a task; states.Damaged where there is none, or not
        whole, or of another job."""
        path = self.path(START if window < 0 else result_name(window, tile))
        about, data = states.read(path, self._task(window, tile))
        parts, at = {}, 0
        for name, size in about["parts"].items():
            parts[name] = data[at : at + size]
            at += size
        return about, parts

    def needed(self, window: int, tile: int, whose: str) -> tuple[dict[str, Any], dict[str, memoryview]]:
        """result() of a task that has to be there."""
        try:
            return self.result(window, tile)
        except states.Damaged:
            pass
        if window < 0:
            raise DesirePathError(f"{self.path(START)} is not as it was planned: copy the whole job again.")
        there = os.path.lexists(self.path(result_name(window, tile)))
        says = "is not whole, or of another job" if there else "is not there"
        raise DesirePathError(
            f"{whose} the result of window {window}, tile {tile}, which {says}: run farm tile {self.folder} --window "
            f"{window} --tile {tile} first."
        )
