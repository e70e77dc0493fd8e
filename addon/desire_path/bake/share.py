"""One ground's share of a bake: what is filmed of it, the files in its folder, and what its report says.

    Bake --one Simulation, as many Shares as grounds lie on it--> folder/frames, folder/maps, folder/report.json ..
output.py says how what is made takes the place of what is shown; plan.py what each file holds.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..errors import DesirePathError
from ..files import atomic_file, disk
from ..ground import maps, plant_mesh, spray
from ..ground.parcels import Parcel
from ..ground.sim import TILE, Film, Simulation
from ..ground.trail import LEFT
from ..loads.force import FootForce
from ..version import VERSION
from .atlas import Atlas
from .contents import OWNER, index_data
from .folder import (
    ATLAS,
    FORMAT,
    INPUTS,
    SPARSE,
    SPRAY_SUMS,
    SUMS,
    add_spray,
    frame_name,
    frame_path,
    frames_sound,
    is_sound,
    list_sums,
    order_sums,
    spray_sums,
)
from .output import Output
from .plan import Plan

PLANTS = "plants.pc2.part"  # beside the frames: the plants' point cache as it grows
MAP_FILMS = ("second_", "pass_")
START_PART = "maps_start.exr.first.part"  # beside bake.new until the bake has come to its end
START = {"young_modulus_in": "Pa", "plant_strength_in": "-"}  # what the first map says besides, and in which unit
SEEN = {"R": "young_modulus", "G": "plant_strength", "B": "compression"}  # of it as a picture; G and B as in frames


class Share:
    """plan: the Plan of the bake; parcel: its Parcel; sim: the Simulation it lies on; loads: what
    presses there; tiles: (x, y, nx, ny) it films."""

    def __init__(
        self, plan: Plan, parcel: Parcel, sim: Simulation, loads: FootForce, tiles: tuple[int, int, int, int]
    ) -> None:
        self.plan, self.parcel, self.sim, self.loads, self.tiles = plan, parcel, sim, loads, tiles
        self.plants: Any = parcel.plants
        found: Any = plan.options.spray
        self.spray: spray.Spray | None = found
        self.out = Output(parcel.folder, parcel.owner)
        self.atlas: Atlas | None = None  # of pictures that show the ground near prints alone
        self.mesh: plant_mesh.Writer | None = None
        self.begun = False
        self.found = -1  # frames that are there already, -1 = not even the ground at rest
        self.place = ""  # where they lie, a folder as bake.new
        self.sums: dict[str, str] = {}  # the checksums of their files by name
        self.sound_to = -1  # up to this frame all files are there, maps too
        self.report: dict[str, Any] | None = None
        self.final: dict[str, np.ndarray] | None = None  # the planes of maps_final.exr, when the bake is whole

    @property
    def window(self) -> tuple[int, int, int, int]:
        """Cells (i0, j0, nx, ny) of its tiles."""
        i0, j0, nx, ny = (TILE * each for each in self.tiles)
        return i0, j0, nx, ny

    @property
    def cells(self) -> int:
        """Of one picture for playback."""
        return self.atlas.cells if self.atlas else self.window[2] * self.window[3]

    @property
    def by_tiles(self) -> bool:
        """Whether its last maps are never in memory as a whole."""
        return self.atlas is not None or self.plan.options.memory is not None

    # ---- what is made ---------------------------------------------------------------------------

    def thin(self, most: float) -> None:
        """Leave out of its pictures what nobody comes near, if they had more cells than this; before find(). Where
        something flies it may land anywhere, and they show all."""
        if self.cells > most and not self.spray:
            self.atlas = Atlas.over(self.sim.reach_tiles(*self.tiles))

    def find(self, signature: str) -> None:
        """Look at what the very same bake left."""
        self.index = self._index(signature)
        self._find()

    def look(self) -> None:
        """Look at the ground before its first step, once it is known that there is room for it."""
        plan = self.plan
        if self.atlas:
            self._film_start()
        else:
            self.write_start(os.path.join(self.out.folder, START_PART))
        if self.parcel.plant_mesh and (len(plan.parcels) == 1 or self._is_planted()):
            count = plan.frame_end - plan.frame_start + 1
            self.mesh = plant_mesh.Writer(self.sim, plan.frame_start, count, self.plants)

    def begin(self, frame: int, states: Sequence[str]) -> None:
        """Open its films and its files after a frame, 0 = the begin; what was found and still counts is kept, so the
        files named in `states`."""
        self.films = self.open_films()
        fresh = self.out.path("frames")
        try:
            self._keep(frame, states)
            if self.atlas:
                self.atlas.write(fresh)
            self._write_json(("frames", "index.json"), self.index, "The index of the frames")
            list_sums(fresh, {name: found for name, found in self.sums.items() if not name.startswith("spray_")})
            self.films.list_files(os.path.join(fresh, SUMS))
            if self.spray:
                self._list_spray(fresh)
            if self.mesh:
                self.mesh.open(os.path.join(fresh, PLANTS), frame)
            self.begun = True
        except OSError as problem:
            raise DesirePathError(
                f"The folder {self.out.folder} cannot be written ({problem.strerror}): choose another one."
            ) from None

    def _is_planted(self) -> bool:
        return any(self.sim.plantings[number] in self.plants for _, number, _ in self.sim.stands)

    def _find(self) -> None:
        """Which frames and maps of the very same bake are there, bit for bit."""
        listed: dict[str, str] = {}
        for place in (self.out.new, self.out.folder):
            old = index_data(os.path.join(place, "frames"))
            if (
                self.plan.output.resume
                and old
                and (place == self.out.new or not old.get("complete"))
                and all(old.get(name) == self.index.get(name) for name in ("signature", OWNER, ATLAS))
            ):
                there, sums, known = frames_sound(os.path.join(place, "frames"), bool(self.plants), bool(self.spray))
                if there > self.found:
                    self.found, self.sums, self.place, listed = there, sums, place, known
        self.sound_to = self.found
        for number in range(1, self.found + 1):
            name = self.plan.map_name(self.plan.frame_start + number - 1)
            if name and not is_sound(os.path.join(self.place, "maps"), name, listed):
                self.sound_to = number - 1
                break
            if name:
                self.sums[name] = listed[name]

    def _keep(self, frame: int, states: Sequence[str]) -> None:
        """Let bake.new hold what was found and still counts, and nothing else."""
        later = {self.plan.map_name(self.plan.frame_start + number) for number in range(frame, self.sound_to)}
        self.sums = {name: found for name, found in self.sums.items() if name not in later}
        kept = [*self.sums, *states, *([PLANTS] if self.mesh and frame else [])]
        here = self.place == self.out.new
        self.out.fresh(keep=[*kept, SUMS, SPRAY_SUMS, "index.json"] if here else ())
        if self.place and not here:
            for name in kept:  # what is shown stays until the bake is whole
                folder = "maps" if name.startswith(MAP_FILMS) else "frames"
                _link(os.path.join(self.place, folder, name), self.out.path(folder, name))

    def _list_spray(self, fresh: str) -> None:
        """Begin the list of what flies with the frames that are there already."""
        known = spray_sums(os.path.join(self.place, "frames")) if self.place else {}
        path = os.path.join(fresh, SPRAY_SUMS)
        with atomic_file.file(path, "The list of the spray", "w", False, encoding="ascii") as file:
            file.writelines(f"{name} {of} {count}\n" for name, (of, count) in known.items() if name in self.sums)

    def _write_spray(self, number: int, seconds: float) -> None:
        """What flies; of several grounds, over this one."""
        grains, folder, name = self.sim.grains(), self.out.path("frames"), frame_name(number, "spray")
        if len(self.plan.parcels) > 1:
            grains = grains.some(self.parcel.has(np.ascontiguousarray(grains.position[:, :2])))
        spray.write_frame(os.path.join(folder, name), grains, seconds)
        add_spray(folder, name, len(grains))

    def plants_known(self, frame: int) -> str | None:
        """Digest of the plants' mesh that was written up to a frame; None where none is."""
        return self.mesh.known(os.path.join(self.place, "frames", PLANTS), frame) if self.mesh else None

    def plants_digest(self) -> str | None:
        """The same of what was written by now."""
        return self.mesh.digest() if self.mesh else None

    def write(self, number: int, seconds: float) -> None:
        """One frame of every film, and the plants, unless it is there already."""
        fresh = self.out.path("frames") if number > self.found else None
        self.films.write_frame(fresh and frame_path(fresh, number), seconds)
        if self.plants:
            self.films.write_lean(fresh and frame_path(fresh, number, "lean"), seconds)
        if self.spray and fresh:
            self._write_spray(number, seconds)
        if self.mesh and number:
            self.mesh.add(self.sim)

    def map(self, frame: int) -> None:
        """The map of a scene frame, if it has one."""
        name = self.plan.map_name(frame)
        if name:
            self.films.write_maps(self.out.path("maps", name), self.plan.time(frame))

    def end(self) -> None:
        """The first and the last maps."""
        self.films.write_maps(self.out.path("maps_final.exr"), self.plan.time(self.plan.frame_end))
        disk.replace(os.path.join(self.out.folder, START_PART), self.out.path("maps_start.exr"))
        if not self.by_tiles:
            names = [*(entry.name for entry in maps.MAPS), *self.sim.more_fields]
            self.final = {name: self.sim.read(name, *self.window) for name in names}
        if self.mesh:
            self.mesh.finish(self.sim, self.out.path("plants.pc2"), self.out.path("plants.npz"))

    def write_start(self, path: str) -> None:
        """The map before the first step: now."""
        i0, j0, nx, ny = self.window

        def rows(name: str, j: int, count: int) -> np.ndarray:
            return self.sim.read(shown[name], i0, j0 + j, nx, count)

        shown = self._start_fields()
        maps.write_rows(path, shown, (ny, nx), rows, [("time", 0.0), *self._start_notes()], layers=False)

    def _start_fields(self) -> dict[str, str]:
        """What the first map shows, and whose fields these are."""
        left = LEFT if self.parcel.ground.trail else ()
        return {
            **SEEN,
            "young_modulus_in": "young_modulus",
            "plant_strength_in": "plant_strength",
            "plant_strength": "plant_strength",
            "rest": "rest",
            **{name: name for name in left},
            **({entry.name: entry.name for entry in maps.LEAN} if self.plants else {}),
        }

    def _start_notes(self) -> list[tuple[str, str | float]]:
        return [*((f"unit_{name}", unit) for name, unit in START.items()), *self._notes()]

    def _film_start(self) -> None:
        """The same tile by tile, beside what is made: what has more cells than a picture may have takes no memory."""
        names = self._start_fields()
        film = self.sim.open_frames(*self.tiles, self._pages())
        film.open_maps(list(names), self._start_notes(), names, layers=False)
        film.write_maps(os.path.join(self.out.folder, START_PART), 0.0)
        self.sim.flush()

    def _pages(self) -> tuple[int, int, np.ndarray] | None:
        return (self.atlas.columns, self.atlas.rows, self.atlas.pages) if self.atlas else None

    def open_films(self) -> Film:
        """A film of it, whose maps have its fields and notes."""
        films = self.sim.open_frames(*self.tiles, self._pages())
        films.open_maps([entry.name for entry in self.fields()], self._notes())
        return films

    def conclude(self, report: dict[str, Any]) -> None:
        """The bake is whole: write its report and say so in its index."""
        self.report = report
        order_sums(self.out.path("frames"))
        self._write_json(("report.json",), report, "The report")
        self._write_json(("frames", "index.json"), {**self.index, "complete": True}, "The index of the frames")

    def _write_json(self, names: tuple[str, ...], data: object, what: str) -> None:
        """Below bake.new, all of which Output.ready() syncs at once."""
        atomic_file.write_json(self.out.path(*names), data, what, sync=False)

    def ready(self) -> None:
        """The bake is whole, here and soon on every ground."""
        self._close()
        self.out.ready()

    def stop(self, ends: bool = False) -> None:
        """The bake was stopped: what there is of it is shown, unless a whole bake is.

        ends: all frames were there, and what belongs to them failed: nothing is shown, and the next bake goes on
        """
        self._close()
        self.report = self.final = None
        if not self.begun or ends:
            return
        if len(self.plan.parcels) == 1 or self.is_pressed():
            self.out.publish_stopped()

    def leave(self) -> None:
        """Nobody came here: nothing of it is shown."""
        self._close()
        self.out.drop()

    def _close(self) -> None:
        with contextlib.suppress(OSError):
            os.unlink(os.path.join(self.out.folder, START_PART))
        if self.mesh:
            self.mesh.close()

    # ---- what it says ---------------------------------------------------------------------------

    def _own(self, i0: int, j0: int, nx: int, ny: int) -> np.ndarray:
        """Which cells lie on this ground (ny, nx)."""
        cell, (ox, oy) = self.sim.cell_size, self.sim.origin
        x, y = np.meshgrid(ox + cell * (i0 + 0.5 + np.arange(nx)), oy + cell * (j0 + 0.5 + np.arange(ny)))
        return self.parcel.has(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(ny, nx)

    def is_pressed(self) -> bool:
        """Whether anything has changed on this ground."""
        return any((pressed > 0.0).any() or (heap > 0.0).any() for pressed, heap in self._left())

    def _left(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """What lies pressed and heaped on this ground [m], tile by tile."""
        x, y, nx, ny = self.tiles
        for j, i in np.argwhere(self.sim.reach_tiles(x, y, nx, ny)).tolist():
            window = ((x + i) * TILE, (y + j) * TILE, TILE, TILE)
            own = self._own(*window)
            pressed, heap = (self.sim.read(name, *window)[own].astype(float) for name in ("compression", "heap"))
            yield pressed, heap

    def numbers(self) -> dict[str, float]:
        """Depth [m] and volumes [m^3] of what was pressed into this ground, of several."""
        area, deepest, volume = self.sim.cell_size**2, 0.0, np.zeros(2)
        for pressed, heap in self._left():
            deepest = max(deepest, float(pressed.max(initial=0.0)))
            volume += float(pressed.sum()), float(heap.sum())
        return {"deepest_m": deepest, "pressed_m3": float(volume[0]) * area, "heaped_m3": float(volume[1]) * area}

    def _index(self, signature: str) -> dict[str, Any]:
        plan = self.plan
        tx, ty, nx, ny = self.tiles
        ox, oy = self.sim.origin
        side = TILE * self.sim.cell_size
        return {
            "format": SPARSE if self.atlas else FORMAT,
            "version": VERSION,
            "signature": signature,
            "cell": self.sim.cell_size,
            "x0": ox + tx * side,
            "y0": oy + ty * side,
            "nx": nx * TILE,
            "ny": ny * TILE,
            "frame_start": plan.frame_start,
            "frame_end": plan.frame_end,
            "frame_rate": plan.frame_rate,
            "complete": False,
            **({ATLAS: self.atlas.data()} if self.atlas else {}),
            **({"lean": True} if self.plants else {}),
            **({"grain_size": self.spray.particle_size} if self.spray else {}),
            **({OWNER: self.out.owner} if self.out.owner else {}),
            **({INPUTS: self.parcel.inputs} if self.parcel.inputs else {}),
        }

    def _notes(self) -> list[tuple[str, str | float]]:
        index = self._index("")
        notes = [
            ("software", f"Desire Path {VERSION}"),
            ("cell", index["cell"]),
            ("originX", index["x0"]),
            ("originY", index["y0"]),
            ("parameters", json.dumps(self.plan.parameters(self.parcel), separators=(",", ":"))),
        ]
        return notes + [(f"unit_{entry.name}", entry.unit) for entry in self.fields()]

    def fields(self) -> tuple[maps.Map, ...]:
        """Those of its maps."""
        more = tuple(maps.Map(name, *field[1:]) for name, field in self.sim.more_fields.items())
        return maps.MAPS + maps.GROUND + (maps.LEAN if self.plants else ()) + more


def _link(path: str, to: str) -> None:
    """The same file under another name, too; a copy, where the disk has no such names."""
    try:
        os.link(path, to)
    except OSError:
        shutil.copy2(path, to)
