"""From a recording to a folder of EXR files: frames for playback, maps, and a report.

    folder/frames/trail_0000.exr   the ground at rest (all zero)
    folder/frames/trail_0001.exr   the first frame, then one file a frame
    folder/frames/lean_0001.exr    with plants: how the grass lies, likewise from lean_0000.exr on
    folder/frames/index.json       where the frames lie and which are there
    folder/maps/second_0001.exr    the maps after every simulated second, TRAIL 4.3
    folder/maps/pass_0001.exr      or after a pass, where a frame is a pass
    folder/maps_start.exr          plant_strength_in, young_modulus_in, plant_strength, rest
    folder/maps_final.exr          compression, heap, pressure_time, plant_strength, rest, pressure; lean_x ..
    folder/plants.pc2, plants.npz  when asked for: the plants themselves, see plant_mesh.py
    folder/report.json             what happened, in numbers

A bake grows in folder/bake.new and takes the place of an earlier one, which is shown until then, when it is
whole: output.py says how. One that was stopped stays: the same bake started again goes on from its last
whole frame. Files of others in these folders are left alone.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import math
import os
import shutil
import time
from dataclasses import asdict, dataclass

import numpy as np

from . import _native, jumps, maps, plant_mesh, walker, whole
from .errors import DesirePathError
from .folder import FORMAT, INPUTS, OWNER, Sums, frame_path, frames_sound, told
from .folder import FrameIndex, free, read_index  # noqa: F401  (found here by those who bake)
from .output import Output
from .passes import turns_of
from .plants import as_plantings
from .sim import LOAD_MODELS, TILE, Simulation, as_soils, check_cell
from .version import VERSION

SAMPLE_RATE = 120.0  # at least so many steps a second, as many as forces are found at [1/s]
RIGID = 0.94  # share of the layer: pressed this deep, soil is nearly as deep as it can be
MOST_PIXELS = 1 << 27  # of one frame
MOST_SOLE = 1_000_000  # cells one sole may cover
PASS_RATE = 60.0  # the same where a frame is a pass: there are many, and each print is trodden again [1/s]
FILMS = ("frames", "passes")  # what a frame is: a scene frame | a whole pass of a walk along a path
MOST_PASS_MAPS = 50  # of a bake of passes; with more passes than these, maps of some
START = {"young_modulus_in": "Pa", "plant_strength_in": "-"}  # what the first map says besides, and in which unit
BESIDE = "The walk passes beside the ground: move the walker or the ground so that one lies over the other."


@dataclass(frozen=True)
class Progress:
    """How far a bake has come."""

    frame: int  # scene frame just simulated; it is written while the next ones are
    fraction: float  # 0..1


class Bake:
    """One bake: make it, run it, read its report.

    gait: Gait; ground: Ground; soils as for Simulation; folder: where the files go.
    cell_size [m]; frame_start, frame_end: scene frames to write, default: the whole recording.
    load_model: "inertia" or "impulse"; law, heap, rim_width, threads, plants: as for Simulation.
    plant_mesh: write the plants themselves as a mesh and its point cache, for close-ups.
    resume: go on where the same bake was stopped. map_seconds: write maps after every second, or pass.
    film: "frames", or "passes": frame n is the ground after pass n of Gait.along; None = "passes" if there are several.
    owner: id of the ground the folder belongs to; run() refuses a folder with the bake of another. Empty: anybody's.
    inputs: words for what it is made from, kept in index.json for whoever wants to know whether that has changed.
    wait: so long run() lets another program end its bake into the folder before it refuses, which it does at once where
    this program bakes there [s].
    """

    def __init__(self, gait, ground, soils="dry-sand", folder="bake", *, cell_size=0.01,
                 frame_start=None, frame_end=None, load_model="inertia", law="sole", heap="rest",
                 rim_width=0.04, threads=0, origin=(0.0, 0.0), resume=True, map_seconds=True,
                 plants=(), plant_mesh=False, film=None, owner="", inputs=None, wait=30.0):
        if load_model not in LOAD_MODELS:
            raise DesirePathError(
                f"There is no load model '{load_model}': choose {' or '.join(LOAD_MODELS)}."
            )
        if film not in (None, *FILMS):
            raise DesirePathError(f"There is no film '{film}': choose {' or '.join(FILMS)}.")
        self.gait = gait = jumps.found(gait.check())
        self.passes = turns_of(gait)
        self.film = film or FILMS[len(self.passes) > 1]
        self.ground = ground
        self.soils = as_soils(soils)
        self.plants = as_plantings(plants)
        self.plant_mesh = bool(plant_mesh)
        if self.plant_mesh and not self.plants:
            raise DesirePathError("There are no plants to write as a mesh: give the bake plants, or no plant_mesh.")
        self.folder = os.path.abspath(os.fspath(folder))
        self.owner, self.wait = str(owner), float(wait)
        self.inputs = dict(inputs or {})
        self.frame_rate = float(gait.frame_rate)
        frames = (len(self.passes) - 1 if self.film == "passes"
                  else math.floor((gait.time[-1] - gait.time[0]) * self.frame_rate + 1e-6))
        last = gait.frame_start + frames
        self.frame_start = gait.frame_start if frame_start is None else int(frame_start)
        self.frame_end = last if frame_end is None else int(frame_end)
        if self.frame_end <= self.frame_start and self.film == "frames" or self.frame_end < self.frame_start:
            raise DesirePathError(
                f"The frame range {self.frame_start} to {self.frame_end} holds no motion: let it end after it starts."
            )
        if self.frame_start > last or self.frame_end < gait.frame_start:
            raise DesirePathError(
                f"The recording holds frames {gait.frame_start} to {last} and none of {self.frame_start} to {self.frame_end}: choose frames among them."
            )
        self.load_model = load_model
        self.resume = resume
        self.map_seconds = map_seconds
        self.options = {"law": law, "heap": heap, "rim_width": rim_width, "origin": tuple(origin)}
        self.cell_size = float(cell_size)
        self.threads = threads
        self.loads = None
        self.report = None
        self.final = None  # the planes of maps_final.exr, when the bake is whole

    # ---- what is baked --------------------------------------------------------------------------

    def _parameters(self):
        grown = {"plants": [planting.told() for planting in self.plants]} if self.plants else {}
        return {
            "cell_size": self.cell_size,
            "frame_start": self.frame_start,
            "frame_end": self.frame_end,
            "frame_rate": self.frame_rate,
            "load_model": self.load_model,
            "soils": [asdict(soil) for soil in self.soils],
            "ground": self.ground.name,
            **({"trail": self.ground.trail.path} if self.ground.trail else {}),
            "walkers": list(self.gait.walker_name),
            "mass_kg": [float(mass) for mass in self.gait.mass],
            **self.options,
            **grown,
            **({"film": self.film} if self.film != "frames" else {}),
        }

    def _signature(self):
        """The same for two bakes exactly when they write the same files."""
        digest = hashlib.sha256(f"{VERSION} {FORMAT} {self._parameters()} {self.ground.native[0]}".encode())
        gait = self.gait
        arrays = [gait.time, gait.com, gait.pose, gait.point, gait.part_limb, gait.limb_walker, gait.cut,
                  gait.jump]
        for sole in gait.soles:
            arrays += [sole.vertices, sole.triangles]
        for planting in self.plants:
            arrays += planting.arrays()
        for array in arrays + self.ground.arrays():
            digest.update(f"{array.shape} {array.dtype}".encode())
            digest.update(_native.digest(np.ascontiguousarray(array)))
        digest.update(repr([part for part in self.ground.native if isinstance(part, float)]).encode())
        return digest.hexdigest()

    def _simulation(self):
        """The ground with the recording on it, at a whole number of samples a frame."""
        least = PASS_RATE if self.film == "passes" else SAMPLE_RATE
        samples = max(1, math.ceil(least / self.frame_rate - 1e-6))
        gait = self.gait.resample(self.frame_rate * samples)
        self.times = gait.time - gait.time[0]
        self.ends = [min(after, len(gait.time) - 1) for _, after, _, _ in turns_of(gait)]
        sim = Simulation(self.ground, self.soils, self.cell_size, threads=self.threads,
                         plants=self.plants, **self.options)
        walks = walker.Walker(self.load_model, settle_time=self.soils[0].settle_time)  # tau of TRAIL (3)
        self.loads = walks.loads(gait, sim.rest_height)
        sim.load(gait, self.loads)
        return sim

    def _rectangle(self, sim):
        """Tiles (x, y, nx, ny) the frames cover: what the walk can reach of the ground."""
        i0, i1, j0, j1 = sim.reach()
        if i0 >= i1:
            raise DesirePathError(
                "No foot touches the ground in these frames: check that the walker stands on it and the scale is right."
            )
        x0, y0, x1, y1 = sim.bounds()
        cell, (ox, oy) = self.cell_size, self.options["origin"]
        if math.isfinite(x0):
            i0 = max(i0, math.floor((x0 - ox) / cell))
            i1 = min(i1, math.ceil((x1 - ox) / cell))
            j0 = max(j0, math.floor((y0 - oy) / cell))
            j1 = min(j1, math.ceil((y1 - oy) / cell))
        if i0 >= i1 or j0 >= j1:
            raise DesirePathError(BESIDE)
        tx0, ty0 = i0 // TILE, j0 // TILE
        tx1, ty1 = -(-i1 // TILE), -(-j1 // TILE)
        if (tx1 - tx0) * (ty1 - ty0) * TILE * TILE > MOST_PIXELS:
            raise DesirePathError(
                "The walk covers more cells than one picture can hold: choose a larger cell size or a shorter walk."
            )
        return tx0, ty0, tx1 - tx0, ty1 - ty0

    # ---- the bake -------------------------------------------------------------------------------

    def run(self):
        """Bake, yielding Progress after every frame. Stopping early (closing the generator) keeps
        what was written. DesirePathError says in one sentence what went wrong."""
        try:
            yield from self._run()
        except OSError as problem:
            raise DesirePathError(
                f"{_plain(problem)}. What was baked before is still there; make room or choose another folder, then bake again."
            ) from None
        except MemoryError:
            raise DesirePathError(
                "There is not enough memory: choose a larger cell size or fewer frames."
            ) from None
        except DesirePathError:
            raise
        except ValueError as problem:
            raise DesirePathError(
                f"The walk cannot be simulated ({problem}): check the walker's place and scale and the frame rate."
            ) from None

    def _check_soles(self):
        """Refuse feet of so many cells that a step would take minutes, as of a rig in the wrong unit."""
        for part, sole in enumerate(self.gait.soles):
            size = np.sort(np.ptp(sole.vertices.astype(float), axis=0))
            if size[1] * size[2] > MOST_SOLE * self.cell_size ** 2:
                raise DesirePathError(
                    f"The sole of bone {self.gait.bone(part)} is {size[2]:.1f} m long, too large for cells of {self.cell_size:g} m: check the walker's scale or choose a larger cell size."
                )

    def _run(self):
        check_cell(self.cell_size)
        out = Output(self.folder, self.owner)
        out.open(self.wait)
        try:
            yield from self._into(out)
        finally:
            out.release()

    def _into(self, out):
        seconds = {"total": time.perf_counter()}
        self._check_soles()
        sim = self._simulation()
        tiles = self._rectangle(sim)
        picture = sim.open_frames(*tiles)
        picture.open_maps([entry.name for entry in self._fields()], self._notes(tiles))
        start = self._start_maps(sim, tiles)
        seconds["loads"] = time.perf_counter() - seconds["total"]

        index = self._index(tiles, self._signature())
        done, sums = self._prepare(out, index)
        seconds["step"] = seconds["write"] = 0.0
        mesh = None
        try:
            if self.plant_mesh:
                mesh = plant_mesh.Writer(sim, out.new, self.frame_start, self.frame_end - self.frame_start + 1)
            yield from self._frames(sim, picture, out, done, sums, mesh, seconds)
            if mesh:
                mesh.finish(sim)
            self._end(sim, picture, out, tiles, start)
            seconds["total"] = time.perf_counter() - seconds["total"]
            self.report = self._report(sim, seconds)
            whole.write_json(out.path("report.json"), self.report, "The report")
            whole.write_json(out.path("frames", "index.json"), {**index, "complete": True}, "The index of the frames")
        except BaseException:
            with contextlib.suppress(OSError):
                sim.flush()
            sums.close()
            if mesh:
                mesh.close()
            self.report = self.final = None
            out.publish_stopped()
            raise
        sums.close()
        out.publish()

    def _frames(self, sim, picture, out, done, sums, mesh, seconds):
        """Simulate and write; the first `done` frames are there already."""
        count = self.frame_end - self.frame_start + 1
        frames = out.path("frames")
        if done < 0:
            self._write(picture, frames, 0, 0.0, sums)
        for number in range(1, count + 1):
            frame = self.frame_start + number - 1
            begun = time.perf_counter()
            sim.run(self._sample(frame))
            stepped = time.perf_counter()
            self._write(picture, frames if number > done else None, number, self._time(frame), sums)
            if mesh:
                mesh.add(sim)
            if self.map_seconds:
                self._second(picture, out, frame)
            sums.look()
            seconds["step"] += stepped - begun
            seconds["write"] += time.perf_counter() - stepped
            yield Progress(frame, number / count)
        sim.flush()
        sums.look()

    def _end(self, sim, picture, out, tiles, start):
        """The first and the last maps."""
        tx, ty, nx, ny = tiles
        picture.write_maps(out.path("maps_final.exr"), self._time(self.frame_end))
        maps.write(out.path("maps_start.exr"), start,
                   [("time", 0.0), *((f"unit_{name}", unit) for name, unit in START.items())] + self._notes(tiles))
        self.final = {entry.name: sim.read(entry.name, tx * TILE, ty * TILE, nx * TILE, ny * TILE)
                      for entry in maps.MAPS}
        sim.flush()

    def _write(self, picture, fresh, number, seconds, sums):
        """One frame of every film into the folder `fresh`; None: it is there already."""
        picture.write_frame(fresh and frame_path(fresh, number), seconds)
        if self.plants:
            picture.write_lean(fresh and frame_path(fresh, number, "lean"), seconds)
        if fresh:
            sums.add(number, bool(self.plants))

    def _sample(self, frame):
        """Sample of the recording that shows this scene frame."""
        number = max(frame - self.gait.frame_start, 0)
        if self.film == "passes":
            return self.ends[min(number, len(self.ends) - 1)]
        return int(np.searchsorted(self.times, number / self.frame_rate + 1e-6, "right")) - 1

    def _index(self, tiles, signature):
        tx, ty, nx, ny = tiles
        ox, oy = self.options["origin"]
        side = TILE * self.cell_size
        return {
            "format": FORMAT, "version": VERSION, "signature": signature,
            "cell": self.cell_size, "x0": ox + tx * side, "y0": oy + ty * side,
            "nx": nx * TILE, "ny": ny * TILE, "frame_start": self.frame_start,
            "frame_end": self.frame_end, "frame_rate": self.frame_rate, "complete": False,
            **({"lean": True} if self.plants else {}), **({OWNER: self.owner} if self.owner else {}),
            **({INPUTS: self.inputs} if self.inputs else {}),
        }

    def _prepare(self, out, index):
        """(how many frames of the very same bake are in bake.new already (-1 = none), the Sums of its frames)"""
        fresh, shown = out.path("frames"), os.path.join(self.folder, "frames")
        done, sound, place = -1, {}, None
        for each in (fresh, shown):
            old = told(each)
            if (self.resume and old and not old.get("complete")
                    and all(old.get(name) == index.get(name) for name in ("signature", OWNER))):
                there, found = frames_sound(each, bool(self.plants))
                if there > done:
                    done, sound, place = there, found, each
        try:
            out.fresh(keep=sound if place == fresh else ())
            if place == shown:
                for name in sound:  # what is shown stays until the bake is whole
                    _link(os.path.join(shown, name), os.path.join(fresh, name))
            whole.write_json(os.path.join(fresh, "index.json"), index, "The index of the frames")
            return done, Sums(fresh, sound)
        except OSError as problem:
            raise DesirePathError(
                f"The folder {self.folder} cannot be written ({problem.strerror}): choose another one."
            ) from None

    # ---- maps, TRAIL 4.3 ------------------------------------------------------------------------

    def _time(self, frame):
        """Of a scene frame since the recording began [s]."""
        if self.film == "passes":
            return float(self.times[self._sample(frame)])
        return (frame - self.gait.frame_start) / self.frame_rate

    def _notes(self, tiles):
        tx, ty, _, _ = tiles
        ox, oy = self.options["origin"]
        side = TILE * self.cell_size
        notes = [
            ("software", f"Desire Path {VERSION}"), ("cell", self.cell_size), ("originX", ox + tx * side),
            ("originY", oy + ty * side), ("parameters", json.dumps(self._parameters())),
        ]
        return notes + [(f"unit_{entry.name}", entry.unit) for entry in self._fields()]

    def _fields(self):
        return maps.MAPS + maps.GROUND + (maps.LEAN if self.plants else ())

    def _second(self, picture, out, frame):
        """After every whole simulated second, TRAIL (17); after a pass, where a frame is one."""
        if self.film == "passes":
            number = frame - self.gait.frame_start + 1
            if number % -(-len(self.passes) // MOST_PASS_MAPS) == 0:
                name = f"pass_{number:04d}.exr"
                picture.write_maps(out.path("maps", name), self._time(frame))
            return
        elapsed = frame - self.frame_start
        before, now = ((elapsed - 1) / self.frame_rate, elapsed / self.frame_rate)
        if elapsed > 0 and math.floor(now + 1e-9) > math.floor(before + 1e-9):
            name = f"second_{math.floor(now + 1e-9):04d}.exr"
            picture.write_maps(out.path("maps", name), self._time(frame))

    def _start_maps(self, sim, tiles):
        tx, ty, nx, ny = tiles
        window = (tx * TILE, ty * TILE, nx * TILE, ny * TILE)
        strength = sim.read("plant_strength", *window)
        modulus = sim.read("young_modulus", *window)
        planes = {maps.PICTURE: modulus, "young_modulus_in": modulus, "plant_strength_in": strength,
                  "plant_strength": strength, "rest": sim.read("rest", *window)}
        if self.plants:
            planes.update({entry.name: sim.read(entry.name, *window) for entry in maps.LEAN})
        return planes

    def _report(self, sim, seconds):
        found = sim.report()
        warnings = list(self.gait.warnings) + list(self.loads.warnings) + sim.warnings
        if found["deepest_m"] >= RIGID * min(soil.layer_depth for soil in self.soils):
            warnings.append("A print reaches the rigid ground under the soil: check the walker's mass, "
                            "or choose a firmer soil.")
        if found["off_ground"] and walker.BESIDE not in warnings:
            warnings.append(walker.BESIDE)
        return {
            "passes": len(self.passes), "contacts": found["contacts"], "deepest_m": found["deepest_m"],
            "pressed_m3": found["pressed_m3"], "pressed_heap_m3": found["pressed_heap_m3"],
            "heaped_m3": found["heaped_m3"], "displaced_m3": found["displaced_m3"],
            **({"plants": found["plants"], "broken_bends": found["broke"]} if self.plants else {}),
            "seconds": round(seconds["total"], 3),
            "stages": {name: round(spent, 3) for name, spent in seconds.items()},
            "warnings": warnings, "version": VERSION, "parameters": self._parameters(),
        }


def _link(path, to):
    """The same file under another name, too; a copy, where the disk has no such names."""
    try:
        os.link(path, to)
    except OSError:
        shutil.copy2(path, to)


def _plain(problem):
    """One clause about an OSError, whoever raised it."""
    if problem.strerror and problem.filename:
        return f"{problem.filename} cannot be written ({problem.strerror})"
    return str(problem)
